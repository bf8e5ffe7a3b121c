#!/bin/sh
# cutcell.sh - examples/cutcell on an airfoil and on countries, and its command line.
#
#     sh tests/cutcell.sh BUILD
#
# All numbers are held against exact rationals by cutcell.c; then come the table and the errors.

. "$(dirname "$0")/verdict.sh"
. "$tests/example.sh"
program=$(cd "$1" && pwd)/cutcell
exact=$(cd "$1" && pwd)/tests/cutcell
foil=$root/examples/data/naca2412.txt
countries=$root/examples/data/countries.txt

# NAME ARGUMENTS...: every number of this grid.
check_exactly() {
	name=$1
	shift
	"$program" --exact "$@" >"$work/grid" 2>"$work/stderr"
	verdict "$name" "$(head -n 1 "$work/stderr")"
	"$exact" <"$work/grid" >"$work/verdicts" 2>&1
	under "$name" "$work/verdicts"
}

# A square whose sides are lines of the grid cuts nothing; a hole in the middle of a cell cuts one,
# and its numbers can be said.
check_table() {
	printf 'shape square\nring\n1 1\n3 1\n3 3\n1 3\n' >"$work/square"
	"$program" --cells 2 "$work/square" >"$work/table"
	verdict "sides on the grid" "$(grep -q '^0 cells are cut, 4 are whole' "$work/table" ||
		grep cells "$work/table")"
	printf 'hole\n1.25 1.25\n1.25 1.75\n1.75 1.75\n1.75 1.25\n' >>"$work/square"
	"$program" --cells 2 "$work/square" >"$work/table"
	row=$(sed -n 2p "$work/table" | awk '{ print $1, $2, $3, $4, $5, $6, $7, $8 }')
	want='0 0 0.7500000 1.500000 1.500000 7.8125e-02 0.0000e+00 7.8125e-02'
	verdict "a hole in a cell" "$([ "$row" = "$want" ] || echo "the row is $row, not $want")"
	verdict "one cell of four" "$(grep -q '^1 cells are cut, 3 are whole' "$work/table" ||
		grep cells "$work/table")"
}

check_errors() {
	expect_error "no file" 2 "usage: cutcell"
	expect_error "unknown option" 2 "usage: cutcell" --frobnicate "$foil"
	expect_error "three operands" 2 "usage: cutcell" "$foil" a b
	expect_error "no cells" 2 "from 1 to" --cells 0 "$foil"
	expect_error "no number" 2 "from 1 to" --cells 8x "$foil"
	expect_error "missing file" 1 "cannot open $work/none" "$work/none"
	expect_error "no such shape" 1 "has no shape 'Atlantis'" "$countries" Atlantis
	printf 'shape s\nring\n0 0\n1 0\n1 x\n' >"$work/bad"
	expect_error "no y" 1 "$work/bad:5:3: error: expected a y" "$work/bad"
	printf 'shape s\nring\n0 0\n1 0\n1 1 5\n' >"$work/bad"
	expect_error "a radius" 1 "$work/bad:5:5: error: unexpected text" "$work/bad"
	printf 'shape s\nring\n0 0\n0 1\n1 0\n' >"$work/bad"
	expect_error "clockwise" 1 "$work/bad:2:1: error: the ring runs clockwise" "$work/bad"
	"$program" --help >"$work/stdout" 2>"$work/stderr"
	verdict "--help" "$(grep -q '^usage: cutcell' "$work/stdout" || cat "$work/stderr")"
}

check_exactly "airfoil" "$foil"
check_exactly "airfoil, 300 cells" --cells 300 "$foil"
check_exactly "Switzerland" --cells 20 "$countries" Switzerland
check_exactly "South Africa" --cells 33 "$countries" "South Africa"
check_exactly "Indonesia" --cells 100 "$countries" Indonesia
check_exactly "one cell" --cells 1 "$countries" Cuba
check_table
check_errors
finish

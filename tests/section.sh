#!/bin/sh
# section.sh - examples/section on standard profiles, and its command line.
#
#     sh tests/section.sh BUILD
#
# All numbers are held against closed forms by section.c, as they are and rotated; then come the
# table and the errors.

. "$(dirname "$0")/verdict.sh"
. "$tests/example.sh"
program=$(cd "$1" && pwd)/section
exact=$(cd "$1" && pwd)/tests/section
profiles=$root/examples/data/sections.txt

# NAME FILE [rotated]: every number of this file, against the closed forms of the profiles.
check_exactly() {
	name=$1
	file=$2
	shift 2
	"$program" --exact "$file" >"$work/output" 2>"$work/stderr"
	verdict "$name" "$(head -n 1 "$work/stderr")"
	"$exact" "$profiles" "$@" <"$work/output" >"$work/verdicts" 2>&1
	under "$name" "$work/verdicts"
}

# Fractions of 25 and 50 in hundredths: four decimals are exact.
rotate() {
	awk '
		/^table/ { next }
		/^[-0-9]/ {
			printf "%.4f %.4f %s\n", (4 * $1 - 3 * $2) / 5, (3 * $1 + 4 * $2) / 5, $3
			next
		}
		{ print }' "$profiles"
}

# h b tw tf r of IPE 200, by the formula for its area.
check_table() {
	"$program" "$profiles" 'IPE 200' >"$work/table"
	area=$(awk 'BEGIN {
		h = 200; b = 100; tw = 5.6; tf = 8.5; r = 12; pi = atan2(0, -1)
		printf "%.4f", (2*b*tf + (h - 2*tf)*tw + (4 - pi)*r^2)/100
	}')
	row=$(awk '$1 == "A" { print $2, $3, $4 }' "$work/table")
	verdict "the table of one" "$([ "$row" = "$area cm2 28.48" ] || echo "area is $row")"
	got=$("$program" "$profiles" | grep -c ' area$')
	want=$(grep -c '^shape' "$profiles")
	verdict "all of them" "$([ "$got" -eq "$want" ] || echo "$got of $want")"
}

# NAME PATTERN LINE...: a section of these lines is refused so.
expect_refusal() {
	name=$1
	pattern=$2
	shift 2
	printf '%s\n' 'shape s' "$@" >"$work/bad"
	expect_error "$name" 1 "$work/bad:$pattern" "$work/bad"
}

check_errors() {
	expect_error "no file" 2 "usage: section"
	expect_error "unknown option" 2 "usage: section" --frobnicate "$profiles"
	expect_error "three operands" 2 "usage: section" "$profiles" a b
	expect_error "missing file" 1 "cannot open $work/none" "$work/none"
	expect_error "no such section" 1 "has no section 'IPE 99'" "$profiles" 'IPE 99'
	expect_refusal "too round" "2:1: error: radii 6 and 5 do not fit on a side of 10 mm" \
		ring '0 0 6' '10 0 5' '10 20' '0 20'
	expect_refusal "there and back" "2:1: error: a side of this ring turns back" \
		ring '0 0' '10 0 1' '5 0' '5 5'
	expect_refusal "twice" "2:1: error: a corner of this ring is there twice" \
		ring '0 0' '0 0 1' '5 5'
	expect_refusal "clockwise" "1:1: error: section s encloses nothing" \
		ring '0 0' '0 1' '1 1'
	expect_refusal "a negative radius" "4:5: error: the radius must be between 0 and" \
		ring '0 0' '0 1 -1' '1 1'
	expect_refusal "text" "3:5: error: expected a radius" ring '0 0 mm' '0 1'
	"$program" --help >"$work/stdout" 2>"$work/stderr"
	verdict "--help" "$(grep -q '^usage: section' "$work/stdout" || cat "$work/stderr")"
}

check_exactly "profiles" "$profiles"
rotate >"$work/rotated"
check_exactly "rotated" "$work/rotated" rotated
check_table
check_errors
finish

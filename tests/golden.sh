#!/bin/sh
# golden.sh - what gen prints and writes for a few small requests, compared with tests/golden/.
#
#     sh tests/golden.sh [BUILD] [accept]     accept: takes what gen says now as right (make accept)
#
# Small on purpose: a change of any pass or printer shows up here as a diff
# that a reviewer can read in full.
set -u
build=${1:-build}
. "$(dirname "$0")/verdict.sh"
golden=$tests/golden

# check NAME: $work/NAME against the accepted text
check() {
	if [ "${accept:-}" ]; then
		cp "$work/$1" "$golden/$1"
	fi
	if diff -u "$golden/$1" "$work/$1" >"$work/diff" 2>&1; then
		verdict "$1"
	else
		verdict "$1" "if the change is meant, make accept; $(
			grep -m 1 '^[-+d][^-+]' "$work/diff")"
	fi
}

# prints NAME OPTION...: standard output
prints() {
	name=$1
	shift
	"$build/gen" "$@" >"$work/$name" 2>&1 || echo "status $?" >>"$work/$name"
	check "$name"
}

# sections NAME PATTERN OPTION...: those parts of a dump whose titles match
sections() {
	name=$1 pattern=$2
	shift 2
	"$build/gen" "$@" 2>&1 | awk -v pattern="$pattern" '
		/^[^ ]/ { shown = $0 ~ pattern }
		shown' >"$work/$name"
	check "$name"
}

[ "${2:-}" != accept ] || { accept=yes; mkdir -p "$golden"; }
prints x2y1.dump -d pdfs --monomial x2y1
prints degree2.dump -d pdfs --max-degree 2 --families moments
sections quad1.dump '^quad_1:' -d pdfs --max-degree 1 --families curves --edges quad
sections cubic_x1y1.dump '^cubic_x1y1:' -d d --monomial x1y1 --edges cubic
sections distance.dump '^radius_1:' -d f --families distance
sections closure.dump '^closure:' -d pdfs --families closure
sections coverage.dump '^coverage:' -d f --families coverage
sections deposit_tent.dump '^deposit_tent:' -d d --filter tent
for format in text latex json c; do
	prints x4y2.$format --show x4y2 --format $format
done
"$build/gen" --quiet --max-degree 1 --precision double --out "$work/degree1" ||
	echo "gen failed" >&2
for file in edgewise_line.c edgewise_moments_fma.c; do
	cp "$work/degree1/$file" "$work/degree1_$file"
	check degree1_$file
done
"$build/gen" --quiet --filter box --targets avx2 --no-runtime --out "$work/box" ||
	echo "gen failed" >&2
for file in edgewise_deposit_avx2.c edgewise_filters.c; do
	cp "$work/box/$file" "$work/box_$file"
	check box_$file
done
finish

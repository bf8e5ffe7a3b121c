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

[ "${2:-}" != accept ] || { accept=yes; mkdir -p "$golden"; }
prints x2y1.dump -d pdfs --monomial x2y1
prints degree2.dump -d pdfs --max-degree 2
for format in text latex json c; do
	prints x4y2.$format --show x4y2 --format $format
done
"$build/gen" --quiet --max-degree 1 --precision double --out "$work/degree1" ||
	echo "gen failed" >&2
for file in edgewise_line.c edgewise_moments_fma.c; do
	cp "$work/degree1/$file" "$work/degree1_$file"
	check degree1_$file
done
finish

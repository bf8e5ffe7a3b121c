#!/bin/sh
# readme.sh - the program in README.md, linked with the library, prints what README.md says it
# prints.
#
#     sh tests/readme.sh BUILD

build=${1:-build}
. "$(dirname "$0")/verdict.sh"
awk '/^```c/ { inside = 1; next } /^```/ { inside = 0 } inside' "$root/README.md" >"$work/use.c"
awk '
	/^```$/ { after = 1; next }
	after && /^    / { print substr($0, 5); next }
	after && NF { exit }' "$root/README.md" >"$work/want"
if ${CC:-cc} $sanitize -I"$build/emitted" -o "$work/use" "$work/use.c" \
	"$build/libedgewise.a" -lm 2>"$work/log" &&
	"$work/use" >"$work/have" && [ -s "$work/want" ] &&
	diff "$work/want" "$work/have" >>"$work/log"
then
	verdict "the program in README.md"
else
	verdict "the program in README.md" "it fails: $(tr '\n' ' ' <"$work/log")"
fi
finish

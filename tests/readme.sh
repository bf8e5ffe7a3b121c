#!/bin/sh
# readme.sh - the program in README.md, compiled against the emitted folder, prints
# what README.md says it prints.
#
#     sh tests/readme.sh BUILD

build=${1:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
awk '/^```c/ { inside = 1; next } /^```/ { inside = 0 } inside' README.md >"$dir/use.c"
awk '
	/^```$/ { after = 1; next }
	after && /^    / { print substr($0, 5); next }
	after && NF { exit }' README.md >"$dir/want"
if ${CC:-cc} -I"$build/emitted" -o "$dir/use" "$dir/use.c" "$build"/emitted/*.c -lm 2>"$dir/log" \
	&& "$dir/use" >"$dir/have" && [ -s "$dir/want" ] \
	&& diff "$dir/want" "$dir/have" >>"$dir/log"; then
	echo "ok the program in README.md"
	echo "1 passed, 0 failed"
else
	echo "not ok the program in README.md: $(tr '\n' ' ' <"$dir/log")"
	echo "0 passed, 1 failed"
	exit 1
fi

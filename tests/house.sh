#!/bin/sh
# house.sh - what keeps gen/ and runtime/ readable: no long functions, no long lines, nothing that is
# left for later. (That nothing refers upwards in the pipeline is layers.sh.)
#
# Each check is shown to fail on a file that is made to break it.
set -u
. "$(dirname "$0")/verdict.sh"
LINES_ALLOWED=100                                    # of a function
cd "$root" || exit 1

# FILE...: the first that is too long
long_function() {
	ctags -x --languages=C --kinds-C=f --_xformat='%{line} %{end} %N %F' "$@" | awk -v \
		most=$LINES_ALLOWED '$2 - $1 >= most { print $3 " of " $4 ": " $2 - $1 + 1 " lines"; exit }'
}

long_line() {
	LC_ALL=C.UTF-8 grep -nE -m 1 '^.{101}' /dev/null "$@"
}

later() {
	grep -rnwE -m 1 'TO''DO|FIX''ME|X''XX' "$@"
}

# NAME CHECK FILE...: it finds nothing there, but the file `broken`.
holds() {
	name=$1 check=$2
	shift 2
	verdict "$name" "$("$check" "$@" | head -n 1)"
	verdict "$name: a breach is reported" "$([ "$("$check" "$work/broken.c")" ] || echo "it was not")"
}

{
	echo "int long_function(int a)"
	echo "{"
	awk -v most=$LINES_ALLOWED 'BEGIN { while (most-- > 2) print "\ta++;" }'
	echo "	return a;   /* TO""DO: $(printf '%080d' 0) */"
	echo "}"
} >"$work/broken.c"

if ctags --version 2>/dev/null | grep -q Universal; then
	holds "no function over $LINES_ALLOWED lines" long_function gen/*.[ch] runtime/*.[ch]
else
	skip "long functions" "Universal Ctags is not installed"
fi
holds "no line over 100 columns" long_line gen/*.[ch] gen/ops.def gen/filters/* runtime/*.[ch]
holds "nothing left for later" later gen runtime tests bench examples Makefile
finish

#!/bin/sh
# same_output.sh - what gen writes depends on the request alone, and high degrees
# finish in time and memory.
#
#     sh tests/same_output.sh [BUILD]
#
# gen is built in trees of its own by gcc -O0, gcc -O2, clang -O2 and with sanitizers;
# all must write the same bytes, say nothing on stderr, and agree with BUILD/gen and the committed
# generated/. Seconds are printed, not judged: they are the machine's. Memory is judged where
# /usr/bin/time can tell it, else by a limit on the address space.
set -u
build=${1:-build}
. "$(dirname "$0")/verdict.sh"
KB_ALLOWED=98304                                     # --max-degree 8: below 96 MB

# build VARIANT...: COMPILER-LEVEL or COMPILER-sanitizers, each in a tree of its own
build() {
	for variant; do
		has "${variant%-*}" || continue
		case $variant in
		*-sanitizers) set -- 'CFLAGS=-O1 -g' SAN=1 ;;
		*) set -- "CFLAGS=-${variant#*-}" ;;
		esac
		make -s -j1 -C "$root" B="$work/$variant" CC="${variant%-*}" LDFLAGS= "$@" \
			"$work/$variant/gen" >"$work/$variant.log" 2>&1
	done
}

# emit GEN FOLDER: two requests
emit() {
	"$1" --quiet --max-degree 8 --out "$2-8" &&
		"$1" --quiet --max-degree 3 --monomial x5y3 --polynomial 'soft=(1-x)*(1-y)' \
			--prefix foo --out "$2-foo"
}

# compare VARIANT
compare() {
	if ! has "${1%-*}"; then
		skip "$1" "${1%-*} is not installed"
	elif [ ! -x "$work/$1/gen" ]; then
		verdict "$1" "does not compile: $(grep -m 1 error "$work/$1.log")"
	elif ! emit "$work/$1/gen" "$work/out" >"$work/log" 2>&1; then
		verdict "$1" "gen failed: $(grep -E -m 1 'ERROR|error|gen:' "$work/log")"
	elif [ -s "$work/log" ]; then
		verdict "$1" "not silent: $(head -n 1 "$work/log")"
	else
		verdict "$1" "$(for request in 8 foo; do
			diff -r "$work/out-$request" "$work/want-$request"
		done | head -n 1)"
	fi
	rm -rf "$work/out-8" "$work/out-foo"
}

# degree N KILOBYTES: gen --max-degree N within so much memory, 0 for any
degree() {
	most=$2
	command="$work/gcc-O2/gen --quiet --max-degree $1 --out $work/degree"
	start=$(date +%s)
	if /usr/bin/time -f '%e %M' true >/dev/null 2>&1; then
		/usr/bin/time -o "$work/time" -f '%e %M' $command >"$work/log" 2>&1
		status=$?
	else
		( [ "$most" -eq 0 ] || ulimit -v "$most"; exec $command ) >"$work/log" 2>&1
		status=$?
		echo "$(($(date +%s) - start)) 0" >"$work/time"
	fi
	set -- "--max-degree $1" $(tail -n 1 "$work/time")
	if [ $status -ne 0 ]; then
		verdict "$1" "status $status: $(head -n 1 "$work/log")"
	elif [ "$most" -gt 0 ] && [ "$3" -gt "$most" ]; then
		verdict "$1" "$3 kB of memory, allowed $most"
	else
		verdict "$1: $2 s, $3 kB of memory, $(du -sm "$work/degree" | cut -f 1) MB written"
	fi
	rm -rf "$work/degree"
}

check_generated() {
	cd "$root" && "$work/gcc-O2/gen" --max-degree 8 --no-runtime --check --out generated 2>&1 ||
		echo "status $?; make generated"
}

build gcc-O0 clang-O2 gcc-O2 gcc-sanitizers
emit "$build/gen" "$work/want" || verdict "$build/gen" "failed"
for variant in gcc-O0 gcc-O2 clang-O2 gcc-sanitizers; do
	compare $variant
done
verdict "generated/ is what gen writes" "$(check_generated | tr '\n' ' ')"
degree 8 $KB_ALLOWED
degree 20 0
degree 32 0
finish

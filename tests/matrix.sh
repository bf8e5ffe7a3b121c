#!/bin/sh
# matrix.sh [BUILD] - compiles emitted folders with every compiler there is and compares the bits of
# their results.
#
# Both families of compilers (gcc with g++, clang with clang++) meet each level of optimisation, and
# each language standard is read by one of them at least, but not everything is combined with
# everything: a front end reads a standard in the same way at every level, and an optimiser no
# longer sees it. -march=native goes with gnu11 and c++17, which let gcc contract a * b + c by
# default; gcc is told to on top of it. clang is not: its -ffp-contract=fast overrides the pragma in
# the source by definition. Warnings are errors throughout. The hashes that tests/hash.c prints must
# not depend on any of this; tcc, which has no FMA, must agree on the rest. The time to compile and
# the size of the library are promised. That, and -march=native, takes the whole library; for the
# sake of time the rest takes degree 2, which has every scheme that degree 8 has, and hashes of its
# own.
set -u
build=${1:-build}
. "$(dirname "$0")/verdict.sh"

STRICT="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wundef -Wdouble-promotion -Wcast-qual"
STRICT="$STRICT -Werror"
SECONDS_ALLOWED=120         # of one core; promised: 60; a loaded machine gets twice that
BYTES_ALLOWED=3300000       # 2 MB for polygons alone; every kind of edge, six filters over rings
                            # and their deposits, and the raster are in it

# compile EMISSION DIRECTORY COMPILER FLAGS...: objects, then the program `hash`
compile() {
	mkdir -p "$2" || return 1
	cp "$1"/* "$tests/hash.c" "$2" || return 1
	( cd "$2" && shift 2 && "$@" -c ./*.c && "$1" -o hash ./*.o -lm )
}

# whole|small COMPILER FLAGS...
run_combination() {
	name=$(echo "$*" | tr -d ' /')
	[ "$1" = whole ] && emission=$build/emitted || emission=$work/small
	shift
	compile "$emission" "$work/$name" "$@" $STRICT >"$work/$name.log" 2>&1 &&
		"$work/$name/hash" >"$work/$name.out" 2>&1
	echo $? >"$work/$name.status"
	rm -rf "${work:?}/$name"
}

# -std=c99 -O2 is among the promises.
combinations() {
	while read -r emission combination; do
		has "${combination%% *}" && echo "$emission $combination"
	done <<-END
		whole gcc -std=gnu11 -O3 -march=native -ffp-contract=fast
		small gcc -std=c17 -O1
		small g++ -x c++ -std=c++17 -O2 -march=native -ffp-contract=fast
		whole clang -std=gnu11 -O3 -march=native
		small clang++ -x c++ -std=c++17 -O2
		small g++ -x c++ -std=c++17 -O0
		small clang -std=c11 -O1
		small clang -std=c17 -O0
	END
}

# EMISSION NAME: what is wrong with it; the first that runs says the bits of a small emission.
judge() {
	name=$(echo "$1" | tr -d ' /')
	want=$work/want.${1%% *}
	[ -s "$want" ] || [ "$(cat "$work/$name.status")" -ne 0 ] || cp "$work/$name.out" "$want"
	if [ "$(cat "$work/$name.status")" -ne 0 ]; then
		grep -E -m 1 'error|warning' "$work/$name.log" || tail -n 1 "$work/$name.log"
	elif ! cmp -s "$work/$name.out" "$want"; then
		echo "bits differ: $(tr '\n' ' ' <"$work/$name.out")instead of $(
			tr '\n' ' ' <"$want")"
	fi
}

# COMPILER: one core, all files, warnings as errors; seconds and bytes are printed.
test_promises() {
	has "$1" || { skip "promises by $1" "not installed"; return; }
	if ! ( compile "$build/emitted" "$work/$1" "$1" -std=c99 -O2 $STRICT && times >"$work/times" ) \
		>"$work/log" 2>&1; then
		verdict "$1 -std=c99 -O2" "$(grep -E -m 1 'error|warning' "$work/log")"
		return
	fi
	seconds=$(awk -F '[ms ]+' 'NR == 2 { print int(60 * ($1 + $3) + $2 + $4) }' "$work/times")
	[ $seconds -le $SECONDS_ALLOWED ] && problem= || problem="allowed $SECONDS_ALLOWED"
	verdict "seconds of $1 -O2: $seconds" "$problem"
	rm "$work/$1/hash.o"
	ar rcs "$work/$1/library.a" "$work/$1"/*.o
	bytes=$(($(wc -c <"$work/$1/library.a")))
	[ $bytes -le $BYTES_ALLOWED ] && problem= || problem="allowed $BYTES_ALLOWED"
	verdict "bytes of $1 -O2: $bytes" "$problem"
	"$work/$1/hash" >"$work/got"
	[ -s "$work/want.whole" ] || cp "$work/got" "$work/want.whole"
	cmp -s "$work/got" "$work/want.whole" && problem= || problem="bits differ"
	verdict "$1 -std=c99 -O2" "$problem"
	rm -r "${work:?}/$1"
}

# What a C++ user sees, and all kernels, also pass -Wold-style-cast; the files of the runtime are C
# and cast.
test_casts() {
	has "$1" || { skip "casts of $1" "not installed"; return; }
	verdict "casts of $1" "$(for file in "$work"/small/*.c; do
		case $file in *_dispatch.c | *_rings.c | *_columns.c | *_raster*.c) continue ;; esac
		"$1" -x c++ -std=c++17 -Wold-style-cast -Werror -fsyntax-only "$file" 2>&1
	done | grep -m 1 error)"
}

test_tcc() {
	has tcc || { skip tcc "not installed"; return; }
	mkdir "$work/tcc"
	for file in "$build"/emitted/*.c "$tests/hash.c"; do
		tcc -Wall -Werror -I"$build/emitted" -c -o "$work/tcc/$(basename "$file" .c).o" \
			"$file" 2>&1
	done >"$work/log"
	if [ -s "$work/log" ] ||
	   ! tcc -o "$work/tcc/hash" "$work"/tcc/*.o -lm >"$work/log" 2>&1; then
		verdict tcc "does not compile: $(head -n 1 "$work/log")"
	elif "$work/tcc/hash" >"$work/got"
	     grep -E '^(portable|edges|box)' "$work/want.whole" | uniq | cmp -s - "$work/got"; then
		verdict tcc
	else
		verdict tcc "bits differ: $(tr '\n' ' ' <"$work/got")"
	fi
}

"$build/gen" --quiet --max-degree 2 --out "$work/small" || exit 1
test_promises gcc
test_promises clang
if [ ! -s "$work/want.whole" ]; then
	verdict matrix "no compiler builds $build/emitted"
	finish
	exit 1
fi
grep -q '^fma' "$work/want.whole" || skip "bits of fma" "this CPU has no fused multiply-add"
for cc in gcc g++ clang clang++; do
	has $cc || skip $cc "not installed"
done
combinations >"$work/list"
while read -r combination; do
	run_combination $combination
	verdict "$combination" "$(judge "$combination")"
done <"$work/list"
test_casts clang++
test_casts g++
test_tcc
finish

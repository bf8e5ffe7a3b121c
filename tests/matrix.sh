#!/bin/sh
# matrix.sh [BUILD] - compiles the emitted folder with every compiler there is and
# compares the bits of its results.
#
# Each language standard meets each level of optimisation where it can matter: c99,
# gnu11 and c++17 at -O0 to -O3, c11 and c17, which add nothing the folder uses, at -O0 and -O2
# (warnings of the front end, warnings of the optimiser). -march=native goes with gnu11 and c++17,
# which let gcc contract a * b + c by default; gcc is told to on top of it. clang is not:
# its -ffp-contract=fast overrides the pragma in the source by definition. Warnings are errors
# throughout. The hashes that tests/hash.c prints must not depend on any of this; tcc, which has
# no FMA, must agree on the rest.
set -u
build=${1:-build}
tests=$(dirname "$0")
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
passed=0 failed=0
ok() { passed=$((passed + 1)); echo "ok $1"; }
not_ok() { failed=$((failed + 1)); echo "not ok $1: $2"; }
has() { command -v "$1" >/dev/null 2>&1; }

STRICT="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wundef -Wdouble-promotion -Wcast-qual"
STRICT="$STRICT -Werror"
SECONDS_ALLOWED=90          # promised: 30 on one core; a loaded machine gets three times that

# compile DIRECTORY COMPILER FLAGS...: objects, then the program `hash`
compile() {
	mkdir -p "$1" || return 1
	cp "$build"/emitted/* "$tests/hash.c" "$1" || return 1
	( cd "$1" && shift && "$@" -c ./*.c && "$1" -o hash ./*.o -lm )
}

run_combination() {
	name=$(echo "$*" | tr -d ' /')
	compile "$work/$name" "$@" $STRICT >"$work/$name.log" 2>&1 &&
		"$work/$name/hash" >"$work/$name.out" 2>&1
	echo $? >"$work/$name.status"
	rm -rf "${work:?}/$name"
}

combinations() {
	for cc in gcc clang; do
		has $cc || continue
		cxx=$(echo $cc | sed 's/gcc/g++/; s/clang/clang++/')
		contract=$(echo $cc | sed 's/gcc/-ffp-contract=fast/; s/clang//')
		for level in -O0 -O1 -O2 -O3; do
			echo "$cc -std=c99 $level"
			echo "$cc -std=gnu11 $level"
			has "$cxx" && echo "$cxx -x c++ -std=c++17 $level"
		done
		for level in -O0 -O2; do
			echo "$cc -std=c11 $level"
			echo "$cc -std=c17 $level"
		done
		for level in -O2 -O3; do
			echo "$cc -std=gnu11 $level -march=native $contract"
			has "$cxx" && echo "$cxx -x c++ -std=c++17 $level -march=native $contract"
		done
	done
}

# worker REMAINDER: every second combination
worker() {
	awk -v r="$1" 'NR % 2 == r' "$work/list" | while read -r combination; do
		run_combination $combination
	done
}

judge() {
	name=$(echo "$1" | tr -d ' /')
	if [ "$(cat "$work/$name.status")" -ne 0 ]; then
		not_ok "$1" "$(grep -E -m 1 'error|warning' "$work/$name.log" ||
			tail -n 1 "$work/$name.log")"
	elif ! cmp -s "$work/$name.out" "$work/want"; then
		not_ok "$1" "bits differ: $(tr '\n' ' ' <"$work/$name.out")instead of $(
			tr '\n' ' ' <"$work/want")"
	else
		ok "$1"
	fi
}

# One core, all files, warnings as errors; the time is printed.
test_seconds() {
	has "$1" || { echo "skip seconds of $1: not installed"; return; }
	start=$(date +%s)
	if ! compile "$work/$1" "$1" -std=c99 -O2 $STRICT >"$work/log" 2>&1; then
		not_ok "seconds of $1 -O2" "$(grep -E -m 1 'error|warning' "$work/log")"
	elif seconds=$(($(date +%s) - start)) && [ $seconds -gt $SECONDS_ALLOWED ]; then
		not_ok "seconds of $1 -O2" "$seconds s, allowed $SECONDS_ALLOWED"
	else
		ok "seconds of $1 -O2: $seconds"
		[ -s "$work/want" ] || "$work/$1/hash" >"$work/want"
	fi
}

# What a C++ user sees, and all kernels, also pass -Wold-style-cast; the two driver files
# of the runtime are C and cast.
test_casts() {
	has "$1" || { echo "skip casts of $1: not installed"; return; }
	log=$(for file in "$build"/emitted/*.c; do
		case $file in *_dispatch.c | *_rings.c) continue ;; esac
		"$1" -x c++ -std=c++17 -Wold-style-cast -Werror -fsyntax-only "$file" 2>&1
	done) && [ -z "$log" ] && ok "casts of $1" ||
		not_ok "casts of $1" "$(echo "$log" | grep -m 1 error)"
}

test_tcc() {
	has tcc || { echo "skip tcc: not installed"; return; }
	mkdir "$work/tcc"
	for file in "$build"/emitted/*.c "$tests/hash.c"; do
		tcc -Wall -Werror -I"$build/emitted" -c -o "$work/tcc/$(basename "$file" .c).o" \
			"$file" 2>&1
	done >"$work/log"
	if [ -s "$work/log" ] ||
	   ! tcc -o "$work/tcc/hash" "$work"/tcc/*.o -lm >"$work/log" 2>&1; then
		not_ok tcc "$(head -n 1 "$work/log")"
	elif "$work/tcc/hash" >"$work/got"; grep -E '^(portable|edges)' "$work/want" | cmp -s - "$work/got"; then
		ok tcc
	else
		not_ok tcc "bits differ: $(tr '\n' ' ' <"$work/got")"
	fi
}

test_seconds gcc
test_seconds clang
if [ ! -s "$work/want" ]; then
	echo "not ok matrix: no compiler builds $build/emitted"
	echo "0 passed, 1 failed"
	exit 1
fi
grep -q '^fma' "$work/want" || echo "skip bits of fma: this CPU has no fused multiply-add"
for cc in gcc g++ clang clang++; do
	has $cc || echo "skip $cc: not installed"
done
combinations >"$work/list"
worker 0 &
worker 1
wait
while read -r combination; do
	judge "$combination"
done <"$work/list"
test_casts g++
test_casts clang++
test_tcc
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]

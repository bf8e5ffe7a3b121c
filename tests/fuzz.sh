#!/bin/sh
# fuzz.sh - libFuzzer on ew_path_moments, with address and undefined-behaviour sanitizers.
#
#     sh tests/fuzz.sh BUILD [RUNS [SEED]]
#
# What reads a path, edgewise_rings.c, is compiled for it; kernels read only what that has gathered
# and come from the library of BUILD (tests/kernels.c runs them between guard pages). A finding is
# left in BUILD/tests/path_fuzz.finding. FUZZ_CC is a clang with libFuzzer (Debian:
# libclang-rt-14-dev).
set -u
build=${1:-build}
runs=${2:-100000}
seed=${3:-1}
: "${FUZZ_CC:=clang}"
. "$(dirname "$0")/verdict.sh"
finding=$build/tests/path_fuzz.finding

# Prints why it cannot be done here, if so.
why_not() {
	has "$FUZZ_CC" || { echo "no $FUZZ_CC"; return; }
	printf '%s\n' '#include <stddef.h>' '#include <stdint.h>' \
		'int LLVMFuzzerTestOneInput(const uint8_t *d, size_t n);' \
		'int LLVMFuzzerTestOneInput(const uint8_t *d, size_t n) { return d + n ? 0 : 0; }' \
		>"$work/empty.c"
	"$FUZZ_CC" -fsanitize=fuzzer,address,undefined -o "$work/empty" "$work/empty.c" \
		2>"$work/log" && "$work/empty" -runs=1 >"$work/log" 2>&1 ||
		echo "$FUZZ_CC has no fuzzer runtime"
}

# The harness is not traced, so that the library alone says what is new.
compile() {
	sanitize=-fsanitize=address,undefined
	set -- -std=gnu11 -O1 -g -ffp-contract=off -fno-sanitize-recover=all "$sanitize"
	"$FUZZ_CC" "$@" -fsanitize=fuzzer-no-link -c -o "$work/rings.o" \
		"$build/emitted/edgewise_rings.c" &&
		"$FUZZ_CC" "$@" -I"$build/emitted" -c -o "$work/fuzz.o" "$tests/path_fuzz.c" &&
		"$FUZZ_CC" "$sanitize" -fsanitize=fuzzer -o "$work/path_fuzz" "$work/fuzz.o" \
			"$work/rings.o" "$build/libedgewise.a" -lm
}

reason=$(why_not)
if [ -n "$reason" ]; then
	skip "fuzzing of paths" "$reason"
elif ! compile 2>"$work/log"; then
	verdict "fuzzing of paths" "does not compile: $(grep -m 1 error "$work/log")"
else
	mkdir -p "$build/tests" "$work/corpus"
	rm -f "$finding"
	"$work/path_fuzz" -runs="$runs" -seed="$seed" -max_len=4096 -len_control=20 -timeout=20 \
		-exact_artifact_path="$finding" "$work/corpus" >"$work/log" 2>&1
	status=$?
	grep '^Done' "$work/log"
	problem=
	if [ $status -ne 0 ]; then
		problem=$(grep -m 1 -E 'ERROR|runtime error|: (float|double), degree' "$work/log")
		problem="$problem, see $finding"
	fi
	verdict "fuzzing of paths, $runs runs" "$problem"
fi
finish

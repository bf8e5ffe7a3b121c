#!/bin/sh
# fuzz.sh - libFuzzer on ew_path_moments, with address and undefined-behaviour sanitizers.
#
#     sh tests/fuzz.sh BUILD [RUNS [SEED]]
#
# What reads a path, edgewise_rings.c, is compiled for it; kernels read only what that has gathered
# and come from the library of BUILD (tests/kernels.c runs them between guard pages). A finding is
# left in BUILD/tests/path_fuzz.finding.
set -u
runs=${2:-100000}
. "$(dirname "$0")/verdict.sh"
. "$tests/fuzzing.sh"
finding=$findings/path_fuzz.finding

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

reason=$(why_no_libfuzzer)
if [ -n "$reason" ]; then
	skip "fuzzing of paths" "$reason"
elif ! compile 2>"$work/log"; then
	verdict "fuzzing of paths" "does not compile: $(grep -m 1 error "$work/log")"
else
	rm -f "$finding"
	libfuzzer "$work/path_fuzz" -max_len=4096
	conclude "fuzzing of paths, $runs runs" $? ': (float|double), degree'
fi
finish

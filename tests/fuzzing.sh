# fuzzing.sh - what the suites that fuzz share; they source it after verdict.sh.
#
#     sh tests/SUITE.sh BUILD [RUNS [SEED]]
#
# RUNS, which the suite has set, are how many inputs are tried, SEED says which. $work/corpus is for
# inputs to begin with, $findings is the folder for those that fail, $finding the file that the
# suite chose there. FUZZ_CC is a clang with libFuzzer (Debian: libclang-rt-14-dev).

build=${1:-build}
seed=${3:-1}
: "${FUZZ_CC:=clang}"
mkdir -p "$build/tests" "$work/corpus"
findings=$(cd "$build/tests" && pwd)

# Prints why there is no libFuzzer here, if so.
why_no_libfuzzer() {
	has "$FUZZ_CC" || { echo "no $FUZZ_CC"; return; }
	printf '%s\n' '#include <stddef.h>' '#include <stdint.h>' \
		'int LLVMFuzzerTestOneInput(const uint8_t *d, size_t n);' \
		'int LLVMFuzzerTestOneInput(const uint8_t *d, size_t n) { return d + n ? 0 : 0; }' \
		>"$work/empty.c"
	"$FUZZ_CC" -fsanitize=fuzzer,address,undefined -o "$work/empty" "$work/empty.c" \
		2>"$work/log" && "$work/empty" -runs=1 >"$work/log" 2>&1 ||
		echo "$FUZZ_CC has no fuzzer runtime"
}

# PROGRAM OPTION...: runs it on the corpus and what comes of it. Leaves its log, and the input that
# failed, if one did.
libfuzzer() {
	"$@" -runs="$runs" -seed="$seed" -len_control=20 -timeout=20 \
		-exact_artifact_path="$finding" "$work/corpus" >"$work/log" 2>&1
}

# NAME STATUS COMPLAINT: of the run that left its log; COMPLAINT is how the harness says what is
# wrong.
conclude() {
	grep '^Done' "$work/log"
	problem=
	if [ "$2" -ne 0 ]; then
		problem=$(grep -a -m 1 -E "ERROR|runtime error|$3" "$work/log")
		problem="$problem, see $finding"
	fi
	verdict "$1" "$problem"
}

#!/bin/sh
# filter_fuzz.sh - fuzzing of the reader of filter files, with address and undefined-behaviour
# sanitizers.
#
#     sh tests/filter_fuzz.sh BUILD [RUNS [SEED]]
#
# By libFuzzer, if FUZZ_CC has it, and by a driver without feedback, compiled by CC. Both begin with
# the built-in filters and those below. A finding is left in BUILD/tests/filter_fuzz.finding.
set -u
runs=${2:-30000}
. "$(dirname "$0")/verdict.sh"
. "$tests/fuzzing.sh"
finding=$findings/filter_fuzz.finding
complaint='internal error|: input: '
words=$tests/filter_fuzz.dict
longest=400
sanitize='-fsanitize=address,undefined -fno-sanitize-recover=all'
wrap=-Wl,--wrap=fatal,--wrap=reading,--wrap=allocate,--wrap=realloc,--wrap=free
traced='expression analysis filter'
plain='util rational polynomial'

seeds() {
	cp "$root"/gen/filters/*.filter "$work/corpus"
	printf '%s\n' 'filter soft' bivariate 'piece 0 1 0 1 : (1-x)*(1-y)' \
		'piece -1 0 0 1 : (1+x)*(1-y)' 'piece 0 1 -1 0 : (1-x)*(1+y)' \
		'piece -1 0 -1 0 : (1+x)*(1+y)' >"$work/corpus/soft"
	printf '%s\n' 'filter steep' separable 'piece -1/2 0.75 : ((x + 1/3)*x)^5' \
		'piece 1 3/2 : -x^32/10^30' >"$work/corpus/steep"
}

# COMPILER TRACE: all that is linked, into $work/*.o; TRACE is for the reader and the analysis.
compile() {
	for file in $traced $plain; do
		trace=
		case " $traced " in *" $file "*) trace=$2 ;; esac
		# shellcheck disable=SC2086
		"$1" -std=c11 -D_POSIX_C_SOURCE=200809L -O2 -g $sanitize $trace -c \
			-o "$work/$file.o" "$root/gen/$file.c" || return 1
	done
	# shellcheck disable=SC2086
	"$1" -std=c11 -O1 -Wno-overlength-strings $sanitize -I"$root/gen" -c \
		-o "$work/embedded.o" "$build/obj/embedded_filters.c" &&
		"$1" -std=gnu11 -O2 -g $sanitize -c -o "$work/harness.o" "$tests/filter_fuzz.c"
}

with_libfuzzer() {
	reason=$(why_no_libfuzzer)
	if [ -n "$reason" ]; then
		skip "fuzzing of filter files" "$reason"
	elif ! compile "$FUZZ_CC" -fsanitize=fuzzer-no-link 2>"$work/log" ||
		! "$FUZZ_CC" -fsanitize=fuzzer,address,undefined $wrap -o "$work/fuzz" \
			"$work"/*.o 2>"$work/log"; then
		verdict "fuzzing of filter files" "does not compile: $(grep -m 1 error "$work/log")"
	else
		libfuzzer "$work/fuzz" -max_len=$longest -dict="$words"
		conclude "fuzzing of filter files, $runs runs" $? "$complaint"
	fi
}

with_driver() {
	cc=${CC:-cc}
	if ! echo 'int main(void) { return 0; }' | "$cc" -x c -fsanitize=address,undefined \
		-o "$work/empty" - 2>"$work/log" || ! "$work/empty"; then
		skip "mutated filter files" "$cc has no sanitizers"
	elif ! compile "$cc" '' 2>"$work/log" ||
		! "$cc" -fsanitize=address,undefined $wrap -o "$work/driven" "$work"/*.o \
			"$tests/fuzz_driver.c" 2>"$work/log"; then
		verdict "mutated filter files" "does not compile: $(grep -m 1 error "$work/log")"
	else
		seeds
		(cd "$work" && ./driven "$runs" "$seed" $longest "$words" corpus/*) \
			>"$work/log" 2>&1
		status=$?
		[ $status -eq 0 ] || mv "$work/fuzz.input" "$finding"
		conclude "mutated filter files, $runs runs" $status "$complaint"
	fi
}

rm -f "$finding"
seeds
with_libfuzzer
rm -f "$work"/*.o "$work"/corpus/*
with_driver
finish

#!/bin/sh
# run.sh - runs test suites, as many at a time as there are cores, and adds up what they say.
#
#     sh tests/run.sh LOGS 'NAME: COMMAND' ...
#
# A suite prints `ok NAME`, `not ok NAME: why`, `skip NAME: why` and last `N passed, N failed`.
# Its output goes to LOGS/NAME.log; failures and skips are shown when it ends, and the seconds for
# which it kept a core busy. A suite that ends without that last line, or with a status that
# contradicts it, counts as one failure more. The last line of all is the sum. Suites start in the
# order given: those that take long come first, so that no core waits for them at the end.

# LOGS 'NAME: COMMAND': runs it, and prints what there is to say of it.
report() {
	name=${2%%:*}
	log=$1/$name.log
	sh -c "${2#*: }" >"$log" 2>&1 </dev/null
	status=$?
	times >"$1/$name.times"
	last=$(tail -n 1 "$log")
	ok=$(expr "$last" : '\([0-9][0-9]*\) passed, [0-9][0-9]* failed$')
	bad=$(expr "$last" : '[0-9][0-9]* passed, \([0-9][0-9]*\) failed$')
	if [ -z "$ok" ] || { [ "$bad" -eq 0 ] && [ $status -ne 0 ]; }; then
		echo "suite $name: ended with status $status; the end of $log:"
		tail -n 20 "$log"
		bad=$((${bad:-0} + 1))
	fi
	grep -E '^(not ok|skip) ' "$log"
	busy=$(awk -F '[ms ]+' 'NR == 2 { print int(60 * ($1 + $3) + $2 + $4) }' "$1/$name.times")
	echo "suite $name: ${ok:-0} passed, $bad failed ($busy s)"
}

if [ "$1" = one ]; then                              # how it calls itself
	report "$2" "$3" >"$2/${3%%:*}.report"
	cat "$2/${3%%:*}.report"
	exit 0
fi
logs=$1
shift
mkdir -p "$logs"
rm -f "$logs"/*.report
printf '%s\0' "$@" | xargs -0 -n 1 -P "$(nproc 2>/dev/null || echo 1)" sh "$0" one "$logs"
cat "$logs"/*.report | awk -v suites=$# '
	/^suite .* passed, .* failed \(/ { reports++; passed += $3; failed += $5 }
	END {
		failed += suites - reports
		print passed + 0 " passed, " failed + 0 " failed"
		exit failed > 0
	}'

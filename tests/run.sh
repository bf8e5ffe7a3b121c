#!/bin/sh
# run.sh - runs test suites and adds up what they say.
#
#     sh tests/run.sh LOGS 'NAME: COMMAND' ...
#
# A suite prints `ok NAME`, `not ok NAME: why`, `skip NAME: why` and last `N passed, N failed`.
# Its output goes to LOGS/NAME.log; failures and skips are shown here. A suite that ends
# without that last line, or with a status that contradicts it, counts as one failure more.
# The last line of all is the sum.

logs=$1
shift
mkdir -p "$logs"
passed=0
failed=0
for suite in "$@"; do
	name=${suite%%:*}
	log=$logs/$name.log
	start=$(date +%s)
	sh -c "${suite#*: }" >"$log" 2>&1 </dev/null
	status=$?
	last=$(tail -n 1 "$log")
	ok=$(expr "$last" : '\([0-9][0-9]*\) passed, [0-9][0-9]* failed$')
	bad=$(expr "$last" : '[0-9][0-9]* passed, \([0-9][0-9]*\) failed$')
	if [ -z "$ok" ] || { [ "$bad" -eq 0 ] && [ $status -ne 0 ]; }; then
		echo "suite $name: ended with status $status; the end of $log:"
		tail -n 20 "$log"
		failed=$((failed + 1))
	fi
	grep -E '^(not ok|skip) ' "$log"
	echo "suite $name: ${ok:-0} passed, ${bad:-0} failed ($(($(date +%s) - start)) s)"
	passed=$((passed + ${ok:-0}))
	failed=$((failed + ${bad:-0}))
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]

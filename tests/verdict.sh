# verdict.sh - what the suites of shell share; they source it.
#
# $work is a folder for the suite, removed at its end; $tests and $root are this folder and that of
# the project, and $sanitize is what a program needs that links with a library made with SAN=1.
# `verdict` and `skip` say what came out of one test, `finish` says the last line of the suite.
# What another program printed in that manner is counted by `replay FILE`.

tests=$(cd "$(dirname "$0")" && pwd)
root=$(dirname "$tests")
sanitize=${SAN:+-fsanitize=address,undefined}
unset MAKEFLAGS MFLAGS MAKELEVEL SAN
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
passed=0
failed=0

# NAME [PROBLEM]: it failed if there is a problem.
verdict() {
	if [ -z "${2:-}" ]; then
		passed=$((passed + 1))
		echo "ok $1"
	else
		failed=$((failed + 1))
		echo "not ok $1: $2"
	fi
}

skip() {
	echo "skip $1: $2"
}

has() {
	command -v "$1" >/dev/null 2>&1
}

# MODULE: a python that has it, or nothing
python_with() {
	for candidate in python3 /usr/bin/python3; do
		! "$candidate" -c "import $1" 2>/dev/null || { echo "$candidate"; return; }
	done
}

# FILE: shows the verdicts in it, and counts them.
replay() {
	cat "$1"
	passed=$((passed + $(grep -c '^ok ' "$1")))
	failed=$((failed + $(grep -c '^not ok ' "$1")))
}

# The last line; fails if a test has failed.
finish() {
	echo "$passed passed, $failed failed"
	[ $failed -eq 0 ]
}

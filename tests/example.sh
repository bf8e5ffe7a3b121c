# example.sh - what the suites of the examples share; they source it after verdict.sh.
#
# $program is the example.

# NAME FILE: counts the verdicts in the output of a program, each under NAME.
under() {
	tail -n 1 "$2" | grep -q '^[0-9]* passed, [0-9]* failed$' \
		|| echo "not ok end: $(tail -n 1 "$2")" >>"$2"
	sed -n -e "s/^# /# $1: /p" -e "s/^ok /ok $1, /p" -e "s/^not ok /not ok $1, /p" "$2" \
		>"$work/renamed"
	replay "$work/renamed"
}

# STATUS PATTERN ARGUMENTS...: sets $problem unless the program fails so, says so, and prints
# nothing else.
try_error() {
	status=$1
	pattern=$2
	shift 2
	problem=
	got=0
	"$program" "$@" >"$work/stdout" 2>"$work/stderr" </dev/null || got=$?
	if [ $got -ne "$status" ]; then
		problem="status $got, not $status: $(head -n 1 "$work/stderr")"
	elif ! grep -qF -e "$pattern" "$work/stderr"; then
		problem="no word of '$pattern' in: $(head -n 1 "$work/stderr")"
	elif [ -s "$work/stdout" ]; then
		problem="standard output says $(head -n 1 "$work/stdout")"
	fi
}

# NAME STATUS PATTERN ARGUMENTS...
expect_error() {
	name=$1
	shift
	try_error "$@"
	verdict "$name" "$problem"
}

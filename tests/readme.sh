#!/bin/sh
# readme.sh - what stands in README.md happens.
#
#     sh tests/readme.sh BUILD
#
# Its program prints what it says, other C compiles as the body of one, what it says to type for
# vendoring stands in tests/vendor, where it is run, and each command of gen is accepted. Pictures
# and files that it names exist.

build=$(cd "${1:-build}" && pwd)
. "$(dirname "$0")/verdict.sh"
readme=$root/README.md

# KIND: writes KIND.1, KIND.2, ... of what stands between ```KIND and ```.
split_blocks() {
	awk -v kind="$1" -v start="$work/$1." '
		$0 == "```" kind { count++; file = start count; next }
		/^```/ { file = ""; next }
		file != "" { print >file }' "$readme"
}

# SOURCE: compiled and run; what it prints is in $work/have.
run_c() {
	${CC:-cc} $sanitize -Wall -Wextra -Wno-unused-but-set-variable -Werror -I"$build/emitted" \
		-o "$work/use" "$1" "$build/libedgewise.a" -lm 2>"$work/log" &&
		"$work/use" >"$work/have"
}

check_program() {
	awk '
		/^```$/ { after = 1; next }
		after && /^    / { print substr($0, 5); next }
		after && NF { exit }' "$readme" >"$work/want"
	cp "$work/c.1" "$work/program.c"
	run_c "$work/program.c" && [ -s "$work/want" ] && diff "$work/want" "$work/have" >>"$work/log"
	verdict "the program in README.md" "$([ -s "$work/want" ] || echo "it prints nothing")$(
		tr '\n' ' ' <"$work/log")"
}

# Statements, as the body of a program.
check_snippet() {
	{
		printf '#include <stdio.h>\n#include "edgewise.h"\nint main(void)\n{\n'
		cat "$1"
		printf '\treturn 0;\n}\n'
	} >"$work/snippet.c"
	run_c "$work/snippet.c"
	verdict "C: $(grep -om 1 'ew_[a-z_0-9]*(' "$1"))" "$(head -n 4 "$work/log" | tr '\n' ' ')"
}

# Lines of commands, without their comments: those of a user's build stand in tests/vendor, those
# of gen are asked what they would write.
commands() {
	sed -n 's/^    \(\(edgewise-gen\|cc\|c++\|gen\|pkg-config\) .*\)/\1/p' "$readme" |
		sed 's/  *#.*//'
}

check_commands() {
	printf 'filter my\nseparable\npiece 0 1 : 1\n' >"$work/my.filter"
	commands | while read -r command; do
		case $command in
		gen\ *)
			problem=$(cd "$work" && eval "'$build/gen' ${command#gen} --dry-run" \
				2>&1 >/dev/null) ;;
		*)
			problem=$(grep -qxF -e "$command" "$tests"/vendor/*/*.commands ||
				echo "no file in tests/vendor has it") ;;
		esac
		verdict "command: $command" "$problem"
	done >"$work/commands"
	replay "$work/commands"
	verdict "commands in README.md" "$([ "$(wc -l <"$work/commands")" -gt 8 ] ||
		echo "only $(wc -l <"$work/commands")")"
}

# A text for CMake is part of a project that is built.
check_cmake() {
	awk 'NR == FNR { want = want $0 "\n"; next } { have = have $0 "\n" }
		END { exit index(have, want) == 0 }' "$work/cmake.1" \
		"$tests/vendor/hat/CMakeLists.txt"
	verdict "the text for CMake" "$([ $? -eq 0 ] || echo "not in tests/vendor/hat")"
}

check_links() {
	grep -oE '\]\([^)#:]*\)' "$readme" | tr -d '])(' | sort -u | while read -r file; do
		verdict "link to $file" "$([ -e "$root/$file" ] || echo "not there")"
	done >"$work/links"
	replay "$work/links"
}

split_blocks c
split_blocks cmake
check_program
for block in "$work"/c.[2-9]; do
	check_snippet "$block"
done
check_commands
check_cmake
check_links
finish

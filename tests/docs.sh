#!/bin/sh
# docs.sh - the manual pages, and completion in bash.
#
#     sh tests/docs.sh BUILD
#
# The pages are clean for mandoc, name every option, word and function that there is and no other,
# and what stands in their examples happens: commands after $ print what follows them, C programs
# print what the next example shows. Completion is asked as bash would ask it.

build=$(cd "${1:-build}" && pwd)
. "$(dirname "$0")/verdict.sh"
LC_ALL=C
export LC_ALL
page1=$root/gen/edgewise-gen.1
page3=$root/runtime/edgewise.3
completion=$root/gen/edgewise-gen.bash
mkdir "$work/bin" "$work/here"
ln -s "$build/gen" "$work/bin/edgewise-gen"
PATH=$work/bin:$PATH
compiler=${CC:-cc}

# NAME WANTED GOT: files of sorted lines that should be the same.
expect_same() {
	verdict "$1" "$(comm -3 "$2" "$3" | awk -F'\t' '
		{ print ($1 == "" ? "not there: " $2 : "missing: " $1) }' | tr '\n' ' ')"
}

# ---- the pages ----

# Whether other pages are installed says nothing about these.
lint() {
	name="mandoc on $(basename "$1")"
	if has mandoc; then
		mandoc -T lint -W style "$1" 2>&1 |
			grep -vE 'referenced manual not found|outdated mandoc.db' >"$work/lint"
		verdict "$name" "$(head -n 1 "$work/lint")"
	else
		skip "$name" "there is no mandoc (make deps installs it)"
	fi
}

# Options that begin a line of --help, or follow another one there; the page's of .It Fl.
list_options() {
	edgewise-gen --help |
		awk '/^  -/ { for (i = 1; $i ~ /^-/; i++) { sub(/,$/, "", $i); print $i } }' |
		sort -u >"$work/help"
	sed -n 's/^\.It Fl \([a-z-]*\).*/-\1/p' "$page1" | sort -u >"$work/page"
}

# The words of lists, schemes and filters stand in the page as words.
check_words() {
	edgewise-gen --list | sed -n 's/^[a-z]*: //p' | tr ' ' '\n' | sort -u >"$work/words"
	sed -n 's/^\.Cm \([a-z0-9-]*\).*/\1/p' "$page1" | sort -u >"$work/marked"
	verdict "words of lists in $(basename "$page1")" "$(comm -23 "$work/words" \
		"$work/marked" | tr '\n' ' ')"
}

# Functions of prototypes.txt beside those that the index lists, filters by their pattern.
check_functions() {
	sed -n 's/^[a-z][^#]*\(ew_[A-Za-z0-9_]*\)[(;].*/\1/p' "$tests/prototypes.txt" |
		sort -u >"$work/functions"
	echo ew_line_xMyN >>"$work/functions"
	sort -o "$work/functions" "$work/functions"
	sed -n '/^\.Sh FUNCTIONS/,/^\.Sh RETURN/p' "$page3" | grep -E '^\.It (Fn|Va) ' |
		grep -oE 'ew_[A-Za-z0-9_]*' | sort >"$work/index"
	expect_same "functions in $(basename "$page3")" "$work/functions" "$work/index"
	verdict "no function twice" "$(uniq -d "$work/index" | tr '\n' ' ')"
}

# Return codes of the header beside those of the page.
check_codes() {
	grep -oE 'EW_(OK|BAD_[A-Z]*|ZERO_AREA|NO_MEMORY|UNSUPPORTED)' "$build/emitted/edgewise.h" |
		sort -u | grep -v EW_OK >"$work/codes"
	sed -n 's/^\.It Dv \(EW_[A-Z_]*\)$/\1/p' "$page3" | sort >"$work/described"
	expect_same "return codes in $(basename "$page3")" "$work/codes" "$work/described"
}

# ---- their examples ----

# PAGE: writes block.1, block.2, ... of what stands between .Bd -literal and .Ed.
split_blocks() {
	rm -f "$work"/block.*
	awk -v start="$work/block." '
		/^\.Bd -literal/ { count++; file = start count; next }
		/^\.Ed/ { file = ""; next }
		file != "" { gsub(/\\e/, "\\"); print >file }' "$1"
}

# FILE: a script of the commands, with what each must print behind a mark; here-documents end where
# they say.
session() {
	awk -v mark='@@' '
		/^\$ / { print mark > "/dev/stderr" }
		/^\$ / {
			command = substr($0, 3)
			print "echo " mark
			print command
			end = command ~ /<<END/ ? "END" : ""
			next
		}
		end != "" { print; if ($0 == end) end = ""; next }
		{ print > "/dev/stderr" }' "$1"
}

check_session() {
	session "$1" >"$work/script" 2>"$work/want"
	(cd "$work/here" && sh "$work/script") >"$work/have" 2>&1
	verdict "commands: $(sed -n '/^\$ /{s/^\$ //p;q}' "$1")" "$(diff "$work/want" \
		"$work/have" | head -n 4 | tr '\n' ' ')"
}

# PROGRAM WANT: compiled against the emitted folder.
check_program() {
	cp "$1" "$work/program.c"
	if "$compiler" -std=c99 -Wall -Wextra -Wpedantic -Werror -I"$build/emitted" \
		-o "$work/program" "$work/program.c" "$build/libedgewise.a" -lm 2>"$work/log"
	then
		"$work/program" | diff "$2" - >"$work/log"
	fi
	verdict "program: $(grep -om 1 'ew_[a-z_0-9]*(' "$1"))" \
		"$(head -n 4 "$work/log" | tr '\n' ' ')"
}

check_examples() {
	split_blocks "$1"
	seen=0
	for number in $(seq "$(ls "$work" | grep -c '^block\.')"); do
		block=$work/block.$number
		if grep -q '^\$ ' "$block"; then
			check_session "$block"
			seen=$((seen + 1))
		elif grep -q '^int main' "$block"; then
			check_program "$block" "$work/block.$((number + 1))"
			seen=$((seen + 1))
		fi
	done
	verdict "examples of $(basename "$1")" "$([ $seen -gt 2 ] || echo "$seen of them")"
}

# ---- completion ----

# NAME WANTED WORD...: what is offered for the last word. = is a word of its own, as bash parts it.
expect_reply() {
	name=$1
	wanted=$2
	shift 2
	got=$(cd "$work/files" && bash -c '
		source "$1"
		shift
		COMP_WORDS=("$@")
		COMP_CWORD=$(($# - 1))
		_edgewise_gen
		printf "%s\n" "${COMPREPLY[@]}" | sort | tr "\n" " "' \
		bash "$completion" edgewise-gen "$@" 2>&1)
	verdict "completion of $name" "$([ "${got% }" = "$wanted" ] || echo "it offers '$got'")"
}

# NAME: the words that --list has under it, each after PREFIX.
words() {
	edgewise-gen --list | sed -n "s/^$1: //p" | tr ' ' '\n' | sed "s/^/${2:-}/" | sort |
		tr '\n' ' ' | sed 's/ $//'
}

check_completion() {
	mkdir -p "$work/files/folder"
	touch "$work/files/my.filter" "$work/files/with blanks"
	builtin=$(edgewise-gen --list | sed -n 's/^  \([a-z0-9_]*\) .*/\1/p')
	expect_reply "nothing: every option" "$(tr '\n' ' ' <"$work/help" | sed 's/ $//')" ""
	expect_reply "--ma" "--manifest --max-degree" --ma
	expect_reply "a second option" "--quiet" --max-degree 4 --q
	for list in families edges targets; do
		expect_reply "--$list" "$(words $list)" --$list ""
	done
	expect_reply "--precision" "$(words precisions)" --precision ""
	expect_reply "--scheme" "$(words schemes)" --scheme ""
	expect_reply "--families cl" closure --families cl
	expect_reply "--families moments," "$(words families moments, | tr ' ' '\n' |
		grep -v ',moments$' | tr '\n' ' ' | sed 's/ $//')" --families moments,
	expect_reply "--edges line,c" "line,conic line,cubic" --edges line,c
	expect_reply "--edges=line,cu" "line,cubic" --edges = line,cu
	expect_reply "--edges=" "$(words edges)" --edges =
	expect_reply "--edges=line,cu in one word" "--edges=line,cubic" --edges=line,cu
	expect_reply "--filter" "$(echo "$builtin folder my.filter" | tr ' ' '\n' | sort |
		tr '\n' ' ')with blanks" --filter ""
	expect_reply "--filter m" "mitchell my.filter" --filter m
	expect_reply "--show=mi" "mitchell" --show = mi
	expect_reply "--out" "folder" --out ""
	expect_reply "--depfile" "folder my.filter with blanks" --depfile ""
	expect_reply "--format" "c json latex text" --format ""
	expect_reply "--max-degree" "" --max-degree ""
	expect_reply "what there is not" "" --frobnicate=x
}

lint "$page1"
lint "$page3"
list_options
expect_same "options in $(basename "$page1")" "$work/help" "$work/page"
check_words
check_functions
check_codes
check_examples "$page1"
check_examples "$page3"
if has bash; then
	check_completion
else
	skip "completion" "there is no bash"
fi
finish

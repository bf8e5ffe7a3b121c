#!/bin/sh
# pictures.sh - the pictures of the documentation: there, well-formed, for light and dark readers.
#
#     sh tests/pictures.sh BUILD
#
# The one that depends on no clock, bench/origin.svg, must be what its program writes; so must the
# plots of filters and the sheet, which render.sh looks at.

. "$(dirname "$0")/verdict.sh"
origin=$(cd "$1" && pwd)/origin
cd "$root" || exit 1

check_origin() {
	"$origin" "$work/origin.svg" >"$work/table" 2>"$work/stderr"
	verdict "origin: as committed" "$(cmp bench/origin.svg "$work/origin.svg" 2>&1)"
	"$origin" >"$work/again"
	verdict "origin: the same table without a picture" "$(cmp "$work/table" "$work/again" 2>&1)"
	mkdir "$work/folder"
	"$origin" "$work/folder" >"$work/table" 2>"$work/stderr"
	verdict "origin: not over a folder" "$([ $? -eq 1 ] && grep -q 'cannot write' "$work/stderr" \
		|| head -n 1 "$work/stderr")"
	"$origin" "$work/none/a.svg" >"$work/table" 2>"$work/stderr"
	verdict "origin: not into nowhere" "$([ $? -eq 1 ] && grep -q 'cannot write' "$work/stderr" \
		|| head -n 1 "$work/stderr")"
	"$origin" a b >"$work/table" 2>"$work/stderr"
	verdict "origin: one file at most" "$([ $? -eq 2 ] && grep -q '^usage' "$work/stderr" \
		|| head -n 1 "$work/stderr")"
	verdict "origin: nothing left behind" "$(ls "$work" "$work/folder" | grep '\.tmp$')"
}

# FILE: says what is wrong with it as XML.
parse() {
	if has xmllint; then
		xmllint --noout "$1" 2>&1 | head -n 1
	else
		python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' "$1" 2>&1 |
			tail -n 1
	fi
}

check_svg() {
	name=${1#./}
	if has xmllint || python3 -c 'import xml.dom.minidom' 2>/dev/null; then
		verdict "$name: well-formed" "$(parse "$1")"
	else
		skip "$name: well-formed" "there is neither xmllint nor python3"
	fi
	verdict "$name: light and dark" "$(grep -q 'prefers-color-scheme:dark' "$1" ||
		echo 'one scheme only')"
	verdict "$name: nothing from elsewhere" "$(grep -o '[a-z]*://[^"]*' "$1" |
		grep -v '^http://www.w3.org/2000/svg$')"
}

# Every picture that a text shows is there.
check_texts() {
	for text in README.md examples/*/README.md; do
		grep -o '([^() ]*\.\(svg\|png\))' "$text" | tr -d '()' | sort -u >"$work/shown"
		[ -s "$work/shown" ] || continue
		verdict "$text: its pictures" "$(while read -r picture; do
			[ -f "$(dirname "$text")/$picture" ] || echo "there is no $picture"
		done <"$work/shown")"
	done
}

check_origin
for svg in $(find bench examples -name '*.svg' | sort); do
	check_svg "$svg"
done
check_texts
finish

#!/bin/sh
# glyphs.sh - examples/glyphs on real fonts: TrueType (quads) and PostScript (cubics).
#
#     sh tests/glyphs.sh BUILD
#
# Of every font all glyphs are held against exact rationals (glyphs.c) and against fontTools' pen
# (glyphs.py); then come the table, the choice of glyphs and the errors of the command line.

. "$(dirname "$0")/verdict.sh"
. "$tests/example.sh"
glyphs=$(cd "$1" && pwd)/glyphs
program=$glyphs
exact=$(cd "$1" && pwd)/tests/glyphs
sans=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
serif=/usr/share/fonts/truetype/dejavu/DejaVuSerif.ttf
didot=/usr/share/fonts/opentype/didot/GFSDidot.otf

if [ ! -x "$glyphs" ]; then
	skip glyphs "no headers of FreeType (make deps installs them)"
	finish
	exit
fi

python=$(python_with fontTools.pens.statisticsPen)

# KIND FONT: every glyph; the outlines must have edges of that kind.
check_font() {
	name=$(basename "$2")
	if [ ! -f "$2" ]; then
		skip "$name" "there is no $2 (make deps installs it)"
		return
	fi
	"$glyphs" --exact "$2" --all >"$work/exact" 2>"$work/stderr"
	verdict "$name: every glyph" "$(head -n 1 "$work/stderr")"
	verdict "$name: $1s" "$(grep -q "^$1 " "$work/exact" || echo "the outlines have none")"
	"$exact" <"$work/exact" >"$work/verdicts" 2>&1
	under "$name exactly" "$work/verdicts"
	if [ -z "$python" ]; then
		skip "$name beside fontTools" "no python3 with fontTools (make deps installs it)"
		return
	fi
	PYTHONDONTWRITEBYTECODE=1 "$python" "$tests/glyphs.py" "$2" <"$work/exact" \
		>"$work/verdicts" 2>&1
	under "$name beside fontTools" "$work/verdicts"
}

# NAME WANTED ARGUMENTS...: the last words of the lines but the first, which are glyph names.
expect_names() {
	name=$1
	wanted=$2
	shift 2
	got=$("$glyphs" "$@" 2>&1 | awk 'NR > 1 { printf "%s ", $NF }')
	verdict "$name" "$([ "${got% }" = "$wanted" ] || echo "names are: $got")"
}

# The l is an upright bar: everything about it can be said from its corners.
check_table() {
	{
		"$glyphs" --exact "$sans" l
		"$glyphs" "$sans" l
	} | awk '
		/^move / { low_x = high_x = $2; low_y = high_y = $3 }
		/^line / {
			low_x = $2 < low_x ? $2 : low_x
			high_x = $2 > high_x ? $2 : high_x
			low_y = $3 < low_y ? $3 : low_y
			high_y = $3 > high_y ? $3 : high_y
		}
		/^glyph +code/ { for (i = 1; i <= NF; i++) column[$i] = i }
		END {
			w = high_x - low_x
			h = high_y - low_y
			want["area"] = -w * h
			want["meanX"] = (low_x + high_x) / 2
			want["meanY"] = (low_y + high_y) / 2
			want["varianceX"] = w * w / 12
			want["varianceY"] = h * h / 12
			want["stddevX"] = sqrt(w * w / 12)
			want["stddevY"] = sqrt(h * h / 12)
			want["covariance"] = want["correlation"] = want["slant"] = 0
			for (name in want) {
				difference = $column[name] - want[name]
				if (difference < 0) difference = -difference
				if (!(name in column) || difference > 0.06)
					print name " is " $column[name] ", not " want[name]
			}
			if ($2 != "U+006C" || $NF != "l" || w <= 0)
				print "the row is " $0
		}' >"$work/problems"
	verdict "table" "$(head -n 1 "$work/problems")"
}

check_choice() {
	expect_names "characters" "A eacute Euro u1F600" "$sans" 'Aé€😀'
	expect_names "a hyphen" "hyphen" "$sans" -
	expect_names "end of options" "hyphen hyphen" "$sans" -- --
	expect_names "options anywhere" "A" -- "$sans" A
	expect_names "no characters" "" "$sans" ""
	got=$("$glyphs" "$sans" | wc -l)
	verdict "default" "$([ "$got" -eq 63 ] || echo "$got lines, not 63")"
	got=$("$glyphs" --exact "$sans" --all | grep -c '^glyph ')
	rows=$("$glyphs" "$sans" --all | wc -l)
	verdict "rows of --all" "$([ "$rows" -eq $((got + 1)) ] || echo "$rows for $got glyphs")"
}

check_errors() {
	expect_error "no font" 2 "usage: glyphs"
	expect_error "unknown option" 2 "usage: glyphs" --frobnicate "$sans"
	expect_error "characters and --all" 2 "usage: glyphs" "$sans" A --all
	expect_error "three operands" 2 "usage: glyphs" "$sans" A B
	expect_error "missing file" 1 "cannot read $work/none: No such file" "$work/none"
	expect_error "a folder" 1 "cannot read $work: Is a directory" "$work"
	expect_error "an empty file" 1 "is not a font" /dev/null
	expect_error "not a font" 1 "README.md is not a font" "$root/README.md"
	head -c 100000 "$sans" >"$work/cut.ttf"
	expect_error "half a font" 1 "$work/cut.ttf is " "$work/cut.ttf"
	{
		head -c 300000 "$sans"
		head -c 100000 /dev/zero | tr '\0' '\377'
		tail -c +400001 "$sans"
	} >"$work/hurt.ttf"
	got=0
	"$glyphs" "$work/hurt.ttf" --all >"$work/stdout" 2>"$work/stderr" || got=$?
	verdict "a damaged glyph" "$([ $got -eq 1 ] && grep -q 'glyph [0-9]* is damaged' \
		"$work/stderr" || echo "status $got, $(head -n 1 "$work/stderr")")"
	expect_error "no such glyph" 1 "has no glyph for U+10FFFE" "$sans" \
		"$(printf 'A\364\217\277\276')"
	while read -r what bytes; do
		expect_error "not UTF-8, $what" 1 "not UTF-8 at byte 2" "$sans" \
			"$(printf 'A%b' "$bytes")"
	done <<-'END'
		continuation \0200
		long \0300\0200
		longer \0340\0200\0200
		cut \0342\0202
		surrogate \0355\0240\0200
		beyond \0364\0220\0200\0200
		byte \0377
	END
	"$glyphs" --help >"$work/stdout" 2>"$work/stderr"
	verdict "--help" "$(grep -q '^usage: glyphs' "$work/stdout" || cat "$work/stderr")"
	if [ -c /dev/full ]; then
		"$glyphs" "$sans" >/dev/full 2>"$work/stderr"
		verdict "a full disk" "$(grep -q 'cannot write' "$work/stderr" || echo "no word")"
	fi
}

check_font quad "$sans"
check_font quad "$serif"
check_font cubic "$didot"
if [ -f "$sans" ]; then
	check_table
	check_choice
	check_errors
else
	skip "command line" "there is no $sans (make deps installs it)"
fi
finish

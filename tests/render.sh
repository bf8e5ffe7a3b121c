#!/bin/sh
# render.sh - examples/render: glyphs, paths of SVG and maps, with every filter it has.
#
#     sh tests/render.sh BUILD
#
# Pixels are held against exact rationals, areas and each other (render.py, which reads PNG by
# itself), those of the custom filters (make filters) with the render that has them; then come the
# grammar of paths, the files, and the errors of the command line.

. "$(dirname "$0")/verdict.sh"
. "$tests/example.sh"
build=$(cd "$1" && pwd)
render=$build/render
program=$render
custom=$build/filters/render
plot=$build/plot
sans=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
didot=/usr/share/fonts/opentype/didot/GFSDidot.otf
countries=$root/examples/data/countries.txt

if [ ! -x "$render" ]; then
	skip render "no headers of FreeType and libpng (make deps installs them)"
	finish
	exit
fi
python=$(python_with zlib)

# NAME ARGUMENTS...: render must succeed without a word.
draw() {
	drawn=$1
	shift
	"$render" "$@" >"$work/output" 2>&1 && [ ! -s "$work/output" ] && return
	verdict "$drawn" "render says: $(head -n 1 "$work/output")"
	return 1
}

# NAME WHAT ARGUMENTS...: what render.py finds.
check() {
	checked=$1
	shift
	verdict "$checked" "$(PYTHONDONTWRITEBYTECODE=1 "$python" "$tests/render.py" "$@" 2>&1 |
		tail -n 1)"
}

# ---- pixels: with each of $filters ----

# On whole pixels, on half ones, on others, and reaching out of the picture.
check_rectangles() {
	for filter in $filters; do
		while read -r name x0 y0 x1 y1 mode; do
			draw "$filter, $name" --filter "$filter" $mode --view 0,0,32,24 --width 32 path \
				"M$x0 ${y0}H${x1}V${y1}H${x0}z" "$work/a.png" &&
			check "$filter, $name" rectangle "$filter" "$x0" "$y0" "$x1" "$y1" "$work/a.png"
		done <<-'END'
			whole 8 8 24 16
			half 8.5 7.5 23.5 16.5
			alpha 8.5 7.625 23.375 16.5 --rgba
			thin 9.25 4.375 9.75 20
			point 15.5 11.5 15.625 11.75
			outside -100 -1000 7.3125 50
			everything -64 -64 128 128
		END
	done
}

check_turns() {
	for filter in $filters; do
		draw "$filter, square" --filter "$filter" --view 0,0,24,24 --width 24 path \
			'M5.3 5.3H18.7V18.7H5.3z' "$work/a.png" &&
		check "$filter, symmetry" symmetric xyt "$work/a.png"
		draw "$filter, reversed" --filter "$filter" --view 0,0,24,24 --width 24 path \
			'M5.3 5.3V18.7H18.7V5.3z' "$work/b.png" &&
		verdict "$filter, reversed" "$(cmp "$work/a.png" "$work/b.png" 2>&1)"
		draw "$filter, both" --filter "$filter" --view 0,0,47,23 --width 47 path \
			'M5 5H18V18H5zM29 5V18H42V5z' "$work/a.png" &&
		check "$filter, both directions" symmetric y "$work/a.png"
	done
}

# Two triangles side by side: between them there is no sea, at no pixel.
check_seam() {
	printf 'shape A\nring\n0 0\n20 0\n20 20\nshape B\nring\n0 0\n20 20\n0 20\n' >"$work/two.txt"
	for filter in $filters; do
		draw "$filter, seam" --filter "$filter" --rgba --width 300 countries \
			"$work/two.txt" "$work/a.png" &&
		check "$filter, no seam" mixture e9c46a a3b18a 135 171 146 182 "$work/a.png"
	done
}

# Three squares, two of them the same: ink wherever any is, black or not.
check_overlap() {
	squares='M4 4H20V20H4zM8 4H24V20H8zM8 4H24V20H8z'
	draw "overlap" --view 0,0,32,24 --width 32 path "$squares" "$work/a.png" &&
	check "overlap counts once" rectangle box 4 4 24 20 "$work/a.png"
	draw "grey" --ink 808080 --view 0,0,32,24 --width 32 path "$squares" "$work/a.png" &&
	draw "grey" --ink 808080 --view 0,0,32,24 --width 32 path M4,4H24V20H4z "$work/b.png" &&
	check "overlap in grey" same 0 "$work/a.png" "$work/b.png"
}

# The custom filters are what the render with them has and the other one has not.
check_custom() {
	if [ ! -x "$custom" ]; then
		skip "custom filters" "there is no $custom (make filters)"
		return
	fi
	filters=$("$custom" --filters | grep -vxF -e "$("$render" --filters)")
	plain=$render
	render=$custom
	for file in "$root"/examples/filters/*.filter; do
		filter=$(sed -n 's/^filter //p' "$file")
		verdict "custom filter $filter" "$(echo "$filters" | grep -qx "$filter" ||
			echo "it is not in $custom")"
	done
	check_rectangles
	check_turns
	render=$plain
}

# ---- paths ----

# NAME LEVELS PATH PATH: the same coverage, to so many levels. 3 where curves are cut in other
# places: the library's lines are within 2^-8 pixels of both, along at most sqrt(2) pixels, which
# makes 2 sqrt(2) 255/256 levels, and both are rounded; 1 for a line written as a curve.
check_same() {
	draw "$1" --rgba --view 0,0,40,40 --width 40 path "$3" "$work/a.png" &&
	draw "$1" --rgba --view 0,0,40,40 --width 40 path "$4" "$work/b.png" &&
	check "path: $1" same "$2" "$work/a.png" "$work/b.png"
}

check_grammar() {
	check_same "relative lines" 0 'M5 5L25 5L25 25L5 25Z' 'm5 5 20 0 0 20-20 0z'
	check_same "H and V" 0 'M5 5L25 5L25 25L5 25Z' 'M5,5H25V25H5'
	check_same "h and v" 0 'M5 5L25 5L25 25L5 25Z' ' m5,5 h10 10 v 20 h-20 '
	check_same "numbers" 0 'M0.5 0.5L30 0.5L30 20.25L0.5 20.25Z' 'M.5.5 3e1.5+30,2025E-2.5 20.25z'
	check_same "spaces" 0 'M5 5L25 5L25 25Z' "M
		5	5 L 25,5
		,25 25 Z"
	check_same "S after C" 0 'M5 20C5 5 15 5 15 20C15 35 30 35 30 20z' \
		'M5 20C5 5 15 5 15 20S30 35 30 20z'
	check_same "S alone" 0 'M5 20C5 20 15 5 15 20z' 'M5 20S15 5 15 20z'
	check_same "s after c" 0 'M5 20C5 5 15 5 15 20C15 35 30 35 30 20z' \
		'm5 20c0-15 10-15 10 0s15 15 15 0z'
	check_same "T after Q" 0 'M5 20Q10 5 15 20Q20 35 25 20Q30 5 35 20z' 'M5 20Q10 5 15 20T25 20 35 20z'
	check_same "t after q" 0 'M5 20Q10 5 15 20Q20 35 25 20z' 'M5 20q5-15 10 0t10 0z'
	check_same "T alone" 1 'M5 20L20 5L30 20z' 'M5 20T20 5L30 20z'
	check_same "T after C" 1 'M5 20C5 5 15 5 15 20L30 30z' 'M5 20C5 5 15 5 15 20T30 30z'
	check_same "after z" 0 'M5 5L20 5L20 20ZM5 5L5 20L10 30Z' 'M5 5L20 5L20 20ZL5 20L10 30Z'
	check_same "m after z" 0 'M5 5L20 5L20 20ZM7 25L5 30L10 30Z' 'M5 5L20 5L20 20zm2 20l-2 5h5z'
	check_same "arc in two" 3 'M5 20A15 15 0 0 1 35 20z' 'M5 20A15 15 0 0 1 20 5A15 15 0 0 1 35 20z'
	check_same "arc's flags" 0 'M5 20A15 15 0 0 1 35 20z' 'M5 20A15 15 0 0135 20z'
	check_same "arc's radii too small" 3 'M5 20A15 15 0 0 1 35 20z' 'M5 20A3 3 0 0 1 35 20z'
	check_same "arc of no radius" 0 'M5 20L35 25L20 30z' 'M5 20A0 9 0 0 1 35 25L20 30z'
	check_same "arc to itself" 0 'M5 20L35 25L20 30z' 'M5 20A9 9 0 1 1 5 20L35 25L20 30z'
	check_same "arc turned by 90" 3 'M10 20A5 15 90 0 1 35 20z' 'M10 20A15 5 0 0 1 35 20z'
	check_same "arc turned by 180" 3 'M8 20A15 9 30 0 1 35 25z' 'M8 20a-15 9 210 0 1 27 5z'
	check_same "large arcs" 3 'M20 5A15 15 0 1 0 35 20L20 20z' 'M35 20A15 15 0 1 1 20 5L20 20z'
	# Half of an ellipse, and a circle in four kinds of arcs: pi a b.
	while read -r name area path; do
		draw "$name" --rgba --view 0,0,40,40 --width 40 path "$path" "$work/a.png" &&
		check "area: $name" area "$area" "$work/a.png"
	done <<-'END'
		circle 706.858347 M5,20A15,15,0,1,0,35,20A15,15,0,1,0,5,20z
		ellipse 320.442451 M4.2,15.8A17,6,15,1,1,35.8,24.2A17,6,15,0,1,4.2,15.8z
		quad 133.333333 M10,10Q20,30,30,10z
		cubic 240 M10,10C10,30,30,30,30,10z
	END
}

# ---- files ----

check_svg() {
	cat >"$work/a.svg" <<-'END'
		<?xml version="1.0"?>
		<!DOCTYPE svg>
		<!-- <path d="nonsense"/> -->
		<svg xmlns="http://www.w3.org/2000/svg" viewBox="-10 -20 64 48">
		<defs><clipPath id="c"><path d="M-10-20h64v48h-64z"/></clipPath></defs>
		<path fill="none" d="M-10-20h64v48h-64z"/>
		<g id="a>b"><path class='x' d='M-2 -4h32v16h-32z'/></g>
		</svg>
	END
	draw "viewBox" --width 32 svg "$work/a.svg" "$work/a.png" &&
	check "svg: viewBox" rectangle box 4 8 20 16 "$work/a.png"
	draw "width and height" --width 64 --height 24 svg "$work/a.svg" "$work/a.png" &&
	check "svg: in the middle" rectangle box 20 8 36 16 "$work/a.png"
	draw "no size" svg "$work/a.svg" "$work/a.png" &&
	check "svg: its own size" size 512 384 1 "$work/a.png"
	echo '<svg width="32" height="24px"><path d="M4 8h16v8h-16z"/></svg>' >"$work/b.svg"
	draw "width" --width 32 svg "$work/b.svg" "$work/a.png" &&
	check "svg: width for a viewBox" rectangle box 4 8 20 16 "$work/a.png"
}

check_countries() {
	if draw "world" --rgba --width 300 countries "$countries" "$work/a.png"; then
		check "countries: size" size 300 300 4 "$work/a.png"
		"$render" --rgba --width 300 countries "$countries" "$work/b.png"
		verdict "countries: the same bytes" "$(cmp "$work/a.png" "$work/b.png" 2>&1)"
	fi
	draw "country" --width 100 --country Lesotho countries "$countries" "$work/a.png"
	expect_error "countries: none" 1 "has no shape named Atlantis" --country Atlantis \
		countries "$countries" "$work/no.png"
	while IFS='|' read -r name text message; do
		printf "$text" >"$work/bad.txt"
		expect_error "countries: $name" 1 "$message" countries "$work/bad.txt" "$work/no.png"
	done <<-'END'
		empty||the file has no shape
		no shape|ring\n1 1\n|bad.txt:1: a ring before the first shape
		no ring|shape A\n1 1\n|bad.txt:2: a vertex outside of a ring
		two vertices|shape A\nring\n1 1\n2 2\nring\n|bad.txt:5: the ring above has fewer
		two vertices at the end|shape A\nring\n1 1\n2 2\n|the ring above has fewer
		beyond|shape A\nring\n181 1\n|bad.txt:3: longitudes reach
		not a number|shape A\nring\nnan 1\n|bad.txt:3: longitudes reach
		three numbers|shape A\nring\n1 1 1\n|bad.txt:3: expected
		no name|shape \nring\n|bad.txt:1: expected a name
	END
}

check_text() {
	if [ ! -f "$sans" ]; then
		skip "text" "there is no $sans (make deps installs it)"
		return
	fi
	# A bar from 193 to 377 and from 0 to 1556, of 2048 units; 3 pixels of margin.
	draw "l" text "$sans" l "$work/a.png" &&
	check "text: a bar" rectangle box 3.03125 3.375 8.78125 52 "$work/a.png"
	draw "o" --size 100 text "$sans" oo "$work/a.png"
	draw "kerning" text "$sans" 'AVA e\u0301' "$work/a.png"
	draw "lines" --size 16 text "$sans" 'A
B' "$work/a.png"
	if [ -f "$didot" ]; then
		draw "PostScript" text "$didot" H "$work/a.png"
		verdict "text: PostScript" "$([ -s "$work/a.png" ] || echo "no picture")"
	else
		skip "text: PostScript" "there is no $didot (make deps installs it)"
	fi
	expect_error "text: no font" 1 "cannot read $work/none" text "$work/none" A "$work/no.png"
	expect_error "text: no font in it" 1 "is not a font" text "$countries" A "$work/no.png"
	expect_error "text: a folder" 1 "Is a directory" text "$work" A "$work/no.png"
	expect_error "text: nothing" 1 "the text has no outlines" text "$sans" '' "$work/no.png"
	expect_error "text: a space" 1 "the text has no outlines" text "$sans" ' ' "$work/no.png"
	expect_error "text: no glyph" 1 "has no glyph for U+10FFFE" text "$sans" \
		"$(printf '\364\217\277\276')" "$work/no.png"
	expect_error "text: not UTF-8" 1 "not UTF-8 at byte 2" text "$sans" "$(printf 'A\200')" \
		"$work/no.png"
	expect_error "text: too large" 1 "larger than 16384 pixels" --size 16384 text "$sans" mm \
		"$work/no.png"
}

check_sheet() {
	if [ ! -f "$sans" ]; then
		skip "sheet" "there is no $sans (make deps installs it)"
		return
	fi
	draw "sheet" sheet "$work/a.png" || return
	check "sheet: as committed" same 1 "$root/examples/render/sheet.png" "$work/a.png"
	size=$(wc -c <"$root/examples/render/sheet.png")
	verdict "sheet: small" "$([ "$size" -lt 150000 ] || echo "$size bytes")"
}

check_plots() {
	if [ ! -x "$plot" ]; then
		skip "plots" "there is no $plot (make plots)"
		return
	fi
	while read -r name beside; do
		file=$root/examples/filters/$name
		"$plot" "$file.filter" "$beside" "$work/$name.svg" 2>"$work/stderr"
		verdict "plot of $name" "$(cmp "$file.svg" "$work/$name.svg" 2>&1)"
	done <<-'END'
		bspline5 bspline3
		quintic mitchell
		disc bspline3
	END
	"$plot" "$tests/verdict.sh" "$work/no.svg" 2>"$work/stderr"
	verdict "plot of no filter" "$([ $? -eq 2 ] && grep -q 'expected .filter NAME' "$work/stderr" \
		|| head -n 1 "$work/stderr")"
}

# ---- errors ----

# NAME STATUS PATTERN ARGUMENTS...: fails so, says so, and writes no picture.
expect_error() {
	name=$1
	shift
	try_error "$@"
	if [ -z "$problem" ] && [ -n "$(find "$work" -name 'no*.png*')" ]; then
		problem="it has written $(find "$work" -name 'no*.png*')"
		rm -f "$work"/no*.png*
	fi
	verdict "$name" "$problem"
}

check_usage() {
	while IFS='|' read -r message arguments; do
		expect_error "usage: $arguments" 2 "$message" $arguments
	done <<-END
		what is to be drawn|
		no command 'frobnicate'|frobnicate
		there is no option --frobnicate|--frobnicate 1 sheet no.png
		--width wants a value|sheet no.png --width
		text wants 3 operands, not 1|text A
		sheet wants 1 operands, not 2|sheet A B
		there is no filter 'sinc'|--filter sinc path M0 $work/no.png
		from 1 to 16384|--width 0 path M0 $work/no.png
		from 1 to 16384|--width 16385 path M0 $work/no.png
		from 1 to 16384|--height nan path M0 $work/no.png
		a whole number|--height 1.5 path M0 $work/no.png
		--size wants|--size -3 text F A $work/no.png
		--size wants|--size 1x text F A $work/no.png
		RRGGBB|--ink 12345 path M0 $work/no.png
		RRGGBB|--paper 12345g path M0 $work/no.png
		--view wants|--view 1,2,3 path M0 $work/no.png
		--view wants|--view 0,0,0,1 path M0 $work/no.png
		--view wants|--view 0,0,1e99,1 path M0 $work/no.png
	END
	"$render" --help >"$work/stdout" 2>"$work/stderr"
	verdict "--help" "$(grep -q '^usage: render' "$work/stdout" || cat "$work/stderr")"
	verdict "--filters" "$("$render" --filters | grep -qx mitchell || echo "mitchell is missing")"
}

check_bad_paths() {
	while IFS='|' read -r path message; do
		expect_error "bad path: $path" 1 "render: path:1:$message" path "$path" "$work/no.png"
	done <<-'END'
		|1: expected a path
		  |1: expected a path
		L1 1|1: expected M or m
		x|1: expected a command
		M|2: expected a number
		M1|3: expected a number
		M1,|4: expected a number
		M1 1,|6: expected a number
		M1 1,,2 2|6: expected a number
		M1 1 2|7: expected a number
		M1 1L|6: expected a number
		M1 1z 3|7: expected a command
		M1 1 L2 2 e|11: expected a command
		M1 --1|4: expected a number
		M1 .|4: expected a number
		M1 inf|4: expected a number
		M1 0x10|5: expected a command
		M1 1e|5: expected a command
		M1 1e999|4: the number is beyond
		M1 1A1 1 0 2 0 5 5|12: expected a flag
		M1 1A1 1 0 01|14: expected a number
	END
	printf '<svg>\n<path\nd="M0 0\n  L5 y"/></svg>' >"$work/bad.svg"
	expect_error "bad path in a file" 1 "bad.svg:4:6: expected a number" svg "$work/bad.svg" \
		"$work/no.png"
	verdict "its caret" "$(sed -n 3p "$work/stderr" | grep -q '^         ^$' ||
		sed -n 3p "$work/stderr")"
}

check_bad_svg() {
	while IFS='|' read -r name text message; do
		printf "$text" >"$work/bad.svg"
		expect_error "bad svg: $name" 1 "bad.svg$message" svg "$work/bad.svg" "$work/no.png"
	done <<-'END'
		empty||:1:1: expected <svg>
		text|hello|:1:1: expected <svg>
		html|<html></html>|:1:2: expected <svg>
		no path|<svg></svg>| has no path to fill
		open comment|<svg><!-- |:1:6: this has no end
		open element|<svg><path |:1:12: expected an attribute
		open value|<svg><path d="M0|:1:15: this has no end
		no value|<svg><path d/></svg>|:1:13: expected an attribute
		no quotes|<svg><path d=M0/></svg>|:1:14: expected a quoted value
		no name|<svg>< path/>|:1:7: expected the name
		transform|<svg><g transform="scale(2)"><path d="M0 0"/></g></svg>|:1:9: a transform
		viewBox of three|<svg viewBox="0 0 1"><path d="M0 0"/></svg>|:1:20: expected a number
		empty viewBox|<svg viewBox="0 0 1 0"><path d="M0 0"/></svg>|:1:15: the viewBox is empty
		a zero|<svg>\000</svg>|:1:6: a byte 0
	END
	expect_error "bad svg: missing" 1 "cannot read $work/none" svg "$work/none" "$work/no.png"
	expect_error "bad svg: a folder" 1 "Is a directory" svg "$work" "$work/no.png"
	expect_error "far away" 1 "a coordinate is too far away" --view 0,0,1e-6,1e-6 path \
		'M0 0H1e5V1e5z' "$work/no.png"
}

check_output() {
	expect_error "no folder" 1 "cannot write $work/none/a.png" path M0,0H9V9z "$work/none/a.png"
	echo keep >"$work/kept.png"
	"$render" path 'M0 x' "$work/kept.png" 2>/dev/null
	verdict "a failure keeps the file" "$([ "$(cat "$work/kept.png")" = keep ] || echo "it is gone")"
	draw "over a file" path M0,0H9V9z "$work/kept.png" &&
	check "the file is replaced" size 512 512 1 "$work/kept.png"
	verdict "nothing beside it" "$(find "$work" -name '*.tmp')"
	if [ -c /dev/full ]; then
		expect_error "a full disk" 1 "cannot write /dev/full" path M0,0H9V9z /dev/full
		verdict "a device stays one" "$([ -c /dev/full ] || echo "it is gone")"
	fi
	"$render" path M0,0H9V9z /dev/stdout 2>/dev/null | cat >"$work/piped.png"
	verdict "a pipe" "$(cmp "$work/kept.png" "$work/piped.png" 2>&1)"
}

# Paths put together at random: render must end by itself, with 0 or 1.
check_fuzz() {
	awk 'BEGIN {
		srand(7)
		n = split("M L H V C S Q T A Z m l h v c s q t a z , - . e 0 1 9 1e5 -7.5 .5 0.25 x",
			token, " ")
		for (i = 0; i < 400; i++) {
			line = "M1 1"
			for (k = int(rand() * 30); k > 0; k--)
				line = line (rand() < 0.5 ? " " : "") token[1 + int(rand() * n)]
			print line
		}
	}' >"$work/paths"
	problem=
	good=0
	while read -r path; do
		got=0
		"$render" --width 16 path "$path" "$work/fuzz.png" >/dev/null 2>"$work/stderr" ||
			got=$?
		[ $got -le 1 ] || problem="status $got for $path"
		[ $got -ne 0 ] || good=$((good + 1))
	done <"$work/paths"
	verdict "400 random paths, $good drawn" "$problem"
}

if [ -n "$python" ]; then
	filters=$("$render" --filters)
	check_rectangles
	check_turns
	check_seam
	check_overlap
	check_custom
	check_grammar
	check_svg
	check_countries
	check_text
	check_sheet
	check_output
else
	skip "pictures" "no python3 (make deps installs it)"
fi
check_plots
check_usage
check_bad_paths
check_bad_svg
check_fuzz
finish

# cli_filters.sh - filter files on gen's command line; cli.sh reads this file and cli_errors.sh, and
# has the helpers.

# ---- files with a mistake ----

# LINE COLUMN PATTERN TEXT: what is wrong, with its spot; escapes of TEXT as printf has them.
try_filter() {
	printf '%b' "$4" >"$work/bad.filter"
	try_error 2 "$3" --filter "$work/bad.filter" --out new
	if [ -z "$problem" ] && ! head -n 1 "$work/stderr" \
		| grep -qF "gen: $work/bad.filter: line $1, column $2: "; then
		problem="not line $1, column $2: $said"
	fi
}

# The same; the text is not to be shown as it is.
bytes_error() {
	try_filter "$@"
	if [ -z "$problem" ] && LC_ALL=C grep -q '[^ -~]' "$work/stderr"; then
		problem="what is no character is printed"
	fi
	verdict "filter file '$(printf %s "$4" | tr '\\\n' '/ ' | cut -c 1-60)'" "$problem"
}

# The same; the line is shown, and a caret under the spot.
filter_error() {
	try_filter "$@"
	awk -v line="$1" -v column="$2" 'NR == line { text = $0; sub(/\r$/, "", text) } END {
		print "  " text
		margin = substr(text, 1, column - 1)
		gsub(/[^\t]/, " ", margin)
		print "  " margin "^"
	}' "$work/bad.filter" >"$work/caret"
	if [ -z "$problem" ] && ! tail -n +2 "$work/stderr" | cmp -s - "$work/caret"; then
		problem="the caret is not under line $1, column $2"
	fi
	verdict "filter file '$(printf %s "$4" | tr '\\\n' '/ ' | cut -c 1-60)'" "$problem"
}

s='filter f\nseparable\n'
e='filter f\nseparable even\n'
b='filter f\nbivariate\n'

filter_error 1 1 "expected 'filter NAME'" ''
filter_error 3 1 'the file ends here' '# only\n# comments\n'
filter_error 1 1 "not 'separable' here" 'separable\nfilter f\npiece 0 1 : 1\n'
filter_error 2 1 "expected 'filter NAME'" '\nfilm f\n'
filter_error 1 1 "expected 'filter NAME'" 'Filter f\n'
filter_error 1 1 "expected 'filter NAME'" 'filterf\n'
filter_error 1 7 'expected the name' 'filter\nf\n'
filter_error 1 8 'expected the name' 'filter # f\n'
filter_error 1 8 "'1a' is not a name" 'filter 1a\n'
filter_error 1 8 "'Soft' is not a name" 'filter Soft\n'
filter_error 1 8 "'catmull-rom' is not a name; use" 'filter catmull-rom\n'
filter_error 1 8 "'int' is a keyword" 'filter int\n'
filter_error 1 8 "'area' is the name of a function" 'filter area\n'
filter_error 1 8 "'areaf' is the name of a function" 'filter areaf\n'
filter_error 1 8 "'raster_u8' is the name of a function" 'filter raster_u8\n'
filter_error 1 8 "'line_a' is the name of a function" 'filter line_a\n'
filter_error 1 8 "'x1y0' is the name of a function" 'filter x1y0\n'
filter_error 1 8 "float version of the built-in filter 'tent'" 'filter tentf\n'
filter_error 1 8 'at most 40 in all' 'filter aaaaaaaaaabbbbbbbbbbccccccccccdddddddddde\n'
filter_error 1 10 'expected the end of the line' 'filter f g\n'
filter_error 1 10 'expected the end of the line' 'filter f separable\npiece 0 1 : 1\n'
filter_error 2 1 "'separable', 'separable even' or 'bivariate', not 'filter' here" \
	'filter f\nfilter f\n'
filter_error 2 1 "not 'piece' here" 'filter f\npiece 0 1 : 1\n'
filter_error 2 1 "expected 'separable'" 'filter f\neven\n'
filter_error 2 1 'the file ends here' 'filter f\n'
filter_error 1 9 'the file ends here' 'filter f'
filter_error 2 11 "expected 'even' or the end" 'filter f\nseparable odd\n'
filter_error 2 16 'expected the end of the line' 'filter f\nseparable even even\n'
filter_error 2 11 'expected the end of the line' 'filter f\nbivariate even\n'
filter_error 3 1 "not 'separable' here" "${s}separable\n"
filter_error 4 1 "expected 'piece X0 X1 : EXPRESSION', not 'bivariate' here" \
	"${s}piece 0 1 : 1\nbivariate\n"
filter_error 4 1 "'piece X0 X1 Y0 Y1 : EXPRESSION', not 'filter' here" \
	"${b}piece 0 1 0 1 : 1\nfilter g\n"
filter_error 3 1 "EXPRESSION', but the file ends here" "$s"
filter_error 3 1 "expected 'piece X0 X1 Y0 Y1 :" "${b}peace 0 1 0 1 : 1\n"

# knots
filter_error 3 6 'expected X0' "${s}piece\n"
filter_error 3 7 'expected X0, a number such as 2, 0.5 or -3/2' "${s}piece x 1 : 1\n"
filter_error 3 7 'expected X0' "${s}piece +1 2 : 1\n"
filter_error 3 7 'expected X0' "${s}piece .5 2 : 1\n"
filter_error 3 7 'expected X0' "${s}piece (1) 2 : 1\n"
filter_error 3 7 'expected X0' "${s}piece --1 2 : 1\n"
filter_error 3 9 'expected X1' "${s}piece 0 : 1\n"
filter_error 3 9 'expected X1' "${s}piece 0 # 1 : 1\n"
filter_error 3 8 'expected a blank after X0' "${s}piece 0, 1 : 1\n"
filter_error 3 8 'expected a blank after X0' "${s}piece 0x 1 : 1\n"
filter_error 3 8 'expected a blank after X0' "${s}piece 0-1 1 : 1\n"
filter_error 3 8 'expected a blank after X0' "${s}piece 1e-3 1 : 1\n"
filter_error 3 10 'the divisor of this knot' "${s}piece 0/ : 1\n"
filter_error 3 11 'division by zero' "${s}piece 0 1/0 : 1\n"
filter_error 3 11 "expected ':'; a piece of a separable filter" "${s}piece 0 1 0 1 : 1\n"
filter_error 3 10 "expected ':'" "${s}piece 0 1\n"
filter_error 3 11 'expected Y0' "${b}piece 0 1 : x*y\n"
filter_error 3 13 'expected Y1' "${b}piece 0 1 0 : x*y\n"
filter_error 3 15 "expected ':' after the four knots" "${b}piece 0 1 0 1 2 : x*y\n"
filter_error 3 9 'empty: expected X1 greater than X0' "${s}piece 1 1 : 1\n"
filter_error 3 11 'empty: expected X1 greater than X0' "${s}piece 0.5 1/2 : 1\n"
filter_error 3 9 'reversed: expected X1 greater than X0' "${s}piece 2 1 : 1\n"
filter_error 3 10 'reversed: expected X1' "${s}piece -1 -3/2 : 1\n"
filter_error 3 13 'reversed: expected Y1 greater than Y0' "${b}piece 0 1 1 0 : 1\n"
filter_error 3 13 'empty: expected Y1 greater than Y0' "${b}piece 0 1 1 1 : 1\n"
filter_error 3 7 'an even filter is given for x >= 0 only' "${e}piece -1 1 : 1\n"
filter_error 4 7 'an even filter' "${e}piece 0 1 : 1\npiece -2 -1 : 1\n"
filter_error 3 9 'at most 1024 pixels' "${s}piece 0 1025 : 1\n"
filter_error 3 7 'at most 1024 pixels' "${s}piece -2049/2 0 : 1\n"
filter_error 4 7 'overlaps the piece of line 3' "${s}piece 0 1 : 1\npiece 1/2 2 : x\n"
filter_error 6 7 'overlaps the piece of line 5' \
	"${s}# a comment\n\npiece 1 2 : 1\npiece -3 4 : x\n"
filter_error 5 7 'overlaps the piece of line 3' \
	"${s}piece 0 1 : 1\npiece 1 2 : 1\npiece 0 1 : 1\n"
filter_error 5 7 'overlaps the piece of line 4' \
	"${b}piece 0 1 0 1 : 1\npiece 0 1 1 2 : x\npiece 1/2 3 3/2 2 : y\n"

# expressions
filter_error 3 12 'expected a number, x or' "${s}piece 0 1 :\n"
filter_error 3 13 'expected a number, x or' "${s}piece 0 1 : # 1\n"
filter_error 3 15 'y in a separable filter, which is k(x) k(y)' "${s}piece 0 1 : x*y\n"
filter_error 3 13 "not the name 'z'" "${s}piece 0 1 : z\n"
filter_error 3 21 "expected a number, x, y or '(', not the name 'sin'" \
	"${b}piece 0 1 0 1 : 1 + sin(x)\n"
filter_error 3 14 'an operator or the end of the line' "${s}piece 0 1 : 2x\n"
filter_error 3 15 'an operator or the end of the line' "${s}piece 0 1 : 2 : 3\n"
filter_error 3 17 "an operator or ')'" "${s}piece 0 1 : (1-x\n)\n"
filter_error 3 15 'division by something that is not a number' "${s}piece 0 1 : 1/x\n"
filter_error 3 15 'division by zero' "${s}piece 0 1 : x/(x-x)\n"
filter_error 3 15 'expected an exponent' "${s}piece 0 1 : x^x\n"
filter_error 3 15 'expected an exponent' "${s}piece 0 1 : x^33\n"
filter_error 3 18 'degree becomes 40; at most 32' "${s}piece 0 1 : x^20*x^20\n"
filter_error 3 22 'degree becomes 34; at most 32' "${b}piece 0 1 0 1 : x^17*y^17\n"
filter_error 3 34 '128 bits' "${s}piece 0 1 : 10^20*x + 10^20*10^20\n"
filter_error 3 13 '39 digits' "${s}piece 0 1 : 1234567890123456789012345678901234567890\n"
filter_error 3 51 '128 bits' "${s}piece 0 1 : 999999999999999999999999999999999999999\n"
filter_error 3 48 '128 bits' "${s}piece 0.10000000000000000000000000000000001/97 1 : 1\n"
filter_error 2 1 'this filter is 0 everywhere' '\nfilter f\nseparable\npiece 0 1 : x - x\n'
filter_error 3 25 '128 bits' "${s}piece 0 1.00000000001 : x^32\n"
filter_error 1 1 '128 bits' "${s}piece 0 1 : x/10000000019\npiece 1 2 : x/10000000033\n\
piece 2 3 : x/10000000061\npiece 3 4 : x/10000000069\n"

# text
bytes_error 2 5 'zero byte' 'filter f\nsepa\0000rable\npiece 0 1 : 1\n'
bytes_error 3 17 'not UTF-8' "${s}piece 0 1 : 1 # \\0351\n"
bytes_error 1 8 "'a?b' is not a name" 'filter a\0033b\n'
bytes_error 2 1 "expected 'separable', 'separable even' or 'bivariate'" 'filter a\n\0001\n'
bytes_error 1 1 'not UTF-8' '\0377\0376f\0000i\0000'
filter_error 3 9 'expected X1' "filter f\r\nseparable\r\npiece 0 x : 1\r\n"
filter_error 3 2 "expected 'piece" "${s}\tpeace 0 1 : 1\n"

many_pieces() {
	printf 'filter many\nseparable\n'
	i=0
	while [ $i -lt "$1" ]; do
		echo "piece $i $((i + 1)) : x - $i"
		i=$((i + 1))
	done
}
many_pieces 257 >"$work/many.filter"
expect_error '257 pieces' 2 'line 259, column 7: a filter has at most 256 pieces' \
	--filter "$work/many.filter"

# ---- files that are none ----

mkdir "$work/folder.filter"
expect_error 'filter file that is not there' 2 \
	"'no.filter' is no built-in filter (box, tent, bspline2, bspline3, catmull_rom, mitchell)" \
	--filter no.filter
expect_error 'filter that is not built in' 2 "'lanczos' is no built-in filter (box," \
	--filter lanczos
expect_error 'filter file that is a folder' 2 'cannot read' --filter "$work/folder.filter"
expect_error 'filter file without end' 2 '65536 bytes' --filter /dev/zero
awk 'BEGIN { for (i = 0; i < 7000; i++) print "# a line"; }' >"$work/large.filter"
printf 'filter large\nseparable even\npiece 0 1/2 : 1\n' >>"$work/large.filter"
awk 'BEGIN { for (i = 0; i < 400; i++) print "# a line"; }' >>"$work/large.filter"
expect_error 'filter file of 66 kB' 2 'larger than 65536 bytes' --filter "$work/large.filter"
printf 'filter tent\nseparable even\npiece 0 1 : 1 - x^2\n' >"$work/other.filter"
expect_error 'another tent' 2 "'tent' is the name of a built-in filter" \
	--filter "$work/other.filter"

# ---- names of a request ----

printf 'filter soft\nseparable even\npiece 0 1 : 1 - x\n' >"$work/soft.filter"
printf 'filter softf\nseparable even\npiece 0 1 : 1 - x\n' >"$work/softf.filter"
printf '# mine\n\tfilter tent\nseparable even # !\n piece 0 1:1-x' >"$work/tent.filter"
expect_error 'built-in filter twice' 2 "two filters are called 'tent'" \
	--filter tent --filter box --filter tent
expect_error 'built-in filter and its file' 2 "two filters are called 'tent'" \
	--filter tent --filter "$work/tent.filter"
expect_error 'filter file twice' 2 "two filters are called 'soft'" \
	--filter "$work/soft.filter" --filter "$work/soft.filter"
expect_error 'filters soft and softf' 2 "filter 'softf' has the name of the float version" \
	--filter "$work/softf.filter" --filter "$work/soft.filter"
expect_error 'polynomial and filter soft' 2 'a polynomial and a filter' \
	--filter "$work/soft.filter" --polynomial soft=x
expect_error 'polynomial softf and filter soft' 2 "polynomial 'softf' has the name of the float" \
	--filter "$work/soft.filter" --polynomial softf=x
for name in box tentf catmull_rom filter filter_x deposit_x; do
	expect_error "--polynomial $name" 2 "'$name' is the name of" --polynomial "$name=x"
done
expect_error 'filter without lines' 2 'add line to --edges' --filter box --edges quad
expect_error '--max-degree of filters' 2 '--max-degree goes with' --max-degree 2 \
	--families filters,coverage
expect_error '--show of a filter as C' 2 'as text or json' --show box --format c
expect_error '--show of a filter as LaTeX' 2 'as text or json' --show box --format latex
expect_error '--show of no filter' 2 "'no.filter' is no built-in filter" --show no.filter
expect_error '--show with --filter' 2 '--filter' --show box --filter box
expect_full '--show of a filter on a full disk' --show mitchell
expect_full 'analysis on a full disk' --filter mitchell --dry-run

# ---- filters that are right ----

custom() {
	cat <<-END
		filter wavy
		separable
		piece 1/2 3/2 : x^2 - 0.25
		piece -1.5 -1/2 : 2*(x + 1)
	END
}

canonical_wavy='filter wavy
separable
piece -3/2 -1/2 : 2*x + 2
piece 1/2 3/2 : x^2 - 1/4'

analysis_is_printed() {
	custom >wavy.filter
	gen --filter wavy.filter --filter mitchell >log
	cat >want <<-END
		filter wavy: separable, degree 2
		  support -3/2 <= x <= 3/2, -3/2 <= y <= 3/2: 3 x 3 pixels, knots whole pixels apart
		  integral 25/36: not normalised
		  discontinuous
		  no partition of unity
		filter mitchell: separable, even, degree 3
		  support -2 <= x <= 2, -2 <= y <= 2: 4 x 4 pixels, knots whole pixels apart
		  integral 1: normalised
		  continuous with 1 derivative
		  partition of unity
	END
	tail -n 10 log | cmp - want
	gen --filter wavy.filter --quiet --out quiet >log 2>&1
	[ ! -s log ]
	gen --filter wavy.filter --check --out quiet >log 2>&1
	[ ! -s log ]
	gen --filter wavy.filter --dry-run --out quiet | refute grep integral
	gen --filter wavy.filter -d p | refute grep integral
}
check analysis_is_printed

# A filter alone is all that is asked for, wherever its file lies and however it is written.
place_of_a_filter_file() {
	mkdir one one/two
	custom >one/wavy.filter
	{
		printf '\357\273\277'
		custom | sed 's/^/\t /; s/$/  # caf\xc3\xa9\r/'
	} >one/two/x
	gen --filter one/wavy.filter --out a
	gen --filter one/two/x --out b
	(cd one/two && gen --filter "$PWD/x" --out ../../c)
	gen --filter /dev/stdin --out d <one/wavy.filter
	for other in b c d; do
		diff -r a $other
	done
	grep -qx ' \*     gen --filter wavy.filter' a/edgewise.h
	refute grep -r -e one/ -e "$PWD" a
	mkdir again
	awk '/^\/\* wavy.filter:$/ { on = 1; next } on && /^ \*\/$/ { exit }
		on && sub(/^ \*     /, "")' a/edgewise.h >again/wavy.filter
	[ "$(cat again/wavy.filter)" = "$canonical_wavy" ]
	(cd again && gen --filter wavy.filter --out ../e)
	diff -r a e
}
check place_of_a_filter_file

# A file that says what a built-in filter is asks for that one.
file_of_a_built_in_filter() {
	cp "$work/tent.filter" mine
	gen --filter mine --out a
	gen --filter tent --out b
	diff -r a b
	grep -qx ' \*     gen --filter tent' a/edgewise.h
	refute grep -q 'filter:$' a/edgewise.h
	gen --filter catmull-rom --out c
	gen --filter catmull_rom --out d
	diff -r c d
}
check file_of_a_built_in_filter

filters_and_families() {
	gen --max-degree 1 --filter mitchell --out a
	grep -q '^#define EW_MAX_DEGREE 1$' a/edgewise.h
	gen --families filters,coverage --out b
	grep -qx ' \*     gen --families coverage,filters' b/edgewise.h
	gen --families filters --filter tent --out c
	grep -qx ' \*     gen --families filters --filter tent' c/edgewise.h
	gen --filter tent --out d
	refute grep -q '^#define EW_MAX_DEGREE' d/edgewise.h
}
check filters_and_families

filters_in_the_depfile() {
	custom >'a wavy $'
	cp "$work/tent.filter" .
	gen --filter 'a wavy $' --filter box --filter tent.filter --single-header s.h --depfile s.d
	printf '%s\n' 's.h: \' ' a\ wavy\ $$ \' ' tent.filter' | cmp - s.d
	printf 'all: s.h\n\t@echo made\n\ns.h:\n\t@echo again\n\ninclude s.d\n' >Makefile
	[ "$(make)" = made ]
	touch -t 200001010000 s.h
	[ "$(make | head -n 1)" = again ]
}
check filters_in_the_depfile

shown_filters() {
	custom >wavy.filter
	for filter in box tent bspline2 bspline3 catmull-rom catmull_rom mitchell ./wavy.filter; do
		unchanged . gen --show $filter >../shown
		gen --show $filter --format json >../json
		valid_json ../json
		sed '/^filter .*:/,$d' ../shown >../pieces
		name=$(sed -n 's/^filter //p' ../pieces)
		grep -q "^filter $name: " ../shown
		grep -q "\"filter\": \"$name\"" ../json
		gen --show ../pieces | cmp - ../shown
	done
	gen --show wavy.filter | head -n 4 >../pieces
	[ "$(cat ../pieces)" = "$canonical_wavy" ]
	gen --list >../list
	for filter in box tent bspline2 bspline3 catmull_rom mitchell; do
		grep -q "^  $filter  *separable, even, .*integral 1, partition of unity$" ../list
	done
}
check shown_filters

many_pieces 256 >"$work/many.filter"
as_many_pieces_as_there_may_be() {
	gen --show "$work/many.filter" >shown
	[ "$(grep -c '^piece' shown)" -eq 256 ]
	grep -q '256 x 256 pixels' shown
}
check as_many_pieces_as_there_may_be

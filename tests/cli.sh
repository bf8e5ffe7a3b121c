#!/bin/sh
# cli.sh - the command line of gen: every option and, from files beside it, families and kinds of
# edges (cli_families.sh), every error (cli_errors.sh), filter files (cli_filters.sh). What
# emissions bring into a program is asked by symbols.sh, and two of them in one program are a way
# of vendor.sh.
#
#     sh tests/cli.sh [GEN]        (default: build/gen; CC and CXX choose the compilers)
#
# A test is a function of commands that must all succeed; it runs in a fresh folder of its own.
# An error test is one line: name, status, words of the message, arguments; it runs in a folder that
# holds an emission and foreign files, and nothing there may change. Every option that gen --help
# names must occur in cli_errors.sh and in another of these files.

. "$(dirname "$0")/verdict.sh"
LC_ALL=C
export LC_ALL
clean_up() {
	umount "$work/small" "$work/readonly" 2>/dev/null
	rm -rf "$work"
}
trap clean_up EXIT

mkdir "$work/bin"
cp "${1:-build/gen}" "$work/bin/gen" || exit 1
GEN=$work/bin/gen
CC=${CC:-cc}
CXX=${CXX:-c++}
STRICT='-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror'
limit=
has timeout && limit='timeout 20'

# ---- helpers ----

gen() {
	$limit "$GEN" "$@"
}

# NAME: runs the function NAME in a fresh folder; its first failing command fails the test.
check() {
	mkdir "$work/$1"
	(
		set -eu
		cd "$work/$1"
		"$1"
	) >"$work/log" 2>&1
	result=$?
	problem=
	[ $result -eq 0 ] || problem="status $result; $(tail -n 3 "$work/log" | tr '\n' ' ')"
	verdict "$(echo "$1" | tr _ ' ')" "$problem"
}

refute() {
	if "$@"; then
		echo "should fail: $*"
		return 1
	fi
}

# STATUS COMMAND...: the command ends with this status.
status() {
	wanted=$1
	shift
	got=0
	"$@" || got=$?
	[ $got -eq "$wanted" ] || { echo "status $got, not $wanted: $*"; return 1; }
}

# Names, kinds, modes, sizes, times and contents of all that is in a folder.
snapshot() {
	(
		cd "$1" || exit 1
		find . -type d | sort
		find . ! -type d -exec ls -lnd {} + | tr -s ' ' | sort
		find . -type f -exec cksum {} + | sort
	)
}

# FOLDER COMMAND...: the command changes nothing there.
unchanged() {
	folder=$1
	shift
	snapshot "$folder" >"$work/before"
	"$@"
	snapshot "$folder" >"$work/after"
	cmp "$work/before" "$work/after"
}

age() {
	find "$1" -exec touch -t 200001010000 {} +
}

# FOLDER: names of the global symbols that its objects define.
symbols() {
	nm -P -g "$1"/*.o | awk '$2 != "U" && NF > 1 { print $1 }' | sort
}

# FOLDER: compiles it from a copy alone, with the given flags.
build() {
	folder=$1
	shift
	rm -rf alone
	cp -R "$folder" alone
	(cd alone && $CC "$@" -c ./*.c)
}

# FOLDER: main.c with it succeeds; objects of FOLDER's copy stay in `alone`.
run_with() {
	build "$1"
	$CC -I alone -o main main.c alone/*.o -lm
	./main
}

# HEADER PREFIX: a program that succeeds if the unit square has area 1.
area_program() {
	cat <<-END
		#include "$1"
		#include "$1"
		int main(void)
		{
			static const double x[] = { 0, 1, 1, 0 }, y[] = { 0, 0, 1, 1 };
			static const float xf[] = { 0, 1, 1, 0 }, yf[] = { 0, 0, 1, 1 };
			return !($2area(x, y, 4) == 1.0 && $2areaf(xf, yf, 4) == 1.0f);
		}
	END
}

valid_json() {
	if python3 -c '' 2>/dev/null; then
		python3 -m json.tool "$1" >/dev/null
	else
		head -c 1 "$1" | grep -q '{' && tail -n 1 "$1" | grep -q '}$'
	fi
}

# ---- what to emit ----

default_request() {
	gen
	grep -q '^#define EW_MAX_DEGREE 4$' generated/edgewise.h
	grep -q '^#define EW_MAX_CURVE_DEGREE 4$' generated/edgewise.h
	gen --max-degree 4 --out explicit
	diff -r generated explicit
	gen --families moments,curves,distance,closure,coverage,filters \
		--edges line,quad,conic,cubic --out all
	for file in generated/*.[ch]; do
		sed 's/ --families .*cubic$//' "all/${file#*/}" | cmp - "$file"
	done
}
check default_request

max_degree() {
	gen --max-degree 0 --out d0
	gen --max-degree 8 --out d8
	grep -q '^#define EW_MAX_DEGREE 0$' d0/edgewise.h
	grep -q '^#define EW_MAX_DEGREE 8$' d8/edgewise.h
	[ "$(grep -c '^double ew_line_x[0-8]y[0-8](' d8/edgewise.h)" -eq 45 ]
	[ "$(grep -c '^float ew_line_x[0-8]y[0-8]f(' d8/edgewise.h)" -eq 45 ]
	area_program edgewise.h ew_ >main.c
	gen --max-degree 0 --targets portable --out small
	run_with small
}
check max_degree

monomials_only() {
	gen --monomial x4y2 --monomial x1y0 --targets portable,fma --out d
	build d
	symbols alone | grep '^ew_line_' >lines
	printf 'ew_line_x1y0\new_line_x1y0f\new_line_x4y2\new_line_x4y2f\n' | cmp - lines
	refute grep -qE 'ew_(moments|area|centroid)f?\(' d/edgewise.h
	refute grep -q EW_MAX_DEGREE d/edgewise.h
}
check monomials_only

polynomial() {
	gen --polynomial soft='(1-x)*(1-y)' --targets portable,fma --out d
	cat >main.c <<-END
		#include "edgewise.h"
		#include <math.h>
		int main(void)
		{
			static const double x[] = { 0, 1, 1, 0, 0 }, y[] = { 0, 0, 1, 1, 0 };
			static const float xf[] = { 0, 1, 1, 0, 0 }, yf[] = { 0, 0, 1, 1, 0 };
			double sum = -0.25;
			float sumf = -0.25f;
			for (int i = 0; i < 4; ++i) {
				sum += ew_line_soft(x[i], y[i], x[i + 1], y[i + 1]);
				sumf += ew_line_softf(xf[i], yf[i], xf[i + 1], yf[i + 1]);
			}
			return !(fabs(sum) < 1e-15 && fabsf(sumf) < 1e-6f
				&& fabs(ew_soft(x, y, 4) - 0.25) < 1e-15
				&& fabsf(ew_softf(xf, yf, 4) - 0.25f) < 1e-6f);
		}
	END
	run_with d
}
check polynomial

polynomial_grammar() {
	gen --polynomial f='-(x - 0.25*0 + 1/3)^2 / (1 + 1) * --y' --out d
	gen --polynomial f='-1/2*x^2*y - 1/3*x*y - 1/18*y' --out e
	diff -r d e
	gen --polynomial a=x^32 --polynomial b=1 --polynomial c="$(printf '\tx\n + y')" --out f
}
check polynomial_grammar

precision() {
	set -- --max-degree 1 --polynomial p=x --targets portable
	gen "$@" --precision double --out d
	gen "$@" --precision float --out f
	gen "$@" --precision float,double --out both
	gen "$@" --out default
	diff -r both default
	for d in d f both; do
		build $d $STRICT -std=c99
		symbols alone >$d.symbols
	done
	sort -u d.symbols f.symbols | cmp - both.symbols
	comm -12 d.symbols f.symbols |
		grep -vE '^ew_(deposit|filter)_' |
		refute grep -vE '_finish(_[a-z0-9]+)?$|_k$|_divide_of$|target|^ew_version$'
	refute grep -q '^float' d/edgewise.h
	refute grep -q '^double' f/edgewise.h
}
check precision

targets() {
	gen --max-degree 1 --targets portable --out d
	gen --max-degree 1 --targets fma --out with
	gen --max-degree 1 --targets portable,fma --out both
	diff -r with both
	[ -f both/edgewise_moments_fma.c ]
	find both -name '*avx*' | refute grep .
	gen --max-degree 1 --targets portable,fma,avx2,avx512,neon,wasm128 --out all
	gen --max-degree 1 --check --out all
	find d -name '*fma*' -o -name '*avx*' -o -name '*neon*' -o -name '*wasm*' | refute grep .
	cat >main.c <<-END
		#include "edgewise.h"
		int main(void) { return ew_targets() != EW_PORTABLE; }
	END
	run_with d
	nm -P alone/*.o | refute grep fma
}
check targets

prefix() {
	gen --prefix foo --max-degree 2 --polynomial soft=x*y --monomial x4y2 --out foo
	find foo -type f ! -name 'foo*' | refute grep .
	grep -rnE '(^|[^A-Za-z0-9_])(ew|EW)(_|[^A-Za-z0-9]|$)' foo | refute grep .
	refute grep -rniE 'edgewise' foo
	gen --prefix foo --single-header foo.h
	refute grep -niE '(^|[^a-z0-9_])ew_|edgewise' foo.h
}
check prefix

# SCHEME DEGREE2 X4Y2: the scheme asked for, and what two kernels get.
scheme_gives() {
	gen --max-degree 2 --families moments --monomial x4y2 --scheme "$1" --out "$1"
	grep -q " --max-degree 2 --families moments --monomial x4y2 --scheme $1\$" "$1/edgewise.h"
	sed -n 's/.*"ring": "\(moments_2\|x4y2\)".*"scheme": "\([^"]*\)".*/\1 \2/p' \
		"$1/edgewise_manifest.json" >got
	printf 'moments_2 %s\nx4y2 %s\n' "$2" "$3" | diff got -
}

scheme() {
	scheme_gives matrix matrix matrix
	scheme_gives horner shared horner
	scheme_gives even-power even-power even-power
	scheme_gives shared shared even-power
	scheme_gives recurrence recurrence even-power
	scheme_gives vertex shared even-power
	gen --max-degree 2 --families moments --monomial x4y2 --out cheapest
	for file in cheapest/edgewise_moments_fma.c cheapest/edgewise_integrands_fma.c; do
		sed 's/ --scheme vertex$//' "vertex/${file#*/}" | cmp - "$file"
	done
}
check scheme

# Far from the origin the area must stay within its bound, however it is computed.
area_of_any_scheme() {
	cat >main.c <<-END
		#include "edgewise.h"
		#include <math.h>
		int main(void)
		{
			const double side = 10 + 0x1p-20, x0 = 5e5, y0 = 4e6;
			const double x[] = { x0, x0 + side, x0 + side, x0 };
			const double y[] = { y0, y0, y0 + side, y0 + side };
			double out[1], bound[1];
			ew_moments_bounded(0, x, y, 4, out, bound);
			return !(out[0] == ew_area(x, y, 4)
				&& fabs(out[0] - (x[1] - x0) * (y[2] - y0)) <= bound[0]);
		}
	END
	for name in matrix even-power recurrence vertex; do
		gen --max-degree 1 --families moments --targets portable,fma --scheme $name \
			--out $name
		$CC -I $name -o main main.c $name/*.c -lm
		./main || { echo "not with $name"; return 1; }
	done
}
check area_of_any_scheme

# ---- where to ----

self_contained_folder() {
	gen --max-degree 0 --families moments --out d
	build d
	area_program edgewise.h ew_ >alone/main.c
	(cd alone && $CC main.c ./*.o -lm -o main && ./main)
}
check self_contained_folder

no_runtime() {
	gen --max-degree 1 --edges quad --targets portable,fma --out full
	gen --max-degree 1 --edges quad --targets portable,fma --no-runtime --out kernels
	build kernels -O0
	rm kernels/edgewise_manifest.json
	for file in kernels/*; do
		cmp "$file" "full/${file#*/}"
	done
	[ ! -e kernels/edgewise_rings.c ]
	[ -e full/edgewise_rings.c ]
}
check no_runtime

# FAMILIES COMPILER...: two translation units include the header, one of them implements it.
single_header_with() {
	gen --families "$1" --max-degree 1 --polynomial soft='(1-x)*(1-y)' --single-header ew.h
	shift
	[ "$(ls)" = ew.h ]
	printf '#define EW_IMPLEMENTATION\n#include "ew.h"\n' >implementation.c
	area_program ew.h ew_ >main.c
	"$@" -Wall -Wextra -Werror -o main main.c implementation.c -lm
	./main
}
# shellcheck disable=SC2086
single_header_as_C99() {
	single_header_with moments $CC -std=c99 -pedantic
}
check single_header_as_C99
# shellcheck disable=SC2086
single_header_as_CXX17() {
	single_header_with moments,curves,distance,closure,coverage,filters \
		$CXX -x c++ -std=c++17
}
if has "${CXX%% *}"; then
	check single_header_as_CXX17
else
	skip 'single header as CXX17' 'no C++ compiler'
fi

check_option() {
	gen --max-degree 2 --out d --quiet
	touch d/foreign
	age d
	unchanged d gen --max-degree 2 --out d --check >list
	[ ! -s list ]
	unchanged d status 1 gen --max-degree 1 --precision double --out d --check >list
	grep -q 'differs d/edgewise.h' list
	grep -q 'stale d/edgewise_linef.c' list
	refute grep -q foreign list
	echo '/* changed */' >>d/edgewise_rings.c
	rm d/edgewise_line.c
	unchanged . status 1 gen --max-degree 2 --out d --check >../list
	printf 'missing d/edgewise_line.c\ndiffers d/edgewise_rings.c\n' | cmp - ../list
	unchanged . status 1 gen --out absent --check >../list
	[ "$(grep -c '^missing absent/' ../list)" -gt 10 ]
}
check check_option

check_of_single_files() {
	gen --single-header s.h --manifest s.json --depfile s.d
	gen --single-header s.h --manifest s.json --depfile s.d --check
	echo >>s.json
	unchanged . status 1 gen --single-header s.h --manifest s.json --depfile s.d --check \
		>../list
	[ "$(cat ../list)" = 'differs s.json' ]
}
check check_of_single_files

dry_run() {
	unchanged . gen --dry-run --manifest m.json --depfile d.d >../list
	gen --manifest m.json --depfile d.d
	find . -type f | sed 's:^\./:would write :' | sort >../files
	sort ../list | cmp - ../files
	unchanged . gen --dry-run --precision double --single-header s.h >../list
	[ "$(cat ../list)" = 'would write s.h' ]
	unchanged . gen --dry-run --precision double >../list
	grep -q 'would remove generated/edgewise_linef.c' ../list
	grep -q 'unchanged generated/edgewise_rings.c' ../list
}
check dry_run

manifest() {
	gen --max-degree 3 --polynomial soft='(1-x)*(1-y)' --monomial x4y2 --out d --manifest m.json
	cmp m.json d/edgewise_manifest.json
	valid_json m.json
	for word in ew_line_x1y1 ew_line_x4y2 ew_line_soft '"mul"' '"fma"' '"add"' '"k"'; do
		grep -q "$word" m.json
	done
	for file in d/*.[ch]; do
		grep -q "\"${file#d/}\", \"bytes\": $(($(wc -c <"$file")))," m.json
	done
	for filter in box mitchell; do
		grep -q "{\"deposit\": \"deposit_$filter\", \"filter\": \"$filter\"" m.json
	done
	gen --single-header s.h --manifest s.json
	valid_json s.json
}
check manifest

depfile() {
	for d in plain 'with space' 'a#b$c'; do
		gen --max-degree 0 --out "$d" --depfile d.d
		echo "$d" | sed 's/[ #]/\\&/g; s/\$/$$/g' >name
		{
			printf 'all:'
			for file in "$d"/*; do
				printf ' %s/%s' "$(cat name)" "${file##*/}"
			done
			printf '\n\t@echo made\n\ninclude d.d\n'
		} >Makefile
		rm -r "$d"
		[ "$(make)" = made ]
	done
	gen --single-header 's s.h' --depfile d.d
	grep -q '^s\\ s\.h:' d.d
}
check depfile

# ---- other options ----

# FORMAT: x4y2 shows its literal matrix and its factor, and writes nothing.
show_in() {
	unchanged . gen --show x4y2 --format "$1" >../shown
	tr -cs 0-9 ' ' <../shown | sed 's/ /  /g' |
		grep ' 1  840 .* 15  5  1 .* 10  8  3 .* 6  9  6 .* 3  8  10 .* 1  5  15 '
}

show() {
	for format in text latex json c; do
		show_in $format
		mv ../shown ../x4y2.$format
	done
	gen --show x4y2 | cmp - ../x4y2.text
	grep -q '1/840' ../x4y2.text
	grep -qF '\frac{1}{840}' ../x4y2.latex
	valid_json ../x4y2.json
	cp ../x4y2.c main.c
	cat >>main.c <<-END
		int main(void)
		{
			double sum = ew_line_x4y2(0, 0, 1, 0) + ew_line_x4y2(1, 0, 1, 1)
				+ ew_line_x4y2(1, 1, 0, 1) + ew_line_x4y2(0, 1, 0, 0);
			return !(sum > 0.06666666666666 && sum < 0.06666666666667);
		}
	END
	$CC -o main main.c
	./main
}
check show

dumps() {
	unchanged . gen -d pdfs --max-degree 2 --polynomial soft=x*y >../dump
	gen -d pdfs --max-degree 2 --polynomial soft=x*y | cmp - ../dump
	[ -z "$(ls)" ]
	for pass in polynomial dag fused schedule; do
		grep -q ": $pass" ../dump
		gen -d "$(echo $pass | cut -c1)" >only
		grep -q ": $pass" only
		[ "$(grep -cE ': (polynomial|dag|fused|schedule)' only)" \
			-eq "$(grep -c ": $pass" only)" ]
	done
}
check dumps

list_help_version() {
	unchanged . gen --list >../list
	for word in moments curves distance closure coverage filters line quad conic cubic \
		portable fma double float mitchell matrix recurrence; do
		grep -qw $word ../list
	done
	gen --version | grep -q '^gen [0-9][0-9]*\.[0-9][0-9]*\.[0-9][0-9]*$'
	unchanged . gen --help >../help
	tr -cs 'a-z-' '\n' <../help | grep '^--[a-z]' | sort -u >../options
	[ "$(wc -l <../options)" -ge 20 ]
	while read -r option; do
		grep -q -e "$option" "$tests/cli_errors.sh"
		cat "$tests/cli.sh" "$tests/cli_families.sh" "$tests/cli_filters.sh" | grep -q -e "$option"
	done <../options
}
check list_help_version

folders() {
	gen --max-degree 0 --families moments --targets portable --out a/b//c/
	gen --max-degree 0 --families moments --targets portable --out a/b/c --check
	gen --max-degree 0 --families moments --targets portable --out d/e --dry-run
	[ ! -e d ]
}
check folders

quiet_and_verbose() {
	gen --quiet --out d >q 2>&1
	[ ! -s q ]
	gen --verbose --out e >v
	for file in e/*; do
		grep -q "^wrote $file\$" v
	done
	gen --verbose --out e >v
	refute grep -q '^wrote' v
	[ "$(grep -c '^unchanged' v)" -eq "$(($(find e -type f | wc -l)))" ]
	gen --verbose --precision float --out e | grep -q '^removed e/edgewise_line.c'
}
check quiet_and_verbose

value_after_equals() {
	gen --max-degree=2 --precision=float --polynomial=soft=x --prefix=foo --out=d --manifest=a
	gen --max-degree 2 --precision float --polynomial soft=x --prefix foo --out e --manifest b
	diff -r d e
	cmp a b
}
check value_after_equals

# ---- the same text everywhere; only what changed is written ----

same_output_everywhere() {
	set -- --max-degree 2 --polynomial soft=x*y --quiet
	gen "$@" --out reference
	mkdir 'else where'
	cp "$GEN" 'else where/other name'
	ln -s "$GEN" link
	sleep 1
	'else where/other name' "$@" --out copied
	./link "$@" --out linked
	(PATH=$work/bin && cd / && exec gen "$@" --out "$work/same_output_everywhere/from root")
	LC_ALL=de_DE.UTF-8 LANG=tr_TR.UTF-8 TZ=Asia/Tokyo gen "$@" --out locale
	env -i "$GEN" "$@" --out bare
	(umask 027 && gen "$@" --out masked)
	find masked -type f ! -perm 640 | refute grep .
	for d in copied linked 'from root' locale bare masked; do
		diff -r reference "$d"
	done
}
check same_output_everywhere

unchanged_files_keep_their_time() {
	gen --max-degree 3 --out d --manifest m --depfile p
	age .
	gen --max-degree 3 --out d --manifest m --depfile p
	touch -t 200001020000 ../stamp
	find . -newer ../stamp | refute grep .
	unchanged d gen --max-degree 3 --out d
	gen --max-degree 2 --out d
	[ -z "$(find d/edgewise_rings.c -newer ../stamp)" ]
	[ -n "$(find d/edgewise.h -newer ../stamp)" ]
}
check unchanged_files_keep_their_time

stale_files_go() {
	mkdir d d/sub
	echo mine | tee d/edgewise_mine.c d/notes.c >d/sub/edgewise_linef.c
	gen --max-degree 5 --polynomial soft=x --out d
	gen --max-degree 2 --precision double --no-runtime --out d
	gen --max-degree 2 --precision double --no-runtime --out fresh
	for file in edgewise_mine.c notes.c sub/edgewise_linef.c; do
		[ "$(cat d/$file)" = mine ]
	done
	rm -r d/sub d/notes.c d/edgewise_mine.c
	diff -r d fresh
}
check stale_files_go

changed_stale_file_stays() {
	gen --max-degree 1 --out d
	echo '/* by hand */' >>d/edgewise_linef.c
	cp d/edgewise_linef.c kept
	gen --max-degree 1 --precision double --out d 2>warning
	grep -q 'd/edgewise_linef.c.*changed' warning
	cmp d/edgewise_linef.c kept
	[ ! -e d/edgewise_momentsf_fma.c ]
}
check changed_stale_file_stays

# All victims hold "a", whose hash is known, so only their place protects them; that old.c goes
# shows that the hash is right.
hostile_manifest() {
	mkdir d d/sub
	printf a | tee victim d/.hidden d/sub/victim >d/old.c
	ln -s ../victim d/link.c
	{
		printf '{"generator": "gen 0.1.0",\n "files": ['
		for name in ../victim "$PWD/victim" sub/victim sub/../../victim .. . .hidden \
			link.c sub old.c; do
			printf '\n  {"file": "%s", "bytes": 1, "fnv1a64": "%s"},' \
				"$name" af63dc4c8601ec8c
		done
		printf '\n ]}\n'
	} >d/edgewise_manifest.json
	gen --max-degree 0 --out d
	for file in victim d/.hidden d/sub/victim; do
		[ "$(cat $file)" = a ]
	done
	[ ! -e d/old.c ]
}
check hostile_manifest

link_to_a_file_outside() {
	gen --max-degree 1 --out d
	mv d/edgewise.h outside.h
	ln -s ../outside.h d/edgewise.h
	cp outside.h kept
	gen --max-degree 2 --out d || true
	cmp outside.h kept
}
check link_to_a_file_outside

. "$tests/cli_families.sh"
. "$tests/cli_errors.sh"
. "$tests/cli_filters.sh"

finish

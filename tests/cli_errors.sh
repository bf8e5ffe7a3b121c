# cli_errors.sh - the errors of gen's command line; cli.sh reads this file and has the helpers.
#
# Every error has its exit status (2 bad input, 1 could not write), says "gen: " and what is wrong
# on standard error, prints nothing else, and leaves all as it was. The errors happen in the folder
# "guard": it holds an emission, so that whatever an error test asks for would have changed it.

guard=$work/guard
full=
[ -c /dev/full ] && full=/dev/full

make_guard() {
	rm -rf "$guard"
	mkdir "$guard" "$guard/folder"
	(
		cd "$guard" || exit 1
		gen --max-degree 1 --precision double --quiet
		gen --max-degree 1 --precision double --quiet --out foreign
		echo mine | tee file notes.txt generated/notes.c >foreign/edgewise_linef.c
		printf 'filter one\nseparable even\npiece 0 1/2 : 1\n' >one.filter
		ln one.filter linked
	)
	age "$guard"
	snapshot "$guard" >"$work/guard.before"
}

# STATUS PATTERN ARGUMENTS...: sets problem, empty if gen fails as it should.
try_error() {
	wanted=$1
	pattern=$2
	shift 2
	got=0
	(cd "$guard" && gen "$@") >"$work/stdout" 2>"$work/stderr" || got=$?
	judge_error "$wanted" "$pattern"
}

# STATUS PATTERN: of what stdout, stderr and got hold, and of the guarded folder.
judge_error() {
	problem=
	said=$(head -n 1 "$work/stderr" | cut -c 1-300)
	if [ $got -ne "$1" ]; then
		problem="status $got, not $1; it said: $said"
	elif ! head -n 1 "$work/stderr" | grep -q '^gen: ' \
		|| ! grep -qF -e "$2" "$work/stderr"; then
		problem="no word of '$2' in: $said"
	elif [ -s "$work/stdout" ]; then
		problem="standard output says $(head -n 1 "$work/stdout")"
	fi
	snapshot "$guard" >"$work/guard.after"
	if ! cmp -s "$work/guard.before" "$work/guard.after"; then
		change=$(diff "$work/guard.before" "$work/guard.after" | grep '^[<>]' | head -n 1)
		problem="${problem:+$problem; and }a file changed: $change"
		make_guard
	fi
}

# NAME STATUS PATTERN ARGUMENTS...
expect_error() {
	name=$1
	shift
	try_error "$@"
	verdict "$name" "$problem"
}

# LINE COLUMN PATTERN EXPRESSION: a mistake, shown with its line and a caret under the spot.
expect_caret() {
	try_error 2 "$3" --polynomial "p=$4"
	printf '%s\n' "$4" | awk -v line="$1" -v column="$2" 'NR == line {
		print "  " $0
		margin = substr($0, 1, column - 1)
		gsub(/[^\t]/, " ", margin)
		print "  " margin "^"
	}' >"$work/caret"
	if [ -z "$problem" ] \
		&& ! grep -q "^gen: --polynomial p: line $1, column $2: " "$work/stderr"; then
		problem="not line $1, column $2: $said"
	elif [ -z "$problem" ] && ! tail -n +2 "$work/stderr" | cmp -s - "$work/caret"; then
		problem="the caret is not under line $1, column $2"
	fi
	verdict "expression '$(printf %s "$4" | tr '\n\t' '  ' | cut -c 1-40)'" "$problem"
}

# EXPRESSION: needs more than 128 bits; the spot is any, but must be shown.
expect_overflow() {
	try_error 2 '128 bits' --polynomial "p=$1"
	if [ -z "$problem" ] && ! grep -q 'line 1, column [1-9]' "$work/stderr"; then
		problem="no line and column: $said"
	elif [ -z "$problem" ] && ! tail -n 1 "$work/stderr" | grep -q '^  *\^$'; then
		problem="no caret: $said"
	fi
	verdict "overflow in '$1'" "$problem"
}

# NAME ARGUMENTS...: standard output is full.
expect_full() {
	name=$1
	shift
	if [ -z "$full" ]; then
		skip "$name" 'no /dev/full'
		return
	fi
	got=0
	: >"$work/stdout"
	(cd "$guard" && gen "$@") >/dev/full 2>"$work/stderr" || got=$?
	judge_error 1 'standard output'
	verdict "$name" "$problem"
}

make_guard

# ---- options ----

expect_error 'unknown option' 2 "'--bogus'" --bogus
expect_error 'unknown option after good ones' 2 "'--degree'" --max-degree 2 --degree=3
expect_error 'unknown short option' 2 "'-x'" -x
expect_error 'operand' 2 "'file'" file
expect_error 'empty option' 2 "''" ''
for option in --max-degree --families --edges --monomial --polynomial --filter --precision \
	--targets --prefix --out --scheme --single-header --manifest --depfile --show --format -d; do
	expect_error "$option without value" 2 "$option" "$option"
	[ $option = --monomial ] || expect_error "$option with empty value" 2 "$option" "$option" ''
done
expect_error '--monomial with empty value' 2 "''" --monomial ''
for option in --no-runtime --check --dry-run --list --quiet --verbose --help --version; do
	expect_error "$option with value" 2 "$option" "$option=1"
done
for option in '--max-degree 2' '--families moments' '--edges quad' '--precision double' \
	'--targets fma' '--scheme horner' '--prefix foo' '--out new' '--single-header new' \
	'--manifest new' '--depfile new' '--show x1y0' '-d p'; do
	# shellcheck disable=SC2086
	expect_error "${option% *} twice" 2 "${option% *} is given twice" $option $option
done
expect_error '--format twice' 2 '--format is given twice' --show x1y0 --format c --format c
expect_error '--format without --show' 2 '--format goes with --show' --format c
expect_error '--format of unknown kind' 2 "'xml'" --show x4y2 --format xml
expect_error '--show with --max-degree' 2 '--max-degree' --show x4y2 --max-degree 2
expect_error '--show with --list' 2 '--list' --show x4y2 --list
expect_error '--list with --out' 2 '--out' --list --out new
expect_error '--quiet with --verbose' 2 '--quiet and --verbose' --quiet --verbose
expect_error '--check with --dry-run' 2 '--check and --dry-run' --check --dry-run
expect_error '--single-header with --out' 2 '--out' --single-header new --out generated
expect_error '--single-header with --no-runtime' 2 '--no-runtime' --single-header new --no-runtime
expect_error '-d with unknown letter' 2 "'px'" -d px
expect_error '--families with unknown word' 2 \
	"unknown word 'areas'; known: moments, curves, distance, closure, coverage, filters" \
	--families moments,areas
expect_error '--families with trailing comma' 2 "''" --families moments,
expect_error '--edges with unknown word' 2 "unknown word 'arc'; known: line, quad, conic, cubic" \
	--edges line,arc
expect_error '--edges with trailing comma' 2 "''" --edges quad,
expect_error '--edges in upper case' 2 "'Quad'" --edges Quad
for family in distance closure distance,closure coverage filters,coverage; do
	expect_error "--max-degree of $family" 2 '--max-degree goes with the families moments' \
		--max-degree 2 --families $family
done
expect_error 'monomial over conics' 2 '--monomial: one monomial over conics' --monomial x4y2 \
	--edges conic
expect_error 'monomial over conics too' 2 'over conics' --monomial x4y2 --edges line,conic
expect_error 'polynomial without lines' 2 'add line to --edges' --polynomial soft=x --edges quad
expect_error 'polynomial of a library without lines' 2 'add line to --edges' --max-degree 2 \
	--polynomial soft=x --edges quad,cubic
expect_error '--show with --edges' 2 '--edges' --show x4y2 --edges quad
expect_error '--list with --families' 2 '--families' --list --families curves
expect_error '--precision with unknown word' 2 "'half'" --precision half
expect_error '--targets with unknown word' 2 "'avx3'" --targets portable,avx3
expect_error '--scheme with unknown word' 2 "unknown word 'fast'; known: matrix, horner," \
	--scheme fast
expect_error '--scheme with two words' 2 "'matrix,horner'" --scheme matrix,horner
expect_error '--show with --scheme' 2 '--scheme' --show x4y2 --scheme matrix
for option in '--manifest new --depfile new' '--single-header new --manifest new' \
	'--manifest generated/edgewise.h' '--depfile new --single-header ./new'; do
	# shellcheck disable=SC2086
	expect_error "one file for two: $option" 2 "${option##* }" $option
done
for option in '--single-header one.filter' '--depfile ./one.filter' '--manifest linked' \
	'--dry-run --single-header folder/../one.filter'; do
	# shellcheck disable=SC2086
	expect_error "a source written over: $option" 2 "would overwrite one.filter, which is read" \
		--filter one.filter $option
done

# ---- degrees, monomials, names ----

for degree in 33 -1 1e9 1000000000 99999999999999999999 abc 4x ' 4' +4 0x4 4.0; do
	expect_error "--max-degree '$degree'" 2 "'$degree'" --max-degree "$degree"
done
for monomial in x4 x2y x4y 4x2y x40y0 x20y20 x-1y2 X4Y2 x4y2z y2x4 'x4 y2' xy \
	x99999999999999999999y0; do
	expect_error "--monomial '$monomial'" 2 "'$monomial'" --monomial "$monomial"
	expect_error "--show '$monomial'" 2 "'$monomial'" --show "$monomial"
done
expect_error 'monomial twice' 2 'x4y2' --monomial x4y2 --monomial x1y1 --monomial x4y2
expect_error 'monomial twice, written differently' 2 'x4y2' --monomial x4y2 --monomial x04y2
expect_error 'polynomial twice' 2 "'soft'" --polynomial soft=x --polynomial soft=y
expect_error 'soft and softf' 2 "'softf'" --polynomial soft=x --polynomial softf=y
expect_error 'softf and soft' 2 "'softf'" --polynomial softf=x --polynomial soft=y
for name in int class template constexpr _Bool Soft 1a a-b 'a b' a.b ../a é \
	aaaaaaaaaabbbbbbbbbbccccccccccddddddddddeeeeeeeeee; do
	expect_error "--prefix '$name'" 2 "'$name'" --prefix "$name"
	expect_error "--polynomial '$name'" 2 "'$name'" --polynomial "$name=x"
done
for name in math stdlib string; do
	expect_error "--prefix $name, a standard header" 2 "'$name'" --prefix "$name"
done
for name in area areaf line_x x1y0 x1y0f moments moments_about centroid version use_target \
	ring_x quad_x conic_area cubic_x4y2 path_moments radius radius_1 distance distancef closure \
	is_closed is_closedf below line_coverage coverage coveragef raster raster_u8 raster_pathf \
	filter_box deposit_tent; do
	expect_error "--polynomial $name, a library function" 2 "'$name'" --polynomial "$name=x"
done
expect_error '--polynomial without a name' 2 "''" --polynomial =x
expect_error '--polynomial without =' 2 "'soft'" --polynomial soft

# No name of the emitted code may be the name of a polynomial, or the code would not compile.
names_of_the_emitted_code() {
	gen --max-degree 1 --out d
	cat d/*.[ch] | tr -cs 'A-Za-z0-9_' '\n' \
		| sed -n 's/^ew_\([a-z0-9_]*\)$/\1/p' | sort -u >names
	[ "$(wc -l <names)" -gt 300 ]
	broken=
	while read -r name; do
		[ -n "$name" ] || continue
		gen --max-degree 1 --polynomial "$name=x" --single-header s.h 2>log || continue
		$CC -w -fsyntax-only -DEW_IMPLEMENTATION -x c s.h 2>log || broken="$broken $name"
	done <names
	echo "accepted, and does not compile:$broken"
	[ -z "$broken" ]
}
check names_of_the_emitted_code

# ---- expressions ----

expect_caret 1 1 'expected' ''
expect_caret 1 4 'expected' '(1-'
expect_caret 1 3 'expected' '1+'
expect_caret 1 2 'expected' '2x'
expect_caret 1 3 'expected' 'x y'
expect_caret 1 1 'expected' '))'
expect_caret 1 4 'expected' 'x*y)'
expect_caret 1 1 'expected' 'z'
expect_caret 1 1 'expected' 'X'
expect_caret 1 1 'expected' '.5'
expect_caret 1 2 'expected' '1e5'
expect_caret 1 3 'exponent' 'x^'
expect_caret 1 3 'exponent' 'x^-1'
expect_caret 1 3 'exponent' 'x^33'
expect_caret 1 3 'exponent' 'x^1.5'
expect_caret 1 3 'exponent' 'x^y'
expect_caret 1 6 'degree' 'x^20*y^20'
expect_caret 1 1 'degree' '(x*y)^17'
expect_caret 1 3 'division by zero' '1/0'
expect_caret 1 3 'division by zero' '1/(x-x)'
expect_caret 1 3 'division by' '1/x'
expect_caret 1 1 '0 everywhere' 'x - x'
expect_caret 1 1 'digits' 12345678901234567890123456789012345678901234567890
expect_caret 2 1 'expected' 'x
y'
expect_caret 2 3 'expected' 'x +
  z'
expect_caret 3 6 'expected' "(1 +
	x) *
	 x +)
+ 1"
expect_overflow '10^20*10^20'
expect_overflow '(10^32)*(10^32)*x'
expect_overflow '((10^6)^6)^6'
expect_overflow '1/10^30 + 1/7^30'
expect_error 'overflow after reading' 2 '128 bits' --polynomial 'p=(1/3 + x/7 + y/11)^32'
deep=$(printf '%0100000d' 0)
expect_error 'parentheses 100000 deep' 2 'nested too deep' \
	--polynomial "p=$(echo "$deep" | tr 0 '(')"
expect_error '100000 signs' 2 'line 1, column' --polynomial "p=$(echo "$deep" | tr 0 -)x"
expect_error '100000 digits' 2 'digits' --polynomial "p=$deep"

# ---- places that cannot be written ----

expect_error '--out is a file' 1 'file' --out file
expect_error 'folders made in vain' 1 'absent/new' --out one/two --depfile absent/new
expect_error '--out below a file' 1 'file' --out file/new
expect_error '--check of a file' 1 'file' --out file --check
for option in --single-header --manifest --depfile; do
	expect_error "$option is a folder" 1 'folder' $option folder
	expect_error "$option without its parent" 1 'absent/new' $option absent/new
done
expect_error 'a foreign file in the way' 1 'foreign/edgewise_linef.c' --out foreign
expect_error 'a foreign file in the way of --check' 1 'foreign/edgewise_linef.c' \
	--out foreign --check
echo '/* My own file. SPDX-License-Identifier: 0BSD */' >"$guard/foreign/edgewise_linef.c"
snapshot "$guard" >"$work/guard.before"
expect_error 'a foreign file with our licence in the way' 1 'foreign/edgewise_linef.c' --out foreign

expect_error 'new folder below /proc' 1 '/proc/new' --out /proc/new
expect_error '--out is /proc/self' 1 '/proc/self' --out /proc/self
if [ "$(id -u)" -ne 0 ]; then
	chmod 555 "$guard/folder"
	snapshot "$guard" >"$work/guard.before"
	expect_error 'folder without permission' 1 'folder' --out folder
	expect_error 'new folder without permission' 1 'folder/new' --out folder/new
	expect_error 'file without permission' 1 'folder/new' --single-header folder/new
	chmod 755 "$guard/folder"
	snapshot "$guard" >"$work/guard.before"
else
	skip 'folder without permission' 'root may write everywhere'
fi

mkdir "$work/readonly" "$work/small"
if mount -t tmpfs -o ro tmpfs "$work/readonly" 2>/dev/null; then
	expect_error 'read-only folder' 1 "$work/readonly" --out "$work/readonly"
	expect_error 'new folder on a read-only disk' 1 "$work/readonly/new" \
		--out "$work/readonly/new"
	expect_error 'file on a read-only disk' 1 "$work/readonly/new" \
		--manifest "$work/readonly/new"
	umount "$work/readonly"
else
	skip 'read-only folder' 'mount is not permitted'
fi

# ---- full disk ----

if [ -n "$full" ]; then
	for option in --single-header --manifest --depfile; do
		expect_error "$option /dev/full" 1 '/dev/full' $option /dev/full
		[ $option = --single-header ] || expect_error "$option /dev/full, new folder" 1 \
			'/dev/full' $option /dev/full --out new
	done
	expect_error 'manifest /dev/full beside a single header' 1 '/dev/full' \
		--single-header new --manifest /dev/full
	[ -c /dev/full ] || verdict 'a device stays a device' '/dev/full is gone'
else
	skip '/dev/full as a file' 'no /dev/full'
fi
for format in text latex json c; do
	expect_full "--show --format $format on a full disk" --show x4y2 --format $format
done
expect_full '--list on a full disk' --list
expect_full '--help on a full disk' --help
expect_full '--version on a full disk' --version
expect_full '-d on a full disk' -d pdfs
expect_full '--check on a full disk' --check
expect_full '--dry-run on a full disk' --dry-run

small_disk() {
	small=$work/small
	unchanged "$small" status 1 gen --max-degree 4 --out "$small/d" 2>message
	grep -q '^gen: .*No space left' message
	request='--max-degree 0 --families moments --precision double --targets portable'
	# shellcheck disable=SC2086
	gen $request --out "$small/d"
	unchanged "$small" status 1 gen --max-degree 4 --out "$small/d" 2>message
	grep -q '^gen: .*No space left' message
	# shellcheck disable=SC2086
	gen $request --out "$small/d" --check
	unchanged "$small" status 1 gen --single-header "$small/s.h" 2>message
	gen --max-degree 3 --out d
	cp -R d kept
	unchanged d status 1 gen --max-degree 1 --out d --manifest "$small/d/m" \
		--depfile "$small/absent/d"
	diff -r d kept
}
if mount -t tmpfs -o size=512k tmpfs "$work/small" 2>/dev/null; then
	check small_disk
	umount "$work/small"
else
	skip 'small disk' 'mount is not permitted'
fi

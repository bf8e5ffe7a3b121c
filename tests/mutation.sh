#!/bin/sh
# mutation.sh [BUILD] - breaks things on purpose; every break must be caught.
#
# (a) One coefficient, sign or index in gen: the proof must stop gen before it writes a file.
# The schemes, fusion and schedule are covered one by one, and Green's theorem itself, which
# the schemes with formulas of their own contradict. A change that only spoils the mirrored order
# of evaluation keeps every value and must fall to the reversal proof.
# (b) The same in emitted files, where no proof can see it: the kernel tests must name the broken
# function.
# A mutation whose pattern is not found counts as a failure, so that the list keeps up with the
# sources.
set -u
build=${1:-build}
tests=$(dirname "$0")
root=$tests/..
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
unset MAKEFLAGS MFLAGS MAKELEVEL SAN
not_ok() { echo "not ok $1: $2"; }

# name|file of gen/|sed script
cat >"$work/gen.list" <<'END'
recurrence, index of y0 h|moments.c|/VAR_Y0\], r->h/s/h\[m\]\[n - 1\]/h[m][n]/
recurrence, neighbour of h|moments.c|/VAR_X0\], r->h/s/h\[m - 1\]\[n\]/h[m][n - 1]/
recurrence, binomial of the source|moments.c|s/rat(int_binomial(m + n, n), 1), r->w/rat(int_binomial(m + n, m + 1), 1), r->w/
recurrence, end of the weight|moments.c|s/m ? VAR_X1 : VAR_Y1/m ? VAR_X0 : VAR_Y1/
recurrence, factor of a moment|moments.c|s/(m + n + 2) \* (m + n + 1), int_binomial/(m + n + 2) * (m + n + 2), int_binomial/
recurrence, top source|moments.c|s/rat(1, (m + n + 2) \* (m + n + 1))/rat(1, (m + n + 2) * (m + n))/
even-power, sign of degree 2|moments.c|s/rat(-1, 24)/rat(1, 24)/
even-power, factor of degree 3|moments.c|s/rat(1, 40)/rat(1, 48)/
even-power, share of degree 3|moments.c|s/i == 1 ? rat(2, 3) : rat(1, 3);$/i == 1 ? rat(1, 3) : rat(1, 3);/
even-power, index of degree 4|moments.c|s/even->ee\[n - i\]/even->ee[i]/
even-power, half of a single integrand|scheme.c|s/poly_sub(sum, half), rat(1, 2)/poly_sub(sum, half), rat(1, 3)/
shared, sign of xy|moments.c|s/Ref xy = dag_sub(dag, dag_mul/Ref xy = dag_add(dag, dag_mul/
shared, product of xx|moments.c|s/x0a = dag_mul(dag, x0, a)/x0a = dag_mul(dag, x1, a)/
vertex, index of the height|scheme.c|s/VAR_Y0, VAR_Y2, "height"/VAR_Y1, VAR_Y2, "height"/
vertex, factor|scheme.c|/"height"/,/^}/s/rat(1, 2)/rat(1, 1)/
matrix, end of a power of x|scheme.c|s/axis_part(dag, &end, image, X_VARS/axis_part(dag, \&end, x, X_VARS/
matrix, coefficient of a row|scheme.c|s/return dag_scale(dag, term.coef, axis_part/return dag_scale(dag, rat_add(term.coef, rat(1, 1)), axis_part/
matrix, sign of the cross product|evaluate.c|s/dag_sub(dag, left, right), "s"/dag_add(dag, left, right), "s"/
horner, variable|evaluate.c|s/sum = dag_mul(dag, sum, dag_var(dag, var))/sum = dag_mul(dag, sum, dag_var(dag, VAR_X0))/
finish, content of the last form|scheme.c|s/dag_out(dag, dag_scale(dag, content, sum));/dag_out(dag, dag_scale(dag, rat_mul(content, content), sum));/
fuse, FMA for FMS|fuse.c|s/fused(f, OP_FMS, a, b)/fused(f, OP_FMA, a, b)/
fuse, operand of a product|fuse.c|s/f->map\[mul->arg\[1\]\]/f->map[mul->arg[0]]/
schedule, order|schedule.c|s/^\tprogram->order\[program->count++\] = ref;/\tprogram->order[program->count++] = node->arg[0];/
schedule, last use|schedule.c|s/program->last\[node->arg\[k\]\] = at;/program->last[node->arg[k]] = at - 1;/
Green, integral over the edge|green.c|s/int_mul(p + q + 1, int_binomial/int_mul(p + q + 2, int_binomial/
Green, divergence of the field|green.c|s/rat(degree + 2, 1)/rat(degree + 1, 1)/
reversal, order of a mirrored row|scheme.c|s/part.term\[i\], reflect)/part.term[reflect ? part.count - 1 - i : i], reflect)/
END

# name|emitted file|sed script|test|what its first failure must name
cat >"$work/emitted.list" <<'END'
coefficient of x4y2|edgewise_line.c|/^double ew_line_x4y2/,/^}/s/15\.0/16.0/|lines|x4y2
sign in x3y3, float|edgewise_linef.c|/^float ew_line_x3y3f/,/^}/s/ = x0 \* y1 - x1/ = x0 * y1 + x1/|lines|x3y3f
sign in moments of degree 2|edgewise_moments_fma.c|/^EW_.*moments_2_fma/,/^}/s/-t\([0-9]*\));/t\1);/|rings|EW_RING_MOMENTS_2
index in moments of degree 6, float|edgewise_momentsf_portable.c|/moments_6f_portable/,/^}/s/acc9 = acc9/acc9 = acc8/|rings|EW_RING_MOMENTS_6
index in the finish of degree 3|edgewise_finish.c|/moments_3_finish/,/^}/s/\* sum\[9\]/* sum[8]/|rings|EW_RING_MOMENTS_3
sign in x2y2|edgewise_integrands_portable.c|/ew_ring_x2y2_portable/,/^}/s/ = x1 - x0;/ = x1 + x0;/|rings|EW_RING_X2Y2
END

# mutate_gen TREE NAME FILE SCRIPT: in a copy of the sources,
# where make rebuilds what the mutation touches.
mutate_gen() {
	name=$2 file=$1/gen/$3
	cp "$file" "$1/original"
	sed "$4" "$1/original" >"$file"
	rm -rf "$1/out"
	if cmp -s "$file" "$1/original"; then
		not_ok "$name" "nothing to mutate in gen/$3"
	elif ! build_gen "$1" >"$1/log" 2>&1; then
		not_ok "$name" "does not compile: $(grep -m 1 error "$1/log")"
	elif "$1/build/gen" --max-degree 6 --out "$1/out" >/dev/null 2>"$1/log"; then
		not_ok "$name" "gen did not notice"
	elif ! grep -q 'internal error, nothing was written' "$1/log"; then
		not_ok "$name" "not the proof: $(head -n 1 "$1/log")"
	elif [ -e "$1/out" ]; then
		not_ok "$name" "files were written"
	elif [ "${name%%,*}" = reversal ] && ! grep -q 'bit for bit' "$1/log"; then
		not_ok "$name" "not the reversal proof: $(head -n 1 "$1/log")"
	else
		echo "ok $name"
	fi
	cp "$1/original" "$file"
}

build_gen() { make -s -C "$1" B=build CFLAGS=-O1 LDFLAGS= build/gen; }

# worker REMAINDER: every second mutation of gen, in a tree of its own
worker() {
	tree=$work/tree$1
	mkdir "$tree" && cp -r "$root/gen" "$root/runtime" "$root/Makefile" "$tree" || exit 1
	if ! { build_gen "$tree" && "$tree/build/gen" --quiet --max-degree 6 --out "$tree/out"; } \
		>"$tree/log" 2>&1; then
		not_ok "gen without mutation" "$(head -n 1 "$tree/log")"
		return
	fi
	awk -v r="$1" 'NR % 2 == r' "$work/gen.list" | while IFS='|' read -r name file script; do
		mutate_gen "$tree" "$name" "$file" "$script"
	done
}

# first_failure TEST OBJECT...
first_failure() {
	test=$tests/$1.c
	shift
	${CC:-cc} $flags -o "$work/test" "$test" "$tests/reference.c" "$@" -lmpfr -lgmp -lm 2>&1 &&
		"$work/test" 2>&1 | awk '/^not ok/ { print; exit }'
}

# mutate_emitted NAME FILE SCRIPT TEST PART: the first failure of TEST must have PART in it.
mutate_emitted() {
	name=$1 object=$work/lib/${2%.c}.o
	sed "$3" "$build/emitted/$2" >"$work/$2"
	cp "$object" "$work/original.o"
	if cmp -s "$work/$2" "$build/emitted/$2"; then
		not_ok "$name" "nothing to mutate in $2"
	elif ! ${CC:-cc} $flags -c -o "$object" "$work/$2" >"$work/log" 2>&1; then
		not_ok "$name" "does not compile: $(grep -m 1 error "$work/log")"
	else
		first=$(first_failure "$4" "$work"/lib/*.o)
		case $first in
		*"$5"*) echo "ok $name" ;;
		*) not_ok "$name" "tests/$4.c said: ${first:-nothing}" ;;
		esac
	fi
	cp "$work/original.o" "$object"
}

test_emitted() {
	mkdir "$work/lib"
	for file in "$build"/emitted/*.c; do
		${CC:-cc} $flags -c -o "$work/lib/$(basename "$file" .c).o" "$file" ||
			not_ok "$file" "does not compile"
	done
	for test in lines rings; do
		first=$(first_failure $test "$work"/lib/*.o)
		[ -z "$first" ] || not_ok "$test without mutation" "$first"
	done
	while IFS='|' read -r name file script test part; do
		mutate_emitted "$name" "$file" "$script" "$test" "$part"
	done <"$work/emitted.list"
}

flags="-std=c11 -O1 -D_POSIX_C_SOURCE=200809L -ffp-contract=off -I$build/emitted -I$tests"
worker 0 >"$work/out0" &
worker 1 >"$work/out1"
wait
if echo '#include <mpfr.h>' | ${CC:-cc} -x c -fsyntax-only - 2>/dev/null; then
	test_emitted >"$work/out2"
else
	echo "skip emitted files: libmpfr-dev is not installed" >"$work/out2"
fi
cat "$work"/out?
cat "$work"/out? | awk '
	/^ok/ { ++ok }
	/^not ok/ { ++bad }
	END { print ok + 0 " passed, " bad + 0 " failed"; exit bad > 0 }'

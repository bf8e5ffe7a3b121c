#!/bin/sh
# mutation.sh [BUILD] - breaks things on purpose; every break must be caught.
#
# (a) One coefficient, sign or index in gen: the proof must stop gen before it writes a file.
# The schemes, fusion and schedule are covered one by one, and Green's theorem itself, which
# the schemes with formulas of their own contradict; so are windows, the cells of filters, whose
# integrals the proof takes from the filter's own pieces, and deposits. A change that only spoils
# the mirrored order of evaluation keeps every value and must fall to the reversal proof.
# (b) Some of gen that has no meaning over the rationals, where rounding errors are 0 and an
# absolute value is a matter of signs: a small library that it emits must fail its tests.
# (c) The same in the emitted files of BUILD and in the runtime, where no proof can see it: the
# tests, which are suites that pass unharmed, must name the broken function.
# A mutation whose pattern is not found counts as a failure, so that the list keeps up with the
# sources.
set -u
build=${1:-build}
. "$(dirname "$0")/verdict.sh"

# name|file of gen/|sed script
cat >"$work/proof.list" <<'END'
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
vertex, index of the height|moments.c|s/VAR_Y0, VAR_Y2, "height"/VAR_Y1, VAR_Y2, "height"/
vertex, factor|moments.c|/"height"/,/^}/s/rat(1, 2)/rat(1, 1)/
magnitudes, sign at the start|moments.c|s/dag_add(dag, left, right), degree/dag_sub(dag, left, right), degree/
magnitudes, start of the weights|moments.c|s/r->h\[0\]\[0\] = r->w\[0\]\[0\] = start/r->h[0][0] = start, r->w[0][0] = end.ref[VAR_X0]/
magnitudes, sign of a width|moments.c|s/dag_unary(dag, OP_ABS, width)/width/
compensated, product of an error|compensated.c|s/OP_ERROR, x0, y1, left/OP_ERROR, x0, y1, right/
compensated, sum|compensated.c|s/dag_out(dag, second.sum)/dag_out(dag, first.sum)/
matrix, end of a power of x|scheme.c|s/axis_part(dag, &end, image, X_VARS/axis_part(dag, \&end, x, X_VARS/
matrix, coefficient of a row|scheme.c|s/return dag_scale(dag, term.coef, axis_part/return dag_scale(dag, rat_add(term.coef, rat(1, 1)), axis_part/
matrix, sign of the cross product|evaluate.c|s/dag_sub(dag, left, right), "s"/dag_add(dag, left, right), "s"/
horner, variable|evaluate.c|s/sum = dag_mul(dag, sum, dag_var(dag, var))/sum = dag_mul(dag, sum, dag_var(dag, VAR_X0))/
finish, content of the last form|scheme.c|s/dag_out(dag, dag_scale(dag, content, sum));/dag_out(dag, dag_scale(dag, rat_mul(content, content), sum));/
fuse, FMA for FMS|fuse.c|s/fused(f, OP_FMS, a, b)/fused(f, OP_FMA, a, b)/
fuse, what a product lost|fuse.c|/OP_ERROR/,/return/s/OP_FMS/OP_FMA/
fuse, operand of a product|fuse.c|s/f->map\[mul->arg\[1\]\]/f->map[mul->arg[0]]/
schedule, order|schedule.c|s/^\tprogram->order\[program->count++\] = ref;/\tprogram->order[program->count++] = node->arg[0];/
schedule, last use|schedule.c|s/program->last\[node->arg\[k\]\] = at;/program->last[node->arg[k]] = at - 1;/
curves, coefficient of a cubic|curves.c|s/coef\[3\] = dag_sub/coef[3] = dag_add/
curves, factor of a first moment|curves.c|s/whole \/ (j + k + 1)/whole \/ (j + k + 2)/
curves, sign of a node|curves.c|s/= i ? dag_sub : dag_add;/= i ? dag_add : dag_add;/
curves, power at a node|curves.c|s/power\[i\].at\[m - 1\]\[0\], v\[i\].x/power[i].at[m - 1][0], v[i].y/
curves, one node fewer|curves.c|/by_nodes(int/,/^}/s/gauss_legendre(curve_nodes(window, degree)/gauss_legendre(curve_nodes(window, degree) - 1/
curves, area of a cubic|curves.c|s/scaled(dag, 6, dag_add(dag, c01, c23))/scaled(dag, 5, dag_add(dag, c01, c23))/
closure, sign|distance.c|s/dag_accumulate(dag, dag_sub(dag, start, end))/dag_accumulate(dag, dag_add(dag, start, end))/
reversal, mirrored products|distance.c|s/left = dag_unary(dag, OP_ABS, a), right = dag_unary(dag, OP_ABS, b)/left = a, right = b/
coverage, sign of what sticks out|window.c|s/dag_sub(dag, dag_add(dag, both, raised), lowered)/dag_add(dag, dag_add(dag, both, raised), lowered)/
coverage, swapped heights|window.c|s/y.left = dag_add(dag, ay, dag_mul(dag, ahead/y.left = dag_add(dag, ay, dag_mul(dag, behind/
filter, one node fewer|window.c|/^static Ref along/,/^}/s/cells_nodes(across, up), tau/cells_nodes(across, up) - (up.count > 1), tau/
filter, side of the columns above|window.c|s/start = cell_value(dag, above, x\[cells->rows\], NONE)/start = cell_value(dag, above, x[0], NONE)/
filter, base of a row|window.c|s/Ref up = dag_sub(dag, dag_const(dag, cells->y\[r\]), low)/Ref up = dag_sub(dag, dag_const(dag, cells->y[0]), low)/
cells, nodes of the rule|cells.c|s/degree_in_xy(up)) \/ 2 + 1/degree_in_xy(up) + 2) \/ 3/
cells, integral below a row|cells.c|s/up\[r\] = poly_add(below, poly_integral(rows\[r\], VAR_Y))/up[r] = poly_integral(rows[r], VAR_Y)/
cells, integral above all rows|cells.c|s/poly_mul(cells->across\[q\], whole)/poly_add(cells->across[q], whole)/
cells, corner|cells.c|s/poly_add(poly_var(VAR_X), poly_const(x))/poly_sub(poly_var(VAR_X), poly_const(x))/
deposit, row|deposit.c|s/, s = d->size - 1 - r;/, s = r - 1;/;s/const int s = d->size - 1 - r;/const int s = r - 1;/
deposit, sign of an odd part|deposit.c|s/: dag_sub(dag, even, odd);/: dag_add(dag, even, odd);/
deposit, snapped constant|deposit.c|s/b = rat_sub(in_units(after, d->unit), a)/b = rat_sub(after, a)/
deposit, swapped heights|deposit.c|s/start = dag_choose(dag, run, v0, v1), end = dag_choose(dag, run, v1, v0)/start = dag_choose(dag, run, v1, v0), end = dag_choose(dag, run, v0, v1)/
deposit, one node fewer|deposit.c|s/n.nodes = gauss_legendre(count, tau, weight)/n.nodes = gauss_legendre(count - (count > 1), tau, weight)/
deposit, nodes of the rule|deposit.c|s/most = nodes > most ? nodes : most;/most = nodes < most ? nodes : most;/
Green, control points of a curve|green.c|s/int_binomial(p, i), 1)/int_binomial(p, i) + i, 1)/
Green, integral over the edge|green.c|s/int_mul(p + q + 1, int_binomial/int_mul(p + q + 2, int_binomial/
Green, divergence of the field|green.c|s/rat(degree + 2, 1)/rat(degree + 1, 1)/
reversal, order of a mirrored row|scheme.c|s/part.term\[i\], reflect)/part.term[reflect ? part.count - 1 - i : i], reflect)/
reversal, side of a cell|window.c|s/Ref end = clamp(dag, dag_var(dag, VAR_X1), u0, u1)/Ref end = clamp(dag, dag_var(dag, VAR_X1), u1, u0)/
reversal, ends of a deposit in order|deposit.c|s/Ref left = dag_node(dag, OP_MIN, d->u0, d->u1, NONE)/Ref left = d->u0/;s/Ref right = dag_node(dag, OP_MAX, d->u0, d->u1, NONE)/Ref right = d->u1/;s/start = dag_choose(dag, run, v0, v1), end = dag_choose(dag, run, v1, v0)/start = v0, end = v1/
END

# name|file of gen/|sed script|test|what its first failure must name
cat >"$work/rounding.list" <<'END'
compensated, sign in TwoSum|compensated.c|s/dag_sub(dag, lost_a, lost_b) : dag_add/dag_add(dag, lost_a, lost_b) : dag_add/|compensated|compensated area
compensated, part of a sum|compensated.c|s/part = dag_sub(dag, sum, a)/part = dag_sub(dag, sum, b)/|compensated|compensated area
compensated, sign of an error|compensated.c|s/dag_sub(dag, left_error, right_error)/dag_add(dag, left_error, right_error)/|compensated|compensated area
distance, series beyond its range|distance.c|s/dag_choose(dag, log.k, beyond, log.series);/log.series;/|distance|edges within
distance, term of the third power|distance.c|s/rat(3, 8), h2/rat(5, 8), h2/|distance|edges within
distance, seam of the inverse|distance.c|s/const Rat seam = rat(3, 4)/const Rat seam = rat(2, 1)/|distance|edges within
conic, side of the seam|conic.c|s/dag_sub(dag, w, dag_const(dag, rat(2, 1)))/dag_sub(dag, dag_const(dag, rat(2, 1)), w)/|conics|f(w)
conic, power of R|conic.c|s/value\[i\] = dag_mul(dag, value\[i\], square\[i\]);/value[i] = dag_mul(dag, value[i], value[i]);/|conics|moments
deposit, totals in halves of units|deposit.c|s/d.round = dag_const(dag, rat(3 << 22, 1))/d.round = dag_const(dag, rat(3 << 21, 1))/|kernels|ew_deposit_
magnitudes, coordinate with its sign|moments.c|s/end.ref\[var\] = dag_unary(dag, OP_ABS, end.ref\[var\]);/end.ref[var] = dag_add(dag, end.ref[var], NONE);/|bounded|magnitudes
END

# name|emitted file|what is compiled, if not that|sed script|test|what its first failure must name
# A name that begins with a target is left out where the CPU does not have it.
cat >"$work/emitted.list" <<'END'
coefficient of x4y2|edgewise_line.c||/^double ew_line_x4y2/,/^}/s/15\.0/16.0/|lines|x4y2
sign in x3y3, float|edgewise_linef.c||/^float ew_line_x3y3f/,/^}/s/ = x0 \* y1 - x1/ = x0 * y1 + x1/|lines|x3y3f
sign in moments of degree 2|edgewise_moments_fma.c||/^EW_.*moments_2_fma/,/^}/s/-t\([0-9]*\));/t\1);/|rings|EW_RING_MOMENTS_2
index in moments of degree 6, float|edgewise_momentsf_portable.c||/moments_6f_portable/,/^}/s/acc9 = acc9/acc9 = acc8/|rings|EW_RING_MOMENTS_6
index in the finish of degree 3|edgewise_finish.c||/moments_3_finish/,/^}/s/sum\[9 \* stride/sum[8 * stride/|rings|EW_RING_MOMENTS_3
sign in x2y2|edgewise_integrands_portable.c||/ew_ring_x2y2_portable/,/^}/s/ = x1 - x0;/ = x1 + x0;/|rings|EW_RING_X2Y2
absolute value in magnitudes of degree 1|edgewise_trust_fma.c||/magnitudes_1_fma/,/^}/s/fabs(x0)/x0/|bounded|magnitudes
avx512: shift of the next vector|edgewise_moments_avx512.c||/moments_1_avx512(/,/^}/s/pd_si512(xa), 1)/pd_si512(xa), 2)/|lanes|double, avx512
avx512: mask one too wide|edgewise_moments_avx512.c||/moments_1_avx512(/,/^}/s/(1u << rest) - 1/(2u << rest) - 1/|lanes|double, avx512
avx2: second turn of the area|edgewise_momentsf_avx2.c||/moments_0f_avx2(/,/^}/s/y + i + step + 2 \* reach/y + i + step + reach/|lanes|float, avx2
avx512: second item of the stored shape|edgewise_moments_avx512.c||/moments_6_avx512(/,/^}/s/acc4, h1_1_2/acc4, h1_1/|rings|avx512
length of a short ring|edgewise_rings_template.h|edgewise_rings.c|s/if (v->n < EW_SHORT)/if (v->n <= EW_SHORT)/|lanes|virtual lanes
closing vertex of a short ring|edgewise_rings_template.h|edgewise_rings.c|s/v.n -= n == EW_SHORT/v.n -= n == EW_SHORT + 1/|rings|explicitly closed
lost part of two sums|edgewise_trust_template.h|edgewise_rings.c|s/+ (value - part);/- (value - part);/|compensated|compensated area
avx2: second side of a cell, float|edgewise_coveragef_avx2.c||s/u1 = _mm256_loadu_ps(origin + 16 + pass)/u1 = _mm256_loadu_ps(origin + pass)/|kernels|ew_ring_coveragef_avx2
avx512: second item of a cell|edgewise_coverage_avx512.c||s/const __m512d y1_2 = _mm512_loadu_pd(y + i + step + reach)/const __m512d y1_2 = _mm512_loadu_pd(y + i + reach)/|kernels|ew_ring_coverage_avx512
avx2: lower end of a clamp|edgewise_filters_avx2.c||/ring_tent_avx2(/,/^}/s/EW_MAX_mm256_pd(\([a-z0-9]*\), .*);/\1;/|kernels|ew_ring_tent_avx2
avx2: piece of a deposit|edgewise_deposit_avx2.c||/deposit_tent_avx2(/,/^}/s/x + reach + i/x + i/|kernels|ew_deposit_tent_avx2
avx512: row of a deposit|edgewise_deposit_avx512.c||/deposit_mitchell_avx512(/,/^}/s/ reach + i, out7)/ reach + i, out6)/|kernels|ew_deposit_mitchell_avx512
end of a deposit, plain|edgewise_deposit_portable.c||/deposit_box_portable(/,/^}/s/i < count/i <= count/|kernels|ew_deposit_box_portable
avx2: lane of a gathered ring|edgewise_columns.c||/ew_ring_block_avx2(/,/^}/s/start\[2\]/start[3]/|batches|mixed sizes between guard pages, double, avx2
avx2: a sum that is not finite|edgewise_columns_template.h|edgewise_columns.c|s/return off == 0;/return 1;/|batches|mixed sizes between guard pages, double, avx2
avx2: a ring that is left out|edgewise_batches_template.h|edgewise_rings.c|s/left_out ? (EW_REAL)NAN : sum/0 ? (EW_REAL)NAN : sum/|batches|mixed sizes between guard pages, double, avx2
avx2: finish of rings side by side|edgewise_finish_avx2.c||/moments_2_finish_avx2/,/^}/s/, sum4);/, sum3);/|batches|mixed sizes between guard pages, double, avx2
END

tree=$work/tree

# A copy of the sources and of gen's objects, where make rebuilds what a mutation touches.
make_tree() {
	mkdir -p "$tree/build" &&
		cp -Rp "$root/gen" "$root/runtime" "$root/tests" "$root/bench" "$root/examples" \
			"$root/Makefile" "$tree" &&
		cp -Rp "$build/obj" "$build/embed" "$build/gen" "$tree/build"
}

# TARGET: at the level at which compilers are fastest
make_it() {
	make -s -j1 -C "$tree" B=build CFLAGS=-O0 REQUEST='--max-degree 2 --targets fma --quiet' \
		${sanitize:+SAN=1} "build/$1" >"$work/log" 2>&1
}

# mutate_gen NAME FILE SCRIPT TEST WORDS: with TEST, that must tell, else the proof. Source and object
# come back with their times.
mutate_gen() {
	file=$tree/gen/$2 object=$tree/build/obj/${2%.c}.o
	mv "$file" "$work/original.c"
	mv "$object" "$work/original.o"
	sed "$3" "$work/original.c" >"$file"
	if cmp -s "$file" "$work/original.c"; then
		verdict "$1" "nothing to mutate in gen/$2"
	elif ! make_it gen; then
		verdict "$1" "does not compile: $(grep -m 1 error "$work/log")"
	elif [ "${4:-}" ]; then
		verdict "$1" "$(untested "$4" "$5")"
	else
		verdict "$1" "$(unproven "$1")"
	fi
	mv "$work/original.c" "$file"
	mv "$work/original.o" "$object"
}

# NAME: what is wrong if the proof does not stop gen.
unproven() {
	if "$tree/build/gen" --max-degree 6 --out "$work/out" >/dev/null 2>"$work/log"; then
		echo "gen did not notice"
	elif ! grep -q 'internal error, nothing was written' "$work/log"; then
		echo "not the proof: $(head -n 1 "$work/log")"
	elif [ -e "$work/out" ]; then
		echo "files were written"
	else
		case ${1%%,*} in
		reversal) words='does not negate .* bit for bit' ;;
		coverage | filter | cells | deposit) words='the proof failed' ;;
		*) words= ;;
		esac
		grep -q "$words" "$work/log" || echo "not '$words': $(head -n 1 "$work/log")"
	fi
	rm -rf "$work/out"
}

# TEST WORDS: what is wrong if the test passes.
untested() {
	if ! make_it emitted.stamp; then
		echo "the proof noticed: $(head -n 1 "$work/log")"
	elif ! make_it "tests/$1"; then
		echo "does not compile: $(grep -m 1 error "$work/log")"
	else
		first_failure "$tree/build/tests/$1" "$2"
	fi
}

# PROGRAM WORDS: the first failure if it has not these words; nobody waits for what comes after it.
first_failure() {
	"$1" >"$work/pipe" 2>&1 &
	tested=$!
	first=$(grep -m 1 '^not ok' "$work/pipe")
	kill $tested 2>/dev/null
	wait $tested 2>/dev/null
	case $first in
	*"$2"*) ;;
	*) echo "the test said: ${first:-nothing}" ;;
	esac
}

# LIST of mutations of gen
test_gen() {
	while IFS='|' read -r name file script test words; do
		mutate_gen "$name" "$file" "$script" "$test" "$words"
	done <"$1"
}

compile() {
	${CC:-cc} -std=gnu11 -O1 -ffp-contract=off $sanitize -I"$tests" \
		-I"$build/emitted" "$@"
}

# mutate_emitted NAME FILE SOURCE SCRIPT TEST WORDS: the mutated object stands before the library,
# where the linker finds its functions first.
mutate_emitted() {
	source=${3:-$2}
	rm -rf "$work/mutated"
	mkdir "$work/mutated"
	cp "$build/emitted/$source" "$work/mutated"
	sed "$4" "$build/emitted/$2" >"$work/mutated/$2"
	[ -f "$work/$5.o" ] || compile -c -o "$work/$5.o" "$tests/$5.c"
	if cmp -s "$work/mutated/$2" "$build/emitted/$2"; then
		verdict "$1" "nothing to mutate in $2"
	elif ! compile -o "$work/$5" "$work/$5.o" "$build/tests/reference.o" \
		"$work/mutated/$source" "$build/libedgewise.a" -lmpfr -lgmp -lm >"$work/log" 2>&1; then
		verdict "$1" "does not compile: $(grep -m 1 error "$work/log")"
	else
		verdict "$1" "$(first_failure "$work/$5" "$6")"
	fi
}

test_emitted() {
	"$build/tests/lanes" >"$work/lanes.log"
	while IFS='|' read -r name file source script test words; do
		target=$(expr "$name" : '\([a-z0-9]*\): ')
		if [ "$target" ] && ! grep -q "$target" "$work/lanes.log"; then
			skip "$name" "not on this CPU"
		else
			mutate_emitted "$name" "$file" "$source" "$script" "$test" "$words"
		fi
	done <"$work/emitted.list"
}

mkfifo "$work/pipe" || exit 1
if ! { make_tree && "$tree/build/gen" --quiet --max-degree 6 --out "$work/out"; } >"$work/log" 2>&1
then
	verdict "gen without mutation" "$(head -n 1 "$work/log")"
	finish
	exit
fi
rm -r "$work/out"
test_gen "$work/proof.list"
if echo '#include <mpfr.h>' | ${CC:-cc} -x c -fsyntax-only - 2>/dev/null; then
	test_gen "$work/rounding.list"
	test_emitted
else
	skip "rounding and emitted files" "libmpfr-dev is not installed"
fi
finish

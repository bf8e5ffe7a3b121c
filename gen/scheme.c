/* scheme.c - ways to evaluate an integral over edges, and the choice between them.
 *
 * Single edges use the coefficient matrix, with mirrored terms added in pairs, so that swapping
 * the two ends of the edge negates the result bit for bit. Rings add up products in accumulators;
 * several schemes apply to one request, each builds a DAG, and the cheapest one by an integer cost
 * is taken, unless its error bound is too weak. For all moments they stand in moments.c; for one
 * integrand they are
 *
 *   matrix      powers of x times an integer matrix times powers of y (Steger 1996),
 *               shared products
 *   horner      nested multiplication
 *   even-power  the same matrix form in a = p0 + p1 and e = p1 - p0: only terms even in e survive
 *               the integration
 *   expanded    of curves alone (curves.c): every term of the polynomial
 *   vertex      constants alone: 1/2 (x_i - cx) (y_(i+1) - y_(i-1)), one product per vertex */
#include "gen.h"

#include <string.h>

enum { FMA_WEIGHT = 4, ADD_WEIGHT = 1 };   /* additions have a pipe of their own on most machines */
enum { WORST_BOUND = 512, DEAR = 1 << 30 };   /* k: at most 9 bits lost in the worst case */
enum { EVEN_DEGREE = 6 };                  /* beyond it even powers cancel too much anyway */
enum { FEW_TERMS = 24 };                   /* try normalisations of a density up to this size */

const char *const *scheme_names(void)
{
	static const char *const names[] = {
		"matrix", "horner", "even-power", "shared", "recurrence", "vertex", "expanded", NULL
	};
	return names;
}

static Count dag_count(const Dag *dag)
{
	Count count = { 0 };
	const int *uses = dag_uses(dag);
	for (int i = 0; i < dag->count; ++i) {
		if (uses[i] == 0)
			continue;
		count.fma += op_fma_cost(dag->node[i].op);
		count.add += op_add_cost(dag->node[i].op);
	}
	return count;
}

/* Cost as it will be after fusion; what is preferred costs less than anything else. */
static int dag_cost(const Dag *dag, const char *preferred)
{
	Count count = dag_count(fuse(dag));
	int cost = FMA_WEIGHT * count.fma + ADD_WEIGHT * count.add;
	return preferred && strcmp(preferred, dag->scheme) == 0 ? cost - DEAR : cost;
}

/* ---- one edge: the coefficient matrix, mirrored terms in pairs ---- */

static Mono mirrored(Mono mono)
{
	return mono_var(VAR_X0, mono_power(mono, VAR_X1))
		+ mono_var(VAR_X1, mono_power(mono, VAR_X0))
		+ mono_var(VAR_Y0, mono_power(mono, VAR_Y1))
		+ mono_var(VAR_Y1, mono_power(mono, VAR_Y0));
}

static Ref y_term(Dag *dag, const Leaves *end, Term term, int reflect)
{
	Mono mono = reflect ? mirrored(term.mono) : term.mono;
	return dag_scale(dag, term.coef, axis_part(dag, end, mono, Y_VARS, 'y'));
}

/* Row of one power product of x; with `reflect`, the row of the mirrored one in mirrored order. */
static Ref row(Dag *dag, const Leaves *end, Poly part, int reflect)
{
	Ref sum = NONE;
	for (int i = 0; i < part.count; ++i)
		sum = dag_add(dag, sum, y_term(dag, end, part.term[i], reflect));
	return sum;
}

/* Row that is its own mirror image: c y0^i y1^j and c y0^j y1^i first. */
static Ref own_row(Dag *dag, const Leaves *end, Poly part)
{
	Ref sum = NONE;
	for (int i = 0; i < part.count; ++i) {
		Mono image = mono_keep(mirrored(part.term[i].mono), Y_VARS, 2);
		Mono self = mono_keep(part.term[i].mono, Y_VARS, 2);
		if (self < image)
			continue;
		Ref term = y_term(dag, end, part.term[i], 0);
		if (self > image)
			term = dag_add(dag, term, y_term(dag, end, part.term[i], 1));
		sum = dag_add(dag, sum, term);
	}
	return sum;
}

static const char *row_name(Poly sorted, Mono x)
{
	int index = -1;
	for (int from = 0; from < sorted.count; ) {
		Poly part = next_group(sorted, &from, X_VARS);
		++index;
		if (mono_keep(part.term[0].mono, X_VARS, 2) == x)
			break;
	}
	return format("row%d", index);
}

Dag *scheme_edge(const Integral *want)
{
	Dag *dag = dag_new("matrix");
	Leaves end = ends(dag);
	Rat content = poly_content(want->density);
	Poly density = group_by(poly_scale(want->density, rat_div(rat(1, 1), content)), X_VARS);
	Ref sum = NONE;
	for (int from = 0; from < density.count; ) {
		Poly part = next_group(density, &from, X_VARS);
		Mono x = mono_keep(part.term[0].mono, X_VARS, 2);
		Mono image = mono_keep(mirrored(x), X_VARS, 2);
		if (x < image)
			continue;
		Ref near = x == image ? own_row(dag, &end, part) : row(dag, &end, part, 0);
		dag_name(dag, near, row_name(density, x));
		Ref term = dag_mul(dag, axis_part(dag, &end, x, X_VARS, 'x'), near);
		if (x > image) {
			Ref far = dag_name(dag, row(dag, &end, part, 1), row_name(density, image));
			Ref power = axis_part(dag, &end, image, X_VARS, 'x');
			term = dag_add(dag, term, dag_mul(dag, power, far));
		}
		sum = dag_add(dag, sum, term);
	}
	dag_name(dag, sum, "sum");
	dag_out(dag, dag_scale(dag, content, dag_mul(dag, cross(dag), sum)));
	return dag;
}

/* ---- rings ---- */

static void finish_one(Dag *dag, Rat factor)
{
	dag->finish = allocate(sizeof *dag->finish);
	dag->finish[0] = poly_mono(factor, mono_accumulator(0));
	dag->finishes = 1;
}

enum { MATRIX_X, MATRIX_Y, HORNER, EVEN_X, EVEN_Y, WAYS };

static int total_degree(Poly a)
{
	int degree = 0;
	for (int i = 0; i < a.count; ++i) {
		int d = 0;
		for (int var = VAR_X0; var <= VAR_Y1; ++var)
			d += mono_power(a.term[i].mono, var);
		degree = d > degree ? d : degree;
	}
	return degree;
}

/* Density in a = p0 + p1, e = p1 - p0 (named x0, x1) and b, f (named y0, y1). */
static Poly even_density(Poly density)
{
	static const int vars[] = { VAR_X0, VAR_X1, VAR_Y0, VAR_Y1 };
	Poly by[4];
	for (int i = 0; i < 4; ++i) {
		Poly sum = poly_var(vars[i & 2]), half = poly_var(vars[(i & 2) + 1]);
		by[i] = poly_scale(i & 1 ? poly_add(sum, half) : poly_sub(sum, half), rat(1, 2));
	}
	return poly_substitute(density, vars, by, 4);
}

/* One way, after dividing the density by `unit` so that its coefficient becomes 1. */
static Dag *single(Poly density, int way, Rat unit)
{
	Dag *dag = dag_new(way == HORNER ? "horner" : way >= EVEN_X ? "even-power" : "matrix");
	Leaves leaves = ends(dag);
	Poly scaled = poly_scale(density, rat_div(rat(1, 1), unit));
	Ref s = cross(dag), value;
	if (way >= EVEN_X) {
		leaves.ref[VAR_X0] = sum_of(dag, VAR_X0, VAR_X1, "a");
		leaves.ref[VAR_X1] = difference_of(dag, VAR_X0, VAR_X1, "e");
		leaves.ref[VAR_Y0] = sum_of(dag, VAR_Y0, VAR_Y1, "b");
		leaves.ref[VAR_Y1] = difference_of(dag, VAR_Y0, VAR_Y1, "f");
	}
	if (way == HORNER)
		value = horner(dag, scaled, VAR_X0);
	else
		value = grouped(dag, &leaves, scaled,
			way == MATRIX_X || way == EVEN_X ? X_VARS : Y_VARS);
	dag_accumulate(dag, dag_mul(dag, s, value));
	finish_one(dag, unit);
	return dag;
}

/* Cost, or DEAR if rounding errors could grow too far; all that was built for the estimate is
 * freed. */
static int single_cost(const Integral *want, Poly density, int way, Rat unit, int best,
	const char *preferred)
{
	Mark mark = arena_mark();
	const Dag *dag = single(density, way, unit);
	int cost = dag_cost(dag, preferred);
	if (cost < best && bound_ring(dag, scheme_finish(dag), want, 1)[0].k > WORST_BOUND)
		cost = DEAR;
	arena_release(mark);
	return cost;
}

static Dag *best_single(const Integral *want, const char *preferred)
{
	const int ways = total_degree(want->density) <= EVEN_DEGREE ? WAYS : EVEN_X;
	Poly forms[2] = { want->density, ways == WAYS ? even_density(want->density) : poly_zero() };
	int best_way = MATRIX_X, best_cost = DEAR;
	Rat best_unit = poly_content(want->density);
	for (int way = 0; way < ways; ++way) {
		Poly density = forms[way >= EVEN_X];
		Rat content = poly_content(density);
		int tries = density.count <= FEW_TERMS ? density.count : 0;
		for (int i = -1; i < tries; ++i) {
			Rat unit = i < 0 ? content : density.term[i].coef;
			int cost = single_cost(want, density, way, unit, best_cost, preferred);
			if (cost >= best_cost)
				continue;
			best_way = way;
			best_cost = cost;
			best_unit = unit;
		}
	}
	return single(forms[best_way >= EVEN_X], best_way, best_unit);
}

static Dag *best_moments(const Integral *want, int degree, const char *preferred)
{
	Dag *candidate[4];
	int count = 0, best = 0;
	if (degree == 0)                       /* area is about the first vertex, by contract */
		return moments_vertex(rat(1, 1));
	if (degree == 2)
		candidate[count++] = moments_shared();
	if (degree <= 4)
		candidate[count++] = moments_even_power(degree);
	candidate[count++] = moments_recurrence(degree);
	if (degree <= 4 || preferred)          /* far too dear beyond, unless asked for */
		candidate[count++] = moments_matrix(want, degree);
	for (int i = 1; i < count; ++i)
		if (dag_cost(candidate[i], preferred) < dag_cost(candidate[best], preferred))
			best = i;
	return candidate[best];
}

Dag *scheme_ring(const Integral *want, int moments, const char *preferred)
{
	if (moments >= 0)
		return best_moments(want, moments, preferred);
	if (want->density.count == 1 && want->density.term[0].mono == 0)
		return moments_vertex(rat_mul(rat(2, 1), want->density.term[0].coef));
	return best_single(want, preferred);
}

/* out_j = (integer combination of the accumulators) * content, so that integer
 * coordinates stay exact to the end. */
Dag *scheme_finish(const Dag *ring)
{
	Dag *dag = dag_new("finish");
	for (int j = 0; j < ring->finishes; ++j) {
		Rat content = poly_content(ring->finish[j]);
		Poly form = poly_scale(ring->finish[j], rat_div(rat(1, 1), content));
		Ref sum = NONE;
		for (int i = form.count - 1; i >= 0; --i) {
			const Term *term = &form.term[i];
			int k = mono_accumulator_of(term->mono);
			Ref total = dag_accumulator(dag, k);
			for (int turn = 1; turn < ring->turns; ++turn) {
				Ref next = dag_accumulator(dag, k + turn * ring->outs);
				total = dag_add(dag, total, next);
			}
			sum = dag_add(dag, sum, dag_scale(dag, term->coef, total));
		}
		dag_out(dag, dag_scale(dag, content, sum));
	}
	return dag;
}

/* scheme.c - ways to evaluate an integral over edges, and the choice between them.
 *
 * Single edges use the coefficient matrix, with mirrored terms added in pairs, so that swapping the two ends of the
 * edge negates the result bit for bit. Rings use accumulators: per item (an edge, or a vertex) a few products are
 * added up, and rational constants that all items share are applied once at the end, in the `finish` forms. Several
 * schemes apply to one request; each builds a DAG, and the cheapest one by an integer cost is taken. Every scheme
 * writes down an identity that it need not be trusted for: proof.c expands what was built.
 *
 *   matrix      powers of x times an integer matrix times powers of y (Steger 1996), shared products
 *   horner      nested multiplication
 *   even-power  in a = p0 + p1 and e = p1 - p0 only terms even in e survive the integration
 *   shared      moments of degree 2 that reuse the products x0 y1, x1 y0 and the sums p0 + p1
 *   recurrence  h_mn = x0 h_(m-1,n) + y0 h_(m,n-1) + C(m+n,n) x1^m y1^n, times x0 y1 - x1 y0 from the start
 *   vertex      constants alone: 1/2 (x_i - cx) (y_(i+1) - y_(i-1)), one product per vertex */
#include "gen.h"

#include <stdlib.h>

enum { FMA_WEIGHT = 4, ADD_WEIGHT = 1 };   /* additions have a pipe of their own on most machines */
enum { FEW_TERMS = 24 };                   /* try normalisations of a density up to this size */

static const int X_VARS[] = { VAR_X0, VAR_X1 }, Y_VARS[] = { VAR_Y0, VAR_Y1 };

const char *const *scheme_names(void)
{
	static const char *const names[] = { "matrix", "horner", "even-power", "shared", "recurrence", "vertex", NULL };
	return names;
}

static Count dag_count(const Dag *dag)
{
	Count count = { 0, 0, 0 };
	const int *uses = dag_uses(dag);
	for (int i = 0; i < dag->count; ++i) {
		if (uses[i] == 0)
			continue;
		count.fma += op_fma_cost(dag->node[i].op);
		count.add += op_add_cost(dag->node[i].op);
	}
	return count;
}

int dag_cost(const Dag *dag)
{
	Count count = dag_count(dag);
	return FMA_WEIGHT * count.fma + ADD_WEIGHT * count.add;
}

/* ---- pieces that schemes share ---- */

typedef struct { Ref ref[VARS]; } Leaves;          /* what stands for each variable of a polynomial */

static Leaves ends(Dag *dag)
{
	Leaves leaves = { { 0 } };
	for (int var = VAR_X0; var <= VAR_Y1; ++var)
		leaves.ref[var] = dag_var(dag, var);
	return leaves;
}

/* s = x0 y1 - x1 y0: two rounded products and a subtraction, so a repeated vertex gives exactly 0. */
static Ref cross(Dag *dag)
{
	Leaves end = ends(dag);
	Ref left = dag_mul(dag, end.ref[VAR_X0], end.ref[VAR_Y1]);
	Ref right = dag_mul(dag, end.ref[VAR_X1], end.ref[VAR_Y0]);
	return dag_name(dag, dag_sub(dag, left, right), "s");
}

static Ref sum_of(Dag *dag, int start, int end, const char *name)
{
	Ref a = dag_var(dag, start), b = dag_var(dag, end);
	return dag_name(dag, dag_add(dag, a, b), name);
}

static Ref difference_of(Dag *dag, int start, int end, const char *name)
{
	Ref a = dag_var(dag, start), b = dag_var(dag, end);
	return dag_name(dag, dag_sub(dag, b, a), name);
}

/* Name of p0^i p1^j: x001 for small powers, x5_3 beyond. */
static const char *power_name(char axis, int i, int j)
{
	return i + j > 4 ? format("%c%d_%d", axis, i, j) : format("%c%.*s%.*s", axis, i, "0000", j, "1111");
}

/* base^power from its halves, so that all powers share products; base is p0^i p1^j of an axis that has names, or 0. */
static Ref power_of(Dag *dag, Ref base, int power, char axis, int i, int j)
{
	if (power == 0)
		return dag_const(dag, rat(1, 1));
	Ref result = base;
	if (power > 1) {
		Ref half = power_of(dag, base, power / 2, axis, i, j);
		Ref rest = power_of(dag, base, power - power / 2, axis, i, j);
		result = dag_mul(dag, half, rest);
	}
	return axis ? dag_name(dag, result, power_name(axis, power * i, power * j)) : result;
}

/* p0^i p1^j as (p0 p1)^min times the power that is left: mirrored exponents give mirrored operations. */
static Ref axis_part(Dag *dag, const Leaves *leaves, Mono mono, const int *vars, char axis)
{
	int i = mono_power(mono, vars[0]), j = mono_power(mono, vars[1]), common = i < j ? i : j;
	Ref p = leaves->ref[vars[0]], q = leaves->ref[vars[1]], both = dag_const(dag, rat(1, 1));
	if (common)
		both = power_of(dag, dag_mul(dag, p, q), common, axis, 1, 1);
	Ref left = i > j ? power_of(dag, p, i - j, axis, 1, 0) : power_of(dag, q, j - i, axis, 0, 1);
	Ref result = dag_mul(dag, both, left);
	return axis ? dag_name(dag, result, power_name(axis, i, j)) : result;
}

static Ref mono_ref(Dag *dag, const Leaves *leaves, Mono mono)
{
	Ref x = axis_part(dag, leaves, mono, X_VARS, 0);
	Ref y = axis_part(dag, leaves, mono, Y_VARS, 0);
	return dag_mul(dag, x, y);
}

/* ---- one edge: the coefficient matrix, mirrored terms in pairs ---- */

static Mono mirrored(Mono mono)
{
	return mono_var(VAR_X0, mono_power(mono, VAR_X1)) + mono_var(VAR_X1, mono_power(mono, VAR_X0))
		+ mono_var(VAR_Y0, mono_power(mono, VAR_Y1)) + mono_var(VAR_Y1, mono_power(mono, VAR_Y0));
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

/* The terms from `*from` on that share their part in `vars`; moves *from behind them. */
static Poly next_group(Poly sorted, int *from, const int *vars)
{
	Poly group = { 0, sorted.term + *from };
	Mono part = mono_keep(sorted.term[*from].mono, vars, 2);
	while (*from < sorted.count && mono_keep(sorted.term[*from].mono, vars, 2) == part) {
		++*from;
		++group.count;
	}
	return group;
}

typedef struct { Mono part; Term term; } Keyed;

static int by_part(const void *left, const void *right)
{
	const Keyed *a = left, *b = right;
	if (a->part != b->part)
		return a->part < b->part ? 1 : -1;
	return (a->term.mono < b->term.mono) - (a->term.mono > b->term.mono);
}

/* Terms with equal x part, or y part, next to each other; parts and terms in descending order. */
static Poly group_by(Poly a, const int *vars)
{
	Poly sorted = { a.count, allocate((size_t)a.count * sizeof(Term)) };
	Keyed *keyed = allocate((size_t)a.count * sizeof *keyed);
	for (int i = 0; i < a.count; ++i)
		keyed[i] = (Keyed){ mono_keep(a.term[i].mono, vars, 2), a.term[i] };
	qsort(keyed, (size_t)a.count, sizeof *keyed, by_part);
	for (int i = 0; i < a.count; ++i)
		sorted.term[i] = keyed[i].term;
	return sorted;
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
		Mono x = mono_keep(part.term[0].mono, X_VARS, 2), image = mono_keep(mirrored(x), X_VARS, 2);
		if (x < image)
			continue;
		Ref near = x == image ? own_row(dag, &end, part) : row(dag, &end, part, 0);
		dag_name(dag, near, row_name(density, x));
		Ref term = dag_mul(dag, axis_part(dag, &end, x, X_VARS, 'x'), near);
		if (x > image) {
			Ref far = dag_name(dag, row(dag, &end, part, 1), row_name(density, image));
			term = dag_add(dag, term, dag_mul(dag, axis_part(dag, &end, image, X_VARS, 'x'), far));
		}
		sum = dag_add(dag, sum, term);
	}
	dag_name(dag, sum, "sum");
	dag_out(dag, dag_scale(dag, content, dag_mul(dag, cross(dag), sum)));
	return dag;
}

/* ---- rings, one integrand ---- */

/* Sum over groups of equal outer part: (row / its common power product) * (common product * outer part). */
static Ref grouped(Dag *dag, const Leaves *leaves, Poly density, const int *outer)
{
	Ref sum = NONE;
	Poly sorted = group_by(density, outer);
	for (int from = 0; from < sorted.count; ) {
		Poly part = next_group(sorted, &from, outer);
		Mono common = part.term[0].mono;
		Ref inner = NONE;
		for (int i = 1; i < part.count; ++i)
			common = mono_gcd(common, part.term[i].mono);
		for (int i = 0; i < part.count; ++i) {
			Ref term = mono_ref(dag, leaves, part.term[i].mono - common);
			inner = dag_add(dag, inner, dag_scale(dag, part.term[i].coef, term));
		}
		sum = dag_add(dag, sum, dag_mul(dag, mono_ref(dag, leaves, common), inner));
	}
	return sum;
}

/* Nested multiplication in x0, then x1, y0, y1. */
static Ref horner(Dag *dag, Poly a, int var)
{
	if (a.count == 0)
		return NONE;
	if (var > VAR_Y1)
		return dag_const(dag, a.term[0].coef);
	Ref sum = NONE;
	for (int power = poly_degree(a, var); power >= 0; --power) {
		Poly part = { 0, allocate((size_t)a.count * sizeof(Term)) };
		for (int i = 0; i < a.count; ++i)
			if (mono_power(a.term[i].mono, var) == power)
				part.term[part.count++] = (Term){ a.term[i].mono - mono_var(var, power), a.term[i].coef };
		if (sum != NONE)
			sum = dag_mul(dag, sum, dag_var(dag, var));
		sum = dag_add(dag, sum, horner(dag, part, var + 1));
	}
	return sum;
}

static void finish_one(Dag *dag, Rat factor)
{
	dag->finish = allocate(sizeof *dag->finish);
	dag->finish[0] = poly_mono(factor, mono_accumulator(0));
	dag->finishes = 1;
}

enum { MATRIX_X, MATRIX_Y, HORNER, EVEN_X, EVEN_Y, WAYS };

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
		value = grouped(dag, &leaves, scaled, way == MATRIX_X || way == EVEN_X ? X_VARS : Y_VARS);
	dag_accumulate(dag, dag_mul(dag, s, value));
	finish_one(dag, unit);
	return dag;
}

/* Cost as it will be after fusion; all that was built for the estimate is freed. */
static int single_cost(Poly density, int way, Rat unit)
{
	Mark mark = arena_mark();
	int cost = dag_cost(fuse(single(density, way, unit)));
	arena_release(mark);
	return cost;
}

static Dag *best_single(const Integral *want)
{
	Poly forms[2] = { want->density, even_density(want->density) };
	int best_way = 0, best_cost = 0;
	Rat best_unit = { 0, 1 };
	for (int way = 0; way < WAYS; ++way) {
		Poly density = forms[way >= EVEN_X];
		Rat content = poly_content(density);
		int tries = density.count <= FEW_TERMS ? density.count : 0;
		for (int i = -1; i < tries; ++i) {
			Rat unit = i < 0 ? content : density.term[i].coef;
			int cost = single_cost(density, way, unit);
			if (best_unit.num != 0 && cost >= best_cost)
				continue;
			best_way = way;
			best_cost = cost;
			best_unit = unit;
		}
	}
	return single(forms[best_way >= EVEN_X], best_way, best_unit);
}

/* ---- rings, all moments to a degree ---- */

static int moment_index(int m, int n)
{
	return (m + n) * (m + n + 1) / 2 + n;
}

static void finish_room(Dag *dag, int degree)
{
	dag->finishes = moment_index(0, degree) + 1;
	dag->finish = allocate((size_t)dag->finishes * sizeof *dag->finish);
}

/* The moment of x^m y^n takes `factor` times the accumulator that comes next. */
static void finish_next(Dag *dag, int m, int n, Rat factor)
{
	Poly *form = &dag->finish[moment_index(m, n)];
	*form = poly_add(*form, poly_mono(factor, mono_accumulator(dag->outs)));
}

static Dag *vertex_form(Rat value)
{
	Dag *dag = dag_new("vertex");
	dag->window = 3;
	Ref width = difference_of(dag, VAR_CX, VAR_X1, "width");
	Ref height = difference_of(dag, VAR_Y0, VAR_Y2, "height");
	dag_accumulate(dag, dag_mul(dag, width, height));
	finish_one(dag, rat_mul(value, rat(1, 2)));
	return dag;
}

/* Degree 2 with six accumulators: x0 (x0 + x1) + x1^2 and 2 (x0 + x1)(y0 + y1) - (x0 y1 + x1 y0). */
static Dag *shared(void)
{
	Dag *dag = dag_new("shared");
	Leaves end = ends(dag);
	Ref x0 = end.ref[VAR_X0], y0 = end.ref[VAR_Y0], x1 = end.ref[VAR_X1], y1 = end.ref[VAR_Y1];
	Ref s = cross(dag), a = sum_of(dag, VAR_X0, VAR_X1, "a"), b = sum_of(dag, VAR_Y0, VAR_Y1, "b");
	Ref x1x1 = dag_mul(dag, x1, x1), y1y1 = dag_mul(dag, y1, y1), x0a = dag_mul(dag, x0, a), y0b = dag_mul(dag, y0, b);
	Ref left = dag_mul(dag, x0, y1), right = dag_mul(dag, x1, y0), twice = dag_add(dag, a, a);
	Ref xx = dag_add(dag, x1x1, x0a), yy = dag_add(dag, y1y1, y0b), mixed = dag_add(dag, left, right);
	Ref xy = dag_sub(dag, dag_mul(dag, twice, b), mixed);
	const Ref value[] = { NONE, a, b, dag_name(dag, xx, "xx"), dag_name(dag, xy, "xy"), dag_name(dag, yy, "yy") };
	const Rat factor[] = { rat(1, 2), rat(1, 6), rat(1, 6), rat(1, 12), rat(1, 24), rat(1, 12) };
	finish_room(dag, 2);
	for (int i = 0, m = 0, n = 0; i < 6; ++i) {
		finish_next(dag, m, n, factor[i]);
		dag_accumulate(dag, i ? dag_mul(dag, s, value[i]) : s);
		if (m-- == 0)
			m = n + 1, n = 0;
		else
			++n;
	}
	return dag;
}

/* Symmetric pairs xx, xy, yy: which of the two axes each index takes. */
static const int PAIR[3][2] = { { 0, 0 }, { 0, 1 }, { 1, 1 } };

typedef struct { Ref s, a[2], e[2], ee[3], r[3], q[3], t[3]; } Even;   /* r = a a + e e, q = s e e, t = s r */

static Even even_parts(Dag *dag, int degree)
{
	static const char *const ee[] = { "ee", "ef", "ff" }, *const r[] = { "rxx", "rxy", "ryy" };
	static const char *const q[] = { "qxx", "qxy", "qyy" }, *const t[] = { "txx", "txy", "tyy" };
	Even even = { .s = cross(dag) };
	even.a[0] = sum_of(dag, VAR_X0, VAR_X1, "a");
	even.a[1] = sum_of(dag, VAR_Y0, VAR_Y1, "b");
	if (degree < 2)
		return even;
	even.e[0] = difference_of(dag, VAR_X0, VAR_X1, "e");
	even.e[1] = difference_of(dag, VAR_Y0, VAR_Y1, "f");
	for (int i = 0; i < 3; ++i) {
		Ref a0 = even.a[PAIR[i][0]], a1 = even.a[PAIR[i][1]], e0 = even.e[PAIR[i][0]], e1 = even.e[PAIR[i][1]];
		if (degree < 4) {                  /* s goes in first: r and ee themselves are not needed */
			even.q[i] = dag_mul(dag, dag_mul(dag, even.s, e0), e1);
			even.t[i] = dag_add(dag, even.q[i], dag_mul(dag, dag_mul(dag, even.s, a0), a1));
		} else {
			even.ee[i] = dag_name(dag, dag_mul(dag, e0, e1), ee[i]);
			even.r[i] = dag_name(dag, dag_add(dag, even.ee[i], dag_mul(dag, a0, a1)), r[i]);
			even.q[i] = dag_mul(dag, even.s, even.ee[i]);
			even.t[i] = dag_mul(dag, even.s, even.r[i]);
		}
		dag_name(dag, even.q[i], q[i]);
		dag_name(dag, even.t[i], t[i]);
	}
	return even;
}

/* 32 times the density of degree 3 is 4/5 sym(a r); an accumulator per distinct product. */
static void even_cubic(Dag *dag, const Even *even)
{
	for (int i = 0; i < 3; ++i)
		for (int k = 0; k < 2; ++k) {
			int n = PAIR[i][0] + PAIR[i][1] + k;
			Rat share = n == 0 || n == 3 ? rat(1, 1) : i == 1 ? rat(2, 3) : rat(1, 3);
			finish_next(dag, 3 - n, n, rat_mul(share, rat(1, 40)));
			dag_accumulate(dag, dag_mul(dag, even->t[i], even->a[k]));
		}
}

/* 96 times the density of degree 4 is sym(r r) - 4/5 e e e e. */
static void even_quartic(Dag *dag, const Even *even)
{
	for (int i = 0; i < 3; ++i)
		for (int k = i; k < 3; ++k) {
			int n = i + k;
			Rat share = n != 2 ? rat(1, 1) : i == 1 ? rat(2, 3) : rat(1, 3);
			finish_next(dag, 4 - n, n, rat_mul(share, rat(1, 96)));
			dag_accumulate(dag, dag_mul(dag, even->t[i], even->r[k]));
		}
	for (int n = 0; n <= 4; ++n) {
		int i = n < 2 ? 0 : n - 2;
		finish_next(dag, 4 - n, n, rat(-1, 120));
		dag_accumulate(dag, dag_mul(dag, even->q[i], even->ee[n - i]));
	}
}

static Dag *even_power(int degree)
{
	Dag *dag = dag_new("even-power");
	Even even = even_parts(dag, degree);
	finish_room(dag, degree);
	finish_next(dag, 0, 0, rat(1, 2));
	dag_accumulate(dag, even.s);
	for (int k = 0; k < 2 && degree >= 1; ++k) {
		finish_next(dag, 1 - k, k, rat(1, 6));
		dag_accumulate(dag, dag_mul(dag, even.s, even.a[k]));
	}
	for (int i = 0; i < 3 && degree >= 2; ++i) {
		finish_next(dag, 2 - i, i, rat(1, 16));
		dag_accumulate(dag, even.t[i]);
		finish_next(dag, 2 - i, i, rat(-1, 24));
		dag_accumulate(dag, even.q[i]);
	}
	if (degree >= 3)
		even_cubic(dag, &even);
	if (degree >= 4)
		even_quartic(dag, &even);
	return dag;
}

static Rat moment_factor(int m, int n)
{
	return rat(1, int_mul((m + n + 2) * (m + n + 1), int_binomial(m + n, n)));
}

typedef struct { Dag *dag; int degree; Leaves end; Ref h[MAX_DEGREE + 1][MAX_DEGREE + 1], w[MAX_DEGREE + 1][MAX_DEGREE + 1]; }
	Recurrence;

/* w_mn = s x1^m y1^n from its neighbour, as the two factors of its last product. */
static void weight_factors(const Recurrence *r, int m, int n, Ref *factor, Ref *end)
{
	*factor = m ? r->w[m - 1][n] : r->w[m][n - 1];
	*end = r->end.ref[m ? VAR_X1 : VAR_Y1];
}

static Ref recurrence_terms(const Recurrence *r, int m, int n, Ref sum)
{
	if (n > 0)
		sum = dag_add(r->dag, sum, dag_mul(r->dag, r->end.ref[VAR_Y0], r->h[m][n - 1]));
	if (m > 0)
		sum = dag_add(r->dag, sum, dag_mul(r->dag, r->end.ref[VAR_X0], r->h[m - 1][n]));
	return sum;
}

static void recurrence_inner(Recurrence *r, int m, int n)
{
	Ref factor, end;
	weight_factors(r, m, n, &factor, &end);
	r->w[m][n] = dag_name(r->dag, dag_mul(r->dag, factor, end), format("w%d_%d", m, n));
	Ref source = dag_scale(r->dag, rat(int_binomial(m + n, n), 1), r->w[m][n]);
	r->h[m][n] = dag_name(r->dag, recurrence_terms(r, m, n, source), format("h%d_%d", m, n));
	finish_next(r->dag, m, n, moment_factor(m, n));
	dag_accumulate(r->dag, r->h[m][n]);
}

/* Top degree: straight into the accumulator; the source, times its binomial, comes from one of its own. */
static void recurrence_top(Recurrence *r, int m, int n)
{
	Ref factor, end, sum = dag_accumulator(r->dag, r->dag->outs);
	weight_factors(r, m, n, &factor, &end);
	if (m == 0 || n == 0)
		sum = dag_add(r->dag, sum, dag_mul(r->dag, factor, end));
	finish_next(r->dag, m, n, moment_factor(m, n));
	dag_out(r->dag, recurrence_terms(r, m, n, sum));
}

static void recurrence_top_source(Recurrence *r, int m, int n)
{
	Ref factor, end;
	weight_factors(r, m, n, &factor, &end);
	finish_next(r->dag, m, n, rat(1, (m + n + 2) * (m + n + 1)));
	dag_accumulate(r->dag, dag_mul(r->dag, factor, end));
}

static Dag *recurrence(int degree)
{
	Recurrence *r = allocate(sizeof *r);
	r->dag = dag_new("recurrence");
	r->degree = degree;
	r->end = ends(r->dag);
	r->h[0][0] = r->w[0][0] = cross(r->dag);
	finish_room(r->dag, degree);
	finish_next(r->dag, 0, 0, rat(1, 2));
	dag_accumulate(r->dag, r->h[0][0]);
	for (int d = 1; d < degree; ++d)
		for (int n = 0; n <= d; ++n)
			recurrence_inner(r, d - n, n);
	for (int n = 0; n <= degree; ++n)
		recurrence_top(r, degree - n, n);
	for (int n = 1; n < degree; ++n)
		recurrence_top_source(r, degree - n, n);
	return r->dag;
}

/* Every moment by its own coefficient matrix; hash-consing shares the power products. */
static Dag *all_matrices(const Integral *want, int degree)
{
	Dag *dag = dag_new("matrix");
	Leaves end = ends(dag);
	Ref s = cross(dag);
	finish_room(dag, degree);
	for (int d = 0, i = 0; d <= degree; ++d)
		for (int n = 0; n <= d; ++n, ++i) {
			Rat content = poly_content(want[i].density);
			Poly density = poly_scale(want[i].density, rat_div(rat(1, 1), content));
			finish_next(dag, d - n, n, content);
			dag_accumulate(dag, dag_mul(dag, s, grouped(dag, &end, density, X_VARS)));
		}
	return dag;
}

static Dag *best_moments(const Integral *want, int degree)
{
	Dag *candidate[4];
	int count = 0, best = 0;
	if (degree == 0)
		candidate[count++] = vertex_form(rat(1, 1));
	if (degree == 2)
		candidate[count++] = shared();
	if (degree <= 4)
		candidate[count++] = even_power(degree);
	if (degree >= 1)
		candidate[count++] = recurrence(degree);
	if (degree <= 4)
		candidate[count++] = all_matrices(want, degree);
	for (int i = 1; i < count; ++i)
		if (dag_cost(fuse(candidate[i])) < dag_cost(fuse(candidate[best])))
			best = i;
	return candidate[best];
}

Dag *scheme_ring(const Integral *want, int moments)
{
	if (moments >= 0)
		return best_moments(want, moments);
	if (want->density.count == 1 && want->density.term[0].mono == 0)
		return vertex_form(rat_mul(rat(2, 1), want->density.term[0].coef));
	return best_single(want);
}

/* out_j = (integer combination of the accumulators) * content, so that integer coordinates stay exact to the end. */
Dag *scheme_finish(const Dag *ring)
{
	Dag *dag = dag_new("finish");
	for (int j = 0; j < ring->finishes; ++j) {
		Rat content = poly_content(ring->finish[j]);
		Poly form = poly_scale(ring->finish[j], rat_div(rat(1, 1), content));
		Ref sum = NONE;
		for (int i = form.count - 1; i >= 0; --i) {
			Ref accumulator = dag_accumulator(dag, mono_accumulator_of(form.term[i].mono));
			sum = dag_add(dag, sum, dag_scale(dag, form.term[i].coef, accumulator));
		}
		dag_out(dag, dag_scale(dag, content, sum));
	}
	return dag;
}

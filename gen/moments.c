/* moments.c - schemes for all moments to a degree at once: per item a few products go
 * to accumulators, and rational constants that all items share are applied once at the end,
 * in the finish forms.
 *
 *   shared      degree 2 with the products x0 y1, x1 y0 and the sums p0 + p1 used again
 *   even-power  in a = p0 + p1 and e = p1 - p0 only terms even in e survive the integration;
 *               to degree 4
 *   recurrence  h_mn = x0 h_(m-1,n) + y0 h_(m,n-1) + C(m+n,n) x1^m y1^n, times x0 y1 - x1 y0 from
 *               the start; the generating function of h is 1 / ((1 - x0 u - y0 v)(1 - x1 u - y1 v))
 *   matrix      every moment by its own coefficient matrix, power products shared
 *   vertex      degree 0 and constants, about a local origin: one term per vertex
 *
 * None of these identities is trusted: proof.c expands what was built. */
#include "gen.h"

static int moment_index(int m, int n)
{
	return (m + n) * (m + n + 1) / 2 + n;
}

void finish_room(Dag *dag, int degree)
{
	dag->finishes = moment_index(0, degree) + 1;
	dag->finish = allocate((size_t)dag->finishes * sizeof *dag->finish);
}

void finish_next(Dag *dag, int m, int n, Rat factor)
{
	Poly *form = &dag->finish[moment_index(m, n)];
	*form = poly_add(*form, poly_mono(factor, mono_accumulator(dag->outs)));
}

static Dag *vertex_form(Rat value, int magnitude)
{
	Dag *dag = dag_new("vertex");
	dag->window = WINDOW_VERTEX;
	dag->turns = 2;
	Ref width = difference_of(dag, VAR_CX, VAR_X1, "width");
	Ref height = difference_of(dag, VAR_Y0, VAR_Y2, "height");
	if (magnitude) {
		width = dag_unary(dag, OP_ABS, width);
		height = dag_unary(dag, OP_ABS, height);
	}
	finish_room(dag, 0);
	finish_next(dag, 0, 0, rat_mul(value, rat(1, 2)));
	dag_accumulate(dag, dag_mul(dag, width, height));
	return dag;
}

Dag *moments_vertex(Rat value)
{
	return vertex_form(value, 0);
}

Integral moments_vertex_magnitude(void)
{
	Poly width = poly_add(poly_var(VAR_X1), poly_var(VAR_CX));
	Poly height = poly_add(poly_var(VAR_Y2), poly_var(VAR_Y0));
	Poly all = poly_scale(poly_mul(width, height), rat(1, 2));
	return (Integral){ all, poly_zero(), all };
}

/* Degree 2 with six accumulators:
 * x0 (x0 + x1) + x1^2 and 2 (x0 + x1)(y0 + y1) - (x0 y1 + x1 y0). */
Dag *moments_shared(void)
{
	Dag *dag = dag_new("shared");
	Leaves end = ends(dag);
	Ref x0 = end.ref[VAR_X0], y0 = end.ref[VAR_Y0], x1 = end.ref[VAR_X1], y1 = end.ref[VAR_Y1];
	Ref s = cross(dag);
	Ref a = sum_of(dag, VAR_X0, VAR_X1, "a"), b = sum_of(dag, VAR_Y0, VAR_Y1, "b");
	Ref x1x1 = dag_mul(dag, x1, x1), y1y1 = dag_mul(dag, y1, y1);
	Ref x0a = dag_mul(dag, x0, a), y0b = dag_mul(dag, y0, b);
	Ref left = dag_mul(dag, x0, y1), right = dag_mul(dag, x1, y0), twice = dag_add(dag, a, a);
	Ref xx = dag_add(dag, x1x1, x0a), yy = dag_add(dag, y1y1, y0b);
	Ref mixed = dag_add(dag, left, right);
	Ref xy = dag_sub(dag, dag_mul(dag, twice, b), mixed);
	const Ref value[] = {
		NONE, a, b,
		dag_name(dag, xx, "xx"), dag_name(dag, xy, "xy"), dag_name(dag, yy, "yy"),
	};
	const Rat factor[] = {
		rat(1, 2), rat(1, 6), rat(1, 6), rat(1, 12), rat(1, 24), rat(1, 12)
	};
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

/* r = a a + e e, q = s e e, t = s r */
typedef struct { Ref s, a[2], e[2], ee[3], r[3], q[3], t[3]; } Even;

static Even even_parts(Dag *dag, int degree)
{
	static const char *const ee[] = { "ee", "ef", "ff" };
	static const char *const r[] = { "rxx", "rxy", "ryy" };
	static const char *const q[] = { "qxx", "qxy", "qyy" };
	static const char *const t[] = { "txx", "txy", "tyy" };
	Even even = { .s = cross(dag) };
	even.a[0] = sum_of(dag, VAR_X0, VAR_X1, "a");
	even.a[1] = sum_of(dag, VAR_Y0, VAR_Y1, "b");
	if (degree < 2)
		return even;
	even.e[0] = difference_of(dag, VAR_X0, VAR_X1, "e");
	even.e[1] = difference_of(dag, VAR_Y0, VAR_Y1, "f");
	for (int i = 0; i < 3; ++i) {
		Ref a0 = even.a[PAIR[i][0]], a1 = even.a[PAIR[i][1]];
		Ref e0 = even.e[PAIR[i][0]], e1 = even.e[PAIR[i][1]];
		if (degree < 4) {          /* s goes in first: r and ee themselves are not needed */
			even.q[i] = dag_mul(dag, dag_mul(dag, even.s, e0), e1);
			Ref saa = dag_mul(dag, dag_mul(dag, even.s, a0), a1);
			even.t[i] = dag_add(dag, even.q[i], saa);
		} else {
			even.ee[i] = dag_name(dag, dag_mul(dag, e0, e1), ee[i]);
			even.r[i] = dag_add(dag, even.ee[i], dag_mul(dag, a0, a1));
			dag_name(dag, even.r[i], r[i]);
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

Dag *moments_even_power(int degree)
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

typedef struct {
	Dag *dag;
	int degree;
	Leaves end;
	Ref h[MAX_DEGREE + 1][MAX_DEGREE + 1], w[MAX_DEGREE + 1][MAX_DEGREE + 1];
} Recurrence;

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

/* Top degree: straight into the accumulator;
 * the source, times its binomial, comes from one of its own. */
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

/* `start` stands for x0 y1 - x1 y0. */
static Dag *recurrence(Dag *dag, Leaves end, Ref start, int degree)
{
	Recurrence *r = allocate(sizeof *r);
	r->dag = dag;
	r->degree = degree;
	r->end = end;
	r->h[0][0] = r->w[0][0] = start;
	finish_room(dag, degree);
	finish_next(dag, 0, 0, rat(1, 2));
	dag_accumulate(dag, start);
	for (int d = 1; d < degree; ++d)
		for (int n = 0; n <= d; ++n)
			recurrence_inner(r, d - n, n);
	for (int n = 0; n <= degree; ++n)
		recurrence_top(r, degree - n, n);
	for (int n = 1; n < degree; ++n)
		recurrence_top_source(r, degree - n, n);
	return dag;
}

Dag *moments_recurrence(int degree)
{
	Dag *dag = dag_new("recurrence");
	Leaves end = ends(dag);
	return recurrence(dag, end, cross(dag), degree);
}

/* The recurrence has no negative coefficient: with |x|, |y| and |x0 y1| + |x1 y0| it adds up
 * all terms with positive sign. */
Dag *moments_magnitudes(int degree)
{
	if (degree == 0)
		return vertex_form(rat(1, 1), 1);
	Dag *dag = dag_new("recurrence");
	Leaves end = ends(dag);
	for (int var = VAR_X0; var <= VAR_Y1; ++var)
		end.ref[var] = dag_unary(dag, OP_ABS, end.ref[var]);
	Ref left = dag_mul(dag, end.ref[VAR_X0], end.ref[VAR_Y1]);
	Ref right = dag_mul(dag, end.ref[VAR_X1], end.ref[VAR_Y0]);
	return recurrence(dag, end, dag_add(dag, left, right), degree);
}

/* Every moment by its own coefficient matrix; hash-consing shares the power products. */
Dag *moments_matrix(const Integral *want, int degree)
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

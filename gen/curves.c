/* curves.c - areas and moments of quadratic and cubic edges.
 *
 * The area is a combination of the cross products of the control points. Moments work in the power
 * basis about the middle of the curve, t = (1 + tau) / 2, tau in [-1, 1]:
 *
 *     x(tau) = sum_j x_j tau^j, the same for y;  omega = x y' - y x' = sum_k omega_k tau^k
 *     M_mn = 1/(m+n+2) integral of x^m y^n omega dtau                                (form 3)
 *
 * omega has degree 2p - 2 only, for a curve of degree p: the leading terms cancel. To degree 1
 * the integral is written out, odd powers vanish. Beyond, Gauss-Legendre nodes come in pairs
 * +-tau, for which x(+-tau) = even +- odd part, and as many of them are taken as make the rule
 * exact; proof.c then checks that the program is this very sum over the nodes. */
#include "gen.h"

#include <string.h>

enum { EXPANDED_DEGREE = 2 };                /* beyond it there are thousands of terms */
enum { MOST = 4 };                           /* control points of a cubic */

typedef struct {
	int degree;
	Ref x[MOST], y[MOST];                /* coefficients of the powers of tau */
	Ref omega[2 * MOST - 3];
} Curve;

static Ref cross_of(Dag *dag, Ref xi, Ref yi, Ref xj, Ref yj)
{
	Ref left = dag_mul(dag, xi, yj), right = dag_mul(dag, xj, yi);
	return dag_sub(dag, left, right);
}

/* ---- area ---- */

static Ref point_cross(Dag *dag, int i, int j)
{
	Ref xi = dag_var(dag, VAR_X0 + 2 * i), yi = dag_var(dag, VAR_Y0 + 2 * i);
	Ref xj = dag_var(dag, VAR_X0 + 2 * j), yj = dag_var(dag, VAR_Y0 + 2 * j);
	Ref c = cross_of(dag, xi, yi, xj, yj);
	return dag_name(dag, c, format("c%d%d", i, j));
}

static Ref scaled(Dag *dag, int factor, Ref a)
{
	return dag_scale(dag, rat(factor, 1), a);
}

/* Six times the area of a quadratic, 20 times that of a cubic, 2 times that of a line edge:
 * mirrored terms in pairs. */
static Ref area_sum(Dag *dag)
{
	Ref c01 = point_cross(dag, 0, 1);
	if (dag->window == WINDOW_LINE)
		return c01;
	Ref c02 = point_cross(dag, 0, 2), c12 = point_cross(dag, 1, 2);
	if (dag->window == WINDOW_QUAD)
		return dag_add(dag, c02, scaled(dag, 2, dag_add(dag, c01, c12)));
	Ref c03 = point_cross(dag, 0, 3), c13 = point_cross(dag, 1, 3);
	Ref c23 = point_cross(dag, 2, 3);
	Ref three = dag_add(dag, dag_add(dag, c02, c13), c12);
	Ref sum = dag_add(dag, c03, scaled(dag, 3, three));
	return dag_add(dag, sum, scaled(dag, 6, dag_add(dag, c01, c23)));
}

static int area_divisor(int window)
{
	return window == WINDOW_LINE ? 2 : window == WINDOW_QUAD ? 6 : 20;
}

Dag *curve_area_edge(int window)
{
	Dag *dag = dag_new("cross-products");
	dag->window = window;
	Ref divisor = dag_const(dag, rat(area_divisor(window), 1));
	dag_out(dag, dag_div(dag, area_sum(dag), divisor));
	return dag;
}

static Dag *area(int window)
{
	Dag *dag = dag_new("cross-products");
	dag->window = window;
	finish_room(dag, 0);
	finish_next(dag, 0, 0, rat(1, area_divisor(window)));
	dag_accumulate(dag, area_sum(dag));
	return dag;
}

/* ---- power basis about the middle ---- */

/* Coefficients of one coordinate from its control values. */
static void about_middle(Dag *dag, int degree, int first, char axis, Ref *coef)
{
	Ref p[MOST];
	for (int i = 0; i <= degree; ++i)
		p[i] = dag_var(dag, first + 2 * i);
	if (degree == 2) {
		Ref ends = dag_scale(dag, rat(1, 4), dag_add(dag, p[0], p[2]));
		Ref middle = dag_scale(dag, rat(1, 2), p[1]);
		coef[0] = dag_add(dag, ends, middle);
		coef[1] = dag_scale(dag, rat(1, 2), dag_sub(dag, p[2], p[0]));
		coef[2] = dag_sub(dag, ends, middle);
	} else {
		Ref sum = dag_add(dag, p[0], p[3]), inner = dag_add(dag, p[1], p[2]);
		Ref span = dag_sub(dag, p[3], p[0]), step = dag_sub(dag, p[2], p[1]);
		Ref outer = dag_scale(dag, rat(1, 8), sum), between = dag_scale(dag, rat(3, 8), inner);
		coef[0] = dag_add(dag, outer, between);
		coef[1] = dag_scale(dag, rat(3, 8), dag_add(dag, span, step));
		coef[2] = dag_scale(dag, rat(3, 8), dag_sub(dag, sum, inner));
		Ref rise = dag_scale(dag, rat(1, 8), span), turn = dag_scale(dag, rat(3, 8), step);
		coef[3] = dag_sub(dag, rise, turn);
	}
	for (int i = 0; i <= degree; ++i)
		dag_name(dag, coef[i], format("%c_%d", axis, i));
}

static Curve curve(Dag *dag)
{
	Curve c = { .degree = window_points(dag->window) - 1 };
	about_middle(dag, c.degree, VAR_X0, 'x', c.x);
	about_middle(dag, c.degree, VAR_Y0, 'y', c.y);
	for (int k = 0; k <= 2 * c.degree - 2; ++k) {
		c.omega[k] = NONE;
		for (int i = 0; i <= c.degree; ++i) {
			int j = k + 1 - i;
			if (j <= i || j > c.degree)
				continue;
			Ref part = cross_of(dag, c.x[i], c.y[i], c.x[j], c.y[j]);
			c.omega[k] = dag_add(dag, c.omega[k], scaled(dag, j - i, part));
		}
		dag_name(dag, c.omega[k], format("omega%d", k));
	}
	return c;
}

/* ---- degree 1, written out ---- */

/* The integral of a(tau) omega(tau), times `whole`, which makes every factor an integer. */
static Ref first_moment(Dag *dag, const Curve *c, const Ref *a, int whole)
{
	Ref sum = NONE;
	for (int j = 0; j <= c->degree; ++j) {
		Ref part = NONE;
		for (int k = 2 * c->degree - 2; k >= 0; --k)
			if ((j + k) % 2 == 0)
				part = dag_add(dag, part, scaled(dag, whole / (j + k + 1),
					c->omega[k]));
		sum = dag_add(dag, sum, dag_mul(dag, a[j], part));
	}
	return sum;
}

static Dag *to_degree_1(int window)
{
	Dag *dag = dag_new("power-basis");
	dag->window = window;
	const Curve c = curve(dag);
	const int whole = window == WINDOW_QUAD ? 15 : 105;   /* every j + k + 1 divides it */
	Ref area = NONE;
	for (int k = 2 * c.degree - 2; k >= 0; k -= 2)
		area = dag_add(dag, area, scaled(dag, 15 / (k + 1), c.omega[k]));
	finish_room(dag, 1);
	finish_next(dag, 0, 0, rat(1, 15));
	dag_accumulate(dag, area);
	finish_next(dag, 1, 0, rat(2, 3 * whole));
	dag_accumulate(dag, first_moment(dag, &c, c.x, whole));
	finish_next(dag, 0, 1, rat(2, 3 * whole));
	dag_accumulate(dag, first_moment(dag, &c, c.y, whole));
	return dag;
}

/* ---- beyond, by Gauss-Legendre nodes ---- */

int curve_nodes(int window, int degree)
{
	int p = window_points(window) - 1;
	return (p * degree + 2 * p) / 2;             /* exact to degree 2 nodes - 1 */
}

/* Even part and odd part of a polynomial at tau; the odd part is NONE at 0. */
typedef struct { Ref even, odd; } Halves;

static Ref horner_of(Dag *dag, const Ref *coef, int first, int last, Ref square)
{
	Ref sum = NONE;
	for (int k = last - (last - first) % 2; k >= first; k -= 2)
		sum = dag_add(dag, coef[k], sum == NONE ? NONE : dag_mul(dag, square, sum));
	return sum;
}

static Halves halves(Dag *dag, const Ref *coef, int degree, Rat tau)
{
	if (tau.num == 0)
		return (Halves){ coef[0], NONE };
	Ref node = dag_const(dag, tau), square = dag_mul(dag, node, node);
	Ref even = horner_of(dag, coef, 0, degree, square);
	Ref odd = horner_of(dag, coef, 1, degree, square);
	return (Halves){ even, dag_mul(dag, node, odd) };
}

typedef struct { Ref x, y, weight; } Node_values;    /* at one node */

/* The values at +tau and -tau; how many they are. */
static int at_node(Dag *dag, const Curve *c, Rat tau, Rat weight, Node_values v[2])
{
	Halves x = halves(dag, c->x, c->degree, tau), y = halves(dag, c->y, c->degree, tau);
	Halves omega = halves(dag, c->omega, 2 * c->degree - 2, tau);
	const int count = tau.num ? 2 : 1;
	for (int i = 0; i < count; ++i) {
		Ref (*join)(Dag *, Ref, Ref) = i ? dag_sub : dag_add;
		v[i].x = join(dag, x.even, x.odd);
		v[i].y = join(dag, y.even, y.odd);
		v[i].weight = dag_scale(dag, weight, join(dag, omega.even, omega.odd));
	}
	return count;
}

/* sum[m][n] += weight x^m y^n of all values of a node together. */
typedef struct { Ref at[MAX_DEGREE + 1][MAX_DEGREE + 1]; } Table;

static void add_node(Dag *dag, int degree, const Node_values *v, int values, Table *sum)
{
	Table *power = allocate(2 * sizeof *power);
	for (int m = 0; m <= degree; ++m)
		for (int n = 0; m + n <= degree; ++n) {
			Ref both = NONE;
			for (int i = 0; i < values; ++i) {
				Ref here = n ? dag_mul(dag, power[i].at[m][n - 1], v[i].y)
					: m ? dag_mul(dag, power[i].at[m - 1][0], v[i].x)
					: v[i].weight;
				power[i].at[m][n] = here;
				both = dag_add(dag, both, here);
			}
			sum->at[m][n] = dag_add(dag, sum->at[m][n], both);
		}
}

static Table *empty_table(void)
{
	Table *table = allocate(sizeof *table);
	for (int m = 0; m <= MAX_DEGREE; ++m)
		for (int n = 0; n <= MAX_DEGREE; ++n)
			table->at[m][n] = NONE;
	return table;
}

static Dag *by_nodes(int window, int degree)
{
	Dag *dag = dag_new("gauss-legendre");
	dag->window = window;
	dag->proof = PROOF_QUADRATURE;
	const Curve c = curve(dag);
	Rat tau[LEGENDRE_MAX], weight[LEGENDRE_MAX];
	int count = gauss_legendre(curve_nodes(window, degree), tau, weight);
	Table *sum = empty_table();
	for (int i = 0; i < count; ++i) {
		Node_values v[2];
		add_node(dag, degree, v, at_node(dag, &c, tau[i], weight[i], v), sum);
	}
	finish_room(dag, degree);
	for (int d = 0; d <= degree; ++d)
		for (int n = 0; n <= d; ++n) {
			finish_next(dag, d - n, n, rat(1, d + 2));
			dag_accumulate(dag, sum->at[d - n][n]);
		}
	return dag;
}

/* ---- all terms of the polynomials, in nested form: what a computer algebra system gives ---- */

static Dag *expanded(int window, int degree)
{
	Dag *dag = dag_new("expanded");
	dag->window = window;
	finish_room(dag, degree);
	for (int d = 0; d <= degree; ++d)
		for (int n = 0; n <= d; ++n) {
			const Mono mono = mono_var(VAR_X, d - n) + mono_var(VAR_Y, n);
			Poly value = green_curve(window_points(window), poly_mono(rat(1, 1), mono));
			Rat content = poly_content(value);
			Poly integers = poly_scale(value, rat_div(rat(1, 1), content));
			finish_next(dag, d - n, n, content);
			dag_accumulate(dag, horner(dag, integers, VAR_X0));
		}
	return dag;
}

Dag *curve_moments(int window, int degree, const char *preferred)
{
	if (preferred && strcmp(preferred, "expanded") == 0 && degree <= EXPANDED_DEGREE)
		return expanded(window, degree);
	if (degree == 0)
		return area(window);
	return degree == 1 ? to_degree_1(window) : by_nodes(window, degree);
}

static Ref power_of(Dag *dag, Ref base, int power)
{
	if (power <= 1)
		return power ? base : dag_const(dag, rat(1, 1));
	Ref half = power_of(dag, base, power / 2);
	return dag_mul(dag, half, power % 2 ? dag_mul(dag, half, base) : half);
}

Dag *curve_monomial_edge(int window, int m, int n)
{
	Dag *dag = dag_new("gauss-legendre");
	dag->window = window;
	dag->proof = PROOF_QUADRATURE;
	const Curve c = curve(dag);
	Rat tau[LEGENDRE_MAX], weight[LEGENDRE_MAX];
	int count = gauss_legendre(curve_nodes(window, m + n), tau, weight);
	Ref sum = NONE;
	for (int i = 0; i < count; ++i) {
		Node_values v[2];
		int values = at_node(dag, &c, tau[i], weight[i], v);
		for (int k = 0; k < values; ++k) {
			Ref x = power_of(dag, v[k].x, m), y = power_of(dag, v[k].y, n);
			Ref term = dag_mul(dag, v[k].weight, dag_mul(dag, x, y));
			sum = dag_add(dag, sum, term);
		}
	}
	Ref divisor = dag_const(dag, rat(m + n + 2, 1));
	dag_out(dag, dag_div(dag, sum, divisor));
	return dag;
}

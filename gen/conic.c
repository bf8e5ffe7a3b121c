/* conic.c - area and moments of the cap between a conic edge and its chord.
 *
 * A conic has the weights 1, w, 1. Its cap, with T = 1/2 cross(p1 - p0, p2 - p0), has the area
 * f(w) T,
 *
 *     f(w) = w (phi - w) / (1 - w^2),  phi = acos(w) / sqrt(1 - w^2)       (w > 1: acosh, w^2 - 1)
 *
 * f(0) = 0, f(1) = 2/3, f(inf) = 1. Up to w = 2 it is g + g E(w-1), g = w / (w + 11/16), with a
 * short polynomial E (constants.c); beyond, 1 - (w acosh w - q) / (q D), q^2 = D = w^2 - 1. For -1
 * < w < 0 the arc is the complementary one: f(-w) = f(w) - pi w / D^(3/2). Below -1 the curve
 * passes through infinity; the runtime refuses that.
 *
 * Moments, for 0 <= w <= 3 (the runtime halves other arcs first): p = m + X u + Y v with m the
 * middle of the chord, u = (p2 - p0)/2 and v = p1 - m. The cap is X^2 <= R(Y) = (1 - s)(1 - tau s)
 * for Y = s w/(1+w), 0 <= s <= 1, tau = (w-1)/(w+1). Odd powers of X vanish, for the others
 *
 *     int X^a Y^b = 2/(a+1) int R^((a+1)/2) Y^b dY,
 *
 * where sqrt(1-s) is the weight function of a Gauss-Jacobi rule and the rest is smooth: as many
 * nodes as bring the truncation below the rounding (tests/constants.c). From there int p^m q^n X^a
 * Y^b follows by p = X u_x + Y v_x, one factor at a time, and a translation by m. With the chord's
 * own moments, those of a line edge, this gives form 3 of the conic. Source: own derivation. */
#include "gen.h"

typedef struct { Ref area; Ref middle[2], u[2], v[2]; } Frame;   /* area: T */

typedef struct { Ref value, size; } Cross;             /* the terms of size are positive */

static Cross cross_of(Dag *dag, const Ref *a, const Ref *b, const Ref *size_a, const Ref *size_b)
{
	Ref left = dag_mul(dag, a[0], b[1]), right = dag_mul(dag, a[1], b[0]);
	Ref left_size = dag_mul(dag, size_a[0], size_b[1]);
	Ref right_size = dag_mul(dag, size_a[1], size_b[0]);
	Ref value = dag_sub(dag, left, right);
	return (Cross){ value, dag_add(dag, left_size, right_size) };
}

/* T = 1/2 b x a = 1/4 (a + b) x (p2 - p0), a = p1 - p0, b = p1 - p2: the one whose terms are
 * smaller. The first is good where p1 is near an end of the chord, the second where it is far away,
 * so that a and b are nearly parallel: near-semicircles. Both change sign when the curve is
 * reversed. */
static Ref triangle(Dag *dag, const Ref *a, const Ref *b)
{
	Ref sum[2], chord[2], size[4][2];
	for (int axis = 0; axis < 2; ++axis) {
		sum[axis] = dag_add(dag, a[axis], b[axis]);
		Ref p0 = dag_var(dag, VAR_X0 + axis), p2 = dag_var(dag, VAR_X2 + axis);
		chord[axis] = dag_sub(dag, p2, p0);
		size[0][axis] = dag_unary(dag, OP_ABS, a[axis]);
		size[1][axis] = dag_unary(dag, OP_ABS, b[axis]);
		size[2][axis] = dag_add(dag, size[0][axis], size[1][axis]);
		size[3][axis] = dag_unary(dag, OP_ABS, chord[axis]);
	}
	const Cross near = cross_of(dag, b, a, size[1], size[0]);
	const Cross far = cross_of(dag, sum, chord, size[2], size[3]);
	Ref half = dag_const(dag, rat(1, 2)), quarter = dag_const(dag, rat(1, 4));
	Ref excess = dag_sub(dag, dag_mul(dag, half, far.size), near.size);
	Ref by_ends = dag_mul(dag, half, near.value), by_chord = dag_mul(dag, quarter, far.value);
	return dag_choose(dag, excess, by_ends, by_chord);
}

static Frame frame(Dag *dag)
{
	Frame f;
	Ref half = dag_const(dag, rat(1, 2));
	Ref a[2], b[2];
	for (int axis = 0; axis < 2; ++axis) {
		Ref p0 = dag_var(dag, VAR_X0 + axis), p1 = dag_var(dag, VAR_X1 + axis);
		Ref p2 = dag_var(dag, VAR_X2 + axis);
		a[axis] = dag_sub(dag, p1, p0);
		b[axis] = dag_sub(dag, p1, p2);
		f.middle[axis] = dag_mul(dag, half, dag_add(dag, p0, p2));
		f.u[axis] = dag_mul(dag, half, dag_sub(dag, p2, p0));
		f.v[axis] = dag_mul(dag, half, dag_add(dag, a[axis], b[axis]));
	}
	f.area = dag_name(dag, triangle(dag, a, b), "area");
	return f;
}

/* f for |w| = u <= 2; x = u - 1. */
static Ref near_f(Dag *dag, int is_float, Ref u, Ref x)
{
	Ref g = dag_div(dag, u, dag_add(dag, u, dag_const(dag, conic_shift)));
	dag_name(dag, g, "g");
	return dag_add(dag, g, dag_mul(dag, g, series_value(dag, series_conic(is_float), x)));
}

static Dag *cap_area(int is_float)
{
	Dag *dag = dag_new("conic");
	dag->window = WINDOW_CONIC;
	dag->proof = PROOF_NONE;
	dag->k = 24;           /* f 8, one of T 4; for -1 < w < 0 twice the former, cancelling */
	Ref one = dag_const(dag, rat(1, 1)), w = dag_var(dag, VAR_W);
	Ref most = dag_const(dag, rat((Int)1 << 40, 1));        /* f(most) is 1 already */
	Ref size = dag_unary(dag, OP_ABS, w);
	Ref u = dag_name(dag, dag_choose(dag, dag_sub(dag, size, most), most, size), "u");
	Ref x = dag_name(dag, dag_sub(dag, u, one), "excess");
	Ref y = dag_unary(dag, OP_ABS, x);
	Ref d = dag_name(dag, dag_add(dag, y, dag_mul(dag, y, u)), "d");     /* |1 - w^2| */
	Ref q = dag_name(dag, dag_unary(dag, OP_SQRT, d), "q");
	const Logarithm log = logarithm(dag, is_float, dag_add(dag, u, q), NONE);
	Ref whole = dag_add(dag, log.half, log.half);
	Ref outside = dag_sub(dag, dag_mul(dag, u, whole), q);
	Ref ellipse = dag_scale(dag, number(NUMBER_PI), u);
	Ref top = dag_choose(dag, w, outside, ellipse);
	Ref rest = dag_name(dag, dag_div(dag, top, dag_mul(dag, q, d)), "tail");
	Ref near = dag_name(dag, near_f(dag, is_float, u, x), "near");
	Ref far = dag_sub(dag, one, rest), opposite = dag_sub(dag, near, rest);
	Ref beyond = dag_sub(dag, w, dag_const(dag, rat(2, 1)));
	Ref negative = dag_sub(dag, u, w);
	Ref f = dag_choose(dag, beyond, far, dag_choose(dag, negative, opposite, near));
	finish_room(dag, 0);
	finish_next(dag, 0, 0, rat(1, 1));
	dag_name(dag, f, "f");
	dag_accumulate(dag, dag_mul(dag, f, frame(dag).area));
	return dag;
}

/* ---- moments ---- */

enum { SIDE = MAX_DEGREE + 1 };

typedef struct {
	Dag *dag;
	int degree;
	Frame frame;
	Ref cap[SIDE][SIDE];                 /* int X^a Y^b, even a */
	Ref mixed[SIDE][SIDE][SIDE][SIDE];   /* int p^m q^n X^a Y^b, 0 is "not yet" */
} Cap;

static void add_cap_moments(Cap *cap, int is_float)
{
	Dag *dag = cap->dag;
	Rat node[JACOBI_MAX], weight[JACOBI_MAX];
	int nodes = gauss_jacobi(gauss_jacobi_nodes(cap->degree, is_float), node, weight);
	Ref one = dag_const(dag, rat(1, 1)), w = dag_var(dag, VAR_W);
	Ref above = dag_add(dag, w, one);
	Ref tau = dag_name(dag, dag_div(dag, dag_sub(dag, w, one), above), "tau");
	Ref top = dag_name(dag, dag_div(dag, w, above), "top");
	Ref value[JACOBI_MAX], square[JACOBI_MAX];   /* weight sqrt(1 - tau s) R^(a/2); R */
	for (int i = 0; i < nodes; ++i) {
		Ref rest = dag_sub(dag, one, dag_mul(dag, tau, dag_const(dag, node[i])));
		value[i] = dag_scale(dag, weight[i], dag_unary(dag, OP_SQRT, rest));
		square[i] = dag_scale(dag, rat_sub(rat(1, 1), node[i]), rest);
	}
	for (int a = 0; a <= cap->degree; a += 2) {
		Ref power = top, factor[JACOBI_MAX];
		for (int i = 0; i < nodes; ++i)
			factor[i] = value[i];
		for (int b = 0; a + b <= cap->degree; ++b) {
			Ref sum = NONE;
			for (int i = 0; i < nodes; ++i) {
				sum = dag_add(dag, sum, factor[i]);
				factor[i] = dag_scale(dag, node[i], factor[i]);
			}
			Ref scaled = dag_scale(dag, rat(2, a + 1), power);
			cap->cap[a][b] = dag_mul(dag, dag_mul(dag, scaled, cap->frame.area), sum);
			power = dag_mul(dag, power, top);
		}
		for (int i = 0; i < nodes; ++i)
			value[i] = dag_mul(dag, value[i], square[i]);
	}
}

/* int p^m q^n X^a Y^b over the cap, (p, q) = X u + Y v; NONE where it vanishes. */
static Ref mixed(Cap *cap, int m, int n, int a, int b)
{
	Ref *place = &cap->mixed[m][n][a][b];
	if (*place)
		return *place;
	if (m == 0 && n == 0)
		return *place = a % 2 ? NONE : cap->cap[a][b];
	const int axis = m == 0, less_m = m - !axis, less_n = n - axis;
	const Ref across = mixed(cap, less_m, less_n, a + 1, b);
	const Ref along = mixed(cap, less_m, less_n, a, b + 1);
	const Ref part[2] = { across, along };
	const Ref by[2] = { cap->frame.u[axis], cap->frame.v[axis] };
	Ref sum = NONE;
	for (int i = 0; i < 2; ++i)
		if (part[i] != NONE)
			sum = dag_add(cap->dag, sum, dag_mul(cap->dag, by[i], part[i]));
	return *place = sum;
}

static void add_multiple(Dag *dag, Ref *to, Ref factor, Ref from)
{
	*to = dag_add(dag, *to, dag_mul(dag, factor, from));
}

/* From the middle of the chord to the origin: a_m += m_x a_(m-1) again and again, then in y. */
static void translate(Cap *cap, Ref moment[SIDE][SIDE])
{
	const int degree = cap->degree;
	for (int n = 0; n < degree; ++n)
		for (int first = 1; first <= degree - n; ++first)
			for (int m = degree - n; m >= first; --m)
				add_multiple(cap->dag, &moment[m][n], cap->frame.middle[0],
					moment[m - 1][n]);
	for (int m = 0; m < degree; ++m)
		for (int first = 1; first <= degree - m; ++first)
			for (int n = degree - m; n >= first; --n)
				add_multiple(cap->dag, &moment[m][n], cap->frame.middle[1],
					moment[m][n - 1]);
}

static Dag *cap_moments(int degree, int is_float)
{
	Cap *cap = allocate(sizeof *cap);
	Dag *dag = dag_new("gauss-jacobi");
	dag->window = WINDOW_CONIC;
	dag->proof = PROOF_NONE;
	cap->dag = dag;
	cap->degree = degree;
	cap->frame = frame(dag);
	add_cap_moments(cap, is_float);
	Ref moment[SIDE][SIDE];
	for (int m = 0; m <= degree; ++m)
		for (int n = 0; m + n <= degree; ++n)
			moment[m][n] = mixed(cap, m, n, 0, 0);
	translate(cap, moment);
	finish_room(dag, degree);
	for (int d = 0; d <= degree; ++d)
		for (int n = 0; n <= d; ++n) {
			finish_next(dag, d - n, n, rat(1, 1));
			dag_accumulate(dag, moment[d - n][n]);
		}
	return dag;
}

Dag *conic_cap(int degree, int is_float)
{
	return degree ? cap_moments(degree, is_float) : cap_area(is_float);
}

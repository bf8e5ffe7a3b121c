/* distance.c - powers of the distance to the origin over the triangle (origin, p0, p1), and the
 * sum that shows whether edges close.
 *
 * Green's theorem in polar form: an edge contributes I_k = s/(k+2) E_k, E_k = int_0^1 |p0 + t d|^k
 * dt, s = x0 y1 - x1 y0. E_k > 0, so that only s cancels, and it is formed from exact products.
 * With the radii r0, r1 of the ends, S = r0 + r1, d = |p1 - p0|, t = d/S in [0, 1] and K(tau) =
 * (atanh(sqrt tau)/sqrt tau - 1)/tau,
 *
 *     4 E_1  = S + (|p0 + p1|^2 + (2s/S)^2 K(t^2)) / S
 *     E_(-1) = 2/S atanh(t)/t,      1 - t without cancellation from p0 . p1
 *     2(k+1) E_k = r0^k + r1^k + e^2 S H_(k-1)(r0, r1) + 2k h^2 E_(k-2),    k = 3, 5
 *
 * where h = s/d is the distance of the edge's line, e = (r1 - r0)/d, and H is the complete
 * homogeneous sum. Every term is >= 0. K comes from its series where t is small, else from atanh t
 * = k ln2/2 + v + v^3 K(v^2), z = (1+t)/(1-t) = 2^k m, v = (m-1)/(m+1). All but s is symmetric in
 * the two ends bit for bit, so swapping them negates the result; where a denominator can be 0, s
 * is 0, and a selection puts 1 in its place. The step from one k to the next is an integration by
 * parts.
 *
 * Bound: 28 roundings along any path for k = 1 (s 2, each radius 2, the two sums 2, the mean of
 * the logarithm at most a quarter of the sum); the others carry the recursion, 6 more per step,
 * and the logarithm in full for k = -1. */
#include "gen.h"

typedef struct {
	Dag *dag;
	int is_float;
	Ref x0, y0, x1, y1, one;
	Ref s, q0, q1, r0, r1, sum, safe, inverse, d2, d, t, tau;
} Edge_values;

static Ref dot(Dag *dag, Ref ax, Ref ay, Ref bx, Ref by)
{
	Ref x = dag_mul(dag, ax, bx), y = dag_mul(dag, ay, by);
	return dag_add(dag, x, y);
}

/* a if it is > 0, else 1. */
static Ref or_one(Dag *dag, Ref a)
{
	return dag_choose(dag, a, a, dag_const(dag, rat(1, 1)));
}

/* x0 y1 - x1 y0 with the errors of both products, good to 2 u (Cornea, Harrison, Tang 2002). */
static Ref exact_cross(Dag *dag, Ref x0, Ref y0, Ref x1, Ref y1)
{
	Ref left = dag_name(dag, dag_mul(dag, x0, y1), "left");
	Ref right = dag_name(dag, dag_mul(dag, x1, y0), "right");
	Ref lost_left = dag_node(dag, OP_ERROR, x0, y1, left);
	Ref lost_right = dag_node(dag, OP_ERROR, x1, y0, right);
	Ref lost = dag_sub(dag, lost_left, lost_right);
	return dag_name(dag, dag_add(dag, dag_sub(dag, left, right), lost), "s");
}

static Edge_values edge_values(Dag *dag, int is_float)
{
	Edge_values e = { .dag = dag, .is_float = is_float, .one = dag_const(dag, rat(1, 1)) };
	e.x0 = dag_var(dag, VAR_X0);
	e.y0 = dag_var(dag, VAR_Y0);
	e.x1 = dag_var(dag, VAR_X1);
	e.y1 = dag_var(dag, VAR_Y1);
	e.s = exact_cross(dag, e.x0, e.y0, e.x1, e.y1);
	e.q0 = dag_name(dag, dot(dag, e.x0, e.y0, e.x0, e.y0), "q0");
	e.q1 = dag_name(dag, dot(dag, e.x1, e.y1, e.x1, e.y1), "q1");
	e.r0 = dag_name(dag, dag_unary(dag, OP_SQRT, e.q0), "r0");
	e.r1 = dag_name(dag, dag_unary(dag, OP_SQRT, e.q1), "r1");
	e.sum = dag_name(dag, dag_add(dag, e.r0, e.r1), "radii");
	e.safe = dag_name(dag, or_one(dag, e.sum), "safe");
	e.inverse = dag_name(dag, dag_div(dag, e.one, e.safe), "inverse");
	Ref dx = difference_of(dag, VAR_X0, VAR_X1, "dx");
	Ref dy = difference_of(dag, VAR_Y0, VAR_Y1, "dy");
	e.d2 = dag_name(dag, dot(dag, dx, dy, dx, dy), "d2");
	e.d = dag_name(dag, dag_unary(dag, OP_SQRT, e.d2), "d");
	e.t = dag_name(dag, dag_mul(dag, e.d, e.inverse), "t");
	e.tau = dag_name(dag, dag_mul(dag, e.t, e.t), "tau");
	return e;
}

/* (1+t)/(1-t), kept finite where t rounds to 1. */
static Ref ratio(const Edge_values *e)
{
	Rat unit = e->is_float ? rat(1, 1 << 24) : rat(1, (Int)1 << 53);
	Ref least = dag_scale(e->dag, unit, e->safe);
	Ref gap = dag_node(e->dag, OP_MAX, dag_sub(e->dag, e->safe, e->d), least, NONE);
	return dag_div(e->dag, dag_add(e->dag, e->safe, e->d), gap);
}

static Ref twice(Dag *dag, Ref a)
{
	return dag_add(dag, a, a);
}

/* 4 E_1; `mean` is K(tau). */
static Ref mean_1(const Edge_values *e, Ref mean, Ref *both_squared)
{
	Dag *dag = e->dag;
	Ref sx = sum_of(dag, VAR_X0, VAR_X1, "sx"), sy = sum_of(dag, VAR_Y0, VAR_Y1, "sy");
	Ref both = dag_name(dag, dot(dag, sx, sy, sx, sy), "both");
	Ref g = dag_name(dag, dag_mul(dag, twice(dag, e->s), e->inverse), "g");
	Ref gg = dag_name(dag, dag_mul(dag, g, g), "gg");
	Ref inner = dag_add(dag, both, dag_mul(dag, gg, mean));
	*both_squared = both;
	return dag_name(dag, dag_add(dag, e->sum, dag_mul(dag, inner, e->inverse)), "mean1");
}

static Dag *contribution(const Edge_values *e, Ref mean, Rat factor)
{
	Dag *dag = e->dag;
	finish_room(dag, 0);
	finish_next(dag, 0, 0, factor);
	dag_accumulate(dag, dag_mul(dag, e->s, mean));
	return dag;
}

static Dag *distance(const Edge_values *e)
{
	Dag *dag = e->dag;
	Ref both;
	const Logarithm log = logarithm(dag, e->is_float, ratio(e), e->tau);
	Ref cube = dag_mul(dag, e->t, e->tau);
	Ref rest = dag_sub(dag, log.half, e->t), below = dag_choose(dag, log.k, cube, e->one);
	Ref beyond = dag_div(dag, rest, below);
	Ref mean = dag_choose(dag, log.k, beyond, log.series);
	return contribution(e, mean_1(e, mean, &both), rat(1, 12));
}

/* 1 - t = 2 beta / (1+t) if p0 . p1 >= 0, else 2 sigma^2 / (beta (1+t)): where t is near 1. */
static Dag *inverse_distance(const Edge_values *e)
{
	Dag *dag = e->dag;
	const Rat seam = rat(3, 4);
	Ref product = dag_name(dag, dot(dag, e->x0, e->y0, e->x1, e->y1), "product");
	Ref radii = dag_mul(dag, e->r0, e->r1);
	Ref size = dag_add(dag, radii, dag_unary(dag, OP_ABS, product));
	Ref beta = dag_mul(dag, dag_mul(dag, size, e->inverse), e->inverse);
	Ref sigma = dag_mul(dag, dag_mul(dag, e->s, e->inverse), e->inverse);
	Ref a = dag_add(dag, e->one, e->t), aa = dag_mul(dag, a, a);
	Ref far = dag_sub(dag, dag_const(dag, seam), e->t);
	Ref squared = dag_mul(dag, sigma, sigma);
	Ref top = dag_choose(dag, far, a, dag_choose(dag, product, aa, dag_mul(dag, aa, beta)));
	Ref ahead = twice(dag, beta), behind = twice(dag, squared);
	Ref gap = dag_sub(dag, e->one, e->t);
	Ref low = dag_choose(dag, far, gap, dag_choose(dag, product, ahead, behind));
	Ref z = dag_node(dag, OP_MAX, dag_div(dag, top, low), e->one, NONE);
	Logarithm log = logarithm(dag, e->is_float, z, e->tau);
	Ref series = dag_add(dag, e->one, dag_mul(dag, e->tau, log.series));
	Ref beyond = dag_div(dag, log.half, dag_choose(dag, log.k, e->t, e->one));
	Ref mean = dag_choose(dag, log.k, beyond, series);
	return contribution(e, dag_mul(dag, e->inverse, mean), rat(2, 1));
}

/* Of two products that are mirror images neither may be fused: an absolute value, of what is not
 * negative anyway, stands in between. */
static Ref balanced_sum(Dag *dag, Ref a, Ref b)
{
	Ref left = dag_unary(dag, OP_ABS, a), right = dag_unary(dag, OP_ABS, b);
	return dag_add(dag, left, right);
}

/* k = 3 and 5. q2 = (2h/S)^2, from which e^2 = |p0+p1|^2/S^2 - q2: an error of q2 cancels between
 * the two terms it occurs in, so that any will do where d underflows. */
static Dag *odd_power(const Edge_values *e, int power)
{
	Dag *dag = e->dag;
	Ref both, inverse_d2 = dag_div(dag, e->one, or_one(dag, e->d2));
	Logarithm log = logarithm(dag, e->is_float, ratio(e), e->tau);
	Ref c = dag_mul(dag, e->safe, dag_mul(dag, e->safe, inverse_d2));   /* 1/tau */
	Ref rest = dag_mul(dag, dag_sub(dag, log.half, e->t), e->t);
	Ref beyond = dag_mul(dag, rest, dag_mul(dag, c, c));
	Ref mean1 = mean_1(e, dag_choose(dag, log.k, beyond, log.series), &both);
	Ref g = dag_mul(dag, twice(dag, e->s), e->inverse), gg = dag_mul(dag, g, g);
	Ref q2s = dag_mul(dag, dag_mul(dag, gg, inverse_d2), e->sum);
	Ref e2s = dag_sub(dag, dag_mul(dag, both, e->inverse), q2s);
	Ref h2 = dag_mul(dag, q2s, e->sum);                                  /* 4 h^2 */
	Ref b = dag_mul(dag, e->r0, e->r1), sum = dag_add(dag, e->q0, e->q1);
	Ref cube0 = dag_mul(dag, e->r0, e->q0), cube1 = dag_mul(dag, e->r1, e->q1);
	Ref cubes = balanced_sum(dag, cube0, cube1);
	Ref homogeneous = dag_add(dag, sum, b);
	Ref mean3 = dag_add(dag, cubes, dag_mul(dag, e2s, homogeneous));
	mean3 = dag_add(dag, mean3, dag_mul(dag, dag_scale(dag, rat(3, 8), h2), mean1));
	if (power == 3)
		return contribution(e, mean3, rat(1, 40));
	Ref f0 = dag_mul(dag, e->q0, e->q0), f1 = dag_mul(dag, e->q1, e->q1);
	Ref fifth0 = dag_mul(dag, e->r0, f0), fifth1 = dag_mul(dag, e->r1, f1);
	Ref fifth = balanced_sum(dag, fifth0, fifth1), fourth = dag_add(dag, f0, f1);
	homogeneous = dag_add(dag, dag_mul(dag, b, homogeneous), fourth);
	Ref mean5 = dag_add(dag, fifth, dag_mul(dag, e2s, homogeneous));
	mean5 = dag_add(dag, mean5, dag_mul(dag, dag_scale(dag, rat(5, 16), h2), mean3));
	return contribution(e, mean5, rat(1, 84));
}

Dag *distance_power(int power, int is_float)
{
	Dag *dag = dag_new("polar");
	dag->proof = PROOF_NONE;
	dag->k = power == 1 ? 28 : power == 3 ? 34 : 40;
	const Edge_values e = edge_values(dag, is_float);
	if (power == 1)
		return distance(&e);
	return power < 0 ? inverse_distance(&e) : odd_power(&e, power);
}

/* x0 y0 - x1 y1: what a vertex adds as a start it takes away as an end. */
Dag *closure_sum(void)
{
	Dag *dag = dag_new("products");
	const Leaves at = ends(dag);
	Ref start = dag_mul(dag, at.ref[VAR_X0], at.ref[VAR_Y0]);
	Ref end = dag_mul(dag, at.ref[VAR_X1], at.ref[VAR_Y1]);
	finish_room(dag, 0);
	finish_next(dag, 0, 0, rat(1, 1));
	dag_accumulate(dag, dag_sub(dag, start, end));
	return dag;
}

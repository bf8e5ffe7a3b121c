/* Integrals of powers of the distance from the origin over signed triangles, in MPFR.
 *
 * Closed form: let the edge have length d, its points the coordinate u along it, measured from the
 * foot of the perpendicular from the origin, and h = s/d be the distance of that foot. Then
 * I_k = s/((k+2) d) J_k, where J_k = int (u^2 + h^2)^(k/2) du from u0 to u1 is
 *
 *     J_-1 = asinh(u1/|h|) - asinh(u0/|h|),    (k+1) J_k = u1 r1^k - u0 r0^k + k h^2 J_(k-2).
 *
 * s = 0 is found exactly, because the difference of its products is rounded once; then all is 0.
 * What cancels are differences of ends, by the ratio of d to r and the powers of h to those of r;
 * the doubles tested leave more than 200 of the bits.
 *
 * Quadrature: Gauss-Legendre of NODES points, on pieces short enough to converge: where the length
 * is at most half the sum of the distances of the ends, an error below 2^-200 is left.
 */
#include "distance_reference.h"

enum { NODES = 60, MOST_HALVINGS = 50 };

static mpfr_t x[2], y[2], dx, dy, length, s, u[2], square[2], power[2], height, part, total;
static mpfr_t node[NODES], weight[NODES];
static int ready, rule_ready;

static void start(void)
{
	if (ready)
		return;
	mpfr_inits2(DISTANCE_BITS, x[0], x[1], y[0], y[1], dx, dy, length, s, u[0], u[1], square[0],
		square[1], power[0], power[1], height, part, total, (mpfr_ptr)0);
	ready = 1;
}

void distance_init(Distances *d)
{
	for (int i = 0; i < DISTANCE_POWERS; i++)
		mpfr_init2(d->value[i], DISTANCE_BITS);
}

void distance_clear(Distances *d)
{
	for (int i = 0; i < DISTANCE_POWERS; i++)
		mpfr_clear(d->value[i]);
}

/* x, y, dx, dy, s */
static void take_edge(const double edge[4], double cx, double cy)
{
	start();
	for (int i = 0; i < 2; i++) {
		mpfr_set_d(x[i], edge[2 * i], MPFR_RNDN);
		mpfr_sub_d(x[i], x[i], cx, MPFR_RNDN);
		mpfr_set_d(y[i], edge[2 * i + 1], MPFR_RNDN);
		mpfr_sub_d(y[i], y[i], cy, MPFR_RNDN);
	}
	mpfr_sub(dx, x[1], x[0], MPFR_RNDN);
	mpfr_sub(dy, y[1], y[0], MPFR_RNDN);
	mpfr_fmms(s, x[0], y[1], x[1], y[0], MPFR_RNDN);
}

/* Of one end: u, r^2 and r^-1. */
static void take_end(int i)
{
	mpfr_fmma(u[i], x[i], dx, y[i], dy, MPFR_RNDN);
	mpfr_div(u[i], u[i], length, MPFR_RNDN);
	mpfr_fmma(square[i], x[i], x[i], y[i], y[i], MPFR_RNDN);
	mpfr_rec_sqrt(power[i], square[i], MPFR_RNDN);
}

/* total = asinh(u1/height) - asinh(u0/height) */
static void logarithm(void)
{
	mpfr_div(total, u[1], height, MPFR_RNDN);
	mpfr_asinh(total, total, MPFR_RNDN);
	mpfr_div(part, u[0], height, MPFR_RNDN);
	mpfr_asinh(part, part, MPFR_RNDN);
	mpfr_sub(total, total, part, MPFR_RNDN);
}

/* total = J_k from J_(k-2), and the powers of both ends raised by two. */
static void raise_power(int k)
{
	mpfr_mul(power[0], power[0], square[0], MPFR_RNDN);
	mpfr_mul(power[1], power[1], square[1], MPFR_RNDN);
	mpfr_fmms(part, u[1], power[1], u[0], power[0], MPFR_RNDN);
	mpfr_mul(total, total, height, MPFR_RNDN);
	mpfr_mul(total, total, height, MPFR_RNDN);
	mpfr_mul_ui(total, total, (unsigned long)k, MPFR_RNDN);
	mpfr_add(total, total, part, MPFR_RNDN);
	mpfr_div_ui(total, total, (unsigned long)k + 1, MPFR_RNDN);
}

void distance_edge(Distances *out, const double edge[4], double cx, double cy)
{
	take_edge(edge, cx, cy);
	if (mpfr_zero_p(s)) {
		for (int i = 0; i < DISTANCE_POWERS; i++)
			mpfr_set_zero(out->value[i], 1);
		return;
	}
	mpfr_hypot(length, dx, dy, MPFR_RNDN);
	take_end(0);
	take_end(1);
	mpfr_div(s, s, length, MPFR_RNDN);
	mpfr_abs(height, s, MPFR_RNDN);
	logarithm();
	for (int i = 0; i < DISTANCE_POWERS; i++) {
		const int k = 2 * i - 1;
		if (i)
			raise_power(k);
		mpfr_mul(out->value[i], total, s, MPFR_RNDN);
		mpfr_div_ui(out->value[i], out->value[i], (unsigned long)k + 2, MPFR_RNDN);
	}
}

/* P_n in power[0] and P_(n-1) in power[1] by the recurrence of three terms. */
static void legendre(const mpfr_t at)
{
	mpfr_set_ui(power[1], 1, MPFR_RNDN);
	mpfr_set(power[0], at, MPFR_RNDN);
	for (unsigned long n = 2; n <= NODES; n++) {
		mpfr_mul(part, power[0], at, MPFR_RNDN);
		mpfr_mul_ui(part, part, 2 * n - 1, MPFR_RNDN);
		mpfr_mul_ui(power[1], power[1], n - 1, MPFR_RNDN);
		mpfr_sub(part, part, power[1], MPFR_RNDN);
		mpfr_set(power[1], power[0], MPFR_RNDN);
		mpfr_div_ui(power[0], part, n, MPFR_RNDN);
	}
}

/* Nodes and weights on [0,1], by Newton's method from Tricomi's starting points. */
static void quadrature_rule(void)
{
	if (rule_ready)
		return;
	rule_ready = 1;
	for (int i = 0; i < NODES; i++) {
		mpfr_init2(weight[i], DISTANCE_BITS);
		mpfr_init2(node[i], DISTANCE_BITS);
		mpfr_const_pi(node[i], MPFR_RNDN);
		mpfr_mul_d(node[i], node[i], (i + 0.75) / (NODES + 0.5), MPFR_RNDN);
		mpfr_cos(node[i], node[i], MPFR_RNDN);
		for (int step = 0; step < 10; step++) {
			legendre(node[i]);
			/* P_n' = n (P_(n-1) - x P_n) / (1 - x^2) */
			mpfr_mul(part, node[i], power[0], MPFR_RNDN);
			mpfr_sub(part, power[1], part, MPFR_RNDN);
			mpfr_mul_ui(part, part, NODES, MPFR_RNDN);
			mpfr_sqr(total, node[i], MPFR_RNDN);
			mpfr_ui_sub(total, 1, total, MPFR_RNDN);
			mpfr_div(part, part, total, MPFR_RNDN);
			mpfr_div(power[0], power[0], part, MPFR_RNDN);
			mpfr_sub(node[i], node[i], power[0], MPFR_RNDN);
		}
		/* half of 2 / ((1 - x^2) P_n'^2) */
		mpfr_sqr(part, part, MPFR_RNDN);
		mpfr_mul(part, part, total, MPFR_RNDN);
		mpfr_ui_div(weight[i], 1, part, MPFR_RNDN);
		mpfr_add_ui(node[i], node[i], 1, MPFR_RNDN);
		mpfr_div_2ui(node[i], node[i], 1, MPFR_RNDN);
	}
}

/* Adds int r^k dt from t = from to t = from + 2^-halvings to every out. */
static void add_piece(Distances *out, double from, int halvings)
{
	for (int n = 0; n < NODES; n++) {
		mpfr_div_2ui(part, node[n], (unsigned long)halvings, MPFR_RNDN);
		mpfr_add_d(part, part, from, MPFR_RNDN);
		mpfr_fma(u[0], part, dx, x[0], MPFR_RNDN);
		mpfr_fma(u[1], part, dy, y[0], MPFR_RNDN);
		mpfr_fmma(square[0], u[0], u[0], u[1], u[1], MPFR_RNDN);
		mpfr_rec_sqrt(power[0], square[0], MPFR_RNDN);
		mpfr_div_2ui(total, weight[n], (unsigned long)halvings, MPFR_RNDN);
		mpfr_mul(power[0], power[0], total, MPFR_RNDN);
		for (int i = 0; i < DISTANCE_POWERS; i++) {
			mpfr_add(out->value[i], out->value[i], power[0], MPFR_RNDN);
			mpfr_mul(power[0], power[0], square[0], MPFR_RNDN);
		}
	}
}

/* Distance of the point at t from the origin. */
static void distance_at(mpfr_t out, double t)
{
	mpfr_mul_d(u[0], dx, t, MPFR_RNDN);
	mpfr_add(u[0], u[0], x[0], MPFR_RNDN);
	mpfr_mul_d(u[1], dy, t, MPFR_RNDN);
	mpfr_add(u[1], u[1], y[0], MPFR_RNDN);
	mpfr_hypot(out, u[0], u[1], MPFR_RNDN);
}

static void add_pieces(Distances *out, double from, int halvings)
{
	const double width = 1.0 / (double)(1LL << halvings);
	distance_at(square[0], from);
	distance_at(square[1], from + width);
	mpfr_add(square[0], square[0], square[1], MPFR_RNDN);
	mpfr_mul_d(part, length, 2 * width, MPFR_RNDN);
	if (mpfr_cmp(part, square[0]) <= 0 || halvings == MOST_HALVINGS) {
		add_piece(out, from, halvings);
	} else {
		add_pieces(out, from, halvings + 1);
		add_pieces(out, from + width / 2, halvings + 1);
	}
}

void distance_quadrature(Distances *out, const double edge[4], double cx, double cy)
{
	take_edge(edge, cx, cy);
	mpfr_hypot(length, dx, dy, MPFR_RNDN);
	quadrature_rule();
	for (int i = 0; i < DISTANCE_POWERS; i++)
		mpfr_set_zero(out->value[i], 1);
	add_pieces(out, 0, 0);
	for (int i = 0; i < DISTANCE_POWERS; i++) {
		mpfr_mul(out->value[i], out->value[i], s, MPFR_RNDN);
		mpfr_div_ui(out->value[i], out->value[i], 2 * (unsigned long)i + 1, MPFR_RNDN);
	}
}

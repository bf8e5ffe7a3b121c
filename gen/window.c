/* window.c - what one line edge adds to the integral over a window: over a rectangle, which gives
 * coverage, or of a filter over its support.
 *
 * No polygon is clipped. For any density f, with F(x, y) its integral over y from below (Green),
 *
 *     integral over the region of f = - sum over edges of the integral of F(x, y(x)) dx,
 *
 * where F is 0 below the window and does not change above it. The ends of an edge are put in order
 * first, so that the edge and its reverse run the same operations, and only the signed width
 * differs: results negate bit for bit. An edge is clamped to a column of the window; each of the
 * two heights there comes from the end of the edge that is nearer to it:
 *
 *     yl = ay + (xl - ax)/(bx - ax) dy,     yr = by - (bx - xr)/(bx - ax) dy
 *
 * Where an edge is beside the column or vertical they may be anything, infinite or NaN too: what is
 * made of them is clamped (MIN and MAX give their second operand for NaN) and meets a width that is
 * exactly 0.
 *
 * A rectangle of height H: the mean of the clamped heights l and r, m = (l + r)/2, where t of d,
 * the difference of the heights, stick out above and b below, is m + (H - m) t/d - m b/d. t and b
 * are 0 for an edge that stays inside; so the least number added to d does no harm: where t is not
 * 0, H - m is at most d. They are sums of exact differences y - min(y, H) and p - max(p, 0), whose
 * rounding is not small only where it meets H - m = 0 or m = 0. Minima, maxima and products share a
 * port, so choices and sums stand in for them where they can.
 *
 * A filter: each column is cut where the edge crosses the knots of the rows. Between two of them F
 * is one polynomial, and the Gauss-Legendre rule that is exact for its degree along a line gives
 * the integral; above the support the integral over x is known. Ends of pieces are clamped to their
 * row, so that rounding never leaves it, and are relative to its lower left knot. */
#include "gen.h"

static Ref minimum(Dag *dag, Ref a, Ref b)
{
	return dag_node(dag, OP_MIN, a, b, NONE);
}

static Ref maximum(Dag *dag, Ref a, Ref b)
{
	return dag_node(dag, OP_MAX, a, b, NONE);
}

/* From low to high; low for NaN. */
static Ref clamp(Dag *dag, Ref a, Ref low, Ref high)
{
	Ref above = maximum(dag, a, low);
	return minimum(dag, above, high);
}

/* An edge from its left end a to its right end b. */
typedef struct { Ref ax, ay, bx, by, run, rise, inverse, one; } Ordered;

static Ordered ordered(Dag *dag)
{
	Ref x0 = dag_var(dag, VAR_X0), y0 = dag_var(dag, VAR_Y0);
	Ref x1 = dag_var(dag, VAR_X1), y1 = dag_var(dag, VAR_Y1);
	Ordered e = { .run = dag_name(dag, dag_sub(dag, x1, x0), "run") };
	e.one = dag_const(dag, rat(1, 1));
	e.ax = dag_name(dag, dag_choose(dag, e.run, x0, x1), "ax");
	e.bx = dag_name(dag, dag_choose(dag, e.run, x1, x0), "bx");
	e.ay = dag_name(dag, dag_choose(dag, e.run, y0, y1), "ay");
	e.by = dag_name(dag, dag_choose(dag, e.run, y1, y0), "by");
	e.rise = dag_name(dag, dag_sub(dag, e.by, e.ay), "rise");
	Ref length = dag_unary(dag, OP_ABS, e.run);
	e.inverse = dag_name(dag, dag_div(dag, e.one, length), "inverse");
	return e;
}

/* Heights where the edge enters and leaves a column, above a line. */
typedef struct { Ref left, right; } Heights;

static Heights heights(Dag *dag, const Ordered *e, Ref xl, Ref xr, Ref base)
{
	Ref ay = base == NONE ? e->ay : dag_sub(dag, e->ay, base);
	Ref by = base == NONE ? e->by : dag_sub(dag, e->by, base);
	Ref ahead = dag_mul(dag, dag_sub(dag, xl, e->ax), e->inverse);
	Ref behind = dag_mul(dag, dag_sub(dag, e->bx, xr), e->inverse);
	Heights y;
	y.left = dag_add(dag, ay, dag_mul(dag, ahead, e->rise));
	y.right = dag_sub(dag, by, dag_mul(dag, behind, e->rise));
	return y;
}

static Dag *new_window(int window, const char *scheme, Rat factor)
{
	Dag *dag = dag_new(scheme);
	dag->window = window;
	dag->proof = PROOF_PIECES;
	finish_room(dag, 0);
	finish_next(dag, 0, 0, factor);
	return dag;
}

/* width mean, or NaN where a coordinate is NaN or infinite, which clamps swallow: a - a is not 0.
 * */
static void finish_window(Dag *dag, const Ordered *e, Ref width, Ref mean)
{
	Ref rise = dag_sub(dag, e->rise, e->rise), run = dag_sub(dag, e->run, e->run);
	Ref value = dag_mul(dag, width, dag_add(dag, mean, rise));
	dag_accumulate(dag, dag_add(dag, value, run));
}

/* ---- coverage ---- */

/* A height that is not above H, not below 0 either, and how far it sticks out. */
typedef struct { Ref clamped, above, below; } Clamped;

static Clamped clamped(Dag *dag, Ref y, Ref height)
{
	Clamped c;
	Ref low = minimum(dag, y, height);
	c.clamped = maximum(dag, low, dag_const(dag, rat(0, 1)));
	c.above = dag_sub(dag, y, low);
	c.below = dag_sub(dag, low, c.clamped);
	return c;
}

static Ref distance_of(Dag *dag, Ref a, Ref b, const char *name)
{
	return dag_name(dag, dag_unary(dag, OP_ABS, dag_sub(dag, b, a)), name);
}

/* Twice the mean. */
static Ref mean_height(Dag *dag, const Ordered *e, Heights y, Ref height)
{
	Clamped left = clamped(dag, y.left, height), right = clamped(dag, y.right, height);
	Ref least = dag_node(dag, OP_LEAST, NONE, NONE, NONE);
	Ref d = distance_of(dag, y.left, y.right, "d");
	Ref inverse = dag_div(dag, e->one, dag_add(dag, d, least));
	Ref above = distance_of(dag, left.above, right.above, "above");
	Ref below = distance_of(dag, left.below, right.below, "below");
	Ref both = dag_name(dag, dag_add(dag, left.clamped, right.clamped), "both");
	Ref whole = dag_add(dag, height, height);
	Ref more = dag_mul(dag, above, inverse), less = dag_mul(dag, below, inverse);
	Ref raised = dag_mul(dag, dag_sub(dag, whole, both), more);
	Ref lowered = dag_mul(dag, both, less);
	Ref mean = dag_sub(dag, dag_add(dag, both, raised), lowered);
	return dag_name(dag, clamp(dag, mean, dag_const(dag, rat(0, 1)), whole), "mean");
}

Dag *window_coverage(void)
{
	Dag *dag = new_window(WINDOW_CELL, "clamped", rat(1, 2));
	const Ordered e = ordered(dag);
	Ref u0 = dag_var(dag, VAR_X2), u1 = dag_var(dag, VAR_X3);
	Ref v0 = dag_var(dag, VAR_Y2), v1 = dag_var(dag, VAR_Y3);
	Ref start = clamp(dag, dag_var(dag, VAR_X0), u0, u1);
	Ref end = clamp(dag, dag_var(dag, VAR_X1), u0, u1);
	Ref xl = dag_choose(dag, e.run, start, end), xr = dag_choose(dag, e.run, end, start);
	Ref width = dag_name(dag, dag_sub(dag, start, end), "width");
	Ref height = dag_name(dag, dag_sub(dag, v1, v0), "height");
	finish_window(dag, &e, width, mean_height(dag, &e, heights(dag, &e, xl, xr, v0), height));
	return dag;
}

/* ---- filters ---- */

/* Horner's scheme in y, whose coefficients are in x; NONE for 0. */
static Ref value_at(Dag *dag, Poly a, int var, Ref x, Ref y)
{
	if (a.count == 0)
		return NONE;
	if (var == VAR_X && poly_degree(a, VAR_X) == 0)
		return dag_const(dag, a.term[0].coef);
	Ref sum = NONE;
	for (int power = poly_degree(a, var); power >= 0; --power) {
		Poly part = { 0, allocate((size_t)a.count * sizeof(Term)) };
		for (int i = 0; i < a.count; ++i)
			if (mono_power(a.term[i].mono, var) == power)
				part.term[part.count++] = (Term){
					a.term[i].mono - mono_var(var, power), a.term[i].coef
				};
		if (sum != NONE)
			sum = dag_mul(dag, sum, var == VAR_X ? x : y);
		Ref coefficient = var == VAR_X ? part.count ? dag_const(dag, part.term[0].coef)
			: NONE : value_at(dag, part, VAR_X, x, y);
		sum = dag_add(dag, sum, coefficient);
	}
	return sum;
}

Ref cell_value(Dag *dag, Poly a, Ref x, Ref y)
{
	return value_at(dag, a, VAR_Y, x, y);
}

int cell_node(Dag *dag, Span x, Span y, Rat tau, Ref point[2][2])
{
	const Span axis[2] = { x, y };
	for (int k = 0; k < 2; ++k) {
		point[0][k] = axis[k].middle;
		if (tau.num == 0)
			continue;
		Ref offset = dag_scale(dag, tau, axis[k].half);
		point[0][k] = dag_add(dag, axis[k].middle, offset);
		/* no product of its own, lest fusing make the two differ */
		point[1][k] = dag_add(dag, axis[k].middle,
			dag_scale(dag, rat_neg(tau), axis[k].half));
	}
	return tau.num ? 2 : 1;
}

Span cell_span(Dag *dag, Ref start, Ref end)
{
	Span span;
	span.middle = dag_scale(dag, rat(1, 2), dag_add(dag, start, end));
	span.half = dag_scale(dag, rat(1, 2), dag_sub(dag, end, start));
	return span;
}

/* The integral of across(x) up(x, y) dx along the segment; coordinates relative to the cell. */
static Ref along(Dag *dag, Poly across, Poly up, Span x, Span y)
{
	Rat tau[LEGENDRE_MAX], weight[LEGENDRE_MAX];
	const int count = gauss_legendre(cells_nodes(across, up), tau, weight);
	Ref sum = NONE;
	for (int i = 0; i < count; ++i) {
		Ref point[2][2], both = NONE;
		const int values = cell_node(dag, x, y, tau[i], point);
		for (int k = 0; k < values; ++k) {
			Ref c = cell_value(dag, across, point[k][0], point[k][1]);
			Ref f = cell_value(dag, up, point[k][0], point[k][1]);
			both = dag_add(dag, both, dag_mul(dag, c, f));
		}
		sum = dag_add(dag, sum, dag_scale(dag, weight[i], both));
	}
	return dag_mul(dag, x.half, sum);
}

/* Where an edge that goes from `low` to `high` within a column crosses the knots of the rows, from
 * the left of the column on. */
static Ref *crossings(Dag *dag, const Cells *cells, Ref low, Ref high, Ref from, Ref to, Ref one)
{
	Ref *x = allocate((size_t)(cells->rows + 1) * sizeof *x), zero = dag_const(dag, rat(0, 1));
	Ref inverse = dag_div(dag, one, dag_sub(dag, high, low));
	Ref width = dag_sub(dag, to, from);
	for (int r = 0; r <= cells->rows; ++r) {
		Ref up = dag_sub(dag, dag_const(dag, cells->y[r]), low);
		Ref part = clamp(dag, dag_mul(dag, up, inverse), zero, one);
		Ref between = dag_add(dag, from, dag_mul(dag, part, width));
		x[r] = dag_choose(dag, dag_sub(dag, one, part), between, to);   /* exact at the end */
	}
	return x;
}

/* The integral of F dx over a column, from the left. */
static Ref column(Dag *dag, const Ordered *e, const Cells *cells, int q)
{
	Ref left = dag_const(dag, cells->x[q]), right = dag_const(dag, cells->x[q + 1]);
	Ref xl = clamp(dag, e->ax, left, right), xr = clamp(dag, e->bx, left, right);
	const Heights y = heights(dag, e, xl, xr, NONE);
	Ref rises = dag_sub(dag, y.right, y.left);       /* > 0: the left end is the lower one */
	Ref near = dag_sub(dag, xl, left), far = dag_sub(dag, xr, left), sum = NONE;
	Ref from = dag_choose(dag, rises, near, far), to = dag_choose(dag, rises, far, near);
	Ref lower = minimum(dag, y.left, y.right), upper = maximum(dag, y.left, y.right);
	const Ref *x = crossings(dag, cells, lower, upper, from, to, e->one);
	for (int r = 0; r < cells->rows; ++r) {
		const Poly up = cells_up(cells, q, r);
		Ref size = dag_const(dag, rat_sub(cells->y[r + 1], cells->y[r]));
		Ref base = dag_const(dag, cells->y[r]), zero = dag_const(dag, rat(0, 1));
		Ref low = clamp(dag, dag_sub(dag, lower, base), zero, size);
		Ref high = clamp(dag, dag_sub(dag, upper, base), zero, size);
		Span across = cell_span(dag, x[r], x[r + 1]), rising = cell_span(dag, low, high);
		if (up.count)
			sum = dag_add(dag, sum, along(dag, cells->across[q], up, across, rising));
	}
	const Poly above = poly_integral(cells->all[q], VAR_X);
	if (above.count) {
		Ref end = cell_value(dag, above, to, NONE);
		Ref start = cell_value(dag, above, x[cells->rows], NONE);
		sum = dag_add(dag, sum, dag_sub(dag, end, start));
	}
	if (sum == NONE)                       /* 0 in the whole column */
		return NONE;
	return dag_choose(dag, rises, sum, dag_scale(dag, rat(-1, 1), sum));
}

Dag *window_filter(const Filter *filter)
{
	const Cells cells = filter_cells(filter);
	Dag *dag = new_window(WINDOW_LINE, "gauss-legendre", rat(1, 1));
	const Ordered e = ordered(dag);
	Ref sum = NONE;
	for (int q = 0; q < cells.columns; ++q)
		if (cells.across[q].count)
			sum = dag_add(dag, sum, column(dag, &e, &cells, q));
	/* to the right: clockwise, negative */
	Ref sign = dag_choose(dag, e.run, dag_const(dag, rat(-1, 1)), dag_const(dag, rat(1, 1)));
	finish_window(dag, &e, sign, sum);
	return dag;
}

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
 * The ratios are at most 1 whatever happens on the way (0/0 included: MIN gives its second operand
 * for NaN), so nothing overflows, and what is wrong meets a width that is exactly 0.
 *
 * A rectangle of height H: the mean of the clamped heights l = clamp(lo), h = clamp(hi), m = (l+h)/2,
 * where t of d = hi - lo stick out above and r below, is m + (H - m) t/d - m r/d; t and r are 0 for
 * an edge that stays inside, and for d = 0.
 *
 * A filter: each column is cut where the edge crosses the knots of the rows. Between two of them F
 * is one polynomial, and the Gauss-Legendre rule that is exact for its degree along a line gives the
 * integral; above the support the integral over x is known. Ends of pieces are clamped to their
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
	e.ax = dag_name(dag, minimum(dag, x0, x1), "ax");
	e.bx = dag_name(dag, maximum(dag, x0, x1), "bx");
	e.ay = dag_name(dag, dag_choose(dag, e.run, y0, y1), "ay");
	e.by = dag_name(dag, dag_choose(dag, e.run, y1, y0), "by");
	e.rise = dag_name(dag, dag_sub(dag, e.by, e.ay), "rise");
	Ref length = dag_sub(dag, e.bx, e.ax);
	e.inverse = dag_name(dag, dag_div(dag, e.one, length), "inverse");
	return e;
}

/* Part of the way, at most 1. */
static Ref ratio(Dag *dag, const Ordered *e, Ref from, Ref to)
{
	Ref part = dag_mul(dag, dag_sub(dag, to, from), e->inverse);
	return minimum(dag, part, e->one);
}

/* Heights where the edge enters and leaves a column, above a line: lower and upper one. */
typedef struct { Ref left, right, low, high; } Heights;

static Heights heights(Dag *dag, const Ordered *e, Ref xl, Ref xr, Ref base)
{
	Ref ay = base == NONE ? e->ay : dag_sub(dag, e->ay, base);
	Ref by = base == NONE ? e->by : dag_sub(dag, e->by, base);
	Ref ahead = ratio(dag, e, e->ax, xl), behind = ratio(dag, e, xr, e->bx);
	Heights y;
	y.left = dag_add(dag, ay, dag_mul(dag, ahead, e->rise));
	y.right = dag_sub(dag, by, dag_mul(dag, behind, e->rise));
	y.low = minimum(dag, y.left, y.right);
	y.high = maximum(dag, y.left, y.right);
	return y;
}

static Dag *new_window(int window, const char *scheme)
{
	Dag *dag = dag_new(scheme);
	dag->window = window;
	dag->proof = PROOF_PIECES;
	finish_room(dag, 0);
	finish_next(dag, 0, 0, rat(1, 1));
	return dag;
}

/* width mean, or NaN where a coordinate is NaN or infinite, which clamps swallow. */
static void finish_window(Dag *dag, const Ordered *e, Ref width, Ref mean)
{
	Ref zero = dag_const(dag, rat(0, 1));
	Ref checked = dag_add(dag, mean, dag_mul(dag, e->rise, zero));
	Ref value = width == NONE ? checked : dag_mul(dag, width, checked);
	dag_accumulate(dag, dag_add(dag, value, dag_mul(dag, e->run, zero)));
}

/* ---- coverage ---- */

/* part / d, 0 if part is 0. */
static Ref share(Dag *dag, const Ordered *e, Ref part, Ref inverse)
{
	Ref most = minimum(dag, dag_mul(dag, part, inverse), e->one);
	return dag_choose(dag, part, most, dag_const(dag, rat(0, 1)));
}

static Ref mean_height(Dag *dag, const Ordered *e, Heights y, Ref height)
{
	Ref zero = dag_const(dag, rat(0, 1));
	Ref l = clamp(dag, y.low, zero, height), h = clamp(dag, y.high, zero, height);
	Ref m = dag_name(dag, dag_scale(dag, rat(1, 2), dag_add(dag, l, h)), "middle");
	Ref d = dag_sub(dag, y.high, y.low);
	Ref inverse = dag_div(dag, e->one, d);
	Ref top_high = maximum(dag, y.high, height), top_low = maximum(dag, y.low, height);
	Ref above = dag_name(dag, dag_sub(dag, top_high, top_low), "above");
	Ref bottom_high = minimum(dag, y.high, zero), bottom_low = minimum(dag, y.low, zero);
	Ref below = dag_name(dag, dag_sub(dag, bottom_high, bottom_low), "below");
	Ref more = share(dag, e, above, inverse), less = share(dag, e, below, inverse);
	Ref raised = dag_mul(dag, dag_sub(dag, height, m), more);
	Ref lowered = dag_mul(dag, m, less);
	return dag_name(dag, dag_sub(dag, dag_add(dag, m, raised), lowered), "mean");
}

Dag *window_coverage(void)
{
	Dag *dag = new_window(WINDOW_CELL, "clamped");
	const Ordered e = ordered(dag);
	Ref u0 = dag_var(dag, VAR_X2), u1 = dag_var(dag, VAR_X3);
	Ref v0 = dag_var(dag, VAR_Y2), v1 = dag_var(dag, VAR_Y3);
	Ref start = clamp(dag, dag_var(dag, VAR_X0), u0, u1);
	Ref end = clamp(dag, dag_var(dag, VAR_X1), u0, u1);
	Ref xl = minimum(dag, start, end), xr = maximum(dag, start, end);
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
static Ref *crossings(Dag *dag, const Cells *cells, Heights y, Ref from, Ref to, Ref one)
{
	Ref *x = allocate((size_t)(cells->rows + 1) * sizeof *x), zero = dag_const(dag, rat(0, 1));
	Ref inverse = dag_div(dag, one, dag_sub(dag, y.high, y.low));
	Ref width = dag_sub(dag, to, from);
	for (int r = 0; r <= cells->rows; ++r) {
		Ref up = dag_sub(dag, dag_const(dag, cells->y[r]), y.low);
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
	const Ref *x = crossings(dag, cells, y, from, to, e->one);
	for (int r = 0; r < cells->rows; ++r) {
		const Poly up = cells_up(cells, q, r);
		Ref size = dag_const(dag, rat_sub(cells->y[r + 1], cells->y[r]));
		Ref base = dag_const(dag, cells->y[r]), zero = dag_const(dag, rat(0, 1));
		Ref low = clamp(dag, dag_sub(dag, y.low, base), zero, size);
		Ref high = clamp(dag, dag_sub(dag, y.high, base), zero, size);
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
	Dag *dag = new_window(WINDOW_LINE, "gauss-legendre");
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

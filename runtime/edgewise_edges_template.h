/* edgewise_edges_template.h - edges one by one: moments of every kind of edge, paths, distance and
 * the closure sum; included by edgewise_rings.c once per precision.
 *
 * The edges of a path are sorted by kind: of each kind up to EW_EDGES are kept, as pointers to
 * their control points, which mostly lie in the path one behind the other, so that nothing depends
 * on a guess which kind comes next. Then control point v of edge i goes to x[v][i], y[v][i], the
 * weight of a conic to x[3][i], and the kernels of rings run over them with reach EW_EDGES. Edge i
 * of its kind goes to lane i mod L, and at the end lanes are added by halving and kinds in the
 * order line, quad, conic, cubic: results do not depend on the target. Float lanes are flushed to
 * double after every EW_EDGES edges.
 *
 * A conic is its chord and the cap beyond it. The kernels of caps hold for 0 <= w <= 3 (area: for
 * every w > -1); other arcs are halved first, and what is beyond EW_SHARP is its control polygon.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

#ifdef EW_MAX_CURVE_DEGREE
typedef struct {
	int degree;
	unsigned used;
	double bad;                            /* 0, or NaN: a weight without an area */
	size_t count[EW_KINDS];
	const EW_REAL *edge[EW_KINDS][EW_EDGES];       /* control points, x and y alternating */
	EW_REAL weight[EW_EDGES];                      /* of conics */
	EW_REAL own[EW_KINDS][EW_EDGES][8];            /* of edges that do not lie in the path */
	EW_ALIGNED EW_REAL sum[EW_KINDS][EW_MAX_ACCUMULATORS * EW_WIDTH];
#if EW_IS_FLOAT
	double wide[EW_KINDS][EW_MAX_ACCUMULATORS * EW_WIDTH];
#endif
} EW_LOCAL(edges);

static void EW_LOCAL(begin_edges)(EW_LOCAL(edges) *e, int degree)
{
	e->degree = degree;
	e->used = ew_cpu_target();
	e->bad = 0;
	for (int kind = 0; kind < EW_KINDS; ++kind)
		e->count[kind] = 0;
}

/* Control point v of edge i to x[v * EW_EDGES + i], y[v * EW_EDGES + i]. */
EW_INLINE void EW_LOCAL(spread)(const EW_REAL *const *edge, int points, size_t count, EW_REAL *x,
	EW_REAL *y)
{
#define EW_PUT(v) \
	x[(v) * EW_EDGES + i] = edge[i][2 * (v)]; \
	y[(v) * EW_EDGES + i] = edge[i][2 * (v) + 1];
	for (size_t i = 0; i < count; ++i) {
		EW_PUT(0)
		EW_PUT(1)
		if (points > 2) {
			EW_PUT(2)
		}
		if (points > 3) {
			EW_PUT(3)
		}
	}
#undef EW_PUT
}

/* Runs over the edges of a kind that have been kept. */
static void EW_LOCAL(run_edges)(EW_LOCAL(edges) *e, int kind)
{
	const int id = ew_ring_kind(kind, e->degree);
	const size_t cells = (size_t)ew_ring_shapes[id].accumulators * EW_WIDTH;
	const size_t rest = (e->count[kind] - 1) % EW_EDGES + 1;
	EW_ALIGNED EW_REAL x[4 * EW_EDGES];
	EW_ALIGNED EW_REAL y[4 * EW_EDGES];
	EW_REAL *sum = e->sum[kind];
	if (kind == EW_KIND_LINE)
		EW_LOCAL(spread)(e->edge[kind], 2, rest, x, y);
	else if (kind == EW_KIND_CUBIC)
		EW_LOCAL(spread)(e->edge[kind], 4, rest, x, y);
	else
		EW_LOCAL(spread)(e->edge[kind], 3, rest, x, y);
	if (kind == EW_KIND_CONIC)
		memcpy(x + 3 * EW_EDGES, e->weight, rest * sizeof *x);
	if (EW_IS_FLOAT || e->count[kind] <= EW_EDGES)
		EW_LOCAL(by_columns)(e->used)->clear(sum, cells);
	EW_LOCAL(kernel)(id, e->used)(x, y, x, EW_EDGES, EW_WIDTH, rest, sum);
#if EW_IS_FLOAT
	if (e->count[kind] <= EW_EDGES)
		for (size_t i = 0; i < cells; ++i)
			e->wide[kind][i] = (double)sum[i] + 0;
	else
		for (size_t i = 0; i < cells; ++i)
			e->wide[kind][i] += (double)sum[i];
#endif
}

/* Control points that stay where they are until the end. */
EW_INLINE void EW_LOCAL(add_edge)(EW_LOCAL(edges) *e, int kind, const EW_REAL *point)
{
	const size_t count = ++e->count[kind];
	e->edge[kind][(count - 1) % EW_EDGES] = point;
	if (count % EW_EDGES == 0)
		EW_LOCAL(run_edges)(e, kind);
}

/* Control points of which a copy is kept: the first one apart from the others. */
static void EW_LOCAL(add_copy)(EW_LOCAL(edges) *e, int kind, const EW_REAL *first,
	const EW_REAL *others, size_t points)
{
	EW_REAL *own = e->own[kind][e->count[kind] % EW_EDGES];
	own[0] = first[0];
	own[1] = first[1];
	memcpy(own + 2, others, 2 * (points - 1) * sizeof *own);
	EW_LOCAL(add_edge)(e, kind, own);
}

static void EW_LOCAL(add_line)(EW_LOCAL(edges) *e, const EW_REAL *from, const EW_REAL *to)
{
	EW_LOCAL(add_copy)(e, EW_KIND_LINE, from, to, 2);
}

/* The lanes of an accumulator, added by halving. */
static double EW_LOCAL(tree)(const double *lane)
{
	double a[EW_WIDTH / 2];
	for (int l = 0; l < EW_WIDTH / 2; ++l)
		a[l] = lane[l] + lane[l + EW_WIDTH / 2];
#if EW_IS_FLOAT
	for (int l = 0; l < 4; ++l)
		a[l] += a[l + 4];
#endif
	return (a[0] + a[2]) + (a[1] + a[3]);
}

/* out[0 .. EW_MOMENTS(degree) - 1] = sums over all kinds. */
static void EW_LOCAL(end_edges)(EW_LOCAL(edges) *e, double *out)
{
	double total[EW_MAX_ACCUMULATORS], result[EW_MAX_OUTPUTS];
	for (int j = 0; j < EW_MOMENTS(e->degree); ++j)
		out[j] = e->bad;
	for (int kind = 0; kind < EW_KINDS; ++kind) {
		if (e->count[kind] == 0)
			continue;
		const ew_ring_shape *shape = &ew_ring_shapes[ew_ring_kind(kind, e->degree)];
		if (e->count[kind] % EW_EDGES)
			EW_LOCAL(run_edges)(e, kind);
		for (int k = 0; k < shape->accumulators; ++k)
#if EW_IS_FLOAT
			total[k] = EW_LOCAL(tree)(e->wide[kind] + k * EW_WIDTH);
#else
			total[k] = EW_LOCAL(tree)(e->sum[kind] + k * EW_WIDTH);
#endif
		shape->finish(total, result, 1);
		for (int j = 0; j < EW_MOMENTS(e->degree); ++j)
			out[j] += result[j];
	}
}

static int EW_LOCAL(edges_result)(EW_LOCAL(edges) *e, EW_REAL *out)
{
	double result[EW_MAX_OUTPUTS];
	EW_LOCAL(end_edges)(e, result);
	for (int j = 0; j < EW_MOMENTS(e->degree); ++j)
		out[j] = (EW_REAL)result[j];
	return EW_OK;
}

static int EW_LOCAL(one_edge)(int degree, int kind, const EW_REAL *point, EW_REAL *out)
{
	EW_LOCAL(edges) e;
	if (degree < 0 || degree > EW_MAX_CURVE_DEGREE)
		return EW_BAD_DEGREE;
	EW_LOCAL(begin_edges)(&e, degree);
	EW_LOCAL(add_edge)(&e, kind, point);
	return EW_LOCAL(edges_result)(&e, out);
}

int EW_NAME(line_moments)(int degree, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL *out)
{
	const EW_REAL point[] = { x0, y0, x1, y1 };
	return EW_LOCAL(one_edge)(degree, EW_KIND_LINE, point, out);
}

#ifdef EW_HAS_QUADS
int EW_NAME(quad_moments)(int degree, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL x2,
	EW_REAL y2, EW_REAL *out)
{
	const EW_REAL point[] = { x0, y0, x1, y1, x2, y2 };
	return EW_LOCAL(one_edge)(degree, EW_KIND_QUAD, point, out);
}
#endif

#ifdef EW_HAS_CUBICS
int EW_NAME(cubic_moments)(int degree, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL x2,
	EW_REAL y2, EW_REAL x3, EW_REAL y3, EW_REAL *out)
{
	const EW_REAL point[] = { x0, y0, x1, y1, x2, y2, x3, y3 };
	return EW_LOCAL(one_edge)(degree, EW_KIND_CUBIC, point, out);
}
#endif

#ifdef EW_HAS_CONICS
static void EW_LOCAL(add_conic)(EW_LOCAL(edges) *e, const EW_REAL *point, EW_REAL w);

/* (p + w p1) / (1 + w), a control point of a half; where w is near -1 all cancels but p - p1. */
static EW_REAL EW_LOCAL(halfway)(EW_REAL p, EW_REAL p1, EW_REAL w)
{
	return w > (EW_REAL)-0.5 ? (p + w * p1) / (1 + w) : p1 + (p - p1) / (1 + w);
}

/* The two halves, t = 1/2, of a conic with w > -1: their weight is sqrt((1 + w)/2). */
static void EW_LOCAL(add_halves)(EW_LOCAL(edges) *e, const EW_REAL *p, EW_REAL w)
{
	EW_REAL left[6], right[6];
	for (int axis = 0; axis < 2; ++axis) {
		left[axis] = p[axis];
		left[2 + axis] = EW_LOCAL(halfway)(p[axis], p[2 + axis], w);
		right[2 + axis] = EW_LOCAL(halfway)(p[4 + axis], p[2 + axis], w);
		left[4 + axis] = right[axis] = (left[2 + axis] + right[2 + axis]) / 2;
		right[4 + axis] = p[4 + axis];
	}
	w = (EW_REAL)sqrt((1 + (double)w) / 2);
	EW_LOCAL(add_conic)(e, left, w);
	EW_LOCAL(add_conic)(e, right, w);
}

static void EW_LOCAL(add_conic)(EW_LOCAL(edges) *e, const EW_REAL *point, EW_REAL w)
{
	const int is_point = point[0] == point[2] && point[2] == point[4] && point[1] == point[3]
		&& point[3] == point[5];
	if (!(w > -1)) {
		e->bad = (double)NAN;
	} else if (is_point) {                  /* halves would differ from it by a rounding */
		EW_LOCAL(add_line)(e, point, point);
	} else if (w > (EW_REAL)EW_SHARP) {
		EW_LOCAL(add_line)(e, point, point + 2);
		EW_LOCAL(add_line)(e, point + 2, point + 4);
	} else if (e->degree > 0 && (w < 0 || w > 3)) {
		EW_LOCAL(add_halves)(e, point, w);
	} else {
		EW_LOCAL(add_line)(e, point, point + 4);
		e->weight[e->count[EW_KIND_CONIC] % EW_EDGES] = w;
		EW_LOCAL(add_copy)(e, EW_KIND_CONIC, point, point + 2, 3);
	}
}

int EW_NAME(conic_moments)(int degree, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL x2,
	EW_REAL y2, EW_REAL w, EW_REAL *out)
{
	const EW_REAL point[] = { x0, y0, x1, y1, x2, y2 };
	EW_LOCAL(edges) e;
	if (degree < 0 || degree > EW_MAX_CURVE_DEGREE)
		return EW_BAD_DEGREE;
	EW_LOCAL(begin_edges)(&e, degree);
	EW_LOCAL(add_conic)(&e, point, w);
	return EW_LOCAL(edges_result)(&e, out);
}

EW_REAL EW_NAME(conic_area)(EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL x2, EW_REAL y2,
	EW_REAL w)
{
	EW_REAL area;
	EW_NAME(conic_moments)(0, x0, y0, x1, y1, x2, y2, w, &area);
	return area;
}
#endif

/* The line that closes a contour, unless it is closed. */
static void EW_LOCAL(add_closing)(EW_LOCAL(edges) *e, const EW_REAL *from, const EW_REAL *start)
{
	if (!(from[0] == start[0] && from[1] == start[1]))
		EW_LOCAL(add_line)(e, from, start);
}

/* An edge from `here` to the points at `next`, which mostly follow it. */
EW_INLINE void EW_LOCAL(add_drawn)(EW_LOCAL(edges) *e, int verb, const EW_REAL *here,
	const EW_REAL *next, const EW_REAL *weight)
{
	(void)weight;
#ifdef EW_HAS_CONICS
	if (verb == EW_CONIC) {
		const EW_REAL point[] = { here[0], here[1], next[0], next[1], next[2], next[3] };
		EW_LOCAL(add_conic)(e, point, *weight);
		return;
	}
#endif
	if (next == here + 2)
		EW_LOCAL(add_edge)(e, ew_path_kinds[verb], here);
	else
		EW_LOCAL(add_copy)(e, ew_path_kinds[verb], here, next, ew_path_points(verb) + 1);
}

#define EW_READ EW_LOCAL(add_path)
#define EW_READER EW_LOCAL(edges)
#define EW_READ_HAS ew_path_has
#define EW_READ_EDGE EW_LOCAL(add_drawn)
#define EW_READ_CLOSING EW_LOCAL(add_closing)
#include "edgewise_path_template.h"

int EW_NAME(path_moments)(int degree, const unsigned char *verbs, size_t verb_count,
	const EW_REAL *points, size_t point_count, const EW_REAL *weights, size_t weight_count,
	EW_REAL *out)
{
	EW_LOCAL(edges) e;
	if (degree < 0 || degree > EW_MAX_CURVE_DEGREE)
		return EW_BAD_DEGREE;
	if ((verb_count && !verbs) || (point_count && !points) || (weight_count && !weights)
	    || (verb_count && verbs[0] != EW_MOVE))
		return EW_BAD_PATH;
	EW_LOCAL(begin_edges)(&e, degree);
	if (!EW_LOCAL(add_path)(&e, verbs, verb_count, points, point_count, weights, weight_count))
		return EW_BAD_PATH;
	return EW_LOCAL(edges_result)(&e, out);
}
#endif

#if defined(EW_HAS_DISTANCE) || defined(EW_HAS_CLOSURE) || defined(EW_HAS_COVERAGE) \
	|| defined(EW_HAS_FILTERS)
/* A single edge through a kernel of line edges. */
static EW_REAL EW_LOCAL(edge_about)(int id, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1,
	const EW_REAL *origin)
{
	const EW_REAL x[] = { x0, x1 }, y[] = { y0, y1 };
	EW_REAL sum[EW_WIDTH] = { 0 };
	double total, value;
	EW_LOCAL(kernel)(id, ew_ring_scalar(ew_cpu_target()))(x, y, origin, 1, 1, 1, sum);
	total = (double)sum[0];
	ew_ring_shapes[id].finish(&total, &value, 1);
	return (EW_REAL)value;
}
#endif

#if defined(EW_HAS_DISTANCE) || defined(EW_HAS_CLOSURE)
static EW_REAL EW_LOCAL(edge_value)(int id, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1)
{
	return EW_LOCAL(edge_about)(id, x0, y0, x1, y1, &x0);
}
#endif

#ifdef EW_HAS_DISTANCE
/* What was found in coordinates times `scale`, a power of two, in the original ones. */
static double EW_LOCAL(unscaled)(int k, EW_REAL scale, double value)
{
	for (int i = 0; i < k + 2; ++i)
		value /= (double)scale;
	return value;
}

/* Powers of the distance can overflow on the way to a result that does not, and 0 inf is NaN:
 * then once more on scaled coordinates. */
EW_REAL EW_NAME(line_radius)(int k, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1)
{
	const int id = ew_ring_of_radius(k);
	const EW_REAL x[] = { x0, x1 }, y[] = { y0, y1 };
	EW_REAL value, scale;
	if (id < 0)
		return (EW_REAL)NAN;
	value = EW_LOCAL(edge_value)(id, x0, y0, x1, y1);
	if (value - value != 0) {
		EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, 2);
		scale = EW_LOCAL(unit_scale)(&v);
		if (scale != 0)
			value = (EW_REAL)EW_LOCAL(unscaled)(k, scale, (double)EW_LOCAL(edge_value)(id,
				x0 * scale, y0 * scale, x1 * scale, y1 * scale));
	}
	return value;
}

EW_REAL EW_NAME(line_distance)(EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1)
{
	return EW_NAME(line_radius)(1, x0, y0, x1, y1);
}

EW_REAL EW_NAME(radius)(int k, const EW_REAL *x, const EW_REAL *y, size_t n, EW_REAL cx, EW_REAL cy)
{
	const int id = ew_ring_of_radius(k);
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, n);
	double out[1];
	if (id < 0)
		return (EW_REAL)NAN;
	v.moved = !(cx == 0 && cy == 0);
	v.cx = cx;
	v.cy = cy;
	EW_LOCAL(integrate)(id, &v, out);
	if (out[0] - out[0] != 0) {
		const EW_REAL scale = EW_LOCAL(unit_scale)(&v);
		if (scale != 0) {
			v.moved = 1;
			v.scale = scale;
			EW_LOCAL(integrate)(id, &v, out);
			out[0] = EW_LOCAL(unscaled)(k, scale, out[0]);
		}
	}
	return (EW_REAL)out[0];
}

EW_REAL EW_NAME(distance)(const EW_REAL *x, const EW_REAL *y, size_t n, EW_REAL cx, EW_REAL cy)
{
	return EW_NAME(radius)(1, x, y, n, cx, cy);
}
#endif

#ifdef EW_HAS_CLOSURE
EW_REAL EW_NAME(line_closure)(EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL px,
	EW_REAL py)
{
	return EW_LOCAL(edge_value)(EW_RING_CLOSURE, x0 - px, y0 - py, x1 - px, y1 - py);
}

EW_REAL EW_NAME(closure)(const EW_REAL *x0, const EW_REAL *y0, const EW_REAL *x1, const EW_REAL *y1,
	size_t edges, EW_REAL px, EW_REAL py)
{
	const unsigned used = ew_cpu_target();
	const EW_LOCAL(columns) *by = EW_LOCAL(by_columns)(used);
	EW_RUN *run = EW_LOCAL(kernel)(EW_RING_CLOSURE, used);
	EW_ALIGNED EW_REAL x[2][EW_STAGE], y[2][EW_STAGE], sum[EW_WIDTH];
	double wide[EW_WIDTH] = { 0 };
	for (size_t start = 0; start < edges; start += EW_STAGE) {
		const size_t count = edges - start < EW_STAGE ? edges - start : (size_t)EW_STAGE;
		by->move(x0 + start, 1, px, count, x[0]);
		by->move(y0 + start, 1, py, count, y[0]);
		by->move(x1 + start, 1, px, count, x[1]);
		by->move(y1 + start, 1, py, count, y[1]);
		by->clear(sum, EW_WIDTH);
		run(x[0], y[0], x[0], EW_STAGE, EW_WIDTH, count, sum);
		for (int l = 0; l < EW_WIDTH; ++l)
			wide[l] += (double)sum[l];
	}
	for (int half = EW_WIDTH / 2; half > 0; half /= 2)
		for (int l = 0; l < half; ++l)
			wide[l] += wide[l + half];
	return (EW_REAL)wide[0];
}
#endif

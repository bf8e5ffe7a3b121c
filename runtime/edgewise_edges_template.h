/* edgewise_edges_template.h - edges one by one: moments of every kind of edge, paths, distance and
 * the closure sum; included by edgewise_rings.c once per precision.
 *
 * The edges of a path are gathered by kind: control point v of edge i of a kind goes to x[v][i],
 * y[v][i], the weight of a conic to x[3][i], so that the kernels of rings run over them with
 * reach EW_EDGES. Edge i of its kind goes to lane i mod L, and at the end lanes are added by
 * halving and kinds in the order line, quad, conic, cubic: results do not depend on the target.
 * Float lanes are flushed to double after every EW_EDGES edges.
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
	EW_REAL x[EW_KINDS][4][EW_EDGES], y[EW_KINDS][4][EW_EDGES];
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

/* Runs over the edges of a kind that have been gathered. */
static void EW_LOCAL(run_edges)(EW_LOCAL(edges) *e, int kind)
{
	const int id = ew_ring_kind(kind, e->degree);
	const size_t cells = (size_t)ew_ring_shapes[id].accumulators * EW_WIDTH;
	const size_t rest = (e->count[kind] - 1) % EW_EDGES + 1;
	EW_REAL *sum = e->sum[kind];
	if (EW_IS_FLOAT || e->count[kind] <= EW_EDGES)
		EW_LOCAL(by_columns)(e->used)->clear(sum, cells);
	EW_LOCAL(kernel)(id, e->used)(e->x[kind][0], e->y[kind][0], e->x[kind][0], EW_EDGES, EW_WIDTH,
		rest, sum);
#if EW_IS_FLOAT
	for (size_t i = 0; i < cells; ++i)
		e->wide[kind][i] = (double)sum[i] + (e->count[kind] > EW_EDGES ? e->wide[kind][i] : 0);
#endif
}

/* point: x and y of so many control points, alternating. */
static void EW_LOCAL(add_edge)(EW_LOCAL(edges) *e, int kind, const EW_REAL *point, int points,
	EW_REAL weight)
{
	const size_t i = e->count[kind]++ % EW_EDGES;
	for (int v = 0; v < points; ++v) {
		e->x[kind][v][i] = point[2 * v];
		e->y[kind][v][i] = point[2 * v + 1];
	}
	if (kind == EW_KIND_CONIC)
		e->x[kind][3][i] = weight;
	if (i + 1 == EW_EDGES)
		EW_LOCAL(run_edges)(e, kind);
}

static void EW_LOCAL(add_line)(EW_LOCAL(edges) *e, const EW_REAL *from, const EW_REAL *to)
{
	const EW_REAL point[4] = { from[0], from[1], to[0], to[1] };
	EW_LOCAL(add_edge)(e, EW_KIND_LINE, point, 2, 0);
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
		for (int k = 0; k < shape->accumulators; ++k) {
#if EW_IS_FLOAT
			double *lane = e->wide[kind] + k * EW_WIDTH;
#else
			double *lane = e->sum[kind] + k * EW_WIDTH;
#endif
			for (int half = EW_WIDTH / 2; half > 0; half /= 2)
				for (int l = 0; l < half; ++l)
					lane[l] += lane[l + half];
			total[k] = lane[0];
		}
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

static int EW_LOCAL(one_edge)(int degree, int kind, const EW_REAL *point, int points, EW_REAL *out)
{
	EW_LOCAL(edges) e;
	if (degree < 0 || degree > EW_MAX_CURVE_DEGREE)
		return EW_BAD_DEGREE;
	EW_LOCAL(begin_edges)(&e, degree);
	EW_LOCAL(add_edge)(&e, kind, point, points, 0);
	return EW_LOCAL(edges_result)(&e, out);
}

int EW_NAME(line_moments)(int degree, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL *out)
{
	const EW_REAL point[] = { x0, y0, x1, y1 };
	return EW_LOCAL(one_edge)(degree, EW_KIND_LINE, point, 2, out);
}

#ifdef EW_HAS_QUADS
int EW_NAME(quad_moments)(int degree, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL x2,
	EW_REAL y2, EW_REAL *out)
{
	const EW_REAL point[] = { x0, y0, x1, y1, x2, y2 };
	return EW_LOCAL(one_edge)(degree, EW_KIND_QUAD, point, 3, out);
}
#endif

#ifdef EW_HAS_CUBICS
int EW_NAME(cubic_moments)(int degree, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL x2,
	EW_REAL y2, EW_REAL x3, EW_REAL y3, EW_REAL *out)
{
	const EW_REAL point[] = { x0, y0, x1, y1, x2, y2, x3, y3 };
	return EW_LOCAL(one_edge)(degree, EW_KIND_CUBIC, point, 4, out);
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
		EW_LOCAL(add_edge)(e, EW_KIND_CONIC, point, 3, w);
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

/* Do the verbs take exactly these points and weights, and does a contour begin with a move? */
static int EW_LOCAL(is_path)(const unsigned char *verbs, size_t verb_count, const EW_REAL *points,
	size_t point_count, const EW_REAL *weights, size_t weight_count)
{
	if ((verb_count && !verbs) || (point_count && !points) || (weight_count && !weights)
	    || (verb_count && verbs[0] != EW_MOVE))
		return 0;
	for (size_t i = 0; i < verb_count; ++i) {
		if (!ew_path_has(verbs[i]) || ew_path_points[verbs[i]] > point_count
		    || (verbs[i] == EW_CONIC && weight_count == 0))
			return 0;
		point_count -= ew_path_points[verbs[i]];
		weight_count -= verbs[i] == EW_CONIC;
	}
	return point_count == 0 && weight_count == 0;
}

/* The line that closes a contour, unless it is closed. */
static void EW_LOCAL(add_closing)(EW_LOCAL(edges) *e, const EW_REAL *from, const EW_REAL *start)
{
	if (!(from[0] == start[0] && from[1] == start[1]))
		EW_LOCAL(add_line)(e, from, start);
}

static void EW_LOCAL(add_path)(EW_LOCAL(edges) *e, const unsigned char *verbs, size_t verb_count,
	const EW_REAL *points, const EW_REAL *weights)
{
	EW_REAL start[2] = { 0, 0 }, point[8] = { 0 };    /* of the contour; from where we are */
	(void)weights;
	for (size_t i = 0; i < verb_count; ++i) {
		const int verb = verbs[i], taken = (int)ew_path_points[verb];
		for (int k = 0; k < 2 * taken; ++k)
			point[2 + k] = *points++;
		if (verb == EW_MOVE || verb == EW_CLOSE)
			EW_LOCAL(add_closing)(e, point, start);
#ifdef EW_HAS_CONICS
		else if (verb == EW_CONIC)
			EW_LOCAL(add_conic)(e, point, *weights++);
#endif
		else
			EW_LOCAL(add_edge)(e, ew_path_kinds[verb], point, taken + 1, 0);
		if (verb == EW_MOVE) {
			start[0] = point[2];
			start[1] = point[3];
		}
		point[0] = taken ? point[2 * taken] : start[0];
		point[1] = taken ? point[2 * taken + 1] : start[1];
	}
	EW_LOCAL(add_closing)(e, point, start);
}

int EW_NAME(path_moments)(int degree, const unsigned char *verbs, size_t verb_count,
	const EW_REAL *points, size_t point_count, const EW_REAL *weights, size_t weight_count,
	EW_REAL *out)
{
	EW_LOCAL(edges) e;
	if (degree < 0 || degree > EW_MAX_CURVE_DEGREE)
		return EW_BAD_DEGREE;
	if (!EW_LOCAL(is_path)(verbs, verb_count, points, point_count, weights, weight_count))
		return EW_BAD_PATH;
	EW_LOCAL(begin_edges)(&e, degree);
	EW_LOCAL(add_path)(&e, verbs, verb_count, points, weights);
	return EW_LOCAL(edges_result)(&e, out);
}
#endif

#if defined(EW_HAS_DISTANCE) || defined(EW_HAS_CLOSURE)
/* A single edge through a kernel of line edges. */
static EW_REAL EW_LOCAL(edge_value)(int id, EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1)
{
	const EW_REAL x[] = { x0, x1 }, y[] = { y0, y1 };
	EW_REAL sum[EW_WIDTH] = { 0 };
	double total, value;
	EW_LOCAL(kernel)(id, ew_ring_scalar(ew_cpu_target()))(x, y, x, 1, 1, 1, sum);
	total = (double)sum[0];
	ew_ring_shapes[id].finish(&total, &value, 1);
	return (EW_REAL)value;
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

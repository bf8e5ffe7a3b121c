/* edgewise_rings_template.h - the ring driver, included by edgewise_rings.c once per precision.
 *
 * The items of a ring (its edges, or for the vertex form all vertices but the first) are numbered
 * from 0; item i goes to lane i mod L, and where a ring has two turns, to accumulator set
 * i / L mod 2. L is 1 for rings of fewer than EW_SHORT vertices, not counting a last vertex that is
 * the first one again, else EW_WIDTH. Kernels run on the
 * user's arrays as long as an item does not reach past the last vertex; the rest, and everything
 * if the vertices must be moved or taken apart, goes through a small buffer, beginning at a
 * multiple of L times turns, so that this does not change the result. Float lanes are flushed to
 * double after every EW_BLOCK items. At the end lanes are added by halving: lane l and lane
 * l + L/2, then l and l + L/4, and so on.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

typedef struct {
	const EW_REAL *x, *y;
	size_t stride, n;
	unsigned target;               /* looked up once per call */
	const EW_LOCAL(columns) *by;
	int moved;                     /* vertex = (((x, y) - (cx, cy)) - (dx, dy)) scale */
	EW_REAL cx, cy, dx, dy, scale;
	const EW_REAL *constants;      /* of a rectangle; else NULL */
} EW_LOCAL(vertices);

static EW_RUN *EW_LOCAL(kernel)(int id, unsigned used)
{
#define EW_ROW(id, kernel, f, a) kernel,
#define EW_TABLE(TARGET, target, doubles) \
	static EW_RUN *const target[] = { EW_LIST(TARGET)(EW_ROW) };
#define EW_CASE(TARGET, target, doubles) case EW_##TARGET: return target[id];
	EW_TARGETS(EW_TABLE)
	switch (used) {
	EW_TARGETS(EW_CASE)
	default: return NULL;          /* no such target is ever in use */
	}
#undef EW_ROW
#undef EW_TABLE
#undef EW_CASE
}

#if defined(EW_HAS_INTEGRANDS) || defined(EW_HAS_DISTANCE) || defined(EW_HAS_COVERAGE) \
	|| defined(EW_HAS_FILTERS)
static EW_REAL EW_LOCAL(vertex_x)(const EW_LOCAL(vertices) *v, size_t i)
{
	EW_REAL x = v->x[i * v->stride];
	return v->moved ? ((x - v->cx) - v->dx) * v->scale : x;
}

static EW_REAL EW_LOCAL(vertex_y)(const EW_LOCAL(vertices) *v, size_t i)
{
	EW_REAL y = v->y[i * v->stride];
	return v->moved ? ((y - v->cy) - v->dy) * v->scale : y;
}

/* Vertices start .. start+count-1, moved; after the last vertex the ring begins again. */
static void EW_LOCAL(stage)(const EW_LOCAL(vertices) *v, size_t start, size_t count,
	EW_REAL *x, EW_REAL *y)
{
	size_t whole = start < v->n ? v->n - start : 0;
	whole = whole < count ? whole : count;
	v->by->move(v->x + start * v->stride, v->stride, v->cx, whole, x);
	v->by->move(v->y + start * v->stride, v->stride, v->cy, whole, y);
	if (v->dx != 0 || v->dy != 0 || v->scale != 1)
		for (size_t k = 0; k < whole; ++k) {
			x[k] = (x[k] - v->dx) * v->scale;
			y[k] = (y[k] - v->dy) * v->scale;
		}
	for (size_t k = whole; k < count; ++k) {
		x[k] = EW_LOCAL(vertex_x)(v, start + k - v->n);
		y[k] = EW_LOCAL(vertex_y)(v, start + k - v->n);
	}
}

/* Items start .. end-1, through a buffer; the ring closes by itself. */
static void EW_LOCAL(run_staged)(EW_RUN *run, const EW_LOCAL(vertices) *v, int window,
	const EW_REAL *origin, size_t start, size_t end, EW_REAL *sum)
{
	EW_ALIGNED EW_REAL x[EW_STAGE + 2];
	EW_ALIGNED EW_REAL y[EW_STAGE + 2];
	while (start < end) {
		size_t items = end - start < EW_STAGE ? end - start : (size_t)EW_STAGE;
		EW_LOCAL(stage)(v, start, items + (size_t)window - 1, x, y);
		run(x, y, origin, 1, EW_WIDTH, items, sum);
		start += items;
	}
}

/* A short ring: all items in lane 0, by a scalar kernel, since vectors would be left empty. */
static void EW_LOCAL(run_short)(int id, const EW_LOCAL(vertices) *v, const EW_REAL *origin,
	double *wide)
{
	const ew_ring_shape *shape = &ew_ring_shapes[id];
	EW_RUN *run = EW_LOCAL(kernel)(id, ew_ring_scalar(v->target));
	EW_REAL x[EW_SHORT + 2], y[EW_SHORT + 2];
	EW_ALIGNED EW_REAL sum[EW_MAX_ACCUMULATORS * EW_WIDTH];
	v->by->clear(sum, (size_t)shape->accumulators * EW_WIDTH);
	EW_LOCAL(stage)(v, 0, v->n + 1, x, y);
	run(x, y, origin, 1, 1, v->n + 2 - (size_t)shape->window, sum);
	for (int k = 0; k < shape->accumulators; ++k)
		wide[k * EW_WIDTH] = (double)sum[k * EW_WIDTH];
}

/* A long ring. */
static void EW_LOCAL(run_lanes)(int id, const EW_LOCAL(vertices) *v, const EW_REAL *origin,
	double *wide)
{
	const ew_ring_shape *shape = &ew_ring_shapes[id];
	EW_RUN *run = EW_LOCAL(kernel)(id, v->target);
	const size_t cells = (size_t)shape->accumulators * EW_WIDTH;
	const size_t reach = (size_t)shape->window - 1, items = v->n + 1 - reach;
	const size_t step = (size_t)shape->turns * EW_WIDTH;
	const size_t direct = v->moved || v->stride != 1 ? 0 : (v->n - reach) / step * step;
#if EW_IS_FLOAT
	EW_ALIGNED EW_REAL sum[EW_MAX_ACCUMULATORS * EW_WIDTH];
	memset(wide, 0, cells * sizeof *wide);
#else
	double *const sum = wide;
#endif
	v->by->clear(sum, cells);
	for (size_t start = 0; start < items; start += EW_BLOCK) {
		size_t end = items - start < EW_BLOCK ? items : start + (size_t)EW_BLOCK;
		size_t middle = direct < start ? start : direct < end ? direct : end;
		if (middle > start)
			run(v->x + start, v->y + start, origin, 1, EW_WIDTH, middle - start, sum);
		EW_LOCAL(run_staged)(run, v, shape->window, origin, middle, end, sum);
#if EW_IS_FLOAT
		for (size_t i = 0; i < cells; ++i)
			wide[i] += (double)sum[i];
		v->by->clear(sum, cells);
#endif
	}
}

/* Sums of all accumulators over the items of every lane; a short ring has one lane only. */
static void EW_LOCAL(run_items)(int id, const EW_LOCAL(vertices) *v, double *wide)
{
	EW_ALIGNED EW_REAL first[EW_WIDTH];
	const EW_REAL *origin = v->constants ? v->constants : first;
	for (int l = 0; l < EW_WIDTH; ++l)
		first[l] = EW_LOCAL(vertex_x)(v, 0);
	if (v->n < EW_SHORT)
		EW_LOCAL(run_short)(id, v, origin, wide);
	else
		EW_LOCAL(run_lanes)(id, v, origin, wide);
}

/* Sums of all accumulators. */
static void EW_LOCAL(run_ring)(int id, const EW_LOCAL(vertices) *v, double *total)
{
	EW_ALIGNED double wide[EW_MAX_ACCUMULATORS * EW_WIDTH];
	EW_LOCAL(run_items)(id, v, wide);
	for (int k = 0; k < ew_ring_shapes[id].accumulators; ++k) {
		double *lane = wide + k * EW_WIDTH;
		for (int half = v->n < EW_SHORT ? 0 : EW_WIDTH / 2; half > 0; half /= 2)
			for (int l = 0; l < half; ++l)
				lane[l] += lane[l + half];
		total[k] = lane[0];
	}
}

/* 0, or NaN if a coordinate is NaN or infinite. */
static double EW_LOCAL(nothing)(const EW_LOCAL(vertices) *v)
{
	double zero = 0;
	for (size_t i = 0; i < v->n; ++i) {
		double x = (double)EW_LOCAL(vertex_x)(v, i), y = (double)EW_LOCAL(vertex_y)(v, i);
		zero += (x - x) + (y - y);
	}
	return zero;
}

/* The results of one ring in double; no region has fewer than three vertices. */
static void EW_LOCAL(integrate)(int id, const EW_LOCAL(vertices) *v, double *out)
{
	double total[EW_MAX_ACCUMULATORS];
	if (v->n < 3) {
		double zero = EW_LOCAL(nothing)(v);
		for (int j = 0; j < ew_ring_shapes[id].outputs; ++j)
			out[j] = zero;
		return;
	}
	EW_LOCAL(run_ring)(id, v, total);
	ew_ring_shapes[id].finish(total, out, 1);
}

/* Is the last vertex the first one again? */
static int EW_LOCAL(is_closed)(const EW_REAL *x, const EW_REAL *y, size_t stride, size_t n)
{
	return x[0] == x[(n - 1) * stride] && y[0] == y[(n - 1) * stride];
}

static EW_LOCAL(vertices) EW_LOCAL(plain_on)(unsigned target, const EW_REAL *x, const EW_REAL *y,
	size_t stride, size_t n)
{
	EW_LOCAL(vertices) v = { x, y, stride, n, target, EW_LOCAL(by_columns)(target), 0, 0, 0, 0,
		0, 1, NULL };
	v.n -= n == EW_SHORT && EW_LOCAL(is_closed)(x, y, stride, n);
	return v;
}

static EW_LOCAL(vertices) EW_LOCAL(plain)(const EW_REAL *x, const EW_REAL *y, size_t stride,
	size_t n)
{
	return EW_LOCAL(plain_on)(ew_cpu_target(), x, y, stride, n);
}

#ifdef EW_MAX_DEGREE
static void EW_LOCAL(move_to_first)(EW_LOCAL(vertices) *v)
{
	v->moved = 1;
	v->cx = v->x[0];
	v->cy = v->y[0];
}
#endif

#ifdef EW_HAS_INTEGRANDS
static EW_REAL EW_LOCAL(integrate_one)(int id, const EW_REAL *x, const EW_REAL *y, size_t n)
{
	double out[1];
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, n);
	EW_LOCAL(integrate)(id, &v, out);
	return (EW_REAL)out[0];
}
#endif

#define EW_FUNCTION(function, id, edge, k) \
	EW_REAL function(const EW_REAL *x, const EW_REAL *y, size_t n) \
	{ \
		return EW_LOCAL(integrate_one)(id, x, y, n); \
	}
EW_LIST_POLYNOMIALS(EW_FUNCTION)
#undef EW_FUNCTION

#ifdef EW_HAS_MONOMIALS
EW_REAL EW_NAME(moment)(int m, int n_, const EW_REAL *x, const EW_REAL *y, size_t n)
{
	int id = ew_ring_of_monomial(m, n_);
	return id < 0 ? (EW_REAL)NAN : EW_LOCAL(integrate_one)(id, x, y, n);
}
#endif

#ifdef EW_MAX_DEGREE
static int EW_LOCAL(all_moments)(int degree, const EW_LOCAL(vertices) *v, EW_REAL *out)
{
	double result[EW_MAX_OUTPUTS];
	if (degree < 0 || degree > EW_MAX_DEGREE)
		return EW_BAD_DEGREE;
	EW_LOCAL(integrate)(EW_RING_MOMENTS_0 + degree, v, result);
	for (int j = 0; j < EW_MOMENTS(degree); ++j)
		out[j] = (EW_REAL)result[j];
	return EW_OK;
}

int EW_NAME(moments)(int degree, const EW_REAL *x, const EW_REAL *y, size_t n, EW_REAL *out)
{
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, n);
	return EW_LOCAL(all_moments)(degree, &v, out);
}

int EW_NAME(moments_xy)(int degree, const EW_REAL *xy, size_t n, EW_REAL *out)
{
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(xy, n ? xy + 1 : xy, 2, n);
	return EW_LOCAL(all_moments)(degree, &v, out);
}

int EW_NAME(moments_about)(int degree, const EW_REAL *x, const EW_REAL *y, size_t n,
	EW_REAL cx, EW_REAL cy, EW_REAL *out)
{
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, n);
	v.moved = 1;
	v.cx = cx;
	v.cy = cy;
	return EW_LOCAL(all_moments)(degree, &v, out);
}

int EW_NAME(translate_moments)(int degree, const EW_REAL *in, EW_REAL dx, EW_REAL dy, EW_REAL *out)
{
	double moment[EW_MAX_OUTPUTS];
	if (degree < 0 || degree > EW_MAX_DEGREE)
		return EW_BAD_DEGREE;
	for (int j = 0; j < EW_MOMENTS(degree); ++j)
		moment[j] = (double)in[j];
	ew_ring_translate(degree, (double)dx, (double)dy, moment);
	for (int j = 0; j < EW_MOMENTS(degree); ++j)
		out[j] = (EW_REAL)moment[j];
	return EW_OK;
}

EW_REAL EW_NAME(area)(const EW_REAL *x, const EW_REAL *y, size_t n)
{
	return EW_LOCAL(integrate_one)(EW_RING_MOMENTS_0, x, y, n);
}
#endif

#if defined(EW_HAS_DISTANCE) || (defined(EW_MAX_DEGREE) && EW_MAX_DEGREE >= 1)
/* A power of two that brings the moved vertices near 1, or 0 if they are all 0, NaN or infinite. */
static EW_REAL EW_LOCAL(unit_scale)(const EW_LOCAL(vertices) *v)
{
	double largest = 0;
	int exponent;
	for (size_t i = 0; i < v->n; ++i) {
		double x = fabs((double)EW_LOCAL(vertex_x)(v, i));
		double y = fabs((double)EW_LOCAL(vertex_y)(v, i));
		largest = x <= largest ? largest : x;
		largest = y <= largest ? largest : y;
	}
	if (largest == 0 || largest - largest != 0)
		return 0;
	frexp(largest, &exponent);
	return (EW_REAL)ldexp(1.0, exponent > 1000 ? -1000 : -exponent);
}

#endif

#if defined(EW_MAX_DEGREE) && EW_MAX_DEGREE >= 1
/* Has no moment left the range of its precision? */
static int EW_LOCAL(is_safe)(double area, double x, double y)
{
	const double size = fabs(area), rest = (x - x) + (y - y);
	return (size > 1 / EW_SAFE) & (size < EW_SAFE) & (rest == 0);
}

/* Centroid less first vertex into d, and the area; 0 if the area is 0. Moves the vertices to the
 * first one. If a moment has left the range of its precision, once more on scaled vertices. */
static int EW_LOCAL(centre)(EW_LOCAL(vertices) *v, double d[2], double *area)
{
	double moment[3] = { 0, 0, 0 }, back = 1;
	if (v->n) {
		EW_LOCAL(move_to_first)(v);
		EW_LOCAL(integrate)(EW_RING_MOMENTS_1, v, moment);
	}
	*area = moment[0];
	if (!EW_LOCAL(is_safe)(moment[0], moment[1], moment[2])) {
		EW_REAL scale = EW_LOCAL(unit_scale)(v);
		if (scale != 0) {
			v->scale = scale;
			EW_LOCAL(integrate)(EW_RING_MOMENTS_1, v, moment);
			v->scale = 1;
			back = 1 / (double)scale;
			*area = moment[0] * back * back;
		}
	}
	d[0] = moment[1] / moment[0] * back;
	d[1] = moment[2] / moment[0] * back;
	if (moment[0] == 0)
		d[0] = d[1] = (double)NAN;
	return moment[0] != 0;
}

static int EW_LOCAL(centroid_of)(EW_LOCAL(vertices) *v, EW_REAL c[2])
{
	double d[2], area;
	int found = EW_LOCAL(centre)(v, d, &area);
	c[0] = (EW_REAL)((double)v->cx + d[0]);
	c[1] = (EW_REAL)((double)v->cy + d[1]);
	return found ? EW_OK : EW_ZERO_AREA;
}

int EW_NAME(centroid)(const EW_REAL *x, const EW_REAL *y, size_t n, EW_REAL c[2])
{
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, n);
	return EW_LOCAL(centroid_of)(&v, c);
}

int EW_NAME(central_moments)(int degree, const EW_REAL *x, const EW_REAL *y, size_t n, EW_REAL c[2],
	EW_REAL *out)
{
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, n);
	double d[2], area;
	if (degree < 0 || degree > EW_MAX_DEGREE)
		return EW_BAD_DEGREE;
	if (!EW_LOCAL(centre)(&v, d, &area)) {
		c[0] = c[1] = (EW_REAL)NAN;
		for (int j = 0; j < EW_MOMENTS(degree); ++j)
			out[j] = (EW_REAL)NAN;
		return EW_ZERO_AREA;
	}
	c[0] = (EW_REAL)((double)v.cx + d[0]);
	c[1] = (EW_REAL)((double)v.cy + d[1]);
	v.dx = (EW_REAL)d[0];
	v.dy = (EW_REAL)d[1];
	EW_LOCAL(all_moments)(degree, &v, out);
	out[0] = (EW_REAL)area;        /* better conditioned where the centroid lies far outside */
	for (int j = 1; j < EW_MOMENTS(degree) && j < 3; ++j)
		out[j] = out[j] == out[j] ? 0 : out[j];    /* by definition, unless NaN came in */
	return EW_OK;
}
#endif
#endif

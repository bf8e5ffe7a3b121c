/* edgewise_batches_template.h - many rings at a time, included by edgewise_rings.c once per
 * precision, behind the driver of single rings.
 *
 * Short rings stand side by side, one in each lane of a register: their vertices are transposed
 * into a tile that stays in the nearest cache, over which the same kernels run with reach and step
 * equal to the width. Since a short ring takes its items one by one anyway, the results are those
 * of the functions for single rings, bit for bit. Rings that do not fit in (long ones, and those
 * of fewer than three vertices) go to the driver of single rings. Results that exceed the caches
 * bypass them.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

typedef struct {
	const EW_REAL *x, *y;
	const int32_t *offsets;
	size_t rings;
	int id, moved;                 /* moved: about the first vertex of each ring */
	EW_RUN *run;
	ew_ring_finish *finish;        /* as many neighbours as `finished` */
	const EW_LOCAL(columns) *by;
	size_t finished;
} EW_LOCAL(batch);

/* Up to EW_WIDTH rings side by side, from ring `first` on. */
typedef struct {
	size_t first, count, shortest, longest, furthest;    /* furthest: start */
	size_t start[EW_WIDTH];        /* of a lane without a ring of its own: that of another */
	EW_REAL length[EW_WIDTH];      /* and 0 */
	size_t left_out;               /* lanes for the driver of single rings */
	size_t lane[EW_WIDTH];
} EW_LOCAL(group);

static size_t EW_LOCAL(ring_size)(const EW_LOCAL(batch) *b, size_t ring)
{
	return (size_t)(b->offsets[ring + 1] - b->offsets[ring]);
}

static EW_LOCAL(vertices) EW_LOCAL(ring_vertices)(const EW_LOCAL(batch) *b, size_t ring)
{
	size_t start = (size_t)b->offsets[ring];
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(b->x + start, b->y + start, 1,
		EW_LOCAL(ring_size)(b, ring));
	if (b->moved && v.n)
		EW_LOCAL(move_to_first)(&v);
	return v;
}

static void EW_LOCAL(form_group)(const EW_LOCAL(batch) *b, size_t first, EW_LOCAL(group) *g)
{
	size_t some = 0, left = b->rings - first;
	g->first = first;
	g->count = left < b->by->width ? left : b->by->width;
	g->shortest = EW_SHORT;
	g->longest = 0;
	g->left_out = 0;
	for (size_t l = 0; l < g->count; ++l) {
		const size_t start = (size_t)b->offsets[first + l];
		const size_t stored = EW_LOCAL(ring_size)(b, first + l);
		const size_t n = stored - EW_LOCAL(is_closed)(b->x + start, b->y + start, 1, stored);
		const int fits = b->by->gather && n - 3 < EW_SHORT - 3;
		g->start[l] = start;
		g->length[l] = fits ? (EW_REAL)n : 0;
		some = fits ? l : some;
		g->shortest = n < g->shortest ? n : g->shortest;
		g->longest = fits && n > g->longest ? n : g->longest;
		g->lane[g->left_out] = l;
		g->left_out += !fits;
	}
	g->furthest = g->start[some];
	for (size_t k = 0; k < g->left_out; ++k)
		g->start[g->lane[k]] = g->furthest;
	for (size_t l = g->count; l < b->by->width; ++l) {
		g->start[l] = g->furthest;
		g->length[l] = 0;
	}
	g->shortest = g->left_out || g->count < b->by->width ? 0 : g->shortest;
}

/* Near the end of the arrays a gather by vectors would read past them. */
static void EW_LOCAL(gather_slowly)(const EW_REAL *from, const EW_LOCAL(group) *g, size_t width,
	int moved, EW_REAL *tile)
{
	for (size_t l = 0; l < width; ++l)
		for (size_t c = 0; c <= g->longest; ++c) {
			size_t i = (EW_REAL)c < g->length[l] ? c : 0;
			EW_REAL origin = moved ? from[g->start[l]] : 0;
			tile[c * width + l] = from[g->start[l] + i] - origin;
		}
}

static void EW_LOCAL(fill_tile)(const EW_LOCAL(batch) *b, const EW_LOCAL(group) *g,
	const EW_REAL *from, EW_REAL *tile)
{
	if (g->furthest + g->longest + 3 <= (size_t)b->offsets[b->rings])
		b->by->gather(from, g->start, g->length, g->shortest, g->longest, b->moved, tile);
	else
		EW_LOCAL(gather_slowly)(from, g, b->by->width, b->moved, tile);
}

/* Results of the lanes that have a ring of their own: out[output * EW_WIDTH + lane]. */
static void EW_LOCAL(run_group)(const EW_LOCAL(batch) *b, const EW_LOCAL(group) *g, double *out)
{
	const ew_ring_shape *shape = &ew_ring_shapes[b->id];
	const size_t width = b->by->width, cells = (size_t)shape->accumulators * EW_WIDTH;
	EW_REAL x[EW_TILE * EW_WIDTH], y[EW_TILE * EW_WIDTH], sum[EW_MAX_ACCUMULATORS * EW_WIDTH];
#if EW_IS_FLOAT
	double wide[EW_MAX_ACCUMULATORS * EW_WIDTH];
#else
	const double *wide = sum;
#endif
	memset(sum, 0, cells * sizeof *sum);
	EW_LOCAL(fill_tile)(b, g, b->x, x);
	EW_LOCAL(fill_tile)(b, g, b->y, y);
	b->run(x, y, x, width, width, (g->longest + 2 - (size_t)shape->window) * width, sum);
#if EW_IS_FLOAT
	for (size_t i = 0; i < cells; ++i)
		wide[i] = (double)sum[i];
#endif
	for (size_t l = 0; l < width; l += b->finished)
		b->finish(wide + l, out + l, EW_WIDTH);
}

static void EW_LOCAL(run_left_out)(const EW_LOCAL(batch) *b, const EW_LOCAL(group) *g, double *out)
{
	double result[EW_MAX_OUTPUTS];
	for (size_t k = 0; k < g->left_out; ++k) {
		EW_LOCAL(vertices) v = EW_LOCAL(ring_vertices)(b, g->first + g->lane[k]);
		EW_LOCAL(integrate)(b->id, &v, result);
		for (int j = 0; j < ew_ring_shapes[b->id].outputs; ++j)
			out[j * EW_WIDTH + (int)g->lane[k]] = result[j];
	}
}

/* The next group: its results, and behind it 0 when no ring is left. */
static int EW_LOCAL(next_group)(const EW_LOCAL(batch) *b, EW_LOCAL(group) *g, double *out)
{
	if (g->first == b->rings)
		return 0;
	EW_LOCAL(form_group)(b, g->first, g);
	if (g->longest)
		EW_LOCAL(run_group)(b, g, out);
	EW_LOCAL(run_left_out)(b, g, out);
	return 1;
}

static int EW_LOCAL(bad_offsets)(const int32_t *offsets, size_t rings)
{
	int bad = 0;
	if (rings > 0)
		bad = offsets[0] < 0;
	for (size_t i = 0; i < rings; ++i)
		bad |= offsets[i + 1] < offsets[i];
	return bad;
}

static EW_LOCAL(batch) EW_LOCAL(batch_of)(int degree, const EW_REAL *x, const EW_REAL *y,
	const int32_t *offsets, size_t rings)
{
	const unsigned target = ew_cpu_target();
	EW_LOCAL(batch) b = { x, y, offsets, rings, EW_RING_MOMENTS_0 + degree, 0, NULL, NULL,
		EW_LOCAL(by_columns)(target), 1 };
	b.run = EW_LOCAL(kernel)(b.id);
	b.finish = ew_ring_finish_columns(target, degree, &b.finished);
	return b;
}

/* Past the caches if the results of all rings would not stay in them anyway. */
static void EW_LOCAL(put)(EW_REAL *to, double value, int past)
{
#if EW_X86
	if (past) {
		EW_REAL narrow = (EW_REAL)value;
#if EW_IS_FLOAT
		int bits;
		memcpy(&bits, &narrow, sizeof bits);
		_mm_stream_si32((int *)to, bits);
#else
		long long bits;
		memcpy(&bits, &narrow, sizeof bits);
		_mm_stream_si64((long long *)to, bits);
#endif
		return;
	}
#else
	(void)past;
#endif
	*to = (EW_REAL)value;
}

static int EW_LOCAL(is_large)(size_t results)
{
	return results > EW_CACHED / sizeof(EW_REAL);
}

int EW_NAME(moments_rings)(int degree, const EW_REAL *x, const EW_REAL *y, const int32_t *offsets,
	size_t rings, EW_REAL *out)
{
	if (degree < 0 || degree > EW_MAX_DEGREE)
		return EW_BAD_DEGREE;
	if (EW_LOCAL(bad_offsets)(offsets, rings))
		return EW_BAD_OFFSETS;
	const size_t outputs = EW_MOMENTS((size_t)degree);
	const int past = EW_LOCAL(is_large)(rings * outputs);
	const EW_LOCAL(batch) b = EW_LOCAL(batch_of)(degree, x, y, offsets, rings);
	double result[EW_MAX_OUTPUTS * EW_WIDTH];
	EW_LOCAL(group) g = { 0 };
	for (; EW_LOCAL(next_group)(&b, &g, result); g.first += g.count)
		for (size_t l = 0; l < g.count; ++l)
			for (size_t j = 0; j < outputs; ++j)
				EW_LOCAL(put)(out + (g.first + l) * outputs + j,
					result[j * EW_WIDTH + l], past);
	ew_ring_fence(past);
	return EW_OK;
}

int EW_NAME(area_rings)(const EW_REAL *x, const EW_REAL *y, const int32_t *offsets, size_t rings,
	EW_REAL *out)
{
	return EW_NAME(moments_rings)(0, x, y, offsets, rings, out);
}

#if EW_MAX_DEGREE >= 1
/* Centroid of lane l, as EW_NAME(centroid) has it. */
static void EW_LOCAL(lane_centroid)(const EW_LOCAL(batch) *b, const EW_LOCAL(group) *g, size_t l,
	const double *moment, EW_REAL c[2])
{
	EW_LOCAL(vertices) v = EW_LOCAL(ring_vertices)(b, g->first + l);
	if (v.n >= 3 && EW_LOCAL(is_safe)(moment[l], moment[EW_WIDTH + l], moment[2 * EW_WIDTH + l])) {
		c[0] = (EW_REAL)((double)v.x[0] + moment[EW_WIDTH + l] / moment[l]);
		c[1] = (EW_REAL)((double)v.y[0] + moment[2 * EW_WIDTH + l] / moment[l]);
	} else
		EW_NAME(centroid)(v.x, v.y, v.n, c);
}

int EW_NAME(centroid_rings)(const EW_REAL *x, const EW_REAL *y, const int32_t *offsets,
	size_t rings, EW_REAL *cx, EW_REAL *cy)
{
	if (EW_LOCAL(bad_offsets)(offsets, rings))
		return EW_BAD_OFFSETS;
	const int past = EW_LOCAL(is_large)(2 * rings);
	EW_LOCAL(batch) b = EW_LOCAL(batch_of)(1, x, y, offsets, rings);
	double result[EW_MAX_OUTPUTS * EW_WIDTH];
	EW_LOCAL(group) g = { 0 };
	b.moved = 1;
	for (; EW_LOCAL(next_group)(&b, &g, result); g.first += g.count)
		for (size_t l = 0; l < g.count; ++l) {
			EW_REAL c[2];
			EW_LOCAL(lane_centroid)(&b, &g, l, result, c);
			EW_LOCAL(put)(cx + g.first + l, (double)c[0], past);
			EW_LOCAL(put)(cy + g.first + l, (double)c[1], past);
		}
	ew_ring_fence(past);
	return EW_OK;
}
#endif

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

/* Up to EW_WIDTH rings side by side, from ring `first` on. */
typedef struct {
	size_t first, count, furthest;         /* furthest: the start that comes last */
	ew_ring_lanes lanes;
	int side;                              /* to be summed up in registers, without a tile */
	int left_out;                          /* is a ring for the driver of single rings? */
	int32_t start[EW_WIDTH];               /* if not as in the offsets */
	EW_ALIGNED EW_REAL length[EW_WIDTH];              /* 0: no ring, or left out */
	EW_ALIGNED EW_REAL x[EW_TILE * EW_WIDTH];
	EW_ALIGNED EW_REAL y[EW_TILE * EW_WIDTH];
} EW_LOCAL(group);

/* While one group is integrated the tile of the next is already filled, so that what was stored by
 * halves of a register has reached the cache before it is loaded. */
typedef struct {
	const EW_REAL *x, *y;
	const int32_t *offsets;
	size_t rings;
	int far;                               /* larger than the caches */
	int id, side, moved;                   /* moved: about the first vertex of each ring */
	EW_RUN *run;
	ew_ring_divide *divide;
	ew_ring_finish *finish;                /* of `finished` rings side by side */
	size_t finished;
	int32_t most;                          /* a ring of that many vertices does not fit */
	const EW_LOCAL(columns) *by;
	EW_LOCAL(group) group[2];
	int now;
	EW_ALIGNED EW_REAL sum[EW_MAX_ACCUMULATORS * EW_WIDTH];
	EW_ALIGNED double result[EW_MAX_OUTPUTS * EW_WIDTH];       /* [output * EW_WIDTH + lane] */
} EW_LOCAL(batch);

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

/* The vertices of a ring that fits into the tile, else 0. */
EW_INLINE size_t EW_LOCAL(short_size)(const EW_LOCAL(batch) *b, size_t ring)
{
	size_t n = EW_LOCAL(ring_size)(b, ring);
	if (n == EW_SHORT)
		n = EW_LOCAL(ring_vertices)(b, ring).n;
	return n - 3 < (size_t)b->most - 3 ? n : 0;
}

/* Lanes without a ring get the start of one that fits. */
static void EW_LOCAL(fill_lanes)(size_t width, EW_LOCAL(group) *g)
{
	for (size_t l = 0; l < width; ++l) {
		if (l >= g->count)
			g->length[l] = 0;
		g->start[l] = g->length[l] > 0 ? g->lanes.start[l] : (int32_t)g->furthest;
	}
	g->lanes.start = g->start;
	g->lanes.shortest = 0;
}

/* Any sizes. */
static void EW_LOCAL(form_mixed)(const EW_LOCAL(batch) *b, EW_LOCAL(group) *g)
{
	size_t shortest = EW_SHORT, longest = 0, furthest = 0;
	for (size_t l = 0; l < g->count; ++l) {
		const size_t n = EW_LOCAL(short_size)(b, g->first + l);
		g->length[l] = (EW_REAL)n;
		furthest = n ? (size_t)g->lanes.start[l] : furthest;
		shortest = n < shortest ? n : shortest;
		longest = n > longest ? n : longest;
	}
	g->furthest = furthest;
	g->left_out = shortest == 0;
	g->lanes.shortest = shortest;
	g->lanes.longest = longest;
	if (g->left_out || g->count < b->by->width)
		EW_LOCAL(fill_lanes)(b->by->width, g);
}

static void EW_LOCAL(form_group)(const EW_LOCAL(batch) *b, size_t first, EW_LOCAL(group) *g)
{
	const size_t left = b->rings - first, width = b->by->width;
	const int32_t *start = b->offsets + first;
	int32_t shortest = EW_SHORT, longest = 0;
	g->first = first;
	g->count = left < width ? left : width;
	g->lanes.start = start;
	for (size_t l = 0; l < g->count; ++l) {
		const int32_t n = start[l + 1] - start[l];
		shortest = n < shortest ? n : shortest;
		longest = n > longest ? n : longest;
	}
	if (left < width || shortest < 3 || longest >= b->most) {
		EW_LOCAL(form_mixed)(b, g);
		return;
	}
	for (size_t l = 0; l < width && shortest < longest; ++l)
		g->length[l] = (EW_REAL)(start[l + 1] - start[l]);
	g->furthest = (size_t)start[width - 1];
	g->left_out = 0;
	g->lanes.shortest = (size_t)shortest;
	g->lanes.longest = (size_t)longest;
}

/* Near the end of the arrays a gather by vectors would read past them. */
static void EW_LOCAL(gather_slowly)(const EW_REAL *from, const EW_LOCAL(group) *g, size_t width,
	int moved, EW_REAL *tile)
{
	for (size_t l = 0; l < width; ++l) {
		const EW_REAL *row = from + g->lanes.start[l], origin = moved ? row[0] : 0;
		const size_t n = g->lanes.shortest < g->lanes.longest ? (size_t)g->length[l]
			: g->lanes.longest;
		for (size_t c = 0; c < g->lanes.longest + 2; ++c)
			tile[c * width + l] = row[c < n ? c : 0] - origin;
	}
}

/* Vertices that are needed soon, if there are that many. */
static void EW_LOCAL(ask_for)(const EW_LOCAL(batch) *b, size_t start, size_t end)
{
	const size_t last = (size_t)b->offsets[b->rings];
	end = end < last ? end : last;
	for (size_t i = start; i < end; i += 64 / sizeof(EW_REAL)) {
		EW_PREFETCH(b->x + i);
		EW_PREFETCH(b->y + i);
	}
}

static void EW_LOCAL(prepare)(const EW_LOCAL(batch) *b, size_t first, EW_LOCAL(group) *g)
{
	const size_t width = b->by->width;
	EW_LOCAL(form_group)(b, first, g);
	if (b->far)
		EW_LOCAL(ask_for)(b, (size_t)b->offsets[first] + EW_AHEAD,
			(size_t)b->offsets[g->first + g->count] + EW_AHEAD);
	if (g->lanes.longest == 0)
		return;
	g->side = b->side && g->furthest + g->lanes.longest + 3 <= (size_t)b->offsets[b->rings];
	if (g->side)
		return;
	if (g->furthest + g->lanes.longest + 3 <= (size_t)b->offsets[b->rings]) {
		b->by->gather(b->x, b->y, &g->lanes, g->length, b->moved, g->x, g->y);
	} else {
		EW_LOCAL(gather_slowly)(b->x, g, width, b->moved, g->x);
		EW_LOCAL(gather_slowly)(b->y, g, width, b->moved, g->y);
	}
}

/* An odd number of items is made even by one that adds 0: kernels take pairs. */
static void EW_LOCAL(run_group)(EW_LOCAL(batch) *b, const EW_LOCAL(group) *g)
{
	const ew_ring_shape *shape = &ew_ring_shapes[b->id];
	const size_t width = b->by->width, cells = (size_t)shape->accumulators * EW_WIDTH;
	const size_t items = (g->lanes.longest + 3 - (size_t)shape->window) / 2 * 2;
#if EW_IS_FLOAT
	EW_ALIGNED double wide[EW_MAX_ACCUMULATORS * EW_WIDTH];
#else
	const double *wide = b->sum;
#endif
	if (g->side)
		b->by->side[b->id - EW_RING_MOMENTS_0](b->x, b->y, &g->lanes, g->length, b->moved,
			b->sum);
	else {
		b->by->clear(b->sum, cells);
		b->run(g->x, g->y, g->x, width, width, items * width, b->sum);
	}
#if EW_IS_FLOAT
	for (size_t i = 0; i < cells; ++i)
		wide[i] = (double)b->sum[i];
#endif
	for (size_t l = 0; l < width; l += b->finished)
		b->finish(wide + l, b->result + l, EW_WIDTH);
}

/* Rings that were left out, and rings whose results are not finite: what stands behind the last
 * vertex adds 0 only as long as nothing overflows. */
static void EW_LOCAL(run_single)(EW_LOCAL(batch) *b, const EW_LOCAL(group) *g)
{
	const int outputs = ew_ring_shapes[b->id].outputs;
	double result[EW_MAX_OUTPUTS];
	for (int l = 0; l < (int)g->count; ++l) {
		int done = !g->left_out || g->length[l] > 0;
		for (int j = 0; j < outputs && done; ++j)
			done = b->result[j * EW_WIDTH + l] - b->result[j * EW_WIDTH + l] == 0;
		if (done)
			continue;
		EW_LOCAL(vertices) v = EW_LOCAL(ring_vertices)(b, g->first + (size_t)l);
		EW_LOCAL(integrate)(b->id, &v, result);
		for (int j = 0; j < outputs; ++j)
			b->result[j * EW_WIDTH + l] = result[j];
	}
}

static int EW_LOCAL(is_finite)(const EW_LOCAL(batch) *b)
{
	const int count = ew_ring_shapes[b->id].outputs * EW_WIDTH;
	double even = 0, odd = 0;
	for (int i = 0; i < count; i += 2) {
		even += b->result[i] - b->result[i];
		odd += b->result[i + 1] - b->result[i + 1];
	}
	return even + odd == 0;
}

/* The next group, with its results in b->result; NULL when no ring is left. */
static const EW_LOCAL(group) *EW_LOCAL(next_group)(EW_LOCAL(batch) *b)
{
	const EW_LOCAL(group) *g = &b->group[b->now];
	if (g->count == 0)
		return NULL;
	b->now = !b->now;
	EW_LOCAL(prepare)(b, g->first + g->count, &b->group[b->now]);
	if (g->lanes.longest)
		EW_LOCAL(run_group)(b, g);
	if (g->left_out || !EW_LOCAL(is_finite)(b))
		EW_LOCAL(run_single)(b, g);
	return g;
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

static void EW_LOCAL(begin)(EW_LOCAL(batch) *b, int degree, int moved, const EW_REAL *x,
	const EW_REAL *y, const int32_t *offsets, size_t rings)
{
	const unsigned target = ew_cpu_target();
	b->x = x;
	b->y = y;
	b->offsets = offsets;
	b->rings = rings;
	b->id = EW_RING_MOMENTS_0 + degree;
	b->moved = moved;
	b->run = EW_LOCAL(kernel)(b->id, target);
	b->finish = ew_ring_finish_columns(target, degree, &b->finished);
	b->divide = ew_ring_divide_by_target(target);
	b->by = EW_LOCAL(by_columns)(target);
	b->far = rings && (size_t)offsets[rings] > EW_CACHED / sizeof *x;
	b->side = degree < EW_SIDES && b->by->side[degree];
	b->most = b->by->gather ? EW_SHORT : 3;
	b->now = 0;
	memset(b->result, 0, sizeof b->result);
	EW_LOCAL(prepare)(b, 0, &b->group[0]);
}

/* Past the caches if the results of all rings would not stay in them anyway. */
EW_INLINE void EW_LOCAL(put)(EW_REAL *to, double value, int past)
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

EW_INLINE void EW_LOCAL(put_moments)(const double *result, size_t rings, size_t outputs, int past,
	EW_REAL *to)
{
	for (size_t l = 0; l < rings; ++l)
		for (size_t j = 0; j < outputs; ++j)
			EW_LOCAL(put)(to++, result[j * EW_WIDTH + l], past);
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
	const EW_LOCAL(group) *g;
	EW_LOCAL(batch) b;
	EW_LOCAL(begin)(&b, degree, 0, x, y, offsets, rings);
	for (EW_REAL *to = out; (g = EW_LOCAL(next_group)(&b)) != NULL; to += g->count * outputs)
		if (past)
			EW_LOCAL(put_moments)(b.result, g->count, outputs, 1, to);
		else
			EW_LOCAL(put_moments)(b.result, g->count, outputs, 0, to);
	ew_ring_fence(past);
	return EW_OK;
}

int EW_NAME(area_rings)(const EW_REAL *x, const EW_REAL *y, const int32_t *offsets, size_t rings,
	EW_REAL *out)
{
	return EW_NAME(moments_rings)(0, x, y, offsets, rings, out);
}

#if EW_MAX_DEGREE >= 1
/* Centroids of a group less the first vertices: c[lane], and c[EW_WIDTH + lane] for y.
 * 0 if one of them needs the care of EW_NAME(centroid). */
static int EW_LOCAL(quotients)(const EW_LOCAL(batch) *b, const EW_LOCAL(group) *g, double *c)
{
	const double *area = b->result, *x = area + EW_WIDTH, *y = x + EW_WIDTH;
	int careful = 0;
	b->divide(x, area, EW_WIDTH, c);
	b->divide(y, area, EW_WIDTH, c + EW_WIDTH);
	for (size_t l = 0; l < g->count; ++l)
		careful |= !EW_LOCAL(is_safe)(area[l], x[l], y[l]);
	return !careful;
}

EW_INLINE void EW_LOCAL(put_centroids)(const EW_LOCAL(batch) *b, const EW_LOCAL(group) *g, int past,
	EW_REAL *cx, EW_REAL *cy)
{
	EW_ALIGNED double c[2 * EW_WIDTH];
	const int32_t *start = b->offsets + g->first;
	if (!EW_LOCAL(quotients)(b, g, c)) {
		for (size_t l = 0; l < g->count; ++l) {
			EW_REAL one[2];
			EW_NAME(centroid)(b->x + start[l], b->y + start[l],
				EW_LOCAL(ring_size)(b, g->first + l), one);
			EW_LOCAL(put)(cx + l, (double)one[0], past);
			EW_LOCAL(put)(cy + l, (double)one[1], past);
		}
		return;
	}
	for (size_t l = 0; l < g->count; ++l)
		EW_LOCAL(put)(cx + l, (double)b->x[start[l]] + c[l], past);
	for (size_t l = 0; l < g->count; ++l)
		EW_LOCAL(put)(cy + l, (double)b->y[start[l]] + c[EW_WIDTH + l], past);
}

int EW_NAME(centroid_rings)(const EW_REAL *x, const EW_REAL *y, const int32_t *offsets,
	size_t rings, EW_REAL *cx, EW_REAL *cy)
{
	if (EW_LOCAL(bad_offsets)(offsets, rings))
		return EW_BAD_OFFSETS;
	const int past = EW_LOCAL(is_large)(2 * rings);
	const EW_LOCAL(group) *g;
	EW_LOCAL(batch) b;
	EW_LOCAL(begin)(&b, 1, 1, x, y, offsets, rings);
	while ((g = EW_LOCAL(next_group)(&b)) != NULL)
		if (past)
			EW_LOCAL(put_centroids)(&b, g, 1, cx + g->first, cy + g->first);
		else
			EW_LOCAL(put_centroids)(&b, g, 0, cx + g->first, cy + g->first);
	ew_ring_fence(past);
	return EW_OK;
}
#endif

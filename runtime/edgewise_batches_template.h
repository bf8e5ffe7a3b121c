/* edgewise_batches_template.h - many rings at a time, included by edgewise_rings.c once per
 * precision, behind the driver of single rings.
 *
 * Short rings stand side by side, one in each lane of a register. Up to degree EW_SIDES - 1 their
 * vertices are transposed and summed up without leaving the registers (edgewise_sides_template.h).
 * For higher degrees, and near the end of the arrays, they go into a tile that stays in the nearest
 * cache, over which the kernels of single rings run with reach and step equal to the width. Since a
 * short ring takes its items one by one anyway, the results are those of the functions for single
 * rings, bit for bit. Rings that do not fit in (long ones, and those of fewer than three vertices)
 * go to the driver of single rings.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

/* Up to EW_WIDTH rings side by side, from ring `first` on. */
typedef struct {
	size_t first, count, furthest;         /* furthest: the start that comes last */
	ew_ring_lanes lanes;
	int left_out;                          /* is a ring for the driver of single rings? */
	int32_t start[EW_WIDTH];               /* if not as in the offsets */
	EW_ALIGNED EW_REAL length[EW_WIDTH];              /* 0: no ring, or left out */
	EW_ALIGNED EW_REAL x[EW_TILE * EW_WIDTH];
	EW_ALIGNED EW_REAL y[EW_TILE * EW_WIDTH];
} EW_LOCAL(group);

typedef struct {
	const EW_REAL *x, *y;
	const int32_t *offsets;
	size_t rings;
	int id, moved;                         /* moved: about the first vertex of each ring */
	EW_RUN *run;
	EW_LOCAL(side) *side;                  /* instead of `run`, or NULL */
	ew_ring_finish *finish;                /* of `finished` rings side by side */
	size_t finished;
	int32_t most;                          /* a ring of that many vertices does not fit */
	const EW_LOCAL(columns) *by;
	EW_LOCAL(group) group;
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

/* The sums of all accumulators. An odd number of items is made even by one that adds 0: kernels
 * take pairs. */
static void EW_LOCAL(sum_group)(EW_LOCAL(batch) *b, EW_LOCAL(group) *g)
{
	const ew_ring_shape *shape = &ew_ring_shapes[b->id];
	const size_t width = b->by->width, longest = g->lanes.longest;
	const size_t items = (longest + 3 - (size_t)shape->window) / 2 * 2;
	const int in_reach = g->furthest + longest + 3 <= (size_t)b->offsets[b->rings];
	if (in_reach && b->side) {
		b->side(b->x, b->y, &g->lanes, g->length, b->sum);
		return;
	}
	if (in_reach) {
		b->by->gather(b->x, b->y, &g->lanes, g->length, g->x, g->y);
	} else {
		EW_LOCAL(gather_slowly)(b->x, g, width, b->moved, g->x);
		EW_LOCAL(gather_slowly)(b->y, g, width, b->moved, g->y);
	}
	b->by->clear(b->sum, (size_t)shape->accumulators * EW_WIDTH);
	b->run(g->x, g->y, g->x, width, width, items * width, b->sum);
}

static void EW_LOCAL(run_group)(EW_LOCAL(batch) *b, EW_LOCAL(group) *g)
{
#if EW_IS_FLOAT
	EW_ALIGNED double wide[EW_MAX_ACCUMULATORS * EW_WIDTH];
	EW_LOCAL(sum_group)(b, g);
	for (int i = 0; i < ew_ring_shapes[b->id].accumulators * EW_WIDTH; ++i)
		wide[i] = (double)b->sum[i];
#else
	const double *wide = b->sum;
	EW_LOCAL(sum_group)(b, g);
#endif
	for (size_t l = 0; l < b->by->width; l += b->finished)
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
	EW_LOCAL(group) *g = &b->group;
	const size_t first = g->first + g->count;
	if (first == b->rings)
		return NULL;
	EW_LOCAL(form_group)(b, first, g);
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
	b->by = EW_LOCAL(by_columns)(target);
	b->side = moved ? b->by->centroid : degree < EW_SIDES ? b->by->side[degree] : NULL;
	b->most = b->by->gather ? EW_SHORT : 3;
	b->group.first = b->group.count = 0;
	memset(b->result, 0, sizeof b->result);
}

int EW_NAME(moments_rings)(int degree, const EW_REAL *x, const EW_REAL *y, const int32_t *offsets,
	size_t rings, EW_REAL *out)
{
	if (degree < 0 || degree > EW_MAX_DEGREE)
		return EW_BAD_DEGREE;
	if (EW_LOCAL(bad_offsets)(offsets, rings))
		return EW_BAD_OFFSETS;
	const size_t outputs = EW_MOMENTS((size_t)degree);
	const EW_LOCAL(group) *g;
	EW_LOCAL(batch) b;
	EW_LOCAL(begin)(&b, degree, 0, x, y, offsets, rings);
	while ((g = EW_LOCAL(next_group)(&b)) != NULL)
		for (size_t l = 0; l < g->count; ++l)
			for (size_t j = 0; j < outputs; ++j)
				*out++ = (EW_REAL)b.result[j * EW_WIDTH + l];
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
	b->by->divide(x, area, EW_WIDTH, c);
	b->by->divide(y, area, EW_WIDTH, c + EW_WIDTH);
	for (size_t l = 0; l < g->count; ++l)
		careful |= !EW_LOCAL(is_safe)(area[l], x[l], y[l]);
	return !careful;
}

static void EW_LOCAL(put_centroids)(const EW_LOCAL(batch) *b, const EW_LOCAL(group) *g,
	EW_REAL *cx, EW_REAL *cy)
{
	EW_ALIGNED double c[2 * EW_WIDTH];
	const int32_t *start = b->offsets + g->first;
	if (EW_LOCAL(quotients)(b, g, c)) {
		for (size_t l = 0; l < g->count; ++l)
			cx[l] = (EW_REAL)((double)b->x[start[l]] + c[l]);
		for (size_t l = 0; l < g->count; ++l)
			cy[l] = (EW_REAL)((double)b->y[start[l]] + c[EW_WIDTH + l]);
		return;
	}
	for (size_t l = 0; l < g->count; ++l) {
		EW_REAL one[2];
		EW_NAME(centroid)(b->x + start[l], b->y + start[l],
			EW_LOCAL(ring_size)(b, g->first + l), one);
		cx[l] = one[0];
		cy[l] = one[1];
	}
}

int EW_NAME(centroid_rings)(const EW_REAL *x, const EW_REAL *y, const int32_t *offsets,
	size_t rings, EW_REAL *cx, EW_REAL *cy)
{
	if (EW_LOCAL(bad_offsets)(offsets, rings))
		return EW_BAD_OFFSETS;
	const EW_LOCAL(group) *g;
	EW_LOCAL(batch) b;
	EW_LOCAL(begin)(&b, 1, 1, x, y, offsets, rings);
	while ((g = EW_LOCAL(next_group)(&b)) != NULL)
		EW_LOCAL(put_centroids)(&b, g, cx + g->first, cy + g->first);
	return EW_OK;
}
#endif

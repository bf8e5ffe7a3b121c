/* edgewise_batches_template.h - many rings at a time, included by edgewise_rings.c once per
 * precision, behind the driver of single rings.
 *
 * Short rings stand side by side, one in each lane of a register. Up to degree EW_SIDES - 1 their
 * vertices are transposed and summed up without leaving the registers, a row of EW_ROW rings before
 * the sums are finished and stored (edgewise_sides_template.h).
 * For higher degrees, and near the end of the arrays, they go into a tile that stays in the nearest
 * cache, over which the kernels of single rings run with reach and step equal to the width. Since a
 * short ring takes its items one by one anyway, the results are those of the functions for single
 * rings, bit for bit. Rings that do not fit in (long ones, and those of fewer than three vertices)
 * are left out: their sum is NaN, and what is not finite goes to the driver of single rings.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

/* A row of rings; [output * stride + ring] of the last two. */
typedef struct {
	const EW_REAL *x, *y;
	const int32_t *offsets;
	size_t rings;
	unsigned target;
	int id, moved;                         /* moved: about the first vertex of each ring */
	EW_RUN *run;
	EW_LOCAL(side) *side;                  /* instead of `run`, or NULL */
	ew_ring_finish *finish;                /* of `finished` rings side by side */
	size_t finished;
	const EW_LOCAL(columns) *by;
	size_t first, count, stride;
	int not_finite;                        /* is a sum not finite? */
	EW_ALIGNED double sum[EW_MAX_ACCUMULATORS * EW_WIDTH + EW_SIDE_SUMS * EW_ROW];
	EW_ALIGNED double result[EW_MAX_OUTPUTS * EW_WIDTH + EW_SIDE_SUMS * EW_ROW];
} EW_LOCAL(batch);

static EW_LOCAL(vertices) EW_LOCAL(ring_vertices)(const EW_LOCAL(batch) *b, size_t ring)
{
	const int32_t start = b->offsets[ring];
	return EW_LOCAL(plain_on)(b->target, b->x + start, b->y + start, 1,
		(size_t)(b->offsets[ring + 1] - start));
}

/* Lanes without a ring that fits get the start of another one. */
void EW_LOCAL(fit)(const EW_REAL *x, const EW_REAL *y, const int32_t *offsets, size_t rings,
	size_t width, EW_LOCAL(lanes) *lanes)
{
	size_t other = (size_t)offsets[rings - 1];
	lanes->longest = 0;
	for (size_t l = 0; l < width; ++l) {
		const size_t start = l < rings ? (size_t)offsets[l] : 0;
		size_t n = l < rings ? (size_t)offsets[l + 1] - start : 0;
		n -= n == EW_SHORT && EW_LOCAL(is_closed)(x + start, y + start, 1, n);
		n = n < 3 || n >= EW_SHORT ? 0 : n;
		lanes->start[l] = start;
		lanes->length[l] = (EW_REAL)n;
		lanes->longest = n > lanes->longest ? n : lanes->longest;
		other = n ? start : other;
	}
	for (size_t l = 0; l < width; ++l)
		if (!(lanes->length[l] > 0))
			lanes->start[l] = other;
}

/* Near the end of the arrays a gather by vectors would read past them. */
static void EW_LOCAL(gather_slowly)(const EW_REAL *from, const EW_LOCAL(lanes) *lanes,
	size_t width, int moved, EW_REAL *tile)
{
	for (size_t l = 0; l < width; ++l) {
		const EW_REAL *row = from + lanes->start[l], origin = moved ? row[0] : 0;
		const size_t n = (size_t)lanes->length[l];
		for (size_t c = 0; c < lanes->longest + 2; ++c)
			tile[c * width + l] = row[c < n ? c : 0] - origin;
	}
}

/* The sums of a group by way of a tile. An odd number of items is made even by one that adds 0:
 * kernels take pairs. */
static void EW_LOCAL(sum_tile)(const EW_LOCAL(batch) *b, const EW_LOCAL(lanes) *lanes,
	EW_REAL *sum)
{
	EW_ALIGNED EW_REAL x[EW_TILE * EW_WIDTH];
	EW_ALIGNED EW_REAL y[EW_TILE * EW_WIDTH];
	const size_t width = b->by->width, longest = lanes->longest;
	const size_t items = (longest + 3 - (size_t)ew_ring_shapes[b->id].window) / 2 * 2;
	const size_t furthest = (size_t)b->offsets[b->first + b->count - 1];
	if (furthest + longest + 3 <= (size_t)b->offsets[b->rings] && !b->moved) {
		b->by->gather(b->x, b->y, lanes, x, y);
	} else {
		EW_LOCAL(gather_slowly)(b->x, lanes, width, b->moved, x);
		EW_LOCAL(gather_slowly)(b->y, lanes, width, b->moved, y);
	}
	b->run(x, y, x, width, width, items * width, sum);
}

/* Up to a group of rings. */
static void EW_LOCAL(sum_group)(EW_LOCAL(batch) *b)
{
	const size_t cells = (size_t)ew_ring_shapes[b->id].accumulators * EW_WIDTH;
	const int32_t *start = b->offsets + b->first;
	EW_LOCAL(lanes) lanes;
	EW_ALIGNED EW_REAL sum[EW_MAX_ACCUMULATORS * EW_WIDTH];
	b->by->clear(sum, cells);
	EW_LOCAL(fit)(b->x, b->y, start, b->count, b->by->width, &lanes);
	if (lanes.longest)
		EW_LOCAL(sum_tile)(b, &lanes, sum);
	for (size_t l = 0; l < b->count; ++l) {
		const int left_out = !(lanes.length[l] > 0);
		sum[l] = left_out ? (EW_REAL)NAN : sum[l];
		if (b->moved) {
			b->sum[cells + l] = left_out ? 0 : (double)b->x[start[l]];
			b->sum[cells + EW_WIDTH + l] = left_out ? 0 : (double)b->y[start[l]];
		}
	}
	b->not_finite = !b->by->widen(sum, cells, b->sum);
}

static int EW_LOCAL(is_off)(const EW_LOCAL(batch) *b, size_t ring)
{
	double off = 0;
	for (int j = 0; j < ew_ring_shapes[b->id].outputs && off == 0; ++j) {
		const double result = b->result[(size_t)j * b->stride + ring];
		off = result - result;
	}
	return off != 0;
}

/* The rings whose results are not finite: left out, or what stands behind their last vertex did not
 * add 0, as it does as long as nothing overflows. */
static void EW_LOCAL(run_single)(EW_LOCAL(batch) *b)
{
	const ew_ring_shape *shape = &ew_ring_shapes[b->id];
	double one[EW_MAX_OUTPUTS], off = 0;
	for (size_t l = 0; l < b->count; ++l) {
		if (!EW_LOCAL(is_off)(b, l))
			continue;
		EW_LOCAL(vertices) v = EW_LOCAL(ring_vertices)(b, b->first + l);
		if (b->moved && v.n) {
			EW_LOCAL(move_to_first)(&v);
			b->sum[(size_t)shape->accumulators * b->stride + l] = (double)v.cx;
			b->sum[(size_t)(shape->accumulators + 1) * b->stride + l] = (double)v.cy;
		}
		EW_LOCAL(integrate)(b->id, &v, one);
		for (int j = 0; j < shape->outputs; ++j)
			b->result[(size_t)j * b->stride + l] = one[j];
		for (int j = 0; j < shape->outputs; ++j)
			off += one[j] - one[j];
	}
	b->not_finite = off != 0;
}

/* The next row, 0 when no ring is left. */
static int EW_LOCAL(next_row)(EW_LOCAL(batch) *b)
{
	const size_t first = b->first + b->count, left = b->rings - first;
	b->first = first;
	b->stride = EW_ROW;
	b->not_finite = 0;
	b->count = left && b->side ? b->side(b->x, b->y, b->offsets + first,
		left < EW_ROW ? left : (size_t)EW_ROW, (size_t)b->offsets[b->rings], b->sum,
		&b->not_finite) : 0;
	if (left && b->count == 0) {
		b->count = left < b->by->width ? left : b->by->width;
		b->stride = EW_WIDTH;
		EW_LOCAL(sum_group)(b);
	}
	for (size_t l = 0; l < b->count; l += b->finished)
		b->finish(b->sum + l, b->result + l, b->stride);
	if (b->not_finite)
		EW_LOCAL(run_single)(b);
	return b->count != 0;
}

static void EW_LOCAL(begin)(EW_LOCAL(batch) *b, int degree, int moved, const EW_REAL *x,
	const EW_REAL *y, const int32_t *offsets, size_t rings)
{
	b->target = ew_cpu_target();
	b->x = x;
	b->y = y;
	b->offsets = offsets;
	b->rings = rings;
	b->id = EW_RING_MOMENTS_0 + degree;
	b->moved = moved;
	b->run = EW_LOCAL(kernel)(b->id, b->target);
	b->finish = ew_ring_finish_columns(b->target, degree, &b->finished);
	b->by = EW_LOCAL(by_columns)(b->target);
	b->side = moved ? b->by->centroid : degree < EW_SIDES ? b->by->side[degree] : NULL;
	b->first = b->count = 0;
}

/* One ring after the other, on targets that have no vectors. */
static void EW_LOCAL(moments_one_by_one)(const EW_LOCAL(batch) *b, int degree, EW_REAL *out)
{
	for (size_t i = 0; i < b->rings; ++i, out += EW_MOMENTS(degree)) {
		EW_LOCAL(vertices) v = EW_LOCAL(ring_vertices)(b, i);
		EW_LOCAL(all_moments)(degree, &v, out);
	}
}

EW_INLINE EW_REAL *EW_LOCAL(put)(const double *result, size_t rings, size_t outputs, size_t stride,
	EW_REAL *to)
{
#define EW_PUT(j) \
	if (j < outputs) \
		to[j] = (EW_REAL)result[j * stride];
	for (const double *end = result + rings; result < end; ++result, to += outputs) {
		EW_PUT(0) EW_PUT(1) EW_PUT(2) EW_PUT(3) EW_PUT(4) EW_PUT(5)
		for (size_t j = 6; j < outputs; ++j)
			to[j] = (EW_REAL)result[j * stride];
	}
#undef EW_PUT
	return to;
}

/* Of a row; known numbers are faster. */
static EW_REAL *EW_LOCAL(put_moments)(const EW_LOCAL(batch) *b, EW_REAL *to)
{
	const size_t outputs = (size_t)ew_ring_shapes[b->id].outputs;
	if (b->stride == EW_ROW && outputs == 1)
		return EW_LOCAL(put)(b->result, b->count, 1, EW_ROW, to);
	if (b->stride == EW_ROW && outputs == 3)
		return EW_LOCAL(put)(b->result, b->count, 3, EW_ROW, to);
	if (b->stride == EW_ROW && outputs == 6)
		return EW_LOCAL(put)(b->result, b->count, 6, EW_ROW, to);
	return EW_LOCAL(put)(b->result, b->count, outputs, b->stride, to);
}

int EW_NAME(moments_rings)(int degree, const EW_REAL *x, const EW_REAL *y, const int32_t *offsets,
	size_t rings, EW_REAL *out)
{
	if (degree < 0 || degree > EW_MAX_DEGREE)
		return EW_BAD_DEGREE;
	if (ew_ring_bad_offsets(offsets, rings))
		return EW_BAD_OFFSETS;
	EW_LOCAL(batch) b;
	EW_LOCAL(begin)(&b, degree, 0, x, y, offsets, rings);
	if (b.by->width == 1)
		EW_LOCAL(moments_one_by_one)(&b, degree, out);
	else
		while (EW_LOCAL(next_row)(&b))
			out = EW_LOCAL(put_moments)(&b, out);
	return EW_OK;
}

int EW_NAME(area_rings)(const EW_REAL *x, const EW_REAL *y, const int32_t *offsets, size_t rings,
	EW_REAL *out)
{
	return EW_NAME(moments_rings)(0, x, y, offsets, rings, out);
}

#if EW_MAX_DEGREE >= 1
static void EW_LOCAL(one_centroid)(const EW_LOCAL(batch) *b, size_t ring, EW_REAL *cx, EW_REAL *cy)
{
	EW_LOCAL(vertices) v = EW_LOCAL(ring_vertices)(b, ring);
	EW_REAL c[2];
	EW_LOCAL(centroid_of)(&v, c);
	cx[ring] = c[0];
	cy[ring] = c[1];
}

/* Are all areas of a row far from overflow and underflow? */
static int EW_LOCAL(row_is_safe)(const EW_LOCAL(batch) *b)
{
	double least = 1, most = 1;
	for (size_t l = 0; l < b->count; ++l) {
		const double size = fabs(b->result[l]);
		least = size < least ? size : least;
		most = size > most ? size : most;
	}
	return !b->not_finite && least > 1 / EW_SAFE && most < EW_SAFE;
}

static void EW_LOCAL(put_centroids)(const EW_LOCAL(batch) *b, EW_REAL *cx, EW_REAL *cy)
{
	EW_ALIGNED double c[2 * EW_ROW];
	const double *area = b->result, *x = area + b->stride, *y = x + b->stride;
	const double *first = b->sum + 3 * b->stride;
	b->by->divide(x, area, first, b->count, c);
	b->by->divide(y, area, first + b->stride, b->count, c + EW_ROW);
	EW_LOCAL(put)(c, b->count, 1, EW_ROW, cx + b->first);
	EW_LOCAL(put)(c + EW_ROW, b->count, 1, EW_ROW, cy + b->first);
	if (EW_LOCAL(row_is_safe)(b))
		return;
	for (size_t l = 0; l < b->count; ++l)
		if (!EW_LOCAL(is_safe)(area[l], x[l], y[l]))
			EW_LOCAL(one_centroid)(b, b->first + l, cx, cy);
}

int EW_NAME(centroid_rings)(const EW_REAL *x, const EW_REAL *y, const int32_t *offsets,
	size_t rings, EW_REAL *cx, EW_REAL *cy)
{
	if (ew_ring_bad_offsets(offsets, rings))
		return EW_BAD_OFFSETS;
	EW_LOCAL(batch) b;
	EW_LOCAL(begin)(&b, 1, 1, x, y, offsets, rings);
	if (b.by->width == 1)
		for (size_t i = 0; i < rings; ++i)
			EW_LOCAL(one_centroid)(&b, i, cx, cy);
	else
		while (EW_LOCAL(next_row)(&b))
			EW_LOCAL(put_centroids)(&b, cx, cy);
	return EW_OK;
}
#endif

/* edgewise_raster_lanes.h - short edges cut into pieces four at a time, and pieces put into the
 * difference image, by AVX2; part of edgewise_raster.c.
 *
 * Each lane goes along an edge of its own, a cell per step, to where it leaves the cell; a lane
 * that has arrived stays and adds nothing. Edges that are long or partly out of the image are done
 * alone: both ways give the same bits.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#define EW_ATTRIBUTE EW_ATTRIBUTE_AVX2
#define EW_VECTOR __m256d
#define EW_SPLAT(a) _mm256_set1_pd(a)
#define EW_LOAD(p) _mm256_loadu_pd(p)
#define EW_LOAD_FLOATS(p) _mm256_cvtps_pd(_mm_loadu_ps(p))
#define EW_STORE(p, v) _mm256_storeu_pd(p, v)
#define EW_ADD(a, b) _mm256_add_pd(a, b)
#define EW_SUB(a, b) _mm256_sub_pd(a, b)
#define EW_MUL(a, b) _mm256_mul_pd(a, b)
#define EW_DIV(a, b) _mm256_div_pd(a, b)
#define EW_MIN(a, b) _mm256_min_pd(a, b)
#define EW_MAX(a, b) _mm256_max_pd(a, b)
#define EW_FLOOR(a) _mm256_floor_pd(a)
#define EW_GREATER(a, b) _mm256_cmp_pd(a, b, _CMP_GT_OQ)
#define EW_NOT_LESS(a, b) _mm256_cmp_pd(a, b, _CMP_GE_OQ)
#define EW_AND(a, b) _mm256_and_pd(a, b)
#define EW_AND_NOT(a, b) _mm256_andnot_pd(b, a)
#define EW_OR(a, b) _mm256_or_pd(a, b)
#define EW_XOR(a, b) _mm256_xor_pd(a, b)
#define EW_SELECT(mask, a, b) _mm256_blendv_pd(b, a, mask)
#define EW_BITS(mask) ((unsigned)_mm256_movemask_pd(mask))
#define EW_PLACES(v) _mm256_cvtepi32_epi64(_mm256_cvtpd_epi32(v))
#define EW_MOVE(places, mask, step) \
	_mm256_add_epi64(places, _mm256_and_si256(_mm256_castpd_si256(mask), step))

#define EW_TO_FRONT(v, front) _mm256_castps_pd(_mm256_permutevar8x32_ps(_mm256_castpd_ps(v), front))

/* ---- vertices ---- */

EW_ATTRIBUTE EW_INLINE EW_VECTOR ew_raster_round_lanes(EW_VECTOR v, const ew_raster_axis *axis,
	EW_VECTOR *in_range, EW_VECTOR *within)
{
	const EW_VECTOR to_grid = EW_SPLAT(EW_TO_GRID);
	*in_range = EW_AND(*in_range, EW_AND(EW_NOT_LESS(EW_SPLAT(EW_FURTHEST), v),
		EW_NOT_LESS(v, EW_SPLAT(-EW_FURTHEST))));
	*within = EW_AND(*within, EW_AND(EW_NOT_LESS(v, EW_SPLAT(axis->low)),
		EW_NOT_LESS(EW_SPLAT(axis->high), v)));
	return EW_SUB(EW_ADD(EW_SUB(v, EW_SPLAT(axis->origin)), to_grid), to_grid);
}

/* Rounds points to the grid, and repeats the last one until the lanes are full. */
#define EW_ROUND(f, real, LOAD_REAL) \
EW_ATTRIBUTE static unsigned ew_raster_round##f##_avx2(const ew_raster_image *image, \
	const real *x, const real *y, size_t count, double *to_x, double *to_y) \
{ \
	EW_VECTOR in_range = EW_NOT_LESS(EW_SPLAT(0.0), EW_SPLAT(0.0)), within = in_range; \
	real rest_x[4], rest_y[4]; \
	for (size_t i = 0; i < count; i += 4) { \
		const real *from_x = x + i, *from_y = y + i; \
		if (i + 4 > count) { \
			for (size_t k = 0; k < 4; ++k) { \
				const size_t from = i + k < count ? i + k : count - 1; \
				rest_x[k] = x[from]; \
				rest_y[k] = y[from]; \
			} \
			from_x = rest_x; \
			from_y = rest_y; \
		} \
		EW_STORE(to_x + i, ew_raster_round_lanes(LOAD_REAL(from_x), &image->x, &in_range, \
			&within)); \
		EW_STORE(to_y + i, ew_raster_round_lanes(LOAD_REAL(from_y), &image->y, &in_range, \
			&within)); \
	} \
	return (unsigned)(EW_BITS(in_range) == 0xf ? EW_IN_RANGE : 0) \
		| (unsigned)(EW_BITS(within) == 0xf ? EW_WITHIN : 0); \
}
EW_ROUND(, double, EW_LOAD)
EW_ROUND(f, float, EW_LOAD_FLOATS)
#undef EW_ROUND

/* ---- pieces ---- */

/* Numbers of the wider masks, or integers of the width of the narrower ones. */
EW_ATTRIBUTE EW_INLINE __m128 ew_raster_narrow(EW_VECTOR mask)
{
	return _mm_shuffle_ps(_mm_castpd_ps(_mm256_castpd256_pd128(mask)),
		_mm_castpd_ps(_mm256_extractf128_pd(mask, 1)), 0x88);
}

/* total: what pieces add in both rows, nearer: what they add in the one where they begin. */
EW_ATTRIBUTE EW_INLINE void ew_raster_deposit_lanes(const ew_raster_image *image, __m256i place,
	__m128i total, __m128i nearer, __m128 up)
{
	EW_ALIGNED int64_t places[4];
	EW_ALIGNED int32_t parts[8];
	const __m128i upper = _mm_castps_si128(_mm_blendv_ps(_mm_castsi128_ps(nearer),
		_mm_castsi128_ps(_mm_sub_epi32(total, nearer)), up));
	const int64_t *at = places;
	const int32_t *part = parts;
	int32_t *const sum = image->sum, *const next = sum + image->stride;
	_mm256_store_si256((__m256i *)(void *)places, place);
	_mm_store_si128((__m128i *)(void *)parts, upper);
	_mm_store_si128((__m128i *)(void *)(parts + 4), _mm_sub_epi32(total, upper));
	EW_HIDE(at);                   /* or compilers take the lanes out of registers: slower */
	EW_HIDE(part);
#define EW_DEPOSIT(l) { \
		const int64_t cell = at[l]; \
		const int32_t lower = part[4 + (l)]; \
		ew_raster_add(sum + cell, part[l]); \
		ew_raster_add(next + cell, lower); \
	}
	EW_DEPOSIT(0)
	EW_DEPOSIT(1)
	EW_DEPOSIT(2)
	EW_DEPOSIT(3)
#undef EW_DEPOSIT
}

/* Moves the lanes of a mask to the front. */
static const int32_t ew_raster_front[16][4] = {
	{ 0, 0, 0, 0 }, { 0, 0, 0, 0 }, { 1, 0, 0, 0 }, { 0, 1, 0, 0 },
	{ 2, 0, 0, 0 }, { 0, 2, 0, 0 }, { 1, 2, 0, 0 }, { 0, 1, 2, 0 },
	{ 3, 0, 0, 0 }, { 0, 3, 0, 0 }, { 1, 3, 0, 0 }, { 0, 1, 3, 0 },
	{ 2, 3, 0, 0 }, { 0, 2, 3, 0 }, { 1, 2, 3, 0 }, { 0, 1, 2, 3 }
};
static const int32_t ew_raster_front_wide[16][8] = {
	{ 0, 1, 0, 1, 0, 1, 0, 1 }, { 0, 1, 0, 1, 0, 1, 0, 1 },
	{ 2, 3, 0, 1, 0, 1, 0, 1 }, { 0, 1, 2, 3, 0, 1, 0, 1 },
	{ 4, 5, 0, 1, 0, 1, 0, 1 }, { 0, 1, 4, 5, 0, 1, 0, 1 },
	{ 2, 3, 4, 5, 0, 1, 0, 1 }, { 0, 1, 2, 3, 4, 5, 0, 1 },
	{ 6, 7, 0, 1, 0, 1, 0, 1 }, { 0, 1, 6, 7, 0, 1, 0, 1 },
	{ 2, 3, 6, 7, 0, 1, 0, 1 }, { 0, 1, 2, 3, 6, 7, 0, 1 },
	{ 4, 5, 6, 7, 0, 1, 0, 1 }, { 0, 1, 4, 5, 6, 7, 0, 1 },
	{ 2, 3, 4, 5, 6, 7, 0, 1 }, { 0, 1, 2, 3, 4, 5, 6, 7 }
};
static const unsigned char ew_raster_number[16] = {
	0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4
};

/* Pieces that have a width wait. (u, v) of their ends in their cells, of turned over edges yet. */
EW_ATTRIBUTE EW_INLINE void ew_raster_wait_lanes(const ew_raster_image *image, __m256i place,
	EW_VECTOR u0, EW_VECTOR u1, EW_VECTOR v0, EW_VECTOR v1, EW_VECTOR up, EW_VECTOR leftwards)
{
	ew_raster_pieces *p = image->pieces;
	const unsigned wide = EW_BITS(EW_GREATER(u1, u0));
	const __m128i front = _mm_loadu_si128((const __m128i *)(const void *)ew_raster_front[wide]);
	const EW_VECTOR one = EW_SPLAT(1.0);
	v0 = EW_SELECT(up, EW_SUB(one, v0), v0);
	v1 = EW_SELECT(up, EW_SUB(one, v1), v1);
#define EW_WAIT(to, v) \
	_mm_storeu_ps(to + p->count, _mm_permutevar_ps(_mm256_cvtpd_ps(v), front));
	EW_WAIT(p->x, EW_SELECT(leftwards, u1, u0))
	EW_WAIT(p->x + EW_PIECES, EW_SELECT(leftwards, u0, u1))
	EW_WAIT(p->y, EW_SELECT(leftwards, v1, v0))
	EW_WAIT(p->y + EW_PIECES, EW_SELECT(leftwards, v0, v1))
#undef EW_WAIT
	_mm_storeu_si128((__m128i *)(void *)(p->place + p->count), _mm_castps_si128(
		_mm_permutevar_ps(ew_raster_narrow(_mm256_castsi256_pd(place)), front)));
	p->count += ew_raster_number[wide];
	if (p->count > EW_PIECES - 4)
		ew_raster_flush(image);
}

/* Integers of 8 pieces in up to four columns of a row, from a vector for each column to four
 * numbers for each piece, or two if there are no more columns. */
EW_ATTRIBUTE EW_INLINE void ew_raster_turn(const __m256i *value, size_t columns, int32_t *to)
{
	const __m256i low = _mm256_unpacklo_epi32(value[0], value[1]);
	const __m256i high = _mm256_unpackhi_epi32(value[0], value[1]);
	__m128i *row = (__m128i *)(void *)to;
	if (columns <= 2) {
		_mm_store_si128(row, _mm256_castsi256_si128(low));
		_mm_store_si128(row + 1, _mm256_castsi256_si128(high));
		_mm_store_si128(row + 2, _mm256_extracti128_si256(low, 1));
		_mm_store_si128(row + 3, _mm256_extracti128_si256(high, 1));
	} else {
		const __m256i low2 = _mm256_unpacklo_epi32(value[2], value[3]);
		const __m256i high2 = _mm256_unpackhi_epi32(value[2], value[3]);
#define EW_TURNED(k, v) { \
			const __m256i rows = v; \
			_mm_store_si128(row + k, _mm256_castsi256_si128(rows)); \
			_mm_store_si128(row + 4 + k, _mm256_extracti128_si256(rows, 1)); \
		}
		EW_TURNED(0, _mm256_unpacklo_epi64(low, low2))
		EW_TURNED(1, _mm256_unpackhi_epi64(low, low2))
		EW_TURNED(2, _mm256_unpacklo_epi64(high, high2))
		EW_TURNED(3, _mm256_unpackhi_epi64(high, high2))
#undef EW_TURNED
	}
}

/* Adds columns m .. m + columns - 1 of all pieces. Neighbours among them are mostly neighbours in
 * the image too, and a load waits for a store that it overlaps in part: so they are not added one
 * after the other. */
EW_ATTRIBUTE EW_INLINE void ew_raster_scatter_columns(const ew_raster_image *image, size_t size,
	size_t m, size_t columns)
{
	enum { APART = 8 };
	EW_ALIGNED int32_t turned[(EW_DEPOSIT_SIZE + 1) * EW_PIECES * 4];
	const ew_raster_pieces *p = image->pieces;
	const size_t wide = columns > 2 ? 4 : 2, reach = wide * EW_PIECES, middle = size / 2;
	for (size_t i = 0; i < p->count; i += 8) {
		const float *from = p->out + m * EW_PIECES + i;
		int32_t *to = turned + i * wide;
		__m256i value[4], rest[4];
		for (size_t c = 0; c < 4; ++c)
			value[c] = rest[c] = c < columns ? _mm256_cvtps_epi32(_mm256_load_ps(from
				+ (middle * size + c) * EW_PIECES)) : _mm256_setzero_si256();
		for (size_t r = 0; r <= size; ++r) {
			if (r == middle)
				continue;
			for (size_t c = 0; c < columns; ++c) {
				value[c] = _mm256_cvtps_epi32(_mm256_load_ps(from
					+ (r * size + c) * EW_PIECES));
				rest[c] = _mm256_sub_epi32(rest[c], value[c]);
			}
			ew_raster_turn(value, columns, to + r * reach);
		}
		ew_raster_turn(rest, columns, to + middle * reach);
	}
	for (size_t start = 0; start < APART; ++start)
		for (size_t i = start; i < p->count; i += APART) {
			int32_t *to = image->sum + p->place[i] + m;
			const int32_t *from = turned + i * wide;
			for (size_t r = 0; r <= size; ++r, to += image->stride, from += reach) {
				__m128i *at = (__m128i *)(void *)to;
				const __m128i *add = (const __m128i *)(const void *)from;
				if (columns > 2)
					_mm_storeu_si128(at, _mm_add_epi32(_mm_loadu_si128(at),
						_mm_load_si128(add)));
				else
					_mm_storel_epi64(at, _mm_add_epi32(_mm_loadl_epi64(at),
						_mm_loadl_epi64(add)));
			}
		}
}

EW_ATTRIBUTE EW_INLINE void ew_raster_scatter_size(const ew_raster_image *image, size_t size)
{
	for (size_t m = 0; m < size; m += 4)
		ew_raster_scatter_columns(image, size, m, size - m < 4 ? size - m : 4);
}

EW_ATTRIBUTE static void ew_raster_scatter_avx2(const ew_raster_image *image)
{
	switch (image->size) {
	case 1: ew_raster_scatter_size(image, 1); break;
	case 2: ew_raster_scatter_size(image, 2); break;
	case 3: ew_raster_scatter_size(image, 3); break;
	case 4: ew_raster_scatter_size(image, 4); break;
	default: ew_raster_scatter_size(image, (size_t)image->size);
	}
}

/* ---- edges ---- */

/* All is relative to the left end, and abscissas have EW_TO_GRID added; an edge that goes up is
 * turned over. (right, below) are the lines of the grid ahead, (sx, sy) is where a piece starts,
 * and an edge crosses `right` if it would leave its row beyond it. */
EW_ATTRIBUTE EW_INLINE void ew_raster_walk_lanes(const ew_raster_image *image, size_t start,
	int box)
{
	const EW_VECTOR one = EW_SPLAT(1.0), to_grid = EW_SPLAT(EW_TO_GRID), minus = EW_SPLAT(-0.0);
	const EW_VECTOR stride = EW_SPLAT((double)image->stride);
	const EW_VECTOR origin = EW_SPLAT((double)image->stride * (1 - image->first) + 1);
	const ew_raster_short *edges = image->edges;
	const EW_VECTOR xp = EW_LOAD(edges->px + start), yp = EW_LOAD(edges->py + start);
	const EW_VECTOR xq = EW_LOAD(edges->qx + start), yq = EW_LOAD(edges->qy + start);
	const EW_VECTOR leftwards = EW_GREATER(xp, xq), sign = EW_AND(leftwards, minus);
	const EW_VECTOR ya = EW_SELECT(leftwards, yq, yp), yb = EW_SELECT(leftwards, yp, yq);
	const EW_VECTOR up = EW_GREATER(ya, yb), turn = EW_AND(up, minus);
	const EW_VECTOR x0 = EW_MIN(xp, xq), dx = EW_SUB(EW_MAX(xp, xq), x0);
	const EW_VECTOR y0 = EW_XOR(ya, turn), dy = EW_SUB(EW_XOR(yb, turn), y0);
	const EW_VECTOR across = EW_DIV(dx, dy), along = EW_DIV(dy, dx);
	const EW_VECTOR whole = EW_XOR(EW_SPLAT(EW_ONE), sign), half = EW_MUL(whole, EW_SPLAT(0.5));
	const EW_VECTOR i0 = EW_FLOOR(x0), j0 = EW_FLOOR(y0), step = EW_XOR(stride, turn);
	const EW_VECTOR end = EW_ADD(dx, to_grid);
	const __m256i to_column = EW_PLACES(one), to_row = EW_PLACES(step);
	__m256i place = EW_PLACES(EW_ADD(EW_SUB(EW_ADD(i0, origin), EW_AND(up, stride)),
		EW_MUL(step, j0)));
	EW_VECTOR right = EW_ADD(EW_SUB(one, EW_SUB(x0, i0)), to_grid);
	EW_VECTOR below = EW_SUB(one, EW_SUB(y0, j0));
	EW_VECTOR sx = to_grid, sy = EW_SPLAT(0.0);
	unsigned more;
	do {
		const EW_VECTOR out_x = EW_MIN(EW_ADD(EW_MUL(below, across), to_grid), end);
		const EW_VECTOR out_y = EW_MIN(below, dy);
		const EW_VECTOR sideways = EW_GREATER(out_x, right);
		const EW_VECTOR down = EW_AND_NOT(EW_GREATER(dy, below), sideways);
		const EW_VECTOR at = EW_SUB(EW_ADD(EW_MUL(EW_SUB(right, to_grid), along), to_grid),
			to_grid);
		const EW_VECTOR tx = EW_MIN(out_x, right);
		const EW_VECTOR ty = EW_SELECT(sideways, EW_MAX(EW_MIN(at, out_y), sy), out_y);
		if (box) {
			const EW_VECTOR width = EW_SUB(tx, sx);
			const EW_VECTOR part = EW_ADD(EW_SUB(below, sy), EW_SUB(below, ty));
			ew_raster_deposit_lanes(image, place,
				_mm256_cvtpd_epi32(EW_MUL(width, whole)),
				_mm256_cvtpd_epi32(EW_MUL(EW_MUL(width, half), part)),
				ew_raster_narrow(up));
		} else {
			const EW_VECTOR left = EW_SUB(right, one), above = EW_SUB(below, one);
			ew_raster_wait_lanes(image, place, EW_SUB(sx, left), EW_SUB(tx, left),
				EW_SUB(sy, above), EW_SUB(ty, above), up, leftwards);
		}
		sx = tx;
		sy = ty;
		more = EW_BITS(EW_OR(sideways, down));
		right = EW_ADD(right, EW_AND(sideways, one));
		below = EW_ADD(below, EW_AND(down, one));
		place = EW_MOVE(EW_MOVE(place, sideways, to_column), down, to_row);
	} while (more);
}

/* The short edges that wait; points to fill the lanes. */
EW_ATTRIBUTE static void ew_raster_finish_avx2(const ew_raster_image *image)
{
	ew_raster_short *edges = image->edges;
	const size_t count = edges->count;
	for (size_t i = count; i % 4; ++i) {
		edges->px[i] = edges->qx[i] = 0;
		edges->py[i] = edges->qy[i] = image->first;
	}
	edges->count = 0;
	if (image->pieces)
		for (size_t i = 0; i < count; i += 4)
			ew_raster_walk_lanes(image, i, 0);
	else
		for (size_t i = 0; i < count; i += 4)
			ew_raster_walk_lanes(image, i, 1);
}

/* Which edges are not partly out of the image or its band. */
EW_ATTRIBUTE EW_INLINE EW_VECTOR ew_raster_inside(const ew_raster_image *image, EW_VECTOR left,
	EW_VECTOR right, EW_VECTOR top, EW_VECTOR bottom)
{
	const EW_VECTOR last = EW_SPLAT(image->last);
	return EW_AND(EW_AND(EW_NOT_LESS(left, EW_SPLAT(0.0)),
		EW_NOT_LESS(EW_SPLAT(image->columns), right)),
		EW_AND(EW_NOT_LESS(top, EW_SPLAT(image->first)),
		EW_AND(EW_GREATER(last, top), EW_NOT_LESS(last, bottom))));
}

EW_ATTRIBUTE static void ew_raster_touch_lanes(const ew_raster_image *image, EW_VECTOR left,
	EW_VECTOR right, EW_VECTOR top, EW_VECTOR bottom, unsigned used)
{
	EW_ALIGNED int32_t lane[4][4];
	_mm_store_si128((__m128i *)(void *)lane[0], _mm256_cvttpd_epi32(left));
	_mm_store_si128((__m128i *)(void *)lane[1], _mm256_cvttpd_epi32(right));
	_mm_store_si128((__m128i *)(void *)lane[2], _mm256_cvttpd_epi32(top));
	_mm_store_si128((__m128i *)(void *)lane[3], _mm256_cvttpd_epi32(bottom));
	for (int l = 0; used >> l; ++l)
		for (int j = lane[2][l]; used >> l & 1 && j <= lane[3][l] && j < image->last; ++j)
			ew_raster_touch(image, (size_t)(j - image->first + 1), lane[0][l] + 1,
				lane[1][l] + 1);
}

/* Puts short edges inside the image with those that wait, does others alone, and drops vertical
 * ones. The edges are followed by points that fill the lanes. */
EW_ATTRIBUTE static void ew_raster_edges_avx2(const ew_raster_image *image, const double *px,
	const double *py, const double *qx, const double *qy, size_t count, int clip)
{
	const EW_VECTOR minus = EW_SPLAT(-0.0), most = EW_SPLAT(EW_SHORT_EDGE);
	ew_raster_short *edges = image->edges;
	for (size_t i = 0; i < count; i += 4) {
		const EW_VECTOR xp = EW_LOAD(px + i), yp = EW_LOAD(py + i);
		const EW_VECTOR xq = EW_LOAD(qx + i), yq = EW_LOAD(qy + i);
		const EW_VECTOR width = EW_AND_NOT(EW_SUB(xq, xp), minus);
		const EW_VECTOR size = EW_ADD(width, EW_AND_NOT(EW_SUB(yq, yp), minus));
		const EW_VECTOR wide = EW_GREATER(width, EW_SPLAT(0.0));
		EW_VECTOR used = EW_AND(wide, EW_GREATER(most, size));
		if (clip) {
			const EW_VECTOR left = EW_MIN(xp, xq), right = EW_MAX(xp, xq);
			const EW_VECTOR top = EW_MIN(yp, yq), bottom = EW_MAX(yp, yq);
			used = EW_AND(used, ew_raster_inside(image, left, right, top, bottom));
			if (image->touched)
				ew_raster_touch_lanes(image, left, right, top, bottom,
					EW_BITS(used));
		}
		const unsigned chosen = EW_BITS(used);
		unsigned alone = EW_BITS(wide) & ~chosen;
		const __m256i front = _mm256_loadu_si256((const __m256i *)(const void *)
			ew_raster_front_wide[chosen]);
		EW_STORE(edges->px + edges->count, EW_TO_FRONT(xp, front));
		EW_STORE(edges->py + edges->count, EW_TO_FRONT(yp, front));
		EW_STORE(edges->qx + edges->count, EW_TO_FRONT(xq, front));
		EW_STORE(edges->qy + edges->count, EW_TO_FRONT(yq, front));
		edges->count += ew_raster_number[chosen];
		if (edges->count > EW_POINTS)
			ew_raster_finish_avx2(image);
		for (size_t l = i; alone; ++l, alone >>= 1)
			if (alone & 1)
				ew_raster_edge_alone(image, px[l], py[l], qx[l], qy[l], clip);
	}
}

#undef EW_ATTRIBUTE
#undef EW_SPLAT
#undef EW_LOAD
#undef EW_LOAD_FLOATS
#undef EW_STORE
#undef EW_ADD
#undef EW_SUB
#undef EW_MUL
#undef EW_DIV
#undef EW_MIN
#undef EW_MAX
#undef EW_FLOOR
#undef EW_GREATER
#undef EW_NOT_LESS
#undef EW_AND
#undef EW_AND_NOT
#undef EW_OR
#undef EW_XOR
#undef EW_SELECT
#undef EW_BITS
#undef EW_PLACES
#undef EW_MOVE
#undef EW_VECTOR
#undef EW_TO_FRONT

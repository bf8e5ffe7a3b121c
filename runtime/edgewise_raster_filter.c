/* edgewise_raster_filter.c - edges into a difference image, by the deposits of a filter.
 *
 * In coordinates moved by the corner of the filter's support, cell (column, row) of the grid adds to
 * columns `column` to column + N - 1 and rows `row` to row + N of the difference image; column
 * i + N - 1 and row j + N - 1 of it are those of pixel (i,j), which is the running sum down its
 * column, in units of the filter.
 *
 * An edge is cut at the lines of the grid from its left end, whatever its direction; where it
 * crosses a line is computed from that end, so that nothing drifts and the reverse edge has the same
 * pieces. Abscissas within a cell are rounded to 2^-23, a crossing once for the pieces on both
 * sides. Above the image only the totals of columns count: they go to the first row. Pieces are
 * collected, and deposits made of many at a time; all are integers, so the order does not matter.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#include "edgewise_runtime.h"

#ifdef EW_HAS_FILTERS

#include <string.h>

#if EW_X86
#include <emmintrin.h>
#endif

#define EW_SNAP 0x1.8p29               /* a + EW_SNAP - EW_SNAP: a to a multiple of 2^-23 */

/* To the nearest integer, ties to even. */
EW_INLINE int32_t ew_deposit_integer(float value)
{
	return (int32_t)(((double)value + 0x1.8p52) - 0x1.8p52);
}

/* From out[(r N + m) reach + i] to to[(r pieces + i) 4 + m], as integers; N <= 4. */
static void ew_deposit_turn(const float *out, int size, size_t count, int32_t *to)
{
	for (size_t i = 0; i < count; i += 4) {
		for (int r = 0; r <= size; ++r) {
			const float *from = out + (size_t)(r * size) * EW_PIECES + i;
			int32_t *quad = to + ((size_t)r * EW_PIECES + i) * 4;
#if EW_X86
			__m128 a = _mm_loadu_ps(from);
			__m128 b = size > 1 ? _mm_loadu_ps(from + EW_PIECES) : _mm_setzero_ps();
			__m128 c = size > 2 ? _mm_loadu_ps(from + 2 * EW_PIECES) : _mm_setzero_ps();
			__m128 d = size > 3 ? _mm_loadu_ps(from + 3 * EW_PIECES) : _mm_setzero_ps();
			_MM_TRANSPOSE4_PS(a, b, c, d);
			_mm_storeu_si128((__m128i *)(void *)quad, _mm_cvtps_epi32(a));
			_mm_storeu_si128((__m128i *)(void *)(quad + 4), _mm_cvtps_epi32(b));
			_mm_storeu_si128((__m128i *)(void *)(quad + 8), _mm_cvtps_epi32(c));
			_mm_storeu_si128((__m128i *)(void *)(quad + 12), _mm_cvtps_epi32(d));
#else
			for (int l = 0; l < 4; ++l)
				for (int m = 0; m < 4; ++m)
					quad[4 * l + m] = m < size
						? ew_deposit_integer(from[m * EW_PIECES + l]) : 0;
#endif
		}
	}
}

EW_INLINE void ew_deposit_add(int32_t *to, const int32_t *quad)
{
#if EW_X86
	__m128i *place = (__m128i *)(void *)to;
	_mm_storeu_si128(place, _mm_add_epi32(_mm_loadu_si128(place),
		_mm_loadu_si128((const __m128i *)(const void *)quad)));
#else
	for (int m = 0; m < 4; ++m)
		to[m] += quad[m];
#endif
}

EW_INLINE void ew_deposit_subtract(int32_t *from, const int32_t *quad)
{
#if EW_X86
	__m128i *place = (__m128i *)(void *)from;
	_mm_storeu_si128(place, _mm_sub_epi32(_mm_loadu_si128(place),
		_mm_loadu_si128((const __m128i *)(const void *)quad)));
#else
	for (int m = 0; m < 4; ++m)
		from[m] -= quad[m];
#endif
}

/* Neighbours in the list are mostly neighbours in the image, whose stores a load of the next one
 * would have to wait for: so they are not added one after the other. */
static void ew_deposit_narrow(ew_deposits *d, size_t count, const float *out)
{
	enum { APART = 8 };
	int32_t quad[5 * EW_PIECES * 4];
	ew_deposit_turn(out, d->size, count, quad);
	for (int r = 0; r < d->size; ++r)
		for (size_t i = 0; i < count; ++i)
			ew_deposit_subtract(quad + 4 * ((size_t)d->size * EW_PIECES + i),
				quad + 4 * ((size_t)r * EW_PIECES + i));
	for (size_t start = 0; start < APART; ++start)
		for (size_t i = start; i < count; i += APART) {
			int32_t *to = d->sum + d->place[i];
			const int32_t *from = quad + 4 * i;
			for (int r = 0; r <= d->size; ++r) {
				ew_deposit_add(to, from);
				to += d->stride;
				from += 4 * EW_PIECES;
			}
		}
}

static void ew_deposit_wide(ew_deposits *d, size_t count, const float *out)
{
	const size_t size = (size_t)d->size;
	for (size_t i = 0; i < count; ++i)
		for (size_t m = 0; m < size; ++m) {
			int32_t *to = d->sum + d->place[i] + m;
			int32_t rest = (int32_t)out[(size * size + m) * EW_PIECES + i];
			for (size_t r = 0; r < size; ++r) {
				const int32_t value = ew_deposit_integer(
					out[(r * size + m) * EW_PIECES + i]);
				to[r * d->stride] += value;
				rest -= value;
			}
			to[size * d->stride] += rest;
		}
}

static void ew_deposits_flush(ew_deposits *d)
{
	EW_ALIGNED float out[(EW_DEPOSIT_SIZE + 1) * EW_DEPOSIT_SIZE * EW_PIECES];
	const size_t count = d->count, whole = (count + 15) / 16 * 16;
	if (!count)
		return;
	for (size_t i = count; i < whole; ++i)
		d->x[i] = d->x[EW_PIECES + i] = d->y[i] = d->y[EW_PIECES + i] = 0;
	d->run(d->x, d->y, EW_PIECES, count, out);
	d->count = 0;
	if (d->size <= 4)
		ew_deposit_narrow(d, count, out);
	else
		ew_deposit_wide(d, count, out);
}

/* A piece above the image: the totals of its columns, to the first row. */
static void ew_deposits_above(ew_deposits *d, int column, double u0, double u1)
{
	EW_ALIGNED float out[(EW_DEPOSIT_SIZE + 1) * EW_DEPOSIT_SIZE * 16];
	EW_ALIGNED float x[32] = { 0 };
	EW_ALIGNED float y[32] = { 0 };
	x[0] = (float)u0;
	x[16] = (float)u1;
	d->run(x, y, 16, 1, out);
	for (int m = 0; m < d->size; ++m)
		d->sum[column + m] += (int32_t)out[(d->size * d->size + m) * 16];
}

EW_INLINE void ew_deposits_piece(ew_deposits *d, int reversed, int column, int row, double u0,
	double v0, double u1, double v1)
{
	const size_t i = d->count;
	if (u0 == u1)
		return;
	d->x[i] = (float)(reversed ? u1 : u0);
	d->y[i] = (float)(reversed ? v1 : v0);
	d->x[EW_PIECES + i] = (float)(reversed ? u0 : u1);
	d->y[EW_PIECES + i] = (float)(reversed ? v0 : v1);
	d->place[i] = (size_t)row * d->stride + (size_t)column;
	if (++d->count == EW_PIECES)
		ew_deposits_flush(d);
}

/* An edge from left to right. */
typedef struct {
	double x, y, down, across;     /* left end; dy/dx, dx/dy */
	int reversed;
} ew_deposit_edge;

EW_INLINE double ew_deposit_snap(double u)
{
	return (u + EW_SNAP) - EW_SNAP;
}

/* Within column from `left` to `right`: where the edge is at y, relative to the column. */
EW_INLINE double ew_deposit_cross(const ew_deposit_edge *e, double y, double column, double left,
	double right)
{
	const double u = ew_deposit_snap((e->x - column) + (y - e->y) * e->across);
	return u < left ? left : u > right ? right : u;
}

/* The part of an edge in one column that goes down, from (u0, y0) to (u1, y1), u rounded. */
static void ew_deposits_down(ew_deposits *d, const ew_deposit_edge *e, int column, double u0, double y0,
	double u1, double y1)
{
	if (y0 < 0) {
		const double u = y1 > 0 ? ew_deposit_cross(e, 0, column, u0, u1) : u1;
		if (u != u0)
			ew_deposits_above(d, column, e->reversed ? u : u0, e->reversed ? u0 : u);
		if (y1 <= 0)
			return;
		u0 = u;
		y0 = 0;
	}
	if (y0 >= d->rows)
		return;
	int row = (int)y0;
	for (; row + 1 < y1 && row < d->rows; ++row) {
		const double u = ew_deposit_cross(e, row + 1, column, u0, u1);
		ew_deposits_piece(d, e->reversed, column, row, u0, y0 - row, u, 1);
		u0 = u;
		y0 = row + 1;
	}
	if (row < d->rows)
		ew_deposits_piece(d, e->reversed, column, row, u0, y0 - row, u1, y1 - row);
}

/* The same for one that goes up. */
static void ew_deposits_up(ew_deposits *d, const ew_deposit_edge *e, int column, double u0, double y0,
	double u1, double y1)
{
	if (y1 >= d->rows)
		return;
	if (y0 > d->rows) {
		u0 = ew_deposit_cross(e, d->rows, column, u0, u1);
		y0 = d->rows;
	}
	int row = y0 > 0 ? (int)y0 : -1;
	row -= row == y0;
	for (; row >= 0 && y1 < row; --row) {
		const double u = ew_deposit_cross(e, row, column, u0, u1);
		ew_deposits_piece(d, e->reversed, column, row, u0, y0 - row, u, 0);
		u0 = u;
		y0 = row;
	}
	if (row >= 0)
		ew_deposits_piece(d, e->reversed, column, row, u0, y0 - row, u1, y1 - row);
	else if (u0 != u1)
		ew_deposits_above(d, column, e->reversed ? u1 : u0, e->reversed ? u0 : u1);
}

void ew_deposits_edge(ew_deposits *d, double x0, double y0, double x1, double y1)
{
	const int reversed = x0 > x1;
	const double ax = reversed ? x1 : x0, bx = reversed ? x0 : x1;
	const double ay = reversed ? y1 : y0, by = reversed ? y0 : y1;
	if (!(ax < bx) || bx <= 0 || ax >= d->columns || (ay >= d->rows && by >= d->rows))
		return;
	const ew_deposit_edge e = { ax, ay, (by - ay) / (bx - ax), (bx - ax) / (by - ay), reversed };
	const double low = ay < by ? ay : by, high = ay < by ? by : ay;
	int column = ax >= 0 ? (int)ax : 0;
	double x = ax >= 0 ? ax : 0, y = ax >= 0 ? ay : ay - ax * e.down;
	y = y < low ? low : y > high ? high : y;
	for (; column < d->columns && x < bx; ++column) {
		const int ends = bx <= column + 1;
		double next = ends ? by : ay + ((column + 1) - ax) * e.down;
		next = next < low ? low : next > high ? high : next;
		const double u0 = ew_deposit_snap(x - column);
		const double u1 = ends ? ew_deposit_snap(bx - column) : 1;
		if (y <= next)
			ew_deposits_down(d, &e, column, u0, y, u1, next);
		else
			ew_deposits_up(d, &e, column, u0, y, u1, next);
		x = column + 1;
		y = next;
	}
}

void ew_deposits_end(ew_deposits *d)
{
	ew_deposits_flush(d);
}

#else
extern int ew_ring_not_built;          /* a file must not be empty */
#endif

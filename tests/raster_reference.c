/* Images by clipping.
 *
 * In long double a ring is clipped, for each piece of the filter, to what half of the columns of
 * pixels see, to half of that, until there is one column, which is halved by rows likewise: a time
 * of the vertices times the logarithm of the size, and no more than that for pixels it does not
 * meet. A piece is integrated as in window_reference.c: the
 * polynomial G = INT_0^y f ds along an edge, by Horner's rule, in powers of t from 0 to 1.
 */
#include <stdlib.h>

#include "raster_reference.h"

enum { LONGEST = 2 * WINDOW_POWERS + 1, X = 0, Y = 1 };

typedef struct {
	size_t n, room;
	long double *at[2];
} Ring;

static void ring_push(Ring *ring, long double x, long double y)
{
	if (ring->n == ring->room) {
		ring->room = 2 * ring->room + 8;
		for (int axis = 0; axis < 2; axis++) {
			ring->at[axis] = realloc(ring->at[axis],
				ring->room * sizeof *ring->at[axis]);
			if (!ring->at[axis])
				abort();
		}
	}
	ring->at[X][ring->n] = x;
	ring->at[Y][ring->n++] = y;
}

static void ring_clear(Ring *ring)
{
	free(ring->at[X]);
	free(ring->at[Y]);
}

static void clip(Ring *out, const Ring *in, int axis, long double limit, int side)
{
	const long double *c = in->at[axis], *other = in->at[!axis];
	out->n = 0;
	for (size_t i = 0; i < in->n; i++) {
		const size_t j = i + 1 < in->n ? i + 1 : 0;
		const long double here = (c[i] - limit) * side, there = (c[j] - limit) * side;
		if (here >= 0)
			ring_push(out, in->at[X][i], in->at[Y][i]);
		if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
			const long double cut = other[i] + (other[j] - other[i])
				* ((limit - c[i]) / (c[j] - c[i]));
			ring_push(out, axis == X ? limit : cut, axis == X ? cut : limit);
		}
	}
}

/* One piece as numbers. */
typedef struct {
	long double low[2], high[2], c[WINDOW_POWERS][WINDOW_POWERS];
	int degree_x, degree_y;
} Piece;

static Piece *pieces_of(const WindowFilter *filter)
{
	Piece *pieces = calloc((size_t)filter->count, sizeof *pieces);
	if (!pieces)
		abort();
	for (int i = 0; i < filter->count; i++) {
		WindowPiece *from = &filter->pieces[i];
		Piece *to = &pieces[i];
		to->low[X] = mpq_get_d(from->x0);
		to->high[X] = mpq_get_d(from->x1);
		to->low[Y] = mpq_get_d(from->y0);
		to->high[Y] = mpq_get_d(from->y1);
		to->degree_x = from->degree_x;
		to->degree_y = from->degree_y;
		for (int a = 0; a < WINDOW_POWERS; a++) {
			for (int b = 0; b < WINDOW_POWERS; b++) {
				mpq_t rest;     /* what the first double leaves */
				const double first = mpq_get_d(from->c[a][b]);
				mpq_init(rest);
				mpq_set_d(rest, first);
				mpq_sub(rest, from->c[a][b], rest);
				to->c[a][b] = (long double)first + mpq_get_d(rest);
				mpq_clear(rest);
			}
		}
	}
	return pieces;
}

/* p(t) (b + d t), p of the given degree */
static void times(long double *p, int degree, long double b, long double d)
{
	p[degree + 1] = p[degree] * d;
	for (int i = degree; i > 0; i--)
		p[i] = p[i] * b + p[i - 1] * d;
	p[0] *= b;
}

/* INT G dx along an edge */
static long double edge_integral(const Piece *piece, long double x, long double y, long double dx,
	long double dy)
{
	long double sum[LONGEST] = { 0 }, total = 0;
	int degree = 0;
	for (int b = piece->degree_y; b >= 0; b--) {
		long double row[LONGEST] = { piece->c[piece->degree_x][b] };
		for (int a = piece->degree_x - 1; a >= 0; a--) {
			times(row, piece->degree_x - 1 - a, x, dx);
			row[0] += piece->c[a][b];
		}
		for (int k = 0; k <= piece->degree_x; k++)
			sum[k] += row[k] / (b + 1);
		degree = degree > piece->degree_x ? degree : piece->degree_x;
		times(sum, degree++, y, dy);
	}
	for (int k = 0; k <= degree; k++)
		total += sum[k] / (k + 1);
	return total * dx;
}

static long double ring_integral(const Piece *piece, const Ring *ring, long double cx,
	long double cy)
{
	long double total = 0;
	for (size_t i = 0; i < ring->n; i++) {
		const size_t j = i + 1 < ring->n ? i + 1 : 0;
		const long double dx = ring->at[X][j] - ring->at[X][i];
		if (dx != 0)
			total -= edge_integral(piece, ring->at[X][i] - cx, ring->at[Y][i] - cy, dx,
				ring->at[Y][j] - ring->at[Y][i]);
	}
	return total;
}

enum { LEVELS = 40 };

typedef struct {
	double *out;
	int width, height;
	const Piece *piece;
	Ring level[2][LEVELS][2];       /* of an axis: cut at one side, at both */
} Work;

/* The pixels from..to-1 of an axis, halved until there is one; then the other axis. */
static void divide(Work *w, const Ring *ring, int axis, int depth, int i, int from, int to)
{
	Ring *half = &w->level[axis][depth][0], *part = &w->level[axis][depth][1];
	clip(half, ring, axis, from + 0.5L + w->piece->low[axis], 1);
	clip(part, half, axis, to - 0.5L + w->piece->high[axis], -1);
	if (part->n == 0)
		return;
	const int middle = from + (to - from) / 2;
	if (middle > from) {
		divide(w, part, axis, depth + 1, i, from, middle);
		divide(w, part, axis, depth + 1, i, middle, to);
	} else if (axis == X) {
		divide(w, part, Y, 0, from, 0, w->height);
	} else {
		w->out[(size_t)from * (size_t)w->width + (size_t)i] +=
			(double)ring_integral(w->piece, part, i + 0.5L, from + 0.5L);
	}
}

static void set_ring(Ring *ring, const RasterRings *rings, size_t k)
{
	ring->n = 0;
	for (int32_t i = rings->offsets[k]; i < rings->offsets[k + 1]; i++)
		ring_push(ring, (long double)rings->x[i], (long double)rings->y[i]);
}

void raster_reference(double *out, const WindowFilter *filter, const RasterRings *rings, int width,
	int height)
{
	Work *w = calloc(1, sizeof *w);
	Piece *pieces = pieces_of(filter);
	Ring ring = { 0 };
	if (!w)
		abort();
	w->out = out;
	w->width = width;
	w->height = height;
	for (size_t i = 0; i < (size_t)width * (size_t)height; i++)
		out[i] = 0;
	for (size_t k = 0; k < rings->rings; k++) {
		set_ring(&ring, rings, k);
		for (int p = 0; p < filter->count; p++) {
			w->piece = &pieces[p];
			divide(w, &ring, X, 0, 0, 0, width);
		}
	}
	ring_clear(&ring);
	for (int i = 0; i < 2 * LEVELS * 2; i++)
		ring_clear(&w->level[i / (2 * LEVELS)][i / 2 % LEVELS][i % 2]);
	free(w);
	free(pieces);
}

void raster_exact(double *out, const WindowFilter *filter, const RasterRings *rings, int width,
	int height)
{
	mpq_t sum, value;
	mpq_inits(sum, value, NULL);
	for (int p = 0; p < width * height; p++) {
		mpq_set_ui(sum, 0, 1);
		for (size_t k = 0; k < rings->rings; k++) {
			const int32_t first = rings->offsets[k];
			window_ring(value, filter, rings->x + first, rings->y + first,
				(size_t)(rings->offsets[k + 1] - first), p % width + 0.5,
				p / width + 0.5);
			mpq_add(sum, sum, value);
		}
		out[p] = mpq_get_d(sum);
	}
	mpq_clears(sum, value, NULL);
}

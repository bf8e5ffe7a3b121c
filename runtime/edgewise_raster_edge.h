/* edgewise_raster_edge.h - an edge of any length, anywhere, cut into pieces one after the other,
 * and what pieces add to the difference image; part of edgewise_raster.c.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

/* ---- pieces ---- */

EW_INLINE void ew_raster_add(int32_t *to, int64_t value)
{
	*to = (int32_t)((uint32_t)*to + (uint32_t)value);
}

EW_INLINE int64_t ew_raster_clamp(int64_t v, int64_t low, int64_t high)
{
	v = v < low ? low : v;
	return v > high ? high : v;
}

/* Blocks of pixels that change if pieces in columns c0 .. c1, counted from the one on the left, of
 * a row do. */
static void ew_raster_touch(const ew_raster_image *image, size_t row, int64_t c0, int64_t c1)
{
	const int64_t most = image->width - 1;
	const int b0 = (int)(ew_raster_clamp(c0 - image->size, 0, most) >> image->block);
	const int b1 = (int)(ew_raster_clamp(c1 - 1, 0, most) >> image->block);
	const uint64_t bits = (~(uint64_t)0 << b0) & (~(uint64_t)0 >> (63 - b1));
	for (int r = 0; r <= image->size; ++r)
		image->touched[row + (size_t)r] |= bits;
}

/* Runs the deposit over the pieces that wait. Those to fill the lanes go nowhere. */
static void ew_raster_flush(const ew_raster_image *image)
{
	ew_raster_pieces *p = image->pieces;
	for (size_t i = p->count; i < EW_PIECES && i % 16; ++i) {
		p->x[i] = p->x[EW_PIECES + i] = p->y[i] = p->y[EW_PIECES + i] = 0;
		p->place[i] = 0;
	}
	p->run(p->x, p->y, EW_PIECES, p->count, p->out);
	image->ways->scatter(image);
	p->count = 0;
}

/* To the nearest integer, ties to even. */
EW_INLINE int32_t ew_raster_integer(float value)
{
	return (int32_t)(((double)value + 0x1.8p52) - 0x1.8p52);
}

static void ew_raster_scatter_scalar(const ew_raster_image *image)
{
	const ew_raster_pieces *p = image->pieces;
	const size_t size = (size_t)image->size, middle = size / 2;
	for (size_t i = 0; i < p->count; ++i)
		for (size_t m = 0; m < size; ++m) {
			int32_t *to = image->sum + p->place[i] + m;
			const float *from = p->out + m * EW_PIECES + i;
			int32_t rest = (int32_t)from[middle * size * EW_PIECES];
			for (size_t r = 0; r <= size; ++r) {
				const int32_t value = r == middle ? 0
					: ew_raster_integer(from[r * size * EW_PIECES]);
				ew_raster_add(to + r * image->stride, value);
				rest -= value;
			}
			ew_raster_add(to + middle * image->stride, rest);
		}
}

/* ---- an edge of any length, anywhere ---- */

EW_INLINE int64_t ew_raster_bits(double v)
{
	int64_t bits;
	memcpy(&bits, &v, sizeof bits);
	return bits;
}

/* A coordinate in units of the grid. */
EW_INLINE int64_t ew_raster_fixed(double v)
{
	return ew_raster_bits(v + EW_TO_GRID) - ew_raster_bits(EW_TO_GRID);
}

/* An edge from left to right, turned over if it goes up. from, to: its ends, in units from the
 * column on the left. */
typedef struct {
	double x0, y0, x1, y1;         /* x0 < x1, y0 <= y1 */
	double across, along;          /* dx / dy, dy / dx */
	int64_t from, to;
	int leftwards, up;
} ew_raster_edge;

/* start + along in units of the grid: rounded relative to the start, unless that is too far. */
EW_INLINE int64_t ew_raster_sum(double start, double along)
{
	if (along < EW_RELATIVE && along > -EW_RELATIVE)
		return ew_raster_fixed(start) + ew_raster_fixed(along);
	return ew_raster_bits((EW_TO_GRID + start) + along) - ew_raster_bits(EW_TO_GRID);
}

/* Within the columns on both sides, from the left one. */
EW_INLINE int64_t ew_raster_column(const ew_raster_image *image, int64_t x)
{
	return ew_raster_clamp(x + EW_ONE, 0, (int64_t)(image->columns + 2) << EW_GRID);
}

/* Abscissa on the line y = j. */
EW_INLINE int64_t ew_raster_cross(const ew_raster_image *image, const ew_raster_edge *e, double j,
	int plain)
{
	const double along = (j - e->y0) * e->across;
	return plain ? e->from + ew_raster_fixed(along)
		: ew_raster_column(image, ew_raster_sum(e->x0, along));
}

/* Ordinate in row j on the line x = i. */
EW_INLINE int64_t ew_raster_height(const ew_raster_edge *e, double j, double i, int plain)
{
	const double along = (i - e->x0) * e->along;
	return plain ? ew_raster_fixed(e->y0 - j) + ew_raster_fixed(along)
		: ew_raster_sum(e->y0 - j, along);
}

/* What `count` pieces side by side add, v = v0 + v1. */
EW_INLINE void ew_raster_deposit(const ew_raster_image *image, const ew_raster_edge *e, int32_t *to,
	int64_t total, int64_t v, int64_t count)
{
	const int64_t twice = total * (2 * EW_ONE - v);
	const int64_t nearer = (twice + EW_ONE - 1 + (twice >> (EW_GRID + 1) & 1))
		>> (EW_GRID + 1);              /* to nearest, ties to even */
	const int64_t sign = e->leftwards ? -1 : 1;
	const int64_t upper = sign * (e->up ? total - nearer : nearer);
	const int64_t lower = sign * total - upper;
	int32_t *below = to + image->stride;
	for (int64_t i = 0; i < count; ++i) {
		ew_raster_add(to + i, upper);
		ew_raster_add(below + i, lower);
	}
}

/* A piece that waits. */
static void ew_raster_wait(const ew_raster_image *image, const ew_raster_edge *e, int64_t place,
	int64_t u0, int64_t u1, int64_t v0, int64_t v1)
{
	ew_raster_pieces *p = image->pieces;
	const size_t start = p->count + (e->leftwards ? (size_t)EW_PIECES : 0);
	const size_t end = p->count + (e->leftwards ? 0 : (size_t)EW_PIECES);
	if (u0 == u1)
		return;
	p->place[p->count] = (int32_t)place;
	p->x[start] = (float)((double)u0 * EW_PIXEL);
	p->x[end] = (float)((double)u1 * EW_PIXEL);
	p->y[start] = (float)((double)(e->up ? EW_ONE - v0 : v0) * EW_PIXEL);
	p->y[end] = (float)((double)(e->up ? EW_ONE - v1 : v1) * EW_PIXEL);
	if (++p->count > EW_PIECES - 4)                /* room for four lanes */
		ew_raster_flush(image);
}

EW_INLINE void ew_raster_piece(const ew_raster_image *image, const ew_raster_edge *e, int64_t place,
	int64_t u0, int64_t u1, int64_t v0, int64_t v1, int plain)
{
	if (plain || !image->pieces)
		ew_raster_deposit(image, e, image->sum + place, u1 - u0, v0 + v1, 1);
	else
		ew_raster_wait(image, e, place, u0, u1, v0, v1);
}

/* The part of an edge in row j, turned over like the edge, between abscissas x0 and x1 and
 * ordinates v0 and v1 of the row. */
EW_INLINE void ew_raster_row(const ew_raster_image *image, const ew_raster_edge *e, int j,
	int64_t x0, int64_t x1, int64_t v0, int64_t v1, int plain)
{
	const int64_t row = (e->up ? -1 - j : j) - image->first + 1, last = (x1 - 1) >> EW_GRID;
	int64_t column = x0 >> EW_GRID, place = row * (int64_t)image->stride + column;
	if (!plain && image->touched)
		ew_raster_touch(image, (size_t)row, column, last > column ? last : column);
	if (plain && v0 == v1 && column < last) {              /* level */
		ew_raster_piece(image, e, place, x0 - (column << EW_GRID), EW_ONE, v0, v1, plain);
		ew_raster_deposit(image, e, image->sum + place + 1, EW_ONE, 2 * v0,
			last - column - 1);
		place += last - column;
		column = last;
		x0 = last << EW_GRID;
	}
	for (; column < last; ++column, ++place) {
		const int64_t left = column << EW_GRID;
		const int64_t v = v0 == v1 ? v0 : ew_raster_clamp(
			ew_raster_height(e, j, (double)column, plain), v0, v1);
		ew_raster_piece(image, e, place, x0 - left, EW_ONE, v0, v, plain);
		x0 = left + EW_ONE;
		v0 = v;
	}
	column <<= EW_GRID;
	ew_raster_piece(image, e, place, x0 - column, x1 - column, v0, v1, plain);
}

/* The rows of an edge in this band; what is above the first one belongs to the row before it.
 * Plain: all of it is inside, and neither pieces nor bands need more. */
EW_INLINE void ew_raster_rows(const ew_raster_image *image, const ew_raster_edge *e, int plain)
{
	const int above = image->first == 0 ? -1 : image->first;
	const int first = e->up ? -image->last : above, last = e->up ? -1 - above : image->last - 1;
	double low = floor(e->y0), high = ceil(e->y1) - 1;
	high = high < low ? low : high;
	if (!plain) {
		if (above < 0 && e->up) {
			low = low > last ? last : low;
			high = high > last ? last : high;
		} else if (above < 0) {
			low = low < first ? first : low;
			high = high < first ? first : high;
		}
		if (high < first || low > last)
			return;
	}
	int j = !plain && low < first ? first : (int)low;
	const int end = !plain && high > last ? last : (int)high;
	int64_t x = !plain && low < first ? ew_raster_cross(image, e, j, plain) : e->from;
	int64_t v = ew_raster_clamp(ew_raster_fixed(e->y0 - j), 0, EW_ONE);
	for (; j < end; ++j) {
		const int64_t next = ew_raster_cross(image, e, j + 1.0, plain);
		ew_raster_row(image, e, j, x, next, v, EW_ONE, plain);
		x = next;
		v = 0;
	}
	ew_raster_row(image, e, j, x, !plain && high > last
		? ew_raster_cross(image, e, j + 1.0, plain) : e->to, v,
		ew_raster_clamp(ew_raster_fixed(e->y1 - j), 0, EW_ONE), plain);
}

static void ew_raster_edge_alone(const ew_raster_image *image, double px, double py, double qx,
	double qy, int clip)
{
	ew_raster_edge e;
	e.leftwards = px > qx;
	e.x0 = e.leftwards ? qx : px;
	e.x1 = e.leftwards ? px : qx;
	e.y0 = e.leftwards ? qy : py;
	e.y1 = e.leftwards ? py : qy;
	e.up = e.y0 > e.y1;
	e.y0 = e.up ? -e.y0 : e.y0;
	e.y1 = e.up ? -e.y1 : e.y1;
	e.from = ew_raster_column(image, ew_raster_fixed(e.x0));
	e.to = ew_raster_column(image, ew_raster_fixed(e.x1));
	e.across = (e.x1 - e.x0) / (e.y1 - e.y0);
	e.along = (e.y1 - e.y0) / (e.x1 - e.x0);
	if (!clip && !image->pieces && e.from < e.to)
		ew_raster_rows(image, &e, 1);
	else if (e.from < e.to)
		ew_raster_rows(image, &e, 0);
}

static void ew_raster_edges_scalar(const ew_raster_image *image, const double *px, const double *py,
	const double *qx, const double *qy, size_t count, int clip)
{
	for (size_t i = 0; i < count; ++i)
		ew_raster_edge_alone(image, px[i], py[i], qx[i], qy[i], clip);
}

static void ew_raster_finish_scalar(const ew_raster_image *image)
{
	(void)image;
}

/* edgewise_raster.c - images: exact coverage of pixels, plain or weighted by a filter.
 *
 * Every edge is cut at the lines of the grid into pieces within one cell, and a piece adds to a
 * difference image what makes all pixels right from there on down; pixels are its running sum down
 * the columns. A piece (u0, v0) -> (u1, v1) of the cell in some row adds (u1 - u0) (1 - v) to that
 * row and (u1 - u0) v to the next one, v = (v0 + v1) / 2. With a filter of N cells a side a program
 * of gen, its deposit, gives N numbers for each of N + 1 rows.
 *
 * Vertices are rounded to a grid of 2^-22 pixel, and so are the points where edges cross lines of
 * whole pixels. Sums are integers in units of that grid (or of the filter): exact in any order, so
 * the same on all targets, and exactly 0 in columns that no edge crosses; |winding| < 512. Where an
 * edge crosses a line is computed from its left end, rounded once, whatever part of the edge is in
 * the image: so reversed edges have the same points and shifted ones too, and nothing drifts.
 *
 * What is left or right of the image falls into a column beside it; of what is above all that
 * counts is how far it goes to the right, and it falls into a row before the first one. Short edges
 * are cut side by side where there are vectors, others alone. A difference image that would not
 * stay in the cache is made in bands of rows: edges are rounded first and listed by the band where
 * they begin, and what the rows of a band add to those below is carried on.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#include "edgewise_runtime.h"

#ifdef EW_HAS_FILTERS

#include <limits.h>
#include <math.h>
#include <string.h>

enum {
	EW_GRID = 22,                  /* bits of a pixel */
	EW_ONE = 1 << EW_GRID,
	EW_LARGEST = 1 << 28,          /* width or height */
	EW_POINTS = 64,                /* vertices rounded at a time */
	EW_LANES_OF_EDGES = 8,         /* at most: points behind them */
	EW_AROUND = 48,                /* numbers to align a difference image, and behind it */
	EW_SMALL = 8192,               /* numbers of a difference image on the stack */
	EW_BAND = 1 << 16,             /* numbers of a difference image at a time */
	EW_STRIP = 64                  /* pixels of a row that are looked at or not */
};

#define EW_TO_GRID 0x1.8p30            /* sums with it are rounded to the grid */
#define EW_PIXEL 0x1p-22
#define EW_FURTHEST 0x1p30             /* coordinate */
#define EW_SHORT_EDGE 11.0             /* dx + dy of edges that are cut side by side */
#define EW_FLATNESS 0x1p-8             /* how far lines are from their curve, in pixels */
#define EW_FARTHEST_BEND 0x1p40        /* of a conic that is looked at */
#define EW_RELATIVE 0x1p28             /* distances that are rounded by themselves */

/* Where cells begin, and between which coordinates a point surely is in one of the image. */
typedef struct { double origin, low, high; } ew_raster_axis;
enum { EW_IN_RANGE = 1, EW_WITHIN = 2 };

/* Pieces that wait for a deposit. */
typedef struct {
	ew_deposit *run;
	size_t count;
	EW_ALIGNED float x[2 * EW_PIECES];
	EW_ALIGNED float y[2 * EW_PIECES];
	EW_ALIGNED int32_t place[EW_PIECES];
	EW_ALIGNED float out[(EW_DEPOSIT_SIZE + 1) * EW_DEPOSIT_SIZE * EW_PIECES];
} ew_raster_pieces;

/* Short edges that wait until all lanes are full. */
typedef struct {
	double px[EW_POINTS + EW_LANES_OF_EDGES], py[EW_POINTS + EW_LANES_OF_EDGES];
	double qx[EW_POINTS + EW_LANES_OF_EDGES], qy[EW_POINTS + EW_LANES_OF_EDGES];
	size_t count;
} ew_raster_short;

/* Edges that wait for their bands: the points of each ring, the last one before them too. */
typedef struct {
	double *x, *y;
	int32_t *next;                 /* of the same band; EW_NO_EDGE: a ring ends here */
	int32_t *band;                 /* its first edge */
	size_t count;
} ew_raster_list;
enum { EW_NO_MORE = -1, EW_NO_EDGE = -2 };

/* A difference image of some rows of cells, with a row above them and a column on both sides. */
typedef struct {
	const struct ew_raster_ways *ways;
	int width, height, size;       /* size: cells of the filter a side */
	int columns, cells;            /* of the whole image; cells: rows of them */
	int first, last, tall;         /* rows of cells of this band; behind them; of any band */
	void *memory;                  /* NULL: none but the stack */
	int32_t *sum;
	size_t stride, above;          /* above: rows before those of the first pixels */
	uint64_t *touched;             /* bits of blocks of pixels, for every row; NULL: all are */
	int block;                     /* log2 of the pixels in one */
	float unit;
	ew_raster_axis x, y;
	ew_raster_short *edges;
	ew_raster_pieces *pieces;      /* NULL: box, or a filter in general */
	ew_raster_list *list;          /* NULL: a single band */
	int is_general;                /* neither: knots are not a pixel apart */
#ifdef EW_HAS_DOUBLE
	ew_raster_general general;
#endif
} ew_raster_image;

/* What fits on the stack. */
typedef struct {
	ew_raster_list list;
	ew_raster_short edges;
	ew_raster_pieces pieces;
	EW_ALIGNED int32_t sum[EW_SMALL + EW_AROUND];
} ew_raster_scratch;

typedef struct { float *floats; unsigned char *bytes; ptrdiff_t stride; } ew_raster_pixels;

/* What a target does by vectors. */
typedef struct ew_raster_ways {
	unsigned (*round)(const ew_raster_image *image, const double *x, const double *y,
		size_t count, double *to_x, double *to_y);
	unsigned (*roundf)(const ew_raster_image *image, const float *x, const float *y,
		size_t count, double *to_x, double *to_y);
	void (*edges)(const ew_raster_image *image, const double *px, const double *py,
		const double *qx, const double *qy, size_t count, int clip);
	void (*finish)(const ew_raster_image *image);
	void (*scatter)(const ew_raster_image *image);
	void (*floats)(const ew_raster_image *image, float *pixels, int rows, ptrdiff_t stride);
	void (*bytes)(const ew_raster_image *image, unsigned char *pixels, int rows,
		ptrdiff_t stride);
} ew_raster_ways;

#include "edgewise_raster_edge.h"

/* ---- vertices ---- */

/* A coordinate, rounded to the grid. */
EW_INLINE unsigned ew_raster_round(double v, const ew_raster_axis *axis, double *to)
{
	*to = ((v - axis->origin) + EW_TO_GRID) - EW_TO_GRID;
	return (unsigned)(v >= -EW_FURTHEST && v <= EW_FURTHEST ? EW_IN_RANGE : 0)
		| (unsigned)(v >= axis->low && v <= axis->high ? EW_WITHIN : 0);
}

#define EW_ROUND(f, real) \
static unsigned ew_raster_round##f##_scalar(const ew_raster_image *image, const real *x, \
	const real *y, size_t count, double *to_x, double *to_y) \
{ \
	unsigned flags = (unsigned)EW_IN_RANGE | (unsigned)EW_WITHIN; \
	for (size_t i = 0; i < count; ++i) { \
		flags &= ew_raster_round((double)x[i], &image->x, to_x + i); \
		flags &= ew_raster_round((double)y[i], &image->y, to_y + i); \
	} \
	return flags; \
}
EW_ROUND(, double)
EW_ROUND(f, float)
#undef EW_ROUND

/* ---- pixels ---- */

/* Nearest of 255 |sum|, sum in pixels. */
EW_INLINE unsigned char ew_raster_byte(int32_t sum)
{
	uint32_t size = sum < 0 ? 0 - (uint32_t)sum : (uint32_t)sum;
	size = size > (uint32_t)EW_ONE ? (uint32_t)EW_ONE : size;
	return (unsigned char)((size * 255 + EW_ONE / 2) >> EW_GRID);
}

/* Where the columns end, from column i on, that were all touched or all not. */
EW_INLINE int ew_raster_run(const ew_raster_image *image, uint64_t touched, int i)
{
	const uint64_t first = touched >> (i >> image->block) & 1;
	int end = ((i >> image->block) + 1) << image->block;
	while (end < image->width && (touched >> (end >> image->block) & 1) == first)
		end += 1 << image->block;
	return end < image->width ? end : image->width;
}

/* Row by row, the sums in the first row of the difference image; what nothing touched is what
 * stands above. */
#define EW_SWEEP(stem, type, value) \
static void ew_raster_##stem##_scalar(const ew_raster_image *image, type *pixels, int rows, \
	ptrdiff_t stride) \
{ \
	int32_t *const carry = image->sum + image->size, *from = carry; \
	for (size_t j = 1; j < image->above; ++j) { \
		from += image->stride; \
		for (int i = 0; i < image->width; ++i) { \
			ew_raster_add(carry + i, from[i]); \
			from[i] = 0; \
		} \
	} \
	for (int j = 0; j < rows; ++j, pixels += stride) { \
		const uint64_t touched = j && image->touched \
			? image->touched[image->above + (size_t)j] : ~(uint64_t)0; \
		from += image->stride; \
		for (int i = 0, end; i < image->width; i = end) { \
			end = ew_raster_run(image, touched, i); \
			if (!(touched >> (i >> image->block) & 1)) { \
				memcpy(pixels + i, pixels + i - stride, \
					(size_t)(end - i) * sizeof *pixels); \
				continue; \
			} \
			for (int k = i; k < end; ++k) { \
				ew_raster_add(carry + k, from[k]); \
				from[k] = 0; \
				pixels[k] = value(carry[k]); \
			} \
		} \
	} \
}
#define EW_FLOAT(sum) (float)(sum) * image->unit
EW_SWEEP(floats, float, EW_FLOAT)
EW_SWEEP(bytes, unsigned char, ew_raster_byte)
#undef EW_SWEEP
#undef EW_FLOAT

#if EW_BUILD_AVX2 || EW_BUILD_AVX512 || EW_BUILD_NEON || EW_BUILD_WASM128
/* The beginning of a row of pixels; size is less than 64. */
EW_INLINE void ew_raster_put(void *to, const void *from, size_t size)
{
	unsigned char *t = (unsigned char *)to;
	const unsigned char *f = (const unsigned char *)from;
#define EW_PUT(bytes) \
	if (size & (bytes)) { \
		memcpy(t, f, bytes); \
		t += bytes; \
		f += bytes; \
	}
	EW_PUT(32)
	EW_PUT(16)
	EW_PUT(8)
	EW_PUT(4)
	EW_PUT(2)
	EW_PUT(1)
#undef EW_PUT
}
#endif

/* ---- filters whose knots are not a pixel apart ---- */

static int ew_raster_begin_general(ew_raster_image *image, const ew_filter *filter)
{
	image->is_general = 1;
#ifdef EW_HAS_DOUBLE
	return ew_raster_general_begin(&image->general, filter, image->width, image->height);
#else
	(void)filter;
	return EW_UNSUPPORTED;         /* only kernels of double are precise enough */
#endif
}

static void ew_raster_edges_general(const ew_raster_image *image, const double *px,
	const double *py, const double *qx, const double *qy, size_t count, int clip)
{
	(void)clip;
#ifdef EW_HAS_DOUBLE
	for (size_t i = 0; i < count; ++i)
		ew_raster_general_edge(&image->general, px[i], py[i], qx[i], qy[i]);
#else
	(void)image, (void)px, (void)py, (void)qx, (void)qy, (void)count;
#endif
}

static void ew_raster_draw_general(ew_raster_image *image, const ew_raster_pixels *to)
{
#ifdef EW_HAS_DOUBLE
	ew_raster_general_end(&image->general, to->floats, to->stride);
#else
	(void)image, (void)to;
#endif
}

static void ew_raster_end_general(ew_raster_image *image)
{
#ifdef EW_HAS_DOUBLE
	EW_FREE(image->general.sum);
#else
	(void)image;
#endif
}

#include "edgewise_raster_targets.h"

/* ---- images ---- */

/* What is wrong with an image, before anything is written. */
static int ew_raster_check(const void *pixels, int width, int height, ptrdiff_t stride)
{
	const ptrdiff_t most = PTRDIFF_MAX / (ptrdiff_t)sizeof(float) / (height > 0 ? height : 1);
	if (width < 0 || height < 0 || width > EW_LARGEST || height > EW_LARGEST)
		return EW_BAD_IMAGE;
	if (width == 0 || height == 0)
		return EW_OK;
	if (!pixels || (height > 1 && ((stride < width && stride > -width) || stride > most
	    || stride < -most)))
		return EW_BAD_IMAGE;
	return EW_OK;
}

static void ew_raster_axis_of(ew_raster_axis *axis, double first, int cells)
{
	axis->origin = first + 0.5;
	axis->low = axis->origin;
	axis->high = axis->origin + cells - EW_PIXEL;
}

/* Everything but scratch. */
static void ew_raster_shape(ew_raster_image *image, const ew_filter *filter, int width, int height)
{
	image->ways = ew_raster_by_target(ew_cpu_target());
	image->width = width;
	image->height = height;
	image->size = filter && filter->size ? filter->size : 1;
	image->columns = width + image->size - 1;
	image->cells = height + image->size - 1;
	image->unit = filter ? (float)filter->unit : (float)EW_PIXEL;
	/* pixels begin a cache line, but not all of them at a multiple of 4 KiB */
	image->stride = ((size_t)image->columns + (size_t)image->size + 1 + 15) / 16 * 16;
	image->stride += image->stride % 1024 ? 0 : 16;
	ew_raster_axis_of(&image->x, filter && filter->size ? filter->first_x : -0.5,
		image->columns);
	ew_raster_axis_of(&image->y, filter && filter->size ? filter->first_y : -0.5,
		image->cells);
	image->first = 0;
	image->last = image->tall = image->cells;
	image->touched = NULL;
	image->list = NULL;
	image->pieces = NULL;
	image->is_general = 0;
	image->memory = NULL;
	image->above = (size_t)image->size;
	image->block = 0;
	while ((width - 1) >> image->block >= 64)
		++image->block;
	image->block = image->block < 6 ? 6 : image->block;
}

/* Numbers of the difference image, and what it takes to align it and to add whole vectors. */
static size_t ew_raster_numbers(const ew_raster_image *image)
{
	return ((size_t)image->tall + (size_t)image->size + 1) * image->stride;
}
/* So that the first pixel begins a cache line. */
static void ew_raster_align(ew_raster_image *image, int32_t *scratch)
{
	const size_t off = (size_t)((uintptr_t)scratch / sizeof *scratch) % 16;
	const size_t size = (size_t)image->size % 16;
	image->sum = scratch + (32 - off - size) % 16;
	memset(image->sum, 0, (ew_raster_numbers(image) + 16) * sizeof *image->sum);
}

static size_t ew_raster_bands(const ew_raster_image *image)
{
	return ((size_t)image->cells + (size_t)image->tall - 1) / (size_t)image->tall;
}

/* Scratch for bands and points in one piece. */
static int ew_raster_begin_bands(ew_raster_image *image, ew_raster_list *list, size_t points)
{
	const size_t tall = EW_BAND / image->stride, size = (size_t)image->size;
	image->tall = tall > size ? (int)tall : image->size;
	const size_t numbers = ew_raster_numbers(image), rows = (size_t)image->tall + size + 1;
	const size_t bands = ew_raster_bands(image) + 1, room = points + EW_LANES_OF_EDGES;
	if (numbers > INT32_MAX - EW_AROUND || room > INT32_MAX)
		return EW_NO_MEMORY;
	char *const all = (char *)EW_MALLOC(rows * sizeof(uint64_t) + 2 * room * sizeof(double)
		+ (numbers + EW_AROUND + bands + room) * sizeof(int32_t));
	if (!all)
		return EW_NO_MEMORY;
	image->memory = all;
	image->touched = (uint64_t *)(void *)all;
	list->x = (double *)(void *)(image->touched + rows);
	list->y = list->x + room;
	list->band = (int32_t *)(void *)(list->y + room);
	list->next = list->band + bands;
	ew_raster_align(image, list->next + room);
	list->count = 0;
	memset(image->touched, 0, rows * sizeof(uint64_t));
	image->list = list;
	return EW_OK;
}

static void ew_raster_begin_pieces(ew_raster_image *image, const ew_filter *filter,
	ew_raster_pieces *pieces)
{
	int t = 0;
	while (ew_cpu_target() >> t > 1)
		++t;
	pieces->run = filter->deposit[t];
	pieces->count = 0;
	image->pieces = pieces;
}

static int ew_raster_is_box(const ew_filter *filter)
{
	return !filter || strcmp(filter->name, "box") == 0;
}

/* An empty image, for at most that many points; filter NULL: box. */
static int ew_raster_begin(ew_raster_image *image, const ew_filter *filter, int width, int height,
	size_t points, ew_raster_scratch *scratch)
{
	filter = ew_raster_is_box(filter) ? NULL : filter;
	ew_raster_shape(image, filter, width, height);
	const size_t numbers = ew_raster_numbers(image);
	image->edges = &scratch->edges;
	scratch->edges.count = 0;
	if (filter && filter->size == 0) {
		image->ways = &ew_raster_ways_general;
		return ew_raster_begin_general(image, filter);
	}
	if (filter)
		ew_raster_begin_pieces(image, filter, &scratch->pieces);
	if (numbers > EW_BAND)
		return ew_raster_begin_bands(image, &scratch->list, points);
	if (numbers > EW_SMALL)
		image->memory = EW_MALLOC((numbers + EW_AROUND) * sizeof *image->sum);
	if (numbers > EW_SMALL && !image->memory)
		return EW_NO_MEMORY;
	ew_raster_align(image, numbers > EW_SMALL ? (int32_t *)image->memory : scratch->sum);
	return EW_OK;
}

static void ew_raster_end(ew_raster_image *image)
{
	if (image->is_general)
		ew_raster_end_general(image);
	else if (image->memory)
		EW_FREE(image->memory);
}

static void ew_raster_sweep(const ew_raster_image *image, const ew_raster_pixels *to, int row,
	int rows)
{
	image->ways->finish(image);
	if (image->pieces && image->pieces->count)
		ew_raster_flush(image);
	if (to->floats)
		image->ways->floats(image, to->floats + row * to->stride, rows, to->stride);
	else
		image->ways->bytes(image, to->bytes + row * to->stride, rows, to->stride);
}

/* Lists every edge with the band where it begins; in order, so from the last one. */
static void ew_raster_sort(ew_raster_image *image)
{
	ew_raster_list *list = image->list;
	const size_t bands = ew_raster_bands(image);
	for (size_t b = 0; b <= bands; ++b)
		list->band[b] = EW_NO_MORE;
	for (size_t i = list->count; i-- > 0; ) {
		if (list->next[i] == EW_NO_EDGE || list->x[i] == list->x[i + 1])
			continue;
		const double top = list->y[i] < list->y[i + 1] ? list->y[i] : list->y[i + 1];
		if (top >= image->cells)
			continue;
		const size_t b = top > 0 ? (size_t)top / (size_t)image->tall : 0;
		list->next[i] = list->band[b];
		list->band[b] = (int32_t)i;
	}
}

/* The edges of a band, of which some go on in the next one. */
static void ew_raster_band(const ew_raster_image *image, size_t band)
{
	const ew_raster_list *list = image->list;
	double p[2][EW_POINTS + EW_LANES_OF_EDGES], q[2][EW_POINTS + EW_LANES_OF_EDGES];
	int32_t next = list->band[band];
	while (next != EW_NO_MORE) {
		size_t count = 0;
		for (; count < EW_POINTS && next != EW_NO_MORE; ++count) {
			const int32_t i = next;
			next = list->next[i];
			p[0][count] = list->x[i];
			p[1][count] = list->y[i];
			q[0][count] = list->x[i + 1];
			q[1][count] = list->y[i + 1];
			if (p[1][count] > image->last || q[1][count] > image->last) {
				list->next[i] = list->band[band + 1];
				list->band[band + 1] = i;
			}
		}
		for (size_t i = count; i % EW_LANES_OF_EDGES; ++i)
			p[0][i] = p[1][i] = q[0][i] = q[1][i] = 0;
		image->ways->edges(image, p[0], p[1], q[0], q[1], count, 1);
	}
}

/* Readies the difference image for the band below: the sum of all rows is the first one already. */
static void ew_raster_carry(ew_raster_image *image)
{
	const size_t size = (size_t)image->size, row = image->stride * sizeof *image->sum;
	int32_t *below = image->sum + ((size_t)image->tall + 1) * image->stride;
	memcpy(image->sum + image->stride, below, size * row);
	memset(below, 0, size * row);
	memcpy(image->touched + 1, image->touched + image->tall + 1, size * sizeof(uint64_t));
	memset(image->touched + size + 1, 0, (size_t)image->tall * sizeof(uint64_t));
}

static void ew_raster_draw(ew_raster_image *image, const ew_raster_pixels *to)
{
	if (image->is_general) {
		ew_raster_draw_general(image, to);
		return;
	}
	if (!image->list) {
		ew_raster_sweep(image, to, 0, image->height);
		return;
	}
	ew_raster_sort(image);
	int row = 0;
	for (size_t b = 0; row < image->height; ++b) {
		image->first = (int)b * image->tall;
		image->last = image->cells - image->first < image->tall ? image->cells
			: image->first + image->tall;
		const int end = image->last - image->size + 1;
		ew_raster_band(image, b);
		ew_raster_sweep(image, to, row, end - row);
		row = end;
		image->above = 1;
		ew_raster_carry(image);
	}
}

static int ew_raster_has(int verb)
{
	return verb <= EW_CLOSE;
}

#ifdef EW_HAS_DOUBLE
#define EW_IS_FLOAT 0
#include "edgewise_precision.h"
#include "edgewise_raster_template.h"
#undef EW_IS_FLOAT
#endif

#ifdef EW_HAS_FLOAT
#define EW_IS_FLOAT 1
#include "edgewise_precision.h"
#include "edgewise_raster_template.h"
#undef EW_IS_FLOAT
#endif

#else
extern int ew_ring_not_built;          /* a file must not be empty */
#endif

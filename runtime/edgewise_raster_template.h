/* edgewise_raster_template.h - images from rings; included by edgewise_raster.c once per precision.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#if EW_IS_FLOAT
#define EW_ROUND roundf
#else
#define EW_ROUND round
#endif
#define EW_RASTER(stem) EW_LOCAL(raster_##stem)

/* A ring goes into the difference image, or to the list. */
static int EW_RASTER(ring)(const ew_raster_image *image, const EW_REAL *x, const EW_REAL *y,
	size_t n)
{
	ew_raster_list *list = image->list;
	double own_x[EW_POINTS + 1 + EW_LANES_OF_EDGES], own_y[EW_POINTS + 1 + EW_LANES_OF_EDGES];
	double *to_x = list ? list->x + list->count : own_x;
	double *to_y = list ? list->y + list->count : own_y;
	const size_t most = list ? n : (size_t)EW_POINTS;
	size_t count;
	unsigned last = ew_raster_round((double)x[n - 1], &image->x, to_x)
		& ew_raster_round((double)y[n - 1], &image->y, to_y);
	for (size_t i = 0; i < n; i += count) {
		count = n - i < most ? n - i : most;
		const unsigned flags = last & image->ways->EW_ROUND(image, x + i, y + i, count,
			to_x + 1, to_y + 1);
		if (!(flags & EW_IN_RANGE))
			return EW_BAD_COORDINATE;
		if (!list)
			image->ways->edges(image, to_x, to_y, to_x + 1, to_y + 1, count,
				!(flags & EW_WITHIN));
		last = flags;
		to_x[0] = to_x[count];
		to_y[0] = to_y[count];
	}
	if (list) {
		for (size_t i = 0; i <= n; ++i)
			list->next[list->count + i] = i < n ? EW_NO_MORE : EW_NO_EDGE;
		list->count += n + 1;
	}
	return EW_OK;
}

static int EW_RASTER(rings)(const ew_raster_image *image, const EW_REAL *x, const EW_REAL *y,
	const int32_t *offsets, size_t rings)
{
	for (size_t r = 0; r < rings; ++r) {
		const size_t start = (size_t)offsets[r], n = (size_t)offsets[r + 1] - start;
		if (n == 0)
			continue;
		const int code = EW_RASTER(ring)(image, x + start, y + start, n);
		if (code)
			return code;
	}
	return EW_OK;
}

static int EW_RASTER(check)(const EW_REAL *x, const EW_REAL *y, const int32_t *offsets,
	size_t rings)
{
	if (rings == 0)
		return EW_OK;
	if (!offsets || ew_ring_bad_offsets(offsets, rings))
		return EW_BAD_OFFSETS;
	return offsets[0] < offsets[rings] && !(x && y) ? EW_BAD_IMAGE : EW_OK;
}

/* filter: NULL for the box. */
static int EW_RASTER(draw)(const ew_filter *filter, const EW_REAL *x, const EW_REAL *y,
	const int32_t *offsets, size_t rings, const ew_raster_pixels *to, int width, int height)
{
	ew_raster_scratch scratch;
	ew_raster_image image;
	int code = ew_raster_begin(&image, filter, width, height,
		rings ? (size_t)(offsets[rings] - offsets[0]) + rings : 0, &scratch);
	if (code)
		return code;
	code = EW_RASTER(rings)(&image, x, y, offsets, rings);
	if (!code)
		ew_raster_draw(&image, to);
	ew_raster_end(&image);
	return code;
}

int EW_NAME(raster)(const ew_filter *filter, const EW_REAL *x, const EW_REAL *y,
	const int32_t *offsets, size_t rings, float *pixels, int width, int height,
	ptrdiff_t row_stride)
{
	const ew_raster_pixels to = { pixels, NULL, row_stride };
	int code = filter ? ew_raster_check(pixels, width, height, row_stride) : EW_BAD_IMAGE;
	code = code ? code : EW_RASTER(check)(x, y, offsets, rings);
	if (code || width == 0 || height == 0)
		return code;
	return EW_RASTER(draw)(filter, x, y, offsets, rings, &to,
		width, height);
}

int EW_NAME(raster_u8)(const EW_REAL *x, const EW_REAL *y, const int32_t *offsets, size_t rings,
	unsigned char *pixels, int width, int height, ptrdiff_t row_stride)
{
	const ew_raster_pixels to = { NULL, pixels, row_stride };
	int code = ew_raster_check(pixels, width, height, row_stride);
	code = code ? code : EW_RASTER(check)(x, y, offsets, rings);
	if (code || width == 0 || height == 0)
		return code;
	return EW_RASTER(draw)(NULL, x, y, offsets, rings, &to, width, height);
}
#include "edgewise_raster_path_template.h"
#undef EW_RASTER
#undef EW_ROUND

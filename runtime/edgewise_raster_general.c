/* edgewise_raster_general.c - images by filters whose knots are not a pixel apart: slower, for any.
 *
 * Each edge is integrated over the support of every pixel that it comes near, by the kernels that
 * ew_NAME uses, L pixels of a row at a time. What an edge adds to pixel (i,j) is 0 where it is all
 * below the support and does not depend on j where it is all above; less that, it is a difference
 * image: pixels are the running sum down the columns, as in edgewise_raster.c. Whatever is added is
 * rounded to 2^-44, so that sums of doubles are exact in any order, and reversed rings give negated
 * bits; in the end to 2^-28, coarser than what rounding can leave of zero, so that pixels that no
 * edge comes near are exact for up to 2^15 edges over a column.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#include "edgewise_runtime.h"

#include <math.h>

#if defined(EW_HAS_FILTERS) && defined(EW_HAS_DOUBLE)

#define EW_FINE 0x1.8p8                /* a + EW_FINE - EW_FINE: a to a multiple of 2^-44 */
#define EW_COARSE 0x1.8p24             /* of 2^-28 */

int ew_raster_general_begin(ew_raster_general *image, const ew_filter *filter, int width,
	int height)
{
	const size_t columns = (size_t)width, rows = (size_t)height;
	if (columns > (size_t)PTRDIFF_MAX / sizeof(double) / rows)
		return EW_NO_MEMORY;
	image->sum = (double *)EW_MALLOC(columns * rows * sizeof *image->sum);
	if (!image->sum)
		return EW_NO_MEMORY;
	for (size_t i = 0; i < columns * rows; ++i)
		image->sum[i] = 0;
	image->filter = filter;
	image->width = width;
	image->height = height;
	image->run = ew_ring_kernel_of(filter->ring, ew_cpu_target());
	return EW_OK;
}

/* value[l] = what the edge adds to the filter centred at (first + l + 1/2, j + 1/2). */
static void ew_raster_general_row(const ew_raster_general *image, const double *edge, double first,
	double j, double *value)
{
	EW_ALIGNED double x[2 * EW_LANES];
	EW_ALIGNED double y[2 * EW_LANES];
	for (int l = 0; l < EW_LANES; ++l) {
		const double centre = first + l + 0.5;
		x[l] = edge[0] - centre;
		y[l] = edge[1] - (j + 0.5);
		x[EW_LANES + l] = edge[2] - centre;
		y[EW_LANES + l] = edge[3] - (j + 0.5);
		value[l] = 0;
	}
	image->run(x, y, x, EW_LANES, EW_LANES, EW_LANES, value);
	for (int l = 0; l < EW_LANES; ++l)
		value[l] = (value[l] + EW_FINE) - EW_FINE;
}

/* From `start` to `end`, at least low and at most high, as an index. */
static int ew_raster_general_index(double value, int low, int high)
{
	return value <= low ? low : value >= high ? high : (int)value;
}

void ew_raster_general_edge(const ew_raster_general *image, double x0, double y0, double x1,
	double y1)
{
	const ew_filter *f = image->filter;
	const double edge[4] = { x0, y0, x1, y1 };
	const double left = x0 < x1 ? x0 : x1, right = x0 < x1 ? x1 : x0;
	const double top = y0 < y1 ? y0 : y1, bottom = y0 < y1 ? y1 : y0;
	/* pixels whose support, i + 1/2 + first .. i + 1/2 + last, the edge may meet, and one more
	 * on each side */
	const int i0 = ew_raster_general_index(floor(left - f->last_x) - 1, 0, image->width);
	const int i1 = ew_raster_general_index(ceil(right - f->first_x) + 1, 0, image->width);
	const int j0 = ew_raster_general_index(floor(top - f->last_y) - 1, 0, image->height);
	const int j1 = ew_raster_general_index(ceil(bottom - f->first_y) + 1, 0, image->height);
	for (int i = i0; i < i1; i += EW_LANES) {
		const int lanes = i1 - i < EW_LANES ? i1 - i : (int)EW_LANES;
		EW_ALIGNED double before[EW_LANES];
		EW_ALIGNED double value[EW_LANES];
		/* the row before the first one sees the edge above its support */
		ew_raster_general_row(image, edge, i, floor(top - f->last_y) - 3, before);
		for (int j = j0; j < image->height && j <= j1; ++j) {
			double *sum = image->sum + (size_t)j * (size_t)image->width + i;
			ew_raster_general_row(image, edge, i, j, value);
			for (int l = 0; l < lanes; ++l) {
				sum[l] += value[l] - before[l];
				before[l] = value[l];
			}
		}
	}
}

void ew_raster_general_end(ew_raster_general *image, float *pixels, ptrdiff_t row_stride)
{
	for (int j = 0; j < image->height; ++j) {
		double *sum = image->sum + (size_t)j * (size_t)image->width;
		for (int i = 0; i < image->width; ++i) {
			if (j)
				sum[i] += sum[i - image->width];
			pixels[j * row_stride + i] = (float)((sum[i] + EW_COARSE) - EW_COARSE);
		}
	}
}

#else
extern int ew_ring_not_built;          /* a file must not be empty */
#endif

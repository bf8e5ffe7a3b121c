/* raster_reference.h - images to compare with: every pixel by clipping, from the definition.
 *
 * raster_exact is rational throughout and rounds once, to double; raster_reference does the same in
 * long double, for large images and many edges. Filters are those of window_reference.h, pixel
 * (i,j) has its centre at (i + 1/2, j + 1/2), and out[j * width + i] is its value.
 */
#ifndef RASTER_REFERENCE_H
#define RASTER_REFERENCE_H

#include <stdint.h>

#include "window_reference.h"

typedef struct {
	const double *x, *y;
	const int32_t *offsets;
	size_t rings;
} RasterRings;

void raster_exact(double *out, const WindowFilter *filter, const RasterRings *rings, int width,
	int height);

void raster_reference(double *out, const WindowFilter *filter, const RasterRings *rings, int width,
	int height);

#endif

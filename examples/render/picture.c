/* picture.c - from values of the library to light.
 *
 * Values are coverage, and coverage is linear: half a pixel of white ink on black paper gives half
 * the light. So a Picture holds linear light, and only png.c encodes it (sRGB).
 *
 * A value is an integral of the winding number, not of 0 or 1, and filters with negative lobes
 * (mitchell, catmull_rom) over- and undershoot besides. What is painted is the value clamped to
 * 0..1 after its sign was turned by that of the winding around: overlaps count once (exact wherever
 * the rings that overlap do not also end inside of the same support), rings of either direction are
 * ink, and a lobe is less than nothing, not ink of its own. Around means under the cubic B-spline,
 * which is as wide as the widest built-in filter and has no lobes.
 *
 * Tiles are summed up before anything is clamped. What the filter gives to neighbours adds up to
 * the bits of what it gives to both together, so no seam shows. */
#include "render.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Which filters the library has that this program is linked with: the Makefile says so. */
#ifndef RENDER_FILTERS
#define RENDER_FILTERS(X) X(box) X(tent) X(bspline2) X(bspline3) X(catmull_rom) X(mitchell)
#endif

#define ENTRY(name) { #name, &ew_filter_##name },
static const struct {
	const char *name;
	const ew_filter *filter;
} filters[] = { RENDER_FILTERS(ENTRY) };

enum { FILTERS = (int)(sizeof filters / sizeof *filters) };

const ew_filter *find_filter(const char *name)
{
	for (int i = 0; i < FILTERS; i++)
		if (!strcmp(filters[i].name, name))
			return filters[i].filter;
	return NULL;
}

void list_filters(void)
{
	for (int i = 0; i < FILTERS; i++)
		puts(filters[i].name);
}

Colour colour_of(unsigned rgb)
{
	float channel[3];
	for (int i = 0; i < 3; i++) {
		const double value = (rgb >> (16 - 8 * i) & 0xff) / 255.0;
		channel[i] = (float)(value <= 0.04045 ? value / 12.92 :
							pow((value + 0.055) / 1.055, 2.4));
	}
	return (Colour){ channel[0], channel[1], channel[2] };
}

Picture picture_new(int width, int height)
{
	return (Picture){ width, height,
			  allocate((size_t)width * (size_t)height, 4 * sizeof(float)) };
}

void picture_free(Picture *picture)
{
	free(picture->light);
	*picture = (Picture){ 0 };
}

/* `over` of Porter and Duff, on colours multiplied by alpha. */
static void blend(float *light, Colour ink, float coverage)
{
	const float source[] = { ink.red, ink.green, ink.blue, 1 };
	for (int i = 0; i < 4; i++)
		light[i] = source[i] * coverage + light[i] * (1 - coverage);
}

void picture_fill(Picture *picture, Colour paper)
{
	const size_t count = (size_t)picture->width * (size_t)picture->height;
	for (size_t i = 0; i < count; i++)
		blend(picture->light + 4 * i, paper, 1);
}

float *raster(const ew_filter *filter, const Drawing *drawing, int width, int height)
{
	float *values = allocate((size_t)width * (size_t)height, sizeof *values);
	const int code = ew_raster_path(filter, drawing->verbs, drawing->verb_count,
					drawing->points, drawing->number_count / 2,
					drawing->weights, drawing->weight_count, values, width,
					height, width);
	if (code == EW_BAD_COORDINATE)
		fail("a coordinate is too far away: beyond 2^30 pixels");
	if (code == EW_NO_MEMORY)
		fail("no room to draw %d x %d pixels", width, height);
	if (code)
		fail("the library refuses the drawing with code %d", code);
	return values;
}

static float clamp(float value)
{
	return value > 0 ? value < 1 ? value : 1 : 0;
}

/* See above; in place. */
static void to_coverage(float *values, const Drawing *drawing, int width, int height)
{
	const size_t count = (size_t)width * (size_t)height;
	bool negative = false;
	for (size_t i = 0; i < count; i++)
		negative = negative || values[i] < 0;
	float *around = negative ? raster(&ew_filter_bspline3, drawing, width, height) : NULL;
	for (size_t i = 0; i < count; i++)
		values[i] = clamp(around && around[i] < 0 ? -values[i] : values[i]);
	free(around);
}

void paint(Picture *picture, const ew_filter *filter, const Drawing *drawing, Colour ink)
{
	const size_t count = (size_t)picture->width * (size_t)picture->height;
	float *values = raster(filter, drawing, picture->width, picture->height);
	to_coverage(values, drawing, picture->width, picture->height);
	for (size_t i = 0; i < count; i++)
		blend(picture->light + 4 * i, ink, values[i]);
	free(values);
}

/* y runs downwards, so the counterclockwise rings of the map have values below 0. */
void paint_tiles(Picture *picture, const ew_filter *filter, const Drawing *drawings,
		 const Colour *inks, int count)
{
	const size_t pixels = (size_t)picture->width * (size_t)picture->height;
	float *sum = allocate(pixels, 4 * sizeof *sum);
	for (int k = 0; k < count; k++) {
		const float ink[] = { inks[k].red, inks[k].green, inks[k].blue, 1 };
		float *values = raster(filter, &drawings[k], picture->width, picture->height);
		for (size_t i = 0; i < 4 * pixels; i++)
			sum[i] -= values[i / 4] * ink[i % 4];
		free(values);
	}
	for (size_t i = 0; i < pixels; i++) {
		const float coverage = clamp(sum[4 * i + 3]);
		for (int c = 0; c < 4; c++) {
			float *light = &picture->light[4 * i + (size_t)c];
			*light = clamp(sum[4 * i + (size_t)c]) + *light * (1 - coverage);
		}
	}
	free(sum);
}

void picture_put(Picture *to, const Picture *from, int x, int y, int zoom)
{
	for (int j = 0; j < from->height * zoom; j++)
		for (int i = 0; i < from->width * zoom; i++) {
			const long target = (long)(y + j) * to->width + x + i;
			const long source = (long)(j / zoom) * from->width + i / zoom;
			memcpy(to->light + 4 * target, from->light + 4 * source, 4 * sizeof(float));
		}
}

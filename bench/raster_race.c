/* raster_race.c - drawing as trials: every painter and every function of ours over a set.
 *
 * One repetition draws all polygons of the set, one after the other, each into the same memory,
 * which so stays as near as its size allows, for everybody. All that a caller pays is timed: the
 * image is cleared, and every pixel is written. Whoever draws one polygon many times in a row has
 * its branches learnt by heart; text is not like that, so this is measured apart. */
#include "raster.h"

#include <stdio.h>
#include <stdlib.h>

/* ---- pixels ---- */

Pixels pixels_new(const Set *set)
{
	size_t most = 0;
	for (int i = 0; i < set->count; ++i) {
		const Scene *s = &set->drawing[i].scene;
		const size_t size = (size_t)s->stride * (size_t)s->height;
		most = size > most ? size : most;
	}
	Pixels pixels = { allocate(most), allocate(most * sizeof(float)) };
	return pixels;
}

void pixels_free(Pixels *pixels)
{
	free(pixels->bytes);
	free(pixels->floats);
}

void pixels_spoil(Pixels pixels, const Scene *scene)
{
	const size_t size = (size_t)scene->stride * (size_t)scene->height;
	for (size_t i = 0; i < size; ++i) {
		pixels.bytes[i] = (unsigned char)(85 + i % 86);
		pixels.floats[i] = (float)NAN;
	}
}

static double worse(double worst, double error)
{
	return isnan(error) ? HUGE_VAL : fmax(worst, error);
}

double worst_byte(const Scene *scene, const unsigned char *pixels, const double *exact)
{
	double worst = 0;
	for (int j = 0; j < scene->height; ++j, pixels += scene->stride)
		for (int i = 0; i < scene->width; ++i)
			worst = worse(worst, fabs(pixels[i] / 255. - fmin(fabs(*exact++), 1)));
	return worst;
}

double worst_float(const Scene *scene, const float *pixels, const double *exact)
{
	double worst = 0;
	for (int j = 0; j < scene->height; ++j, pixels += scene->stride)
		for (int i = 0; i < scene->width; ++i)
			worst = worse(worst, fabs((double)pixels[i] - *exact++));
	return worst;
}

/* ---- painters ---- */

int paint_begin(PaintJob *job, const Painter *painter, const Set *set, Pixels pixels)
{
	*job = (PaintJob){ painter, 0, 1, allocate((size_t)set->count * sizeof(void *)) };
	while (painter->prepare && job->count < set->count) {
		void *picture = painter->prepare(&set->drawing[job->count].scene, pixels.bytes);
		if (!picture)
			break;
		job->picture[job->count++] = picture;
	}
	if (job->count == set->count)
		return 1;
	paint_end(job);
	return 0;
}

void paint_end(PaintJob *job)
{
	for (int i = 0; i < job->count; ++i)
		job->painter->release(job->picture[i]);
	free(job->picture);
}

void paint_run(const void *context, long repeat)
{
	const PaintJob *job = context;
	while (repeat-- > 0)
		for (int i = 0; i < job->count; ++i)
			for (int k = 0; k < job->times; ++k)
				job->painter->draw(job->picture[i]);
}

/* ---- our functions ---- */

static int draw_double(const DrawJob *job, const Drawing *d)
{
	const Scene *s = &d->scene;
	if (job->how == TO_BYTES)
		return ew_raster_u8(d->x, d->y, d->offsets, s->rings, job->pixels.bytes, s->width,
			s->height, s->stride);
	if (job->how == TO_FLOATS)
		return ew_raster(job->filter, d->x, d->y, d->offsets, s->rings,
			job->pixels.floats, s->width, s->height, s->stride);
	return ew_raster_path(job->filter, d->verb, d->verbs, d->point, d->points, NULL, 0,
		job->pixels.floats, s->width, s->height, s->stride);
}

static int draw_float(const DrawJob *job, const Drawing *d)
{
	const Scene *s = &d->scene;
	if (job->how == TO_BYTES)
		return ew_raster_u8f(d->xf, d->yf, d->offsets, s->rings, job->pixels.bytes,
			s->width, s->height, s->stride);
	if (job->how == TO_FLOATS)
		return ew_rasterf(job->filter, d->xf, d->yf, d->offsets, s->rings,
			job->pixels.floats, s->width, s->height, s->stride);
	return ew_raster_pathf(job->filter, d->verb, d->verbs, d->pointf, d->points, NULL, 0,
		job->pixels.floats, s->width, s->height, s->stride);
}

static void draw(const DrawJob *job, const Drawing *drawing)
{
	const int status = (job->precision == DOUBLE ? draw_double : draw_float)(job, drawing);
	if (status != EW_OK) {
		fprintf(stderr, "bench: drawing failed with code %d\n", status);
		exit(1);
	}
}

void draw_one(const DrawJob *job, const Drawing *drawing)
{
	ew_use_target(job->target);
	draw(job, drawing);
	ew_use_target(0);
}

void draw_run(const void *context, long repeat)
{
	const DrawJob *job = context;
	ew_use_target(job->target);
	while (repeat-- > 0)
		for (int i = 0; i < job->set->count; ++i)
			for (int k = 0; k < job->times; ++k)
				draw(job, &job->set->drawing[i]);
	ew_use_target(0);
}

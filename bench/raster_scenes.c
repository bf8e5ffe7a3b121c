/* raster_scenes.c - the polygons of the raster section and the images they are drawn into.
 *
 * All coordinates are floats, so that everybody is given the same polygons; what a library then
 * makes of them (FreeType rounds to 1/64 of a pixel, cairo and AGG to 1/256) is part of its error.
 * A glyph is drawn into the image that just holds it, as a text renderer would; rows are padded to
 * a multiple of four pixels, which cairo asks for. Smooth polygons and the star fill a square. */
#include "raster.h"

#include <stdlib.h>
#include <stdio.h>
#include <string.h>

static const char font[] = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";

enum { FIRST = 33, LAST = 126 };

static double random_unit(void)
{
	static uint64_t state = 5;
	state = state * 6364136223846793005u + 1442695040888963407u;
	return (double)(state >> 40) / 16777216.0;
}

/* ---- drawings ---- */

static Drawing drawing_new(size_t vertices, size_t rings)
{
	Drawing d;
	memset(&d, 0, sizeof d);
	d.offsets = allocate((rings + 1) * sizeof *d.offsets);
	d.x = allocate(vertices * sizeof *d.x);
	d.y = allocate(vertices * sizeof *d.y);
	d.xf = allocate(vertices * sizeof *d.xf);
	d.yf = allocate(vertices * sizeof *d.yf);
	d.offsets[0] = 0;
	d.scene.offsets = d.offsets;
	d.scene.x = d.x;
	d.scene.y = d.y;
	return d;
}

static void set_size(Scene *scene, int width, int height)
{
	scene->width = width;
	scene->height = height;
	scene->stride = (width + 3) / 4 * 4;
}

static void add_vertex(Drawing *d, double x, double y)
{
	int32_t *at = &d->offsets[d->scene.rings + 1];
	d->xf[*at] = (float)x;
	d->yf[*at] = (float)y;
	d->x[*at] = (double)d->xf[*at];
	d->y[*at] = (double)d->yf[*at];
	++*at;
}

static void end_ring(Drawing *d)
{
	++d->scene.rings;
}

static void begin_ring(Drawing *d)
{
	d->offsets[d->scene.rings + 1] = d->offsets[d->scene.rings];
}

Drawing drawing_scaled(const Drawing *from, int factor)
{
	const Scene *s = &from->scene;
	Drawing d = drawing_new((size_t)s->offsets[s->rings], s->rings);
	for (size_t i = 0; i < s->rings; ++i) {
		begin_ring(&d);
		for (int32_t k = s->offsets[i]; k < s->offsets[i + 1]; ++k)
			add_vertex(&d, factor * s->x[k], factor * s->y[k]);
		end_ring(&d);
	}
	set_size(&d.scene, factor * s->width, factor * s->height);
	return d;
}

void drawing_free(Drawing *d)
{
	free(d->offsets);
	free(d->x);
	free(d->y);
	free(d->xf);
	free(d->yf);
	free(d->verb);
	free(d->point);
	free(d->pointf);
}

/* ---- glyphs ---- */

/* A quad in n equal parts of its parameter is off by |p0 - 2 p1 + p2| / (4 n^2). */
static int quad_parts(const double *p, double tolerance)
{
	const double bend = hypot(p[0] - 2 * p[2] + p[4], p[1] - 2 * p[3] + p[5]);
	const double parts = ceil(sqrt(bend / (4 * tolerance)));
	return parts < 1 ? 1 : (int)parts;
}

static void add_quad(Drawing *d, const double *p, double tolerance)
{
	const int parts = quad_parts(p, tolerance);
	for (int i = 1; i <= parts; ++i) {
		const double t = (double)i / parts, s = 1 - t;
		add_vertex(d, s * s * p[0] + 2 * s * t * p[2] + t * t * p[4],
			s * s * p[1] + 2 * s * t * p[3] + t * t * p[5]);
	}
}

/* Vertices and rings at most. */
static void count_vertices(const Drawing *path, double tolerance, size_t count[2])
{
	const double *p = path->point;
	count[0] = count[1] = 0;
	for (size_t i = 0; i < path->verbs; ++i) {
		const int verb = path->verb[i];
		count[0] += verb == EW_QUAD ? (size_t)quad_parts(p - 2, tolerance) : 1;
		count[1] += verb == EW_MOVE;
		p += verb == EW_QUAD ? 4 : verb == EW_CLOSE ? 0 : 2;
	}
}

Drawing drawing_refined(const Drawing *path, double tolerance)
{
	const double *p = path->point;
	size_t count[2];
	count_vertices(path, tolerance, count);
	Drawing d = drawing_new(count[0], count[1]);
	for (size_t i = 0; i < path->verbs; ++i)
		switch (path->verb[i]) {
		case EW_MOVE:
			begin_ring(&d);
			/* fall through */
		case EW_LINE:
			add_vertex(&d, p[0], p[1]);
			p += 2;
			break;
		case EW_QUAD:
			add_quad(&d, p - 2, tolerance);
			p += 4;
			break;
		default:
			end_ring(&d);
		}
	set_size(&d.scene, path->scene.width, path->scene.height);
	return d;
}

/* Its lines take over the curves. */
static Drawing drawing_of_path(const Drawing *path, double tolerance)
{
	Drawing d = drawing_refined(path, tolerance);
	d.verb = path->verb;
	d.point = path->point;
	d.pointf = path->pointf;
	d.verbs = path->verbs;
	d.points = path->points;
	return d;
}

/* Scaled, y turned down, moved by whole pixels into the smallest image that holds all points. */
static Drawing path_of(const Outline *o, int size, int margin)
{
	const double scale[2] = { size / o->em, -size / o->em };
	double least[2] = { HUGE_VAL, HUGE_VAL }, most[2] = { -HUGE_VAL, -HUGE_VAL };
	Drawing path;
	memset(&path, 0, sizeof path);
	path.verb = allocate(o->verbs);
	path.point = allocate(2 * o->points * sizeof *path.point);
	path.pointf = allocate(2 * o->points * sizeof *path.pointf);
	path.verbs = o->verbs;
	path.points = o->points;
	memcpy(path.verb, o->verb, o->verbs);
	for (size_t i = 0; i < 2 * o->points; ++i) {
		least[i % 2] = fmin(least[i % 2], scale[i % 2] * o->point[i]);
		most[i % 2] = fmax(most[i % 2], scale[i % 2] * o->point[i]);
	}
	for (size_t i = 0; i < 2 * o->points; ++i) {
		path.pointf[i] = (float)(scale[i % 2] * o->point[i] - floor(least[i % 2]) + margin);
		path.point[i] = (double)path.pointf[i];
	}
	set_size(&path.scene, (int)(ceil(most[0]) - floor(least[0])) + 2 * margin,
		(int)(ceil(most[1]) - floor(least[1])) + 2 * margin);
	return path;
}

/* ---- sets ---- */

static Set set_new(int size, int most)
{
	Set set = { "", size, 0, 0, 0, allocate((size_t)most * sizeof(Drawing)) };
	return set;
}

static void set_add(Set *set, Drawing drawing)
{
	const Scene *s = &drawing.scene;
	const double before = set->count, after = before + 1;
	set->pixels = (set->pixels * before + (double)s->width * s->height) / after;
	set->vertices = (set->vertices * before + s->offsets[s->rings]) / after;
	set->drawing[set->count++] = drawing;
}

Set glyphs_make(int size, int margin, double tolerance, int every)
{
	Set set = set_new(size, LAST - FIRST + 1);
	snprintf(set.name, sizeof set.name, "glyphs, %d px", size);
	for (int c = FIRST; c <= LAST && painter_FreeType.outline; c += every) {
		Outline outline;
		if (!painter_FreeType.outline(font, c, &outline))
			break;
		const Drawing path = path_of(&outline, size, margin);
		set_add(&set, drawing_of_path(&path, tolerance));
		free(outline.verb);
		free(outline.point);
	}
	return set;
}

static Set polygon_set(const char *kind, int edges, int size, double (*radius)(double angle),
	int turns)
{
	Set set = set_new(size, 1);
	Drawing d = drawing_new((size_t)edges, 1);
	snprintf(set.name, sizeof set.name, "%s %d, %d px", kind, edges, size);
	begin_ring(&d);
	for (int i = 0; i < edges; ++i) {
		const double angle = 6.283185307179586 * turns * i / edges;
		const double r = radius(angle) * size;
		add_vertex(&d, size / 2. + r * cos(angle), size / 2. + r * sin(angle));
	}
	end_ring(&d);
	set_size(&d.scene, size, size);
	set_add(&set, d);
	return set;
}

static double smooth_radius(double angle)
{
	return 0.4 * (1 + 0.12 * cos(3 * angle + 1) + 0.08 * cos(5 * angle + 2)
		+ 0.04 * cos(11 * angle + 3));
}

static double star_radius(double angle)
{
	(void)angle;
	return 0.05 + 0.44 * random_unit();
}

Set smooth_make(int edges, int size)
{
	return polygon_set("smooth", edges, size, smooth_radius, 1);
}

Set star_make(int edges, int size)
{
	return polygon_set("star", edges, size, star_radius, 7);
}

void set_free(Set *set)
{
	for (int i = 0; i < set->count; ++i)
		drawing_free(&set->drawing[i]);
	free(set->drawing);
}

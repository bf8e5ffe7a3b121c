/* peer_cairo.c - cairo: a path filled on an A8 image surface.
 *
 * Surface, context and path are made before anything is timed. What is timed: the surface is
 * cleared, the prebuilt path is handed over by cairo_append_path (a fill consumes it) and filled.
 * ANTIALIAS_DEFAULT; GOOD and BEST take the same way through cairo 1.16 for a fill, by 15 samples
 * per pixel down and exact spans across. Coordinates become 24.8 fixed point. */
#include "peers.h"

#include <cairo/cairo.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
	cairo_surface_t *surface;
	cairo_t *context;
	cairo_path_t *path;
	unsigned char *pixels;
	size_t bytes;
} Picture;

static void require(int condition)
{
	if (!condition) {
		fprintf(stderr, "bench: cairo failed\n");
		exit(1);
	}
}

static void *prepare(const Scene *scene, unsigned char *pixels)
{
	Picture *p = malloc(sizeof *p);
	require(p != NULL);
	p->pixels = pixels;
	p->bytes = (size_t)scene->stride * (size_t)scene->height;
	p->surface = cairo_image_surface_create_for_data(pixels, CAIRO_FORMAT_A8, scene->width,
		scene->height, scene->stride);
	p->context = cairo_create(p->surface);
	cairo_set_source_rgba(p->context, 1, 1, 1, 1);
	cairo_set_antialias(p->context, CAIRO_ANTIALIAS_DEFAULT);
	for (size_t i = 0; i < scene->rings; ++i) {
		for (int32_t k = scene->offsets[i]; k < scene->offsets[i + 1]; ++k)
			(k == scene->offsets[i] ? cairo_move_to : cairo_line_to)(p->context,
				scene->x[k], scene->y[k]);
		cairo_close_path(p->context);
	}
	p->path = cairo_copy_path(p->context);
	require(p->path->status == CAIRO_STATUS_SUCCESS);
	require(cairo_status(p->context) == CAIRO_STATUS_SUCCESS);
	return p;
}

static void release(void *picture)
{
	Picture *p = picture;
	cairo_path_destroy(p->path);
	cairo_destroy(p->context);
	cairo_surface_destroy(p->surface);
	free(p);
}

static void draw(void *picture)
{
	Picture *p = picture;
	cairo_surface_flush(p->surface);
	memset(p->pixels, 0, p->bytes);
	cairo_surface_mark_dirty(p->surface);
	cairo_new_path(p->context);
	cairo_append_path(p->context, p->path);
	cairo_fill(p->context);
	cairo_surface_flush(p->surface);
	require(cairo_status(p->context) == CAIRO_STATUS_SUCCESS);
}

const Painter painter_cairo = { prepare, release, draw, NULL };

/* peer_stb.c - stb_truetype: stbtt_Rasterize.
 *
 * Its vertices are prepared, with coordinates of float in place of short, which the library allows
 * for, so that all polygons are what they are elsewhere. It writes every pixel, so there is nothing
 * to clear. The library is compiled in this file, and its warnings are not ours. */
#include "peers.h"

#include <stdlib.h>
#include <string.h>

#define stbtt_vertex stbtt_vertex
#define stbtt_vertex_type float
typedef struct { float x, y, cx, cy, cx1, cy1; unsigned char type, padding; } stbtt_vertex;

#define STBTT_STATIC
#define STB_TRUETYPE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpragmas"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

typedef struct { stbtt_vertex *vertex; int vertices; stbtt__bitmap bitmap; } Picture;

static void add(Picture *p, int type, double x, double y)
{
	stbtt_vertex *vertex = &p->vertex[p->vertices++];
	memset(vertex, 0, sizeof *vertex);
	vertex->type = (unsigned char)type;
	vertex->x = (float)x;
	vertex->y = (float)y;
}

static void *prepare(const Scene *scene, unsigned char *pixels)
{
	Picture *p = malloc(sizeof *p);
	const size_t room = (size_t)scene->offsets[scene->rings] + scene->rings;
	stbtt_vertex *vertex = malloc(room * sizeof *vertex);
	if (!p || !vertex)
		abort();
	*p = (Picture){ vertex, 0, { scene->width, scene->height, scene->stride, pixels } };
	for (size_t i = 0; i < scene->rings; ++i) {
		const int32_t first = scene->offsets[i];
		for (int32_t k = first; k < scene->offsets[i + 1]; ++k)
			add(p, k == first ? STBTT_vmove : STBTT_vline, scene->x[k], scene->y[k]);
		add(p, STBTT_vline, scene->x[first], scene->y[first]);
	}
	return p;
}

static void release(void *picture)
{
	Picture *p = picture;
	free(p->vertex);
	free(p);
}

static void draw(void *picture)
{
	Picture *p = picture;
	stbtt_Rasterize(&p->bitmap, 0.35f, p->vertex, p->vertices, 1, 1, 0, 0, 0, 0, 0, NULL);
}

const Painter painter_stb = { prepare, release, draw, NULL };

/* peer_freetype.c - FreeType: its smooth rasteriser on outlines, and outlines of a font.
 *
 * FT_Outline_Render into a bitmap that the caller clears. The outline is made before anything is
 * timed, in FreeType's units of 1/64 pixel and with y up, all points on the curve; it holds at most
 * 32767 points. TrueType fonts have lines and quads only; a cubic is refused. */
#include "peers.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
	FT_Outline outline;
	FT_Bitmap bitmap;
	FT_Raster_Params parameters;
} Picture;

static FT_Library library;

static void require(int condition)
{
	if (!condition) {
		fprintf(stderr, "bench: FreeType failed\n");
		exit(1);
	}
}

static void fill_outline(FT_Outline *outline, const Scene *scene)
{
	for (int i = 0; i < outline->n_points; ++i) {
		outline->points[i].x = lround(64 * scene->x[i]);
		outline->points[i].y = lround(64 * (scene->height - scene->y[i]));
		outline->tags[i] = FT_CURVE_TAG_ON;
	}
	for (int i = 0; i < outline->n_contours; ++i)
		outline->contours[i] = (short)(scene->offsets[i + 1] - 1);
}

static void *prepare(const Scene *scene, unsigned char *pixels)
{
	const int32_t points = scene->offsets[scene->rings];
	if (points > SHRT_MAX)
		return NULL;
	Picture *p = calloc(1, sizeof *p);
	require(p != NULL && (library || FT_Init_FreeType(&library) == 0));
	require(FT_Outline_New(library, (FT_UInt)points, (FT_Int)scene->rings, &p->outline) == 0);
	fill_outline(&p->outline, scene);
	p->bitmap.rows = (unsigned)scene->height;
	p->bitmap.width = (unsigned)scene->width;
	p->bitmap.pitch = scene->stride;
	p->bitmap.buffer = pixels;
	p->bitmap.num_grays = 256;
	p->bitmap.pixel_mode = FT_PIXEL_MODE_GRAY;
	return p;
}

static void release(void *picture)
{
	Picture *p = picture;
	FT_Outline_Done(library, &p->outline);
	free(p);
}

static void draw(void *picture)
{
	Picture *p = picture;
	memset(p->bitmap.buffer, 0, (size_t)p->bitmap.pitch * p->bitmap.rows);
	p->parameters.target = &p->bitmap;
	p->parameters.flags = FT_RASTER_FLAG_AA;
	require(FT_Outline_Render(library, &p->outline, &p->parameters) == 0);
}

/* ---- outlines ---- */

enum { MOVE = 0, LINE = 1, QUAD = 2, CLOSE = 5 };      /* as Outline has them */

static void add(Outline *o, int verb, const FT_Vector *first, const FT_Vector *second)
{
	const FT_Vector *point[] = { first, second };
	if (verb == MOVE && o->verbs > 0)
		o->verb[o->verbs++] = CLOSE;
	o->verb[o->verbs++] = (unsigned char)verb;
	for (int i = 0; i < 2 && point[i]; ++i) {
		o->point[2 * o->points] = (double)point[i]->x;
		o->point[2 * o->points++ + 1] = (double)point[i]->y;
	}
}

static int move_to(const FT_Vector *to, void *outline)
{
	add(outline, MOVE, to, NULL);
	return 0;
}

static int line_to(const FT_Vector *to, void *outline)
{
	add(outline, LINE, to, NULL);
	return 0;
}

static int quad_to(const FT_Vector *control, const FT_Vector *to, void *outline)
{
	add(outline, QUAD, control, to);
	return 0;
}

static int cubic_to(const FT_Vector *a, const FT_Vector *b, const FT_Vector *to, void *outline)
{
	(void)a, (void)b, (void)to, (void)outline;
	return 1;
}

/* A point of FreeType's makes one verb and two points at most, a contour three verbs more. */
static int outline(const char *font, int character, Outline *o)
{
	static const FT_Outline_Funcs functions = { move_to, line_to, quad_to, cubic_to, 0, 0 };
	FT_Face face;
	require(library || FT_Init_FreeType(&library) == 0);
	if (FT_New_Face(library, font, 0, &face) != 0)
		return 0;
	int good = FT_Load_Char(face, (FT_ULong)character, FT_LOAD_NO_SCALE) == 0;
	if (good) {
		FT_Outline *source = &face->glyph->outline;
		const size_t room = (size_t)source->n_points + 3 * (size_t)source->n_contours + 1;
		*o = (Outline){ malloc(room), malloc(4 * room * sizeof *o->point), 0, 0,
			face->units_per_EM };
		require(o->verb != NULL && o->point != NULL);
		good = FT_Outline_Decompose(source, &functions, o) == 0 && o->verbs > 0;
		o->verb[o->verbs++] = CLOSE;
	}
	FT_Done_Face(face);
	return good;
}

const Painter painter_FreeType = { prepare, release, draw, outline };

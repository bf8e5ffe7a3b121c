/* render.h - what the parts of examples/render share.
 *
 *     font.c svg.c countries.c  --->  Drawing (a path)  ---picture.c--->  light  ---png.c--->  file
 *
 * A Drawing holds verbs, points and weights as ew_raster_path takes them; x grows to the right and
 * y downwards once it is placed on a Picture. main.c reads the command line, sheet.c composes the
 * contact sheet. Everything that fails says why and ends the program: no caller checks. */
#ifndef RENDER_H
#define RENDER_H

#include <stdbool.h>
#include <stddef.h>

#include "edgewise.h"

/* ---- main.c ---- */

#define PRINTF(string, first) __attribute__((format(printf, string, first)))
_Noreturn void fail(const char *format, ...) PRINTF(1, 2);

/* ---- drawing.c: paths ---- */

typedef struct {
	unsigned char *verbs;
	double *points; /* x, y, x, y, ... */
	double *weights;
	size_t verb_count, number_count, weight_count;
} Drawing;

typedef struct {
	double left, top, right, bottom; /* left > right: empty */
} Box;

/* x' = scale x + x, y' = scale_y y + y */
typedef struct {
	double scale_x, scale_y, x, y;
} Placement;

void *allocate(size_t count, size_t size); /* zeros */
void *grow(void *array, size_t count, size_t size); /* room for one more behind `count` */
int verb_points(unsigned char verb);
/* A conic takes its weight too. */
void drawing_add(Drawing *drawing, unsigned char verb, const double *points, double weight);
void drawing_move(Drawing *drawing, double x, double y);
void drawing_line(Drawing *drawing, double x, double y);
void drawing_close(Drawing *drawing);
/* An ellipse of four conics; a negative radius in y turns the other way. */
void drawing_ellipse(Drawing *drawing, double x, double y, double radius_x, double radius_y);
void drawing_append(Drawing *drawing, const Drawing *other, Placement place);
void drawing_place(Drawing *drawing, Placement place);
Box drawing_box(const Drawing *drawing); /* of the control points */
void drawing_free(Drawing *drawing);
/* The largest placement without turning that puts `box` into the middle of `room`. */
Placement fit(Box box, Box room);

/* ---- font.c: outlines of text, by FreeType ---- */

typedef struct Font Font;

Font *font_open(const char *file);
void font_close(Font *font);
/* Text with its origin at (0, 0), y downwards, an em of `size`; returns the advance. */
double font_text(Font *font, const char *text, double size, Drawing *drawing);
/* What is left above and below of the line, in parts of an em. */
void font_extents(const Font *font, double *ascent, double *descent);

/* ---- svg.c: paths of SVG ---- */

typedef struct {
	Drawing *paths;
	size_t count;
	Box view; /* the viewBox, else the size, else empty */
} Svg;

void svg_read_file(const char *file, Svg *svg);
void svg_read_path(const char *data, Svg *svg);

/* ---- countries.c: a map ---- */

enum { MAP_COLOURS = 5 };

/* One drawing per colour; neighbours differ. `only`: the name of one country, or NULL for all. */
typedef struct {
	Drawing land[MAP_COLOURS];
} Map;

void map_read_file(const char *file, const char *only, Map *map);
void map_free(Map *map);

/* ---- picture.c: light ---- */

typedef struct {
	float red, green, blue; /* linear, 0..1 */
} Colour;

typedef struct {
	int width, height;
	float *light; /* per pixel red, green, blue, alpha: linear, colours multiplied by alpha */
} Picture;

const ew_filter *find_filter(const char *name); /* NULL if the program has none of this name */
void list_filters(void);
Colour colour_of(unsigned rgb); /* 0xrrggbb in sRGB */
Picture picture_new(int width, int height);
void picture_free(Picture *picture);
void picture_fill(Picture *picture, Colour paper);
/* The values of a drawing, as they come from the library. */
float *raster(const ew_filter *filter, const Drawing *drawing, int width, int height);
/* Paints over what is there; values are taken as coverage, 0 to 1. */
void paint(Picture *picture, const ew_filter *filter, const Drawing *drawing, Colour ink);
/* Adds `count` drawings that fit together without gaps, each weighted by its winding. */
void paint_tiles(Picture *picture, const ew_filter *filter, const Drawing *drawings,
		 const Colour *inks, int count);
/* Puts `from` at (x, y) of `to`, each pixel a square of `zoom` pixels. */
void picture_put(Picture *to, const Picture *from, int x, int y, int zoom);

/* ---- png.c ---- */

typedef enum { GREY, RGBA } Channels;

void picture_write(const Picture *picture, Channels channels, const char *file);

/* ---- sheet.c ---- */

Picture make_sheet(Font *font);

#endif

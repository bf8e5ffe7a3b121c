/* font.c - the outlines of a text, set by FreeType.
 *
 * FreeType reads the font and puts composite glyphs together; nothing is hinted, and nothing but
 * the final scale rounds a coordinate: FreeType is asked for twice the outline in font units, in
 * which the points that TrueType leaves out are whole numbers. Glyphs stand side by side by their
 * advances and the kerning of the font's `kern` table; '\n' begins a line. */
#include "render.h"

#include "../face.h"
#include "../utf8.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_OUTLINE_H

struct Font {
	const char *file;
	FT_Library library;
	FT_Face face;
};

typedef struct {
	Drawing *drawing;
	double scale, x, y;
} Pen;

Font *font_open(const char *file)
{
	Font *font = allocate(1, sizeof *font);
	font->file = file;
	font->face = open_face(&font->library, file);
	if (FT_Select_Charmap(font->face, FT_ENCODING_UNICODE))
		fail("%s has no table of Unicode characters", file);
	return font;
}

void font_close(Font *font)
{
	FT_Done_FreeType(font->library); /* and with it the face */
	free(font);
}

void font_extents(const Font *font, double *ascent, double *descent)
{
	*ascent = (double)font->face->ascender / font->face->units_per_EM;
	*descent = -(double)font->face->descender / font->face->units_per_EM;
}

/* ---- outlines: FreeType's y grows upwards ---- */

static int add(void *user, unsigned char verb, const FT_Vector *const *points)
{
	const Pen *pen = user;
	double placed[6];
	for (int i = 0; i < verb_points(verb); i++) {
		placed[2 * i] = pen->x + pen->scale * ((double)points[i]->x / 2);
		placed[2 * i + 1] = pen->y - pen->scale * ((double)points[i]->y / 2);
	}
	drawing_add(pen->drawing, verb, placed, 0);
	return 0;
}

static int move_to(const FT_Vector *to, void *pen)
{
	return add(pen, EW_MOVE, &to);
}

static int line_to(const FT_Vector *to, void *pen)
{
	return add(pen, EW_LINE, &to);
}

static int quad_to(const FT_Vector *control, const FT_Vector *to, void *pen)
{
	return add(pen, EW_QUAD, (const FT_Vector *[]){ control, to });
}

static int cubic_to(const FT_Vector *a, const FT_Vector *b, const FT_Vector *to, void *pen)
{
	return add(pen, EW_CUBIC, (const FT_Vector *[]){ a, b, to });
}

/* Draws one glyph and moves the pen by its advance. */
static void draw(const Font *font, FT_UInt glyph, Pen *pen)
{
	static const FT_Outline_Funcs functions = { move_to, line_to, quad_to, cubic_to,
						    .shift = 1 };
	FT_Error error = FT_Load_Glyph(font->face, glyph, FT_LOAD_NO_SCALE);
	FT_GlyphSlot slot = font->face->glyph;
	if (!error && slot->format != FT_GLYPH_FORMAT_OUTLINE)
		fail("%s: glyph %u is no outline", font->file, glyph);
	if (!error)
		error = FT_Outline_Decompose(&slot->outline, &functions, pen);
	if (error)
		fail("%s: glyph %u is damaged: FreeType's error 0x%02x", font->file, glyph,
		     (unsigned)error);
	pen->x += pen->scale * (double)slot->metrics.horiAdvance;
}

/* ---- text ---- */

double font_text(Font *font, const char *text, double size, Drawing *drawing)
{
	const double unit = size / font->face->units_per_EM;
	Pen pen = { drawing, unit, 0, 0 };
	FT_UInt before = 0;
	double widest = 0;
	for (const char *p = text; *p;) {
		const size_t place = (size_t)(p - text);
		const long code = take_character(&p);
		if (code < 0)
			fail("the text is not UTF-8 at byte %zu", place + 1);
		if (code == '\n') {
			pen.x = 0;
			pen.y += unit * (double)font->face->height;
			before = 0;
			continue;
		}
		const FT_UInt glyph = FT_Get_Char_Index(font->face, (FT_ULong)code);
		FT_Vector kern = { 0, 0 };
		if (!glyph)
			fail("%s has no glyph for U+%04lX", font->file, code);
		if (before)
			FT_Get_Kerning(font->face, before, glyph, FT_KERNING_UNSCALED, &kern);
		pen.x += unit * (double)kern.x;
		draw(font, glyph, &pen);
		before = glyph;
		widest = pen.x > widest ? pen.x : widest;
	}
	return widest;
}

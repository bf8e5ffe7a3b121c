/* sheet.c - the contact sheet: the same drawings under four filters, side by side.
 *
 * One column per filter, one row per drawing. A tile is rendered at its own size, without looking
 * at its neighbours, and put on the sheet with each pixel a square of `zoom` pixels, so what one
 * sees of a glyph at 16 px are the values of the library and nothing else. The labels are one
 * drawing more.
 *
 * The zone plate's rings have edges at radii sqrt(k) u: the closer to the rim, the finer, down to
 * about one pixel per period, and what is finer than two cannot be shown. Circles around other
 * centres are aliases: what a filter has let through. */
#include "render.h"

#include <math.h>
#include <stdlib.h>

enum { COLUMNS = 4, SIDE = 192, GAP = 16, MARGIN = 24, CAPTION = 30, HEADING = 64 };

static const struct {
	const char *name, *title, *note;
} columns[COLUMNS] = {
	{ "box", "box", "1\u00d71 px, constant" },
	{ "tent", "tent", "2\u00d72 px, linear" },
	{ "bspline3", "bspline3", "4\u00d74 px, cubic" },
	{ "mitchell", "mitchell", "4\u00d74 px, cubic, with lobes" },
};

/* ---- what is drawn: each fills a tile of the given size ---- */

static void draw_zone_plate(Font *font, double width, double height, Drawing *drawing)
{
	const double x = width / 2, y = height / 2, unit = width / 2 * 1.12;
	(void)font;
	for (int k = 1; k * unit <= x * x + y * y; k++) {
		const double radius = sqrt(k * unit);
		drawing_ellipse(drawing, x, y, radius, k % 2 ? radius : -radius);
	}
}

static void draw_words(Font *font, double width, double height, Drawing *drawing)
{
	static const struct {
		double size, base;
		const char *text;
	} lines[] = { { 64, 56, "edge" }, { 32, 102, "edgewise" }, { 16, 130, "edge by edge, exact" } };
	(void)height;
	for (int i = 0; i < 3; i++) {
		Drawing text = { 0 };
		const double advance = font_text(font, lines[i].text, lines[i].size, &text);
		const double left = floor((width - advance) / 2);
		drawing_append(drawing, &text, (Placement){ 1, 1, left, lines[i].base });
		drawing_free(&text);
	}
}

/* An em as large as the tile is wide, the base line on a row of pixels. */
static void draw_glyph(Font *font, double width, double height, Drawing *drawing)
{
	Drawing text = { 0 };
	font_text(font, "&", width, &text);
	const Box box = drawing_box(&text);
	const double base = floor(height - (height + box.top) / 2 + 0.5);
	drawing_append(drawing, &text,
		       (Placement){ 1, 1, width / 2 - (box.left + box.right) / 2, base });
	drawing_free(&text);
}

typedef struct {
	const char *caption;
	int height, zoom;
	void (*draw)(Font *font, double width, double height, Drawing *drawing);
} Row;

static const Row rows[] = {
	{ "zone plate, each pixel 2\u00d72: rings down to 1 px apart; "
	  "circles around other centres are aliases", 96, 2, draw_zone_plate },
	{ "64, 32 and 16 px, as they are", 144, 1, draw_words },
	{ "64 px, each pixel 3\u00d73", 56, 3, draw_glyph },
	{ "32 px, each pixel 6\u00d76", 28, 6, draw_glyph },
	{ "16 px, each pixel 12\u00d712", 14, 12, draw_glyph },
};

enum { ROWS = (int)(sizeof rows / sizeof *rows) };

/* ---- the sheet ---- */

static int column_x(int column)
{
	return MARGIN + column * (SIDE + GAP);
}

static int row_y(int row)
{
	int y = HEADING + CAPTION;
	for (int i = 0; i < row; i++)
		y += rows[i].height * rows[i].zoom + CAPTION + GAP / 2;
	return y;
}

static void put_tile(Picture *sheet, Font *font, int row, int column)
{
	const ew_filter *filter = find_filter(columns[column].name);
	const int width = SIDE / rows[row].zoom, height = rows[row].height;
	if (!filter)
		fail("the sheet needs the filter %s", columns[column].name);
	Drawing drawing = { 0 };
	Picture tile = picture_new(width, height);
	rows[row].draw(font, width, height, &drawing);
	picture_fill(&tile, colour_of(0xffffff));
	paint(&tile, filter, &drawing, colour_of(0x000000));
	picture_put(sheet, &tile, column_x(column), row_y(row), rows[row].zoom);
	picture_free(&tile);
	drawing_free(&drawing);
}

static void label(Drawing *labels, Font *font, const char *text, double size, int x, int base)
{
	Drawing line = { 0 };
	font_text(font, text, size, &line);
	drawing_append(labels, &line, (Placement){ 1, 1, x, base });
	drawing_free(&line);
}

static void put_labels(Picture *sheet, Font *font)
{
	Drawing names = { 0 }, notes = { 0 };
	for (int i = 0; i < COLUMNS; i++) {
		label(&names, font, columns[i].title, 20, column_x(i), MARGIN + 16);
		label(&notes, font, columns[i].note, 12, column_x(i), MARGIN + 36);
	}
	for (int i = 0; i < ROWS; i++)
		label(&notes, font, rows[i].caption, 12, MARGIN, row_y(i) - 8);
	paint(sheet, find_filter("mitchell"), &names, colour_of(0x000000));
	paint(sheet, find_filter("mitchell"), &notes, colour_of(0x404040));
	drawing_free(&names);
	drawing_free(&notes);
}

Picture make_sheet(Font *font)
{
	Picture sheet = picture_new(column_x(COLUMNS) - GAP + MARGIN, row_y(ROWS) - CAPTION + GAP);
	picture_fill(&sheet, colour_of(0xf0f0f0));
	for (int row = 0; row < ROWS; row++)
		for (int column = 0; column < COLUMNS; column++)
			put_tile(&sheet, font, row, column);
	put_labels(&sheet, font);
	return sheet;
}

/* svg.h - plots as SVG: a page, panels with axes, lines, marks and the names of lines.
 *
 * What is drawn is one of a few kinds, the classes of a style sheet that follows the reader's
 * light or dark scheme: "ink" and "soft" for text, "grid", "limit" for a line to hold others
 * against, "c0" to "c5" for colours. Nothing here depends on anything but the arguments. */
#ifndef SVG_H
#define SVG_H

#include <stdio.h>

/* A file being written; it appears at once, when it is closed. */
typedef struct {
	FILE *out;
	const char *file;
	char *temporary;
} Svg;

typedef struct { double first, last; int logarithmic; } SvgAxis;

/* left, right, top, bottom: pixels of the page. */
typedef struct { double left, right, top, bottom; SvgAxis x, y; } SvgPanel;

/* The name of a line, and for a column the height y on the page. */
typedef struct { double y; const char *kind; char text[48]; } SvgLabel;

/* 0 if the file cannot be written: then nothing is left of it. The title is for those who do
 * not see the picture; svg_headline shows one. */
int svg_open(Svg *svg, const char *file, int width, int height, const char *title);
int svg_close(Svg *svg);

/* Text is escaped, and has the class `kind`. */
__attribute__((format(printf, 6, 7)))
void svg_text(Svg *svg, const char *kind, double x, double y, const char *anchor,
	const char *pattern, ...);
/* A title, and a line below it if that is not NULL. */
void svg_headline(Svg *svg, const char *title, const char *below);

double svg_x(const SvgPanel *panel, double value);
double svg_y(const SvgPanel *panel, double value);

/* The lines and marks of a panel are clipped to it, where this was called. */
void svg_panel(Svg *svg, const SvgPanel *panel);
/* A line across the panel, of the class `kind`, with a label at the axis. */
__attribute__((format(printf, 5, 6)))
void svg_tick_x(Svg *svg, const SvgPanel *panel, const char *kind, double at,
	const char *pattern, ...);
__attribute__((format(printf, 5, 6)))
void svg_tick_y(Svg *svg, const SvgPanel *panel, const char *kind, double at,
	const char *pattern, ...);
void svg_axis_titles(Svg *svg, const SvgPanel *panel, const char *x, const char *y);

/* What has no place on the axis, such as NAN, interrupts a line and has no mark. */
void svg_line(Svg *svg, const SvgPanel *panel, const char *kind, const double *x,
	const double *y, int count);
void svg_marks(Svg *svg, const SvgPanel *panel, const char *kind, int shape, const double *x,
	const double *y, int count);
/* In a column beside the panel, moved apart where they would touch. */
void svg_labels(Svg *svg, const SvgPanel *panel, SvgLabel *label, int count);
/* In a row below the headline. */
void svg_legend(Svg *svg, const SvgLabel *label, int count);

#endif

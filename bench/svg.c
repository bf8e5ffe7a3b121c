/* svg.c - plots as SVG; see svg.h. */
#define _POSIX_C_SOURCE 200809L
#include "svg.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MARGIN = 24, BELOW = 54, LINE_HEIGHT = 17, BESIDE = 10, LONGEST = 256 };

static const char style[] =
	"<style>\n"
	".page{fill:#ffffff}.ink{fill:#1f2328}.soft{fill:#59636e}\n"
	".grid{fill:none;stroke:#d8dee4}.limit{fill:none;stroke:#59636e;stroke-width:1.6}\n"
	".c0{color:#0b63c5}.c1{color:#b3261e}.c2{color:#1a7f37}.c3{color:#7b3fb5}"
	".c4{color:#8a6116}.c5{color:#59636e}\n"
	".line{fill:none;stroke:currentColor;stroke-width:2;stroke-linejoin:round}"
	".bold{stroke-width:2.8}.thin{stroke-width:1.4}.dash{stroke-dasharray:6 4}\n"
	".mark{fill:currentColor;stroke:#ffffff;stroke-width:1.2}"
	".name{fill:currentColor;font-weight:600;"
	"paint-order:stroke;stroke:#ffffff;stroke-width:4}\n"
	"text{font:13px system-ui,-apple-system,\"Segoe UI\",\"DejaVu Sans\",sans-serif}"
	".title{font-size:18px;font-weight:600}\n"
	"@media (prefers-color-scheme:dark){.page{fill:#0d1117}.ink{fill:#f0f6fc}"
	".soft{fill:#9198a1}\n.grid{stroke:#2a313a}.limit{stroke:#9198a1}"
	".mark,.name{stroke:#0d1117}\n"
	".c0{color:#58a6ff}.c1{color:#ff7b72}.c2{color:#3fb950}.c3{color:#bc8cff}"
	".c4{color:#d4a72c}.c5{color:#9198a1}}\n"
	"</style>\n";

/* ---- the file ---- */

static void escape(Svg *svg, const char *text)
{
	for (; *text; ++text)
		if (*text == '<' || *text == '&')
			fputs(*text == '<' ? "&lt;" : "&amp;", svg->out);
		else
			fputc(*text, svg->out);
}

int svg_open(Svg *svg, const char *file, int width, int height, const char *title)
{
	const size_t size = strlen(file) + 32;
	*svg = (Svg){ NULL, file, malloc(size) };
	if (!svg->temporary)
		return 0;
	snprintf(svg->temporary, size, "%s.%ld.tmp", file, (long)getpid());
	svg->out = fopen(svg->temporary, "w");
	if (!svg->out) {
		free(svg->temporary);
		return 0;
	}
	fprintf(svg->out, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" "
		"width=\"%d\" height=\"%d\" role=\"img\">\n<title>", width, height, width, height);
	escape(svg, title);
	fprintf(svg->out, "</title>\n%s<rect class=\"page\" width=\"%d\" height=\"%d\"/>\n", style,
		width, height);
	return 1;
}

int svg_close(Svg *svg)
{
	fprintf(svg->out, "</svg>\n");
	int good = !ferror(svg->out);
	good = fclose(svg->out) == 0 && good;
	good = good && rename(svg->temporary, svg->file) == 0;
	if (!good)
		remove(svg->temporary);
	free(svg->temporary);
	return good;
}

/* ---- text ---- */

__attribute__((format(printf, 6, 0)))
static void write_text(Svg *svg, const char *kind, double x, double y, const char *anchor,
	const char *pattern, va_list arguments)
{
	char text[LONGEST];
	vsnprintf(text, sizeof text, pattern, arguments);
	fprintf(svg->out, "<text class=\"%s\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", kind, x,
		y, anchor);
	escape(svg, text);
	fprintf(svg->out, "</text>\n");
}

void svg_text(Svg *svg, const char *kind, double x, double y, const char *anchor,
	const char *pattern, ...)
{
	va_list arguments;
	va_start(arguments, pattern);
	write_text(svg, kind, x, y, anchor, pattern, arguments);
	va_end(arguments);
}

void svg_headline(Svg *svg, const char *title, const char *below)
{
	svg_text(svg, "ink title", MARGIN, 32, "start", "%s", title);
	if (below)
		svg_text(svg, "soft", MARGIN, BELOW, "start", "%s", below);
}

void svg_legend(Svg *svg, const SvgLabel *label, int count)
{
	fprintf(svg->out, "<text x=\"%d\" y=\"%d\">", MARGIN, BELOW);
	for (int i = 0; i < count; ++i) {
		fprintf(svg->out, "<tspan class=\"%s\" dx=\"%d\">", label[i].kind, i ? MARGIN : 0);
		escape(svg, label[i].text);
		fprintf(svg->out, "</tspan>");
	}
	fprintf(svg->out, "</text>\n");
}

/* ---- panels ---- */

static double share(const SvgAxis *axis, double value)
{
	return axis->logarithmic ? log(value / axis->first) / log(axis->last / axis->first)
		: (value - axis->first) / (axis->last - axis->first);
}

double svg_x(const SvgPanel *panel, double value)
{
	return panel->left + (panel->right - panel->left) * share(&panel->x, value);
}

double svg_y(const SvgPanel *panel, double value)
{
	return panel->bottom - (panel->bottom - panel->top) * share(&panel->y, value);
}

/* Marks on an edge are shown whole. */
void svg_panel(Svg *svg, const SvgPanel *panel)
{
	fprintf(svg->out, "<clipPath id=\"p%.0f\"><path d=\"M%.0f %.0fH%.0fV%.0fH%.0fz\"/>"
		"</clipPath>\n", panel->left, panel->left - 6, panel->top - 6, panel->right + 6,
		panel->bottom + 6, panel->left - 6);
}

void svg_tick_x(Svg *svg, const SvgPanel *panel, const char *kind, double at,
	const char *pattern, ...)
{
	const double x = svg_x(panel, at);
	va_list arguments;
	fprintf(svg->out, "<path class=\"%s\" d=\"M%.1f %.1fV%.1f\"/>\n", kind, x, panel->top,
		panel->bottom);
	va_start(arguments, pattern);
	write_text(svg, "soft", x, panel->bottom + 19, "middle", pattern, arguments);
	va_end(arguments);
}

void svg_tick_y(Svg *svg, const SvgPanel *panel, const char *kind, double at,
	const char *pattern, ...)
{
	const double y = svg_y(panel, at);
	va_list arguments;
	fprintf(svg->out, "<path class=\"%s\" d=\"M%.1f %.1fH%.1f\"/>\n", kind, panel->left, y,
		panel->right);
	va_start(arguments, pattern);
	write_text(svg, "soft", panel->left - 8, y + 4.5, "end", pattern, arguments);
	va_end(arguments);
}

void svg_axis_titles(Svg *svg, const SvgPanel *panel, const char *x, const char *y)
{
	svg_text(svg, "ink", (panel->left + panel->right) / 2, panel->bottom + 42, "middle", "%s",
		x);
	svg_text(svg, "ink", panel->left, panel->top - 12, "start", "%s", y);
}

/* ---- what is in them ---- */

void svg_line(Svg *svg, const SvgPanel *panel, const char *kind, const double *x,
	const double *y, int count)
{
	int down = 0;
	fprintf(svg->out, "<path class=\"line %s\" clip-path=\"url(#p%.0f)\" d=\"", kind,
		panel->left);
	for (int i = 0; i < count; ++i) {
		const double height = svg_y(panel, y[i]);
		if (isfinite(height))
			fprintf(svg->out, "%s%.1f %.1f", down ? "L" : "M", svg_x(panel, x[i]),
				height);
		down = isfinite(height);
	}
	fprintf(svg->out, "\"/>\n");
}

void svg_marks(Svg *svg, const SvgPanel *panel, const char *kind, int shape, const double *x,
	const double *y, int count)
{
	static const char *const shapes[] = {
		"m-5.5 0a5.5 5.5 0 1 0 11 0a5.5 5.5 0 1 0 -11 0", "m-5 -5h10v10h-10z",
		"m0 -6.5l6.5 11h-13z", "m0 -7l7 7l-7 7l-7 -7z", "m0 6.5l6.5 -11h-13z",
	};
	enum { SHAPES = (int)(sizeof shapes / sizeof *shapes) };
	fprintf(svg->out, "<path class=\"mark %s\" clip-path=\"url(#p%.0f)\" d=\"", kind,
		panel->left);
	for (int i = 0; i < count; ++i)
		if (isfinite(svg_y(panel, y[i])))
			fprintf(svg->out, "M%.1f %.1f%s", svg_x(panel, x[i]), svg_y(panel, y[i]),
				shapes[shape % SHAPES]);
	fprintf(svg->out, "\"/>\n");
}

static int by_height(const void *a, const void *b)
{
	const double first = ((const SvgLabel *)a)->y, second = ((const SvgLabel *)b)->y;
	return (first > second) - (first < second);
}

/* Neighbours that touch give way, each by half of what is missing, again and again. */
void svg_labels(Svg *svg, const SvgPanel *panel, SvgLabel *label, int count)
{
	enum { ROUNDS = 200 };
	qsort(label, (size_t)count, sizeof *label, by_height);
	for (int round = 0; round < ROUNDS; ++round)
		for (int i = 0; i < count; ++i) {
			label[i].y = fmin(fmax(label[i].y, panel->top), panel->bottom);
			if (i + 1 == count || label[i + 1].y - label[i].y >= LINE_HEIGHT)
				continue;
			const double middle = (label[i].y + label[i + 1].y) / 2;
			label[i].y = middle - LINE_HEIGHT / 2.;
			label[i + 1].y = middle + LINE_HEIGHT / 2.;
		}
	for (int i = 0; i < count; ++i)
		svg_text(svg, label[i].kind, panel->right + BESIDE, label[i].y + 4.5, "start", "%s",
			label[i].text);
}

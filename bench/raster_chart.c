/* raster_chart.c - a plot of how fast glyphs are drawn, against FreeType, over their size.
 *
 * FreeType's time divided by ours, or by that of another library, as measured in the same rounds:
 * above the line of 1 is faster. Both axes are logarithmic. Ours, on the widest target, have marks
 * and colours; other libraries are thin lines. */
#include "raster.h"
#include "svg.h"

#include <stdio.h>

enum { WIDE = 800, HIGH = 500, FIRST = 16, SIZES = 8, TITLE = 120 };   /* 16 to 2048, doubling */

static const SvgPanel panel = { 64, 656, 104, 436, { 14, 2400, 1 }, { 0.1, 5, 1 } };

static const struct { const char *text, *line, *mark, *name; } looks[CHART_SERIES] = {
	[CHART_U8] = { "box to bytes", "c0 bold", "c0", "c0 name" },
	[CHART_F32] = { "box to float", "c3", "c3", "c3 name" },
	[CHART_TENT] = { "tent to float", "c2", "c2", "c2 name" },
	[CHART_MITCHELL] = { "Mitchell to float", "c1", "c1", "c1 name" },
	[CHART_CAIRO] = { "cairo", "c5 thin", NULL, "soft" },
	[CHART_AGG] = { "AGG", "c5 thin", NULL, "soft" },
	[CHART_STB] = { "stb_truetype", "c5 thin", NULL, "soft" },
};

static double ratio[CHART_SERIES][SIZES];      /* 0: not measured */

void raster_chart_point(ChartSeries series, int size, double value)
{
	int place = 0;
	while (FIRST << place < size)
		++place;
	if (series < CHART_SERIES && place < SIZES && value > 0)
		ratio[series][place] = value;
}

static void write_axes(Svg *svg)
{
	static const double ticks[] = { 0.1, 0.2, 0.5, 1, 2, 3, 4, 5 };
	for (int place = 0; place < SIZES; ++place)
		svg_tick_x(svg, &panel, "grid", FIRST << place, "%d", FIRST << place);
	for (size_t i = 0; i < sizeof ticks / sizeof *ticks; ++i)
		svg_tick_y(svg, &panel, ticks[i] == 1 ? "limit" : "grid", ticks[i], "%g",
			ticks[i]);
	svg_axis_titles(svg, &panel, "pixels per em", "times FreeType's speed");
}

/* Draws what was measured of a series. 1 if its name is to stand beside the panel: it does not if
 * the line ends before. */
static int write_series(Svg *svg, int series, SvgLabel *label)
{
	double size[SIZES], value[SIZES];
	int count = 0;
	for (int place = 0; place < SIZES; ++place)
		if (ratio[series][place] > 0) {
			size[count] = FIRST << place;
			value[count++] = ratio[series][place];
		}
	if (count == 0)
		return 0;
	svg_line(svg, &panel, looks[series].line, size, value, count);
	if (looks[series].mark)
		svg_marks(svg, &panel, looks[series].mark, series, size, value, count);
	label->y = svg_y(&panel, value[count - 1]);
	label->kind = looks[series].name;
	snprintf(label->text, sizeof label->text, "%s", looks[series].text);
	if (size[count - 1] >= FIRST << (SIZES - 1))
		return 1;
	svg_text(svg, label->kind, svg_x(&panel, size[count - 1]) + 10, label->y + 4.5, "start",
		"%s", label->text);
	return 0;
}

/* 0 if there is nothing to be said. */
static int make_title(char title[TITLE])
{
	double least = INFINITY, most = 0;
	for (int place = 0; place < SIZES; ++place) {
		least = fmin(least, ratio[CHART_U8][place]);
		most = fmax(most, ratio[CHART_U8][place]);
	}
	snprintf(title, TITLE, "Exact coverage of glyphs, %.1f to %.1f times as fast as FreeType",
		least, most);
	return least > 0;
}

int raster_chart_write(const char *file)
{
	SvgLabel label[CHART_SERIES + 1] = { { svg_y(&panel, 1), "soft", "FreeType" } };
	int labels = 1;
	char title[TITLE];
	Svg svg;
	if (!make_title(title)) {
		fprintf(stderr, "bench: no ratios to FreeType: it, or DejaVuSans, was not there "
			"(make deps-bench)\n");
		return 0;
	}
	if (!svg_open(&svg, file, WIDE, HIGH, title))
		return 0;
	svg_headline(&svg, title, "The glyphs of DejaVuSans in turn as polygons, clearing "
		"included; other libraries draw a box to bytes");
	svg_panel(&svg, &panel);
	write_axes(&svg);
	for (int series = CHART_SERIES - 1; series >= 0; --series)
		labels += write_series(&svg, series, &label[labels]);
	svg_labels(&svg, &panel, label, labels);
	return svg_close(&svg);
}

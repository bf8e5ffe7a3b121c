/* raster_chart.c - a plot of how fast glyphs are drawn, against FreeType, over their size.
 *
 * FreeType's time divided by ours, or by that of another library, as measured in the same rounds:
 * above the line of 1 is faster. Both axes are logarithmic. Ours have marks, on the widest target;
 * other libraries are plain lines with a name at their end. */
#include "raster.h"

#include <stdio.h>

enum { WIDE = 760, HIGH = 480, LEFT = 70, RIGHT = 690, TOP = 52, BOTTOM = 420 };
enum { FIRST = 16, SIZES = 8 };        /* 16 to 2048, doubling */

static const double LEAST = 0.1, MOST = 6;

static const char TITLE[] = "Drawing the glyphs of DejaVuSans: times FreeType's speed";

static const char *const names[CHART_SERIES] = {
	[CHART_U8] = "box, u8", [CHART_F32] = "box, f32", [CHART_TENT] = "tent, f32",
	[CHART_MITCHELL] = "Mitchell, f32", [CHART_CAIRO] = "cairo", [CHART_AGG] = "AGG",
	[CHART_STB] = "stb",
};

/* The marks of a page, and its classes t0 .. t3, backwards. */
#define MARK(series) (CHART_MITCHELL - (series))
static const char *const classes[] = { "t3", "t2", "t1", "t0" };

static double ratio[CHART_SERIES][SIZES];      /* 0: not measured */

void raster_chart_point(ChartSeries series, int size, double value)
{
	int place = 0;
	while (FIRST << place < size)
		++place;
	if (series < CHART_SERIES && place < SIZES && value > 0)
		ratio[series][place] = value;
}

static double place_x(int size)
{
	return LEFT + (RIGHT - LEFT) * (double)size / (SIZES - 1);
}

static double place_y(double value)
{
	const double shown = fmin(fmax(value, LEAST), MOST);
	return BOTTOM - (BOTTOM - TOP) * log(shown / LEAST) / log(MOST / LEAST);
}

static void write_axes(FILE *out)
{
	static const double ticks[] = { 0.1, 0.2, 0.5, 1, 2, 5 };
	for (size_t i = 0; i < sizeof ticks / sizeof *ticks; ++i) {
		const double y = place_y(ticks[i]);
		fprintf(out, "<path class=\"%s\" d=\"M%d %.1fH%d\"/>\n",
			ticks[i] == 1 ? "limit" : "grid", LEFT, y, RIGHT);
		svg_text(out, "soft", LEFT - 8, y + 4, "end", "%g", ticks[i]);
	}
	for (int size = 0; size < SIZES; ++size) {
		fprintf(out, "<path class=\"grid\" d=\"M%.1f %dV%d\"/>\n", place_x(size), TOP, BOTTOM);
		svg_text(out, "soft", place_x(size), BOTTOM + 18, "middle", "%d", FIRST << size);
	}
	svg_text(out, "ink", (LEFT + RIGHT) / 2., HIGH - 16, "middle",
		"pixels per em (log scale)");
}

static void write_series(FILE *out, int series)
{
	const double *value = ratio[series];
	const int ours = series < CHART_CAIRO;
	int last = -1;
	fprintf(out, "<path class=\"%s\" style=\"fill:none;stroke-width:1.5\" d=\"",
		ours ? classes[series] : "limit");
	for (int size = 0; size < SIZES; ++size)
		if (value[size] > 0) {
			fprintf(out, "%s%.1f %.1f", last < 0 ? "M" : "L", place_x(size),
				place_y(value[size]));
			last = size;
		}
	fprintf(out, "\"/>\n");
	for (int size = 0; size < SIZES && ours; ++size)
		if (value[size] > 0)
			svg_mark(out, MARK(series), place_x(size), place_y(value[size]));
	if (!ours && last >= 0)
		svg_text(out, "soft", place_x(last) + 6, place_y(value[last]) + 4, "start", "%s",
			names[series]);
}

static void write_legend(FILE *out)
{
	const int x = RIGHT - 130;
	int y = TOP + 18;
	for (int series = 0; series < CHART_CAIRO; ++series, y += 20) {
		svg_mark(out, MARK(series), x, y);
		svg_text(out, "ink", x + 16, y + 4, "start", "%s", names[series]);
	}
	fprintf(out, "<path class=\"limit\" d=\"M%d %dh20\"/>\n", x - 10, y);
	svg_text(out, "ink", x + 16, y + 4, "start", "FreeType, box, u8");
}

int raster_chart_write(const char *file)
{
	FILE *out = fopen(file, "w");
	if (!out)
		return 0;
	svg_page(out, WIDE, HIGH, TITLE);
	svg_text(out, "ink title", LEFT, 28, "start", "%s", TITLE);
	write_axes(out);
	for (int series = 0; series < CHART_SERIES; ++series)
		write_series(out, series);
	write_legend(out);
	fprintf(out, "</svg>\n");
	int good = !ferror(out);
	return fclose(out) == 0 && good;
}

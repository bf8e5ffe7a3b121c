/* chart.c - a plot of slots per edge against the operation count, as SVG, and what plots share.
 *
 * Both axes are logarithmic. A kernel with f operations on the FMA pipe cannot take fewer than f
 * slots: that is the diagonal, and the distance of a mark above it is what the target loses.
 * One mark per degree N = 0..8 of all moments, double. The layout depends on nothing but the
 * figures; colours follow the reader's light or dark scheme, and marks differ in shape as well. */
#include "bench.h"

#include <stdarg.h>
#include <stdio.h>

enum { WIDE = 760, HIGH = 520, LEFT = 70, RIGHT = 740, TOP = 64, BOTTOM = 452, DEGREES = 9 };

static const double X_FIRST = 0.8, X_LAST = 200, Y_FIRST = 0.8, Y_LAST = 300;

static const char STYLE[] =
	"<style>\n"
	".page{fill:#ffffff}.ink{fill:#1f2328}.soft{fill:#59636e}\n"
	".grid{stroke:#d1d9e0;stroke-width:1}.limit{stroke:#59636e;stroke-width:2;fill:none}\n"
	".t0{fill:#8c6d1f;stroke:#8c6d1f}.t1{fill:#1a7f37;stroke:#1a7f37}"
	".t2{fill:#0b63c5;stroke:#0b63c5}.t3{fill:#b3261e;stroke:#b3261e}"
	".t4{fill:#7b3fb5;stroke:#7b3fb5}\n"
	"text{font:13px system-ui,sans-serif}.title{font-size:17px;font-weight:600}\n"
	"@media (prefers-color-scheme:dark){.page{fill:#0d1117}.ink{fill:#f0f6fc}"
	".soft{fill:#9198a1}.grid{stroke:#3d444d}.limit{stroke:#9198a1}\n"
	".t0{fill:#d4a72c;stroke:#d4a72c}.t1{fill:#3fb950;stroke:#3fb950}"
	".t2{fill:#58a6ff;stroke:#58a6ff}.t3{fill:#ff7b72;stroke:#ff7b72}"
	".t4{fill:#bc8cff;stroke:#bc8cff}}\n"
	"</style>\n";

/* ---- shared ---- */

void svg_page(FILE *out, int wide, int high, const char *title)
{
	fprintf(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" "
		"height=\"%d\" role=\"img\">\n<title>%s</title>\n%s"
		"<rect class=\"page\" width=\"%d\" height=\"%d\"/>\n", wide, high, wide, high,
		title, STYLE, wide, high);
}

void svg_text(FILE *out, const char *kind, double x, double y, const char *anchor,
	const char *format, ...)
{
	va_list arguments;
	fprintf(out, "<text class=\"%s\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", kind, x, y,
		anchor);
	va_start(arguments, format);
	vfprintf(out, format, arguments);
	va_end(arguments);
	fprintf(out, "</text>\n");
}

void svg_mark(FILE *out, int kind, double x, double y)
{
	static const char *const shapes[] = {
		"M%.1f %.1fm-5 -5h10v10h-10z", "M%.1f %.1fm0 -6l6 10h-12z",
		"M%.1f %.1fm0 -6l6 6l-6 6l-6 -6z", "M%.1f %.1fm-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0",
		"M%.1f %.1fm0 6l6 -10h-12z",
	};
	static const int kinds = (int)(sizeof shapes / sizeof *shapes);
	fprintf(out, "<path class=\"t%d\" d=\"", kind % kinds);
	fprintf(out, shapes[kind % kinds], x, y);
	fprintf(out, "\"/>\n");
}

/* ---- slots ---- */

static const char TITLE[] =
	"All moments to degree N, double: slots per edge against the limit";

static double place_x(double operations)
{
	return LEFT + (RIGHT - LEFT) * log(operations / X_FIRST) / log(X_LAST / X_FIRST);
}

static double place_y(double slots)
{
	return BOTTOM - (BOTTOM - TOP) * log(slots / Y_FIRST) / log(Y_LAST / Y_FIRST);
}

static void write_axes(FILE *out)
{
	static const int ticks[] = { 1, 2, 5, 10, 20, 50, 100, 200 };
	for (size_t i = 0; i < sizeof ticks / sizeof *ticks; ++i) {
		double y = place_y(ticks[i]);
		fprintf(out, "<path class=\"grid\" d=\"M%d %.1fH%d\"/>\n", LEFT, y, RIGHT);
		svg_text(out, "soft", LEFT - 8, y + 4, "end", "%d", ticks[i]);
	}
	svg_text(out, "ink", (LEFT + RIGHT) / 2, HIGH - 16, "middle",
		"operations on the FMA pipe per edge (log scale)");
	fprintf(out, "<g transform=\"translate(20 %d) rotate(-90)\">", (TOP + BOTTOM) / 2);
	svg_text(out, "ink", 0, 0, "middle", "slots per edge (log scale)");
	fprintf(out, "</g>\n");
}

/* Degrees stand where their operation counts are. */
static void write_degrees(FILE *out, const Target *target)
{
	for (int n = 0; n < DEGREES; ++n) {
		int f = target->kernels[DOUBLE][EW_RING_MOMENTS_0 + n].f;
		double x = place_x(f);
		fprintf(out, "<path class=\"grid\" d=\"M%.1f %dV%d\"/>\n", x, TOP, BOTTOM);
		svg_text(out, "soft", x, BOTTOM + 18, "middle", "%d", f);
		svg_text(out, "ink", x, TOP - 8, "middle", "%d", n);
	}
	svg_text(out, "ink", LEFT - 8, TOP - 8, "end", "N");
	fprintf(out, "<path class=\"limit\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", place_x(1),
		place_y(1), place_x(X_LAST), place_y(X_LAST));
}

static void write_target(FILE *out, const Target *target, int t)
{
	fprintf(out, "<path class=\"t%d\" style=\"fill:none;stroke-width:1.5\" d=\"", t);
	for (int n = 0; n < DEGREES; ++n)
		fprintf(out, "%s%.1f %.1f", n ? "L" : "M",
			place_x(target->kernels[DOUBLE][EW_RING_MOMENTS_0 + n].f),
			place_y(kernel_slots(t, EW_RING_MOMENTS_0 + n)));
	fprintf(out, "\"/>\n");
	for (int n = 0; n < DEGREES; ++n)
		svg_mark(out, t, place_x(target->kernels[DOUBLE][EW_RING_MOMENTS_0 + n].f),
			place_y(kernel_slots(t, EW_RING_MOMENTS_0 + n)));
}

static void write_legend(FILE *out, const Target *const *target, int targets)
{
	const int x = LEFT + 24;
	int y = TOP + 24;
	for (int t = 0; t < targets; ++t, y += 22) {
		svg_mark(out, t, x, y);
		svg_text(out, "ink", x + 16, y + 4, "start", "%s, %d lane%s", target[t]->name,
			target[t]->lanes[DOUBLE], target[t]->lanes[DOUBLE] == 1 ? "" : "s");
	}
	fprintf(out, "<path class=\"limit\" d=\"M%d %dh20\"/>\n", x - 10, y);
	svg_text(out, "ink", x + 16, y + 4, "start", "limit: slots = operations");
}

int chart_write(const char *file)
{
	const Target *target[MAX_TARGETS];
	int targets = targets_here(target);
	FILE *out = fopen(file, "w");
	if (!out)
		return 0;
	svg_page(out, WIDE, HIGH, TITLE);
	svg_text(out, "ink title", LEFT, 28, "start", "%s", TITLE);
	write_axes(out);
	write_degrees(out, target[targets - 1]);
	for (int t = 0; t < targets; ++t)
		write_target(out, target[t], t);
	write_legend(out, target, targets);
	svg_text(out, "soft", RIGHT, BOTTOM - 34, "end", "slot: one multiply-add on a vector of "
		"the target's width, at the rate measured beside it");
	fprintf(out, "</svg>\n");
	int good = !ferror(out);
	return fclose(out) == 0 && good;
}

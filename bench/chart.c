/* chart.c - a plot of slots per edge against the limit, over the degree of the moments.
 *
 * A kernel with f operations on the FMA pipe cannot take fewer than f slots: that is the line at 1,
 * and the distance of a mark above it is what the target loses. One mark per degree N = 0..8 of all
 * moments, double. The layout depends on nothing but the figures. */
#include "bench.h"
#include "svg.h"

#include <stdio.h>

enum { WIDE = 800, HIGH = 480, DEGREES = 9, KINDS = 5, TITLE = 128 };

static const SvgPanel panel = { 64, 646, 104, 404, { -0.25, 8.25, 0 }, { 0.9, 6, 1 } };

/* From the widest target down. */
static const struct { const char *line, *mark, *name; } looks[KINDS] = {
	{ "c0 bold", "c0", "c0 name" }, { "c1", "c1", "c1 name" }, { "c2", "c2", "c2 name" },
	{ "c4", "c4", "c4 name" }, { "c3", "c3", "c3 name" },
};

typedef struct { double degree[DEGREES], excess[DEGREES]; } Series;    /* slots per operation */

static Series series_of(const Target *target, int t)
{
	Series series;
	for (int n = 0; n < DEGREES; ++n) {
		const int id = EW_RING_MOMENTS_0 + n;
		series.degree[n] = n;
		series.excess[n] = kernel_slots(t, id) / target->kernels[DOUBLE][id].f;
	}
	return series;
}

static void write_axes(Svg *svg, const Target *target)
{
	static const double ticks[] = { 1, 1.5, 2, 3, 4, 5, 6 };
	for (size_t i = 0; i < sizeof ticks / sizeof *ticks; ++i)
		svg_tick_y(svg, &panel, ticks[i] == 1 ? "limit" : "grid", ticks[i], "%g",
			ticks[i]);
	for (int n = 0; n < DEGREES; ++n) {
		svg_tick_x(svg, &panel, "grid", n, "%d", n);
		svg_text(svg, "soft", svg_x(&panel, n), panel.bottom + 38, "middle", "%d",
			target->kernels[DOUBLE][EW_RING_MOMENTS_0 + n].f);
	}
	svg_text(svg, "ink", panel.right + 10, panel.bottom + 19, "start", "degree N");
	svg_text(svg, "ink", panel.right + 10, panel.bottom + 38, "start", "limit in slots");
	svg_text(svg, "ink", panel.left, panel.top - 14, "start",
		"slots per edge, times the limit");
	svg_text(svg, "soft", panel.left, panel.bottom + 64, "start", "slot: one multiply-add "
		"on a vector of the target's width, at the rate measured beside the kernel");
}

/* What the widest target reaches from degree 2 on. */
static void make_title(char title[TITLE], const Series *series)
{
	double least = 1, most = 0;
	for (int n = 2; n < DEGREES; ++n) {
		least = fmin(least, 1 / series->excess[n]);
		most = fmax(most, 1 / series->excess[n]);
	}
	snprintf(title, TITLE, "From degree 2 on, moments run at %.0f to %.0f %% of the machine's "
		"peak", 100 * least, 100 * most);
}

int chart_write(const char *file)
{
	const Target *target[MAX_TARGETS];
	const int targets = targets_here(target), widest = targets - 1;
	SvgLabel label[MAX_TARGETS];
	const Series best = series_of(target[widest], widest);
	char title[TITLE], below[TITLE];
	Svg svg;
	make_title(title, &best);
	snprintf(below, sizeof below, "%s, the widest target, against its rate of multiply-adds; "
		"all moments to degree N, double, in cache", target[widest]->name);
	if (!svg_open(&svg, file, WIDE, HIGH, title))
		return 0;
	svg_headline(&svg, title, below);
	svg_panel(&svg, &panel);
	write_axes(&svg, target[widest]);
	for (int t = 0; t < targets; ++t) {
		const Series series = series_of(target[t], t);
		const int look = (widest - t) % KINDS;
		svg_line(&svg, &panel, looks[look].line, series.degree, series.excess, DEGREES);
		svg_marks(&svg, &panel, looks[look].mark, look, series.degree, series.excess,
			DEGREES);
		label[t].y = svg_y(&panel, series.excess[DEGREES - 1]);
		label[t].kind = looks[look].name;
		snprintf(label[t].text, sizeof label[t].text, "%s, %d lane%s", target[t]->name,
			target[t]->lanes[DOUBLE], target[t]->lanes[DOUBLE] == 1 ? "" : "s");
	}
	svg_labels(&svg, &panel, label, targets);
	return svg_close(&svg);
}

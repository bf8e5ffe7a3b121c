/* raster_filters.c - exact tent and cubic filters, against FreeType's box and supersampling.
 *
 * Filters reach two pixels beyond a glyph, so all images have a margin of as much, FreeType's too.
 * Supersampling is our own box at eight times the size, f32, and a filter pass over it with the
 * filter's values at the centres of the small pixels; what can be prepared of it, is. */
#include "raster.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MARGIN = 2, COARSE = 8, AGAIN = 8 };

#define TOLERANCE (1 / 16.)
#define NO ((double)NAN)

/* Ratios: FreeType's box to the filter, 8 x 8 supersampling to the filter. Other bars: the filter
 * to our box (at most), the error in 1e-6 (at most). */
typedef struct { int size; double tent, cubic, samples; } Bars;

static const Bars sizes[] = {
	{ 16, 1.0, 0.45, 8 }, { 32, 1.3, 0.45, 12 }, { 64, 1.3, 0.45, 20 },
	{ 128, 1.2, 0.45, NO }, { 256, NO, 0.45, NO },
};
enum { SIZES = (int)(sizeof sizes / sizeof *sizes) };

static const double CUBIC_TO_BOX = 6, ERROR = 2;

static const struct {
	Filter exact;
	const ew_filter *filter;
	int taps;                      /* of supersampling; 0: not compared */
	int cubic;
	ChartSeries chart;             /* CHART_SERIES: none */
} filters[] = {
	{ EXACT_TENT, &ew_filter_tent, 16, 0, CHART_TENT },
	{ EXACT_BSPLINE3, &ew_filter_bspline3, 0, 1, CHART_SERIES },
	{ EXACT_MITCHELL, &ew_filter_mitchell, 32, 1, CHART_MITCHELL },
};
enum { FILTERS = (int)(sizeof filters / sizeof *filters) };

/* ---- supersampling ---- */

typedef struct {
	Set fine;                      /* eight times the size, the same polygons */
	DrawJob box;
	Polyphase phase;
	const Set *set;
	float *scratch, *out;
} Supersample;

static Polyphase polyphase_of(Filter filter, int taps)
{
	Polyphase phase = { taps, { 0 } };
	double sum = 0;
	for (int k = 0; k < taps; ++k)
		sum += filter_value(filter, (k + 0.5 - taps / 2) / FOLD);
	for (int k = 0; k < taps; ++k)
		phase.weight[k] = (float)(filter_value(filter, (k + 0.5 - taps / 2) / FOLD) / sum);
	return phase;
}

static void supersample_begin(Supersample *s, const Set *set, unsigned target, int f, float *out)
{
	int widest = 0;
	*s = (Supersample){ .fine = *set, .set = set, .out = out,
		.phase = polyphase_of(filters[f].exact, filters[f].taps) };
	s->fine.drawing = allocate((size_t)set->count * sizeof *s->fine.drawing);
	for (int i = 0; i < set->count; ++i) {
		s->fine.drawing[i] = drawing_scaled(&set->drawing[i], FOLD);
		widest = set->drawing[i].scene.width > widest ? set->drawing[i].scene.width : widest;
	}
	s->box = (DrawJob){ TO_FLOATS, FLOAT, target, &ew_filter_box, &s->fine,
		pixels_new(&s->fine), 1 };
	const size_t room = 2 * (size_t)(FOLD * widest + MOST_TAPS) * sizeof(float);
	s->scratch = allocate(room);
	memset(s->scratch, 0, room);
}

static void supersample_end(Supersample *s)
{
	pixels_free(&s->box.pixels);
	set_free(&s->fine);
	free(s->scratch);
}

static void supersample_one(const Supersample *s, int i)
{
	const Scene *scene = &s->set->drawing[i].scene;
	draw_one(&s->box, &s->fine.drawing[i]);
	downsample(&s->phase, s->box.pixels.floats, s->fine.drawing[i].scene.stride, scene->width,
		scene->height, s->scratch, s->out, scene->stride);
}

static void supersample_run(const void *context, long repeat)
{
	const Supersample *s = context;
	while (repeat-- > 0)
		for (int i = 0; i < s->set->count; ++i)
			supersample_one(s, i);
}

/* ---- one size ---- */

typedef struct {
	const Target *target[MAX_TARGETS];
	int targets;
	Set set;
	Pixels pixels;
	PaintJob paint;
	DrawJob box, draw[FILTERS][MAX_TARGETS];
	Supersample fine[FILTERS];
} Contest;

typedef struct {
	double freetype, box, freetype_least;
	double median[FILTERS][MAX_TARGETS];
	double least[FILTERS];         /* of the widest target, and so on */
	double freetype_ratio[FILTERS], box_ratio[FILTERS], again[FILTERS];
	double samples[FILTERS], samples_ratio[FILTERS];
	double error[FILTERS], samples_error[FILTERS];
} Outcome;

static int begin_contest(Contest *c, int size)
{
	c->targets = targets_here(c->target);
	c->set = glyphs_make(size, MARGIN, TOLERANCE, 1);
	if (c->set.count == 0) {
		set_free(&c->set);
		return 0;
	}
	c->pixels = pixels_new(&c->set);
	const unsigned widest = c->target[c->targets - 1]->bit;
	c->box = (DrawJob){ TO_FLOATS, FLOAT, widest, &ew_filter_box, &c->set, c->pixels, 1 };
	paint_begin(&c->paint, &painter_FreeType, &c->set, c->pixels);
	for (int f = 0; f < FILTERS; ++f) {
		for (int t = 0; t < c->targets; ++t) {
			c->draw[f][t] = c->box;
			c->draw[f][t].target = c->target[t]->bit;
			c->draw[f][t].filter = filters[f].filter;
		}
		if (filters[f].taps)
			supersample_begin(&c->fine[f], &c->set, widest, f, c->pixels.floats);
	}
	return 1;
}

static void end_contest(Contest *c)
{
	paint_end(&c->paint);
	for (int f = 0; f < FILTERS; ++f)
		if (filters[f].taps)
			supersample_end(&c->fine[f]);
	pixels_free(&c->pixels);
	set_free(&c->set);
}

/* Of every eighth character. */
static void find_errors(const Contest *c, int f, Outcome *outcome)
{
	for (int i = 0; i < c->set.count; i += COARSE) {
		const Drawing *drawing = &c->set.drawing[i];
		double *exact = exact_image(&drawing->scene, filters[f].exact);
		for (int t = 0; t < c->targets; ++t) {
			pixels_spoil(c->pixels, &drawing->scene);
			draw_one(&c->draw[f][t], drawing);
			outcome->error[f] = fmax(outcome->error[f],
				worst_float(&drawing->scene, c->pixels.floats, exact));
		}
		if (filters[f].taps) {
			pixels_spoil(c->pixels, &drawing->scene);
			supersample_one(&c->fine[f], i);
			outcome->samples_error[f] = fmax(outcome->samples_error[f],
				worst_float(&drawing->scene, c->pixels.floats, exact));
		}
		free(exact);
	}
}

static void run_contest(const Contest *c, Outcome *outcome, int rounds)
{
	Race race = race_new(rounds);
	const int widest = c->targets - 1, count = c->set.count;
	int samples[FILTERS], first[FILTERS];
	const int freetype = race_add(&race, paint_run, &c->paint, count);
	const int box = race_add(&race, draw_run, &c->box, count);
	for (int f = 0; f < FILTERS; ++f) {
		first[f] = race.count;
		for (int t = 0; t < c->targets; ++t)
			race_add(&race, draw_run, &c->draw[f][t], count);
		if (filters[f].taps)
			samples[f] = race_add(&race, supersample_run, &c->fine[f], count);
	}
	race_run(&race);
	outcome->freetype = race_median(&race, freetype);
	outcome->freetype_least = race_minimum(&race, freetype);
	outcome->box = race_median(&race, box);
	for (int f = 0; f < FILTERS; ++f) {
		const int ours = first[f] + widest, sampled = filters[f].taps != 0;
		for (int t = 0; t < c->targets; ++t)
			outcome->median[f][t] = race_median(&race, first[f] + t);
		outcome->least[f] = race_minimum(&race, ours);
		outcome->freetype_ratio[f] = race_ratio(&race, freetype, ours);
		outcome->box_ratio[f] = race_ratio(&race, ours, box);
		outcome->samples[f] = sampled ? race_median(&race, samples[f]) : NO;
		outcome->samples_ratio[f] = sampled ? race_ratio(&race, samples[f], ours) : NO;
		if (!sampled)
			outcome->samples_error[f] = NO;
	}
	race_free(&race);
}

static void run_again(const Contest *c, Outcome *outcome, int rounds)
{
	PaintJob paint = c->paint;
	DrawJob draw[FILTERS];
	Race race = race_new(rounds);
	paint.times = AGAIN;
	race_add(&race, paint_run, &paint, c->set.count * AGAIN);
	for (int f = 0; f < FILTERS; ++f) {
		draw[f] = c->draw[f][c->targets - 1];
		draw[f].times = AGAIN;
		race_add(&race, draw_run, &draw[f], c->set.count * AGAIN);
	}
	race_run(&race);
	for (int f = 0; f < FILTERS; ++f)
		outcome->again[f] = race_ratio(&race, 0, 1 + f);
	race_free(&race);
}

/* ---- table ---- */

static Table *new_table(const Contest *c)
{
	Table *table = table_new("raster-filters", "exact filters on glyphs, f32: us per glyph",
		"Float vertices, a margin of 2 pixels; median, and minimum of the widest target, "
		"which the ratios are for.\nGlyphs in turn; again: each eight times in a row. 8 x 8: "
		"supersampling by our own box. Errors in 1e-6:\nthe worst of all targets, and that "
		"of 8 x 8.");
	table_figures(table, "box", "FreeType", 2);
	table_figures(table, "box", "ours", 2);
	for (int t = 0; t < c->targets; ++t)
		table_figures(table, "filter", c->target[t]->name, 2);
	table_figures(table, "filter", "min", 2);
	table_figures(table, "8 x 8", "us", 2);
	table_figures(table, "FreeType / ours", "again", 2);
	table_figures(table, "FreeType / ours", "minima", 2);
	table_figures(table, "FreeType / ours", "ratio", 2);
	table_at_least(table);
	table_figures(table, "ours / box", "ratio", 2);
	table_at_most(table);
	table_figures(table, "8 x 8 / ours", "ratio", 1);
	table_at_least(table);
	table_figures(table, "error", "8 x 8", 0);
	table_figures(table, "error", "ours", 2);
	table_at_most(table);
	return table;
}

static void put_rows(Table *table, const Contest *c, const Bars *bars, const Outcome *o)
{
	const int held = c->target[c->targets - 1]->bit == EW_AVX512;
	for (int f = 0; f < FILTERS; ++f) {
		const int cubic = filters[f].cubic;
		table_row(table, "%s, %d px", filter_names[filters[f].exact], c->set.size);
		table_put(table, 1e-3 * o->freetype);
		table_put(table, 1e-3 * o->box);
		for (int t = 0; t < c->targets; ++t)
			table_put(table, 1e-3 * o->median[f][t]);
		table_put(table, 1e-3 * o->least[f]);
		table_put(table, 1e-3 * o->samples[f]);
		table_put(table, o->again[f]);
		table_put(table, o->freetype_least / o->least[f]);
		table_put(table, o->freetype_ratio[f]);
		table_put(table, !held ? NO : cubic ? bars->cubic : bars->tent);
		table_put(table, o->box_ratio[f]);
		table_put(table, held && cubic ? CUBIC_TO_BOX : NO);
		table_put(table, o->samples_ratio[f]);
		table_put(table, held && cubic ? bars->samples : NO);
		table_put(table, 1e6 * o->samples_error[f]);
		table_put(table, 1e6 * o->error[f]);
		table_put(table, ERROR);
	}
}

void filters_table(const Effort *effort)
{
	static Contest contest;
	Table *table = NULL;
	for (int s = 0; s < SIZES; ++s) {
		Outcome outcome;
		memset(&outcome, 0, sizeof outcome);
		if (!begin_contest(&contest, sizes[s].size))
			return;
		for (int f = 0; f < FILTERS; ++f)
			find_errors(&contest, f, &outcome);
		run_contest(&contest, &outcome,
			sizes[s].size > 32 ? effort->long_rounds : effort->rounds);
		run_again(&contest, &outcome, effort->long_rounds);
		for (int f = 0; f < FILTERS; ++f)
			raster_chart_point(filters[f].chart, sizes[s].size,
				outcome.freetype_ratio[f]);
		table = table ? table : new_table(&contest);
		put_rows(table, &contest, &sizes[s], &outcome);
		end_contest(&contest);
	}
	table_print(table);
}

/* raster_tables.c - what a contest of rasterisers came to: times, rates, ratios, errors.
 *
 * FreeType's time divided by ours is what the bars are for. */
#include "raster.h"

#define NO ((double)NAN)

static void peer_columns(Table *table, const char *group, int decimals)
{
	for (int p = 0; p < PAINTER_COUNT; ++p)
		if (painters[p]->prepare)
			table_figures(table, group, painter_names[p], decimals);
}

static void put_peers(Table *table, const double *value, double factor)
{
	for (int p = 0; p < PAINTER_COUNT; ++p)
		if (painters[p]->prepare)
			table_put(table, factor * value[p]);
}

static void print_times(const Field *field, const Drawn *drawn, int sets)
{
	Table *table = table_new("raster-us", "drawing polygons: us per polygon",
		"Median, and minimum of the widest target; clearing and writing the image included.\n"
		"u8, f32: float vertices; double: double vertices; curves: a path, f32. Glyphs: "
		"characters 33 to 126,\nfrom 1024 px on every fourth of them.");
	peer_columns(table, "peers", 2);
	for (int kind = BYTES; kind <= FLOATS; ++kind) {
		for (int t = 0; t < field->targets; ++t)
			table_figures(table, every_way[kind].group, field->target[t]->name, 2);
		table_figures(table, every_way[kind].group, "min", 2);
	}
	table_figures(table, "double", "u8", 2);
	table_figures(table, "double", "f32", 2);
	table_figures(table, "", "curves", 2);
	for (int s = 0; s < sets; ++s) {
		const Drawn *o = &drawn[s];
		table_row(table, "%s", o->name);
		put_peers(table, o->median, 1e-3);
		for (int kind = BYTES; kind <= FLOATS; ++kind) {
			for (int t = 0; t < field->targets; ++t)
				table_put(table, 1e-3 * o->median[trial_of(field, kind, t)]);
			table_put(table, 1e-3 * o->least[trial_widest(field, kind)]);
		}
		for (int kind = BYTES_D; kind < KINDS; ++kind)
			table_put(table, 1e-3 * o->median[trial_widest(field, kind)]);
	}
	table_print(table);
}

static void print_rates(const Field *field, const Drawn *drawn, int sets)
{
	const int ours[] = { trial_widest(field, BYTES), trial_widest(field, FLOATS) };
	Table *table = table_new("raster-mpixel", "drawing polygons: Mpixel/s",
		"Of the whole image; ours on the widest target.");
	peer_columns(table, "peers", 0);
	table_figures(table, "ours", "u8", 0);
	table_figures(table, "ours", "f32", 0);
	for (int s = 0; s < sets; ++s) {
		double rate[MOST_TRIALS];
		for (int trial = 0; trial < field->trials; ++trial)
			rate[trial] = 1e3 * drawn[s].pixels / drawn[s].median[trial];
		table_row(table, "%s", drawn[s].name);
		put_peers(table, rate, 1);
		for (int i = 0; i < 2; ++i)
			table_put(table, rate[ours[i]]);
	}
	table_print(table);
}

static void print_errors(const Field *field, const Drawn *drawn, int sets)
{
	Table *table = table_new("raster-error", "drawing polygons: largest error of a pixel, 1e-6 "
		"of full coverage", "u8 can be off by 1/510 without fault. f32: the worst of all "
		"targets. Curves: against the curves,\nwhich are lines there that are off by 1e-6 "
		"pixels. Where edges cross within a pixel, the winding-weighted\ncoverage that is 1 "
		"at most is taken as exact; cairo takes the union.");
	peer_columns(table, "peers", 0);
	table_figures(table, "ours", "u8", 0);
	table_figures(table, "ours", "f32", 2);
	table_at_most(table);
	table_figures(table, "ours", "f32, double", 2);
	table_figures(table, "ours", "curves", 2);
	for (int s = 0; s < sets; ++s) {
		const Drawn *o = &drawn[s];
		double worst = 0;
		for (int t = 0; t < field->targets; ++t)
			worst = fmax(worst, o->error[trial_of(field, FLOATS, t)]);
		table_row(table, "%s", o->name);
		put_peers(table, o->error, 1e6);
		table_put(table, 1e6 * o->error[trial_widest(field, BYTES)]);
		table_put(table, 1e6 * worst);
		table_put(table, o->error_bar);
		table_put(table, 1e6 * o->error[trial_widest(field, FLOATS_D)]);
		table_put(table, 1e6 * o->error[trial_widest(field, PATHS)]);
	}
	table_print(table);
}

static void print_ratios(const Field *field, const Drawn *drawn, int sets)
{
	Table *table = table_new("raster", "drawing polygons: how many times our time",
		"FreeType's, and that of the others to u8 on the widest target. Glyphs in turn; "
		"again: each\neight times in a row, so that the CPU has its branches by heart; minima: their "
		"ratio,\nwhich stands a busy machine better than the median of ratios.");
	for (int g = 0; g < GOALS; ++g) {
		table_figures(table, goals[g].name, "again", 2);
		table_figures(table, goals[g].name, "minima", 2);
		table_figures(table, goals[g].name, "ratio", 2);
		table_at_least(table);
	}
	for (int p = 0; p < PAINTER_COUNT; ++p)
		if (p != FreeType && painters[p]->prepare)
			table_figures(table, "others", painter_names[p], 1);
	for (int s = 0; s < sets; ++s) {
		const Drawn *o = &drawn[s];
		table_row(table, "%s", o->name);
		for (int g = 0; g < GOALS; ++g) {
			const int trial = trial_on(field, goals[g].kind, goals[g].target);
			table_put(table, o->again[g]);
			table_put(table, trial < 0 ? NO : o->least[FreeType] / o->least[trial]);
			table_put(table, trial < 0 ? NO : o->ratio[trial]);
			table_put(table, o->bar[g]);
		}
		for (int p = 0; p < PAINTER_COUNT; ++p)
			if (p != FreeType && painters[p]->prepare)
				table_put(table, o->median[p] / o->median[trial_widest(field, BYTES)]);
	}
	table_print(table);
}

void raster_tables(const Field *field, const Drawn *drawn, int sets)
{
	print_times(field, drawn, sets);
	print_rates(field, drawn, sets);
	print_ratios(field, drawn, sets);
	print_errors(field, drawn, sets);
}

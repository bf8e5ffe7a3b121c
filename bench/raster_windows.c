/* raster_windows.c - the kernels alone: of one pixel over the edges of a ring, and of deposits.
 *
 * What an image would cost that asks every edge for every pixel, by the kernels of one pixel, is
 * why the raster has deposits: the numbers that a piece of an edge within one cell adds to the
 * image. No branch in either depends on where an edge lies, so random ones do for all. */
#include "raster.h"

#include <string.h>

enum { MOST_WINDOWS = 32, PARAMETERS = 4, MOST_LANES = 16, PIECES = 128, MOST_OUTPUTS = 72 };

#define ROW(id, family, m, n, accumulators, outputs, k, r) { id, #family },
static const struct { int id; const char *family; } rings[] = { EW_RINGS(ROW) };
enum { RINGS = (int)(sizeof rings / sizeof *rings) };

static const double COVERAGE_BAR = 0.65;       /* float, avx512 */

/* A window of 1/4 .. 3/4 each way; filters take the first two numbers for their centre. */
static void windows_run(const void *context, long repeat)
{
	static _Alignas(64) double x[ITEMS + 1], y[ITEMS + 1], window[PARAMETERS * MOST_LANES];
	static _Alignas(64) double sum[EW_MAX_ACCUMULATORS * MOST_LANES];
	static _Alignas(64) float xf[ITEMS + 1], yf[ITEMS + 1], windowf[PARAMETERS * MOST_LANES];
	static _Alignas(64) float sumf[EW_MAX_ACCUMULATORS * MOST_LANES];
	static int ready;
	const KernelJob *job = context;
	if (!ready) {
		ready = 1;
		points_make(DOUBLE, x, ITEMS + 1);
		points_make(DOUBLE, y, ITEMS + 1);
		points_make(FLOAT, xf, ITEMS + 1);
		points_make(FLOAT, yf, ITEMS + 1);
		for (int i = 0; i < PARAMETERS * MOST_LANES; ++i) {
			window[i] = i / EW_LANES % 2 ? 0.75 : 0.25;
			windowf[i] = i / EW_LANES_FLOAT % 2 ? 0.75f : 0.25f;
		}
	}
	while (repeat-- > 0)
		if (job->kernel->run)
			job->kernel->run(x, y, window, 1, job->step, ITEMS, sum);
		else
			job->kernel->runf(xf, yf, windowf, 1, job->step, ITEMS, sumf);
}

static Table *new_table(const Target *const *target, int targets)
{
	Table *table = table_new("windows", "kernels of one pixel, L1: ns per pixel and edge",
		"Coverage of a window, and filters about a point; median, and minimum of the widest "
		"target.");
	for (int p = 0; p < PRECISIONS; ++p) {
		for (int t = 0; t < targets; ++t)
			table_figures(table, precision_names[p], target[t]->name, 2);
		if (p == FLOAT)
			table_at_most(table);
		table_figures(table, precision_names[p], "min", 2);
	}
	return table;
}

static void put_row(Table *table, const Race *race, int first, const Target *const *target,
	int targets, int held)
{
	for (int p = 0; p < PRECISIONS; ++p) {
		for (int t = 0; t < targets; ++t)
			table_put(table, race_median(race, first + p * targets + t));
		if (p == FLOAT)
			table_put(table, held && target[targets - 1]->bit == EW_AVX512
				? COVERAGE_BAR : (double)NAN);
		table_put(table, race_minimum(race, first + p * targets + targets - 1));
	}
}

void windows_table(const Effort *effort)
{
	static KernelJob job[MOST_WINDOWS][PRECISIONS][MAX_TARGETS];
	const Target *target[MAX_TARGETS];
	const int targets = targets_here(target);
	int ring[MOST_WINDOWS], count = 0;
	Race race = race_new(effort->rounds);
	for (int r = 0; r < RINGS && count < MOST_WINDOWS; ++r) {
		if (strcmp(rings[r].family, "coverage") != 0 && strcmp(rings[r].family, "filter") != 0)
			continue;
		for (int p = 0; p < PRECISIONS; ++p)
			for (int t = 0; t < targets; ++t) {
				job[count][p][t] = kernel_job(target[t], p, rings[r].id);
				race_add(&race, windows_run, &job[count][p][t], ITEMS);
			}
		ring[count++] = r;
	}
	race_run(&race);
	Table *table = new_table(target, targets);
	for (int i = 0; i < count; ++i) {
		table_row(table, "%s", ring_name(rings[ring[i]].id));
		put_row(table, &race, i * PRECISIONS * targets, target, targets,
			strcmp(rings[ring[i]].family, "coverage") == 0);
	}
	table_print(table);
	race_free(&race);
}

/* ---- deposits ---- */

typedef struct { ew_deposit *run; } DepositJob;

static void deposit_run(const void *context, long repeat)
{
	static _Alignas(64) float x[2 * PIECES], y[2 * PIECES], out[MOST_OUTPUTS * PIECES];
	static int ready;
	const DepositJob *job = context;
	if (!ready) {
		ready = 1;
		points_make(FLOAT, x, 2 * PIECES);
		points_make(FLOAT, y, 2 * PIECES);
	}
	while (repeat-- > 0)
		job->run(x, y, PIECES, PIECES, out);
}

static int lowest_bit(unsigned bits)
{
	int place = 0;
	while (!(bits >> place & 1))
		++place;
	return place;
}

void deposits_table(const Effort *effort)
{
	static const ew_filter *const filters[] = { &ew_filter_box, &ew_filter_tent,
		&ew_filter_bspline2, &ew_filter_bspline3, &ew_filter_catmull_rom,
		&ew_filter_mitchell };
	enum { COUNT = (int)(sizeof filters / sizeof *filters) };
	DepositJob job[COUNT][MAX_TARGETS];
	const Target *target[MAX_TARGETS];
	const int targets = targets_here(target);
	Race race = race_new(effort->rounds);
	Table *table = table_new("deposits", "deposits of filters, L1, float: ns per piece",
		"128 pieces at a time; a filter of N pixels gives N (N + 1) numbers for each.");
	table_figures(table, "", "numbers", 0);
	for (int t = 0; t < targets; ++t)
		table_figures(table, "", target[t]->name, 2);
	table_figures(table, target[targets - 1]->name, "min", 2);
	for (int f = 0; f < COUNT; ++f)
		for (int t = 0; t < targets; ++t) {
			job[f][t].run = filters[f]->deposit[lowest_bit(target[t]->bit)];
			race_add(&race, deposit_run, &job[f][t], PIECES);
		}
	race_run(&race);
	for (int f = 0; f < COUNT; ++f) {
		table_row(table, "%s", filters[f]->name);
		table_put(table, filters[f]->size * (filters[f]->size + 1));
		for (int t = 0; t < targets; ++t)
			table_put(table, race_median(&race, f * targets + t));
		table_put(table, race_minimum(&race, f * targets + targets - 1));
	}
	table_print(table);
	race_free(&race);
}

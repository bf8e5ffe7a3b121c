/* curves.c - quads, cubics and conics: every kernel on every target, in L1.
 *
 * One lane holds one curve. CURVES of them are few enough that all control points of a cubic stay
 * in the nearest cache, and more than a path gathers at a time. A slot is the time of one
 * multiply-add on a vector of the kernel's own width, as in kernels.c. Hand-written prototypes of
 * these schemes took, avx512 and double, 51 slots (quad, degree 2), 140 (quad, 4), 102 (cubic, 2)
 * and 219 (cubic, 4): 83 to 90 % of the FMA pipe, whence the bars. Conics also divide and take
 * roots, which the count does not hold, so that their share of the FMA pipe says little. */
#include "bench.h"

#include "ex_kernels.h"

#include <string.h>

enum { CURVES = 256, POINTS = 4, MOST_LANES = 16, MOST_KERNELS = 32 };

#define ROW(id, family, m, n, accumulators, outputs, k, r) { id, #family, m },
static const struct { int id; const char *family; int degree; } rings[] = { EW_RINGS(ROW) };
enum { RINGS = (int)(sizeof rings / sizeof *rings) };

static const char *const families[] = { "quad", "cubic", "conic" };
enum { FAMILIES = (int)(sizeof families / sizeof *families) };

typedef struct { const Target *target[MAX_TARGETS]; int targets, ring[MOST_KERNELS], count; } Field;

static void curves_run(const void *context, long repeat)
{
	static _Alignas(64) double x[POINTS * CURVES], y[POINTS * CURVES];
	static _Alignas(64) double sum[EW_MAX_ACCUMULATORS * MOST_LANES];
	static _Alignas(64) float xf[POINTS * CURVES], yf[POINTS * CURVES];
	static _Alignas(64) float sumf[EW_MAX_ACCUMULATORS * MOST_LANES];
	static int ready;
	const KernelJob *job = context;
	if (!ready) {
		ready = 1;
		points_make(DOUBLE, x, POINTS * CURVES);
		points_make(DOUBLE, y, POINTS * CURVES);
		points_make(FLOAT, xf, POINTS * CURVES);
		points_make(FLOAT, yf, POINTS * CURVES);
	}
	while (repeat-- > 0)
		if (job->kernel->run)
			job->kernel->run(x, y, x, CURVES, job->step, CURVES, sum);
		else
			job->kernel->runf(xf, yf, xf, CURVES, job->step, CURVES, sumf);
}

static Field field_here(void)
{
	Field field = { { NULL }, 0, { 0 }, 0 };
	field.targets = targets_here(field.target);
	for (int f = 0; f < FAMILIES; ++f)
		for (int r = 0; r < RINGS && field.count < MOST_KERNELS; ++r)
			if (strcmp(rings[r].family, families[f]) == 0)
				field.ring[field.count++] = r;
	return field;
}

/* The least share of the FMA pipe; NAN where there is no bar. */
static double pipe_bar(int ring)
{
	const int degree = rings[ring].degree;
	return strcmp(rings[ring].family, "conic") != 0 && (degree == 2 || degree == 4)
		? 75 : (double)NAN;
}

static Table *curves_table(const Field *field, int precision)
{
	static const char *const keys[] = { "curves", "curvesf" };
	static const char *const titles[] = { "curves in L1, double", "curves in L1, float" };
	Table *table = table_new(keys[precision], titles[precision],
		"ns and slots per curve; %: of the FMA pipe, operations / slots; ratio: fma to the "
		"widest target.");
	table_figures(table, "operations", "fma", 0);
	table_figures(table, "operations", "add", 0);
	for (int t = 0; t < field->targets; ++t) {
		table_figures(table, field->target[t]->name, "ns", 2);
		table_figures(table, field->target[t]->name, "slots", 1);
		table_figures(table, field->target[t]->name, "%", 0);
		if (field->target[t]->bit == EW_AVX512)
			table_at_least(table);
	}
	table_figures(table, "", "ratio", 1);
	return table;
}

/* The trials of a race: kernel by kernel, target by target, the multiply-adds before each. */
static int trial_of(const Field *field, int kernel, int target)
{
	return 2 * (kernel * field->targets + target) + 1;
}

static void put_row(Table *table, const Race *race, const Field *field, int kernel, int precision)
{
	const int ring = field->ring[kernel], last = field->targets - 1;
	const Kernel *widest = &field->target[last]->kernels[precision][rings[ring].id];
	int scalar = -1;
	table_row(table, "%s, degree %d", rings[ring].family, rings[ring].degree);
	table_put(table, widest->f);
	table_put(table, widest->a);
	for (int t = 0; t < field->targets; ++t) {
		const Target *target = field->target[t];
		const int trial = trial_of(field, kernel, t);
		const double slots = race_ratio(race, trial, trial - 1) * target->lanes[precision];
		table_put(table, race_median(race, trial));
		table_put(table, slots);
		table_put(table, 100 * target->kernels[precision][rings[ring].id].f / slots);
		if (target->bit == EW_AVX512)
			table_put(table, pipe_bar(ring));
		if (target->bit == EW_FMA)
			scalar = trial;
	}
	if (scalar >= 0)
		table_put(table, race_ratio(race, scalar, trial_of(field, kernel, last)));
}

static void measure_curves(const Field *field, int precision, int rounds)
{
	static KernelJob job[MOST_KERNELS][MAX_TARGETS];
	Table *table = curves_table(field, precision);
	Race race = race_new(rounds);
	for (int k = 0; k < field->count; ++k)
		for (int t = 0; t < field->targets; ++t) {
			const Target *target = field->target[t];
			job[k][t] = kernel_job(target, precision, rings[field->ring[k]].id);
			race_add(&race, width_of(target->bit)->of[precision].peak, NULL, PEAK_WORK);
			race_add(&race, curves_run, &job[k][t], CURVES);
		}
	race_run(&race);
	for (int k = 0; k < field->count; ++k)
		put_row(table, &race, field, k, precision);
	table_print(table);
	race_free(&race);
}

/* Beside every term written out, nested: fewer operations than computer algebra gives (quad 180 +
 * 104, cubic 396 + 278 before fusion, against 331 and 794 in all that fontTools has). */
static void measure_expanded(int rounds)
{
	static const struct { const char *name; int id, expanded; double bar; } pairs[] = {
		{ "quad, degree 2", EW_RING_QUAD_2, EX_RING_QUAD_2, (double)NAN },
		{ "cubic, degree 2", EW_RING_CUBIC_2, EX_RING_CUBIC_2, 6 },
	};
	enum { PAIRS = (int)(sizeof pairs / sizeof *pairs) };
	const Target *target[MAX_TARGETS], *widest = target[targets_here(target) - 1];
	KernelJob nodes[PAIRS], expanded[PAIRS];
	Race race = race_new(rounds);
	Table *table = table_new("expanded", "moments of curves against all terms written out, L1, "
		"double", "ns per curve, by nodes and expanded.");
	table_figures(table, "nodes", "ns", 2);
	table_figures(table, "expanded", "ns", 2);
	table_figures(table, "", "ratio", 2);
	table_at_least(table);
	for (int i = 0; i < PAIRS; ++i) {
		nodes[i] = kernel_job(widest, DOUBLE, pairs[i].id);
		expanded[i] = nodes[i];
		expanded[i].kernel = &widest->expanded[pairs[i].expanded];
		race_add(&race, curves_run, &nodes[i], CURVES);
		race_add(&race, curves_run, &expanded[i], CURVES);
	}
	race_run(&race);
	for (int i = 0; i < PAIRS; ++i) {
		table_row(table, "%s, %s", pairs[i].name, widest->name);
		table_put(table, race_median(&race, 2 * i));
		table_put(table, race_median(&race, 2 * i + 1));
		table_put(table, race_ratio(&race, 2 * i + 1, 2 * i));
		table_put(table, pairs[i].bar);
	}
	table_print(table);
	race_free(&race);
}

void section_curves(const Effort *effort)
{
	const Field field = field_here();
	for (int precision = 0; precision < PRECISIONS; ++precision)
		measure_curves(&field, precision, effort->rounds);
	measure_expanded(effort->rounds);
	paths_tables(effort);
	distance_tables(effort);
}

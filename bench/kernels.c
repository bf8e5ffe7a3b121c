/* kernels.c - every ring kernel on every target, in the nearest cache.
 *
 * The unit is the slot: the time of one multiply-add on a vector of the kernel's own width, at
 * the rate measured beside it in the same round. Slots per edge hardly depend on the machine, and
 * a kernel with f operations on the FMA pipe cannot take fewer than f of them. */
#include "bench.h"

static double slots_of[MAX_TARGETS][KERNELS];   /* double */
static int targets_measured;

typedef struct { double ns, minimum, slots, least; } Result;     /* least slots: of minima */

void section_machine(const Effort *effort)
{
	const Target *target[MAX_TARGETS];
	int targets = targets_here(target);
	Table *table = table_new("machine", "multiply-adds of this machine, per ns",
		"Vectors of each width, independent of each other: what a slot is.");
	for (int p = 0; p < PRECISIONS; ++p) {
		table_figures(table, precision_names[p], "lanes", 0);
		table_figures(table, precision_names[p], "median", 2);
		table_figures(table, precision_names[p], "best", 2);
	}
	for (int t = 0; t < targets; ++t) {
		const Width *width = width_of(target[t]->bit);
		if (t > 0 && width == width_of(target[t - 1]->bit))
			continue;
		Race race = race_new(effort->rounds);
		table_row(table, "%s", width->name);
		for (int p = 0; p < PRECISIONS; ++p)
			race_add(&race, width->of[p].peak, NULL, PEAK_WORK);
		race_run(&race);
		for (int p = 0; p < PRECISIONS; ++p) {
			table_put(table, target[t]->lanes[p]);
			table_put(table, 1 / race_median(&race, p));
			table_put(table, 1 / race_minimum(&race, p));
		}
		race_free(&race);
	}
	table_print(table);
}

/* ---- measure ---- */

static void measure_kernels(int precision, const Target *const *target, int targets,
	Result (*result)[KERNELS], int rounds)
{
	static KernelJob job[MAX_TARGETS][KERNELS];
	Race race = race_new(rounds);
	for (int id = 0; id < KERNELS; ++id)
		for (int t = 0; t < targets; ++t) {
			job[t][id] = kernel_job(target[t], precision, id);
			race_add(&race, width_of(target[t]->bit)->of[precision].peak, NULL,
				PEAK_WORK);
			race_add(&race, kernel_run, &job[t][id], ITEMS);
		}
	race_run(&race);
	for (int id = 0; id < KERNELS; ++id)
		for (int t = 0; t < targets; ++t) {
			int peak = 2 * (id * targets + t);
			result[t][id].ns = race_median(&race, peak + 1);
			result[t][id].minimum = race_minimum(&race, peak + 1);
			result[t][id].slots = race_ratio(&race, peak + 1, peak)
				* target[t]->lanes[precision];
			result[t][id].least = race_minimum(&race, peak + 1)
				/ race_minimum(&race, peak) * target[t]->lanes[precision];
		}
	race_free(&race);
}

/* ---- tables ---- */

/* Degree 12 after degree 8, the last of all moments. */
static int kernel_in_order(int k)
{
	const int place = EW_RING_MOMENTS_8 + 1;
	return k < place ? k : k == place ? (int)DEGREE_12 : k - 1;
}

static int has_bars(unsigned target)
{
	return target == EW_AVX512 || target == EW_AVX2;
}

/* Bars for slots per edge of all moments, or NAN; float may be a tenth slower. */
static double slots_bar(unsigned target, int precision, int id)
{
	static const struct { int id; double avx512, avx2; } bars[] = {
		{ EW_RING_MOMENTS_0, 3.3, 6 }, { EW_RING_MOMENTS_1, 6, 8 },
		{ EW_RING_MOMENTS_2, 13.5, 16 }, { EW_RING_MOMENTS_3, 21, 29 },
		{ EW_RING_MOMENTS_4, 38, 55 }, { EW_RING_MOMENTS_6, 88, 112 },
		{ EW_RING_MOMENTS_8, 148, 190 }, { DEGREE_12, 340, 385 },
	};
	for (size_t i = 0; i < sizeof bars / sizeof *bars; ++i)
		if (bars[i].id == id)
			return (target == EW_AVX512 ? bars[i].avx512 : bars[i].avx2)
				* (precision == FLOAT ? 1.1 : 1);
	return (double)NAN;
}

static void print_times(int precision, const Target *const *target, int targets,
	Result (*result)[KERNELS])
{
	static const char *const keys[] = { "ns", "nsf" };
	static const char *const titles[] = { "kernels in L1, double: ns per edge",
		"kernels in L1, float: ns per edge" };
	Table *table = table_new(keys[precision], titles[precision],
		"Median and minimum over the rounds; then the time of each target in that of the "
		"widest.");
	for (int t = 0; t < targets; ++t) {
		table_figures(table, target[t]->name, "median", 3);
		table_figures(table, target[t]->name, "min", 3);
	}
	for (int t = targets - 2; t >= 0; --t)
		table_figures(table, "ratios", target[t]->name, 1);
	for (int k = 0; k < KERNELS; ++k) {
		int id = kernel_in_order(k);
		table_row(table, "%s", ring_name(id));
		for (int t = 0; t < targets; ++t) {
			table_put(table, result[t][id].ns);
			table_put(table, result[t][id].minimum);
		}
		for (int t = targets - 2; t >= 0; --t)
			table_put(table, result[t][id].ns / result[targets - 1][id].ns);
	}
	table_print(table);
}

static void print_slots(int precision, const Target *const *target, int targets,
	Result (*result)[KERNELS])
{
	static const char *const keys[] = { "slots", "slotsf" };
	static const char *const titles[] = { "kernels in L1, double: slots per edge",
		"kernels in L1, float: slots per edge" };
	Table *table = table_new(keys[precision], titles[precision],
		"One slot: one multiply-add on a vector of this width. Median of the ratio to the "
		"multiply-adds beside it;\nratio of the minima; %: of the FMA pipe, operations / "
		"slots.");
	table_figures(table, "operations", "fma", 0);
	table_figures(table, "operations", "add", 0);
	for (int t = 0; t < targets; ++t) {
		table_figures(table, target[t]->name, "%", 0);
		table_figures(table, target[t]->name, "min", 1);
		table_figures(table, target[t]->name, "slots", 1);
		if (has_bars(target[t]->bit))
			table_at_most(table);
	}
	for (int k = 0; k < KERNELS; ++k) {
		int id = kernel_in_order(k);
		const Kernel *last = &target[targets - 1]->kernels[precision][id];
		table_row(table, "%s", ring_name(id));
		table_put(table, last->f);
		table_put(table, last->a);
		for (int t = 0; t < targets; ++t) {
			double slots = result[t][id].slots;
			table_put(table, 100 * target[t]->kernels[precision][id].f / slots);
			table_put(table, result[t][id].least);
			table_put(table, slots);
			if (has_bars(target[t]->bit))
				table_put(table, slots_bar(target[t]->bit, precision, id));
		}
	}
	table_print(table);
}

void section_kernels(const Effort *effort)
{
	static Result result[MAX_TARGETS][KERNELS];
	const Target *target[MAX_TARGETS];
	int targets = targets_here(target);
	for (int precision = 0; precision < PRECISIONS; ++precision) {
		measure_kernels(precision, target, targets, result, effort->rounds);
		print_times(precision, target, targets, result);
		print_slots(precision, target, targets, result);
		for (int t = 0; t < targets && precision == DOUBLE; ++t)
			for (int id = 0; id < KERNELS; ++id)
				slots_of[t][id] = result[t][id].slots;
	}
	targets_measured = targets;
}

double kernel_slots(int target, int id)
{
	return target < targets_measured ? slots_of[target][id] : (double)NAN;
}

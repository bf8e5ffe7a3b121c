/* order.c - what it costs that all targets give the same bits.
 *
 * By definition item i belongs to lane i mod 8 (double) or 16 (float). A target whose registers
 * are narrower runs the lanes in passes over the block. Free order is the same kernel told that
 * there are as many lanes as its register has: one pass, consecutive loads, other bits. Where the
 * register has all lanes both are the same call, and the ratio shows how far two equal trials
 * differ. */
#include "bench.h"

static const int degrees[] = { 0, 1, 2, 3, 4, 6, 8 };
enum { DEGREES = (int)(sizeof degrees / sizeof *degrees) };

static void order_of_target(Table *table, const Target *target, int precision, int rounds)
{
	KernelJob fixed[DEGREES], free_order[DEGREES];
	Race race = race_new(rounds);
	for (int i = 0; i < DEGREES; ++i) {
		fixed[i] = kernel_job(target, precision, EW_RING_MOMENTS_0 + degrees[i]);
		free_order[i] = fixed[i];
		free_order[i].step = (size_t)target->lanes[precision];
		race_add(&race, kernel_run, &fixed[i], ITEMS);
		race_add(&race, kernel_run, &free_order[i], ITEMS);
	}
	race_run(&race);
	for (int i = 0; i < DEGREES; ++i) {
		table_row(table, "%s %s, degree %d", target->name, precision_names[precision],
			degrees[i]);
		table_put(table, race_median(&race, 2 * i));
		table_put(table, race_minimum(&race, 2 * i));
		table_put(table, race_median(&race, 2 * i + 1));
		table_put(table, race_minimum(&race, 2 * i + 1));
		table_put(table, race_ratio(&race, 2 * i, 2 * i + 1));
		table_put(table, 1.05);
	}
	race_free(&race);
}

void section_order(const Effort *effort)
{
	const Target *target[MAX_TARGETS];
	int targets = targets_here(target);
	Table *table = table_new("order", "the fixed order of lanes against free order, L1, ns per "
		"edge", "Free order: as many lanes as the register has.");
	table_figures(table, "fixed", "median", 3);
	table_figures(table, "fixed", "min", 3);
	table_figures(table, "free", "median", 3);
	table_figures(table, "free", "min", 3);
	table_figures(table, "", "ratio", 3);
	table_at_most(table);
	for (int t = 0; t < targets; ++t)
		for (int precision = 0; precision < PRECISIONS; ++precision)
			if (target[t]->lanes[precision] > 1)
				order_of_target(table, target[t], precision, effort->rounds);
	table_print(table);
}

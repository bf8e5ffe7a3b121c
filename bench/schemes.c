/* schemes.c - what the choice of a scheme brings, against the coefficient matrix.
 *
 * The Makefile has gen emit the same integrals once more with every kernel in coefficient-matrix
 * form. Both are run on the widest target, double, in L1. */
#include "bench.h"

#include "mx_kernels.h"

static const struct { const char *name; int id, matrix; double bar; } pairs[] = {
	{ "x^4 y^2", EW_RING_X4Y2, MX_RING_X4Y2, 1.3 },
	{ "all moments, degree 3", EW_RING_MOMENTS_3, MX_RING_MOMENTS_3, 1.9 },
	{ "all moments, degree 6", EW_RING_MOMENTS_6, MX_RING_MOMENTS_6, 2.7 },
};
enum { PAIRS = (int)(sizeof pairs / sizeof *pairs) };

void section_schemes(const Effort *effort)
{
	const Target *target[MAX_TARGETS];
	const Target *widest = target[targets_here(target) - 1];
	KernelJob chosen[PAIRS], matrix[PAIRS];
	Race race = race_new(effort->rounds);
	Table *table = table_new("schemes", "the schemes chosen against the coefficient matrix, "
		"L1, double", "Operations on the FMA pipe; ns per edge.");
	table_figures(table, "chosen", "fma", 0);
	table_figures(table, "chosen", "ns", 3);
	table_figures(table, "matrix", "fma", 0);
	table_figures(table, "matrix", "ns", 3);
	table_figures(table, "", "ratio", 2);
	table_at_least(table);
	for (int i = 0; i < PAIRS; ++i) {
		chosen[i] = kernel_job(widest, DOUBLE, pairs[i].id);
		matrix[i] = chosen[i];
		matrix[i].kernel = &widest->matrix[pairs[i].matrix];
		race_add(&race, kernel_run, &chosen[i], ITEMS);
		race_add(&race, kernel_run, &matrix[i], ITEMS);
	}
	race_run(&race);
	for (int i = 0; i < PAIRS; ++i) {
		table_row(table, "%s, %s", pairs[i].name, widest->name);
		table_put(table, chosen[i].kernel->f);
		table_put(table, race_median(&race, 2 * i));
		table_put(table, matrix[i].kernel->f);
		table_put(table, race_median(&race, 2 * i + 1));
		table_put(table, race_ratio(&race, 2 * i + 1, 2 * i));
		table_put(table, pairs[i].bar);
	}
	table_print(table);
	race_free(&race);
}

/* printed_moments.h - what holds the moments to degree 2 that an example prints against exact ones:
 * their names, what bounds are made of, and verdicts on groups of numbers, in whichever order they
 * come. */
#ifndef PRINTED_MOMENTS_H
#define PRINTED_MOMENTS_H

#include "edgewise_kernels.h"
#include "printed.h"

enum { M00, M10, M01, M20, M11, M02, MOMENTS };

static const char *const moment_names[MOMENTS] = { "m00", "m10", "m01", "m20", "m11", "m02" };
static const int power_x[MOMENTS] = { 0, 1, 0, 2, 1, 0 }, power_y[MOMENTS] = { 0, 0, 1, 0, 1, 2 };

/* ---- bounds ---- */

static const double U = 0x1p-53;
static const double SLACK = 1.000001; /* the bounds are rounded themselves */

static inline double gamma_of(double k)
{
	return SLACK * k * U / (1 - k * U);
}

/* What the list of kernels promises for the moments of degree 2 of `items` edges of a family, which
 * are the worst of the six: k for one of them, and r roundings per further one in one of 8 lanes.
 * NaN, which no error is within, if it is not listed. */
static inline double listed_roundings(const char *family, size_t items)
{
	static const struct {
		const char *family;
		int m, k, r;
	} rows[] = {
#define ROW(id, family, m, n, accumulators, outputs, k, r) { #family, m, k, r },
		EW_RINGS(ROW)
#undef ROW
	};
	for (int id = 0; id < EW_RINGS_COUNT; id++)
		if (!strcmp(rows[id].family, family) && rows[id].m == 2)
			return rows[id].k + rows[id].r * (ceil((double)items / 8) - 1);
	return NAN;
}

/* ---- verdicts ---- */

typedef struct {
	const char *name;
	char why[200]; /* its first failure */
	double worst;  /* largest error, in bounds */
} Group;

/* `owner` is the name of what the number belongs to. */
static inline void check_within(Group *group, const char *owner, const char *what, double error,
				double bound)
{
	if (bound > 0)
		group->worst = fmax(group->worst, error / bound);
	if (!(error <= bound) && !group->why[0])
		snprintf(group->why, sizeof group->why,
			 "%s: the error of %s is %g, allowed is %g", owner, what, error, bound);
}

static inline int report(const Group *groups, int count)
{
	int failed = 0;
	for (int i = 0; i < count; i++) {
		failed += groups[i].why[0] != '\0';
		if (groups[i].why[0])
			printf("not ok %s: %s\n", groups[i].name, groups[i].why);
		else
			printf("ok %s\n", groups[i].name);
	}
	printf("%d passed, %d failed\n", count - failed, failed);
	return failed || fflush(stdout) || ferror(stdout);
}

#endif

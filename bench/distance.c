/* distance.c - integrals of powers of the distance, and closedness.
 *
 * The library against a loop that anyone would write: for each edge two square roots and one
 * logarithm of libm, by the formula for a triangle with one corner at the centre. With h the
 * height above the edge and u the place along it, I_k = h/(k+2) * integral of r^k du, where
 * r^2 = u^2 + h^2, and by parts
 *
 *     integral of r^k du = (u r^k + k h^2 * integral of r^(k-2) du) / (k+1)
 *
 * down to the integral of du/r, log(u + r). The loop loses digits where u + r cancels, and skips an
 * edge where nothing of it is left (or d is 0, which makes u NaN); ours does neither.
 * Closedness stands beside a loop that reads the same four arrays. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>

enum { CORNERS = ITEMS, MANY = 1 << 22 };

static const struct { int k, id; } powers[] = {
	{ -1, EW_RING_RADIUS_INVERSE }, { 1, EW_RING_RADIUS_1 },
	{ 3, EW_RING_RADIUS_3 }, { 5, EW_RING_RADIUS_5 },
};
enum { POWERS = (int)(sizeof powers / sizeof *powers) };

/* ---- the loop over libm ---- */

#define LOOP(name, real, root, logarithm) \
static double name(int k, const real *x, const real *y, size_t n, real cx, real cy) \
{ \
	double sum = 0; \
	real x0 = x[n - 1] - cx, y0 = y[n - 1] - cy, r0 = root(x0 * x0 + y0 * y0); \
	for (size_t i = 0; i < n; ++i) { \
		const real x1 = x[i] - cx, y1 = y[i] - cy, r1 = root(x1 * x1 + y1 * y1); \
		const real dx = x1 - x0, dy = y1 - y0, d = root(dx * dx + dy * dy); \
		const real h = (x0 * y1 - x1 * y0) / d; \
		real u0 = (x0 * dx + y0 * dy) / d, u1 = (x1 * dx + y1 * dy) / d; \
		if (u0 + r0 > 0 && u1 + r1 > 0) { \
			real whole = logarithm((u1 + r1) / (u0 + r0)); \
			for (int j = 1; j <= k; j += 2) { \
				u0 *= j == 1 ? r0 : r0 * r0; \
				u1 *= j == 1 ? r1 : r1 * r1; \
				whole = (u1 - u0 + (real)j * h * h * whole) / (real)(j + 1); \
			} \
			sum += (double)(h * whole / (real)(k + 2)); \
		} \
		x0 = x1; \
		y0 = y1; \
		r0 = r1; \
	} \
	return sum; \
}
LOOP(loop_double, double, sqrt, log)
LOOP(loop_float, float, sqrtf, logf)

typedef struct { const Rings *ring; int precision, k, libm; } RadiusJob;

/* About a point within the ring. */
static double radius_of(const RadiusJob *job)
{
	const Rings *r = job->ring;
	const float cx = (r->xf[0] + r->xf[CORNERS / 2]) / 2;
	const float cy = (r->yf[0] + r->yf[CORNERS / 2]) / 2;
	if (job->precision == DOUBLE)
		return (job->libm ? loop_double : ew_radius)(job->k, r->x, r->y, CORNERS,
			(double)cx, (double)cy);
	return job->libm ? loop_float(job->k, r->xf, r->yf, CORNERS, cx, cy)
		: (double)ew_radiusf(job->k, r->xf, r->yf, CORNERS, cx, cy);
}

static void radius_run(const void *context, long repeat)
{
	static volatile double sink;
	while (repeat-- > 0)
		sink = radius_of(context);
	(void)sink;
}

/* A slip in a formula is far beyond what either loses by rounding. */
static void check_agreement(const RadiusJob *loop, const RadiusJob *ours)
{
	const double error = fabs(radius_of(loop) / radius_of(ours) - 1);
	if (!(error <= 1e-3)) {
		fprintf(stderr, "bench: libm and ew_radius differ by %.1e for k = %d\n", error,
			ours->k);
		exit(1);
	}
}

/* ---- distance ---- */

static void measure_radii(Table *table, const Rings *ring, int precision, int rounds)
{
	const Target *target[MAX_TARGETS];
	const int targets = targets_here(target), each = targets + 2;
	KernelJob kernel[POWERS][MAX_TARGETS];
	RadiusJob job[POWERS][2];
	Race race = race_new(rounds);
	for (int p = 0; p < POWERS; ++p) {
		for (int libm = 0; libm < 2; ++libm)
			job[p][libm] = (RadiusJob){ ring, precision, powers[p].k, libm };
		check_agreement(&job[p][1], &job[p][0]);
		race_add(&race, radius_run, &job[p][1], CORNERS);
		race_add(&race, radius_run, &job[p][0], CORNERS);
		for (int t = 0; t < targets; ++t) {
			kernel[p][t] = kernel_job(target[t], precision, powers[p].id);
			race_add(&race, kernel_run, &kernel[p][t], ITEMS);
		}
	}
	race_run(&race);
	for (int p = 0; p < POWERS; ++p) {
		table_row(table, "k = %d, %s", powers[p].k, precision_names[precision]);
		table_put(table, race_median(&race, each * p));
		for (int t = 0; t < targets; ++t)
			table_put(table, race_median(&race, each * p + 2 + t));
		table_put(table, race_median(&race, each * p + 1));
		table_put(table, race_minimum(&race, each * p + 1));
		table_put(table, race_ratio(&race, each * p, each * p + 1));
		table_put(table, powers[p].k == 1 ? 4 : (double)NAN);
	}
	race_free(&race);
}

static void distance_table(const Effort *effort)
{
	const Target *target[MAX_TARGETS];
	const int targets = targets_here(target);
	Rings ring = rings_make(1, CORNERS, CORNERS);
	Table *table = table_new("distance", "integrals of r^k over a 1024-gon, L1, ns per edge",
		"A loop over sqrt and log of libm; the kernels; ew_radius about a point within "
		"(k = 1: ew_distance).");
	table_figures(table, "libm", "median", 1);
	for (int t = 0; t < targets; ++t)
		table_figures(table, "kernels", target[t]->name, 2);
	table_figures(table, "ew_radius", "median", 2);
	table_figures(table, "ew_radius", "min", 2);
	table_figures(table, "", "libm / ours", 1);
	table_at_least(table);
	for (int precision = 0; precision < PRECISIONS; ++precision)
		measure_radii(table, &ring, precision, effort->rounds);
	table_print(table);
	rings_free(&ring);
}

/* ---- closedness ---- */

/* The first half of x is x0, the second x1; likewise y. */
typedef struct { int precision, hash; const void *x, *y; size_t edges; } ClosedJob;

static void closed_run(const void *context, long repeat)
{
	static volatile double sink;
	const ClosedJob *job = context;
	const size_t n = job->edges;
	const double *x = job->x, *y = job->y;
	const float *xf = job->x, *yf = job->y;
	while (repeat-- > 0)
		if (job->precision == DOUBLE)
			sink = job->hash ? ew_is_closed(x, y, x + n, y + n, n)
				: ew_closure(x, y, x + n, y + n, n, 0, 0);
		else
			sink = job->hash ? ew_is_closedf(xf, yf, xf + n, yf + n, n)
				: (double)ew_closuref(xf, yf, xf + n, yf + n, n, 0, 0);
	(void)sink;
}

static void measure_closed(Table *table, int precision, size_t edges, int rounds)
{
	const size_t size = precision == DOUBLE ? sizeof(double) : sizeof(float);
	char *values = allocate(4 * edges * size);
	ReadJob floor = { NULL, precision, values, values + 2 * edges * size, 2 * edges };
	ClosedJob job[2];
	Race race = race_new(rounds);
	points_make(precision, values, 4 * edges);
	floor.width = width_fastest(floor);
	race_add(&race, read_run, &floor, (double)edges);
	for (int hash = 1; hash >= 0; --hash) {
		job[hash] = (ClosedJob){ precision, hash, floor.x, floor.y, edges };
		race_add(&race, closed_run, &job[hash], (double)edges);
	}
	race_run(&race);
	for (int trial = 1; trial <= 2; ++trial) {
		table_row(table, "%s%s, %s", trial == 1 ? "ew_is_closed" : "ew_closure",
			precision == DOUBLE ? "" : "f", edges == ITEMS ? "in L1" : "from memory");
		table_put(table, race_median(&race, 0));
		table_put(table, race_median(&race, trial));
		table_put(table, race_minimum(&race, trial));
		table_put(table, race_ratio(&race, trial, 0));
	}
	race_free(&race);
	free(values);
}

static void closed_table(const Effort *effort)
{
	Table *table = table_new("closed", "closedness of edges in any order, ns per edge",
		"Floor: a loop that reads the same four arrays.");
	table_figures(table, "floor", "median", 3);
	table_figures(table, "function", "median", 3);
	table_figures(table, "function", "min", 3);
	table_figures(table, "", "ratio", 1);
	for (int precision = 0; precision < PRECISIONS; ++precision) {
		measure_closed(table, precision, ITEMS, effort->rounds);
		measure_closed(table, precision, MANY, effort->long_rounds);
	}
	table_print(table);
}

void distance_tables(const Effort *effort)
{
	distance_table(effort);
	closed_table(effort);
}

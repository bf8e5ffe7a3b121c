/* batches.c - many small rings, beside a loop that reads the same and writes as much.
 *
 * From memory: a million rings of 4 to 12 corners. The floor reads all vertices and offsets and
 * writes that many results, once by ordinary stores and once past the caches; it counts as floor
 * which of the two is faster here. In cache: 2000 rings of several sizes, the floor only reads.
 * Every ring stores its first vertex twice; figures are per stored vertex. */
#include "bench.h"

#include <stdlib.h>

enum { MANY = 1000000, FEW = 2000, TASKS = 3 };

typedef struct {
	const Width *width;
	const Rings *rings;
	int precision, outputs, stream;
	void *out;
} FloorJob;

static const struct { const char *name; BatchWhat what; int degree, outputs; } tasks[TASKS] = {
	{ "ew_area_rings", AREA, 0, 1 },
	{ "ew_centroid_rings", CENTROID, 1, 2 },
	{ "ew_moments_rings, degree 2", MOMENTS, 2, 6 },
};

/* ---- trials ---- */

static void run_double(const BatchJob *job)
{
	const Rings *r = job->rings;
	double *out = job->out;
	switch (job->what) {
	case AREA: ew_area_rings(r->x, r->y, r->offsets, r->rings, out); break;
	case CENTROID:
		ew_centroid_rings(r->x, r->y, r->offsets, r->rings, out, out + r->rings);
		break;
	case MOMENTS:
		ew_moments_rings(job->degree, r->x, r->y, r->offsets, r->rings, out);
		break;
	}
}

static void run_float(const BatchJob *job)
{
	const Rings *r = job->rings;
	float *out = job->out;
	switch (job->what) {
	case AREA: ew_area_ringsf(r->xf, r->yf, r->offsets, r->rings, out); break;
	case CENTROID:
		ew_centroid_ringsf(r->xf, r->yf, r->offsets, r->rings, out, out + r->rings);
		break;
	case MOMENTS:
		ew_moments_ringsf(job->degree, r->xf, r->yf, r->offsets, r->rings, out);
		break;
	}
}

void batch_run(const void *context, long repeat)
{
	const BatchJob *job = context;
	while (repeat-- > 0)
		if (job->precision == DOUBLE)
			run_double(job);
		else
			run_float(job);
}

static void floor_run(const void *context, long repeat)
{
	const FloorJob *job = context;
	const void *x = rings_x(job->rings, job->precision);
	const void *y = rings_y(job->rings, job->precision);
	while (repeat-- > 0)
		job->width->of[job->precision].fill(x, y, job->rings->offsets, job->rings->rings,
			job->out, (size_t)job->outputs, job->stream);
}

/* ---- one set of rings ---- */

/* What the floor does besides reading: nothing, or it stores, in both ways. */
enum { READ_ONLY, BOTH_WAYS };

/* Ratios to the floor that must hold, or NAN. */
typedef struct { double bar[TASKS]; } Bars;

static void put_row(Table *table, const Race *race, int first, int floors, double bar)
{
	const int ours = first + floors;
	const int second = floors > 1
		&& race_median(race, first + 1) < race_median(race, first);
	for (int k = 0; k < floors; ++k)
		table_put(table, race_median(race, first + k));
	table_put(table, race_median(race, ours));
	table_put(table, race_minimum(race, ours));
	table_put(table, race_ratio(race, ours, first + second));
	table_put(table, bar);
}

static void measure(Table *table, const char *set, const Rings *rings, int precision, int how,
	Bars bars, int rounds)
{
	const size_t size = precision == DOUBLE ? sizeof(double) : sizeof(float);
	const int floors = how == BOTH_WAYS ? 2 : 1;
	const double vertices = (double)rings->vertices;
	void *out = allocate(rings->rings * 6 * size);
	const ReadJob all = { NULL, precision, rings_x(rings, precision),
		rings_y(rings, precision), rings->vertices };
	const Width *width = width_fastest(all);
	FloorJob floor[TASKS][2];
	BatchJob job[TASKS];
	Race race = race_new(rounds);
	for (int i = 0; i < TASKS; ++i) {
		for (int k = 0; k < floors; ++k) {
			floor[i][k] = (FloorJob){ width, rings, precision,
				how == READ_ONLY ? 0 : tasks[i].outputs, k && width->streams, out };
			race_add(&race, floor_run, &floor[i][k], vertices);
		}
		job[i] = (BatchJob){ rings, precision, tasks[i].degree, tasks[i].what, out };
		race_add(&race, batch_run, &job[i], vertices);
	}
	race_run(&race);
	for (int i = 0; i < TASKS; ++i) {
		table_row(table, "%s%s, %s", tasks[i].name, precision == DOUBLE ? "" : " float",
			set);
		put_row(table, &race, i * (floors + 1), floors, bars.bar[i]);
	}
	race_free(&race);
	free(out);
}

static void add_function_columns(Table *table)
{
	table_figures(table, "function", "median", 3);
	table_figures(table, "function", "min", 3);
	table_figures(table, "", "ratio", 2);
	table_at_most(table);
}

static void from_memory(int rounds)
{
	const Bars required = { { 1.1, 1.15, 1.5 } };
	const Bars none = { { (double)NAN, (double)NAN, (double)NAN } };
	Rings rings = rings_make(MANY, 4, 12);
	Table *table = table_new("batches", "10^6 rings from memory, ns per stored vertex",
		"Floor: reads all input, writes as many results; the ratio is to the faster of two "
		"ways to store.");
	table_figures(table, "floor", "stores", 3);
	table_figures(table, "floor", "past caches", 3);
	add_function_columns(table);
	measure(table, "4-12", &rings, DOUBLE, BOTH_WAYS, required, rounds);
	measure(table, "4-12", &rings, FLOAT, BOTH_WAYS, none, rounds);
	table_print(table);
	rings_free(&rings);
}

static void in_cache(int rounds)
{
	/* Bars: the best prototype of each set, as a multiple of its own floor. */
	static const struct { const char *name; int fewest, most; Bars bars; } sets[] = {
		{ "4-12", 4, 12, { { 2.01, 2.57, 4.55 } } },
		{ "4", 4, 4, { { 1.04, 1.27, 1.97 } } },
		{ "8", 8, 8, { { 1.35, 1.74, 2.94 } } },
		{ "60-100", 60, 100, { { 1.47, 1.88, 3.76 } } },
	};
	const Bars none = { { (double)NAN, (double)NAN, (double)NAN } };
	Table *table = table_new("batches-cache", "2000 rings in cache, ns per stored vertex",
		"Corners per ring at the end of the name. Floor: reads all input. Bars: what "
		"prototypes reached.");
	table_figures(table, "floor", "read", 3);
	add_function_columns(table);
	for (int precision = 0; precision < PRECISIONS; ++precision)
		for (size_t i = 0; i < sizeof sets / sizeof *sets; ++i) {
			Rings rings = rings_make(FEW, sets[i].fewest, sets[i].most);
			measure(table, sets[i].name, &rings, precision, READ_ONLY,
				precision == DOUBLE ? sets[i].bars : none, rounds);
			rings_free(&rings);
		}
	table_print(table);
}

void section_batches(const Effort *effort)
{
	from_memory(effort->long_rounds);
	in_cache(effort->rounds);
}

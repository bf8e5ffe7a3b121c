/* streams.c - one ring that does not fit into any cache, beside a loop that only reads it.
 *
 * Floor and function take turns on the same arrays, so what a cache still holds of them from the
 * pass before helps both alike, and odd rounds go in reverse order. The floor reads with the width
 * of vector that turns out fastest here. */
#include "bench.h"

#include <stdlib.h>

enum { VERTICES = 10000000, AREA_ALONE = -1, DEEPEST = 4 };

typedef struct {
	int precision, degree;         /* AREA_ALONE: ew_area */
	const void *x, *y;             /* y NULL: x holds x, y, x, y, ... */
} StreamJob;

static void run_double(const StreamJob *job)
{
	static double out[EW_MOMENTS(DEEPEST)];
	if (job->degree == AREA_ALONE)
		out[0] = ew_area(job->x, job->y, VERTICES);
	else if (job->y)
		ew_moments(job->degree, job->x, job->y, VERTICES, out);
	else
		ew_moments_xy(job->degree, job->x, VERTICES, out);
}

static void run_float(const StreamJob *job)
{
	static float out[EW_MOMENTS(DEEPEST)];
	if (job->degree == AREA_ALONE)
		out[0] = ew_areaf(job->x, job->y, VERTICES);
	else if (job->y)
		ew_momentsf(job->degree, job->x, job->y, VERTICES, out);
	else
		ew_moments_xyf(job->degree, job->x, VERTICES, out);
}

static void stream_run(const void *context, long repeat)
{
	const StreamJob *job = context;
	while (repeat-- > 0)
		if (job->precision == DOUBLE)
			run_double(job);
		else
			run_float(job);
}

static void put_row(Table *table, const Race *race, int floor, const StreamJob *job)
{
	const double bytes = job->precision == DOUBLE ? 16 : 8;
	if (job->degree == AREA_ALONE)
		table_row(table, "ew_area%s", job->precision == DOUBLE ? "" : "f");
	else
		table_row(table, "ew_moments%s%s, degree %d", job->y ? "" : "_xy",
			job->precision == DOUBLE ? "" : "f", job->degree);
	table_put(table, race_median(race, floor));
	table_put(table, bytes / race_median(race, floor));
	table_put(table, race_median(race, floor + 1));
	table_put(table, race_minimum(race, floor + 1));
	table_put(table, race_ratio(race, floor + 1, floor));
	table_put(table, job->degree <= 2 ? 1.05 : (double)NAN);
}

static void measure(Table *table, int precision, const void *x, const void *y, int rounds)
{
	enum { FIRST = AREA_ALONE, JOBS = DEEPEST + 1 - FIRST };
	StreamJob job[JOBS];
	ReadJob floor = { NULL, precision, x, y, VERTICES };
	floor.width = width_fastest(floor);
	Race race = race_new(rounds);
	for (int i = 0; i < JOBS; ++i) {
		job[i] = (StreamJob){ precision, FIRST + i, x, y };
		if (!y && job[i].degree == AREA_ALONE)
			continue;
		race_add(&race, read_run, &floor, VERTICES);
		race_add(&race, stream_run, &job[i], VERTICES);
	}
	race_run(&race);
	for (int k = 0; k < race.count; k += 2)
		put_row(table, &race, k, race.trial[k + 1].context);
	race_free(&race);
}

void section_streams(const Effort *effort)
{
	Table *table = table_new("streams", "one ring of 10^7 vertices from memory, ns per vertex",
		"Floor: a loop that reads the same arrays, in turns with the function.");
	table_figures(table, "floor", "median", 3);
	table_figures(table, "floor", "GB/s", 1);
	table_figures(table, "function", "median", 3);
	table_figures(table, "function", "min", 3);
	table_figures(table, "", "ratio", 3);
	table_at_most(table);
	for (int precision = 0; precision < PRECISIONS; ++precision) {
		const size_t size = precision == DOUBLE ? sizeof(double) : sizeof(float);
		char *values = allocate(2 * VERTICES * size);
		points_make(precision, values, 2 * VERTICES);
		measure(table, precision, values, values + VERTICES * size, effort->long_rounds);
		measure(table, precision, values, NULL, effort->long_rounds);
		free(values);
	}
	table_print(table);
}

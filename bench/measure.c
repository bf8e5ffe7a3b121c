/* measure.c - trials in interleaved rounds.
 *
 * A shared machine is noisy and its clock rate drifts, so nothing is timed on its own: each round
 * runs every trial of a race once, odd rounds in reverse order, and what is compared stands next
 * to each other in the race. Figures are medians and minima over the rounds; a ratio is the median
 * of the ratios within each round. A sample repeats its trial until it is long enough for the
 * clock. One repetition before it that is not timed brings the data near, unless the trial is so
 * long that its data come from memory anyway. */
#define _POSIX_C_SOURCE 200809L
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { SAMPLE_NS = 20000, LONG_NS = 1000000, LINE = 64 };

const char *const precision_names[PRECISIONS] = { "double", "float" };

void *allocate(size_t bytes)
{
	void *memory = aligned_alloc(LINE, (bytes / LINE + 1) * LINE);
	if (!memory) {
		fprintf(stderr, "bench: out of memory\n");
		exit(1);
	}
	return memory;
}

static double now(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

Race race_new(int rounds)
{
	Race race = { NULL, 0, rounds };
	return race;
}

int race_add(Race *race, TrialRun *run, const void *context, double work)
{
	Trial *longer = realloc(race->trial, ((size_t)race->count + 1) * sizeof *longer);
	if (!longer) {
		fprintf(stderr, "bench: out of memory\n");
		exit(1);
	}
	race->trial = longer;
	longer[race->count] = (Trial){ run, context, work, 1, 0,
		allocate((size_t)race->rounds * sizeof(double)) };
	return race->count++;
}

static double sample(const Trial *trial)
{
	if (trial->warm)
		trial->run(trial->context, 1);
	double begin = now();
	trial->run(trial->context, trial->repeat);
	return now() - begin;
}

static void calibrate(Trial *trial)
{
	double ns;
	while (ns = sample(trial), ns < SAMPLE_NS)
		trial->repeat *= 2;
	trial->warm = ns < LONG_NS;
}

void race_run(Race *race)
{
	for (int i = 0; i < race->count; ++i)
		calibrate(&race->trial[i]);
	for (int round = 0; round < race->rounds; ++round)
		for (int k = 0; k < race->count; ++k) {
			Trial *trial = &race->trial[round % 2 ? race->count - 1 - k : k];
			trial->ns[round] = sample(trial) / ((double)trial->repeat * trial->work);
		}
}

static int ascending(const void *a, const void *b)
{
	double left = *(const double *)a, right = *(const double *)b;
	return (left > right) - (left < right);
}

static double median(double *value, int count)
{
	qsort(value, (size_t)count, sizeof *value, ascending);
	return count % 2 ? value[count / 2] : (value[count / 2 - 1] + value[count / 2]) / 2;
}

/* Median of the trial, divided by another one round by round unless `by` is negative. */
static double median_of(const Race *race, int trial, int by)
{
	double *value = allocate((size_t)race->rounds * sizeof *value);
	for (int round = 0; round < race->rounds; ++round)
		value[round] = race->trial[trial].ns[round]
			/ (by < 0 ? 1 : race->trial[by].ns[round]);
	double middle = median(value, race->rounds);
	free(value);
	return middle;
}

double race_median(const Race *race, int trial)
{
	return median_of(race, trial, -1);
}

double race_ratio(const Race *race, int trial, int by)
{
	return median_of(race, trial, by);
}

double race_minimum(const Race *race, int trial)
{
	const double *ns = race->trial[trial].ns;
	double least = ns[0];
	for (int round = 1; round < race->rounds; ++round)
		least = ns[round] < least ? ns[round] : least;
	return least;
}

void race_free(Race *race)
{
	for (int i = 0; i < race->count; ++i)
		free(race->trial[i].ns);
	free(race->trial);
}

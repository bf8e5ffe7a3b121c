/* contest.c - other libraries on the same polygons, in the same rounds.
 *
 * Before anything is timed the results must agree with ours: a race between different answers is
 * worth nothing. Geometry objects of the peers are prepared outside the timed part, as arrays of
 * coordinates are for us. */
#include "bench.h"
#include "peers.h"

#include <stdio.h>
#include <stdlib.h>

enum { CUBIC = EW_MOMENTS(3), OURS = 6 };
enum { AREA_D, AREA_F, CENTROID_D, MOMENTS_D, MOMENTS_F, SINGLE };     /* our trials */

#define PEER_NUMBER(name) name,
#define PEER_NAME(name) #name,
#define PEER_OBJECT(name) &peer_##name,
enum { PEERS(PEER_NUMBER) PEER_COUNT };
static const char *const peer_names[] = { PEERS(PEER_NAME) };
static const Peer *const peers[] = { PEERS(PEER_OBJECT) };

static const struct { const char *name; size_t rings; int fewest, most; } sets[] = {
	{ "2000 8-gons", 2000, 8, 8 }, { "2000 4-12", 2000, 4, 12 },
	{ "96 1024-gons", 96, 1024, 1024 }, { "one 1024-gon", 1, 1024, 1024 },
};
enum { SETS = (int)(sizeof sets / sizeof *sets), FIRST = 0, LAST = SETS - 1 };

static const int results[PEER_TASKS] = { 1, 2, CUBIC };        /* per ring */

/* A row of the table: a peer's task against one of our trials, and bars for the ratio. */
typedef struct {
	int peer, task, ours;
	const char *name;
	double bar, bar_one;           /* for 8-gons; for one 1024-gon */
} Match;

#define NO ((double)NAN)
static const Match matches[] = {
	{ GEOS, PEER_AREA, AREA_D, "GEOS area / ew_area_rings", 10, NO },
	{ GEOS, PEER_AREA, SINGLE, "GEOS area / ew_area", NO, NO },
	{ GEOS, PEER_CENTROID, CENTROID_D, "GEOS centroid / ew_centroid_rings", 60, NO },
	{ Boost, PEER_AREA, AREA_D, "Boost area / ew_area_rings", 2.5, NO },
	{ Boost, PEER_AREA, SINGLE, "Boost area / ew_area", NO, NO },
	{ Boost, PEER_CENTROID, CENTROID_D, "Boost centroid / ew_centroid_rings", 2.5, NO },
	{ CGAL, PEER_AREA, AREA_D, "CGAL area / ew_area_rings", 1.8, NO },
	{ CGAL, PEER_AREA, SINGLE, "CGAL area / ew_area", NO, 7 },
	{ OpenCV, PEER_AREA, AREA_D, "OpenCV contourArea / ew_area_rings", NO, NO },
	{ OpenCV, PEER_AREA, AREA_F, "OpenCV contourArea / ew_area_ringsf", NO, NO },
	{ OpenCV, PEER_MOMENTS, MOMENTS_D, "OpenCV moments / ew_moments_rings", 10, NO },
	{ OpenCV, PEER_MOMENTS, MOMENTS_F, "OpenCV moments / ew_moments_ringsf", 10, NO },
};
enum { MATCHES = (int)(sizeof matches / sizeof *matches) };

typedef struct { int peer, task; void *set; double *out; } PeerJob;

static void peer_run(const void *context, long repeat)
{
	const PeerJob *job = context;
	while (repeat-- > 0)
		peers[job->peer]->task[job->task](job->set, job->out);
}

static void single_run(const void *context, long repeat)
{
	const BatchJob *job = context;
	const Rings *r = job->rings;
	double *out = job->out;
	while (repeat-- > 0)
		for (size_t i = 0; i < r->rings; ++i)
			out[i] = ew_area(r->x + r->offsets[i], r->y + r->offsets[i],
				(size_t)(r->offsets[i + 1] - r->offsets[i]));
}

/* ---- agreement ---- */

/* Largest relative difference from the results of our function for many rings; NaN if there is
 * one. Ours has the two coordinates of centroids in two arrays. */
static double difference(size_t rings, int task, const double *ours, const double *theirs)
{
	const size_t count = (size_t)results[task];
	double worst = 0;
	for (size_t i = 0; i < rings; ++i)
		for (size_t k = 0; k < count; ++k) {
			double own = ours[task == PEER_CENTROID ? k * rings + i : i * count + k];
			double error = fabs(theirs[i * count + k] / own - 1);
			if (!(error <= worst) && !isnan(worst))
				worst = error;
		}
	return worst;
}

static double check_agreement(const PeerJob *job, const BatchJob *ours)
{
	static const char *const names[PEER_TASKS] = { "area", "centroid", "moments" };
	static const int same[PEER_TASKS] = { AREA_D, CENTROID_D, MOMENTS_D };
	batch_run(&ours[same[job->task]], 1);
	peer_run(job, 1);
	double error = difference(ours->rings->rings, job->task, ours->out, job->out);
	if (!(error <= 1e-9)) {
		fprintf(stderr, "bench: %s and edgewise differ by %.1e in the %s\n",
			peer_names[job->peer], error, names[job->task]);
		exit(1);
	}
	return error;
}

/* ---- one set of polygons ---- */

typedef struct {
	double ours[OURS], theirs[PEER_COUNT][PEER_TASKS], ratio[MATCHES], difference;
} Outcome;

static int add_peers(Race *race, const BatchJob *ours, PeerJob *job,
	int trial[PEER_COUNT][PEER_TASKS], double *worst)
{
	const Rings *r = ours->rings;
	int jobs = 0;
	for (int p = 0; p < PEER_COUNT; ++p) {
		if (!peers[p]->prepare)
			continue;
		void *set = peers[p]->prepare(r->x, r->y, r->offsets, r->rings);
		for (int task = 0; task < PEER_TASKS; ++task) {
			if (!peers[p]->task[task])
				continue;
			double *out = allocate(r->rings * (size_t)results[task] * sizeof *out);
			job[jobs] = (PeerJob){ p, task, set, out };
			*worst = fmax(*worst, check_agreement(&job[jobs], ours));
			trial[p][task] = race_add(race, peer_run, &job[jobs++],
				(double)r->vertices);
		}
	}
	return jobs;
}

static void release_peers(PeerJob *job, int jobs)
{
	for (int i = 0; i < jobs; ++i) {
		free(job[i].out);
		if (i + 1 == jobs || job[i + 1].set != job[i].set)
			peers[job[i].peer]->release(job[i].set);
	}
}

static void hold_contest(int which, Outcome *outcome, int rounds)
{
	Rings rings = rings_make(sets[which].rings, sets[which].fewest, sets[which].most);
	void *out = allocate(rings.rings * CUBIC * sizeof(double));
	const BatchJob ours[OURS] = {
		[AREA_D] = { &rings, DOUBLE, 0, AREA, out },
		[AREA_F] = { &rings, FLOAT, 0, AREA, out },
		[CENTROID_D] = { &rings, DOUBLE, 1, CENTROID, out },
		[MOMENTS_D] = { &rings, DOUBLE, 3, MOMENTS, out },
		[MOMENTS_F] = { &rings, FLOAT, 3, MOMENTS, out },
		[SINGLE] = { &rings, DOUBLE, 0, AREA, out },
	};
	PeerJob job[PEER_COUNT * PEER_TASKS];
	int trial[PEER_COUNT][PEER_TASKS] = { { 0 } };
	Race race = race_new(rounds);
	for (int i = 0; i < OURS; ++i)
		race_add(&race, i == SINGLE ? single_run : batch_run, &ours[i],
			(double)rings.vertices);
	outcome->difference = 0;
	int jobs = add_peers(&race, ours, job, trial, &outcome->difference);
	race_run(&race);
	for (int i = 0; i < OURS; ++i)
		outcome->ours[i] = race_median(&race, i);
	for (int i = 0; i < MATCHES; ++i) {
		int theirs = trial[matches[i].peer][matches[i].task];
		outcome->ratio[i] = theirs ? race_ratio(&race, theirs, matches[i].ours) : NO;
	}
	for (int i = 0; i < jobs; ++i)
		outcome->theirs[job[i].peer][job[i].task] = race_median(&race, OURS + i);
	release_peers(job, jobs);
	race_free(&race);
	free(out);
	rings_free(&rings);
}

static void print_times(const Outcome *outcome)
{
	static const char *const names[OURS] = { "ew_area_rings", "ew_area_ringsf",
		"ew_centroid_rings", "ew_moments_rings, degree 3", "ew_moments_ringsf, degree 3",
		"ew_area, ring by ring" };
	static const char *const tasks[PEER_TASKS] = { "area", "centroid", "moments, degree 3" };
	Table *table = table_new("contest-ns", "peers on the same polygons: ns per stored vertex",
		"");
	for (int s = 0; s < SETS; ++s)
		table_figures(table, "", sets[s].name, 3);
	for (int i = 0; i < OURS; ++i) {
		table_row(table, "%s", names[i]);
		for (int s = 0; s < SETS; ++s)
			table_put(table, outcome[s].ours[i]);
	}
	for (int p = 0; p < PEER_COUNT; ++p)
		for (int task = 0; task < PEER_TASKS; ++task) {
			if (!peers[p]->task[task])
				continue;
			table_row(table, "%s, %s", peer_names[p], tasks[task]);
			for (int s = 0; s < SETS; ++s)
				table_put(table, outcome[s].theirs[p][task]);
		}
	table_print(table);
}

static void print_ratios(const Outcome *outcome)
{
	Table *table = table_new("contest", "peers on the same polygons: how many times our time",
		"");
	for (int s = 0; s < SETS; ++s) {
		table_figures(table, sets[s].name, "ratio", 2);
		if (s == FIRST || s == LAST)
			table_at_least(table);
	}
	for (int i = 0; i < MATCHES; ++i) {
		if (!peers[matches[i].peer]->prepare)
			continue;
		table_row(table, "%s", matches[i].name);
		for (int s = 0; s < SETS; ++s) {
			table_put(table, outcome[s].ratio[i]);
			if (s == FIRST || s == LAST)
				table_put(table, s == FIRST ? matches[i].bar : matches[i].bar_one);
		}
	}
	table_print(table);
}

void section_contest(const Effort *effort)
{
	Outcome outcome[SETS];
	double worst = 0;
	int present = 0;
	for (int s = 0; s < SETS; ++s) {
		hold_contest(s, &outcome[s], effort->rounds);
		worst = fmax(worst, outcome[s].difference);
	}
	print_times(outcome);
	printf("\n");
	for (int p = 0; p < PEER_COUNT; ++p)
		if (peers[p]->prepare)
			++present;
		else
			printf("skip %s: not installed (make deps-bench)\n", peer_names[p]);
	if (!present)
		return;
	printf("All results of the peers agree with ours within %.1e, relative (allowed: 1e-9).\n",
		worst);
	print_ratios(outcome);
}

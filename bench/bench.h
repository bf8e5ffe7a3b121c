/* bench.h - what the files of the benchmark share, each section building on those above it.
 *
 *   measure   trials in interleaved rounds, medians, ratios round by round
 *   table     tables with bars, printed for people, kept for --json
 *   vectors   what this machine can do at most: multiply-adds, reads, writes, per vector width
 *   targets   the kernels of every target this CPU runs, and kernels as trials in L1
 *   polygons  the vertices and rings that are measured
 *   sections  one file per question; each prints its tables */
#ifndef BENCH_H
#define BENCH_H

#include "edgewise.h"
#include "edgewise_kernels.h"
#include "edgewise_runtime.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { DOUBLE, FLOAT, PRECISIONS };
extern const char *const precision_names[PRECISIONS];

/* ---- measure.c ---- */

typedef void TrialRun(const void *context, long repeat);

typedef struct {
	TrialRun *run;
	const void *context;
	double work;                   /* items of one repetition */
	long repeat;                   /* chosen so that one sample is long enough for the clock */
	int warm;                      /* once more before each sample, not timed */
	double *ns;                    /* per item, one value per round */
} Trial;

typedef struct { Trial *trial; int count, rounds; } Race;

void *allocate(size_t bytes);          /* aligned to a cache line; out of memory ends the program */
Race  race_new(int rounds);
int   race_add(Race *race, TrialRun *run, const void *context, double work);    /* its number */
void  race_run(Race *race);
double race_median(const Race *race, int trial);
double race_minimum(const Race *race, int trial);
double race_ratio(const Race *race, int trial, int by);  /* median of trial / by of each round */
void  race_free(Race *race);

/* ---- table.c ---- */

typedef struct Table Table;

/* Title and note are printed; the key names the table in JSON. */
Table *table_new(const char *key, const char *title, const char *note);
void table_figures(Table *table, const char *group, const char *name, int decimals);
void table_at_most(Table *table);      /* a bar for the figure before it */
void table_at_least(Table *table);
void table_row(Table *table, const char *format, ...) __attribute__((format(printf, 2, 3)));
void table_put(Table *table, double value);   /* the next cell; NAN: nothing to show */
void table_print(const Table *table);
void tables_summary(void);             /* how many bars were met */
int  tables_json(const char *file, int quick);   /* 0 if the file could not be written */

/* ---- vectors.c ---- */

typedef struct {
	TrialRun *peak;                /* independent multiply-adds; PEAK_WORK of them */
	/* Sum of two arrays of n numbers, or of one of 2n if y is NULL. */
	void (*read)(const void *x, const void *y, size_t n);
	/* The same over rings, and `outputs` numbers written per ring, past the caches if asked. */
	void (*fill)(const void *x, const void *y, const int32_t *offsets, size_t rings,
		void *out, size_t outputs, int stream);
} Limits;

typedef struct {
	const char *name;
	unsigned target;               /* the CPU has this width if it runs this target */
	int vector;                    /* more than one lane */
	int streams;                   /* has stores that go past the caches */
	Limits of[PRECISIONS];
} Width;

enum { PEAK_WORK = 1200 };

typedef struct {
	const Width *width;
	int precision;
	const void *x, *y;             /* y NULL: one array with twice as many numbers */
	size_t n;
} ReadJob;

const Width *width_of(unsigned target);        /* whose peak a target is held against */
TrialRun read_run;                             /* of a ReadJob */
const Width *width_fastest(ReadJob job);       /* the vectors that read these arrays fastest */

/* ---- targets.c ---- */

typedef struct {
	ew_ring_run *run;
	ew_ring_runf *runf;
	int f, a;                      /* operations per item on the FMA pipe and the adder */
} Kernel;

typedef struct {
	unsigned bit;
	const char *name;
	int lanes[PRECISIONS];         /* of a register */
	const Kernel *kernels[PRECISIONS];
	const Kernel *matrix, *expanded;          /* the same in coefficient-matrix form, double; by its ids */
} Target;

enum { ITEMS = 1024, MAX_TARGETS = 8 };
enum { DEGREE_12 = EW_RINGS_COUNT, KERNELS };          /* one more than the library has */

int targets_here(const Target *here[MAX_TARGETS]);     /* those this CPU runs; how many */
const char *ring_name(int id);                         /* "MOMENTS_2" */

typedef struct { const Kernel *kernel; size_t step; } KernelJob;

KernelJob kernel_job(const Target *target, int precision, int id);
TrialRun kernel_run;                   /* of a KernelJob; ITEMS items in L1 */

/* ---- polygons.c ---- */

typedef struct {
	size_t rings, vertices;        /* stored vertices: each ring repeats its first one */
	int32_t *offsets;
	double *x, *y;                 /* the same numbers as xf, yf */
	float *xf, *yf;
} Rings;

void  points_make(int precision, void *values, size_t n);    /* random in [0, 1) */
Rings rings_make(size_t rings, int fewest, int most);
void  rings_free(Rings *rings);
const void *rings_x(const Rings *rings, int precision);
const void *rings_y(const Rings *rings, int precision);

/* ---- sections ---- */

typedef struct { int rounds, long_rounds; } Effort;    /* in cache; from memory */

typedef enum { AREA, CENTROID, MOMENTS } BatchWhat;
typedef struct {
	const Rings *rings;
	int precision, degree;
	BatchWhat what;
	void *out;
} BatchJob;

TrialRun batch_run;                    /* of a BatchJob: the public function for many rings */

void section_machine(const Effort *effort);    /* kernels.c */
void section_kernels(const Effort *effort);
double kernel_slots(int target, int id);       /* double, as measured by section_kernels, or NAN */
void section_order(const Effort *effort);
void section_schemes(const Effort *effort);
void section_trust(const Effort *effort);
void section_streams(const Effort *effort);
void section_batches(const Effort *effort);
void section_contest(const Effort *effort);
void section_curves(const Effort *effort);     /* curves.c, and these two: */
void paths_tables(const Effort *effort);       /* paths.c */
void distance_tables(const Effort *effort);    /* distance.c */
void section_raster(const Effort *effort);     /* raster.c, and what raster.h names */

/* ---- chart.c ---- */

int  chart_write(const char *file);            /* 0 if the file could not be written */
int  raster_chart_write(const char *file);     /* likewise; raster_chart.c */

#endif

/* bench.c - every ring kernel on every target, beside the multiply-add
 * rate of this machine, in one run.
 *
 * A slot is the time of one scalar fused multiply-add at the rate measured here and now,
 * so slots per edge hardly depend on the machine: a kernel with f operations on the FMA pipe cannot
 * take fewer than f slots. All kernels run on the same vertices in the nearest cache. Rounds are
 * interleaved: each round runs everything once. Shown is the median over the rounds, and for slots
 * the median of the ratio to the FMA loop of the same round, because a shared machine is noisy.
 *
 * Usage: bench [ROUNDS] */
#define _POSIX_C_SOURCE 200809L
#include "edgewise.h"
#include "edgewise_kernels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ITEMS = 1024, MAX_ROUNDS = 101, LANES = 16, TARGETS = 5 };

typedef struct {
	int f, a;                      /* operations per item on the FMA pipe and the adder */
	ew_ring_run *run;
	ew_ring_runf *runf;
	double ns[MAX_ROUNDS], slots[MAX_ROUNDS];
} Kernel;

typedef struct { const char *name; Kernel kernel[TARGETS]; } Row;
enum { PORTABLE, FUSED, AVX2, AVX512, NEON };

static Row doubles[EW_RINGS_COUNT], floats[EW_RINGS_COUNT];
static double x[ITEMS + 2], y[ITEMS + 2], sum[EW_MAX_ACCUMULATORS * LANES];
static float xf[ITEMS + 2], yf[ITEMS + 2], sumf[EW_MAX_ACCUMULATORS * LANES];

static void list_kernels(void)
{
#define NAME(id, family, m, n, accumulators, outputs, k, r) \
	doubles[id].name = floats[id].name = #id;
	EW_RINGS(NAME)
#define PUT(table, target, member, id, symbol, fma, add) \
	table[id].kernel[target].f = fma; \
	table[id].kernel[target].a = add; \
	table[id].kernel[target].member = symbol;
#define PORTABLE_D(id, symbol, f, a) PUT(doubles, PORTABLE, run, id, symbol, f, a)
#define PORTABLE_F(id, symbol, f, a) PUT(floats, PORTABLE, runf, id, symbol, f, a)
	EW_RINGS_PORTABLE_DOUBLE(PORTABLE_D)
	EW_RINGS_PORTABLE_FLOAT(PORTABLE_F)
#if EW_BUILD_FMA
#define FUSED_D(id, symbol, f, a) PUT(doubles, FUSED, run, id, symbol, f, a)
#define FUSED_F(id, symbol, f, a) PUT(floats, FUSED, runf, id, symbol, f, a)
	if (ew_targets() & EW_FMA) {
		EW_RINGS_FMA_DOUBLE(FUSED_D)
		EW_RINGS_FMA_FLOAT(FUSED_F)
	}
#endif
#if EW_BUILD_AVX2
#define AVX2_D(id, symbol, f, a) PUT(doubles, AVX2, run, id, symbol, f, a)
#define AVX2_F(id, symbol, f, a) PUT(floats, AVX2, runf, id, symbol, f, a)
	if (ew_targets() & EW_AVX2) {
		EW_RINGS_AVX2_DOUBLE(AVX2_D)
		EW_RINGS_AVX2_FLOAT(AVX2_F)
	}
#endif
#if EW_BUILD_AVX512
#define AVX512_D(id, symbol, f, a) PUT(doubles, AVX512, run, id, symbol, f, a)
#define AVX512_F(id, symbol, f, a) PUT(floats, AVX512, runf, id, symbol, f, a)
	if (ew_targets() & EW_AVX512) {
		EW_RINGS_AVX512_DOUBLE(AVX512_D)
		EW_RINGS_AVX512_FLOAT(AVX512_F)
	}
#endif
#if EW_BUILD_NEON
#define NEON_D(id, symbol, f, a) PUT(doubles, NEON, run, id, symbol, f, a)
#define NEON_F(id, symbol, f, a) PUT(floats, NEON, runf, id, symbol, f, a)
	if (ew_targets() & EW_NEON) {
		EW_RINGS_NEON_DOUBLE(NEON_D)
		EW_RINGS_NEON_FLOAT(NEON_F)
	}
#endif
}

static double now(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

/* ns per scalar fused multiply-add: independent chains, enough to fill two pipes of latency 5. */
#if EW_BUILD_FMA
EW_ATTRIBUTE_FMA static double fma_ns(void)
{
	enum { REPEAT = 4000 };
	const volatile double start = 1.0;
	const double factor = 0.999 * start, add = 0.001 * start;
	double c0 = start, c1 = c0 + 1, c2 = c0 + 2, c3 = c0 + 3, c4 = c0 + 4, c5 = c0 + 5;
	double c6 = c0 + 6, c7 = c0 + 7, c8 = c0 + 8, c9 = c0 + 9, c10 = c0 + 10, c11 = c0 + 11;
	double begin = now();
	for (int i = 0; i < REPEAT; ++i) {
		c0 = fma(c0, factor, add); c1 = fma(c1, factor, add); c2 = fma(c2, factor, add);
		c3 = fma(c3, factor, add); c4 = fma(c4, factor, add); c5 = fma(c5, factor, add);
		c6 = fma(c6, factor, add); c7 = fma(c7, factor, add); c8 = fma(c8, factor, add);
		c9 = fma(c9, factor, add); c10 = fma(c10, factor, add); c11 = fma(c11, factor, add);
	}
	double time = now() - begin;
	volatile double sink = c0 + c1 + c2 + c3 + c4 + c5 + c6 + c7 + c8 + c9 + c10 + c11;
	(void)sink;
	return time / (12.0 * REPEAT);
}
#else
static double fma_ns(void)
{
	return (double)NAN;
}
#endif

static double time_kernel(const Kernel *kernel)
{
	enum { REPEAT = 8 };
	double begin = now();
	for (int i = 0; i < REPEAT; ++i) {
		if (kernel->run)
			kernel->run(x, y, 0.5, ITEMS, sum);
		else
			kernel->runf(xf, yf, 0.5f, ITEMS, sumf);
	}
	return (now() - begin) / (REPEAT * (double)ITEMS);
}

static void run_round(Row *rows, int round)
{
	for (int id = 0; id < EW_RINGS_COUNT; ++id)
		for (int t = 0; t < TARGETS; ++t) {
			Kernel *kernel = &rows[id].kernel[t];
			if (!kernel->run && !kernel->runf)
				continue;
			double slot = fma_ns();
			kernel->ns[round] = time_kernel(kernel);
			kernel->slots[round] = kernel->ns[round] / slot;
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
	return value[count / 2];
}

static void print_table(const char *title, Row *rows, int rounds)
{
	static const char *const names[TARGETS] = { "portable", "fma", "avx2", "avx512", "neon" };
	printf("\n%-12s operations  slots of fma  %% of FMA rate   ns/edge:", title);
	for (int t = 0; t < TARGETS; ++t)
		printf(" %9s", names[t]);
	for (int id = 0; id < EW_RINGS_COUNT; ++id) {
		Kernel *kernel = rows[id].kernel;
		const char *name = rows[id].name + strlen("EW_RING_");
		double slots = median(kernel[FUSED].slots, rounds);
		printf("\n%-12s %4d + %-3d  %12.1f  %12.0f %%           ", name, kernel[FUSED].f,
			kernel[FUSED].a, slots, 100 * kernel[FUSED].f / slots);
		for (int t = 0; t < TARGETS; ++t)
			if (kernel[t].run || kernel[t].runf)
				printf(" %9.3f", median(kernel[t].ns, rounds));
			else
				printf(" %9s", "-");
	}
	printf("\n");
}

static void fill_vertices(void)
{
	unsigned long long state = 1;
	for (int i = 0; i < ITEMS + 2; ++i) {
		state = state * 6364136223846793005u + 1442695040888963407u;
		x[i] = (double)(state >> 40) / 16777216.0;
		state = state * 6364136223846793005u + 1442695040888963407u;
		y[i] = (double)(state >> 40) / 16777216.0;
		xf[i] = (float)x[i];
		yf[i] = (float)y[i];
	}
}

int main(int argc, char **argv)
{
	int rounds = argc > 1 ? atoi(argv[1]) : 21;
	static double slot[MAX_ROUNDS];
	if (rounds < 1 || rounds > MAX_ROUNDS) {
		fprintf(stderr, "usage: bench [ROUNDS], 1 to %d\n", MAX_ROUNDS);
		return 2;
	}
	list_kernels();
	fill_vertices();
	for (int round = 0; round < rounds; ++round) {
		slot[round] = fma_ns();
		run_round(doubles, round);
		run_round(floats, round);
	}
	printf("edgewise %s; %d vertices in cache, medians of %d interleaved rounds\n",
		ew_version(), ITEMS, rounds);
	printf("scalar multiply-add: %.2f per ns\n", 1 / median(slot, rounds));
	print_table("double", doubles, rounds);
	print_table("float", floats, rounds);
	return 0;
}

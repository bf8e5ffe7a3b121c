/* hash.c - prints one hash of the bits of many results per target, and one for the single edges.
 *
 * tests/matrix.sh compares them between compilers, language standards and levels of optimisation:
 * a contracted a * b + c, a reassociated sum or a literal read wrongly changes them. Inputs come
 * from an integer generator, so no rounding takes part before the library; all are finite, since
 * the sign of a NaN is nobody's promise. This file is C99 and C++17 alike.
 */
#include "edgewise.h"
#include "edgewise_kernels.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define FNV_BASIS 0xcbf29ce484222325u
#define FNV_PRIME 0x100000001b3u

enum { MOST = 2100, MOMENTS = EW_MOMENTS(EW_MAX_DEGREE), KINDS = 3 };

static const size_t sizes[] = { 0, 2, 3, 4, 7, 8, 9, 16, 17, 40, 257, 1040, MOST };

static double x[MOST], y[MOST], xy[2 * MOST];
static float xf[MOST], yf[MOST], xyf[2 * MOST];
static uint64_t hash, state;

static void add(const void *data, size_t size)
{
	const unsigned char *byte = (const unsigned char *)data;
	for (size_t i = 0; i < size; i++)
		hash = (hash ^ byte[i]) * FNV_PRIME;
}

/* Multiples of 2^-23 in [-1,1) for kind 0, of full width for kind 1,
 * integers in -8..8 for kind 2. */
static double coordinate(int kind)
{
	state = state * 6364136223846793005u + 1442695040888963407u;
	const uint64_t bits = state >> 11;
	if (kind == 0)
		return (double)(bits >> 29) * 0x1p-23 - 1;
	return kind == 1 ? (double)bits * 0x1p-51 : (double)(bits % 17) - 8;
}

static void fill(size_t n, int kind)
{
	for (size_t i = 0; i < n; i++) {
		xy[2 * i] = x[i] = coordinate(kind);
		xy[2 * i + 1] = y[i] = coordinate(kind);
		xyf[2 * i] = xf[i] = (float)x[i];
		xyf[2 * i + 1] = yf[i] = (float)y[i];
	}
}

/* All functions of one precision, for a ring of n vertices; central moments want an area. */
#define RINGS(REAL, f) \
static void add_rings##f(size_t n) \
{ \
	REAL out[MOMENTS], moved[MOMENTS], c[2], one; \
	for (int degree = 0; degree <= EW_MAX_DEGREE; degree++) { \
		const size_t size = (size_t)EW_MOMENTS(degree) * sizeof *out; \
		ew_moments##f(degree, x##f, y##f, n, out); \
		add(out, size); \
		ew_translate_moments##f(degree, out, (REAL)0.75, (REAL)-1.3, moved); \
		add(moved, size); \
		ew_moments_about##f(degree, x##f, y##f, n, (REAL)0.1, (REAL)0.7, out); \
		add(out, size); \
		ew_moments_xy##f(degree, xy##f, n, out); \
		add(out, size); \
		if (n > 2 && ew_central_moments##f(degree, x##f, y##f, n, c, out) == EW_OK) \
			add(out, size); \
		for (int k = 0; k <= degree; k++) { \
			one = ew_moment##f(degree - k, k, x##f, y##f, n); \
			add(&one, sizeof one); \
		} \
	} \
	one = ew_area##f(x##f, y##f, n); \
	add(&one, sizeof one); \
	if (n > 2 && ew_centroid##f(x##f, y##f, n, c) == EW_OK) \
		add(c, sizeof c); \
}

RINGS(double, )
RINGS(float, f)

static void add_edges(void)
{
	double value;
	float valuef;
	for (size_t i = 0; i + 1 < MOST; i++) {
#define EDGE(m, n, symbol, k) \
		value = symbol(x[i], y[i], x[i + 1], y[i + 1]); \
		add(&value, sizeof value);
		EW_LINES_DOUBLE(EDGE)
#undef EDGE
#define EDGE(m, n, symbol, k) \
		valuef = symbol(xf[i], yf[i], xf[i + 1], yf[i + 1]); \
		add(&valuef, sizeof valuef);
		EW_LINES_FLOAT(EDGE)
#undef EDGE
	}
}

static void print_hash(const char *name)
{
	printf("%s %08lx%08lx\n", name, (unsigned long)(hash >> 32),
		(unsigned long)(hash & 0xffffffffu));
}

int main(void)
{
	for (unsigned target = 1; target && target <= ew_targets(); target *= 2) {
		if (ew_use_target(target) != EW_OK)
			continue;
		hash = FNV_BASIS;
		state = 1;
		for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
			for (int kind = 0; kind < KINDS; kind++) {
				fill(sizes[i], kind);
				add_rings(sizes[i]);
				add_ringsf(sizes[i]);
			}
		print_hash(ew_target_name(target));
	}
	hash = FNV_BASIS;
	for (int kind = 0; kind < KINDS; kind++) {
		fill(MOST, kind);
		add_edges();
	}
	print_hash("edges");
	return 0;
}

/* edgewise_rings.c - integrals over one ring: the driver in edgewise_rings_template.h,
 * once per precision.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#include "edgewise_runtime.h"

#include <math.h>

typedef struct { int window, turns, accumulators, outputs; ew_ring_finish *finish; } ew_ring_shape;

#define EW_SHAPE(id, window, turns, accumulators, outputs, finish) \
	{ window, turns, accumulators, outputs, finish },
static const ew_ring_shape ew_ring_shapes[] = { EW_RINGS_SHAPES(EW_SHAPE) };
#undef EW_SHAPE

#ifdef EW_HAS_MONOMIALS
#define EW_CASE(m, n, id) case (m) * 64 + (n): return id;
static int ew_ring_of_monomial(int m, int n)
{
	if (m < 0 || n < 0 || m > 32 || n > 32)
		return -1;
	switch (m * 64 + n) {
	EW_MONOMIALS(EW_CASE)
	default:
		return -1;
	}
}
#undef EW_CASE
#endif

#ifdef EW_MAX_DEGREE
/* a_mn <- sum C(m,i) C(n,j) dx^(m-i) dy^(n-j) a_ij, in place:
 * repeated a_m += dx a_(m-1), then the same in y. */
static void ew_ring_translate(int degree, double dx, double dy, double *a)
{
	for (int n = 0; n < degree; ++n)
		for (int first = 1; first <= degree - n; ++first)
			for (int m = degree - n; m >= first; --m)
				a[EW_INDEX(m, n)] += dx * a[EW_INDEX(m - 1, n)];
	for (int m = 0; m < degree; ++m)
		for (int first = 1; first <= degree - m; ++first)
			for (int n = degree - m; n >= first; --n)
				a[EW_INDEX(m, n)] += dy * a[EW_INDEX(m, n - 1)];
}
#endif

#ifdef EW_HAS_DOUBLE
#define EW_REAL double
#define EW_NAME(stem) ew_##stem
#define EW_LOCAL(stem) ew_ring_##stem
#define EW_RUN ew_ring_run
#define EW_WIDTH EW_LANES
#define EW_IS_FLOAT 0
#define EW_SAFE 1e180
#define EW_LIST_PORTABLE EW_RINGS_PORTABLE_DOUBLE
#define EW_LIST_FMA EW_RINGS_FMA_DOUBLE
#define EW_LIST_AVX2 EW_RINGS_AVX2_DOUBLE
#define EW_LIST_AVX512 EW_RINGS_AVX512_DOUBLE
#define EW_LIST_NEON EW_RINGS_NEON_DOUBLE
#define EW_LIST_POLYNOMIALS EW_POLYNOMIALS_DOUBLE
#include "edgewise_rings_template.h"
#endif

#ifdef EW_HAS_FLOAT
#define EW_REAL float
#define EW_NAME(stem) ew_##stem##f
#define EW_LOCAL(stem) ew_ring_##stem##f
#define EW_RUN ew_ring_runf
#define EW_WIDTH EW_LANES_FLOAT
#define EW_IS_FLOAT 1
#define EW_SAFE 1e18
#define EW_LIST_PORTABLE EW_RINGS_PORTABLE_FLOAT
#define EW_LIST_FMA EW_RINGS_FMA_FLOAT
#define EW_LIST_AVX2 EW_RINGS_AVX2_FLOAT
#define EW_LIST_AVX512 EW_RINGS_AVX512_FLOAT
#define EW_LIST_NEON EW_RINGS_NEON_FLOAT
#define EW_LIST_POLYNOMIALS EW_POLYNOMIALS_FLOAT
#include "edgewise_rings_template.h"
#endif

/* edgewise_rings.c - integrals over one ring: the driver in edgewise_rings_template.h,
 * once per precision.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#include "edgewise_runtime.h"

#include <math.h>
#include <string.h>

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

#ifdef EW_MAX_CURVE_DEGREE
/* What runs over edges of a kind one by one, for the moments to a degree. */
static int ew_ring_kind(int kind, int degree)
{
	static const short line[] = { EW_IDS_LINE };
#ifdef EW_HAS_QUADS
	static const short quad[] = { EW_IDS_QUAD };
#else
	static const short *const quad = NULL;
#endif
#ifdef EW_HAS_CONICS
	static const short conic[] = { EW_IDS_CONIC };
#else
	static const short *const conic = NULL;
#endif
#ifdef EW_HAS_CUBICS
	static const short cubic[] = { EW_IDS_CUBIC };
#else
	static const short *const cubic = NULL;
#endif
	const short *const ids[EW_KINDS] = { line, quad, conic, cubic };
	return ids[kind][degree];
}
#endif

#ifdef EW_MAX_CURVE_DEGREE
/* By verb: the kind of its edge. */
static const int ew_path_kinds[] = {
	0, EW_KIND_LINE, EW_KIND_QUAD, EW_KIND_CONIC, EW_KIND_CUBIC, 0
};

static int ew_path_has(int verb)
{
#ifndef EW_HAS_QUADS
	if (verb == EW_QUAD)
		return 0;
#endif
#ifndef EW_HAS_CONICS
	if (verb == EW_CONIC)
		return 0;
#endif
#ifndef EW_HAS_CUBICS
	if (verb == EW_CUBIC)
		return 0;
#endif
	return verb <= EW_CLOSE;
}
#endif

#ifdef EW_HAS_DISTANCE
static int ew_ring_of_radius(int k)
{
	switch (k) {
	case -1: return EW_RING_RADIUS_INVERSE;
	case 1:  return EW_RING_RADIUS_1;
	case 3:  return EW_RING_RADIUS_3;
	case 5:  return EW_RING_RADIUS_5;
	}
	return -1;
}
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

/* The scalar target that gives the bits of this one, if it was asked for. */
static unsigned ew_ring_scalar(unsigned used)
{
	if (used & ((unsigned)EW_PORTABLE | EW_WASM128))   /* nothing is fused */
		return EW_PORTABLE;
	return EW_BUILD_FMA ? (unsigned)EW_FMA : used;
}

#ifdef EW_MAX_DEGREE
/* What finishes the moments of `count` rings side by side. */
static ew_ring_finish *ew_ring_finish_columns(unsigned used, int degree, size_t *count)
{
#define EW_ROW(id, finish) finish,
#define EW_TABLE(TARGET, target, doubles) \
	static ew_ring_finish *const target[] = { EW_FINISHES_##TARGET(EW_ROW) };
#define EW_CASE(TARGET, target, doubles) \
	case EW_##TARGET: *count = doubles; return target[degree];
	EW_TARGETS(EW_TABLE)
	switch (used) {
	EW_TARGETS(EW_CASE)
	default: return NULL;          /* no such target is ever in use */
	}
#undef EW_ROW
#undef EW_TABLE
#undef EW_CASE
}
#endif

#ifdef EW_HAS_DOUBLE
#define EW_IS_FLOAT 0
#include "edgewise_precision.h"
#include "edgewise_rings_template.h"
#include "edgewise_edges_template.h"
#include "edgewise_windows_template.h"
#ifdef EW_HAS_CLOSURE
#include "edgewise_closure_template.h"
#endif
#ifdef EW_MAX_DEGREE
#include "edgewise_trust_template.h"
#include "edgewise_batches_template.h"
#endif
#undef EW_IS_FLOAT
#endif

#ifdef EW_HAS_FLOAT
#define EW_IS_FLOAT 1
#include "edgewise_precision.h"
#include "edgewise_rings_template.h"
#include "edgewise_edges_template.h"
#include "edgewise_windows_template.h"
#ifdef EW_HAS_CLOSURE
#include "edgewise_closure_template.h"
#endif
#ifdef EW_MAX_DEGREE
#include "edgewise_trust_template.h"
#include "edgewise_batches_template.h"
#endif
#undef EW_IS_FLOAT
#endif

#if defined(EW_HAS_FILTERS) && defined(EW_HAS_DOUBLE)
ew_ring_run *ew_ring_kernel_of(int id, unsigned used)
{
	return ew_ring_kernel(id, used);
}
#endif

/* edgewise_runtime.h - what the files of the runtime share; not for users.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#ifndef EDGEWISE_RUNTIME_H
#define EDGEWISE_RUNTIME_H

#include "edgewise.h"
#include "edgewise_kernels.h"

enum {
	EW_LANES = 8,        /* virtual lanes of the definition, double */
	EW_LANES_FLOAT = 16,
	EW_BLOCK = 1024,     /* items between two flushes of float lanes to double, by definition */
	EW_SHORT = 24,       /* rings of fewer vertices run in one lane, by definition */
	EW_EDGES = 64,       /* edges of a kind that are gathered at a time; by definition, in float */
	EW_STAGE = 256,      /* vertices moved or gathered at a time; not part of the definition */
	EW_TILE = EW_SHORT + 4,      /* room for the columns of rings side by side */
	EW_SIDES = 3,                /* degrees from 0 that are summed up in registers */
	EW_ROW = 64,                 /* rings that are summed up so before results are stored */
	EW_SIDE_SUMS = 6,            /* accumulators and results of the last of these degrees */
	EW_PIECES = 64,              /* of edges, deposited at a time */
	EW_DEPOSIT_SIZE = 8          /* pixels per axis of a filter that has deposits */
};

/* Kinds of edges, in the order in which their sums are added. */
enum { EW_KIND_LINE, EW_KIND_QUAD, EW_KIND_CONIC, EW_KIND_CUBIC, EW_KINDS };
#define EW_SHARP 0x1p40                /* weight from which a conic is its control polygon */

#define EW_SLACK (1 + 0x1p-48)         /* more than a few roundings of double */

/* What a target can do with coordinates by vectors (edgewise_columns.c).
 *
 * move: to[i] = from[i * stride] - origin, stride 1 or 2.
 * clear: to[i] = 0; count is a multiple of the number of virtual lanes.
 * widen: to[i] = from[i]; likewise; 0 if one of them is not finite.
 * divide: to[i] = a[i] / b[i] + c[i]; likewise.
 * gather: tile_x[c * width + l] is x of vertex c of the ring of lane l, and its first one again for
 * c >= length[l]. Columns 0 .. longest + 1 are written, up to EW_TILE may be; vertices from
 * start[l] to 3 places past `longest` may be read. NULL for scalar targets, whose width is 1.
 * side[degree]: sum[accumulator * EW_ROW + ring] of the kernel for the moments to that degree, over
 * groups of `width` rings side by side whose columns never leave the registers; NULL where there is
 * none. Returns the number of rings done: it ends before a group that is not whole, or for which
 * it would have to read past the last vertex. `not_finite` is set if a sum is not, for whatever
 * reason: that of a ring that does not fit is NaN.
 * centroid: the same of degree 1, about the first vertex of each ring; that is added behind. */
#define EW_COLUMNS_TYPE(f, real) \
typedef struct {                       /* short rings side by side */ \
	size_t start[EW_LANES_FLOAT], longest; \
	real length[EW_LANES_FLOAT];   /* 0: no ring, or one that does not fit */ \
} ew_ring_lanes##f; \
typedef size_t ew_ring_side##f(const real *x, const real *y, const int32_t *offsets, \
	size_t rings, size_t vertices, double *sum, int *not_finite); \
typedef struct { \
	size_t width; \
	void (*move)(const real *from, size_t stride, real origin, size_t count, real *to); \
	void (*clear)(real *to, size_t count); \
	int (*widen)(const real *from, size_t count, double *to); \
	void (*divide)(const double *a, const double *b, const double *c, size_t count, \
		double *to); \
	void (*gather)(const real *x, const real *y, const ew_ring_lanes##f *lanes, \
		real *tile_x, real *tile_y); \
	ew_ring_side##f *side[EW_SIDES], *centroid; \
} ew_ring_columns##f;
EW_COLUMNS_TYPE(, double)
EW_COLUMNS_TYPE(f, float)
#undef EW_COLUMNS_TYPE

/* EW_ALIGNED: to a cache line, which is also the widest register. */
#if defined(__GNUC__) || defined(__clang__)
#define EW_ALIGNED __attribute__((aligned(64)))
#define EW_INLINE __attribute__((always_inline)) static inline
#elif defined(_MSC_VER)
#define EW_ALIGNED __declspec(align(64))
#define EW_INLINE static __forceinline
#else
#define EW_ALIGNED
#define EW_INLINE static inline
#endif

#ifdef EW_HAS_FILTERS
/* Scratch of images, the only memory that is allocated. */
#ifndef EW_MALLOC
#include <stdlib.h>
#define EW_MALLOC(size) malloc(size)
#define EW_FREE(pointer) free(pointer)
#endif

#ifdef EW_HAS_DOUBLE
/* An image by a filter whose knots are not a pixel apart (edgewise_raster_general.c). */
typedef struct {
	const ew_filter *filter;
	double *sum;
	int width, height;
	ew_ring_run *run;
} ew_raster_general;
#endif
#endif

#if defined(EW_MAX_CURVE_DEGREE) || defined(EW_HAS_FILTERS)
/* Points that a verb of a path takes. */
EW_INLINE size_t ew_path_points(int verb)
{
	return verb == EW_CLOSE ? 0 : verb <= EW_LINE ? 1 : verb == EW_CUBIC ? 3 : 2;
}
#endif

#if defined(EW_MAX_DEGREE) || defined(EW_HAS_FILTERS)
/* Is one negative, or less than the one before? */
EW_INLINE int ew_ring_bad_offsets(const int32_t *offsets, size_t rings)
{
	uint32_t start = rings ? (uint32_t)offsets[0] : 0, signs = start;
	for (size_t i = 0; i < rings; ++i) {
		const uint32_t end = (uint32_t)offsets[i + 1];
		signs |= end | (end - start);
		start = end;
	}
	return signs >> 31 != 0;
}
#endif

#ifdef __cplusplus
extern "C" {
#endif

#if defined(EW_HAS_FILTERS) && defined(EW_HAS_DOUBLE)
int ew_raster_general_begin(ew_raster_general *image, const ew_filter *filter, int width,
	int height);
void ew_raster_general_edge(const ew_raster_general *image, double x0, double y0, double x1,
	double y1);
void ew_raster_general_end(ew_raster_general *image, float *pixels, ptrdiff_t row_stride);
ew_ring_run *ew_ring_kernel_of(int id, unsigned used);
#endif
unsigned ew_cpu_target(void);  /* the forced target, or the best one: one bit */
const ew_ring_columns *ew_ring_by_columns(unsigned target);
const ew_ring_columnsf *ew_ring_by_columnsf(unsigned target);
void ew_ring_fit(const double *x, const double *y, const int32_t *offsets, size_t rings,
	size_t width, ew_ring_lanes *lanes);
void ew_ring_fitf(const float *x, const float *y, const int32_t *offsets, size_t rings,
	size_t width, ew_ring_lanesf *lanes);

#ifdef __cplusplus
}
#endif

#endif

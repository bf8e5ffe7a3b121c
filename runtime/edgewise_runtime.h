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
	EW_STAGE = 256,      /* vertices moved or gathered at a time; not part of the definition */
	EW_TILE = EW_SHORT + 4,      /* room for the columns of rings side by side */
	EW_CACHED = 1 << 22          /* bytes of results that are worth keeping in the caches */
};

/* What a target can do with coordinates by vectors (edgewise_columns.c).
 *
 * move: to[i] = from[i * stride] - origin, stride 1 or 2.
 * gather: `width` short rings side by side, tile[c * width + l] is coordinate c of ring l, and its
 * first one again for c >= length[l]; columns 0 .. longest are written, up to EW_TILE may be.
 * With `moved`, less the first coordinate of each ring. Reads from[start[l]] and on, 3
 * places past `longest` at most. NULL for scalar targets. */
typedef struct {
	size_t width;
	void (*move)(const double *from, size_t stride, double origin, size_t count, double *to);
	void (*gather)(const double *from, const size_t *start, const double *length,
		size_t shortest, size_t longest, int moved, double *tile);
} ew_ring_columns;
typedef struct {
	size_t width;
	void (*move)(const float *from, size_t stride, float origin, size_t count, float *to);
	void (*gather)(const float *from, const size_t *start, const float *length,
		size_t shortest, size_t longest, int moved, float *tile);
} ew_ring_columnsf;

#ifdef __cplusplus
extern "C" {
#endif

unsigned ew_cpu_target(void);  /* the forced target, or the best one: one bit */
const ew_ring_columns *ew_ring_by_columns(unsigned target);
const ew_ring_columnsf *ew_ring_by_columnsf(unsigned target);

#ifdef __cplusplus
}
#endif

#endif

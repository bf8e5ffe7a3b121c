/* edgewise_columns_template.h - included by edgewise_columns.c once per instruction set and
 * precision; that file says what the parameters are.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#include "edgewise_precision.h"

EW_ATTRIBUTE static void EW_ISA(move)(const EW_REAL *from, size_t stride, EW_REAL origin,
	size_t count, EW_REAL *to)
{
	const EW_VECTOR c = EW_SPLAT(origin);
	size_t i = 0;
	if (stride == 1)
		for (; i + EW_ROWS <= count; i += EW_ROWS)
			EW_STORE(to + i, EW_SUB(EW_LOAD(from + i), c));
	else       /* a load reaches one place past the last even one: stop a vertex earlier */
		for (; i + EW_ROWS < count; i += EW_ROWS)
			EW_STORE(to + i, EW_SUB(EW_EVEN(EW_LOAD(from + 2 * i),
				EW_LOAD(from + 2 * i + EW_ROWS)), c));
	for (; i < count; ++i)
		to[i] = from[i * stride] - origin;
}

EW_ATTRIBUTE static void EW_ISA(clear)(EW_REAL *to, size_t count)
{
	for (size_t i = 0; i < count; i += EW_ROWS)
		EW_STORE(to + i, EW_SPLAT(0));
}

EW_ATTRIBUTE EW_INLINE int EW_ISA(is_zero)(EW_VECTOR v)
{
	EW_REAL lane[EW_ROWS], off = 0;
	EW_STORE(lane, v);
	for (int l = 0; l < EW_ROWS; ++l)
		off += lane[l];
	return off == 0;
}

EW_ATTRIBUTE static int EW_ISA(widen)(const EW_REAL *from, size_t count, double *to)
{
	EW_VECTOR off = EW_SPLAT(0);
	for (size_t i = 0; i < count; i += EW_ROWS) {
		const EW_VECTOR v = EW_LOAD(from + i);
		off = EW_ADD(off, EW_SUB(v, v));
		EW_STORE_WIDE(to + i, v);
	}
	return EW_ISA(is_zero)(off);
}

#define EW_EACH(X) X(0) X(1) EW_MORE(X)
#define EW_FILL(k) \
	column[k] = EW_SELECT(length, EW_SPLAT((EW_REAL)(c + k)), column[k], first); \
	EW_STORE(tile + (c + k) * EW_ROWS, column[k]);
/* One coordinate. */
EW_ATTRIBUTE EW_INLINE void EW_ISA(fill)(const EW_REAL *from, const size_t *start, size_t longest,
	EW_VECTOR length, EW_REAL *tile)
{
	EW_VECTOR column[EW_COLUMNS], first;
	EW_ISA(block)(from, start, column);
	first = column[0];
	for (size_t c = 0; ; EW_ISA(block)(from + c, start, column)) {
		EW_EACH(EW_FILL)
		c += EW_COLUMNS;
		if (c >= longest)
			break;
	}
	EW_STORE(tile + longest * EW_ROWS, first);
	EW_STORE(tile + (longest + 1) * EW_ROWS, first);
}
#undef EW_FILL

EW_ATTRIBUTE static void EW_ISA(gather)(const EW_REAL *x, const EW_REAL *y,
	const EW_LOCAL(lanes) *lanes, EW_REAL *tile_x, EW_REAL *tile_y)
{
	const size_t start[EW_ROWS] = { EW_STARTS(lanes->start) };
	const EW_VECTOR length = EW_LOAD(lanes->length);
	EW_ISA(fill)(x, start, lanes->longest, length, tile_x);
	EW_ISA(fill)(y, start, lanes->longest, length, tile_y);
}

#ifdef EW_MAX_DEGREE
#define EW_SIDE(stem) EW_ISA(stem##_0)
#define EW_SUMS EW_SUMS_0
#define EW_NEXT(k) EW_NEXT_0(EW_ITEM(0), k)
#define EW_MOVED 0
#define EW_IDLE 1
#include "edgewise_sides_template.h"
#endif
#if defined(EW_MAX_DEGREE) && EW_MAX_DEGREE >= 1
#define EW_SIDE(stem) EW_ISA(stem##_1)
#define EW_SUMS EW_SUMS_1
#define EW_NEXT(k) EW_NEXT_1(EW_ITEM(1), k)
#define EW_MOVED 0
#define EW_IDLE 0
#include "edgewise_sides_template.h"
#define EW_SIDE(stem) EW_ISA(stem##_centroid)
#define EW_SUMS EW_SUMS_1
#define EW_NEXT(k) EW_NEXT_1(EW_ITEM(1), k)
#define EW_MOVED 1
#define EW_IDLE 1
#include "edgewise_sides_template.h"
#endif
#if defined(EW_MAX_DEGREE) && EW_MAX_DEGREE >= 2
#define EW_SIDE(stem) EW_ISA(stem##_2)
#define EW_SUMS EW_SUMS_2
#define EW_NEXT(k) EW_NEXT_2(EW_ITEM(2), k)
#define EW_MOVED 0
#define EW_IDLE 0
#include "edgewise_sides_template.h"
#endif

static const EW_LOCAL(columns) EW_ISA(columns) = {
	EW_ROWS, EW_ISA(move), EW_ISA(clear), EW_ISA(widen), EW_DIVIDE, EW_ISA(gather),
#ifndef EW_MAX_DEGREE
	{ NULL }, NULL
#elif EW_MAX_DEGREE == 0
	{ EW_ISA(side_0) }, NULL
#elif EW_MAX_DEGREE == 1
	{ EW_ISA(side_0), EW_ISA(side_1) }, EW_ISA(side_centroid)
#else
	{ EW_ISA(side_0), EW_ISA(side_1), EW_ISA(side_2) }, EW_ISA(side_centroid)
#endif
};

#undef EW_ISA
#undef EW_ITEM
#undef EW_DIVIDE
#undef EW_VECTOR
#undef EW_ATTRIBUTE
#undef EW_ROWS
#undef EW_STARTS
#undef EW_COUNTS
#undef EW_OVER
#undef EW_SAME
#undef EW_MOST
#undef EW_LENGTHS
#undef EW_COLUMNS
#undef EW_MORE
#undef EW_EACH
#undef EW_LOAD
#undef EW_STORE
#undef EW_STORE_WIDE
#undef EW_SPLAT
#undef EW_ADD
#undef EW_SUB
#undef EW_SELECT
#undef EW_EVEN

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

/* EW_ROWS rings of the tile, from column 0 to `longest`. */
EW_ATTRIBUTE static void EW_ISA(gather)(const EW_REAL *from, const size_t *start,
	const EW_REAL *length, size_t shortest, size_t longest, size_t width, int moved,
	EW_REAL *tile)
{
	const EW_VECTOR lengths = EW_LOAD(length);
	EW_VECTOR column[EW_COLUMNS], first, origin = EW_SPLAT(0);
	size_t c = 0;
	EW_ISA(block)(from, start, column);
	first = column[0];
	if (moved)
		origin = first;
	for (; c + EW_COLUMNS <= shortest; c += EW_COLUMNS) {
		EW_ISA(block)(from + c, start, column);
		for (size_t k = 0; k < EW_COLUMNS; ++k)
			EW_STORE(tile + (c + k) * width, EW_SUB(column[k], origin));
	}
	for (; c < longest; c += EW_COLUMNS) {
		EW_ISA(block)(from + c, start, column);
		for (size_t k = 0; k < EW_COLUMNS; ++k)
			EW_STORE(tile + (c + k) * width, EW_SUB(EW_SELECT(lengths,
				EW_SPLAT((EW_REAL)(c + k)), column[k], first), origin));
	}
	EW_STORE(tile + longest * width, EW_SUB(first, origin));
}

#define EW_GATHER(width) \
EW_ATTRIBUTE static void EW_GATHER_NAME(width)(const EW_REAL *from, const size_t *start, \
	const EW_REAL *length, size_t shortest, size_t longest, int moved, \
	EW_REAL *tile) \
{ \
	for (size_t row = 0; row < width; row += EW_ROWS) \
		EW_ISA(gather)(from, start + row, length + row, shortest, longest, width, \
			moved, tile + row); \
}
#define EW_GATHER_NAME(width) EW_ISA(gather_##width)
EW_WIDTHS

#undef EW_GATHER
#undef EW_GATHER_NAME
#undef EW_ISA
#undef EW_VECTOR
#undef EW_ATTRIBUTE
#undef EW_ROWS
#undef EW_COLUMNS
#undef EW_WIDTHS
#undef EW_LOAD
#undef EW_STORE
#undef EW_SPLAT
#undef EW_SUB
#undef EW_SELECT
#undef EW_EVEN

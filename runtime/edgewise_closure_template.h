/* edgewise_closure_template.h - do edges in any order close? Included by edgewise_rings.c once per
 * precision.
 *
 * On a closed set of edges every vertex starts as often as it ends, so the sum over the edges of
 * H(start) - H(end) is 0 for every function H. ew_line_closure takes the product of the coordinates
 * about (px,py) for H; ew_is_closed takes 64 mixed bits of them, and sums modulo 2^64: exact, in
 * any order, without a tolerance. Equal vertices have equal bits once -0 is made 0, so what is
 * closed is always found closed.
 *
 * What is open is missed if its sum happens to be 0. If H were drawn at random that would be one
 * time in 2^64, or in 2^(64-j) if every vertex starts 2^j (or a multiple) times more often than it
 * ends or the reverse. H is not random but fixed by the keys below: whoever knows them can
 * construct open edges that pass. They are the first digits of pi after the point, hexadecimal; the
 * odd factors are the golden ratio and the two of splitmix64 (Steele, Lea, Flood 2014). Nothing in
 * them was searched for.
 *
 * Vertices that agree only up to rounding are different vertices here. NaN and infinity are on no
 * boundary: never closed.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

#ifndef EW_CLOSURE_KEYS
#define EW_CLOSURE_KEYS
#define EW_KEY_X UINT64_C(0x243f6a8885a308d3)
#define EW_KEY_Y UINT64_C(0x13198a2e03707344)
#define EW_FACTOR_X UINT64_C(0x9e3779b97f4a7c15)
#define EW_FACTOR_1 UINT64_C(0xbf58476d1ce4e5b9)
#define EW_FACTOR_2 UINT64_C(0x94d049bb133111eb)
#endif

/* The bits of a coordinate, those of 0 for -0; *bad is set for NaN and infinity. */
EW_INLINE uint64_t EW_LOCAL(coordinate_bits)(EW_REAL value, int *bad)
{
#if EW_IS_FLOAT
	uint32_t bits;
	const uint32_t infinity = UINT32_C(0x7f800000);
#else
	uint64_t bits;
	const uint64_t infinity = UINT64_C(0x7ff0000000000000);
#endif
	memcpy(&bits, &value, sizeof bits);
	*bad |= bits << 1 >= infinity << 1;
	return bits << 1 ? bits : 0;
}

/* Every step but the sum of x and y can be undone, so two vertices of equal x or equal y never
 * share a value. */
EW_INLINE uint64_t EW_LOCAL(mixed_vertex)(EW_REAL x, EW_REAL y, int *bad)
{
	uint64_t h = (EW_LOCAL(coordinate_bits)(x, bad) ^ EW_KEY_X) * EW_FACTOR_X;
	h = (h ^ h >> 32) + (EW_LOCAL(coordinate_bits)(y, bad) ^ EW_KEY_Y);
	h = (h ^ h >> 30) * EW_FACTOR_1;
	h = (h ^ h >> 27) * EW_FACTOR_2;
	return h ^ h >> 31;
}

int EW_NAME(is_closed)(const EW_REAL *x0, const EW_REAL *y0, const EW_REAL *x1, const EW_REAL *y1,
	size_t edges)
{
	uint64_t sum = 0;
	int bad = 0;
	for (size_t i = 0; i < edges; ++i)
		sum += EW_LOCAL(mixed_vertex)(x0[i], y0[i], &bad)
			- EW_LOCAL(mixed_vertex)(x1[i], y1[i], &bad);
	return sum == 0 && !bad;
}


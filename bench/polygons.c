/* polygons.c - the vertices and rings that are measured; the same in every run.
 *
 * Rings are star-shaped about a centre in a square of side 1000, about 10 in size, and repeat
 * their first vertex at the end, as GeoArrow's do. All coordinates are floats, so that a library
 * that takes float is given the same polygons. */
#include "bench.h"

#include <stdlib.h>

static double random_unit(void)
{
	static uint64_t state = 1;
	state = state * 6364136223846793005u + 1442695040888963407u;
	return (double)(state >> 40) / 16777216.0;
}

void points_make(int precision, void *values, size_t n)
{
	for (size_t i = 0; i < n; ++i)
		if (precision == DOUBLE)
			((double *)values)[i] = random_unit();
		else
			((float *)values)[i] = (float)random_unit();
}

static void add_vertex(Rings *rings, double x, double y)
{
	size_t at = rings->vertices++;
	rings->xf[at] = (float)x;
	rings->yf[at] = (float)y;
	rings->x[at] = (double)rings->xf[at];
	rings->y[at] = (double)rings->yf[at];
}

static void add_ring(Rings *rings, int corners)
{
	const double turn = 6.283185307179586 / corners;
	const double cx = 1000 * random_unit(), cy = 1000 * random_unit();
	const size_t first = rings->vertices;
	for (int k = 0; k < corners; ++k) {
		double angle = turn * (k + 0.8 * random_unit()), radius = 3 + 4 * random_unit();
		add_vertex(rings, cx + radius * cos(angle), cy + radius * sin(angle));
	}
	add_vertex(rings, rings->x[first], rings->y[first]);
}

Rings rings_make(size_t count, int fewest, int most)
{
	const size_t room = count * (size_t)(most + 1);
	Rings rings = { count, 0, allocate((count + 1) * sizeof(int32_t)),
		allocate(room * sizeof(double)), allocate(room * sizeof(double)),
		allocate(room * sizeof(float)), allocate(room * sizeof(float)) };
	rings.offsets[0] = 0;
	for (size_t i = 0; i < count; ++i) {
		add_ring(&rings, fewest + (int)(random_unit() * (most - fewest + 1)));
		rings.offsets[i + 1] = (int32_t)rings.vertices;
	}
	return rings;
}

void rings_free(Rings *rings)
{
	free(rings->offsets);
	free(rings->x);
	free(rings->y);
	free(rings->xf);
	free(rings->yf);
}

const void *rings_x(const Rings *rings, int precision)
{
	return precision == DOUBLE ? (const void *)rings->x : rings->xf;
}

const void *rings_y(const Rings *rings, int precision)
{
	return precision == DOUBLE ? (const void *)rings->y : rings->yf;
}

/* peer_geos.c - GEOS by its C interface: area and centroid of polygons.
 *
 * The reentrant functions, as a program would use them. A centroid is a new point that is read
 * and destroyed; that is part of what asking for it costs. */
#include "peers.h"

#include <geos_c.h>

#include <stdio.h>
#include <stdlib.h>

typedef struct {
	GEOSContextHandle_t geos;
	size_t rings;
	GEOSGeometry **polygon;
} Set;

static void require(int condition)
{
	if (!condition) {
		fprintf(stderr, "bench: GEOS failed\n");
		exit(1);
	}
}

static GEOSGeometry *polygon(GEOSContextHandle_t geos, const double *x, const double *y, size_t n)
{
	GEOSCoordSequence *points = GEOSCoordSeq_create_r(geos, (unsigned)n, 2);
	require(points != NULL);
	for (size_t k = 0; k < n; ++k)
		require(GEOSCoordSeq_setXY_r(geos, points, (unsigned)k, x[k], y[k]));
	GEOSGeometry *ring = GEOSGeom_createLinearRing_r(geos, points);
	require(ring != NULL);
	GEOSGeometry *whole = GEOSGeom_createPolygon_r(geos, ring, NULL, 0);
	require(whole != NULL);
	return whole;
}

static void *prepare(const double *x, const double *y, const int32_t *offsets, size_t rings)
{
	Set *set = malloc(sizeof *set);
	require(set != NULL);
	set->geos = GEOS_init_r();
	set->rings = rings;
	set->polygon = malloc(rings * sizeof *set->polygon);
	require(set->geos != NULL && set->polygon != NULL);
	for (size_t i = 0; i < rings; ++i)
		set->polygon[i] = polygon(set->geos, x + offsets[i], y + offsets[i],
			(size_t)(offsets[i + 1] - offsets[i]));
	return set;
}

static void release(void *data)
{
	Set *set = data;
	for (size_t i = 0; i < set->rings; ++i)
		GEOSGeom_destroy_r(set->geos, set->polygon[i]);
	GEOS_finish_r(set->geos);
	free(set->polygon);
	free(set);
}

static void area(const void *data, double *out)
{
	const Set *set = data;
	for (size_t i = 0; i < set->rings; ++i)
		require(GEOSArea_r(set->geos, set->polygon[i], &out[i]));
}

static void centroid(const void *data, double *out)
{
	const Set *set = data;
	for (size_t i = 0; i < set->rings; ++i) {
		GEOSGeometry *point = GEOSGetCentroid_r(set->geos, set->polygon[i]);
		require(point != NULL && GEOSGeomGetX_r(set->geos, point, &out[2 * i])
			&& GEOSGeomGetY_r(set->geos, point, &out[2 * i + 1]));
		GEOSGeom_destroy_r(set->geos, point);
	}
}

const Peer peer_GEOS = { prepare, release, { area, centroid, NULL } };

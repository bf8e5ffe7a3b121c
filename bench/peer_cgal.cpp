/* peer_cgal.cpp - CGAL: area of polygons.
 *
 * Its fastest kernel, plain doubles. CGAL closes a polygon by itself, so the repeated vertex is
 * left out. */
#include "peers.h"

#include <CGAL/Polygon_2.h>
#include <CGAL/Simple_cartesian.h>

#include <vector>

namespace {

typedef CGAL::Simple_cartesian<double> Plane;
typedef CGAL::Polygon_2<Plane> Polygon;
typedef std::vector<Polygon> Set;

void *prepare(const double *x, const double *y, const int32_t *offsets, size_t rings)
{
	Set *set = new Set(rings);
	for (size_t i = 0; i < rings; ++i)
		for (int32_t k = offsets[i]; k < offsets[i + 1] - 1; ++k)
			(*set)[i].push_back(Plane::Point_2(x[k], y[k]));
	return set;
}

void release(void *set)
{
	delete static_cast<Set *>(set);
}

void area(const void *set, double *out)
{
	for (const Polygon &polygon : *static_cast<const Set *>(set))
		*out++ = polygon.area();
}

}

const Peer peer_CGAL = { prepare, release, { area, nullptr, nullptr } };

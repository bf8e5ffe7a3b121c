/* peer_boost.cpp - Boost.Geometry: area and centroid of polygons.
 *
 * Counterclockwise closed polygons of plain Cartesian points, the library's default strategies. */
#include "peers.h"

#define BOOST_ALLOW_DEPRECATED_HEADERS         /* Boost includes some of its own */

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <vector>

namespace {

namespace bg = boost::geometry;
typedef bg::model::d2::point_xy<double> Point;
typedef bg::model::polygon<Point, false, true> Polygon;
typedef std::vector<Polygon> Set;

void *prepare(const double *x, const double *y, const int32_t *offsets, size_t rings)
{
	Set *set = new Set(rings);
	for (size_t i = 0; i < rings; ++i)
		for (int32_t k = offsets[i]; k < offsets[i + 1]; ++k)
			(*set)[i].outer().push_back(Point(x[k], y[k]));
	return set;
}

void release(void *set)
{
	delete static_cast<Set *>(set);
}

void area(const void *set, double *out)
{
	for (const Polygon &polygon : *static_cast<const Set *>(set))
		*out++ = bg::area(polygon);
}

void centroid(const void *set, double *out)
{
	for (const Polygon &polygon : *static_cast<const Set *>(set)) {
		Point point(0, 0);
		bg::centroid(polygon, point);
		*out++ = point.x();
		*out++ = point.y();
	}
}

}

const Peer peer_Boost = { prepare, release, { area, centroid, nullptr } };

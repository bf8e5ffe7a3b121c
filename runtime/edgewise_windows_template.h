/* edgewise_windows_template.h - coverage of a rectangle and filters, of one edge and of one ring;
 * included by edgewise_rings.c once per precision.
 *
 * The kernels clamp and select; whether a rectangle is empty or not a number is decided here. For a
 * filter the vertices are moved to its centre, for a rectangle they stay where they are and its
 * bounds are the constants of all lanes.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

#ifdef EW_HAS_COVERAGE
/* 0 for an empty rectangle, NaN if a bound or `other` is NaN or infinite; else 1. */
static EW_REAL EW_LOCAL(extent)(EW_REAL u0, EW_REAL u1, EW_REAL v0, EW_REAL v1, EW_REAL other)
{
	const EW_REAL zero = (u0 - u0) + (u1 - u1) + (v0 - v0) + (v1 - v1) + (other - other);
	if (zero != 0)
		return zero;
	return u0 < u1 && v0 < v1 ? (EW_REAL)1 : (EW_REAL)0;
}

static void EW_LOCAL(set_cell)(EW_REAL u0, EW_REAL u1, EW_REAL v0, EW_REAL v1, EW_REAL *origin)
{
	const EW_REAL bound[] = { u0, u1, v0, v1 };
	for (int k = 0; k < 4; ++k)
		for (int l = 0; l < EW_WIDTH; ++l)
			origin[k * EW_WIDTH + l] = bound[k];
}

EW_REAL EW_NAME(line_coverage)(EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL u0,
	EW_REAL u1, EW_REAL v0, EW_REAL v1)
{
	EW_REAL origin[4 * EW_WIDTH];
	const EW_REAL extent = EW_LOCAL(extent)(u0, u1, v0, v1, ((x1 - x0) + (y1 - y0)) * 0);
	if (!(extent > 0))
		return extent;
	EW_LOCAL(set_cell)(u0, u1, v0, v1, origin);
	return EW_LOCAL(edge_about)(EW_RING_COVERAGE, x0, y0, x1, y1, origin);
}

EW_REAL EW_NAME(below)(EW_REAL px, EW_REAL py, EW_REAL qx, EW_REAL qy, EW_REAL u0, EW_REAL u1,
	EW_REAL v0, EW_REAL v1)
{
	const EW_REAL signed_area = EW_NAME(line_coverage)(px, py, qx, qy, u0, u1, v0, v1);
	return signed_area < 0 ? -signed_area : signed_area;
}

EW_REAL EW_NAME(coverage)(const EW_REAL *x, const EW_REAL *y, size_t n, EW_REAL u0, EW_REAL u1,
	EW_REAL v0, EW_REAL v1)
{
	EW_ALIGNED EW_REAL origin[4 * EW_WIDTH];
	double out[1];
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, n);
	const EW_REAL extent = EW_LOCAL(extent)(u0, u1, v0, v1, 0);
	if (!(extent > 0))
		return extent + (EW_REAL)EW_LOCAL(nothing)(&v);
	EW_LOCAL(set_cell)(u0, u1, v0, v1, origin);
	v.constants = origin;
	EW_LOCAL(integrate)(EW_RING_COVERAGE, &v, out);
	return (EW_REAL)out[0];
}
#endif

#ifdef EW_HAS_FILTERS
static EW_REAL EW_LOCAL(filtered)(int id, const EW_REAL *x, const EW_REAL *y, size_t n, EW_REAL cx,
	EW_REAL cy)
{
	double out[1];
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, n);
	v.moved = 1;
	v.cx = cx;
	v.cy = cy;
	EW_LOCAL(integrate)(id, &v, out);
	return (EW_REAL)out[0] + ((cx - cx) + (cy - cy));
}

#define EW_FUNCTION(function, edge, id) \
	EW_REAL edge(EW_REAL x0, EW_REAL y0, EW_REAL x1, EW_REAL y1, EW_REAL cx, EW_REAL cy) \
	{ \
		return EW_LOCAL(edge_about)(id, x0 - cx, y0 - cy, x1 - cx, y1 - cy, &cx); \
	} \
	EW_REAL function(const EW_REAL *x, const EW_REAL *y, size_t n, EW_REAL cx, EW_REAL cy) \
	{ \
		return EW_LOCAL(filtered)(id, x, y, n, cx, cy); \
	}
EW_LIST_FILTERS(EW_FUNCTION)
#undef EW_FUNCTION
#endif

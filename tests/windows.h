/* windows.h - what the tests of windows share: the functions of both precisions behind one table,
 * and how far from exact they may be.
 *
 * One edge, clipped to w = xr - xl in x, in a rectangle of height H. With the definition's order of
 * operations an ordinate is (ay - v0) + ratio dy, so its error is at most, in u = 2^-bits,
 *
 *     E = |ay - v0| + 6 |y - ay| + |y - v0|      (a - v0; two differences, their quotient, dy, the
 *                                                 product and one more where 1/dx is a factor; sum)
 *
 * each end from its own vertex a; 8 instead of 6 where dx is so large that 1/dx is subnormal. A
 * mean of clamped ordinates moves no more than they do. In m + (H-m) t/d - m r/d with 0 <= t/d, r/d
 * and t/d + r/d <= 1 there are H (1), m (1); what sticks out of an end, the difference of both
 * ends, d, 1/d, their product, H - m and the product with it (7); and two sums (2): 11 H. The
 * factor w is rounded and multiplied by: 2 H. In all
 *
 *     |computed - exact| <= u w (max E + 13 H),
 *
 * which is the 4.5 u w max|y| measured before plus what the worst case needs: E is the conditioning
 * ulp(|coordinate|) of y. WINDOW_SECOND covers the squares of u. Where something underflows, each
 * of four roundings is off by the smallest number times w, H or dy; where dx is so small that 1/dx
 * overflows, the ratio is anything from 0 to 1 and the value from 0 to w H.
 */
#ifndef WINDOWS_H
#define WINDOWS_H

#include "rings.h"
#include "window_reference.h"

#define WINDOW_SECOND 1.0001

enum { X0 = 0, Y0, X1, Y1, SIDES };     /* of an edge */
enum { U0 = 0, U1, V0, V1 };            /* of a rectangle */

typedef struct {
	double (*below)(const double e[SIDES], const double r[SIDES]);
	double (*line)(const double e[SIDES], const double r[SIDES]);
	double (*ring)(const void *x, const void *y, size_t n, const double r[SIDES]);
} Windows;

#define WINDOW_FUNCTIONS(REAL, f) \
static inline double window_below##f(const double e[SIDES], const double r[SIDES]) \
{ \
	return (double)ew_below##f((REAL)e[X0], (REAL)e[Y0], (REAL)e[X1], (REAL)e[Y1], \
		(REAL)r[U0], (REAL)r[U1], (REAL)r[V0], (REAL)r[V1]); \
} \
static inline double window_line##f(const double e[SIDES], const double r[SIDES]) \
{ \
	return (double)ew_line_coverage##f((REAL)e[X0], (REAL)e[Y0], (REAL)e[X1], (REAL)e[Y1], \
		(REAL)r[U0], (REAL)r[U1], (REAL)r[V0], (REAL)r[V1]); \
} \
static inline double window_coverage##f(const void *x, const void *y, size_t n, \
	const double r[SIDES]) \
{ \
	return (double)ew_coverage##f(x, y, n, (REAL)r[U0], (REAL)r[U1], (REAL)r[V0], \
		(REAL)r[V1]); \
}

WINDOW_FUNCTIONS(double, )
WINDOW_FUNCTIONS(float, f)

static const Windows window_apis[APIS] = {
	{ window_below, window_line, window_coverage },
	{ window_belowf, window_linef, window_coveragef }
};

static inline const Windows *windows_of(const Api *api)
{
	return &window_apis[api - apis];
}

static inline double largest(const Api *api)
{
	return api->bits == 24 ? (double)FLT_MAX : DBL_MAX;
}

static inline double clamped(double v, double low, double high)
{
	return v < low ? low : v > high ? high : v;
}

/* E of the end at x of the edge, from its vertex (ax,ay). */
static inline long double ordinate_error(const Api *api, double x, double ax, double ay,
	const double e[SIDES], double v0)
{
	const long double dx = (long double)e[X1] - e[X0], dy = (long double)e[Y1] - e[Y0];
	const long double rise = dx == 0 ? 0 : ((long double)x - ax) / dx * dy;
	const long double start = (long double)ay - v0;
	const int ratio = fabsl(dx) > largest(api) / 4 ? 8 : 6;
	return fabsl(start) + ratio * fabsl(rise) + fabsl(start + rise);
}

/* The bound above. */
static inline double window_bound(const Api *api, const double e[SIDES], const double r[SIDES])
{
	const int low = e[X0] <= e[X1] ? X0 : X1, high = X1 - low;
	const double xl = clamped(r[U0], e[low], e[high]), xr = clamped(r[U1], e[low], e[high]);
	const long double w = (long double)xr - xl, h = (long double)r[V1] - r[V0];
	const long double dx = (long double)e[high] - e[low];
	const long double dy = fabsl((long double)e[Y1] - e[Y0]);
	const long double left = ordinate_error(api, xl, e[low], e[low + 1], e, r[V0]);
	const long double right = ordinate_error(api, xr, e[high], e[high + 1], e, r[V0]);
	long double tiny = 4 * (long double)api->denormal * (1 + w) * (1 + h + dy);
	if (w <= 0 || h <= 0)
		return 0;
	if (dx * largest(api) < 1)
		tiny += w * h;
	return (double)(WINDOW_SECOND * ldexpl(1, -api->bits) * w
		* ((left > right ? left : right) + 13 * h) + tiny);
}

/* A ring whose value in the window is that of the edge p -> q: down to v0 and back on it. These
 * vertices are repeated `times` times; two repetitions are joined by a vertical edge. */
static inline void edge_ring(const Api *api, Ring *ring, const double e[SIDES], double v0)
{
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = e[i % 4 == 0 || i % 4 == 3 ? X0 : X1];
		ring->y[i] = i % 4 > 1 ? v0 : e[i % 4 ? Y1 : Y0];
	}
	ring_pack(api, ring);
}

/* What the targets with fused operations seen so far gave for a ring: all of them the same. */
typedef struct {
	uint64_t bits;
	bool some;
} Fused;

static inline void expect_same_if_fused(Fused *fused, unsigned target, double got, size_t n)
{
	uint64_t bits;
	if (target == EW_PORTABLE)
		return;
	memcpy(&bits, &got, sizeof bits);
	expect(!fused->some || bits == fused->bits, "n = %zu, %s: %a, other bits before", n,
		ew_target_name(target), got);
	*fused = (Fused){ bits, true };
}

#endif

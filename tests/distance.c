/* Integrals of powers of the distance from a point, against MPFR.
 *
 * Edges: eleven classes made to find cancellation, underflow and bad branches. One edge is within
 * 8 u of its contribution (k = 1), within 18 u for k = -1, 3, 5: as a function of its own, and
 * through the ring kernel of every target. For the latter the triangle (origin, p0, p1) is repeated
 * until every lane has got the edge p0 -> p1 exactly once; its other edges are exactly 0, the lanes
 * are added by halving, so the result is the number of lanes times one edge without a further
 * rounding.
 *
 * Edges are left out where the precision cannot carry them: the result overflows or loses bits to
 * underflow, a product of coordinates is so small that its rounding error underflows (in_range).
 *
 * Rings: |result - exact| <= gamma_(28 + ceil(n/L) - 1 + log2 L) sum |I_i|, and about a centre c,
 * since p - c is rounded, sqrt(2) u sum max(r0,r1)^(k+1) |p1 - p0| in addition: r^k on the boundary
 * times the displacement, sqrt(2) u r at most, times the length.
 */
#include <limits.h>

#include "rings.h"
#include "distance_reference.h"

enum { EDGES = 4000, X0 = 0, Y0, X1, Y1, SIDES };

static const int powers[DISTANCE_POWERS] = { -1, 1, 3, 5 };
static const int allowed[DISTANCE_POWERS] = { 18, 8, 18, 18 };          /* in u, of one edge */

typedef struct {
	double (*line_distance)(const double e[SIDES]);
	double (*line_radius)(int k, const double e[SIDES]);
	double (*distance)(const Ring *ring, double cx, double cy);
	double (*radius)(int k, const Ring *ring, double cx, double cy);
} Distance;

#define DISTANCE_FUNCTIONS(REAL, f) \
static double call_line_distance##f(const double e[SIDES]) \
{ \
	return (double)ew_line_distance##f((REAL)e[X0], (REAL)e[Y0], (REAL)e[X1], (REAL)e[Y1]); \
} \
static double call_line_radius##f(int k, const double e[SIDES]) \
{ \
	return (double)ew_line_radius##f(k, (REAL)e[X0], (REAL)e[Y0], (REAL)e[X1], (REAL)e[Y1]); \
} \
static double call_distance##f(const Ring *ring, double cx, double cy) \
{ \
	return (double)ew_distance##f(ring->px, ring->py, ring->n, (REAL)cx, (REAL)cy); \
} \
static double call_radius##f(int k, const Ring *ring, double cx, double cy) \
{ \
	return (double)ew_radius##f(k, ring->px, ring->py, ring->n, (REAL)cx, (REAL)cy); \
}

DISTANCE_FUNCTIONS(double, )
DISTANCE_FUNCTIONS(float, f)

static const Distance distances[APIS] = {
	{ call_line_distance, call_line_radius, call_distance, call_radius },
	{ call_line_distancef, call_line_radiusf, call_distancef, call_radiusf }
};

static const Distance *of(const Api *api)
{
	return &distances[api - apis];
}

static bool identical(double a, double b)
{
	return memcmp(&a, &b, sizeof a) == 0;
}

/* Classes of edges. */

typedef void Fill(const Api *api, double e[SIDES]);

static void fill_uniform(const Api *api, double e[SIDES])
{
	(void)api;
	for (int i = 0; i < SIDES; i++)
		e[i] = random_real(-1, 1);
}

static void fill_mixed(const Api *api, double e[SIDES])
{
	(void)api;
	for (int i = 0; i < SIDES; i++)
		e[i] = random_scaled(-20, 20);
}

/* One scale for all coordinates, or each its own. For float what its range has room for. */
static void fill_scale(const Api *api, double e[SIDES])
{
	const int most = api->bits == 24 ? 16 : 200, scale = random_int(-most, most);
	const bool own = random_int(0, 1);
	for (int i = 0; i < SIDES; i++)
		e[i] = own ? random_scaled(-most, most) : random_scaled(scale, scale);
}

/* Up to 2^20 away, and shorter than that by up to all bits but three. */
static void fill_short(const Api *api, double e[SIDES])
{
	const double far = ldexp(1, random_int(0, 20));
	const int off = -random_int(3, api->bits - 3);
	for (int i = 0; i < 2; i++) {
		e[i] = far * random_real(-1, 1);
		e[i + 2] = e[i] + far * random_scaled(off, off);
	}
}

/* Ends on a line through the origin, up to a relative 2^-off and rounding. */
static void fill_aligned(const Api *api, double e[SIDES], double factor)
{
	const int off = -random_int(1, api->bits + 2);
	for (int i = 0; i < 2; i++) {
		e[i] = random_real(-1, 1);
		e[i + 2] = factor * (e[i] + random_scaled(off, off));
	}
}

static void fill_near(const Api *api, double e[SIDES])
{
	fill_aligned(api, e, -exp2(random_real(-8, 8)));
}

static void fill_collinear(const Api *api, double e[SIDES])
{
	fill_aligned(api, e, exp2(random_real(-8, 8)));
}

static void fill_integers(const Api *api, double e[SIDES])
{
	(void)api;
	for (int i = 0; i < SIDES; i++)
		e[i] = random_int(-12, 12);
}

/* One end at the origin or next to it. */
static void fill_vertex(const Api *api, double e[SIDES])
{
	const int end = 2 * random_int(0, 1), off = -random_int(0, api->bits + 10);
	const bool at = random_int(0, 9) == 0;
	fill_uniform(api, e);
	for (int i = end; i < end + 2; i++)
		e[i] = at ? 0 : ldexp(e[i], off);
}

/* Beside the x axis. */
static void fill_flat(const Api *api, double e[SIDES])
{
	const int off = -random_int(10, api->bits == 24 ? 50 : 100);
	fill_uniform(api, e);
	e[Y0] = random_scaled(off - 3, off);
	e[Y1] = random_int(0, 3) ? random_scaled(off - 3, off) : e[Y0];
}

static void fill_offset(const Api *api, double e[SIDES])
{
	fill_uniform(api, e);
	for (int i = 0; i < SIDES; i++)
		e[i] += 1e6;
}

static void fill_axes(const Api *api, double e[SIDES])
{
	fill_uniform(api, e);
	e[random_int(X0, Y0)] = 0;
	e[random_int(X1, Y1)] = 0;
}

static const struct {
	const char *name;
	Fill *fill;
} classes[] = {
	{ "uniform", fill_uniform }, { "coordinates 2^+-20", fill_mixed },
	{ "scales 2^+-200", fill_scale }, { "short and far", fill_short },
	{ "passing near the origin", fill_near }, { "collinear, foot beyond", fill_collinear },
	{ "integers", fill_integers }, { "vertex at the origin", fill_vertex },
	{ "tiny height", fill_flat }, { "offset 1e6", fill_offset }, { "on the axes", fill_axes }
};

enum { CLASSES = sizeof classes / sizeof *classes };

static void fill_edge(const Api *api, size_t c, double e[SIDES])
{
	classes[c].fill(api, e);
	for (int i = 0; i < SIDES; i++)
		e[i] = round_to(api->bits, e[i]);
}

/* Accuracy of one edge. */

/* Exponents of the least normal number and of infinity. */
static int exponent_of_least(const Api *api)
{
	return api->bits == 24 ? -126 : -1022;
}

static int exponent_of_infinity(const Api *api)
{
	return api->bits == 24 ? 128 : 1024;
}

/* x0 y1 - x1 y0, Kahan's way. */
static double cross(const double e[SIDES])
{
	const double product = e[X1] * e[Y0];
	return fma(e[X0], e[Y1], -product) - fma(e[X1], e[Y0], -product);
}

static bool product_in_range(const Api *api, double a, double b)
{
	return a == 0 || b == 0
		|| ilogb(a) + ilogb(b) >= exponent_of_least(api) + api->bits;
}

/* What the precision can carry: both products of s with their rounding errors, and the result with
 * so many bits above it. For k = -1 also the argument of the logarithm, (2 S^2 / s)^2 at most with
 * S = r0 + r1, and its inverse. */
static bool in_range(const Api *api, int k, const double e[SIDES], const mpfr_t exact, int above)
{
	const double size = hypot(e[X0], e[Y0]) + hypot(e[X1], e[Y1]);
	if (mpfr_zero_p(exact))
		return true;
	if (k == -1 && fabs(cross(e)) / size < ldexp(size, exponent_of_least(api) / 2 + 1))
		return false;
	return product_in_range(api, e[X0], e[Y1]) && product_in_range(api, e[X1], e[Y0])
		&& mpfr_get_exp(exact) > exponent_of_least(api)
		&& mpfr_get_exp(exact) < exponent_of_infinity(api) - above;
}

/* |got - exact| in u |exact|; for an exact 0 it must be 0. */
static double error_in_u(const Api *api, double got, const mpfr_t exact)
{
	if (mpfr_zero_p(exact))
		return got == 0 ? 0 : HUGE_VAL;
	if (!isfinite(got))
		return HUGE_VAL;
	mpfr_t off;
	mpfr_init2(off, DISTANCE_BITS);
	mpfr_d_sub(off, got, exact, MPFR_RNDN);
	mpfr_div(off, off, exact, MPFR_RNDN);
	mpfr_mul_2ui(off, off, (unsigned long)api->bits, MPFR_RNDN);
	const double u = fabs(mpfr_get_d(off, MPFR_RNDA));
	mpfr_clear(off);
	return u;
}

/* Sums stand above their results by the divisor of the last step, 84 at most, and by the lanes. */
enum { ABOVE_EDGE = 7, ABOVE_LANES = 4 };

/* The largest error of a class, per power, and how many edges were in range. */
typedef struct {
	double worst[DISTANCE_POWERS];
	int used[DISTANCE_POWERS];
} Errors;

static void expect_edge(const Api *api, int p, double got, const mpfr_t exact,
	const double e[SIDES], const char *how, Errors *errors)
{
	const double u = error_in_u(api, got, exact);
	expect(u <= allowed[p], "k = %d, %s: (%a,%a) -> (%a,%a) is %a, exact %.17g, off by %.4g u",
		powers[p], how, e[X0], e[Y0], e[X1], e[Y1], got, mpfr_get_d(exact, MPFR_RNDN), u);
	errors->worst[p] = fmax(errors->worst[p], u);
}

/* The triangle of the origin and the edge, so often that each lane has the edge once. */
static void fill_lanes(const Api *api, Ring *ring, const double e[SIDES])
{
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = i % 3 ? e[i % 3 == 1 ? X0 : X1] : 0;
		ring->y[i] = i % 3 ? e[i % 3 == 1 ? Y0 : Y1] : 0;
	}
	ring_pack(api, ring);
}

/* The same ring on every target. */
static void expect_targets(const Api *api, int p, const Ring *ring, const mpfr_t exact,
	const double e[SIDES], Errors *errors)
{
	const double lanes = (double)ring_lanes(api, ring->n);
	for (int t = 0; t < target_count; t++) {
		ew_use_target(target_bit[t]);
		expect_edge(api, p, of(api)->radius(powers[p], ring, 0, 0) / lanes, exact, e,
			ew_target_name(target_bit[t]), errors);
	}
}

static void test_class(const Api *api, size_t c)
{
	Errors errors = { { 0 }, { 0 } };
	Ring ring = ring_new(api->bits == 24 ? 48 : 24);
	Distances exact;
	distance_init(&exact);
	check_begin("edges within 8 u, 18 u for k = -1, 3, 5: %s, %s", classes[c].name, api->name);
	for (int i = 0; i < EDGES; i++) {
		double e[SIDES];
		fill_edge(api, c, e);
		distance_edge(&exact, e, 0, 0);
		fill_lanes(api, &ring, e);
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			mpfr_t *want = &exact.value[p];
			if (!in_range(api, powers[p], e, *want, ABOVE_EDGE))
				continue;
			errors.used[p]++;
			expect_edge(api, p, of(api)->line_radius(powers[p], e), *want, e,
				"one edge", &errors);
			if (in_range(api, powers[p], e, *want, ABOVE_EDGE + ABOVE_LANES))
				expect_targets(api, p, &ring, *want, e, &errors);
		}
	}
	for (int p = 0; p < DISTANCE_POWERS; p++)
		expect(errors.used[p] >= EDGES / 4, "k = %d: %d edges in range", powers[p],
			errors.used[p]);
	check_end();
	ew_use_target(0);
	printf("# %s, %s: k = -1 %.2f u, 1 %.2f u, 3 %.2f u, 5 %.2f u\n", classes[c].name,
		api->name, errors.worst[0], errors.worst[1], errors.worst[2], errors.worst[3]);
	distance_clear(&exact);
	ring_free(&ring);
}

/* What one edge must be besides accurate. */

static void test_reversed(const Api *api)
{
	check_begin("reversed edges, distance and k = 1, %s", api->name);
	for (int i = 0; i < 5000 * CLASSES; i++) {
		double e[SIDES];
		fill_edge(api, (size_t)i % CLASSES, e);
		const double back[SIDES] = { e[X1], e[Y1], e[X0], e[Y0] };
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			const double there = of(api)->line_radius(powers[p], e);
			const double again = of(api)->line_radius(powers[p], back);
			expect(same_bits(again, -there) || (isnan(there) && isnan(again)),
				"k = %d, %s: (%a,%a) -> (%a,%a) is %a and reversed %a", powers[p],
				classes[i % CLASSES].name, e[X0], e[Y0], e[X1], e[Y1], there,
				again);
		}
		const double distance = of(api)->line_distance(e);
		expect(identical(distance, of(api)->line_radius(1, e)), "distance %a, k = 1 %a",
			distance, of(api)->line_radius(1, e));
	}
	check_end();
}

/* Edges with both ends and the origin on a line. */
static void fill_degenerate(const Api *api, int kind, double e[SIDES])
{
	const double a = random_int(-4095, 4095), b = random_int(-4095, 4095);
	double from = random_int(-4095, 4095), to = random_int(-4095, 4095);
	if (kind == 0)
		fill_edge(api, (size_t)random_int(0, CLASSES - 1), e);
	if (kind == 0 || kind == 3)
		from = to = kind == 0;                   /* no length; all zero */
	if (kind == 2)
		*(random_int(0, 1) ? &from : &to) = 0;   /* a vertex on the origin */
	const double x = kind ? a : e[X0], y = kind ? b : e[Y0];
	e[X0] = from * x;
	e[Y0] = from * y;
	e[X1] = to * x;
	e[Y1] = to * y;
}

/* The largest scales at which coordinates up to 2^24 are finite, a normal one, and denormals. */
static double random_scale(const Api *api)
{
	switch (random_int(0, 3)) {
	case 0: return ldexp(1, exponent_of_infinity(api) - 24);
	case 1: return api->denormal;
	case 2: return ldexp(1, exponent_of_infinity(api) / 2 - 24);
	default: return 1;
	}
}

static void test_degenerate(const Api *api)
{
	check_begin("edges that see no area are exactly 0, %s", api->name);
	for (int i = 0; i < 40000; i++) {
		double e[SIDES];
		const double scale = i % 4 ? random_scale(api) : 1;
		fill_degenerate(api, i % 4, e);
		for (int j = 0; j < SIDES; j++)
			e[j] *= scale;
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			const double got = of(api)->line_radius(powers[p], e);
			expect(got == 0, "k = %d: (%a,%a) -> (%a,%a) is %g", powers[p], e[X0],
				e[Y0], e[X1], e[Y1], got);
		}
		const double distance = of(api)->line_distance(e);
		expect(distance == 0, "(%a,%a) -> (%a,%a) is %g", e[X0], e[Y0], e[X1], e[Y1],
			distance);
	}
	check_end();
}

/* Never NaN where the result can be represented, whatever the coordinates. */
static void test_extremes(const Api *api)
{
	const int most = exponent_of_infinity(api) - 1;
	const int least = exponent_of_least(api) - api->bits + 1;
	long finite = 0, representable = 0;
	Distances exact;
	distance_init(&exact);
	check_begin("extreme edges are no NaN, %s", api->name);
	for (int i = 0; i < 20000; i++) {
		double e[SIDES];
		const int scale = i % 3 ? random_int(least, most) : i % 2 ? most : least + 3;
		for (int j = 0; j < SIDES; j++)
			e[j] = round_to(api->bits, i % 3 == 1 ? random_scaled(least, most)
				: random_scaled(scale, scale));
		distance_edge(&exact, e, 0, 0);
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			const double got = of(api)->line_radius(powers[p], e);
			if (!mpfr_zero_p(exact.value[p])
				&& mpfr_get_exp(exact.value[p]) >= exponent_of_infinity(api))
				continue;
			representable++;
			finite += isfinite(got) != 0;
			expect(!isnan(got), "k = %d: (%a,%a) -> (%a,%a) is NaN, not %g", powers[p],
				e[X0], e[Y0], e[X1], e[Y1], mpfr_get_d(exact.value[p], MPFR_RNDN));
		}
	}
	check_end();
	printf("# extremes, %s: %ld of %ld results finite\n", api->name, finite, representable);
	distance_clear(&exact);
}

static void test_nonfinite(const Api *api)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	check_begin("edges with NaN and infinity, %s", api->name);
	for (int i = 0; i < 20000; i++) {
		double e[SIDES];
		fill_edge(api, (size_t)i % CLASSES, e);
		e[random_int(0, SIDES - 1)] = bad[i % 3];
		if (random_int(0, 3) == 0)
			e[random_int(0, SIDES - 1)] = bad[random_int(0, 2)];
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			const double got = of(api)->line_radius(powers[p], e);
			expect(!isfinite(got), "k = %d: (%g,%g) -> (%g,%g) is %g", powers[p], e[X0],
				e[Y0], e[X1], e[Y1], got);
		}
		const double distance = of(api)->line_distance(e);
		expect(!isfinite(distance), "(%g,%g) -> (%g,%g) is %g", e[X0], e[Y0], e[X1], e[Y1],
			distance);
	}
	check_end();
}

static void test_other_powers(const Api *api)
{
	static const int other[] = { INT_MIN, -5, -3, -2, 0, 2, 4, 6, 7, 9, 65, 255, 257, INT_MAX };
	const double e[SIDES] = { 1, 2, -3, 5 };
	Ring ring = ring_new(30);
	check_begin("other powers are NaN, %s", api->name);
	ring_star(&ring, 0, 0, 1);
	ring_pack(api, &ring);
	for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
		expect(isnan(of(api)->line_radius(other[i], e)), "edge, k = %d", other[i]);
		expect(isnan(of(api)->radius(other[i], &ring, 0, 0)), "ring, k = %d", other[i]);
	}
	check_end();
	ring_free(&ring);
}

/* Rings. */

typedef void FillRing(const Api *api, Ring *ring, double c[2]);

static void ring_cloud(const Api *api, Ring *ring, double c[2])
{
	(void)api;
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = random_real(-1, 1);
		ring->y[i] = random_real(-1, 1);
	}
	c[0] = random_int(0, 1) ? 0 : random_real(-2, 2);
	c[1] = random_int(0, 1) ? 0 : random_real(-2, 2);
}

static void ring_about(const Api *api, Ring *ring, double c[2])
{
	(void)api;
	c[0] = random_real(-1000, 1000);
	c[1] = random_real(-1000, 1000);
	ring_star(ring, c[0], c[1], 1);
}

static void ring_beside(const Api *api, Ring *ring, double c[2])
{
	(void)api;
	ring_star(ring, random_real(-1, 1), 3, 1);
	c[0] = random_real(-300, 300);
	c[1] = random_real(-1, 1);
}

/* A grid, so that the centre comes to lie on edges and vertices. */
static void ring_grid(const Api *api, Ring *ring, double c[2])
{
	(void)api;
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = random_int(-3, 3);
		ring->y[i] = random_int(-3, 3);
	}
	c[0] = random_int(-3, 3);
	c[1] = random_int(-3, 3);
}

/* The edges of all classes, joined. */
static void ring_classes(const Api *api, Ring *ring, double c[2])
{
	for (size_t i = 0; i < ring->n; i += 2) {
		double e[SIDES];
		size_t kind = (size_t)random_int(0, CLASSES - 1);
		fill_edge(api, classes[kind].fill == fill_scale ? 0 : kind, e);
		for (size_t j = 0; j < 2 && i + j < ring->n; j++) {
			ring->x[i + j] = e[2 * j];
			ring->y[i + j] = e[2 * j + 1];
		}
	}
	c[0] = c[1] = 0;
}

static const struct {
	const char *name;
	FillRing *fill;
} kinds[] = {
	{ "clouds", ring_cloud }, { "about the centre", ring_about },
	{ "beside the centre", ring_beside }, { "grids", ring_grid },
	{ "all classes", ring_classes }
};

enum { KINDS = sizeof kinds / sizeof *kinds };

static void fill_ring(const Api *api, size_t kind, Ring *ring, double c[2])
{
	kinds[kind].fill(api, ring, c);
	ring_pack(api, ring);
	c[0] = round_to(api->bits, c[0]);
	c[1] = round_to(api->bits, c[1]);
}

/* Of a ring and one power: the integral, sum |I_i|, and what rounding p - c can change, in u. */
typedef struct {
	mpfr_t value, weight;
	double moved;
} Whole;

static void edge_of(const Ring *ring, size_t i, double e[SIDES])
{
	const size_t next = i + 1 < ring->n ? i + 1 : 0;
	e[X0] = ring->x[i];
	e[Y0] = ring->y[i];
	e[X1] = ring->x[next];
	e[Y1] = ring->y[next];
}

static double moved_by(int k, const double e[SIDES], const double c[2])
{
	const double r0 = hypot(e[X0] - c[0], e[Y0] - c[1]), r1 = hypot(e[X1] - c[0], e[Y1] - c[1]);
	return sqrt(2) * pow(fmax(r0, r1), k + 1) * hypot(e[X1] - e[X0], e[Y1] - e[Y0]);
}

static void exact_ring(const Ring *ring, const double c[2], Whole out[DISTANCE_POWERS])
{
	Distances exact;
	distance_init(&exact);
	for (int p = 0; p < DISTANCE_POWERS; p++) {
		mpfr_inits2(DISTANCE_BITS, out[p].value, out[p].weight, (mpfr_ptr)0);
		mpfr_set_zero(out[p].value, 1);
		mpfr_set_zero(out[p].weight, 1);
		out[p].moved = 0;
	}
	for (size_t i = 0; i < ring->n; i++) {
		double e[SIDES];
		edge_of(ring, i, e);
		distance_edge(&exact, e, c[0], c[1]);
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			mpfr_add(out[p].value, out[p].value, exact.value[p], MPFR_RNDN);
			mpfr_abs(exact.value[p], exact.value[p], MPFR_RNDN);
			mpfr_add(out[p].weight, out[p].weight, exact.value[p], MPFR_RNDN);
			if (c[0] != 0 || c[1] != 0)
				out[p].moved += moved_by(powers[p], e, c);
		}
	}
	distance_clear(&exact);
}

static long ring_steps(const Api *api, size_t n)
{
	const size_t lanes = ring_lanes(api, n);
	long steps = 28 + (long)((n + lanes - 1) / lanes) - 1;
	for (size_t half = lanes / 2; half > 0; half /= 2)
		steps++;
	return steps;
}

static void expect_ring(const Api *api, const Ring *ring, int k, double got, const Whole *exact,
	const char *target)
{
	mpfr_t off, most;
	mpfr_inits2(DISTANCE_BITS, off, most, (mpfr_ptr)0);
	mpfr_mul_d(most, exact->weight, gamma_of(ring_steps(api, ring->n), api->bits), MPFR_RNDU);
	mpfr_add_d(most, most, ldexp(exact->moved, -api->bits), MPFR_RNDU);
	if (expect(isfinite(got), "n = %zu, k = %d, %s: %g", ring->n, k, target, got)) {
		mpfr_d_sub(off, got, exact->value, MPFR_RNDN);
		mpfr_abs(off, off, MPFR_RNDN);
		expect(mpfr_cmp(off, most) <= 0, "n = %zu, k = %d, %s: %.17g, exact %.17g, off by "
			"%g, allowed %g", ring->n, k, target, got,
			mpfr_get_d(exact->value, MPFR_RNDN), mpfr_get_d(off, MPFR_RNDN),
			mpfr_get_d(most, MPFR_RNDN));
	}
	mpfr_clears(off, most, (mpfr_ptr)0);
}

static void test_rings(const Api *api, size_t kind)
{
	static const size_t sizes[] = { 3, 4, 5, 9, 16, 23, 24, 25, 31, 48, 49, 100, 257, 1000 };
	enum { SIZES = sizeof sizes / sizeof *sizes };
	check_begin("rings within their bound: %s, %s", kinds[kind].name, api->name);
	for (size_t i = 0; i < 3 * SIZES; i++) {
		Ring ring = ring_new(sizes[i % SIZES]);
		Whole exact[DISTANCE_POWERS];
		double c[2];
		fill_ring(api, kind, &ring, c);
		exact_ring(&ring, c, exact);
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			/* powers of 2^20 are too much for float */
			if (api->bits == 24 && kinds[kind].fill == ring_classes && powers[p] == 5)
				continue;
			for (int t = 0; t < target_count; t++) {
				ew_use_target(target_bit[t]);
				expect_ring(api, &ring, powers[p],
					of(api)->radius(powers[p], &ring, c[0], c[1]), &exact[p],
					ew_target_name(target_bit[t]));
			}
		}
		for (int p = 0; p < DISTANCE_POWERS; p++)
			mpfr_clears(exact[p].value, exact[p].weight, (mpfr_ptr)0);
		ring_free(&ring);
	}
	check_end();
	ew_use_target(0);
}

/* All targets but portable have the bits of fma. */
static void test_bits(const Api *api, size_t kind)
{
	check_begin("rings have the bits of fma: %s, %s", kinds[kind].name, api->name);
	for (size_t i = 0; i < 400; i++) {
		const size_t n = i < 100 ? i : i % 20 ? (size_t)random_int(3, 300)
			: (size_t)random_int(1000, 5000);
		double c[2];
		Ring ring = ring_new(n);
		fill_ring(api, kind, &ring, c);
		for (int t = 0; t < target_count; t++) {
			if (target_bit[t] == EW_PORTABLE || target_bit[t] == EW_FMA)
				continue;
			for (int p = 0; p < DISTANCE_POWERS; p++) {
				ew_use_target(target_bit[t]);
				const double got = of(api)->radius(powers[p], &ring, c[0], c[1]);
				expect(ew_use_target(EW_FMA) == EW_OK, "no fma to compare with");
				const double want = of(api)->radius(powers[p], &ring, c[0], c[1]);
				expect(identical(got, want) || (isnan(got) && isnan(want)),
					"n = %zu, k = %d, %s: %a, fma %a", n, powers[p],
					ew_target_name(target_bit[t]), got, want);
			}
		}
		ring_free(&ring);
	}
	check_end();
	ew_use_target(0);
}

/* Where squares overflow, but for k = -1 not the result. */
static void test_large(const Api *api, const char *target)
{
	check_begin("large rings, %s, %s", api->name, target);
	for (int i = 0; i < 100; i++) {
		Whole exact[DISTANCE_POWERS];
		Ring ring = ring_new((size_t)random_int(3, 60));
		const double scale = ldexp(1, exponent_of_infinity(api) - random_int(12, 24));
		double c[2];
		ring_cloud(api, &ring, c);
		for (size_t j = 0; j < ring.n; j++) {
			ring.x[j] = scale * (i % 4 ? ring.x[j] : 0.7);  /* or all in one point */
			ring.y[j] = scale * (i % 4 ? ring.y[j] : -0.2);
		}
		ring_pack(api, &ring);
		for (int j = 0; j < 2; j++)
			c[j] = round_to(api->bits, c[j] * scale);
		exact_ring(&ring, c, exact);
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			const double got = of(api)->radius(powers[p], &ring, c[0], c[1]);
			if (mpfr_zero_p(exact[p].weight))
				expect(got == 0, "k = %d: a point gives %g", powers[p], got);
			else if (powers[p] == -1)
				expect_ring(api, &ring, powers[p], got, &exact[p], target);
			else
				expect(!isfinite(got), "k = %d: %g", powers[p], got);
			mpfr_clears(exact[p].value, exact[p].weight, (mpfr_ptr)0);
		}
		ring_free(&ring);
	}
	check_end();
}

/* The polygon of n corners on a circle contains that of radius r cos(pi/n), inside the former. */
static void test_disc(const Api *api, const char *target)
{
	const double pi = 3.141592653589793;
	const size_t n = 20000;
	const double slack = ldexp((double)ring_steps(api, 1024) + 64, -api->bits);
	Ring ring = ring_new(n);
	check_begin("discs, %s, %s", api->name, target);
	for (int i = 0; i < 4; i++) {
		const double r = ldexp(1.25, 2 * i - 3), cx = i % 2 ? 0 : 96, cy = i % 2 ? 0 : -40;
		for (size_t j = 0; j < n; j++) {
			ring.x[j] = cx + r * cos(2 * pi * (double)j / (double)n);
			ring.y[j] = cy + r * sin(2 * pi * (double)j / (double)n);
		}
		ring_pack(api, &ring);
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			const int degree = powers[p] + 2;
			const double whole = 2 * pi / degree * pow(r, degree);
			const double inner = whole * pow(cos(pi / (double)n), degree);
			/* corners are off by u |p|, which the result feels degree times */
			const double off = whole * (slack + degree * ldexp(hypot(cx, cy) / r + 2,
				-api->bits));
			const double got = of(api)->radius(powers[p], &ring, cx, cy);
			expect(got >= inner - off && got <= whole + off,
				"k = %d, r = %g: %.17g, disc %.17g", powers[p], r, got, whole);
		}
		const double distance = of(api)->distance(&ring, cx, cy);
		expect(identical(distance, of(api)->radius(1, &ring, cx, cy)),
			"distance is not k = 1");
	}
	check_end();
	ring_free(&ring);
}

/* Vertex i of the ring once more, after itself. */
static Ring with_repeated(const Api *api, const Ring *ring, size_t at, size_t from)
{
	Ring more = ring_new(ring->n + 1);
	for (size_t i = 0; i < more.n; i++) {
		more.x[i] = ring->x[i < at ? i : i == at ? from : i - 1];
		more.y[i] = ring->y[i < at ? i : i == at ? from : i - 1];
	}
	ring_pack(api, &more);
	return more;
}

/* A vertex twice adds exactly 0; behind it other edges change lanes, so it must be a ring in one
 * lane, or the last vertex, which closes the ring. */
static void test_repeated(const Api *api, const char *target)
{
	check_begin("repeated vertices, %s, %s", api->name, target);
	for (int i = 0; i < 2000; i++) {
		const bool closing = i % 2;
		const size_t n = (size_t)(closing ? random_int(3, 120) : random_int(3, SHORT - 2));
		double c[2];
		Ring ring = ring_new(n);
		fill_ring(api, (size_t)i % KINDS, &ring, c);
		const size_t at = closing ? n : (size_t)random_int(1, (int)n - 1);
		Ring more = with_repeated(api, &ring, at, closing ? 0 : at - 1);
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			const double want = of(api)->radius(powers[p], &ring, c[0], c[1]);
			const double got = of(api)->radius(powers[p], &more, c[0], c[1]);
			expect(same_bits(got, want) || (!isfinite(got) && !isfinite(want)),
				"n = %zu, k = %d, vertex %zu: %a, not %a", n, powers[p], at, got,
				want);
		}
		ring_free(&more);
		ring_free(&ring);
	}
	check_end();
}

static void test_no_area(const Api *api, const char *target)
{
	check_begin("rings without area, %s, %s", api->name, target);
	for (size_t n = 0; n < 60; n++) {
		double c[2];
		Ring ring = ring_new(n);
		ring_cloud(api, &ring, c);
		for (size_t i = n < 3 ? n : 0; i < n; i++) {     /* all in one point, or on c */
			ring.x[i] = n % 2 ? 0.7 : c[0];
			ring.y[i] = n % 2 ? -0.3 : c[1];
		}
		ring_pack(api, &ring);
		c[0] = round_to(api->bits, c[0]);
		c[1] = round_to(api->bits, c[1]);
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			const double got = of(api)->radius(powers[p], &ring, c[0], c[1]);
			expect(got == 0, "n = %zu, k = %d: %g", n, powers[p], got);
		}
		ring_free(&ring);
	}
	check_end();
}

static void test_ring_nonfinite(const Api *api, const char *target)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	check_begin("rings with NaN and infinity, %s, %s", api->name, target);
	for (int i = 0; i < 1000; i++) {
		double c[2];
		Ring ring = ring_new((size_t)random_int(3, 80));
		ring_cloud(api, &ring, c);
		if (i % 5)
			(random_int(0, 1) ? ring.x : ring.y)[random_int(0, (int)ring.n - 1)] =
				bad[i % 3];
		else
			c[i / 5 % 2] = bad[i % 3];
		ring_pack(api, &ring);
		for (int p = 0; p < DISTANCE_POWERS; p++) {
			const double got = of(api)->radius(powers[p], &ring, c[0], c[1]);
			expect(!isfinite(got), "n = %zu, k = %d: %g", ring.n, powers[p], got);
		}
		ring_free(&ring);
	}
	check_end();
}

/* The reference itself: the closed form against quadrature, which gives up on edges that pass the
 * origin at less than 2^-40 of their length. */

static void expect_agreement(const Distances *closed, const Distances *quadrature,
	const double e[SIDES])
{
	mpfr_t off;
	mpfr_init2(off, DISTANCE_BITS);
	for (int p = 0; p < DISTANCE_POWERS; p++) {
		mpfr_sub(off, quadrature->value[p], closed->value[p], MPFR_RNDN);
		expect(mpfr_zero_p(off) || mpfr_get_exp(off) < mpfr_get_exp(closed->value[p]) - 200,
			"k = %d: (%a,%a) -> (%a,%a) differs by 2^%ld of 2^%ld", powers[p], e[X0],
			e[Y0], e[X1], e[Y1], (long)mpfr_get_exp(off),
			(long)mpfr_get_exp(closed->value[p]));
	}
	mpfr_clear(off);
}

static void test_reference(void)
{
	Distances closed, quadrature;
	int compared = 0;
	distance_init(&closed);
	distance_init(&quadrature);
	check_begin("the closed form of the reference against quadrature");
	for (int i = 0; i < 200; i++) {
		double e[SIDES];
		const double cx = i % 3 ? 0 : 0.5, cy = i % 3 ? 0 : -0.25;
		fill_edge(&apis[0], (size_t)i % CLASSES, e);
		const double length = hypot(e[X1] - e[X0], e[Y1] - e[Y0]);
		const double about[] = { e[X0] - cx, e[Y0] - cy, e[X1] - cx, e[Y1] - cy };
		if (!(fabs(cross(about)) > 0x1p-40 * length * length))
			continue;
		distance_edge(&closed, e, cx, cy);
		distance_quadrature(&quadrature, e, cx, cy);
		expect_agreement(&closed, &quadrature, e);
		compared++;
	}
	expect(compared >= 100, "only %d edges compared", compared);
	check_end();
	distance_clear(&closed);
	distance_clear(&quadrature);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	list_targets();
	test_reference();
	for (int i = 0; i < APIS; i++) {
		for (size_t c = 0; c < CLASSES; c++)
			test_class(&apis[i], c);
		test_reversed(&apis[i]);
		test_degenerate(&apis[i]);
		test_extremes(&apis[i]);
		test_nonfinite(&apis[i]);
		test_other_powers(&apis[i]);
		for (size_t k = 0; k < KINDS; k++) {
			test_rings(&apis[i], k);
			test_bits(&apis[i], k);
		}
	}
	for_each_target(test_disc);
	for_each_target(test_large);
	for_each_target(test_repeated);
	for_each_target(test_no_area);
	for_each_target(test_ring_nonfinite);
	return check_finish();
}

/* Windows: the area that one edge bounds within a rectangle.
 *
 * ew_line_coverage is held against an exact fraction (window_area.c) that in turn must agree with
 * clipping (window_reference.c), over millions of edges made to hit the corners, borders, ulps and
 * ranges, and ew_below must be its size. Each edge is also made a ring for ew_coverage under every
 * target. Named tests ask for each degenerate case by itself. The bound stands in windows.h.
 */
#include "windows.h"

enum { CASES = 3000000 };

static double random_sign(void)
{
	return random_int(0, 1) ? 1 : -1;
}

/* v or a neighbour of it, up to two steps away. */
static double near(const Api *api, double v)
{
	for (int steps = random_int(-2, 2); steps != 0; steps += steps < 0 ? 1 : -1)
		v = api->bits == 24 ? (double)nextafterf((float)v, (float)steps * FLT_MAX)
			: nextafter(v, steps * DBL_MAX);
	return v;
}

/* ---- Degenerate cases, one row of the table each ---- */

static const double unit[SIDES] = { 0, 1, 0, 1 };

/* The value, its reverse and ew_below must be what the row says, all bits. */
static void expect_exactly(const Api *api, const double e[SIDES], const double r[SIDES],
	double want)
{
	const double back[SIDES] = { e[X1], e[Y1], e[X0], e[Y0] };
	const double got = windows_of(api)->line(e, r), reverse = windows_of(api)->line(back, r);
	expect(got == want && reverse == -want,
		"(%a,%a) -> (%a,%a) in %a..%a, %a..%a is %a, reversed %a, must be %a", e[X0], e[Y0],
		e[X1], e[Y1], r[U0], r[U1], r[V0], r[V1], got, reverse, want);
	expect(windows_of(api)->below(e, r) == fabs(want)
		&& windows_of(api)->below(back, r) == fabs(want), "below (%a,%a) -> (%a,%a) is %a",
		e[X0], e[Y0], e[X1], e[Y1], windows_of(api)->below(e, r));
}

static void random_rectangle(const Api *api, double r[SIDES])
{
	for (int i = 0; i < SIDES; i += 2) {
		r[i] = round_to(api->bits, random_real(-4, 4));
		r[i + 1] = round_to(api->bits, r[i] + random_real(0.1, 3));
	}
}

static void row_vertical(const Api *api, const double r[SIDES])
{
	const double x[] = { r[U0], r[U1], random_real(r[U0], r[U1]), random_real(-9, 9) };
	for (int i = 0; i < 4; i++) {
		const double at = round_to(api->bits, x[i]);
		const double e[SIDES] = { at, round_to(api->bits, random_real(-9, 9)), at,
			round_to(api->bits, random_real(-9, 9)) };
		expect_exactly(api, e, r, 0);
	}
}

static void row_point(const Api *api, const double r[SIDES])
{
	const double x = round_to(api->bits, random_int(0, 2) ? random_real(-5, 5) : r[U0]);
	const double y = round_to(api->bits, random_int(0, 2) ? random_real(-5, 5) : r[V0]);
	const double e[SIDES] = { x, y, x, y };
	expect_exactly(api, e, r, 0);
}

static void row_low(const Api *api, const double r[SIDES])
{
	const double y = random_int(0, 1) ? r[V0] : round_to(api->bits, r[V0] - random_real(0, 9));
	const double e[SIDES] = { round_to(api->bits, random_real(-9, 9)), y,
		round_to(api->bits, random_real(-9, 9)), y };
	expect_exactly(api, e, r, 0);
}

/* -(xr - xl) h, rounded as the precision does: two differences and a product. */
static void expect_strip(const Api *api, const double e[SIDES], const double r[SIDES], double h)
{
	const double low = fmin(e[X0], e[X1]), high = fmax(e[X0], e[X1]);
	const double w = round_to(api->bits, clamped(r[U1], low, high) - clamped(r[U0], low, high));
	const double area = round_to(api->bits, w * round_to(api->bits, h));
	expect_exactly(api, e, r, e[X0] < e[X1] ? -area : area);
}

static void row_inside(const Api *api, const double r[SIDES])
{
	const double y = clamped(round_to(api->bits, random_real(r[V0], r[V1])), r[V0], r[V1]);
	const double e[SIDES] = { round_to(api->bits, random_real(-9, 9)), y,
		round_to(api->bits, random_real(-9, 9)), y };
	expect_strip(api, e, r, y - r[V0]);
}

static void row_high(const Api *api, const double r[SIDES])
{
	const double y = random_int(0, 1) ? r[V1] : round_to(api->bits, r[V1] + random_real(0, 9));
	const double e[SIDES] = { round_to(api->bits, random_real(-9, 9)), y,
		round_to(api->bits, random_real(-9, 9)), y };
	expect_strip(api, e, r, r[V1] - r[V0]);
}

static void row_beside(const Api *api, const double r[SIDES])
{
	const bool right = random_int(0, 1), touches = random_int(0, 1);
	const double border = right ? r[U1] : r[U0];
	const double away = right ? random_real(0, 9) : random_real(-9, 0);
	const double e[SIDES] = {
		touches ? border : round_to(api->bits, border + away),
		round_to(api->bits, random_real(-9, 9)), round_to(api->bits, border + 2 * away),
		round_to(api->bits, random_real(-9, 9))
	};
	expect_exactly(api, e, r, 0);
}

/* On the diagonal of the unit cell, which may go on outside by lengths whose quotients are exact:
 * the cell has half of it, one above nothing, one below all, one beside what x leaves. */
static void row_diagonal(const Api *api, const double r[SIDES])
{
	(void)r;
	const double size = ldexp(1, random_int(0, 6)), far = random_int(0, (int)size - 1);
	const double top = size - far;
	const double e[SIDES] = { -far, -far, top, top };
	const double falling[SIDES] = { -far, 1 + far, top, 1 - top };
	static const double left[] = { -1, 0, 0, 1 }, above[] = { 0, 1, 1, 2 };
	static const double right[] = { 1, 2, 0, 1 }, under[] = { 0, 1, -1, 0 };
	expect_exactly(api, e, unit, -0.5);
	expect_exactly(api, falling, unit, -0.5);
	expect_exactly(api, e, left, 0);
	expect_exactly(api, e, above, 0);
	expect_exactly(api, e, under, -1);
	expect_exactly(api, e, right, top > 1 ? -1 : 0);
}

/* Through a corner from outside to the corner opposite, or touching one. */
static void row_corner(const Api *api, const double r[SIDES])
{
	const double n = random_int(1, 30);
	const double steep[SIDES] = { -1, -n, 1, n }, touch[SIDES] = { -n, 0, 1, 1 + 1 / n };
	const double cell[SIDES] = { 0, 1, 0, n }, under[SIDES] = { 1, n + 1, 0, 1 };
	(void)r;
	expect_exactly(api, steep, cell, -n / 2);
	expect_exactly(api, (double[]){ 0, 1, n, 1 + 1 / n }, under, -(n - 1));
	expect(fabs(windows_of(api)->line(touch, unit)) <= 1, "touching a corner: %g",
		windows_of(api)->line(touch, unit));
}

/* The mean height stays within 0 and H, and the value within what one rounding of w H leaves; among
 * denormals, where halving rounds, one of them more. */
static void row_nearly(const Api *api, const double r[SIDES], bool horizontal)
{
	const double denormal = random_int(1, 9) * api->denormal;
	double x = random_int(0, 2) ? random_real(r[U0], r[U1]) : random_int(0, 1) ? r[U0] : r[U1];
	double y = random_int(0, 2) ? random_real(r[V0], r[V1]) : random_int(0, 1) ? r[V0] : r[V1];
	const bool at_zero = random_int(0, 1);
	x = at_zero && !horizontal ? 0 : round_to(api->bits, x);
	y = at_zero && horizontal ? 0 : round_to(api->bits, y);
	double e[SIDES] = { x, y, x, y }, box[SIDES] = { r[U0], r[U1], r[V0], r[V1] };
	if (at_zero) {          /* a window across the zero, or beginning at it */
		const int side = horizontal ? V0 : U0;
		box[side] = random_int(0, 1) ? 0 : -denormal;
		box[side + 1] = random_int(0, 1) ? 1 : round_to(api->bits, denormal / 2);
	}
	const int fixed = horizontal ? Y0 : X0;
	e[fixed] = at_zero ? random_sign() * denormal : near(api, e[fixed]);
	e[1 - fixed] = round_to(api->bits, random_real(-9, 9));
	e[3 - fixed] = round_to(api->bits, random_real(-9, 9));
	const double got = windows_of(api)->line(e, box);
	const double low = fmin(e[X0], e[X1]), high = fmax(e[X0], e[X1]);
	const double w = clamped(box[U1], low, high) - clamped(box[U0], low, high);
	const double most = round_to(api->bits, round_to(api->bits, w)
		* round_to(api->bits, box[V1] - box[V0]));
	const double more = most < ldexp(api->denormal, api->bits) ? api->denormal : 0;
	expect(fabs(got) <= most + more && (got == 0 || (got < 0) == (e[X0] < e[X1])),
		"(%a,%a) -> (%a,%a) in %a..%a, %a..%a is %a, of %a at most", e[X0], e[Y0], e[X1],
		e[Y1], box[U0], box[U1], box[V0], box[V1], got, most);
}

static void row_flat(const Api *api, const double r[SIDES])
{
	row_nearly(api, r, true);
}

static void row_steep(const Api *api, const double r[SIDES])
{
	row_nearly(api, r, false);
}

static void row_huge(const Api *api, const double r[SIDES])
{
	double e[SIDES];
	for (int i = 0; i < SIDES; i++)
		e[i] = random_int(0, 3) ? random_sign() * largest(api) / 4
			: round_to(api->bits, random_real(-9, 9));
	const double got = windows_of(api)->line(e, r);
	const double most = (r[U1] - r[U0]) * (r[V1] - r[V0]);
	expect(fabs(got) <= most * (1 + ldexp(4, -api->bits)), "(%a,%a) -> (%a,%a) is %a", e[X0],
		e[Y0], e[X1], e[Y1], got);
	expect(fabs(windows_of(api)->line(e, unit)) <= 1, "unit: (%a,%a) -> (%a,%a) is %a", e[X0],
		e[Y0], e[X1], e[Y1], windows_of(api)->line(e, unit));
}

static void row_empty(const Api *api, const double r[SIDES])
{
	double e[SIDES], box[SIDES] = { r[U0], r[U1], r[V0], r[V1] };
	const int kind = random_int(0, 2);
	for (int i = 0; i < SIDES; i++)
		e[i] = random_int(0, 3) ? round_to(api->bits, random_real(-9, 9))
			: random_sign() * largest(api) / 4;
	if (kind != 1)
		box[U1] = box[U0];
	if (kind != 0)
		box[V1] = box[V0];
	expect_exactly(api, e, box, 0);
}

typedef void DegenerateRow(const Api *api, const double r[SIDES]);

static const struct {
	const char *name;
	DegenerateRow *test;
} degenerate[] = {
	{ "vertical edges are exactly 0", row_vertical },
	{ "points are exactly 0", row_point },
	{ "horizontal edges below or on v0 are exactly 0", row_low },
	{ "horizontal edges inside are width times height, no more", row_inside },
	{ "horizontal edges on or above v1 are the strip", row_high },
	{ "edges beside, or touching with an end, are exactly 0", row_beside },
	{ "diagonals: half of the cell, neighbours nothing", row_diagonal },
	{ "through corners", row_corner },
	{ "nearly horizontal: the mean stays within the window", row_flat },
	{ "nearly vertical: the mean stays within the window", row_steep },
	{ "coordinates to a quarter of the largest number", row_huge },
	{ "empty windows are 0", row_empty }
};

static void test_degenerate(const Api *api, size_t row)
{
	double r[SIDES];
	check_begin("%s, %s", degenerate[row].name, api->name);
	for (int i = 0; i < 20000; i++) {
		random_rectangle(api, r);
		degenerate[row].test(api, r);
	}
	check_end();
}

/* ---- Adversarial edges ---- */

typedef void Fill(const Api *api, double e[SIDES], double r[SIDES]);

static void fill_random(const Api *api, double e[SIDES], double r[SIDES])
{
	random_rectangle(api, r);
	for (int i = 0; i < SIDES; i++)
		e[i] = random_real(-8, 8);
}

static void fill_pixels(const Api *api, double e[SIDES], double r[SIDES])
{
	(void)api;
	for (int i = 0; i < SIDES; i += 2) {
		r[i] = random_int(-3, 3);
		r[i + 1] = r[i] + 1;
	}
	for (int i = 0; i < SIDES; i++)
		e[i] = random_int(0, 2) ? random_real(-4, 5) : random_int(-8, 10) * 0.5;
}

/* Ends on borders and corners, or up to two steps beside them. */
static void fill_snapped(const Api *api, double e[SIDES], double r[SIDES])
{
	fill_random(api, e, r);
	for (int i = 0; i < SIDES; i++) {
		const double border = r[(i % 2 ? V0 : U0) + random_int(0, 1)];
		if (random_int(0, 3))
			e[i] = random_int(0, 1) ? border : near(api, border);
	}
}

static void fill_horizontal(const Api *api, double e[SIDES], double r[SIDES])
{
	fill_snapped(api, e, r);
	e[Y1] = random_int(0, 1) ? e[Y0] : near(api, round_to(api->bits, e[Y0]));
}

static void fill_vertical(const Api *api, double e[SIDES], double r[SIDES])
{
	fill_snapped(api, e, r);
	e[X1] = random_int(0, 3) ? near(api, round_to(api->bits, e[X0])) : e[X0];
}

/* An edge of a few ulps. */
static void fill_ulps(const Api *api, double e[SIDES], double r[SIDES])
{
	fill_snapped(api, e, r);
	for (int i = 0; i < 2; i++)
		e[i + 2] = near(api, round_to(api->bits, e[i]));
}

/* Around the origin, where ulps are denormals. */
static void fill_denormal(const Api *api, double e[SIDES], double r[SIDES])
{
	fill_snapped(api, e, r);
	for (int i = 0; i < SIDES; i++) {
		if (random_int(0, 2) == 0)
			r[i] = random_int(0, 3) * (i % 2 ? api->denormal : -api->denormal);
		if (random_int(0, 1))
			e[i] = random_int(-4, 4) * api->denormal;
	}
}

/* Each coordinate at its own scale. */
static void fill_mixed(const Api *api, double e[SIDES], double r[SIDES])
{
	const int least = api->bits == 24 ? -149 : -1074, most = api->bits == 24 ? 100 : 997;
	fill_random(api, e, r);
	for (int i = 0; i < SIDES; i++) {
		if (random_int(0, 2))
			e[i] = random_scaled(least, most);
	}
}

/* All at one scale, 1e-300 to 1e300; areas stay in range. */
static void fill_scaled(const Api *api, double e[SIDES], double r[SIDES])
{
	const int most = api->bits == 24 ? 60 : 500;
	const double scale = ldexp(1, random_int(-most, most));
	fill_snapped(api, e, r);
	for (int i = 0; i < SIDES; i++) {
		e[i] *= scale;
		r[i] *= scale;
	}
}

static void fill_huge(const Api *api, double e[SIDES], double r[SIDES])
{
	fill_snapped(api, e, r);
	for (int i = 0; i < SIDES; i++) {
		if (random_int(0, 2))
			e[i] = random_sign() * largest(api) / 4
				* (random_int(0, 1) ? 1 : random_real(0, 1));
	}
	if (random_int(0, 7) == 0) {
		r[U0] = -ldexp(largest(api), -4);
		r[U1] = ldexp(largest(api), -4);
	}
}

/* Windows thin or empty, in one direction or both. */
static void fill_thin(const Api *api, double e[SIDES], double r[SIDES])
{
	fill_random(api, e, r);
	for (int i = 0; i < SIDES; i += 2) {
		const double step = random_int(0, 2) * random_int(0, 1) * ldexp(1, -api->bits);
		if (random_int(0, 2))
			r[i + 1] = r[i] + 4 * step;
	}
	for (int i = 0; i < SIDES; i++) {
		if (random_int(0, 1))
			e[i] = near(api, r[i % 2 ? V0 : U0]);
	}
}

/* A cell far from the origin, and short edges there. */
static void fill_far(const Api *api, double e[SIDES], double r[SIDES])
{
	const double away = ldexp(random_sign(), random_int(0, api->bits - 4));
	fill_pixels(api, e, r);
	for (int i = 0; i < SIDES; i++) {
		e[i] += away;
		r[i] += away;
	}
}

static const struct {
	const char *name;
	Fill *fill;
} classes[] = {
	{ "random", fill_random }, { "pixels", fill_pixels },
	{ "snapped to borders and corners", fill_snapped }, { "horizontal", fill_horizontal },
	{ "vertical", fill_vertical }, { "a few ulps long", fill_ulps },
	{ "denormal", fill_denormal }, { "every scale", fill_mixed },
	{ "scaled together", fill_scaled }, { "up to a quarter of the largest", fill_huge },
	{ "thin windows", fill_thin }, { "far away", fill_far }
};

enum { CLASSES = sizeof classes / sizeof *classes };

static void order(double *low, double *high)
{
	if (*low > *high) {
		const double swap = *low;
		*low = *high;
		*high = swap;
	}
}

static void fill_case(const Api *api, size_t c, double e[SIDES], double r[SIDES])
{
	classes[c].fill(api, e, r);
	for (int i = 0; i < SIDES; i++) {
		e[i] = round_to(api->bits, e[i]);
		r[i] = round_to(api->bits, r[i]);
	}
	order(&r[U0], &r[U1]);
	order(&r[V0], &r[V1]);
}

/* What does not fit is not judged, except that it is no NaN. */
static bool expect_close(const Api *api, WindowArea *area, double got, const double e[SIDES],
	const double r[SIDES], const char *how, double *worst)
{
	const double bound = window_bound(api, e, r);
	if (!(fabs(window_area_value(area)) + bound < largest(api)))
		return expect(!isnan(got), "%s: (%a,%a) -> (%a,%a) is NaN", how, e[X0], e[Y0],
			e[X1], e[Y1]);
	const double error = window_area_error(area, got);
	if (bound > 0)
		*worst = fmax(*worst, error / bound);
	return expect(error <= bound,
		"%s: (%a,%a) -> (%a,%a) in %a..%a, %a..%a is %a, exact %.17g, off by %g, not %g",
		how, e[X0], e[Y0], e[X1], e[Y1], r[U0], r[U1], r[V0], r[V1], got,
		window_area_value(area), error, bound);
}

/* Every target, alone in one lane and once in each. */
static void expect_targets(const Api *api, WindowArea *area, Ring ring[2], const double e[SIDES],
	const double r[SIDES], double *worst)
{
	if (fabs(window_area_value(area)) > largest(api) / 64)
		return;
	for (int wide = 0; wide < 2; wide++) {
		const size_t n = ring[wide].n;
		edge_ring(api, &ring[wide], e, r[V0]);
		for (int t = 0; t < target_count; t++) {
			ew_use_target(target_bit[t]);
			const double got = windows_of(api)->ring(ring[wide].px, ring[wide].py, n,
				r) / (double)(n / 4);
			expect_close(api, area, got, e, r, ew_target_name(target_bit[t]), worst);
		}
	}
	ew_use_target(0);
}

static void test_class(const Api *api, size_t c)
{
	double e[SIDES], r[SIDES], worst = 0, worst_ring = 0;
	Ring ring[2] = { ring_new(4), ring_new(api->bits == 24 ? 64 : 32) };
	WindowArea area;
	window_area_init(&area);
	check_begin("edges within the bound, reversal: %s, %s", classes[c].name, api->name);
	for (int i = 0; i < CASES / CLASSES; i++) {
		fill_case(api, c, e, r);
		const double back[SIDES] = { e[X1], e[Y1], e[X0], e[Y0] };
		const double got = windows_of(api)->line(e, r);
		const double reverse = windows_of(api)->line(back, r);
		window_area(&area, e, r);
		expect_close(api, &area, got, e, r, "line", &worst);
		expect(same_bits(reverse, -got), "(%a,%a) -> (%a,%a) in %a..%a, %a..%a is %a and "
			"reversed %a", e[X0], e[Y0], e[X1], e[Y1], r[U0], r[U1], r[V0], r[V1],
			got, reverse);
		expect(same_bits(windows_of(api)->below(e, r), fabs(got))
			&& same_bits(windows_of(api)->below(back, r), fabs(got)),
			"below (%a,%a) -> (%a,%a) in %a..%a, %a..%a is %a, not %a", e[X0], e[Y0],
			e[X1], e[Y1], r[U0], r[U1], r[V0], r[V1], windows_of(api)->below(e, r),
			fabs(got));
		if (i % 4 == 0)
			expect_targets(api, &area, ring, e, r, &worst_ring);
	}
	check_end();
	printf("# %s, %s: %.3f of the bound, in rings %.3f\n", classes[c].name, api->name, worst,
		worst_ring);
	window_area_clear(&area);
	ring_free(&ring[0]);
	ring_free(&ring[1]);
}

/* ---- NaN ---- */

static void test_nan(const Api *api)
{
	check_begin("NaN in any place comes out, %s", api->name);
	for (int i = 0; i < 40000; i++) {
		double e[SIDES], r[SIDES];
		fill_case(api, (size_t)i % CLASSES, e, r);
		*(i % 8 < 4 ? &e[i % 4] : &r[i % 4]) = NAN;
		expect(isnan(windows_of(api)->line(e, r)) && isnan(windows_of(api)->below(e, r)),
			"(%a,%a) -> (%a,%a) in %a..%a, %a..%a is %a, below %a", e[X0], e[Y0], e[X1],
			e[Y1], r[U0], r[U1], r[V0], r[V1], windows_of(api)->line(e, r),
			windows_of(api)->below(e, r));
	}
	check_end();
}

/* The fraction of window_area.c against clipping. */
static void test_references(const Api *api)
{
	double e[SIDES], r[SIDES];
	WindowArea area;
	mpq_t value, fraction;
	mpq_inits(value, fraction, NULL);
	window_area_init(&area);
	check_begin("the fraction is what clipping leaves, %s", api->name);
	for (int i = 0; i < 6000; i++) {
		fill_case(api, (size_t)i % CLASSES, e, r);
		WindowFilter *filter = window_rectangle(r[U0], r[U1], r[V0], r[V1]);
		window_edge(value, filter, e, 0, 0);
		window_area(&area, e, r);
		mpq_set_num(fraction, area.top);
		mpq_set_den(fraction, area.bottom);
		mpq_canonicalize(fraction);
		mpq_div_2exp(fraction, fraction, (mp_bitcnt_t)(2 * area.shift));
		expect(mpq_equal(value, fraction), "(%a,%a) -> (%a,%a) in %a..%a, %a..%a is %g, "
			"not %g", e[X0], e[Y0], e[X1], e[Y1], r[U0], r[U1], r[V0], r[V1],
			window_area_value(&area), mpq_get_d(value));
		window_free(filter);
	}
	check_end();
	window_area_clear(&area);
	mpq_clears(value, fraction, NULL);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	list_targets();
	for (int a = 0; a < APIS; a++) {
		test_references(&apis[a]);
		for (size_t row = 0; row < sizeof degenerate / sizeof *degenerate; row++)
			test_degenerate(&apis[a], row);
		for (size_t c = 0; c < CLASSES; c++)
			test_class(&apis[a], c);
		test_nan(&apis[a]);
	}
	return check_finish();
}

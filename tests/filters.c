/* Filters: integrals of a filter over the region of a ring, and what single edges add to them.
 *
 * Compiled twice, for the built-in filters and, with CUSTOM_FILTERS, for the files in tests/filters
 * as gen emits them. Edges and rings are held against exact clipping by the pieces of the filter as
 * the test defines it, within the bound of filters.h; single edges also as rings, on every target.
 * Reversed edges negate bit for bit, edges beside the support are exactly 0, all targets with fused
 * operations have the same bits, and a NaN anywhere comes out.
 */
#include "guarded.h"

#include "filters.h"

enum { EDGES = 300, RINGS = 60, FREE = 40000, MOST = 100 };

/* ---- Edges ---- */

typedef void Fill(const Subject *s, double e[SIDES]);

static double across(const Subject *s, int axis, double more)
{
	return random_real(s->low[axis] - more, s->high[axis] + more);
}

static void fill_near(const Subject *s, double e[SIDES])
{
	for (int i = 0; i < SIDES; i++)
		e[i] = across(s, i % 2, 1);
}

/* Knots, where pieces meet, and halves. */
static double knot(const Subject *s, int axis)
{
	const WindowPiece *p = &s->definition->pieces[random_int(0, s->definition->count - 1)];
	const bool low = random_int(0, 1);
	if (random_int(0, 3) == 0)
		return random_int(-8, 8) * 0.5;
	return axis ? mpq_get_d(low ? p->y0 : p->y1) : mpq_get_d(low ? p->x0 : p->x1);
}

static void fill_knots(const Subject *s, double e[SIDES])
{
	for (int i = 0; i < SIDES; i++)
		e[i] = random_int(0, 2) ? knot(s, i % 2) : across(s, i % 2, 1);
}

static void fill_horizontal(const Subject *s, double e[SIDES])
{
	fill_knots(s, e);
	e[Y1] = random_int(0, 1) ? e[Y0] : e[Y0] * (1 + random_scaled(-50, -10));
}

static void fill_vertical(const Subject *s, double e[SIDES])
{
	fill_knots(s, e);
	e[X1] = random_int(0, 3) ? e[X0] * (1 + random_scaled(-50, -10)) : e[X0];
}

static void fill_short(const Subject *s, double e[SIDES])
{
	fill_knots(s, e);
	for (int i = 0; i < 2; i++)
		e[i + 2] = e[i] + random_scaled(-40, -2);
}

static void fill_long(const Subject *s, double e[SIDES])
{
	const double size = exp2(random_real(2, 20));
	fill_near(s, e);
	for (int i = random_int(0, 2); i < SIDES; i += 2)
		e[i] = random_real(-size, size);
}

static void fill_above(const Subject *s, double e[SIDES])
{
	fill_knots(s, e);
	e[Y0] = s->high[1] + random_int(0, 1) * random_real(0, 9);
	e[Y1] = s->high[1] + random_int(0, 1) * random_real(0, 9);
}

static const struct {
	const char *name;
	Fill *fill;
} classes[] = {
	{ "near", fill_near }, { "knots", fill_knots }, { "horizontal", fill_horizontal },
	{ "vertical", fill_vertical }, { "short", fill_short }, { "long", fill_long },
	{ "above", fill_above }
};

enum { CLASSES = sizeof classes / sizeof *classes };

/* About a centre, which is one of a pixel or anything. */
static void fill_edge(const Api *api, const Subject *s, size_t c, double e[SIDES], double at[2])
{
	classes[c].fill(s, e);
	for (int i = 0; i < 2; i++)
		at[i] = random_int(0, 2) ? random_int(-20, 20) + 0.5
			: round_to(api->bits, random_real(-20, 20));
	for (int i = 0; i < SIDES; i++)
		e[i] = round_to(api->bits, e[i] + at[i % 2]);
}

static void expect_edge(const Api *api, const Subject *s, double got, const mpq_t exact,
	const double e[SIDES], const double at[2], const char *how, double *worst)
{
	const double bound = filter_bound(api, s, e, at[0], at[1]);
	const double error = window_error(got, exact);
	expect(error <= bound, "%s: (%a,%a) -> (%a,%a) about (%a,%a) is %.17g, exact %.17g, off by "
		"%g, allowed %g", how, e[X0], e[Y0], e[X1], e[Y1], at[0], at[1], got,
		mpq_get_d(exact), error, bound);
	*worst = fmax(*worst, ldexp(error, api->bits));
}

/* The edge down to beneath the support and back, alone or once in each lane. */
static void expect_targets(const Api *api, const Subject *s, Ring ring[2], const mpq_t exact,
	const double e[SIDES], const double at[2], double *worst)
{
	const double floor = fmin(fmin(e[Y0], e[Y1]), round_to(api->bits, at[1] + s->low[1] - 1));
	for (int wide = 0; wide < 2; wide++) {
		edge_ring(api, &ring[wide], e, floor);
		for (int t = 0; t < target_count; t++) {
			const size_t n = ring[wide].n;
			ew_use_target(target_bit[t]);
			const double got = filter_of(s->row, api)->ring(ring[wide].px,
				ring[wide].py, n, at[0], at[1]) / (double)(n / 4);
			expect_edge(api, s, got, exact, e, at, ew_target_name(target_bit[t]),
				worst);
		}
	}
	ew_use_target(0);
}

static void test_edges(const Api *api, const Subject *s, size_t c)
{
	double e[SIDES], at[2], worst = 0;
	Ring ring[2] = { ring_new(4), ring_new(api->bits == 24 ? 64 : 32) };
	mpq_t exact;
	mpq_init(exact);
	check_begin("edges against clipping: %s, %s, %s", s->row->name, classes[c].name, api->name);
	for (int i = 0; i < EDGES; i++) {
		fill_edge(api, s, c, e, at);
		window_edge(exact, s->definition, e, at[0], at[1]);
		expect_edge(api, s, filter_of(s->row, api)->line(e, at[0], at[1]), exact, e, at,
			"line", &worst);
		expect_targets(api, s, ring, exact, e, at, &worst);
	}
	check_end();
	printf("# %s, %s, %s: off by %.1f u at most\n", s->row->name, classes[c].name, api->name,
		worst);
	ring_free(&ring[0]);
	ring_free(&ring[1]);
	mpq_clear(exact);
}

static void test_reversed(const Api *api, const Subject *s)
{
	const FilterFunctions *filter = filter_of(s->row, api);
	check_begin("reversed edges negate: %s, %s", s->row->name, api->name);
	for (int i = 0; i < FREE; i++) {
		double e[SIDES], at[2];
		fill_edge(api, s, (size_t)i % CLASSES, e, at);
		const double back[SIDES] = { e[X1], e[Y1], e[X0], e[Y0] };
		const double there = filter->line(e, at[0], at[1]);
		const double again = filter->line(back, at[0], at[1]);
		expect(same_bits(there, -again), "(%a,%a) -> (%a,%a) about (%a,%a) is %a, reversed "
			"%a", e[X0], e[Y0], e[X1], e[Y1], at[0], at[1], there, again);
	}
	check_end();
}

/* Left, right or below the support, or on half a pixel around it; vertical; points. */
static void test_nothing(const Api *api, const Subject *s)
{
	check_begin("edges that the filter does not see are exactly 0: %s, %s", s->row->name,
		api->name);
	for (int i = 0; i < FREE; i++) {
		double e[SIDES], at[2];
		const int axis = i % 3 == 2;            /* else left or right */
		const bool right = i % 3 == 1;
		fill_edge(api, s, (size_t)i % CLASSES, e, at);
		at[0] = random_int(-9, 9) + 0.5;
		at[1] = random_int(-9, 9) + 0.5;
		const double border = at[axis] + 0.5 * (right ? ceil(2 * s->high[axis])
			: floor(2 * s->low[axis]));
		for (int k = axis; k < SIDES && i % 5; k += 2) {
			const double away = fabs(random_scaled(-3, 9)) * random_int(0, 1);
			e[k] = round_to(api->bits, border + (right ? away : -away));
		}
		if (i % 5 == 0)
			e[X1] = e[X0];
		const double got = filter_of(s->row, api)->line(e, at[0], at[1]);
		expect(got == 0, "(%a,%a) -> (%a,%a) about (%a,%a) is %a", e[X0], e[Y0], e[X1],
			e[Y1], at[0], at[1], got);
	}
	check_end();
}

/* Never NaN for finite coordinates to a quarter of the largest number, always for NaN. */
static void test_extremes(const Api *api, const Subject *s)
{
	const FilterFunctions *filter = filter_of(s->row, api);
	check_begin("extremes, and NaN: %s, %s", s->row->name, api->name);
	for (int i = 0; i < FREE; i++) {
		double e[SIDES], at[2];
		fill_edge(api, s, (size_t)i % CLASSES, e, at);
		for (int k = 0; k < SIDES; k++) {
			const int kind = random_int(0, 5);
			if (kind == 0)
				e[k] = random_sized(largest(api) / 4);
			else if (kind == 1)
				e[k] = random_int(-3, 3) * api->denormal;
			e[k] = round_to(api->bits, e[k]);
		}
		const double got = filter->line(e, at[0], at[1]);
		expect(fabs(got) <= 2 * s->weight, "(%a,%a) -> (%a,%a) about (%a,%a) is %a", e[X0],
			e[Y0], e[X1], e[Y1], at[0], at[1], got);
		*(i % 6 < 4 ? &e[i % 6] : &at[i % 6 - 4]) = NAN;
		const double nan = filter->line(e, at[0], at[1]);
		expect(isnan(nan), "(%a,%a) -> (%a,%a) about (%a,%a) is %a", e[X0], e[Y0], e[X1],
			e[Y1], at[0], at[1], nan);
	}
	check_end();
}

/* ---- Rings ---- */

static void fill_ring(const Api *api, const Subject *s, Ring *ring, int kind, double at[2])
{
	for (int i = 0; i < 2; i++)
		at[i] = random_int(0, 1) ? 0.5 : round_to(api->bits, random_real(-3, 3));
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = at[0] + (kind == 2 ? knot(s, 0) : across(s, 0, 2));
		ring->y[i] = at[1] + (kind == 2 ? knot(s, 1) : across(s, 1, 2));
	}
	if (kind == 1)
		ring_star(ring, at[0], at[1], 1.5);
	if (kind == 3)
		ring_star(ring, at[0] + 2, at[1] - 1, 1000);
	ring_pack(api, ring);
}

static double ring_bound(const Api *api, const Subject *s, const Ring *ring, const double at[2])
{
	double bound = 0, size = 0;
	for (size_t i = 0; i < ring->n; i++) {
		const size_t j = i + 1 < ring->n ? i + 1 : 0;
		const double e[SIDES] = { ring->x[i], ring->y[i], ring->x[j], ring->y[j] };
		bound += filter_bound(api, s, e, at[0], at[1]);
		size += fabs(filter_of(s->row, api)->line(e, at[0], at[1]));
	}
	return bound + ldexp((double)ring->n + 5, -api->bits) * (size + bound);
}

static void test_rings(const Api *api, const Subject *s)
{
	double at[2], worst = 0;
	mpq_t exact;
	mpq_init(exact);
	check_begin("rings against clipping: %s, %s", s->row->name, api->name);
	for (int i = 0; i < RINGS; i++) {
		Ring ring = ring_new((size_t)(i % 20 ? random_int(3, 20) : random_int(24, 60)));
		fill_ring(api, s, &ring, i % 4, at);
		window_ring(exact, s->definition, ring.x, ring.y, ring.n, at[0], at[1]);
		for (int t = 0; t < target_count; t++) {
			ew_use_target(target_bit[t]);
			const double got = filter_of(s->row, api)->ring(ring.px, ring.py, ring.n,
				at[0], at[1]);
			const double error = window_error(got, exact);
			expect(error <= ring_bound(api, s, &ring, at), "%s, n = %zu: %.17g, exact "
				"%.17g, off by %g, allowed %g", ew_target_name(target_bit[t]),
				ring.n, got, mpq_get_d(exact), error,
				ring_bound(api, s, &ring, at));
			worst = fmax(worst, ldexp(error, api->bits));
		}
		ring_free(&ring);
	}
	check_end();
	ew_use_target(0);
	printf("# rings, %s, %s: off by %.1f u at most\n", s->row->name, api->name, worst);
	mpq_clear(exact);
}

/* The support wholly within the ring: the filter's integral, within the bound of the edges. */
static void test_inside(const Api *api, const Subject *s)
{
	const double x[] = { -50, 60, 55, -70 }, y[] = { -60, -50, 70, 50 };
	double at[2] = { 0.5, 0.5 };
	mpq_t exact;
	mpq_init(exact);
	check_begin("all of the filter, and nothing: %s, %s", s->row->name, api->name);
	for (int i = 0; i < 200; i++) {
		Ring ring = ring_new(i % 2 ? 4 : 8);
		const double side = i % 3 ? 0 : -500;   /* to the left, or below */
		for (size_t j = 0; j < ring.n; j++) {
			ring.x[j] = x[j % 4] + random_real(-1, 1) + (i % 2 ? side : 0);
			ring.y[j] = y[j % 4] + random_real(-1, 1) + (i % 2 ? 0 : side);
		}
		ring_pack(api, &ring);
		const double got = filter_of(s->row, api)->ring(ring.px, ring.py, ring.n, at[0],
			at[1]);
		window_ring(exact, s->definition, ring.x, ring.y, ring.n, at[0], at[1]);
		expect(window_error(got, exact) <= (side == 0 ? ring_bound(api, s, &ring, at) : 0),
			"%.17g, exact %.17g", got, mpq_get_d(exact));
		ring_free(&ring);
	}
	check_end();
	mpq_clear(exact);
}

/* Every n between guarded pages: the same bits on all targets with fused operations. */
static void test_every_size(const Api *api, const Subject *s)
{
	Guarded g[2] = { guarded_new(MOST * sizeof(double)), guarded_new(MOST * sizeof(double)) };
	double at[2];
	check_begin("every n: the same bits, no read beside: %s, %s", s->row->name, api->name);
	for (int i = 0; i < 4 * (MOST + 1); i++) {
		Ring ring = ring_new((size_t)i / 4);
		Fused fused = { 0 };
		fill_ring(api, s, &ring, i % 4, at);
		const void *x = guarded_copy(&g[0], ring.px, ring.n * api->size, i & 1);
		const void *y = guarded_copy(&g[1], ring.py, ring.n * api->size, i & 2);
		for (int t = 0; t < target_count; t++) {
			ew_use_target(target_bit[t]);
			const double got = filter_of(s->row, api)->ring(x, y, ring.n, at[0], at[1]);
			expect(ring.n > 2 || got == 0, "n = %zu: %a", ring.n, got);
			expect_same_if_fused(&fused, target_bit[t], got, ring.n);
		}
		ring_free(&ring);
	}
	check_end();
	ew_use_target(0);
	guarded_free(&g[0]);
	guarded_free(&g[1]);
}

static void test_ring_nan(const Api *api, const Subject *s)
{
	check_begin("NaN in any vertex or the centre comes out: %s, %s", s->row->name, api->name);
	for (int i = 0; i < 8 * MOST; i++) {
		Ring ring = ring_new((size_t)i % (MOST - 2) + 3);
		double at[2];
		fill_ring(api, s, &ring, i % 4, at);
		const size_t where = (size_t)random_int(0, (int)ring.n - 1);
		*(i % 3 == 0 ? &at[random_int(0, 1)] : i % 3 == 1 ? &ring.x[where]
			: &ring.y[where]) = NAN;
		ring_pack(api, &ring);
		ew_use_target(target_bit[i % target_count]);
		const double got = filter_of(s->row, api)->ring(ring.px, ring.py, ring.n, at[0],
			at[1]);
		expect(isnan(got), "%s, n = %zu: %a", ew_target_name(target_bit[i % target_count]),
			ring.n, got);
		ring_free(&ring);
	}
	check_end();
	ew_use_target(0);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	list_targets();
	for (int f = 0; f < FILTER_ROWS; f++) {
		Subject s = subject_of(&filter_rows[f]);
		for (int a = 0; a < APIS; a++) {
			for (size_t c = 0; c < CLASSES; c++)
				test_edges(&apis[a], &s, c);
			test_reversed(&apis[a], &s);
			test_nothing(&apis[a], &s);
			test_extremes(&apis[a], &s);
			test_rings(&apis[a], &s);
			test_inside(&apis[a], &s);
			test_every_size(&apis[a], &s);
			test_ring_nan(&apis[a], &s);
		}
		window_free(s.definition);
	}
	return check_finish();
}

/* Windows: the area of rings within a rectangle.
 *
 * ew_coverage of self-intersecting rings of every size is held against exact clipping: its error is
 * at most the sum of what its edges may be off (windows.h) and (n + 5) u times the sum of their
 * sizes, whatever the order in which n of them are added. All targets with fused operations give
 * the same bits, nothing is read beside the n vertices, and a NaN anywhere comes out.
 */
#include "guarded.h"

#include "windows.h"

enum { MOST = 100 };

/* Kinds of rings about a window near the unit cell. */
static void fill_ring(const Api *api, Ring *ring, int kind, const double r[SIDES])
{
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = random_real(-2, 3);
		ring->y[i] = random_real(-2, 3);
	}
	if (kind == 1)
		ring_star(ring, 0.4, 0.6, 2);
	if (kind == 2)
		ring_snap(ring, 0.5);
	if (kind == 3)
		ring_star(ring, 0.5, 0.5, api->bits == 24 ? 3e4 : 1e12);
	for (size_t i = 0; kind == 4 && i < ring->n; i++) {     /* on borders and corners */
		if (random_int(0, 1))
			ring->x[i] = r[U0 + random_int(0, 1)];
		if (random_int(0, 1))
			ring->y[i] = r[V0 + random_int(0, 1)];
	}
	ring_pack(api, ring);
}

enum { FILLS = 5 };

static void fill_window(const Api *api, double r[SIDES])
{
	for (int i = 0; i < SIDES; i += 2) {
		const bool cell = random_int(0, 1);
		r[i] = cell ? random_int(-1, 1) : round_to(api->bits, random_real(-1, 0.5));
		r[i + 1] = cell ? r[i] + 1 : round_to(api->bits, random_real(0.5, 2));
	}
}

static double ring_bound(const Api *api, WindowArea *area, const Ring *ring,
	const double r[SIDES])
{
	double bound = 0, size = 0;
	for (size_t i = 0; i < ring->n; i++) {
		const size_t j = i + 1 < ring->n ? i + 1 : 0;
		const double e[SIDES] = { ring->x[i], ring->y[i], ring->x[j], ring->y[j] };
		window_area(area, e, r);
		bound += window_bound(api, e, r);
		size += fabs(window_area_value(area));
	}
	return WINDOW_SECOND * (bound + ldexp((double)ring->n + 5, -api->bits) * size);
}

static void test_polygons(const Api *api, const char *target)
{
	double r[SIDES], worst = 0;
	mpq_t exact;
	WindowArea area;
	mpq_init(exact);
	window_area_init(&area);
	check_begin("rings against exact clipping, %s, %s", api->name, target);
	for (int i = 0; i < 20 * MOST; i++) {
		Ring ring = ring_new((size_t)i % MOST + 1);
		fill_window(api, r);
		fill_ring(api, &ring, random_int(0, FILLS - 1), r);
		WindowFilter *filter = window_rectangle(r[U0], r[U1], r[V0], r[V1]);
		window_ring(exact, filter, ring.x, ring.y, ring.n, 0, 0);
		const double got = windows_of(api)->ring(ring.px, ring.py, ring.n, r);
		const double error = window_error(got, exact);
		const double bound = ring_bound(api, &area, &ring, r);
		expect(error <= bound, "n = %zu: %.17g, exact %.17g, off by %g, allowed %g",
			ring.n, got, mpq_get_d(exact), error, bound);
		worst = fmax(worst, bound > 0 ? error / bound : 0);
		window_free(filter);
		ring_free(&ring);
	}
	check_end();
	printf("# %s, %s: %.3f of the bound\n", api->name, target, worst);
	mpq_clear(exact);
	window_area_clear(&area);
}

/* No area at all: exactly 0. */
static void test_nothing(const Api *api, const char *target)
{
	double r[SIDES];
	check_begin("rings of no more than two vertices, none in the window, %s, %s", api->name,
		target);
	expect(same_bits(windows_of(api)->ring(NULL, NULL, 0, (double[]){ 0, 1, 0, 1 }), 0),
		"a null ring");
	for (int i = 0; i < 4000; i++) {
		Ring ring = ring_new((size_t)(i % 4 == 3 ? random_int(3, MOST) : i % 4));
		fill_window(api, r);
		fill_ring(api, &ring, random_int(0, FILLS - 1), r);
		for (size_t j = 0; i % 4 == 3 && j < ring.n; j++)
			ring.x[j] += ring.x[j] < 0 ? -4e4 : 4e4;        /* crosses in y only */
		for (size_t j = 1; i % 4 == 3 && j < ring.n; j++)
			ring.x[j] = copysign(ring.x[j], ring.x[0]);
		ring_pack(api, &ring);
		const double got = windows_of(api)->ring(ring.px, ring.py, ring.n, r);
		expect(got == 0, "n = %zu: %a", ring.n, got);
		ring_free(&ring);
	}
	check_end();
}

/* The window wholly inside: its area; the error is that of its edges. A rectangle of whole numbers
 * about a window of such is exact. */
static void test_inside(const Api *api, const char *target)
{
	check_begin("windows within whole rectangles are exact, %s, %s", api->name, target);
	for (int i = 0; i < 2000; i++) {
		Ring ring = ring_new(4);
		const double u = random_int(-9, 9), v = random_int(-9, 9);
		const double w = random_int(0, 5), h = random_int(0, 5);
		const double r[SIDES] = { u, u + w, v, v + h };
		for (size_t j = 0; j < 4; j++) {
			ring.x[j] = j == 1 || j == 2 ? u + w + random_int(0, 3) : u;
			ring.y[j] = j > 1 ? v + h + 2 : v - 1;
		}
		ring.x[2] = ring.x[1];
		ring_pack(api, &ring);
		const double got = windows_of(api)->ring(ring.px, ring.py, ring.n, r);
		expect(got == w * h, "%g x %g: %a", w, h, got);
		ring_free(&ring);
	}
	check_end();
}

/* Every n, at the front and at the back of guarded pages, on every target. */
static void test_every_size(const Api *api)
{
	Guarded g[2] = { guarded_new(MOST * sizeof(double)), guarded_new(MOST * sizeof(double)) };
	double r[SIDES];
	check_begin("every n: the same bits, no read beside, %s", api->name);
	for (int i = 0; i < 4 * (MOST + 1); i++) {
		Ring ring = ring_new((size_t)i / 4);
		Fused fused = { 0 };
		fill_window(api, r);
		fill_ring(api, &ring, i % FILLS, r);
		const void *x = guarded_copy(&g[0], ring.px, ring.n * api->size, i & 1);
		const void *y = guarded_copy(&g[1], ring.py, ring.n * api->size, i & 2);
		for (unsigned bit = 1; bit; bit <<= 1) {
			if (!(ew_targets() & bit) || ew_use_target(bit) != EW_OK)
				continue;
			const double got = windows_of(api)->ring(x, y, ring.n, r);
			expect_same_if_fused(&fused, bit, got, ring.n);
		}
		ring_free(&ring);
	}
	check_end();
	ew_use_target(0);
	guarded_free(&g[0]);
	guarded_free(&g[1]);
}

static void test_nan(const Api *api, const char *target)
{
	check_begin("NaN in any vertex or border comes out, %s, %s", api->name, target);
	for (int i = 0; i < 40 * MOST; i++) {
		Ring ring = ring_new((size_t)i % (MOST - 2) + 3);
		double r[SIDES];
		fill_window(api, r);
		fill_ring(api, &ring, random_int(0, FILLS - 1), r);
		const size_t at = (size_t)random_int(0, (int)ring.n - 1);
		*(i % 3 == 0 ? &r[random_int(U0, V1)] : i % 3 == 1 ? &ring.x[at] : &ring.y[at]) =
			NAN;
		ring_pack(api, &ring);
		const double got = windows_of(api)->ring(ring.px, ring.py, ring.n, r);
		expect(isnan(got), "n = %zu, vertex %zu: %a", ring.n, at, got);
		ring_free(&ring);
	}
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	for_each_target(test_polygons);
	for_each_target(test_nothing);
	for_each_target(test_inside);
	for_each_target(test_nan);
	for (int i = 0; i < APIS; i++)
		test_every_size(&apis[i]);
	return check_finish();
}

/* Images by filters of tests/filters: the same way as built-in ones.
 *
 * A B-spline of six pixels, one filter that is no product of two functions, and two whose knots are
 * not pixels apart are held against rational clipping, pixel by pixel, on every target; images
 * without an edge are constant, reversed rings negate, and all targets with fused operations have
 * the same bits.
 */
#include "raster.h"

#define FEW 2e-6

enum { WIDE = 7, HIGH = 6, SMALL = 12 };

static void test_small(const RasterFilter *filter)
{
	double want[WIDE * HIGH], worst = 0;
	WindowFilter *definition = filter->definition();
	check_begin("small images against rational clipping: %s", filter->name);
	for (int i = 0; i < SMALL; i++) {
		Scene s = small_scene(i % SCENES, i);
		RasterRings rings = scene_rings(&s);
		raster_exact(want, definition, &rings, WIDE, HIGH);
		worst = fmax(worst, expect_image(filter, &s, want, WIDE, HIGH, FEW));
		scene_free(&s);
	}
	check_end();
	printf("# %s: off by %.3g at most\n", filter->name, worst);
	window_free(definition);
}

/* Larger, by clipping in long double. */
static void test_large(const RasterFilter *filter)
{
	enum { SIZE = 64, VERTICES = 200 };
	static double want[SIZE * SIZE];
	WindowFilter *definition = filter->definition();
	check_begin("200 edges: %s", filter->name);
	for (int i = 0; i < 4; i++) {
		Scene s = scene_new(VERTICES, 1);
		scene_star(&s, 0, 31, 32, i < 2 ? 28 : 60, i % 2 ? 0.9 : 0.1);
		scene_pack(&s);
		RasterRings rings = scene_rings(&s);
		raster_reference(want, definition, &rings, SIZE, SIZE);
		expect_image(filter, &s, want, SIZE, SIZE, FEW);
		scene_free(&s);
	}
	check_end();
	window_free(definition);
}

/* Around the image once or more, near or far: the integral of the filter that often, exactly where
 * that is 1, and elsewhere the same number in all pixels. */
static void test_constant(const RasterFilter *filter, double integral)
{
	check_begin("images without an edge are constant: %s", filter->name);
	for (int i = 0; i < 100; i++) {
		const int width = random_int(1, 40), height = random_int(1, 40);
		const double away = i % 2 ? 6 : random_real(6, 1e5);
		const int times = random_int(-5, 5);
		Scene s = scene_new(4 * (size_t)abs(times), 1);
		for (size_t v = 0; v < s.n; v++) {
			s.x[v] = v % 4 == 0 || v % 4 == 3 ? -away : width + away;
			s.y[v] = v % 4 < 2 ? -away : height + away;
		}
		scene_pack(&s);
		if (times < 0)
			scene_reverse(&s);
		Image image = image_of(&apis[i % APIS], filter, &s, width, height);
		const float first = image_at(&image, 0, 0);
		const double bound = integral == 1 || times == 0 ? 0 : FEW;
		expect(fabs((double)first - times * integral) <= bound, "%d times: %.9g", times,
			(double)first);
		for (int p = 0; p < width * height; p++) {
			const float v = image_at(&image, p % width, p / width);
			expect(v == first, "pixel %d of %d x %d is %.9g, the first %.9g", p, width,
				height, (double)v, (double)first);
		}
		image_free(&image);
		scene_free(&s);
	}
	check_end();
}

/* By the reference: a square around the support. */
static double integral_of(const RasterFilter *filter)
{
	const double x[] = { -9, 9, 9, -9 }, y[] = { -9, -9, 9, 9 };
	WindowFilter *definition = filter->definition();
	mpq_t value;
	mpq_init(value);
	window_ring(value, definition, x, y, 4, 0, 0);
	const double integral = mpq_get_d(value);
	mpq_clear(value);
	window_free(definition);
	return integral;
}

static void test_bits(const RasterFilter *filter)
{
	enum { SIDE = 40 };
	check_begin("the same bits, reversed and on all targets: %s", filter->name);
	for (int i = 0; i < 40; i++) {
		Scene s = scene_new(2 * (size_t)random_int(3, 20), 2);
		scene_scatter(&s, -10, SIDE + 10);
		scene_pack(&s);
		Image fused = { 0 };
		for (int t = 0; t < target_count; t++) {
			const char *name = ew_target_name(target_bit[t]);
			ew_use_target(target_bit[t]);
			Image image = image_of(&apis[i % APIS], filter, &s, SIDE, SIDE);
			scene_reverse(&s);
			Image back = image_of(&apis[i % APIS], filter, &s, SIDE, SIDE);
			scene_reverse(&s);
			expect(image_differs(&back, &image, 0, 0, -1) < 0, "%s: reversed", name);
			image_free(&back);
			expect(!fused.all || image_differs(&image, &fused, 0, 0, 1) < 0,
				"%s: other bits", name);
			if (fused.all || target_bit[t] == EW_PORTABLE)
				image_free(&image);
			else
				fused = image;
		}
		image_free(&fused);
		scene_free(&s);
	}
	check_end();
	ew_use_target(0);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	list_targets();
	for (int f = 0; f < FILTERS; f++) {
		const RasterFilter *filter = &raster_filters[f];
		test_small(filter);
		test_large(filter);
		test_constant(filter, integral_of(filter));
		test_bits(filter);
	}
	return check_finish();
}

/* Images: the values of pixels.
 *
 * Small ones are held against rational clipping, pixel by pixel, larger ones and those of many
 * edges against the same in long double: 2e-6 up to 10^3 edges, 1e-5 at 10^5, as promised. Then
 * what filters promise, whatever the shape: they are partitions of unity, so all pixels sum up to
 * the area of a shape within the image, and those that keep linear functions have its first moments
 * too. Where a pixel's filter meets no edge nothing may be lost; each other one adds 2e-6 at most.
 */
#include "raster.h"

#define FEW 2e-6                /* up to 10^3 edges */
#define MANY 1e-5               /* at 10^5 */

enum { BYTE = 255 };

/* ---- Small images, exactly ---- */

enum { WIDE = 7, HIGH = 6 };

static void test_small(const RasterFilter *filter, int scenes)
{
	double exact[WIDE * HIGH], fast[WIDE * HIGH], worst = 0;
	WindowFilter *definition = filter->definition();
	check_begin("small images against rational clipping: %s", filter->name);
	for (int i = 0; i < scenes; i++) {
		Scene s = small_scene(i % SCENES, i);
		RasterRings rings = scene_rings(&s);
		raster_exact(exact, definition, &rings, WIDE, HIGH);
		raster_reference(fast, definition, &rings, WIDE, HIGH);
		/* coordinates to 2^10 cost ten of the 64 bits, the terms of a cubic nine */
		for (int p = 0; p < WIDE * HIGH; p++)
			expect(fabs(exact[p] - fast[p]) <= 0x1p-44,
				"scene %d, pixel %d: exact %.17g, by long double %.17g", i, p,
				exact[p], fast[p]);
		worst = fmax(worst, expect_image(filter, &s, exact, WIDE, HIGH, FEW));
		scene_free(&s);
	}
	check_end();
	printf("# %s: off by %.3g at most\n", filter->name, worst);
	window_free(definition);
}

/* ---- Up to 10^5 edges ---- */

static const struct {
	const char *name;
	size_t n;
	int size, cubic_size;           /* of the image: box, wider filters */
	double roughness, bound;
} sets[] = {
	{ "100 edges", 100, 128, 64, 0.3, FEW },
	{ "1000 edges", 1000, 256, 96, 0.02, FEW },
	{ "100 spikes", 100, 256, 96, 0.95, FEW },
	{ "1000 spikes", 1000, 512, 256, 0.95, FEW },
	{ "100000 edges", 100000, 512, 192, 0.001, MANY }
};

static void test_set(const RasterFilter *filter, size_t k)
{
	const int size = filter->size == 1 ? sets[k].size : sets[k].cubic_size;
	double *want = allocate((size_t)(size * size) * sizeof *want);
	WindowFilter *definition = filter->definition();
	Scene s = scene_new(sets[k].n, 1);
	check_begin("%s: %s", sets[k].name, filter->name);
	scene_star(&s, 0, size * 0.5 + 0.3, size * 0.5 - 0.2, size * 0.45, sets[k].roughness);
	scene_pack(&s);
	RasterRings rings = scene_rings(&s);
	raster_reference(want, definition, &rings, size, size);
	const double worst = expect_image(filter, &s, want, size, size, sets[k].bound);
	check_end();
	printf("# %s, %s: off by %.3g at most\n", sets[k].name, filter->name, worst);
	scene_free(&s);
	window_free(definition);
	free(want);
}

/* ---- Sums ---- */

enum { CANVAS = 40, INSIDE = 8 };

/* Sums of all pixels, and of pixels times their coordinates. */
static void image_sums(const Image *image, double sum[3], double bound[3])
{
	sum[0] = sum[1] = sum[2] = bound[0] = bound[1] = bound[2] = 0;
	for (int p = 0; p < image->width * image->height; p++) {
		const int i = p % image->width, j = p / image->width;
		const double v = (double)image_at(image, i, j), weight[3] = { 1, i + 0.5, j + 0.5 };
		for (int k = 0; k < 3; k++) {
			sum[k] += v * weight[k];
			if (v != rint(v))               /* an edge is there */
				bound[k] += FEW * weight[k];
		}
	}
}

/* The region has these moments, and the filter may take both of them on. */
static void test_sums(const RasterFilter *filter)
{
	Ref *moments = ref_new(3);
	const int known = filter->size == 1 ? 1 : 3;    /* the box keeps no linear function */
	check_begin("pixels sum up to area%s: %s", known > 1 ? " and first moments" : "",
		filter->name);
	for (int i = 0; i < 60; i++) {
		Scene s = scene_new((size_t)random_int(3, 40), 1);
		double sum[3], bound[3];
		scene_scatter(&s, INSIDE, CANVAS - INSIDE);
		if (i % 3 == 0)
			scene_star(&s, 0, CANVAS / 2.0, CANVAS / 2.0, CANVAS / 2.0 - INSIDE, 0.5);
		scene_snap(&s, i % 4 == 0 ? 0.5 : 0x1p-16);
		ref_ring(moments, 1, s.x, s.y, s.n);
		for (int a = 0; a < APIS; a++) {
			Image image = image_of(&apis[a], filter, &s, CANVAS, CANVAS);
			image_sums(&image, sum, bound);
			for (int k = 0; k < known; k++) {
				const double want = mpq_get_d(moments[k].value);
				expect(fabs(sum[k] - want) <= bound[k] + 1e-12 * fabs(want),
					"%s, moment %d: %.9g, exact %.9g, allowed %g", apis[a].name,
					k, sum[k], want, bound[k]);
			}
			image_free(&image);
		}
		scene_free(&s);
	}
	check_end();
	ref_free(moments, 3);
}

/* All of the image within the shape, and then some: 1 everywhere, and twice around 2. */
static void test_constant(const RasterFilter *filter)
{
	check_begin("constant images are constant: %s", filter->name);
	for (int i = 0; i < 200; i++) {
		const int times = random_int(1, 7), width = random_int(1, 20);
		Scene s = scene_new((size_t)(4 * times), 1);
		const double away = i % 3 ? random_real(4, 9) : 1e6;
		for (size_t v = 0; v < s.n; v++) {
			s.x[v] = v % 4 == 0 || v % 4 == 3 ? -away : width + away;
			s.y[v] = v % 4 < 2 ? -away : width + away + random_real(0, 5);
		}
		scene_pack(&s);
		if (i % 2)
			scene_reverse(&s);
		Image image = image_of(&apis[i % APIS], filter, &s, width, width);
		for (int p = 0; p < width * width; p++) {
			const float v = image_at(&image, p % width, p / width);
			expect(v == (float)(i % 2 ? -times : times), "pixel %d of %d x %d: %.9g, "
				"not %d", p, width, width, (double)v, times);
		}
		image_free(&image);
		scene_free(&s);
	}
	check_end();
}

/* A half plane with an edge along a pixel's diagonal is a linear ramp of the box: the pixel in row
 * j of an edge that rises by 1/m per pixel is linear in i. */
static void test_linear(void)
{
	enum { LENGTH = 16 };
	check_begin("linear images are linear: box");
	for (int i = 0; i < 400; i++) {
		const double slope = ldexp(1, -random_int(4, 8)), low = random_int(0, 7) / 8.0;
		Scene s = scene_new(4, 1);
		const double x[] = { -16, 32, 32, -16 };
		const double y[] = { -8, -8, 0.5 * low + slope * 24, 0.5 * low - slope * 24 };
		memcpy(s.x, x, sizeof x);
		memcpy(s.y, y, sizeof y);
		scene_pack(&s);
		Image image = image_of(&apis[i % APIS], &raster_filters[0], &s, LENGTH, 1);
		for (int p = 0; p < LENGTH; p++) {
			const double height = 0.5 * low + slope * (p + 0.5 - 8);
			const double got = (double)image_at(&image, p, 0);
			if (height - slope / 2 >= 0 && height + slope / 2 <= 1)
				expect(fabs(got - height) <= FEW, "slope %g, pixel %d: %.9g, not "
					"%.9g", slope, p, got, height);
		}
		image_free(&image);
		scene_free(&s);
	}
	check_end();
}

/* ---- Bytes ---- */

static int raster_bytes(const Api *api, const Scene *s, unsigned char *pixels, int size)
{
	return api->bits == 24
		? ew_raster_u8f(s->xf, s->yf, s->offsets, s->rings, pixels, size, size, size)
		: ew_raster_u8(s->x, s->y, s->offsets, s->rings, pixels, size, size, size);
}

/* The nearest of 255 |coverage|: of the float image, whose product with 255 may round, and of the
 * exact one. */
static void expect_bytes(const Api *api, const Scene *s, const double *want, const Image *image)
{
	const int size = image->width;
	unsigned char *bytes = allocate((size_t)(size * size));
	expect(raster_bytes(api, s, bytes, size) == EW_OK, "refused");
	for (int p = 0; p < size * size; p++) {
		const double c = (double)image_at(image, p % size, p / size);
		const double v = fmin(BYTE * fabs(c), BYTE);
		const double exact = fmin(BYTE * fabs(want[p]), BYTE);
		expect(fabs(bytes[p] - v) <= 0.5 + BYTE * 0x1p-24,
			"%s: %d, but the pixel is %.9g, %.9g / 255", api->name, bytes[p], c, v);
		expect(fabs(bytes[p] - exact) <= 0.5 + BYTE * FEW, "%s: %d, but exact %.9g / 255",
			api->name, bytes[p], exact);
	}
	free(bytes);
}

static void test_bytes(int kind)
{
	static const char *const names[] = {
		"a star", "clockwise", "self-overlapping", "on the grid"
	};
	enum { SIDE = 33 };
	double want[SIDE * SIDE];
	WindowFilter *box = window_bspline(0);
	check_begin("bytes: %s", names[kind]);
	for (int i = 0; i < 40; i++) {
		Scene s = scene_new((size_t)random_int(3, 30), 1);
		scene_scatter(&s, -4, SIDE + 4);
		if (kind < 2)
			scene_star(&s, 0, SIDE * 0.5, SIDE * 0.5, kind ? -SIDE : 15, 0.6);
		scene_snap(&s, kind == 3 ? 0.5 : 0x1p-18);
		RasterRings rings = scene_rings(&s);
		raster_reference(want, box, &rings, SIDE, SIDE);
		for (int t = 0; t < target_count; t++) {
			ew_use_target(target_bit[t]);
			for (int a = 0; a < APIS; a++) {
				Image image = image_of(&apis[a], &raster_filters[0], &s, SIDE,
					SIDE);
				expect_bytes(&apis[a], &s, want, &image);
				image_free(&image);
			}
		}
		scene_free(&s);
	}
	check_end();
	ew_use_target(0);
	window_free(box);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	list_targets();
	for (int f = 0; f < FILTERS; f++) {
		const RasterFilter *filter = &raster_filters[f];
		test_small(filter, filter->size > 2 ? 12 : 60);
		for (size_t k = 0; k < sizeof sets / sizeof *sets; k++)
			test_set(filter, k);
		test_sums(filter);
		test_constant(filter);
	}
	test_linear();
	for (int kind = 0; kind < 4; kind++)
		test_bytes(kind);
	return check_finish();
}

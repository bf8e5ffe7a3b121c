/* raster.h - what the tests of images share: the functions of both precisions behind one table, the
 * built-in filters with their definitions, scenes of rings, and images with canaries around rows.
 */
#ifndef RASTER_H
#define RASTER_H

#include "rings.h"
#include "filter_list.h"
#include "raster_reference.h"

/* ---- Filters ---- */

typedef struct {
	const char *name;
	const ew_filter *filter;
	WindowFilter *(*definition)(void);
	double most;            /* max |f| */
	int size;               /* pixels it covers on each axis */
	bool unity;             /* a partition of unity */
} RasterFilter;

#define RASTER_FILTER(name, definition, most, size, unity) \
	{ #name, &ew_filter_##name, define_##name, most, size, unity },

static const RasterFilter raster_filters[] = { FILTER_LIST(RASTER_FILTER) };

enum { FILTERS = sizeof raster_filters / sizeof *raster_filters };

/* ---- Scenes: rings that both precisions hold exactly, unless bits is made 53 ---- */

typedef struct {
	size_t n, rings;
	int bits;
	double *x, *y;
	float *xf, *yf;
	int32_t *offsets;
} Scene;

static inline Scene scene_new(size_t n, size_t rings)
{
	Scene s = { n, rings, 24, allocate(n * sizeof(double)), allocate(n * sizeof(double)),
		allocate(n * sizeof(float)), allocate(n * sizeof(float)),
		allocate((rings + 1) * sizeof(int32_t)) };
	for (size_t i = 0; i <= rings; i++)
		s.offsets[i] = (int32_t)(n * i / (rings ? rings : 1));
	return s;
}

static inline void scene_free(Scene *s)
{
	free(s->x);
	free(s->y);
	free(s->xf);
	free(s->yf);
	free(s->offsets);
}

/* Rounds all coordinates to its bits, which is float unless changed. */
static inline void scene_pack(Scene *s)
{
	for (size_t i = 0; i < s->n; i++) {
		s->x[i] = round_to(s->bits, s->x[i]);
		s->y[i] = round_to(s->bits, s->y[i]);
		s->xf[i] = (float)s->x[i];
		s->yf[i] = (float)s->y[i];
	}
}

/* Rounds coordinates to a multiple of step, then to its bits. */
static inline void scene_snap(Scene *s, double step)
{
	for (size_t i = 0; i < s->n; i++) {
		s->x[i] = step * rint(s->x[i] / step);
		s->y[i] = step * rint(s->y[i] / step);
	}
	scene_pack(s);
}

static inline void scene_reverse(Scene *s)
{
	for (size_t k = 0; k < s->rings; k++) {
		int32_t i = s->offsets[k], j = s->offsets[k + 1] - 1;
		for (; i < j; i++, j--) {
			const double x = s->x[i], y = s->y[i];
			s->x[i] = s->x[j];
			s->y[i] = s->y[j];
			s->x[j] = x;
			s->y[j] = y;
		}
	}
	scene_pack(s);
}

static inline void scene_move(Scene *to, const Scene *from, double dx, double dy)
{
	for (size_t i = 0; i < from->n; i++) {
		to->x[i] = from->x[i] + dx;
		to->y[i] = from->y[i] + dy;
	}
	to->bits = from->bits;
	memcpy(to->offsets, from->offsets, (from->rings + 1) * sizeof *from->offsets);
	scene_pack(to);
}

/* Ring k counterclockwise or, when size < 0, clockwise about (cx,cy). */
static inline void scene_star(Scene *s, size_t k, double cx, double cy, double size,
	double roughness)
{
	const int32_t first = s->offsets[k], n = s->offsets[k + 1] - first;
	for (int32_t i = 0; i < n; i++) {
		const double turn = (i + random_real(0, 0.5)) / n * (size < 0 ? -1 : 1);
		const double radius = fabs(size) * random_real(1 - roughness, 1);
		s->x[first + i] = cx + radius * cos(6.283185307179586 * turn);
		s->y[first + i] = cy + radius * sin(6.283185307179586 * turn);
	}
}

/* All vertices anywhere in low..high. */
static inline void scene_scatter(Scene *s, double low, double high)
{
	for (size_t i = 0; i < s->n; i++) {
		s->x[i] = random_real(low, high);
		s->y[i] = random_real(low, high);
	}
}

static inline RasterRings scene_rings(const Scene *s)
{
	return (RasterRings){ s->x, s->y, s->offsets, s->rings };
}

enum { SCENES = 6 };

/* For an image of 7 x 6 pixels: within it, across all of its sides, on the grid, tiny, far away,
 * holes. */
static inline Scene small_scene(int kind, int i)
{
	Scene s = scene_new((size_t)(3 + i % 12), kind == 5 && i % 12 > 2 ? 2 : 1);
	scene_scatter(&s, 1, 5);
	if (kind == 1)
		scene_scatter(&s, -4, 10);
	if (kind == 2)
		scene_snap(&s, i % 2 ? 1 : 0.5);
	if (kind == 3)
		scene_star(&s, 0, 3, 3, 0.3, 0.5);
	if (kind == 4)
		scene_star(&s, 0, random_real(-800, 800), random_real(-800, 800), 1000, 0.1);
	if (kind == 5) {
		scene_star(&s, 0, 3, 3, 3, 0.3);
		if (s.rings == 2)
			scene_star(&s, 1, 3, 3, -1.5, 0.3);
	}
	scene_pack(&s);
	return s;
}

/* ---- Images ---- */

/* A canvas of any stride with canaries in every element that is no pixel. */
typedef struct {
	int width, height;
	ptrdiff_t stride;
	size_t count;           /* elements of all */
	float *all, *pixels;    /* pixels: of row 0 */
} Image;

enum { IMAGE_MARGIN = 16, IMAGE_CANARY = 0x5a };

static inline Image image_new(int width, int height, ptrdiff_t stride)
{
	const size_t reach = (size_t)(stride < 0 ? -stride : stride);
	Image image = { width, height, stride, 0, NULL, NULL };
	image.count = reach * (size_t)(height > 0 ? height - 1 : 0) + (size_t)width
		+ 2 * IMAGE_MARGIN;
	image.all = allocate(image.count * sizeof(float));
	memset(image.all, IMAGE_CANARY, image.count * sizeof(float));
	image.pixels = image.all + IMAGE_MARGIN
		+ (stride < 0 && height > 0 ? reach * (size_t)(height - 1) : 0);
	return image;
}

static inline void image_free(Image *image)
{
	free(image->all);
}

static inline float image_at(const Image *image, int i, int j)
{
	return image->pixels[j * image->stride + i];
}

static inline uint32_t float_bits(float v)
{
	uint32_t bits;
	memcpy(&bits, &v, sizeof bits);
	return bits;
}

/* Equal bits, zeros of either sign apart. */
static inline bool same_pixel(float a, float b)
{
	return float_bits(a) == float_bits(b) || (a == 0 && b == 0);
}

/* The first pixel at which `test` is `image` shifted by (dx,dy), sign times, and is not; -1 if
 * none. */
static inline int image_differs(const Image *test, const Image *image, int dx, int dy, float sign)
{
	for (int p = 0; p < test->width * test->height; p++) {
		const int i = p % test->width, j = p / test->width;
		if (!same_pixel(image_at(test, i, j), sign * image_at(image, i + dx, j + dy)))
			return p;
	}
	return -1;
}

static inline int image_raster(const Api *api, const RasterFilter *filter, const Scene *s,
	Image *image)
{
	return api->bits == 24 ? ew_rasterf(filter->filter, s->xf, s->yf, s->offsets, s->rings,
			image->pixels, image->width, image->height, image->stride)
		: ew_raster(filter->filter, s->x, s->y, s->offsets, s->rings, image->pixels,
			image->width, image->height, image->stride);
}

/* As large and as wide as it is; must succeed. */
static inline Image image_of(const Api *api, const RasterFilter *filter, const Scene *s, int width,
	int height)
{
	Image image = image_new(width, height, width);
	const int code = image_raster(api, filter, s, &image);
	expect(code == EW_OK, "%s, %d x %d: code %d", filter->name, width, height, code);
	return image;
}

/* ---- Against a reference ---- */

static inline double worst_error(const Image *image, const double *want)
{
	double worst = 0;
	for (int p = 0; p < image->width * image->height; p++) {
		const double got = (double)image_at(image, p % image->width, p / image->width);
		const double error = fabs(got - want[p]);
		worst = error <= worst ? worst : error;         /* NaN comes through */
	}
	return worst;
}

/* Both precisions on every target; returns the largest error. */
static inline double expect_image(const RasterFilter *filter, const Scene *s, const double *want,
	int width, int height, double bound)
{
	double worst = 0;
	for (int t = 0; t < target_count; t++) {
		ew_use_target(target_bit[t]);
		for (int a = 0; a < APIS; a++) {
			Image image = image_of(&apis[a], filter, s, width, height);
			const double error = worst_error(&image, want);
			expect(error <= bound, "%s, %s, %d x %d, %zu vertices: off by %g",
				apis[a].name, ew_target_name(target_bit[t]), width, height, s->n,
				error);
			worst = fmax(worst, error);
			image_free(&image);
		}
	}
	ew_use_target(0);
	return worst;
}

#endif

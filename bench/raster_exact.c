/* raster_exact.c - what every pixel should be, by other means than the library's.
 *
 * The region to the larger y of an edge, weighted by the filter, is
 *
 *     integral over the edge of k(x - cx) (1 - K(y - cy)) dx,    K(s) = integral of k up to s,
 *
 * and the sum over all edges is the pixel at (cx, cy). All knots of these filters are multiples of
 * 1/2, so an edge is cut wherever it crosses one, across and down, and on each part the integrand
 * is a polynomial of degree 7 at most (k 3, K 4), which five Gauss-Legendre nodes integrate
 * exactly. Rows that lie wholly beyond a part are summed down the columns at the end. All of it in
 * long double: coordinates of parts are off by 1e-19 of the image, and nothing is snapped. */
#include "raster.h"

#include <stdlib.h>

enum { NODES = 5, PIECES = 2, DEGREE = 3, MOST_ROWS = 8 };

typedef long double Real;

/* k(|x|), piece by piece; the last piece ends where the filter does. */
typedef struct { int pieces; Real end[PIECES], coefficient[PIECES][DEGREE + 1]; } Kind;

static const Kind kinds[EXACT_FILTERS] = {
	[EXACT_BOX] = { 1, { 0.5L }, { { 1 } } },
	[EXACT_TENT] = { 1, { 1 }, { { 1, -1 } } },
	[EXACT_BSPLINE3] = { 2, { 1, 2 }, { { 2 / 3.L, 0, -1, 0.5L }, { 4 / 3.L, -2, 1, -1 / 6.L } } },
	[EXACT_MITCHELL] = { 2, { 1, 2 }, { { 8 / 9.L, 0, -2, 7 / 6.L },
		{ 16 / 9.L, -10 / 3.L, 2, -7 / 18.L } } },
};

const char *const filter_names[EXACT_FILTERS] = { "box", "tent", "bspline3", "mitchell" };

static Real radius_of(const Kind *kind)
{
	return kind->end[kind->pieces - 1];
}

static Real value(const Kind *kind, Real x)
{
	const Real a = fabsl(x);
	int piece = 0;
	Real sum = 0;
	if (a >= radius_of(kind))
		return 0;
	while (a > kind->end[piece])
		++piece;
	for (int p = DEGREE; p >= 0; --p)
		sum = sum * a + kind->coefficient[piece][p];
	return sum;
}

/* The integral of a piece from 0 to x. */
static Real antiderivative(const Real *coefficient, Real x)
{
	Real sum = 0;
	for (int p = DEGREE; p >= 0; --p)
		sum = sum * x + coefficient[p] / (p + 1);
	return sum * x;
}

/* 1 - K(x). */
static Real beyond(const Kind *kind, Real x)
{
	Real a = fabsl(x), sum = 0.5L, begin = 0;
	for (int i = 0; i < kind->pieces && a > begin; begin = kind->end[i++]) {
		const Real end = a < kind->end[i] ? a : kind->end[i];
		sum -= antiderivative(kind->coefficient[i], end)
			- antiderivative(kind->coefficient[i], begin);
	}
	return x < 0 ? 1 - sum : sum;
}

double filter_value(Filter filter, double x)
{
	return (double)value(&kinds[filter], (Real)x);
}

/* ---- parts of edges ---- */

typedef struct { Real x0, y0, x1, y1; } Part;

typedef struct {
	const Kind *kind;
	int width, height;
	Real node[NODES], weight[NODES];       /* on [0, 1] */
	Real *pixel, *below;                   /* what a part adds to a row, and to all from it on */
} Image;

static void set_nodes(Image *image)
{
	const Real root = sqrtl(10 / 7.L), tail = 13 * sqrtl(70);
	const Real inner = sqrtl(5 - 2 * root) / 6, outer = sqrtl(5 + 2 * root) / 6;
	const Real node[NODES] = { 0.5L - outer, 0.5L - inner, 0.5L, 0.5L + inner, 0.5L + outer };
	const Real weight[NODES] = { (322 - tail) / 1800, (322 + tail) / 1800, 64 / 225.L,
		(322 + tail) / 1800, (322 - tail) / 1800 };
	for (int i = 0; i < NODES; ++i) {
		image->node[i] = node[i];
		image->weight[i] = weight[i];
	}
}

static int within(Real value, int end)
{
	return value < 0 ? 0 : value > end ? end : (int)value;
}

static void add_part(Image *image, Part part)
{
	const Real r = radius_of(image->kind), dx = part.x1 - part.x0, dy = part.y1 - part.y0;
	const Real mx = part.x0 + dx / 2, my = part.y0 + dy / 2;
	const int left = within(ceill(mx - r - 0.5L), image->width);
	const int right = within(floorl(mx + r - 0.5L) + 1, image->width);
	const int top = within(ceill(my - r - 0.5L), image->height);
	const int bottom = within(floorl(my + r - 0.5L) + 1, image->height);
	Real share[NODES][MOST_ROWS];
	for (int n = 0; n < NODES; ++n)
		for (int j = top; j < bottom; ++j)
			share[n][j - top] = beyond(image->kind,
				part.y0 + image->node[n] * dy - (j + 0.5L));
	for (int i = left; i < right; ++i)
		for (int n = 0; n < NODES; ++n) {
			const Real k = image->weight[n] * dx * value(image->kind,
				part.x0 + image->node[n] * dx - (i + 0.5L));
			for (int j = top; j < bottom; ++j)
				image->pixel[(long)j * image->width + i] += k * share[n][j - top];
			image->below[(long)bottom * image->width + i] += k;
		}
}

static int ascending(const void *a, const void *b)
{
	const Real left = *(const Real *)a, right = *(const Real *)b;
	return (left > right) - (left < right);
}

/* Where between 0 and 1 the way from a to b crosses multiples of 1/2. */
static int crossings(Real a, Real b, Real *at)
{
	const Real from = a < b ? a : b, to = a < b ? b : a;
	int count = 0;
	for (Real m = floorl(2 * from) + 1; m < 2 * to; ++m)
		at[count++] = (m / 2 - a) / (b - a);
	return count;
}

static void add_edge(Image *image, Real x0, Real y0, Real x1, Real y1, Real *at)
{
	int count = crossings(x0, x1, at);
	count += crossings(y0, y1, at + count);
	qsort(at, (size_t)count, sizeof *at, ascending);
	at[count] = 1;
	Part part = { x0, y0, x0, y0 };
	for (int i = 0; i <= count; ++i) {
		part.x1 = x0 + at[i] * (x1 - x0);
		part.y1 = y0 + at[i] * (y1 - y0);
		add_part(image, part);
		part.x0 = part.x1;
		part.y0 = part.y1;
	}
}

static Real *zeros(size_t count)
{
	Real *memory = allocate(count * sizeof *memory);
	for (size_t i = 0; i < count; ++i)
		memory[i] = 0;
	return memory;
}

double *exact_image(const Scene *scene, Filter filter)
{
	const size_t width = (size_t)scene->width, pixels = width * (size_t)scene->height;
	Image image = { &kinds[filter], scene->width, scene->height, { 0 }, { 0 }, zeros(pixels),
		zeros(pixels + width) };
	Real *at = zeros(2 * (width + (size_t)scene->height) + 8);
	double *out = allocate(pixels * sizeof *out);
	set_nodes(&image);
	for (size_t i = 0; i < scene->rings; ++i) {
		int32_t last = scene->offsets[i + 1] - 1;
		for (int32_t k = scene->offsets[i]; k < scene->offsets[i + 1]; last = k++)
			add_edge(&image, (Real)scene->x[last], (Real)scene->y[last],
				(Real)scene->x[k], (Real)scene->y[k], at);
	}
	for (size_t i = 0; i < pixels; ++i) {
		image.below[i] += i < width ? 0 : image.below[i - width];
		out[i] = (double)(image.pixel[i] + image.below[i]);
	}
	free(image.pixel);
	free(image.below);
	free(at);
	return out;
}

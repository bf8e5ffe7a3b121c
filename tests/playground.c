/* playground.c - the library as the page of examples/playground should have asked it: by itself, not
 * through the page's own C, and by the kernels of `portable`, whose bits are those of wasm128.
 *
 * Reads questions, a line each, and answers each by a line of numbers with all their digits:
 *
 *     path VERBS POINTS WEIGHTS verbs... x y ... weights...   moments to degree 2
 *     translate dx dy m00 ... m02                             moments of the moved region
 *     ring N x y ...                     one more ring; bounded moments, bounds, centroid, central
 *     edge N x y ... [weight]            its area; N points, 0 for a conic
 *     distance x y                       over all rings
 *     filters scale x y                  box, tent and Mitchell over all rings, scaled
 *     image filter scale x y width height     of the path, from its lower left corner, top row first
 *     below px py qx qy u0 u1 v0 v1      ew_below and ew_line_coverage */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "edgewise.h"

enum { MAX = 1 << 16 };

static unsigned char verbs[MAX];
static double points[2 * MAX], moved[2 * MAX], weights[MAX], x[MAX], y[MAX], sx[MAX], sy[MAX];
static size_t verb_count, point_count, weight_count, starts[MAX], rings;

static double number(void)
{
	char word[64], *end;
	if (scanf("%63s", word) != 1)
		exit(1);
	const double value = strtod(word, &end);
	if (*end != 0)
		exit(1);
	return value;
}

static size_t count(void)
{
	const double n = number();
	if (!(n >= 0 && n < MAX))
		exit(1);
	return (size_t)n;
}

static void say(const double *v, size_t n)
{
	for (size_t i = 0; i < n; i++)
		printf("%.17g ", v[i]);
}

static void need(int status)
{
	if (status != EW_OK)
		printf("status %d ", status);
}

static void path(void)
{
	double m[EW_MOMENTS(2)];
	verb_count = count();
	point_count = count();
	weight_count = count();
	for (size_t i = 0; i < verb_count; i++)
		verbs[i] = (unsigned char)count();
	for (size_t i = 0; i < 2 * point_count; i++)
		points[i] = number();
	for (size_t i = 0; i < weight_count; i++)
		weights[i] = number();
	need(ew_path_moments(2, verbs, verb_count, points, point_count, weights, weight_count, m));
	say(m, EW_MOMENTS(2));
}

static void translate(void)
{
	const double dx = number(), dy = number();
	double m[EW_MOMENTS(2)];
	for (int i = 0; i < EW_MOMENTS(2); i++)
		m[i] = number();
	need(ew_translate_moments(2, m, dx, dy, m));
	say(m, EW_MOMENTS(2));
}

static void ring(void)
{
	double m[EW_MOMENTS(2)], bounds[EW_MOMENTS(2)], c[2], central[EW_MOMENTS(2)];
	const size_t n = count(), start = starts[rings];
	if (n > MAX - start || rings == MAX - 1)
		exit(1);
	for (size_t i = start; i < start + n; i++) {
		x[i] = number();
		y[i] = number();
	}
	starts[++rings] = start + n;
	need(ew_moments_bounded(2, x + start, y + start, n, m, bounds));
	need(ew_central_moments(2, x + start, y + start, n, c, central));
	say(m, EW_MOMENTS(2));
	say(bounds, EW_MOMENTS(2));
	say(c, 2);
	say(central, EW_MOMENTS(2));
}

static void edge(void)
{
	const size_t n = count(), numbers = n == 0 ? 7 : 2 * n;
	double v[8], area = NAN;
	for (size_t i = 0; i < numbers && i < 8; i++)
		v[i] = number();
	if (n == 0)
		area = ew_conic_area(v[0], v[1], v[2], v[3], v[4], v[5], v[6]);
	else if (n == 2)
		area = ew_line_area(v[0], v[1], v[2], v[3]);
	else if (n == 3)
		area = ew_quad_area(v[0], v[1], v[2], v[3], v[4], v[5]);
	else if (n == 4)
		area = ew_cubic_area(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]);
	say(&area, 1);
}

static void distance(void)
{
	const double cx = number(), cy = number();
	double sum = 0;
	for (size_t i = 0; i < rings; i++)
		sum += ew_distance(x + starts[i], y + starts[i], starts[i + 1] - starts[i], cx, cy);
	say(&sum, 1);
}

static void filters(void)
{
	static double (*const of_ring[])(const double *, const double *, size_t, double, double) = {
		ew_box, ew_tent, ew_mitchell
	};
	const double scale = number(), cx = scale * number(), cy = scale * number();
	for (size_t i = 0; i < starts[rings]; i++) {
		sx[i] = scale * x[i];
		sy[i] = scale * y[i];
	}
	for (int f = 0; f < 3; f++) {
		double sum = 0;
		for (size_t i = 0; i < rings; i++)
			sum += of_ring[f](sx + starts[i], sy + starts[i], starts[i + 1] - starts[i], cx,
				cy);
		say(&sum, 1);
	}
}

static void image(void)
{
	static const ew_filter *const list[] = { &ew_filter_box, &ew_filter_tent,
		&ew_filter_mitchell };
	const size_t filter = count();
	const double scale = number(), left = number(), low = number();
	const int width = (int)count(), height = (int)count();
	float *const pixels = calloc((size_t)width * (size_t)height, sizeof *pixels);
	if (filter > 2 || width == 0 || height == 0 || !pixels)
		exit(1);
	for (size_t i = 0; i < point_count; i++) {
		moved[2 * i] = scale * (points[2 * i] - left);
		moved[2 * i + 1] = scale * (points[2 * i + 1] - low);
	}
	need(ew_raster_path(list[filter], verbs, verb_count, moved, point_count, weights,
		weight_count, pixels + (height - 1) * width, width, height, -width));
	for (int i = 0; i < width * height; i++)
		printf("%.9g ", (double)pixels[i]);
	free(pixels);
}

static void below(void)
{
	double v[8];
	for (int i = 0; i < 8; i++)
		v[i] = number();
	const double both[] = { ew_below(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]),
		ew_line_coverage(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]) };
	say(both, 2);
}

static const struct {
	const char *name;
	void (*answer)(void);
} questions[] = { { "path", path }, { "translate", translate }, { "ring", ring },
	{ "edge", edge }, { "distance", distance }, { "filters", filters },
	{ "image", image }, { "below", below } };

int main(void)
{
	char word[64];
	if (ew_use_target(EW_PORTABLE) != EW_OK)
		return 1;
	while (scanf("%63s", word) == 1) {
		size_t i = 0;
		while (i < sizeof questions / sizeof *questions && strcmp(word, questions[i].name) != 0)
			i++;
		if (i == sizeof questions / sizeof *questions)
			return 1;
		questions[i].answer();
		printf("\n");
	}
	return 0;
}

/* playground.c - what the page asks: the library, on buffers that the page fills and reads.
 *
 * The page writes a path (verbs, points, weights: those of ew_path_moments) and calls `region`;
 * then the integrals over that region are asked one by one. One ring of lines is measured by the
 * functions for rings, anything else by those for paths, which take curves as they are. Distance
 * and filters know lines only: for them curves become chords, here, that are nowhere farther than
 * the given tolerance from the curve. Coordinates are in units of the drawing; for filters and
 * images they are scaled first, so that a pixel is 1.
 *
 * Everything that is not static is exported to the page by its name. */

#include <math.h>
#include <string.h>

#include "edgewise.h"

#define EXPORT __attribute__((visibility("default")))

enum {
	MAX_POINTS = 4096,
	MAX_VERTICES = 1 << 16,
	MAX_PIXELS = 64 * 48,
	DEEPEST = 12,           /* a curve becomes at most 2^12 chords */
	SHADES = 256            /* of a palette, for each unit of a pixel's value from -1 to 2 */
};

/* From the page. */
EXPORT unsigned char verbs[MAX_POINTS];
EXPORT double points[2 * MAX_POINTS], weights[MAX_POINTS];
EXPORT uint32_t palette[3 * SHADES + 1];

/* For the page. */
EXPORT double moments[EW_MOMENTS(2)], bounds[EW_MOMENTS(2)], central[EW_MOMENTS(2)], centroid[2];
EXPORT double vertex_x[MAX_VERTICES], vertex_y[MAX_VERTICES];
EXPORT int32_t offsets[MAX_POINTS + 1];
EXPORT double filtered[3];
EXPORT float values[MAX_PIXELS];
EXPORT uint32_t shades[MAX_PIXELS];

static size_t verb_count, point_count, weight_count, rings;
static double scaled_x[MAX_VERTICES], scaled_y[MAX_VERTICES], scaled_points[2 * MAX_POINTS];

static const ew_filter *const filters[] = { &ew_filter_box, &ew_filter_tent, &ew_filter_mitchell };

/* ---- curves to chords ---- */

static size_t vertices;
static double tolerance;

static int vertex(double x, double y)
{
	if (vertices == MAX_VERTICES)
		return EW_NO_MEMORY;
	vertex_x[vertices] = x;
	vertex_y[vertices] = y;
	vertices++;
	return EW_OK;
}

/* A conic of weights 1, w, 1; w = 1 is a quadratic. Each of its points is a p1 + (1-a) times a
 * point of the chord, a at most w/(1+w): no farther than that from the chord, times |p1 - middle|. */
static int conic(const double *p, double w, int depth)
{
	const double mx = (p[0] + p[4]) / 2, my = (p[1] + p[5]) / 2, f = w / (1 + w);
	if (depth == DEEPEST || f * hypot(p[2] - mx, p[3] - my) <= tolerance)
		return vertex(p[4], p[5]);
	const double x = mx + f * (p[2] - mx), y = my + f * (p[3] - my);
	const double half = sqrt((1 + w) / 2);
	const double a[] = { p[0], p[1], (p[0] + w * p[2]) / (1 + w), (p[1] + w * p[3]) / (1 + w),
		x, y };
	const double b[] = { x, y, (w * p[2] + p[4]) / (1 + w), (w * p[3] + p[5]) / (1 + w), p[4],
		p[5] };
	const int status = conic(a, half, depth + 1);
	return status != EW_OK ? status : conic(b, half, depth + 1);
}

/* A cubic is nowhere farther from its chord than 3/4 of its larger second difference. */
static int cubic(const double *p, int depth)
{
	const double ux = p[0] - 2 * p[2] + p[4], uy = p[1] - 2 * p[3] + p[5];
	const double vx = p[2] - 2 * p[4] + p[6], vy = p[3] - 2 * p[5] + p[7];
	if (depth == DEEPEST || 0.75 * fmax(hypot(ux, uy), hypot(vx, vy)) <= tolerance)
		return vertex(p[6], p[7]);
	double a[8], b[8];
	for (int i = 0; i < 2; i++) {
		const double l = (p[i] + p[2 + i]) / 2, m = (p[2 + i] + p[4 + i]) / 2;
		const double r = (p[4 + i] + p[6 + i]) / 2;
		a[i] = p[i];
		a[2 + i] = l;
		a[4 + i] = (l + m) / 2;
		b[2 + i] = (m + r) / 2;
		a[6 + i] = b[i] = (a[4 + i] + b[2 + i]) / 2;
		b[4 + i] = r;
		b[6 + i] = p[6 + i];
	}
	const int status = cubic(a, depth + 1);
	return status != EW_OK ? status : cubic(b, depth + 1);
}

/* Every ring of the path, as lines. */
static int flatten(void)
{
	const double *p = points, *weight = weights;
	int status = EW_OK;
	vertices = rings = 0;
	for (size_t i = 0; i < verb_count && status == EW_OK; i++) {
		switch (verbs[i]) {
		case EW_MOVE:
			offsets[rings++] = (int32_t)vertices;
			status = vertex(p[0], p[1]);
			p += 2;
			break;
		case EW_LINE:
			status = vertex(p[0], p[1]);
			p += 2;
			break;
		case EW_QUAD:
			status = conic(p - 2, 1, 0);
			p += 4;
			break;
		case EW_CONIC:
			status = conic(p - 2, *weight++, 0);
			p += 4;
			break;
		case EW_CUBIC:
			status = cubic(p - 2, 0);
			p += 6;
			break;
		default:
			break;
		}
	}
	offsets[rings] = (int32_t)vertices;
	return status;
}

/* ---- what the page calls ---- */

static int one_ring_of_lines(void)
{
	for (size_t i = 0; i < verb_count; i++)
		if (verbs[i] != (i == 0 ? EW_MOVE : i == verb_count - 1 ? EW_CLOSE : EW_LINE))
			return 0;
	return 1;
}

/* No number where there is no region. */
static int fail(int status)
{
	vertices = rings = 0;
	for (int i = 0; i < EW_MOMENTS(2); i++)
		moments[i] = central[i] = bounds[i] = NAN;
	centroid[0] = centroid[1] = NAN;
	return status;
}

/* Takes the path that stands in the buffers, and computes `moments` about (0,0), `bounds` of their
 * errors (of one ring of lines; else NaN), `centroid`, and `central` moments about it. */
EXPORT int region(size_t verb_total, size_t point_total, size_t weight_total, double farthest)
{
	verb_count = verb_total;
	point_count = point_total;
	weight_count = weight_total;
	tolerance = farthest;
	int status = ew_path_moments(2, verbs, verb_count, points, point_count, weights, weight_count,
		moments);
	if (status == EW_OK)
		status = flatten();
	if (status != EW_OK)
		return fail(status);
	if (one_ring_of_lines()) {
		ew_moments_bounded(2, vertex_x, vertex_y, vertices, moments, bounds);
		return ew_central_moments(2, vertex_x, vertex_y, vertices, centroid, central);
	}
	for (int i = 0; i < EW_MOMENTS(2); i++)
		bounds[i] = NAN;
	centroid[0] = moments[1] / moments[0];
	centroid[1] = moments[2] / moments[0];
	return ew_translate_moments(2, moments, -centroid[0], -centroid[1], central);
}

/* How many lines the region has now: its edges, or their chords. */
EXPORT size_t lines(void)
{
	return vertices;
}

EXPORT double distance(double x, double y)
{
	double sum = 0;
	for (size_t i = 0; i < rings; i++)
		sum += ew_distance(vertex_x + offsets[i], vertex_y + offsets[i],
			(size_t)(offsets[i + 1] - offsets[i]), x, y);
	return sum;
}

/* `filtered` by box, tent and Mitchell, centred at (x,y), with `scale` pixels per unit. */
EXPORT void filter(double scale, double x, double y)
{
	const double cx = scale * x, cy = scale * y;
	for (size_t i = 0; i < vertices; i++) {
		scaled_x[i] = scale * vertex_x[i];
		scaled_y[i] = scale * vertex_y[i];
	}
	memset(filtered, 0, sizeof filtered);
	for (size_t i = 0; i < rings; i++) {
		const double *const rx = scaled_x + offsets[i], *const ry = scaled_y + offsets[i];
		const size_t n = (size_t)(offsets[i + 1] - offsets[i]);
		filtered[0] += ew_box(rx, ry, n, cx, cy);
		filtered[1] += ew_tent(rx, ry, n, cx, cy);
		filtered[2] += ew_mitchell(rx, ry, n, cx, cy);
	}
}

/* The image by filter `which`, with the lower left corner at (x,y) and y upwards: `values`, and as
 * `shades` of the palette. */
EXPORT int picture(int which, double scale, double x, double y, int width, int height)
{
	if (width < 1 || height < 1 || width > MAX_PIXELS / height)
		return EW_BAD_IMAGE;
	const int pixels = width * height;
	for (size_t i = 0; i < point_count; i++) {
		scaled_points[2 * i] = scale * (points[2 * i] - x);
		scaled_points[2 * i + 1] = scale * (points[2 * i + 1] - y);
	}
	const int status = ew_raster_path(filters[which], verbs, verb_count, scaled_points,
		point_count, weights, weight_count, values + pixels - width, width, height, -width);
	if (status != EW_OK)
		return status;
	for (int i = 0; i < pixels; i++) {
		const float value = fminf(fmaxf(values[i], -1), 2);
		shades[i] = palette[(int)((value + 1) * SHADES + 0.5F)];
	}
	return EW_OK;
}

/* The name of the kernels that are running. */
EXPORT const char *target(void)
{
	unsigned best = ew_targets();
	while (best & (best - 1))
		best &= best - 1;
	return ew_target_name(best);
}

/* shapes.c - the output of `shapes --exact` against exact rationals.
 *
 * The printed vertices are taken as they are: every double is a rational, so the moments of the
 * polygons have exact values. They come from the definition: each ring is a fan of triangles around
 * its first vertex, and the integral of a quadratic over a triangle is its area times the mean of
 * the integrand at the midpoints of the sides. The printed results must lie within a-priori bounds,
 * which stand above the function that asserts them. There u = 2^-53, gamma(k) = k u/(1 - k u), and
 * W is the sum over all edges of the terms of the edge formula, each of them made positive.
 *
 * Beside that, the projection is checked against another formula for it, and the largest shape
 * must come first. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <gmp.h>

#include "printed_moments.h"

enum { RAW, CENTROID, CENTRAL, AXIS, PROJECTION, ORDER, GROUPS };

static Group groups[GROUPS] = {
	{ .name = "raw moments" },
	{ .name = "centroid" },
	{ .name = "second moments" },
	{ .name = "axis" },
	{ .name = "projection" },
	{ .name = "order" },
};
static const double RADIUS = 6371.0072;

typedef struct {
	double x, y, lon, lat;
} Vertex;

typedef struct {
	char name[64];
	Vertex *vertices;
	size_t *starts; /* rings + 1 of them */
	size_t rings, longest;
	double middle[2], raw[MOMENTS], centroid[4], central[3], axis;
} Shape;

static void check(int group, const Shape *shape, const char *what, double error, double bound)
{
	check_within(&groups[group], shape->name, what, error, bound);
}

/* ---- input ---- */

static void read_ring(Shape *shape)
{
	size_t start = shape->starts[shape->rings], count = strtoul(line + 5, NULL, 10);
	if (count < 3 || count > 1000000)
		malformed("3 to 1000000 vertices");
	shape->longest = count > shape->longest ? count : shape->longest;
	shape->starts = resize(shape->starts, (shape->rings + 2) * sizeof *shape->starts);
	shape->starts[++shape->rings] = start + count;
	shape->vertices = resize(shape->vertices, (start + count) * sizeof *shape->vertices);
	next_line();
	for (size_t i = start; i < start + count; i++) {
		double numbers[4];
		take_finite("", numbers, 4);
		shape->vertices[i] = (Vertex){ numbers[0], numbers[1], numbers[2], numbers[3] };
	}
}

static void read_shape(Shape *shape)
{
	if (!starts_with("shape "))
		malformed("shape");
	shape->rings = shape->longest = 0;
	shape->starts = resize(shape->starts, sizeof *shape->starts);
	shape->starts[0] = 0;
	snprintf(shape->name, sizeof shape->name, "%.63s", line + 6);
	next_line();
	take_finite("middle ", shape->middle, 2);
	while (starts_with("ring ") || starts_with("hole "))
		read_ring(shape);
	if (!shape->rings)
		malformed("ring");
	take_finite("raw ", shape->raw, MOMENTS);
	take_finite("centroid ", shape->centroid, 4);
	take_finite("central ", shape->central, 3);
	take_finite("axis ", &shape->axis, 1);
}

/* ---- exact values ---- */

typedef struct {
	mpq_t moments[MOMENTS], centroid[2], central[3]; /* central: mu20, mu11, mu02 */
} Exact;

static mpq_t corner_x[3], corner_y[3], middle_x[3], middle_y[3], cross, sum, term;

/* middle_x, middle_y are twice the midpoints of the sides, cross is twice the area. */
static void set_triangle(const Vertex *a, const Vertex *b, const Vertex *c)
{
	const Vertex *corners[3] = { a, b, c };
	for (int i = 0; i < 3; i++) {
		mpq_set_d(corner_x[i], corners[i]->x);
		mpq_set_d(corner_y[i], corners[i]->y);
	}
	for (int i = 0; i < 3; i++) {
		mpq_add(middle_x[i], corner_x[i], corner_x[(i + 1) % 3]);
		mpq_add(middle_y[i], corner_y[i], corner_y[(i + 1) % 3]);
	}
	for (int i = 1; i < 3; i++) {
		mpq_sub(corner_x[i], corner_x[i], corner_x[0]);
		mpq_sub(corner_y[i], corner_y[i], corner_y[0]);
	}
	mpq_mul(cross, corner_x[1], corner_y[2]);
	mpq_mul(term, corner_x[2], corner_y[1]);
	mpq_sub(cross, cross, term);
}

static void add_triangle(mpq_t *moments)
{
	for (int k = 0; k < MOMENTS; k++) {
		mpq_set_ui(sum, 0, 1);
		for (int i = 0; i < 3; i++) {
			mpq_set_ui(term, 1, 6ul << (power_x[k] + power_y[k]));
			for (int j = 0; j < power_x[k]; j++)
				mpq_mul(term, term, middle_x[i]);
			for (int j = 0; j < power_y[k]; j++)
				mpq_mul(term, term, middle_y[i]);
			mpq_add(sum, sum, term);
		}
		mpq_mul(sum, sum, cross);
		mpq_add(moments[k], moments[k], sum);
	}
}

static void set_exact(Exact *exact, const Shape *shape)
{
	mpq_t *m = exact->moments;
	for (int k = 0; k < MOMENTS; k++)
		mpq_set_ui(m[k], 0, 1);
	for (size_t ring = 0; ring < shape->rings; ring++) {
		const Vertex *first = &shape->vertices[shape->starts[ring]];
		size_t count = shape->starts[ring + 1] - shape->starts[ring];
		for (size_t i = 1; i + 1 < count; i++) {
			set_triangle(first, first + i, first + i + 1);
			add_triangle(m);
		}
	}
	for (int i = 0; i < 2 && mpq_sgn(m[M00]); i++)
		mpq_div(exact->centroid[i], m[M10 + i], m[M00]);
	for (int i = 0; i < 3; i++) {
		mpq_mul(term, m[i < 2 ? M10 : M01], exact->centroid[i > 0]);
		mpq_sub(exact->central[i], m[M20 + i], term);
	}
}

static double distance(const mpq_t exact, double printed)
{
	mpq_set_d(term, printed);
	mpq_sub(term, term, exact);
	return fabs(mpq_get_d(term));
}

/* ---- checks ---- */

/* W of every moment about (cx, cy). */
static void weigh(const Shape *shape, double cx, double cy, double w[MOMENTS])
{
	memset(w, 0, MOMENTS * sizeof *w);
	for (size_t ring = 0; ring < shape->rings; ring++) {
		size_t start = shape->starts[ring], end = shape->starts[ring + 1];
		for (size_t i = start; i < end; i++) {
			const Vertex *p = &shape->vertices[i];
			const Vertex *q = &shape->vertices[i + 1 < end ? i + 1 : start];
			double a = fabs(p->x - cx), b = fabs(p->y - cy);
			double c = fabs(q->x - cx), d = fabs(q->y - cy);
			double s = a * d + c * b;
			w[M00] += s / 2;
			w[M10] += s / 6 * (a + c);
			w[M01] += s / 6 * (b + d);
			w[M20] += s / 12 * (a * a + a * c + c * c);
			w[M11] += s / 24 * (2 * a * b + a * d + c * b + 2 * c * d);
			w[M02] += s / 12 * (b * b + b * d + d * d);
		}
	}
}

/* With t = 2 axis, (cos t, sin t) must have the direction of v = (mu20 - mu02, 2 mu11): their dot
 * product is positive and their cross product vanishes but for the errors of v (the bounds of the
 * second moments) and of the angle: the difference, atan2 and the operations after it, and the
 * cosine, sine and product here, together below 64 u |v|. If v drowns in its error, any axis is
 * right. */
static void check_axis(const Shape *shape, const Exact *exact, const double bound[3])
{
	mpq_sub(term, exact->central[0], exact->central[2]);
	double vx = mpq_get_d(term), vy = 2 * mpq_get_d(exact->central[1]), size = hypot(vx, vy);
	double angle = shape->axis * (acos(-1) / 90), c = cos(angle), s = sin(angle);
	double v_error = SLACK * hypot(bound[0] + bound[2], 2 * bound[1]);
	check(AXIS, shape, "the range", shape->axis > -90 ? shape->axis : INFINITY, 90);
	check(AXIS, shape, "the direction", fabs(vx * s - vy * c), v_error + 64 * U * size);
	check(AXIS, shape, "the sign", -(vx * c + vy * s), size > v_error ? 0 : INFINITY);
}

/* The centroid is c' = m10'/m00', rounded, where ' marks a computed value. From
 *     m10'/m00' - m10/m00 = ((m10' - m10) - c (m00' - m00))/m00'
 * follows |c' - c| <= (E10 + |c| E00)/(|m00| - E00) + u |c'|, E being the bounds of the raw
 * moments. */
static void check_centroid(const Shape *shape, const Exact *exact, const double e[MOMENTS],
			   double bound[2])
{
	double area = fabs(mpq_get_d(exact->moments[M00]));
	check(CENTROID, shape, "the area", e[M00], area / 2);
	for (int i = 0; i < 2; i++) {
		double c = fabs(mpq_get_d(exact->centroid[i]));
		bound[i] = SLACK * ((e[M10 + i] + c * e[M00]) / (area - e[M00]) +
				    U * fabs(shape->centroid[i]));
		check(CENTROID, shape, i ? "y" : "x",
		      distance(exact->centroid[i], shape->centroid[i]), bound[i]);
	}
}

/* Raw moments: |m' - m| <= gamma(K) W with K = k + r (ceil(n/8) - 1) + 3 + the number of rings. The
 * list of kernels promises k for one item of the moments of degree 2, the worst of the six, and r
 * roundings per further item in one of 8 lanes, here those of the longest ring with n vertices; 3
 * reduce the lanes, and the results of the rings are added up.
 *
 * Second moments come from a second pass, about c'. A vertex minus c' is rounded once, a factor
 * 1 + e with |e| <= u, and a term holds four of those: gamma(K + 4) W, W about c'. The moments
 * about c' instead of c are larger by m00 (c' - c)(c' - c), at most |m00| d d with d the bound of
 * the centroid. Nothing underflows: coordinates are 0 or far above 1e-30 km. */
static void check_moments(const Shape *shape, const Exact *exact)
{
	double k = listed_roundings("moments", shape->longest) + 3 + (double)shape->rings;
	double bound[MOMENTS], d[2];
	weigh(shape, 0, 0, bound);
	for (int i = 0; i < MOMENTS; i++) {
		bound[i] *= gamma_of(k);
		check(RAW, shape, moment_names[i], distance(exact->moments[i], shape->raw[i]),
		      bound[i]);
	}
	check_centroid(shape, exact, bound, d);
	double area = SLACK * fabs(mpq_get_d(exact->moments[M00]));
	double moved[3] = { area * d[0] * d[0], area * d[0] * d[1], area * d[1] * d[1] };
	weigh(shape, shape->centroid[0], shape->centroid[1], bound);
	double *second = bound + M20;
	for (int i = 0; i < 3; i++) {
		second[i] = gamma_of(k + 4) * second[i] + moved[i];
		check(CENTRAL, shape, moment_names[M20 + i],
		      distance(exact->central[i], shape->central[i]), second[i]);
	}
	check_axis(shape, exact, second);
}

/* (lon, lat), projected about the middle by the formula with angles, is (x, y) to 1 micrometre. */
static void check_place(const Shape *shape, double lon, double lat, double x, double y)
{
	double degree = acos(-1) / 180, lambda = (lon - shape->middle[0]) * degree;
	double s = sin(lat * degree), c = cos(lat * degree);
	double s0 = sin(shape->middle[1] * degree), c0 = cos(shape->middle[1] * degree);
	double scale = RADIUS * sqrt(2 / (1 + s0 * s + c0 * c * cos(lambda)));
	double dx = scale * c * sin(lambda) - x;
	double dy = scale * (c0 * s - s0 * c * cos(lambda)) - y;
	check(PROJECTION, shape, "a place", hypot(dx, dy), 1e-9);
}

/* mpq_init or mpq_clear every rational of this program. */
static void every_rational(Exact *exact, void (*action)(mpq_ptr))
{
	mpq_t *arrays[] = { exact->moments, exact->centroid, exact->central, corner_x, corner_y,
			    middle_x,       middle_y,        &cross,         &sum,     &term };
	const int counts[] = { MOMENTS, 2, 3, 3, 3, 3, 3, 1, 1, 1 };
	for (int i = 0; i < 10; i++)
		for (int j = 0; j < counts[i]; j++)
			action(arrays[i][j]);
}

int main(void)
{
	Exact exact;
	Shape shape = { .name = "no shape" };
	double last = INFINITY;
	every_rational(&exact, mpq_init);
	next_line();
	do {
		read_shape(&shape);
		set_exact(&exact, &shape);
		check_moments(&shape, &exact);
		for (size_t i = 0; i < shape.starts[shape.rings]; i++) {
			const Vertex *v = &shape.vertices[i];
			check_place(&shape, v->lon, v->lat, v->x, v->y);
		}
		const double *centroid = shape.centroid;
		check_place(&shape, centroid[2], centroid[3], centroid[0], centroid[1]);
		check(ORDER, &shape, "the order", shape.raw[M00] - last, 0);
		last = shape.raw[M00];
	} while (line[0] || !feof(stdin));
	every_rational(&exact, mpq_clear);
	free(shape.vertices);
	free(shape.starts);
	return report(groups, GROUPS);
}

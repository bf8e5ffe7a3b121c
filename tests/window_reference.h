/* window_reference.h - exact integrals of piecewise polynomials over polygons, in GMP rationals.
 *
 * Nothing here knows the generator, its formulas or its filter files. A filter is a list of
 * polynomials on rectangles; the polygon is clipped against each (Sutherland and Hodgman) and the
 * polynomial integrated over what is left. Clipping a ring by a half-plane keeps the part of its
 * region there, winding numbers included, so rings may intersect themselves.
 *
 * An edge alone counts as the ring around the region below it, down to beneath everything: the
 * contribution of p -> q is - INT_px^qx INT_-inf^y(x) f(x,s) ds dx, and the sum over a ring that
 * of its region, counterclockwise positive.
 */
#ifndef WINDOW_REFERENCE_H
#define WINDOW_REFERENCE_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

enum { WINDOW_DEGREE = 5, WINDOW_POWERS = WINDOW_DEGREE + 1 };      /* per axis */

/* Rational numbers as text. A piece of an axis: c[i] is the coefficient of x^i, NULL ends them. */
typedef struct {
	const char *from, *to;
	const char *c[WINDOW_POWERS];
} WindowAxis;

/* c x^a y^b; a NULL ends them. */
typedef struct {
	const char *c;
	int a, b;
} WindowTerm;

typedef struct {
	const char *x0, *x1, *y0, *y1;
	WindowTerm terms[8];
} WindowPatch;

typedef struct {
	mpq_t x0, x1, y0, y1;
	int degree_x, degree_y;
	mpq_t c[WINDOW_POWERS][WINDOW_POWERS];      /* [a][b] of x^a y^b */
} WindowPiece;

typedef struct {
	int count;
	WindowPiece *pieces;
} WindowFilter;

/* 1 on the rectangle. */
WindowFilter *window_rectangle(double u0, double u1, double v0, double v1);

/* k(x) k(y); even: the pieces are those of x >= 0. */
WindowFilter *window_separable(const WindowAxis *axis, int count, bool even);

WindowFilter *window_bivariate(const WindowPatch *patches, int count);

/* The B-spline of a degree, the box convolved with itself: degree 0 is the box, 1 the tent. */
WindowFilter *window_bspline(int degree);

/* The cubics of Mitchell and Netravali with B = b/3 and C = c/6. */
WindowFilter *window_cubic(int b, int c);

void window_free(WindowFilter *filter);

/* The filter centred at (cx,cy), integrated over the region of a ring. */
void window_ring(mpq_t out, const WindowFilter *filter, const double *x, const double *y,
	size_t n, double cx, double cy);

/* The contribution of the edge x0, y0, x1, y1. */
void window_edge(mpq_t out, const WindowFilter *filter, const double edge[4], double cx,
	double cy);

/* The sum over its pieces of the integral of all terms made positive, in coordinates relative to
 * the lower left corner: what the rounding errors of its evaluation are proportional to. */
double window_weight(const WindowFilter *filter);

/* The filter itself; at knots it is the mean of the limits of its pieces. */
double window_value(const WindowFilter *filter, double x, double y);

/* The signed area of the edge within a rectangle by another route, one fraction of integers in
 * which nothing is ever cancelled: fast enough for millions. rectangle is u0, u1, v0, v1. */
typedef struct {
	mpz_t number[8], top, bottom, work[6];
	int shift;
} WindowArea;

void window_area_init(WindowArea *area);
void window_area_clear(WindowArea *area);
void window_area(WindowArea *area, const double edge[4], const double rectangle[4]);

/* |computed - area| and the area itself, either rounded to double in the end. */
double window_area_error(WindowArea *area, double computed);
double window_area_value(WindowArea *area);

/* |computed - exact|, rounded to double in the end. */
double window_error(double computed, const mpq_t exact);

#endif

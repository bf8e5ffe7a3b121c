/* curve_reference.h - moments of single edges: lines, quads and cubics in exact rationals, conics
 * to more than 300 bits.
 *
 * Nothing here knows the generator, its formulas, its quadrature or its constants. Conventions are
 * those of reference.h: a Ref carries the value and the weight W of the bound gamma_k W. Moments
 * are form 3, counterclockwise positive:
 *
 *     M_mn = 1/(m+n+2) int x^m y^n (x dy - y dx)    along the edge.
 *
 * A conic has the weights 1, w, 1; w > -1 may be infinite. Its value is rounded to CONIC_BITS bits,
 * which is exact for every purpose here.
 */
#ifndef CURVE_REFERENCE_H
#define CURVE_REFERENCE_H

#include <mpfr.h>

#include "reference.h"

/* Kinds have the numbers that verbs of paths have. */
enum { CURVE_LINE = 1, CURVE_QUAD, CURVE_CONIC, CURVE_CUBIC, CURVE_KINDS };
enum { CURVE_POINTS = 4, CURVE_MAX_DEGREE = 8, CONIC_BITS = 320 };

typedef struct {
	int kind;
	double x[CURVE_POINTS], y[CURVE_POINTS];        /* control points */
	double w;                                       /* of a conic */
} Curve;

int curve_points(int kind);
Curve curve_reversed(const Curve *c);

/* The area and the weight of the formula for it: control points made positive in
 * sum k_ij (x_i y_j - x_j y_i), k_ij > 0; for a conic in
 * 1/2 (x0 y2 - x2 y0) + |f(w)| 1/2 ((x1-x0)(y2-y0) - (x2-x0)(y1-y0)), beyond w = 2^40 that of the
 * lines p0, p1 and p1, p2. */
void curve_area(Ref *out, const Curve *c);

/* Adds all ref_count(degree) moments to out.
 *
 * Weights: of a line as in reference.h. Of quads and cubics from the power basis about the middle,
 * t = (1 + tau)/2: with x(tau) = sum c_j tau^j, y(tau) = sum d_j tau^j and x y' - y x' =
 * sum o_j tau^j, o_j = sum (l - i) (c_i d_l - c_l d_i) over i < l, i + l = j + 1,
 *
 *     W_mn = 1/(m+n+2) int_-1^1 (sum |c_j||tau|^j)^m (sum |d_j||tau|^j)^n sum |o_j||tau|^j dtau,
 *
 * where every term of every c_j, d_j and o_j is positive; for degree 0 that of the area. Of a
 * conic: the line p0, p2, and beyond it
 *
 *     T sum |terms of (a_x + b_x X + c_x Y)^m (a_y + b_y X + c_y Y)^n| I_ab,
 *     I_ab = |int X^a Y^b|
 *
 * over the region X^2 <= 1 - 2 Y + (1 - 1/w^2) Y^2 between chord and arc in its own coordinates,
 * p = a + b X + c Y with a = (p0+p2)/2, b = (p2-p0)/2, c = p1 - a, T = 1/2 cross(p1-p0, p2-p0), all
 * with every term positive (differences are terms of T). Terms with odd powers of X vanish, and are
 * not counted. Moments of degree > 0 of an arc with w < 0 or w > 3 are sums over its halves, t = 1/2,
 * and these have the weights: of control points with every term positive, and of T with differences
 * taken as sums. From w = 2^40 on: the lines p0, p1 and p1, p2. */
void curve_add(Ref *out, int degree, const Curve *c);

/* The moments of a conic alone, ref_count(degree) initialised numbers. */
void conic_moments(mpfr_t *out, int degree, const Curve *c);

/* f of area = 1/2 cross(p0,p2) + f(w) T, for -1 < w <= infinity. */
void conic_factor(mpfr_t out, double w);

/* |computed - want| in units of the last place of want rounded to bits. */
double ref_ulps(double computed, const mpfr_t want, int bits);

#endif

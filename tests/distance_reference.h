/* distance_reference.h - integrals of powers of the distance from the origin, in MPFR.
 *
 * An edge p0 -> p1 contributes to the integral of r^k the signed triangle (origin, p0, p1),
 *
 *     I_k = s/(k+2) int_0^1 |p0 + t (p1 - p0)|^k dt,    s = x0 y1 - x1 y0,    k = -1, 1, 3, 5.
 *
 * Coordinates are taken about (cx,cy), exactly. distance_edge takes the textbook's antiderivative,
 * which may cancel as it likes at this precision; distance_quadrature integrates the line above
 * numerically and knows no closed form. Neither shares a formula with the generator.
 */
#ifndef DISTANCE_REFERENCE_H
#define DISTANCE_REFERENCE_H

#include <mpfr.h>

enum { DISTANCE_BITS = 448, DISTANCE_POWERS = 4 };      /* powers -1, 1, 3, 5 */

typedef struct {
	mpfr_t value[DISTANCE_POWERS];
} Distances;

void distance_init(Distances *d);
void distance_clear(Distances *d);

/* edge is x0, y0, x1, y1. */
void distance_edge(Distances *out, const double edge[4], double cx, double cy);
void distance_quadrature(Distances *out, const double edge[4], double cx, double cy);

#endif

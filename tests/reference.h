/* reference.h - exact moments of rings, from the definition, in GMP integers and rationals.
 *
 * Nothing here knows the generator, its formulas or its coefficients. Moments stand in the usual
 * order 1, x, y, x2, xy, y2, ...; a Ref carries the exact value and the exact weight W, which is
 * the same sum with every term made positive, so that a computed number can be held against
 *
 *     |computed - value| <= gamma_k W + tiny,      gamma_k = k u / (1 - k u),  u = 2^-bits
 *
 * without any rounding in the comparison.
 */
#ifndef REFERENCE_H
#define REFERENCE_H

#include <gmp.h>
#include <stdbool.h>
#include <stddef.h>

enum { REF_MAX_DEGREE = 32 };

typedef struct {
	mpq_t value;
	mpq_t weight;
} Ref;

int ref_count(int degree);          /* monomials of degree <= degree */
int ref_index(int m, int n);

unsigned long ref_lcm(unsigned long last);    /* the least common multiple of 1, 2, ... last */

Ref *ref_new(int count);            /* all 0 */
void ref_free(Ref *refs, int count);

/* The signed triangle (0,0), (x0,y0), (x1,y1); edge is x0, y0, x1, y1. */
void ref_line(Ref *out, int m, int n, const double edge[4]);

/* All ref_count(degree) moments of the ring, each the sum over its edges. */
void ref_ring(Ref *out, int degree, const double *x, const double *y, size_t n);

/* The area; its weight is that of 1/2 sum (x_i - x_0) (y_(i+1) - y_(i-1)). */
void ref_area(Ref *out, const double *x, const double *y, size_t n);

/* Moments of the region moved by (dx,dy); weights move by (|dx|,|dy|). out is not in. */
void ref_translate(Ref *out, int degree, const Ref *in, const mpq_t dx, const mpq_t dy);

/* gamma_k for u = 2^-bits. */
void ref_gamma(mpq_t out, long k, int bits);

/* What underflow may add over n edges: k n denorm_min max(1,|coordinate|)^(degree+1) if some
 * product of coordinates can be subnormal, otherwise 0. bits is 53 or 24. */
double ref_tiny(long k, int degree, int bits, const double *x, const double *y, size_t n);

/* |computed - value| <= gamma_k weight + tiny; false for NaN and infinity. */
bool ref_within(double computed, const Ref *want, long k, int bits, double tiny);

/* |computed - value| / (u weight), for messages. */
double ref_units(double computed, const Ref *want, int bits);

#endif

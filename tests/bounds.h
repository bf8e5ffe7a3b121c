/* bounds.h - holding computed numbers against exact ones, and the sizes that still fit.
 */
#ifndef BOUNDS_H
#define BOUNDS_H

#include <float.h>
#include <math.h>

#include "check.h"
#include "reference.h"

/* |got - want| <= gamma_k W + tiny with u = 2^-bits; the format says what was computed. */
__attribute__((format(printf, 6, 7)))
static inline bool expect_within(double got, const Ref *want, long k, int bits, double tiny,
	const char *format, ...)
{
	if (ref_within(got, want, k, bits, tiny))
		return true;
	char text[400];
	va_list arguments;
	va_start(arguments, format);
	vsnprintf(text, sizeof text, format, arguments);
	va_end(arguments);
	return expect(false, "%s = %.17g, exact %.17g, off by %.4g u W, allowed %ld", text, got,
		mpq_get_d(want->value), ref_units(got, want, bits), k);
}

static inline double gamma_of(long k, int bits)
{
	return (double)k / (ldexp(1, bits) - (double)k);
}

/* Equal bits, except that the two zeros are one. */
static inline bool same_bits(double a, double b)
{
	return memcmp(&a, &b, sizeof a) == 0 || (a == 0 && b == 0);
}

/* volatile, because gcc 12 at -O2 drops the conversions of two doubles side by side. */
static inline double round_to(int bits, double v)
{
	if (bits != 24)
		return v;
	const volatile float rounded = (float)v;
	return (double)rounded;
}

/* The largest value of cross * h on coordinates of size 1, for any x^m y^n of this degree: before
 * the rational factor is applied, h_mn(1,1,1,1) = (degree+1) C(degree,n) and the cross is 2. */
static inline double largest_sum(int degree)
{
	double binomial = 1;
	for (int i = 1; i <= degree / 2; i++)
		binomial = binomial * (degree - i + 1) / i;
	return 2 * (degree + 1) * binomial;
}

/* The smallest rational factor m! n! / (m+n+2)! of this degree. */
static inline double smallest_factor(int degree)
{
	const double a = tgamma(degree / 2 + 1), b = tgamma(degree - degree / 2 + 1);
	return a * b / tgamma(degree + 3);
}

/* 1e30; for float the largest power of ten for which sums over n edges of this degree fit. */
static inline double large_scale(int degree, int bits, double n)
{
	double scale = 1e30;
	while (bits == 24 && pow(scale, degree + 2) * largest_sum(degree) * n > (double)FLT_MAX)
		scale /= 10;
	return scale;
}

/* 1e-30; for float the smallest power of ten at which a product of degree + 2 coordinates of half
 * that size and the factor is no subnormal. */
static inline double small_scale(int degree, int bits)
{
	double scale = 1e-30;
	while (bits == 24 && pow(scale / 2, degree + 2) * smallest_factor(degree) < (double)FLT_MIN)
		scale *= 10;
	return scale;
}

#endif

/* Exact moments of rings, from the definition.
 *
 * The integral of x^m y^n over the signed triangle of the origin and one edge is
 *
 *     1/(m+n+2) * int_0^1 x(t)^m y(t)^n (x y' - y x') dt,   x(t) = x0 + (x1 - x0) t, y likewise.
 *
 * All coordinates of a ring are doubles, so one power of two makes them integers; x(t)^m and y(t)^n
 * are then polynomials in t with integer coefficients, multiplied out one factor at a time, and
 * t^k integrates to 1/(k+1), with lcm(1..m+n+1) as the common denominator. The only divisions are
 * two exact ones at the very end, so a ring of 10^5 vertices takes about a second.
 *
 * The weight W of an edge makes every term positive: it is the same integral of |x0|, |y0|, |x1|,
 * |y1| with |x0 y1| + |x1 y0| for the cross product.
 */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "reference.h"

typedef mpz_t Powers[REF_MAX_DEGREE + 1][REF_MAX_DEGREE + 1];   /* [m][i]: t^i in x(t)^m */

typedef struct {
	mpz_t x0, y0, x1, y1;      /* the edge, as integers */
	mpz_t cross;               /* its x y' - y x', or the positive version */
	Powers x, y;
	mpz_t inner, sum, step;
} Work;

int ref_count(int degree)
{
	return (degree + 1) * (degree + 2) / 2;
}

int ref_index(int m, int n)
{
	return (m + n) * (m + n + 1) / 2 + n;
}

Ref *ref_new(int count)
{
	Ref *refs = malloc((size_t)count * sizeof *refs);
	if (!refs)
		abort();
	for (int i = 0; i < count; i++)
		mpq_inits(refs[i].value, refs[i].weight, NULL);
	return refs;
}

void ref_free(Ref *refs, int count)
{
	for (int i = 0; i < count; i++)
		mpq_clears(refs[i].value, refs[i].weight, NULL);
	free(refs);
}

static Work *work_new(void)
{
	Work *w = malloc(sizeof *w);
	if (!w)
		abort();
	mpz_inits(w->x0, w->y0, w->x1, w->y1, w->cross, w->inner, w->sum, w->step, NULL);
	for (int m = 0; m <= REF_MAX_DEGREE; m++) {
		for (int i = 0; i <= m; i++)
			mpz_inits(w->x[m][i], w->y[m][i], NULL);
	}
	return w;
}

static void work_free(Work *w)
{
	mpz_clears(w->x0, w->y0, w->x1, w->y1, w->cross, w->inner, w->sum, w->step, NULL);
	for (int m = 0; m <= REF_MAX_DEGREE; m++) {
		for (int i = 0; i <= m; i++)
			mpz_clears(w->x[m][i], w->y[m][i], NULL);
	}
	free(w);
}

/* The smallest shift >= least for which v 2^shift is an integer. */
static int needed_shift(double v, int least)
{
	int exponent;
	const double fraction = frexp(v, &exponent);
	int64_t mantissa = (int64_t)ldexp(fraction, 53);
	if (mantissa == 0)
		return least;
	for (exponent -= 53; mantissa % 2 == 0; mantissa /= 2)
		exponent++;
	return -exponent > least ? -exponent : least;
}

static int common_shift(const double *x, const double *y, size_t n)
{
	int shift = 0;
	for (size_t i = 0; i < n; i++)
		shift = needed_shift(y[i], needed_shift(x[i], shift));
	return shift;
}

/* out = v 2^shift, which is an integer. */
static void set_scaled(mpz_t out, double v, int shift)
{
	int exponent;
	mpz_set_d(out, ldexp(frexp(v, &exponent), 53));
	exponent += shift - 53;
	if (exponent >= 0)
		mpz_mul_2exp(out, out, (mp_bitcnt_t)exponent);
	else
		mpz_tdiv_q_2exp(out, out, (mp_bitcnt_t)-exponent);
}

static void set_edge(Work *w, double x0, double y0, double x1, double y1, int shift)
{
	set_scaled(w->x0, x0, shift);
	set_scaled(w->y0, y0, shift);
	set_scaled(w->x1, x1, shift);
	set_scaled(w->y1, y1, shift);
}

/* p[m] = (start + (end - start) t)^m for all m <= degree */
static void set_powers(Powers p, int degree, const mpz_t start, const mpz_t end, mpz_t step)
{
	mpz_sub(step, end, start);
	mpz_set_ui(p[0][0], 1);
	for (int m = 1; m <= degree; m++) {
		mpz_mul(p[m][m], p[m - 1][m - 1], step);
		for (int i = 0; i < m; i++) {
			mpz_mul(p[m][i], p[m - 1][i], start);
			if (i > 0)
				mpz_addmul(p[m][i], p[m - 1][i - 1], step);
		}
	}
}

unsigned long ref_lcm(unsigned long last)
{
	unsigned long lcm = 1;
	for (unsigned long i = 2; i <= last; i++) {
		unsigned long a = lcm, b = i;
		while (b) {
			const unsigned long rest = a % b;
			a = b;
			b = rest;
		}
		lcm *= i / a;
	}
	return lcm;
}

/* total += cross * lcm * int_0^1 x^m y^n dt; lcm is a multiple of 1..m+n+1 */
static void add_integral(mpz_t total, Work *w, int m, int n, unsigned long lcm)
{
	mpz_set_ui(w->sum, 0);
	for (int i = 0; i <= m; i++) {
		mpz_set_ui(w->inner, 0);
		for (int j = 0; j <= n; j++)
			mpz_addmul_ui(w->inner, w->y[n][j], lcm / (unsigned long)(i + j + 1));
		mpz_addmul(w->sum, w->x[m][i], w->inner);
	}
	mpz_addmul(total, w->sum, w->cross);
}

/* Prepares the edge in w for signed integrals: cross = x0 (y1 - y0) - y0 (x1 - x0). */
static void make_signed(Work *w, int degree)
{
	set_powers(w->x, degree, w->x0, w->x1, w->step);
	mpz_neg(w->cross, w->step);
	mpz_mul(w->cross, w->cross, w->y0);
	set_powers(w->y, degree, w->y0, w->y1, w->step);
	mpz_addmul(w->cross, w->step, w->x0);
}

/* Prepares the edge in w for weights, and loses its signs. */
static void make_positive(Work *w, int degree)
{
	mpz_abs(w->x0, w->x0);
	mpz_abs(w->y0, w->y0);
	mpz_abs(w->x1, w->x1);
	mpz_abs(w->y1, w->y1);
	set_powers(w->x, degree, w->x0, w->x1, w->step);
	set_powers(w->y, degree, w->y0, w->y1, w->step);
	mpz_mul(w->cross, w->x0, w->y1);
	mpz_addmul(w->cross, w->x1, w->y0);
}

/* out = total / (divisor 2^bits) */
static void set_quotient(mpq_t out, const mpz_t total, unsigned long divisor, int bits)
{
	mpq_set_z(out, total);
	mpz_set_ui(mpq_denref(out), divisor);
	mpz_mul_2exp(mpq_denref(out), mpq_denref(out), (mp_bitcnt_t)bits);
	mpq_canonicalize(out);
}

void ref_line(Ref *out, int m, int n, const double edge[4])
{
	const int degree = m + n;
	const unsigned long lcm = ref_lcm((unsigned long)degree + 1);
	const int shift = common_shift(edge, edge + 2, 2);
	mpz_t total;
	Work *w = work_new();
	mpz_init(total);
	set_edge(w, edge[0], edge[1], edge[2], edge[3], shift);
	make_signed(w, degree);
	add_integral(total, w, m, n, lcm);
	set_quotient(out->value, total, lcm * (unsigned long)(degree + 2), shift * (degree + 2));
	make_positive(w, degree);
	mpz_set_ui(total, 0);
	add_integral(total, w, m, n, lcm);
	set_quotient(out->weight, total, lcm * (unsigned long)(degree + 2), shift * (degree + 2));
	mpz_clear(total);
	work_free(w);
}

static void add_all(mpz_t *total, Work *w, int degree, unsigned long lcm)
{
	for (int n = 0; n <= degree; n++) {
		for (int m = 0; m + n <= degree; m++)
			add_integral(total[ref_index(m, n)], w, m, n, lcm);
	}
}

void ref_ring(Ref *out, int degree, const double *x, const double *y, size_t n)
{
	const int count = ref_count(degree);
	const unsigned long lcm = ref_lcm((unsigned long)degree + 1);
	const int shift = common_shift(x, y, n);
	Work *w = work_new();
	mpz_t *value = malloc(2 * (size_t)count * sizeof *value);
	if (!value)
		abort();
	mpz_t *weight = value + count;
	for (int i = 0; i < 2 * count; i++)
		mpz_init(value[i]);
	for (size_t i = 0; i < n; i++) {
		const size_t next = i + 1 < n ? i + 1 : 0;
		set_edge(w, x[i], y[i], x[next], y[next], shift);
		make_signed(w, degree);
		add_all(value, w, degree, lcm);
		make_positive(w, degree);
		add_all(weight, w, degree, lcm);
	}
	for (int d = 0; d <= degree; d++) {
		for (int i = ref_index(d, 0); i <= ref_index(0, d); i++) {
			set_quotient(out[i].value, value[i], lcm * (unsigned long)(d + 2),
				shift * (d + 2));
			set_quotient(out[i].weight, weight[i], lcm * (unsigned long)(d + 2),
				shift * (d + 2));
		}
	}
	for (int i = 0; i < 2 * count; i++)
		mpz_clear(value[i]);
	free(value);
	work_free(w);
}

void ref_area(Ref *out, const double *x, const double *y, size_t n)
{
	const int shift = common_shift(x, y, n);
	mpz_t value, weight, first, a, b, c;
	mpz_inits(value, weight, first, a, b, c, NULL);
	if (n)
		set_scaled(first, x[0], shift);
	for (size_t i = 1; i < n; i++) {
		set_scaled(a, x[i], shift);
		set_scaled(b, y[i + 1 < n ? i + 1 : 0], shift);
		set_scaled(c, y[i - 1], shift);
		mpz_sub(a, a, first);
		mpz_sub(b, b, c);
		mpz_mul(a, a, b);
		mpz_add(value, value, a);
		mpz_abs(a, a);
		mpz_add(weight, weight, a);
	}
	set_quotient(out->value, value, 2, 2 * shift);
	set_quotient(out->weight, weight, 2, 2 * shift);
	mpz_clears(value, weight, first, a, b, c, NULL);
}

/* out[a] = C(m,a) p^(m-a) q^a for d = p/q; |p| instead of p if positive */
static void set_binomials(mpz_t *out, int m, const mpq_t d, bool positive)
{
	mpz_t power;
	mpz_init(power);
	for (int a = 0; a <= m; a++) {
		mpz_bin_uiui(out[a], (unsigned long)m, (unsigned long)a);
		mpz_pow_ui(power, mpq_numref(d), (unsigned long)(m - a));
		mpz_mul(out[a], out[a], power);
		mpz_pow_ui(power, mpq_denref(d), (unsigned long)a);
		mpz_mul(out[a], out[a], power);
		if (positive)
			mpz_abs(out[a], out[a]);
	}
	mpz_clear(power);
}

/* in[] over one denominator: in_i = out[i] / denominator */
static void set_common(mpz_t *out, mpz_t denominator, int count, const Ref *in, bool positive)
{
	mpz_set_ui(denominator, 1);
	for (int i = 0; i < count; i++)
		mpz_lcm(denominator, denominator,
			mpq_denref(positive ? in[i].weight : in[i].value));
	for (int i = 0; i < count; i++) {
		mpz_init(out[i]);
		mpz_divexact(out[i], denominator,
			mpq_denref(positive ? in[i].weight : in[i].value));
		mpz_mul(out[i], out[i], mpq_numref(positive ? in[i].weight : in[i].value));
	}
}

/* sum = sum_ab px[a] py[b] in_ab */
static void set_translated(mpz_t sum, int m, int n, mpz_t *in, mpz_t *px, mpz_t *py)
{
	mpz_t inner;
	mpz_init(inner);
	mpz_set_ui(sum, 0);
	for (int a = 0; a <= m; a++) {
		mpz_set_ui(inner, 0);
		for (int b = 0; b <= n; b++)
			mpz_addmul(inner, py[b], in[ref_index(a, b)]);
		mpz_addmul(sum, px[a], inner);
	}
	mpz_clear(inner);
}

/* Sums are over one denominator, that of in[] times q^m for dx and q^n for dy. */
static void translate_part(Ref *out, int degree, const Ref *in, const mpq_t dx, const mpq_t dy,
	bool positive)
{
	const int count = ref_count(degree);
	mpz_t px[REF_MAX_DEGREE + 1], py[REF_MAX_DEGREE + 1], denominator;
	mpz_t *common = malloc((size_t)count * sizeof *common);
	if (!common)
		abort();
	mpz_init(denominator);
	set_common(common, denominator, count, in, positive);
	for (int e = 0; e <= degree; e++)
		mpz_inits(px[e], py[e], NULL);
	for (int m = 0; m <= degree; m++) {
		set_binomials(px, m, dx, positive);
		for (int n = 0; m + n <= degree; n++) {
			Ref *r = &out[ref_index(m, n)];
			mpq_t *to = positive ? &r->weight : &r->value;
			set_binomials(py, n, dy, positive);
			set_translated(mpq_numref(*to), m, n, common, px, py);
			/* the last binomials are q^m and q^n */
			mpz_mul(mpq_denref(*to), px[m], py[n]);
			mpz_mul(mpq_denref(*to), mpq_denref(*to), denominator);
			mpq_canonicalize(*to);
		}
	}
	for (int e = 0; e <= degree; e++)
		mpz_clears(px[e], py[e], NULL);
	for (int i = 0; i < count; i++)
		mpz_clear(common[i]);
	free(common);
	mpz_clear(denominator);
}

void ref_translate(Ref *out, int degree, const Ref *in, const mpq_t dx, const mpq_t dy)
{
	translate_part(out, degree, in, dx, dy, false);
	translate_part(out, degree, in, dx, dy, true);
}

void ref_gamma(mpq_t out, long k, int bits)
{
	mpz_set_si(mpq_numref(out), k);
	mpz_set_ui(mpq_denref(out), 1);
	mpz_mul_2exp(mpq_denref(out), mpq_denref(out), (mp_bitcnt_t)bits);
	mpz_sub(mpq_denref(out), mpq_denref(out), mpq_numref(out));
	if (mpz_sgn(mpq_denref(out)) <= 0)
		abort();
	mpq_canonicalize(out);
}

double ref_tiny(long k, int degree, int bits, const double *x, const double *y, size_t n)
{
	double least = 1, most = 1;
	for (size_t i = 0; i < 2 * n; i++) {
		const double size = fabs(i < n ? x[i] : y[i - n]);
		if (size > 0)
			least = fmin(least, size);
		most = fmax(most, size);
	}
	/* a cross product can be 2^-72 times its own terms and still be no zero */
	const double normal = bits == 24 ? FLT_MIN : DBL_MIN;
	const double denormal = bits == 24 ? 0x1p-149 : 0x1p-1074;
	if ((degree + 2) * log2(least) - 72 > log2(normal))
		return 0;
	return (double)k * (double)n * denormal * pow(most, degree + 1);
}

/* out = |computed - value| */
static void set_error(mpq_t out, double computed, const Ref *want)
{
	mpq_set_d(out, computed);
	mpq_sub(out, out, want->value);
	mpq_abs(out, out);
}

bool ref_within(double computed, const Ref *want, long k, int bits, double tiny)
{
	if (!isfinite(computed))
		return false;
	mpq_t error, bound, extra;
	mpq_inits(error, bound, extra, NULL);
	set_error(error, computed, want);
	ref_gamma(bound, k, bits);
	mpq_mul(bound, bound, want->weight);
	mpq_set_d(extra, tiny);
	mpq_add(bound, bound, extra);
	const bool ok = mpq_cmp(error, bound) <= 0;
	mpq_clears(error, bound, extra, NULL);
	return ok;
}

double ref_units(double computed, const Ref *want, int bits)
{
	if (!isfinite(computed) || mpq_sgn(want->weight) == 0)
		return HUGE_VAL;
	mpq_t error;
	mpq_init(error);
	set_error(error, computed, want);
	mpq_mul_2exp(error, error, (mp_bitcnt_t)bits);
	mpq_div(error, error, want->weight);
	const double units = mpq_get_d(error);
	mpq_clear(error);
	return units;
}

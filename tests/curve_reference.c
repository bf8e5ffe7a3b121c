/* Moments of single edges by polynomials in the parameter.
 *
 * Lines, quads and cubics: one power of two makes the control points integers. In tau, with
 * t = (1+tau)/2, x(tau), y(tau) and x y' - y x' are polynomials with integer coefficients over a
 * power of two; they are multiplied out one factor at a time, and tau^k integrates to 2/(k+1) or 0.
 * The weights go the same way with the signs taken off.
 *
 * Conics: x = X/D, y = Y/D with quadratic X, Y and D = A + B tau^2, A = (1+w)/2, B = (1-w)/2. So
 * moments are sums of J_iq = int_0^1 tau^2i / D^q dtau, which follow from J_01, an arc tangent:
 *
 *     J_0,q+1 = (1 + (2q-1) J_0q) / (2 q A),     J_iq = (J_i-1,q-1 - A J_i-1,q) / B.
 *
 * Where terms cancel (B near 0, large w) is known, and the precision is raised by as many bits.
 */
#include <math.h>
#include <stdlib.h>

#include "curve_reference.h"

enum { BASIS = 4, TERMS = 3 * CURVE_MAX_DEGREE + 5 };
enum { MOST = CURVE_MAX_DEGREE + 1, COUNT = MOST * (MOST + 1) / 2 };

int curve_points(int kind)
{
	static const int points[] = { [CURVE_LINE] = 2, [CURVE_QUAD] = 3, [CURVE_CONIC] = 3,
		[CURVE_CUBIC] = 4 };
	return points[kind];
}

Curve curve_reversed(const Curve *c)
{
	const int points = curve_points(c->kind);
	Curve r = *c;
	for (int i = 0; i < points; i++) {
		r.x[i] = c->x[points - 1 - i];
		r.y[i] = c->y[points - 1 - i];
	}
	return r;
}

/* ---- lines, quads and cubics ---- */

/* Which terms are made positive. */
typedef enum { SIGNED, POSITIVE_POINTS, POSITIVE_TERMS } Signs;

typedef struct {
	int top;                   /* the highest power */
	mpz_t term[TERMS];
} Poly;

typedef struct {
	int order;                 /* 1, 2, 3 */
	long basis[BASIS][BASIS];  /* [i][k]: tau^k in 2^order B_i */
	mpz_t x[BASIS], y[BASIS];  /* the control points times 2^shift */
	long shift;
	Poly omega;                /* x y' - y x' times 2^(2 order + 2 shift) */
	Poly px[MOST], py[MOST];   /* x^m, and y^n omega */
} Work;

static void poly_init(Poly *p)
{
	p->top = 0;
	for (int k = 0; k < TERMS; k++)
		mpz_init(p->term[k]);
}

static void poly_clear(Poly *p)
{
	for (int k = 0; k < TERMS; k++)
		mpz_clear(p->term[k]);
}

/* C(order,i) (1-tau)^(order-i) (1+tau)^i */
static void set_basis(Work *w)
{
	static const long binomial[BASIS][BASIS] = { { 1 }, { 1, 1 }, { 1, 2, 1 }, { 1, 3, 3, 1 } };
	for (int i = 0; i <= w->order; i++) {
		long *b = w->basis[i];
		b[0] = binomial[w->order][i];
		for (int factor = 0; factor < w->order; factor++) {
			const long sign = factor < i ? 1 : -1;
			for (int k = w->order; k > 0; k--)
				b[k] += sign * b[k - 1];
		}
	}
}

static Work *work_new(const Curve *c)
{
	Work *w = calloc(1, sizeof *w);
	if (!w)
		abort();
	w->order = curve_points(c->kind) - 1;
	set_basis(w);
	for (int i = 0; i <= w->order; i++) {
		int ex, ey;
		if (!isfinite(c->x[i]) || !isfinite(c->y[i]))
			abort();
		frexp(c->x[i], &ex);
		frexp(c->y[i], &ey);
		w->shift = 53 - ex > w->shift ? 53 - ex : w->shift;
		w->shift = 53 - ey > w->shift ? 53 - ey : w->shift;
	}
	for (int i = 0; i < BASIS; i++)
		mpz_inits(w->x[i], w->y[i], NULL);
	poly_init(&w->omega);
	for (int m = 0; m < MOST; m++) {
		poly_init(&w->px[m]);
		poly_init(&w->py[m]);
	}
	return w;
}

static void work_free(Work *w)
{
	for (int i = 0; i < BASIS; i++)
		mpz_clears(w->x[i], w->y[i], NULL);
	poly_clear(&w->omega);
	for (int m = 0; m < MOST; m++) {
		poly_clear(&w->px[m]);
		poly_clear(&w->py[m]);
	}
	free(w);
}

/* out = v 2^shift, an integer */
static void set_scaled(mpz_t out, double v, long shift)
{
	int exponent;
	mpz_set_d(out, ldexp(frexp(v, &exponent), 53));
	if (mpz_sgn(out))
		mpz_mul_2exp(out, out, (mp_bitcnt_t)(shift + exponent - 53));
}

static void set_points(Work *w, const Curve *c, Signs signs)
{
	for (int i = 0; i <= w->order; i++) {
		set_scaled(w->x[i], signs == SIGNED ? c->x[i] : fabs(c->x[i]), w->shift);
		set_scaled(w->y[i], signs == SIGNED ? c->y[i] : fabs(c->y[i]), w->shift);
	}
}

static void add_scaled(mpz_t to, const mpz_t v, long factor)
{
	if (factor < 0)
		mpz_submul_ui(to, v, (unsigned long)-factor);
	else
		mpz_addmul_ui(to, v, (unsigned long)factor);
}

/* out = the coordinate as a polynomial in tau */
static void set_coordinate(Poly *out, Work *w, mpz_t *points, Signs signs)
{
	out->top = w->order;
	for (int k = 0; k <= w->order; k++) {
		mpz_set_ui(out->term[k], 0);
		for (int i = 0; i <= w->order; i++) {
			const long b = w->basis[i][k];
			add_scaled(out->term[k], points[i], signs == POSITIVE_TERMS ? labs(b) : b);
		}
	}
}

/* tau^k in b_i b_j' - b_j b_i' */
static long wronskian(const Work *w, int i, int j, int k)
{
	long sum = 0;
	for (int l = 0; l <= w->order; l++) {
		const int other = k + 1 - l;
		if (other >= 0 && other <= w->order)
			sum += w->basis[i][l] * w->basis[j][other] * (other - l);
	}
	return sum;
}

/* omega = sum over i < j of (b_i b_j' - b_j b_i') (x_i y_j - x_j y_i) */
static void set_omega(Work *w, Signs signs)
{
	mpz_t cross;
	mpz_init(cross);
	for (int i = 0; i <= w->order; i++) {
		for (int j = i + 1; j <= w->order; j++) {
			mpz_mul(cross, w->x[i], w->y[j]);
			(signs == SIGNED ? mpz_submul : mpz_addmul)(cross, w->x[j], w->y[i]);
			for (int k = 0; k <= w->omega.top; k++)
				add_scaled(w->omega.term[k], cross, wronskian(w, i, j, k));
		}
	}
	mpz_clear(cross);
}

/* Of coefficients that are sums of positive terms: sum (j - i) (x_i y_j + x_j y_i) tau^(i+j-1). */
static void set_positive_omega(Work *w, const Poly *x, const Poly *y)
{
	mpz_t cross;
	mpz_init(cross);
	for (int i = 0; i <= w->order; i++) {
		for (int j = i + 1; j <= w->order; j++) {
			mpz_mul(cross, x->term[i], y->term[j]);
			mpz_addmul(cross, x->term[j], y->term[i]);
			add_scaled(w->omega.term[i + j - 1], cross, j - i);
		}
	}
	mpz_clear(cross);
}

/* out = a b */
static void poly_multiply(Poly *out, const Poly *a, const Poly *b)
{
	out->top = a->top + b->top;
	for (int k = 0; k <= out->top; k++)
		mpz_set_ui(out->term[k], 0);
	for (int i = 0; i <= a->top; i++) {
		for (int j = 0; j <= b->top; j++)
			mpz_addmul(out->term[i + j], a->term[i], b->term[j]);
	}
}

static void set_powers(Work *w, int degree, Signs signs)
{
	Poly x, y;
	poly_init(&x);
	poly_init(&y);
	set_coordinate(&x, w, w->x, signs);
	set_coordinate(&y, w, w->y, signs);
	w->omega.top = 2 * w->order - 2;
	for (int k = 0; k <= w->omega.top; k++)
		mpz_set_ui(w->omega.term[k], 0);
	if (signs == POSITIVE_TERMS)
		set_positive_omega(w, &x, &y);
	else
		set_omega(w, signs);
	w->px[0].top = 0;
	mpz_set_ui(w->px[0].term[0], 1);
	w->py[0].top = w->omega.top;
	for (int k = 0; k <= w->omega.top; k++)
		mpz_set(w->py[0].term[k], w->omega.term[k]);
	for (int m = 1; m <= degree; m++) {
		poly_multiply(&w->px[m], &w->px[m - 1], &x);
		poly_multiply(&w->py[m], &w->py[m - 1], &y);
	}
	poly_clear(&x);
	poly_clear(&y);
}

/* total = lcm int_-1^1 p q dtau, of |tau|^k instead of tau^k if terms are positive */
static void set_integral(mpz_t total, const Poly *p, const Poly *q, Signs signs, unsigned long lcm)
{
	mpz_t inner;
	mpz_init(inner);
	mpz_set_ui(total, 0);
	for (int i = 0; i <= p->top; i++) {
		mpz_set_ui(inner, 0);
		for (int j = 0; j <= q->top; j++) {
			if (signs == POSITIVE_TERMS || (i + j) % 2 == 0)
				mpz_addmul_ui(inner, q->term[j],
					2 * (lcm / (unsigned long)(i + j + 1)));
		}
		mpz_addmul(total, p->term[i], inner);
	}
	mpz_clear(inner);
}

/* Adds the moment x^m y^n of the powers in w. */
static void add_moment(mpq_t to, const Work *w, int m, int n, Signs signs)
{
	const unsigned long steps = (unsigned long)(m + n + 2);
	const unsigned long lcm = ref_lcm((unsigned long)w->order * steps);
	mpq_t value;
	mpq_init(value);
	set_integral(mpq_numref(value), &w->px[m], &w->py[n], signs, lcm);
	mpz_set_ui(mpq_denref(value), lcm);
	mpz_mul_ui(mpq_denref(value), mpq_denref(value), steps);
	mpz_mul_2exp(mpq_denref(value), mpq_denref(value),
		steps * (unsigned long)(w->shift + w->order));
	mpq_canonicalize(value);
	mpq_add(to, to, value);
	mpq_clear(value);
}

static void add_polynomial(Ref *out, int degree, const Curve *c, Signs positive)
{
	Work *w = work_new(c);
	for (int weights = 0; weights < 2; weights++) {
		const Signs signs = weights ? positive : SIGNED;
		set_points(w, c, signs);
		set_powers(w, degree, signs);
		for (int n = 0; n <= degree; n++) {
			for (int m = 0; m + n <= degree; m++) {
				Ref *to = &out[ref_index(m, n)];
				add_moment(weights ? to->weight : to->value, w, m, n, signs);
			}
		}
	}
	work_free(w);
}

/* ---- conics ---- */

static mpfr_t *numbers_new(int count, mpfr_prec_t bits)
{
	mpfr_t *v = malloc((size_t)count * sizeof *v);
	if (!v)
		abort();
	for (int i = 0; i < count; i++) {
		mpfr_init2(v[i], bits);
		mpfr_set_zero(v[i], 1);
	}
	return v;
}

static void numbers_free(mpfr_t *v, int count)
{
	for (int i = 0; i < count; i++)
		mpfr_clear(v[i]);
	free(v);
}

/* Bits to compute with: those lost by dividing by B once per power of tau^2, by numerators of the
 * size of w that leave a result of the size of 1, and by a chord that contributes 0 next to a cap of
 * the size of w. */
static mpfr_prec_t working_bits(int degree, double w)
{
	int exponent;
	frexp(w, &exponent);
	return CONIC_BITS + 64 + (degree + 2) * (64 + 2 * (exponent > 0 ? exponent : 0))
		+ 2 * (exponent < 0 ? -exponent : 0);
}

/* J_01 = int_0^1 dtau / (A + B tau^2) */
static void set_first_integral(mpfr_t out, const mpfr_t a, const mpfr_t b)
{
	mpfr_t root;
	mpfr_init2(root, mpfr_get_prec(out));
	if (mpfr_zero_p(b)) {
		mpfr_set_ui(out, 1, MPFR_RNDN);
	} else {
		mpfr_div(root, b, a, MPFR_RNDN);
		mpfr_abs(root, root, MPFR_RNDN);
		mpfr_sqrt(root, root, MPFR_RNDN);
		(mpfr_sgn(b) > 0 ? mpfr_atan : mpfr_atanh)(out, root, MPFR_RNDN);
		mpfr_div(out, out, root, MPFR_RNDN);
		mpfr_div(out, out, a, MPFR_RNDN);
	}
	mpfr_clear(root);
}

/* out[i] = J_iq for i <= top, with q > top */
static void set_integrals(mpfr_t *out, int top, int q, const mpfr_t a, const mpfr_t b)
{
	mpfr_t t, *j = numbers_new(q + 1, mpfr_get_prec(out[0]));  /* j[p] = J_ip */
	mpfr_init2(t, mpfr_get_prec(out[0]));
	set_first_integral(j[1], a, b);
	for (int p = 1; p < q; p++) {
		mpfr_mul_si(t, j[p], 2 * p - 1, MPFR_RNDN);
		mpfr_add_ui(t, t, 1, MPFR_RNDN);
		mpfr_div_si(t, t, 2 * p, MPFR_RNDN);
		mpfr_div(j[p + 1], t, a, MPFR_RNDN);
	}
	for (int i = 0; i <= top; i++) {
		mpfr_set(out[i], j[q], MPFR_RNDN);
		for (int p = q; p > i + 1; p--) {               /* J_i+1,p in the place of J_ip */
			if (mpfr_zero_p(b)) {
				mpfr_set_ui(j[p], 1, MPFR_RNDN);
				mpfr_div_si(j[p], j[p], 2 * i + 3, MPFR_RNDN);
			} else {
				mpfr_mul(t, a, j[p], MPFR_RNDN);
				mpfr_sub(t, j[p - 1], t, MPFR_RNDN);
				mpfr_div(j[p], t, b, MPFR_RNDN);
			}
		}
	}
	mpfr_clear(t);
	numbers_free(j, q + 1);
}

/* out[0..2] = (p0 + p2 + 2 w p1)/4, (p2 - p0)/2, (p0 + p2 - 2 w p1)/4 */
static void set_numerator(mpfr_t *out, const double p[3], double w)
{
	mpfr_t t;
	mpfr_init2(t, mpfr_get_prec(out[0]));
	mpfr_set_d(t, p[1], MPFR_RNDN);
	mpfr_mul_d(t, t, w, MPFR_RNDN);
	mpfr_mul_ui(t, t, 2, MPFR_RNDN);
	mpfr_set_d(out[1], p[0], MPFR_RNDN);
	mpfr_add_d(out[1], out[1], p[2], MPFR_RNDN);
	mpfr_add(out[0], out[1], t, MPFR_RNDN);
	mpfr_sub(out[2], out[1], t, MPFR_RNDN);
	mpfr_set_d(out[1], p[2], MPFR_RNDN);
	mpfr_sub_d(out[1], out[1], p[0], MPFR_RNDN);
	mpfr_div_ui(out[0], out[0], 4, MPFR_RNDN);
	mpfr_div_ui(out[1], out[1], 2, MPFR_RNDN);
	mpfr_div_ui(out[2], out[2], 4, MPFR_RNDN);
	mpfr_clear(t);
}

/* out = factor (x_i y_j - x_j y_i) */
static void set_cross(mpfr_t out, mpfr_t *x, mpfr_t *y, int i, int j, unsigned long factor)
{
	mpfr_fmms(out, x[i], y[j], x[j], y[i], MPFR_RNDN);
	mpfr_mul_ui(out, out, factor, MPFR_RNDN);
}

/* out = p times the quadratic q; p has the powers 0..top */
static void multiply_quadratic(mpfr_t *out, mpfr_t *p, int top, mpfr_t *q)
{
	for (int k = 0; k <= top + 2; k++) {
		mpfr_set_zero(out[k], 1);
		for (int i = 0; i <= 2; i++) {
			if (k - i >= 0 && k - i <= top)
				mpfr_fma(out[k], q[i], p[k - i], out[k], MPFR_RNDN);
		}
	}
}

enum { POWERS = 2 * CURVE_MAX_DEGREE + 3 };

/* out = 1/(N+2) int_-1^1 x^m y^n (x y' - y x') / D^(N+2), integrals[i] = J_i,N+2 */
static void set_conic_moment(mpfr_t out, mpfr_t *xm, mpfr_t *yn, int m, int n, mpfr_t *integrals)
{
	mpfr_t inner, sum;
	mpfr_inits2(mpfr_get_prec(xm[0]), inner, sum, NULL);
	mpfr_set_zero(sum, 1);
	for (int i = 0; i <= 2 * m; i++) {
		mpfr_set_zero(inner, 1);
		for (int j = i % 2; j <= 2 * n + 2; j += 2)
			mpfr_fma(inner, yn[j], integrals[(i + j) / 2], inner, MPFR_RNDN);
		mpfr_fma(sum, xm[i], inner, sum, MPFR_RNDN);
	}
	mpfr_mul_ui(sum, sum, 2, MPFR_RNDN);
	mpfr_div_ui(out, sum, (unsigned long)(m + n + 2), MPFR_RNDN);
	mpfr_clears(inner, sum, NULL);
}

static void proper_moments(mpfr_t *out, int degree, const Curve *c)
{
	const mpfr_prec_t bits = working_bits(degree, c->w);
	mpfr_t *power = numbers_new(2 * MOST * POWERS + 6 + MOST + 1, bits);
	mpfr_t *xm = power, *yn = xm + MOST * POWERS, *x = yn + MOST * POWERS, *y = x + 3;
	mpfr_t *integrals = y + 3;
	mpfr_t a, b;
	mpfr_inits2(bits, a, b, NULL);
	mpfr_set_d(a, c->w, MPFR_RNDN);
	mpfr_ui_sub(b, 1, a, MPFR_RNDN);
	mpfr_add_ui(a, a, 1, MPFR_RNDN);
	mpfr_div_ui(a, a, 2, MPFR_RNDN);
	mpfr_div_ui(b, b, 2, MPFR_RNDN);
	set_numerator(x, c->x, c->w);
	set_numerator(y, c->y, c->w);
	mpfr_set_ui(xm[0], 1, MPFR_RNDN);
	set_cross(yn[0], x, y, 0, 1, 1);
	set_cross(yn[1], x, y, 0, 2, 2);
	set_cross(yn[2], x, y, 1, 2, 1);
	for (int m = 0; m < degree; m++) {
		multiply_quadratic(xm + (m + 1) * POWERS, xm + m * POWERS, 2 * m, x);
		multiply_quadratic(yn + (m + 1) * POWERS, yn + m * POWERS, 2 * m + 2, y);
	}
	for (int d = 0; d <= degree; d++) {
		set_integrals(integrals, d + 1, d + 2, a, b);
		for (int n = 0; n <= d; n++)
			set_conic_moment(out[ref_index(d - n, n)], xm + (d - n) * POWERS,
				yn + n * POWERS, d - n, n, integrals);
	}
	mpfr_clears(a, b, NULL);
	numbers_free(power, 2 * MOST * POWERS + 6 + MOST + 1);
}

/* The lines p0, p1 and p1, p2. */
static void polygon_moments(mpfr_t *out, int degree, const Curve *c)
{
	Ref *sum = ref_new(ref_count(degree));
	for (int i = 0; i < 2; i++) {
		const Curve line = { .kind = CURVE_LINE, .x = { c->x[i], c->x[i + 1] },
			.y = { c->y[i], c->y[i + 1] } };
		curve_add(sum, degree, &line);
	}
	for (int i = 0; i < ref_count(degree); i++)
		mpfr_set_q(out[i], sum[i].value, MPFR_RNDN);
	ref_free(sum, ref_count(degree));
}

void conic_moments(mpfr_t *out, int degree, const Curve *c)
{
	if (!(c->w > -1) || degree > CURVE_MAX_DEGREE)
		abort();
	(isinf(c->w) ? polygon_moments : proper_moments)(out, degree, c);
}

/* ---- weights of conics ---- */

/* Beyond, the library takes the control polygon, which differs by less than rounding. */
static const double POLYGON = 0x1p40;

/* A polynomial in X and Y by ref_index, with long double coefficients: range matters here, and
 * the last bits do not. */
typedef long double Plane[COUNT];

/* out[m] = (a + b X + c Y)^m, a = b = (p0 + p2)/2, c = p1 + a */
static void plane_powers(Plane *out, int degree, const long double p[3])
{
	const long double a = (p[0] + p[2]) / 2, c = p[1] + a;
	for (int m = 0; m <= degree; m++) {
		for (int i = 0; i < COUNT; i++)
			out[m][i] = m == 0 && i == 0;
	}
	for (int m = 0; m < degree; m++) {
		for (int i = 0; i <= m; i++) {
			for (int j = 0; i + j <= m; j++) {
				const long double v = out[m][ref_index(i, j)];
				out[m + 1][ref_index(i, j)] += a * v;
				out[m + 1][ref_index(i + 1, j)] += a * v;
				out[m + 1][ref_index(i, j + 1)] += c * v;
			}
		}
	}
}

/* The sum of the terms of p q with even powers of X, each times its integral. */
static long double plane_integral(const Plane p, int m, const Plane q, int n, const Plane integrals)
{
	long double sum = 0;
	for (int i = 0; i <= m; i++) {
		for (int j = 0; i + j <= m; j++) {
			for (int k = i % 2; k <= n; k += 2) {
				for (int l = 0; k + l <= n; l++)
					sum += p[ref_index(i, j)] * q[ref_index(k, l)]
						* integrals[ref_index(i + k, j + l)];
			}
		}
	}
	return sum;
}

/* I_ab: the conic itself in its own coordinates, its chord on a line through the origin. */
static void plane_integrals(Plane out, int degree, double w)
{
	const Curve own = { .kind = CURVE_CONIC, .x = { -1, 0, 1 }, .y = { 0, 1, 0 }, .w = w };
	mpfr_t *moments = numbers_new(ref_count(degree), CONIC_BITS);
	conic_moments(moments, degree, &own);
	for (int i = 0; i < ref_count(degree); i++)
		out[i] = fabsl(mpfr_get_ld(moments[i], MPFR_RNDZ));
	numbers_free(moments, ref_count(degree));
}

static void add_long(mpq_t to, long double v)
{
	mpfr_t wide;
	mpq_t value;
	mpfr_init2(wide, 64);
	mpq_init(value);
	mpfr_set_ld(wide, v, MPFR_RNDZ);
	mpfr_get_q(value, wide);
	mpq_add(to, to, value);
	mpfr_clear(wide);
	mpq_clear(value);
}

/* A conic with every term of its control points and of T made positive. */
typedef struct {
	long double x[3], y[3], area;
	double w;
} Positive;

static Positive positive_conic(const Curve *c)
{
	const long double x0 = c->x[0], y0 = c->y[0];
	return (Positive){
		{ fabsl(c->x[0]), fabsl(c->x[1]), fabsl(c->x[2]) },
		{ fabsl(c->y[0]), fabsl(c->y[1]), fabsl(c->y[2]) },
		(fabsl(c->x[1] - x0) * fabsl(c->y[2] - y0)
			+ fabsl(c->x[2] - x0) * fabsl(c->y[1] - y0)) / 2,
		c->w
	};
}

/* out = p_end, (p_end + w p1)/(1+w), (p0 + 2 w p1 + p2)/(2 + 2 w) */
static void halve_coordinate(long double out[3], const long double p[3], int end, double w)
{
	const long double size = fabsl(w), sum = 1 + (long double)w;
	out[0] = p[end];
	out[1] = (p[end] + size * p[1]) / sum;
	out[2] = (p[0] + 2 * size * p[1] + p[2]) / (2 * sum);
}

/* The half at end 0 or 2; its points are rounded, so differences of them are sums of terms. */
static Positive positive_half(const Positive *p, int end)
{
	Positive h = { .w = (double)sqrtl((1 + (long double)p->w) / 2) };
	halve_coordinate(h.x, p->x, end, p->w);
	halve_coordinate(h.y, p->y, end, p->w);
	h.area = ((h.x[0] + h.x[1]) * (h.y[0] + h.y[2])
		+ (h.x[0] + h.x[2]) * (h.y[0] + h.y[1])) / 2;
	return h;
}

static void add_line_weights(Ref *out, int degree, const Positive *p, int from, int to)
{
	const Curve line = { .kind = CURVE_LINE, .x = { (double)p->x[from], (double)p->x[to] },
		.y = { (double)p->y[from], (double)p->y[to] } };
	Ref *moments = ref_new(ref_count(degree));
	curve_add(moments, degree, &line);
	for (int i = 0; i < ref_count(degree); i++)
		mpq_add(out[i].weight, out[i].weight, moments[i].weight);
	ref_free(moments, ref_count(degree));
}

static void add_cap_weights(Ref *out, int degree, const Positive *p)
{
	Plane px[MOST], py[MOST], integrals;
	plane_powers(px, degree, p->x);
	plane_powers(py, degree, p->y);
	plane_integrals(integrals, degree, p->w);
	for (int m = 0; m <= degree; m++) {
		for (int n = 0; m + n <= degree; n++)
			add_long(out[ref_index(m, n)].weight,
				p->area * plane_integral(px[m], m, py[n], n, integrals));
	}
}

static void add_conic_weights(Ref *out, int degree, const Positive *p)
{
	if (p->w > POLYGON) {
		add_line_weights(out, degree, p, 0, 1);
		add_line_weights(out, degree, p, 1, 2);
	} else if (degree > 0 && (p->w < 0 || p->w > 3)) {
		for (int end = 0; end <= 2; end += 2) {
			const Positive half = positive_half(p, end);
			add_conic_weights(out, degree, &half);
		}
	} else {
		add_line_weights(out, degree, p, 0, 2);
		add_cap_weights(out, degree, p);
	}
}

static void add_conic(Ref *out, int degree, const Curve *c)
{
	mpfr_t *moments = numbers_new(ref_count(degree), CONIC_BITS);
	mpq_t value;
	mpq_init(value);
	conic_moments(moments, degree, c);
	for (int i = 0; i < ref_count(degree); i++) {
		mpfr_get_q(value, moments[i]);
		mpq_add(out[i].value, out[i].value, value);
	}
	mpq_clear(value);
	numbers_free(moments, ref_count(degree));
	const Positive positive = positive_conic(c);
	add_conic_weights(out, degree, &positive);
}

void curve_add(Ref *out, int degree, const Curve *c)
{
	if (degree > CURVE_MAX_DEGREE)
		abort();
	if (c->kind == CURVE_CONIC)
		add_conic(out, degree, c);
	else if (c->kind == CURVE_LINE || degree == 0)
		add_polynomial(out, degree, c, POSITIVE_POINTS);
	else
		add_polynomial(out, degree, c, POSITIVE_TERMS);
}

/* ---- areas ---- */

/* w (phi - w) / (1 - w^2), phi = acos(w) / sqrt(1-w^2), or acosh(w) / sqrt(w^2-1) beyond 1 */
void conic_factor(mpfr_t out, double w)
{
	mpfr_t v, rest, phi, root;
	if (isinf(w) || w == 1) {
		mpfr_set_ui(out, isinf(w) ? 3 : 2, MPFR_RNDN);
		mpfr_div_ui(out, out, 3, MPFR_RNDN);
		return;
	}
	mpfr_inits2(working_bits(2, w), v, rest, phi, root, NULL);
	mpfr_set_d(v, w, MPFR_RNDN);
	mpfr_sqr(rest, v, MPFR_RNDN);
	mpfr_ui_sub(rest, 1, rest, MPFR_RNDN);
	(w < 1 ? mpfr_acos : mpfr_acosh)(phi, v, MPFR_RNDN);
	mpfr_abs(root, rest, MPFR_RNDN);
	mpfr_sqrt(root, root, MPFR_RNDN);
	mpfr_div(phi, phi, root, MPFR_RNDN);
	mpfr_sub(phi, phi, v, MPFR_RNDN);
	mpfr_mul(phi, phi, v, MPFR_RNDN);
	mpfr_div(out, phi, rest, MPFR_RNDN);
	mpfr_clears(v, rest, phi, root, NULL);
}

/* out = (a1 - a0) (b2 - b0) */
static void set_product(mpq_t out, double a0, double a1, double b0, double b2)
{
	mpq_t a, b;
	mpq_inits(a, b, NULL);
	mpq_set_d(a, a1);
	mpq_set_d(b, a0);
	mpq_sub(out, a, b);
	mpq_set_d(a, b2);
	mpq_set_d(b, b0);
	mpq_sub(a, a, b);
	mpq_mul(out, out, a);
	mpq_clears(a, b, NULL);
}

/* Adds f(w) T. */
static void add_cap(Ref *out, const Curve *c)
{
	mpq_t factor, left, right;
	mpfr_t f;
	mpq_inits(factor, left, right, NULL);
	mpfr_init2(f, CONIC_BITS);
	conic_factor(f, c->w);
	mpfr_div_ui(f, f, 2, MPFR_RNDN);
	mpfr_get_q(factor, f);
	set_product(left, c->x[0], c->x[1], c->y[0], c->y[2]);
	set_product(right, c->y[0], c->y[1], c->x[0], c->x[2]);
	mpq_sub(left, left, right);
	mpq_mul(left, left, factor);
	mpq_add(out->value, out->value, left);
	set_product(left, c->x[0], c->x[1], c->y[0], c->y[2]);
	mpq_abs(left, left);
	mpq_abs(right, right);
	mpq_add(left, left, right);
	mpq_abs(factor, factor);
	mpq_mul(left, left, factor);
	mpq_add(out->weight, out->weight, left);
	mpq_clears(factor, left, right, NULL);
	mpfr_clear(f);
}

void curve_area(Ref *out, const Curve *c)
{
	mpq_set_ui(out->value, 0, 1);
	mpq_set_ui(out->weight, 0, 1);
	if (c->kind != CURVE_CONIC || c->w > POLYGON) {
		curve_add(out, 0, c);
		return;
	}
	const Curve chord = { .kind = CURVE_LINE, .x = { c->x[0], c->x[2] },
		.y = { c->y[0], c->y[2] } };
	curve_add(out, 0, &chord);
	add_cap(out, c);
}

double ref_ulps(double computed, const mpfr_t want, int bits)
{
	if (!isfinite(computed))
		return HUGE_VAL;
	const int least = bits == 24 ? -149 : -1074;
	const long exponent = mpfr_zero_p(want) ? least : (long)mpfr_get_exp(want) - bits;
	mpfr_t error;
	mpfr_init2(error, mpfr_get_prec(want) + 64);
	mpfr_sub_d(error, want, computed, MPFR_RNDN);
	mpfr_abs(error, error, MPFR_RNDN);
	mpfr_mul_2si(error, error, exponent < least ? -least : -exponent, MPFR_RNDN);
	const double ulps = mpfr_get_d(error, MPFR_RNDN);
	mpfr_clear(error);
	return ulps;
}

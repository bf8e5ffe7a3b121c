/* constants.c - every number of gen/constants.c computed anew in MPFR and compared bit for bit.
 *
 *     constants [SEED]      the tests
 *     constants --print     the tables of gen/constants.c as C text: this is their recipe
 *
 * Recipes, in 400 bits, then rounded to the nearest double (float):
 * Gauss-Legendre  Newton's method on P_n; weight 2 / ((1 - t^2) P_n'(t)^2).
 * Gauss-Jacobi    s = 1 - t^2 turns the integral of sqrt(1-s) g(s) over [0,1] into that of
 *                 t^2 g(1-t^2) over [-1,1]: the 2n+1 nodes of Gauss-Legendre (t = 0 counts nothing)
 *                 give n nodes s = 1 - t^2 with weights 2 t^2 w.
 * Series          interpolation at the Chebyshev nodes of the interval by Newton's divided
 *                 differences, expanded in powers.
 *
 * Then it is shown that they do what they are for: rules integrate the powers they must and no
 * more, enough Jacobi nodes are taken and none too many, the series are near to their functions,
 * and f(w) of conics evaluated by them, as the kernels do, stays within its ulps. */
#include "check.h"

#include <gmp.h>
#include <mpfr.h>

#include "../gen/gen.h"

enum { BITS = 400, COEFFICIENTS = 40 };

static mpfr_t *reals(int count)
{
	mpfr_t *a = malloc((size_t)count * sizeof *a);
	for (int i = 0; i < count; ++i)
		mpfr_init2(a[i], BITS);
	return a;
}

static void drop(mpfr_t *a, int count)
{
	for (int i = 0; i < count; ++i)
		mpfr_clear(a[i]);
	free(a);
}

/* ---- quadrature ---- */

/* p = P_n(t), slope = P_n'(t), for 0 <= t < 1. */
static void legendre(mpfr_t p, mpfr_t slope, const mpfr_t t, int n)
{
	mpfr_t *r = reals(2), *before = r, *term = r + 1;
	mpfr_set_ui(*before, 0, MPFR_RNDN);
	mpfr_set_ui(p, 1, MPFR_RNDN);
	for (int k = 1; k <= n; ++k) {       /* k P_k = (2k-1) t P_(k-1) - (k-1) P_(k-2) */
		mpfr_mul(*term, t, p, MPFR_RNDN);
		mpfr_mul_si(*term, *term, 2 * k - 1, MPFR_RNDN);
		mpfr_mul_si(*before, *before, k - 1, MPFR_RNDN);
		mpfr_sub(*term, *term, *before, MPFR_RNDN);
		mpfr_set(*before, p, MPFR_RNDN);
		mpfr_div_si(p, *term, k, MPFR_RNDN);
	}
	mpfr_mul(slope, t, p, MPFR_RNDN);    /* (1 - t^2) P_n' = n (P_(n-1) - t P_n) */
	mpfr_sub(slope, *before, slope, MPFR_RNDN);
	mpfr_mul_si(slope, slope, n, MPFR_RNDN);
	mpfr_sqr(*term, t, MPFR_RNDN);
	mpfr_si_sub(*term, 1, *term, MPFR_RNDN);
	mpfr_div(slope, slope, *term, MPFR_RNDN);
	drop(r, 2);
}

/* The nodes >= 0, ascending, and their weights. */
static int legendre_rule(mpfr_t *node, mpfr_t *weight, int n)
{
	mpfr_t *r = reals(2), *p = r, *slope = r + 1;
	int count = (n + 1) / 2;
	for (int i = 0; i < count; ++i) {
		int from_one = count - i;    /* the first is next to 1 */
		mpfr_set_d(node[i], cos(acos(-1) * (from_one - 0.25) / (n + 0.5)), MPFR_RNDN);
		if (n % 2 && i == 0)
			mpfr_set_zero(node[i], 1);
		for (int step = 0; step < 8; ++step) {   /* error 2^-10, squared each time */
			legendre(*p, *slope, node[i], n);
			mpfr_div(*p, *p, *slope, MPFR_RNDN);
			mpfr_sub(node[i], node[i], *p, MPFR_RNDN);
		}
		legendre(*p, *slope, node[i], n);
		mpfr_sqr(*p, node[i], MPFR_RNDN);
		mpfr_si_sub(*p, 1, *p, MPFR_RNDN);
		mpfr_sqr(*slope, *slope, MPFR_RNDN);
		mpfr_mul(*p, *p, *slope, MPFR_RNDN);
		mpfr_si_div(weight[i], 2, *p, MPFR_RNDN);
	}
	drop(r, 2);
	return count;
}

static int jacobi_rule(mpfr_t *node, mpfr_t *weight, int n)
{
	mpfr_t *t = reals(n + 1), *w = reals(n + 1);
	legendre_rule(t, w, 2 * n + 1);
	for (int i = 0; i < n; ++i) {
		mpfr_sqr(node[i], t[n - i], MPFR_RNDN);
		mpfr_mul(weight[i], node[i], w[n - i], MPFR_RNDN);
		mpfr_mul_si(weight[i], weight[i], 2, MPFR_RNDN);
		mpfr_si_sub(node[i], 1, node[i], MPFR_RNDN);
	}
	drop(t, n + 1);
	drop(w, n + 1);
	return n;
}

/* ---- series ---- */

typedef void Function(mpfr_t y, const mpfr_t x);

/* (atanh(sqrt x) / sqrt x - 1) / x */
static void function_K(mpfr_t y, const mpfr_t x)
{
	mpfr_t *r = reals(1);
	mpfr_sqrt(*r, x, MPFR_RNDN);
	mpfr_atanh(y, *r, MPFR_RNDN);
	mpfr_div(y, y, *r, MPFR_RNDN);
	mpfr_sub_ui(y, y, 1, MPFR_RNDN);
	mpfr_div(y, y, x, MPFR_RNDN);
	drop(r, 1);
}

/* f(1 + x) / (1 + x) = sum a_k x^k, a_0 = 2/3, a_(k+1) = -a_k (k+3) / (2k+5), |x| <= 1 */
static void function_R(mpfr_t y, const mpfr_t x)
{
	mpfr_t *r = reals(1), *term = r;
	mpfr_set_ui(*term, 2, MPFR_RNDN);
	mpfr_div_ui(*term, *term, 3, MPFR_RNDN);
	mpfr_set_zero(y, 1);
	for (int k = 0; k < BITS + 20; ++k) {
		mpfr_add(y, y, *term, MPFR_RNDN);
		mpfr_mul(*term, *term, x, MPFR_RNDN);
		mpfr_mul_si(*term, *term, -(k + 3), MPFR_RNDN);
		mpfr_div_si(*term, *term, 2 * k + 5, MPFR_RNDN);
	}
	drop(r, 1);
}

/* w + 11/16 times that, less 1 */
static void function_E(mpfr_t y, const mpfr_t x)
{
	mpfr_t *r = reals(1);
	mpfr_add_d(*r, x, 1 + 11.0 / 16, MPFR_RNDN);
	function_R(y, x);
	mpfr_mul(y, y, *r, MPFR_RNDN);
	mpfr_sub_ui(y, y, 1, MPFR_RNDN);
	drop(r, 1);
}

static void range_K(mpfr_t low, mpfr_t high) /* 0 .. (3 - 2 sqrt 2)^2 = 17 - sqrt 288 */
{
	mpfr_set_zero(low, 1);
	mpfr_sqrt_ui(high, 288, MPFR_RNDN);
	mpfr_ui_sub(high, 17, high, MPFR_RNDN);
}

static void range_E(mpfr_t low, mpfr_t high)
{
	mpfr_set_si(low, -1, MPFR_RNDN);
	mpfr_set_si(high, 1, MPFR_RNDN);
}

static const struct {
	const char *name;
	Function *function;
	void (*range)(mpfr_t low, mpfr_t high);
	int count[2];                        /* double, float */
	Series (*stored)(int is_float);
	int offset;                          /* errors count relative to this + value */
	double near[2];
} series[] = {
	{ "atanh", function_K, range_K, { 7, 3 }, series_atanh, 0, { -50.5, -21.4 } },
	{ "conic", function_E, range_E, { 31, 15 }, series_conic, 1, { -56, -27 } },
};

static void chebyshev_node(mpfr_t x, int j, int count, const mpfr_t low, const mpfr_t high)
{
	mpfr_t *r = reals(1);
	mpfr_const_pi(x, MPFR_RNDN);
	mpfr_mul_si(x, x, 2 * j + 1, MPFR_RNDN);
	mpfr_div_si(x, x, 2 * count, MPFR_RNDN);
	mpfr_cos(x, x, MPFR_RNDN);
	mpfr_sub(*r, high, low, MPFR_RNDN);
	mpfr_mul(x, x, *r, MPFR_RNDN);
	mpfr_add(x, x, low, MPFR_RNDN);
	mpfr_add(x, x, high, MPFR_RNDN);
	mpfr_div_ui(x, x, 2, MPFR_RNDN);
	drop(r, 1);
}

/* The coefficients of series[which], lowest power first. */
static int interpolate(mpfr_t *coef, int which, int is_float)
{
	int count = series[which].count[is_float];
	mpfr_t *x = reals(count), *y = reals(count), *r = reals(3);
	series[which].range(r[0], r[1]);
	for (int j = 0; j < count; ++j) {
		chebyshev_node(x[j], j, count, r[0], r[1]);
		series[which].function(y[j], x[j]);
		mpfr_set_zero(coef[j], 1);
	}
	for (int step = 1; step < count; ++step)
		for (int j = count - 1; j >= step; --j) {
			mpfr_sub(y[j], y[j], y[j - 1], MPFR_RNDN);
			mpfr_sub(r[2], x[j], x[j - step], MPFR_RNDN);
			mpfr_div(y[j], y[j], r[2], MPFR_RNDN);
		}
	for (int j = count - 1; j >= 0; --j)         /* coef = coef (x - x_j) + y_j */
		for (int k = count - 1; k >= 0; --k) {
			mpfr_mul(r[2], coef[k], x[j], MPFR_RNDN);
			mpfr_sub(coef[k], k ? coef[k - 1] : y[j], r[2], MPFR_RNDN);
		}
	drop(x, count);
	drop(y, count);
	drop(r, 3);
	return count;
}

static void number_recipe(mpfr_t y, int which)
{
	if (which == NUMBER_PI)
		mpfr_const_pi(y, MPFR_RNDN);
	else if (which == NUMBER_HALF_LN2)
		mpfr_const_log2(y, MPFR_RNDN);
	else
		mpfr_sqrt_ui(y, 2, MPFR_RNDN);
	if (which != NUMBER_PI)
		mpfr_div_ui(y, y, 2, MPFR_RNDN);
}

/* ---- the tables as C text ---- */

static void print_row(mpfr_t *value, int count, int is_float)
{
	int column = 0;
	for (int i = 0; i < count; ++i) {
		char text[40];
		double nearest = is_float ? (double)mpfr_get_flt(value[i], MPFR_RNDN)
			: mpfr_get_d(value[i], MPFR_RNDN);
		int size = snprintf(text, sizeof text, "%a,", nearest);
		bool fits = column > 0 && column + 1 + size <= 100;
		printf("%s%s", fits ? " " : i ? "\n\t" : "\t", text);
		column = (fits ? column + 1 : 8) + size;
	}
	printf("\n");
}

static void print_rules(const char *name, int (*rule)(mpfr_t *, mpfr_t *, int), int last)
{
	mpfr_t *node = reals(last), *weight = reals(last);
	for (int which = 0; which < 2; ++which) {
		printf("static const double %s_%s[] = {\n", name, which ? "weight" : "node");
		for (int n = 1; n <= last; ++n)
			print_row(which ? weight : node, rule(node, weight, n), 0);
		printf("};\n\n");
	}
	drop(node, last);
	drop(weight, last);
}

static int print_tables(void)
{
	mpfr_t *value = reals(COEFFICIENTS);
	printf("static const double numbers[NUMBERS] = {\n");
	for (int i = 0; i < NUMBERS; ++i)
		number_recipe(value[i], i);
	print_row(value, NUMBERS, 0);
	printf("};\n\n");
	for (int i = 0; i < 2 * LENGTH(series); ++i) {
		printf("static const double %s_%s[] = {\n", series[i / 2].name,
			i % 2 ? "float" : "double");
		print_row(value, interpolate(value, i / 2, i % 2), i % 2);
		printf("};\n\n");
	}
	drop(value, COEFFICIENTS);
	print_rules("legendre", legendre_rule, LEGENDRE_MAX);
	print_rules("jacobi", jacobi_rule, JACOBI_MAX);
	return 0;
}

/* ---- the stored values ---- */

static double to_double(Rat a)                   /* exact if a is dyadic with 53 bits */
{
	return (double)a.num / (double)a.den;
}

/* As a double, and as the float that a float program will round it to. */
static void expect_nearest(Rat have, const mpfr_t want, const char *what, int which, int index)
{
	double value = to_double(have);
	expect(rat_significant(have) > 0 || have.num == 0, "%s %d [%d] is not dyadic", what, which,
		index);
	expect(value == mpfr_get_d(want, MPFR_RNDN), "%s %d [%d] is %a, not %a", what, which, index,
		value, mpfr_get_d(want, MPFR_RNDN));
	expect((float)value == mpfr_get_flt(want, MPFR_RNDN), "%s %d [%d] rounds to another float",
		what, which, index);
	expect(strtod(rat_literal(have, 0), NULL) == value, "%s %d [%d] as a literal is %s", what,
		which, index, rat_literal(have, 0));
	expect(strtof(rat_literal(have, 1), NULL) == (float)value, "%s %d [%d] as a literal is %s",
		what, which, index, rat_literal(have, 1));
}

static void test_numbers(void)
{
	mpfr_t *want = reals(1);
	check_begin("pi, half of ln 2, root of a half");
	for (int i = 0; i < NUMBERS; ++i) {
		number_recipe(*want, i);
		expect_nearest(number(i), *want, "number", i, 0);
	}
	check_end();
	drop(want, 1);
}

static void test_series_bits(void)
{
	mpfr_t *want = reals(COEFFICIENTS);
	for (int i = 0; i < 2 * LENGTH(series); ++i) {
		int is_float = i % 2;
		check_begin("series %s, %s: every bit", series[i / 2].name,
			is_float ? "float" : "double");
		Series have = series[i / 2].stored(is_float);
		int count = interpolate(want, i / 2, is_float);
		expect(have.count == count, "%d coefficients, not %d", have.count, count);
		for (int k = 0; k < count && k < have.count; ++k) {
			if (is_float)
				mpfr_prec_round(want[k], 24, MPFR_RNDN);
			expect_nearest(have.coef[k], want[k], "coefficient", k, 0);
			mpfr_set_prec(want[k], BITS);
		}
		check_end();
	}
	drop(want, COEFFICIENTS);
}

/* |sum - want| > 2^-200 |want| */
static bool misses(const mpfr_t sum, const mpfr_t want)
{
	mpfr_t *r = reals(1);
	mpfr_sub(*r, sum, want, MPFR_RNDN);
	mpfr_div(*r, *r, want, MPFR_RNDN);
	bool far = !mpfr_zero_p(*r) && mpfr_get_exp(*r) > -200;
	drop(r, 1);
	return far;
}

/* The power k of a node of each rule: sum w t^k = 2 / (k + 1) for even k over both signs;
 * sum w s^k = B(k + 1, 3/2), of ratio k / (k + 3/2). */
static void power_sum(mpfr_t sum, mpfr_t *node, mpfr_t *weight, int count, int k)
{
	mpfr_t *r = reals(1);
	mpfr_set_zero(sum, 1);
	for (int i = 0; i < count; ++i) {
		mpfr_pow_ui(*r, node[i], (unsigned long)k, MPFR_RNDN);   /* 0^0 = 1 */
		mpfr_mul(*r, *r, weight[i], MPFR_RNDN);
		mpfr_add(sum, sum, *r, MPFR_RNDN);
	}
	drop(r, 1);
}

static void test_legendre(void)
{
	mpfr_t *node = reals(LEGENDRE_MAX), *weight = reals(LEGENDRE_MAX), *r = reals(2);
	Rat t[LEGENDRE_MAX], w[LEGENDRE_MAX];
	check_begin("Gauss-Legendre: 1 to %d nodes, every bit, exact below 2 K", LEGENDRE_MAX);
	for (int n = 1; n <= LEGENDRE_MAX; ++n) {
		Mark mark = arena_mark();
		int count = legendre_rule(node, weight, n);
		expect(gauss_legendre(n, t, w) == count, "%d nodes: wrong count", n);
		for (int i = 0; i < count; ++i) {
			expect_nearest(t[i], node[i], "node of", n, i);
			expect_nearest(w[i], weight[i], "weight of", n, i);
		}
		if (n % 2)
			mpfr_div_ui(weight[0], weight[0], 2, MPFR_RNDN);   /* counted once */
		for (int k = 0; k <= 2 * n; k += 2) {
			power_sum(r[0], node, weight, count, k);
			mpfr_set_ui(r[1], 1, MPFR_RNDN);
			mpfr_div_ui(r[1], r[1], (unsigned long)k + 1, MPFR_RNDN);
			expect(misses(r[0], r[1]) == (k == 2 * n), "%d nodes, power %d", n, k);
		}
		arena_release(mark);
	}
	check_end();
	drop(node, LEGENDRE_MAX);
	drop(weight, LEGENDRE_MAX);
	drop(r, 2);
}

static void test_jacobi(void)
{
	mpfr_t *node = reals(JACOBI_MAX), *weight = reals(JACOBI_MAX), *r = reals(2);
	Rat s[JACOBI_MAX], w[JACOBI_MAX];
	check_begin("Gauss-Jacobi: 1 to %d nodes, every bit, exact below 2 K", JACOBI_MAX);
	for (int n = 1; n <= JACOBI_MAX; ++n) {
		Mark mark = arena_mark();
		jacobi_rule(node, weight, n);
		expect(gauss_jacobi(n, s, w) == n, "%d nodes: wrong count", n);
		for (int i = 0; i < n; ++i) {
			expect_nearest(s[i], node[i], "node of", n, i);
			expect_nearest(w[i], weight[i], "weight of", n, i);
			expect(i == 0 || to_double(s[i - 1]) < to_double(s[i]),
				"%d nodes: not ascending", n);
		}
		mpfr_set_ui(r[1], 2, MPFR_RNDN);
		mpfr_div_ui(r[1], r[1], 3, MPFR_RNDN);
		for (int k = 0; k <= 2 * n; ++k) {
			if (k) {
				mpfr_mul_ui(r[1], r[1], 2 * (unsigned long)k, MPFR_RNDN);
				mpfr_div_ui(r[1], r[1], 2 * (unsigned long)k + 3, MPFR_RNDN);
			}
			power_sum(r[0], node, weight, n, k);
			expect(misses(r[0], r[1]) == (k == 2 * n), "%d nodes, power %d", n, k);
		}
		arena_release(mark);
	}
	check_end();
	drop(node, JACOBI_MAX);
	drop(weight, JACOBI_MAX);
	drop(r, 2);
}

/* ---- how many Jacobi nodes a degree takes ---- */

/* Caps of conics: the integral over [0,1] of sqrt(1-s) sqrt(1 - tau s) R^h s^b,
 * R = (1-s)(1 - tau s), for the moment X^2h Y^b of the cap. */
enum { HALVES = MAX_DEGREE / 2 + 1, POWERS = MAX_DEGREE + 1, REFERENCE = 40 };

/* sum[h * POWERS + b], by n nodes */
static void caps(mpfr_t *sum, int n, double tau)
{
	mpfr_t *node = reals(n), *weight = reals(n), *r = reals(3);
	jacobi_rule(node, weight, n);
	for (int i = 0; i < HALVES * POWERS; ++i)
		mpfr_set_zero(sum[i], 1);
	for (int i = 0; i < n; ++i) {
		mpfr_mul_d(r[0], node[i], -tau, MPFR_RNDN);
		mpfr_add_ui(r[0], r[0], 1, MPFR_RNDN);
		mpfr_sqrt(r[1], r[0], MPFR_RNDN);
		mpfr_mul(weight[i], weight[i], r[1], MPFR_RNDN);
		mpfr_ui_sub(r[1], 1, node[i], MPFR_RNDN);
		mpfr_mul(r[0], r[0], r[1], MPFR_RNDN);   /* R */
		for (int h = 0; h < HALVES; ++h) {
			mpfr_set(r[2], weight[i], MPFR_RNDN);
			for (int b = 0; 2 * h + b <= MAX_DEGREE; ++b) {
				mpfr_t *to = sum + h * POWERS + b;
				mpfr_add(*to, *to, r[2], MPFR_RNDN);
				mpfr_mul(r[2], r[2], node[i], MPFR_RNDN);
			}
			mpfr_mul(weight[i], weight[i], r[0], MPFR_RNDN);
		}
	}
	drop(node, n);
	drop(weight, n);
	drop(r, 3);
}

/* worst[n][N]: largest relative error of n nodes in moments to degree N, w in [0,3]. */
static void cap_errors(double worst[JACOBI_MAX + 1][POWERS])
{
	mpfr_t *want = reals(HALVES * POWERS), *have = reals(HALVES * POWERS), *r = reals(1);
	for (int step = 0; step <= 12; ++step) {
		double tau = -1 + step / 8.0;        /* (w - 1) / (w + 1) */
		caps(want, REFERENCE, tau);
		for (int n = 1; n <= JACOBI_MAX; ++n) {
			caps(have, n, tau);
			for (int i = 0; i < HALVES * POWERS; ++i) {
				int first = i / POWERS * 2 + i % POWERS;   /* degree 2h + b */
				if (first > MAX_DEGREE)
					continue;
				mpfr_sub(*r, have[i], want[i], MPFR_RNDN);
				mpfr_div(*r, *r, want[i], MPFR_RNDN);
				double error = fabs(mpfr_get_d(*r, MPFR_RNDN));
				for (int degree = first; degree <= MAX_DEGREE; ++degree)
					worst[n][degree] = fmax(worst[n][degree], error);
			}
		}
	}
	drop(want, HALVES * POWERS);
	drop(have, HALVES * POWERS);
	drop(r, 1);
}

static void test_jacobi_nodes(void)
{
	static double worst[JACOBI_MAX + 1][POWERS];
	cap_errors(worst);
	for (int is_float = 0; is_float < 2; ++is_float) {
		double most = is_float ? 0x1p-26 : 0x1p-54;
		check_begin("Gauss-Jacobi: the least count of nodes of a degree, %s",
			is_float ? "float" : "double");
		for (int degree = 1; degree <= MAX_DEGREE; ++degree) {
			int n = gauss_jacobi_nodes(degree, is_float);
			expect(worst[n][degree] <= most, "degree %d: %d nodes err by %g", degree, n,
				worst[n][degree]);
			expect(worst[n - 1][degree] > most, "degree %d: %d nodes would do", degree,
				n - 1);
		}
		check_end();
	}
}

/* ---- how near the series are ---- */

/* Interpolation at n Chebyshev nodes of [0,L] errs by 2 (L/4)^n max |K^(n)| / n!, and that
 * is at most (1-L)^-(n+1) / (2n+3); K >= 1/3, and its first coefficient is rounded: 2^-50.5 and
 * 2^-21.4, in atanh = t + t tau K not a hundredth of it. Of E an eighth of a rounding is asked. */
static void test_series_near(void)
{
	mpfr_t *r = reals(5);
	for (int i = 0; i < 2 * LENGTH(series); ++i) {
		int is_float = i % 2, which = i / 2;
		check_begin("series %s, %s: near enough", series[which].name,
			is_float ? "float" : "double");
		Series have = series[which].stored(is_float);
		series[which].range(r[0], r[1]);
		for (int step = 1; step <= 1000; ++step) {
			mpfr_sub(r[2], r[1], r[0], MPFR_RNDN);
			mpfr_mul_d(r[2], r[2], step / 1000.0, MPFR_RNDN);
			mpfr_add(r[2], r[2], r[0], MPFR_RNDN);
			series[which].function(r[3], r[2]);
			mpfr_set_zero(r[4], 1);
			for (int k = have.count - 1; k >= 0; --k) {
				mpfr_mul(r[4], r[4], r[2], MPFR_RNDN);
				mpfr_add_d(r[4], r[4], to_double(have.coef[k]), MPFR_RNDN);
			}
			mpfr_sub(r[4], r[4], r[3], MPFR_RNDN);
			mpfr_add_si(r[3], r[3], series[which].offset, MPFR_RNDN);
			mpfr_div(r[4], r[4], r[3], MPFR_RNDN);
			double error = log2(fabs(mpfr_get_d(r[4], MPFR_RNDN)));
			expect(error <= series[which].near[is_float], "2^%.2f at step %d", error,
				step);
		}
		check_end();
	}
	drop(r, 5);
}

/* ---- f(w) of conics, as kernels evaluate it ---- */

typedef struct {
	double e[COEFFICIENTS], k[COEFFICIENTS], number[NUMBERS], shift;
	int es, ks;
} Model;

static void model_series(double *to, int *count, Series from)
{
	*count = from.count;
	for (int i = 0; i < from.count; ++i)
		to[i] = to_double(from.coef[i]);
}

static Model model(int is_float)
{
	Model m = { .shift = to_double(conic_shift) };
	model_series(m.e, &m.es, series_conic(is_float));
	model_series(m.k, &m.ks, series_atanh(is_float));
	for (int i = 0; i < NUMBERS; ++i)
		m.number[i] = to_double(number(i));
	return m;
}

/* u = |w|, D = |1 - w^2|, q = sqrt D.
 * w <= 2: f = g + g E(u - 1), g = u / (u + 11/16);   w > 2: f = 1 - (w a - q) / (q D), a = acosh w;
 * w < 0: f = f(u) - pi u / (q D). */
#define DEFINE_F(NAME, REAL, MULADD, ROOT, SPLIT)                                              \
static REAL NAME(const Model *m, REAL w)                                                       \
{                                                                                              \
	REAL u = w < 0 ? -w : w;                                                               \
	if (u > (REAL)0x1p40)                                                                  \
		u = (REAL)0x1p40;                                                              \
	REAL x = u - 1, y = x < 0 ? -x : x, d = MULADD(y, u, y), q = ROOT(d);                  \
	if (w > 2) {                                                                           \
		int k;                                                                         \
		REAL z = SPLIT(u + q, &k);           /* in [1/2, 1), then about 1 */           \
		if (z < (REAL)m->number[NUMBER_SQRT_HALF]) {                                   \
			z *= 2;                                                                \
			--k;                                                                   \
		}                                                                              \
		REAL v = (z - 1) / (z + 1), t = v * v, p = (REAL)m->k[m->ks - 1];              \
		for (int i = m->ks - 2; i >= 0; --i)                                           \
			p = MULADD(p, t, (REAL)m->k[i]);                                       \
		REAL half = MULADD((REAL)k, (REAL)m->number[NUMBER_HALF_LN2],                  \
			MULADD(v * t, p, v));                                                  \
		return 1 - MULADD(u, 2 * half, -q) / (q * d);                                  \
	}                                                                                      \
	REAL g = u / (u + (REAL)m->shift), e = (REAL)m->e[m->es - 1];                          \
	for (int i = m->es - 2; i >= 0; --i)                                                   \
		e = MULADD(e, x, (REAL)m->e[i]);                                               \
	REAL f = MULADD(g, e, g);                                                              \
	return w < 0 ? f - (REAL)m->number[NUMBER_PI] * u / (q * d) : f;                       \
}
#define TWO_ROUNDINGS(a, b, c) ((a) * (b) + (c))
DEFINE_F(f_double, double, TWO_ROUNDINGS, sqrt, frexp)
DEFINE_F(f_double_fma, double, fma, sqrt, frexp)
DEFINE_F(f_float, float, TWO_ROUNDINGS, sqrtf, frexpf)
DEFINE_F(f_float_fma, float, fmaf, sqrtf, frexpf)

/* w (phi - w) / (1 - w^2), phi = acos(w) / sqrt(1 - w^2), or acosh(w) / sqrt(w^2 - 1) */
static void exact_f(mpfr_t y, double w)
{
	enum { ENOUGH = 200 };               /* 53 bits are lost next to 1 */
	mpfr_t x, d, q;
	mpfr_inits2(ENOUGH, x, d, q, (mpfr_ptr)0);
	mpfr_set_d(x, w, MPFR_RNDN);
	mpfr_sqr(d, x, MPFR_RNDN);
	mpfr_ui_sub(d, 1, d, MPFR_RNDN);
	mpfr_abs(q, d, MPFR_RNDN);
	mpfr_sqrt(q, q, MPFR_RNDN);
	if (w < 1)
		mpfr_acos(y, x, MPFR_RNDN);
	else
		mpfr_acosh(y, x, MPFR_RNDN);
	mpfr_div(y, y, q, MPFR_RNDN);
	mpfr_sub(y, y, x, MPFR_RNDN);
	mpfr_mul(y, y, x, MPFR_RNDN);
	mpfr_div(y, y, d, MPFR_RNDN);
	if (w == 1) {
		mpfr_set_ui(y, 2, MPFR_RNDN);
		mpfr_div_ui(y, y, 3, MPFR_RNDN);
	}
	mpfr_clears(x, d, q, (mpfr_ptr)0);
}

/* Distance in units of the last place of the exact value. */
static double ulps(double have, const mpfr_t want, int bits)
{
	mpfr_t r;
	mpfr_init2(r, 200);
	mpfr_sub_d(r, want, have, MPFR_RNDN);
	mpfr_mul_2si(r, r, bits - mpfr_get_exp(want), MPFR_RNDN);
	double distance = fabs(mpfr_get_d(r, MPFR_RNDN));
	mpfr_clear(r);
	return distance;
}

static double near_zero(int i)
{
	return ldexp(random_real(1, 2), -1 - i % 60);
}

static double weight_low(int i)
{
	if (i % 4 < 2)
		return random_real(0, 2);
	if (i % 4 == 2)
		return near_zero(i / 4);
	double beside = ldexp(random_real(1, 2), -1 - i / 8 % 53);
	return fmin(i / 4 % 2 ? 1 + beside : 1 - beside / 2, 2);
}

static double weight_high(int i)
{
	return i % 2 ? random_real(2, 2.5) : ldexp(random_real(2, 4), i / 2 % 60);
}

static double weight_negative(int i)
{
	if (i % 2)
		return -random_real(0, 1);
	return i % 4 ? -near_zero(i / 4) : near_zero(i / 4) / 2 - 1;
}

static void test_f(void)
{
	static const struct {
		const char *range;
		double (*weight)(int i);
		int count;
		double most;
	} part[] = { { "0 .. 2", weight_low, 100000, 2.5 }, { "2 .. inf", weight_high, 40000, 2.5 },
		{ "-1 .. 0", weight_negative, 40000, 10 } };
	const Model as_double = model(0), as_float = model(1);
	mpfr_t want;
	mpfr_init2(want, 200);
	for (int i = 0; i < 2 * LENGTH(part); ++i) {
		int is_float = i % 2;
		check_begin("f(w), w in %s, %s", part[i / 2].range, is_float ? "float" : "double");
		double worst[2] = { 0, 0 };
		for (int j = 0; j < part[i / 2].count; ++j) {
			double w = part[i / 2].weight(j), have[2];
			if (is_float)
				w = (double)(float)w;
			if (w == -1 || w == 0)
				continue;
			exact_f(want, w);
			have[0] = is_float ? (double)f_float(&as_float, (float)w)
				: f_double(&as_double, w);
			have[1] = is_float ? (double)f_float_fma(&as_float, (float)w)
				: f_double_fma(&as_double, w);
			for (int fused = 0; fused < 2; ++fused) {
				double off = ulps(have[fused], want, is_float ? 24 : 53);
				worst[fused] = fmax(worst[fused], off);
				expect(off <= part[i / 2].most, "%.3f ulp at w = %a%s", off, w,
					fused ? ", fused" : "");
			}
		}
		check_end();
		printf("# at most %.3f ulp, fused %.3f\n", worst[0], worst[1]);
	}
	mpfr_clear(want);
}

static void test_ends_of_f(void)
{
	const Model m = model(0), mf = model(1);
	check_begin("f(0) = 0 and f(inf) = 1 exactly");
	expect(f_double(&m, 0) == 0 && f_double_fma(&m, 0) == 0, "f(0)");
	expect(f_float(&mf, 0) == 0 && f_float_fma(&mf, 0) == 0, "f(0), float");
	expect(f_double(&m, INFINITY) == 1 && f_double_fma(&m, INFINITY) == 1, "f(inf)");
	expect(f_float(&mf, INFINITY) == 1 && f_float_fma(&mf, INFINITY) == 1, "f(inf), float");
	check_end();
}

int main(int argc, char **argv)
{
	if (argc > 1 && strcmp(argv[1], "--print") == 0)
		return print_tables();
	check_start(argc, argv);
	test_numbers();
	test_series_bits();
	test_legendre();
	test_jacobi();
	test_jacobi_nodes();
	test_series_near();
	test_f();
	test_ends_of_f();
	return check_finish();
}

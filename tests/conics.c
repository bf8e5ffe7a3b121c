/* Areas and moments of conics, one edge at a time, against MPFR.
 *
 * f(w) is read off the area of p0 = (0,0), p1 = (1,0), p2 = (0,2), where the chord contributes 0
 * and T is 1: at most 2.5 ulp for every w from 0 to infinity, 10 ulp for -1 < w < 0. Areas of any
 * conic then have an a-priori bound (AREA_ROUNDINGS below). Circles and ellipses in two, four and
 * eight arcs have areas that are known without a conic. Moments are held against 20 u W to degree
 * 6, and against the bound of their kernel above, W from curve_reference.h, in every class of
 * weights.
 *
 * The reference is held against itself first: against quads, by tanh-sinh quadrature of the
 * parametrised curve, and by arcs that add up to ellipses.
 */
#include "curves.h"

#include <limits.h>

/* Of 1/2 (x0 y2 - x2 y0) + f T with T = 1/2 ((x1-x0)(y2-y0) - (x2-x0)(y1-y0)): 4 for T (two
 * differences, a product, a difference), 2.5 ulp <= 5 u for f, 1 for the product, 1 for the sum.
 * 10 ulp for negative weights. */
enum { AREA_ROUNDINGS = 11, NEGATIVE_ROUNDINGS = 26 };

static const double allowed_ulps = 2.5, allowed_negative_ulps = 10;

static long area_roundings(double w)
{
	return w < 0 ? NEGATIVE_ROUNDINGS : AREA_ROUNDINGS;
}

/* ---- weights ---- */

typedef enum {
	USUAL, NEAR_ONE, NEGATIVE, NEGATIVE_TINY, NEAR_MINUS_ONE, LARGE, TINY, SEMICIRCLE, INFINITE,
	WEIGHTS
} Weights;

static const char *const weight_names[WEIGHTS] = {
	"w in 0..3", "w near 1", "w in -0.9..-0.1", "w in -0.1..0", "w near -1", "w in 3..1e6",
	"tiny w", "near-semicircles", "infinite w"
};


static double random_weight(const Api *api, Weights class)
{
	const int bits = api->bits, range = bits == 24 ? 100 : 1000;
	const int least = bits == 24 ? 4 : 20;  /* the curve is of size 1/(1+w) */
	switch (class) {
	case NEAR_ONE: return 1 + random_sized(ldexp(1, -random_int(0, bits)));
	case NEGATIVE: return random_real(-0.9, -0.1);
	case NEGATIVE_TINY: return -ldexp(random_real(0.5, 1), -random_int(4, range / 10));
	case NEAR_MINUS_ONE: return -1 + ldexp(random_real(0.5, 1), -random_int(3, least));
	case LARGE: return 3 * pow(1e6 / 3, random_real(0, 1));
	case TINY: return ldexp(random_real(0.5, 1), -random_int(1, range));
	case SEMICIRCLE: return ldexp(random_real(0.5, 1), -random_int(1, bits / 2));
	case INFINITE: return INFINITY;
	default: return random_int(0, 20) ? random_real(0, 3) : random_int(0, 3);
	}
}

static Curve random_conic(const Api *api, Weights weights, Class class)
{
	Curve c = random_curve(api, CURVE_CONIC, class);
	c.w = random_weight(api, weights);
	if (weights == SEMICIRCLE) {            /* w p1 is of the size of the others */
		c.x[1] /= c.w;
		c.y[1] /= c.w;
	}
	curve_round(api, &c);
	return c;
}

/* ---- the reference against itself ---- */

enum { SELF_BITS = 256 };

/* The point and the derivative of one coordinate: (p0 (1-tau)^2 + 2 w p1 (1-tau^2) + p2 (1+tau)^2)
 * / ((1-tau)^2 + 2 w (1-tau^2) + (1+tau)^2); down = 1-tau, up = 1+tau. */
static void set_point(mpfr_t at, mpfr_t slope, const double *p, double w, mpfr_t down, mpfr_t up)
{
	mpfr_t v[6], tau;
	for (int i = 0; i < 6; i++)
		mpfr_init2(v[i], SELF_BITS);
	mpfr_init2(tau, SELF_BITS);
	mpfr_sub(tau, up, down, MPFR_RNDN);             /* 2 tau */
	mpfr_sqr(v[0], down, MPFR_RNDN);
	mpfr_mul(v[1], down, up, MPFR_RNDN);
	mpfr_mul_d(v[1], v[1], 2 * w, MPFR_RNDN);
	mpfr_sqr(v[2], up, MPFR_RNDN);
	mpfr_mul_si(v[3], down, -2, MPFR_RNDN);         /* derivatives */
	mpfr_mul_d(v[4], tau, -2 * w, MPFR_RNDN);
	mpfr_mul_si(v[5], up, 2, MPFR_RNDN);
	mpfr_t sum[4];                                  /* X, D, X', D' */
	for (int i = 0; i < 4; i++) {
		mpfr_init2(sum[i], SELF_BITS);
		mpfr_set_zero(sum[i], 1);
		for (int j = 0; j < 3; j++) {
			mpfr_mul_d(at, v[i / 2 * 3 + j], i % 2 ? 1 : p[j], MPFR_RNDN);
			mpfr_add(sum[i], sum[i], at, MPFR_RNDN);
		}
	}
	mpfr_div(at, sum[0], sum[1], MPFR_RNDN);
	mpfr_mul(slope, at, sum[3], MPFR_RNDN);
	mpfr_sub(slope, sum[2], slope, MPFR_RNDN);
	mpfr_div(slope, slope, sum[1], MPFR_RNDN);      /* (X' - X/D D') / D */
	for (int i = 0; i < 4; i++)
		mpfr_clear(sum[i]);
	for (int i = 0; i < 6; i++)
		mpfr_clear(v[i]);
	mpfr_clear(tau);
}

/* Adds factor x^m y^n (x y' - y x') at tau to sum. */
static void add_integrand(mpfr_t sum, const Curve *c, int m, int n, mpfr_t down, mpfr_t up,
	mpfr_t factor)
{
	mpfr_t x, y, dx, dy;
	mpfr_inits2(SELF_BITS, x, y, dx, dy, NULL);
	set_point(x, dx, c->x, c->w, down, up);
	set_point(y, dy, c->y, c->w, down, up);
	mpfr_fmms(dx, x, dy, y, dx, MPFR_RNDN);
	mpfr_pow_ui(x, x, (unsigned long)m, MPFR_RNDN);
	mpfr_pow_ui(y, y, (unsigned long)n, MPFR_RNDN);
	mpfr_mul(dx, dx, x, MPFR_RNDN);
	mpfr_mul(dx, dx, y, MPFR_RNDN);
	mpfr_fma(sum, dx, factor, sum, MPFR_RNDN);
	mpfr_clears(x, y, dx, dy, NULL);
}

/* The moment by the trapezoidal rule in s, tau = tanh(pi/2 sinh s),
 * dtau = pi/2 cosh s (1-tau^2) ds; 1 -+ tau = 2/(1 + e^(+-pi sinh s)) lose nothing at the ends. */
static void set_quadrature(mpfr_t out, const Curve *c, int m, int n)
{
	enum { STEPS = 128, RANGE = 5 };
	mpfr_t pi, s, down, up, factor;
	mpfr_inits2(SELF_BITS, pi, s, down, up, factor, NULL);
	mpfr_const_pi(pi, MPFR_RNDN);
	mpfr_set_zero(out, 1);
	for (int i = -RANGE * STEPS; i <= RANGE * STEPS; i++) {
		mpfr_set_d(s, (double)i / STEPS, MPFR_RNDN);
		mpfr_sinh_cosh(up, factor, s, MPFR_RNDN);
		mpfr_mul(up, up, pi, MPFR_RNDN);
		mpfr_exp(up, up, MPFR_RNDN);
		mpfr_add_ui(down, up, 1, MPFR_RNDN);
		mpfr_ui_div(down, 2, down, MPFR_RNDN);
		mpfr_mul(up, up, down, MPFR_RNDN);
		mpfr_mul(factor, factor, down, MPFR_RNDN);
		mpfr_mul(factor, factor, up, MPFR_RNDN);
		add_integrand(out, c, m, n, down, up, factor);
	}
	mpfr_mul(out, out, pi, MPFR_RNDN);
	mpfr_div_ui(out, out, (unsigned long)(2 * STEPS * (m + n + 2)), MPFR_RNDN);
	mpfr_clears(pi, s, down, up, factor, NULL);
}

/* |a - b| / size in bits. */
static double agreement(mpq_t a, mpq_t b, mpq_t size)
{
	if (mpq_equal(a, b))
		return HUGE_VAL;
	if (mpq_sgn(size) == 0)
		return 0;
	mpfr_t v;
	mpq_t difference;
	mpq_init(difference);
	mpfr_init2(v, 64);
	mpq_sub(difference, a, b);
	mpq_abs(difference, difference);
	mpq_div(difference, difference, size);
	mpfr_set_q(v, difference, MPFR_RNDN);
	const double bits = -(double)mpfr_get_exp(v);
	mpfr_clear(v);
	mpq_clear(difference);
	return bits;
}

static void test_quadrature(void)
{
	static const double weights[] = { 0.01, 0.7, 1, 1.5, 20, -0.3, -0.8 };
	static const int monomials[][2] = { { 0, 0 }, { 1, 0 }, { 2, 1 }, { 3, 5 } };
	mpfr_t integral;
	mpq_t want;
	check_begin("reference of conics, quadrature");
	mpfr_init2(integral, SELF_BITS);
	mpq_init(want);
	for (size_t i = 0; i < sizeof weights / sizeof *weights; i++) {
		Ref *moments = ref_new(CURVE_MOMENTS);
		Curve c = random_curve(&apis[0], CURVE_CONIC, UNIFORM);
		c.w = weights[i];
		curve_add(moments, CURVE_DEGREE, &c);
		for (int j = 0; j < 4; j++) {
			const int m = monomials[j][0], n = monomials[j][1];
			if (m + n > CURVE_DEGREE)
				continue;
			Ref *got = &moments[ref_index(m, n)];
			set_quadrature(integral, &c, m, n);
			mpfr_get_q(want, integral);
			const double bits = agreement(got->value, want, got->weight);
			expect(bits > 180, "x%dy%d of w = %g agrees to %g bits", m, n, c.w, bits);
		}
		ref_free(moments, CURVE_MOMENTS);
	}
	mpfr_clear(integral);
	mpq_clear(want);
	check_end();
}

/* The area by f against the moment of degree 0; w = 1 against the quad. */
static void test_formulas(void)
{
	Ref *area = ref_new(1);
	check_begin("reference of conics, formulas");
	for (int i = 0; i < 20 * WEIGHTS; i++) {
		Ref *moments = ref_new(CURVE_MOMENTS);
		const Curve c = random_conic(&apis[0], (Weights)(i % WEIGHTS),
			(Class)(i / WEIGHTS % CLASSES));
		curve_add(moments, 0, &c);
		curve_area(area, &c);
		const double bits = agreement(area->value, moments->value, moments->weight);
		expect(bits > 250, "areas agree to %g bits: %s", bits, curve_text(&c));
		ref_free(moments, CURVE_MOMENTS);
	}
	for (int i = 0; i < 10; i++) {
		Ref *conic = ref_new(CURVE_MOMENTS), *quad = ref_new(CURVE_MOMENTS);
		Curve c = random_curve(&apis[0], CURVE_CONIC, UNIFORM);
		curve_add(conic, CURVE_DEGREE, &c);
		c.kind = CURVE_QUAD;
		curve_add(quad, CURVE_DEGREE, &c);
		for (int j = 0; j < CURVE_MOMENTS; j++) {
			const double bits = agreement(conic[j].value, quad[j].value,
				conic[j].weight);
			expect(bits > 250, "moment %d of a quad agrees to %g bits", j, bits);
		}
		ref_free(conic, CURVE_MOMENTS);
		ref_free(quad, CURVE_MOMENTS);
	}
	check_end();
	ref_free(area, 1);
}

/* ---- f(w) ---- */

typedef struct {
	double w;
	double got;             /* what the last target said, NaN at first */
	mpfr_t exact;
} Factor;

enum { FACTORS = 6000 };

/* Weights with structure: the ends, powers of two, 1, 2 and 3 and what is next to them. */
static double special_weight(const Api *api, int i)
{
	static const double around[] = { 1, 2, 3, 0.5, 0.25, 4 };
	const int bits = api->bits;
	const double tiny = api->denormal, huge = bits == 24 ? (double)FLT_MAX : DBL_MAX;
	switch (i % 4) {
	case 0: return around[i / 4 % 6] * (1 + random_sized(ldexp(1, -random_int(1, bits))));
	case 1: return 1 + (i % 8 < 4 ? 1 : -0.5) * ldexp(1, -(i / 8 % bits));
	case 2: return i % 8 < 4 ? tiny * random_int(1, 100) : ldexp(huge, -random_int(0, 60));
	default: return random_real(0, 1);
	}
}

static double positive_weight(const Api *api, int i)
{
	const int range = api->bits == 24 ? 120 : 700;
	switch (i % 4) {
	case 0: return random_real(0, 1);
	case 1: return random_real(1, 4);
	case 2: return i % 40 == 2 ? ldexp(random_real(0.5, 1), random_int(0, range))
		: ldexp(random_real(0.5, 1), random_int(-range, 12));
	default: return special_weight(api, i / 4);
	}
}

static double negative_weight(const Api *api, int i)
{
	const int range = api->bits == 24 ? 120 : 700;
	switch (i % 4) {
	case 0: return -random_real(0, 1);
	case 1: return -1 + ldexp(random_real(0.5, 1), -random_int(0, api->bits - 1));
	case 2: return -ldexp(random_real(0.5, 1), -random_int(0, range));
	default: return -1 + ldexp(1, -(i / 4 % api->bits) - 1);
	}
}

static double factor_of(const Api *api, double w)
{
	const Curve c = { .kind = CURVE_CONIC, .x = { 0, 1, 0 }, .y = { 0, 0, 2 }, .w = w };
	return area_of(api, &c);
}

static void factors_init(const Api *api, Factor *factors, double (*weight)(const Api *api, int i))
{
	for (int i = 0; i < FACTORS; i++) {
		Factor *f = &factors[i];
		do
			f->w = round_to(api->bits, weight(api, i));
		while (!(f->w > -1) || isinf(f->w));
		f->got = NAN;
		mpfr_init2(f->exact, 160);
		conic_factor(f->exact, f->w);
	}
}

static void test_factor(const Api *api, const char *what, double allowed,
	double (*weight)(const Api *api, int i))
{
	static Factor factors[FACTORS];
	double worst = 0, worst_at = 0;
	check_begin("%s, %s", what, api->name);         /* seeds the generator */
	factors_init(api, factors, weight);
	for (unsigned target = 0; next_target(&target);) {
		check_begin("%s, %s, %s", what, api->name, ew_target_name(target));
		for (int i = 0; i < FACTORS; i++) {
			Factor *f = &factors[i];
			const double got = factor_of(api, f->w);
			if (got == f->got)
				continue;
			f->got = got;
			const double ulps = ref_ulps(got, f->exact, api->bits);
			expect(ulps <= allowed, "f(%.17g) = %.17g, exact %.17g, %.3g ulp", f->w,
				got, mpfr_get_d(f->exact, MPFR_RNDN), ulps);
			if (ulps > worst) {
				worst = ulps;
				worst_at = f->w;
			}
		}
		check_end();
	}
	for (int i = 0; i < FACTORS; i++)
		mpfr_clear(factors[i].exact);
	printf("largest error of %s, %s: %.3f ulp at w = %.17g (allowed %g)\n", what, api->name,
		worst, worst_at, allowed);
}

static void test_limits(const Api *api, const char *target)
{
	static const double bad[] = { -1, -2, -1e30, -INFINITY, NAN };
	check_begin("limits of w, %s, %s", api->name, target);
	expect(factor_of(api, INFINITY) == 1, "f(inf) = %.17g", factor_of(api, INFINITY));
	expect(factor_of(api, 0) == 0 && factor_of(api, -0.0) == 0, "f(0) = %g",
		factor_of(api, 0));
	for (int i = 0; i < 400; i++) {
		Curve c = random_curve(api, CURVE_CONIC, (Class)(i % CLASSES));
		Curve chord = c;
		chord.kind = CURVE_LINE;
		chord.x[1] = c.x[2];
		chord.y[1] = c.y[2];
		c.w = i % 2 ? 0 : -0.0;
		expect(same_bits(area_of(api, &c), area_of(api, &chord)),
			"%a is not the chord, %a: %s", area_of(api, &c), area_of(api, &chord),
			curve_text(&c));
		c.w = INFINITY;
		if (i % CLASSES == INTEGERS)
			expect(2 * area_of(api, &c) == c.x[0] * c.y[1] - c.x[1] * c.y[0]
				+ c.x[1] * c.y[2] - c.x[2] * c.y[1],
				"%.17g is not the polygon: %s", area_of(api, &c), curve_text(&c));
		c.w = bad[i % 5];
		expect(isnan(area_of(api, &c)), "area is %g: %s", area_of(api, &c),
			curve_text(&c));
		for (int d = 0; d <= CURVE_DEGREE; d++) {
			double out[CURVE_MOMENTS];
			expect(moments_of(api, d, &c, out) == EW_OK, "degree %d refused: %s", d,
				curve_text(&c));
			for (int j = 0; j < ref_count(d); j++)
				expect(isnan(get(api, out, j)), "moment %d of degree %d is %g: %s",
					j, d, get(api, out, j), curve_text(&c));
		}
	}
	check_end();
}

/* ---- areas ---- */

static void test_areas(const Api *api, Weights weights)
{
	enum { CURVES = 60 };
	double worst = 0;
	check_begin("areas, %s, %s", weight_names[weights], api->name);
	for (int i = 0; i < CURVES; i++) {
		const Curve c = random_conic(api, weights, (Class)(i % CLASSES));
		const Curve r = curve_reversed(&c);
		Ref *want = ref_new(1);
		curve_area(want, &c);
		for (unsigned target = 0; next_target(&target);) {
			const double got = area_of(api, &c);
			/* f may underflow, and T may be large; a product of coordinates cannot */
			const double size = fmax(fabs(c.x[1]), fabs(c.y[1])) + 1000;
			expect_within(got, want, area_roundings(c.w), api->bits,
				4 * api->denormal * size * 1000, "area by %s of %s",
				ew_target_name(target), curve_text(&c));
			expect(same_bits(got, -area_of(api, &r)), "%a there, %a back by %s: %s",
				got, area_of(api, &r), ew_target_name(target), curve_text(&c));
			if (mpq_sgn(want->weight))
				worst = fmax(worst, ref_units(got, want, api->bits));
		}
		ref_free(want, 1);
	}
	check_end();
	printf("largest error of areas, %s, %s: %.2f u W (allowed %ld)\n", weight_names[weights],
		api->name, worst, area_roundings(random_weight(api, weights)));
}

/* w = 1 is the quad; within the bound of each. */
static void test_quads(const Api *api, const char *target)
{
	Ref *quad = ref_new(1), *conic = ref_new(1);
	check_begin("w = 1 is the quad, %s, %s", api->name, target);
	for (int i = 0; i < 500; i++) {
		Curve c = random_curve(api, CURVE_CONIC, (Class)(i % CLASSES));
		curve_area(conic, &c);
		const double got = area_of(api, &c);
		c.kind = CURVE_QUAD;
		curve_area(quad, &c);
		mpq_set(conic->value, quad->value);
		expect_within(got, conic, AREA_ROUNDINGS, api->bits, 0, "conic of %s",
			curve_text(&c));
		expect_within(area_of(api, &c), quad, 6, api->bits, 0, "%s", curve_text(&c));
	}
	check_end();
	ref_free(quad, 1);
	ref_free(conic, 1);
}

/* ---- circles and ellipses ---- */

/* |got - want| <= units u |want| */
static void expect_near(const Api *api, double got, mpfr_t want, double units, const char *what)
{
	mpfr_t error;
	mpfr_init2(error, mpfr_get_prec(want));
	mpfr_sub_d(error, want, got, MPFR_RNDN);
	mpfr_div(error, error, want, MPFR_RNDN);
	const double off = fabs(mpfr_get_d(error, MPFR_RNDN)) * ldexp(1, api->bits);
	expect(off <= units, "%s is %.17g, exact %.17g, off by %.3g u", what, got,
		mpfr_get_d(want, MPFR_RNDN), off);
	mpfr_clear(error);
}

/* An arc of an axis-parallel ellipse, half axes a and b, from i to i+1 times 360/arcs degrees. */
static Curve arc(const Api *api, int i, int arcs, double cx, double cy, double a, double b)
{
	const double step = 6.283185307179586 / arcs, w = cos(step / 2);
	Curve c = { .kind = CURVE_CONIC, .w = w };
	for (int j = 0; j < 3; j++) {
		const double angle = step * (i + j / 2.0), radius = j == 1 ? 1 / w : 1;
		double x = radius * cos(angle), y = radius * sin(angle);
		if (arcs == 4) {                /* 0 and 1 exactly */
			x = rint(x);
			y = rint(y);
		}
		c.x[j] = cx + a * x;
		c.y[j] = cy + b * y;
	}
	curve_round(api, &c);
	return c;
}

/* Four quarter circles give pi within 2 ulp, and the power of two times as much that axes give. */
static void test_quarters(const Api *api, const char *target)
{
	mpfr_t pi;
	mpfr_init2(pi, 160);
	check_begin("quarter circles, %s, %s", api->name, target);
	for (int i = -10; i <= 10; i++) {
		double sum = 0;
		for (int j = 0; j < 4; j++) {
			const Curve c = arc(api, j, 4, 0, 0, ldexp(1, i), ldexp(1, i / 2));
			sum = round_to(api->bits, sum + area_of(api, &c));
		}
		mpfr_const_pi(pi, MPFR_RNDN);
		mpfr_mul_2si(pi, pi, i + i / 2, MPFR_RNDN);
		const double ulps = ref_ulps(sum, pi, api->bits);
		expect(ulps <= 2, "2^%d pi is off by %g ulp", i + i / 2, ulps);
	}
	check_end();
	mpfr_clear(pi);
}

/* Sums of arcs against the exact sums of the same arcs, and these against pi a b: a weight that is
 * off by u/2 moves the area of four by 0.35 u; centres and axes are integers. Points of eight arcs
 * are rounded too, vertices by u/sqrt 2 and control points by u sqrt 2 in a circle, which moves its
 * area by less than 2 pi sqrt 2 u; 16 u of pi is far above both. */
static void test_arcs(const Api *api, int arcs, double cx, double cy, double a, double b)
{
	Ref *one = ref_new(1), *want = ref_new(1);
	mpfr_t area, exact;
	double sum = 0, rounded = 0;
	mpfr_inits2(160, area, exact, NULL);
	for (int j = 0; j < arcs; j++) {
		const Curve c = arc(api, j, arcs, cx, cy, a, b);
		curve_area(one, &c);
		mpq_add(want->value, want->value, one->value);
		mpq_add(want->weight, want->weight, one->weight);
		sum = round_to(api->bits, sum + area_of(api, &c));
		rounded += fabs(sum);
	}
	/* the additions here */
	const double own = rounded * ldexp(1, -api->bits);
	expect_within(sum, want, AREA_ROUNDINGS, api->bits, own, "ellipse of %d arcs, axes %g, %g",
		arcs, a, b);
	mpfr_set_q(exact, want->value, MPFR_RNDN);
	mpfr_const_pi(area, MPFR_RNDN);
	mpfr_mul_d(area, area, a * b, MPFR_RNDN);
	mpfr_sub(exact, exact, area, MPFR_RNDN);
	mpfr_div(exact, exact, area, MPFR_RNDN);
	const double off = fabs(mpfr_get_d(exact, MPFR_RNDN)) * ldexp(1, api->bits);
	expect(off <= (arcs == 4 ? 1 : 16), "the reference of %d arcs is off by %g u", arcs, off);
	mpfr_clears(area, exact, NULL);
	ref_free(one, 1);
	ref_free(want, 1);
}

static void test_ellipses(const Api *api, const char *target)
{
	check_begin("ellipses of four and circles of eight arcs, %s, %s", api->name, target);
	for (int i = 0; i < 20; i++) {
		const double cx = random_int(-30, 30), cy = random_int(-30, 30);
		const double a = random_int(1, 20), b = random_int(1, 20);
		test_arcs(api, 4, cx, cy, a, b);
		test_arcs(api, 8, 0, 0, ldexp(1, i - 10), ldexp(1, i - 10));
	}
	check_end();
}

/* A conic and its complementary arc: the whole ellipse, pi w T / (1-w^2)^(3/2), for any points.
 * Both chords cancel. */
static void expect_whole(const Api *api, const Curve *c)
{
	Ref *there = ref_new(1), *back = ref_new(1);
	Curve rest = curve_reversed(c);
	mpfr_t f, other;
	mpfr_inits2(CONIC_BITS, f, other, NULL);
	rest.w = -c->w;
	conic_factor(f, c->w);
	conic_factor(other, rest.w);
	mpfr_sub(f, f, other, MPFR_RNDN);
	mpfr_const_pi(other, MPFR_RNDN);
	mpfr_mul_d(other, other, c->w, MPFR_RNDN);
	const double w = c->w, root = sqrt((1 - w) * (1 + w));
	const double whole = 3.141592653589793 * w / (root * root * root);
	expect(fabs(mpfr_get_d(f, MPFR_RNDN) - whole) <= 1e-12 * whole,
		"f(w) - f(-w) of the reference is %g, not %g", mpfr_get_d(f, MPFR_RNDN), whole);
	curve_area(there, c);
	curve_area(back, &rest);
	mpq_add(there->value, there->value, back->value);
	const double a = area_of(api, c), b = area_of(api, &rest);
	const double sum = round_to(api->bits, a + b);
	const double bound = gamma_of(AREA_ROUNDINGS, api->bits) * mpq_get_d(there->weight)
		+ gamma_of(NEGATIVE_ROUNDINGS, api->bits) * mpq_get_d(back->weight)
		+ ldexp(fabs(sum), -api->bits);
	const double off = fabs(sum - mpq_get_d(there->value));
	/* what is rounded here */
	const double own = 0.000001 * bound + ldexp(fabs(sum), -53);
	expect(off <= bound + own, "whole ellipse is %.17g, exact %.17g: %s", sum,
		mpq_get_d(there->value), curve_text(c));
	mpfr_clears(f, other, NULL);
	ref_free(there, 1);
	ref_free(back, 1);
}

static void test_wholes(const Api *api, const char *target)
{
	check_begin("ellipses of an arc and its complement, %s, %s", api->name, target);
	for (int i = 0; i < 200; i++) {
		Curve c = random_curve(api, CURVE_CONIC, (Class)(i % CLASSES));
		c.w = round_to(api->bits, random_real(0.001, 0.98));
		expect_whole(api, &c);
	}
	check_end();
}

/* (1,0), (0,1/w), (-1,0): the chord is 0 and T is 1/w, so the area is f(w)/w, to the 5 u of f and
 * one product each; two of them are pi for w -> 0. */
static void test_semicircles(const Api *api, const char *target)
{
	mpfr_t want;
	mpfr_init2(want, CONIC_BITS);
	check_begin("near-semicircles, %s, %s", api->name, target);
	for (int k = 1; k < 2 * api->bits; k++) {
		const double w = ldexp(1, -k);
		const Curve upper = { .kind = CURVE_CONIC, .x = { 1, 0, -1 }, .y = { 0, 1 / w, 0 },
			.w = w };
		const Curve lower = { .kind = CURVE_CONIC, .x = { -1, 0, 1 },
			.y = { 0, -1 / w, 0 }, .w = w };
		const double a = area_of(api, &upper), b = area_of(api, &lower);
		conic_factor(want, w);
		mpfr_div_d(want, want, w, MPFR_RNDN);
		expect_near(api, a, want, 6, "near-semicircle");
		expect_near(api, b, want, 6, "lower near-semicircle");
		mpfr_const_pi(want, MPFR_RNDN);
		if (k > api->bits)
			expect_near(api, round_to(api->bits, a + b), want, 7, "circle of two");
	}
	check_end();
	mpfr_clear(want);
}

/* ---- moments ---- */

static void test_moments(const Api *api, Weights weights)
{
	enum { SAMPLES = 8 * CLASSES };
	static Sample samples[SAMPLES];
	char what[60];
	long k[CURVE_DEGREE + 1];
	for (int d = 0; d <= CURVE_DEGREE; d++)
		k[d] = d <= 6 ? 20 : curve_row(CURVE_CONIC, d)->k;
	snprintf(what, sizeof what, "moments of conics, %s", weight_names[weights]);
	check_begin("%s, %s", what, api->name);         /* seeds the generator */
	for (int i = 0; i < SAMPLES; i++) {
		const Curve c = random_conic(api, weights, (Class)(i % CLASSES));
		sample_init(&samples[i], &c);
	}
	test_samples(api, what, samples, SAMPLES, k);
}

/* ---- what is refused, and what is no number ---- */

static void test_bad_degree(const Api *api, const char *target)
{
	static const int bad[] = { -1, CURVE_DEGREE + 1, INT_MAX, INT_MIN };
	unsigned char room[CURVE_MOMENTS * sizeof(double)];
	check_begin("degree out of range, %s, %s", api->name, target);
	for (int i = 0; i < 4 * 3; i++) {
		Curve c = random_curve(api, CURVE_CONIC, UNIFORM);
		c.w = i % 3 == 0 ? 1 : i % 3 == 1 ? -1 : NAN;
		memset(room, CANARY, sizeof room);
		expect(moments_of(api, bad[i / 3], &c, room) == EW_BAD_DEGREE,
			"degree %d is not refused", bad[i / 3]);
		for (size_t j = 0; j < sizeof room; j++)
			expect(room[j] == CANARY, "degree %d writes", bad[i / 3]);
	}
	check_end();
}

static void test_nonfinite(const Api *api, const char *target)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	static const double weights[] = { 0.5, 1, 2.5, 10, 1e-30, -0.5, 0, INFINITY };
	check_begin("NaN and infinity, %s, %s", api->name, target);
	for (int i = 0; i < 3 * 6 * 8; i++) {
		Curve c = random_curve(api, CURVE_CONIC, UNIFORM);
		(i % 2 ? c.y : c.x)[i / 2 % 3] = bad[i / 6 % 3];
		c.w = round_to(api->bits, weights[i / 18]);
		expect_nonfinite(api, &c);
	}
	check_end();
}

static void test_target(const Api *api, const char *target)
{
	test_limits(api, target);
	test_quads(api, target);
	test_quarters(api, target);
	test_ellipses(api, target);
	test_wholes(api, target);
	test_semicircles(api, target);
	test_bad_degree(api, target);
	test_nonfinite(api, target);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	test_quadrature();
	test_formulas();
	for (const Api *api = NULL; (api = next_api(api));) {
		test_factor(api, "f(w), w from 0 to infinity", allowed_ulps, positive_weight);
		test_factor(api, "f(w), w from -1 to 0", allowed_negative_ulps, negative_weight);
		for (int weights = 0; weights < WEIGHTS; weights++) {
			test_areas(api, (Weights)weights);
			test_moments(api, (Weights)weights);
		}
	}
	for_each_target(test_target);
	return check_finish();
}

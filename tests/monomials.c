/* monomials.c - what `gen --monomial xMyN --edges line,quad,cubic` emits, against exact integrals:
 * one moment of one edge, in double and float.
 *
 * The exact value comes by another route than the kernels': the edge as a polynomial in t over the
 * rationals, x^m y^n (x y' - y x') multiplied out and integrated power by power. The error must be
 * within gamma_k W with the k that the manifest promises. W is the kernel's sum with every term
 * positive: of lines as in reference.c; of curves the sum over nodes of X^m Y^n Omega in powers of
 * |tau| about the middle of the curve, every coefficient made positive. There odd powers are
 * replaced by more, |tau|^k <= (|tau|^(k-1) + |tau|^(k+1)) / 2, so that what is left has even
 * powers only, whose sums over the nodes are their integrals, or less beyond the exact degree:
 * rational, and W at most by a third too large. */
#include "bounds.h"

#include "edgewise.h"

enum { POINTS = 4, MOST = 32, ROUNDS = 150 };

#define ROWS(X) X(4, 2) X(0, 3) X(5, 1)
#define ARGUMENTS_2(c) c[0], c[1], c[2], c[3]
#define ARGUMENTS_3(c) ARGUMENTS_2(c), c[4], c[5]
#define ARGUMENTS_4(c) ARGUMENTS_3(c), c[6], c[7]

#define CALL(edge, points, m, n) \
	static double edge##_x##m##y##n(const double *c) \
	{ \
		return ew_##edge##_x##m##y##n(ARGUMENTS_##points(c)); \
	} \
	static double edge##_x##m##y##n##f(const double *c) \
	{ \
		float f[2 * POINTS]; \
		for (int i = 0; i < 2 * points; ++i) \
			f[i] = (float)c[i]; \
		return (double)ew_##edge##_x##m##y##n##f(ARGUMENTS_##points(f)); \
	}
#define CALLS(m, n) CALL(line, 2, m, n) CALL(quad, 3, m, n) CALL(cubic, 4, m, n)
ROWS(CALLS)

typedef double Call(const double *coordinates);
typedef struct {
	const char *name;
	int points, m, n;
	Call *call, *callf;
} Monomial;

#define ROW(edge, points, m, n) \
	{ "ew_" #edge "_x" #m "y" #n, points, m, n, edge##_x##m##y##n, edge##_x##m##y##n##f },
#define EDGES(m, n) ROW(line, 2, m, n) ROW(quad, 3, m, n) ROW(cubic, 4, m, n)
static const Monomial monomials[] = { ROWS(EDGES) };
enum { COUNT = (int)(sizeof monomials / sizeof *monomials) };

/* ---- polynomials over the rationals ---- */

typedef struct { mpq_t at[MOST]; } Poly;                          /* coefficients of the powers */

static mpq_t scratch;

static void poly_init(Poly *p)
{
	for (int i = 0; i < MOST; ++i)
		mpq_init(p->at[i]);
}

static void poly_clear(Poly *p)
{
	for (int i = 0; i < MOST; ++i)
		mpq_clear(p->at[i]);
}

static void poly_zero(Poly *p)
{
	for (int i = 0; i < MOST; ++i)
		mpq_set_ui(p->at[i], 0, 1);
}

/* sum += factor a b; none of the three is another. */
static void add_product(Poly *sum, long factor, const Poly *a, const Poly *b)
{
	mpq_t part;
	mpq_init(part);
	mpq_set_si(scratch, factor, 1);
	for (int i = 0; i < MOST; ++i)
		for (int j = 0; i + j < MOST && mpq_sgn(a->at[i]); ++j) {
			if (!mpq_sgn(b->at[j]))
				continue;
			mpq_mul(part, a->at[i], b->at[j]);
			mpq_mul(part, part, scratch);
			mpq_add(sum->at[i + j], sum->at[i + j], part);
		}
	mpq_clear(part);
}

/* p *= base^power */
static void multiply(Poly *p, const Poly *base, int power)
{
	Poly product;
	poly_init(&product);
	for (int i = 0; i < power; ++i) {
		poly_zero(&product);
		add_product(&product, 1, p, base);
		for (int k = 0; k < MOST; ++k)
			mpq_swap(p->at[k], product.at[k]);
	}
	poly_clear(&product);
}

/* ---- value ---- */

/* Control values to powers of t: differences, times binomials. c has a stride of 2. */
static void in_powers(Poly *p, const double *c, int points)
{
	static const long binomial[POINTS][POINTS] = {
		{ 1 }, { 1, 1 }, { 1, 2, 1 }, { 1, 3, 3, 1 }
	};
	poly_zero(p);
	for (int i = 0; i < points; ++i)
		for (int k = 0; k <= i; ++k) {
			const long sign = (i - k) % 2 ? -1 : 1;
			mpq_set_d(scratch, c[2 * k]);
			mpq_t factor;
			mpq_init(factor);
			mpq_set_si(factor, sign * binomial[points - 1][i] * binomial[i][k], 1);
			mpq_mul(factor, factor, scratch);
			mpq_add(p->at[i], p->at[i], factor);
			mpq_clear(factor);
		}
}

static void derive(Poly *derivative, const Poly *p)
{
	poly_zero(derivative);
	for (int i = 1; i < MOST; ++i) {
		mpq_set_si(scratch, i, 1);
		mpq_mul(derivative->at[i - 1], p->at[i], scratch);
	}
}

/* sum += factor p->at[k] / over */
static void add_scaled(mpq_t sum, const Poly *p, int k, long factor, long over)
{
	mpq_set_si(scratch, factor, (unsigned long)over);
	mpq_canonicalize(scratch);
	mpq_mul(scratch, scratch, p->at[k]);
	mpq_add(sum, sum, scratch);
}

static void exact_value(mpq_t value, const Monomial *monomial, const double *c)
{
	const int m = monomial->m, n = monomial->n;
	Poly x, y, slope, integrand;
	poly_init(&x);
	poly_init(&y);
	poly_init(&slope);
	poly_init(&integrand);
	in_powers(&x, c, monomial->points);
	in_powers(&y, c + 1, monomial->points);
	derive(&slope, &y);
	add_product(&integrand, 1, &x, &slope);
	derive(&slope, &x);
	add_product(&integrand, -1, &y, &slope);
	multiply(&integrand, &x, m);
	multiply(&integrand, &y, n);
	mpq_set_ui(value, 0, 1);
	for (int k = 0; k < MOST; ++k)
		add_scaled(value, &integrand, k, 1, (long)(m + n + 2) * (k + 1));
	poly_clear(&x);
	poly_clear(&y);
	poly_clear(&slope);
	poly_clear(&integrand);
}

/* ---- weight ---- */

/* Powers of tau about the middle, with every control value and every sign positive. */
static void about_middle(Poly *p, const double *c, int points)
{
	static const long factor[2][POINTS][POINTS] = {            /* over 4 and 8 */
		{ { 1, 2, 1 }, { 2, 0, 2 }, { 1, 2, 1 } },
		{ { 1, 3, 3, 1 }, { 3, 3, 3, 3 }, { 3, 3, 3, 3 }, { 1, 3, 3, 1 } }
	};
	poly_zero(p);
	for (int j = 0; j < points; ++j)
		for (int i = 0; i < points; ++i) {
			mpq_t part;
			mpq_init(part);
			mpq_set_si(scratch, factor[points - 3][j][i], points == 3 ? 4 : 8);
			mpq_canonicalize(scratch);
			mpq_set_d(part, fabs(c[2 * i]));
			mpq_mul(part, part, scratch);
			mpq_add(p->at[j], p->at[j], part);
			mpq_clear(part);
		}
}

/* The powers of x y' - y x' that the kernel forms: x_i y_j and x_j y_i with the factor j - i. */
static void omega(Poly *sum, const Poly *x, const Poly *y, int points)
{
	poly_zero(sum);
	for (int i = 0; i < points; ++i)
		for (int j = i + 1; j < points; ++j) {
			mpq_t part;
			mpq_init(part);
			mpq_mul(part, x->at[i], y->at[j]);
			mpq_mul(scratch, x->at[j], y->at[i]);
			mpq_add(part, part, scratch);
			mpq_set_si(scratch, j - i, 1);
			mpq_mul(part, part, scratch);
			mpq_add(sum->at[i + j - 1], sum->at[i + j - 1], part);
			mpq_clear(part);
		}
}

/* The integral of p(|tau|) over -1 .. 1, or a little more, without odd powers: 2/(k+1) for even k,
 * for odd k the mean of the even neighbours. */
static void curve_weight(mpq_t weight, const Monomial *monomial, const double *c)
{
	const int m = monomial->m, n = monomial->n, points = monomial->points;
	Poly x, y, integrand;
	poly_init(&x);
	poly_init(&y);
	poly_init(&integrand);
	about_middle(&x, c, points);
	about_middle(&y, c + 1, points);
	omega(&integrand, &x, &y, points);
	multiply(&integrand, &x, m);
	multiply(&integrand, &y, n);
	mpq_set_ui(weight, 0, 1);
	for (int k = 0; k < MOST; ++k)
		if (k % 2 == 0)
			add_scaled(weight, &integrand, k, 2, (long)(m + n + 2) * (k + 1));
		else
			add_scaled(weight, &integrand, k, 2 * (k + 1),
				(long)(m + n + 2) * k * (k + 2));
	poly_clear(&x);
	poly_clear(&y);
	poly_clear(&integrand);
}

/* Of lines the value is known twice, and must be the same. */
static void reference(Ref *want, const Monomial *monomial, const double *c)
{
	exact_value(want->value, monomial, c);
	if (monomial->points > 2) {
		curve_weight(want->weight, monomial, c);
		return;
	}
	Ref *line = ref_new(1);
	ref_line(line, monomial->m, monomial->n, c);
	expect(mpq_equal(line->value, want->value), "the two references differ");
	mpq_set(want->weight, line->weight);
	ref_free(line, 1);
}

/* ---- tests ---- */

/* k of a function in the manifest that gen wrote; 0 if it is not there. */
static long promised(const char *function)
{
	char line[1000], name[100];
	long k = 0;
	snprintf(name, sizeof name, "\"function\": \"%s\",", function);
	FILE *file = fopen(MANIFEST, "r");
	while (file && k == 0 && fgets(line, sizeof line, file)) {
		const char *at = strstr(line, name);
		at = at ? strstr(at, "\"k\": ") : NULL;
		k = at ? strtol(at + 5, NULL, 10) : 0;
	}
	if (file)
		fclose(file);
	return k;
}

enum { UNIFORM, INTEGERS, FAR, SCALED, SHORT, STRAIGHT, KINDS };
static const char *const kinds[] = { "uniform", "integers", "far from the origin",
	"of many sizes", "short", "control points on a line" };

/* Coordinates that float holds exactly, so that one reference serves both precisions. */
static void draw(double *c, int kind, int points)
{
	for (int i = 0; i < 2 * points; ++i) {
		const double v = random_real(-2, 2);
		switch (kind) {
		case UNIFORM:  c[i] = v; break;
		case INTEGERS: c[i] = random_int(-9, 9); break;
		case FAR:      c[i] = v + (i % 2 ? -3000 : 5000); break;
		case SCALED:   c[i] = random_scaled(-6, 6); break;
		case SHORT:    c[i] = v * 0x1p-10 + (i % 2 ? 0.7 : 0.3); break;
		case STRAIGHT: c[i] = i < 2 ? v : c[i - 2] + (i % 2 ? 0.25 : -0.5); break;
		}
		c[i] = (double)(float)c[i];
	}
}

static void test_edges(const Monomial *monomial, int kind)
{
	Ref *want = ref_new(1);
	double c[2 * POINTS];
	check_begin("%s, %s", monomial->name, kinds[kind]);
	const long k = promised(monomial->name);
	expect(k > 0, "no k in %s", MANIFEST);
	for (int i = 0; i < ROUNDS; ++i) {
		draw(c, kind, monomial->points);
		reference(want, monomial, c);
		expect_within(monomial->call(c), want, k, 53, 0, "edge %d", i);
		expect_within(monomial->callf(c), want, k, 24, 0, "edge %d, float", i);
	}
	check_end();
	ref_free(want, 1);
}

/* All control points are one point: nothing. NaN anywhere: NaN. */
static void test_special(const Monomial *monomial)
{
	double c[2 * POINTS];
	check_begin("%s, one point and NaN", monomial->name);
	for (int i = 0; i < 2 * monomial->points; ++i)
		c[i] = i % 2 ? -0.7f : 0.3f;
	expect(monomial->call(c) == 0 && monomial->callf(c) == 0, "one point gives %g and %g",
		monomial->call(c), monomial->callf(c));
	for (int i = 0; i < 2 * monomial->points; ++i) {
		const double kept = c[i];
		c[i] = NAN;
		expect(isnan(monomial->call(c)) && isnan(monomial->callf(c)), "NaN in place %d", i);
		c[i] = kept;
	}
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	mpq_init(scratch);
	for (int i = 0; i < COUNT; ++i) {
		for (int kind = 0; kind < KINDS; ++kind)
			test_edges(&monomials[i], kind);
		test_special(&monomials[i]);
	}
	mpq_clear(scratch);
	return check_finish();
}

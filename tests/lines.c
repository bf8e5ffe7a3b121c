/* Tests of every ew_line_xMyN of the kernel list, in both precisions.
 *
 * One test per row. Random edges of every kind are held against the exact integral over the signed
 * triangle (origin, p0, p1) with the bound gamma_k W, k as the list states it; k itself must not
 * exceed 2(m+n)+5. Integer edges small enough that every sum is exact must meet the exact quotient
 * to the few roundings of the rational factor. A reversed edge negates every bit, a repeated vertex
 * gives 0, coordinates of 1e30 and 1e-30 neither overflow nor underflow early, and NaN or infinity
 * anywhere comes out as NaN or infinity. The matrix of x4y2 is read back from the function.
 *
 * The reference is tested first, against closed forms that it does not use.
 */
#include "edgewise.h"
#include "edgewise_kernels.h"

#include "bounds.h"

typedef struct {
	const char *name;
	int m, n, k, bits;
	double (*in_double)(double x0, double y0, double x1, double y1);
	float (*in_float)(float x0, float y0, float x1, float y1);
} Line;

#define ROW_DOUBLE(m, n, symbol, k) { #symbol, m, n, k, 53, symbol, NULL },
#define ROW_FLOAT(m, n, symbol, k) { #symbol, m, n, k, 24, NULL, symbol },

static const Line lines[] = { EW_LINES_DOUBLE(ROW_DOUBLE) EW_LINES_FLOAT(ROW_FLOAT) };

enum { LINES = sizeof lines / sizeof *lines, EDGES_PER_KIND = 150 };

static double evaluate(const Line *line, const double e[4])
{
	if (line->in_double)
		return line->in_double(e[0], e[1], e[2], e[3]);
	return (double)line->in_float((float)e[0], (float)e[1], (float)e[2], (float)e[3]);
}

/* Kinds of edges. Coordinates stay below 2^(top+1), so that the degree does not overflow. */

static void uniform(double e[4], int top)
{
	(void)top;
	for (int i = 0; i < 4; i++)
		e[i] = random_real(-1, 1);
}

static void mixed(double e[4], int top)
{
	for (int i = 0; i < 4; i++)
		e[i] = 2 * random_scaled(-top, top);
}

static void integers(double e[4], int top)
{
	const int most = top < 4 ? 1 << top : 12;
	for (int i = 0; i < 4; i++)
		e[i] = random_int(-most, most);
}

static void axes(double e[4], int top)
{
	mixed(e, top / 2);
	e[random_int(0, 1)] = 0;
	e[random_int(2, 3)] = 0;
}

static void collinear(double e[4], int top)
{
	const double t = random_scaled(-top / 2, 0);
	e[0] = random_real(-2, 2);
	e[1] = random_real(-2, 2);
	e[2] = t * e[0];
	e[3] = t * e[1] * (1 + random_int(-2, 2) * 0x1p-23);
}

static void offset(double e[4], int top)
{
	const double x = ldexp(random_real(-1, 1), top), y = ldexp(random_real(-1, 1), top);
	for (int i = 0; i < 4; i++)
		e[i] = (i % 2 ? y : x) + random_real(-5, 5) / 5 * fmin(5, ldexp(1, top - 4));
}

static const struct {
	const char *name;
	void (*fill)(double e[4], int top);
} kinds[] = {
	{ "uniform", uniform }, { "mixed", mixed }, { "integers", integers }, { "axes", axes },
	{ "collinear", collinear }, { "offset", offset },
};

enum { KINDS = sizeof kinds / sizeof *kinds };

/* Sizes 2^+-20; for float whatever leaves room for the coefficients. */
static int largest_exponent(const Line *line)
{
	const int fits = 90 / (line->m + line->n + 2);
	return line->bits == 24 && fits < 20 ? fits : 20;
}

static void random_edge(const Line *line, int kind, double e[4])
{
	kinds[kind].fill(e, largest_exponent(line));
	for (int i = 0; i < 4; i++)
		e[i] = round_to(line->bits, e[i]);
}

static bool edge_within(const Line *line, const char *kind, const double e[4], double tiny)
{
	Ref *want = ref_new(1);
	ref_line(want, line->m, line->n, e);
	const bool ok = expect_within(evaluate(line, e), want, line->k, line->bits, tiny,
		"%s edge (%a, %a) (%a, %a)", kind, e[0], e[1], e[2], e[3]);
	ref_free(want, 1);
	return ok;
}

static void test_bound(const Line *line)
{
	const int degree = line->m + line->n;
	double e[4];
	expect(line->k <= 2 * degree + 5, "k = %d is more than %d", line->k, 2 * degree + 5);
	for (int kind = 0; kind < KINDS; kind++) {
		for (int i = 0; i < EDGES_PER_KIND; i++) {
			random_edge(line, kind, e);
			/* two vertices: ref_tiny reads x and y as one list anyway */
			const double tiny = ref_tiny(line->k, degree, line->bits, e, e + 2, 2) / 2;
			if (!edge_within(line, kinds[kind].name, e, tiny))
				return;
		}
	}
}

static void test_symmetry(const Line *line)
{
	for (int i = 0; i < 8 * EDGES_PER_KIND; i++) {
		double e[4];
		random_edge(line, i % KINDS, e);
		const double back[4] = { e[2], e[3], e[0], e[1] };
		const double point[4] = { e[0], e[1], e[0], e[1] };
		const double forward = evaluate(line, e), reversed = evaluate(line, back);
		expect(same_bits(forward, -reversed), "edge (%a, %a) (%a, %a) is %a, reversed %a",
			e[0], e[1], e[2], e[3], forward, reversed);
		expect(evaluate(line, point) == 0, "repeated vertex (%a, %a) is %a", e[0], e[1],
			evaluate(line, point));
	}
}

/* Sums below 2^(bits-1) are exact: only the rational factor rounds, once or split in two. */
static void test_integers(const Line *line)
{
	const int degree = line->m + line->n;
	int most = 1;
	while (largest_sum(degree) * pow(most + 1, degree + 2) < ldexp(1, line->bits - 1)
		&& most < 1000)
		most++;
	Ref *want = ref_new(1);
	for (int i = 0; i < EDGES_PER_KIND; i++) {
		double e[4];
		for (int j = 0; j < 4; j++)
			e[j] = random_int(-most, most);
		ref_line(want, line->m, line->n, e);
		mpq_abs(want->weight, want->value);
		expect_within(evaluate(line, e), want, 3, line->bits, 0,
			"exact sum, edge (%g, %g) (%g, %g)", e[0], e[1], e[2], e[3]);
	}
	ref_free(want, 1);
}

static void test_extremes(const Line *line)
{
	const int degree = line->m + line->n;
	for (int i = 0; i < 2 * EDGES_PER_KIND; i++) {
		const double scale = i % 2 ? large_scale(degree, line->bits, 1)
			: small_scale(degree, line->bits);
		double e[4];
		for (int j = 0; j < 4; j++)
			e[j] = round_to(line->bits, random_sized(scale));
		/* a cancelling result may be subnormal: its last roundings, nothing amplified */
		const double tiny = i % 2 ? 0 : 4 * (line->bits == 24 ? 0x1p-149 : 0x1p-1074);
		edge_within(line, "extreme", e, tiny);
	}
}

static void test_nonfinite(const Line *line)
{
	const double bad[] = { NAN, INFINITY, -INFINITY };
	for (int i = 0; i < 12 * 16; i++) {
		double e[4];
		for (int j = 0; j < 4; j++)
			e[j] = random_int(-2, 2);
		e[i % 4] = bad[i / 4 % 3];
		expect(!isfinite(evaluate(line, e)), "edge (%g, %g) (%g, %g) is finite", e[0], e[1],
			e[2], e[3]);
	}
}

static void test_line(const Line *line)
{
	check_begin("%s", line->name);
	test_bound(line);
	test_symmetry(line);
	test_integers(line);
	test_extremes(line);
	test_nonfinite(line);
	check_end();
}

/* The list holds every monomial once in each precision. */
static void test_list(void)
{
	check_begin("list of line kernels");
	for (int bits = 24; bits <= 53; bits += 29) {
		int seen[EW_MOMENTS(EW_MAX_DEGREE)] = { 0 };
		for (int i = 0; i < LINES; i++) {
			if (lines[i].bits != bits
				|| !expect(lines[i].m + lines[i].n <= EW_MAX_DEGREE,
					"%s is beyond the degree", lines[i].name))
				continue;
			seen[EW_INDEX(lines[i].m, lines[i].n)]++;
		}
		for (int i = 0; i < EW_MOMENTS(EW_MAX_DEGREE); i++)
			expect(seen[i] == 1, "monomial %d is there %d times in %d bits", i, seen[i],
				bits);
	}
	for (int d = 0; d <= EW_MAX_DEGREE; d++) {
		for (int n = 0; n <= d; n++)
			expect(EW_INDEX(d - n, n) == ref_index(d - n, n), "index of x%dy%d", d - n,
				n);
		expect(EW_MOMENTS(d) == ref_count(d), "number of moments of degree %d", d);
	}
	check_end();
}

/* The integer sum of x4y2 at one edge: f = cross * sum / 840. */
static void probe(const double e[4], long out[5])
{
	const double cross = e[0] * e[3] - e[2] * e[1];
	const double sum = ew_line_x4y2(e[0], e[1], e[2], e[3]) * 840 / cross;
	long rest = lround(sum);
	expect(fabs(sum - (double)rest) < 1e-3, "x4y2 has no integer coefficients: %.17g", sum);
	for (int p = 0; p < 5; p++) {
		out[p] = rest % 32;
		rest /= 32;
	}
	expect(rest == 0, "a coefficient of x4y2 is more than 31");
}

/* x0 = 1 and x1 = 32 write the five rows as digits; (y0,y1) = (1,0), (0,1), (1,1) choose the first
 * column, the last one, and the sum of all three. */
static void test_matrix(void)
{
	static const long want[5][3] = {
		{ 15, 5, 1 }, { 10, 8, 3 }, { 6, 9, 6 }, { 3, 8, 10 }, { 1, 5, 15 }
	};
	long first[5], last[5], all[5];
	check_begin("matrix of x4y2");
	probe((const double[4]){ 1, 1, 32, 0 }, first);
	probe((const double[4]){ 1, 0, 32, 1 }, last);
	probe((const double[4]){ 1, 1, 32, 1 }, all);
	for (int p = 0; p < 5; p++) {
		const long middle = all[p] - first[p] - last[p];
		expect(first[p] == want[p][0] && middle == want[p][1] && last[p] == want[p][2],
			"row %d is [%ld %ld %ld]", p, first[p], middle, last[p]);
	}
	check_end();
}

static unsigned long factorial(int n)
{
	return n < 2 ? 1 : (unsigned long)n * factorial(n - 1);
}

static void expect_exact(const mpq_t got, unsigned long top, unsigned long bottom, const char *what,
	int m, int n)
{
	mpq_t want;
	mpq_init(want);
	mpq_set_ui(want, top, bottom);
	mpq_canonicalize(want);
	expect(mpq_equal(got, want), "%s of x%dy%d is %.17g", what, m, n, mpq_get_d(got));
	mpq_clear(want);
}

/* A triangle, a rectangle and the weight by its binomial formula. */
static void test_reference(void)
{
	const double tx[] = { 0, 1, 0 }, ty[] = { 0, 0, 1 };
	const double rx[] = { 0, 3, 3, 0 }, ry[] = { 0, 0, 2, 2 };
	Ref *triangle = ref_new(ref_count(8)), *rectangle = ref_new(ref_count(8));
	Ref *one = ref_new(1);
	check_begin("reference");
	ref_ring(triangle, 8, tx, ty, 3);
	ref_ring(rectangle, 8, rx, ry, 4);
	for (int m = 0; m <= 8; m++) {
		for (int n = 0; m + n <= 8; n++) {
			const int at = ref_index(m, n);
			expect_exact(triangle[at].value, factorial(m) * factorial(n),
				factorial(m + n + 2), "triangle", m, n);
			expect_exact(rectangle[at].value,
				(unsigned long)(pow(3, m + 1) * pow(2, n + 1)),
				(unsigned long)((m + 1) * (n + 1)), "rectangle", m, n);
			/* at (1,-1), (-1,1) every term is 1 times its binomials, the cross 0 */
			ref_line(one, m, n, (const double[4]){ 1, -1, -1, 1 });
			expect_exact(one->value, 0, 1, "cross", m, n);
			expect_exact(one->weight, 2, (unsigned long)(m + n + 2), "weight", m, n);
			/* at (1,-1), (2,0) only q = 0 is left: sum of C(m+n-p,n) 2^p, cross 2 */
			unsigned long sum = 0;
			for (int p = 0; p <= m; p++)
				sum += (factorial(m + n - p) / factorial(n) / factorial(m - p))
					<< p;
			ref_line(one, m, n, (const double[4]){ 1, -1, 2, 0 });
			expect_exact(one->weight, 2 * sum * factorial(m) * factorial(n),
				factorial(m + n + 2), "one-sided weight", m, n);
		}
	}
	check_end();
	ref_free(triangle, ref_count(8));
	ref_free(rectangle, ref_count(8));
	ref_free(one, 1);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	test_reference();
	test_list();
	test_matrix();
	for (int i = 0; i < LINES; i++)
		test_line(&lines[i]);
	return check_finish();
}

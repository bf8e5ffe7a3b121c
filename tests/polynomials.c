/* polynomials.c - what `gen --polynomial` emits, against exact moments: the integral of a
 * polynomial is the sum of its coefficients times moments, and so is the weight of its error bound
 * with every term positive. Both precisions, every target, edges and rings. The emission is made by
 * the Makefile from the same expressions as in the table below. */
#include "bounds.h"

#include "edgewise.h"
#include "edgewise_kernels.h"

typedef struct { int m, n, num, den; } Term;
typedef struct {
	const char *name;
	double (*edge)(double, double, double, double);
	float (*edgef)(float, float, float, float);
	double (*ring)(const double *, const double *, size_t);
	float (*ringf)(const float *, const float *, size_t);
	int id, degree, terms;
	Term term[6];
} Polynomial;

static const Polynomial polynomials[] = {
	{ "soft", ew_line_soft, ew_line_softf, ew_soft, ew_softf, EW_RING_SOFT, 2, 4,
		{ { 0, 0, 1, 1 }, { 1, 0, -1, 1 }, { 0, 1, -1, 1 }, { 1, 1, 1, 1 } } },
	{ "saddle", ew_line_saddle, ew_line_saddlef, ew_saddle, ew_saddlef, EW_RING_SADDLE, 2, 2,
		{ { 2, 0, 1, 1 }, { 0, 2, -1, 1 } } },
	{ "deep", ew_line_deep, ew_line_deepf, ew_deep, ew_deepf, EW_RING_DEEP, 8, 4,
		{ { 5, 3, 1, 7 }, { 2, 4, -5, 2 }, { 1, 0, -2, 1 }, { 0, 0, 1, 3 } } },
};
enum { COUNT = (int)(sizeof polynomials / sizeof *polynomials), LONGEST = 100, DEGREE = 8 };

#define BOUND(id, family, m, n, accumulators, outputs, k, r) { k, r },
static const struct { int k, r; } ring_bound[] = { EW_RINGS(BOUND) };
#define EDGE_BOUND(function, id, edge, k) [id] = k,
static const int edge_bound[EW_RINGS_COUNT] = { EW_POLYNOMIALS_DOUBLE(EDGE_BOUND) };

/* Value and weight of the polynomial from those of the monomials. */
static void combine(Ref *out, const Polynomial *p, const Ref *moment)
{
	mpq_t factor, part;
	mpq_inits(factor, part, NULL);
	mpq_set_ui(out->value, 0, 1);
	mpq_set_ui(out->weight, 0, 1);
	for (int i = 0; i < p->terms; ++i) {
		const Ref *from = &moment[ref_index(p->term[i].m, p->term[i].n)];
		mpq_set_si(factor, p->term[i].num, (unsigned long)p->term[i].den);
		mpq_canonicalize(factor);
		mpq_mul(part, factor, from->value);
		mpq_add(out->value, out->value, part);
		mpq_abs(factor, factor);
		mpq_mul(part, factor, from->weight);
		mpq_add(out->weight, out->weight, part);
	}
	mpq_clears(factor, part, NULL);
}

/* Coordinates that float holds exactly, so that one reference serves both precisions. */
static void random_ring(double *x, double *y, size_t n)
{
	for (size_t i = 0; i < n; ++i) {
		x[i] = round_to(24, random_real(-2, 2));
		y[i] = round_to(24, random_real(-2, 2));
	}
}

static void test_edges(const Polynomial *p)
{
	Ref *moment = ref_new(ref_count(DEGREE)), *want = ref_new(1);
	check_begin("edge of %s", p->name);
	for (int i = 0; i < 300; ++i) {
		double x[2], y[2];
		random_ring(x, y, 2);
		const double edge[4] = { x[0], y[0], x[1], y[1] };
		for (int d = 0; d <= p->degree; ++d)
			for (int n = 0; n <= d; ++n)
				ref_line(&moment[ref_index(d - n, n)], d - n, n, edge);
		combine(want, p, moment);
		double have = p->edge(x[0], y[0], x[1], y[1]);
		float havef = p->edgef((float)x[0], (float)y[0], (float)x[1], (float)y[1]);
		expect_within(have, want, edge_bound[p->id], 53, 0, "edge %d", i);
		expect_within((double)havef, want, edge_bound[p->id], 24, 0, "edge %d, float", i);
		expect(same_bits(p->edge(x[1], y[1], x[0], y[0]), -have), "reversal of edge %d", i);
	}
	check_end();
	ref_free(moment, ref_count(DEGREE));
	ref_free(want, 1);
}

static void test_rings(const Polynomial *p, unsigned target)
{
	Ref *moment = ref_new(ref_count(DEGREE)), *want = ref_new(1);
	double x[LONGEST], y[LONGEST];
	float xf[LONGEST], yf[LONGEST];
	check_begin("ring of %s, %s", p->name, ew_target_name(target));
	expect(ew_use_target(target) == EW_OK, "the target is refused");
	for (size_t n = 0; n <= LONGEST; n += n < 40 ? 1 : 20) {
		random_ring(x, y, n);
		for (size_t i = 0; i < n; ++i) {
			xf[i] = (float)x[i];
			yf[i] = (float)y[i];
		}
		ref_ring(moment, p->degree, x, y, n);
		combine(want, p, moment);
		long k = ring_bound[p->id].k, r = ring_bound[p->id].r, items = (long)n;
		long kd = k + r * ((items + 7) / 8) + 3, kf = k + r * ((items + 15) / 16) + 5;
		expect_within(p->ring(x, y, n), want, kd, 53, 0, "n = %zu", n);
		expect_within((double)p->ringf(xf, yf, n), want, kf, 24, 0, "n = %zu, float", n);
	}
	check_end();
	ref_free(moment, ref_count(DEGREE));
	ref_free(want, 1);
}

static void test_unit_square(void)
{
	const double x[] = { 0, 1, 1, 0 }, y[] = { 0, 0, 1, 1 };
	check_begin("the tent over its unit square is exactly 1/4");
	expect(ew_soft(x, y, 4) == 0.25, "it is %.17g", ew_soft(x, y, 4));
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	for (int i = 0; i < COUNT; ++i) {
		test_edges(&polynomials[i]);
		for (unsigned target = 1; target; target <<= 1)
			if (ew_targets() & target)
				test_rings(&polynomials[i], target);
	}
	ew_use_target(0);
	test_unit_square();
	return check_finish();
}

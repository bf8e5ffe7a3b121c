/* Areas and moments of lines, quads and cubics, one edge at a time.
 *
 * Areas are exact on small integers, stay within the bounds of their formulas (2, 6 and 9
 * roundings, the last a true division) of exact rationals, are negated bit for bit by reversal,
 * and are 0 if all control points are one. Moments to the last degree stay within gamma_k W, k from
 * the list of kernels and W from curve_reference.h; exact values come from polynomials in the
 * parameter, not from quadrature. The reference is held against itself first: curves split by de
 * Casteljau, raised in degree, and by the formulas of their areas.
 */
#include "curves.h"

#include <limits.h>

static const int kinds[] = { CURVE_LINE, CURVE_QUAD, CURVE_CUBIC };

enum { KINDS = sizeof kinds / sizeof *kinds };

/* ---- the reference against itself ---- */

/* Both halves, exactly if the coordinates have bits to spare. */
static void halve(const Curve *c, Curve *left, Curve *right)
{
	const int last = curve_points(c->kind) - 1;
	Curve rest = *c;
	*left = *right = *c;
	for (int i = 0; i <= last; i++) {
		left->x[i] = rest.x[0];
		left->y[i] = rest.y[0];
		right->x[last - i] = rest.x[last - i];
		right->y[last - i] = rest.y[last - i];
		for (int j = 0; j < last - i; j++) {
			rest.x[j] = (rest.x[j] + rest.x[j + 1]) / 2;
			rest.y[j] = (rest.y[j] + rest.y[j + 1]) / 2;
		}
	}
}

/* The same curve as one of the next kind; exact if ends differ by multiples of 2 or 3. */
static Curve raised(const Curve *c)
{
	Curve r = *c;
	const int order = curve_points(c->kind);
	r.kind = c->kind == CURVE_LINE ? CURVE_QUAD : CURVE_CUBIC;
	for (int i = 1; i <= order; i++) {
		const int from = i < order ? i : i - 1;
		r.x[i] = (i * c->x[i - 1] + (order - i) * c->x[from]) / order;
		r.y[i] = (i * c->y[i - 1] + (order - i) * c->y[from]) / order;
	}
	return r;
}

/* A curve whose raised form is exact. */
static Curve random_raisable(int kind)
{
	Curve c = { .kind = kind };
	for (int i = 0; i < curve_points(kind); i++) {
		c.x[i] = 6 * random_int(-500, 500) * 0x1p-8;
		c.y[i] = 6 * random_int(-500, 500) * 0x1p-8;
	}
	return c;
}

static void expect_equal_refs(const Ref *a, const Ref *b, const char *what)
{
	for (int i = 0; i < CURVE_MOMENTS; i++)
		expect(mpq_equal(a[i].value, b[i].value), "moment %d of a curve %s is %g, not %g",
			i, what, mpq_get_d(b[i].value), mpq_get_d(a[i].value));
}

/* a - b = 0 for every moment of the curve and of what should be the same. */
static void expect_reference(const Curve *c)
{
	Ref *whole = ref_new(CURVE_MOMENTS), *halves = ref_new(CURVE_MOMENTS);
	Curve left, right;
	halve(c, &left, &right);
	curve_add(whole, CURVE_DEGREE, c);
	curve_add(halves, CURVE_DEGREE, &left);
	curve_add(halves, CURVE_DEGREE, &right);
	expect_equal_refs(whole, halves, "in halves");
	if (c->kind != CURVE_CUBIC) {
		Ref *other = ref_new(CURVE_MOMENTS);
		const Curve r = raised(c);
		curve_add(other, CURVE_DEGREE, &r);
		expect_equal_refs(whole, other, "raised");
		ref_free(other, CURVE_MOMENTS);
	}
	ref_free(whole, CURVE_MOMENTS);
	ref_free(halves, CURVE_MOMENTS);
}

static double cross(const Curve *c, int i, int j)
{
	return c->x[i] * c->y[j] - c->x[j] * c->y[i];
}

/* 2, 6, 20 times the area, exactly if the control points are small integers. */
static double area_numerator(const Curve *c)
{
	switch (c->kind) {
	case CURVE_LINE:
		return cross(c, 0, 1);
	case CURVE_QUAD:
		return 2 * cross(c, 0, 1) + 2 * cross(c, 1, 2) + cross(c, 0, 2);
	default:
		return 6 * cross(c, 0, 1) + 3 * cross(c, 0, 2) + cross(c, 0, 3)
			+ 3 * cross(c, 1, 2) + 3 * cross(c, 1, 3) + 6 * cross(c, 2, 3);
	}
}

static int area_denominator(int kind)
{
	return kind == CURVE_LINE ? 2 : kind == CURVE_QUAD ? 6 : 20;
}

static void expect_reference_area(const Curve *c)
{
	Ref *area = ref_new(1);
	mpq_t want;
	mpq_init(want);
	mpq_set_si(want, (long)area_numerator(c), (unsigned long)area_denominator(c->kind));
	mpq_canonicalize(want);
	curve_area(area, c);
	expect(mpq_equal(area->value, want), "area is %g, exact %g", mpq_get_d(area->value),
		mpq_get_d(want));
	mpq_clear(want);
	ref_free(area, 1);
}

static void expect_reference_line(const Curve *c)
{
	const double edge[4] = { c->x[0], c->y[0], c->x[1], c->y[1] };
	Ref *moments = ref_new(CURVE_MOMENTS), *line = ref_new(1);
	curve_add(moments, CURVE_DEGREE, c);
	for (int i = 0; i < CURVE_MOMENTS; i++) {
		int d = 0;
		while (ref_index(0, d) < i)
			d++;
		const int n = i - ref_index(d, 0);
		ref_line(line, d - n, n, edge);
		expect(mpq_equal(line->value, moments[i].value)
				&& mpq_equal(line->weight, moments[i].weight),
			"moment %d is not that of a line", i);
	}
	ref_free(moments, CURVE_MOMENTS);
	ref_free(line, 1);
}

static void test_reference(void)
{
	for (int kind = 0; kind < KINDS; kind++) {
		check_begin("reference of %ss", curve_names[kinds[kind]]);
		for (int i = 0; i < 10; i++) {
			const Curve c = random_raisable(kinds[kind]);
			const Curve integers = random_curve(&apis[0], kinds[kind], INTEGERS);
			expect_reference(&c);
			expect_reference_area(&integers);
			if (c.kind == CURVE_LINE)
				expect_reference_line(&c);
		}
		check_end();
	}
}

/* ---- areas ---- */

/* The area is the rounded quotient of integers; since 2, 6 and 20 are sums of two powers of two,
 * multiplying gives the integer back. */
static void test_integers(const Api *api, const char *target)
{
	check_begin("areas of integers, %s, %s", api->name, target);
	for (int i = 0; i < 3000; i++) {
		const Curve c = random_curve(api, kinds[i % KINDS], INTEGERS);
		const int denominator = area_denominator(c.kind);
		const double numerator = area_numerator(&c), got = area_of(api, &c);
		expect(got == round_to(api->bits, numerator / denominator)
				&& round_to(api->bits, denominator * got) == numerator,
			"area is %.17g, not %g/%d: %s", got, numerator, denominator,
			curve_text(&c));
	}
	check_end();
}

static void test_areas(const Api *api, const char *target)
{
	static const long k[CURVE_KINDS] = {
		[CURVE_LINE] = 2, [CURVE_QUAD] = 6, [CURVE_CUBIC] = 9
	};
	double worst[CURVE_KINDS] = { 0 };
	Ref *want = ref_new(1);
	check_begin("areas, %s, %s", api->name, target);
	for (int i = 0; i < 3000; i++) {
		const Curve c = random_curve(api, kinds[i % KINDS], (Class)(i / KINDS % CLASSES));
		const double got = area_of(api, &c);
		curve_area(want, &c);
		expect_within(got, want, k[c.kind], api->bits, 0, "area of %s", curve_text(&c));
		if (mpq_sgn(want->weight))
			worst[c.kind] = fmax(worst[c.kind], ref_units(got, want, api->bits));
	}
	check_end();
	printf("largest error of areas, %s, %s, in u W (allowed):", api->name, target);
	for (int i = 0; i < KINDS; i++)
		printf(" %s %.2f (%ld)", curve_names[kinds[i]], worst[kinds[i]], k[kinds[i]]);
	printf("\n");
	ref_free(want, 1);
}

static void test_reversed_areas(const Api *api, const char *target)
{
	check_begin("reversed areas, %s, %s", api->name, target);
	for (int i = 0; i < 3000; i++) {
		const Curve c = random_curve(api, kinds[i % KINDS], (Class)(i / KINDS % CLASSES));
		const Curve r = curve_reversed(&c);
		const double there = area_of(api, &c), back = area_of(api, &r);
		expect(same_bits(there, -back), "%a there, %a back: %s", there, back,
			curve_text(&c));
	}
	check_end();
}

static Curve random_point(const Api *api, int kind, Class class)
{
	Curve c = random_curve(api, kind, class);
	for (int i = 1; i < CURVE_POINTS; i++) {
		c.x[i] = c.x[0];
		c.y[i] = c.y[0];
	}
	return c;
}

static void test_points(const Api *api, const char *target)
{
	check_begin("curves of one point, areas, %s, %s", api->name, target);
	for (int i = 0; i < 600; i++) {
		const Curve c = random_point(api, kinds[i % KINDS], (Class)(i / KINDS % CLASSES));
		const double area = area_of(api, &c);
		expect(area == 0, "area is %g: %s", area, curve_text(&c));
	}
	check_end();
	check_begin("curves of one point, moments, %s, %s", api->name, target);
	for (int i = 0; i < 600; i++) {
		const Curve c = random_point(api, kinds[i % KINDS], (Class)(i / KINDS % CLASSES));
		for (int d = 0; d <= CURVE_DEGREE; d++) {
			double out[CURVE_MOMENTS];
			moments_of(api, d, &c, out);
			for (int j = 0; j < ref_count(d); j++)
				expect(get(api, out, j) == 0, "moment %d of degree %d is %g: %s", j,
					d, get(api, out, j), curve_text(&c));
		}
	}
	check_end();
}

/* ---- moments ---- */

static void kernel_bounds(long *k, int kind)
{
	for (int d = 0; d <= CURVE_DEGREE; d++)
		k[d] = curve_row(kind, d)->k;
}

static void test_moments(const Api *api, int kind)
{
	enum { SAMPLES = 15 * CLASSES };
	static Sample samples[SAMPLES];
	char what[40];
	long k[CURVE_DEGREE + 1];
	snprintf(what, sizeof what, "moments of %ss", curve_names[kind]);
	check_begin("%s, %s", what, api->name);
	for (int i = 0; i < SAMPLES; i++) {
		const Curve c = random_curve(api, kind, (Class)(i % CLASSES));
		sample_init(&samples[i], &c);
	}
	kernel_bounds(k, kind);
	test_samples(api, what, samples, SAMPLES, k);
}

/* Curves that are also of the kind before: areas and moments, within the bounds of the kind they
 * are given as, of the exact values of what they are. */
static void test_raised(const Api *api, int kind)
{
	enum { SAMPLES = 12 };
	static Sample samples[SAMPLES];
	char what[60];
	long k[CURVE_DEGREE + 1];
	Ref *area = ref_new(1);
	snprintf(what, sizeof what, "%ss given as %ss", curve_names[kind],
		curve_names[kind == CURVE_LINE ? CURVE_QUAD : CURVE_CUBIC]);
	check_begin("areas of %s, %s", what, api->name);
	for (int i = 0; i < SAMPLES; i++) {
		const Curve c = random_raisable(kind), r = raised(&c);
		curve_area(area, &r);
		Ref *other = ref_new(1);
		curve_area(other, &c);
		expect(mpq_equal(area->value, other->value), "the references differ");
		ref_free(other, 1);
		expect_within(area_of(api, &r), area, r.kind == CURVE_QUAD ? 6 : 9, api->bits, 0,
			"area of %s", curve_text(&r));
		sample_init(&samples[i], &r);
	}
	check_end();
	ref_free(area, 1);
	kernel_bounds(k, kind == CURVE_LINE ? CURVE_QUAD : CURVE_CUBIC);
	test_samples(api, what, samples, SAMPLES, k);
}

/* ---- what is refused, and what is no number ---- */

static void test_bad_degree(const Api *api, const char *target)
{
	static const int bad[] = { -1, CURVE_DEGREE + 1, INT_MAX, INT_MIN, -1000, 1000000000 };
	unsigned char room[CURVE_MOMENTS * sizeof(double)];
	check_begin("degree out of range, %s, %s", api->name, target);
	for (int kind = 0; kind < KINDS; kind++) {
		const Curve c = random_curve(api, kinds[kind], UNIFORM);
		for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
			if (kinds[kind] == CURVE_LINE && bad[i] > 0 && bad[i] <= EW_MAX_DEGREE)
				continue;
			memset(room, CANARY, sizeof room);
			expect(moments_of(api, bad[i], &c, room) == EW_BAD_DEGREE,
				"degree %d of a %s is not refused", bad[i],
				curve_names[kinds[kind]]);
			for (size_t j = 0; j < sizeof room; j++)
				expect(room[j] == CANARY, "degree %d writes", bad[i]);
		}
	}
	check_end();
}

static void test_nonfinite(const Api *api, const char *target)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	check_begin("NaN and infinity, %s, %s", api->name, target);
	for (int i = 0; i < 3 * KINDS * 2 * CURVE_POINTS * 4; i++) {
		const int at = i / (3 * KINDS) % (2 * CURVE_POINTS);
		Curve c = random_curve(api, kinds[i / 3 % KINDS], (Class)(i % 4));
		if (at / 2 >= curve_points(c.kind))
			continue;
		(at % 2 ? c.y : c.x)[at / 2] = bad[i % 3];
		expect_nonfinite(api, &c);
	}
	check_end();
}

static void test_target(const Api *api, const char *target)
{
	test_integers(api, target);
	test_areas(api, target);
	test_reversed_areas(api, target);
	test_points(api, target);
	test_bad_degree(api, target);
	test_nonfinite(api, target);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	test_reference();
	for_each_target(test_target);
	for (const Api *api = NULL; (api = next_api(api));) {
		for (int i = 0; i < KINDS; i++)
			test_moments(api, kinds[i]);
		test_raised(api, CURVE_LINE);
		test_raised(api, CURVE_QUAD);
	}
	return check_finish();
}

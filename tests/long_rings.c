/* Long rings: 10^5 vertices at every degree, and 10^7 float vertices up to degree 2.
 *
 * Sums of 10^7 floats lose everything in a single accumulator; the library flushes its lanes to
 * double, so the bound does not grow beyond 64 steps a lane. The bound is only as sharp as W, which
 * for raw moments counts |x0 y1| + |x1 y0|: around a circle in n steps that is about n/10 times
 * what remains after cancelling. So the long ring is also wound 300 000 times, with steps long
 * enough to make the bound bite.
 *
 * Coordinates are integers below 2^22, so the exact sums up to degree 2 fit 128 bits; they come
 * from the textbook formulas, which are themselves compared with the reference on a short ring.
 */
#include "rings.h"

__extension__ typedef __int128 Wide;

enum { LONG = 100000, LONGEST = 10000000, SUMS = 6, KINDS = 2 };

static Ring ring;               /* the ring under test; packed as float */

/* Degree 0..8 at 10^5 vertices. */

static Ref *moments, *area;

static void make_long(void)
{
	ring = ring_new(LONG);
	ring_star(&ring, 100, -50, 600);
	ring_snap(&ring, 0x1p-10);
	moments = ref_new(MOMENTS);
	area = ref_new(1);
	ref_ring(moments, EW_MAX_DEGREE, ring.x, ring.y, ring.n);
	ref_area(area, ring.x, ring.y, ring.n);
}

static void free_long(void)
{
	ring_free(&ring);
	ref_free(moments, MOMENTS);
	ref_free(area, 1);
}

static void expect_moment(const Api *api, const Row *row, int m, int n, double got)
{
	const Ref *want = row->outputs == 1 && m + n == 0 ? area : &moments[ref_index(m, n)];
	expect_within(got, want, ring_k(api, row, ring.n), api->bits, 0, "x%dy%d by %s", m, n,
		row->name);
}

static void test_long(const Api *api, const char *target)
{
	double out[MOMENTS], other[MOMENTS];
	ring_pack(api, &ring);
	check_begin("%d vertices, %s, %s", LONG, api->name, target);
	for (int d = 0; d <= EW_MAX_DEGREE; d++) {
		api->moments(d, ring.px, ring.py, ring.n, out);
		for (int m = 0; m <= d; m++) {
			for (int n = 0; m + n <= d; n++)
				expect_moment(api, find_row("moments", d, 0), m, n,
					get(api, out, ref_index(m, n)));
			expect_moment(api, find_row("monomial", m, d - m), m, d - m,
				api->moment(m, d - m, ring.px, ring.py, ring.n));
		}
		api->xy(d, ring.pxy, ring.n, other);
		expect(memcmp(out, other, (size_t)ref_count(d) * api->size) == 0,
			"interleaved moments of degree %d have other bits", d);
		api->about(d, ring.px, ring.py, ring.n, 0, 0, other);
		expect(memcmp(out, other, (size_t)ref_count(d) * api->size) == 0,
			"moments of degree %d about (0,0) have other bits", d);
	}
	expect_moment(api, find_row("moments", 0, 0), 0, 0, api->area(ring.px, ring.py, ring.n));
	check_end();
}

/* 10^7 vertices. */

typedef struct {
	Wide value[SUMS], weight[SUMS];         /* times the factors below */
} Sums;

static const unsigned long factors[SUMS] = { 2, 6, 6, 12, 24, 12 };

static Wide magnitude(Wide v)
{
	return v < 0 ? -v : v;
}

static void add_edge(Wide *sum, Wide cross, Wide x0, Wide y0, Wide x1, Wide y1)
{
	sum[0] += cross;
	sum[1] += cross * (x0 + x1);
	sum[2] += cross * (y0 + y1);
	sum[3] += cross * (x0 * x0 + x0 * x1 + x1 * x1);
	sum[4] += cross * (2 * x0 * y0 + x0 * y1 + x1 * y0 + 2 * x1 * y1);
	sum[5] += cross * (y0 * y0 + y0 * y1 + y1 * y1);
}

/* Sums about (cx,cy). */
static void set_sums(Sums *s, const Ring *r, double cx, double cy)
{
	memset(s, 0, sizeof *s);
	for (size_t i = 0; i < r->n; i++) {
		const size_t j = i + 1 < r->n ? i + 1 : 0;
		const Wide x0 = (Wide)(r->x[i] - cx), y0 = (Wide)(r->y[i] - cy);
		const Wide x1 = (Wide)(r->x[j] - cx), y1 = (Wide)(r->y[j] - cy);
		add_edge(s->value, x0 * y1 - x1 * y0, x0, y0, x1, y1);
		const Wide a0 = magnitude(x0), b0 = magnitude(y0);
		const Wide a1 = magnitude(x1), b1 = magnitude(y1);
		add_edge(s->weight, a0 * b1 + a1 * b0, a0, b0, a1, b1);
	}
}

static void set_wide(mpq_t out, Wide v, unsigned long divisor)
{
	const Wide size = magnitude(v);
	mpz_set_ui(mpq_numref(out), (unsigned long)(size >> 64));
	mpz_mul_2exp(mpq_numref(out), mpq_numref(out), 64);
	mpz_add_ui(mpq_numref(out), mpq_numref(out), (unsigned long)size);
	if (v < 0)
		mpz_neg(mpq_numref(out), mpq_numref(out));
	mpz_set_ui(mpq_denref(out), divisor);
	mpq_canonicalize(out);
}

static Ref *sums_refs(const Sums *s)
{
	Ref *refs = ref_new(SUMS);
	for (int i = 0; i < SUMS; i++) {
		set_wide(refs[i].value, s->value[i], factors[i]);
		set_wide(refs[i].weight, s->weight[i], factors[i]);
	}
	return refs;
}

/* Turns times around, always with an uneven radius and off the origin. */
static void fill_turns(Ring *r, double turns)
{
	for (size_t i = 0; i < r->n; i++) {
		const double angle = 6.283185307179586 * turns * (double)i / (double)r->n;
		const double radius = 1.2e6 + 4e5 * sin(3 * angle) + random_real(0, 2e5);
		r->x[i] = rint(300000 + radius * cos(angle));
		r->y[i] = rint(-500000 + radius * sin(angle));
	}
}

static const struct {
	const char *name;
	double turns;
} kinds[KINDS] = { { "once around", 1 }, { "300000 times around", 300000 } };

static int kind;
static Ref *raw, *local, *vertex;       /* about the origin, about the first vertex, vertex form */

/* The textbook formulas against the reference. */
static void test_sums(void)
{
	Sums s;
	Ring brief = ring_new(500);
	Ref *want = ref_new(SUMS);
	check_begin("exact sums, %s", kinds[kind].name);
	fill_turns(&brief, kinds[kind].turns / 20000);
	set_sums(&s, &brief, 0, 0);
	Ref *got = sums_refs(&s);
	ref_ring(want, 2, brief.x, brief.y, brief.n);
	for (int i = 0; i < SUMS; i++)
		expect(mpq_equal(got[i].value, want[i].value)
				&& mpq_equal(got[i].weight, want[i].weight),
			"moment %d is %g, reference %g", i, mpq_get_d(got[i].value),
			mpq_get_d(want[i].value));
	check_end();
	ring_free(&brief);
	ref_free(got, SUMS);
	ref_free(want, SUMS);
}

static void make_longest(void)
{
	Sums s;
	fill_turns(&ring, kinds[kind].turns);
	set_sums(&s, &ring, 0, 0);
	raw = sums_refs(&s);
	set_sums(&s, &ring, ring.x[0], ring.y[0]);
	local = sums_refs(&s);
	vertex = ref_new(1);
	mpq_set(vertex->value, raw->value);
	Wide weight = 0;
	for (size_t i = 1; i < ring.n; i++) {
		const double next = ring.y[i + 1 < ring.n ? i + 1 : 0];
		weight += (Wide)fabs(ring.x[i] - ring.x[0]) * (Wide)fabs(next - ring.y[i - 1]);
	}
	set_wide(vertex->weight, weight, 2);
}

static void free_longest(void)
{
	ref_free(raw, SUMS);
	ref_free(local, SUMS);
	ref_free(vertex, 1);
}

/* (g W_m + |c| g W_0) / (|A| - g W_0), as in central.c */
static void expect_centroid(const Api *api)
{
	double c[2];
	const double g = (double)ring_k(api, find_row("moments", 1, 0), ring.n) * 0x1.0001p-24;
	const double weight = g * mpq_get_d(local[0].weight), size = mpq_get_d(local[0].value);
	if (fabs(size) < 16 * weight)
		return;
	expect(api->centroid(ring.px, ring.py, ring.n, c) == EW_OK, "no EW_OK from centroid");
	for (int axis = 0; axis < 2; axis++) {
		const double mean = mpq_get_d(local[1 + axis].value) / size;
		const double want = mean + (axis ? ring.y[0] : ring.x[0]);
		const double bound = (g * mpq_get_d(local[1 + axis].weight) + fabs(mean) * weight)
			/ (fabs(size) - weight) + 0x1p-22 * (fabs(mean) + fabs(want));
		expect(fabs(get(api, c, axis) - want) <= bound,
			"centroid[%d] is %.9g, exact %.9g, allowed %g", axis, get(api, c, axis),
			want, bound);
	}
}

static void test_longest(const Api *api, const char *target)
{
	float out[SUMS], other[SUMS];
	if (api->bits != 24)
		return;
	ring_pack(api, &ring);
	check_begin("%d float vertices, %s, %s", LONGEST, kinds[kind].name, target);
	expect_within(api->area(ring.px, ring.py, ring.n), vertex,
		ring_k(api, find_row("moments", 0, 0), ring.n), 24, 0, "area");
	for (int d = 0; d <= 2; d++) {
		const long k = ring_k(api, find_row("moments", d, 0), ring.n);
		api->moments(d, ring.px, ring.py, ring.n, out);
		api->xy(d, ring.pxy, ring.n, other);
		for (int i = 0; i < ref_count(d); i++) {
			expect_within((double)out[i], d ? &raw[i] : vertex, k, 24, 0,
				"degree %d, moment %d", d, i);
			expect(out[i] == other[i], "degree %d: interleaved moment %d is another", d,
				i);
		}
		for (int n = 0; n <= d; n++)
			expect_within(api->moment(d - n, n, ring.px, ring.py, ring.n),
				d ? &raw[ref_index(d - n, n)] : vertex,
				ring_k(api, find_row("monomial", d - n, n), ring.n), 24, 0,
				"x%dy%d", d - n, n);
	}
	expect_centroid(api);
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	make_long();
	for_each_target(test_long);
	free_long();
	ring = ring_of_size(LONGEST, sizeof(float));
	for (kind = 0; kind < KINDS; kind++) {
		test_sums();
		make_longest();
		for_each_target(test_longest);
		free_longest();
	}
	ring_free(&ring);
	return check_finish();
}

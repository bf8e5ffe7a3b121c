/* Raw moments of rings against exact rationals, for every row of the ring list, in both precisions
 * and under every target.
 *
 * A set of cases (kinds of rings, each with n = 0..40) is drawn once per precision and its exact
 * moments are computed once; every function is then held against them with the bound of its row,
 *
 *     gamma_K sum W,   K = k + r (items per lane and turn - 1) + reduction   (ring_k in rings.h).
 *
 * Besides the bounds: moments about (0,0) and of interleaved coordinates have the bits of the plain
 * ones, moments about a centre the bits of the ring that was moved beforehand; repeated and closing
 * vertices change nothing; rings of no area and sizes of 1e30 and 1e-30 come out as they must.
 * Magnitudes are tested in bounded.c, the area in twice the precision in compensated.c.
 */
#include "rings.h"

enum { LARGEST = 40, DEGREES = EW_MAX_DEGREE + 1 };

typedef struct {
	const char *kind;
	Ring ring;
	Ref *moments;   /* MOMENTS of them */
	Ref *area;
} Case;

/* Kinds of rings. */

static void fill_random(Ring *ring, const Api *api)
{
	(void)api;
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = random_real(-1, 1);
		ring->y[i] = random_real(-1, 1);
	}
}

static void fill_star(Ring *ring, const Api *api)
{
	(void)api;
	ring_star_near(ring, 1, 1);
}

static void fill_clockwise(Ring *ring, const Api *api)
{
	fill_star(ring, api);
	for (size_t i = 0; 2 * i + 1 < ring->n; i++) {
		const size_t j = ring->n - 1 - i;
		const double x = ring->x[i], y = ring->y[i];
		ring->x[i] = ring->x[j];
		ring->y[i] = ring->y[j];
		ring->x[j] = x;
		ring->y[j] = y;
	}
}

static void fill_integers(Ring *ring, const Api *api)
{
	(void)api;
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = random_int(-9, 9);
		ring->y[i] = random_int(-9, 9);
	}
}

/* 2^+-20; what degree 8 leaves to float is 2^+-8 */
static void fill_mixed(Ring *ring, const Api *api)
{
	const int top = api->bits == 24 ? 8 : 20;
	ring_scaled(ring, -top, top);
}

/* Collinear, exactly so in the numbers that are passed, and far from exact in the products. */
static void fill_collinear(Ring *ring, const Api *api)
{
	(void)api;
	const int dx = random_int(-9, 9), dy = random_int(-9, 9);
	for (size_t i = 0; i < ring->n; i++) {
		const double t = random_int(-99999, 99999) * 0x1p-16;
		ring->x[i] = dx * t + 1.25;
		ring->y[i] = dy * t - 3.5;
	}
}

static void fill_repeated(Ring *ring, const Api *api)
{
	fill_star(ring, api);
	for (size_t i = 1; i < ring->n; i++) {
		if (random_int(0, 2) == 0) {
			ring->x[i] = ring->x[i - 1];
			ring->y[i] = ring->y[i - 1];
		}
	}
}

static void fill_far(Ring *ring, const Api *api)
{
	if (api->bits == 24)
		ring_star(ring, 300, -700, 1);
	else
		ring_star(ring, 5e5, 4e6, 10);
}

static const struct {
	const char *name;
	void (*fill)(Ring *ring, const Api *api);
} kinds[] = {
	{ "random", fill_random }, { "star", fill_star }, { "clockwise", fill_clockwise },
	{ "integer", fill_integers }, { "mixed", fill_mixed }, { "collinear", fill_collinear },
	{ "repeating", fill_repeated }, { "far", fill_far },
};

enum { KINDS = sizeof kinds / sizeof *kinds, CASES = KINDS * (LARGEST + 1) };

static Case cases[APIS][CASES];

static void make_case(Case *c, const Api *api, int kind, int n)
{
	c->kind = kinds[kind].name;
	c->ring = ring_new((size_t)n);
	kinds[kind].fill(&c->ring, api);
	ring_pack(api, &c->ring);
	c->moments = ref_new(MOMENTS);
	c->area = ref_new(1);
	ref_ring(c->moments, EW_MAX_DEGREE, c->ring.x, c->ring.y, c->ring.n);
	ref_area(c->area, c->ring.x, c->ring.y, c->ring.n);
}

/* Draws all cases, and checks the two references against each other on the way. */
static void make_cases(void)
{
	check_begin("cases");
	for (int a = 0; a < APIS; a++) {
		for (int i = 0; i < CASES; i++) {
			Case *c = &cases[a][i];
			make_case(c, &apis[a], i % KINDS, i / KINDS);
			expect(mpq_equal(c->moments->value, c->area->value),
				"two areas of a %s ring of %zu", c->kind, c->ring.n);
			if (c->ring.n < 3 || strcmp(c->kind, "collinear") == 0)
				expect(mpq_sgn(c->area->value) == 0, "area of a %s ring", c->kind);
			if (c->ring.n >= 3 && strcmp(c->kind, "star") == 0)
				expect(mpq_sgn(c->area->value) > 0,
					"area of a star is not positive");
			if (c->ring.n >= 3 && strcmp(c->kind, "clockwise") == 0)
				expect(mpq_sgn(c->area->value) < 0,
					"area of a clockwise star is not negative");
		}
	}
	check_end();
}

static void free_cases(void)
{
	for (int i = 0; i < APIS * CASES; i++) {
		Case *c = &cases[0][0] + i;
		ring_free(&c->ring);
		ref_free(c->moments, MOMENTS);
		ref_free(c->area, 1);
	}
}

/* One computed moment of x^m y^n from the kernel of this row. Degree 0 is the area. */
static bool moment_within(const Api *api, const Row *row, const Ring *ring, const Ref *moments,
	const Ref *area, int m, int n, double got, const char *what)
{
	const long k = ring_k(api, row, ring_count(ring));
	const bool is_area = row->outputs == 1 && m + n == 0;
	return expect_within(got, is_area ? area : &moments[ref_index(m, n)], k, api->bits,
		ref_tiny(k, m + n, api->bits, ring->x, ring->y, ring->n),
		"%s: x%dy%d by %s of n = %zu", what, m, n, row->name, ring->n);
}

static bool moments_within(const Api *api, int degree, const Ring *ring, const Ref *moments,
	const Ref *area, const void *out, const char *what)
{
	const Row *row = find_row("moments", degree, 0);
	bool ok = true;
	for (int m = 0; m <= degree; m++) {
		for (int n = 0; m + n <= degree; n++)
			ok &= moment_within(api, row, ring, moments, area, m, n,
				get(api, out, ref_index(m, n)), what);
	}
	return ok;
}

static void expect_same(const Api *api, const void *a, const void *b, int count, const char *what,
	size_t n)
{
	for (int i = 0; i < count; i++) {
		expect(same_bits(get(api, a, i), get(api, b, i)),
			"%s, n = %zu: moment %d is %a, was %a", what, n, i, get(api, b, i),
			get(api, a, i));
	}
}

static const Case *cases_of(const Api *api)
{
	return cases[api - apis];
}

static void test_moments(const Api *api, const char *target)
{
	double out[MOMENTS], other[MOMENTS];
	check_begin("ew_moments, %s, %s", api->name, target);
	for (int i = 0; i < CASES; i++) {
		const Case *c = &cases_of(api)[i];
		const Ring *ring = &c->ring;
		for (int d = 0; d <= EW_MAX_DEGREE; d++) {
			expect(api->moments(d, ring->px, ring->py, ring->n, out) == EW_OK,
				"no EW_OK");
			moments_within(api, d, ring, c->moments, c->area, out, c->kind);
			expect(api->xy(d, ring->pxy, ring->n, other) == EW_OK, "no EW_OK from xy");
			expect_same(api, out, other, ref_count(d), "interleaved", ring->n);
			expect(api->about(d, ring->px, ring->py, ring->n, 0, 0, other) == EW_OK,
				"no EW_OK from about");
			expect_same(api, out, other, ref_count(d), "about (0,0)", ring->n);
		}
	}
	check_end();
}

static void test_monomials(const Api *api, const char *target)
{
	check_begin("ew_moment and ew_area, %s, %s", api->name, target);
	for (int i = 0; i < CASES; i++) {
		const Case *c = &cases_of(api)[i];
		const Ring *ring = &c->ring;
		for (int m = 0; m <= EW_MAX_DEGREE; m++) {
			for (int n = 0; m + n <= EW_MAX_DEGREE; n++)
				moment_within(api, find_row("monomial", m, n), ring, c->moments,
					c->area, m, n,
					api->moment(m, n, ring->px, ring->py, ring->n), c->kind);
		}
		moment_within(api, find_row("moments", 0, 0), ring, c->moments, c->area, 0, 0,
			api->area(ring->px, ring->py, ring->n), c->kind);
	}
	check_end();
}

/* The ring moved by (-cx,-cy), every coordinate rounded once: for floats, rounding the difference
 * to double first changes nothing. */
static Ring moved_ring(const Api *api, const Ring *ring, double cx, double cy)
{
	Ring moved = ring_new(ring->n);
	for (size_t i = 0; i < ring->n; i++) {
		moved.x[i] = ring->x[i] - cx;
		moved.y[i] = ring->y[i] - cy;
	}
	ring_pack(api, &moved);
	return moved;
}

static void test_about(const Api *api, const char *target)
{
	double out[MOMENTS], want[MOMENTS];
	Ref *moments = ref_new(MOMENTS), *area = ref_new(1);
	check_begin("ew_moments_about, %s, %s", api->name, target);
	for (int i = 0; i < CASES; i++) {
		const Ring *ring = &cases_of(api)[i].ring;
		const double cx = round_to(api->bits, random_real(-2, 2));
		const double cy = round_to(api->bits, random_real(-2, 2));
		Ring moved = moved_ring(api, ring, cx, cy);
		ref_ring(moments, EW_MAX_DEGREE, moved.x, moved.y, moved.n);
		ref_area(area, moved.x, moved.y, moved.n);
		for (int d = 0; d <= EW_MAX_DEGREE; d++) {
			expect(api->about(d, ring->px, ring->py, ring->n, cx, cy, out) == EW_OK,
				"no EW_OK");
			moments_within(api, d, &moved, moments, area, out, "about a centre");
			api->moments(d, moved.px, moved.py, moved.n, want);
			expect_same(api, want, out, ref_count(d), "about a centre", ring->n);
		}
		ring_free(&moved);
	}
	check_end();
	ref_free(moments, MOMENTS);
	ref_free(area, 1);
}

/* Rings with holes. */

static Ring polygon(const Api *api, size_t n, const double *x, const double *y)
{
	Ring ring = ring_new(n);
	memcpy(ring.x, x, n * sizeof *x);
	memcpy(ring.y, y, n * sizeof *y);
	ring_pack(api, &ring);
	return ring;
}

/* integral over [0,9]x[0,8] minus [2,5]x[1,7] */
static void set_holed(mpq_t out, int m, int n)
{
	const unsigned long outer = (unsigned long)(pow(9, m + 1) * pow(8, n + 1));
	const unsigned long hole = (unsigned long)((pow(5, m + 1) - pow(2, m + 1))
		* (pow(7, n + 1) - 1));
	mpq_set_ui(out, outer - hole, (unsigned long)((m + 1) * (n + 1)));
	mpq_canonicalize(out);
}

/* A square with a square hole, as two rings and as one ring with a bridge. */
static void test_holes(const Api *api, const char *target)
{
	Ring outer = polygon(api, 4, (double[]){ 0, 9, 9, 0 }, (double[]){ 0, 0, 8, 8 });
	Ring hole = polygon(api, 4, (double[]){ 2, 2, 5, 5 }, (double[]){ 1, 7, 7, 1 });
	Ring bridged = polygon(api, 10, (double[]){ 0, 9, 9, 0, 0, 2, 2, 5, 5, 2 },
		(double[]){ 0, 0, 8, 8, 0, 1, 7, 7, 1, 1 });
	const Row *row = find_row("moments", EW_MAX_DEGREE, 0);
	double a[MOMENTS], b[MOMENTS], c[MOMENTS];
	Ref *sum = ref_new(MOMENTS), *part = ref_new(MOMENTS), *whole = ref_new(MOMENTS);
	mpq_t want;
	mpq_init(want);
	check_begin("holes, %s, %s", api->name, target);
	ref_ring(sum, EW_MAX_DEGREE, outer.x, outer.y, outer.n);
	ref_ring(part, EW_MAX_DEGREE, hole.x, hole.y, hole.n);
	ref_ring(whole, EW_MAX_DEGREE, bridged.x, bridged.y, bridged.n);
	api->moments(EW_MAX_DEGREE, outer.px, outer.py, outer.n, a);
	api->moments(EW_MAX_DEGREE, hole.px, hole.py, hole.n, b);
	api->moments(EW_MAX_DEGREE, bridged.px, bridged.py, bridged.n, c);
	for (int i = 0; i < MOMENTS; i++) {
		mpq_add(sum[i].value, sum[i].value, part[i].value);
		mpq_add(sum[i].weight, sum[i].weight, part[i].weight);
		expect_within(get(api, a, i) + get(api, b, i), &sum[i], ring_k(api, row, 4) + 1,
			api->bits, 0, "moment %d of two rings", i);
		expect_within(get(api, c, i), &whole[i], ring_k(api, row, 10), api->bits, 0,
			"moment %d of the bridged ring", i);
	}
	for (int m = 0; m <= EW_MAX_DEGREE; m++) {
		for (int n = 0; m + n <= EW_MAX_DEGREE; n++) {
			set_holed(want, m, n);
			expect(mpq_equal(sum[ref_index(m, n)].value, want),
				"exact x%dy%d of two rings", m, n);
			expect(mpq_equal(whole[ref_index(m, n)].value, want),
				"exact x%dy%d, bridged", m, n);
		}
	}
	expect(api->area(outer.px, outer.py, 4) == 72 && api->area(hole.px, hole.py, 4) == -18
		&& api->area(bridged.px, bridged.py, 10) == 54, "areas are not exact");
	check_end();
	mpq_clear(want);
	ring_free(&outer);
	ring_free(&hole);
	ring_free(&bridged);
	ref_free(sum, MOMENTS);
	ref_free(part, MOMENTS);
	ref_free(whole, MOMENTS);
}

/* Everything but the central moments as one list of numbers, in three groups: the vertex form, what
 * is summed over edges for all moments at once, and single monomials. */

enum {
	FROM_VERTICES,
	FROM_EDGES = 3,
	OF_DEGREES = (EW_MAX_DEGREE + 1) * (EW_MAX_DEGREE + 2) * (EW_MAX_DEGREE + 3) / 6 - 1,
	FROM_MONOMIALS = FROM_EDGES + 2 + OF_DEGREES + 2 * MOMENTS,
	RESULTS = FROM_MONOMIALS + MOMENTS - 1
};

static int add_moments(const Api *api, const double *typed, int count, double *out, int at)
{
	for (int i = 0; i < count; i++)
		out[at++] = get(api, typed, i);
	return at;
}

static void all_results(const Api *api, const Ring *ring, double out[RESULTS])
{
	double typed[MOMENTS];
	api->moments(0, ring->px, ring->py, ring->n, typed);
	out[0] = get(api, typed, 0);
	out[1] = api->area(ring->px, ring->py, ring->n);
	out[2] = api->moment(0, 0, ring->px, ring->py, ring->n);
	api->centroid(ring->px, ring->py, ring->n, typed);
	int at = add_moments(api, typed, 2, out, FROM_EDGES);
	for (int d = 1; d <= EW_MAX_DEGREE; d++) {
		api->moments(d, ring->px, ring->py, ring->n, typed);
		at = add_moments(api, typed, ref_count(d), out, at);
	}
	api->about(EW_MAX_DEGREE, ring->px, ring->py, ring->n, 1, -1, typed);
	at = add_moments(api, typed, MOMENTS, out, at);
	api->xy(EW_MAX_DEGREE, ring->pxy, ring->n, typed);
	at = add_moments(api, typed, MOMENTS, out, at);
	for (int d = 1; d <= EW_MAX_DEGREE; d++) {
		for (int n = 0; n <= d; n++)
			out[at++] = api->moment(d - n, n, ring->px, ring->py, ring->n);
	}
	if (at != RESULTS)
		abort();
}

/* Results from .. to-1 have the same bits. */
static void expect_same_results(const Api *api, const Ring *before, const Ring *after, int from,
	int to, const char *what)
{
	double a[RESULTS], b[RESULTS];
	all_results(api, before, a);
	all_results(api, after, b);
	for (int i = from; i < to; i++) {
		const bool both_nan = isnan(a[i]) && isnan(b[i]);
		expect(both_nan || same_bits(a[i], b[i]), "%s, n = %zu: result %d is %a, was %a",
			what, before->n, i, b[i], a[i]);
	}
}

static void expect_same_central(const Api *api, const Ring *before, const Ring *after)
{
	double a[MOMENTS], b[MOMENTS], c[2], d[2];
	const int first = api->central(EW_MAX_DEGREE, before->px, before->py, before->n, c, a);
	const int second = api->central(EW_MAX_DEGREE, after->px, after->py, after->n, d, b);
	expect(first == second, "central moments return %d, before %d", second, first);
	if (first != EW_OK)
		return;
	expect_same(api, c, d, 2, "centre", before->n);
	expect_same(api, a, b, MOMENTS, "central", before->n);
}

/* The ring with copies(i) of its vertex i, and of vertex 0 once more at the end if closed. */
static Ring with_copies(const Api *api, const Ring *ring, const int *copies, bool closed)
{
	size_t n = closed;
	for (size_t i = 0; i < ring->n; i++)
		n += (size_t)copies[i];
	Ring more = ring_new(n);
	size_t at = 0;
	for (size_t i = 0; i < ring->n; i++) {
		for (int j = 0; j < copies[i]; j++) {
			more.x[at] = ring->x[i];
			more.y[at++] = ring->y[i];
		}
	}
	if (closed) {
		more.x[at] = ring->x[0];
		more.y[at] = ring->y[0];
	}
	ring_pack(api, &more);
	return more;
}

/* Integers so small that every sum is exact, in whichever lane it is made. (Kernels of one monomial
 * may multiply by rounded constants on the way.) */
static void test_repeated(const Api *api, const char *target)
{
	const int most = api->bits == 24 ? 1 : 4;
	int copies[LARGEST];
	check_begin("repeated vertices, %s, %s", api->name, target);
	for (int i = 0; i < 600; i++) {
		Ring ring = ring_new((size_t)i % 24 + 3);
		for (size_t j = 0; j < ring.n; j++) {
			ring.x[j] = random_int(-most, most);
			ring.y[j] = random_int(-most, most);
			copies[j] = random_int(1, 2);
		}
		ring_pack(api, &ring);
		Ring more = with_copies(api, &ring, copies, i % 2);
		expect_same_results(
			api, &ring, &more, FROM_VERTICES, FROM_MONOMIALS, "repeated vertices");
		ring_free(&ring);
		ring_free(&more);
	}
	check_end();
}

/* Any coordinates: as many copies as there are lanes (one, as long as the ring is short) leave
 * every other edge in its lane and in its place, and each adds 0. (The vertex form has no edges to
 * repeat.) */
static void test_repeated_by_lanes(const Api *api, const char *target)
{
	const int lanes = api->bits == 24 ? 16 : 8;
	int copies[LARGEST];
	check_begin("vertices repeated by lanes, %s, %s", api->name, target);
	for (int i = 0; i < CASES; i++) {
		const Ring *ring = &cases_of(api)[i].ring;
		if (ring->n < 3)
			continue;
		size_t n = ring->n;
		for (size_t j = 0; j < ring->n; j++) {
			copies[j] = random_int(0, 4) ? 1 : 1 + (ring->n < SHORT ? 1 : lanes);
			if (ring->n < SHORT && n + 1 == SHORT)
				copies[j] = 1;
			n += (size_t)copies[j] - 1;
		}
		Ring more = with_copies(api, ring, copies, false);
		expect_same_results(api, ring, &more, FROM_EDGES, RESULTS, cases_of(api)[i].kind);
		expect_same_central(api, ring, &more);
		ring_free(&more);
	}
	check_end();
}

/* The closing vertex comes last, so it moves no other into another lane, and it adds 0: no bit
 * changes. Only a ring of two is 0 by decree and not once it counts three vertices. */
static void test_closed(const Api *api, const char *target)
{
	int once[LARGEST];
	for (int i = 0; i < LARGEST; i++)
		once[i] = 1;
	check_begin("explicitly closed, %s, %s", api->name, target);
	for (int i = 0; i < CASES; i++) {
		const Ring *ring = &cases_of(api)[i].ring;
		if (ring->n == 0 || ring->n == 2)
			continue;
		Ring closed = with_copies(api, ring, once, true);
		expect_same_results(
			api, ring, &closed, FROM_VERTICES, RESULTS, cases_of(api)[i].kind);
		expect_same_central(api, ring, &closed);
		ring_free(&closed);
	}
	check_end();
}

static void expect_no_centroid(const Api *api, const Ring *ring, const char *what)
{
	double out[MOMENTS], c[2] = { 0, 0 };
	expect(api->area(ring->px, ring->py, ring->n) == 0, "%s, n = %zu: area is not 0", what,
		ring->n);
	expect(api->centroid(ring->px, ring->py, ring->n, c) == EW_ZERO_AREA,
		"%s, n = %zu: centroid exists", what, ring->n);
	expect(isnan(get(api, c, 0)) && isnan(get(api, c, 1)), "%s: centroid is no NaN", what);
	memset(c, 0, sizeof c);
	expect(api->central(2, ring->px, ring->py, ring->n, c, out) == EW_ZERO_AREA,
		"%s, n = %zu: central moments exist", what, ring->n);
	expect(isnan(get(api, c, 0)) && isnan(get(api, c, 1)), "%s: centre is no NaN", what);
	for (int i = 0; i < ref_count(2); i++)
		expect(isnan(get(api, out, i)), "%s: central moment %d is no NaN", what, i);
}

static void expect_nothing(const Api *api, const Ring *ring, const char *what)
{
	double out[RESULTS];
	all_results(api, ring, out);
	for (int i = 0; i < RESULTS; i++) {
		const bool is_centroid = i == FROM_EDGES || i == FROM_EDGES + 1;
		expect(is_centroid ? isnan(out[i]) : out[i] == 0, "%s, n = %zu: result %d is %a",
			what, ring->n, i, out[i]);
	}
	expect_no_centroid(api, ring, what);
}

/* All vertices equal, at most two of them, none at all: exactly 0, and no centroid. Collinear: no
 * centroid as far as the sums are exact. */
static void test_nothing(const Api *api, const char *target)
{
	const double wide[] = { 1, 5e5, 1e-30, 1e28 }, narrow[] = { 1, 30, 1e-3, 500 };
	check_begin("no area, %s, %s", api->name, target);
	for (int i = 0; i < 4 * (LARGEST + 1); i++) {
		const double scale = api->bits == 24 ? narrow[i % 4] : wide[i % 4];
		Ring ring = ring_new((size_t)i / 4);
		for (size_t j = 0; j < ring.n; j++) {
			const bool repeat = j > 0 && ring.n > 2;
			ring.x[j] = repeat ? ring.x[0] : scale * random_real(-1, 1);
			ring.y[j] = repeat ? ring.y[0] : scale * random_real(-1, 1);
		}
		ring_pack(api, &ring);
		expect_nothing(api, &ring, ring.n > 2 ? "equal vertices" : "few vertices");
		ring_free(&ring);
	}
	for (int i = 0; i < 200; i++) {
		const int dx = random_int(-1, 1), dy = random_int(-1, 1);
		Ring ring = ring_new((size_t)i % 20 + 3);
		for (size_t j = 0; j < ring.n; j++) {
			const int t = random_int(-2, 2);
			ring.x[j] = 1 + dx * t;
			ring.y[j] = dy * t;
		}
		ring_pack(api, &ring);
		expect_no_centroid(api, &ring, "collinear integers");
		ring_free(&ring);
	}
	double out[MOMENTS];
	expect(api->moments(EW_MAX_DEGREE, NULL, NULL, 0, out) == EW_OK, "a null ring is refused");
	expect(get(api, out, 0) == 0 && get(api, out, MOMENTS - 1) == 0, "a null ring has moments");
	expect(api->area(NULL, NULL, 0) == 0, "a null ring has an area");
	check_end();
}

/* 1e30 and 1e-30, float at the powers of ten that its range leaves to the degree. */
static void test_extremes(const Api *api, const char *target)
{
	double out[MOMENTS];
	Ref *moments = ref_new(MOMENTS), *area = ref_new(1);
	check_begin("largest and smallest, %s, %s", api->name, target);
	for (int i = 0; i < 2 * DEGREES * LARGEST; i++) {
		const int d = i / 2 % DEGREES;
		const double scale =
			i % 2 ? large_scale(d, api->bits, LARGEST) : small_scale(d, api->bits);
		Ring ring = ring_new((size_t)(i / (2 * DEGREES)) + 1);
		for (size_t j = 0; j < ring.n; j++) {
			ring.x[j] = random_sized(scale);
			ring.y[j] = random_sized(scale);
		}
		ring_pack(api, &ring);
		ref_ring(moments, d, ring.x, ring.y, ring.n);
		ref_area(area, ring.x, ring.y, ring.n);
		api->moments(d, ring.px, ring.py, ring.n, out);
		moments_within(api, d, &ring, moments, area, out, i % 2 ? "large" : "small");
		for (int n = 0; n <= d; n++)
			moment_within(api, find_row("monomial", d - n, n), &ring, moments, area,
				d - n, n, api->moment(d - n, n, ring.px, ring.py, ring.n),
				i % 2 ? "large" : "small");
		ring_free(&ring);
	}
	check_end();
	ref_free(moments, MOMENTS);
	ref_free(area, 1);
}

static bool is_known(const char *family)
{
	static const char *const known[] = {
		"moments", "monomial", "magnitudes", "compensated",
		"line", "quad", "conic", "cubic",      /* curves.c, conics.c, paths.c */
		"radius", "closure",                   /* distance.c, closure.c */
		"coverage", "filter",                  /* windows.c, filters.c */
	};
	for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
		if (strcmp(family, known[i]) == 0)
			return true;
	}
	return false;
}

/* The list: all families up to the degree, all monomials, and nothing these tests do not know. */
static void test_list(void)
{
	check_begin("list of ring kernels");
	for (int d = 0; d <= EW_MAX_DEGREE; d++) {
		expect(find_row("moments", d, 0)->outputs == ref_count(d)
				&& find_row("magnitudes", d, 0)->outputs == ref_count(d),
			"outputs of degree %d", d);
		for (int n = 0; n <= d; n++)
			expect(find_row("monomial", d - n, n)->outputs == 1, "outputs of x%dy%d",
				d - n, n);
	}
	for (int i = 0; i < ROWS; i++) {
		const Row *row = &ring_rows[i];
		const bool known = is_known(row->family);
		const bool bounded = strcmp(row->family, "compensated") != 0;
		const bool by_name = strcmp(row->family, "filter") == 0;
		expect(known, "no test knows the family %s of %s", row->family, row->name);
		expect(!known || by_name || find_row(row->family, row->m, row->n) == row,
			"%s is listed twice", row->name);
		expect(row->accumulators >= row->outputs && (row->k > 0) == bounded
			&& (row->r > 0) == bounded, "row of %s", row->name);
	}
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	test_list();
	make_cases();
	for_each_target(test_moments);
	for_each_target(test_monomials);
	for_each_target(test_about);
	for_each_target(test_holes);
	for_each_target(test_repeated);
	for_each_target(test_repeated_by_lanes);
	for_each_target(test_closed);
	for_each_target(test_nothing);
	for_each_target(test_extremes);
	free_cases();
	return check_finish();
}

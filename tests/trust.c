/* Results that say how far off they can be, and the area in twice the precision.
 *
 *     trust [SEED [ROUNDS]]       ROUNDS times as many rings, 1 by default
 *
 * ew_moments_bounded gives the bits of ew_moments, and |out - exact| <= bound holds against exact
 * rationals, for every degree, target and precision, on ordinary and on hostile rings: about ten
 * million results per run. On ordinary rings the bound is on average at most 50 times the worst
 * error found for the same output. A result that is not finite has an infinite bound.
 *
 * ew_area_compensated is one of the two numbers around the exact area (that one, if there is such
 * a number) while the condition sum |terms| / |2 area| stays below 2^52 / (4 n^2), for float 2^23.
 * Rings of a wanted condition come about by solving for the last ordinate.
 */
#include "rings.h"

enum { TARGETS = 8 };

/* The targets of this machine. */
static unsigned target_bit[TARGETS];
static int target_count;

static void list_targets(void)
{
	for (unsigned bit = 1; bit && target_count < TARGETS; bit <<= 1) {
		if (ew_targets() & bit)
			target_bit[target_count++] = bit;
	}
}

static int bounded(const Api *api, int degree, const Ring *ring, void *out, void *bound)
{
	return api->bits == 24
		? ew_moments_boundedf(degree, ring->px, ring->py, ring->n, out, bound)
		: ew_moments_bounded(degree, ring->px, ring->py, ring->n, out, bound);
}

static double compensated(const Api *api, const Ring *ring)
{
	return api->bits == 24 ? (double)ew_area_compensatedf(ring->px, ring->py, ring->n)
		: ew_area_compensated(ring->px, ring->py, ring->n);
}

/* |out - exact| <= bound. */

static long results, rings;     /* held against exact values so far, with finite bounds */

typedef double Ratios[EW_MAX_DEGREE + 1][MOMENTS];      /* worst error / bound */

static double error_ratio(double out, double bound, const Ref *exact)
{
	mpq_t off, most;
	mpq_inits(off, most, NULL);
	mpq_set_d(off, out);
	mpq_sub(off, off, exact->value);
	mpq_abs(off, off);
	mpq_set_d(most, bound);
	double ratio = mpq_sgn(off) ? HUGE_VAL : 0;
	if (mpq_sgn(most)) {
		const bool more = mpq_cmp(off, most) > 0;
		mpq_div(off, off, most);
		ratio = mpq_get_d(off);
		if (more && ratio <= 1)         /* mpq_get_d truncates */
			ratio = nextafter(1, 2);
	}
	mpq_clears(off, most, NULL);
	return ratio;
}

static void expect_bound(const Ring *ring, int degree, int j, double out, double bound,
	const Ref *exact, double *worst)
{
	if (!expect(bound >= 0, "n = %zu, degree %d, result %d: bound %g", ring->n, degree, j,
			bound))
		return;
	if (isinf(bound))
		return;
	results++;
	if (!expect(isfinite(out), "n = %zu, degree %d, result %d is %g within %g", ring->n, degree,
			j, out, bound))
		return;
	const double ratio = error_ratio(out, bound, exact);
	expect(ratio <= 1, "n = %zu, degree %d, result %d: %a is off by %.17g of its bound %g, "
		"exact %.17g", ring->n, degree, j, out, ratio, bound, mpq_get_d(exact->value));
	*worst = fmax(*worst, ratio);
}

/* One degree on all targets; those that give the same bits are held against exact values once. */
static void expect_degree(const Api *api, const Ring *ring, int degree, const Ref *exact,
	Ratios worst)
{
	double out[MOMENTS], bound[MOMENTS], plain[MOMENTS], last[2][MOMENTS];
	const size_t bytes = (size_t)ref_count(degree) * api->size;
	for (int t = 0; t < target_count; t++) {
		ew_use_target(target_bit[t]);
		expect(bounded(api, degree, ring, out, bound) == EW_OK, "degree %d is refused",
			degree);
		api->moments(degree, ring->px, ring->py, ring->n, plain);
		expect(memcmp(out, plain, bytes) == 0, "n = %zu, degree %d, %s: other bits than "
			"ew_moments", ring->n, degree, ew_target_name(target_bit[t]));
		if (t && memcmp(out, last[0], bytes) == 0 && memcmp(bound, last[1], bytes) == 0)
			continue;
		for (int j = 0; j < ref_count(degree); j++)
			expect_bound(ring, degree, j, get(api, out, j), get(api, bound, j),
				&exact[j], &worst[degree][j]);
		memcpy(last[0], out, bytes);
		memcpy(last[1], bound, bytes);
	}
	ew_use_target(0);
}

static void expect_ring(const Api *api, Ring *ring, int degree, Ratios worst)
{
	Ref *exact = ref_new(MOMENTS);
	ring_pack(api, ring);
	ref_ring(exact, degree, ring->x, ring->y, ring->n);
	for (int d = 0; d <= degree; d++)
		expect_degree(api, ring, d, exact, worst);
	rings++;
	ref_free(exact, MOMENTS);
}

/* Rings. Each kind fills n vertices; hostile ones may choose their scale by the degree. */

typedef void Fill(const Api *api, Ring *ring, int degree);

static void fill_scaled(Ring *ring, int low, int high)
{
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = random_scaled(low, high);
		ring->y[i] = random_scaled(low, high);
	}
}

static void fill_star(const Api *api, Ring *ring, int degree)
{
	(void)api, (void)degree;
	ring_star_near(ring, 2, 1);
}

static void fill_cloud(const Api *api, Ring *ring, int degree)
{
	(void)api, (void)degree;
	fill_scaled(ring, 0, 0);
}

static void fill_far(const Api *api, Ring *ring, int degree)
{
	(void)api, (void)degree;
	ring_star_near(ring, pow(10, random_real(1, 9)), 1);
}

/* Along a line, off it by a random power of two. */
static void fill_sliver(const Api *api, Ring *ring, int degree)
{
	const double ax = random_real(-1, 1), ay = random_real(-1, 1);
	const int off = random_int(-api->bits - 3, -3);
	(void)degree;
	for (size_t i = 0; i < ring->n; i++) {
		const double t = random_real(-2, 2);
		ring->x[i] = 0.3 + t * ax + random_scaled(off, off);
		ring->y[i] = 0.7 + t * ay + random_scaled(off, off);
	}
}

/* There and back again, nearly: everything cancels. */
static void fill_return(const Api *api, Ring *ring, int degree)
{
	const int off = random_int(-api->bits, 0);
	fill_cloud(api, ring, degree);
	for (size_t i = ring->n / 2; i < ring->n; i++) {
		ring->x[i] = ring->x[ring->n - 1 - i] + random_scaled(off, off);
		ring->y[i] = ring->y[ring->n - 1 - i] + random_scaled(off, off);
	}
}

static void fill_integers(const Api *api, Ring *ring, int degree)
{
	const int size = random_int(2, 1000);
	(void)api, (void)degree;
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = random_int(-size, size);
		ring->y[i] = random_int(-size, size);
	}
}

/* Several times around, with vertices that come again. */
static void fill_overlap(const Api *api, Ring *ring, int degree)
{
	(void)api, (void)degree;
	for (size_t i = 0; i < ring->n; i++) {
		const double turn = 6.283185307179586 * (double)i * 3 / (double)ring->n;
		const double radius = random_real(0.5, 1);
		ring->x[i] = radius * cos(turn);
		ring->y[i] = radius * sin(turn);
		const size_t again = (size_t)random_int(0, (int)i);
		if (random_int(0, 3) == 0) {
			ring->x[i] = ring->x[again];
			ring->y[i] = ring->y[again];
		}
	}
}

/* The same triangle again and again: what an addition rounds away, the next one does too. */
static void fill_again(const Api *api, Ring *ring, int degree)
{
	fill_star(api, ring, degree);
	for (size_t i = 3; i < ring->n; i++) {
		ring->x[i] = ring->x[i - 3];
		ring->y[i] = ring->y[i - 3];
	}
}

static void fill_mixed(const Api *api, Ring *ring, int degree)
{
	const int span = api->bits == 24 ? 10 : 40;
	(void)degree;
	fill_scaled(ring, -span, span);
}

/* Sizes at which moments of this degree overflow, or do not yet. */
static void fill_huge(const Api *api, Ring *ring, int degree)
{
	const int most = api->bits == 24 ? 128 : 1024;
	const int scale = most / (random_int(0, degree) + 2) + random_int(-6, 2);
	fill_scaled(ring, scale - random_int(0, 4), scale);
}

/* Sizes at which products underflow. */
static void fill_tiny(const Api *api, Ring *ring, int degree)
{
	const int least = api->bits == 24 ? -149 : -1074;
	const int scale = least / (random_int(0, degree) + 2) + random_int(-6, 8);
	fill_scaled(ring, scale - random_int(0, 30), scale);
}

/* Tiny in one coordinate, large in the other: underflow that large factors bring back. */
static void fill_lopsided(const Api *api, Ring *ring, int degree)
{
	const int least = api->bits == 24 ? -149 : -1074;
	const int high = api->bits == 24 ? random_int(0, 20) : random_int(0, 150);
	(void)degree;
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = random_scaled(least / 2, least / 4);
		ring->y[i] = random_scaled(high - 5, high);
		if (random_int(0, 1)) {
			const double x = ring->x[i];
			ring->x[i] = ring->y[i];
			ring->y[i] = x;
		}
	}
}

static void fill_denormal(const Api *api, Ring *ring, int degree)
{
	(void)degree;
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = api->denormal * random_int(-1000, 1000);
		ring->y[i] = random_int(0, 2) ? api->denormal * random_int(-9, 9) : 1;
	}
}

static void fill_extremes(const Api *api, Ring *ring, int degree)
{
	(void)degree;
	fill_scaled(ring, api->bits == 24 ? -148 : -1073, api->bits == 24 ? 127 : 1023);
}

static const struct {
	const char *name;
	Fill *fill;
	int degree, rings;
} kinds[] = {
	{ "stars", fill_star, 8, 400 }, { "clouds", fill_cloud, 8, 400 },
	{ "far from the origin", fill_far, 8, 400 }, { "slivers", fill_sliver, 8, 400 },
	{ "there and back", fill_return, 8, 400 }, { "integers", fill_integers, 8, 400 },
	{ "overlapping", fill_overlap, 8, 400 }, { "one triangle", fill_again, 8, 300 },
	{ "mixed scales", fill_mixed, 8, 300 }, { "huge", fill_huge, 8, 400 },
	{ "tiny", fill_tiny, 8, 400 }, { "lopsided", fill_lopsided, 5, 300 },
	{ "denormal", fill_denormal, 4, 300 }, { "extremes", fill_extremes, 3, 150 }
};

static size_t random_count(void)
{
	switch (random_int(0, 19)) {
	case 0: return (size_t)random_int(0, 2);
	case 1: return (size_t)random_int(20, 27);
	case 2: return (size_t)random_int(13, 100);
	default: return (size_t)random_int(3, 9);
	}
}

static void test_bounds(const Api *api, int rounds)
{
	for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
		check_begin("bounds of %s, %s", kinds[k].name, api->name);
		for (int i = 0; i < rounds * kinds[k].rings; i++) {
			Ratios worst = { { 0 } };
			Ring ring = ring_new(random_count());
			kinds[k].fill(api, &ring, random_int(0, kinds[k].degree));
			expect_ring(api, &ring, kinds[k].degree, worst);
			ring_free(&ring);
		}
		check_end();
	}
}

static void test_long(const Api *api)
{
	check_begin("bounds of long rings, %s", api->name);
	for (int i = 0; i < 16; i++) {
		Ratios worst = { { 0 } };
		Ring ring = ring_new((size_t)random_int(1000, 4000));
		kinds[i / 2].fill(api, &ring, 2);
		expect_ring(api, &ring, 2, worst);
		ring_free(&ring);
	}
	check_end();
}

/* No area: no error. */
static void test_short(const Api *api)
{
	check_begin("bounds of fewer than three vertices, %s", api->name);
	for (size_t n = 0; n < 3; n++) {
		double out[MOMENTS], bound[MOMENTS];
		Ring ring = ring_new(n);
		fill_cloud(api, &ring, 0);
		ring_pack(api, &ring);
		for (int d = 0; d <= EW_MAX_DEGREE; d++) {
			bounded(api, d, &ring, out, bound);
			for (int j = 0; j < ref_count(d); j++)
				expect(get(api, out, j) == 0 && get(api, bound, j) >= 0
					&& get(api, bound, j) <= api->denormal,
					"n = %zu: %g within %g", n, get(api, out, j),
					get(api, bound, j));
		}
		ring_free(&ring);
	}
	check_end();
}

static void test_nonfinite(const Api *api, const char *target)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	double out[MOMENTS], bound[MOMENTS];
	check_begin("bounds of NaN and infinity, %s, %s", api->name, target);
	for (int i = 0; i < 600; i++) {
		Ring ring = ring_new((size_t)random_int(1, 60));
		const int d = i % (EW_MAX_DEGREE + 1);
		fill_cloud(api, &ring, d);
		(random_int(0, 1) ? ring.x : ring.y)[random_int(0, (int)ring.n - 1)] = bad[i % 3];
		ring_pack(api, &ring);
		bounded(api, d, &ring, out, bound);
		for (int j = 0; j < ref_count(d); j++)
			expect(!isfinite(get(api, out, j)) && get(api, bound, j) == HUGE_VAL,
				"n = %zu, degree %d: %g within %g", ring.n, d, get(api, out, j),
				get(api, bound, j));
		ring_free(&ring);
	}
	check_end();
}

static void test_bad_degree(const Api *api, const char *target)
{
	double out[2] = { 3, 3 }, bound[2] = { 3, 3 };
	Ring ring = ring_new(5);
	check_begin("bounds of a degree out of range, %s, %s", api->name, target);
	fill_cloud(api, &ring, 0);
	ring_pack(api, &ring);
	expect(bounded(api, -1, &ring, out, bound) == EW_BAD_DEGREE, "-1 is not refused");
	expect(bounded(api, EW_MAX_DEGREE + 1, &ring, out, bound) == EW_BAD_DEGREE,
		"%d is not refused", EW_MAX_DEGREE + 1);
	expect(out[0] == 3 && out[1] == 3 && bound[0] == 3 && bound[1] == 3, "written");
	check_end();
	ring_free(&ring);
}

/* How tight: bound over the worst error of many rings, per output; then the average. */

typedef struct {
	double sum, most;
	int count, degree, output;
	size_t n;
} Tightness;

static void add_class(Tightness *t, Ratios worst, int degree, size_t n)
{
	for (int j = 0; j < ref_count(degree); j++) {
		const double times = 1 / worst[degree][j];
		t->sum += times;
		t->count++;
		if (times > t->most) {
			t->most = times;
			t->degree = degree;
			t->output = j;
			t->n = n;
		}
	}
}

static void test_tightness(const Api *api, int rounds)
{
	static const struct { size_t n; int rings; } classes[] = {
		{ 4, 2000 }, { 8, 2000 }, { 12, 1500 }, { 23, 1000 }, { 24, 1000 }, { 50, 500 },
		{ 100, 300 }
	};
	Tightness by_degree[EW_MAX_DEGREE + 1] = { { 0, 0, 0, 0, 0, 0 } };
	double sum = 0;
	int count = 0;
	check_begin("bounds are tight, %s", api->name);
	for (size_t k = 0; k < 2; k++) {
		for (size_t c = 0; c < sizeof classes / sizeof *classes; c++) {
			Ratios worst = { { 0 } };
			for (int i = 0; i < rounds * classes[c].rings; i++) {
				Ring ring = ring_new(classes[c].n);
				kinds[k].fill(api, &ring, 0);
				expect_ring(api, &ring, EW_MAX_DEGREE, worst);
				ring_free(&ring);
			}
			for (int d = 0; d <= EW_MAX_DEGREE; d++)
				add_class(&by_degree[d], worst, d, classes[c].n);
		}
	}
	for (int d = 0; d <= EW_MAX_DEGREE; d++) {
		const Tightness *t = &by_degree[d];
		printf("# bound / worst error, %s, degree %d: %.1f on average, at most %.1f "
			"(result %d, n = %zu)\n", api->name, d, t->sum / t->count, t->most,
			t->output, t->n);
		sum += t->sum;
		count += t->count;
	}
	printf("# bound / worst error, %s: %.1f on average\n", api->name, sum / count);
	expect(sum / count <= 50, "%.1f times the worst error on average", sum / count);
	check_end();
}

/* The compensated area. */

static bool below_limit(const Api *api, const Ref *exact, size_t n)
{
	mpq_t left, right;
	mpq_inits(left, right, NULL);
	mpq_set_ui(left, 4 * n * n, 1);
	mpq_mul(left, left, exact->weight);
	mpq_abs(right, exact->value);
	mpq_mul_2exp(right, right, (mp_bitcnt_t)(api->bits - 1));
	const bool below = mpq_cmp(left, right) < 0;
	mpq_clears(left, right, NULL);
	return below;
}

static int compare(double v, const Ref *exact)
{
	mpq_t q;
	mpq_init(q);
	mpq_set_d(q, v);
	const int order = mpq_cmp(q, exact->value);
	mpq_clear(q);
	return order;
}

static double neighbour(const Api *api, double v, double to)
{
	return api->bits == 24 ? (double)nextafterf((float)v, (float)to) : nextafter(v, to);
}

/* No number of the precision lies between v and the exact area, and v is it if it is a number. */
static bool is_faithful(const Api *api, double v, const Ref *exact)
{
	return compare(neighbour(api, v, -HUGE_VAL), exact) < 0
		&& compare(neighbour(api, v, HUGE_VAL), exact) > 0;
}

static double condition(const Ref *exact)
{
	return fabs(mpq_get_d(exact->weight) / mpq_get_d(exact->value));
}

static void set_exact(Ref *exact, const Ring *ring)
{
	ref_ring(exact, 0, ring->x, ring->y, ring->n);
}

/* Moves the last ordinate so that the area is about weight / wanted. */
static void make_condition(const Api *api, Ring *ring, double wanted, Ref *exact)
{
	const size_t last = ring->n - 1;
	mpq_t y, width;
	mpq_inits(y, width, NULL);
	ring_pack(api, ring);
	set_exact(exact, ring);
	const double area = mpq_get_d(exact->weight) / wanted;
	ring->y[last] = 0;
	set_exact(exact, ring);
	mpq_set_d(y, area);
	mpq_sub(y, y, exact->value);
	mpq_mul_2exp(y, y, 1);
	mpq_set_d(width, ring->x[last - 1] - ring->x[0]);
	if (mpq_sgn(width))
		mpq_div(y, y, width);
	ring->y[last] = mpq_get_d(y);
	ring_pack(api, ring);
	set_exact(exact, ring);
	mpq_clears(y, width, NULL);
}

/* A ring of a random condition up to somewhat above the limit. */
static Ring conditioned_ring(const Api *api, size_t n, Ref *exact)
{
	const double limit = ldexp(1, api->bits - 1) / (4 * (double)n * (double)n);
	const double wanted = exp(random_real(0, log(limit * 2)));
	Ring ring = ring_new(n);
	if (random_int(0, 1))
		ring_star_near(&ring, 3, 1);
	else
		fill_scaled(&ring, -3, 0);
	make_condition(api, &ring, wanted > 1 ? wanted : 1, exact);
	return ring;
}

static size_t conditioned_size(const Api *api, int i)
{
	if (api->bits == 53 && i % 100 == 0)
		return (size_t)random_int(1000, 3000);
	return (size_t)(i % 3 ? random_int(3, 12) : random_int(13, api->bits == 24 ? 40 : 100));
}

/* Sum of x_i y_(i+1) - x_(i+1) y_i, halved, in the precision. */
static double plain_area(const Api *api, const Ring *ring)
{
	volatile double sum = 0;
	for (size_t i = 0; i < ring->n; i++) {
		const size_t next = i + 1 < ring->n ? i + 1 : 0;
		volatile double left = round_to(api->bits, ring->x[i] * ring->y[next]);
		volatile double right = round_to(api->bits, ring->x[next] * ring->y[i]);
		volatile double cross = round_to(api->bits, left - right);
		sum = round_to(api->bits, sum + cross);
	}
	return sum / 2;
}

static double relative_error(double v, const Ref *exact)
{
	return fabs(ref_units(v, exact, 0)) * condition(exact);
}

static void test_faithful(const Api *api, const char *target)
{
	int below = 0;
	double most = 1, plain = 0, ours = 0;
	Ref *exact = ref_new(1);
	check_begin("compensated area is faithful, %s, %s", api->name, target);
	for (int i = 0; i < 6000; i++) {
		Ring ring = conditioned_ring(api, conditioned_size(api, i), exact);
		const double got = compensated(api, &ring);
		if (mpq_sgn(exact->value) && below_limit(api, exact, ring.n)) {
			const double error = relative_error(got, exact);
			const double before = relative_error(plain_area(api, &ring), exact);
			below++;
			most = fmax(most, condition(exact));
			plain = fmax(plain, before);
			ours = fmax(ours, error);
			expect(is_faithful(api, got, exact), "n = %zu, condition %.3g: %a, exact "
				"%.17g", ring.n, condition(exact), got, mpq_get_d(exact->value));
			expect(error <= fmax(before, ldexp(1, -api->bits)),
				"n = %zu: off by %g, without compensation by %g", ring.n, error,
				before);
		}
		ring_free(&ring);
	}
	expect(below > 3000, "only %d rings are below the limit", below);
	expect(most > (api->bits == 24 ? 3e4 : 1e13), "no condition above %g", most);
	expect(plain > 1000 * ours, "off by %g, without compensation by %g", ours, plain);
	check_end();
	printf("# compensated, %s, %s: %d rings of condition up to %.2g, off by up to %.2g, "
		"uncompensated %.2g\n", api->name, target, below, most, ours, plain);
	ref_free(exact, 1);
}

/* The same bits wherever fma is fused; scaling by a power of two scales the result. */
static void test_same_bits(const Api *api)
{
	Ref *exact = ref_new(1);
	check_begin("compensated area has the same bits on all targets, %s", api->name);
	for (int i = 0; i < 3000; i++) {
		double first = 0;
		bool found = false;
		Ring ring = conditioned_ring(api, conditioned_size(api, i), exact);
		for (int t = 0; t < target_count; t++) {
			if (target_bit[t] == EW_PORTABLE)
				continue;
			ew_use_target(target_bit[t]);
			const double got = compensated(api, &ring);
			first = found ? first : got;
			found = true;
			expect(memcmp(&got, &first, sizeof got) == 0, "n = %zu: %a, on %s %a",
				ring.n, first, ew_target_name(target_bit[t]), got);
		}
		ring_free(&ring);
	}
	ew_use_target(0);
	check_end();
	ref_free(exact, 1);
}

static void test_scaling(const Api *api, const char *target)
{
	Ref *exact = ref_new(1);
	check_begin("compensated area scales, %s, %s", api->name, target);
	for (int i = 0; i < 1000; i++) {
		const int most = api->bits == 24 ? 20 : 400, shift = random_int(-most, most);
		Ring ring = conditioned_ring(api, (size_t)random_int(3, 60), exact);
		const double got = compensated(api, &ring);
		for (size_t j = 0; j < ring.n; j++) {
			ring.x[j] = ldexp(ring.x[j], shift);
			ring.y[j] = ldexp(ring.y[j], shift);
		}
		ring_pack(api, &ring);
		const double scaled = compensated(api, &ring);
		expect(scaled == ldexp(got, 2 * shift), "n = %zu: %a, times 2^%d %a", ring.n, got,
			2 * shift, scaled);
		ring_free(&ring);
	}
	check_end();
	ref_free(exact, 1);
}

/* The vertices of another ring: from `start` on, forwards or backwards, one of them twice. */
static Ring rearranged(const Api *api, const Ring *ring, size_t start, bool back, size_t twice)
{
	Ring other = ring_new(ring->n + 1);
	size_t to = 0;
	for (size_t i = 0; i < ring->n; i++) {
		const size_t from = (start + (back ? ring->n - i : i)) % ring->n;
		for (int copies = i == twice ? 2 : 1; copies > 0; copies--) {
			other.x[to] = ring->x[from];
			other.y[to++] = ring->y[from];
		}
	}
	other.n = to;
	if (twice == ring->n) {         /* closed */
		other.x[to] = other.x[0];
		other.y[to] = other.y[0];
		other.n = to + 1;
	}
	ring_pack(api, &other);
	return other;
}

/* Where the exact area is a number, faithful means exact: however the ring is written down. */
static void test_rearranged(const Api *api, const char *target)
{
	int held = 0;
	Ref *exact = ref_new(1);
	check_begin("compensated area of an exact number, %s, %s", api->name, target);
	for (int i = 0; i < 3000; i++) {
		Ring ring = ring_new((size_t)random_int(3, i % 2 ? 30 : 6));
		const double size = ldexp(1, random_int(3, 8));
		ring_star_near(&ring, size * ldexp(1, random_int(0, api->bits / 3)), size);
		ring_snap(&ring, 0.5);
		ring_pack(api, &ring);
		set_exact(exact, &ring);
		if (mpq_sgn(exact->value) && below_limit(api, exact, ring.n + 1)) {
			const double want = mpq_get_d(exact->value);
			for (size_t r = 0; r < 8; r++) {
				const size_t start = (size_t)random_int(0, (int)ring.n - 1);
				const size_t twice = r / 2 == 0 ? ring.n + 1 : r / 2 == 1 ? ring.n
					: (size_t)random_int(0, (int)ring.n - 1);
				Ring other = rearranged(api, &ring, start, r % 2, twice);
				const double got = compensated(api, &other);
				expect(got == (r % 2 ? -want : want), "n = %zu, from %zu%s: %a, "
					"exact %a", ring.n, start, r % 2 ? " backwards" : "", got,
					want);
				ring_free(&other);
			}
			held++;
		}
		ring_free(&ring);
	}
	expect(held > 1000, "only %d rings below the limit", held);
	check_end();
	ref_free(exact, 1);
}

/* How often does writing a ring down otherwise give other bits, where the area is no number? */
static void test_unchanged(const Api *api, const char *target)
{
	int count[3] = { 0 }, held = 0;
	Ref *exact = ref_new(1);
	check_begin("compensated area of the same ring, %s, %s", api->name, target);
	for (int i = 0; i < 3000; i++) {
		Ring ring = conditioned_ring(api, conditioned_size(api, 1 + i % 90), exact);
		if (mpq_sgn(exact->value) && below_limit(api, exact, ring.n + 1)) {
			const double got = compensated(api, &ring);
			const size_t twice[] = { (size_t)random_int(0, (int)ring.n - 1), ring.n,
				ring.n + 1 };
			for (int r = 0; r < 3; r++) {
				Ring other = rearranged(api, &ring, 0, r == 2, twice[r]);
				const double again = compensated(api, &other);
				count[r] += again != (r == 2 ? -got : got);
				expect(is_faithful(api, r == 2 ? -again : again, exact),
					"n = %zu: %a, written otherwise %a", ring.n, got, again);
				ring_free(&other);
			}
			held++;
		}
		ring_free(&ring);
	}
	check_end();
	printf("# compensated, %s, %s: other bits in %d of %d rings with a vertex twice, "
		"%d closed, %d backwards\n", api->name, target, count[0], held, count[1], count[2]);
	ref_free(exact, 1);
}

static void test_compensated_nonfinite(const Api *api, const char *target)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	check_begin("compensated area of NaN, infinity and nothing, %s, %s", api->name, target);
	for (int i = 0; i < 600; i++) {
		Ring ring = ring_new((size_t)random_int(1, 60));
		fill_cloud(api, &ring, 0);
		ring_pack(api, &ring);
		expect(ring.n > 2 || compensated(api, &ring) == 0, "n = %zu is not 0", ring.n);
		(random_int(0, 1) ? ring.x : ring.y)[random_int(0, (int)ring.n - 1)] = bad[i % 3];
		ring_pack(api, &ring);
		expect(!isfinite(compensated(api, &ring)), "n = %zu is finite", ring.n);
		ring_free(&ring);
	}
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	const int rounds = argc > 2 ? atoi(argv[2]) : 1;
	list_targets();
	for (int i = 0; i < APIS; i++) {
		test_bounds(&apis[i], rounds);
		test_long(&apis[i]);
		test_short(&apis[i]);
		test_tightness(&apis[i], rounds);
		test_same_bits(&apis[i]);
	}
	printf("# bounds of %ld results of %ld rings held against exact values\n", results, rings);
	for_each_target(test_nonfinite);
	for_each_target(test_bad_degree);
	for_each_target(test_faithful);
	for_each_target(test_scaling);
	for_each_target(test_rearranged);
	for_each_target(test_unchanged);
	for_each_target(test_compensated_nonfinite);
	return check_finish();
}

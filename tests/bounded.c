/* Results that say how far off they can be.
 *
 *     bounded [SEED [ROUNDS]]     ROUNDS times as many rings, 1 by default
 *
 * Magnitudes, the sums of all terms with positive sign of which bounds are made, are held against
 * exact ones with the bounds of their rows (rings.h). No function returns them: their kernels are
 * called, in the way that gives the bits of ew_moments with the kernels of moments.
 *
 * ew_moments_bounded gives the bits of ew_moments, and |out - exact| <= bound holds against exact
 * rationals, for every degree, target and precision, on ordinary and on hostile rings: about ten
 * million results per run. On ordinary rings the bound is on average at most 50 times the worst
 * error found for the same output. A result that is not finite has an infinite bound.
 */
#include "rings.h"

static int bounded(const Api *api, int degree, const Ring *ring, void *out, void *bound)
{
	return api->bits == 24
		? ew_moments_boundedf(degree, ring->px, ring->py, ring->n, out, bound)
		: ew_moments_bounded(degree, ring->px, ring->py, ring->n, out, bound);
}

/* Rings. Each kind fills n vertices; hostile ones may choose their scale by the degree. */

typedef void Fill(const Api *api, Ring *ring, int degree);

static void fill_star(const Api *api, Ring *ring, int degree)
{
	(void)api, (void)degree;
	ring_star_near(ring, 2, 1);
}

static void fill_cloud(const Api *api, Ring *ring, int degree)
{
	(void)api, (void)degree;
	ring_scaled(ring, 0, 0);
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
	ring_scaled(ring, -span, span);
}

/* Sizes at which moments of this degree overflow, or do not yet. */
static void fill_huge(const Api *api, Ring *ring, int degree)
{
	const int most = api->bits == 24 ? 128 : 1024;
	const int scale = most / (random_int(0, degree) + 2) + random_int(-6, 2);
	ring_scaled(ring, scale - random_int(0, 4), scale);
}

/* Sizes at which products underflow. */
static void fill_tiny(const Api *api, Ring *ring, int degree)
{
	const int least = api->bits == 24 ? -149 : -1074;
	const int scale = least / (random_int(0, degree) + 2) + random_int(-6, 8);
	ring_scaled(ring, scale - random_int(0, 30), scale);
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
	ring_scaled(ring, api->bits == 24 ? -148 : -1073, api->bits == 24 ? 127 : 1023);
}

static const struct {
	const char *name;
	Fill *fill;
	int degree, rings;
} kinds[] = {
	{ "stars", fill_star, 8, 400 }, { "clouds", fill_cloud, 8, 400 },
	{ "slivers", fill_sliver, 8, 400 }, { "there and back", fill_return, 8, 400 },
	{ "integers", fill_integers, 8, 400 }, { "overlapping", fill_overlap, 8, 400 },
	{ "one triangle", fill_again, 8, 300 }, { "mixed scales", fill_mixed, 8, 300 },
	{ "far from the origin", fill_far, 8, 400 }, { "huge", fill_huge, 8, 400 },
	{ "tiny", fill_tiny, 8, 400 }, { "lopsided", fill_lopsided, 5, 300 },
	{ "denormal", fill_denormal, 4, 300 }, { "extremes", fill_extremes, 3, 150 }
};

enum { HOSTILE = 8 };           /* from here on sums of the highest degree need not fit */

/* Magnitudes. */

#define RUN(id, kernel, f, a) [id] = kernel,
#define TABLES(TARGET, target, doubles) \
	static ew_ring_run *const run_##target[ROWS] = { EW_RINGS_##TARGET##_DOUBLE(RUN) }; \
	static ew_ring_runf *const runf_##target[ROWS] = { EW_RINGS_##TARGET##_FLOAT(RUN) };
EW_TARGETS(TABLES)

typedef struct {
	const char *target;
	ew_ring_run *const *run;
	ew_ring_runf *const *runf;
} Kernels;

#define KERNELS(TARGET, target, doubles) { #target, run_##target, runf_##target },

static const Kernels *kernels_of(const char *target)
{
	static const Kernels all[] = { EW_TARGETS(KERNELS) };
	for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
		if (strcmp(all[i].target, target) == 0)
			return &all[i];
	}
	abort();
}

/* What a kernel adds up over a ring of at most 1024 items and at least three vertices, by the
 * definition of lanes; results in double. `closed` ends with its first vertex. */
static void run_kernel(const Api *api, const Kernels *kernels, const Row *row, const Ring *closed,
	double out[MOMENTS])
{
	const long id = row - ring_rows;
	const bool is_float = api->bits == 24;
	const size_t n = closed->n - 1, lanes = ring_lanes(api, n), stride = is_float ? 16 : 8;
	const size_t items = n + 2 - ring_shapes[id].window;
	double origin[16], sum[EW_MAX_ACCUMULATORS * 16] = { 0 }, total[EW_MAX_ACCUMULATORS];
	float originf[16], sumf[EW_MAX_ACCUMULATORS * 16] = { 0 };
	for (int l = 0; l < 16; l++)
		originf[l] = (float)(origin[l] = closed->x[0]);
	if (is_float)
		kernels->runf[id](closed->px, closed->py, originf, 1, lanes, items, sumf);
	else
		kernels->run[id](closed->px, closed->py, origin, 1, lanes, items, sum);
	for (size_t i = 0; i < (size_t)row->accumulators; i++) {
		double *lane = sum + i * stride;
		for (size_t l = 0; l < lanes && is_float; l++)
			lane[l] = (double)sumf[i * stride + l];
		for (size_t half = lanes / 2; half > 0; half /= 2) {
			for (size_t l = 0; l < half; l++)
				lane[l] += lane[l + half];
		}
		total[i] = lane[0];
	}
	ring_shapes[id].finish(total, out, 1);
}

/* W instead of the value. */
static Ref magnitude(const Ref *ref)
{
	return (Ref){ { *ref->weight }, { *ref->weight } };
}

static void expect_magnitudes(const Api *api, const Kernels *kernels, const Ring *ring,
	const Ring *closed, const Ref *exact, int degree)
{
	double out[MOMENTS], moments[MOMENTS], want[MOMENTS];
	const Row *row = find_row("magnitudes", degree, 0);
	const long k = ring_k(api, row, ring->n);
	run_kernel(api, kernels, row, closed, out);
	for (int i = 0; i < ref_count(degree); i++) {
		const Ref sum = magnitude(&exact[i]);
		expect_within(out[i], &sum, k, api->bits,
			ref_tiny(k, degree, api->bits, ring->x, ring->y, ring->n),
			"n = %zu: magnitude %d of degree %d", ring->n, i, degree);
	}
	run_kernel(api, kernels, find_row("moments", degree, 0), closed, moments);
	api->moments(degree, ring->px, ring->py, ring->n, want);
	for (int i = 0; i < ref_count(degree); i++)
		expect(same_bits(round_to(api->bits, moments[i]), get(api, want, i)),
			"n = %zu, degree %d: the kernel called directly gives %a, ew_moments %a",
			ring->n, degree, moments[i], get(api, want, i));
}

/* The ring, and its first vertex once more at the end. */
static Ring closed_ring(const Api *api, const Ring *ring)
{
	Ring closed = ring_new(ring->n + 1);
	for (size_t i = 0; i <= ring->n; i++) {
		closed.x[i] = ring->x[i % ring->n];
		closed.y[i] = ring->y[i % ring->n];
	}
	ring_pack(api, &closed);
	return closed;
}

/* Of one ring; that of degree 0 is the one of the vertex form. */
static void expect_all_magnitudes(const Api *api, const Kernels *kernels, Ring *ring)
{
	Ref *exact = ref_new(MOMENTS), *area = ref_new(1);
	ring_pack(api, ring);
	if (ring_count(ring) == ring->n) {
		Ring closed = closed_ring(api, ring);
		ref_ring(exact, EW_MAX_DEGREE, ring->x, ring->y, ring->n);
		ref_area(area, ring->x, ring->y, ring->n);
		for (int d = 0; d <= EW_MAX_DEGREE; d++)
			expect_magnitudes(api, kernels, ring, &closed, d ? exact : area, d);
		ring_free(&closed);
	}
	ref_free(exact, MOMENTS);
	ref_free(area, 1);
}

/* On all kinds of rings whose sums fit. */
static void test_magnitudes(const Api *api, const char *target)
{
	check_begin("magnitudes, %s, %s", api->name, target);
	for (size_t n = 3; n <= 40; n++) {
		for (int k = 0; k < HOSTILE; k++) {
			Ring ring = ring_new(n);
			kinds[k].fill(api, &ring, EW_MAX_DEGREE);
			expect_all_magnitudes(api, kernels_of(target), &ring);
			ring_free(&ring);
		}
	}
	check_end();
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
		const int most = kinds[k].degree < EW_MAX_DEGREE ? kinds[k].degree : EW_MAX_DEGREE;
		check_begin("bounds of %s, %s", kinds[k].name, api->name);
		for (int i = 0; i < rounds * kinds[k].rings; i++) {
			Ratios worst = { { 0 } };
			Ring ring = ring_new(random_count());
			kinds[k].fill(api, &ring, random_int(0, most));
			expect_ring(api, &ring, most, worst);
			ring_free(&ring);
		}
		check_end();
	}
}

static void test_long(const Api *api)
{
	check_begin("bounds of long rings, %s", api->name);
	for (int i = 0; i < 2 * (HOSTILE + 1); i++) {
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

int main(int argc, char **argv)
{
	check_start(argc, argv);
	const int rounds = argc > 2 ? atoi(argv[2]) : 1;
	list_targets();
	for_each_target(test_magnitudes);
	for (int i = 0; i < APIS; i++) {
		test_bounds(&apis[i], rounds);
		test_long(&apis[i]);
		test_short(&apis[i]);
		test_tightness(&apis[i], rounds);
	}
	printf("# bounds of %ld results of %ld rings held against exact values\n", results, rings);
	for_each_target(test_nonfinite);
	for_each_target(test_bad_degree);
	return check_finish();
}

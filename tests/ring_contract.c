/* What the ring functions promise besides their numbers.
 *
 * They read nothing beyond the n vertices and write nothing beyond the moments asked for: arrays
 * end or begin at an inaccessible page, inputs are read-only pages, and every output stands between
 * canaries. They work at any element alignment. NaN or infinity in any coordinate makes every
 * moment NaN or infinite, since each coordinate is a factor of the cross product of its two edges.
 * A degree out of range is refused and writes nothing. A target is forced, and the forced one is
 * really used: portable and fma differ in some bits, and a refused choice leaves them as they were.
 */
#include "guarded.h"

#include <limits.h>

#include "rings.h"

/* All functions into one buffer of consecutive outputs; returns the number of elements. */

enum { MOST = 6 * MOMENTS + MOMENTS + 8 };

typedef struct {
	const void *x, *y, *xy, *in;
	size_t n;
} Input;

static int run_all(const Api *api, const Input *r, int degree, char *out)
{
	const int count = ref_count(degree);
	const size_t step = (size_t)count * api->size;
	api->moments(degree, r->x, r->y, r->n, out);
	api->about(degree, r->x, r->y, r->n, 0.5, -2, out + step);
	api->xy(degree, r->xy, r->n, out + 2 * step);
	api->central(degree, r->x, r->y, r->n, out + 3 * step, out + 3 * step + 2 * api->size);
	char *next = out + 4 * step + 2 * api->size;
	api->centroid(r->x, r->y, r->n, next);
	put(api, next, 2, api->area(r->x, r->y, r->n));
	api->translate(degree, r->in, 1, 2, next + 3 * api->size);
	next += 3 * api->size + step;
	for (int n = 0; n <= degree; n++)
		put(api, next, (size_t)n, api->moment(degree - n, n, r->x, r->y, r->n));
	return 5 * count + 6 + degree;
}

static Ring random_ring(const Api *api, size_t n)
{
	Ring ring = ring_new(n);
	ring_star(&ring, 0.25, 0.5, 1);
	ring_pack(api, &ring);
	return ring;
}

static const double some_moments[MOMENTS] = { 3, 1, 2 };

static Input input_of(const Ring *ring)
{
	return (Input){ ring->px, ring->py, ring->pxy, some_moments, ring->n };
}

static bool same_numbers(const Api *api, const void *a, const void *b, int count)
{
	for (int i = 0; i < count; i++) {
		const double p = get(api, a, i), q = get(api, b, i);
		if (!same_bits(p, q) && !(isnan(p) && isnan(q)))
			return false;
	}
	return true;
}

static void expect_guarded(const Api *api, Guarded g[4], size_t n, int degree)
{
	double want[MOST], got[MOST];
	Ring ring = random_ring(api, n);
	Input input = input_of(&ring);
	const int count = run_all(api, &input, degree, (char *)want);
	for (int places = 0; places < 16; places++) {
		input.x = guarded_copy(&g[0], ring.px, n * api->size, places & 1);
		input.y = guarded_copy(&g[1], ring.py, n * api->size, places & 2);
		input.xy = guarded_copy(&g[2], ring.pxy, 2 * n * api->size, places & 4);
		input.in = guarded_copy(&g[3], some_moments, (size_t)ref_count(degree) * api->size,
			places & 8);
		run_all(api, &input, degree, (char *)got);
		expect(same_numbers(api, want, got, count),
			"n = %zu, degree %d: other bits at places %d", n, degree, places);
	}
	ring_free(&ring);
}

static void test_guards(const Api *api, const char *target)
{
	static const size_t longer[] = {
		63, 64, 65, 255, 256, 257, 1023, 1024, 1025, 1100, 2049, 2050
	};
	Guarded g[4];
	check_begin("guard pages and read-only inputs, %s, %s", api->name, target);
	for (int i = 0; i < 4; i++)
		g[i] = guarded_new(i == 2 ? 40000 : 20000);
	for (size_t n = 0; n <= 40; n++) {
		for (int d = 0; d <= EW_MAX_DEGREE; d++)
			expect_guarded(api, g, n, d);
	}
	for (size_t i = 0; i < sizeof longer / sizeof *longer; i++) {
		for (int d = 0; d <= EW_MAX_DEGREE; d += d < 2 ? 1 : 3)
			expect_guarded(api, g, longer[i], d);
	}
	for (int i = 0; i < 4; i++)
		guarded_free(&g[i]);
	check_end();
}

/* Canaries. */

enum { CANARY = 0x88, MARGIN = 64 };

static unsigned char canvas[MARGIN + MOST * sizeof(double) + MARGIN];

static void *canvas_new(void)
{
	memset(canvas, CANARY, sizeof canvas);
	return canvas + MARGIN;
}

/* count elements, and no byte besides, have been written */
static void expect_written(const Api *api, int count, const char *what, int degree)
{
	const size_t bytes = (size_t)count * api->size;
	for (size_t i = 0; i < sizeof canvas; i++) {
		if (i < MARGIN || i >= MARGIN + bytes)
			expect(canvas[i] == CANARY, "%s of degree %d writes at byte %ld of %zu",
				what, degree, (long)i - MARGIN, bytes);
	}
	for (int i = 0; i < count; i++) {
		const unsigned char *element = canvas + MARGIN + (size_t)i * api->size;
		bool written = false;
		for (size_t j = 0; j < api->size; j++)
			written |= element[j] != CANARY;
		expect(written, "%s of degree %d leaves element %d", what, degree, i);
	}
}

static void test_canaries(const Api *api, const char *target)
{
	double c[2];
	check_begin("canaries, %s, %s", api->name, target);
	for (size_t n = 0; n <= 40; n++) {
		Ring ring = random_ring(api, n);
		const Input r = input_of(&ring);
		for (int d = 0; d <= EW_MAX_DEGREE; d++) {
			const int count = ref_count(d);
			api->moments(d, r.x, r.y, n, canvas_new());
			expect_written(api, count, "ew_moments", d);
			api->about(d, r.x, r.y, n, 1, 2, canvas_new());
			expect_written(api, count, "ew_moments_about", d);
			api->xy(d, r.xy, n, canvas_new());
			expect_written(api, count, "ew_moments_xy", d);
			api->translate(d, r.in, 1, 2, canvas_new());
			expect_written(api, count, "ew_translate_moments", d);
			api->central(d, r.x, r.y, n, c, canvas_new());
			expect_written(api, count, "ew_central_moments", d);
			api->central(d, r.x, r.y, n, canvas_new(), (double[MOMENTS]){ 0 });
			expect_written(api, 2, "the centre of ew_central_moments", d);
		}
		api->centroid(r.x, r.y, n, canvas_new());
		expect_written(api, 2, "ew_centroid", 1);
		ring_free(&ring);
	}
	check_end();
}

/* Every element alignment of inputs and outputs relative to a cache line. */
static void test_alignment(const Api *api, const char *target)
{
	enum { STEPS = 16 };
	_Alignas(64) static char at[5][sizeof(double) * (MOST + 2 * 100 + STEPS)];
	double want[MOST];
	check_begin("alignment, %s, %s", api->name, target);
	for (size_t i = 0; i < STEPS * STEPS; i++) {
		Ring ring = random_ring(api, i % 50 + 3);
		Input r = input_of(&ring);
		const size_t shift[4] = {
			i % STEPS, i / STEPS, (i + 5) % STEPS, (3 * i + 1) % STEPS
		};
		const int degree = (int)(i % (EW_MAX_DEGREE + 1));
		const int count = run_all(api, &r, degree, (char *)want);
		r.x = memcpy(at[0] + shift[0] * api->size, ring.px, ring.n * api->size);
		r.y = memcpy(at[1] + shift[1] * api->size, ring.py, ring.n * api->size);
		r.xy = memcpy(at[2] + shift[2] * api->size, ring.pxy, 2 * ring.n * api->size);
		r.in = memcpy(at[3] + shift[3] * api->size, some_moments, sizeof some_moments);
		char *got = at[4] + shift[3] * api->size;
		run_all(api, &r, degree, got);
		expect(same_numbers(api, want, got, count),
			"n = %zu, degree %d: other bits when shifted", ring.n, degree);
		ring_free(&ring);
	}
	check_end();
}

/* NaN and infinity. */

static void expect_nonfinite(const Api *api, const Ring *ring, int degree, const char *what)
{
	double out[MOMENTS], c[2];
	const size_t n = ring->n;
	api->moments(degree, ring->px, ring->py, n, out);
	for (int i = 0; i < ref_count(degree); i++)
		expect(!isfinite(get(api, out, i)), "%s, n = %zu: moment %d of degree %d is %g",
			what, n, i, degree, get(api, out, i));
	api->xy(degree, ring->pxy, n, out);
	for (int i = 0; i < ref_count(degree); i++)
		expect(!isfinite(get(api, out, i)), "%s, n = %zu: interleaved moment %d is finite",
			what, n, i);
	api->about(degree, ring->px, ring->py, n, 1, 2, out);
	for (int i = 0; i < ref_count(degree); i++)
		expect(!isfinite(get(api, out, i)), "%s, n = %zu: moment %d about (1,2) is finite",
			what, n, i);
	for (int i = 0; i <= degree; i++)
		expect(!isfinite(api->moment(degree - i, i, ring->px, ring->py, n)),
			"%s, n = %zu: x%dy%d is finite", what, n, degree - i, i);
	api->central(degree, ring->px, ring->py, n, c, out);
	expect(!isfinite(get(api, c, 0)) && !isfinite(get(api, c, 1)), "%s: centre is finite",
		what);
	for (int i = 0; i < ref_count(degree); i++)
		expect(!isfinite(get(api, out, i)), "%s, n = %zu: central moment %d is finite",
			what, n, i);
}

static void test_nonfinite(const Api *api, const char *target)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	static const size_t sizes[] = { 1, 2, 3, 4, 5, 8, 9, 10, 17, 33, 1500 };
	double c[2];
	check_begin("NaN and infinity, %s, %s", api->name, target);
	for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
		const size_t n = sizes[i], step = n > 100 ? n / 3 : 1;
		for (size_t at = 0; at < 2 * n; at += step) {
			for (int b = 0; b < 3; b++) {
				Ring ring = random_ring(api, n);
				ring_snap(&ring, 0.25);
				(at < n ? ring.x : ring.y)[at % n] = bad[b];
				ring_pack(api, &ring);
				for (int d = 0; d <= EW_MAX_DEGREE; d++)
					expect_nonfinite(api, &ring, d, b ? "infinity" : "NaN");
				expect(!isfinite(api->area(ring.px, ring.py, n)),
					"n = %zu: area is finite", n);
				api->centroid(ring.px, ring.py, n, c);
				expect(!isfinite(get(api, c, 0)) && !isfinite(get(api, c, 1)),
					"n = %zu: centroid is finite", n);
				ring_free(&ring);
			}
		}
	}
	check_end();
}

/* A centre, a shift or a moment that is no number. */
static void test_nonfinite_parameters(const Api *api, const char *target)
{
	double out[MOMENTS], in[MOMENTS] = { 0 };
	Ring ring = random_ring(api, 12);
	check_begin("NaN and infinity as parameters, %s, %s", api->name, target);
	for (int i = 0; i < 4; i++) {
		const double bad = i / 2 ? INFINITY : NAN;
		for (int d = 0; d <= EW_MAX_DEGREE; d++) {
			api->about(
				d, ring.px, ring.py, ring.n, i % 2 ? bad : 0, i % 2 ? 0 : bad, out);
			for (int j = 0; j < ref_count(d); j++)
				expect(!isfinite(get(api, out, j)),
					"moment %d about a bad centre is finite", j);
		}
		put(api, in, 0, bad);
		api->translate(2, in, 1, 2, out);
		for (int j = 0; j < ref_count(2); j++)
			expect(!isfinite(get(api, out, j)), "moment %d from a bad area is finite",
				j);
		put(api, in, 0, 1);
		api->translate(1, in, bad, 2, out);
		expect(!isfinite(get(api, out, 1)) && get(api, out, 2) == 2, "moved by a bad dx");
	}
	check_end();
	ring_free(&ring);
}

/* Degrees out of range. */
static void test_bad_degree(const Api *api, const char *target)
{
	static const int bad[] = { -1, EW_MAX_DEGREE + 1, INT_MAX, INT_MIN, -1000, 1000000000 };
	check_begin("degree out of range, %s, %s", api->name, target);
	for (size_t n = 0; n <= 12; n += 4) {
		Ring ring = random_ring(api, n);
		for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
			const int d = bad[i];
			char *out = canvas_new();
			const bool refused =
				api->moments(d, ring.px, ring.py, n, out) == EW_BAD_DEGREE
				&& api->about(d, ring.px, ring.py, n, 0, 0, out) == EW_BAD_DEGREE
				&& api->xy(d, ring.pxy, n, out) == EW_BAD_DEGREE
				&& api->translate(d, some_moments, 1, 1, out) == EW_BAD_DEGREE
				&& api->central(d, ring.px, ring.py, n, out, out + 16)
					== EW_BAD_DEGREE;
			expect(refused, "degree %d is not refused", d);
			expect_written(api, 0, "a refused call", d);
			for (int m = 0; m <= 9; m++)
				expect(isnan(api->moment(m, d, ring.px, ring.py, n))
						&& isnan(api->moment(d, m, ring.px, ring.py, n)),
					"x%dy%d is a number", m, d);
		}
		expect(isnan(api->moment(5, 4, ring.px, ring.py, n)), "x5y4 is a number");
		expect(isnan(api->moment(INT_MAX, INT_MAX, ring.px, ring.py, n)),
			"a huge monomial exists");
		expect(isnan(api->moment(INT_MAX, INT_MIN, ring.px, ring.py, n)),
			"a wild monomial exists");
		expect(isnan(api->moment(9, -1, ring.px, ring.py, n)), "x9y-1 is a number");
		ring_free(&ring);
	}
	check_end();
}

/* Targets. */

/* The bits of many results, as one number. */
static uint64_t digest(void)
{
	uint64_t hash = 0;
	check.state = 1;
	for (int i = 0; i < 40; i++) {
		const Api *api = &apis[i % APIS];
		double out[MOST];
		Ring ring = random_ring(api, 30);
		const Input r = input_of(&ring);
		const int count = run_all(api, &r, i % 9, (char *)out);
		for (int j = 0; j < count; j++) {
			const double v = get(api, out, j);
			uint64_t bits;
			memcpy(&bits, &v, sizeof bits);
			hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
			hash ^= hash >> 29;
		}
		ring_free(&ring);
	}
	return hash;
}

static void test_targets(void)
{
	const unsigned targets = ew_targets();
	const uint64_t best = digest();
	unsigned highest = 0;
	check_begin("targets");
	expect(targets & EW_PORTABLE, "portable is not there");
	expect(ew_version()[0] != 0, "no version");
	for (unsigned bit = 1; bit; bit <<= 1) {
		if (targets & bit)
			highest = bit;
		else
			expect(ew_use_target(bit) == EW_UNSUPPORTED, "target %#x is not refused",
				bit);
	}
	expect(ew_use_target(highest) == EW_OK && digest() == best,
		"the best target is not the last");
	for (unsigned bit = 1; bit; bit <<= 1) {
		if (!(targets & bit))
			continue;
		expect(ew_use_target(bit) == EW_OK, "target %#x is refused", bit);
		const uint64_t forced = digest();
		expect(bit == EW_PORTABLE || forced == best, "%s has other bits",
			ew_target_name(bit));
		expect(bit != EW_PORTABLE || targets == EW_PORTABLE || forced != best,
			"forcing portable changes nothing");
		expect(ew_use_target(~targets) == EW_UNSUPPORTED,
			"unknown targets are not refused");
		expect(ew_use_target(bit | ~targets) == EW_UNSUPPORTED, "a mixture is not refused");
		expect(ew_use_target(targets) == (targets & (targets - 1) ? EW_UNSUPPORTED : EW_OK),
			"several targets are not refused");
		expect(digest() == forced, "a refused target changed %s", ew_target_name(bit));
	}
	expect(ew_use_target(0) == EW_OK && digest() == best, "0 is not the best target");
	check_end();
}

static void test_names(void)
{
	check_begin("names of targets");
	expect(strcmp(ew_target_name(EW_PORTABLE), "portable") == 0, "portable is called %s",
		ew_target_name(EW_PORTABLE));
	expect(strcmp(ew_target_name(EW_FMA), "fma") == 0, "fma is called %s",
		ew_target_name(EW_FMA));
	expect(strcmp(ew_target_name(0), "unknown") == 0, "0 has a name");
	expect(strcmp(ew_target_name(3), "unknown") == 0, "3 has a name");
	expect(strcmp(ew_target_name(0x80000000u), "unknown") == 0, "the highest bit has a name");
	check_end();
	for (unsigned bit = 1; bit; bit <<= 1) {
		if (!(ew_targets() & bit) && strcmp(ew_target_name(bit), "unknown") != 0)
			printf("skip %s\n", ew_target_name(bit));
	}
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	test_names();
	test_targets();
	for_each_target(test_guards);
	for_each_target(test_canaries);
	for_each_target(test_alignment);
	for_each_target(test_nonfinite);
	for_each_target(test_nonfinite_parameters);
	for_each_target(test_bad_degree);
	return check_finish();
}

/* Many rings in one call: ew_area_rings, ew_centroid_rings and ew_moments_rings.
 *
 * The result of each ring is, bit for bit, what the function for one ring gives on the same target,
 * whatever the other rings are: short and long ones, closed and implied, empty, of area 0, huge,
 * tiny, or not finite. (The two zeros are one.) Nothing is read besides the vertices of the rings
 * and their offsets, all of which touch inaccessible pages, and nothing is written besides the
 * results. Bad offsets and bad degrees are refused before anything is written.
 *
 * Last, what that is for: polygons of size 10 at (5e5, 4e6) keep their accuracy, against exact
 * rationals.
 */
#include "guarded.h"

#include <limits.h>

#include "edgewise_runtime.h"
#include "rings.h"

/* What is called: the area, the centroid, or all moments to a degree. */
enum { AREA = -2, CENTROID = -1, FIRST = AREA, LAST = EW_MAX_DEGREE };

static int call(const Api *api, int what, const void *x, const void *y, const int32_t *offsets,
	size_t rings, void *out)
{
	void *second = (char *)out + rings * api->size;
	const bool narrow = api->bits == 24;
	if (what == AREA)
		return narrow ? ew_area_ringsf(x, y, offsets, rings, out)
			: ew_area_rings(x, y, offsets, rings, out);
	if (what == CENTROID)
		return narrow ? ew_centroid_ringsf(x, y, offsets, rings, out, second)
			: ew_centroid_rings(x, y, offsets, rings, out, second);
	return narrow ? ew_moments_ringsf(what, x, y, offsets, rings, out)
		: ew_moments_rings(what, x, y, offsets, rings, out);
}

static size_t outputs(int what)
{
	return what == AREA ? 1 : what == CENTROID ? 2 : (size_t)ref_count(what);
}

/* Rings, as the library reads them. */

typedef struct {
	const Api *api;
	size_t rings;
	int32_t *offsets;
	void *x, *y;
} Batch;

/* How large are the rings? */
typedef enum { ANY, SMALL, BORDER, EQUAL, NEARLY_EMPTY, SIZES } Sizes;

static int random_size(Sizes sizes, int equal)
{
	switch (sizes) {
	case ANY: return random_int(0, 100);
	case SMALL: return random_int(4, 12);
	case BORDER: return random_int(EW_SHORT - 3, EW_SHORT + 2);
	case EQUAL: return equal;
	default: return random_int(0, 4);
	}
}

static size_t batch_end(const Batch *b)
{
	return b->offsets ? (size_t)b->offsets[b->rings] : 0;
}

/* A ring of random shape and, by chance, one that repeats its first vertex or has no area. */
static void fill_ring(const Batch *b, size_t ring)
{
	const size_t start = (size_t)b->offsets[ring], end = (size_t)b->offsets[ring + 1];
	const double cx = random_real(-3, 3), cy = random_real(-3, 3);
	const bool flat = random_int(0, 9) == 0;
	for (size_t i = start; i < end; i++) {
		put(b->api, b->x, i, cx + random_real(-1, 1));
		put(b->api, b->y, i, flat ? cy : cy + random_real(-1, 1));
	}
	if (end > start && random_int(0, 1)) {
		put(b->api, b->x, end - 1, get(b->api, b->x, (int)start));
		put(b->api, b->y, end - 1, get(b->api, b->y, (int)start));
	}
}

/* Vertices before the first offset are no numbers. */
static Batch batch_new(const Api *api, size_t rings, size_t first, Sizes sizes, int equal)
{
	Batch b = { api, rings, allocate((rings + 1) * sizeof(int32_t)), NULL, NULL };
	b.offsets[0] = (int32_t)first;
	for (size_t i = 0; i < rings; i++)
		b.offsets[i + 1] = b.offsets[i] + random_size(sizes, equal);
	b.x = allocate(batch_end(&b) * api->size);
	b.y = allocate(batch_end(&b) * api->size);
	memset(b.x, 0xff, first * api->size);
	memset(b.y, 0xff, first * api->size);
	for (size_t i = 0; i < rings; i++)
		fill_ring(&b, i);
	return b;
}

static void batch_free(Batch *b)
{
	free(b->offsets);
	free(b->x);
	free(b->y);
}

static size_t ring_size(const Batch *b, size_t ring)
{
	return (size_t)(b->offsets[ring + 1] - b->offsets[ring]);
}

/* Results of one ring alone, to one[0 .. outputs(what) - 1]. */
static void call_alone(const Batch *b, int what, size_t ring, void *one)
{
	const size_t start = (size_t)b->offsets[ring] * b->api->size, n = ring_size(b, ring);
	const void *x = (char *)b->x + start, *y = (char *)b->y + start;
	if (what == AREA)
		put(b->api, one, 0, b->api->area(x, y, n));
	else if (what == CENTROID)
		b->api->centroid(x, y, n, one);
	else
		b->api->moments(what, x, y, n, one);
}

static bool same_number(double a, double b)
{
	return same_bits(a, b) || (isnan(a) && isnan(b));
}

/* Is the result of this ring what it is alone? */
static bool expect_ring(const Batch *b, int what, size_t ring, const void *out)
{
	double one[MOMENTS];
	const size_t each = outputs(what);
	call_alone(b, what, ring, one);
	for (size_t j = 0; j < each; j++) {
		const size_t place = what == CENTROID ? j * b->rings + ring : ring * each + j;
		const double got = get(b->api, out, (int)place), want = get(b->api, one, (int)j);
		if (!expect(same_number(got, want), "call %d, ring %zu of %zu with %zu vertices: "
			"result %zu is %a, alone %a", what, ring, b->rings, ring_size(b, ring), j,
			got, want))
			return false;
	}
	return true;
}

/* Everything between guard pages. */

enum { X, Y, OFFSETS, OUT, ARRAYS };
enum { CANARY = 0x88, MOST_RINGS = 40, ROOM = MOST_RINGS * 101 * 8 };

static Guarded guarded[ARRAYS];

/* Coordinates at the front begin with the first offset: nothing before is read either. */
static const void *place_vertices(const Batch *b, int array, const void *data, bool back)
{
	const size_t first = b->offsets ? (size_t)b->offsets[0] * b->api->size : 0;
	const size_t bytes = batch_end(b) * b->api->size - first;
	char *place = guarded_put(&guarded[array], (const char *)data + first, bytes, back, CANARY);
	return place - first;
}

static void expect_call(const Batch *b, int what, bool back)
{
	const size_t results = b->rings * outputs(what) * b->api->size;
	const void *x = place_vertices(b, X, b->x, back), *y = place_vertices(b, Y, b->y, back);
	const int32_t *offsets = guarded_put(&guarded[OFFSETS], b->offsets,
		(b->rings + 1) * sizeof *offsets, back, CANARY);
	guarded_put(&guarded[OUT], NULL, 0, back, CANARY);
	void *out = guarded_place(&guarded[OUT], results, back);
	const int said = call(b->api, what, x, y, offsets, b->rings, out);
	expect(said == EW_OK, "call %d of %zu rings returns %d", what, b->rings, said);
	for (size_t i = 0; i < b->rings && expect_ring(b, what, i, out); i++)
		;
	expect(guarded_kept(&guarded[OUT], out, results, CANARY),
		"call %d of %zu rings writes besides its results", what, b->rings);
}

static void expect_calls(const Batch *b)
{
	for (int what = FIRST; what <= LAST; what++) {
		expect_call(b, what, false);
		expect_call(b, what, true);
	}
}

static void test_mixes(const Api *api, const char *target)
{
	check_begin("mixed sizes between guard pages, %s, %s", api->name, target);
	for (int round = 0; round < 60; round++) {
		const size_t rings = (size_t)random_int(1, MOST_RINGS);
		const size_t first = round % 2 ? (size_t)random_int(0, 300) : 0;
		Batch b = batch_new(api, rings, first, (Sizes)(round % SIZES), random_int(3, 40));
		expect_calls(&b);
		batch_free(&b);
	}
	check_end();
}

static void test_sizes(const Api *api, const char *target)
{
	check_begin("equal sizes, %s, %s", api->name, target);
	for (int n = 0; n <= EW_SHORT + 4; n++) {
		Batch b = batch_new(api, (size_t)random_int(1, MOST_RINGS), 0, EQUAL, n);
		expect_calls(&b);
		batch_free(&b);
	}
	check_end();
	check_begin("numbers of rings, %s, %s", api->name, target);
	for (size_t rings = 0; rings <= MOST_RINGS; rings++) {
		Batch b = batch_new(api, rings, 5, rings % 2 ? SMALL : BORDER, 0);
		expect_calls(&b);
		batch_free(&b);
	}
	check_end();
}

/* One ring that is shorter than the others of its group, at the very end of the arrays. */
static void test_last(const Api *api, const char *target)
{
	check_begin("a short ring at the end, %s, %s", api->name, target);
	for (int n = 3; n <= EW_SHORT; n++) {
		for (size_t rings = 2; rings <= 17; rings += 5) {
			Batch b = batch_new(api, rings, 0, EQUAL, EW_SHORT - 1);
			const int32_t cut = b.offsets[rings - 1] + n;
			if (cut < b.offsets[rings])
				b.offsets[rings] = cut;
			expect_calls(&b);
			batch_free(&b);
		}
	}
	check_end();
}

static void test_none(const Api *api, const char *target)
{
	char out[64];
	check_begin("no rings, %s, %s", api->name, target);
	memset(out, CANARY, sizeof out);
	for (int what = FIRST; what <= LAST; what++) {
		expect(call(api, what, NULL, NULL, NULL, 0, out) == EW_OK,
			"call %d of no rings is refused", what);
		expect(call(api, what, NULL, NULL, (int32_t[]){ 7 }, 0, out) == EW_OK,
			"call %d of no rings with an offset is refused", what);
	}
	expect(guarded_filled(out, out + sizeof out, CANARY), "no rings give results");
	check_end();
}

/* Coordinates of every size. */
static void test_scales(const Api *api, const char *target)
{
	const int low = api->bits == 24 ? -149 : -1074, high = api->bits == 24 ? 127 : 1023;
	check_begin("huge and tiny coordinates, %s, %s", api->name, target);
	for (int round = 0; round < 200; round++) {
		Batch b = batch_new(api, (size_t)random_int(1, MOST_RINGS), 0,
			round % 2 ? SMALL : BORDER, 0);
		for (size_t ring = 0; ring < b.rings; ring++) {
			const int scale = random_int(low, high), span = random_int(0, high);
			for (int i = b.offsets[ring]; i < b.offsets[ring + 1]; i++) {
				const int least = scale - span < low ? low : scale - span;
				put(api, b.x, (size_t)i, random_scaled(least, scale));
				put(api, b.y, (size_t)i, random_scaled(least, scale));
			}
		}
		for (int what = FIRST; what <= LAST; what++)
			expect_call(&b, what, round / 2 % 2);
		batch_free(&b);
	}
	check_end();
}

/* A ring that is not finite. */

static void expect_unharmed(Batch *b, size_t ring)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	double out[MOST_RINGS * MOMENTS];
	const size_t vertex = (size_t)random_int(b->offsets[ring], b->offsets[ring + 1] - 1);
	void *place = random_int(0, 1) ? b->x : b->y;
	const double kept = get(b->api, place, (int)vertex);
	put(b->api, place, vertex, bad[random_int(0, 2)]);
	for (int what = FIRST; what <= LAST; what++) {
		call(b->api, what, b->x, b->y, b->offsets, b->rings, out);
		for (size_t i = 0; i < b->rings; i++)
			expect_ring(b, what, i, out);
	}
	put(b->api, place, vertex, kept);
}

static void test_nonfinite(const Api *api, const char *target)
{
	check_begin("a ring with NaN or infinity, %s, %s", api->name, target);
	for (int round = 0; round < 12; round++) {
		Batch b = batch_new(api, MOST_RINGS, 0, (Sizes)(round % SIZES), 10);
		for (size_t ring = 0; ring < b.rings; ring++) {
			if (ring_size(&b, ring))
				expect_unharmed(&b, ring);
		}
		batch_free(&b);
	}
	check_end();
}

/* A centroid of area 0. */
static void test_zero_area(const Api *api, const char *target)
{
	double out[2 * MOST_RINGS];
	check_begin("centroid of a ring without area, %s, %s", api->name, target);
	for (int n = 0; n <= 30; n++) {
		Batch b = batch_new(api, 20, 0, EQUAL, n);
		for (size_t i = 0; i < 10 * (size_t)n; i++)
			put(api, b.y, i, 3);
		expect(call(api, CENTROID, b.x, b.y, b.offsets, b.rings, out) == EW_OK,
			"n = %d: not EW_OK", n);
		for (int ring = 0; ring < (n < 3 ? 20 : 10); ring++)
			expect(isnan(get(api, out, ring)) && isnan(get(api, out, 20 + ring)),
				"n = %d: ring %d of area 0 has the centroid %g", n, ring,
				get(api, out, ring));
		batch_free(&b);
	}
	check_end();
}

/* More than a row of rings, some not finite, with results that begin anywhere in a cache line. */

static void spoil(const Batch *b)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	for (size_t ring = 0; ring < b->rings; ring++) {
		if (ring_size(b, ring) == 0 || random_int(0, 19))
			continue;
		const int at = random_int(b->offsets[ring], b->offsets[ring + 1] - 1);
		put(b->api, random_int(0, 1) ? b->x : b->y, (size_t)at, bad[random_int(0, 2)]);
	}
}

static void expect_many(const Batch *b, int what, size_t shift)
{
	const size_t results = b->rings * outputs(what) * b->api->size;
	char *all = allocate(results + 256);
	char *out = all + 64 - (uintptr_t)all % 64 + shift * b->api->size;
	memset(all, CANARY, results + 256);
	expect(call(b->api, what, b->x, b->y, b->offsets, b->rings, out) == EW_OK, "refused");
	for (size_t i = 0; i < b->rings && expect_ring(b, what, i, out); i++)
		;
	expect(guarded_filled(all, out, CANARY)
		&& guarded_filled(out + results, all + results + 256, CANARY),
		"call %d of %zu rings writes besides its results", what, b->rings);
	free(all);
}

static void test_many(const Api *api, const char *target)
{
	check_begin("many rings, %s, %s", api->name, target);
	for (int round = 0; round < 6 * SIZES; round++) {
		Batch b = batch_new(api, (size_t)random_int(EW_ROW - 1, 10 * EW_ROW), 0,
			(Sizes)(round % SIZES), random_int(3, 40));
		if (round % 2)
			spoil(&b);
		for (int what = FIRST; what <= LAST; what++)
			expect_many(&b, what, (size_t)random_int(0, 64 / (int)api->size - 1));
		batch_free(&b);
	}
	check_end();
}

/* What is refused. */

static void expect_refused(const Batch *b, const int32_t *offsets, size_t rings, const char *what)
{
	static char out[MOST_RINGS * MOMENTS * sizeof(double)];
	memset(out, CANARY, sizeof out);
	for (int w = FIRST; w <= LAST; w++)
		expect(call(b->api, w, b->x, b->y, offsets, rings, out) == EW_BAD_OFFSETS,
			"call %d of %zu rings: %s is not refused", w, rings, what);
	expect(guarded_filled(out, out + sizeof out, CANARY), "%s of %zu rings: written", what,
		rings);
}

static void test_bad_offsets(const Api *api, const char *target)
{
	int32_t bad[MOST_RINGS + 1];
	Batch b = batch_new(api, MOST_RINGS, 50, SMALL, 0);
	check_begin("bad offsets, %s, %s", api->name, target);
	for (size_t rings = 1; rings <= b.rings; rings++) {
		for (size_t at = 0; at <= rings; at++) {
			memcpy(bad, b.offsets, sizeof bad);
			bad[at] = at ? bad[at - 1] - 1 : -1;
			expect_refused(&b, bad, rings, "one too low");
			bad[at] = INT32_MIN;
			expect_refused(&b, bad, rings, "the lowest");
			bad[at] = INT32_MAX;
			if (at < rings)
				expect_refused(&b, bad, rings, "the highest");
		}
	}
	check_end();
	batch_free(&b);
}

static void test_bad_degree(const Api *api, const char *target)
{
	static const int bad[] = { -1, EW_MAX_DEGREE + 1, INT_MIN, INT_MAX };
	char out[64];
	Batch b = batch_new(api, 3, 0, SMALL, 0);
	check_begin("degree out of range, %s, %s", api->name, target);
	memset(out, CANARY, sizeof out);
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
		const int said = api->bits == 24
			? ew_moments_ringsf(bad[i], b.x, b.y, b.offsets, 3, (float *)out)
			: ew_moments_rings(bad[i], b.x, b.y, b.offsets, 3, (double *)out);
		expect(said == EW_BAD_DEGREE, "degree %d gives %d", bad[i], said);
	}
	expect(guarded_filled(out, out + sizeof out, CANARY), "a refused call writes");
	check_end();
	batch_free(&b);
}

/* Far from the origin. */

static double error_of(double got, const mpq_t exact)
{
	mpq_t off;
	mpq_init(off);
	mpq_set_d(off, got);
	mpq_sub(off, off, exact);
	const double error = fabs(mpq_get_d(off));
	mpq_clear(off);
	return error;
}

static double ulp(double v)
{
	return nextafter(fabs(v), INFINITY) - fabs(v);
}

/* The integral of |x^m y^n| is at most this, by Cauchy and Schwarz: m and n made even. */
static double scale_of(const Ref *central, int m, int n)
{
	const int dm = m % 2, dn = n % 2;
	const int low = ref_index(m - dm, dm ? n + dn : n - dn);
	const int high = ref_index(m + dm, dm ? n - dn : n + dn);
	return sqrt(mpq_get_d(central[low].value)) * sqrt(mpq_get_d(central[high].value));
}

/* Worst errors so far: area relative, centroid in ulps, central moments relative to their scale. */
typedef struct {
	double area, centroid, central;
} Worst;

static void measure(const double *x, const double *y, size_t n, Worst *worst)
{
	const int32_t offsets[2] = { 0, (int32_t)n };
	double area, c[2], out[MOMENTS];
	Ref *about = ref_new(MOMENTS), *central = ref_new(MOMENTS);
	mpq_t to[2];
	mpq_inits(to[0], to[1], NULL);
	ref_ring(about, EW_MAX_DEGREE, x, y, n);
	for (int i = 0; i < 2; i++)
		mpq_div(to[i], about[1 + i].value, about[0].value);
	ew_area_rings(x, y, offsets, 1, &area);
	ew_centroid_rings(x, y, offsets, 1, &c[0], &c[1]);
	worst->area = fmax(worst->area,
		error_of(area, about[0].value) / mpq_get_d(about[0].value));
	for (int i = 0; i < 2; i++) {
		worst->centroid = fmax(worst->centroid,
			error_of(c[i], to[i]) / ulp(mpq_get_d(to[i])));
		mpq_neg(to[i], to[i]);
	}
	ref_translate(central, EW_MAX_DEGREE, about, to[0], to[1]);
	ew_central_moments(EW_MAX_DEGREE, x, y, n, c, out);
	for (int m = 0; m <= EW_MAX_DEGREE; m++) {
		for (int k = 0; m + k <= EW_MAX_DEGREE; k++) {
			const int i = ref_index(m, k);
			const double error = error_of(out[i], central[i].value);
			if (m + k != 1)
				worst->central = fmax(worst->central,
					error / scale_of(central, m, k));
		}
	}
	mpq_clears(to[0], to[1], NULL);
	ref_free(about, MOMENTS);
	ref_free(central, MOMENTS);
}

static void test_far(const Api *api, const char *target)
{
	Worst worst = { 0, 0, 0 };
	if (api->bits == 24)
		return;         /* a float is off by a quarter there */
	check_begin("size 10 at (5e5, 4e6), %s, %s", api->name, target);
	for (int i = 0; i < 400; i++) {
		Ring ring = ring_new((size_t)random_int(5, 20));
		ring_star(&ring, 5e5, 4e6, 10);
		measure(ring.x, ring.y, ring.n, &worst);
		ring_free(&ring);
	}
	expect(worst.area <= 1e-15, "area is off by %.3g of itself", worst.area);
	expect(worst.centroid <= 1, "centroid is off by %.3g ulps", worst.centroid);
	expect(worst.central <= 1e-13, "a central moment is off by %.3g", worst.central);
	check_end();
	printf("# worst: area %.2g, centroid %.3g ulps, central moments %.2g\n", worst.area,
		worst.centroid, worst.central);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	for (int i = 0; i < ARRAYS; i++)
		guarded[i] = guarded_new(ROOM);
	for_each_target(test_mixes);
	for_each_target(test_sizes);
	for_each_target(test_last);
	for_each_target(test_none);
	for_each_target(test_scales);
	for_each_target(test_nonfinite);
	for_each_target(test_zero_area);
	for_each_target(test_many);
	for_each_target(test_bad_offsets);
	for_each_target(test_bad_degree);
	for_each_target(test_far);
	return check_finish();
}

/* Images: what is refused, and that nothing is touched then or read beside the arrays.
 *
 * Every argument of ew_raster, ew_raster_u8 and ew_raster_path is spoilt in turn: the call must
 * return the code for it, and not a byte of the pixels may have changed. What is unusual but right
 * must be drawn: no rings, empty ones, offsets that do not begin at 0, images without pixels or of
 * one row. Inputs and pixels stand at the edge of inaccessible pages.
 */
#include "guarded.h"

#include "raster_calls.h"

#include <limits.h>

static const ew_filter *const some_filters[] = { &ew_filter_box, &ew_filter_tent };

typedef void CallTest(Drawing *d, const DrawCall *good);

/* For every function, precision and two filters. */
static void for_each_call(const char *name, CallTest *test)
{
	Drawing d;
	check_begin("%s", name);
	for (int i = 0; i < CALL_KINDS * APIS * 2; i++) {
		const DrawCall good = drawing(&d, i / 4, &apis[i % 2], some_filters[i / 2 % 2]);
		test(&d, &good);
	}
	check_end();
}

static void test_good(Drawing *d, const DrawCall *good)
{
	(void)d;
	const int code = draw(good);
	expect(code == EW_OK, "%s, %s: code %d", call_name(good), good->api->name, code);
	expect(!paper_blank(), "%s, %s: nothing drawn", call_name(good), good->api->name);
}

/* ---- Images ---- */

static void test_images(Drawing *d, const DrawCall *good)
{
	(void)d;
	static const int negative[] = { -1, INT_MIN, -WIDE };
	static const ptrdiff_t strides[] = {
		0, 1, -1, WIDE - 1, 1 - WIDE, PTRDIFF_MAX, PTRDIFF_MIN, PTRDIFF_MAX / 2,
		PTRDIFF_MIN / 2, PTRDIFF_MAX / HIGH + 1, -(PTRDIFF_MAX / HIGH + 1)
	};
	DrawCall c = *good;
	for (int i = 0; i < 3; i++) {
		c.width = negative[i];
		expect_refused(&c, EW_BAD_IMAGE, "negative width");
		c.width = WIDE;
		c.height = negative[i];
		expect_refused(&c, EW_BAD_IMAGE, "negative height");
		c.height = HIGH;
	}
	for (size_t i = 0; i < sizeof strides / sizeof *strides; i++) {
		char what[60];
		snprintf(what, sizeof what, "stride %td", strides[i]);
		c.stride = strides[i];
		expect_refused(&c, EW_BAD_IMAGE, what);
	}
	c = *good;
	c.pixels = NULL;
	expect_refused(&c, EW_BAD_IMAGE, "no pixels");
	c = *good;
	c.filter = NULL;
	if (c.kind != CALL_BYTES)
		expect_refused(&c, EW_BAD_IMAGE, "no filter");
}

/* Arrays that are not there: a bad image, or as what they would be. */
static void test_null(Drawing *d, const DrawCall *good)
{
	const bool path = good->kind == CALL_PATH;
	const int other = path ? EW_BAD_PATH : EW_BAD_OFFSETS;
	DrawCall c = *good;
	(void)d;
	c.x = NULL;
	expect_either(&c, EW_BAD_IMAGE, path ? other : EW_BAD_IMAGE, path ? "no points" : "no x");
	c = *good;
	c.y = NULL;
	expect_either(&c, EW_BAD_IMAGE, path ? other : EW_BAD_IMAGE, path ? "no weights" : "no y");
	c = *good;
	c.offsets = NULL;
	c.verbs = NULL;
	expect_either(&c, EW_BAD_IMAGE, other, path ? "no verbs" : "no offsets");
}

/* Sizes and distances no memory has. */
static void test_overflow(Drawing *d, const DrawCall *good)
{
	(void)d;
	DrawCall c = *good;
	c.width = c.height = INT_MAX;
	c.stride = PTRDIFF_MAX;
	expect_refused(&c, EW_BAD_IMAGE, "largest of all");
	c.width = WIDE;
	c.stride = PTRDIFF_MAX / INT_MAX * 4;
	expect_refused(&c, EW_BAD_IMAGE, "as high as can be");
}

static void test_empty(Drawing *d, const DrawCall *good)
{
	(void)d;
	DrawCall c = *good;
	for (int i = 0; i < 6; i++) {
		c.width = i & 1 ? 0 : WIDE;
		c.height = i & 1 ? i & 2 ? 0 : HIGH : 0;
		c.stride = c.width;
		c.pixels = i < 4 ? good->pixels : NULL;
		expect_refused(&c, EW_OK, "no pixels in it");
	}
}

/* One row may have any stride. */
static void test_one_row(Drawing *d, const DrawCall *good)
{
	(void)d;
	static const ptrdiff_t strides[] = { 0, 1, -1, WIDE, PTRDIFF_MAX, PTRDIFF_MIN };
	const size_t bytes = WIDE * call_element(good);
	unsigned char want[WIDE * sizeof(float)];
	DrawCall c = *good;
	c.height = 1;
	for (size_t i = 0; i < sizeof strides / sizeof *strides; i++) {
		c.stride = strides[i];
		paper_new();
		expect(draw(&c) == EW_OK, "%s, stride %td", call_name(&c), c.stride);
		if (i == 0)
			memcpy(want, c.pixels, bytes);
		expect(memcmp(c.pixels, want, bytes) == 0, "%s, stride %td: other pixels",
			call_name(&c), c.stride);
	}
}

/* ---- Rings ---- */

static void test_offsets(Drawing *d, const DrawCall *good)
{
	static const int32_t bad[][3] = {
		{ -1, 5, 9 }, { INT32_MIN, 5, 9 }, { 1, -5, 9 }, { 1, 5, -9 }, { 1, 5, 4 },
		{ 5, 1, 9 }, { 9, 5, 1 }, { 1, 5, INT32_MIN }, { 1, INT32_MAX, 5 }, { -3, -2, -1 }
	};
	DrawCall c = *good;
	if (c.kind == CALL_PATH)
		return;
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
		memcpy(d->offsets, bad[i], sizeof bad[i]);
		expect_refused(&c, EW_BAD_OFFSETS, "bad offsets");
	}
}

static void expect_zeros(const DrawCall *c, const char *what)
{
	const size_t bytes = WIDE * HIGH * call_element(c);
	paper_new();
	const int code = draw(c);
	expect(code == EW_OK, "%s, %s: code %d", call_name(c), what, code);
	for (size_t i = 0; i < bytes; i++)
		expect(((unsigned char *)c->pixels)[i] == 0, "%s, %s: byte %zu is not 0",
			call_name(c), what, i);
	memset(c->pixels, PAPER, bytes);
	expect(paper_blank(), "%s, %s: writes beside", call_name(c), what);
}

/* All pixels are written, though there is nothing to see. */
static void test_nothing(Drawing *d, const DrawCall *good)
{
	DrawCall c = *good;
	c.rings = c.points = c.weights = 0;
	expect_zeros(&c, "nothing");
	c.x = c.y = NULL;
	c.offsets = NULL;
	c.verbs = NULL;
	expect_zeros(&c, "null");
	c = *good;
	if (c.kind == CALL_PATH)
		return;
	for (int32_t first = 0; first < 3; first++) {
		for (int32_t n = 0; n < 3; n++) {
			d->offsets[0] = first;
			d->offsets[1] = first + n;
			d->offsets[2] = first + 2 * n;
			expect_zeros(&c, "rings of two vertices at most");
		}
	}
}

/* Vertices of no ring are not looked at. */
static void test_unused(Drawing *d, const DrawCall *good)
{
	if (good->kind == CALL_PATH)
		return;
	put(good->api, d->number[good->api - apis][0], 0, NAN);
	put(good->api, d->number[good->api - apis][1], 0, INFINITY);
	expect(draw(good) == EW_OK, "%s: looks at a vertex before the first offset",
		call_name(good));
}

/* ---- Coordinates ---- */

static void test_coordinates(Drawing *d, const DrawCall *good)
{
	const double bad[] = { NAN, INFINITY, -INFINITY, 0x1.000002p30, -0x1.000002p30,
		good->api->bits == 24 ? (double)FLT_MAX : 1e300 };
	const bool path = good->kind == CALL_PATH;
	void *number[2] = { d->number[good->api - apis][0], d->number[good->api - apis][1] };
	for (int i = path ? 0 : 2; i < 2 * DRAWN; i++) {
		void *at = number[path ? 0 : i % 2];
		const int index = path ? i : i / 2;
		const double was = get(good->api, at, index);
		for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
			char what[60];
			snprintf(what, sizeof what, "%g at %d", bad[k], i);
			put(good->api, at, (size_t)index, bad[k]);
			expect_refused(good, EW_BAD_COORDINATE, what);
		}
		put(good->api, at, (size_t)index, i % 4 < 2 ? 0x1p30 : -0x1p30);
		expect(draw(good) == EW_OK, "%s: 2^30 at %d is refused", call_name(good), i);
		put(good->api, at, (size_t)index, was);
	}
}

/* ---- Paths ---- */

static void test_weights(Drawing *d, const DrawCall *good)
{
	static const double bad[] = { NAN, -1, -2, -INFINITY }, fine[] = { 0, -0.5, 1, 1e30 };
	if (good->kind != CALL_PATH)
		return;
	void *weight = d->number[good->api - apis][1];
	for (int i = 0; i < 4; i++) {
		put(good->api, weight, 0, bad[i]);
		expect_refused(good, EW_BAD_COORDINATE, "a weight of -1 or less, or NaN");
		put(good->api, weight, 0, fine[i]);
		expect(draw(good) == EW_OK, "weight %g is refused", fine[i]);
	}
	put(good->api, weight, 0, INFINITY);
	expect(draw(good) == EW_OK, "an infinite weight is refused");
}

static void test_paths(Drawing *d, const DrawCall *good)
{
	DrawCall c = *good;
	if (c.kind != CALL_PATH)
		return;
	for (int i = 0; i < 6; i++) {
		const unsigned char was = d->verbs[i];
		d->verbs[i] = (unsigned char)(i % 2 ? EW_CLOSE + 1 : 255);
		expect_refused(&c, EW_BAD_PATH, "an unknown verb");
		d->verbs[i] = was;
	}
	d->verbs[0] = EW_LINE;
	expect_refused(&c, EW_BAD_PATH, "a line before any EW_MOVE");
	d->verbs[0] = EW_MOVE;
	for (int more = -1; more < 2; more += 2) {
		c.points = good->points + (size_t)more;
		expect_refused(&c, EW_BAD_PATH, "a point too few or too many");
		c.points = good->points;
		c.weights = good->weights + (size_t)more;
		expect_refused(&c, EW_BAD_PATH, "a weight too few or too many");
		c.weights = good->weights;
	}
	c.points = 0;
	expect_refused(&c, EW_BAD_PATH, "no points");
	c.points = good->points;
	c.rings--;
	expect(draw(&c) == EW_OK, "a path without its last verb, EW_CLOSE, is refused");
	c.rings--;
	expect_refused(&c, EW_BAD_PATH, "points left over");
}

/* ---- Pages ---- */

/* All arrays end or begin at an inaccessible page, inputs are read-only. */
static void test_pages(Drawing *d, const DrawCall *good)
{
	enum { ARRAYS = 5 };
	Guarded g[ARRAYS];
	const size_t element = call_element(good), coordinates = good->kind == CALL_PATH ? 2 : 1;
	unsigned char want[WIDE * HIGH * sizeof(float)];
	for (int i = 0; i < ARRAYS; i++)
		g[i] = guarded_new(2048);
	for (int width = 1; width <= WIDE; width++) {
		for (int side = 0; side < 2; side++) {
			DrawCall c = *good;
			const size_t bytes = (size_t)width * HIGH * element;
			c.width = width;
			c.stride = width;
			expect(draw(&c) == EW_OK, "%s, width %d", call_name(&c), width);
			memcpy(want, c.pixels, bytes);
			c.x = guarded_copy(&g[0], good->x, DRAWN * coordinates * c.api->size, side);
			c.y = guarded_copy(&g[1], good->y, (c.kind == CALL_PATH ? 1 : DRAWN)
				* c.api->size, side);
			c.offsets = guarded_copy(&g[2], d->offsets, sizeof d->offsets, side);
			c.verbs = guarded_copy(&g[3], d->verbs, sizeof d->verbs, side);
			c.pixels = guarded_put(&g[4], want, bytes, side, PAPER);
			expect(draw(&c) == EW_OK && memcmp(c.pixels, want, bytes) == 0,
				"%s, width %d: other pixels", call_name(&c), width);
			expect(guarded_kept(&g[4], c.pixels, bytes, PAPER), "%s, width %d: writes "
				"beside", call_name(&c), width);
		}
	}
	for (int i = 0; i < ARRAYS; i++)
		guarded_free(&g[i]);
}

static const struct {
	const char *name;
	CallTest *test;
} tests[] = {
	{ "what is right is drawn", test_good },
	{ "bad images", test_images },
	{ "arrays of NULL", test_null },
	{ "images that overflow", test_overflow },
	{ "images without pixels", test_empty },
	{ "one row of any stride", test_one_row },
	{ "bad offsets", test_offsets },
	{ "nothing to draw", test_nothing },
	{ "vertices of no ring", test_unused },
	{ "NaN, infinity, too far", test_coordinates },
	{ "bad weights", test_weights },
	{ "malformed paths", test_paths },
	{ "inaccessible pages", test_pages }
};

int main(int argc, char **argv)
{
	check_start(argc, argv);
	list_targets();
	for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) {
		for (int t = 0; t < target_count; t++) {
			char name[100];
			snprintf(name, sizeof name, "%s, %s", tests[i].name,
				ew_target_name(target_bit[t]));
			ew_use_target(target_bit[t]);
			for_each_call(name, tests[i].test);
		}
	}
	ew_use_target(0);
	return check_finish();
}

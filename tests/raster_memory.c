/* Images: scratch memory through EW_MALLOC and EW_FREE, and what happens when there is none.
 *
 * The emitted raster is compiled once more, here, with an allocator that can refuse its k-th call,
 * fills what it gives with rubbish between canaries and counts what is not returned. For every k up
 * to the first that is never reached a call must return EW_NO_MEMORY with the pixels untouched and
 * nothing kept; when it succeeds, its pixels must not depend on the rubbish.
 */
#include <stddef.h>

static void *scratch_allocate(size_t size);
static void scratch_free(void *pointer);

#define EW_MALLOC(size) scratch_allocate(size)
#define EW_FREE(pointer) scratch_free(pointer)

#include "edgewise_raster.c"
#include "edgewise_raster_general.c"

#include "raster_calls.h"

enum { EDGE = 64, CANARY = 0xc5 };

static struct {
	long calls, fail_at, kept, broken;
	unsigned char rubbish;
} scratch;

/* The size stands before the block, canaries before and behind it. */
static void *scratch_allocate(size_t size)
{
	if (scratch.calls++ == scratch.fail_at)
		return NULL;
	unsigned char *all = malloc(size + 2 * EDGE);
	if (!all)
		abort();
	memset(all, CANARY, size + 2 * EDGE);
	memset(all + EDGE, scratch.rubbish, size);
	memcpy(all, &size, sizeof size);
	scratch.kept++;
	return all + EDGE;
}

static void scratch_free(void *pointer)
{
	size_t size;
	if (!pointer)
		return;
	unsigned char *all = (unsigned char *)pointer - EDGE;
	memcpy(&size, all, sizeof size);
	for (size_t i = sizeof size; i < EDGE; i++)
		scratch.broken += all[i] != CANARY;
	for (size_t i = 0; i < EDGE; i++)
		scratch.broken += all[EDGE + size + i] != CANARY;
	scratch.kept--;
	free(all);
}

static void scratch_start(long fail_at, unsigned char rubbish)
{
	memset(&scratch, 0, sizeof scratch);
	scratch.fail_at = fail_at;
	scratch.rubbish = rubbish;
}

/* ---- Drawings of every size ---- */

enum { MANY = 5000, LARGE = 700 };

typedef struct {
	const char *name;
	size_t n;
	int width, height;
} Case;

static const Case cases[] = {
	{ "small", 10, 16, 16 }, { "wide", 10, LARGE, 3 }, { "high", 10, 3, LARGE },
	{ "large", 100, LARGE, LARGE }, { "many edges", MANY, 200, 200 },
	{ "many edges in few pixels", MANY, 8, 8 }
};

enum { CASES = sizeof cases / sizeof *cases };

static unsigned char verbs[MANY];
static double numbers[2][2 * MANY];             /* both precisions, x before y */
static double ones[APIS][MANY];
static int32_t offsets[2];
static unsigned char image[2][LARGE * LARGE * sizeof(float)];

/* A self-intersecting ring, larger than the image; as a path, cubics. */
static DrawCall drawing_of(const Case *c, int kind, const Api *api, const ew_filter *filter)
{
	const size_t n = kind == CALL_PATH ? c->n / 3 * 3 + 1 : c->n;
	const size_t stride = kind == CALL_PATH ? 2 : 1;
	void *x = numbers[0], *y = numbers[1];
	for (size_t i = 0; i < n; i++) {
		const double px = random_real(-5, c->width + 5);
		const double py = random_real(-5, c->height + 5);
		put(api, x, stride * i, px);
		put(api, kind == CALL_PATH ? x : y, stride * i + (kind == CALL_PATH), py);
		verbs[i] = i ? EW_CUBIC : EW_MOVE;
	}
	offsets[1] = (int32_t)n;
	return (DrawCall){ kind, api, filter, x, kind == CALL_PATH ? ones[0] : y, offsets,
		kind == CALL_PATH ? (n - 1) / 3 + 1 : 1, n, 0, verbs, image[0], c->width,
		c->height, c->width };
}

static bool untouched(const DrawCall *c, size_t bytes)
{
	const unsigned char *p = c->pixels;
	return p[0] == PAPER && memcmp(p, p + 1, bytes - 1) == 0;
}

static void test_case(const Case *c, int kind, const Api *api, const RasterFilter *filter)
{
	check_begin("no memory: %s, %s, %s, %s", c->name, filter->name, api->name,
		kind == CALL_PATH ? "path" : kind == CALL_BYTES ? "bytes" : "rings");
	DrawCall call = drawing_of(c, kind, api, filter->filter);
	const size_t bytes = (size_t)(c->width * c->height) * call_element(&call);
	int code = EW_NO_MEMORY;
	long k = 0;
	for (; code == EW_NO_MEMORY && k < 1000; k++) {
		memset(call.pixels, PAPER, bytes);
		scratch_start(k, 0xff);
		code = draw(&call);
		expect(scratch.kept == 0 && scratch.broken == 0, "call %ld: %ld blocks kept, %ld "
			"canaries broken", k, scratch.kept, scratch.broken);
		if (scratch.calls <= k)
			break;
		expect(code == EW_NO_MEMORY, "without call %ld: code %d", k, code);
		expect(untouched(&call, bytes), "without call %ld: pixels are touched", k);
	}
	expect(code == EW_OK, "after %ld calls: code %d", k, code);
	call.pixels = image[1];
	scratch_start(-1, 0x37);
	expect(draw(&call) == EW_OK && memcmp(image[0], image[1], bytes) == 0,
		"pixels depend on what is in fresh memory");
	check_end();
	if (k > 0)
		printf("# %s: %ld blocks\n", c->name, k);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	for (int i = 0; i < CASES; i++) {
		for (int f = 0; f < FILTERS; f += 3) {
			for (int a = 0; a < APIS; a++) {
				for (int kind = 0; kind < CALL_KINDS; kind++)
					if (kind != CALL_BYTES || f == 0)
						test_case(&cases[i], kind, &apis[a],
							&raster_filters[f]);
			}
		}
	}
	return check_finish();
}

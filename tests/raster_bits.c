/* Images: what must not change a bit of them.
 *
 * Whole pixels of shift, be it of the rings or of the window on a larger picture, with edges out of
 * every side of it; reversed rings, which negate; the precision of coordinates that both hold; the
 * target among those with fused operations, and for the box among all; stride and sign of it; and
 * nothing beside the pixels is written.
 */
#include "raster.h"

enum { SIDE = 40, MOST = 24 };

/* Multiples of 2^-12 up to 2^9, of 2^-40 in double: also held when moved by some pixels. */
static Scene random_scene(int bits, int kind)
{
	const size_t rings = (size_t)random_int(1, 3);
	Scene s = scene_new(rings * (size_t)random_int(3, MOST), rings);
	s.bits = bits;
	scene_scatter(&s, -10, SIDE + 10);
	if (kind % 4 == 1) {
		for (size_t k = 0; k < rings; k++)
			scene_star(&s, k, SIDE / 2.0, SIDE / 2.0, k % 2 ? -SIDE / 3.0 : SIDE / 2.0,
				0.4);
	}
	if (kind % 4 == 2)
		scene_scatter(&s, -400, 400);
	scene_snap(&s, kind % 4 == 3 ? 0.5 : bits == 24 ? 0x1p-12 : 0x1p-40);
	return s;
}

static void expect_same(const Image *got, const Image *want, int dx, int dy, float sign,
	const char *what)
{
	const int p = image_differs(got, want, dx, dy, sign);
	if (p < 0)
		return;
	const int i = p % got->width, j = p / got->width;
	expect(false, "%s, %d x %d: pixel (%d,%d) is %.9g, not %.9g", what, got->width, got->height,
		i, j, (double)image_at(got, i, j), (double)(sign * image_at(want, i + dx, j + dy)));
}

/* A window on the picture whose corner is at (i,j): the scene is moved instead. */
static void test_crops(const Api *api, const RasterFilter *filter, const char *target)
{
	check_begin("windows on a larger picture have its bits: %s, %s, %s", filter->name,
		api->name, target);
	for (int i = 0; i < 100; i++) {
		Scene s = random_scene(api->bits, i), moved = scene_new(s.n, s.rings);
		Image all = image_of(api, filter, &s, SIDE, SIDE);
		for (int k = 0; k < 8; k++) {
			const int dx = random_int(0, SIDE - 1), dy = random_int(0, SIDE - 1);
			scene_move(&moved, &s, -dx, -dy);
			Image part = image_of(api, filter, &moved, random_int(1, SIDE - dx),
				random_int(1, SIDE - dy));
			expect_same(&part, &all, dx, dy, 1, "window");
			image_free(&part);
		}
		image_free(&all);
		scene_free(&s);
		scene_free(&moved);
	}
	check_end();
}

/* A picture so wide or so high that the scene stands at its far end. */
static void test_moves(const Api *api, const RasterFilter *filter, const char *target)
{
	enum { FAR = 3000, NEAR = 9, WIDTH = 30, HEIGHT = 20 };
	check_begin("moved by whole pixels: %s, %s, %s", filter->name, api->name, target);
	for (int i = 0; i < 16; i++) {
		Scene s = random_scene(api->bits, i / 2), moved = scene_new(s.n, s.rings);
		const int dx = random_int(1, i % 2 ? FAR : NEAR);
		const int dy = random_int(1, i % 2 ? NEAR : FAR);
		scene_move(&moved, &s, dx, dy);
		Image here = image_of(api, filter, &s, WIDTH, HEIGHT);
		Image there = image_of(api, filter, &moved, WIDTH + dx, HEIGHT + dy);
		expect_same(&here, &there, dx, dy, 1, "moved");
		image_free(&here);
		image_free(&there);
		scene_free(&s);
		scene_free(&moved);
	}
	check_end();
}

static void test_reversed(const Api *api, const RasterFilter *filter, const char *target)
{
	check_begin("reversed rings negate: %s, %s, %s", filter->name, api->name, target);
	for (int i = 0; i < 300; i++) {
		const int width = random_int(1, SIDE), height = random_int(1, SIDE);
		Scene s = random_scene(api->bits, i);
		if (i % 5 == 4) {               /* every bit of a float */
			scene_scatter(&s, -3, SIDE + 3);
			scene_pack(&s);
		}
		Image image = image_of(api, filter, &s, width, height);
		scene_reverse(&s);
		Image back = image_of(api, filter, &s, width, height);
		expect_same(&back, &image, 0, 0, -1, "reversed");
		image_free(&image);
		image_free(&back);
		scene_free(&s);
	}
	check_end();
}

/* Targets and precisions: the first image of each class decides. */
static void test_targets(const RasterFilter *filter)
{
	check_begin("the same bits on %s: %s", filter->size == 1 ? "every target"
		: "all targets with fused operations", filter->name);
	for (int i = 0; i < 400; i++) {
		const int width = random_int(1, 3 * SIDE), height = random_int(1, 2 * SIDE);
		Scene s = random_scene(24, i);
		if (i % 3 == 2) {
			scene_scatter(&s, -3, SIDE + 3);
			scene_pack(&s);
		}
		Image first[2] = { { 0 }, { 0 } };
		for (int t = 0; t < target_count * APIS; t++) {
			const unsigned bit = target_bit[t / APIS];
			Image *want = &first[filter->size > 1 && bit == EW_PORTABLE];
			ew_use_target(bit);
			Image image = image_of(&apis[t % APIS], filter, &s, width, height);
			if (want->all) {
				expect_same(&image, want, 0, 0, 1, ew_target_name(bit));
				image_free(&image);
			} else {
				*want = image;
			}
		}
		image_free(&first[0]);
		image_free(&first[1]);
		scene_free(&s);
	}
	check_end();
	ew_use_target(0);
}

/* Elements beside the pixels keep their canary. */
static void expect_canaries(const Image *image)
{
	unsigned char canary[sizeof(float)];
	memset(canary, IMAGE_CANARY, sizeof canary);
	const ptrdiff_t reach = image->stride < 0 ? -image->stride : image->stride;
	for (size_t k = 0; k < image->count; k++) {
		const ptrdiff_t at = (ptrdiff_t)k - IMAGE_MARGIN;
		const bool pixel = image->height > 0 && at >= 0
			&& at < reach * (image->height - 1) + image->width
			&& (reach ? at % reach : at) < image->width;
		const bool kept = memcmp(&image->all[k], canary, sizeof canary) == 0;
		expect(kept != pixel, "%d x %d, stride %td: element %td is %s", image->width,
			image->height, image->stride, at, pixel ? "not written" : "written");
	}
}

static void test_strides(const RasterFilter *filter, const char *target)
{
	check_begin("any size and stride, nothing beside the pixels: %s, %s", filter->name, target);
	for (int i = 0; i < 500; i++) {
		const Api *api = &apis[i % APIS];
		const int width = i < 40 ? i / 2 : random_int(1, 3 * SIDE);
		const int height = i % 7 == 0 ? random_int(0, 1) : random_int(1, SIDE);
		const int more = random_int(0, 1) * random_int(0, 20);
		const ptrdiff_t stride = random_int(0, 1) ? width + more : -width - more;
		Scene s = random_scene(24, i);
		Image plain = image_of(api, filter, &s, width, height);
		Image image = image_new(width, height, stride);
		expect(image_raster(api, filter, &s, &image) == EW_OK, "%d x %d, stride %td", width,
			height, stride);
		expect_canaries(&image);
		expect_same(&image, &plain, 0, 0, 1, "stride");
		image_free(&plain);
		image_free(&image);
		scene_free(&s);
	}
	check_end();
}

/* The same for bytes. */
static void test_byte_strides(const char *target)
{
	enum { MARGIN = 32, CANARY = 0xa5 };
	check_begin("bytes of any stride, nothing beside the pixels: %s", target);
	for (int i = 0; i < 500; i++) {
		const int width = random_int(1, 2 * SIDE), height = random_int(1, SIDE);
		const int reach = width + random_int(0, 9);
		const bool up = i & 1;
		const size_t count = (size_t)(reach * (height - 1) + width);
		unsigned char *all = allocate(count + 2 * MARGIN), *plain = allocate(count);
		unsigned char *first = all + MARGIN + (up ? reach * (height - 1) : 0);
		Scene s = random_scene(24, i);
		memset(all, CANARY, count + 2 * MARGIN);
		expect(ew_raster_u8(s.x, s.y, s.offsets, s.rings, plain, width, height, width)
			== EW_OK && ew_raster_u8f(s.xf, s.yf, s.offsets, s.rings, first, width,
			height, up ? -reach : reach) == EW_OK, "refused");
		for (int j = 0; j < height; j++)
			expect(memcmp(first + (up ? -j : j) * reach, plain + j * width,
				(size_t)width) == 0, "%d x %d, reach %d: row %d differs", width,
				height, reach, j);
		for (int k = 0; k < (int)count + 2 * MARGIN; k++) {
			const int at = k - MARGIN;
			const bool pixel = at >= 0 && at < (int)count && at % reach < width;
			expect(pixel || all[k] == CANARY, "%d x %d, reach %d: writes at %d", width,
				height, reach, at);
		}
		free(all);
		free(plain);
		scene_free(&s);
	}
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	list_targets();
	for (int f = 0; f < FILTERS; f++)
		test_targets(&raster_filters[f]);
	for (int t = 0; t < target_count; t++) {
		const char *name = ew_target_name(target_bit[t]);
		ew_use_target(target_bit[t]);
		for (int f = 0; f < FILTERS; f++) {
			for (int a = 0; a < APIS; a++) {
				test_crops(&apis[a], &raster_filters[f], name);
				test_moves(&apis[a], &raster_filters[f], name);
				test_reversed(&apis[a], &raster_filters[f], name);
			}
			test_strides(&raster_filters[f], name);
		}
		test_byte_strides(name);
	}
	ew_use_target(0);
	return check_finish();
}

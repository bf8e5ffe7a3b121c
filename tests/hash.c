/* hash.c - prints one hash of the bits of many results per target, one for the single edges, and
 * one for images of the box, which are the same on every target, once per target.
 *
 * tests/matrix.sh compares them between compilers, language standards and levels of optimisation,
 * tests/cross.sh between machines and with tests/hashes.txt: a contracted a * b + c, a
 * reassociated sum or a literal read wrongly changes them. Inputs come from an integer generator,
 * so no rounding takes part before the library; all are finite. Neither do the order of bytes and
 * the kind of a NaN, which a ring without area gives. This file is C99 and C++17 alike.
 */
#include "edgewise.h"
#include "edgewise_kernels.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#define FNV_BASIS 0xcbf29ce484222325u
#define FNV_PRIME 0x100000001b3u

enum {
	MOST = 2100, MOMENTS = EW_MOMENTS(EW_MAX_DEGREE), KINDS = 3,
	FIRST = 3, GROWING = 31, MIXED = 24, LONG = 3, BATCH = GROWING + MIXED + LONG,
	VERBS = 1500,
	WIDE = 61, HIGH = 37, SCENE = 40    /* an image, and the vertices it is drawn from */
};

static const size_t sizes[] = { 0, 2, 3, 4, 7, 8, 9, 16, 17, 23, 24, 40, 257, 1040, MOST };

static double x[MOST], y[MOST], xy[2 * MOST];
static float xf[MOST], yf[MOST], xyf[2 * MOST];
static unsigned char verbs[VERBS];
static double weights[VERBS];
static float weightsf[VERBS];
static int32_t offsets[BATCH + 1];
static uint64_t hash, state;

static void add_bits(uint64_t bits)
{
	hash = (hash ^ bits) * FNV_PRIME;
	hash ^= hash >> 32;
}

/* Values as the integers their bits spell, so that the order of bytes takes no part; any NaN
 * counts as the same one, since its sign and payload are nobody's promise. */
#define ADD(REAL, f, WORD) \
static void add##f(const REAL *value, size_t count) \
{ \
	for (size_t i = 0; i < count; i++) { \
		WORD bits; \
		memcpy(&bits, &value[i], sizeof bits); \
		add_bits(value[i] == value[i] ? bits : (uint64_t)-1); \
	} \
}

ADD(double, , uint64_t)
ADD(float, f, uint32_t)

/* Multiples of 2^-23 in [-1,1) for kind 0, of full width for kind 1,
 * integers in -8..8 for kind 2. */
static double coordinate(int kind)
{
	state = state * 6364136223846793005u + 1442695040888963407u;
	const uint64_t bits = state >> 11;
	if (kind == 0)
		return (double)(bits >> 29) * 0x1p-23 - 1;
	return kind == 1 ? (double)bits * 0x1p-51 : (double)(bits % 17) - 8;
}

static void place(size_t i, double px, double py)
{
	xy[2 * i] = x[i] = px;
	xy[2 * i + 1] = y[i] = py;
	xyf[2 * i] = xf[i] = (float)px;
	xyf[2 * i + 1] = yf[i] = (float)py;
}

/* The vertices begin .. end-1; integers close the ring by its first vertex. */
static void fill(size_t begin, size_t end, int kind)
{
	for (size_t i = begin; i < end; i++) {
		const double px = coordinate(kind), py = coordinate(kind);
		place(i, px, py);
	}
	if (kind == 2 && begin < end)
		place(end - 1, x[begin], y[begin]);
}

/* All functions of one precision, for a ring of n vertices. */
#define RINGS(REAL, f) \
static void add_rings##f(size_t n) \
{ \
	REAL out[MOMENTS], moved[MOMENTS], bound[MOMENTS], c[2], one; \
	for (int degree = 0; degree <= EW_MAX_DEGREE; degree++) { \
		const size_t size = (size_t)EW_MOMENTS(degree); \
		ew_moments##f(degree, x##f, y##f, n, out); \
		add##f(out, size); \
		add_bits((uint64_t)ew_moments_bounded##f(degree, x##f, y##f, n, out, bound)); \
		add##f(out, size); \
		add##f(bound, size); \
		ew_translate_moments##f(degree, out, (REAL)0.75, (REAL)-1.3, moved); \
		add##f(moved, size); \
		ew_moments_about##f(degree, x##f, y##f, n, (REAL)0.1, (REAL)0.7, out); \
		add##f(out, size); \
		ew_moments_xy##f(degree, xy##f, n, out); \
		add##f(out, size); \
		add_bits((uint64_t)ew_central_moments##f(degree, x##f, y##f, n, c, out)); \
		add##f(c, 2); \
		add##f(out, size); \
		for (int k = 0; k <= degree; k++) { \
			one = ew_moment##f(degree - k, k, x##f, y##f, n); \
			add##f(&one, 1); \
		} \
	} \
	one = ew_area##f(x##f, y##f, n); \
	add##f(&one, 1); \
	one = ew_area_compensated##f(x##f, y##f, n); \
	add##f(&one, 1); \
	add_bits((uint64_t)ew_centroid##f(x##f, y##f, n, c)); \
	add##f(c, 2); \
}

RINGS(double, )
RINGS(float, f)

/* A batch begins at vertex FIRST: rings of 0 to 30 vertices, then of 4 to 12 mixed, then long
 * ones. */
static void fill_batch(int kind)
{
	static const int32_t lengths[LONG] = { 64, 257, 1040 };
	offsets[0] = FIRST;
	for (int i = 0; i < BATCH; i++) {
		const int32_t length = i < GROWING ? i : i < GROWING + MIXED ? 4 + i * 7 % 9
			: lengths[i - GROWING - MIXED];
		offsets[i + 1] = offsets[i] + length;
		fill((size_t)offsets[i], (size_t)offsets[i + 1], kind);
	}
}

#define BATCHES(REAL, f) \
static void add_batches##f(void) \
{ \
	static REAL out[BATCH * MOMENTS], cy[BATCH]; \
	for (int degree = 0; degree <= EW_MAX_DEGREE; degree++) { \
		add_bits((uint64_t)ew_moments_rings##f(degree, x##f, y##f, offsets, BATCH, out)); \
		add##f(out, (size_t)BATCH * (size_t)EW_MOMENTS(degree)); \
	} \
	add_bits((uint64_t)ew_area_rings##f(x##f, y##f, offsets, BATCH, out)); \
	add##f(out, BATCH); \
	add_bits((uint64_t)ew_centroid_rings##f(x##f, y##f, offsets, BATCH, out, cy)); \
	add##f(out, BATCH); \
	add##f(cy, BATCH); \
}

BATCHES(double, )
BATCHES(float, f)

/* A path over the first n vertices, every kind of edge in turn, a new contour now and then; weights
 * of all kinds. Returns how many vertices it takes. */
static size_t make_path(size_t n, size_t *verb_count, size_t *weight_count)
{
	static const size_t taken[] = { 1, 1, 2, 2, 3, 0 };
	size_t point = 0;
	*verb_count = *weight_count = 0;
	for (size_t i = 0; i < VERBS; i++) {
		const unsigned char verb = (unsigned char)(i % 23 == 0 ? (size_t)EW_MOVE
			: i % 23 == 22 ? (size_t)EW_CLOSE : (size_t)EW_LINE + i * 5 % 7 % 4);
		if (point + taken[verb] > n)
			break;
		if (verb == EW_CONIC) {
			const double w = x[point] < 0 ? -x[point] : x[point];
			weights[*weight_count] = i % 3 ? w : i % 2 ? 50 * w : -w / (1 + w);
			weightsf[*weight_count] = (float)weights[*weight_count];
			++*weight_count;
		}
		point += taken[verb];
		verbs[(*verb_count)++] = verb;
	}
	return point;
}

/* Paths, edges one by one, distance and closedness. */
#define KINDS_OF_EDGES(REAL, f) \
static void add_kinds##f(size_t n) \
{ \
	static const int powers[] = { -1, 1, 3, 5 }; \
	REAL out[MOMENTS], one; \
	size_t verb_count, weight_count, points = make_path(n, &verb_count, &weight_count); \
	for (int degree = 0; degree <= EW_MAX_CURVE_DEGREE; degree++) { \
		add_bits((uint64_t)ew_path_moments##f(degree, verbs, verb_count, xy##f, points, \
			weights##f, weight_count, out)); \
		add##f(out, (size_t)EW_MOMENTS(degree)); \
	} \
	for (int k = 0; k < 4; k++) { \
		one = ew_radius##f(powers[k], x##f, y##f, n, 0, 0); \
		add##f(&one, 1); \
		one = ew_radius##f(powers[k], x##f, y##f, n, (REAL)0.3, (REAL)-0.2); \
		add##f(&one, 1); \
		for (size_t i = 0; i + 1 < n && i < 24; i++) { \
			one = ew_line_radius##f(powers[k], x##f[i], y##f[i], x##f[i + 1], y##f[i + 1]); \
			add##f(&one, 1); \
		} \
	} \
	one = n ? ew_closure##f(x##f, y##f, x##f + 1, y##f + 1, n - 1, (REAL)0.3, (REAL)0.7) : 0; \
	add##f(&one, 1); \
	add_bits((uint64_t)(n ? ew_is_closed##f(x##f, y##f, x##f + 1, y##f + 1, n - 1) : 0)); \
}

KINDS_OF_EDGES(double, )
KINDS_OF_EDGES(float, f)

/* What windows and filters see of rings, where the ring is about as large as they are. */
#define WINDOWS(REAL, f) \
static void add_windows##f(size_t n) \
{ \
	const REAL *px = x##f, *py = y##f; \
	REAL one; \
	for (int k = 0; k < 4; k++) { \
		const REAL at = (REAL)(k * 0.375 - 0.5); \
		one = ew_coverage##f(px, py, n, at, at + (REAL)0.3, -at, (REAL)0.7); \
		add##f(&one, 1); \
		one = ew_box##f(px, py, n, at, (REAL)0.25); \
		add##f(&one, 1); \
		one = ew_tent##f(px, py, n, at, (REAL)0.1); \
		add##f(&one, 1); \
		one = ew_bspline2##f(px, py, n, at, at); \
		add##f(&one, 1); \
		one = ew_bspline3##f(px, py, n, at, -at); \
		add##f(&one, 1); \
		one = ew_catmull_rom##f(px, py, n, at, (REAL)-0.75); \
		add##f(&one, 1); \
		one = ew_mitchell##f(px, py, n, (REAL)0.5, at); \
		add##f(&one, 1); \
	} \
}

WINDOWS(double, )
WINDOWS(float, f)

/* ---- images ---- */

static float pixels[WIDE * HIGH];
static unsigned char bytes[WIDE * HIGH];
static double shape_x[SCENE], shape_y[SCENE], shape_xy[2 * SCENE];
static float shape_xf[SCENE], shape_yf[SCENE], shape_xyf[2 * SCENE];

/* Three rings that overlap each other and leave the image; kind 2 on the grid of half pixels. The
 * products are exact. */
static void fill_shape(int kind)
{
	for (size_t i = 0; i < SCENE; i++) {
		const double px = coordinate(kind), py = coordinate(kind);
		shape_x[i] = kind == 1 ? px * 16 : px * (kind ? 4 : 32) + 30.5;
		shape_y[i] = kind == 1 ? py * 8 : py * (kind ? 2 : 16) + 18;
		shape_xf[i] = (float)shape_x[i];
		shape_yf[i] = (float)shape_y[i];
		shape_xy[2 * i] = shape_x[i];
		shape_xy[2 * i + 1] = shape_y[i];
		shape_xyf[2 * i] = shape_xf[i];
		shape_xyf[2 * i + 1] = shape_yf[i];
	}
}

#define IMAGES(REAL, f) \
static void add_image##f(const ew_filter *filter) \
{ \
	static const int32_t rings[] = { 0, 5, 17, SCENE }; \
	static const unsigned char outline[] = { EW_MOVE, EW_QUAD, EW_CUBIC, EW_CONIC, EW_LINE, \
		EW_CLOSE }; \
	static const REAL weight[] = { (REAL)0.7 }; \
	for (int kind = 0; kind < KINDS; kind++) { \
		fill_shape(kind); \
		add_bits((uint64_t)ew_raster##f(filter, shape_x##f, shape_y##f, rings, 3, pixels, \
			WIDE, HIGH, WIDE)); \
		addf(pixels, WIDE * HIGH); \
		add_bits((uint64_t)ew_raster_path##f(filter, outline, 6, shape_xy##f, 9, weight, \
			1, pixels, WIDE, HIGH, WIDE)); \
		addf(pixels, WIDE * HIGH); \
	} \
} \
static void add_bytes##f(void) \
{ \
	static const int32_t rings[] = { 0, 5, 17, SCENE }; \
	for (int kind = 0; kind < KINDS; kind++) { \
		fill_shape(kind); \
		add_bits((uint64_t)ew_raster_u8##f(shape_x##f, shape_y##f, rings, 3, bytes, WIDE, \
			HIGH, WIDE)); \
		for (size_t i = 0; i < WIDE * HIGH; i++) \
			add_bits(bytes[i]); \
	} \
}

IMAGES(double, )
IMAGES(float, f)

static void add_filtered(void)
{
	static const ew_filter *const filters[] = {
		&ew_filter_tent, &ew_filter_bspline2, &ew_filter_bspline3, &ew_filter_catmull_rom,
		&ew_filter_mitchell
	};
	for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
		add_image(filters[i]);
		add_imagef(filters[i]);
	}
}

static void add_box(void)
{
	add_image(&ew_filter_box);
	add_imagef(&ew_filter_box);
	add_bytes();
	add_bytesf();
}

/* The windows of an edge, and the filters centred at the next vertex. */
#define EDGE_WINDOWS(REAL, f) \
static void add_edge_windows##f(const REAL *px, const REAL *py) \
{ \
	REAL value[8]; \
	value[0] = ew_below##f(px[0], py[0], px[1], py[1], (REAL)-0.5, (REAL)0.75, 0, 1); \
	value[1] = ew_line_coverage##f(px[0], py[0], px[1], py[1], px[2], px[2] + 1, py[2], \
		py[2] + 1); \
	value[2] = ew_line_box##f(px[0], py[0], px[1], py[1], px[2], py[2]); \
	value[3] = ew_line_tent##f(px[0], py[0], px[1], py[1], px[2], py[2]); \
	value[4] = ew_line_bspline2##f(px[0], py[0], px[1], py[1], px[2], py[2]); \
	value[5] = ew_line_bspline3##f(px[0], py[0], px[1], py[1], px[2], py[2]); \
	value[6] = ew_line_catmull_rom##f(px[0], py[0], px[1], py[1], px[2], py[2]); \
	value[7] = ew_line_mitchell##f(px[0], py[0], px[1], py[1], px[2], py[2]); \
	add##f(value, 8); \
}

EDGE_WINDOWS(double, )
EDGE_WINDOWS(float, f)

static void add_edges(void)
{
	double value;
	float valuef;
	for (size_t i = 0; i + 3 < MOST; i++) {
		value = ew_quad_area(x[i], y[i], x[i + 1], y[i + 1], x[i + 2], y[i + 2]);
		add(&value, 1);
		valuef = ew_cubic_areaf(xf[i], yf[i], xf[i + 1], yf[i + 1], xf[i + 2], yf[i + 2],
			xf[i + 3], yf[i + 3]);
		addf(&valuef, 1);
	}
	for (size_t i = 0; i + 2 < MOST; i++) {
		add_edge_windows(x + i, y + i);
		add_edge_windowsf(xf + i, yf + i);
	}
	for (size_t i = 0; i + 1 < MOST; i++) {
#define EDGE(m, n, symbol, k) \
		value = symbol(x[i], y[i], x[i + 1], y[i + 1]); \
		add(&value, 1);
		EW_LINES_DOUBLE(EDGE)
#undef EDGE
#define EDGE(m, n, symbol, k) \
		valuef = symbol(xf[i], yf[i], xf[i + 1], yf[i + 1]); \
		addf(&valuef, 1);
		EW_LINES_FLOAT(EDGE)
#undef EDGE
	}
}

static void print_hash(const char *name)
{
	printf("%s %08lx%08lx\n", name, (unsigned long)(hash >> 32),
		(unsigned long)(hash & 0xffffffffu));
}

static void add_all(void)
{
	for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
		for (int kind = 0; kind < KINDS; kind++) {
			fill(0, sizes[i], kind);
			add_rings(sizes[i]);
			add_ringsf(sizes[i]);
			add_kinds(sizes[i]);
			add_kindsf(sizes[i]);
			add_windows(sizes[i]);
			add_windowsf(sizes[i]);
		}
	for (int kind = 0; kind < KINDS; kind++) {
		fill_batch(kind);
		add_batches();
		add_batchesf();
	}
	add_filtered();
}

static void start(void)
{
	hash = FNV_BASIS;
	state = 1;
}

int main(void)
{
	for (unsigned target = 1; target && target <= ew_targets(); target *= 2) {
		if (ew_use_target(target) != EW_OK)
			continue;
		start();
		add_all();
		print_hash(ew_target_name(target));
		start();
		add_box();
		print_hash("box");
	}
	ew_use_target(EW_PORTABLE);    /* which every machine has */
	start();
	for (int kind = 0; kind < KINDS; kind++) {
		fill(0, MOST, kind);
		add_edges();
	}
	print_hash("edges");
	return 0;
}

/* Images: a pixel whose filter meets no edge is exactly its winding number.
 *
 * More than 10^7 such pixels, of scenes made to break it: on the grid, parallel to the axes, an ulp
 * beside the grid, tiny edges, far away, out of every side, holes, many turns. Whether an edge
 * meets the inside of the square that a pixel's filter covers is decided exactly: they are apart if
 * they are in x, in y, or if all corners are on one side of the edge's line; the sign of a
 * determinant is taken from double where its error cannot matter, and otherwise from rationals.
 * Then no edge passes the pixel's centre within half a pixel above or below, so the winding number
 * is safe to count along columns. Now and then all pixels of a scene are compared with clipping.
 */
#include "raster.h"

enum { SIDE = 48, BOX_PIXELS = 10000000, PIXELS = 2000000, COMPARED = 64 };

/* ---- Scenes ---- */

typedef void Fill(Scene *s);

static double random_step(double step)
{
	return step * rint(random_real(-6, SIDE + 6) / step);
}

static void fill_grid(Scene *s)
{
	scene_scatter(s, -6, SIDE + 6);
	scene_snap(s, 1);
}

static void fill_halves(Scene *s)
{
	scene_scatter(s, -6, SIDE + 6);
	scene_snap(s, 0.5);
}

/* Every second edge keeps x, the others y. */
static void fill_steps(Scene *s, double step)
{
	for (size_t k = 0; k < s->rings; k++) {
		const int32_t first = s->offsets[k];
		for (int32_t i = first; i < s->offsets[k + 1]; i++) {
			const bool turn = (i - first) % 2;
			s->x[i] = turn ? s->x[i - 1] : random_step(step);
			s->y[i] = turn || i == first ? random_step(step) : s->y[i - 1];
		}
		s->y[s->offsets[k + 1] - 1] = s->y[first];
	}
	scene_pack(s);
}

static void fill_streets(Scene *s)
{
	fill_steps(s, 1);
}

static void fill_parallel(Scene *s)
{
	fill_steps(s, 0x1p-16);
}

static float beside(double v)
{
	float f = (float)v;
	for (int steps = random_int(-2, 2); steps != 0; steps += steps < 0 ? 1 : -1)
		f = nextafterf(f, steps < 0 ? -FLT_MAX : FLT_MAX);
	return f;
}

/* Streets, or any edges on the grid, but ulps beside it. */
static void fill_ulps(Scene *s)
{
	if (random_int(0, 1))
		fill_streets(s);
	else
		fill_grid(s);
	for (size_t i = 0; i < s->n; i++) {
		s->x[i] = (double)beside(s->x[i]);
		s->y[i] = (double)beside(s->y[i]);
	}
}

static void fill_tiny(Scene *s)
{
	const double size = ldexp(1, -random_int(3, 22));
	const double cx = random_int(0, 1) ? random_step(0.5) : random_real(0, SIDE);
	const double cy = random_int(0, 1) ? random_step(0.5) : random_real(0, SIDE);
	for (size_t i = 0; i < s->n; i++) {
		s->x[i] = (i ? s->x[i - 1] : cx) + size * random_real(-1, 1);
		s->y[i] = (i ? s->y[i - 1] : cy) + size * random_real(-1, 1);
	}
}

static void fill_far(Scene *s)
{
	const double away = ldexp(1, random_int(6, 29));
	for (size_t i = 0; i < s->n; i++) {
		s->x[i] = random_int(0, 1) ? random_real(-away, away) : random_step(0.25);
		s->y[i] = random_int(0, 1) ? random_real(-away, away) : random_step(0.25);
	}
}

static void fill_outside(Scene *s)
{
	scene_scatter(s, -SIDE, 2 * SIDE);
}

static void fill_holes(Scene *s)
{
	const double cx = random_real(10, SIDE - 10), cy = random_real(10, SIDE - 10);
	for (size_t k = 0; k < s->rings; k++)
		scene_star(s, k, cx, cy, (k % 2 ? -30 : 30) / (double)(k + 1), 0.2);
}

/* Around the same place several times. */
static void fill_turns(Scene *s)
{
	const int turns = random_int(2, 6);
	for (size_t i = 0; i < s->n; i++) {
		const double turn = 6.283185307179586 * turns * (double)i / (double)s->n;
		s->x[i] = SIDE / 2.0 + random_real(8, 30) * cos(turn);
		s->y[i] = SIDE / 2.0 + random_real(8, 30) * sin(turn);
	}
}

/* There and back, a little beside. */
static void fill_slivers(Scene *s)
{
	const double width = ldexp(1, -random_int(1, 24));
	scene_scatter(s, -10, SIDE + 10);
	for (size_t i = s->n / 2; i < s->n; i++) {
		s->x[i] = s->x[s->n - 1 - i] + width * random_int(-1, 1);
		s->y[i] = s->y[s->n - 1 - i] + width * random_int(-1, 1);
	}
}

static const struct {
	const char *name;
	Fill *fill;
} kinds[] = {
	{ "grid", fill_grid }, { "half grid", fill_halves }, { "streets", fill_streets },
	{ "parallel", fill_parallel }, { "ulps", fill_ulps }, { "tiny", fill_tiny },
	{ "far", fill_far }, { "outside", fill_outside }, { "holes", fill_holes },
	{ "turns", fill_turns }, { "slivers", fill_slivers }
};

enum { KINDS = sizeof kinds / sizeof *kinds };

static Scene random_scene(size_t kind)
{
	const size_t rings = (size_t)random_int(1, 3);
	Scene s = scene_new(rings * 2 * (size_t)random_int(2, 8), rings);
	kinds[kind].fill(&s);
	scene_pack(&s);
	return s;
}

/* ---- Which pixels an edge meets ---- */

typedef struct {
	int width, height, reach;               /* reach: the side of the square */
	bool crossed[SIDE * SIDE];
	int turns[SIDE * (SIDE + 1)];           /* differences along columns */
} Map;

typedef struct {
	double x0, y0, x1, y1;
} Edge;

/* out = (a - b) (c - d) */
static void exact_product(mpq_t out, double a, double b, double c, double d)
{
	mpq_t work;
	mpq_init(work);
	mpq_set_d(out, a);
	mpq_set_d(work, b);
	mpq_sub(out, out, work);
	mpq_t second;
	mpq_init(second);
	mpq_set_d(second, c);
	mpq_set_d(work, d);
	mpq_sub(second, second, work);
	mpq_mul(out, out, second);
	mpq_clears(work, second, NULL);
}

/* The sign of (x1 - x0) (y - y0) - (y1 - y0) (x - x0): each product has three roundings, and one is
 * that of the difference. */
static int side_of(const Edge *e, double x, double y)
{
	const double a = (e->x1 - e->x0) * (y - e->y0), b = (e->y1 - e->y0) * (x - e->x0);
	if (fabs(a - b) > 0x1p-50 * (fabs(a) + fabs(b)))
		return a > b ? 1 : -1;
	mpq_t p, q;
	mpq_inits(p, q, NULL);
	exact_product(p, e->x1, e->x0, y, e->y0);
	exact_product(q, e->y1, e->y0, x, e->x0);
	const int sign = mpq_cmp(p, q);
	mpq_clears(p, q, NULL);
	return sign < 0 ? -1 : sign > 0;
}

/* Does the edge meet the inside of the square of pixel (i,j)? */
static bool meets(const Map *map, const Edge *e, int i, int j)
{
	const double half = map->reach / 2.0, x = i + 0.5, y = j + 0.5;
	if (fmax(e->x0, e->x1) <= x - half || fmin(e->x0, e->x1) >= x + half
		|| fmax(e->y0, e->y1) <= y - half || fmin(e->y0, e->y1) >= y + half)
		return false;
	/* of the corners, the two on the diagonal across the edge are furthest */
	const bool rising = (e->x1 > e->x0) == (e->y1 > e->y0);
	const int first = side_of(e, x - half, rising ? y + half : y - half);
	const int second = side_of(e, x + half, rising ? y - half : y + half);
	return first * second < 0;
}

static int clamped(double v, int most)
{
	return v < 0 ? 0 : v > most ? most : (int)v;
}

/* In every row, all columns the edge can meet, and one more on either side. */
static void mark_edge(Map *map, const Edge *e)
{
	const double half = map->reach / 2.0;
	const double low = fmin(e->y0, e->y1), high = fmax(e->y0, e->y1);
	const int from = clamped(floor(low - half - 0.5), map->height);
	const int to = clamped(ceil(high + half + 0.5), map->height);
	for (int j = from; j < to; j++) {
		double xa = e->x0, xb = e->x1;
		if (e->y0 != e->y1) {
			const double across = (e->x1 - e->x0) / (e->y1 - e->y0);
			const double y0 = j + 0.5 - half, y1 = j + 0.5 + half;
			const double a = fmin(fmax(y0, low), high), b = fmin(fmax(y1, low), high);
			xa = e->x0 + (a - e->y0) * across;
			xb = e->x0 + (b - e->y0) * across;
		}
		const int first = clamped(floor(fmin(xa, xb) - half - 1.5), map->width);
		const int last = clamped(ceil(fmax(xa, xb) + half + 1.5), map->width);
		for (int i = first; i < last; i++) {
			bool *crossed = &map->crossed[j * SIDE + i];
			*crossed = *crossed || meets(map, e, i, j);
		}
	}
}

/* Every pixel below the edge in a column has turned once more. */
static void turn_edge(Map *map, const Edge *e)
{
	const double low = fmin(e->x0, e->x1), high = fmax(e->x0, e->x1);
	const int from = clamped(floor(low) - 1, map->width), to = clamped(high + 1, map->width);
	for (int i = from; i < to; i++) {
		const double x = i + 0.5;
		if (x < low || x >= high)
			continue;
		const long double t = ((long double)x - e->x0) / ((long double)e->x1 - e->x0);
		const long double y = e->y0 + t * ((long double)e->y1 - e->y0);
		const int above = e->x1 > e->x0 ? -1 : 1;
		const int end = clamped((double)ceill(y - 0.5L), map->height);
		map->turns[i] += above;
		map->turns[end * SIDE + i] -= above;
	}
}

static void map_scene(Map *map, const Scene *s)
{
	memset(map->crossed, 0, sizeof map->crossed);
	memset(map->turns, 0, sizeof map->turns);
	for (size_t k = 0; k < s->rings; k++) {
		for (int32_t i = s->offsets[k]; i < s->offsets[k + 1]; i++) {
			const int32_t j = i + 1 < s->offsets[k + 1] ? i + 1 : s->offsets[k];
			const Edge e = { s->x[i], s->y[i], s->x[j], s->y[j] };
			if (e.x0 == e.x1 && e.y0 == e.y1)
				continue;
			mark_edge(map, &e);
			turn_edge(map, &e);
		}
	}
	for (int p = SIDE; p < SIDE * map->height; p++)
		map->turns[p] += map->turns[p - SIDE];
}

/* ---- Tests ---- */

static void print_scene(const Scene *s, char *text, size_t room)
{
	size_t used = 0;
	for (size_t i = 0; i < s->n && used + 50 < room; i++)
		used += (size_t)snprintf(text + used, room - used, " (%a,%a)", s->x[i], s->y[i]);
}

/* Returns the number of pixels that no edge meets. */
static long expect_flats(const Map *map, const Image *image, const Scene *s, const char *what)
{
	long count = 0;
	for (int p = 0; p < map->width * map->height; p++) {
		const int i = p % map->width, j = p / map->width;
		if (map->crossed[j * SIDE + i])
			continue;
		const float got = image_at(image, i, j);
		const int want = map->turns[j * SIDE + i];
		count++;
		if (got == (float)want || check.failed)
			continue;
		char text[400] = "";
		print_scene(s, text, sizeof text);
		expect(false, "%s: pixel (%d,%d) of %d x %d is %.9g, not %d:%s", what, i, j,
			map->width, map->height, (double)got, want, text);
	}
	return count;
}

/* 2e-6, and what a coordinate is known to in double. */
static void expect_all(const Image *image, const WindowFilter *definition, const Scene *s,
	const char *what)
{
	double *want = allocate((size_t)(image->width * image->height) * sizeof *want), most = 0;
	RasterRings rings = scene_rings(s);
	for (size_t i = 0; i < s->n; i++)
		most = fmax(most, fmax(fabs(s->x[i]), fabs(s->y[i])));
	raster_reference(want, definition, &rings, image->width, image->height);
	for (int p = 0; p < image->width * image->height; p++) {
		const int i = p % image->width, j = p / image->width;
		const double got = (double)image_at(image, i, j);
		if (fabs(got - want[p]) <= 2e-6 + 0x1p-51 * most || check.failed)
			continue;
		char text[400] = "";
		print_scene(s, text, sizeof text);
		expect(false, "%s: pixel (%d,%d) of %d x %d is %.9g, exact %.9g:%s", what, i, j,
			image->width, image->height, got, want[p], text);
	}
	free(want);
}

static void test_flats(const RasterFilter *filter, size_t kind, long pixels)
{
	static Map map;
	long count = 0;
	WindowFilter *definition = filter->definition();
	check_begin("pixels without an edge are their winding number: %s, %s", filter->name,
		kinds[kind].name);
	map.reach = filter->size;
	for (int i = 0; count < pixels && !check.failed; i++) {
		const Api *api = &apis[i % APIS];
		const unsigned target = target_bit[i / APIS % target_count];
		Scene s = random_scene(kind);
		map.width = random_int(1, SIDE);
		map.height = random_int(1, SIDE);
		map_scene(&map, &s);
		ew_use_target(target);
		Image image = image_of(api, filter, &s, map.width, map.height);
		count += expect_flats(&map, &image, &s, ew_target_name(target));
		if (i % COMPARED == 0)
			expect_all(&image, definition, &s, ew_target_name(target));
		image_free(&image);
		scene_free(&s);
	}
	check_end();
	ew_use_target(0);
	window_free(definition);
}

/* The map itself: a triangle of half 8 x 8 pixels has 8 on its diagonal. */
static void test_control(void)
{
	static Map map;
	check_begin("which pixels an edge meets");
	Scene s = scene_new(3, 1);
	const double x[] = { 2, 10, 2 }, y[] = { 2, 2, 10 };
	memcpy(s.x, x, sizeof x);
	memcpy(s.y, y, sizeof y);
	scene_pack(&s);
	map.reach = 1;
	map.width = map.height = 12;
	map_scene(&map, &s);
	int crossed = 0, inside = 0;
	for (int p = 0; p < SIDE * 12; p++) {
		crossed += map.crossed[p];
		inside += !map.crossed[p] && map.turns[p] == 1;
	}
	expect(crossed == 8 && inside == 28, "%d crossed, %d inside", crossed, inside);
	check_end();
	scene_free(&s);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	list_targets();
	test_control();
	for (int f = 0; f < FILTERS; f++) {
		for (size_t kind = 0; kind < KINDS; kind++)
			test_flats(&raster_filters[f], kind,
				(f ? PIXELS : BOX_PIXELS) / (long)KINDS + 1);
	}
	return check_finish();
}

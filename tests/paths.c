/* Paths: their moments, what is refused, and that nothing beyond the arrays is read.
 *
 * A path is built verb by verb together with the edges that it means, closing lines included; its
 * moments are held against the sum of the exact moments of these edges (curve_reference.h), within
 * gamma_K of the sum of their weights, K = path_k below. Every target gives the bits of fma.
 * Numbers of curves of one kind go from 0 over several vectors to several blocks of the library.
 *
 * Arrays are exactly as long as their counts say and end or begin at an inaccessible page; outputs
 * stand between canaries. Malformed paths are refused and leave the output alone.
 */
#include "guarded.h"

#include "curves.h"

#include <limits.h>

enum { LANES = 16, BLOCK = 64 };        /* lanes of float; double has 8 */
enum { MOST_EDGES = 5000, MOST_VERBS = 2 * MOST_EDGES, MOST_POINTS = 4 * MOST_EDGES };

/* ---- building paths ---- */

typedef struct {
	unsigned char verbs[MOST_VERBS];
	double points[2 * MOST_POINTS], weights[MOST_EDGES];
	size_t verb_count, point_count, weight_count;
	Curve edges[MOST_EDGES];        /* what it means */
	size_t edge_count;
	double start[2], at[2];
} Path;

static void add_verb(Path *p, int verb)
{
	p->verbs[p->verb_count++] = (unsigned char)verb;
}

static void add_point(Path *p, double x, double y)
{
	p->points[2 * p->point_count] = p->at[0] = x;
	p->points[2 * p->point_count + 1] = p->at[1] = y;
	p->point_count++;
}

/* The line back to the start, if there is anything to close. */
static void close_contour(Path *p)
{
	if (p->at[0] != p->start[0] || p->at[1] != p->start[1])
		p->edges[p->edge_count++] = (Curve){ .kind = CURVE_LINE,
			.x = { p->at[0], p->start[0] }, .y = { p->at[1], p->start[1] } };
	p->at[0] = p->start[0];
	p->at[1] = p->start[1];
}

static void path_clear(Path *p)
{
	p->verb_count = p->point_count = p->weight_count = p->edge_count = 0;
	p->start[0] = p->start[1] = p->at[0] = p->at[1] = 0;
}

static void path_move(Path *p, double x, double y)
{
	close_contour(p);
	add_verb(p, EW_MOVE);
	add_point(p, x, y);
	p->start[0] = x;
	p->start[1] = y;
}

/* The first control point is where the path is. */
static void path_draw(Path *p, const Curve *c)
{
	Curve *edge = &p->edges[p->edge_count++];
	*edge = *c;
	edge->x[0] = p->at[0];
	edge->y[0] = p->at[1];
	add_verb(p, c->kind);
	for (int i = 1; i < curve_points(c->kind); i++)
		add_point(p, c->x[i], c->y[i]);
	if (c->kind == CURVE_CONIC)
		p->weights[p->weight_count++] = c->w;
}

static void path_close(Path *p)
{
	close_contour(p);
	add_verb(p, EW_CLOSE);
}

_Static_assert((int)EW_LINE == (int)CURVE_LINE && (int)EW_QUAD == (int)CURVE_QUAD
	&& (int)EW_CONIC == (int)CURVE_CONIC && (int)EW_CUBIC == (int)CURVE_CUBIC
	&& EW_MOVE == 0 && EW_CLOSE == 5, "verbs are kinds");

/* ---- calling the library ---- */

typedef struct {
	const unsigned char *verbs;
	size_t verb_count;
	const void *points;
	size_t point_count;
	const void *weights;
	size_t weight_count;
} Arrays;

static int call(const Api *api, int degree, const Arrays *a, void *out)
{
	if (api->bits == 24)
		return ew_path_momentsf(degree, a->verbs, a->verb_count, a->points, a->point_count,
			a->weights, a->weight_count, out);
	return ew_path_moments(degree, a->verbs, a->verb_count, a->points, a->point_count,
		a->weights, a->weight_count, out);
}

static void *packed(const Api *api, const double *from, size_t count)
{
	void *to = allocate(count * api->size);
	for (size_t i = 0; i < count; i++)
		put(api, to, i, from[i]);
	return to;
}

/* Copies in the precision, each of its own and of exactly its size. */
static Arrays arrays_new(const Api *api, const Path *p)
{
	unsigned char *verbs = allocate(p->verb_count);
	memcpy(verbs, p->verbs, p->verb_count);
	return (Arrays){ verbs, p->verb_count, packed(api, p->points, 2 * p->point_count),
		p->point_count, packed(api, p->weights, p->weight_count), p->weight_count };
}

static void arrays_free(Arrays *a)
{
	free((void *)(uintptr_t)a->verbs);
	free((void *)(uintptr_t)a->points);
	free((void *)(uintptr_t)a->weights);
}

/* Between canaries; false if it returns something else, writes too much, or writes though it
 * refuses. */
static bool expect_call(const Api *api, int degree, const Arrays *a, int result, void *out,
	const char *what)
{
	const size_t bytes = result == EW_OK ? (size_t)ref_count(degree) * api->size : 0;
	unsigned char room[MARGIN + CURVE_MOMENTS * sizeof(double) + MARGIN];
	memset(room, CANARY, sizeof room);
	const int got = call(api, degree, a, room + MARGIN);
	if (!expect(got == result, "%s, degree %d, gives %d, not %d", what, degree, got, result))
		return false;
	memcpy(out, room + MARGIN, bytes);
	for (size_t i = 0; i < sizeof room; i++) {
		if (!expect(room[i] == CANARY || (i >= MARGIN && i < MARGIN + bytes),
			"%s, degree %d, writes at byte %ld of %zu", what, degree, (long)i - MARGIN,
			bytes))
			return false;
	}
	return true;
}

/* ---- exact moments ---- */

typedef struct {
	Ref *area, *moments;            /* for degree 0, and for those above */
	size_t items[CURVE_KINDS];      /* edges of each kind as the library sees them */
	double tiny[CURVE_DEGREE + 1];  /* what underflow may add, for k = 1 */
} Exact;

static void exact_init(Exact *e)
{
	memset(e, 0, sizeof *e);
	e->area = ref_new(1);
	e->moments = ref_new(CURVE_MOMENTS);
}

static void exact_free(Exact *e)
{
	ref_free(e->area, 1);
	ref_free(e->moments, CURVE_MOMENTS);
}

/* A conic is its chord and a cap; beyond 0 <= w <= 3 it is two such, and so on. (From somewhat below 3:
 * weights of halves are rounded.) */
static size_t conic_pieces(double w)
{
	if (isinf(w))
		return 2;               /* two lines */
	return w < 0 || w > 2.99 ? 2 * conic_pieces(sqrt((1 + w) / 2)) : 1;
}

static void count_items(size_t *items, const Curve *c)
{
	const size_t pieces = c->kind == CURVE_CONIC ? conic_pieces(c->w) : 1;
	items[c->kind] += pieces;
	if (c->kind == CURVE_CONIC)
		items[CURVE_LINE] += pieces;
}

static void exact_add_curve(const Api *api, Exact *e, const Curve *c)
{
	curve_add(e->area, 0, c);
	curve_add(e->moments, CURVE_DEGREE, c);
	count_items(e->items, c);
	for (int d = 0; d <= CURVE_DEGREE; d++)
		e->tiny[d] += curve_tiny(api, c, d, 1);
}

static void refs_add(Ref *to, const Ref *from, int count)
{
	for (int i = 0; i < count; i++) {
		mpq_add(to[i].value, to[i].value, from[i].value);
		mpq_add(to[i].weight, to[i].weight, from[i].weight);
	}
}

static void exact_add(Exact *to, const Exact *from)
{
	refs_add(to->area, from->area, 1);
	refs_add(to->moments, from->moments, CURVE_MOMENTS);
	for (int kind = 0; kind < CURVE_KINDS; kind++)
		to->items[kind] += from->items[kind];
	for (int d = 0; d <= CURVE_DEGREE; d++)
		to->tiny[d] += from->tiny[d];
}

/* Roundings on the way of one term: the k of its kernel, r for each further item of its lane, the
 * halving of the lanes, and the sum of the kinds. Float lanes go to double after every BLOCK items,
 * and the sum is rounded to float. */
static long path_k(const Api *api, const size_t *items, int degree)
{
	const size_t lanes = api->bits == 24 ? LANES : LANES / 2;
	const long halvings = api->bits == 24 ? 4 : 3;
	long k = 0;
	for (int kind = CURVE_LINE; kind < CURVE_KINDS; kind++) {
		const Row *row = curve_row(kind, degree);
		const size_t block = api->bits == 24 && items[kind] > BLOCK ? BLOCK : items[kind];
		const long more = block ? (long)((block - 1) / lanes) : 0;
		const long here = items[kind] ? row->k + row->r * more : 0;
		k = here > k ? here : k;
	}
	return k + halvings + CURVE_KINDS + (api->bits == 24);
}

/* All degrees from first, in steps, on all targets. */
static void expect_path(const Api *api, const Path *p, const Exact *want, int first, int step,
	double *worst, const char *what)
{
	Arrays a = arrays_new(api, p);
	for (int d = first; d <= CURVE_DEGREE; d += step) {
		double got[CURVE_MOMENTS], last[CURVE_MOMENTS];
		const size_t bytes = (size_t)ref_count(d) * api->size;
		const long k = path_k(api, want->items, d);
		unsigned seen = 0;
		for (unsigned target = 0; next_target(&target);) {
			if (!expect_call(api, d, &a, EW_OK, got, what))
				continue;
			const bool same = seen && memcmp(got, last, bytes) == 0;
			expect(same || !(seen & ~(unsigned)EW_PORTABLE),
				"%s: other bits by %s than by %s, degree %d", what,
				ew_target_name(target), ew_target_name(seen), d);
			if (!same)
				expect_moments(api, got, d == 0 ? want->area : want->moments, d, k,
					want->tiny[d] * (double)k, &worst[d], what);
			memcpy(last, got, bytes);
			seen = target;
		}
	}
	arrays_free(&a);
}

static void print_worst_path(const char *what, const Api *api, const double *worst)
{
	printf("largest error of %s, %s, in u W, degrees 0 to %d:", what, api->name, CURVE_DEGREE);
	for (int d = 0; d <= CURVE_DEGREE; d++)
		printf(" %.2f", worst[d]);
	printf("\n");
}

/* ---- many curves of one kind ---- */

enum { POOL = 64 };

static double random_path_weight(void)
{
	switch (random_int(0, 5)) {
	case 0: return 1;
	case 1: return random_real(-0.9, 0);
	case 2: return random_real(3, 100);
	case 3: return random_int(0, 1) ? 0 : INFINITY;
	default: return random_real(0, 3);
	}
}

static Curve random_piece(const Api *api, int kind, Class class)
{
	Curve c = random_curve(api, kind, class);
	c.w = round_to(api->bits, random_path_weight());
	return c;
}

typedef struct {
	Curve curves[POOL];     /* a circle: each begins where the one before ends */
	Exact exact[POOL];
} Pool;

static void pool_init(const Api *api, Pool *pool, int kind)
{
	const int last = curve_points(kind) - 1;
	for (int i = 0; i < POOL; i++)
		pool->curves[i] = random_piece(api, kind, UNIFORM);
	for (int i = 0; i < POOL; i++) {
		Curve *c = &pool->curves[i], *before = &pool->curves[i ? i - 1 : POOL - 1];
		c->x[0] = before->x[last];
		c->y[0] = before->y[last];
		exact_init(&pool->exact[i]);
		exact_add_curve(api, &pool->exact[i], c);
	}
}

static void pool_free(Pool *pool)
{
	for (int i = 0; i < POOL; i++)
		exact_free(&pool->exact[i]);
}

static bool tested_count(size_t n, size_t lanes)
{
	static const size_t more[] = {
		63, 64, 65, 127, 128, 129, 255, 256, 257, 511, 512, 513, 1023, 1024, 1025, 1500,
		2047, 2048, 2049, 4200
	};
	if (n <= 3 * lanes + 5)
		return true;
	for (size_t i = 0; i < sizeof more / sizeof *more; i++) {
		if (n == more[i])
			return true;
	}
	return false;
}

/* One contour of n curves of the pool, and a line that closes it. */
static void test_counts(const Api *api, int kind)
{
	static Pool pool;
	static Path path;
	double worst[CURVE_DEGREE + 1] = { 0 };
	const size_t lanes = api->bits == 24 ? LANES : LANES / 2;
	char what[60];
	Exact sum;
	check_begin("many %ss, %s", curve_names[kind], api->name);
	pool_init(api, &pool, kind);
	exact_init(&sum);
	path_clear(&path);
	path_move(&path, pool.curves[0].x[0], pool.curves[0].y[0]);
	for (size_t n = 0; n <= 4200; n++) {
		if (tested_count(n, lanes)) {
			const size_t edges = path.edge_count;
			const double at[2] = { path.at[0], path.at[1] };
			Exact whole;
			exact_init(&whole);
			exact_add(&whole, &sum);
			close_contour(&path);
			if (path.edge_count > edges)
				exact_add_curve(api, &whole, &path.edges[edges]);
			snprintf(what, sizeof what, "%zu %ss", n, curve_names[kind]);
			const bool few = n <= 3 * lanes + 5;
			expect_path(api, &path, &whole, few ? 0 : (int)(n % 2), few ? 1 : 2, worst,
				what);
			path.edge_count = edges;
			memcpy(path.at, at, sizeof at);
			exact_free(&whole);
		}
		path_draw(&path, &pool.curves[n % POOL]);
		exact_add(&sum, &pool.exact[n % POOL]);
	}
	check_end();
	snprintf(what, sizeof what, "paths of %ss", curve_names[kind]);
	print_worst_path(what, api, worst);
	exact_free(&sum);
	pool_free(&pool);
}

/* ---- all sorts of paths ---- */

/* Contours of mixed edges: closed or not, continued after CLOSE, empty, of one point. */
static void random_path(const Api *api, Path *p, int most_verbs, Class class)
{
	const int verbs = random_int(1, most_verbs);
	path_clear(p);
	for (int i = 0; i < verbs; i++) {
		const int choice = i ? random_int(0, 11) : 0;
		const Curve c = random_piece(api, choice % 4 + 1, class);
		if (choice == 0)
			path_move(p, c.x[1], c.y[1]);
		else if (choice < 3)
			path_close(p);
		else
			path_draw(p, &c);
	}
}

static void exact_of_path(const Api *api, Exact *e, Path *p)
{
	exact_init(e);
	close_contour(p);
	for (size_t i = 0; i < p->edge_count; i++)
		exact_add_curve(api, e, &p->edges[i]);
}

static void test_mixed(const Api *api)
{
	static Path path;
	double worst[CURVE_DEGREE + 1] = { 0 };
	char what[60];
	check_begin("mixed paths, %s", api->name);
	for (int i = 0; i < 120; i++) {
		Exact want;
		random_path(api, &path, 4 + i / 3, (Class)(i % CLASSES));
		exact_of_path(api, &want, &path);
		snprintf(what, sizeof what, "path %d of %zu verbs, %s", i, path.verb_count,
			class_names[i % CLASSES]);
		expect_path(api, &path, &want, 0, 1, worst, what);
		exact_free(&want);
	}
	check_end();
	print_worst_path("mixed paths", api, worst);
}

/* A polygon as a path and as a ring: each within its bound of the exact moments. */
static void test_polygons(const Api *api)
{
	static Path path;
	double worst[CURVE_DEGREE + 1] = { 0 };
	check_begin("polygons, %s", api->name);
	for (int i = 0; i < 60; i++) {
		const size_t n = (size_t)(i < 40 ? i : 30 * (i - 38));
		Ring ring = ring_new(n);
		Exact want;
		ring_star(&ring, 0.25, -0.5, 1);
		ring_pack(api, &ring);
		path_clear(&path);
		for (size_t j = 0; j < n; j++) {
			const Curve c = { .kind = CURVE_LINE, .x = { 0, ring.x[j] },
				.y = { 0, ring.y[j] } };
			if (j == 0)
				path_move(&path, c.x[1], c.y[1]);
			else
				path_draw(&path, &c);
		}
		if (n && i % 2)
			path_close(&path);
		exact_init(&want);
		ref_ring(want.moments, CURVE_DEGREE, ring.x, ring.y, n);
		ref_ring(want.area, 0, ring.x, ring.y, n);
		want.items[CURVE_LINE] = n;
		expect_path(api, &path, &want, 0, 1, worst, "polygon");
		for (int d = 1; d <= CURVE_DEGREE; d++) {
			double out[CURVE_MOMENTS], unused = 0;
			const long k = ring_k(api, find_row("moments", d, 0), n);
			api->moments(d, ring.px, ring.py, n, out);
			expect_moments(api, out, want.moments, d, k,
				ref_tiny(k, d, api->bits, ring.x, ring.y, n), &unused, "ring");
		}
		exact_free(&want);
		ring_free(&ring);
	}
	check_end();
	print_worst_path("polygons", api, worst);
}

/* ---- nothing ---- */

static void expect_zero(const Api *api, Path *p, const char *what)
{
	Arrays a = arrays_new(api, p);
	for (int d = 0; d <= CURVE_DEGREE; d++) {
		double out[CURVE_MOMENTS];
		if (!expect_call(api, d, &a, EW_OK, out, what))
			continue;
		for (int i = 0; i < ref_count(d); i++)
			expect(get(api, out, i) == 0, "moment %d of %s is %g", i, what,
				get(api, out, i));
	}
	arrays_free(&a);
}

static void test_nothing(const Api *api, const char *target)
{
	static Path path;
	double out[CURVE_MOMENTS];
	check_begin("empty paths and contours, %s, %s", api->name, target);
	const Arrays none = { 0 };
	path_clear(&path);
	expect_zero(api, &path, "an empty path");
	expect_call(api, 0, &none, EW_OK, out, "an empty path of NULL arrays");
	expect(get(api, out, 0) == 0, "area of nothing is %g", get(api, out, 0));
	path_move(&path, round_to(api->bits, 0.1), round_to(api->bits, 0.7));
	expect_zero(api, &path, "MOVE");
	path_close(&path);
	expect_zero(api, &path, "MOVE CLOSE");
	path_close(&path);
	path_move(&path, 3, 5);
	path_move(&path, 4, 5);
	expect_zero(api, &path, "MOVE CLOSE CLOSE MOVE MOVE");
	for (int kind = CURVE_LINE; kind < CURVE_KINDS; kind++) {
		Curve c = random_piece(api, kind, UNIFORM);
		for (int i = 0; i < CURVE_POINTS; i++) {
			c.x[i] = c.x[0];
			c.y[i] = c.y[0];
		}
		path_clear(&path);
		path_move(&path, c.x[0], c.y[0]);
		path_draw(&path, &c);
		expect_zero(api, &path, curve_names[kind]);
		path_draw(&path, &c);
		path_close(&path);
		path_draw(&path, &c);
		expect_zero(api, &path, curve_names[kind]);
	}
	check_end();
}

/* ---- malformed paths ---- */

/* The first step verbs of a valid path, which has all of them. */
static void sound_path(Path *p)
{
	static const Curve pieces[] = {
		{ .kind = CURVE_LINE, .x = { 0, 3 }, .y = { 0, 1 } },
		{ .kind = CURVE_QUAD, .x = { 0, 3, 2 }, .y = { 0, 4, 5 } },
		{ .kind = CURVE_CONIC, .x = { 0, 1, 0 }, .y = { 0, 6, 5 }, .w = 0.5 },
		{ .kind = CURVE_CUBIC, .x = { 0, -1, -2, -1 }, .y = { 0, 4, 3, 1 } },
	};
	path_clear(p);
	path_move(p, 1, 1);
	for (int i = 0; i < 4; i++)
		path_draw(p, &pieces[i]);
	path_close(p);
	for (int i = 3; i >= 0; i--)
		path_draw(p, &pieces[i]);
	path_move(p, 7, 8);
	path_draw(p, &pieces[2]);
}

static void expect_bad(const Api *api, const Arrays *a, const char *what)
{
	double out[CURVE_MOMENTS];
	for (int d = 0; d <= CURVE_DEGREE; d++)
		expect_call(api, d, a, EW_BAD_PATH, out, what);
}

/* A verb that does not exist at every place, with none to three points for it. */
static void test_unknown_verbs(const Api *api, const char *target)
{
	static Path path;
	char what[60];
	check_begin("unknown verbs, %s, %s", api->name, target);
	sound_path(&path);
	const size_t verbs = path.verb_count++;
	path.point_count += 3;
	for (size_t i = 0; i <= verbs; i++) {
		memmove(path.verbs + i + 1, path.verbs + i, verbs - i);
		for (int verb = EW_CLOSE + 1; verb < 256; verb += verb < 20 ? 1 : 47) {
			path.verbs[i] = (unsigned char)verb;
			Arrays a = arrays_new(api, &path);
			snprintf(what, sizeof what, "verb %d at %zu", verb, i);
			for (int points = 0; points <= 3; points++) {
				Arrays other = a;
				other.point_count -= (size_t)points;
				expect_bad(api, &other, what);
			}
			arrays_free(&a);
		}
		sound_path(&path);
		path.verb_count++;
		path.point_count += 3;
	}
	check_end();
}

static void test_bad_verbs(const Api *api, const char *target)
{
	static Path path;
	char what[60];
	check_begin("verbs before MOVE, %s, %s", api->name, target);
	for (int verb = EW_LINE; verb <= EW_CLOSE; verb++) {
		path_clear(&path);
		const Curve c = random_curve(api, verb == EW_CLOSE ? CURVE_LINE : verb, UNIFORM);
		if (verb == EW_CLOSE)
			path_close(&path);
		else
			path_draw(&path, &c);
		Arrays a = arrays_new(api, &path);
		snprintf(what, sizeof what, "verb %d alone", verb);
		expect_bad(api, &a, what);
		arrays_free(&a);
		path_move(&path, 1, 2);
		path_draw(&path, &c);
		a = arrays_new(api, &path);
		snprintf(what, sizeof what, "verb %d before MOVE", verb);
		expect_bad(api, &a, what);
		arrays_free(&a);
	}
	check_end();
}

/* Every count too small and too large: the first verbs with all points, all verbs with fewer points
 * and weights, counts of the size of the address space. */
static void test_bad_counts(const Api *api, const char *target)
{
	static const size_t wild[] = {
		SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / 2 + 1, SIZE_MAX / 4 + 1, (size_t)1 << 32,
		(size_t)UINT_MAX, (size_t)INT_MAX + 1
	};
	static Path path;
	double out[CURVE_MOMENTS];
	check_begin("bad counts, %s, %s", api->name, target);
	sound_path(&path);
	Arrays a = arrays_new(api, &path);
	for (size_t verbs = 0; verbs < path.verb_count; verbs++) {
		Arrays fewer = a;
		fewer.verb_count = verbs;
		expect_bad(api, &fewer, "too few verbs");
	}
	for (size_t points = 0; points <= path.point_count + 5; points++) {
		for (size_t weights = 0; weights <= path.weight_count + 3; weights++) {
			Arrays other = a;
			other.point_count = points;
			other.weight_count = weights;
			if (points != path.point_count || weights != path.weight_count)
				expect_bad(api, &other, "points and weights that do not match");
		}
	}
	for (size_t i = 0; i < sizeof wild / sizeof *wild; i++) {
		Arrays other = a;
		other.point_count = wild[i];
		expect_bad(api, &other, "wild number of points");
		other.weight_count = wild[i];
		expect_bad(api, &other, "wild numbers of points and weights");
		other.point_count = a.point_count;
		expect_bad(api, &other, "wild number of weights");
	}
	expect_call(api, CURVE_DEGREE, &a, EW_OK, out, "the path itself");
	arrays_free(&a);
	check_end();
}

static void test_null(const Api *api, const char *target)
{
	static Path path;
	double out[CURVE_MOMENTS];
	check_begin("NULL arrays, %s, %s", api->name, target);
	sound_path(&path);
	Arrays a = arrays_new(api, &path), other = a;
	other.verbs = NULL;
	expect_bad(api, &other, "NULL verbs");
	other = a;
	other.points = NULL;
	expect_bad(api, &other, "NULL points");
	other = a;
	other.weights = NULL;
	expect_bad(api, &other, "NULL weights");
	other = (Arrays){ NULL, 0, NULL, 1, NULL, 0 };
	expect_bad(api, &other, "a point of NULL");
	other = (Arrays){ NULL, 0, NULL, 0, NULL, 1 };
	expect_bad(api, &other, "a weight of NULL");
	other = (Arrays){ NULL, 1, NULL, 0, NULL, 0 };
	expect_bad(api, &other, "a verb of NULL");
	other = (Arrays){ (const unsigned char[]){ EW_MOVE, EW_LINE }, 2, a.points, 2, NULL, 0 };
	expect_call(api, 2, &other, EW_OK, out, "no weights of NULL");
	arrays_free(&a);
	check_end();
}

static void test_bad_degree(const Api *api, const char *target)
{
	static const int bad[] = { -1, CURVE_DEGREE + 1, INT_MAX, INT_MIN };
	static Path path;
	unsigned char room[CURVE_MOMENTS * sizeof(double)];
	check_begin("degree out of range, %s, %s", api->name, target);
	sound_path(&path);
	Arrays a = arrays_new(api, &path), none = { 0 };
	for (int i = 0; i < 4; i++) {
		memset(room, CANARY, sizeof room);
		expect(call(api, bad[i], &a, room) == EW_BAD_DEGREE, "degree %d is not refused",
			bad[i]);
		expect(call(api, bad[i], &none, room) == EW_BAD_DEGREE,
			"degree %d of nothing is not refused", bad[i]);
		for (size_t j = 0; j < sizeof room; j++)
			expect(room[j] == CANARY, "degree %d writes", bad[i]);
	}
	arrays_free(&a);
	check_end();
}

/* ---- what is no number ---- */

static void test_nonfinite(const Api *api, const char *target)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	static const double weights[] = { NAN, -1, -1.5, -1e30, -INFINITY };
	static Path path;
	double out[CURVE_MOMENTS];
	check_begin("NaN and infinity, %s, %s", api->name, target);
	sound_path(&path);
	for (size_t i = 0; i < 2 * path.point_count * 3; i++) {
		const double kept = path.points[i / 3];
		path.points[i / 3] = bad[i % 3];
		Arrays a = arrays_new(api, &path);
		for (int d = 0; d <= CURVE_DEGREE; d++) {
			expect_call(api, d, &a, EW_OK, out, "a path of NaN or infinity");
			expect(all_nonfinite(api, out, ref_count(d)),
				"a moment of degree %d is finite for number %zu", d, i / 3);
		}
		arrays_free(&a);
		path.points[i / 3] = kept;
	}
	for (size_t i = 0; i < path.weight_count * 5; i++) {
		const double kept = path.weights[i / 5];
		path.weights[i / 5] = weights[i % 5];
		Arrays a = arrays_new(api, &path);
		for (int d = 0; d <= CURVE_DEGREE; d++) {
			expect_call(api, d, &a, EW_OK, out, "a path of a bad weight");
			for (int j = 0; j < ref_count(d); j++)
				expect(isnan(get(api, out, j)), "moment %d is %g for weight %g", j,
					get(api, out, j), weights[i % 5]);
		}
		arrays_free(&a);
		path.weights[i / 5] = kept;
	}
	check_end();
}

/* ---- guard pages ---- */

enum { VERBS, POINTS, WEIGHTS, GUARDS };

static void expect_guarded(const Api *api, Guarded *g, const Path *p, int degree)
{
	double want[CURVE_MOMENTS], got[CURVE_MOMENTS];
	Arrays a = arrays_new(api, p);
	if (!expect_call(api, degree, &a, EW_OK, want, "a path"))
		return;
	for (int places = 0; places < 8; places++) {
		Arrays guarded = a;
		guarded.verbs = guarded_copy(&g[VERBS], a.verbs, a.verb_count, places & 1);
		guarded.points = guarded_copy(&g[POINTS], a.points, 2 * a.point_count * api->size,
			places & 2);
		guarded.weights = guarded_copy(&g[WEIGHTS], a.weights, a.weight_count * api->size,
			places & 4);
		expect_call(api, degree, &guarded, EW_OK, got, "a path between guard pages");
		expect(memcmp(want, got, (size_t)ref_count(degree) * api->size) == 0,
			"other bits at places %d, degree %d", places, degree);
		guarded.verb_count--;           /* malformed, or ends in a point or CLOSE */
		call(api, degree, &guarded, got);
		guarded.verb_count++;
		guarded.point_count--;
		expect_call(api, degree, &guarded, EW_BAD_PATH, got, "one point too few");
	}
	arrays_free(&a);
}

static void test_guards(const Api *api, const char *target)
{
	static Path path;
	Guarded g[GUARDS];
	check_begin("guard pages, %s, %s", api->name, target);
	for (int i = 0; i < GUARDS; i++)
		g[i] = guarded_new(i == POINTS ? 1 << 17 : 1 << 15);
	for (int i = 0; i < 300; i++) {
		random_path(api, &path, i < 250 ? i / 5 + 1 : 2000, UNIFORM);
		expect_guarded(api, g, &path, i % (CURVE_DEGREE + 1));
	}
	for (int kind = CURVE_LINE; kind < CURVE_KINDS; kind++) {
		path_clear(&path);
		path_move(&path, 1, 2);
		for (int n = 1; n <= 70; n++) {
			const Curve c = random_piece(api, kind, UNIFORM);
			path_draw(&path, &c);
			expect_guarded(api, g, &path, n % (CURVE_DEGREE + 1));
		}
	}
	for (int i = 0; i < GUARDS; i++)
		guarded_free(&g[i]);
	check_end();
}

static void test_target(const Api *api, const char *target)
{
	test_nothing(api, target);
	test_unknown_verbs(api, target);
	test_bad_verbs(api, target);
	test_bad_counts(api, target);
	test_null(api, target);
	test_bad_degree(api, target);
	test_nonfinite(api, target);
	test_guards(api, target);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	for (const Api *api = NULL; (api = next_api(api));) {
		for (int kind = CURVE_LINE; kind < CURVE_KINDS; kind++)
			test_counts(api, kind);
		test_mixed(api);
		test_polygons(api);
	}
	for_each_target(test_target);
	return check_finish();
}

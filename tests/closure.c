/* Do edges in any order close?
 *
 * ew_is_closed is held against counting: on a few points of a small grid, where half of the soups
 * happen to close, both answers must be found. Closed soups are rings over common vertices, taken
 * apart and shuffled; they must be found closed, and no longer once an edge is missing, turned
 * around or a single bit off. Open soups that are most alike (rectangles on a grid, mirror images,
 * neighbouring numbers, x and y exchanged, higher differences) must all be found open.
 *
 * ew_closure: with a = (x - px)(y - py) at both ends of every edge, and the rounded differences and
 * products,
 *
 *     |result - exact sum| <= gamma_(K+3) sum |a|,    K = 1 + ceil(n/L) - 1 + log2 L
 *
 * (two differences and a product for a; the edge's own difference, the lane, the halvings; one more
 * for float, whose lanes go to double after 1024 edges). In a closed soup every rounded a comes as
 * often with either sign, so the exact sum of the rounded ones is 0 and |result| is at most gamma_K
 * times the sum of their sizes, which the (1 + u)^3 in them make less than gamma_(K+1) sum |a|.
 */
#include "rings.h"

enum { X0, Y0, X1, Y1, SIDES };

typedef struct {
	size_t n;
	double *at[SIDES];
	void *packed[SIDES];            /* as the library reads them */
} Soup;

typedef struct {
	double (*closure)(const Soup *soup, double px, double py);
	bool (*is_closed)(const Soup *soup);
	double (*line)(const double edge[SIDES], double px, double py);
} Closure;

#define CLOSURE_FUNCTIONS(REAL, f) \
static double call_closure##f(const Soup *soup, double px, double py) \
{ \
	void *const *p = soup->packed; \
	return (double)ew_closure##f(p[X0], p[Y0], p[X1], p[Y1], soup->n, (REAL)px, (REAL)py); \
} \
static bool call_is_closed##f(const Soup *soup) \
{ \
	void *const *p = soup->packed; \
	return ew_is_closed##f(p[X0], p[Y0], p[X1], p[Y1], soup->n) != 0; \
} \
static double call_line##f(const double edge[SIDES], double px, double py) \
{ \
	return (double)ew_line_closure##f((REAL)edge[X0], (REAL)edge[Y0], (REAL)edge[X1], \
		(REAL)edge[Y1], (REAL)px, (REAL)py); \
}

CLOSURE_FUNCTIONS(double, )
CLOSURE_FUNCTIONS(float, f)

static const Closure closures[APIS] = {
	{ call_closure, call_is_closed, call_line }, { call_closuref, call_is_closedf, call_linef }
};

static const Closure *of(const Api *api)
{
	return &closures[api - apis];
}

/* Soups. */

static Soup soup_new(size_t n)
{
	Soup soup = { .n = n };
	for (int s = 0; s < SIDES; s++) {
		soup.at[s] = allocate(n * sizeof(double));
		soup.packed[s] = allocate(n * sizeof(double));
	}
	return soup;
}

static void soup_free(Soup *soup)
{
	for (int s = 0; s < SIDES; s++) {
		free(soup->at[s]);
		free(soup->packed[s]);
	}
}

static void soup_pack(const Api *api, Soup *soup)
{
	for (int s = 0; s < SIDES; s++) {
		for (size_t i = 0; i < soup->n; i++) {
			soup->at[s][i] = round_to(api->bits, soup->at[s][i]);
			put(api, soup->packed[s], i, soup->at[s][i]);
		}
	}
}

static bool found_closed(const Api *api, Soup *soup)
{
	soup_pack(api, soup);
	return of(api)->is_closed(soup);
}

static void soup_set(Soup *soup, size_t i, const double from[2], const double to[2])
{
	soup->at[X0][i] = from[0];
	soup->at[Y0][i] = from[1];
	soup->at[X1][i] = to[0];
	soup->at[Y1][i] = to[1];
}

static void soup_swap(Soup *soup, size_t i, size_t j)
{
	for (int s = 0; s < SIDES; s++) {
		const double at = soup->at[s][i];
		soup->at[s][i] = soup->at[s][j];
		soup->at[s][j] = at;
	}
}

static void soup_shuffle(Soup *soup)
{
	for (size_t i = soup->n; i > 1; i--)
		soup_swap(soup, i - 1, (size_t)(random_bits() % i));
}

/* Every other zero, at random, becomes -0. */
static void soup_sign_zeros(Soup *soup)
{
	for (int s = 0; s < SIDES; s++)
		for (size_t i = 0; i < soup->n; i++)
			if (soup->at[s][i] == 0 && random_int(0, 1))
				soup->at[s][i] = -0.0;
}

/* The least of the precision above v > 0. */
static double next_up(const Api *api, double v)
{
	return api->bits == 24 ? (double)nextafterf((float)v, INFINITY) : nextafter(v, INFINITY);
}

typedef void Place(const Api *api, double v[2]);

static void place_grid(const Api *api, double v[2])
{
	(void)api;
	v[0] = random_int(-9, 9);
	v[1] = random_int(-9, 9);
}

static void place_anywhere(const Api *api, double v[2])
{
	v[0] = round_to(api->bits, random_scaled(-20, 20));
	v[1] = round_to(api->bits, random_scaled(-20, 20));
}

static void place_unit(const Api *api, double v[2])
{
	v[0] = round_to(api->bits, random_real(-1, 1));
	v[1] = round_to(api->bits, random_real(-1, 1));
}

static void place_denormal(const Api *api, double v[2])
{
	v[0] = api->denormal * random_int(-9, 9);
	v[1] = api->denormal * random_int(-9, 9);
}

/* Rings through vertices of a common stock, edge by edge, shuffled. */
static Soup soup_closed(const Api *api, size_t n, Place *place)
{
	enum { STOCK = 64 };
	double stock[STOCK][2];
	Soup soup = soup_new(n);
	for (int i = 0; i < STOCK; i++)
		place(api, stock[i]);
	for (size_t i = 0; i < n;) {
		const size_t left = n - i, wanted = (size_t)random_int(1, 12);
		const size_t length = wanted < left ? wanted : left;
		const double *first = stock[random_int(0, STOCK - 1)], *from = first;
		for (size_t j = 1; j <= length; j++, i++) {
			const double *to = j == length ? first : stock[random_int(0, STOCK - 1)];
			soup_set(&soup, i, from, to);
			from = to;
		}
	}
	soup_shuffle(&soup);
	soup_sign_zeros(&soup);
	soup_pack(api, &soup);
	return soup;
}

/* is_closed */

/* By counting, in O(n^2). */
static bool counts_closed(const Soup *soup)
{
	for (size_t i = 0; i < soup->n; i++) {
		for (int end = 0; end < 4; end += 2) {
			const double x = soup->at[X0 + end][i], y = soup->at[Y0 + end][i];
			long count = 0;
			for (size_t j = 0; j < soup->n; j++) {
				count += soup->at[X0][j] == x && soup->at[Y0][j] == y;
				count -= soup->at[X1][j] == x && soup->at[Y1][j] == y;
			}
			if (count)
				return false;
		}
	}
	return true;
}

static void test_counting(const Api *api)
{
	long closed = 0, open = 0;
	check_begin("is_closed counts, %s", api->name);
	for (int i = 0; i < 100000; i++) {
		Soup soup = soup_new((size_t)random_int(0, 6));
		for (int s = 0; s < SIDES; s++)
			for (size_t j = 0; j < soup.n; j++)
				soup.at[s][j] = s % 2 ? 0 : random_int(0, 1);
		soup_sign_zeros(&soup);
		const bool want = counts_closed(&soup);
		expect(found_closed(api, &soup) == want, "soup %d of %zu edges is %s", i, soup.n,
			want ? "closed" : "open");
		closed += want;
		open += !want;
		soup_free(&soup);
	}
	expect(closed > 20000 && open > 20000, "%ld closed, %ld open", closed, open);
	check_end();
}

static void test_small(const Api *api)
{
	static const double a[2] = { 0, 1 }, b[2] = { 2, 3 }, c[2] = { -0.0, 1 };
	Soup soup = soup_new(4);
	check_begin("is_closed of few edges, %s", api->name);
	soup_set(&soup, 0, a, b);
	soup_set(&soup, 1, b, c);
	soup_set(&soup, 2, a, b);
	soup_set(&soup, 3, b, c);
	static const bool want[] = { true, false, true, false, true };
	for (soup.n = 0; soup.n <= 4; soup.n++)
		expect(found_closed(api, &soup) == want[soup.n], "%zu edges", soup.n);
	soup.n = 1;
	soup_set(&soup, 0, a, c);
	expect(found_closed(api, &soup), "an edge from (0,1) to (-0,1)");
	check_end();
	soup.n = 4;
	soup_free(&soup);
}

/* A closed soup with one thing changed must be open. */

static void without_edge(const Api *api, Soup *soup, size_t i)
{
	(void)api;
	soup_swap(soup, i, soup->n - 1);
	soup->n--;
}

static void turn_around(const Api *api, Soup *soup, size_t i)
{
	const double from[2] = { soup->at[X1][i], soup->at[Y1][i] };
	const double to[2] = { soup->at[X0][i], soup->at[Y0][i] };
	(void)api;
	soup_set(soup, i, from, to);
}

static void edge_twice(const Api *api, Soup *soup, size_t i)
{
	(void)api;
	for (int s = 0; s < SIDES; s++)
		soup->at[s][i ? i - 1 : soup->n - 1] = soup->at[s][i];
}

static void one_bit(const Api *api, Soup *soup, size_t i)
{
	double *v = &soup->at[random_int(0, SIDES - 1)][i];
	*v = *v < 0 ? -next_up(api, -*v) : next_up(api, *v);
}

static void sign_of_one(const Api *api, Soup *soup, size_t i)
{
	double *v = &soup->at[random_int(0, SIDES - 1)][i];
	(void)api;
	*v = -*v;
}

static void exchange_axes(const Api *api, Soup *soup, size_t i)
{
	const double x = soup->at[X0][i];
	(void)api;
	soup->at[X0][i] = soup->at[Y0][i];
	soup->at[Y0][i] = x;
}

static const struct {
	const char *name;
	void (*change)(const Api *api, Soup *soup, size_t i);
} changes[] = {
	{ "without an edge", without_edge }, { "with an edge turned around", turn_around },
	{ "with an edge for another", edge_twice }, { "off by one bit", one_bit },
	{ "with a sign changed", sign_of_one }, { "with x and y exchanged", exchange_axes }
};

static const struct {
	const char *name;
	Place *place;
} places[] = {
	{ "a grid", place_grid }, { "mixed scales", place_anywhere },
	{ "the unit square", place_unit }, { "denormals", place_denormal }
};

enum { CHANGES = sizeof changes / sizeof *changes, PLACES = sizeof places / sizeof *places };

static void test_changes(const Api *api, int c)
{
	long open = 0;
	check_begin("is_closed of closed edges %s, %s", changes[c].name, api->name);
	for (int i = 0; i < 4000; i++) {
		const int most = i % 10 ? 40 : 400;
		Soup soup = soup_closed(api, (size_t)random_int(1, most), places[i % PLACES].place);
		const size_t n = soup.n;
		expect(found_closed(api, &soup), "%zu edges on %s are closed", n,
			places[i % PLACES].name);
		changes[c].change(api, &soup, (size_t)random_int(0, (int)n - 1));
		const bool want = counts_closed(&soup);
		expect(found_closed(api, &soup) == want, "%zu edges on %s are %s", n,
			places[i % PLACES].name, want ? "closed" : "open");
		open += !want;
		soup.n = n;
		soup_free(&soup);
	}
	expect(open > 2000, "only %ld were open", open);
	check_end();
}

static void test_large(const Api *api)
{
	check_begin("is_closed of 200000 edges, %s", api->name);
	for (int p = 0; p < PLACES; p++) {
		Soup soup = soup_closed(api, 200000, places[p].place);
		expect(found_closed(api, &soup), "on %s: closed", places[p].name);
		do
			soup.n--;
		while (soup.at[X0][soup.n] == soup.at[X1][soup.n]
			&& soup.at[Y0][soup.n] == soup.at[Y1][soup.n]);
		expect(!found_closed(api, &soup), "on %s: without an edge", places[p].name);
		soup_free(&soup);
	}
	check_end();
}

static void test_nonfinite(const Api *api)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	check_begin("is_closed of NaN and infinity, %s", api->name);
	for (int i = 0; i < 3000; i++) {
		Soup soup = soup_closed(api, (size_t)random_int(1, 30), place_grid);
		const size_t at = (size_t)random_int(0, (int)soup.n - 1);
		const int s = random_int(0, SIDES - 1);
		soup.at[s][at] = bad[i % 3];
		if (random_int(0, 1))           /* the same at the other end */
			soup.at[s ^ 2][at] = bad[i % 3];
		expect(!found_closed(api, &soup), "%g at side %d of edge %zu", bad[i % 3], s, at);
		soup_free(&soup);
	}
	check_end();
}

/* Open soups that are as alike as can be: vertices with weights that do not cancel. */

enum { MOST_VERTICES = 8 };

typedef struct {
	int n, weight[MOST_VERTICES];
	double v[MOST_VERTICES][2];
} Alike;

/* Corners (x, y) to (x + w, y + h), + - - +: all sums of functions of x or of y alone vanish. */
static void fill_corners(Alike *a, double x, double y, double w, double h)
{
	a->n = 4;
	for (int i = 0; i < 4; i++) {
		a->v[i][0] = i & 1 ? x + w : x;
		a->v[i][1] = i & 2 ? y + h : y;
		a->weight[i] = i == 0 || i == 3 ? 1 : -1;
	}
}

static void alike_rectangle(const Api *api, Alike *a)
{
	double v[4];
	(void)api;
	for (int i = 0; i < 4; i++)
		v[i] = random_int(1, 2000) * (i < 2 ? random_int(-1, 1) : 1);
	fill_corners(a, v[0], v[1], v[2], v[3]);
}

static void alike_powers(const Api *api, Alike *a)
{
	double v[4];
	(void)api;
	for (int i = 0; i < 4; i++)
		v[i] = ldexp(random_int(0, 1) ? 1 : -1, random_int(-10, 10));
	fill_corners(a, v[0], v[1], fabs(v[2]), fabs(v[3]));
}

static void alike_signs(const Api *api, Alike *a)
{
	const double x = round_to(api->bits, random_real(0, 100) + 1);
	const double y = random_int(1, 100000);
	fill_corners(a, -x, -y, 2 * x, 2 * y);
}

static void alike_neighbours(const Api *api, Alike *a)
{
	const double x = round_to(api->bits, random_real(1, 2));
	const double y = random_int(1, 100000);
	fill_corners(a, x, y, next_up(api, x) - x, next_up(api, y) - y);
}

static void alike_exchanged(const Api *api, Alike *a)
{
	const double x = round_to(api->bits, random_real(-1, 0));
	const double y = random_int(0, 1000);
	(void)api;
	a->n = 2;
	for (int i = 0; i < 2; i++) {
		a->v[i][0] = i ? y : x;
		a->v[i][1] = i ? x : y;
		a->weight[i] = i ? -1 : 1;
	}
}

static void alike_pair(const Api *api, Alike *a)
{
	a->n = 2;
	for (int i = 0; i < 2; i++) {
		place_grid(api, a->v[i]);
		a->weight[i] = i ? -1 : 1;
	}
	a->v[1][0] += a->v[0][0] == a->v[1][0] && a->v[0][1] == a->v[1][1];
}

/* Third differences along a line: polynomials to degree 2 vanish. */
static void alike_differences(const Api *api, Alike *a)
{
	static const int weight[] = { 1, -3, 3, -1 };
	double start[2], step[2];
	place_grid(api, start);
	place_grid(api, step);
	step[0] += 10;
	a->n = 4;
	for (int i = 0; i < 4; i++) {
		a->v[i][0] = start[0] + i * step[0];
		a->v[i][1] = start[1] * 1000 + i * step[1];
		a->weight[i] = weight[i];
	}
}

/* Three bits of y, all eight ways. */
static void alike_bits(const Api *api, Alike *a)
{
	const double x = random_int(-100000, 100000);
	const int bits[] = { random_int(0, 6), random_int(7, 13), random_int(14, 19) };
	(void)api;
	a->n = 8;
	for (int i = 0; i < 8; i++) {
		a->v[i][0] = x;
		a->v[i][1] = 0x1p20;
		a->weight[i] = 1;
		for (int b = 0; b < 3; b++) {
			if (i >> b & 1) {
				a->v[i][1] += ldexp(1, bits[b]);
				a->weight[i] *= -1;
			}
		}
	}
}

static void alike_tiny(const Api *api, Alike *a)
{
	const double x = api->denormal * random_int(-1000, 1000);
	const double y = api->denormal * random_int(-1000, 1000);
	const double w = api->denormal * random_int(1, 1000);
	fill_corners(a, x, y, w, api->denormal * random_int(1, 1000));
}

static const struct {
	const char *name;
	void (*fill)(const Api *api, Alike *a);
} alikes[] = {
	{ "rectangles", alike_rectangle }, { "powers of two", alike_powers },
	{ "mirror images", alike_signs }, { "neighbours", alike_neighbours },
	{ "x and y exchanged", alike_exchanged }, { "pairs of a grid", alike_pair },
	{ "third differences", alike_differences }, { "bits of y", alike_bits },
	{ "denormals", alike_tiny }
};

/* Edges between the positive and the negative ones. */
static void soup_alike(Soup *soup, const Alike *a)
{
	size_t starts = 0, ends = 0;
	for (int i = 0; i < a->n; i++) {
		for (int w = 0; w < abs(a->weight[i]); w++) {
			const int side = a->weight[i] > 0 ? X0 : X1;
			const size_t at = side == X0 ? starts++ : ends++;
			soup->at[side][at] = a->v[i][0];
			soup->at[side + 1][at] = a->v[i][1];
		}
	}
	soup->n = starts;
}

static void test_alike(const Api *api, size_t kind)
{
	Soup soup = soup_new(MOST_VERTICES);
	check_begin("is_closed of open edges: %s, %s", alikes[kind].name, api->name);
	for (int i = 0; i < 100000; i++) {
		Alike a;
		alikes[kind].fill(api, &a);
		soup_alike(&soup, &a);
		expect(!found_closed(api, &soup), "soup %d: (%g,%g) -> (%g,%g) and so on", i,
			soup.at[X0][0], soup.at[Y0][0], soup.at[X1][0], soup.at[Y1][0]);
	}
	check_end();
	soup_free(&soup);
}

/* closure */

/* (x - px)(y - py), exactly. */
static void exact_term(mpq_t out, double x, double y, double px, double py)
{
	mpq_t a, b;
	mpq_inits(a, b, NULL);
	mpq_set_d(out, x);
	mpq_set_d(a, px);
	mpq_sub(out, out, a);
	mpq_set_d(b, y);
	mpq_set_d(a, py);
	mpq_sub(b, b, a);
	mpq_mul(out, out, b);
	mpq_clears(a, b, NULL);
}

/* The sum over all edges, and its weight. */
static void exact_closure(Ref *out, const Soup *soup, double px, double py)
{
	mpq_t term;
	mpq_init(term);
	for (size_t i = 0; i < soup->n; i++) {
		exact_term(term, soup->at[X0][i], soup->at[Y0][i], px, py);
		mpq_add(out->value, out->value, term);
		mpq_abs(term, term);
		mpq_add(out->weight, out->weight, term);
		exact_term(term, soup->at[X1][i], soup->at[Y1][i], px, py);
		mpq_sub(out->value, out->value, term);
		mpq_abs(term, term);
		mpq_add(out->weight, out->weight, term);
	}
	mpq_clear(term);
}

/* K of the comment above, or fewer: n terms meet in n - 1 additions, all others are of 0. */
static long closure_k(const Api *api, size_t n)
{
	const size_t lanes = api->bits == 24 ? 16 : 8;
	const size_t items = api->bits == 24 && n > 1024 ? 1024 : n;
	long sums = items ? (long)((items - 1) / lanes) : 0;
	for (size_t half = lanes / 2; half > 0; half /= 2)
		sums++;
	if (n > 0 && sums > (long)n - 1)
		sums = (long)n - 1;
	return 1 + sums + (api->bits == 24);
}

static double random_origin(const Api *api)
{
	return round_to(api->bits, random_scaled(-3, 10));
}

static const size_t sizes[] = {
	1, 2, 3, 7, 8, 9, 16, 23, 24, 25, 31, 32, 33, 100, 257, 1000, 3000
};

enum { SIZES = sizeof sizes / sizeof *sizes };

static void test_bound(const Api *api, const char *target)
{
	check_begin("closure within its bound, %s, %s", api->name, target);
	for (size_t i = 0; i < 20 * SIZES; i++) {
		const size_t n = sizes[i % SIZES];
		const double px = random_origin(api);
		const double py = random_origin(api);
		Soup soup = soup_new(n);
		for (size_t j = 0; j < n; j++) {
			double ends[2][2];
			place_anywhere(api, ends[0]);
			place_anywhere(api, ends[1]);
			soup_set(&soup, j, ends[0], ends[1]);
		}
		soup_pack(api, &soup);
		Ref *exact = ref_new(1);
		exact_closure(exact, &soup, px, py);
		expect_within(of(api)->closure(&soup, px, py), exact, closure_k(api, n) + 3,
			api->bits, 0, "closure of %zu edges", n);
		ref_free(exact, 1);
		soup_free(&soup);
	}
	check_end();
}

static void test_closed(const Api *api, const char *target)
{
	double worst = 0;
	check_begin("closure of closed edges, %s, %s", api->name, target);
	for (size_t i = 0; i < 20 * SIZES; i++) {
		const size_t n = sizes[i % SIZES];
		const double px = random_origin(api);
		const double py = random_origin(api);
		Soup soup = soup_closed(api, n, places[i % 3].place);
		Ref *exact = ref_new(1);
		exact_closure(exact, &soup, px, py);
		expect(mpq_sgn(exact->value) == 0, "the test's soup is open");
		const double got = of(api)->closure(&soup, px, py);
		expect_within(got, exact, closure_k(api, n) + 1, api->bits, 0,
			"closure of %zu closed edges", n);
		worst = fmax(worst, n > 1 ? ref_units(got, exact, api->bits)
			/ (double)(closure_k(api, n) + 1) : 0);
		ref_free(exact, 1);
		soup_free(&soup);
	}
	check_end();
	printf("# %s, %s: at most %.2f of the tolerance\n", api->name, target, worst);
}

/* The sums of x, y and x y over the loose ends vanish, so closure misses these two edges wherever
 * (px,py) is; is_closed does not. A third edge shows that closure could. */
static void test_missed(const Api *api, const char *target)
{
	static const double v[][2] = {
		{ 1, 0 }, { 2, 0 }, { -1, 0 }, { -2, 0 }, { 0, 1 }, { 3, 5 }
	};
	Soup soup = soup_new(3);
	check_begin("closure misses what is_closed finds, %s, %s", api->name, target);
	for (size_t i = 0; i < 3; i++)
		soup_set(&soup, i, v[2 * i], v[2 * i + 1]);
	soup.n = 2;
	expect(!found_closed(api, &soup), "found closed");
	for (int i = 0; i < 1000; i++) {
		const double px = round_to(api->bits, random_real(-10, 10));
		const double py = round_to(api->bits, random_real(-10, 10));
		Ref *exact = ref_new(1);
		exact_closure(exact, &soup, px, py);
		expect(mpq_sgn(exact->value) == 0, "p = (%g, %g): not missed", px, py);
		expect_within(of(api)->closure(&soup, px, py), exact, closure_k(api, 2) + 3,
			api->bits, 0, "closure about (%g, %g)", px, py);
		ref_free(exact, 1);
	}
	soup.n = 3;
	soup_pack(api, &soup);
	const double third = of(api)->closure(&soup, 0, 0);
	expect(!of(api)->is_closed(&soup) && third == -15, "0 + 0 - 15 is %g", third);
	check_end();
	soup_free(&soup);
}

static void test_nothing(const Api *api, const char *target)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	check_begin("closure of nothing, of NaN and infinity, %s, %s", api->name, target);
	Soup none = soup_new(0);
	const double nothing = of(api)->closure(&none, 1, 2);
	expect(nothing == 0, "no edges give %g", nothing);
	soup_free(&none);
	for (int i = 0; i < 600; i++) {
		Soup soup = soup_closed(api, (size_t)random_int(1, 60), place_unit);
		soup.at[random_int(0, SIDES - 1)][random_int(0, (int)soup.n - 1)] = bad[i % 3];
		soup_pack(api, &soup);
		const double got = of(api)->closure(&soup, 0.25, 2);
		expect(!isfinite(got), "%g among %zu edges gives %g", bad[i % 3], soup.n, got);
		soup_free(&soup);
	}
	check_end();
}

/* fma, avx2, avx512 and neon: the same bits. */
static void test_bits(const Api *api, const char *target)
{
	if (strcmp(target, "portable") == 0 || strcmp(target, "fma") == 0)
		return;
	unsigned used = 1;
	while (!(ew_targets() & used) || strcmp(ew_target_name(used), target) != 0)
		used <<= 1;
	check_begin("closure has the bits of fma, %s, %s", api->name, target);
	for (int i = 0; i < 2000; i++) {
		Soup soup = soup_closed(api, (size_t)random_int(0, i % 20 ? 80 : 3000),
			places[i % 3].place);
		const double px = random_origin(api);
		const double py = random_origin(api);
		const double got = of(api)->closure(&soup, px, py);
		expect(ew_use_target(EW_FMA) == EW_OK, "there is no fma to compare with");
		const double want = of(api)->closure(&soup, px, py);
		ew_use_target(used);
		expect(memcmp(&got, &want, sizeof got) == 0, "%zu edges: %a, fma has %a", soup.n,
			got, want);
		soup_free(&soup);
	}
	check_end();
}

/* One edge. */
static void test_line(const Api *api)
{
	check_begin("line_closure, %s", api->name);
	for (int i = 0; i < 20000; i++) {
		Place *const place = places[i % 3].place;
		double ends[2][2];
		const double px = random_origin(api);
		const double py = random_origin(api);
		place(api, ends[0]);
		place(api, ends[1]);
		Soup soup = soup_new(1);
		soup_set(&soup, 0, ends[0], ends[1]);
		Ref *exact = ref_new(1);
		exact_closure(exact, &soup, px, py);
		const double edge[] = { ends[0][0], ends[0][1], ends[1][0], ends[1][1] };
		const double back[] = { edge[X1], edge[Y1], edge[X0], edge[Y0] };
		const double stays[] = { edge[X0], edge[Y0], edge[X0], edge[Y0] };
		const double got = of(api)->line(edge, px, py);
		expect_within(got, exact, 4, api->bits, 0, "line_closure");
		expect(same_bits(of(api)->line(back, px, py), -got), "reversed: %a, not %a",
			of(api)->line(back, px, py), -got);
		expect(of(api)->line(stays, px, py) == 0, "a point gives %g",
			of(api)->line(stays, px, py));
		ref_free(exact, 1);
		soup_free(&soup);
	}
	const double whole[] = { 7, 5, 2, 9 }, bad[] = { 7, NAN, 2, 9 };
	expect(of(api)->line(whole, 1, 2) == 11, "6 3 - 1 7 is %g", of(api)->line(whole, 1, 2));
	expect(isnan(of(api)->line(bad, 1, 2)), "NaN gives %g", of(api)->line(bad, 1, 2));
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	for (int i = 0; i < APIS; i++) {
		test_small(&apis[i]);
		test_counting(&apis[i]);
		for (int c = 0; c < CHANGES; c++)
			test_changes(&apis[i], c);
		test_large(&apis[i]);
		test_nonfinite(&apis[i]);
		for (size_t k = 0; k < sizeof alikes / sizeof *alikes; k++)
			test_alike(&apis[i], k);
		test_line(&apis[i]);
	}
	for_each_target(test_bound);
	for_each_target(test_closed);
	for_each_target(test_missed);
	for_each_target(test_nothing);
	for_each_target(test_bits);
	return check_finish();
}

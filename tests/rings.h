/* rings.h - what the ring tests share: the two precisions behind one table, the rows of the ring
 * list with their bounds, and rings of random coordinates.
 *
 * A test is written once for an Api and passes coordinates as doubles that the precision can hold;
 * ring_pack makes the arrays that the library reads. Results come back through get().
 */
#ifndef RINGS_H
#define RINGS_H

#include "edgewise.h"
#include "edgewise_kernels.h"

#include "bounds.h"

enum { MOMENTS = EW_MOMENTS(EW_MAX_DEGREE) };

typedef struct {
	const char *name;
	size_t size;
	int bits;
	double denormal;        /* the smallest positive number */
	int (*moments)(int degree, const void *x, const void *y, size_t n, void *out);
	int (*about)(int degree, const void *x, const void *y, size_t n, double cx, double cy,
		void *out);
	int (*xy)(int degree, const void *xy, size_t n, void *out);
	int (*translate)(int degree, const void *in, double dx, double dy, void *out);
	double (*moment)(int m, int n_, const void *x, const void *y, size_t n);
	double (*area)(const void *x, const void *y, size_t n);
	int (*centroid)(const void *x, const void *y, size_t n, void *c);
	int (*central)(int degree, const void *x, const void *y, size_t n, void *c, void *out);
	double (*compensated)(const void *x, const void *y, size_t n);
} Api;

#define RING_FUNCTIONS(REAL, f) \
static inline int api_moments##f(int degree, const void *x, const void *y, size_t n, void *out) \
{ \
	return ew_moments##f(degree, x, y, n, out); \
} \
static inline int api_about##f(int degree, const void *x, const void *y, size_t n, double cx, \
	double cy, void *out) \
{ \
	return ew_moments_about##f(degree, x, y, n, (REAL)cx, (REAL)cy, out); \
} \
static inline int api_xy##f(int degree, const void *xy, size_t n, void *out) \
{ \
	return ew_moments_xy##f(degree, xy, n, out); \
} \
static inline int api_translate##f(int degree, const void *in, double dx, double dy, void *out) \
{ \
	return ew_translate_moments##f(degree, in, (REAL)dx, (REAL)dy, out); \
} \
static inline double api_moment##f(int m, int n_, const void *x, const void *y, size_t n) \
{ \
	return (double)ew_moment##f(m, n_, x, y, n); \
} \
static inline double api_area##f(const void *x, const void *y, size_t n) \
{ \
	return (double)ew_area##f(x, y, n); \
} \
static inline int api_centroid##f(const void *x, const void *y, size_t n, void *c) \
{ \
	return ew_centroid##f(x, y, n, c); \
} \
static inline int api_central##f(int degree, const void *x, const void *y, size_t n, void *c, \
	void *out) \
{ \
	return ew_central_moments##f(degree, x, y, n, c, out); \
} \
static inline double api_compensated##f(const void *x, const void *y, size_t n) \
{ \
	return (double)ew_area_compensated##f(x, y, n); \
}

RING_FUNCTIONS(double, )
RING_FUNCTIONS(float, f)

#define RING_API(REAL, f, bits, denormal) { #REAL, sizeof(REAL), bits, denormal, api_moments##f, \
	api_about##f, api_xy##f, api_translate##f, api_moment##f, api_area##f, api_centroid##f, \
	api_central##f, api_compensated##f }

enum { APIS = 2 };

static const Api apis[APIS] = {
	RING_API(double, , 53, 0x1p-1074), RING_API(float, f, 24, 0x1p-149)
};

/* Element i of an array of the precision, whatever type it was declared with. */
static inline double get(const Api *api, const void *p, int i)
{
	float f;
	double d;
	if (api->bits == 24) {
		memcpy(&f, (const char *)p + (size_t)i * sizeof f, sizeof f);
		return (double)f;
	}
	memcpy(&d, (const char *)p + (size_t)i * sizeof d, sizeof d);
	return d;
}

static inline void put(const Api *api, void *p, size_t i, double v)
{
	if (api->bits == 24) {
		const float f = (float)v;
		memcpy((char *)p + i * sizeof f, &f, sizeof f);
	} else {
		memcpy((char *)p + i * sizeof v, &v, sizeof v);
	}
}

/* The rows of the ring list and the bounds they promise. */

typedef struct {
	const char *name, *family;
	int m, n, accumulators, outputs, k, r;
} Row;

#define RING_ROW(id, family, m, n, accumulators, outputs, k, r) \
	[id] = { #id, #family, m, n, accumulators, outputs, k, r },

static const Row ring_rows[] = { EW_RINGS(RING_ROW) };

enum { ROWS = sizeof ring_rows / sizeof *ring_rows };

typedef struct {
	size_t window, turns;   /* vertices of an item, sets of accumulators */
	ew_ring_finish *finish;
} Shape;

#define RING_SHAPE(id, window, turns, accumulators, outputs, finish) \
	[id] = { window, turns, finish },

static const Shape ring_shapes[ROWS] = { EW_RINGS_SHAPES(RING_SHAPE) };

static inline const Row *find_row(const char *family, int m, int n)
{
	for (int i = 0; i < ROWS; i++) {
		const Row *row = &ring_rows[i];
		if (strcmp(row->family, family) == 0 && row->m == m && row->n == n)
			return row;
	}
	printf("not ok %s x%dy%d: no such row in EW_RINGS\n", family, m, n);
	exit(1);
}

enum { SHORT = 24 };            /* rings of fewer vertices run in one lane */

static inline size_t ring_lanes(const Api *api, size_t n)
{
	return n < SHORT ? 1 : api->bits == 24 ? 16 : 8;
}

/* Roundings on the way of one term of a ring of n vertices: k of its item and of the results, r for
 * each further item of its lane and turn, and the halving of the lanes. Float sums go to double
 * after 1024 items, and are rounded to float in the end. A closing vertex that makes a ring of 24
 * out of a short one is not counted. */
static inline long ring_k(const Api *api, const Row *row, size_t n)
{
	const Shape *shape = &ring_shapes[row - ring_rows];
	const size_t lanes = ring_lanes(api, n), at_once = lanes * shape->turns;
	size_t items = n + 2 > shape->window ? n + 2 - shape->window : 0;
	if (api->bits == 24 && items > 1024)
		items = 1024;
	long k = row->k + (api->bits == 24);
	for (size_t half = lanes / 2; half > 0; half /= 2)
		k++;
	return items ? k + row->r * (long)((items - 1) / at_once) : k;
}

/* Rings. */

typedef struct {
	size_t n;
	double *x, *y;          /* the coordinates */
	void *px, *py, *pxy;    /* the same as the library reads them */
} Ring;

static inline void *allocate(size_t bytes)
{
	void *p = malloc(bytes ? bytes : 1);
	if (!p)
		abort();
	return p;
}

static inline Ring ring_of_size(size_t n, size_t size)
{
	return (Ring){ n, allocate(n * sizeof(double)), allocate(n * sizeof(double)),
		allocate(n * size), allocate(n * size), allocate(2 * n * size) };
}

/* A ring that either precision can be packed into. */
static inline Ring ring_new(size_t n)
{
	return ring_of_size(n, sizeof(double));
}

static inline void ring_free(Ring *ring)
{
	free(ring->x);
	free(ring->y);
	free(ring->px);
	free(ring->py);
	free(ring->pxy);
}

/* Its vertices, without a closing one that decides whether it is short. */
static inline size_t ring_count(const Ring *ring)
{
	const size_t n = ring->n;
	return n - (n == SHORT && ring->x[0] == ring->x[n - 1] && ring->y[0] == ring->y[n - 1]);
}

/* Rounds x and y to the precision and fills the library's arrays. */
static inline void ring_pack(const Api *api, Ring *ring)
{
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = round_to(api->bits, ring->x[i]);
		ring->y[i] = round_to(api->bits, ring->y[i]);
		put(api, ring->px, i, ring->x[i]);
		put(api, ring->py, i, ring->y[i]);
		put(api, ring->pxy, 2 * i, ring->x[i]);
		put(api, ring->pxy, 2 * i + 1, ring->y[i]);
	}
}

/* Counterclockwise around (cx,cy), radii between size/2 and size. */
static inline void ring_star(Ring *ring, double cx, double cy, double size)
{
	for (size_t i = 0; i < ring->n; i++) {
		const double turn = ((double)i + random_real(0, 0.5)) / (double)ring->n;
		const double radius = size * random_real(0.5, 1);
		ring->x[i] = cx + radius * cos(6.283185307179586 * turn);
		ring->y[i] = cy + radius * sin(6.283185307179586 * turn);
	}
}

/* The same around a random centre, its coordinates below away. */
static inline void ring_star_near(Ring *ring, double away, double size)
{
	const double cx = random_real(-away, away);
	const double cy = random_real(-away, away);
	ring_star(ring, cx, cy, size);
}

/* Coordinates of random sign and size, 2^low to 2^high. */
static inline void ring_scaled(Ring *ring, int low, int high)
{
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = random_scaled(low, high);
		ring->y[i] = random_scaled(low, high);
	}
}

/* Rounds every coordinate to a multiple of step. */
static inline void ring_snap(Ring *ring, double step)
{
	for (size_t i = 0; i < ring->n; i++) {
		ring->x[i] = step * rint(ring->x[i] / step);
		ring->y[i] = step * rint(ring->y[i] / step);
	}
}

/* The targets of this machine. */

enum { TARGETS = 8 };

static unsigned target_bit[TARGETS];
static int target_count;

static inline void list_targets(void)
{
	for (unsigned bit = 1; bit && target_count < TARGETS; bit <<= 1) {
		if (ew_targets() & bit)
			target_bit[target_count++] = bit;
	}
}

/* Runs a test for every precision under every target of this machine. */
static inline void for_each_target(void (*test)(const Api *api, const char *target))
{
	const unsigned targets = ew_targets();
	for (unsigned bit = 1; bit; bit <<= 1) {
		if (!(targets & bit))
			continue;
		if (ew_use_target(bit) != EW_OK) {
			printf("not ok target %s: refused, though ew_targets has it\n",
				ew_target_name(bit));
			exit(1);
		}
		for (int i = 0; i < APIS; i++)
			test(&apis[i], ew_target_name(bit));
	}
	ew_use_target(0);
}

#endif

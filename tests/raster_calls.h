/* raster_calls.h - one call of a function that draws, whichever it is, for tests of what is
 * refused: its arguments stand in a struct, so that a test can spoil one of them.
 */
#ifndef RASTER_CALLS_H
#define RASTER_CALLS_H

#include "raster.h"

enum { CALL_RASTER, CALL_BYTES, CALL_PATH, CALL_KINDS };

typedef struct {
	int kind;
	const Api *api;
	const ew_filter *filter;
	const void *x, *y;              /* path: x holds the points, y the weights */
	const int32_t *offsets;
	size_t rings, points, weights;  /* path: rings is the number of verbs */
	const unsigned char *verbs;
	void *pixels;
	int width, height;
	ptrdiff_t stride;
} DrawCall;

#define DRAW(REAL, f) \
static inline int call##f(const DrawCall *c) \
{ \
	const REAL *x = c->x, *y = c->y; \
	if (c->kind == CALL_RASTER) \
		return ew_raster##f(c->filter, x, y, c->offsets, c->rings, c->pixels, c->width, \
			c->height, c->stride); \
	if (c->kind == CALL_BYTES) \
		return ew_raster_u8##f(x, y, c->offsets, c->rings, c->pixels, c->width, c->height, \
			c->stride); \
	return ew_raster_path##f(c->filter, c->verbs, c->rings, x, c->points, y, c->weights, \
		c->pixels, c->width, c->height, c->stride); \
}

DRAW(double, )
DRAW(float, f)

static inline int draw(const DrawCall *c)
{
	return c->api->bits == 24 ? callf(c) : call(c);
}

static inline const char *call_name(const DrawCall *c)
{
	static const char *const names[CALL_KINDS] = {
		"ew_raster", "ew_raster_u8", "ew_raster_path"
	};
	return names[c->kind];
}

static inline size_t call_element(const DrawCall *c)
{
	return c->kind == CALL_BYTES ? 1 : sizeof(float);
}

/* ---- Pixels that must stay ---- */

enum { PAPER = 0x5b, PAPER_SIZE = 1 << 16 };

static unsigned char paper[PAPER_SIZE];

static inline void *paper_new(void)
{
	memset(paper, PAPER, sizeof paper);
	return paper + PAPER_SIZE / 2 / sizeof(double) * sizeof(double);
}

static inline bool paper_blank(void)
{
	return paper[0] == PAPER && memcmp(paper, paper + 1, sizeof paper - 1) == 0;
}

/* The call returns one of two codes and leaves the paper blank. */
static inline void expect_either(const DrawCall *c, int code, int other, const char *what)
{
	paper_new();
	const int got = draw(c);
	expect(got == code || got == other, "%s, %s, %s: code %d, not %d", call_name(c),
		c->api->name, what, got, code);
	expect(paper_blank(), "%s, %s, %s: pixels are touched", call_name(c), c->api->name, what);
}

static inline void expect_refused(const DrawCall *c, int code, const char *what)
{
	expect_either(c, code, code, what);
}

/* ---- A drawing that is right ---- */

enum { DRAWN = 9, WIDE = 20, HIGH = 10 };       /* vertices of two rings; size */

typedef struct {
	double number[APIS][2][2 * DRAWN];      /* x and y, or points and weights, as read */
	int32_t offsets[3];
	unsigned char verbs[6];
} Drawing;

/* Two triangles and a closing vertex each; or a path of every verb. */
static inline DrawCall drawing(Drawing *d, int kind, const Api *api, const ew_filter *filter)
{
	static const double x[DRAWN] = { 1, 1, 12, 4, 1, 6, 15, 9, 6 };
	static const double y[DRAWN] = { 0, 1, 2, 8, 1, 3, 3, 9, 3 };
	static const int32_t offsets[] = { 1, 5, DRAWN };
	static const unsigned char verbs[] = {
		EW_MOVE, EW_LINE, EW_QUAD, EW_CONIC, EW_CUBIC, EW_CLOSE
	};
	double (*number)[2 * DRAWN] = d->number[api - apis];
	memcpy(d->offsets, offsets, sizeof offsets);
	memcpy(d->verbs, verbs, sizeof verbs);
	for (size_t i = 0; i < DRAWN; i++) {
		put(api, number[0], kind == CALL_PATH ? 2 * i : i, x[i]);
		put(api, number[kind != CALL_PATH], kind == CALL_PATH ? 2 * i + 1 : i, y[i]);
	}
	if (kind == CALL_PATH)
		put(api, number[1], 0, 0.5);
	return (DrawCall){ kind, api, filter, number[0], number[1], d->offsets,
		kind == CALL_PATH ? sizeof verbs : 2, DRAWN, 1, d->verbs, paper_new(), WIDE, HIGH,
		WIDE };
}

#endif

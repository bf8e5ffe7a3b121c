/* filters.h - what the tests of filters share: the functions of both precisions of each filter in
 * filter_list.h, and how far from exact they may be.
 *
 * One edge, with u = 2^-bits, w of it in x over the support and D the degree of the integrand along
 * it: vertices relative to the centre are off by u times themselves, which moves the edge and so
 * changes the integral by max|f| times what it sweeps,
 *
 *     u max|f| (Y (|ax| + |bx|) + w |ay|)                     Y the height of the support;
 *
 * heights at the ends of a column as in windows.h, 6 |y - ay| + |y|, against a knot 2 Y; crossings
 * of knots are off by 7 u of the column, 14 |y| in height. What is left are evaluations in which
 * each term carries so many roundings: nodes 4 for each factor, Horner's rule 2, coefficients,
 * weights, factors and sums 8, nodes and pieces added up,
 *
 *     R = 6 D + (D/2 + 1) + 8 + pieces,
 *
 * and the terms are at most the weight of the filter (window_weight). Rings add roundings of sums.
 */
#ifndef FILTERS_H
#define FILTERS_H

#include "windows.h"
#include "filter_list.h"

typedef struct {
	double (*line)(const double e[SIDES], double cx, double cy);
	double (*ring)(const void *x, const void *y, size_t n, double cx, double cy);
} FilterFunctions;

typedef struct {
	const char *name;
	FilterFunctions of[APIS];
	WindowFilter *(*definition)(void);
	double most;                    /* max |f| */
} FilterRow;

#define FILTER_FUNCTIONS(REAL, f, name) \
static double line_##name##f(const double e[SIDES], double cx, double cy) \
{ \
	return (double)ew_line_##name##f((REAL)e[X0], (REAL)e[Y0], (REAL)e[X1], (REAL)e[Y1], \
		(REAL)cx, (REAL)cy); \
} \
static double ring_##name##f(const void *x, const void *y, size_t n, double cx, double cy) \
{ \
	return (double)ew_##name##f(x, y, n, (REAL)cx, (REAL)cy); \
}

#define FILTER_CALLS(name, definition, most, size, unity) \
FILTER_FUNCTIONS(double, , name) \
FILTER_FUNCTIONS(float, f, name)

FILTER_LIST(FILTER_CALLS)

#define FILTER_ROW(name, definition, most, size, unity) { #name, { { line_##name, ring_##name }, \
	{ line_##name##f, ring_##name##f } }, define_##name, most },

static const FilterRow filter_rows[] = { FILTER_LIST(FILTER_ROW) };

enum { FILTER_ROWS = sizeof filter_rows / sizeof *filter_rows };

static inline const FilterFunctions *filter_of(const FilterRow *row, const Api *api)
{
	return &row->of[api - apis];
}

/* A filter's support, weight and R. */
typedef struct {
	const FilterRow *row;
	WindowFilter *definition;
	double low[2], high[2], weight, roundings;
} Subject;

static inline Subject subject_of(const FilterRow *row)
{
	Subject s = { row, row->definition(), { HUGE_VAL, HUGE_VAL }, { -HUGE_VAL, -HUGE_VAL },
		0, 0 };
	int degree = 0;
	for (int i = 0; i < s.definition->count; i++) {
		const WindowPiece *p = &s.definition->pieces[i];
		s.low[0] = fmin(s.low[0], mpq_get_d(p->x0));
		s.low[1] = fmin(s.low[1], mpq_get_d(p->y0));
		s.high[0] = fmax(s.high[0], mpq_get_d(p->x1));
		s.high[1] = fmax(s.high[1], mpq_get_d(p->y1));
		if (degree < p->degree_x + p->degree_y + 1)
			degree = p->degree_x + p->degree_y + 1;
	}
	s.weight = window_weight(s.definition);
	s.roundings = 6 * degree + degree / 2 + 1 + 8 + s.definition->count;
	return s;
}

/* |y| weighted as above, at x of an edge from its vertex (ax,ay). */
static inline double height_error(double x, double ax, double ay, const double e[SIDES])
{
	const double rise = e[X1] == e[X0] ? 0 : (x - ax) / (e[X1] - e[X0]) * (e[Y1] - e[Y0]);
	return fabs(ay) + 6 * fabs(rise) + 15 * fabs(ay + rise);
}

static inline double filter_bound(const Api *api, const Subject *s, const double edge[SIDES],
	double cx, double cy)
{
	const double e[SIDES] = { edge[X0] - cx, edge[Y0] - cy, edge[X1] - cx, edge[Y1] - cy };
	const int a = e[X0] <= e[X1] ? X0 : X1, b = X1 - a;
	const double xl = clamped(s->low[0], e[a], e[b]), xr = clamped(s->high[0], e[a], e[b]);
	const double height = s->high[1] - s->low[1];
	const double error = fmax(height_error(xl, e[a], e[a + 1], e),
		height_error(xr, e[b], e[b + 1], e)) + 2 * height;
	return WINDOW_SECOND * ldexp(1, -api->bits) * (s->roundings * s->weight + s->row->most
		* ((xr - xl) * error + height * (fabs(e[a]) + fabs(e[b]))));
}

#endif

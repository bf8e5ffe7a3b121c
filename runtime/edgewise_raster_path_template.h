/* edgewise_raster_path_template.h - images from paths: curves become chains of lines; included by
 * edgewise_raster.c once per precision.
 *
 * n lines that share a Bezier curve evenly are nowhere farther from it than |second derivative| /
 * (8 n^2): d / (4 n^2) for a quadratic with second difference d, 3 d / (4 n^2) for a cubic whose
 * second differences are at most d. A conic is halved until it is as flat as that: above its chord
 * it is highest at its middle, w / (1 + w) of the height of its control point, and the weight of
 * the halves, sqrt((1 + w) / 2), is above 1/2 after the first time.
 *
 * A path is read twice: its lines are counted, which also checks it, and then drawn.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
typedef struct {
	const ew_raster_image *image;          /* NULL: lines are only counted */
	const EW_REAL *end;                    /* where the chain has got to; NULL: nowhere */
	size_t lines, chains;                  /* counted */
	int code;
	unsigned flags;                        /* of the points in the chain */
	size_t count;                          /* lines of the chain that wait */
	double x[EW_POINTS + 1 + EW_LANES_OF_EDGES], y[EW_POINTS + 1 + EW_LANES_OF_EDGES];
} EW_RASTER(chain);

/* Draws what waits, or lists it. */
static void EW_RASTER(flush)(EW_RASTER(chain) *c)
{
	ew_raster_list *list = c->image->list;
	if (list) {
		memcpy(list->x + list->count, c->x, (c->count + 1) * sizeof *c->x);
		memcpy(list->y + list->count, c->y, (c->count + 1) * sizeof *c->y);
		for (size_t i = 0; i <= c->count; ++i)
			list->next[list->count + i] = i < c->count ? EW_NO_MORE : EW_NO_EDGE;
		list->count += c->count + 1;
	} else {
		for (size_t i = c->count; i % EW_LANES_OF_EDGES; ++i) {
			c->x[i + 1] = c->x[c->count];
			c->y[i + 1] = c->y[c->count];
		}
		c->image->ways->edges(c->image, c->x, c->y, c->x + 1, c->y + 1, c->count,
			!(c->flags & EW_WITHIN));
	}
	c->x[0] = c->x[c->count];
	c->y[0] = c->y[c->count];
	c->count = 0;
}

static void EW_RASTER(put_point)(EW_RASTER(chain) *c, double x, double y)
{
	c->flags &= ew_raster_round(x, &c->image->x, c->x + c->count)
		& ew_raster_round(y, &c->image->y, c->y + c->count);
	if (!(c->flags & EW_IN_RANGE))
		c->code = EW_BAD_COORDINATE;
}

static void EW_RASTER(line_to)(EW_RASTER(chain) *c, double x, double y)
{
	++c->lines;
	if (!c->image || c->code)
		return;
	++c->count;
	EW_RASTER(put_point)(c, x, y);
	if (c->count == EW_POINTS && !c->code)
		EW_RASTER(flush)(c);
}

/* The chain goes on from there, or a new one begins. */
static void EW_RASTER(from)(EW_RASTER(chain) *c, const EW_REAL *point)
{
	if (c->end == point)
		return;
	++c->chains;
	c->end = point;
	if (!c->image || c->code)
		return;
	if (c->count)
		EW_RASTER(flush)(c);
	c->flags = (unsigned)EW_IN_RANGE | (unsigned)EW_WITHIN;
	EW_RASTER(put_point)(c, (double)point[0], (double)point[1]);
}

static void EW_RASTER(closing)(EW_RASTER(chain) *c, const EW_REAL *here, const EW_REAL *start)
{
	if (here[0] == start[0] && here[1] == start[1])
		return;
	EW_RASTER(from)(c, here);
	EW_RASTER(line_to)(c, (double)start[0], (double)start[1]);
	c->end = start;
}

/* |a - 2 b + c| */
static double EW_RASTER(bend)(const double *a, const double *b, const double *c)
{
	const double x = a[0] - 2 * b[0] + c[0], y = a[1] - 2 * b[1] + c[1];
	return sqrt(x * x + y * y);
}

static void EW_RASTER(bezier)(EW_RASTER(chain) *c, double p[4][2], int degree)
{
	double d = EW_RASTER(bend)(p[0], p[1], p[2]);
	if (degree == 3) {
		const double d1 = EW_RASTER(bend)(p[1], p[2], p[3]);
		d = 3 * (d > d1 ? d : d1);
	}
	const double n = ceil(sqrt(d / (4 * EW_FLATNESS)));
	for (double i = 1; i < n; ++i) {
		const double t = i / n, s = 1 - t;
		double q[2];
		for (int k = 0; k < 2; ++k)
			q[k] = degree == 2
				? s * s * p[0][k] + 2 * s * t * p[1][k] + t * t * p[2][k]
				: s * s * (s * p[0][k] + 3 * t * p[1][k])
					+ t * t * (3 * s * p[2][k] + t * p[3][k]);
		EW_RASTER(line_to)(c, q[0], q[1]);
	}
	EW_RASTER(line_to)(c, p[degree][0], p[degree][1]);
}

static void EW_RASTER(conic)(EW_RASTER(chain) *c, double p[3][2], double w)
{
	const double height = EW_RASTER(bend)(p[0], p[1], p[2]) / 2;
	if (w > EW_SHARP) {
		EW_RASTER(line_to)(c, p[1][0], p[1][1]);
		EW_RASTER(line_to)(c, p[2][0], p[2][1]);
	} else if (w > 0 && !(height * (w / (1 + w)) > EW_FLATNESS)) {
		EW_RASTER(line_to)(c, p[2][0], p[2][1]);
	} else if (height > EW_FARTHEST_BEND) {
		c->code = EW_BAD_COORDINATE;
	} else {
		double left[3][2], right[3][2];
		for (int k = 0; k < 2; ++k) {
			left[0][k] = p[0][k];
			left[1][k] = (p[0][k] + w * p[1][k]) / (1 + w);
			right[1][k] = (p[2][k] + w * p[1][k]) / (1 + w);
			left[2][k] = right[0][k] = (left[1][k] + right[1][k]) / 2;
			right[2][k] = p[2][k];
		}
		w = sqrt((1 + w) / 2);
		EW_RASTER(conic)(c, left, w);
		EW_RASTER(conic)(c, right, w);
	}
}

static void EW_RASTER(edge)(EW_RASTER(chain) *c, int verb, const EW_REAL *here, const EW_REAL *next,
	const EW_REAL *weight)
{
	const size_t points = ew_path_points(verb);
	double p[4][2] = { { (double)here[0], (double)here[1] } };
	if (c->code)                           /* the rest is checked for its form only */
		return;
	for (size_t i = 0; i < 2 * points; ++i)
		p[1 + i / 2][i % 2] = (double)next[i];
	EW_RASTER(from)(c, here);
	if (verb == EW_LINE)
		EW_RASTER(line_to)(c, p[1][0], p[1][1]);
	else if (verb != EW_CONIC)
		EW_RASTER(bezier)(c, p, verb == EW_QUAD ? 2 : 3);
	else if (!c->code)
		EW_RASTER(conic)(c, p, (double)*weight);
	c->end = next + 2 * (points - 1);
}

#define EW_READ EW_RASTER(read)
#define EW_READER EW_RASTER(chain)
#define EW_READ_HAS ew_raster_has
#define EW_READ_EDGE EW_RASTER(edge)
#define EW_READ_CLOSING EW_RASTER(closing)
#include "edgewise_path_template.h"

static int EW_RASTER(check_path)(const unsigned char *verbs, size_t verb_count,
	const EW_REAL *points, size_t point_count, const EW_REAL *weights, size_t weight_count,
	EW_RASTER(chain) *c)
{
	if ((verb_count && !verbs) || (point_count && !points) || (weight_count && !weights)
	    || (verb_count && verbs[0] != EW_MOVE))
		return EW_BAD_PATH;
	for (size_t i = 0; i < 2 * point_count; ++i)
		if (!((double)points[i] >= -EW_FURTHEST && (double)points[i] <= EW_FURTHEST))
			c->code = EW_BAD_COORDINATE;
	for (size_t i = 0; i < weight_count; ++i)
		if (!((double)weights[i] > -1))
			c->code = EW_BAD_COORDINATE;
	return EW_RASTER(read)(c, verbs, verb_count, points, point_count, weights, weight_count)
		? c->code : EW_BAD_PATH;
}

int EW_NAME(raster_path)(const ew_filter *filter, const unsigned char *verbs, size_t verb_count,
	const EW_REAL *points, size_t point_count, const EW_REAL *weights, size_t weight_count,
	float *pixels, int width, int height, ptrdiff_t row_stride)
{
	const ew_raster_pixels to = { pixels, NULL, row_stride };
	ew_raster_scratch scratch;
	ew_raster_image image;
	EW_RASTER(chain) c;
	int code = filter ? ew_raster_check(pixels, width, height, row_stride) : EW_BAD_IMAGE;
	if (code)
		return code;
	c.image = NULL;
	c.end = NULL;
	c.lines = c.chains = c.count = 0;
	c.code = EW_OK;
	c.flags = 0;
	code = EW_RASTER(check_path)(verbs, verb_count, points, point_count, weights, weight_count,
		&c);
	if (code || width == 0 || height == 0)
		return code;
	code = ew_raster_begin(&image, filter, width, height, c.lines + c.lines / EW_POINTS
		+ c.chains + 1, &scratch);
	if (code)
		return code;
	c.image = &image;
	c.end = NULL;
	EW_RASTER(read)(&c, verbs, verb_count, points, point_count, weights, weight_count);
	if (c.count && !c.code)
		EW_RASTER(flush)(&c);
	if (!c.code)
		ew_raster_draw(&image, &to);
	ew_raster_end(&image);
	return c.code;
}

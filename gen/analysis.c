/* analysis.c - what holds of a filter, exactly.
 *
 * A piece p on [x0,x1] x [y0,y1] is p times a product of step functions, one at each corner with
 * alternating sign. So the polynomials at all corners, signed and added up where corners coincide,
 * say where f is not smooth; and corners that coincide modulo whole pixels say it of the sum S of
 * all whole-pixel shifts of f, however many overlap. A filter k(x) k(y) has corners on a line.
 *
 * S is 1 (a partition of unity) iff f has the integral 1 and S is one polynomial: being periodic,
 * that is a constant, the mean. On a line S is one polynomial iff the sums of all classes vanish.
 * In the plane that leaves a(x) + b(y), so the same must hold of the integrals of f over y and over
 * x. k(x) k(y) is 1 for k = -1 as well.
 *
 * f has m derivatives iff it has m across every border of every piece, because around a corner the
 * limits from neighbouring pieces agree in turn. */
#include "gen.h"

#include <stdlib.h>

enum { AXIS_X, AXIS_Y };

typedef struct { Rat at[2]; Poly value; } Corner;    /* value about the corner, signed */

static int same(Rat a, Rat b)
{
	return a.num == b.num && a.den == b.den;
}

static int is_whole(Rat a)
{
	return a.den == 1;
}

/* 0 <= result < 1 */
static Rat fraction(Rat a)
{
	return rat_add(a, rat(rat_ceil(rat_neg(a)), 1));
}

static Rat side(const Piece *piece, int axis, int end)
{
	const Rat sides[2][2] = { { piece->x0, piece->x1 }, { piece->y0, piece->y1 } };
	return sides[axis][end];
}

/* a(x + by) for this variable */
static Poly moved(Poly a, int var, Rat by)
{
	if (by.num == 0)
		return a;
	Poly sum = poly_add(poly_var(var), poly_const(by));
	return poly_substitute(a, &var, &sum, 1);
}

/* The integral over one variable. */
static Poly integrated(Poly a, int var, Rat from, Rat to)
{
	const Poly primitive = poly_integral(a, var);
	const Poly ends[2] = { poly_const(from), poly_const(to) };
	return poly_sub(poly_substitute(primitive, &var, &ends[1], 1),
		poly_substitute(primitive, &var, &ends[0], 1));
}

static int lowest_power(Poly a, int var)
{
	int lowest = mono_power(a.term[0].mono, var);
	for (int i = 1; i < a.count; ++i)
		if (mono_power(a.term[i].mono, var) < lowest)
			lowest = mono_power(a.term[i].mono, var);
	return lowest;
}

/* ---- pieces in order ---- */

static int in_order(const void *left, const void *right)
{
	const Piece *a = left, *b = right;
	int order = rat_compare(a->x0, b->x0);
	return order ? order : rat_compare(a->y0, b->y0);
}

/* Are they one piece? b does not stand before a. */
static int joins(const Piece *a, const Piece *b)
{
	int beside = same(a->x1, b->x0) && same(a->y0, b->y0) && same(a->y1, b->y1);
	int above = same(a->y1, b->y0) && same(a->x0, b->x0) && same(a->x1, b->x1);
	return (beside || above) && poly_equal(a->value, b->value);
}

static int join_some(Filter *filter)
{
	const int before = filter->pieces;
	for (int i = 0; i < filter->pieces; ++i)
		for (int j = i + 1; j < filter->pieces; ) {
			Piece *a = &filter->piece[i], *b = &filter->piece[j];
			if (!joins(a, b)) {
				++j;
				continue;
			}
			a->x1 = b->x1;
			a->y1 = b->y1;
			for (int k = j + 1; k < filter->pieces; ++k)
				filter->piece[k - 1] = filter->piece[k];
			--filter->pieces;
		}
	return filter->pieces < before;
}

/* Both sides of an even filter; nothing that is zero; no border inside one polynomial. */
static void arrange(Filter *filter)
{
	const int var = VAR_X, given = filter->pieces;
	const Poly mirrored = poly_scale(poly_var(VAR_X), rat(-1, 1));
	Piece *all = allocate((size_t)(2 * given) * sizeof *all);
	int count = 0;
	for (int i = 0; i < given; ++i) {
		const Piece piece = filter->piece[i];
		if (piece.value.count == 0)
			continue;
		all[count++] = piece;
		if (filter->even)
			all[count++] = (Piece){ rat_neg(piece.x1), rat_neg(piece.x0), piece.y0,
				piece.y1, poly_substitute(piece.value, &var, &mirrored, 1) };
	}
	qsort(all, (size_t)count, sizeof *all, in_order);
	filter->piece = all;
	filter->pieces = count;
	while (join_some(filter))
		;
}

/* ---- support ---- */

static int axes_of(const Filter *filter)
{
	return filter->separable ? 1 : 2;
}

static void support(Filter *filter, int axis, Rat *first, Rat *last, int *size)
{
	*first = side(&filter->piece[0], axis, 0);
	*last = side(&filter->piece[0], axis, 1);
	int whole = 1;
	for (int i = 0; i < filter->pieces; ++i)
		for (int end = 0; end < 2; ++end) {
			Rat knot = side(&filter->piece[i], axis, end);
			whole &= is_whole(rat_sub(knot, *first));
			if (rat_compare(knot, *first) < 0)
				*first = knot;
			if (rat_compare(knot, *last) > 0)
				*last = knot;
		}
	*size = whole ? (int)rat_sub(*last, *first).num : 0;
}

/* ---- corners ---- */

/* The corners of f, or (bivariate) of the integrals of f over the other variable. */
typedef struct { Corner *corner; int count; } Corners;

static Corners corners_along(const Filter *filter, int axis)
{
	Corners all = { allocate((size_t)(2 * filter->pieces) * sizeof(Corner)), 0 };
	for (int i = 0; i < filter->pieces; ++i) {
		const Piece *piece = &filter->piece[i];
		Poly value = piece->value;
		if (!filter->separable)
			value = integrated(value, axis == AXIS_X ? VAR_Y : VAR_X,
				side(piece, !axis, 0), side(piece, !axis, 1));
		for (int end = 0; end < 2; ++end) {
			Rat knot = side(piece, axis, end);
			all.corner[all.count++] = (Corner){ { knot, rat(0, 1) },
				poly_scale(moved(value, axis == AXIS_X ? VAR_X : VAR_Y, knot),
					rat(end ? -1 : 1, 1)) };
		}
	}
	return all;
}

static Corners corners_of(const Filter *filter)
{
	Corners all = { allocate((size_t)(4 * filter->pieces) * sizeof(Corner)), 0 };
	for (int i = 0; i < filter->pieces; ++i)
		for (int k = 0; k < 4; ++k) {
			const Piece *piece = &filter->piece[i];
			Rat x = side(piece, AXIS_X, k & 1), y = side(piece, AXIS_Y, k >> 1);
			Poly value = moved(moved(piece->value, VAR_X, x), VAR_Y, y);
			all.corner[all.count++] = (Corner){ { x, y },
				poly_scale(value, rat(k == 0 || k == 3 ? 1 : -1, 1)) };
		}
	return all;
}

/* The sum over the corners that coincide with this one, which are then done with. */
static Poly take_class(Corners *corners, int first)
{
	const Corner *corner = corners->corner;
	const Rat x = corner[first].at[AXIS_X], y = corner[first].at[AXIS_Y];
	Poly sum = poly_zero();
	int kept = first;
	for (int i = first; i < corners->count; ++i)
		if (same(corner[i].at[AXIS_X], x) && same(corner[i].at[AXIS_Y], y))
			sum = poly_add(sum, corner[i].value);
		else
			corners->corner[kept++] = corner[i];
	corners->count = kept;
	return sum;
}

/* Do all classes modulo whole pixels vanish? */
static int is_smooth_when_shifted(Corners corners)
{
	for (int i = 0; i < corners.count; ++i)
		for (int axis = 0; axis < 2; ++axis)
			corners.corner[i].at[axis] = fraction(corners.corner[i].at[axis]);
	while (corners.count)
		if (take_class(&corners, 0).count)
			return 0;
	return 1;
}

static int is_unity(const Filter *filter)
{
	if (!rat_is(filter->integral, 1))
		return 0;
	for (int axis = 0; axis < axes_of(filter); ++axis)
		if (!is_smooth_when_shifted(corners_along(filter, axis)))
			return 0;
	return filter->separable || is_smooth_when_shifted(corners_of(filter));
}

/* ---- continuity ---- */

static int least(int a, int b)
{
	return a < b ? a : b;
}

/* A border of a piece, and the polynomial about it, negative where the piece ends. */
typedef struct { Rat at, from, to; int end; Poly value; } Border;

static int by_place(const void *left, const void *right)
{
	const Border *a = left, *b = right;
	int order = rat_compare(a->at, b->at);
	return order ? order : rat_compare(a->from, b->from);
}

static int across(const Border *border, const Border *all, int count, int var)
{
	int derivatives = MAX_DEGREE, alone = 0;
	Rat reached = border->from;
	for (const Border *other = all; other < all + count; ++other) {
		if (!same(other->at, border->at) || other->end == border->end
		    || rat_compare(other->to, border->from) <= 0
		    || rat_compare(other->from, border->to) >= 0)
			continue;
		alone |= rat_compare(other->from, reached) > 0;
		reached = other->to;
		Poly jump = poly_add(border->value, other->value);
		if (jump.count)
			derivatives = least(derivatives, lowest_power(jump, var) - 1);
	}
	alone |= rat_compare(reached, border->to) < 0;
	if (alone)
		derivatives = least(derivatives, lowest_power(border->value, var) - 1);
	return derivatives;
}

static int continuity_along(const Filter *filter, int axis)
{
	const int var = axis == AXIS_X ? VAR_X : VAR_Y, count = 2 * filter->pieces;
	Border *border = allocate((size_t)count * sizeof *border);
	for (int i = 0; i < count; ++i) {
		const Piece *piece = &filter->piece[i / 2];
		const int end = i % 2;
		Rat at = side(piece, axis, end);
		Poly value = poly_scale(moved(piece->value, var, at), rat(end ? -1 : 1, 1));
		Rat from = side(piece, !axis, 0), to = side(piece, !axis, 1);
		border[i] = (Border){ at, from, filter->separable ? rat(1, 1) : to, end, value };
	}
	qsort(border, (size_t)count, sizeof *border, by_place);
	int derivatives = MAX_DEGREE;
	for (int i = 0; i < count; ++i)
		derivatives = least(derivatives, across(&border[i], border, count, var));
	return derivatives;
}

/* ---- all of it ---- */

static Rat integral_of(const Filter *filter)
{
	Rat sum = rat(0, 1);
	for (int i = 0; i < filter->pieces; ++i) {
		const Piece *piece = &filter->piece[i];
		Poly value = integrated(piece->value, VAR_X, piece->x0, piece->x1);
		if (!filter->separable)
			value = integrated(value, VAR_Y, piece->y0, piece->y1);
		if (value.count)
			sum = rat_add(sum, value.term[0].coef);
	}
	return filter->separable ? rat_mul(sum, sum) : sum;
}

void analyse(Filter *filter)
{
	arrange(filter);
	if (filter->pieces == 0)
		fatal(EXIT_USAGE, "this filter is 0 everywhere");
	support(filter, AXIS_X, &filter->first_x, &filter->last_x, &filter->size_x);
	support(filter, AXIS_Y, &filter->first_y, &filter->last_y, &filter->size_y);
	if (filter->separable) {
		filter->first_y = filter->first_x;
		filter->last_y = filter->last_x;
		filter->size_y = filter->size_x;
	}
	filter->continuity = MAX_DEGREE;
	for (int axis = 0; axis < axes_of(filter); ++axis)
		filter->continuity = least(filter->continuity, continuity_along(filter, axis));
	for (int i = 0; i < filter->pieces; ++i) {
		const int degree = degree_in_xy(filter->piece[i].value);
		filter->degree = degree > filter->degree ? degree : filter->degree;
	}
	filter->integral = integral_of(filter);
	filter->unity = is_unity(filter);
}

/* drawing.c - paths that grow: verbs, points and weights, ready for ew_raster_path.
 *
 * A Drawing starts as zeros. Invariant: it holds exactly the points and weights that its verbs
 * take, and its first verb is EW_MOVE. Placing it scales and moves the control points, which for
 * lines, quads, cubics and conics alike is the same as placing the curves. */
#include "render.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

void *allocate(size_t count, size_t size)
{
	void *array = calloc(count ? count : 1, size);
	if (!array)
		fail("no room for %zu times %zu bytes", count, size);
	return array;
}

/* Arrays double whenever count is a power of two. */
void *grow(void *array, size_t count, size_t size)
{
	if (count & (count - 1))
		return array;
	const size_t room = count ? 2 * count : 1;
	void *grown = room > SIZE_MAX / size ? NULL : realloc(array, room * size);
	if (!grown)
		fail("no room for %zu elements", room);
	return grown;
}

int verb_points(unsigned char verb)
{
	static const int points[] = { [EW_MOVE] = 1,  [EW_LINE] = 1,  [EW_QUAD] = 2,
				      [EW_CONIC] = 2, [EW_CUBIC] = 3, [EW_CLOSE] = 0 };
	return points[verb];
}

void drawing_add(Drawing *drawing, unsigned char verb, const double *points, double weight)
{
	drawing->verbs = grow(drawing->verbs, drawing->verb_count, 1);
	drawing->verbs[drawing->verb_count++] = verb;
	for (int i = 0; i < 2 * verb_points(verb); i++) {
		drawing->points = grow(drawing->points, drawing->number_count, sizeof(double));
		drawing->points[drawing->number_count++] = points[i];
	}
	if (verb == EW_CONIC) {
		drawing->weights = grow(drawing->weights, drawing->weight_count, sizeof(double));
		drawing->weights[drawing->weight_count++] = weight;
	}
}

void drawing_move(Drawing *drawing, double x, double y)
{
	drawing_add(drawing, EW_MOVE, (const double[]){ x, y }, 0);
}

void drawing_line(Drawing *drawing, double x, double y)
{
	drawing_add(drawing, EW_LINE, (const double[]){ x, y }, 0);
}

void drawing_close(Drawing *drawing)
{
	drawing_add(drawing, EW_CLOSE, NULL, 0);
}

void drawing_ellipse(Drawing *drawing, double x, double y, double radius_x, double radius_y)
{
	static const int turn[] = { 1, 0, -1, 0, 1, 0 }; /* cosines of quarters, sines one later */
	drawing_move(drawing, x + radius_x, y);
	for (int i = 0; i < 4; i++) {
		const double c = turn[i], s = turn[(i + 3) % 4];
		const double points[] = { x + radius_x * (c - s), y + radius_y * (s + c),
					  x - radius_x * s, y + radius_y * c };
		drawing_add(drawing, EW_CONIC, points, sqrt(0.5));
	}
	drawing_close(drawing);
}

void drawing_place(Drawing *drawing, Placement place)
{
	for (size_t i = 0; i < drawing->number_count; i += 2) {
		drawing->points[i] = place.scale_x * drawing->points[i] + place.x;
		drawing->points[i + 1] = place.scale_y * drawing->points[i + 1] + place.y;
	}
}

void drawing_append(Drawing *drawing, const Drawing *other, Placement place)
{
	const double *points = other->points, *weight = other->weights;
	for (size_t i = 0; i < other->verb_count; i++) {
		const unsigned char verb = other->verbs[i];
		double placed[6];
		for (int k = 0; k < verb_points(verb); k++, points += 2) {
			placed[2 * k] = place.scale_x * points[0] + place.x;
			placed[2 * k + 1] = place.scale_y * points[1] + place.y;
		}
		drawing_add(drawing, verb, placed, verb == EW_CONIC ? *weight++ : 0);
	}
}

Box drawing_box(const Drawing *drawing)
{
	Box box = { INFINITY, INFINITY, -INFINITY, -INFINITY };
	for (size_t i = 0; i < drawing->number_count; i += 2) {
		const double x = drawing->points[i], y = drawing->points[i + 1];
		box = (Box){ fmin(box.left, x), fmin(box.top, y), fmax(box.right, x),
			     fmax(box.bottom, y) };
	}
	return box;
}

void drawing_free(Drawing *drawing)
{
	free(drawing->verbs);
	free(drawing->points);
	free(drawing->weights);
	*drawing = (Drawing){ 0 };
}

Placement fit(Box box, Box room)
{
	const double width = box.right - box.left, height = box.bottom - box.top;
	double scale = fmin((room.right - room.left) / width, (room.bottom - room.top) / height);
	if (!isfinite(scale)) /* a point, or nothing */
		scale = 1;
	const double x = width >= 0 ? (box.left + box.right) / 2 : 0;
	const double y = height >= 0 ? (box.top + box.bottom) / 2 : 0;
	return (Placement){ scale, scale, (room.left + room.right) / 2 - scale * x,
			    (room.top + room.bottom) / 2 - scale * y };
}

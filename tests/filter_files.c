/* filter_files.c - the analysis of filters against brute force, and the built-in filters against their
 * definitions.
 *
 * A model is a sum of layers, each a polynomial on an interval or a rectangle, which may overlap.
 * Its text, cut along all knots, goes through the reader. What the analysis says of it is compared
 * with values of the model alone: derivatives on both sides of every border, and the sum of all
 * shifts, at more points of every cell of [0,1) than a polynomial that is not constant could agree
 * in. All of it is exact; the arithmetic is that of gen, which tests/units.c checks against GMP.
 *
 * Models are B-splines anywhere plus terms that shifting cancels, g(x) - g(x-1), so that partitions
 * of unity have any knots; some get one term more, which spoils it: everywhere, in one direction
 * only, or at corners only.
 */
#include "check.h"

#include "../gen/gen.h"

enum { TOP = 6, MOST = 200 };                   /* coefficients per variable; layers, knots */

typedef struct { Rat from[2], to[2], coef[TOP][TOP]; } Layer;   /* on a line: y, power 0 only */

typedef struct {
	Layer layer[MOST];
	int layers, axes, even;                 /* axes: 1 for k(x), 2 for f(x,y) */
	Rat knot[2][MOST];
	int knots[2];
} Model;

static Rat whole(int a)
{
	return rat(a, 1);
}

static Rat power(Rat a, int n)
{
	Rat result = whole(1);
	while (n-- > 0)
		result = rat_mul(result, a);
	return result;
}

/* ---- values ---- */

/* x^i differentiated m times */
static Rat derived_power(Rat x, int i, int m)
{
	if (m > i)
		return whole(0);
	Rat factor = whole(1);
	for (int j = 0; j < m; j++)
		factor = rat_mul(factor, whole(i - j));
	return rat_mul(factor, power(x, i - m));
}

/* Is the point, or what lies on this side of it, inside? */
static bool inside(const Layer *layer, int axis, Rat at, int from_left)
{
	const int a = rat_compare(layer->from[axis], at), b = rat_compare(at, layer->to[axis]);
	return from_left ? a < 0 && b <= 0 : a <= 0 && b < 0;
}

/* The derivatives of these orders, at a point approached from the left or below if so told. */
static Rat value(const Model *model, const Rat *at, const int *from_left, const int *order)
{
	Rat sum = whole(0);
	for (const Layer *layer = model->layer; layer < model->layer + model->layers; layer++) {
		if (!inside(layer, 0, at[0], from_left[0])
			|| (model->axes == 2 && !inside(layer, 1, at[1], from_left[1])))
			continue;
		for (int i = 0; i < TOP; i++) {
			for (int j = 0; j < TOP; j++) {
				if (layer->coef[i][j].num == 0)
					continue;
				const Rat x = derived_power(at[0], i, order[0]);
				const Rat y = derived_power(at[1], j, order[1]);
				sum = rat_add(sum, rat_mul(layer->coef[i][j], rat_mul(x, y)));
			}
		}
	}
	return sum;
}

static Rat plain_value(const Model *model, Rat x, Rat y)
{
	const Rat at[2] = { x, y };
	return value(model, at, (int[2]){ 0, 0 }, (int[2]){ 0, 0 });
}

/* Point j of TOP inside a cell. */
static Rat sample(Rat from, Rat to, int j)
{
	return rat_add(from, rat_mul(rat_sub(to, from), rat(2 * j + 1, 2 * TOP)));
}

/* ---- knots ---- */

static int add_knot(Rat *knot, int count, Rat a)
{
	int at = count;
	for (int i = 0; i < count; i++) {
		if (rat_compare(knot[i], a) == 0)
			return count;
	}
	for (; at > 0 && rat_compare(knot[at - 1], a) > 0; at--)
		knot[at] = knot[at - 1];
	knot[at] = a;
	return count + 1;
}

static void find_knots(Model *model)
{
	for (int axis = 0; axis < 2; axis++) {
		model->knots[axis] = 0;
		for (int i = 0; i < model->layers; i++) {
			const Layer *layer = &model->layer[i];
			model->knots[axis] = add_knot(model->knot[axis], model->knots[axis],
				layer->from[axis]);
			model->knots[axis] = add_knot(model->knot[axis], model->knots[axis],
				layer->to[axis]);
		}
	}
}

static Rat floor_of(Rat a)
{
	return whole(-(int)rat_ceil(rat_neg(a)));
}

/* The knots of all shifts in [0,1], ends included. */
static int shifted_knots(const Model *model, int axis, Rat *knot)
{
	int count = add_knot(knot, add_knot(knot, 0, whole(0)), whole(1));
	for (int i = 0; i < model->knots[axis]; i++) {
		const Rat a = model->knot[axis][i];
		count = add_knot(knot, count, rat_sub(a, floor_of(a)));
	}
	return count;
}

/* ---- what should hold ---- */

static Rat sum_of_shifts(const Model *model, Rat x, Rat y)
{
	const Rat *u = model->knot[0], *v = model->knot[1];
	const int x0 = (int)floor_of(u[0]).num - 1, x1 = (int)rat_ceil(u[model->knots[0] - 1]);
	int y0 = 0, y1 = 0;
	if (model->axes == 2) {
		y0 = (int)floor_of(v[0]).num - 1;
		y1 = (int)rat_ceil(v[model->knots[1] - 1]);
	}
	Rat sum = whole(0);
	for (int j = y0; j <= y1; j++) {
		for (int i = x0; i <= x1; i++)
			sum = rat_add(sum, plain_value(model, rat_add(x, whole(i)),
				rat_add(y, whole(j))));
	}
	return sum;
}

static bool is_unity(const Model *model)
{
	Rat knot[2][MOST], first = whole(0);
	const int columns = shifted_knots(model, 0, knot[0]);
	const int rows = model->axes == 2 ? shifted_knots(model, 1, knot[1]) : 2;
	const int points = model->axes == 2 ? TOP : 1;
	for (int row = 1; row < rows; row++) {
		for (int column = 1; column < columns; column++) {
			for (int k = 0; k < points * TOP; k++) {
				const Rat x = sample(knot[0][column - 1], knot[0][column], k % TOP);
				const Rat y = model->axes == 2
					? sample(knot[1][row - 1], knot[1][row], k / TOP)
					: whole(0);
				const Rat sum = sum_of_shifts(model, x, y);
				if (column == 1 && row == 1 && k == 0)
					first = sum;
				if (rat_compare(sum, first) != 0)
					return false;
			}
		}
	}
	return rat_is(model->axes == 2 ? first : rat_mul(first, first), 1);
}

/* Is the derivative of this order across the borders the same on both sides? */
static bool agrees(const Model *model, int axis, int order)
{
	const int along = !axis, orders[2] = { axis ? 0 : order, axis ? order : 0 };
	const int cells = model->axes == 2 ? model->knots[along] - 1 : 1;
	for (int i = 0; i < model->knots[axis]; i++) {
		for (int k = 0; k < cells * TOP; k++) {
			Rat at[2] = { whole(0), whole(0) };
			at[axis] = model->knot[axis][i];
			if (model->axes == 2)
				at[along] = sample(model->knot[along][k / TOP],
					model->knot[along][k / TOP + 1], k % TOP);
			const Rat before = value(model, at, (int[2]){ !axis, axis }, orders);
			const Rat after = value(model, at, (int[2]){ 0, 0 }, orders);
			if (rat_compare(before, after) != 0)
				return false;
		}
	}
	return true;
}

static int continuity_of(const Model *model)
{
	int order = 0;
	while (order < 2 * TOP && agrees(model, 0, order)
		&& (model->axes == 1 || agrees(model, 1, order)))
		order++;
	return order - 1;
}

static Rat integral_of(const Model *model)
{
	Rat sum = whole(0);
	for (const Layer *layer = model->layer; layer < model->layer + model->layers; layer++) {
		for (int i = 0; i < TOP * TOP; i++) {
			Rat part = layer->coef[i / TOP][i % TOP];
			for (int axis = 0; axis < model->axes; axis++) {
				const int n = (axis ? i % TOP : i / TOP) + 1;
				part = rat_mul(part, rat_mul(rat(1, n), rat_sub(
					power(layer->to[axis], n), power(layer->from[axis], n))));
			}
			sum = rat_add(sum, part);
		}
	}
	return model->axes == 2 ? sum : rat_mul(sum, sum);
}

/* ---- text ---- */

static void add_polynomial(Text *text, const Model *model, Rat x, Rat y)
{
	Rat coef[TOP][TOP];
	for (int i = 0; i < TOP * TOP; i++) {
		Rat *sum = &coef[i / TOP][i % TOP];
		*sum = whole(0);
		for (const Layer *l = model->layer; l < model->layer + model->layers; l++) {
			if (inside(l, 0, x, 0) && (model->axes == 1 || inside(l, 1, y, 0)))
				*sum = rat_add(*sum, l->coef[i / TOP][i % TOP]);
		}
		if (sum->num)
			text_add(text, " + %s*x^%d%s", rat_text(*sum), i / TOP,
				model->axes == 2 ? format("*y^%d", i % TOP) : "");
	}
	text_add(text, " + 0\n");
}

/* A piece for every cell, some twice cut, in any order. */
static char *text_of(const Model *model, const char *name)
{
	char *line[MOST * 10];
	int lines = 0;
	const Rat *u = model->knot[0], *v = model->knot[1];
	const int rows = model->axes == 2 ? model->knots[1] : 2;
	for (int i = 1; i < model->knots[0]; i++) {
		for (int j = 1; j < rows; j++) {
			Text piece = { 0 };
			if (model->even && rat_sign(u[i]) <= 0)
				continue;
			text_add(&piece, "piece %s %s", rat_text(u[i - 1]), rat_text(u[i]));
			if (model->axes == 2)
				text_add(&piece, " %s %s", rat_text(v[j - 1]), rat_text(v[j]));
			text_add(&piece, " : 0");
			add_polynomial(&piece, model, sample(u[i - 1], u[i], 0),
				model->axes == 2 ? sample(v[j - 1], v[j], 0) : whole(0));
			line[lines++] = text_take(&piece);
		}
	}
	Text text = { 0 };
	text_add(&text, "filter %s\n%s\n", name, model->axes == 2 ? "bivariate"
		: model->even ? "separable even" : "separable");
	while (lines > 0) {
		const int i = random_int(0, lines - 1);
		text_add(&text, "%s", line[i]);
		line[i] = line[--lines];
	}
	return text_take(&text);
}

static Rat filter_value(const Filter *filter, Rat x, Rat y)
{
	Rat sum = whole(0);
	for (int i = 0; i < filter->pieces; i++) {
		const Piece *p = &filter->piece[i];
		if (rat_compare(p->x0, x) > 0 || rat_compare(x, p->x1) >= 0
			|| (!filter->separable && (rat_compare(p->y0, y) > 0
				|| rat_compare(y, p->y1) >= 0)))
			continue;
		for (int t = 0; t < p->value.count; t++) {
			const Term *term = &p->value.term[t];
			sum = rat_add(sum, rat_mul(term->coef, rat_mul(
				power(x, mono_power(term->mono, VAR_X)),
				power(y, mono_power(term->mono, VAR_Y)))));
		}
	}
	return sum;
}

/* ---- models ---- */

static Rat random_knot(void)
{
	const int den = random_int(1, 4);
	return rat(random_int(-2 * den, 2 * den), den);
}

static Layer *new_layer(Model *model, Rat x0, Rat x1, Rat y0, Rat y1)
{
	Layer *layer = &model->layer[model->layers++];
	*layer = (Layer){ { x0, y0 }, { x1, y1 }, { { { 0, 0 } } } };
	for (int i = 0; i < TOP * TOP; i++)
		layer->coef[i / TOP][i % TOP] = whole(0);
	return layer;
}

/* p(x - by) */
static void move(Rat *p, Rat by)
{
	Rat moved[TOP];
	for (int i = 0; i < TOP; i++) {
		moved[i] = whole(0);
		for (int k = i; k < TOP; k++)
			moved[i] = rat_add(moved[i], rat_mul(p[k], rat_mul(
				rat(int_binomial(k, i), 1), power(rat_neg(by), k - i))));
	}
	memcpy(p, moved, sizeof moved);
}

/* The pieces of the B-spline on 0 .. degree+1 (Cox, de Boor): n N(x) is x times the one before and
 * (n+1-x) times it moved by 1. */
static void spline(int degree, Rat piece[TOP][TOP])
{
	for (int i = 0; i < TOP * TOP; i++)
		piece[i / TOP][i % TOP] = whole(i == 0);
	for (int n = 1; n <= degree; n++) {
		for (int j = n; j >= 0; j--) {
			Rat sum[TOP], right[TOP];
			for (int i = 0; i < TOP; i++)
				right[i] = j ? piece[j - 1][i] : whole(0);
			move(right, whole(1));
			for (int i = 0; i < TOP; i++) {
				const Rat left = rat_sub(i ? piece[j][i - 1] : whole(0),
					i ? right[i - 1] : whole(0));
				sum[i] = rat_mul(rat(1, n), rat_add(left,
					rat_mul(whole(n + 1), right[i])));
			}
			memcpy(piece[j], sum, sizeof sum);
		}
	}
}

/* factor B(x - x0) B(y - y0) */
static void add_spline(Model *model, Rat factor, int m, Rat x0, int n, Rat y0)
{
	Rat column[TOP][TOP], row[TOP][TOP];
	spline(m, column);
	spline(n, row);
	for (int i = 0; i <= m; i++) {
		for (int j = 0; j <= (model->axes == 2 ? n : 0); j++) {
			const Rat u = rat_add(x0, whole(i)), v = rat_add(y0, whole(j));
			Layer *layer = new_layer(model, u, rat_add(u, whole(1)), v,
				rat_add(v, whole(1)));
			Rat p[TOP], q[TOP];
			memcpy(p, column[i], sizeof p);
			memcpy(q, row[j], sizeof q);
			move(p, x0);
			move(q, y0);
			for (int a = 0; a < TOP * TOP; a++)
				layer->coef[a / TOP][a % TOP] = rat_mul(factor, rat_mul(p[a / TOP],
					model->axes == 2 ? q[a % TOP] : whole(a % TOP == 0)));
		}
	}
}

/* g(x,y) - g(x-dx,y-dy) */
static void add_cancelling(Model *model, int degree, int dx, int dy)
{
	const Rat zero = whole(0);
	const Rat x0 = random_knot(), x1 = rat_add(x0, rat(random_int(1, 3), 2));
	const Rat y0 = random_knot(), y1 = rat_add(y0, rat(random_int(1, 4), 3));
	Layer *g = new_layer(model, x0, x1, y0, y1);
	for (int i = 0; i <= degree; i++)
		g->coef[i][0] = rat(random_int(-3, 3), random_int(1, 3));
	if (model->axes == 2)
		g->coef[0][1] = whole(random_int(-2, 2));
	Layer *h = new_layer(model, rat_add(x0, whole(dx)), rat_add(x1, whole(dx)),
		rat_add(y0, whole(dy)), rat_add(y1, whole(dy)));
	Rat p[TOP];
	for (int i = 0; i < TOP; i++)
		p[i] = g->coef[i][0];
	move(p, whole(dx));
	for (int i = 0; i < TOP; i++)
		h->coef[i][0] = rat_neg(p[i]);
	h->coef[0][0] = rat_add(h->coef[0][0], rat_mul(g->coef[0][1], whole(dy)));
	h->coef[0][1] = model->axes == 2 ? rat_neg(g->coef[0][1]) : zero;
}

/* Its mirror image too. */
static void mirror(Model *model)
{
	model->even = 1;
	const int layers = model->layers;
	for (int l = 0; l < layers; l++) {
		Layer *layer = &model->layer[l], *other = &model->layer[model->layers++];
		*other = *layer;
		other->from[0] = rat_neg(layer->to[0]);
		other->to[0] = rat_neg(layer->from[0]);
		for (int i = 0; i < TOP; i++) {
			layer->coef[i][0] = rat_mul(layer->coef[i][0], rat(1, 2));
			other->coef[i][0] = rat_mul(layer->coef[i][0], whole(i % 2 ? -1 : 1));
		}
	}
	/* a knot at 0, where the text begins */
	new_layer(model, whole(0), whole(1), whole(0), whole(1));
}

/* What has the integral 0 and whose shifts do not cancel; over y they give a constant, so that in
 * the plane every corner still cancels. */
static void add_step(Model *model, Rat y)
{
	const Rat x = random_knot(), half = rat_add(x, rat(1, 2));
	new_layer(model, x, half, y, rat_add(y, whole(1)))->coef[0][0] = rat(1, 7);
	new_layer(model, half, rat_add(x, whole(1)), y, rat_add(y, whole(1)))->coef[0][0]
		= rat(-1, 7);
}

/* Both its integrals along lines are 0, so that only the corners show it. */
static void add_board(Model *model)
{
	const Rat x = random_knot(), y = random_knot();
	for (int i = 0; i < 4; i++) {
		const Rat u = rat_add(x, rat(i % 2, 2)), v = rat_add(y, rat(i / 2, 2));
		new_layer(model, u, rat_add(u, rat(1, 2)), v, rat_add(v, rat(1, 2)))->coef[0][0]
			= rat(i == 0 || i == 3 ? 1 : -1, 5);
	}
}

/* spoiled: 0 not, 1 by a spline on its own, 2 by a step, 3 by a board */
static void make_line(Model *model, int even, int spoiled)
{
	*model = (Model){ .axes = 1 };
	const int degree = random_int(0, TOP - 1);
	add_spline(model, whole(random_int(0, 4) ? 1 : -1), degree,
		even ? rat(-degree - 1, 2) : random_knot(), 0, whole(0));
	for (int i = random_int(0, 2); i > 0; i--)
		add_cancelling(model, random_int(0, 3), random_int(0, 1) ? 1 : -2, 0);
	if (spoiled == 1)
		add_spline(model, rat(1, 7), random_int(0, 2), random_knot(), 0, whole(0));
	if (spoiled == 2)
		add_step(model, whole(0));
	if (even)
		mirror(model);
	find_knots(model);
}

static void make_plane(Model *model, int spoiled)
{
	static const int steps[][2] = { { 1, 0 }, { 0, 1 }, { 1, -1 } };
	*model = (Model){ .axes = 2 };
	const Rat y = random_knot();
	add_spline(model, whole(1), random_int(0, 2), random_knot(), random_int(0, 2), y);
	if (random_int(0, 1)) {
		const int *step = steps[random_int(0, 2)];
		add_cancelling(model, random_int(0, 2), step[0], step[1]);
	}
	if (spoiled == 1)
		add_spline(model, rat(1, 7), 0, random_knot(), 0, y);
	if (spoiled == 2)
		add_step(model, y);
	if (spoiled == 3)
		add_board(model);
	find_knots(model);
}

/* ---- tests ---- */

/* Has the model a value other than 0 between knots i and i+1 of this axis? */
static bool is_occupied(const Model *model, int axis, int i)
{
	const int along = !axis, cells = model->axes == 2 ? model->knots[along] - 1 : 1;
	for (int k = 0; k < cells * TOP * TOP; k++) {
		const int cell = k / (TOP * TOP);
		Rat at[2] = { whole(0), whole(0) };
		at[axis] = sample(model->knot[axis][i], model->knot[axis][i + 1], k % TOP);
		if (model->axes == 2)
			at[along] = sample(model->knot[along][cell], model->knot[along][cell + 1],
				k / TOP % TOP);
		if (plain_value(model, at[0], at[1]).num)
			return true;
	}
	return false;
}

static void check_support(const Filter *filter, const Model *model, const char *text)
{
	const Rat ends[2][2] = {
		{ filter->first_x, filter->last_x }, { filter->first_y, filter->last_y }
	};
	const int size[2] = { filter->size_x, filter->size_y };
	for (int axis = 0; axis < 2; axis++) {
		const int other = axis % model->axes;   /* on a line, y is as x */
		const Rat *knot = model->knot[other];
		int first = 0, last = model->knots[other] - 1;
		while (!is_occupied(model, other, first))
			first++;
		while (!is_occupied(model, other, last - 1))
			last--;
		expect(rat_compare(ends[axis][0], knot[first]) == 0
			&& rat_compare(ends[axis][1], knot[last]) == 0, "support of\n%s", text);
		bool aligned = true;
		for (int i = first; i <= last; i++)
			aligned = aligned && rat_sub(knot[i], knot[first]).den == 1;
		if (aligned || size[axis])
			expect(rat_is(rat_sub(knot[last], knot[first]), size[axis]),
				"size of\n%s", text);
	}
}

static void check_model(const Model *model, int *unities)
{
	char *text = text_of(model, "model");
	const Filter filter = filter_parse("model", text, strlen(text));
	const bool unity = is_unity(model);
	*unities += unity;
	expect(filter.unity == unity, "unity is %d of\n%s", unity, text);
	const int continuity = continuity_of(model);
	expect(filter.continuity == continuity, "continuity is %d, not %d, of\n%s", continuity,
		filter.continuity, text);
	const Rat integral = integral_of(model);
	expect(rat_compare(filter.integral, integral) == 0, "integral is %s, not %s, of\n%s",
		rat_text(integral), rat_text(filter.integral), text);
	for (int i = 0; i < 40; i++) {
		const Rat x = rat(random_int(-300, 300), 97);
		const Rat y = model->axes == 2 ? rat(random_int(-300, 300), 89) : whole(0);
		expect(rat_compare(filter_value(&filter, x, y), plain_value(model, x, y)) == 0,
			"value at %s, %s of\n%s", rat_text(x), rat_text(y), text);
	}
	check_support(&filter, model, text);
}

static void test_models(const char *name, int axes, int even, int count)
{
	static Model model;
	static const char *const spoiling[] = {
		"shifts that cancel", "a spline more", "a step more", "a board more"
	};
	for (int spoiled = 0; spoiled < 2 + axes; spoiled++) {
		int unities = 0;
		check_begin("analysis of %s, %s", name, spoiling[spoiled]);
		for (int i = 0; i < count; i++) {
			Mark mark = arena_mark();
			if (axes == 2)
				make_plane(&model, spoiled);
			else
				make_line(&model, even, spoiled);
			check_model(&model, &unities);
			arena_release(mark);
		}
		expect(spoiled ? unities < count : unities > 0, "%d of %d are partitions of unity",
			unities, count);
		check_end();
	}
}

static void test_splines(void)
{
	static const char *const names[] = { "box", "tent", "bspline2", "bspline3" };
	static Model model;
	for (int degree = 0; degree < LENGTH(names); degree++) {
		check_begin("built-in %s", names[degree]);
		Filter filter = filter_read(names[degree]);
		model = (Model){ .axes = 1 };
		add_spline(&model, whole(1), degree, rat(-degree - 1, 2), 0, whole(0));
		for (int i = -300; i <= 300; i++)
			expect(rat_compare(filter_value(&filter, rat(i, 97), whole(0)),
				plain_value(&model, rat(i, 97), whole(0))) == 0, "at %d/97", i);
		expect(filter.separable && filter.even && filter.unity && filter.degree == degree
			&& filter.continuity == degree - 1 && rat_is(filter.integral, 1)
			&& filter.size_x == degree + 1 && filter.size_y == degree + 1
			&& rat_compare(filter.first_y, rat(-degree - 1, 2)) == 0, "analysis");
		check_end();
	}
}

/* What defines Catmull-Rom: cubic on four pixels, one derivative, interpolating, exact for
 * parabolas (eight conditions on two polynomials); and Mitchell as a mixture with the B-spline. */
static void test_cubics(void)
{
	Filter spline3 = filter_read("bspline3"), catmull = filter_read("catmull-rom");
	Filter mitchell = filter_read("mitchell");
	check_begin("built-in catmull_rom");
	expect(catmull.even && catmull.degree == 3 && catmull.continuity == 1
		&& catmull.size_x == 4 && catmull.unity, "analysis");
	for (int i = -2; i < 2; i++)
		expect(rat_is(filter_value(&catmull, whole(i), whole(0)), i == 0), "at %d", i);
	for (int j = 0; j <= 97; j++) {
		const Rat x = rat(j, 97);
		Rat sum = whole(0);
		for (int i = -2; i <= 3; i++)
			sum = rat_add(sum, rat_mul(whole(i * i), filter_value(&catmull,
				rat_sub(x, whole(i)), whole(0))));
		expect(rat_compare(sum, rat_mul(x, x)) == 0, "x^2 at %d/97", j);
	}
	check_end();
	check_begin("built-in mitchell");
	expect(mitchell.even && mitchell.degree == 3 && mitchell.continuity == 1
		&& mitchell.size_x == 4 && mitchell.unity, "analysis");
	for (int j = -200; j <= 200; j++) {
		const Rat x = rat(j, 97), zero = whole(0);
		const Rat mixed = rat_add(rat_mul(rat(1, 3), filter_value(&spline3, x, zero)),
			rat_mul(rat(2, 3), filter_value(&catmull, x, zero)));
		expect(rat_compare(filter_value(&mitchell, x, zero), mixed) == 0, "at %d/97", j);
	}
	check_end();
}

/* Borders that meet others in part only, pieces that join, supports. */
static void test_examples(void)
{
	static const struct {
		const char *name, *text;
		int pieces, size_x, size_y, continuity, unity, num, den;
	} examples[] = {
		{ "quarters of a box", "bivariate\npiece 0 1/2 0 1/2 : 1\npiece 1/2 1 1/2 1 : 1\n"
			"piece 0 1/2 1/2 1 : 1\npiece 1/2 1 0 1/2 : 1\n", 1, 1, 1, -1, 1, 1, 1 },
		{ "a gap in a border", "bivariate\npiece 0 1 0 3 : x*y*(y-1)*(y-2)*(3-y)\n"
			"piece 1 2 0 1 : (2-x)*y*(y-1)*(y-2)*(3-y)\n"
			"piece 1 2 2 3 : (2-x)*y*(y-1)*(y-2)*(3-y)\n", 3, 2, 3, -1, 0, 13, 12 },
		{ "no gap in that border", "bivariate\npiece 0 1 0 3 : x*y*(y-1)*(y-2)*(3-y)\n"
			"piece 1 2 0 1 : (2-x)*y*(y-1)*(y-2)*(3-y)\n"
			"piece 1 2 1 3 : (2-x)*y*(y-1)*(y-2)*(3-y)\n", 2, 2, 3, 0, 0, 9, 10 },
		{ "smoother on one side", "bivariate\n"
			"piece -1 0 -1 1 : (x*(x+1))^3*(1-y^2)^3\n"
			"piece 0 1 -1 1 : (x*(1-x))^2*(1-y^2)^3\n", 2, 2, 2, 1, 0, 88, 3675 },
		{ "one axis aligned", "bivariate\npiece 0 1 0 1/2 : x\npiece 1 2 0 1/2 : 2 - x\n",
			2, 2, 0, -1, 0, 1, 2 },
		{ "a piece of 0 beside a box", "separable\npiece 0 1 : 1\npiece 5/2 3 : x - x\n",
			1, 1, 1, -1, 1, 1, 1 },
		{ "a box of -1", "separable\npiece 0 1 : -1\n", 1, 1, 1, -1, 1, 1, 1 },
		{ "three pixels as one", "separable\npiece 0 3 : 1/3\n", 1, 3, 3, -1, 1, 1, 1 },
		{ "half a pixel more", "separable\npiece 0 3/2 : 2/3\n", 1, 0, 0, -1, 0, 1, 1 },
		{ "one even piece", "separable even\npiece 0 1 : 1 - x^2\n", 1, 2, 2, 0, 0, 16, 9 },
		{ "the integral 0", "separable\npiece 0 1 : x - 1/2\n", 1, 1, 1, -1, 0, 0, 1 },
	};
	for (int i = 0; i < LENGTH(examples); i++) {
		check_begin("example: %s", examples[i].name);
		const char *text = format("filter f\n%s", examples[i].text);
		const Filter f = filter_parse("example", text, strlen(text));
		expect(f.pieces == examples[i].pieces, "%d pieces", f.pieces);
		expect(f.size_x == examples[i].size_x && f.size_y == examples[i].size_y,
			"%d x %d pixels", f.size_x, f.size_y);
		expect(f.continuity == examples[i].continuity, "continuity %d", f.continuity);
		expect(f.unity == examples[i].unity, "unity %d", f.unity);
		expect(rat_compare(f.integral, rat(examples[i].num, examples[i].den)) == 0,
			"integral %s", rat_text(f.integral));
		check_end();
	}
}

static void test_canonical(void)
{
	for (const char *const *name = filter_names(); *name; name++) {
		check_begin("canonical text of %s", *name);
		Filter filter = filter_read(*name);
		const char *text = filter_canonical(&filter);
		Filter again = filter_parse("again", text, strlen(text));
		expect(strcmp(text, filter_canonical(&again)) == 0, "it became\n%s",
			filter_canonical(&again));
		expect(strcmp(filter_summary(&filter), filter_summary(&again)) == 0, "analysis");
		check_end();
	}
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	test_splines();
	test_cubics();
	test_canonical();
	test_examples();
	test_models("filters k(x) k(y)", 1, 0, 100);
	test_models("even filters", 1, 1, 100);
	test_models("filters f(x,y)", 2, 0, 20);
	return check_finish();
}

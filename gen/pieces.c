/* pieces.c - the proof of the programs that select: windows and deposits, modulo the prime of
 * residue.c.
 *
 * Such a program is piecewise polynomial (or rational) in the coordinates of the edge. It is run at
 * many fixed pseudorandom edges with small rational coordinates, its selections decided exactly,
 * and compared with the definition, taken another way: the edge is cut at the rational parameters
 * where it crosses a knot, each part lies in one cell, and there the density's own polynomials, in
 * the coordinates of the filter file, are summed over the nodes of the same Gauss-Legendre rule.
 * Two different polynomials agree at such a point with a probability of 2^-50 or so, so that each
 * combination of cells that an edge hits is proven; how many that are is counted. */
#include "gen.h"

enum { EDGES_TRIED = 400, CUTS = 2 * 512 };

typedef struct { Rat x, y; } Point;
typedef struct { Rat start, end; } Part;

static uint64_t random_next(uint64_t *seed)
{
	*seed = *seed * 6364136223846793005u + 1442695040888963407u;   /* Knuth */
	return *seed >> 33;
}

/* In eighths, from a little before `first` to a little behind `last`. */
static Rat random_in(uint64_t *seed, Rat first, Rat last)
{
	const Rat size = rat_mul(rat_sub(last, first), rat(10, 1));
	const Int steps = rat_ceil(size) + 17;
	Rat offset = rat((Int)(random_next(seed) % (uint64_t)steps) - 8, 8);
	return rat_add(first, offset);
}

static Rat at(Rat start, Rat end, Rat t)
{
	return rat_add(start, rat_mul(t, rat_sub(end, start)));
}

static Residue value_at(Poly a, Residue x, Residue y)
{
	Residue sum = 0;
	for (int i = 0; i < a.count; ++i) {
		Residue term = residue_of(a.term[i].coef);
		term = residue_multiply(term,
			residue_power(x, (uint64_t)mono_power(a.term[i].mono, VAR_X)));
		term = residue_multiply(term,
			residue_power(y, (uint64_t)mono_power(a.term[i].mono, VAR_Y)));
		sum = residue_add(sum, term);
	}
	return sum;
}

/* From (a, y) to (b, y). */
static Residue change(Poly primitive, Residue a, Residue b, Residue y)
{
	return residue_subtract(value_at(primitive, b, y), value_at(primitive, a, y));
}

/* ---- the density of a filter, from its pieces ---- */

/* The integral over y of piece i from below up to y, for an x inside; `level` (rational, not on a
 * knot) says where y lies. */
static Residue piece_below(const Filter *filter, int i, Residue x, Residue y, Rat level)
{
	const Piece *piece = &filter->piece[i];
	const Rat low = filter->separable ? piece->x0 : piece->y0;
	const Rat high = filter->separable ? piece->x1 : piece->y1;
	const int var = filter->separable ? VAR_X : VAR_Y;
	const Poly primitive = poly_integral(piece->value, var);
	if (rat_compare(level, low) < 0)
		return 0;
	Residue top = rat_compare(level, high) < 0 ? y : residue_of(high), from = residue_of(low);
	if (filter->separable)
		return residue_subtract(value_at(primitive, top, 0), value_at(primitive, from, 0));
	return residue_subtract(value_at(primitive, x, top), value_at(primitive, x, from));
}

static int holds_x(const Piece *piece, Rat x)
{
	return rat_compare(piece->x0, x) < 0 && rat_compare(x, piece->x1) < 0;
}

/* F at (x, y): the integral of the filter over y from below; x lies where column does. */
static Residue below(const Filter *filter, Residue x, Residue y, Rat column, Rat level)
{
	Residue sum = 0, factor = 0;
	for (int i = 0; i < filter->pieces; ++i) {
		const int here = holds_x(&filter->piece[i], column);
		if (here && filter->separable)
			factor = value_at(filter->piece[i].value, x, 0);
		if (here || filter->separable)
			sum = residue_add(sum, piece_below(filter, i, x, y, level));
	}
	return filter->separable ? residue_multiply(sum, factor) : sum;
}

/* Sum over the nodes of a rule on the part of an edge, dx included. */
static Residue over_nodes(const Filter *filter, Point p, Point q, int nodes)
{
	Rat tau[LEGENDRE_MAX], weight[LEGENDRE_MAX];
	const int count = gauss_legendre(nodes, tau, weight);
	const Rat half = rat(1, 2), x = at(p.x, q.x, half), y = at(p.y, q.y, half);
	Residue sum = 0, dx = residue_of(rat_mul(half, rat_sub(q.x, p.x)));
	Residue dy = residue_of(rat_mul(half, rat_sub(q.y, p.y)));
	for (int i = 0; i < 2 * count; ++i) {
		Residue node = residue_of(tau[i / 2]);
		if (i % 2 && node == 0)
			continue;
		node = i % 2 ? residue_subtract(0, node) : node;
		Residue u = residue_add(residue_of(x), residue_multiply(node, dx));
		Residue v = residue_add(residue_of(y), residue_multiply(node, dy));
		sum = residue_add(sum, residue_multiply(residue_of(weight[i / 2]),
			below(filter, u, v, x, y)));
	}
	return residue_multiply(sum, dx);
}

/* The integral over the part of a column between two abscissas of F above the support. */
static Residue above(const Filter *filter, Rat from, Rat to)
{
	const Rat column = at(from, to, rat(1, 2));
	const Residue a = residue_of(from), b = residue_of(to);
	Residue sum = 0, mass = 0;
	for (int i = 0; i < filter->pieces; ++i) {
		const Piece *piece = &filter->piece[i];
		const Poly across = poly_integral(piece->value, VAR_X);
		if (filter->separable)
			mass = residue_add(mass, change(across, residue_of(piece->x0),
				residue_of(piece->x1), 0));
		if (!holds_x(piece, column))
			continue;
		if (filter->separable) {
			sum = change(across, a, b, 0);
			continue;
		}
		const Poly both = poly_integral(across, VAR_Y);
		sum = residue_add(sum, residue_subtract(change(both, a, b, residue_of(piece->y1)),
			change(both, a, b, residue_of(piece->y0))));
	}
	return filter->separable ? residue_multiply(sum, mass) : sum;
}

/* Program and proof share the rule: only here can it be seen that it is not exact. */
static void check_rule(const Filter *filter, const Cells *cells, int column, int row, int nodes)
{
	const int degree = degree_in_xy(cells->across[column])
		+ degree_in_xy(cells_up(cells, column, row));
	if (2 * nodes - 1 < degree)
		bug("the proof failed: %d nodes for degree %d in filter %s", nodes, degree,
			filter->name);
}

/* ---- windows ---- */

/* Where coordinate a..b is equal to a knot, as parameter between 0 and 1. */
static void cut(Rat a, Rat b, Rat knot, Rat *t, int *count)
{
	if (rat_compare(a, b) == 0)
		return;
	Rat here = rat_div(rat_sub(knot, a), rat_sub(b, a));
	int place = *count;
	if (rat_sign(here) <= 0 || rat_compare(here, rat(1, 1)) >= 0)
		return;
	while (place > 0 && rat_compare(t[place - 1], here) > 0) {
		t[place] = t[place - 1];
		--place;
	}
	t[place] = here;
	++*count;
}

static int interval_of(const Rat *knot, int intervals, Rat value)
{
	for (int i = 0; i <= intervals; ++i)
		if (rat_compare(value, knot[i]) < 0)
			return i - 1;
	return intervals;
}

/* One part: below the support 0, above it in closed form. */
static Residue part_value(const Filter *filter, const Cells *cells, Point p, Point q)
{
	const Rat half = rat(1, 2), x = at(p.x, q.x, half), y = at(p.y, q.y, half);
	const int column = interval_of(cells->x, cells->columns, x);
	const int row = interval_of(cells->y, cells->rows, y);
	if (column < 0 || column >= cells->columns || row < 0)
		return 0;
	if (row >= cells->rows)
		return above(filter, p.x, q.x);
	const int nodes = cells_nodes(cells->across[column], cells_up(cells, column, row));
	check_rule(filter, cells, column, row, nodes);
	return over_nodes(filter, p, q, nodes);
}

static Residue window_value(const Filter *filter, const Cells *cells, Point p, Point q)
{
	Rat *t = allocate(CUTS * sizeof *t);
	int count = 0;
	Residue sum = 0;
	for (int i = 0; i <= cells->columns; ++i)
		cut(p.x, q.x, cells->x[i], t, &count);
	for (int i = 0; i <= cells->rows; ++i)
		cut(p.y, q.y, cells->y[i], t, &count);
	for (int i = 0; i <= count; ++i) {
		const Rat a = i ? t[i - 1] : rat(0, 1), b = i < count ? t[i] : rat(1, 1);
		const Point from = { at(p.x, q.x, a), at(p.y, q.y, a) };
		const Point to = { at(p.x, q.x, b), at(p.y, q.y, b) };
		if (rat_compare(a, b) < 0)
			sum = residue_add(sum, part_value(filter, cells, from, to));
	}
	return residue_subtract(0, sum);
}

/* Of one edge: what joined the accumulator, times the factor of the finish. */
static Residue result(const Dag *dag, const Number *value)
{
	return residue_multiply(residue_of(dag->finish[0].term[0].coef),
		value[dag->out[0]].residue);
}

static void set_inputs(Number *input, Point p, Point q)
{
	input[0] = number_of(p.x);
	input[1] = number_of(p.y);
	input[2] = number_of(q.x);
	input[3] = number_of(q.y);
}

void prove_window(const Program *program, const Filter *filter)
{
	const Cells cells = filter_cells(filter);
	const Rat x0 = cells.x[0], x1 = cells.x[cells.columns];
	const Rat y0 = cells.y[0], y1 = cells.y[cells.rows];
	uint64_t seed = 1;
	int decided = 0;
	for (int i = 0; i < EDGES_TRIED; ++i) {
		Mark mark = arena_mark();
		Number input[8];
		Point p, q;
		p.x = random_in(&seed, x0, x1);
		p.y = random_in(&seed, y0, y1);
		q.x = random_in(&seed, x0, x1);
		q.y = random_in(&seed, y0, y1);
		if (rat_compare(p.x, q.x) == 0)
			continue;
		set_inputs(input, p, q);
		const Number *value = residue_run(program, input);
		if (value && result(program->dag, value)
		    != window_value(filter, &cells, p, q))
			bug("the proof failed: filter %s over the edge (%s, %s) (%s, %s)", filter->name,
				rat_text(p.x), rat_text(p.y), rat_text(q.x), rat_text(q.y));
		decided += value != NULL;
		arena_release(mark);
	}
	if (decided < EDGES_TRIED / 2)
		bug("too few edges could be decided for filter %s", filter->name);
}

/* A rectangle is the filter that is 1 in it. */
void prove_coverage(const Program *program)
{
	uint64_t seed = 1;
	int decided = 0;
	for (int i = 0; i < EDGES_TRIED; ++i) {
		Mark mark = arena_mark();
		Number input[8];
		Point p, q, low, high;
		const Rat zero = rat(0, 1), most = rat(3, 1);
		low.x = random_in(&seed, zero, zero);
		low.y = random_in(&seed, zero, zero);
		high.x = rat_add(low.x, rat(1 + (Int)(random_next(&seed) % 20), 8));
		high.y = rat_add(low.y, rat(1 + (Int)(random_next(&seed) % 20), 8));
		p.x = random_in(&seed, zero, most);
		p.y = random_in(&seed, zero, most);
		q.x = random_in(&seed, zero, most);
		q.y = random_in(&seed, zero, most);
		if (rat_compare(p.x, q.x) == 0)
			continue;
		Piece piece = { low.x, high.x, low.y, high.y, poly_const(rat(1, 1)) };
		const Filter one = { .name = format("coverage"), .piece = &piece, .pieces = 1 };
		const Cells cells = filter_cells(&one);
		set_inputs(input, p, q);
		set_inputs(input + 4, low, high);
		const Number *value = residue_run(program, input);
		if (value && result(program->dag, value)
		    != window_value(&one, &cells, p, q))
			bug("the proof failed: coverage by the edge (%s, %s) (%s, %s)",
				rat_text(p.x), rat_text(p.y), rat_text(q.x), rat_text(q.y));
		decided += value != NULL;
		arena_release(mark);
	}
	if (decided < EDGES_TRIED / 2)
		bug("too few edges could be decided for coverage");
}

/* ---- deposits ---- */

/* The integral of F above all rows, up to the start of column q. */
static Rat before_column(const Cells *cells, int q)
{
	const int var = VAR_X;
	const Poly one = poly_const(rat(1, 1));
	Rat sum = rat(0, 1);
	for (int i = 0; i < q; ++i) {
		Poly whole = poly_substitute(poly_integral(cells->all[i], VAR_X), &var, &one, 1);
		sum = rat_add(sum, whole.count ? whole.term[0].coef : rat(0, 1));
	}
	return sum;
}

/* The total of column q between u and v; its primitive is moved linearly to multiples of the unit
 * at both ends. */
static Residue moved_total(const Filter *filter, const Cells *cells, int q, Rat unit, Rat u, Rat v)
{
	const Rat start = before_column(cells, q), end = before_column(cells, q + 1);
	const Rat first = rat_sub(in_units(start, unit), start);
	const Rat last = rat_sub(in_units(end, unit), end);
	const Rat slip = rat_mul(rat_sub(last, first), rat_sub(v, u));
	const Rat x = rat_add(filter->first_x, rat(q, 1));
	return residue_add(above(filter, rat_add(x, u), rat_add(x, v)), residue_of(slip));
}

/* Column q of row s, from the definition: F a row higher less F here. */
static Residue row_value(const Filter *filter, int q, int s, Point a, Point b, int nodes)
{
	const Rat x = rat_add(filter->first_x, rat(q, 1)), y = rat_add(filter->first_y, rat(s, 1));
	Point p = { rat_add(x, a.x), rat_add(y, a.y) }, r = { rat_add(x, b.x), rat_add(y, b.y) };
	Residue here = over_nodes(filter, p, r, nodes);
	p.y = rat_add(p.y, rat(1, 1));
	r.y = rat_add(r.y, rat(1, 1));
	return residue_subtract(over_nodes(filter, p, r, nodes), here);
}

static void prove_deposit_at(const Number *value, const Dag *dag, const Filter *filter, Point p,
	Point r)
{
	const Cells cells = filter_cells(filter);
	const int size = deposit_size(filter), nodes = deposit_nodes(filter);
	const Rat unit = deposit_unit(filter);
	for (int q = 0; q < size; ++q) {
		Residue total = moved_total(filter, &cells, q, unit, p.x, r.x);
		for (int s = 0; s < size; ++s)
			check_rule(filter, &cells, q, s, nodes);
		for (int row = 0; row <= size; ++row) {
			const int output = row * size + size - 1 - q;
			Residue want = row == size / 2 ? total
				: row_value(filter, q, size - 1 - row, p, r, nodes);
			Residue have = residue_multiply(value[dag->out[output]].residue,
				residue_of(unit));
			if (have != want)
				bug("the proof failed: deposit %d of filter %s", output,
					filter->name);
		}
	}
}

void prove_deposit(const Program *program, const Filter *filter)
{
	enum { TRIED = 24 };
	uint64_t seed = 1;
	int decided = 0;
	for (int i = 0; i < TRIED; ++i) {
		Mark mark = arena_mark();
		Number input[8];
		Rat c[4];
		for (int k = 0; k < 4; ++k)          /* in eighths, 0 and 1 included */
			c[k] = rat((Int)(random_next(&seed) % 9), 8);
		const Point p = { c[0], c[1] }, r = { c[2], c[3] };
		set_inputs(input, p, r);
		const Number *value = residue_run(program, input);
		if (value)
			prove_deposit_at(value, program->dag, filter, p, r);
		decided += value != NULL;
		arena_release(mark);
	}
	if (decided < TRIED / 2)
		bug("too few pieces could be decided for filter %s", filter->name);
}

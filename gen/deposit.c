/* deposit.c - what a piece of an edge within one cell adds to a filtered image.
 *
 * The knots of the filter lie a pixel apart and its support spans N pixels, so in a grid that is
 * shifted by the corner of the support, a piece that stays within cell (cx, cy) meets one cell of
 * the filter of each of N x N pixels. With (u, v) relative to the cell and F_q(u, t) the integral of
 * the filter over y up to t, column q, the difference of pixel row j and the one before is
 *
 *     integral of G du,   G_qs(u, v) = F_q(u, v + s + 1) - F_q(u, v + s),   s = N-1 .. -1,
 *
 * for pixel column cx - q and row cy - s; the image is the running sum down the columns. Output
 * r N + m is that of q = N-1 - m, s = N-1 - r: (N + 1) N numbers, by the Gauss-Legendre rule that
 * is exact for the degree.
 *
 * Below the piece all that counts is the total of a column, P(u1) - P(u0) with P the primitive of
 * F_q(u, above). So that pixels that no edge crosses get exactly the filter's integral times the
 * winding number, every output is a multiple of a power of two, the unit (2^-20 for filters whose
 * values are around 1): then sums of floats are exact, in any order. P is interpolated between
 * multiples of the unit at both ends of the cell, P = A + u (B + (1 - u) R(u)), which is exact there
 * and moves it by half a unit at most, and is continuous from column to column; the last row is
 * the total less the other rows. Adding and subtracting 3 2^22 units rounds to a unit.
 *
 * The ends are put in order first, so that the reverse piece gives exactly the negated outputs. */
#include "gen.h"

typedef struct {
	Dag *dag;
	int size;
	Cells cells;
	Rat unit;
	Ref round, u0, u1;
} Deposit;

/* The cells that the support spans if all knots are whole pixels apart, and both axes have as
 * many; gaps inside count. */
int deposit_size(const Filter *filter)
{
	const int size = filter->size_x;
	return size == filter->size_y && size <= DEPOSIT_SIZE ? size : 0;
}

static Poly at_start(Poly a, int var, Rat value)
{
	const Poly by = poly_const(value);
	return poly_substitute(a, &var, &by, 1);
}

static Rat value_of(Poly a)
{
	return a.count ? a.term[0].coef : rat(0, 1);
}

/* F_q at the lower edge of row s plus v: 0 below the support, F above all of it beyond. */
static Poly below(const Cells *cells, int q, int s)
{
	if (s < 0)
		return poly_zero();
	if (s >= cells->rows)
		return cells->all[q];
	return poly_mul(cells->across[q], cells_up(cells, q, s));
}

/* The largest coefficient in the Bernstein basis on the unit square: no value is larger. */
static Rat largest(Poly a)
{
	const int m = poly_degree(a, VAR_X), n = poly_degree(a, VAR_Y);
	Rat most = rat(0, 1);
	for (int i = 0; i <= m; ++i)
		for (int j = 0; j <= n; ++j) {
			Rat sum = rat(0, 1);
			for (int k = 0; k < a.count; ++k) {
				const int p = mono_power(a.term[k].mono, VAR_X);
				const int q = mono_power(a.term[k].mono, VAR_Y);
				if (p > i || q > j)
					continue;
				Rat x = rat(int_binomial(i, p), int_binomial(m, p));
				Rat y = rat(int_binomial(j, q), int_binomial(n, q));
				sum = rat_add(sum, rat_mul(a.term[k].coef, rat_mul(x, y)));
			}
			sum = rat_abs(sum);
			most = rat_compare(sum, most) > 0 ? sum : most;
		}
	return most;
}

/* 2^-20, or the power of two above it with which all numbers stay below 2^22 units. */
static Rat unit_of(const Cells *cells)
{
	Rat most = rat(0, 1), total = rat(0, 1), size = rat(1, 1);
	for (int q = 0; q < cells->columns; ++q) {
		for (int s = -1; s < cells->rows; ++s) {
			Rat g = largest(poly_sub(below(cells, q, s + 1), below(cells, q, s)));
			most = rat_compare(g, most) > 0 ? g : most;
		}
		total = rat_add(total, largest(cells->all[q]));
	}
	most = rat_compare(total, most) > 0 ? total : most;
	while (rat_compare(most, rat_mul(size, rat(7, 2))) > 0)
		size = rat_mul(size, rat(2, 1));
	return rat_mul(size, rat(1, 1 << 20));
}

Rat deposit_unit(const Filter *filter)
{
	const Cells cells = filter_cells(filter);
	return unit_of(&cells);
}

Rat in_units(Rat value, Rat unit)
{
	Rat half = rat_sub(rat_div(value, unit), rat(1, 2));
	return rat_mul(rat(rat_ceil(half), 1), unit);
}

static Ref rounded(const Deposit *d, Ref a)
{
	return dag_node(d->dag, OP_ROUND, a, d->round, NONE);
}

/* R with P = A + u (B + (1 - u) R(u)), where P is `total` moved linearly to the ends A and A + B. */
static Poly between(Poly total, Rat before, Rat a, Rat b)
{
	Rat end = rat_add(before, value_of(at_start(total, VAR_X, rat(1, 1))));
	Rat slip = rat_sub(a, before), slope = rat_sub(rat_sub(rat_add(a, b), end), slip);
	Poly u = poly_var(VAR_X);
	/* (P - A) / u - B, and then by 1 - u: both divisions are exact */
	Poly rest = poly_add(total, poly_scale(u, rat_sub(slope, b)));
	Poly quotient = poly_zero();
	Rat carry = rat(0, 1);
	for (int power = 1; power <= poly_degree(rest, VAR_X); ++power) {
		for (int i = 0; i < rest.count; ++i)
			if (mono_power(rest.term[i].mono, VAR_X) == power)
				carry = rat_add(carry, rest.term[i].coef);
		if (carry.num)
			quotient = poly_add(quotient, poly_mono(carry, mono_var(VAR_X, power - 1)));
	}
	if (carry.num)
		bug("the primitive of a filter does not end where it should");
	return quotient;
}

/* Column total of column q: P(u1) - P(u0), both in units; `before` is P at the start of the column. */
static Ref column_total(const Deposit *d, int q, Rat *before)
{
	Dag *dag = d->dag;
	const Poly total = poly_integral(d->cells.all[q], VAR_X);
	Rat after = rat_add(*before, value_of(at_start(total, VAR_X, rat(1, 1))));
	Rat a = in_units(*before, d->unit), b = rat_sub(in_units(after, d->unit), a);
	Poly r = between(total, *before, a, b);
	Ref one = dag_const(dag, rat(1, 1)), end[2] = { d->u0, d->u1 };
	*before = after;
	for (int k = 0; k < 2; ++k) {
		Ref u = end[k], inner = cell_value(dag, r, u, NONE);
		if (inner != NONE)
			inner = dag_mul(dag, dag_sub(dag, one, u), inner);
		inner = b.num ? dag_add(dag, dag_const(dag, b), inner) : inner;
		if (inner == NONE)
			return NONE;
		Ref sum = dag_mul(dag, u, inner);
		end[k] = rounded(d, a.num ? dag_add(dag, dag_const(dag, a), sum) : sum);
	}
	return dag_sub(dag, end[1], end[0]);
}

/* Values at the nodes, both of a pair: [node][0 or 1]. */
typedef struct { int nodes, values[LEGENDRE_MAX]; Ref at[LEGENDRE_MAX][2][2], weight[LEGENDRE_MAX]; } Nodes;

static Nodes nodes_of(const Deposit *d, int count)
{
	Dag *dag = d->dag;
	Nodes n = { 0 };
	Rat tau[LEGENDRE_MAX], weight[LEGENDRE_MAX];
	Ref v0 = dag_var(dag, VAR_Y0), v1 = dag_var(dag, VAR_Y1);
	Ref run = dag_name(dag, dag_sub(dag, d->u1, d->u0), "run");
	Ref left = dag_node(dag, OP_MIN, d->u0, d->u1, NONE);
	Ref right = dag_node(dag, OP_MAX, d->u0, d->u1, NONE);
	Ref start = dag_choose(dag, run, v0, v1), end = dag_choose(dag, run, v1, v0);
	Span x = cell_span(dag, left, right), y = cell_span(dag, start, end);
	Ref half = dag_scale(dag, rat(1, 2), run);
	n.nodes = gauss_legendre(count, tau, weight);
	for (int i = 0; i < n.nodes; ++i) {
		n.values[i] = cell_node(dag, x, y, tau[i], n.at[i]);
		n.weight[i] = dag_scale(dag, weight[i], half);
	}
	return n;
}

static int most_nodes(const Cells *cells)
{
	int most = 1;
	for (int q = 0; q < cells->columns; ++q)
		for (int s = 0; s <= cells->rows; ++s) {
			Poly g = poly_sub(below(cells, q, s), below(cells, q, s - 1));
			int nodes = cells_nodes(poly_zero(), g);
			most = nodes > most ? nodes : most;
		}
	return most;
}

int deposit_nodes(const Filter *filter)
{
	const Cells cells = filter_cells(filter);
	return most_nodes(&cells);
}

/* The factors of G_qs at a point: across holds the weight. */
static Ref product(const Deposit *d, int q, int s, Ref across, Ref x, Ref y)
{
	Dag *dag = d->dag;
	const Cells *c = &d->cells;
	if (!c->separable) {
		Poly g = poly_sub(below(c, q, s + 1), below(c, q, s));
		Ref value = cell_value(dag, g, x, y);
		return value == NONE ? NONE : dag_mul(dag, across, value);
	}
	Poly high = s + 1 < c->rows ? c->up[s + 1]
		: at_start(c->up[s], VAR_Y, rat(1, 1));
	Ref value = cell_value(dag, poly_sub(high, s < 0 ? poly_zero() : c->up[s]), x, y);
	return value == NONE || across == NONE ? NONE : dag_mul(dag, across, value);
}

static void add_products(const Deposit *d, const Nodes *n, int q, Ref *rows)
{
	Dag *dag = d->dag;
	for (int i = 0; i < n->nodes; ++i)
		for (int k = 0; k < n->values[i]; ++k) {
			const Ref x = n->at[i][k][0], y = n->at[i][k][1];
			Ref across = cell_value(dag, d->cells.across[q], x, y);
			if (across != NONE)
				across = dag_mul(dag, n->weight[i], across);
			for (int r = 0; r < d->size; ++r) {
				Ref term = product(d, q, d->size - 1 - r, across, x, y);
				rows[r] = term == NONE ? rows[r] : dag_add(dag, rows[r], term);
			}
		}
}

Dag *deposit(const Filter *filter)
{
	Deposit d = { dag_new("gauss-legendre"), deposit_size(filter), filter_cells(filter),
		{ 0, 1 }, NONE, NONE, NONE };
	Dag *dag = d.dag;
	Rat before = rat(0, 1);
	dag->proof = PROOF_PIECES;
	d.u0 = dag_var(dag, VAR_X0);
	d.u1 = dag_var(dag, VAR_X1);
	d.unit = unit_of(&d.cells);
	d.round = dag_const(dag, rat_mul(d.unit, rat(3 << 22, 1)));
	const Nodes nodes = nodes_of(&d, most_nodes(&d.cells));
	Ref out[DEPOSIT_SIZE + 1][DEPOSIT_SIZE], zero = dag_const(dag, rat(0, 1));
	for (int q = 0; q < d.size; ++q) {
		Ref rows[DEPOSIT_SIZE], rest = column_total(&d, q, &before);
		for (int r = 0; r < d.size; ++r)
			rows[r] = NONE;
		add_products(&d, &nodes, q, rows);
		rest = rest == NONE ? zero : rest;
		for (int r = 0; r < d.size; ++r) {
			Ref value = rows[r] == NONE ? zero : rounded(&d, rows[r]);
			out[r][d.size - 1 - q] = value;
			rest = rows[r] == NONE ? rest : dag_sub(dag, rest, value);
		}
		out[d.size][d.size - 1 - q] = rest;
	}
	for (int r = 0; r <= d.size; ++r)
		for (int m = 0; m < d.size; ++m)
			dag_out(dag, out[r][m]);
	return dag;
}

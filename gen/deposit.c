/* deposit.c - what a piece of an edge within one cell adds to a filtered image.
 *
 * The knots of the filter lie a pixel apart and its support spans N pixels, so in a grid that is
 * shifted by the corner of the support, a piece that stays within cell (cx, cy) meets one cell of
 * the filter of each of N x N pixels. With (u, v) relative to the cell and F_q(u, t) the integral
 * of the filter over y up to t, column q, the difference of pixel row j and the one before is
 *
 *     integral of G du,   G_qs(u, v) = F_q(u, v + s + 1) - F_q(u, v + s),   s = N-1 .. -1,
 *
 * for pixel column cx - q and row cy - s; the image is the running sum down the columns. Output
 * r N + m is that of q = N-1 - m, s = N-1 - r, by the Gauss-Legendre rule that is exact for the
 * degree, but for the middle row, N/2: there it is the total of the column, from which whoever adds
 * takes the other rows. So rounding is left to a row that every piece reaches, while the first and
 * the last one are exactly 0 for a piece along the lower, or the upper, edge of the cell.
 *
 * Below the piece all that counts is that total, P(u1) - P(u0) with P the primitive of F_q(u,
 * above). So that pixels that no edge crosses get exactly the filter's integral times the winding
 * number, totals are integers, in units of a power of two, and whoever adds rounds the rows to
 * units: then sums are exact, in any order. P is interpolated between multiples of the unit at both
 * ends of the cell, P = A + u (B + (1 - u) R(u)), which is exact there and moves it by half a unit
 * at most; both values are rounded by adding and subtracting 3 2^22, less the middle of the column,
 * so that they are small and units fine.
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

static Rat whole_column(const Cells *cells, int q)
{
	return value_of(at_start(poly_integral(cells->all[q], VAR_X), VAR_X, rat(1, 1)));
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

/* The smallest power of two, from 2^-24 on, with which totals stay below 7/8 2^22 units. */
static Rat unit_of(const Cells *cells)
{
	Rat most = rat(0, 1), unit = rat(1, 1 << 24);
	for (int q = 0; q < cells->columns; ++q) {
		Rat half = rat_mul(rat(-1, 2), whole_column(cells, q));
		Poly primitive = poly_integral(cells->all[q], VAR_X);
		Rat here = largest(poly_add(primitive, poly_const(half)));
		most = rat_compare(here, most) > 0 ? here : most;
	}
	while (rat_compare(most, rat_mul(unit, rat(7 << 19, 1))) > 0)
		unit = rat_mul(unit, rat(2, 1));
	return unit;
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

/* R with P = A + u (B + (1 - u) R(u)): P is `total` moved linearly to the ends A and A + B. */
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

/* Column total of column q: P(u1) - P(u0), both in units; `before` is P where the column starts. */
static Ref column_total(const Deposit *d, int q, Rat *before)
{
	Dag *dag = d->dag;
	const Poly total = poly_integral(d->cells.all[q], VAR_X);
	Rat after = rat_add(*before, whole_column(&d->cells, q));
	Rat a = in_units(*before, d->unit), b = rat_sub(in_units(after, d->unit), a);
	Poly r = poly_scale(between(total, *before, a, b), rat_div(rat(1, 1), d->unit));
	Ref one = dag_const(dag, rat(1, 1)), end[2] = { d->u0, d->u1 };
	*before = after;
	b = rat_div(b, d->unit);
	a = rat(-rat_ceil(rat_mul(b, rat(1, 2))), 1);        /* so that P is around 0 */
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

/* The nodes, both of a pair: [node][0 or 1], relative to the centre of the cell. */
typedef struct {
	int nodes, values[LEGENDRE_MAX];
	Ref at[LEGENDRE_MAX][2][2], weight[LEGENDRE_MAX];
} Nodes;

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
	Ref centre = dag_const(dag, rat(1, 2));
	x.middle = dag_sub(dag, x.middle, centre);
	y.middle = dag_sub(dag, y.middle, centre);
	Ref half = dag_scale(dag, rat_div(rat(1, 2), d->unit), run);
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

/* ---- the polynomials at a node ---- */

/* With the centre of the cell as origin. */
static Poly centred(Poly a, int var)
{
	const Poly by = poly_add(poly_var(var), poly_const(rat(1, 2)));
	return poly_substitute(a, &var, &by, 1);
}

static Poly mirrored(Poly a, int var)
{
	const Poly by = poly_scale(poly_var(var), rat(-1, 1));
	return poly_substitute(a, &var, &by, 1);
}

/* Its terms of even or odd degree in a variable, the odd ones divided by it, in the square. */
static Poly half_of(Poly a, int var, int odd)
{
	Poly half = { 0, allocate((size_t)(a.count + 1) * sizeof(Term)) };
	for (int i = 0; i < a.count; ++i) {
		const int power = mono_power(a.term[i].mono, var);
		if (power % 2 == odd)
			half.term[half.count++] = (Term){ mono_var(VAR_X, power / 2),
				a.term[i].coef };
	}
	return half;
}

/* Values of polynomials in one variable at w. Filters are mostly even: then two polynomials are
 * mirror images, and their values the sum and the difference of an even and an odd part. */
static void values_at(Dag *dag, const Poly *poly, int count, int var, Ref w, Ref *value)
{
	Ref square = dag_mul(dag, w, w);
	unsigned char done[DEPOSIT_SIZE + 1] = { 0 };
	for (int i = 0; i < count; ++i) {
		if (done[i])
			continue;
		const Poly image = mirrored(poly[i], var);
		int twin = i;
		while (twin < count && !poly_equal(poly[twin], image))
			++twin;
		if (twin == count || poly_degree(poly[i], var) < 2) {
			value[i] = cell_value(dag, poly[i], w, w);
			continue;
		}
		Ref even = cell_value(dag, half_of(poly[i], var, 0), square, NONE);
		Ref odd = cell_value(dag, half_of(poly[i], var, 1), square, NONE);
		value[i] = even;
		if (odd == NONE)
			continue;
		odd = dag_mul(dag, w, odd);
		value[i] = dag_add(dag, even, odd);
		value[twin] = even == NONE ? dag_scale(dag, rat(-1, 1), odd)
			: dag_sub(dag, even, odd);
		done[twin] = 1;
	}
}

typedef Ref Rows[DEPOSIT_SIZE][DEPOSIT_SIZE + 1];       /* of columns q, in the order of rows */

static int middle_row(const Deposit *d)
{
	return d->size / 2;
}

/* The factors of G_qs of a separable filter, for all q and rows. */
static void add_separable(const Deposit *d, const Nodes *n, Rows rows)
{
	const Cells *c = &d->cells;
	Poly across[DEPOSIT_SIZE], up[DEPOSIT_SIZE + 1];
	for (int q = 0; q < d->size; ++q)
		across[q] = centred(c->across[q], VAR_X);
	for (int r = 0; r <= d->size; ++r) {
		const int s = d->size - 1 - r;
		Poly high = s + 1 < c->rows ? c->up[s + 1] : at_start(c->up[s], VAR_Y, rat(1, 1));
		up[r] = r == middle_row(d) ? poly_zero()
			: centred(poly_sub(high, s < 0 ? poly_zero() : c->up[s]), VAR_Y);
	}
	for (int i = 0; i < n->nodes; ++i)
		for (int k = 0; k < n->values[i]; ++k) {
			Ref x[DEPOSIT_SIZE], y[DEPOSIT_SIZE + 1];
			values_at(d->dag, across, d->size, VAR_X, n->at[i][k][0], x);
			values_at(d->dag, up, d->size + 1, VAR_Y, n->at[i][k][1], y);
			for (int q = 0; q < d->size; ++q) {
				if (x[q] == NONE)
					continue;
				Ref weighted = dag_mul(d->dag, n->weight[i], x[q]);
				for (int r = 0; r <= d->size; ++r)
					if (y[r] != NONE)
						rows[q][r] = dag_add(d->dag, rows[q][r],
							dag_mul(d->dag, weighted, y[r]));
			}
		}
}

/* G_qs itself. */
static void add_bivariate(const Deposit *d, const Nodes *n, Rows rows)
{
	for (int i = 0; i < d->size * (d->size + 1); ++i) {
		const int q = i / (d->size + 1), r = i % (d->size + 1), s = d->size - 1 - r;
		Poly g = poly_sub(below(&d->cells, q, s + 1), below(&d->cells, q, s));
		g = centred(centred(g, VAR_X), VAR_Y);
		for (int j = 0; j < n->nodes && r != middle_row(d); ++j)
			for (int k = 0; k < n->values[j]; ++k) {
				Ref value = cell_value(d->dag, g, n->at[j][k][0], n->at[j][k][1]);
				if (value != NONE)
					rows[q][r] = dag_add(d->dag, rows[q][r],
						dag_mul(d->dag, n->weight[j], value));
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
	d.round = dag_const(dag, rat(3 << 22, 1));
	const Nodes nodes = nodes_of(&d, most_nodes(&d.cells));
	Rows rows;
	for (int q = 0; q < DEPOSIT_SIZE; ++q)
		for (int r = 0; r <= DEPOSIT_SIZE; ++r)
			rows[q][r] = NONE;
	if (d.cells.separable)
		add_separable(&d, &nodes, rows);
	else
		add_bivariate(&d, &nodes, rows);
	for (int q = 0; q < d.size; ++q)
		rows[q][middle_row(&d)] = column_total(&d, q, &before);
	Ref zero = dag_const(dag, rat(0, 1));
	for (int r = 0; r <= d.size; ++r)
		for (int q = d.size - 1; q >= 0; --q)
			dag_out(dag, rows[q][r] == NONE ? zero : rows[q][r]);
	return dag;
}

/* cells.c - a filter as cells between its knots, and the integral over y from below.
 *
 * Over cell (q, r) the density f has one polynomial, and so has F(x, y), the integral of f over y
 * from below the support up to y. Both are written in coordinates relative to the lower left corner
 * of the cell. A separable filter is k(x) k(y), so F is across_q(x) up_r(y); of a bivariate one
 * across is 1 and up has both variables. Above the support F does not depend on y: all_q(x). */
#include "gen.h"

static void insert_knot(Rat *knot, int *count, Rat value)
{
	int at = *count;
	while (at > 0 && rat_compare(knot[at - 1], value) > 0)
		--at;
	if (at > 0 && rat_compare(knot[at - 1], value) == 0)
		return;
	for (int k = (*count)++; k > at; --k)
		knot[k] = knot[k - 1];
	knot[at] = value;
}

/* All knots on an axis in ascending order, and where they are pixels apart those between, too;
 * returns the number of intervals between them. */
static int knots(const Filter *filter, int axis, Rat **knot)
{
	const int size = axis ? filter->size_y : filter->size_x;
	int count = 0;
	*knot = allocate((size_t)(2 * filter->pieces + size + 1) * sizeof **knot);
	for (int i = 0; i < size; ++i)
		insert_knot(*knot, &count, rat_add(axis ? filter->first_y : filter->first_x,
			rat(i, 1)));
	for (int i = 0; i < filter->pieces; ++i) {
		const Piece *piece = &filter->piece[i];
		insert_knot(*knot, &count, axis ? piece->y0 : piece->x0);
		insert_knot(*knot, &count, axis ? piece->y1 : piece->x1);
	}
	return count - 1;
}

static int begins_before(Rat start, Rat at, Rat end)
{
	return rat_compare(start, at) <= 0 && rat_compare(at, end) < 0;
}

/* The polynomial over the cell whose lower left corner is (x, y), or 0; relative to the corner. */
static Poly density(const Filter *filter, Rat x, Rat y)
{
	const int vars[] = { VAR_X, VAR_Y };
	const Poly by[] = { poly_add(poly_var(VAR_X), poly_const(x)),
		poly_add(poly_var(VAR_Y), poly_const(y)) };
	for (int i = 0; i < filter->pieces; ++i) {
		const Piece *piece = &filter->piece[i];
		if (begins_before(piece->x0, x, piece->x1)
		    && (filter->separable || begins_before(piece->y0, y, piece->y1)))
			return poly_substitute(piece->value, vars, by, 2);
	}
	return poly_zero();
}

static Poly put(Poly a, int var, Poly value)
{
	return poly_substitute(a, &var, &value, 1);
}

/* up[r] for the densities of one column; returns F above all rows. */
static Poly stack(const Cells *cells, const Poly *rows, Poly *up)
{
	Poly below = poly_zero();
	for (int r = 0; r < cells->rows; ++r) {
		up[r] = poly_add(below, poly_integral(rows[r], VAR_Y));
		below = put(up[r], VAR_Y, poly_const(rat_sub(cells->y[r + 1], cells->y[r])));
	}
	return below;
}

static void separable(const Filter *filter, Cells *cells)
{
	Poly *row = allocate((size_t)cells->rows * sizeof *row);
	for (int r = 0; r < cells->rows; ++r)
		row[r] = put(density(filter, cells->y[r], rat(0, 1)), VAR_X, poly_var(VAR_Y));
	Poly whole = stack(cells, row, cells->up);
	for (int q = 0; q < cells->columns; ++q) {
		cells->across[q] = density(filter, cells->x[q], rat(0, 1));
		cells->all[q] = poly_mul(cells->across[q], whole);
	}
}

static void bivariate(const Filter *filter, Cells *cells)
{
	Poly *row = allocate((size_t)cells->rows * sizeof *row);
	for (int q = 0; q < cells->columns; ++q) {
		for (int r = 0; r < cells->rows; ++r)
			row[r] = density(filter, cells->x[q], cells->y[r]);
		cells->across[q] = poly_const(rat(1, 1));
		cells->all[q] = stack(cells, row, cells->up + q * cells->rows);
	}
}

Cells filter_cells(const Filter *filter)
{
	Cells cells = { .separable = filter->separable };
	cells.columns = knots(filter, 0, &cells.x);
	cells.rows = knots(filter, !filter->separable, &cells.y);
	const size_t columns = (size_t)cells.columns, rows = (size_t)cells.rows;
	cells.across = allocate(columns * sizeof(Poly));
	cells.all = allocate(columns * sizeof(Poly));
	cells.up = allocate(columns * rows * sizeof(Poly));
	if (filter->separable)
		separable(filter, &cells);
	else
		bivariate(filter, &cells);
	return cells;
}

Poly cells_up(const Cells *cells, int q, int r)
{
	return cells->up[cells->separable ? r : q * cells->rows + r];
}

int cells_nodes(Poly across, Poly up)
{
	return (degree_in_xy(across) + degree_in_xy(up)) / 2 + 1;
}

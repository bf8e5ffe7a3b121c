/* cutcell.c - moments of the cells that a boundary cuts, and quadrature rules on them.
 *
 * Finite elements and finite volumes on a Cartesian grid that does not follow the boundary need, in
 * every cell that the boundary cuts, integrals over the part of the cell inside the region. That is
 * what a filter of one piece gives: with the filter x^m y^n on the square around (0,0) of side 1,
 *
 *     M_mn = integral of (x-cx)^m (y-cy)^n over the region and the cell around (cx,cy),
 *
 * as a sum over edges: no polygon is clipped. Coordinates are cells: one rounding brings a vertex
 * there, and from there on everything is exact up to the bound of the filters. An edge adds nothing
 * to the cells above it or beside it, so a cell asks the edges of its column only; and a cell that
 * no edge meets is a whole number of times in the region.
 *
 * From its moments a cut cell gets a quadrature rule that is exact for every polynomial to DEGREE
 * (moment fitting): with L_k the polynomials of Legendre, orthonormal on the cell, and nodes x_i
 * and weights g_i of Gauss, exact to twice the degree,
 *
 *     w_ij = g_i g_j sum over k + l <= DEGREE of A_kl L_k(x_i) L_l(x_j),
 *
 * A_kl the integral of L_k L_l over the part inside. No system is solved, and of all weights on
 * these nodes they are those with the least sum of w^2/g. They need not be positive.
 *
 * The emission that this is compiled against has the filters, named cell_xMyN; CELL_MOMENTS lists
 * them, and EW_MAX_DEGREE is their degree. */
#include "edgewise.h"

#include "outline.h"

enum { DEGREE = EW_MAX_DEGREE, MOMENTS = EW_MOMENTS(DEGREE), NODES = DEGREE + 1 };
enum { MOST_CELLS = 4096 };

_Static_assert(DEGREE >= 2, "the table has centroids and second moments");

static const OutlineKind in_plane = { "x", "y", "", 1e9, 1e9, false };

typedef double Filter(double x0, double y0, double x1, double y1, double cx, double cy);

#define FILTER(m, n) [EW_INDEX(m, n)] = ew_line_cell_x##m##y##n,
static Filter *const filters[MOMENTS] = { CELL_MOMENTS(FILTER) };

typedef struct {
	double x0, y0, x1, y1;
} Edge;

typedef struct {
	int columns, rows;
	double x, y, size;     /* of the lower left corner and of a cell, in the units of the file */
	double *vx, *vy;       /* vertices, in cells */
	Edge *edges;
	size_t edge_count;
	size_t *starts, *order; /* edges of column i: order[starts[i]] .. order[starts[i+1] - 1] */
	bool *cut;             /* by column, then by row */
} Grid;

/* Of a cell about its centre, in cells. */
typedef struct {
	double moments[MOMENTS];
	double weights[NODES][NODES];
} Cell;

typedef struct {
	double node[NODES], weight[NODES]; /* of Gauss, on -1/2 .. 1/2 */
	double legendre[NODES][NODES];     /* [k][m]: coefficient of x^m in L_k */
	double value[NODES][NODES];        /* [k][i]: L_k(x_i) */
} Rule;

/* ---- the grid ---- */

static void place_vertices(Grid *grid, const Outlines *outlines, const Shape *shape, int cells)
{
	const size_t first = outlines->rings[shape->first].first;
	double low[2] = { HUGE_VAL, HUGE_VAL }, high[2] = { -HUGE_VAL, -HUGE_VAL };
	for (size_t i = first; i < first + shape->vertices; i++) {
		low[0] = fmin(low[0], outlines->x[i]);
		low[1] = fmin(low[1], outlines->y[i]);
		high[0] = fmax(high[0], outlines->x[i]);
		high[1] = fmax(high[1], outlines->y[i]);
	}
	grid->x = low[0];
	grid->y = low[1];
	grid->size = fmax(high[0] - low[0], high[1] - low[1]) / cells;
	if (!(grid->size > 0))
		fail(shape->file, shape->line, 1, "shape %s is a point", shape->name);
	grid->columns = (int)ceil((high[0] - low[0]) / grid->size);
	grid->rows = (int)ceil((high[1] - low[1]) / grid->size);
	grid->vx = allocate(shape->vertices, sizeof *grid->vx);
	grid->vy = allocate(shape->vertices, sizeof *grid->vy);
	for (size_t i = 0; i < shape->vertices; i++) {
		grid->vx[i] = (outlines->x[first + i] - low[0]) / grid->size;
		grid->vy[i] = (outlines->y[first + i] - low[1]) / grid->size;
	}
}

static void list_edges(Grid *grid, const Outlines *outlines, const Shape *shape)
{
	const size_t first = outlines->rings[shape->first].first;
	grid->edges = allocate(shape->vertices, sizeof *grid->edges);
	for (size_t r = shape->first; r < shape->first + shape->rings; r++) {
		const Ring *ring = &outlines->rings[r];
		const double *x = grid->vx + (ring->first - first);
		const double *y = grid->vy + (ring->first - first);
		check_turn(shape, ring, ew_area(x, y, ring->count));
		for (size_t i = 0; i < ring->count; i++) {
			const size_t next = i + 1 < ring->count ? i + 1 : 0;
			grid->edges[grid->edge_count++] =
				(Edge){ x[i], y[i], x[next], y[next] };
		}
	}
}

/* The columns that an edge lies in: none if it is vertical on a line of the grid. */
static void columns_of(const Edge *e, int *from, int *to)
{
	*from = (int)floor(fmin(e->x0, e->x1));
	*to = (int)ceil(fmax(e->x0, e->x1));
}

static void sort_edges(Grid *grid)
{
	int from, to;
	grid->starts = allocate((size_t)grid->columns + 1, sizeof *grid->starts);
	for (size_t k = 0; k < grid->edge_count; k++) {
		columns_of(&grid->edges[k], &from, &to);
		for (int i = from; i < to; i++)
			grid->starts[i + 1]++;
	}
	for (int i = 0; i < grid->columns; i++)
		grid->starts[i + 1] += grid->starts[i];
	grid->order = allocate(grid->starts[grid->columns], sizeof *grid->order);
	size_t *next = allocate((size_t)grid->columns, sizeof *next);
	for (size_t k = 0; k < grid->edge_count; k++) {
		columns_of(&grid->edges[k], &from, &to);
		for (int i = from; i < to; i++)
			grid->order[grid->starts[i] + next[i]++] = k;
	}
	free(next);
}

static double height_at(const Edge *e, double x)
{
	return e->y0 + (x - e->x0) / (e->x1 - e->x0) * (e->y1 - e->y0);
}

/* Every cell of the column whose interior the edge meets, and none that it misses by more than
 * rounding: heights between the ends are off by less than 8 units of the larger. */
static void mark_cells(Grid *grid, int i, const Edge *e)
{
	const double low = fmin(e->y0, e->y1), high = fmax(e->y0, e->y1);
	const double left = fmax(i, fmin(e->x0, e->x1)), right = fmin(i + 1, fmax(e->x0, e->x1));
	const double pad = 0x1p-49 * high;
	double from = low, to = high;
	if (left < right) {
		const double a = height_at(e, left), b = height_at(e, right);
		from = fmax(low, fmin(a, b) - pad);
		to = fmin(high, fmax(a, b) + pad);
	}
	for (int j = (int)floor(from); j < (int)ceil(to); j++)
		grid->cut[(size_t)i * (size_t)grid->rows + (size_t)j] = true;
}

static Grid lay_grid(const Outlines *outlines, const Shape *shape, int cells)
{
	Grid grid = { 0 };
	place_vertices(&grid, outlines, shape, cells);
	list_edges(&grid, outlines, shape);
	sort_edges(&grid);
	grid.cut = allocate((size_t)grid.columns * (size_t)grid.rows, sizeof *grid.cut);
	for (int i = 0; i < grid.columns; i++)
		for (size_t k = grid.starts[i]; k < grid.starts[i + 1]; k++)
			mark_cells(&grid, i, &grid.edges[grid.order[k]]);
	return grid;
}

static void free_grid(Grid *grid)
{
	void *owned[] = { grid->vx, grid->vy, grid->edges, grid->starts, grid->order, grid->cut };
	for (int i = 0; i < 6; i++)
		free(owned[i]);
}

/* ---- moments ---- */

/* The first `count` moments of the cell. */
static void measure_cell(const Grid *grid, int i, int j, double *moments, int count)
{
	memset(moments, 0, (size_t)count * sizeof *moments);
	for (size_t k = grid->starts[i]; k < grid->starts[i + 1]; k++) {
		const Edge *e = &grid->edges[grid->order[k]];
		for (int q = 0; q < count && fmax(e->y0, e->y1) > j; q++)
			moments[q] += filters[q](e->x0, e->y0, e->x1, e->y1, i + 0.5, j + 0.5);
	}
}

/* Of a cell that no edge meets: how often it is in the region. */
static int winding_of(const Grid *grid, int i, int j)
{
	double area;
	measure_cell(grid, i, j, &area, 1);
	return (int)lround(area);
}

/* Of the cell as a whole, so many times. */
static void whole_cell(int winding, double *moments)
{
	for (int m = 0; m <= DEGREE; m++)
		for (int n = 0; m + n <= DEGREE; n++)
			moments[EW_INDEX(m, n)] = m % 2 || n % 2 ? 0
				: winding * ldexp(1, -m - n) / ((m + 1) * (n + 1));
}

static void total_of_rings(const Grid *grid, const Outlines *outlines, const Shape *shape,
			   double total[MOMENTS])
{
	const size_t first = outlines->rings[shape->first].first;
	memset(total, 0, MOMENTS * sizeof *total);
	for (size_t r = shape->first; r < shape->first + shape->rings; r++) {
		const Ring *ring = &outlines->rings[r];
		double one[MOMENTS];
		ew_moments(DEGREE, grid->vx + (ring->first - first),
			   grid->vy + (ring->first - first), ring->count, one);
		for (int q = 0; q < MOMENTS; q++)
			total[q] += one[q];
	}
}

/* ---- quadrature ---- */

/* P_n(z) and its derivative. */
static void legendre(int n, double z, double *p, double *derivative)
{
	double last = 0, now = 1;
	for (int k = 0; k < n; k++) {
		const double next = ((2 * k + 1) * z * now - k * last) / (k + 1);
		last = now;
		now = next;
	}
	*p = now;
	*derivative = n * (z * now - last) / (z * z - 1);
}

/* L_k(x) = sqrt(2k+1) P_k(2x); the coefficients by (k+1) P_(k+1) = (2k+1) 2x P_k - k P_(k-1), all
 * exact but for the roots. */
static void make_rule(Rule *rule)
{
	double p, slope, c[NODES + 1][NODES + 1] = { { 1 } };
	for (int i = 0; i < NODES; i++) {
		double z = cos(acos(-1) * (i + 0.75) / (NODES + 0.5));
		for (int step = 0; step < 8; step++) {
			legendre(NODES, z, &p, &slope);
			z -= p / slope;
		}
		legendre(NODES, z, &p, &slope);
		rule->node[i] = z / 2;
		rule->weight[i] = 1 / ((1 - z * z) * slope * slope);
	}
	for (int k = 0; k < NODES; k++) {
		for (int m = 0; m <= k; m++) {
			c[k + 1][m + 1] += 2 * (2 * k + 1) * c[k][m] / (k + 1);
			if (k > 0)
				c[k + 1][m] -= k * c[k - 1][m] / (k + 1);
			rule->legendre[k][m] = sqrt(2 * k + 1) * c[k][m];
		}
		for (int i = 0; i < NODES; i++) {
			legendre(k, 2 * rule->node[i], &p, &slope);
			rule->value[k][i] = sqrt(2 * k + 1) * p;
		}
	}
}

static double projected(const Rule *rule, const double *moments, int k, int l)
{
	double sum = 0;
	for (int m = 0; m <= k; m++)
		for (int n = 0; n <= l; n++)
			sum += rule->legendre[k][m] * rule->legendre[l][n] * moments[EW_INDEX(m, n)];
	return sum;
}

static void fit_weights(const Rule *rule, Cell *cell)
{
	memset(cell->weights, 0, sizeof cell->weights);
	for (int k = 0; k <= DEGREE; k++)
		for (int l = 0; k + l <= DEGREE; l++) {
			const double a = projected(rule, cell->moments, k, l);
			for (int i = 0; i < NODES; i++)
				for (int j = 0; j < NODES; j++)
					cell->weights[i][j] += rule->weight[i] * rule->weight[j] * a
						* rule->value[k][i] * rule->value[l][j];
		}
}

static double least_weight(const Cell *cell)
{
	double least = HUGE_VAL;
	for (int i = 0; i < NODES; i++)
		for (int j = 0; j < NODES; j++)
			least = fmin(least, cell->weights[i][j]);
	return least;
}

/* By how much the rule misses the moments that it was made for. */
static double residual(const Rule *rule, const Cell *cell)
{
	double worst = 0;
	for (int m = 0; m <= DEGREE; m++)
		for (int n = 0; m + n <= DEGREE; n++) {
			double sum = 0;
			for (int i = 0; i < NODES; i++)
				for (int j = 0; j < NODES; j++)
					sum += cell->weights[i][j] * pow(rule->node[i], m)
						* pow(rule->node[j], n);
			worst = fmax(worst, fabs(sum - cell->moments[EW_INDEX(m, n)]));
		}
	return worst;
}

/* ---- printing ---- */

static void print_heading(void)
{
	printf("%4s %4s %10s %11s %11s %11s %11s %11s %11s\n", "i", "j", "fraction", "x", "y",
	       "M20", "M11", "M02", "least w");
}

/* The centroid in the units of the file, the rest in cells about the centre. */
static void print_cell(const Grid *grid, int i, int j, const Cell *cell)
{
	const double *m = cell->moments;
	printf("%4d %4d %10.7f %11.6f %11.6f", i, j, m[0],
	       grid->x + grid->size * (i + 0.5 + m[EW_INDEX(1, 0)] / m[0]),
	       grid->y + grid->size * (j + 0.5 + m[EW_INDEX(0, 1)] / m[0]));
	for (int n = 0; n < 3; n++)
		printf(" %11.4e", m[EW_INDEX(2 - n, n)]);
	printf(" %11.4e\n", least_weight(cell));
}

static void print_exact_grid(const Grid *grid, const Outlines *outlines, const Shape *shape,
			     const Rule *rule)
{
	const double *x = grid->vx, *y = grid->vy;
	printf("grid %d %d %d\n", DEGREE, grid->columns, grid->rows);
	for (size_t r = shape->first; r < shape->first + shape->rings; r++) {
		printf("ring %zu\n", outlines->rings[r].count);
		for (size_t i = 0; i < outlines->rings[r].count; i++)
			printf("%a %a\n", *x++, *y++);
	}
	print_numbers("nodes", rule->node, NODES);
	print_numbers("gauss", rule->weight, NODES);
}

static void print_exact_cell(int i, int j, const Cell *cell)
{
	printf("cell %d %d\n", i, j);
	print_numbers("moments", cell->moments, MOMENTS);
	print_numbers("weights", cell->weights[0], NODES * NODES);
}

static void print_total(const double *cells, const double *rings)
{
	printf("\n%-6s %24s %24s %12s\n", "", "sum over all cells", "ew_moments", "difference");
	for (int d = 0; d <= DEGREE; d++)
		for (int n = 0; n <= d; n++) {
			const int q = EW_INDEX(d - n, n);
			printf("x%dy%d   %24.16e %24.16e %12.1e\n", d - n, n, cells[q], rings[q],
			       cells[q] - rings[q]);
		}
}

/* ---- cell by cell ---- */

static void add_moved(const double *moments, int i, int j, double *total)
{
	double moved[MOMENTS];
	ew_translate_moments(DEGREE, moments, i + 0.5, j + 0.5, moved);
	for (int q = 0; q < MOMENTS; q++)
		total[q] += moved[q];
}

/* Column by column, upwards: what no edge parts has one winding number. Columns are summed up
 * before they are added to the total, so that no sum has many terms. */
static void visit(const Grid *grid, const Rule *rule, bool exact, double *total)
{
	double worst = 0;
	size_t cut = 0, whole = 0;
	for (int i = 0; i < grid->columns; i++) {
		bool known = false;
		int winding = 0;
		double column[MOMENTS] = { 0 };
		for (int j = 0; j < grid->rows; j++) {
			Cell cell;
			if (grid->cut[(size_t)i * (size_t)grid->rows + (size_t)j]) {
				measure_cell(grid, i, j, cell.moments, MOMENTS);
				fit_weights(rule, &cell);
				worst = fmax(worst, residual(rule, &cell));
				known = false;
				cut++;
				if (exact)
					print_exact_cell(i, j, &cell);
				else
					print_cell(grid, i, j, &cell);
			} else {
				winding = known ? winding : winding_of(grid, i, j);
				known = true;
				whole += winding != 0;
				whole_cell(winding, cell.moments);
				if (exact)
					printf("whole %d %d %d\n", i, j, winding);
			}
			add_moved(cell.moments, i, j, column);
		}
		for (int q = 0; q < MOMENTS; q++)
			total[q] += column[q];
	}
	if (!exact)
		printf("\n%zu cells are cut, %zu are whole. Quadrature to degree %d on %d nodes "
		       "misses a moment by %.1e at most.\n", cut, whole, DEGREE, NODES * NODES,
		       worst);
}

static void cut_cells(const Outlines *outlines, const Shape *shape, int cells, bool exact)
{
	double of_cells[MOMENTS] = { 0 }, of_rings[MOMENTS];
	Rule rule = { 0 };
	Grid grid = lay_grid(outlines, shape, cells);
	make_rule(&rule);
	if (exact)
		print_exact_grid(&grid, outlines, shape, &rule);
	else
		print_heading();
	visit(&grid, &rule, exact, of_cells);
	total_of_rings(&grid, outlines, shape, of_rings);
	if (exact)
		print_numbers("total", of_cells, MOMENTS);
	else
		print_total(of_cells, of_rings);
	free_grid(&grid);
}

/* ---- command line ---- */

static const char usage[] =
	"usage: cutcell [--exact] [--cells N] FILE [SHAPE]\n"
	"Lays a grid of square cells over a shape, N along its longer side (default: 64),\n"
	"and prints for each cell that its boundary cuts: volume fraction, centroid, second\n"
	"moments about the cell's centre, and the least weight of its quadrature rule; then\n"
	"the moments of all cells beside those of the shape. SHAPE: default the first.\n"
	"--exact prints vertices, all moments and weights in hexadecimal.\n";

static const Shape *find_shape(const Outlines *outlines, const char *file, const char *name)
{
	for (size_t i = 0; i < outlines->shape_count; i++)
		if (!name || !strcmp(outlines->shapes[i].name, name))
			return &outlines->shapes[i];
	fprintf(stderr, "cutcell: %s has no shape '%s'\n", file, name);
	exit(1);
}

int main(int argc, char **argv)
{
	CommandLine line = { .usage = usage, .operands = argv };
	long cells = 64;
	for (int i = 1; i < argc; i++) {
		char *end = "";
		if (!strcmp(argv[i], "--cells") && argv[i + 1])
			cells = strtol(argv[++i], &end, 10);
		else
			take_argument(&line, argv[i]);
		if (*end || cells < 1 || cells > MOST_CELLS) {
			fprintf(stderr, "cutcell: --cells: give a number from 1 to %d\n", MOST_CELLS);
			return 2;
		}
	}
	if (line.count < 1 || line.count > 2)
		return refuse(&line);
	Outlines outlines = { 0 };
	read_outlines(&outlines, argv[0], &in_plane);
	const Shape *shape = find_shape(&outlines, argv[0], line.count > 1 ? argv[1] : NULL);
	cut_cells(&outlines, shape, (int)cells, line.exact);
	free_outlines(&outlines);
	return finish_output();
}

/* cutcell.c - the output of `cutcell --exact` against exact rationals.
 *
 * The printed vertices are taken as they are. Every moment of every cut cell is held against the
 * polygon, clipped exactly (window_reference.h); every cell that is said to be whole must be so
 * many times in the region, exactly; the sum over all cells must be the moment of the region by
 * another route (reference.h); quadrature rules must give the moments they were made for. How far
 * off each may be stands above the function that asserts it. There u = 2^-53, gamma(k) =
 * k u/(1 - k u), D the degree. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <mpfr.h>

#include "check.h"
#include "edgewise.h"
#include "edgewise_kernels.h"
#include "printed.h"
#include "reference.h"
#include "window_reference.h"

enum { DEGREE = EW_MAX_DEGREE, MOMENTS = EW_MOMENTS(DEGREE), NODES = DEGREE + 1, BITS = 300 };

static const double U = 0x1p-53;
static const double SLACK = 1.0001; /* the bounds are rounded themselves */

/* The filter of a moment: by definition, and the k of its bound. */
typedef struct {
	WindowFilter *definition;
	double weight, most;    /* of its terms; max |f| */
	long k;
} Moment;

static Moment moments[MOMENTS];

static struct {
	int columns, rows;
	double *x, *y;          /* vertices of all rings; each ring is closed by its first vertex */
	size_t *starts, rings;
	double node[NODES], gauss[NODES];
} grid;

static double total_bound[MOMENTS], total_weight[MOMENTS];

/* ---- input ---- */

static void read_ring(void)
{
	double count, vertex[2];
	take_finite("ring ", &count, 1);
	const size_t first = grid.starts ? grid.starts[grid.rings] : 0, n = (size_t)count;
	grid.starts = resize(grid.starts, (grid.rings + 2) * sizeof *grid.starts);
	grid.x = resize(grid.x, (first + n + 1) * sizeof *grid.x);
	grid.y = resize(grid.y, (first + n + 1) * sizeof *grid.y);
	if (n < 3)
		malformed("three vertices or more");
	for (size_t i = 0; i < n; i++) {
		take_finite("", vertex, 2);
		grid.x[first + i] = vertex[0];
		grid.y[first + i] = vertex[1];
	}
	grid.x[first + n] = grid.x[first];
	grid.y[first + n] = grid.y[first];
	grid.starts[0] = 0;
	grid.starts[++grid.rings] = first + n + 1;
}

static void read_grid(void)
{
	double numbers[3];
	next_line();
	take_finite("grid ", numbers, 3);
	if (numbers[0] != DEGREE)
		malformed("the degree that this was compiled for");
	grid.columns = (int)numbers[1];
	grid.rows = (int)numbers[2];
	while (starts_with("ring "))
		read_ring();
	take_finite("nodes ", grid.node, NODES);
	take_finite("gauss ", grid.gauss, NODES);
}

/* ---- exact values ---- */

static void make_moments(void)
{
	static const long k[] = {
#define ROW(id, family, m, n, accumulators, outputs, k, r) k,
		EW_RINGS(ROW)
#undef ROW
	};
#define MOMENT(m, n) { \
		const WindowPatch cell = { "-1/2", "1/2", "-1/2", "1/2", { { "1", m, n } } }; \
		WindowFilter *filter = window_bivariate(&cell, 1); \
		moments[EW_INDEX(m, n)] = (Moment){ filter, window_weight(filter), \
			ldexp(1, -(m) - (n)), k[EW_RING_CELL_X##m##Y##n] }; \
	}
	CELL_MOMENTS(MOMENT)
#undef MOMENT
}

static void exact_moment(mpq_t out, const WindowFilter *filter, double cx, double cy)
{
	mpq_t one;
	mpq_init(one);
	mpq_set_ui(out, 0, 1);
	for (size_t r = 0; r < grid.rings; r++) {
		const size_t first = grid.starts[r], count = grid.starts[r + 1] - first - 1;
		window_ring(one, filter, grid.x + first, grid.y + first, count, cx, cy);
		mpq_add(out, out, one);
	}
	mpq_clear(one);
}

/* ---- bounds ---- */

static double gamma_of(double k)
{
	return SLACK * k * U / (1 - k * U);
}

/* One cell: each edge has the bound of the header, gamma(k) C + 9 u (|y0-cy| + |y1-cy|) max|f|, C
 * the weight of the filter; it adds at most max|f| times its width, and n of them are added up. An
 * edge beside the cell or below it is exactly 0. */
static double cell_bound(const Moment *moment, int i, int j)
{
	double bound = 0, sum = 0;
	long n = 0;
	for (size_t r = 0; r < grid.rings; r++)
		for (size_t e = grid.starts[r]; e + 1 < grid.starts[r + 1]; e++) {
			const double *x = grid.x + e, *y = grid.y + e;
			const double width = fmin(fmax(x[0], x[1]), i + 1) - fmax(fmin(x[0], x[1]), i);
			if (width <= 0 || fmax(y[0], y[1]) <= j)
				continue;
			bound += gamma_of((double)moment->k) * moment->weight + 9 * U * moment->most
				* (fabs(y[0] - j - 0.5) + fabs(y[1] - j - 0.5));
			sum += moment->most * width;
			n++;
		}
	return SLACK * (bound + gamma_of((double)n) * (sum + bound));
}

static double power(double x, int n)
{
	return n == 0 ? 1 : x * power(x, n - 1);
}

static double binomial(int n, int k)
{
	return k == 0 ? 1 : binomial(n - 1, k - 1) * n / k;
}

/* The sum over all cells: what a cell's moments are off, and gamma(4 D + 1) of themselves for the
 * way from the centre to (0,0), of which the header speaks. Then rows and columns are added up. */
static void add_to_total(int i, int j, const double *sizes, const double *bounds)
{
	for (int m = 0; m <= DEGREE; m++)
		for (int n = 0; m + n <= DEGREE; n++)
			for (int a = 0; a <= m; a++)
				for (int b = 0; b <= n; b++) {
					const double moved = binomial(m, a) * binomial(n, b)
						* power(i + 0.5, m - a) * power(j + 0.5, n - b);
					const int from = EW_INDEX(a, b), to = EW_INDEX(m, n);
					const double size = fabs(sizes[from]) + bounds[from];
					total_bound[to] += moved * (bounds[from]
						+ gamma_of(4 * DEGREE + 1) * size);
					total_weight[to] += moved * size;
				}
}

/* ---- cells ---- */

/* P_k(z) for all k <= NODES and the derivative of the last; error[k] bounds what P_k is off, in
 * units of u, when computed by (k+1) P_(k+1) = (2k+1) z P_k - k P_(k-1) in double at a z that is
 * off by `shift` u: every step adds four roundings of terms that are at most 2k+1 and k, and shift
 * moves P_k by at most its largest slope, k(k+1)/2. */
static void legendre_errors(double shift, double error[NODES])
{
	double rounding[NODES + 1] = { 0 };
	for (int k = 0; k < NODES; k++) {
		error[k] = rounding[k] + shift * k * (k + 1) / 2;
		rounding[k + 1] = ((2 * k + 1) * (rounding[k] + 4)
			+ k * ((k ? rounding[k - 1] : 0) + 4)) / (k + 1);
	}
}

static double coefficient(int k, int m)
{
	double c[NODES + 1][NODES + 1] = { { 1 } };
	for (int l = 0; l < k; l++)
		for (int q = 0; q <= l; q++) {
			c[l + 1][q + 1] += 2 * (2 * l + 1) * c[l][q] / (l + 1);
			if (l > 0)
				c[l + 1][q] -= l * c[l - 1][q] / (l + 1);
		}
	return c[k][m];
}

/* With exact nodes, weights and arithmetic the rule gives the moments. The nodes are within 2 u of
 * those of Gauss and the weights g within 64 u of theirs, relatively (check_nodes). The weights of
 * the rule are sums of terms g g a L_k L_l: a sums up (k+1)(l+1) products with coefficients of
 * 3 k + 3 l + 2 roundings; |L_k| <= sqrt(2k+1), off by what legendre_errors says (z is 2 x: twice
 * the shift) and 2 more; 4 products and 15 sums. A node moves x^m by 2 m u / x relatively, at most
 * 4 m u of the largest, 2^-m. */
static void check_rule(int i, int j, const double *m, const double *w, double *worst)
{
	double error[NODES], scale = 0;
	legendre_errors(4, error);
	for (int k = 0; k <= DEGREE; k++)
		for (int l = 0; k + l <= DEGREE; l++) {
			double a = 0;
			for (int p = 0; p <= k; p++)
				for (int q = 0; q <= l; q++)
					a += fabs(coefficient(k, p) * coefficient(l, q)
						* m[EW_INDEX(p, q)]);
			const double roundings = 2 * 64 + (k + 1) * (l + 1) + 3 * (k + l) + 6
				+ error[k] + error[l] + 4 + 4 + MOMENTS;
			scale += (2 * k + 1) * (2 * l + 1) * a * (roundings + 4 * DEGREE);
		}
	mpq_t sum, term, x[NODES], factor;
	mpq_inits(sum, term, factor, NULL);
	for (int p = 0; p < NODES; p++) {
		mpq_init(x[p]);
		mpq_set_d(x[p], grid.node[p]);
	}
	for (int q = 0; q < MOMENTS; q++) {
		const int d = (int)((sqrt(8 * q + 1) - 1) / 2), n = q - d * (d + 1) / 2;
		mpq_set_ui(sum, 0, 1);
		for (int p = 0; p < NODES * NODES; p++) {
			mpq_set_d(term, w[p]);
			for (int k = 0; k < d; k++)
				mpq_mul(term, term, x[k < n ? p % NODES : p / NODES]);
			mpq_add(sum, sum, term);
		}
		const double bound = SLACK * U * scale * ldexp(1, -d);
		const double off = window_error(m[q], sum);
		expect(off <= bound, "cell %d, %d: the rule misses moment %d by %g, allowed %g", i, j,
			q, off, bound);
		*worst = fmax(*worst, off / U);
	}
	for (int p = 0; p < NODES; p++)
		mpq_clear(x[p]);
	mpq_clears(sum, term, factor, NULL);
}

static void check_cell(double *worst, double *worst_rule)
{
	double place[2], m[MOMENTS], w[NODES * NODES], bounds[MOMENTS];
	mpq_t exact;
	take_finite("cell ", place, 2);
	take_finite("moments ", m, MOMENTS);
	take_finite("weights ", w, NODES * NODES);
	const int i = (int)place[0], j = (int)place[1];
	mpq_init(exact);
	for (int q = 0; q < MOMENTS; q++) {
		bounds[q] = cell_bound(&moments[q], i, j);
		exact_moment(exact, moments[q].definition, i + 0.5, j + 0.5);
		const double off = window_error(m[q], exact);
		expect(off <= bounds[q], "cell %d, %d: moment %d is %.17g, exact %.17g, off by %g, "
			"allowed %g", i, j, q, m[q], mpq_get_d(exact), off, bounds[q]);
		*worst = fmax(*worst, off / bounds[q]);
	}
	mpq_clear(exact);
	check_rule(i, j, m, w, worst_rule);
	add_to_total(i, j, m, bounds);
}

/* Every moment of the cell is `winding` times that of the square, exactly; one rounding in the
 * sizes, which are not printed. */
static void check_whole(void)
{
	double numbers[3], sizes[MOMENTS], bounds[MOMENTS];
	mpq_t exact, want;
	take_finite("whole ", numbers, 3);
	const int i = (int)numbers[0], j = (int)numbers[1];
	mpq_inits(exact, want, NULL);
	exact_moment(exact, moments[0].definition, i + 0.5, j + 0.5);
	mpq_set_d(want, numbers[2]);
	expect(mpq_equal(exact, want), "cell %d, %d: %g times in the region, not %g", i, j,
		mpq_get_d(exact), numbers[2]);
	for (int m = 0; m <= DEGREE; m++)
		for (int n = 0; m + n <= DEGREE; n++) {
			const double size = m % 2 || n % 2 ? 0
				: ldexp(1, -m - n) / ((m + 1) * (n + 1)) * fabs(numbers[2]);
			sizes[EW_INDEX(m, n)] = size;
			bounds[EW_INDEX(m, n)] = SLACK * U * size;
		}
	mpq_clears(exact, want, NULL);
	add_to_total(i, j, sizes, bounds);
}

static void check_cells(void)
{
	double worst = 0, worst_rule = 0;
	long seen = 0;
	check_begin("cells");
	for (; starts_with("cell ") || starts_with("whole "); seen++) {
		if (starts_with("cell "))
			check_cell(&worst, &worst_rule);
		else
			check_whole();
	}
	expect(seen == (long)grid.columns * grid.rows, "%ld cells, not %d x %d", seen, grid.columns,
		grid.rows);
	check_end();
	printf("# moments are off by %.2g of what is allowed at most, rules miss them by %.1f u\n",
		worst, worst_rule);
}

/* ---- all together ---- */

/* Gauss in 300 bits: Newton's steps from the printed node, which is right to 2^-50 or is found not
 * to be: x = z/2, g = 1/((1 - z^2) P'(z)^2), P' = n (z P_n - P_(n-1))/(z^2 - 1). */
static void check_nodes(void)
{
	mpfr_t z, now, last, next, slope, square;
	mpfr_inits2(BITS, z, now, last, next, slope, square, (mpfr_ptr)NULL);
	check_begin("nodes and weights of Gauss");
	for (int i = 0; i < NODES; i++) {
		mpfr_set_d(z, 2 * grid.node[i], MPFR_RNDN);
		for (int step = 0; step < 6; step++) {
			mpfr_set_ui(last, 0, MPFR_RNDN);
			mpfr_set_ui(now, 1, MPFR_RNDN);
			for (unsigned long k = 0; k < NODES; k++) {
				mpfr_mul(next, z, now, MPFR_RNDN);
				mpfr_mul_ui(next, next, 2 * k + 1, MPFR_RNDN);
				mpfr_mul_ui(last, last, k, MPFR_RNDN);
				mpfr_sub(next, next, last, MPFR_RNDN);
				mpfr_div_ui(next, next, k + 1, MPFR_RNDN);
				mpfr_swap(last, now);
				mpfr_swap(now, next);
			}
			mpfr_mul(slope, z, now, MPFR_RNDN);
			mpfr_sub(slope, slope, last, MPFR_RNDN);
			mpfr_mul_ui(slope, slope, NODES, MPFR_RNDN);
			mpfr_sqr(square, z, MPFR_RNDN);
			mpfr_sub_ui(square, square, 1, MPFR_RNDN);
			mpfr_div(slope, slope, square, MPFR_RNDN);
			mpfr_div(now, now, slope, MPFR_RNDN);
			mpfr_sub(z, z, now, MPFR_RNDN);
		}
		mpfr_sqr(slope, slope, MPFR_RNDN);
		mpfr_mul(slope, slope, square, MPFR_RNDN);
		mpfr_si_div(slope, -1, slope, MPFR_RNDN);
		mpfr_div_ui(z, z, 2, MPFR_RNDN);
		mpfr_sub_d(z, z, grid.node[i], MPFR_RNDN);
		const double off = fabs(mpfr_get_d(z, MPFR_RNDN));
		mpfr_d_div(slope, grid.gauss[i], slope, MPFR_RNDN);
		mpfr_sub_ui(slope, slope, 1, MPFR_RNDN);
		const double relative = fabs(mpfr_get_d(slope, MPFR_RNDN));
		expect(off <= 2 * U, "node %d is off by %g u", i, off / U);
		expect(relative <= 64 * U, "weight %d is off by %g u", i, relative / U);
		expect(i == 0 || grid.node[i] < grid.node[i - 1], "nodes %d and %d are one", i - 1, i);
	}
	check_end();
	mpfr_clears(z, now, last, next, slope, square, (mpfr_ptr)NULL);
}

static void check_total(void)
{
	double got[MOMENTS];
	Ref *want = ref_new(MOMENTS), *one = ref_new(MOMENTS);
	take_finite("total ", got, MOMENTS);
	check_begin("the sum over all cells");
	for (size_t r = 0; r < grid.rings; r++) {
		const size_t first = grid.starts[r], count = grid.starts[r + 1] - first - 1;
		ref_ring(one, DEGREE, grid.x + first, grid.y + first, count);
		for (int q = 0; q < MOMENTS; q++)
			mpq_add(want[q].value, want[q].value, one[q].value);
	}
	for (int q = 0; q < MOMENTS; q++) {
		const double off = window_error(got[q], want[q].value);
		const double bound = SLACK * (total_bound[q]
			+ gamma_of(grid.columns + grid.rows) * (total_weight[q] + total_bound[q]));
		expect(off <= bound, "moment %d is %.17g, exact %.17g, off by %g, allowed %g", q,
			got[q], mpq_get_d(want[q].value), off, bound);
	}
	check_end();
	ref_free(want, MOMENTS);
	ref_free(one, MOMENTS);
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	make_moments();
	read_grid();
	check_nodes();
	check_cells();
	check_total();
	for (int q = 0; q < MOMENTS; q++)
		window_free(moments[q].definition);
	free(grid.x);
	free(grid.y);
	free(grid.starts);
	return check_finish();
}

/* edgewise_trust_template.h - results that say how far off they can be, and the area in twice the
 * precision; included by edgewise_rings.c once per precision.
 *
 * The bound of a moment is gamma_K times the sum of all its terms with positive sign (Higham 2002,
 * ch. 3), which a kernel of its own adds up. Everything between the terms and the bound is rounded
 * too, upwards here: those sums have no negative terms, so they are off by a factor of at most
 * 1 / (1 - K' u), and the few operations behind them by the factor EW_SLACK.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

/* How often a term is rounded on its way into the sum of n items over lanes, besides the k of its
 * kernel. Lanes of float are flushed to double, whose roundings count 2^-29. */
static double EW_LOCAL(sum_roundings)(const ew_ring_shape *shape, size_t n, int r)
{
	const size_t lanes = (size_t)shape->turns * (n < EW_SHORT ? 1 : EW_WIDTH);
	const size_t items = EW_IS_FLOAT && n > EW_BLOCK ? (size_t)EW_BLOCK : n;
	const double steps = (double)((items + lanes - 1) / lanes);
	const double wide = (double)(n / EW_BLOCK) + 5;
	const double halvings = n < EW_SHORT ? 0 : 3;
	return r * (steps - 1) + (EW_IS_FLOAT ? wide * 0x1p-29 : halvings);
}

/* sup of gamma_k, or infinity where it means nothing. */
static double EW_LOCAL(gamma)(double k)
{
	const double ku = k * EW_UNIT;
	return ku < 0.5 ? ku / (1 - ku) * EW_SLACK : (double)INFINITY;
}

/* What underflow can add: each product of each item loses at most EW_TINY. On its way to the
 * result that is multiplied at most degree times, each time by no more than four coordinates, and
 * enters at most degree + 2 terms: a factor of at most 4^degree (degree + 2), which is below
 * 8^(degree + 1), besides powers of the largest coordinate; the coefficients are at most 1. */
static double EW_LOCAL(underflow)(int degree, const EW_LOCAL(vertices) *v, int products)
{
	double largest = 1, tiny = (double)EW_TINY * products * ((double)v->n + 1);
	for (size_t i = 0; i < v->n; ++i) {
		double x = fabs((double)EW_LOCAL(vertex_x)(v, i));
		double y = fabs((double)EW_LOCAL(vertex_y)(v, i));
		largest = x > largest ? x : largest;
		largest = y > largest ? y : largest;
	}
	for (int i = 0; i < degree + 1; ++i)
		tiny *= 8 * largest;
	return tiny;
}

/* The least number of the precision that is not below the bound; infinity for NaN. */
static EW_REAL EW_LOCAL(upwards)(double bound)
{
	const double up = bound * (1 + 4 * EW_UNIT) + EW_TINY;
	return up < (EW_IS_FLOAT ? 3.4e38 : 1.7e308) ? (EW_REAL)up : (EW_REAL)INFINITY;
}

int EW_NAME(moments_bounded)(int degree, const EW_REAL *x, const EW_REAL *y, size_t n, EW_REAL *out,
	EW_REAL *bound)
{
#define EW_ROW(k, r, products, wk, wr) { k, r, products, wk, wr },
	static const struct { const short *k; int r, products, wk, wr; } bounds[] = {
		EW_BOUNDS(EW_ROW)
	};
#undef EW_ROW
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, n);
	double terms[EW_MAX_OUTPUTS];
	if (degree < 0 || degree > EW_MAX_DEGREE)
		return EW_BAD_DEGREE;
	const ew_ring_shape *shape = &ew_ring_shapes[EW_RING_MOMENTS_0 + degree];
	const double sum = EW_LOCAL(sum_roundings)(shape, v.n, bounds[degree].r);
	const double tiny = v.n < 3 ? 0 : EW_LOCAL(underflow)(degree, &v, bounds[degree].products);
	shape = &ew_ring_shapes[EW_RING_MAGNITUDES_0 + degree];
	const double slip = bounds[degree].wk
		+ EW_LOCAL(sum_roundings)(shape, v.n, bounds[degree].wr);
	EW_LOCAL(all_moments)(degree, &v, out);
	EW_LOCAL(integrate)(EW_RING_MAGNITUDES_0 + degree, &v, terms);
	for (int j = 0; j < EW_MOMENTS(degree); ++j) {
		const double off = EW_LOCAL(gamma)(bounds[degree].k[j] + sum);
		const double most = terms[j] * (1 + 2 * EW_LOCAL(gamma)(slip)) + tiny;
		const double stored = fabs((double)out[j]) * (EW_IS_FLOAT ? EW_UNIT : 0);
		bound[j] = EW_LOCAL(upwards)(((off * most + tiny) + stored) * EW_SLACK);
	}
	return EW_OK;
}

/* *high + *low + value, without error (Knuth's TwoSum). */
static void EW_LOCAL(add_exactly)(double value, double *high, double *low)
{
	const double sum = *high + value, part = sum - *high;
	*low += (*high - (sum - part)) + (value - part);
	*high = sum;
}

EW_REAL EW_NAME(area_compensated)(const EW_REAL *x, const EW_REAL *y, size_t n)
{
	const int id = EW_RING_COMPENSATED;
	EW_LOCAL(vertices) v = EW_LOCAL(plain)(x, y, 1, n);
	double wide[2 * EW_WIDTH], total[2] = { 0, 0 }, out[1];
	if (v.n < 3)
		return (EW_REAL)EW_LOCAL(nothing)(&v);
	memset(wide, 0, sizeof wide);
	EW_LOCAL(run_items)(id, &v, wide);
	for (int l = 0; l < EW_WIDTH; ++l)
		EW_LOCAL(add_exactly)(wide[l], &total[0], &total[1]);
	for (int l = 0; l < EW_WIDTH; ++l)
		total[1] += wide[EW_WIDTH + l];
	ew_ring_shapes[id].finish(total, out, 1);
	return (EW_REAL)out[0];
}

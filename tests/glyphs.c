/* glyphs.c - the output of `glyphs --exact` against exact rationals.
 *
 * The printed outlines are taken as they are: coordinates are multiples of 1/2, so the moments of
 * the regions are rational. A curve of degree D is a polynomial in t and s = 1 - t, kept by its
 * integer coefficients of t^a s^b, and the integral of t^a s^b over the curve is a! b!/(a+b+1)!.
 * Exact moments come from
 *
 *     (m+1) M_mn = closed integral of x^(m+1) y^n dy,
 *
 * which is not the form that the library uses. The printed results must lie within a-priori bounds,
 * which stand above the function that asserts them. There u = 2^-53, gamma(k) = k u/(1 - k u), and
 * W is the sum over all edges of the terms of the library's form, each of them made positive: in
 * the power basis about the middle of the edge. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <gmp.h>

#include "printed_moments.h"

enum { AREA, MEAN, VARIANCE = 3, DEVIATION = 5, COVARIANCE = 7, CORRELATION, SLANT, STATISTICS };
enum { RAW, CENTROID, SECOND, DERIVED, EMPTY, GROUPS };
enum { LINES = 1, QUADS, CUBICS, KINDS }; /* by degree */
enum { LONGEST = 12 };                    /* coefficients of x^3 dy of a cubic */

static Group groups[GROUPS] = {
	{ .name = "raw moments" },
	{ .name = "centroid" },
	{ .name = "second moments" },
	{ .name = "derived statistics" },
	{ .name = "glyphs without area" },
};
/* Coefficient i belongs to t^i s^(degree - i). */
typedef struct {
	mpz_t c[LONGEST];
	int degree;
} Form;

typedef struct {
	char name[80];
	size_t edges[KINDS];
	double centre[2], moments[MOMENTS], statistics[STATISTICS];
	mpq_t exact[MOMENTS], weight[MOMENTS]; /* about the centre */
} Glyph;

static void check(int group, const Glyph *glyph, const char *what, double error, double bound)
{
	check_within(&groups[group], glyph->name, what, error, bound);
}

/* ---- polynomials along an edge ---- */

static Form along[2], rise, size[2], turn, product, scratch;
static mpz_t term;
static mpq_t sum, part;

static long binomial(int n, int k)
{
	return k ? binomial(n, k - 1) * (n - k + 1) / k : 1;
}

static void set_zero(Form *form, int degree)
{
	form->degree = degree;
	for (int i = 0; i <= degree; i++)
		mpz_set_ui(form->c[i], 0);
}

static void multiply(Form *by, const Form *with)
{
	set_zero(&scratch, by->degree + with->degree);
	for (int i = 0; i <= by->degree; i++)
		for (int j = 0; j <= with->degree; j++)
			mpz_addmul(scratch.c[i + j], by->c[i], with->c[j]);
	by->degree = scratch.degree;
	for (int i = 0; i <= by->degree; i++)
		mpz_swap(by->c[i], scratch.c[i]);
}

/* out += the integral of first x^m y^n for t from 0 to 1, over divisor. */
static void integrate(mpq_t out, const Form *first, const Form xy[2], int m, int n,
		      unsigned long divisor)
{
	set_zero(&product, first->degree);
	for (int i = 0; i <= first->degree; i++)
		mpz_set(product.c[i], first->c[i]);
	for (int i = 0; i < m + n; i++)
		multiply(&product, &xy[i >= m]);
	const int degree = product.degree;
	mpz_set_ui(mpq_numref(part), 0);
	mpz_fac_ui(mpq_denref(part), (unsigned long)degree + 1);
	mpz_mul_ui(mpq_denref(part), mpq_denref(part), divisor);
	for (int i = 0; i <= degree; i++) {
		mpz_fac_ui(term, (unsigned long)i);
		mpz_mul(product.c[i], product.c[i], term);
		mpz_fac_ui(term, (unsigned long)(degree - i));
		mpz_addmul(mpq_numref(part), product.c[i], term);
	}
	mpq_canonicalize(part);
	mpq_add(out, out, part);
}

/* form = sum of power[k] t^k, whose terms are multiplied by (t + s) up to its degree. */
static void set_powers(Form *form, const mpz_t *power, int degree)
{
	set_zero(form, degree);
	for (int i = 0; i <= degree; i++)
		for (int k = 0; k <= i; k++)
			mpz_addmul_ui(form->c[i], power[k],
				      (unsigned long)binomial(degree - k, i - k));
}

/* The coefficients of the powers of tau, t = (1 + tau)/2, times 2^degree, each of a control point
 * made positive. */
static const long about_middle[KINDS][4][4] = {
	[LINES] = { { 1, 1 }, { 1, 1 } },
	[QUADS] = { { 1, 2, 1 }, { 2, 0, 2 }, { 1, 2, 1 } },
	[CUBICS] = { { 1, 3, 3, 1 }, { 3, 3, 3, 3 }, { 3, 3, 3, 3 }, { 1, 3, 3, 1 } },
};

/* size: the coordinates in powers of |tau|, turn: x y' - y x' likewise, with every term positive
 * and doubled, since tau goes from -1 to 1. */
static void set_sizes(const long *p, int degree)
{
	static mpz_t power[2][4], omega[5];
	for (int xy = 0; xy < 2; xy++) {
		for (int k = 0; k <= degree; k++) {
			mpz_init_set_ui(power[xy][k], 0);
			for (int i = 0; i <= degree; i++)
				mpz_add_ui(power[xy][k], power[xy][k], (unsigned long)
					   (about_middle[degree][k][i] * labs(p[2 * i + xy])));
		}
		set_powers(&size[xy], (const mpz_t *)power[xy], degree);
	}
	for (int k = 0; k <= 2 * degree - 2; k++) {
		mpz_init_set_ui(omega[k], 0);
		for (int i = 0; i <= degree; i++)
			for (int j = i + 1; j <= degree; j++)
				for (int xy = 0; xy < 2 && i + j - 1 == k; xy++) {
					mpz_mul(term, power[xy][i], power[!xy][j]);
					mpz_addmul_ui(omega[k], term, 2ul * (unsigned long)(j - i));
				}
	}
	set_powers(&turn, (const mpz_t *)omega, 2 * degree - 2);
	for (int k = 0; k <= 2 * degree - 2; k++)
		mpz_clear(omega[k]);
	for (int k = 0; k <= degree; k++) {
		mpz_clear(power[0][k]);
		mpz_clear(power[1][k]);
	}
}

/* Coordinates x0, y0, x1, y1, ..., already twice what they are. along is the edge, rise is
 * dy/dt. */
static void set_forms(const long *p, int degree)
{
	for (int xy = 0; xy < 2; xy++) {
		set_zero(&along[xy], degree);
		for (int i = 0; i <= degree; i++)
			mpz_set_si(along[xy].c[i], binomial(degree, i) * p[2 * i + xy]);
	}
	set_zero(&rise, degree - 1);
	for (int i = 0; i < degree; i++)
		mpz_set_si(rise.c[i],
			   degree * binomial(degree - 1, i) * (p[2 * i + 3] - p[2 * i + 1]));
	set_sizes(p, degree);
}

static void add_edge(Glyph *glyph, const long *p, int degree)
{
	set_forms(p, degree);
	glyph->edges[degree]++;
	for (int k = 0; k < MOMENTS; k++) {
		const int m = power_x[k], n = power_y[k];
		const unsigned long doubled = 1ul << (m + n + 2);
		const unsigned long green = (unsigned long)(m + 1);
		const unsigned long form3 = (unsigned long)(m + n + 2);
		integrate(glyph->exact[k], &rise, along, m + 1, n, doubled * green);
		const unsigned long scale = 1ul << degree * (m + n + 2);    /* of about_middle */
		integrate(glyph->weight[k], &turn, size, m, n, doubled * scale * form3);
	}
}

/* ---- input ---- */

/* Multiples of 1/2 that an outline may have, as integers. */
static void take_points(const char *word, long *out, int count)
{
	double numbers[6];
	take_finite(word, numbers, 2 * count);
	for (int i = 0; i < 2 * count; i++) {
		out[i] = lrint(2 * numbers[i]);
		if ((double)out[i] != 2 * numbers[i] || labs(out[i]) > 1l << 20)
			malformed("multiples of 1/2, not too large");
	}
}

typedef struct {
	long *points; /* 8 of every edge */
	int *degrees;
	size_t count;
} Edges;

/* Every contour must end where it started. */
static void read_outline(Edges *edges)
{
	static const char *const verbs[KINDS] = { "move ", "line ", "quad ", "cubic " };
	long here[2], start[2] = { 0, 0 };
	double total;
	take_finite("outline ", &total, 1);
	edges->points = resize(edges->points, (size_t)total * 8 * sizeof *edges->points);
	edges->degrees = resize(edges->degrees, (size_t)total * sizeof *edges->degrees);
	edges->count = 0;
	memcpy(here, start, sizeof here);
	for (size_t i = 0; i < (size_t)total; i++) {
		int degree = CUBICS;
		while (degree && !starts_with(verbs[degree]))
			degree--;
		if (!degree) {
			if (memcmp(here, start, sizeof here))
				malformed("a closed contour above");
			take_points("move ", start, 1);
			memcpy(here, start, sizeof here);
			continue;
		}
		long *p = edges->points + 8 * edges->count;
		memcpy(p, here, sizeof here);
		take_points(verbs[degree], p + 2, degree);
		memcpy(here, p + 2 * degree, sizeof here);
		edges->degrees[edges->count++] = degree;
	}
	if (memcmp(here, start, sizeof here))
		malformed("a closed contour above");
}

static void read_glyph(Glyph *glyph, Edges *edges)
{
	long centre[2];
	if (!starts_with("glyph "))
		malformed("glyph");
	snprintf(glyph->name, sizeof glyph->name, "%.79s", line);
	next_line();
	read_outline(edges);
	take_points("centre ", centre, 1);
	memset(glyph->edges, 0, sizeof glyph->edges);
	for (int k = 0; k < MOMENTS; k++) {
		mpq_set_ui(glyph->exact[k], 0, 1);
		mpq_set_ui(glyph->weight[k], 0, 1);
	}
	for (size_t i = 0; i < edges->count; i++) {
		long *p = edges->points + 8 * i;
		for (int k = 0; k < 2 * edges->degrees[i] + 2; k++)
			p[k] -= centre[k % 2];
		add_edge(glyph, p, edges->degrees[i]);
	}
	for (int i = 0; i < 2; i++)
		glyph->centre[i] = (double)centre[i] / 2;
	take_finite("moments ", glyph->moments, MOMENTS);
	take_numbers("statistics ", glyph->statistics, STATISTICS);
}

/* ---- checks ---- */

static double distance(const mpq_t exact, double printed)
{
	mpq_set_d(part, printed);
	mpq_sub(part, part, exact);
	return fabs(mpq_get_d(part));
}

/* The worst of the kinds of edges, as listed; 3 more reduce the lanes, and the results of the
 * kinds, lines, quads, conics and cubics, are added up by 3 more. NaN if one is not listed. */
static double roundings(const Glyph *glyph)
{
	static const char *const families[KINDS] = { "", "moments", "quad", "cubic" };
	double most = 0;
	for (int kind = LINES; kind < KINDS; kind++) {
		const size_t count = glyph->edges[kind];
		const double k = count ? listed_roundings(families[kind], count) : 0;
		if (isnan(k))
			return NAN;
		most = fmax(most, k);
	}
	return most + 6;
}

/* With E the bounds of the raw moments, A the area, and q a quotient m/A of exact moments, from
 *     m'/A' - m/A = ((m' - m) - q (A' - A))/A'
 * follows |q' - q| <= (E_m + |q| E_A)/(|A| - E_A) + u |q'|, where ' marks a computed value. */
static double quotient_bound(const Glyph *glyph, const double e[MOMENTS], int k, double q)
{
	const double area = fabs(mpq_get_d(glyph->exact[M00]));
	const double moved = (e[k] + fabs(q) * e[M00]) / (area - e[M00]);
	return SLACK * (moved + U * (fabs(q) + moved));
}

/* The mean is centre + q', rounded once more. A second moment is p' - (q' r'), two roundings, with
 * |q' r' - q r| <= |q| dr + |r| dq + dq dr. */
static void check_quotients(const Glyph *glyph, const double e[MOMENTS])
{
	static const int places[MOMENTS] = { 0, 0, 0, VARIANCE, COVARIANCE, VARIANCE + 1 };
	static const char *const names[] = { "varianceX", "covariance", "varianceY" };
	double q[2], d[2];
	mpq_t mean[2];
	for (int i = 0; i < 2; i++) {
		const double printed = glyph->statistics[MEAN + i];
		mpq_init(mean[i]);
		mpq_div(mean[i], glyph->exact[M10 + i], glyph->exact[M00]);
		q[i] = mpq_get_d(mean[i]);
		d[i] = quotient_bound(glyph, e, M10 + i, q[i]);
		mpq_set_d(part, glyph->centre[i]);
		mpq_add(sum, mean[i], part);
		check(CENTROID, glyph, i ? "meanY" : "meanX", distance(sum, printed),
		      SLACK * (d[i] + U * fabs(printed)));
	}
	for (int k = M20; k <= M02; k++) {
		const int i = k == M02, j = k != M20;
		const double printed = glyph->statistics[places[k]];
		mpq_div(sum, glyph->exact[k], glyph->exact[M00]);
		const double p = quotient_bound(glyph, e, k, mpq_get_d(sum));
		const double square = fabs(q[i]) * d[j] + fabs(q[j]) * d[i] + d[i] * d[j];
		mpq_mul(part, mean[i], mean[j]);
		mpq_sub(sum, sum, part);
		check(SECOND, glyph, names[k - M20], distance(sum, printed),
		      SLACK * (p + square + U * (fabs(q[i] * q[j]) + square + fabs(printed))));
	}
	mpq_clear(mean[0]);
	mpq_clear(mean[1]);
}

static bool same(double a, double b)
{
	return a == b || (isnan(a) && isnan(b));
}

/* The rest is one or two correctly rounded operations on what is printed, so it must be equal. */
static void check_derived(const Glyph *glyph)
{
	const double *s = glyph->statistics;
	for (int i = 0; i < 2; i++) {
		const double v = s[VARIANCE + i], root = copysign(sqrt(fabs(v)), v);
		check(DERIVED, glyph, "a deviation", same(s[DEVIATION + i], root) ? 0 : 1, 0);
	}
	const double deviations = s[DEVIATION] * s[DEVIATION + 1], v = s[VARIANCE + 1];
	const double correlation = deviations != 0 ? s[COVARIANCE] / deviations : NAN;
	check(DERIVED, glyph, "the area", same(s[AREA], glyph->moments[M00]) ? 0 : 1, 0);
	check(DERIVED, glyph, "correlation", same(s[CORRELATION], correlation) ? 0 : 1, 0);
	check(DERIVED, glyph, "slant", same(s[SLANT], v != 0 ? s[COVARIANCE] / v : NAN) ? 0 : 1, 0);
}

static void check_glyph(const Glyph *glyph)
{
	double bound[MOMENTS];
	const double k = roundings(glyph);
	for (int i = 0; i < MOMENTS; i++) {
		bound[i] = gamma_of(k) * mpq_get_d(glyph->weight[i]);
		check(RAW, glyph, moment_names[i], distance(glyph->exact[i], glyph->moments[i]),
		      bound[i]);
	}
	if (mpq_sgn(glyph->exact[M00])) {
		check_quotients(glyph, bound);
		check_derived(glyph);
		return;
	}
	for (int i = 0; i < STATISTICS; i++)
		check(EMPTY, glyph, "a statistic", same(glyph->statistics[i], 0) ? 0 : 1, 0);
}

/* ---- the program ---- */

/* mpz_init or mpz_clear, mpq_init or mpq_clear of every number of this program. */
static void every_number(Glyph *glyph, void (*integer)(mpz_ptr), void (*rational)(mpq_ptr))
{
	Form *forms[] = { &along[0], &along[1], &rise, &size[0], &size[1], &turn, &product,
			  &scratch };
	for (int i = 0; i < 8; i++)
		for (int j = 0; j < LONGEST; j++)
			integer(forms[i]->c[j]);
	for (int k = 0; k < MOMENTS; k++) {
		rational(glyph->exact[k]);
		rational(glyph->weight[k]);
	}
	integer(term);
	rational(sum);
	rational(part);
}

int main(void)
{
	Glyph glyph;
	Edges edges = { 0 };
	size_t glyphs = 0, totals[KINDS] = { 0 };
	every_number(&glyph, mpz_init, mpq_init);
	next_line();
	do {
		read_glyph(&glyph, &edges);
		check_glyph(&glyph);
		glyphs++;
		for (int kind = LINES; kind < KINDS; kind++)
			totals[kind] += glyph.edges[kind];
	} while (line[0] || !feof(stdin));
	every_number(&glyph, mpz_clear, mpq_clear);
	free(edges.points);
	free(edges.degrees);
	printf("# %zu glyphs, %zu lines, %zu quads, %zu cubics\n", glyphs, totals[LINES],
	       totals[QUADS], totals[CUBICS]);
	printf("# largest errors over their bounds: raw moments %.2g, centroids %.2g, "
	       "second moments %.2g\n", groups[RAW].worst, groups[CENTROID].worst,
	       groups[SECOND].worst);
	return report(groups, GROUPS);
}

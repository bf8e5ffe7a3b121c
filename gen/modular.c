/* modular.c - the proof of programs that sum over quadrature nodes, modulo the prime 2^61 - 1.
 *
 * Expanded into polynomials such a program would have millions of terms. But its constants are
 * dyadic rationals, so program and definition are both polynomials over Q in the coordinates, with
 * coefficients that exist modulo a prime: if they differ, they differ at nearly all points (a
 * polynomial of degree d vanishes at no more than d / p of them: Zippel 1979, Schwartz 1980). The
 * program, run in the order of its schedule (residue.c), is compared at a few fixed pseudorandom
 * points with
 *
 *     1/(m+n+2) sum over nodes of weight x^m y^n (x y' - y x'),
 *
 * taken from the control points by de Casteljau's scheme. That this rule is exact for the degree,
 * and that the nodes are right to the last bit, is what tests/constants.c shows. */
#include "gen.h"

enum { POINTS = 3 };

static Residue finished(const Dag *dag, const Number *value, int output)
{
	if (!dag->finishes)
		return value[dag->out[output]].residue;
	Residue sum = 0;
	const Poly form = dag->finish[output];
	for (int i = 0; i < form.count; ++i) {
		int k = mono_accumulator_of(form.term[i].mono);
		sum = residue_add(sum, residue_multiply(residue_of(form.term[i].coef),
			value[dag->out[k]].residue));
	}
	return sum;
}

/* ---- the definition ---- */

/* Value and derivative by tau of one coordinate at t = (1 + tau)/2. */
static void casteljau(int points, const Residue *coordinate, Residue t, Residue *value,
	Residue *slope)
{
	Residue p[4], s = residue_subtract(1, t);
	for (int i = 0; i < points; ++i)
		p[i] = coordinate[2 * i];
	for (int count = points; count > 2; --count)
		for (int i = 0; i + 1 < count; ++i)
			p[i] = residue_add(residue_multiply(s, p[i]), residue_multiply(t, p[i + 1]));
	*value = residue_add(residue_multiply(s, p[0]), residue_multiply(t, p[1]));
	*slope = residue_multiply(residue_multiply(residue_subtract(p[1], p[0]),
		(Residue)points - 1), residue_inverse(2));
}

static Residue definition(const Dag *dag, const Residue *coordinate, int m, int n, int degree)
{
	Rat tau[LEGENDRE_MAX], weight[LEGENDRE_MAX];
	const int points = window_points(dag->window);
	const int count = gauss_legendre(curve_nodes(dag->window, degree), tau, weight);
	Residue sum = 0, half = residue_inverse(2);
	for (int i = 0; i < 2 * count; ++i) {
		Residue node = residue_of(tau[i / 2]), x, y, dx, dy;
		if (i % 2 && node == 0)
			continue;
		Residue t = residue_multiply(half, i % 2 ? residue_subtract(1, node) : residue_add(1, node));
		casteljau(points, coordinate, t, &x, &dx);
		casteljau(points, coordinate + 1, t, &y, &dy);
		Residue turn = residue_subtract(residue_multiply(x, dy), residue_multiply(y, dx));
		Residue value = residue_multiply(residue_power(x, (uint64_t)m), residue_power(y, (uint64_t)n));
		sum = residue_add(sum, residue_multiply(residue_of(weight[i / 2]),
			residue_multiply(value, turn)));
	}
	return residue_multiply(sum, residue_inverse((Residue)(m + n + 2)));
}

static void prove_at(const Program *program, const Residue *coordinate, int m, int n)
{
	const Dag *dag = program->dag;
	Number number[8];
	for (int i = 0; i < LENGTH(number); ++i)
		number[i] = (Number){ coordinate[i], 0 };
	const Number *value = residue_run(program, number);
	if (!dag->finishes && finished(dag, value, 0) != definition(dag, coordinate, m, n, m + n))
		bug("the proof failed: not the sum over the nodes of x^%d y^%d", m, n);
	for (int d = 0, j = 0; dag->finishes && d <= m; ++d)
		for (int k = 0; k <= d; ++k, ++j)
			if (finished(dag, value, j) != definition(dag, coordinate, d - k, k, m))
				bug("the proof failed: output %d is not the sum over the nodes", j);
}

void prove_quadrature(const Program *program, int m, int n)
{
	Residue seed = 1, coordinate[8];
	for (int point = 0; point < POINTS; ++point) {
		Mark mark = arena_mark();
		for (int i = 0; i < LENGTH(coordinate); ++i) {
			seed = seed * 6364136223846793005u + 1442695040888963407u;   /* Knuth */
			coordinate[i] = (seed ^ seed >> 29) % PRIME;
		}
		prove_at(program, coordinate, m, n);
		arena_release(mark);
	}
}

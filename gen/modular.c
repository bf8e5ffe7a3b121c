/* modular.c - the proof of programs that sum over quadrature nodes, modulo the prime 2^61 - 1.
 *
 * Expanded into polynomials such a program would have millions of terms. But its constants are
 * dyadic rationals, so program and definition are both polynomials over Q in the coordinates, with
 * coefficients that exist modulo a prime: if they differ, they differ at nearly all points (a
 * polynomial of degree d vanishes at no more than d / p of them: Zippel 1979, Schwartz 1980). The
 * program, run in the order of its schedule, is compared at a few fixed pseudorandom points with
 *
 *     1/(m+n+2) sum over nodes of weight x^m y^n (x y' - y x'),
 *
 * taken from the control points by de Casteljau's scheme. That this rule is exact for the degree,
 * and that the nodes are right to the last bit, is what tests/constants.c shows. */
#include "gen.h"

enum { POINTS = 3 };

typedef uint64_t Residue;
static const Residue prime = (1ull << 61) - 1;

static Residue add(Residue a, Residue b)
{
	Residue sum = a + b;
	return sum >= prime ? sum - prime : sum;
}

static Residue subtract(Residue a, Residue b)
{
	return add(a, prime - b);
}

static Residue multiply(Residue a, Residue b)
{
	return (Residue)((Wide)a * b % prime);
}

static Residue power(Residue a, uint64_t exponent)
{
	Residue result = 1;
	for (; exponent; exponent /= 2) {
		if (exponent % 2)
			result = multiply(result, a);
		a = multiply(a, a);
	}
	return result;
}

static Residue inverse(Residue a)
{
	return power(a, prime - 2);
}

static Residue residue(Rat a)
{
	Wide size = (Wide)(a.num < 0 ? -a.num : a.num);
	Residue num = (Residue)(size % prime), den = (Residue)((Wide)a.den % prime);
	Residue value = multiply(num, inverse(den));
	return a.num < 0 ? subtract(0, value) : value;
}

/* ---- the program ---- */

static Residue operation(const Node *node, const Residue *value)
{
	Residue a = value[node->arg[0]], b = value[node->arg[1]];
	switch (node->op) {
	case OP_ADD: return add(a, b);
	case OP_SUB: return subtract(a, b);
	case OP_MUL: return multiply(a, b);
	case OP_DIV: return multiply(a, inverse(b));
	case OP_FMA: return add(multiply(a, b), value[node->arg[2]]);
	case OP_FMS: return subtract(multiply(a, b), value[node->arg[2]]);
	}
	bug("a quadrature program has operation %s", op_name(node->op));
}

/* All values; accumulators begin at 0. */
static Residue *run(const Program *program, const Residue *coordinate)
{
	const Dag *dag = program->dag;
	Residue *value = allocate((size_t)dag->count * sizeof *value);
	unsigned char *ready = allocate((size_t)dag->count);
	for (int i = 0; i < dag->count; ++i) {
		const Node *node = &dag->node[i];
		ready[i] = op_operands(node->op) == 0;
		if (node->op == OP_CONST)
			value[i] = residue(node->value);
		for (int var = VAR_X0; var <= VAR_Y3 && node->op == OP_INPUT; ++var)
			if (node->input == mono_var(var, 1))
				value[i] = coordinate[var - VAR_X0];
	}
	for (int at = 0; at < program->count; ++at) {
		Ref ref = program->order[at];
		const Node *node = &dag->node[ref];
		for (int k = 0; k < op_operands(node->op); ++k)
			if (!ready[node->arg[k]] || program->last[node->arg[k]] < at)
				bug("after schedule step %d uses a value that is not there", at);
		value[ref] = operation(node, value);
		ready[ref] = 1;
	}
	return value;
}

static Residue finished(const Dag *dag, const Residue *value, int output)
{
	if (!dag->finishes)
		return value[dag->out[output]];
	Residue sum = 0;
	const Poly form = dag->finish[output];
	for (int i = 0; i < form.count; ++i) {
		int k = mono_accumulator_of(form.term[i].mono);
		sum = add(sum, multiply(residue(form.term[i].coef), value[dag->out[k]]));
	}
	return sum;
}

/* ---- the definition ---- */

/* Value and derivative by tau of one coordinate at t = (1 + tau)/2. */
static void casteljau(int points, const Residue *coordinate, Residue t, Residue *value,
	Residue *slope)
{
	Residue p[4], s = subtract(1, t);
	for (int i = 0; i < points; ++i)
		p[i] = coordinate[2 * i];
	for (int count = points; count > 2; --count)
		for (int i = 0; i + 1 < count; ++i)
			p[i] = add(multiply(s, p[i]), multiply(t, p[i + 1]));
	*value = add(multiply(s, p[0]), multiply(t, p[1]));
	*slope = multiply(multiply(subtract(p[1], p[0]), (Residue)points - 1), inverse(2));
}

static Residue definition(const Dag *dag, const Residue *coordinate, int m, int n, int degree)
{
	Rat tau[LEGENDRE_MAX], weight[LEGENDRE_MAX];
	const int points = window_points(dag->window);
	const int count = gauss_legendre(curve_nodes(dag->window, degree), tau, weight);
	Residue sum = 0, half = inverse(2);
	for (int i = 0; i < 2 * count; ++i) {
		Residue node = residue(tau[i / 2]), x, y, dx, dy;
		if (i % 2 && node == 0)
			continue;
		Residue t = multiply(half, i % 2 ? subtract(1, node) : add(1, node));
		casteljau(points, coordinate, t, &x, &dx);
		casteljau(points, coordinate + 1, t, &y, &dy);
		Residue turn = subtract(multiply(x, dy), multiply(y, dx));
		Residue value = multiply(power(x, (uint64_t)m), power(y, (uint64_t)n));
		sum = add(sum, multiply(residue(weight[i / 2]), multiply(value, turn)));
	}
	return multiply(sum, inverse((Residue)(m + n + 2)));
}

static void prove_at(const Program *program, const Residue *coordinate, int m, int n)
{
	const Dag *dag = program->dag;
	const Residue *value = run(program, coordinate);
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
			coordinate[i] = (seed ^ seed >> 29) % prime;
		}
		prove_at(program, coordinate, m, n);
		arena_release(mark);
	}
}

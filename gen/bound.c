/* bound.c - a rigorous bound of the rounding errors of a program, from its DAG alone.
 *
 * It counts roundings along every path (e.g. Higham 2002, ch. 3): a node is the sum S of its terms
 * with every sign positive, and E, the same terms each times the number of roundings it has been
 * through. With W the positive terms of the exact polynomial, |computed - exact| <= gamma_k W for
 * k = max(E / W over all monomials, longest path). Multiplying by a power of two does not round.
 * The vertex form is bounded by its own terms, so W is S there. */
#include "gen.h"

/* terms with positive sign; times roundings; longest path */
typedef struct { Poly s, e; int depth; } Weight;

static Weight rounded(Poly s, Poly e, int depth)
{
	return (Weight){ s, poly_add(e, s), depth + 1 };
}

static Weight product(Weight a, Weight b)
{
	Poly e = poly_add(poly_mul(a.e, b.s), poly_mul(a.s, b.e));
	return (Weight){ poly_mul(a.s, b.s), e, a.depth + b.depth };
}

static int is_power_of_two(const Node *node)
{
	return node->op == OP_CONST && rat_significant(node->value) == 1;
}

static Weight constant(Rat value)
{
	enum { EXACT_BITS = 24 };                     /* exact in float is exact in double */
	int bits = rat_significant(value), exact = bits > 0 && bits <= EXACT_BITS;
	Weight weight = { poly_const(rat_abs(value)), poly_zero(), 0 };
	return exact ? weight : rounded(weight.s, weight.e, 0);
}

static Weight weigh(const Dag *dag, const Node *node, const Weight *done, const Weight *inputs)
{
	if (node->op == OP_CONST)
		return constant(node->value);
	if (node->op == OP_INPUT) {
		int accumulator = mono_accumulator_of(node->input);
		if (inputs && accumulator >= 0)
			return inputs[accumulator];
		return (Weight){ poly_mono(rat(1, 1), node->input), poly_zero(), 0 };
	}
	if (node->op == OP_ABS)
		return done[node->arg[0]];
	Weight a = done[node->arg[0]], b = done[node->arg[1]];
	if (node->op == OP_MUL) {
		Weight p = product(a, b);
		if (is_power_of_two(&dag->node[node->arg[0]])
		    || is_power_of_two(&dag->node[node->arg[1]]))
			return p;
		return rounded(p.s, p.e, p.depth);
	}
	if (node->op != OP_ADD && node->op != OP_SUB) {
		a = product(a, b);
		b = done[node->arg[2]];
	}
	return rounded(poly_add(a.s, b.s), poly_add(a.e, b.e),
		a.depth > b.depth ? a.depth : b.depth);
}

static Weight *weights(const Dag *dag, const Weight *inputs)
{
	const int *uses = dag_uses(dag);
	Weight *weight = allocate((size_t)dag->count * sizeof *weight);
	for (int i = 0; i < dag->count; ++i)
		if (uses[i])
			weight[i] = weigh(dag, &dag->node[i], weight, inputs);
	return weight;
}

/* Smallest k with E <= k W in every monomial. */
static int ratio(Weight weight, Poly magnitude)
{
	Rat worst = { weight.depth, 1 };
	for (int i = 0, j = 0; i < weight.e.count; ++i) {
		while (j < magnitude.count && magnitude.term[j].mono > weight.e.term[i].mono)
			++j;
		if (j == magnitude.count || magnitude.term[j].mono != weight.e.term[i].mono)
			bug("a term of the error bound has no counterpart in the exact sum");
		Rat here = rat_div(weight.e.term[i].coef, magnitude.term[j].coef);
		if (rat_compare(here, worst) > 0)
			worst = here;
	}
	Int k = rat_ceil(worst);
	return k < WORTHLESS ? (int)k : WORTHLESS;
}

Bound bound_path(const Dag *dag)
{
	const int *uses = dag_uses(dag);
	int *depth = allocate((size_t)dag->count * sizeof *depth);
	Bound bound = { 0, dag->finishes > 0 };
	for (int i = 0; i < dag->count; ++i) {
		const Node *node = &dag->node[i];
		if (!uses[i] || op_operands(node->op) == 0) {
			depth[i] = node->op == OP_CONST ? constant(node->value).depth : 0;
			continue;
		}
		int a = depth[node->arg[0]];
		int b = op_operands(node->op) > 1 ? depth[node->arg[1]] : 0;
		int c = op_operands(node->op) > 2 ? depth[node->arg[2]] : 0;
		if (node->op == OP_MIN || node->op == OP_MAX || node->op == OP_CHOOSE)
			depth[i] = a > b ? a > c ? a : c : b > c ? b : c;
		else if (node->op == OP_MUL || node->op == OP_DIV)
			depth[i] = a + b + !(is_power_of_two(&dag->node[node->arg[0]])
				|| is_power_of_two(&dag->node[node->arg[1]]));
		else
			depth[i] = (a > b ? a : b) + 1;
	}
	for (int k = 0; k < dag->outs; ++k)
		bound.k = depth[dag->out[k]] > bound.k ? depth[dag->out[k]] : bound.k;
	bound.k += dag->finishes > 0;                 /* the factor of the finish */
	return bound;
}

Bound bound_edge(const Dag *dag, const Integral *want)
{
	Mark mark = arena_mark();
	Weight weight = weights(dag, NULL)[dag->out[0]];
	Bound bound = { ratio(weight, want->magnitude), 0 };
	arena_release(mark);
	return bound;
}

/* Weight of v_k, and in *repeat how often an item rounds what is already in accumulator k. */
static Weight without_accumulator(Weight weight, int k, int *repeat)
{
	const Mono own = mono_accumulator(k);
	for (int i = 0; i < weight.e.count; ++i)
		if (weight.e.term[i].mono == own)
			*repeat = (int)weight.e.term[i].coef.num;
	return (Weight){ poly_sub(weight.s, poly_mono(rat(1, 1), own)),
		poly_sub(weight.e, poly_mono(rat(*repeat, 1), own)), weight.depth };
}

Bound *bound_ring(const Dag *dag, const Dag *finish, const Integral *want, int count)
{
	Bound *bound = allocate((size_t)count * sizeof *bound);
	Mark mark = arena_mark();
	const Weight *weight = weights(dag, NULL);
	Weight *value = allocate((size_t)(dag->outs * dag->turns) * sizeof *value);
	int *repeat = allocate((size_t)dag->outs * sizeof *repeat);
	for (int k = 0; k < dag->outs; ++k) {
		value[k] = without_accumulator(weight[dag->out[k]], k, &repeat[k]);
		for (int turn = 1; turn < dag->turns; ++turn)
			value[k + turn * dag->outs] = value[k];
	}
	const Weight *result = weights(finish, value);
	for (int j = 0; j < count; ++j) {
		Weight final = result[finish->out[j]];
		bound[j].k = ratio(final, dag->window != WINDOW_VERTEX ? want[j].magnitude : final.s);
		for (int i = 0; i < dag->finish[j].count; ++i) {
			int again = repeat[mono_accumulator_of(dag->finish[j].term[i].mono)];
			bound[j].repeat = again > bound[j].repeat ? again : bound[j].repeat;
		}
	}
	arena_release(mark);
	return bound;
}

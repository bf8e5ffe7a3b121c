/* dag.c - operations as a hash-consed directed acyclic graph.
 *
 * A node is an operation on nodes with smaller indices, so the array is always in a valid
 * order of evaluation and passes are plain loops. Equal operations are the same node:
 * common subexpressions need no pass. The operands of commutative operations are kept in index
 * order (IEEE addition and multiplication commute bit for bit). The smart constructors remove
 * multiplications by 1 and additions of 0, nothing else: floating point does not reassociate.
 *
 * dag_reverses() proves a statement about bits, not about values: swapping the two ends
 * of the edge maps every node to a node that computes the same bits, or the negative ones,
 * and every output to its negative. */
#include "gen.h"

#include <string.h>

#define OP(name, operands, commutes, fma, add, divide, c, x86, neon, wasm) \
	{ #name, operands, commutes, fma, add, divide, { c, x86, neon, wasm } },
static const struct {
	const char *name;
	int operands, commutes, fma, add, divide;
	const char *text[SPELLINGS];
} ops[OPS] = {
#include "ops.def"
};
#undef OP

int op_operands(int op)
{
	return ops[op].operands;
}

int op_fma_cost(int op)
{
	return ops[op].fma;
}

int op_add_cost(int op)
{
	return ops[op].add;
}

int op_divide_cost(int op)
{
	return ops[op].divide;
}

int op_commutes(int op)
{
	return ops[op].commutes;
}

const char *op_name(int op)
{
	return ops[op].name;
}

const char *op_spelling(int op, int how)
{
	return ops[op].text[how];
}

Dag *dag_new(const char *scheme)
{
	Dag *dag = allocate(sizeof *dag);
	dag->scheme = scheme;
	dag->window = WINDOW_LINE;
	dag->turns = 1;
	dag->room = 64;
	dag->node = allocate((size_t)dag->room * sizeof *dag->node);
	dag->out = allocate(sizeof *dag->out);
	dag->buckets = 256;
	dag->bucket = allocate((size_t)dag->buckets * sizeof *dag->bucket);
	memset(dag->bucket, 0xff, (size_t)dag->buckets * sizeof *dag->bucket);
	return dag;
}

int window_points(int window)
{
	static const int points[WINDOWS] = { 2, 3, 3, 3, 4, 2 };
	return points[window];
}

int window_planes(int window)
{
	return window_points(window) + (window == WINDOW_CONIC);
}

static uint64_t node_hash(const Node *node)
{
	const uint64_t key[] = { node->op, node->arg[0], node->arg[1], node->arg[2],
		(uint64_t)node->value.num, (uint64_t)node->value.den,
		(uint64_t)node->input, (uint64_t)(node->input >> 64) };
	uint64_t hash = 0;
	for (int i = 0; i < LENGTH(key); ++i)
		hash = (hash ^ key[i]) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
	return hash;
}

static int node_equal(const Node *a, const Node *b)
{
	return a->op == b->op && a->arg[0] == b->arg[0] && a->arg[1] == b->arg[1]
		&& a->arg[2] == b->arg[2] && a->value.num == b->value.num
		&& a->value.den == b->value.den && a->input == b->input;
}

static Ref *find(const Dag *dag, const Node *node)
{
	uint64_t i = node_hash(node);
	for (;; ++i) {
		Ref *slot = &dag->bucket[i & (uint64_t)(dag->buckets - 1)];
		if (*slot == NONE || node_equal(&dag->node[*slot], node))
			return slot;
	}
}

static void grow(Dag *dag)
{
	Node *node = allocate(2 * (size_t)dag->room * sizeof *node);
	memcpy(node, dag->node, (size_t)dag->count * sizeof *node);
	dag->node = node;
	dag->room *= 2;
	dag->buckets = 4 * dag->room;
	dag->bucket = allocate((size_t)dag->buckets * sizeof *dag->bucket);
	memset(dag->bucket, 0xff, (size_t)dag->buckets * sizeof *dag->bucket);
	for (Ref i = 0; i < (Ref)dag->count; ++i)
		*find(dag, &dag->node[i]) = i;
}

static Ref intern(Dag *dag, Node node)
{
	Ref *slot = find(dag, &node);
	if (*slot != NONE)
		return *slot;
	if (dag->count == dag->room) {
		grow(dag);
		slot = find(dag, &node);
	}
	dag->node[dag->count] = node;
	return *slot = (Ref)dag->count++;
}

Ref dag_node(Dag *dag, int op, Ref a, Ref b, Ref c)
{
	if (op_commutes(op) && a > b) {        /* a b = b a, a + b = b + a */
		Ref swap = a;
		a = b;
		b = swap;
	}
	const Node node = { .op = (unsigned char)op, .arg = { a, b, c }, .value = { 0, 1 } };
	return intern(dag, node);
}

Ref dag_input(Dag *dag, Mono input)
{
	const Node node = {
		.op = OP_INPUT, .arg = { NONE, NONE, NONE }, .value = { 0, 1 }, .input = input
	};
	return intern(dag, node);
}

Ref dag_var(Dag *dag, int var)
{
	return dag_input(dag, mono_var(var, 1));
}

Ref dag_accumulator(Dag *dag, int index)
{
	return dag_input(dag, mono_accumulator(index));
}

Ref dag_const(Dag *dag, Rat value)
{
	return intern(dag, (Node){ .op = OP_CONST, .arg = { NONE, NONE, NONE }, .value = value });
}

Ref dag_add(Dag *dag, Ref a, Ref b)
{
	if (a == NONE || b == NONE)
		return a == NONE ? b : a;
	return dag_node(dag, OP_ADD, a, b, NONE);
}

Ref dag_sub(Dag *dag, Ref a, Ref b)
{
	return b == NONE ? a : dag_node(dag, OP_SUB, a, b, NONE);
}

static int is_one(const Dag *dag, Ref a)
{
	return dag->node[a].op == OP_CONST && rat_is(dag->node[a].value, 1);
}

Ref dag_mul(Dag *dag, Ref a, Ref b)
{
	if (is_one(dag, a))
		return b;
	return is_one(dag, b) ? a : dag_node(dag, OP_MUL, a, b, NONE);
}

Ref dag_div(Dag *dag, Ref a, Ref b)
{
	return dag_node(dag, OP_DIV, a, b, NONE);
}

Ref dag_unary(Dag *dag, int op, Ref a)
{
	return dag_node(dag, op, a, NONE, NONE);
}

Ref dag_choose(Dag *dag, Ref a, Ref positive, Ref otherwise)
{
	return dag_node(dag, OP_CHOOSE, a, positive, otherwise);
}

Ref dag_scale(Dag *dag, Rat factor, Ref a)
{
	return dag_mul(dag, dag_const(dag, factor), a);
}

Ref dag_name(Dag *dag, Ref a, const char *name)
{
	Node *node = &dag->node[a];
	if (!node->name && node->op != OP_INPUT && node->op != OP_CONST)
		node->name = name;
	return a;
}

void dag_out(Dag *dag, Ref root)
{
	Ref *out = allocate((size_t)(dag->outs + 1) * sizeof *out);
	memcpy(out, dag->out, (size_t)dag->outs * sizeof *out);
	out[dag->outs++] = root;
	dag->out = out;
}

void dag_accumulate(Dag *dag, Ref value)
{
	Ref sum = dag_add(dag, dag_accumulator(dag, dag->outs), value);
	dag_out(dag, sum);
}

int *dag_uses(const Dag *dag)
{
	int *uses = allocate((size_t)dag->count * sizeof *uses);
	for (int i = 0; i < dag->outs; ++i)
		++uses[dag->out[i]];
	for (int i = dag->count - 1; i >= 0; --i)
		for (int k = 0; uses[i] && k < op_operands(dag->node[i].op); ++k)
			++uses[dag->node[i].arg[k]];
	return uses;
}

Poly dag_expand_node(const Node *node, const Poly *done)
{
	Poly a = node->arg[0] == NONE ? poly_zero() : done[node->arg[0]];
	Poly b = node->arg[1] == NONE ? poly_zero() : done[node->arg[1]];
	Poly c = node->arg[2] == NONE ? poly_zero() : done[node->arg[2]];
	switch (node->op) {
	case OP_INPUT: return poly_mono(rat(1, 1), node->input);
	case OP_CONST: return poly_const(node->value);
	case OP_LEAST: return poly_zero();
	case OP_ADD:   return poly_add(a, b);
	case OP_SUB:   return poly_sub(a, b);
	case OP_MUL:   return poly_mul(a, b);
	case OP_DIV:
		if (b.count == 1 && b.term[0].mono == 0)
			return poly_scale(a, rat_div(rat(1, 1), b.term[0].coef));
		break;
	case OP_ABS:   return poly_abs(a);
	case OP_ROUND: return a;
	case OP_FMA:   return poly_add(poly_mul(a, b), c);
	case OP_ERROR:
	case OP_FMS:   return poly_sub(poly_mul(a, b), c);
	}
	bug("operation %d has no meaning as a polynomial", node->op);
}

Poly *dag_expand(const Dag *dag)
{
	const int *uses = dag_uses(dag);
	Poly *poly = allocate((size_t)dag->count * sizeof *poly);
	for (int i = 0; i < dag->count; ++i)
		if (uses[i])
			poly[i] = dag_expand_node(&dag->node[i], poly);
	return poly;
}

/* The same coordinate of the curve that runs backwards. */
static Ref mirrored_input(Dag *dag, Mono input)
{
	const int points = window_points(dag->window);
	for (int var = VAR_X0; var < VAR_X0 + 2 * points; ++var)
		if (input == mono_var(var, 1)) {
			int point = (var - VAR_X0) / 2, axis = (var - VAR_X0) % 2;
			return dag_var(dag, VAR_X0 + 2 * (points - 1 - point) + axis);
		}
	return dag_input(dag, input);          /* a weight, or the corner of a cell */
}

/* The sign of an operation on operands with these signs, 0 if it does not just change sign. */
static int sign_of(int op, int a, int b, int c)
{
	switch (op) {
	case OP_ADD:
	case OP_SUB:    return a == b ? a : 0;
	case OP_MUL:
	case OP_DIV:    return a * b;
	case OP_ERROR:
	case OP_FMA:
	case OP_FMS:    return a * b == c ? c : 0;
	case OP_CHOOSE: return a > 0 && b == c ? b : 0;
	case OP_ABS:    return 1;
	case OP_ROUND:  return b > 0 ? a : 0;
	}
	return a > 0 && b > 0 ? 1 : 0;
}

/* Are the two ends here put in an order? The smaller or larger of both is the same in the mirror;
 * so is a choice by the sign of a difference, except where that is 0: there the edge is vertical,
 * and what is chosen meets a factor that is exactly 0. */
static int is_unordered(const Dag *dag, const Node *node, const Ref *arg, const int *s)
{
	if (node->op == OP_MIN || node->op == OP_MAX)
		return arg[0] == node->arg[1] && arg[1] == node->arg[0];
	return node->op == OP_CHOOSE && s[0] < 0 && dag->node[arg[0]].op == OP_SUB;
}

static int are_opposite(const Dag *dag, Ref a, Ref b)
{
	return dag->node[a].op == OP_CONST && dag->node[b].op == OP_CONST
		&& rat_compare(dag->node[a].value, rat_neg(dag->node[b].value)) == 0;
}

/* The node that computes the mirror image of `node`, up to the sign it returns;
 * NONE if there is none. */
static Ref mirror(Dag *dag, const Node *node, const Ref *image, const int *sign, int *result_sign)
{
	Ref arg[3] = { NONE, NONE, NONE };
	int s[3] = { 1, 1, 1 };
	*result_sign = 1;
	if (node->op == OP_INPUT && dag->window == WINDOW_VERTEX)
		return NONE;
	if (node->op == OP_CONST)
		return dag_const(dag, node->value);
	if (node->op == OP_INPUT && mono_accumulator_of(node->input) >= 0) {
		*result_sign = -1;             /* it was negative all along */
		return dag_input(dag, node->input);
	}
	if (node->op == OP_INPUT)
		return mirrored_input(dag, node->input);
	for (int k = 0; k < op_operands(node->op); ++k) {
		arg[k] = image[node->arg[k]];
		s[k] = sign[node->arg[k]];
		if (arg[k] == NONE)
			return NONE;
	}
	if (node->op == OP_CHOOSE && s[0] < 0 && are_opposite(dag, node->arg[1], node->arg[2])) {
		*result_sign = -1;
		return dag_node(dag, OP_CHOOSE, arg[0], arg[1], arg[2]);
	}
	if (is_unordered(dag, node, arg, s)) {
		Ref other = arg[1];
		arg[1] = arg[node->op == OP_CHOOSE ? 2 : 0];
		arg[node->op == OP_CHOOSE ? 2 : 0] = other;
		s[0] = 1;
	}
	*result_sign = sign_of(node->op, s[0], s[1], s[2]);
	return *result_sign ? dag_node(dag, node->op, arg[0], arg[1], arg[2]) : NONE;
}

int dag_reverses(Dag *dag)
{
	const int count = dag->count;
	Ref *image = allocate((size_t)count * sizeof *image);
	int *sign = allocate((size_t)count * sizeof *sign);
	for (int i = 0; i < count; ++i) {
		Node node = dag->node[i];
		image[i] = mirror(dag, &node, image, sign, &sign[i]);
		if (node.op != OP_SUB || image[i] == NONE || image[i] < (Ref)count)
			continue;
		const Node found = dag->node[image[i]];
		Ref opposite = dag_node(dag, OP_SUB, found.arg[1], found.arg[0], NONE);
		if (opposite < (Ref)count) {           /* b - a is -(a - b), bit for bit */
			image[i] = opposite;
			sign[i] = -sign[i];
		}
	}
	for (int k = 0; k < dag->outs; ++k) {
		const Node *out = &dag->node[dag->out[k]];
		const int is_zero = out->op == OP_CONST && out->value.num == 0;
		if (!is_zero && (image[dag->out[k]] != dag->out[k] || sign[dag->out[k]] != -1))
			return 0;
	}
	return 1;
}

void dag_dump(Text *text, const Dag *dag)
{
	const int *uses = dag_uses(dag);
	for (int i = 0; i < dag->count; ++i) {
		const Node *node = &dag->node[i];
		if (!uses[i])
			continue;
		text_add(text, "  %%%d = %s", i, op_name(node->op));
		if (node->op == OP_INPUT)
			text_add(text, " %s", poly_text(poly_mono(rat(1, 1), node->input), " "));
		else if (node->op == OP_CONST)
			text_add(text, " %s", rat_text(node->value));
		for (int k = 0; k < op_operands(node->op); ++k)
			text_add(text, " %%%u", (unsigned)node->arg[k]);
		text_add(text, node->name ? "  # %s\n" : "\n", node->name);
	}
	for (int k = 0; k < dag->outs; ++k)
		text_add(text, "  out %d = %%%u\n", k, (unsigned)dag->out[k]);
}

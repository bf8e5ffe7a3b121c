/* fuse.c - a b + c becomes one fused multiply-add; the only file that knows about it.
 *
 * A product is fused into the one sum that uses it; a product with more users stays,
 * and so does the difference of two products: x0 y1 - x1 y0 with one FMA would be neither
 * antisymmetric nor 0 on a repeated vertex. Fusing only removes roundings, so every error bound
 * that holds before holds after. */
#include "gen.h"

typedef struct { const Dag *from; Dag *to; const int *uses; Ref *map; } Fusion;

static int is_product(const Fusion *f, Ref ref)
{
	return f->from->node[ref].op == OP_MUL;
}

static int only_here(const Fusion *f, Ref ref)
{
	return is_product(f, ref) && f->uses[ref] == 1;
}

static Ref fused(const Fusion *f, int op, Ref product, Ref other)
{
	const Node *mul = &f->from->node[product];
	return dag_node(f->to, op, f->map[mul->arg[0]], f->map[mul->arg[1]], f->map[other]);
}

static Ref fuse_node(const Fusion *f, const Node *node)
{
	Ref a = node->arg[0], b = node->arg[1];
	if (node->op == OP_INPUT)
		return dag_input(f->to, node->input);
	if (node->op == OP_CONST)
		return dag_const(f->to, node->value);
	if (node->op == OP_ERROR)
		return dag_node(f->to, OP_FMS, f->map[a], f->map[b], f->map[node->arg[2]]);
	if (node->op == OP_ADD && only_here(f, b))
		return fused(f, OP_FMA, b, a);
	if (node->op == OP_ADD && only_here(f, a))
		return fused(f, OP_FMA, a, b);
	if (node->op == OP_SUB && only_here(f, a) && !is_product(f, b))
		return fused(f, OP_FMS, a, b);
	Ref arg[3] = { NONE, NONE, NONE };
	for (int k = 0; k < op_operands(node->op); ++k)
		arg[k] = f->map[node->arg[k]];
	return dag_node(f->to, node->op, arg[0], arg[1], arg[2]);
}

Dag *fuse(const Dag *dag)
{
	Ref *map = allocate((size_t)dag->count * sizeof *map);
	Fusion f = { dag, dag_new(dag->scheme), dag_uses(dag), map };
	for (int i = 0; i < dag->count; ++i)
		if (f.uses[i])
			f.map[i] = dag_name(f.to, fuse_node(&f, &dag->node[i]), dag->node[i].name);
	for (int k = 0; k < dag->outs; ++k)
		dag_out(f.to, f.map[dag->out[k]]);
	f.to->finish = dag->finish;
	f.to->finishes = dag->finishes;
	f.to->window = dag->window;
	f.to->turns = dag->turns;
	f.to->proof = dag->proof;
	f.to->k = dag->k;
	return f.to;
}

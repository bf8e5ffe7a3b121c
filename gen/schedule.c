/* schedule.c - a DAG becomes a straight-line program: an order of evaluation with live ranges.
 *
 * Three orders are tried: the order of construction, and depth first from the outputs, the operand
 * that needs more registers first (Sethi and Ullman 1970, exact for trees, a good guess for DAGs),
 * once as the outputs stand and once, for sums over quadrature nodes, in rows: where they are all
 * moments to a degree, those with the same power of x one after the other, since each is made of
 * the products of the one before.
 * The one with the fewest values alive at once is taken. Where they do not fit into registers
 * anyway, rows may have an eighth more: they need no partial sums, which would be stored and loaded
 * again for every node of a quadrature. Accumulators are not counted:
 * their place is up to the kernel. */
#include "gen.h"

enum { REGISTERS = 32 };           /* the most that a target has */

static int is_operation(const Node *node)
{
	return op_operands(node->op) > 0;
}

static int lives(const Node *node)
{
	return is_operation(node) || (node->op == OP_INPUT && mono_accumulator_of(node->input) < 0);
}

/* Registers each node needs when its operands are evaluated in the best order. */
static int *needs(const Dag *dag)
{
	int *need = allocate((size_t)dag->count * sizeof *need);
	for (int i = 0; i < dag->count; ++i) {
		const Node *node = &dag->node[i];
		need[i] = 1;
		for (int k = 0; k < op_operands(node->op); ++k) {
			int n = need[node->arg[k]];
			need[i] = n > need[i] ? n : need[i] + (k > 0 && n == need[i]);
		}
	}
	return need;
}

static void visit(Program *program, const int *need, unsigned char *done, Ref ref)
{
	const Node *node = &program->dag->node[ref];
	if (done[ref] || !is_operation(node))
		return;
	done[ref] = 1;
	int count = op_operands(node->op);
	unsigned char visited[3] = { 0 };
	for (int round = 0; round < count; ++round) {
		int best = -1;
		for (int k = 0; k < count; ++k)
			if (!visited[k] && (best < 0 || need[node->arg[k]] > need[node->arg[best]]))
				best = k;
		visited[best] = 1;
		visit(program, need, done, node->arg[best]);
	}
	program->order[program->count++] = ref;
}

static void measure(Program *program)
{
	const Dag *dag = program->dag;
	int *depth = allocate((size_t)dag->count * sizeof *depth), alive = 0;
	unsigned char *seen = allocate((size_t)dag->count);
	program->last = allocate((size_t)dag->count * sizeof *program->last);
	for (int at = 0; at < program->count; ++at) {
		const Node *node = &dag->node[program->order[at]];
		for (int k = 0; k < op_operands(node->op); ++k)
			program->last[node->arg[k]] = at;
	}
	for (int at = 0; at < program->count; ++at) {
		Ref ref = program->order[at];
		const Node *node = &dag->node[ref];
		for (int k = 0; k < op_operands(node->op); ++k) {
			Ref arg = node->arg[k];
			if (!seen[arg] && dag->node[arg].op == OP_INPUT && lives(&dag->node[arg]))
				++alive;
			seen[arg] = 1;
			depth[ref] = depth[arg] >= depth[ref] ? depth[arg] + 1 : depth[ref];
		}
		++alive;
		if (alive > program->live)
			program->live = alive;
		for (int k = 0; k < op_operands(node->op); ++k) {
			Ref arg = node->arg[k];
			int again = k > 0
				&& (arg == node->arg[0] || (k == 2 && arg == node->arg[1]));
			alive -= !again && lives(&dag->node[arg]) && program->last[arg] == at;
		}
		alive -= program->last[ref] == 0;   /* an output goes straight to its accumulator */
		if (depth[ref] > program->depth)
			program->depth = depth[ref];
		program->cost.fma += op_fma_cost(node->op);
		program->cost.add += op_add_cost(node->op);
		program->cost.divide += op_divide_cost(node->op);
		if (node->op != OP_FMA && node->op != OP_FMS)
			program->cost.mul += op_fma_cost(node->op);
	}
}

/* All outputs in rows of x^m, x^m y, x^m y^2, ...; as they stand if they are no triangle. */
static int *in_rows(int outs)
{
	int *order = allocate((size_t)outs * sizeof *order), count = 0, degree = 0;
	while ((degree + 1) * (degree + 2) / 2 < outs)
		++degree;
	if ((degree + 1) * (degree + 2) / 2 == outs)
		for (int m = 0; m <= degree; ++m)
			for (int n = 0; n <= degree - m; ++n)
				order[count++] = (m + n) * (m + n + 1) / 2 + n;
	for (; count < outs; ++count)
		order[count] = count;
	return order;
}

typedef enum { BUILT, DEEP, ROWS } Order;

static Program ordered(const Dag *dag, Order order)
{
	Program program = { .dag = dag, .order = allocate((size_t)dag->count * sizeof(Ref)) };
	const int *uses = dag_uses(dag), *need = needs(dag), *row = in_rows(dag->outs);
	unsigned char *done = allocate((size_t)dag->count);
	for (int k = 0; k < dag->outs && order != BUILT; ++k)
		visit(&program, need, done, dag->out[order == ROWS ? row[k] : k]);
	for (int i = 0; i < dag->count && order == BUILT; ++i)
		if (uses[i] && is_operation(&dag->node[i]))
			program.order[program.count++] = (Ref)i;
	measure(&program);
	return program;
}

Program schedule(const Dag *dag)
{
	Program built = ordered(dag, BUILT), deep = ordered(dag, DEEP);
	Program best = deep.live <= built.live ? deep : built;
	if (dag->proof == PROOF_POLYNOMIAL)
		return best;
	Program rows = ordered(dag, ROWS);
	int most = best.live <= REGISTERS ? best.live - 1 : best.live + best.live / 8;
	return rows.live <= most ? rows : best;
}

void program_check_step(const Program *program, int at, const unsigned char *ready)
{
	const Node *node = &program->dag->node[program->order[at]];
	for (int k = 0; k < op_operands(node->op); ++k)
		if (!ready[node->arg[k]] || program->last[node->arg[k]] < at)
			bug("after schedule step %d uses a value that is not there", at);
}

void program_dump(Text *text, const Program *program)
{
	for (int at = 0; at < program->count; ++at) {
		const Node *node = &program->dag->node[program->order[at]];
		text_add(text, "  %3d: %%%u = %s", at, (unsigned)program->order[at],
			op_name(node->op));
		for (int k = 0; k < op_operands(node->op); ++k) {
			int dies = program->last[node->arg[k]] == at;
			text_add(text, " %%%u%s", (unsigned)node->arg[k], dies ? "'" : "");
		}
		text_add(text, node->name ? "  # %s\n" : "\n", node->name);
	}
	text_add(text, "  %d operations, FMA pipe %d, adder %d, live %d, depth %d\n",
		program->count, program->cost.fma, program->cost.add, program->live,
		program->depth);
}

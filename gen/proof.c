/* proof.c - the always-on checks.
 *
 * After scheme, after fuse and after schedule every output is expanded back into a polynomial over
 * Q and compared with what green.c says. A difference is a bug of ours: abort before any file is
 * written. For rings the identity is checked through the accumulators: output k must be accumulator
 * k plus some polynomial v_k, and the finish forms applied to v must give each moment of one edge.
 * The vertex form differs from the edge form by terms that cancel around any ring;
 * the proof exhibits them: D(p0,p1,p2) = G(p1,p2) - G(p0,p1) with G read off D itself. */
#include "gen.h"

static void disprove(const char *pass, int output, Poly have, Poly want)
{
	bug("the proof failed after %s: output %d\n  is        %s\n  should be %s", pass, output,
		poly_text(have, " "), poly_text(want, " "));
}

/* v_k of every output: its polynomial less accumulator k, of which no trace may remain. */
static Poly *accumulated(const Poly *poly, const Dag *dag, const char *pass)
{
	Poly *value = allocate((size_t)dag->outs * sizeof *value);
	for (int k = 0; k < dag->outs; ++k) {
		value[k] = poly[dag->out[k]];
		if (!dag->finishes)
			continue;
		value[k] = poly_sub(value[k], poly_mono(rat(1, 1), mono_accumulator(k)));
		for (int i = 0; i < value[k].count; ++i)
			if (mono_accumulator_of(value[k].term[i].mono) >= 0)
				bug("after %s accumulator %d is not a plain sum", pass, k);
	}
	return value;
}

static Poly finished(Poly form, const Poly *value)
{
	Poly sum = poly_zero();
	for (int i = 0; i < form.count; ++i) {
		Poly part = value[mono_accumulator_of(form.term[i].mono)];
		sum = poly_add(sum, poly_scale(part, form.term[i].coef));
	}
	return sum;
}

static Poly rename_vertices(Poly a, int from, int to)
{
	const int vars[] = { VAR_X0 + 2 * from, VAR_Y0 + 2 * from };
	const Poly by[] = { poly_var(VAR_X0 + 2 * to), poly_var(VAR_Y0 + 2 * to) };
	return poly_substitute(a, vars, by, 2);
}

static Poly at_origin(Poly a, int vertex)
{
	const int vars[] = { VAR_X0 + 2 * vertex, VAR_Y0 + 2 * vertex };
	const Poly by[] = { poly_zero(), poly_zero() };
	return poly_substitute(a, vars, by, 2);
}

/* Does the sum of D(p0,p1,p2) vanish around every ring? D = G(p1,p2) - G(p0,p1) + k(p1) - k(p0). */
static int telescopes(Poly d)
{
	Poly g = at_origin(d, 0);
	Poly before = rename_vertices(rename_vertices(g, 1, 0), 2, 1);
	Poly rest = poly_sub(d, poly_sub(g, before));
	Poly k = at_origin(rest, 0);
	return poly_equal(rest, poly_sub(k, rename_vertices(k, 1, 0)));
}

static void prove(const Poly *poly, const Dag *dag, const Integral *want, int count,
	const char *pass)
{
	Poly *value = accumulated(poly, dag, pass);
	if ((dag->finishes ? dag->finishes : dag->outs) != count)
		bug("after %s there are %d outputs for %d integrands", pass, dag->outs, count);
	for (int j = 0; j < count; ++j) {
		Poly have = dag->finishes ? finished(dag->finish[j], value) : value[j];
		if (poly_equal(have, want[j].value))
			continue;
		if (dag->window != WINDOW_VERTEX)
			disprove(pass, j, have, want[j].value);
		Poly edge = rename_vertices(rename_vertices(want[j].value, 1, 2), 0, 1);
		if (!telescopes(poly_sub(have, edge)))
			disprove(pass, j, have, edge);
	}
}

void prove_dag(const Dag *dag, const Integral *want, int count, const char *pass)
{
	Mark mark = arena_mark();
	prove(dag_expand(dag), dag, want, count, pass);
	arena_release(mark);
}

/* The program, run symbolically: an operand must have been computed, and must not be used after
 * its last use. */
static Poly *run(const Program *program)
{
	const Dag *dag = program->dag;
	Poly *poly = allocate((size_t)dag->count * sizeof *poly);
	unsigned char *ready = allocate((size_t)dag->count);
	for (int i = 0; i < dag->count; ++i)
		if (op_operands(dag->node[i].op) == 0) {
			poly[i] = dag_expand_node(&dag->node[i], poly);
			ready[i] = 1;
		}
	for (int at = 0; at < program->count; ++at) {
		Ref ref = program->order[at];
		const Node *node = &dag->node[ref];
		program_check_step(program, at, ready);
		poly[ref] = dag_expand_node(node, poly);
		ready[ref] = 1;
	}
	for (int k = 0; k < dag->outs; ++k)
		if (!ready[dag->out[k]])
			bug("after schedule output %d is never computed", k);
	return poly;
}

void prove_program(const Program *program, const Integral *want, int count)
{
	Mark mark = arena_mark();
	prove(run(program), program->dag, want, count, "schedule");
	arena_release(mark);
}

/* The form of one turn's accumulators, for the accumulators of all turns. */
static Poly all_turns(Poly form, const Dag *ring)
{
	Poly sum = form;
	for (int turn = 1; turn < ring->turns; ++turn)
		for (int i = 0; i < form.count; ++i) {
			int k = mono_accumulator_of(form.term[i].mono) + turn * ring->outs;
			sum = poly_add(sum, poly_mono(form.term[i].coef, mono_accumulator(k)));
		}
	return sum;
}

void prove_finish(const Program *finish, const Dag *ring)
{
	Mark mark = arena_mark();
	const Poly *poly = run(finish);
	for (int j = 0; j < ring->finishes; ++j) {
		Poly want = all_turns(ring->finish[j], ring);
		if (!poly_equal(poly[finish->dag->out[j]], want))
			disprove("finish", j, poly[finish->dag->out[j]], want);
	}
	arena_release(mark);
}

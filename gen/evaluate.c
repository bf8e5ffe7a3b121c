/* evaluate.c - from a polynomial to operations: the pieces that schemes are made of.
 *
 * Leaves say which node stands for each variable, so the same code evaluates in the end
 * points or in their sums and differences. Powers are built from halves and products
 * of both ends from the common part, so that equal powers are equal nodes, and mirrored
 * exponents give mirrored operations. */
#include "gen.h"

#include <stdlib.h>

const int X_VARS[2] = { VAR_X0, VAR_X1 }, Y_VARS[2] = { VAR_Y0, VAR_Y1 };

Leaves ends(Dag *dag)
{
	Leaves leaves = { { 0 } };
	for (int var = VAR_X0; var <= VAR_Y1; ++var)
		leaves.ref[var] = dag_var(dag, var);
	return leaves;
}

/* s = x0 y1 - x1 y0: two rounded products and a subtraction,
 * so a repeated vertex gives exactly 0. */
Ref cross(Dag *dag)
{
	Leaves end = ends(dag);
	Ref left = dag_mul(dag, end.ref[VAR_X0], end.ref[VAR_Y1]);
	Ref right = dag_mul(dag, end.ref[VAR_X1], end.ref[VAR_Y0]);
	return dag_name(dag, dag_sub(dag, left, right), "s");
}

Ref sum_of(Dag *dag, int start, int end, const char *name)
{
	Ref a = dag_var(dag, start), b = dag_var(dag, end);
	return dag_name(dag, dag_add(dag, a, b), name);
}

Ref difference_of(Dag *dag, int start, int end, const char *name)
{
	Ref a = dag_var(dag, start), b = dag_var(dag, end);
	return dag_name(dag, dag_sub(dag, b, a), name);
}

/* Name of p0^i p1^j: x001 for small powers, x5_3 beyond. */
static const char *power_name(char axis, int i, int j)
{
	if (i + j > 4)
		return format("%c%d_%d", axis, i, j);
	return format("%c%.*s%.*s", axis, i, "0000", j, "1111");
}

/* base^power from its halves, so that all powers share products;
 * base is p0^i p1^j of an axis that has names, or 0. */
static Ref power_of(Dag *dag, Ref base, int power, char axis, int i, int j)
{
	if (power == 0)
		return dag_const(dag, rat(1, 1));
	Ref result = base;
	if (power > 1) {
		Ref half = power_of(dag, base, power / 2, axis, i, j);
		Ref rest = power_of(dag, base, power - power / 2, axis, i, j);
		result = dag_mul(dag, half, rest);
	}
	return axis ? dag_name(dag, result, power_name(axis, power * i, power * j)) : result;
}

/* p0^i p1^j as (p0 p1)^min times the power that is left:
 * mirrored exponents give mirrored operations. */
Ref axis_part(Dag *dag, const Leaves *leaves, Mono mono, const int *vars, char axis)
{
	int i = mono_power(mono, vars[0]), j = mono_power(mono, vars[1]), common = i < j ? i : j;
	Ref p = leaves->ref[vars[0]], q = leaves->ref[vars[1]], both = dag_const(dag, rat(1, 1));
	if (common)
		both = power_of(dag, dag_mul(dag, p, q), common, axis, 1, 1);
	Ref left = i > j ? power_of(dag, p, i - j, axis, 1, 0)
		: power_of(dag, q, j - i, axis, 0, 1);
	Ref result = dag_mul(dag, both, left);
	return axis ? dag_name(dag, result, power_name(axis, i, j)) : result;
}

static Ref mono_ref(Dag *dag, const Leaves *leaves, Mono mono)
{
	Ref x = axis_part(dag, leaves, mono, X_VARS, 0);
	Ref y = axis_part(dag, leaves, mono, Y_VARS, 0);
	return dag_mul(dag, x, y);
}

/* The terms from `*from` on that share their part in `vars`; moves *from behind them. */
Poly next_group(Poly sorted, int *from, const int *vars)
{
	Poly group = { 0, sorted.term + *from };
	Mono part = mono_keep(sorted.term[*from].mono, vars, 2);
	while (*from < sorted.count && mono_keep(sorted.term[*from].mono, vars, 2) == part) {
		++*from;
		++group.count;
	}
	return group;
}

typedef struct { Mono part; Term term; } Keyed;

static int by_part(const void *left, const void *right)
{
	const Keyed *a = left, *b = right;
	if (a->part != b->part)
		return a->part < b->part ? 1 : -1;
	return (a->term.mono < b->term.mono) - (a->term.mono > b->term.mono);
}

/* Terms with equal x part, or y part, next to each other; parts and terms in descending order. */
Poly group_by(Poly a, const int *vars)
{
	Poly sorted = { a.count, allocate((size_t)a.count * sizeof(Term)) };
	Keyed *keyed = allocate((size_t)a.count * sizeof *keyed);
	for (int i = 0; i < a.count; ++i)
		keyed[i] = (Keyed){ mono_keep(a.term[i].mono, vars, 2), a.term[i] };
	qsort(keyed, (size_t)a.count, sizeof *keyed, by_part);
	for (int i = 0; i < a.count; ++i)
		sorted.term[i] = keyed[i].term;
	return sorted;
}

/* Sum over groups of equal outer part:
 * (row / its common power product) * (common product * outer part). */
Ref grouped(Dag *dag, const Leaves *leaves, Poly density, const int *outer)
{
	Ref sum = NONE;
	Poly sorted = group_by(density, outer);
	for (int from = 0; from < sorted.count; ) {
		Poly part = next_group(sorted, &from, outer);
		Mono common = part.term[0].mono;
		Ref inner = NONE;
		for (int i = 1; i < part.count; ++i)
			common = mono_gcd(common, part.term[i].mono);
		for (int i = 0; i < part.count; ++i) {
			Ref term = mono_ref(dag, leaves, part.term[i].mono - common);
			inner = dag_add(dag, inner, dag_scale(dag, part.term[i].coef, term));
		}
		sum = dag_add(dag, sum, dag_mul(dag, mono_ref(dag, leaves, common), inner));
	}
	return sum;
}

/* Nested multiplication in x0, then y0, x1, y1, ... */
Ref horner(Dag *dag, Poly a, int var)
{
	if (a.count == 0)
		return NONE;
	if (var > VAR_Y3)
		return dag_const(dag, a.term[0].coef);
	Ref sum = NONE;
	for (int power = poly_degree(a, var); power >= 0; --power) {
		Poly part = { 0, allocate((size_t)a.count * sizeof(Term)) };
		for (int i = 0; i < a.count; ++i) {
			Mono mono = a.term[i].mono;
			if (mono_power(mono, var) == power)
				part.term[part.count++] = (Term){
					mono - mono_var(var, power), a.term[i].coef
				};
		}
		if (sum != NONE)
			sum = dag_mul(dag, sum, dag_var(dag, var));
		sum = dag_add(dag, sum, horner(dag, part, var + 1));
	}
	return sum;
}

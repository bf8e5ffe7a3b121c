/* residue.c - arithmetic modulo the prime 2^61 - 1, and programs run in it.
 *
 * Rationals become residues, so that programs run exactly however long their constants are. What a
 * program selects it decides by size: each number carries an approximation in fixed point too, good
 * to some 2^-20 for the small coordinates that proofs use. Numbers that are equal modulo the prime
 * are equal; if two others are too close to call, the run gives no verdict (NULL). 1/0 is large, as
 * infinity is: programs clamp what they multiply by it. */
#include "gen.h"

enum { POINT = 36, CLOSE = 17, INFINITE = 24 };  /* fractional bits; of the smallest difference that
                                                  * counts; 1/0 */

Residue residue_add(Residue a, Residue b)
{
	Residue sum = a + b;
	return sum >= PRIME ? sum - PRIME : sum;
}

Residue residue_subtract(Residue a, Residue b)
{
	return residue_add(a, PRIME - b);
}

/* 2^61 is 1 modulo the prime. */
Residue residue_multiply(Residue a, Residue b)
{
	const Wide product = (Wide)a * b;
	return residue_add((Residue)(product & PRIME), (Residue)(product >> 61));
}

Residue residue_power(Residue a, uint64_t exponent)
{
	Residue result = 1;
	for (; exponent; exponent /= 2) {
		if (exponent % 2)
			result = residue_multiply(result, a);
		a = residue_multiply(a, a);
	}
	return result;
}

Residue residue_inverse(Residue a)
{
	return residue_power(a, PRIME - 2);
}

Residue residue_of(Rat a)
{
	Wide size = (Wide)(a.num < 0 ? -a.num : a.num);
	Residue num = (Residue)(size % PRIME), den = (Residue)((Wide)a.den % PRIME);
	Residue value = den == 1 ? num : residue_multiply(num, residue_inverse(den));
	return a.num < 0 ? residue_subtract(0, value) : value;
}

Number number_of(Rat a)
{
	Int size = a.num, den = a.den;
	while (den > (Int)1 << 80) {          /* constants of many digits: an approximation will do */
		den /= 2;
		size /= 2;
	}
	Int whole = size / den, rest = size % den;
	const Int one = (Int)1 << POINT;
	return (Number){ residue_of(a), whole * one + rest * one / den };
}

/* -1, 0, 1; *close is set if it cannot be told. */
static int compare(Number a, Number b, int *close)
{
	const Int gap = a.near - b.near, least = (Int)1 << (POINT - CLOSE);
	if (a.residue == b.residue)
		return 0;
	if (gap < least && gap > -least)
		*close = 1;
	return gap < 0 ? -1 : 1;
}

static Number product(Number a, Number b)
{
	return (Number){ residue_multiply(a.residue, b.residue),
		int_mul(a.near, b.near) / ((Int)1 << POINT) };
}

static Number sum(Number a, Number b)
{
	return (Number){ residue_add(a.residue, b.residue), int_add(a.near, b.near) };
}

static Number negative(Number a)
{
	return (Number){ residue_subtract(0, a.residue), -a.near };
}

static Number quotient(Number a, Number b)
{
	Number inverse = { b.residue ? residue_inverse(b.residue) : PRIME - 1,
		b.near ? ((Int)1 << 2 * POINT) / b.near : (Int)1 << (POINT + INFINITE) };
	return product(a, inverse);
}

static Number operation(const Node *node, const Number *value, int *close)
{
	const Number zero = { 0, 0 };
	Number a = value[node->arg[0]], b = node->arg[1] == NONE ? zero : value[node->arg[1]];
	Number c = node->arg[2] == NONE ? zero : value[node->arg[2]];
	switch (node->op) {
	case OP_ADD: return sum(a, b);
	case OP_SUB: return sum(a, negative(b));
	case OP_ROUND: return a;
	case OP_ABS: return compare(a, zero, close) < 0 ? negative(a) : a;
	case OP_MUL: return product(a, b);
	case OP_DIV: return quotient(a, b);
	case OP_FMA: return sum(product(a, b), c);
	case OP_FMS: return sum(product(a, b), negative(c));
	case OP_MIN: return compare(a, b, close) < 0 ? a : b;
	case OP_MAX: return compare(a, b, close) > 0 ? a : b;
	case OP_CHOOSE: return compare(a, zero, close) > 0 ? b : c;
	}
	bug("a program that is proven modulo a prime has operation %s", op_name(node->op));
}

Number *residue_run(const Program *program, const Number *coordinate)
{
	const Dag *dag = program->dag;
	Number *value = allocate((size_t)dag->count * sizeof *value);
	unsigned char *ready = allocate((size_t)dag->count);
	int close = 0;
	for (int i = 0; i < dag->count; ++i) {
		const Node *node = &dag->node[i];
		ready[i] = op_operands(node->op) == 0;
		if (node->op == OP_CONST)
			value[i] = number_of(node->value);
		for (int var = VAR_X0; var <= VAR_Y3 && node->op == OP_INPUT; ++var)
			if (node->input == mono_var(var, 1))
				value[i] = coordinate[var - VAR_X0];
	}
	for (int at = 0; at < program->count; ++at) {
		Ref ref = program->order[at];
		const Node *node = &dag->node[ref];
		program_check_step(program, at, ready);
		value[ref] = operation(node, value, &close);
		ready[ref] = 1;
	}
	return close ? NULL : value;
}

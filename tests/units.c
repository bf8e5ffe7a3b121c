/* units.c - the value types of the generator against GMP and MPFR.
 *
 * Rationals: the four operations on random operands of up to 60 bits, and the literal of the
 * nearest double and float against MPFR's rounding. Polynomials: sums, products and substitution
 * against evaluation at random rational points. DAG: what dag_reverses must accept and refuse.
 * Overflow must end the program with status 2, never give a wrong digit. */
#include "check.h"

#include <gmp.h>
#include <mpfr.h>
#include <sys/wait.h>

#include "../gen/gen.h"

static Int random_integer(int bits)
{
	Int value = (Int)(random_bits() >> (64 - random_int(1, bits)));
	return random_bits() & 1 ? value : -value;
}

static Rat random_rational(int bits)
{
	Int den = random_integer(bits);
	return rat(random_integer(bits), den ? den : 1);
}

static void set_rational(mpq_t q, Rat a)
{
	char *text = rat_text(a);
	mpq_set_str(q, text, 10);
	mpq_canonicalize(q);
}

static bool same_rational(Rat a, const mpq_t want)
{
	mpq_t q;
	mpq_init(q);
	set_rational(q, a);
	bool same = mpq_equal(q, want) && a.den > 0 && int_gcd(a.num, a.den) == 1;
	mpq_clear(q);
	return same;
}

static void test_rationals(void)
{
	static const struct {
		const char *name;
		Rat (*have)(Rat, Rat);
		void (*want)(mpq_t, const mpq_t, const mpq_t);
	} ops[] = {
		{ "add", rat_add, mpq_add }, { "sub", rat_sub, mpq_sub },
		{ "mul", rat_mul, mpq_mul }, { "div", rat_div, mpq_div },
	};
	mpq_t p, q, want;
	mpq_inits(p, q, want, NULL);
	for (int op = 0; op < LENGTH(ops); ++op) {
		check_begin("rational %s", ops[op].name);
		for (int i = 0; i < 20000; ++i) {
			Mark mark = arena_mark();
			Rat a = random_rational(30), b = random_rational(30);
			if (b.num == 0)
				continue;
			set_rational(p, a);
			set_rational(q, b);
			ops[op].want(want, p, q);
			expect(same_rational(ops[op].have(a, b), want), "%s and %s", rat_text(a),
				rat_text(b));
			arena_release(mark);
		}
		check_end();
	}
	mpq_clears(p, q, want, NULL);
}

static void test_literals(void)
{
	mpfr_t value;
	mpq_t q;
	mpq_init(q);
	for (int is_float = 0; is_float < 2; ++is_float) {
		mpfr_init2(value, is_float ? 24 : 53);
		check_begin("literal of the nearest %s", is_float ? "float" : "double");
		for (int i = 0; i < 50000; ++i) {
			Mark mark = arena_mark();
			Rat a = random_rational(random_int(1, 60));
			set_rational(q, a);
			mpfr_set_q(value, q, MPFR_RNDN);
			char *literal = rat_literal(a, is_float);
			double have = is_float ? (double)strtof(literal, NULL)
				: strtod(literal, NULL);
			expect(mpfr_cmp_d(value, have) == 0, "%s as %s", rat_text(a), literal);
			arena_release(mark);
		}
		check_end();
		mpfr_clear(value);
	}
	mpq_clear(q);
}

static void test_integers(void)
{
	mpz_t want, have;
	mpz_inits(want, have, NULL);
	check_begin("binomials");
	for (int n = 0; n <= 66; ++n)
		for (int k = 0; k <= n; ++k) {
			mpz_bin_uiui(want, (unsigned long)n, (unsigned long)k);
			mpz_set_str(have, int_text(int_binomial(n, k)), 10);
			expect(mpz_cmp(want, have) == 0, "C(%d,%d)", n, k);
		}
	check_end();
	mpz_clears(want, have, NULL);
}

/* Does this end with status 2? */
static bool stops(void (*action)(void))
{
	int status = 0;
	fflush(stdout);
	pid_t child = fork();
	if (child == 0) {
		if (!freopen("/dev/null", "w", stderr))
			_exit(1);
		action();
		_exit(0);
	}
	waitpid(child, &status, 0);
	return WIFEXITED(status) && WEXITSTATUS(status) == EXIT_USAGE;
}

static void square_of_large(void)
{
	Int large = (Int)1 << 100;
	int_mul(large, large);
}

static void sum_of_large(void)
{
	Int large = ((Int)1 << 126) - 1 + ((Int)1 << 126);
	int_add(large, 1);
}

static void sum_of_fractions(void)
{
	rat_add(rat(1, ((Int)1 << 100) - 1), rat(1, ((Int)1 << 100) + 1));
}

static void large_binomial(void)
{
	int_binomial(200, 100);
}

static void test_overflow(void)
{
	check_begin("overflow is refused");
	expect(stops(square_of_large), "2^100 squared");
	expect(stops(sum_of_large), "2^127 - 1 + 1");
	expect(stops(sum_of_fractions), "sum of two large fractions");
	expect(stops(large_binomial), "C(200,100)");
	check_end();
}

/* ---- polynomials ---- */

static Poly random_polynomial(void)
{
	int count = random_int(0, 8);
	Term *term = allocate(8 * sizeof *term);
	for (int i = 0; i < count; ++i) {
		Mono mono = 0;
		for (int var = 0; var < VARS; ++var)
			mono += mono_var(var, random_int(0, 9) ? 0 : random_int(1, 3));
		term[i] = (Term){ mono, random_rational(5) };
	}
	return poly_collect(term, count);
}

static void evaluate(mpq_t sum, Poly a, mpq_t *at)
{
	mpq_t term;
	mpq_init(term);
	mpq_set_ui(sum, 0, 1);
	for (int i = 0; i < a.count; ++i) {
		set_rational(term, a.term[i].coef);
		for (int var = 0; var < VARS; ++var)
			for (int k = mono_power(a.term[i].mono, var); k > 0; --k)
				mpq_mul(term, term, at[var]);
		mpq_add(sum, sum, term);
	}
	mpq_clear(term);
}

static bool is_ordered(Poly a)
{
	for (int i = 0; i < a.count; ++i)
		if (a.term[i].coef.num == 0 || (i && a.term[i - 1].mono <= a.term[i].mono))
			return false;
	return true;
}

static void test_polynomials(void)
{
	mpq_t at[VARS], p, q, want, have;
	mpq_inits(p, q, want, have, NULL);
	for (int var = 0; var < VARS; ++var) {
		mpq_init(at[var]);
		mpq_set_si(at[var], 2 * var - 11, (unsigned long)var % 5 + 1);
		mpq_canonicalize(at[var]);
	}
	check_begin("polynomials against evaluation");
	for (int i = 0; i < 2000; ++i) {
		Mark mark = arena_mark();
		Poly a = random_polynomial(), b = random_polynomial();
		const int vars[] = { VAR_X, VAR_X1 };
		const Poly by[] = { b, poly_add(b, poly_var(VAR_T)) };
		const Poly result[] = { poly_add(a, b), poly_sub(a, b), poly_mul(a, b),
			poly_pow(a, 3), poly_substitute(a, vars, by, 2) };
		evaluate(p, a, at);
		evaluate(q, b, at);
		for (int k = 0; k < LENGTH(result); ++k) {
			if (k == 0)
				mpq_add(want, p, q);
			else if (k == 1)
				mpq_sub(want, p, q);
			else if (k == 2)
				mpq_mul(want, p, q);
			if (k == 3) {
				mpq_mul(want, p, p);
				mpq_mul(want, want, p);
			}
			if (k == 4) {
				mpq_t moved[VARS];
				memcpy(moved, at, sizeof moved);
				mpq_init(moved[VAR_X1]);
				mpq_add(moved[VAR_X1], q, at[VAR_T]);
				memcpy(&moved[VAR_X], &q, sizeof q);
				evaluate(want, a, moved);
				mpq_clear(moved[VAR_X1]);
			}
			evaluate(have, result[k], at);
			expect(mpq_equal(have, want), "operation %d on %s and %s", k,
				poly_text(a, " "), poly_text(b, " "));
			expect(is_ordered(result[k]), "operation %d gives terms out of order", k);
		}
		expect(poly_equal(poly_mul(a, b), poly_mul(b, a)), "the product does not commute");
		arena_release(mark);
	}
	check_end();
	for (int var = 0; var < VARS; ++var)
		mpq_clear(at[var]);
	mpq_clears(p, q, want, have, NULL);
}

/* ---- bits under reversal ---- */

static int reverses(int fused, int same_order)
{
	Dag *dag = dag_new("test");
	Ref x0 = dag_var(dag, VAR_X0), y0 = dag_var(dag, VAR_Y0);
	Ref x1 = dag_var(dag, VAR_X1), y1 = dag_var(dag, VAR_Y1);
	Ref left = dag_mul(dag, x0, y1), right = dag_mul(dag, x1, y0);
	Ref s = fused ? dag_node(dag, OP_FMS, x0, y1, right) : dag_sub(dag, left, right);
	Ref near = dag_scale(dag, rat(3, 1), x0), far = dag_scale(dag, rat(3, 1), x1);
	Ref sum = same_order ? dag_add(dag, dag_add(dag, near, y0), dag_add(dag, far, y0))
		: dag_add(dag, dag_add(dag, near, y0), dag_add(dag, far, y1));
	dag_out(dag, dag_mul(dag, s, sum));
	return dag_reverses(dag);
}

/* The width of an edge times what an operation makes of a, b, or of the width and a, b. */
static int selects(int op, int a, int b)
{
	Dag *dag = dag_new("test");
	Ref start = dag_var(dag, VAR_X0), end = dag_var(dag, VAR_X1);
	Ref run = dag_sub(dag, end, start), left = dag_var(dag, a), right = dag_var(dag, b);
	Ref value = op == OP_CHOOSE ? dag_choose(dag, run, left, right)
		: dag_node(dag, op, left, right, NONE);
	dag_out(dag, dag_mul(dag, run, value));
	return dag_reverses(dag);
}

/* The width rounded to a multiple of a number, and 0. */
static int rounds(int multiple)
{
	Dag *dag = dag_new("test");
	Ref start = dag_var(dag, VAR_X0), end = dag_var(dag, VAR_X1);
	Ref run = dag_sub(dag, end, start), unit = dag_const(dag, rat(multiple, 1));
	dag_out(dag, dag_node(dag, OP_ROUND, run, unit, NONE));
	dag_out(dag, dag_const(dag, rat(0, 1)));
	return dag_reverses(dag);
}

static void test_selections(void)
{
	check_begin("reversal of what selects");
	for (int op = OP_MAX; op <= OP_MIN; ++op) {
		expect(selects(op, VAR_Y0, VAR_Y1), "the %s of both ends is refused", op_name(op));
		expect(!selects(op, VAR_X0, VAR_Y1), "any %s is accepted", op_name(op));
	}
	expect(selects(OP_CHOOSE, VAR_Y0, VAR_Y1), "a choice between both ends is refused");
	expect(!selects(OP_CHOOSE, VAR_Y0, VAR_X1), "any choice is accepted");
	expect(rounds(12), "a rounded width is refused");
	check_end();
}

static void test_reversal(void)
{
	check_begin("reversal is proven bit for bit");
	expect(reverses(0, 0), "a mirrored sum is refused");
	expect(!reverses(1, 0), "a fused cross product is accepted");
	expect(!reverses(0, 1), "a sum that is not mirrored is accepted");
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	test_rationals();
	test_literals();
	test_integers();
	test_overflow();
	test_polynomials();
	test_reversal();
	test_selections();
	return check_finish();
}

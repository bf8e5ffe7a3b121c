/* polynomial.c - sparse polynomials over Q.
 *
 * A monomial is one 128-bit word: a byte of exponent per variable, the first variable on top,
 * and above them the number of an accumulator plus one (accumulators occur linearly only).
 * Multiplying monomials is adding words, and comparing words orders terms. A Poly is
 * an immutable array of terms in strictly descending order without zero coefficients, so equal
 * polynomials are equal arrays. */
#include "gen.h"

#include <stdlib.h>
#include <string.h>

enum { BITS = 8, ACCUMULATOR = BITS * VARS };

const char *var_name(int var)
{
	static const char *const names[VARS] = {
		"x", "y", "x0", "y0", "x1", "y1", "x2", "y2", "x3", "y3", "w", "cx", "s", "t"
	};
	return names[var];
}

static int shift_of(int var)
{
	return BITS * (VARS - 1 - var);
}

Mono mono_var(int var, int power)
{
	return (Mono)(unsigned)power << shift_of(var);
}

Mono mono_accumulator(int index)
{
	return (Mono)(unsigned)(index + 1) << ACCUMULATOR;
}

int mono_power(Mono mono, int var)
{
	return (int)(mono >> shift_of(var)) & ((1 << BITS) - 1);
}

int mono_accumulator_of(Mono mono)
{
	return (int)(mono >> ACCUMULATOR) - 1;
}

Mono mono_gcd(Mono a, Mono b)
{
	Mono gcd = 0;
	for (int var = 0; var < VARS; ++var) {
		int i = mono_power(a, var), j = mono_power(b, var);
		gcd += mono_var(var, i < j ? i : j);
	}
	return gcd;
}

Mono mono_keep(Mono mono, const int *vars, int count)
{
	Mono kept = 0;
	for (int i = 0; i < count; ++i)
		kept += mono_var(vars[i], mono_power(mono, vars[i]));
	return kept;
}

Poly poly_zero(void)
{
	return (Poly){ 0, NULL };
}

Poly poly_mono(Rat coef, Mono mono)
{
	if (coef.num == 0)
		return poly_zero();
	Poly result = { 1, allocate(sizeof(Term)) };
	result.term[0] = (Term){ mono, coef };
	return result;
}

Poly poly_const(Rat value)
{
	return poly_mono(value, 0);
}

Poly poly_var(int var)
{
	return poly_mono(rat(1, 1), mono_var(var, 1));
}

static int descending(const void *left, const void *right)
{
	Mono a = ((const Term *)left)->mono, b = ((const Term *)right)->mono;
	return (a < b) - (a > b);
}

Poly poly_collect(Term *term, int count)
{
	int kept = 0;
	qsort(term, (size_t)count, sizeof *term, descending);
	for (int i = 0; i < count; ++i) {
		if (kept && term[kept - 1].mono == term[i].mono) {
			term[kept - 1].coef = rat_add(term[kept - 1].coef, term[i].coef);
		} else {
			if (kept && term[kept - 1].coef.num == 0)
				--kept;
			term[kept++] = term[i];
		}
	}
	if (kept && term[kept - 1].coef.num == 0)
		--kept;
	return (Poly){ kept, term };
}

/* a + factor b, by merging. */
static Poly merge(Poly a, Rat factor, Poly b)
{
	Poly sum = { 0, allocate((size_t)(a.count + b.count) * sizeof(Term)) };
	for (int i = 0, j = 0; i < a.count || j < b.count; ) {
		Term next;
		if (j == b.count || (i < a.count && a.term[i].mono > b.term[j].mono)) {
			next = a.term[i++];
		} else if (i == a.count || a.term[i].mono < b.term[j].mono) {
			next = (Term){ b.term[j].mono, rat_mul(factor, b.term[j].coef) };
			++j;
		} else {
			next = (Term){ a.term[i].mono,
				rat_add(a.term[i].coef, rat_mul(factor, b.term[j].coef)) };
			++i, ++j;
		}
		if (next.coef.num != 0)
			sum.term[sum.count++] = next;
	}
	return sum;
}

Poly poly_add(Poly a, Poly b)
{
	return merge(a, rat(1, 1), b);
}

Poly poly_sub(Poly a, Poly b)
{
	return merge(a, rat(-1, 1), b);
}

static Mono mono_mul(Mono a, Mono b)
{
	if (a >> ACCUMULATOR && b >> ACCUMULATOR)
		bug("product of two accumulators");
	return a + b;
}

Poly poly_mul(Poly a, Poly b)
{
	Term *term = allocate((size_t)a.count * (size_t)b.count * sizeof(Term));
	int count = 0;
	for (int i = 0; i < a.count; ++i)
		for (int j = 0; j < b.count; ++j)
			term[count++] = (Term){ mono_mul(a.term[i].mono, b.term[j].mono),
				rat_mul(a.term[i].coef, b.term[j].coef) };
	if (a.count == 1 || b.count == 1)
		return (Poly){ count, term };      /* still in order, nothing to merge */
	return poly_collect(term, count);
}

Poly poly_scale(Poly a, Rat factor)
{
	return poly_mul(a, poly_const(factor));
}

Poly poly_pow(Poly a, int power)
{
	Poly result = poly_const(rat(1, 1));
	for (int i = 0; i < power; ++i)
		result = poly_mul(result, a);
	return result;
}

Poly poly_abs(Poly a)
{
	Poly result = { a.count, allocate((size_t)a.count * sizeof(Term)) };
	for (int i = 0; i < a.count; ++i)
		result.term[i] = (Term){ a.term[i].mono, rat_abs(a.term[i].coef) };
	return result;
}

static Poly substitute_term(Term term, const int *vars, const Poly *by, int count)
{
	Poly product = poly_const(term.coef);
	for (int v = 0; v < count; ++v) {
		int power = mono_power(term.mono, vars[v]);
		term.mono -= mono_var(vars[v], power);
		product = poly_mul(product, poly_pow(by[v], power));
	}
	return poly_mul(product, poly_mono(rat(1, 1), term.mono));
}

/* Merges the terms of a raw array. */
static void collect_raw(Text *terms)
{
	if (terms->size)
		terms->size = sizeof(Term) * (size_t)poly_collect((Term *)(void *)terms->data,
			(int)(terms->size / sizeof(Term))).count;
}

/* Intermediate polynomials are freed term by term, and like terms merged now and then:
 * they are many and large. */
Poly poly_substitute(Poly a, const int *vars, const Poly *by, int count)
{
	Text terms = { 0 };
	size_t limit = 1 << 20;
	for (int i = 0; i < a.count; ++i) {
		Mark mark = arena_mark();
		Poly product = substitute_term(a.term[i], vars, by, count);
		if (product.count)
			text_append(&terms, (const char *)product.term,
				(size_t)product.count * sizeof(Term));
		arena_release(mark);
		if (terms.size > limit) {
			collect_raw(&terms);
			limit = 2 * terms.size > limit ? 2 * terms.size : limit;
		}
	}
	collect_raw(&terms);
	Poly result = { (int)(terms.size / sizeof(Term)), allocate(terms.size) };
	if (terms.size)
		memcpy(result.term, terms.data, terms.size);
	text_free(&terms);
	return result;
}

Poly poly_integral(Poly a, int var)
{
	Poly result = { a.count, allocate((size_t)(a.count + 1) * sizeof(Term)) };
	for (int i = 0; i < a.count; ++i) {
		const int power = mono_power(a.term[i].mono, var) + 1;
		result.term[i] = (Term){ a.term[i].mono + mono_var(var, 1),
			rat_div(a.term[i].coef, rat(power, 1)) };
	}
	return result;
}

int poly_equal(Poly a, Poly b)
{
	if (a.count != b.count)
		return 0;
	for (int i = 0; i < a.count; ++i)
		if (a.term[i].mono != b.term[i].mono || a.term[i].coef.num != b.term[i].coef.num
		    || a.term[i].coef.den != b.term[i].coef.den)
			return 0;
	return 1;
}

int poly_degree(Poly a, int var)
{
	int degree = 0;
	for (int i = 0; i < a.count; ++i)
		if (mono_power(a.term[i].mono, var) > degree)
			degree = mono_power(a.term[i].mono, var);
	return degree;
}

Rat poly_content(Poly a)
{
	Int num = 0, den = 1;
	for (int i = 0; i < a.count; ++i) {
		num = int_gcd(num, a.term[i].coef.num);
		den = int_mul(den, a.term[i].coef.den / int_gcd(den, a.term[i].coef.den));
	}
	return rat(num ? num : 1, den);
}

static void mono_text(Text *text, Mono mono, const char *times, int first)
{
	if (mono_accumulator_of(mono) >= 0) {
		text_add(text, "%sa%d", first ? "" : times, mono_accumulator_of(mono));
		first = 0;
	}
	for (int var = 0; var < VARS; ++var) {
		int power = mono_power(mono, var);
		if (!power)
			continue;
		text_add(text, power > 1 ? "%s%s^%d" : "%s%s", first ? "" : times, var_name(var),
			power);
		first = 0;
	}
}

char *poly_text(Poly a, const char *times)
{
	Text text = { 0 };
	text_add(&text, a.count ? "" : "0");
	for (int i = 0; i < a.count; ++i) {
		Rat coef = a.term[i].coef;
		const char *sign = coef.num < 0 ? (i ? " - " : "-") : (i ? " + " : "");
		int unit = rat_is(rat_abs(coef), 1) && a.term[i].mono != 0;
		text_add(&text, "%s%s", sign, unit ? "" : rat_text(rat_abs(coef)));
		mono_text(&text, a.term[i].mono, times, unit);
	}
	return text_take(&text);
}

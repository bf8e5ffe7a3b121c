/* rational.c - exact rationals on checked 128-bit integers.
 *
 * A Rat is always in lowest terms with a positive denominator, so equal values have equal members.
 * Every product and sum is checked: what does not fit stops the program with a clear message,
 * never with a wrong digit. |value| stays below 2^127, so negation is always safe. The nearest
 * double or float (ties to even) is found in integers as well; gen uses no floating point. */
#include "gen.h"

static const Int LIMIT = (Int)(((Wide)1 << 127) - 1);

static void overflow(void)
{
	fatal(EXIT_USAGE, "a number needs more than 128 bits; "
		"ask for a lower degree or simpler constants");
}

static Int magnitude(Int a)
{
	return a < 0 ? -a : a;
}

Int int_mul(Int a, Int b)
{
	if (a == (int64_t)a && b == (int64_t)b)
		return a * b;
	if (a != 0 && magnitude(b) > LIMIT / magnitude(a))
		overflow();
	return a * b;
}

Int int_add(Int a, Int b)
{
	if (b > 0 ? a > LIMIT - b : a < -LIMIT - b)
		overflow();
	return a + b;
}

Int int_gcd(Int a, Int b)
{
	a = magnitude(a);
	b = magnitude(b);
	while (b) {
		Int rest = (a == (int64_t)a && b == (int64_t)b) ? (int64_t)a % (int64_t)b : a % b;
		a = b;
		b = rest;
	}
	return a;
}

Int int_binomial(int n, int k)
{
	Int value = 1;
	for (int i = 1; i <= k; ++i)
		value = int_mul(value, n - k + i) / i;   /* exact: i consecutive integers */
	return value;
}

Rat rat(Int num, Int den)
{
	if (den == 0)
		bug("rational with denominator 0");
	Int gcd = int_gcd(num, den);
	if (den < 0)
		gcd = -gcd;
	return (Rat){ num / gcd, den / gcd };
}

Rat rat_add(Rat a, Rat b)
{
	Int gcd = int_gcd(a.den, b.den);
	Int num = int_add(int_mul(a.num, b.den / gcd), int_mul(b.num, a.den / gcd));
	return rat(num, int_mul(a.den / gcd, b.den));
}

Rat rat_sub(Rat a, Rat b)
{
	return rat_add(a, rat_neg(b));
}

Rat rat_mul(Rat a, Rat b)
{
	Int left = int_gcd(a.num, b.den), right = int_gcd(b.num, a.den);
	return (Rat){ int_mul(a.num / left, b.num / right), int_mul(a.den / right, b.den / left) };
}

Rat rat_div(Rat a, Rat b)
{
	return rat_mul(a, rat(b.den, b.num));
}

Rat rat_neg(Rat a)
{
	return (Rat){ -a.num, a.den };
}

Rat rat_abs(Rat a)
{
	return (Rat){ magnitude(a.num), a.den };
}

int rat_sign(Rat a)
{
	return (a.num > 0) - (a.num < 0);
}

int rat_compare(Rat a, Rat b)
{
	return rat_sign(rat_sub(a, b));
}

int rat_is(Rat a, int value)
{
	return a.num == value && a.den == 1;
}

Int rat_ceil(Rat a)
{
	return a.num / a.den + (a.num > 0 && a.num % a.den != 0);
}

char *int_text(Int a)
{
	char digits[48], *p = digits + sizeof digits;
	Wide rest = (Wide)magnitude(a);
	*--p = 0;
	do
		*--p = (char)('0' + (int)(rest % 10));
	while (rest /= 10);
	return format("%s%s", a < 0 ? "-" : "", p);
}

char *rat_text(Rat a)
{
	return a.den == 1 ? int_text(a.num) : format("%s/%s", int_text(a.num), int_text(a.den));
}

int rat_significant(Rat a)
{
	if (a.den & (a.den - 1))
		return 0;
	Wide num = (Wide)magnitude(a.num);
	int bits = 1;
	while (num && num % 2 == 0)
		num /= 2;
	while (num >>= 1)
		++bits;
	return bits;
}

/* num/den = significand * 2^exponent with exactly `bits` bits, rounded to nearest, ties to even. */
static Int round_to(int bits, Int num, Int den, int *exponent)
{
	Int low = (Int)1 << (bits - 1), high = (Int)1 << bits;
	*exponent = 0;
	while (num / den >= high) {
		if (den > LIMIT / 2)
			overflow();
		den *= 2;
		++*exponent;
	}
	while (num / den < low) {
		if (num > LIMIT / 2) {     /* den is then large and even steps lose nothing */
			if (den % 2)
				overflow();
			den /= 2;
		} else {
			num *= 2;
		}
		--*exponent;
	}
	Int whole = num / den, rest = num % den;
	if (rest > den - rest || (rest == den - rest && whole % 2))
		++whole;
	if (whole == high) {
		whole = low;
		++*exponent;
	}
	return whole;
}

/* 15.0, 0.5, -0.0625: a dyadic rational with few digits, exactly. */
static char *short_decimal(Rat a)
{
	Int rest = magnitude(a.num) % a.den;
	char *text = format("%s%s.", a.num < 0 ? "-" : "", int_text(magnitude(a.num) / a.den));
	do {
		text = format("%s%d", text, (int)(10 * rest / a.den));
		rest = 10 * rest % a.den;
	} while (rest);
	return text;
}

char *rat_literal(Rat a, int is_float)
{
	const char *suffix = is_float ? "f" : "";
	int bits = is_float ? 24 : 53, exponent = 0;
	if (magnitude(a.num) < (Int)1 << 20 && a.den <= 64 && !(a.den & (a.den - 1)))
		return format("%s%s", short_decimal(a), suffix);
	if (a.den == 1 && magnitude(a.num) < (Int)1 << bits)
		return format("%s.0%s", int_text(a.num), suffix);
	Int digits = round_to(bits, magnitude(a.num), a.den, &exponent);
	exponent += bits - 1;
	digits -= (Int)1 << (bits - 1);
	if (is_float)
		digits <<= 1;              /* 23 bits behind the point to 6 hexadecimal digits */
	const char *sign = a.num < 0 ? "-" : "";
	unsigned long long tail = (unsigned long long)digits;
	char *hex = format(is_float ? "%06llx" : "%013llx", tail);
	if (rat_significant(a) && a.den > 1 << 24)     /* not a fraction that anyone would know */
		return format("%s0x1.%sp%d%s", sign, hex, exponent, suffix);
	return format("%s0x1.%sp%d%s /* %s */", sign, hex, exponent, suffix, rat_text(a));
}

/* Fuzzing of ew_path_moments with libFuzzer; tests/fuzz.sh builds and runs it.
 *
 * The bytes of an input choose the precision, the degree, verbs, counts and numbers. Some inputs
 * take the counts from the verbs, which makes them valid, others are off by a few or wild; verbs
 * may be repeated, so that paths get longer than any block of the library. Arrays are allocated
 * exactly to size, so that address sanitizer sees every touch beyond. The result must be what a
 * validator written here from the documentation says; a refused call must leave the output alone;
 * a weight that is no weight must give NaN; and the targets with FMA must agree in every bit.
 *
 * When the bytes run out they are followed by zeros, or by noise if the input says so.
 */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "edgewise.h"

enum { MOST_VERBS = 4096, CANARY = 0x88 };
enum { OUTPUTS = EW_MOMENTS(EW_MAX_CURVE_DEGREE) };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct {
	const uint8_t *next, *end;
	bool noise;
	uint64_t state;
} Bytes;

static uint8_t take(Bytes *b)
{
	if (b->next < b->end)
		return *b->next++;
	b->state = b->state * 0x5851f42d4c957f2du + 0x14057b7ef767814fu;
	return b->noise ? (uint8_t)(b->state >> 56) : 0;
}

static size_t take_wide(Bytes *b)
{
	size_t v = 0;
	for (size_t i = 0; i < sizeof v; i++)
		v = v << 8 | take(b);
	return v;
}

/* Small numbers, every kind of special one, and any bits. */
static double take_number(Bytes *b)
{
	static const double special[] = {
		0, -0.0, 1, -1, 0.5, 3, 1e300, -1e300, 1e-300, 5e-324, 1e38, 1e-45, NAN, INFINITY,
		-INFINITY, -0.99
	};
	const int kind = take(b);
	if (kind < 160)
		return (kind - 80) / 8.0;
	if (kind < 176)
		return special[kind - 160];
	if (kind < 200) {
		const uint64_t bits = take_wide(b);
		double v;
		memcpy(&v, &bits, sizeof v);
		return v;
	}
	return ldexp(take(b) - 128, take(b) % 32 - 20);
}

/* ---- what the call is ---- */

typedef struct {
	bool narrow;            /* float */
	bool everywhere;        /* under every target, or under the best only */
	int degree;
	size_t verbs, points, weights;          /* the counts it gives */
	unsigned char *verb;
	void *point, *weight;   /* NULL if it gives none */
	double *number, *factor;        /* the points and weights that are there, as double */
} Call;

static size_t points_of(unsigned verb)
{
	return verb == EW_CLOSE ? 0
		: verb == EW_CUBIC ? 3
		: verb == EW_QUAD || verb == EW_CONIC ? 2 : 1;
}

/* Is it a path, by the documentation? */
static bool is_path(const Call *c)
{
	size_t points = 0, weights = 0;
	if ((c->verbs && !c->verb) || (c->points && !c->point) || (c->weights && !c->weight))
		return false;
	for (size_t i = 0; i < c->verbs; i++) {
		if (c->verb[i] > EW_CLOSE || (i == 0 && c->verb[i] != EW_MOVE))
			return false;
		points += points_of(c->verb[i]);
		weights += c->verb[i] == EW_CONIC;
	}
	return points == c->points && weights == c->weights;
}

static void fail(const char *why, const Call *c, int result)
{
	fprintf(stderr, "%s: %s, degree %d, %zu verbs, %zu points, %zu weights, result %d\n", why,
		c->narrow ? "float" : "double", c->degree, c->verbs, c->points, c->weights, result);
	abort();
}

static void *exactly(size_t bytes)
{
	void *p = malloc(bytes);
	if (!p && bytes)
		abort();
	return p;
}

static void take_verbs(Call *c, Bytes *b)
{
	static const int repeats[] = { 2, 3, 7, 17, 65, 200, 1100, 4000 };
	const size_t once = take(b) % 64u;
	const unsigned often = take(b);
	const size_t repeat = often < 8 ? (size_t)repeats[often] : 1;
	const bool clean = take(b) % 4;
	c->verbs = once * repeat < MOST_VERBS ? once * repeat : MOST_VERBS;
	c->verb = exactly(c->verbs);
	for (size_t i = 0; i < c->verbs; i++) {
		const uint8_t v = i < once ? take(b) : 0;
		c->verb[i] = i >= once ? c->verb[i - once]
			: clean && i == 0 ? EW_MOVE
			: clean || v < 250 ? v % 6 : v;
	}
}

/* The count that is needed, or nearly, or anything; *there is how much is allocated. */
static size_t take_count(Bytes *b, size_t needed, size_t *there)
{
	const int kind = take(b);
	*there = needed;
	if (kind < 200)
		return needed;
	if (kind == 255)
		return take_wide(b);            /* more than is there: it must not be believed */
	const size_t change = (size_t)kind % 8;
	*there = kind < 228 ? needed + change : needed > change ? needed - change : 0;
	return *there;
}

static void *take_array(Bytes *b, bool narrow, size_t count, double **as_double)
{
	double *numbers = exactly(count * sizeof *numbers);
	float *narrowed = exactly(count * sizeof *narrowed);
	for (size_t i = 0; i < count; i++) {
		numbers[i] = take_number(b);
		narrowed[i] = isfinite(numbers[i]) && fabs(numbers[i]) > 3e38 ? 1
			: (float)numbers[i];
	}
	*as_double = exactly(count * sizeof *numbers);
	for (size_t i = 0; i < count; i++)
		(*as_double)[i] = narrow ? (double)narrowed[i] : numbers[i];
	free(narrow ? (void *)numbers : (void *)narrowed);
	return narrow ? (void *)narrowed : (void *)numbers;
}

static void *drop(void *p)
{
	free(p);
	return NULL;
}

static void take_call(Call *c, Bytes *b)
{
	size_t points = 0, weights = 0, there;
	const int options = take(b), nulls = take(b);
	c->narrow = options % 2;
	b->noise = options / 2 % 2;
	c->everywhere = options / 4 % 4 == 0;
	c->degree = take(b) % (EW_MAX_CURVE_DEGREE + 3) - 1;
	take_verbs(c, b);
	for (size_t i = 0; i < c->verbs; i++) {
		points += points_of(c->verb[i]);
		weights += c->verb[i] == EW_CONIC;
	}
	c->points = take_count(b, points, &there);
	c->point = take_array(b, c->narrow, 2 * there, &c->number);
	c->weights = take_count(b, weights, &there);
	c->weight = take_array(b, c->narrow, there, &c->factor);
	if (nulls == 1 || c->verbs == 0)
		c->verb = drop(c->verb);
	if (nulls == 2 || c->points == 0)
		c->point = drop(c->point);
	if (nulls == 3 || c->weights == 0)
		c->weight = drop(c->weight);
}

/* ---- the call ---- */

static int run(const Call *c, void *out)
{
	return c->narrow ? ew_path_momentsf(c->degree, c->verb, c->verbs, c->point, c->points,
		c->weight, c->weights, out) : ew_path_moments(c->degree, c->verb, c->verbs,
		c->point, c->points, c->weight, c->weights, out);
}

static double output(const Call *c, const void *out, int i)
{
	return c->narrow ? (double)((const float *)out)[i] : ((const double *)out)[i];
}

/* Runs it under one target, and checks all but the numbers. Returns the outputs, or NULL. */
static void *check_call(const Call *c)
{
	const bool degree = c->degree >= 0 && c->degree <= EW_MAX_CURVE_DEGREE, path = is_path(c);
	const size_t bytes = (size_t)(degree ? EW_MOMENTS(c->degree) : OUTPUTS)
		* (c->narrow ? sizeof(float) : sizeof(double));
	unsigned char *out = exactly(bytes);
	memset(out, CANARY, bytes);
	const int result = run(c, out);
	if (degree && path) {
		if (result != EW_OK)
			fail("a path is refused", c, result);
		return out;
	}
	if (result != (degree ? EW_BAD_PATH : EW_BAD_DEGREE) && !(result == EW_BAD_PATH && !path))
		fail("not refused, or for the wrong reason", c, result);
	for (size_t i = 0; i < bytes; i++) {
		if (out[i] != CANARY)
			fail("refused, but written", c, result);
	}
	return drop(out);
}

static void check_weights(const Call *c, const void *out)
{
	for (size_t i = 0; i < c->weights; i++) {
		if (c->factor[i] > -1)
			continue;
		for (int j = 0; j < EW_MOMENTS(c->degree); j++) {
			if (!isnan(output(c, out, j)))
				fail("a number in spite of a bad weight", c, EW_OK);
		}
	}
}

static void check_same(const Call *c, const void *a, const void *b)
{
	const size_t size = c->narrow ? sizeof(float) : sizeof(double);
	for (int i = 0; i < EW_MOMENTS(c->degree); i++) {
		const double v = output(c, a, i), w = output(c, b, i);
		if (!(isnan(v) && isnan(w)) && memcmp((const char *)a + (size_t)i * size,
			(const char *)b + (size_t)i * size, size) != 0)
			fail("other bits by another target", c, EW_OK);
	}
}

static void check_targets(const Call *c)
{
	const unsigned targets = ew_targets();
	void *fused = NULL;
	for (unsigned target = EW_PORTABLE; target; target <<= 1) {
		if (!(targets & target) || (!c->everywhere && targets / target > 1))
			continue;
		if (ew_use_target(target) != EW_OK)
			abort();
		void *out = check_call(c);
		if (!out)
			continue;
		check_weights(c, out);
		if (fused)
			check_same(c, fused, out);
		if (!fused && target != EW_PORTABLE)
			fused = out;
		else
			free(out);
	}
	free(fused);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	Bytes bytes = { data, data + size, false, 1 };
	Call c;
	take_call(&c, &bytes);
	check_targets(&c);
	free(c.verb);
	free(c.point);
	free(c.weight);
	free(c.number);
	free(c.factor);
	return 0;
}

/* The signed area of one edge within a rectangle, exactly, as one fraction of integers.
 *
 * For p -> q, x from xl to xr within the rectangle and y(x) - v0 = Y/D with D = |qx - px|, the area
 * is (xr - xl) / D times the mean of clamp(Y, 0, H D) while Y goes evenly from Yl to Yr. With P
 * the integral of the clamp,
 *
 *     P(Y) = 0 below 0, Y^2/2 up to T = H D, T Y - T^2/2 above,
 *
 * that mean is (P(Yr) - P(Yl)) / (Yr - Yl), or clamp(Yl) when both are the same. All coordinates
 * are made integers by one power of two, and nothing is ever divided.
 */
#include <math.h>

#include "window_reference.h"

enum { PX, PY, QX, QY, U0, U1, V0, V1, NUMBERS };

void window_area_init(WindowArea *area)
{
	for (int i = 0; i < NUMBERS; i++)
		mpz_init(area->number[i]);
	for (int i = 0; i < 6; i++)
		mpz_init(area->work[i]);
	mpz_inits(area->top, area->bottom, NULL);
}

void window_area_clear(WindowArea *area)
{
	for (int i = 0; i < NUMBERS; i++)
		mpz_clear(area->number[i]);
	for (int i = 0; i < 6; i++)
		mpz_clear(area->work[i]);
	mpz_clears(area->top, area->bottom, NULL);
}

/* v = out 2^-shift */
static void set_scaled(mpz_t out, double v, int shift)
{
	int exponent;
	const double fraction = frexp(v, &exponent);
	mpz_set_d(out, ldexp(fraction, 53));
	exponent += shift - 53;
	if (exponent >= 0)
		mpz_mul_2exp(out, out, (mp_bitcnt_t)exponent);
	else
		mpz_tdiv_q_2exp(out, out, (mp_bitcnt_t)-exponent);
}

/* The least shift that makes an integer of v, but 0 or more: 53 bits end 52 below the first. */
static int needed_shift(double v)
{
	const int shift = v == 0 ? 0 : 52 - ilogb(v);
	return shift < 0 ? 0 : shift > 1074 ? 1074 : shift;
}

static void set_clamped(mpz_t out, const mpz_t v, const mpz_t low, const mpz_t high)
{
	mpz_set(out, mpz_cmp(v, low) < 0 ? low : v);
	if (mpz_cmp(out, high) > 0)
		mpz_set(out, high);
}

/* 2 P(Y) */
static void set_integral(mpz_t out, const mpz_t y, const mpz_t most)
{
	if (mpz_sgn(y) <= 0) {
		mpz_set_ui(out, 0);
	} else if (mpz_cmp(y, most) <= 0) {
		mpz_mul(out, y, y);
	} else {
		mpz_mul_2exp(out, y, 1);
		mpz_sub(out, out, most);
		mpz_mul(out, out, most);
	}
}

/* out = D (y(x) - v0), from the vertex a */
static void set_height(mpz_t out, const mpz_t x, mpz_t *a, const mpz_t dx, const mpz_t dy,
	const mpz_t v0)
{
	mpz_sub(out, x, a[0]);
	mpz_mul(out, out, dy);
	mpz_submul(out, v0, dx);
	mpz_addmul(out, a[1], dx);
}

void window_area(WindowArea *area, const double edge[4], const double rectangle[4])
{
	mpz_t *const c = area->number, *const w = area->work;
	area->shift = 0;
	for (int i = 0; i < NUMBERS; i++) {
		const int shift = needed_shift(i < 4 ? edge[i] : rectangle[i - 4]);
		area->shift = shift > area->shift ? shift : area->shift;
	}
	for (int i = 0; i < NUMBERS; i++)
		set_scaled(c[i], i < 4 ? edge[i] : rectangle[i - 4], area->shift);
	const bool back = mpz_cmp(c[PX], c[QX]) > 0;
	mpz_t *const a = back ? c + QX : c + PX, *const b = back ? c + PX : c + QX;
	mpz_sub(w[0], b[0], a[0]);                      /* D */
	mpz_set_ui(area->top, 0);
	mpz_set_ui(area->bottom, 1);
	set_clamped(w[2], c[U0], a[0], b[0]);           /* xl */
	set_clamped(w[3], c[U1], a[0], b[0]);           /* xr */
	if (mpz_cmp(w[2], w[3]) >= 0 || mpz_cmp(c[V0], c[V1]) >= 0)
		return;
	mpz_sub(w[1], b[1], a[1]);
	set_height(w[4], w[2], a, w[0], w[1], c[V0]);   /* Yl */
	set_height(w[5], w[3], a, w[0], w[1], c[V0]);   /* Yr */
	mpz_sub(area->bottom, w[3], w[2]);              /* xr - xl */
	mpz_sub(w[1], c[V1], c[V0]);
	mpz_mul(w[1], w[1], w[0]);                      /* T */
	if (mpz_cmp(w[4], w[5]) == 0) {
		mpz_set_ui(w[3], 0);
		set_clamped(area->top, w[4], w[3], w[1]);
		mpz_mul(area->top, area->top, area->bottom);
		mpz_set(area->bottom, w[0]);
	} else {
		set_integral(w[2], w[5], w[1]);
		set_integral(w[3], w[4], w[1]);
		mpz_sub(area->top, w[2], w[3]);
		mpz_mul(area->top, area->top, area->bottom);
		mpz_sub(w[5], w[5], w[4]);
		mpz_mul(area->bottom, w[5], w[0]);
		mpz_mul_2exp(area->bottom, area->bottom, 1);
	}
	if (!back)
		mpz_neg(area->top, area->top);
}

/* top / bottom / 2^shift as a double, infinite if it does not fit */
static double quotient(const mpz_t top, const mpz_t bottom, long shift)
{
	long top_exponent, bottom_exponent;
	const double t = mpz_get_d_2exp(&top_exponent, top);
	const double b = mpz_get_d_2exp(&bottom_exponent, bottom);
	long exponent = top_exponent - bottom_exponent - shift;
	exponent = exponent > 3000 ? 3000 : exponent < -3000 ? -3000 : exponent;
	return ldexp(t / b, (int)exponent);
}

double window_area_value(WindowArea *area)
{
	return quotient(area->top, area->bottom, 2L * area->shift);
}

double window_area_error(WindowArea *area, double computed)
{
	if (!isfinite(computed))
		return HUGE_VAL;
	const int finest = needed_shift(computed);
	set_scaled(area->work[0], computed, finest);
	mpz_mul(area->work[0], area->work[0], area->bottom);
	mpz_mul_2exp(area->work[0], area->work[0], (mp_bitcnt_t)(2 * area->shift));
	mpz_mul_2exp(area->work[1], area->top, (mp_bitcnt_t)finest);
	mpz_sub(area->work[1], area->work[1], area->work[0]);
	return fabs(quotient(area->work[1], area->bottom, 2L * area->shift + finest));
}

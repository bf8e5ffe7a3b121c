/* green.c - integrand and edge to an exact polynomial; the only file that knows Green's theorem.
 *
 * For a monomial, div((x,y) x^m y^n) = (m+n+2) x^m y^n, hence over any closed boundary
 *
 *     integral of x^m y^n dA =
 *             1/(m+n+2) * sum over edges of  integral of x^m y^n (x dy - y dx)      (form 3)
 *
 * A line edge is x = s x0 + t x1, y = s y0 + t y1 with s = 1 - t, so that
 * x dy - y dx = (x0 y1 - x1 y0) dt, and every power product of s and t integrates to
 * int_0^1 s^a t^b dt = 1 / ((a+b+1) C(a+b, b)). Keeping s and t as separate variables keeps every
 * coefficient positive and small. Form 3 is used for every integrand, so that edges of different
 * kinds may be mixed in one boundary. */
#include "gen.h"

/* x0 y1 - x1 y0 */
static Poly chord_cross(void)
{
	Poly left = poly_mul(poly_var(VAR_X0), poly_var(VAR_Y1));
	Poly right = poly_mul(poly_var(VAR_X1), poly_var(VAR_Y0));
	return poly_sub(left, right);
}

/* Integral over 0..1 of a polynomial in s and t. */
static Poly integrate(Poly a)
{
	Term *term = allocate((size_t)a.count * sizeof(Term));
	for (int i = 0; i < a.count; ++i) {
		int p = mono_power(a.term[i].mono, VAR_S), q = mono_power(a.term[i].mono, VAR_T);
		Mono rest = a.term[i].mono - mono_var(VAR_S, p) - mono_var(VAR_T, q);
		Rat beta = rat(1, int_mul(p + q + 1, int_binomial(p + q, q)));
		term[i] = (Term){ rest, rat_mul(a.term[i].coef, beta) };
	}
	return poly_collect(term, a.count);
}

/* C(p, i) s^(p-i) t^i: Bernstein polynomials. */
static Poly bernstein(int p, int i)
{
	Poly value = poly_mul(poly_pow(poly_var(VAR_S), p - i), poly_pow(poly_var(VAR_T), i));
	return poly_scale(value, rat(int_binomial(p, i), 1));
}

/* A coordinate of the curve, `slope` times differentiated by t. */
static Poly on_curve(int points, int first, int slope)
{
	Poly sum = poly_zero();
	const int p = points - 1 - slope;
	for (int i = 0; i <= p; ++i) {
		Poly value = poly_var(first + 2 * i);
		if (slope)
			value = poly_scale(poly_sub(poly_var(first + 2 * i + 2), value),
				rat(points - 1, 1));
		sum = poly_add(sum, poly_mul(value, bernstein(p, i)));
	}
	return sum;
}

/* The integrand at a point of the edge, each term x^m y^n over m + n + 2. */
static Poly along_edge(Poly integrand, Poly x, Poly y)
{
	static const int xy[] = { VAR_X, VAR_Y };
	const Poly point[] = { x, y };
	Term *term = allocate((size_t)integrand.count * sizeof(Term));
	for (int i = 0; i < integrand.count; ++i) {
		Mono mono = integrand.term[i].mono;
		int degree = mono_power(mono, VAR_X) + mono_power(mono, VAR_Y);
		term[i] = (Term){ mono, rat_div(integrand.term[i].coef, rat(degree + 2, 1)) };
	}
	return poly_substitute((Poly){ integrand.count, term }, xy, point, 2);
}

/* 1/(m+n+2) int x^m y^n dt along the line, for every term of the integrand. */
static Poly line_density(Poly integrand)
{
	Poly x = on_curve(2, VAR_X0, 0), y = on_curve(2, VAR_Y0, 0);
	return integrate(along_edge(integrand, x, y));
}

Integral green_line(Poly integrand)
{
	Integral integral;
	integral.density = line_density(integrand);
	integral.value = poly_mul(chord_cross(), integral.density);
	integral.magnitude = poly_mul(poly_abs(chord_cross()), line_density(poly_abs(integrand)));
	return integral;
}

Poly green_curve(int points, Poly integrand)
{
	Poly x = on_curve(points, VAR_X0, 0), y = on_curve(points, VAR_Y0, 0);
	Poly dx = on_curve(points, VAR_X0, 1), dy = on_curve(points, VAR_Y0, 1);
	Poly turn = poly_sub(poly_mul(x, dy), poly_mul(y, dx));
	return integrate(poly_mul(along_edge(integrand, x, y), turn));
}

/* section.c - the output of `section --exact` against closed forms.
 *
 *     section FILE [rotated] <OUTPUT
 *
 * FILE is read again, as decimals; all sides in it are parallel to the axes. Its moments are those
 * of the polygon of its corners, and for each rounded corner those of the piece between the corner
 * and the arc: with s and t the distances from the two sides, in units of r to the power,
 *
 *     int 1 = 1 - pi/4    int s = 5/6 - pi/4    int s^2 = 1 - 5 pi/16    int s t = 19/24 - pi/4,
 *
 * lost where the boundary turns left and gained where it turns right. No conic, path or formula of
 * the library is in that; it is evaluated to 300 bits. If OUTPUT is of FILE rotated by the angle
 * with cosine 4/5 and sine 3/5, the moments are rotated here. u = 2^-53. */
#include "curves.h"

enum { M00, M10, M01, M20, M11, M02, MOMENT_COUNT };
enum { AREA, CX, CY, IX, IY, IXY, RX, RY, WX, WY, IU, IV, ANGLE, RU, RV, WU, WV, IP, PROPERTIES };
enum { BITS = 300, MOST = 200, STEPS = 4096 };

static const char *const names[PROPERTIES] = { "A", "cx", "cy", "Ix", "Iy", "Ixy", "ix", "iy", "Wx",
	"Wy", "Iu", "Iv", "angle", "iu", "iv", "Wu", "Wv", "Ip" };
static const int powers[PROPERTIES] = { 2, 1, 1, 4, 4, 4, 1, 1, 3, 3, 4, 4, 0, 1, 1, 3, 3, 4 };
static const double U = 0x1p-53;
static const double SLACK = 1.0001; /* the bounds are rounded themselves */

/* ---- what is printed ---- */

typedef struct {
	FILE *stream;
	char line[400];
} Input;

static Input file, output;

static struct {
	char name[60];
	double origin[2], moments[MOMENT_COUNT], values[PROPERTIES];
	Curve edges[MOST];
	int edge_count;
} got;

static void malformed(const char *expected)
{
	printf("not ok input: expected %s; the lines are '%.60s' and '%.60s'\n"
		"0 passed, 1 failed\n", expected, file.line, output.line);
	exit(1);
}

static bool next_line(Input *in)
{
	do {
		if (!fgets(in->line, sizeof in->line, in->stream))
			in->line[0] = '\0';
	} while (in->line[0] == '#');
	in->line[strcspn(in->line, "\n")] = '\0';
	return in->line[0] != '\0';
}

static bool starts_with(const Input *in, const char *word)
{
	return strncmp(in->line, word, strlen(word)) == 0;
}

static void take(const char *word, double *out, int count)
{
	char *end, *text = output.line + strlen(word);
	if (!starts_with(&output, word) || *text != ' ')
		malformed(word);
	for (int i = 0; i < count; i++, text = end) {
		out[i] = strtod(text, &end);
		if (end == text || !isfinite(out[i]))
			malformed("finite numbers");
	}
	next_line(&output);
}

static void add_edge(int kind, const double *points, double at[2])
{
	Curve *c = &got.edges[got.edge_count++];
	const int count = curve_points(kind);
	if (got.edge_count == MOST)
		malformed("fewer edges");
	*c = (Curve){ .kind = kind, .x = { at[0] }, .y = { at[1] }, .w = points[4] };
	for (int i = 1; i < count; i++) {
		c->x[i] = points[2 * i - 2];
		c->y[i] = points[2 * i - 1];
	}
	at[0] = c->x[count - 1];
	at[1] = c->y[count - 1];
}

static bool read_section(void)
{
	double p[5] = { 0 }, at[2] = { 0 };
	if (!starts_with(&output, "shape "))
		return false;
	got.edge_count = 0;
	snprintf(got.name, sizeof got.name, "%.50s", output.line + 6);
	next_line(&output);
	take("origin", got.origin, 2);
	while (!starts_with(&output, "moments")) {
		if (starts_with(&output, "move")) {
			take("move", at, 2);
		} else if (starts_with(&output, "line")) {
			take("line", p, 2);
			add_edge(CURVE_LINE, p, at);
		} else {
			take("conic", p, 5);
			add_edge(CURVE_CONIC, p, at);
		}
	}
	take("moments", got.moments, MOMENT_COUNT);
	for (int i = 0; i < PROPERTIES; i++)
		take(names[i], &got.values[i], 1);
	return true;
}

/* ---- closed form ---- */

typedef struct {
	mpfr_t x, y, radius;
} Corner;

static Corner corners[MOST];
static mpfr_t exact[MOMENT_COUNT], spandrel[MOMENT_COUNT], pi, ta, tb, tc, td;
static double farthest, perimeter, largest_radius;
static char table[400];

/* Adds factor int x^m y^n over the triangle (0,0), p, q: cross(p,q)/2 times the mean, which for
 * degree 2 is that of the middles of the sides. */
static void add_triangle(const Corner *p, const Corner *q)
{
	mpfr_mul(ta, p->x, q->y, MPFR_RNDN);
	mpfr_mul(tb, p->y, q->x, MPFR_RNDN);
	mpfr_sub(ta, ta, tb, MPFR_RNDN);
	mpfr_div_ui(ta, ta, 2, MPFR_RNDN);
	mpfr_add(exact[M00], exact[M00], ta, MPFR_RNDN);
	mpfr_add(tb, p->x, q->x, MPFR_RNDN);
	mpfr_add(tc, p->y, q->y, MPFR_RNDN);
	for (int i = 0; i < 2; i++) {
		mpfr_mul(td, ta, i ? tc : tb, MPFR_RNDN);
		mpfr_div_ui(td, td, 3, MPFR_RNDN);
		mpfr_add(exact[M10 + i], exact[M10 + i], td, MPFR_RNDN);
	}
	mpfr_t sum;
	mpfr_init2(sum, BITS);
	for (int i = 0; i < 3; i++) {           /* (p p + q q + (p+q)(p+q))/12 */
		mpfr_mul(sum, i < 2 ? tb : tc, i > 0 ? tc : tb, MPFR_RNDN);
		mpfr_mul(td, i < 2 ? p->x : p->y, i > 0 ? p->y : p->x, MPFR_RNDN);
		mpfr_add(sum, sum, td, MPFR_RNDN);
		mpfr_mul(td, i < 2 ? q->x : q->y, i > 0 ? q->y : q->x, MPFR_RNDN);
		mpfr_add(sum, sum, td, MPFR_RNDN);
		mpfr_mul(sum, sum, ta, MPFR_RNDN);
		mpfr_div_ui(sum, sum, 12, MPFR_RNDN);
		mpfr_add(exact[M20 + i], exact[M20 + i], sum, MPFR_RNDN);
	}
	mpfr_clear(sum);
}

/* out = p - q pi, times r^power */
static void set_spandrel(mpfr_t out, long p, unsigned long of_p, long q, unsigned long of_q,
	const mpfr_t r, unsigned long power)
{
	mpfr_mul_si(out, pi, -q, MPFR_RNDN);
	mpfr_div_ui(out, out, of_q, MPFR_RNDN);
	mpfr_set_si(tb, p, MPFR_RNDN);
	mpfr_div_ui(tb, tb, of_p, MPFR_RNDN);
	mpfr_add(out, out, tb, MPFR_RNDN);
	mpfr_pow_ui(tb, r, power, MPFR_RNDN);
	mpfr_mul(out, out, tb, MPFR_RNDN);
}

/* exact += sign times value, which is spent. */
static void add_signed(mpfr_t out, mpfr_t value, int sign)
{
	mpfr_mul_si(value, value, sign, MPFR_RNDN);
	mpfr_add(out, out, value, MPFR_RNDN);
}

/* The direction of the side from p to q, which is parallel to an axis. */
static void side(const Corner *p, const Corner *q, int out[2])
{
	out[0] = mpfr_cmp(q->x, p->x);
	out[1] = mpfr_cmp(q->y, p->y);
	out[0] = (out[0] > 0) - (out[0] < 0);
	out[1] = (out[1] > 0) - (out[1] < 0);
	if (abs(out[0]) + abs(out[1]) != 1)
		malformed("sides parallel to the axes");
}

/* x = vx + ex z and y = vy + ey w, where z is s if the side before the corner is horizontal and t
 * otherwise, and w the other: all integrals of s are those of t. */
static void add_spandrel(const Corner *before, const Corner *v, const Corner *after)
{
	int in[2], out[2];
	side(before, v, in);
	side(v, after, out);
	const int sign = -(in[0] * out[1] - in[1] * out[0]);
	const int ex = out[0] - in[0], ey = out[1] - in[1];
	set_spandrel(spandrel[M00], 1, 1, 1, 4, v->radius, 2);
	set_spandrel(spandrel[M10], 5, 6, 1, 4, v->radius, 3);
	set_spandrel(spandrel[M20], 1, 1, 5, 16, v->radius, 4);
	set_spandrel(spandrel[M11], 19, 24, 1, 4, v->radius, 4);
	const mpfr_t *at[2] = { &v->x, &v->y };
	const int e[2] = { ex, ey };
	for (int i = 0; i < 2; i++) {
		mpfr_mul(ta, *at[i], spandrel[M00], MPFR_RNDN);
		mpfr_mul_si(tb, spandrel[M10], e[i], MPFR_RNDN);
		mpfr_add(ta, ta, tb, MPFR_RNDN);                   /* int of the coordinate */
		mpfr_add(tc, ta, tb, MPFR_RNDN);                   /* v (v A + 2 e S) + SS */
		mpfr_mul(tc, tc, *at[i], MPFR_RNDN);
		mpfr_add(tc, tc, spandrel[M20], MPFR_RNDN);
		add_signed(exact[M10 + i], ta, sign);
		add_signed(exact[i ? M02 : M20], tc, sign);
	}
	mpfr_mul(ta, v->x, v->y, MPFR_RNDN);
	mpfr_mul(ta, ta, spandrel[M00], MPFR_RNDN);
	mpfr_mul_si(tb, v->x, ey, MPFR_RNDN);
	mpfr_mul_si(tc, v->y, ex, MPFR_RNDN);
	mpfr_add(tb, tb, tc, MPFR_RNDN);
	mpfr_mul(tb, tb, spandrel[M10], MPFR_RNDN);
	mpfr_add(ta, ta, tb, MPFR_RNDN);
	mpfr_mul_si(tb, spandrel[M11], ex * ey, MPFR_RNDN);
	mpfr_add(ta, ta, tb, MPFR_RNDN);
	add_signed(exact[M11], ta, sign);
	add_signed(exact[M00], spandrel[M00], sign);
}

static void add_ring(int count)
{
	for (int i = 0; i < count; i++) {
		const Corner *v = &corners[i], *after = &corners[(i + 1) % count];
		add_triangle(v, after);
		if (!mpfr_zero_p(v->radius))
			add_spandrel(&corners[(i + count - 1) % count], v, after);
		const double x = mpfr_get_d(v->x, MPFR_RNDN), y = mpfr_get_d(v->y, MPFR_RNDN);
		farthest = fmax(farthest, hypot(x, y));
		largest_radius = fmax(largest_radius, mpfr_get_d(v->radius, MPFR_RNDN));
		perimeter += hypot(mpfr_get_d(after->x, MPFR_RNDN) - x,
			mpfr_get_d(after->y, MPFR_RNDN) - y);
	}
}

/* The next shape of the file. */
static bool read_shape(void)
{
	int count = 0;
	char *text;
	if (!starts_with(&file, "shape "))
		return false;
	table[0] = '\0';
	farthest = perimeter = largest_radius = 0;
	for (int i = 0; i < MOMENT_COUNT; i++)
		mpfr_set_ui(exact[i], 0, MPFR_RNDN);
	for (bool more = next_line(&file); ; more = next_line(&file)) {
		const bool word = file.line[0] >= 'a' && file.line[0] <= 'z';
		if (!more || word) {
			add_ring(count);
			count = 0;
			if (!more || starts_with(&file, "shape "))
				return true;
			if (starts_with(&file, "table "))
				strcpy(table, file.line + 6);
			continue;
		}
		Corner *v = &corners[count++];
		if (count == MOST)
			malformed("fewer corners");
		mpfr_strtofr(v->x, file.line, &text, 10, MPFR_RNDN);
		mpfr_strtofr(v->y, text, &text, 10, MPFR_RNDN);
		mpfr_strtofr(v->radius, text, &text, 10, MPFR_RNDN);
	}
}

/* x' = (4 x - 3 y)/5, y' = (3 x + 4 y)/5 */
static void rotate(void)
{
	mpfr_t old[MOMENT_COUNT];
	for (int i = 0; i < MOMENT_COUNT; i++) {
		mpfr_init2(old[i], BITS);
		mpfr_set(old[i], exact[i], MPFR_RNDN);
	}
	static const int from[MOMENT_COUNT][3][2] = {
		[M10] = { { M10, 4 }, { M01, -3 } },
		[M01] = { { M10, 3 }, { M01, 4 } },
		[M20] = { { M20, 16 }, { M11, -24 }, { M02, 9 } },
		[M11] = { { M20, 12 }, { M11, 7 }, { M02, -12 } },
		[M02] = { { M20, 9 }, { M11, 24 }, { M02, 16 } },
	};
	for (int i = M10; i < MOMENT_COUNT; i++) {
		mpfr_set_ui(exact[i], 0, MPFR_RNDN);
		for (int k = 0; k < 3; k++) {
			mpfr_mul_si(ta, old[from[i][k][0]], from[i][k][1], MPFR_RNDN);
			mpfr_add(exact[i], exact[i], ta, MPFR_RNDN);
		}
		mpfr_div_ui(exact[i], exact[i], i < M20 ? 5 : 25, MPFR_RNDN);
	}
	for (int i = 0; i < MOMENT_COUNT; i++)
		mpfr_clear(old[i]);
}

/* Moments about the printed origin. */
static void move_to_origin(void)
{
	const double *o = got.origin;
	for (int i = M20; i < MOMENT_COUNT; i++) {   /* M_xy - x0 M_y - y0 M_x + x0 y0 A */
		const int p = i > M11, q = i > M20;
		mpfr_mul_d(ta, exact[M10 + q], o[p], MPFR_RNDN);
		mpfr_mul_d(tb, exact[M10 + p], o[q], MPFR_RNDN);
		mpfr_add(ta, ta, tb, MPFR_RNDN);
		mpfr_sub(exact[i], exact[i], ta, MPFR_RNDN);
		mpfr_mul_d(ta, exact[M00], o[p], MPFR_RNDN);
		mpfr_mul_d(ta, ta, o[q], MPFR_RNDN);
		mpfr_add(exact[i], exact[i], ta, MPFR_RNDN);
	}
	for (int i = 0; i < 2; i++) {
		mpfr_mul_d(ta, exact[M00], o[i], MPFR_RNDN);
		mpfr_sub(exact[M10 + i], exact[M10 + i], ta, MPFR_RNDN);
	}
}

/* ---- checks ---- */

/* The moments within the bound of ew_path_moments: gamma_K of the weights of all edges, K the k of
 * the kind, its repetitions in one of 8 lanes, and what adds up lanes and kinds. */
static void check_path(Ref *want)
{
	long items[CURVE_KINDS] = { 0 }, most = 0;
	for (int i = 0; i < got.edge_count; i++) {
		curve_add(want, 2, &got.edges[i]);
		items[got.edges[i].kind]++;
	}
	for (int kind = CURVE_LINE; kind < CURVE_KINDS; kind++) {
		const Row *row = curve_row(kind, 2);
		const long k = items[kind] ? row->k + row->r * ((items[kind] - 1) / 8) : 0;
		most = k > most ? k : most;
	}
	check_begin("%s: moments of the path", got.name);
	for (int i = 0; i < MOMENT_COUNT; i++)
		expect_within(got.moments[i], &want[i], most + 3 + CURVE_KINDS, 53, 0, "moment %d",
			i);
	check_end();
}

/* The exact moments of the printed path beside those of the section. Corners are off by u times
 * themselves for the decimals and for the move, together e = u (F + R), F and R the farthest before
 * and after. So are the directions of sides by 2 sqrt(2) e / side + 4 u; an arc begins on the side,
 * at a tangent that is off by twice the sum of both and 12 u, relatively, and its weight by half of
 * it and 3 u. All in all points of the boundary are off by less than d = 128 u (F + R). That moves
 * moments by at most what the boundary sweeps, its length times d, times the largest integrand. */
static void check_closed_form(const Ref *want)
{
	double reach = 0, most = 1;
	for (int i = 0; i < got.edge_count; i++)
		reach = fmax(reach, hypot(got.edges[i].x[0], got.edges[i].y[0]));
	reach += 2 * largest_radius;
	const double off = 128 * U * (farthest + reach);
	check_begin("%s: closed form", got.name);
	for (int i = 0; i < MOMENT_COUNT; i++) {
		most = i == M10 || i == M20 ? most * reach : most;
		mpfr_set_q(ta, want[i].value, MPFR_RNDN);
		mpfr_sub(ta, ta, exact[i], MPFR_RNDN);
		const double error = fabs(mpfr_get_d(ta, MPFR_RNDN));
		expect(error <= SLACK * most * perimeter * off, "moment %d is %.17g, not %.17g: off "
			"by %g, allowed %g", i, mpq_get_d(want[i].value),
			mpfr_get_d(exact[i], MPFR_RNDN), error, SLACK * most * perimeter * off);
	}
	check_end();
}

static void near(int which, long double want, double bound)
{
	const double off = (double)fabsl(got.values[which] - want);
	expect(off <= bound, "%s is %.17g, not %.17Lg: off by %g, allowed %g", names[which],
		got.values[which], want, off, bound);
}

/* The outline's largest distance from the axis, by many points of it: the largest is too small by
 * at most the height of an arc between two, h^2/(8 r), r the length of its tangents here. */
static void check_reach(int which, double moment, double angle)
{
	const double nx = -sin(angle), ny = cos(angle), e = moment / got.values[which];
	double most = 0, gap = 0, size = 0;
	for (int i = 0; i < got.edge_count; i++) {
		const Curve *p = &got.edges[i];
		double last[2] = { p->x[0], p->y[0] };
		for (int s = 0; s <= STEPS; s++) {
			const double t = (double)s / STEPS;
			const double w[3] = { (1 - t) * (1 - t), 2 * t * (1 - t) * p->w, t * t };
			const double sum = w[0] + w[1] + w[2];
			const double x = p->kind == CURVE_LINE ? (s ? p->x[1] : p->x[0])
				: (w[0] * p->x[0] + w[1] * p->x[1] + w[2] * p->x[2]) / sum;
			const double y = p->kind == CURVE_LINE ? (s ? p->y[1] : p->y[0])
				: (w[0] * p->y[0] + w[1] * p->y[1] + w[2] * p->y[2]) / sum;
			const double h = hypot(x - last[0], y - last[1]);
			if (p->kind == CURVE_CONIC)
				gap = fmax(gap, h * h / (8 * hypot(p->x[1] - p->x[0],
					p->y[1] - p->y[0])));
			most = fmax(most, fabs(nx * x + ny * y));
			size = fmax(size, hypot(x, y));
			last[0] = x;
			last[1] = y;
		}
	}
	const double rounding = 128 * U * size;
	expect(e >= most - rounding && e <= most + 2 * gap + rounding, "%s means a distance of "
		"%.17g, not of %.17g and %g at most", names[which], e, most, gap);
}

/* From the printed moments; each operation rounds once, hypot twice. The angle t has the direction
 * of (Ix - Iy, -2 Ixy) at 2 t, but for atan2, cosine and sine: 64 u. */
static void check_properties(void)
{
	const double *m = got.moments, *v = got.values;
	const long double area = m[M00], ix = m[M02], iy = m[M20], ixy = m[M11];
	const long double mean = (ix + iy) / 2, spread = hypotl((ix - iy) / 2, ixy);
	const double angle = v[ANGLE] * acos(-1) / 180;
	check_begin("%s: properties", got.name);
	near(AREA, area, 0);
	near(CX, got.origin[0] + m[M10] / area, 2 * U * fabs(v[CX]));
	near(CY, got.origin[1] + m[M01] / area, 2 * U * fabs(v[CY]));
	near(IX, ix, 0);
	near(IY, iy, 0);
	near(IXY, ixy, 0);
	near(IU, mean + spread, (double)(8 * U * (mean + spread)));
	near(IV, mean - spread, (double)(8 * U * (mean + spread)));
	near(IP, ix + iy, (double)(2 * U * (ix + iy)));
	near(RX, sqrtl(ix / area), 3 * U * v[RX]);
	near(RY, sqrtl(iy / area), 3 * U * v[RY]);
	near(RU, sqrtl(v[IU] / area), 3 * U * v[RU]);
	near(RV, sqrtl(v[IV] / area), 3 * U * v[RV]);
	const double c = cos(2 * angle), s = sin(2 * angle), size = (double)(2 * spread);
	const double dx = (double)(ix - iy), dy = (double)(-2 * ixy);
	expect(spread <= 1e-12L * mean ? v[ANGLE] == 0 : fabs(dx * s - dy * c) <= 64 * U * size
		&& dx * c + dy * s > 0, "the angle is %.17g, of (%g, %g)", v[ANGLE], dx, dy);
	check_reach(WX, v[IX], 0);
	check_reach(WY, v[IY], acos(-1) / 2);
	check_reach(WU, v[IU], angle);
	check_reach(WV, v[IV], angle + acos(-1) / 2);
	check_end();
}

/* What a table prints is right to half of its last digit: the closed form rounds to it. */
static void check_table(void)
{
	check_begin("%s: table", got.name);
	for (char *name = strtok(table, " "); name; name = strtok(NULL, " ")) {
		const char *text = strtok(NULL, " "), *point = text ? strchr(text, '.') : NULL;
		int which = 0;
		while (which < PROPERTIES && strcmp(name, names[which]) != 0)
			which++;
		if (!expect(text && which < PROPERTIES, "'%s' is no property", name))
			break;
		const char *exponent = strchr(text, 'e');
		const int digits = point ? (int)strspn(point + 1, "0123456789") : 0;
		const double unit = pow(10, (exponent ? atoi(exponent + 1) : 0) - digits);
		const double value = got.values[which] / pow(10, powers[which]);
		expect(fabs(value - atof(text)) <= 0.5 * unit, "%s is %g, the table says %s", name,
			value, text);
	}
	check_end();
}

static void check_section(bool rotated)
{
	Ref *want = ref_new(MOMENT_COUNT);
	if (rotated)
		rotate();
	move_to_origin();
	check_path(want);
	check_closed_form(want);
	check_properties();
	if (table[0] && !rotated)
		check_table();
	ref_free(want, MOMENT_COUNT);
}

static void every_number(void (*action)(mpfr_ptr))
{
	mpfr_ptr const work[] = { pi, ta, tb, tc, td };
	for (int i = 0; i < 5; i++)
		action(work[i]);
	for (int i = 0; i < MOMENT_COUNT; i++) {
		action(exact[i]);
		action(spandrel[i]);
	}
	for (int i = 0; i < MOST; i++) {
		action(corners[i].x);
		action(corners[i].y);
		action(corners[i].radius);
	}
}

static void begin_number(mpfr_ptr number)
{
	mpfr_init2(number, BITS);
}

int main(int argc, char **argv)
{
	check_start(1, argv);
	output.stream = stdin;
	file.stream = argc > 1 ? fopen(argv[1], "r") : NULL;
	if (!file.stream || !next_line(&file) || !next_line(&output))
		malformed("a file of sections and their properties");
	every_number(begin_number);
	mpfr_const_pi(pi, MPFR_RNDN);
	while (read_shape()) {
		if (!read_section())
			malformed("as many sections as in the file");
		check_section(argc > 2);
	}
	every_number(mpfr_clear);
	fclose(file.stream);
	return check_finish();
}

/* Exact integrals of piecewise polynomials over polygons.
 *
 * With G(x,y) = INT_0^y f(x,s) ds the integral of f over a region is - INT G dx around it. Along an
 * edge x and y are linear in t, G is a polynomial in t by Horner's rule in y and in x, and is
 * integrated term by term. Everything happens about the centre of the filter.
 *
 * B-splines come from the convolution with a box, k(x) -> K(x + 1/2) - K(x - 1/2) with K the
 * integral of k from the left, and the cubic filters from the family of Mitchell and Netravali, so
 * that no coefficient is written twice.
 */
#include <math.h>
#include <stdlib.h>

#include "window_reference.h"

static void *allocate(size_t bytes)
{
	void *p = calloc(1, bytes ? bytes : 1);
	if (!p)
		abort();
	return p;
}

static void set_text(mpq_t out, const char *text)
{
	if (mpq_set_str(out, text, 10))
		abort();
	mpq_canonicalize(out);
}

static void set_fraction(mpq_t out, long top, long bottom)
{
	mpq_set_si(out, top, (unsigned long)bottom);
	mpq_canonicalize(out);
}

/* ---- Polynomials of one variable, a[0] + a[1] t + ... ---- */

enum { LONGEST = 2 * WINDOW_POWERS + 1 };

typedef struct {
	int degree;
	mpq_t a[LONGEST];
} Line;

static void line_init(Line *p)
{
	p->degree = 0;
	for (int i = 0; i < LONGEST; i++)
		mpq_init(p->a[i]);
}

static void line_clear(Line *p)
{
	for (int i = 0; i < LONGEST; i++)
		mpq_clear(p->a[i]);
}

/* p *= b + d t */
static void line_times(Line *p, const mpq_t b, const mpq_t d, mpq_t work)
{
	for (int i = ++p->degree; i >= 0; i--) {
		mpq_mul(p->a[i], p->a[i], b);
		if (i > 0) {
			mpq_mul(work, p->a[i - 1], d);
			mpq_add(p->a[i], p->a[i], work);
		}
	}
}

static void line_set(Line *p, const mpq_t constant)
{
	for (int i = 1; i <= p->degree; i++)
		mpq_set_ui(p->a[i], 0, 1);
	p->degree = 0;
	mpq_set(p->a[0], constant);
}

static void line_add(Line *p, const Line *q)
{
	for (int i = 0; i <= q->degree; i++)
		mpq_add(p->a[i], p->a[i], q->a[i]);
	if (p->degree < q->degree)
		p->degree = q->degree;
}

/* ---- Filters ---- */

static void piece_init(WindowPiece *piece)
{
	mpq_inits(piece->x0, piece->x1, piece->y0, piece->y1, NULL);
	for (int i = 0; i < WINDOW_POWERS * WINDOW_POWERS; i++)
		mpq_init(piece->c[i / WINDOW_POWERS][i % WINDOW_POWERS]);
}

static void piece_degrees(WindowPiece *piece)
{
	for (int a = 0; a < WINDOW_POWERS; a++) {
		for (int b = 0; b < WINDOW_POWERS; b++) {
			if (mpq_sgn(piece->c[a][b]) && piece->degree_x < a)
				piece->degree_x = a;
			if (mpq_sgn(piece->c[a][b]) && piece->degree_y < b)
				piece->degree_y = b;
		}
	}
}

static WindowFilter *filter_new(int count)
{
	WindowFilter *filter = allocate(sizeof *filter);
	filter->count = count;
	filter->pieces = allocate((size_t)count * sizeof *filter->pieces);
	for (int i = 0; i < count; i++)
		piece_init(&filter->pieces[i]);
	return filter;
}

void window_free(WindowFilter *filter)
{
	for (int i = 0; i < filter->count; i++) {
		WindowPiece *piece = &filter->pieces[i];
		mpq_clears(piece->x0, piece->x1, piece->y0, piece->y1, NULL);
		for (int j = 0; j < WINDOW_POWERS * WINDOW_POWERS; j++)
			mpq_clear(piece->c[j / WINDOW_POWERS][j % WINDOW_POWERS]);
	}
	free(filter->pieces);
	free(filter);
}

WindowFilter *window_rectangle(double u0, double u1, double v0, double v1)
{
	WindowFilter *filter = filter_new(1);
	WindowPiece *piece = filter->pieces;
	mpq_set_d(piece->x0, u0);
	mpq_set_d(piece->x1, u1);
	mpq_set_d(piece->y0, v0);
	mpq_set_d(piece->y1, v1);
	mpq_set_ui(piece->c[0][0], 1, 1);
	return filter;
}

/* One axis of a separable filter: pieces from knot to knot. */
typedef struct {
	mpq_t from, to, c[WINDOW_POWERS];
} Part;

static Part *parts_new(int count)
{
	Part *parts = allocate((size_t)count * sizeof *parts);
	for (int i = 0; i < count; i++) {
		mpq_inits(parts[i].from, parts[i].to, NULL);
		for (int k = 0; k < WINDOW_POWERS; k++)
			mpq_init(parts[i].c[k]);
	}
	return parts;
}

static void parts_free(Part *parts, int count)
{
	for (int i = 0; i < count; i++) {
		mpq_clears(parts[i].from, parts[i].to, NULL);
		for (int k = 0; k < WINDOW_POWERS; k++)
			mpq_clear(parts[i].c[k]);
	}
	free(parts);
}

/* out(x) = in(-x) */
static void part_mirror(Part *out, const Part *in)
{
	mpq_neg(out->from, in->to);
	mpq_neg(out->to, in->from);
	for (int k = 0; k < WINDOW_POWERS; k++) {
		mpq_set(out->c[k], in->c[k]);
		if (k % 2)
			mpq_neg(out->c[k], out->c[k]);
	}
}

static WindowFilter *filter_of_parts(Part *parts, int count)
{
	WindowFilter *filter = filter_new(count * count);
	for (int i = 0; i < count * count; i++) {
		WindowPiece *piece = &filter->pieces[i];
		const Part *p = &parts[i / count], *q = &parts[i % count];
		mpq_set(piece->x0, p->from);
		mpq_set(piece->x1, p->to);
		mpq_set(piece->y0, q->from);
		mpq_set(piece->y1, q->to);
		for (int a = 0; a < WINDOW_POWERS; a++) {
			for (int b = 0; b < WINDOW_POWERS; b++)
				mpq_mul(piece->c[a][b], p->c[a], q->c[b]);
		}
		piece_degrees(piece);
	}
	parts_free(parts, count);
	return filter;
}

WindowFilter *window_separable(const WindowAxis *axis, int count, bool even)
{
	const int all = even ? 2 * count : count;
	Part *parts = parts_new(all);
	for (int i = 0; i < count; i++) {
		set_text(parts[i].from, axis[i].from);
		set_text(parts[i].to, axis[i].to);
		for (int k = 0; k < WINDOW_POWERS && axis[i].c[k]; k++)
			set_text(parts[i].c[k], axis[i].c[k]);
		if (even)
			part_mirror(&parts[count + i], &parts[i]);
	}
	return filter_of_parts(parts, all);
}

WindowFilter *window_bivariate(const WindowPatch *patches, int count)
{
	WindowFilter *filter = filter_new(count);
	for (int i = 0; i < count; i++) {
		WindowPiece *piece = &filter->pieces[i];
		set_text(piece->x0, patches[i].x0);
		set_text(piece->x1, patches[i].x1);
		set_text(piece->y0, patches[i].y0);
		set_text(piece->y1, patches[i].y1);
		for (const WindowTerm *t = patches[i].terms; t->c; t++)
			set_text(piece->c[t->a][t->b], t->c);
		piece_degrees(piece);
	}
	return filter;
}

/* out += sign INT of the part from its first knot to x + shift, as a polynomial in x */
static void add_integral(Part *out, Part *in, const mpq_t shift, int sign)
{
	Line sum;
	mpq_t work, factor, start;
	mpq_inits(work, factor, start, NULL);
	line_init(&sum);
	for (int k = WINDOW_POWERS - 1; k >= 0; k--) {  /* of sum c[k]/(k+1) z^(k+1) at both ends */
		set_fraction(factor, 1, k + 1);
		mpq_mul(factor, factor, in->c[k]);
		mpq_add(start, start, factor);
		mpq_mul(start, start, in->from);
		mpq_add(sum.a[0], sum.a[0], factor);
		mpq_set_ui(factor, 1, 1);
		line_times(&sum, shift, factor, work);
	}
	mpq_sub(sum.a[0], sum.a[0], start);
	mpq_set_si(factor, sign, 1);
	for (int k = 0; k < WINDOW_POWERS; k++) {
		mpq_mul(work, sum.a[k], factor);
		mpq_add(out->c[k], out->c[k], work);
	}
	line_clear(&sum);
	mpq_clears(work, factor, start, NULL);
}

/* out += the integral of the part */
static void add_whole(mpq_t out, Part *part)
{
	mpq_t zero, sum;
	Part *integral = parts_new(1);
	mpq_inits(zero, sum, NULL);
	add_integral(integral, part, zero, 1);
	for (int k = WINDOW_POWERS - 1; k >= 0; k--) {
		mpq_mul(sum, sum, part->to);
		mpq_add(sum, sum, integral->c[k]);
	}
	mpq_add(out, out, sum);
	mpq_clears(zero, sum, NULL);
	parts_free(integral, 1);
}

/* parts with knots one apart -> one part more, the convolution with a box */
static Part *convolve(Part *in, int count)
{
	Part *out = parts_new(count + 1);
	mpq_t half, minus;
	mpq_inits(half, minus, NULL);
	set_fraction(half, 1, 2);
	set_fraction(minus, -1, 2);
	for (int i = 0; i <= count; i++) {
		Part *to = &out[i];
		mpq_add(to->from, i < count ? in[i].from : in[i - 1].to, minus);
		mpq_add(to->to, i < count ? in[i].from : in[i - 1].to, half);
		if (i < count)                          /* what the box has begun to see, */
			add_integral(to, &in[i], half, 1);
		if (i > 0) {                            /* less what it has left */
			add_whole(to->c[0], &in[i - 1]);
			add_integral(to, &in[i - 1], minus, -1);
		}
	}
	mpq_clears(half, minus, NULL);
	parts_free(in, count);
	return out;
}

WindowFilter *window_bspline(int degree)
{
	Part *parts = parts_new(1);
	set_fraction(parts->from, -1, 2);
	set_fraction(parts->to, 1, 2);
	mpq_set_ui(parts->c[0], 1, 1);
	for (int count = 1; count <= degree; count++)
		parts = convolve(parts, count);
	return filter_of_parts(parts, degree + 1);
}

WindowFilter *window_cubic(int b, int c)
{
	/* over 18, with B = b/3 and C = c/6; the halves 0..1 and 1..2 */
	const long inner[4] = { 18 - 2 * b, 0, -54 + 12 * b + 3 * c, 36 - 9 * b - 3 * c };
	const long outer[4] = {
		8 * b + 12 * c, -12 * b - 24 * c, 6 * b + 15 * c, -b - 3 * c
	};
	Part *parts = parts_new(4);
	for (int i = 0; i < 2; i++) {
		set_fraction(parts[i].from, i, 1);
		set_fraction(parts[i].to, i + 1, 1);
		for (int k = 0; k < 4; k++)
			set_fraction(parts[i].c[k], i ? outer[k] : inner[k], 18);
		part_mirror(&parts[i + 2], &parts[i]);
	}
	return filter_of_parts(parts, 4);
}

static double binomial(int n, int k)
{
	double value = 1;
	for (int i = 1; i <= k; i++)
		value = value * (n - k + i) / i;
	return value;
}

/* INT |coefficients| over the piece, about its corner */
static double piece_weight(WindowPiece *p)
{
	const double x0 = mpq_get_d(p->x0), dx = mpq_get_d(p->x1) - x0;
	const double y0 = mpq_get_d(p->y0), dy = mpq_get_d(p->y1) - y0;
	double weight = 0;
	for (int i = 0; i <= p->degree_x; i++) {
		for (int j = 0; j <= p->degree_y; j++) {
			double c = 0;           /* of (x - x0)^i (y - y0)^j */
			for (int a = i; a <= p->degree_x; a++) {
				for (int b = j; b <= p->degree_y; b++)
					c += mpq_get_d(p->c[a][b]) * binomial(a, i)
						* binomial(b, j) * pow(x0, a - i)
						* pow(y0, b - j);
			}
			weight += fabs(c) * pow(dx, i + 1) * pow(dy, j + 1);
		}
	}
	return weight;
}

double window_weight(const WindowFilter *filter)
{
	double weight = 0;
	for (int i = 0; i < filter->count; i++)
		weight += piece_weight(&filter->pieces[i]);
	return weight;
}

double window_value(const WindowFilter *filter, double x, double y)
{
	double sum = 0;
	for (int i = 0; i < filter->count; i++) {
		const WindowPiece *p = &filter->pieces[i];
		double value = 0;
		const double x0 = mpq_get_d(p->x0), x1 = mpq_get_d(p->x1);
		const double y0 = mpq_get_d(p->y0), y1 = mpq_get_d(p->y1);
		if (x < x0 || x > x1 || y < y0 || y > y1)
			continue;
		for (int a = 0; a <= p->degree_x; a++) {
			for (int b = 0; b <= p->degree_y; b++)
				value += mpq_get_d(p->c[a][b]) * pow(x, a) * pow(y, b);
		}
		sum += value * (x == x0 || x == x1 ? 0.5 : 1) * (y == y0 || y == y1 ? 0.5 : 1);
	}
	return sum;
}

/* ---- Rings, clipped ---- */

typedef struct {
	size_t n, room;
	mpq_t *at[2];              /* x and y */
} Ring;

static void ring_push(Ring *ring, const mpq_t x, const mpq_t y)
{
	if (ring->n == ring->room) {
		const size_t more = 2 * ring->room + 8;
		for (int axis = 0; axis < 2; axis++) {
			ring->at[axis] = realloc(ring->at[axis], more * sizeof(mpq_t));
			if (!ring->at[axis])
				abort();
			for (size_t i = ring->room; i < more; i++)
				mpq_init(ring->at[axis][i]);
		}
		ring->room = more;
	}
	mpq_set(ring->at[0][ring->n], x);
	mpq_set(ring->at[1][ring->n++], y);
}

static void ring_clear(Ring *ring)
{
	for (int axis = 0; axis < 2; axis++) {
		for (size_t i = 0; i < ring->room; i++)
			mpq_clear(ring->at[axis][i]);
		free(ring->at[axis]);
	}
}

/* out: the ring's part where side (coordinate - limit) >= 0 */
static void clip(Ring *out, const Ring *in, int axis, const mpq_t limit, int side)
{
	mpq_t *const c = in->at[axis], *const other = in->at[!axis];
	mpq_t t, span, cut;
	mpq_inits(t, span, cut, NULL);
	out->n = 0;
	for (size_t i = 0; i < in->n; i++) {
		const size_t j = i + 1 < in->n ? i + 1 : 0;
		const int here = side * mpq_cmp(c[i], limit), there = side * mpq_cmp(c[j], limit);
		if (here >= 0)
			ring_push(out, in->at[0][i], in->at[1][i]);
		if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
			mpq_sub(span, c[j], c[i]);
			mpq_sub(t, limit, c[i]);
			mpq_div(t, t, span);
			mpq_sub(span, other[j], other[i]);
			mpq_mul(t, t, span);
			mpq_add(cut, t, other[i]);
			ring_push(out, axis ? cut : limit, axis ? limit : cut);
		}
	}
	mpq_clears(t, span, cut, NULL);
}

typedef struct {
	Line row, sum;
	mpq_t dx, dy, work;
} Work;

static void work_init(Work *w)
{
	line_init(&w->row);
	line_init(&w->sum);
	mpq_inits(w->dx, w->dy, w->work, NULL);
}

static void work_clear(Work *w)
{
	line_clear(&w->row);
	line_clear(&w->sum);
	mpq_clears(w->dx, w->dy, w->work, NULL);
}

/* total -= INT G dx from vertex i to vertex j */
static void add_edge(mpq_t total, const WindowPiece *piece, const Ring *ring, size_t i, size_t j,
	Work *w)
{
	mpq_t *const x = ring->at[0], *const y = ring->at[1];
	mpq_sub(w->dx, x[j], x[i]);
	mpq_sub(w->dy, y[j], y[i]);
	if (mpq_sgn(w->dx) == 0)
		return;
	mpq_set_ui(w->work, 0, 1);
	line_set(&w->sum, w->work);
	for (int b = piece->degree_y; b >= 0; b--) {
		line_set(&w->row, piece->c[piece->degree_x][b]);
		for (int a = piece->degree_x - 1; a >= 0; a--) {
			line_times(&w->row, x[i], w->dx, w->work);
			mpq_add(w->row.a[0], w->row.a[0], piece->c[a][b]);
		}
		set_fraction(w->work, 1, b + 1);
		for (int k = 0; k <= w->row.degree; k++)
			mpq_mul(w->row.a[k], w->row.a[k], w->work);
		line_add(&w->sum, &w->row);
		line_times(&w->sum, y[i], w->dy, w->work);
	}
	for (int k = 0; k <= w->sum.degree; k++) {
		set_fraction(w->work, 1, k + 1);
		mpq_mul(w->work, w->work, w->sum.a[k]);
		mpq_mul(w->work, w->work, w->dx);
		mpq_sub(total, total, w->work);
	}
}

static void add_piece(mpq_t total, const WindowPiece *piece, const Ring *ring, Ring spare[2],
	Work *w)
{
	clip(&spare[0], ring, 0, piece->x0, 1);
	clip(&spare[1], &spare[0], 0, piece->x1, -1);
	clip(&spare[0], &spare[1], 1, piece->y0, 1);
	clip(&spare[1], &spare[0], 1, piece->y1, -1);
	for (size_t i = 0; i < spare[1].n; i++)
		add_edge(total, piece, &spare[1], i, i + 1 < spare[1].n ? i + 1 : 0, w);
}

static void integrate(mpq_t out, const WindowFilter *filter, const Ring *ring)
{
	Ring spare[2] = { { 0 } };
	Work w;
	work_init(&w);
	mpq_set_ui(out, 0, 1);
	for (int i = 0; i < filter->count; i++)
		add_piece(out, &filter->pieces[i], ring, spare, &w);
	ring_clear(&spare[0]);
	ring_clear(&spare[1]);
	work_clear(&w);
}

static void push_local(Ring *ring, double x, double y, double cx, double cy, mpq_t work[3])
{
	mpq_set_d(work[0], x);
	mpq_set_d(work[2], cx);
	mpq_sub(work[0], work[0], work[2]);
	mpq_set_d(work[1], y);
	mpq_set_d(work[2], cy);
	mpq_sub(work[1], work[1], work[2]);
	ring_push(ring, work[0], work[1]);
}

void window_ring(mpq_t out, const WindowFilter *filter, const double *x, const double *y,
	size_t n, double cx, double cy)
{
	Ring ring = { 0 };
	mpq_t work[3];
	mpq_inits(work[0], work[1], work[2], NULL);
	for (size_t i = 0; i < n; i++)
		push_local(&ring, x[i], y[i], cx, cy, work);
	integrate(out, filter, &ring);
	mpq_clears(work[0], work[1], work[2], NULL);
	ring_clear(&ring);
}

void window_edge(mpq_t out, const WindowFilter *filter, const double edge[4], double cx,
	double cy)
{
	Ring ring = { 0 };
	mpq_t work[3], floor;
	mpq_inits(work[0], work[1], work[2], floor, NULL);
	push_local(&ring, edge[0], edge[1], cx, cy, work);
	push_local(&ring, edge[2], edge[3], cx, cy, work);
	mpq_set(floor, ring.at[1][0]);
	if (mpq_cmp(ring.at[1][1], floor) < 0)
		mpq_set(floor, ring.at[1][1]);
	for (int i = 0; i < filter->count; i++) {
		if (mpq_cmp(filter->pieces[i].y0, floor) < 0)
			mpq_set(floor, filter->pieces[i].y0);
	}
	for (size_t i = 2; i-- > 0;) {
		mpq_set(work[0], ring.at[0][i]);
		ring_push(&ring, work[0], floor);
	}
	integrate(out, filter, &ring);
	mpq_clears(work[0], work[1], work[2], floor, NULL);
	ring_clear(&ring);
}

double window_error(double computed, const mpq_t exact)
{
	mpq_t error;
	if (!isfinite(computed))
		return HUGE_VAL;
	mpq_init(error);
	mpq_set_d(error, computed);
	mpq_sub(error, error, exact);
	const double value = fabs(mpq_get_d(error));
	mpq_clear(error);
	return value;
}

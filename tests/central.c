/* Centroids, central moments and translation, against exact rationals.
 *
 * The ring functions work about the first vertex, so their errors are those of the ring that starts
 * at the origin, however far away it lies. On coordinates of a common grid that subtraction is
 * exact, and with A, M the exact moments about the first vertex, W their weights, g = gamma_K:
 *
 *     centroid:  |error| <= (g W_m + |c| g W_0) / (|A| - g W_0) + 4u |c| + u |result|
 *     central:   |error| <= gamma_(K+T) max(D(|c| + delta), W') + D(|c| + delta) - D(|c|)
 *
 * where D_mn(v) = sum C(m,a) C(n,b) v_x^(m-a) v_y^(n-b) W_ab bounds what translation by v can make
 * of the weights, W' are the weights about the centroid, delta is the error of the centroid, and
 * T = 4 degree + 24. That leaves room for either way to the result: translating the moments, or
 * summing a second time about the centroid.
 *
 * ew_translate_moments itself is held against the binomial sum, term by term.
 */
#include "rings.h"

enum { TRIES = 150 };

typedef struct {
	Ring ring;
	Ref *moments;           /* about the first vertex */
	Ref *central;           /* exact central moments */
	Ref *about;             /* weights about the nearest double to the centroid */
	double area, c[2];      /* of the ring about its first vertex */
	double exact[2];        /* centroid, nearest double */
	mpq_t mean[2];          /* centroid */
} Local;

/* |got - want|, rounded once; infinite if got is */
static double error_of(double got, const mpq_t want)
{
	if (!isfinite(got))
		return HUGE_VAL;
	mpq_t error;
	mpq_init(error);
	mpq_set_d(error, got);
	mpq_sub(error, error, want);
	const double size = fabs(mpq_get_d(error));
	mpq_clear(error);
	return size;
}

/* Fills in all but the ring, whose differences from the first vertex are exact. */
static void local_compute(Local *l)
{
	const Ring *ring = &l->ring;
	double *x = allocate(ring->n * sizeof *x), *y = allocate(ring->n * sizeof *y);
	mpq_t back[2];
	for (size_t i = 0; i < ring->n; i++) {
		x[i] = ring->x[i] - ring->x[0];
		y[i] = ring->y[i] - ring->y[0];
	}
	l->moments = ref_new(MOMENTS);
	l->central = ref_new(MOMENTS);
	ref_ring(l->moments, EW_MAX_DEGREE, x, y, ring->n);
	l->area = mpq_get_d(l->moments[0].value);
	for (int i = 0; i < 2; i++) {
		mpq_inits(l->mean[i], back[i], NULL);
		mpq_div(l->mean[i], l->moments[1 + i].value, l->moments[0].value);
		mpq_neg(back[i], l->mean[i]);
		l->c[i] = mpq_get_d(l->mean[i]);
	}
	ref_translate(l->central, EW_MAX_DEGREE, l->moments, back[0], back[1]);
	for (size_t i = 0; i < ring->n; i++) {
		x[i] -= l->c[0];
		y[i] -= l->c[1];
	}
	l->about = ref_new(MOMENTS);
	ref_ring(l->about, EW_MAX_DEGREE, x, y, ring->n);
	for (int i = 0; i < 2; i++) {
		mpq_set_d(back[i], i ? ring->y[0] : ring->x[0]);
		mpq_add(l->mean[i], l->mean[i], back[i]);
		l->exact[i] = mpq_get_d(l->mean[i]);
		mpq_clear(back[i]);
	}
	free(x);
	free(y);
}

static void local_free(Local *l)
{
	ring_free(&l->ring);
	ref_free(l->moments, MOMENTS);
	ref_free(l->central, MOMENTS);
	ref_free(l->about, MOMENTS);
	mpq_clears(l->mean[0], l->mean[1], NULL);
}

/* Roundings of the moments of this degree, and of the area, about the first vertex. */
static long local_k(const Api *api, int degree, size_t n)
{
	const long area = ring_k(api, find_row("moments", 0, 0), n);
	const long first = ring_k(api, find_row("moments", 1, 0), n);
	const long last = ring_k(api, find_row("moments", degree, 0), n);
	return last > first ? (last > area ? last : area) : (first > area ? first : area);
}

/* How far the computed centroid may be off, before it is moved back to the first vertex. */
static double centroid_error(const Api *api, const Local *l, int axis, long k)
{
	const double u = ldexp(1, -api->bits), g = gamma_of(k, api->bits);
	const double w0 = mpq_get_d(l->moments[0].weight);
	const double w1 = mpq_get_d(l->moments[1 + axis].weight);
	const double c = fabs(l->c[axis]);
	const double sums = (g * w1 + c * g * w0) / (fabs(l->area) - g * w0);
	return 1.000001 * (sums + 4 * u * (c + sums));
}

/* The area is at least 16 times what rounding can make of it. */
static bool well_defined(const Api *api, const Local *l, long k)
{
	return fabs(l->area) > 16 * gamma_of(k, api->bits) * mpq_get_d(l->moments[0].weight);
}

/* Random rings on a grid: random or star, near or far, of any size. */
static void local_random(Local *l, const Api *api, int i)
{
	const double size = ldexp(1, api->bits == 24 ? random_int(-5, 5) : random_int(-60, 60));
	const double away = i % 4 < 2 ? 1 : api->bits == 24 ? 100 : 0x1p25;
	const size_t n = (size_t)random_int(3, 40);
	l->ring = ring_new(n);
	if (i % 2)
		ring_star_near(&l->ring, away, 1);
	for (size_t j = 0; i % 2 == 0 && j < n; j++) {
		l->ring.x[j] = away + random_real(-1, 1);
		l->ring.y[j] = away + random_real(-1, 1);
	}
	ring_snap(&l->ring, api->bits == 24 ? 0x1p-15 : 0x1p-26);
	for (size_t j = 0; j < n; j++) {
		l->ring.x[j] *= size;
		l->ring.y[j] *= size;
	}
	ring_pack(api, &l->ring);
}

static void expect_centroid(const Api *api, const Local *l, const void *c, long k)
{
	const double u = ldexp(1, -api->bits);
	for (int axis = 0; axis < 2; axis++) {
		const double bound = centroid_error(api, l, axis, k)
			+ 1.01 * u * fabs(l->exact[axis]);
		const double error = error_of(get(api, c, axis), l->mean[axis]);
		expect(error <= bound,
			"n = %zu: centroid[%d] = %.17g, exact %.17g, off by %g, allowed %g",
			l->ring.n, axis, get(api, c, axis), l->exact[axis], error, bound);
	}
}

static void test_centroid(const Api *api, const char *target)
{
	double c[2];
	check_begin("ew_centroid, %s, %s", api->name, target);
	for (int i = 0; i < TRIES; i++) {
		Local l;
		local_random(&l, api, i);
		local_compute(&l);
		const long k = local_k(api, 1, l.ring.n);
		if (well_defined(api, &l, k)) {
			expect(api->centroid(l.ring.px, l.ring.py, l.ring.n, c) == EW_OK,
				"no EW_OK");
			expect_centroid(api, &l, c, k);
		}
		local_free(&l);
	}
	check_end();
}

static double binomial(int n, int k)
{
	double b = 1;
	for (int i = 1; i <= k; i++)
		b = b * (n - i + 1) / i;
	return b;
}

/* D_mn(vx,vy) */
static double moved_weight(const Local *l, int m, int n, double vx, double vy)
{
	double sum = 0;
	for (int a = 0; a <= m; a++) {
		for (int b = 0; b <= n; b++)
			sum += binomial(m, a) * binomial(n, b) * pow(vx, m - a) * pow(vy, n - b)
				* mpq_get_d(l->moments[ref_index(a, b)].weight);
	}
	return sum;
}

static void expect_central(const Api *api, const Local *l, int degree, const void *out, long k)
{
	const double cx = fabs(l->c[0]), cy = fabs(l->c[1]);
	const double dx = centroid_error(api, l, 0, k), dy = centroid_error(api, l, 1, k);
	const double g = gamma_of(k + 4 * degree + 24, api->bits);
	for (int m = 0; m <= degree; m++) {
		for (int n = 0; m + n <= degree; n++) {
			const double far = moved_weight(l, m, n, cx + dx, cy + dy);
			const double about = 1.001 * mpq_get_d(l->about[ref_index(m, n)].weight);
			if (api->bits == 24 && fmax(far, about) * largest_sum(m + n) > FLT_MAX)
				continue;        /* the terms may overflow, as the header says */
			const double bound = g * fmax(far, about)
				+ (far - moved_weight(l, m, n, cx, cy))
				+ ref_tiny(k, m + n, api->bits, l->ring.x, l->ring.y, l->ring.n);
			const Ref *want = &l->central[ref_index(m, n)];
			const double got = get(api, out, ref_index(m, n));
			const double error = error_of(got, want->value);
			expect(error <= bound,
				"n = %zu: central x%dy%d of degree %d = %.17g, exact %.17g, "
				"off by %g, allowed %g",
				l->ring.n, m, n, degree, got, mpq_get_d(want->value), error, bound);
			expect(m + n != 1 || got == 0, "first central moment is %g", got);
		}
	}
}

static void test_central(const Api *api, const char *target)
{
	double c[2], out[MOMENTS];
	check_begin("ew_central_moments, %s, %s", api->name, target);
	for (int i = 0; i < TRIES; i++) {
		Local l;
		local_random(&l, api, i);
		local_compute(&l);
		for (int d = 0; d <= EW_MAX_DEGREE; d++) {
			const long k = local_k(api, d, l.ring.n);
			if (!well_defined(api, &l, k))
				continue;
			expect(api->central(d, l.ring.px, l.ring.py, l.ring.n, c, out) == EW_OK,
				"no EW_OK");
			expect_centroid(api, &l, c, k);
			expect_central(api, &l, d, out, k);
		}
		local_free(&l);
	}
	check_end();
}

/* Polygons of size 10 in projected map coordinates, where raw moments are worth nothing. */
static void expect_far(const Local *l, const Ref *area)
{
	const Ring *ring = &l->ring;
	double c[2], out[EW_MOMENTS(2)];
	const double wrong = error_of(ew_area(ring->px, ring->py, ring->n), area->value);
	expect(wrong <= 1e-15 * fabs(l->area), "area is off by %g of it", wrong / fabs(l->area));
	expect(ew_centroid(ring->px, ring->py, ring->n, c) == EW_OK, "no EW_OK from centroid");
	expect(ew_central_moments(2, ring->px, ring->py, ring->n, c, out) == EW_OK, "no EW_OK");
	for (int axis = 0; axis < 2; axis++) {
		const double ulp = nextafter(l->exact[axis], HUGE_VAL) - l->exact[axis];
		const double error = error_of(c[axis], l->mean[axis]);
		expect(error <= ulp, "centroid[%d] is off by %g ulp", axis, error / ulp);
	}
	const double spread = mpq_get_d(l->central[3].value) + mpq_get_d(l->central[5].value);
	for (int i = 3; i < 6; i++) {
		const double size = i == 4 ? spread / 2 : mpq_get_d(l->central[i].value);
		const double error = error_of(out[i], l->central[i].value);
		expect(error <= 1e-13 * fabs(size), "central moment %d is off by %g of it", i,
			error / fabs(size));
	}
}

static void test_far(const Api *api, const char *target)
{
	if (api->bits == 24)
		return;
	Ref *area = ref_new(1);
	check_begin("far from the origin, %s", target);
	for (int i = 0; i < 10 * TRIES; i++) {
		Local l;
		l.ring = ring_new((size_t)random_int(3, 30));
		ring_star(&l.ring, 5e5, 4e6, 10);
		ring_pack(api, &l.ring);
		local_compute(&l);
		ref_area(area, l.ring.x, l.ring.y, l.ring.n);
		expect_far(&l, area);
		local_free(&l);
	}
	check_end();
	ref_free(area, 1);
}

/* The exact binomial sum over in[], weights with every term positive. */
static Ref *exact_translation(const Api *api, const void *in, double dx, double dy)
{
	Ref *from = ref_new(MOMENTS), *to = ref_new(MOMENTS);
	mpq_t x, y;
	mpq_inits(x, y, NULL);
	mpq_set_d(x, dx);
	mpq_set_d(y, dy);
	for (int i = 0; i < MOMENTS; i++) {
		mpq_set_d(from[i].value, get(api, in, i));
		mpq_abs(from[i].weight, from[i].value);
	}
	ref_translate(to, EW_MAX_DEGREE, from, x, y);
	mpq_clears(x, y, NULL);
	ref_free(from, MOMENTS);
	return to;
}

/* gamma_(4 degree + 1): every power of dx and dy is reached by one product and one sum a step. */
static void expect_translated(const Api *api, const void *in, double dx, double dy, bool exact)
{
	double out[MOMENTS];
	Ref *want = exact_translation(api, in, dx, dy);
	for (int d = 0; d <= EW_MAX_DEGREE; d++) {
		memcpy(out, in, sizeof out);
		expect(api->translate(d, out, dx, dy, out) == EW_OK, "no EW_OK in place");
		for (int i = d + 1; i < MOMENTS; i++)
			expect(i < ref_count(d) || get(api, out, i) == get(api, in, i),
				"degree %d wrote %d", d, i);
		expect(api->translate(d, in, dx, dy, out) == EW_OK, "no EW_OK");
		for (int i = 0; i < ref_count(d); i++)
			expect_within(get(api, out, i), &want[i], exact ? 0 : 4 * d + 1, api->bits,
				0, "degree %d, moment %d moved by (%g, %g)", d, i, dx, dy);
	}
	ref_free(want, MOMENTS);
}

static void test_translate(const Api *api, const char *target)
{
	double in[MOMENTS], copy[MOMENTS], out[MOMENTS];
	check_begin("ew_translate_moments, %s, %s", api->name, target);
	for (int i = 0; i < TRIES; i++) {
		/* half of them integers so small that every step is exact */
		const bool exact = i % 2;
		const int most = api->bits == 24 ? 1 : 5;
		for (int j = 0; j < MOMENTS; j++)
			put(api, in, (size_t)j, exact ? random_int(-9, 9) : random_real(-1, 1));
		const double dx = exact ? random_int(-most, most) : random_real(-3, 3);
		const double dy = exact ? random_int(-most, most) : random_real(-3, 3);
		memcpy(copy, in, sizeof copy);
		expect_translated(api, in, round_to(api->bits, dx), round_to(api->bits, dy), exact);
		expect(memcmp(in, copy, api->size * MOMENTS) == 0, "the input has changed");
		memcpy(out, in, sizeof out);
		api->translate(EW_MAX_DEGREE, in, dx, dy, out);
		api->translate(EW_MAX_DEGREE, copy, dx, dy, copy);
		expect(memcmp(out, copy, api->size * MOMENTS) == 0, "in place gives other bits");
	}
	check_end();
}

/* Moving the moments is moving the region: the sign of (dx,dy), and the reference's binomials. */
static void test_moved_region(const Api *api, const char *target)
{
	const double x[] = { 0, 3, 4, 1 }, y[] = { 0, 1, 3, 2 };
	const Row *row = find_row("moments", EW_MAX_DEGREE, 0);
	const long k = ring_k(api, row, 4) + 4 * EW_MAX_DEGREE + 1;
	double in[MOMENTS], out[MOMENTS];
	Ref *from = ref_new(MOMENTS), *to = ref_new(MOMENTS), *want = ref_new(MOMENTS);
	Ring ring = ring_new(4), moved = ring_new(4);
	mpq_t dx, dy;
	mpq_inits(dx, dy, NULL);
	mpq_set_d(dx, 2);
	mpq_set_d(dy, -7);
	check_begin("moved region, %s, %s", api->name, target);
	for (size_t i = 0; i < 4; i++) {
		ring.x[i] = x[i];
		ring.y[i] = y[i];
		moved.x[i] = x[i] + 2;
		moved.y[i] = y[i] - 7;
	}
	ring_pack(api, &ring);
	api->moments(EW_MAX_DEGREE, ring.px, ring.py, 4, in);
	api->translate(EW_MAX_DEGREE, in, 2, -7, out);
	ref_ring(from, EW_MAX_DEGREE, ring.x, ring.y, 4);
	ref_translate(to, EW_MAX_DEGREE, from, dx, dy);
	ref_ring(want, EW_MAX_DEGREE, moved.x, moved.y, 4);
	for (int i = 0; i < MOMENTS; i++) {
		expect(mpq_equal(to[i].value, want[i].value),
			"the reference moves moment %d elsewhere", i);
		expect_within(get(api, out, i), &to[i], k, api->bits, 0, "moment %d", i);
	}
	check_end();
	mpq_clears(dx, dy, NULL);
	ring_free(&ring);
	ring_free(&moved);
	ref_free(from, MOMENTS);
	ref_free(to, MOMENTS);
	ref_free(want, MOMENTS);
}

/* Scaling a ring by a power of two scales its centroid, also where area and moments have left the
 * range of the precision: scaling commutes with every rounding, so equal bits must come back. */
static void test_scales(const Api *api, const char *target)
{
	const int widest = api->bits == 24 ? 100 : 900;
	check_begin("centroids of huge and tiny rings, %s, %s", api->name, target);
	for (int i = 0; i < 200; i++) {
		double near[2], far[2];
		const int power = random_int(widest / 4, widest) * (i % 2 ? 1 : -1);
		Ring ring = ring_new((size_t)random_int(3, 30));
		ring_star(&ring, 0, 0, 1);
		ring_snap(&ring, 0x1p-10);
		ring_pack(api, &ring);
		int status = api->centroid(ring.px, ring.py, ring.n, near);
		double want[2] = { get(api, near, 0), get(api, near, 1) };
		for (size_t k = 0; k < ring.n; k++) {
			ring.x[k] = ldexp(ring.x[k], power);
			ring.y[k] = ldexp(ring.y[k], power);
		}
		ring_pack(api, &ring);
		expect(api->centroid(ring.px, ring.py, ring.n, far) == status,
			"2^%d: other status", power);
		for (int k = 0; k < 2; k++) {
			double back = ldexp(get(api, far, k), -power);
			expect(same_bits(back, want[k]), "2^%d: %.17g, not %.17g", power, back,
				want[k]);
		}
		ring_free(&ring);
	}
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	for_each_target(test_centroid);
	for_each_target(test_central);
	for_each_target(test_far);
	for_each_target(test_scales);
	for_each_target(test_translate);
	for_each_target(test_moved_region);
	return check_finish();
}

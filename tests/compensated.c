/* The area in twice the precision.
 *
 * ew_area_compensated is one of the two numbers around the exact area (that one, if there is such
 * a number) while the condition sum |terms| / |2 area| stays below 2^52 / (4 n^2), for float 2^23;
 * beyond that, and without any area, it keeps its bound. Rings of a wanted condition come about by
 * solving for the last ordinate.
 */
#include "rings.h"

static double compensated(const Api *api, const Ring *ring)
{
	return api->compensated(ring->px, ring->py, ring->n);
}

static bool below_limit(const Api *api, const Ref *exact, size_t n)
{
	mpq_t left, right;
	mpq_inits(left, right, NULL);
	mpq_set_ui(left, 4 * n * n, 1);
	mpq_mul(left, left, exact->weight);
	mpq_abs(right, exact->value);
	mpq_mul_2exp(right, right, (mp_bitcnt_t)(api->bits - 1));
	const bool below = mpq_cmp(left, right) < 0;
	mpq_clears(left, right, NULL);
	return below;
}

static int compare(double v, const Ref *exact)
{
	mpq_t q;
	mpq_init(q);
	mpq_set_d(q, v);
	const int order = mpq_cmp(q, exact->value);
	mpq_clear(q);
	return order;
}

static double neighbour(const Api *api, double v, double to)
{
	return api->bits == 24 ? (double)nextafterf((float)v, (float)to) : nextafter(v, to);
}

/* No number of the precision lies between v and the exact area, and v is it if it is a number. */
static bool is_faithful(const Api *api, double v, const Ref *exact)
{
	return compare(neighbour(api, v, -HUGE_VAL), exact) < 0
		&& compare(neighbour(api, v, HUGE_VAL), exact) > 0;
}

static double condition(const Ref *exact)
{
	return fabs(mpq_get_d(exact->weight) / mpq_get_d(exact->value));
}

static void set_exact(Ref *exact, const Ring *ring)
{
	ref_ring(exact, 0, ring->x, ring->y, ring->n);
}

/* Moves the last ordinate so that the area is about weight / wanted. */
static void make_condition(const Api *api, Ring *ring, double wanted, Ref *exact)
{
	const size_t last = ring->n - 1;
	mpq_t y, width;
	mpq_inits(y, width, NULL);
	ring_pack(api, ring);
	set_exact(exact, ring);
	const double area = mpq_get_d(exact->weight) / wanted;
	ring->y[last] = 0;
	set_exact(exact, ring);
	mpq_set_d(y, area);
	mpq_sub(y, y, exact->value);
	mpq_mul_2exp(y, y, 1);
	mpq_set_d(width, ring->x[last - 1] - ring->x[0]);
	if (mpq_sgn(width))
		mpq_div(y, y, width);
	ring->y[last] = mpq_get_d(y);
	ring_pack(api, ring);
	set_exact(exact, ring);
	mpq_clears(y, width, NULL);
}

/* A ring of a random condition up to somewhat above the limit. */
static Ring conditioned_ring(const Api *api, size_t n, Ref *exact)
{
	const double limit = ldexp(1, api->bits - 1) / (4 * (double)n * (double)n);
	const double wanted = exp(random_real(0, log(limit * 2)));
	Ring ring = ring_new(n);
	if (random_int(0, 1))
		ring_star_near(&ring, 3, 1);
	else
		ring_scaled(&ring, -3, 0);
	make_condition(api, &ring, wanted > 1 ? wanted : 1, exact);
	return ring;
}

/* Collinear, exactly so in the numbers that are passed, and far from exact in the products. */
static Ring flat_ring(const Api *api, size_t n, Ref *exact)
{
	const int dx = random_int(-9, 9), dy = random_int(-9, 9);
	Ring ring = ring_new(n);
	for (size_t i = 0; i < n; i++) {
		const double t = random_int(-99999, 99999) * 0x1p-16;
		ring.x[i] = dx * t + 1.25;
		ring.y[i] = dy * t - 3.5;
	}
	ring_pack(api, &ring);
	set_exact(exact, &ring);
	return ring;
}

static size_t conditioned_size(const Api *api, int i)
{
	if (api->bits == 53 && i % 100 == 0)
		return (size_t)random_int(1000, 3000);
	return (size_t)(i % 3 ? random_int(3, 12) : random_int(13, api->bits == 24 ? 40 : 100));
}

/* Sum of x_i y_(i+1) - x_(i+1) y_i, halved, in the precision. */
static double plain_area(const Api *api, const Ring *ring)
{
	volatile double sum = 0;
	for (size_t i = 0; i < ring->n; i++) {
		const size_t next = i + 1 < ring->n ? i + 1 : 0;
		volatile double left = round_to(api->bits, ring->x[i] * ring->y[next]);
		volatile double right = round_to(api->bits, ring->x[next] * ring->y[i]);
		volatile double cross = round_to(api->bits, left - right);
		sum = round_to(api->bits, sum + cross);
	}
	return sum / 2;
}

static double relative_error(double v, const Ref *exact)
{
	return fabs(ref_units(v, exact, 0)) * condition(exact);
}

/* |got - A| <= u |A| + 2 gamma^2 sum W: at most 2 n + 20 roundings on any way into the sum (a
 * product and its error, two products for each vertex, 16 lanes), and as many of what they lost
 * (Ogita, Rump, Oishi 2005, proposition 4.3); the last one to the precision. */
static void expect_bounded(const Api *api, const Ring *ring, double got, const Ref *exact)
{
	mpq_t bound, gamma, off;
	mpq_inits(bound, gamma, off, NULL);
	ref_gamma(gamma, 2 * (long)ring->n + 20, api->bits);
	mpq_mul(gamma, gamma, gamma);
	mpq_mul(gamma, gamma, exact->weight);
	mpq_mul_2exp(gamma, gamma, 1);
	mpq_abs(bound, exact->value);
	mpq_div_2exp(bound, bound, (mp_bitcnt_t)api->bits);
	mpq_add(bound, bound, gamma);
	mpq_set_d(off, got);
	mpq_sub(off, off, exact->value);
	mpq_abs(off, off);
	expect(mpq_cmp(off, bound) <= 0, "n = %zu: %a, exact %a, allowed %g", ring->n, got,
		mpq_get_d(exact->value), mpq_get_d(bound));
	mpq_clears(bound, gamma, off, NULL);
}

/* Rings of any condition; those without an area have none. */
static void test_faithful(const Api *api, const char *target)
{
	int below = 0;
	double most = 1, plain = 0, ours = 0;
	Ref *exact = ref_new(1);
	check_begin("compensated area is faithful, %s, %s", api->name, target);
	for (int i = 0; i < 6000; i++) {
		const size_t n = conditioned_size(api, i);
		Ring ring = i % 10 ? conditioned_ring(api, n, exact) : flat_ring(api, n, exact);
		const double got = compensated(api, &ring);
		expect_bounded(api, &ring, got, exact);
		if (mpq_sgn(exact->value) && below_limit(api, exact, ring.n)) {
			const double error = relative_error(got, exact);
			const double before = relative_error(plain_area(api, &ring), exact);
			below++;
			most = fmax(most, condition(exact));
			plain = fmax(plain, before);
			ours = fmax(ours, error);
			expect(is_faithful(api, got, exact), "n = %zu, condition %.3g: %a, exact "
				"%.17g", ring.n, condition(exact), got, mpq_get_d(exact->value));
			expect(error <= fmax(before, ldexp(1, -api->bits)),
				"n = %zu: off by %g, without compensation by %g", ring.n, error,
				before);
		}
		ring_free(&ring);
	}
	expect(below > 3000, "only %d rings are below the limit", below);
	expect(most > (api->bits == 24 ? 3e4 : 1e13), "no condition above %g", most);
	expect(plain > 1000 * ours, "off by %g, without compensation by %g", ours, plain);
	check_end();
	printf("# compensated, %s, %s: %d rings of condition up to %.2g, off by up to %.2g, "
		"uncompensated %.2g\n", api->name, target, below, most, ours, plain);
	ref_free(exact, 1);
}

/* The same bits wherever fma is fused; scaling by a power of two scales the result. */
static void test_same_bits(const Api *api)
{
	Ref *exact = ref_new(1);
	check_begin("compensated area has the same bits on all targets, %s", api->name);
	for (int i = 0; i < 3000; i++) {
		double first = 0;
		bool found = false;
		Ring ring = conditioned_ring(api, conditioned_size(api, i), exact);
		for (unsigned bit = EW_FMA; bit; bit <<= 1) {
			if (ew_use_target(bit) != EW_OK)
				continue;
			const double got = compensated(api, &ring);
			first = found ? first : got;
			found = true;
			expect(memcmp(&got, &first, sizeof got) == 0, "n = %zu: %a, on %s %a",
				ring.n, first, ew_target_name(bit), got);
		}
		ring_free(&ring);
	}
	ew_use_target(0);
	check_end();
	ref_free(exact, 1);
}

static void test_scaling(const Api *api, const char *target)
{
	Ref *exact = ref_new(1);
	check_begin("compensated area scales, %s, %s", api->name, target);
	for (int i = 0; i < 1000; i++) {
		const int most = api->bits == 24 ? 20 : 400, shift = random_int(-most, most);
		Ring ring = conditioned_ring(api, (size_t)random_int(3, 60), exact);
		const double got = compensated(api, &ring);
		for (size_t j = 0; j < ring.n; j++) {
			ring.x[j] = ldexp(ring.x[j], shift);
			ring.y[j] = ldexp(ring.y[j], shift);
		}
		ring_pack(api, &ring);
		const double scaled = compensated(api, &ring);
		expect(scaled == ldexp(got, 2 * shift), "n = %zu: %a, times 2^%d %a", ring.n, got,
			2 * shift, scaled);
		ring_free(&ring);
	}
	check_end();
	ref_free(exact, 1);
}

/* The vertices of another ring: from `start` on, forwards or backwards, one of them twice. */
static Ring rearranged(const Api *api, const Ring *ring, size_t start, bool back, size_t twice)
{
	Ring other = ring_new(ring->n + 1);
	size_t to = 0;
	for (size_t i = 0; i < ring->n; i++) {
		const size_t from = (start + (back ? ring->n - i : i)) % ring->n;
		for (int copies = i == twice ? 2 : 1; copies > 0; copies--) {
			other.x[to] = ring->x[from];
			other.y[to++] = ring->y[from];
		}
	}
	other.n = to;
	if (twice == ring->n) {         /* closed */
		other.x[to] = other.x[0];
		other.y[to] = other.y[0];
		other.n = to + 1;
	}
	ring_pack(api, &other);
	return other;
}

/* Where the exact area is a number, faithful means exact: however the ring is written down. */
static void test_rearranged(const Api *api, const char *target)
{
	int held = 0;
	Ref *exact = ref_new(1);
	check_begin("compensated area of an exact number, %s, %s", api->name, target);
	for (int i = 0; i < 3000; i++) {
		Ring ring = ring_new((size_t)random_int(3, i % 2 ? 30 : 6));
		const double size = ldexp(1, random_int(3, 8));
		ring_star_near(&ring, size * ldexp(1, random_int(0, api->bits / 3)), size);
		ring_snap(&ring, 0.5);
		ring_pack(api, &ring);
		set_exact(exact, &ring);
		if (mpq_sgn(exact->value) && below_limit(api, exact, ring.n + 1)) {
			const double want = mpq_get_d(exact->value);
			for (size_t r = 0; r < 8; r++) {
				const size_t start = (size_t)random_int(0, (int)ring.n - 1);
				const size_t twice = r / 2 == 0 ? ring.n + 1 : r / 2 == 1 ? ring.n
					: (size_t)random_int(0, (int)ring.n - 1);
				Ring other = rearranged(api, &ring, start, r % 2, twice);
				const double got = compensated(api, &other);
				expect(got == (r % 2 ? -want : want), "n = %zu, from %zu%s: %a, "
					"exact %a", ring.n, start, r % 2 ? " backwards" : "", got,
					want);
				ring_free(&other);
			}
			held++;
		}
		ring_free(&ring);
	}
	expect(held > 1000, "only %d rings below the limit", held);
	check_end();
	ref_free(exact, 1);
}

/* How often does writing a ring down otherwise give other bits, where the area is no number? */
static void test_unchanged(const Api *api, const char *target)
{
	int count[3] = { 0 }, held = 0;
	Ref *exact = ref_new(1);
	check_begin("compensated area of the same ring, %s, %s", api->name, target);
	for (int i = 0; i < 3000; i++) {
		Ring ring = conditioned_ring(api, conditioned_size(api, 1 + i % 90), exact);
		if (mpq_sgn(exact->value) && below_limit(api, exact, ring.n + 1)) {
			const double got = compensated(api, &ring);
			const size_t twice[] = { (size_t)random_int(0, (int)ring.n - 1), ring.n,
				ring.n + 1 };
			for (int r = 0; r < 3; r++) {
				Ring other = rearranged(api, &ring, 0, r == 2, twice[r]);
				const double again = compensated(api, &other);
				count[r] += again != (r == 2 ? -got : got);
				expect(is_faithful(api, r == 2 ? -again : again, exact),
					"n = %zu: %a, written otherwise %a", ring.n, got, again);
				ring_free(&other);
			}
			held++;
		}
		ring_free(&ring);
	}
	check_end();
	printf("# compensated, %s, %s: other bits in %d of %d rings with a vertex twice, "
		"%d closed, %d backwards\n", api->name, target, count[0], held, count[1], count[2]);
	ref_free(exact, 1);
}

static void test_nonfinite(const Api *api, const char *target)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	check_begin("compensated area of NaN, infinity and nothing, %s, %s", api->name, target);
	for (int i = 0; i < 600; i++) {
		Ring ring = ring_new((size_t)random_int(1, 60));
		ring_scaled(&ring, 0, 0);
		ring_pack(api, &ring);
		expect(ring.n > 2 || compensated(api, &ring) == 0, "n = %zu is not 0", ring.n);
		(random_int(0, 1) ? ring.x : ring.y)[random_int(0, (int)ring.n - 1)] = bad[i % 3];
		ring_pack(api, &ring);
		expect(!isfinite(compensated(api, &ring)), "n = %zu is finite", ring.n);
		ring_free(&ring);
	}
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	for_each_target(test_faithful);
	for (int i = 0; i < APIS; i++)
		test_same_bits(&apis[i]);
	for_each_target(test_scaling);
	for_each_target(test_rearranged);
	for_each_target(test_unchanged);
	for_each_target(test_nonfinite);
	return check_finish();
}

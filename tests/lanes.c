/* The virtual-lane definition of the fma target, written out plainly and compared bit for bit.
 *
 * Item j goes to lane j mod L, L = 8 for double and 16 for float, but 1 for a ring of fewer than 24
 * vertices; a lane adds its items in order, from +0, with fused multiply-adds. After every 64 items
 * a float lane is added to a double of its own and starts again from 0. At the end lanes l and
 * l + L/2 are added, then l and l + L/4, down to one; that sum is scaled in double and rounded to
 * the precision.
 *
 *     area      item j is vertex i = j+1 < n, and j / L mod 2 says which of two sets of lanes
 *               takes it: lane = fma(x_i - x_0, y_(i+1) - y_(i-1), lane); the sums of the two sets
 *               are added;  1/2
 *     degree 1  item j is the edge from vertex j, s = x0 y1 - x1 y0 (three roundings):
 *               lane += s;  1/2     lane = fma(s, x0 + x1, lane);  1/6     and the same with y
 *
 * Every other target that is faster than portable must give these bits too.
 */
#include "rings.h"

enum { LANES = 8, LANES_FLOAT = 16, FLUSH = 64 };

typedef struct {
	int lanes, items;               /* items so far */
	int flush;                      /* items of a float lane between two flushes */
	bool narrow;
	double lane[LANES_FLOAT], wide[LANES_FLOAT];
} Sum;

static Sum sum_new(size_t n, bool narrow, int turns)
{
	const int lanes = n < SHORT ? 1 : narrow ? LANES_FLOAT : LANES;
	return (Sum){ lanes, 0, FLUSH / turns, narrow, { 0 }, { 0 } };
}

static void sum_flush(Sum *sum)
{
	for (int l = 0; l < sum->lanes; l++) {
		sum->wide[l] += sum->lane[l];
		sum->lane[l] = 0;
	}
}

/* lane = fma(a, b, lane) for the next item */
static void sum_add(Sum *sum, double a, double b)
{
	double *lane = &sum->lane[sum->items % sum->lanes];
	*lane = sum->narrow ? (double)fmaf((float)a, (float)b, (float)*lane) : fma(a, b, *lane);
	sum->items++;
	if (sum->narrow && sum->items % (sum->flush * sum->lanes) == 0)
		sum_flush(sum);
}

static double sum_total(Sum *sum)
{
	sum_flush(sum);
	for (int half = sum->lanes / 2; half > 0; half /= 2) {
		for (int l = 0; l < half; l++)
			sum->wide[l] += sum->wide[l + half];
	}
	return sum->wide[0];
}

/* One rounded operation, which no compiler can contract with another. For floats, double holds the
 * sum or product exactly enough that rounding twice is rounding once. */

static double plus(const Api *api, double a, double b)
{
	volatile double sum = a + b;
	return round_to(api->bits, sum);
}

static double times(const Api *api, double a, double b)
{
	volatile double product = a * b;
	return round_to(api->bits, product);
}

static double defined_area(const Api *api, const Ring *ring)
{
	const bool narrow = api->bits == 24;
	Sum sum[2] = { sum_new(ring->n, narrow, 2), sum_new(ring->n, narrow, 2) };
	for (size_t j = 0; j + 1 < ring->n; j++) {
		const size_t next = j + 2 < ring->n ? j + 2 : 0;
		sum_add(&sum[j / (size_t)sum->lanes % 2], plus(api, ring->x[j + 1], -ring->x[0]),
			plus(api, ring->y[next], -ring->y[j]));
	}
	const double first = sum_total(&sum[0]), second = sum_total(&sum[1]);
	return round_to(api->bits, (first + second) * 0.5);
}

static void defined_moments(const Api *api, const Ring *ring, double out[3])
{
	const bool narrow = api->bits == 24;
	Sum area = sum_new(ring->n, narrow, 1), x = area, y = area;
	for (size_t j = 0; j < ring->n; j++) {
		const size_t next = j + 1 < ring->n ? j + 1 : 0;
		const double x0 = ring->x[j], y0 = ring->y[j];
		const double x1 = ring->x[next], y1 = ring->y[next];
		const double s = plus(api, times(api, x0, y1), -times(api, x1, y0));
		sum_add(&area, s, 1);
		sum_add(&x, s, plus(api, x0, x1));
		sum_add(&y, s, plus(api, y0, y1));
	}
	out[0] = round_to(api->bits, sum_total(&area) * 0.5);
	out[1] = round_to(api->bits, sum_total(&x) * (1.0 / 6));
	out[2] = round_to(api->bits, sum_total(&y) * (1.0 / 6));
}

static Ring lane_ring(const Api *api, size_t n)
{
	Ring ring = ring_new(n);
	ring_star_near(&ring, 3, 1);
	ring_pack(api, &ring);
	return ring;
}

static void expect_bits(double got, double want, const char *what, size_t n)
{
	expect(same_bits(got, want), "%s, n = %zu: %a, by definition %a", what, n, got, want);
}

static void test_ring(const Api *api, size_t n)
{
	double got[3], want[3];
	Ring ring = lane_ring(api, n);
	expect_bits(api->area(ring.px, ring.py, n), defined_area(api, &ring), "area", n);
	expect_bits(api->moment(0, 0, ring.px, ring.py, n), defined_area(api, &ring), "x0y0", n);
	api->moments(0, ring.px, ring.py, n, got);
	expect_bits(get(api, got, 0), defined_area(api, &ring), "degree 0", n);
	api->moments(1, ring.px, ring.py, n, got);
	defined_moments(api, &ring, want);
	for (int i = 0; i < 3; i++)
		expect_bits(get(api, got, i), want[i], "degree 1", n);
	api->xy(1, ring.pxy, n, got);
	for (int i = 0; i < 3; i++)
		expect_bits(get(api, got, i), want[i], "degree 1, interleaved", n);
	ring_free(&ring);
}

static void test_definition(const Api *api, const char *target)
{
	static const size_t longer[] = {
		100, 255, 256, 257, 258, 259, 1023, 1024, 1025, 1026, 1027, 2047, 2048, 2049, 2050,
		3333, 5000
	};
	if (strcmp(target, "portable") == 0)
		return;
	check_begin("virtual lanes, %s, %s", api->name, target);
	for (size_t n = 3; n <= 70; n++) {
		for (int i = 0; i < 10; i++)
			test_ring(api, n);
	}
	for (size_t i = 0; i < sizeof longer / sizeof *longer; i++)
		test_ring(api, longer[i]);
	check_end();
}

int main(int argc, char **argv)
{
	check_start(argc, argv);
	if (ew_targets() == EW_PORTABLE)
		printf("skip fma\n");
	for_each_target(test_definition);
	return check_finish();
}

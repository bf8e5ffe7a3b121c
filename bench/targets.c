/* targets.c - the kernels of every target, taken from the kernel list, and kernels as trials.
 *
 * One kernel more than the library has is emitted for the bench: all moments to degree 12.
 *
 * A kernel runs over ITEMS items of one ring in the nearest cache, at a step that is the number of
 * lanes of the definition unless the caller says otherwise. What the accumulators hold at the end
 * is of no interest; they start at 0 once and stay finite. */
#include "bench.h"

#include "deg12_kernels.h"
#include "ex_kernels.h"
#include "mx_kernels.h"

enum { MOST_LANES = 16, PARAMETERS = 4 };      /* of a window: u0, u1, v0, v1 */

#define ROW(id, symbol, fma, add) { symbol, NULL, fma, add },
#define ROWF(id, symbol, fma, add) { NULL, symbol, fma, add },
#define COUNTS(id, symbol, fma, add) symbol##_fma = fma, symbol##_add = add,
#define DEGREE_12_OF(target) ROW(DEGREE_12, deg12_ring_moments_12_##target, \
	deg12_ring_moments_12_##target##_fma, deg12_ring_moments_12_##target##_add)
#define DEGREE_12_OFF(target) ROWF(DEGREE_12, deg12_ring_moments_12f_##target, \
	deg12_ring_moments_12f_##target##_fma, deg12_ring_moments_12f_##target##_add)

#define LISTS(TARGET, target, doubles) \
	enum { DEG12_RINGS_##TARGET##_DOUBLE(COUNTS) DEG12_RINGS_##TARGET##_FLOAT(COUNTS) }; \
	static const Kernel target##_double[KERNELS] = { \
		EW_RINGS_##TARGET##_DOUBLE(ROW) DEGREE_12_OF(target) \
	}; \
	static const Kernel target##_float[KERNELS] = { \
		EW_RINGS_##TARGET##_FLOAT(ROWF) DEGREE_12_OFF(target) \
	}; \
	static const Kernel target##_matrix[] = { MX_RINGS_##TARGET##_DOUBLE(ROW) }; \
	static const Kernel target##_expanded[] = { EX_RINGS_##TARGET##_DOUBLE(ROW) };
EW_TARGETS(LISTS)

#define ENTRY(TARGET, target, doubles) \
	{ EW_##TARGET, #target, { doubles, doubles > 1 ? 2 * doubles : 1 }, \
	  { target##_double, target##_float }, target##_matrix, target##_expanded },
static const Target every_target[] = { EW_TARGETS(ENTRY) };

#define NAME(id, family, m, n, accumulators, outputs, k, r) #id,
static const char *const ids[KERNELS] = { EW_RINGS(NAME) "EW_RING_MOMENTS_12" };

int targets_here(const Target *here[MAX_TARGETS])
{
	int count = 0;
	for (size_t i = 0; i < sizeof every_target / sizeof *every_target; ++i)
		if (ew_targets() & every_target[i].bit)
			here[count++] = &every_target[i];
	return count;
}

const char *ring_name(int id)
{
	return ids[id] + sizeof "EW_RING_" - 1;
}

KernelJob kernel_job(const Target *target, int precision, int id)
{
	KernelJob job = { &target->kernels[precision][id],
		precision == DOUBLE ? (size_t)EW_LANES : (size_t)EW_LANES_FLOAT };
	return job;
}

void kernel_run(const void *context, long repeat)
{
	static _Alignas(64) double x[ITEMS + 3], y[ITEMS + 3], origin[PARAMETERS * MOST_LANES];
	static _Alignas(64) double sum[DEG12_MAX_ACCUMULATORS * MOST_LANES];
	static _Alignas(64) float xf[ITEMS + 3], yf[ITEMS + 3], originf[PARAMETERS * MOST_LANES];
	static _Alignas(64) float sumf[DEG12_MAX_ACCUMULATORS * MOST_LANES];
	static int ready;
	const KernelJob *job = context;
	if (!ready) {
		ready = 1;
		points_make(DOUBLE, x, ITEMS + 3);
		points_make(DOUBLE, y, ITEMS + 3);
		points_make(FLOAT, xf, ITEMS + 3);
		points_make(FLOAT, yf, ITEMS + 3);
	}
	while (repeat-- > 0)
		if (job->kernel->run)
			job->kernel->run(x, y, origin, 1, job->step, ITEMS, sum);
		else
			job->kernel->runf(xf, yf, originf, 1, job->step, ITEMS, sumf);
}

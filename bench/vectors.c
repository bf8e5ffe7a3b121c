/* vectors.c - what this machine can do at most, at every vector width it has.
 *
 * Three loops per width and precision: independent multiply-adds (the peak of the FMA pipe),
 * a sum over two arrays (the floor of whatever reads them), and the same over many rings with
 * results written per ring (the floor of the batch functions). They are vector_template.h, once
 * per width; only multiply-adds and stores past the caches need intrinsics. A CPU without fused
 * multiply-add is measured by a product and a sum. */
#include "bench.h"

#include <string.h>
#if EW_X86
#include <immintrin.h>
#elif EW_ARM
#include <arm_neon.h>
#endif

enum { READ_BLOCK = 4, FILL_BLOCK = 256 };     /* vectors; rings between two writes */

#define WIDTH_REAL double
#define WIDTH_VECTOR double
#define WIDTH_NAME(stem) stem##_plain
#define WIDTH_ATTRIBUTE
#define WIDTH_FMA(a, b, c) ((a) * (b) + (c))
#include "vector_template.h"

#define WIDTH_REAL float
#define WIDTH_VECTOR float
#define WIDTH_NAME(stem) stem##_plainf
#define WIDTH_ATTRIBUTE
#define WIDTH_FMA(a, b, c) ((a) * (b) + (c))
#include "vector_template.h"

#if EW_BUILD_FMA
#define WIDTH_REAL double
#define WIDTH_VECTOR double
#define WIDTH_NAME(stem) stem##_scalar
#define WIDTH_ATTRIBUTE EW_ATTRIBUTE_FMA
#define WIDTH_FMA(a, b, c) fma(a, b, c)
#include "vector_template.h"

#define WIDTH_REAL float
#define WIDTH_VECTOR float
#define WIDTH_NAME(stem) stem##_scalarf
#define WIDTH_ATTRIBUTE EW_ATTRIBUTE_FMA
#define WIDTH_FMA(a, b, c) fmaf(a, b, c)
#include "vector_template.h"
#endif

/* A vector that need not be aligned. */
#define VECTOR(name, real, bytes) \
	typedef real name __attribute__((vector_size(bytes), aligned(sizeof(real)), may_alias));

#if EW_BUILD_NEON
VECTOR(Double2, double, 16)
#define WIDTH_REAL double
#define WIDTH_VECTOR Double2
#define WIDTH_NAME(stem) stem##_neon
#define WIDTH_ATTRIBUTE EW_ATTRIBUTE_NEON
#define WIDTH_FMA(a, b, c) vfmaq_f64(c, a, b)
#include "vector_template.h"

VECTOR(Float4, float, 16)
#define WIDTH_REAL float
#define WIDTH_VECTOR Float4
#define WIDTH_NAME(stem) stem##_neonf
#define WIDTH_ATTRIBUTE EW_ATTRIBUTE_NEON
#define WIDTH_FMA(a, b, c) vfmaq_f32(c, a, b)
#include "vector_template.h"
#endif

#if EW_BUILD_AVX2
VECTOR(Double4, double, 32)
#define WIDTH_REAL double
#define WIDTH_VECTOR Double4
#define WIDTH_NAME(stem) stem##_avx2
#define WIDTH_ATTRIBUTE EW_ATTRIBUTE_AVX2
#define WIDTH_FMA(a, b, c) _mm256_fmadd_pd(a, b, c)
#define WIDTH_STREAM(p, v) _mm256_stream_pd(p, v)
#include "vector_template.h"

VECTOR(Float8, float, 32)
#define WIDTH_REAL float
#define WIDTH_VECTOR Float8
#define WIDTH_NAME(stem) stem##_avx2f
#define WIDTH_ATTRIBUTE EW_ATTRIBUTE_AVX2
#define WIDTH_FMA(a, b, c) _mm256_fmadd_ps(a, b, c)
#define WIDTH_STREAM(p, v) _mm256_stream_ps(p, v)
#include "vector_template.h"
#endif

#if EW_BUILD_AVX512
VECTOR(Double8, double, 64)
#define WIDTH_REAL double
#define WIDTH_VECTOR Double8
#define WIDTH_NAME(stem) stem##_avx512
#define WIDTH_ATTRIBUTE EW_ATTRIBUTE_AVX512
#define WIDTH_FMA(a, b, c) _mm512_fmadd_pd(a, b, c)
#define WIDTH_STREAM(p, v) _mm512_stream_pd(p, v)
#include "vector_template.h"

VECTOR(Float16, float, 64)
#define WIDTH_REAL float
#define WIDTH_VECTOR Float16
#define WIDTH_NAME(stem) stem##_avx512f
#define WIDTH_ATTRIBUTE EW_ATTRIBUTE_AVX512
#define WIDTH_FMA(a, b, c) _mm512_fmadd_ps(a, b, c)
#define WIDTH_STREAM(p, v) _mm512_stream_ps(p, v)
#include "vector_template.h"
#endif

#define WIDTH(name, text, target, vector, streams) \
	{ text, target, vector, streams, { { peak_##name, read_##name, fill_##name }, \
	                           { peak_##name##f, read_##name##f, fill_##name##f } } },

static const Width all_widths[] = {
	WIDTH(plain, "scalar product and sum", EW_PORTABLE, 0, 0)
#if EW_BUILD_FMA
	WIDTH(scalar, "scalar", EW_FMA, 0, 0)
#endif
#if EW_BUILD_NEON
	WIDTH(neon, "128 bits", EW_NEON, 1, 0)
#endif
#if EW_BUILD_AVX2
	WIDTH(avx2, "256 bits", EW_AVX2, 1, 1)
#endif
#if EW_BUILD_AVX512
	WIDTH(avx512, "512 bits", EW_AVX512, 1, 1)
#endif
};
enum { WIDTHS = (int)(sizeof all_widths / sizeof *all_widths) };

const Width *width_of(unsigned target)
{
	unsigned which = target == EW_PORTABLE && ew_targets() & EW_FMA ? EW_FMA : target;
	for (int i = 0; i < WIDTHS; ++i)
		if (all_widths[i].target == which)
			return &all_widths[i];
	return all_widths;
}

void read_run(const void *context, long repeat)
{
	const ReadJob *job = context;
	while (repeat-- > 0)
		job->width->of[job->precision].read(job->x, job->y, job->n);
}

const Width *width_fastest(ReadJob job)
{
	enum { ROUNDS = 5 };
	ReadJob jobs[WIDTHS];
	int count = 0, best = 0;
	Race race = race_new(ROUNDS);
	for (int i = WIDTHS - 1; i >= 0; --i)
		if (ew_targets() & all_widths[i].target && (all_widths[i].vector || !count)) {
			jobs[count] = job;
			jobs[count].width = &all_widths[i];
			race_add(&race, read_run, &jobs[count++], (double)job.n);
		}
	race_run(&race);
	for (int i = 1; i < count; ++i)
		if (race_median(&race, i) < race_median(&race, best))
			best = i;
	race_free(&race);
	return jobs[best].width;
}

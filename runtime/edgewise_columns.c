/* edgewise_columns.c - coordinates by vectors: moved to a local origin, taken out of interleaved
 * pairs, and transposed so that short rings stand side by side in the lanes of a register.
 *
 * A block of ROWS rings by COLUMNS vertices is loaded row by row and transposed in registers; that
 * is several times faster than gathering. edgewise_columns_template.h makes the two functions of a
 * precision from what an instruction set brings: BLOCK, LOAD, STORE, SPLAT, SUB, SELECT (the lanes
 * whose length is more than c), EVEN (every second of two vectors of pairs).
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#include "edgewise_runtime.h"

static void ew_ring_move_scalar(const double *from, size_t stride, double origin, size_t count,
	double *to)
{
	for (size_t i = 0; i < count; ++i)
		to[i] = from[i * stride] - origin;
}

static void ew_ring_move_scalarf(const float *from, size_t stride, float origin, size_t count,
	float *to)
{
	for (size_t i = 0; i < count; ++i)
		to[i] = from[i * stride] - origin;
}

#if EW_BUILD_AVX2 || EW_BUILD_AVX512
#include <immintrin.h>

EW_ATTRIBUTE_AVX2 static void ew_ring_block_x86(const double *from, const size_t *start,
	__m256d column[2])
{
	const __m256d even = _mm256_insertf128_pd(
		_mm256_castpd128_pd256(_mm_loadu_pd(from + start[0])),
		_mm_loadu_pd(from + start[2]), 1);
	const __m256d odd = _mm256_insertf128_pd(
		_mm256_castpd128_pd256(_mm_loadu_pd(from + start[1])),
		_mm_loadu_pd(from + start[3]), 1);
	column[0] = _mm256_unpacklo_pd(even, odd);
	column[1] = _mm256_unpackhi_pd(even, odd);
}

EW_ATTRIBUTE_AVX2 static __m256 ew_ring_rows_x86f(const float *low, const float *high)
{
	return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high),
		1);
}

EW_ATTRIBUTE_AVX2 static void ew_ring_block_x86f(const float *from, const size_t *start,
	__m256 column[4])
{
	const __m256 r0 = ew_ring_rows_x86f(from + start[0], from + start[4]);
	const __m256 r1 = ew_ring_rows_x86f(from + start[1], from + start[5]);
	const __m256 r2 = ew_ring_rows_x86f(from + start[2], from + start[6]);
	const __m256 r3 = ew_ring_rows_x86f(from + start[3], from + start[7]);
	const __m256 low01 = _mm256_unpacklo_ps(r0, r1), high01 = _mm256_unpackhi_ps(r0, r1);
	const __m256 low23 = _mm256_unpacklo_ps(r2, r3), high23 = _mm256_unpackhi_ps(r2, r3);
	column[0] = _mm256_shuffle_ps(low01, low23, 0x44);
	column[1] = _mm256_shuffle_ps(low01, low23, 0xee);
	column[2] = _mm256_shuffle_ps(high01, high23, 0x44);
	column[3] = _mm256_shuffle_ps(high01, high23, 0xee);
}

#define EW_ISA(stem) ew_ring_##stem##_x86
#define EW_VECTOR __m256d
#define EW_ATTRIBUTE EW_ATTRIBUTE_AVX2
#define EW_ROWS 4
#define EW_COLUMNS 2
#define EW_WIDTHS EW_GATHER(4) EW_GATHER(8)
#define EW_LOAD(p) _mm256_loadu_pd(p)
#define EW_STORE(p, v) _mm256_storeu_pd(p, v)
#define EW_SPLAT(a) _mm256_set1_pd(a)
#define EW_SUB(a, b) _mm256_sub_pd(a, b)
#define EW_SELECT(length, c, v, first) \
	_mm256_blendv_pd(first, v, _mm256_cmp_pd(length, c, _CMP_GT_OQ))
#define EW_EVEN(a, b) _mm256_permute4x64_pd(_mm256_unpacklo_pd(a, b), 0xd8)
#define EW_IS_FLOAT 0
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT

#define EW_ISA(stem) ew_ring_##stem##_x86f
#define EW_VECTOR __m256
#define EW_ATTRIBUTE EW_ATTRIBUTE_AVX2
#define EW_ROWS 8
#define EW_COLUMNS 4
#define EW_WIDTHS EW_GATHER(8) EW_GATHER(16)
#define EW_LOAD(p) _mm256_loadu_ps(p)
#define EW_STORE(p, v) _mm256_storeu_ps(p, v)
#define EW_SPLAT(a) _mm256_set1_ps(a)
#define EW_SUB(a, b) _mm256_sub_ps(a, b)
#define EW_SELECT(length, c, v, first) \
	_mm256_blendv_ps(first, v, _mm256_cmp_ps(length, c, _CMP_GT_OQ))
#define EW_EVEN(a, b) _mm256_castpd_ps(_mm256_permute4x64_pd( \
	_mm256_castps_pd(_mm256_shuffle_ps(a, b, 0x88)), 0xd8))
#define EW_IS_FLOAT 1
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT
#endif

#if EW_BUILD_NEON
#include <arm_neon.h>

static void ew_ring_block_neon(const double *from, const size_t *start, float64x2_t column[2])
{
	const float64x2_t r0 = vld1q_f64(from + start[0]), r1 = vld1q_f64(from + start[1]);
	column[0] = vzip1q_f64(r0, r1);
	column[1] = vzip2q_f64(r0, r1);
}

static void ew_ring_block_neonf(const float *from, const size_t *start, float32x4_t column[4])
{
	const float32x4_t r0 = vld1q_f32(from + start[0]), r1 = vld1q_f32(from + start[1]);
	const float32x4_t r2 = vld1q_f32(from + start[2]), r3 = vld1q_f32(from + start[3]);
	const float64x2_t even01 = vreinterpretq_f64_f32(vtrn1q_f32(r0, r1));
	const float64x2_t even23 = vreinterpretq_f64_f32(vtrn1q_f32(r2, r3));
	const float64x2_t odd01 = vreinterpretq_f64_f32(vtrn2q_f32(r0, r1));
	const float64x2_t odd23 = vreinterpretq_f64_f32(vtrn2q_f32(r2, r3));
	column[0] = vreinterpretq_f32_f64(vzip1q_f64(even01, even23));
	column[1] = vreinterpretq_f32_f64(vzip1q_f64(odd01, odd23));
	column[2] = vreinterpretq_f32_f64(vzip2q_f64(even01, even23));
	column[3] = vreinterpretq_f32_f64(vzip2q_f64(odd01, odd23));
}

#define EW_ISA(stem) ew_ring_##stem##_neon
#define EW_VECTOR float64x2_t
#define EW_ATTRIBUTE EW_ATTRIBUTE_NEON
#define EW_ROWS 2
#define EW_COLUMNS 2
#define EW_WIDTHS EW_GATHER(2)
#define EW_LOAD(p) vld1q_f64(p)
#define EW_STORE(p, v) vst1q_f64(p, v)
#define EW_SPLAT(a) vdupq_n_f64(a)
#define EW_SUB(a, b) vsubq_f64(a, b)
#define EW_SELECT(length, c, v, first) vbslq_f64(vcgtq_f64(length, c), v, first)
#define EW_EVEN(a, b) vuzp1q_f64(a, b)
#define EW_IS_FLOAT 0
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT

#define EW_ISA(stem) ew_ring_##stem##_neonf
#define EW_VECTOR float32x4_t
#define EW_ATTRIBUTE EW_ATTRIBUTE_NEON
#define EW_ROWS 4
#define EW_COLUMNS 4
#define EW_WIDTHS EW_GATHER(4)
#define EW_LOAD(p) vld1q_f32(p)
#define EW_STORE(p, v) vst1q_f32(p, v)
#define EW_SPLAT(a) vdupq_n_f32(a)
#define EW_SUB(a, b) vsubq_f32(a, b)
#define EW_SELECT(length, c, v, first) vbslq_f32(vcgtq_f32(length, c), v, first)
#define EW_EVEN(a, b) vuzp1q_f32(a, b)
#define EW_IS_FLOAT 1
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT
#endif

const ew_ring_columns *ew_ring_by_columns(unsigned target)
{
	static const ew_ring_columns scalar = { 1, ew_ring_move_scalar, NULL };
#if EW_BUILD_AVX2 || EW_BUILD_AVX512
	static const ew_ring_columns x86[] = {
		{ 4, ew_ring_move_x86, ew_ring_gather_4_x86 },
		{ 8, ew_ring_move_x86, ew_ring_gather_8_x86 },
	};
	if (target == EW_AVX2 || target == EW_AVX512)
		return &x86[target == EW_AVX512];
#endif
#if EW_BUILD_NEON
	static const ew_ring_columns neon = { 2, ew_ring_move_neon, ew_ring_gather_2_neon };
	if (target == EW_NEON)
		return &neon;
#endif
	(void)target;
	return &scalar;
}

const ew_ring_columnsf *ew_ring_by_columnsf(unsigned target)
{
	static const ew_ring_columnsf scalar = { 1, ew_ring_move_scalarf, NULL };
#if EW_BUILD_AVX2 || EW_BUILD_AVX512
	static const ew_ring_columnsf x86[] = {
		{ 8, ew_ring_move_x86f, ew_ring_gather_8_x86f },
		{ 16, ew_ring_move_x86f, ew_ring_gather_16_x86f },
	};
	if (target == EW_AVX2 || target == EW_AVX512)
		return &x86[target == EW_AVX512];
#endif
#if EW_BUILD_NEON
	static const ew_ring_columnsf neon = { 4, ew_ring_move_neonf, ew_ring_gather_4_neonf };
	if (target == EW_NEON)
		return &neon;
#endif
	(void)target;
	return &scalar;
}

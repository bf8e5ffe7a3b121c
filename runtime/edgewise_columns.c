/* edgewise_columns.c - coordinates by vectors: moved to a local origin, taken out of interleaved
 * pairs, and transposed so that short rings stand side by side in the lanes of a register.
 *
 * A block of ROWS rings by COLUMNS vertices is loaded row by row and transposed in registers; that
 * is several times faster than gathering. edgewise_columns_template.h makes the functions of a
 * precision from what an instruction set brings: BLOCK, LOAD, STORE, SPLAT, ADD, SUB, SELECT (the
 * lanes whose length is more than c), EVEN (every second of two vectors of pairs), STORE_WIDE (as
 * double), MORE (what belongs to columns from 2 on); STARTS of rings in bytes; and of their sizes
 * less three, as a vector of integers: COUNTS the type, OVER the sizes, SAME if they are all the
 * same as the first, MOST the largest one, without sign, LENGTHS as numbers.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */
#include "edgewise_runtime.h"

#include <math.h>
#include <string.h>

#define EW_SCALAR(f, real) \
static void ew_ring_move_scalar##f(const real *from, size_t stride, real origin, size_t count, \
	real *to) \
{ \
	for (size_t i = 0; i < count; ++i) \
		to[i] = from[i * stride] - origin; \
} \
static void ew_ring_clear_scalar##f(real *to, size_t count) \
{ \
	memset(to, 0, count * sizeof *to); \
} \
static const ew_ring_columns##f ew_ring_columns_scalar##f = { \
	1, ew_ring_move_scalar##f, ew_ring_clear_scalar##f, NULL, NULL, NULL, { NULL }, NULL \
};
#ifdef EW_HAS_DOUBLE
EW_SCALAR(, double)
#endif
#ifdef EW_HAS_FLOAT
EW_SCALAR(f, float)
#endif
#undef EW_SCALAR

#if EW_BUILD_AVX2 || EW_BUILD_AVX512 || EW_BUILD_NEON || EW_BUILD_WASM128
/* Where rings start, in bytes; hidden, or compilers keep the same in vertices too. */
EW_INLINE size_t ew_ring_bytes(size_t start, size_t size)
{
	size_t bytes = start * size;
	EW_HIDE(bytes);
	return bytes;
}

#define EW_BYTES(start) ew_ring_bytes((size_t)(start), sizeof(EW_REAL))
#define EW_STARTS_2(s) EW_BYTES((s)[0]), EW_BYTES((s)[1])
#define EW_STARTS_4(s) EW_STARTS_2(s), EW_STARTS_2((s) + 2)
#define EW_STARTS_8(s) EW_STARTS_4(s), EW_STARTS_4((s) + 4)
#define EW_STARTS_16(s) EW_STARTS_8(s), EW_STARTS_8((s) + 8)
#define EW_DOUBLES(bytes) ((const double *)(const void *)((const char *)from + (bytes)))
#define EW_FLOATS(bytes) ((const float *)(const void *)((const char *)from + (bytes)))
#endif

#if EW_BUILD_AVX2 || EW_BUILD_AVX512
#include <immintrin.h>

#ifdef EW_MAX_DEGREE
EW_ATTRIBUTE_AVX2 EW_INLINE uint32_t ew_ring_most4(__m128i n)
{
	n = _mm_max_epu32(n, _mm_shuffle_epi32(n, 0x4e));
	n = _mm_max_epu32(n, _mm_shuffle_epi32(n, 0xb1));
	return (uint32_t)_mm_cvtsi128_si32(n);
}

#if defined(EW_HAS_FLOAT) || EW_BUILD_AVX512
EW_ATTRIBUTE_AVX2 EW_INLINE uint32_t ew_ring_most8(__m256i n)
{
	return ew_ring_most4(_mm_max_epu32(_mm256_castsi256_si128(n),
		_mm256_extracti128_si256(n, 1)));
}
#endif
#endif
#endif

#if EW_BUILD_AVX2
#include "edgewise_items_avx2.h"

EW_ATTRIBUTE_AVX2 static void ew_ring_divide_avx2(const double *a, const double *b,
	const double *c, size_t count, double *to)
{
	for (size_t i = 0; i < count; i += 4)
		_mm256_storeu_pd(to + i, _mm256_add_pd(_mm256_loadu_pd(c + i),
			_mm256_div_pd(_mm256_loadu_pd(a + i), _mm256_loadu_pd(b + i))));
}

#ifdef EW_HAS_DOUBLE
EW_ATTRIBUTE_AVX2 EW_INLINE __m256d ew_ring_pairs_avx2(const double *low, const double *high)
{
	return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(low)), _mm_loadu_pd(high),
		1);
}

EW_ATTRIBUTE_AVX2 EW_INLINE void ew_ring_block_avx2(const double *from, const size_t *start,
	__m256d column[2])
{
	const __m256d even = ew_ring_pairs_avx2(EW_DOUBLES(start[0]), EW_DOUBLES(start[2]));
	const __m256d odd = ew_ring_pairs_avx2(EW_DOUBLES(start[1]), EW_DOUBLES(start[3]));
	column[0] = _mm256_unpacklo_pd(even, odd);
	column[1] = _mm256_unpackhi_pd(even, odd);
}

#define EW_ISA(stem) ew_ring_##stem##_avx2
#define EW_ITEM(degree) ew_ring_moments_##degree##_item_avx2
#define EW_DIVIDE ew_ring_divide_avx2
#define EW_VECTOR __m256d
#define EW_ATTRIBUTE EW_ATTRIBUTE_AVX2
#define EW_ROWS 4
#define EW_STARTS EW_STARTS_4
#define EW_COUNTS __m128i
#define EW_OVER(s) _mm_sub_epi32(_mm_loadu_si128((const __m128i *)(s + 1)), \
	_mm_add_epi32(_mm_loadu_si128((const __m128i *)(s)), _mm_set1_epi32(3)))
#define EW_SAME(n, m) (_mm_movemask_epi8(_mm_cmpeq_epi32(n, _mm_set1_epi32(m))) == 0xffff)
#define EW_MOST(n) ew_ring_most4(n)
#define EW_LENGTHS(n) _mm256_cvtepi32_pd(n)
#define EW_COLUMNS 2
#define EW_MORE(X)
#define EW_LOAD(p) _mm256_loadu_pd(p)
#define EW_STORE(p, v) _mm256_storeu_pd(p, v)
#define EW_STORE_WIDE(p, v) EW_STORE(p, v)
#define EW_SPLAT(a) _mm256_set1_pd(a)
#define EW_ADD(a, b) _mm256_add_pd(a, b)
#define EW_SUB(a, b) _mm256_sub_pd(a, b)
#define EW_SELECT(length, c, v, first) \
	_mm256_blendv_pd(first, v, _mm256_cmp_pd(length, c, _CMP_GT_OQ))
#define EW_EVEN(a, b) _mm256_permute4x64_pd(_mm256_unpacklo_pd(a, b), 0xd8)
#define EW_IS_FLOAT 0
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT
#endif

#ifdef EW_HAS_FLOAT
EW_ATTRIBUTE_AVX2 EW_INLINE __m256 ew_ring_rows_avx2f(const float *low, const float *high)
{
	return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high),
		1);
}

EW_ATTRIBUTE_AVX2 EW_INLINE void ew_ring_block_avx2f(const float *from, const size_t *start,
	__m256 column[4])
{
	const __m256 r0 = ew_ring_rows_avx2f(EW_FLOATS(start[0]), EW_FLOATS(start[4]));
	const __m256 r1 = ew_ring_rows_avx2f(EW_FLOATS(start[1]), EW_FLOATS(start[5]));
	const __m256 r2 = ew_ring_rows_avx2f(EW_FLOATS(start[2]), EW_FLOATS(start[6]));
	const __m256 r3 = ew_ring_rows_avx2f(EW_FLOATS(start[3]), EW_FLOATS(start[7]));
	const __m256 low01 = _mm256_unpacklo_ps(r0, r1), high01 = _mm256_unpackhi_ps(r0, r1);
	const __m256 low23 = _mm256_unpacklo_ps(r2, r3), high23 = _mm256_unpackhi_ps(r2, r3);
	column[0] = _mm256_shuffle_ps(low01, low23, 0x44);
	column[1] = _mm256_shuffle_ps(low01, low23, 0xee);
	column[2] = _mm256_shuffle_ps(high01, high23, 0x44);
	column[3] = _mm256_shuffle_ps(high01, high23, 0xee);
}

#define EW_ISA(stem) ew_ring_##stem##_avx2f
#define EW_ITEM(degree) ew_ring_moments_##degree##_item_avx2f
#define EW_DIVIDE ew_ring_divide_avx2
#define EW_VECTOR __m256
#define EW_ATTRIBUTE EW_ATTRIBUTE_AVX2
#define EW_ROWS 8
#define EW_STARTS EW_STARTS_8
#define EW_COUNTS __m256i
#define EW_OVER(s) _mm256_sub_epi32(_mm256_loadu_si256((const __m256i *)(s + 1)), \
	_mm256_add_epi32(_mm256_loadu_si256((const __m256i *)(s)), _mm256_set1_epi32(3)))
#define EW_SAME(n, m) (_mm256_movemask_epi8(_mm256_cmpeq_epi32(n, _mm256_set1_epi32(m))) == -1)
#define EW_MOST(n) ew_ring_most8(n)
#define EW_LENGTHS(n) _mm256_cvtepi32_ps(n)
#define EW_COLUMNS 4
#define EW_MORE(X) X(2) X(3)
#define EW_LOAD(p) _mm256_loadu_ps(p)
#define EW_STORE(p, v) _mm256_storeu_ps(p, v)
#define EW_STORE_WIDE(p, v) \
	do { \
		_mm256_storeu_pd(p, _mm256_cvtps_pd(_mm256_castps256_ps128(v))); \
		_mm256_storeu_pd((p) + 4, _mm256_cvtps_pd(_mm256_extractf128_ps(v, 1))); \
	} while (0)
#define EW_SPLAT(a) _mm256_set1_ps(a)
#define EW_ADD(a, b) _mm256_add_ps(a, b)
#define EW_SUB(a, b) _mm256_sub_ps(a, b)
#define EW_SELECT(length, c, v, first) \
	_mm256_blendv_ps(first, v, _mm256_cmp_ps(length, c, _CMP_GT_OQ))
#define EW_EVEN(a, b) _mm256_castpd_ps(_mm256_permute4x64_pd( \
	_mm256_castps_pd(_mm256_shuffle_ps(a, b, 0x88)), 0xd8))
#define EW_IS_FLOAT 1
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT
#endif
#endif

#if EW_BUILD_AVX512
#include "edgewise_items_avx512.h"

EW_ATTRIBUTE_AVX512 static void ew_ring_divide_avx512(const double *a, const double *b,
	const double *c, size_t count, double *to)
{
	for (size_t i = 0; i < count; i += 8)
		_mm512_storeu_pd(to + i, _mm512_add_pd(_mm512_loadu_pd(c + i),
			_mm512_div_pd(_mm512_loadu_pd(a + i), _mm512_loadu_pd(b + i))));
}

/* maskz below: some compilers warn about the undefined operand inside the plain intrinsic.
 *
 * Four pairs or quadruples of numbers, one in each quarter of a register: put together from halves,
 * which is cheaper than anything that works on whole registers. */
EW_ATTRIBUTE_AVX512 EW_INLINE __m256 ew_ring_halves_avx512(const float *a, const float *b)
{
	return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(a)), _mm_loadu_ps(b), 1);
}

EW_ATTRIBUTE_AVX512 EW_INLINE __m512 ew_ring_quarters_avx512(const float *a, const float *b,
	const float *c, const float *d)
{
	return _mm512_castpd_ps(_mm512_maskz_insertf64x4(0xff,
		_mm512_castps_pd(_mm512_castps256_ps512(ew_ring_halves_avx512(a, b))),
		_mm256_castps_pd(ew_ring_halves_avx512(c, d)), 1));
}

#ifdef EW_HAS_DOUBLE
EW_ATTRIBUTE_AVX512 EW_INLINE __m512d ew_ring_pairs_avx512(const double *from,
	const size_t *start)
{
	return _mm512_castps_pd(ew_ring_quarters_avx512(EW_FLOATS(start[0]),
		EW_FLOATS(start[2]), EW_FLOATS(start[4]),
		EW_FLOATS(start[6])));
}

EW_ATTRIBUTE_AVX512 EW_INLINE void ew_ring_block_avx512(const double *from, const size_t *start,
	__m512d column[2])
{
	const __m512d even = ew_ring_pairs_avx512(from, start);
	const __m512d odd = ew_ring_pairs_avx512(from, start + 1);
	column[0] = _mm512_maskz_unpacklo_pd(0xff, even, odd);
	column[1] = _mm512_maskz_unpackhi_pd(0xff, even, odd);
}

#define EW_ISA(stem) ew_ring_##stem##_avx512
#define EW_ITEM(degree) ew_ring_moments_##degree##_item_avx512
#define EW_DIVIDE ew_ring_divide_avx512
#define EW_VECTOR __m512d
#define EW_ATTRIBUTE EW_ATTRIBUTE_AVX512
#define EW_ROWS 8
#define EW_STARTS EW_STARTS_8
#define EW_COUNTS __m256i
#define EW_OVER(s) _mm256_sub_epi32(_mm256_loadu_si256((const __m256i *)(s + 1)), \
	_mm256_add_epi32(_mm256_loadu_si256((const __m256i *)(s)), _mm256_set1_epi32(3)))
#define EW_SAME(n, m) (_mm256_movemask_epi8(_mm256_cmpeq_epi32(n, _mm256_set1_epi32(m))) == -1)
#define EW_MOST(n) ew_ring_most8(n)
#define EW_LENGTHS(n) _mm512_maskz_cvtepi32_pd(0xff, n)
#define EW_COLUMNS 2
#define EW_MORE(X)
#define EW_LOAD(p) _mm512_loadu_pd(p)
#define EW_STORE(p, v) _mm512_storeu_pd(p, v)
#define EW_STORE_WIDE(p, v) EW_STORE(p, v)
#define EW_SPLAT(a) _mm512_set1_pd(a)
#define EW_ADD(a, b) _mm512_add_pd(a, b)
#define EW_SUB(a, b) _mm512_sub_pd(a, b)
#define EW_SELECT(length, c, v, first) \
	_mm512_mask_blend_pd(_mm512_cmp_pd_mask(length, c, _CMP_GT_OQ), first, v)
#define EW_EVEN(a, b) _mm512_permutex2var_pd(a, \
	_mm512_set_epi64(14, 12, 10, 8, 6, 4, 2, 0), b)
#define EW_IS_FLOAT 0
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT
#endif

#ifdef EW_HAS_FLOAT
#define ew_ring_half_avx512(v, half) _mm512_maskz_cvtps_pd(0xff, \
	_mm256_castpd_ps(_mm512_maskz_extractf64x4_pd(0xff, _mm512_castps_pd(v), half)))

EW_ATTRIBUTE_AVX512 EW_INLINE __m512 ew_ring_rows_avx512f(const float *from, const size_t *start)
{
	return ew_ring_quarters_avx512(EW_FLOATS(start[0]), EW_FLOATS(start[4]),
		EW_FLOATS(start[8]), EW_FLOATS(start[12]));
}

EW_ATTRIBUTE_AVX512 EW_INLINE void ew_ring_block_avx512f(const float *from, const size_t *start,
	__m512 column[4])
{
	const __m512 r0 = ew_ring_rows_avx512f(from, start);
	const __m512 r1 = ew_ring_rows_avx512f(from, start + 1);
	const __m512 r2 = ew_ring_rows_avx512f(from, start + 2);
	const __m512 r3 = ew_ring_rows_avx512f(from, start + 3);
	const __m512 low01 = _mm512_maskz_unpacklo_ps(0xffff, r0, r1);
	const __m512 high01 = _mm512_maskz_unpackhi_ps(0xffff, r0, r1);
	const __m512 low23 = _mm512_maskz_unpacklo_ps(0xffff, r2, r3);
	const __m512 high23 = _mm512_maskz_unpackhi_ps(0xffff, r2, r3);
	column[0] = _mm512_shuffle_ps(low01, low23, 0x44);
	column[1] = _mm512_shuffle_ps(low01, low23, 0xee);
	column[2] = _mm512_shuffle_ps(high01, high23, 0x44);
	column[3] = _mm512_shuffle_ps(high01, high23, 0xee);
}

#define EW_ISA(stem) ew_ring_##stem##_avx512f
#define EW_ITEM(degree) ew_ring_moments_##degree##_item_avx512f
#define EW_DIVIDE ew_ring_divide_avx512
#define EW_VECTOR __m512
#define EW_ATTRIBUTE EW_ATTRIBUTE_AVX512
#define EW_ROWS 16
#define EW_STARTS EW_STARTS_16
#define EW_COUNTS __m512i
#define EW_OVER(s) _mm512_sub_epi32(_mm512_loadu_si512(s + 1), \
	_mm512_add_epi32(_mm512_loadu_si512(s), _mm512_set1_epi32(3)))
#define EW_SAME(n, m) (_mm512_cmpeq_epi32_mask(n, _mm512_set1_epi32(m)) == 0xffff)
#define EW_MOST(n) ew_ring_most8(_mm256_max_epu32( \
	_mm512_maskz_extracti64x4_epi64(0xff, n, 0), _mm512_maskz_extracti64x4_epi64(0xff, n, 1)))
#define EW_LENGTHS(n) _mm512_maskz_cvtepi32_ps(0xffff, n)
#define EW_COLUMNS 4
#define EW_MORE(X) X(2) X(3)
#define EW_LOAD(p) _mm512_loadu_ps(p)
#define EW_STORE(p, v) _mm512_storeu_ps(p, v)
#define EW_STORE_WIDE(p, v) \
	do { \
		_mm512_storeu_pd(p, ew_ring_half_avx512(v, 0)); \
		_mm512_storeu_pd((p) + 8, ew_ring_half_avx512(v, 1)); \
	} while (0)
#define EW_SPLAT(a) _mm512_set1_ps(a)
#define EW_ADD(a, b) _mm512_add_ps(a, b)
#define EW_SUB(a, b) _mm512_sub_ps(a, b)
#define EW_SELECT(length, c, v, first) \
	_mm512_mask_blend_ps(_mm512_cmp_ps_mask(length, c, _CMP_GT_OQ), first, v)
#define EW_EVEN(a, b) _mm512_permutex2var_ps(a, \
	_mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0), b)
#define EW_IS_FLOAT 1
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT
#endif
#endif

#if EW_BUILD_NEON
#include <arm_neon.h>
#include "edgewise_items_neon.h"

static void ew_ring_divide_neon(const double *a, const double *b, const double *c, size_t count,
	double *to)
{
	for (size_t i = 0; i < count; i += 2)
		vst1q_f64(to + i, vaddq_f64(vld1q_f64(c + i),
			vdivq_f64(vld1q_f64(a + i), vld1q_f64(b + i))));
}

#ifdef EW_HAS_DOUBLE
EW_INLINE void ew_ring_block_neon(const double *from, const size_t *start, float64x2_t column[2])
{
	const float64x2_t r0 = vld1q_f64(EW_DOUBLES(start[0]));
	const float64x2_t r1 = vld1q_f64(EW_DOUBLES(start[1]));
	column[0] = vzip1q_f64(r0, r1);
	column[1] = vzip2q_f64(r0, r1);
}

#define EW_ISA(stem) ew_ring_##stem##_neon
#define EW_ITEM(degree) ew_ring_moments_##degree##_item_neon
#define EW_DIVIDE ew_ring_divide_neon
#define EW_VECTOR float64x2_t
#define EW_ATTRIBUTE EW_ATTRIBUTE_NEON
#define EW_ROWS 2
#define EW_STARTS EW_STARTS_2
#define EW_COUNTS int32x2_t
#define EW_OVER(s) vsub_s32(vld1_s32(s + 1), vadd_s32(vld1_s32(s), vdup_n_s32(3)))
#define EW_SAME(n, m) (vget_lane_s32(n, 1) == (m))
#define EW_MOST(n) vmaxv_u32(vreinterpret_u32_s32(n))
#define EW_LENGTHS(n) vcvtq_f64_s64(vmovl_s32(n))
#define EW_COLUMNS 2
#define EW_MORE(X)
#define EW_LOAD(p) vld1q_f64(p)
#define EW_STORE(p, v) vst1q_f64(p, v)
#define EW_STORE_WIDE(p, v) EW_STORE(p, v)
#define EW_SPLAT(a) vdupq_n_f64(a)
#define EW_ADD(a, b) vaddq_f64(a, b)
#define EW_SUB(a, b) vsubq_f64(a, b)
#define EW_SELECT(length, c, v, first) vbslq_f64(vcgtq_f64(length, c), v, first)
#define EW_EVEN(a, b) vuzp1q_f64(a, b)
#define EW_IS_FLOAT 0
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT
#endif

#ifdef EW_HAS_FLOAT
EW_INLINE void ew_ring_block_neonf(const float *from, const size_t *start, float32x4_t column[4])
{
	const float32x4_t r0 = vld1q_f32(EW_FLOATS(start[0])), r1 = vld1q_f32(EW_FLOATS(start[1]));
	const float32x4_t r2 = vld1q_f32(EW_FLOATS(start[2])), r3 = vld1q_f32(EW_FLOATS(start[3]));
	const float64x2_t even01 = vreinterpretq_f64_f32(vtrn1q_f32(r0, r1));
	const float64x2_t even23 = vreinterpretq_f64_f32(vtrn1q_f32(r2, r3));
	const float64x2_t odd01 = vreinterpretq_f64_f32(vtrn2q_f32(r0, r1));
	const float64x2_t odd23 = vreinterpretq_f64_f32(vtrn2q_f32(r2, r3));
	column[0] = vreinterpretq_f32_f64(vzip1q_f64(even01, even23));
	column[1] = vreinterpretq_f32_f64(vzip1q_f64(odd01, odd23));
	column[2] = vreinterpretq_f32_f64(vzip2q_f64(even01, even23));
	column[3] = vreinterpretq_f32_f64(vzip2q_f64(odd01, odd23));
}

#define EW_ISA(stem) ew_ring_##stem##_neonf
#define EW_ITEM(degree) ew_ring_moments_##degree##_item_neonf
#define EW_DIVIDE ew_ring_divide_neon
#define EW_VECTOR float32x4_t
#define EW_ATTRIBUTE EW_ATTRIBUTE_NEON
#define EW_ROWS 4
#define EW_STARTS EW_STARTS_4
#define EW_COUNTS int32x4_t
#define EW_OVER(s) vsubq_s32(vld1q_s32(s + 1), vaddq_s32(vld1q_s32(s), vdupq_n_s32(3)))
#define EW_SAME(n, m) \
	(vminvq_u32(vceqq_s32(n, vdupq_n_s32(m))) != 0)
#define EW_MOST(n) vmaxvq_u32(vreinterpretq_u32_s32(n))
#define EW_LENGTHS(n) vcvtq_f32_s32(n)
#define EW_COLUMNS 4
#define EW_MORE(X) X(2) X(3)
#define EW_LOAD(p) vld1q_f32(p)
#define EW_STORE(p, v) vst1q_f32(p, v)
#define EW_STORE_WIDE(p, v) \
	do { \
		vst1q_f64(p, vcvt_f64_f32(vget_low_f32(v))); \
		vst1q_f64((p) + 2, vcvt_high_f64_f32(v)); \
	} while (0)
#define EW_SPLAT(a) vdupq_n_f32(a)
#define EW_ADD(a, b) vaddq_f32(a, b)
#define EW_SUB(a, b) vsubq_f32(a, b)
#define EW_SELECT(length, c, v, first) vbslq_f32(vcgtq_f32(length, c), v, first)
#define EW_EVEN(a, b) vuzp1q_f32(a, b)
#define EW_IS_FLOAT 1
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT
#endif
#endif

#if EW_BUILD_WASM128
#include <wasm_simd128.h>
#include "edgewise_items_wasm128.h"

static void ew_ring_divide_wasm128(const double *a, const double *b, const double *c, size_t count,
	double *to)
{
	for (size_t i = 0; i < count; i += 2)
		wasm_v128_store(to + i, wasm_f64x2_add(wasm_v128_load(c + i),
			wasm_f64x2_div(wasm_v128_load(a + i), wasm_v128_load(b + i))));
}

#ifdef EW_MAX_DEGREE
EW_INLINE uint32_t ew_ring_most_wasm128(v128_t n)
{
	n = wasm_u32x4_max(n, wasm_i32x4_shuffle(n, n, 2, 3, 0, 1));
	n = wasm_u32x4_max(n, wasm_i32x4_shuffle(n, n, 1, 0, 3, 2));
	return wasm_u32x4_extract_lane(n, 0);
}
#endif

#ifdef EW_HAS_DOUBLE
EW_INLINE void ew_ring_block_wasm128(const double *from, const size_t *start, v128_t column[2])
{
	const v128_t r0 = wasm_v128_load(EW_DOUBLES(start[0]));
	const v128_t r1 = wasm_v128_load(EW_DOUBLES(start[1]));
	column[0] = wasm_i64x2_shuffle(r0, r1, 0, 2);
	column[1] = wasm_i64x2_shuffle(r0, r1, 1, 3);
}

#define EW_ISA(stem) ew_ring_##stem##_wasm128
#define EW_ITEM(degree) ew_ring_moments_##degree##_item_wasm128
#define EW_DIVIDE ew_ring_divide_wasm128
#define EW_VECTOR v128_t
#define EW_ATTRIBUTE EW_ATTRIBUTE_WASM128
#define EW_ROWS 2
#define EW_STARTS EW_STARTS_2
#define EW_COUNTS v128_t
#define EW_OVER(s) wasm_i32x4_sub(wasm_v128_load64_zero(s + 1), \
	wasm_i32x4_add(wasm_v128_load64_zero(s), wasm_i32x4_make(3, 3, 0, 0)))
#define EW_SAME(n, m) (wasm_i32x4_extract_lane(n, 1) == (m))
#define EW_MOST(n) ew_ring_most_wasm128(n)
#define EW_LENGTHS(n) wasm_f64x2_convert_low_i32x4(n)
#define EW_COLUMNS 2
#define EW_MORE(X)
#define EW_LOAD(p) wasm_v128_load(p)
#define EW_STORE(p, v) wasm_v128_store(p, v)
#define EW_STORE_WIDE(p, v) EW_STORE(p, v)
#define EW_SPLAT(a) wasm_f64x2_splat(a)
#define EW_ADD(a, b) wasm_f64x2_add(a, b)
#define EW_SUB(a, b) wasm_f64x2_sub(a, b)
#define EW_SELECT(length, c, v, first) wasm_v128_bitselect(v, first, wasm_f64x2_gt(length, c))
#define EW_EVEN(a, b) wasm_i64x2_shuffle(a, b, 0, 2)
#define EW_IS_FLOAT 0
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT
#endif

#ifdef EW_HAS_FLOAT
EW_INLINE void ew_ring_block_wasm128f(const float *from, const size_t *start, v128_t column[4])
{
	const v128_t r0 = wasm_v128_load(EW_FLOATS(start[0]));
	const v128_t r1 = wasm_v128_load(EW_FLOATS(start[1]));
	const v128_t r2 = wasm_v128_load(EW_FLOATS(start[2]));
	const v128_t r3 = wasm_v128_load(EW_FLOATS(start[3]));
	const v128_t low01 = wasm_i32x4_shuffle(r0, r1, 0, 4, 1, 5);
	const v128_t high01 = wasm_i32x4_shuffle(r0, r1, 2, 6, 3, 7);
	const v128_t low23 = wasm_i32x4_shuffle(r2, r3, 0, 4, 1, 5);
	const v128_t high23 = wasm_i32x4_shuffle(r2, r3, 2, 6, 3, 7);
	column[0] = wasm_i64x2_shuffle(low01, low23, 0, 2);
	column[1] = wasm_i64x2_shuffle(low01, low23, 1, 3);
	column[2] = wasm_i64x2_shuffle(high01, high23, 0, 2);
	column[3] = wasm_i64x2_shuffle(high01, high23, 1, 3);
}

#define EW_ISA(stem) ew_ring_##stem##_wasm128f
#define EW_ITEM(degree) ew_ring_moments_##degree##_item_wasm128f
#define EW_DIVIDE ew_ring_divide_wasm128
#define EW_VECTOR v128_t
#define EW_ATTRIBUTE EW_ATTRIBUTE_WASM128
#define EW_ROWS 4
#define EW_STARTS EW_STARTS_4
#define EW_COUNTS v128_t
#define EW_OVER(s) wasm_i32x4_sub(wasm_v128_load(s + 1), \
	wasm_i32x4_add(wasm_v128_load(s), wasm_i32x4_splat(3)))
#define EW_SAME(n, m) wasm_i32x4_all_true(wasm_i32x4_eq(n, wasm_i32x4_splat(m)))
#define EW_MOST(n) ew_ring_most_wasm128(n)
#define EW_LENGTHS(n) wasm_f32x4_convert_i32x4(n)
#define EW_COLUMNS 4
#define EW_MORE(X) X(2) X(3)
#define EW_LOAD(p) wasm_v128_load(p)
#define EW_STORE(p, v) wasm_v128_store(p, v)
#define EW_STORE_WIDE(p, v) \
	do { \
		wasm_v128_store(p, wasm_f64x2_promote_low_f32x4(v)); \
		wasm_v128_store((p) + 2, wasm_f64x2_promote_low_f32x4( \
			wasm_i64x2_shuffle(v, v, 1, 1))); \
	} while (0)
#define EW_SPLAT(a) wasm_f32x4_splat(a)
#define EW_ADD(a, b) wasm_f32x4_add(a, b)
#define EW_SUB(a, b) wasm_f32x4_sub(a, b)
#define EW_SELECT(length, c, v, first) wasm_v128_bitselect(v, first, wasm_f32x4_gt(length, c))
#define EW_EVEN(a, b) wasm_i32x4_shuffle(a, b, 0, 2, 4, 6)
#define EW_IS_FLOAT 1
#include "edgewise_columns_template.h"
#undef EW_IS_FLOAT
#endif
#endif

#define ew_ring_columns_portable ew_ring_columns_scalar
#define ew_ring_columns_fma ew_ring_columns_scalar
#define ew_ring_columns_portablef ew_ring_columns_scalarf
#define ew_ring_columns_fmaf ew_ring_columns_scalarf

#ifdef EW_HAS_DOUBLE
const ew_ring_columns *ew_ring_by_columns(unsigned used)
{
#define EW_CASE(TARGET, target, doubles) case EW_##TARGET: return &ew_ring_columns_##target;
	switch (used) {
	EW_TARGETS(EW_CASE)
	default: return NULL;          /* no such target is ever in use */
	}
#undef EW_CASE
}
#endif

#ifdef EW_HAS_FLOAT
const ew_ring_columnsf *ew_ring_by_columnsf(unsigned used)
{
#define EW_CASE(TARGET, target, doubles) case EW_##TARGET: return &ew_ring_columns_##target##f;
	switch (used) {
	EW_TARGETS(EW_CASE)
	default: return NULL;
	}
#undef EW_CASE
}
#endif

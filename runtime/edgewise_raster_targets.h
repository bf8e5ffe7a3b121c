/* edgewise_raster_targets.h - what targets do by vectors for images; part of edgewise_raster.c.
 *
 * Sweeps (edgewise_raster_sweep_template.h): INTS a vector of INT_LANES integers, GROUP_INTS of
 * them are 16 pixels; EACH_OF_STRIP goes over those of 64. Edges side by side
 * (edgewise_raster_lanes.h) take four lanes of double: longer vectors are filled worse, because
 * most edges are done after two or three cells, and gain nothing.
 *
 * Part of the runtime that gen emits. SPDX-License-Identifier: 0BSD */

#if EW_BUILD_AVX2 || EW_BUILD_AVX512
#include <immintrin.h>
#include "edgewise_raster_lanes.h"
#endif

#if EW_BUILD_AVX2
EW_ATTRIBUTE_AVX2 EW_INLINE __m256i ew_raster_255_avx2(__m256i sum)
{
	const __m256i size = _mm256_min_epu32(_mm256_abs_epi32(sum), _mm256_set1_epi32(EW_ONE));
	return _mm256_srli_epi32(_mm256_add_epi32(_mm256_mullo_epi32(size,
		_mm256_set1_epi32(255)), _mm256_set1_epi32(EW_ONE / 2)), EW_GRID);
}

EW_ATTRIBUTE_AVX2 EW_INLINE void ew_raster_put_bytes_avx2(unsigned char *to, __m256i a, __m256i b)
{
	const __m256i words = _mm256_permute4x64_epi64(_mm256_packs_epi32(
		ew_raster_255_avx2(a), ew_raster_255_avx2(b)), 0xd8);
	_mm_storeu_si128((__m128i *)(void *)to, _mm_packus_epi16(_mm256_castsi256_si128(words),
		_mm256_extracti128_si256(words, 1)));
}

#define EW_ISA(stem) ew_raster_##stem##_avx2
#define EW_ATTRIBUTE EW_ATTRIBUTE_AVX2
#define EW_INTS __m256i
#define EW_INT_LANES 8
#define EW_GROUP_INTS 2
#define EW_EACH_OF_STRIP(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7)
#define EW_ZERO_INTS _mm256_setzero_si256()
#define EW_LOAD_INTS(p) _mm256_loadu_si256((const __m256i *)(const void *)(p))
#define EW_STORE_INTS(p, v) _mm256_storeu_si256((__m256i *)(void *)(p), v)
#define EW_ADD_INTS(a, b) _mm256_add_epi32(a, b)
#define EW_FLOATS_TYPE __m256
#define EW_SPLAT_FLOAT(a) _mm256_set1_ps(a)
#define EW_PUT_FLOATS(p, v) _mm256_storeu_ps(p, _mm256_mul_ps(_mm256_cvtepi32_ps(v), unit))
#define EW_PUT_BYTES(p, v) ew_raster_put_bytes_avx2(p, (v)[0], (v)[1])
#include "edgewise_raster_sweep_template.h"
#endif

#if EW_BUILD_AVX512
EW_ATTRIBUTE_AVX512 EW_INLINE void ew_raster_put_bytes_avx512(unsigned char *to, __m512i sum)
{
	const __m512i size = _mm512_maskz_min_epu32(0xffff, _mm512_maskz_abs_epi32(0xffff, sum),
		_mm512_set1_epi32(EW_ONE));
	_mm_storeu_si128((__m128i *)(void *)to, _mm512_maskz_cvtepi32_epi8(0xffff,
		_mm512_maskz_srli_epi32(0xffff, _mm512_add_epi32(_mm512_mullo_epi32(size,
		_mm512_set1_epi32(255)), _mm512_set1_epi32(EW_ONE / 2)), EW_GRID)));
}

#define EW_ISA(stem) ew_raster_##stem##_avx512
#define EW_ATTRIBUTE EW_ATTRIBUTE_AVX512
#define EW_INTS __m512i
#define EW_INT_LANES 16
#define EW_GROUP_INTS 1
#define EW_EACH_OF_STRIP(X) X(0) X(1) X(2) X(3)
#define EW_ZERO_INTS _mm512_setzero_si512()
#define EW_LOAD_INTS(p) _mm512_loadu_si512(p)
#define EW_STORE_INTS(p, v) _mm512_storeu_si512(p, v)
#define EW_ADD_INTS(a, b) _mm512_add_epi32(a, b)
#define EW_FLOATS_TYPE __m512
#define EW_SPLAT_FLOAT(a) _mm512_set1_ps(a)
#define EW_PUT_FLOATS(p, v) _mm512_storeu_ps(p, _mm512_mul_ps( \
	_mm512_maskz_cvtepi32_ps(0xffff, v), unit))
#define EW_PUT_BYTES(p, v) ew_raster_put_bytes_avx512(p, (v)[0])
#include "edgewise_raster_sweep_template.h"
#endif

#if EW_BUILD_NEON
#include <arm_neon.h>

EW_INLINE uint16x4_t ew_raster_255_neon(int32x4_t sum)
{
	const uint32x4_t size = vminq_u32(vreinterpretq_u32_s32(vabsq_s32(sum)),
		vdupq_n_u32(EW_ONE));
	return vmovn_u32(vshrq_n_u32(vmlaq_n_u32(vdupq_n_u32(EW_ONE / 2), size, 255), EW_GRID));
}

EW_INLINE void ew_raster_put_bytes_neon(unsigned char *to, const int32x4_t *sum)
{
	vst1q_u8(to, vcombine_u8(
		vmovn_u16(vcombine_u16(ew_raster_255_neon(sum[0]), ew_raster_255_neon(sum[1]))),
		vmovn_u16(vcombine_u16(ew_raster_255_neon(sum[2]), ew_raster_255_neon(sum[3])))));
}

#define EW_ISA(stem) ew_raster_##stem##_neon
#define EW_ATTRIBUTE EW_ATTRIBUTE_NEON
#define EW_INTS int32x4_t
#define EW_INT_LANES 4
#define EW_GROUP_INTS 4
#define EW_EACH_OF_STRIP(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) \
	X(13) X(14) X(15)
#define EW_ZERO_INTS vdupq_n_s32(0)
#define EW_LOAD_INTS(p) vld1q_s32(p)
#define EW_STORE_INTS(p, v) vst1q_s32(p, v)
#define EW_ADD_INTS(a, b) vaddq_s32(a, b)
#define EW_FLOATS_TYPE float32x4_t
#define EW_SPLAT_FLOAT(a) vdupq_n_f32(a)
#define EW_PUT_FLOATS(p, v) vst1q_f32(p, vmulq_f32(vcvtq_f32_s32(v), unit))
#define EW_PUT_BYTES(p, v) ew_raster_put_bytes_neon(p, v)
#include "edgewise_raster_sweep_template.h"
#endif

#if EW_BUILD_WASM128
#include <wasm_simd128.h>

EW_INLINE v128_t ew_raster_255_wasm128(v128_t sum)
{
	const v128_t size = wasm_u32x4_min(wasm_i32x4_abs(sum), wasm_i32x4_splat(EW_ONE));
	return wasm_u32x4_shr(wasm_i32x4_add(wasm_i32x4_mul(size, wasm_i32x4_splat(255)),
		wasm_i32x4_splat(EW_ONE / 2)), EW_GRID);
}

EW_INLINE void ew_raster_put_bytes_wasm128(unsigned char *to, const v128_t *sum)
{
	wasm_v128_store(to, wasm_u8x16_narrow_i16x8(
		wasm_u16x8_narrow_i32x4(ew_raster_255_wasm128(sum[0]), ew_raster_255_wasm128(sum[1])),
		wasm_u16x8_narrow_i32x4(ew_raster_255_wasm128(sum[2]),
			ew_raster_255_wasm128(sum[3]))));
}

#define EW_ISA(stem) ew_raster_##stem##_wasm128
#define EW_ATTRIBUTE EW_ATTRIBUTE_WASM128
#define EW_INTS v128_t
#define EW_INT_LANES 4
#define EW_GROUP_INTS 4
#define EW_EACH_OF_STRIP(X) X(0) X(1) X(2) X(3) X(4) X(5) X(6) X(7) X(8) X(9) X(10) X(11) X(12) \
	X(13) X(14) X(15)
#define EW_ZERO_INTS wasm_i32x4_splat(0)
#define EW_LOAD_INTS(p) wasm_v128_load(p)
#define EW_STORE_INTS(p, v) wasm_v128_store(p, v)
#define EW_ADD_INTS(a, b) wasm_i32x4_add(a, b)
#define EW_FLOATS_TYPE v128_t
#define EW_SPLAT_FLOAT(a) wasm_f32x4_splat(a)
#define EW_PUT_FLOATS(p, v) \
	wasm_v128_store(p, wasm_f32x4_mul(wasm_f32x4_convert_i32x4(v), unit))
#define EW_PUT_BYTES(p, v) ew_raster_put_bytes_wasm128(p, v)
#include "edgewise_raster_sweep_template.h"
#endif

#define EW_WAYS(name, lanes, edges, sweep) \
	static const ew_raster_ways ew_raster_ways_##name = { \
		ew_raster_round_##lanes, ew_raster_roundf_##lanes, ew_raster_edges_##edges, \
		ew_raster_finish_##lanes, ew_raster_scatter_##lanes, \
		ew_raster_floats_##sweep, ew_raster_bytes_##sweep \
	};
EW_WAYS(scalar, scalar, scalar, scalar)
EW_WAYS(general, scalar, general, scalar)
#if EW_BUILD_AVX2
EW_WAYS(avx2, avx2, avx2, avx2)
#endif
#if EW_BUILD_AVX512
EW_WAYS(avx512, avx2, avx2, avx512)
#endif
#if EW_BUILD_NEON
EW_WAYS(neon, scalar, scalar, neon)
#endif
#if EW_BUILD_WASM128
EW_WAYS(wasm128, scalar, scalar, wasm128)
#endif
#undef EW_WAYS

static const ew_raster_ways *ew_raster_by_target(unsigned used)
{
#define ew_raster_ways_portable ew_raster_ways_scalar
#define ew_raster_ways_fma ew_raster_ways_scalar
#define EW_CASE(TARGET, target, doubles) case EW_##TARGET: return &ew_raster_ways_##target;
	switch (used) {
	EW_TARGETS(EW_CASE)
	default: return NULL;          /* no such target is ever in use */
	}
#undef EW_CASE
}

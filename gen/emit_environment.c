/* emit_environment.c - what every emitted kernel needs around it: protection against contraction
 * and wide arithmetic, which targets a compiler can build, and the operations that no single
 * expression or intrinsic spells (ops.def names them).
 *
 * Those have the same bits everywhere: max and choose are comparisons and selections, and the
 * exponent of a number is taken from its bits, relative to those of sqrt(1/2). */
#include "gen.h"

/* Scalar operations of one precision; root: the bits of sqrt 1/2. */
typedef struct {
	const char *real, *suffix, *bits, *integer;
	int mantissa;
	const char *root;
} Format;

static const Format formats[] = {
	{ "double", "", "uint64_t", "int64_t", 52, "0x3fe6a09e667f3bcd" },
	{ "float", "f", "uint32_t", "int32_t", 23, "0x3f3504f3" },
};

static void add_scalar(Text *text, const Format *f)
{
	const char *real = f->real, *suffix = f->suffix;
	text_add(text, "static inline %s ew_ring_max%s(%s a, %s b)\n{\n\treturn a > b ? a : b;\n}\n",
		real, suffix, real, real);
	text_add(text, "static inline %s ew_ring_min%s(%s a, %s b)\n{\n\treturn a < b ? a : b;\n}\n",
		real, suffix, real, real);
	text_add(text, "static inline %s ew_ring_choose%s(%s a, %s b, %s c)\n{\n"
		"\treturn a > 0 ? b : c;\n}\n", real, suffix, real, real, real);
	text_add(text, "static inline %s ew_ring_bits%s(%s a)\n{\n\t%s bits;\n"
		"\tmemcpy(&bits, &a, sizeof bits);\n\treturn bits - %s;\n}\n",
		f->bits, suffix, real, f->bits, f->root);
	text_add(text, "static inline %s ew_ring_exponent%s(%s a)\n{\n"
		"\treturn EW_CAST(%s, EW_CAST(%s, ew_ring_bits%s(a) >> %d));\n}\n",
		real, suffix, real, real, f->integer, suffix, f->mantissa);
	text_add(text, "static inline %s ew_ring_fraction%s(%s a)\n{\n"
		"\tconst %s above = ew_ring_bits%s(a), bits = above - (above >> %d << %d) + %s;\n"
		"\tmemcpy(&a, &bits, sizeof a);\n\treturn a;\n}\n", real, suffix, real,
		f->bits, suffix, f->mantissa, f->mantissa, f->root);
}

/* Before AVX-512DQ 64-bit integers have no conversion: 2^52 + k has k in its last bits. */
static const char *const X86 =
	"#define EW_LEAST_pd DBL_MIN\n"
	"#define EW_LEAST_ps FLT_MIN\n"
	"#define EW_ABS_mm256_pd(a) _mm256_andnot_pd(_mm256_set1_pd(-0.0), a)\n"
	"#define EW_ABS_mm256_ps(a) _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a)\n"
	"#define EW_ABS_mm512_pd(a) _mm512_abs_pd(a)\n"
	"#define EW_ABS_mm512_ps(a) _mm512_abs_ps(a)\n"
	/* maskz: some compilers warn about the undefined operand inside the plain intrinsic */
	"#define EW_SQRT_mm256_pd(a) _mm256_sqrt_pd(a)\n"
	"#define EW_SQRT_mm256_ps(a) _mm256_sqrt_ps(a)\n"
	"#define EW_SQRT_mm512_pd(a) _mm512_maskz_sqrt_pd(0xff, a)\n"
	"#define EW_SQRT_mm512_ps(a) _mm512_maskz_sqrt_ps(0xffff, a)\n"
	"#define EW_MAX_mm256_pd(a, b) _mm256_max_pd(a, b)\n"
	"#define EW_MIN_mm256_pd(a, b) _mm256_min_pd(a, b)\n"
	"#define EW_MAX_mm256_ps(a, b) _mm256_max_ps(a, b)\n"
	"#define EW_MIN_mm256_ps(a, b) _mm256_min_ps(a, b)\n"
	"#define EW_MAX_mm512_pd(a, b) _mm512_maskz_max_pd(0xff, a, b)\n"
	"#define EW_MIN_mm512_pd(a, b) _mm512_maskz_min_pd(0xff, a, b)\n"
	"#define EW_MAX_mm512_ps(a, b) _mm512_maskz_max_ps(0xffff, a, b)\n"
	"#define EW_MIN_mm512_ps(a, b) _mm512_maskz_min_ps(0xffff, a, b)\n"
	"#define EW_CHOOSE_mm256_pd(a, b, c) _mm256_blendv_pd(c, b, \\\n"
	"\t_mm256_cmp_pd(a, _mm256_setzero_pd(), _CMP_GT_OQ))\n"
	"#define EW_CHOOSE_mm256_ps(a, b, c) _mm256_blendv_ps(c, b, \\\n"
	"\t_mm256_cmp_ps(a, _mm256_setzero_ps(), _CMP_GT_OQ))\n"
	"#define EW_CHOOSE_mm512_pd(a, b, c) _mm512_mask_blend_pd( \\\n"
	"\t_mm512_cmp_pd_mask(a, _mm512_setzero_pd(), _CMP_GT_OQ), c, b)\n"
	"#define EW_CHOOSE_mm512_ps(a, b, c) _mm512_mask_blend_ps( \\\n"
	"\t_mm512_cmp_ps_mask(a, _mm512_setzero_ps(), _CMP_GT_OQ), c, b)\n"
	"#define EW_BITS_mm256_pd(a) _mm256_sub_epi64(_mm256_castpd_si256(a), \\\n"
	"\t_mm256_set1_epi64x(0x3fe6a09e667f3bcd))\n"
	"#define EW_BITS_mm256_ps(a) _mm256_sub_epi32(_mm256_castps_si256(a), \\\n"
	"\t_mm256_set1_epi32(0x3f3504f3))\n"
	"#define EW_BITS_mm512_pd(a) _mm512_sub_epi64(_mm512_castpd_si512(a), \\\n"
	"\t_mm512_set1_epi64(0x3fe6a09e667f3bcd))\n"
	"#define EW_BITS_mm512_ps(a) _mm512_sub_epi32(_mm512_castps_si512(a), \\\n"
	"\t_mm512_set1_epi32(0x3f3504f3))\n"
	"#define EW_EXPONENT_mm256_pd(a) _mm256_sub_pd(_mm256_castsi256_pd(_mm256_or_si256( \\\n"
	"\t_mm256_srli_epi64(EW_BITS_mm256_pd(a), 52), _mm256_castpd_si256( \\\n"
	"\t_mm256_set1_pd(0x1p52)))), _mm256_set1_pd(0x1p52))\n"
	"#define EW_EXPONENT_mm256_ps(a) \\\n"
	"\t_mm256_cvtepi32_ps(_mm256_srli_epi32(EW_BITS_mm256_ps(a), 23))\n"
	"#define EW_EXPONENT_mm512_pd(a) _mm512_sub_pd(_mm512_castsi512_pd(_mm512_or_si512( \\\n"
	"\t_mm512_maskz_srli_epi64(0xff, EW_BITS_mm512_pd(a), 52), _mm512_castpd_si512( \\\n"
	"\t_mm512_set1_pd(0x1p52)))), _mm512_set1_pd(0x1p52))\n"
	"#define EW_EXPONENT_mm512_ps(a) \\\n"
	"\t_mm512_maskz_cvtepi32_ps(0xffff, _mm512_maskz_srli_epi32(0xffff, EW_BITS_mm512_ps(a), 23))\n"
	"#define EW_FRACTION_mm256_pd(a) _mm256_castsi256_pd(_mm256_sub_epi64( \\\n"
	"\t_mm256_castpd_si256(a), \\\n"
	"\t_mm256_slli_epi64(_mm256_srli_epi64(EW_BITS_mm256_pd(a), 52), 52)))\n"
	"#define EW_FRACTION_mm256_ps(a) _mm256_castsi256_ps(_mm256_sub_epi32( \\\n"
	"\t_mm256_castps_si256(a), \\\n"
	"\t_mm256_slli_epi32(_mm256_srli_epi32(EW_BITS_mm256_ps(a), 23), 23)))\n"
	"#define EW_FRACTION_mm512_pd(a) _mm512_castsi512_pd(_mm512_sub_epi64( \\\n"
	"\t_mm512_castpd_si512(a), \\\n"
	"\t_mm512_maskz_slli_epi64(0xff, _mm512_maskz_srli_epi64(0xff, EW_BITS_mm512_pd(a), 52), 52)))\n"
	"#define EW_FRACTION_mm512_ps(a) _mm512_castsi512_ps(_mm512_sub_epi32( \\\n"
	"\t_mm512_castps_si512(a), \\\n"
	"\t_mm512_maskz_slli_epi32(0xffff, "
	"_mm512_maskz_srli_epi32(0xffff, EW_BITS_mm512_ps(a), 23), 23)))\n";

static const char *const NEON =
	"#define EW_LEAST_f64 DBL_MIN\n"
	"#define EW_LEAST_f32 FLT_MIN\n"
	"#define EW_MAX_f64(a, b) vbslq_f64(vcgtq_f64(a, b), a, b)\n"
	"#define EW_MIN_f64(a, b) vbslq_f64(vcltq_f64(a, b), a, b)\n"
	"#define EW_MAX_f32(a, b) vbslq_f32(vcgtq_f32(a, b), a, b)\n"
	"#define EW_MIN_f32(a, b) vbslq_f32(vcltq_f32(a, b), a, b)\n"
	"#define EW_CHOOSE_f64(a, b, c) vbslq_f64(vcgtzq_f64(a), b, c)\n"
	"#define EW_CHOOSE_f32(a, b, c) vbslq_f32(vcgtzq_f32(a), b, c)\n"
	"#define EW_BITS_f64(a) \\\n"
	"\tvsubq_u64(vreinterpretq_u64_f64(a), vdupq_n_u64(0x3fe6a09e667f3bcd))\n"
	"#define EW_BITS_f32(a) vsubq_u32(vreinterpretq_u32_f32(a), vdupq_n_u32(0x3f3504f3))\n"
	"#define EW_EXPONENT_f64(a) vcvtq_f64_u64(vshrq_n_u64(EW_BITS_f64(a), 52))\n"
	"#define EW_EXPONENT_f32(a) vcvtq_f32_u32(vshrq_n_u32(EW_BITS_f32(a), 23))\n"
	"#define EW_FRACTION_f64(a) vreinterpretq_f64_u64(vsubq_u64(vreinterpretq_u64_f64(a), \\\n"
	"\tvshlq_n_u64(vshrq_n_u64(EW_BITS_f64(a), 52), 52)))\n"
	"#define EW_FRACTION_f32(a) vreinterpretq_f32_u32(vsubq_u32(vreinterpretq_u32_f32(a), \\\n"
	"\tvshlq_n_u32(vshrq_n_u32(EW_BITS_f32(a), 23), 23)))\n";

/* No contraction, and which targets this compiler can build. */
static void add_compiler(Text *text, const Request *request)
{
	text_add(text, "#ifndef EW_ALLOW_FAST_MATH\n"
		"#if defined(__FAST_MATH__) || defined(_M_FP_FAST)\n"
		"#error \"-ffast-math breaks the error bounds; define EW_ALLOW_FAST_MATH to accept "
		"that\"\n"
		"#elif (defined(FLT_EVAL_METHOD) && (FLT_EVAL_METHOD < 0 || FLT_EVAL_METHOD == 2)) "
		"\\\n\t|| (defined(__TINYC__) && defined(__i386__))\n"
		"#error \"wider arithmetic than the types say (x87) breaks the error bounds; "
		"use -msse2 -mfpmath=sse\"\n#endif\n#endif\n\n"
		"/* a * b + c must not become one operation behind our back: it would break "
		"x0 y1 - x1 y0 == 0 on a\n * repeated vertex, and equal bits on all machines. */\n"
		"#if defined(__clang__)\n#pragma clang fp contract(off)\n"
		"#elif defined(__GNUC__) && !defined(__TINYC__)\n"
		"#pragma GCC optimize (\"fp-contract=off\")\n"
		"#elif defined(_MSC_VER)\n#pragma fp_contract(off)\n#endif\n\n");
	text_add(text, "#ifdef __cplusplus\n#define EW_CAST(type, value) static_cast<type>(value)\n"
		"#else\n#define EW_CAST(type, value) ((type)(value))\n#endif\n\n");
	text_add(text, "/* What compilers must not see through: that accumulators in memory could be in "
		"registers (they would spill),\n * and that a vector could be loaded a second time "
		"instead of being kept. */\n"
		"#if defined(__GNUC__) || defined(__clang__)\n"
		"#define EW_HIDE(pointer) __asm__(\"\" : \"+r\"(pointer))\n"
		"#define EW_KEEP(vector) __asm__(\"\" : \"+x\"(vector))\n"
		"#else\n#define EW_HIDE(pointer) (void)0\n#define EW_KEEP(vector) (void)0\n#endif\n\n");
	text_add(text, "/* Which targets can this compiler build? "
		"The CPU is asked at run time. */\n"
		"#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__)) "
		"&& !defined(__TINYC__)\n#define EW_X86 1\n"
		"#define EW_ATTRIBUTE_FMA __attribute__((target(\"fma\")))\n"
		"#define EW_ATTRIBUTE_AVX2 __attribute__((target(\"avx2,fma\")))\n"
		"#define EW_ATTRIBUTE_AVX512 __attribute__((target(\"avx512f,fma\")))\n"
		"#else      /* MSVC has every intrinsic without attributes */\n"
		"#if defined(_MSC_VER) && defined(_M_X64) && !defined(_M_ARM64EC)\n"
		"#define EW_X86 1\n#else\n#define EW_X86 0\n#endif\n"
		"#define EW_ATTRIBUTE_FMA\n#define EW_ATTRIBUTE_AVX2\n"
		"#define EW_ATTRIBUTE_AVX512\n#endif\n"
		"#if EW_X86 && defined(_MSC_VER) && defined(__clang__)\n"
		"/* There <immintrin.h> leaves out what no flag of the command line names. */\n"
		"#include <immintrin.h>\n#include <smmintrin.h>\n#include <avxintrin.h>\n"
		"#include <avx2intrin.h>\n#include <fmaintrin.h>\n#include <avx512fintrin.h>\n"
		"#endif\n"
		"#if defined(__aarch64__) && !defined(__TINYC__)\n#define EW_ARM 1\n"
		"#define EW_ATTRIBUTE_NEON\n"
		"#else\n#define EW_ARM 0\n#endif\n"
		"#if defined(__FP_FAST_FMA)\n#define EW_FAST_FMA 1\n"
		"#else\n#define EW_FAST_FMA 0\n#endif\n");
	for (int t = 0; t < target_count; ++t)
		if (targets[t].guard)
			text_add(text, "#define %s %s\n", targets[t].guard,
				request->targets & targets[t].bit ? targets[t].condition : "0");
}

void emit_environment(Text *text, const Request *request)
{
	text_add(text, "#include <float.h>\n#include <stdint.h>\n#include <string.h>\n\n");
	add_compiler(text, request);
	text_add(text, "\n#define EW_LEAST DBL_MIN\n#define EW_LEASTf FLT_MIN\n");
	text_add(text, "\n/* Operations that are more than one instruction; see ew_ring_choose, "
		"ew_ring_exponent and ew_ring_fraction. */\n%s%s", X86, NEON);
	text_add(text, "\n"
		"/* a > b ? a : b; a < b ? a : b; a > 0 ? b : c; for a >= 1 the integer k with a 2^-k in "
		"[sqrt 1/2, sqrt 2),\n * and that number. */\n");
	for (int p = 0; p < precision_count; ++p)    /* deposits of filters are float */
		if (request->precisions & precisions[p].bit
		    || (precisions[p].is_float && request->filters))
			add_scalar(text, &formats[p]);
}

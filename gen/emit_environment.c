/* emit_environment.c - what every emitted kernel needs around it: protection against contraction
 * and wide arithmetic, which targets a compiler can build, and the operations that no single
 * expression or intrinsic spells (ops.def names them).
 *
 * Those have the same bits everywhere: max and choose are comparisons and selections, the exponent
 * of a number is taken from its bits, relative to those of sqrt(1/2), and what a product lost comes
 * from Dekker's splitting where nothing is fused. */
#include "gen.h"

/* Operations of one precision; root: the bits of sqrt 1/2; splitter: 2^ceil(t/2) + 1 splits t bits
 * in two halves, of numbers below 2^limit. */
typedef struct {
	const char *real, *suffix, *bits, *integer;
	int mantissa;
	const char *root, *splitter;
	int limit;
	const char *shape, *integers;        /* of vectors in WebAssembly */
} Format;

static const Format formats[] = {
	{ "double", "", "uint64_t", "int64_t", 52, "0x3fe6a09e667f3bcd", "134217729.0", 996,
		"f64x2", "64x2" },
	{ "float", "f", "uint32_t", "int32_t", 23, "0x3f3504f3", "4097.0f", 115,
		"f32x4", "32x4" },
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

static void add_lost(Text *text, const Format *f)
{
	const char *real = f->real;
	text_add(text, "/* a b - p exactly, p = a b rounded (Dekker 1971); a and b below 2^%d. */\n"
		"static inline %s ew_ring_lost%s(%s a, %s b, %s p)\n{\n"
		"\tconst %s ta = %s * a, tb = %s * b;\n"
		"\tconst %s ha = ta - (ta - a), hb = tb - (tb - b);\n"
		"\tconst %s la = a - ha, lb = b - hb;\n"
		"\treturn ((ha * hb - p) + ha * lb + la * hb) + la * lb;\n}\n",
		f->limit, real, f->suffix, real, real, real, real, f->splitter, f->splitter,
		real, real);
}

/* The same by vectors; 2^52 + k has k in its last bits, and small integers are converted so. */
static void add_wasm(Text *text, const Format *f)
{
	const char *shape = f->shape, *integers = f->integers, *root = f->root;
	const int is_double = f->mantissa == 52;
	text_add(text, "#define EW_LEAST_%s %s\n", shape, is_double ? "DBL_MIN" : "FLT_MIN");
	text_add(text, "#define EW_CHOOSE_%s(a, b, c) \\\n"
		"\twasm_v128_bitselect(b, c, wasm_%s_gt(a, wasm_%s_splat(0)))\n", shape, shape,
		shape);
	text_add(text, "#define EW_BITS_%s(a) wasm_i%s_sub(a, wasm_i%s_splat(%s))\n", shape,
		integers, integers, root);
	text_add(text, is_double ? "#define EW_EXPONENT_%s(a) wasm_f64x2_sub(wasm_v128_or( \\\n"
		"\twasm_u64x2_shr(EW_BITS_f64x2(a), 52), wasm_f64x2_splat(0x1p52)), "
		"wasm_f64x2_splat(0x1p52))\n" : "#define EW_EXPONENT_%s(a) \\\n"
		"\twasm_f32x4_convert_i32x4(wasm_u32x4_shr(EW_BITS_f32x4(a), 23))\n", shape);
	text_add(text, "#define EW_FRACTION_%s(a) wasm_i%s_sub(a, \\\n"
		"\twasm_i%s_shl(wasm_u%s_shr(EW_BITS_%s(a), %d), %d))\n", shape, integers,
		integers, integers, shape, f->mantissa, f->mantissa);
	text_add(text, "static inline v128_t ew_ring_lost_%s(v128_t a, v128_t b, v128_t p)\n{\n"
		"\tconst v128_t splitter = wasm_%s_splat(%s);\n", shape, shape, f->splitter);
	for (const char *half = "ab"; *half; ++half)
		text_add(text, "\tconst v128_t t%c = wasm_%s_mul(splitter, %c);\n"
			"\tconst v128_t h%c = wasm_%s_sub(t%c, wasm_%s_sub(t%c, %c));\n"
			"\tconst v128_t l%c = wasm_%s_sub(%c, h%c);\n", *half, shape, *half,
			*half, shape, *half, shape, *half, *half, *half, shape, *half, *half);
	text_add(text, "\tconst v128_t high = wasm_%s_sub(wasm_%s_mul(ha, hb), p);\n"
		"\tconst v128_t middle = wasm_%s_add(wasm_%s_add(high, wasm_%s_mul(ha, lb)),\n"
		"\t\twasm_%s_mul(la, hb));\n\treturn wasm_%s_add(middle, wasm_%s_mul(la, lb));\n}\n",
		shape, shape, shape, shape, shape, shape, shape, shape);
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
		"#if defined(__wasm_simd128__)      /* a module has it or not: nothing to ask */\n"
		"#define EW_WASM 1\n#define EW_ATTRIBUTE_WASM128\n"
		"#else\n#define EW_WASM 0\n#endif\n"
		"#if defined(__FP_FAST_FMA)\n#define EW_FAST_FMA 1\n"
		"#else\n#define EW_FAST_FMA 0\n#endif\n"
		"/* Unoptimised, compilers call the C library for fma, and mingw's rounds twice. */\n"
		"#if defined(__MINGW32__) && !defined(__OPTIMIZE__)\n#define EW_TRUE_FMA 0\n"
		"#else\n#define EW_TRUE_FMA 1\n#endif\n");
	for (int t = 0; t < target_count; ++t)
		if (targets[t].guard)
			text_add(text, "#define %s %s\n", targets[t].guard,
				request->targets & targets[t].bit ? targets[t].condition : "0");
}

/* Deposits of filters are float. */
static int has_precision(const Request *request, int p)
{
	return request->precisions & precisions[p].bit
		|| (precisions[p].is_float && request->filters);
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
	for (int p = 0; p < precision_count; ++p)
		if (has_precision(request, p)) {
			add_scalar(text, &formats[p]);
			add_lost(text, &formats[p]);
		}
	if (!(request->targets & TARGET_WASM128))
		return;
	text_add(text, "\n#if EW_BUILD_WASM128\n#include <wasm_simd128.h>\n");
	for (int p = 0; p < precision_count; ++p)
		if (has_precision(request, p))
			add_wasm(text, &formats[p]);
	text_add(text, "#endif\n");
}

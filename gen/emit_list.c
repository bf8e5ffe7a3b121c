/* emit_list.c - edgewise_kernels.h, the one list of kernels that feeds dispatch, tests and
 * benchmarks, and the manifest.
 *
 * No kernel can exist untested or undispatched: whoever needs "all kernels" expands one
 * of these X-macros. */
#include "gen.h"

#include <string.h>

static char *upper(const char *text)
{
	char *copy = copy_string(text, strlen(text));
	for (char *p = copy; *p; ++p)
		if (*p >= 'a' && *p <= 'z')
			*p = (char)(*p - 'a' + 'A');
	return copy;
}

static char *ring_id(const Ring *ring)
{
	return format("EW_RING_%s", upper(ring->name));
}

/* What every emitted file needs: no contraction, and which targets this compiler can build. */
static void add_environment(Text *text, const Request *request)
{
	text_add(text, "#include <float.h>\n\n#ifndef EW_ALLOW_FAST_MATH\n"
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
		"#define EW_ABS_mm256_pd(a) _mm256_andnot_pd(_mm256_set1_pd(-0.0), a)\n"
		"#define EW_ABS_mm256_ps(a) _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a)\n"
		"#define EW_ABS_mm512_pd(a) _mm512_abs_pd(a)\n"
		"#define EW_ABS_mm512_ps(a) _mm512_abs_ps(a)\n"
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

static void add_lines(Text *text, const Request *request, const Kernels *kernels)
{
	for (int p = 0; p < precision_count; ++p) {
		int wanted = (request->precisions & precisions[p].bit) != 0;
		text_add(text, "\n/* X(m, n, symbol, k): single edges; |result - exact| <= gamma_k "
			"W */\n#define EW_LINES_%s(X)", upper(precisions[p].real));
		for (int i = 0; i < kernels->edges && wanted; ++i) {
			const Edge *edge = &kernels->edge[i];
			if (edge->what->m >= 0)
				text_add(text, " \\\n\tX(%d, %d, ew_line_%s%s, %d)", edge->what->m,
					edge->what->n, edge->what->name, precisions[p].suffix,
					edge->bound.k);
		}
		text_add(text, "\n");
	}
}

static int has_monomials(const Kernels *kernels)
{
	for (int i = 0; i < kernels->rings; ++i)
		if (strcmp(kernels->ring[i].family, "monomial") == 0)
			return 1;
	return 0;
}

static void add_ids(Text *text, const Kernels *kernels)
{
	int accumulators = 1, outputs = 1;
	text_add(text, "\n/* X(id, family, m, n, accumulators, outputs, k, r): all that runs over "
		"rings. For n items in\n * L lanes |result - exact| <= gamma_K W "
		"with K = k + r (ceil(n/L) - 1) + log2 L; L is 1 for fewer than 24 vertices. */\n"
		"#define EW_RINGS(X)");
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		text_add(text, " \\\n\tX(%s, %s, %d, %d, %d, %d, %d, %d)", ring_id(ring),
			ring->family, ring->m, ring->n, ring->accumulators, ring->outputs,
			ring->worst.k, ring->worst.repeat);
		if (ring->accumulators > accumulators)
			accumulators = ring->accumulators;
		if (ring->outputs > outputs)
			outputs = ring->outputs;
	}
	text_add(text, "\n\nenum {\n");
	for (int i = 0; i < kernels->rings; ++i)
		text_add(text, "\t%s,\n", ring_id(&kernels->ring[i]));
	text_add(text, "\tEW_RINGS_COUNT,\n\tEW_MAX_ACCUMULATORS = %d,\n\tEW_MAX_OUTPUTS = %d\n"
		"};\n", accumulators, outputs);
	text_add(text, "\n/* X(id, window, turns, accumulators, outputs, finish): "
		"for the ring driver; "
		"window counts vertices */\n#define EW_RINGS_SHAPES(X)");
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		text_add(text, " \\\n\tX(%s, %d, %d, %d, %d, ew_ring_%s_finish)", ring_id(ring),
			window_planes(ring->window), ring->turns, ring->accumulators, ring->outputs,
			ring->name);
	}
	text_add(text, "\n\n/* X(m, n, id): single moments */\n%s#define EW_MONOMIALS(X)",
		has_monomials(kernels) ? "#define EW_HAS_MONOMIALS 1\n" : "");
	for (int i = 0; i < kernels->rings; ++i)
		if (strcmp(kernels->ring[i].family, "monomial") == 0)
			text_add(text, " \\\n\tX(%d, %d, %s)", kernels->ring[i].m,
				kernels->ring[i].n, ring_id(&kernels->ring[i]));
	text_add(text, "\n");
}

static const Ring *ring_named(const Kernels *kernels, const char *name)
{
	for (int i = 0; i < kernels->rings; ++i)
		if (strcmp(kernels->ring[i].name, name) == 0)
			return &kernels->ring[i];
	bug("no ring kernel for %s", name);
}

static void add_bounds(Text *text, const Request *request, const Kernels *kernels)
{
	text_add(text, "\n/* X(k, r, products, wk, wr), for the moments to degree 0, 1, ...: k of "
		"each result, r and products\n * per item, k and r of their magnitudes */\n"
		"#define EW_BOUNDS(X)");
	for (int degree = 0; degree <= request->moments; ++degree) {
		const Ring *ring = ring_named(kernels, format("moments_%d", degree));
		const Ring *terms = ring_named(kernels, format("magnitudes_%d", degree));
		text_add(text, " \\\n\tX(ew_ring_%s_k, %d, %d, %d, %d)", ring->name,
			ring->worst.repeat, ring->portable.cost.fma, terms->worst.k,
			terms->worst.repeat);
	}
	text_add(text, "\n");
}

static void add_precision(Text *text, const Request *request, const Kernels *kernels,
	const Precision *precision)
{
	const char *real = upper(precision->real);
	text_add(text, "\n/* X(function, id, edge, k): a polynomial over a ring, "
		"and over one edge with its k; %s */\n"
		"#define EW_POLYNOMIALS_%s(X)", precision->real, real);
	for (int i = 0; i < kernels->edges; ++i) {
		const Edge *edge = &kernels->edge[i];
		if (edge->what->m < 0)
			text_add(text, " \\\n\tX(ew_%s%s, %s, ew_line_%s%s, %d)", edge->what->name,
				precision->suffix, ring_id(ring_named(kernels, edge->what->name)),
				edge->what->name, precision->suffix, edge->bound.k);
	}
	text_add(text, "\n");
	for (int t = 0; t < target_count; ++t) {
		if (!(request->targets & targets[t].bit))
			continue;
		text_add(text, "\n/* X(id, kernel, f, a): %s, %s; per item f on the FMA pipe, "
			"a additions */\n#define EW_RINGS_%s_%s(X)", targets[t].name,
			precision->real, upper(targets[t].name), real);
		for (int i = 0; i < kernels->rings; ++i) {
			const Ring *ring = &kernels->ring[i];
			Count cost = targets[t].fused ? ring->fused.cost : ring->portable.cost;
			text_add(text, " \\\n\tX(%s, ew_ring_%s%s_%s, %d, %d)", ring_id(ring),
				ring->name, precision->suffix, targets[t].name, cost.fma, cost.add);
		}
		text_add(text, "\n");
	}
}

/* How the batch kernels of low degrees call their items: EW_SUMS_n accumulators, and EW_NEXT_n for
 * column k of a block, with vertex (vx, vy) behind (px, py) and qy before that. */
static void add_items(Text *text, const Kernels *kernels)
{
	text_add(text, "\n/* Items of batch kernels, see edgewise_sides_template.h */\n");
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		if (!emit_has_item(ring))
			continue;
		text_add(text, "#define EW_SUMS_%d %d\n", ring->m, ring->accumulators);
		text_add(text, "#define EW_NEXT_%d(item, k) item(%s, cx, %s)\n", ring->m,
			ring->window == WINDOW_VERTEX ? "qy, px, vy" : "px, py, vx, vy",
			ring->turns == 1 ? "acc" : format("acc + (k) %% %d * %d",
				ring->turns, ring->accumulators / ring->turns));
	}
}

/* The targets that the compiler builds, and what finishes the moments of rings side by side. */
static void add_targets(Text *text, const Request *request, const Kernels *kernels)
{
	Text all = { 0 };
	for (int t = 0; t < target_count; ++t) {
		const Target *target = &targets[t];
		const char *name = upper(target->name);
		if (!(request->targets & target->bit))
			continue;
		text_add(text, "\n#%s %s\n#define EW_TARGET_%s(X) X(%s, %s, %d)\n#else\n"
			"#define EW_TARGET_%s(X)\n#endif\n", "if",
			target->guard ? target->guard : "1", name, name, target->name,
			target->vector ? target->vector->width[0] : 1, name);
		text_add(&all, " EW_TARGET_%s(X)", name);
		text_add(text, "/* X(id, finish): %s */\n#define EW_FINISHES_%s(X)", target->name,
			name);
		for (int i = 0; i < kernels->rings; ++i)
			if (emit_finishes_columns(&kernels->ring[i]))
				text_add(text, " \\\n\tX(%s, ew_ring_%s_finish%s%s)",
					ring_id(&kernels->ring[i]), kernels->ring[i].name,
					target->vector ? "_" : "",
					target->vector ? target->name : "");
		text_add(text, "\n");
	}
	text_add(text, "\n/* X(TARGET, target, doubles): the targets that this compiler builds, and doubles in a "
		"register */\n"
		"#define EW_TARGETS(X)%s\n", text_take(&all));
}

/* 2^ceil(t/2) + 1: splits t bits in two halves. */
static const char *const SPLITTER[] = { "134217729.0", "4097.0f" };

static void add_types(Text *text, const Request *request)
{
	text_add(text, "\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n"
		"/* Items 0 .. count-1; item i reads vertices i, i + reach, ... (the window), and "
		"lane l < step takes items l,\n * l + step, ... in order; added to "
		"sum[accumulator * L + lane], L = %d double, %d float.\n"
		" * One ring: reach 1, step L. As many rings as a register has lanes, side by "
		"side: reach and step that many.\n * With reach 1 and step 1 "
		"only lane 0 has a meaning. origin[lane]: abscissas of the local origins\n"
		" * (vertex form only). Results: finish(sums over all lanes, out). */\n",
		precisions[0].lanes, precisions[1].lanes);
	for (int p = 0; p < precision_count; ++p) {
		const char *real = precisions[p].real;
		if (request->precisions & precisions[p].bit)
			text_add(text, "typedef void ew_ring_run%s(const %s *x, const %s *y, "
				"const %s *origin,\n\tsize_t reach, size_t step, size_t count, %s *sum);\n",
				precisions[p].suffix, real, real, real, real);
	}
	for (int p = 0; p < precision_count; ++p) {
		const char *real = precisions[p].real, *suffix = precisions[p].suffix;
		if (request->precisions & precisions[p].bit)
			text_add(text, "/* pad = from[0 .. rest-1], then zeros. */\n"
				"static inline const %s *ew_ring_pad%s("
				"%s *pad, const %s *from, size_t rest, size_t width)\n{\n"
				"\tfor (size_t i = 0; i < width; ++i)\n"
				"\t\tpad[i] = i < rest ? from[i] : 0;\n"
				"\treturn pad;\n}\n", real, suffix, real, real);
		if (request->precisions & precisions[p].bit)
			text_add(text, "/* a b - p exactly, p = a b rounded (Dekker 1971); a and b "
				"below 2^%d. */\n"
				"static inline %s ew_ring_lost%s(%s a, %s b, %s p)\n{\n"
				"\tconst %s ta = %s * a, tb = %s * b;\n"
				"\tconst %s ha = ta - (ta - a), hb = tb - (tb - b);\n"
				"\tconst %s la = a - ha, lb = b - hb;\n"
				"\treturn ((ha * hb - p) + ha * lb + la * hb) + la * lb;\n}\n",
				precisions[p].is_float ? 115 : 996, real, suffix, real, real, real,
				real, SPLITTER[p], SPLITTER[p], real, real);
	}
	text_add(text, "/* From sum[accumulator * stride] to out[output * stride]; those of a "
		"vector target take as many\n * neighbours as a register holds. */\n"
		"typedef void ew_ring_finish(const double *sum, double *out, size_t stride);\n\n"
		"#define EW_DECLARE(id, window, turns, accumulators, outputs, finish) "
		"ew_ring_finish finish;\n"
		"EW_RINGS_SHAPES(EW_DECLARE)\n#undef EW_DECLARE\n"
		"#define EW_DECLARE(k, r, products, wk, wr) extern const short k[];\n"
		"EW_BOUNDS(EW_DECLARE)\n#undef EW_DECLARE\n");
	for (int p = 0; p < precision_count; ++p)
		for (int t = 0; t < target_count; ++t) {
			const Target *target = &targets[t];
			if (!(request->targets & target->bit)
			    || !(request->precisions & precisions[p].bit))
				continue;
			if (target->guard)
				text_add(text, "#if %s\n", target->guard);
			text_add(text, "#define EW_DECLARE(id, kernel, f, a) "
				"ew_ring_run%s kernel;\nEW_RINGS_%s_%s(EW_DECLARE)\n"
				"#undef EW_DECLARE\n%s", precisions[p].suffix, upper(target->name),
				upper(precisions[p].real), target->guard ? "#endif\n" : "");
		}
	for (int t = 0; t < target_count; ++t)
		if (request->targets & targets[t].bit && targets[t].vector) {
			text_add(text, "#if %s\n#define EW_DECLARE(id, finish) "
				"ew_ring_finish finish;\nEW_FINISHES_%s(EW_DECLARE)\n"
				"#undef EW_DECLARE\n#endif\n", targets[t].guard,
				upper(targets[t].name));
		}
	text_add(text, "\n#ifdef __cplusplus\n}\n#endif\n");
}

void emit_list(Files *files, const Request *request, const Kernels *kernels)
{
	const char *name = "edgewise_kernels.h";
	Text *text = file_new(files, name);
	emit_banner(text, name, "the list of kernels, for the runtime, tests and benchmarks; "
		"not for users", request);
	text_add(text, "#ifndef EDGEWISE_KERNELS_H\n#define EDGEWISE_KERNELS_H\n\n"
		"#include <stddef.h>\n");
	add_environment(text, request);
	add_lines(text, request, kernels);
	add_ids(text, kernels);
	for (int p = 0; p < precision_count; ++p)
		if (request->precisions & precisions[p].bit)
			add_precision(text, request, kernels, &precisions[p]);
	add_bounds(text, request, kernels);
	add_items(text, kernels);
	add_targets(text, request, kernels);
	add_types(text, request);
	text_add(text, "\n#endif\n");
}

/* ---- manifest: JSON, one file and one kernel per line, so that line readers can use it ---- */

static void add_count(Text *text, const char *key, const Program *program)
{
	const Count cost = program->cost;
	text_add(text, ", \"%s\": {\"mul\": %d, \"fma\": %d, \"add\": %d, \"live\": %d, "
		"\"depth\": %d}", key, cost.mul, cost.fma - cost.mul, cost.add, program->live,
		program->depth);
}

static char *quoted(const char *text)
{
	Text out = { 0 };
	text_add(&out, "\"");
	for (; *text; ++text)
		text_add(&out, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
	text_add(&out, "\"");
	return text_take(&out);
}

static void add_edges(Text *text, const Kernels *kernels)
{
	text_add(text, " \"edges\": [");
	for (int i = 0; i < kernels->edges; ++i) {
		const Edge *edge = &kernels->edge[i];
		text_add(text, "%s\n  {\"function\": \"ew_line_%s\", \"integrand\": %s, \"k\": %d",
			i ? "," : "", edge->what->name, quoted(edge->what->formula), edge->bound.k);
		add_count(text, "portable", &edge->program);
		text_add(text, "}");
	}
	text_add(text, "\n ],\n");
}

static void add_rings(Text *text, const Request *request, const Kernels *kernels)
{
	text_add(text, " \"rings\": [");
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		text_add(text, "%s\n  {\"ring\": \"%s\", \"family\": \"%s\", \"scheme\": \"%s\", "
			"\"window\": %d, \"turns\": %d, \"accumulators\": %d, \"outputs\": %d",
			i ? "," : "", ring->name, ring->family, ring->scheme,
			window_planes(ring->window),
			ring->turns, ring->accumulators,
			ring->outputs);
		add_count(text, "portable", &ring->portable);
		if (request->targets & TARGET_FMA)
			add_count(text, "fma", &ring->fused);
		text_add(text, ", \"repeat\": %d, \"k\": [", ring->worst.repeat);
		for (int j = 0; j < ring->outputs && ring->bound; ++j)
			text_add(text, "%s%d", j ? ", " : "", ring->bound[j].k);
		text_add(text, "]}");
	}
	text_add(text, "\n ],\n");
}

void emit_manifest(Text *text, const Request *request, const Kernels *kernels)
{
	text_add(text, "{\"generator\": \"gen %s\",\n \"command\": %s,\n", GEN_VERSION,
		quoted(request->command));
	add_edges(text, kernels);
	add_rings(text, request, kernels);
}

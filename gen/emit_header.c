/* emit_header.c - edgewise.h: the public interface of one emission.
 *
 * One row per function: when it exists, its comment, its prototype. A prototype is written once;
 * REAL and @ become double and "", then float and "f". Comments stand above the first of the
 * twins. */
#include "gen.h"

#include <string.h>

typedef struct { int (*wanted)(const Request *); const char *comment, *prototype; } Entry;

static int always(const Request *request)
{
	return request != NULL;
}

static int has_area(const Request *request)
{
	return request->moments >= 0;
}

static int has_centroid(const Request *request)
{
	return request->moments >= 1;
}

static int has_monomials(const Request *request)
{
	return request->monomials > 0;
}

static const Entry rings[] = {
	{ has_area,
	"All moments M_mn = integral of x^m y^n over the region inside one ring, m + n <= degree, "
	"about (0,0). out[EW_INDEX(m, n)] = M_mn, EW_MOMENTS(degree) values; unit: "
	"coordinate^(m+n+2). EW_BAD_DEGREE leaves out untouched. Error: gamma_K times the same sum "
	"with every term positive, K = k + r (max(ceil(n/8), 23) - 1) + 3, k and r (\"repeat\") "
	"from the manifest (float: at most k + 63 r + 5, because 16 lanes are flushed to double every 1024 "
	"edges); degree 0 is computed and bounded as ew_area. Far from the origin the terms are "
	"large and cancel: use ew_moments_about or ew_central_moments there. "
	"Source: Green's theorem; Steger 1996.",
	"int ew_moments@(int degree, const REAL *x, const REAL *y, size_t n, REAL *out)" },
	{ has_area,
	"The same about (cx,cy): the integral of (x-cx)^m (y-cy)^n. Each vertex is moved first, "
	"rounded once. Error: gamma_(K + degree + 2) times the positive sum of the moved vertices.",
	"int ew_moments_about@(int degree, const REAL *x, const REAL *y, size_t n, "
	"REAL cx, REAL cy, REAL *out)" },
	{ has_area,
	"ew_moments of interleaved vertices: xy[2 i], xy[2 i + 1]. The same bits as ew_moments.",
	"int ew_moments_xy@(int degree, const REAL *xy, size_t n, REAL *out)" },
	{ has_area,
	"Moments of the region moved by (dx,dy), from its moments: out_mn = sum C(m,i) C(n,j) "
	"dx^(m-i) dy^(n-j) in_ij. in and out may be the same array. Error: gamma_(4 degree + 1) "
	"times that sum with every term positive.",
	"int ew_translate_moments@(int degree, const REAL *in, REAL dx, REAL dy, REAL *out)" },
	{ has_monomials,
	"One moment about (0,0): cheaper than all. NaN if x^m y^n was not emitted. Error as "
	"ew_moments, with the k of its own row of the manifest.",
	"REAL ew_moment@(int m, int n_, const REAL *x, const REAL *y, size_t n)" },
	{ has_area,
	"Area, about the first vertex: 1/2 sum (x_i - x_0)(y_(i+1) - y_(i-1)); counterclockwise is "
	"positive. Error: gamma_(16 + ceil(n/16)) (float: gamma_73) times sum 1/2 |x_i - x_0| "
	"|y_(i+1) - y_(i-1)|, wherever the ring lies.",
	"REAL ew_area@(const REAL *x, const REAL *y, size_t n)" },
	{ has_centroid,
	"Centroid, computed about the first vertex. If the area is 0: EW_ZERO_AREA, and c is NaN. "
	"Error: |c - exact| <= (B + |c - v| A) / (|area| - A) + 4 u |c - v| + u |c|, A and B the "
	"bounds of area and first moment about vertex v.",
	"int ew_centroid@(const REAL *x, const REAL *y, size_t n, REAL c[2])" },
	{ has_centroid,
	"Centroid and all moments about it; out[1] = out[2] = 0. Computed about the first vertex, "
	"then about the centroid, so nothing cancels far from the origin. If the area is 0: "
	"EW_ZERO_AREA, c and out are NaN. Error: gamma_(K + 4 degree + 24) times the sum with "
	"every term positive, about the centroid or about the first vertex, whichever is larger.",
	"int ew_central_moments@(int degree, const REAL *x, const REAL *y, size_t n, REAL c[2], "
	"REAL *out)" },
	{ has_area,
	"The moments of ew_moments and, for each, a bound of its error: |out - exact| <= bound, "
	"rigorously: gamma_K times the sum of all terms with positive sign, with the roundings and "
	"underflows of the bound itself included. Infinity if that says nothing (overflow, NaN).",
	"int ew_moments_bounded@(int degree, const REAL *x, const REAL *y, size_t n, REAL *out, "
	"REAL *bound)" },
	{ has_area,
	"Area about (0,0) as if summed in twice the precision (Dot2: Ogita, Rump, Oishi 2005): "
	"faithful as long as sum |x_i y_(i+1)| + |x_(i+1) y_i| <= |2 area| 2^52 / (4 n^2) "
	"(float: 2^23 / (4 n^2)) and products neither underflow nor overflow (portable: coordinates "
	"below 2^996, float 2^115).",
	"REAL ew_area_compensated@(const REAL *x, const REAL *y, size_t n)" },
	{ has_area,
	"Areas of many rings; ring i has the vertices offsets[i] .. offsets[i+1] - 1, as in GeoArrow "
	"(rings + 1 offsets). out[i] is what ew_area gives, bit for bit. Negative or decreasing "
	"offsets: EW_BAD_OFFSETS, out untouched.",
	"int ew_area_rings@(const REAL *x, const REAL *y, const int32_t *offsets, size_t rings, "
	"REAL *out)" },
	{ has_centroid,
	"Centroids of many rings, as ew_centroid gives them, bit for bit; NaN for a ring whose area "
	"is 0. Offsets as for ew_area_rings.",
	"int ew_centroid_rings@(const REAL *x, const REAL *y, const int32_t *offsets, size_t rings, "
	"REAL *cx, REAL *cy)" },
	{ has_area,
	"Moments of many rings, as ew_moments gives them, bit for bit: out[i * EW_MOMENTS(degree) + "
	"EW_INDEX(m, n)]. Offsets as for ew_area_rings; a bad degree leaves out untouched too.",
	"int ew_moments_rings@(int degree, const REAL *x, const REAL *y, const int32_t *offsets, "
	"size_t rings, REAL *out)" },
};

static const Entry dispatch[] = {
	{ always,
	"Bit set of the targets that this build has and this CPU runs.",
	"unsigned ew_targets(void)" },
	{ always,
	"Forces one target (one bit of ew_targets); 0 returns to the best. EW_UNSUPPORTED changes "
	"nothing. For the whole process.",
	"int ew_use_target(unsigned target)" },
	{ always,
	"\"portable\", \"fma\", ...; \"unknown\" if it is not one target.",
	"const char *ew_target_name(unsigned target)" },
	{ always,
	"Version of the generator, \"major.minor.patch\".",
	"const char *ew_version(void)" },
};

static void add_comment(Text *text, const char *comment)
{
	text_add(text, "\n");
	emit_wrapped(text, "/* ", " * ", comment);
	text_add(text, " */\n");
}

static void add_prototype(Text *text, const char *pattern, const Precision *precision)
{
	Text line = { 0 };
	for (const char *p = pattern; *p; ++p) {
		if (strncmp(p, "REAL", 4) == 0) {
			text_add(&line, "%s", precision->real);
			p += 3;
		} else if (*p == '@') {
			text_add(&line, "%s", precision->suffix);
		} else {
			text_add(&line, "%c", *p);
		}
	}
	text_add(&line, ";");
	emit_statement(text, 0, line.data);
	text_free(&line);
}

static void add_twins(Text *text, const char *pattern, const Request *request)
{
	for (int i = 0; i < precision_count; ++i)
		if (request->precisions & precisions[i].bit)
			add_prototype(text, pattern, &precisions[i]);
}

static void add_entries(Text *text, const Entry *entry, int count, const Request *request)
{
	for (int i = 0; i < count; ++i) {
		if (!entry[i].wanted(request))
			continue;
		add_comment(text, entry[i].comment);
		if (strchr(entry[i].prototype, '@'))
			add_twins(text, entry[i].prototype, request);
		else
			add_prototype(text, entry[i].prototype, &precisions[0]);
	}
}

static const char *const PREAMBLE =
	"An integral over a region is a sum over its edges. Counterclockwise is positive, holes "
	"run clockwise and subtract, a self-overlapping region is weighted by its winding number: "
	"add up what the rings of a region return.\n\n"
	"Bounds hold unless a product underflows: |coordinate|^(degree + 2) should be a normal "
	"number. "
	"Sums are formed before the rational factor of a moment is applied, so they overflow when "
	"(m+n+2)!/(m! n!) times the result would.\n\n"
	"A ring is n vertices (x[i], y[i]); the edge from the last to the first is implied, and a "
	"ring that repeats its first vertex at the end is fine: a repeated vertex contributes "
	"exactly 0. n of 0, 1 or 2 gives 0. NaN or infinity in gives NaN or infinity out. Inputs "
	"are never changed, nothing allocates, every function is reentrant. Functions ending in f "
	"take and return float. u is 2^-53 (float: 2^-24) and gamma_k is k u / (1 - k u).\n\n"
	"Results have the same bits on every CPU and target with fused multiply-add; portable "
	"alone may differ.";

static void add_macros(Text *text, const Request *request)
{
	text_add(text, "\n#define EW_VERSION \"%s\"\n", GEN_VERSION);
	if (request->moments >= 0)
		text_add(text, "#define EW_MAX_DEGREE %d\n"
			"#define EW_MOMENTS(degree) (((degree) + 1) * ((degree) + 2) / 2)"
			"  /* monomials to this degree */\n"
			"#define EW_INDEX(m, n) (((m) + (n)) * ((m) + (n) + 1) / 2 + (n))"
			"  /* 1, x, y, x^2, x y, ... */\n",
			request->moments);
	for (int i = 0; i < precision_count; ++i)
		if (request->precisions & precisions[i].bit)
			text_add(text, "#define EW_HAS_%s 1\n",
				precisions[i].is_float ? "FLOAT" : "DOUBLE");
	text_add(text, "\nenum {\n\tEW_PORTABLE = 1,\n\tEW_FMA = 2,\n\tEW_AVX2 = 4,\n"
		"\tEW_AVX512 = 8,\n\tEW_NEON = 16,\n\tEW_WASM128 = 32\n};\n");
	text_add(text, "enum {\n\tEW_OK = 0,\n\tEW_BAD_DEGREE,\n\tEW_BAD_PATH,\n\tEW_BAD_OFFSETS,\n"
		"\tEW_BAD_IMAGE,\n\tEW_BAD_COORDINATE,\n\tEW_ZERO_AREA,\n\tEW_NO_MEMORY,\n"
		"\tEW_UNSUPPORTED\n};\n");
}

static void add_edges(Text *text, const Request *request, const Kernels *kernels)
{
	add_comment(text, "Contribution of one line edge (x0,y0) -> (x1,y1) to the integral of "
		"x^m y^n or of a polynomial: m! n!/(m+n+2)! (x0 y1 - x1 y0) "
		"sum_pq C(p+q,q) C(m+n-p-q,n-q) x0^(m-p) x1^p y0^(n-q) y1^q. Swapping the ends "
		"negates it bit for bit. NaN or infinity in gives NaN or infinity out. The matrix, "
		"the error bound and the cost stand above each body. "
		"Source: Green's theorem; Steger 1996.");
	for (int i = 0; i < kernels->edges; ++i)
		add_twins(text, format("REAL ew_line_%s@(REAL x0, REAL y0, REAL x1, REAL y1)",
			kernels->edge[i].what->name), request);
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		if (ring->m >= 0)
			continue;
		int number = i - (kernels->rings - request->polynomials);
		add_comment(text, format("Integral of %s over one ring. Error: gamma_K as "
			"ew_moments, k = %d.", request->polynomial[number].formula, ring->worst.k));
		add_twins(text, format("REAL ew_%s@(const REAL *x, const REAL *y, size_t n)",
			ring->name), request);
	}
}

void emit_header(Files *files, const Request *request, const Kernels *kernels)
{
	const char *name = "edgewise.h";
	Text *text = file_new(files, name);
	emit_banner(text, name, "exact integrals over polygons, as sums over edges", request);
	text_add(text, "#ifndef EDGEWISE_H\n#define EDGEWISE_H\n\n#include <stddef.h>\n"
		"#include <stdint.h>\n");
	add_comment(text, PREAMBLE);
	add_macros(text, request);
	text_add(text, "\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n");
	add_entries(text, rings, LENGTH(rings), request);
	add_edges(text, request, kernels);
	add_entries(text, dispatch, LENGTH(dispatch), request);
	text_add(text, "\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
}

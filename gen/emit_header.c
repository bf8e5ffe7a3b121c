/* emit_header.c - edgewise.h: the public interface of one emission.
 *
 * One row per function: when it exists, its comment, its prototype. A prototype is written once;
 * REAL and @ become double and "", then float and "f". Comments stand above the first of the
 * twins. */
#include "gen.h"

#include <string.h>

typedef struct { int (*wanted)(const Request *); const char *comment, *prototype; } Entry;

static int has_rings(const Request *request)
{
	return spec_has_rings(request);
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
	return request->monomials > 0 && request->edges & EDGE_LINE;
}

static int has_curves(const Request *request)
{
	return request->curves >= 0;
}

static int has_quads(const Request *request)
{
	return request->curves >= 0 && request->edges & EDGE_QUAD;
}

static int has_cubics(const Request *request)
{
	return request->curves >= 0 && request->edges & EDGE_CUBIC;
}

static int has_conics(const Request *request)
{
	return request->curves >= 0 && request->edges & EDGE_CONIC;
}

static int has_distance(const Request *request)
{
	return (request->families & FAMILY_DISTANCE) != 0;
}

static int has_closure(const Request *request)
{
	return (request->families & FAMILY_CLOSURE) != 0;
}

static int has_coverage(const Request *request)
{
	return (request->families & FAMILY_COVERAGE) != 0;
}

static int has_raster(const Request *request)
{
	return request->filters > 0;
}

static const Entry rings[] = {
	{ has_area,
	"All moments M_mn = integral of x^m y^n over the region inside one ring, m + n <= degree, "
	"about (0,0). out[EW_INDEX(m, n)] = M_mn, EW_MOMENTS(degree) values; unit: "
	"coordinate^(m+n+2). EW_BAD_DEGREE leaves out untouched. Error: gamma_K times the same sum "
	"with every term positive, K = k + r (max(ceil(n/8), 23) - 1) + 3, k and r (\"repeat\") "
	"from the manifest (float: at most k + 63 r + 5, because 16 lanes are flushed to double "
	"every 1024 edges); degree 0 is computed and bounded as ew_area. Far from the origin the "
	"terms are large and cancel: use ew_moments_about or ew_central_moments there. Source: "
	"Green's theorem; Steger 1996.",
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
	"Centroid (c[0], c[1]), computed about the first vertex. If the area is 0: EW_ZERO_AREA, "
	"and c is NaN. Error: |c - exact| <= (B + |c - v| A) / (|area| - A) + 4 u |c - v| + u |c|, "
	"A and B the bounds of area and first moment about vertex v.",
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
	"(float: 2^23 / (4 n^2)) and products neither underflow nor overflow (portable, wasm128: "
	"coordinates below 2^996, float 2^115).",
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

#define LINE_POINTS "REAL x0, REAL y0, REAL x1, REAL y1"
#define QUAD_POINTS LINE_POINTS ", REAL x2, REAL y2"
#define CUBIC_POINTS QUAD_POINTS ", REAL x3, REAL y3"

static const Entry kinds[] = {
	{ has_curves,
	"All moments of x^m y^n, m + n <= degree, of one edge: its contribution, form 3, "
	"1/(m+n+2) integral of x^m y^n (x dy - y dx), so that edges of every kind may be added up. "
	"out[EW_INDEX(m, n)]; degrees beyond EW_MAX_CURVE_DEGREE give EW_BAD_DEGREE and leave out "
	"untouched. Quadratic and cubic Bezier edges: exact polynomials to degree 1, beyond sums over "
	"the Gauss-Legendre nodes that are exact for the degree. Error: gamma_(k + 2) times the same "
	"sum with every term positive, in the power basis about the middle of the curve; k per degree "
	"from the manifest. Source: Green's theorem; own derivation.",
	"int ew_line_moments@(int degree, " LINE_POINTS ", REAL *out)" },
	{ has_quads, NULL,
	"int ew_quad_moments@(int degree, " QUAD_POINTS ", REAL *out)" },
	{ has_cubics, NULL,
	"int ew_cubic_moments@(int degree, " CUBIC_POINTS ", REAL *out)" },
	{ has_conics,
	"The same of a conic edge with weights 1, w, 1: those of the chord and of the cap beyond it, "
	"by a Gauss-Jacobi rule whose truncation is below rounding. w >= 0 or +inf (the control "
	"polygon); -1 < w < 0 is the complementary arc; w <= -1 or NaN gives NaN. Weights w0, w1, w2 "
	"are the same as w = w1 / sqrt(w0 w2).",
	"int ew_conic_moments@(int degree, " QUAD_POINTS ", REAL w, REAL *out)" },
	{ has_conics,
	"Area of a conic edge, weights as for ew_conic_moments: (x0 y2 - x2 y0)/2 + f(w) T with "
	"T = 1/2 cross(p1 - p0, p2 - p0), f(w) = w (acos(w)/sqrt(1 - w^2) - w)/(1 - w^2); w = 0 is the "
	"chord, w = 1 the quadratic Bezier edge. Error: f is good to 2.5 ulp (10 ulp for w < 0, where "
	"it is a difference), both terms to 4 u more. Swapping the ends negates the result bit for bit.",
	"REAL ew_conic_area@(" QUAD_POINTS ", REAL w)" },
	{ has_curves,
	"All moments of the region inside a path, degrees as for ew_line_moments. verbs are EW_MOVE (1 "
	"point), EW_LINE (1), EW_QUAD (2), EW_CONIC (2 and one weight), EW_CUBIC (3), EW_CLOSE (0); "
	"points are x, y alternating, point_count counts points. Open contours are closed by a line; "
	"empty ones and those of one point give 0; drawing goes on after EW_CLOSE from where the "
	"contour began. An unknown verb, or one of a kind of edge that was not emitted, one before any "
	"EW_MOVE, or points and weights that are not "
	"exactly those that the verbs take: EW_BAD_PATH, out untouched, nothing read past the arrays. "
	"Error: the bounds of the edges, summed; edges of each kind are added up in lanes as in "
	"ew_moments. About (0,0): move a path that is far from it.",
	"int ew_path_moments@(int degree, const unsigned char *verbs, size_t verb_count, "
	"const REAL *points, size_t point_count, const REAL *weights, size_t weight_count, REAL *out)" },
	{ has_distance,
	"Contribution of one line edge to the integral of the distance to the origin, sqrt(x^2 + y^2): "
	"s/12 (S + (|p0 + p1|^2 + (2 s/S)^2 K(d^2/S^2))/S), s = x0 y1 - x1 y0, S = |p0| + |p1|, "
	"d = |p1 - p0|, K(t^2) = (atanh(t)/t - 1)/t^2; that is the integral over the triangle (origin, "
	"p0, p1). Unit: coordinate^3. Error: at most gamma_28 of the result (8 u is the most ever seen). "
	"An edge of length 0 or whose line passes the origin gives exactly 0. Swapping the ends negates "
	"the result bit for bit. What overflows on the way is computed again on scaled coordinates. "
	"Source: own derivation.",
	"REAL ew_line_distance@(" LINE_POINTS ")" },
	{ has_distance,
	"The same for the integral of r^k, k = -1, 1, 3 or 5; NaN for any other k. Unit: "
	"coordinate^(k+2). Error: gamma_40 at most (18 u is never reached).",
	"REAL ew_line_radius@(int k, " LINE_POINTS ")" },
	{ has_distance,
	"Integral of the distance to (cx,cy) over the region inside a ring. Error: gamma_(28 + K), K = "
	"max(ceil(n/8), 23) + 2 (float: at most 68), of the sum of the edges' magnitudes, and what moving "
	"the vertices costs: each is rounded once.",
	"REAL ew_distance@(const REAL *x, const REAL *y, size_t n, REAL cx, REAL cy)" },
	{ has_distance,
	"The same for r^k, k = -1, 1, 3 or 5; NaN for any other k. Error as ew_distance, 40 for 28.",
	"REAL ew_radius@(int k, const REAL *x, const REAL *y, size_t n, REAL cx, REAL cy)" },
	{ has_closure,
	"(x0-px)(y0-py) - (x1-px)(y1-py): its sum over the edges of a closed boundary is 0, in any "
	"order of the edges. Error: gamma_4 times the sum of both |products|.",
	"REAL ew_line_closure@(" LINE_POINTS ", REAL px, REAL py)" },
	{ has_closure,
	"The sum of ew_line_closure over edges in any order. On a closed set its terms cancel in pairs: "
	"|sum| <= gamma_(ceil(edges/8) + 4) times the sum of all |products| (float: gamma_73). "
	"It misses sets whose surplus of starts over ends is orthogonal to x y, x and y, wherever p is: "
	"such as (1,0) -> (2,0) with (-1,0) -> (-2,0). ew_is_closed does not.",
	"REAL ew_closure@(const REAL *x0, const REAL *y0, const REAL *x1, const REAL *y1, size_t edges, "
	"REAL px, REAL py)" },
	{ has_closure,
	"1 if every vertex is as often the start of an edge as the end of one, bit for bit except that "
	"-0 is 0; else 0. Exact on closed sets; an open one is taken for closed with probability 2^-64 "
	"(2^(j-64) if every vertex has a surplus that 2^j divides), unless it was made by someone who "
	"knows the keys, which are fixed: a sum of hashes modulo 2^64. 0 if a coordinate is NaN or "
	"infinite; 1 for no edges. Vertices that are equal only up to "
	"rounding do not match.",
	"int ew_is_closed@(const REAL *x0, const REAL *y0, const REAL *x1, const REAL *y1, "
	"size_t edges)" },
};

static const Entry windows[] = {
	{ has_coverage,
	"Area between the segment (px,py) -> (qx,qy) and the line y = v0, within the rectangle [u0,u1] x "
	"[v0,v1]: the integral of clamp(y(x) - v0, 0, v1 - v0) over the x of the segment in [u0,u1]; "
	"never negative. A vertical segment gives 0, so does u1 <= u0 or v1 <= v0; NaN and infinity give "
	"NaN. Error as ew_line_coverage. Source: area-below-a-segment; own derivation.",
	"REAL ew_below@(REAL px, REAL py, REAL qx, REAL qy, REAL u0, REAL u1, REAL v0, REAL v1)" },
	{ has_coverage,
	"What the edge (x0,y0) -> (x1,y1) adds to the area of region and rectangle [u0,u1] x "
	"[v0,v1]: ew_below, negative if the edge goes to the right. No polygon is clipped: summed "
	"over the edges of any ring, in any order, it is the area of the part inside "
	"(winding-weighted). Error: |w| (20 u H + 9 u (|y0 - v0| + |y1 - v0|)) + m H, w the width "
	"of the part of the edge between u0 and u1, H = v1 - v0, m the smallest normal number. "
	"Coordinates up to a quarter of the largest number. Swapping the ends negates the result "
	"bit for bit; an edge that is vertical, a point, below or beside the rectangle gives "
	"exactly 0. Bad input as ew_below. Source: Green's theorem.",
	"REAL ew_line_coverage@(" LINE_POINTS ", REAL u0, REAL u1, REAL v0, REAL v1)" },
	{ has_coverage,
	"Area of the part of a ring inside the rectangle [u0,u1] x [v0,v1]; 0 if that is empty. Bad input "
	"as ew_below. Error: the sum of those of the edges, and gamma_(ceil(n/8) + 2) (float: gamma_68) "
	"of the sum of |edges|.",
	"REAL ew_coverage@(const REAL *x, const REAL *y, size_t n, REAL u0, REAL u1, REAL v0, REAL v1)" },
	{ has_raster,
	"An image of filtered coverage: pixels[j row_stride + i] = integral of f(x - i - 1/2, y - "
	"j - 1/2) over the region inside all rings, weighted by winding; ring i has the vertices "
	"offsets[i] .. offsets[i+1] - 1. Pixel (i,j) has its centre at (i + 1/2, j + 1/2), y grows "
	"with j, unit: a pixel. Every pixel of the image is written. The region may leave the "
	"image on any side. Exact up to rounding: at most 2e-6 for 1000 edges, 1e-5 for 100000, "
	"and filters whose values are around 1; a pixel that no edge comes near is exactly the "
	"winding number (times the filter's integral), which must be below 256. Reversing all "
	"rings negates the image, moving them by whole pixels moves it, bit for bit. row_stride "
	"counts floats and may be negative. EW_BAD_IMAGE: negative size, |row_stride| < width, "
	"NULL; EW_BAD_OFFSETS: negative or decreasing; EW_BAD_COORDINATE: NaN, infinity, or beyond "
	"2^30; EW_NO_MEMORY: EW_MALLOC, which may be defined when the runtime is compiled, "
	"returned NULL. Then no pixel is touched. Source: Green's theorem.",
	"int ew_raster@(const ew_filter *filter, const REAL *x, const REAL *y, const int32_t *offsets, "
	"size_t rings, float *pixels, int width, int height, ptrdiff_t row_stride)" },
	{ has_raster,
	"The same with the box, to bytes: the nearest of 255 |coverage|, at most 255.",
	"int ew_raster_u8@(const REAL *x, const REAL *y, const int32_t *offsets, size_t rings, "
	"unsigned char *pixels, int width, int height, ptrdiff_t row_stride)" },
	{ has_raster,
	"The same for a path, as in ew_path_moments; its curves become lines that are nowhere farther "
	"than 2^-8 pixels from them. EW_BAD_PATH if it is malformed, EW_BAD_COORDINATE for a weight that "
	"is NaN or <= -1.",
	"int ew_raster_path@(const ew_filter *filter, const unsigned char *verbs, size_t verb_count, "
	"const REAL *points, size_t point_count, const REAL *weights, size_t weight_count, float *pixels, "
	"int width, int height, ptrdiff_t row_stride)" },
};

static const Entry dispatch[] = {
	{ has_rings,
	"Bit set of the targets that this build has and this CPU runs.",
	"unsigned ew_targets(void)" },
	{ has_rings,
	"Forces one target (one bit of ew_targets); 0 returns to the best. EW_UNSUPPORTED changes "
	"nothing. For the whole process.",
	"int ew_use_target(unsigned target)" },
	{ has_rings,
	"\"portable\", \"fma\", ...; \"unknown\" if it is not one target.",
	"const char *ew_target_name(unsigned target)" },
	{ has_rings,
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
		if (entry[i].comment)
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
	"add up what the rings of a region return.\n\nBounds hold unless a product underflows: "
	"|coordinate|^(degree + 2) should be a normal number. Sums are formed before the rational "
	"factor of a moment is applied, so they overflow when (m+n+2)!/(m! n!) times the result "
	"would.\n\nA ring is n vertices (x[i], y[i]); the edge from the last to the first is "
	"implied, and a ring that repeats its first vertex at the end is fine: a repeated vertex "
	"contributes exactly 0. n of 0, 1 or 2 gives 0. NaN or infinity in gives NaN or infinity "
	"out. Inputs are never changed, nothing but images allocates, every function is reentrant. "
	"Functions ending in f take and return float. u is 2^-53 (float: 2^-24) and gamma_k is k u "
	"/ (1 - k u).\n\nResults have the same bits on every CPU and target with fused "
	"multiply-add; portable and wasm128, which have none, may differ.";

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
	if (request->curves >= 0)
		text_add(text, "#define EW_MAX_CURVE_DEGREE %d\n", request->curves);
	for (int i = 0; i < precision_count; ++i)
		if (request->precisions & precisions[i].bit)
			text_add(text, "#define EW_HAS_%s 1\n",
				precisions[i].is_float ? "FLOAT" : "DOUBLE");
	const struct { int wanted; const char *name; } features[] = {
		{ has_quads(request), "QUADS" }, { has_conics(request), "CONICS" },
		{ has_cubics(request), "CUBICS" },
		{ request->moments >= 0 || request->monomials || request->polynomials, "INTEGRANDS" },
		{ has_distance(request), "DISTANCE" }, { has_closure(request), "CLOSURE" },
		{ has_coverage(request), "COVERAGE" }, { has_raster(request), "FILTERS" },
	};
	for (int i = 0; i < LENGTH(features); ++i)
		if (features[i].wanted)
			text_add(text, "#define EW_HAS_%s 1\n", features[i].name);
	text_add(text, "\nenum {\n\tEW_PORTABLE = 1,\n\tEW_FMA = 2,\n\tEW_AVX2 = 4,\n"
		"\tEW_AVX512 = 8,\n\tEW_NEON = 16,\n\tEW_WASM128 = 32\n};\n");
	if (has_curves(request) || has_raster(request))
		text_add(text, "enum { EW_MOVE, EW_LINE, EW_QUAD, EW_CONIC, EW_CUBIC, EW_CLOSE };\n");
	text_add(text, "enum {\n\tEW_OK = 0,\n\tEW_BAD_DEGREE,\n\tEW_BAD_PATH,\n\tEW_BAD_OFFSETS,\n"
		"\tEW_BAD_IMAGE,\n\tEW_BAD_COORDINATE,\n\tEW_ZERO_AREA,\n\tEW_NO_MEMORY,\n"
		"\tEW_UNSUPPORTED\n};\n");
}

static void add_edge(Text *text, const Edge *edge, const Request *request)
{
	add_twins(text, format("REAL ew_%s@(%s)", edge_name(edge),
		emit_parameters(edge->window, "REAL")), request);
}

/* Areas of edges, and single monomials of curves. */
static void add_curve_edges(Text *text, const Request *request, const Kernels *kernels)
{
	int areas = 0, monomials = 0;
	for (int i = 0; i < kernels->edges; ++i) {
		const Edge *edge = &kernels->edge[i];
		if (!edge->what && areas++ == 0)
			add_comment(text, "Area of one edge, form 3: (x0 y1 - x1 y0)/2, (2 c01 + 2 c12 + "
				"c02)/6, (6 c01 + 3 c02 + c03 + 3 c12 + 3 c13 + 6 c23)/20 with c_ij = x_i y_j - "
				"x_j y_i. Swapping the ends negates it bit for bit. Bound and cost stand above "
				"each body. Source: Green's theorem.");
		if (!edge->what)
			add_edge(text, edge, request);
	}
	for (int i = 0; i < kernels->edges; ++i) {
		const Edge *edge = &kernels->edge[i];
		if (!edge->what || edge->window == WINDOW_LINE)
			continue;
		if (monomials++ == 0)
			add_comment(text, "One monomial over one curved edge, form 3, by the Gauss-Legendre "
				"nodes that are exact for it. Bound and cost stand above each body.");
		add_edge(text, edge, request);
	}
}

static void add_line_edges(Text *text, const Request *request, const Kernels *kernels)
{
	if (!(request->edges & EDGE_LINE) || request->monomials + request->polynomials == 0)
		return;
	add_comment(text, "Contribution of one line edge (x0,y0) -> (x1,y1) to the integral of "
		"x^m y^n or of a polynomial: m! n!/(m+n+2)! (x0 y1 - x1 y0) "
		"sum_pq C(p+q,q) C(m+n-p-q,n-q) x0^(m-p) x1^p y0^(n-q) y1^q. Swapping the ends "
		"negates it bit for bit. NaN or infinity in gives NaN or infinity out. The matrix, "
		"the error bound and the cost stand above each body. "
		"Source: Green's theorem; Steger 1996.");
	for (int i = 0; i < kernels->edges; ++i)
		if (kernels->edge[i].what && kernels->edge[i].window == WINDOW_LINE)
			add_edge(text, &kernels->edge[i], request);
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		if (strcmp(ring->family, "polynomial") != 0)
			continue;
		int number = i - (kernels->rings - request->polynomials);
		add_comment(text, format("Integral of %s over one ring. Error: gamma_K as "
			"ew_moments, k = %d.", request->polynomial[number].formula, ring->worst.k));
		add_twins(text, format("REAL ew_%s@(const REAL *x, const REAL *y, size_t n)",
			ring->name), request);
	}
}

static void add_filters(Text *text, const Request *request)
{
	if (!has_raster(request))
		return;
	add_comment(text, "Filters, for ew_raster: what each is stands in edgewise_filters.c.");
	text_add(text, "typedef struct ew_filter ew_filter;\n");
	for (int i = 0; i < request->filters; ++i)
		text_add(text, "extern const ew_filter ew_filter_%s;\n", request->filter[i].name);
	add_comment(text, "What one line edge adds to the integral of a filter, centred at "
		"(cx,cy), over the region, and that integral for the region inside one ring: - sum "
		"over edges of the integral of F(x, y(x)) dx, F the integral of f over y from "
		"below. The unit of the filter is that of the coordinates: the box is a square of "
		"side 1. Swapping the ends negates the first bit for bit; an edge that is "
		"vertical, a point, below or beside the support gives exactly 0. NaN or infinity "
		"gives NaN. Error of an edge: gamma_k C + 9 u (|y0 - cy| + |y1 - cy|) D, k from "
		"the manifest, C the sum over the cells of the filter of its polynomials' terms, "
		"in coordinates of the cell, with positive sign, and D the largest |f| times the "
		"width of the support. Source: Green's theorem; raster by piecewise polynomial "
		"filters: Manson and Schaefer 2013.");
	for (int i = 0; i < request->filters; ++i) {
		const char *name = request->filter[i].name;
		add_twins(text, format("REAL ew_line_%s@(" LINE_POINTS ", REAL cx, REAL cy)", name),
			request);
		add_twins(text, format("REAL ew_%s@(const REAL *x, const REAL *y, size_t n, REAL cx, "
			"REAL cy)", name), request);
	}
}

void emit_header(Files *files, const Request *request, const Kernels *kernels)
{
	const char *name = "edgewise.h";
	Text *text = file_new(files, name);
	emit_banner(text, name, "exact integrals over polygons, as sums over edges", request);
	text_add(text, "%s", spec_files(request));
	text_add(text, "#ifndef EDGEWISE_H\n#define EDGEWISE_H\n\n#include <stddef.h>\n"
		"#include <stdint.h>\n");
	add_comment(text, PREAMBLE);
	add_macros(text, request);
	text_add(text, "\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n");
	add_entries(text, rings, LENGTH(rings), request);
	add_entries(text, kinds, LENGTH(kinds), request);
	add_curve_edges(text, request, kernels);
	add_filters(text, request);
	add_entries(text, windows, LENGTH(windows), request);
	add_line_edges(text, request, kernels);          /* so many that they would hide the rest */
	add_entries(text, dispatch, LENGTH(dispatch), request);
	text_add(text, "\n#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
}

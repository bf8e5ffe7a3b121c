/* emit_edge.c - single-edge functions ew_line_NAME, ew_cubic_NAME, and the coefficient matrix
 * in every form it is shown in.
 *
 * The comment above a function shows the matrix that the body evaluates; --show prints the same
 * matrix as text, LaTeX, JSON or C. These functions are plain C for every machine: no target,
 * no dispatch, the same bits everywhere. */
#include "gen.h"

#include <string.h>

enum { WIDTH = 100 };

/* The integers of m! n!/(m+n+2)! h_mn, row p for x0^(m-p) x1^p, column q for y0^(n-q) y1^q. */
typedef struct { int m, n; Rat factor; Poly integers; } Matrix;

static Matrix matrix_of(const Edge *edge)
{
	Rat content = poly_content(edge->integral.density);
	Poly integers = poly_scale(edge->integral.density, rat_div(rat(1, 1), content));
	return (Matrix){ edge->what->m, edge->what->n, content, integers };
}

static char *entry(const Matrix *matrix, int p, int q)
{
	Mono mono = mono_var(VAR_X0, matrix->m - p) + mono_var(VAR_X1, p)
		+ mono_var(VAR_Y0, matrix->n - q) + mono_var(VAR_Y1, q);
	for (int i = 0; i < matrix->integers.count; ++i)
		if (matrix->integers.term[i].mono == mono)
			return rat_text(matrix->integers.term[i].coef);
	bug("the coefficient matrix has a hole");
}

static char *powers(const char *start, const char *end, int i, int j, const char *times,
	const char *open)
{
	const char *close = *open == '{' ? "}" : "";
	char *left = i > 1 ? format("%s^%s%d%s", start, open, i, close)
		: format("%s", i ? start : "");
	char *right = j > 1 ? format("%s^%s%d%s", end, open, j, close)
		: format("%s", j ? end : "");
	return i + j == 0 ? format("1") : format("%s%s%s", left, i && j ? times : "", right);
}

static void add_table(Text *text, const Matrix *matrix, const char *margin)
{
	int width = 5, label = 4;
	for (int p = 0; p <= matrix->m; ++p)
		for (int q = 0; q <= matrix->n; ++q) {
			int size = (int)strlen(entry(matrix, p, q));
			int head = (int)strlen(powers("y0", "y1", matrix->n - q, q, " ", ""));
			int side = (int)strlen(powers("x0", "x1", matrix->m - p, p, " ", ""));
			width = size > width ? size : width;
			width = head > width ? head : width;
			label = side > label ? side : label;
		}
	if ((int)strlen(margin) + label + (matrix->n + 1) * (width + 2) + 8 > WIDTH) {
		text_add(text, "%s    (sum over p, q of C(p+q,q) C(m+n-p-q,n-q) "
			"x0^(m-p) x1^p y0^(n-q) y1^q)\n", margin);
		return;
	}
	text_add(text, "%s    %*s  ", margin, label, "");
	for (int q = 0; q <= matrix->n; ++q)
		text_add(text, "  %*s", width, powers("y0", "y1", matrix->n - q, q, " ", ""));
	text_add(text, "\n");
	for (int p = 0; p <= matrix->m; ++p) {
		text_add(text, "%s    %-*s |", margin, label,
			powers("x0", "x1", matrix->m - p, p, " ", ""));
		for (int q = 0; q <= matrix->n; ++q)
			text_add(text, "  %*s", width, entry(matrix, p, q));
		text_add(text, " |\n");
	}
}

/* "x0, y0, x1, y1" with the type before each. */
char *emit_parameters(int window, const char *real)
{
	Text text = { 0 };
	for (int i = 0; i < window_points(window); ++i)
		text_add(&text, "%s%s x%d, %s y%d", i ? ", " : "", real, i, real, i);
	return text_take(&text);
}

/* What the body of a curve's function computes. */
static void add_curve_formula(Text *text, const Edge *edge)
{
	static const char *const areas[WINDOWS] = {
		"(x0 y1 - x1 y0) / 2", "", "(2 c01 + 2 c12 + c02) / 6", "",
		"(6 c01 + 3 c02 + c03 + 3 c12 + 3 c13 + 6 c23) / 20",
	};
	if (!edge->what) {
		text_add(text, " *     %s%s\n", areas[edge->window],
			edge->window == WINDOW_LINE ? "" : ",  c_ij = x_i y_j - x_j y_i");
		return;
	}
	text_add(text, " *     1/%d sum over %d Gauss-Legendre nodes tau of weight x^%d y^%d "
		"(x y' - y x'),\n *     in the power basis about the middle, t = (1 + tau)/2; exact "
		"for this degree\n", edge->what->m + edge->what->n + 2,
		curve_nodes(edge->window, edge->what->m + edge->what->n), edge->what->m,
		edge->what->n);
}

static void add_formula(Text *text, const Edge *edge, const char *margin)
{
	if (edge->what->m < 0) {
		char *factor = rat_text(poly_content(edge->integral.density));
		text_add(text, "%s    %s (x0 y1 - x1 y0) times the sum in the body\n", margin,
			factor);
		return;
	}
	Matrix matrix = matrix_of(edge);
	text_add(text, "%s    %s (x0 y1 - x1 y0) times the sum of row times column times\n%.*s\n",
		margin, rat_text(matrix.factor), (int)strlen(margin) - (*margin != 0), margin);
	add_table(text, &matrix, margin);
}

/* What one edge contributes to. */
static const char *contribution(const Edge *edge)
{
	static const char *const kinds[WINDOWS] = {
		"the line edge (x0,y0) -> (x1,y1)", "",
		"the quadratic Bezier edge with control points (x0,y0) .. (x2,y2)", "",
		"the cubic Bezier edge with control points (x0,y0) .. (x3,y3)",
	};
	if (!edge->what)
		return format("%s to the area", kinds[edge->window]);
	return format("%s to the integral of %s", kinds[edge->window], edge->what->formula);
}

/* One with its comment. */
static void emit_edge(Text *text, const Edge *edge, const Precision *precision)
{
	const Style style = { precision, 1, 1, 0, "", "return ", NULL };
	const Program *program = &edge->program;
	const char *real = precision->real;
	const int m = edge->what ? edge->what->m : 0, n = edge->what ? edge->what->n : 0;
	const int reverses = program->dag->proof == PROOF_POLYNOMIAL;
	Mark mark = arena_mark();
	emit_wrapped(text, "/* ", " * ", format("Contribution of %s:", contribution(edge)));
	text_add(text, "\n *\n");
	if (edge->what && edge->window == WINDOW_LINE)
		add_formula(text, edge, " * ");
	else
		add_curve_formula(text, edge);
	text_add(text, " *\n * Sum it over a closed boundary; counterclockwise is positive.");
	if (m >= 0)
		text_add(text, " Unit: coordinate^%d.", m + n + 2);
	text_add(text, "\n * Error: at most gamma_%d times the same sum with every term positive; "
		"gamma_k = k u/(1 - k u),\n * u = %s.\n", edge->bound.k, precision->unit);
	if (reverses)
		text_add(text, " * Swapping the ends negates the result bit for bit; "
			"a repeated vertex gives 0.\n");
	text_add(text, " * Cost: %d mul, %d add%s; depth %d. */\n", program->cost.fma,
		program->cost.add, emit_divisions(program), program->depth);
	emit_statement(text, 0, format("%s ew_%s%s(%s)", real, edge_name(edge), precision->suffix,
		emit_parameters(edge->window, real)));
	text_add(text, "{\n");
	emit_program(text, program, &style);
	text_add(text, "}\n");
	arena_release(mark);
}

static Text *open_file(Files *files, const Request *request, const Precision *precision, int part)
{
	const char *stem = format("edgewise_line%s", precision->suffix);
	const char *name = part > 1 ? format("%s_%d.c", stem, part) : format("%s.c", stem);
	Text *text = file_new(files, name);
	emit_banner(text, name, format("contribution of one edge to an integral, %s",
		precision->real), request);
	text_add(text, "\n#include \"edgewise.h\"\n#include \"edgewise_kernels.h\"\n");
	return text;
}

void emit_edges(Files *files, const Request *request, const Kernels *kernels)
{
	for (int i = 0; i < precision_count; ++i) {
		if (!(request->precisions & precisions[i].bit))
			continue;
		int part = 1;
		Text *text = open_file(files, request, &precisions[i], part);
		for (int k = 0; k < kernels->edges; ++k) {
			if (text->size > FILE_SIZE)
				text = open_file(files, request, &precisions[i], ++part);
			text_add(text, "\n");
			emit_edge(text, &kernels->edge[k], &precisions[i]);
		}
	}
}

/* ---- --show ---- */

static void show_text(Text *text, const Edge *edge)
{
	text_add(text, "integral of %s, contribution of the line edge (x0,y0) -> (x1,y1):\n\n",
		edge->what->formula);
	add_formula(text, edge, "");
}

static void show_latex(Text *text, const Edge *edge)
{
	Matrix matrix = matrix_of(edge);
	text_add(text, "\\frac{%s}{%s}\\,(x_0 y_1 - x_1 y_0)\n\\begin{bmatrix}",
		int_text(matrix.factor.num), int_text(matrix.factor.den));
	for (int p = 0; p <= matrix.m; ++p)
		text_add(text, "%s %s", p ? " &" : "",
			powers("x_0", "x_1", matrix.m - p, p, " ", "{"));
	text_add(text, " \\end{bmatrix}\n\\begin{bmatrix}\n");
	for (int p = 0; p <= matrix.m; ++p) {
		for (int q = 0; q <= matrix.n; ++q)
			text_add(text, "%s%s", q ? " & " : "  ", entry(&matrix, p, q));
		text_add(text, p < matrix.m ? " \\\\\n" : "\n");
	}
	text_add(text, "\\end{bmatrix}\n\\begin{bmatrix}");
	for (int q = 0; q <= matrix.n; ++q)
		text_add(text, "%s %s", q ? " \\\\" : "",
			powers("y_0", "y_1", matrix.n - q, q, " ", "{"));
	text_add(text, " \\end{bmatrix}\n");
}

static void show_json(Text *text, const Edge *edge)
{
	Matrix matrix = matrix_of(edge);
	text_add(text, "{\"monomial\": \"%s\", \"edge\": \"line\", \"factor\": \"%s\", "
		"\"times\": \"x0 y1 - x1 y0\",\n \"rows\": [",
		edge->what->name, rat_text(matrix.factor));
	for (int p = 0; p <= matrix.m; ++p)
		text_add(text, "%s\"%s\"", p ? ", " : "",
			powers("x0", "x1", matrix.m - p, p, " ", ""));
	text_add(text, "],\n \"columns\": [");
	for (int q = 0; q <= matrix.n; ++q)
		text_add(text, "%s\"%s\"", q ? ", " : "",
			powers("y0", "y1", matrix.n - q, q, " ", ""));
	text_add(text, "],\n \"matrix\": [");
	for (int p = 0; p <= matrix.m; ++p) {
		text_add(text, "%s[", p ? ", " : "");
		for (int q = 0; q <= matrix.n; ++q)
			text_add(text, "%s%s", q ? ", " : "", entry(&matrix, p, q));
		text_add(text, "]");
	}
	text_add(text, "]}\n");
}

static void show_c(Text *text, const Edge *edge)
{
	emit_edge(text, edge, &precisions[0]);
}

void emit_show(Text *text, const Integrand *monomial, const char *format_name)
{
	static const struct { const char *name; void (*print)(Text *, const Edge *); } formats[] = {
		{ "text", show_text }, { "latex", show_latex },
		{ "json", show_json }, { "c", show_c },
	};
	Edge edge = build_edge(monomial);
	for (int i = 0; i < LENGTH(formats); ++i)
		if (strcmp(formats[i].name, format_name) == 0) {
			formats[i].print(text, &edge);
			return;
		}
	fatal(EXIT_USAGE, "--format: unknown word '%s'; known: text, latex, json, c", format_name);
}

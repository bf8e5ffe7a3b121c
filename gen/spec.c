/* spec.c - what is asked for, and its grammar.
 *
 *     monomial    xMyN                                   x4y2
 *     polynomial  NAME=EXPRESSION                        soft=(1-x)*(1-y)
 *     expression  sum of terms: + - * / ^ ( ), x, y, integers and decimals;
 *                 division by constants only
 *
 * Everything is exact. A mistake ends the program with the line, the column and a caret under
 * the spot. Names become parts of C identifiers, so C and C++ keywords and the names of the
 * library's own functions are refused. */
#include "gen.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_NESTING = 100, MAX_NAME = 40, MAX_DIGITS = 30 };
enum { BEFORE = 60, BEHIND = 60 };                   /* characters shown around an error */

typedef struct { const char *what, *text; size_t at; int nesting; } Reader;

/* The message, the part of the line around the spot, and a caret under it. */
static char *locate_at(const Reader *reader, size_t at, const char *message)
{
	int line = 1;
	size_t start = 0, end = at;
	for (size_t i = 0; i < at; ++i)
		if (reader->text[i] == '\n') {
			++line;
			start = i + 1;
		}
	int column = (int)(at - start) + 1;
	size_t shown = at - start > BEFORE ? at - BEFORE : start;
	while (end - at < BEHIND && reader->text[end] && reader->text[end] != '\n')
		++end;
	char *margin = copy_string(reader->text + shown, at - shown);
	for (char *p = margin; *p; ++p)
		*p = *p == '\t' ? '\t' : ' ';
	return format("%s: line %d, column %d: %s\n  %.*s\n  %s^", reader->what, line, column,
		message, (int)(end - shown), reader->text + shown, margin);
}

static char *locate(const void *reader, const char *message)
{
	return locate_at(reader, ((const Reader *)reader)->at, message);
}

static void syntax_error(const Reader *reader, size_t at, const char *message)
	__attribute__((noreturn));
static void syntax_error(const Reader *reader, size_t at, const char *message)
{
	reading(NULL, NULL);
	fatal(EXIT_USAGE, "%s", locate_at(reader, at, message));
}

static int peek(Reader *reader)
{
	while (reader->text[reader->at] && strchr(" \t\r\n", reader->text[reader->at]))
		++reader->at;
	return (unsigned char)reader->text[reader->at];
}

static int total_degree(Poly a)
{
	int degree = 0;
	for (int i = 0; i < a.count; ++i) {
		int d = mono_power(a.term[i].mono, VAR_X) + mono_power(a.term[i].mono, VAR_Y);
		degree = d > degree ? d : degree;
	}
	return degree;
}

static void check_degree(const Reader *reader, size_t at, int degree)
{
	if (degree > MAX_DEGREE)
		syntax_error(reader, at, format("the degree becomes %d; at most %d is supported",
			degree, MAX_DEGREE));
}

static int is_digit(int c)
{
	return c >= '0' && c <= '9';
}

static Rat read_number(Reader *reader)
{
	size_t start = reader->at;
	Int num = 0, den = 1;
	int point = 0;
	for (;; ++reader->at) {
		int c = (unsigned char)reader->text[reader->at];
		if (c == '.' && !point && is_digit((unsigned char)reader->text[reader->at + 1])) {
			point = 1;
			continue;
		}
		if (!is_digit(c))
			break;
		if (reader->at - start >= MAX_DIGITS)
			syntax_error(reader, start, format("a number of more than %d digits",
				MAX_DIGITS));
		num = 10 * num + (c - '0');
		den *= point ? 10 : 1;
	}
	return rat(num, den);
}

static int read_exponent(Reader *reader)
{
	peek(reader);
	size_t start = reader->at;
	if (!is_digit(peek(reader)))
		syntax_error(reader, start, "expected an exponent: a whole number from 0 to 32");
	Rat value = read_number(reader);
	if (value.den != 1 || value.num > MAX_DEGREE)
		syntax_error(reader, start, "expected an exponent: a whole number from 0 to 32");
	return (int)value.num;
}

static Poly read_sum(Reader *reader);

static Poly read_base(Reader *reader)
{
	int c = peek(reader);
	size_t start = reader->at;
	if (is_digit(c))
		return poly_const(read_number(reader));
	size_t letters = strspn(reader->text + start,
		"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_");
	if (letters == 1 && (c == 'x' || c == 'y')) {
		++reader->at;
		return poly_var(c == 'x' ? VAR_X : VAR_Y);
	}
	if (letters)
		syntax_error(reader, start, format("expected a number, x, y or '(', not the name "
			"'%.*s'; products need a *", letters > MAX_NAME ? MAX_NAME : (int)letters,
			reader->text + start));
	if (c != '(')
		syntax_error(reader, start, "expected a number, x, y or '('");
	if (++reader->nesting > MAX_NESTING)
		syntax_error(reader, start, "parentheses are nested too deeply");
	++reader->at;
	Poly inside = read_sum(reader);
	if (peek(reader) != ')')
		syntax_error(reader, reader->at, "expected an operator or ')'");
	++reader->at;
	--reader->nesting;
	return inside;
}

static Poly read_factor(Reader *reader)
{
	if (peek(reader) == '-') {
		if (++reader->nesting > MAX_NESTING)
			syntax_error(reader, reader->at, "too many signs in a row");
		++reader->at;
		Poly negated = poly_scale(read_factor(reader), rat(-1, 1));
		--reader->nesting;
		return negated;
	}
	size_t start = reader->at;
	Poly base = read_base(reader);
	if (peek(reader) != '^')
		return base;
	++reader->at;
	int power = read_exponent(reader);
	check_degree(reader, start, total_degree(base) * power);
	return poly_pow(base, power);
}

static Poly read_product(Reader *reader)
{
	Poly product = read_factor(reader);
	for (int c; (c = peek(reader)) == '*' || c == '/'; ) {
		++reader->at;
		peek(reader);
		size_t start = reader->at;
		Poly factor = read_factor(reader);
		if (c == '/' && (factor.count == 0 || factor.term[0].mono != 0))
			syntax_error(reader, start, factor.count
				? "division by something that is not a number"
				: "division by zero");
		if (c == '/')
			factor = poly_const(rat_div(rat(1, 1), factor.term[0].coef));
		check_degree(reader, start, total_degree(product) + total_degree(factor));
		product = poly_mul(product, factor);
	}
	return product;
}

static Poly read_sum(Reader *reader)
{
	Poly sum = read_product(reader);
	for (int c; (c = peek(reader)) == '+' || c == '-'; ) {
		++reader->at;
		Poly next = read_product(reader);
		sum = c == '+' ? poly_add(sum, next) : poly_sub(sum, next);
	}
	return sum;
}

/* ---- names ---- */

static const char *const KEYWORDS =
	" alignas alignof and and_eq asm auto bitand bitor bool break case catch char class compl "
	"concept const const_cast consteval constexpr constinit continue co_await co_return "
	"co_yield decltype default delete do double dynamic_cast else enum explicit export extern "
	"false float for friend goto if inline int long mutable namespace new noexcept not not_eq "
	"nullptr operator or or_eq private protected public register reinterpret_cast requires "
	"restrict return short signed sizeof static static_assert static_cast struct switch "
	"template this thread_local throw true try typedef typeid typename typeof union unsigned "
	"using virtual void volatile wchar_t while xor xor_eq ";
static const char *const LIBRARY =
	" area area_compensated area_rings below central_moments centroid centroid_rings closure "
	"coverage cubic cubic_area cubic_moments conic conic_area conic_moments distance is_closed "
	"line line_area moment moments moments_about moments_bounded moments_rings moments_xy path "
	"path_moments quad quad_area quad_moments radius raster raster_path raster_u8 target_name "
	"targets translate_moments use_target version ";
/* NAME.h must not hide a header of the standard library or of a compiler. */
static const char *const HEADERS =
	" assert complex cpuid ctype errno fenv float immintrin intrin inttypes iso646 limits "
	"locale math setjmp signal stdalign stdarg stdatomic stdbool stddef stdint stdio stdlib "
	"stdnoreturn string tgmath threads time uchar unistd wchar wctype ";

static int is_listed(const char *list, const char *name)
{
	return strstr(list, format(" %s ", name)) != NULL;
}

static void check_identifier(const char *option, const char *name)
{
	size_t size = strlen(name);
	if (size == 0 || size > MAX_NAME || !(name[0] >= 'a' && name[0] <= 'z')
	    || strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789_") != size)
		fatal(EXIT_USAGE, "%s: '%s' is not a name; use a lower-case letter, then "
			"lower-case letters, digits and _, at most %d in all", option, name,
			MAX_NAME);
	if (is_listed(KEYWORDS, name))
		fatal(EXIT_USAGE, "%s: '%s' is a keyword of C or C++; choose another name", option,
			name);
}

void spec_prefix(const char *text)
{
	check_identifier("--prefix", text);
	if (is_listed(HEADERS, text))
		fatal(EXIT_USAGE, "--prefix: '%s' would hide the standard header %s.h; "
			"choose another name", text, text);
}

/* Reads digits into *value; -1 and more than MAX_DEGREE both fail. */
static const char *read_small(const char *text, int *value)
{
	*value = 0;
	if (!is_digit((unsigned char)*text))
		return NULL;
	for (; is_digit((unsigned char)*text); ++text)
		if ((*value = 10 * *value + (*text - '0')) > 10 * MAX_DEGREE)
			return NULL;
	return *value <= MAX_DEGREE ? text : NULL;
}

int spec_degree(const char *text)
{
	int degree;
	const char *end = read_small(text, &degree);
	if (!end || *end)
		fatal(EXIT_USAGE, "--max-degree: '%s' is not a degree; give a whole number from 0 "
			"to %d (beyond it the exact rationals no longer fit 128 bits)", text,
			MAX_DEGREE);
	return degree;
}

Integrand spec_monomial(const char *text)
{
	int m = 0, n = 0;
	const char *end = text[0] == 'x' ? read_small(text + 1, &m) : NULL;
	end = end && *end == 'y' ? read_small(end + 1, &n) : NULL;
	if (!end || *end)
		fatal(EXIT_USAGE, "'%s' is not a monomial; write xMyN with exponents from 0 to %d, "
			"such as x4y2 or x1y0", text, MAX_DEGREE);
	if (m + n > MAX_DEGREE)
		fatal(EXIT_USAGE, "monomial '%s' has degree %d; at most %d is supported, because "
			"beyond it the exact rationals no longer fit 128 bits", text, m + n,
			MAX_DEGREE);
	Poly integrand = poly_mono(rat(1, 1), mono_var(VAR_X, m) + mono_var(VAR_Y, n));
	return (Integrand){ format("x%dy%d", m, n), m, n, integrand, format("x^%d y^%d", m, n), 0 };
}

static int is_monomial_name(const char *name)
{
	int m, n;
	const char *end = name[0] == 'x' ? read_small(name + 1, &m) : NULL;
	end = end && *end == 'y' ? read_small(end + 1, &n) : NULL;
	return end && (*end == 0 || (*end == 'f' && end[1] == 0));
}

Integrand spec_polynomial(const char *text)
{
	const char *equals = strchr(text, '=');
	if (!equals)
		fatal(EXIT_USAGE, "--polynomial: '%s' has no '='; write NAME=EXPRESSION, "
			"such as soft='(1-x)*(1-y)'", text);
	char *name = copy_string(text, (size_t)(equals - text));
	check_identifier("--polynomial", name);
	size_t size = strlen(name);
	char *stem = copy_string(name, name[size - 1] == 'f' ? size - 1 : size);
	static const char *const families[] = {
		"line_", "quad_", "conic_", "cubic_", "path_", "radius_", "ring_", "filter_", "cpu_",
		"moments_", "ew_",
		"edgewise"
	};
	int taken = is_listed(LIBRARY, name) || is_listed(LIBRARY, stem) || is_monomial_name(name);
	for (int i = 0; i < LENGTH(families); ++i)
		taken |= strncmp(name, families[i], strlen(families[i])) == 0;
	if (taken)
		fatal(EXIT_USAGE, "--polynomial: '%s' is the name of a function of the library; "
			"choose another", name);
	Reader reader = { format("--polynomial %s", name), equals + 1, 0, 0 };
	reading(locate, &reader);
	Poly integrand = read_sum(&reader);
	reading(NULL, NULL);
	if (peek(&reader))
		syntax_error(&reader, reader.at, "expected an operator or the end");
	if (integrand.count == 0)
		syntax_error(&reader, 0, "this polynomial is 0 everywhere");
	return (Integrand){ name, -1, -1, integrand, poly_text(integrand, " "), 0 };
}

unsigned spec_list(const char *option, const char *text, const char *const *words, int count)
{
	unsigned bits = 0;
	for (const char *p = text; ; ++p) {
		size_t size = strcspn(p, ",");
		int found = -1;
		for (int i = 0; i < count; ++i)
			if (strlen(words[i]) == size && memcmp(words[i], p, size) == 0)
				found = i;
		if (found < 0) {
			Text known = { 0 };
			for (int i = 0; i < count; ++i)
				text_add(&known, "%s%s", i ? ", " : "", words[i]);
			fatal(EXIT_USAGE, "%s: unknown word '%.*s'; known: %s", option, (int)size,
				p, text_take(&known));
		}
		bits |= 1u << found;
		p += size;
		if (!*p)
			return bits;
	}
}

/* ---- completing a request ---- */

static void check_names(const Request *request)
{
	for (int i = 0; i < request->monomials; ++i)
		for (int j = 0; j < i; ++j)
			if (strcmp(request->monomial[i].name, request->monomial[j].name) == 0)
				fatal(EXIT_USAGE, "--monomial %s is given twice",
					request->monomial[i].name);
	for (int i = 0; i < request->polynomials; ++i)
		for (int j = 0; j < request->polynomials; ++j) {
			const char *a = request->polynomial[i].name;
			const char *b = request->polynomial[j].name;
			if (i != j && strcmp(a, b) == 0)
				fatal(EXIT_USAGE, "two polynomials are called '%s'", a);
			if (i != j && strcmp(format("%sf", a), b) == 0)
				fatal(EXIT_USAGE, "polynomial '%s' has the name of the float "
					"version of '%s'", b, a);
		}
}

const char *const family_names[FAMILIES] = { "moments", "curves", "distance", "closure" };
const char *const edge_names[EDGES] = { "line", "quad", "conic", "cubic" };
const char *const target_names[TARGETS] = { "portable", "fma", "avx2", "avx512", "neon" };

static void add_list(Text *text, const char *option, unsigned bits, const char *const *names,
	int count)
{
	for (int i = 0, first = 1; i < count; ++i)
		if (bits & 1u << i) {
			text_add(text, first ? " %s %s" : "%.0s,%s", option, names[i]);
			first = 0;
		}
}

static const char *canonical_command(const Request *request, unsigned families, unsigned edges)
{
	Text text = { 0 };
	text_add(&text, "gen");
	if (request->moments >= 0)
		text_add(&text, " --max-degree %d", request->moments);
	add_list(&text, "--families", families, family_names, FAMILIES);
	add_list(&text, "--edges", edges, edge_names, EDGES);
	for (int i = 0; i < request->monomials; ++i)
		text_add(&text, " --monomial %s", request->monomial[i].name);
	for (int i = 0; i < request->polynomials; ++i)
		text_add(&text, " --polynomial %s='%s'", request->polynomial[i].name,
			poly_text(request->polynomial[i].integrand, "*"));
	if (request->precisions != (PRECISION_DOUBLE | PRECISION_FLOAT))
		text_add(&text, " --precision %s",
			request->precisions == PRECISION_FLOAT ? "float" : "double");
	if (request->targets != ALL_TARGETS)
		add_list(&text, "--targets", request->targets, target_names, TARGETS);
	if (request->scheme)
		text_add(&text, " --scheme %s", request->scheme);
	if (request->prefix)
		text_add(&text, " --prefix %s", request->prefix);
	return text_take(&text);
}

int spec_has_rings(const Request *request)
{
	return request->families || request->polynomials
		|| (request->monomials && request->edges & EDGE_LINE);
}

/* Which families and edges: all of the library, unless only some integrands are asked for. */
static void complete_families(Request *request)
{
	const int asked = request->edges != 0;
	if (!request->families && (request->moments >= 0
	    || (request->monomials == 0 && request->polynomials == 0)))
		request->families = ALL_FAMILIES;
	if (request->families & FAMILY_CURVES)
		request->families |= FAMILY_MOMENTS;
	if (request->moments >= 0 && !(request->families & FAMILY_MOMENTS))
		fatal(EXIT_USAGE, "--max-degree goes with the families moments and curves");
	if (request->families & FAMILY_MOMENTS && request->moments < 0)
		request->moments = 4;
	if (!request->edges)
		request->edges = request->families & FAMILY_CURVES ? ALL_EDGES : EDGE_LINE;
	if (request->polynomials && !(request->edges & EDGE_LINE))
		fatal(EXIT_USAGE, "--polynomial: polynomials are integrated over line edges; add line "
			"to --edges");
	if (request->monomials && !request->families && request->edges & EDGE_CONIC)
		fatal(EXIT_USAGE, "--monomial: one monomial over conics is not emitted alone; use "
			"--max-degree");
	if (request->families)
		request->edges |= EDGE_LINE;
	if (request->edges == EDGE_LINE)
		request->families &= ~(unsigned)FAMILY_CURVES;
	request->curves = -1;
	if (request->families & FAMILY_CURVES)
		request->curves = asked || request->moments < CURVE_DEGREE ? request->moments
			: CURVE_DEGREE;
}

void spec_complete(Request *request)
{
	check_names(request);
	request->targets |= TARGET_PORTABLE;
	const unsigned families = request->families, edges = request->edges;
	complete_families(request);
	request->command = canonical_command(request, families, edges);
	int family = request->moments < 0 ? 0 : (request->moments + 1) * (request->moments + 2) / 2;
	int count = 0;
	Integrand *all = allocate((size_t)(family + request->monomials) * sizeof *all);
	for (int d = 0; d <= request->moments; ++d)
		for (int n = 0; n <= d; ++n)
			all[count++] = spec_monomial(format("x%dy%d", d - n, n));
	for (int i = 0; i < request->monomials; ++i) {
		const Integrand *monomial = &request->monomial[i];
		int at = (monomial->m + monomial->n) * (monomial->m + monomial->n + 1) / 2
			+ monomial->n;
		if (monomial->m + monomial->n > request->moments)
			all[at = count++] = *monomial;
		all[at].by_name = 1;
	}
	request->monomial = all;
	request->monomials = count;
}

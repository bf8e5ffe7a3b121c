/* spec.c - what is asked for, and its grammar.
 *
 *     monomial    xMyN                                   x4y2
 *     polynomial  NAME=EXPRESSION                        soft=(1-x)*(1-y)
 *
 * Words of options become bits; at the end, what was not said is filled in: families, edges,
 * the monomials and filters of families, and the canonical command line, which depends on what was
 * asked for and not on how. No two names may be one, nor be the float twin of another. */
#include "gen.h"

#include <stdlib.h>
#include <string.h>

/* NAME.h must not hide a header of the standard library or of a compiler. */
static const char *const HEADERS =
	" assert complex cpuid ctype errno fenv float immintrin intrin inttypes iso646 limits "
	"locale math setjmp signal stdalign stdarg stdatomic stdbool stddef stdint stdio stdlib "
	"stdnoreturn string tgmath threads time uchar unistd wchar wctype ";

void spec_prefix(const char *text)
{
	check_identifier("--prefix", text);
	if (is_listed(HEADERS, text))
		fatal(EXIT_USAGE, "--prefix: '%s' would hide the standard header %s.h; "
			"choose another name", text, text);
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

Integrand spec_polynomial(const char *text)
{
	const char *equals = strchr(text, '=');
	if (!equals)
		fatal(EXIT_USAGE, "--polynomial: '%s' has no '='; write NAME=EXPRESSION, "
			"such as soft='(1-x)*(1-y)'", text);
	char *name = copy_string(text, (size_t)(equals - text));
	check_identifier("--polynomial", name);
	check_free("--polynomial", name);
	if (filter_is_builtin(name) || filter_is_builtin(name_stem(name)))
		fatal(EXIT_USAGE, "--polynomial: '%s' is the name of a filter of the library; "
			"choose another", name);
	Reader reader = { format("--polynomial %s", name), equals + 1, 0, 0, 0, NULL };
	reading(reader_locate, &reader);
	Poly integrand = read_sum(&reader);
	reading(NULL, NULL);
	if (reader_peek(&reader))
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

typedef struct { const char *kind, *name; } Named;

/* Polynomials, then filters. */
static Named named(const Request *request, int i)
{
	if (i < request->polynomials)
		return (Named){ "polynomial", request->polynomial[i].name };
	return (Named){ "filter", request->filter[i - request->polynomials].name };
}

static void check_names(const Request *request)
{
	for (int i = 0; i < request->monomials; ++i)
		for (int j = 0; j < i; ++j)
			if (strcmp(request->monomial[i].name, request->monomial[j].name) == 0)
				fatal(EXIT_USAGE, "--monomial %s is given twice",
					request->monomial[i].name);
	const int polynomials = request->polynomials, all = polynomials + request->filters;
	for (int i = 0; i < all; ++i)
		for (int j = 0; j < all; ++j) {
			Named a = named(request, i), b = named(request, j);
			if (i < j && strcmp(a.name, b.name) == 0)
				fatal(EXIT_USAGE, j < polynomials ? "two polynomials are called "
					"'%s'" : i >= polynomials ? "two filters are called '%s'"
					: "a polynomial and a filter are called '%s'", a.name);
			if (i != j && strcmp(format("%sf", a.name), b.name) == 0)
				fatal(EXIT_USAGE, "%s '%s' has the name of the float version of "
					"'%s'", b.kind, b.name, a.name);
		}
}

const char *const family_names[FAMILIES] = {
	"moments", "curves", "distance", "closure", "coverage", "filters"
};
const char *const edge_names[EDGES] = { "line", "quad", "conic", "cubic" };
const char *const target_names[TARGETS] = {
	"portable", "fma", "avx2", "avx512", "neon", "wasm128"
};

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
	for (int i = 0; i < request->filters; ++i)
		text_add(&text, " --filter %s%s", request->filter[i].name,
			request->filter[i].builtin ? "" : ".filter");
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

char *spec_files(const Request *request)
{
	Text text = { 0 };
	for (int i = 0; i < request->filters; ++i) {
		const Filter *filter = &request->filter[i];
		if (filter->builtin)
			continue;
		text_add(&text, "/* %s.filter:\n *\n", filter->name);
		for (const char *line = filter_canonical(filter); *line; ) {
			const int size = (int)strcspn(line, "\n");
			text_add(&text, " *     %.*s\n", size, line);
			line += size + 1;
		}
		text_add(&text, " */\n");
	}
	return text_take(&text);
}

const char *const *spec_paths(const Request *request)
{
	const char **paths = allocate((size_t)(request->filters + 1) * sizeof *paths);
	int count = 0;
	for (int i = 0; i < request->filters; ++i)
		if (request->filter[i].path)
			paths[count++] = request->filter[i].path;
	return paths;
}

int spec_has_rings(const Request *request)
{
	return request->families || request->polynomials || request->filters
		|| (request->monomials && request->edges & EDGE_LINE);
}

/* Which families and edges: all of the library, unless only some integrands are asked for. */
static void complete_families(Request *request)
{
	const int asked = request->edges != 0;
	if (!request->families && (request->moments >= 0
	    || (request->monomials == 0 && request->polynomials == 0 && request->filters == 0)))
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
		fatal(EXIT_USAGE, "--polynomial: polynomials are integrated over line edges; "
			"add line to --edges");
	if (request->filters && !(request->edges & EDGE_LINE))
		fatal(EXIT_USAGE, "--filter: filters are integrated over line edges; add line to "
			"--edges");
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

static void complete_monomials(Request *request)
{
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

/* The family's filters, then those of files. */
static void complete_filters(Request *request)
{
	const char *const *names = filter_names();
	int count = 0, builtins = 0;
	while (names[builtins])
		++builtins;
	Filter *all = allocate((size_t)(builtins + request->filters) * sizeof *all);
	for (int i = 0; i < builtins && request->families & FAMILY_FILTERS; ++i)
		all[count++] = filter_read(names[i]);
	for (int i = 0; i < request->filters; ++i) {
		int at = 0;
		while (at < count && strcmp(all[at].name, request->filter[i].name) != 0)
			++at;
		all[at] = request->filter[i];
		count += at == count;
	}
	request->filter = all;
	request->filters = count;
}

void spec_complete(Request *request)
{
	check_names(request);
	request->targets |= TARGET_PORTABLE;
	const unsigned families = request->families, edges = request->edges;
	complete_families(request);
	request->command = canonical_command(request, families, edges);
	complete_monomials(request);
	complete_filters(request);
}

/* expression.c - what users write: names, numbers and polynomials, and errors that show the spot.
 *
 *     expression  sum of terms: + - * / ^ ( ), x, y, integers and decimals;
 *                 division by constants only
 *
 * Everything is exact. A Reader walks over a text; a mistake ends the program with the line, the
 * column and a caret under the spot. A text of one expression ends with its last character; in a
 * text of lines, what is read ends with the line or at a comment (#). Names become parts of C
 * identifiers, so C and C++ keywords and the names of the library's own functions are refused. */
#include "gen.h"

#include <string.h>

enum { MAX_NESTING = 100 };
enum { MAX_DIGITS = 39 };                            /* of the largest coefficient */
enum { BEFORE = 60, BEHIND = 60 };                   /* bytes shown around an error */

/* ---- the spot ---- */

size_t utf8_size(const char *text)
{
	static const struct { unsigned char first, last, low, high; size_t size; } kinds[] = {
		{ 0x01, 0x7f, 0, 0, 1 }, { 0xc2, 0xdf, 0x80, 0xbf, 2 },
		{ 0xe0, 0xe0, 0xa0, 0xbf, 3 }, { 0xe1, 0xec, 0x80, 0xbf, 3 },
		{ 0xed, 0xed, 0x80, 0x9f, 3 }, { 0xee, 0xef, 0x80, 0xbf, 3 },
		{ 0xf0, 0xf0, 0x90, 0xbf, 4 }, { 0xf1, 0xf3, 0x80, 0xbf, 4 },
		{ 0xf4, 0xf4, 0x80, 0x8f, 4 },
	};
	const unsigned char *p = (const unsigned char *)text;
	for (int i = 0; i < LENGTH(kinds); ++i) {
		if (p[0] < kinds[i].first || p[0] > kinds[i].last)
			continue;
		if (kinds[i].size > 1 && (p[1] < kinds[i].low || p[1] > kinds[i].high))
			return 0;
		for (size_t k = 2; k < kinds[i].size; ++k)
			if (p[k] < 0x80 || p[k] > 0xbf)
				return 0;
		return kinds[i].size;
	}
	return 0;
}

/* Appends text[from .. to-1] fit for a terminal: ? for what is no character. */
static void add_shown(Text *out, const char *text, size_t from, size_t to)
{
	for (size_t i = from; i < to; ) {
		size_t size = utf8_size(text + i);
		int control = size == 1 && text[i] != '\t' && (text[i] < ' ' || text[i] == 127);
		if (size == 0 || control || i + size > to)
			text_add(out, "?");
		else
			text_append(out, text + i, size);
		i += size ? size : 1;
	}
}

char *reader_word(const Reader *reader, const char *ends)
{
	Text word = { 0 };
	const size_t size = strcspn(reader->text + reader->at, ends), most = MAX_NAME + 1;
	add_shown(&word, reader->text, reader->at, reader->at + (size < most ? size : most));
	return text_take(&word);
}

int reader_line(const Reader *reader, size_t at)
{
	int line = 1;
	for (size_t i = 0; i < at; ++i)
		line += reader->text[i] == '\n';
	return line;
}

/* The message, the part of the line around the spot, and a caret under it. */
static char *locate_at(const Reader *reader, size_t at, const char *message)
{
	const char *text = reader->text;
	size_t start = at, end = at;
	while (start > 0 && text[start - 1] != '\n')
		--start;
	size_t shown = start;
	int column = 1;
	for (size_t i = start; i < at; ++column) {
		size_t size = utf8_size(text + i);
		i += size ? size : 1;
		if (at - shown > BEFORE)
			shown = i;
	}
	while (end - at < BEHIND && text[end] && text[end] != '\n' && text[end] != '\r')
		++end;
	while (((unsigned char)text[end] & 0xc0) == 0x80)    /* the rest of a character */
		++end;
	Text out = { 0 };
	text_add(&out, "%s: line %d, column %d: %s\n  ", reader->what, reader_line(reader, at),
		column, message);
	add_shown(&out, text, shown, end);
	text_add(&out, "\n  ");
	for (size_t i = shown, size; i < at; i += size ? size : 1) {
		size = utf8_size(text + i);
		text_add(&out, text[i] == '\t' ? "\t" : " ");
	}
	text_add(&out, "^");
	return text_take(&out);
}

char *reader_locate(const void *reader, const char *message)
{
	return locate_at(reader, ((const Reader *)reader)->at, message);
}

void syntax_error(const Reader *reader, size_t at, const char *message)
{
	reading(NULL, NULL);
	fatal(EXIT_USAGE, "%s", locate_at(reader, at, message));
}

int reader_peek(Reader *reader)
{
	const char *blanks = reader->lines ? " \t\r" : " \t\r\n";
	while (reader->text[reader->at] && strchr(blanks, reader->text[reader->at]))
		++reader->at;
	int c = (unsigned char)reader->text[reader->at];
	return reader->lines && (c == '\n' || c == '#') ? 0 : c;
}

/* ---- numbers ---- */

int is_digit(int c)
{
	return c >= '0' && c <= '9';
}

Rat read_number(Reader *reader)
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
		num = int_add(int_mul(10, num), c - '0');
		den = int_mul(point ? 10 : 1, den);
	}
	return rat(num, den);
}

const char *read_small(const char *text, int *value)
{
	*value = 0;
	if (!is_digit((unsigned char)*text))
		return NULL;
	for (; is_digit((unsigned char)*text); ++text)
		if ((*value = 10 * *value + (*text - '0')) > 10 * MAX_DEGREE)
			return NULL;
	return *value <= MAX_DEGREE ? text : NULL;
}

/* ---- polynomials ---- */

int degree_in_xy(Poly a)
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

static int read_exponent(Reader *reader)
{
	reader_peek(reader);
	size_t start = reader->at;
	if (!is_digit(reader_peek(reader)))
		syntax_error(reader, start, "expected an exponent: a whole number from 0 to 32");
	Rat value = read_number(reader);
	if (value.den != 1 || value.num > MAX_DEGREE)
		syntax_error(reader, start, "expected an exponent: a whole number from 0 to 32");
	return (int)value.num;
}

static Poly read_variable(Reader *reader, int var)
{
	if (var == VAR_Y && reader->no_y)
		syntax_error(reader, reader->at, reader->no_y);
	++reader->at;
	return poly_var(var);
}

static Poly read_base(Reader *reader)
{
	const char *bases = reader->no_y ? "a number, x or '('" : "a number, x, y or '('";
	int c = reader_peek(reader);
	size_t start = reader->at;
	if (is_digit(c))
		return poly_const(read_number(reader));
	size_t letters = c ? strspn(reader->text + start,
		"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_") : 0;
	if (letters == 1 && (c == 'x' || c == 'y'))
		return read_variable(reader, c == 'x' ? VAR_X : VAR_Y);
	if (letters)
		syntax_error(reader, start, format("expected %s, not the name '%.*s'; products "
			"need a *", bases, letters > MAX_NAME ? MAX_NAME : (int)letters,
			reader->text + start));
	if (c != '(')
		syntax_error(reader, start, format("expected %s", bases));
	if (++reader->nesting > MAX_NESTING)
		syntax_error(reader, start, "parentheses are nested too deeply");
	++reader->at;
	Poly inside = read_sum(reader);
	if (reader_peek(reader) != ')')
		syntax_error(reader, reader->at, "expected an operator or ')'");
	++reader->at;
	--reader->nesting;
	return inside;
}

static Poly read_factor(Reader *reader)
{
	if (reader_peek(reader) == '-') {
		if (++reader->nesting > MAX_NESTING)
			syntax_error(reader, reader->at, "too many signs in a row");
		++reader->at;
		Poly negated = poly_scale(read_factor(reader), rat(-1, 1));
		--reader->nesting;
		return negated;
	}
	size_t start = reader->at;
	Poly base = read_base(reader);
	if (reader_peek(reader) != '^')
		return base;
	++reader->at;
	int power = read_exponent(reader);
	check_degree(reader, start, degree_in_xy(base) * power);
	return poly_pow(base, power);
}

static Poly read_product(Reader *reader)
{
	Poly product = read_factor(reader);
	for (int c; (c = reader_peek(reader)) == '*' || c == '/'; ) {
		++reader->at;
		reader_peek(reader);
		size_t start = reader->at;
		Poly factor = read_factor(reader);
		if (c == '/' && (factor.count == 0 || factor.term[0].mono != 0))
			syntax_error(reader, start, factor.count
				? "division by something that is not a number"
				: "division by zero");
		if (c == '/')
			factor = poly_const(rat_div(rat(1, 1), factor.term[0].coef));
		check_degree(reader, start, degree_in_xy(product) + degree_in_xy(factor));
		product = poly_mul(product, factor);
	}
	return product;
}

Poly read_sum(Reader *reader)
{
	Poly sum = read_product(reader);
	for (int c; (c = reader_peek(reader)) == '+' || c == '-'; ) {
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
	"coverage cubic cubic_area cubic_moments conic conic_area conic_moments deposit distance "
	"filter is_closed line line_area moment moments moments_about moments_bounded "
	"moments_rings moments_xy path path_moments quad quad_area quad_moments radius raster "
	"raster_path raster_u8 target_name targets translate_moments use_target version ";

int is_listed(const char *list, const char *name)
{
	return strstr(list, format(" %s ", name)) != NULL;
}

void check_identifier(const char *option, const char *name)
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

static int is_monomial_name(const char *name)
{
	int m, n;
	const char *end = name[0] == 'x' ? read_small(name + 1, &m) : NULL;
	end = end && *end == 'y' ? read_small(end + 1, &n) : NULL;
	return end && (*end == 0 || (*end == 'f' && end[1] == 0));
}

char *name_stem(const char *name)
{
	size_t size = strlen(name);
	return copy_string(name, size - (size > 0 && name[size - 1] == 'f'));
}

void check_free(const char *option, const char *name)
{
	static const char *const families[] = {
		"line_", "quad_", "conic_", "cubic_", "path_", "radius_", "ring_", "filter_",
		"raster_", "deposit_", "cpu_", "moments_", "ew_", "edgewise"
	};
	int taken = is_listed(LIBRARY, name) || is_listed(LIBRARY, name_stem(name))
		|| is_monomial_name(name);
	for (int i = 0; i < LENGTH(families); ++i)
		taken |= strncmp(name, families[i], strlen(families[i])) == 0;
	if (taken)
		fatal(EXIT_USAGE, "%s: '%s' is the name of a function of the library; choose "
			"another", option, name);
}

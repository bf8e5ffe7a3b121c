/* filter.c - filter files: reading and writing them.
 *
 *     filter NAME                                 # then one of
 *     separable          separable even           bivariate
 *     piece X0 X1 : EXPRESSION                    # k(x): f(x,y) = k(x) k(y); even: x >= 0 only
 *     piece X0 X1 Y0 Y1 : EXPRESSION              # bivariate: f(x,y)
 *
 * UTF-8, one statement per line, # begins a comment. Knots are numbers like 2, 0.5 and -3/2; pieces
 * may come in any order and leave gaps, where the filter is 0. Every mistake has a line and a
 * column, overflow of the exact rationals included. The built-in filters are files of this
 * kind, embedded into gen. Where a file lies has no influence on what is emitted: it is called
 * NAME.filter. A file with the name of a built-in filter must be that filter. */
#include "gen.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { MAX_FILE = 1 << 16, MAX_PIECES = 256, MAX_REACH = 1024 };
enum { WORD_FILTER, WORD_SEPARABLE, WORD_BIVARIATE, WORD_PIECE, WORDS };

#define BLANKS " \t\r\n#"

static const char *const words[WORDS] = { "filter", "separable", "bivariate", "piece" };

/* A file being read, and where its pieces stand. */
typedef struct { Reader reader; Filter filter; size_t *spot; } Source;

/* ---- built-in filters ---- */

const char *const *filter_names(void)
{
	int count = 0;
	while (embedded_filters[count].name)
		++count;
	const char **names = allocate((size_t)(count + 1) * sizeof *names);
	for (int i = 0; i < count; ++i)
		names[i] = copy_string(embedded_filters[i].name,
			strcspn(embedded_filters[i].name, "."));
	return names;
}

/* Both catmull-rom and catmull_rom. */
static const Embedded *find_builtin(const char *word)
{
	char *name = copy_string(word, strlen(word));
	for (char *p = name; *p; ++p)
		*p = *p == '-' ? '_' : *p;
	for (const Embedded *file = embedded_filters; file->name; ++file)
		if (strcmp(file->name, format("%s.filter", name)) == 0)
			return file;
	return NULL;
}

int filter_is_builtin(const char *word)
{
	return find_builtin(word) != NULL;
}

/* ---- lines and words ---- */

/* Goes to the next statement; returns 0 if there is none. */
static int next_statement(Reader *reader)
{
	while (!reader_peek(reader) && reader->text[reader->at]) {
		reader->at += strcspn(reader->text + reader->at, "\n");
		reader->at += reader->text[reader->at] == '\n';
	}
	return reader->text[reader->at] != 0;
}

static void end_statement(Reader *reader, const char *expected)
{
	if (reader_peek(reader))
		syntax_error(reader, reader->at, format("expected %s", expected));
}

/* Reads one of the words of this bit set. */
static int expect_word(Reader *reader, unsigned wanted, const char *expected)
{
	if (!next_statement(reader))
		syntax_error(reader, reader->at, format("expected %s, but the file ends here",
			expected));
	const char *word = reader_word(reader, BLANKS ":");
	int which = 0;
	while (which < WORDS && strcmp(word, words[which]) != 0)
		++which;
	if (which == WORDS)
		syntax_error(reader, reader->at, format("expected %s", expected));
	if (!(wanted & 1u << which))
		syntax_error(reader, reader->at, format("expected %s, not '%s' here", expected,
			word));
	reader->at += strlen(word);
	return which;
}

/* ---- statements ---- */

static void read_name(Source *source)
{
	Reader *reader = &source->reader;
	expect_word(reader, 1u << WORD_FILTER, "'filter NAME', with which a filter file begins");
	if (!reader_peek(reader))
		syntax_error(reader, reader->at, "expected the name of the filter");
	source->filter.name = reader_word(reader, BLANKS);
	check_identifier("the name of a filter", source->filter.name);
	check_free("the name of a filter", source->filter.name);
	const char *stem = name_stem(source->filter.name);
	if (strcmp(stem, source->filter.name) != 0 && filter_is_builtin(stem))
		fatal(EXIT_USAGE, "'%s' is the float version of the built-in filter '%s'; choose "
			"another name", source->filter.name, stem);
	reader->at += strlen(source->filter.name);
	end_statement(reader, "the end of the line");
}

static void read_kind(Source *source)
{
	Reader *reader = &source->reader;
	int which = expect_word(reader, 1u << WORD_SEPARABLE | 1u << WORD_BIVARIATE,
		"'separable', 'separable even' or 'bivariate'");
	source->filter.separable = which == WORD_SEPARABLE;
	reader_peek(reader);
	if (which == WORD_SEPARABLE && strcmp(reader_word(reader, BLANKS), "even") == 0) {
		source->filter.even = 1;
		reader->at += strlen("even");
	}
	end_statement(reader, which == WORD_BIVARIATE || source->filter.even
		? "the end of the line" : "'even' or the end of the line");
}

static Rat read_knot(Source *source, const char *which)
{
	Reader *reader = &source->reader;
	int c = reader_peek(reader);
	const size_t start = reader->at;
	const int negative = c == '-';
	if (negative) {
		++reader->at;
		c = reader_peek(reader);
	}
	if (!is_digit(c))
		syntax_error(reader, start, format("expected %s, a number such as 2, 0.5 or -3/2",
			which));
	Rat knot = read_number(reader);
	if (reader_peek(reader) == '/') {
		++reader->at;
		c = reader_peek(reader);
		const size_t divisor = reader->at;
		const Rat by = is_digit(c) ? read_number(reader) : rat(0, 1);
		if (by.num == 0)
			syntax_error(reader, divisor, is_digit(c) ? "division by zero"
				: "expected a number, the divisor of this knot");
		knot = rat_div(knot, by);
	}
	c = reader_peek(reader);
	if (c && c != ':' && !strchr(" \t\r", reader->text[reader->at - 1]))
		syntax_error(reader, reader->at, format("expected a blank after %s", which));
	if (rat_compare(knot, rat(MAX_REACH, 1)) > 0)
		syntax_error(reader, start, format("a knot is at most %d pixels from the centre",
			MAX_REACH));
	if (negative && knot.num && source->filter.even)
		syntax_error(reader, start, "an even filter is given for x >= 0 only, because "
			"k(-x) = k(x); leave out 'even' or the pieces below 0");
	return negative ? rat_neg(knot) : knot;
}

static void read_interval(Source *source, const char *const *which, Rat *from, Rat *to)
{
	*from = read_knot(source, which[0]);
	reader_peek(&source->reader);
	const size_t start = source->reader.at;
	*to = read_knot(source, which[1]);
	const int order = rat_compare(*from, *to);
	if (order >= 0)
		syntax_error(&source->reader, start, format(order ? "the interval is reversed: "
			"expected %s greater than %s" : "the interval is empty: expected %s "
			"greater than %s", which[1], which[0]));
}

static int overlaps(const Piece *a, const Piece *b, int separable)
{
	return rat_compare(a->x0, b->x1) < 0 && rat_compare(b->x0, a->x1) < 0 && (separable
		|| (rat_compare(a->y0, b->y1) < 0 && rat_compare(b->y0, a->y1) < 0));
}

static void check_overlap(const Source *source, const Piece *piece, size_t spot)
{
	const Filter *filter = &source->filter;
	for (int i = 0; i < filter->pieces; ++i)
		if (overlaps(&filter->piece[i], piece, filter->separable))
			syntax_error(&source->reader, spot, format("this piece overlaps the piece "
				"of line %d", reader_line(&source->reader, source->spot[i])));
}

/* What overflows in the analysis of one piece should be found at that piece. */
static void try_piece(Source *source, Piece piece, size_t spot)
{
	Filter alone = { .separable = source->filter.separable, .piece = &piece, .pieces = 1 };
	const Mark mark = arena_mark();
	const size_t end = source->reader.at;
	source->reader.at = spot;
	if (piece.value.count)
		analyse(&alone);
	source->reader.at = end;
	arena_release(mark);
}

static void read_piece(Source *source)
{
	static const char *const knots[] = { "X0", "X1", "Y0", "Y1" };
	Reader *reader = &source->reader;
	Filter *filter = &source->filter;
	Piece piece = { .y0 = rat(0, 1), .y1 = rat(0, 1) };
	expect_word(reader, 1u << WORD_PIECE, filter->separable
		? "'piece X0 X1 : EXPRESSION'" : "'piece X0 X1 Y0 Y1 : EXPRESSION'");
	reader_peek(reader);
	const size_t spot = reader->at;
	read_interval(source, knots, &piece.x0, &piece.x1);
	if (!filter->separable)
		read_interval(source, knots + 2, &piece.y0, &piece.y1);
	if (reader_peek(reader) != ':')
		syntax_error(reader, reader->at, filter->separable
			? "expected ':'; a piece of a separable filter has the knots X0 X1"
			: "expected ':' after the four knots");
	check_overlap(source, &piece, spot);
	if (filter->pieces == MAX_PIECES)
		syntax_error(reader, spot, format("a filter has at most %d pieces", MAX_PIECES));
	++reader->at;
	reader_peek(reader);
	const size_t expression = reader->at;
	piece.value = read_sum(reader);
	end_statement(reader, "an operator or the end of the line");
	try_piece(source, piece, expression);
	source->spot[filter->pieces] = spot;
	filter->piece[filter->pieces++] = piece;
}

/* ---- files ---- */

static void check_text(const Reader *reader, size_t size)
{
	for (size_t i = 0, step; i < size; i += step) {
		step = utf8_size(reader->text + i);
		if (step == 0)
			syntax_error(reader, i, reader->text[i] ? "this is not UTF-8 text"
				: "a zero byte; a filter file is UTF-8 text");
	}
}

Filter filter_parse(const char *what, const char *text, size_t size)
{
	static const char mark[] = "\xef\xbb\xbf";           /* that some editors begin with */
	const size_t skipped = size >= 3 && memcmp(text, mark, 3) == 0 ? 3 : 0;
	Source source = { .reader = { .what = what, .text = text + skipped, .lines = 1 } };
	Reader *reader = &source.reader;
	Filter *filter = &source.filter;
	check_text(reader, size - skipped);
	reading(reader_locate, reader);
	filter->piece = allocate(MAX_PIECES * sizeof *filter->piece);
	source.spot = allocate(MAX_PIECES * sizeof *source.spot);
	next_statement(reader);
	const size_t beginning = reader->at;
	read_name(&source);
	read_kind(&source);
	if (filter->separable)
		reader->no_y = "y in a separable filter, which is k(x) k(y): write k in x alone, "
			"or declare the filter bivariate";
	do
		read_piece(&source);
	while (next_statement(reader));
	reader->at = beginning;
	analyse(filter);
	reading(NULL, NULL);
	return *filter;
}

static char *read_file(const char *path, size_t *size)
{
	FILE *file = fopen(path, "rb");
	if (!file) {
		Text known = { 0 };
		for (const char *const *name = filter_names(); *name; ++name)
			text_add(&known, "%s%s", known.size ? ", " : "", *name);
		fatal(EXIT_USAGE, "--filter: '%s' is no built-in filter (%s), and as a file it "
			"cannot be opened: %s", path, text_take(&known), strerror(errno));
	}
	char *text = allocate(MAX_FILE + 2);
	*size = fread(text, 1, MAX_FILE + 1, file);
	const int error = ferror(file) ? errno : 0;
	fclose(file);
	if (error)
		fatal(EXIT_USAGE, "--filter: cannot read %s: %s", path, strerror(error));
	if (*size > MAX_FILE)
		fatal(EXIT_USAGE, "--filter: %s is larger than %d bytes; no filter file is", path,
			MAX_FILE);
	text[*size] = 0;
	return text;
}

static Filter read_builtin(const Embedded *file)
{
	Filter filter = filter_parse(format("built-in %s", file->name), file->text, file->size);
	filter.builtin = 1;
	return filter;
}

Filter filter_read(const char *word)
{
	const Embedded *embedded = find_builtin(word);
	if (embedded)
		return read_builtin(embedded);
	size_t size;
	char *text = read_file(word, &size);
	Filter filter = filter_parse(word, text, size);
	embedded = find_builtin(filter.name);
	if (embedded) {
		Filter builtin = read_builtin(embedded);
		if (strcmp(filter_canonical(&filter), filter_canonical(&builtin)) != 0)
			fatal(EXIT_USAGE, "%s: '%s' is the name of a built-in filter, and this is "
				"another; choose another name", word, filter.name);
		filter = builtin;
	}
	filter.path = copy_string(word, strlen(word));
	return filter;
}

/* ---- writing ---- */

static char *kind_of(const Filter *filter, const char *between)
{
	return filter->separable ? format("separable%s%s", filter->even ? between : "",
		filter->even ? "even" : "") : format("bivariate");
}

char *filter_canonical(const Filter *filter)
{
	Text text = { 0 };
	text_add(&text, "filter %s\n%s\n", filter->name, kind_of(filter, " "));
	for (int i = 0; i < filter->pieces; ++i) {
		const Piece *piece = &filter->piece[i];
		const Rat zero = rat(0, 1);
		if (filter->even && rat_sign(piece->x1) <= 0)
			continue;
		const int cut = filter->even && rat_sign(piece->x0) < 0;
		text_add(&text, "piece %s %s", rat_text(cut ? zero : piece->x0),
			rat_text(piece->x1));
		if (!filter->separable)
			text_add(&text, " %s %s", rat_text(piece->y0), rat_text(piece->y1));
		text_add(&text, " : %s\n", poly_text(piece->value, "*"));
	}
	return text_take(&text);
}

static char *size_of(const Filter *filter)
{
	const struct { Rat first, last; int size; } axes[] = {
		{ filter->first_x, filter->last_x, filter->size_x },
		{ filter->first_y, filter->last_y, filter->size_y },
	};
	char *text[2];
	for (int axis = 0; axis < 2; ++axis)
		text[axis] = rat_text(rat_sub(axes[axis].last, axes[axis].first));
	return format("%s x %s pixels", text[0], text[1]);
}

static char *smoothness(const Filter *filter)
{
	if (filter->continuity < 0)
		return format("discontinuous");
	return filter->continuity == 0 ? format("continuous") : format("continuous with %d "
		"derivative%s", filter->continuity, filter->continuity == 1 ? "" : "s");
}

char *filter_summary(const Filter *filter)
{
	return format("%s, degree %d, %s, %s, integral %s, %spartition of unity",
		kind_of(filter, ", "), filter->degree, size_of(filter), smoothness(filter),
		rat_text(filter->integral), filter->unity ? "" : "no ");
}

void filter_describe(Text *text, const Filter *filter)
{
	const int aligned = filter->size_x && filter->size_y;
	text_add(text, "filter %s: %s, degree %d\n", filter->name, kind_of(filter, ", "),
		filter->degree);
	text_add(text, "  support %s <= x <= %s, %s <= y <= %s: %s, knots %swhole pixels apart\n",
		rat_text(filter->first_x), rat_text(filter->last_x), rat_text(filter->first_y),
		rat_text(filter->last_y), size_of(filter), aligned ? "" : "not all ");
	text_add(text, "  integral %s: %snormalised\n", rat_text(filter->integral),
		rat_is(filter->integral, 1) ? "" : "not ");
	text_add(text, "  %s\n", smoothness(filter));
	text_add(text, "  %spartition of unity\n", filter->unity ? "" : "no ");
}

static void show_text(Text *text, const Filter *filter)
{
	text_add(text, "%s", filter_canonical(filter));
	filter_describe(text, filter);
}

static void show_json(Text *text, const Filter *filter)
{
	static const char *const truth[] = { "false", "true" };
	text_add(text, "{\"filter\": \"%s\", \"separable\": %s, \"even\": %s, \"degree\": %d,\n"
		" \"x\": [\"%s\", \"%s\"], \"y\": [\"%s\", \"%s\"], \"size\": [%d, %d],\n"
		" \"integral\": \"%s\", \"continuity\": %d, \"unity\": %s,\n \"pieces\": [",
		filter->name, truth[filter->separable], truth[filter->even], filter->degree,
		rat_text(filter->first_x), rat_text(filter->last_x), rat_text(filter->first_y),
		rat_text(filter->last_y), filter->size_x, filter->size_y,
		rat_text(filter->integral), filter->continuity, truth[filter->unity]);
	for (int i = 0; i < filter->pieces; ++i) {
		const Piece *piece = &filter->piece[i];
		text_add(text, "%s\n  {\"x\": [\"%s\", \"%s\"], ", i ? "," : "",
			rat_text(piece->x0), rat_text(piece->x1));
		if (!filter->separable)
			text_add(text, "\"y\": [\"%s\", \"%s\"], ", rat_text(piece->y0),
				rat_text(piece->y1));
		text_add(text, "\"value\": \"%s\"}", poly_text(piece->value, "*"));
	}
	text_add(text, "\n ]}\n");
}

void filter_show(Text *text, const Filter *filter, const char *format_name)
{
	if (strcmp(format_name, "text") == 0)
		show_text(text, filter);
	else if (strcmp(format_name, "json") == 0)
		show_json(text, filter);
	else
		fatal(EXIT_USAGE, "--format: a filter is shown as text or json, not as '%s'",
			format_name);
}

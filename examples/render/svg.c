/* svg.c - paths of SVG: the grammar of the attribute d, and the files it stands in.
 *
 * All commands of SVG 1.1 and 2, M L H V C S Q T A Z and lower case, with the grammar's freedom of
 * separators ("M0-1.5.5" are three numbers). Elliptical arcs become conics, at most a quarter turn
 * each, exactly as long as the file's numbers allow; nothing is flattened. Where SVG asks to draw
 * what stands before an error, this refuses the file and shows line and column.
 *
 * Of a file all <path>s are taken, to be painted one over the other; definitions, clips and paths
 * without fill are left out. Transformations are refused: a drawing in the wrong place helps
 * nobody. */
#include "render.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

typedef struct {
	const char *file, *text; /* text: all of it, zero-terminated */
	const char *p, *end;     /* what is being read */
} Reader;

typedef struct {
	Drawing *drawing;
	double x, y;             /* current point */
	double start_x, start_y; /* of the subpath */
	double control_x, control_y;
	char last;               /* the command before, in upper case */
} Pen;

static _Noreturn void refuse(const Reader *in, const char *at, const char *what)
{
	enum { BEFORE = 40, AFTER = 30 };
	const char *line = in->text;
	long number = 1;
	for (const char *p = in->text; p < at; p++)
		if (*p == '\n') {
			line = p + 1;
			number++;
		}
	const long column = (long)(at - line) + 1;
	if (at - line > BEFORE)
		line = at - BEFORE;
	int shown = (int)strcspn(line, "\r\n"), caret = (int)(at - line);
	if (shown > caret + AFTER)
		shown = caret + AFTER;
	char text[BEFORE + AFTER + 1];
	for (int i = 0; i < shown; i++) /* a caret stands under bytes, not under tabs and UTF-8 */
		text[i] = line[i] < ' ' || line[i] > '~' ? ' ' : line[i];
	text[shown] = '\0';
	fail("%s:%ld:%ld: %s\n    %s\n    %*s", in->file, number, column, what, text, caret + 1,
	     "^");
}

/* ---- numbers and separators ---- */

static bool is_space(char c)
{
	return c && strchr(" \t\r\n\f", c);
}

static bool is_digit(char c)
{
	return c >= '0' && c <= '9';
}

static void skip_spaces(Reader *in)
{
	while (in->p < in->end && is_space(*in->p))
		in->p++;
}

static char peek(const Reader *in)
{
	return in->p < in->end ? *in->p : '\0';
}

/* True if a comma stood there. */
static bool skip_separator(Reader *in)
{
	skip_spaces(in);
	if (peek(in) != ',')
		return false;
	in->p++;
	skip_spaces(in);
	return true;
}

static bool at_number(const Reader *in)
{
	return is_digit(peek(in)) || (peek(in) && strchr("+-.", peek(in)));
}

static int skip_digits(Reader *in)
{
	int count = 0;
	for (; is_digit(peek(in)); in->p++)
		count++;
	return count;
}

/* The grammar is SVG's; strtod, which would take "inf" and "0x1" too, sees only what fits it. The
 * text ends with a zero, or a byte that ends the number, so strtod does not run away. */
static double take_number(Reader *in, const char *what)
{
	const char *start = in->p;
	if (peek(in) == '+' || peek(in) == '-')
		in->p++;
	int digits = skip_digits(in);
	if (peek(in) == '.') {
		in->p++;
		digits += skip_digits(in);
	}
	if (!digits) {
		in->p = start;
		refuse(in, start, what);
	}
	const char *mantissa = in->p;
	if (peek(in) == 'e' || peek(in) == 'E') {
		in->p++;
		if (peek(in) == '+' || peek(in) == '-')
			in->p++;
		if (!skip_digits(in))
			in->p = mantissa;
	}
	char *copy = allocate((size_t)(in->p - start) + 1, 1);
	memcpy(copy, start, (size_t)(in->p - start));
	const double value = strtod(copy, NULL);
	free(copy);
	if (!(fabs(value) <= 1e9))
		refuse(in, start, "the number is beyond 1e9");
	return value;
}

static double take_flag(Reader *in)
{
	if (peek(in) != '0' && peek(in) != '1')
		refuse(in, in->p, "expected a flag of the arc, 0 or 1");
	return *in->p++ - '0';
}

/* ---- arcs ---- */

typedef struct {
	double x, y, radius_x, radius_y, cosine, sine; /* of the rotation */
	double from, sweep;                            /* angles */
} Arc;

static double angle(double ux, double uy, double vx, double vy)
{
	return atan2(ux * vy - uy * vx, ux * vx + uy * vy);
}

/* Centre and angles from the end points: SVG 1.1, appendix F.6. Radii too small to reach are
 * scaled up until they do. */
static Arc arc_from_ends(const Pen *pen, const double *a)
{
	const double turn = fmod(a[2], 360) * (PI / 180);
	Arc arc = { .radius_x = fabs(a[0]), .radius_y = fabs(a[1]), .cosine = cos(turn),
		    .sine = sin(turn) };
	const double dx = (pen->x - a[5]) / 2, dy = (pen->y - a[6]) / 2;
	double u = (arc.cosine * dx + arc.sine * dy) / arc.radius_x;
	double v = (arc.cosine * dy - arc.sine * dx) / arc.radius_y;
	const double reach = hypot(u, v);
	if (reach > 1) {
		arc.radius_x *= reach;
		arc.radius_y *= reach;
		u /= reach;
		v /= reach;
	}
	const double missing = fmax(0, 1 - reach * reach);
	double far = reach > 0 ? sqrt(missing) / reach : 0;
	if (a[3] == a[4])
		far = -far;
	const double cx = far * v, cy = -far * u; /* on the unit circle */
	arc.from = angle(1, 0, u - cx, v - cy);
	arc.sweep = angle(u - cx, v - cy, -u - cx, -v - cy);
	if (a[4] == 0 && arc.sweep > 0)
		arc.sweep -= 2 * PI;
	if (a[4] != 0 && arc.sweep < 0)
		arc.sweep += 2 * PI;
	const double mx = arc.radius_x * cx, my = arc.radius_y * cy;
	arc.x = arc.cosine * mx - arc.sine * my + (pen->x + a[5]) / 2;
	arc.y = arc.sine * mx + arc.cosine * my + (pen->y + a[6]) / 2;
	return arc;
}

static void arc_point(const Arc *arc, double at, double stretch, double *point)
{
	const double u = arc->radius_x * cos(at) * stretch, v = arc->radius_y * sin(at) * stretch;
	point[0] = arc->x + arc->cosine * u - arc->sine * v;
	point[1] = arc->y + arc->sine * u + arc->cosine * v;
}

static void draw_arc(Pen *pen, const double *a)
{
	if (pen->x == a[5] && pen->y == a[6])
		return;
	if (a[0] == 0 || a[1] == 0) {
		drawing_line(pen->drawing, a[5], a[6]);
		return;
	}
	const Arc arc = arc_from_ends(pen, a);
	const int count = (int)fmax(1, ceil(fabs(arc.sweep) / (PI / 2) - 1e-9));
	const double half = arc.sweep / (2 * count);
	for (int i = 0; i < count; i++) {
		double points[4];
		arc_point(&arc, arc.from + (2 * i + 1) * half, 1 / cos(half), points);
		arc_point(&arc, arc.from + (2 * i + 2) * half, 1, points + 2);
		if (i == count - 1) {
			points[2] = a[5];
			points[3] = a[6];
		}
		drawing_add(pen->drawing, EW_CONIC, points, cos(half));
	}
}

/* ---- commands ---- */

/* Of every command the arguments: x and y may be relative; r: a plain number; f: a flag. */
static const struct {
	char name;
	const char *arguments;
} commands[] = {
	{ 'M', "xy" },	   { 'L', "xy" },   { 'H', "x" },  { 'V', "y" },	{ 'C', "xyxyxy" },
	{ 'S', "xyxy" }, { 'Q', "xyxy" }, { 'T', "xy" }, { 'A', "rrrffxy" }, { 'Z', "" },
};

static char upper(char c)
{
	return c >= 'a' && c <= 'z' ? (char)(c - 'a' + 'A') : c;
}

static const char *arguments_of(char command)
{
	for (size_t i = 0; i < sizeof commands / sizeof *commands; i++)
		if (commands[i].name == upper(command))
			return commands[i].arguments;
	return NULL;
}

static void take_arguments(Reader *in, const Pen *pen, char command, double *a)
{
	const bool relative = command != upper(command);
	const char *kinds = arguments_of(command);
	for (int i = 0; kinds[i]; i++) {
		if (i)
			skip_separator(in);
		if (kinds[i] == 'f') {
			a[i] = take_flag(in);
			continue;
		}
		a[i] = take_number(in, "expected a number");
		if (relative && kinds[i] == 'x')
			a[i] += pen->x;
		if (relative && kinds[i] == 'y')
			a[i] += pen->y;
	}
}

/* The first control point of S and T: the last one mirrored, if there is one of its kind. */
static void mirror(const Pen *pen, const char *kinds, double *point)
{
	const bool smooth = pen->last && strchr(kinds, pen->last);
	point[0] = smooth ? 2 * pen->x - pen->control_x : pen->x;
	point[1] = smooth ? 2 * pen->y - pen->control_y : pen->y;
}

static void add_curve(Pen *pen, unsigned char verb, const double *points)
{
	const int last = 2 * (verb_points(verb) - 1);
	drawing_add(pen->drawing, verb, points, 0);
	pen->control_x = points[last - 2];
	pen->control_y = points[last - 1];
}

static void draw(Pen *pen, char command, const double *a)
{
	double curve[6];
	switch (command) {
	case 'M':
		drawing_move(pen->drawing, a[0], a[1]);
		break;
	case 'Z':
		drawing_close(pen->drawing);
		break;
	case 'L':
		drawing_line(pen->drawing, a[0], a[1]);
		break;
	case 'H':
		drawing_line(pen->drawing, a[0], pen->y);
		break;
	case 'V':
		drawing_line(pen->drawing, pen->x, a[0]);
		break;
	case 'C':
		add_curve(pen, EW_CUBIC, a);
		break;
	case 'S':
		mirror(pen, "CS", curve);
		memcpy(curve + 2, a, 4 * sizeof *a);
		add_curve(pen, EW_CUBIC, curve);
		break;
	case 'Q':
		add_curve(pen, EW_QUAD, a);
		break;
	case 'T':
		mirror(pen, "QT", curve);
		memcpy(curve + 2, a, 2 * sizeof *a);
		add_curve(pen, EW_QUAD, curve);
		break;
	default:
		draw_arc(pen, a);
	}
}

static void advance(Pen *pen, char command, const double *a)
{
	const size_t count = strlen(arguments_of(command));
	if (command == 'Z') {
		pen->x = pen->start_x;
		pen->y = pen->start_y;
	} else {
		if (command != 'V')
			pen->x = a[count - (command == 'H' ? 1 : 2)];
		if (command != 'H')
			pen->y = a[count - 1];
	}
	if (command == 'M') {
		pen->start_x = pen->x;
		pen->start_y = pen->y;
	}
	pen->last = command;
}

/* One command with its arguments, which may be repeated; more pairs after M are lines. */
static void take_command(Reader *in, Pen *pen)
{
	char command = peek(in);
	const char *kinds = command ? arguments_of(command) : NULL;
	if (!kinds)
		refuse(in, in->p, "expected a command, one of MLHVCSQTAZ or mlhvcsqtaz");
	if (!pen->last && upper(command) != 'M')
		refuse(in, in->p, "expected M or m: a path begins with a move");
	in->p++;
	skip_spaces(in);
	for (bool comma = false, first = true; first || comma || (*kinds && at_number(in));
	     first = false) {
		double a[8];
		take_arguments(in, pen, command, a);
		draw(pen, upper(command), a);
		advance(pen, upper(command), a);
		if (upper(command) == 'M')
			command = command == 'M' ? 'L' : 'l';
		comma = *kinds && skip_separator(in);
	}
}

static void take_path(Reader *in, Svg *svg)
{
	Drawing drawing = { 0 };
	Pen pen = { .drawing = &drawing };
	for (skip_spaces(in); in->p < in->end; skip_spaces(in))
		take_command(in, &pen);
	if (!drawing.verb_count)
		return;
	svg->paths = grow(svg->paths, svg->count, sizeof *svg->paths);
	svg->paths[svg->count++] = drawing;
}

/* ---- files ---- */

typedef struct {
	const char *name, *value;
	size_t name_size, value_size;
} Attribute;

typedef struct {
	const char *name;
	size_t name_size;
	bool closing, empty; /* </name>, <name/> */
	Attribute attributes[64];
	int count;
} Element;

static bool is(const char *text, size_t size, const char *word)
{
	return strlen(word) == size && !memcmp(text, word, size);
}

static const Attribute *find(const Element *element, const char *name)
{
	for (int i = 0; i < element->count; i++)
		if (is(element->attributes[i].name, element->attributes[i].name_size, name))
			return &element->attributes[i];
	return NULL;
}

static bool has_value(const Element *element, const char *name, const char *value)
{
	const Attribute *attribute = find(element, name);
	return attribute && is(attribute->value, attribute->value_size, value);
}

static size_t name_size(const Reader *in)
{
	size_t size = 0;
	while (in->p + size < in->end && !is_space(in->p[size]) && !strchr("=/>\"'<", in->p[size]))
		size++;
	return size;
}

static void skip_past(Reader *in, const char *mark)
{
	const char *found = strstr(in->p, mark);
	if (!found)
		refuse(in, in->p, "this has no end");
	in->p = found + strlen(mark);
}

/* To the next element, past comments and declarations; false at the end. */
static bool find_element(Reader *in)
{
	static const char *const others[][2] = {
		{ "<!--", "-->" }, { "<![CDATA[", "]]>" }, { "<?", "?>" }, { "<!", ">" }
	};
	while ((in->p = strchr(in->p, '<'))) {
		size_t k = 0;
		while (k < 4 && strncmp(in->p, others[k][0], strlen(others[k][0])))
			k++;
		if (k == 4)
			return true;
		skip_past(in, others[k][1]);
	}
	return false;
}

static void take_attribute(Reader *in, Element *element)
{
	Attribute attribute = { .name = in->p, .name_size = name_size(in) };
	in->p += attribute.name_size;
	skip_spaces(in);
	if (!attribute.name_size || peek(in) != '=')
		refuse(in, in->p, "expected an attribute, name=\"value\", or the element's end");
	in->p++;
	skip_spaces(in);
	const char quote = peek(in);
	if (quote != '"' && quote != '\'')
		refuse(in, in->p, "expected a quoted value");
	attribute.value = in->p + 1;
	skip_past((in->p++, in), (const char[]){ quote, '\0' });
	attribute.value_size = (size_t)(in->p - 1 - attribute.value);
	if (element->count == (int)(sizeof element->attributes / sizeof *element->attributes))
		refuse(in, attribute.name, "the element has too many attributes");
	element->attributes[element->count++] = attribute;
}

static void take_element(Reader *in, Element *element)
{
	*element = (Element){ .closing = in->p[1] == '/' };
	in->p += 1 + element->closing;
	element->name = in->p;
	element->name_size = name_size(in);
	in->p += element->name_size;
	if (!element->name_size)
		refuse(in, in->p, "expected the name of an element");
	for (skip_spaces(in); peek(in) != '>' && strncmp(in->p, "/>", 2); skip_spaces(in))
		take_attribute(in, element);
	element->empty = *in->p == '/';
	in->p += 1 + element->empty;
}

static Reader inside(const Reader *in, const Attribute *attribute)
{
	return (Reader){ in->file, in->text, attribute->value,
			 attribute->value + attribute->value_size };
}

static void take_view(const Reader *in, const Element *element, Box *view)
{
	const Attribute *sizes[] = { find(element, "width"), find(element, "height") };
	const Attribute *attribute = find(element, "viewBox");
	double numbers[4] = { 0 };
	if (attribute) {
		Reader list = inside(in, attribute);
		skip_spaces(&list);
		for (int i = 0; i < 4; i++, skip_separator(&list))
			numbers[i] = take_number(&list, "expected a number; a viewBox has four");
		if (list.p < list.end)
			refuse(&list, list.p, "expected the end; a viewBox has four numbers");
		if (!(numbers[2] > 0) || !(numbers[3] > 0))
			refuse(in, attribute->value, "the viewBox is empty");
	}
	for (int i = 0; i < 2 && !attribute && sizes[0] && sizes[1]; i++) {
		Reader size = inside(in, sizes[i]);
		numbers[2 + i] = at_number(&size) ? take_number(&size, "expected a length") : 0;
		if (size.p < size.end && !is(size.p, (size_t)(size.end - size.p), "px"))
			return;
	}
	if (numbers[2] > 0 && numbers[3] > 0)
		*view = (Box){ numbers[0], numbers[1], numbers[0] + numbers[2],
			       numbers[1] + numbers[3] };
}

static bool one_of(const Element *element, const char *const *names)
{
	while (*names && !is(element->name, element->name_size, *names))
		names++;
	return *names;
}

static void take_visible(const Reader *in, const Element *element, Svg *svg)
{
	static const char *const others[] = { "rect",	 "circle", "ellipse", "line", "polyline",
					      "polygon", "text",   "use",     NULL };
	const Attribute *transform = find(element, "transform"), *d = find(element, "d");
	if (transform)
		refuse(in, transform->name, "a transform is not read; apply it to the path first");
	if (one_of(element, others))
		fprintf(stderr, "render: %s: note: a <%.*s> is left out, only paths are drawn\n",
			in->file, (int)element->name_size, element->name);
	if (!is(element->name, element->name_size, "path") || !d ||
	    has_value(element, "fill", "none"))
		return;
	if (has_value(element, "fill-rule", "evenodd"))
		fprintf(stderr, "render: %s: note: a fill-rule is evenodd, drawn as nonzero\n",
			in->file);
	Reader data = inside(in, d);
	take_path(&data, svg);
}

static void take_file(Reader *in, Svg *svg)
{
	static const char *const hiding[] = { "defs",	 "clipPath", "mask", "pattern",
					      "marker", "symbol",   NULL };
	Element element;
	long depth = 0, hidden = 0; /* hidden: the depth of what hides, or 0 */
	bool any = false;
	while (find_element(in)) {
		take_element(in, &element);
		if (element.closing) {
			hidden = depth == hidden ? 0 : hidden;
			depth--;
			continue;
		}
		if (!any && !is(element.name, element.name_size, "svg"))
			refuse(in, element.name, "expected <svg>: this is not a file of SVG");
		if (!any)
			take_view(in, &element, &svg->view);
		any = true;
		if (!hidden && one_of(&element, hiding) && !element.empty)
			hidden = depth + 1;
		else if (!hidden)
			take_visible(in, &element, svg);
		depth += !element.empty;
	}
	if (!any)
		refuse(in, in->text, "expected <svg>: this is not a file of SVG");
}

static char *read_all(const char *file, size_t *size)
{
	FILE *stream = fopen(file, "rb");
	char *text = NULL;
	int c = 0;
	*size = 0;
	while (stream && (c = getc(stream)) != EOF) {
		text = grow(text, *size, 1);
		text[(*size)++] = (char)c;
	}
	if (!stream || ferror(stream))
		fail("cannot read %s: %s", file, strerror(errno));
	fclose(stream);
	text = grow(text, *size, 1);
	text[*size] = '\0';
	return text;
}

static const Box no_view = { 1, 1, 0, 0 };

void svg_read_file(const char *file, Svg *svg)
{
	size_t size;
	char *text = read_all(file, &size);
	Reader in = { file, text, text, text + size };
	*svg = (Svg){ .view = no_view };
	if (strlen(text) != size)
		refuse(&in, text + strlen(text), "a byte 0: this is not a file of SVG");
	take_file(&in, svg);
	if (!svg->count)
		fail("%s has no path to fill", file);
	free(text);
}

void svg_read_path(const char *data, Svg *svg)
{
	Reader in = { "path", data, data, data + strlen(data) };
	*svg = (Svg){ .view = no_view };
	take_path(&in, svg);
	if (!svg->count)
		refuse(&in, data, "expected a path, which begins with M or m");
}

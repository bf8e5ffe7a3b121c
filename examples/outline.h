/* outline.h - files of shapes made of rings and holes, for the examples that read them.
 *
 *     shape NAME                opens a shape
 *     ring                      opens an outer ring of it, counterclockwise
 *     hole                      opens a hole, clockwise
 *     X Y                       a vertex; the last one is joined to the first and not repeated
 *     X Y RADIUS                of sections: a corner rounded by an arc of this radius
 *     table NAME NUMBER ...     of sections: what a table of the trade says about the shape
 *
 * A line that starts with # is a comment. A mistake ends the program with its line and column.
 *
 * A shape owns consecutive rings and a ring consecutive vertices. */
#ifndef OUTLINE_H
#define OUTLINE_H

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "command_line.h"

enum { LONGEST_LINE = 200, LONGEST_NAME = 40 };

typedef struct {
	size_t first, count; /* vertices */
	long line;
	bool hole;
} Ring;

typedef struct {
	char name[LONGEST_NAME + 1];
	const char *file;
	long line;
	size_t first, rings, vertices;
	char table[LONGEST_LINE + 1];
} Shape;

typedef struct {
	double *x, *y, *radius;
	Ring *rings;
	Shape *shapes;
	size_t vertex_count, ring_count, shape_count;
} Outlines;

/* What the numbers of a file are: names and limits for messages. */
typedef struct {
	const char *x, *y, *unit;
	double most_x, most_y;
	bool sections;
} OutlineKind;

typedef struct {
	const OutlineKind *kind;
	const char *name;
	FILE *stream;
	size_t shapes_before; /* shapes of earlier files */
	long line;
	char text[LONGEST_LINE + 1];
} OutlineReader;

static inline void fail(const char *file, long line, long column, const char *format, ...)
{
	va_list args;
	va_start(args, format);
	fprintf(stderr, "%s:%ld:%ld: error: ", file, line, column);
	vfprintf(stderr, format, args);
	fputc('\n', stderr);
	va_end(args);
	exit(1);
}

/* Room for one more element behind `count`; arrays double whenever count is a power of two. */
static inline void *grow(void *array, size_t count, size_t size)
{
	if (count & (count - 1))
		return array;
	size_t room = count ? 2 * count : 1;
	errno = ENOMEM;
	void *grown = room > SIZE_MAX / size ? NULL : realloc(array, room * size);
	if (!grown)
		stop("no room for", "the vertices");
	return grown;
}

static inline void *allocate(size_t count, size_t size)
{
	void *data = calloc(count ? count : 1, size);
	if (!data)
		stop("no room for", "the vertices");
	return data;
}

static inline bool outline_read_line(OutlineReader *in)
{
	size_t size = 0;
	int c;
	in->line++;
	while ((c = getc(in->stream)) != EOF && c != '\n') {
		if (size == LONGEST_LINE)
			fail(in->name, in->line, LONGEST_LINE + 1,
			     "the line is longer than %d bytes; write one item per line",
			     LONGEST_LINE);
		in->text[size++] = (char)c;
	}
	if (ferror(in->stream))
		stop("cannot read", in->name);
	if (c == EOF && size == 0)
		return false;
	while (size > 0 && strchr(" \t\r", in->text[size - 1]) && in->text[size - 1])
		size--;
	in->text[size] = '\0';
	bool comment = in->text[strspn(in->text, " \t")] == '#';
	for (size_t i = 0; i < size && !comment; i++) {
		unsigned char byte = (unsigned char)in->text[i];
		if (byte != '\t' && (byte < ' ' || byte > '~'))
			fail(in->name, in->line, (long)i + 1,
			     "byte 0x%02x is not printable ASCII; remove it", byte);
	}
	return true;
}

static inline void skip_blanks(char **p)
{
	*p += strspn(*p, " \t");
}

static inline bool take_word(char **p, const char *word)
{
	size_t size = strlen(word);
	if (strcspn(*p, " \t") != size || memcmp(*p, word, size))
		return false;
	*p += size;
	skip_blanks(p);
	return true;
}

static inline double take_number(const OutlineReader *in, char **p, const char *what, double least,
				 double most)
{
	long column = (long)(*p - in->text) + 1;
	char *end;
	double value = strtod(*p, &end);
	if (end == *p || !strchr(" \t", *end))
		fail(in->name, in->line, column,
		     "expected a %s; lines are 'shape NAME', 'ring', 'hole', '%s %s%s'", what,
		     in->kind->x, in->kind->y, in->kind->sections ? " [RADIUS]', 'table" : "");
	if (!(value >= least && value <= most))
		fail(in->name, in->line, column, "the %s must be between %.0f and %.0f %s", what,
		     least, most, in->kind->unit);
	*p = end;
	skip_blanks(p);
	return value;
}

static inline Shape *current_shape(const OutlineReader *in, const Outlines *outlines)
{
	size_t count = outlines->shape_count;
	return count > in->shapes_before ? &outlines->shapes[count - 1] : NULL;
}

static inline void close_ring(const OutlineReader *in, const Outlines *outlines)
{
	const Ring *ring = &outlines->rings[outlines->ring_count - 1];
	if (ring->count < 3)
		fail(in->name, ring->line, 1,
		     "the ring has %zu vertices; add some, it needs 3 or more", ring->count);
}

static inline void close_shape(const OutlineReader *in, const Outlines *outlines)
{
	const Shape *shape = current_shape(in, outlines);
	if (!shape)
		return;
	if (!shape->rings)
		fail(in->name, shape->line, 1, "shape %s has no ring; add 'ring' and its vertices",
		     shape->name);
	close_ring(in, outlines);
}

static inline void open_shape(const OutlineReader *in, Outlines *outlines, char **p)
{
	close_shape(in, outlines);
	size_t size = strlen(*p);
	if (size == 0)
		fail(in->name, in->line, 1, "the shape has no name; write 'shape NAME'");
	if (size > LONGEST_NAME)
		fail(in->name, in->line, (long)(*p - in->text) + 1 + LONGEST_NAME,
		     "the name is longer than %d characters; shorten it", LONGEST_NAME);
	outlines->shapes = grow(outlines->shapes, outlines->shape_count, sizeof *outlines->shapes);
	Shape *shape = &outlines->shapes[outlines->shape_count++];
	*shape = (Shape){ .file = in->name, .line = in->line, .first = outlines->ring_count };
	memcpy(shape->name, *p, size);
	*p += size;
}

static inline void open_ring(const OutlineReader *in, Outlines *outlines, bool hole)
{
	Shape *shape = current_shape(in, outlines);
	if (!shape)
		fail(in->name, in->line, 1,
		     "a ring before the first shape; write 'shape NAME' above it");
	if (shape->rings)
		close_ring(in, outlines);
	else if (hole)
		fail(in->name, in->line, 1,
		     "a hole before the first ring; write the ring above it");
	outlines->rings = grow(outlines->rings, outlines->ring_count, sizeof *outlines->rings);
	outlines->rings[outlines->ring_count++] =
		(Ring){ .first = outlines->vertex_count, .line = in->line, .hole = hole };
	shape->rings++;
}

static inline void add_vertex(const OutlineReader *in, Outlines *outlines, char **p)
{
	const OutlineKind *kind = in->kind;
	double x = take_number(in, p, kind->x, -kind->most_x, kind->most_x);
	double y = take_number(in, p, kind->y, -kind->most_y, kind->most_y);
	double radius = kind->sections && **p ? take_number(in, p, "radius", 0, kind->most_x) : 0;
	Shape *shape = current_shape(in, outlines);
	if (!shape || !shape->rings)
		fail(in->name, in->line, 1, "a vertex outside of a ring; write 'ring' above it");
	double **arrays[] = { &outlines->x, &outlines->y, &outlines->radius };
	for (int i = 0; i < 3; i++)
		*arrays[i] = grow(*arrays[i], outlines->vertex_count, sizeof(double));
	outlines->x[outlines->vertex_count] = x;
	outlines->y[outlines->vertex_count] = y;
	outlines->radius[outlines->vertex_count++] = radius;
	outlines->rings[outlines->ring_count - 1].count++;
	shape->vertices++;
}

static inline void read_item(const OutlineReader *in, Outlines *outlines, char *p)
{
	Shape *shape = current_shape(in, outlines);
	if (take_word(&p, "shape")) {
		open_shape(in, outlines, &p);
	} else if (take_word(&p, "ring")) {
		open_ring(in, outlines, false);
	} else if (take_word(&p, "hole")) {
		open_ring(in, outlines, true);
	} else if (in->kind->sections && shape && take_word(&p, "table")) {
		strcpy(shape->table, p);
		p += strlen(p);
	} else {
		add_vertex(in, outlines, &p);
	}
	if (*p)
		fail(in->name, in->line, (long)(p - in->text) + 1,
		     "unexpected text; end the line here");
}

static inline void read_outlines(Outlines *outlines, const char *name, const OutlineKind *kind)
{
	OutlineReader in = { .kind = kind,
			     .name = name,
			     .stream = fopen(name, "r"),
			     .shapes_before = outlines->shape_count };
	if (!in.stream)
		stop("cannot open", name);
	while (outline_read_line(&in)) {
		char *p = in.text;
		skip_blanks(&p);
		if (*p && *p != '#')
			read_item(&in, outlines, p);
	}
	if (!current_shape(&in, outlines))
		fail(name, in.line, 1,
		     "the file has no shape; write 'shape NAME', 'ring' and vertices");
	close_shape(&in, outlines);
	fclose(in.stream);
}

/* `area` is the signed one of the ring. */
static inline void check_turn(const Shape *shape, const Ring *ring, double area)
{
	if (ring->hole ? !(area < 0) : !(area > 0))
		fail(shape->file, ring->line, 1,
		     "the %s runs %s or encloses nothing; reverse its vertices",
		     ring->hole ? "hole" : "ring", ring->hole ? "counterclockwise" : "clockwise");
}

static inline void free_outlines(Outlines *outlines)
{
	void *owned[] = { outlines->x, outlines->y, outlines->radius, outlines->rings,
			  outlines->shapes };
	for (int i = 0; i < 5; i++)
		free(owned[i]);
}

static inline void print_numbers(const char *word, const double *values, int count)
{
	printf("%s", word);
	for (int i = 0; i < count; i++)
		printf(" %a", values[i]);
	putchar('\n');
}

#endif

/* shapes.c - area, centroid, second moments and principal axis of outlines on the globe.
 *
 * Reads shapes made of rings and holes (data/countries.txt describes the format), projects each
 * about its own middle, the mean direction of its vertices, and prints one line of a table per
 * shape. The projection is Lambert's azimuthal equal-area one, so areas are true square kilometres;
 * angles are true at the middle and nearly so around it. x points east at the middle, y north.
 *
 * Moments of a shape are the sum of the moments of its rings: holes run clockwise and subtract by
 * themselves. Two passes: raw moments about the middle give the centroid, then moments about that
 * centroid are computed afresh from the vertices. Moving the raw moments there would subtract large
 * numbers from each other.
 *
 * Invariant: a shape owns consecutive rings and a ring consecutive vertices, so sorting moves
 * shapes only. */
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "edgewise.h"

#define PI 3.14159265358979323846
#define RADIUS 6371.0072 /* km, of the sphere with the area of the Earth */

enum { DEGREE = 2, MOMENTS = EW_MOMENTS(DEGREE), LONGEST_LINE = 200, LONGEST_NAME = 40 };

typedef struct {
	size_t first, count; /* vertices */
	long line;
	bool hole;
} Ring;

typedef struct {
	double lon, lat, east[3], north[3], up[3];
} Frame;

typedef struct {
	char name[LONGEST_NAME + 1];
	const char *file;
	long line;
	size_t first, rings, vertices;
	Frame frame;
	double raw[MOMENTS];     /* about the middle */
	double central[MOMENTS]; /* about the centroid */
	double x, y, axis;       /* centroid; degrees counterclockwise from east */
} Shape;

typedef struct {
	double *lon, *lat, *x, *y; /* degrees; km */
	Ring *rings;
	Shape *shapes;
	size_t vertex_count, ring_count, shape_count;
} Atlas;

typedef struct {
	const char *name;
	FILE *stream;
	size_t shapes_before; /* shapes of earlier files */
	long line;
	char text[LONGEST_LINE + 1];
} Reader;

static void fail(const char *file, long line, long column, const char *format, ...)
{
	va_list args;
	va_start(args, format);
	fprintf(stderr, "%s:%ld:%ld: error: ", file, line, column);
	vfprintf(stderr, format, args);
	fputc('\n', stderr);
	va_end(args);
	exit(1);
}

static void stop(const char *what, const char *name)
{
	fprintf(stderr, "shapes: %s %s: %s\n", what, name, strerror(errno));
	exit(1);
}

/* Room for one more element behind `count`; arrays double whenever count is a power of two. */
static void *grow(void *array, size_t count, size_t size)
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

/* ---- reading ---- */

static bool read_line(Reader *in)
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

static void skip_blanks(char **p)
{
	*p += strspn(*p, " \t");
}

static bool take_word(char **p, const char *word)
{
	size_t size = strlen(word);
	if (strcspn(*p, " \t") != size || memcmp(*p, word, size))
		return false;
	*p += size;
	skip_blanks(p);
	return true;
}

static double take_number(const Reader *in, char **p, const char *what, double limit)
{
	long column = (long)(*p - in->text) + 1;
	char *end;
	double value = strtod(*p, &end);
	if (end == *p || !strchr(" \t", *end))
		fail(in->name, in->line, column,
		     "expected a %s; lines are 'shape NAME', 'ring', 'hole', 'LONGITUDE LATITUDE'",
		     what);
	if (!(fabs(value) <= limit))
		fail(in->name, in->line, column, "the %s must be between -%.0f and %.0f degrees",
		     what, limit, limit);
	*p = end;
	skip_blanks(p);
	return value;
}

static Shape *current_shape(const Reader *in, const Atlas *atlas)
{
	size_t count = atlas->shape_count;
	return count > in->shapes_before ? &atlas->shapes[count - 1] : NULL;
}

static void close_ring(const Reader *in, const Atlas *atlas)
{
	const Ring *ring = &atlas->rings[atlas->ring_count - 1];
	if (ring->count < 3)
		fail(in->name, ring->line, 1,
		     "the ring has %zu vertices; add some, it needs 3 or more", ring->count);
}

static void close_shape(const Reader *in, const Atlas *atlas)
{
	const Shape *shape = current_shape(in, atlas);
	if (!shape)
		return;
	if (!shape->rings)
		fail(in->name, shape->line, 1, "shape %s has no ring; add 'ring' and its vertices",
		     shape->name);
	close_ring(in, atlas);
}

static void open_shape(const Reader *in, Atlas *atlas, char **p)
{
	close_shape(in, atlas);
	size_t size = strlen(*p);
	if (size == 0)
		fail(in->name, in->line, 1, "the shape has no name; write 'shape NAME'");
	if (size > LONGEST_NAME)
		fail(in->name, in->line, (long)(*p - in->text) + 1 + LONGEST_NAME,
		     "the name is longer than %d characters; shorten it", LONGEST_NAME);
	atlas->shapes = grow(atlas->shapes, atlas->shape_count, sizeof *atlas->shapes);
	Shape *shape = &atlas->shapes[atlas->shape_count++];
	*shape = (Shape){ .file = in->name, .line = in->line, .first = atlas->ring_count };
	memcpy(shape->name, *p, size);
	*p += size;
}

static void open_ring(const Reader *in, Atlas *atlas, bool hole)
{
	Shape *shape = current_shape(in, atlas);
	if (!shape)
		fail(in->name, in->line, 1,
		     "a ring before the first shape; write 'shape NAME' above it");
	if (shape->rings)
		close_ring(in, atlas);
	else if (hole)
		fail(in->name, in->line, 1,
		     "a hole before the first ring; write the ring above it");
	atlas->rings = grow(atlas->rings, atlas->ring_count, sizeof *atlas->rings);
	atlas->rings[atlas->ring_count++] =
		(Ring){ .first = atlas->vertex_count, .line = in->line, .hole = hole };
	shape->rings++;
}

static void add_vertex(const Reader *in, Atlas *atlas, double lon, double lat)
{
	Shape *shape = current_shape(in, atlas);
	if (!shape || !shape->rings)
		fail(in->name, in->line, 1, "a vertex outside of a ring; write 'ring' above it");
	double **arrays[] = { &atlas->lon, &atlas->lat, &atlas->x, &atlas->y };
	for (int i = 0; i < 4; i++)
		*arrays[i] = grow(*arrays[i], atlas->vertex_count, sizeof(double));
	atlas->lon[atlas->vertex_count] = lon;
	atlas->lat[atlas->vertex_count++] = lat;
	atlas->rings[atlas->ring_count - 1].count++;
	shape->vertices++;
}

static void read_item(const Reader *in, Atlas *atlas, char *p)
{
	if (take_word(&p, "shape")) {
		open_shape(in, atlas, &p);
	} else if (take_word(&p, "ring")) {
		open_ring(in, atlas, false);
	} else if (take_word(&p, "hole")) {
		open_ring(in, atlas, true);
	} else {
		double lon = take_number(in, &p, "longitude", 180);
		double lat = take_number(in, &p, "latitude", 90);
		add_vertex(in, atlas, lon, lat);
	}
	if (*p)
		fail(in->name, in->line, (long)(p - in->text) + 1,
		     "unexpected text; end the line here");
}

static void read_file(Atlas *atlas, const char *name)
{
	Reader in = { .name = name,
		      .stream = fopen(name, "r"),
		      .shapes_before = atlas->shape_count };
	if (!in.stream)
		stop("cannot open", name);
	while (read_line(&in)) {
		char *p = in.text;
		skip_blanks(&p);
		if (*p && *p != '#')
			read_item(&in, atlas, p);
	}
	if (!current_shape(&in, atlas))
		fail(name, in.line, 1,
		     "the file has no shape; write 'shape NAME', 'ring' and vertices");
	close_shape(&in, atlas);
	fclose(in.stream);
}

/* ---- the globe ---- */

static void direction(double lon, double lat, double v[3])
{
	v[0] = cos(lat * (PI / 180)) * cos(lon * (PI / 180));
	v[1] = cos(lat * (PI / 180)) * sin(lon * (PI / 180));
	v[2] = sin(lat * (PI / 180));
}

static double dot(const double a[3], const double b[3])
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void to_degrees(const double v[3], double *lon, double *lat)
{
	*lon = atan2(v[1], v[0]) * (180 / PI);
	*lat = atan2(v[2], hypot(v[0], v[1])) * (180 / PI);
}

/* Fills x and y of the shape's vertices: for the unit vector v of a vertex,
 * (x, y) = RADIUS sqrt(2/(1 + v.up)) (v.east, v.north). */
static void project(const Atlas *atlas, Shape *shape)
{
	size_t first = atlas->rings[shape->first].first;
	size_t end = first + shape->vertices;
	double v[3], mean[3] = { 0, 0, 0 };
	for (size_t i = first; i < end; i++) {
		direction(atlas->lon[i], atlas->lat[i], v);
		for (int k = 0; k < 3; k++)
			mean[k] += v[k] / (double)shape->vertices;
	}
	Frame *frame = &shape->frame;
	to_degrees(mean, &frame->lon, &frame->lat);
	direction(frame->lon, frame->lat, frame->up);
	direction(frame->lon + 90, 0, frame->east);
	direction(frame->lon, frame->lat + 90, frame->north);
	bool fits = dot(mean, mean) > 1e-12;
	for (size_t i = first; i < end; i++) {
		direction(atlas->lon[i], atlas->lat[i], v);
		double c = dot(v, frame->up);
		fits = fits && c > -0.99;
		double scale = RADIUS * sqrt(2 / (1 + c));
		atlas->x[i] = scale * dot(v, frame->east);
		atlas->y[i] = scale * dot(v, frame->north);
	}
	if (!fits)
		fail(shape->file, shape->line, 1, "shape %s reaches round the globe; split it",
		     shape->name);
}

/* The inverse: v = (1 - q/2) up + sqrt(1 - q/4) (x east + y north)/RADIUS,
 * q = (x^2 + y^2)/RADIUS^2 < 4. */
static void unproject(const Frame *frame, double x, double y, double *lon, double *lat)
{
	double v[3], q = (x * x + y * y) / (RADIUS * RADIUS);
	for (int k = 0; k < 3; k++)
		v[k] = (1 - q / 2) * frame->up[k] +
		       sqrt(1 - q / 4) * (x * frame->east[k] + y * frame->north[k]) / RADIUS;
	to_degrees(v, lon, lat);
}

/* ---- measuring ---- */

static void check_rings(const Atlas *atlas, const Shape *shape)
{
	for (size_t i = shape->first; i < shape->first + shape->rings; i++) {
		const Ring *ring = &atlas->rings[i];
		double area = ew_area(atlas->x + ring->first, atlas->y + ring->first, ring->count);
		if (ring->hole ? !(area < 0) : !(area > 0))
			fail(shape->file, ring->line, 1,
			     "the %s runs %s or encloses nothing; reverse its vertices",
			     ring->hole ? "hole" : "ring",
			     ring->hole ? "counterclockwise" : "clockwise");
	}
}

/* Moments of the whole shape about `centre`, or, if that is NULL, about the middle. */
static void sum_rings(const Atlas *atlas, const Shape *shape, const double *centre, double *sum)
{
	memset(sum, 0, MOMENTS * sizeof *sum);
	for (size_t i = shape->first; i < shape->first + shape->rings; i++) {
		const Ring *ring = &atlas->rings[i];
		const double *x = atlas->x + ring->first, *y = atlas->y + ring->first;
		double one[MOMENTS];
		if (centre)
			ew_moments_about(DEGREE, x, y, ring->count, centre[0], centre[1], one);
		else
			ew_moments(DEGREE, x, y, ring->count, one);
		for (int k = 0; k < MOMENTS; k++)
			sum[k] += one[k];
	}
}

/* Degrees from east to the axis of largest spread, in (-90, 90]; 0 if no direction stands out. */
static double principal_axis(const double central[MOMENTS])
{
	double difference = central[EW_INDEX(2, 0)] - central[EW_INDEX(0, 2)];
	double angle = atan2(2 * central[EW_INDEX(1, 1)], difference) / PI * 90;
	return angle > -90 ? angle : 90;
}

static void measure(const Atlas *atlas, Shape *shape)
{
	project(atlas, shape);
	check_rings(atlas, shape);
	sum_rings(atlas, shape, NULL, shape->raw);
	double area = shape->raw[EW_INDEX(0, 0)];
	double centroid[2] = { shape->raw[EW_INDEX(1, 0)] / area,
			       shape->raw[EW_INDEX(0, 1)] / area };
	if (!(area > 0 && hypot(centroid[0], centroid[1]) < 2 * RADIUS))
		fail(shape->file, shape->line, 1,
		     "shape %s has holes outside of its rings; move them inside", shape->name);
	shape->x = centroid[0];
	shape->y = centroid[1];
	sum_rings(atlas, shape, centroid, shape->central);
	shape->axis = principal_axis(shape->central);
}

static int by_area(const void *left, const void *right)
{
	const Shape *a = left, *b = right;
	double difference = b->raw[0] - a->raw[0];
	if (difference == 0)
		return strcmp(a->name, b->name);
	return difference > 0 ? 1 : -1;
}

/* ---- printing ---- */

static void print_table(const Atlas *atlas)
{
	int width = 10;
	double area = 0;
	for (size_t i = 0; i < atlas->shape_count; i++)
		width = (int)fmax(width, (double)strlen(atlas->shapes[i].name));
	printf("%-*s %5s %8s %13s %8s %8s  %11s %11s %11s %7s\n", width, "", "", "", "area",
	       "centroid", "", "mu20", "mu11", "mu02", "axis");
	printf("%-*s %5s %8s %13s %8s %8s  %11s %11s %11s %7s\n", width, "shape", "rings",
	       "vertices", "km2", "lat", "lon", "km4", "km4", "km4", "degrees");
	for (size_t i = 0; i < atlas->shape_count; i++) {
		const Shape *shape = &atlas->shapes[i];
		const double *mu = shape->central;
		double lon, lat;
		unproject(&shape->frame, shape->x, shape->y, &lon, &lat);
		printf("%-*s %5zu %8zu %13.0f %8.3f %8.3f  %11.4e %11.4e %11.4e %7.2f\n", width,
		       shape->name, shape->rings, shape->vertices, shape->raw[0], lat, lon,
		       mu[EW_INDEX(2, 0)], mu[EW_INDEX(1, 1)], mu[EW_INDEX(0, 2)], shape->axis);
		area += shape->raw[0];
	}
	char total[32];
	snprintf(total, sizeof total, "total (%zu)", atlas->shape_count);
	printf("%-*s %5zu %8zu %13.0f\n", width, total, atlas->ring_count, atlas->vertex_count,
	       area);
}

static void print_numbers(const char *word, const double *values, int count)
{
	printf("%s", word);
	for (int i = 0; i < count; i++)
		printf(" %a", values[i]);
	putchar('\n');
}

/* What the table was made from, every bit of it, for programs. */
static void print_exact(const Atlas *atlas, const Shape *shape)
{
	double middle[2] = { shape->frame.lon, shape->frame.lat };
	double centroid[4] = { shape->x, shape->y };
	unproject(&shape->frame, shape->x, shape->y, &centroid[2], &centroid[3]);
	printf("shape %s\n", shape->name);
	print_numbers("middle", middle, 2);
	for (size_t i = shape->first; i < shape->first + shape->rings; i++) {
		const Ring *ring = &atlas->rings[i];
		printf("%s %zu\n", ring->hole ? "hole" : "ring", ring->count);
		for (size_t j = ring->first; j < ring->first + ring->count; j++)
			printf("%a %a %a %a\n", atlas->x[j], atlas->y[j], atlas->lon[j],
			       atlas->lat[j]);
	}
	print_numbers("raw", shape->raw, MOMENTS);
	print_numbers("centroid", centroid, 4);
	print_numbers("central", shape->central + EW_INDEX(2, 0), 3);
	print_numbers("axis", &shape->axis, 1);
}

static int finish(void)
{
	if (fflush(stdout) || ferror(stdout))
		stop("cannot write", "standard output");
	return 0;
}

static int usage(FILE *stream)
{
	fputs("usage: shapes [--exact] FILE...\n"
	      "Prints area, centroid, second moments and principal axis of the shapes in FILEs,\n"
	      "the largest first. --exact prints projected vertices and results in hexadecimal.\n",
	      stream);
	return stream == stderr ? 2 : finish();
}

int main(int argc, char **argv)
{
	bool exact = false;
	int files = 0;
	for (int i = 1; i < argc; i++) {
		if (!strcmp(argv[i], "--exact"))
			exact = true;
		else if (!strcmp(argv[i], "--help"))
			return usage(stdout);
		else if (argv[i][0] == '-')
			return usage(stderr);
		else
			argv[files++] = argv[i];
	}
	if (files == 0)
		return usage(stderr);
	Atlas atlas = { 0 };
	for (int i = 0; i < files; i++)
		read_file(&atlas, argv[i]);
	for (size_t i = 0; i < atlas.shape_count; i++)
		measure(&atlas, &atlas.shapes[i]);
	qsort(atlas.shapes, atlas.shape_count, sizeof *atlas.shapes, by_area);
	for (size_t i = 0; exact && i < atlas.shape_count; i++)
		print_exact(&atlas, &atlas.shapes[i]);
	if (!exact)
		print_table(&atlas);
	void *owned[] = { atlas.lon, atlas.lat, atlas.x, atlas.y, atlas.rings, atlas.shapes };
	for (int i = 0; i < 6; i++)
		free(owned[i]);
	return finish();
}

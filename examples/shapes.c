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
 */
#include "edgewise.h"

#include "outline.h"

#define PI 3.14159265358979323846
#define RADIUS 6371.0072 /* km, of the sphere with the area of the Earth */

enum { DEGREE = 2, MOMENTS = EW_MOMENTS(DEGREE) };

static const OutlineKind on_globe = { "longitude", "latitude", "degrees", 180, 90, false };

typedef struct {
	double lon, lat, east[3], north[3], up[3];
} Frame;

typedef struct {
	const Shape *shape;
	Frame frame;
	double raw[MOMENTS];     /* about the middle */
	double central[MOMENTS]; /* about the centroid */
	double x, y, axis;       /* centroid; degrees counterclockwise from east */
} Country;

typedef struct {
	Outlines outlines; /* in degrees */
	double *x, *y;     /* km, each shape about its middle */
	Country *countries;
} Atlas;

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
static void project(const Atlas *atlas, Country *country)
{
	const Shape *shape = country->shape;
	const double *lon = atlas->outlines.x, *lat = atlas->outlines.y;
	size_t first = atlas->outlines.rings[shape->first].first;
	size_t end = first + shape->vertices;
	double v[3], mean[3] = { 0, 0, 0 };
	for (size_t i = first; i < end; i++) {
		direction(lon[i], lat[i], v);
		for (int k = 0; k < 3; k++)
			mean[k] += v[k] / (double)shape->vertices;
	}
	Frame *frame = &country->frame;
	to_degrees(mean, &frame->lon, &frame->lat);
	direction(frame->lon, frame->lat, frame->up);
	direction(frame->lon + 90, 0, frame->east);
	direction(frame->lon, frame->lat + 90, frame->north);
	bool fits = dot(mean, mean) > 1e-12;
	for (size_t i = first; i < end; i++) {
		direction(lon[i], lat[i], v);
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
		const Ring *ring = &atlas->outlines.rings[i];
		check_turn(shape, ring, ew_area(atlas->x + ring->first, atlas->y + ring->first,
						ring->count));
	}
}

/* Moments of the whole shape about `centre`, or, if that is NULL, about the middle. */
static void sum_rings(const Atlas *atlas, const Shape *shape, const double *centre, double *sum)
{
	memset(sum, 0, MOMENTS * sizeof *sum);
	for (size_t i = shape->first; i < shape->first + shape->rings; i++) {
		const Ring *ring = &atlas->outlines.rings[i];
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

static void measure(const Atlas *atlas, Country *country)
{
	const Shape *shape = country->shape;
	project(atlas, country);
	check_rings(atlas, shape);
	sum_rings(atlas, shape, NULL, country->raw);
	double area = country->raw[EW_INDEX(0, 0)];
	double centroid[2] = { country->raw[EW_INDEX(1, 0)] / area,
			       country->raw[EW_INDEX(0, 1)] / area };
	if (!(area > 0 && hypot(centroid[0], centroid[1]) < 2 * RADIUS))
		fail(shape->file, shape->line, 1,
		     "shape %s has holes outside of its rings; move them inside", shape->name);
	country->x = centroid[0];
	country->y = centroid[1];
	sum_rings(atlas, shape, centroid, country->central);
	country->axis = principal_axis(country->central);
}

static void measure_all(Atlas *atlas)
{
	const Outlines *outlines = &atlas->outlines;
	atlas->x = allocate(outlines->vertex_count, sizeof *atlas->x);
	atlas->y = allocate(outlines->vertex_count, sizeof *atlas->y);
	atlas->countries = allocate(outlines->shape_count, sizeof *atlas->countries);
	for (size_t i = 0; i < outlines->shape_count; i++) {
		atlas->countries[i].shape = &outlines->shapes[i];
		measure(atlas, &atlas->countries[i]);
	}
}

static int by_area(const void *left, const void *right)
{
	const Country *a = left, *b = right;
	double difference = b->raw[0] - a->raw[0];
	if (difference == 0)
		return strcmp(a->shape->name, b->shape->name);
	return difference > 0 ? 1 : -1;
}

/* ---- printing ---- */

static void print_table(const Atlas *atlas)
{
	const Outlines *outlines = &atlas->outlines;
	int width = 10;
	double area = 0;
	for (size_t i = 0; i < outlines->shape_count; i++)
		width = (int)fmax(width, (double)strlen(outlines->shapes[i].name));
	printf("%-*s %5s %8s %13s %8s %8s  %11s %11s %11s %7s\n", width, "", "", "", "area",
	       "centroid", "", "mu20", "mu11", "mu02", "axis");
	printf("%-*s %5s %8s %13s %8s %8s  %11s %11s %11s %7s\n", width, "shape", "rings",
	       "vertices", "km2", "lat", "lon", "km4", "km4", "km4", "degrees");
	for (size_t i = 0; i < outlines->shape_count; i++) {
		const Country *country = &atlas->countries[i];
		const Shape *shape = country->shape;
		const double *mu = country->central;
		double lon, lat;
		unproject(&country->frame, country->x, country->y, &lon, &lat);
		printf("%-*s %5zu %8zu %13.0f %8.3f %8.3f  %11.4e %11.4e %11.4e %7.2f\n", width,
		       shape->name, shape->rings, shape->vertices, country->raw[0], lat, lon,
		       mu[EW_INDEX(2, 0)], mu[EW_INDEX(1, 1)], mu[EW_INDEX(0, 2)], country->axis);
		area += country->raw[0];
	}
	char total[32];
	snprintf(total, sizeof total, "total (%zu)", outlines->shape_count);
	printf("%-*s %5zu %8zu %13.0f\n", width, total, outlines->ring_count, outlines->vertex_count,
	       area);
}

/* What the table was made from, every bit of it, for programs. */
static void print_exact(const Atlas *atlas, const Country *country)
{
	const Outlines *outlines = &atlas->outlines;
	const Shape *shape = country->shape;
	double middle[2] = { country->frame.lon, country->frame.lat };
	double centroid[4] = { country->x, country->y };
	unproject(&country->frame, country->x, country->y, &centroid[2], &centroid[3]);
	printf("shape %s\n", shape->name);
	print_numbers("middle", middle, 2);
	for (size_t i = shape->first; i < shape->first + shape->rings; i++) {
		const Ring *ring = &outlines->rings[i];
		printf("%s %zu\n", ring->hole ? "hole" : "ring", ring->count);
		for (size_t j = ring->first; j < ring->first + ring->count; j++)
			printf("%a %a %a %a\n", atlas->x[j], atlas->y[j], outlines->x[j],
			       outlines->y[j]);
	}
	print_numbers("raw", country->raw, MOMENTS);
	print_numbers("centroid", centroid, 4);
	print_numbers("central", country->central + EW_INDEX(2, 0), 3);
	print_numbers("axis", &country->axis, 1);
}

static const char usage[] =
	"usage: shapes [--exact] FILE...\n"
	"Prints area, centroid, second moments and principal axis of the shapes in FILEs,\n"
	"the largest first. --exact prints projected vertices and results in hexadecimal.\n";

int main(int argc, char **argv)
{
	CommandLine line = { .usage = usage, .operands = argv };
	for (int i = 1; i < argc; i++)
		take_argument(&line, argv[i]);
	if (line.count == 0)
		return refuse(&line);
	Atlas atlas = { 0 };
	for (int i = 0; i < line.count; i++)
		read_outlines(&atlas.outlines, argv[i], &on_globe);
	measure_all(&atlas);
	const size_t count = atlas.outlines.shape_count;
	qsort(atlas.countries, count, sizeof *atlas.countries, by_area);
	for (size_t i = 0; line.exact && i < count; i++)
		print_exact(&atlas, &atlas.countries[i]);
	if (!line.exact)
		print_table(&atlas);
	free_outlines(&atlas.outlines);
	free(atlas.x);
	free(atlas.y);
	free(atlas.countries);
	return finish_output();
}

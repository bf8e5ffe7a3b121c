/* section.c - section properties of profiles: area, centroid, second moments, principal axes, radii
 * of gyration and elastic section moduli.
 *
 * A section is rings and holes of corners, in mm, each of which may be rounded (data/sections.txt
 * describes the format). Roundings are arcs and stay arcs: an arc between two lines that touch it
 * is a conic edge, whose middle control point is the corner and whose weight is the cosine of half
 * the turn, and ew_path_moments integrates over what such a path encloses, with no polygon in
 * between. So a fillet counts, and a tube is four corners.
 *
 * x points to the right, y upwards; Ix is the integral of y^2, about the horizontal axis through
 * the centroid (tables of profiles call these axes y and z). Two passes: moments about the middle
 * of the bounding box give the centroid, those about the centroid are computed afresh from the
 * corners. */
#include "edgewise.h"

#include "outline.h"

enum { DEGREE = 2, MOMENTS = EW_MOMENTS(DEGREE) };

/* In the order of the table that is printed. */
enum { AREA, CX, CY, IX, IY, IXY, RX, RY, WX, WY, IU, IV, ANGLE, RU, RV, WU, WV, IP, PROPERTIES };

static const OutlineKind in_plane = { "x", "y", "mm", 1e6, 1e6, true };

static const struct {
	const char *name, *meaning;
	int power; /* of cm, and of 10 mm; of an angle 0 */
} properties[PROPERTIES] = {
	[AREA] = { "A", "area", 2 },
	[CX] = { "cx", "centroid", 1 },
	[CY] = { "cy", "", 1 },
	[IX] = { "Ix", "second moments about the centroid", 4 },
	[IY] = { "Iy", "", 4 },
	[IXY] = { "Ixy", "", 4 },
	[RX] = { "ix", "radii of gyration", 1 },
	[RY] = { "iy", "", 1 },
	[WX] = { "Wx", "elastic section moduli", 3 },
	[WY] = { "Wy", "", 3 },
	[IU] = { "Iu", "principal second moments", 4 },
	[IV] = { "Iv", "", 4 },
	[ANGLE] = { "angle", "degrees from x to u", 0 },
	[RU] = { "iu", "radii of gyration", 1 },
	[RV] = { "iv", "", 1 },
	[WU] = { "Wu", "elastic section moduli", 3 },
	[WV] = { "Wv", "", 3 },
	[IP] = { "Ip", "polar second moment", 4 },
};

typedef struct {
	double x, y;
} Vector;

/* A corner: where its arc begins and ends, the centre of the arc, and the weight of the conic. */
typedef struct {
	Vector corner, from, to, centre;
	double radius, tangent, weight;
} Corner;

typedef struct {
	Corner *corners; /* of all rings */
	unsigned char *verbs;
	double *points, *weights;
	size_t corner_count, verb_count, point_count, weight_count;
} Section;

/* ---- corners ---- */

static Vector minus(Vector a, Vector b)
{
	return (Vector){ a.x - b.x, a.y - b.y };
}

static Vector plus(Vector a, double factor, Vector b)
{
	return (Vector){ a.x + factor * b.x, a.y + factor * b.y };
}

static double dot(Vector a, Vector b)
{
	return a.x * b.x + a.y * b.y;
}

static double cross(Vector a, Vector b)
{
	return a.x * b.y - a.y * b.x;
}

static double length(Vector a)
{
	return hypot(a.x, a.y);
}

/* Rounds the corner between `before` and `after`. With the turn phi the arc begins r tan(phi/2)
 * before the corner, and sin(phi)/(1 + cos(phi)) is that tangent. */
static void round_corner(const Shape *shape, const Ring *ring, Corner *c, Vector before,
			 Vector after)
{
	Vector in = minus(c->corner, before), out = minus(after, c->corner);
	const double in_length = length(in), out_length = length(out);
	if (!(in_length > 0 && out_length > 0))
		fail(shape->file, ring->line, 1, "a corner of this ring is there twice");
	in = (Vector){ in.x / in_length, in.y / in_length };
	out = (Vector){ out.x / out_length, out.y / out_length };
	const double sine = cross(in, out), cosine = dot(in, out);
	if (!(cosine > -0.9999))
		fail(shape->file, ring->line, 1, "a side of this ring turns back; it has no round "
		     "corner there");
	c->tangent = c->radius * fabs(sine) / (1 + cosine);
	c->weight = sqrt((1 + cosine) / 2);
	c->from = plus(c->corner, -c->tangent, in);
	c->to = plus(c->corner, c->tangent, out);
	c->centre = plus(c->from, copysign(c->radius, sine), (Vector){ -in.y, in.x });
}

static void round_ring(const Shape *shape, const Ring *ring, Corner *corners)
{
	const size_t n = ring->count;
	for (size_t i = 0; i < n; i++) {
		Corner *c = &corners[i];
		c->from = c->to = c->centre = c->corner;
		if (c->radius > 0)
			round_corner(shape, ring, c, corners[(i + n - 1) % n].corner,
				     corners[(i + 1) % n].corner);
	}
	for (size_t i = 0; i < n; i++) {
		const Corner *a = &corners[i], *b = &corners[(i + 1) % n];
		const double side = length(minus(b->corner, a->corner));
		if (a->tangent + b->tangent > side * (1 + 1e-12))
			fail(shape->file, ring->line, 1,
			     "radii %g and %g do not fit on a side of %g mm; make them smaller",
			     a->radius, b->radius, side);
	}
}

/* ---- the path ---- */

static void add_verb(Section *section, int verb, Vector point)
{
	section->verbs[section->verb_count++] = (unsigned char)verb;
	section->points[2 * section->point_count] = point.x;
	section->points[2 * section->point_count++ + 1] = point.y;
}

static void add_ring(Section *section, const Corner *corners, size_t n)
{
	add_verb(section, EW_MOVE, corners[0].to);
	for (size_t i = 1; i <= n; i++) {
		const Corner *c = &corners[i % n];
		add_verb(section, EW_LINE, c->from);
		if (c->radius > 0) {
			add_verb(section, EW_CONIC, c->corner);
			section->points[2 * section->point_count] = c->to.x;
			section->points[2 * section->point_count++ + 1] = c->to.y;
			section->weights[section->weight_count++] = c->weight;
		}
	}
}

/* All of it, moved so that `origin` is (0,0). */
static void build(Section *section, const Outlines *outlines, const Shape *shape, Vector origin)
{
	section->corner_count = section->verb_count = section->point_count =
		section->weight_count = 0;
	for (size_t r = shape->first; r < shape->first + shape->rings; r++) {
		const Ring *ring = &outlines->rings[r];
		Corner *corners = section->corners + section->corner_count;
		for (size_t i = 0; i < ring->count; i++) {
			const size_t at = ring->first + i;
			const Vector place = { outlines->x[at], outlines->y[at] };
			corners[i] = (Corner){ .corner = minus(place, origin),
					       .radius = outlines->radius[at] };
		}
		round_ring(shape, ring, corners);
		add_ring(section, corners, ring->count);
		section->corner_count += ring->count;
	}
}

static Section new_section(const Shape *shape)
{
	const size_t n = shape->vertices;
	return (Section){ .corners = allocate(n, sizeof(Corner)),
			  .verbs = allocate(2 * n + shape->rings, 1),
			  .points = allocate(2 * (3 * n + shape->rings), sizeof(double)),
			  .weights = allocate(n, sizeof(double)) };
}

static void free_section(Section *section)
{
	free(section->corners);
	free(section->verbs);
	free(section->points);
	free(section->weights);
}

static void moments_of(const Section *section, const Shape *shape, double out[MOMENTS])
{
	const int status = ew_path_moments(DEGREE, section->verbs, section->verb_count,
					   section->points, section->point_count, section->weights,
					   section->weight_count, out);
	if (status != EW_OK)
		fail(shape->file, shape->line, 1, "ew_path_moments returns %d", status);
}

/* How far the outline reaches in a direction of length 1, from (0,0). */
static double reach(const Section *section, Vector direction)
{
	double most = -HUGE_VAL;
	for (size_t i = 0; i < section->corner_count; i++) {
		const Corner *c = &section->corners[i];
		most = fmax(most, fmax(dot(c->from, direction), dot(c->to, direction)));
		const Vector a = minus(c->from, c->centre), b = minus(c->to, c->centre);
		const double turn = cross(a, b);
		if (cross(a, direction) * turn > 0 && cross(direction, b) * turn > 0)
			most = fmax(most, dot(c->centre, direction) + c->radius);
	}
	return most;
}

/* Of the outermost point on either side of the axis of this direction. */
static double distance_from_axis(const Section *section, Vector axis)
{
	return fmax(reach(section, (Vector){ -axis.y, axis.x }),
		    reach(section, (Vector){ axis.y, -axis.x }));
}

/* ---- properties ---- */

/* Ix is M02, Iy is M20. About the axis at an angle t to x the second moment is
 * M20 sin^2 t - 2 M11 sin t cos t + M02 cos^2 t, largest at 2 t = atan2(-2 M11, M02 - M20). If the
 * two principal ones agree to 12 digits, every axis is principal, and x is taken. */
static void derive(const Section *section, const double m[MOMENTS], Vector origin,
		   double out[PROPERTIES])
{
	const double area = m[EW_INDEX(0, 0)], ixy = m[EW_INDEX(1, 1)];
	const double ix = m[EW_INDEX(0, 2)], iy = m[EW_INDEX(2, 0)];
	const double mean = (ix + iy) / 2, spread = hypot((ix - iy) / 2, ixy);
	const double angle = spread > 1e-12 * mean ? atan2(-2 * ixy, ix - iy) / 2 : 0;
	const Vector x = { 1, 0 }, y = { 0, 1 };
	const Vector u = { cos(angle), sin(angle) }, v = { -u.y, u.x };
	out[AREA] = area;
	out[CX] = origin.x + m[EW_INDEX(1, 0)] / area;
	out[CY] = origin.y + m[EW_INDEX(0, 1)] / area;
	out[IX] = ix;
	out[IY] = iy;
	out[IXY] = ixy;
	out[IU] = mean + spread;
	out[IV] = mean - spread;
	out[ANGLE] = angle * 180 / acos(-1);
	out[IP] = ix + iy;
	out[RX] = sqrt(ix / area);
	out[RY] = sqrt(iy / area);
	out[RU] = sqrt(out[IU] / area);
	out[RV] = sqrt(out[IV] / area);
	out[WX] = ix / distance_from_axis(section, x);
	out[WY] = iy / distance_from_axis(section, y);
	out[WU] = out[IU] / distance_from_axis(section, u);
	out[WV] = out[IV] / distance_from_axis(section, v);
}

static Vector middle_of(const Outlines *outlines, const Shape *shape)
{
	const size_t first = outlines->rings[shape->first].first;
	Vector low = { HUGE_VAL, HUGE_VAL }, high = { -HUGE_VAL, -HUGE_VAL };
	for (size_t i = first; i < first + shape->vertices; i++) {
		low = (Vector){ fmin(low.x, outlines->x[i]), fmin(low.y, outlines->y[i]) };
		high = (Vector){ fmax(high.x, outlines->x[i]), fmax(high.y, outlines->y[i]) };
	}
	return (Vector){ (low.x + high.x) / 2, (low.y + high.y) / 2 };
}

/* ---- printing ---- */

/* What the tables say of it, or "". */
static const char *from_table(const Shape *shape, const char *name, char word[LONGEST_LINE + 1])
{
	char *p = word;
	strcpy(word, shape->table);
	while (*p) {
		const bool found = take_word(&p, name);
		const size_t size = strcspn(p, " \t");
		if (found) {
			p[size] = '\0';
			return p;
		}
		p += size;
		skip_blanks(&p);
	}
	return "";
}

static void print_properties(const Shape *shape, const double values[PROPERTIES])
{
	printf("%-20s %16s %12s\n", shape->name, "", shape->table[0] ? "table" : "");
	for (int i = 0; i < PROPERTIES; i++) {
		char word[LONGEST_LINE + 1], unit[8] = "";
		const int power = properties[i].power;
		const double value = values[i] / pow(10, power);
		if (power)
			snprintf(unit, sizeof unit, power > 1 ? "cm%d" : "cm", power);
		printf("  %-6s %14.4f %-4s %12s%s%s\n", properties[i].name,
		       fabs(value) < 0.00005 ? 0 : value, unit,
		       from_table(shape, properties[i].name, word),
		       properties[i].meaning[0] ? "   " : "", properties[i].meaning);
	}
	putchar('\n');
}

/* What the properties were made from, every bit of it, for programs. */
static void print_exact(const Shape *shape, const Section *section, Vector origin,
			const double moments[MOMENTS], const double values[PROPERTIES])
{
	printf("shape %s\n", shape->name);
	print_numbers("origin", &origin.x, 2);
	const double *p = section->points, *w = section->weights;
	for (size_t i = 0; i < section->verb_count; i++) {
		static const char *const names[] = { [EW_MOVE] = "move", [EW_LINE] = "line",
						     [EW_CONIC] = "conic" };
		const bool conic = section->verbs[i] == EW_CONIC;
		const double numbers[5] = { p[0], p[1], conic ? p[2] : 0, conic ? p[3] : 0,
					    conic ? *w : 0 };
		print_numbers(names[section->verbs[i]], numbers, conic ? 5 : 2);
		p += conic ? 4 : 2;
		w += conic;
	}
	print_numbers("moments", moments, MOMENTS);
	for (int i = 0; i < PROPERTIES; i++)
		print_numbers(properties[i].name, &values[i], 1);
}

static void measure(const Outlines *outlines, const Shape *shape, bool exact)
{
	double moments[MOMENTS], values[PROPERTIES];
	Section section = new_section(shape);
	Vector origin = middle_of(outlines, shape);
	build(&section, outlines, shape, origin);
	moments_of(&section, shape, moments);
	if (!(moments[0] > 0))
		fail(shape->file, shape->line, 1,
		     "section %s encloses nothing; rings run counterclockwise, holes clockwise",
		     shape->name);
	origin.x += moments[EW_INDEX(1, 0)] / moments[0];
	origin.y += moments[EW_INDEX(0, 1)] / moments[0];
	build(&section, outlines, shape, origin);
	moments_of(&section, shape, moments);
	derive(&section, moments, origin, values);
	if (exact)
		print_exact(shape, &section, origin, moments, values);
	else
		print_properties(shape, values);
	free_section(&section);
}

/* ---- command line ---- */

static const char usage[] =
	"usage: section [--exact] FILE [SECTION]\n"
	"Prints area, centroid, second moments, principal axes, radii of gyration and elastic\n"
	"section moduli of the sections in FILE, or of one, beside what tables say of them.\n"
	"--exact prints outlines and properties in hexadecimal, in mm.\n";

int main(int argc, char **argv)
{
	CommandLine line = { .usage = usage, .operands = argv };
	bool found = false;
	for (int i = 1; i < argc; i++)
		take_argument(&line, argv[i]);
	if (line.count < 1 || line.count > 2)
		return refuse(&line);
	Outlines outlines = { 0 };
	read_outlines(&outlines, argv[0], &in_plane);
	for (size_t i = 0; i < outlines.shape_count; i++) {
		const Shape *shape = &outlines.shapes[i];
		if (line.count < 2 || !strcmp(shape->name, argv[1])) {
			measure(&outlines, shape, line.exact);
			found = true;
		}
	}
	if (!found) {
		fprintf(stderr, "section: %s has no section '%s'\n", argv[0], argv[1]);
		return 1;
	}
	free_outlines(&outlines);
	return finish_output();
}

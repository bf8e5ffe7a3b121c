/* origin.c - what is lost far from the origin: the error of areas, centroids and second moments
 * over the distance of the polygon, by the library and by the sums that everyone would write.
 *
 *     origin [OUT.svg]
 *
 * Nothing here is timed, so a program of its own: it prints the same table and writes the same
 * picture on every machine. To that end the library runs its portable kernels, and polygons are
 * made by + - * / alone. Coordinates are whole numbers, 2^BITS to a diameter or as many as a double
 * has left at that distance, so what each polygon measures is known exactly: by sums in 128 bits
 * about a whole point next to the centroid. */
#include "edgewise.h"
#include "svg.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>

__extension__ typedef __int128 Wide;

#define POLYGONS 500
#define CORNERS 24
#define TEXT_OF(number) #number
#define TEXT(number) TEXT_OF(number)

enum { BITS = 30, SIGNIFICANT = 52, QUARTER = CORNERS / 4,
       DISTANCES = 26 };               /* 1, 2, 4, ... diameters */

enum { AREA, CENTROID, SECOND, QUANTITIES };
enum { NAIVE, OURS, WAYS };

typedef struct { int64_t x[CORNERS], y[CORNERS]; } Polygon;
typedef struct { double high, low; } Exact;            /* high + low, low beyond the last digit */
typedef struct { double area, centroid[2], second; } Found;
typedef struct { double x, y; } Point;

static double error[WAYS][QUANTITIES][DISTANCES];      /* the largest of all polygons */

/* ---- polygons ---- */

/* In [0, 1), by Knuth's generator. */
static double chance(void)
{
	static uint64_t state = 1;
	state = state * 6364136223846793005u + 1442695040888963407u;
	return (double)(state >> 11) * 0x1p-53;
}

/* On the unit circle, quarter by quarter, t in [0, 1) from one to the next. */
static Point direction(int quarter, double t)
{
	const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
	const Point all[] = { { c, s }, { -s, c }, { -c, -s }, { s, -c } };
	return all[quarter];
}

static int64_t whole(double value)
{
	return (int64_t)(value < 0 ? value - 0.5 : value + 0.5);
}

/* Around (0,0), counterclockwise, of this diameter. */
static Polygon make_polygon(double diameter)
{
	Polygon p;
	for (int i = 0; i < CORNERS; ++i) {
		const Point d = direction(i / QUARTER, (i % QUARTER + chance()) / QUARTER);
		const double radius = diameter / 4 * (1 + chance());
		p.x[i] = whole(radius * d.x);
		p.y[i] = whole(radius * d.y);
	}
	return p;
}

static Polygon moved(Polygon p, int64_t dx, int64_t dy)
{
	for (int i = 0; i < CORNERS; ++i) {
		p.x[i] += dx;
		p.y[i] += dy;
	}
	return p;
}

/* ---- exact values ---- */

typedef struct { Wide twice_area, x, y, xx; } Sums;    /* 2, 6, 6 and 12 times the integrals */

/* Radii are at most 2^29, so cross products are at most 2^59 and all sums less than 2^122. */
static Sums sum_exactly(const Polygon *p)
{
	Sums sums = { 0, 0, 0, 0 };
	for (int i = 0; i < CORNERS; ++i) {
		const int next = (i + 1) % CORNERS;
		const Wide x0 = p->x[i], y0 = p->y[i], x1 = p->x[next], y1 = p->y[next];
		const Wide cross = x0 * y1 - x1 * y0;
		sums.twice_area += cross;
		sums.x += cross * (x0 + x1);
		sums.y += cross * (y0 + y1);
		sums.xx += cross * (x0 * x0 + x0 * x1 + x1 * x1);
	}
	return sums;
}

/* a/b and a correction, which is far below it. */
static Exact ratio(Wide a, Wide b, double correction)
{
	const Wide quotient = a / b;
	const double high = (double)quotient;
	return (Exact){ high, (double)(quotient - (Wide)high) + (double)(a % b) / (double)b
		+ correction };
}

/* value - exact: the first difference is exact where the two are close. */
static double minus(double value, Exact exact)
{
	return (value - exact.high) - exact.low;
}

/* ---- the sums that everyone would write ---- */

static Found find_naively(const double *x, const double *y)
{
	double twice_area = 0, sum_x = 0, sum_y = 0, sum_xx = 0;
	for (int i = 0; i < CORNERS; ++i) {
		const int next = (i + 1) % CORNERS;
		const double cross = x[i] * y[next] - x[next] * y[i];
		twice_area += cross;
		sum_x += cross * (x[i] + x[next]);
		sum_y += cross * (y[i] + y[next]);
		sum_xx += cross * (x[i] * x[i] + x[i] * x[next] + x[next] * x[next]);
	}
	const double cx = sum_x / (3 * twice_area), cy = sum_y / (3 * twice_area);
	return (Found){ twice_area / 2, { cx, cy }, sum_xx / 12 - cx * cx * twice_area / 2 };
}

static Found find_by_library(const double *x, const double *y)
{
	double centroid[2], moment[EW_MOMENTS(2)];
	Found found = { ew_area(x, y, CORNERS), { 0, 0 }, 0 };
	ew_central_moments(2, x, y, CORNERS, centroid, moment);
	ew_centroid(x, y, CORNERS, found.centroid);
	found.second = moment[EW_INDEX(2, 0)];
	return found;
}

/* ---- errors ---- */

/* Of area and second moment relative; of the centroid in diameters. */
static void compare(const Found *found, int way, int k, double diameter, Exact area,
	const Exact *centroid, Exact second)
{
	const double errors[QUANTITIES] = {
		[AREA] = fabs(minus(found->area, area)) / area.high,
		[CENTROID] = fmax(fabs(minus(found->centroid[0], centroid[0])),
			fabs(minus(found->centroid[1], centroid[1]))) / diameter,
		[SECOND] = fabs(minus(found->second, second)) / second.high,
	};
	for (int q = 0; q < QUANTITIES; ++q)
		error[way][q][k] = fmax(error[way][q][k], errors[q]);
}

static void measure(int k)
{
	const double diameter = ldexp(1, k + BITS <= SIGNIFICANT ? BITS : SIGNIFICANT - k);
	const double distance = ldexp(diameter, k);
	const Polygon p = make_polygon(diameter);
	const Sums sums = sum_exactly(&p);
	const Wide thrice = 3 * sums.twice_area;
	const int64_t cx = (int64_t)(sums.x / thrice), cy = (int64_t)(sums.y / thrice);
	const Polygon central = moved(p, -cx, -cy);
	const Sums about = sum_exactly(&central);
	const double rest = (double)about.x * (double)about.x / (18 * (double)about.twice_area);
	const double turns = 4 * chance();
	const Point d = direction((int)turns, turns - (int)turns);
	const int64_t dx = whole(distance * d.x), dy = whole(distance * d.y);
	const Polygon far = moved(p, dx, dy);
	const Exact centroid[2] = {
		ratio(sums.x + dx * thrice, thrice, 0), ratio(sums.y + dy * thrice, thrice, 0),
	};
	const Exact area = ratio(sums.twice_area, 2, 0), second = ratio(about.xx, 12, -rest);
	double x[CORNERS], y[CORNERS];
	for (int i = 0; i < CORNERS; ++i) {
		x[i] = (double)far.x[i];
		y[i] = (double)far.y[i];
	}
	const Found naive = find_naively(x, y), ours = find_by_library(x, y);
	compare(&naive, NAIVE, k, diameter, area, centroid, second);
	compare(&ours, OURS, k, diameter, area, centroid, second);
}

/* ---- what came of it ---- */

static void print_table(void)
{
	printf("Largest error of %d polygons of %d vertices; of centroids in diameters\n\n"
		"             area                 centroid             second moment\n"
		"diameters    shoelace  ew_area    naive    ew_centroid  naive    "
		"ew_central_moments\n", POLYGONS, CORNERS);
	for (int k = 0; k < DISTANCES; ++k)
		printf("%9.0f    %8.1e  %8.1e   %8.1e %8.1e     %8.1e %8.1e\n", ldexp(1, k),
			error[NAIVE][AREA][k], error[OURS][AREA][k], error[NAIVE][CENTROID][k],
			error[OURS][CENTROID][k], error[NAIVE][SECOND][k], error[OURS][SECOND][k]);
}

/* ---- picture ---- */

enum { WIDE = 800, HIGH = 480, LAST_POWER = 7, SIZE = 16 };

static const SvgPanel panel = { 70, 610, 104, 424, { 1, 0x1p25, 1 }, { 2e-17, 1, 1 } };
static const struct {
	const char *line, *naive_line, *name, *ours, *naive;
} looks[QUANTITIES] = {
	[AREA] = { "c0 bold", "c0 dash", "c0 name", "ew_area", "area (shoelace)" },
	[CENTROID] = { "c3 bold", "c3 dash", "c3 name", "ew_centroid", "centroid" },
	[SECOND] = { "c2 bold", "c2 dash", "c2 name", "ew_central_moments", "second moment" },
};

/* 1, 10, 10 to the power of ... */
static const char *power_of_ten(int exponent, char text[SIZE])
{
	static const char *const digits[] = { "⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷",
		"⁸", "⁹" };
	const int size = exponent < 0 ? -exponent : exponent;
	if (exponent == 0 || exponent == 1)
		snprintf(text, SIZE, "%s", exponent ? "10" : "1");
	else
		snprintf(text, SIZE, "10%s%s%s", exponent < 0 ? "⁻" : "",
			size < 10 ? "" : digits[size / 10], digits[size % 10]);
	return text;
}

static void write_axes(Svg *svg)
{
	char text[SIZE];
	for (int exponent = 0; exponent <= LAST_POWER; ++exponent)
		svg_tick_x(svg, &panel, "grid", pow(10, exponent), "%s",
			power_of_ten(exponent, text));
	for (int exponent = 0; exponent >= -15; exponent -= 3)
		svg_tick_y(svg, &panel, "grid", pow(10, exponent), "%s",
			power_of_ten(exponent, text));
	svg_axis_titles(svg, &panel, "distance from the origin, in diameters of the polygon",
		"error");
}

/* A house of 20 m, 5000 km from the equator. */
static void write_example(Svg *svg)
{
	const double x = svg_x(&panel, 5e6 / 20), y = svg_y(&panel, 6e-14);
	fprintf(svg->out, "<path class=\"limit dash\" d=\"M%.1f %.1fV%.1f\"/>\n", x, panel.top,
		panel.bottom);
	svg_text(svg, "soft", x - 8, y, "end", "a house of 20 m");
	svg_text(svg, "soft", x - 8, y + 17, "end", "in UTM coordinates");
}

/* Over the panel, where the line leaves it. */
static void name_naive(Svg *svg, int quantity)
{
	const double *e = error[NAIVE][quantity];
	int k = 1;
	while (k + 1 < DISTANCES && e[k] < 1)
		++k;
	const double beyond = fmax(log(e[k]) / log(e[k] / e[k - 1]), 0);
	svg_text(svg, looks[quantity].name, svg_x(&panel, exp2(k - beyond)), panel.top - 12,
		"middle", "%s", looks[quantity].naive);
}

static int write_picture(const char *file)
{
	static const char title[] = "Far from the origin textbook sums lose every digit, "
		"Edgewise none";
	double distance[DISTANCES];
	SvgLabel label[QUANTITIES];
	Svg svg;
	if (!svg_open(&svg, file, WIDE, HIGH, title))
		return 0;
	svg_headline(&svg, title, "Largest error of " TEXT(POLYGONS) " polygons of "
		TEXT(CORNERS) " vertices, double; dashed: sums about the origin; centroids: in "
		"diameters");
	svg_panel(&svg, &panel);
	write_axes(&svg);
	write_example(&svg);
	for (int k = 0; k < DISTANCES; ++k)
		distance[k] = ldexp(1, k);
	for (int q = 0; q < QUANTITIES; ++q) {
		svg_line(&svg, &panel, looks[q].naive_line, distance, error[NAIVE][q], DISTANCES);
		svg_line(&svg, &panel, looks[q].line, distance, error[OURS][q], DISTANCES);
		name_naive(&svg, q);
		label[q].y = svg_y(&panel, error[OURS][q][DISTANCES - 1]);
		label[q].kind = looks[q].name;
		snprintf(label[q].text, sizeof label[q].text, "%s", looks[q].ours);
	}
	svg_text(&svg, "soft", panel.right + 10, label[CENTROID].y + 22, "start",
		"rounding of its coordinates");
	svg_labels(&svg, &panel, label, QUANTITIES);
	return svg_close(&svg);
}

int main(int argc, char **argv)
{
	if (argc > 2) {
		fputs("usage: origin [OUT.svg]\n", stderr);
		return 2;
	}
	ew_use_target(EW_PORTABLE);
	for (int k = 0; k < DISTANCES; ++k)
		for (int i = 0; i < POLYGONS; ++i)
			measure(k);
	print_table();
	if (argc == 2 && !write_picture(argv[1])) {
		fprintf(stderr, "origin: cannot write %s\n", argv[1]);
		return 1;
	}
	return 0;
}

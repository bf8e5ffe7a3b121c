/* plot.c - what filters look like: their values, and what they let through, as SVG.
 *
 *     plot FILTER [FILTER [FILTER]] OUT.svg          a file each, or the name of a built-in filter
 *
 * The filters are read by gen's own reader, so what is drawn is what is emitted. On the left stands
 * k(x); on the right, in decibels, the size of its Fourier transform, K(f) = integral of k(x)
 * exp(-2 pi i f x) dx, over cycles per pixel. A grid of pixels can hold half a cycle per pixel;
 * what a filter lets through beyond that comes back as aliases. If the first filter is bivariate,
 * all are shown along an axis and, dashed, along a diagonal, over the distance from 0.
 *
 * Every integral is a Gauss-Legendre rule of 32 nodes on pieces at most a pixel long: of 19 radians
 * of phase at most (3 cycles) it gets all but rounding. The layout depends on the filters alone;
 * colours follow the reader's light or dark scheme. */
#include "gen.h"
#include "svg.h"

#include <math.h>
#include <stdio.h>

#define PI 3.14159265358979323846

enum { MAX_FILTERS = 3, NODES = 32, STEPS = 320, POWERS = MAX_DEGREE + 1 };
enum { WIDE = 800, HIGH = 372, TOP = 100, BOTTOM = 316, LOWEST = -80, HIGHEST_FREQUENCY = 2 };

typedef struct {
	double x0, x1, y0, y1, coefficient[POWERS][POWERS];
	int degree_x, degree_y;
} Cell;
typedef struct { Filter filter; Cell *cell; } Subject;
typedef struct { double re, im; } Complex;
typedef double Curve(const Subject *subject, double at, double cosine, double sine);

static const struct { const char *line, *diagonal, *name; } looks[MAX_FILTERS] = {
	{ "c0 bold", "c0 dash", "c0 name" }, { "c1", "c1 thin dash", "c1 name" },
	{ "c2", "c2 thin dash", "c2 name" },
};

/* ---- filters in floating point ---- */

static double real(Rat a)
{
	return (double)a.num / (double)a.den;
}

static Subject read_subject(const char *word)
{
	Subject subject = { .filter = filter_read(word) };
	const Filter *filter = &subject.filter;
	subject.cell = allocate((size_t)filter->pieces * sizeof *subject.cell);
	for (int i = 0; i < filter->pieces; ++i) {
		const Piece *piece = &filter->piece[i];
		Cell *cell = &subject.cell[i];
		cell->x0 = real(piece->x0);
		cell->x1 = real(piece->x1);
		cell->y0 = real(piece->y0);
		cell->y1 = filter->separable ? 1 : real(piece->y1);   /* as if constant on 0..1 */
		cell->degree_x = poly_degree(piece->value, VAR_X);
		cell->degree_y = poly_degree(piece->value, VAR_Y);
		for (int k = 0; k < piece->value.count; ++k) {
			const Term *term = &piece->value.term[k];
			cell->coefficient[mono_power(term->mono, VAR_X)]
				[mono_power(term->mono, VAR_Y)] = real(term->coef);
		}
	}
	return subject;
}

static double evaluate_cell(const Cell *cell, double x, double y)
{
	double value = 0;
	for (int i = cell->degree_x; i >= 0; --i) {
		double row = 0;
		for (int j = cell->degree_y; j >= 0; --j)
			row = row * y + cell->coefficient[i][j];
		value = value * x + row;
	}
	return value;
}

/* k(x), or f(x, y) of a bivariate filter; at a jump, what follows. */
static double evaluate_at(const Subject *subject, double x, double y)
{
	for (int i = 0; i < subject->filter.pieces; ++i) {
		const Cell *cell = &subject->cell[i];
		if (x >= cell->x0 && x < cell->x1 && y >= cell->y0 && y < cell->y1)
			return evaluate_cell(cell, x, y);
	}
	return 0;
}

static double value_on_axis(const Subject *subject, double at, double cosine, double sine)
{
	(void)cosine, (void)sine;
	return evaluate_at(subject, at, 0);
}

static double value_in_plane(const Subject *subject, double at, double cosine, double sine)
{
	const double x = at * cosine, y = at * sine;
	return subject->filter.separable ? evaluate_at(subject, x, 0) * evaluate_at(subject, y, 0)
		: evaluate_at(subject, x, y);
}

/* ---- their transforms ---- */

static double node[NODES], weight[NODES];                           /* on 0..1 */

/* Newton's method on the Legendre polynomial, from the usual first guess. */
static void find_nodes(void)
{
	for (int i = 0; i < NODES; ++i) {
		double x = cos(PI * (i + 0.75) / (NODES + 0.5)), slope = 1;
		for (int step = 0; step < 10; ++step) {
			double before = 1, value = x;
			for (int k = 2; k <= NODES; ++k) {
				const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
				before = value;
				value = next;
			}
			slope = NODES * (x * value - before) / (x * x - 1);
			x -= value / slope;
		}
		node[i] = (1 - x) / 2;
		weight[i] = 1 / ((1 - x * x) * slope * slope);
	}
}

/* Of one cell cut to x..x+w, y..y+h. */
static Complex transform_part(const Cell *cell, double x, double w, double y, double h, double fx,
	double fy)
{
	Complex sum = { 0, 0 };
	for (int i = 0; i < NODES; ++i)
		for (int j = 0; j < NODES; ++j) {
			const double px = x + w * node[i], py = y + h * node[j];
			const double value = w * weight[i] * h * weight[j] *
				evaluate_cell(cell, px, py);
			sum.re += value * cos(2 * PI * (fx * px + fy * py));
			sum.im += value * sin(2 * PI * (fx * px + fy * py));
		}
	return sum;
}

static double transform(const Subject *subject, double fx, double fy)
{
	Complex sum = { 0, 0 };
	for (int i = 0; i < subject->filter.pieces; ++i) {
		const Cell *cell = &subject->cell[i];
		const int columns = (int)ceil(cell->x1 - cell->x0);
		const int rows = (int)ceil(cell->y1 - cell->y0);
		const double w = (cell->x1 - cell->x0) / columns, h = (cell->y1 - cell->y0) / rows;
		for (int k = 0; k < columns * rows; ++k) {
			const Complex part = transform_part(cell, cell->x0 + w * (k % columns), w,
				cell->y0 + h * (k / columns), h, fx, fy);
			sum.re += part.re;
			sum.im += part.im;
		}
	}
	return hypot(sum.re, sum.im);
}

/* In decibels. */
static double response_along(const Subject *subject, double at, double cosine, double sine)
{
	const double fx = at * cosine, fy = at * sine;
	double size;
	if (subject->filter.separable)
		size = transform(subject, fx, 0) * (sine > 0 ? transform(subject, fy, 0) : 1);
	else
		size = transform(subject, fx, fy);
	return fmax(20 * log10(fmax(size, 1e-12)), 1.5 * LOWEST);
}

/* ---- drawing ---- */

/* One of the upright lines may be a limit. */
static void write_grid(Svg *svg, const SvgPanel *panel, double step_x, double step_y, double limit)
{
	for (int i = (int)ceil(panel->x.first / step_x); i * step_x <= panel->x.last; ++i)
		svg_tick_x(svg, panel, i * step_x == limit ? "limit" : "grid", i * step_x, "%g",
			i * step_x);
	for (int i = (int)ceil(panel->y.first / step_y - 1e-9);
			i * step_y <= panel->y.last + 1e-9; ++i)
		svg_tick_y(svg, panel, "grid", i * step_y, "%g", i * step_y);
}

static void write_curve(Svg *svg, const SvgPanel *panel, const Subject *subject, int index,
	Curve *curve, int diagonal)
{
	const double along = diagonal ? sqrt(0.5) : 1, across = diagonal ? along : 0;
	double x[STEPS + 1], y[STEPS + 1];
	for (int i = 0; i <= STEPS; ++i) {
		x[i] = panel->x.first + (panel->x.last - panel->x.first) * i / STEPS;
		y[i] = curve(subject, x[i], along, across);
	}
	svg_line(svg, panel, diagonal ? looks[index].diagonal : looks[index].line, x, y, STEPS + 1);
}

/* The axis of values: from the lowest to the highest, on whole steps. */
static double choose_values(SvgPanel *panel, const Subject *subject, int count, Curve *value)
{
	const double reach = value == value_in_plane ? sqrt(2) : 1;
	double least = 0, most = 0;
	for (int i = 0; i < count; ++i) {
		const Filter *filter = &subject[i].filter;
		panel->x.first = fmin(panel->x.first, reach * real(filter->first_x) - 0.25);
		panel->x.last = fmax(panel->x.last, reach * real(filter->last_x) + 0.25);
		for (double x = panel->x.first; x <= panel->x.last; x += 1 / 64.0) {
			least = fmin(least, value(&subject[i], x, 1, 0));
			most = fmax(most, value(&subject[i], x, 1, 0));
		}
	}
	const double step = most > 0.6 ? 0.2 : most > 0.3 ? 0.1 : 0.05;
	panel->y.first = step * floor(least / step);
	panel->y.last = step * ceil(most / step);
	return step;
}

static void write_names(Svg *svg, const Subject *subject, int count, int bivariate)
{
	SvgLabel label[MAX_FILTERS + 1] = { { 0 } };
	for (int i = 0; i < count; ++i) {
		label[i].kind = looks[i].name;
		snprintf(label[i].text, sizeof label[i].text, "%s%s", subject[i].filter.name,
			subject[i].filter.builtin ? ", built in" : "");
	}
	label[count] = (SvgLabel){ 0, "soft", "dashed: along a diagonal" };
	svg_legend(svg, label, count + bivariate);
}

static void write_plot(Svg *svg, const Subject *subject, int count, const char *title)
{
	SvgPanel values = { 56, 372, TOP, BOTTOM, { 0, 0, 0 }, { 0, 0, 0 } };
	const SvgPanel response = { 460, 776, TOP, BOTTOM, { 0, HIGHEST_FREQUENCY, 0 },
		{ LOWEST, 5, 0 } };
	const int bivariate = !subject->filter.separable;
	Curve *value = bivariate ? value_in_plane : value_on_axis;
	const double step = choose_values(&values, subject, count, value);
	svg_headline(svg, title, NULL);
	write_names(svg, subject, count, bivariate);
	svg_panel(svg, &values);
	svg_panel(svg, &response);
	write_grid(svg, &values, 1, step, (double)NAN);
	write_grid(svg, &response, 0.5, 20, 0.5);
	svg_axis_titles(svg, &values, "pixels from the centre", bivariate ? "f(x, y)" : "k(x)");
	svg_axis_titles(svg, &response, "cycles per pixel", "response in dB");
	svg_text(svg, "soft", response.right, TOP - 12, "end", "beyond 0.5: aliases");
	for (int i = count - 1; i >= 0; --i)
		for (int diagonal = bivariate; diagonal >= 0; --diagonal) {
			write_curve(svg, &values, &subject[i], i, value, diagonal);
			write_curve(svg, &response, &subject[i], i, response_along, diagonal);
		}
}

int main(int argc, char **argv)
{
	Subject subject[MAX_FILTERS];
	const int count = argc - 2;
	Svg svg;
	if (count < 1 || count > MAX_FILTERS) {
		fputs("usage: plot FILTER [FILTER [FILTER]] OUT.svg\n", stderr);
		return EXIT_USAGE;
	}
	for (int i = 0; i < count; ++i)
		subject[i] = read_subject(argv[1 + i]);
	find_nodes();
	const char *title = format("The filter %s and its frequency response",
		subject->filter.name);
	const char *file = argv[argc - 1];
	int good = svg_open(&svg, file, WIDE, HIGH, title);
	if (good) {
		write_plot(&svg, subject, count, title);
		good = svg_close(&svg);
	}
	if (!good)
		fatal(EXIT_DIFFERENT, "cannot write %s", file);
	return EXIT_DONE;
}

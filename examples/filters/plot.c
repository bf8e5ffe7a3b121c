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

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define PI 3.14159265358979323846

enum { MAX_FILTERS = 3, NODES = 32, STEPS = 320, POWERS = MAX_DEGREE + 1 };
enum { WIDE = 760, HIGH = 330, TOP = 70, BOTTOM = 280, LOWEST = -80, HIGHEST_FREQUENCY = 2 };

typedef struct {
	double x0, x1, y0, y1, coefficient[POWERS][POWERS];
	int degree_x, degree_y;
} Cell;
typedef struct { Filter filter; Cell *cell; } Subject;
typedef struct { double re, im; } Complex;
typedef struct { double left, right, x0, x1, y0, y1; } Panel;       /* pixels; range of the axes */
typedef double Curve(const Subject *subject, double at, double cosine, double sine);

static const char style[] =
	"<style>\n"
	".page{fill:#ffffff}.ink{fill:#1f2328}.soft{fill:#59636e}\n"
	".grid{stroke:#d1d9e0;stroke-width:1}.limit{stroke:#59636e;stroke-width:1.5}\n"
	".c{fill:none;stroke-width:1.6;stroke-linejoin:round}.d{stroke-dasharray:5 4}\n"
	".c0{stroke:#0b63c5;stroke-width:2.4}.c1{stroke:#b3261e}.c2{stroke:#1a7f37}\n"
	"text{font:13px system-ui,sans-serif}.title{font-size:17px;font-weight:600}\n"
	"@media (prefers-color-scheme:dark){.page{fill:#0d1117}.ink{fill:#f0f6fc}"
	".soft{fill:#9198a1}\n.grid{stroke:#3d444d}.limit{stroke:#9198a1}\n"
	".c0{stroke:#58a6ff}.c1{stroke:#ff7b72}.c2{stroke:#3fb950}}\n"
	"</style>\n";

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

static double place_x(const Panel *panel, double x)
{
	return panel->left + (panel->right - panel->left) * (x - panel->x0) / (panel->x1 - panel->x0);
}

static double place_y(const Panel *panel, double y)
{
	return BOTTOM - (BOTTOM - TOP) * (y - panel->y0) / (panel->y1 - panel->y0);
}

__attribute__((format(printf, 6, 7)))
static void write_text(Text *out, const char *kind, double x, double y, const char *anchor,
	const char *pattern, ...)
{
	char text[200];
	va_list arguments;
	va_start(arguments, pattern);
	vsnprintf(text, sizeof text, pattern, arguments);
	va_end(arguments);
	text_add(out, "<text class=\"%s\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n", kind,
		x, y, anchor, text);
}

static void write_grid(Text *out, const Panel *panel, double step_x, double step_y,
	const char *title)
{
	for (int i = (int)ceil(panel->x0 / step_x); i * step_x <= panel->x1; ++i) {
		const double x = place_x(panel, i * step_x);
		text_add(out, "<path class=\"grid\" d=\"M%.1f %dV%d\"/>\n", x, TOP, BOTTOM);
		write_text(out, "soft", x, BOTTOM + 18, "middle", "%g", i * step_x);
	}
	for (int i = (int)ceil(panel->y0 / step_y - 1e-9); i * step_y <= panel->y1 + 1e-9; ++i) {
		const double y = place_y(panel, i * step_y);
		text_add(out, "<path class=\"grid\" d=\"M%.1f %.1fH%.1f\"/>\n", panel->left, y,
			panel->right);
		write_text(out, "soft", panel->left - 6, y + 4, "end", "%g", i * step_y);
	}
	write_text(out, "ink", (panel->left + panel->right) / 2, BOTTOM + 38, "middle", "%s", title);
}

static void write_curve(Text *out, const Panel *panel, const Subject *subject, int index,
	Curve *curve, int diagonal)
{
	const double along = diagonal ? sqrt(0.5) : 1, across = diagonal ? along : 0;
	text_add(out, "<path clip-path=\"url(#%s)\" class=\"c c%d%s\" d=\"",
		curve == response_along ? "response" : "values", index, diagonal ? " d" : "");
	for (int i = 0; i <= STEPS; ++i) {
		const double at = panel->x0 + (panel->x1 - panel->x0) * i / STEPS;
		text_add(out, "%s%.1f %.1f", i ? "L" : "M", place_x(panel, at),
			place_y(panel, curve(subject, at, along, across)));
	}
	text_add(out, "\"/>\n");
}

static void write_legend(Text *out, const Subject *subject, int count, int bivariate)
{
	const double x = 580;
	for (int i = 0; i < count; ++i) {
		const double y = TOP + 16 + 20 * i;
		text_add(out, "<path class=\"c c%d\" d=\"M%.1f %.1fh24\"/>\n", i, x, y - 4);
		write_text(out, "ink", x + 32, y, "start", "%s%s", subject[i].filter.name,
			subject[i].filter.builtin ? ", built in" : "");
	}
	if (bivariate)
		write_text(out, "soft", x, TOP + 16 + 20 * count, "start", "dashed: diagonally");
}

/* The axis of values: from the lowest to the highest, on whole steps. */
static double choose_values(Panel *panel, const Subject *subject, int count, Curve *value)
{
	const double reach = value == value_in_plane ? sqrt(2) : 1;
	double least = 0, most = 0;
	for (int i = 0; i < count; ++i) {
		const Filter *filter = &subject[i].filter;
		panel->x0 = fmin(panel->x0, reach * real(filter->first_x) - 0.25);
		panel->x1 = fmax(panel->x1, reach * real(filter->last_x) + 0.25);
		for (double x = panel->x0; x <= panel->x1; x += 1 / 64.0) {
			least = fmin(least, value(&subject[i], x, 1, 0));
			most = fmax(most, value(&subject[i], x, 1, 0));
		}
	}
	const double step = most > 0.6 ? 0.2 : most > 0.3 ? 0.1 : 0.05;
	panel->y0 = step * floor(least / step);
	panel->y1 = step * ceil(most / step);
	return step;
}

static void write_plot(Text *out, const Subject *subject, int count)
{
	Panel values = { 60, 350, 0, 0, 0, 0 };
	const Panel response = { 440, 740, 0, HIGHEST_FREQUENCY, LOWEST, 5 };
	const int bivariate = !subject->filter.separable;
	Curve *value = bivariate ? value_in_plane : value_on_axis;
	const double step = choose_values(&values, subject, count, value);
	text_add(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" "
		"height=\"%d\" role=\"img\">\n<title>The filter %s and its frequency response</title>\n"
		"%s<clipPath id=\"values\"><path d=\"M60 %dH350V%dH60z\"/></clipPath>\n"
		"<clipPath id=\"response\"><path d=\"M440 %dH740V%dH440z\"/></clipPath>\n"
		"<rect class=\"page\" width=\"%d\" height=\"%d\"/>\n", WIDE, HIGH, WIDE, HIGH,
		subject->filter.name, style, TOP, BOTTOM, TOP, BOTTOM, WIDE, HIGH);
	write_text(out, "ink title", 60, 28, "start", "%s", subject->filter.name);
	write_text(out, "soft", 60, TOP - 12, "start", "%s", bivariate ? "f(x, y) over the distance"
		: "k(x)");
	write_text(out, "soft", 440, TOP - 12, "start", "response in dB");
	write_grid(out, &values, 1, step, "pixels from the centre");
	write_grid(out, &response, 0.5, 20, "cycles per pixel; beyond 0.5 are aliases");
	text_add(out, "<path class=\"limit\" d=\"M%.1f %dV%d\"/>\n", place_x(&response, 0.5), TOP,
		BOTTOM);
	for (int i = count - 1; i >= 0; --i)
		for (int diagonal = 0; diagonal <= bivariate; ++diagonal) {
			write_curve(out, &values, &subject[i], i, value, diagonal);
			write_curve(out, &response, &subject[i], i, response_along, diagonal);
		}
	write_legend(out, subject, count, bivariate);
	text_add(out, "</svg>\n");
}

/* Appears at once, by a rename. */
static void write_file(const char *file, const Text *text)
{
	const char *temporary = format("%s.%ld.tmp", file, (long)getpid());
	FILE *stream = fopen(temporary, "w");
	int good = stream && fwrite(text->data, 1, text->size, stream) == text->size;
	if (stream)
		good = fclose(stream) == 0 && good;
	if (!good || rename(temporary, file) != 0)
		fatal(EXIT_DIFFERENT, "cannot write %s: %s", file, strerror(errno));
}

int main(int argc, char **argv)
{
	Subject subject[MAX_FILTERS];
	Text out = { 0 };
	const int count = argc - 2;
	if (count < 1 || count > MAX_FILTERS) {
		fputs("usage: plot FILTER [FILTER [FILTER]] OUT.svg\n", stderr);
		return EXIT_USAGE;
	}
	for (int i = 0; i < count; ++i)
		subject[i] = read_subject(argv[1 + i]);
	find_nodes();
	write_plot(&out, subject, count);
	write_file(argv[argc - 1], &out);
	text_free(&out);
	return EXIT_DONE;
}

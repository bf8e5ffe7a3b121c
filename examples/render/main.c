/* main.c - render: text, paths of SVG and maps to PNG, with any filter of the library.
 *
 * Reads the command line, makes one Drawing (or a Map), decides how large the picture is and where
 * in it the drawing goes, paints and writes. Text keeps its base line on a row of pixels, so that
 * its size and the filter alone decide how it looks. */
#include "render.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DEFAULT_FONT "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"

enum { LARGEST_SIDE = 16384, DEFAULT_SIDE = 512, MARGIN = 3 /* pixels: half a wide filter */ };

typedef struct {
	const ew_filter *filter;
	double size;       /* of an em */
	int width, height; /* 0: not said */
	Box view;          /* left > right: not said */
	Colour ink, paper;
	bool rgba;
	const char *font, *country;
} Options;

void fail(const char *format, ...)
{
	va_list args;
	va_start(args, format);
	fputs("render: ", stderr);
	vfprintf(stderr, format, args);
	fputc('\n', stderr);
	va_end(args);
	exit(1);
}

static const char help[] =
	"usage: render [OPTIONS] text FONT TEXT OUT.png\n"
	"       render [OPTIONS] path DATA OUT.png        the d of a <path>, as 'M0 0H9V9z'\n"
	"       render [OPTIONS] svg FILE OUT.png         the paths of a file, in one colour\n"
	"       render [OPTIONS] countries FILE OUT.png   examples/data/countries.txt\n"
	"       render [OPTIONS] sheet OUT.png            filters side by side\n"
	"       render --filters | --help\n"
	"  --filter NAME       box (default), or another of --filters\n"
	"  --size PIXELS       of an em of text (64)\n"
	"  --width N, --height N   of the picture; default: the text's size, else 512 at most\n"
	"  --view X,Y,W,H      what of a path is shown, instead of its viewBox or its bounds\n"
	"  --country NAME      that one only\n"
	"  --ink RRGGBB, --paper RRGGBB   in sRGB (000000 on ffffff)\n"
	"  --rgba              coverage as alpha on nothing, instead of grey on paper\n"
	"  --font FILE         for the sheet (DejaVuSans)\n"
	"Coverage is linear light, encoded as sRGB. Overlaps of rings count once.\n";

static _Noreturn void usage(const char *format, ...) PRINTF(1, 2);

static void usage(const char *format, ...)
{
	va_list args;
	va_start(args, format);
	fputs("render: ", stderr);
	vfprintf(stderr, format, args);
	fprintf(stderr, "\n%s", help);
	va_end(args);
	exit(2);
}

static int finish(void)
{
	if (fflush(stdout) || ferror(stdout))
		fail("cannot write standard output: %s", strerror(errno));
	return 0;
}

/* ---- pictures ---- */

/* One over the other. */
static void write_drawings(const Options *options, const Drawing *drawings, size_t count, int width,
			   int height, const char *out)
{
	Picture picture = picture_new(width, height);
	if (!options->rgba)
		picture_fill(&picture, options->paper);
	for (size_t i = 0; i < count; i++)
		paint(&picture, options->filter, &drawings[i], options->ink);
	picture_write(&picture, options->rgba ? RGBA : GREY, out);
	picture_free(&picture);
}

/* Sides that were not said follow from the shape of what is shown. */
static void choose_sides(const Options *options, Box view, int *width, int *height)
{
	const double wide = view.right - view.left, high = view.bottom - view.top;
	*width = options->width;
	*height = options->height;
	if (!*width && !*height) {
		if (wide >= high)
			*width = DEFAULT_SIDE;
		else
			*height = DEFAULT_SIDE;
	}
	const double other = *width ? *width * (high / wide) : *height * (wide / high);
	int *missing = *width ? *height ? NULL : height : width;
	if (missing)
		*missing = (int)fmin(LARGEST_SIDE, fmax(1, ceil(other - 1e-9)));
}

static void render_text(const Options *options, char **operands)
{
	Drawing drawing = { 0 };
	Font *font = font_open(operands[0]);
	font_text(font, operands[1], options->size, &drawing);
	font_close(font);
	if (!drawing.verb_count)
		fail("the text has no outlines");
	const Box box = drawing_box(&drawing);
	const double left = floor(box.left) - MARGIN, top = floor(box.top) - MARGIN;
	const double width = ceil(box.right) + MARGIN - left;
	const double height = ceil(box.bottom) + MARGIN - top;
	if (!(width <= LARGEST_SIDE) || !(height <= LARGEST_SIDE))
		fail("the text is larger than %d pixels; choose a smaller --size", LARGEST_SIDE);
	drawing_place(&drawing, (Placement){ 1, 1, -left, -top });
	write_drawings(options, &drawing, 1, options->width ? options->width : (int)width,
		       options->height ? options->height : (int)height, operands[2]);
	drawing_free(&drawing);
}

static Box box_of(const Drawing *drawings, size_t count)
{
	Box all = { INFINITY, INFINITY, -INFINITY, -INFINITY };
	for (size_t i = 0; i < count; i++) {
		const Box box = drawing_box(&drawings[i]);
		all = (Box){ fmin(all.left, box.left), fmin(all.top, box.top),
			     fmax(all.right, box.right), fmax(all.bottom, box.bottom) };
	}
	return all;
}

static void render_svg(const Options *options, Svg *svg, const char *out)
{
	Box view = options->view;
	int width, height;
	if (view.left > view.right)
		view = svg->view;
	if (view.left > view.right)
		view = box_of(svg->paths, svg->count);
	choose_sides(options, view, &width, &height);
	const Placement place = fit(view, (Box){ 0, 0, width, height });
	for (size_t i = 0; i < svg->count; i++)
		drawing_place(&svg->paths[i], place);
	write_drawings(options, svg->paths, svg->count, width, height, out);
	for (size_t i = 0; i < svg->count; i++)
		drawing_free(&svg->paths[i]);
	free(svg->paths);
}

static void render_path(const Options *options, char **operands)
{
	Svg svg;
	svg_read_path(operands[0], &svg);
	render_svg(options, &svg, operands[1]);
}

static void render_svg_file(const Options *options, char **operands)
{
	Svg svg;
	svg_read_file(operands[0], &svg);
	render_svg(options, &svg, operands[1]);
}

static void render_countries(const Options *options, char **operands)
{
	static const unsigned land[MAP_COLOURS] = { 0xe9c46a, 0xa3b18a, 0xe5989b, 0x84a59d,
						    0xd4a373 };
	static const double rim = 2; /* the radius of the globe's disc, of radius 1 the globe */
	const bool world = !options->country;
	Map map;
	map_read_file(operands[0], options->country, &map);
	const Box view = world ? (Box){ -rim, -rim, rim, rim } : box_of(map.land, MAP_COLOURS);
	int width, height;
	choose_sides(options, view, &width, &height);
	const Placement place =
		fit(view, (Box){ MARGIN, MARGIN, width - MARGIN, height - MARGIN });
	Picture picture = picture_new(width, height);
	if (!options->rgba)
		picture_fill(&picture, options->paper);
	if (world) {
		Drawing sea = { 0 };
		drawing_ellipse(&sea, place.x, place.y, rim * place.scale_x, rim * place.scale_y);
		paint(&picture, options->filter, &sea, colour_of(0xdcebf5));
		drawing_free(&sea);
	}
	Colour inks[MAP_COLOURS];
	for (int i = 0; i < MAP_COLOURS; i++) {
		inks[i] = colour_of(land[i]);
		drawing_place(&map.land[i], place);
	}
	paint_tiles(&picture, options->filter, map.land, inks, MAP_COLOURS);
	picture_write(&picture, options->rgba ? RGBA : GREY, operands[1]);
	picture_free(&picture);
	map_free(&map);
}

static void render_sheet(const Options *options, char **operands)
{
	Font *font = font_open(options->font);
	Picture sheet = make_sheet(font);
	font_close(font);
	picture_write(&sheet, GREY, operands[0]);
	picture_free(&sheet);
}

/* ---- the command line ---- */

static const struct {
	const char *name;
	int operands;
	void (*run)(const Options *options, char **operands);
} commands[] = {
	{ "text", 3, render_text },	      { "path", 2, render_path },
	{ "svg", 2, render_svg_file },	      { "countries", 2, render_countries },
	{ "sheet", 1, render_sheet },
};

static double take_number(const char *option, const char *text, double least, double most)
{
	char *end;
	const double value = strtod(text, &end);
	if (end == text || *end || !(value >= least && value <= most))
		usage("%s wants a number from %g to %g, not '%s'", option, least, most, text);
	return value;
}

static int take_side(const char *option, const char *text)
{
	const double value = take_number(option, text, 1, LARGEST_SIDE);
	if (value != floor(value))
		usage("%s wants a whole number of pixels, not '%s'", option, text);
	return (int)value;
}

static Colour take_colour(const char *option, const char *text)
{
	if (strlen(text) != 6 || strspn(text, "0123456789abcdefABCDEF") != 6)
		usage("%s wants six hexadecimal digits, RRGGBB, not '%s'", option, text);
	return colour_of((unsigned)strtoul(text, NULL, 16));
}

static Box take_view(const char *text)
{
	double x, y, w, h;
	char more;
	if (sscanf(text, "%lf,%lf,%lf,%lf%c", &x, &y, &w, &h, &more) != 4 ||
	    !(fabs(x) <= 1e9 && fabs(y) <= 1e9 && w > 0 && w <= 1e9 && h > 0 && h <= 1e9))
		usage("--view wants X,Y,WIDTH,HEIGHT, not '%s'", text);
	return (Box){ x, y, x + w, y + h };
}

static void take_option(Options *options, const char *option, const char *value)
{
	if (!strcmp(option, "--filter")) {
		options->filter = find_filter(value);
		if (!options->filter)
			usage("there is no filter '%s' in this program; see --filters", value);
	} else if (!strcmp(option, "--size")) {
		options->size = take_number(option, value, 0.01, LARGEST_SIDE);
	} else if (!strcmp(option, "--width")) {
		options->width = take_side(option, value);
	} else if (!strcmp(option, "--height")) {
		options->height = take_side(option, value);
	} else if (!strcmp(option, "--view")) {
		options->view = take_view(value);
	} else if (!strcmp(option, "--ink")) {
		options->ink = take_colour(option, value);
	} else if (!strcmp(option, "--paper")) {
		options->paper = take_colour(option, value);
	} else if (!strcmp(option, "--country")) {
		options->country = value;
	} else if (!strcmp(option, "--font")) {
		options->font = value;
	} else {
		usage("there is no option %s", option);
	}
}

/* Moves the operands to the front; returns how many. */
static int take_options(int argc, char **argv, Options *options)
{
	int count = 0;
	bool more = true;
	for (int i = 1; i < argc; i++) {
		if (!more || strncmp(argv[i], "--", 2)) {
			argv[count++] = argv[i];
		} else if (!strcmp(argv[i], "--")) {
			more = false;
		} else if (!strcmp(argv[i], "--rgba")) {
			options->rgba = true;
		} else if (!strcmp(argv[i], "--filters")) {
			list_filters();
			exit(finish());
		} else if (!strcmp(argv[i], "--help")) {
			fputs(help, stdout);
			exit(finish());
		} else if (i + 1 == argc) {
			usage("%s wants a value, or does not exist", argv[i]);
		} else {
			take_option(options, argv[i], argv[i + 1]);
			i++;
		}
	}
	return count;
}

int main(int argc, char **argv)
{
	Options options = { .filter = &ew_filter_box, .size = 64, .view = { 1, 1, 0, 0 },
			    .ink = colour_of(0x000000), .paper = colour_of(0xffffff),
			    .font = DEFAULT_FONT };
	const int count = take_options(argc, argv, &options);
	if (!count)
		usage("what is to be drawn?");
	for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
		if (strcmp(argv[0], commands[i].name))
			continue;
		if (count != commands[i].operands + 1)
			usage("%s wants %d operands, not %d", argv[0], commands[i].operands,
			      count - 1);
		commands[i].run(&options, argv + 1);
		return finish();
	}
	usage("there is no command '%s'", argv[0]);
}

/* glyphs.c - area, centroid, second moments and slant of the glyphs of a font.
 *
 * FreeType reads the font, TrueType or PostScript, and puts composite glyphs together; the
 * statistics are those of fontTools' StatisticsPen, with its names, units and signs. They come from
 * the curves themselves: one path per glyph, no flattening.
 *
 * Nothing here rounds a coordinate. FreeType's outlines in font units are whole numbers, but the
 * point in the middle of two control points, which TrueType leaves out, need not be; so FreeType is
 * asked for twice the coordinates. Moments are taken about a whole point inside of the glyph's box:
 * the subtraction is exact, and variances, E[x^2] - E[x]^2, lose no digits to the glyph's place.
 *
 * Invariant: an Outline holds the points relative to its centre, in font units, and exactly as many
 * as its verbs take. */
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ft2build.h>
#include FT_OUTLINE_H

#include "edgewise.h"
#include "face.h"
#include "utf8.h"

/* Coordinates are multiples of 1/2, so the area under a line is a multiple of 1/8, under a quad of
 * 1/24, under a cubic of 1/80, and all areas are multiples of this. */
#define AREA_STEP (1 / 240.0)

enum { DEGREE = 2, MOMENTS = EW_MOMENTS(DEGREE), LONGEST_NAME = 64 };

enum { AREA, MEAN_X, MEAN_Y, VARIANCE_X, VARIANCE_Y, STDDEV_X, STDDEV_Y, COVARIANCE, CORRELATION,
       SLANT, STATISTICS };

static const struct {
	const char *name;
	int width, decimals;
} columns[STATISTICS] = {
	{ "area", 12, 2 }, { "meanX", 8, 2 }, { "meanY", 8, 2 }, { "varianceX", 11, 1 },
	{ "varianceY", 11, 1 }, { "stddevX", 8, 2 }, { "stddevY", 8, 2 },
	{ "covariance", 11, 1 }, { "correlation", 11, 4 }, { "slant", 8, 4 },
};

static const char default_characters[] =
	"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789";

typedef struct {
	unsigned char *verbs;
	double *points; /* x, y, x, y, ... */
	size_t verb_count, number_count;
	double centre[2];
} Outline;

typedef struct {
	const char *file;
	FT_Library library;
	FT_Face face;
	FT_ULong *codes; /* of every glyph its first character, 0 for none */
} Font;

_Noreturn void fail(const char *format, ...)
{
	va_list args;
	va_start(args, format);
	fputs("glyphs: ", stderr);
	vfprintf(stderr, format, args);
	fputc('\n', stderr);
	va_end(args);
	exit(1);
}

/* Zeros. */
static void *allocate(size_t count, size_t size)
{
	void *array = calloc(count + 1, size);
	if (!array)
		fail("no room for %zu glyphs", count);
	return array;
}

/* Room for one more element behind `count`; arrays double whenever count is a power of two. */
static void *grow(void *array, size_t count, size_t size)
{
	if (count & (count - 1))
		return array;
	const size_t room = count ? 2 * count : 1;
	void *grown = room > SIZE_MAX / size ? NULL : realloc(array, room * size);
	if (!grown)
		fail("no room for the outlines");
	return grown;
}

/* ---- reading ---- */

static void open_font(Font *font, const char *file)
{
	*font = (Font){ .file = file };
	font->face = open_face(&font->library, file);
	font->codes = allocate((size_t)font->face->num_glyphs, sizeof *font->codes);
	if (FT_Select_Charmap(font->face, FT_ENCODING_UNICODE))
		return;
	FT_UInt glyph;
	FT_ULong code = FT_Get_First_Char(font->face, &glyph);
	for (; glyph; code = FT_Get_Next_Char(font->face, code, &glyph))
		if (glyph < (FT_ULong)font->face->num_glyphs && !font->codes[glyph])
			font->codes[glyph] = code;
}

static int add(Outline *outline, unsigned char verb, const FT_Vector *const *points, int count)
{
	outline->verbs = grow(outline->verbs, outline->verb_count, 1);
	outline->verbs[outline->verb_count++] = verb;
	for (int i = 0; i < 2 * count; i++) {
		const FT_Pos twice = i % 2 ? points[i / 2]->y : points[i / 2]->x;
		outline->points = grow(outline->points, outline->number_count, sizeof(double));
		outline->points[outline->number_count++] =
			(double)twice / 2 - outline->centre[i % 2];
	}
	return 0;
}

static int move_to(const FT_Vector *to, void *outline)
{
	return add(outline, EW_MOVE, &to, 1);
}

static int line_to(const FT_Vector *to, void *outline)
{
	return add(outline, EW_LINE, &to, 1);
}

static int quad_to(const FT_Vector *control, const FT_Vector *to, void *outline)
{
	return add(outline, EW_QUAD, (const FT_Vector *[]){ control, to }, 2);
}

static int cubic_to(const FT_Vector *a, const FT_Vector *b, const FT_Vector *to, void *outline)
{
	return add(outline, EW_CUBIC, (const FT_Vector *[]){ a, b, to }, 3);
}

/* FreeType closes every contour with a line. */
static void load(const Font *font, FT_UInt glyph, Outline *outline)
{
	static const FT_Outline_Funcs functions = { move_to, line_to, quad_to, cubic_to,
						    .shift = 1 };
	FT_Error error = FT_Load_Glyph(font->face, glyph, FT_LOAD_NO_SCALE);
	FT_GlyphSlot slot = font->face->glyph;
	outline->verb_count = outline->number_count = 0;
	if (!error && slot->format != FT_GLYPH_FORMAT_OUTLINE)
		fail("%s: glyph %u is no outline", font->file, glyph);
	if (!error) {
		FT_BBox box;
		FT_Outline_Get_CBox(&slot->outline, &box);
		outline->centre[0] = (double)((box.xMin + box.xMax) / 2);
		outline->centre[1] = (double)((box.yMin + box.yMax) / 2);
		error = FT_Outline_Decompose(&slot->outline, &functions, outline);
	}
	if (error)
		fail("%s: glyph %u is damaged: FreeType's error 0x%02x", font->file, glyph,
		     (unsigned)error);
}

/* ---- which glyphs ---- */

/* Writes at most strlen(text) glyphs; returns how many. */
static size_t select_characters(const Font *font, const char *text, FT_UInt *glyphs)
{
	size_t count = 0;
	if (!font->face->charmap)
		fail("%s has no table of Unicode characters; use --all", font->file);
	for (const char *p = text; *p;) {
		const size_t place = (size_t)(p - text);
		const long code = take_character(&p);
		if (code < 0)
			fail("the characters are not UTF-8 at byte %zu", place + 1);
		glyphs[count] = FT_Get_Char_Index(font->face, (FT_ULong)code);
		if (!glyphs[count++])
			fail("%s has no glyph for U+%04lX", font->file, code);
	}
	return count;
}

/* ---- measuring ---- */

/* x if it can be divided by, else a NaN. */
static double divisor(double x)
{
	return x != 0 ? x : NAN;
}

/* As fontTools: counterclockwise is positive. PostScript fills such contours, TrueType clockwise
 * ones, so the areas of TrueType glyphs are negative. All other numbers are quotients of integrals
 * and do not turn their sign; variances are negative only where contours overlap in odd ways, and
 * then so are the deviations. Without area everything is 0: area is a multiple of AREA_STEP, and
 * its error far below half of that. (fontTools sets slants and correlations below 1/1000 to 0.) */
static void measure(const Outline *outline, double moments[MOMENTS], double out[STATISTICS])
{
	const int status = ew_path_moments(DEGREE, outline->verbs, outline->verb_count,
					   outline->points, outline->number_count / 2, NULL, 0,
					   moments);
	if (status != EW_OK)
		fail("ew_path_moments returns %d", status);
	const double area = moments[EW_INDEX(0, 0)];
	memset(out, 0, STATISTICS * sizeof *out);
	if (fabs(area) < AREA_STEP / 2)
		return;
	const double x = moments[EW_INDEX(1, 0)] / area, y = moments[EW_INDEX(0, 1)] / area;
	out[AREA] = area;
	out[MEAN_X] = outline->centre[0] + x;
	out[MEAN_Y] = outline->centre[1] + y;
	out[VARIANCE_X] = moments[EW_INDEX(2, 0)] / area - x * x;
	out[VARIANCE_Y] = moments[EW_INDEX(0, 2)] / area - y * y;
	out[STDDEV_X] = copysign(sqrt(fabs(out[VARIANCE_X])), out[VARIANCE_X]);
	out[STDDEV_Y] = copysign(sqrt(fabs(out[VARIANCE_Y])), out[VARIANCE_Y]);
	out[COVARIANCE] = moments[EW_INDEX(1, 1)] / area - x * y;
	out[CORRELATION] = out[COVARIANCE] / divisor(out[STDDEV_X] * out[STDDEV_Y]);
	out[SLANT] = out[COVARIANCE] / divisor(out[VARIANCE_Y]);
}

/* ---- printing ---- */

/* The name with all but printable ASCII replaced. */
static void end_with_name(const Font *font, FT_UInt glyph)
{
	char name[LONGEST_NAME] = "";
	if (FT_HAS_GLYPH_NAMES(font->face))
		FT_Get_Glyph_Name(font->face, glyph, name, sizeof name);
	for (char *p = name; *p; p++)
		*p = *p > ' ' && *p <= '~' ? *p : '?';
	puts(name[0] ? name : "-");
}

static const char *code_name(const Font *font, FT_UInt glyph, char text[16])
{
	snprintf(text, 16, font->codes[glyph] ? "U+%04lX" : "-", font->codes[glyph]);
	return text;
}

static void print_heading(void)
{
	printf("%5s %8s", "glyph", "code");
	for (int i = 0; i < STATISTICS; i++)
		printf(" %*s", columns[i].width, columns[i].name);
	puts("  name");
}

static void print_row(const Font *font, FT_UInt glyph, const double statistics[STATISTICS])
{
	char text[16];
	printf("%5u %8s", glyph, code_name(font, glyph, text));
	for (int i = 0; i < STATISTICS; i++) {
		const bool is_zero = fabs(statistics[i]) < 0.5 * pow(10, -columns[i].decimals);
		printf(" %*.*f", columns[i].width, columns[i].decimals,
		       is_zero ? 0 : statistics[i]); /* not -0.00 */
	}
	fputs("  ", stdout);
	end_with_name(font, glyph);
}

static void print_numbers(const char *word, const double *values, int count)
{
	fputs(word, stdout);
	for (int i = 0; i < count; i++)
		printf(" %a", values[i]);
	putchar('\n');
}

/* What the row was made from, every bit of it, for programs. */
static void print_exact(const Font *font, FT_UInt glyph, const Outline *outline,
			const double moments[MOMENTS], const double statistics[STATISTICS])
{
	static const char *const names[] = { [EW_MOVE] = "move", [EW_LINE] = "line",
					     [EW_QUAD] = "quad", [EW_CUBIC] = "cubic" };
	static const int points[] = { [EW_MOVE] = 1, [EW_LINE] = 1, [EW_QUAD] = 2, [EW_CUBIC] = 3 };
	char text[16];
	printf("glyph %u %s ", glyph, code_name(font, glyph, text));
	end_with_name(font, glyph);
	printf("outline %zu\n", outline->verb_count);
	const double *p = outline->points;
	for (size_t i = 0; i < outline->verb_count; i++) {
		fputs(names[outline->verbs[i]], stdout);
		for (int k = 0; k < 2 * points[outline->verbs[i]]; k++)
			printf(" %.17g", *p++ + outline->centre[k % 2]);
		putchar('\n');
	}
	printf("centre %.17g %.17g\n", outline->centre[0], outline->centre[1]);
	print_numbers("moments", moments, MOMENTS);
	print_numbers("statistics", statistics, STATISTICS);
}

static void print_glyphs(const Font *font, const FT_UInt *glyphs, size_t count, bool exact)
{
	Outline outline = { 0 };
	double moments[MOMENTS], statistics[STATISTICS];
	if (!exact)
		print_heading();
	for (size_t i = 0; i < count; i++) {
		load(font, glyphs[i], &outline);
		measure(&outline, moments, statistics);
		if (exact)
			print_exact(font, glyphs[i], &outline, moments, statistics);
		else
			print_row(font, glyphs[i], statistics);
	}
	free(outline.verbs);
	free(outline.points);
}

/* ---- command line ---- */

static int finish(void)
{
	if (fflush(stdout) || ferror(stdout))
		fail("cannot write standard output: %s", strerror(errno));
	return 0;
}

static int usage(FILE *stream)
{
	fputs("usage: glyphs [--exact] FONT [CHARACTERS | --all]\n"
	      "Prints one line for each of CHARACTERS (default: A to Z, a to z, 0 to 9), or\n"
	      "for each glyph of FONT: number, character, area, centroid, second moments about\n"
	      "the centroid over the area, deviations, correlation and slant, in font units,\n"
	      "and the name; - is none. Signs are those of fontTools' StatisticsPen:\n"
	      "counterclockwise is positive, so areas are negative in TrueType fonts and\n"
	      "positive in PostScript fonts.\n"
	      "--exact prints, for programs, outlines in decimal, moments 1 x y xx xy yy\n"
	      "about a centre and the statistics in hexadecimal. -- ends the options.\n",
	      stream);
	return stream == stderr ? 2 : finish();
}

int main(int argc, char **argv)
{
	bool all = false, exact = false, options = true;
	int count = 0;
	for (int i = 1; i < argc; i++) {
		const bool option = options && argv[i][0] == '-' && argv[i][1];
		if (!option)
			argv[count++] = argv[i];
		else if (!strcmp(argv[i], "--"))
			options = false;
		else if (!strcmp(argv[i], "--all"))
			all = true;
		else if (!strcmp(argv[i], "--exact"))
			exact = true;
		else
			return usage(strcmp(argv[i], "--help") ? stderr : stdout);
	}
	if (count < 1 || count + all > 2)
		return usage(stderr);
	Font font;
	open_font(&font, argv[0]);
	const char *text = count > 1 ? argv[1] : default_characters;
	size_t glyph_count = all ? (size_t)font.face->num_glyphs : strlen(text);
	FT_UInt *glyphs = allocate(glyph_count, sizeof *glyphs);
	for (size_t i = 0; all && i < glyph_count; i++)
		glyphs[i] = (FT_UInt)i;
	if (!all)
		glyph_count = select_characters(&font, text, glyphs);
	print_glyphs(&font, glyphs, glyph_count, exact);
	free(glyphs);
	free(font.codes);
	FT_Done_FreeType(font.library); /* and with it the face */
	return finish();
}

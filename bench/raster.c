/* raster.c - the exact coverage of every pixel, against rasterisers of other libraries.
 *
 * The same polygons for everybody, glyphs first: their lines, not their curves, except where it
 * says so. Here stand the sets with their bars; the files of raster.h do the rest. */
#include "raster.h"

#include <stdio.h>

#define TOLERANCE (1 / 16.)    /* of lines in place of curves, in pixels */
#define NO ((double)NAN)

enum { LARGE = 1024, FEWER = 4 };      /* from such glyphs on, every fourth character */

typedef enum { GLYPHS, SMOOTH, STAR } Kind;

/* Ratios to FreeType: u8 and f32 on avx512, u8 and f32 on avx2. The error is in 1e-6. */
static const struct { Kind kind; int size, edges; double bar[GOALS], error; } sets[] = {
	{ GLYPHS, 16, 0, { 1.7, 1.7, 1.5, 1.5 }, 2 },
	{ GLYPHS, 32, 0, { 2.1, 2.1, 1.5, 1.5 }, 2 },
	{ GLYPHS, 64, 0, { 2.1, 2.1, 1.5, 1.5 }, 2 },
	{ GLYPHS, 128, 0, { 3, 3, 1.5, 1.5 }, 2 },
	{ GLYPHS, 256, 0, { 2.2, 2.2, 1.5, 1.5 }, 2 },
	{ GLYPHS, 512, 0, { 1.1, NO, NO, NO }, 2 },
	{ GLYPHS, 1024, 0, { 1.1, NO, NO, NO }, 2 },
	{ GLYPHS, 2048, 0, { 1.1, NO, NO, NO }, 2 },
	{ SMOOTH, 1024, 1000, { 1.1, NO, NO, NO }, 2 },
	{ SMOOTH, 1024, 10000, { 1.1, NO, NO, NO }, 10 },
	{ SMOOTH, 1024, 100000, { NO, NO, NO, NO }, 10 },
	{ SMOOTH, 2048, 1000, { 1.1, NO, NO, NO }, 2 },
	{ SMOOTH, 2048, 10000, { 1.1, NO, NO, NO }, 10 },
	{ SMOOTH, 2048, 100000, { NO, NO, NO, NO }, 10 },
	{ STAR, 1024, 1000, { NO, NO, NO, NO }, 2 },
};
enum { SETS = (int)(sizeof sets / sizeof *sets) };

static Set make_set(int s)
{
	switch (sets[s].kind) {
	case GLYPHS:
		return glyphs_make(sets[s].size, 0, TOLERANCE, sets[s].size < LARGE ? 1 : FEWER);
	case SMOOTH:
		return smooth_make(sets[s].edges, sets[s].size);
	default:
		return star_make(sets[s].edges, sets[s].size);
	}
}

static void chart_glyphs(const Field *field, int size, const Drawn *o)
{
	raster_chart_point(CHART_U8, size, o->ratio[trial_widest(field, BYTES)]);
	raster_chart_point(CHART_F32, size, o->ratio[trial_widest(field, FLOATS)]);
	raster_chart_point(CHART_CAIRO, size, o->ratio[cairo]);
	raster_chart_point(CHART_AGG, size, o->ratio[AGG]);
	raster_chart_point(CHART_STB, size, o->ratio[stb]);
}

void section_raster(const Effort *effort)
{
	static Drawn drawn[SETS];
	const Field field = field_here();
	int count = 0, absent = 0;
	for (int p = 0; p < PAINTER_COUNT; ++p)
		if (!painters[p]->prepare)
			printf("%sskip %s: not installed (make deps-bench)\n",
				absent++ ? "" : "\n", painter_names[p]);
	for (int s = 0; s < SETS; ++s) {
		Set set = make_set(s);
		if (set.count > 0) {
			contest_hold(&field, set, &drawn[count], effort);
			drawn[count].bar = sets[s].bar;
			drawn[count].error_bar = sets[s].error;
			if (sets[s].kind == GLYPHS)
				chart_glyphs(&field, sets[s].size, &drawn[count]);
			++count;
		}
		set_free(&set);
	}
	if (count < SETS)
		printf("skip glyphs: no FreeType, or no DejaVuSans (make deps, make deps-bench)\n");
	raster_tables(&field, drawn, count);
	filters_table(effort);
	windows_table(effort);
	deposits_table(effort);
}

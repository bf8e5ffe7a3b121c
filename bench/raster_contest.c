/* raster_contest.c - everybody draws one set of polygons, in the same rounds.
 *
 * First the pixels of each are held against the exact ones, then all are timed. Glyphs are drawn
 * in turn, and small ones once more in another race, each several times in a row: FreeType, which
 * branches on every cell, is up to 1.6 times as fast at a glyph that it has just drawn.
 *
 * A trial is a painter, or one of our functions on a target; the trials of a field are numbered
 * once and for all, whoever is there. */
#include "raster.h"

#include <stdlib.h>
#include <string.h>

/* Of images larger than FINE, and of curves, a SAMPLE of a set is held against exact ones; smaller
 * images are drawn once more, each so many times in a row. */
enum { FINE = 256, SAMPLE = 12, AGAIN = 8 };

#define REFINED 1e-6           /* of lines in place of curves, in pixels */
#define NO ((double)NAN)

#define PAINTER_NAME(name) #name,
#define PAINTER_OBJECT(name) &painter_##name,
const char *const painter_names[PAINTER_COUNT] = { PAINTERS(PAINTER_NAME) };
const Painter *const painters[PAINTER_COUNT] = { PAINTERS(PAINTER_OBJECT) };

/* ---- trials ---- */

const Way every_way[KINDS] = {
	{ TO_BYTES, FLOAT, "u8" }, { TO_FLOATS, FLOAT, "f32" },
	/* On the widest target only: */
	{ TO_BYTES, DOUBLE, "u8" }, { TO_FLOATS, DOUBLE, "f32" }, { CURVES, FLOAT, "curves" },
};
Field field_here(void)
{
	Field field;
	field.targets = targets_here(field.target);
	field.trials = PAINTER_COUNT + 2 * field.targets + KINDS - BYTES_D;
	return field;
}

int trial_of(const Field *field, int kind, int target)
{
	const int first = PAINTER_COUNT + (kind < BYTES_D ? kind : 2) * field->targets;
	return kind < BYTES_D ? first + target : first + kind - BYTES_D;
}

int trial_widest(const Field *field, int kind)
{
	return trial_of(field, kind, field->targets - 1);
}

int trial_on(const Field *field, int kind, unsigned target)
{
	for (int t = 0; t < field->targets; ++t)
		if (field->target[t]->bit == target)
			return trial_of(field, kind, t);
	return -1;
}

const Goal goals[GOALS] = {
	{ "u8, avx512", BYTES, EW_AVX512 }, { "f32, avx512", FLOATS, EW_AVX512 },
	{ "u8, avx2", BYTES, EW_AVX2 }, { "f32, avx2", FLOATS, EW_AVX2 },
};

/* ---- one set ---- */

typedef struct {
	const Field *field;
	Set set;
	Pixels pixels;
	PaintJob paint[PAINTER_COUNT];
	DrawJob draw[MOST_TRIALS];     /* those of ours */
} Contest;

static void begin_contest(Contest *c, Drawn *drawn)
{
	const Field *field = c->field;
	for (int p = 0; p < PAINTER_COUNT; ++p)
		drawn->there[p] = paint_begin(&c->paint[p], painters[p], &c->set, c->pixels);
	for (int kind = 0; kind < KINDS; ++kind)
		for (int t = kind < BYTES_D ? 0 : field->targets - 1; t < field->targets; ++t) {
			const int trial = trial_of(field, kind, t);
			c->draw[trial] = (DrawJob){ every_way[kind].how, every_way[kind].precision,
				field->target[t]->bit, &ew_filter_box, &c->set, c->pixels, 1 };
			drawn->there[trial] = every_way[kind].how != CURVES
				|| c->set.drawing[0].verb;
		}
}

static void end_contest(Contest *c, const Drawn *drawn)
{
	for (int p = 0; p < PAINTER_COUNT; ++p)
		if (drawn->there[p])
			paint_end(&c->paint[p]);
	pixels_free(&c->pixels);
}

/* The pixels of one drawing, against the exact ones. */
static double error_of(const Contest *c, int trial, int number, const double *exact)
{
	const Drawing *drawing = &c->set.drawing[number];
	pixels_spoil(c->pixels, &drawing->scene);
	if (trial < PAINTER_COUNT)
		c->paint[trial].painter->draw(c->paint[trial].picture[number]);
	else
		draw_one(&c->draw[trial], drawing);
	return trial < PAINTER_COUNT || c->draw[trial].how == TO_BYTES
		? worst_byte(&drawing->scene, c->pixels.bytes, exact)
		: worst_float(&drawing->scene, c->pixels.floats, exact);
}

/* Of every drawing, or of some if they are large. */
static void find_errors(const Contest *c, Drawn *drawn)
{
	const int paths = trial_widest(c->field, PATHS), some = 1 + (c->set.count - 1) / SAMPLE;
	for (int i = 0; i < c->set.count; i += c->set.size > FINE ? some : 1) {
		double *exact = exact_image(&c->set.drawing[i].scene, EXACT_BOX);
		for (int trial = 0; trial < c->field->trials; ++trial)
			if (drawn->there[trial] && trial != paths)
				drawn->error[trial] = fmax(drawn->error[trial],
					error_of(c, trial, i, exact));
		free(exact);
	}
	for (int i = 0; i < c->set.count && drawn->there[paths]; i += some) {
		Drawing refined = drawing_refined(&c->set.drawing[i], REFINED);
		double *exact = exact_image(&refined.scene, EXACT_BOX);
		drawn->error[paths] = fmax(drawn->error[paths], error_of(c, paths, i, exact));
		free(exact);
		drawing_free(&refined);
	}
}

/* FreeType first, then what its ratios are for, then the others. */
static void run_contest(const Contest *c, Drawn *drawn, int rounds)
{
	int number[MOST_TRIALS];
	Race race = race_new(rounds);
	for (int i = 0; i < c->field->trials; ++i) {
		const int others = PAINTER_COUNT - 1, ours = c->field->trials - PAINTER_COUNT;
		const int trial = i == 0 ? FreeType : i <= ours ? i + others : i - ours;
		if (drawn->there[trial])
			number[trial] = trial < PAINTER_COUNT
				? race_add(&race, paint_run, &c->paint[trial], c->set.count)
				: race_add(&race, draw_run, &c->draw[trial], c->set.count);
	}
	race_run(&race);
	for (int trial = 0; trial < c->field->trials; ++trial) {
		const int there = drawn->there[trial];
		drawn->median[trial] = there ? race_median(&race, number[trial]) : NO;
		drawn->least[trial] = there ? race_minimum(&race, number[trial]) : NO;
		drawn->ratio[trial] = there && drawn->there[FreeType]
			? race_ratio(&race, number[FreeType], number[trial]) : NO;
		if (!there)
			drawn->error[trial] = NO;
	}
	race_free(&race);
}

static void run_again(const Contest *c, Drawn *drawn, int rounds)
{
	PaintJob paint = c->paint[FreeType];
	DrawJob draw[GOALS];
	int number[GOALS];
	Race race = race_new(rounds);
	paint.times = AGAIN;
	race_add(&race, paint_run, &paint, c->set.count * AGAIN);
	for (int g = 0; g < GOALS; ++g) {
		const int trial = trial_on(c->field, goals[g].kind, goals[g].target);
		if (trial < 0)
			continue;
		draw[g] = c->draw[trial];
		draw[g].times = AGAIN;
		number[g] = race_add(&race, draw_run, &draw[g], c->set.count * AGAIN);
	}
	race_run(&race);
	for (int g = 0; g < GOALS; ++g)
		if (trial_on(c->field, goals[g].kind, goals[g].target) >= 0)
			drawn->again[g] = race_ratio(&race, 0, number[g]);
	race_free(&race);
}

void contest_hold(const Field *field, Set set, Drawn *drawn, const Effort *effort)
{
	Contest c = { .field = field, .set = set, .pixels = pixels_new(&set) };
	memset(drawn, 0, sizeof *drawn);
	memcpy(drawn->name, set.name, sizeof set.name);
	drawn->pixels = set.pixels;
	for (int g = 0; g < GOALS; ++g)
		drawn->again[g] = NO;
	begin_contest(&c, drawn);
	find_errors(&c, drawn);
	run_contest(&c, drawn, set.size > 2 * FINE ? (effort->long_rounds + 2) / 3
		: set.size > FINE / 2 ? effort->long_rounds : effort->rounds);
	if (drawn->there[FreeType] && set.count > 1 && set.size <= FINE)
		run_again(&c, drawn, effort->long_rounds);
	end_contest(&c, drawn);
}

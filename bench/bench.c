/* bench.c - Edgewise against the limits of this machine and against its peers, in one run.
 *
 * Each section answers one question and prints its tables, with the bar that must be held beside
 * the figure that was measured. The other files: bench.h. Run it on an idle machine; a noisy one
 * shows in the distance between median and minimum. */
#include "bench.h"

#include <stdio.h>
#include <string.h>

static const struct { const char *name; void (*run)(const Effort *effort); } sections[] = {
	{ "machine", section_machine }, { "kernels", section_kernels }, { "order", section_order },
	{ "schemes", section_schemes }, { "trust", section_trust }, { "streams", section_streams },
	{ "batches", section_batches }, { "contest", section_contest }, { "curves", section_curves },
	{ "raster", section_raster },
};
enum { SECTIONS = (int)(sizeof sections / sizeof *sections) };

typedef struct { int quick; const char *only, *json, *svg, *svg_raster; } Options;

static int usage(FILE *out, int status)
{
	fprintf(out, "usage: bench [--quick] [--only SECTION] [--json FILE] [--svg FILE] "
		"[--svg-raster FILE]\n"
		"  --quick            few rounds, to see that everything runs\n"
		"  --only SECTION     one of:");
	for (int i = 0; i < SECTIONS; ++i)
		fprintf(out, " %s", sections[i].name);
	fprintf(out, "\n  --json FILE        all figures\n"
		"  --svg FILE         plot of slots per edge against their limit; needs "
		"the kernels\n"
		"  --svg-raster FILE  plot of times FreeType's speed over the size of glyphs; "
		"needs the raster\n");
	return status;
}

static int known_section(const char *name)
{
	for (int i = 0; i < SECTIONS; ++i)
		if (strcmp(name, sections[i].name) == 0)
			return 1;
	return 0;
}

/* 0 if the command line is wrong. */
static int read_options(Options *o, char **argument)
{
	for (; *argument; ++argument) {
		const char **place = strcmp(*argument, "--only") == 0 ? &o->only
			: strcmp(*argument, "--json") == 0 ? &o->json
			: strcmp(*argument, "--svg") == 0 ? &o->svg
			: strcmp(*argument, "--svg-raster") == 0 ? &o->svg_raster : NULL;
		if (strcmp(*argument, "--quick") == 0)
			o->quick = 1;
		else if (place && argument[1])
			*place = *++argument;
		else
			return 0;
	}
	if (o->only && !known_section(o->only))
		return 0;
	return !(o->svg && o->only && strcmp(o->only, "kernels") != 0)
		&& !(o->svg_raster && o->only && strcmp(o->only, "raster") != 0);
}

static int written(int good, const char *file)
{
	if (!good)
		fprintf(stderr, "bench: cannot write %s\n", file);
	return good;
}

int main(int argc, char **argv)
{
	Options o = { 0, NULL, NULL, NULL, NULL };
	if (argc == 2 && strcmp(argv[1], "--help") == 0)
		return usage(stdout, 0);
	if (!read_options(&o, argv + (argc > 0)))
		return usage(stderr, 2);
	const Effort effort = o.quick ? (Effort){ 5, 3 } : (Effort){ 101, 31 };
	printf("edgewise %s, compiler %s; interleaved rounds: %d in cache, %d from memory%s\n",
		ew_version(), __VERSION__, effort.rounds, effort.long_rounds,
		o.quick ? " (--quick: not for figures)" : "");
	for (int i = 0; i < SECTIONS; ++i)
		if (!o.only || strcmp(o.only, sections[i].name) == 0)
			sections[i].run(&effort);
	tables_summary();
	int good = 1;
	if (o.json)
		good &= written(tables_json(o.json, o.quick), o.json);
	if (o.svg)
		good &= written(chart_write(o.svg), o.svg);
	if (o.svg_raster)
		good &= written(raster_chart_write(o.svg_raster), o.svg_raster);
	return good ? 0 : 1;
}

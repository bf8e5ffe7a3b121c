/* main.c - options, and the pipeline as a list of calls. */
#include "gen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
	Request request;
	Delivery delivery;
	const char *single_header, *manifest, *depfile, *show, *format, *dump;
	const char *emission, *writing;   /* an option given that is for an emission; that writes */
	unsigned seen;                               /* bits of the grammar options given */
	int runtime, list;
} Options;

static const char *const PRECISIONS[] = { "double", "float" };

static const char USAGE[] =
	"usage: gen [OPTION]...\n"
	"\n"
	"Emits C code for exact integrals over regions, as sums over the edges of their "
	"boundaries.\n"
	"\n"
	"what to emit (nothing asked: the library with all moments to degree 4)\n"
	"  --max-degree N         the library with all moments x^m y^n, m + n <= N (0..32)\n"
	"  --families LIST        only these: moments,curves,distance,closure,coverage,filters\n"
	"                         (curves brings moments)\n"
	"  --monomial xMyN        one monomial (repeatable)\n"
	"  --polynomial NAME=EXPR a polynomial in x and y, such as soft='(1-x)*(1-y)' "
	"(repeatable)\n"
	"  --filter FILTER        a built-in filter, such as mitchell, or a filter file "
	"(repeatable)\n"
	"  --edges LIST           line,quad,conic,cubic (default: all; of monomials: line)\n"
	"  --precision LIST       double,float (default: both)\n"
	"  --targets LIST         portable,fma,avx2,avx512,neon,wasm128 (default: all; portable "
	"always)\n"
	"  --scheme NAME          how rings are evaluated, where that scheme applies "
	"(default: the cheapest)\n"
	"  --prefix NAME          every symbol, macro and file name starts with NAME instead of "
	"ew, edgewise\n"
	"where to\n"
	"  --out DIR              folder to write, self-contained, `cc -c *.c` is enough "
	"(default: generated)\n"
	"  --no-runtime           kernels and header only\n"
	"  --single-header FILE   one file, stb style, instead of a folder\n"
	"  --manifest FILE        machine-readable list of kernels, operation counts and error "
	"bounds (JSON)\n"
	"  --depfile FILE         make-style dependencies, for CMake, Ninja and Meson\n"
	"  --check                write nothing; exit 1 and a list if DIR differs from what would "
	"be written\n"
	"  --dry-run              write nothing; list what would be written\n"
	"other\n"
	"  --show xMyN            the coefficient matrix of a monomial\n"
	"  --show FILTER          the pieces of a filter and what holds of it (FILTER: built-in, "
	"or a path with . or /)\n"
	"  --format FORMAT        of --show: text, json; of monomials latex, c too (default: "
	"text)\n"
	"  -d LETTERS             dump after passes: p polynomials, d dag, f fused, s schedule; "
	"nothing is written\n"
	"  --list                 families, edges, targets, precisions, schemes and built-in "
	"filters\n"
	"  --quiet, --verbose     say nothing, or name every file\n"
	"  --help, --version\n"
	"\n"
	"Exit status: 0 done, 1 --check found a difference or output could not be written, "
	"2 bad input.\n";

/* ---- options ---- */

static void set_once(const char **place, const char *option, const char *value)
{
	if (*place)
		fatal(EXIT_USAGE, "%s is given twice", option);
	if (!*value)
		fatal(EXIT_USAGE, "%s needs a value that is not empty", option);
	*place = value;
}

/* A copy of a list with room for one more. */
static void *longer(const void *list, int count, size_t size)
{
	void *copy = allocate((size_t)(count + 1) * size);
	return count ? memcpy(copy, list, (size_t)count * size) : copy;
}

static void add_integrand(Integrand **list, int *count, Integrand integrand)
{
	*list = longer(*list, *count, sizeof **list);
	(*list)[(*count)++] = integrand;
}

static void add_filter(Request *request, Filter filter)
{
	request->filter = longer(request->filter, request->filters, sizeof *request->filter);
	request->filter[request->filters++] = filter;
}

/* Options without a value; 0 if it is none of them. */
static int read_switch(Options *o, const char *option)
{
	const struct { const char *name; int *place, value; } switches[] = {
		{ "--no-runtime", &o->runtime, 0 }, { "--check", &o->delivery.check, 1 },
		{ "--dry-run", &o->delivery.dry_run, 1 }, { "--quiet", &o->delivery.quiet, 1 },
		{ "--verbose", &o->delivery.verbose, 1 }, { "--list", &o->list, 1 },
	};
	for (int i = 0; i < LENGTH(switches); ++i)
		if (strcmp(option, switches[i].name) == 0) {
			*switches[i].place = switches[i].value;
			if (i < 3)
				o->emission = o->writing = switches[i].name;
			return 1;
		}
	return 0;
}

/* Options with a text of their own. */
static int read_text(Options *o, const char *option, const char *value)
{
	const struct { const char *name; const char **place; int emits; } texts[] = {
		{ "--out", &o->delivery.out, 1 }, { "--single-header", &o->single_header, 1 },
		{ "--manifest", &o->manifest, 1 }, { "--depfile", &o->depfile, 1 },
		{ "--prefix", &o->request.prefix, 1 }, { "--show", &o->show, 0 },
		{ "--format", &o->format, 0 }, { "-d", &o->dump, 0 },
	};
	for (int i = 0; i < LENGTH(texts); ++i)
		if (strcmp(option, texts[i].name) == 0) {
			if (value)
				set_once(texts[i].place, option, value);
			if (texts[i].emits)
				o->emission = texts[i].name;
			if (texts[i].emits && texts[i].place != &o->request.prefix)
				o->writing = texts[i].name;
			return 1;
		}
	return 0;
}

static int schemes(void)
{
	int count = 0;
	while (scheme_names()[count])
		++count;
	return count;
}

/* Options with a grammar; with `value` NULL it only says whether the option is one of them. */
static int read_request(Options *o, const char *option, const char *value)
{
	static const char *const names[] = { "--max-degree", "--families", "--monomial",
		"--polynomial", "--precision", "--targets", "--scheme", "--edges",
		"--filter" };
	Request *request = &o->request;
	int which = 0;
	while (which < LENGTH(names) && strcmp(option, names[which]) != 0)
		++which;
	if (which == LENGTH(names))
		return 0;
	if (!value)
		return 1;
	o->emission = names[which];
	int repeatable = which == 2 || which == 3 || which == 8;
	if (o->seen & 1u << which && !repeatable)
		fatal(EXIT_USAGE, "%s is given twice", option);
	o->seen |= 1u << which;
	switch (which) {
	case 0:
		request->moments = spec_degree(value);
		break;
	case 1:
		request->families = spec_list(option, value, family_names, FAMILIES);
		break;
	case 2:
		add_integrand(&request->monomial, &request->monomials, spec_monomial(value));
		break;
	case 3:
		add_integrand(&request->polynomial, &request->polynomials, spec_polynomial(value));
		break;
	case 4:
		request->precisions = spec_list(option, value, PRECISIONS, LENGTH(PRECISIONS));
		break;
	case 5:
		request->targets = spec_list(option, value, target_names, TARGETS);
		break;
	case 6:
		if (strchr(value, ','))
			fatal(EXIT_USAGE, "--scheme takes one word, not '%s'", value);
		spec_list(option, value, scheme_names(), schemes());
		request->scheme = value;
		break;
	case 7:
		request->edges = spec_list(option, value, edge_names, EDGES);
		break;
	case 8:
		add_filter(request, filter_read(value));
		break;
	}
	return 1;
}

static void print_and_exit(const char *text)
{
	fputs(text, stdout);
	if (fflush(stdout) != 0)
		fatal(EXIT_DIFFERENT, "cannot write to standard output");
	exit(EXIT_DONE);
}

static Options read_options(char **argv)
{
	Options o = { .request = { .moments = -1, .precisions = PRECISION_DOUBLE | PRECISION_FLOAT,
		.targets = ALL_TARGETS }, .runtime = 1 };
	while (*++argv) {
		const char *option = *argv, *equals = NULL;
		if (strncmp(option, "--", 2) == 0)
			equals = strchr(option, '=');
		if (equals)
			option = copy_string(option, (size_t)(equals - option));
		int help = strcmp(option, "--help") == 0;
		int version = strcmp(option, "--version") == 0;
		int is_switch = read_switch(&o, option);
		if ((is_switch || help || version) && equals)
			fatal(EXIT_USAGE, "%s takes no value", option);
		if (help || version)
			print_and_exit(help ? USAGE : "gen " GEN_VERSION "\n");
		if (is_switch)
			continue;
		if (!read_text(&o, option, NULL) && !read_request(&o, option, NULL))
			fatal(EXIT_USAGE, "unknown option '%s'; gen --help lists them", option);
		const char *value = equals ? equals + 1 : *++argv;
		if (!value)
			fatal(EXIT_USAGE, "%s needs a value; gen --help shows which", option);
		if (!read_text(&o, option, value))
			read_request(&o, option, value);
	}
	return o;
}

static void check_options(const Options *o)
{
	if ((o->show || o->list) && o->emission)
		fatal(EXIT_USAGE, "%s emits nothing; leave out %s", o->show ? "--show" : "--list",
			o->emission);
	if (o->show && o->list)
		fatal(EXIT_USAGE, "--show and --list exclude each other");
	if (o->dump && (o->writing || o->show || o->list))
		fatal(EXIT_USAGE, "-d prints and writes nothing; leave out %s",
			o->writing ? o->writing : o->show ? "--show" : "--list");
	if (o->format && !o->show)
		fatal(EXIT_USAGE, "--format goes with --show");
	if (o->single_header && (!o->runtime || o->delivery.out))
		fatal(EXIT_USAGE, "--single-header writes one file with the runtime in it; "
			"leave out %s", o->runtime ? "--out" : "--no-runtime");
	if (o->delivery.quiet && o->delivery.verbose)
		fatal(EXIT_USAGE, "--quiet and --verbose exclude each other");
	if (o->delivery.check && o->delivery.dry_run)
		fatal(EXIT_USAGE, "--check and --dry-run exclude each other");
	if (o->dump && strspn(o->dump, "pdfs") != strlen(o->dump))
		fatal(EXIT_USAGE, "-d: '%s' has a letter other than p, d, f, s", o->dump);
	if (o->request.prefix)
		spec_prefix(o->request.prefix);
}

/* ---- pipeline ---- */

static void show_progress(int done, int of)
{
	if (done < of)
		fprintf(stderr, "\rgen: kernel %d of %d", done + 1, of);
	else
		fprintf(stderr, "\r%40s\r", "");
}

static void no_progress(int done, int of)
{
	(void)done;
	(void)of;
}

static void print_text(Text *text)
{
	if ((text->size && fwrite(text->data, 1, text->size, stdout) != text->size)
	    || fflush(stdout) != 0)
		fatal(EXIT_DIFFERENT, "cannot write to standard output");
	text_free(text);
}

static void print_words(const char *title, const char *const *words, int count)
{
	printf("%s:", title);
	for (int i = 0; i < count; ++i)
		printf(" %s", words[i]);
	printf("\n");
}

static void print_list(void)
{
	print_words("families", family_names, FAMILIES);
	print_words("edges", edge_names, EDGES);
	print_words("targets", target_names, TARGETS);
	print_words("precisions", PRECISIONS, LENGTH(PRECISIONS));
	print_words("schemes", scheme_names(), schemes());
	printf("filters:\n");
	for (const char *const *name = filter_names(); *name; ++name) {
		Filter filter = filter_read(*name);
		printf("  %-12s %s\n", *name, filter_summary(&filter));
	}
}

static void show(const Options *o)
{
	Text text = { 0 };
	const char *format_name = o->format ? o->format : "text";
	if (filter_is_builtin(o->show) || strpbrk(o->show, "./")) {
		Filter filter = filter_read(o->show);
		filter_show(&text, &filter, format_name);
	} else {
		Integrand monomial = spec_monomial(o->show);
		emit_show(&text, &monomial, format_name);
	}
	print_text(&text);
}

/* What holds of the filters that --filter asked for. */
static char *describe_filters(const Request *request)
{
	Text text = { 0 };
	for (int i = 0; i < request->filters; ++i)
		filter_describe(&text, &request->filter[i]);
	return text_take(&text);
}

static void add_file(Files *files, const char *name, Text text)
{
	*file_new(files, name) = text;
}

static int emit(const Options *o)
{
	const Request *request = &o->request;
	Text dump = { 0 };
	int quiet = o->delivery.quiet || !isatty(STDERR_FILENO);
	Kernels kernels = build_kernels(request, quiet ? no_progress : show_progress, o->dump,
		&dump);
	if (o->dump) {
		print_text(&dump);
		return EXIT_DONE;
	}
	Files files = { 0 }, single = { 0 }, outputs = { 0 };
	emit_header(&files, request, &kernels);
	emit_list(&files, request, &kernels);
	emit_edges(&files, request, &kernels);
	if (spec_has_rings(request))
		emit_rings(&files, request, &kernels);
	emit_deposits(&files, request, &kernels);
	if (o->runtime && spec_has_rings(request))
		bundle_runtime(&files);
	bundle_rename(&files, request->prefix);
	Text manifest = bundle_manifest(&files, request, &kernels);
	Delivery how = o->delivery;
	how.manifest = bundle_name("edgewise_manifest.json", request->prefix);
	how.sources = spec_paths(request);
	if (o->single_header) {
		add_file(&single, o->single_header, bundle_single_header(&files, request));
		file_new(&outputs, o->single_header);
	} else {
		how.out = how.out ? how.out : "generated";
		add_file(&files, how.manifest, manifest);
		for (int i = 0; i < files.count; ++i)
			file_new(&outputs, format("%s/%s", how.out, files.file[i].name));
	}
	if (o->manifest)
		add_file(&single, o->manifest, manifest);
	else if (o->single_header)
		text_free(&manifest);
	if (o->depfile)
		add_file(&single, o->depfile, bundle_depfile(&outputs, request));
	return deliver(&files, &single, &how);
}

int main(int argc, char **argv)
{
	(void)argc;
	Options o = read_options(argv);
	check_options(&o);
	int status = EXIT_DONE;
	if (o.show) {
		show(&o);
	} else if (o.list) {
		print_list();
	} else {
		const Delivery *how = &o.delivery;
		const char *analysis = describe_filters(&o.request);
		spec_complete(&o.request);
		status = emit(&o);
		if (!o.dump && !how->quiet && !how->check && !how->dry_run)
			fputs(analysis, stdout);
	}
	if (fflush(stdout) != 0 || ferror(stdout))
		fatal(EXIT_DIFFERENT, "cannot write to standard output");
	return status;
}

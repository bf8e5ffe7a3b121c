/* emit_list.c - edgewise_kernels.h, the one list of kernels that feeds dispatch, tests and
 * benchmarks, and the manifest.
 *
 * No kernel can exist untested or undispatched: whoever needs "all kernels" expands one
 * of these X-macros. */
#include "gen.h"

#include <string.h>

static char *ring_id(const Ring *ring)
{
	return format("EW_RING_%s", emit_upper(ring->name));
}

static void add_lines(Text *text, const Request *request, const Kernels *kernels)
{
	for (int p = 0; p < precision_count; ++p) {
		int wanted = (request->precisions & precisions[p].bit) != 0;
		text_add(text, "\n/* X(m, n, symbol, k): single edges; |result - exact| <= gamma_k "
			"W */\n#define EW_LINES_%s(X)", emit_upper(precisions[p].real));
		for (int i = 0; i < kernels->edges && wanted; ++i) {
			const Edge *edge = &kernels->edge[i];
			if (edge->window == WINDOW_LINE && edge->what && edge->what->m >= 0)
				text_add(text, " \\\n\tX(%d, %d, ew_line_%s%s, %d)", edge->what->m,
					edge->what->n, edge->what->name, precisions[p].suffix,
					edge->bound.k);
		}
		text_add(text, "\n");
	}
}

static int has_monomials(const Kernels *kernels)
{
	for (int i = 0; i < kernels->rings; ++i)
		if (strcmp(kernels->ring[i].family, "monomial") == 0)
			return 1;
	return 0;
}

static void add_ids(Text *text, const Kernels *kernels)
{
	int accumulators = 1, outputs = 1;
	text_add(text, "\n/* X(id, family, m, n, accumulators, outputs, k, r): all that runs over "
		"rings. For n items in\n * L lanes |result - exact| <= gamma_K W "
		"with K = k + r (ceil(n/L) - 1) + log2 L; L is 1 for fewer than 24 vertices. */\n"
		"#define EW_RINGS(X)");
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		text_add(text, " \\\n\tX(%s, %s, %d, %d, %d, %d, %d, %d)", ring_id(ring),
			ring->family, ring->m, ring->n, ring->accumulators, ring->outputs,
			ring->worst.k, ring->worst.repeat);
		if (ring->accumulators > accumulators)
			accumulators = ring->accumulators;
		if (ring->outputs > outputs)
			outputs = ring->outputs;
	}
	text_add(text, "\n\nenum {\n");
	for (int i = 0; i < kernels->rings; ++i)
		text_add(text, "\t%s,\n", ring_id(&kernels->ring[i]));
	text_add(text, "\tEW_RINGS_COUNT,\n\tEW_MAX_ACCUMULATORS = %d,\n\tEW_MAX_OUTPUTS = %d\n"
		"};\n", accumulators, outputs);
	text_add(text, "\n/* X(id, window, turns, accumulators, outputs, finish): "
		"for the ring driver; "
		"window counts vertices */\n#define EW_RINGS_SHAPES(X)");
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		text_add(text, " \\\n\tX(%s, %d, %d, %d, %d, ew_ring_%s_finish)", ring_id(ring),
			window_planes(ring->window), ring->turns, ring->accumulators, ring->outputs,
			ring->name);
	}
	text_add(text, "\n\n/* X(m, n, id): single moments */\n%s#define EW_MONOMIALS(X)",
		has_monomials(kernels) ? "#define EW_HAS_MONOMIALS 1\n" : "");
	for (int i = 0; i < kernels->rings; ++i)
		if (strcmp(kernels->ring[i].family, "monomial") == 0)
			text_add(text, " \\\n\tX(%d, %d, %s)", kernels->ring[i].m,
				kernels->ring[i].n, ring_id(&kernels->ring[i]));
	text_add(text, "\n");
}

static const Ring *ring_named(const Kernels *kernels, const char *name)
{
	for (int i = 0; i < kernels->rings; ++i)
		if (strcmp(kernels->ring[i].name, name) == 0)
			return &kernels->ring[i];
	bug("no ring kernel for %s", name);
}

/* The kernels for degrees 0, 1, ... of each kind of edge: the next one that goes so far. */
static void add_kinds(Text *text, const Request *request, const Kernels *kernels)
{
	static const char *const kinds[] = { "line", "quad", "conic", "cubic" };
	if (request->curves < 0)
		return;
	text_add(text, "\n/* Kernels of edges one by one, for the moments to degree 0, 1, ... */\n");
	for (int i = 0; i < LENGTH(kinds); ++i) {
		if (!(request->edges & 1u << i))
			continue;
		text_add(text, "#define EW_IDS_%s", emit_upper(kinds[i]));
		for (int degree = 0; degree <= request->curves; ++degree) {
			const Ring *best = NULL;
			for (int k = kernels->rings - 1; k >= 0; --k) {
				const Ring *ring = &kernels->ring[k];
				const char *family = i == 0 && degree ? "moments" : kinds[i];
				if (strcmp(ring->family, family) == 0 && ring->m >= degree)
					best = ring;
			}
			text_add(text, "%s%s", degree == 0 ? " " : degree % 4 ? ", " : ", \\\n\t",
				ring_id(best));
		}
		text_add(text, "\n");
	}
}

static void add_bounds(Text *text, const Request *request, const Kernels *kernels)
{
	text_add(text, "\n/* X(k, r, products, wk, wr), for the moments to degree 0, 1, ...: k of "
		"each result, r and products\n * per item, k and r of their magnitudes */\n"
		"#define EW_BOUNDS(X)");
	for (int degree = 0; degree <= request->moments; ++degree) {
		const Ring *ring = ring_named(kernels, format("moments_%d", degree));
		const Ring *terms = ring_named(kernels, format("magnitudes_%d", degree));
		text_add(text, " \\\n\tX(ew_ring_%s_k, %d, %d, %d, %d)", ring->name,
			ring->worst.repeat, ring->portable[0].cost.fma, terms->worst.k,
			terms->worst.repeat);
	}
	text_add(text, "\n");
}

static void add_precision(Text *text, const Request *request, const Kernels *kernels,
	const Precision *precision)
{
	const char *real = emit_upper(precision->real);
	text_add(text, "\n/* X(function, id, edge, k): a polynomial over a ring, "
		"and over one edge with its k; %s */\n"
		"#define EW_POLYNOMIALS_%s(X)", precision->real, real);
	for (int i = 0; i < kernels->edges; ++i) {
		const Edge *edge = &kernels->edge[i];
		if (edge->what && edge->what->m < 0)
			text_add(text, " \\\n\tX(ew_%s%s, %s, ew_line_%s%s, %d)", edge->what->name,
				precision->suffix, ring_id(ring_named(kernels, edge->what->name)),
				edge->what->name, precision->suffix, edge->bound.k);
	}
	text_add(text, "\n");
	for (int t = 0; t < target_count; ++t) {
		if (!(request->targets & targets[t].bit))
			continue;
		text_add(text, "\n/* X(id, kernel, f, a): %s, %s; per item f on the FMA pipe, "
			"a additions */\n#define EW_RINGS_%s_%s(X)", targets[t].name,
			precision->real, emit_upper(targets[t].name), real);
		for (int i = 0; i < kernels->rings; ++i) {
			const Ring *ring = &kernels->ring[i];
			Count cost = emit_ring_program(ring, &targets[t],
				precision->is_float)->cost;
			text_add(text, " \\\n\tX(%s, ew_ring_%s%s_%s, %d, %d)", ring_id(ring),
				ring->name, precision->suffix, targets[t].name, cost.fma, cost.add);
		}
		text_add(text, "\n");
	}
}

/* How the batch kernels of low degrees call their items: EW_SUMS_n accumulators, and EW_NEXT_n for
 * column k of a block, with vertex (vx, vy) behind (px, py) and qy before that. */
static void add_items(Text *text, const Kernels *kernels)
{
	text_add(text, "\n/* Items of batch kernels, see edgewise_sides_template.h */\n");
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		if (!emit_has_item(ring))
			continue;
		text_add(text, "#define EW_SUMS_%d %d\n", ring->m, ring->accumulators);
		text_add(text, "#define EW_NEXT_%d(item, k) item(%s, cx, %s)\n", ring->m,
			ring->window == WINDOW_VERTEX ? "qy, px, vy" : "px, py, vx, vy",
			ring->turns == 1 ? "acc" : format("acc + (k) %% %d * %d",
				ring->turns, ring->accumulators / ring->turns));
	}
}

/* The public functions of each filter. */
static void add_filter_list(Text *text, const Request *request)
{
	for (int p = 0; p < precision_count; ++p) {
		text_add(text, "\n/* X(function, edge, id): a filter over a ring, and over one edge */\n"
			"#define EW_FILTERS_%s(X)", emit_upper(precisions[p].real));
		for (int i = 0; i < request->filters; ++i) {
			const char *name = request->filter[i].name, *suffix = precisions[p].suffix;
			text_add(text, " \\\n\tX(ew_%s%s, ew_line_%s%s, EW_RING_%s)", name, suffix, name,
				suffix, emit_upper(name));
		}
		text_add(text, "\n");
	}
}

/* The deposits of one target, and their declarations. */
static void add_deposits_of(Text *text, const Kernels *kernels, const Target *target)
{
	const char *name = emit_upper(target->name);
	text_add(text, "\n/* X(filter, kernel, f, a): deposits, %s; per piece f on the FMA pipe, "
		"a additions */\n#define EW_DEPOSITS_%s(X)", target->name, name);
	for (int i = 0; i < kernels->deposits; ++i) {
		const Deposited *d = &kernels->deposit[i];
		const Count cost = target->fused ? d->fused.cost : d->portable.cost;
		text_add(text, " \\\n\tX(ew_filter_%s, ew_deposit_%s_%s, %d, %d)", d->filter->name,
			d->filter->name, target->name, cost.fma, cost.add);
	}
	text_add(text, "\n#if %s\n#define EW_DECLARE(filter, kernel, f, a) ew_deposit kernel;\n"
		"EW_DEPOSITS_%s(EW_DECLARE)\n#undef EW_DECLARE\n#endif\n",
		target->guard ? target->guard : "1", name);
}

static void add_deposits(Text *text, const Request *request, const Kernels *kernels)
{
	if (!request->filters)
		return;
	text_add(text, "\n/* Piece i of an edge within a cell of the pixel grid moved by the corner of a "
		"filter, (x[i], y[i]) ->\n * (x[reach + i], y[reach + i]) relative to the cell, adds "
		"out[(r N + m) reach + i] units to row r <= N, column\n * m < N of a difference image, to be "
		"rounded to integers; but to row N/2 what is left of it, an integer, less the\n * other rows. "
		"Pieces up to a multiple of 16 are computed. */\n"
		"typedef void ew_deposit(const float *x, const float *y, size_t reach, size_t count, "
		"float *out);\n"
		"struct ew_filter {\n\tconst char *name;\n\tint size;        /* N, pixels per axis; 0: "
		"knots are not pixels apart */\n\tdouble first_x, first_y, last_x, last_y;   /* support, "
		"from the centre */\n\tdouble unit;     /* of the deposits */\n"
		"\tint ring;        /* its kernels over rings */\n"
		"\tew_deposit *deposit[%d];     /* by target, lowest bit first; NULL: not built */\n};\n",
		TARGETS);
	for (int t = 0; t < target_count && kernels->deposits; ++t)
		if (request->targets & targets[t].bit)
			add_deposits_of(text, kernels, &targets[t]);
}

/* The targets that the compiler builds, and what finishes the moments of rings side by side. */
static void add_targets(Text *text, const Request *request, const Kernels *kernels)
{
	Text all = { 0 };
	for (int t = 0; t < target_count; ++t) {
		const Target *target = &targets[t];
		const char *name = emit_upper(target->name);
		if (!(request->targets & target->bit))
			continue;
		text_add(text, "\n#if %s\n#define EW_TARGET_%s(X) X(%s, %s, %d)\n#else\n"
			"#define EW_TARGET_%s(X)\n#endif\n",
			target->guard ? target->guard : "1", name, name, target->name,
			target->vector ? target->vector->width[0] : 1, name);
		text_add(&all, " EW_TARGET_%s(X)", name);
		text_add(text, "/* X(id, finish): %s */\n#define EW_FINISHES_%s(X)", target->name,
			name);
		for (int i = 0; i < kernels->rings; ++i)
			if (emit_finishes_columns(&kernels->ring[i]))
				text_add(text, " \\\n\tX(%s, ew_ring_%s_finish%s%s)",
					ring_id(&kernels->ring[i]), kernels->ring[i].name,
					target->vector ? "_" : "",
					target->vector ? target->name : "");
		text_add(text, "\n");
	}
	text_add(text, "\n"
		"/* X(TARGET, target, doubles): the targets that this compiler builds, and doubles "
		"in a register */\n"
		"#define EW_TARGETS(X)%s\n", text_take(&all));
}

static void add_types(Text *text, const Request *request, const Kernels *kernels)
{
	text_add(text, "\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n"
		"/* Items 0 .. count-1; item i reads vertices i, i + reach, ... (the window), and "
		"lane l < step takes items l,\n * l + step, ... in order; added to "
		"sum[accumulator * L + lane], L = %d double, %d float.\n"
		" * One ring: reach 1, step L. As many rings as a register has lanes, side by "
		"side: reach and step that many.\n * With reach 1 and step 1 "
		"only lane 0 has a meaning. origin[lane]: abscissas of the local origins\n"
		" * (vertex form only). Results: finish(sums over all lanes, out). */\n",
		precisions[0].lanes, precisions[1].lanes);
	for (int p = 0; p < precision_count; ++p) {
		const char *real = precisions[p].real;
		if (request->precisions & precisions[p].bit)
			text_add(text, "typedef void ew_ring_run%s(const %s *x, const %s *y, "
				"const %s *origin,\n\tsize_t reach, size_t step, size_t count, %s *sum);\n",
				precisions[p].suffix, real, real, real, real);
	}
	for (int p = 0; p < precision_count; ++p) {
		const char *real = precisions[p].real, *suffix = precisions[p].suffix;
		if (request->precisions & precisions[p].bit)
			text_add(text, "/* from, or if fewer than width are left, pad: "
				"from[0 .. rest-1], then zeros. */\n"
				"static inline const %s *ew_ring_pad%s("
				"%s *pad, const %s *from, size_t rest, size_t width)\n{\n"
				"\tif (rest >= width)\n\t\treturn from;\n"
				"\tfor (size_t i = 0; i < width; ++i)\n"
				"\t\tpad[i] = i < rest ? from[i] : 0;\n"
				"\treturn pad;\n}\n", real, suffix, real, real);
	}
	text_add(text, "/* From sum[accumulator * stride] to out[output * stride]; those of a "
		"vector target take as many\n * neighbours as a register holds. */\n"
		"typedef void ew_ring_finish(const double *sum, double *out, size_t stride);\n\n"
		"#define EW_DECLARE(id, window, turns, accumulators, outputs, finish) "
		"ew_ring_finish finish;\n"
		"EW_RINGS_SHAPES(EW_DECLARE)\n#undef EW_DECLARE\n"
		"#define EW_DECLARE(k, r, products, wk, wr) extern const short k[];\n"
		"EW_BOUNDS(EW_DECLARE)\n#undef EW_DECLARE\n");
	for (int p = 0; p < precision_count; ++p)
		for (int t = 0; t < target_count; ++t) {
			const Target *target = &targets[t];
			if (!(request->targets & target->bit)
			    || !(request->precisions & precisions[p].bit))
				continue;
			if (target->guard)
				text_add(text, "#if %s\n", target->guard);
			text_add(text, "#define EW_DECLARE(id, kernel, f, a) "
				"ew_ring_run%s kernel;\nEW_RINGS_%s_%s(EW_DECLARE)\n"
				"#undef EW_DECLARE\n%s", precisions[p].suffix, emit_upper(target->name),
				emit_upper(precisions[p].real), target->guard ? "#endif\n" : "");
		}
	for (int t = 0; t < target_count; ++t)
		if (request->targets & targets[t].bit && targets[t].vector) {
			text_add(text, "#if %s\n#define EW_DECLARE(id, finish) "
				"ew_ring_finish finish;\nEW_FINISHES_%s(EW_DECLARE)\n"
				"#undef EW_DECLARE\n#endif\n", targets[t].guard,
				emit_upper(targets[t].name));
		}
	add_deposits(text, request, kernels);
	text_add(text, "\n#ifdef __cplusplus\n}\n#endif\n");
}

void emit_list(Files *files, const Request *request, const Kernels *kernels)
{
	const char *name = "edgewise_kernels.h";
	Text *text = file_new(files, name);
	emit_banner(text, name, "the list of kernels, for the runtime, tests and benchmarks; "
		"not for users", request);
	text_add(text, "#ifndef EDGEWISE_KERNELS_H\n#define EDGEWISE_KERNELS_H\n\n"
		"#include <stddef.h>\n");
	emit_environment(text, request);
	add_lines(text, request, kernels);
	add_ids(text, kernels);
	for (int p = 0; p < precision_count; ++p)
		if (request->precisions & precisions[p].bit)
			add_precision(text, request, kernels, &precisions[p]);
	add_filter_list(text, request);
	add_bounds(text, request, kernels);
	add_kinds(text, request, kernels);
	add_items(text, kernels);
	add_targets(text, request, kernels);
	add_types(text, request, kernels);
	text_add(text, "\n#endif\n");
}

/* ---- manifest: JSON, one file and one kernel per line, so that line readers can use it ---- */

static void add_count(Text *text, const char *key, const Program *program)
{
	const Count cost = program->cost;
	text_add(text, ", \"%s\": {\"mul\": %d, \"fma\": %d, \"add\": %d, \"div\": %d, "
		"\"live\": %d, \"depth\": %d}", key, cost.mul, cost.fma - cost.mul, cost.add,
		cost.divide, program->live, program->depth);
}

static char *quoted(const char *text)
{
	Text out = { 0 };
	text_add(&out, "\"");
	for (; *text; ++text)
		text_add(&out, *text == '"' || *text == '\\' ? "\\%c" : "%c", *text);
	text_add(&out, "\"");
	return text_take(&out);
}

static void add_edges(Text *text, const Kernels *kernels)
{
	text_add(text, " \"edges\": [");
	for (int i = 0; i < kernels->edges; ++i) {
		const Edge *edge = &kernels->edge[i];
		text_add(text, "%s\n  {\"function\": \"ew_%s\", \"integrand\": %s, \"k\": %d",
			i ? "," : "", edge_name(edge), quoted(edge->what ? edge->what->formula
			: "1"), edge->bound.k);
		add_count(text, "portable", &edge->program);
		text_add(text, "}");
	}
	text_add(text, "\n ],\n");
}

static void add_rings(Text *text, const Request *request, const Kernels *kernels)
{
	text_add(text, " \"rings\": [");
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		text_add(text, "%s\n  {\"ring\": \"%s\", \"family\": \"%s\", \"scheme\": \"%s\", "
			"\"window\": %d, \"turns\": %d, \"accumulators\": %d, \"outputs\": %d",
			i ? "," : "", ring->name, ring->family, ring->scheme,
			window_planes(ring->window),
			ring->turns, ring->accumulators,
			ring->outputs);
		const int both = ring->portable[1].dag != ring->portable[0].dag;
		for (int is_float = 0; is_float <= both; ++is_float) {
			add_count(text, is_float ? "portable_float" : "portable",
				&ring->portable[is_float]);
			if (request->targets & TARGET_FMA)
				add_count(text, is_float ? "fma_float" : "fma",
					&ring->fused[is_float]);
		}
		text_add(text, ", \"repeat\": %d, \"k\": [", ring->worst.repeat);
		for (int j = 0; j < ring->outputs && ring->bound; ++j)
			text_add(text, "%s%d", j ? ", " : "", ring->bound[j].k);
		text_add(text, "]}");
	}
	text_add(text, "\n ],\n");
}

static void add_deposited(Text *text, const Request *request, const Kernels *kernels)
{
	text_add(text, " \"deposits\": [");
	for (int i = 0; i < kernels->deposits; ++i) {
		const Deposited *d = &kernels->deposit[i];
		text_add(text, "%s\n  {\"deposit\": \"deposit_%s\", \"filter\": \"%s\", "
			"\"size\": %d, \"unit\": \"%s\", \"outputs\": %d", i ? "," : "",
			d->filter->name, d->filter->name, deposit_size(d->filter),
			rat_text(deposit_unit(d->filter)), d->fused.dag->outs);
		add_count(text, "portable", &d->portable);
		if (request->targets & TARGET_FMA)
			add_count(text, "fma", &d->fused);
		text_add(text, "}");
	}
	text_add(text, "\n ],\n");
}

void emit_manifest(Text *text, const Request *request, const Kernels *kernels)
{
	text_add(text, "{\"generator\": \"gen %s\",\n \"command\": %s,\n", GEN_VERSION,
		quoted(request->command));
	add_edges(text, kernels);
	add_rings(text, request, kernels);
	if (kernels->deposits)
		add_deposited(text, request, kernels);
}

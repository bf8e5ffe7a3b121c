/* emit_ring.c - the kernels that run over rings, one row of the table of targets each,
 * and the finish functions.
 *
 * This fixes the definition that every target with fused operations reproduces bit for bit, and
 * that those without, portable and wasm128, share among themselves: with L virtual lanes (8 for
 * double, 16 for float), item i goes to lane i mod L, and every accumulator of a lane takes its
 * items in order.
 * A scalar kernel runs one lane after the other over a block that stays in the nearest cache;
 * a vector kernel may run lanes side by side. Items are edges (x[i], y[i]) -> (x[i+1], y[i+1]);
 * for the vertex form, vertex i+1 between its neighbours. */
#include "gen.h"

#include <string.h>

enum { ITEM_DEGREE = 2 };          /* beyond it the transposition no longer counts */

static int is_family(const Ring *ring, const char *family)
{
	return strcmp(ring->family, family) == 0;
}

static char *describe(const Ring *ring)
{
	if (is_family(ring, "compensated"))
		return format("area, sum and what its roundings lost");
	if (is_family(ring, "radius"))
		return format("r^%d over the triangles of the edges and the origin", ring->m);
	if (is_family(ring, "closure"))
		return format("x0 y0 - x1 y1");
	if (is_family(ring, "coverage"))
		return format("area below an edge in the rectangle [u0,u1] x [v0,v1], "
			"counterclockwise positive");
	if (is_family(ring, "filter"))
		return format("integral of the filter %s, centred at (0,0)", ring->name);
	if (is_family(ring, "conic"))
		return format("all moments of x^m y^n, m + n <= %d, of the cap of a conic edge",
			ring->m);
	if (ring->window == WINDOW_QUAD || ring->window == WINDOW_CUBIC)
		return format("all moments of x^m y^n, m + n <= %d, of a %s edge", ring->m,
			ring->family);
	if (is_family(ring, "line"))
		return format("area of a line edge");
	if (is_family(ring, "magnitudes"))
		return format("all terms of x^m y^n, m + n <= %d, with positive sign", ring->m);
	if (ring->n == 0 && ring->outputs > 1)
		return format("all moments of x^m y^n, m + n <= %d", ring->m);
	if (ring->m < 0)
		return format("integral of %s, a polynomial", ring->name);
	if (ring->m + ring->n == 0)
		return format("area");
	return format("integral of x^%d y^%d", ring->m, ring->n);
}

static void add_signature(Text *text, const Ring *ring, const Target *target,
	const Precision *precision)
{
	const char *real = precision->real;
	text_add(text, "void ew_ring_%s%s_%s(\n\t", ring->name, precision->suffix, target->name);
	text_add(text, "const %s *x, const %s *y, const %s *origin,\n\tsize_t reach, size_t step, "
		"size_t count, %s *sum)", real, real, real, real);
}

/* The window of item i + turn * step. */
static void add_loads(Text *text, const Ring *ring, const char *real, int turn, int indent)
{
	for (int i = 0; i < LOADS; ++i) {
		if (loads[i].window == ring->window)
			emit_statement(text, indent, format("const %s %s = %s[%s];", real,
				loads[i].name, loads[i].array, emit_place(&loads[i], turn)));
	}
}

static char *lane_sum(int accumulator, const Precision *precision)
{
	if (accumulator == 0)
		return format("sum[lane]");
	return format("sum[%d + lane]", accumulator * precision->lanes);
}

/* The items of one lane; each turn has accumulators of its own. */
static void add_loop(Text *text, const Ring *ring, const Program *program,
	const Precision *precision)
{
	text_add(text, "\t\tfor (size_t i = lane; i < count; i += %sstep) {\n",
		ring->turns > 1 ? "2 * " : "");
	for (int turn = 0; turn < ring->turns; ++turn) {
		int first = turn * ring->accumulators / ring->turns;
		int indent = ring->turns > 1 ? 4 : 3;
		const Style style = { precision, 0, indent, first, "acc%d", "acc%d = ", NULL };
		if (ring->turns > 1)         /* a block each: the same names occur in every turn */
			text_add(text, turn ? "\t\t\tif (count - i > step) {\n" : "\t\t\t{\n");
		add_loads(text, ring, precision->real, turn, indent);
		emit_program(text, program, &style);
		if (ring->turns > 1)
			text_add(text, "\t\t\t}\n");
	}
	text_add(text, "\t\t}\n");
}

static int has_constants(const Ring *ring)
{
	for (int i = 0; i < CONSTANTS; ++i)
		if (constants[i].window == ring->window)
			return 1;
	return 0;
}

static void add_kernel(Text *text, const Ring *ring, const Target *target,
	const Precision *precision)
{
	const Program *program = emit_ring_program(ring, target, precision->is_float);
	text_add(text, "\n/* %s; scheme %s.\n", describe(ring), ring->scheme);
	text_add(text, " * Cost per item: %d %s, %d add%s; %d accumulators, %d values alive, "
		"depth %d. */\n", program->cost.fma, target->fused ? "mul or fma" : "mul",
		program->cost.add, emit_divisions(program), ring->accumulators, program->live,
		program->depth);
	if (target->attribute)
		text_add(text, "%s ", target->attribute);
	add_signature(text, ring, target, precision);
	text_add(text, "\n{\n");
	if (!has_constants(ring))
		text_add(text, "\t(void)origin;\n");
	if (target->vector) {
		emit_vector_body(text, ring, target, precision);
		text_add(text, "}\n");
		return;
	}
	text_add(text, "\tfor (size_t lane = 0; lane < step && lane < count; ++lane) {\n");
	for (int i = 0; i < CONSTANTS; ++i)
		if (constants[i].window == ring->window)
			text_add(text, "\t\tconst %s %s = origin[%slane];\n", precision->real,
				constants[i].name, constants[i].place
				? format("%d + ", constants[i].place * precision->lanes) : "");
	for (int k = 0; k < ring->accumulators; ++k)
		text_add(text, "\t\t%s acc%d = %s;\n", precision->real, k, lane_sum(k, precision));
	add_loop(text, ring, program, precision);
	for (int k = 0; k < ring->accumulators; ++k)
		text_add(text, "\t\t%s = acc%d;\n", lane_sum(k, precision), k);
	text_add(text, "\t}\n}\n");
}

/* Each family goes to files of its own, both kinds of integrands together. */
static const char *group_of(const Ring *ring)
{
	static const char *const groups[][2] = {
		{ "moments", "moments" }, { "line", "curves" }, { "quad", "curves" },
		{ "conic", "curves" }, { "cubic", "curves" }, { "radius", "distance" },
		{ "closure", "distance" }, { "coverage", "coverage" }, { "filter", "filters" },
	};
	for (int i = 0; i < LENGTH(groups); ++i)
		if (is_family(ring, groups[i][0]))
			return groups[i][1];
	return is_family(ring, "monomial") || is_family(ring, "polynomial") ? "integrands" : "trust";
}

static Text *open_file(Files *files, const Request *request, const Target *target,
	const char *name, const char *purpose)
{
	Text *text = file_new(files, name);
	emit_banner(text, name, purpose, request);
	text_add(text, "\n#include \"edgewise.h\"\n#include \"edgewise_kernels.h\"\n");
	if (target && target->guard)
		text_add(text, "\n#if %s\n", target->guard);
	if (target)
		text_add(text, "\n#include <%s>\n", target->vector ? target->vector->header
			: "math.h");
	return text;
}

static void close_file(Text *text, const Target *target)
{
	if (text && target && target->guard)
		text_add(text, "\n#else\nextern int ew_ring_not_built;    "
			"/* a file must not be empty */\n#endif\n");
}

static void emit_target(Files *files, const Request *request, const Kernels *kernels,
	const Target *target, const Precision *precision)
{
	const char *group = "";
	Text *text = NULL;
	int part = 1;
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		int fresh = group != group_of(ring);
		if (fresh || text->size > FILE_SIZE) {
			close_file(text, target);
			part = fresh ? 1 : part + 1;
			group = group_of(ring);
			char *stem = format("edgewise_%s%s_%s", group, precision->suffix,
				target->name);
			text = open_file(files, request, target,
				part > 1 ? format("%s_%d.c", stem, part) : format("%s.c", stem),
				format("%s of rings, %s, %s", group, precision->real,
					target->about));
		}
		add_kernel(text, ring, target, precision);
	}
	close_file(text, target);
}

int emit_has_item(const Ring *ring)
{
	return is_family(ring, "moments") && ring->m <= ITEM_DEGREE;
}

int emit_finishes_columns(const Ring *ring)
{
	return is_family(ring, "moments");
}

/* The same for rings side by side, by vectors of double. */
static void emit_vector_finishes(Files *files, const Request *request, const Kernels *kernels,
	const Target *target)
{
	Text *text = open_file(files, request, target, format("edgewise_finish_%s.c", target->name),
		"from accumulator sums to results, for rings side by side");
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		if (!emit_finishes_columns(ring))
			continue;
		text_add(text, "\n/* %s */\n%s void ew_ring_%s_finish_%s(\n\t", describe(ring),
			target->attribute, ring->name, target->name);
		text_add(text, "const double *sum, double *out, size_t stride)\n{\n");
		emit_vector_finish(text, ring, target);
		text_add(text, "}\n");
	}
	close_file(text, target);
}

/* Of low degrees, the items themselves, for rings whose vertices are transposed in registers. */
static void emit_items(Files *files, const Request *request, const Kernels *kernels,
	const Target *target)
{
	const char *name = format("edgewise_items_%s.h", target->name);
	Text *text = file_new(files, name);
	emit_banner(text, name, "one item of each batch kernel of a low degree", request);
	for (int p = 0; p < precision_count; ++p)
		for (int i = 0; i < kernels->rings; ++i) {
			const Ring *ring = &kernels->ring[i];
			if (!emit_has_item(ring) || !(request->precisions & precisions[p].bit))
				continue;
			text_add(text, "\n/* %s */\n", describe(ring));
			emit_vector_item(text, ring, target, &precisions[p]);
		}
}

/* From the sums of the accumulators over all items to the results;
 * the same for every target and precision. */
static void emit_finish(Files *files, const Request *request, const Kernels *kernels)
{
	const Style style = { &precisions[0], 0, 1, 0, "sum[%d * stride]", "out[%d * stride] = ",
		NULL };
	Text *text = open_file(files, request, NULL, "edgewise_finish.c",
		"from accumulator sums to results");
	for (int i = 0; i < kernels->rings; ++i) {
		const Ring *ring = &kernels->ring[i];
		text_add(text, "\n/* %s */\n", describe(ring));
		text_add(text, "void ew_ring_%s_finish(const double *sum, double *out, "
			"size_t stride)\n{\n", ring->name);
		emit_program(text, &ring->finish, &style);
		text_add(text, "}\n");
		if (!is_family(ring, "moments"))
			continue;
		text_add(text, "\nconst short ew_ring_%s_k[%d] = {", ring->name, ring->outputs);
		for (int j = 0; j < ring->outputs; ++j)
			text_add(text, "%s%s%d", j ? "," : "", j % 16 ? " " : "\n\t",
				ring->bound[j].k);
		text_add(text, "\n};\n");
	}
}

void emit_rings(Files *files, const Request *request, const Kernels *kernels)
{
	for (int t = 0; t < target_count; ++t)
		for (int p = 0; p < precision_count; ++p)
			if (request->targets & targets[t].bit
			    && request->precisions & precisions[p].bit)
				emit_target(files, request, kernels, &targets[t], &precisions[p]);
	emit_finish(files, request, kernels);
	for (int t = 0; t < target_count; ++t)
		if (targets[t].vector && request->targets & targets[t].bit) {
			emit_vector_finishes(files, request, kernels, &targets[t]);
			emit_items(files, request, kernels, &targets[t]);
		}
}

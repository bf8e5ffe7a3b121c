/* emit_deposit.c - the deposits of filters: programs that write their outputs side by side, a file
 * per target, and edgewise_filters.c, the table of filters that users name.
 *
 * Images are float, so these are too, whatever precisions the vertices have. */
#include "gen.h"

#include <string.h>

static void add_loads(Text *text, const Vector *vector, const Style *style)
{
	static const char *const input[][2] = {
		{ "x0", "x + i" }, { "y0", "y + i" }, { "x1", "x + reach + i" },
		{ "y1", "y + reach + i" },
	};
	for (int k = 0; k < LENGTH(input); ++k) {
		char *from = format("%s", input[k][1]);
		if (vector)
			text_add(text, "\t\tconst %s %s = %s;\n", vector->type[1], input[k][0],
				emit_spelling(vector->load, style, &from));
		else
			text_add(text, "\t\tconst float %s = *(%s);\n", input[k][0], from);
	}
}

static void add_stores(Text *text, const Vector *vector, const Style *style, int outputs)
{
	for (int k = 0; k < outputs; ++k) {
		char *argument[] = { k ? format("out + %d * reach + i", k) : format("out + i"),
			format("out%d", k) };
		text_add(text, "\t\t%s;\n", emit_spelling(vector->store, style, argument));
	}
}

/* Vector outputs have names, so that they can be stored together; scalars go to their place. */
static void add_deposit(Text *text, const Deposited *deposited, const Target *target)
{
	const Vector *vector = target->vector;
	const Program *program = target->fused ? &deposited->fused : &deposited->portable;
	const Style style = { &precisions[1], 0, 2, 0, NULL, vector ? "out%d = "
		: "out[%d * reach + i] = ", vector };
	text_add(text, "\n/* filter %s: %d x %d numbers, in units of %s.\n",
		deposited->filter->name, deposit_size(deposited->filter) + 1,
		deposit_size(deposited->filter), rat_text(deposit_unit(deposited->filter)));
	text_add(text, " * Cost per piece: %d %s, %d add; %d values alive, depth %d. */\n",
		program->cost.fma, target->fused ? "mul or fma" : "mul", program->cost.add,
		program->live, program->depth);
	text_add(text, "%s%svoid ew_deposit_%s_%s(const float *x, const float *y, size_t reach, "
		"size_t count,\n\tfloat *out)\n{\n", target->attribute ? target->attribute : "",
		target->attribute ? " " : "", deposited->filter->name, target->name);
	text_add(text, "\tfor (size_t i = 0; i < count; i += %d) {\n",
		vector ? vector->width[1] : 1);
	add_loads(text, vector, &style);
	for (int k = 0; vector && k < program->dag->outs; ++k)
		text_add(text, "\t\t%s out%d;\n", vector->type[1], k);
	emit_program(text, program, &style);
	if (vector)
		add_stores(text, vector, &style, program->dag->outs);
	text_add(text, "\t}\n}\n");
}

static void add_target(Files *files, const Request *request, const Kernels *kernels,
	const Target *target)
{
	Text *text = file_new(files, format("edgewise_deposit_%s.c", target->name));
	emit_banner(text, format("edgewise_deposit_%s.c", target->name),
		format("what pieces of edges add to filtered images, %s", target->about), request);
	text_add(text, "\n#include \"edgewise.h\"\n#include \"edgewise_kernels.h\"\n");
	if (target->guard)
		text_add(text, "\n#if %s\n", target->guard);
	text_add(text, "\n#include <%s>\n", target->vector ? target->vector->header : "math.h");
	for (int i = 0; i < kernels->deposits; ++i)
		add_deposit(text, &kernels->deposit[i], target);
	if (target->guard)
		text_add(text, "\n#else\nextern int ew_ring_not_built;    "
			"/* a file must not be empty */\n#endif\n");
}

static const Deposited *deposit_of(const Kernels *kernels, const Filter *filter)
{
	for (int i = 0; i < kernels->deposits; ++i)
		if (kernels->deposit[i].filter == filter)
			return &kernels->deposit[i];
	return NULL;
}

static char *literal(Rat value)
{
	return rat_literal(value, 0);
}

static void add_filter(Text *text, const Request *request, const Kernels *kernels,
	const Filter *filter)
{
	const Deposited *deposited = deposit_of(kernels, filter);
	Text description = { 0 };
	filter_describe(&description, filter);
	char *words = text_take(&description);
	for (size_t end = strlen(words); end > 0 && words[end - 1] == '\n'; )
		words[--end] = 0;
	text_add(text, "\n");
	emit_wrapped(text, "/* ", " * ", words);
	text_add(text, " */\n");
	text_add(text, "const ew_filter ew_filter_%s = {\n\t\"%s\", %d, %s, %s, %s, %s, %s,\n\t"
		"EW_RING_%s,\n\t{\n", filter->name, filter->name, deposit_size(filter),
		literal(filter->first_x), literal(filter->first_y), literal(filter->last_x),
		literal(filter->last_y),
		literal(deposited ? deposit_unit(filter) : rat(0, 1)), emit_upper(filter->name));
	for (int t = 0; t < target_count; ++t)
		if (deposited && request->targets & targets[t].bit)
			text_add(text, "\t\tEW_DEPOSIT_%s(ew_deposit_%s_%s),\n",
				emit_upper(targets[t].name), filter->name, targets[t].name);
		else
			text_add(text, "\t\tNULL,\n");
	text_add(text, "\t}\n};\n");
}

void emit_deposits(Files *files, const Request *request, const Kernels *kernels)
{
	if (!request->filters)
		return;
	for (int t = 0; t < target_count && kernels->deposits; ++t)
		if (request->targets & targets[t].bit)
			add_target(files, request, kernels, &targets[t]);
	Text *text = file_new(files, "edgewise_filters.c");
	emit_banner(text, "edgewise_filters.c", "the filters that images are made with", request);
	text_add(text, "\n#include \"edgewise.h\"\n#include \"edgewise_kernels.h\"\n\n");
	for (int t = 0; t < target_count; ++t)
		if (request->targets & targets[t].bit)
			text_add(text, "#if %s\n#define EW_DEPOSIT_%s(deposit) deposit\n#else\n"
				"#define EW_DEPOSIT_%s(deposit) NULL\n#endif\n",
				targets[t].guard ? targets[t].guard : "1",
				emit_upper(targets[t].name), emit_upper(targets[t].name));
	for (int i = 0; i < request->filters; ++i)
		add_filter(text, request, kernels, &request->filter[i]);
}

/* emit.c - what all printers share: the tables of targets and precisions, banners, and the one
 * printer that turns a program into C statements.
 *
 * A target is a row: which program it runs, the macro that says whether a compiler can build it,
 * the attribute in front of its kernels. Names of values come from the formula where
 * the scheme gave them, else t0, t1, ...; the spelling of an operation comes from ops.def.
 * With `nested`, unnamed values that are used once are written inside the statement that uses them,
 * with the parentheses that keep the order of evaluation. */
#include "gen.h"

#include <string.h>

const Load loads[LOADS] = {
	{ "x0", "x", 0, WINDOW_LINE }, { "y0", "y", 0, WINDOW_LINE },
	{ "x1", "x", 1, WINDOW_LINE }, { "y1", "y", 1, WINDOW_LINE },
	{ "y0", "y", 0, WINDOW_VERTEX }, { "x1", "x", 1, WINDOW_VERTEX },
	{ "y2", "y", 2, WINDOW_VERTEX },
	{ "x0", "x", 0, WINDOW_QUAD }, { "y0", "y", 0, WINDOW_QUAD },
	{ "x1", "x", 1, WINDOW_QUAD }, { "y1", "y", 1, WINDOW_QUAD },
	{ "x2", "x", 2, WINDOW_QUAD }, { "y2", "y", 2, WINDOW_QUAD },
	{ "x0", "x", 0, WINDOW_CONIC }, { "y0", "y", 0, WINDOW_CONIC },
	{ "x1", "x", 1, WINDOW_CONIC }, { "y1", "y", 1, WINDOW_CONIC },
	{ "x2", "x", 2, WINDOW_CONIC }, { "y2", "y", 2, WINDOW_CONIC },
	{ "w", "x", 3, WINDOW_CONIC },
	{ "x0", "x", 0, WINDOW_CUBIC }, { "y0", "y", 0, WINDOW_CUBIC },
	{ "x1", "x", 1, WINDOW_CUBIC }, { "y1", "y", 1, WINDOW_CUBIC },
	{ "x2", "x", 2, WINDOW_CUBIC }, { "y2", "y", 2, WINDOW_CUBIC },
	{ "x3", "x", 3, WINDOW_CUBIC }, { "y3", "y", 3, WINDOW_CUBIC },
	{ "x0", "x", 0, WINDOW_CELL }, { "y0", "y", 0, WINDOW_CELL },
	{ "x1", "x", 1, WINDOW_CELL }, { "y1", "y", 1, WINDOW_CELL },
};

const Constant constants[CONSTANTS] = {
	{ "cx", 0, WINDOW_VERTEX },
	{ "u0", 0, WINDOW_CELL }, { "u1", 1, WINDOW_CELL },
	{ "v0", 2, WINDOW_CELL }, { "v1", 3, WINDOW_CELL },
};

static const Vector avx2 = {
	"immintrin.h", "_mm256", { "__m256d", "__m256" }, { "pd", "ps" }, { 4, 8 }, 16, SPELL_X86,
	"%_loadu_@($1)", "%_storeu_@($1, $2)", { NULL, NULL }, { NULL, NULL }, NULL, 1,
};
static const Vector avx512 = {
	"immintrin.h", "_mm512", { "__m512d", "__m512" }, { "pd", "ps" }, { 8, 16 }, 32, SPELL_X86,
	"%_loadu_@($1)", "%_storeu_@($1, $2)",
	/* maskz: some compilers warn about the undefined operand inside the plain intrinsic */
	{ "_mm512_castsi512_pd(_mm512_maskz_alignr_epi64(0xff, _mm512_castpd_si512($2), "
	  "_mm512_castpd_si512($1), $3))",
	  "_mm512_castsi512_ps(_mm512_maskz_alignr_epi32(0xffff, _mm512_castps_si512($2), "
	  "_mm512_castps_si512($1), $3))" },
	{ "__mmask8", "__mmask16" }, "%_maskz_loadu_@($2, $1)", 0,
};
static const Vector neon = {
	"arm_neon.h", "", { "float64x2_t", "float32x4_t" }, { "f64", "f32" }, { 2, 4 }, 32,
	SPELL_NEON,
	"vld1q_@($1)", "vst1q_@($1, $2)", { NULL, NULL }, { NULL, NULL }, NULL, 0,
};
static const Vector wasm128 = {
	"wasm_simd128.h", "", { "v128_t", "v128_t" }, { "f64x2", "f32x4" }, { 2, 4 }, 16,
	SPELL_WASM,
	"wasm_v128_load($1)", "wasm_v128_store($1, $2)", { NULL, NULL }, { NULL, NULL }, NULL, 0,
};

const Target targets[] = {
	{ "portable", TARGET_PORTABLE, 0, NULL, NULL, NULL, "plain C99, no fused operations",
		NULL },
	{ "fma", TARGET_FMA, 1, "EW_BUILD_FMA", "(EW_TRUE_FMA && (EW_X86 || EW_ARM || EW_FAST_FMA))",
		"EW_ATTRIBUTE_FMA", "scalar fused multiply-add",
		NULL },
	{ "avx2", TARGET_AVX2, 1, "EW_BUILD_AVX2", "EW_X86", "EW_ATTRIBUTE_AVX2",
		"AVX2 with FMA", &avx2 },
	{ "avx512", TARGET_AVX512, 1, "EW_BUILD_AVX512", "EW_X86", "EW_ATTRIBUTE_AVX512",
		"AVX-512 F", &avx512 },
	{ "neon", TARGET_NEON, 1, "EW_BUILD_NEON", "EW_ARM", "EW_ATTRIBUTE_NEON",
		"AArch64 NEON", &neon },
	{ "wasm128", TARGET_WASM128, 0, "EW_BUILD_WASM128", "EW_WASM", "EW_ATTRIBUTE_WASM128",
		"WebAssembly SIMD without FMA", &wasm128 },
};
const int target_count = LENGTH(targets);

const Program *emit_ring_program(const Ring *ring, const Target *target, int is_float)
{
	return target->fused ? &ring->fused[is_float] : &ring->portable[is_float];
}

const Precision precisions[] = {
	{ "double", "", "2^-53", 0, 8, PRECISION_DOUBLE },
	{ "float", "f", "2^-24", 1, 16, PRECISION_FLOAT },
};
const int precision_count = LENGTH(precisions);

enum { MAX_FILES = 4096, WIDTH = 100, TAB = 8 };

char *emit_upper(const char *text)
{
	char *copy = copy_string(text, strlen(text));
	for (char *p = copy; *p; ++p)
		if (*p >= 'a' && *p <= 'z')
			*p = (char)(*p - 'a' + 'A');
	return copy;
}

char *emit_divisions(const Program *program)
{
	return program->cost.divide ? format(", %d div or sqrt", program->cost.divide)
		: format("%s", "");
}

Text *file_new(Files *files, const char *name)
{
	if (!files->file)
		files->file = allocate(MAX_FILES * sizeof *files->file);
	if (files->count == MAX_FILES)
		bug("more than %d files", MAX_FILES);
	files->file[files->count].name = name;
	return &files->file[files->count++].text;
}

void emit_banner(Text *text, const char *name, const char *purpose, const Request *request)
{
	text_add(text, "/* %s - %s\n *\n", name, purpose);
	text_add(text, " * Generated by gen %s, do not edit. To make it again:\n *\n", GEN_VERSION);
	text_add(text, " *     %s\n *\n", request->command);
	text_add(text, " * SPDX-License-Identifier: 0BSD */\n");
}

/* ---- text of limited width ---- */

void emit_wrapped(Text *text, const char *start, const char *margin, const char *words)
{
	int column = 0, first = 1;
	for (const char *p = words; ; ) {
		int size = (int)strcspn(p, " \n"), hard = p > words && p[-1] == '\n';
		if (first || hard || column + 1 + size > WIDTH - 3) {   /* room to end a comment */
			const char *head = first ? start : margin;
			int blank = size == 0 && *head;
			text_add(text, "%s%.*s%.*s", first ? "" : "\n", (int)strlen(head) - blank,
				head, size, p);
			column = (int)strlen(head) + size;
		} else {
			text_add(text, " %.*s", size, p);
			column += 1 + size;
		}
		first = 0;
		p += size;
		if (!*p)
			return;
		++p;
	}
}

/* Where to break a statement that is too wide: before its last sum that fits,
 * else before its last product. */
static int break_at(const char *statement, int room)
{
	static const char *const operators[] = { "+-", "*" };
	for (int kind = 0; kind < LENGTH(operators); ++kind)
		for (int cut = room - 1; cut > 0; --cut)
			if (statement[cut] == ' ' && strchr(operators[kind], statement[cut + 1])
			    && statement[cut + 2] == ' ')
				return cut;
	for (int cut = room - 1; cut > 0; --cut)     /* a prototype */
		if (statement[cut] == ' ' && statement[cut - 1] == ',')
			return cut;
	return 0;
}

void emit_statement(Text *text, int indent, const char *statement)
{
	int room = WIDTH - TAB * indent, cut;
	text_add(text, "%.*s", indent, "\t\t\t\t\t");
	while ((int)strlen(statement) > room && (cut = break_at(statement, room)) > 0) {
		text_add(text, "%.*s\n%.*s", cut, statement, indent + 1, "\t\t\t\t\t\t");
		statement += cut + 1;
		room = WIDTH - TAB * (indent + 1);
	}
	text_add(text, "%s\n", statement);
}

/* ---- programs ---- */

typedef struct {
	const Program *program;
	const Style *style;
	const char **name;                           /* of each node that has a place of its own */
	const int *uses;
} Printer;

static int is_taken(const Printer *printer, int count, const char *name)
{
	for (int i = 0; i < count; ++i)
		if (printer->name[i] && strcmp(printer->name[i], name) == 0)
			return 1;
	return 0;
}

static int output_of(const Dag *dag, Ref ref)
{
	for (int k = 0; k < dag->outs; ++k)
		if (dag->out[k] == ref)
			return k;
	return -1;
}

static int is_inline(const Printer *printer, Ref ref)
{
	const Node *node = &printer->program->dag->node[ref];
	return printer->style->nested && !node->name && printer->uses[ref] == 1;
}

/* An output that nothing else uses goes straight to its place; others get a name first. */
static int is_last(const Printer *printer, Ref ref)
{
	return output_of(printer->program->dag, ref) >= 0 && printer->uses[ref] == 1;
}

/* The corners (x2,y2), (x3,y3) of a cell are called (u0,v0), (u1,v1). */
static const char *input_name(const Dag *dag, int var)
{
	static const char *const corner[] = { "u0", "v0", "u1", "v1" };
	if (dag->window == WINDOW_CELL && var >= VAR_X2 && var <= VAR_Y3)
		return corner[var - VAR_X2];
	return var_name(var);
}

/* Names for all operations that get a statement, in the order of evaluation. */
static void name_values(Printer *printer)
{
	const Program *program = printer->program;
	const Dag *dag = program->dag;
	int temporaries = 0;
	for (int i = 0; i < dag->count; ++i) {
		const Node *node = &dag->node[i];
		int is_input = node->op == OP_INPUT;
		int accumulator = is_input ? mono_accumulator_of(node->input) : -1;
		if (accumulator >= 0)
			printer->name[i] = format(printer->style->accumulator,
				printer->style->first + accumulator);
		for (int var = 0; var < VARS && accumulator < 0 && is_input; ++var)
			if (node->input == mono_var(var, 1))
				printer->name[i] = input_name(dag, var);
	}
	for (int at = 0; at < program->count; ++at) {
		Ref ref = program->order[at];
		const char *name = dag->node[ref].name;
		if (is_inline(printer, ref) || is_last(printer, ref))
			continue;
		if (!name || is_taken(printer, dag->count, name))
			name = format("t%d", temporaries++);
		printer->name[ref] = name;
	}
}

char *emit_place(const Load *load, int turn)
{
	static const char *const ahead[] = { "", " + reach", " + 2 * reach", " + 3 * reach" };
	return format("i%s%s", turn ? " + step" : "", ahead[load->ahead]);
}

char *emit_spelling(const char *pattern, const Style *style, char *const *argument)
{
	Text text = { 0 };
	const Vector *vector = style->vector;
	const char *suffix = style->precision->suffix;
	if (vector)
		suffix = vector->suffix[style->precision->is_float];
	for (const char *p = pattern; *p; ++p) {
		if (*p == '$')
			text_add(&text, "%s", argument[*++p - '1']);
		else if (*p == '@')
			text_add(&text, "%s", suffix);
		else if (*p == '%')
			text_add(&text, "%s", vector ? vector->prefix : "");
		else
			text_add(&text, "%c", *p);
	}
	return text_take(&text);
}

static char *expression(const Printer *printer, Ref ref, int top);

/* An operand, in parentheses unless it is a name, a constant, or a product inside a sum. */
static char *operand(const Printer *printer, Ref ref, int parent)
{
	const Node *node = &printer->program->dag->node[ref];
	char *text = expression(printer, ref, 0);
	int is_operation = op_operands(node->op) > 0 && !printer->name[ref];
	int is_negative = node->op == OP_CONST && rat_sign(node->value) < 0;
	if (parent == OP_FMS && (is_operation || is_negative))   /* a minus may stand before it */
		return format("(%s)", text);
	if (!is_operation || op_operands(parent) == 3 || (node->op == OP_MUL && parent != OP_MUL))
		return text;
	return format("(%s)", text);
}

/* Constants first, then x0 y1 rather than y1 x0;
 * addition and multiplication commute bit for bit. */
static int reads_better_swapped(const Printer *printer, const Node *node)
{
	if (!op_commutes(node->op))
		return 0;
	const Node *a = &printer->program->dag->node[node->arg[0]];
	const Node *b = &printer->program->dag->node[node->arg[1]];
	if (a->op == OP_CONST || b->op == OP_CONST)
		return b->op == OP_CONST;
	const char *left = printer->name[node->arg[0]], *right = printer->name[node->arg[1]];
	return left && right && (a->op == OP_INPUT || b->op == OP_INPUT) && strcmp(left, right) > 0;
}

static char *expression(const Printer *printer, Ref ref, int top)
{
	const Node *node = &printer->program->dag->node[ref];
	const Vector *vector = printer->style->vector;
	const char *pattern = op_spelling(node->op, vector ? vector->spelling : SPELL_C);
	Ref arg[3] = { node->arg[0], node->arg[1], node->arg[2] };
	if (printer->name[ref] && !top)
		return copy_string(printer->name[ref], strlen(printer->name[ref]));
	if (node->op == OP_CONST) {
		char *literal = rat_literal(node->value, printer->style->precision->is_float);
		return emit_spelling(pattern, printer->style, &literal);
	}
	if (reads_better_swapped(printer, node)) {
		arg[0] = node->arg[1];
		arg[1] = node->arg[0];
	}
	char *argument[3] = { NULL, NULL, NULL };
	for (int k = 0; k < op_operands(node->op); ++k)
		argument[k] = operand(printer, arg[k], node->op);
	return emit_spelling(pattern, printer->style, argument);
}

static Printer printer_of(const Program *program, const Style *style)
{
	size_t count = (size_t)program->dag->count;
	const char **names = allocate(count * sizeof *names);
	Printer printer = { program, style, names, dag_uses(program->dag) };
	name_values(&printer);
	return printer;
}

static void add_value(Text *text, const Printer *printer, Ref ref)
{
	const Style *style = printer->style;
	const char *type = style->precision->real;
	int k = is_last(printer, ref) ? output_of(printer->program->dag, ref) : -1;
	char *value = expression(printer, ref, 1);
	if (style->vector)
		type = style->vector->type[style->precision->is_float];
	if (k >= 0)
		value = format("%s%s;", format(style->output, style->first + k), value);
	else
		value = format("const %s %s = %s;", type, printer->name[ref], value);
	emit_statement(text, style->indent, value);
}

void emit_program(Text *text, const Program *program, const Style *style)
{
	Mark mark = arena_mark();
	const Dag *dag = program->dag;
	Printer printer = printer_of(program, style);
	for (int at = 0; at < program->count; ++at) {
		Ref ref = program->order[at];
		if (output_of(dag, ref) >= 0 || !is_inline(&printer, ref))
			add_value(text, &printer, ref);
	}
	for (int k = 0; k < dag->outs; ++k)          /* a bare accumulator, or used elsewhere too */
		if (!is_last(&printer, dag->out[k]) || op_operands(dag->node[dag->out[k]].op) == 0)
			emit_statement(text, style->indent, format("%s%s;",
				format(style->output, style->first + k),
				expression(&printer, dag->out[k], 0)));
	arena_release(mark);
}

/* Which nodes depend on an accumulator: they are evaluated when its turn comes. */
static unsigned char *accumulating(const Dag *dag)
{
	unsigned char *depends = allocate((size_t)dag->count);
	for (int i = 0; i < dag->count; ++i) {
		const Node *node = &dag->node[i];
		depends[i] = node->op == OP_INPUT && mono_accumulator_of(node->input) >= 0;
		for (int k = 0; k < op_operands(node->op); ++k)
			depends[i] |= depends[node->arg[k]];
	}
	return depends;
}

/* The same for all items. */
static int is_constant(const Dag *dag, const Node *node)
{
	const int is_corner = dag->window == WINDOW_CELL && (node->input == mono_var(VAR_X2, 1)
		|| node->input == mono_var(VAR_Y2, 1) || node->input == mono_var(VAR_X3, 1)
		|| node->input == mono_var(VAR_Y3, 1));
	return node->op == OP_INPUT && (is_corner || node->input == mono_var(VAR_CX, 1));
}

static void add_chain(Text *text, const Printer *printer, const unsigned char *depends, Ref ref)
{
	const Node *node = &printer->program->dag->node[ref];
	if (op_operands(node->op) == 0)
		return;
	for (int k = 0; k < op_operands(node->op); ++k)
		if (depends[node->arg[k]])
			add_chain(text, printer, depends, node->arg[k]);
	add_value(text, printer, ref);
}

/* The values of the second item carry the suffix "_2"; each accumulator takes both in order. */
void emit_stored(Text *text, const Program *program, const Style *style, int items,
	void (*open)(const void *to, int accumulator),
	void (*close)(const void *to, int accumulator), const void *to)
{
	Mark mark = arena_mark();
	const Dag *dag = program->dag;
	const unsigned char *depends = accumulating(dag);
	Printer printer[2] = { printer_of(program, style), printer_of(program, style) };
	for (int i = 0; i < dag->count; ++i)
		if (printer[1].name[i] && !(depends[i] && dag->node[i].op == OP_INPUT)
		    && !is_constant(dag, &dag->node[i]))
			printer[1].name[i] = format("%s_2", printer[1].name[i]);
	for (int at = 0; at < program->count; ++at) {
		Ref ref = program->order[at];
		int k = output_of(dag, ref);
		if (k >= 0)
			open(to, k);
		for (int copy = 0; copy < items; ++copy) {
			if (k >= 0)
				add_chain(text, &printer[copy], depends, ref);
			else if (!depends[ref])
				add_value(text, &printer[copy], ref);
		}
		if (k >= 0)
			close(to, k);
	}
	arena_release(mark);
}

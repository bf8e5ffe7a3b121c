/* emit_simd.c - ring kernels whose lanes run side by side, for targets with a vector instruction
 * set.
 *
 * The result is fixed by the definition in emit_ring.c: lane l of L takes items l, l + L, ... in
 * order. A register holds V of the L lanes, and the lanes are run in L / V passes, so that a pass
 * needs registers for one vector only. Three shapes give the same bits:
 *
 *   carried   few operations and V = L: loads are the limit, so a vector is loaded once and
 *             shifted into place for the ends of its edges
 *   locals    accumulators are local variables
 *   stored    accumulators stay in the nearest cache and take two vectors per load and store; for
 *             the long chain of a cell too, so that two are on the way
 *
 * The last vectors may be partial: their loads are masked, or go through buffers that hold 0 behind
 * the last item, and an item of zeros adds exactly 0. Kernels of curves and windows are long, so
 * they have this one loop only; what it costs is small beside their operations. */
#include "gen.h"

enum { FEW_OPERATIONS = 6,   /* on the FMA pipe, up to which loads are the limit (degree 1) */
       MANY_REGISTERS = 32,  /* with fewer, locals that spill are faster than stored */
       MANY_OPERATIONS = 48 };   /* from here on stored is faster than locals that spill */

typedef struct {
	Text *text;
	const Ring *ring;
	const Program *program;
	const Vector *vector;
	const Precision *precision;
	const char *type;                    /* of a register */
	int width;                           /* V */
	Style style;
} Shape;

static int is_long(const Ring *ring)
{
	return (ring->window >= WINDOW_QUAD && ring->window != WINDOW_CELL) || ring->filter;
}

static const char *margin(int indent)
{
	return "\t\t\t\t\t" + 5 - indent;
}

static char *load(const Shape *shape, char *pointer)
{
	return emit_spelling(shape->vector->load, &shape->style, &pointer);
}

static char *lane_sum(const Shape *shape, int accumulator)
{
	if (accumulator == 0)
		return format("sum + pass");
	return format("sum + %d + pass", accumulator * shape->precision->lanes);
}

static void add_load(const void *to, int accumulator)
{
	const Shape *shape = to;
	int indent = shape->style.indent;
	text_add(shape->text, "%s%s acc%d = %s;\n", margin(indent), shape->type, accumulator,
		load(shape, lane_sum(shape, accumulator)));
}

static void add_store(const void *to, int accumulator)
{
	const Shape *shape = to;
	char *argument[] = { lane_sum(shape, accumulator), format("acc%d", accumulator) };
	char *store = emit_spelling(shape->vector->store, &shape->style, argument);
	text_add(shape->text, "%s%s;\n", margin(shape->style.indent), store);
}

/* How many items are left for the vector `turn` steps behind item i, and the mask that says so. */
static void add_rest(const Shape *shape, int turn, const char *suffix)
{
	const char *mask = shape->vector->mask[shape->precision->is_float];
	const char *tab = margin(shape->style.indent);
	text_add(shape->text, "%sconst size_t rest%s = %s;\n", tab, suffix,
		turn ? "count - i > step ? count - i - step : 0" : "count - i");
	if (mask)
		text_add(shape->text, "%sconst %s mask%s = EW_CAST(%s, rest%s < %d ? (1u << rest%s) - 1 : "
			"0x%xu);\n", tab, mask, suffix, mask, suffix, shape->width, suffix,
			(1u << shape->width) - 1);
	else
		text_add(shape->text, "%s%s pad%s[%d][%d];\n%sint at%s = 0;\n", tab,
			shape->precision->real, suffix, 2 * window_planes(shape->ring->window),
			shape->width, tab, suffix);
}

static char *load_some(const Shape *shape, const char *name, char *from, const char *suffix)
{
	const Precision *precision = shape->precision;
	if (shape->vector->load_masked) {
		char *argument[] = { from, format("mask%s", suffix) };
		return emit_spelling(shape->vector->load_masked, &shape->style, argument);
	}
	text_add(shape->text, "%sconst %s *at_%s = ew_ring_pad%s(pad%s[at%s++], %s, rest%s, %d);\n",
		margin(shape->style.indent), precision->real, name, precision->suffix, suffix,
		suffix, from, suffix, shape->width);
	return load(shape, format("at_%s", name));
}

/* The window of the vector `turn` steps behind item i; `whole`: no item of it is missing. */
static void add_window(const Shape *shape, int turn, const char *suffix, int whole)
{
	const char *tab = margin(shape->style.indent);
	if (!whole)
		add_rest(shape, turn, suffix);
	for (int i = 0; i < LOADS; ++i) {
		if (loads[i].window != shape->ring->window)
			continue;
		char *name = format("%s%s", loads[i].name, suffix);
		char *from = format("%s + %s", loads[i].array, emit_place(&loads[i], turn));
		char *value = whole ? load(shape, from) : load_some(shape, name, from, suffix);
		const int hidden = whole && shape->vector->keeps;
		text_add(shape->text, "%s%s%s %s = %s;\n", tab, hidden ? "" : "const ", shape->type,
			name, value);
		if (hidden)
			text_add(shape->text, "%sEW_KEEP(%s);\n", tab, name);
	}
}

static void set_turn(Shape *shape, int turn, int indent)
{
	shape->style.first = turn * shape->ring->accumulators / shape->ring->turns;
	shape->style.indent = indent;
}

/* From item i on: as long as vectors are whole, or to the end. */
static void add_items(Shape *shape, int whole)
{
	const int turns = shape->ring->turns;
	text_add(shape->text, "\t\tfor (; %s; i += %sstep) {\n", !whole ? "i < count"
		: format(turns > 1 ? "i + step + %d < count" : "i + %d < count", shape->width - 1),
		turns > 1 ? "2 * " : "");
	for (int turn = 0; turn < turns; ++turn) {
		set_turn(shape, turn, turns > 1 ? 4 : 3);
		text_add(shape->text, turns > 1 ? "\t\t\t{\n" : "");
		add_window(shape, turn, "", whole);
		emit_program(shape->text, shape->program, &shape->style);
		text_add(shape->text, turns > 1 ? "\t\t\t}\n" : "");
	}
	text_add(shape->text, "\t\t}\n");
}

/* One vector of the carried loop: xa, ya are loaded, and the next ones take their place. */
static void add_carried_turn(Shape *shape, int turn)
{
	const int next = (turn + 1) * shape->width;
	Text *text = shape->text;
	set_turn(shape, turn, 5);
	text_add(text, "\t\t\t\t{\n");
	for (const char *axis = "xy"; *axis; ++axis)
		text_add(text, "\t\t\t\t\tconst %s %cb = %s;\n", shape->type, *axis,
			load(shape, format("%c + i + %d", *axis, next)));
	for (int i = 0; i < LOADS; ++i) {
		if (loads[i].window != shape->ring->window)
			continue;
		char axis = *loads[i].array;
		char *argument[] = { format("%ca", axis), format("%cb", axis),
			format("%d", loads[i].ahead) };
		const char *shift = shape->vector->shift[shape->precision->is_float];
		char *value = emit_spelling(loads[i].ahead ? shift : "$1", &shape->style,
			argument);
		emit_statement(text, 5, format("const %s %s = %s;", shape->type, loads[i].name,
			value));
	}
	emit_program(text, shape->program, &shape->style);
	text_add(text, "\t\t\t\t\txa = xb;\n\t\t\t\t\tya = yb;\n\t\t\t\t}\n");
}

/* While the next vector can be loaded whole; the rest is for the loops behind it. */
static void add_carried(Shape *shape)
{
	const int turns = shape->ring->turns, span = (turns + 1) * shape->width;
	Text *text = shape->text;
	char *whole = format("i + %d < count + %d", span, window_planes(shape->ring->window));
	text_add(text, "\t\tif (reach == 1 && step == %d && %s) {\n", shape->width, whole);
	for (const char *axis = "xy"; *axis; ++axis)
		text_add(text, "\t\t\t%s %ca = %s;\n", shape->type, *axis,
			load(shape, format("%c", *axis)));
	text_add(text, "\t\t\tfor (; %s; i += %d) {\n", whole, turns * shape->width);
	for (int turn = 0; turn < turns; ++turn)
		add_carried_turn(shape, turn);
	text_add(text, "\t\t\t}\n\t\t}\n");
}

static void add_locals(Shape *shape, int carried)
{
	for (int k = 0; k < shape->ring->accumulators; ++k)
		add_load(shape, k);
	text_add(shape->text, "\t\tsize_t i = pass;\n");
	if (carried)
		add_carried(shape);
	if (!is_long(shape->ring))
		add_items(shape, 1);
	add_items(shape, 0);
	set_turn(shape, 0, 2);
	for (int k = 0; k < shape->ring->accumulators; ++k)
		add_store(shape, k);
}

/* Compilers that see through the address of an accumulator would move it back to a register, and
 * spill it. */
static void add_stored_items(Shape *shape, int items)
{
	text_add(shape->text, "\t\tfor (; i%s < count; i += %sstep) {\n",
		items > 1 ? format(" + step + %d", shape->width - 1) : "", items > 1 ? "2 * " : "");
	text_add(shape->text, "\t\t\tEW_HIDE(sum);\n");
	set_turn(shape, 0, 3);
	add_window(shape, 0, "", items > 1);
	if (items > 1)
		add_window(shape, 1, "_2", 1);
	emit_stored(shape->text, shape->program, &shape->style, items, add_load, add_store,
		shape);
	text_add(shape->text, "\t\t}\n");
}

static void add_stored(Shape *shape)
{
	text_add(shape->text, "\t\tsize_t i = pass;\n");
	if (!is_long(shape->ring))
		add_stored_items(shape, 2);
	add_stored_items(shape, 1);
}

/* From sums to results, a register of neighbouring rings at a time. */
void emit_vector_finish(Text *text, const Ring *ring, const Target *target)
{
	const Vector *vector = target->vector;
	const Style style = { &precisions[0], 0, 1, 0, "sum%d", "out%d = ", vector };
	for (int k = 0; k < ring->accumulators; ++k) {
		char *from = format("sum + %d * stride", k);
		text_add(text, "\tconst %s sum%d = %s;\n", vector->type[0], k,
			emit_spelling(vector->load, &style, &from));
	}
	for (int j = 0; j < ring->outputs; ++j)
		text_add(text, "\t%s out%d;\n", vector->type[0], j);
	emit_program(text, &ring->finish, &style);
	for (int j = 0; j < ring->outputs; ++j) {
		char *argument[] = { format("out + %d * stride", j), format("out%d", j) };
		text_add(text, "\t%s;\n", emit_spelling(vector->store, &style, argument));
	}
}

void emit_vector_item(Text *text, const Ring *ring, const Target *target,
	const Precision *precision)
{
	const Vector *vector = target->vector;
	const char *type = vector->type[precision->is_float];
	const Style style = { precision, 0, 1, 0, "acc[%d]", "acc[%d] = ", vector };
	text_add(text, "%s EW_INLINE void ew_ring_%s_item_%s%s(", target->attribute, ring->name,
		target->name, precision->suffix);
	for (int i = 0; i < LOADS; ++i)
		if (loads[i].window == ring->window)
			text_add(text, "%s %s, ", type, loads[i].name);
	text_add(text, "\n\t%s cx, %s *acc)\n{\n", type, type);
	if (ring->window != WINDOW_VERTEX)
		text_add(text, "\t(void)cx;\n");
	emit_program(text, emit_ring_program(ring, target, precision->is_float), &style);
	text_add(text, "}\n");
}

void emit_vector_body(Text *text, const Ring *ring, const Target *target,
	const Precision *precision)
{
	const Vector *vector = target->vector;
	const int width = vector->width[precision->is_float];
	const Program *program = emit_ring_program(ring, target, precision->is_float);
	Shape shape = { text, ring, program, vector, precision, vector->type[precision->is_float], width,
		{ precision, 0, 2, 0, "acc%d", "acc%d = ", vector } };
	int carried = vector->shift[0] && width == precision->lanes
		&& program->cost.fma <= FEW_OPERATIONS;
	int stored = vector->registers >= MANY_REGISTERS && ring->turns == 1
		&& ((program->cost.fma >= MANY_OPERATIONS
		&& ring->accumulators + program->live > vector->registers)
		|| ring->window == WINDOW_CELL);
	text_add(text, "\tfor (size_t pass = 0; pass < step && pass < count; pass += %d) {\n", width);
	for (int i = 0; i < CONSTANTS; ++i)
		if (constants[i].window == ring->window)
			text_add(text, "\t\tconst %s %s = %s;\n", shape.type, constants[i].name,
				load(&shape, constants[i].place ? format("origin + %d + pass",
					constants[i].place * precision->lanes)
					: format("origin + pass")));
	if (stored)
		add_stored(&shape);
	else
		add_locals(&shape, carried);
	text_add(text, "\t}\n");
}

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
 *   stored    accumulators stay in the nearest cache and take two vectors per load and store
 *
 * The last vector may be partial: its items are copied to buffers that hold 0 behind them, and an
 * item of zeros adds exactly 0. */
#include "gen.h"

enum { FEW_OPERATIONS = 6,   /* on the FMA pipe, up to which loads are the limit (degree 1) */
       MANY_REGISTERS = 32,  /* with fewer, locals that spill are faster than stored */
       SPILLS = 10 };        /* values that may spill before stored is faster; measured */

typedef struct {
	Text *text;
	const Ring *ring;
	const Vector *vector;
	const Precision *precision;
	const char *type;                    /* of a register */
	int width;                           /* V */
	Style style;
} Shape;

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

/* The window of the vector `ahead` items behind item i, from the arrays or from padded copies. */
static void add_window(const Shape *shape, int ahead, const char *suffix)
{
	const Precision *precision = shape->precision;
	const char *tab = margin(shape->style.indent);
	if (ahead)
		text_add(shape->text,
			"%sconst size_t rest%s = count - i > %d ? count - i - %d : 0;\n",
			tab, suffix, ahead, ahead);
	else
		text_add(shape->text, "%sconst size_t rest%s = count - i;\n", tab, suffix);
	text_add(shape->text, "%s%s pad%s[4][%d];\n", tab, precision->real, suffix, shape->width);
	for (int i = 0, k = 0; i < LOADS; ++i) {
		if (loads[i].window != shape->ring->window)
			continue;
		int offset = loads[i].offset + ahead;
		const char *array = loads[i].array;
		char *from = format(offset ? "%s + i + %d" : "%s + i", array, offset);
		text_add(shape->text, "%sconst %s *at_%s%s = rest%s < %d\n", tab, precision->real,
			loads[i].name, suffix, suffix, shape->width);
		text_add(shape->text, "%s\t? ew_ring_pad%s(pad%s[%d], %s, rest%s, %d) : %s;\n", tab,
			precision->suffix, suffix, k++, from, suffix, shape->width, from);
		text_add(shape->text, "%sconst %s %s%s = %s;\n", tab, shape->type, loads[i].name,
			suffix, load(shape, format("at_%s%s", loads[i].name, suffix)));
	}
}

static void set_turn(Shape *shape, int turn, int indent)
{
	shape->style.first = turn * shape->ring->accumulators / shape->ring->turns;
	shape->style.indent = indent;
}

static void add_plain(Shape *shape, const char *start)
{
	const int lanes = shape->precision->lanes, turns = shape->ring->turns;
	text_add(shape->text, "\t\tfor (size_t i = %s; i < count; i += %d) {\n", start,
		turns * lanes);
	for (int turn = 0; turn < turns; ++turn) {
		set_turn(shape, turn, turns > 1 ? 4 : 3);
		text_add(shape->text, turns > 1 ? "\t\t\t{\n" : "");
		add_window(shape, turn * lanes, "");
		emit_program(shape->text, &shape->ring->fused, &shape->style);
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
			load(shape, format("%c + next + %d", *axis, next)));
	for (int i = 0; i < LOADS; ++i) {
		if (loads[i].window != shape->ring->window)
			continue;
		char axis = *loads[i].array;
		char *argument[] = { format("%ca", axis), format("%cb", axis),
			format("%d", loads[i].offset) };
		const char *shift = shape->vector->shift[shape->precision->is_float];
		char *value = emit_spelling(loads[i].offset ? shift : "$1", &shape->style,
			argument);
		emit_statement(text, 5, format("const %s %s = %s;", shape->type, loads[i].name,
			value));
	}
	emit_program(text, &shape->ring->fused, &shape->style);
	text_add(text, "\t\t\t\t\txa = xb;\n\t\t\t\t\tya = yb;\n\t\t\t\t}\n");
}

/* While the next vector can be loaded whole; the rest is for the plain loop, from item `next`. */
static void add_carried(Shape *shape)
{
	const int turns = shape->ring->turns, span = (turns + 1) * shape->width;
	Text *text = shape->text;
	char *whole = format("next + %d < count + %d", span, shape->ring->window);
	text_add(text, "\t\tsize_t next = 0;\n\t\tif (%s) {\n", whole);
	for (const char *axis = "xy"; *axis; ++axis)
		text_add(text, "\t\t\t%s %ca = %s;\n", shape->type, *axis,
			load(shape, format("%c", *axis)));
	text_add(text, "\t\t\tfor (; %s; next += %d) {\n", whole, turns * shape->width);
	for (int turn = 0; turn < turns; ++turn)
		add_carried_turn(shape, turn);
	text_add(text, "\t\t\t}\n\t\t}\n");
}

static void add_locals(Shape *shape, int carried)
{
	for (int k = 0; k < shape->ring->accumulators; ++k)
		add_load(shape, k);
	if (carried)
		add_carried(shape);
	add_plain(shape, carried ? "next" : "pass");
	set_turn(shape, 0, 2);
	for (int k = 0; k < shape->ring->accumulators; ++k)
		add_store(shape, k);
}

static void add_stored(Shape *shape)
{
	const int lanes = shape->precision->lanes;
	text_add(shape->text, "\t\tfor (size_t i = pass; i < count; i += %d) {\n", 2 * lanes);
	set_turn(shape, 0, 3);
	add_window(shape, 0, "");
	add_window(shape, lanes, "_2");
	emit_pair(shape->text, &shape->ring->fused, &shape->style, add_load, add_store, shape);
	text_add(shape->text, "\t\t}\n");
}

void emit_vector_body(Text *text, const Ring *ring, const Target *target,
	const Precision *precision)
{
	const Vector *vector = target->vector;
	const int width = vector->width[precision->is_float];
	Shape shape = { text, ring, vector, precision, vector->type[precision->is_float], width,
		{ precision, 0, 2, 0, "acc%d", "acc%d = ", vector } };
	int carried = vector->shift[0] && width == precision->lanes
		&& ring->fused.cost.fma <= FEW_OPERATIONS;
	int stored = vector->registers >= MANY_REGISTERS && ring->turns == 1
		&& ring->accumulators + ring->fused.live > vector->registers + SPILLS;
	if (ring->window == 3) {
		char *value = format("origin"), *set;
		set = emit_spelling(op_spelling(OP_CONST, vector->spelling), &shape.style, &value);
		text_add(text, "\tconst %s cx = %s;\n", shape.type, set);
	}
	text_add(text, "\tfor (size_t pass = 0; pass < %d && pass < count; pass += %d) {\n",
		precision->lanes, width);
	if (stored)
		add_stored(&shape);
	else
		add_locals(&shape, carried);
	text_add(text, "\t}\n");
}

/* Every kernel of the list, on every target that this build has and this CPU runs, called directly.
 *
 * What a kernel must add up is defined by its scalar form (fma; portable for itself) run over one
 * item at a time: item i goes to lane i mod step, with two turns alternately to two sets of
 * accumulators. That definition grows by one item per count, so every count from none to five
 * vectors per turn is held against it, bit for bit: streams (reach 1, step L), short rings (reach
 * 1, step 1, of which lane 0 counts) and columns (reach and step V, the width of a register). Sums
 * do not begin at 0. Every array touches an inaccessible page, at its front or at its back; then
 * all are moved to every alignment. NaN or infinity in one vertex, origin or sum must stay in the
 * sums where the definition has either; a vector may add 0 times infinity in lanes that have run
 * out of items, so which of the two is not compared. Origins are the constants of the lanes, in
 * several places: four for coverage, the sides of a cell, some of them empty. Finish kernels are
 * held against the scalar one, lane by lane.
 *
 * Deposits must give for each piece what the scalar one gives for it alone, touch nothing beyond
 * the pieces rounded up to 16, and negate under reversal; rows add up to the filter's integral over
 * the region that the piece bounds, taken by ew_NAME, and totals of columns are integers that add
 * up exactly along an edge.
 *
 * A crash is charged to the kernel that caused it, and the next one runs.
 */
#include "guarded.h"

#include <setjmp.h>

#include "edgewise.h"
#include "edgewise_kernels.h"

#include "check.h"

enum { DOUBLES = 8, FLOATS = 16, VECTORS = 5 };
enum { ITEMS = VECTORS * FLOATS * 2 + 2, VERTICES = ITEMS + 2 * FLOATS + 2 };
enum { CELLS = EW_MAX_ACCUMULATORS * FLOATS };
enum { CELL_SIDES = 4, ORIGINS = CELL_SIDES * FLOATS };
enum { TAKEN = 16, PIECES = 3 * TAKEN, MOST_PIXELS = 8, OUTPUTS = MOST_PIXELS * (MOST_PIXELS + 1) };
enum { SHIFTS = 64, CANARY = 0x88, NOT_A_NUMBER = 0xff };

/* The list. */

typedef struct {
	const char *name;
	int id;
	ew_ring_run *run;
	ew_ring_runf *runf;
} Kernel;

typedef struct {
	const char *name;
	int id;
	ew_ring_finish *finish;
} Finish;

typedef struct {
	const char *name;
	const ew_filter *filter;
	ew_deposit *deposit;
} Deposit;

typedef struct {
	unsigned bit;
	size_t doubles;                 /* in a register; 1 for scalars */
	const Kernel *kernels;
	size_t count;
	const Finish *finishes;
	size_t finish_count;
	const Deposit *deposits;
	size_t deposit_count;
} Target;

#define KERNEL_DOUBLE(id, kernel, f, a) { #kernel, id, kernel, NULL },
#define KERNEL_FLOAT(id, kernel, f, a) { #kernel, id, NULL, kernel },
#define FINISH(id, finish) { #finish, id, finish },
#define DEPOSIT(filter, deposit, f, a) { #deposit, &filter, deposit },
#define TABLES(TARGET, target, doubles) \
	static const Kernel kernels_##target[] = { \
		EW_RINGS_##TARGET##_DOUBLE(KERNEL_DOUBLE) EW_RINGS_##TARGET##_FLOAT(KERNEL_FLOAT) \
	}; \
	static const Finish finishes_##target[] = { EW_FINISHES_##TARGET(FINISH) }; \
	static const Deposit deposits_##target[] = { EW_DEPOSITS_##TARGET(DEPOSIT) };
EW_TARGETS(TABLES)

#define COUNT(table) (sizeof(table) / sizeof *(table))
#define TARGET_ROW(TARGET, target, doubles) { EW_##TARGET, doubles, \
	kernels_##target, COUNT(kernels_##target), finishes_##target, COUNT(finishes_##target), \
	deposits_##target, COUNT(deposits_##target) },
static const Target targets[] = { EW_TARGETS(TARGET_ROW) };

typedef struct {
	size_t window, turns, accumulators, outputs;
	ew_ring_finish *finish;
} Shape;

#define SHAPE(id, window, turns, accumulators, outputs, finish) \
	{ window, turns, accumulators, outputs, finish },
static const Shape shapes[] = { EW_RINGS_SHAPES(SHAPE) };

#define FAMILY(id, family, m, n, accumulators, outputs, k, r) #family,
static const char *const families[] = { EW_RINGS(FAMILY) };

/* How many constants a lane has. */
static size_t places_of(int id)
{
	if (strcmp(families[id], "coverage") == 0)
		return CELL_SIDES;
	return shapes[id].window == 3 && strcmp(families[id], "quad") != 0;
}

static const Target *find_target(unsigned bit)
{
	for (size_t i = 0; i < COUNT(targets); i++) {
		if (targets[i].bit == bit)
			return &targets[i];
	}
	return NULL;
}

/* The scalar kernel that defines this one. */
static const Kernel *defining(const Target *target, const Kernel *kernel)
{
	const Target *scalar = find_target(target->bit == EW_PORTABLE ? EW_PORTABLE : EW_FMA);
	for (size_t i = 0; i < scalar->count; i++) {
		const Kernel *k = &scalar->kernels[i];
		if (k->id == kernel->id && !k->runf == !kernel->runf)
			return k;
	}
	abort();
}

/* One form of call of one kernel, with its data as the kernel reads them. */

typedef struct {
	const Kernel *kernel, *scalar;
	const Shape *shape;
	const char *form;
	size_t size, lanes;             /* of a number in bytes; L */
	size_t reach, step;
	size_t places, origins;         /* constants of a lane; how many numbers may be read */
	bool wild;                      /* the data are not finite */
	double x[VERTICES], y[VERTICES], origin[ORIGINS];       /* room for either precision */
	double first[CELLS], want[CELLS];
} Case;

static char *at(const Case *c, const void *array, size_t i)
{
	return (char *)(uintptr_t)array + i * c->size;
}

static void put(const Case *c, void *to, size_t i, double v)
{
	const float narrow = (float)v;
	memcpy(at(c, to, i), c->size == sizeof v ? (const void *)&v : &narrow, c->size);
}

static double number(const Case *c, const void *p, size_t i)
{
	float narrow;
	double v;
	if (c->size == sizeof v) {
		memcpy(&v, at(c, p, i), sizeof v);
		return v;
	}
	memcpy(&narrow, at(c, p, i), sizeof narrow);
	return (double)narrow;
}

static void call(const Kernel *k, const void *x, const void *y, const void *origin,
	size_t reach, size_t step, size_t count, void *sum)
{
	if (k->runf)
		k->runf(x, y, origin, reach, step, count, sum);
	else
		k->run(x, y, origin, reach, step, count, sum);
}

static size_t vertices(const Case *c, size_t count)
{
	return count ? count + (c->shape->window - 1) * c->reach : 0;
}

/* Two sides of a cell, in order but for one cell in eight, which is empty then. */
static void case_sides(Case *c, size_t place, size_t lane)
{
	const double a = random_real(-2, 2), b = random_real(-2, 2);
	const bool ordered = random_int(0, 7) > 0;
	put(c, c->origin, place * c->lanes + lane, ordered ? fmin(a, b) : fmax(a, b));
	put(c, c->origin, (place + 1) * c->lanes + lane, ordered ? fmax(a, b) : fmin(a, b));
}

static void case_random(Case *c)
{
	for (size_t i = 0; i < VERTICES; i++) {
		put(c, c->x, i, random_real(-2, 2));
		put(c, c->y, i, random_real(-2, 2));
	}
	for (size_t l = 0; l < c->lanes; l++) {
		put(c, c->origin, l, random_real(-2, 2));
		for (size_t place = 0; place + 1 < c->places; place += 2)
			case_sides(c, place, l);
	}
	for (size_t i = 0; i < c->shape->accumulators * c->lanes; i++)
		put(c, c->first, i, random_real(-9, 9));
	memcpy(c->want, c->first, sizeof c->want);
	c->wild = false;
}

/* Adds one item to want, by the scalar kernel. */
static void add_item(Case *c, size_t item)
{
	const size_t lane = item % c->step, turn = item / c->step % c->shape->turns;
	const size_t each = c->shape->accumulators / c->shape->turns;
	double one[CELLS] = { 0 };
	for (size_t k = 0; k < each; k++)
		memcpy(at(c, one, k * c->lanes),
			at(c, c->want, (turn * each + k) * c->lanes + lane), c->size);
	call(c->scalar, at(c, c->x, item), at(c, c->y, item), at(c, c->origin, lane), c->reach,
		1, 1, one);
	for (size_t k = 0; k < each; k++)
		memcpy(at(c, c->want, (turn * each + k) * c->lanes + lane),
			at(c, one, k * c->lanes), c->size);
}

static void define(Case *c, size_t count)
{
	memcpy(c->want, c->first, sizeof c->want);
	for (size_t i = 0; i < count; i++)
		add_item(c, i);
}

static bool same_number(const Case *c, double a, double b)
{
	if (c->wild && !isfinite(a) && !isfinite(b))
		return true;
	return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

/* Are the sums those of the definition? In one lane, if there is one step only. */
static void expect_sums(const Case *c, const void *sum, size_t count, const char *place)
{
	const size_t checked = c->step == 1 ? 1 : c->lanes;
	for (size_t k = 0; k < c->shape->accumulators; k++) {
		for (size_t l = 0; l < checked; l++) {
			const size_t i = k * c->lanes + l;
			const double got = number(c, sum, i), want = number(c, c->want, i);
			if (!expect(same_number(c, got, want), "%s of %zu items, %s: "
				"accumulator %zu of lane %zu is %a, one by one %a", c->form, count,
				place, k, l, got, want))
				return;
		}
	}
}

/* What was last called, for the message about a crash. */
static struct {
	const char *form, *place;
	size_t count;
} now;

static void note(const Case *c, size_t count, const char *place)
{
	now.form = c->form;
	now.place = place;
	now.count = count;
}

/* Guard pages, canaries, unchanged inputs. */

enum { X, Y, ORIGIN, SUM, ARRAYS };

static Guarded guarded[ARRAYS];

static void expect_guarded(Case *c, size_t count, bool back)
{
	const char *place = back ? "all arrays end at a guard page"
		: "all arrays begin at a guard page";
	const size_t points = vertices(c, count) * c->size, origins = c->origins * c->size;
	const size_t cells = c->shape->accumulators * c->lanes * c->size;
	void *x = guarded_put(&guarded[X], c->x, points, back, NOT_A_NUMBER);
	void *y = guarded_put(&guarded[Y], c->y, points, back, NOT_A_NUMBER);
	void *origin = guarded_put(&guarded[ORIGIN], c->origin, origins, back, NOT_A_NUMBER);
	void *sum = guarded_put(&guarded[SUM], c->first, cells, back, CANARY);
	if (!back && !origins)
		origin = guarded[ORIGIN].start - 1;     /* nothing may be read */
	note(c, count, place);
	call(c->kernel, x, y, origin, c->reach, c->step, count, sum);
	expect_sums(c, sum, count, place);
	expect(guarded_kept(&guarded[SUM], sum, cells, CANARY),
		"%s of %zu items writes besides sum", c->form, count);
	expect(memcmp(x, c->x, points) == 0 && memcmp(y, c->y, points) == 0
		&& guarded_kept(&guarded[X], x, points, NOT_A_NUMBER)
		&& guarded_kept(&guarded[Y], y, points, NOT_A_NUMBER)
		&& (!origins || memcmp(origin, c->origin, origins) == 0),
		"%s of %zu items changes its inputs", c->form, count);
}

static void test_counts(Case *c)
{
	const size_t most = VECTORS * c->lanes * c->shape->turns + 2;
	case_random(c);
	for (size_t count = 0; count <= most; count++) {
		expect_guarded(c, count, false);
		expect_guarded(c, count, true);
		add_item(c, count);
	}
}

/* Alignment. */

static void expect_shifted(Case *c, size_t count, const size_t shift[ARRAYS])
{
	static _Alignas(64) char room[ARRAYS][SHIFTS + CELLS * sizeof(double) + SHIFTS];
	char *place[ARRAYS];
	for (int i = 0; i < ARRAYS; i++) {
		memset(room[i], i == SUM ? CANARY : NOT_A_NUMBER, sizeof room[i]);
		place[i] = room[i] + shift[i] * c->size;
	}
	const size_t cells = c->shape->accumulators * c->lanes * c->size;
	memcpy(place[X], c->x, vertices(c, count) * c->size);
	memcpy(place[Y], c->y, vertices(c, count) * c->size);
	memcpy(place[ORIGIN], c->origin, c->places * c->lanes * c->size);
	memcpy(place[SUM], c->first, cells);
	note(c, count, "shifted");
	call(c->kernel, place[X], place[Y], place[ORIGIN], c->reach, c->step, count, place[SUM]);
	expect_sums(c, place[SUM], count, "shifted");
	const Guarded all = { room[SUM], sizeof room[SUM], 0 };
	expect(guarded_kept(&all, place[SUM], cells, CANARY), "%s of %zu items writes besides sum",
		c->form, count);
}

/* Each array alone at each place within 64 bytes, and all of them at different ones. */
static void test_alignment(Case *c)
{
	const size_t places = SHIFTS / c->size;
	case_random(c);
	for (int round = 0; round < 2; round++) {
		const size_t count = (size_t)random_int(1, (int)(VECTORS * c->lanes));
		define(c, count);
		for (size_t s = 0; s < places; s++) {
			for (int i = 0; i < ARRAYS; i++) {
				size_t shift[ARRAYS] = { 0 };
				shift[i] = s;
				expect_shifted(c, count, shift);
			}
			const size_t all[ARRAYS] = {
				s, (3 * s + 1) % places, (5 * s + 2) % places, (7 * s + 3) % places
			};
			expect_shifted(c, count, all);
		}
	}
}

/* NaN and infinity. */

/* One number that is not finite: in a vertex, or in the origin or a sum of a lane that has items
 * for all its turns. */
static void spoil(Case *c, int what, double bad, size_t *count)
{
	const size_t all = c->step * c->shape->turns, most = VECTORS * c->lanes;
	const size_t lane = (size_t)random_int(0, (int)c->step - 1);
	const size_t k = (size_t)random_int(0, (int)c->shape->accumulators - 1);
	*count = (size_t)random_int(what > Y ? (int)all : 1, (int)most);
	const size_t vertex = (size_t)random_int(0, (int)vertices(c, *count) - 1);
	const size_t place = (size_t)random_int(0, c->places ? (int)c->places - 1 : 0);
	switch (what) {
	case X: put(c, c->x, vertex, bad); break;
	case Y: put(c, c->y, vertex, bad); break;
	case ORIGIN: put(c, c->origin, place * c->lanes + lane, bad); break;
	default: put(c, c->first, k * c->lanes + lane, bad); break;
	}
	c->wild = true;
}

static void test_leaks(Case *c)
{
	static const double bad[] = { NAN, INFINITY, -INFINITY };
	const size_t none[ARRAYS] = { 0 };
	for (int round = 0; round < 24; round++) {
		size_t count;
		case_random(c);
		spoil(c, round % ARRAYS, bad[round / ARRAYS % 3], &count);
		define(c, count);
		expect_shifted(c, count, none);
	}
}

/* A kernel in one form of call. */
static void test_form(Case *c, const char *form, size_t reach, size_t step, size_t origins)
{
	c->form = form;
	c->reach = reach;
	c->step = step;
	c->origins = c->places ? (c->places - 1) * c->lanes + origins : 0;
	test_counts(c);
	test_alignment(c);
	test_leaks(c);
}

static void test_forms(const Target *target, const Kernel *kernel)
{
	static Case c;
	c.kernel = kernel;
	c.scalar = defining(target, kernel);
	c.shape = &shapes[kernel->id];
	c.places = places_of(kernel->id);
	c.size = kernel->runf ? sizeof(float) : sizeof(double);
	c.lanes = kernel->runf ? FLOATS : DOUBLES;
	/* scalar kernels take columns of any width */
	const size_t doubles = target->doubles > 1 ? target->doubles : DOUBLES / 2;
	const size_t width = kernel->runf ? 2 * doubles : doubles;
	test_form(&c, "stream", 1, c.lanes, c.lanes);
	test_form(&c, "short ring", 1, 1, c.lanes);
	test_form(&c, "columns", width, width, width);
}

/* Finish kernels: `doubles` rings side by side. */

enum { OUT = Y };

static void expect_finished(const Finish *f, size_t width, size_t stride, bool back)
{
	const Shape *shape = &shapes[f->id];
	const size_t cells = (shape->accumulators - 1) * stride + width;
	const size_t outs = (shape->outputs - 1) * stride + width;
	double sum[EW_MAX_ACCUMULATORS * FLOATS], one[EW_MAX_ACCUMULATORS], want[EW_MAX_OUTPUTS];
	for (size_t i = 0; i < cells; i++)
		sum[i] = random_scaled(-20, 20);
	if (random_int(0, 1))
		sum[(size_t)random_int(0, (int)cells - 1)] = random_int(0, 1) ? NAN : INFINITY;
	const double *from = guarded_put(&guarded[X], sum, cells * sizeof *sum, back, CANARY);
	double *out = guarded_put(&guarded[OUT], NULL, 0, back, CANARY);
	out -= back ? outs : 0;
	f->finish(from, out, stride);
	for (size_t l = 0; l < width; l++) {
		for (size_t k = 0; k < shape->accumulators; k++)
			one[k] = sum[k * stride + l];
		shape->finish(one, want, 1);
		for (size_t j = 0; j < shape->outputs; j++) {
			const double got = out[j * stride + l];
			expect(memcmp(&got, &want[j], sizeof got) == 0
				|| (isnan(got) && isnan(want[j])),
				"output %zu of lane %zu is %a, of one ring %a", j, l, got, want[j]);
			memset(&out[j * stride + l], CANARY, sizeof got);
		}
	}
	expect(guarded_kept(&guarded[OUT], out, 0, CANARY), "writes besides its results");
	expect(memcmp(from, sum, cells * sizeof *sum) == 0, "changes its sums");
}

static void test_finish(const Target *target, const Finish *f)
{
	now.form = "finish";
	now.place = "between guard pages";
	for (int round = 0; round < 100; round++) {
		now.count = (size_t)round;
		expect_finished(f, target->doubles, round / 2 % 2 ? DOUBLES : FLOATS, round % 2);
	}
}

/* Deposits: pieces of edges within the unit cell. */

typedef struct {
	float x[2], y[2];               /* start and end */
} Piece;

/* A coordinate within the cell; now and then a side of it, or close to one. */
static float piece_coordinate(void)
{
	switch (random_int(0, 7)) {
	case 0: return 0;
	case 1: return 1;
	case 2: return 0x1.fffffep-1f;
	case 3: return (float)ldexp(random_real(0, 1), -random_int(10, 140));
	case 4: return (float)random_int(0, 1 << 20) * 0x1p-20f;
	default: return (float)random_real(0, 1);
	}
}

static Piece piece_random(void)
{
	Piece p;
	for (int end = 0; end < 2; end++) {
		p.x[end] = fminf(piece_coordinate(), 1);
		p.y[end] = fminf(piece_coordinate(), 1);
	}
	if (random_int(0, 7) == 0)
		p.x[1] = p.x[0];
	if (random_int(0, 7) == 0)
		p.y[1] = p.y[0];
	return p;
}

static Piece piece_reversed(Piece p)
{
	return (Piece){ { p.x[1], p.x[0] }, { p.y[1], p.y[0] } };
}

static int outputs_of(const ew_filter *filter)
{
	return filter->size * (filter->size + 1);
}

/* One piece alone; `out` takes all its numbers. */
static void deposit_one(ew_deposit *deposit, const ew_filter *filter, Piece p, float *out)
{
	float x[2 * TAKEN] = { p.x[0] }, y[2 * TAKEN] = { p.y[0] }, all[OUTPUTS * TAKEN];
	x[TAKEN] = p.x[1];
	y[TAKEN] = p.y[1];
	deposit(x, y, TAKEN, 1, all);
	for (int k = 0; k < outputs_of(filter); k++)
		out[k] = all[k * TAKEN];
}

static const Deposit *defining_deposit(const Target *target, const Deposit *deposit)
{
	const Target *scalar = find_target(target->bit == EW_PORTABLE ? EW_PORTABLE : EW_FMA);
	for (size_t i = 0; i < scalar->deposit_count; i++) {
		if (scalar->deposits[i].filter == deposit->filter)
			return &scalar->deposits[i];
	}
	abort();
}

/* Outputs of `count` pieces, and what stands behind them in each row: computed to the next multiple
 * of 16, and not touched beyond. */
static void expect_deposited(const Deposit *d, const Deposit *scalar, const Piece *piece,
	const float *out, size_t reach, size_t count)
{
	const size_t taken = (count + TAKEN - 1) / TAKEN * TAKEN;
	for (size_t i = 0; i < count; i++) {
		float want[OUTPUTS];
		deposit_one(scalar->deposit, d->filter, piece[i], want);
		for (int k = 0; k < outputs_of(d->filter); k++)
			expect(memcmp(&out[(size_t)k * reach + i], &want[k], sizeof *want) == 0,
				"piece %zu of %zu (%a, %a) (%a, %a): output %d is %a, alone %a", i,
				count, (double)piece[i].x[0], (double)piece[i].y[0],
				(double)piece[i].x[1], (double)piece[i].y[1], k,
				(double)out[(size_t)k * reach + i], (double)want[k]);
	}
	for (size_t i = taken; i < reach; i++) {
		for (int k = 0; k < outputs_of(d->filter); k++)
			expect(guarded_filled((const char *)&out[(size_t)k * reach + i],
				(const char *)&out[(size_t)k * reach + i + 1], CANARY),
				"%zu pieces: output %d of piece %zu is written", count, k, i);
	}
}

static void expect_deposits(const Deposit *d, const Deposit *scalar, size_t reach, size_t count,
	bool back)
{
	static float x[2 * PIECES], y[2 * PIECES];
	Piece piece[PIECES];
	const size_t bytes = 2 * reach * sizeof *x;
	const size_t all = (size_t)outputs_of(d->filter) * reach * sizeof *x;
	for (size_t i = 0; i < reach; i++) {
		piece[i] = piece_random();
		for (size_t end = 0; end < 2; end++) {
			x[end * reach + i] = piece[i].x[end];
			y[end * reach + i] = piece[i].y[end];
		}
	}
	const float *px = guarded_put(&guarded[X], x, bytes, back, NOT_A_NUMBER);
	const float *py = guarded_put(&guarded[Y], y, bytes, back, NOT_A_NUMBER);
	float *out = guarded_put(&guarded[SUM], NULL, 0, back, CANARY);
	out -= back ? all / sizeof *out : 0;
	now.form = "deposit";
	now.count = count;
	now.place = "between guard pages";
	d->deposit(px, py, reach, count, out);
	expect_deposited(d, scalar, piece, out, reach, count);
	expect(guarded_kept(&guarded[SUM], out, all, CANARY),
		"%zu pieces: writes besides its outputs", count);
	expect(memcmp(px, x, bytes) == 0 && memcmp(py, y, bytes) == 0,
		"%zu pieces: changes its inputs", count);
}

/* The integral of the filter over the region above a piece that lies in its column q and row s, to
 * the end of the support; by ew_NAME in double. */
static double above_piece(const ew_filter *filter, Piece p, int q, int s)
{
	double (*const functions[])(const double *, const double *, size_t, double, double) = {
#define FUNCTION(function, edge, id) function,
		EW_FILTERS_DOUBLE(FUNCTION)
	};
	const int ids[] = {
#define ID(function, edge, id) id,
		EW_FILTERS_DOUBLE(ID)
	};
	const double left = filter->first_x + q, low = filter->first_y + s;
	const double top = filter->last_y + 2;
	const double x[] = {
		left + (double)p.x[0], left + (double)p.x[1], left + (double)p.x[1],
		left + (double)p.x[0]
	};
	const double y[] = { low + (double)p.y[0], low + (double)p.y[1], top, top };
	for (size_t i = 0; i < COUNT(ids); i++) {
		if (ids[i] == filter->ring)
			return functions[i](x, y, 4, 0, 0);
	}
	abort();
}

/* Rows 0 .. r of a column add up to what a pixel gets in whose support the piece lies in row
 * size-1 - r, and all of them to the total, which stands in place of the middle row. An output is
 * off by 16 roundings of float, 2^-24, of numbers below 1; a total, by that at both ends, where P is
 * moved by up to half a unit and rounded by another half; and the middle row by all of these. */
static void expect_integrals(const Deposit *d, Piece p, const float *out)
{
	const int size = d->filter->size, middle = size / 2;
	const double unit = d->filter->unit;
	for (int m = 0; m < size; m++) {
		double sum = 0, rest = 0;
		for (int r = 0; r <= size; r++)
			rest += (r == middle ? 1 : -1) * (double)out[r * size + m] * unit;
		for (int r = 0; r <= size; r++) {
			const double want = above_piece(d->filter, p, size - 1 - m, size - 1 - r);
			const double most = r < middle ? (r + 1) * 0x1p-20
				: (size - r) * 0x1p-20 + 2 * (0x1p-20 + unit);
			sum += r == middle ? rest : (double)out[r * size + m] * unit;
			expect(fabs(sum - want) <= most, "rows 0 to %d of column %d for (%a, %a) "
				"(%a, %a) are %a, not %a: off by %g", r, m, (double)p.x[0],
				(double)p.y[0], (double)p.x[1], (double)p.y[1], sum, want,
				sum - want);
		}
	}
}

/* 0 has no sign here: adding it to an image changes nothing. */
static void expect_piece(const Deposit *d, Piece p)
{
	const int size = d->filter->size;
	float out[OUTPUTS], back[OUTPUTS];
	deposit_one(d->deposit, d->filter, p, out);
	deposit_one(d->deposit, d->filter, piece_reversed(p), back);
	for (int k = 0; k < outputs_of(d->filter); k++)
		expect(out[k] == -back[k], "output %d is %a, reversed %a", k, (double)out[k],
			(double)back[k]);
	for (int m = 0; m < size; m++) {
		const float total = out[size / 2 * size + m];
		expect(rintf(total) == total && fabsf(total) <= 0x1p23f,
			"the total of column %d is %a", m, (double)total);
	}
	expect_integrals(d, p, out);
}

/* Totals depend on the abscissas alone, and add up along an edge: exactly. */
static void expect_totals(const Deposit *d)
{
	const int size = d->filter->size;
	const Piece p = piece_random(), r = piece_random(), parts[] = {
		p, { { p.x[1], r.x[0] }, { r.y[0], r.y[1] } },
		{ { r.x[0], p.x[0] }, { p.y[1], r.y[1] } }
	};
	float out[3][OUTPUTS];
	for (int i = 0; i < 3; i++)
		deposit_one(d->deposit, d->filter, parts[i], out[i]);
	for (int k = size / 2 * size; k < (size / 2 + 1) * size; k++)
		expect(out[0][k] + out[1][k] == -out[2][k], "column %d of a way there and back "
			"adds up to %a", k % size,
			(double)(out[0][k] + out[1][k] + out[2][k]));
}

static void test_deposit(const Target *target, const Deposit *deposit)
{
	const Deposit *scalar = defining_deposit(target, deposit);
	for (size_t reach = TAKEN; reach <= PIECES; reach += TAKEN) {
		for (size_t count = 0; count <= reach; count++) {
			expect_deposits(deposit, scalar, reach, count, false);
			expect_deposits(deposit, scalar, reach, count, true);
		}
	}
	now.place = "one by one";
	for (int i = 0; i < 2000; i++) {
		expect_piece(deposit, piece_random());
		expect_totals(deposit);
	}
}

/* Crashes. */

static sigjmp_buf crashed;

static void jump(int number)
{
	siglongjmp(crashed, number);
}

static void charge(int number)
{
	check.failed = false;
	expect(false, "crashed by signal %d, in a %s of %zu items, %s", number, now.form, now.count,
		now.place);
}

static void test_target(const Target *target)
{
	for (volatile size_t i = 0; i < target->count; i++) {
		check_begin("%s", target->kernels[i].name);
		const int number = sigsetjmp(crashed, 1);
		if (number)
			charge(number);
		else
			test_forms(target, &target->kernels[i]);
		check_end();
	}
	for (volatile size_t i = 0; i < target->finish_count && target->doubles > 1; i++) {
		check_begin("%s", target->finishes[i].name);
		const int number = sigsetjmp(crashed, 1);
		if (number)
			charge(number);
		else
			test_finish(target, &target->finishes[i]);
		check_end();
	}
	for (volatile size_t i = 0; i < target->deposit_count; i++) {
		check_begin("%s", target->deposits[i].name);
		const int number = sigsetjmp(crashed, 1);
		if (number)
			charge(number);
		else
			test_deposit(target, &target->deposits[i]);
		check_end();
	}
}

int main(int argc, char **argv)
{
	static const int signals[] = { SIGSEGV, SIGBUS, SIGILL, SIGFPE };
	check_start(argc, argv);
	for (size_t i = 0; i < COUNT(signals); i++)
		signal(signals[i], jump);
	for (int i = 0; i < ARRAYS; i++)
		guarded[i] = guarded_new(CELLS * sizeof(double) + OUTPUTS * PIECES * sizeof(float));
	for (unsigned bit = 1; strcmp(ew_target_name(bit), "unknown") != 0; bit <<= 1) {
		const Target *target = find_target(bit);
		if (!target)
			printf("skip kernels of %s: not in this build\n", ew_target_name(bit));
		else if (!(ew_targets() & bit))
			printf("skip kernels of %s: this CPU does not run them\n",
				ew_target_name(bit));
		else
			test_target(target);
	}
	return check_finish();
}

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
 * out of items, so which of the two is not compared. Finish kernels are held against the scalar
 * one, lane by lane.
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
	unsigned bit;
	size_t doubles;                 /* in a register; 1 for scalars */
	const Kernel *kernels;
	size_t count;
	const Finish *finishes;
	size_t finish_count;
} Target;

#define KERNEL_DOUBLE(id, kernel, f, a) { #kernel, id, kernel, NULL },
#define KERNEL_FLOAT(id, kernel, f, a) { #kernel, id, NULL, kernel },
#define FINISH(id, finish) { #finish, id, finish },
#define TABLES(TARGET, target, doubles) \
	static const Kernel kernels_##target[] = { \
		EW_RINGS_##TARGET##_DOUBLE(KERNEL_DOUBLE) EW_RINGS_##TARGET##_FLOAT(KERNEL_FLOAT) \
	}; \
	static const Finish finishes_##target[] = { EW_FINISHES_##TARGET(FINISH) };
EW_TARGETS(TABLES)

#define COUNT(table) (sizeof(table) / sizeof *(table))
#define TARGET_ROW(TARGET, target, doubles) { EW_##TARGET, doubles, \
	kernels_##target, COUNT(kernels_##target), finishes_##target, COUNT(finishes_##target) },
static const Target targets[] = { EW_TARGETS(TARGET_ROW) };

typedef struct {
	size_t window, turns, accumulators, outputs;
	ew_ring_finish *finish;
} Shape;

#define SHAPE(id, window, turns, accumulators, outputs, finish) \
	{ window, turns, accumulators, outputs, finish },
static const Shape shapes[] = { EW_RINGS_SHAPES(SHAPE) };

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
	size_t origins;                 /* how many the kernel may read */
	bool wild;                      /* the data are not finite */
	double x[VERTICES], y[VERTICES], origin[FLOATS];        /* room for either precision */
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

static void case_random(Case *c)
{
	for (size_t i = 0; i < VERTICES; i++) {
		put(c, c->x, i, random_real(-2, 2));
		put(c, c->y, i, random_real(-2, 2));
	}
	for (size_t l = 0; l < c->lanes; l++)
		put(c, c->origin, l, random_real(-2, 2));
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
	memcpy(place[ORIGIN], c->origin, c->lanes * c->size);
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
	switch (what) {
	case X: put(c, c->x, vertex, bad); break;
	case Y: put(c, c->y, vertex, bad); break;
	case ORIGIN: put(c, c->origin, lane, bad); break;
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
	c->origins = c->shape->window == 3 ? origins : 0;
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
}

int main(int argc, char **argv)
{
	static const int signals[] = { SIGSEGV, SIGBUS, SIGILL, SIGFPE };
	check_start(argc, argv);
	for (size_t i = 0; i < COUNT(signals); i++)
		signal(signals[i], jump);
	for (int i = 0; i < ARRAYS; i++)
		guarded[i] = guarded_new(CELLS * sizeof(double));
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

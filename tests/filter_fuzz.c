/* Fuzzing of the reader of filter files and of the analysis; tests/filter_fuzz.sh builds and runs
 * it, with libFuzzer or with the driver tests/fuzz_driver.c.
 *
 * An input is the text of a file. Either it is refused, with a message that has a line and a column
 * inside the text, a caret and only printable characters; or it is a filter, whose members keep
 * their promises and whose canonical text reads as the same filter, analysis included.
 *
 * The linker hands the calls of fatal, reading, allocate, realloc and free to the functions here
 * (--wrap): a refusal comes back by longjmp, as if gen ended, so what a Text held then is freed
 * here; and every allocation is one of malloc, exactly to size, so that address sanitizer sees
 * every touch beyond.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../gen/gen.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
void *__wrap_allocate(size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__real_realloc(void *old, size_t size);
void __wrap_free(void *old);
void __real_free(void *old);
void __wrap_reading(Locate *locate, const void *reader);
void __wrap_fatal(int status, const char *pattern, ...) __attribute__((noreturn));

/* Memory comes back soon enough that pages are not touched anew by every run. */
const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
	return "quarantine_size_mb=4";
}

static struct {
	jmp_buf refused;
	Locate *locate;
	const void *reader;
	int status;
	char message[2000];
	void **block;                           /* what was allocated and not freed */
	size_t blocks, room;
} run;

static void *remember(void *p)
{
	if (run.blocks == run.room) {
		run.room = 2 * run.room + 1000;
		run.block = __real_realloc(run.block, run.room * sizeof *run.block);
	}
	if (!run.block || !p)
		abort();
	return run.block[run.blocks++] = p;
}

static void forget(const void *p)
{
	for (size_t i = run.blocks; i-- > 0; )
		if (run.block[i] == p) {
			run.block[i] = run.block[--run.blocks];
			return;
		}
}

void *__wrap_allocate(size_t size)
{
	void *p = __real_realloc(NULL, size + (size == 0));
	return p ? remember(memset(p, 0, size)) : remember(NULL);
}

void *__wrap_realloc(void *old, size_t size)
{
	if (old)
		forget(old);
	return remember(__real_realloc(old, size));
}

void __wrap_free(void *old)
{
	if (old)
		forget(old);
	__real_free(old);
}

void __wrap_reading(Locate *locate, const void *reader)
{
	run.locate = locate;
	run.reader = reader;
}

void __wrap_fatal(int status, const char *pattern, ...)
{
	va_list arguments;
	Locate *locate = run.locate;
	va_start(arguments, pattern);
	vsnprintf(run.message, sizeof run.message, pattern, arguments);
	va_end(arguments);
	run.locate = NULL;
	if (locate)
		snprintf(run.message, sizeof run.message, "%s", locate(run.reader,
			format("%s", run.message)));
	run.status = status;
	longjmp(run.refused, 1);
}

static void fail(const char *why)
{
	fprintf(stderr, "%s: %s\n", why, run.message);
	abort();
}

static void expect(int promise, const char *why)
{
	if (!promise)
		fail(why);
}

/* ---- what must hold ---- */

static int is_whole(Rat a)
{
	return a.den == 1;
}

static void check_message(const char *text)
{
	int line, column, end = 0, lines = 1;
	for (const char *p = text; *p; ++p)
		lines += *p == '\n';
	expect(run.status == EXIT_USAGE, "refused with another status");
	expect(sscanf(run.message, "input: line %d, column %d: %n", &line, &column, &end) == 2
		&& end > 0, "no line and column");
	expect(line >= 1 && line <= lines && column >= 1, "a spot outside the text");
	const size_t length = strlen(run.message);
	expect(length > 5 && run.message[length - 1] == '^', "no caret");
	for (size_t i = 0, step; i < length; i += step) {
		step = utf8_size(run.message + i);
		expect(step > 0 && (step > 1 || run.message[i] == '\n' || run.message[i] == '\t'
			|| (run.message[i] >= ' ' && run.message[i] < 127)),
			"a message that cannot be printed");
	}
}

static void check_piece(const Filter *filter, int i)
{
	const Piece *piece = &filter->piece[i], *last = i ? piece - 1 : NULL;
	expect(rat_compare(piece->x0, piece->x1) < 0, "an empty piece");
	expect(piece->value.count > 0, "a piece that is 0");
	if (last && filter->separable)
		expect(rat_compare(last->x1, piece->x0) <= 0, "pieces overlap or are not in order");
	if (last && !filter->separable)
		expect(rat_compare(last->x0, piece->x0) < 0
			|| rat_compare(last->y1, piece->y0) <= 0, "pieces are not in order");
	if (filter->separable)
		expect(rat_is(piece->y0, 0) && rat_is(piece->y1, 0), "y of a separable piece");
	else
		expect(rat_compare(piece->y0, piece->y1) < 0, "an empty piece");
	expect(rat_compare(piece->x0, filter->first_x) >= 0
		&& rat_compare(piece->x1, filter->last_x) <= 0, "a piece outside the support");
	if (filter->size_x)
		expect(is_whole(rat_sub(piece->x0, filter->first_x)), "not aligned");
}

static void check_filter(const Filter *filter)
{
	expect(filter->pieces > 0, "no pieces");
	for (int i = 0; i < filter->pieces; ++i)
		check_piece(filter, i);
	expect(filter->degree >= 0 && filter->degree <= MAX_DEGREE, "degree");
	/* that of a pyramid of boxes is one less than its degree, and no compact one does better */
	expect(filter->continuity >= -1 && filter->continuity < filter->degree
		+ (filter->degree == 0), "smoother than a spline");
	expect(!filter->size_x || rat_is(rat_sub(filter->last_x, filter->first_x),
		filter->size_x), "not as wide as it says");
	expect(!filter->size_y || rat_is(rat_sub(filter->last_y, filter->first_y),
		filter->size_y), "not as high as it says");
	expect(!filter->unity || rat_is(filter->integral, 1), "unity without normalisation");
	if (filter->even)
		expect(rat_compare(filter->first_x, rat_neg(filter->last_x)) == 0,
			"even, but not symmetric");
}

static void check_same(const Filter *a, const Filter *b)
{
	expect(strcmp(filter_canonical(a), filter_canonical(b)) == 0, "another canonical text");
	expect(strcmp(filter_summary(a), filter_summary(b)) == 0, "another analysis");
	expect(a->size_x == b->size_x && a->size_y == b->size_y && a->pieces == b->pieces
		&& rat_compare(a->first_x, b->first_x) == 0
		&& rat_compare(a->first_y, b->first_y) == 0, "another support");
}

static void read_text(const char *text, size_t size)
{
	run.locate = NULL;
	if (setjmp(run.refused)) {
		check_message(text);
		return;
	}
	Filter filter = filter_parse("input", text, size);
	check_filter(&filter);
	if (setjmp(run.refused))
		fail("its canonical text is refused");
	const char *canonical = filter_canonical(&filter);
	Filter again = filter_parse("input", canonical, strlen(canonical));
	check_same(&filter, &again);
	Text shown = { 0 };
	filter_show(&shown, &filter, "text");
	filter_show(&shown, &filter, "json");
	text_free(&shown);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
	static bool started;
	if (!started)
		copy_string("", 0);             /* the first chunk of the arena stays */
	started = true;
	const Mark mark = arena_mark();
	char *text = malloc(size + 1);
	if (!text)
		abort();
	if (size)
		memcpy(text, data, size);
	text[size] = 0;
	read_text(text, size);
	__real_free(text);
	while (run.blocks)
		__real_free(run.block[--run.blocks]);
	arena_release(mark);
	return 0;
}

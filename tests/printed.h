/* printed.h - lines that an example prints with --exact, read from the standard input: a word, and
 * numbers.
 *
 * next_line() makes `line` the first one, and every line taken makes it the next; behind the last
 * one it is empty. What is not as it must be ends the program, as a failed test. */
#ifndef PRINTED_H
#define PRINTED_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char line[1 << 12];      /* without its end */
static long line_number;

static inline void malformed(const char *expected)
{
	printf("not ok input: line %ld: expected %s, not '%.40s'\n0 passed, 1 failed\n",
		line_number, expected, line);
	exit(1);
}

static inline void next_line(void)
{
	line_number++;
	if (!fgets(line, sizeof line, stdin))
		line[0] = '\0';
	else if (!strchr(line, '\n'))
		malformed("a whole line");
	line[strcspn(line, "\n")] = '\0';
}

static inline bool starts_with(const char *word)
{
	return !strncmp(line, word, strlen(word));
}

/* The line: a word, and exactly `count` numbers. Goes to the next one. */
static inline void take_numbers(const char *word, double *out, int count)
{
	char *end = line + strlen(word);
	if (!starts_with(word))
		malformed(word);
	for (int i = 0; i < count; i++) {
		const char *text = end;
		out[i] = strtod(text, &end);
		if (end == text)
			malformed("a number more");
	}
	if (*end)
		malformed("fewer numbers");
	next_line();
}

/* Likewise, and no NaN or infinity. */
static inline void take_finite(const char *word, double *out, int count)
{
	take_numbers(word, out, count);
	for (int i = 0; i < count; i++)
		if (!isfinite(out[i]))
			malformed("finite numbers above");
}

/* Memory for what is read. */
static inline void *resize(void *array, size_t bytes)
{
	void *grown = realloc(array, bytes ? bytes : 1);
	if (!grown)
		malformed("less than fills the memory");
	return grown;
}

#endif

/* command_line.h - what a program is told, and how it ends, for the examples that read outlines.
 *
 * It ends with 0, with 1 if it cannot do what it was told, or with 2 if that makes no sense. */
#ifndef COMMAND_LINE_H
#define COMMAND_LINE_H

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
	const char *usage;
	char **operands;
	int count;
	bool exact;
} CommandLine;

static inline void stop(const char *what, const char *name)
{
	fprintf(stderr, "%s %s: %s\n", what, name, strerror(errno));
	exit(1);
}

static inline int finish_output(void)
{
	if (fflush(stdout) || ferror(stdout))
		stop("cannot write", "standard output");
	return 0;
}

static inline int refuse(const CommandLine *line)
{
	fputs(line->usage, stderr);
	return 2;
}

/* An option that all of them have, which may end the program, or an operand. The operands replace
 * the arguments before them. */
static inline void take_argument(CommandLine *line, char *argument)
{
	if (!strcmp(argument, "--exact")) {
		line->exact = true;
	} else if (!strcmp(argument, "--help")) {
		fputs(line->usage, stdout);
		exit(finish_output());
	} else if (argument[0] == '-') {
		exit(refuse(line));
	} else {
		line->operands[line->count++] = argument;
	}
}

#endif

/* util.c - memory, text and the two ways to stop.
 *
 * One arena serves the whole process: passes allocate freely and a caller that loops over kernels
 * takes a mark and releases it. Its chunks hang on one list, so that leak checkers see them.
 * Text lives outside the arena because it outlasts the marks.
 *
 * fatal() is the user's mistake: a message that says what to do, exit status as given,
 * nothing written. While a text of the user's is being read, the reader says where it is,
 * so that an overflow deep inside has a line and a column too.
 * bug() is ours: a failed proof or a broken invariant; it aborts.
 *
 * The arena and the place being read are the only mutable state of gen that outlives a function. */
#include "gen.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 1 << 20, CHUNKS = 1 << 14 };
static struct { char *data[CHUNKS]; size_t room[CHUNKS]; size_t count, used; } arena;
static struct { Locate *locate; const void *reader; } place;

static void out_of_memory(void)
{
	fputs("gen: out of memory\n", stderr);
	exit(EXIT_DIFFERENT);
}

static void arena_grow(size_t size)
{
	if (arena.count == CHUNKS)
		out_of_memory();
	size_t room = size > CHUNK ? size : CHUNK;
	char *data = malloc(room);
	if (!data)
		out_of_memory();
	arena.data[arena.count] = data;
	arena.room[arena.count++] = room;
	arena.used = 0;
}

void *allocate(size_t size)
{
	size = (size + 15) & ~(size_t)15;
	if (arena.count == 0 || arena.room[arena.count - 1] - arena.used < size)
		arena_grow(size);
	char *data = arena.data[arena.count - 1] + arena.used;
	arena.used += size;
	return memset(data, 0, size);
}

Mark arena_mark(void)
{
	return (Mark){ arena.count, arena.used };
}

void arena_release(Mark mark)
{
	while (arena.count > mark.chunk)
		free(arena.data[--arena.count]);
	arena.used = mark.used;
}

char *copy_string(const char *text, size_t size)
{
	char *copy = allocate(size + 1);
	memcpy(copy, text, size);
	return copy;
}

static char *format_list(const char *pattern, va_list args)
{
	va_list again;
	va_copy(again, args);
	int size = vsnprintf(NULL, 0, pattern, again);
	va_end(again);
	char *result = allocate((size_t)size + 1);
	vsnprintf(result, (size_t)size + 1, pattern, args);
	return result;
}

char *format(const char *pattern, ...)
{
	va_list args;
	va_start(args, pattern);
	char *result = format_list(pattern, args);
	va_end(args);
	return result;
}

static void text_reserve(Text *text, size_t size)
{
	if (text->room - text->size > size)
		return;
	text->room = 2 * text->room + size + 256;
	text->data = realloc(text->data, text->room);
	if (!text->data)
		out_of_memory();
}

void text_append(Text *text, const char *data, size_t size)
{
	text_reserve(text, size);
	memcpy(text->data + text->size, data, size);
	text->size += size;
	text->data[text->size] = 0;
}

void text_add(Text *text, const char *pattern, ...)
{
	va_list args;
	va_start(args, pattern);
	int size = vsnprintf(NULL, 0, pattern, args);
	va_end(args);
	text_reserve(text, (size_t)size);
	va_start(args, pattern);
	vsnprintf(text->data + text->size, (size_t)size + 1, pattern, args);
	va_end(args);
	text->size += (size_t)size;
}

char *text_take(Text *text)
{
	char *copy = copy_string(text->size ? text->data : "", text->size);
	text_free(text);
	return copy;
}

void text_free(Text *text)
{
	free(text->data);
	*text = (Text){ 0 };
}

uint64_t text_hash(const char *data, size_t size)
{
	uint64_t hash = 0xcbf29ce484222325u;   /* offset basis and prime of FNV-1a */
	for (size_t i = 0; i < size; ++i)
		hash = (hash ^ (unsigned char)data[i]) * 0x100000001b3u;
	return hash;
}

void reading(Locate *locate, const void *reader)
{
	place.locate = locate;
	place.reader = reader;
}

void fatal(int status, const char *pattern, ...)
{
	va_list args;
	Locate *locate = place.locate;
	place.locate = NULL;
	va_start(args, pattern);
	const char *message = format_list(pattern, args);
	va_end(args);
	fflush(stdout);
	fprintf(stderr, "gen: %s\n", locate ? locate(place.reader, message) : message);
	exit(status);
}

void bug(const char *pattern, ...)
{
	va_list args;
	va_start(args, pattern);
	const char *message = format_list(pattern, args);
	va_end(args);
	fflush(stdout);
	fprintf(stderr, "gen: internal error, nothing was written: %s\n", message);
	abort();
}

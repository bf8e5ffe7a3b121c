/* guarded.h - memory between two inaccessible pages, so that a touch too far is a crash.
 *
 * Data stand either at the front, directly behind one such page, or at the back, directly before
 * the other. Include it before any system header: mmap of nothing is no POSIX.
 */
#ifndef GUARDED_H
#define GUARDED_H

#ifndef _DEFAULT_SOURCE
#define _DEFAULT_SOURCE
#endif
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

typedef struct {
	char *start;
	size_t bytes, page;
} Guarded;

static inline Guarded guarded_new(size_t least)
{
	Guarded g;
	g.page = (size_t)sysconf(_SC_PAGESIZE);
	g.bytes = (least + g.page - 1) / g.page * g.page;
	char *all = mmap(NULL, g.bytes + 2 * g.page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
	if (all == MAP_FAILED)
		abort();
	g.start = all + g.page;
	if (mprotect(g.start, g.bytes, PROT_READ | PROT_WRITE))
		abort();
	return g;
}

static inline void guarded_free(Guarded *g)
{
	munmap(g->start - g->page, g->bytes + 2 * g->page);
}

/* Where count bytes touch the front or the back page. */
static inline void *guarded_place(const Guarded *g, size_t count, bool back)
{
	return g->start + (back ? g->bytes - count : 0);
}

/* Everything is set to filler, then data placed at the front or the back. */
static inline void *guarded_put(Guarded *g, const void *data, size_t count, bool back, int filler)
{
	void *place = guarded_place(g, count, back);
	memset(g->start, filler, g->bytes);
	if (count)
		memcpy(place, data, count);
	return place;
}

static inline bool guarded_filled(const char *from, const char *to, int filler)
{
	return from == to || (*from == (char)filler
		&& memcmp(from, from + 1, (size_t)(to - from) - 1) == 0);
}

/* Is everything besides count bytes at place still filler? */
static inline bool guarded_kept(const Guarded *g, const void *place, size_t count, int filler)
{
	const char *from = place;
	return guarded_filled(g->start, from, filler)
		&& guarded_filled(from + count, g->start + g->bytes, filler);
}

/* A copy of data at the front or the back, which nobody may write. */
static inline void *guarded_copy(Guarded *g, const void *data, size_t count, bool back)
{
	void *place = guarded_place(g, count, back);
	mprotect(g->start, g->bytes, PROT_READ | PROT_WRITE);
	memcpy(place, data, count);
	mprotect(g->start, g->bytes, PROT_READ);
	return place;
}

#endif

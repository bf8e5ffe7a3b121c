/* peers.h - small interfaces to other libraries: those that measure polygons (Peer) and those that
 * draw them (Painter).
 *
 * Each stands in a file of its own. Polygons are prepared before anything is timed; a task then
 * walks over them with the library's own functions, as its users would, and writes the results of
 * ring i at out + i * (1 for the area, 2 for the centroid, 10 for the moments to degree 3 in the
 * order of EW_INDEX). A painter draws into 8 bits per pixel, and what it does there, clearing
 * included, is timed. A library that was not installed when the bench was built is represented by
 * peer_absent.c, which has no `prepare`. */
#ifndef PEERS_H
#define PEERS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { PEER_AREA, PEER_CENTROID, PEER_MOMENTS, PEER_TASKS };

typedef struct {
	/* NULL if the library is not there.
	 * Rings are closed: ring i is vertices offsets[i] .. offsets[i + 1] - 1, first == last. */
	void *(*prepare)(const double *x, const double *y, const int32_t *offsets, size_t rings);
	void (*release)(void *set);
	void (*task[PEER_TASKS])(const void *set, double *out);    /* NULL: not offered */
} Peer;

#define PEERS(X) X(GEOS) X(Boost) X(CGAL) X(OpenCV)
#define PEER_DECLARE(name) extern const Peer peer_##name;
PEERS(PEER_DECLARE)

/* A polygon and the size of its image. y points down; pixel (i,j) is the square from (i,j) to
 * (i+1,j+1). Ring i is vertices offsets[i] .. offsets[i + 1] - 1, closed by an edge from the last
 * to the first; inside is where the winding number is not 0. All of it lies in the image. */
typedef struct {
	size_t rings;
	const int32_t *offsets;
	const double *x, *y;
	int width, height, stride;     /* bytes from row to row; a multiple of 4, as cairo wants */
} Scene;

/* A character of a font, in its own units, y up: EW_MOVE, EW_LINE, EW_QUAD, EW_CLOSE. */
typedef struct {
	unsigned char *verb;
	double *point;                 /* x, y, x, y, ... */
	size_t verbs, points;
	double em;                     /* units per em */
} Outline;

typedef struct {
	/* NULL if the library is not there. NULL from it: the polygon is more than it takes. */
	void *(*prepare)(const Scene *scene, unsigned char *pixels);
	void (*release)(void *picture);
	void (*draw)(void *picture);   /* clears and draws */
	/* 0 if the file is no font; what it gives is to be freed. NULL: not offered. */
	int (*outline)(const char *font, int character, Outline *outline);
} Painter;

#define PAINTERS(X) X(FreeType) X(cairo) X(AGG) X(stb)
#define PAINTER_DECLARE(name) extern const Painter painter_##name;
PAINTERS(PAINTER_DECLARE)

#ifdef __cplusplus
}
#endif

#endif

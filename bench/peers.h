/* peers.h - one small interface to other libraries that measure polygons.
 *
 * Each peer stands in a file of its own. Its polygons are prepared before anything is timed; a
 * task then walks over them with the peer's own functions, as its users would, and writes the
 * results of ring i at out + i * (1 for the area, 2 for the centroid, 10 for the moments to
 * degree 3 in the order of EW_INDEX). A library that was not installed when the bench was built
 * is represented by peer_absent.c, which has no `prepare`. */
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

#ifdef __cplusplus
}
#endif

#endif

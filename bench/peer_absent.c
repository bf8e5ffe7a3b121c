/* peer_absent.c - stands for a library that was not installed when the bench was built.
 *
 * Compiled with PEER defined as the name of the peer, instead of the peer's own file. Which of the
 * two kinds it would have been is not asked: an object that nobody refers to does no harm. */
#include "peers.h"

#define JOIN(a, b) a##b
#define OBJECT(kind, name) JOIN(kind, name)

const Peer OBJECT(peer_, PEER) = { NULL, NULL, { NULL, NULL, NULL } };
const Painter OBJECT(painter_, PEER) = { NULL, NULL, NULL, NULL };

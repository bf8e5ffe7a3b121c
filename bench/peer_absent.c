/* peer_absent.c - stands for a library that was not installed when the bench was built.
 *
 * Compiled with PEER defined as the name of the peer, instead of the peer's own file. */
#include "peers.h"

#define JOIN(a, b) a##b
#define OBJECT(name) JOIN(peer_, name)

const Peer OBJECT(PEER) = { NULL, NULL, { NULL, NULL, NULL } };

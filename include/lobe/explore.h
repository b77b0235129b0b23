/* lobe/explore.h: the interactive page: served on the loopback address, or written as static files.
 * liblobe_explore.
 *
 *     lobe_explore_server *server = NULL;
 *     if (lobe_explore_start(8080, &server) == LOBE_EXPLORE_OK)
 *         printf("http://127.0.0.1:%d/\n", lobe_explore_port(server));
 *     ...
 *     lobe_explore_stop(server);
 *
 * The page's files are part of the library; nothing is read from the disk. */
#ifndef LOBE_EXPLORE_H
#define LOBE_EXPLORE_H

#include "types.h"

LOBE_BEGIN_C

typedef enum lobe_explore_result {
    LOBE_EXPLORE_OK,
    LOBE_EXPLORE_TAKEN,     /* another program listens on the port */
    LOBE_EXPLORE_BAD_INPUT, /* a port or folder is unusable */
    LOBE_EXPLORE_FAILED     /* memory, network, file; or the library was built without the page */
} lobe_explore_result;

/* "WHERE: WHAT; HINT" of the last call of this thread that was not LOBE_EXPLORE_OK. */
LOBE_API const char *lobe_explore_error_message(void);

typedef struct lobe_explore_server lobe_explore_server;

/* Serves the page on 127.0.0.1, by a thread of its own, until lobe_explore_stop. `port`: 0 to 65535; 0:
 * any that is free. Answers GET and HEAD, of at most 64 connections at once, each of which is closed
 * after 5 seconds of silence. *server is NULL after anything but LOBE_EXPLORE_OK. */
LOBE_API lobe_explore_result lobe_explore_start(int port, lobe_explore_server **server);
LOBE_API int lobe_explore_port(const lobe_explore_server *server);
LOBE_API void lobe_explore_stop(lobe_explore_server *server); /* NULL is fine */

/* Writes the page into a folder that does not exist yet, or is empty: whole or not at all. */
LOBE_API lobe_explore_result lobe_explore_write(const char *folder);

LOBE_END_C

#endif

/* A small server of HTTP/1.1 in a thread of its own: one request a connection, few connections at once, each
 * bounded in size and time. */
#pragma once

#include "watch/http.h"
#include "watch/socket.h"

/* What a request is answered with. */
typedef struct watch_answer {
    int status;
    const char *type; /* of the body */
    size_t size;
    char *body; /* from malloc; the server frees it */
} watch_answer;

/* Answers a request in the server's thread, or returns false: it is asked again after the next
 * watch_server_wake, and at last, with `last`, when it is to answer in any case. */
typedef bool watch_handler(void *user, const watch_request *request, bool last, watch_answer *answer);

typedef struct watch_server watch_server;

/* Begins to serve at `place`, whose port 0 becomes a free one. Errors: OPEN, MEMORY. */
aur_result watch_server_create(const char *option, watch_place *place, watch_handler *handler, void *user,
                               watch_server **server, aur_error *error);
/* There is something new for those who wait. From any thread. */
void watch_server_wake(watch_server *server);
/* Drops all connections. NULL is allowed. */
void watch_server_destroy(watch_server *server);

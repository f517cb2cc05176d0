/* A small server of HTTP/1.1, in a thread of its own: one request per connection, few connections at once,
 * each bounded in size and time. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>

/* Places on the network: read from text, listened at, connected to. */

enum { WATCH_HOST_CAPACITY = 256 };

typedef struct watch_place {
    char host[WATCH_HOST_CAPACITY]; /* without brackets */
    unsigned port;
} watch_place;

/* Reads "PORT", "HOST:PORT" or "[HOST]:PORT"; without a host `place` keeps the one that it has, and with an
 * empty text its port too. `option` stands in messages. Errors: ARGUMENT. */
aur_result watch_place_read(const char *option, const char *text, watch_place *place, aur_error *error);

/* "127.0.0.1:8080", with brackets about a host that has colons. */
void watch_place_write(const watch_place *place, size_t capacity, char *text);

/* A socket that listens there, closed by the caller; port 0 becomes the free one that was found. Errors:
 * OPEN.
 */
aur_result watch_listen(const char *option, watch_place *place, int *listener, aur_error *error);
/* A socket that is connected. Errors: OPEN. */
aur_result watch_connect(const char *option, const watch_place *place, int *connection, aur_error *error);

/* The answer to a request. */
typedef struct watch_answer {
    int status;
    const char *type; /* of the body; NULL: plain text */
    size_t size;
    char *body; /* from malloc; the server frees it */
} watch_answer;

/* Answers a request ("GET", "/target") in the server's thread, or returns false: the request waits, and the
 * handler is called again after the next watch_server_wake. With `last` it must answer. */
typedef bool watch_handler(void *user, const char *method, const char *target, bool last,
                           watch_answer *answer);

/* The module's own server begins with this. */
typedef struct watch_server {
    const struct watch_server_module *module;
} watch_server;

/* Begins to serve at `place`, whose port 0 becomes a free one. Errors: OPEN, UNSUPPORTED (an installation
 * without the module). */
aur_result watch_server_create(const char *option, watch_place *place, watch_handler *handler, void *user,
                               watch_server **server, aur_error *error);
/* Calls the handler again for the requests that wait. From any thread. NULL is allowed. */
void watch_server_wake(watch_server *server);
/* Drops all connections. NULL is allowed. */
void watch_server_destroy(watch_server *server);

/* What the module (src/program/serve) has under the name `aureole_serve`; it stands beside the libraries and
 * is loaded when somebody asks for a server. */
typedef struct watch_server_module {
    /* Takes the listening socket over; false where it cannot serve, with errno. */
    bool (*create)(int listener, watch_handler *handler, void *user, watch_server **server);
    void (*wake)(watch_server *server);
    void (*destroy)(watch_server *server);
} watch_server_module;

extern __attribute__((visibility("default"))) const watch_server_module aureole_serve;

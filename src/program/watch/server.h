/* A small HTTP/1.1 server in a separate thread: one request per connection, few connections, each with limits
 * on size and time. */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>

/* Network endpoints: parsing, listening, connecting. */

enum { WATCH_HOST_CAPACITY = 256 };

typedef struct watch_endpoint {
    char host[WATCH_HOST_CAPACITY]; /* without brackets */
    unsigned port;
} watch_endpoint;

/* Parses "PORT", "HOST:PORT" or "[HOST]:PORT" into `endpoint`; omitted parts are unchanged. `option` is for
 * messages. Errors: ARGUMENT. */
aur_result watch_endpoint_parse(const char *option, const char *text, watch_endpoint *endpoint,
                                aur_error *error);

/* Formats "127.0.0.1:8080", with brackets around a host that contains colons. */
void watch_endpoint_format(const watch_endpoint *endpoint, size_t capacity, char *text);

/* A listening socket, closed by the caller; port 0 becomes the assigned one. Errors: OPEN. */
aur_result watch_listen(const char *option, watch_endpoint *endpoint, int *listener, aur_error *error);
/* A connected socket. Errors: OPEN. */
aur_result watch_connect(const char *option, const watch_endpoint *endpoint, int *connection,
                         aur_error *error);

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

/* The first member of the module's server object. */
typedef struct watch_server {
    const struct watch_server_module *module;
} watch_server;

/* Starts a server at `endpoint`, whose port 0 becomes the assigned one. Errors: OPEN, UNSUPPORTED (an
 * installation without the module). */
aur_result watch_server_create(const char *option, watch_endpoint *endpoint, watch_handler *handler,
                               void *user, watch_server **server, aur_error *error);
/* Calls the handler again for waiting requests. Thread-safe. NULL is allowed. */
void watch_server_wake(watch_server *server);
/* Drops all connections. NULL is allowed. */
void watch_server_destroy(watch_server *server);

/* The functions of the module (src/program/serve), exported as `aureole_serve`; it is installed next to the
 * libraries and loaded on demand. */
typedef struct watch_server_module {
    /* Takes ownership of the listening socket; false on failure, with errno. */
    bool (*create)(int listener, watch_handler *handler, void *user, watch_server **server);
    void (*wake)(watch_server *server);
    void (*destroy)(watch_server *server);
} watch_server_module;

extern __attribute__((visibility("default"))) const watch_server_module aureole_serve;

/* The server of `--serve`, based on GNU libmicrohttpd, in a separate module: the library loads ten others,
 * which takes as long as rendering a small image. */
#include <math.h>
#include <microhttpd.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "program/watch/server.h"

/* Bytes of a request's line and header fields, simultaneous connections, and milliseconds between checks for
 * a wake-up. */
enum { REQUEST_CAPACITY = 8192, MOST_CONNECTIONS = 32, TICK = 20 };

/* Seconds until a request must be complete, until a waiting request is answered, and between two sent bytes.
 */
static const double READING = 10.0, WAITING = 15.0;
static const unsigned SENDING = 20;

typedef struct connection {
    struct MHD_Connection *handle; /* NULL: this entry is free */
    bool waits;
    double until; /* time limit for the request, or for a late answer */
} connection;

typedef struct http_server {
    watch_server base; /* must be the first member */
    watch_handler *handler;
    void *user;
    struct MHD_Daemon *daemon;
    atomic_bool stop, woken;
    pthread_t thread;
    connection connections[MOST_CONNECTIONS]; /* of the thread */
} http_server;

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int socket_of(struct MHD_Connection *handle) {
    return MHD_get_connection_info(handle, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd;
}

static void notify(void *shared, struct MHD_Connection *handle, void **slot,
                   enum MHD_ConnectionNotificationCode what) {
    http_server *const server = shared;
    if (what == MHD_CONNECTION_NOTIFY_STARTED) {
        connection *c = server->connections;
        while (c->handle != NULL) /* there are as many entries as connections */
            ++c;
        *c = (connection){.handle = handle, .until = now() + READING};
        *slot = c;
        return;
    }
    /* Unread input would reset the connection before the client has read the answer. */
    char rest[512];
    for (int i = 0; i < 16 && recv(socket_of(handle), rest, sizeof rest, MSG_DONTWAIT) > 0; ++i)
        continue;
    ((connection *)*slot)->handle = NULL;
}

/* The status of a request that is answered without the handler, or 0. Bodies are not accepted. */
static int refuse(struct MHD_Connection *handle, const char *target) {
    const char *const size = MHD_lookup_connection_value(handle, MHD_HEADER_KIND, "Content-Length");
    if (target[0] != '/')
        return 400;
    if ((size != NULL && strcmp(size, "0") != 0) ||
        MHD_lookup_connection_value(handle, MHD_HEADER_KIND, "Transfer-Encoding") != NULL)
        return 413;
    return 0;
}

static enum MHD_Result send_answer(struct MHD_Connection *handle, const watch_answer *answer) {
    /* Restricts the page to its script and data, and hides its address from other sites. */
    const char *const fields[][2] = {
        {"Content-Type", answer->type != NULL ? answer->type : "text/plain; charset=utf-8"},
        {"Connection", "close"},
        {"Cache-Control", "no-store"},
        {"Referrer-Policy", "no-referrer"},
        {"X-Content-Type-Options", "nosniff"},
        {"Content-Security-Policy",
         "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
         "connect-src 'self'; frame-ancestors 'none'"}};
    struct MHD_Response *const response =
        MHD_create_response_from_buffer(answer->size, answer->body, MHD_RESPMEM_MUST_FREE);
    if (response == NULL) {
        free(answer->body);
        return MHD_NO;
    }
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; ++i)
        MHD_add_response_header(response, fields[i][0], fields[i][1]);
    const enum MHD_Result result = MHD_queue_response(handle, (unsigned)answer->status, response);
    MHD_destroy_response(response);
    return result;
}

/* Called when the header fields of a request are complete, and after MHD_resume_connection. */
static enum MHD_Result handle_request(void *shared, struct MHD_Connection *handle, const char *target,
                                      const char *method, const char *version, const char *upload,
                                      size_t *upload_size, void **state) {
    (void)version, (void)upload, (void)upload_size, (void)state;
    http_server *const server = shared;
    connection *const c = MHD_get_connection_info(handle, MHD_CONNECTION_INFO_SOCKET_CONTEXT)->socket_context;
    watch_answer answer = {.status = refuse(handle, target)};
    if (answer.status == 0 &&
        !server->handler(server->user, method, target, c->waits && now() >= c->until, &answer)) {
        if (!c->waits)
            *c = (connection){.handle = handle, .waits = true, .until = now() + WAITING};
        MHD_suspend_connection(handle);
        return MHD_YES;
    }
    *c =
        (connection){.handle = handle, .until = INFINITY}; /* the library drops clients that do not receive */
    return send_answer(handle, &answer);
}

/* Resumes waiting requests, and drops connections that are slow to send theirs. */
static void attend(const connection *c, bool woken) {
    const bool late = now() >= c->until;
    if (c->handle == NULL)
        return;
    if (c->waits && (woken || late))
        MHD_resume_connection(c->handle);
    else if (late)
        shutdown(MHD_get_connection_info(c->handle, MHD_CONNECTION_INFO_CONNECTION_FD)->connect_fd,
                 SHUT_RDWR);
}

static void *serve(void *shared) {
    http_server *const server = shared;
    for (bool stop = false; !stop;) {
        MHD_run_wait(server->daemon, TICK);
        stop = atomic_load(&server->stop);
        const bool woken = atomic_exchange(&server->woken, false) || stop;
        for (size_t i = 0; i < MOST_CONNECTIONS; ++i)
            attend(&server->connections[i], woken);
    }
    return NULL;
}

/* Signals are for the host's threads. */
static bool start(http_server *server, int listener) {
    server->daemon = MHD_start_daemon(
        MHD_USE_AUTO | MHD_ALLOW_SUSPEND_RESUME, 0, NULL, NULL, handle_request, server,
        MHD_OPTION_LISTEN_SOCKET, listener, MHD_OPTION_NOTIFY_CONNECTION, notify, server,
        MHD_OPTION_CONNECTION_LIMIT, (unsigned)MOST_CONNECTIONS, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
        (size_t)REQUEST_CAPACITY, MHD_OPTION_CONNECTION_TIMEOUT, SENDING, MHD_OPTION_END);
    if (server->daemon == NULL) {
        close(listener);
        return false;
    }
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(&server->thread, NULL, serve, server) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!started)
        MHD_stop_daemon(server->daemon);
    return started;
}

static bool create(int listener, watch_handler *handler, void *user, watch_server **out) {
    http_server *const server = calloc(1, sizeof *server);
    if (server == NULL) {
        close(listener);
        return false;
    }
    server->base.module = &aureole_serve;
    server->handler = handler;
    server->user = user;
    atomic_init(&server->stop, false);
    atomic_init(&server->woken, false);
    if (!start(server, listener)) {
        free(server);
        return false;
    }
    *out = &server->base;
    return true;
}

static void wake(watch_server *base) {
    http_server *const server = (http_server *)base;
    atomic_store(&server->woken, true);
}

static void destroy(watch_server *base) {
    http_server *const server = (http_server *)base;
    atomic_store(&server->stop, true);
    pthread_join(server->thread, NULL);
    MHD_stop_daemon(server->daemon);
    free(server);
}

const watch_server_module aureole_serve = {create, wake, destroy};

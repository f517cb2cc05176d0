#include "watch/server.h"

#include <aureole/text.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { MOST_CONNECTIONS = 32 };

/* Seconds: until a request is there, until one that waits is answered, and between two bytes that are sent.
 */
static const double READING = 10.0, WAITING = 15.0, SENDING = 20.0;

typedef enum connection_state { CONNECTION_READS, CONNECTION_WAITS, CONNECTION_SENDS } connection_state;

typedef struct connection {
    int socket;
    connection_state state;
    double until; /* when it is dropped, or answered at last */
    size_t size;  /* bytes of the request */
    char bytes[WATCH_REQUEST_CAPACITY];
    watch_request request;
    char head[512];
    watch_answer answer;
    size_t head_size, sent; /* bytes of the head, and of head and body together */
} connection;

struct watch_server {
    watch_handler *handler;
    void *user;
    int listener, wake[2]; /* a pipe */
    atomic_bool stop;
    pthread_t thread;
    size_t count;
    connection *connections[MOST_CONNECTIONS];
};

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void begin_answer(connection *c) {
    const watch_answer *const answer = &c->answer;
    /* Nothing but this page's own script and data, and nobody learns of its address. */
    aur_format(
        c->head, sizeof c->head,
        "HTTP/1.1 %d %s\r\nContent-Type: %s\r\nContent-Length: %zu\r\nConnection: close\r\n"
        "Cache-Control: no-store\r\nReferrer-Policy: no-referrer\r\nX-Content-Type-Options: nosniff\r\n"
        "Content-Security-Policy: default-src 'none'; script-src 'unsafe-inline'; "
        "style-src 'unsafe-inline'; connect-src 'self'; frame-ancestors 'none'\r\n\r\n",
        answer->status, watch_status_words(answer->status),
        answer->type != NULL ? answer->type : "text/plain; charset=utf-8", answer->size);
    c->head_size = strlen(c->head);
    c->state = CONNECTION_SENDS;
    c->until = now() + SENDING;
    if (c->request.method == WATCH_HEAD)
        c->answer.size = 0;
}

static void answer(watch_server *server, connection *c, bool last) {
    if (server->handler(server->user, &c->request, last, &c->answer)) {
        begin_answer(c);
    } else if (c->state == CONNECTION_READS) {
        c->state = CONNECTION_WAITS;
        c->until = now() + WAITING;
    }
}

/* These return false where the connection is to be closed. */
static bool receive(watch_server *server, connection *c) {
    const ssize_t got = recv(c->socket, c->bytes + c->size, sizeof c->bytes - c->size, 0);
    if (got < 0)
        return errno == EAGAIN || errno == EINTR;
    if (got == 0)
        return false;
    c->size += (size_t)got;
    const watch_request_state state = watch_request_read(c->size, c->bytes, &c->request);
    if (state == WATCH_REQUEST_WHOLE) {
        answer(server, c, false);
    } else if (state == WATCH_REQUEST_BAD) {
        c->answer.status = c->request.status;
        begin_answer(c);
    }
    return true;
}

static bool transmit(connection *c) {
    const size_t whole = c->head_size + c->answer.size;
    const bool in_head = c->sent < c->head_size;
    const char *const from = in_head ? c->head + c->sent : c->answer.body + (c->sent - c->head_size);
    const ssize_t put =
        send(c->socket, from, (in_head ? c->head_size : whole) - c->sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (put < 0)
        return errno == EAGAIN || errno == EINTR;
    c->sent += (size_t)put;
    c->until = now() + SENDING;
    if (c->sent == whole)
        shutdown(c->socket, SHUT_WR);
    return c->sent < whole;
}

static void close_connection(connection *c) {
    /* What the other side still sends would make the kernel throw away what it has not read yet. */
    char rest[512];
    for (int i = 0; i < 16 && recv(c->socket, rest, sizeof rest, MSG_DONTWAIT) > 0; ++i)
        continue;
    close(c->socket);
    free(c->answer.body);
    free(c);
}

static void take_connection(watch_server *server) {
    const int made = accept(server->listener, NULL, NULL);
    connection *const c = made >= 0 ? calloc(1, sizeof *c) : NULL;
    if (c == NULL || fcntl(made, F_SETFD, FD_CLOEXEC) != 0 || fcntl(made, F_SETFL, O_NONBLOCK) != 0) {
        free(c);
        if (made >= 0)
            close(made);
        return;
    }
    c->socket = made;
    c->until = now() + READING;
    server->connections[server->count++] = c;
}

/* Whether the connection goes on. */
static bool attend(watch_server *server, connection *c, bool ready, bool woken) {
    const double time = now();
    const bool late = time >= c->until;
    if (c->state == CONNECTION_WAITS) {
        char rest[512]; /* nothing more is wanted, and its end means that the other side has left */
        if (ready && recv(c->socket, rest, sizeof rest, MSG_DONTWAIT) <= 0)
            return false;
        if (woken || late)
            answer(server, c, late);
        return true;
    }
    if (late || !ready)
        return !late;
    return c->state == CONNECTION_READS ? receive(server, c) : transmit(c);
}

/* Milliseconds until the first connection has waited long enough. */
static int patience(const watch_server *server) {
    double least = 60.0;
    for (size_t i = 0; i < server->count; ++i) {
        const double left = server->connections[i]->until - now();
        least = left < least ? left : least;
    }
    return least > 0.0 ? (int)(1000.0 * least) + 1 : 0;
}

static void *serve(void *shared) {
    watch_server *const server = shared;
    while (!atomic_load(&server->stop)) {
        struct pollfd polled[2 + MOST_CONNECTIONS] = {{.fd = server->wake[0], .events = POLLIN}};
        const size_t count = server->count;
        for (size_t i = 0; i < count; ++i)
            polled[2 + i] = (struct pollfd){
                .fd = server->connections[i]->socket,
                .events = server->connections[i]->state == CONNECTION_SENDS ? POLLOUT : POLLIN};
        /* Others wait in the kernel's queue until there is room. */
        polled[1] = (struct pollfd){.fd = count < MOST_CONNECTIONS ? server->listener : -1, .events = POLLIN};
        if (poll(polled, 2 + count, patience(server)) < 0 && errno != EINTR)
            break;
        char byte[64];
        const bool woken = polled[0].revents != 0 && read(server->wake[0], byte, sizeof byte) > 0;
        size_t kept = 0;
        for (size_t i = 0; i < count; ++i) {
            connection *const c = server->connections[i];
            if (attend(server, c, polled[2 + i].revents != 0, woken))
                server->connections[kept++] = c;
            else
                close_connection(c);
        }
        server->count = kept;
        if (polled[1].revents != 0)
            take_connection(server);
    }
    return NULL;
}

/* The thread leaves the host's signals to the host's threads. */
static bool start(watch_server *server) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = pthread_create(&server->thread, NULL, serve, server) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

static void release(watch_server *server) {
    const int files[] = {server->listener, server->wake[0], server->wake[1]};
    for (size_t i = 0; i < 3; ++i)
        if (files[i] >= 0)
            close(files[i]);
    free(server);
}

aur_result watch_server_create(const char *option, watch_place *place, watch_handler *handler, void *user,
                               watch_server **out, aur_error *error) {
    watch_server *const server = calloc(1, sizeof *server);
    if (server == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    *server = (watch_server){.handler = handler, .user = user, .listener = -1, .wake = {-1, -1}};
    atomic_init(&server->stop, false);
    aur_result result = watch_listen(option, place, &server->listener, error);
    if (result == AUR_OK && (pipe(server->wake) != 0 || fcntl(server->wake[0], F_SETFD, FD_CLOEXEC) != 0 ||
                             fcntl(server->wake[1], F_SETFD, FD_CLOEXEC) != 0 ||
                             fcntl(server->wake[0], F_SETFL, O_NONBLOCK) != 0 ||
                             fcntl(server->wake[1], F_SETFL, O_NONBLOCK) != 0 ||
                             fcntl(server->listener, F_SETFL, O_NONBLOCK) != 0 || !start(server)))
        result = aur_fail(error, AUR_ERROR_OPEN, "--%s: cannot serve: %s", option, strerror(errno));
    if (result != AUR_OK) {
        release(server);
        return result;
    }
    *out = server;
    return AUR_OK;
}

void watch_server_wake(watch_server *server) {
    const ssize_t ignored = write(server->wake[1], "", 1); /* a full pipe wakes as well */
    (void)ignored;
}

void watch_server_destroy(watch_server *server) {
    if (server == NULL)
        return;
    atomic_store(&server->stop, true);
    watch_server_wake(server);
    pthread_join(server->thread, NULL);
    for (size_t i = 0; i < server->count; ++i)
        close_connection(server->connections[i]);
    release(server);
}

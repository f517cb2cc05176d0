#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* prlimit */
#endif
#include "render/scene/importers/model/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "points/base/array.h"

extern char **environ;

/* Sanitizers reserve more address space than any limit allows. */
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define LIMITS_MEMORY false
#endif
#endif
#if !defined(LIMITS_MEMORY) && (defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__))
#define LIMITS_MEMORY false
#endif
#if !defined(LIMITS_MEMORY)
#define LIMITS_MEMORY true
#endif

enum {
    TICK = 100,           /* ms between checks for cancellation */
    MEMORY_PER_BYTE = 100 /* factor of memory per byte of input: assimp parses text into lists of numbers */
};
static const double seconds_at_first = 10.0, seconds_per_byte = 2.0 / (1 << 20);
static const uint64_t memory_least = UINT64_C(1) << 30;

/* --- limits */

static double seconds_allowed(const aur_child *child) {
    return child->seconds + seconds_per_byte * (double)child->given;
}

uint64_t aur_child_memory(const aur_child *child) {
    return memory_least + MEMORY_PER_BYTE * child->given;
}

void aur_child_grant(aur_child *child, uint64_t bytes) {
    const uint64_t most = UINT64_C(1) << 50;
    child->given = bytes < most - child->given ? child->given + bytes : most;
#if defined(__linux__)
    struct rlimit limit;
    if (!LIMITS_MEMORY || child->pid == 0 || prlimit(child->pid, RLIMIT_AS, NULL, &limit) != 0)
        return;
    /* The limit requested, at most this process's limit, which the child inherits. */
    struct rlimit current;
    const rlim_t requested = (rlim_t)aur_child_memory(child);
    const rlim_t most_here = getrlimit(RLIMIT_AS, &current) == 0 ? current.rlim_cur : RLIM_INFINITY;
    limit.rlim_cur = requested < most_here ? requested : most_here;
    if (limit.rlim_cur > limit.rlim_max)
        limit.rlim_cur = limit.rlim_max;
    (void)prlimit(child->pid, RLIMIT_AS, &limit, NULL);
#endif
}

static double seconds_used(const aur_child *child) {
    clockid_t clock;
    struct timespec time;
    if (clock_getcpuclockid(child->pid, &clock) != 0 || clock_gettime(clock, &time) != 0)
        return 0.0;
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static bool is_cancelled(const aur_progress *progress) {
    return progress->function != NULL && progress->function(progress->user, "reading the model", 0, 1) != 0;
}

/* Whether the child may continue. */
static bool may_go_on(aur_child *child) {
    child->cancelled = child->cancelled || is_cancelled(&child->progress);
    child->overdue = child->overdue || seconds_used(child) > seconds_allowed(child);
    child->late = child->late || child->waited > child->patience * seconds_allowed(child);
    return !child->cancelled && !child->overdue && !child->late;
}

/* --- start */

/* Resets the process state: no signals blocked or ignored, the socket as standard input, no output. */
static int spawn(pid_t *pid, const char *program, int socket) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    char parent_id[24];
    snprintf(parent_id, sizeof parent_id, "%ld", (long)getpid());
    char *const arguments[] = {(char *)program, parent_id, NULL};
    int code = posix_spawn_file_actions_init(&actions);
    if (code != 0)
        return code;
    code = posix_spawnattr_init(&attributes);
    if (code == 0) {
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
        code = posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
        if (code == 0)
            code = posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        if (code == 0)
            code = posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        if (code == 0)
            code = posix_spawn(pid, program, &actions, &attributes, arguments, environ);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    return code;
}

aur_result aur_child_start(aur_child *child, const char *program, const aur_progress *progress,
                           aur_error *error) {
    *child = (aur_child){.program = program,
                         .seconds = seconds_at_first,
                         .patience = 6.0,
                         .socket = -1,
                         .progress = *progress,
                         .status = -1};
    if (is_cancelled(progress)) /* cancellation is checked from here on */
        return aur_fail(error, AUR_ERROR_CANCELLED, "interrupted");
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return aur_fail(error, AUR_ERROR_INTERNAL, "the system gives no socket: %s", strerror(errno));
    const int code = spawn(&child->pid, program, ends[1]);
    close(ends[1]);
    if (code == 0 && fcntl(ends[0], F_SETFL, O_NONBLOCK) == 0) {
        child->socket = ends[0];
        aur_child_grant(child, 0);
        return AUR_OK;
    }
    close(ends[0]);
    if (code == 0) {
        aur_child_end(child);
        return aur_fail(error, AUR_ERROR_INTERNAL, "the system gives no socket: %s", strerror(errno));
    }
    child->pid = 0;
    return aur_fail(error, code == EAGAIN || code == ENOMEM ? AUR_ERROR_INTERNAL : AUR_ERROR_UNSUPPORTED,
                    "cannot start the program '%s': %s", program, strerror(code));
}

/* --- transfer */

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Waits until the socket is ready; false if the child has failed. */
static bool wait_ready(aur_child *child, short events) {
    struct pollfd ready = {.fd = child->socket, .events = events};
    for (;;) {
        const double start = now();
        const int count = poll(&ready, 1, TICK);
        child->waited += now() - start;
        if (child->waited > child->looked + 1e-3 * TICK || count == 0) {
            child->looked = child->waited;
            if (!may_go_on(child))
                return false;
        }
        if (count > 0)
            return true;
        if (count < 0 && errno != EINTR && errno != EAGAIN)
            return false;
    }
}

/* Transfers the buffer in pieces by `move`: send or receive. */
static bool move_bytes(aur_child *child, size_t size, char *data, short events) {
    for (size_t done = 0; done < size;) {
        if (child->socket < 0 || !wait_ready(child, events))
            return false;
        const ssize_t count = events == POLLIN ? recv(child->socket, data + done, size - done, 0)
                                               : send(child->socket, data + done, size - done, MSG_NOSIGNAL);
        if (count == 0 && events == POLLIN)
            return false; /* the child has closed its end */
        if (count < 0 && errno != EINTR && errno != EAGAIN && errno != EWOULDBLOCK)
            return false;
        if (count > 0)
            done += (size_t)count;
    }
    return true;
}

bool aur_child_send(aur_child *child, size_t size, const void *data) {
    return move_bytes(child, size, (char *)data, POLLOUT);
}

bool aur_child_receive(aur_child *child, size_t size, void *data) {
    return move_bytes(child, size, data, POLLIN);
}

bool aur_child_receive_all(aur_child *child, uint64_t size, char **data) {
    enum { PIECE = 1 << 20 };
    size_t capacity = 0;
    char *bytes = NULL;
    bool good = true;
    for (uint64_t done = 0; good && done <= size;) {
        const size_t piece = size - done < PIECE ? (size_t)(size - done) : PIECE;
        good = aur_array_reserve(&bytes, &capacity, (size_t)done + piece + 1, 1);
        child->out_of_memory = child->out_of_memory || !good;
        good = good && aur_child_receive(child, piece, bytes + done);
        done += piece;
        if (done == size)
            break;
    }
    if (!good) {
        free(bytes);
        return false;
    }
    bytes[size] = '\0';
    *data = bytes;
    return true;
}

/* --- end */

/* A child that has closed its socket is about to exit: use its exit status. */
static bool has_ended(aur_child *child) {
    int status;
    const pid_t ended = waitpid(child->pid, &status, WNOHANG);
    if (ended == 0 || (ended < 0 && errno == EINTR))
        return false;
    child->status =
        ended == child->pid ? status : -1; /* another thread has reaped it, or children are not waitable */
    child->pid = 0;
    return true;
}

void aur_child_end(aur_child *child) {
    if (child->socket >= 0)
        close(child->socket);
    child->socket = -1;
    const struct timespec pause = {.tv_nsec = 1000000};
    const int patience = child->overdue || child->late || child->cancelled ? 0 : 1000;
    for (int i = 0; i < patience && child->pid != 0 && !has_ended(child); ++i)
        nanosleep(&pause, NULL);
    if (child->pid == 0)
        return;
    kill(child->pid, SIGKILL);
    while (!has_ended(child))
        nanosleep(&pause, NULL);
}

static aur_result fail_by_signal(int signal_number, aur_location location, aur_error *error) {
    switch (signal_number) {
    case SIGINT:
    case SIGTERM:
    case SIGHUP:
    case SIGQUIT:
        return aur_fail_at(error, location, AUR_ERROR_CANCELLED, "interrupted");
    case SIGKILL:
        return aur_fail_at(error, location, AUR_ERROR_MEMORY,
                           "this model cannot be read: the process that reads it was killed, as systems do "
                           "that run out of memory");
    default:
        return aur_fail_at(
            error, location, AUR_ERROR_FORMAT,
            "this model cannot be read: the file is damaged, and assimp crashed on it (signal %d)",
            signal_number);
    }
}

aur_result aur_child_fail(aur_child *child, aur_location location, aur_error *error) {
    const double allowed = seconds_allowed(child);
    aur_child_end(child);
    if (child->cancelled)
        return aur_fail_at(error, location, AUR_ERROR_CANCELLED, "interrupted");
    if (child->out_of_memory)
        return aur_fail_memory_at(error, location);
    if (child->overdue)
        return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                           "this model cannot be read: assimp did not end within %.0f s of processor time",
                           allowed);
    if (child->late)
        return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                           "this model cannot be read: assimp did not end within %.0f s",
                           child->patience * allowed);
    if (child->status != -1 && WIFSIGNALED(child->status))
        return fail_by_signal(WTERMSIG(child->status), location, error);
    if (child->status != -1 && WIFEXITED(child->status) && WEXITSTATUS(child->status) != 0)
        return aur_fail_at(error, location, AUR_ERROR_UNSUPPORTED,
                           "the program '%s', which reads models, does not run (exit status %d)",
                           child->program, WEXITSTATUS(child->status));
    return aur_fail_at(error, location, AUR_ERROR_FORMAT,
                       "this model cannot be read: the program '%s' gave no whole answer", child->program);
}

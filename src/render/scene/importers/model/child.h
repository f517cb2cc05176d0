/* A child process that reads what strangers wrote. It may crash, hang or take too much memory: the parent
 * reports an error then, and goes on. The child has a socket as its standard input and no other open file.
 *
 * Limits grow with the bytes that the child was given: processor time, time that the parent waits, and, on
 * Linux, address space. */
#pragma once

#include <stdbool.h>
#include <sys/types.h>

#include "points/base/error.h"

typedef struct aur_child {
    const char *program;
    pid_t pid;       /* 0: none */
    int socket;      /* -1: none */
    double patience; /* time on the clock, by processor time */
    double seconds;  /* of processor time, which grow with the bytes given */
    uint64_t given;  /* bytes */
    double waited;   /* for the child, in seconds */
    double looked;   /* `waited` when the limits were checked last */
    aur_progress progress;
    bool overdue, late, cancelled; /* why it was given up */
    bool out_of_memory;            /* of this process */
    int status;                    /* of waitpid, or -1 */
} aur_child;

/* Starts `program`, whose path stays the caller's. Errors: INTERNAL where the system has no process or socket
 * left, UNSUPPORTED where the program cannot be started, CANCELLED. */
aur_result aur_child_start(aur_child *child, const char *program, const aur_progress *progress,
                           aur_error *error);

/* Lets the limits grow by what `bytes` more of input need. */
void aur_child_grant(aur_child *child, uint64_t bytes);
/* Address space that the child may have by now, in bytes. */
uint64_t aur_child_memory(const aur_child *child);

/* All of data[size], or false: the child has failed. */
bool aur_child_send(aur_child *child, size_t size, const void *data);
bool aur_child_receive(aur_child *child, size_t size, void *data);
/* The same into memory that grows as bytes come, whatever size is announced; a zero byte follows it. *data is
 * malloc'ed. */
bool aur_child_receive_all(aur_child *child, uint64_t size, char **data);

/* Ends the child, and waits until it has ended. Safe when there is none. */
void aur_child_end(aur_child *child);
/* The error of a child that has failed, for which `location` names the file. Ends the child. */
aur_result aur_child_fail(aur_child *child, aur_location location, aur_error *error);

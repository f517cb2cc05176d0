/* A child process that parses untrusted files. If it crashes, hangs or exceeds its memory limit, the parent
 * reports an error and continues. The child has a socket as its standard input and no other open files.
 *
 * Limits grow with the bytes sent to the child: processor time, the parent's waiting time, and, on Linux,
 * address space. */
#pragma once

#include <stdbool.h>
#include <sys/types.h>

#include "points/base/error.h"

typedef struct aur_child {
    const char *program;
    pid_t pid;       /* 0: none */
    int socket;      /* -1: none */
    double patience; /* limit of wall-clock time, in units of processor time */
    double seconds;  /* processor time allowed, besides that per byte sent */
    uint64_t given;  /* bytes sent */
    double waited;   /* time spent waiting for the child, in seconds */
    double looked;   /* `waited` at the last check of the limits */
    aur_progress progress;
    bool overdue, late, cancelled; /* reason for giving up */
    bool out_of_memory;            /* in this process */
    int status;                    /* status from waitpid, or -1 */
} aur_child;

/* Starts `program`; the caller keeps ownership of the path. Errors: INTERNAL if the system has no processes
 * or sockets left; UNSUPPORTED if the program cannot be started; CANCELLED. */
aur_result aur_child_start(aur_child *child, const char *program, const aur_progress *progress,
                           aur_error *error);

/* Raises the limits for `bytes` more of input. */
void aur_child_grant(aur_child *child, uint64_t bytes);
/* The child's current limit of address space, in bytes. */
uint64_t aur_child_memory(const aur_child *child);

/* Sends or receives all of data[size]; false: the child has failed. */
bool aur_child_send(aur_child *child, size_t size, const void *data);
bool aur_child_receive(aur_child *child, size_t size, void *data);
/* Receives into memory that grows as bytes arrive, regardless of the announced size, and appends a zero byte.
 * *data is malloc'ed. */
bool aur_child_receive_all(aur_child *child, uint64_t size, char **data);

/* Ends the child and waits until it has exited. Safe if there is none. */
void aur_child_end(aur_child *child);
/* The error of a failed child; `location` names the file. Ends the child. */
aur_result aur_child_fail(aur_child *child, aur_location location, aur_error *error);

/* Interface for jobs of several processes: one process reads and writes files for all, and loops share their
 * items. points/ranks implements the communication. */
#pragma once

#include <stdatomic.h>

#include "points/base/parallel.h"

/* One loop whose items several processes share. */
typedef struct aur_shared_loop aur_shared_loop;

typedef struct aur_shared_loop_options {
    const char *what;
    const aur_parallel_share *share;
    void *context; /* of the share */
    size_t count, threads;
    atomic_bool *stop; /* true: no new items are begun */
    /* Called when an item of another process has ended with this result; or with AUR_LOOP_STOP or _END. */
    void (*note)(void *work, size_t index, aur_result result);
    /* The result of this process's items so far. */
    aur_result (*outcome)(void *work);
    void *work;
} aur_shared_loop_options;

/* Instead of an item: a process requests a stop; the loop has ended with this result for all processes. */
#define AUR_LOOP_STOP (SIZE_MAX - 1)
#define AUR_LOOP_END SIZE_MAX

typedef struct aur_loop_functions {
    /* NULL: out of memory. */
    aur_shared_loop *(*create)(void *user, const aur_shared_loop_options *options);
    /* For any thread: the next item; false when there is none left. Waits while items may still come. */
    bool (*take)(aur_shared_loop *loop, size_t *index);
    /* Called once for each item, with its result and the rays that it traced. */
    void (*done)(aur_shared_loop *loop, size_t index, aur_result result, uint64_t rays);
    /* Exchanges messages until all items are done or abandoned. Without threads, `one` runs one item and
     * returns whether there was one; with threads it is NULL. */
    void (*exchange_messages)(aur_shared_loop *loop, bool (*one)(void *work));
    /* Called when no thread takes items any more: distributes the results and ends the loop. Returns the rays
     * of other processes' items. */
    uint64_t (*end)(aur_shared_loop *loop);
    /* The first communication error; AUR_OK if none. */
    aur_result (*failure)(void *user, aur_error *error);
} aur_loop_functions;

typedef struct aur_io {
    void *user;
    size_t rank, count; /* rank of this process and number of processes; rank 0 reads and writes for all */
    /* Sends rank 0's bytes, or its data[*size], to all: the others' *data is allocated with malloc, with a
     * zero byte after it. */
    aur_result (*agree)(void *user, size_t size, void *data, aur_error *error);
    aur_result (*share)(void *user, char **data, size_t *size, aur_error *error);
    /* Sends the data of every other rank to rank 0, in the order of ranks. */
    aur_result (*gather)(void *user, size_t size, const void *data,
                         aur_result (*add)(void *context, size_t rank, size_t size, const void *data),
                         void *context, aur_error *error);
    const aur_loop_functions *loops;
} aur_io;

/* Sets the group of processes that the calling thread works with; NULL, the default: none. Returns the
 * previous one, which must stay valid. */
const aur_io *aur_io_use(const aur_io *io);
/* The group of this thread, NULL: none; and whether this process reads and writes files. */
AUR_INTERNAL const aur_io *aur_io_here(void);
AUR_INTERNAL bool aur_io_leads(void);
/* Replaces data[size] by that of rank 0; no effect without a group. Fails with a communication error. */
AUR_INTERNAL aur_result aur_io_agree(size_t size, void *data, aur_error *error);

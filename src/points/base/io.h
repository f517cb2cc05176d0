/* How several processes that do one job stay together: one of them reads and writes files for all, and loops
 * share their items. Nothing here knows how they talk (points/ranks does). */
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
    /* Notes that an item of another process has ended with this result; or AUR_LOOP_STOP or _END. */
    void (*note)(void *work, size_t index, aur_result result);
    /* The result of this process's items so far. */
    aur_result (*outcome)(void *work);
    void *work;
} aur_shared_loop_options;

/* In the place of an item: a process asks to stop; the loop has ended, and this is the result of all. */
#define AUR_LOOP_STOP (SIZE_MAX - 1)
#define AUR_LOOP_END SIZE_MAX

typedef struct aur_loop_functions {
    /* NULL when there is no memory. */
    aur_shared_loop *(*create)(void *user, const aur_shared_loop_options *options);
    /* For any thread: the next item; false when there is none left. Waits while others may still be given. */
    bool (*take)(aur_shared_loop *loop, size_t *index);
    /* To be called once for each item, with its result and the rays that it has traced. */
    void (*done)(aur_shared_loop *loop, size_t index, aur_result result, uint64_t rays);
    /* Exchanges messages until all items are done or given up. `one` does one item itself where there are no
     * threads, and returns whether there was one; NULL where there are threads. */
    void (*exchange_messages)(aur_shared_loop *loop, bool (*one)(void *work));
    /* To be called when no thread takes items any more: hands out what was found. Ends the loop. Returns the
     * rays of other processes' items. */
    uint64_t (*end)(aur_shared_loop *loop);
    /* What has gone wrong between the processes; AUR_OK while nothing has. */
    aur_result (*failure)(void *user, aur_error *error);
} aur_loop_functions;

typedef struct aur_io {
    void *user;
    size_t rank, count; /* of this process, and how many there are; rank 0 reads and writes for all */
    /* Gives all of them rank 0's bytes, or its data[*size]: the others' *data is allocated with malloc, with
     * a zero byte after it. */
    aur_result (*agree)(void *user, size_t size, void *data, aur_error *error);
    aur_result (*share)(void *user, char **data, size_t *size, aur_error *error);
    /* Gives rank 0 the data of each other one, one after the other in their order. */
    aur_result (*gather)(void *user, size_t size, const void *data,
                         aur_result (*add)(void *context, size_t rank, size_t size, const void *data),
                         void *context, aur_error *error);
    const aur_loop_functions *loops;
} aur_io;

/* Lets the calling thread work so from here on, or alone (NULL, as at first). Returns how it did before,
 * which must stay valid meanwhile. */
const aur_io *aur_io_use(const aur_io *io);
/* How this thread works, NULL when it is alone; and whether it reads and writes itself. */
AUR_INTERNAL const aur_io *aur_io_here(void);
AUR_INTERNAL bool aur_io_leads(void);
/* Replaces data[size] by rank 0's; nothing where this thread is alone. Fails with what has gone wrong between
 * the processes. */
AUR_INTERNAL aur_result aur_io_agree(size_t size, void *data, aur_error *error);

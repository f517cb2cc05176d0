/* The items of one loop, shared out to the ranks of a job (points/base/ranks.h). Rank 0 gives runs of items
 * to whoever asks, long ones first and single ones in the end, and takes what comes of them; when all are
 * done, every rank gets what the others have found. Threads do the items, the thread of the job talks. */
#pragma once

#include <stdatomic.h>

#include "points/base/bytes.h"
#include "points/base/parallel.h"
#include "points/base/ranks.h"

typedef struct aur_shared_loop aur_shared_loop;

/* In the place of an item: a rank asks to stop; the loop has ended, and this is the result of all ranks. */
#define AUR_LOOP_STOP (SIZE_MAX - 1)
#define AUR_LOOP_END SIZE_MAX

/* What a loop is told and asks. */
typedef struct aur_shared_loop_options {
    const char *what;
    const aur_parallel_share *share;
    void *context; /* of the share */
    size_t count, threads;
    atomic_bool *stop; /* true: no new items are begun */
    /* Notes that an item of another rank has ended so; or one of the above. */
    void (*note)(void *work, size_t index, aur_result result);
    /* What has become of this rank's items so far. */
    aur_result (*outcome)(void *work);
    void *work;
} aur_shared_loop_options;

/* NULL when there is no memory. */
aur_shared_loop *aur_shared_loop_create(aur_ranks *ranks, const aur_shared_loop_options *options);

/* For any thread: the next item; false when there is none left. Waits while others may still be given. */
bool aur_shared_loop_take(aur_shared_loop *loop, size_t *index);
/* To be called once for each item, with its result and the rays that it has traced. */
void aur_shared_loop_done(aur_shared_loop *loop, size_t index, aur_result result, uint64_t rays);

/* Talks until all items are done or given up. `one` does one item itself where there are no threads, and
 * returns whether there was one; NULL where there are threads. */
void aur_shared_loop_exchange_messages(aur_shared_loop *loop, bool (*one)(void *work));
/* To be called when no thread takes items any more: hands out what was found. Ends the loop; whether all went
 * well is known by aur_ranks_have_failed. Returns the rays of other ranks' items. */
uint64_t aur_shared_loop_end(aur_shared_loop *loop);

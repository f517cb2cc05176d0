/* The one way in which Aureole uses threads. Work items are independent; a result must never depend on which
 * thread ran an item or when (architecture, law 1). */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>

#include "points/base/error.h"

/* Does item `index` of the work. Called from several threads at once, each index once. */
typedef aur_result (*aur_parallel_function)(void *context, size_t index);

/* An array that items write their results to: item i the bytes i * each .. (i + 1) * each - 1, as far as
 * `size` goes. */
typedef struct aur_parallel_slice {
    void *data;
    size_t each, size;
} aur_parallel_slice;

struct aur_bytes;
struct aur_bytes_reader;
enum { AUR_SHARE_SLICES = 4 };

/* All that an item leaves behind, so that several processes (io.h) can share the items: afterwards each of
 * them has what all items found. */
typedef struct aur_parallel_share {
    aur_parallel_slice slices[AUR_SHARE_SLICES]; /* end with one without data */
    /* What is no slice, or NULL: puts what the item found into bytes (false: no memory), and takes it from
     * the bytes of another rank, while other items are done. Also of items that were cancelled. */
    bool (*pack)(void *context, size_t index, struct aur_bytes *bytes);
    aur_result (*unpack)(void *context, size_t index, struct aur_bytes_reader *bytes);
} aur_parallel_share;

typedef struct aur_parallel_options {
    size_t threads;        /* 0: as many as the machine offers */
    const char *what;      /* names the work in progress reports and errors; NULL: no name */
    aur_progress progress; /* one call at a time for each piece of work; done counts finished items */
    /* Denormal numbers are zero inside the items, as Embree asks of who traces rays. Points, weights and
     * measures leave it false: the same function then gives the same bits inside and outside of an item. */
    bool flush_denormals;
    bool triangular; /* item i takes as long as i first ones, and counts as much in progress reports */
    const aur_parallel_share *share; /* NULL: each rank of a job does all items */
} aur_parallel_options;

/* Runs items 0..count-1 on the calling thread and on others that last as long as the call; when the system
 * has no more threads to give, fewer do the work. When items fail, the result of the failing item with the
 * lowest index that was run is returned, `error` says "WHAT: the result's name", and no new item starts.
 * Items may call this function, which then uses their thread alone; so may progress callbacks, whose
 * calls have their own threads. */
AUR_INTERNAL aur_result aur_parallel_for(const aur_parallel_options *options, size_t count,
                                         aur_parallel_function function, void *context, aur_error *error);

/* Rays that this thread has traced (render/trace/embree.h), and that others have in loops which it has run.
 * What a piece of work has traced is the difference between its end and its beginning, on the thread that
 * began it: threads, ranks and callbacks do not change it. */
extern AUR_INTERNAL _Thread_local uint64_t aur_rays_traced __attribute__((tls_model("initial-exec")));

/* Calls a progress callback, from wherever the work is; true: it asks the work to stop. Whatever the callback
 * calls in the library is work of its own, as if it were called outside of all items. */
AUR_INTERNAL bool aur_progress_stops(const aur_progress *progress, const char *what, uint64_t done,
                                     uint64_t total);

/* Asks from within a long item whether the work is to stop: the progress function is called as at the end of
 * an item, with the items that are finished. True: the item may leave at once, with AUR_ERROR_CANCELLED.
 * False outside of an item. */
AUR_INTERNAL bool aur_parallel_stops(void);

/* The number of threads that `threads` stands for. 0: as many as there are processors for this process, or as
 * OMP_NUM_THREADS says. At most four a processor (but 16 on a small machine) and 1024. */
AUR_INTERNAL size_t aur_parallel_threads(size_t threads);

/* Progress of work that consists of pieces which report their own. */

/* What the pieces report from 0 to 1 is from `from` to `to` of the whole; the caller moves both from piece to
 * piece. It outlives the pieces. */
typedef struct aur_progress_span {
    aur_progress whole;
    double from, to;
    uint64_t reported; /* of 10000: the most so far, so that the whole never goes back */
} aur_progress_span;

/* The share that is done of work whose whole is estimated again and again. It never falls, and what is
 * missing of it shrinks in proportion to what is thought to be left, so that its rate of now tells the time
 * left. */
typedef struct aur_progress_share {
    double done, share;
} aur_progress_share;

/* Reports that so much work is done, and so much thought to be left; INFINITY: nobody knows, and the share
 * waits. Returns what the callback, which is not NULL, returns. */
AUR_INTERNAL int aur_progress_tell(const aur_progress *progress, const char *what, aur_progress_share *share,
                                   double done, double left);

/* For the pieces; without a function where the whole has none. */
AUR_INTERNAL aur_progress aur_progress_within(aur_progress_span *span);

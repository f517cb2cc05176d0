/* All use of threads in Aureole. Work items are independent; a result must never depend on which thread ran
 * an item or when (architecture, law 1). */
#pragma once

#include <aureole/core.h>
#include <stdbool.h>

#include "points/base/error.h"

/* Runs item `index` of the work. Called from several threads at once, each index once. */
typedef aur_result (*aur_parallel_function)(void *context, size_t index);

/* An array for the results of items: item i writes the bytes i * each .. (i + 1) * each - 1, limited by
 * `size`. */
typedef struct aur_parallel_slice {
    void *data;
    size_t each, size;
} aur_parallel_slice;

struct aur_bytes;
struct aur_bytes_reader;
enum { AUR_SHARE_SLICES = 4 };

/* All results of items, so that several processes (io.h) can share the items: afterwards each process has the
 * results of all. */
typedef struct aur_parallel_share {
    aur_parallel_slice slices[AUR_SHARE_SLICES]; /* end with one without data */
    /* For results outside slices, or NULL: serialise the result of an item (false: out of memory), and read
     * it from the bytes of another rank while other items run. Also called for cancelled items. */
    bool (*pack)(void *context, size_t index, struct aur_bytes *bytes);
    aur_result (*unpack)(void *context, size_t index, struct aur_bytes_reader *bytes);
} aur_parallel_share;

typedef struct aur_parallel_options {
    size_t threads;        /* 0: all of the machine */
    const char *what;      /* names the work in progress reports and errors; NULL: no name */
    aur_progress progress; /* one call at a time per work; done counts finished items */
    /* Denormal numbers are zero inside the items, as Embree requires for tracing rays. Points, weights and
     * measures leave it false: their results are then bit-identical inside and outside an item. */
    bool flush_denormals;
    bool triangular; /* item i takes time proportional to i, and counts so in progress reports */
    const aur_parallel_share *share; /* NULL: each rank of a job runs all items */
} aur_parallel_options;

/* Runs items 0..count-1 on the calling thread and on others that last as long as the call; if the system
 * cannot start them, fewer run. When items fail, no new item starts; the result is that of the failed item
 * with the lowest index, and `error` is "WHAT: the result's name". Items may call this function, which then
 * uses only their thread; so may progress callbacks, whose calls start separate threads. */
AUR_INTERNAL aur_result aur_parallel_for(const aur_parallel_options *options, size_t count,
                                         aur_parallel_function function, void *context, aur_error *error);

/* Rays traced by this thread (render/trace/embree.h) and by others in loops that it ran. The rays of a
 * computation are the difference of this number between its end and its beginning on the thread that began
 * it, independent of threads, ranks and callbacks. */
extern AUR_INTERNAL _Thread_local uint64_t aur_rays_traced __attribute__((tls_model("initial-exec")));

/* Calls a progress callback; true: it requests a stop. Library calls in the callback are separate work, as if
 * called outside all items. */
AUR_INTERNAL bool aur_progress_stops(const aur_progress *progress, const char *what, uint64_t done,
                                     uint64_t total);

/* Checks for cancellation from within a long item: calls the progress function with the number of finished
 * items, as at the end of an item. True: the item may return at once with AUR_ERROR_CANCELLED. False outside
 * an item. */
AUR_INTERNAL bool aur_parallel_stops(void);

/* The number of threads for the option `threads`. 0: the number of processors for this process, or
 * OMP_NUM_THREADS. At most four per processor (but 16 on a small machine) and 1024. */
AUR_INTERNAL size_t aur_parallel_threads(size_t threads);

/* Progress of work that consists of parts with separate reports. */

/* Maps the progress of a part, 0 to 1, to the range `from` to `to` of the whole; the caller sets both before
 * each part. It outlives the parts. */
typedef struct aur_progress_span {
    aur_progress whole;
    double from, to;
    uint64_t reported; /* of 10000: the maximum so far, so that progress never decreases */
} aur_progress_span;

/* The completed fraction of work whose total is repeatedly re-estimated. It never decreases, and the
 * remaining fraction shrinks in proportion to the estimated remaining work, so that its current rate predicts
 * the time left. */
typedef struct aur_progress_share {
    double done, share;
} aur_progress_share;

/* Reports the work done and the estimated remaining work; INFINITY: unknown, and the fraction does not
 * change. Returns the result of the callback, which is not NULL. */
AUR_INTERNAL int aur_progress_report_work(const aur_progress *progress, const char *what,
                                          aur_progress_share *share, double done, double left);

/* The progress for parts; without a function if the whole has none. */
AUR_INTERNAL aur_progress aur_progress_within(aur_progress_span *span);

#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* sched_getaffinity */
#endif
#include "points/base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <unistd.h>

#include "points/base/error.h"
#include "points/base/io.h"
#include "points/base/text.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

enum { MOST_THREADS = 1024, THREADS_A_PROCESSOR = 4, FEWEST_ALLOWED = 16 };

/* --- denormal numbers: set the processor's state, and restore the host's */

#if defined(__x86_64__)
static uint64_t flush_denormals(void) {
    const unsigned saved = _mm_getcsr();
    _mm_setcsr(saved | 0x8040u); /* flush to zero, denormals are zero */
    return saved;
}

static void restore_denormals(uint64_t saved) {
    _mm_setcsr((unsigned)saved);
}
#elif defined(__aarch64__)
static uint64_t flush_denormals(void) {
    uint64_t saved;
    __asm__ volatile("mrs %0, fpcr" : "=r"(saved));
    __asm__ volatile("msr fpcr, %0" : : "r"(saved | UINT64_C(1) << 24));
    return saved;
}

static void restore_denormals(uint64_t saved) {
    __asm__ volatile("msr fpcr, %0" : : "r"(saved));
}
#else
static uint64_t flush_denormals(void) {
    return 0;
}

static void restore_denormals(uint64_t saved) {
    (void)saved;
}
#endif

/* --- the number of threads */

/* The processors that this process may use. */
static size_t processor_count(void) {
#if defined(__linux__)
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0 && CPU_COUNT(&set) > 0)
        return (size_t)CPU_COUNT(&set);
#endif
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (size_t)online : 1;
}

size_t aur_parallel_threads(size_t threads) {
    const size_t processors = processor_count();
    size_t most = processors * THREADS_A_PROCESSOR;
    most = most < FEWEST_ALLOWED ? FEWEST_ALLOWED : most > MOST_THREADS ? MOST_THREADS : most;
    if (threads == 0) {
        /* Batch systems and test harnesses set this variable to the number of processors for this process. */
        const char *const text = getenv("OMP_NUM_THREADS");
        uint64_t requested;
        threads = text != NULL && aur_read_integer(text, MOST_THREADS, &requested) != NULL && requested > 0
                      ? (size_t)requested
                      : processors;
    }
    return threads < most ? threads : most;
}

/* --- sharing the work */

typedef struct shared_work shared_work;

struct shared_work {
    const aur_parallel_options *options;
    size_t count;
    aur_parallel_function function;
    void *context;
    const aur_loop_functions *loops;
    aur_shared_loop *loop; /* items are shared with other processes; NULL: not shared */
    shared_work *outer;    /* the enclosing work; NULL: none */
    atomic_size_t next;    /* the first item not taken */
    atomic_bool stop;
    pthread_mutex_t lock; /* guards the fields below, and serialises progress reports */
    size_t failed_index;  /* `count` while nothing has failed */
    aur_result result;
    uint64_t done;
    atomic_uint_fast64_t rays; /* of other threads */
};

_Thread_local uint64_t aur_rays_traced;

/* The work whose item this thread runs. Parallel work within an item runs on the item's thread only. */
static _Thread_local shared_work *inside;
/* The host thread's saved denormal mode, while it runs an item with another mode. */
static _Thread_local uint64_t host_denormals;
static _Thread_local bool flushes;

/* The callback runs as if the host had called it outside of any item: library calls in it are separate work
 * with separate threads, which neither stop the interrupted work nor wait for its lock. */
bool aur_progress_stops(const aur_progress *progress, const char *what, uint64_t done, uint64_t total) {
    if (progress->function == NULL)
        return false;
    shared_work *const work = inside;
    const aur_io *const io = aur_io_use(NULL);
    const bool flushed = flushes;
    const uint64_t host = host_denormals, rays = aur_rays_traced;
    if (flushed)
        restore_denormals(host);
    inside = NULL;
    flushes = false;
    const bool stops = progress->function(progress->user, what, done, total) != 0;
    aur_rays_traced = rays;
    inside = work;
    flushes = flushed;
    host_denormals = host;
    if (flushed)
        flush_denormals();
    aur_io_use(io);
    return stops;
}

/* With the lock held: reports progress, unless the work has been stopped. */
static void report(shared_work *work) {
    const bool triangular = work->options->triangular;
    const uint64_t done = work->done, count = work->count;
    if (atomic_load(&work->stop) ||
        !aur_progress_stops(&work->options->progress, work->options->what, triangular ? done * done : done,
                            triangular ? count * count : count))
        return;
    work->result = AUR_ERROR_CANCELLED;
    atomic_store(&work->stop, true);
}

bool aur_parallel_stops(void) {
    for (shared_work *work = inside; work != NULL; work = work->outer) {
        if (work->options->progress.function != NULL) {
            pthread_mutex_lock(&work->lock);
            report(work);
            pthread_mutex_unlock(&work->lock);
        }
        if (atomic_load(&work->stop))
            return true;
    }
    return false;
}

static void record(shared_work *work, size_t index, aur_result result) {
    if (result == AUR_OK && work->options->progress.function == NULL)
        return;
    pthread_mutex_lock(&work->lock);
    ++work->done;
    if (result == AUR_OK) {
        report(work);
    } else if (index < work->failed_index) {
        /* A failed item takes precedence over a cancelled one. */
        if (result != AUR_ERROR_CANCELLED)
            work->failed_index = index;
        if (result != AUR_ERROR_CANCELLED || work->result == AUR_OK)
            work->result = result;
        atomic_store(&work->stop, true);
    }
    pthread_mutex_unlock(&work->lock);
}

static bool take_item(shared_work *work, size_t *index) {
    if (work->loop != NULL)
        return work->loops->take(work->loop, index);
    *index = atomic_fetch_add_explicit(&work->next, 1, memory_order_relaxed);
    return *index < work->count;
}

/* False if no item is left. */
static bool do_item(void *shared) {
    shared_work *const work = shared;
    size_t index;
    if (atomic_load_explicit(&work->stop, memory_order_relaxed) || !take_item(work, &index))
        return false;
    shared_work *const outer = inside;
    const aur_io *const io = aur_io_use(NULL);
    const bool begins = work->options->flush_denormals && !flushes;
    if (begins)
        host_denormals = flush_denormals();
    flushes = flushes || begins;
    inside = work;
    const uint64_t rays = aur_rays_traced;
    const aur_result result = work->function(work->context, index);
    inside = outer;
    if (begins) {
        flushes = false;
        restore_denormals(host_denormals);
    }
    aur_io_use(io);
    if (work->loop != NULL)
        work->loops->done(work->loop, index, result, aur_rays_traced - rays);
    record(work, index, result);
    return true;
}

static void do_items(shared_work *work) {
    while (do_item(work))
        continue;
}

static void *run_thread(void *shared) {
    shared_work *const work = shared;
    do_items(work);
    atomic_fetch_add(&work->rays, aur_rays_traced);
    return NULL;
}

/* --- sharing it with other processes */

static void note(void *shared, size_t index, aur_result result) {
    shared_work *const work = shared;
    if (index < work->count) {
        record(work, index, result);
        return;
    }
    pthread_mutex_lock(&work->lock);
    if (index == AUR_LOOP_END || work->result == AUR_OK)
        work->result = result;
    if (result != AUR_OK)
        atomic_store(&work->stop, true);
    pthread_mutex_unlock(&work->lock);
}

static aur_result outcome(void *shared) {
    shared_work *const work = shared;
    pthread_mutex_lock(&work->lock);
    const aur_result result = work->result;
    pthread_mutex_unlock(&work->lock);
    return result;
}

static void begin_sharing(const aur_io *io, shared_work *work, size_t threads) {
    const aur_shared_loop_options options = {.what = work->options->what != NULL ? work->options->what
                                                                                 : "working",
                                             .share = work->options->share,
                                             .context = work->context,
                                             .count = work->count,
                                             .threads = threads,
                                             .stop = &work->stop,
                                             .note = note,
                                             .outcome = outcome,
                                             .work = work};
    work->loops = io->loops;
    work->loop = io->loops->create(io->user, &options);
}

/* Starts up to `requested` threads with signals blocked, so that the host's threads receive them. Returns the
 * number started: results do not depend on it, so fewer are not an error. */
static size_t start_threads(shared_work *work, size_t requested, pthread_t *threads) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    size_t count = 0;
    while (count < requested && pthread_create(&threads[count], NULL, run_thread, work) == 0)
        ++count;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return count;
}

aur_result aur_parallel_for(const aur_parallel_options *options, size_t count, aur_parallel_function function,
                            void *context, aur_error *error) {
    static const aur_parallel_options defaults = {0};
    if (options == NULL)
        options = &defaults;
    if (count == 0)
        return AUR_OK;
    const aur_io *const io = inside == NULL && options->share != NULL ? aur_io_here() : NULL;
    size_t requested = inside != NULL ? 1 : aur_parallel_threads(options->threads);
    if (requested > count)
        requested = count;
    shared_work work = {.options = options,
                        .count = count,
                        .function = function,
                        .context = context,
                        .outer = inside,
                        .failed_index = count};
    atomic_init(&work.next, 0);
    atomic_init(&work.stop, false);
    atomic_init(&work.rays, 0);
    if (pthread_mutex_init(&work.lock, NULL) != 0)
        return aur_fail_memory(error);
    if (io != NULL)
        begin_sharing(io, &work, requested);
    /* The thread of a job exchanges messages, and others do the items. */
    const size_t others = work.loop != NULL ? requested : requested - 1;
    pthread_t threads[MOST_THREADS];
    const size_t started = others > 0 ? start_threads(&work, others, threads) : 0;
    if (work.loop != NULL)
        work.loops->exchange_messages(work.loop, started == 0 ? do_item : NULL);
    else if (io == NULL)
        do_items(&work);
    for (size_t i = 0; i < started; ++i)
        pthread_join(threads[i], NULL);
    aur_rays_traced += atomic_load(&work.rays);
    if (work.loop != NULL)
        aur_rays_traced += work.loops->end(work.loop);
    pthread_mutex_destroy(&work.lock);
    /* A cancellation is reported as such even if a process was lost: partial results can then be stored. */
    const bool fails = io != NULL && work.result != AUR_ERROR_CANCELLED;
    const aur_result failure = fails ? io->loops->failure(io->user, error) : AUR_OK;
    if (failure != AUR_OK || work.result == AUR_OK)
        return failure;
    const bool named = options->what != NULL;
    return aur_fail(error, work.result, "%s%s%s", named ? options->what : "", named ? ": " : "",
                    aur_result_string(work.result));
}

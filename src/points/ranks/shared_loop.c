/* Distribution of the items of one loop to the ranks of a job (points/base/io.h). Rank 0 sends runs of items
 * to ranks that request them, long ones first and single items in the end, and receives the results. When all
 * are done, every rank receives the results of the others. Worker threads run the items; the thread of the
 * job exchanges messages. */
#if !defined(_GNU_SOURCE)
#define _GNU_SOURCE
#endif
#include "points/ranks/ranks.h"

#include <errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "points/base/bytes.h"
#include "points/base/io.h"

enum { PIECE = 1 << 20 };

struct aur_shared_loop {
    aur_ranks *ranks;
    aur_shared_loop_options options;
    bool is_root;
    size_t rank_count;
    pthread_mutex_t lock; /* guards the fields below, except those of the communicating thread */
    pthread_cond_t wake_threads, wake_messages;
    size_t next, end;          /* items that this rank may begin; rank 0: items not yet assigned */
    size_t running, idle;      /* threads */
    bool alone;                /* no worker threads: the communicating thread runs items itself */
    bool over;                 /* no more items will come */
    aur_bytes results;         /* of this rank's items, to be sent to rank 0 */
    size_t given_back;         /* items assigned to this rank and not begun */
    unsigned char *has_result; /* [count]: this rank has the item's result */
    uint64_t *rays;            /* [count]: of each item with a result */
    /* Only for the communicating thread. */
    size_t *outstanding;      /* rank 0, [ranks]: items assigned to each rank */
    uint64_t foreign_rays;    /* of items that other ranks ran */
    bool requested, stopping; /* a request for items is pending; a stop was sent or received */
};

static aur_shared_loop *create(void *user, const aur_shared_loop_options *options) {
    aur_ranks *const ranks = user;
    aur_shared_loop *const loop = calloc(1, sizeof *loop);
    unsigned char *const has_result = calloc(options->count, 1);
    uint64_t *const rays = calloc(options->count, sizeof *rays);
    size_t *const outstanding = calloc(aur_ranks_count(), sizeof *outstanding);
    if (loop == NULL || has_result == NULL || rays == NULL || outstanding == NULL) {
        free(loop);
        free(has_result);
        free(rays);
        free(outstanding);
        aur_ranks_fail(ranks, "rank %zu is out of memory", aur_ranks_rank());
        return NULL;
    }
    *loop = (aur_shared_loop){.ranks = ranks,
                              .options = *options,
                              .is_root = aur_ranks_rank() == 0,
                              .rank_count = aur_ranks_count(),
                              .has_result = has_result,
                              .rays = rays,
                              .outstanding = outstanding};
    loop->end = loop->is_root ? options->count : 0;
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&loop->lock, NULL);
    pthread_cond_init(&loop->wake_threads, &monotonic);
    pthread_cond_init(&loop->wake_messages, &monotonic);
    pthread_condattr_destroy(&monotonic);
    aur_ranks_begin(ranks);
    return loop;
}

static void destroy(aur_shared_loop *loop) {
    pthread_cond_destroy(&loop->wake_messages);
    pthread_cond_destroy(&loop->wake_threads);
    pthread_mutex_destroy(&loop->lock);
    aur_bytes_release(&loop->results);
    free(loop->outstanding);
    free(loop->has_result);
    free(loop->rays);
    free(loop);
}

/* --- items and results in bytes */

static void pack(const aur_shared_loop *loop, size_t index, aur_bytes *bytes) {
    const aur_parallel_share *const share = loop->options.share;
    for (size_t s = 0; s < AUR_SHARE_SLICES && share->slices[s].data != NULL; ++s) {
        const aur_parallel_slice *const slice = &share->slices[s];
        const size_t first = index * slice->each;
        if (first < slice->size)
            aur_bytes_put(bytes, slice->size - first < slice->each ? slice->size - first : slice->each,
                          (const char *)slice->data + first);
    }
    if (share->pack != NULL && !share->pack(loop->options.context, index, bytes))
        bytes->failed = true;
}

static aur_result unpack(const aur_shared_loop *loop, size_t index, aur_bytes_reader *reader) {
    const aur_parallel_share *const share = loop->options.share;
    for (size_t s = 0; s < AUR_SHARE_SLICES && share->slices[s].data != NULL; ++s) {
        const aur_parallel_slice *const slice = &share->slices[s];
        const size_t first = index * slice->each;
        if (first < slice->size)
            aur_bytes_get(reader, slice->size - first < slice->each ? slice->size - first : slice->each,
                          (char *)slice->data + first);
    }
    if (share->unpack != NULL && !reader->failed)
        return share->unpack(loop->options.context, index, reader);
    return reader->failed ? AUR_ERROR_INTERNAL : AUR_OK;
}

typedef struct entry {
    uint64_t index, size, rays;
    int64_t result;
} entry;

/* A cancelled item has a partial result; a failed one has none. */
static bool has_found(int64_t result) {
    return result == AUR_OK || result == AUR_ERROR_CANCELLED;
}

static void put_entry(const aur_shared_loop *loop, size_t index, aur_result result, aur_bytes *bytes) {
    entry e = {.index = index, .rays = loop->rays[index], .result = result};
    const size_t at = bytes->size;
    aur_bytes_put(bytes, sizeof e, &e);
    if (has_found(result))
        pack(loop, index, bytes);
    e.size = bytes->size - at - sizeof e;
    if (!bytes->failed)
        memcpy(bytes->data + at, &e, sizeof e);
}

/* Receives results of others; rank 0 also reports progress. */
static void get_entries(aur_shared_loop *loop, const aur_message *message) {
    aur_bytes_reader all = {.at = message->data, .end = message->data + message->size};
    while (all.at < all.end && !all.failed) {
        entry e;
        aur_bytes_get(&all, sizeof e, &e);
        if (all.failed || e.size > (size_t)(all.end - all.at) || e.index >= loop->options.count) {
            all.failed = true;
            break;
        }
        aur_bytes_reader one = {.at = all.at, .end = all.at + e.size};
        all.at += e.size;
        aur_result result = (aur_result)e.result;
        if (has_found(result) && !loop->has_result[e.index]) {
            const aur_result taken = unpack(loop, (size_t)e.index, &one);
            loop->has_result[e.index] = taken == AUR_OK;
            loop->rays[e.index] = e.rays;
            loop->foreign_rays += e.rays;
            result = taken != AUR_OK ? taken : result;
        }
        if (loop->is_root) {
            --loop->outstanding[message->from];
            loop->options.note(loop->options.work, (size_t)e.index, result);
        } else if (result != (aur_result)e.result) {
            aur_ranks_fail(loop->ranks, "%s: %s", loop->options.what, aur_result_string(result));
        }
    }
    if (all.failed)
        aur_ranks_fail(loop->ranks, "%s: a result of rank %u is damaged", loop->options.what,
                       (unsigned)message->from);
}

/* --- worker threads */

static bool take(aur_shared_loop *loop, size_t *index) {
    pthread_mutex_lock(&loop->lock);
    ++loop->idle;
    const bool waits = !loop->is_root && !loop->alone;
    while (waits && loop->next == loop->end && !loop->over && !atomic_load(loop->options.stop)) {
        pthread_cond_signal(&loop->wake_messages);
        pthread_cond_wait(&loop->wake_threads, &loop->lock);
    }
    const bool there = loop->next < loop->end && !loop->over && !atomic_load(loop->options.stop);
    if (there)
        *index = loop->next++;
    --loop->idle;
    loop->running += there;
    pthread_mutex_unlock(&loop->lock);
    return there;
}

static void done(aur_shared_loop *loop, size_t index, aur_result result, uint64_t rays) {
    pthread_mutex_lock(&loop->lock);
    loop->rays[index] = rays;
    --loop->running;
    if (!loop->is_root)
        put_entry(loop, index, result, &loop->results);
    loop->has_result[index] = has_found(result);
    if (loop->running == 0)
        pthread_cond_signal(&loop->wake_messages);
    pthread_mutex_unlock(&loop->lock);
}

/* --- the communicating thread */

static size_t give(aur_shared_loop *loop, size_t *first) {
    pthread_mutex_lock(&loop->lock);
    const size_t left = atomic_load(loop->options.stop) ? 0 : loop->end - loop->next;
    size_t count = left / (2 * loop->rank_count * loop->options.threads);
    count = count > 0 ? count : left > 0;
    *first = loop->next;
    loop->next += count;
    pthread_mutex_unlock(&loop->lock);
    return count;
}

static void answer(aur_shared_loop *loop, const aur_message *message) {
    const size_t from = message->from;
    size_t first;
    switch (message->kind) {
    case AUR_MESSAGE_WANT: {
        const size_t count = give(loop, &first);
        loop->outstanding[from] += count;
        if (count > 0)
            aur_ranks_send(loop->ranks, from, AUR_MESSAGE_ITEMS, first, count, 0, NULL);
        break;
    }
    case AUR_MESSAGE_RESULTS:
        loop->outstanding[from] -= (size_t)message->a;
        get_entries(loop, message);
        break;
    case AUR_MESSAGE_STOP:
        loop->options.note(loop->options.work, AUR_LOOP_STOP, (aur_result)(int64_t)message->a);
        break;
    default:
        aur_ranks_fail(loop->ranks, "%s: rank %zu does something else", loop->options.what, from);
    }
}

/* Rank 0: whether all items that were begun have ended. */
static bool is_finished(aur_shared_loop *loop) {
    pthread_mutex_lock(&loop->lock);
    bool finished = loop->running == 0 && (loop->next == loop->end || atomic_load(loop->options.stop));
    pthread_mutex_unlock(&loop->lock);
    for (size_t r = 1; r < loop->rank_count && finished; ++r)
        finished = loop->outstanding[r] == 0;
    return finished;
}

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Waits for threads, or for messages, which must be polled. */
static void wait_a_little(aur_shared_loop *loop, long *pause) {
    enum { FIRST = 50000, LONGEST = 10000000 };
    struct timespec until;
    *pause = *pause == 0 ? FIRST : *pause < LONGEST / 2 ? 2 * *pause : LONGEST;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += *pause;
    if (until.tv_nsec >= 1000000000) {
        until.tv_nsec -= 1000000000;
        ++until.tv_sec;
    }
    pthread_mutex_lock(&loop->lock);
    pthread_cond_timedwait(&loop->wake_messages, &loop->lock, &until);
    pthread_mutex_unlock(&loop->lock);
}

static void messages_as_root(aur_shared_loop *loop, bool (*one)(void *work)) {
    /* Running items of a stopped rank end within some milliseconds; a killed rank never answers. */
    static const double patience = 0.5;
    double stopped = 0.0;
    long pause = 0;
    while (!is_finished(loop) && !aur_ranks_have_failed(loop->ranks)) {
        aur_message message;
        if (atomic_load(loop->options.stop) && !loop->stopping) {
            loop->stopping = true;
            stopped = now();
            for (size_t r = 1; r < loop->rank_count; ++r)
                aur_ranks_send(loop->ranks, r, AUR_MESSAGE_STOP, 0, 0, 0, NULL);
        }
        if (aur_ranks_receive(loop->ranks, AUR_ANY_RANK, &message)) {
            answer(loop, &message);
            free(message.data);
            pause = 0;
        } else if (one == NULL || !one(loop->options.work)) {
            wait_a_little(loop, &pause);
        }
        if (loop->stopping && now() - stopped > patience && !is_finished(loop))
            aur_ranks_lose(loop->ranks);
    }
}

/* Sends the threads' results, returns items not begun, and requests more. */
static void report_to_root(aur_shared_loop *loop, bool stops) {
    pthread_mutex_lock(&loop->lock);
    aur_bytes results = loop->results;
    loop->results = (aur_bytes){0};
    if (stops) {
        loop->given_back += loop->end - loop->next;
        loop->next = loop->end;
    }
    const size_t given_back = loop->given_back;
    loop->given_back = 0;
    const bool needs_items = !stops && !loop->requested && loop->next == loop->end &&
                             (loop->idle > 0 || loop->running < loop->options.threads);
    pthread_mutex_unlock(&loop->lock);
    if (results.failed)
        aur_ranks_fail(loop->ranks, "%s: rank %zu is out of memory", loop->options.what, aur_ranks_rank());
    else if (results.size > 0 || given_back > 0)
        aur_ranks_send(loop->ranks, 0, AUR_MESSAGE_RESULTS, given_back, 0, results.size, results.data);
    aur_bytes_release(&results);
    if (needs_items && !aur_ranks_have_failed(loop->ranks))
        aur_ranks_send(loop->ranks, 0, AUR_MESSAGE_WANT, 0, 0, 0, NULL);
    loop->requested = loop->requested || needs_items;
}

/* Returns whether the loop goes on. */
static bool hear_root(aur_shared_loop *loop, const aur_message *message) {
    switch (message->kind) {
    case AUR_MESSAGE_ITEMS:
        loop->requested = false;
        pthread_mutex_lock(&loop->lock);
        loop->next = (size_t)message->a;
        loop->end = (size_t)(message->a + message->b);
        pthread_cond_broadcast(&loop->wake_threads);
        pthread_mutex_unlock(&loop->lock);
        return true;
    case AUR_MESSAGE_STOP:
        loop->stopping = true;
        atomic_store(loop->options.stop, true);
        return true;
    case AUR_MESSAGE_END:
        loop->options.note(loop->options.work, AUR_LOOP_END, (aur_result)(int64_t)message->a);
        return false;
    default:
        aur_ranks_fail(loop->ranks, "%s: rank 0 does something else", loop->options.what);
        return false;
    }
}

static void messages_to_root(aur_shared_loop *loop, bool (*one)(void *work)) {
    long pause = 0;
    bool goes_on = true;
    while (goes_on && !aur_ranks_have_failed(loop->ranks)) {
        const bool stops = atomic_load(loop->options.stop);
        aur_message message;
        if (stops) {
            pthread_mutex_lock(&loop->lock);
            pthread_cond_broadcast(&loop->wake_threads);
            pthread_mutex_unlock(&loop->lock);
        }
        report_to_root(loop, stops);
        if (stops && !loop->stopping)
            aur_ranks_send(loop->ranks, 0, AUR_MESSAGE_STOP,
                           (uint64_t)(int64_t)loop->options.outcome(loop->options.work), 0, 0, NULL);
        loop->stopping = loop->stopping || stops;
        if (aur_ranks_receive(loop->ranks, 0, &message)) {
            goes_on = hear_root(loop, &message);
            free(message.data);
            pause = 0;
        } else if (one == NULL || !one(loop->options.work)) {
            wait_a_little(loop, &pause);
        }
    }
}

static void exchange_messages(aur_shared_loop *loop, bool (*one)(void *work)) {
    const double start = aur_ranks_messages_begin();
    if (one != NULL) /* no other thread reads it */
        loop->alone = true;
    if (loop->is_root)
        messages_as_root(loop, one);
    else
        messages_to_root(loop, one);
    if (aur_ranks_have_failed(loop->ranks))
        atomic_store(loop->options.stop, true);
    pthread_mutex_lock(&loop->lock);
    loop->over = true;
    pthread_cond_broadcast(&loop->wake_threads);
    pthread_mutex_unlock(&loop->lock);
    if (one == NULL)
        aur_ranks_messages_end(loop->ranks, start);
}

/* Rank 0: all results in the order of items. */
static void spread_results(aur_shared_loop *loop) {
    aur_bytes bytes = {0};
    for (size_t i = 0; i < loop->options.count; ++i) {
        if (loop->has_result[i])
            put_entry(loop, i, AUR_OK, &bytes);
        if (bytes.failed)
            break;
        if (bytes.size >= PIECE) {
            aur_ranks_spread(loop->ranks, false, bytes.size, bytes.data);
            bytes.size = 0;
        }
    }
    if (bytes.failed)
        aur_ranks_fail(loop->ranks, "%s: rank 0 is out of memory", loop->options.what);
    aur_ranks_spread(loop->ranks, true, bytes.size, bytes.data);
    aur_bytes_release(&bytes);
}

static void take_results(aur_shared_loop *loop) {
    aur_message piece;
    bool last = false;
    while (!last && aur_ranks_take(loop->ranks, &piece)) {
        last = piece.a != 0;
        get_entries(loop, &piece);
        free(piece.data);
    }
}

static uint64_t end(aur_shared_loop *loop) {
    aur_ranks *const ranks = loop->ranks;
    const double start = aur_ranks_messages_begin();
    if (loop->is_root && !aur_ranks_have_failed(ranks)) {
        const int64_t result = loop->options.outcome(loop->options.work);
        for (size_t r = 1; r < loop->rank_count; ++r)
            aur_ranks_send(ranks, r, AUR_MESSAGE_END, (uint64_t)result, 0, 0, NULL);
        spread_results(loop);
    } else if (!loop->is_root) {
        take_results(loop);
    }
    aur_ranks_messages_end(ranks, start);
    const uint64_t rays = loop->foreign_rays;
    destroy(loop);
    return rays;
}

static aur_result failure(void *user, aur_error *error) {
    return aur_ranks_have_failed(user) ? aur_ranks_failure(user, error) : AUR_OK;
}

const aur_loop_functions aur_ranks_loops = {create, take, done, exchange_messages, end, failure};

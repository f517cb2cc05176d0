#include "points/ranks/ranks.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "points/base/bytes.h"

enum { PIECE = 1 << 20 };

aur_ranks *aur_ranks_here(void) {
    const aur_io *const io = aur_io_here();
    return io != NULL && io->loops != NULL ? io->user : NULL;
}

size_t aur_ranks_rank(void) {
    return aur_ranks_here() != NULL ? aur_io_here()->rank : 0;
}

size_t aur_ranks_count(void) {
    return aur_ranks_here() != NULL ? aur_io_here()->count : 1;
}

/* --- time */

void aur_ranks_pause(long *pause) {
    enum { FIRST = 50000, LONGEST = 10000000 };
    *pause = *pause == 0 ? FIRST : *pause < LONGEST / 2 ? 2 * *pause : LONGEST;
    nanosleep(&(struct timespec){.tv_nsec = *pause}, NULL);
}

double aur_ranks_seconds(clockid_t clock) {
    struct timespec time;
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

double aur_ranks_messages_begin(void) {
    return aur_ranks_seconds(CLOCK_THREAD_CPUTIME_ID);
}

void aur_ranks_messages_end(aur_ranks *ranks, double start) {
    ranks->message_seconds += aur_ranks_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
}

/* --- messages */

void aur_ranks_begin(aur_ranks *ranks) {
    ranks->step += !aur_ranks_have_failed(ranks);
}

bool aur_ranks_have_failed(const aur_ranks *ranks) {
    return ranks->error.result != AUR_OK;
}

void aur_ranks_fail(aur_ranks *ranks, const char *format, ...) {
    if (aur_ranks_have_failed(ranks))
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(ranks->error.message, sizeof ranks->error.message, format, arguments);
    va_end(arguments);
    ranks->error.result = AUR_ERROR_INTERNAL;
}

void aur_ranks_lose(aur_ranks *ranks) {
    ranks->lost = true;
    aur_ranks_fail(ranks, "a rank no longer answers");
}

aur_result aur_ranks_failure(const aur_ranks *ranks, aur_error *error) {
    return aur_fail(error, ranks->error.result, "%s", ranks->error.message);
}

typedef struct header {
    uint32_t kind, from;
    uint64_t step, a, b;
} header;

void aur_ranks_send(aur_ranks *ranks, size_t to, aur_message_kind kind, uint64_t a, uint64_t b, size_t size,
                    const void *data) {
    const header head = {kind, (uint32_t)ranks->transport.rank, ranks->step, a, b};
    aur_bytes bytes = {0};
    aur_bytes_put(&bytes, sizeof head, &head);
    aur_bytes_put(&bytes, size, data);
    if (bytes.failed || bytes.size > INT32_MAX)
        aur_ranks_fail(ranks, "out of memory for a message of %zu bytes", size);
    else
        ranks->transport.send(ranks->transport.state, to, bytes.size, bytes.data);
    ranks->sent += bytes.size;
    aur_bytes_release(&bytes);
}

bool aur_ranks_receive_any(aur_ranks *ranks, size_t from, aur_message *message) {
    *message = (aur_message){0};
    size_t size = 0;
    if (!ranks->transport.poll(ranks->transport.state, &from, &size))
        return false;
    unsigned char *const data = malloc(size + 1);
    if (data == NULL) {
        aur_ranks_fail(ranks, "out of memory for a message of %zu bytes", size);
        return false;
    }
    header head = {0};
    ranks->transport.receive(ranks->transport.state, from, size, data);
    ranks->received += size;
    if (size >= sizeof head) {
        memcpy(&head, data, sizeof head);
        size -= sizeof head;
        memmove(data, data + sizeof head, size);
    }
    data[size] = '\0';
    *message = (aur_message){.kind = head.kind,
                             .from = (uint32_t)from,
                             .step = head.step,
                             .a = head.a,
                             .b = head.b,
                             .size = size,
                             .data = data};
    return true;
}

/* Whether a message is valid in the present step; otherwise it is dropped. */
static bool accept(aur_ranks *ranks, aur_message *message) {
    const bool is_request = message->kind == AUR_MESSAGE_WANT || message->kind == AUR_MESSAGE_STOP;
    ranks->left += message->kind == AUR_MESSAGE_LEAVE;
    if (message->kind == AUR_MESSAGE_LEAVE)
        aur_ranks_fail(ranks, "rank %u has left the job%s%s", (unsigned)message->from,
                       message->size > 0 ? ": " : "", (const char *)message->data);
    else if (message->step != ranks->step && !(is_request && message->step < ranks->step))
        aur_ranks_fail(ranks,
                       "rank %u does something else than rank %zu: were all started with the same words?",
                       (unsigned)message->from, ranks->transport.rank);
    /* Requests sent while the loop ended are not answered. */
    if (!aur_ranks_have_failed(ranks) && message->step == ranks->step)
        return true;
    free(message->data);
    message->data = NULL;
    return false;
}

bool aur_ranks_receive(aur_ranks *ranks, size_t from, aur_message *message) {
    while (!aur_ranks_have_failed(ranks)) {
        if (ranks->queue_count > 0) { /* rank 0's, on other ranks, which receive only from rank 0 */
            *message = ranks->queue[0];
            memmove(ranks->queue, ranks->queue + 1, --ranks->queue_count * sizeof *ranks->queue);
        } else if (!aur_ranks_receive_any(ranks, from, message)) {
            return false;
        }
        if (accept(ranks, message))
            return true;
    }
    return false;
}

/* While a rank waits for its parent in a broadcast, rank 0 may be a step ahead, or have left. */
static void listen_to_root(aur_ranks *ranks) {
    aur_message message;
    if (!aur_ranks_receive_any(ranks, 0, &message))
        return;
    /* Rank 0 may have left regularly: the expected message is then still in transit. */
    if (message.kind == AUR_MESSAGE_LEAVE && message.step <= ranks->step) {
        (void)accept(ranks, &message);
    } else if (aur_array_reserve(&ranks->queue, &ranks->queue_capacity, ranks->queue_count + 1,
                                 sizeof *ranks->queue)) {
        ranks->queue[ranks->queue_count++] = message;
    } else {
        aur_ranks_fail(ranks, "rank %zu is out of memory", ranks->transport.rank);
        free(message.data);
    }
}

/* Waits for a message of one rank. */
static bool wait_for(aur_ranks *ranks, size_t from, aur_message_kind kind, aur_message *message) {
    const bool aside = from != 0 && ranks->transport.rank != 0;
    long pause = 0;
    for (;;) {
        const bool there = aside ? aur_ranks_receive_any(ranks, from, message) && accept(ranks, message)
                                 : aur_ranks_receive(ranks, from, message);
        if (there)
            break;
        if (aur_ranks_have_failed(ranks))
            return false;
        if (aside)
            listen_to_root(ranks);
        aur_ranks_pause(&pause);
    }
    if (message->kind == kind)
        return true;
    aur_ranks_fail(ranks, "rank %zu does something else than rank %zu: were all started with the same words?",
                   from, ranks->transport.rank);
    free(message->data);
    return false;
}

/* --- collective operations */

/* Ranks form a binomial tree: the parent's number is the rank without its lowest bit. */
static void send_on(aur_ranks *ranks, bool last, size_t size, const void *data) {
    const size_t rank = ranks->transport.rank, count = ranks->transport.count;
    for (size_t bit = 1; rank + bit < count && (rank & bit) == 0; bit *= 2)
        aur_ranks_send(ranks, rank + bit, AUR_MESSAGE_PIECE, last, 0, size, data);
}

bool aur_ranks_spread(aur_ranks *ranks, bool last, size_t size, const void *data) {
    if (aur_ranks_have_failed(ranks))
        return false;
    send_on(ranks, last, size, data);
    return !aur_ranks_have_failed(ranks);
}

bool aur_ranks_take(aur_ranks *ranks, aur_message *piece) {
    const size_t rank = ranks->transport.rank;
    if (aur_ranks_have_failed(ranks) || !wait_for(ranks, rank & (rank - 1), AUR_MESSAGE_PIECE, piece))
        return false;
    send_on(ranks, piece->a != 0, piece->size, piece->data);
    return true;
}

static bool spread_all(aur_ranks *ranks, size_t size, const char *data) {
    size_t done = 0;
    do {
        const size_t piece = size - done < PIECE ? size - done : PIECE;
        if (!aur_ranks_spread(ranks, done + piece == size, piece, data + done))
            return false;
        done += piece;
    } while (done < size);
    return true;
}

static bool take_all(aur_ranks *ranks, aur_bytes *bytes) {
    aur_message piece;
    bool last = false;
    while (!last) {
        if (!aur_ranks_take(ranks, &piece))
            return false;
        last = piece.a != 0;
        aur_bytes_put(bytes, piece.size + last, piece.data); /* with the zero byte */
        free(piece.data);
    }
    if (bytes->failed)
        aur_ranks_fail(ranks, "rank %zu is out of memory", ranks->transport.rank);
    else
        --bytes->size;
    return !bytes->failed;
}

aur_result aur_ranks_broadcast(aur_ranks *ranks, char **data, size_t *size, aur_error *error) {
    const double start = aur_ranks_messages_begin();
    aur_ranks_begin(ranks);
    aur_bytes bytes = {0};
    const bool root = ranks->transport.rank == 0;
    const bool good = root ? spread_all(ranks, *size, *data) : take_all(ranks, &bytes);
    aur_ranks_messages_end(ranks, start);
    if (!good) {
        aur_bytes_release(&bytes);
        return aur_ranks_failure(ranks, error);
    }
    if (!root) {
        *data = (char *)bytes.data;
        *size = bytes.size;
    }
    return AUR_OK;
}

void aur_ranks_agree(size_t size, void *data) {
    aur_ranks *const here = aur_ranks_here();
    if (here == NULL)
        return;
    char *local = data;
    size_t local_size = size;
    if (aur_ranks_broadcast(here, &local, &local_size, NULL) != AUR_OK || here->transport.rank == 0)
        return;
    if (local_size == size)
        memcpy(data, local, size);
    else
        aur_ranks_fail(here, "rank 0 does something else than rank %zu", here->transport.rank);
    free(local);
}

static bool take_parts(aur_ranks *ranks, size_t from, aur_bytes *bytes) {
    aur_message piece;
    bool last = false;
    while (!last) {
        if (!wait_for(ranks, from, AUR_MESSAGE_PART, &piece))
            return false;
        last = piece.a != 0;
        aur_bytes_put(bytes, piece.size, piece.data);
        free(piece.data);
    }
    return !bytes->failed;
}

aur_result aur_ranks_gather(aur_ranks *ranks, size_t size, const void *data, aur_ranks_add add, void *context,
                            aur_error *error) {
    const double start = aur_ranks_messages_begin();
    aur_result result = AUR_OK;
    aur_ranks_begin(ranks);
    if (ranks->transport.rank != 0) {
        size_t done = 0;
        do {
            const size_t piece = size - done < PIECE ? size - done : PIECE;
            aur_ranks_send(ranks, 0, AUR_MESSAGE_PART, done + piece == size, 0, piece,
                           (const char *)data + done);
            done += piece;
        } while (done < size);
    }
    for (size_t r = 1; ranks->transport.rank == 0 && r < ranks->transport.count && result == AUR_OK; ++r) {
        aur_bytes bytes = {0};
        if (take_parts(ranks, r, &bytes))
            result = add(context, r, bytes.size, bytes.data);
        else if (bytes.failed)
            aur_ranks_fail(ranks, "rank 0 is out of memory");
        aur_bytes_release(&bytes);
        if (aur_ranks_have_failed(ranks))
            result = AUR_ERROR_INTERNAL;
    }
    aur_ranks_messages_end(ranks, start);
    if (aur_ranks_have_failed(ranks))
        return aur_ranks_failure(ranks, error);
    return result == AUR_OK ? AUR_OK
                            : aur_fail(error, result, "what the ranks have found cannot be put together");
}

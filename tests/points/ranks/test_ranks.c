/* Ranks as processes connected by sockets: joint results equal those of one process, and the failure of one
 * rank is reported. */
#include "check.h"

#include <poll.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "points/base/bytes.h"
#include "points/base/file.h"
#include "points/base/parallel.h"
#include "points/ranks/ranks.h"

enum { RANKS = 5, ITEMS = 1000, SECONDS = 60 };

/* --- a carrier by sockets: each message with its size before it */

static int ends[RANKS][RANKS]; /* of one rank, to each other one */

static void move(int end, size_t size, void *data, bool sends) {
    for (size_t done = 0; done < size;) {
        const ssize_t count = sends ? write(end, (char *)data + done, size - done)
                                    : read(end, (char *)data + done, size - done);
        if (count <= 0)
            _exit(99);
        done += (size_t)count;
    }
}

static void carry(void *state, size_t to, size_t size, const void *data) {
    const size_t rank = *(const size_t *)state;
    move(ends[rank][to], sizeof size, &size, true);
    move(ends[rank][to], size, (void *)(uintptr_t)data, true);
}

static bool probe(void *state, size_t *from, size_t *size) {
    const size_t rank = *(const size_t *)state;
    for (size_t r = 0; r < RANKS; ++r) {
        struct pollfd end = {.fd = ends[rank][r], .events = POLLIN};
        if (r == rank || (*from != AUR_ANY_RANK && *from != r) || poll(&end, 1, 0) != 1 ||
            recv(end.fd, size, sizeof *size, MSG_PEEK) != sizeof *size)
            continue;
        *from = r;
        return true;
    }
    return false;
}

static void take(void *state, size_t from, size_t size, void *data) {
    const size_t rank = *(const size_t *)state;
    size_t received;
    move(ends[rank][from], sizeof received, &received, false);
    move(ends[rank][from], size, data, false);
}

static void finish(void *state) {
    (void)state;
}

static void end_all(void *state, int status) {
    (void)state;
    _exit(status);
}

/* Runs `body` in every rank: each must return 0, and aur_ranks_leave of rank 0 must return `leaves`. */
static void run(int (*body)(size_t rank), int leaves) {
    pid_t processes[RANKS];
    for (size_t a = 0; a < RANKS; ++a)
        for (size_t b = 0; b < a; ++b) {
            int pair[2];
            assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
            ends[a][b] = pair[0];
            ends[b][a] = pair[1];
        }
    for (size_t rank = 0; rank < RANKS; ++rank) {
        processes[rank] = fork();
        assert_true(processes[rank] >= 0);
        if (processes[rank] > 0)
            continue;
        alarm(SECONDS);
        aur_error error = {0};
        const aur_transport transport = {rank, RANKS, &rank, carry, probe, take, finish, end_all};
        if (aur_ranks_join_by(&transport, &error) != AUR_OK || aur_ranks_rank() != rank ||
            aur_ranks_count() != RANKS)
            _exit(98);
        const int status = body(rank);
        const int all = aur_ranks_leave(status == 7 ? 7 : 0, status == 7 ? "seven" : "", &error);
        if (rank == 0 && (all != leaves || (leaves == 7 && strcmp(error.message, "rank 3: seven") != 0)))
            _exit(97);
        _exit(status == 7 ? 0 : status);
    }
    for (size_t a = 0; a < RANKS; ++a)
        for (size_t b = 0; b < a; ++b) {
            close(ends[a][b]);
            close(ends[b][a]);
        }
    for (size_t rank = 0; rank < RANKS; ++rank) {
        int status = -1;
        assert_int_equal(waitpid(processes[rank], &status, 0), processes[rank]);
        assert_int_equal(status, 0);
    }
}

#define WANT(condition)                                                                                      \
    do {                                                                                                     \
        if (!(condition))                                                                                    \
            return __LINE__ % 90 + 1;                                                                        \
    } while (0)

/* --- joint work */

static aur_result note_rank(void *context, size_t rank, size_t size, const void *data) {
    size_t *const next = context, value;
    memcpy(&value, data, sizeof value);
    if (size < sizeof value || rank != *next || value != rank * rank)
        return AUR_ERROR_INTERNAL;
    ++*next;
    return AUR_OK;
}

static int together(size_t rank) {
    enum { LONG = 3 << 20 };
    size_t size = rank == 0 ? LONG : 0, next = 1;
    char *data = NULL;
    if (rank == 0) {
        data = malloc(LONG);
        WANT(data != NULL);
        for (size_t i = 0; i < LONG; ++i)
            data[i] = (char)(i * i >> 3);
    }
    WANT(aur_ranks_broadcast(aur_ranks_here(), &data, &size, NULL) == AUR_OK && size == LONG);
    for (size_t i = 0; i < LONG; ++i)
        WANT(data[i] == (char)(i * i >> 3));
    /* Larger than a transfer block; the test checks the first word. */
    const size_t square = rank * rank;
    memcpy(data, &square, sizeof square);
    WANT(aur_ranks_gather(aur_ranks_here(), LONG, data, note_rank, &next, NULL) == AUR_OK);
    WANT(next == (rank == 0 ? RANKS : 1));
    free(data);
    /* Rank 0 reads for all: the others ignore their path. */
    WANT(aur_file_read(rank == 0 ? AUR_SOURCE_DIR "/LICENSE" : "/nowhere", SIZE_MAX / 2, &data, &size,
                       NULL) == AUR_OK);
    WANT(size > 1000 && strstr(data, "Apache License") != NULL);
    free(data);
    double wall = 1.0 + (double)rank, cpu = (double)rank;
    aur_ranks_share_seconds(&wall, &cpu);
    WANT(wall == 1.0 && cpu == 0.0 + 1.0 + 2.0 + 3.0 + 4.0);
    return 0;
}

static void ranks_say_the_same(void **state) {
    (void)state;
    run(together, 0);
}

/* --- loops */

typedef struct work {
    double values[ITEMS][2];
    size_t lengths[ITEMS]; /* of the packed items */
    uint64_t done;         /* the sum of the numbers, from 1 on, of the items that this rank did */
    size_t fails;          /* the item that does; ITEMS: none */
} work;

static aur_result do_item(void *context, size_t index) {
    work *const w = context;
    w->values[index][0] = 1.0 / (double)(index + 1);
    w->values[index][1] = (double)index;
    w->lengths[index] = index % 7;
    __atomic_fetch_add(&w->done, index + 1, __ATOMIC_RELAXED);
    return index == w->fails ? AUR_ERROR_FORMAT : AUR_OK;
}

static bool pack(void *context, size_t index, aur_bytes *bytes) {
    const work *const w = context;
    aur_bytes_put(bytes, w->lengths[index], "seven77");
    return true;
}

static aur_result unpack(void *context, size_t index, aur_bytes_reader *bytes) {
    work *const w = context;
    char text[8] = "";
    w->lengths[index] = (size_t)(bytes->end - bytes->at);
    aur_bytes_get(bytes, w->lengths[index], text);
    return bytes->failed || memcmp(text, "seven77", w->lengths[index]) != 0 ? AUR_ERROR_INTERNAL : AUR_OK;
}

static aur_result add_done(void *context, size_t rank, size_t size, const void *data) {
    uint64_t added;
    (void)rank;
    memcpy(&added, data, sizeof added);
    *(uint64_t *)context += added;
    return size == sizeof added ? AUR_OK : AUR_ERROR_INTERNAL;
}

static aur_result loop(work *w, size_t threads, aur_progress progress, aur_error *error) {
    /* An odd size: the last item has one number. */
    const aur_parallel_share share = {
        .slices = {{w->values, sizeof *w->values, sizeof w->values - sizeof(double)}},
        .pack = pack,
        .unpack = unpack};
    const aur_parallel_options options = {
        .threads = threads, .what = "items", .share = &share, .progress = progress};
    return aur_parallel_for(&options, ITEMS, do_item, w, error);
}

static int loops(size_t rank) {
    for (size_t threads = 1; threads <= 3; threads += 2) {
        work w = {.fails = ITEMS};
        WANT(loop(&w, threads, (aur_progress){0}, NULL) == AUR_OK);
        for (size_t i = 0; i < ITEMS; ++i)
            WANT(w.values[i][0] == 1.0 / (double)(i + 1) && (i + 1 == ITEMS || w.values[i][1] == (double)i) &&
                 w.lengths[i] == i % 7);
        /* Each item was done by one rank. */
        WANT(aur_ranks_gather(aur_ranks_here(), sizeof w.done, &w.done, add_done, &w.done, NULL) == AUR_OK);
        WANT(rank != 0 || w.done == ITEMS * (ITEMS + 1) / 2);
    }
    return rank == 3 ? 7 : 0;
}

static void loops_are_shared(void **state) {
    (void)state;
    run(loops, 7);
}

static int failures(size_t rank) {
    (void)rank;
    aur_error error = {0};
    work w = {.fails = ITEMS - 1};
    WANT(loop(&w, 2, (aur_progress){0}, &error) == AUR_ERROR_FORMAT);
    WANT(strncmp(error.message, "items: ", 7) == 0);
    w = (work){.fails = ITEMS};
    WANT(loop(&w, 2, (aur_progress){0}, &error) == AUR_OK); /* and the job continues */
    return 0;
}

static void a_failure_is_everybodys(void **state) {
    (void)state;
    run(failures, 0);
}

static int stop(void *user, const char *what, uint64_t done, uint64_t total) {
    (void)what;
    (void)done;
    (void)total;
    nanosleep(&(struct timespec){.tv_nsec = 1000000},
              NULL); /* so that the items last until the others have noticed */
    return *(const size_t *)user == 2;
}

static int stops(size_t rank) {
    work w = {.fails = ITEMS};
    WANT(loop(&w, 1, (aur_progress){stop, &rank}, NULL) == AUR_ERROR_CANCELLED);
    return 0;
}

static void any_rank_may_stop(void **state) {
    (void)state;
    run(stops, 0);
}

/* A rank that does something else than the others fails, and rank 0 hears of it; nobody waits for ever. */
static int differ(size_t rank) {
    work w = {.fails = ITEMS};
    bool value = true;
    if (rank == 3)
        aur_ranks_agree(sizeof value, &value);
    const aur_result result = loop(&w, 1, (aur_progress){0}, NULL);
    WANT(rank != 3 || result == AUR_ERROR_INTERNAL);
    return rank == 3 ? 7 : 0;
}

static void a_separate_rank_is_reported(void **state) {
    (void)state;
    run(differ, 7);
}

/* A failed rank still receives what its parent is sending, more than a socket buffer holds. */
static int tires(size_t rank) {
    enum { LONG = 3 << 20 };
    if (rank == 3) {
        aur_ranks_fail(aur_ranks_here(), "tired");
        return 7;
    }
    size_t size = rank == 0 ? LONG : 0;
    char *data = rank == 0 ? calloc(LONG, 1) : NULL;
    WANT(aur_ranks_broadcast(aur_ranks_here(), &data, &size, NULL) == AUR_OK && size == LONG);
    free(data);
    return 0;
}

static void nobody_waits_for_a_tired_rank(void **state) {
    (void)state;
    run(tires, 7);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranks_say_the_same),          cmocka_unit_test(loops_are_shared),
        cmocka_unit_test(a_failure_is_everybodys),     cmocka_unit_test(any_rank_may_stop),
        cmocka_unit_test(a_separate_rank_is_reported), cmocka_unit_test(nobody_waits_for_a_tired_rank)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

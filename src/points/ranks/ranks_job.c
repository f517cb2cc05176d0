/* Joining and leaving a job of several processes, and its statistics. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "points/base/simd.h"
#include "points/base/text.h"
#include "points/ranks/ranks.h"

size_t aur_ranks_started(void) {
    /* Slurm sets its count for every task, so it is used only if Slurm also configured communication between
     * tasks. */
    static const char *const counts[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"};
    const size_t variable_count = getenv("PMIX_RANK") != NULL || getenv("PMI_RANK") != NULL ? 3 : 2;
    uint64_t count = 0;
    for (size_t i = 0; i < variable_count; ++i) {
        const char *const text = getenv(counts[i]);
        if (text != NULL && aur_read_integer(text, INT32_MAX, &count) != NULL && count > 1)
            return (size_t)count;
    }
    return 1;
}

static aur_result add_seconds(void *context, size_t rank, size_t size, const void *data) {
    double added;
    (void)rank;
    if (size != sizeof added)
        return AUR_ERROR_INTERNAL;
    memcpy(&added, data, sizeof added);
    *(double *)context += added;
    return AUR_OK;
}

void aur_ranks_share_seconds(double *wall, double *cpu) {
    aur_ranks *const ranks = aur_ranks_here();
    if (ranks == NULL)
        return;
    aur_ranks_gather(ranks, sizeof *cpu, cpu, add_seconds, cpu, NULL);
    double both[2] = {*wall, *cpu};
    aur_ranks_agree(sizeof both, both);
    *wall = both[0];
    *cpu = both[1];
}

/* --- joining and leaving */

typedef struct greeting {
    char version[32], isa[16], rays[16], host[AUR_RANK_HOST_CAPACITY];
} greeting;

typedef struct welcome {
    const greeting *local;
    char refused[AUR_ERROR_MESSAGE_CAPACITY];
} welcome;

static aur_result compare_greeting(void *context, size_t rank, size_t size, const void *data) {
    welcome *const w = context;
    greeting other;
    if (size != sizeof other)
        return AUR_ERROR_INTERNAL;
    memcpy(&other, data, sizeof other);
    if (w->refused[0] != '\0')
        return AUR_OK;
    if (strcmp(other.version, w->local->version) != 0)
        snprintf(w->refused, sizeof w->refused, "rank %zu on %s is aureole %s, rank 0 is %s", rank,
                 other.host, other.version, w->local->version);
    else if (strcmp(other.isa, w->local->isa) != 0 || strcmp(other.rays, w->local->rays) != 0)
        snprintf(w->refused, sizeof w->refused,
                 "rank %zu on %s uses %s, rank 0 on %s %s: images differ in the last bits: set "
                 "AUREOLE_ISA=avx2 for all",
                 rank, other.host, strcmp(other.isa, w->local->isa) != 0 ? other.isa : other.rays,
                 w->local->host, strcmp(other.isa, w->local->isa) != 0 ? w->local->isa : w->local->rays);
    return AUR_OK;
}

static aur_result greet(aur_ranks *ranks, aur_error *error) {
    greeting local = {0};
    snprintf(local.version, sizeof local.version, "%s", aur_version());
    snprintf(local.isa, sizeof local.isa, "%s", aur_isa_name(aur_isa_available()));
    snprintf(local.rays, sizeof local.rays, "%s", aur_isa_name(aur_isa_of_rays()));
    gethostname(local.host, sizeof local.host - 1);
    welcome w = {.local = &local};
    const aur_result result = aur_ranks_gather(ranks, sizeof local, &local, compare_greeting, &w, error);
    if (result != AUR_OK)
        return result;
    aur_ranks_agree(sizeof w.refused, w.refused);
    if (w.refused[0] == '\0')
        return AUR_OK;
    aur_ranks_fail(ranks, "%s", w.refused);
    return aur_fail(error, AUR_ERROR_UNSUPPORTED, "%s", w.refused);
}

static aur_result agree(void *user, size_t size, void *data, aur_error *error) {
    aur_ranks_agree(size, data); /* in the thread's job, which `user` is */
    return aur_ranks_have_failed(user) ? aur_ranks_failure(user, error) : AUR_OK;
}

static aur_result share(void *user, char **data, size_t *size, aur_error *error) {
    return aur_ranks_broadcast(user, data, size, error);
}

static aur_result gather(void *user, size_t size, const void *data, aur_ranks_add add, void *context,
                         aur_error *error) {
    return aur_ranks_gather(user, size, data, add, context, error);
}

static void be_in(aur_ranks *ranks) {
    ranks->io = (aur_io){.user = ranks,
                         .rank = ranks->transport.rank,
                         .count = ranks->transport.count,
                         .agree = agree,
                         .share = share,
                         .gather = gather,
                         .loops = &aur_ranks_loops};
    aur_io_use(&ranks->io);
}

aur_result aur_ranks_join_by(const aur_transport *transport, aur_error *error) {
    aur_ranks *const ranks = calloc(1, sizeof *ranks);
    if (ranks == NULL)
        return aur_fail_memory(error);
    ranks->transport = *transport;
    be_in(ranks);
    return greet(ranks, error);
}

aur_result aur_ranks_join(aur_error *error) {
    aur_transport transport;
    const size_t started = aur_ranks_started();
    if (aur_ranks_here() != NULL || started < 2)
        return AUR_OK;
    const aur_result result = aur_transport_find(&transport, error);
    if (result != AUR_OK)
        return result;
    if (transport.count != started)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "started with %zu ranks by a launcher of another MPI: this one sees %zu", started,
                        transport.count);
    return aur_ranks_join_by(&transport, error);
}

/* Receives remaining messages until every rank has left, so that no sender blocks. */
static int see_off(aur_ranks *ranks, int status, aur_error *error) {
    const bool root = ranks->transport.rank == 0;
    bool over = false;
    long pause = 0;
    while (!over && !(root && ranks->left == ranks->transport.count - 1)) {
        aur_message message;
        if (!aur_ranks_receive_any(ranks, AUR_ANY_RANK, &message)) {
            aur_ranks_pause(&pause);
            continue;
        }
        over = message.kind == AUR_MESSAGE_BYE;
        const bool leaves = message.kind == AUR_MESSAGE_LEAVE;
        ranks->left += leaves;
        if (leaves && status == 0 && message.a != 0) {
            status = (int)message.a;
            aur_fail(error, AUR_ERROR_INTERNAL, "rank %u: %s", (unsigned)message.from,
                     (const char *)message.data);
        }
        free(message.data);
    }
    for (size_t to = 1; root && to < ranks->transport.count; ++to)
        aur_ranks_send(ranks, to, AUR_MESSAGE_BYE, 0, 0, 0, NULL);
    return status;
}

int aur_ranks_leave(int status, const char *said, aur_error *error) {
    aur_ranks *const ranks = aur_ranks_here();
    if (ranks == NULL)
        return status;
    aur_io_use(NULL);
    if (ranks->lost)
        ranks->transport.abort(ranks->transport.state, status);
    /* A rank that waits for rank 0 sees from the step number whether all work was done; if not, no rank may
     * wait for this one. */
    const size_t local = ranks->transport.rank, count = ranks->transport.count;
    const bool failed = aur_ranks_have_failed(ranks);
    aur_ranks_begin(ranks);
    for (size_t to = 0; to < count; ++to)
        if (to != local && (local == 0 || to == 0 || failed))
            aur_ranks_send(ranks, to, AUR_MESSAGE_LEAVE, (uint64_t)status, 0, strlen(said), said);
    status = see_off(ranks, status, error);
    ranks->transport.finish(ranks->transport.state);
    for (size_t i = 0; i < ranks->queue_count; ++i)
        free(ranks->queue[i].data);
    free(ranks->queue);
    free(ranks);
    return status;
}

static aur_result take_description(void *context, size_t rank, size_t size, const void *data) {
    aur_rank_description *const all = context;
    if (size != sizeof *all)
        return AUR_ERROR_INTERNAL;
    memcpy(&all[rank], data, sizeof *all);
    return AUR_OK;
}

void aur_ranks_describe(aur_rank_description *descriptions) {
    aur_ranks *const ranks = aur_ranks_here();
    aur_rank_description local = {.cpu_seconds = aur_ranks_seconds(CLOCK_PROCESS_CPUTIME_ID)};
    gethostname(local.host, sizeof local.host - 1);
    if (ranks != NULL) {
        local.sent = ranks->sent;
        local.received = ranks->received;
        local.message_seconds = ranks->message_seconds;
    }
    if (aur_ranks_rank() == 0)
        descriptions[0] = local;
    if (ranks != NULL)
        aur_ranks_gather(ranks, sizeof local, &local, take_description, descriptions, NULL);
}

/* The inside of a job of several processes: messages between its ranks, and what all of them do together.
 * Each message carries the number of the step that its sender is in, so that ranks which do different things
 * are found out. */
#pragma once

#include <aureole/ranks.h>
#include <stdbool.h>
#include <time.h>

#include "points/base/error.h"
#include "points/base/io.h"

/* What carries bytes from rank to rank. All of it is called by one thread. */
typedef struct aur_transport {
    size_t rank, count;
    void *state;
    /* Comes back when the bytes may be reused; at most INT_MAX of them. */
    void (*send)(void *state, size_t to, size_t size, const void *data);
    /* Whether a message of rank *from (AUR_ANY_RANK: of any, and *from becomes whose) is there, and its size.
     * Messages of one rank keep their order. */
    bool (*poll)(void *state, size_t *from, size_t *size);
    /* Takes the message that poll told of. */
    void (*receive)(void *state, size_t from, size_t size, void *data);
    void (*finish)(void *state);
    /* Ends all processes of the job, this one too. */
    void (*abort)(void *state, int status);
} aur_transport;

#define AUR_ANY_RANK SIZE_MAX

#define AUR_TRANSPORT_MODULE "aureole-mpi.so"
/* What the module for a carrier shows, by the name "aur_transport_open". Starts it, or says why not. */
typedef aur_result (*aur_transport_open_function)(aur_transport *transport, aur_error *error);

/* Finds and starts the transport that this build has (transport.c). Errors: UNSUPPORTED. */
aur_result aur_transport_find(aur_transport *transport, aur_error *error);

typedef enum aur_message_kind {
    AUR_MESSAGE_LEAVE = 1, /* a: status; text: what was said */
    AUR_MESSAGE_BYE,       /* of rank 0, when all have left: nobody sends anything any more */
    AUR_MESSAGE_PIECE,     /* of a broadcast; a: whether it is the last one */
    AUR_MESSAGE_PART,      /* what a rank adds to a sum; a: whether it is the last piece */
    AUR_MESSAGE_WANT,      /* rank r wants items */
    AUR_MESSAGE_ITEMS,     /* a: the first, b: how many */
    AUR_MESSAGE_RESULTS,   /* a: how many items are given back undone; text: results */
    AUR_MESSAGE_STOP,      /* a: why, as a result */
    AUR_MESSAGE_END        /* a: the loop's result */
} aur_message_kind;

typedef struct aur_message {
    uint32_t kind, from;
    uint64_t step, a, b;
    size_t size;
    unsigned char *data; /* the receiver frees it */
} aur_message;

typedef struct aur_ranks {
    aur_transport transport;
    uint64_t step;
    aur_error error;   /* what has failed; its result is AUR_OK while nothing has */
    size_t left;       /* ranks that have said that they leave */
    bool lost;         /* a rank no longer answers */
    aur_message *kept; /* of rank 0, which was ahead */
    size_t kept_count, kept_capacity;
    uint64_t sent, received;
    double message_seconds;
    aur_io io;
} aur_ranks;

/* The job that the calling thread is in; NULL outside of one, as within an item of work that ranks do each
 * for themselves. */
aur_ranks *aur_ranks_here(void);
extern const aur_loop_functions aur_ranks_loops;
/* aur_ranks_join with a carrier of the caller's. */
aur_result aur_ranks_join_by(const aur_transport *transport, aur_error *error);

/* Sends a message with the present step. */
void aur_ranks_send(aur_ranks *ranks, size_t to, aur_message_kind kind, uint64_t a, uint64_t b, size_t size,
                    const void *data);
/* Takes a message of a rank (AUR_ANY_RANK: of any), if there is one. False also after a failure, such as of a
 * rank that has left. */
bool aur_ranks_receive(aur_ranks *ranks, size_t from, aur_message *message);

/* The same with any message, whatever step it is of, also after a failure. */
bool aur_ranks_receive_any(aur_ranks *ranks, size_t from, aur_message *message);

/* Begins a step that all ranks do together. */
void aur_ranks_begin(aur_ranks *ranks);
/* A failure stays: nothing that ranks do together comes to a good end any more. */
bool aur_ranks_have_failed(const aur_ranks *ranks);
void aur_ranks_fail(aur_ranks *ranks, const char *format, ...) AUR_PRINTF(2, 3);
/* A rank no longer answers: whoever is left ends without waiting for it. */
void aur_ranks_lose(aur_ranks *ranks);
/* Fails with what has gone wrong. */
aur_result aur_ranks_failure(const aur_ranks *ranks, aur_error *error);

/* Sends one piece to all ranks, from rank 0; the others take it and hand it on. False after a failure. */
bool aur_ranks_spread(aur_ranks *ranks, bool last, size_t size, const void *data);
bool aur_ranks_take(aur_ranks *ranks, aur_message *piece);
/* Rank 0's data[*size] for all; the others' *data is allocated with malloc, with a zero byte after it. */
aur_result aur_ranks_broadcast(aur_ranks *ranks, char **data, size_t *size, aur_error *error);

/* Gives rank 0 the data of each other rank, one after the other in their order. */
typedef aur_result (*aur_ranks_add)(void *context, size_t rank, size_t size, const void *data);
aur_result aur_ranks_gather(aur_ranks *ranks, size_t size, const void *data, aur_ranks_add add, void *context,
                            aur_error *error);

/* Seconds of one clock on the wall, rank 0's, and of all ranks' processors. */
AUR_INTERNAL void aur_ranks_share_seconds(double *wall, double *cpu);

/* Sleeps, longer the longer nothing has come: *pause is in nanoseconds, 0 at first and after each message. */
AUR_INTERNAL void aur_ranks_pause(long *pause);
double aur_ranks_seconds(clockid_t clock);
/* Counts the thread's processor time since `start` as talk. */
double aur_ranks_messages_begin(void);
void aur_ranks_messages_end(aur_ranks *ranks, double start);

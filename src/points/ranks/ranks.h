/* The implementation of a job of several processes: messages between ranks, and collective operations. Each
 * message has the step number of its sender, so that diverging ranks are detected. */
#pragma once

#include <aureole/ranks.h>
#include <stdbool.h>
#include <time.h>

#include "points/base/error.h"
#include "points/base/io.h"

/* The transport of bytes between ranks. One thread calls all its functions. */
typedef struct aur_transport {
    size_t rank, count;
    void *state;
    /* Returns when the buffer may be reused; at most INT_MAX bytes. */
    void (*send)(void *state, size_t to, size_t size, const void *data);
    /* Whether a message of rank *from (AUR_ANY_RANK: any; *from becomes the sender) is available, and its
     * size. Messages of one rank arrive in order. */
    bool (*poll)(void *state, size_t *from, size_t *size);
    /* Receives the message that poll reported. */
    void (*receive)(void *state, size_t from, size_t size, void *data);
    void (*finish)(void *state);
    /* Ends all processes of the job, including this one. */
    void (*abort)(void *state, int status);
} aur_transport;

#define AUR_ANY_RANK SIZE_MAX

#define AUR_TRANSPORT_MODULE "aureole-mpi.so"
/* The entry point "aur_transport_open" of a transport module: starts the transport, or fails with an error.
 */
typedef aur_result (*aur_transport_open_function)(aur_transport *transport, aur_error *error);

/* Finds and starts the transport that this build has (transport.c). Errors: UNSUPPORTED. */
aur_result aur_transport_find(aur_transport *transport, aur_error *error);

typedef enum aur_message_kind {
    AUR_MESSAGE_LEAVE = 1, /* a: exit status; text: message */
    AUR_MESSAGE_BYE,       /* of rank 0, when all have left: no further messages */
    AUR_MESSAGE_PIECE,     /* of a broadcast; a: whether it is the last */
    AUR_MESSAGE_PART,      /* a rank's contribution to a sum; a: whether it is the last piece */
    AUR_MESSAGE_WANT,      /* rank r requests items */
    AUR_MESSAGE_ITEMS,     /* a: the first, b: the number */
    AUR_MESSAGE_RESULTS,   /* a: number of items returned unprocessed; text: results */
    AUR_MESSAGE_STOP,      /* a: the reason, as a result */
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
    aur_error error;    /* the first failure; its result is AUR_OK if none */
    size_t left;        /* ranks that announced that they leave */
    bool lost;          /* a rank does not answer any more */
    aur_message *queue; /* queued messages of rank 0, which was ahead */
    size_t queue_count, queue_capacity;
    uint64_t sent, received;
    double message_seconds;
    aur_io io;
} aur_ranks;

/* The job of the calling thread; NULL outside a job, and within items that each rank runs separately. */
aur_ranks *aur_ranks_here(void);
extern const aur_loop_functions aur_ranks_loops;
/* aur_ranks_join with a given transport. */
aur_result aur_ranks_join_by(const aur_transport *transport, aur_error *error);

/* Sends a message with the present step. */
void aur_ranks_send(aur_ranks *ranks, size_t to, aur_message_kind kind, uint64_t a, uint64_t b, size_t size,
                    const void *data);
/* Receives a message of a rank (AUR_ANY_RANK: any), if there is one. False also after a failure, such as a
 * rank that left. */
bool aur_ranks_receive(aur_ranks *ranks, size_t from, aur_message *message);

/* The same for messages of any step, also after a failure. */
bool aur_ranks_receive_any(aur_ranks *ranks, size_t from, aur_message *message);

/* Begins a collective step. */
void aur_ranks_begin(aur_ranks *ranks);
/* Records a failure; all later collective operations fail. */
bool aur_ranks_have_failed(const aur_ranks *ranks);
void aur_ranks_fail(aur_ranks *ranks, const char *format, ...) AUR_PRINTF(2, 3);
/* Records that a rank does not answer: the others end without waiting for it. */
void aur_ranks_lose(aur_ranks *ranks);
/* Fails with the recorded error. */
aur_result aur_ranks_failure(const aur_ranks *ranks, aur_error *error);

/* Broadcasts one piece from rank 0; the others receive and forward it. False after a failure. */
bool aur_ranks_spread(aur_ranks *ranks, bool last, size_t size, const void *data);
bool aur_ranks_take(aur_ranks *ranks, aur_message *piece);
/* Broadcasts rank 0's data[*size]; the others' *data is allocated with malloc, with a zero byte after it. */
aur_result aur_ranks_broadcast(aur_ranks *ranks, char **data, size_t *size, aur_error *error);

/* Gathers the data of the other ranks on rank 0, in the order of ranks. */
typedef aur_result (*aur_ranks_add)(void *context, size_t rank, size_t size, const void *data);
aur_result aur_ranks_gather(aur_ranks *ranks, size_t size, const void *data, aur_ranks_add add, void *context,
                            aur_error *error);

/* Wall-clock seconds of rank 0, and processor seconds of all ranks. */
AUR_INTERNAL void aur_ranks_share_seconds(double *wall, double *cpu);

/* Sleeps, longer with each call without a message: *pause is in nanoseconds, 0 at first and after each
 * message. */
AUR_INTERNAL void aur_ranks_pause(long *pause);
double aur_ranks_seconds(clockid_t clock);
/* Adds the thread's processor time since `start` to the time of communication. */
double aur_ranks_messages_begin(void);
void aur_ranks_messages_end(aur_ranks *ranks, double start);

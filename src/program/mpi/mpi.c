/* Message transport by MPI: a module that is only loaded if a launcher has started several processes, so that
 * other runs do not load MPI. Waits sleep between polls, because MPI's waits use a processor. */
#include <mpi.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/ranks/ranks.h"

enum { TAG = 1 };

static void send(void *state, size_t to, size_t size, const void *data) {
    (void)state;
    MPI_Request request;
    long pause = 0;
    int done = 0;
    MPI_Isend(data, (int)size, MPI_BYTE, (int)to, TAG, MPI_COMM_WORLD, &request);
    for (;;) {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done)
            return;
        aur_ranks_pause(&pause);
    }
}

static bool poll(void *state, size_t *from, size_t *size) {
    (void)state;
    MPI_Status status;
    int there = 0, bytes = 0;
    MPI_Iprobe(*from == AUR_ANY_RANK ? MPI_ANY_SOURCE : (int)*from, TAG, MPI_COMM_WORLD, &there, &status);
    if (!there)
        return false;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    *from = (size_t)status.MPI_SOURCE;
    *size = (size_t)bytes;
    return true;
}

/* A long message makes progress only while it is polled, so this sleeps between polls as well. */
static void receive(void *state, size_t from, size_t size, void *data) {
    (void)state;
    MPI_Request request;
    long pause = 0;
    int done = 0;
    MPI_Irecv(data, (int)size, MPI_BYTE, (int)from, TAG, MPI_COMM_WORLD, &request);
    for (;;) {
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done)
            return;
        aur_ranks_pause(&pause);
    }
}

static void finish(void *state) {
    (void)state;
    MPI_Finalize();
}

static void end_all(void *state, int status) {
    (void)state;
    MPI_Abort(MPI_COMM_WORLD, status);
}

AUR_INTERNAL aur_result aur_transport_open(aur_transport *transport, aur_error *error);

aur_result aur_transport_open(aur_transport *transport, aur_error *error) {
    int given = 0, rank = 0, count = 0;
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "MPI does not start");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    *transport = (aur_transport){.rank = (size_t)rank,
                                 .count = (size_t)count,
                                 .send = send,
                                 .poll = poll,
                                 .receive = receive,
                                 .finish = finish,
                                 .abort = end_all};
    return AUR_OK;
}

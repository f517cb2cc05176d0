/* Many processes, one job: the same program is started several times by mpirun (or Slurm's srun), makes the
 * same calls in each, and gets the same results in each, bit for bit those of one process. What takes long is
 * shared out: tiles of images, photons and particles, angles of weight tables, blocks of measures.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_RANKS_H
#define AUREOLE_RANKS_H

#include <aureole/core.h>

#ifdef __cplusplus
extern "C" {
#endif

/* How many processes a launcher says that it has started of this program; 1 without one. */
AUR_EXPERIMENTAL size_t aur_ranks_started(void);

/* Makes the calling thread's further calls part of the job, which is the work of all ranks together; to be
 * called once by every process, in its first thread. From then on
 * - all ranks make the same calls of the library in the same order, from this thread;
 * - files are read by rank 0, which sends the bytes, and written by rank 0 alone;
 * - progress callbacks are called on all ranks, on those after rank 0 with what they know of themselves; any
 * of them may stop the work of all. Errors: UNSUPPORTED for a library without MPI, one that MPI does not know
 * to be of several, and for ranks whose versions or instruction sets differ; MEMORY. */
AUR_EXPERIMENTAL aur_result aur_ranks_join(aur_error *error);

/* Ends the job for this rank, with an exit status and what it has said, and waits for the others. Returns the
 * status of rank 0 or, on rank 0 itself where that is 0, the first other one, and `error` tells whose it is.
 * Returns `status` outside of a job. */
AUR_EXPERIMENTAL int aur_ranks_leave(int status, const char *said, aur_error *error) AUR_NONNULL(2);

/* Of the calling thread's job; 0 and 1 outside of one. */
AUR_EXPERIMENTAL size_t aur_ranks_rank(void);
AUR_EXPERIMENTAL size_t aur_ranks_count(void);

/* Replaces data[size] by rank 0's: for what a rank finds out by itself, such as the time. */
AUR_EXPERIMENTAL void aur_ranks_agree(size_t size, void *data) AUR_NONNULL(2);

enum { AUR_RANK_HOST_CAPACITY = 64 };

/* What a rank has done so far. */
typedef struct aur_rank_description {
    char host[AUR_RANK_HOST_CAPACITY];
    uint64_t sent, received; /* bytes */
    double cpu_seconds;      /* of the process */
    double message_seconds;  /* of them, in talking to other ranks */
} aur_rank_description;

/* On rank 0, fills ranks[aur_ranks_count()]; on others, nothing. All ranks call it. */
AUR_EXPERIMENTAL void aur_ranks_describe(aur_rank_description *ranks) AUR_NONNULL(1);

#ifdef __cplusplus
}
#endif

#endif

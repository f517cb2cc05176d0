/* Parallel jobs of several processes: mpirun (or Slurm's srun) starts the same program several times. Each
 * process makes the same calls and gets the same results, bit-identical to those of one process. Long
 * computations are distributed: tiles of images, photons and particles, angles of weight tables, blocks of
 * measures.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_RANKS_H
#define AUREOLE_RANKS_H

#include <aureole/core.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The number of processes of this program that the launcher reports; 1 without a launcher. */
AUR_EXPERIMENTAL size_t aur_ranks_started(void);

/* Makes the calling thread's further calls part of the job that all ranks share. Every process calls it once,
 * in its first thread. From then on
 * - all ranks make the same calls of the library in the same order, from this thread;
 * - files are read by rank 0, which sends the bytes, and written by rank 0 alone;
 * - progress callbacks are called on all ranks, on ranks other than 0 with their local progress; any rank may
 *   cancel the work of all.
 * Errors: UNSUPPORTED for a library without MPI, for a job that MPI does not report as several processes, and
 * for ranks whose versions or instruction sets differ; MEMORY. */
AUR_EXPERIMENTAL aur_result aur_ranks_join(aur_error *error);

/* Ends the job for this rank with an exit status, and waits for the others. Returns the status of rank 0. On
 * rank 0, if that is 0, returns the first other status, and `error` names the rank. Returns `status` outside
 * of a job. */
AUR_EXPERIMENTAL int aur_ranks_leave(int status, const char *said, aur_error *error) AUR_NONNULL(2);

/* Of the calling thread's job; 0 and 1 outside a job. */
AUR_EXPERIMENTAL size_t aur_ranks_rank(void);
AUR_EXPERIMENTAL size_t aur_ranks_count(void);

/* Replaces data[size] by that of rank 0: for local values such as the time. */
AUR_EXPERIMENTAL void aur_ranks_agree(size_t size, void *data) AUR_NONNULL(2);

enum { AUR_RANK_HOST_CAPACITY = 64 };

/* Statistics of a rank. */
typedef struct aur_rank_description {
    char host[AUR_RANK_HOST_CAPACITY];
    uint64_t sent, received; /* bytes */
    double cpu_seconds;      /* of the process */
    double message_seconds;  /* of them, in messages to other ranks */
} aur_rank_description;

/* Fills ranks[aur_ranks_count()] on rank 0, and nothing on others. All ranks must call it. */
AUR_EXPERIMENTAL void aur_ranks_describe(aur_rank_description *ranks) AUR_NONNULL(1);

#ifdef __cplusplus
}
#endif

#endif

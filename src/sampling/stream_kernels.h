/* The inner loop of the Sobol sampler for each instruction set; all give the same bits. */
#ifndef AUR_SAMPLING_STREAM_KERNELS_H
#define AUR_SAMPLING_STREAM_KERNELS_H

#include "sampling/stream.h"

/* What one pair is randomised by. */
typedef struct aur_pair_seeds {
    uint64_t coordinates; /* the first coordinate's seed in the lower half, the second's in the upper */
    uint64_t index;       /* in the lower half */
} aur_pair_seeds;

static inline aur_pair_seeds aur_pair_seeds_by(uint64_t hash) {
    return (aur_pair_seeds){hash, aur_mix64(hash + 1)};
}

static inline aur_pair_seeds aur_pair_seeds_of(const aur_stream *stream, uint32_t pair) {
    return aur_pair_seeds_by(aur_hash2(stream->pixel, pair));
}

/* The pairs first .. first + AUR_STREAM_BLOCK - 1. */
void aur_sobol_pairs_portable(const aur_stream *stream, uint32_t first, float u[AUR_STREAM_BLOCK][2]);
void aur_sobol_pairs_avx2(const aur_stream *stream, uint32_t first, float u[AUR_STREAM_BLOCK][2]);
void aur_sobol_pairs_avx512(const aur_stream *stream, uint32_t first, float u[AUR_STREAM_BLOCK][2]);

#endif

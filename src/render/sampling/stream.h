/* Random numbers of a light path: for every pixel, sample and dimension pair a point of one two-dimensional
 * set, randomised independently for each pixel and pair ("padding"). Any SET can be used; access is random
 * throughout. */
#pragma once

#include <aureole/core.h>

#include <stdbool.h>

#include "points/base/error.h"
#include "points/base/random.h"

typedef enum aur_sampler_kind {
    AUR_SAMPLER_RANDOM, /* independent numbers */
    AUR_SAMPLER_SOBOL,  /* computed on the fly: Owen-scrambled and -shuffled Sobol */
    AUR_SAMPLER_NET,    /* a table of a net in base 2, Owen-scrambled and -shuffled */
    AUR_SAMPLER_TABLE   /* any other table: randomly permuted, shifted modulo 1 */
} aur_sampler_kind;

typedef struct aur_stream aur_stream;
typedef struct aur_stream_kernels aur_stream_kernels;

enum { AUR_STREAM_BLOCK = 8 }; /* pairs computed at once */

typedef struct aur_sampler {
    aur_sampler_kind kind;
    /* For this processor's instruction set; NULL for tables. */
    const aur_stream_kernels *kernels;
    uint32_t size;         /* points in the table; a power of two for nets */
    uint32_t (*points)[2]; /* words: x / 2^32 */
} aur_sampler;

/* `set` in SET syntax; `count` samples per pixel. */
AUR_INTERNAL aur_result aur_sampler_create(const char *set, size_t count, const aur_warnings *warnings,
                                           aur_sampler **sampler, aur_error *error);
AUR_INTERNAL void aur_sampler_destroy(aur_sampler *sampler);

/* One sample's numbers. `pixel` is a hash of seed and pixel, `index` the sample's number there. */
struct aur_stream {
    const aur_sampler *sampler;
    uint64_t pixel;
    uint32_t index;
};

/* The pair of numbers in [0,1) of dimension pair `pair`. */
void aur_stream_pair(const aur_stream *stream, uint32_t pair, float u[2]);
/* The pairs first .. first + count - 1: faster than one by one, fastest for AUR_STREAM_BLOCK at once. */
void aur_stream_pairs(const aur_stream *stream, uint32_t first, size_t count, float (*u)[2]);
/* One pair for sample `index` of `count` pixels, given by their hashes. */
AUR_INTERNAL void aur_stream_pixels(const aur_sampler *sampler, size_t count, const uint64_t *pixels,
                                    uint32_t index, uint32_t pair, float *u, float *v);
/* The same for sample indices[k] of pixel k. */
void aur_stream_samples(const aur_sampler *sampler, size_t count, const uint64_t *pixels,
                        const uint32_t *indices, uint32_t pair, float *u, float *v);
/* One pair for `count` samples of a pixel, given by their indices. */
void aur_stream_indices(const aur_sampler *sampler, uint64_t pixel, size_t count, const uint32_t *indices,
                        uint32_t pair, float *u, float *v);
/* A single number in [0,1); uses a whole pair. */
float aur_stream_single(const aur_stream *stream, uint32_t pair);

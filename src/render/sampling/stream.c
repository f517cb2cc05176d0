#include "render/sampling/stream.h"

#include <aureole/sphere.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "render/sampling/stream_kernels.h"

static aur_result fill_table(aur_sampler *sampler, const char *set, const aur_warnings *warnings,
                             aur_error *error) {
    aur_pointset *points = NULL;
    const aur_pointset_options options = {.size = sizeof options,
                                          .count = sampler->size,
                                          .dimension = 2,
                                          .warnings = warnings != NULL ? *warnings : (aur_warnings){0}};
    aur_result result = aur_pointset_create(set, &options, &points, error);
    if (result != AUR_OK)
        return result;
    double *const values = malloc(2 * sizeof *values * sampler->size);
    sampler->points = malloc(sizeof *sampler->points * sampler->size);
    if (values == NULL || sampler->points == NULL)
        result = aur_fail(error, AUR_ERROR_MEMORY, "out of memory for a sampler of %u points", sampler->size);
    if (result == AUR_OK)
        result = aur_pointset_points(points, 0, sampler->size, 2 * (size_t)sampler->size, values, error);
    for (size_t i = 0; i < sampler->size && result == AUR_OK; ++i)
        for (size_t k = 0; k < 2; ++k)
            sampler->points[i][k] = (uint32_t)(values[2 * i + k] * 0x1p32);
    free(values);
    aur_pointset_destroy(points);
    return result;
}

aur_result aur_sampler_create(const char *set, size_t count, const aur_warnings *warnings, aur_sampler **out,
                              aur_error *error) {
    *out = NULL;
    if (count == 0 || count > (size_t)1 << 30)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "samples per pixel must be between 1 and 2^30, not %zu",
                        count);
    aur_sampler *const sampler = calloc(1, sizeof *sampler);
    if (sampler == NULL)
        return aur_fail_memory(error);
    aur_result result = AUR_OK;
    if (strcmp(set, "random") == 0) {
        sampler->kind = AUR_SAMPLER_RANDOM;
        sampler->kernels = &AUR_KERNEL_HERE(aur_stream_kernels).random;
    } else if (strcmp(set, "sobol") == 0) {
        sampler->kind = AUR_SAMPLER_SOBOL;
        sampler->kernels = &AUR_KERNEL_HERE(aur_stream_kernels).sobol;
    } else {
        const aur_set_description *const row = aur_set_find(set);
        sampler->kind = row != NULL && row->binary_net ? AUR_SAMPLER_NET : AUR_SAMPLER_TABLE;
        sampler->size = (uint32_t)count;
        if (sampler->kind == AUR_SAMPLER_NET)
            for (sampler->size = 1; sampler->size < count;)
                sampler->size *= 2;
        result = fill_table(sampler, set, warnings, error);
    }
    if (result != AUR_OK) {
        aur_sampler_destroy(sampler);
        return result;
    }
    *out = sampler;
    return AUR_OK;
}

void aur_sampler_destroy(aur_sampler *sampler) {
    if (sampler == NULL)
        return;
    free(sampler->points);
    free(sampler);
}

/* A random permutation of 0..size-1 by hashing and cycle walking (Kensler 2013, for its method; the mixing is
 * ours). */
static uint32_t permute(uint32_t index, uint32_t size, uint32_t seed) {
    uint32_t mask = size - 1;
    mask |= mask >> 1;
    mask |= mask >> 2;
    mask |= mask >> 4;
    mask |= mask >> 8;
    mask |= mask >> 16;
    do {
        index ^= seed & mask;
        index = index * 0xe170893du & mask;
        index ^= (index & mask) >> 4;
        index ^= (seed >> 7) & mask;
        index = index * ((seed >> 9) | 1u) & mask;
        index ^= index >> 2;
        index = index * 0x0929eb3fu & mask;
        index ^= index >> 3 ^ (seed >> 17 & mask);
        index = index * (seed | 1u) & mask;
    } while (index >= size);
    return index;
}

/* The words of a sample from a table. */
static void table_words(const aur_stream *stream, uint64_t hash, uint32_t words[2]) {
    const aur_sampler *const sampler = stream->sampler;
    /* Beyond its end a table starts again with another randomisation. */
    if (stream->index >= sampler->size)
        hash = aur_hash2(hash, stream->index / sampler->size);
    const uint32_t shuffle = (uint32_t)aur_mix64(hash + 1);
    uint32_t index;
    if (sampler->kind == AUR_SAMPLER_NET) {
        index = aur_owen_scramble(stream->index, shuffle) & (sampler->size - 1);
        words[0] = aur_owen_scramble(sampler->points[index][0], (uint32_t)hash);
        words[1] = aur_owen_scramble(sampler->points[index][1], (uint32_t)(hash >> 32));
        return;
    }
    index = permute(stream->index % sampler->size, sampler->size, shuffle);
    words[0] = sampler->points[index][0] + (uint32_t)hash;
    words[1] = sampler->points[index][1] + (uint32_t)(hash >> 32);
}

static void one_pair(const aur_stream *stream, uint32_t pair, float u[2]) {
    const uint64_t hash = aur_hash2(stream->pixel, pair);
    uint32_t words[2];
    switch (stream->sampler->kind) {
    case AUR_SAMPLER_SOBOL:
        aur_sobol_pair(aur_reverse_bits(stream->index), hash, &u[0], &u[1]);
        return;
    case AUR_SAMPLER_RANDOM:
        aur_random_pair(stream->index, hash, &u[0], &u[1]);
        return;
    default:
        table_words(stream, hash, words);
        u[0] = aur_unit_float(words[0]);
        u[1] = aur_unit_float(words[1]);
    }
}

static void blocks(const aur_stream *stream, uint32_t first, size_t count, float (*u)[2]) {
    const aur_stream_kernels *const kernels = stream->sampler->kernels;
    for (; count >= AUR_STREAM_BLOCK; first += AUR_STREAM_BLOCK, count -= AUR_STREAM_BLOCK) {
        kernels->pairs(stream, first, u);
        u += AUR_STREAM_BLOCK;
    }
    if (count == 0)
        return;
    float rest[AUR_STREAM_BLOCK][2];
    kernels->pairs(stream, first, rest);
    memcpy(u, rest, count * sizeof rest[0]);
}

void aur_stream_pairs(const aur_stream *stream, uint32_t first, size_t count, float (*u)[2]) {
    if (count > 2 && stream->sampler->kernels != NULL) {
        blocks(stream, first, count, u);
        return;
    }
    for (uint32_t i = 0; i < count; ++i)
        one_pair(stream, first + i, u[i]);
}

void aur_stream_pair(const aur_stream *stream, uint32_t pair, float u[2]) {
    aur_stream_pairs(stream, pair, 1, (float(*)[2])u);
}

void aur_stream_pixels(const aur_sampler *sampler, size_t count, const uint64_t *pixels, uint32_t index,
                       uint32_t pair, float *u, float *v) {
    if (sampler->kernels != NULL) {
        sampler->kernels->pixels(count, pixels, index, pair, u, v);
        return;
    }
    for (size_t k = 0; k < count; ++k) {
        const aur_stream stream = {sampler, pixels[k], index};
        float both[2];
        aur_stream_pair(&stream, pair, both);
        u[k] = both[0];
        v[k] = both[1];
    }
}

void aur_stream_samples(const aur_sampler *sampler, size_t count, const uint64_t *pixels,
                        const uint32_t *indices, uint32_t pair, float *u, float *v) {
    if (sampler->kernels != NULL) {
        sampler->kernels->samples(count, pixels, indices, pair, u, v);
        return;
    }
    for (size_t k = 0; k < count; ++k)
        aur_stream_pixels(sampler, 1, &pixels[k], indices[k], pair, &u[k], &v[k]);
}

void aur_stream_indices(const aur_sampler *sampler, uint64_t pixel, size_t count, const uint32_t *indices,
                        uint32_t pair, float *u, float *v) {
    if (sampler->kernels != NULL) {
        sampler->kernels->indices(aur_hash2(pixel, pair), count, indices, u, v);
        return;
    }
    for (size_t k = 0; k < count; ++k) {
        const aur_stream stream = {sampler, pixel, indices[k]};
        float both[2];
        aur_stream_pair(&stream, pair, both);
        u[k] = both[0];
        v[k] = both[1];
    }
}

float aur_stream_single(const aur_stream *stream, uint32_t pair) {
    float u[2];
    aur_stream_pair(stream, pair, u);
    return u[0];
}

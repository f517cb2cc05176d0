/* The interface of point sets, which each generator's file implements for the table (sets.h). */
#pragma once

#include <aureole/pointset.h>
#include <stdbool.h>

#include "points/base/keys.h"
#include "points/pointset/words.h"

/* A range of coordinates and points, and their destination: coordinate first_dimension + d of point first + i
 * is written to data[i + d * coordinate_stride]. */
typedef struct aur_block {
    uint64_t first;
    size_t count;
    size_t first_dimension, dimension_count;
    size_t coordinate_stride;
    uint64_t seed; /* of the scrambling */
    double *data;
} aur_block;

/* The limit of sets that count in 64-bit integers with the next power of a base in range. */
#define AUR_INDEX_LIMIT (UINT64_C(1) << 48)

enum {
    AUR_SCRAMBLES_SHIFT = 1 << AUR_SCRAMBLE_NONE | 1 << AUR_SCRAMBLE_SHIFT | 1 << AUR_SCRAMBLE_ROTATE,
    AUR_SCRAMBLES_ALL = AUR_SCRAMBLES_SHIFT | 1 << AUR_SCRAMBLE_DIGIT | 1 << AUR_SCRAMBLE_OWEN,
    AUR_SCRAMBLES_BINARY = AUR_SCRAMBLES_ALL | 1 << AUR_SCRAMBLE_NESTED
};

/* aur_set_description.domains */
enum {
    AUR_ON_SQUARE = 1 << AUR_DOMAIN_SQUARE,
    AUR_ON_CUBE = 1 << AUR_DOMAIN_CUBE,
    AUR_ON_DISK = 1 << AUR_DOMAIN_DISK,
    AUR_ON_HEMISPHERE = 1 << AUR_DOMAIN_HEMISPHERE,
    AUR_ON_SPHERE = 1 << AUR_DOMAIN_SPHERE,
    AUR_ON_AXES = 1 << AUR_DOMAIN_AXES,
    AUR_ON_ROTATIONS = 1 << AUR_DOMAIN_ROTATIONS
};

/* One row of the table of square sets. */
typedef struct aur_square_set {
    aur_set_description description;
    const void *kind_data; /* private to kinds that share prepare() and fill(); or NULL */
    unsigned scramblings;  /* bits 1 << aur_scramble: the supported scramblings */
    /* Reads the keys and prepares set->data (NULL: no keys and no data). Size, dimension, scrambling, seed
     * and net_base are set and within the limits above; a key or a file may change them. */
    aur_result (*prepare)(aur_pointset *set, aur_parameters *keys, aur_error *error);
    /* Coordinates in [0,1) with NONE, DIGIT, OWEN and NESTED applied; SHIFT and ROTATE are added by the
     * caller. */
    void (*fill)(const aur_pointset *set, const aur_block *block);
    /* The same for the first two coordinates, written to data[2 i + d]; false if there is no fast path. Or
     * NULL. */
    bool (*fill_pairs)(const aur_pointset *set, const aur_block *block);
} aur_square_set;

struct aur_pointset {
    const aur_square_set *kind;
    uint64_t size;
    size_t dimension;
    aur_scramble scramble;
    uint64_t seed;
    bool fold;                           /* the baker's transform is applied last */
    uint64_t net_base;                   /* the points are a complete net at its powers; 0: no net */
    const aur_pointset_options *options; /* while the set is prepared; then NULL */
    void *data;                          /* private to the generator, one allocation; or NULL */
};

/* Checks size, dimension and scrambling against the limits of the kind of set. */
aur_result aur_pointset_check(const aur_pointset *set, aur_error *error);

/* Checks that a set of `size` points has the points first .. first+count-1. Errors: ARGUMENT. */
aur_result aur_check_range(uint64_t size, uint64_t first, uint64_t count, aur_error *error);

/* The strides of an output's buffer: coordinate d of point i is at i * point_stride + d * coordinate_stride.
 * Errors: ARGUMENT for an inconsistent output, CAPACITY if `count` points do not fit. */
typedef struct aur_strides {
    size_t point, coordinate;
} aur_strides;
aur_result aur_output_open(const aur_output *output, size_t dimension, size_t count, aur_strides *strides,
                           aur_error *error);

/* The number of elements for `count` points (`stride` as above, ignored for POINTS); SIZE_MAX on overflow. */
size_t aur_output_capacity(aur_layout layout, size_t dimension, size_t count, size_t stride);

/* Writes coordinates to points first .. first + count - 1 of an output that begins with this coordinate.
 * Floats are truncated to 24 binary digits. */
void aur_output_put(const aur_output *output, aur_strides strides, size_t first, size_t count,
                    const double *values);
/* The first of `count` points of two doubles that can be streamed: it is aligned to 64 bytes. SIZE_MAX: none.
 */
size_t aur_output_stream_start(size_t count, const double *points);

/* Writes points into the caller's buffer, scrambled with `seed`. */
aur_result aur_pointset_emit(const aur_pointset *set, uint64_t seed, uint64_t first, size_t count,
                             const aur_output *output, aur_error *error);

/* The coordinates of a block with every scrambling applied. The block must be within the set. */
void aur_pointset_fill(const aur_pointset *set, const aur_block *block);

/* Fills a block from set->data, size * dimension doubles. */
void aur_fill_table(const aur_pointset *set, const aur_block *block);

/* The coordinate i/N of coordinate `d` of the block, with DIGIT and OWEN as in base 2. */
void aur_fill_fraction(const aur_pointset *set, const aur_block *block, size_t d);

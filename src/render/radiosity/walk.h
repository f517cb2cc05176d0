/* The random walk of all triangles at once (Keller 1994, eq. 15): path i starts at a light and makes M + 1
 * flights, each decision by two coordinates of point i; every triangle that it hits receives its power. */
#pragma once

#include <aureole-render/radiosity.h>

#include "render/radiosity/scene.h"
#include "render/scene/patches.h"

/* A sum independent of the order of its terms: non-negative fixed-point numbers, added in 128 bits. */
typedef struct aur_exact_sum {
    uint64_t low, high;
} aur_exact_sum;

static inline void aur_exact_add(aur_exact_sum *sum, uint64_t term) {
    sum->low += term;
    sum->high += sum->low < term;
}

static inline void aur_exact_merge(aur_exact_sum *sum, const aur_exact_sum *other) {
    aur_exact_add(sum, other->low);
    sum->high += other->high;
}

static inline double aur_exact_value(const aur_exact_sum *sum) {
    return (double)sum->high * 0x1p64 + (double)sum->low;
}

/* The results of the paths of one randomisation: the power that each patch received, and how the paths ended.
 * Sums are exact, so tallies of several threads can be added in any order. */
typedef struct aur_radiosity_tally {
    size_t patch_count;
    aur_exact_sum (*power)[3]; /* patch -> quanta received */
    aur_exact_sum last;        /* received by the last flight, all channels */
    aur_exact_sum rest;        /* carried on after it */
    uint64_t rays, lost, behind, trapped;
    uint64_t cut;    /* terms beyond a sum's range; not stored in files */
    bool not_finite; /* a term was not finite: the sums are invalid */
} aur_radiosity_tally;

/* So many empty tallies; NULL on failure. Errors: MEMORY. */
aur_result aur_radiosity_tallies_create(size_t count, size_t patch_count, aur_radiosity_tally **tallies,
                                        aur_error *error);
void aur_radiosity_tallies_release(size_t count, aur_radiosity_tally *tallies); /* NULL is allowed */
/* Adds `other` and empties it. */
void aur_radiosity_tally_take(aur_radiosity_tally *tally, aur_radiosity_tally *other);
/* Sums the tallies over all processes of a job (points/base/io.h); a single process changes nothing. */
aur_result aur_radiosity_tallies_share(size_t count, aur_radiosity_tally *tallies, aur_error *error);

typedef struct aur_radiosity_walk {
    const aur_radiosity_scene *scene;
    const aur_radiosity_options *options;
    size_t light_count;
    uint32_t *lights; /* triangles, in the order of the choice */
    double (
        *start)[3]; /* light -> power of a path that starts there, in quanta, without the number of paths */
    aur_distribution choice;
    double quantum; /* watts: the unit of the sums */
} aur_radiosity_walk;

aur_result aur_radiosity_walk_create(const aur_radiosity_scene *scene, const aur_radiosity_options *options,
                                     aur_radiosity_walk *walk, aur_error *error);
void aur_radiosity_walk_release(aur_radiosity_walk *walk);

enum { AUR_RADIOSITY_BLOCK = 512 };

/* Traces the paths of points first .. first + count - 1, count <= AUR_RADIOSITY_BLOCK. `key` selects the
 * randomisation. */
void aur_radiosity_walk_block(const aur_radiosity_walk *walk, const aur_pointset *set, uint64_t key,
                              uint64_t first, size_t count, aur_radiosity_tally *tally);

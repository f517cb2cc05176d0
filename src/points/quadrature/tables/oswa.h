/* The implementation of a pair of patterns, and solving at one angle for many turns. The patterns, their
 * blocks of the matrix and their z are computed once; aur_oswa_angle has the data that depend on the angle.
 */
#pragma once

#include <stdbool.h>

#include "points/quadrature/potential/potential.h"

/* The patterns are numbered 0 (about the normal) and 1 (about the mirror direction). */
struct aur_oswa {
    /* `set` and `weights` point to the members below; smoothness is filled in. */
    aur_oswa_options options;
    aur_weights_options weights;
    char *set;
    size_t count[2];
    aur_lobe lobe[2];        /* of the weights */
    aur_lobe sampled[2];     /* of the sampling density */
    double *uniform[2];      /* uniform directions of the hemisphere; owns the memory of the next three */
    double *pattern[2];      /* warped, about +z; GGX: unused. For a pattern without samples all are NULL */
    double *kernel[2];       /* count * count, lower triangle: the constant blocks; GGX: [1] is NULL */
    double *self_z[2];       /* z of each pattern for its own lobe, unclipped; GGX: [1] is NULL */
    aur_potential *whole[2]; /* of each lobe about +z, unclipped; GGX: [1] is NULL */
    aur_potential_table *published_z; /* NULL: z is exact */
};

/* Checks the caller's options and copies them, with all defaults filled in, to *copy. Its `set` remains the
 * caller's string; its `weights` points to *weights. */
aur_result aur_oswa_options_read(const aur_oswa_options *given, aur_oswa_options *copy,
                                 aur_weights_options *weights, aur_error *error);

/* Without `solves` only the patterns, which suffice for reading a table of weights. */
aur_result aur_oswa_create_for(const aur_oswa_options *options, bool solves, aur_oswa **oswa,
                               aur_error *error);

/* The number of lobes with weights: the first counts only if it has samples. */
static inline size_t aur_oswa_lobes(const aur_oswa *oswa) {
    return oswa->count[0] > 0 ? 2 : 1;
}

/* The view: its angle, and the roughness of a GGX lobe (otherwise unused). */
typedef struct aur_oswa_view {
    double radians, alpha;
} aur_oswa_view;

/* The angle, with the roughness of the options. */
aur_oswa_view aur_oswa_view_at(const aur_oswa *oswa, double radians);

/* Data that depend on the view but not on the turns. */
typedef struct aur_oswa_angle {
    aur_oswa_view view;
    double mass;              /* of the mirror lobe */
    aur_lune lune;            /* clipped COSINE_POWER */
    aur_potential *potential; /* GGX */
} aur_oswa_angle;

aur_result aur_oswa_angle_init(const aur_oswa *oswa, aur_oswa_view view, aur_oswa_angle *angle,
                               aur_error *error);
void aur_oswa_angle_release(aur_oswa_angle *angle);

/* Whether samples below the surface are left out. */
bool aur_oswa_hides(const aur_oswa *oswa);

/* Which samples are above the surface, if clipped; xyz[3 * size] are their positions. */
void aur_oswa_visible(const aur_oswa *oswa, aur_oswa_view view, const double turns[2], double *xyz,
                      bool *visible);

/* aur_oswa_points for any roughness. */
aur_result aur_oswa_place(const aur_oswa *oswa, aur_oswa_view view, const double turns[2], bool mirrored,
                          size_t capacity, double *xyz, aur_error *error);

/* The height above the surface of sample `index` of the pattern about the mirror direction. */
double aur_oswa_height(const aur_oswa *oswa, aur_oswa_view view, double turns, size_t index);

/* Doubles of scratch memory that a solve needs. */
size_t aur_oswa_scratch(const aur_oswa *oswa);
/* The weights of each lobe with only the samples `taken`, which must be visible up to rounding; the others
 * get 0. */
aur_result aur_oswa_solve_at(const aur_oswa *oswa, const aur_oswa_angle *angle, const double turns[2],
                             const bool *taken, double *scratch, double *weights, aur_error *error);

/* A hash of the patterns: programs that compute a set differently do not share a table. */
uint64_t aur_oswa_hash(const aur_oswa *oswa);

/* What the keys of final gathering say. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Which lobes are gathered. */
typedef enum aur_gather_component {
    AUR_COMPONENT_ALL,
    AUR_COMPONENT_DIFFUSE,
    AUR_COMPONENT_GLOSSY
} aur_gather_component;
/* Light straight from lights: by points drawn on them, by gather rays that meet them, or left out. */
typedef enum aur_gather_direct { AUR_DIRECT_NEE, AUR_DIRECT_GATHER, AUR_DIRECT_NONE } aur_gather_direct;
/* What gather rays bring: what photons know and what lights emit, or the latter only. */
typedef enum aur_gather_incident { AUR_INCIDENT_PHOTONS, AUR_INCIDENT_EMITTERS } aur_gather_incident;
/* How the rotations of neighbouring pixels differ: dithered over blocks of 4 x 4, by chance, not at all. */
typedef enum aur_gather_decorrelation {
    AUR_DECORRELATION_BLUE,
    AUR_DECORRELATION_RANDOM,
    AUR_DECORRELATION_NONE
} aur_gather_decorrelation;
/* Of samples: p/q or 1; optimal for one lobe, for two lobes merged (OSWA); the balance heuristic; optimal as
 * published, a system solved at every place. */
typedef enum aur_gather_weights {
    AUR_WEIGHTS_RATIO,
    AUR_WEIGHTS_EQUAL,
    AUR_WEIGHTS_OSW,
    AUR_WEIGHTS_OSWA,
    AUR_WEIGHTS_MIS,
    AUR_WEIGHTS_SOLVE
} aur_gather_weights;
typedef enum aur_gather_criterion { AUR_CRITERION_ENTROPY, AUR_CRITERION_VARIANCE } aur_gather_criterion;
typedef enum aur_density_choice {
    AUR_GATHER_DENSITY_SAME,
    AUR_GATHER_DENSITY_OPTIMAL,
    AUR_GATHER_DENSITY_UNSAID
} aur_density_choice;

typedef enum aur_gather_pixel { AUR_PIXEL_FILTER, AUR_PIXEL_CENTRE } aur_gather_pixel;

typedef struct aur_gather_parameters {
    int64_t diffuse_samples, glossy_samples, rotations, photons, max_depth, edges;
    int64_t levels, level_factor, caustic_photons, bright_samples, light_samples;
    uint64_t pattern_seed;
    double smoothness;
    double regularization, threshold; /* negative until it is known what they default to */
    double photons_a_texel;
    const char *pattern, *map, *photon_set;
    const char *scramble; /* NULL: by the pattern */
    aur_density_choice density;
    aur_gather_weights weights;
    aur_gather_component component;
    aur_gather_direct direct;
    aur_gather_incident incident;
    aur_gather_pixel pixel;
    aur_gather_decorrelation decorrelation;
    aur_gather_criterion criterion;
    bool packets, clip, adaptive, share;
} aur_gather_parameters;

/* Whether both patterns' samples serve both lobes. */
static inline bool aur_merges_samples(const aur_gather_parameters *p) {
    return p->weights == AUR_WEIGHTS_OSWA || p->weights == AUR_WEIGHTS_MIS || p->weights == AUR_WEIGHTS_SOLVE;
}

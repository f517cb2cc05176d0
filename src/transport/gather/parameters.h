/* The keys of final gathering. */
#ifndef AUR_TRANSPORT_GATHER_PARAMETERS_H
#define AUR_TRANSPORT_GATHER_PARAMETERS_H

#include "transport/gather/plan.h"

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

#endif

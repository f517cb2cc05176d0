/* The keys of final gathering. */
#ifndef AUR_TRANSPORT_GATHER_PARAMETERS_H
#define AUR_TRANSPORT_GATHER_PARAMETERS_H

#include "transport/gather/plan.h"

enum { AUR_DENSITY_SAME, AUR_DENSITY_OPTIMAL, AUR_DENSITY_UNSAID };

typedef struct aur_gather_parameters {
    int64_t diffuse_samples, glossy_samples, rotations, photons, max_depth, pattern_seed, edges;
    int64_t levels, level_factor, caustic_photons, bright_samples, light_samples;
    double smoothness, regularization, photons_a_texel, threshold;
    const char *pattern, *map, *scramble, *photon_set;
    size_t density, weights, component, direct, incident, pixel, decorrelation, criterion;
    bool packets, clip, adaptive, share;
} aur_gather_parameters;

/* Reads all keys, with what they mean together. */
aur_result aur_final_gather_read(aur_parameters *parameters, aur_gather_parameters *p, aur_error *error);
/* What the rules have in common. */
aur_result aur_final_gather_options(const aur_gather_parameters *p, const aur_integrator_context *context,
                                    aur_gather_options *options, aur_error *error);

/* Whether both patterns' samples serve both lobes. */
static inline bool aur_merges_samples(const aur_gather_parameters *p) {
    return p->weights == AUR_WEIGHTS_OSWA || p->weights == AUR_WEIGHTS_MIS || p->weights == AUR_WEIGHTS_SOLVE;
}

#endif

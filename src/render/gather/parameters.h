/* What the keys of final gathering say. */
#pragma once

#include "render/sampling/rule.h"

/* Which lobes are gathered. */
typedef enum aur_gather_component {
    AUR_COMPONENT_ALL,
    AUR_COMPONENT_DIFFUSE,
    AUR_COMPONENT_GLOSSY
} aur_gather_component;
/* Light straight from lights: by points drawn on them, by gather rays that meet them, or left out. */
typedef enum aur_gather_direct { AUR_DIRECT_NEE, AUR_DIRECT_GATHER, AUR_DIRECT_NONE } aur_gather_direct;
/* What gather rays bring: what photons know and what lights emit, or the latter only, or what the photon map
 * is wrong by. */
typedef enum aur_gather_incident {
    AUR_INCIDENT_PHOTONS,
    AUR_INCIDENT_EMITTERS,
    AUR_INCIDENT_CORRECTION
} aur_gather_incident;
/* How the rotations of neighbouring pixels differ: dithered over blocks of 4 x 4, by chance, not at all. */
typedef enum aur_gather_decorrelation {
    AUR_DECORRELATION_BLUE,
    AUR_DECORRELATION_RANDOM,
    AUR_DECORRELATION_NONE
} aur_gather_decorrelation;
/* Of samples: p/q or 1; optimal for one lobe; and for two lobes merged: optimal (OSWA), by the balance
 * heuristic, optimal as published with a system solved at every place. */
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
/* Diffuse light that pixels have in common with their neighbours: none; one pattern is split among the pixels
 * of 4 x 4, which pool what they find; patterns complete each other, and pixels pool with the nearest. */
typedef enum aur_gather_share { AUR_SHARE_NONE, AUR_SHARE_BLOCKS, AUR_SHARE_NEAR } aur_gather_share;
typedef enum aur_gather_pixel { AUR_PIXEL_FILTER, AUR_PIXEL_CENTRE } aur_gather_pixel;

/* What is asked for while the picture is rendered. */
typedef struct aur_gather_policy {
    aur_gather_component component;
    aur_gather_direct direct;
    aur_gather_decorrelation decorrelation;
    aur_gather_criterion criterion; /* of adaptive gathering */
    /* Of the criterion: where a lobe's samples differ more, the next level is gathered. Negative until it is
     * known what it defaults to. */
    float threshold;
    bool adaptive;
    aur_gather_share share;
    bool packets; /* else every ray by itself: the same picture to rounding, for tests and measurements */
    uint32_t max_depth;    /* edges of a light path; UINT32_MAX: no limit */
    uint32_t edge_samples; /* camera rays more where a pixel sees several things */
} aur_gather_policy;

/* Texts are the caller's, and are read only while a plan is made. */
typedef struct aur_gather_parameters {
    aur_gather_policy policy;
    aur_gather_rule_options rule; /* of all rules; their counts are the next two, each shared out */
    size_t diffuse_samples, glossy_samples;
    aur_density_choice density;
    aur_gather_weights weights;
    double regularization; /* of optimal weights; negative until it is known what it defaults to */
    bool clip;             /* glossy lobes end at the surface's horizon */
    size_t levels, level_factor;
    aur_gather_incident incident;
    size_t photons, caustic_photons, bright_samples;
    uint64_t photon_seed; /* 0: that of the picture */
    size_t split;         /* samples that share a pattern; 0: all of a pixel */
    uint32_t light_samples;
    double photons_a_texel;
    bool debias;
    double continued;  /* share of the looks at the map that a path corrects */
    double short_rays; /* widths of a texel; rays that are shorter go on as paths */
    const char *photon_set;
    const char *map, *scramble; /* of the rules; scramble NULL: by the pattern */
    aur_gather_pixel pixel;
} aur_gather_parameters;

/* Whether both patterns' samples serve both lobes. */
static inline bool aur_merges_samples(aur_gather_weights weights) {
    return weights == AUR_WEIGHTS_OSWA || weights == AUR_WEIGHTS_MIS || weights == AUR_WEIGHTS_SOLVE;
}

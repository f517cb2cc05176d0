/* Pictures of a radiosity solution (Keller 1994, section 4): what the integrator and its pixels share. */
#pragma once

#include "transport/integrator.h"
#include "transport/radiosity/picture_gather.h"

typedef enum aur_radiosity_oversampling {
    AUR_RADIOSITY_HALTON,   /* Halton points, as many as asked for */
    AUR_RADIOSITY_ADAPTIVE, /* the same in rounds, until the mean no longer changes */
    AUR_RADIOSITY_SAMPLER   /* the scene's sampler */
} aur_radiosity_oversampling;

typedef enum aur_radiosity_component {
    AUR_RADIOSITY_ALL,
    AUR_RADIOSITY_EMISSION, /* L0 as the eye sees it */
    AUR_RADIOSITY_DIRECT,   /* T L0 */
    AUR_RADIOSITY_INDIRECT  /* T T L */
} aur_radiosity_component;

typedef struct aur_radiosity_image {
    const aur_radiosity *solution; /* owned by the renderer's cache */
    aur_radiosity_gather gather;
    size_t light_count;
    const uint32_t *lights;
    bool permuted; /* each light at one of a pixel's hit points; else all lights at each */
    bool share_neighbours;
    aur_radiosity_oversampling oversampling;
    float threshold; /* of adaptive oversampling */
    aur_radiosity_component component;
    size_t samples_per_pixel;
    uint64_t seed;
} aur_radiosity_image;

/* The `tile` of the integrator. */
aur_result aur_radiosity_tile(const aur_integrator *integrator, aur_tile *tile);

/* Photons: particles from the lights, stored where they hit surfaces that reflect diffusely (Jensen 1996).
 * The map is a function of scene, options and seed; it does not depend on the number of threads. */
#pragma once

#include "render/sampling/stream.h"
#include "render/scene/elements.h"

typedef struct aur_photon {
    aur_vector direction; /* unit, towards where it came from */
    aur_vector power;     /* watts, RGB */
    uint32_t element;
    float coordinates[2]; /* on the element */
    bool behind;          /* it hit the back of the surface */
    bool curved;          /* the element is no triangle */
    bool glossy;          /* the surface has glossy lobes, with or without a diffuse one */
} aur_photon;

typedef struct aur_photon_map {
    size_t count;
    aur_photon *photons;
    uint64_t paths; /* particles that left the lights */
    uint64_t rays;
    uint64_t cut; /* particles whose path was cut because it was too long */
} aur_photon_map;

/* Caustic photons left the light by specular bounces alone, at least one. FOUND: only light that path tracing
 * can find, without specular paths from point and directional lights. */
typedef enum aur_photon_kind {
    AUR_PHOTONS_ALL,
    AUR_PHOTONS_CAUSTIC,
    AUR_PHOTONS_OTHER,
    AUR_PHOTONS_FOUND
} aur_photon_kind;

typedef struct aur_photon_options {
    size_t count; /* photons to store, at least; whole batches of paths are traced until there are enough */
    size_t max_edges; /* edges of a particle's path; SIZE_MAX: limited by Russian roulette only */
    aur_photon_kind kind;
    const aur_sampler *sampler; /* for the particles' random numbers; NULL: Sobol points */
    uint64_t seed;
    size_t threads;
    aur_progress progress;
    aur_warnings warnings; /* of particles whose path was cut */
} aur_photon_options;

/* For CAUSTIC and FOUND the map may be empty. Errors: UNSUPPORTED if the scene has no light or (nearly) no
 * particle hits a surface. */
aur_result aur_photon_map_create(const aur_scene *scene, const aur_elements *elements,
                                 const aur_photon_options *options, aur_photon_map *map, aur_error *error);
/* Warns of particles whose path was cut, out of `paths`, as the function above does. */
void aur_photon_map_warn(uint64_t cut, uint64_t paths, const aur_warnings *warnings);
void aur_photon_map_release(aur_photon_map *map);

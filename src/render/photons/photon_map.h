/* Photons: particles from the lights, stored where they meet surfaces that reflect diffusely (Jensen 1996).
 * The map is a function of scene, options and seed; the number of threads changes nothing. */
#pragma once

#include "render/sampling/stream.h"
#include "render/scene/elements.h"

typedef struct aur_photon {
    aur_vector position;
    aur_vector normal;    /* geometric, on the side that the photon came from */
    aur_vector direction; /* unit, towards where it came from */
    aur_vector power;     /* watts, RGB */
    uint32_t element;
    float coordinates[2]; /* on the element */
    bool behind;          /* it came from the side that the normal of the shape does not show */
    bool glossy;          /* the surface has glossy lobes beside the diffuse one, or only such */
} aur_photon;

typedef struct aur_photon_map {
    size_t count;
    aur_photon *photons;
    uint64_t paths; /* particles that left the lights */
    uint64_t rays;
    uint64_t cut; /* particles whose path was cut because it was too long to follow */
} aur_photon_map;

/* Caustic photons came from the light by specular bounces alone, one at least. Found are those of light that
 * path tracing finds too: without what a point or a single direction sends over mirrors or lenses first. */
typedef enum aur_photon_kind {
    AUR_PHOTONS_ALL,
    AUR_PHOTONS_CAUSTIC,
    AUR_PHOTONS_OTHER,
    AUR_PHOTONS_FOUND
} aur_photon_kind;

typedef struct aur_photon_options {
    size_t count; /* photons to store, at least; whole batches of paths are traced until there are so many */
    size_t max_edges; /* edges of a particle's path; SIZE_MAX: no limit but roulette's */
    aur_photon_kind kind;
    const aur_sampler *sampler; /* of the particles' numbers; NULL: Sobol points */
    uint64_t seed;
    size_t threads;
    aur_progress progress;
    aur_warnings warnings; /* particles whose path was cut */
} aur_photon_options;

/* Caustic photons, and those that are found, may be none: then the map is empty. Errors: UNSUPPORTED when the
 * scene has no light or (nearly) no particle meets a surface. */
aur_result aur_photon_map_create(const aur_scene *scene, const aur_elements *elements,
                                 const aur_photon_options *options, aur_photon_map *map, aur_error *error);
/* Warns of particles whose path was cut, of all that left the lights, as the function above does. */
void aur_photon_map_warn(uint64_t cut, uint64_t paths, const aur_warnings *warnings);
void aur_photon_map_release(aur_photon_map *map);

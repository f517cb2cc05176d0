/* Particles that leave the lights, traced side by side: each stage of a bounce runs for all of them, so that
 * the processor works at several at once. A particle depends on its own number only. */
#pragma once

#include "render/photons/photon_map.h"

typedef struct aur_particle_source {
    const aur_scene *scene;
    const aur_elements *elements;
    const aur_photon_options *options;
    const aur_sampler *sampler;
    uint64_t paths_a_set; /* beyond them the set starts again with another randomisation */
} aur_particle_source;

typedef struct aur_photon_list {
    size_t count, capacity;
    aur_photon *photons;
    uint64_t cut; /* particles */
} aur_photon_list;

enum { AUR_LONGEST_PARTICLE = 512 }; /* edges; longer paths, which need scenes without absorption, are cut */

/* Appends the photons of particles first .. first + count - 1, in their order. Errors: MEMORY. */
aur_result aur_particles_trace(const aur_particle_source *source, uint64_t first, uint64_t count,
                               aur_photon_list *photons);

#include "render/photons/particles.h"

#include <stdlib.h>

#include "points/base/array.h"
#include "points/base/random.h"
#include "render/vertex/vertex.h"

enum { WAVE = 64, LONGEST_PATH = AUR_LONGEST_PARTICLE };

/* Cosines of incidence below this are taken as this, which bounds the power of photons. */
static const float LEAST_COSINE = 0.01f;

enum { PAIR_LIGHT = 0, PAIR_POSITION = 1, PAIR_DIRECTION = 2, PAIR_BOUNCE = 3, PAIRS_A_BOUNCE = 2 };

typedef struct particle {
    aur_ray ray;
    aur_vector power;
    uint32_t number; /* in the wave */
    bool hidden;     /* it left a light that no ray can hit */
    bool specular;   /* by specular bounces alone since then */
} particle;

/* Particles side by side, those that ended left out; and their photons, by bounces. */
typedef struct wave {
    const aur_particle_source *source;
    aur_stream first; /* of the first particle; the others' indices follow */
    size_t count;
    particle particles[WAVE];
    aur_hit hits[WAVE];
    aur_surface surfaces[WAVE];
    aur_shading shadings[WAVE];
    aur_photon_list photons;
    size_t number_capacity;
    uint32_t *numbers; /* the particle of each photon */
} wave;

/* A pair of random numbers for each particle. */
static void draw(const wave *all, uint32_t pair, float *u, float *v) {
    uint32_t indices[WAVE];
    for (size_t i = 0; i < all->count; ++i)
        indices[i] = all->first.index + all->particles[i].number;
    aur_stream_indices(all->first.sampler, all->first.pixel, all->count, indices, pair, u, v);
}

static void emit(wave *all, size_t count) {
    float light[2][WAVE], position[2][WAVE], direction[2][WAVE];
    for (all->count = 0; all->count < count; ++all->count)
        all->particles[all->count].number = (uint32_t)all->count;
    draw(all, PAIR_LIGHT, light[0], light[1]);
    draw(all, PAIR_POSITION, position[0], position[1]);
    draw(all, PAIR_DIRECTION, direction[0], direction[1]);
    all->count = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const float u[5] = {light[0][i], position[0][i], position[1][i], direction[0][i], direction[1][i]};
        particle *const next = &all->particles[all->count];
        next->number = i;
        next->specular = true;
        if (aur_light_emit(all->source->scene, u, &next->ray, &next->power, &next->hidden))
            ++all->count;
    }
}

static void intersect(wave *all) {
    size_t found = 0;
    for (size_t i = 0; i < all->count; ++i) {
        if (!aur_scene_intersect(all->source->scene, &all->particles[i].ray, &all->hits[found]))
            continue;
        if (found != i)
            all->particles[found] = all->particles[i];
        ++found;
    }
    all->count = found;
}

/* The photon of particle i, which `parts` of the material see. */
static void arrive(wave *all, size_t i, unsigned parts) {
    const aur_surface *const surface = &all->surfaces[i];
    const particle *const from = &all->particles[i];
    const aur_vector in = aur_vector_scale(from->ray.direction, -1.0f);
    aur_photon *const photon = &all->photons.photons[all->photons.count];
    if (!aur_vector_is_finite(from->power))
        return;
    *photon = (aur_photon){.direction = in,
                           .power = from->power,
                           .element = aur_element_of(all->source->elements, &all->hits[i]),
                           .behind = aur_vector_dot(surface->geometric_normal, in) < 0.0f,
                           .curved = aur_shape_is_curved(all->source->scene, surface->shape),
                           .glossy = (parts & AUR_SCATTERS_GLOSSY) != 0};
    aur_element_coordinates(all->source->scene, &all->hits[i], surface, photon->coordinates);
    all->numbers[all->photons.count++] = from->number;
}

/* Finds the surfaces, and stores photons. False: no memory. */
static bool land(wave *all, size_t edge) {
    const aur_photon_kind kind = all->source->options->kind;
    const bool is_whole = kind == AUR_PHOTONS_ALL || kind == AUR_PHOTONS_FOUND;
    const size_t needed = all->photons.count + all->count;
    if (!aur_array_reserve(&all->photons.photons, &all->photons.capacity, needed, sizeof(aur_photon)) ||
        !aur_array_reserve(&all->numbers, &all->number_capacity, needed, sizeof *all->numbers))
        return false;
    for (size_t i = 0; i < all->count; ++i) {
        const particle *const from = &all->particles[i];
        aur_surface *const surface = &all->surfaces[i];
        aur_scene_surface(all->source->scene, &from->ray, &all->hits[i], surface);
        all->shadings[i] = aur_shading_at(surface, aur_vector_scale(from->ray.direction, -1.0f));
        /* Gather rays continue by the other lobes, and need no photons. */
        const unsigned parts = aur_bsdf_scatters(surface->bsdf, all->shadings[i].view.z) &
                               (unsigned)(AUR_SCATTERS_DIFFUSE | AUR_SCATTERS_GLOSSY);
        const bool is_caustic = from->specular && edge > 1;
        if (parts != 0 && (is_whole || is_caustic == (kind == AUR_PHOTONS_CAUSTIC)))
            arrive(all, i, parts);
    }
    return true;
}

/* Samples the next ray of a particle; false if its path ends. */
static bool scatter(const wave *all, const aur_shading *shading, const float u[3], float roulette,
                    particle *at) {
    aur_bsdf_sample sample;
    const aur_photon_kind kind = all->source->options->kind;
    const aur_vector in = aur_vector_scale(at->ray.direction, -1.0f);
    if (!aur_shading_sample(shading, u, &sample))
        return false;
    at->specular = at->specular && sample.specular;
    /* Panes do not change the direction: shadow rays pass them. */
    const bool bent = !aur_is_unbent(at->ray.direction, sample.light);
    if (kind == AUR_PHOTONS_FOUND && at->hidden && at->specular && bent)
        return false;
    const aur_surface *const surface = shading->surface;
    const aur_vector weight = aur_vertex_adjoint(shading, &sample, in, surface->frame.z, LEAST_COSINE);
    const aur_vector before = at->power;
    at->power = aur_vector_multiply(before, weight);
    if (!aur_vertex_survives(aur_particle_survival(before, at->power), roulette, &at->power))
        return false;
    at->ray = aur_surface_ray(surface, sample.light);
    return true;
}

static void scatter_all(wave *all, size_t edge) {
    const uint32_t pair = PAIR_BOUNCE + PAIRS_A_BOUNCE * (uint32_t)(edge - 1);
    float lobe[2][WAVE], towards[2][WAVE];
    size_t left = 0;
    draw(all, pair, lobe[0], lobe[1]);
    draw(all, pair + 1, towards[0], towards[1]);
    for (size_t i = 0; i < all->count; ++i) {
        particle at = all->particles[i];
        if (scatter(all, &all->shadings[i], (const float[3]){lobe[0][i], towards[0][i], towards[1][i]},
                    lobe[1][i], &at))
            all->particles[left++] = at;
    }
    all->count = left;
}

/* Those without a specular bounce that a caustic map does not need. */
static void keep_specular(wave *all) {
    size_t left = 0;
    for (size_t i = 0; i < all->count; ++i)
        if (all->particles[i].specular)
            all->particles[left++] = all->particles[i];
    all->count = left;
}

static bool trace_wave(wave *all, size_t count) {
    const aur_photon_options *const options = all->source->options;
    const bool unlimited = options->max_edges > LONGEST_PATH;
    const size_t limit = unlimited ? LONGEST_PATH : options->max_edges;
    emit(all, count);
    for (size_t edge = 1; edge <= limit && all->count > 0; ++edge) {
        intersect(all);
        if (!land(all, edge))
            return false;
        scatter_all(all, edge);
        if (unlimited && edge == limit)
            all->photons.cut += all->count;
        if (options->kind == AUR_PHOTONS_CAUSTIC)
            keep_specular(all);
    }
    return true;
}

/* Appends the photons by particles, and empties the wave. */
static bool append(wave *all, aur_photon_list *photons) {
    size_t next[WAVE + 1] = {0};
    if (!aur_array_reserve(&photons->photons, &photons->capacity, photons->count + all->photons.count,
                           sizeof *photons->photons))
        return false;
    for (size_t i = 0; i < all->photons.count; ++i)
        ++next[all->numbers[i] + 1];
    for (size_t i = 1; i < WAVE; ++i)
        next[i] += next[i - 1];
    for (size_t i = 0; i < all->photons.count; ++i)
        photons->photons[photons->count + next[all->numbers[i]]++] = all->photons.photons[i];
    photons->count += all->photons.count;
    photons->cut += all->photons.cut;
    all->photons.count = 0;
    all->photons.cut = 0;
    return true;
}

aur_result aur_particles_trace(const aur_particle_source *source, uint64_t first, uint64_t count,
                               aur_photon_list *photons) {
    wave all;
    bool enough = true;
    all.source = source;
    all.photons = (aur_photon_list){0};
    all.numbers = NULL;
    all.number_capacity = 0;
    for (const uint64_t end = first + count; first < end && enough;) {
        const uint64_t set = first / source->paths_a_set, index = first % source->paths_a_set;
        const uint64_t of_set = source->paths_a_set - index,
                       left = end - first < of_set ? end - first : of_set;
        const size_t now = left < WAVE ? (size_t)left : WAVE;
        all.first = (aur_stream){source->sampler, aur_hash3(source->options->seed, 0x70686f746f6e, set),
                                 (uint32_t)index};
        enough = trace_wave(&all, now) && append(&all, photons);
        first += now;
    }
    free(all.photons.photons);
    free(all.numbers);
    return enough ? AUR_OK : AUR_ERROR_MEMORY;
}

/* Sixteen numbers, vectors and light samples as structures of arrays: input and output of ray packets
 * (render/trace). */
#pragma once

#include "render/scene/scene.h"

enum { AUR_PACKET_SIZE = 16 };

typedef float aur_lane_numbers[AUR_PACKET_SIZE];

typedef struct aur_lane_vectors {
    aur_lane_numbers x, y, z;
} aur_lane_vectors;

static inline aur_vector aur_lane_vector(const aur_lane_vectors *vectors, size_t lane) {
    return (aur_vector){vectors->x[lane], vectors->y[lane], vectors->z[lane]};
}

static inline void aur_lane_set(aur_lane_vectors *vectors, size_t lane, aur_vector v) {
    vectors->x[lane] = v.x;
    vectors->y[lane] = v.y;
    vectors->z[lane] = v.z;
}

/* Sixteen aur_light_reference. */
typedef struct aur_light_references {
    const aur_lane_vectors *position, *normal;
} aur_light_references;

/* A single one. */
static inline aur_light_reference aur_light_reference_at(const aur_light_references *references,
                                                         size_t lane) {
    return (aur_light_reference){aur_lane_vector(references->position, lane),
                                 aur_lane_vector(references->normal, lane)};
}

/* aur_light_sample_direct of sixteen points. */
typedef struct aur_light_lanes {
    aur_lane_vectors position, radiance;
    aur_lane_vectors direction; /* set by aur_light_lanes_each only */
    aur_lane_numbers pdf;       /* 0: no light */
    aur_lane_numbers reachable; /* 1, or 0 for lights that BSDF sampling cannot hit */
} aur_light_lanes;

/* A single lane; includes its direction if aur_light_lanes_each has sampled it. */
static inline aur_light_sample aur_light_lane(const aur_light_lanes *lights, size_t lane) {
    return (aur_light_sample){.position = aur_lane_vector(&lights->position, lane),
                              .direction = aur_lane_vector(&lights->direction, lane),
                              .radiance = aur_lane_vector(&lights->radiance, lane),
                              .pdf = lights->pdf[lane],
                              .delta = lights->reachable[lane] == 0.0f};
}

static inline void aur_light_lane_set(aur_light_lanes *lights, size_t lane, const aur_light_sample *sample) {
    aur_lane_set(&lights->position, lane, sample->position);
    aur_lane_set(&lights->direction, lane, sample->direction);
    aur_lane_set(&lights->radiance, lane, sample->radiance);
    lights->pdf[lane] = sample->pdf;
    lights->reachable[lane] = sample->delta ? 0.0f : 1.0f;
}

/* For active lanes; results of the others are undefined. `choice` is read only if aur_light_chooses, and may
 * otherwise be NULL. Bit-identical to single samples; environment maps are sampled together. */
void aur_light_lanes_each(const aur_scene *scene, uint32_t lanes, const aur_light_references *references,
                          const float *choice, const float *u, const float *v, aur_light_lanes *lights);
/* The same up to rounding: rectangular lights are sampled by vector code. */
void aur_light_lanes_direct(const aur_scene *scene, uint32_t lanes, const aur_light_references *references,
                            const float *choice, const float *u, const float *v, aur_light_lanes *lights);
/* aur_environment_light for active lanes. */
void aur_environment_lanes(const aur_scene *scene, uint32_t lanes, const aur_lane_vectors *directions,
                           aur_lane_vectors *radiance, float *pdf);

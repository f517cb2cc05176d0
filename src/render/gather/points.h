/* The surface points that sixteen samples of pixels see, where light is gathered. */
#pragma once

#include "points/base/random.h"
#include "render/gather/plan.h"
#include "render/trace/interleave.h"
#include "render/trace/packet_rays.h"
#include "render/vertex/shading.h"

typedef struct aur_gather_point {
    aur_surface surface;
    aur_vector view;   /* local */
    aur_vector origin; /* of rays that leave the surface on the side that it is seen from */
    float side;        /* 1 if seen from the side of the normal, else -1 */
    size_t lobe_count;
    aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
    const aur_gather_lobe_rule *const *rules; /* what gathers each lobe with a formula */
    const void *ggx; /* the method's state for its sampled lobe, if that is GGX; or NULL */
    bool paired;     /* it has only a diffuse and a glossy lobe, and a method gathers both together */
    size_t pair[2];  /* these lobes */
} aur_gather_point;

/* What all sixteen are gathered with; estimators only read it. */
typedef struct aur_gather_points {
    const aur_gather_plan *plan;
    uint32_t lanes;         /* those with a shading point */
    uint32_t bounces;       /* specular ones between the camera and the points */
    aur_embree_order order; /* of packets with one ray from each point */
    /* Whether the lanes are one group's (render/trace/interleave.h) and have one index. */
    bool grouped;
    uint32_t group[AUR_PACKET_SIZE], index[AUR_PACKET_SIZE]; /* of the tile's groups; of a pixel's samples */
    uint16_t place[AUR_PACKET_SIZE];                         /* of the pixels in the tile, row by row */
    uint64_t tile;                                           /* hash of the tile's corner */
    const aur_sampler *sampler;
    uint64_t pixels[AUR_PACKET_SIZE]; /* hashes of the pixels, for their streams of numbers */
    aur_vector throughput[AUR_PACKET_SIZE];
    aur_gather_point at[AUR_PACKET_SIZE];
} aur_gather_points;

/* The reference point for light sampling. */
static inline aur_light_reference aur_gather_point_reference(const aur_gather_point *surface_point) {
    const aur_shading shading = {&surface_point->surface, surface_point->view};
    return aur_shading_reference(&shading);
}

/* Sets up the shading point where a camera ray hits a surface. */
void aur_gather_point_set(const aur_gather_plan *plan, const aur_ray *ray, const aur_hit *hit,
                          aur_gather_point *surface_point);

/* A seed for the randomisation of a tile or pixel, given its hash `of`, distinct for each pattern. */
static inline uint64_t aur_gather_points_hash(const aur_gather_points *surface_points, size_t lane,
                                              uint64_t of) {
    const aur_gather_plan *const plan = surface_points->plan;
    const uint64_t pattern = plan->renews ? surface_points->index[lane] / plan->samples_per_pattern : 0;
    return pattern > 0 ? aur_hash2(of, pattern) : of;
}

/* The part of a pattern that a lane's sample uses. Groups start at different parts: otherwise all pixels with
 * fewer samples than parts would miss the same ones, and their errors would be correlated. */
static inline size_t aur_gather_part(const aur_gather_points *surface_points, size_t lane) {
    const aur_gather_plan *const plan = surface_points->plan;
    const uint64_t hash =
        aur_hash3(plan->seed, aur_gather_points_hash(surface_points, lane, surface_points->tile), 0x70617274);
    const size_t parts = plan->samples_per_pattern;
    const size_t first = (size_t)(hash >> 32) % parts + aur_group_rank(surface_points->group[lane]);
    return (first + surface_points->index[lane] % parts * plan->part_stride) % parts;
}

/* The coherence of packets whose rays leave the points in similar directions. */
aur_embree_order aur_gather_points_order(const aur_gather_points *surface_points);

/* Whether the point has that lobe of its material. */
static inline bool aur_gather_point_has(const aur_gather_point *surface_point, size_t lobe) {
    return !aur_vector_is_zero(surface_point->lobes[lobe].coefficient);
}

/* The density of the directions of a pair of lobes in a local direction. */
static inline float aur_gather_point_pair_density(const aur_gather_plan *plan,
                                                  const aur_gather_point *surface_point, aur_vector local) {
    const size_t *const pair = surface_point->pair;
    const float cosines[2] = {aur_vector_dot(surface_point->lobes[pair[0]].axis, local),
                              aur_vector_dot(surface_point->lobes[pair[1]].axis, local)};
    return plan->rules.method->pair_density(surface_point->rules[pair[1]]->state, cosines);
}

/* A lobe's axis in world coordinates. */
static inline aur_vector aur_gather_point_axis(const aur_gather_point *surface_point, size_t lobe) {
    return aur_frame_to_world(&surface_point->surface.frame, surface_point->lobes[lobe].axis);
}

/* The path tracer from the inside: one path by itself (path_single.c) and sixteen of them in
 * lockstep (path_group.c, with its arithmetic in vertex_lanes*), for the pixels of a tile (path_tile.c). */
#pragma once

#include "points/base/error.h"
#include "render/film/integrator.h"
#include "render/trace/packet_rays.h"
#include "render/vertex/vertex.h"
#include "render/vertex/vertex_lanes.h"
#include "render/vertex/visible_emitters.h"

typedef struct aur_path {
    uint32_t max_depth;  /* UINT32_MAX: no limit; 1 is visible light only, 2 adds direct light */
    uint32_t rr_depth;   /* Russian roulette from this depth on */
    bool hide_emitters;  /* from the camera */
    uint32_t candidates; /* points on lights of which one gets the shadow ray; 0 is 1 */
    bool packets;        /* 16 pixels in lockstep */
    bool interleaved;    /* which share their numbers but for the camera's */
    float clamp;         /* most light after the first surface in a sample; 0: no limit */
    double lamp_rays;    /* rays for lamps alone that a sample has more, in the image's mean */
    const aur_vertex_kernels *kernels;
    aur_shape_class *classes;      /* one a shape */
    const aur_edge_probes *probes; /* NULL: the camera's own rays tell what lamps they meet */
} aur_path;

AUR_INTERNAL aur_result aur_path_prepare(aur_path *data, const aur_scene *scene, aur_error *error);
/* Radiance along one camera ray. `seen`: what of it lights send straight, where that is known; or NULL.
 * *straight becomes what they send. */
aur_vector aur_path_radiance(const aur_path *data, const aur_scene *scene, const aur_camera_sample *sample,
                             const aur_vector *seen, aur_vector *straight, aur_counters *counters);
/* Adds sample `index` of a pixel of the tile by itself. */
void aur_path_add_sample(const aur_path *data, const aur_scene *scene, size_t x, size_t y, uint32_t index,
                         aur_tile *tile);
/* Adds the samples of a tile, sixteen pixels at a time. */
void aur_path_add_tile(const aur_path *data, const aur_scene *scene, aur_tile *tile);

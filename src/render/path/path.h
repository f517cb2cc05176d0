/* Internals of the path tracer: single paths (path_single.c) and sixteen in lockstep (path_group.c, with its
 * arithmetic in vertex_lanes*), for the pixels of a tile (path_tile.c). */
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
    uint32_t candidates; /* light samples of which one gets the shadow ray; 0 means 1 */
    bool packets;        /* 16 pixels in lockstep */
    bool interleaved;    /* which share their numbers but for the camera's */
    float clamp;         /* most light after the first surface in a sample; 0: no limit */
    double probe_rays;   /* additional probe rays per sample, averaged over the image */
    const aur_vertex_kernels *kernels;
    aur_shape_class *classes;      /* one per shape */
    const aur_edge_probes *probes; /* NULL: emission is what the camera rays hit */
} aur_path;

AUR_INTERNAL aur_result aur_path_prepare(aur_path *data, const aur_scene *scene, aur_error *error);
/* Radiance along one camera ray. `emission`: its directly visible emission if already computed; or NULL.
 * *straight becomes that emission. */
aur_vector aur_path_radiance(const aur_path *data, const aur_scene *scene, const aur_camera_sample *sample,
                             const aur_vector *emission, aur_vector *unscattered, aur_counters *counters);
/* Adds sample `index` of a pixel of the tile by itself. */
void aur_path_add_sample(const aur_path *data, const aur_scene *scene, size_t x, size_t y, uint32_t index,
                         aur_tile *tile);
/* Adds the samples of a tile, sixteen pixels at a time. */
void aur_path_add_tile(const aur_path *data, const aur_scene *scene, aur_tile *tile);

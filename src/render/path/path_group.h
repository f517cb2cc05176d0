/* Sixteen light paths in lockstep: at each bounce one packet of rays for the nearest hits and one of shadow
 * rays. Lanes on plain surfaces are shaded together, the others one by one. The caller chooses what the paths
 * belong to: sixteen pixels (path_tile.c), or sixteen randomisations of a sensor. */
#pragma once

#include "points/base/error.h"
#include "render/path/path.h"
#include "render/trace/packet_rays.h"

/* Callback per environment hit: direction, radiance, and whether the path is unscattered. */
typedef void aur_path_sky(void *user, size_t lane, aur_vector direction, aur_vector light, bool unscattered);

/* What irradiance at a sensor needs of its paths besides their sums; all 0 for camera paths. */
typedef struct aur_path_sensor {
    /* Per emitter: >= 0 if unscattered light was already counted analytically; < 0, or NULL here: add the
     * emission that is hit. */
    const float *light_shares;
    /* Called for each environment hit, in addition to the sums, in scenes without other lights; or NULL. */
    aur_path_sky *from_sky;
    void *from_sky_user;
    bool panes; /* shadow rays pass through panes */
    /* Lanes whose path has not been scattered, except by passing panes where these count; set by the caller
     * that starts the paths. */
    uint32_t unscattered;
} aur_path_sensor;

typedef struct aur_path_group {
    aur_vertex_lanes lanes;
    aur_packet packet, shadows;
    const aur_path *data;
    const aur_scene *scene;
    bool has_lights, has_sky, chooses;
    uint32_t candidates; /* at least 1 */
    bool coherent;       /* the next rays are nearly parallel */
    bool stopped;        /* long paths were abandoned on cancellation: the sums are invalid */
    uint32_t alive;      /* one bit per lane, as in all masks */
    uint32_t specular;   /* lanes whose ray could not have been a light sample */
    uint32_t plain;      /* lanes whose surface the kernels support */
    bool background;     /* unscattered lanes see the scene's background: they are camera rays */
    uint32_t preset;     /* lanes whose sums already include the emission that their first rays hit */
    aur_path_sensor sensor;
    aur_stream shared; /* interleaved: of all lanes */
    float ahead[AUR_STREAM_BLOCK][2];
    const aur_sampler *sampler;
    uint32_t index;
    uint64_t pixels[AUR_PACKET_SIZE];
    aur_surface surfaces[AUR_PACKET_SIZE]; /* of lanes that are not plain */
} aur_path_group;

/* What all groups of a scene share; `group` is zero. */
AUR_INTERNAL void aur_path_group_prepare(const aur_path *data, const aur_scene *scene,
                                         const aur_sampler *sampler, aur_path_group *group);

/* One bounce; the first has depth 1. Before the first call, set the rays in `packet`, throughputs and sums of
 * the lanes in `alive`, and their `from` and `pdf` unless they are in `specular`. `pixels` and `index` select
 * the random numbers. Adds the emission that the rays hit, and leaves the lanes that hit a surface in
 * `alive`. */
AUR_INTERNAL void aur_path_group_hit(aur_path_group *group, uint32_t depth);
/* Adds direct light at the surfaces that aur_path_group_hit has found, and samples the next rays. */
AUR_INTERNAL void aur_path_group_scatter(aur_path_group *group, uint32_t depth);
/* The transmittance of panes along the shadow ray of a lane, which ended at `farthest` before the
 * intersection. 0 unless sensor.panes is set and only panes are on the ray, at most as many as a path at
 * bounce `depth` may still hit. */
AUR_INTERNAL aur_vector aur_path_group_passed(const aur_path_group *group, size_t lane, float farthest,
                                              uint32_t depth);
/* Calls both, from bounce `depth` until all paths have ended. */
AUR_INTERNAL void aur_path_group_trace(aur_path_group *group, uint32_t depth);

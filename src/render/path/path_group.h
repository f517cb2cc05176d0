/* Sixteen light paths in lockstep: at each bounce one packet of rays for the nearest hits and one towards the
 * lights. Lanes on plain surfaces are shaded together, the others one by one. Who begins the paths says what
 * they are of: sixteen pixels (path_tile.c), or sixteen randomisations of a sensor. */
#pragma once

#include "points/base/error.h"
#include "render/path/path.h"
#include "render/trace/packet_rays.h"

/* Callback per environment hit: direction, radiance, and whether the path is unscattered. */
typedef void aur_path_sky(void *user, size_t lane, aur_vector direction, aur_vector light, bool unscattered);

/* What irradiance at a sensor has of its paths beside their sums; all 0 for paths of the camera. */
typedef struct aur_path_sensor {
    /* Per emitter: >= 0 if unscattered light was already counted analytically; < 0, or NULL here: add the
     * emission that is hit. */
    const float *known;
    /* Called for each environment hit, in addition to the sums, in scenes without other lights; or NULL. */
    aur_path_sky *from_sky;
    void *from_sky_user;
    bool panes; /* rays to lights go straight through surfaces that let them */
    /* Lanes whose path nothing has scattered, but panes that it went straight through, where these count; who
     * begins the paths sets it. */
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
    bool stopped;        /* long paths were left because the work stops: the sums are of no use */
    uint32_t alive;      /* a bit a lane, as in all masks */
    uint32_t specular;   /* lanes whose ray no light sample could have found */
    uint32_t plain;      /* lanes whose surface the kernels can do */
    bool background;     /* lanes that nothing has scattered see that of the scene: they are the camera's */
    uint32_t told;       /* lanes whose sums have the light already that their first rays meet */
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

/* One bounce, the first has depth 1. To begin, `packet` has the rays of the lanes in `alive`, whose
 * throughputs and sums are set, and their `from` and `pdf` unless they are in `specular`; `pixels` and
 * `index` say which numbers they take. Adds the light that the rays meet, and keeps the lanes that meet a
 * surface. */
AUR_INTERNAL void aur_path_group_meet(aur_path_group *group, uint32_t depth);
/* Adds direct light at the surfaces that aur_path_group_meet has found, and makes the next rays. */
AUR_INTERNAL void aur_path_group_scatter(aur_path_group *group, uint32_t depth);
/* What panes leave of the light along the shadow ray of a lane, which ended at `farthest` before something
 * was found on it: 0 unless sensor.panes is set and all that is there is panes, no more of them than paths
 * that have met `depth` surfaces may meet. */
AUR_INTERNAL aur_vector aur_path_group_passed(const aur_path_group *group, size_t lane, float farthest,
                                              uint32_t depth);
/* Both, from bounce `depth` until all paths have ended. */
AUR_INTERNAL void aur_path_group_trace(aur_path_group *group, uint32_t depth);

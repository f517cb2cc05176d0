/* Lights. Each stands in a file of the folder lights and has one line in lights/table.c. */
#pragma once

#include "render/scene/lanes.h"
#include "render/scene/light_tree.h"
#include "render/scene/materials/texture.h"
#include "render/scene/patches.h"
#include "render/scene/scene.h"

typedef struct aur_emitter aur_emitter;

/* Where a light is seen from, and what draws a point of it: u[0] is what is left after the choice of the
 * light.
 */
typedef struct aur_light_query {
    aur_light_reference reference;
    float u[3];
    uint32_t part; /* the triangle of a mesh that is drawn from, or AUR_WHOLE_LIGHT */
} aur_light_query;

#define AUR_WHOLE_LIGHT UINT32_MAX

typedef struct aur_emitter_descriptor {
    aur_row row;      /* first, so that a row of the table is its descriptor */
    size_t size;      /* of what emitter->data points to: zeroed before `create`, freed in the end */
    bool needs_shape; /* stands inside a <shape> */
    bool is_far;      /* infinitely far: its power grows with the scene's section */
    bool adds;        /* an environment that may stand beside others: radiances add up */
    /* Reads its keys, and sets emitter->extent where that does not depend on the scene. */
    aur_result (*create)(aur_parameters *parameters, aur_emitter *emitter, aur_error *error);
    /* Called when all shapes are there: makes tables, and may set emitter->extent and ->brightness. May be
     * NULL.
     */
    aur_result (*prepare)(aur_emitter *emitter, aur_error *error);
    /* For lights that have a place: what holds a part of it, 0 to emitter->part_count - 1. NULL: it is chosen
     * by its power alone, wherever the reference is. */
    void (*bounds)(const aur_emitter *emitter, size_t part, aur_light_bounds *bounds);
    /* As aur_light_sample_direct for this light alone. */
    bool (*sample)(const aur_emitter *emitter, const aur_light_query *query, aur_light_sample *drawn);
    /* `sample` for the lanes of a packet whose bit is set; false: it is left to `sample`, which those
     * of environments never do. May be NULL. */
    bool (*lanes)(const aur_emitter *emitter, uint32_t lanes, const aur_light_references *references,
                  const float *u, const float *v, aur_light_lanes *drawn);
    /* As aur_light_emit for this light alone. */
    bool (*emit)(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power);
    void (*release)(void *data); /* what emitter->data points to further; NULL: nothing */
    /* For shapes that shine to all sides only: the density, a steradian, with which `sample` draws the point
     * `surface`, which `reference` sees under so large a cosine. */
    float (*pdf_seen)(const aur_emitter *emitter, const aur_light_reference *reference,
                      const aur_surface *surface, float cosine);
    /* For environments only: the radiance from a direction, and the density with which `sample` draws it. */
    aur_vector (*radiance_from)(const aur_emitter *emitter, aur_vector direction);
    float (*pdf_from)(const aur_emitter *emitter, aur_vector direction);
    /* Both at once, where that takes less time; may be NULL. */
    aur_vector (*light_from)(const aur_emitter *emitter, aur_vector direction, float *pdf);
    /* The same from the directions of the lanes whose bit is set; may be NULL. */
    void (*lights_from)(const aur_emitter *emitter, uint32_t lanes, const aur_lane_vectors *directions,
                        aur_lane_vectors *radiance, float *pdf);
    /* For skies: where up and north are. */
    const struct aur_sun_position *(*position_of)(const aur_emitter *emitter);
} aur_emitter_descriptor;

struct aur_emitter {
    const aur_emitter_descriptor *descriptor;
    const aur_scene *scene; /* which it lights; set before `prepare` */
    aur_location location;
    uint32_t index; /* among the emitters of the scene */
    uint32_t shape; /* for lights that are shapes */
    aur_color radiance;
    /* The watts it gives are its brightness times its extent, for far lights times the scene's squared
     * radius. The brightness is the luminance of its mean radiance, unless `prepare` says something else. */
    double extent, brightness;
    double power;           /* luminance of the watts it gives: lights are chosen in proportion */
    double sampling_weight; /* factor of that where points on lights are drawn */
    float probability;      /* that the light is chosen, unless it hangs in the tree of lights */
    size_t part_count;      /* parts that the tree knows one by one: triangles of a mesh, else 1 */
    uint32_t first_leaf;    /* of its parts in the tree; AUR_WHOLE_LIGHT: it is not there */
    bool needs_choice;      /* u[0] matters even where this is the only light */
    void *data;
};

extern const aur_table aur_emitter_table;

/* Diffuse area light, reachable by BSDF sampling. */
static inline bool aur_emitter_glows(const aur_emitter *emitter) {
    return emitter->descriptor->pdf_seen != NULL;
}

/* For lights that are infinitely far: a sample of the unit `direction` towards them, all but radiance and
 * pdf; and a ray from there through a uniform point of the disk that covers the scene. */
void aur_sample_far(const aur_scene *scene, aur_vector reference, aur_vector direction,
                    aur_light_sample *drawn);
aur_ray aur_emit_far(const aur_scene *scene, aur_vector direction, float u, float v);

/* Of environments: the radiance from a direction, and the density with which `sample` draws it. */
static inline aur_vector aur_emitter_light_from(const aur_emitter *emitter, aur_vector direction,
                                                float *pdf) {
    const aur_emitter_descriptor *const descriptor = emitter->descriptor;
    if (descriptor->light_from != NULL)
        return descriptor->light_from(emitter, direction, pdf);
    *pdf = descriptor->pdf_from(emitter, direction);
    return descriptor->radiance_from(emitter, direction);
}

/* For environments that have drawn a direction: the whole sample, and a particle from there. False where the
 * density is 0, or the direction is on the side that light is not asked for on. */
bool aur_sample_environment(const aur_emitter *emitter, const aur_light_query *query, aur_vector direction,
                            aur_light_sample *drawn);
bool aur_emit_environment(const aur_emitter *emitter, aur_vector direction, float u, float v, aur_ray *ray,
                          aur_vector *power);

aur_result aur_emitter_create(aur_parameters *parameters, aur_emitter **emitter, aur_error *error);
void aur_emitter_destroy(aur_emitter *emitter);

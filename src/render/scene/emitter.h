/* Lights. To add one: a file in the folder lights, and one line in lights/table.c. */
#pragma once

#include "render/scene/lanes.h"
#include "render/scene/light_tree.h"
#include "render/scene/materials/texture.h"
#include "render/scene/patches.h"
#include "render/scene/scene.h"

typedef struct aur_emitter aur_emitter;

/* Reference point and random numbers of a light sample; u[0] is the remainder after a light has been
 * selected. */
typedef struct aur_light_query {
    aur_light_reference reference;
    float u[3];
    uint32_t part; /* the triangle of a mesh to sample, or AUR_WHOLE_LIGHT */
} aur_light_query;

#define AUR_WHOLE_LIGHT UINT32_MAX

typedef struct aur_emitter_descriptor {
    aur_row row;      /* first, so that a row of the table is its descriptor */
    size_t size;      /* size of emitter->data: zeroed before `create`, freed in the end */
    bool needs_shape; /* must be inside a <shape> */
    bool is_far;      /* infinitely far: its power is proportional to the scene's cross section */
    bool adds;        /* an environment that may be combined with others: radiances add up */
    /* Reads its parameters, and sets emitter->extent if that does not depend on the scene. */
    aur_result (*create)(aur_parameters *parameters, aur_emitter *emitter, aur_error *error);
    /* Called after all shapes are built: computes tables, and may set emitter->extent and ->brightness. May
     * be NULL. */
    aur_result (*prepare)(aur_emitter *emitter, aur_error *error);
    /* For lights with bounds: the bounds of a part, 0 to emitter->part_count - 1. NULL: the light is selected
     * by its power alone, independently of the reference. */
    void (*bounds)(const aur_emitter *emitter, size_t part, aur_light_bounds *bounds);
    /* As aur_light_sample_direct for this light alone. */
    bool (*sample)(const aur_emitter *emitter, const aur_light_query *query, aur_light_sample *drawn);
    /* `sample` for the active lanes of a packet, all of which chose this light as a whole; others become
     * undefined. False: not supported, call `sample`. Those of environments never return false. May be NULL.
     */
    bool (*lanes)(const aur_emitter *emitter, uint32_t lanes, const aur_light_references *references,
                  const float *u, const float *v, aur_light_lanes *drawn);
    /* `sample` for lanes that chose lights of this kind as a whole, NULL for the others. Returns the lanes
     * sampled, bit-identically to single samples; the others become undefined. May be NULL. */
    uint32_t (*several)(const aur_emitter *const *emitters, const aur_light_references *references,
                        const float *u, const float *v, aur_light_lanes *drawn);
    /* As aur_light_emit for this light alone. */
    bool (*emit)(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power);
    void (*release)(void *data); /* frees what emitter->data points to; NULL: nothing */
    /* For diffuse area lights only: the pdf by solid angle with which `sample` samples the point `surface`,
     * seen from `reference` under this cosine at the light. */
    float (*pdf_seen)(const aur_emitter *emitter, const aur_light_reference *reference,
                      const aur_surface *surface, float cosine);
    /* For environments only: the radiance from a direction, and the pdf with which `sample` samples it. */
    aur_vector (*radiance_from)(const aur_emitter *emitter, aur_vector direction);
    float (*pdf_from)(const aur_emitter *emitter, aur_vector direction);
    /* For `sample` and `emit` by aur_environment_sample and _emit: the unit direction of two random numbers.
     */
    aur_vector (*draw)(const aur_emitter *emitter, float u, float v);
    /* Both at once, if that is faster; may be NULL. */
    aur_vector (*light_from)(const aur_emitter *emitter, aur_vector direction, float *pdf);
    /* The same for the directions of active lanes; may be NULL. */
    void (*lights_from)(const aur_emitter *emitter, uint32_t lanes, const aur_lane_vectors *directions,
                        aur_lane_vectors *radiance, float *pdf);
    /* For skies: the orientation of up and north. */
    const struct aur_sun_position *(*position_of)(const aur_emitter *emitter);
} aur_emitter_descriptor;

struct aur_emitter {
    const aur_emitter_descriptor *descriptor;
    const aur_scene *scene; /* the lit scene; set before `prepare` */
    aur_location location;
    uint32_t index; /* index among the scene's emitters */
    uint32_t shape; /* for lights that are shapes */
    aur_color radiance;
    /* The power in watts is brightness times extent, for infinitely distant lights also times the squared
     * scene radius. By default the brightness is the luminance of the mean radiance; `prepare` may change it.
     */
    double extent, brightness;
    double power;           /* luminance of the power in watts: lights are selected in proportion */
    double sampling_weight; /* factor of the power when lights are selected for sampling */
    float probability;      /* of selecting the light, unless it is in the light tree */
    size_t part_count;      /* parts that are separate in the light tree: triangles of a mesh, else 1 */
    uint32_t first_leaf;    /* leaf index of its first part in the tree; AUR_WHOLE_LIGHT: not in the tree */
    bool needs_choice;      /* u[0] is used even if this is the only light */
    void *data;
};

extern const aur_table aur_emitter_table;

/* Diffuse area light, reachable by BSDF sampling. */
static inline bool aur_emitter_glows(const aur_emitter *emitter) {
    return emitter->descriptor->pdf_seen != NULL;
}

/* For infinitely distant lights: a sample towards the unit `direction`, except radiance and pdf; and a ray
 * from there through a uniform point of the disk that covers the scene. */
void aur_sample_far(const aur_scene *scene, aur_vector reference, aur_vector direction,
                    aur_light_sample *drawn);
aur_ray aur_emit_far(const aur_scene *scene, aur_vector direction, float u, float v);

/* For environments: the radiance from a direction, and the pdf with which `sample` samples it. */
static inline aur_vector aur_emitter_light_from(const aur_emitter *emitter, aur_vector direction,
                                                float *pdf) {
    const aur_emitter_descriptor *const descriptor = emitter->descriptor;
    if (descriptor->light_from != NULL)
        return descriptor->light_from(emitter, direction, pdf);
    *pdf = descriptor->pdf_from(emitter, direction);
    return descriptor->radiance_from(emitter, direction);
}

/* `sample` and `emit` of environments by `draw`. False if the pdf is 0, or if the reference excludes the
 * direction's side. */
bool aur_environment_sample(const aur_emitter *emitter, const aur_light_query *query,
                            aur_light_sample *drawn);
bool aur_environment_emit(const aur_emitter *emitter, const float u[5], aur_ray *ray, aur_vector *power);

aur_result aur_emitter_create(aur_parameters *parameters, aur_emitter **emitter, aur_error *error);
void aur_emitter_destroy(aur_emitter *emitter);

#include "render/scene/lanes.h"

#include "render/scene/scene_data.h"

static void light_lane(const aur_scene *scene, const aur_light_references *references, const float u[3],
                       size_t lane, aur_light_lanes *lights) {
    const aur_light_reference reference = {aur_lane_vector(references->position, lane),
                                           aur_lane_vector(references->normal, lane)};
    aur_light_sample one;
    if (!aur_light_sample_direct(scene, &reference, u, &one))
        one = (aur_light_sample){0};
    aur_lane_set(&lights->position, lane, one.position);
    aur_lane_set(&lights->direction, lane, one.direction);
    aur_lane_set(&lights->radiance, lane, one.radiance);
    lights->pdf[lane] = one.pdf;
    lights->reachable[lane] = one.delta ? 0.0f : 1.0f;
}

/* The lanes whose light is the scene's single environment, which samples them together. */
static uint32_t far_lanes(const aur_scene *scene, uint32_t lanes, const float *choice, const float *u,
                          const float *v) {
    if (scene->environment_count != 1 || scene->environments[0]->descriptor->lanes == NULL ||
        !(scene->choice.emitters.total > 0.0))
        return 0;
    if (!aur_light_chooses(scene))
        return lanes;
    uint32_t far = 0;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        far |= (uint32_t)aur_light_choice_is(scene, scene->environments[0],
                                             (const float[3]){choice[k], u[k], v[k]})
               << k;
    }
    return far;
}

void aur_light_lanes_each(const aur_scene *scene, uint32_t lanes, const aur_light_references *references,
                          const float *choice, const float *u, const float *v, aur_light_lanes *lights) {
    const bool chooses = aur_light_chooses(scene);
    const uint32_t far = far_lanes(scene, lanes, choice, u, v);
    if (far != 0) {
        const aur_emitter *const environment = scene->environments[0];
        environment->descriptor->lanes(environment, far, references, u, v, lights);
    }
    for (uint32_t rest = lanes & ~far; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        light_lane(scene, references, (const float[3]){chooses ? choice[k] : 0.5f, u[k], v[k]}, k, lights);
    }
}

void aur_light_lanes_direct(const aur_scene *scene, uint32_t lanes, const aur_light_references *references,
                            const float *choice, const float *u, const float *v, aur_light_lanes *lights) {
    const aur_emitter *const only =
        scene->emitter_count == 1 && !aur_light_chooses(scene) ? scene->emitters[0] : NULL;
    if (only == NULL || only->descriptor->lanes == NULL ||
        !only->descriptor->lanes(only, lanes, references, u, v, lights))
        aur_light_lanes_each(scene, lanes, references, choice, u, v, lights);
}

void aur_environment_lanes(const aur_scene *scene, uint32_t lanes, const aur_lane_vectors *directions,
                           aur_lane_vectors *radiance, float *pdf) {
    const aur_emitter *const only = scene->environment_count == 1 ? scene->environments[0] : NULL;
    const bool together = only != NULL && only->descriptor->lights_from != NULL;
    if (together)
        only->descriptor->lights_from(only, lanes, directions, radiance, pdf);
    for (; lanes != 0; lanes &= lanes - 1) {
        const size_t k = (size_t)__builtin_ctz(lanes);
        if (together)
            pdf[k] *= only->probability;
        else
            aur_lane_set(radiance, k, aur_environment_light(scene, aur_lane_vector(directions, k), &pdf[k]));
    }
}

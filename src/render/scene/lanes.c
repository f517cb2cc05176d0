#include "render/scene/lanes.h"

#include "render/scene/scene_data.h"

/* All lanes by vector code, for a light that they chose with the same probability; false: not supported. */
static bool sample_together(const aur_emitter *emitter, uint32_t lanes,
                            const aur_light_references *references, const float *u, const float *v,
                            aur_light_lanes *lights) {
    if (emitter->descriptor->lanes == NULL ||
        !emitter->descriptor->lanes(emitter, lanes, references, u, v, lights))
        return false;
    for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
        lights->pdf[k] *= emitter->probability;
    return true;
}

/* The choices of sixteen lanes. */
typedef struct light_choices {
    aur_chosen_light lights[AUR_PACKET_SIZE];
    float rest[AUR_PACKET_SIZE][3];
} light_choices;

static void set_unlit(uint32_t lanes, aur_light_lanes *lights) {
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1)
        aur_light_lane_set(lights, (size_t)__builtin_ctz(rest), &(aur_light_sample){0});
}

/* Samples together what lanes chose of the scene's single environment, if it can; returns them. Results of
 * all other lanes become undefined. */
static uint32_t sample_far(const aur_scene *scene, uint32_t lanes, const aur_light_references *references,
                           const light_choices *choices, const float *u, const float *v,
                           aur_light_lanes *lights) {
    const aur_emitter *const only = scene->environment_count == 1 ? scene->environments[0] : NULL;
    uint32_t far = 0;
    if (only == NULL || only->descriptor->lanes == NULL)
        return 0;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1)
        far |= (uint32_t)(choices->lights[__builtin_ctz(rest)].emitter == only) << __builtin_ctz(rest);
    if (far != 0)
        sample_together(only, far, references, u, v, lights);
    return far;
}

static void sample_one(const aur_scene *scene, size_t lane, const aur_light_references *references,
                       const light_choices *choices, aur_light_lanes *lights) {
    const aur_light_reference reference = aur_light_reference_at(references, lane);
    aur_light_sample one;
    if (!aur_light_sample_chosen(scene, &choices->lights[lane], &reference, choices->rest[lane], &one))
        one = (aur_light_sample){0};
    aur_light_lane_set(lights, lane, &one);
}

/* --- each as a single sample */

/* Samples lights of one kind together, if it can. Returns the lanes sampled. */
static uint32_t sample_kind(uint32_t lanes, const aur_light_references *references,
                            const light_choices *choices, const float *u, const float *v,
                            aur_light_lanes *lights) {
    const aur_emitter *emitters[AUR_PACKET_SIZE] = {NULL};
    const aur_emitter_descriptor *kind = NULL;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        const aur_emitter *const emitter = choices->lights[k].emitter;
        if (emitter->descriptor->several == NULL || (kind != NULL && kind != emitter->descriptor))
            continue;
        kind = emitter->descriptor;
        emitters[k] = emitter;
    }
    aur_light_lanes drawn;
    const uint32_t sampled = kind != NULL ? kind->several(emitters, references, u, v, &drawn) : 0;
    for (uint32_t rest = sampled; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        aur_light_sample one = aur_light_lane(&drawn, k);
        one.pdf *= choices->lights[k].probability;
        aur_light_lane_set(lights, k, &one);
    }
    return sampled;
}

void aur_light_lanes_each(const aur_scene *scene, uint32_t lanes, const aur_light_references *references,
                          const float *choice, const float *u, const float *v, aur_light_lanes *lights) {
    light_choices choices;
    const uint32_t chosen =
        aur_light_choose_lanes(scene, lanes, references, choice, u, v, choices.lights, choices.rest);
    const uint32_t far = sample_far(scene, chosen, references, &choices, u, v, lights);
    const uint32_t together = sample_kind(chosen & ~far, references, &choices, u, v, lights);
    for (uint32_t rest = chosen & ~far & ~together; rest != 0; rest &= rest - 1)
        sample_one(scene, (size_t)__builtin_ctz(rest), references, &choices, lights);
    set_unlit(lanes & ~chosen, lights);
}

/* --- up to rounding */

/* Samples the light that all of `lanes` chose: by vector code if there is any. Also for a single lane, so
 * that a lane's bits do not depend on the others. */
static void sample_light(const aur_scene *scene, uint32_t lanes, const aur_light_references *references,
                         const light_choices *choices, const float *u, const float *v,
                         aur_light_lanes *lights) {
    const aur_emitter *const emitter = choices->lights[__builtin_ctz(lanes)].emitter;
    const bool overlaps = emitter->descriptor->radiance_from != NULL && scene->environment_count > 1;
    aur_light_lanes drawn = {0}; /* directions are not always set */
    const bool together = !overlaps && emitter->descriptor->lanes != NULL &&
                          emitter->descriptor->lanes(emitter, lanes, references, u, v, &drawn);
    for (; lanes != 0; lanes &= lanes - 1) {
        const size_t k = (size_t)__builtin_ctz(lanes);
        if (!together) {
            sample_one(scene, k, references, choices, lights);
            continue;
        }
        aur_light_sample one = aur_light_lane(&drawn, k);
        one.pdf *= choices->lights[k].probability;
        aur_light_lane_set(lights, k, &one);
    }
}

void aur_light_lanes_direct(const aur_scene *scene, uint32_t lanes, const aur_light_references *references,
                            const float *choice, const float *u, const float *v, aur_light_lanes *lights) {
    if (!aur_light_chooses(scene)) {
        if (scene->emitter_count != 1 ||
            !sample_together(scene->emitters[0], lanes, references, u, v, lights))
            aur_light_lanes_each(scene, lanes, references, choice, u, v, lights);
        return;
    }
    light_choices choices;
    uint32_t rest =
        aur_light_choose_lanes(scene, lanes, references, choice, u, v, choices.lights, choices.rest);
    set_unlit(lanes & ~rest, lights);
    while (rest != 0) {
        const aur_emitter *const first = choices.lights[__builtin_ctz(rest)].emitter;
        uint32_t same = 0;
        for (uint32_t others = rest; others != 0; others &= others - 1) {
            const size_t k = (size_t)__builtin_ctz(others);
            same |= (uint32_t)(choices.lights[k].emitter == first) << k;
        }
        sample_light(scene, same, references, &choices, u, v, lights);
        rest &= ~same;
    }
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

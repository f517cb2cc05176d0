/* Selection of the light to sample: environments and beams by power alone, all others by a tree that takes
 * their positions into account. */
#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "render/scene/scene_data.h"

/* Minimum weight of a light: estimators that use only light sampling stay correct. */
static double weight_of(const aur_emitter *emitter) {
    return fmax(emitter->sampling_weight, 1e-3);
}

/* Collects the bounds of all light parts, and `parts`; returns the number of parts with power. */
static size_t find_parts(aur_scene *scene, aur_light_part *parts, aur_light_bounds *bounds) {
    size_t count = 0, lit = 0;
    for (size_t i = 0; i < scene->emitter_count; ++i) {
        const aur_emitter *const emitter = scene->emitters[i];
        if (emitter->descriptor->bounds == NULL || !(emitter->power > 0.0))
            continue;
        for (size_t k = 0; k < emitter->part_count; ++k) {
            emitter->descriptor->bounds(emitter, k, &bounds[count]);
            bounds[count].power *= weight_of(emitter);
            lit += bounds[count].power > 0.0;
            parts[count++] = (aur_light_part){(uint32_t)i, (uint32_t)k};
        }
    }
    return lit;
}

static size_t count_parts(const aur_scene *scene) {
    size_t count = 0;
    for (size_t i = 0; i < scene->emitter_count; ++i)
        if (scene->emitters[i]->descriptor->bounds != NULL && scene->emitters[i]->power > 0.0)
            count += scene->emitters[i]->part_count;
    return count;
}

/* For several lights with bounds. */
static aur_result create_tree(aur_scene *scene, aur_error *error) {
    aur_light_choice *const choice = &scene->choice;
    const size_t count = count_parts(scene);
    if (count < 2 || count >= AUR_LIGHT_LEAF)
        return AUR_OK;
    aur_light_bounds *const bounds = malloc(count * sizeof *bounds);
    choice->parts = malloc(count * sizeof *choice->parts);
    aur_result result = bounds != NULL && choice->parts != NULL ? AUR_OK : aur_fail_memory(error);
    if (result == AUR_OK && find_parts(scene, choice->parts, bounds) > 1)
        result = aur_light_tree_create(&choice->tree, count, bounds, error);
    free(bounds);
    for (size_t i = count; choice->tree.node_count > 0 && i > 0; --i)
        scene->emitters[choice->parts[i - 1].emitter]->first_leaf = (uint32_t)(i - 1);
    return result;
}

aur_result aur_light_choice_create(aur_scene *scene, aur_error *error) {
    aur_light_choice *const choice = &scene->choice;
    const size_t count = scene->emitter_count;
    double *const powers = calloc(count + 1, sizeof *powers);
    for (size_t i = 0; i < count; ++i)
        scene->emitters[i]->first_leaf = AUR_WHOLE_LIGHT;
    aur_result result = powers != NULL ? create_tree(scene, error) : aur_fail_memory(error);
    const size_t items = count + (choice->tree.node_count > 0 ? 1 : 0);
    for (size_t i = 0; result == AUR_OK && i < count; ++i) {
        const aur_emitter *const emitter = scene->emitters[i];
        powers[emitter->first_leaf == AUR_WHOLE_LIGHT ? i : count] += emitter->power * weight_of(emitter);
    }
    if (result == AUR_OK)
        result = aur_distribution_create(&choice->emitters, items, powers, error);
    for (size_t i = 0; i < items && result == AUR_OK && choice->emitters.total > 0.0; ++i)
        *(i < count ? &scene->emitters[i]->probability : &choice->tree_probability) =
            (float)aur_distribution_probability(&choice->emitters, i);
    free(powers);
    return result;
}

void aur_light_choice_release(aur_light_choice *choice) {
    aur_distribution_release(&choice->emitters);
    aur_light_tree_release(&choice->tree);
    free(choice->parts);
    choice->parts = NULL;
}

/* Appends bits, derived from u alone, below the 24 bits of u[0]: a tree may have more lights than 2^24. */
static double with_more_digits(const float u[3]) {
    uint32_t bits[2];
    memcpy(bits, &u[1], sizeof bits);
    return (double)u[0] + 0x1p-24 * aur_unit_double(aur_hash2(bits[0], bits[1]));
}

/* The emitter; the number of emitters stands for the tree. *rest is the remainder of u[0]. */
static size_t choose_emitter(const aur_scene *scene, const float u[3], double *rest) {
    const aur_light_choice *const choice = &scene->choice;
    const bool has_tree = choice->tree.node_count > 0;
    *rest = has_tree ? with_more_digits(u) : (double)u[0];
    return aur_distribution_choose_double(&choice->emitters, rest);
}

bool aur_light_choose(const aur_scene *scene, const aur_light_reference *reference, float u[3],
                      aur_chosen_light *chosen) {
    const aur_light_choice *const choice = &scene->choice;
    double rest;
    if (!(choice->emitters.total > 0.0))
        return false;
    size_t index = choose_emitter(scene, u, &rest);
    *chosen = (aur_chosen_light){.part = AUR_WHOLE_LIGHT};
    if (index == scene->emitter_count) {
        uint32_t leaf;
        if (!aur_light_tree_choose(&choice->tree, reference, &rest, &leaf, &chosen->probability))
            return false;
        index = choice->parts[leaf].emitter;
        chosen->part = choice->parts[leaf].part;
        chosen->probability *= choice->tree_probability;
    } else {
        chosen->probability = scene->emitters[index]->probability;
    }
    chosen->emitter = scene->emitters[index];
    u[0] = aur_smaller((float)rest, 0x1.fffffep-1f);
    return true;
}

float aur_light_choice_probability(const aur_scene *scene, const aur_light_reference *reference,
                                   const aur_surface *surface) {
    const aur_light_choice *const choice = &scene->choice;
    const aur_emitter *const emitter = scene->emitters[surface->emitter];
    if (emitter->first_leaf == AUR_WHOLE_LIGHT)
        return emitter->probability;
    const uint32_t part = emitter->part_count > 1 ? surface->primitive : 0;
    return choice->tree_probability *
           aur_light_tree_probability(&choice->tree, reference, emitter->first_leaf + part);
}

bool aur_light_choice_is(const aur_scene *scene, const aur_emitter *emitter, const float u[3]) {
    double rest;
    return choose_emitter(scene, u, &rest) == emitter->index;
}

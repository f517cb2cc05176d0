/* Selection of the light to sample: environments and beams by their number and power, all others by a tree
 * that takes their positions into account. */
#include <stdlib.h>
#include <string.h>

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

/* Items without power have no part in a choice. */
static void list_lit(aur_light_choice *choice) {
    const double *const sums = choice->emitters.sums;
    size_t lit = 0;
    for (size_t i = 0; i < choice->emitters.count; ++i) {
        if (!(sums[i + 1] > sums[i]))
            continue;
        if (lit < AUR_FEW_LIGHTS) {
            choice->lit[lit] = (uint32_t)i;
            choice->lit_sums[lit + 1] = sums[i + 1];
        }
        ++lit;
    }
    choice->lit_count = lit <= AUR_FEW_LIGHTS ? lit : 0;
}

/* The weights of the items, which are far lights and the tree. A quarter goes by power. The rest is shared
 * evenly by the items with power, because the powers of far lights include what walls keep out: light sources
 * inside a room would be chosen too rarely. Environments get half a share, because BSDF sampling finds them
 * too. `shares` is 0 before. */
static void set_weights(const aur_scene *scene, size_t items, double *weights, double *shares) {
    const size_t count = scene->emitter_count;
    double power = 0.0, sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const aur_emitter *const emitter = scene->emitters[i];
        const size_t item = emitter->first_leaf == AUR_WHOLE_LIGHT ? i : count;
        shares[item] += emitter->power;
        weights[item] += emitter->power * weight_of(emitter);
    }
    for (size_t i = 0; i < items; ++i) {
        const bool environment = i < count && scene->emitters[i]->descriptor->radiance_from != NULL;
        const double weight = shares[i] > 0.0 ? weights[i] / shares[i] : 0.0; /* sampling_weight */
        power += weights[i];
        shares[i] = environment ? 0.5 * weight : weight;
        sum += shares[i];
    }
    for (size_t i = 0; i < items && power > 0.0; ++i)
        weights[i] = 0.25 * weights[i] / power + 0.75 * shares[i] / sum;
}

aur_result aur_light_choice_create(aur_scene *scene, aur_error *error) {
    aur_light_choice *const choice = &scene->choice;
    const size_t count = scene->emitter_count;
    choice->kernels = &AUR_KERNEL_HERE(aur_light_kernels);
    double *const weights = calloc(2 * (count + 1), sizeof *weights);
    for (size_t i = 0; i < count; ++i)
        scene->emitters[i]->first_leaf = AUR_WHOLE_LIGHT;
    aur_result result = weights != NULL ? create_tree(scene, error) : aur_fail_memory(error);
    const size_t items = count + (choice->tree.node_count > 0 ? 1 : 0);
    if (result == AUR_OK)
        set_weights(scene, items, weights, weights + count + 1);
    if (result == AUR_OK)
        result = aur_distribution_create(&choice->emitters, items, weights, error);
    for (size_t i = 0; i < items && result == AUR_OK && choice->emitters.total > 0.0; ++i)
        *(i < count ? &scene->emitters[i]->probability : &choice->tree_probability) =
            (float)aur_distribution_probability(&choice->emitters, i);
    if (result == AUR_OK)
        list_lit(choice);
    free(weights);
    return result;
}

void aur_light_choice_release(aur_light_choice *choice) {
    aur_distribution_release(&choice->emitters);
    aur_light_tree_release(&choice->tree);
    free(choice->parts);
    choice->parts = NULL;
}

bool aur_light_chooses(const aur_scene *scene) {
    return scene->emitter_count > 1 || (scene->emitter_count == 1 && scene->emitters[0]->needs_choice);
}

static double with_more_digits(const float u[3]) {
    uint32_t bits[2];
    memcpy(bits, &u[1], sizeof bits);
    return aur_light_digits(u[0], bits[0], bits[1]);
}

/* The emitter; the number of emitters stands for the tree. *rest is the remainder of u[0]. */
static size_t choose_emitter(const aur_scene *scene, const float u[3], double *rest) {
    const aur_light_choice *const choice = &scene->choice;
    const bool has_tree = choice->tree.node_count > 0;
    *rest = has_tree ? with_more_digits(u) : (double)u[0];
    return aur_distribution_choose_double(&choice->emitters, rest);
}

/* Sets what is known of an item; false: it is the tree. */
static bool choose_item(const aur_scene *scene, size_t index, aur_chosen_light *chosen) {
    *chosen = (aur_chosen_light){.part = AUR_WHOLE_LIGHT};
    if (index == scene->emitter_count)
        return false;
    chosen->emitter = scene->emitters[index];
    chosen->probability = scene->emitters[index]->probability;
    return true;
}

static void choose_leaf(const aur_scene *scene, uint32_t leaf, float probability, aur_chosen_light *chosen) {
    const aur_light_part part = scene->choice.parts[leaf];
    *chosen = (aur_chosen_light){scene->emitters[part.emitter], part.part,
                                 probability * scene->choice.tree_probability};
}

static float single(double rest) {
    return aur_smaller((float)rest, 0x1.fffffep-1f);
}

bool aur_light_choose(const aur_scene *scene, const aur_light_reference *reference, float u[3],
                      aur_chosen_light *chosen) {
    const aur_light_choice *const choice = &scene->choice;
    double rest;
    if (!(choice->emitters.total > 0.0))
        return false;
    if (!choose_item(scene, choose_emitter(scene, u, &rest), chosen)) {
        uint32_t leaf;
        float probability;
        if (!aur_light_tree_choose(&choice->tree, reference, &rest, &leaf, &probability))
            return false;
        choose_leaf(scene, leaf, probability, chosen);
    }
    u[0] = single(rest);
    return true;
}

/* --- by lanes */

enum { FEW_LANES = 4 }; /* fewer choose one by one */

/* A leaf for each lane that chose the tree; returns those that have one. At the root, which all visit, the
 * lanes choose together if they are not few for its children. */
static uint32_t choose_leaves(const aur_scene *scene, uint32_t lanes, const aur_light_references *references,
                              aur_light_draws *draws, aur_chosen_light *chosen) {
    const aur_light_tree *const tree = &scene->choice.tree;
    const aur_light_node *const root = tree->nodes;
    const bool together = lanes != 0 && 2 * (uint32_t)__builtin_popcount(lanes) >= root->count;
    uint32_t found = 0;
    if (together)
        tree->kernels->choose(&tree->children, root->first, root->count, references, draws);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        const aur_light_reference reference = aur_light_reference_at(references, k);
        double product = together ? draws->probability[k] : 1.0;
        const uint32_t target = together ? tree->targets[root->first + (size_t)draws->index[k]] : 0;
        uint32_t leaf;
        if (!(product > 0.0) ||
            !aur_light_tree_descend(tree, &reference, target, &draws->rest[k], &leaf, &product))
            continue;
        choose_leaf(scene, leaf, (float)product, &chosen[k]);
        found |= 1u << k;
    }
    return found;
}

/* For few items. */
static uint32_t choose_together(const aur_scene *scene, uint32_t lanes,
                                const aur_light_references *references, const float *number, const float *u,
                                const float *v, aur_chosen_light *chosen, float numbers[AUR_PACKET_SIZE][3]) {
    const aur_light_choice *const choice = &scene->choice;
    aur_light_draws draws;
    uint32_t found = 0;
    if (choice->tree.node_count > 0)
        choice->kernels->digits(number, u, v, draws.rest);
    else
        for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
            draws.rest[k] = (double)number[k];
    choice->kernels->items(choice->lit_count, choice->lit_sums, &draws);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        found |= (uint32_t)choose_item(scene, choice->lit[(size_t)draws.index[k]], &chosen[k]) << k;
        numbers[k][0] = single(draws.rest[k]);
    }
    const uint32_t leaves = choose_leaves(scene, lanes & ~found, references, &draws, chosen);
    for (uint32_t rest = leaves; rest != 0; rest &= rest - 1)
        numbers[__builtin_ctz(rest)][0] = single(draws.rest[__builtin_ctz(rest)]);
    return found | leaves;
}

uint32_t aur_light_choose_lanes(const aur_scene *scene, uint32_t lanes,
                                const aur_light_references *references, const float *choice, const float *u,
                                const float *v, aur_chosen_light chosen[AUR_PACKET_SIZE],
                                float numbers[AUR_PACKET_SIZE][3]) {
    const bool chooses = aur_light_chooses(scene);
    const bool few = __builtin_popcount(lanes) < FEW_LANES;
    uint32_t found = 0;
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        numbers[k][0] = chooses ? choice[k] : 0.5f;
        numbers[k][1] = u[k];
        numbers[k][2] = v[k];
    }
    if (chooses && !few && scene->choice.emitters.count > 1 && scene->choice.lit_count > 0)
        return choose_together(scene, lanes, references, choice, u, v, chosen, numbers);
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const size_t k = (size_t)__builtin_ctz(rest);
        const aur_light_reference reference = aur_light_reference_at(references, k);
        found |= (uint32_t)aur_light_choose(scene, &reference, numbers[k], &chosen[k]) << k;
    }
    return found;
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

#include "render/gather/rules.h"

#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "render/trace/packet.h"

size_t aur_gather_split_count(size_t target, size_t samples_per_pixel) {
    return (target + samples_per_pixel - 1) / samples_per_pixel * samples_per_pixel;
}

/* Common data of the rules of one kind, diffuse or glossy. */
typedef struct rule_maker {
    const aur_gather_settings *p;
    const aur_integrator_context *context;
    aur_gather_rule_options pattern;
    size_t base;                     /* requested directions */
    size_t pixels;                   /* that split one pattern */
    const aur_gather_method *method; /* the caller's; or NULL */
    bool whole;                      /* see aur_gather_rules */
    char set[256];                   /* chosen by the method in place of the pattern */
} rule_maker;

/* The pattern of all rules, but for its count. */
static aur_result name_pattern(rule_maker *maker, aur_error *error) {
    const aur_gather_settings *const p = maker->p;
    maker->pattern = (aur_gather_rule_options){.set = p->pattern,
                                               .optimal_density = p->density == AUR_GATHER_DENSITY_OPTIMAL,
                                               .smoothness = p->smoothness,
                                               .rotations = p->rotations,
                                               .weighted = p->weights == AUR_WEIGHTS_RATIO,
                                               .seed = aur_hash2(maker->context->seed, p->pattern_seed),
                                               .warnings = maker->context->warnings};
    return aur_gather_rule_options_name(&maker->pattern, "finalgather", p->map, p->scramble, error);
}

static aur_result prepare(rule_maker *maker, size_t base, aur_error *error) {
    maker->base = base;
    maker->pattern.count = maker->pixels * aur_gather_split_count(base, maker->context->samples_per_pixel);
    if (!maker->whole)
        return AUR_OK;
    maker->pattern.set = maker->set;
    return maker->method->choose(maker->p, base, sizeof maker->set, maker->set, &maker->pattern.count, error);
}

static aur_gather_common common_of(const rule_maker *maker) {
    const aur_integrator_context *const context = maker->context;
    return (aur_gather_common){.map = maker->pattern.map,
                               .scramble = maker->pattern.scramble,
                               .seed = maker->pattern.seed,
                               .subsets = context->samples_per_pixel,
                               .threads = context->threads,
                               .use_cache = context->use_cache,
                               .progress = &context->progress};
}

/* A rule, and the state of the caller's method for it; `diffuse` is that of the diffuse rule. */
static aur_result make(const rule_maker *maker, double exponent, void *diffuse, aur_gather_lobe_rule *lobe,
                       aur_error *error) {
    const aur_gather_method *const method = maker->method;
    const aur_result result = aur_gather_rule_create(&maker->pattern, exponent, &lobe->rule, error);
    if (result != AUR_OK)
        return result;
    const aur_gather_rule *const rule = &lobe->rule;
    lobe->directions = maker->whole
                           ? (float)maker->base
                           : (float)(rule->count / (maker->pixels * maker->context->samples_per_pixel));
    if (method == NULL)
        return AUR_OK;
    if (rule->square != NULL)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "finalgather: a caller's method needs prepared rotations, not a pattern that is "
                        "scrambled at every shading point");
    const aur_gather_common common = common_of(maker);
    const aur_gather_directions pattern = {.count = rule->count,
                                           .copies = rule->copies,
                                           .exponent = rule->exponent,
                                           .x = rule->x,
                                           .y = rule->y,
                                           .z = rule->z,
                                           .densities = rule->densities,
                                           .weights = rule->weights};
    return method->prepare(maker->p, &common, maker->base, &pattern, diffuse, &lobe->state, error);
}

/* The rule of an analytic lobe, created on first use. */
static aur_result find_or_create(const rule_maker *maker, const aur_bsdf_lobe *target,
                                 aur_gather_rules *rules, const aur_gather_lobe_rule **found,
                                 aur_error *error) {
    size_t i = target->diffuse ? 0 : 1;
    while (i > 0 && i < rules->count && (float)rules->lobes[i].rule.exponent != target->exponent)
        ++i;
    aur_gather_lobe_rule *const lobe = &rules->lobes[i];
    *found = lobe;
    if (i < rules->count)
        return AUR_OK;
    ++rules->count;
    lobe->clipped = maker->p->clip && !maker->whole;
    if (lobe->clipped)
        aur_gather_horizon_fill(target->exponent, &lobe->horizon);
    return make(maker, target->exponent, rules->lobes[0].state, lobe, error);
}

/* Finds or creates rules for the lobes of all surfaces, including lobes that a texture makes black in places.
 */
static aur_result serve_shapes(const rule_maker *maker, aur_gather_rules *rules, aur_error *error) {
    const aur_scene *const scene = maker->context->scene;
    aur_result result = AUR_OK;
    for (uint32_t i = 0; i < aur_scene_shape_count(scene); ++i) {
        const aur_bsdf *const bsdf = aur_scene_shape_bsdf(scene, i);
        rules->scatters |= bsdf->scatters[0] | bsdf->scatters[1];
        for (size_t k = 0; k < bsdf->lobe_count && result == AUR_OK; ++k)
            if (bsdf->lobes[k].shape == AUR_LOBE_SHAPE_COSINE_POWER)
                result = find_or_create(maker, &bsdf->lobes[k], rules, &rules->of_shape[i][k], error);
    }
    return result;
}

/* Sampled lobes never use the caller's method; their draws carry the weights. */
static aur_result make_sampled(const rule_maker *maker, aur_gather_lobe_rule *sampled, aur_error *error) {
    aur_gather_rule_options options = maker->pattern;
    options.set = maker->p->pattern;
    options.count = aur_gather_split_count(maker->p->glossy_samples, maker->context->samples_per_pixel);
    sampled->directions = (float)(options.count / maker->context->samples_per_pixel);
    return aur_gather_rule_create(&options, 0.0, &sampled->rule, error);
}

/* The roughness of a material's sampled lobe if it is a GGX lobe; else 0. */
static float ggx_alpha_of(const aur_bsdf *bsdf) {
    for (size_t k = 0; k < bsdf->lobe_count; ++k)
        if (bsdf->lobes[k].shape == AUR_LOBE_SHAPE_SAMPLED)
            return bsdf->lobes[k].ggx_alpha;
    return 0.0f;
}

/* The method's states for GGX lobes, which have as many directions as sampled ones. */
static aur_result serve_ggx(const rule_maker *maker, aur_gather_rules *rules, aur_error *error) {
    const aur_scene *const scene = maker->context->scene;
    const aur_gather_common common = common_of(maker);
    aur_result result = AUR_OK;
    for (uint32_t shape = 0; shape < aur_scene_shape_count(scene) && result == AUR_OK; ++shape) {
        const float alpha = ggx_alpha_of(aur_scene_shape_bsdf(scene, shape));
        size_t i = 0;
        while (i < rules->ggx_count && rules->ggx[i].alpha != alpha)
            ++i;
        if (!(alpha > 0.0f && alpha <= 1.0f))
            continue;
        if (i == rules->ggx_count) {
            rules->ggx[rules->ggx_count++].alpha = alpha;
            result = maker->method->prepare_ggx(maker->p, &common, rules->sampled.rule.count, alpha,
                                                &rules->ggx[i].state, error);
        }
        rules->ggx_of_shape[shape] = rules->ggx[i].state;
    }
    return result;
}

aur_result aur_gather_rules_create(const aur_gather_settings *p, const aur_gather_method *method,
                                   const aur_integrator_context *context, aur_gather_rules *rules,
                                   aur_error *error) {
    *rules = (aur_gather_rules){.method = method, .whole = method != NULL && method->gather != NULL};
    const size_t shapes = aur_scene_shape_count(context->scene);
    size_t most = 1;
    for (size_t i = 0; i < shapes; ++i)
        most += aur_scene_shape_bsdf(context->scene, i)->lobe_count;
    rules->lobes = calloc(most, sizeof *rules->lobes);
    rules->of_shape = calloc(shapes + 1, sizeof *rules->of_shape);
    rules->ggx = calloc(shapes + 1, sizeof *rules->ggx);
    rules->ggx_of_shape = calloc(shapes + 1, sizeof *rules->ggx_of_shape);
    if (rules->lobes == NULL || rules->of_shape == NULL || rules->ggx == NULL || rules->ggx_of_shape == NULL)
        return aur_fail_memory(error);
    rule_maker maker = {.method = method,
                        .whole = rules->whole,
                        .p = p,
                        .context = context,
                        .pixels = p->share == AUR_SHARE_BLOCKS ? AUR_PACKET_SIZE : 1};
    rules->count = 1;
    aur_result result = name_pattern(&maker, error);
    maker.pattern.nested = p->share == AUR_SHARE_NEAR;
    if (result == AUR_OK)
        result = prepare(&maker, p->diffuse_samples, error);
    if (result == AUR_OK)
        result = make(&maker, 1.0, NULL, &rules->lobes[0], error);
    maker.pixels = 1;
    maker.pattern.nested = false;
    maker.pattern.warnings = (aur_warnings){0}; /* already given with the diffuse pattern */
    if (result == AUR_OK)
        result = prepare(&maker, p->glossy_samples, error);
    if (result == AUR_OK)
        result = serve_shapes(&maker, rules, error);
    if (result == AUR_OK && (rules->scatters & AUR_SCATTERS_SAMPLED) != 0)
        result = make_sampled(&maker, &rules->sampled, error);
    if (result == AUR_OK && (rules->scatters & AUR_SCATTERS_SAMPLED) != 0 && method != NULL &&
        method->prepare_ggx != NULL)
        result = serve_ggx(&maker, rules, error);
    rules->pairs = rules->count > 1 && method != NULL && method->gather_pairs != NULL;
    return result;
}

static void release(const aur_gather_method *method, aur_gather_lobe_rule *lobe) {
    aur_gather_rule_release(&lobe->rule);
    if (method != NULL)
        method->release(lobe->state);
}

void aur_gather_rules_release(aur_gather_rules *rules) {
    for (size_t i = 0; i < rules->count; ++i)
        release(rules->method, &rules->lobes[i]);
    release(rules->method, &rules->sampled);
    for (size_t i = 0; i < rules->ggx_count; ++i)
        rules->method->release_ggx(rules->ggx[i].state);
    free(rules->ggx);
    free(rules->ggx_of_shape);
    free(rules->lobes);
    free(rules->of_shape);
    *rules = (aur_gather_rules){0};
}

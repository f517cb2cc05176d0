/* Final gathering over a photon map: at every surface seen by the eye one pattern of directions for the
 * diffuse part about the normal and one for each glossy lobe about its axis (Marques 2013, section 5), the
 * radiance at what they meet from precomputed irradiance (Christensen 1999), direct light by shadow rays.
 *
 * The directions of a pattern are shared out among the samples of a pixel: sample s of S takes every S-th. */
#include "transport/gather/parameters.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void release(aur_integrator *integrator) {
    aur_final_gather *const data = integrator->data;
    aur_gather_rule_release(&data->diffuse);
    aur_gather_rule_release(&data->visible);
    aur_bright_texels_release(&data->bright);
    for (size_t i = 0; i < data->glossy_count; ++i)
        aur_gather_rule_release(&data->glossy[i]);
    for (size_t i = 0; i < data->pair_count; ++i)
        aur_gather_pair_destroy(data->pairs[i]);
    free(data->pairs);
    free(data->horizons);
    free(data->glossy);
    aur_gather_levels_release(&data->diffuse_levels);
    for (size_t i = 0; i < data->glossy_count && data->glossy_levels != NULL; ++i)
        aur_gather_levels_release(&data->glossy_levels[i]);
    free(data->glossy_levels);
    free(data->classes);
    free(data);
}

/* --- preparation
 * ----------------------------------------------------------------------------------------------- */

/* A pattern is shared out evenly: as many directions as samples at least, and a multiple of them. */
static size_t shared_count(int64_t wanted, size_t samples_per_pixel) {
    const size_t each = ((size_t)wanted + samples_per_pixel - 1) / samples_per_pixel;
    return each * samples_per_pixel;
}

const aur_gather_rule *aur_final_gather_rule(const aur_final_gather *data, const aur_bsdf_lobe *lobe) {
    if (lobe->diffuse)
        return &data->diffuse;
    for (size_t i = 0; i < data->glossy_count; ++i)
        if ((float)data->glossy[i].exponent == lobe->exponent)
            return &data->glossy[i];
    return NULL;
}

const aur_gather_levels *aur_final_gather_levels(const aur_final_gather *data, const aur_gather_rule *rule) {
    if (!data->adaptive || rule == &data->visible)
        return NULL;
    return rule == &data->diffuse ? &data->diffuse_levels : &data->glossy_levels[rule - data->glossy];
}

float aur_final_gather_share(const aur_final_gather *data, const aur_gather_rule *rule) {
    const aur_gather_levels *const levels = aur_final_gather_levels(data, rule);
    if (levels != NULL)
        return (float)levels->ends[0];
    const size_t blocks = data->shares_irradiance && rule == &data->diffuse ? AUR_PACKET_SIZE : 1;
    return (float)(rule->count / (blocks * data->samples_per_pixel));
}

/* The extensible sets that adaptive gathering takes the place of patterns by. */
static aur_result set_growth(const aur_gather_parameters *p, int64_t base, aur_gather_levels_options *growth,
                             size_t capacity, char *set, size_t *count, aur_error *error) {
    if (p->level_factor == 3)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "finalgather: 'level_factor' is 2 or 4, not 3");
    *growth = (aur_gather_levels_options){.base = (size_t)base,
                                          .factor = (size_t)p->level_factor,
                                          .extensions = (size_t)p->levels,
                                          .smoothness = p->smoothness,
                                          .optimal = p->weights == AUR_WEIGHTS_OSW,
                                          .regularization = p->regularization};
    return aur_gather_levels_set(growth, capacity, set, count, error);
}

static aur_result add_levels(aur_final_gather *data, const aur_gather_levels_options *growth,
                             const aur_gather_rule *rule, aur_gather_levels *levels, aur_error *error) {
    if (rule->count > data->most_directions)
        data->most_directions = rule->count;
    return aur_gather_levels_create(growth, rule, levels, error);
}

/* The rules of adaptive gathering are made from grids in place of the pattern. */
static aur_result prepare_levels(aur_final_gather *data, aur_error *error) {
    data->glossy_levels = calloc(data->glossy_count + 1, sizeof *data->glossy_levels);
    if (data->glossy_levels == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    aur_result result = add_levels(data, &data->diffuse_growth, &data->diffuse, &data->diffuse_levels, error);
    for (size_t i = 0; i < data->glossy_count && result == AUR_OK; ++i)
        result = add_levels(data, &data->glossy_growth, &data->glossy[i], &data->glossy_levels[i], error);
    return result;
}

/* A rule for an exponent that has none yet. */
static aur_result add_glossy_rule(aur_final_gather *data, const aur_gather_options *options,
                                  const aur_bsdf_lobe *lobe, aur_error *error) {
    if (aur_final_gather_rule(data, lobe) != NULL || lobe->shape != AUR_LOBE_SHAPE_COSINE_POWER)
        return AUR_OK;
    const aur_result result =
        aur_gather_rule_create(options, lobe->exponent, &data->glossy[data->glossy_count], error);
    data->glossy_count += result == AUR_OK;
    return result;
}

/* One rule for each exponent among the glossy lobes of the scene's surfaces. `shapes` gets a bit for each
 * shape that any of their lobes has. */
static aur_result prepare_glossy_rules(aur_final_gather *data, const aur_scene *scene, size_t count,
                                       unsigned *shapes, aur_error *error) {
    const size_t surfaces = aur_scene_shape_count(scene);
    aur_gather_options options = data->options;
    options.count = count;
    *shapes = 0;
    data->glossy = calloc(2 * surfaces * AUR_BSDF_LOBE_CAPACITY + 1, sizeof *data->glossy);
    if (data->glossy == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    for (uint32_t i = 0; i < surfaces; ++i) {
        const aur_bsdf *const bsdf = aur_scene_shape_bsdf(scene, i);
        aur_bsdf_lobe lobes[AUR_BSDF_LOBE_CAPACITY];
        for (int side = 1; side >= -1; side -= 2) {
            const aur_vector view = {0.0f, 0.0f, (float)side};
            const size_t found = bsdf->descriptor->lobes(bsdf, (aur_bsdf_point){0}, view, lobes);
            for (size_t k = 0; k < found; ++k) {
                *shapes |= 1u << lobes[k].shape;
                const aur_result result = add_glossy_rule(data, &options, &lobes[k], error);
                if (result != AUR_OK)
                    return result;
            }
        }
    }
    return AUR_OK;
}

/* Optimal weights in the rules, horizons, and what merged samples need. */
static aur_result prepare_weights(aur_final_gather *data, const aur_gather_parameters *p,
                                  const aur_integrator_context *context, aur_error *error) {
    const bool optimal =
        p->weights == AUR_WEIGHTS_OSW || p->weights == AUR_WEIGHTS_OSWA || p->weights == AUR_WEIGHTS_SOLVE;
    data->horizons = p->clip ? calloc(data->glossy_count + 1, sizeof *data->horizons) : NULL;
    data->pairs = calloc(data->glossy_count + 1, sizeof *data->pairs);
    if (data->pairs == NULL || (p->clip && data->horizons == NULL))
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    aur_result result = AUR_OK;
    if (optimal)
        result = aur_gather_rule_optimise(&data->diffuse, p->smoothness, p->regularization, error);
    for (size_t i = 0; i < data->glossy_count && result == AUR_OK; ++i) {
        aur_gather_rule *const rule = &data->glossy[i];
        if (p->clip)
            aur_gather_horizon(rule->exponent, data->horizons[i]);
        if (optimal)
            result = aur_gather_rule_optimise(rule, p->smoothness, p->regularization, error);
        if (result != AUR_OK || !aur_merges_samples(p))
            continue;
        const aur_pair_options options = {.method = p->weights == AUR_WEIGHTS_OSWA  ? AUR_PAIR_OSWA
                                                    : p->weights == AUR_WEIGHTS_MIS ? AUR_PAIR_MIS
                                                                                    : AUR_PAIR_SOLVE,
                                          .set = data->options.set,
                                          .count = {data->diffuse.count, rule->count},
                                          .shares = data->samples_per_pixel,
                                          .exponent = rule->exponent,
                                          .rotations = data->options.rotations,
                                          .map = data->options.map,
                                          .scramble = data->options.scramble,
                                          .optimal_density = data->options.optimal_density,
                                          .clipped = p->clip,
                                          .smoothness = p->smoothness,
                                          .regularization = p->regularization,
                                          .seed = data->pattern_seed,
                                          .threads = context->threads,
                                          .progress = context->progress};
        result = aur_gather_pair_create(&options, &data->pairs[data->pair_count], error);
        data->pair_count += result == AUR_OK;
    }
    return result;
}

static void destroy_map(void *map) {
    aur_irradiance_map_destroy(map);
}

/* A photon map, shared by all renders that ask for the same one. */
static aur_result prepare_map(const aur_gather_parameters *p, const aur_integrator_context *context,
                              const aur_photon_options *photons, const aur_irradiance_map **found,
                              aur_error *error) {
    char key[512];
    snprintf(key, sizeof key,
             "irradiance kind=%d photons=%zu texel=%.17g edges=%zu seed=%" PRIu64 " set=%.300s",
             (int)photons->kind, photons->count, p->photons_a_texel, photons->max_edges, photons->seed,
             photons->set);
    *found = aur_cache_find(context->cache, key);
    if (*found != NULL)
        return AUR_OK;
    const aur_irradiance_options options = {.photons = *photons, .photons_a_texel = p->photons_a_texel};
    aur_irradiance_map *map;
    const aur_result result = aur_irradiance_map_create(context->scene, &options, &map, error);
    if (result != AUR_OK)
        return result;
    if (aur_cache_store(context->cache, key, map, destroy_map) != AUR_OK)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    *found = map;
    return AUR_OK;
}

static aur_result prepare_maps(aur_final_gather *data, const aur_gather_parameters *p,
                               const aur_integrator_context *context, aur_error *error) {
    const bool apart = p->caustic_photons > 0;
    /* What the eye sees at one gather ray's end is two edges on; caustics are seen without a gather ray. */
    const size_t edges = data->max_depth == UINT32_MAX ? SIZE_MAX : data->max_depth - 2;
    aur_photon_options photons = {.count = (size_t)p->photons,
                                  .max_edges = edges,
                                  .kind = apart ? AUR_PHOTONS_OTHER : AUR_PHOTONS_ALL,
                                  .set = p->photon_set,
                                  .seed = context->seed,
                                  .threads = context->threads,
                                  .progress = context->progress,
                                  .warnings = context->warnings};
    aur_result result = prepare_map(p, context, &photons, &data->map, error);
    if (result != AUR_OK || !apart)
        return result;
    photons.count = (size_t)p->caustic_photons;
    photons.kind = AUR_PHOTONS_CAUSTIC;
    result = prepare_map(p, context, &photons, &data->caustics, error);
    if (result == AUR_OK && data->caustics->photons < photons.count)
        aur_warn_at(&context->warnings, (aur_location){0},
                    "finalgather: %zu caustic photons of %zu found: little light comes by specular bounces",
                    data->caustics->photons, photons.count);
    return result;
}

static aur_result prepare_bright(aur_final_gather *data, int64_t samples, aur_error *error) {
    if (samples == 0 || data->map == NULL || data->component != AUR_COMPONENT_ALL)
        return AUR_OK;
    const aur_result result =
        aur_bright_texels_create(data->scene, data->map, data->classes, &data->bright, error);
    if (result == AUR_OK && data->bright.distribution.total > 0.0)
        data->bright_share = shared_count(samples, data->samples_per_pixel) / data->samples_per_pixel;
    return result;
}

/* Chosen by measurement: see docs/rendering.md. */
static double default_threshold(size_t criterion) {
    return criterion == AUR_CRITERION_ENTROPY ? 0.3 : 0.03;
}

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    aur_gather_parameters p;
    aur_result result = aur_final_gather_read(parameters, &p, error);
    aur_gather_options options;
    if (result == AUR_OK)
        result = aur_final_gather_options(&p, context, &options, error);
    if (result != AUR_OK)
        return result;
    aur_final_gather *const data = calloc(1, sizeof *data);
    if (data == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    integrator->data = data;
    integrator->pixel_centre = p.pixel == 1;
    static const char *const extra[] = {"directions"};
    if (p.adaptive) {
        integrator->extra_count = 1;
        integrator->extra_names = extra;
    }
    data->scene = context->scene;
    data->decorrelation = p.decorrelation;
    data->edge_samples = (uint32_t)p.edges;
    data->packets = p.packets;
    data->shares_irradiance = p.share;
    data->adaptive = p.adaptive;
    data->criterion = p.criterion;
    data->component = p.component;
    data->light_share = (uint32_t)p.light_samples;
    data->direct = p.direct;
    data->incident = p.incident;
    data->max_depth = p.max_depth < 0 ? UINT32_MAX : (uint32_t)p.max_depth;
    data->samples_per_pixel = context->samples_per_pixel;
    data->glossy_samples = shared_count(p.glossy_samples, context->samples_per_pixel);
    data->pattern_seed = options.seed;
    data->options = options;
    options.count = shared_count(p.diffuse_samples, context->samples_per_pixel);
    if (p.share && (p.adaptive || p.decorrelation != AUR_DECORRELATION_BLUE || aur_merges_samples(&p)))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "finalgather: share=true splits one pattern among pixels: it goes with "
                        "decorrelation=blue and weights=ratio, equal or osw, and not with adaptive=true");
    if (p.share)
        options.count *= AUR_PACKET_SIZE;
    size_t glossy_count = data->glossy_samples;
    char set[80], glossy_set[80];
    if (p.adaptive) {
        if (p.weights != AUR_WEIGHTS_RATIO && p.weights != AUR_WEIGHTS_EQUAL && p.weights != AUR_WEIGHTS_OSW)
            return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                            "finalgather: adaptive gathering grows each lobe's pattern by itself: weights of "
                            "merged samples (oswa, mis) do not go with it; take osw, ratio or equal");
        if (options.scramble != AUR_SCRAMBLE_ROTATE || strcmp(p.pattern, "spherical-fibonacci") != 0)
            return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                            "finalgather: adaptive gathering takes its patterns from extensible spherical "
                            "Fibonacci grids: leave 'pattern' and 'scramble' out");
        data->threshold = (float)(p.threshold >= 0.0 ? p.threshold : default_threshold(p.criterion));
        result =
            set_growth(&p, p.diffuse_samples, &data->diffuse_growth, sizeof set, set, &options.count, error);
        if (result == AUR_OK)
            result = set_growth(&p, p.glossy_samples, &data->glossy_growth, sizeof glossy_set, glossy_set,
                                &glossy_count, error);
        options.set = set;
        data->options.set = glossy_set;
    }
    if (result == AUR_OK)
        result = aur_gather_rule_create(&options, 1.0, &data->diffuse, error);
    data->options.warnings = (aur_warnings){0};
    unsigned shapes = 0;
    if (result == AUR_OK)
        result = prepare_glossy_rules(data, context->scene, glossy_count, &shapes, error);
    if (result == AUR_OK && (shapes >> AUR_LOBE_SHAPE_SAMPLED & 1u) != 0) {
        options.set = p.pattern;
        options.count = data->glossy_samples;
        options.warnings = (aur_warnings){0};
        result = aur_gather_rule_create(&options, 0.0, &data->visible, error);
    }
    if (result == AUR_OK && p.adaptive)
        result = prepare_levels(data, error);
    if (result == AUR_OK && !p.adaptive)
        result = prepare_weights(data, &p, context, error);
    data->options.set = NULL; /* what it named may be gone */
    /* Where gather rays go on from every surface, there is no use for photons. */
    const bool wants_photons = p.incident == AUR_INCIDENT_PHOTONS && data->max_depth >= 3 &&
                               (shapes >> AUR_LOBE_SHAPE_COSINE_POWER & 1u) != 0;
    if (result == AUR_OK && wants_photons)
        result = prepare_maps(data, &p, context, error);
    if (result == AUR_OK)
        result = aur_shape_classes_create(data->scene, &data->classes, error);
    if (result == AUR_OK)
        result = prepare_bright(data, p.bright_samples, error);
    return result;
}

const aur_integrator_descriptor aur_integrator_final_gather = {
    .description = {.name = "finalgather",
                    .keys =
                        "diffuse_samples=64, glossy_samples=64, pattern=spherical-fibonacci, map=lambert, "
                        "scramble=rotate (nets: digit), rotations=16, density=optimal, smoothness=1.5, "
                        "weights=ratio, regularization=1e-6, clip=true, decorrelation=blue, photons=500000, "
                        "caustic_photons=0, photon_pattern=sobol, photons_per_texel=16, light_samples=1, "
                        "bright_samples=0, edges=32, share=false, "
                        "adaptive=false, levels=2, level_factor=4, criterion=variance, threshold=0.03 "
                        "(entropy: 0.3), "
                        "max_depth=-1, component=all, direct=nee, incident=photons, pixel=filter, "
                        "pattern_seed=0, packets=true",
                    .summary = "final gathering over a photon map, one pattern of directions an image",
                    .source = "Christensen 1999, Marques 2013, Marques 2018, Marques 2019"},
    .create = create,
    .release = release,
    .tile = aur_final_gather_tile,
};

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

/* --- keys */

enum { MOST = 1 << 30 };

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "diffuse_samples", diffuse_samples, 1, MOST, "64",
                        "directions a pixel for the diffuse lobe, shared out among its samples")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "glossy_samples", glossy_samples, 1, MOST, "64",
                        "directions a pixel for each glossy lobe")},
    {AUR_KEY_OF_TEXT(aur_gather_parameters, "pattern", pattern, "spherical-fibonacci",
                     "SET of the directions")},
    {AUR_KEY_OF_TEXT(aur_gather_parameters, "map", map, "lambert",
                     "map of a square set to the hemisphere: lambert, concentric, azimuthal or polar")},
    {AUR_KEY_OF_TEXT(aur_gather_parameters, "scramble", scramble, "rotate (nets: digit)",
                     "how a pattern is randomised: none, digit, owen, shift or rotate"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "rotations", rotations, 0, 65536, "16",
                        "randomisations made beforehand; 0 is one of its own for every pixel")},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "density", density, "optimal (weights=equal: same)",
                       "directions follow the lobe, or its power 2/(s+1)", "same", "optimal"),
     .computed = true},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "weights", weights, "ratio",
                       "how samples are weighed (Marques 2018, 2019)", "ratio", "equal", "osw", "oswa", "mis",
                       "oswa-solve")},
    {AUR_KEY_OF_BOOLEAN(aur_gather_parameters, "clip", clip, "true",
                        "glossy lobes end at the surface's horizon")},
    {AUR_KEY_OF_REAL(aur_gather_parameters, "regularization", regularization, 0.0, 1e6,
                     "1e-6 (oswa-solve: 0.5)", "added to the diagonal of optimal weights' systems"),
     .computed = true},
    {AUR_KEY_OF_REAL(aur_gather_parameters, "smoothness", smoothness, 1.0, 2.0, "1.5",
                     "s of the optimal weights and density"),
     .minimum_open = true, .maximum_open = true},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "photons", photons, 1, MOST, "500000",
                        "photons of the map that gather rays look up")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "caustic_photons", caustic_photons, 0, MOST, "0",
                        "photons of a map of caustics alone; 0 leaves them in the one map")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "light_samples", light_samples, 1, 65536, "1",
                        "points on lights that each sample's shadow rays aim at")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "bright_samples", bright_samples, 0, 65536, "0",
                        "rays a pixel to brightly lit places, drawn as lights are")},
    {AUR_KEY_OF_TEXT(aur_gather_parameters, "photon_pattern", photon_set, "sobol",
                     "SET of the photons' numbers")},
    {AUR_KEY_OF_REAL(aur_gather_parameters, "photons_per_texel", photons_a_texel, 1.0, 1e6, "16",
                     "photons that a texel of irradiance is the mean of")},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "decorrelation", decorrelation, "blue",
                       "how pixels choose among the rotations", "blue", "random", "none")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "edges", edges, 0, 65536, "32",
                        "camera rays more where a pixel sees several things")},
    {AUR_KEY_OF_BOOLEAN(aur_gather_parameters, "packets", packets, "true",
                        "sixteen rays at a time, else one: the same picture to rounding")},
    {AUR_KEY_OF_BOOLEAN(aur_gather_parameters, "share", share, "false",
                        "neighbouring pixels share the diffuse light that they gather")},
    {AUR_KEY_OF_BOOLEAN(aur_gather_parameters, "adaptive", adaptive, "false",
                        "more directions where the light varies (Marques 2019)")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "levels", levels, 1, AUR_GATHER_LEVEL_CAPACITY - 1, "2",
                        "extensions of an adaptive pattern")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "level_factor", level_factor, 2, 4, "4",
                        "directions of a level over those of the one before: 2 or 4")},
    {AUR_KEY_OF_REAL(aur_gather_parameters, "threshold", threshold, 0.0, 1e6, "0.03 (entropy: 0.3)",
                     "contrast above which the next level is gathered"),
     .computed = true},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "criterion", criterion, "variance",
                       "how that contrast is measured", "entropy", "variance")},
    {AUR_KEY_OF_INTEGER(
        aur_gather_parameters, "max_depth", max_depth, -1, 1 << 20, "-1",
        "longest path in edges: 1 is emitted light only, 2 adds direct light; -1 is unlimited")},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "component", component, "all", "the lobes to gather", "all",
                       "diffuse", "glossy")},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "direct", direct, "nee",
                       "direct light by shadow rays, by the gather rays, or not at all", "nee", "gather",
                       "none")},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "incident", incident, "photons",
                       "what gather rays meet shines by its photons, or by what it emits alone", "photons",
                       "emitters")},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "pixel", pixel, "filter",
                       "camera rays over the pixel, or through its centre", "filter", "centre")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "pattern_seed", pattern_seed, 0, INFINITY, "0",
                        "another randomisation of the pattern under the same seed")},
};

/* What the keys mean together: defaults that follow from other keys, and what does not go together. */
static aur_result complete(aur_gather_parameters *p, aur_error *error) {
    if (p->weights == AUR_WEIGHTS_EQUAL && p->density == AUR_GATHER_DENSITY_OPTIMAL)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "finalgather: equal weights are for density=same; for density=optimal take weights=ratio");
    if (aur_merges_samples(p) && p->rotations == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "finalgather: weights of merged samples need prepared rotations, not rotations=0");
    if (p->density == AUR_GATHER_DENSITY_UNSAID)
        p->density = p->weights == AUR_WEIGHTS_EQUAL ? AUR_GATHER_DENSITY_SAME : AUR_GATHER_DENSITY_OPTIMAL;
    if (p->regularization < 0.0) /* as published for the published method */
        p->regularization = p->weights == AUR_WEIGHTS_SOLVE ? 0.5 : AUR_REGULARIZATION_DEFAULT;
    if (p->threshold < 0.0) /* by measurement: see docs/rendering.md */
        p->threshold = p->criterion == AUR_CRITERION_ENTROPY ? 0.3 : 0.03;
    if (p->share && (p->adaptive || p->decorrelation != AUR_DECORRELATION_BLUE || aur_merges_samples(p)))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "finalgather: share=true splits one pattern among pixels: it goes with "
                        "decorrelation=blue and weights=ratio, equal or osw, and not with adaptive=true");
    if (!p->adaptive)
        return AUR_OK;
    if (aur_merges_samples(p))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "finalgather: adaptive gathering grows each lobe's pattern by itself: weights of "
                        "merged samples (oswa, mis) do not go with it; take osw, ratio or equal");
    if ((p->scramble != NULL && strcmp(p->scramble, "rotate") != 0) ||
        strcmp(p->pattern, "spherical-fibonacci") != 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "finalgather: adaptive gathering takes its patterns from extensible spherical "
                        "Fibonacci grids: leave 'pattern' and 'scramble' out");
    if (p->level_factor == 3)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "finalgather: 'level_factor' is 2 or 4, not 3");
    return AUR_OK;
}

/* Digits of nets are scrambled, every other pattern is turned about its axis (Marques 2013, section 6.1). */
static aur_scramble default_scramble(const char *pattern) {
    const aur_set_description *const row = aur_set_find(pattern);
    return row != NULL && row->binary_net ? AUR_SCRAMBLE_DIGIT : AUR_SCRAMBLE_ROTATE;
}

static aur_result read_options(const aur_gather_parameters *p, const aur_integrator_context *context,
                               aur_gather_options *options, aur_error *error) {
    *options = (aur_gather_options){.set = p->pattern,
                                    .scramble = default_scramble(p->pattern),
                                    .optimal_density = p->density == AUR_GATHER_DENSITY_OPTIMAL,
                                    .smoothness = p->smoothness,
                                    .rotations = (size_t)p->rotations,
                                    .seed = aur_hash2(context->seed, p->pattern_seed),
                                    .warnings = context->warnings};
    aur_result result = aur_map_from_name(p->map, &options->map, error);
    if (result == AUR_OK && p->scramble != NULL)
        result = aur_scramble_from_name(p->scramble, &options->scramble, error);
    if (result == AUR_OK && options->scramble == AUR_SCRAMBLE_ROTATE3D)
        result =
            aur_fail(error, AUR_ERROR_UNSUPPORTED,
                     "finalgather: 'rotate3d' would turn the pattern out of its hemisphere; use 'rotate'");
    return result;
}

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

/* --- preparation */

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

/* One rule for each exponent among the glossy lobes of the scene's surfaces: every lobe with a formula has
 * its rule, whatever textures do. `kinds` gets the kinds of all their lobes. */
static aur_result prepare_glossy_rules(aur_final_gather *data, const aur_scene *scene, size_t count,
                                       unsigned *kinds, aur_error *error) {
    const size_t surfaces = aur_scene_shape_count(scene);
    aur_gather_options options = data->options;
    options.count = count;
    *kinds = 0;
    size_t most = 0;
    for (size_t i = 0; i < surfaces; ++i)
        most += aur_scene_shape_bsdf(scene, i)->lobe_count;
    data->glossy = calloc(most + 1, sizeof *data->glossy);
    if (data->glossy == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < surfaces; ++i) {
        const aur_bsdf *const bsdf = aur_scene_shape_bsdf(scene, i);
        *kinds |= bsdf->scatters[0] | bsdf->scatters[1];
        for (size_t k = 0; k < bsdf->lobe_count; ++k) {
            const aur_result result = add_glossy_rule(data, &options, &bsdf->lobes[k], error);
            if (result != AUR_OK)
                return result;
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

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    aur_gather_parameters p = {
        .density = AUR_GATHER_DENSITY_UNSAID, .regularization = -1.0, .threshold = -1.0};
    aur_result result = aur_row_read(&integrator->descriptor->row, parameters, &p, error);
    if (result == AUR_OK)
        result = complete(&p, error);
    aur_gather_options options;
    if (result == AUR_OK)
        result = read_options(&p, context, &options, error);
    if (result != AUR_OK)
        return result;
    aur_final_gather *const data = calloc(1, sizeof *data);
    if (data == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    integrator->data = data;
    integrator->pixel_centre = p.pixel == AUR_PIXEL_CENTRE;
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
    if (p.share)
        options.count *= AUR_PACKET_SIZE;
    size_t glossy_count = data->glossy_samples;
    char set[80], glossy_set[80];
    if (p.adaptive) {
        data->threshold = (float)p.threshold;
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
    unsigned kinds = 0;
    if (result == AUR_OK)
        result = prepare_glossy_rules(data, context->scene, glossy_count, &kinds, error);
    if (result == AUR_OK && (kinds & AUR_SCATTERS_SAMPLED) != 0) {
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
                               (kinds & (AUR_SCATTERS_DIFFUSE | AUR_SCATTERS_GLOSSY)) != 0;
    if (result == AUR_OK && wants_photons)
        result = prepare_maps(data, &p, context, error);
    if (result == AUR_OK)
        result = aur_shape_classes_create(data->scene, &data->classes, error);
    if (result == AUR_OK)
        result = prepare_bright(data, p.bright_samples, error);
    return result;
}

const aur_integrator_descriptor aur_integrator_final_gather = {
    .row = {.name = "finalgather",
            .summary = "final gathering over a photon map, one pattern of directions an image",
            .source = "Christensen 1999, Marques 2013, Marques 2018, Marques 2019",
            AUR_ROW_KEYS(keys)},
    .create = create,
    .release = release,
    .tile = aur_final_gather_tile,
};

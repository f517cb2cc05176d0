#include "transport/gather/parameters.h"

static aur_result read_parameters(aur_parameters *parameters, aur_gather_parameters *p, aur_error *error) {
    static const char *const densities[] = {"same", "optimal"};
    static const char *const weights[] = {"ratio", "equal", "osw", "oswa", "mis", "oswa-solve"};
    static const char *const components[] = {"all", "diffuse", "glossy"};
    static const char *const directs[] = {"nee", "gather", "none"};
    static const char *const incidents[] = {"photons", "emitters"};
    static const char *const pixels[] = {"filter", "centre"};
    static const char *const criteria[] = {"entropy", "variance"};
    static const char *const decorrelations[] = {"blue", "random", "none"};
    *p = (aur_gather_parameters){.diffuse_samples = 64,
                                 .glossy_samples = 64,
                                 .light_samples = 1,
                                 .rotations = 16,
                                 .photons = 500000,
                                 .photons_a_texel = 16.0,
                                 .edges = 32,
                                 .packets = true,
                                 .levels = 2,
                                 .level_factor = 4,
                                 .threshold = -1.0,
                                 .criterion = AUR_CRITERION_VARIANCE,
                                 .max_depth = -1,
                                 .smoothness = 1.5,
                                 .pattern = "spherical-fibonacci",
                                 .map = "lambert",
                                 .photon_set = "sobol",
                                 .density = AUR_DENSITY_UNSAID,
                                 .regularization = -1.0,
                                 .clip = true};
    const int64_t most = 1 << 30;
    aur_result r;
    const bool good =
        (r = aur_parameters_integer(parameters, "diffuse_samples", 1, most, &p->diffuse_samples, error)) ==
            AUR_OK &&
        (r = aur_parameters_integer(parameters, "glossy_samples", 1, most, &p->glossy_samples, error)) ==
            AUR_OK &&
        (r = aur_parameters_string(parameters, "pattern", &p->pattern, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "map", &p->map, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "scramble", &p->scramble, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "rotations", 0, 65536, &p->rotations, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "density", 2, densities, &p->density, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "weights", 6, weights, &p->weights, error)) == AUR_OK &&
        (r = aur_parameters_boolean(parameters, "clip", &p->clip, error)) == AUR_OK &&
        (r = aur_parameters_float(parameters, "regularization", 0.0, 1e6, &p->regularization, error)) ==
            AUR_OK &&
        (r = aur_parameters_float(parameters, "smoothness", 1.0, 2.0, &p->smoothness, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "photons", 1, most, &p->photons, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "caustic_photons", 0, most, &p->caustic_photons, error)) ==
            AUR_OK &&
        (r = aur_parameters_integer(parameters, "light_samples", 1, 65536, &p->light_samples, error)) ==
            AUR_OK &&
        (r = aur_parameters_integer(parameters, "bright_samples", 0, 65536, &p->bright_samples, error)) ==
            AUR_OK &&
        (r = aur_parameters_string(parameters, "photon_pattern", &p->photon_set, error)) == AUR_OK &&
        (r = aur_parameters_float(parameters, "photons_per_texel", 1.0, 1e6, &p->photons_a_texel, error)) ==
            AUR_OK &&
        (r = aur_parameters_choice(parameters, "decorrelation", 3, decorrelations, &p->decorrelation,
                                   error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "edges", 0, 65536, &p->edges, error)) == AUR_OK &&
        (r = aur_parameters_boolean(parameters, "packets", &p->packets, error)) == AUR_OK &&
        (r = aur_parameters_boolean(parameters, "share", &p->share, error)) == AUR_OK &&
        (r = aur_parameters_boolean(parameters, "adaptive", &p->adaptive, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "levels", 1, AUR_GATHER_LEVEL_CAPACITY - 1, &p->levels,
                                    error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "level_factor", 2, 4, &p->level_factor, error)) == AUR_OK &&
        (r = aur_parameters_float(parameters, "threshold", 0.0, 1e6, &p->threshold, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "criterion", 2, criteria, &p->criterion, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "max_depth", -1, 1 << 20, &p->max_depth, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "component", 3, components, &p->component, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "direct", 3, directs, &p->direct, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "incident", 2, incidents, &p->incident, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "pixel", 2, pixels, &p->pixel, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "pattern_seed", 0, INT64_MAX, &p->pattern_seed, error)) ==
            AUR_OK;
    return good ? aur_parameters_finish(parameters, error) : r;
}

/* What the keys about weights mean together. */
static aur_result complete_weights(aur_gather_parameters *p, aur_error *error) {
    if (p->weights == AUR_WEIGHTS_EQUAL && p->density == AUR_DENSITY_OPTIMAL)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "finalgather: equal weights are for density=same; for density=optimal take weights=ratio");
    if (aur_merges_samples(p) && p->rotations == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "finalgather: weights of merged samples need prepared rotations, not rotations=0");
    if (p->density == AUR_DENSITY_UNSAID)
        p->density = p->weights == AUR_WEIGHTS_EQUAL ? AUR_DENSITY_SAME : AUR_DENSITY_OPTIMAL;
    if (p->regularization < 0.0) /* as published for the published method */
        p->regularization = p->weights == AUR_WEIGHTS_SOLVE ? 0.5 : AUR_REGULARIZATION_DEFAULT;
    return AUR_OK;
}

/* Digits of nets are scrambled, every other pattern is turned about its axis (Marques 2013, section 6.1). */
static aur_scramble default_scramble(const char *pattern) {
    const aur_set_description *const row = aur_set_find(pattern);
    return row != NULL && row->binary_net ? AUR_SCRAMBLE_DIGIT : AUR_SCRAMBLE_ROTATE;
}

aur_result aur_final_gather_options(const aur_gather_parameters *p, const aur_integrator_context *context,
                                    aur_gather_options *options, aur_error *error) {
    *options = (aur_gather_options){.set = p->pattern,
                                    .scramble = default_scramble(p->pattern),
                                    .optimal_density = p->density == AUR_DENSITY_OPTIMAL,
                                    .smoothness = p->smoothness,
                                    .rotations = (size_t)p->rotations,
                                    .seed = aur_hash2(context->seed, (uint64_t)p->pattern_seed),
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

aur_result aur_final_gather_read(aur_parameters *parameters, aur_gather_parameters *p, aur_error *error) {
    const aur_result result = read_parameters(parameters, p, error);
    return result == AUR_OK ? complete_weights(p, error) : result;
}

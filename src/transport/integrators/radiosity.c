/* Quasi-Monte Carlo radiosity (Keller 1994): a particle walk makes a mean radiance for every triangle, and
 * the picture gathers it once more at every point that the eye sees, with direct light apart. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "transport/radiosity/picture.h"

typedef struct solution_parameters {
    int64_t paths, bounces, interval, window, randomizations, variant;
    double epsilon, ply_exposure;
    const char *sequence, *scramble, *save, *load, *ply;
    size_t directions, emission;
} solution_parameters;

typedef struct image_parameters {
    int64_t gather_samples;
    double smoothness, threshold;
    const char *pattern, *map, *pattern_scramble;
    size_t weights, density, light_sampling, oversampling, component;
    bool share_neighbours;
} image_parameters;

static const int64_t most = 1 << 30;

/* Whoever renders a scene of unknown origin must not have a file overwritten or read: such names come from
 * the caller's own text, which has no place in a file. */
static aur_result refuse_files_of_scenes(aur_parameters *parameters, aur_error *error) {
    static const char *const names[] = {"save", "load", "ply"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
        const aur_parameter *const found = aur_parameters_find(parameters, names[i]);
        if (found != NULL && found->location.file != NULL)
            return aur_fail_at(error, found->location, AUR_ERROR_UNSUPPORTED,
                               "integrator 'radiosity': a scene must not name the file of '%s'; say "
                               "--integrator radiosity:%s=... instead",
                               names[i], names[i]);
    }
    return AUR_OK;
}

static aur_result read_solution(aur_parameters *parameters, solution_parameters *p, aur_error *error) {
    static const char *const directions[] = {"cosine", "uniform_angle"};
    static const char *const emissions[] = {"power", "area"};
    *p = (solution_parameters){.paths = -1, .bounces = 6, .interval = 1000, .window = 2, .randomizations = 1};
    aur_result r;
    const bool good =
        (r = aur_parameters_integer(parameters, "paths", 1, INT64_C(1) << 40, &p->paths, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "sequence", &p->sequence, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "scramble", &p->scramble, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "directions", 2, directions, &p->directions, error)) ==
            AUR_OK &&
        (r = aur_parameters_choice(parameters, "emission", 2, emissions, &p->emission, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "bounces", 1, AUR_RADIOSITY_MOST_BOUNCES, &p->bounces,
                                    error)) == AUR_OK &&
        (r = aur_parameters_float(parameters, "epsilon", 0.0, 1.0, &p->epsilon, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "interval", 1, most, &p->interval, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "window", 1, most, &p->window, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "randomizations", 1, AUR_RADIOSITY_MOST_RANDOMIZATIONS,
                                    &p->randomizations, error)) == AUR_OK &&
        (r = aur_parameters_integer(parameters, "variant", 0, INT64_MAX, &p->variant, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "save", &p->save, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "load", &p->load, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "ply", &p->ply, error)) == AUR_OK &&
        (r = aur_parameters_float(parameters, "ply_exposure", -64.0, 64.0, &p->ply_exposure, error)) ==
            AUR_OK;
    return good ? AUR_OK : r;
}

static aur_result read_image(aur_parameters *parameters, image_parameters *p, aur_error *error) {
    static const char *const weights[] = {"equal", "osw"};
    static const char *const densities[] = {"same", "optimal"};
    static const char *const lights[] = {"permuted", "all"};
    static const char *const oversamplings[] = {"halton", "adaptive", "sampler"};
    static const char *const components[] = {"all", "emission", "direct", "indirect"};
    *p = (image_parameters){.gather_samples = 16,
                            .smoothness = 1.5,
                            .threshold = 0.01,
                            .pattern = "spherical-fibonacci",
                            .map = "lambert",
                            .pattern_scramble = "none"};
    aur_result r;
    const bool good =
        (r = aur_parameters_integer(parameters, "gather_samples", 1, 1 << 20, &p->gather_samples, error)) ==
            AUR_OK &&
        (r = aur_parameters_string(parameters, "pattern", &p->pattern, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "map", &p->map, error)) == AUR_OK &&
        (r = aur_parameters_string(parameters, "pattern_scramble", &p->pattern_scramble, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "weights", 2, weights, &p->weights, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "density", 2, densities, &p->density, error)) == AUR_OK &&
        (r = aur_parameters_float(parameters, "smoothness", 1.0, 2.0, &p->smoothness, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "light_sampling", 2, lights, &p->light_sampling, error)) ==
            AUR_OK &&
        (r = aur_parameters_boolean(parameters, "share_neighbours", &p->share_neighbours, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "oversampling", 3, oversamplings, &p->oversampling, error)) ==
            AUR_OK &&
        (r = aur_parameters_float(parameters, "threshold", 0.0, 1.0, &p->threshold, error)) == AUR_OK &&
        (r = aur_parameters_choice(parameters, "component", 4, components, &p->component, error)) == AUR_OK;
    return good ? aur_parameters_finish(parameters, error) : r;
}

/* --- the solution */

static aur_result start(const solution_parameters *p, const aur_integrator_context *context,
                        aur_radiosity **radiosity, aur_error *error) {
    aur_radiosity_options options = {.sequence = p->sequence,
                                     .seed = context->seed,
                                     .directions = (aur_radiosity_directions)p->directions,
                                     .emission = (aur_radiosity_emission)p->emission,
                                     .bounces = (size_t)p->bounces,
                                     .randomizations = (size_t)p->randomizations,
                                     .variant = (uint64_t)p->variant,
                                     .threads = context->threads,
                                     .progress = context->progress,
                                     .warnings = context->warnings};
    if (p->load != NULL)
        return aur_radiosity_load(context->scene, p->load, &options, radiosity, error);
    aur_result result = AUR_OK;
    if (p->scramble != NULL)
        result = aur_scramble_from_name(p->scramble, &options.scramble, error);
    return result == AUR_OK ? aur_radiosity_create(context->scene, &options, radiosity, error) : result;
}

static aur_result go_on(const solution_parameters *p, const aur_integrator_context *context,
                        aur_radiosity *radiosity, aur_error *error) {
    enum { USUAL_PATHS = 100000, USUAL_LIMIT = 1 << 28 };
    const bool loaded = p->load != NULL;
    if (p->epsilon == 0.0) {
        if (loaded && p->paths < 0)
            return AUR_OK;
        return aur_radiosity_trace(radiosity, p->paths < 0 ? USUAL_PATHS : (uint64_t)p->paths, error);
    }
    const aur_radiosity_termination rule = {.epsilon = p->epsilon,
                                            .interval = (uint64_t)p->interval,
                                            .window = (uint64_t)p->window,
                                            .limit = p->paths < 0 ? USUAL_LIMIT : (uint64_t)p->paths};
    int converged = 0;
    const aur_result result = aur_radiosity_terminate(radiosity, &rule, &converged, error);
    if (result == AUR_OK && !converged)
        aur_warn_at(&context->warnings, (aur_location){0},
                    "radiosity: after %" PRIu64 " paths the change is still %.3g, not below epsilon %.3g",
                    rule.limit, radiosity->change, p->epsilon);
    return result;
}

static aur_result write_files(const solution_parameters *p, const aur_radiosity *radiosity,
                              aur_error *error) {
    aur_result result = AUR_OK;
    if (p->save != NULL)
        result = aur_radiosity_save(radiosity, p->save, error);
    if (result == AUR_OK && p->ply != NULL)
        result = aur_radiosity_write_ply(radiosity, p->ply, p->ply_exposure, error);
    return result;
}

static void warn_of_tail(const aur_radiosity *radiosity, const aur_warnings *warnings) {
    aur_radiosity_description d;
    aur_radiosity_describe(radiosity, &d);
    if (d.tail > 0.02)
        aur_warn_at(
            warnings, (aur_location){0},
            "radiosity: some %.2g %% of the light is cut off after %zu bounces; more bounces take it in",
            100.0 * d.tail, radiosity->options.bounces);
    if (d.error > 0.0) /* not NaN */
        aur_warn_at(warnings, (aur_location){0},
                    "radiosity: standard error %.3g after %" PRIu64 " paths, in the unit of epsilon", d.error,
                    d.paths);
}

static void destroy_solution(void *radiosity) {
    aur_radiosity_destroy(radiosity);
}

/* The solution, shared by all pictures that ask for the same one. */
static aur_result solve(const solution_parameters *p, const aur_integrator_context *context,
                        aur_radiosity_image *image, aur_error *error) {
    char key[1024];
    const int length =
        snprintf(key, sizeof key,
                 "radiosity %" PRId64 " %s %s %zu %zu %" PRId64 " %a %" PRId64 " %" PRId64 " %" PRId64
                 " %" PRId64 " %s %" PRIu64,
                 p->paths, p->sequence != NULL ? p->sequence : "", p->scramble != NULL ? p->scramble : "",
                 p->directions, p->emission, p->bounces, p->epsilon, p->interval, p->window,
                 p->randomizations, p->variant, p->load != NULL ? p->load : "", context->seed);
    const bool has_key = length > 0 && (size_t)length < sizeof key;
    aur_radiosity *radiosity = has_key ? aur_cache_find(context->cache, key) : NULL;
    aur_result result = AUR_OK;
    if (radiosity == NULL) {
        result = start(p, context, &radiosity, error);
        if (result == AUR_OK)
            result = go_on(p, context, radiosity, error);
        if (result != AUR_OK) {
            aur_radiosity_destroy(radiosity);
            return result;
        }
        if (!has_key)
            snprintf(key, sizeof key, "radiosity at %p", (void *)radiosity);
        if (aur_cache_store(context->cache, key, radiosity, destroy_solution) != AUR_OK)
            return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
        warn_of_tail(radiosity, &context->warnings);
    }
    image->solution = radiosity;
    return write_files(p, radiosity, error);
}

/* --- the picture */

static aur_result prepare_gather(const image_parameters *p, const aur_integrator_context *context,
                                 aur_radiosity_image *image, aur_error *error) {
    aur_rule_options rule = {.set = p->pattern,
                             .points = {.count = (uint64_t)p->gather_samples,
                                        .domain = AUR_DOMAIN_HEMISPHERE,
                                        .lobe = {.kind = AUR_LOBE_COSINE_POWER, .exponent = 1.0},
                                        .optimal_density = p->density == 1,
                                        .smoothness = p->smoothness,
                                        .seed = context->seed,
                                        .warnings = context->warnings},
                             .optimal = p->weights == 1,
                             .weights = aur_weights_options_default()};
    aur_result result = aur_map_from_name(p->map, &rule.points.map, error);
    if (result == AUR_OK)
        result = aur_scramble_from_name(p->pattern_scramble, &rule.points.scramble, error);
    if (result == AUR_OK)
        result = aur_radiosity_gather_create(image->solution, &rule, &image->gather, error);
    return result;
}

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    solution_parameters s;
    image_parameters p;
    aur_result result = refuse_files_of_scenes(parameters, error);
    if (result == AUR_OK)
        result = read_solution(parameters, &s, error);
    if (result == AUR_OK)
        result = read_image(parameters, &p, error);
    if (result != AUR_OK)
        return result;
    aur_radiosity_image *const image = calloc(1, sizeof *image);
    if (image == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    integrator->data = image;
    image->permuted = p.light_sampling == 0;
    image->share_neighbours = p.share_neighbours;
    image->oversampling = (aur_radiosity_oversampling)p.oversampling;
    image->threshold = (float)p.threshold;
    image->component = (aur_radiosity_component)p.component;
    image->samples_per_pixel = context->samples_per_pixel;
    image->seed = context->seed;
    result = solve(&s, context, image, error);
    if (result != AUR_OK)
        return result;
    image->light_count = image->solution->walk.light_count;
    image->lights = image->solution->walk.lights;
    return prepare_gather(&p, context, image, error);
}

static void release(aur_integrator *integrator) {
    aur_radiosity_image *const image = integrator->data;
    aur_radiosity_gather_release(&image->gather);
    free(image);
}

const aur_integrator_descriptor aur_integrator_radiosity = {
    .description =
        {.name = "radiosity",
         .keys = "paths=100000, sequence=sobol, scramble=none, directions=cosine, emission=power, "
                 "bounces=6, epsilon=0, interval=1000, window=2, randomizations=1, variant=0, "
                 "gather_samples=16, pattern=spherical-fibonacci, map=lambert, pattern_scramble=none, "
                 "weights=equal, density=same, smoothness=1.5, light_sampling=permuted, "
                 "share_neighbours=false, oversampling=halton, threshold=0.01, component=all, save, load, "
                 "ply, ply_exposure=0",
         .summary = "particles give every triangle its radiance, which is gathered once",
         .source = "Keller 1994"},
    .create = create,
    .release = release,
    .tile = aur_radiosity_tile,
};

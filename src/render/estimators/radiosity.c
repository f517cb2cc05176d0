/* Quasi-Monte Carlo radiosity (Keller 1994): a particle walk computes a mean radiance for every triangle; the
 * image gathers it once more at every visible point, with separate direct light. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "render/radiosity/image.h"

typedef struct radiosity_data {
    aur_radiosity_image image; /* first: what aur_radiosity_tile reads */
    /* the solution */
    uint64_t paths; /* 0: not given */
    uint64_t bounces, randomizations;
    double epsilon, ply_exposure;
    const char *sequence, *save, *load, *ply; /* NULL: not given */
    enum { WALK_POWER, WALK_PAPER } walk;
    /* the image */
    uint64_t gather_samples;
    const char *pattern;
    enum { LIGHTS_PERMUTED, LIGHTS_ALL } light_sampling;
} radiosity_data;

enum { MOST = 1 << 30 };

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(radiosity_data, "paths", paths, 1, INT64_C(1) << 40, "100000",
                        "number of paths of the walk; with epsilon the maximum (2^28)"),
     .computed = true},
    {AUR_KEY_OF_TEXT(radiosity_data, "sequence", sequence, "sobol", "point set (SET) of the walk"),
     .computed = true},
    {AUR_KEY_OF_CHOICE(radiosity_data, "walk", walk, "power",
                       "paths begin on lights by their power, with directions by the cosine; paper: by area, "
                       "and its eq. 15",
                       "power", "paper")},
    {AUR_KEY_OF_INTEGER(radiosity_data, "bounces", bounces, 1, AUR_RADIOSITY_MOST_BOUNCES, "6",
                        "the paper's M: paths have M + 1 flights")},
    {AUR_KEY_OF_REAL(radiosity_data, "epsilon", epsilon, 0.0, 1.0, "0",
                     "walk on until the solution changes by less; 0 is a fixed number of paths")},
    {AUR_KEY_OF_INTEGER(radiosity_data, "randomizations", randomizations, 1,
                        AUR_RADIOSITY_MOST_RANDOMIZATIONS, "1",
                        "Owen scramblings of the sequence; from 2 on there are standard errors")},
    {AUR_KEY_OF_TEXT(radiosity_data, "save", save, NULL, "file to which the solution is written")},
    {AUR_KEY_OF_TEXT(radiosity_data, "load", load, NULL, "solution file to continue from")},
    {AUR_KEY_OF_TEXT(radiosity_data, "ply", ply, NULL, "file for the scene as coloured triangles")},
    {AUR_KEY_OF_REAL(radiosity_data, "ply_exposure", ply_exposure, -64.0, 64.0, "0",
                     "exposure of the colours of that file, in stops")},
    {AUR_KEY_OF_INTEGER(radiosity_data, "gather_samples", gather_samples, 1, 1 << 20, "16",
                        "directions at every visible point")},
    {AUR_KEY_OF_TEXT(radiosity_data, "pattern", pattern, "spherical-fibonacci",
                     "point set (SET) of these directions")},
    {AUR_KEY_OF_CHOICE(radiosity_data, "light_sampling", light_sampling, "permuted",
                       "each light at one of four points, or all lights at each", "permuted", "all")},
    {AUR_KEY_OF_BOOLEAN(radiosity_data, "share_neighbours", image.share_neighbours, "false",
                        "neighbouring pixels share gathered light")},
    {AUR_KEY_OF_CHOICE(
        radiosity_data, "oversampling", image.oversampling, "halton",
        "samples of a pixel: Halton points, Halton points until the pixel converges, or the sampler's",
        "halton", "adaptive", "sampler")},
    {AUR_KEY_OF_REAL(radiosity_data, "threshold", image.threshold, 0.0, 1.0, "0.01",
                     "change at which adaptive oversampling ends")},
    {AUR_KEY_OF_CHOICE(radiosity_data, "component", image.component, "all", "the part of the light to show",
                       "all", "emission", "direct", "indirect")},
};

/* Keys that have moved to the public interface or to another integrator. */
#define OF_WALK "'walk=paper' has the paper's; aur_radiosity_options has each (aureole-render/radiosity.h)"
#define OF_END "aur_radiosity_terminate has it (aureole-render/radiosity.h)"
#define OF_PATTERN "gather rays have equal weights; 'finalgather-lab' has it"
static const aur_moved_key moved[] = {
    {"scramble",
     "with 'randomizations' above 1 the sequence is Owen-scrambled; aur_radiosity_options has others "
     "(aureole-render/radiosity.h)"},
    {"directions", OF_WALK},
    {"emission", OF_WALK},
    {"interval", OF_END},
    {"window", OF_END},
    {"variant", "aur_radiosity_options has it (aureole-render/radiosity.h)"},
    {"map", OF_PATTERN},
    {"pattern_scramble", "gather rays have equal weights; 'finalgather-lab' has it as 'scramble'"},
    {"weights", OF_PATTERN},
    {"density", OF_PATTERN},
    {"smoothness", OF_PATTERN},
    {NULL, NULL},
};

/* Rendering a scene of unknown origin must not write or read arbitrary files: file names are accepted from
 * the caller's options, not from a scene file. */
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

/* --- the solution */

static aur_result start(const radiosity_data *p, const aur_integrator_context *context,
                        aur_radiosity **radiosity, aur_error *error) {
    aur_radiosity_options options = {
        .size = sizeof options,
        .sequence = p->sequence,
        .seed = context->seed,
        .scramble = p->randomizations > 1 ? AUR_SCRAMBLE_OWEN : AUR_SCRAMBLE_NONE,
        .directions = p->walk == WALK_PAPER ? AUR_RADIOSITY_UNIFORM_ANGLE : AUR_RADIOSITY_COSINE,
        .emission = p->walk == WALK_PAPER ? AUR_RADIOSITY_BY_AREA : AUR_RADIOSITY_BY_POWER,
        .bounces = (size_t)p->bounces,
        .randomizations = (size_t)p->randomizations,
        .threads = context->threads,
        .progress = context->progress,
        .warnings = context->warnings};
    if (p->load != NULL)
        return aur_radiosity_load(context->scene, p->load, &options, radiosity, error);
    return aur_radiosity_create(context->scene, &options, radiosity, error);
}

static aur_result go_on(const radiosity_data *p, const aur_integrator_context *context,
                        aur_radiosity *radiosity, aur_error *error) {
    enum { USUAL_PATHS = 100000, USUAL_LIMIT = 1 << 28 };
    const bool loaded = p->load != NULL;
    if (p->epsilon == 0.0) {
        if (loaded && p->paths == 0)
            return AUR_OK;
        return aur_radiosity_trace(radiosity, p->paths == 0 ? USUAL_PATHS : p->paths, error);
    }
    const aur_radiosity_termination rule = {.size = sizeof rule,
                                            .epsilon = p->epsilon,
                                            .interval = 1000,
                                            .window = 2,
                                            .limit = p->paths == 0 ? USUAL_LIMIT : p->paths};
    bool converged = false;
    const aur_result result = aur_radiosity_terminate(radiosity, &rule, &converged, error);
    if (result == AUR_OK && !converged)
        aur_warn_at(&context->warnings, (aur_location){0},
                    "radiosity: after %" PRIu64 " paths the change is still %.3g, not below epsilon %.3g",
                    rule.limit, radiosity->change, p->epsilon);
    return result;
}

static aur_result write_files(const radiosity_data *p, const aur_radiosity *radiosity, aur_error *error) {
    aur_result result = AUR_OK;
    if (p->save != NULL)
        result = aur_radiosity_save(radiosity, p->save, error);
    if (result == AUR_OK && p->ply != NULL)
        result = aur_radiosity_write_ply(radiosity, p->ply, p->ply_exposure, error);
    return result;
}

static void warn_of_tail(const aur_radiosity *radiosity, const aur_warnings *warnings) {
    aur_radiosity_description d;
    aur_radiosity_summarize(radiosity, &d);
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

/* The solution, shared by all images with the same options. */
static aur_result solve(const radiosity_data *p, const aur_integrator_context *context,
                        aur_radiosity_image *image, aur_error *error) {
    char key[1024];
    const int length =
        snprintf(key, sizeof key, "radiosity %" PRIu64 " %s %d %" PRIu64 " %a %" PRIu64 " %s %" PRIu64,
                 p->paths, p->sequence != NULL ? p->sequence : "", (int)p->walk, p->bounces, p->epsilon,
                 p->randomizations, p->load != NULL ? p->load : "", context->seed);
    const bool has_key = length > 0 && (size_t)length < sizeof key;
    aur_radiosity *radiosity = has_key ? aur_cache_find(context->cache, key) : NULL;
    aur_result result = AUR_OK;
    if (radiosity == NULL) {
        const uint64_t before = aur_rays_traced;
        result = start(p, context, &radiosity, error);
        if (result == AUR_OK)
            result = go_on(p, context, radiosity, error);
        if (result != AUR_OK) {
            aur_radiosity_destroy(radiosity);
            return result;
        }
        if (!has_key)
            snprintf(key, sizeof key, "radiosity at %p", (void *)radiosity);
        if (aur_cache_store(context->cache, key, radiosity, aur_rays_traced - before, destroy_solution) !=
            AUR_OK)
            return aur_fail_memory(error);
        warn_of_tail(radiosity, &context->warnings);
    }
    image->solution = radiosity;
    return write_files(p, radiosity, error);
}

/* --- the image */

static aur_result prepare_gather(const radiosity_data *p, const aur_integrator_context *context,
                                 aur_radiosity_image *image, aur_error *error) {
    const aur_directions_options points = {.size = sizeof points,
                                           .count = p->gather_samples,
                                           .domain = AUR_DOMAIN_HEMISPHERE,
                                           .lobe = {.kind = AUR_LOBE_COSINE_POWER, .exponent = 1.0},
                                           .seed = context->seed,
                                           .warnings = context->warnings};
    const aur_rule_options rule = {.size = sizeof rule, .set = p->pattern, .points = &points};
    return aur_radiosity_image_prepare(&rule, image, error);
}

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    radiosity_data *const data = integrator->data;
    integrator->whole_tiles = true;
    aur_result result = refuse_files_of_scenes(parameters, error);
    if (result != AUR_OK)
        return result;
    data->image.permuted = data->light_sampling == LIGHTS_PERMUTED;
    data->image.samples_per_pixel = context->samples_per_pixel;
    data->image.seed = context->seed;
    result = solve(data, context, &data->image, error);
    return result == AUR_OK ? prepare_gather(data, context, &data->image, error) : result;
}

static void release(aur_integrator *integrator) {
    aur_radiosity_image_release(integrator->data);
}

const aur_integrator_descriptor aur_integrator_radiosity = {
    .row = {.name = "radiosity",
            .summary = "particles compute the radiance of every triangle, which is gathered once",
            .source = "Keller 1994",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(radiosity_data),
    .moved = moved,
    .create = create,
    .release = release,
    .tile = aur_radiosity_tile,
    .own_image = true,
};

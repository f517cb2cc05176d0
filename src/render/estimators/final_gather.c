/* Final gathering over a photon map: at every surface seen by the eye one pattern of directions for the
 * diffuse part about the normal and one for each glossy lobe about its axis (Marques 2013, section 5), the
 * radiance at what they meet from precomputed irradiance (Christensen 1999), direct light by shadow rays.
 *
 * The directions of a pattern are split among the samples of a pixel: sample s of S takes every S-th. */
#include <string.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "render/gather/plan.h"
#include "render/vertex/lamp_edges.h"

/* --- keys */

typedef struct gather_data {
    aur_gather_parameters keys; /* first: what the table below is of */
    aur_gather_plan *plan;
} gather_data;

static const gather_data initial = {
    .keys = {.density = AUR_GATHER_DENSITY_UNSAID, .regularization = -1.0, .policy = {.threshold = -1.0f}}};

enum { MOST = 1 << 30 };

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "diffuse_samples", diffuse_samples, 1, MOST, "64",
                        "directions a pixel for the diffuse lobe, shared out among its samples")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "glossy_samples", glossy_samples, 1, MOST, "64",
                        "directions a pixel for each glossy lobe")},
    {AUR_KEY_OF_TEXT(aur_gather_parameters, "pattern", rule.set, "spherical-fibonacci",
                     "SET of the directions")},
    {AUR_KEY_OF_TEXT(aur_gather_parameters, "map", map, "lambert",
                     "map of a square set to the hemisphere: lambert, concentric or azimuthal")},
    {AUR_KEY_OF_TEXT(aur_gather_parameters, "scramble", scramble, "rotate (nets: digit)",
                     "how a pattern is randomised: none, digit, owen, shift or rotate"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "rotations", rule.rotations, 0, 65536, "16",
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
    {AUR_KEY_OF_REAL(aur_gather_parameters, "smoothness", rule.smoothness, 1.0, 2.0, "1.5",
                     "s of the optimal weights and density"),
     .minimum_open = true, .maximum_open = true},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "photons", photons, 1, MOST, "500000",
                        "photons of the map that gather rays look up")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "photon_seed", photon_seed, 0, INFINITY, "0",
                        "the same photons in pictures of all seeds; 0: by the picture's seed")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "caustic_photons", caustic_photons, 0, MOST, "0",
                        "photons of a map of caustics alone; 0 leaves them in the one map")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "split", split, 0, AUR_SAMPLES_PER_PIXEL_MAX, "0",
                        "samples among which a pattern is shared out, the next ones share another; 0: all of "
                        "a pixel")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "light_samples", light_samples, 1, 65536, "1",
                        "points on lights that each sample's shadow rays aim at")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "bright_samples", bright_samples, 0, 65536, "0",
                        "rays a pixel to brightly lit places, drawn as lights are")},
    {AUR_KEY_OF_TEXT(aur_gather_parameters, "photon_pattern", photon_set, "sobol",
                     "SET of the photons' numbers")},
    {AUR_KEY_OF_REAL(aur_gather_parameters, "photons_per_texel", photons_a_texel, 1.0, 1e6, "16",
                     "photons that a texel of irradiance is the mean of")},
    {AUR_KEY_OF_BOOLEAN(aur_gather_parameters, "debias", debias, "false",
                        "paths take away what the photon map is wrong by")},
    {AUR_KEY_OF_REAL(aur_gather_parameters, "continued", continued, 0.0, 1.0, "0.25",
                     "of debias: the share of gather rays that go on as paths"),
     .minimum_open = true},
    {AUR_KEY_OF_REAL(aur_gather_parameters, "short_rays", short_rays, 0.0, 1e6, "2",
                     "gather rays that are shorter than so many widths of the texel that they meet go on as "
                     "paths")},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "decorrelation", policy.decorrelation, "blue",
                       "how pixels choose among the rotations", "blue", "random", "none")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "edges", policy.edge_samples, 0, 65536, "128",
                        "camera rays more where a pixel sees several things")},
    {AUR_KEY_OF_BOOLEAN(aur_gather_parameters, "packets", policy.packets, "true",
                        "sixteen rays at a time, else one: the same picture to rounding")},
    {AUR_KEY_OF_CHOICE(
        aur_gather_parameters, "share", policy.share, "false",
        "neighbouring pixels share the diffuse light that they gather: of 4 x 4, or the nearest "
        "alone",
        "false", "true", "near")},
    {AUR_KEY_OF_BOOLEAN(aur_gather_parameters, "adaptive", policy.adaptive, "false",
                        "more directions where the light varies (Marques 2019)")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "levels", levels, 1, AUR_GATHER_LEVEL_CAPACITY - 1, "2",
                        "extensions of an adaptive pattern")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "level_factor", level_factor, 2, 4, "4",
                        "directions of a level over those of the one before: 2 or 4")},
    {AUR_KEY_OF_REAL(aur_gather_parameters, "threshold", policy.threshold, 0.0, 1e6, "0.03 (entropy: 0.3)",
                     "contrast above which the next level is gathered"),
     .computed = true},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "criterion", policy.criterion, "variance",
                       "how that contrast is measured", "entropy", "variance")},
    {AUR_KEY_OF_INTEGER(
        aur_gather_parameters, "max_depth", policy.max_depth, -1, 1 << 20, "-1",
        "longest path in edges: 1 is emitted light only, 2 adds direct light; -1 is unlimited")},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "component", policy.component, "all", "the lobes to gather",
                       "all", "diffuse", "glossy")},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "direct", policy.direct, "nee",
                       "direct light by shadow rays, by the gather rays, or not at all", "nee", "gather",
                       "none")},
    {AUR_KEY_OF_CHOICE(
        aur_gather_parameters, "incident", incident, "photons",
        "what gather rays meet shines by its photons, by what it emits alone, or (with debias=true) "
        "by what debias adds alone",
        "photons", "emitters", "correction")},
    {AUR_KEY_OF_CHOICE(aur_gather_parameters, "pixel", pixel, "filter",
                       "camera rays over the pixel, or through its centre", "filter", "centre")},
    {AUR_KEY_OF_INTEGER(aur_gather_parameters, "pattern_seed", rule.seed, 0, INFINITY, "0",
                        "another randomisation of the pattern under the same seed")},
};

/* What the keys mean together: defaults that follow from other keys, and what does not go together. */
static aur_result complete(aur_gather_parameters *p, aur_error *error) {
    if (p->weights == AUR_WEIGHTS_EQUAL && p->density == AUR_GATHER_DENSITY_OPTIMAL)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "finalgather: equal weights are for density=same; for density=optimal take weights=ratio");
    if (aur_merges_samples(p->weights) && p->rule.rotations == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "finalgather: weights of merged samples need prepared rotations, not rotations=0");
    if (p->density == AUR_GATHER_DENSITY_UNSAID)
        p->density = p->weights == AUR_WEIGHTS_EQUAL ? AUR_GATHER_DENSITY_SAME : AUR_GATHER_DENSITY_OPTIMAL;
    if (p->regularization < 0.0) /* as published for the published method */
        p->regularization = p->weights == AUR_WEIGHTS_SOLVE ? 0.5 : AUR_REGULARIZATION_DEFAULT;
    if (p->policy.threshold < 0.0f) /* by measurement: see docs/rendering.md */
        p->policy.threshold = p->policy.criterion == AUR_CRITERION_ENTROPY ? 0.3f : 0.03f;
    if (p->policy.share != AUR_SHARE_NONE &&
        (p->policy.adaptive || p->policy.decorrelation != AUR_DECORRELATION_BLUE ||
         aur_merges_samples(p->weights)))
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "finalgather: share=true and share=near have patterns of several pixels: they go with "
            "decorrelation=blue and weights=ratio, equal or osw, and not with adaptive=true");
    if (p->policy.share == AUR_SHARE_NEAR && (strcmp(p->rule.set, "spherical-fibonacci") != 0 ||
                                              (p->scramble != NULL && strcmp(p->scramble, "rotate") != 0)))
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "finalgather: share=near has spherical Fibonacci sets that complete each other: leave "
            "'pattern' and 'scramble' out");
    if (p->debias && (p->policy.share != AUR_SHARE_NONE || p->policy.adaptive || p->caustic_photons > 0))
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "finalgather: debias=true takes the bias of the photon map away, not that of %s: leave "
            "it out",
            p->policy.share != AUR_SHARE_NONE ? "share"
            : p->policy.adaptive              ? "adaptive=true"
                                              : "caustic_photons");
    if (p->incident == AUR_INCIDENT_CORRECTION && !p->debias)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "finalgather: incident=correction is what debias=true adds: it needs that too");
    if (p->incident == AUR_INCIDENT_CORRECTION)
        p->policy.direct = AUR_DIRECT_NONE;
    if (!p->policy.adaptive)
        return AUR_OK;
    if (aur_merges_samples(p->weights))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "finalgather: adaptive gathering grows each lobe's pattern by itself: weights of "
                        "merged samples (oswa, mis) do not go with it; take osw, ratio or equal");
    if ((p->scramble != NULL && strcmp(p->scramble, "rotate") != 0) ||
        strcmp(p->rule.set, "spherical-fibonacci") != 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "finalgather: adaptive gathering takes its patterns from extensible spherical "
                        "Fibonacci grids: leave 'pattern' and 'scramble' out");
    if (p->level_factor == 3)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "finalgather: 'level_factor' is 2 or 4, not 3");
    return AUR_OK;
}

/* A key that does nothing was meant for something: 'levels' after a comma for the pattern, as a rule. */
static void warn_of_idle_keys(const aur_gather_parameters *p, aur_parameters *parameters,
                              const aur_warnings *warnings) {
    static const char *const of_adaptive[] = {"levels", "level_factor", "criterion", "threshold"};
    for (size_t i = 0; i < sizeof of_adaptive / sizeof of_adaptive[0] && !p->policy.adaptive; ++i) {
        const aur_parameter *const given = aur_parameters_find(parameters, of_adaptive[i]);
        if (given != NULL)
            aur_warn_at(warnings, given->location,
                        "finalgather: '%s' belongs to adaptive=true and does nothing here; keys of a pattern "
                        "stand in parentheses: pattern=(SET:%s=...)",
                        of_adaptive[i], of_adaptive[i]);
    }
}

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    gather_data *const data = integrator->data;
    aur_gather_parameters *const p = &data->keys;
    aur_result result = complete(p, error);
    p->rule.optimal_density = p->density == AUR_GATHER_DENSITY_OPTIMAL;
    p->rule.seed = aur_hash2(context->seed, p->rule.seed);
    p->rule.warnings = context->warnings;
    if (result == AUR_OK)
        result = aur_scene_refuse_media(context->scene, "integrator 'finalgather'", error);
    if (result == AUR_OK)
        result = aur_gather_rule_options_name(&p->rule, "finalgather", p->map, p->scramble, error);
    if (result != AUR_OK)
        return result;
    warn_of_idle_keys(p, parameters, &context->warnings);
    integrator->pixel_centre = p->pixel == AUR_PIXEL_CENTRE;
    integrator->whole_tiles = p->policy.share != AUR_SHARE_NONE;
    integrator->refines_lamp_edges = p->policy.edge_samples > 0;
    integrator->samples_a_pattern = (uint32_t)p->split;
    static const char *const directions[] = {"directions"};
    static const char *const sharing[] = {"sharing.R", "sharing.G", "sharing.B"};
    const bool near = p->policy.share == AUR_SHARE_NEAR;
    integrator->extra_count = p->policy.adaptive ? 1 : near ? 3 : 0;
    integrator->extra_names = near ? sharing : directions;
    return aur_gather_plan_create(p, context, &data->plan, error);
}

/* The rays at edges are those of a step of the render: of at most four patterns, when it goes on in rounds,
 * so that each sample has at least so many for lamps. */
static aur_result look(const aur_view *view, const aur_integrator_context *context,
                       aur_integrator *integrator, aur_error *error) {
    enum { MOST_PATTERNS = 4 };
    gather_data *const data = integrator->data;
    const aur_gather_parameters *const p = &data->keys;
    const size_t looks = p->policy.edge_samples / (MOST_PATTERNS * data->plan->samples_per_pattern);
    if (p->policy.edge_samples == 0 || p->policy.direct == AUR_DIRECT_NONE)
        return AUR_OK;
    const aur_result result =
        aur_lamp_edges_find(view, (uint16_t)(looks > 1 ? looks : 1), context, &data->plan->lamp_edges, error);
    integrator->lamp_looks = data->plan->lamp_edges;
    return result;
}

static void release(aur_integrator *integrator) {
    aur_gather_plan_destroy(((gather_data *)integrator->data)->plan);
}

static aur_result tile(const aur_integrator *integrator, aur_tile *tile) {
    return aur_gather_tile(((const gather_data *)integrator->data)->plan, tile);
}

const aur_integrator_descriptor aur_integrator_final_gather = {
    .row = {.name = "finalgather",
            .summary = "final gathering over a photon map, one pattern of directions an image",
            .source = "Christensen 1999, Marques 2013, Marques 2018, Marques 2019",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(gather_data),
    .initial = &initial,
    .create = create,
    .look = look,
    .release = release,
    .tile = tile,
    .shows_lamps = true,
};

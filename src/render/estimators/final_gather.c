/* Final gathering over a photon map: at every visible surface one pattern of directions for the diffuse part
 * about the normal and one for each glossy lobe about its axis (Marques 2013, section 5). The radiance where
 * they hit comes from precomputed irradiance (Christensen 1999), direct light from shadow rays.
 *
 * The directions of a pattern are split among the samples of a pixel: sample s of S takes every S-th. */
#include "render/gather/plan.h"
#include "render/vertex/visible_emitters.h"

/* --- keys */

/* integrator->data are these options; a caller's integrator may append more. */
static const aur_gather_settings initial = AUR_GATHER_SETTINGS_INITIAL;

enum { MOST = 1 << 30, UNKNOWN_SPLIT = 8 };

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(aur_gather_settings, "diffuse_samples", diffuse_samples, 1, MOST, "64",
                        "directions per pixel for the diffuse lobe, split among its samples")},
    {AUR_KEY_OF_INTEGER(aur_gather_settings, "glossy_samples", glossy_samples, 1, MOST, "64",
                        "directions per pixel for each glossy lobe")},
    {AUR_KEY_OF_TEXT(aur_gather_settings, "pattern", pattern, "spherical-fibonacci",
                     "point set (SET) of the directions")},
    {AUR_KEY_OF_INTEGER(aur_gather_settings, "split", split, 0, AUR_SAMPLES_PER_PIXEL_MAX, "0",
                        "number of samples that split one pattern; 0: all of a pixel")},
    {AUR_KEY_OF_CHOICE(
        aur_gather_settings, "share", share, "false",
        "neighbouring pixels share gathered diffuse light: in blocks of 4 x 4, or the nearest pixels",
        "false", "true", "near")},
    {AUR_KEY_OF_INTEGER(aur_gather_settings, "photons", photons, 1, MOST, "500000",
                        "number of photons in the map that gather rays query")},
    {AUR_KEY_OF_INTEGER(aur_gather_settings, "photon_seed", photon_seed, 0, INFINITY, "0",
                        "the same photons in images of all seeds; 0: by the image's seed")},
    {AUR_KEY_OF_INTEGER(aur_gather_settings, "caustic_photons", caustic_photons, 0, MOST, "0",
                        "photons of a separate caustic map; 0: caustics are in the photon map")},
    {AUR_KEY_OF_REAL(aur_gather_settings, "photons_per_texel", photons_per_texel, 1.0, 1e6, "16",
                     "photons per texel of irradiance")},
    {AUR_KEY_OF_CHOICE(aur_gather_settings, "debias", debias, "false",
                       "paths correct the bias of the photon map; only: the image is the correction; found: "
                       "without light that paths cannot find, from points or suns over mirrors",
                       "false", "true", "only", "found")},
    {AUR_KEY_OF_REAL(aur_gather_settings, "continued", continued, 0.0, 1.0, "0.25",
                     "of debias: share of gather rays that continue as paths"),
     .minimum_open = true},
    {AUR_KEY_OF_REAL(
        aur_gather_settings, "short_rays", short_rays, 0.0, 1e6, "2",
        "gather rays shorter than this number of widths of the texel that they hit continue as paths")},
    {AUR_KEY_OF_INTEGER(aur_gather_settings, "light_samples", light_samples, 1, 65536, "1",
                        "points on lights per sample")},
    {AUR_KEY_OF_INTEGER(aur_gather_settings, "bright_samples", bright_samples, 0, 65536, "0",
                        "rays per pixel to brightly lit surfaces, sampled like lights")},
    {AUR_KEY_OF_CHOICE(aur_gather_settings, "direct", direct, "nee",
                       "direct light by shadow rays, by the gather rays, or not at all", "nee", "gather",
                       "none")},
    {AUR_KEY_OF_INTEGER(aur_gather_settings, "max_depth", max_depth, -1, 1 << 20, "-1",
                        "longest path in edges: 1 is emitted light only, 2 adds direct light; -1 is "
                        "unlimited; behind mirrors "
                        "and glass, light from photons may come by longer ones")},
    {AUR_KEY_OF_INTEGER(aur_gather_settings, "edges", edge_samples, 0, 65536, "128",
                        "extra camera rays at edges of objects")},
    {AUR_KEY_OF_CHOICE(aur_gather_settings, "pixel", pixel, "filter",
                       "camera rays over the pixel, or through its centre", "filter", "centre")},
};

/* Keys that reproduce papers. */
#define OF_LAB "it is a key of 'finalgather-lab', an integrator of the lab ('aureole help lab-integrator')"
static const aur_moved_key moved[] = {
    {"map", OF_LAB},
    {"scramble", OF_LAB},
    {"rotations", OF_LAB},
    {"density", OF_LAB},
    {"weights", OF_LAB},
    {"clip", OF_LAB},
    {"regularization", OF_LAB},
    {"smoothness", OF_LAB},
    {"photon_pattern", OF_LAB},
    {"decorrelation", OF_LAB},
    {"packets", OF_LAB},
    {"adaptive", OF_LAB},
    {"levels", OF_LAB "; of a pattern it stands in parentheses: pattern=(SET:levels=...)"},
    {"level_factor", OF_LAB},
    {"threshold", OF_LAB},
    {"criterion", OF_LAB},
    {"component", OF_LAB},
    {"incident", OF_LAB},
    {"pattern_seed", OF_LAB},
    {NULL, NULL},
};

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    (void)parameters;
    aur_gather_settings *const p = integrator->data;
    const aur_gather_integrator *const gather = integrator->gather;
    const aur_gather_method *method = NULL;
    /* Short patterns, complete after few samples, if the final sample count is unknown. */
    if (p->split == 0 && !aur_integrator_knows_samples(context))
        p->split = UNKNOWN_SPLIT;
    aur_result result = gather != NULL && gather->select != NULL
                            ? gather->select(p, context->warnings, &method, error)
                            : AUR_OK;
    if (result == AUR_OK)
        result = aur_gather_settings_complete(p, error);
    if (result == AUR_OK)
        result = aur_scene_refuse_media(context->scene, "integrator 'finalgather'", error);
    if (result != AUR_OK)
        return result;
    integrator->pixel_centre = p->pixel == AUR_PIXEL_CENTRE;
    integrator->whole_tiles = p->share == AUR_SHARE_BLOCKS;
    integrator->refines_emitter_edges = p->edge_samples > 0;
    integrator->samples_a_pattern = (uint32_t)p->split;
    static const char *const directions[] = {"directions"};
    static const char *const sharing[] = {"sharing.R", "sharing.G", "sharing.B"};
    const bool near = p->share == AUR_SHARE_NEAR;
    integrator->extra_count = method != NULL && method->gather != NULL ? 1 : near ? 3 : 0;
    integrator->extra_names = near ? sharing : directions;
    aur_gather_plan *plan;
    result = aur_gather_plan_create(p, method, context, &plan, error);
    integrator->prepared = plan;
    return result;
}

/* Probe rays are those of one step of the render: of at most four patterns, if it continues in rounds, so
 * that each sample has at least that many for emitters. */
static aur_result prepare_view(const aur_view *view, const aur_integrator_context *context,
                               aur_integrator *integrator, aur_error *error) {
    enum { MOST_PATTERNS = 4 };
    const aur_gather_settings *const p = integrator->data;
    aur_gather_plan *const plan = integrator->prepared;
    const size_t probes = p->edge_samples / (MOST_PATTERNS * plan->samples_per_pattern);
    if (p->edge_samples == 0 || p->direct == AUR_DIRECT_NONE)
        return AUR_OK;
    const aur_result result = aur_emitter_edges_find(view, (uint16_t)(probes > 1 ? probes : 1), context,
                                                     &plan->emitter_edges, error);
    integrator->emitter_probes = plan->emitter_edges;
    return result;
}

static void release(aur_integrator *integrator) {
    aur_gather_plan_destroy(integrator->prepared);
}

static aur_result tile(const aur_integrator *integrator, aur_tile *tile) {
    return aur_gather_tile(integrator->prepared, tile);
}

const aur_integrator_descriptor aur_integrator_final_gather = {
    .row = {.name = "finalgather",
            .summary = "final gathering over a photon map, one pattern of directions per image",
            .source = "Christensen 1999, Marques 2013",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(aur_gather_settings),
    .initial = &initial,
    .moved = moved,
    .create = create,
    .prepare_view = prepare_view,
    .release = release,
    .tile = tile,
    .shows_emitters = true,
};

/* The reference integrator: unidirectional path tracing with next-event estimation, multiple importance
 * sampling and Russian roulette (Kajiya 1986; Veach 1997). */
#include <stdlib.h>

#include "render/film/clamp.h"
#include "render/path/path.h"
#include "render/vertex/candidates.h"

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(
        aur_path, "max_depth", max_depth, -1, 1 << 20, "-1",
        "longest path in edges: 1 is emitted light only, 2 adds direct light; -1 is unlimited")},
    {AUR_KEY_OF_INTEGER(aur_path, "rr_depth", rr_depth, 1, 1 << 20, "5",
                        "Russian roulette from this depth on")},
    {AUR_KEY_OF_BOOLEAN(aur_path, "hide_emitters", hide_emitters, "false", "lights are black to the camera")},
    {AUR_KEY_OF_BOOLEAN(
        aur_path, "packets", packets, "true",
        "trace sixteen pixels in lockstep instead of one path at a time; the image is the same")},
    {AUR_KEY_OF_BOOLEAN(aur_path, "interleaved", interleaved, "false",
                        "the pixels of a packet share all random numbers except those of camera rays")},
    {AUR_KEY_OF_INTEGER(aur_path, "candidates", candidates, 1, AUR_CANDIDATES_MOST, "1",
                        "candidate points on emitters per vertex; one is chosen by its unshadowed "
                        "contribution and gets the shadow ray: less noise under skies for more time")},
    AUR_CLAMP_KEY(aur_path),
    {AUR_KEY_OF_REAL(aur_path, "lamp_rays", probe_rays, 0.0, 64.0, "0.5; 0 if the sample count is unknown",
                     "extra camera rays per sample at edges of visible lights (image average)"),
     .computed = true},
};

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    aur_path *const data = integrator->data;
    aur_scene_warn_of_media(context->scene, "integrator 'path'", &context->warnings);
    if (data->interleaved && (!data->packets || data->hide_emitters))
        return aur_fail_at(error, parameters->location, AUR_ERROR_FORMAT,
                           "integrator 'path': 'interleaved' goes neither with 'packets=false' nor with "
                           "'hide_emitters=true'");
    /* Keep the noise of directly visible lights: otherwise --error stops before rare reflections of lights
     * are sampled. */
    if (aur_parameters_find(parameters, "lamp_rays") == NULL)
        data->probe_rays = aur_integrator_knows_samples(context) ? 0.5 : 0.0;
    integrator->hides_emitters = data->hide_emitters;
    aur_clamp_prepare(data->clamp, integrator);
    return aur_path_prepare(data, context->scene, error);
}

/* Hidden emitters need no probe rays. */
static aur_result prepare_view(const aur_view *view, const aur_integrator_context *context,
                               aur_integrator *integrator, aur_error *error) {
    aur_path *const data = integrator->data;
    if (data->probe_rays == 0.0 || data->hide_emitters)
        return AUR_OK;
    const aur_result result = aur_edge_probes_find(view, data->probe_rays, context, &data->probes, error);
    integrator->emitter_probes = data->probes != NULL ? data->probes->counts : NULL;
    return result;
}

static void release(aur_integrator *integrator) {
    free(((aur_path *)integrator->data)->classes);
}

static aur_vector radiance(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters) {
    const aur_path *const data = integrator->data;
    aur_vector unscattered;
    const aur_vector all = aur_path_radiance(data, integrator->scene, sample, NULL, &unscattered, counters);
    return aur_clamped(all, unscattered, data->clamp);
}

static aur_result tile(const aur_integrator *integrator, aur_tile *tile) {
    const aur_path *const data = integrator->data;
    if (data->packets && !data->hide_emitters) {
        aur_path_add_tile(data, integrator->scene, tile);
        return AUR_OK;
    }
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1; ++x)
            for (uint32_t i = tile->first; i < tile->first + tile->count; ++i)
                if (aur_tile_needs(tile, x, y, i))
                    aur_path_add_sample(data, integrator->scene, x, y, i, tile);
    return AUR_OK;
}

const aur_integrator_descriptor aur_integrator_path = {
    .row = {.name = "path",
            .summary = "unidirectional path tracing with multiple importance sampling, the reference",
            .source = "Kajiya 1986, Veach 1997",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(aur_path),
    .create = create,
    .prepare_view = prepare_view,
    .release = release,
    .radiance = radiance,
    .tile = tile,
    .cuts = true,
    .shows_emitters = true,
};

/* Path tracing in scenes with participating media. Mitsuba 3's volpath and volpathmis are the same integrator
 * here: without coloured extinction they differ only by noise. */
#include "render/film/clamp.h"
#include "render/vertex/vertex.h"
#include "render/volume/volume_path.h"

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(
        aur_volume_path, "max_depth", max_depth, -1, 1 << 20, "-1",
        "longest path in edges between scatterings: 1 is emitted light only; -1 is unlimited")},
    {AUR_KEY_OF_INTEGER(aur_volume_path, "rr_depth", rr_depth, 1, 1 << 20, "5",
                        "Russian roulette from this depth on")},
    {AUR_KEY_OF_BOOLEAN(aur_volume_path, "hide_emitters", hide_emitters, "false",
                        "lights are black to the camera")},
    AUR_CLAMP_KEY(aur_volume_path),
};

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    aur_volume_path *const data = integrator->data;
    (void)parameters, (void)error;
    data->passes = aur_panes_exist(context->scene);
    integrator->hides_emitters = data->hide_emitters;
    aur_clamp_prepare(data->clamp, integrator);
    return AUR_OK;
}

static aur_vector radiance(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters) {
    const aur_volume_path *const data = integrator->data;
    aur_vector unscattered;
    const aur_vector all = aur_volume_path_radiance(data, integrator->scene, sample, &unscattered, counters);
    return aur_clamped(all, unscattered, data->clamp);
}

static aur_result tile(const aur_integrator *integrator, aur_tile *tile) {
    const aur_volume_path *const data = integrator->data;
    for (size_t y = tile->y0; y < tile->y1; ++y)
        for (size_t x = tile->x0; x < tile->x1; ++x)
            for (uint32_t i = tile->first; i < tile->first + tile->count && !tile->counters.stopped; ++i) {
                aur_camera_sample sample;
                aur_vector unscattered;
                if (!aur_tile_needs(tile, x, y, i))
                    continue;
                aur_view_sample(tile->view, x, y, i, &sample);
                const aur_vector all =
                    aur_volume_path_radiance(data, integrator->scene, &sample, &unscattered, &tile->counters);
                aur_tile_add_clamped(tile, x, y, i, sample.offset, all, unscattered, data->clamp);
            }
    return AUR_OK;
}

#define VOLUME_PATH(name_, summary_)                                                                         \
    const aur_integrator_descriptor aur_integrator_##name_ = {                                               \
        .row = {.name = #name_,                                                                              \
                .summary = summary_,                                                                         \
                .source = "Miller, Georgiev and Jarosz 2019",                                                \
                AUR_ROW_KEYS(keys)},                                                                         \
        .size = sizeof(aur_volume_path),                                                                     \
        .create = create,                                                                                    \
        .radiance = radiance,                                                                                \
        .tile = tile,                                                                                        \
        .cuts = true,                                                                                        \
        .shows_emitters = true,                                                                              \
    }

VOLUME_PATH(volpath, "path tracing through participating media");
VOLUME_PATH(volpathmis, "another name of volpath");

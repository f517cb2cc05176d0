/* Path tracing in scenes with participating media. Both of Mitsuba 3's names for it are the same here, its
 * volpathmis: where extinction has no colour there is no difference but for noise. */
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
};

static aur_result create(aur_parameters *parameters, const aur_integrator_context *context,
                         aur_integrator *integrator, aur_error *error) {
    (void)parameters, (void)error;
    aur_volume_path *const data = integrator->data;
    data->passes = aur_panes_exist(context->scene);
    return AUR_OK;
}

static aur_vector radiance(const aur_integrator *integrator, const aur_camera_sample *sample,
                           aur_counters *counters) {
    return aur_volume_path_radiance(integrator->data, integrator->scene, sample, counters);
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
        .shows_lamps = true,                                                                                 \
    }

VOLUME_PATH(volpath, "path tracing through participating media");
VOLUME_PATH(volpathmis, "another name of volpath");

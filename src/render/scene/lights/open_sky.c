#include "render/scene/lights/sky_model.h"

#include <aureole/text.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "render/scene/scene_data.h"

static bool is_zero(const double v[3]) {
    return v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0;
}

/* The resulting up and north; `north` may stay 0: derived from `up`. */
static void find_axes(const aur_scene *scene, double up[3], double north[3]) {
    for (size_t i = 0; i < scene->environment_count && is_zero(up); ++i) {
        const aur_emitter *const emitter = scene->environments[i];
        if (emitter->descriptor->position_of == NULL)
            continue;
        const aur_sun_position *const at = emitter->descriptor->position_of(emitter);
        memcpy(up, at->up, sizeof at->up);
        if (is_zero(north))
            memcpy(north, at->north, sizeof at->north);
    }
    if (is_zero(up))
        up[scene->document.from_radiance ? 2 : 1] = 1.0;
}

static aur_result add_number(aur_parameters *parameters, aur_parameter_kind kind, const char *name,
                             size_t count, const double *values, aur_error *error) {
    char text[128] = "";
    for (size_t i = 0, length = 0; i < count; ++i)
        length +=
            (size_t)aur_format(text + length, sizeof text - length, i > 0 ? " %.17g" : "%.17g", values[i]);
    return aur_parameters_add_text(parameters, kind, name, text, parameters->location, error);
}

static aur_result create_sky(double ground, const double up[3], const double north[3], aur_emitter **sky,
                             aur_error *error) {
    static const double one[3] = {1.0, 1.0, 1.0};
    const double below[3] = {ground, ground, ground};
    aur_parameters parameters;
    aur_result result = aur_parameters_init(&parameters, "emitter", "sky", (aur_location){0}, error);
    if (result != AUR_OK)
        return result;
    result = aur_parameters_add_text(&parameters, AUR_PARAMETER_STRING, "model", "uniform",
                                     parameters.location, error);
    if (result == AUR_OK)
        result = add_number(&parameters, AUR_PARAMETER_COLOR, "zenith_radiance", 3, one, error);
    if (result == AUR_OK)
        result = add_number(&parameters, AUR_PARAMETER_COLOR, "ground", 3, below, error);
    if (result == AUR_OK)
        result = add_number(&parameters, AUR_PARAMETER_VECTOR, "up", 3, up, error);
    if (result == AUR_OK && !is_zero(north))
        result = add_number(&parameters, AUR_PARAMETER_VECTOR, "north", 3, north, error);
    if (result == AUR_OK)
        result = aur_emitter_create(&parameters, sky, error);
    aur_parameters_release(&parameters);
    return result;
}

/* The view: a shallow copy of the scene with different lights. */
typedef struct view {
    aur_scene scene; /* first, to convert from its scene pointer */
    aur_emitter *dark, *sky;
} view;

/* The lights keep their indices, which shapes refer to, but emit nothing; the sky is appended. */
static aur_result set_lights(const aur_scene *scene, view *created, aur_open_sky *open, aur_error *error) {
    const size_t count = scene->emitter_count;
    aur_scene *const copy = &created->scene;
    double *const powers = calloc(count + 1, sizeof *powers);
    created->dark = calloc(count + 1, sizeof *created->dark);
    copy->emitters = calloc(count + 1, sizeof *copy->emitters);
    copy->environments = calloc(1, sizeof *copy->environments);
    aur_result result = AUR_OK;
    if (powers == NULL || created->dark == NULL || copy->emitters == NULL || copy->environments == NULL) {
        result = aur_fail_memory(error);
    } else {
        for (size_t i = 0; i < count; ++i) {
            created->dark[i] = *scene->emitters[i];
            created->dark[i].radiance = (aur_color){.texture = NULL};
            created->dark[i].power = 0.0;
            open->removed_lights += scene->emitters[i]->descriptor->radiance_from == NULL;
            copy->emitters[i] = &created->dark[i];
        }
        copy->environments[0] = copy->emitters[count] = created->sky;
        copy->emitter_count = count + 1;
        copy->environment_count = 1;
        created->sky->index = (uint32_t)count;
        created->sky->scene = copy;
        powers[count] = created->sky->power = 1.0;
        result = created->sky->descriptor->prepare(created->sky, error);
        if (result == AUR_OK)
            result = aur_distribution_create(&copy->lights, count + 1, powers, error);
        if (result == AUR_OK)
            result = aur_light_choice_create(copy, error);
    }
    free(powers);
    return result;
}

aur_result aur_open_sky_create(const aur_scene *scene, double ground, const double up[3],
                               const double north[3], aur_open_sky *open, aur_error *error) {
    *open = (aur_open_sky){.scene = NULL};
    double local_up[3] = {up[0], up[1], up[2]}, local_north[3] = {north[0], north[1], north[2]};
    find_axes(scene, local_up, local_north);
    view *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    created->scene = *scene;
    created->scene.emitters = NULL;
    created->scene.environments = NULL;
    created->scene.lights = (aur_distribution){0};
    created->scene.choice = (aur_light_choice){.parts = NULL};
    open->scene = &created->scene;
    aur_result result = create_sky(ground, local_up, local_north, &created->sky, error);
    if (result == AUR_OK)
        result = set_lights(scene, created, open, error);
    if (result == AUR_OK)
        open->frame = *created->sky->descriptor->position_of(created->sky);
    else
        aur_open_sky_release(open);
    return result;
}

void aur_open_sky_release(aur_open_sky *open) {
    view *const created = (view *)(uintptr_t)open->scene;
    if (created == NULL)
        return;
    aur_emitter_destroy(created->sky);
    free(created->dark);
    free(created->scene.emitters);
    free(created->scene.environments);
    aur_distribution_release(&created->scene.lights);
    aur_light_choice_release(&created->scene.choice);
    free(created);
    *open = (aur_open_sky){.scene = NULL};
}

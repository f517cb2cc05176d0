/* Two colours in squares of half a unit. */
#include <stdlib.h>

#include "material/texture.h"

typedef struct checkerboard {
    aur_color color[2];
    aur_uv_map to_uv;
} checkerboard;

static aur_result create(aur_parameters *parameters, aur_texture *texture, aur_error *error) {
    checkerboard *const self = calloc(1, sizeof *self);
    texture->data = self;
    if (self == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_MEMORY, "out of memory");
    self->color[0].constant = (aur_vector){0.4f, 0.4f, 0.4f};
    self->color[1].constant = (aur_vector){0.2f, 0.2f, 0.2f};
    aur_result result = aur_parameters_color(parameters, "color0", 1e30, &self->color[0], error);
    if (result == AUR_OK)
        result = aur_parameters_color(parameters, "color1", 1e30, &self->color[1], error);
    if (result == AUR_OK)
        result = aur_parameters_uv_map(parameters, &self->to_uv, error);
    const aur_vector a = aur_color_mean(&self->color[0]), b = aur_color_mean(&self->color[1]);
    texture->mean = aur_vector_scale(aur_vector_add(a, b), 0.5f);
    for (size_t i = 0; i < 2; ++i)
        texture->maximum =
            fmaxf(texture->maximum, self->color[i].texture != NULL ? self->color[i].texture->maximum
                                                                   : aur_vector_max(self->color[i].constant));
    return result;
}

static void release(aur_texture *texture) {
    free(texture->data);
}

static aur_vector evaluate(const aur_texture *texture, float u, float v) {
    const checkerboard *const self = texture->data;
    const aur_bsdf_point at = aur_uv_map_apply(&self->to_uv, u, v);
    const bool right = at.u - floorf(at.u) > 0.5f;
    const bool low = at.v - floorf(at.v) > 0.5f;
    return aur_color_at(&self->color[right == low ? 0 : 1], (aur_bsdf_point){u, v});
}

const aur_texture_descriptor aur_texture_checkerboard = {
    .name = "checkerboard",
    .summary = "two colours in squares",
    .create = create,
    .release = release,
    .evaluate = evaluate,
};

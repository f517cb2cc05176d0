/* The product of a texture and a colour, of Mitsuba 0.6. */
#include "render/scene/materials/texture.h"

typedef struct scaled {
    aur_color value;
    aur_vector scale;
} scaled;

static const aur_key keys[] = {
    {AUR_KEY_OF_COLOR(scaled, "value", value, 1e30, "1", "colour, or texture of any name")},
    {AUR_KEY_OF_VECTOR(scaled, "scale", scale, 0.0, 1e30, "1", "factor, a number or RGB")},
};

static aur_result create(aur_parameters *parameters, aur_texture *texture, aur_error *error) {
    scaled *const self = texture->data;
    const aur_result result = aur_colors_read(&texture->descriptor->row, parameters, self, error);
    const aur_texture *const nested = self->value.texture;
    texture->mean = aur_vector_multiply(self->scale, aur_color_mean(&self->value));
    texture->maximum = aur_vector_max(self->scale) *
                       (nested != NULL ? nested->maximum : aur_vector_max(self->value.constant));
    texture->aspect = nested != NULL ? nested->aspect : 0.0f;
    return result;
}

static aur_vector evaluate(const aur_texture *texture, aur_bsdf_point point) {
    const scaled *const self = texture->data;
    return aur_vector_multiply(self->scale, aur_color_at(&self->value, point));
}

/* Exact for grey textures or scales. */
static void slope(const aur_texture *texture, aur_bsdf_point point, float slope[2]) {
    const scaled *const self = texture->data;
    const aur_texture *const nested = self->value.texture;
    slope[0] = slope[1] = 0.0f;
    if (nested == NULL || nested->descriptor->slope == NULL)
        return;
    nested->descriptor->slope(nested, point, slope);
    const float factor = aur_luminance(self->scale);
    slope[0] *= factor;
    slope[1] *= factor;
}

const aur_texture_descriptor aur_texture_scale = {
    .row = {.name = "scale",
            .summary = "a texture times a factor",
            .source = "Mitsuba 0.6",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(scaled),
    .create = create,
    .evaluate = evaluate,
    .slope = slope,
};

/* Constant textures: for scenes that write a colour as one. */
#include "render/scene/materials/texture.h"

typedef struct constant {
    aur_vector value;
} constant;

static const aur_key value_keys[] = {
    {AUR_KEY_OF_VECTOR(constant, "value", value, 0.0, 1e30, "1", "number or colour")}};
static const aur_key color_keys[] = {{AUR_KEY_OF_VECTOR(constant, "color", value, 0.0, 1e30, "1", "colour")}};

static aur_result create(aur_parameters *parameters, aur_texture *texture, aur_error *error) {
    constant *const self = texture->data;
    const aur_result result = aur_row_read(&texture->descriptor->row, parameters, self, error);
    texture->mean = self->value;
    texture->maximum = aur_vector_max(self->value);
    return result;
}

static aur_vector evaluate(const aur_texture *texture, aur_bsdf_point point) {
    (void)point;
    return ((const constant *)texture->data)->value;
}

#define CONSTANT(name_, summary_, keys_)                                                                     \
    const aur_texture_descriptor aur_texture_##name_ = {                                                     \
        .row = {.name = #name_, .summary = summary_, .source = "", AUR_ROW_KEYS(keys_)},                     \
        .size = sizeof(constant),                                                                            \
        .create = create,                                                                                    \
        .evaluate = evaluate}

CONSTANT(uniform, "a number everywhere", value_keys);
CONSTANT(rawconstant, "a number or three everywhere", value_keys);
CONSTANT(srgb, "one colour everywhere", color_keys);

/* Two colours in squares of half a unit, or lines on a ground: the grid of Mitsuba 0.6. */
#include "render/scene/materials/texture.h"

typedef struct checkerboard {
    aur_color color[2];
    aur_uv_map to_uv;
    aur_uv_keys uv;
    float half_width; /* of lines */
} checkerboard;

static const aur_key keys[] = {
    {AUR_KEY_OF_COLOR(checkerboard, "color0", color[0], 1e30, "0.4", "of the square at (0, 0)")},
    {AUR_KEY_OF_COLOR(checkerboard, "color1", color[1], 1e30, "0.2", "of its neighbours")},
    AUR_UV_KEYS(checkerboard),
};

static const aur_key grid_keys[] = {
    {AUR_KEY_OF_COLOR(checkerboard, "color0", color[0], 1e30, "0.2", "between the lines")},
    {AUR_KEY_OF_COLOR(checkerboard, "color1", color[1], 1e30, "0.4", "of the lines")},
    {AUR_KEY_OF_REAL(checkerboard, "line_width", half_width, 0.0, 0.5, "0.01",
                     "half the width of lines, whose middles have whole u or v")},
    AUR_UV_KEYS(checkerboard),
};

extern const aur_texture_descriptor aur_texture_gridtexture;

static aur_result create(aur_parameters *parameters, aur_texture *texture, aur_error *error) {
    checkerboard *const self = texture->data;
    const aur_result result = aur_colors_read(&texture->descriptor->row, parameters, self, error);
    if (result != AUR_OK)
        return result;
    self->to_uv = aur_uv_map_of(&self->uv);
    const aur_vector a = aur_color_mean(&self->color[0]), b = aur_color_mean(&self->color[1]);
    const bool grid = texture->descriptor == &aur_texture_gridtexture;
    const float free = 1.0f - 2.0f * self->half_width, share = grid ? free * free : 0.5f;
    texture->mean = aur_vector_add_scaled(aur_vector_scale(a, share), 1.0f - share, b);
    for (size_t i = 0; i < 2; ++i)
        texture->maximum =
            fmaxf(texture->maximum, self->color[i].texture != NULL ? self->color[i].texture->maximum
                                                                   : aur_vector_max(self->color[i].constant));
    return AUR_OK;
}

static aur_vector evaluate(const aur_texture *texture, aur_bsdf_point point) {
    const checkerboard *const self = texture->data;
    const aur_bsdf_point at = aur_uv_map_apply(&self->to_uv, point.u, point.v);
    const bool right = at.u - floorf(at.u) > 0.5f;
    const bool low = at.v - floorf(at.v) > 0.5f;
    return aur_color_at(&self->color[right == low ? 0 : 1], point);
}

static aur_vector evaluate_grid(const aur_texture *texture, aur_bsdf_point point) {
    const checkerboard *const self = texture->data;
    const aur_bsdf_point at = aur_uv_map_apply(&self->to_uv, point.u, point.v);
    const float across = fabsf(at.u - roundf(at.u)), along = fabsf(at.v - roundf(at.v));
    return aur_color_at(&self->color[fminf(across, along) < self->half_width ? 1 : 0], point);
}

const aur_texture_descriptor aur_texture_checkerboard = {
    .row = {.name = "checkerboard", .summary = "two colours in squares", .source = "", AUR_ROW_KEYS(keys)},
    .size = sizeof(checkerboard),
    .create = create,
    .evaluate = evaluate,
};

const aur_texture_descriptor aur_texture_gridtexture = {
    .row = {.name = "gridtexture",
            .summary = "lines on a ground",
            .source = "Mitsuba 0.6",
            AUR_ROW_KEYS(grid_keys)},
    .size = sizeof(checkerboard),
    .create = create,
    .evaluate = evaluate_grid,
};

#include "render/scene/materials/texture.h"

#include <stdlib.h>

aur_result aur_colors_read(const aur_row *row, aur_parameters *parameters, void *fields, aur_error *error) {
    aur_result result = aur_row_read(row, parameters, fields, error);
    for (size_t i = 0; i < row->key_count && result == AUR_OK; ++i) {
        const aur_key *const key = &row->keys[i];
        if (key->type != AUR_KEY_COLOR)
            continue;
        const aur_texture *const texture = ((const aur_color *)((const char *)fields + key->offset))->texture;
        if (texture != NULL && texture->maximum > key->maximum)
            result =
                aur_fail_at(error, aur_parameters_find(parameters, key->name)->location, AUR_ERROR_FORMAT,
                            "%s '%s': '%s' must be at most %g, but the texture reaches %g", parameters->kind,
                            parameters->plugin, key->name, key->maximum, (double)texture->maximum);
    }
    return result;
}

aur_uv_map aur_uv_map_of(const aur_uv_keys *keys) {
    aur_uv_map map;
    for (size_t i = 0; i < 2; ++i) {
        map.m[3 * i] = (float)(keys->scale[i] * keys->to_uv[4 * i]);
        map.m[3 * i + 1] = (float)(keys->scale[i] * keys->to_uv[4 * i + 1]);
        map.m[3 * i + 2] = (float)(keys->scale[i] * keys->to_uv[4 * i + 3] + keys->offset[i]);
    }
    return map;
}

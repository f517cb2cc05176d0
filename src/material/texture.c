#include "material/texture.h"

#include <stdlib.h>
#include <string.h>

void aur_texture_destroy(aur_texture *texture) {
    if (texture == NULL)
        return;
    if (texture->data != NULL)
        texture->descriptor->release(texture);
    free(texture);
}

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

aur_result aur_parameters_color(aur_parameters *parameters, const char *name, double maximum,
                                aur_color *color, aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    if (item->kind == AUR_PARAMETER_OBJECT && strcmp(item->object_kind, "texture") == 0) {
        const aur_texture *const texture = item->object;
        if (texture->maximum > maximum)
            return aur_fail_at(error, item->location, AUR_ERROR_FORMAT,
                               "%s '%s': '%s' must be at most %g, but the texture reaches %g",
                               parameters->kind, parameters->plugin, name, maximum, (double)texture->maximum);
        *color = (aur_color){.texture = texture};
        return AUR_OK;
    }
    double value[3];
    const aur_result result = aur_parameters_triple(parameters, name, 0.0, maximum, value, error);
    if (result == AUR_OK)
        *color = (aur_color){{(float)value[0], (float)value[1], (float)value[2]}, NULL};
    return result;
}

aur_result aur_parameters_uv_map(aur_parameters *parameters, aur_uv_map *map, aur_error *error) {
    double m[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    aur_result result = aur_parameters_transform(parameters, "to_uv", m, error);
    /* Mitsuba 0.6's way to say it. */
    double scale[2] = {1.0, 1.0}, offset[2] = {0.0, 0.0};
    if (result == AUR_OK)
        result = aur_parameters_float(parameters, "uscale", -1e30, 1e30, &scale[0], error);
    if (result == AUR_OK)
        result = aur_parameters_float(parameters, "vscale", -1e30, 1e30, &scale[1], error);
    if (result == AUR_OK)
        result = aur_parameters_float(parameters, "uoffset", -1e30, 1e30, &offset[0], error);
    if (result == AUR_OK)
        result = aur_parameters_float(parameters, "voffset", -1e30, 1e30, &offset[1], error);
    for (size_t i = 0; i < 2; ++i) {
        map->m[3 * i] = (float)(scale[i] * m[4 * i]);
        map->m[3 * i + 1] = (float)(scale[i] * m[4 * i + 1]);
        map->m[3 * i + 2] = (float)(scale[i] * m[4 * i + 3] + offset[i]);
    }
    return result;
}

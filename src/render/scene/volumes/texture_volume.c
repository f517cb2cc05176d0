/* A volume used as a texture: its value at the surface point; texture coordinates are ignored. */
#include <string.h>

#include "render/scene/materials/texture.h"
#include "render/scene/volume.h"

typedef struct volume_texture {
    const aur_parameter *item; /* read, not used afterwards */
    const aur_volume *volume;
} volume_texture;

static const aur_key keys[] = {
    {AUR_KEY_OF_ITEM(volume_texture, "volume", item, NULL, "the volume; must be given", "volume")},
};

static aur_vector evaluate(const aur_texture *texture, aur_bsdf_point point) {
    const aur_volume *const volume = ((const volume_texture *)texture->data)->volume;
    return volume->descriptor->evaluate(volume, point.position);
}

static aur_result create(aur_parameters *parameters, aur_texture *texture, aur_error *error) {
    volume_texture *const self = texture->data;
    const aur_result result = aur_row_read(&texture->descriptor->row, parameters, self, error);
    if (result != AUR_OK)
        return result;
    if (self->item == NULL || self->item->kind != AUR_PARAMETER_OBJECT ||
        strcmp(self->item->object_kind, "volume") != 0)
        return aur_parameters_fail(parameters, error, AUR_ERROR_FORMAT,
                                   "it needs a <volume> with the name 'volume'");
    self->volume = self->item->object;
    texture->maximum = self->volume->maximum;
    const float mean = 0.5f * (self->volume->minimum + self->volume->maximum); /* an arbitrary guess */
    texture->mean = (aur_vector){mean, mean, mean};
    texture->attributes.position = true;
    return AUR_OK;
}

const aur_texture_descriptor aur_texture_volume = {
    .row = {.name = "volume",
            .summary = "a volume, where the surface is",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(volume_texture),
    .create = create,
    .evaluate = evaluate,
};

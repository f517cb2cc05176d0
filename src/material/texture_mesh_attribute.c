/* The colours that a mesh has at its vertices or faces. */
#include "material/texture.h"

#include <string.h>

typedef struct attribute {
    aur_vector scale;
    bool of_faces;
    const char *name; /* read, and of no use afterwards */
} attribute;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(attribute, "name", name, NULL, "vertex_color or face_color; must be given")},
    {AUR_KEY_OF_VECTOR(attribute, "scale", scale, 0.0, 1e30, "1", "factor")},
};

static aur_result create(aur_parameters *parameters, aur_texture *texture, aur_error *error) {
    attribute *const self = texture->data;
    const aur_result result = aur_row_read(&texture->descriptor->row, parameters, self, error);
    if (result != AUR_OK)
        return result;
    self->of_faces = self->name != NULL && strcmp(self->name, "face_color") == 0;
    if (!self->of_faces && (self->name == NULL || strcmp(self->name, "vertex_color") != 0))
        return aur_fail_at(error, parameters->location, AUR_ERROR_UNSUPPORTED,
                           "texture 'mesh_attribute': 'name' must be vertex_color or face_color, not '%s'",
                           self->name != NULL ? self->name : "");
    texture->attributes = self->of_faces ? AUR_ATTRIBUTE_FACE_COLOR : AUR_ATTRIBUTE_VERTEX_COLOR;
    texture->mean = aur_vector_scale(self->scale, 0.5f); /* a guess, that lights are chosen by */
    return AUR_OK;
}

static aur_vector evaluate(const aur_texture *texture, aur_bsdf_point point) {
    const attribute *const self = texture->data;
    return aur_vector_multiply(self->of_faces ? point.face_color : point.vertex_color, self->scale);
}

const aur_texture_descriptor aur_texture_mesh_attribute = {
    .row = {.name = "mesh_attribute",
            .summary = "colours that a mesh has at its vertices or faces",
            .source = "Mitsuba 3",
            AUR_ROW_KEYS(keys)},
    .size = sizeof(attribute),
    .create = create,
    .evaluate = evaluate,
};

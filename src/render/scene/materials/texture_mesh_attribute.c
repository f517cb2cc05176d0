/* Mesh attributes of vertices or faces, as colours. */
#include "render/scene/materials/texture.h"

#include <string.h>

typedef struct attribute {
    aur_vector scale;
    bool of_faces;
    const char *given; /* read, not used afterwards */
    char name[64];
} attribute;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(
        attribute, "name", given, NULL,
        "vertex_color, face_color, or another vertex_... or face_... that the file has; must be given")},
    {AUR_KEY_OF_VECTOR(attribute, "scale", scale, 0.0, 1e30, "1", "factor")},
};

static aur_result create(aur_parameters *parameters, aur_texture *texture, aur_error *error) {
    attribute *const self = texture->data;
    const aur_result result = aur_row_read(&texture->descriptor->row, parameters, self, error);
    if (result != AUR_OK)
        return result;
    const char *const name = self->given != NULL ? self->given : "";
    self->of_faces = strncmp(name, "face_", 5) == 0;
    if ((!self->of_faces && strncmp(name, "vertex_", 7) != 0) || strlen(name) >= sizeof self->name)
        return aur_fail_at(
            error, parameters->location, AUR_ERROR_UNSUPPORTED,
            "texture 'mesh_attribute': 'name' must begin with vertex_ or face_, as vertex_color, not '%s'",
            name);
    memcpy(self->name, name, strlen(name));
    *(self->of_faces ? &texture->attributes.face : &texture->attributes.vertex) = self->name;
    texture->mean = aur_vector_scale(self->scale, 0.5f); /* a guess, used for the power of lights */
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

/* The table of textures, and making them by name: a new one is one file, which defines aur_texture_<name>,
 * and one line here. */
#include <stdlib.h>
#include <string.h>

#include "render/scene/materials/texture.h"

#define TEXTURES(ROW)                                                                                        \
    ROW(bitmap)                                                                                              \
    ROW(checkerboard)                                                                                        \
    ROW(mesh_attribute)                                                                                      \
    ROW(uniform)                                                                                             \
    ROW(rawconstant)                                                                                         \
    ROW(srgb)

#define DECLARE(name) extern const aur_texture_descriptor aur_texture_##name;
TEXTURES(DECLARE)

#define ADDRESS(name) &aur_texture_##name.row,
static const aur_row *const rows[] = {TEXTURES(ADDRESS)};

const aur_table aur_texture_table = {
    .kind = "texture", .summary = "colours that vary over a surface", AUR_TABLE_ROWS(rows)};

static void add_attribute(const char **name, const char *other, bool *too_many) {
    *too_many = *too_many || (*name != NULL && other != NULL && strcmp(*name, other) != 0);
    *name = *name != NULL ? *name : other;
}

void aur_attributes_add(aur_attributes *attributes, const aur_attributes *others) {
    attributes->too_many = attributes->too_many || others->too_many;
    add_attribute(&attributes->vertex, others->vertex, &attributes->too_many);
    add_attribute(&attributes->face, others->face, &attributes->too_many);
}

aur_result aur_texture_create(aur_parameters *parameters, aur_texture **texture, aur_error *error) {
    *texture = NULL;
    const aur_row *row;
    aur_result result = aur_table_find(&aur_texture_table, parameters, &row, error);
    if (result != AUR_OK)
        return result;
    aur_texture *const made = calloc(1, sizeof *made);
    if (made == NULL)
        return aur_fail_memory_at(error, parameters->location);
    made->descriptor = (const aur_texture_descriptor *)row;
    made->data = calloc(1, made->descriptor->size);
    result = made->data != NULL ? made->descriptor->create(parameters, made, error)
                                : aur_fail_memory_at(error, parameters->location);
    if (result != AUR_OK) {
        aur_texture_destroy(made);
        return result;
    }
    for (size_t i = 0; i < parameters->count; ++i)
        if (parameters->items[i].kind == AUR_PARAMETER_OBJECT &&
            strcmp(parameters->items[i].object_kind, "texture") == 0)
            aur_attributes_add(&made->attributes,
                               &((const aur_texture *)parameters->items[i].object)->attributes);
    *texture = made;
    return AUR_OK;
}

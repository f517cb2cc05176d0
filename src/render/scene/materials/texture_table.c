/* Textures by name, and their creation. To add one: one file, which defines aur_texture_<name>, and one line
 * here. */
#include <stddef.h>
#include <string.h>

#include "render/scene/materials/texture.h"
#include "render/scene/plugin/plugin.h"

#define TEXTURES(ROW)                                                                                        \
    ROW(bitmap)                                                                                              \
    ROW(checkerboard)                                                                                        \
    ROW(gridtexture)                                                                                         \
    ROW(scale)                                                                                               \
    ROW(mesh_attribute)                                                                                      \
    ROW(volume)                                                                                              \
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
    attributes->position = attributes->position || others->position;
    add_attribute(&attributes->vertex, others->vertex, &attributes->too_many);
    add_attribute(&attributes->face, others->face, &attributes->too_many);
}

static aur_result fill(aur_parameters *parameters, void *object, const void *context, aur_error *error) {
    aur_texture *const texture = object;
    memcpy(&texture->pages, context, sizeof texture->pages);
    const aur_result result = texture->descriptor->create(parameters, texture, error);
    for (size_t i = 0; i < parameters->count; ++i)
        if (parameters->items[i].kind == AUR_PARAMETER_OBJECT &&
            strcmp(parameters->items[i].object_kind, "texture") == 0)
            aur_attributes_add(&texture->attributes,
                               &((const aur_texture *)parameters->items[i].object)->attributes);
    return result;
}

static const aur_plugin_kind kind = AUR_PLUGIN_KIND(texture);

aur_result aur_texture_create(aur_parameters *parameters, struct aur_texel_pages *pages,
                              aur_texture **texture, aur_error *error) {
    return aur_plugin_create(&kind, parameters, &pages, texture, error);
}

void aur_texture_destroy(aur_texture *texture) {
    aur_plugin_destroy(&kind, texture);
}

#include "render/scene/importers/model/model.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "points/base/names.h"
#include "points/base/text.h"
#include "render/scene/importers/model/import.h"

/* The formats of assimp that programs other than their original one write. */
bool aur_model_is_name(const char *path) {
    static const char *const endings[] = {".glb", ".gltf", ".obj", ".fbx", ".dae",
                                          ".stl", ".ply",  ".off", ".3ds"};
    const char *const dot = strrchr(path, '.');
    for (size_t i = 0; dot != NULL && i < sizeof endings / sizeof endings[0]; ++i)
        if (strcasecmp(dot, endings[i]) == 0)
            return true;
    return false;
}

static const char *const light_names[] = {"auto", "always", "none"};

aur_result aur_model_light_from_name(const char *name, aur_model_light *light, aur_error *error) {
    size_t index;
    const aur_result result = aur_names_choose(aur_names_of(AUR_MODEL_LIGHT_COUNT, light_names),
                                               "light of models", name, (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *light = (aur_model_light)index;
    return result;
}

const char *aur_model_light_name(aur_model_light light) {
    return (size_t)light < AUR_MODEL_LIGHT_COUNT ? light_names[light] : NULL;
}

aur_result aur_model_read(const aur_model_source *source, aur_model_files *files, aur_nodes *nodes,
                          aur_xml_node *parent) {
    const aur_mesh_format format = aur_mesh_format_of_name(source->name);
    return format < AUR_MESH_FORMAT_COUNT ? aur_model_from_mesh(source, format, files, nodes, parent)
                                          : aur_model_import(source, files, nodes, parent);
}

const aur_model_file *aur_model_find_file(const aur_model_files *files, const char *filename) {
    uint64_t index;
    if (filename[0] != '*' || aur_read_integer(filename + 1, SIZE_MAX, &index) == NULL)
        return NULL;
    return index < files->count ? &files->items[index] : NULL;
}

void aur_model_release_files(aur_model_files *files) {
    for (size_t i = 0; i < files->count; ++i) {
        free(files->items[i].name);
        free(files->items[i].data);
    }
    free(files->items);
    *files = (aur_model_files){0};
}

#include "scene/model/model.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/module.h"
#include "core/text.h"

/* Of what assimp reads, the forms that others than their own program write. */
bool aur_model_is_name(const char *path) {
    static const char *const endings[] = {".glb", ".gltf", ".obj", ".fbx", ".dae",
                                          ".stl", ".ply",  ".off", ".3ds"};
    const char *const dot = strrchr(path, '.');
    for (size_t i = 0; dot != NULL && i < sizeof endings / sizeof endings[0]; ++i)
        if (strcasecmp(dot, endings[i]) == 0)
            return true;
    return false;
}

aur_result aur_model_to_xml(const aur_model_source *source, aur_model_files *files, char **xml,
                            size_t *xml_size, aur_error *error) {
    *xml = NULL;
    const aur_model_import_function import =
        (aur_model_import_function)aur_module_find("aureole-assimp.so", "aur_model_import", false);
    if (import == NULL)
        return aur_fail_at(error, source->location, AUR_ERROR_UNSUPPORTED,
                           "a model in this form is read by the library assimp, which this build has not: "
                           "install libassimp-dev and build again, or convert it to Mitsuba's XML");
    return import(source, files, xml, xml_size, error);
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

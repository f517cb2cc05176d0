#include "render/scene/importers/xml/xml.h"

#include <string.h>

typedef struct model_reading {
    aur_xml_document *document;
    const char *path;
} model_reading;

bool aur_xml_is_model(const char *path, size_t size, const char *data) {
    static const char start[] = "<scene";
    return aur_model_is_name(path) && (size < sizeof start - 1 || memcmp(data, start, sizeof start - 1) != 0);
}

bool aur_xml_is_z_up(const aur_xml_document *document, const aur_scene_stage *stage) {
    return stage->up == AUR_SCENE_UP_AUTO ? document->stage.z_up || document->from_radiance
                                          : stage->up == AUR_SCENE_UP_Z;
}

/* Files next to a model are resolved, recorded and confined like all files of a scene, with tolerant matching
 * of names. */
static aur_result find_part(void *state, const char *name, char **used, char **path, aur_error *error) {
    const model_reading *const self = state;
    const aur_location location = {.file = self->path};
    *path = NULL;
    aur_result result = aur_xml_forgive_name(self->document, location, name, used, error);
    if (result == AUR_OK && *used != NULL)
        result = aur_xml_find_asset(self->document, location, *used, path, error);
    return result;
}

aur_result aur_xml_read_model(aur_xml_document *document, const aur_scene_options *options, bool included,
                              size_t size, const char *data, aur_nodes *nodes, aur_xml_node *parent) {
    const char *const path = nodes->location.file, *const slash = strrchr(path, '/');
    model_reading reading = {document, path};
    document->stage.light = options->model_light;
    const aur_model_source source = {.name = slash != NULL ? slash + 1 : path,
                                     .size = size,
                                     .data = data,
                                     .stage = included ? NULL : &document->stage,
                                     .time = options->stage.has_time ? &options->stage.time : NULL,
                                     .variant = options->stage.variant,
                                     .warnings = &options->warnings,
                                     .progress = options->progress,
                                     .location = nodes->location,
                                     .find = find_part,
                                     .state = &reading};
    return aur_model_read(&source, &document->model_files, nodes, parent);
}

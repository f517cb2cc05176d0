#include "scene/xml/model_file.h"

#include <stdlib.h>
#include <string.h>

#include "core/file.h"

#define LARGEST_PART ((size_t)1 << 34)

typedef struct model_reading {
    aur_xml_document *document;
    const char *path, *name, *data;
    size_t size;
} model_reading;

bool aur_xml_is_model(const char *path, size_t size, const char *data) {
    static const char start[] = "<scene";
    return aur_model_is_name(path) && (size < sizeof start - 1 || memcmp(data, start, sizeof start - 1) != 0);
}

/* Files beside a model are found, noted and confined as all that a scene names. */
static bool read_part(void *state, const char *name, size_t *size, char **data) {
    const model_reading *const self = state;
    if (strcmp(name, self->name) == 0) {
        *size = self->size;
        *data = malloc(*size + 1);
        if (*data != NULL)
            memcpy(*data, self->data, *size);
        return *data != NULL;
    }
    char *path;
    const aur_location location = {.file = self->path};
    if (aur_xml_find_asset(self->document, location, name, &path, NULL) != AUR_OK)
        return false;
    const aur_result result = aur_file_read(path, LARGEST_PART, data, size, NULL);
    free(path);
    return result == AUR_OK;
}

aur_result aur_xml_read_model(aur_xml_document *document, const aur_warnings *warnings, bool included,
                              const char *path, size_t *size, const char *data, char **xml,
                              aur_error *error) {
    const char *const slash = strrchr(path, '/');
    model_reading reading = {document, path, slash != NULL ? slash + 1 : path, data, *size};
    const aur_model_source source = {.name = reading.name,
                                     .alone = !included,
                                     .warnings = warnings,
                                     .location = {.file = path},
                                     .read = read_part,
                                     .state = &reading};
    return aur_model_to_xml(&source, &document->model_files, xml, size, error);
}

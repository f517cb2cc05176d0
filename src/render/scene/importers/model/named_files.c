#include "render/scene/importers/model/import.h"

#include <aureole-render/image.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "points/base/file.h"

enum { NAMES_SHOWN = 5 };
#define LARGEST_PART ((size_t)1 << 34)

/* Adds a name once; it may contain whatever the file contains. */
static void list(aur_name_list *self, const char *format, ...) AUR_PRINTF(2, 3);
static void list(aur_name_list *self, const char *format, ...) {
    char text[300];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (char *c = text; *c != '\0'; ++c)
        if ((unsigned char)*c < 32 || *c == 127)
            *c = '?';
    const size_t used = strlen(self->text);
    if (strstr(self->text, text) != NULL)
        return;
    if (self->count++ < NAMES_SHOWN)
        snprintf(self->text + used, sizeof self->text - used, "%s%s", used > 0 ? ", " : "", text);
}

aur_result aur_named_read(aur_named_files *self, const char *name, char **used, size_t *size, char **data,
                          aur_error *error) {
    *used = *data = NULL;
    *size = 0;
    char *path;
    aur_result result = self->source->find(self->source->state, name, used, &path, error);
    if (result == AUR_OK && path != NULL)
        result = aur_file_read(path, LARGEST_PART, data, size, error);
    if (result == AUR_OK && path != NULL && strcmp(*used, name) != 0)
        list(&self->renamed, "'%s' as '%s'", name, *used);
    free(path);
    return result;
}

aur_result aur_named_read_part(aur_named_files *self, const char *name, char **used, size_t *size,
                               char **data, aur_error *error) {
    const aur_result result = aur_named_read(self, name, used, size, data, error);
    if (result == AUR_OK && *data == NULL)
        list(&self->missing, "'%s'", name);
    return result;
}

bool aur_named_is_image(aur_named_files *self, const char *name, size_t size, const char *data) {
    const bool good = aur_image_format_of(size, data) != NULL;
    if (!good)
        list(&self->unknown_images, "%s", name);
    return good;
}

/* These formats are identified by file extension only. */
static bool is_targa(const char *name) {
    const char *const dot = strrchr(name, '.');
    return dot != NULL && strcasecmp(dot, ".tga") == 0;
}

aur_result aur_named_find_image(aur_named_files *self, const char *name, char **used, aur_error *error) {
    char *data, quoted[300];
    size_t size;
    const aur_result result = aur_named_read(self, name, used, &size, &data, error);
    snprintf(quoted, sizeof quoted, "'%s'", name);
    if (result == AUR_OK && data == NULL)
        list(&self->missing_images, "%s", quoted);
    if (result != AUR_OK || data == NULL ||
        (!is_targa(*used) && !aur_named_is_image(self, quoted, size, data))) {
        free(*used);
        *used = NULL;
    }
    free(data);
    return result;
}

static void warn_of(const aur_named_files *self, const aur_name_list *names, const char *one,
                    const char *several) {
    if (names->count > 0)
        aur_warn_at(self->source->warnings, self->source->location, "%zu %s: %s%s", names->count,
                    names->count == 1 ? one : several, names->text,
                    names->count > NAMES_SHOWN ? ", ..." : "");
}

void aur_named_warn(const aur_named_files *self) {
    warn_of(self, &self->renamed, "file has another spelling", "files have other spellings");
    warn_of(self, &self->missing, "file cannot be found", "files cannot be found");
    warn_of(self, &self->missing_images, "texture is left out: its image cannot be found",
            "textures are left out: their images cannot be found");
    warn_of(self, &self->unknown_images, "texture is left out: its image is of an unknown format",
            "textures are left out: their images are of unknown formats");
}

#include "cli/picture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"

static aur_result select_channels(const char *path, const char *channels, aur_image **image,
                                  aur_error *error) {
    size_t count = 1;
    for (const char *c = channels; *c != '\0'; ++c)
        count += *c == ',';
    char *const copy = strdup(channels);
    const char **const names = calloc(count, sizeof *names);
    aur_result result = AUR_ERROR_MEMORY;
    *error = (aur_error){.result = result};
    if (copy != NULL && names != NULL) {
        char *rest = copy;
        for (size_t i = 0; i < count; ++i) {
            names[i] = rest;
            rest += strcspn(rest, ",");
            *rest++ = '\0';
        }
        aur_image *selected;
        result = aur_image_select(*image, count, names, &selected, error);
        snprintf(error->file, sizeof error->file, "%s", path);
        if (result == AUR_OK) {
            aur_image_destroy(*image);
            *image = selected;
        }
    }
    free(names);
    free(copy);
    return result;
}

int cli_read_picture(const char *path, const char *channels, aur_image **image) {
    aur_error error;
    aur_result result = aur_image_read(path, image, &error);
    if (result == AUR_OK && channels != NULL)
        result = select_channels(path, channels, image, &error);
    return result == AUR_OK ? CLI_SUCCESS : cli_fail(&error);
}

/* The table of textures, and making them by name. */
#include <stdlib.h>
#include <string.h>

#include "material/texture.h"

extern const aur_texture_descriptor aur_texture_bitmap;
extern const aur_texture_descriptor aur_texture_checkerboard;

static const aur_texture_descriptor *const table[] = {
    &aur_texture_bitmap,
    &aur_texture_checkerboard,
};

enum { TABLE_SIZE = sizeof table / sizeof table[0] };

aur_result aur_texture_create(aur_parameters *parameters, aur_texture **texture, aur_error *error) {
    *texture = NULL;
    const aur_texture_descriptor *descriptor = NULL;
    const char *names[TABLE_SIZE];
    for (size_t i = 0; i < TABLE_SIZE; ++i) {
        names[i] = table[i]->name;
        if (strcmp(names[i], parameters->plugin) == 0)
            descriptor = table[i];
    }
    if (descriptor == NULL)
        return aur_fail_unknown_plugin(error, parameters, TABLE_SIZE, names);
    aur_texture *const made = calloc(1, sizeof *made);
    if (made == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_MEMORY, "out of memory");
    made->descriptor = descriptor;
    aur_result result = descriptor->create(parameters, made, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(parameters, error);
    if (result != AUR_OK) {
        aur_texture_destroy(made);
        return result;
    }
    *texture = made;
    return AUR_OK;
}

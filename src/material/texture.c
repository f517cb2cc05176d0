#include "material/texture.h"

#include <stdlib.h>
#include <string.h>

static const aur_texture_descriptor *const table[] = {NULL};

const aur_texture_descriptor *aur_texture_descriptor_at(size_t index) {
    return index < sizeof table / sizeof table[0] ? table[index] : NULL;
}

static aur_result fail_unknown(const aur_parameters *parameters, aur_error *error) {
    const char *names[sizeof table / sizeof table[0]] = {NULL};
    size_t count = 0;
    for (; aur_texture_descriptor_at(count) != NULL; ++count)
        names[count] = aur_texture_descriptor_at(count)->name;
    return aur_fail_unknown_plugin(error, parameters, count, names);
}

aur_result aur_texture_create(aur_parameters *parameters, aur_texture **texture, aur_error *error) {
    *texture = NULL;
    const aur_texture_descriptor *descriptor = NULL;
    for (size_t i = 0; descriptor == NULL && aur_texture_descriptor_at(i) != NULL; ++i)
        if (strcmp(aur_texture_descriptor_at(i)->name, parameters->plugin) == 0)
            descriptor = aur_texture_descriptor_at(i);
    if (descriptor == NULL)
        return fail_unknown(parameters, error);
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

void aur_texture_destroy(aur_texture *texture) {
    if (texture == NULL)
        return;
    if (texture->data != NULL)
        texture->descriptor->release(texture);
    free(texture);
}

aur_result aur_parameters_color(aur_parameters *parameters, const char *name, double maximum,
                                aur_color *color, aur_error *error) {
    const aur_parameter *const item = aur_parameters_find(parameters, name);
    if (item == NULL)
        return AUR_OK;
    if (item->kind == AUR_PARAMETER_OBJECT && strcmp(item->object_kind, "texture") == 0) {
        const aur_texture *const texture = item->object;
        if (texture->maximum > maximum)
            return aur_fail_at(error, item->location, AUR_ERROR_FORMAT,
                               "%s '%s': '%s' must be at most %g, but the texture reaches %g",
                               parameters->kind, parameters->plugin, name, maximum, (double)texture->maximum);
        *color = (aur_color){.texture = texture};
        return AUR_OK;
    }
    double value[3];
    const aur_result result = aur_parameters_triple(parameters, name, 0.0, maximum, value, error);
    if (result == AUR_OK)
        *color = (aur_color){{(float)value[0], (float)value[1], (float)value[2]}, NULL};
    return result;
}

/* Every light by name. One new light is one new file and one line here. */
#include <stdlib.h>
#include <string.h>

#include "scene/emitter.h"

extern const aur_emitter_descriptor aur_emitter_area;
extern const aur_emitter_descriptor aur_emitter_point;
extern const aur_emitter_descriptor aur_emitter_spot;
extern const aur_emitter_descriptor aur_emitter_directional;
extern const aur_emitter_descriptor aur_emitter_constant;
extern const aur_emitter_descriptor aur_emitter_envmap;

static const aur_emitter_descriptor *const table[] = {
    &aur_emitter_area,        &aur_emitter_point,    &aur_emitter_spot,
    &aur_emitter_directional, &aur_emitter_constant, &aur_emitter_envmap,
};

enum { TABLE_SIZE = sizeof table / sizeof table[0] };

const aur_emitter_descriptor *aur_emitter_descriptor_at(size_t index) {
    return index < TABLE_SIZE ? table[index] : NULL;
}

aur_result aur_emitter_create(aur_parameters *parameters, aur_emitter **emitter, aur_error *error) {
    *emitter = NULL;
    const aur_emitter_descriptor *descriptor = NULL;
    const char *names[TABLE_SIZE];
    for (size_t i = 0; i < TABLE_SIZE; ++i) {
        names[i] = table[i]->name;
        if (strcmp(names[i], parameters->plugin) == 0)
            descriptor = table[i];
    }
    if (descriptor == NULL)
        return aur_fail_unknown_plugin(error, parameters, TABLE_SIZE, names);
    aur_emitter *const made = calloc(1, sizeof *made);
    if (made == NULL)
        return aur_fail_at(error, parameters->location, AUR_ERROR_MEMORY, "out of memory");
    made->descriptor = descriptor;
    made->location = parameters->location;
    made->shape = UINT32_MAX;
    aur_result result = descriptor->create(parameters, made, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(parameters, error);
    if (result != AUR_OK) {
        aur_emitter_destroy(made);
        return result;
    }
    *emitter = made;
    return AUR_OK;
}

void aur_emitter_destroy(aur_emitter *emitter) {
    if (emitter == NULL)
        return;
    if (emitter->data != NULL)
        emitter->descriptor->release(emitter);
    free(emitter);
}

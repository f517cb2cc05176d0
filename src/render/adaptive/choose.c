#include "render/adaptive/choose.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Integrators that look at a scene in their own way: another one would make another picture. */
static bool has_its_own_picture(const char *name) {
    static const char *const names[] = {"ao", "direct", "radiosity", "depth", "aov"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i)
        if (strcmp(name, names[i]) == 0)
            return true;
    return false;
}

static const char *depth_of(const aur_parameters *parameters) {
    for (size_t i = 0; i < parameters->count; ++i)
        if (strcmp(parameters->items[i].name, "max_depth") == 0)
            return parameters->items[i].text;
    return NULL;
}

aur_result aur_adaptive_choose(const aur_scene *scene, const char *wanted, char **integrator, bool *open,
                               aur_error *error) {
    const aur_parameters *const own = aur_scene_integrator(scene);
    *integrator = NULL;
    *open = false;
    if (wanted == NULL && has_its_own_picture(own->plugin))
        return AUR_OK;
    *open = wanted == NULL && !aur_scene_has_media(scene);
    const char *const depth = wanted == NULL ? depth_of(own) : NULL;
    const char *const text = wanted != NULL ? wanted : aur_scene_has_media(scene) ? "volpath" : "path";
    const char *const key = depth != NULL ? ":max_depth=" : "";
    const char *const more = depth != NULL ? depth : "";
    const size_t capacity = strlen(text) + strlen(key) + strlen(more) + 1;
    *integrator = malloc(capacity);
    if (*integrator == NULL)
        return aur_fail_memory(error);
    snprintf(*integrator, capacity, "%s%s%s", text, key, more);
    return AUR_OK;
}

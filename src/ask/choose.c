#include "ask/choose.h"

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

aur_result aur_ask_choose(const aur_scene *scene, const char *wanted, char **integrator, aur_error *error) {
    const aur_parameters *const own = aur_scene_integrator(scene);
    *integrator = NULL;
    if (wanted == NULL && has_its_own_picture(own->plugin))
        return AUR_OK;
    const char *const depth = wanted == NULL ? depth_of(own) : NULL;
    char text[64];
    if (depth != NULL)
        snprintf(text, sizeof text, "path:max_depth=%s", depth);
    *integrator = strdup(wanted != NULL ? wanted : depth != NULL ? text : "path");
    return *integrator != NULL ? AUR_OK : aur_fail_memory(error);
}

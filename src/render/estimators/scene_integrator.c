/* The integrator by which an image to a target is rendered, in place of the scene's. */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "points/base/error.h"
#include "points/base/text.h"
#include "render/film/integrator.h"

/* Whether no other integrator gives the scene's image. Light tracing without mirrors has a key for that. */
static bool has_own_image(const aur_scene *scene) {
    const char *const plugin = aur_scene_integrator(scene)->plugin;
    const char *const mirrors = aur_scene_integrator_key(scene, "specular_paths");
    for (size_t i = 0; i < aur_integrator_table.count; ++i) {
        const aur_row *const row = aur_integrator_table.rows[i];
        if (strcmp(row->name, plugin) == 0 && ((const aur_integrator_descriptor *)row)->own_image)
            return true;
    }
    return mirrors != NULL && strcasecmp(mirrors, "false") == 0;
}

/* Texts of one value: 0, 0.0; false, False. */
static bool is_same(const char *a, const char *b) {
    char *end_a, *end_b;
    const bool equal = strtod(a, &end_a) == strtod(b, &end_b);
    return strcasecmp(a, b) == 0 || (equal && end_a != a && end_b != b && *end_a == '\0' && *end_b == '\0');
}

aur_result aur_integrator_of_scene(const aur_scene *scene, const char *requested, char **integrator,
                                   bool *open, aur_error *error) {
    /* Keys of the scene's integrator on which the image depends; what final gathering has not, keeps it out.
     */
    static const struct {
        const char *name, *unset;
        bool gathers;
    } keys[] = {{"max_depth", "", true}, {"hide_emitters", "false", false}, {"clamp", "0", false}};
    *integrator = NULL;
    *open = false;
    if (requested == NULL && has_own_image(scene))
        return AUR_OK;
    const bool media = aur_scene_has_media(scene);
    bool first = true;
    *open = requested == NULL && !media;
    *integrator = aur_new_text("%s", requested != NULL ? requested : media ? "volpath" : "path");
    for (size_t i = 0; i < sizeof keys / sizeof keys[0] && requested == NULL && *integrator != NULL; ++i) {
        const char *const value = aur_scene_integrator_key(scene, keys[i].name);
        if (value == NULL || is_same(value, keys[i].unset))
            continue;
        char *const longer = aur_new_text("%s%s%s=%s", *integrator, first ? ":" : ",", keys[i].name, value);
        free(*integrator);
        *integrator = longer;
        *open = *open && keys[i].gathers;
        first = false;
    }
    return *integrator != NULL ? AUR_OK : aur_fail_memory(error);
}

/* What the harnesses of scenes and meshes share. */
#ifndef AUR_FUZZ_SCENE_CHECK_H
#define AUR_FUZZ_SCENE_CHECK_H

#include <aureole/scene.h>
#include <math.h>

#include "fuzz.h"

/* Loads a scene: either it is whole, or the error says what is wrong and in which file. */
static inline void fuzz_load_scene(const char *path) {
    aur_scene *scene;
    aur_error error = {0};
    const aur_result result = aur_scene_load(path, NULL, &scene, &error);
    if (result != AUR_OK) {
        fuzz_require(scene == NULL, "a failed load left a scene");
        fuzz_require(error.message[0] != '\0', "a failure without a message");
        fuzz_require(result != AUR_ERROR_INTERNAL, error.message);
        return;
    }
    aur_scene_description description;
    aur_scene_describe(scene, &description);
    for (size_t i = 0; i < 3 && description.shapes > 0; ++i)
        fuzz_require(isfinite(description.lower[i]) && isfinite(description.upper[i]), "an infinite scene");
    aur_scene_destroy(scene);
}

/* A scene with the mesh file and nothing else. */
static inline void fuzz_load_mesh(const char *plugin, const char *path, const uint8_t *data, size_t size) {
    static int written;
    char scene[64];
    snprintf(scene, sizeof scene, "fuzz-%s.xml", plugin);
    if (!written) {
        char text[256];
        const int length = snprintf(text, sizeof text,
                                    "<scene version=\"3.0.0\"><shape type=\"%s\"><string name=\"filename\" "
                                    "value=\"%s\"/></shape></scene>",
                                    plugin, path);
        fuzz_write_file(scene, (const uint8_t *)text, (size_t)length);
        written = 1;
    }
    fuzz_write_file(path, data, size);
    fuzz_load_scene(scene);
}

#endif

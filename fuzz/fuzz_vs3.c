/* View3D input files. */
#include <string.h>

#include "fuzz.h"
#include "lighting/viewfactors/facets.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_error error = {0};
    aur_vs3 scene;
    const aur_result result = aur_vs3_parse("input.vs3", size, (const char *)data, &scene, &error);
    if (result != AUR_OK) {
        fuzz_require((error.result == AUR_ERROR_FORMAT || error.result == AUR_ERROR_UNSUPPORTED) &&
                         error.message[0] != '\0' && scene.text == NULL,
                     "a failure of the wrong kind, or without a message");
        return 0;
    }
    fuzz_require(scene.group_count > 0 && scene.group_count <= scene.shape_count &&
                     scene.shape_count == scene.name_count && strlen(scene.text) == scene.length,
                 "other numbers of surfaces");
    for (size_t i = 0; i < scene.shape_count; ++i)
        fuzz_require(scene.groups[i] < scene.group_count, "a surface of no group");
    aur_vs3_release(&scene);
    return 0;
}

static const char *const seeds[] = {
    "T two ! here\nC encl=0\nF 3\nV 1 0 0 0\nV 2 1, 0, 0\nV 3 1 1 0\nV 4 0 1 0\nS 1 1 2 3 4 0 0 .5 lower\n"
    "S 2 1 2 3 0 1 0 .9 window\nS 3 2 3 4 0 0 1 1e-3\nEnd of data\n",
    "f 3a\n",
    "v 1 1e300 -1 .5\ns 1 1 1 1 0\n",
    "O 1 1 1 1 1\n",
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    return fuzz_text_seed(sizeof seeds / sizeof seeds[0], seeds, index, capacity, data);
}

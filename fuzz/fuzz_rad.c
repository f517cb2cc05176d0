/* Radiance's scene descriptions. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "render/scene/importers/rad/rad.h"
#include "render/scene/scene_data.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_error error = {0};
    aur_scene *scene = NULL;
    const aur_result result = aur_scene_load_memory("input.rad", size, data, NULL, &scene, &error);
    if (result != AUR_OK) {
        fuzz_require(error.result == result && error.message[0] != '\0', "a failure without a message");
        fuzz_require(result != AUR_ERROR_INTERNAL && result != AUR_ERROR_ARGUMENT,
                     "a failure of the wrong kind");
    }
    aur_scene_destroy(scene);
    return 0;
}

static const char *const seeds[] = {
    "# a room\nvoid plastic a\n0\n0\n5 .5 .5 .5 0 0\nvoid glass g 0 0 4 .9 .9 .9 1.5\nvoid alias b a\n"
    "b polygon f\n0 0 12 0 0 0 1 0 0 1 1 0 0 1 0\nb polygon l 0 0 18 0 0 1 2 0 1 2 1 1 1 1 1 1 2 1 0 2 1\n"
    "g sphere s 0 0 4 1 2 3 .5\na bubble u 0 0 4 1 2 3 -5\n",
    "void light l 0 0 3 1 2 3\nvoid glow g 0 0 4 1 1 1 0\nl ring r 0 0 8 0 0 2 0 0 -1 0 1\n"
    "l source s 0 0 4 0 0 1 .533\ng source d 0 0 4 0 0 1 180\nl tube t 0 0 7 0 0 0 1 1 1 .5\n"
    "l mesh m 1 a&b$.obj 0 0\n!xform a.rad\n",
};

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    if (index >= sizeof seeds / sizeof seeds[0])
        return 0;
    const size_t size = strlen(seeds[index]);
    fuzz_require(size <= capacity, "a seed is too large");
    memcpy(data, seeds[index], size);
    return size;
}

/* Wavefront OBJ. */
#include "scene_check.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_load_mesh("obj", "fuzz-mesh.obj", data, size);
    return 0;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    static const char *const texts[] = {
        "# a square\nmtllib x.mtl\no square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\ng a\nusemtl b\ns off\n"
        "f 1/1/1 2/2/1 3/3/1\nf -3/-3 -2/-2 -1/-1\nf 1//1 2//1 3//1\n",
        "v 0.5e-3 1 2 1\r\nv 1. .5 -0\r\nv 0 \\\n 1 0\r\nf 1 2 3\r\n",
    };
    return fuzz_text_seed(sizeof texts / sizeof texts[0], texts, index, capacity, data);
}

/* Stanford PLY: ascii and both binary forms. */
#include "scene_check.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_load_mesh("ply", "fuzz-mesh.ply", data, size);
    return 0;
}

/* A triangle with normals, and a quadrilateral, in the byte order given. */
static size_t binary_seed(int big, size_t capacity, uint8_t *data) {
    const int length =
        snprintf((char *)data, capacity,
                 "ply\nformat binary_%s_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                 "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n",
                 big ? "big" : "little");
    uint32_t words[12 + 9];
    static const float positions[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const uint32_t faces[7] = {0, 1, 2, 0, 1, 2, 3};
    size_t used = (size_t)length;
    fuzz_require(used + sizeof words < capacity, "a seed is too long");
    memcpy(words, positions, sizeof positions);
    memcpy(words + 12, faces, sizeof faces);
    for (size_t i = 0; i < 12 + 7; ++i) {
        if (i == 12 || i == 15)
            data[used++] = i == 12 ? 3 : 4;
        for (size_t b = 0; b < 4; ++b)
            data[used++] = (uint8_t)(words[i] >> 8 * (big ? 3 - b : b));
    }
    return used;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    static const char *const texts[] = {
        "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 "
        "2\n",
        "ply\r\nformat ascii 1.0\r\nelement vertex 4\r\nproperty double x\r\nproperty double y\r\n"
        "property double z\r\nproperty float u\r\nproperty float v\r\nelement face 1\r\n"
        "property list uint8 uint32 vertex_index\r\nelement edge 0\r\nproperty int a\r\nend_header\r\n"
        "0 0 0 0 0\r\n1 0 0 1 0\r\n1 1 0 1 1\r\n0 1 0 0 1\r\n4 0 1 2 3\r\n",
    };
    if (index == 2 || index == 3)
        return binary_seed(index == 3, capacity, data);
    return fuzz_text_seed(2, texts, index, capacity, data);
}

/* Mitsuba's serialized meshes. */
#include <zlib.h>

#include "scene_check.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_load_mesh("serialized", "fuzz-mesh.serialized", data, size);
    return 0;
}

typedef struct bytes {
    size_t size;
    uint8_t data[512];
} bytes;

static void put(bytes *to, const void *data, size_t size) {
    memcpy(to->data + to->size, data, size);
    to->size += size;
}

static void put_word(bytes *to, uint64_t value, size_t width) {
    for (size_t i = 0; i < width; ++i) {
        const uint8_t byte = (uint8_t)(value >> 8 * i);
        put(to, &byte, 1);
    }
}

/* Version 4: magic 0x041c; deflated flags, name, counts, positions, indices; then the dictionary. Or the same
 * with the deflate's stored blocks (level 0), whose content mutations reach. */
static size_t mesh_seed(int level, size_t capacity, uint8_t *data) {
    static const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    bytes plain = {0};
    put_word(&plain, 0x1000, 4); /* single precision, no normals */
    put(&plain, "mesh", 5);
    put_word(&plain, 3, 8);
    put_word(&plain, 1, 8);
    put(&plain, positions, sizeof positions);
    for (uint64_t i = 0; i < 3; ++i)
        put_word(&plain, i, 4);
    uLongf length = (uLongf)(capacity - 64);
    fuzz_require(compress2(data + 4, &length, plain.data, plain.size, level) == Z_OK, "zlib");
    bytes frame = {0};
    put_word(&frame, 0x041c, 2);
    put_word(&frame, 4, 2);
    memcpy(data, frame.data, 4);
    frame.size = 0;
    put_word(&frame, 0, 8); /* the mesh begins here */
    put_word(&frame, 1, 4); /* one mesh */
    memcpy(data + 4 + length, frame.data, frame.size);
    return 4 + length + frame.size;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    return index < 2 ? mesh_seed(index == 0 ? 0 : 6, capacity, data) : 0;
}

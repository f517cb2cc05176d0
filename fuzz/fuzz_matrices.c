/* Generator matrices of digital nets, as text. */
#include <aureole/pointset.h>

#include "fuzz.h"

enum { COUNT = 8 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    aur_error error = {0};
    aur_pointset *points = NULL;
    fuzz_write_file("fuzz-matrices", data, size);
    const aur_pointset_options options = {.size = sizeof options, .count = COUNT, .dimension = 2};
    const aur_result result = aur_pointset_create("matrices:file=fuzz-matrices", &options, &points, &error);
    if (result != AUR_OK) {
        fuzz_require(error.message[0] != '\0', "a failure without a message");
        fuzz_require(result != AUR_ERROR_INTERNAL && result != AUR_ERROR_OPEN, "a failure of the wrong kind");
        return 0;
    }
    double coordinates[2 * COUNT];
    fuzz_require(aur_pointset_points(points, 0, COUNT, 2 * COUNT, coordinates, NULL) == AUR_OK, "no points");
    for (size_t i = 0; i < 2 * COUNT; ++i)
        fuzz_require(coordinates[i] >= 0.0 && coordinates[i] < 1.0, "a point outside the square");
    aur_pointset_destroy(points);
    return 0;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    static const char *const texts[] = {
        "100\n010\n001\n\n111\n010\n011\n",
        "base 3\n# the first\n1 0\n0 1\n\n# the second\n1 2\n0 1\n",
        "base 11\n10 0 3\n0 1 0\n0 0 1\n\n1 1 1\n0 10 2\n0 0 1\n",
    };
    return fuzz_text_seed(sizeof texts / sizeof texts[0], texts, index, capacity, data);
}

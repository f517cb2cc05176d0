/* The names of sets, NAME[:key=value[,key=value...]]: input from command lines, scenes and callers. */
#include <aureole/sphere.h>

#include "fuzz.h"

enum { COUNT = 16, TEXT_CAPACITY = 512 };

static void require_error(aur_result result, const aur_error *error) {
    fuzz_require(error->message[0] != '\0' && error->result == result, "a failure without a message");
    fuzz_require(result != AUR_ERROR_INTERNAL, "a failure of the wrong kind");
}

static void try_square(const char *set) {
    aur_error error = {0};
    aur_pointset *points = NULL;
    const aur_pointset_options options = {.size = sizeof options, .count = COUNT, .dimension = 2};
    const aur_result result = aur_pointset_create(set, &options, &points, &error);
    if (result != AUR_OK) {
        require_error(result, &error);
        return;
    }
    double coordinates[2 * COUNT];
    const size_t size = aur_pointset_size(points) < COUNT ? (size_t)aur_pointset_size(points) : COUNT;
    fuzz_require(aur_pointset_points(points, 0, size, 2 * COUNT, coordinates, NULL) == AUR_OK, "no points");
    for (size_t i = 0; i < 2 * size; ++i)
        fuzz_require(coordinates[i] >= 0.0 && coordinates[i] < 1.0, "a point outside the square");
    aur_pointset_destroy(points);
}

static void try_sphere(const char *set) {
    aur_error error = {0};
    aur_directions *directions = NULL;
    const aur_directions_options options = {
        .size = sizeof options, .count = COUNT, .domain = AUR_DOMAIN_SPHERE};
    const aur_result result = aur_directions_create(set, &options, &directions, &error);
    if (result != AUR_OK) {
        require_error(result, &error);
        return;
    }
    double xyz[3 * COUNT];
    const size_t size =
        aur_directions_size(directions) < COUNT ? (size_t)aur_directions_size(directions) : COUNT;
    fuzz_require(aur_directions_points(directions, 0, size, 3 * COUNT, xyz, NULL, NULL) == AUR_OK,
                 "no directions");
    for (size_t i = 0; i < size; ++i) {
        const double *const d = xyz + 3 * i;
        const double length2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        fuzz_require(length2 > 1.0 - 1e-5 && length2 < 1.0 + 1e-5, "a direction that is not of unit length");
    }
    aur_directions_destroy(directions);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char text[TEXT_CAPACITY];
    if (size >= sizeof text || memchr(data, '/', size) != NULL) /* no paths */
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    try_square(text);
    try_sphere(text);
    return 0;
}

size_t aur_fuzz_seed(size_t index, size_t capacity, uint8_t *data) {
    static const char *const texts[] = {"random",
                                        "lcg",
                                        "icg",
                                        "jittered",
                                        "van-der-corput",
                                        "halton:permute=random",
                                        "hammersley",
                                        "faure:base=3,scramble=lower-triangular",
                                        "sobol",
                                        "niederreiter",
                                        "larcher-pillichshammer",
                                        "fibonacci-lattice",
                                        "rank1:vector=1;5;9",
                                        "r2",
                                        "golden",
                                        "golden-set:form=two-seeds,seed=0.25",
                                        "spherical-fibonacci:offset=0.5",
                                        "esfg:base=4,levels=2,first-shift=best,shift=per-level,progression=2",
                                        "file:missing.csv",
                                        "matrices:file=missing.txt"};
    return fuzz_text_seed(sizeof texts / sizeof texts[0], texts, index, capacity, data);
}

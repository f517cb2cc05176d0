/* Rotations from any set: native rotations are used unchanged, points of the cube are lifted. */
#include <stdlib.h>

#include <aureole/rotations.h>

#include "points/base/error.h"
#include "points/base/simd.h"
#include "points/pointset/points.h"
#include "points/pointset/set.h"
#include "points/sphere/map.h"
#include "points/sphere/native.h"
#include "points/sphere/rotations/hopf.h"

enum { CHUNK = 256 };

struct aur_rotations {
    uint64_t size;
    const aur_native_set *native; /* NULL: of the cube */
    void *native_data;
    aur_pointset *cube;
    bool turned;
    double turn[4];
};

static aur_result open_set(const char *set, const aur_rotations_options *options, aur_rotations *rotations,
                           aur_error *error) {
    aur_result result = aur_set_check_name(set, error);
    if (result != AUR_OK && !aur_set_is_user(set))
        return result;
    rotations->turned = options->scramble == AUR_SCRAMBLE_ROTATE3D;
    const aur_scramble scramble = rotations->turned ? AUR_SCRAMBLE_NONE : options->scramble;
    aur_quaternion_uniform(options->seed, rotations->turn);
    rotations->size = options->count;
    rotations->native = aur_native_find(set);
    const aur_native_request request = {AUR_DOMAIN_ROTATIONS, options->count, 0.0, &options->warnings};
    if (rotations->native != NULL && scramble != AUR_SCRAMBLE_NONE)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "set '%s': scrambling '%s' has no meaning for rotations: use rotate3d", set,
                        aur_scramble_name(scramble) != NULL ? aur_scramble_name(scramble) : "?");
    if (rotations->native != NULL)
        return aur_native_open(rotations->native, set, &request, &rotations->native_data, error);
    const aur_pointset_options requested = {.size = sizeof requested,
                                            .count = options->count,
                                            .dimension = 3,
                                            .scramble = scramble,
                                            .seed = options->seed,
                                            .warnings = options->warnings};
    result = aur_pointset_create(set, &requested, &rotations->cube, error);
    if (result != AUR_OK)
        return result;
    rotations->size = aur_pointset_size(rotations->cube);
    if (aur_pointset_dimension(rotations->cube) == 3)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_ARGUMENT, "rotations are made of three coordinates, and '%s' has %zu",
                    set, aur_pointset_dimension(rotations->cube));
}

aur_result aur_rotations_create(const char *set, const aur_rotations_options *options,
                                aur_rotations **rotations, aur_error *error) {
    *rotations = NULL;
    aur_rotations_options copy = {.size = sizeof copy};
    aur_rotations_options_init(0, &copy, NULL);
    aur_result result = aur_options_read(options, sizeof copy, &copy, "aur_rotations_options", error);
    if (result != AUR_OK)
        return result;
    aur_rotations *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    result = open_set(set, &copy, created, error);
    if (result == AUR_OK)
        *rotations = created;
    else
        aur_rotations_destroy(created);
    return result;
}

void aur_rotations_destroy(aur_rotations *rotations) {
    if (rotations == NULL)
        return;
    aur_pointset_destroy(rotations->cube);
    free(rotations->native_data);
    free(rotations);
}

uint64_t aur_rotations_size(const aur_rotations *rotations) {
    return rotations->size;
}

aur_result aur_rotations_points(const aur_rotations *rotations, uint64_t first, size_t count, size_t capacity,
                                double *wxyz, aur_error *error) {
    aur_strides strides;
    aur_result result = aur_check_range(rotations->size, first, count, error);
    if (result == AUR_OK)
        result =
            aur_output_open(&(aur_output){.capacity = capacity, .doubles = wxyz}, 4, count, &strides, error);
    if (result == AUR_OK && rotations->native != NULL)
        rotations->native->fill(rotations->native_data, first, count, wxyz);
    double cube[3 * CHUNK];
    for (size_t done = 0; done < count && rotations->cube != NULL && result == AUR_OK; done += CHUNK) {
        const size_t part = count - done < CHUNK ? count - done : CHUNK;
        result = aur_pointset_points(rotations->cube, first + done, part, 3 * CHUNK, cube, error);
        if (result == AUR_OK)
            AUR_KERNEL_HERE(aur_hopf).lift(part, cube, wxyz + 4 * done);
    }
    for (size_t i = 0; i < count && rotations->turned && result == AUR_OK; ++i)
        aur_quaternion_multiply(rotations->turn, wxyz + 4 * i, wxyz + 4 * i);
    return result;
}

aur_result aur_rotations_options_init(uint64_t count, aur_rotations_options *options, aur_error *error) {
    static const aur_rotations_options defaults = {.size = sizeof defaults};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, options, "aur_rotations_options", error);
    if (result == AUR_OK)
        options->count = count;
    return result;
}

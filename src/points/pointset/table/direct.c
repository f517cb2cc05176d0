/* The direct generators: a set on the stack, with the generator's own data where it needs any. */
#include <math.h>

#include "points/pointset/generators/golden.h"
#include "points/pointset/sets.h"

/* `size` 0 stands for as many points as the set has at most. */
static aur_result emit(aur_pointset set, const aur_randomization *randomization, uint64_t first, size_t count,
                       const aur_output *output, aur_error *error) {
    if (randomization != NULL) {
        set.scramble = randomization->scramble;
        set.seed = randomization->seed;
    }
    if (set.size == 0)
        set.size = aur_size_limit(&set.kind->description, set.dimension);
    const aur_result result = aur_pointset_check(&set, error);
    return result != AUR_OK ? result : aur_pointset_emit(&set, set.seed, first, count, output, error);
}

static aur_result check_dimension(size_t dimension, size_t maximum, aur_error *error) {
    return dimension > 0 && dimension <= maximum
               ? AUR_OK
               : aur_fail(error, AUR_ERROR_ARGUMENT, "there are 1 to %zu dimensions, not %zu", maximum,
                          dimension);
}

/* A set of a given size. */
static aur_result emit_sized(aur_pointset set, uint64_t size, const aur_randomization *randomization,
                             uint64_t first, size_t count, const aur_output *output, aur_error *error) {
    if (size == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the number of points must be at least 1");
    set.size = size;
    return emit(set, randomization, first, count, output, error);
}

aur_result aur_random_points(size_t dimension, uint64_t seed, uint64_t first, size_t count,
                             const aur_output *output, aur_error *error) {
    const aur_pointset set = {.kind = &aur_set_random, .dimension = dimension, .seed = seed};
    return emit(set, NULL, first, count, output, error);
}

aur_result aur_lcg_points(size_t dimension, uint64_t seed, uint64_t first, size_t count,
                          const aur_output *output, aur_error *error) {
    const aur_pointset set = {.kind = &aur_set_lcg, .dimension = dimension, .seed = seed};
    return emit(set, NULL, first, count, output, error);
}

aur_result aur_icg_points(size_t dimension, uint64_t seed, uint64_t first, size_t count,
                          const aur_output *output, aur_error *error) {
    const aur_pointset set = {.kind = &aur_set_icg, .dimension = dimension, .seed = seed};
    return emit(set, NULL, first, count, output, error);
}

aur_result aur_jittered_points(uint64_t size, uint64_t seed, uint64_t first, size_t count,
                               const aur_output *output, aur_error *error) {
    const aur_pointset set = {.kind = &aur_set_jittered, .dimension = 2, .seed = seed};
    return emit_sized(set, size, NULL, first, count, output, error);
}

aur_result aur_van_der_corput_points(const aur_randomization *randomization, uint64_t first, size_t count,
                                     const aur_output *output, aur_error *error) {
    const aur_pointset set = {.kind = &aur_set_van_der_corput, .dimension = 1};
    return emit(set, randomization, first, count, output, error);
}

aur_result aur_halton_points(size_t dimension, const aur_randomization *randomization, uint64_t first,
                             size_t count, const aur_output *output, aur_error *error) {
    const aur_pointset set = {.kind = &aur_set_halton, .dimension = dimension};
    return emit(set, randomization, first, count, output, error);
}

aur_result aur_hammersley_points(size_t dimension, uint64_t size, const aur_randomization *randomization,
                                 uint64_t first, size_t count, const aur_output *output, aur_error *error) {
    const aur_pointset set = {.kind = &aur_set_hammersley, .dimension = dimension};
    return emit_sized(set, size, randomization, first, count, output, error);
}

aur_result aur_sobol_points(size_t dimension, const aur_randomization *randomization, uint64_t first,
                            size_t count, const aur_output *output, aur_error *error) {
    const aur_pointset set = {.kind = &aur_set_sobol, .dimension = dimension};
    return emit(set, randomization, first, count, output, error);
}

aur_result aur_niederreiter_points(size_t dimension, const aur_randomization *randomization, uint64_t first,
                                   size_t count, const aur_output *output, aur_error *error) {
    const aur_pointset set = {.kind = &aur_set_niederreiter, .dimension = dimension};
    return emit(set, randomization, first, count, output, error);
}

aur_result aur_larcher_pillichshammer_points(uint64_t size, const aur_randomization *randomization,
                                             uint64_t first, size_t count, const aur_output *output,
                                             aur_error *error) {
    const aur_pointset set = {.kind = &aur_set_larcher_pillichshammer, .dimension = 2};
    return emit_sized(set, size, randomization, first, count, output, error);
}

aur_result aur_fibonacci_lattice_points(uint64_t size, double offset, const aur_randomization *randomization,
                                        uint64_t first, size_t count, const aur_output *output,
                                        aur_error *error) {
    if (!(offset >= 0.0 && offset < 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the offset must be at least 0 and below 1, not %g",
                        offset);
    aur_lattice lattice;
    aur_lattice_make_fibonacci(size, offset, &lattice);
    const aur_pointset set = {.kind = &aur_set_fibonacci_lattice, .dimension = 2, .data = &lattice};
    return emit_sized(set, size, randomization, first, count, output, error);
}

aur_result aur_rank1_points(size_t dimension, const uint64_t *vector, uint64_t size,
                            const aur_randomization *randomization, uint64_t first, size_t count,
                            const aur_output *output, aur_error *error) {
    const aur_result result = check_dimension(dimension, AUR_LATTICE_CAPACITY, error);
    if (result != AUR_OK)
        return result;
    aur_lattice lattice = {0};
    for (size_t d = 0; d < dimension; ++d) {
        if (vector[d] >= AUR_INDEX_LIMIT)
            return aur_fail(error, AUR_ERROR_ARGUMENT, "element %zu of the vector must be below 2^48", d);
        lattice.vector[d] = vector[d];
    }
    const aur_pointset set = {.kind = &aur_set_rank1, .dimension = dimension, .data = &lattice};
    return emit_sized(set, size, randomization, first, count, output, error);
}

aur_result aur_r2_points(size_t dimension, const aur_randomization *randomization, uint64_t first,
                         size_t count, const aur_output *output, aur_error *error) {
    const aur_result result = check_dimension(dimension, AUR_R2_DIMENSIONS, error);
    if (result != AUR_OK)
        return result;
    aur_recurrence recurrence;
    aur_recurrence_r2(dimension, &recurrence);
    const aur_pointset set = {.kind = &aur_set_r2, .dimension = dimension, .data = &recurrence};
    return emit(set, randomization, first, count, output, error);
}

aur_result aur_golden_points(double s, const aur_randomization *randomization, uint64_t first, size_t count,
                             const aur_output *output, aur_error *error) {
    if (!(s >= 0.0 && s < 1.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the start must be at least 0 and below 1, not %g", s);
    aur_recurrence recurrence;
    aur_recurrence_golden(s, &recurrence);
    const aur_pointset set = {.kind = &aur_set_golden, .dimension = 1, .data = &recurrence};
    return emit(set, randomization, first, count, output, error);
}

/* What all sets of the square have in common: scramblings, limits, and filling blocks. */
#include "pointset/set.h"

#include <inttypes.h>

#include "core/names.h"

static const char *const scramble_names[] = {"none", "digit", "owen", "shift", "rotate", "rotate3d"};
enum { SCRAMBLE_COUNT = sizeof scramble_names / sizeof scramble_names[0] };

aur_result aur_scramble_from_name(const char *name, aur_scramble *scramble, aur_error *error) {
    size_t index;
    const aur_result result = aur_names_choose(aur_names_of(SCRAMBLE_COUNT, scramble_names), "scrambling",
                                               name, (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *scramble = (aur_scramble)index;
    return result;
}

const char *aur_scramble_name(aur_scramble scramble) {
    return (size_t)scramble < SCRAMBLE_COUNT ? scramble_names[scramble] : NULL;
}

aur_result aur_pointset_check(const aur_pointset *set, aur_error *error) {
    const aur_square_set *const kind = set->kind;
    const char *const name = kind->description.row.name;
    if (set->size == 0 && !kind->own_size)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s': the number of points must be at least 1", name);
    if (set->size > kind->maximum_size)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has at most %" PRIu64 " points, not %" PRIu64,
                        name, kind->maximum_size, set->size);
    if (set->dimension != kind->minimum_dimension && kind->minimum_dimension == kind->maximum_dimension)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has %zu dimensions, not %zu", name,
                        kind->minimum_dimension, set->dimension);
    if (set->dimension < kind->minimum_dimension || set->dimension > kind->maximum_dimension)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has %zu to %zu dimensions, not %zu", name,
                        kind->minimum_dimension, kind->maximum_dimension, set->dimension);
    const char *const scramble = aur_scramble_name(set->scramble);
    if (scramble == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%d is not a scrambling", (int)set->scramble);
    if (set->scramble == AUR_SCRAMBLE_ROTATE3D)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "rotate3d turns directions; points of the square take rotate or shift");
    if (set->scramble == AUR_SCRAMBLE_ROTATE && set->dimension < 2)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "rotate shifts the second coordinate, and one dimension has none");
    if ((kind->scramblings >> set->scramble & 1u) == 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "set '%s' has no digits to scramble: it takes none, shift or rotate, not %s", name,
                        scramble);
    return AUR_OK;
}

void aur_warn_incomplete_net(const aur_pointset *set, const aur_pointset_options *options, uint64_t base) {
    uint64_t rest = set->size;
    while (rest % base == 0)
        rest /= base;
    if (rest != 1)
        aur_warn_at(&options->warnings, (aur_location){0},
                    "set '%s': %" PRIu64 " points are not a power of %" PRIu64 ", so the net is incomplete",
                    set->kind->description.row.name, set->size, base);
}

void aur_fill_fraction(const aur_pointset *set, const aur_block *block, size_t d) {
    double *const out = block->data + d * block->coordinate_stride;
    if (set->scramble != AUR_SCRAMBLE_DIGIT && set->scramble != AUR_SCRAMBLE_OWEN) {
        /* Below 2^53 a quotient of integers is never rounded up to 1. */
        const double size = (double)set->size;
        for (size_t i = 0; i < block->count; ++i)
            out[i * block->point_stride] = (double)(int64_t)(block->first + i) / size;
        return;
    }
    const uint64_t key = aur_scramble_key(block->seed, block->first_dimension + d);
    for (size_t i = 0; i < block->count; ++i)
        out[i * block->point_stride] =
            aur_scrambled_fraction(set->scramble, block->first + i, set->size, key);
}

void aur_fill_table(const aur_pointset *set, const aur_block *block) {
    const double *const table = set->data;
    for (size_t i = 0; i < block->count; ++i) {
        const double *const point = table + (block->first + i) * set->dimension + block->first_dimension;
        for (size_t d = 0; d < block->dimension_count; ++d)
            block->data[i * block->point_stride + d * block->coordinate_stride] = point[d];
    }
}

/* Adds SHIFT or ROTATE to coordinates that the generator has left without. */
static void shift(const aur_pointset *set, const aur_block *block) {
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t dimension = block->first_dimension + d;
        if (set->scramble == AUR_SCRAMBLE_ROTATE && dimension != 1)
            continue;
        const double offset = aur_word_to_double(aur_scramble_key(block->seed, dimension));
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t i = 0; i < block->count; ++i) {
            const double sum = out[i * block->point_stride] + offset;
            out[i * block->point_stride] = sum < 1.0 ? sum : sum - 1.0;
        }
    }
}

void aur_pointset_fill(const aur_pointset *set, const aur_block *block) {
    set->kind->fill(set, block);
    if (set->scramble == AUR_SCRAMBLE_SHIFT || set->scramble == AUR_SCRAMBLE_ROTATE)
        shift(set, block);
}

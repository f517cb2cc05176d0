/* Common code of all sets of the square: scramblings, limits, and filling blocks. */
#include "points/pointset/set.h"

#include <inttypes.h>
#include <math.h>

#include "points/base/names.h"
#include "points/pointset/runs.h"

static const char *const scramble_names[] = {"none",   "digit",    "owen",  "shift",
                                             "rotate", "rotate3d", "nested"};
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

/* The largest number of points of a set. */
static uint64_t size_limit(const aur_set_description *set, size_t dimension) {
    return set->counts_coordinates && dimension > 0 ? set->maximum_size / dimension : set->maximum_size;
}

aur_result aur_pointset_check(const aur_pointset *set, aur_error *error) {
    const aur_set_description *const kind = &set->kind->description;
    const char *const name = kind->row.name;
    const size_t least = kind->dimensions[0], most = kind->dimensions[1];
    if (set->dimension != least && least == most)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has %zu dimensions, not %zu", name, least,
                        set->dimension);
    if (set->dimension < least || set->dimension > most)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has %zu to %zu dimensions, not %zu", name, least,
                        most, set->dimension);
    if (set->size == 0 && !kind->sized_by_file)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s': the number of points must be at least 1", name);
    const uint64_t limit = size_limit(kind, set->dimension);
    if (set->size > limit)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has at most %" PRIu64 " points, not %" PRIu64,
                        name, limit, set->size);
    const char *const scramble = aur_scramble_name(set->scramble);
    if (scramble == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%d is not a scrambling", (int)set->scramble);
    if (set->scramble == AUR_SCRAMBLE_ROTATE3D)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "rotate3d turns directions; points of the square take rotate or shift");
    if (set->scramble == AUR_SCRAMBLE_ROTATE && set->dimension < 2)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "rotate shifts the second coordinate, and one dimension has none");
    const bool has = (set->kind->scramblings >> set->scramble & 1u) != 0;
    if (!has && set->scramble == AUR_SCRAMBLE_NESTED)
        return aur_fail(
            error, AUR_ERROR_UNSUPPORTED,
            "nested is for sets of binary digits, sobol for one; set '%s' takes none, shift or rotate%s",
            name, (set->kind->scramblings >> AUR_SCRAMBLE_OWEN & 1u) != 0 ? ", digit or owen" : "");
    if (!has)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "set '%s' has no digits to scramble: it takes none, shift or rotate, not %s", name,
                        scramble);
    return AUR_OK;
}

void aur_fill_fraction(const aur_pointset *set, const aur_block *block, size_t d) {
    double *const out = block->data + d * block->coordinate_stride;
    if (!aur_scrambles_digits(set->scramble)) {
        aur_multiples run = {.position = block->first, .step = 1 % set->size, .size = set->size};
        aur_runs(block->count)->multiples(&run, block->count, out);
        return;
    }
    const uint64_t key = aur_scramble_key(block->seed, block->first_dimension + d);
    for (size_t i = 0; i < block->count; ++i)
        out[i] = aur_scrambled_fraction(set->scramble, block->first + i, set->size, key);
}

void aur_fill_table(const aur_pointset *set, const aur_block *block) {
    const double *const table = set->data;
    for (size_t i = 0; i < block->count; ++i) {
        const double *const point = table + (block->first + i) * set->dimension + block->first_dimension;
        for (size_t d = 0; d < block->dimension_count; ++d)
            block->data[i + d * block->coordinate_stride] = point[d];
    }
}

/* Adds SHIFT or ROTATE to the generator's coordinates. */
static void shift(const aur_pointset *set, const aur_block *block) {
    for (size_t d = 0; d < block->dimension_count; ++d) {
        const size_t dimension = block->first_dimension + d;
        if (set->scramble == AUR_SCRAMBLE_ROTATE && dimension != 1)
            continue;
        const double offset = aur_word_to_double(aur_scramble_key(block->seed, dimension));
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t i = 0; i < block->count; ++i) {
            const double sum = out[i] + offset;
            out[i] = sum < 1.0 ? sum : sum - 1.0;
        }
    }
}

/* The baker's transform (Hickernell 2002): functions become periodic with unchanged means. */
static void fold(const aur_block *block) {
    for (size_t d = 0; d < block->dimension_count; ++d) {
        double *const out = block->data + d * block->coordinate_stride;
        for (size_t i = 0; i < block->count; ++i)
            out[i] = out[i] < 0.5 ? 2.0 * out[i] : fmin(2.0 - 2.0 * out[i], AUR_BELOW_ONE);
    }
}

void aur_pointset_fill(const aur_pointset *set, const aur_block *block) {
    set->kind->fill(set, block);
    if (set->scramble == AUR_SCRAMBLE_SHIFT || set->scramble == AUR_SCRAMBLE_ROTATE)
        shift(set, block);
    if (set->fold)
        fold(block);
}

#include <aureole/pointset.h>

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "core/text.h"
#include "pointset/set.h"

/* The table of square sets: one line for each file. */
static const aur_square_set *const sets[] = {
    &aur_set_random,
    &aur_set_lcg,
    &aur_set_icg,
    &aur_set_jittered,
    &aur_set_van_der_corput,
    &aur_set_halton,
    &aur_set_hammersley,
    &aur_set_faure,
    &aur_set_sobol,
    &aur_set_niederreiter,
    &aur_set_larcher_pillichshammer,
    &aur_set_matrices,
    &aur_set_fibonacci_lattice,
    &aur_set_rank1,
    &aur_set_r2,
    &aur_set_golden,
    &aur_set_golden_set,
    &aur_set_blue_noise,
    &aur_set_bnot,
    &aur_set_file,
};

enum { SET_COUNT = sizeof sets / sizeof sets[0] };

static const char *const scramble_names[] = {"none", "digit", "owen", "shift", "rotate", "rotate3d"};
enum { SCRAMBLE_COUNT = sizeof scramble_names / sizeof scramble_names[0] };

size_t aur_square_set_count(void) {
    return SET_COUNT;
}

const aur_square_set *aur_square_set_at(size_t index) {
    return index < SET_COUNT ? sets[index] : NULL;
}

aur_result aur_scramble_from_name(const char *name, aur_scramble *scramble, aur_error *error) {
    for (size_t i = 0; i < SCRAMBLE_COUNT; ++i) {
        if (strcmp(name, scramble_names[i]) == 0) {
            *scramble = (aur_scramble)i;
            return AUR_OK;
        }
    }
    return aur_fail(error, AUR_ERROR_NAME,
                    "no scrambling is named '%s'; there are none, digit, owen, shift, rotate and rotate3d",
                    name);
}

const char *aur_scramble_name(aur_scramble scramble) {
    return (size_t)scramble < SCRAMBLE_COUNT ? scramble_names[scramble] : NULL;
}

void aur_warn_incomplete_net(const aur_pointset *set, const aur_pointset_options *options, uint64_t base) {
    uint64_t rest = set->size;
    while (rest % base == 0)
        rest /= base;
    if (rest != 1)
        aur_warn_at(&options->warnings, (aur_location){0},
                    "set '%s': %" PRIu64 " points are not a power of %" PRIu64 ", so the net is incomplete",
                    set->kind->description.name, set->size, base);
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

static aur_result find_set(const char *name, const aur_square_set **kind, aur_error *error) {
    const char *names[SET_COUNT];
    for (size_t i = 0; i < SET_COUNT; ++i) {
        names[i] = sets[i]->description.name;
        if (strcmp(name, names[i]) == 0) {
            *kind = sets[i];
            return AUR_OK;
        }
    }
    const char *const nearest = aur_nearest_name(name, SET_COUNT, names);
    if (nearest != NULL)
        return aur_fail(error, AUR_ERROR_NAME, "no set of the square is named '%s'; did you mean '%s'?", name,
                        nearest);
    return aur_fail(error, AUR_ERROR_NAME, "no set of the square is named '%s'", name);
}

aur_result aur_pointset_check(const aur_pointset *set, aur_error *error) {
    const aur_square_set *const kind = set->kind;
    const char *const name = kind->description.name;
    const bool own_size = kind == &aur_set_file;
    if (set->size == 0 && !own_size)
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

static aur_result make(aur_pointset *set, aur_parameters *keys, const aur_pointset_options *options,
                       aur_error *error) {
    aur_result result = find_set(keys->plugin, &set->kind, error);
    if (result == AUR_OK && options->dimension == 0)
        set->dimension = set->kind->maximum_dimension < 2 ? set->kind->maximum_dimension : 2;
    if (result == AUR_OK)
        result = aur_pointset_check(set, error);
    if (result == AUR_OK && set->kind->prepare != NULL)
        result = set->kind->prepare(set, keys, options, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(keys, error);
    return result;
}

/* What follows "file:" is a path, whatever characters it has. */
static aur_result parse(const char *text, aur_parameters *keys, aur_error *error) {
    static const char prefix[] = "file:";
    if (strncmp(text, prefix, sizeof prefix - 1) != 0)
        return aur_parameters_parse(keys, "set", text, error);
    const aur_location nowhere = {0};
    aur_result result = aur_parameters_init(keys, "set", "file", nowhere, error);
    if (result != AUR_OK)
        return result;
    result =
        aur_parameters_add_text(keys, AUR_PARAMETER_TEXT, "path", text + sizeof prefix - 1, nowhere, error);
    if (result != AUR_OK)
        aur_parameters_release(keys);
    return result;
}

aur_result aur_pointset_create(const char *text, const aur_pointset_options *options, aur_pointset **pointset,
                               aur_error *error) {
    *pointset = NULL;
    aur_parameters keys;
    aur_result result = parse(text, &keys, error);
    if (result != AUR_OK)
        return result;
    aur_pointset *const set = calloc(1, sizeof *set);
    if (set == NULL) {
        aur_parameters_release(&keys);
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    }
    set->size = options->count;
    set->dimension = options->dimension;
    set->scramble = options->scramble;
    set->seed = options->seed;
    result = make(set, &keys, options, error);
    aur_parameters_release(&keys);
    if (result != AUR_OK) {
        aur_pointset_destroy(set);
        return result;
    }
    *pointset = set;
    return AUR_OK;
}

void aur_pointset_destroy(aur_pointset *pointset) {
    if (pointset == NULL)
        return;
    free(pointset->data);
    free(pointset);
}

size_t aur_pointset_dimension(const aur_pointset *pointset) {
    return pointset->dimension;
}

uint64_t aur_pointset_size(const aur_pointset *pointset) {
    return pointset->size;
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

/* The table of the sets of the square, and preparing a set from its text. */
#include <aureole/pointset.h>

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/names.h"
#include "points/base/text.h"
#include "points/pointset/points.h"
#include "points/pointset/sets.h"

static const aur_square_set *const sets[] = {
#define ROW(name) &aur_set_##name,
    AUR_SQUARE_SETS(ROW)
#undef ROW
};

enum { SET_COUNT = sizeof sets / sizeof sets[0] };

static const char *name_of(const void *table, size_t index) {
    (void)table;
    return sets[index]->description.row.name;
}

static aur_result find_set(const char *name, const aur_square_set **kind, aur_error *error) {
    size_t index;
    const aur_result result = aur_names_choose((aur_names){SET_COUNT, name_of, NULL}, "set of the square",
                                               name, (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *kind = sets[index];
    return result;
}

/* A size that is not a power of the base leaves a net incomplete. */
static void warn_incomplete_net(const aur_pointset *set) {
    uint64_t rest = set->size;
    while (set->net_base != 0 && rest % set->net_base == 0)
        rest /= set->net_base;
    if (set->net_base != 0 && rest != 1)
        aur_warn_at(&set->options->warnings, (aur_location){0},
                    "set '%s': %" PRIu64 " points are not a power of %" PRIu64 ", so the net is incomplete",
                    set->kind->description.row.name, set->size, set->net_base);
}

static aur_result make(aur_pointset *set, aur_parameters *keys, aur_error *error) {
    aur_result result = find_set(keys->plugin, &set->kind, error);
    if (result == AUR_OK && set->dimension == 0)
        set->dimension = set->kind->description.dimensions[1] < 2 ? 1 : 2;
    if (result == AUR_OK)
        result = aur_pointset_check(set, error);
    if (result == AUR_OK)
        set->net_base = set->kind->description.size_base;
    if (result == AUR_OK && set->kind->prepare != NULL)
        result = set->kind->prepare(set, keys, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(keys, error);
    if (result == AUR_OK)
        warn_incomplete_net(set);
    return result;
}

/* The text after "file:" is a path with any characters; all user sets are one row of the table. */
static aur_result parse(const char *text, aur_parameters *keys, aur_error *error) {
    if (!aur_set_is_user(text))
        return aur_parameters_parse(keys, "set", text, error);
    const aur_location nowhere = {0};
    aur_result result = aur_parameters_init(keys, "set", "file", nowhere, error);
    if (result != AUR_OK)
        return result;
    result = aur_parameters_add_text(keys, AUR_PARAMETER_TEXT, "PATH", text, nowhere, error);
    if (result != AUR_OK)
        aur_parameters_release(keys);
    return result;
}

aur_result aur_pointset_create(const char *text, const aur_pointset_options *options, aur_pointset **pointset,
                               aur_error *error) {
    *pointset = NULL;
    aur_pointset_options copy = {.size = sizeof copy};
    aur_pointset_options_init(0, &copy, NULL);
    aur_parameters keys;
    aur_result result = aur_options_read(options, sizeof copy, &copy, "aur_pointset_options", error);
    if (result == AUR_OK)
        result = parse(text, &keys, error);
    if (result != AUR_OK)
        return result;
    aur_pointset *const set = calloc(1, sizeof *set);
    if (set == NULL) {
        aur_parameters_release(&keys);
        return aur_fail_memory(error);
    }
    set->size = copy.count;
    set->dimension = copy.dimension;
    set->scramble = copy.scramble;
    set->seed = copy.seed;
    set->options = &copy;
    result = make(set, &keys, error);
    set->options = NULL;
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

aur_result aur_pointset_options_init(uint64_t count, aur_pointset_options *options, aur_error *error) {
    static const aur_pointset_options defaults = {.size = sizeof defaults};
    const aur_result result =
        aur_description_write(&defaults, sizeof defaults, options, "aur_pointset_options", error);
    if (result == AUR_OK)
        options->count = count;
    return result;
}

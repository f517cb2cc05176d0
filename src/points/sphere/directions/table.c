/* The table of all sets: those of the square, then those that are native to the sphere. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include <aureole/sphere.h>

#include "points/base/keys.h"
#include "points/sphere/native.h"

enum { NAME_CAPACITY = 64 };

#define SQUARE(name) &aur_set_##name.description.row,
#define NATIVE(name) &aur_native_##name.description.row,
const aur_row *const aur_set_rows[AUR_SET_COUNT] = {AUR_SQUARE_SETS(SQUARE) AUR_NATIVE_SETS(NATIVE)};

const aur_table aur_set_table = {.kind = "set",
                                 .summary = "point sets of the square, the cube and the sphere",
                                 AUR_TABLE_ROWS(aur_set_rows)};

size_t aur_set_count(void) {
    return AUR_SET_COUNT;
}

const aur_set_description *aur_set_at(size_t index) {
    return index < AUR_SET_COUNT ? (const aur_set_description *)aur_set_rows[index] : NULL;
}

const aur_set_description *aur_set_find(const char *set) {
    const size_t length = strcspn(set, ":");
    for (size_t i = 0; i < aur_set_count(); ++i) {
        const aur_set_description *const row = aur_set_at(i);
        if (strlen(row->row.name) == length && strncmp(row->row.name, set, length) == 0)
            return row;
    }
    return NULL;
}

const aur_native_set *aur_native_find(const char *set) {
    const aur_set_description *const row = aur_set_find(set);
    for (size_t i = AUR_SQUARE_SET_COUNT; row != NULL && i < AUR_SET_COUNT; ++i)
        if (aur_set_rows[i] == &row->row)
            return (const aur_native_set *)row;
    return NULL;
}

aur_result aur_native_open(const aur_native_set *native, const char *set, const aur_native_request *request,
                           void **data, aur_error *error) {
    const aur_set_description *const description = &native->description;
    char sizes[128];
    aur_set_sizes(description, sizeof sizes, sizes);
    if (request->count == 0 || request->count > description->maximum_size)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has sizes %s, not %llu", description->row.name,
                        sizes, (unsigned long long)request->count);
    if ((description->domains >> request->domain & 1u) == 0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "set '%s' has no points of the domain '%s'",
                        description->row.name, aur_domain_name(request->domain));
    aur_parameters keys;
    aur_result result = aur_parameters_parse(&keys, "set", set, error);
    if (result != AUR_OK)
        return result;
    result = native->prepare(&description->row, &keys, request, data, error);
    if (result == AUR_OK)
        result = aur_parameters_finish(&keys, error);
    aur_parameters_release(&keys);
    return result;
}

aur_result aur_set_check_name(const char *set, aur_error *error) {
    const aur_names all = aur_names_of_table(&aur_set_table);
    char requested[NAME_CAPACITY];
    const size_t length = strcspn(set, ":");
    snprintf(requested, sizeof requested, "%.*s",
             (int)(length < sizeof requested ? length : sizeof requested - 1), set);
    if (aur_names_find(all, requested) < all.count)
        return AUR_OK;
    const char *const nearest = aur_names_nearest(all, requested);
    if (nearest != NULL)
        return aur_fail(error, AUR_ERROR_NAME, "unknown set '%s'; did you mean '%s'?", requested, nearest);
    return aur_fail(error, AUR_ERROR_NAME, "unknown set '%s': 'aureole sets' lists them", requested);
}

/* Writes large sizes as 2^k, 2^k-1 and 2^k-2. */
static void print_size(uint64_t size, size_t capacity, char *text) {
    for (unsigned k = 10; k < 64; ++k)
        for (unsigned below = 0; below < 3; ++below)
            if (size == (UINT64_C(1) << k) - below) {
                snprintf(text, capacity, below > 0 ? "(2^%u-%u)" : "2^%u", k, below);
                return;
            }
    snprintf(text, capacity, "%" PRIu64, size);
}

size_t aur_set_sizes(const aur_set_description *set, size_t capacity, char *text) {
    char most[32], range[128];
    print_size(set->maximum_size, sizeof most, most);
    if (set->size_at != NULL)
        snprintf(range, sizeof range, "%" PRIu64 ", %" PRIu64 ", %" PRIu64 ", .. %s", set->size_at(0),
                 set->size_at(1), set->size_at(2), most);
    else
        snprintf(range, sizeof range, "1..%s%s", most, set->counts_coordinates ? "/dimension" : "");
    const char *const reach = set->maximum_size < UINT64_MAX ? range
                              : set->sized_by_file           ? "up to the file's"
                                                             : "any";
    const char *best = "";
    if (set->best_sizes == AUR_SIZES_POWERS)
        best = set->size_base == 2 ? "; a net at 2^m" : "; a net at base^m";
    else if (set->best_sizes == AUR_SIZES_FIBONACCI)
        best = "; a lattice at F_k";
    else if (set->best_sizes == AUR_SIZES_GRIDS)
        best = "; base*4^levels times 1, 2, 3, 4 is even";
    const int length = snprintf(text, capacity, "%s%s", reach, best);
    return length > 0 ? (size_t)length : 0;
}

/* The interface of sets that are native to the sphere, which each generator's file implements for the table
 * of all sets. */
#pragma once

#include <aureole/sphere.h>
#include <stdbool.h>

#include "points/base/error.h"
#include "points/pointset/sets.h"

/* The domain of a native set: `count` points spread uniformly over the cap z >= 1 - height (1 hemisphere and
 * axes, 2 sphere), or over the rotations. */
typedef struct aur_native_request {
    aur_domain domain;
    uint64_t count;
    double height;
    const aur_warnings *warnings;
} aur_native_request;

typedef struct aur_native_set {
    aur_set_description description;
    /* Reads the keys and prepares *data, one allocation. */
    aur_result (*prepare)(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error);
    /* Writes unit vectors first .. first+count-1, which are inside the set; for rotations quaternions
     * w,x,y,z. */
    void (*fill)(const void *data, uint64_t first, size_t count, double *points);
    /* The weights of points first .. first+count-1, which add up to 1 over the set; NULL: all equal. */
    void (*weigh)(const void *data, uint64_t first, size_t count, double *weights);
} aur_native_set;

/* The native sets, in the order of listings: one line for each file of a generator, which defines
 * aur_native_<name>. */
#define AUR_NATIVE_SETS(ROW)                                                                                 \
    ROW(fibonacci)                                                                                           \
    ROW(grid)                                                                                                \
    ROW(healpix)                                                                                             \
    ROW(t_design)                                                                                            \
    ROW(lebedev)                                                                                             \
    ROW(gauss)                                                                                               \
    ROW(eqsp)                                                                                                \
    ROW(icosahedral)                                                                                         \
    ROW(electrostatic)                                                                                       \
    ROW(max_determinant)                                                                                     \
    ROW(greedy)                                                                                              \
    ROW(super_fibonacci)                                                                                     \
    ROW(super_fibonacci_grid)                                                                                \
    ROW(esfg_rotations)

#define AUR_DECLARE_NATIVE_SET(name) extern const aur_native_set aur_native_##name;
AUR_NATIVE_SETS(AUR_DECLARE_NATIVE_SET)
#undef AUR_DECLARE_NATIVE_SET

#define AUR_ONE_MORE(name) +1
enum {
    AUR_SQUARE_SET_COUNT = 0 AUR_SQUARE_SETS(AUR_ONE_MORE),
    AUR_SET_COUNT = AUR_SQUARE_SET_COUNT AUR_NATIVE_SETS(AUR_ONE_MORE)
};
#undef AUR_ONE_MORE

/* The tables of all sets; also used for the table of samplers in the rendering library. */
extern AUR_INTERNAL const aur_row *const aur_set_rows[AUR_SET_COUNT];

/* The native set named by the text of a SET, or NULL. */
const aur_native_set *aur_native_find(const char *set);
/* Prepares a native set; *data is its private data. Errors: ARGUMENT for an unsupported size, UNSUPPORTED for
 * a domain, those of its keys. */
aur_result aur_native_open(const aur_native_set *native, const char *set, const aur_native_request *request,
                           void **data, aur_error *error);
/* AUR_OK if the text of a SET names a set of either kind, else NAME with a suggestion. */
aur_result aur_set_check_name(const char *set, aur_error *error);
/* Whether the points of a rule have unequal weights. */
AUR_INTERNAL bool aur_directions_weighted(const aur_directions *directions);

extern const aur_table aur_set_table;

/* The inside of a set that is native to the sphere: what each generator's file offers to the table of all
 * sets. */
#pragma once

#include <aureole/sphere.h>
#include <stdbool.h>

#include "points/base/error.h"
#include "points/pointset/sets.h"

/* What a native set fills: `count` points spread uniformly over the cap z >= 1 - height (1 hemisphere and
 * axes, 2 sphere), or over the rotations. */
typedef struct aur_native_request {
    aur_domain domain;
    uint64_t count;
    double height;
    const aur_warnings *warnings;
} aur_native_request;

typedef struct aur_native_set {
    aur_set_description description;
    /* Reads the keys and makes *data, one allocation, ready. */
    aur_result (*prepare)(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error);
    /* Unit vectors first .. first+count-1, which are within the set; quaternions w,x,y,z of a set of
     * rotations. */
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

/* Of all sets; for the table of samplers, too, in the other library. */
extern AUR_INTERNAL const aur_row *const aur_set_rows[AUR_SET_COUNT];

/* The native set that a SET's text names, or NULL. */
const aur_native_set *aur_native_find(const char *set);
/* Makes a native set ready; *data is its own. Errors: ARGUMENT for a size that it does not have, UNSUPPORTED
 * for a domain, those of its keys. */
aur_result aur_native_open(const aur_native_set *native, const char *set, const aur_native_request *request,
                           void **data, aur_error *error);
/* AUR_OK if a SET's text names a set of either kind, else NAME with a suggestion. */
aur_result aur_set_check_name(const char *set, aur_error *error);
/* Whether the points of a rule are not all worth the same. */
AUR_INTERNAL bool aur_directions_weighted(const aur_directions *directions);

extern const aur_table aur_set_table;

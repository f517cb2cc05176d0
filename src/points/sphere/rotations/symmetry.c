/* The rotation groups of crystals and their fundamental zones (International Tables for Crystallography A;
 * Heinz and Neumann 1991). */
#include <math.h>
#include <string.h>

#include <aureole/rotations.h>

#include "points/base/error.h"
#include "points/base/names.h"
#include "points/base/vector.h"
#include "points/sphere/map.h"

static const char *const names[] = {"1", "2", "222", "3", "32", "4", "422", "6", "622", "23", "432"};
enum { SYMMETRY_COUNT = sizeof names / sizeof names[0] };

static const double boundary = 1e-12;

aur_result aur_symmetry_from_name(const char *name, aur_symmetry *symmetry, aur_error *error) {
    size_t index;
    const aur_result result = aur_names_choose(aur_names_of(SYMMETRY_COUNT, names), "symmetry", name,
                                               (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *symmetry = (aur_symmetry)index;
    return result;
}

const char *aur_symmetry_name(aur_symmetry symmetry) {
    return (size_t)symmetry < SYMMETRY_COUNT ? names[symmetry] : NULL;
}

/* The two generators of a group: rotations by 1/first of a turn about z, and by 1/second about `axis`. */
typedef struct generators {
    unsigned first, second;
    double axis[3];
} generators;

static const generators table[SYMMETRY_COUNT] = {
    [AUR_SYMMETRY_1] = {1, 1, {1, 0, 0}},   [AUR_SYMMETRY_2] = {2, 1, {1, 0, 0}},
    [AUR_SYMMETRY_222] = {2, 2, {1, 0, 0}}, [AUR_SYMMETRY_3] = {3, 1, {1, 0, 0}},
    [AUR_SYMMETRY_32] = {3, 2, {1, 0, 0}},  [AUR_SYMMETRY_4] = {4, 1, {1, 0, 0}},
    [AUR_SYMMETRY_422] = {4, 2, {1, 0, 0}}, [AUR_SYMMETRY_6] = {6, 1, {1, 0, 0}},
    [AUR_SYMMETRY_622] = {6, 2, {1, 0, 0}}, [AUR_SYMMETRY_23] = {2, 3, {1, 1, 1}},
    [AUR_SYMMETRY_432] = {4, 3, {1, 1, 1}},
};

static void turn(unsigned order, const double axis[3], double q[4]) {
    const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double half = AUR_PI / (double)order;
    q[0] = cos(half);
    for (size_t d = 0; d < 3; ++d)
        q[1 + d] = sin(half) * axis[d] / length;
}

/* Whether q or -q is among them. */
static bool has(size_t count, const double *group, const double q[4]) {
    for (size_t i = 0; i < count; ++i)
        if (fabs(aur_dot4(group + 4 * i, q)) > 1.0 - 1e-6)
            return true;
    return false;
}

size_t aur_symmetry_group(aur_symmetry symmetry, double *group) {
    if ((size_t)symmetry >= SYMMETRY_COUNT)
        return 0;
    const double z[3] = {0.0, 0.0, 1.0}, identity[4] = {1.0, 0.0, 0.0, 0.0};
    double steps[2][4];
    turn(table[symmetry].first, z, steps[0]);
    turn(table[symmetry].second, table[symmetry].axis, steps[1]);
    size_t count = 1;
    memcpy(group, identity, sizeof identity);
    /* Adds all products until the group is closed. */
    for (size_t i = 0; i < count; ++i)
        for (size_t k = 0; k < 2; ++k) {
            double product[4];
            aur_quaternion_multiply(group + 4 * i, steps[k], product);
            if (count < AUR_SYMMETRY_ORDER_MAX && !has(count, group, product))
                memcpy(group + 4 * count++, product, sizeof product);
        }
    return count;
}

static void make_positive(double q[4]) {
    const double sign = q[0] < 0.0 ? -1.0 : 1.0;
    for (size_t d = 0; d < 4; ++d)
        q[d] *= sign;
}

aur_result aur_symmetry_reduce(aur_symmetry symmetry, size_t count, double *wxyz, aur_error *error) {
    double group[4 * AUR_SYMMETRY_ORDER_MAX];
    const size_t order = aur_symmetry_group(symmetry, group);
    if (order == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%d is not a symmetry", (int)symmetry);
    for (size_t i = 0; i < count; ++i) {
        double best[4] = {0.0};
        for (size_t k = 0; k < order; ++k) {
            double product[4];
            aur_quaternion_multiply(wxyz + 4 * i, group + 4 * k, product);
            if (fabs(product[0]) > fabs(best[0]) || k == 0)
                memcpy(best, product, sizeof best);
        }
        make_positive(best);
        memcpy(wxyz + 4 * i, best, sizeof best);
    }
    return AUR_OK;
}

size_t aur_symmetry_select(aur_symmetry symmetry, size_t count, double *wxyz) {
    double group[4 * AUR_SYMMETRY_ORDER_MAX];
    const size_t order = aur_symmetry_group(symmetry, group);
    size_t selected = 0;
    for (size_t i = 0; i < count && order > 0; ++i) {
        double q[4];
        memcpy(q, wxyz + 4 * i, sizeof q);
        make_positive(q);
        bool inside = true;
        /* The group has the inverse of each of its rotations: the products' w are the scalar products. */
        for (size_t k = 1; k < order && inside; ++k)
            inside = fabs(aur_dot4(q, group + 4 * k)) <= q[0] + boundary;
        if (inside)
            memcpy(wxyz + 4 * selected++, q, sizeof q);
    }
    return selected;
}

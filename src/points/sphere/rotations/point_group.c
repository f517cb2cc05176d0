/* Point groups by their generators (Schoenflies 1891). */
#include <aureole/symmetry.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"

static const aur_rotation identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1}};
static const aur_rotation inversion = {{-1, 0, 0, 0, -1, 0, 0, 0, -1}};
static const aur_rotation across_z = {{1, 0, 0, 0, 1, 0, 0, 0, -1}};
static const aur_rotation across_y = {{1, 0, 0, 0, -1, 0, 0, 0, 1}};

static const double x_axis[3] = {1, 0, 0}, z_axis[3] = {0, 0, 1}, diagonal[3] = {1, 1, 1};
static const double five_fold[3] = {0, 1, 1.6180339887498949}; /* the golden ratio */

/* Rotation by 1/order of a turn about an axis (Rodrigues). */
static aur_rotation turn(unsigned order, const double axis[3]) {
    double u[3] = {axis[0], axis[1], axis[2]};
    aur_normalize3(u);
    const double angle = 2.0 * AUR_PI / order, c = cos(angle), s = sin(angle);
    const double cross[9] = {0, -u[2], u[1], u[2], 0, -u[0], -u[1], u[0], 0};
    aur_rotation rotation;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            rotation.m[3 * i + k] = (i == k ? c : 0.0) + s * cross[3 * i + k] + (1.0 - c) * u[i] * u[k];
    return rotation;
}

static aur_rotation multiply(const aur_rotation *a, const aur_rotation *b) {
    aur_rotation product;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            const double sum =
                a->m[3 * i] * b->m[k] + a->m[3 * i + 1] * b->m[3 + k] + a->m[3 * i + 2] * b->m[6 + k];
            product.m[3 * i + k] = fabs(sum) < 1e-15 ? 0.0 : sum;
        }
    return product;
}

static bool has(const aur_point_group *group, const aur_rotation *element) {
    for (size_t i = 0; i < group->order; ++i) {
        double largest = 0.0;
        for (int k = 0; k < 9; ++k)
            largest = fmax(largest, fabs(group->elements[i].m[k] - element->m[k]));
        if (largest < 1e-9)
            return true;
    }
    return false;
}

/* All products of the generators. */
static void generate(size_t count, const aur_rotation *generators, aur_point_group *group) {
    group->order = 1;
    group->elements[0] = identity;
    for (size_t i = 0; i < group->order; ++i)
        for (size_t k = 0; k < count; ++k) {
            const aur_rotation product = multiply(&group->elements[i], &generators[k]);
            if (group->order < AUR_POINT_GROUP_ORDER_MAX && !has(group, &product))
                group->elements[group->order++] = product;
        }
}

/* The parts of a symbol after its first letter: the order of the axis, 0 if none, and the last letter. */
static bool parse(const char *name, unsigned *order, char *suffix) {
    int read = 0;
    *order = 0;
    *suffix = '\0';
    if (name[0] == '\0')
        return false;
    const char *rest = name + 1;
    if (rest[0] >= '1' && rest[0] <= '9') {
        if (sscanf(rest, "%2u%n", order, &read) != 1)
            return false;
        rest += read;
    }
    if (rest[0] != '\0' && rest[1] != '\0')
        return false;
    *suffix = rest[0];
    return *order <= AUR_POINT_GROUP_AXIS_MAX && strchr("vhdis", *suffix) != NULL;
}

/* The generators of a symbol; returns their number, or 0 for an invalid symbol. */
static size_t generators_of(char letter, unsigned order, char suffix, aur_rotation generators[3]) {
    const bool cubic = letter == 'T' || letter == 'O' || letter == 'I';
    if (cubic != (order == 0) && !(letter == 'C' && order == 0))
        return 0;
    if (letter == 'C' && order == 0) {
        generators[0] = suffix == 'i' ? inversion : across_z;
        return suffix == 'i' || suffix == 's' ? 1 : 0;
    }
    const aur_rotation main_axis = letter == 'T'   ? turn(2, z_axis)
                                   : letter == 'O' ? turn(4, z_axis)
                                   : letter == 'I' ? turn(5, five_fold)
                                                   : turn(order, z_axis);
    const aur_rotation half_step = turn(letter == 'T' ? 4 : 2 * (order > 0 ? order : 1), z_axis);
    generators[0] = main_axis;
    generators[1] = cubic ? turn(3, diagonal) : turn(2, x_axis);
    const char *const allowed = letter == 'C'                    ? "vh"
                                : letter == 'D' || letter == 'T' ? "hd"
                                : letter == 'S'                  ? ""
                                                                 : "h";
    if (strchr(allowed, suffix) == NULL)
        return 0;
    if (letter == 'S') {
        generators[0] = multiply(&main_axis, &across_z);
        return order % 2 == 0 ? 1 : 0;
    }
    size_t count = letter == 'C' ? 1 : letter == 'D' || cubic ? 2 : 0;
    if (count > 0 && suffix != '\0')
        generators[count++] = suffix == 'v'   ? across_y
                              : suffix == 'd' ? multiply(&half_step, &across_z)
                              : cubic         ? inversion
                                              : across_z;
    return count;
}

aur_result aur_point_group_from_name(const char *name, aur_point_group *group, aur_error *error) {
    unsigned order;
    char suffix;
    aur_rotation generators[3];
    const size_t count = parse(name, &order, &suffix) ? generators_of(name[0], order, suffix, generators) : 0;
    if (count == 0)
        return aur_fail(
            error, AUR_ERROR_NAME,
            "unknown point group '%s'; there are: Ci, Cs, Cn, Cnv, Cnh, Sn (n even), Dn, Dnh, Dnd "
            "(n from 1 to %d), T, Td, Th, O, Oh, I, Ih",
            name, AUR_POINT_GROUP_AXIS_MAX);
    generate(count, generators, group);
    return AUR_OK;
}

/* Whether an image represents the orbit instead of a direction: it is nearer to the middle of the region, or
 * equally near and later in the order of coordinates. */
static bool is_better(const double image[3], const double u[3]) {
    static const double middle[3] = {0.6438467239, 0.0257675850, 0.7647219}, tie = 1e-12;
    double ahead = aur_dot3(middle, image) - aur_dot3(middle, u);
    for (size_t d = 0; d < 3 && fabs(ahead) <= tie; ++d)
        ahead = image[d] - u[d];
    return ahead > tie;
}

size_t aur_point_group_select(const aur_point_group *group, size_t count, double *xyz, double *weights) {
    size_t selected = 0;
    for (size_t i = 0; i < count; ++i) {
        const double *const u = xyz + 3 * i;
        bool first = true;
        size_t fixed = 1; /* elements that leave it unchanged */
        for (size_t g = 1; g < group->order && first; ++g) {
            double image[3] = {u[0], u[1], u[2]};
            aur_rotation_apply(&group->elements[g], 1, image);
            first = !is_better(image, u);
            fixed += fabs(image[0] - u[0]) + fabs(image[1] - u[1]) + fabs(image[2] - u[2]) < 1e-9;
        }
        if (!first)
            continue;
        if (weights != NULL)
            weights[selected] = weights[i] * (double)group->order / (double)fixed;
        memmove(xyz + 3 * selected++, u, 3 * sizeof *u);
    }
    return selected;
}

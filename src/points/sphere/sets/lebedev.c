/* Quadrature of the sphere with octahedral symmetry (Lebedev 1976; Lebedev and Laikov 1999), with about a
 * third fewer points than equal-weight designs of the same degree. scripts/lebedev_table.py solves for the
 * orbits. */
#include "points/sphere/sets/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"

/* A node and its weight. */
typedef struct node {
    double xyz[3], weight;
} node;

/* A corner x >= y >= z >= 0 and a weight, which all images of the corner under changes of sign and order
 * have. Equal coordinates are bit-identical. */
static const double orbits[][4] = {
#include "data/lebedev.inc"
};

const aur_reference aur_lebedev_rules[AUR_LEBEDEV_COUNT] = {
#include "data/lebedev_rules.inc"
};

/* Writes the images of an orbit's corner: all signs of nonzero coordinates for each distinct permutation.
 * Returns the end of the output. */
static node *unfold(const double orbit[4], node *to) {
    static const unsigned char orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                               {1, 0, 2}, {0, 2, 1}, {2, 1, 0}};
    const node *const begin = to;
    for (size_t o = 0; o < 6; ++o)
        for (unsigned signs = 0; signs < 8; ++signs) {
            node image = {.weight = orbit[3]};
            bool repeated = false;
            for (size_t d = 0; d < 3; ++d) {
                const double x = orbit[orders[o][d]];
                const bool negative = (signs >> d & 1u) != 0;
                repeated = repeated || (negative && x == 0.0);
                image.xyz[d] = negative ? -x : x;
            }
            for (const node *before = begin; before < to && !repeated; ++before)
                repeated = memcmp(before, &image, sizeof image) == 0;
            if (!repeated)
                *to++ = image;
        }
    return to;
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    (void)parameters;
    const aur_reference *rule;
    const aur_result result =
        aur_reference_find(row->name, AUR_LEBEDEV_COUNT, aur_lebedev_rules, request, &rule, error);
    if (result != AUR_OK)
        return result;
    node *const nodes = malloc(rule->count * sizeof *nodes);
    if (nodes == NULL)
        return aur_fail_memory(error);
    node *to = nodes;
    double least = INFINITY;
    for (size_t r = 0; r < rule->rows; ++r) {
        to = unfold(orbits[rule->first + r], to);
        least = fmin(least, orbits[rule->first + r][3]);
    }
    if (least < 0.0)
        aur_warn_at(request->warnings, (aur_location){0},
                    "set 'lebedev': the rule of %u points has negative weights, the least %.4g/N",
                    (unsigned)rule->count, least * rule->count);
    *data = nodes;
    return AUR_OK;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    const node *const nodes = (const node *)data + first;
    for (size_t i = 0; i < count; ++i)
        memcpy(xyz + 3 * i, nodes[i].xyz, sizeof nodes[i].xyz);
}

static void weigh(const void *data, uint64_t first, size_t count, double *weights) {
    const node *const nodes = (const node *)data + first;
    for (size_t i = 0; i < count; ++i)
        weights[i] = nodes[i].weight;
}

static uint64_t size_at(size_t index) {
    return index < AUR_LEBEDEV_COUNT ? aur_lebedev_rules[index].count : 0;
}

const aur_native_set aur_native_lebedev = {
    .description = {.row = {.name = "lebedev",
                            .summary =
                                "points with weights that are exact for polynomials of degree 3 to 131, "
                                "octahedral symmetry; some weights of 74, 230 and 266 points are negative",
                            .source = "Lebedev 1976; Lebedev, Laikov 1999"},
                    .domains = AUR_ON_SPHERE,
                    .dimensions = {3, 3},
                    .size_at = size_at,
                    .maximum_size = 5810},
    .prepare = prepare,
    .fill = fill,
    .weigh = weigh,
};

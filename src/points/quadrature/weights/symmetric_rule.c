/* Product rules on the sphere that are invariant under a point group, by one point of each orbit. */
#include <aureole/symmetry.h>
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/gauss.h"
#include "points/base/vector.h"

/* Heights times azimuths (j + 1/2) / azimuths of a turn. */
typedef struct product {
    size_t heights, azimuths;
    double *z, *weights;
    bool *visited;
} product;

static bool keeps_z(const aur_rotation *element) {
    return fabs(fabs(element->m[8]) - 1.0) < 1e-9;
}

/* Elements that map the z axis to itself, under which product rules can be invariant, and the required
 * divisor of azimuths: twice the order of the axis (with half steps, as in Dnd). */
static size_t stored_order(const aur_point_group *group, size_t *step) {
    size_t order = 0, axis = 0;
    for (size_t i = 0; i < group->order; ++i) {
        const double *const m = group->elements[i].m;
        order += keeps_z(&group->elements[i]);
        axis += keeps_z(&group->elements[i]) && m[0] * m[4] - m[1] * m[3] > 0.0;
    }
    *step = 2 * axis;
    return order;
}

/* The largest rule with no more orbits than `most`, about half as many heights as azimuths. */
static void choose(size_t most, size_t order, size_t step, product *rule) {
    rule->heights = 0;
    for (size_t heights = 1;; ++heights) {
        const size_t steps = (2 * heights + step / 2) / step;
        const size_t azimuths = step * (steps > 0 ? steps : 1);
        /* With an odd number of heights one is 0, whose orbits may have half of the points. */
        const size_t points = (heights + (heights % 2)) * azimuths;
        if (points > most * order)
            return;
        rule->heights = heights;
        rule->azimuths = azimuths;
    }
}

/* The index of the rule's point at a direction, or the number of points if there is none. */
static size_t find(const product *rule, const double u[3]) {
    const size_t none = rule->heights * rule->azimuths;
    size_t low = 0, high = rule->heights;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (rule->z[middle] <= u[2] + 1e-9)
            low = middle;
        else
            high = middle;
    }
    const double turns = atan2(u[1], u[0]) / (2.0 * AUR_PI);
    const double index = (turns < 0.0 ? turns + 1.0 : turns) * (double)rule->azimuths - 0.5;
    const double nearest = floor(index + 0.5);
    if (fabs(rule->z[low] - u[2]) > 1e-9 || fabs(index - nearest) > 1e-6)
        return none;
    return low * rule->azimuths + (size_t)nearest % rule->azimuths;
}

static void direction_of(const product *rule, size_t index, double u[3]) {
    const double z = rule->z[index / rule->azimuths];
    const double angle = 2.0 * AUR_PI * ((double)(index % rule->azimuths) + 0.5) / (double)rule->azimuths;
    const double radius = sqrt((1.0 - z) * (1.0 + z));
    u[0] = radius * cos(angle);
    u[1] = radius * sin(angle);
    u[2] = z;
}

/* One point of each orbit, with the weight of the whole orbit. */
static size_t reduce(const aur_point_group *group, const product *rule, double *xyz, double *weights) {
    size_t count = 0;
    const size_t points = rule->heights * rule->azimuths;
    for (size_t i = 0; i < points; ++i) {
        if (rule->visited[i])
            continue;
        double *const u = xyz + 3 * count;
        direction_of(rule, i, u);
        double weight = 0.0;
        for (size_t g = 0; g < group->order; ++g) {
            double image[3] = {u[0], u[1], u[2]};
            aur_rotation_apply(&group->elements[g], 1, image);
            const size_t at = find(rule, image);
            if (at == points || rule->visited[at])
                continue;
            rule->visited[at] = true;
            weight += 0.5 * rule->weights[at / rule->azimuths] / (double)rule->azimuths;
        }
        weights[count++] = weight;
    }
    return count;
}

aur_result aur_symmetric_rule(const aur_point_group *group, size_t most, size_t capacity, double *xyz,
                              double *weights, size_t *count, aur_error *error) {
    size_t step;
    const size_t order = stored_order(group, &step);
    product rule = {0};
    if (group->order < 1 || group->order > AUR_POINT_GROUP_ORDER_MAX || most > SIZE_MAX / 4096)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "%zu points of a group of %zu elements", most,
                        group->order);
    choose(most, order, step, &rule);
    if (rule.heights == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the smallest rule of this group has %zu points, and %zu are allowed",
                        (2 * step + order - 1) / order, most);
    if (capacity < 3 * most)
        return aur_fail(error, AUR_ERROR_CAPACITY, "%zu points take %zu numbers, not %zu", most, 3 * most,
                        capacity);
    rule.z = malloc(2 * rule.heights * sizeof *rule.z);
    rule.visited = calloc(rule.heights * rule.azimuths, sizeof *rule.visited);
    const bool good = rule.z != NULL && rule.visited != NULL;
    if (good) {
        rule.weights = rule.z + rule.heights;
        aur_gauss_legendre(rule.heights, rule.z, rule.weights);
        *count = reduce(group, &rule, xyz, weights);
    }
    free(rule.z);
    free(rule.visited);
    return good ? AUR_OK : aur_fail_memory(error);
}

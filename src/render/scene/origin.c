#include "render/scene/origin.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"

/* --- boxes */

enum { MOST_BOXES = 2048 };

/* In the innermost loops: fmin and fmax, which handle NaN, are calls. */
static inline double smaller_of(double a, double b) {
    return a < b ? a : b;
}

static inline double larger_of(double a, double b) {
    return a > b ? a : b;
}

static aur_patch_box box_of(const aur_shape *shape, size_t primitive) {
    aur_patch_box box = {.shape = shape->index};
    const aur_mesh *const mesh = &shape->mesh;
    if (shape->curved == NULL) {
        const double *corners[3];
        for (size_t i = 0; i < 3; ++i)
            corners[i] = &mesh->points[3 * (size_t)mesh->indices[3 * primitive + i]];
        for (size_t i = 0; i < 3; ++i) {
            box.lower[i] = smaller_of(corners[0][i], smaller_of(corners[1][i], corners[2][i]));
            box.upper[i] = larger_of(corners[0][i], larger_of(corners[1][i], corners[2][i]));
        }
    } else {
        aur_shape_curved_bounds(shape, primitive, box.lower, box.upper);
    }
    return box;
}

/* The bounding box of a transformed box. */
static void move(const aur_transform *to_world, aur_patch_box *box) {
    double middle[3], half[3], moved[3];
    for (size_t i = 0; i < 3; ++i) {
        middle[i] = 0.5 * (box->lower[i] + box->upper[i]);
        half[i] = 0.5 * (box->upper[i] - box->lower[i]);
    }
    aur_transform_point(to_world, middle, moved);
    for (size_t i = 0; i < 3; ++i) {
        const double *const row = &to_world->m[4 * i];
        const double wide = fabs(row[0]) * half[0] + fabs(row[1]) * half[1] + fabs(row[2]) * half[2];
        box->lower[i] = moved[i] - wide;
        box->upper[i] = moved[i] + wide;
    }
}

/* Every n-th of the shape's surfaces, at least one. */
static aur_result add_shape(aur_patch_boxes *boxes, const aur_shape *shape, const aur_transform *to_world,
                            size_t step) {
    const size_t count = aur_shape_primitives(shape), picked = (count + step - 1) / step;
    if (!aur_array_reserve(&boxes->boxes, &boxes->capacity, boxes->count + picked, sizeof *boxes->boxes))
        return AUR_ERROR_MEMORY;
    for (size_t k = 0; k < picked; ++k) {
        aur_patch_box box = box_of(shape, k * step);
        if (to_world != NULL)
            move(to_world, &box);
        bool usable = true;
        for (size_t i = 0; i < 3; ++i) {
            usable = usable && larger_of(fabs(box.lower[i]), fabs(box.upper[i])) <= 1.00001 * AUR_REACH;
            box.size = larger_of(box.size, box.upper[i] - box.lower[i]);
        }
        box.weight = (double)count / (double)picked;
        if (usable && box.size > 0.0)
            boxes->boxes[boxes->count++] = box;
    }
    return AUR_OK;
}

static aur_result add_group(aur_patch_boxes *boxes, const aur_scene *scene, const aur_shape_group *group,
                            const aur_transform *to_world, size_t step) {
    aur_result result = AUR_OK;
    for (size_t i = 0; i < group->count && result == AUR_OK; ++i)
        result = add_shape(boxes, scene->shapes[group->shapes[i]], to_world, step);
    return result;
}

static size_t surfaces_of(const aur_scene *scene, const aur_shape_group *group) {
    size_t count = 0;
    for (size_t i = 0; i < group->count; ++i)
        count += aur_shape_primitives(scene->shapes[group->shapes[i]]);
    return count;
}

aur_result aur_patch_boxes_create(const aur_scene *scene, const aur_shape_group *group,
                                  aur_patch_boxes *boxes) {
    *boxes = (aur_patch_boxes){0};
    size_t total = group != NULL ? surfaces_of(scene, group) : 0;
    for (size_t i = 0; group == NULL && i < scene->shape_count; ++i)
        total += scene->shapes[i]->grouped ? 0 : aur_shape_primitives(scene->shapes[i]);
    for (size_t i = 0; group == NULL && i < scene->instance_count; ++i)
        total += surfaces_of(scene, scene->instances[i]->group);
    const size_t step = total / MOST_BOXES + 1;
    aur_result result = group != NULL ? add_group(boxes, scene, group, NULL, step) : AUR_OK;
    for (size_t i = 0; group == NULL && i < scene->shape_count && result == AUR_OK; ++i)
        if (!scene->shapes[i]->grouped)
            result = add_shape(boxes, scene->shapes[i], NULL, step);
    for (size_t i = 0; group == NULL && i < scene->instance_count && result == AUR_OK; ++i)
        result = add_group(boxes, scene, scene->instances[i]->group, &scene->instances[i]->to_world, step);
    return result;
}

void aur_patch_boxes_release(aur_patch_boxes *boxes) {
    free(boxes->boxes);
    *boxes = (aur_patch_boxes){0};
}

/* --- choosing the origin */

double aur_patch_rounding(const aur_patch_box *box, const double origin[3]) {
    double reach = 0.0;
    for (size_t i = 0; i < 3; ++i)
        reach = larger_of(reach, larger_of(fabs(box->lower[i] - origin[i]), fabs(box->upper[i] - origin[i])));
    return 0.5 * (double)FLT_EPSILON * reach / box->size;
}

/* Harmless relative rounding: for keeping an existing origin, and for a surface within twice its size of the
 * origin. */
static const double HARMLESS = 4e-6, LEAST = 1.2e-7;

/* The area weighted by relative rounding, from the harmless part up to `lost`; stops above `most`. */
static double harm_of(const aur_patch_boxes *boxes, const double origin[3], double most) {
    static const double lost = 2e-3;
    double harm = 0.0;
    for (size_t i = 0; i < boxes->count && harm < most; ++i) {
        const aur_patch_box *const box = &boxes->boxes[i];
        const double rounding = smaller_of(aur_patch_rounding(box, origin), lost);
        if (rounding > HARMLESS)
            harm += box->weight * box->size * box->size * (rounding - HARMLESS);
    }
    return harm;
}

typedef struct side {
    double at;
    const aur_patch_box *box;
} side;

static int compare_sides(const void *a, const void *b) {
    const double x = ((const side *)a)->at, y = ((const side *)b)->at;
    return (x > y) - (x < y);
}

static void sort_sides(const aur_patch_boxes *boxes, size_t axis, side *sides) {
    for (size_t i = 0; i < boxes->count; ++i) {
        const aur_patch_box *const box = &boxes->boxes[i];
        sides[2 * i] = (side){box->lower[axis], box};
        sides[2 * i + 1] = (side){box->upper[axis], box};
    }
    qsort(sides, 2 * boxes->count, sizeof *sides, compare_sides);
}

static double weight_of(const aur_patch_box *box, int power) {
    return box->weight * (power == 2 ? box->size * box->size : power == 1 ? box->size : 1.0);
}

/* The median of the lower and upper sides of all boxes: large boxes do not shift it. */
static double median(const aur_patch_boxes *boxes, const side *sides, int power) {
    const size_t count = 2 * boxes->count;
    double total = 0.0, below = 0.0;
    for (size_t i = 0; i < boxes->count; ++i)
        total += 2.0 * weight_of(&boxes->boxes[i], power);
    size_t low = 0;
    while (low + 1 < count && (below += weight_of(sides[low].box, power)) < 0.4999999 * total)
        ++low;
    size_t high = low;
    while (high + 1 < count && below < 0.5000001 * total)
        below += weight_of(sides[++high].box, power);
    return 0.5 * (sides[low].at + sides[high].at);
}

/* Whether no surface is rounded much more than with another origin. */
static bool is_as_good(const aur_patch_boxes *boxes, const double origin[3], const double other[3]) {
    for (size_t i = 0; i < boxes->count; ++i) {
        const double most = larger_of(4.0 * aur_patch_rounding(&boxes->boxes[i], origin), LEAST);
        if (aur_patch_rounding(&boxes->boxes[i], other) > most)
            return false;
    }
    return true;
}

/* The equally good origin with the fewest digits: a multiple of a power of two. */
static void round_origin(const aur_patch_boxes *boxes, const double best[3], double origin[3]) {
    double largest = 0.0;
    for (size_t i = 0; i < 3; ++i)
        largest = larger_of(largest, fabs(best[i]));
    int exponent;
    frexp(largest, &exponent);
    /* In the last step it is the best origin itself. */
    for (int k = exponent + 1; k > exponent - 60; --k) {
        for (size_t i = 0; i < 3; ++i)
            origin[i] = ldexp(nearbyint(ldexp(best[i], -k)), k) + 0.0;
        if (is_as_good(boxes, best, origin))
            return;
    }
}

aur_result aur_origin_choose(const aur_patch_boxes *boxes, double origin[3]) {
    enum { MEDIANS = 3, PLACES = 32 };
    memset(origin, 0, 3 * sizeof *origin);
    const double at_zero = harm_of(boxes, origin, HUGE_VAL);
    if (!(at_zero > 0.0))
        return AUR_OK;
    double least = HUGE_VAL;
    double best[3] = {0.0}, tried[MEDIANS + PLACES][3];
    side *const sides = malloc(2 * boxes->count * sizeof *sides);
    if (sides == NULL)
        return AUR_ERROR_MEMORY;
    /* Tries centres of most of the area, of the lengths and of the surface count; then some of the surfaces.
     */
    for (size_t i = 0; i < 3; ++i) {
        sort_sides(boxes, i, sides);
        for (size_t k = 0; k < MEDIANS + PLACES; ++k) {
            const aur_patch_box *const some =
                &boxes->boxes[k < MEDIANS ? 0 : (2 * (k - MEDIANS) + 1) * boxes->count / (2 * PLACES)];
            tried[k][i] =
                k < MEDIANS ? median(boxes, sides, 2 - (int)k) : 0.5 * (some->lower[i] + some->upper[i]);
        }
    }
    free(sides);
    for (size_t k = 0; k < MEDIANS + PLACES; ++k) {
        const double harm = harm_of(boxes, tried[k], least);
        if (harm < least) {
            least = harm;
            memcpy(best, tried[k], sizeof best);
        }
    }
    if (at_zero > 4.0 * least)
        round_origin(boxes, best, origin);
    return AUR_OK;
}

/* Triangles that lie on each other: a box that stands exactly on a floor, say. Particles between them are on
 * the wrong side of one, so that they leave the scene. Found by a sweep along the longest side of the scene.
 */
#include <stdlib.h>

#include "transport/radiosity/solution.h"

typedef struct span {
    float low[3], high[3]; /* the triangle's box */
    uint32_t triangle;
    size_t axis;
} span;

static float coordinate(aur_vector v, size_t axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static void corners_of(const aur_radiosity_triangle *t, aur_vector corner[3]) {
    corner[0] = t->corner;
    corner[1] = aur_vector_add(t->corner, t->edge[0]);
    corner[2] = aur_vector_add(t->corner, t->edge[1]);
}

static int by_low(const void *a, const void *b) {
    const span *const left = a, *const right = b;
    const float x = left->low[left->axis], y = right->low[right->axis];
    return x < y ? -1 : x > y ? 1 : left->triangle < right->triangle ? -1 : 1;
}

static bool boxes_meet(const span *a, const span *b, float slack) {
    for (size_t k = 0; k < 3; ++k)
        if (a->low[k] > b->high[k] + slack || b->low[k] > a->high[k] + slack)
            return false;
    return true;
}

/* Whether an edge of `a` has all of `b` on its outer side, but for `slack`. */
static bool separates(const aur_radiosity_triangle *a, const aur_vector p[3], const aur_vector q[3],
                      float slack) {
    for (size_t i = 0; i < 3; ++i) {
        const aur_vector edge = aur_vector_subtract(p[(i + 1) % 3], p[i]);
        const aur_vector outwards = aur_vector_normalize(aur_vector_cross(edge, a->frame.z));
        float nearest = INFINITY;
        for (size_t k = 0; k < 3; ++k)
            nearest = fminf(nearest, aur_vector_dot(outwards, aur_vector_subtract(q[k], p[i])));
        if (nearest > -slack)
            return true;
    }
    return false;
}

static bool coincide(const aur_radiosity_triangle *a, const aur_radiosity_triangle *b) {
    const float slack = 2.0f * fmaxf(a->offset, b->offset);
    if (fabsf(aur_vector_dot(a->frame.z, b->frame.z)) < 0.9999f)
        return false;
    aur_vector p[3], q[3];
    corners_of(a, p);
    corners_of(b, q);
    for (size_t k = 0; k < 3; ++k)
        if (fabsf(aur_vector_dot(a->frame.z, aur_vector_subtract(q[k], p[0]))) > slack)
            return false;
    return !separates(a, p, q, 4.0f * slack) && !separates(b, q, p, 4.0f * slack);
}

uint64_t aur_radiosity_coincidences(const aur_radiosity_scene *scene, uint32_t where[2]) {
    aur_vector lower, upper;
    aur_scene_bounds(scene->scene, &lower, &upper);
    const aur_vector size = aur_vector_subtract(upper, lower);
    const size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    span *const spans = malloc(scene->triangle_count * sizeof *spans);
    if (spans == NULL)
        return 0; /* a courtesy that is left out */
    for (size_t i = 0; i < scene->triangle_count; ++i) {
        aur_vector corner[3];
        corners_of(&scene->triangles[i], corner);
        spans[i] = (span){.triangle = (uint32_t)i, .axis = axis};
        for (size_t k = 0; k < 3; ++k) {
            const float a = coordinate(corner[0], k), b = coordinate(corner[1], k),
                        c = coordinate(corner[2], k);
            spans[i].low[k] = fminf(a, fminf(b, c));
            spans[i].high[k] = fmaxf(a, fmaxf(b, c));
        }
    }
    qsort(spans, scene->triangle_count, sizeof *spans, by_low);
    uint64_t pairs = 0;
    for (size_t i = 0; i < scene->triangle_count; ++i) {
        const aur_radiosity_triangle *const a = &scene->triangles[spans[i].triangle];
        const float slack = 2.0f * a->offset;
        for (size_t j = i + 1; j < scene->triangle_count && spans[j].low[axis] <= spans[i].high[axis] + slack;
             ++j) {
            if (!boxes_meet(&spans[i], &spans[j], slack))
                continue;
            const aur_radiosity_triangle *const b = &scene->triangles[spans[j].triangle];
            if (!coincide(a, b))
                continue;
            if (pairs++ == 0) {
                where[0] = a->shape;
                where[1] = b->shape;
            }
        }
    }
    free(spans);
    return pairs;
}

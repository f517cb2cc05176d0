#include "points/quality/sphere/voronoi.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"

bool aur_cell_begin(aur_cell *cell, size_t cuts) {
    const size_t needed = cuts + 2;
    cell->count = 0;
    if (needed <= cell->capacity)
        return true;
    aur_cell_release(cell);
    cell->sides = malloc(needed * sizeof *cell->sides);
    cell->heights = malloc(needed * sizeof *cell->heights);
    if (cell->sides == NULL || cell->heights == NULL) {
        aur_cell_release(cell);
        return false;
    }
    cell->capacity = needed;
    return true;
}

void aur_cell_release(aur_cell *cell) {
    free(cell->sides);
    free(cell->heights);
    *cell = (aur_cell){0};
}

/* The end of a side, where `next` begins. Normals are differences of unit vectors with rounded coordinates,
 * except for the third coordinate, whose relative error is small: a great circle is off by a rounding of its
 * distance from (0, 0, 1), and a corner by that of both of its sides. */
static void join(aur_cell_side *side, const aur_cell_side *next) {
    double cross[3];
    aur_cross3(side->normal, next->normal, cross);
    const double length = aur_length3(cross);
    for (size_t d = 0; d < 3; ++d)
        side->corner[d] = cross[d] / length;
    side->reach = sqrt(side->corner[0] * side->corner[0] + side->corner[1] * side->corner[1]);
    side->slack =
        ((side->reach + side->length) * next->length + (side->reach + next->length) * side->length) / length;
}

/* The rounding error of the product of a corner and a normal, for a great circle through the corner. */
static double slack_of(const aur_cell_side *corner, double length) {
    return 4.0 * DBL_EPSILON * (corner->reach + length + length * corner->slack);
}

/* Computes the product of each corner and the cut's normal, 0 if rounding decides the sign; returns the
 * lowest. */
static double find_heights(aur_cell *cell, const aur_cell_side *cut) {
    double lowest = INFINITY;
    for (size_t k = 0; k < cell->count; ++k) {
        cell->heights[k] = aur_dot3(cell->sides[k].corner, cut->normal);
        lowest = cell->heights[k] < lowest ? cell->heights[k] : lowest;
    }
    if (lowest > 0.0) /* nearly always: the cut is outside of the cell */
        return lowest;
    lowest = INFINITY;
    for (size_t k = 0; k < cell->count; ++k) {
        if (fabs(cell->heights[k]) <= slack_of(&cell->sides[k], cut->length))
            cell->heights[k] = 0.0;
        lowest = fmin(lowest, cell->heights[k]);
    }
    return lowest;
}

/* Coincident neighbours cut identically: there is no lune between them. */
static bool is_same_circle(const aur_cell_side *side, const aur_cell_side *cut) {
    double cross[3];
    aur_cross3(side->normal, cut->normal, cross);
    return aur_length3(cross) <= 4.0 * DBL_EPSILON * (side->length + cut->length);
}

/* A lune and a great circle through both of its corners: two of the three are its sides. */
static void cut_lune(aur_cell *cell, const aur_cell_side *cut) {
    const double *const axis = cell->sides[0].corner;
    double first[3], second[3];
    aur_cross3(cell->sides[0].normal, cut->normal, first);
    aur_cross3(cut->normal, cell->sides[1].normal, second);
    const bool after = aur_dot3(axis, first) >= 0.0, before = aur_dot3(axis, second) >= 0.0;
    if (after && before)
        return;
    cell->sides[before ? 0 : 1] = *cut;
    join(&cell->sides[0], &cell->sides[1]);
    join(&cell->sides[1], &cell->sides[0]);
}

/* The corners that a cut removes, first to last, cyclically; false if it removes all, by rounding. Corners on
 * the great circle are removed with their neighbours, so that no side of length 0 remains. */
static bool find_removed(const aur_cell *cell, size_t *first, size_t *last) {
    const size_t count = cell->count;
    size_t lowest = 0;
    for (size_t k = 1; k < count; ++k)
        if (cell->heights[k] < cell->heights[lowest])
            lowest = k;
    size_t left = lowest, right = lowest, removed = 1;
    for (size_t k = (left + count - 1) % count; cell->heights[k] <= 0.0 && removed < count;
         k = (left + count - 1) % count) {
        left = k;
        ++removed;
    }
    for (size_t k = (right + 1) % count; cell->heights[k] <= 0.0 && removed < count;
         k = (right + 1) % count) {
        right = k;
        ++removed;
    }
    *first = left;
    *last = right;
    return removed < count;
}

void aur_cell_cut(aur_cell *cell, const double normal[3]) {
    aur_cell_side *const sides = cell->sides;
    aur_cell_side cut = {.normal = {normal[0], normal[1], normal[2]}, .length = aur_length3(normal)};
    const size_t count = cell->count;
    if (count == 1 && is_same_circle(&sides[0], &cut))
        return;
    if (count < 2) {
        sides[cell->count++] = cut;
        if (count == 1) {
            join(&sides[0], &sides[1]);
            join(&sides[1], &sides[0]);
        }
        return;
    }
    const double lowest = find_heights(cell, &cut);
    if (count == 2 && lowest == 0.0) {
        cut_lune(cell, &cut);
        return;
    }
    size_t first, last;
    if (!(lowest < 0.0) || !find_removed(cell, &first, &last))
        return;
    /* Side `first` ends at the cut, which ends at the side after `last`; the sides between them are removed.
     */
    const size_t after = (last + 1) % count;
    join(&sides[first], &cut);
    join(&cut, &sides[after]);
    const size_t at = first + 1;
    if (last >= first) {
        const size_t rest = count - last - 1;
        memmove(&sides[at + 1], &sides[last + 1], rest * sizeof *sides);
        sides[at] = cut;
        cell->count = at + 1 + rest;
        return;
    }
    memmove(&sides[0], &sides[after], (at - after) * sizeof *sides);
    sides[at - after] = cut;
    cell->count = at - after + 1;
}

/* The triangle of (0, 0, 1) and two unit vectors (Van Oosterom and Strackee 1983). */
static double triangle(const double a[3], const double b[3]) {
    return 2.0 * atan2(a[0] * b[1] - a[1] * b[0], 1.0 + a[2] + b[2] + aur_dot3(a, b));
}

/* A direction on a side, `angle` after its begin. */
static void along(const aur_cell_side *side, const double begin[3], double angle, double direction[3]) {
    double across[3];
    aur_cross3(side->normal, begin, across);
    for (size_t d = 0; d < 3; ++d)
        direction[d] = cos(angle) * begin[d] + sin(angle) / side->length * across[d];
}

/* Up to pi. */
static double angle_of(const aur_cell_side *side, const double begin[3]) {
    double cross[3];
    aur_cross3(begin, side->corner, cross);
    return atan2(aur_length3(cross), aur_dot3(begin, side->corner));
}

static const double *begin_of(const aur_cell *cell, size_t side) {
    return cell->sides[side > 0 ? side - 1 : cell->count - 1].corner;
}

double aur_cell_area(const aur_cell *cell) {
    if (cell->count < 2)
        return cell->count == 0 ? 4.0 * AUR_PI : 2.0 * AUR_PI;
    double sum = 0.0;
    for (size_t k = 0; k < cell->count; ++k) {
        const aur_cell_side *const side = &cell->sides[k];
        const double *const begin = begin_of(cell, k);
        if (aur_dot3(begin, side->corner) >= 0.0) {
            sum += triangle(begin, side->corner);
            continue;
        }
        double middle[3]; /* the ends of half a great circle do not determine it */
        along(side, begin, 0.5 * angle_of(side, begin), middle);
        sum += triangle(begin, middle) + triangle(middle, side->corner);
    }
    return sum;
}

/* The point of a side's great circle farthest from (0, 0, 1): as an angle, and whether it is on the side. */
static double farthest_of(const aur_cell_side *side, const double begin[3], size_t count) {
    const double distance = asin(fmin(side->normal[2] / side->length, 1.0));
    double start[3], at[3];
    if (count > 1) {
        for (size_t d = 0; d < 3; ++d)
            at[d] = side->normal[2] / (side->length * side->length) * side->normal[d];
        at[2] -= 1.0; /* away from (0, 0, 1), in the plane of the great circle */
        along(side, begin, 0.5 * AUR_PI, start);
        const double angle = atan2(aur_dot3(start, at), aur_dot3(begin, at));
        if (!(angle > 0.0 && angle < angle_of(side, begin)))
            return 0.0;
    }
    return AUR_PI - distance;
}

double aur_cell_radius(const aur_cell *cell) {
    if (cell->count == 0)
        return AUR_PI;
    double lowest = cell->sides[0].corner[2], reach = cell->sides[0].reach;
    for (size_t k = 1; k < cell->count; ++k) {
        lowest = fmin(lowest, cell->sides[k].corner[2]);
        reach = fmax(reach, cell->sides[k].reach);
    }
    if (cell->count > 2 && lowest > 0.5)
        return asin(reach);
    /* A side may be farther away between its ends. */
    double radius = cell->count > 1 ? acos(lowest) : 0.0;
    for (size_t k = 0; k < cell->count; ++k)
        radius = fmax(radius, farthest_of(&cell->sides[k], begin_of(cell, k), cell->count));
    return radius;
}

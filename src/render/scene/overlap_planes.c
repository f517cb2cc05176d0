#include "render/scene/overlap_planes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "points/base/vector3d.h"

/* A ball around a plane's normal and offset, in parts of the reach of all triangles, is put into each cell
 * that it meets; planes that are the same within rounding have a cell in common. */
enum { CELLS = 512, EXPONENTS = 257, ZERO_EXPONENT = 127 };

/* Triangles are like each other if no extent is above a power of two and no altitude below this part of it,
 * so that balls are no wider than a cell. */
enum { LIKE_BITS = 7 };

/* Fewer triangles are all looked at. */
enum { FEW = 64 };

typedef struct row {
    float normal[3], offset; /* from the first triangle's first corner */
    float extent, altitude;  /* altitude 0: without area */
} row;

typedef struct planes {
    size_t count;
    row *rows;
    double reach, largest;
    float most, least; /* the extent and altitude of triangles that are like each other */
    uint64_t *table;
    size_t table_size, filled;
} planes;

static inline double larger_of(double a, double b) {
    return a > b ? a : b;
}

/* Returns the square of the longest side. */
static double describe(const double corners[3][3], const double start[3], row *r) {
    double sides[3][3], normal[3], longest = 0.0, extent = 0.0, offset = 0.0;
    for (size_t c = 0; c < 3; ++c) {
        for (size_t d = 0; d < 3; ++d) {
            sides[c][d] = corners[(c + 1) % 3][d] - corners[c][d];
            extent = larger_of(extent, fabs(sides[c][d]));
        }
        longest = larger_of(longest, aur_dot3(sides[c], sides[c]));
    }
    aur_cross3(sides[0], sides[1], normal);
    const double length = aur_length3(normal), scale = length > 0.0 ? 1.0 / length : 0.0;
    for (size_t d = 0; d < 3; ++d) {
        r->normal[d] = (float)(normal[d] * scale);
        offset += normal[d] * (corners[0][d] - start[d]);
    }
    r->offset = (float)(offset * scale);
    r->extent = (float)extent;
    r->altitude = length > 0.0 ? (float)(length / sqrt(longest)) : 0.0F;
    return longest;
}

static void describe_all(planes *p, const aur_triangle_source *triangles) {
    double corners[3][3], start[3], far = 0.0, longest = 0.0;
    triangles->corners(triangles->context, 0, corners);
    memcpy(start, corners[0], sizeof start);
    for (size_t i = 0; i < p->count; ++i) {
        triangles->corners(triangles->context, i, corners);
        longest = larger_of(longest, describe((const double(*)[3])corners, start, &p->rows[i]));
        double away = 0.0;
        for (size_t d = 0; d < 3; ++d)
            away += (corners[0][d] - start[d]) * (corners[0][d] - start[d]);
        far = larger_of(far, away);
    }
    /* No corner is farther from the start, and no coordinate larger. */
    p->reach = sqrt(far) + sqrt(longest);
    p->largest = p->reach + larger_of(fabs(start[0]), larger_of(fabs(start[1]), fabs(start[2])));
}

/* x <= 2^(this - ZERO_EXPONENT), and more than half of that; of 0 and numbers without normal form 0. */
static uint32_t exponent_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (bits >> 23 & 0xff) + ((bits & 0x7fffff) != 0);
}

/* The power of two with which most triangles are like each other. */
static void choose_size(planes *p) {
    size_t extents[EXPONENTS] = {0}, altitudes[EXPONENTS] = {0};
    size_t above = 0, below = 0, least = SIZE_MAX;
    for (size_t i = 0; i < p->count; ++i)
        if (p->rows[i].altitude > 0.0F) {
            ++extents[exponent_of(p->rows[i].extent)];
            ++altitudes[exponent_of(p->rows[i].altitude)];
            ++above;
        }
    for (int k = LIKE_BITS; k < EXPONENTS; ++k) {
        above -= extents[k];
        below += altitudes[k - LIKE_BITS];
        if (above + below < least) {
            least = above + below;
            p->most = ldexpf(1.0F, k - ZERO_EXPONENT);
        }
    }
}

/* Marks the triangle and the first one in this cell. False: the table is full. */
static bool enter(planes *p, const uint32_t cell[4], size_t index, uint8_t *marks) {
    uint64_t hash = cell[0];
    for (size_t k = 1; k < 4; ++k)
        hash = hash << 12 | cell[k];
    hash = aur_mix64(hash);
    const uint64_t tag = hash & ~(uint64_t)UINT32_MAX;
    for (size_t at = hash & (p->table_size - 1);; at = (at + 1) & (p->table_size - 1)) {
        const uint64_t found = p->table[at];
        const uint32_t first = (uint32_t)found - 1;
        if (found == 0) {
            p->table[at] = tag | (uint32_t)(index + 1);
            return ++p->filled <= p->table_size / 4 * 3;
        }
        if ((found & ~(uint64_t)UINT32_MAX) != tag)
            continue;
        if (first != index)
            marks[first] = marks[index] = AUR_PLANE_SHARED;
        return true;
    }
}

/* Enters a ball into all cells that it meets. */
static bool enter_ball(planes *p, const float middle[4], const float radius[2], size_t index,
                       uint8_t *marks) {
    uint32_t low[4], high[4];
    uint32_t both = 0; /* bits of the sides on which it lies in two cells */
    for (size_t k = 0; k < 4; ++k) {
        low[k] = (uint32_t)((middle[k] - radius[k / 3] + 2.0F) * (float)CELLS);
        high[k] = (uint32_t)((middle[k] + radius[k / 3] + 2.0F) * (float)CELLS);
        both |= (uint32_t)(low[k] != high[k]) << k;
    }
    for (uint32_t sides = 0; sides < 16; ++sides) {
        if ((sides & ~both) != 0)
            continue;
        uint32_t cell[4];
        for (size_t k = 0; k < 4; ++k)
            cell[k] = (sides >> k & 1) != 0 ? high[k] : low[k];
        if (!enter(p, cell, index, marks))
            return false;
        if (both == 0)
            break;
    }
    return true;
}

/* Planes are the same whichever way they look: the normal is turned to one side, and counts for both sides
 * near its edge. */
static bool enter_plane(planes *p, size_t index, double slack, uint8_t *marks) {
    static const float side[3] = {0.531F, 0.617F, 0.581F};
    const row *const r = &p->rows[index];
    /* More than floats round. */
    const float tilt = (float)aur_overlap_tilt(slack, (double)r->altitude) + 1e-6F;
    const float radius[2] = {tilt, tilt + (float)(slack / p->reach)};
    const float along = r->normal[0] * side[0] + r->normal[1] * side[1] + r->normal[2] * side[2];
    const float sign = along < 0.0F ? -1.0F : 1.0F, offset = (float)((double)r->offset / p->reach);
    const float middle[4] = {sign * r->normal[0], sign * r->normal[1], sign * r->normal[2], sign * offset},
                turned[4] = {-middle[0], -middle[1], -middle[2], -middle[3]};
    return enter_ball(p, middle, radius, index, marks) &&
           (sign * along > 2.0F * tilt || enter_ball(p, turned, radius, index, marks));
}

static bool mark(planes *p, uint8_t *marks, size_t *unlike) {
    p->least = ldexpf(p->most, -LIKE_BITS);
    const double slack = aur_overlap_slack((double)p->most, p->largest);
    const double widest = aur_overlap_tilt(slack, (double)p->least);
    /* Far from the origin, where coordinates are too coarse, balls would have more cells than two a side. */
    bool good = 2.0 * (widest + 2e-6 + slack / p->reach) * CELLS < 1.0 && p->reach > 0.0;
    *unlike = 0;
    for (size_t i = 0; i < p->count && good; ++i) {
        const row *const r = &p->rows[i];
        if (r->altitude == 0.0F)
            continue;
        if (r->extent <= p->most && r->altitude >= p->least) {
            good = enter_plane(p, i, slack, marks);
        } else {
            marks[i] = AUR_PLANE_UNLIKE;
            ++*unlike;
        }
    }
    return good;
}

size_t aur_planes_mark(const aur_triangle_source *triangles, uint8_t *marks) {
    planes p = {.count = triangles->count, .table_size = 64};
    if (p.count < FEW) {
        memset(marks, AUR_PLANE_UNLIKE, p.count);
        return p.count;
    }
    while (p.table_size < 2 * p.count)
        p.table_size *= 2;
    p.rows = malloc(p.count * sizeof *p.rows);
    p.table = calloc(p.table_size, sizeof *p.table);
    size_t unlike = SIZE_MAX;
    if (p.rows != NULL && p.table != NULL) {
        memset(marks, AUR_PLANE_ALONE, p.count);
        describe_all(&p, triangles);
        choose_size(&p);
        if (!mark(&p, marks, &unlike)) {
            memset(marks, AUR_PLANE_UNLIKE, p.count);
            unlike = p.count;
        }
    }
    free(p.rows);
    free(p.table);
    return unlike;
}

#include "scene/overlap_planes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "core/vector3d.h"

/* A ball around a plane's normal and offset, in parts of the reach of all triangles, is put into each cell
 * that it meets; planes that are the same within rounding have a cell in common. */
enum { CELLS = 512, EXPONENTS = 320, ZERO_EXPONENT = 160 };

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
    float most; /* the extent of triangles that are like each other */
    uint64_t *table;
    size_t table_size, filled;
} planes;

static inline float larger(float a, float b) {
    return a > b ? a : b;
}

/* Reads all triangles. */
static void describe(planes *p, const aur_triangle_source *triangles) {
    double corners[3][3], start[3], reach = 0.0, largest = 0.0;
    triangles->corners(triangles->context, 0, corners);
    memcpy(start, corners[0], sizeof start);
    for (size_t i = 0; i < p->count; ++i) {
        double sides[3][3], normal[3], longest = 0.0, extent = 0.0, far = 0.0;
        triangles->corners(triangles->context, i, corners);
        for (size_t c = 0; c < 3; ++c) {
            double square = 0.0, away = 0.0;
            for (size_t d = 0; d < 3; ++d) {
                const double side = sides[c][d] = corners[(c + 1) % 3][d] - corners[c][d];
                const double from = corners[c][d] - start[d], at = fabs(corners[c][d]);
                square += side * side;
                away += from * from;
                extent = fabs(side) > extent ? fabs(side) : extent;
                largest = at > largest ? at : largest;
            }
            longest = square > longest ? square : longest;
            far = away > far ? away : far;
        }
        aur_cross3(sides[0], sides[1], normal);
        const double length = aur_length3(normal), scale = length > 0.0 ? 1.0 / length : 0.0;
        double offset = 0.0;
        for (size_t d = 0; d < 3; ++d) {
            p->rows[i].normal[d] = (float)(normal[d] *= scale);
            offset += normal[d] * (corners[0][d] - start[d]);
        }
        p->rows[i].offset = (float)offset;
        p->rows[i].extent = (float)extent;
        p->rows[i].altitude = length > 0.0 ? (float)(length / sqrt(longest)) : 0.0F;
        reach = far > reach ? far : reach;
    }
    p->reach = sqrt(reach);
    p->largest = largest;
}

static int exponent_of(float x) {
    int exponent;
    (void)frexpf(fminf(x, FLT_MAX), &exponent);
    return exponent + ZERO_EXPONENT;
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

static bool is_like(const planes *p, const row *r) {
    return r->extent <= p->most && r->altitude >= ldexpf(p->most, -LIKE_BITS);
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
            return ++p->filled <= p->table_size / 2;
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
    const float middle[4] = {r->normal[0], r->normal[1], r->normal[2], (float)((double)r->offset / p->reach)};
    for (float sign = -1.0F; sign < 2.0F; sign += 2.0F) {
        if (sign * along < -2.0F * tilt)
            continue;
        const float turned[4] = {sign * middle[0], sign * middle[1], sign * middle[2], sign * middle[3]};
        if (!enter_ball(p, turned, radius, index, marks))
            return false;
    }
    return true;
}

static bool mark(planes *p, uint8_t *marks, size_t *unlike) {
    const double slack = aur_overlap_slack((double)p->most, p->largest);
    const double widest = aur_overlap_tilt(slack, (double)ldexpf(p->most, -LIKE_BITS));
    /* Far from the origin, where coordinates are too coarse, balls would have more cells than two a side. */
    bool good = 2.0 * (widest + 2e-6 + slack / p->reach) * CELLS < 1.0 && p->reach > 0.0;
    *unlike = 0;
    for (size_t i = 0; i < p->count && good; ++i) {
        const row *const r = &p->rows[i];
        if (r->altitude == 0.0F)
            continue;
        if (is_like(p, r)) {
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
    while (p.table_size < 4 * p.count)
        p.table_size *= 2;
    p.rows = malloc(p.count * sizeof *p.rows);
    p.table = calloc(p.table_size, sizeof *p.table);
    size_t unlike = SIZE_MAX;
    if (p.rows != NULL && p.table != NULL) {
        memset(marks, AUR_PLANE_ALONE, p.count);
        describe(&p, triangles);
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

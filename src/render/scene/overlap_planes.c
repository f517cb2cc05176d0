#include "render/scene/overlaps.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "points/base/vector3d.h"

/* A ball around a plane's normal and offset, relative to the reach of all triangles, is entered into each
 * cell that it meets. Planes that are equal within rounding share a cell. */
enum { FEWEST_CELLS = 512, MOST_CELLS = 2048, CELL_BITS = 14, EXPONENTS = 257, ZERO_EXPONENT = 127 };

/* Triangles are of typical size if no extent is above a power of two and no altitude below a fraction of it:
 * 2^-FINE_BITS, or 2^-LIKE_BITS if that includes more triangles. Balls are then no wider than a cell. */
enum { FINE_BITS = 3, LIKE_BITS = 7 };

/* Up to FEW triangles are all compared. SAMPLES triangles determine the typical size. */
enum { FEW = 64, SAMPLES = 1024 };

/* Triangles of other sizes are UNLIKE, so that products of four edges are in the range of floats. */
enum { LEAST_EXPONENT = ZERO_EXPONENT - 28, MOST_EXPONENT = ZERO_EXPONENT + 28 };

/* Triangles per block, processed in floats by vector loops. */
enum { BLOCK = 64 };

/* Floats change normals by less than a quarter of aur_overlap_tilt. */
typedef struct block {
    float sides[2][3][BLOCK], from[3][BLOCK]; /* relative to the first corner of the first triangle */
    float extent[BLOCK], altitude[BLOCK];
    float away[BLOCK];      /* distance of the farthest point, plus twice the longest edge */
    float plane[4][BLOCK];  /* normal and offset, relative to the reach, with a canonical sign */
    float tilt[BLOCK];      /* radius of the ball */
    int32_t on_edge[BLOCK]; /* whether the plane with the opposite sign counts too */
    uint32_t low[2][BLOCK], high[2][BLOCK]; /* cells, two per axis, CELL_BITS each */
} block;

typedef struct planes {
    const aur_triangle_source *triangles;
    double start[3];
    float reach;       /* of triangles of typical size: the largest `away`, */
    float most, least; /* the largest extent and the least altitude */
    float slack;       /* relative to the reach */
    float cells;       /* per unit */
    uint8_t *marks;
    uint64_t *table;
    size_t table_size, filled;
} planes;

static inline float larger_of(float a, float b) {
    return a > b ? a : b;
}

static inline float length_of(float x, float y, float z) {
    return sqrtf(x * x + y * y + z * z);
}

static void load(const planes *p, size_t first, size_t count, size_t offset, block *b) {
    double corners[BLOCK][3][3];
    p->triangles->corners(p->triangles->context, first, count, corners);
    for (size_t k = 0; k < count; ++k)
        for (size_t d = 0; d < 3; ++d) {
            b->sides[0][d][offset + k] = (float)(corners[k][1][d] - corners[k][0][d]);
            b->sides[1][d][offset + k] = (float)(corners[k][2][d] - corners[k][0][d]);
            b->from[d][offset + k] = (float)(corners[k][0][d] - p->start[d]);
        }
}

static void describe(const planes *p, block *b) {
    const float inverse = p->reach > 0.0F ? 1.0F / p->reach : 0.0F, scaled = 5.0F * p->slack * p->reach;
    for (size_t i = 0; i < BLOCK; ++i) {
        const float ax = b->sides[0][0][i], ay = b->sides[0][1][i], az = b->sides[0][2][i];
        const float bx = b->sides[1][0][i], by = b->sides[1][1][i], bz = b->sides[1][2][i];
        const float cx = bx - ax, cy = by - ay, cz = bz - az;
        const float fx = b->from[0][i], fy = b->from[1][i], fz = b->from[2][i];
        const float widest =
            larger_of(larger_of(larger_of(fabsf(ax), fabsf(ay)), larger_of(fabsf(az), fabsf(bx))),
                      larger_of(larger_of(fabsf(by), fabsf(bz)), larger_of(fabsf(cx), fabsf(cy))));
        b->extent[i] = larger_of(widest, fabsf(cz));
        const float longest =
            larger_of(length_of(ax, ay, az), larger_of(length_of(bx, by, bz), length_of(cx, cy, cz)));
        const float nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
        /* All zero for a degenerate triangle. */
        const float length = length_of(nx, ny, nz), scale = 1.0F / larger_of(length, FLT_MIN);
        b->altitude[i] = length / larger_of(longest, FLT_MIN);
        b->away[i] = length_of(fx, fy, fz) + 3.0F * longest;
        b->tilt[i] = scaled / larger_of(b->altitude[i], FLT_MIN) + 1e-6F;
        const float along = scale * (0.531F * nx + 0.617F * ny + 0.581F * nz),
                    signed_scale = along < 0.0F ? -scale : scale;
        b->plane[0][i] = nx * signed_scale;
        b->plane[1][i] = ny * signed_scale;
        b->plane[2][i] = nz * signed_scale;
        b->plane[3][i] = (nx * fx + ny * fy + nz * fz) * signed_scale * inverse;
        b->on_edge[i] = fabsf(along) <= 2.0F * b->tilt[i];
    }
}

/* The exponent: x <= 2^(this - ZERO_EXPONENT), and more than half of that; of zero and subnormal numbers 0.
 */
static uint32_t exponent_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (bits >> 23 & 0xff) + ((bits & 0x7fffff) != 0);
}

/* How many triangles have each exponent. */
typedef struct sizes {
    size_t count, extents[EXPONENTS], altitudes[EXPONENTS];
} sizes;

/* The least number of triangles that are unlike the others with so many bits, and the largest extent of the
 * others. */
static size_t least_unlike(const sizes *all, int bits, float *most) {
    size_t above = all->count, below = 0, least = SIZE_MAX;
    for (int k = 0; k <= MOST_EXPONENT; ++k) {
        above -= all->extents[k];
        below += k >= bits ? all->altitudes[k - bits] : 0;
        if (k >= LEAST_EXPONENT + LIKE_BITS && above + below < least) {
            least = above + below;
            *most = ldexpf(1.0F, k - ZERO_EXPONENT);
        }
    }
    return least;
}

/* The size of most triangles, from a sample. False: there is no typical size. */
static bool choose_sizes(planes *p) {
    const size_t count = p->triangles->count;
    sizes all = {0};
    float away = 0.0F;
    block b;
    for (size_t i = 0; i < SAMPLES; ++i) {
        load(p, count > SAMPLES ? aur_mix64(i) % count : i % count, 1, i % BLOCK, &b);
        if ((i + 1) % BLOCK != 0)
            continue;
        describe(p, &b);
        for (size_t k = 0; k < BLOCK; ++k) {
            away = larger_of(away, b.away[k]);
            if (!(b.altitude[k] > 0.0F))
                continue;
            ++all.extents[exponent_of(b.extent[k])];
            ++all.altitudes[exponent_of(b.altitude[k])];
            ++all.count;
        }
    }
    const size_t least = least_unlike(&all, LIKE_BITS, &p->most);
    int bits = FINE_BITS;
    while (least_unlike(&all, bits, &p->most) > least)
        ++bits;
    p->least = ldexpf(p->most, -bits);
    p->reach = 2.0F * away;
    const double largest =
                     (double)p->reach + fmax(fabs(p->start[0]), fmax(fabs(p->start[1]), fabs(p->start[2]))),
                 slack = aur_overlap_slack((double)p->most, largest);
    p->slack = (float)(slack / (double)p->reach);
    const double width = 2.0 * (1.25 * aur_overlap_tilt(slack, (double)p->least) + 2e-6 + (double)p->slack);
    /* Few balls should meet several cells. */
    for (p->cells = FEWEST_CELLS; p->cells < MOST_CELLS && 2.0 * width * (double)p->cells < 0.25;)
        p->cells *= 2.0F;
    /* Far from the origin, where coordinates are too coarse, balls would meet more than two cells per axis.
     */
    return p->reach > 0.0F && p->reach < 1e18F && width * (double)p->cells < 1.0;
}

/* Marks the triangle and the first one in this cell. False: the table is full. */
static inline bool enter(planes *p, const uint32_t cell[2], size_t index) {
    const uint64_t hash = aur_mix64((uint64_t)cell[0] << 32 | cell[1]);
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
            p->marks[first] = p->marks[index] = AUR_PLANE_SHARED;
        return true;
    }
}

static inline uint32_t cell_of(float x, float cells) {
    const float above = larger_of(x, -1.9F), within = above < 1.9F ? above : 1.9F;
    return (uint32_t)(int32_t)((within + 2.0F) * cells);
}

/* The cells that the ball meets: at most two per axis. */
static void find_cells(const planes *p, block *b, float sign) {
    const float cells = p->cells;
    for (size_t k = 0; k < 2; ++k) {
        const float slack = k == 1 ? p->slack : 0.0F;
        for (size_t i = 0; i < BLOCK; ++i) {
            const float x = sign * b->plane[2 * k][i], y = sign * b->plane[2 * k + 1][i], tilt = b->tilt[i];
            b->low[k][i] = cell_of(x - tilt, cells) << CELL_BITS | cell_of(y - tilt - slack, cells);
            b->high[k][i] = cell_of(x + tilt, cells) << CELL_BITS | cell_of(y + tilt + slack, cells);
        }
    }
}

/* Enters a ball into all cells that it meets. */
static bool enter_ball(planes *p, const block *b, size_t i, size_t index) {
    const uint32_t low[2] = {b->low[0][i], b->low[1][i]}, high[2] = {b->high[0][i], b->high[1][i]};
    if (low[0] == high[0] && low[1] == high[1])
        return enter(p, low, index);
    static const uint32_t masks[4] = {0, (1U << CELL_BITS) - 1, ~0U << CELL_BITS, ~0U};
    const uint32_t apart[2] = {low[0] ^ high[0], low[1] ^ high[1]};
    /* Bit mask of the axes with two cells. */
    const uint32_t both =
        (uint32_t)((apart[0] & masks[1]) != 0) | (uint32_t)((apart[0] & masks[2]) != 0) << 1 |
        (uint32_t)((apart[1] & masks[1]) != 0) << 2 | (uint32_t)((apart[1] & masks[2]) != 0) << 3;
    for (uint32_t sides = 0; sides <= both; ++sides) {
        if ((sides & ~both) != 0)
            continue;
        const uint32_t cell[2] = {low[0] ^ (apart[0] & masks[sides & 3]),
                                  low[1] ^ (apart[1] & masks[sides >> 2])};
        if (!enter(p, cell, index))
            return false;
    }
    return true;
}

/* In floats, narrow triangles may have lost their area. */
static bool has_area(const planes *p, size_t index) {
    double corners[3][3];
    aur_plane plane;
    p->triangles->corners(p->triangles->context, index, 1, &corners);
    return aur_polygon_plane(3, (const double(*)[3])corners, &plane) > 0.0;
}

static bool is_like(const planes *p, const block *b, size_t i) {
    return b->extent[i] <= p->most && b->altitude[i] >= p->least && b->away[i] <= p->reach;
}

/* Opposite normals describe the same plane: the normal gets a canonical sign, and near the sign change both
 * signs are entered. */
static bool mark_block(planes *p, block *b, size_t first, size_t count, size_t *unlike) {
    bool any_on_edge = false, good = true;
    load(p, first, count, 0, b);
    describe(p, b);
    find_cells(p, b, 1.0F);
    for (size_t i = 0; i < count && good; ++i)
        if (is_like(p, b, i)) {
            good = enter_ball(p, b, i, first + i);
            any_on_edge |= b->on_edge[i];
        } else if (has_area(p, first + i)) {
            p->marks[first + i] = AUR_PLANE_UNLIKE;
            ++*unlike;
        }
    if (any_on_edge)
        find_cells(p, b, -1.0F);
    for (size_t i = 0; i < count && good && any_on_edge; ++i)
        if (b->on_edge[i] && is_like(p, b, i))
            good = enter_ball(p, b, i, first + i);
    return good;
}

static bool mark(planes *p, size_t *unlike) {
    const size_t count = p->triangles->count;
    bool good = choose_sizes(p);
    block b = {0};
    for (size_t first = 0; first < count && good; first += BLOCK)
        good = mark_block(p, &b, first, count - first < BLOCK ? count - first : BLOCK, unlike);
    return good;
}

size_t aur_planes_mark(const aur_triangle_source *triangles, uint8_t *marks) {
    const size_t count = triangles->count;
    planes p = {.triangles = triangles, .marks = marks, .table_size = 64};
    while (p.table_size < 2 * count)
        p.table_size *= 2;
    p.table = count >= FEW ? calloc(p.table_size, sizeof *p.table) : NULL;
    if (p.table == NULL && count >= FEW)
        return SIZE_MAX;
    double corners[3][3];
    triangles->corners(triangles->context, 0, 1, &corners);
    memcpy(p.start, corners[0], sizeof p.start);
    memset(marks, AUR_PLANE_ALONE, count);
    size_t unlike = 0;
    if (count < FEW || !mark(&p, &unlike)) {
        memset(marks, AUR_PLANE_UNLIKE, count);
        unlike = count;
    }
    free(p.table);
    return unlike;
}

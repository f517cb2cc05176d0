#include "render/scene/importers/meshes/triangulate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/vector3d.h"
#include "render/scene/importers/meshes/ring.h"

/* --- canonical order of corners */

static int compare_points(const double *a, const double *b) {
    for (int d = 0; d < 3; ++d)
        if (a[d] != b[d])
            return a[d] < b[d] ? -1 : 1;
    return 0;
}

/* Corners in order, forwards or backwards from the last one. */
typedef struct reading {
    size_t count;
    const uint32_t *corners; /* corners that differ from their predecessor */
    const double (*points)[3];
    bool backwards;
} reading;

static uint32_t corner_at(const reading *r, size_t i) {
    i %= r->count;
    return r->corners[r->backwards ? r->count - 1 - i : i];
}

static int compare_at(const reading *a, size_t i, const reading *b, size_t k) {
    return compare_points(a->points[corner_at(a, i)], b->points[corner_at(b, k)]);
}

/* Start of the lexicographically smallest rotation (Shiloach 1981). */
static size_t least_start(const reading *r) {
    size_t i = 0, k = 1, same = 0;
    while (i < r->count && k < r->count && same < r->count) {
        const int order = compare_at(r, i + same, r, k + same);
        if (order == 0) {
            ++same;
            continue;
        }
        if (order > 0)
            i += same + 1;
        else
            k += same + 1;
        k += i == k;
        same = 0;
    }
    return i < k ? i : k;
}

/* Rotates and, if smaller, reverses the corners to the lexicographically smallest order. Returns whether it
 * is reversed. */
static bool order_corners(size_t count, const uint32_t *corners, const double (*points)[3], uint32_t *order) {
    const reading ways[2] = {{count, corners, points, false}, {count, corners, points, true}};
    const size_t starts[2] = {least_start(&ways[0]), least_start(&ways[1])};
    int compared = 0;
    for (size_t i = 0; i < count && compared == 0; ++i)
        compared = compare_at(&ways[0], starts[0] + i, &ways[1], starts[1] + i);
    const size_t way = compared > 0;
    for (size_t i = 0; i < count; ++i)
        order[i] = corner_at(&ways[way], starts[way] + i);
    return way == 1;
}

/* --- projection to a plane */

typedef struct face {
    size_t count;
    const double (*points)[3];
    uint32_t *order;
    double normal[3], area, size, height; /* height: the largest distance of a corner from the plane */
} face;

static void find_plane(face *f) {
    const double *const origin = f->points[f->order[0]];
    double mean[3] = {0.0, 0.0, 0.0}, low[3] = {0.0, 0.0, 0.0}, high[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < f->count; ++i) {
        const double *const p = f->points[f->order[i]], *const q = f->points[f->order[(i + 1) % f->count]];
        double a[3], b[3], c[3];
        for (int d = 0; d < 3; ++d) {
            a[d] = p[d] - origin[d];
            b[d] = q[d] - origin[d];
            mean[d] += a[d] / (double)f->count;
            low[d] = fmin(low[d], a[d]);
            high[d] = fmax(high[d], a[d]);
        }
        aur_cross3(a, b, c);
        for (int d = 0; d < 3; ++d)
            f->normal[d] += 0.5 * c[d];
    }
    f->area = aur_normalize3(f->normal);
    f->size = hypot(hypot(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
    for (size_t i = 0; i < f->count; ++i) {
        double way[3];
        for (int d = 0; d < 3; ++d)
            way[d] = f->points[f->order[i]][d] - origin[d] - mean[d];
        f->height = fmax(f->height, fabs(aur_dot3(way, f->normal)));
    }
}

/* --- entry points */

/* A convex quadrilateral is split along its shorter diagonal; if both are equal, along that of the first
 * corner. */
static bool cut_four(const face *f, aur_ring *r) {
    double squares[2] = {0.0, 0.0};
    if (f->count != 4)
        return false;
    for (uint32_t i = 0; i < 4; ++i)
        if (!(aur_ring_turn(r, r->previous[i], i, r->next[i]) > 0.0))
            return false;
    for (size_t i = 0; i < 2; ++i)
        for (int d = 0; d < 3; ++d) {
            const double way = f->points[f->order[i + 2]][d] - f->points[f->order[i]][d];
            squares[i] += way * way;
        }
    const uint32_t first = squares[1] < (1.0 - 1e-6) * squares[0];
    for (uint32_t i = first; i < 4; i += 2) {
        const uint32_t ear = i ^ 1u; /* corners 1 and 3, or 0 and 2 */
        aur_ring_take(r, (const uint32_t[3]){r->previous[ear], ear, r->next[ear]});
    }
    return true;
}

/* Projects the face along the axis nearest to its normal. Returns whether the result is clockwise. */
static bool project(const face *f, double (*points)[2]) {
    int axis = 0;
    for (int d = 1; d < 3; ++d)
        if (fabs(f->normal[d]) > fabs(f->normal[axis]))
            axis = d;
    for (size_t i = 0; i < f->count; ++i)
        for (int d = 0; d < 2; ++d)
            points[i][d] = f->points[f->order[i]][(axis + 1 + d) % 3];
    return f->normal[axis] < 0.0;
}

static bool cut_face(const face *f, const double (*points)[2], bool turned, aur_ring *r) {
    r->slack = 1e-6 * f->size + f->height;
    for (int rounded = 0; rounded < 2; ++rounded) {
        aur_ring_link(r, f->count, points, turned, rounded != 0);
        if (rounded == 0 && cut_four(f, r))
            return true;
        if (aur_ring_crosses_itself(r))
            return false;
        if (aur_ring_cut(r))
            return true;
    }
    return false;
}

/* Triangles of corner indices, with the winding of the outline. */
static void number_corners(const face *f, bool turned, aur_ring *r) {
    for (size_t i = 0; i < r->triangle_count; ++i) {
        uint32_t *const t = &r->triangles[3 * i];
        const uint32_t last = t[2];
        t[2] = turned ? t[1] : last;
        t[1] = turned ? last : t[1];
        for (size_t k = 0; k < 3; ++k)
            t[k] = f->order[r->corner[t[k]]];
    }
}

static size_t corner_bytes(size_t count, size_t size) {
    return (count * size + 15) / 16 * 16;
}

static bool reserve(aur_triangulator *self, size_t needed) {
    if (needed <= self->capacity)
        return true;
    free(self->memory);
    self->memory = malloc(needed);
    self->capacity = self->memory != NULL ? needed : 0;
    return self->memory != NULL;
}

bool aur_triangulate(aur_triangulator *self, size_t count, const double (*corners)[3], aur_face_cut *cut) {
    *cut = (aur_face_cut){.flaw = AUR_FACE_EMPTY};
    const size_t of_numbers = corner_bytes(count, sizeof(uint32_t)),
                 of_points = corner_bytes(count, sizeof(double[2]));
    if (!reserve(self, 2 * of_numbers + of_points + aur_ring_size(count)))
        return false;
    char *const memory = self->memory;
    uint32_t *const distinct = (uint32_t *)(void *)memory;
    double(*const points)[2] = (double(*)[2])(void *)(memory + 2 * of_numbers);
    face f = {.points = corners, .order = (uint32_t *)(void *)(memory + of_numbers)};
    for (size_t i = 0; i < count; ++i)
        if (compare_points(corners[i], corners[i > 0 ? i - 1 : count - 1]) != 0)
            distinct[f.count++] = (uint32_t)i;
    if (f.count < 3)
        return true;
    const bool backwards = order_corners(f.count, distinct, corners, f.order);
    find_plane(&f);
    cut->first = f.order[0];
    cut->area = f.area;
    if (!(f.area > 1e-10 * f.size * f.size))
        return true;
    for (int d = 0; d < 3; ++d)
        cut->normal[d] = backwards ? -f.normal[d] : f.normal[d];
    const bool turned = project(&f, points);
    aur_ring r;
    aur_ring_place(&r, count, memory + 2 * of_numbers + of_points);
    if (!cut_face(&f, (const double(*)[2])points, turned, &r)) {
        cut->flaw = AUR_FACE_CROSSED;
        return true;
    }
    number_corners(&f, turned != backwards, &r);
    cut->flaw = f.height > 1e-3 * f.size ? AUR_FACE_BENT : AUR_FACE_GOOD;
    cut->triangle_count = r.triangle_count;
    cut->indices = r.triangles;
    return true;
}

void aur_triangulator_release(aur_triangulator *self) {
    free(self->memory);
    *self = (aur_triangulator){0};
}

void aur_face_flaws_count(aur_face_flaws *flaws, aur_face_flaw flaw, size_t line) {
    if (flaws->counts[flaw]++ == 0) {
        flaws->first[flaw] = flaws->face_count;
        flaws->lines[flaw] = line;
    }
    ++flaws->face_count;
}

const char *aur_face_flaw_text(aur_face_flaw flaw) {
    static const char *const texts[AUR_FACE_FLAW_COUNT] = {
        [AUR_FACE_GOOD] = "are plane",
        [AUR_FACE_BENT] = "have corners outside of their plane and become triangles at an angle",
        [AUR_FACE_EMPTY] = "have no area and are left out",
        [AUR_FACE_CROSSED] = "have an outline that crosses itself and are left out"};
    return texts[flaw];
}

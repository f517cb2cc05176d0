/* The covering radius of rotations, exactly. In the gnomonic projection about a quaternion its Voronoi cell
 * on the three-sphere is a convex polyhedron, cut by one plane for each neighbour, as cells on the sphere are
 * polygons (sphere/voronoi.c). A polyhedron is stored as its corners, each the intersection of three planes
 * in cyclic order (the dual triangles of Ray, Sokolov, Lefebvre and Levy 2018). */
#include <math.h>
#include <stdlib.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/base/vector3d.h"
#include "points/quality/rotations/rotations.h"
#include "points/sphere/map.h"
#include "points/sphere/nearest/inverse.h"

/* Half the side of the initial polyhedron, as a tangent: almost 90 degrees. */
static const double horizon = 1e6;

/* A corner beyond a plane by less than this fraction of its distance is on it: where more than three planes
 * meet in a point, all its corners are then treated equally. */
static const double on_plane = 1e-11;

typedef struct plane {
    double normal[3], offset; /* the cell has normal . p <= offset */
} plane;

typedef struct corner {
    double at[3];
    size_t planes[3];
} corner;

typedef struct polyhedron {
    size_t plane_count, plane_capacity;
    plane *planes;
    size_t corner_count, corner_capacity;
    corner *corners;
    size_t cut_capacity;
    size_t *cut; /* corners removed by a plane, three planes each */
} polyhedron;

static void release(polyhedron *p) {
    free(p->planes);
    free(p->corners);
    free(p->cut);
}

/* The intersection of three planes (Cramer). */
static void meet(const polyhedron *p, corner *c) {
    const plane *const a = &p->planes[c->planes[0]], *const b = &p->planes[c->planes[1]];
    const plane *const d = &p->planes[c->planes[2]];
    double bd[3], da[3], ab[3];
    aur_cross3(b->normal, d->normal, bd);
    aur_cross3(d->normal, a->normal, da);
    aur_cross3(a->normal, b->normal, ab);
    const double volume = aur_dot3(a->normal, bd);
    for (size_t k = 0; k < 3; ++k)
        c->at[k] = (a->offset * bd[k] + b->offset * da[k] + d->offset * ab[k]) / volume;
}

static bool add_plane(polyhedron *p, plane added) {
    if (!aur_array_reserve(&p->planes, &p->plane_capacity, p->plane_count + 1, sizeof *p->planes))
        return false;
    p->planes[p->plane_count++] = added;
    return true;
}

static bool add_corner(polyhedron *p, size_t a, size_t b, size_t c) {
    if (!aur_array_reserve(&p->corners, &p->corner_capacity, p->corner_count + 1, sizeof *p->corners))
        return false;
    corner *const added = &p->corners[p->corner_count++];
    *added = (corner){.planes = {a, b, c}};
    meet(p, added);
    return true;
}

/* Planes 2d and 2d + 1 are the sides to the positive and the negative of axis d. */
static bool start(polyhedron *p) {
    p->plane_count = p->corner_count = 0;
    for (size_t side = 0; side < 6; ++side) {
        plane wall = {.offset = horizon};
        wall.normal[side / 2] = side % 2 == 0 ? 1.0 : -1.0;
        if (!add_plane(p, wall))
            return false;
    }
    for (size_t c = 0; c < 8; ++c) {
        const size_t x = c & 1, y = 2 + (c >> 1 & 1), z = 4 + (c >> 2 & 1);
        const bool mirrored = ((c ^ c >> 1 ^ c >> 2) & 1) != 0;
        if (!(mirrored ? add_corner(p, y, x, z) : add_corner(p, x, y, z)))
            return false;
    }
    return true;
}

/* Whether one of the `count` corners in `cut` has the edge from plane `a` to plane `b`. */
static bool has_edge(size_t count, const size_t *cut, size_t a, size_t b) {
    for (size_t i = 0; i < 3 * count; ++i)
        if (cut[i] == a && cut[i - i % 3 + (i + 1) % 3] == b)
            return true;
    return false;
}

static bool cut(polyhedron *p, plane by) {
    size_t taken = 0;
    if (!aur_array_reserve(&p->cut, &p->cut_capacity, 3 * p->corner_count, sizeof *p->cut))
        return false;
    for (size_t i = 0; i < p->corner_count;) {
        const corner c = p->corners[i];
        if (aur_dot3(c.at, by.normal) <= by.offset + on_plane * (1.0 + aur_length3(c.at))) {
            ++i;
            continue;
        }
        for (size_t k = 0; k < 3; ++k)
            p->cut[3 * taken + k] = c.planes[k];
        ++taken;
        p->corners[i] = p->corners[--p->corner_count];
    }
    if (taken == 0)
        return true;
    if (!add_plane(p, by))
        return false;
    /* Each edge of the hole's rim meets the plane in a new corner. */
    for (size_t i = 0; i < 3 * taken; ++i) {
        const size_t a = p->cut[i], b = p->cut[i - i % 3 + (i + 1) % 3];
        if (!has_edge(taken, p->cut, b, a) && !add_corner(p, a, b, p->plane_count - 1))
            return false;
    }
    return true;
}

static double greatest_tangent(const polyhedron *p) {
    double square = 0.0;
    for (size_t i = 0; i < p->corner_count; ++i)
        square = fmax(square, aur_dot3(p->corners[i].at, p->corners[i].at));
    return sqrt(square);
}

typedef struct cells {
    const aur_points_view *points;
    const aur_tree *tree;
    double *radii; /* on the three-sphere, one per item */
} cells;

enum { CELLS_PER_ITEM = 16, FIRST_NEIGHBOURS = 48 };

/* The tangents at q are q i, q j and q k. */
static bool cut_by(polyhedron *p, const double *q, const double *y, double square) {
    const double frame[3][4] = {
        {-q[1], q[0], q[3], -q[2]}, {-q[2], -q[3], q[0], q[1]}, {-q[3], q[2], -q[1], q[0]}};
    plane by = {.offset = 0.5 * square};
    for (size_t d = 0; d < 3; ++d)
        by.normal[d] = aur_dot4(y, frame[d]);
    return cut(p, by);
}

/* The radius of a cell, from the neighbours that can cut it: those within twice the radius. */
static aur_result cell_radius(const cells *work, size_t index, polyhedron *p, double *radius) {
    const size_t count = work->points->count;
    const double *const q = aur_point_at(work->points, index);
    for (size_t requested = FIRST_NEIGHBOURS;; requested *= 4) {
        aur_found *const found = malloc(requested * sizeof *found);
        bool good = found != NULL && start(p);
        const size_t near = good ? aur_tree_find(work->tree, q, requested, found) : 0;
        for (size_t n = 0; n < near && good; ++n) {
            /* The opposite cuts nothing off; a coincident rotation shares the cell. */
            if (found[n].square > 1e-28 && found[n].square < 4.0 - 1e-12)
                good = cut_by(p, q, aur_point_at(work->points, found[n].index), found[n].square);
        }
        *radius = good ? atan(greatest_tangent(p)) : 0.0;
        const double reach = near > 0 ? 2.0 * asin(fmin(0.5 * sqrt(found[near - 1].square), 1.0)) : 0.0;
        free(found);
        if (!good)
            return AUR_ERROR_MEMORY;
        if (near == count || reach >= 2.0 * *radius)
            return AUR_OK;
    }
}

static aur_result measure_cells(void *context, size_t item) {
    const cells *const work = context;
    polyhedron p = {0};
    aur_result result = AUR_OK;
    double greatest = 0.0;
    const size_t last = work->points->count / 2;
    for (size_t i = item * CELLS_PER_ITEM; i < (item + 1) * CELLS_PER_ITEM && i < last && result == AUR_OK;
         ++i) {
        double radius;
        result = cell_radius(work, i, &p, &radius);
        greatest = fmax(greatest, radius);
    }
    release(&p);
    work->radii[item] = greatest;
    return result;
}

aur_result aur_rotation_covering(const aur_measure_request *request, double *angle, aur_error *error) {
    const aur_points_view *const points = request->points;
    const size_t items = (points->count / 2 + CELLS_PER_ITEM - 1) / CELLS_PER_ITEM;
    cells work = {points, NULL, aur_arena_allocate(request->arena, items * sizeof *work.radii)};
    if (work.radii == NULL)
        return aur_fail_memory(error);
    aur_tree *tree;
    aur_result result = aur_tree_create(4, points->count, points->stride, points->coordinates, &tree, error);
    if (result != AUR_OK)
        return result;
    work.tree = tree;
    result = aur_measure_items(
        &request->options, "cutting cells", items, measure_cells, &work,
        (aur_parallel_slice){work.radii, sizeof *work.radii, items * sizeof *work.radii}, error);
    aur_tree_destroy(tree);
    double greatest = 0.0;
    for (size_t i = 0; i < items && result == AUR_OK; ++i)
        greatest = fmax(greatest, work.radii[i]);
    /* If all quaternions lie in a hyperplane, its normal is 90 degrees away, a rotation by half a turn. */
    *angle = tan(greatest) > 0.5 * horizon ? AUR_PI : 2.0 * greatest;
    return result;
}

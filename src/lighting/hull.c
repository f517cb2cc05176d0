#include "lighting/hull.h"

#include <string.h>

static void add_corner(aur_hull *hull, const double corner[3]) {
    memcpy(hull->corners[hull->corner_count++], corner, sizeof hull->corners[0]);
    for (int d = 0; d < 3; ++d) {
        hull->lower[d] = corner[d] < hull->lower[d] ? corner[d] : hull->lower[d];
        hull->upper[d] = corner[d] > hull->upper[d] ? corner[d] : hull->upper[d];
    }
}

/* Whether corners lie more than `beyond` behind and before the plane: on which sides the hull is. */
static void find_sides(const aur_hull *hull, const aur_plane *plane, double beyond, bool *behind,
                       bool *before) {
    *behind = *before = false;
    for (size_t i = 0; i < hull->corner_count && !(*behind && *before); ++i) {
        const double height = aur_plane_height(plane, hull->corners[i]);
        *behind |= height < -beyond;
        *before |= height > beyond;
    }
}

/* Adds the plane through an edge and a corner when the hull is on one side of it. */
static void try_plane(aur_hull *hull, const double a[3], const double b[3], const double c[3]) {
    double u[3], v[3];
    for (int d = 0; d < 3; ++d) {
        u[d] = b[d] - a[d];
        v[d] = c[d] - a[d];
    }
    aur_plane plane;
    aur_cross3(u, v, plane.normal);
    const double doubled = aur_normalize3(plane.normal);
    if (!(doubled > 1e-12 * aur_length3(u) * aur_length3(v)))
        return;
    plane.offset = aur_dot3(plane.normal, a);
    bool behind, before;
    find_sides(hull, &plane, 0.1 * hull->slack, &behind, &before);
    if (!before) {
        for (int d = 0; d < 3; ++d)
            plane.normal[d] = -plane.normal[d];
        plane.offset = -plane.offset;
    } else if (behind) {
        return;
    }
    hull->planes[hull->plane_count++] = plane;
}

void aur_hull_make(const aur_plane planes[2], const size_t counts[2], double (*const polygons[2])[3],
                   double slack, aur_hull *hull) {
    hull->corner_count = 0;
    hull->slack = slack;
    for (int d = 0; d < 3; ++d) {
        hull->lower[d] = INFINITY;
        hull->upper[d] = -INFINITY;
    }
    for (size_t p = 0; p < 2; ++p)
        for (size_t i = 0; i < counts[p]; ++i)
            add_corner(hull, polygons[p][i]);
    hull->planes[0] = planes[0];
    hull->planes[1] = planes[1];
    hull->plane_count = 2;
    for (size_t p = 0; p < 2; ++p)
        for (size_t i = 0; i < counts[p]; ++i)
            for (size_t k = 0; k < counts[1 - p]; ++k)
                try_plane(hull, polygons[p][i], polygons[p][(i + 1) % counts[p]], polygons[1 - p][k]);
}

static bool box_is_outside(const aur_hull *hull, const aur_box_node *node) {
    for (int d = 0; d < 3; ++d)
        if (node->lower[d] > hull->upper[d] || node->upper[d] < hull->lower[d])
            return true;
    for (size_t i = 0; i < hull->plane_count; ++i) {
        const aur_plane *const plane = &hull->planes[i];
        double highest = -plane->offset;
        for (int d = 0; d < 3; ++d)
            highest += plane->normal[d] * (plane->normal[d] > 0.0 ? node->upper[d] : node->lower[d]);
        if (highest <= hull->slack)
            return true;
    }
    return false;
}

static bool facet_is_outside(const aur_hull *hull, const aur_facets *facets, size_t facet) {
    const double(*const corners)[3] = (const double(*)[3])facets->corners[facet];
    for (size_t i = 0; i < hull->plane_count; ++i)
        if (aur_plane_height(&hull->planes[i], corners[0]) <= hull->slack &&
            aur_plane_height(&hull->planes[i], corners[1]) <= hull->slack &&
            aur_plane_height(&hull->planes[i], corners[2]) <= hull->slack)
            return true;
    if (facets->areas[facet] == 0.0)
        return false;
    bool behind, before;
    find_sides(hull, &facets->planes[facet], hull->slack, &behind, &before);
    return !behind || !before;
}

bool aur_hull_is_empty(const aur_hull *hull, const aur_facets *facets, const aur_box_tree *tree,
                       const size_t facet[2]) {
    for (size_t i = 0; i < tree->node_count;) {
        const aur_box_node *const node = &tree->nodes[i];
        if (box_is_outside(hull, node)) {
            i = node->skip;
            continue;
        }
        for (size_t k = node->first; node->count <= AUR_BOX_LEAF && k < node->first + node->count; ++k) {
            const size_t other = tree->items[k];
            if (other != facet[0] && other != facet[1] && !facet_is_outside(hull, facets, other))
                return false;
        }
        ++i;
    }
    return true;
}

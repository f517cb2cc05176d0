#include "lighting/viewfactors/closed_pairs.h"

#include <string.h>

static void add_corner(aur_hull *hull, const double corner[3]) {
    memcpy(hull->corners[hull->corner_count++], corner, sizeof hull->corners[0]);
    for (int d = 0; d < 3; ++d) {
        hull->lower[d] = corner[d] < hull->lower[d] ? corner[d] : hull->lower[d];
        hull->upper[d] = corner[d] > hull->upper[d] ? corner[d] : hull->upper[d];
    }
}

/* Whether corners lie more than `beyond` behind or in front of the plane: on which sides the hull is. */
static void find_sides(const aur_hull *hull, const aur_plane *plane, double beyond, bool *behind,
                       bool *before) {
    *behind = *before = false;
    for (size_t i = 0; i < hull->corner_count && !(*behind && *before); ++i) {
        const double height = aur_plane_height(plane, hull->corners[i]);
        *behind |= height < -beyond;
        *before |= height > beyond;
    }
}

/* Adds the plane through an edge and a corner if the hull lies on one side of it. */
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
    for (size_t p = 0; p < 2; ++p) /* planes through a corner in the polygon's own plane exclude less */
        if (aur_dot3(plane.normal, hull->planes[p].normal) > 1.0 - 1e-12)
            return;
    hull->planes[hull->plane_count++] = plane;
}

/* The maximum height of the other polygon's corners above the plane of polygon p. */
static double thickness(const aur_hull *hull, size_t p) {
    double highest = 0.0;
    for (size_t i = 0; i < hull->counts[1 - p]; ++i)
        highest = fmax(highest,
                       aur_plane_height(&hull->planes[p], hull->corners[(p == 0 ? hull->counts[0] : 0) + i]));
    return highest;
}

static void find_slack(aur_hull *hull) {
    double size = 0.0, largest = 0.0;
    for (int d = 0; d < 3; ++d) {
        size = fmax(size, hull->upper[d] - hull->lower[d]);
        largest = fmax(largest, fmax(fabs(hull->lower[d]), fabs(hull->upper[d])));
    }
    hull->tight = 4e-15 * largest;
    hull->slack = fmin(4e-7 * size, 1e-3 * fmin(thickness(hull, 0), thickness(hull, 1)));
}

void aur_hull_make(const aur_plane planes[2], const size_t counts[2], double (*const polygons[2])[3],
                   aur_hull *hull) {
    hull->corner_count = 0;
    for (int d = 0; d < 3; ++d) {
        hull->lower[d] = INFINITY;
        hull->upper[d] = -INFINITY;
    }
    for (size_t p = 0; p < 2; ++p) {
        hull->planes[p] = planes[p];
        hull->counts[p] = counts[p];
        for (size_t i = 0; i < counts[p]; ++i)
            add_corner(hull, polygons[p][i]);
    }
    find_slack(hull);
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
        if (highest <= (i < 2 ? hull->tight : hull->slack))
            return true;
    }
    return false;
}

/* Whether some edge of the first polygon separates it from the second one, projected along the normal. */
static bool edge_separates(size_t count, const double (*corners)[3], size_t other_count,
                           const double (*others)[3], const double normal[3], double slack) {
    for (size_t i = 0; i < count; ++i) {
        const double *const a = corners[i], *const b = corners[(i + 1) % count];
        double along[3], outward[3], nearest = INFINITY;
        for (int d = 0; d < 3; ++d)
            along[d] = b[d] - a[d];
        aur_cross3(along, normal, outward);
        if (!(aur_normalize3(outward) > 0.0))
            continue;
        for (size_t k = 0; k < other_count; ++k)
            nearest = fmin(nearest, aur_dot3(outward, others[k]) - aur_dot3(outward, a));
        if (nearest >= -slack)
            return true;
    }
    return false;
}

/* Whether two convex polygons overlap by more than the slack, projected along the normal of the second one.
 */
static bool overlap(size_t count, const double (*corners)[3], size_t other_count, const double (*others)[3],
                    const double normal[3], double slack) {
    aur_plane plane;
    const double area = aur_polygon_plane(count, corners, &plane);
    const double sign = aur_dot3(plane.normal, normal) < 0.0 ? -1.0 : 1.0;
    const double turned[3] = {sign * normal[0], sign * normal[1], sign * normal[2]};
    return area > 0.0 && !edge_separates(count, corners, other_count, others, turned, slack) &&
           !edge_separates(other_count, others, count, corners, normal, slack);
}

/* Whether the part of the facet in front of the plane of polygon p covers a part of that polygon. */
static bool covers_polygon(const aur_hull *hull, size_t p, const double (*corners)[3]) {
    double cut[4][3];
    const size_t count = aur_polygon_clip(3, corners, &hull->planes[p], cut);
    return count > 0 && overlap(count, (const double(*)[3])cut, hull->counts[p],
                                (const double(*)[3])hull->corners + (p == 0 ? 0 : hull->counts[0]),
                                hull->planes[p].normal, hull->slack);
}

/* Whether the part of some polygon in front of the facet's plane, or of its reverse, covers a part of the
 * facet. */
static bool is_covered(const aur_hull *hull, const aur_plane *plane, const double (*corners)[3],
                       const double normal[3]) {
    for (size_t p = 0; p < 2; ++p) {
        double cut[AUR_HULL_CORNERS + 1][3];
        const size_t count = aur_polygon_clip(
            hull->counts[p], (const double(*)[3])hull->corners + (p == 0 ? 0 : hull->counts[0]), plane, cut);
        if (count > 0 && overlap(count, (const double(*)[3])cut, 3, corners, normal, hull->slack))
            return true;
    }
    return false;
}

static double highest_of(const aur_plane *plane, const double (*corners)[3]) {
    return fmax(aur_plane_height(plane, corners[0]),
                fmax(aur_plane_height(plane, corners[1]), aur_plane_height(plane, corners[2])));
}

/* Whether the part of the facet between the two polygons' planes is outside. The hull's sides across a narrow
 * gap are inclined by rounding only; extended, they would let distant parts of the facet appear inside. */
static bool part_is_outside(const aur_hull *hull, const double (*corners)[3]) {
    double cut[4][3], part[5][3];
    size_t count = aur_polygon_clip(3, corners, &hull->planes[0], cut);
    count = count > 0 ? aur_polygon_clip(count, (const double(*)[3])cut, &hull->planes[1], part) : 0;
    for (size_t i = 2; i < hull->plane_count && count > 0; ++i) {
        double highest = -INFINITY;
        for (size_t c = 0; c < count; ++c)
            highest = fmax(highest, aur_plane_height(&hull->planes[i], part[c]));
        if (highest <= hull->slack)
            return true;
    }
    return count == 0;
}

static bool facet_is_outside(const aur_hull *hull, const aur_facets *facets, size_t facet) {
    const double(*const corners)[3] = (const double(*)[3])facets->corners[facet];
    double heights[2];
    for (size_t i = 0; i < hull->plane_count; ++i) {
        const double highest = highest_of(&hull->planes[i], corners);
        if (highest <= (i < 2 ? hull->tight : hull->slack))
            return true;
        if (i < 2)
            heights[i] = highest;
    }
    if (facets->areas[facet] == 0.0)
        return false;
    if (part_is_outside(hull, corners))
        return true;
    bool behind, before;
    aur_plane plane = facets->planes[facet];
    find_sides(hull, &plane, hull->tight, &behind, &before);
    if (!behind || !before)
        return true;
    for (size_t p = 0; p < 2; ++p)
        if (heights[p] <= hull->slack && !covers_polygon(hull, p, corners))
            return true;
    find_sides(hull, &plane, hull->slack, &behind, &before);
    if (behind && before)
        return false;
    if (before) { /* the small part that crosses the plane is behind it */
        for (int d = 0; d < 3; ++d)
            plane.normal[d] = -plane.normal[d];
        plane.offset = -plane.offset;
    }
    return !is_covered(hull, &plane, corners, facets->planes[facet].normal);
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

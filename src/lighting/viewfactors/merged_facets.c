#include "lighting/viewfactors/sky_slices.h"

#include <stdlib.h>
#include <string.h>

#include "lighting/viewfactors/covers.h"

/* A side of a polygon: the indices of its two corners, the smaller first. */
typedef struct side {
    double ends[2][3];
    uint32_t polygon, index;
    bool turned;
} side;

typedef struct merging {
    const aur_facets *facets;
    size_t count;
    aur_merged_facet *polygons;
    uint32_t *first; /* the facet whose plane the polygon uses */
    bool *done;      /* merged in this round */
    side *sides;
} merging;

static int compare_numbers(const double *a, const double *b) {
    for (int d = 0; d < 3; ++d)
        if (a[d] != b[d])
            return a[d] < b[d] ? -1 : 1;
    return 0;
}

static int compare_sides(const void *left, const void *right) {
    const side *const a = left, *const b = right;
    for (int e = 0; e < 2; ++e) {
        const int order = compare_numbers(a->ends[e], b->ends[e]);
        if (order != 0)
            return order;
    }
    return (a->polygon > b->polygon) - (a->polygon < b->polygon);
}

/* The coordinate that changes most along the side. */
static int direction_of(const side *s) {
    int axis = 0;
    for (int d = 1; d < 3; ++d)
        if (fabs(s->ends[1][d] - s->ends[0][d]) > fabs(s->ends[1][axis] - s->ends[0][axis]))
            axis = d;
    return axis;
}

static bool is_longest(const aur_merged_facet *polygon, size_t index) {
    double longest = 0.0, side_length = 0.0;
    for (size_t i = 0; i < polygon->count; ++i) {
        double edge[3];
        for (int d = 0; d < 3; ++d)
            edge[d] = polygon->corners[(i + 1) % polygon->count][d] - polygon->corners[i][d];
        const double length = aur_dot3(edge, edge);
        longest = fmax(longest, length);
        side_length = i == index ? length : side_length;
    }
    return side_length > longest * (1.0 - 1e-6);
}

/* Positive if the path a, b, c turns left: twice the triangle's area over the distance from a to c. */
static double bend(const double a[3], const double b[3], const double c[3], const double normal[3]) {
    double u[3], v[3], across[3];
    for (int d = 0; d < 3; ++d) {
        u[d] = b[d] - a[d];
        v[d] = c[d] - a[d];
    }
    aur_cross3(u, v, across);
    return aur_dot3(across, normal) / aur_length3(v);
}

/* Tolerance of corners to a common plane or line: relative to the extent of both polygons, independent of
 * their position. */
static double slack_of(const aur_merged_facet *a, const aur_merged_facet *b) {
    const aur_box first = aur_box_of(a->count, (const double(*)[3])a->corners),
                  second = aur_box_of(b->count, (const double(*)[3])b->corners);
    double size = 0.0;
    for (int d = 0; d < 3; ++d)
        size = fmax(size, fmax(first.upper[d], second.upper[d]) - fmin(first.lower[d], second.lower[d]));
    return 1e-6 * size;
}

/* Merges the second polygon into the first if the shared side allows it. */
static bool merge(const merging *work, const side *a, const side *b) {
    aur_merged_facet *const into = &work->polygons[a->polygon], *const from = &work->polygons[b->polygon];
    const aur_plane *const plane = &work->facets->planes[work->first[a->polygon]];
    if (a->turned == b->turned || into->count + from->count > AUR_MERGED_CORNERS + 2 ||
        aur_dot3(plane->normal, work->facets->planes[work->first[b->polygon]].normal) < 0.999)
        return false;
    const double slack = slack_of(into, from);
    for (size_t i = 0; i < from->count; ++i)
        if (fabs(aur_plane_height(plane, from->corners[i])) > slack)
            return false;
    double loop[2 * AUR_MERGED_CORNERS][3];
    size_t count = 0;
    for (size_t i = 1; i <= into->count; ++i)
        memcpy(loop[count++], into->corners[(a->index + i) % into->count], sizeof loop[0]);
    const size_t joint = count - 1; /* and 0 */
    for (size_t i = 2; i < from->count; ++i)
        memcpy(loop[count++], from->corners[(b->index + i) % from->count], sizeof loop[0]);
    aur_merged_facet merged = {0};
    for (size_t i = 0; i < count; ++i) {
        if (i == joint || i == 0) {
            const double turn =
                bend(loop[(i + count - 1) % count], loop[i], loop[(i + 1) % count], plane->normal);
            if (turn < -slack)
                return false;
            if (turn <= slack)
                continue;
        }
        if (merged.count == AUR_MERGED_CORNERS)
            return false;
        memcpy(merged.corners[merged.count++], loop[i], sizeof loop[0]);
    }
    *into = merged;
    from->count = 0;
    return true;
}

/* One round, across longest sides or across sides along an axis. Each polygon is merged at most once. */
static size_t merge_round(merging *work, int axis) {
    size_t count = 0, merged = 0;
    for (size_t i = 0; i < work->count; ++i) {
        const aur_merged_facet *const polygon = &work->polygons[i];
        work->done[i] = false;
        for (size_t k = 0; k < polygon->count; ++k) {
            side *const s = &work->sides[count];
            const double *const a = polygon->corners[k], *const b =
                                                             polygon->corners[(k + 1) % polygon->count];
            *s = (side){.polygon = (uint32_t)i, .index = (uint32_t)k, .turned = compare_numbers(a, b) > 0};
            memcpy(s->ends[s->turned], a, sizeof s->ends[0]);
            memcpy(s->ends[!s->turned], b, sizeof s->ends[0]);
            count += axis < 0 ? is_longest(polygon, k) : direction_of(s) == axis;
        }
    }
    qsort(work->sides, count, sizeof *work->sides, compare_sides);
    for (size_t i = 0; i + 1 < count; ++i) {
        const side *const a = &work->sides[i], *const b = a + 1;
        if (memcmp(a->ends, b->ends, sizeof a->ends) != 0 || work->done[a->polygon] ||
            work->done[b->polygon] || !merge(work, a, b))
            continue;
        work->done[a->polygon] = work->done[b->polygon] = true;
        ++merged;
    }
    return merged;
}

aur_result aur_merge_facets(const aur_facets *facets, size_t *count, aur_merged_facet **merged,
                            aur_error *error) {
    *count = 0;
    *merged = NULL;
    const size_t most = facets->count + 1;
    merging work = {.facets = facets,
                    .polygons = malloc(most * sizeof *work.polygons),
                    .first = malloc(most * sizeof *work.first),
                    .done = malloc(most * sizeof *work.done),
                    .sides = malloc(3 * most * sizeof *work.sides)};
    const bool good = work.polygons != NULL && work.first != NULL && work.done != NULL && work.sides != NULL;
    for (size_t i = 0; good && i < facets->count; ++i) {
        if (facets->areas[i] == 0.0)
            continue;
        work.first[work.count] = (uint32_t)i;
        work.polygons[work.count].count = 3;
        memcpy(work.polygons[work.count++].corners, facets->corners[i], sizeof facets->corners[i]);
    }
    for (int axis = -1; good && axis < 3; ++axis)
        while (merge_round(&work, axis) > work.count / 1000)
            if (axis < 0)
                break;
    for (size_t i = 0; good && i < work.count; ++i)
        if (work.polygons[i].count > 0)
            work.polygons[(*count)++] = work.polygons[i];
    free(work.first);
    free(work.done);
    free(work.sides);
    if (good)
        *merged = work.polygons;
    else
        free(work.polygons);
    return good ? AUR_OK : aur_fail_memory(error);
}

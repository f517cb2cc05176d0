#include "render/scene/overlaps.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/parallel.h"
#include "points/base/vector3d.h"

/* Fractions of an extent. */
static const double EVENLY = 1.2e-7, NARROW = 3e-6, EXACT = 1e-12;

/* --- a pair of triangles */

/* In the innermost loops: fmin and fmax, which handle NaN, are calls. */
static inline double smaller_of(double a, double b) {
    return a < b ? a : b;
}

static inline double larger_of(double a, double b) {
    return a > b ? a : b;
}

static inline double side(const double corners[3][3], int d, bool upper) {
    return upper ? larger_of(corners[0][d], larger_of(corners[1][d], corners[2][d]))
                 : smaller_of(corners[0][d], smaller_of(corners[1][d], corners[2][d]));
}

static double extent_of(const double corners[3][3]) {
    double extent = 0.0;
    for (int d = 0; d < 3; ++d)
        extent = larger_of(extent, side(corners, d, true) - side(corners, d, false));
    return extent;
}

/* Subtracts a corner of the first from both, so that no digits are lost far from the origin. Returns the
 * largest coordinate. */
static double localize(double first[3][3], double second[3][3]) {
    double largest = 0.0;
    const double corner[3] = {first[0][0], first[0][1], first[0][2]};
    for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d) {
            largest = larger_of(largest, larger_of(fabs(first[c][d]), fabs(second[c][d])));
            first[c][d] -= corner[d];
            second[c][d] -= corner[d];
        }
    return largest;
}

/* The part of the second triangle above the first one: at most 6 corners. */
static size_t cut_to(const double first[3][3], const double normal[3], const double second[3][3],
                     double part[8][3]) {
    double other[8][3];
    size_t count = 3;
    memcpy(part, second, 9 * sizeof(double));
    for (int e = 0; e < 3 && count > 0; ++e) {
        double along[3];
        for (int d = 0; d < 3; ++d)
            along[d] = first[(e + 1) % 3][d] - first[e][d];
        aur_plane inwards;
        aur_cross3(normal, along, inwards.normal);
        aur_normalize3(inwards.normal);
        inwards.offset = aur_dot3(inwards.normal, first[e]);
        count = aur_polygon_clip(count, (const double(*)[3])part, &inwards, other);
        memcpy(part, other, 3 * count * sizeof(double));
    }
    return count;
}

static void find_heights(const aur_plane *plane, size_t count, const double (*corners)[3], double sign,
                         double *low, double *high) {
    for (size_t c = 0; c < count; ++c) {
        const double height = sign * aur_plane_height(plane, corners[c]);
        *low = fmin(*low, height);
        *high = fmax(*high, height);
    }
}

/* Whether two planes have an even distance at the corners of both triangles, beyond rounding. */
static bool is_apart(double low, double high, double extent, double coordinate_slack, bool opposite,
                     bool doubles) {
    const double far = fmax(fabs(low), fabs(high));
    if (far <= EXACT * extent + coordinate_slack || high - low > 0.2 * far)
        return false;
    const bool facing = opposite && low > 0.0;
    return facing || doubles || far > EVENLY * extent;
}

static inline bool is_same(const double a[3], const double b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Whether the second triangle is outside of the plane perpendicular to an edge of the first. */
static bool is_beyond_edge(const double first[3][3], const double second[3][3], const double normal[3]) {
    const double *const opposite[3] = {first[2], first[0], first[1]};
    for (int e = 0; e < 3; ++e) {
        const double *const a = first[e], *const b = first[(e + 1) % 3];
        double along[3], across[3], sides[4];
        for (int d = 0; d < 3; ++d)
            along[d] = b[d] - a[d];
        aur_cross3(normal, along, across);
        const double start = aur_dot3(across, a);
        for (int c = 0; c < 3; ++c)
            sides[c] =
                is_same(second[c], a) || is_same(second[c], b) ? 0.0 : aur_dot3(across, second[c]) - start;
        sides[3] = aur_dot3(across, opposite[e]) - start;
        const double sign = sides[3] < 0.0 ? -1.0 : 1.0;
        if (sign * sides[0] <= 0.0 && sign * sides[1] <= 0.0 && sign * sides[2] <= 0.0)
            return true;
    }
    return false;
}

/* Rejects most pairs, which are neighbours in a mesh, by a fast test. */
static bool are_apart(const double larger[3][3], const double smaller[3][3], double slack) {
    double a[3], b[3], normal[3], low = INFINITY, high = -INFINITY;
    for (int d = 0; d < 3; ++d) {
        a[d] = larger[1][d] - larger[0][d];
        b[d] = larger[2][d] - larger[0][d];
    }
    aur_cross3(a, b, normal);
    const double start = aur_dot3(normal, larger[0]), limit = slack * aur_length3(normal);
    for (int c = 0; c < 3; ++c) {
        const double height = aur_dot3(normal, smaller[c]) - start;
        low = smaller_of(low, height);
        high = larger_of(high, height);
    }
    return low > limit || high < -limit || is_beyond_edge(larger, smaller, normal) ||
           is_beyond_edge(smaller, larger, normal);
}

static double altitude_of(const double corners[3][3], double area) {
    double longest = 0.0;
    for (int c = 0; c < 3; ++c) {
        double edge[3];
        for (int d = 0; d < 3; ++d)
            edge[d] = corners[(c + 1) % 3][d] - corners[c][d];
        longest = larger_of(longest, aur_dot3(edge, edge));
    }
    return 2.0 * area / sqrt(longest);
}

/* Whether the angle between the planes exceeds the rounding of coordinates. */
static bool are_inclined(const aur_plane *plane, const aur_plane *other, bool opposite, double tilt) {
    double between[3];
    for (int d = 0; d < 3; ++d)
        between[d] = opposite ? plane->normal[d] + other->normal[d] : plane->normal[d] - other->normal[d];
    return aur_length3(between) > tilt;
}

/* The extent that bounds the rounding of heights over the larger triangle's plane: a coordinate along an axis
 * shifts the plane in proportion to the normal's component, independent of the corners' position. */
static double height_extent(const double larger[3][3], const double smaller[3][3], const double normal[3]) {
    double extent = extent_of(smaller);
    for (int d = 0; d < 3; ++d)
        extent += fabs(normal[d]) * (side(larger, d, true) - side(larger, d, false));
    return smaller_of(extent, extent_of(larger));
}

/* The larger triangle is first. */
static bool overlap(double larger[3][3], double smaller[3][3], double extent, bool doubles, bool *opposite) {
    const double largest = localize(larger, smaller);
    const double coordinate_slack = aur_overlap_slack(0.0, largest);
    if (are_apart((const double(*)[3])larger, (const double(*)[3])smaller,
                  aur_overlap_slack(extent, largest)))
        return false;
    aur_plane plane, other;
    const double areas[2] = {aur_polygon_plane(3, (const double(*)[3])larger, &plane),
                             aur_polygon_plane(3, (const double(*)[3])smaller, &other)};
    if (!(areas[0] > 1e-10 * extent * extent) || !(areas[1] > 0.0))
        return false;
    const double cosine = aur_dot3(plane.normal, other.normal);
    const double thick = height_extent((const double(*)[3])larger, (const double(*)[3])smaller, plane.normal);
    const double slack = aur_overlap_slack(thick, largest);
    double low = INFINITY, high = -INFINITY, part[8][3];
    find_heights(&plane, 3, (const double(*)[3])smaller, 1.0, &low, &high);
    if (low > slack || high < -slack || fabs(cosine) < 0.99)
        return false;
    *opposite = cosine < 0.0;
    const double tilt = aur_overlap_tilt(slack, altitude_of((const double(*)[3])larger, areas[0])) +
                        aur_overlap_tilt(slack, altitude_of((const double(*)[3])smaller, areas[1]));
    if (are_inclined(&plane, &other, *opposite, tilt))
        return false;
    find_heights(&other, 3, (const double(*)[3])larger, *opposite ? 1.0 : -1.0, &low, &high);
    if (is_apart(low, high, thick, coordinate_slack, *opposite, doubles))
        return false;
    const size_t count = cut_to((const double(*)[3])larger, plane.normal, (const double(*)[3])smaller, part);
    if (count < 3 || aur_polygon_width(count, (const double(*)[3])part) <= NARROW * extent + coordinate_slack)
        return false;
    low = INFINITY;
    high = -INFINITY;
    find_heights(&plane, count, (const double(*)[3])part, 1.0, &low, &high);
    return low >= -slack && high <= slack;
}

/* --- a tree of boxes, with floats that count from the middle */

enum { LEAF = 4, BLOCK = 1024 };

/* Limit of pairs per block; the rest is skipped, as with thousands of instances in one place. */
enum { MOST_PAIRS = 1 << 18 };

typedef struct node {
    float lower[3], upper[3];
    uint32_t first, count, skip; /* range in `order`; the next node after the subtree */
} node;

typedef struct search {
    const aur_triangle_source *triangles;
    double middle[3];
    float (*centers)[3];
    uint32_t *order;
    size_t node_count;
    node *nodes;
    aur_overlaps *found; /* of blocks */
} search;

static void find_corners(const search *s, size_t index, double corners[3][3]) {
    s->triangles->corners(s->triangles->context, index, 1, (double(*)[3][3])corners);
}

/* Wider than rounding and the distance of overlapping triangles. */
static void include(const search *s, const double corners[3][3], float lower[3], float upper[3]) {
    const double slack = aur_overlap_slack(extent_of(corners), 0.0);
    for (int d = 0; d < 3; ++d) {
        const double low = side(corners, d, false) - s->middle[d] - slack,
                     high = side(corners, d, true) - s->middle[d] + slack;
        const float below = (float)(low - 1e-7 * fabs(low)), above = (float)(high + 1e-7 * fabs(high));
        lower[d] = below < lower[d] ? below : lower[d];
        upper[d] = above > upper[d] ? above : upper[d];
    }
}

static bool boxes_meet(const float lower[3], const float upper[3], const float other_lower[3],
                       const float other_upper[3]) {
    bool meet = true;
    for (int d = 0; d < 3; ++d)
        meet &= lower[d] <= other_upper[d] && other_lower[d] <= upper[d];
    return meet;
}

static void set_empty(float lower[3], float upper[3]) {
    for (int d = 0; d < 3; ++d) {
        lower[d] = INFINITY;
        upper[d] = -INFINITY;
    }
}

static int longest_axis(const search *s, size_t first, size_t count) {
    float low[3], high[3];
    set_empty(low, high);
    for (size_t i = first; i < first + count; ++i)
        for (int d = 0; d < 3; ++d) {
            const float at = s->centers[s->order[i]][d];
            low[d] = at < low[d] ? at : low[d];
            high[d] = at > high[d] ? at : high[d];
        }
    int axis = 0;
    for (int d = 1; d < 3; ++d)
        axis = high[d] - low[d] > high[axis] - low[axis] ? d : axis;
    return axis;
}

static bool comes_before(const search *s, uint32_t a, uint32_t b, int axis) {
    const float x = s->centers[a][axis], y = s->centers[b][axis];
    return x < y || (x == y && a < b);
}

/* Moves the lower half along the axis to the front (Hoare's selection). */
static void halve(search *s, size_t first, size_t count, int axis) {
    const size_t half = first + count / 2;
    size_t low = first, high = first + count - 1;
    while (low < high) {
        const uint32_t pivot = s->order[low + (high - low) / 2];
        size_t i = low, k = high;
        while (i <= k) {
            while (comes_before(s, s->order[i], pivot, axis))
                ++i;
            while (comes_before(s, pivot, s->order[k], axis))
                --k;
            if (i > k)
                break;
            const uint32_t swap = s->order[i];
            s->order[i++] = s->order[k];
            s->order[k] = swap;
            if (k == 0)
                break;
            --k;
        }
        if (half <= k)
            high = k;
        else if (half >= i)
            low = i;
        else
            return;
    }
}

static void build(search *s, size_t first, size_t count) {
    node *const n = &s->nodes[s->node_count++];
    *n = (node){.first = (uint32_t)first, .count = (uint32_t)count};
    set_empty(n->lower, n->upper);
    if (count > LEAF) {
        const node *const left = &s->nodes[s->node_count];
        halve(s, first, count, longest_axis(s, first, count));
        build(s, first, count / 2);
        const node *const right = &s->nodes[s->node_count];
        build(s, first + count / 2, count - count / 2);
        for (int d = 0; d < 3; ++d) {
            n->lower[d] = fminf(left->lower[d], right->lower[d]);
            n->upper[d] = fmaxf(left->upper[d], right->upper[d]);
        }
    }
    for (size_t i = first; count <= LEAF && i < first + count; ++i) {
        double corners[3][3];
        find_corners(s, s->order[i], corners);
        include(s, (const double(*)[3])corners, n->lower, n->upper);
    }
    n->skip = (uint32_t)s->node_count;
}

/* Builds the tree of the `count` triangles of `order`. */
static void build_tree(search *s, size_t count) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double corners[3][3];
    for (size_t i = 0; i < count; ++i) {
        find_corners(s, s->order[i], corners);
        for (int d = 0; d < 3; ++d) {
            low[d] = smaller_of(low[d], side((const double(*)[3])corners, d, false));
            high[d] = larger_of(high[d], side((const double(*)[3])corners, d, true));
        }
    }
    for (int d = 0; d < 3; ++d)
        s->middle[d] = 0.5 * (low[d] + high[d]);
    for (size_t i = 0; i < count; ++i) {
        find_corners(s, s->order[i], corners);
        for (int d = 0; d < 3; ++d)
            s->centers[s->order[i]][d] =
                (float)((corners[0][d] + corners[1][d] + corners[2][d]) / 3.0 - s->middle[d]);
    }
    s->node_count = 0;
    build(s, 0, count);
}

static bool meets_leaf(const search *s, const double corners[3][3]) {
    float lower[3], upper[3];
    set_empty(lower, upper);
    include(s, corners, lower, upper);
    for (size_t k = 0; k < s->node_count;) {
        const node *const n = &s->nodes[k];
        const bool meet = boxes_meet(lower, upper, n->lower, n->upper);
        if (meet && n->count <= LEAF)
            return true;
        k = meet ? k + 1 : n->skip;
    }
    return false;
}

static size_t list_marked(search *s, const uint8_t *marks, uint8_t least) {
    size_t count = 0;
    for (size_t i = 0; i < s->triangles->count; ++i)
        if (marks[i] >= least)
            s->order[count++] = (uint32_t)i;
    return count;
}

/* Lists in `order` the triangles that may overlap others. */
static bool choose(search *s, size_t *count) {
    uint8_t *const marks = malloc(s->triangles->count);
    const size_t unlike = marks != NULL ? aur_planes_mark(s->triangles, marks) : SIZE_MAX;
    const bool good = unlike != SIZE_MAX, few = good && unlike < s->triangles->count / 4;
    if (few && unlike > 0) {
        build_tree(s, list_marked(s, marks, AUR_PLANE_UNLIKE));
        for (size_t i = 0; i < s->triangles->count; ++i) {
            double corners[3][3];
            find_corners(s, i, corners);
            if (marks[i] == AUR_PLANE_ALONE && meets_leaf(s, (const double(*)[3])corners))
                marks[i] = AUR_PLANE_SHARED;
        }
    }
    *count = good ? list_marked(s, marks, few ? AUR_PLANE_SHARED : AUR_PLANE_ALONE) : 0;
    free(marks);
    return good;
}

static bool begin(search *s) {
    size_t count = s->triangles->count;
    s->centers = malloc(count * sizeof *s->centers);
    s->order = malloc(count * sizeof *s->order);
    s->nodes = malloc((2 * count / (LEAF / 2) + 2) * sizeof *s->nodes);
    if (s->centers == NULL || s->order == NULL || s->nodes == NULL || !choose(s, &count))
        return false;
    s->node_count = 0;
    if (count > 0)
        build_tree(s, count);
    s->found = calloc(s->node_count / BLOCK + 1, sizeof *s->found);
    return s->found != NULL;
}

/* --- all pairs */

static bool append(aur_overlaps *found, size_t *capacity, aur_overlap overlap) {
    if (!aur_array_reserve(&found->items, capacity, found->count + 1, sizeof *found->items))
        return false;
    found->items[found->count++] = overlap;
    return true;
}

/* A triangle with its box. */
typedef struct item {
    double corners[3][3];
    float lower[3], upper[3];
    uint32_t index;
} item;

static void load_leaf(const search *s, const node *n, item items[LEAF]) {
    for (size_t i = 0; i < n->count; ++i) {
        item *const it = &items[i];
        it->index = s->order[n->first + i];
        find_corners(s, it->index, it->corners);
        set_empty(it->lower, it->upper);
        include(s, (const double(*)[3])it->corners, it->lower, it->upper);
    }
}

static bool try_pair(const search *s, const item *a, const item *b, aur_overlaps *found, size_t *capacity) {
    if (found->count == MOST_PAIRS || !boxes_meet(a->lower, a->upper, b->lower, b->upper))
        return true;
    double corners[2][3][3];
    memcpy(corners[0], a->corners, sizeof corners[0]);
    memcpy(corners[1], b->corners, sizeof corners[1]);
    const double extents[2] = {extent_of(a->corners), extent_of(b->corners)};
    /* Of two equally large triangles the first one, independent of the tree. */
    const int larger = extents[1] > extents[0] || (extents[1] == extents[0] && b->index < a->index);
    aur_overlap pair_overlap = {a->index < b->index ? a->index : b->index,
                                a->index < b->index ? b->index : a->index, false};
    return !overlap(corners[larger], corners[1 - larger], extents[larger], s->triangles->doubles,
                    &pair_overlap.opposite) ||
           append(found, capacity, pair_overlap);
}

/* Pairs of a leaf's triangles with each other, and with those of later leaves. */
static bool search_leaf(const search *s, size_t leaf, aur_overlaps *found, size_t *capacity) {
    const node *const self = &s->nodes[leaf];
    item items[LEAF], others[LEAF];
    load_leaf(s, self, items);
    for (size_t i = 0; i < self->count; ++i)
        for (size_t m = i + 1; m < self->count; ++m)
            if (!try_pair(s, &items[i], &items[m], found, capacity))
                return false;
    for (size_t k = 0; k < s->node_count;) {
        const node *const n = &s->nodes[k];
        if (n->first + n->count <= self->first + self->count ||
            !boxes_meet(self->lower, self->upper, n->lower, n->upper)) {
            k = n->skip;
            continue;
        }
        ++k;
        if (n->count > LEAF)
            continue;
        load_leaf(s, n, others);
        for (size_t i = 0; i < self->count; ++i)
            for (size_t m = 0; m < n->count; ++m)
                if (!try_pair(s, &items[i], &others[m], found, capacity))
                    return false;
    }
    return true;
}

static aur_result search_block(void *context, size_t index) {
    const search *const s = context;
    size_t capacity = 0;
    for (size_t k = BLOCK * index; k < s->node_count && k < BLOCK * (index + 1); ++k)
        if (s->nodes[k].count <= LEAF && !search_leaf(s, k, &s->found[index], &capacity))
            return AUR_ERROR_MEMORY;
    return AUR_OK;
}

static int compare_overlaps(const void *left, const void *right) {
    const aur_overlap *const a = left, *const b = right;
    if (a->second != b->second)
        return a->second < b->second ? -1 : 1;
    return (a->first > b->first) - (a->first < b->first);
}

static bool join(const search *s, aur_overlaps *overlaps) {
    const size_t blocks = s->node_count / BLOCK + 1;
    size_t capacity = 0;
    for (size_t b = 0; b < blocks; ++b)
        for (size_t i = 0; i < s->found[b].count; ++i)
            if (!append(overlaps, &capacity, s->found[b].items[i]))
                return false;
    if (overlaps->count > 0)
        qsort(overlaps->items, overlaps->count, sizeof *overlaps->items, compare_overlaps);
    return true;
}

aur_result aur_overlaps_find(const aur_triangle_source *triangles, size_t threads, aur_overlaps *overlaps,
                             aur_error *error) {
    *overlaps = (aur_overlaps){0};
    const size_t count = triangles->count;
    if (count < 2)
        return AUR_OK;
    search s = {.triangles = triangles};
    aur_result result = begin(&s) ? AUR_OK : aur_fail_memory(error);
    free(s.centers);
    const aur_parallel_options parallel = {.threads = threads, .what = "looking for overlaps"};
    if (result == AUR_OK)
        result = aur_parallel_for(&parallel, s.node_count / BLOCK + 1, search_block, &s, error);
    if (result == AUR_OK && !join(&s, overlaps))
        result = aur_fail_memory(error);
    for (size_t b = 0; s.found != NULL && b < s.node_count / BLOCK + 1; ++b)
        free(s.found[b].items);
    free(s.found);
    free(s.order);
    free(s.nodes);
    if (result != AUR_OK)
        aur_overlaps_release(overlaps);
    return result;
}

#include "render/scene/importers/meshes/ring.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Version number of removed nodes. */
#define GONE UINT32_MAX

enum { ATTEMPTS = 5 }; /* per node: one initially, up to four when a node is removed */

static double distance(const aur_ring *r, uint32_t a, uint32_t b) {
    return hypot(r->point[a][0] - r->point[b][0], r->point[a][1] - r->point[b][1]);
}

/* --- ears */

/* Orientation of node p relative to the line from a to b: 1 left, 0 on the line. */
static int side_of(const aur_ring *r, uint32_t a, uint32_t b, uint32_t p) {
    const double area = aur_ring_turn(r, a, b, p);
    if (r->leniency == AUR_LENIENCY_ROUNDED && fabs(area) <= r->slack * distance(r, a, b))
        return 0;
    return (area > 0.0) - (area < 0.0);
}

static bool same_point(const aur_ring *r, uint32_t a, uint32_t b) {
    if (r->leniency == AUR_LENIENCY_ROUNDED)
        return distance(r, a, b) <= r->slack;
    return r->point[a][0] == r->point[b][0] && r->point[a][1] == r->point[b][1];
}

/* Whether an outline edge goes from node p to the left of the line from a to b. */
static bool leaves_left(const aur_ring *r, uint32_t a, uint32_t b, uint32_t p) {
    return side_of(r, a, b, r->previous[p]) > 0 || side_of(r, a, b, r->next[p]) > 0;
}

static bool goes_between(const aur_ring *r, const uint32_t t[3], uint32_t q) {
    return side_of(r, t[0], t[1], q) > 0 && side_of(r, t[1], t[2], q) > 0;
}

/* Whether node p prevents cutting off triangle t as an ear at its middle corner. */
static bool blocks(const aur_ring *r, const uint32_t t[3], uint32_t p) {
    if (p == t[0] || p == t[1] || p == t[2] || same_point(r, p, t[0]) || same_point(r, p, t[2]))
        return false;
    if (same_point(r, p, t[1]))
        return goes_between(r, t, r->previous[p]) || goes_between(r, t, r->next[p]);
    int side[3];
    for (size_t i = 0; i < 3; ++i) {
        side[i] = side_of(r, t[i], t[(i + 1) % 3], p);
        if (side[i] < 0)
            return false;
    }
    if (side[2] == 0 && r->leniency == AUR_LENIENCY_NONE)
        return true;
    for (size_t i = 0; i < 3; ++i)
        if (side[i] == 0)
            return leaves_left(r, t[i], t[(i + 1) % 3], p);
    return true;
}

static bool is_free(const aur_ring *r, const uint32_t t[3]) {
    const double *const corners[3] = {r->point[t[0]], r->point[t[1]], r->point[t[2]]};
    aur_corner_query query;
    aur_corner_query_begin(&query, &r->tree, corners, r->leniency == AUR_LENIENCY_ROUNDED ? r->slack : 0.0);
    uint32_t p;
    while (aur_corner_query_next(&query, &p))
        if (blocks(r, t, p))
            return false;
    return true;
}

/* --- the ring */

static void enqueue(aur_ring *r, uint32_t node) {
    r->queue[r->tail++] = (aur_ring_attempt){node, ++r->version[node]};
}

static void remove_node(aur_ring *r, uint32_t node) {
    r->next[r->previous[node]] = r->next[node];
    r->previous[r->next[node]] = r->previous[node];
    r->version[node] = GONE;
    --r->left;
    if (r->start == node)
        r->start = r->next[node];
    aur_corner_tree_remove(&r->tree, node);
}

/* Whether the outline reverses direction at the node, or has a zero-length edge there. */
static bool is_spike(const aur_ring *r, uint32_t node) {
    const uint32_t a = r->previous[node], c = r->next[node];
    if (same_point(r, a, node) || same_point(r, node, c))
        return true;
    if (aur_ring_turn(r, a, node, c) != 0.0)
        return false;
    const double *const p = r->point[node];
    const int d = r->point[a][0] != p[0] ? 0 : 1;
    return (r->point[a][d] > p[d]) == (r->point[c][d] > p[d]);
}

/* Removes spikes at a node, and those that this creates; queues the neighbours. */
static void settle(aur_ring *r, uint32_t node) {
    while (r->left >= 3 && is_spike(r, node)) {
        const uint32_t before = r->previous[node], after = r->next[node];
        remove_node(r, node);
        node = is_spike(r, before) ? before : after;
        enqueue(r, before);
        enqueue(r, after);
    }
    if (r->left >= 3)
        enqueue(r, node);
}

void aur_ring_take(aur_ring *r, const uint32_t t[3]) {
    const size_t least = t[0] < t[1] ? (t[0] < t[2] ? 0 : 2) : (t[1] < t[2] ? 1 : 2);
    for (size_t i = 0; i < 3; ++i)
        r->triangles[3 * r->triangle_count + i] = t[(least + i) % 3];
    ++r->triangle_count;
}

/* Cuts off the node if it is an ear. */
static bool try_node(aur_ring *r, uint32_t node) {
    const uint32_t t[3] = {r->previous[node], node, r->next[node]};
    const double area = aur_ring_turn(r, t[0], t[1], t[2]);
    const bool thin = r->leniency == AUR_LENIENCY_ROUNDED && side_of(r, t[0], t[2], node) == 0;
    if (!(area > 0.0) ? !thin : !is_free(r, t))
        return false;
    if (area > 0.0)
        aur_ring_take(r, t);
    remove_node(r, node);
    if (r->left < 3)
        return true;
    settle(r, t[0]);
    if (r->version[t[2]] != GONE)
        settle(r, t[2]);
    return true;
}

/* Cuts ears until none is left. If no ear passes the strict test, one is cut by the lenient test before the
 * strict one is used again. */
bool aur_ring_cut(aur_ring *r) {
    for (r->leniency = AUR_LENIENCY_NONE; r->leniency <= AUR_LENIENCY_ROUNDED;) {
        r->head = r->tail = 0;
        uint32_t node = r->start;
        do {
            enqueue(r, node);
            node = r->next[node];
        } while (node != r->start);
        const size_t before = r->left;
        while (r->head < r->tail && r->left >= 3) {
            const aur_ring_attempt a = r->queue[r->head++];
            if (r->version[a.node] == a.version)
                (void)try_node(r, a.node);
        }
        if (r->left < 3)
            return true;
        r->leniency = r->left < before ? AUR_LENIENCY_NONE : r->leniency + 1;
    }
    return false;
}

/* --- memory */

/* Reserves `count` items of the buffer, which may be NULL to count bytes. */
static void *take(char *memory, size_t *at, size_t count, size_t size) {
    void *const taken = memory != NULL ? memory + *at : NULL;
    *at += (count * size + 15) / 16 * 16;
    return taken;
}

/* Returns the bytes. */
static size_t lay_out(aur_ring *r, size_t count, char *memory) {
    const size_t n = aur_ring_capacity(count);
    size_t at = 0;
    r->corner = take(memory, &at, n, sizeof *r->corner);
    r->next = take(memory, &at, n, sizeof *r->next);
    r->previous = take(memory, &at, n, sizeof *r->previous);
    r->version = take(memory, &at, n, sizeof *r->version);
    r->point = take(memory, &at, n, sizeof *r->point);
    r->queue = take(memory, &at, ATTEMPTS * n, sizeof *r->queue);
    r->triangles = take(memory, &at, 3 * n, sizeof *r->triangles);
    r->sides = take(memory, &at, n, sizeof *r->sides);
    r->tree_memory = take(memory, &at, 1, aur_corner_tree_size(n));
    return at;
}

size_t aur_ring_size(size_t count) {
    aur_ring ring;
    return lay_out(&ring, count, NULL);
}

void aur_ring_place(aur_ring *ring, size_t count, void *memory) {
    *ring = (aur_ring){0};
    (void)lay_out(ring, count, memory);
}

/* --- corners that lie on edges */

/* Snaps corners to earlier ones within the slack. */
static void merge_points(aur_ring *r) {
    for (uint32_t i = 0; i < r->count; ++i) {
        const double *const corners[3] = {r->point[i], r->point[i], r->point[i]};
        aur_corner_query query;
        aur_corner_query_begin(&query, &r->tree, corners, r->slack);
        uint32_t nearest = i, p;
        while (aur_corner_query_next(&query, &p))
            if (p < nearest && distance(r, p, i) <= r->slack)
                nearest = p;
        memcpy(r->point[i], r->point[nearest], sizeof r->point[i]);
    }
}

/* Parameter of corner p along the edge from a to b; 0 if it is not on the edge. */
static double parameter_on(const aur_ring *r, uint32_t a, uint32_t b, uint32_t p) {
    if (same_point(r, p, a) || same_point(r, p, b) || side_of(r, a, b, p) != 0)
        return 0.0;
    const double *const u = r->point[a], *const v = r->point[b], *const w = r->point[p];
    const double x = v[0] - u[0], y = v[1] - u[1];
    const double along = ((w[0] - u[0]) * x + (w[1] - u[1]) * y) / (x * x + y * y);
    return along > 0.0 && along < 1.0 ? along : 0.0;
}

static int compare_sides(const void *left, const void *right) {
    const aur_ring_side *const a = left, *const b = right;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    return (a->node > b->node) - (a->node < b->node);
}

/* Adds a node for each position on the edge from corner a to b where corners lie. */
static void split_side(aur_ring *r, size_t corner_count, uint32_t a, uint32_t b) {
    const double *const corners[3] = {r->point[a], r->point[b], r->point[b]};
    aur_corner_query query;
    aur_corner_query_begin(&query, &r->tree, corners, r->leniency == AUR_LENIENCY_ROUNDED ? r->slack : 0.0);
    size_t found = 0;
    uint32_t p;
    while (aur_corner_query_next(&query, &p)) {
        const double along = parameter_on(r, a, b, p);
        if (along > 0.0 && found < aur_ring_capacity(corner_count) - r->count)
            r->sides[found++] = (aur_ring_side){along, along, p};
    }
    qsort(r->sides, found, sizeof *r->sides, compare_sides);
    uint32_t last = a;
    for (size_t i = 0; i < found; ++i) {
        const uint32_t corner = r->sides[i].node, node = (uint32_t)r->count;
        if (same_point(r, corner, last))
            continue;
        memcpy(r->point[node], r->point[corner], sizeof r->point[node]);
        r->corner[node] = corner;
        r->next[last] = node;
        r->next[node] = b;
        last = node;
        ++r->count;
    }
}

void aur_ring_link(aur_ring *r, size_t count, const double (*points)[2], bool turned, bool rounded) {
    r->count = count;
    r->start = 0;
    r->triangle_count = 0;
    r->leniency = rounded ? AUR_LENIENCY_ROUNDED : AUR_LENIENCY_NONE;
    memcpy(r->point, points, count * sizeof *points);
    for (uint32_t i = 0; i < count; ++i) {
        r->corner[i] = i;
        r->next[i] = i + 1 < count ? i + 1 : 0;
    }
    aur_corner_tree_build(&r->tree, count, (const double(*)[2])r->point, r->tree_memory);
    if (rounded)
        merge_points(r);
    for (uint32_t i = 0; i < count; ++i)
        split_side(r, count, i, i + 1 < count ? i + 1 : 0);
    if (rounded || r->count > count)
        aur_corner_tree_build(&r->tree, r->count, (const double(*)[2])r->point, r->tree_memory);
    r->left = r->count;
    for (uint32_t i = 0; i < r->count; ++i) {
        r->version[i] = 0;
        r->previous[r->next[i]] = i;
    }
    if (turned) {
        uint32_t *const next = r->next;
        r->next = r->previous;
        r->previous = next;
    }
}

/* --- crossings */

/* Whether p and q lie on opposite sides of the line through a and b, each farther than `slack`. */
static bool parts(const aur_ring *r, uint32_t a, uint32_t b, uint32_t p, uint32_t q) {
    const double least = r->slack * distance(r, a, b), first = aur_ring_turn(r, a, b, p),
                 second = aur_ring_turn(r, a, b, q);
    return (first > least && second < -least) || (first < -least && second > least);
}

/* Whether the outline crosses itself. Tests at most a fixed share of all pairs of edges, which limits only
 * outlines of many thousand corners. */
bool aur_ring_crosses_itself(const aur_ring *r) {
    size_t pairs = 256 * r->count + 65536;
    aur_ring_side *const sides = r->sides;
    for (uint32_t i = 0; i < r->count; ++i) {
        const double x = r->point[i][0], y = r->point[r->next[i]][0];
        sides[i] = (aur_ring_side){fmin(x, y), fmax(x, y), i};
    }
    qsort(sides, r->count, sizeof *sides, compare_sides);
    for (size_t i = 0; i < r->count; ++i)
        for (size_t k = i + 1; k < r->count && sides[k].low <= sides[i].high; ++k) {
            const uint32_t a = sides[i].node, b = r->next[a], c = sides[k].node, d = r->next[c];
            if (parts(r, a, b, c, d) && parts(r, c, d, a, b))
                return true;
            if (--pairs == 0)
                return false;
        }
    return false;
}

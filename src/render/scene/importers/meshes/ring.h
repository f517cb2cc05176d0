/* An outline from which ears are cut off. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "points/base/vector3d.h"

/* Points of the plane in a tree of boxes, which finds those that may lie in a triangle. */

enum { AUR_CORNER_LEAF = 8 };

typedef struct aur_corner_tree {
    size_t leaf_count; /* a power of two; node 1 is the root, nodes 2 i and 2 i + 1 are in node i */
    const double (*points)[2];
    double (*boxes)[4]; /* of nodes: lowest x, lowest y, highest x, highest y */
    uint32_t *left;     /* of nodes: points that are not removed */
    uint32_t *sorted;   /* points by leaves, AUR_CORNER_LEAF each; in a leaf those that are left come first */
    uint32_t *place;    /* of points in `sorted` */
} aur_corner_tree;

/* Bytes that a tree of so many points needs; count below 2^31. */
size_t aur_corner_tree_size(size_t count);
/* Builds the tree in such memory, which is aligned for doubles; `points` are used as long as the tree is. */
void aur_corner_tree_build(aur_corner_tree *tree, size_t count, const double (*points)[2], void *memory);
void aur_corner_tree_remove(aur_corner_tree *tree, uint32_t point);

/* A walk over all points that may lie in a triangle or on its sides, and some others. */
typedef struct aur_corner_query {
    const aur_corner_tree *tree;
    double corners[3][2];
    double box[4], margin;
    size_t waiting;
    uint32_t nodes[40];
    uint32_t at, end; /* of `sorted` */
} aur_corner_query;

/* The triangle, which turns to the left or has no area, is widened by the margin. */
void aur_corner_query_begin(aur_corner_query *query, const aur_corner_tree *tree,
                            const double *const corners[3], double margin);
/* False at the end. */
bool aur_corner_query_next(aur_corner_query *query, uint32_t *point);

/* How much is forgiven. */
typedef enum aur_leniency {
    AUR_LENIENCY_NONE,
    AUR_LENIENCY_TOUCHING, /* corners may lie on a triangle's new side */
    AUR_LENIENCY_ROUNDED   /* corners within `slack` of a line are on it */
} aur_leniency;

typedef struct aur_ring_attempt {
    uint32_t node, version;
} aur_ring_attempt;

/* A side from a node to the next, with its extent; or a corner, with its place on a side. */
typedef struct aur_ring_side {
    double low, high;
    uint32_t node;
} aur_ring_side;

/* The outline that is left, as a ring of nodes that turns to the left. */
typedef struct aur_ring {
    size_t count;   /* of nodes, those that are gone included */
    size_t left;    /* of them */
    uint32_t start; /* one that is left */
    uint32_t *corner, *next, *previous, *version;
    double (*point)[2];
    aur_ring_attempt *queue; /* nodes to be tried, in this order */
    size_t head, tail;
    double slack;
    aur_leniency leniency;
    aur_ring_side *sides;
    aur_corner_tree tree;
    void *tree_memory;
    size_t triangle_count;
    uint32_t *triangles; /* of nodes */
} aur_ring;

/* Corners may lie on sides, where the ring gets further nodes: at most so many for an outline of `count`
 * corners. */
static inline size_t aur_ring_capacity(size_t count) {
    return 2 * count + 16;
}

/* Bytes that a ring needs. */
size_t aur_ring_size(size_t count);
/* An empty ring in such memory, aligned for doubles. */
void aur_ring_place(aur_ring *ring, size_t count, void *memory);
/* Links `count` corners at points[count], in reverse where `turned`. Corners on sides become nodes of them:
 * exactly on them, or within `slack` and moved together where they are that near, if `rounded`. */
void aur_ring_link(aur_ring *ring, size_t count, const double (*points)[2], bool turned, bool rounded);
/* Whether sides cross by more than the slack. */
bool aur_ring_crosses_itself(const aur_ring *ring);
/* Cuts all of it into triangles; false where that cannot be done. */
bool aur_ring_cut(aur_ring *ring);
/* Adds a triangle, beginning with its least node. */
void aur_ring_take(aur_ring *ring, const uint32_t nodes[3]);

static inline double aur_ring_turn(const aur_ring *r, uint32_t a, uint32_t b, uint32_t c) {
    return aur_orientation(r->point[a], r->point[b], r->point[c]);
}

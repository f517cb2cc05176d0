/* The outline of a polygon, triangulated by cutting off ears. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "points/base/vector3d.h"

/* Points of the plane in a tree of bounding boxes, to find those that may lie in a triangle. */

enum { AUR_CORNER_LEAF = 8 };

typedef struct aur_corner_tree {
    size_t leaf_count; /* a power of two; node 1 is the root, nodes 2 i and 2 i + 1 are in node i */
    const double (*points)[2];
    double (*boxes)[4]; /* box of each node: minimum x and y, maximum x and y */
    uint32_t *left;     /* of nodes: number of remaining points */
    uint32_t *sorted;   /* points by leaves, AUR_CORNER_LEAF each; remaining points come first in a leaf */
    uint32_t *index;    /* position of each point in `sorted` */
} aur_corner_tree;

/* Buffer size in bytes for a tree of `count` points; count below 2^31. */
size_t aur_corner_tree_size(size_t count);
/* Builds the tree in a buffer of that size, aligned for doubles. `points` must outlive the tree. */
void aur_corner_tree_build(aur_corner_tree *tree, size_t count, const double (*points)[2], void *memory);
void aur_corner_tree_remove(aur_corner_tree *tree, uint32_t point);

/* Iterates over all points that may lie in a triangle or on its edges; the set is conservative. */
typedef struct aur_corner_query {
    const aur_corner_tree *tree;
    double corners[3][2];
    double box[4], margin;
    size_t waiting;
    uint32_t nodes[40];
    uint32_t at, end; /* index into `sorted` */
} aur_corner_query;

/* Enlarges the triangle, which is counter-clockwise or degenerate, by the margin. */
void aur_corner_query_begin(aur_corner_query *query, const aur_corner_tree *tree,
                            const double *const corners[3], double margin);
/* False at the end. */
bool aur_corner_query_next(aur_corner_query *query, uint32_t *point);

/* Tolerances of the ear test. */
typedef enum aur_leniency {
    AUR_LENIENCY_NONE,
    AUR_LENIENCY_TOUCHING, /* corners may lie on the new edge of a triangle */
    AUR_LENIENCY_ROUNDED   /* corners within `slack` of a line count as on it */
} aur_leniency;

typedef struct aur_ring_attempt {
    uint32_t node, version;
} aur_ring_attempt;

/* An edge from a node to the next, with its extent; or a corner with its position on an edge. */
typedef struct aur_ring_side {
    double low, high;
    uint32_t node;
} aur_ring_side;

/* The remaining outline: a counter-clockwise ring of nodes. */
typedef struct aur_ring {
    size_t count;   /* number of nodes, including removed ones */
    size_t left;    /* number of remaining nodes */
    uint32_t start; /* any remaining node */
    uint32_t *corner, *next, *previous, *version;
    double (*point)[2];
    aur_ring_attempt *queue; /* nodes to test, in this order */
    size_t head, tail;
    double slack;
    aur_leniency leniency;
    aur_ring_side *sides;
    aur_corner_tree tree;
    void *tree_memory;
    size_t triangle_count;
    uint32_t *triangles; /* of nodes */
} aur_ring;

/* Corners that lie on edges add nodes to the ring: at most this many for an outline of `count` corners. */
static inline size_t aur_ring_capacity(size_t count) {
    return 2 * count + 16;
}

/* Buffer size in bytes for a ring. */
size_t aur_ring_size(size_t count);
/* An empty ring in a buffer of that size, aligned for doubles. */
void aur_ring_place(aur_ring *ring, size_t count, void *memory);
/* Links `count` corners at points[count], in reverse if `turned`. Corners on edges become nodes there:
 * exactly on the edge, or, if `rounded`, within `slack`, snapped together if closer than that. */
void aur_ring_link(aur_ring *ring, size_t count, const double (*points)[2], bool turned, bool rounded);
/* Whether edges cross by more than the slack. */
bool aur_ring_crosses_itself(const aur_ring *ring);
/* Triangulates the outline; false if that is impossible. */
bool aur_ring_cut(aur_ring *ring);
/* Adds a triangle, starting at its smallest node. */
void aur_ring_take(aur_ring *ring, const uint32_t nodes[3]);

static inline double aur_ring_turn(const aur_ring *r, uint32_t a, uint32_t b, uint32_t c) {
    return aur_orientation(r->point[a], r->point[b], r->point[c]);
}

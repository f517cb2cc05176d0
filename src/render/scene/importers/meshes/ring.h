/* An outline from which ears are cut off. */
#pragma once

#include "points/base/orientation.h"
#include "render/scene/importers/meshes/corner_tree.h"

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

/* Points of the plane in a tree of boxes, which finds those that may lie in a triangle. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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

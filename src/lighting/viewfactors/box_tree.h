/* A tree of boxes over things that have boxes. */
#pragma once

#include <stdint.h>

#include "points/base/error.h"

enum { AUR_BOX_LEAF = 2 };

/* The node's children follow it; `skip` is the node after all of them. */
typedef struct aur_box_node {
    double lower[3], upper[3];
    uint32_t first, count; /* of the tree's items */
    uint32_t skip;
} aur_box_node;

typedef struct aur_box_tree {
    size_t node_count;
    aur_box_node *nodes;
    uint32_t *items;
} aur_box_tree;

typedef struct aur_box {
    double lower[3], upper[3];
} aur_box;

aur_box aur_box_of(size_t count, const double (*corners)[3]);

/* Without boxes the tree has no nodes. Errors: MEMORY. */
aur_result aur_box_tree_create(size_t count, const aur_box *boxes, aur_box_tree *tree, aur_error *error);
void aur_box_tree_release(aur_box_tree *tree);

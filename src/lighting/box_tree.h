/* A tree of boxes over all facets. */
#pragma once

#include "lighting/facets.h"

enum { AUR_BOX_LEAF = 4 };

/* The node's children follow it; `skip` is the node after all of them. */
typedef struct aur_box_node {
    double lower[3], upper[3];
    uint32_t first, count; /* of the tree's facets */
    uint32_t skip;
} aur_box_node;

typedef struct aur_box_tree {
    size_t node_count;
    aur_box_node *nodes;
    uint32_t *facets;
} aur_box_tree;

/* Errors: MEMORY. */
aur_result aur_box_tree_create(const aur_facets *facets, aur_box_tree *tree, aur_error *error);
void aur_box_tree_release(aur_box_tree *tree);

/* Facets closer together than float rays can resolve, such as a rug on a floor. Double precision decides
 * which of them a ray hits first. */
#pragma once

#include <stdint.h>

#include "lighting/viewfactors/facets.h"
#include "points/base/error.h"

/* Offset of ray origins from a facet. */
float aur_facet_offset(const aur_facets *facets, size_t facet);

/* Lists in facets->covers the nearly parallel facets within that height in front of or behind each facet.
 * Errors: MEMORY. */
aur_result aur_facets_find_covers(aur_facets *facets, aur_error *error);

/* The facet that a ray from a point of `facet` hits first, given `met`, the hit in float precision (SIZE_MAX:
 * none). The direction has unit length. */
size_t aur_facets_first_met(const aur_facets *facets, size_t facet, const double origin[3],
                            const double direction[3], size_t met);

/* A bounding volume hierarchy. */

enum { AUR_BOX_LEAF = 2 };

/* The node's children follow it; `skip` is the index of the node after its subtree. */
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

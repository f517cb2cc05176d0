/* A balanced kd-tree over points (Bentley 1975), stored in place: the node of a range is its middle element,
 * so there are no pointers. The tree is a function of the points alone. */
#ifndef AUR_TRANSPORT_KD_TREE_H
#define AUR_TRANSPORT_KD_TREE_H

#include <stdbool.h>

#include "core/vector.h"
#include <aureole/core.h>

typedef struct aur_kd_node {
    aur_vector position;
    uint32_t item; /* index of the point as it was given; the split axis in the two top bits */
} aur_kd_node;

enum { AUR_KD_ITEM_BITS = 30 };

typedef struct aur_kd_tree {
    size_t count;
    aur_kd_node *nodes;
} aur_kd_tree;

/* At most 2^30 points. Fails with AUR_ERROR_MEMORY or, beyond that, AUR_ERROR_ARGUMENT. */
aur_result aur_kd_tree_build(aur_kd_tree *tree, size_t count, const aur_vector *positions, size_t threads);
void aur_kd_tree_release(aur_kd_tree *tree);

/* Which points count in a search; NULL: all. */
typedef bool (*aur_kd_accept)(const void *context, uint32_t item);

typedef struct aur_kd_neighbour {
    float distance_squared;
    uint32_t item;
} aur_kd_neighbour;

/* The (up to) k nearest accepted points within `radius`, in no particular order but the same one every time;
 * returns how many. */
size_t aur_kd_tree_nearest(const aur_kd_tree *tree, aur_vector position, float radius, aur_kd_accept accept,
                           const void *context, size_t k, aur_kd_neighbour *neighbours);

#endif

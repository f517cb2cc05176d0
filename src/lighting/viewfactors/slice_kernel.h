/* Occluders of the sky in half planes that begin at a facet, several at once. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "points/base/simd.h"

enum {
    AUR_SLICE_LANES = 16,
    AUR_SLICE_WORDS = 4,
    AUR_SLICE_CELLS = 32 * AUR_SLICE_WORDS,
    AUR_SLICE_CORNERS = 8
};

/* Coordinates are permuted so that the third axis is parallel to the edge line of a facet's half planes. */
typedef struct aur_slice_node {
    float lower[3], upper[3];
    uint32_t first, count; /* of the tree's polygons; a node with more of them than a leaf */
    uint32_t skip;         /* is followed by its children; this is the index of the node after its subtree */
} aur_slice_node;

/* Convex. */
typedef struct aur_slice_polygon {
    uint32_t count;
    float corners[AUR_SLICE_CORNERS][3];
} aur_slice_polygon;

typedef struct aur_slice_tree {
    uint32_t leaf; /* maximum number of polygons of a leaf */
    aur_slice_node *nodes;
    aur_slice_polygon *polygons;
} aur_slice_tree;

/* The sum of both weights over the cells of a word of bits, and their range there. */
typedef struct aur_slice_word {
    float rising, level, lowest_rising, highest_rising, lowest_level, highest_level;
} aur_slice_word;

/* The receiving patch. A polygon without a corner more than `slack` in front of its plane hides nothing. Its
 * directions have sines of elevation from `lowest` on, in AUR_SLICE_CELLS cells of `width`. */
typedef struct aur_slice_view {
    double normal[3], offset, slack;
    float lowest, width;
    /* Per cell, factors of the normal's third component and of its component along the way: the cell's weight
     * in the view. */
    float rising[AUR_SLICE_CELLS], level[AUR_SLICE_CELLS];
    aur_slice_word words[AUR_SLICE_WORDS];
} aur_slice_view;

typedef struct aur_slices {
    float origin[3][AUR_SLICE_LANES];
    float way[2][AUR_SLICE_LANES]; /* of unit length */
    float jitter[AUR_SLICE_LANES]; /* position in [0,1) at which a half plane's cells are tested */
} aur_slices;

/* The weight of each half plane, and its part that sees the sky. */
typedef struct aur_slice_parts {
    float whole[AUR_SLICE_LANES], sky[AUR_SLICE_LANES];
} aur_slice_parts;

typedef void aur_slice_kernel(const aur_slice_tree *tree, const aur_slice_view *view,
                              const aur_slices *slices, aur_slice_parts *parts);

AUR_KERNELS(aur_slice_kernel, aur_slice_kernel);

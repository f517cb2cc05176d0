/* What hides the sky in half planes that end at a facet, several at once. */
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

/* Coordinates are turned so that the third one is along the line in which the half planes of a facet end. */
typedef struct aur_slice_node {
    float lower[3], upper[3];
    uint32_t first, count; /* of the tree's polygons; the children of a node with more of them than a leaf */
    uint32_t skip;         /* follow it, and this is the node after them */
} aur_slice_node;

/* Convex. */
typedef struct aur_slice_polygon {
    uint32_t count;
    float corners[AUR_SLICE_CORNERS][3];
} aur_slice_polygon;

typedef struct aur_slice_tree {
    uint32_t leaf; /* the most polygons of one */
    aur_slice_node *nodes;
    aur_slice_polygon *polygons;
} aur_slice_tree;

/* The sum of both numbers over the cells of a word of bits, and their range there. */
typedef struct aur_slice_word {
    float rising, level, lowest_rising, highest_rising, lowest_level, highest_level;
} aur_slice_word;

/* The patch that looks. What has no corner farther than `slack` before its plane hides nothing. Its
 * directions have sines of elevation from `lowest` on, in AUR_SLICE_CELLS cells of `width`. */
typedef struct aur_slice_view {
    double normal[3], offset, slack;
    float lowest, width;
    /* Of each cell, of the third coordinate and of the way: times those of the normal, how much of the view
     * it is. */
    float rising[AUR_SLICE_CELLS], level[AUR_SLICE_CELLS];
    aur_slice_word words[AUR_SLICE_WORDS];
} aur_slice_view;

typedef struct aur_slices {
    float origin[3][AUR_SLICE_LANES];
    float way[2][AUR_SLICE_LANES]; /* of unit length */
    float jitter[AUR_SLICE_LANES]; /* where in all its cells a half plane is looked at, in [0,1) */
} aur_slices;

/* How much of the view each half plane is, and how much of that the sky. */
typedef struct aur_slice_parts {
    float whole[AUR_SLICE_LANES], sky[AUR_SLICE_LANES];
} aur_slice_parts;

typedef void aur_slice_kernel(const aur_slice_tree *tree, const aur_slice_view *view,
                              const aur_slices *slices, aur_slice_parts *parts);

AUR_KERNELS(aur_slice_kernel, aur_slice_kernel);

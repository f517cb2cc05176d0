/* A tree over light sources (Conty Estevez and Kulla 2018): each node bounds where its lights are, which way
 * they shine, and how much. A light is drawn by going down the tree, at each node to one of its children in
 * proportion to about what it brings to the reference. Nodes have up to sixteen children, which vector
 * code compares at once: fewer bounds are wide than in a tree of pairs. */
#pragma once

#include "points/base/simd.h"
#include "render/scene/lanes.h"

/* Of a light source, or of a triangle of one. Angles in radians. */
typedef struct aur_light_bounds {
    double lower[3], upper[3]; /* a box that holds it */
    double axis[3];            /* unit */
    double spread;             /* its normals make at most this angle with the axis */
    double emission;           /* light leaves at most at this angle to a normal */
    double power;              /* relative; 0: it is never drawn */
    double spread_cosine;      /* set by aur_light_tree_create */
} aur_light_bounds;

enum { AUR_LIGHT_CHILDREN = AUR_PACKET_SIZE };

/* The children of all nodes, those of a node side by side, an array a number; behind them there is room for
 * those that a last node lacks. */
typedef struct aur_light_children {
    float *center[3]; /* of a sphere about the child's box */
    float *axis[3];
    float *radius; /* with room for rounding */
    float *power;  /* as a part of the node's */
    float *spread_cosine, *spread_sine;
    float *dark_cosine; /* of the angle beyond the spread: dark where it is below that */
} aur_light_children;

typedef struct aur_light_node {
    uint32_t first, count; /* of its children */
    uint32_t parent, slot; /* whose child it is, and which; the root is its own parent */
} aur_light_node;

#define AUR_LIGHT_LEAF (UINT32_C(1) << 31)

/* Where a light hangs. */
typedef struct aur_light_leaf {
    uint32_t node, slot; /* AUR_LIGHT_LEAF: nowhere, it is never drawn */
} aur_light_leaf;

typedef struct aur_light_kernels {
    /* What sixteen children from `first` on bring to the reference, about and up to a factor; 0 where that is
     * surely nothing. */
    void (*importance)(const aur_light_children *children, uint32_t first,
                       const aur_light_reference *reference, float *importance);
} aur_light_kernels;

AUR_KERNELS(const aur_light_kernels, aur_light_kernels);

typedef struct aur_light_tree {
    size_t node_count, child_count;
    aur_light_node *nodes;  /* the root first; parents before children */
    uint32_t *targets;      /* of each child: a node, or with AUR_LIGHT_LEAF a light */
    aur_light_leaf *leaves; /* one for each light that was given */
    float *numbers;         /* of the children */
    aur_light_children children;
    const aur_light_kernels *kernels;
} aur_light_tree;

/* Over `count` lights, below 2^31, of which two or more have power. Errors: MEMORY; nothing is to be released
 * then. */
aur_result aur_light_tree_create(aur_light_tree *tree, size_t count, aur_light_bounds *bounds,
                                 aur_error *error);
void aur_light_tree_release(aur_light_tree *tree);

/* The light that *u in [0,1) falls on, and the probability with which it does; *u becomes what is left, again
 * in [0,1). False: no light can reach the reference. */
bool aur_light_tree_choose(const aur_light_tree *tree, const aur_light_reference *reference, double *u,
                           uint32_t *light, float *probability);
/* The probability of a light. */
float aur_light_tree_probability(const aur_light_tree *tree, const aur_light_reference *reference,
                                 uint32_t light);

/* A light tree (Conty Estevez and Kulla 2018): each node bounds the positions, orientations and power of its
 * lights. A light is sampled by descending the tree, selecting children in proportion to their approximate
 * contribution to the reference. Nodes have up to sixteen children, which are evaluated by vector code: fewer
 * bounds are loose than in a binary tree. */
#pragma once

#include "points/base/random.h"
#include "points/base/simd.h"
#include "render/scene/lanes.h"

/* Of a light source, or of a triangle of a mesh light. Angles in radians. */
typedef struct aur_light_bounds {
    double lower[3], upper[3]; /* bounding box */
    double axis[3];            /* unit */
    double spread;             /* largest angle of a normal from the axis */
    double emission;           /* largest angle of emission from a normal */
    double power;              /* relative; 0: never sampled */
    double spread_cosine;      /* set by aur_light_tree_create */
} aur_light_bounds;

enum { AUR_LIGHT_CHILDREN = AUR_PACKET_SIZE };

/* The children of all nodes as arrays, those of a node consecutive. The arrays are padded, so that sixteen
 * children can be read at the last node. */
typedef struct aur_light_children {
    float *center[3]; /* of the bounding sphere of the child's box */
    float *axis[3];
    float *radius; /* with a margin for rounding */
    float *power;  /* relative to the node's */
    float *spread_cosine, *spread_sine;
    float *dark_cosine; /* of the angle beyond the spread: dark below it */
} aur_light_children;

typedef struct aur_light_node {
    uint32_t first, count; /* of its children */
    uint32_t parent, slot; /* the parent node, and the index in it; the root is its own parent */
} aur_light_node;

#define AUR_LIGHT_LEAF (UINT32_C(1) << 31)

/* The leaf of a light. */
typedef struct aur_light_leaf {
    uint32_t node, slot; /* AUR_LIGHT_LEAF: none, it is never sampled */
} aur_light_leaf;

/* What sixteen lanes choose. */
typedef struct aur_light_draws {
    _Alignas(64) double rest[AUR_PACKET_SIZE]; /* numbers in [0,1); after a choice their remainders */
    double index[AUR_PACKET_SIZE];             /* chosen */
    double probability[AUR_PACKET_SIZE];       /* of the child; 0: none is possible */
} aur_light_draws;

/* Appends bits, derived from u and v alone, below the 24 bits of `choice`: a tree may have more lights than
 * 2^24. */
static inline double aur_light_digits(float choice, uint32_t u, uint32_t v) {
    return (double)choice + 0x1p-24 * aur_unit_double(aur_hash2(u, v));
}

typedef struct aur_light_kernels {
    /* The approximate relative contribution of sixteen children from `first` on to the reference; 0 only if
     * there is surely none. */
    void (*importance)(const aur_light_children *children, uint32_t first,
                       const aur_light_reference *reference, float *importance);
    /* Of `count` children, one for each lane by draws->rest, as aur_light_tree_choose does. */
    void (*choose)(const aur_light_children *children, uint32_t first, uint32_t count,
                   const aur_light_references *references, aur_light_draws *draws);
    /* Items of a distribution by draws->rest, as aur_distribution_choose_double does; all have weight. */
    void (*items)(size_t count, const double *sums, aur_light_draws *draws);
    /* aur_light_digits of all lanes. */
    void (*digits)(const float *choice, const float *u, const float *v, double *digits);
} aur_light_kernels;

AUR_KERNELS(const aur_light_kernels, aur_light_kernels);

typedef struct aur_light_tree {
    size_t node_count, child_count;
    aur_light_node *nodes;  /* the root first; parents before children */
    uint32_t *targets;      /* of each child: a node, or with AUR_LIGHT_LEAF a light */
    aur_light_leaf *leaves; /* one per light */
    float *numbers;         /* of the children */
    aur_light_children children;
    const aur_light_kernels *kernels;
} aur_light_tree;

/* From `count` lights, below 2^31, at least two of them with power. Errors: MEMORY; nothing must be released
 * then. */
aur_result aur_light_tree_create(aur_light_tree *tree, size_t count, aur_light_bounds *bounds,
                                 aur_error *error);
void aur_light_tree_release(aur_light_tree *tree);

/* The light selected by *u in [0,1), and its probability; *u becomes the remainder, again in [0,1). False: no
 * light can reach the reference. */
bool aur_light_tree_choose(const aur_light_tree *tree, const aur_light_reference *reference, double *u,
                           uint32_t *light, float *probability);
/* The same from a target on, which is chosen already: *product times the probabilities of the further
 * choices.
 */
bool aur_light_tree_descend(const aur_light_tree *tree, const aur_light_reference *reference, uint32_t target,
                            double *u, uint32_t *light, double *product);
/* The probability of a light. */
float aur_light_tree_probability(const aur_light_tree *tree, const aur_light_reference *reference,
                                 uint32_t light);

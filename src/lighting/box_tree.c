#include "lighting/box_tree.h"

#include <stdlib.h>
#include <string.h>

/* Boxes are halved at their middle facet along the longest axis of the facets' middles. */

typedef struct middle {
    double at[3];
    uint32_t facet;
} middle;

static int compare_along(const middle *a, const middle *b, int axis) {
    if (a->at[axis] != b->at[axis])
        return a->at[axis] < b->at[axis] ? -1 : 1;
    return (a->facet > b->facet) - (a->facet < b->facet);
}

static int compare_x(const void *a, const void *b) {
    return compare_along(a, b, 0);
}
static int compare_y(const void *a, const void *b) {
    return compare_along(a, b, 1);
}
static int compare_z(const void *a, const void *b) {
    return compare_along(a, b, 2);
}

static int longest_axis(const middle *middles, size_t count) {
    double low[3], high[3];
    memcpy(low, middles[0].at, sizeof low);
    memcpy(high, middles[0].at, sizeof high);
    for (size_t i = 1; i < count; ++i)
        for (int d = 0; d < 3; ++d) {
            low[d] = fmin(low[d], middles[i].at[d]);
            high[d] = fmax(high[d], middles[i].at[d]);
        }
    int axis = 0;
    for (int d = 1; d < 3; ++d)
        if (high[d] - low[d] > high[axis] - low[axis])
            axis = d;
    return axis;
}

static void bound(const aur_facets *facets, const aur_box_tree *tree, aur_box_node *node) {
    for (int d = 0; d < 3; ++d) {
        node->lower[d] = INFINITY;
        node->upper[d] = -INFINITY;
    }
    for (size_t i = node->first; i < node->first + node->count; ++i)
        for (size_t c = 0; c < 3; ++c)
            for (int d = 0; d < 3; ++d) {
                const double x = facets->corners[tree->facets[i]][c][d];
                node->lower[d] = fmin(node->lower[d], x);
                node->upper[d] = fmax(node->upper[d], x);
            }
}

/* The node over middles[first] .. and those below it; nodes stand in the order of a walk through the tree. */
static void build(const aur_facets *facets, aur_box_tree *tree, middle *middles, size_t first, size_t count) {
    static int (*const compare[3])(const void *, const void *) = {compare_x, compare_y, compare_z};
    aur_box_node *const node = &tree->nodes[tree->node_count++];
    node->first = (uint32_t)first;
    node->count = (uint32_t)count;
    if (count > AUR_BOX_LEAF) {
        const int axis = longest_axis(middles + first, count);
        qsort(middles + first, count, sizeof *middles, compare[axis]);
        build(facets, tree, middles, first, count / 2);
        build(facets, tree, middles, first + count / 2, count - count / 2);
    } else {
        for (size_t i = first; i < first + count; ++i)
            tree->facets[i] = middles[i].facet;
    }
    node->skip = (uint32_t)tree->node_count;
    bound(facets, tree, node);
}

aur_result aur_box_tree_create(const aur_facets *facets, aur_box_tree *tree, aur_error *error) {
    *tree = (aur_box_tree){0};
    middle *const middles = malloc(facets->count * sizeof *middles);
    tree->facets = malloc(facets->count * sizeof *tree->facets);
    tree->nodes = malloc(2 * facets->count * sizeof *tree->nodes);
    if (middles == NULL || tree->facets == NULL || tree->nodes == NULL) {
        free(middles);
        aur_box_tree_release(tree);
        return aur_fail_memory(error);
    }
    for (size_t i = 0; i < facets->count; ++i) {
        middles[i].facet = (uint32_t)i;
        for (int d = 0; d < 3; ++d)
            middles[i].at[d] = facets->corners[i][0][d] + facets->corners[i][1][d] + facets->corners[i][2][d];
    }
    build(facets, tree, middles, 0, facets->count);
    free(middles);
    return AUR_OK;
}

void aur_box_tree_release(aur_box_tree *tree) {
    free(tree->facets);
    free(tree->nodes);
    *tree = (aur_box_tree){0};
}

#include "lighting/viewfactors/covers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Boxes are split at the median item along the longest axis of the items' centres. */

typedef struct middle {
    double at[3];
    uint32_t item;
} middle;

static int compare_along(const middle *a, const middle *b, int axis) {
    if (a->at[axis] != b->at[axis])
        return a->at[axis] < b->at[axis] ? -1 : 1;
    return (a->item > b->item) - (a->item < b->item);
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

aur_box aur_box_of(size_t count, const double (*corners)[3]) {
    aur_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t c = 0; c < count; ++c)
        for (int d = 0; d < 3; ++d) {
            box.lower[d] = fmin(box.lower[d], corners[c][d]);
            box.upper[d] = fmax(box.upper[d], corners[c][d]);
        }
    return box;
}

static void bound(const aur_box *boxes, const aur_box_tree *tree, aur_box_node *node) {
    for (int d = 0; d < 3; ++d) {
        node->lower[d] = INFINITY;
        node->upper[d] = -INFINITY;
    }
    for (size_t i = node->first; i < node->first + node->count; ++i)
        for (int d = 0; d < 3; ++d) {
            node->lower[d] = fmin(node->lower[d], boxes[tree->items[i]].lower[d]);
            node->upper[d] = fmax(node->upper[d], boxes[tree->items[i]].upper[d]);
        }
}

/* Builds the node over middles[first] .. and its descendants, in depth-first order. */
static void build(const aur_box *boxes, aur_box_tree *tree, middle *middles, size_t first, size_t count) {
    static int (*const compare[3])(const void *, const void *) = {compare_x, compare_y, compare_z};
    aur_box_node *const node = &tree->nodes[tree->node_count++];
    node->first = (uint32_t)first;
    node->count = (uint32_t)count;
    if (count > AUR_BOX_LEAF) {
        const int axis = longest_axis(middles + first, count);
        qsort(middles + first, count, sizeof *middles, compare[axis]);
        build(boxes, tree, middles, first, count / 2);
        build(boxes, tree, middles, first + count / 2, count - count / 2);
    } else {
        for (size_t i = first; i < first + count; ++i)
            tree->items[i] = middles[i].item;
    }
    node->skip = (uint32_t)tree->node_count;
    bound(boxes, tree, node);
}

aur_result aur_box_tree_create(size_t count, const aur_box *boxes, aur_box_tree *tree, aur_error *error) {
    *tree = (aur_box_tree){0};
    if (count == 0)
        return AUR_OK;
    middle *const middles = malloc(count * sizeof *middles);
    tree->items = malloc(count * sizeof *tree->items);
    tree->nodes = malloc(2 * count * sizeof *tree->nodes);
    if (middles == NULL || tree->items == NULL || tree->nodes == NULL) {
        free(middles);
        aur_box_tree_release(tree);
        return aur_fail_memory(error);
    }
    for (size_t i = 0; i < count; ++i) {
        middles[i].item = (uint32_t)i;
        for (int d = 0; d < 3; ++d)
            middles[i].at[d] = boxes[i].lower[d] + boxes[i].upper[d];
    }
    build(boxes, tree, middles, 0, count);
    free(middles);
    return AUR_OK;
}

void aur_box_tree_release(aur_box_tree *tree) {
    free(tree->items);
    free(tree->nodes);
    *tree = (aur_box_tree){0};
}

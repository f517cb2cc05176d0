#include "points/sphere/nearest/inverse.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "points/base/error.h"

enum { LEAF = 8, MOST_DIMENSIONS = 8 };

/* Nodes as in a heap: node k has the children 2k + 1 and 2k + 2, and its points are a range of `order` that
 * halves from level to level. */
struct aur_tree {
    size_t dimension, count, level_count;
    size_t *order;       /* the points' indices */
    double *coordinates; /* of the points, in that order */
    struct split {
        size_t axis;
        double value;
    } * splits; /* 2^level_count - 1 */
};

/* The axis of the largest extent of the points. */
static size_t widest_axis(const aur_tree *tree, size_t stride, const double *given, size_t first,
                          size_t last) {
    size_t widest = 0;
    double width = -1.0;
    for (size_t d = 0; d < tree->dimension; ++d) {
        double least = INFINITY, greatest = -INFINITY;
        for (size_t i = first; i < last; ++i) {
            const double x = given[tree->order[i] * stride + d];
            least = fmin(least, x);
            greatest = fmax(greatest, x);
        }
        if (greatest - least > width) {
            width = greatest - least;
            widest = d;
        }
    }
    return widest;
}

/* Moves the smaller half along an axis before `middle` (Hoare 1961). */
static void select_half(size_t *order, size_t stride, const double *along, size_t first, size_t middle,
                        size_t last) {
    while (last - first > 1) {
        const double pivot = along[order[first + (last - first - 1) / 2] * stride]; /* never the last */
        size_t i = first, j = last - 1;
        for (;;) {
            while (along[order[i] * stride] < pivot)
                ++i;
            while (along[order[j] * stride] > pivot)
                --j;
            if (i >= j)
                break;
            const size_t swapped = order[i];
            order[i++] = order[j];
            order[j--] = swapped;
        }
        const size_t cut = j + 1;
        if (middle < cut)
            last = cut;
        else
            first = cut;
    }
}

static void split_range(aur_tree *tree, size_t stride, const double *given, size_t node, size_t level,
                        size_t first, size_t last) {
    if (level == tree->level_count)
        return;
    const size_t middle = first + (last - first) / 2;
    const size_t axis = widest_axis(tree, stride, given, first, last);
    select_half(tree->order, stride, given + axis, first, middle, last);
    tree->splits[node].axis = axis;
    tree->splits[node].value = given[tree->order[middle] * stride + axis];
    split_range(tree, stride, given, 2 * node + 1, level + 1, first, middle);
    split_range(tree, stride, given, 2 * node + 2, level + 1, middle, last);
}

aur_result aur_tree_create(size_t dimension, size_t count, size_t stride, const double *coordinates,
                           aur_tree **tree, aur_error *error) {
    *tree = NULL;
    aur_tree *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    created->dimension = dimension;
    created->count = count;
    while (count >> created->level_count > LEAF)
        ++created->level_count;
    created->order = calloc(count, sizeof *created->order);
    created->coordinates = calloc(count * dimension, sizeof *created->coordinates);
    created->splits = calloc((size_t)1 << created->level_count, sizeof *created->splits);
    if (created->order == NULL || created->coordinates == NULL || created->splits == NULL) {
        aur_tree_destroy(created);
        return aur_fail_memory(error);
    }
    for (size_t i = 0; i < count; ++i)
        created->order[i] = i;
    split_range(created, stride, coordinates, 0, 0, 0, count);
    for (size_t i = 0; i < count; ++i)
        for (size_t d = 0; d < dimension; ++d)
            created->coordinates[i * dimension + d] = coordinates[created->order[i] * stride + d];
    *tree = created;
    return AUR_OK;
}

void aur_tree_destroy(aur_tree *tree) {
    if (tree == NULL)
        return;
    free(tree->order);
    free(tree->coordinates);
    free(tree->splits);
    free(tree);
}

typedef struct search {
    const aur_tree *tree;
    const double *query;
    size_t requested, count;
    aur_found *found; /* in order */
} search;

static void offer(search *s, aur_found point) {
    size_t at = s->count;
    if (at == s->requested) {
        const aur_found worst = s->found[at - 1];
        if (point.square > worst.square || (point.square == worst.square && point.index > worst.index))
            return;
        --at;
    } else {
        ++s->count;
    }
    for (; at > 0; --at) {
        const aur_found before = s->found[at - 1];
        if (before.square < point.square || (before.square == point.square && before.index < point.index))
            break;
        s->found[at] = before;
    }
    s->found[at] = point;
}

static void visit(search *s, size_t first, size_t last) {
    const aur_tree *const tree = s->tree;
    for (size_t i = first; i < last; ++i) {
        double square = 0.0;
        for (size_t d = 0; d < tree->dimension; ++d) {
            const double apart = tree->coordinates[i * tree->dimension + d] - s->query[d];
            square += apart * apart;
        }
        offer(s, (aur_found){square, tree->order[i]});
    }
}

/* `apart` are the distances along the axes to the node's box, `square` the sum of their squares. */
static void descend(search *s, size_t node, size_t level, size_t first, size_t last,
                    double apart[MOST_DIMENSIONS], double square) {
    if (level == s->tree->level_count) {
        visit(s, first, last);
        return;
    }
    const struct split *const split = &s->tree->splits[node];
    const size_t middle = first + (last - first) / 2;
    const double side = s->query[split->axis] - split->value;
    const bool right = side >= 0.0;
    if (right)
        descend(s, 2 * node + 2, level + 1, middle, last, apart, square);
    else
        descend(s, 2 * node + 1, level + 1, first, middle, apart, square);
    const double before = apart[split->axis];
    const double beyond = square - before * before + side * side;
    /* Ties may have a smaller index; the slack prevents missing a point by rounding. */
    if (s->count == s->requested && beyond * (1.0 - 1e-12) > s->found[s->count - 1].square)
        return;
    apart[split->axis] = side;
    if (right)
        descend(s, 2 * node + 1, level + 1, first, middle, apart, beyond);
    else
        descend(s, 2 * node + 2, level + 1, middle, last, apart, beyond);
    apart[split->axis] = before;
}

size_t aur_tree_find(const aur_tree *tree, const double *query, size_t requested, aur_found *found) {
    search s = {tree, query, requested, 0, found};
    double apart[MOST_DIMENSIONS] = {0.0};
    if (requested > 0)
        descend(&s, 0, 0, 0, tree->count, apart, 0.0);
    return s.count;
}

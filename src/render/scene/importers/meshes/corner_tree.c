#include "render/scene/importers/meshes/ring.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A point with its index on a space-filling Z-order curve (Morton 1966). */
typedef struct entry {
    uint64_t code;
    uint32_t point;
} entry;

static size_t leaves_of(size_t count) {
    size_t leaves = 1;
    while (leaves * AUR_CORNER_LEAF < count)
        leaves *= 2;
    return leaves;
}

static size_t padded(size_t bytes) {
    return (bytes + 15) / 16 * 16;
}

size_t aur_corner_tree_size(size_t count) {
    const size_t leaves = leaves_of(count);
    return padded(2 * leaves * sizeof(double[4])) + padded(2 * leaves * sizeof(uint32_t)) +
           padded(leaves * AUR_CORNER_LEAF * sizeof(uint32_t)) + padded(count * sizeof(uint32_t)) +
           padded(count * sizeof(entry));
}

/* Spreads the low 32 bits, with a zero bit after each. */
static uint64_t spread(uint64_t x) {
    static const uint64_t masks[] = {0x0000ffff0000ffff, 0x00ff00ff00ff00ff, 0x0f0f0f0f0f0f0f0f,
                                     0x3333333333333333, 0x5555555555555555};
    for (unsigned i = 0, shift = 16; i < 5; ++i, shift /= 2)
        x = (x | x << shift) & masks[i];
    return x;
}

static int compare_entries(const void *left, const void *right) {
    const entry *const a = left, *const b = right;
    if (a->code != b->code)
        return a->code < b->code ? -1 : 1;
    return (a->point > b->point) - (a->point < b->point);
}

static void widen(double box[4], const double low[2], const double high[2]) {
    for (int d = 0; d < 2; ++d) {
        box[d] = fmin(box[d], low[d]);
        box[2 + d] = fmax(box[2 + d], high[d]);
    }
}

static void sort_points(aur_corner_tree *tree, size_t count, entry *entries) {
    double all[4] = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < count; ++i)
        widen(all, tree->points[i], tree->points[i]);
    for (size_t i = 0; i < count; ++i) {
        entries[i] = (entry){.point = (uint32_t)i};
        for (int d = 0; d < 2; ++d) {
            const double size = all[2 + d] - all[d];
            const double part = size > 0.0 ? (tree->points[i][d] - all[d]) / size : 0.0;
            entries[i].code |= spread((uint64_t)(part * 4294967295.0)) << d;
        }
    }
    qsort(entries, count, sizeof *entries, compare_entries);
    for (size_t i = 0; i < count; ++i) {
        tree->sorted[i] = entries[i].point;
        tree->index[entries[i].point] = (uint32_t)i;
    }
}

void aur_corner_tree_build(aur_corner_tree *tree, size_t count, const double (*points)[2], void *memory) {
    char *free_memory = memory;
    const size_t leaves = leaves_of(count);
    *tree = (aur_corner_tree){.leaf_count = leaves, .points = points};
    tree->boxes = (double(*)[4])(void *)free_memory;
    free_memory += padded(2 * leaves * sizeof *tree->boxes);
    tree->left = (uint32_t *)(void *)free_memory;
    free_memory += padded(2 * leaves * sizeof *tree->left);
    tree->sorted = (uint32_t *)(void *)free_memory;
    free_memory += padded(leaves * AUR_CORNER_LEAF * sizeof *tree->sorted);
    tree->index = (uint32_t *)(void *)free_memory;
    free_memory += padded(count * sizeof *tree->index);
    sort_points(tree, count, (entry *)(void *)free_memory);
    for (size_t node = 2 * leaves; node-- > 1;) {
        double *const box = tree->boxes[node];
        box[0] = box[1] = HUGE_VAL;
        box[2] = box[3] = -HUGE_VAL;
        tree->left[node] = 0;
        for (size_t child = 2 * node; node < leaves && child < 2 * node + 2; ++child) {
            widen(box, tree->boxes[child], tree->boxes[child] + 2);
            tree->left[node] += tree->left[child];
        }
        const size_t first = node < leaves ? count : (node - leaves) * AUR_CORNER_LEAF;
        for (size_t i = first; i < first + AUR_CORNER_LEAF && i < count; ++i, ++tree->left[node])
            widen(box, points[tree->sorted[i]], points[tree->sorted[i]]);
    }
}

void aur_corner_tree_remove(aur_corner_tree *tree, uint32_t point) {
    const uint32_t index = tree->index[point];
    size_t node = tree->leaf_count + index / AUR_CORNER_LEAF;
    const uint32_t last = index / AUR_CORNER_LEAF * AUR_CORNER_LEAF + tree->left[node] - 1;
    tree->sorted[index] = tree->sorted[last];
    tree->index[tree->sorted[index]] = index;
    for (; node > 0; node /= 2)
        --tree->left[node];
}

/* Whether the box lies entirely to the right of a triangle side, even with rounding. */
static bool is_apart(const aur_corner_query *query, const double box[4]) {
    for (size_t i = 0; i < 3; ++i) {
        const double *const a = query->corners[i], *const b = query->corners[(i + 1) % 3];
        const double x = b[0] - a[0], y = b[1] - a[1];
        const double left = x * ((x > 0.0 ? box[3] : box[1]) - a[1]);
        const double right = y * ((y > 0.0 ? box[0] : box[2]) - a[0]);
        if (left - right < -1e-14 * (fabs(left) + fabs(right)) - query->margin * hypot(x, y))
            return true;
    }
    return false;
}

void aur_corner_query_begin(aur_corner_query *query, const aur_corner_tree *tree,
                            const double *const corners[3], double margin) {
    query->tree = tree;
    query->box[0] = query->box[1] = HUGE_VAL;
    query->box[2] = query->box[3] = -HUGE_VAL;
    for (size_t i = 0; i < 3; ++i) {
        memcpy(query->corners[i], corners[i], sizeof query->corners[i]);
        widen(query->box, corners[i], corners[i]);
    }
    for (int d = 0; d < 2; ++d) {
        query->box[d] -= margin;
        query->box[2 + d] += margin;
    }
    query->margin = margin;
    query->nodes[0] = 1;
    query->waiting = 1;
    query->at = query->end = 0;
}

static bool overlap(const double a[4], const double b[4]) {
    return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

bool aur_corner_query_next(aur_corner_query *query, uint32_t *point) {
    const aur_corner_tree *const tree = query->tree;
    for (;;) {
        while (query->at < query->end) {
            const uint32_t p = tree->sorted[query->at++];
            const double *const x = tree->points[p];
            const double box[4] = {x[0], x[1], x[0], x[1]};
            if (overlap(box, query->box)) {
                *point = p;
                return true;
            }
        }
        if (query->waiting == 0)
            return false;
        const uint32_t node = query->nodes[--query->waiting];
        if (tree->left[node] == 0 || !overlap(tree->boxes[node], query->box) ||
            is_apart(query, tree->boxes[node]))
            continue;
        if (node >= tree->leaf_count) {
            query->at = (uint32_t)(node - tree->leaf_count) * AUR_CORNER_LEAF;
            query->end = query->at + tree->left[node];
        } else {
            query->nodes[query->waiting++] = 2 * node + 1;
            query->nodes[query->waiting++] = 2 * node;
        }
    }
}

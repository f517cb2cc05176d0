/* The nearest of any points in a few dimensions: a k-d tree (Friedman, Bentley and Finkel 1977). */
#pragma once

#include <aureole/core.h>
#include <stddef.h>

typedef struct aur_tree aur_tree;

typedef struct aur_found {
    double square; /* of the distance */
    size_t index;
} aur_found;

/* Copies the points: `count` of them, `stride` doubles apart, 1 to 8 dimensions, at least one. Errors:
 * MEMORY. */
aur_result aur_tree_create(size_t dimension, size_t count, size_t stride, const double *coordinates,
                           aur_tree **tree, aur_error *error);
void aur_tree_destroy(aur_tree *tree); /* NULL is allowed */

/* The `wanted` points nearest to `query`, or all if there are fewer, nearest first, ties by index; returns
 * how many. */
size_t aur_tree_find(const aur_tree *tree, const double *query, size_t wanted, aur_found *found);

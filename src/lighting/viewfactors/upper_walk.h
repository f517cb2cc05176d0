/* Iterates over the entries of a symmetric matrix from the diagonal on, row by row, with the index of the
 * mirrored entry. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct aur_upper_walk {
    size_t rows;
    const uint64_t *starts;
    const uint32_t *columns;
    uint64_t *next; /* per row, the next entry below the diagonal; then the row's own */
    size_t row, column;
    uint64_t entry, mirror; /* the index of the mirrored entry */
} aur_upper_walk;

/* Compressed rows with ascending columns. False if out of memory. */
static inline bool aur_upper_walk_begin(size_t rows, const uint64_t *starts, const uint32_t *columns,
                                        aur_upper_walk *walk) {
    *walk = (aur_upper_walk){rows, starts, columns, malloc((rows + 1) * sizeof *walk->next), 0, 0, 0, 0};
    if (walk->next != NULL)
        memcpy(walk->next, starts, rows * sizeof *walk->next);
    return walk->next != NULL;
}

/* Advances to the next entry; false after the last one, when the iterator has been released. */
static inline bool aur_upper_walk_advance(aur_upper_walk *walk) {
    while (walk->row < walk->rows && walk->next[walk->row] == walk->starts[walk->row + 1])
        ++walk->row;
    if (walk->row == walk->rows) {
        free(walk->next);
        return false;
    }
    walk->entry = walk->mirror = walk->next[walk->row]++;
    walk->column = walk->columns[walk->entry];
    if (walk->column != walk->row)
        walk->mirror = walk->next[walk->column]++;
    return true;
}

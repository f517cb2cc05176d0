/* Arrays that grow, by products that are checked. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "points/base/error.h"

/* Makes room for `wanted` elements of `size` bytes in an array of *capacity elements. `array` is the address
 * of the pointer that realloc and free know, which may be NULL with a capacity of 0; it and *capacity change
 * together. The capacity at least doubles, so that appending one by one costs a constant time each. False,
 * and nothing changed, when there is no memory or the bytes are more than a size_t counts.
 *
 *     if (!aur_array_reserve(&list->items, &list->capacity, list->count + 1, sizeof *list->items))
 *         return aur_fail_memory(error);
 */
static inline bool aur_array_reserve(void *array, size_t *capacity, size_t wanted, size_t size);

/* The same where `wanted` is more than the capacity. */
AUR_INTERNAL bool aur_array_grow(void *array, size_t *capacity, size_t wanted, size_t size);

static inline bool aur_array_reserve(void *array, size_t *capacity, size_t wanted, size_t size) {
    return wanted <= *capacity || aur_array_grow(array, capacity, wanted, size);
}

/* a * b into *product; false, and *product untouched, when a size_t cannot hold it. */
AUR_INTERNAL bool aur_size_product(size_t a, size_t b, size_t *product);

/* How much memory the machine has, for saying beforehand what cannot be done. */

/* Bytes; half of the address space where the system does not tell. */
AUR_INTERNAL double aur_machine_memory(void);

/* Memory that is freed all at once: the nodes of a document, what a measure needs until it ends. Not for two
 * threads at once. */

typedef struct aur_arena_block aur_arena_block;

typedef struct aur_arena {
    aur_arena_block *blocks;
} aur_arena;

/* `size` zero bytes, aligned for anything; NULL when memory is out. */
AUR_INTERNAL void *aur_arena_allocate(aur_arena *arena, size_t size);
AUR_INTERNAL char *aur_arena_copy(aur_arena *arena, const char *text, size_t length);
AUR_INTERNAL void aur_arena_release(aur_arena *arena);

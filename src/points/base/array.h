/* Growing arrays with checked sizes. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "points/base/error.h"

/* Makes room for `required` elements of `size` bytes in an array of *capacity elements. `array` is the
 * address of a pointer from malloc, which may be NULL with capacity 0; it and *capacity change together. The
 * capacity at least doubles, so that appending an element takes amortised constant time. Returns false with
 * nothing changed when out of memory or if the number of bytes exceeds SIZE_MAX.
 *
 *     if (!aur_array_reserve(&list->items, &list->capacity, list->count + 1, sizeof *list->items))
 *         return aur_fail_memory(error); */
static inline bool aur_array_reserve(void *array, size_t *capacity, size_t required, size_t size);

/* The same where `required` is more than the capacity. */
AUR_INTERNAL bool aur_array_grow(void *array, size_t *capacity, size_t required, size_t size);

static inline bool aur_array_reserve(void *array, size_t *capacity, size_t required, size_t size) {
    return required <= *capacity || aur_array_grow(array, capacity, required, size);
}

/* a * b into *product; false, and *product untouched, when a size_t cannot hold it. */
AUR_INTERNAL bool aur_size_product(size_t a, size_t b, size_t *product);

/* The memory of the machine, for errors before work that cannot succeed. */

/* Bytes; half of the address space if the system does not report it. */
AUR_INTERNAL double aur_machine_memory(void);

/* An arena whose allocations are freed together: the nodes of a document, the memory of a measure. Not
 * thread-safe. */

typedef struct aur_arena_block aur_arena_block;

typedef struct aur_arena {
    aur_arena_block *blocks;
} aur_arena;

/* `size` zero bytes, aligned for any type; NULL when out of memory. */
AUR_INTERNAL void *aur_arena_allocate(aur_arena *arena, size_t size);
AUR_INTERNAL char *aur_arena_copy(aur_arena *arena, const char *text, size_t length);
AUR_INTERNAL void aur_arena_release(aur_arena *arena);

/* Arrays that grow, by products that are checked. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

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
bool aur_array_grow(void *array, size_t *capacity, size_t wanted, size_t size);

static inline bool aur_array_reserve(void *array, size_t *capacity, size_t wanted, size_t size) {
    return wanted <= *capacity || aur_array_grow(array, capacity, wanted, size);
}

/* a * b into *product; false, and *product untouched, when a size_t cannot hold it. */
bool aur_size_product(size_t a, size_t b, size_t *product);

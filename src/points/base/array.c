#include "points/base/array.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

bool aur_size_product(size_t a, size_t b, size_t *product) {
    if (b != 0 && a > SIZE_MAX / b)
        return false;
    *product = a * b;
    return true;
}

bool aur_array_grow(void *array, size_t *capacity, size_t wanted, size_t size) {
    enum { FIRST_CAPACITY = 8 };
    size_t larger = *capacity <= SIZE_MAX / 2 ? 2 * *capacity : SIZE_MAX;
    larger = larger < FIRST_CAPACITY ? FIRST_CAPACITY : larger;
    larger = larger < wanted ? wanted : larger;
    size_t bytes;
    if (!aur_size_product(larger, size, &bytes))
        return false;
    /* The pointer is of the caller's type, so it is read and written by its bytes. */
    void *elements;
    memcpy(&elements, array, sizeof elements);
    elements = realloc(elements, bytes);
    if (elements == NULL)
        return false;
    memcpy(array, &elements, sizeof elements);
    *capacity = larger;
    return true;
}

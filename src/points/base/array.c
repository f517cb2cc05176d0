#include "points/base/array.h"

#include <stdalign.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool aur_size_product(size_t a, size_t b, size_t *product) {
    if (b != 0 && a > SIZE_MAX / b)
        return false;
    *product = a * b;
    return true;
}

bool aur_array_grow(void *array, size_t *capacity, size_t required, size_t size) {
    enum { FIRST_CAPACITY = 8 };
    size_t larger = *capacity <= SIZE_MAX / 2 ? 2 * *capacity : SIZE_MAX;
    larger = larger < FIRST_CAPACITY ? FIRST_CAPACITY : larger;
    larger = larger < required ? required : larger;
    size_t bytes;
    if (!aur_size_product(larger, size, &bytes))
        return false;
    /* The pointer has the caller's type, so its bytes are copied. */
    void *elements;
    memcpy(&elements, array, sizeof elements);
    elements = realloc(elements, bytes);
    if (elements == NULL)
        return false;
    memcpy(array, &elements, sizeof elements);
    *capacity = larger;
    return true;
}

double aur_machine_memory(void) {
    const long pages = sysconf(_SC_PHYS_PAGES);
    const long page_size = sysconf(_SC_PAGESIZE);
    return pages > 0 && page_size > 0 ? (double)pages * (double)page_size : 0.5 * (double)SIZE_MAX;
}

struct aur_arena_block {
    aur_arena_block *next;
    size_t used, capacity;
    alignas(max_align_t) unsigned char bytes[];
};

enum { BLOCK_SIZE = 1 << 16 };

void *aur_arena_allocate(aur_arena *arena, size_t size) {
    const size_t align = alignof(max_align_t);
    if (size > SIZE_MAX / 2)
        return NULL;
    size = (size + align - 1) / align * align;
    aur_arena_block *block = arena->blocks;
    if (block == NULL || block->capacity - block->used < size) {
        const size_t capacity = size > BLOCK_SIZE ? size : BLOCK_SIZE;
        block = calloc(1, sizeof *block + capacity);
        if (block == NULL)
            return NULL;
        block->capacity = capacity;
        block->next = arena->blocks;
        arena->blocks = block;
    }
    void *const result = block->bytes + block->used;
    block->used += size;
    return result;
}

char *aur_arena_copy(aur_arena *arena, const char *text, size_t length) {
    char *const copy = aur_arena_allocate(arena, length + 1);
    if (copy != NULL)
        memcpy(copy, text, length);
    return copy;
}

void aur_arena_release(aur_arena *arena) {
    while (arena->blocks != NULL) {
        aur_arena_block *const next = arena->blocks->next;
        free(arena->blocks);
        arena->blocks = next;
    }
}

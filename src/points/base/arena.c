#include "points/base/arena.h"

#include <stdalign.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

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

/* Memory that is freed all at once: the nodes of a document, what a measure needs until it ends. Not for two
 * threads at once. */
#pragma once

#include <stddef.h>

typedef struct aur_arena_block aur_arena_block;

typedef struct aur_arena {
    aur_arena_block *blocks;
} aur_arena;

/* `size` zero bytes, aligned for anything; NULL when memory is out. */
void *aur_arena_allocate(aur_arena *arena, size_t size);
char *aur_arena_copy(aur_arena *arena, const char *text, size_t length);
void aur_arena_release(aur_arena *arena);

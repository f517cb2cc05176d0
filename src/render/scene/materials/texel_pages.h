/* Bounded memory for texels. They are in an unnamed file, which is mapped and never changes: blocks dropped
 * from memory are read again on the next access, with the same values. Which blocks are in memory depends on
 * threads and timing; values do not. */
#pragma once

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#include "points/base/error.h"

enum { AUR_TEXEL_BLOCK_BITS = 16 }; /* 64 KiB: as much as Linux maps per fault */
#define AUR_TEXEL_BLOCK ((size_t)1 << AUR_TEXEL_BLOCK_BITS)

typedef struct aur_texel_block {
    unsigned char *address;
    atomic_uchar state; /* 0: not in memory; 1: not used since the hand's last pass; 2: in use */
} aur_texel_block;

typedef struct aur_texel_pages {
    int file;     /* -1 before the first block */
    size_t limit; /* blocks */
    size_t count, capacity;
    aur_texel_block *blocks;
    atomic_size_t resident, hand;
} aur_texel_pages;

/* `bytes`: limit of texels in memory; at least 4 MiB. */
aur_texel_pages *aur_texel_pages_create(size_t bytes); /* NULL: out of memory */
void aur_texel_pages_destroy(aur_texel_pages *pages);  /* NULL is allowed */

/* Adds texels; must not run while others are in use. The file is in TMPDIR or /var/tmp, and has no name.
 * Errors: MEMORY, WRITE. */
aur_result aur_texel_pages_add(aur_texel_pages *pages, size_t size, const unsigned char *values,
                               const unsigned char **mapped, size_t *first_block, aur_error *error);

/* Marks a block as used, and drops others above the limit. */
void aur_texel_pages_bring(aur_texel_pages *pages, aur_texel_block *block);

/* Must be called before bytes `first` to `last` of texels are read. */
static inline void aur_texel_pages_use(aur_texel_pages *pages, size_t first_block, size_t first,
                                       size_t last) {
    aur_texel_block *const blocks = pages->blocks + first_block;
    const size_t begin = first >> AUR_TEXEL_BLOCK_BITS, end = last >> AUR_TEXEL_BLOCK_BITS;
    for (size_t i = begin; i <= end; ++i)
        if (atomic_load_explicit(&blocks[i].state, memory_order_relaxed) != 2)
            aur_texel_pages_bring(pages, &blocks[i]);
}

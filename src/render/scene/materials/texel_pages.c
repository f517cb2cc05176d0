#define _GNU_SOURCE /* O_TMPFILE, mkostemp */
#include "render/scene/materials/texel_pages.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

enum { LEAST_BLOCKS = 64 };

aur_texel_pages *aur_texel_pages_create(size_t bytes) {
    aur_texel_pages *const pages = calloc(1, sizeof *pages);
    if (pages == NULL)
        return NULL;
    pages->file = -1;
    pages->limit = bytes >> AUR_TEXEL_BLOCK_BITS;
    pages->limit = pages->limit > LEAST_BLOCKS ? pages->limit : LEAST_BLOCKS;
    return pages;
}

void aur_texel_pages_destroy(aur_texel_pages *pages) {
    if (pages == NULL)
        return;
    for (size_t i = 0; i < pages->count; ++i)
        munmap(pages->blocks[i].address, AUR_TEXEL_BLOCK);
    if (pages->file >= 0)
        close(pages->file);
    free(pages->blocks);
    free(pages);
}

static aur_result fail(aur_error *error, const char *folder) {
    return aur_fail(error, AUR_ERROR_WRITE, "%s: a temporary file for textures: %s", folder, strerror(errno));
}

/* Creates a temporary file without a name, which is removed when the process ends. */
static int open_nameless(const char *folder) {
    char name[4096];
    const int length = snprintf(name, sizeof name, "%s/aureole-texels-XXXXXX", folder);
#if defined(O_TMPFILE)
    const int nameless = open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (nameless >= 0)
        return nameless;
#endif
    if (length < 0 || (size_t)length >= sizeof name)
        return -1;
    const int file = mkostemp(name, O_CLOEXEC);
    if (file >= 0)
        unlink(name);
    return file;
}

static bool write_all(int file, size_t size, const unsigned char *values, size_t offset) {
    while (size > 0) {
        const ssize_t written = pwrite(file, values, size, (off_t)offset);
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return false;
        values += written;
        offset += (size_t)written;
        size -= (size_t)written;
    }
    return true;
}

/* Aligned to a multiple of a block: the system maps the neighbourhood of a page in such units. */
static unsigned char *map_aligned(int file, size_t size, size_t offset) {
    unsigned char *const room =
        mmap(NULL, size + AUR_TEXEL_BLOCK, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED)
        return NULL;
    const size_t before = -(uintptr_t)room & (AUR_TEXEL_BLOCK - 1), behind = AUR_TEXEL_BLOCK - before;
    unsigned char *const start = room + before;
    if (before > 0)
        munmap(room, before);
    munmap(start + size, behind);
    if (mmap(start, size, PROT_READ, MAP_SHARED | MAP_FIXED, file, (off_t)offset) != MAP_FAILED)
        return start;
    munmap(start, size);
    return NULL;
}

static bool reserve(aur_texel_pages *pages, size_t count) {
    if (pages->count + count <= pages->capacity)
        return true;
    const size_t capacity = 2 * (pages->count + count);
    aur_texel_block *const blocks = realloc(pages->blocks, capacity * sizeof *blocks);
    if (blocks == NULL)
        return false;
    pages->blocks = blocks;
    pages->capacity = capacity;
    return true;
}

aur_result aur_texel_pages_add(aur_texel_pages *pages, size_t size, const unsigned char *values,
                               const unsigned char **mapped, size_t *first_block, aur_error *error) {
    const char *const variable = getenv("TMPDIR"), *const folder = variable != NULL ? variable : "/var/tmp";
    const size_t count = (size + AUR_TEXEL_BLOCK - 1) >> AUR_TEXEL_BLOCK_BITS;
    const size_t offset = pages->count << AUR_TEXEL_BLOCK_BITS, whole = count << AUR_TEXEL_BLOCK_BITS;
    if (!reserve(pages, count))
        return aur_fail_memory(error);
    if (pages->file < 0)
        pages->file = open_nameless(folder);
    if (pages->file < 0 || !write_all(pages->file, size, values, offset) ||
        ftruncate(pages->file, (off_t)(offset + whole)) != 0)
        return fail(error, folder);
    unsigned char *const start = map_aligned(pages->file, whole, offset);
    if (start == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < count; ++i) {
        pages->blocks[pages->count + i].address = start + (i << AUR_TEXEL_BLOCK_BITS);
        atomic_init(&pages->blocks[pages->count + i].state, 0);
    }
    *mapped = start;
    *first_block = pages->count;
    pages->count += count;
    return AUR_OK;
}

/* The clock algorithm: the hand goes around, and drops blocks not used since its last pass. If another thread
 * reads a block while it is dropped, it reads from the file. */
static void drop_some(aur_texel_pages *pages, const aur_texel_block *stays) {
    for (size_t i = 0; i < 2 * pages->count && atomic_load(&pages->resident) > pages->limit; ++i) {
        aur_texel_block *const block = &pages->blocks[atomic_fetch_add(&pages->hand, 1) % pages->count];
        unsigned char state = atomic_load(&block->state);
        if (block == stays || state == 0 ||
            !atomic_compare_exchange_strong(&block->state, &state, (unsigned char)(state - 1)) || state == 2)
            continue;
        madvise(block->address, AUR_TEXEL_BLOCK, MADV_DONTNEED);
        atomic_fetch_sub(&pages->resident, 1);
    }
}

void aur_texel_pages_bring(aur_texel_pages *pages, aur_texel_block *block) {
    if (atomic_exchange(&block->state, 2) != 0)
        return;
    if (atomic_fetch_add(&pages->resident, 1) >= pages->limit)
        drop_some(pages, block);
}

/* A hash of the build IDs that the linker writes into programs and libraries; it changes with the code. */
#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE /* dl_iterate_phdr */
#endif
#include <stdbool.h>

#include "points/base/file.h"

#if defined(__linux__)
#include <link.h>
#include <string.h>

#include "points/base/words.h"

/* The hash of the build ID among the notes of a segment; false where there is none. */
static bool find_identity(const char *notes, size_t size, size_t alignment, uint64_t *hash) {
    const size_t step = alignment == 8 ? 8 : 4;
    ElfW(Nhdr) note;
    for (size_t at = 0; size >= sizeof note && at <= size - sizeof note;) {
        memcpy(&note, notes + at, sizeof note);
        const size_t name = at + sizeof note;
        const size_t text = name + (note.n_namesz + step - 1) / step * step;
        const size_t next = text + (note.n_descsz + step - 1) / step * step;
        if (next > size)
            return false;
        if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 && memcmp(notes + name, "GNU", 4) == 0) {
            *hash = aur_hash_bytes(note.n_descsz, notes + text);
            return true;
        }
        at = next;
    }
    return false;
}

typedef struct identity {
    uint64_t sum;
    bool of_module, failed;
} identity;

/* A file of the name aureole-*.so. */
static bool is_module(const char *path) {
    const char *const slash = strrchr(path, '/');
    const char *const name = slash != NULL ? slash + 1 : path;
    const size_t length = strlen(name);
    return strncmp(name, "aureole-", 8) == 0 && strcmp(name + length - 3, ".so") == 0;
}

/* A sum is independent of the order in which libraries were loaded. Objects are listed in that order; those
 * after one of our modules were loaded for it. Modules transport results but compute none, so they are left
 * out: cached data is then shared by one process and several ranks, with and without a server. TBB loads its
 * allocator late, which computes no results either. */
static int add_object(struct dl_phdr_info *object, size_t size, void *context) {
    identity *const all = context;
    all->of_module = all->of_module || is_module(object->dlpi_name);
    if (all->of_module || strstr(object->dlpi_name, "/libtbbmalloc") != NULL)
        return 0;
    uint64_t hash = 0;
    bool found = strncmp(object->dlpi_name, "linux-vdso", 10) == 0; /* of the kernel: not a file */
    (void)size;
    for (size_t i = 0; i < object->dlpi_phnum && !found; ++i) {
        const ElfW(Phdr) *const segment = &object->dlpi_phdr[i];
        if (segment->p_type == PT_NOTE)
            found = find_identity((const char *)(object->dlpi_addr + segment->p_vaddr), segment->p_memsz,
                                  segment->p_align, &hash);
    }
    all->sum += hash;
    all->failed = all->failed || !found;
    return 0;
}

uint64_t aur_build_identity(void) {
    identity all = {0};
    dl_iterate_phdr(add_object, &all);
    return all.failed ? 0 : all.sum;
}
#else
uint64_t aur_build_identity(void) {
    return 0;
}
#endif

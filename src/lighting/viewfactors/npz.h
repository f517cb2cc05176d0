/* NPZ files: NumPy's arrays in a ZIP archive, not compressed. */
#pragma once

#include "points/base/file.h"

enum { AUR_NPZ_MEMBERS = 16 };

typedef struct aur_npz_member {
    char name[32];
    uint32_t checksum;
    uint64_t size, offset;
} aur_npz_member;

/* An archive that is being written. Start with zero but `stream`, which keeps its own errors. */
typedef struct aur_npz {
    FILE *stream;
    uint64_t position;
    size_t count;
    aur_npz_member members[AUR_NPZ_MEMBERS];
} aur_npz;

/* Adds `count` numbers of `width` bytes each, as they lie in memory. `type` is NumPy's word for them ("<f8"),
 * `shape` a tuple as Python writes it ("(3,)", "()"). */
void aur_npz_add(aur_npz *npz, const char *name, const char *type, const char *shape, size_t count,
                 size_t width, const void *data);
/* Writes the directory. */
void aur_npz_end(aur_npz *npz);

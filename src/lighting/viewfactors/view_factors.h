/* The result of a computation of view factors. */
#pragma once

#include <aureole-lighting/view_factors.h>

#include "points/base/file.h"

struct aur_view_factors {
    size_t rows;
    uint64_t *starts;
    uint32_t *columns;
    double *values, *half_widths;
    double *areas, *sky, *sky_half_widths, *back;
    /* Deviations of each randomisation from the mean, of exchanges from the diagonal on and of those with the
     * sky. */
    size_t randomizations;
    float *deviations;      /* [upper entries][randomizations] */
    double *sky_deviations; /* [rows][randomizations] */
    size_t name_width;      /* names[rows][name_width], ended by zeros; 0 when rows have no names */
    char *names;
    aur_view_factors_description description;
};

/* The caller's options with defaults filled in. Errors: ARGUMENT, UNSUPPORTED. */
aur_result aur_view_factors_read_options(const aur_view_factors_options *given,
                                         aur_view_factors_options *options, aur_error *error);

/* NPZ files: NumPy's arrays in a ZIP archive, not compressed. */

enum { AUR_NPZ_MEMBERS = 16 };

typedef struct aur_npz_member {
    char name[32];
    uint32_t checksum;
    uint64_t size, offset;
} aur_npz_member;

/* An archive being written. Initialise with zero except `stream`, which records its errors. */
typedef struct aur_npz {
    FILE *stream;
    uint64_t position;
    size_t count;
    aur_npz_member members[AUR_NPZ_MEMBERS];
} aur_npz;

/* Adds `count` numbers of `width` bytes each, in native byte order. `type` is NumPy's type string ("<f8"),
 * `shape` a tuple in Python's notation ("(3,)", "()"). */
void aur_npz_add(aur_npz *npz, const char *name, const char *type, const char *shape, size_t count,
                 size_t width, const void *data);
/* Writes the directory. */
void aur_npz_end(aur_npz *npz);

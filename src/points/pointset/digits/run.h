/* Coordinates of consecutive points, computed in parts, so that streaming stores of pairs overlap with the
 * computation. */
#pragma once

#include "points/pointset/digits/digital_kernels.h"
#include "points/pointset/runs.h"

enum { AUR_RUN_TABLE = 1024, AUR_RUN_VALUES = 128 + AUR_RUN_SLACK };

/* Radical inverses in an odd base: numerators of points over one denominator. The numerator of a point is
 * table[lower] for its lower digits, plus a term that all points with the same higher digits share. */
typedef struct aur_radical_run {
    uint64_t base, denominator;
    uint64_t index;
    uint64_t span; /* a power of the base: the number of sequences of lower digits */
    size_t width;  /* the number of them in the table: `span`, or less for a large base */
    double table[AUR_RUN_TABLE];
} aur_radical_run;

/* Values of an ascent that are computed and not used yet. */
typedef struct aur_ascending_run {
    aur_ascent ascent;
    size_t taken, computed;
    double values[AUR_RUN_VALUES];
} aur_ascending_run;

typedef struct aur_run {
    /* The next `count` values: a multiple of AUR_DIGITAL_SLOTS unless they are the last. */
    void (*next)(struct aur_run *run, size_t count, double *out);
    union {
        aur_multiples multiples;
        aur_multiples_of_fraction fractions;
        aur_hashes hashes;
        aur_radical_run radical;
        aur_ascending_run ascending;
        struct {
            aur_digital_run run;
            uint64_t columns[AUR_DIGITAL_COLUMNS];
        } digital;
    } of;
} aur_run;

/* For points first .. last - 1. */
void aur_run_of_multiples(uint64_t position, uint64_t step, uint64_t size, aur_run *run);
void aur_run_of_fraction(uint64_t start, aur_fraction128 step, uint64_t first, aur_run *run);
void aur_run_of_hashes(uint64_t stream, uint64_t first, aur_run *run);
/* With NONE, DIGIT and OWEN applied by the key. */
void aur_run_of_digits(const uint64_t columns[AUR_DIGITAL_COLUMNS], aur_scramble scramble, uint64_t key,
                       uint64_t first, uint64_t last, aur_run *run);
/* False when a common denominator is not below 2^53. */
bool aur_run_of_radical_inverse(uint32_t base, uint64_t first, uint64_t last, aur_run *run);

void aur_run_of_ascent(const aur_ascent *ascent, aur_run *run);

/* Writes x, y, x, y, ... */
void aur_run_pairs(aur_run *x, aur_run *y, size_t count, double *out);

/* Whether an experiment still gives the tables that are kept of it. */
#pragma once

#include "program/lab/lab.h"

typedef struct lab_comparison {
    bool traces_rays; /* then tables are compared within a tolerance, else to the bit */
    bool same;        /* no cell and no note differs by more than that */
    double largest;   /* difference of a cell, relative to its value or its interval's width; 0: none */
    char where[256];  /* "NAME.csv: row 3, rmse: 0.1 was kept, 0.2 now", of the worst; "": nothing differs */
} lab_comparison;

/* Compares the tables of a run, in `folder`/NAME, with those that are kept of the same form, in `kept`/NAME.
 *
 * Tables of the quick form are kept in `kept`/NAME/quick, but for those that are equal to the full form's.
 * Processors round rays differently, because Embree has kernels for each. An image of single precision with
 * a relative error r has that error to 2^-24 / r, and the smallest r here are near 1e-5: so where rays are
 * traced, numbers may differ by a hundredth of their value or of their interval's width, or by 1e-7 of the
 * largest in their column, or by 1e-14, which is zero to the rounding of doubles near 1. The kernels of
 * AUREOLE_ISA=portable, avx2 and avx512 differ by .0035 at most. Errors: OPEN when nothing is kept, FORMAT,
 * MEMORY. */
aur_result lab_compare(const lab_experiment *experiment, const char *kept, const char *folder, bool quick,
                       lab_comparison *comparison, aur_error *error);

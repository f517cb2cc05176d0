/* Checks an experiment's tables against stored reference tables. */
#pragma once

#include "program/lab/lab.h"

typedef struct lab_comparison {
    bool traces_rays; /* then tables are compared within a tolerance, else bit by bit */
    bool same;        /* no cell and no note differs by more than the tolerance */
    double largest;   /* largest difference of a cell, relative to its value or its interval's width; 0: none
                       */
    char where[256];  /* location of the largest difference: "NAME.csv: row 3, rmse: 0.1 was kept, 0.2 now";
                       * "": none */
} lab_comparison;

/* Compares the tables of a run, in `folder`/NAME, with the stored ones of the same form, in `stored`/NAME.
 *
 * Tables of the quick form are in `stored`/NAME/quick, except those equal to the full form's. Processors
 * round rays differently, because Embree has a kernel for each instruction set. A single-precision image with
 * a relative error r determines this error to 2^-24 / r, and the smallest r here are near 1e-5. So if rays
 * are traced, numbers may differ by a hundredth of their value or of their interval's width, by 1e-7 of the
 * largest in their column, or by 1e-14, the rounding of doubles near 1. The kernels of AUREOLE_ISA=portable,
 * avx2 and avx512 differ by at most .0035. Errors: OPEN if nothing is stored, FORMAT, MEMORY. */
aur_result lab_compare(const lab_experiment *experiment, const char *stored, const char *folder, bool quick,
                       lab_comparison *comparison, aur_error *error);

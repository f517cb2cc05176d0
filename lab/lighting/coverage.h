/* How often intervals hold what is true. */
#pragma once

#include "program/lab/lab.h"

/* What the runs of one case found. */
typedef struct lab_tally {
    size_t runs, held;
    double bias, squares, work;
} lab_tally;

/* The columns of a table of such rows, by what the work is counted in. */
extern const char *const lab_tally_of_directions[];
extern const char *const lab_tally_of_rays[];
extern const char *const lab_tally_of_samples[];

/* One interval about `value`, of `work` directions, rays or the like. */
void lab_tally_count(lab_tally *tally, double value, double half_width, double truth, double work);
void lab_tally_add(lab_tally *sum, const lab_tally *part);
/* A row; `asked` is the error that was asked for, 0 for runs of fixed size. */
void lab_tally_report(lab_run *run, const char *name, double asked, const lab_tally *tally);

/* Coverage of confidence intervals: how often they contain the true value. */
#pragma once

#include "program/lab/lab.h"

/* Statistics of the runs of one case. */
typedef struct lab_tally {
    size_t runs, held;
    double bias, squares, work;
} lab_tally;

/* The columns of a table of such rows, named by the unit of work. */
extern const char *const lab_tally_of_directions[];
extern const char *const lab_tally_of_rays[];
extern const char *const lab_tally_of_samples[];

/* Adds an interval about `value`, from `work` directions, rays or the like. */
void lab_tally_count(lab_tally *tally, double value, double half_width, double reference, double work);
void lab_tally_add(lab_tally *sum, const lab_tally *part);
/* Adds a row; `target_error` is the target error, 0 for runs of fixed size. */
void lab_tally_report(lab_run *run, const char *name, double target_error, const lab_tally *tally);

/* The paper's rules for golden sequences and sets, and their computing time. */
#pragma once

#include "program/lab/lab.h"

/* Claims on section 2's integers, section 3's example and eq. 7, and the appendix, tested on numbers[count]
 * of the sequence. */
void schretter_check_rules(lab_run *run, size_t count, const double *numbers);
/* Golden numbers against van der Corput's, by the paper's loops and by the library: ratios of processor times
 * with their intervals, only written to the table of times. Errors: MEMORY. */
aur_result schretter_time(lab_run *run, aur_error *error);
/* Writes numbers first .. first+count-1 of a one-dimensional sequence to to[count]. Errors: as
 * aur_pointset_create. */
aur_result schretter_numbers(const char *sequence, uint64_t first, size_t count, double *to,
                             aur_error *error);

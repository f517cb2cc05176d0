/* The rules by which the paper makes golden sequences and sets, and the time that they take. */
#pragma once

#include "program/lab/lab.h"

/* Claims on section 2's integers, section 3's example and eq. 7, and the appendix, against numbers[count] of
 * the sequence. */
void schretter_check_rules(lab_run *run, size_t count, const double *numbers);
/* Golden numbers against van der Corput's, as the paper's loops make them and as the library does: ratios of
 * processor times with their intervals go to the table of times alone. Errors: MEMORY. */
aur_result schretter_time(lab_run *run, aur_error *error);
/* Numbers first .. first+count-1 of a sequence of one dimension into to[count]. Errors: as
 * aur_pointset_create. */
aur_result schretter_numbers(const char *sequence, uint64_t first, size_t count, double *to,
                             aur_error *error);

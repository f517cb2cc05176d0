/* How much the parts of one set of points say of the error of the whole set. */
#pragma once

#include <stddef.h>

/* values[count][parts]: what each of the consecutive parts of one set, which is shifted at random for every
 * number, found. Their spread is that of sets of a part's size; the whole set errs by less than the mean of
 * as many independent ones, for errors fall faster than with the root of the size. How fast, with
 * size^(-rate/2), is taken from all numbers together: from how much less parts of twice the size vary. Then
 * each number's parts are drawn towards their mean, until they spread as independent ones whose mean errs as
 * the whole set does: Student's interval from them holds. Means stay. Returns the rate, 1 .. 3, of variances:
 * 1 is chance. */
double aur_net_spread_settle(size_t count, size_t parts, double *values);

/* How many samples each pixel of a picture is to have next. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { AUR_MOST_GROWTH = 4 }; /* of a pixel's samples in one round */

/* `variances` of the pixels with `targets` samples each: what one more sample would bring falls as variance /
 * samples^2. Raises the targets to whole numbers so that the sum of the variances falls to `factor` in (0,1)
 * of what it is, at the least cost (samples in proportion to the root of a pixel's variance for one sample;
 * Lagrange), but no pixel more than AUR_MOST_GROWTH times in one round, because a variance seen in few
 * samples is only roughly known; and all of them to a quarter of the mean at least, and to half of it up to
 * 32 samples. False when no target was raised: all pixels have `most` samples or no variance. */
bool aur_raise_targets(size_t count, const double *variances, double factor, uint32_t most,
                       uint32_t *targets);

/* How many times as many samples it takes in all to make the sum of variances `factor` in (0,1] of what it
 * is, where they are spent best. */
double aur_growth_to(size_t count, const double *variances, double factor, const uint32_t *targets);

/* The mean, variance and confidence interval of repeated runs. */
#ifndef AUREOLE_STATISTICS_H
#define AUREOLE_STATISTICS_H

#include <aureole/core.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Running moments of a sequence of values (Welford 1962). Start with zero: aur_moments m = {0}. */
typedef struct aur_moments {
    size_t count;
    double mean;
    double squares; /* sum of squared deviations from the mean */
} aur_moments;

AUR_API void aur_moments_add(aur_moments *moments, double value) AUR_NONNULL(1);
/* The unbiased variance of one value, with count - 1 as divisor; 0 for fewer than two values. */
AUR_API double aur_moments_variance(const aur_moments *moments) AUR_NONNULL(1);
/* The standard deviation of the mean; 0 for fewer than two values. */
AUR_API double aur_moments_standard_error(const aur_moments *moments) AUR_NONNULL(1);
/* Half the width of the interval about the mean that holds the expectation with probability `confidence` in
 * (0,1), for normal values (Student's t); 0 for fewer than two values. */
AUR_API double aur_moments_interval(const aur_moments *moments, double confidence) AUR_NONNULL(1);

/* The quantile t with P(T < t) = probability in (0,1) for Student's t with `degrees` >= 1 degrees of freedom;
 * more than a million count as a million. The relative error is below 1e-9 for probabilities between 1e-6 and
 * 1 - 1e-6. NaN for arguments out of range. */
AUR_API double aur_student_quantile(size_t degrees, double probability);

#ifdef __cplusplus
}
#endif

#endif

#include "lighting/viewfactors/sky_slices.h"

#include <math.h>

/* Prior of the rate: uniform from that of random points to that of nets with a smooth integrand, 1 to 2, with
 * the variance 1/12. Its mean is also the rate for jumps in two dimensions (He and Wang 2015: 1 + 1/2). */
static const double USUAL_RATE = 1.5, USUAL_VARIANCE = 1.0 / 12.0;

static double mean_of(size_t count, const double *values) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += values[i];
    return sum / (double)count;
}

/* Let V(n) be the variance of the mean of n points. About the mean of all N, parts of N/R points have the
 * mean square V(N/R) - V(N), which is V(N) (R^rate - 1). Returned is the ratio of this for R parts and for
 * R/2 parts; it increases with the rate. */
static double ratio_at(double rate, double parts) {
    return (pow(parts, rate) - 1.0) / (pow(0.5 * parts, rate) - 1.0);
}

static double rate_of(double ratio, double parts) {
    double low = 1.0, high = 3.0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        if (ratio_at(middle, parts) < ratio)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

/* Variance of the rate estimated from one number: the ratio is 1 plus a quotient of two sums of squares, of
 * halves' differences with R/2 and of halves' means with R/2 - 1 degrees of freedom. Their relative variances
 * are about 2 over the degrees of freedom. */
static double variance_of_rate(double parts) {
    const double step = 1e-3, ratio = ratio_at(USUAL_RATE, parts);
    const double slope =
        (ratio_at(USUAL_RATE + step, parts) - ratio_at(USUAL_RATE - step, parts)) / (2.0 * step);
    const double relative = 2.0 / (0.5 * parts) + 2.0 / (0.5 * parts - 1.0);
    return relative * (ratio - 1.0) * (ratio - 1.0) / (slope * slope);
}

static double find_rate(size_t count, size_t parts, const double *values) {
    double single = 0.0, paired = 0.0, squares = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const double *const of = &values[parts * i];
        const double mean = mean_of(parts, of);
        double square = 0.0;
        for (size_t p = 0; p < parts; p += 2) {
            const double a = of[p] - mean, b = of[p + 1] - mean;
            square += a * a + b * b;
            paired += 0.5 * (a + b) * (a + b);
        }
        single += square;
        squares += square * square;
    }
    if (!(paired > 0.0))
        return USUAL_RATE;
    /* Effective sample size: numbers with larger variance have more weight; so many equally weighted ones
     * would give the same information. */
    const double measured = single * single / squares / variance_of_rate((double)parts),
                 usual = 1.0 / USUAL_VARIANCE;
    return (measured * rate_of(single / paired, (double)parts) + usual * USUAL_RATE) / (measured + usual);
}

double aur_net_spread_settle(size_t count, size_t parts, double *values) {
    const double rate = parts % 2 == 0 && parts > 2 ? find_rate(count, parts, values) : USUAL_RATE;
    const double scale = sqrt((double)(parts - 1) / (pow((double)parts, rate) - 1.0));
    for (size_t i = 0; i < count; ++i) {
        double *const of = &values[parts * i];
        const double mean = mean_of(parts, of);
        for (size_t p = 0; p < parts; ++p)
            of[p] = mean + scale * (of[p] - mean);
    }
    return rate;
}

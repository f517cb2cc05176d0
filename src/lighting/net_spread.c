#include "lighting/net_spread.h"

#include <math.h>

/* What meshes show (1.4 to 1.7 where horizons jump at edges); it counts as much as so many numbers that are
 * measured. One number tells the rate to some 1.2, and meshes differ by some .3. */
static const double USUAL_RATE = 1.55, USUAL_COUNT = 16.0;

static double mean_of(size_t count, const double *values) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += values[i];
    return sum / (double)count;
}

/* Let V(n) be the variance of the mean of n points. About the mean of all N, parts of N/R points have the
 * mean square V(N/R) - V(N), which is V(N) (R^rate - 1). So those of R and of R/2 parts have the ratio that
 * is returned; it grows with the rate. */
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

static double find_rate(size_t count, size_t parts, const double *values) {
    double single = 0.0, paired = 0.0, squares = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const double *const of = &values[parts * i];
        const double mean = mean_of(parts, of);
        double own = 0.0;
        for (size_t p = 0; p < parts; p += 2) {
            const double a = of[p] - mean, b = of[p + 1] - mean;
            own += a * a + b * b;
            paired += 0.5 * (a + b) * (a + b);
        }
        single += own;
        squares += own * own;
    }
    if (!(paired > 0.0))
        return USUAL_RATE;
    /* Numbers that vary more tell more: so many alike ones would tell as much. */
    const double told = single * single / squares;
    return (told * rate_of(single / paired, (double)parts) + USUAL_COUNT * USUAL_RATE) / (told + USUAL_COUNT);
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

#include "ask/interval.h"

#include <aureole/statistics.h>
#include <math.h>

void aur_deviations_add(aur_deviations *sum, const aur_gram *block) {
    const double n = (double)(block->count - 1);
    double trace = 0.0, squares = 0.0;
    for (size_t r = 0; r < block->count; ++r) {
        trace += block->products[r][r];
        for (size_t s = 0; s < block->count; ++s)
            squares += block->products[r][s] * block->products[r][s];
    }
    const double spread = fmax((squares - trace * trace / n) / ((n - 1.0) * (n + 2.0)), 0.0);
    sum->trace += trace;
    sum->spread += spread;
    sum->square_spreads += spread * spread;
}

/* Degrees of freedom of the sum of the blocks' spreads. One has (n - 1)(n + 2) / 2 of them for normal values,
 * a spread's relative variance is two over them, and so is the excess of its expected square. */
static size_t degrees_of_spread(const aur_deviations *sum, double n) {
    const double one = 0.5 * (n - 1.0) * (n + 2.0);
    if (!(sum->square_spreads > 0.0))
        return (size_t)one;
    return (size_t)fmin(fmax((one + 2.0) * sum->spread * sum->spread / sum->square_spreads, one), 1e6);
}

aur_error_interval aur_replica_interval(const aur_deviations *sum, size_t count, size_t values,
                                        double confidence) {
    const double n = (double)(count - 1);
    aur_error_interval interval = {.degrees = 1.0};
    if (!(sum->trace > 0.0))
        return interval;
    const double square = (sum->trace * sum->trace - 2.0 * n * sum->spread) / (n * n);
    interval.degrees = fmin(fmax(square / sum->spread, 1.0), (double)values);
    const double square_error = sum->trace / (n * (double)count * (double)values);
    const double own = 2.0 / (9.0 * interval.degrees), seen = own / n;
    const double quantile = aur_student_quantile(degrees_of_spread(sum, n), 0.5 * (1.0 + confidence));
    const double centre = cbrt(square_error) * (1.0 - own) / (1.0 - seen);
    const double half = quantile * cbrt(square_error) * sqrt(own + seen);
    interval.estimate = sqrt(square_error);
    interval.low = pow(fmax(centre - half, 0.0), 1.5);
    interval.high = pow(centre + half, 1.5);
    return interval;
}

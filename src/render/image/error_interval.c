#include "render/image/error_interval.h"

#include <aureole/statistics.h>
#include <math.h>

/* The mean of ((X_i - X_j).(X_k - X_l))^2 / 4 over distinct i, j, k, l, computed from the sum of squares of
 * all products (`squares`), that of the diagonal (`diagonal`), and the row sums, which are zero. */
static double spread_of_fours(double count, double trace, double squares, double diagonal) {
    const double two = squares - diagonal, three = 2.0 * diagonal - squares;
    const double four = trace * trace - 6.0 * diagonal + 2.0 * squares;
    const double pairs = count * (count - 1.0), triples = pairs * (count - 2.0);
    return two / pairs - 2.0 * three / triples + four / (triples * (count - 3.0));
}

static double spread_of_three(double trace, double squares) {
    return (squares - trace * trace / 2.0) / 4.0;
}

double aur_gram_spread(const aur_gram *block) {
    double trace = 0.0, squares = 0.0, diagonal = 0.0;
    for (size_t r = 0; r < block->count; ++r) {
        trace += block->products[r][r];
        diagonal += block->products[r][r] * block->products[r][r];
        for (size_t s = 0; s < block->count; ++s)
            squares += block->products[r][s] * block->products[r][s];
    }
    const double unbiased = block->count > 3 ? spread_of_fours((double)block->count, trace, squares, diagonal)
                                             : spread_of_three(trace, squares);
    return fmax(unbiased, 0.0);
}

void aur_deviations_add(aur_deviations *sum, const aur_gram *block) {
    const double spread = aur_gram_spread(block);
    for (size_t r = 0; r < block->count; ++r)
        sum->trace += block->products[r][r];
    sum->spread += spread;
    sum->square_spreads += spread * spread;
    sum->neighbours += block->neighbours;
}

void aur_deviations_pool(aur_deviations *sum, size_t count, size_t pixel_count,
                         const aur_pixel_spread *pixels) {
    double variance = 0.0, spread = 0.0, squares = 0.0;
    for (size_t i = 0; i < pixel_count; ++i) {
        variance += pixels[i].variance;
        spread += pixels[i].spread;
        squares += pixels[i].spread * pixels[i].spread;
    }
    const double smaller = fmin(sum->trace / ((double)(count - 1) * variance), 1.0);
    const double part = smaller * smaller;
    if (part * spread > sum->spread && spread * spread < 4.0 * squares) {
        sum->spread = part * spread;
        sum->square_spreads = part * part * squares;
    }
}

/* Degrees of freedom of the sum of the blocks' spreads. For normal values, one block has as many as there are
 * independent differences of four replicas, count (count - 3) / 2 (two for three replicas, Wishart). The
 * relative variance of a spread is two divided by the degrees, and so is the excess of its expected square.
 */
static size_t degrees_of_spread(const aur_deviations *sum, size_t count) {
    const double one = count > 3 ? 0.5 * (double)(count * (count - 3)) : 2.0;
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
    const double spread = fmax(sum->spread, sum->neighbours);
    const double square = (sum->trace * sum->trace - 2.0 * n * spread) / (n * n);
    interval.degrees = fmin(fmax(square / spread, 1.0), (double)values);
    const double square_error = sum->trace / (n * (double)count * (double)values);
    const double variance = 2.0 / (9.0 * interval.degrees), mean_variance = variance / n;
    const double quantile = aur_student_quantile(degrees_of_spread(sum, count), 0.5 * (1.0 + confidence));
    const double centre = cbrt(square_error) * (1.0 - variance) / (1.0 - mean_variance);
    const double half = quantile * cbrt(square_error) * sqrt(variance + mean_variance);
    interval.estimate = sqrt(square_error);
    interval.low = pow(fmax(centre - half, 0.0), 1.5);
    interval.high = pow(centre + half, 1.5);
    return interval;
}

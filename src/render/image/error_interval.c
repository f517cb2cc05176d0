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

/* Sums over a Gram matrix. */
typedef struct gram_sums {
    double trace, squares, diagonal;
} gram_sums;

static gram_sums sums_of(const aur_gram *block) {
    gram_sums sums = {.trace = 0.0};
    for (size_t r = 0; r < block->count; ++r) {
        sums.trace += block->products[r][r];
        sums.diagonal += block->products[r][r] * block->products[r][r];
        for (size_t s = 0; s < block->count; ++s)
            sums.squares += block->products[r][s] * block->products[r][s];
    }
    return sums;
}

static double spread_of_normal(double n, const gram_sums *sums) {
    return fmax(sums->squares - sums->trace * sums->trace / n, 0.0) / ((n - 1.0) * (n + 2.0));
}

void aur_deviations_add(aur_deviations *sum, const aur_gram *block) {
    const gram_sums sums = sums_of(block);
    const double count = (double)block->count;
    const double spread = count > 3.0 ? spread_of_fours(count, sums.trace, sums.squares, sums.diagonal)
                                      : spread_of_normal(count - 1.0, &sums);
    sum->trace += sums.trace;
    sum->blocks += fmax(spread, 0.0);
    sum->square_blocks += spread > 0.0 ? spread * spread : 0.0;
}

double aur_deviations_add_pixel(aur_deviations *sum, const aur_gram *pixel) {
    const gram_sums sums = sums_of(pixel);
    const double spread = spread_of_normal((double)(pixel->count - 1), &sums);
    sum->pixels += spread;
    sum->square_pixels += spread * spread;
    return spread;
}

void aur_deviations_pool(aur_deviations *sum, size_t count, size_t pixel_count,
                         const aur_pixel_spread *pixels) {
    double variance = 0.0;
    sum->pixels = sum->square_pixels = 0.0;
    for (size_t i = 0; i < pixel_count; ++i) {
        variance += pixels[i].variance;
        sum->pixels += pixels[i].spread;
        sum->square_pixels += pixels[i].spread * pixels[i].spread;
    }
    const double part = variance > 0.0 ? sum->trace / ((double)(count - 1) * variance) : 0.0;
    sum->pixels *= part * part;
    sum->square_pixels *= pow(part, 4.0);
}

/* Degrees of freedom of a sum of spreads. The relative variance of a spread is two divided by its degrees.
 * For normal values, a block has as many as there are independent differences of four replicas, count (count
 * - 3) / 2 (two for three replicas, Wishart), and its square is one plus that variance times as large as
 * expected. A pixel's spread is the square of a variance with n degrees: the relative variance is 8 (n + 3) /
 * (n (n + 2)). Pixels that share samples deviate together. */
static size_t degrees_of_spread(const aur_deviations *sum, size_t count) {
    const double n = (double)(count - 1), one = count > 3 ? 0.5 * (double)(count * (count - 3)) : 2.0;
    const double blocks = (one + 2.0) * sum->blocks * sum->blocks / sum->square_blocks;
    const double pixels = (n + 4.0) * (n + 6.0) / (4.0 * (n + 3.0)) * sum->pixels * sum->pixels /
                          (sum->overlap * sum->square_pixels);
    const double degrees = sum->blocks > sum->overlap * sum->pixels ? blocks : pixels;
    return degrees > one ? (size_t)fmin(degrees, 1e6) : (size_t)one;
}

aur_error_interval aur_replica_interval(const aur_deviations *sum, size_t count, size_t values,
                                        double confidence) {
    const double n = (double)(count - 1);
    aur_error_interval interval = {.degrees = 1.0};
    if (!(sum->trace > 0.0))
        return interval;
    const double pixels = sum->overlap * sum->pixels;
    const double spread = fmax(sum->blocks, sum->linear ? 0.5 * (sum->blocks + pixels) : pixels);
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

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

static double spread_of(size_t count, const gram_sums *sums) {
    const double spread = count > 3
                              ? spread_of_fours((double)count, sums->trace, sums->squares, sums->diagonal)
                              : spread_of_normal((double)count - 1.0, sums);
    return fmax(spread, 0.0);
}

void aur_deviations_add(aur_deviations *sum, const aur_gram *block) {
    const gram_sums sums = sums_of(block);
    const double spread = spread_of(block->count, &sums);
    sum->blocks += spread;
    sum->square_blocks += spread * spread;
}

double aur_deviations_add_pixel(aur_deviations *sum, const aur_gram *pixel, double d[3][AUR_REPLICAS_MAX],
                                double others, aur_cell *cell) {
    const gram_sums sums = sums_of(pixel);
    const double spread = spread_of(pixel->count, &sums);
    sum->trace += sums.trace;
    sum->others += others;
    sum->pixels += spread;
    sum->square_pixels += spread * spread;
    for (size_t a = 0; a < 3; ++a)
        for (size_t b = 0; b < 3; ++b)
            for (size_t r = 0; r < pixel->count; ++r)
                cell->products[a][b] += d[a][r] * d[b][r];
    cell->squares += sums.squares;
    cell->spread += spread;
    ++cell->pixels;
    return spread;
}

void aur_deviations_add_cell(aur_deviations *sum, const aur_cell *cell) {
    const double n = (double)(cell->count - 1);
    double squares = -cell->squares;
    for (size_t a = 0; a < 3; ++a)
        for (size_t b = 0; b < 3; ++b)
            squares += cell->products[a][b] * cell->products[a][b];
    const double spread = fmax(squares / (n * n) + cell->spread, 0.0) / (double)cell->pixels;
    sum->cells += spread;
    sum->square_cells += spread * spread;
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
    const double part = variance > 0.0 ? sum->others / ((double)(count - 1) * variance) : 0.0;
    sum->pixels *= part * part;
    sum->square_pixels *= pow(part, 4.0);
}

/* An estimate of tr C^2 with its degrees of freedom. */
typedef struct spread_estimate {
    double spread, degrees;
} spread_estimate;

/* The relative variance of a spread is two divided by its degrees. For normal values, a block has as many as
 * there are independent differences of four replicas, count (count - 3) / 2 (two for three replicas,
 * Wishart), and its square is one plus that variance times as large as expected. */
static spread_estimate spread_of_blocks(const aur_deviations *sum, double one) {
    return (spread_estimate){sum->blocks, (one + 2.0) * sum->blocks * sum->blocks / sum->square_blocks};
}

/* The estimates by pixels and cells are nearly squares of variances with n degrees, whose relative variance
 * is 8 (n + 3) / (n (n + 2)). Pixels that share samples deviate together. */
static spread_estimate spread_of_variances(double overlap, double n, double sum, double squares) {
    return (spread_estimate){overlap * sum,
                             (n + 4.0) * (n + 6.0) / (4.0 * (n + 3.0)) * sum * sum / (overlap * squares)};
}

static spread_estimate larger(spread_estimate a, spread_estimate b) {
    return b.spread > a.spread ? b : a;
}

static spread_estimate find_spread(const aur_deviations *sum, size_t count) {
    const double n = (double)(count - 1), one = count > 3 ? 0.5 * (double)(count * (count - 3)) : 2.0;
    spread_estimate found =
        larger(spread_of_blocks(sum, one),
               larger(spread_of_variances(sum->overlap, AUR_CELL_PIXELS * n, sum->cells, sum->square_cells),
                      spread_of_variances(sum->overlap, n, sum->pixels, sum->square_pixels)));
    found.degrees = found.degrees > one ? fmin(found.degrees, 1e6) : one;
    return found;
}

/* tr W at which the mean of all images has its extrapolated variance: a power of the number of images through
 * the variances of one image and of the mean of all but one. */
static double trace_of_mean(const aur_deviations *sum, size_t count) {
    const double n = (double)(count - 1), ratio = sum->others / (n * sum->trace);
    return (double)count * sum->trace * pow(ratio, log((double)count) / log(n));
}

aur_error_interval aur_replica_interval(const aur_deviations *sum, size_t count, size_t values,
                                        double confidence) {
    const double n = (double)(count - 1);
    aur_error_interval interval = {.degrees = 1.0};
    if (!(sum->trace > 0.0))
        return interval;
    const spread_estimate found = find_spread(sum, count);
    const double square = (sum->trace * sum->trace - 2.0 * n * found.spread) / (n * n);
    interval.degrees = fmin(fmax(square / found.spread, 1.0), (double)values);
    const double square_error = trace_of_mean(sum, count) / (n * (double)count * (double)values);
    const double variance = 2.0 / (9.0 * interval.degrees), mean_variance = variance / n;
    const double quantile = aur_student_quantile((size_t)found.degrees, 0.5 * (1.0 + confidence));
    const double centre = cbrt(square_error) * (1.0 - variance) / (1.0 - mean_variance);
    const double half = quantile * cbrt(square_error) * sqrt(variance + mean_variance);
    interval.estimate = sqrt(square_error);
    interval.low = pow(fmax(centre - half, 0.0), 1.5);
    interval.high = pow(centre + half, 1.5);
    return interval;
}

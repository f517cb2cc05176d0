#include "render/image/error_interval.h"

#include <aureole/statistics.h>
#include <math.h>

/* The mean of ((X_i - X_j).(X_k - X_l))^2 / 4 over distinct i, j, k, l, computed from the sum of squares of
 * all products (`squares`), that of the diagonal (`diagonal`), and the row sums, which are zero. */
static double spread_of_fours(double count, double traces, double squares, double diagonal) {
    const double two = squares - diagonal, three = 2.0 * diagonal - squares;
    const double four = traces - 6.0 * diagonal + 2.0 * squares;
    const double pairs = count * (count - 1.0), triples = pairs * (count - 2.0);
    return two / pairs - 2.0 * three / triples + four / (triples * (count - 3.0));
}

/* Sums over the products of two Gram matrices' entries. */
typedef struct gram_sums {
    double traces, squares, diagonal;
} gram_sums;

static gram_sums sums_between(size_t count, const double *a, const double *b) {
    gram_sums sums = {.squares = 0.0};
    double trace_a = 0.0, trace_b = 0.0;
    for (size_t r = 0; r < count; ++r, ++a, ++b) {
        for (size_t s = 0; s < r; ++s, ++a, ++b)
            sums.squares += 2.0 * *a * *b;
        sums.squares += *a * *b;
        sums.diagonal += *a * *b;
        trace_a += *a;
        trace_b += *b;
    }
    sums.traces = trace_a * trace_b;
    return sums;
}

static double spread_of_normal(double n, const gram_sums *sums) {
    return (sums->squares - sums->traces / n) / ((n - 1.0) * (n + 2.0));
}

static double spread_of(size_t count, const gram_sums *sums) {
    return count > 3 ? spread_of_fours((double)count, sums->traces, sums->squares, sums->diagonal)
                     : spread_of_normal((double)count - 1.0, sums);
}

/* Of the covariances of one block's values with another's, or with themselves. */
static double spread_between(size_t count, const double *a, const double *b) {
    const gram_sums sums = sums_between(count, a, b);
    return spread_of(count, &sums);
}

/* The offsets to half of a block's neighbours; the others have it among theirs. */
static const struct offset { ptrdiff_t x, y; } FORWARD[] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};

enum { FORWARDS = sizeof FORWARD / sizeof FORWARD[0] };

/* The index of a block's neighbour; the number of blocks: there is none. */
static size_t neighbour_of(size_t columns, size_t rows, size_t block, struct offset offset) {
    const size_t x = block % columns + (size_t)offset.x, y = block / columns + (size_t)offset.y;
    return x < columns && y < rows ? y * columns + x : columns * rows;
}

void aur_blocks_measure(size_t count, size_t columns, size_t rows, const double *products,
                        aur_block_spread *blocks) {
    const size_t block_count = columns * rows, stride = AUR_GRAM_ENTRIES(count);
    for (size_t i = 0; i < block_count; ++i) {
        const double *const own = products + i * stride;
        blocks[i].own = blocks[i].spread = spread_between(count, own, own);
        blocks[i].variance = 0.0;
        for (size_t r = 0; r < count; ++r)
            blocks[i].variance += own[AUR_GRAM_SQUARE(r)] / (double)(count - 1);
    }
    for (size_t k = 0; k < FORWARDS; ++k)
        for (size_t i = 0; i < block_count; ++i) {
            const size_t j = neighbour_of(columns, rows, i, FORWARD[k]);
            if (j == block_count)
                continue;
            const double spread = spread_between(count, products + i * stride, products + j * stride);
            blocks[i].spread += spread;
            blocks[j].spread += spread;
        }
}

void aur_deviations_set_blocks(aur_deviations *sum, size_t columns, size_t rows,
                               const aur_block_spread *blocks) {
    const size_t block_count = columns * rows;
    double common = 0.0, most = 0.0, products = 0.0; /* of pairs of neighbours */
    sum->blocks = sum->square_blocks = 0.0;
    for (size_t i = 0; i < block_count; ++i) {
        sum->blocks += blocks[i].spread;
        sum->square_blocks += blocks[i].spread * blocks[i].spread;
        common += 0.5 * (blocks[i].spread - blocks[i].own);
        for (size_t k = 0; k < FORWARDS; ++k) {
            const size_t j = neighbour_of(columns, rows, i, FORWARD[k]);
            if (j == block_count)
                continue;
            most += sqrt(fmax(blocks[i].own, 0.0) * fmax(blocks[j].own, 0.0));
            products += 2.0 * blocks[i].spread * blocks[j].spread;
        }
    }
    sum->square_blocks += most > 0.0 ? fmin(fmax(common / most, 0.0), 1.0) * products : products;
}

void aur_deviations_add_pixel(aur_deviations *sum, const double *products, double d[3][AUR_REPLICAS_MAX],
                              double others, aur_cell *cell) {
    const gram_sums sums = sums_between(cell->count, products, products);
    for (size_t r = 0; r < cell->count; ++r)
        sum->trace += products[AUR_GRAM_SQUARE(r)];
    sum->others += others;
    for (size_t a = 0; a < 3; ++a)
        for (size_t b = 0; b < 3; ++b)
            for (size_t r = 0; r < cell->count; ++r)
                cell->products[a][b] += d[a][r] * d[b][r];
    cell->squares += sums.squares;
    cell->spread += spread_of(cell->count, &sums);
    ++cell->pixels;
}

void aur_deviations_add_cell(aur_deviations *sum, const aur_cell *cell) {
    const double n = (double)(cell->count - 1);
    double squares = -cell->squares;
    for (size_t a = 0; a < 3; ++a)
        for (size_t b = 0; b < 3; ++b)
            squares += cell->products[a][b] * cell->products[a][b];
    const double spread = (squares / (n * n) + cell->spread) / (double)cell->pixels;
    sum->cells += spread;
    sum->square_cells += spread * spread;
}

void aur_deviations_pool(aur_deviations *sum, size_t count, size_t columns, size_t rows,
                         const aur_block_spread *blocks) {
    double variance = 0.0;
    for (size_t i = 0; i < columns * rows; ++i)
        variance += blocks[i].variance;
    const double part = variance > 0.0 ? sum->trace / ((double)(count - 1) * variance) : 0.0;
    aur_deviations_set_blocks(sum, columns, rows, blocks);
    sum->blocks *= part * part;
    sum->square_blocks *= pow(part, 4.0);
}

/* An estimate of tr C^2 with its degrees of freedom. */
typedef struct spread_estimate {
    double spread, degrees;
} spread_estimate;

/* The relative variance of a spread is two divided by its degrees. For normal values, blocks that
 * deviate together have as many as there are independent differences of four replicas, count (count - 3) / 2
 * (two for three replicas, Wishart), and its square is one plus that variance times as large as expected. */
static spread_estimate spread_of_blocks(const aur_deviations *sum, double one) {
    return (spread_estimate){sum->blocks, (one + 2.0) * sum->blocks * sum->blocks / sum->square_blocks};
}

/* The estimate by cells is nearly the square of a variance with n degrees, whose relative variance is
 * 8 (n + 3) / (n (n + 2)). Pixels that share samples deviate together. */
static spread_estimate spread_of_cells(const aur_deviations *sum, double n) {
    const double squares = sum->overlap * sum->square_cells;
    return (spread_estimate){sum->overlap * sum->cells,
                             (n + 4.0) * (n + 6.0) / (4.0 * (n + 3.0)) * sum->cells * sum->cells / squares};
}

static spread_estimate find_spread(const aur_deviations *sum, size_t count) {
    const double n = (double)(count - 1), one = count > 3 ? 0.5 * (double)(count * (count - 3)) : 2.0;
    const spread_estimate blocks = spread_of_blocks(sum, one);
    const spread_estimate cells = spread_of_cells(sum, AUR_CELL_PIXELS * n);
    spread_estimate found = cells.spread > blocks.spread ? cells : blocks;
    found.spread = fmax(found.spread, 0.0);
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

/* Warping by a density image: inversion of piecewise linear distribution functions with guide tables (Devroye
 * 1986, III.2.4; Schretter 2012 fig. 4), in constant time on average, accurate within a pixel. */
#include <math.h>
#include <stdlib.h>

#include <aureole/sphere.h>

#include "points/base/error.h"

/* A distribution over `count` equal bins of [0,1): cumulative[i] is the mass before bin i, guide[k] the first
 * bin that reaches beyond k/count. */
typedef struct distribution {
    size_t count;
    const double *cumulative; /* count + 1 */
    const uint32_t *guide;    /* count */
} distribution;

struct aur_density_image {
    size_t width, height;
    double mean;
    double *cumulative; /* height rows of width + 1, then height + 1 of the rows' masses */
    uint32_t *guide;    /* height rows of width, then height */
    float *density;     /* row 0 at v = 0 */
};

enum { SIDE_LIMIT = 1 << 16 };

static distribution row_distribution(const aur_density_image *image, size_t row) {
    return (distribution){image->width, image->cumulative + row * (image->width + 1),
                          image->guide + row * image->width};
}

static distribution rows_distribution(const aur_density_image *image) {
    return (distribution){image->height, image->cumulative + image->height * (image->width + 1),
                          image->guide + image->height * image->width};
}

/* Turns the masses in cumulative[1..count] into a distribution; an empty one becomes uniform and is never
 * sampled. Returns the sum of the masses. */
static double accumulate(size_t count, double *cumulative, uint32_t *guide) {
    cumulative[0] = 0.0;
    for (size_t i = 0; i < count; ++i)
        cumulative[i + 1] += cumulative[i];
    const double sum = cumulative[count];
    for (size_t i = 0; i <= count; ++i)
        cumulative[i] = sum > 0.0 ? cumulative[i] / sum : (double)i / (double)count;
    uint32_t bin = 0;
    for (size_t k = 0; k < count; ++k) {
        while (bin + 1 < count && cumulative[bin + 1] <= (double)k / (double)count)
            ++bin;
        guide[k] = bin;
    }
    return sum;
}

/* Clamps coordinates to [0,1); NaN becomes 0. */
static double clamp_unit(double x) {
    return x >= 0.0 ? fmin(x, 0x1.fffffffffffffp-1) : 0.0;
}

static size_t find_bin(const distribution *d, double u) {
    size_t bin = d->guide[(size_t)(u * (double)d->count)];
    while (bin + 1 < d->count && d->cumulative[bin + 1] <= u)
        ++bin;
    /* trailing bins may be empty */
    while (bin > 0 && d->cumulative[bin + 1] <= d->cumulative[bin])
        --bin;
    return bin;
}

static double invert(const distribution *d, size_t bin, double u) {
    const double low = d->cumulative[bin];
    const double share = (u - low) / (d->cumulative[bin + 1] - low);
    return fmin(((double)bin + fmin(fmax(share, 0.0), 1.0)) / (double)d->count, 0x1.fffffffffffffp-1);
}

static size_t bin_at(size_t count, double x) {
    const size_t bin = (size_t)(x * (double)count);
    return bin < count ? bin : count - 1;
}

static double evaluate(const distribution *d, double x) {
    const size_t bin = bin_at(d->count, x);
    const double share = x * (double)d->count - (double)bin;
    const double low = d->cumulative[bin];
    return fmin(low + share * (d->cumulative[bin + 1] - low), 0x1.fffffffffffffp-1);
}

static aur_result fill_tables(aur_density_image *image, const float *density, aur_error *error) {
    const size_t width = image->width;
    const size_t height = image->height;
    double *const rows = image->cumulative + height * (width + 1);
    for (size_t row = 0; row < height; ++row) {
        /* images have the top row first, and v points up */
        const float *const from = density + (height - 1 - row) * width;
        double *const cumulative = image->cumulative + row * (width + 1);
        for (size_t x = 0; x < width; ++x) {
            if (!(from[x] >= 0.0f && from[x] <= 3.4e38f))
                return aur_fail(error, AUR_ERROR_ARGUMENT,
                                "a density must be finite and not negative: pixel %zu,%zu is %g", x,
                                height - 1 - row, (double)from[x]);
            cumulative[x + 1] = from[x];
            image->density[row * width + x] = from[x];
        }
        rows[row + 1] = accumulate(width, cumulative, image->guide + row * width);
    }
    image->mean = accumulate(height, rows, image->guide + height * width) / ((double)width * (double)height);
    if (!(image->mean > 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "a density image must not be black everywhere");
    return AUR_OK;
}

aur_result aur_density_image_create(size_t width, size_t height, const float *density,
                                    aur_density_image **image, aur_error *error) {
    *image = NULL;
    if (width == 0 || height == 0 || width > SIDE_LIMIT || height > SIDE_LIMIT)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "a density image must have 1 to %d pixels a side, not %zu x %zu", SIDE_LIMIT, width,
                        height);
    aur_density_image *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail_memory(error);
    created->width = width;
    created->height = height;
    created->cumulative = malloc((height * (width + 1) + height + 1) * sizeof *created->cumulative);
    created->guide = malloc((height * width + height) * sizeof *created->guide);
    created->density = malloc(height * width * sizeof *created->density);
    aur_result result = AUR_OK;
    if (created->cumulative == NULL || created->guide == NULL || created->density == NULL)
        result = aur_fail_memory(error);
    if (result == AUR_OK)
        result = fill_tables(created, density, error);
    if (result != AUR_OK) {
        aur_density_image_destroy(created);
        return result;
    }
    *image = created;
    return AUR_OK;
}

void aur_density_image_destroy(aur_density_image *image) {
    if (image == NULL)
        return;
    free(image->cumulative);
    free(image->guide);
    free(image->density);
    free(image);
}

void aur_density_image_warp(const aur_density_image *image, const double square[2], double warped[2]) {
    const double u = clamp_unit(square[0]);
    const double v = clamp_unit(square[1]);
    const distribution rows = rows_distribution(image);
    const size_t row = find_bin(&rows, v);
    const distribution columns = row_distribution(image, row);
    warped[0] = invert(&columns, find_bin(&columns, u), u);
    warped[1] = invert(&rows, row, v);
}

void aur_density_image_unwarp(const aur_density_image *image, const double warped[2], double square[2]) {
    const double x = clamp_unit(warped[0]);
    const double y = clamp_unit(warped[1]);
    const distribution rows = rows_distribution(image);
    const distribution columns = row_distribution(image, bin_at(image->height, y));
    square[0] = evaluate(&columns, x);
    square[1] = evaluate(&rows, y);
}

double aur_density_image_pdf(const aur_density_image *image, const double point[2]) {
    const size_t row = bin_at(image->height, clamp_unit(point[1]));
    const size_t column = bin_at(image->width, clamp_unit(point[0]));
    return (double)image->density[row * image->width + column] / image->mean;
}

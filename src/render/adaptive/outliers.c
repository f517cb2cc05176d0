#include "render/adaptive/comparison.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PART = 0.01;
/* Of the squared error, what outliers have at least. */
static const double LEAST_SHARE = 0.75;

static int descending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

/* The variance of one sample in each pixel. */
static void sample_variances(const aur_candidate *candidate, double *variances) {
    const size_t pixels = candidate->replicas.pixel_count;
    for (size_t i = 0; i < pixels; ++i) {
        double samples = 0.0;
        for (size_t r = 0; r < candidate->replicas.count; ++r)
            samples += candidate->targets[r * pixels + i];
        variances[i] = candidate->pixels[i].variance * samples;
    }
}

aur_outliers aur_outliers_find(aur_candidate *path, const aur_candidate *candidate) {
    const size_t pixels = path->replicas.pixel_count, most = (size_t)(PART * (double)pixels);
    aur_outliers found = {.rest = 1.0, .price = 1.0};
    double *const variances = path->scratch, *const sorted = path->scratch + pixels;
    if (most == 0)
        return found;
    sample_variances(path, variances);
    memcpy(sorted, variances, pixels * sizeof *sorted);
    qsort(sorted, pixels, sizeof *sorted, descending);
    double all = 0.0, others = 0.0, roots = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < pixels; ++i) {
        const double variance = candidate->pixels[i].variance;
        const bool is_one = variances[i] > sorted[most];
        all += variance;
        others += is_one ? 0.0 : variance;
        roots += is_one ? sqrt(variance) : 0.0;
        count += is_one;
    }
    if (!(all - others > LEAST_SHARE * all) || !(others > 0.0))
        return found;
    /* Samples in proportion to deviations (Neyman 1934). */
    const double mean = others / (double)(pixels - count);
    found.rest = others / all;
    found.price += fmax(roots / sqrt(mean) - (double)count, 0.0) / (double)pixels;
    return found;
}

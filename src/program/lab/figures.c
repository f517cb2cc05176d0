/* Statistics of repeated measurements. */
#include <aureole/statistics.h>
#include <math.h>

#include "program/lab/lab.h"

void lab_mean_interval(size_t count, const double *values, double *mean, double *half) {
    aur_moments moments = {0};
    for (size_t i = 0; i < count; ++i)
        aur_moments_add(&moments, values[i]);
    *mean = moments.mean;
    *half = aur_moments_interval(&moments, 0.95);
}

static double root(double value) {
    return sqrt(fmax(0.0, value));
}

static lab_interval root_of(double value, double half) {
    return (lab_interval){root(value), root(value - half), root(value + half)};
}

lab_interval lab_root_mean(size_t count, const double *squares) {
    double mean, half;
    lab_mean_interval(count, squares, &mean, &half);
    return root_of(mean, half);
}

lab_interval lab_root_ratio(size_t count, const double *squares, size_t base_count, const double *base) {
    if (squares == base)
        return (lab_interval){1.0, 1.0, 1.0};
    double mean, half, base_mean, base_half;
    lab_mean_interval(count, squares, &mean, &half);
    lab_mean_interval(base_count, base, &base_mean, &base_half);
    const double ratio = mean / base_mean;
    return root_of(ratio, ratio * hypot(half / mean, base_half / base_mean));
}

lab_interval lab_root_ratio_paired(size_t count, const double *squares, const double *base) {
    double mean, base_mean, half;
    lab_mean_interval(count, squares, &mean, &half);
    lab_mean_interval(count, base, &base_mean, &half);
    const double ratio = mean / base_mean;
    aur_moments off = {0};
    for (size_t k = 0; k < count; ++k)
        aur_moments_add(&off, (squares[k] - ratio * base[k]) / base_mean);
    return root_of(ratio, aur_moments_interval(&off, 0.95));
}

lab_interval lab_slope(size_t count, const double *x, const double *y) {
    double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0, left = 0.0;
    for (size_t i = 0; i < count; ++i) {
        mean_x += log(x[i]) / (double)count;
        mean_y += log(y[i]) / (double)count;
    }
    for (size_t i = 0; i < count; ++i) {
        xx += (log(x[i]) - mean_x) * (log(x[i]) - mean_x);
        xy += (log(x[i]) - mean_x) * (log(y[i]) - mean_y);
    }
    const double slope = xy / xx;
    if (count < 3)
        return (lab_interval){slope, -INFINITY, INFINITY};
    for (size_t i = 0; i < count; ++i) {
        const double off = log(y[i]) - mean_y - slope * (log(x[i]) - mean_x);
        left += off * off;
    }
    const double half = aur_student_quantile(count - 2, 0.975) * sqrt(left / ((double)(count - 2) * xx));
    return (lab_interval){slope, slope - half, slope + half};
}

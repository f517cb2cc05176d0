#include "render/image/error_measure.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/names.h"
#include "render/image/format.h"

/* Luminance of Rec. 709 primaries. */
static const double luminance[3] = {0.2126, 0.7152, 0.0722};

/* Scales from all values of an image. */
typedef struct error_scale {
    double mean;     /* of R, G and B */
    double bright;   /* mean luminance */
    double exposure; /* shows the geometric mean of luminance as a medium grey; only for the display */
} error_scale;

/* One measure: the weights of a pixel from the smoothed values, its differences, and a bound of the variance
 * that rare light causes in them. */
typedef struct measure_row {
    const char *name;
    void (*weigh)(const double value[3], const error_scale *scale, double weight[3]);
    void (*differ)(const double weight[3], const double from[3], size_t count, const double (*errors)[3],
                   double (*differences)[3]);
    double (*bound)(const double weight[3], const aur_rare_light *light);
} measure_row;

static double luminance_of(const double value[3]) {
    return luminance[0] * value[0] + luminance[1] * value[1] + luminance[2] * value[2];
}

/* The factor sqrt(3) turns the mean over three values per pixel into a mean over pixels. */
static void weigh_relative(const double value[3], const error_scale *scale, double weight[3]) {
    const double least = 0.01 * scale->bright;
    for (size_t c = 0; c < 3; ++c)
        weight[c] = sqrt(3.0) * luminance[c] / (fmax(luminance_of(value), 0.0) + least);
}

static void weigh_mean(const double value[3], const error_scale *scale, double weight[3]) {
    (void)value;
    for (size_t c = 0; c < 3; ++c)
        weight[c] = 1.0 / scale->mean;
}

static void weigh_display(const double value[3], const error_scale *scale, double weight[3]) {
    (void)value;
    for (size_t c = 0; c < 3; ++c)
        weight[c] = scale->exposure;
}

static void sum_difference(const double weight[3], const double from[3], size_t count,
                           const double (*errors)[3], double (*differences)[3]) {
    (void)from;
    for (size_t i = 0; i < count; ++i) {
        differences[i][0] = weight[0] * errors[i][0] + weight[1] * errors[i][1] + weight[2] * errors[i][2];
        differences[i][1] = differences[i][2] = 0.0;
    }
}

static void three_differences(const double weight[3], const double from[3], size_t count,
                              const double (*errors)[3], double (*differences)[3]) {
    (void)from;
    for (size_t i = 0; i < count; ++i)
        for (size_t c = 0; c < 3; ++c)
            differences[i][c] = weight[c] * errors[i][c];
}

static void displayed_differences(const double weight[3], const double from[3], size_t count,
                                  const double (*errors)[3], double (*differences)[3]) {
    for (size_t c = 0; c < 3; ++c) {
        const double start = aur_srgb_encode(weight[c] * from[c]);
        for (size_t i = 0; i < count; ++i)
            differences[i][c] = aur_srgb_encode(weight[c] * (from[c] + errors[i][c])) - start;
    }
}

/* The sum of weighted differences, squared, is at most the sum of squared errors times that of squared
 * weights (Cauchy-Schwarz). */
static double bound_of_sum(const double weight[3], const aur_rare_light *light) {
    return light->variance * (weight[0] * weight[0] + weight[1] * weight[1] + weight[2] * weight[2]);
}

static double bound_of_three(const double weight[3], const aur_rare_light *light) {
    return light->variance * weight[0] * weight[0];
}

/* A displayed value lies between 0 and 1, and after a hit between its value with one hit and 1. So its
 * variance is at most the variance between hit and miss plus that within hits (a quarter of the squared
 * range). That is the variance of the displayed mean of all replicas: if all have missed the light, averaging
 * does not lessen the error. */
static double bound_of_displayed(const double weight[3], const aur_rare_light *light) {
    const double count = light->replicas, n = light->samples * count, p = light->share;
    const double missed = pow(1.0 - p, n), linear = light->variance * weight[0] * weight[0];
    if (!(p > 0.0 && p < 1.0))
        return fmin(linear, 0.75 * count);
    const double hit = sqrt(light->variance * light->samples / (3.0 * p * (1.0 - p))) / n;
    const double range = 1.0 - aur_srgb_encode(weight[0] * hit);
    return fmin(linear, count * 3.0 * (1.0 - missed) * (missed + 0.25 * range * range));
}

/* In the order of aur_error_measure. */
static const measure_row measures[AUR_ERROR_MEASURE_COUNT] = {
    {"relative", weigh_relative, sum_difference, bound_of_sum},
    {"mean", weigh_mean, three_differences, bound_of_three},
    {"display", weigh_display, displayed_differences, bound_of_displayed},
};

static const char *name_at(const void *table, size_t index) {
    (void)table;
    return measures[index].name;
}

aur_result aur_error_measure_from_name(const char *name, aur_error_measure *measure, aur_error *error) {
    size_t index;
    const aur_result result = aur_names_choose((aur_names){AUR_ERROR_MEASURE_COUNT, name_at, NULL},
                                               "error measure", name, (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *measure = (aur_error_measure)index;
    return result;
}

const char *aur_error_measure_name(aur_error_measure measure) {
    return (size_t)measure < AUR_ERROR_MEASURE_COUNT ? measures[measure].name : NULL;
}

/* Black pixels, whose logarithm is undefined, count as a thousandth of the mean. */
static error_scale scale_of(aur_error_measure measure, size_t count, const double (*values)[3],
                            const double (*smooth)[3]) {
    error_scale scale = {.mean = 0.0};
    const double grey = 0.18, least = 1e-3;
    double logarithms = 0.0;
    for (size_t i = 0; i < count; ++i) {
        scale.mean += (values[i][0] + values[i][1] + values[i][2]) / (3.0 * (double)count);
        scale.bright += luminance_of(values[i]) / (double)count;
    }
    if (measure != AUR_ERROR_MEASURE_DISPLAY || !(scale.bright > 0.0))
        return scale;
    for (size_t i = 0; i < count; ++i)
        logarithms += log(fmax(luminance_of(smooth[i]), least * scale.bright));
    scale.exposure = grey / exp(logarithms / (double)count);
    return scale;
}

void aur_error_weigh(aur_error_measure measure, size_t count, const double (*values)[3],
                     const double (*smooth)[3], aur_error_weight *weights) {
    const error_scale scale = scale_of(measure, count, values, smooth);
    for (size_t i = 0; i < count; ++i)
        if (scale.mean > 0.0 && scale.bright > 0.0)
            measures[measure].weigh(smooth[i], &scale, weights[i].channel);
        else
            weights[i] = (aur_error_weight){{0.0}};
}

void aur_error_smooth(size_t width, size_t height, const double (*values)[3], double (*smooth)[3]) {
    enum { REACH = 2 };
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x) {
            double sum[3] = {0.0};
            size_t count = 0;
            for (size_t j = y > REACH ? y - REACH : 0; j <= y + REACH && j < height; ++j)
                for (size_t i = x > REACH ? x - REACH : 0; i <= x + REACH && i < width; ++i, ++count)
                    for (size_t c = 0; c < 3; ++c)
                        sum[c] += fabs(values[j * width + i][c]);
            for (size_t c = 0; c < 3; ++c)
                smooth[y * width + x][c] = sum[c] / (double)count;
        }
}

void aur_error_apply(aur_error_measure measure, const aur_error_weight *weight, const double from[3],
                     size_t count, const double (*errors)[3], double (*differences)[3]) {
    measures[measure].differ(weight->channel, from, count, errors, differences);
}

double aur_error_variance_bound(aur_error_measure measure, const aur_error_weight *weight,
                                const aur_rare_light *light) {
    return measures[measure].bound(weight->channel, light);
}

static void copy_colors(const aur_image *image, const size_t channels[3], double (*values)[3]) {
    for (size_t i = 0; i < image->width * image->height; ++i)
        for (size_t c = 0; c < 3; ++c)
            values[i][c] = (double)image->data[i * image->channel_count + channels[c]];
}

aur_result aur_image_error(const aur_image *reference, const aur_image *image, aur_error_measure measure,
                           double *value, aur_error *error) {
    if ((size_t)measure >= AUR_ERROR_MEASURE_COUNT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown error measure %d", (int)measure);
    aur_color_pair pair;
    const aur_result result = aur_image_check_pair(reference, image, &pair, error);
    if (result != AUR_OK)
        return result;
    const size_t pixels = image->width * image->height;
    double(*const values)[3] = malloc(3 * pixels * sizeof *values);
    aur_error_weight *const weights = malloc(pixels * sizeof *weights);
    if (values != NULL && weights != NULL) {
        double(*const smooth)[3] = values + pixels, (*const other)[3] = values + 2 * pixels;
        copy_colors(reference, pair.reference, values);
        copy_colors(image, pair.image, other);
        aur_error_smooth(image->width, image->height, (const double(*)[3])values, smooth);
        aur_error_weigh(measure, pixels, (const double(*)[3])values, (const double(*)[3])smooth, weights);
        double sum = 0.0, change = 0.0;
        for (size_t i = 0; i < pixels; ++i) {
            double errors[3], d[3];
            for (size_t c = 0; c < 3; ++c) {
                errors[c] = other[i][c] - values[i][c];
                change = fmax(change, fabs(errors[c]));
            }
            aur_error_apply(measure, &weights[i], values[i], 1, (const double(*)[3])errors, &d);
            sum += d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        }
        const bool black = !(weights[0].channel[0] > 0.0);
        *value = black && change > 0.0 ? INFINITY : sqrt(sum / (3.0 * (double)pixels));
    }
    free(values);
    free(weights);
    return values != NULL && weights != NULL ? AUR_OK : aur_fail_memory(error);
}

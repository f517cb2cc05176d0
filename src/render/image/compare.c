#include <math.h>

#include "points/base/names.h"
#include "render/image/format.h"

/* One metric: the mean over pixels of a term, then a function of the mean. Without a term it is the mean of a
 * map computed from the whole image. */
typedef struct color_metric {
    const char *name;
    /* Adds to sum and weight the term of value a and reference r. */
    double (*term)(double a, double r, double *weight);
    double (*finish)(double mean, double reference_mean);
    aur_result (*map)(const aur_image *reference, const aur_image *image, aur_image **map, aur_error *error);
} color_metric;

static double squared(double a, double r, double *weight) {
    *weight = 1.0;
    return (a - r) * (a - r);
}

static double absolute(double a, double r, double *weight) {
    *weight = 1.0;
    return fabs(a - r);
}

static double squared_relative(double a, double r, double *weight) {
    *weight = 1.0;
    return (a - r) * (a - r) / (r * r + 0.01);
}

static double squared_relative_nonzero(double a, double r, double *weight) {
    *weight = r != 0.0 ? 1.0 : 0.0;
    return r != 0.0 ? (a - r) / r * ((a - r) / r) : 0.0;
}

static double finish_mean(double mean, double reference_mean) {
    (void)reference_mean;
    return mean;
}

static double finish_root(double mean, double reference_mean) {
    (void)reference_mean;
    return sqrt(mean);
}

static double finish_relative_root(double mean, double reference_mean) {
    return mean > 0.0 ? sqrt(mean) / fabs(reference_mean) : 0.0;
}

/* In the order of aur_image_metric. */
static const color_metric metrics[AUR_IMAGE_METRIC_COUNT] = {
    {"rmse", squared, finish_root, NULL},
    {"mse", squared, finish_mean, NULL},
    {"mae", absolute, finish_mean, NULL},
    {"relmse", squared_relative, finish_mean, NULL},
    {"mrse", squared_relative_nonzero, finish_mean, NULL},
    {"relative-rmse", squared, finish_relative_root, NULL},
    {"flip", NULL, NULL, aur_image_flip},
};

static const char *metric_at(const void *table, size_t index) {
    (void)table;
    return metrics[index].name;
}

aur_result aur_image_metric_from_name(const char *name, aur_image_metric *found, aur_error *error) {
    size_t index;
    const aur_result result = aur_names_choose((aur_names){AUR_IMAGE_METRIC_COUNT, metric_at, NULL}, "metric",
                                               name, (aur_location){0}, &index, error);
    if (result == AUR_OK)
        *found = (aur_image_metric)index;
    return result;
}

const char *aur_image_metric_name(aur_image_metric which) {
    return (size_t)which < AUR_IMAGE_METRIC_COUNT ? metrics[which].name : NULL;
}

/* Sums each row separately, so that rounding errors stay small in large images. */
static void mean_of_channel(const aur_image *image, size_t channel, double *mean) {
    double sum = 0.0;
    for (size_t y = 0; y < image->height; ++y) {
        double row = 0.0;
        for (size_t x = 0; x < image->width; ++x)
            row += image->data[(y * image->width + x) * image->channel_count + channel];
        sum += row;
    }
    *mean = sum / ((double)image->width * (double)image->height);
}

static void mean_of_colors(const aur_image *image, const size_t channels[3], double mean[4]) {
    for (size_t c = 0; c < 3; ++c)
        mean_of_channel(image, channels[c], &mean[c]);
    mean[3] = (mean[0] + mean[1] + mean[2]) / 3.0;
}

aur_result aur_image_mean(const aur_image *image, double mean[4], aur_error *error) {
    size_t channels[3];
    aur_result result = aur_image_require_color("the image", image, channels, error);
    if (result == AUR_OK)
        result = aur_image_check_finite("the image", image, channels, error);
    if (result == AUR_OK)
        mean_of_colors(image, channels, mean);
    return result;
}

static aur_result mean_of_map(const color_metric *metric, const aur_image *reference, const aur_image *image,
                              double value[4], aur_error *error) {
    aur_image *map;
    const aur_result result = metric->map(reference, image, &map, error);
    if (result != AUR_OK)
        return result;
    mean_of_channel(map, 0, &value[3]);
    value[0] = value[1] = value[2] = value[3];
    aur_image_destroy(map);
    return AUR_OK;
}

aur_result aur_image_compare(const aur_image *reference, const aur_image *image, aur_image_metric which,
                             double value[4], aur_error *error) {
    if ((size_t)which >= AUR_IMAGE_METRIC_COUNT)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown image metric %d", (int)which);
    aur_color_pair pair;
    const aur_result result = aur_image_check_pair(reference, image, &pair, error);
    if (result != AUR_OK)
        return result;
    const color_metric *const metric = &metrics[which];
    if (metric->map != NULL)
        return mean_of_map(metric, reference, image, value, error);
    double reference_mean[4], sum[4] = {0.0}, weight[4] = {0.0};
    mean_of_colors(reference, pair.reference, reference_mean);
    for (size_t c = 0; c < 3; ++c) {
        for (size_t y = 0; y < image->height; ++y) {
            double row = 0.0, row_weight = 0.0;
            for (size_t x = 0; x < image->width; ++x) {
                const size_t i = y * image->width + x;
                const double a = image->data[i * image->channel_count + pair.image[c]];
                const double r = reference->data[i * reference->channel_count + pair.reference[c]];
                double counted;
                row += metric->term(a, r, &counted);
                row_weight += counted;
            }
            sum[c] += row;
            weight[c] += row_weight;
        }
        sum[3] += sum[c];
        weight[3] += weight[c];
    }
    for (size_t i = 0; i < 4; ++i)
        value[i] = metric->finish(weight[i] > 0.0 ? sum[i] / weight[i] : 0.0, reference_mean[i]);
    return AUR_OK;
}

/* Linear light of a perceptually uniform colour ramp: t in [0,1]. */
static void false_color(double t, float color[3]) {
    static const double ramp[][3] = {{0.00, 0.00, 0.00}, {0.16, 0.07, 0.36}, {0.42, 0.09, 0.48},
                                     {0.70, 0.17, 0.40}, {0.90, 0.33, 0.25}, {0.98, 0.58, 0.15},
                                     {0.98, 0.82, 0.35}, {1.00, 1.00, 0.88}};
    const size_t last = sizeof ramp / sizeof ramp[0] - 1;
    const double position = t * (double)last;
    const size_t below = position < (double)last ? (size_t)position : last - 1;
    const double fraction = position - (double)below;
    for (size_t c = 0; c < 3; ++c)
        color[c] = (float)aur_srgb_decode((1.0 - fraction) * ramp[below][c] + fraction * ramp[below + 1][c]);
}

static double pixel_difference(const aur_image *reference, const aur_image *image, const aur_color_pair *pair,
                               size_t pixel) {
    double largest = 0.0;
    for (size_t c = 0; c < 3; ++c) {
        const double a = (double)image->data[pixel * image->channel_count + pair->image[c]];
        const double r = (double)reference->data[pixel * reference->channel_count + pair->reference[c]];
        largest = fmax(largest, fabs(a - r));
    }
    return largest;
}

aur_result aur_image_false_color(const aur_image *image, double scale, aur_image **colored,
                                 aur_error *error) {
    *colored = NULL;
    if (!(scale >= 0.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "the value drawn brightest must be at least 0, not %g",
                        scale);
    const aur_result result = aur_image_create(image->width, image->height, 3, colored, error);
    if (result != AUR_OK)
        return result;
    const size_t pixels = image->width * image->height;
    double brightest = scale;
    for (size_t i = 0; i < pixels && scale == 0.0; ++i)
        brightest = fmax(brightest, (double)image->data[i * image->channel_count]);
    for (size_t i = 0; i < pixels; ++i) {
        const double value = (double)image->data[i * image->channel_count];
        const double part = brightest > 0.0 ? value / brightest : 0.0;
        false_color(fmin(fmax(part, 0.0), 1.0), (*colored)->data + 3 * i);
    }
    return AUR_OK;
}

aur_result aur_image_difference(const aur_image *reference, const aur_image *image, double scale,
                                aur_image **difference, aur_error *error) {
    *difference = NULL;
    aur_color_pair pair;
    aur_image *values;
    aur_result result = aur_image_check_pair(reference, image, &pair, error);
    if (result == AUR_OK)
        result = aur_image_create(image->width, image->height, 1, &values, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < image->width * image->height; ++i)
        values->data[i] = (float)pixel_difference(reference, image, &pair, i);
    result = aur_image_false_color(values, scale, difference, error);
    aur_image_destroy(values);
    return result;
}

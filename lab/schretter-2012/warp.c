/* Points distributed by a density: a clamped ramp and two Gaussians, by Hammersley's set and a golden one
 * (Schretter 2012, fig. 4). The paper only shows images. The error is the maximum, over all boxes with one
 * corner at the origin and the opposite one on a 64 x 64 grid, of the difference between the fraction of
 * points and that of the density. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/lab/lab.h"
#include "program/lab/points.h"

enum { PIXELS = 256, BOXES = 64, SETS = 5, MOST = 1024, SIDE = 360 };

static const char *const columns[] = {"density", "set", "points", "largest_difference", "difference_n", NULL};

/* Left to right from 0 to 1, with level ends of a fifth of the width. */
static double ramp(double x, double y) {
    (void)y;
    return fmin(1.0, fmax(0.0, (x - 0.2) / 0.6));
}

/* The exponent of a Gaussian about a, b, turned by an angle, of standard deviations s, t. */
static double exponent(double x, double y, const double at[2], double angle, const double widths[2]) {
    const double u = (cos(angle) * (x - at[0]) + sin(angle) * (y - at[1])) / widths[0];
    const double v = (cos(angle) * (y - at[1]) - sin(angle) * (x - at[0])) / widths[1];
    return -0.5 * (u * u + v * v);
}

static double two_gaussians(double x, double y) {
    return exp(exponent(x, y, (const double[]){0.35, 0.62}, 0.6, (const double[]){0.20, 0.08})) +
           0.7 * exp(exponent(x, y, (const double[]){0.68, 0.33}, -0.5, (const double[]){0.09, 0.16}));
}

typedef struct subject {
    const char *name;
    double (*value)(double x, double y);
} subject;

typedef struct warp_study {
    lab_run *run;
    const subject *subject;
    float pixels[PIXELS * PIXELS]; /* the top row first */
    double shares[BOXES + 1][BOXES + 1];
    aur_density_image *density;
    report_table *points;
} warp_study;

/* The image, and its sum below and to the left of each grid position: pixels and positions coincide. */
static aur_result prepare(warp_study *study, aur_error *error) {
    enum { BLOCK = PIXELS / BOXES };
    double sum = 0.0;
    for (size_t row = 0; row < PIXELS; ++row)
        for (size_t column = 0; column < PIXELS; ++column) {
            const double x = ((double)column + 0.5) / PIXELS, y = ((double)(PIXELS - 1 - row) + 0.5) / PIXELS;
            study->pixels[row * PIXELS + column] = (float)study->subject->value(x, y);
        }
    memset(study->shares, 0, sizeof study->shares);
    for (size_t i = 0; i < (size_t)PIXELS * PIXELS; ++i) {
        const size_t u = i % PIXELS / BLOCK, v = (PIXELS - 1 - i / PIXELS) / BLOCK;
        study->shares[v + 1][u + 1] += (double)study->pixels[i];
        sum += (double)study->pixels[i];
    }
    for (size_t v = 1; v <= BOXES; ++v)
        for (size_t u = 1; u <= BOXES; ++u) {
            study->shares[v][u] /= sum;
            study->shares[v][u] +=
                study->shares[v - 1][u] + study->shares[v][u - 1] - study->shares[v - 1][u - 1];
        }
    return aur_density_image_create(PIXELS, PIXELS, study->pixels, &study->density, error);
}

static double largest_difference(const warp_study *study, size_t count, const double *warped) {
    double most = 0.0;
    for (size_t v = 1; v <= BOXES; ++v)
        for (size_t u = 1; u <= BOXES; ++u) {
            size_t inside = 0;
            for (size_t i = 0; i < count; ++i)
                inside += warped[2 * i] * BOXES < (double)u && warped[2 * i + 1] * BOXES < (double)v;
            most = fmax(most, fabs((double)inside / (double)count - study->shares[v][u]));
        }
    return most;
}

static aur_result warp(const warp_study *study, const char *set, size_t count, double *warped,
                       aur_error *error) {
    aur_points *generated;
    const aur_result result = lab_points_make(
        &(lab_points){.set = set, .domain = AUR_DOMAIN_SQUARE, .size = count}, &generated, error);
    if (result != AUR_OK)
        return result;
    const aur_points_view *const points = aur_points_get_view(generated);
    for (size_t i = 0; i < count; ++i)
        aur_density_image_warp(study->density, points->coordinates + points->stride * i, warped + 2 * i);
    aur_points_destroy(generated);
    return AUR_OK;
}

/* The points on white; with NULL the density. */
static aur_result draw(const warp_study *study, const char *set, size_t count, const double *warped,
                       aur_error *error) {
    aur_image *image;
    aur_result result = lab_canvas(SIDE, SIDE, &image, error);
    if (result != AUR_OK)
        return result;
    float *const data = aur_image_data(image);
    for (size_t i = 0; i < (size_t)SIDE * SIDE && set == NULL; ++i) {
        const size_t at = i / SIDE * PIXELS / SIDE * PIXELS + i % SIDE * PIXELS / SIDE;
        for (size_t c = 0; c < 3; ++c)
            data[3 * i + c] = study->pixels[at];
    }
    for (size_t i = 0; i < count && set != NULL; ++i)
        lab_dot(image, warped[2 * i] * SIDE, (1.0 - warped[2 * i + 1]) * SIDE, 2.5, lab_colour(0));
    const lab_image_position position = {.view = study->subject->name, .name = set != NULL ? set : "density"};
    result = lab_image(study->run, &position, image, error);
    aur_image_destroy(image);
    return result;
}

static aur_result add_row(const warp_study *study, const char *set, size_t count, bool shown,
                          double *difference, aur_error *error) {
    double warped[2 * MOST];
    aur_result result = warp(study, set, count, warped, error);
    if (result == AUR_OK && shown)
        result = draw(study, set, count, warped, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < count && shown; ++i)
        lab_table_row(study->points, (const char *const[]){study->subject->name, set, NULL}, 2,
                      warped + 2 * i);
    *difference = largest_difference(study, count, warped);
    lab_row(study->run, (const char *const[]){study->subject->name, set, NULL}, 3,
            (const double[]){(double)count, *difference, (double)count * *difference});
    return AUR_OK;
}

static aur_result study_density(warp_study *study, aur_error *error) {
    const lab_options *const options = lab_run_options(study->run);
    const char *const sets[SETS] = {"hammersley", "golden-set", "blue-noise", "random", options->set};
    const size_t counts[] = {512, 64, MOST};
    aur_result result = prepare(study, error);
    if (result == AUR_OK)
        result = draw(study, NULL, 0, NULL, error);
    for (size_t n = 0; n < (options->quick ? 1 : 3) && result == AUR_OK; ++n) {
        double difference[SETS];
        for (size_t s = 0; s < SETS && sets[s] != NULL && result == AUR_OK; ++s)
            result = lab_forgive(study->run, sets[s],
                                 add_row(study, sets[s], counts[n], n == 0 && s != 3, &difference[s], error),
                                 error);
        if (result == AUR_OK && n == 0)
            lab_claim(study->run, difference[0] < 0.5 * difference[3] && difference[1] < 0.5 * difference[3],
                      "fig. 4, %s: Hammersley's and golden points follow it evenly (their largest "
                      "differences %.4f and %.4f are "
                      "below half of that of random points, %.4f)",
                      study->subject->name, difference[0], difference[1], difference[3]);
    }
    aur_density_image_destroy(study->density);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    static const char *const of_points[] = {"density", "set", "x", "y", NULL};
    static const subject subjects[] = {{"ramp", ramp}, {"two Gaussians", two_gaussians}};
    warp_study *const study = malloc(sizeof *study);
    if (study == NULL) {
        *error = (aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"};
        return AUR_ERROR_MEMORY;
    }
    study->run = run;
    study->points = lab_table(run, "points", of_points);
    aur_result result = AUR_OK;
    for (size_t i = 0; i < 2 && result == AUR_OK; ++i) {
        study->subject = &subjects[i];
        study->density = NULL;
        result = study_density(study, error);
    }
    free(study);
    return result;
}

static const report_plot plots[] = {
    {.name = "points",
     .title = "512 points that follow a density",
     .table = "points",
     .x = "x",
     .y = "y",
     .panel = "density,set",
     .points = true},
    {.name = NULL},
};

const lab_experiment lab_schretter_2012_warp = {
    .name = "schretter-2012-warp",
    .reproduces = "Schretter 2012, fig. 4",
    .summary = "points that follow a ramp and two Gaussians, and how well they do",
    .columns = columns,
    .plots = plots,
    .seconds = 0.2,
    .quick_seconds = 0.1,
    .run = run,
};

/* Coverage of the intervals of images' errors, with fixed rounds and with a target error, and of measures of
 * randomised sets. */
#include <aureole-render/adaptive.h>
#include <aureole/pointset.h>
#include <aureole/quality.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "coverage.h"

/* Pixels per side, and values per image. */
enum { SIDE = 16, VALUES = 3 * SIDE * SIDE };

typedef struct rendering {
    float values[VALUES];
    double low, high, mean, samples;
} rendering;

static aur_result render(lab_run *run, aur_renderer *renderer, double target_error, size_t seed,
                         rendering *rendered, aur_error *error) {
    aur_render_options options = {.size = sizeof options};
    aur_render_options_init(&options, NULL);
    options.width = options.height = SIDE;
    options.integrator = "path";
    options.filter = "box";
    options.seed = seed;
    options.threads = lab_run_options(run)->threads;
    aur_adaptive_options target = {.size = sizeof target};
    aur_adaptive_options_init(&target, NULL);
    target.error = target_error;
    target.measure = AUR_ERROR_MEASURE_MEAN;
    target.rounds = target_error > 0.0 ? 0 : 2;
    aur_adaptive *adaptive = NULL;
    aur_image *image = NULL;
    aur_adaptive_report report = {.size = sizeof report};
    aur_result result = aur_adaptive_create(renderer, &options, &target, &adaptive, error);
    if (result == AUR_OK)
        result = aur_adaptive_run(adaptive, error);
    if (result == AUR_OK)
        result = aur_adaptive_get_report(adaptive, &report, error);
    if (result == AUR_OK)
        result = aur_adaptive_develop(adaptive, false, &image, error);
    if (result == AUR_OK) {
        memcpy(rendered->values, aur_image_data(image), sizeof rendered->values);
        rendered->low = report.error_low;
        rendered->high = report.error_high;
        rendered->mean = report.mean;
        rendered->samples = report.samples_per_pixel;
    }
    aur_image_destroy(image);
    aur_adaptive_destroy(adaptive);
    return result;
}

/* The image's root mean square error, relative to its mean. Counted as covered if it is within the interval,
 * and if it is below the interval's upper end, which is the stopping criterion of a render to a target error.
 */
static void count_image(const rendering *rendered, const float *reference, lab_tally t[2]) {
    double squares = 0.0;
    for (size_t i = 0; i < VALUES; ++i) {
        const double off = (double)rendered->values[i] - (double)reference[i];
        squares += off * off / VALUES;
    }
    const double error = sqrt(squares) / rendered->mean;
    lab_tally_count(&t[0], 0.5 * (rendered->low + rendered->high), 0.5 * (rendered->high - rendered->low),
                    error, rendered->samples);
    lab_tally_count(&t[1], 0.5 * rendered->high, 0.5 * rendered->high, error, rendered->samples);
}

static aur_result study_images(lab_run *run, lab_tally *pooled, aur_error *error) {
    const size_t seeds = lab_run_options(run)->quick ? 40 : 1000;
    static const double target_error[2] = {0.0, 0.08};
    aur_scene *scene = NULL;
    aur_renderer *renderer = NULL;
    rendering *const rendered = malloc(2 * seeds * sizeof *rendered);
    aur_result result = rendered == NULL
                            ? aur_fail(error, AUR_ERROR_MEMORY, "out of memory")
                            : lab_load_scene(run, "cornell-box/cornell-box.xml", 0, NULL, &scene, error);
    if (result == AUR_OK)
        result = aur_renderer_create(scene, &renderer, error);
    for (size_t i = 0; i < 2 * seeds && result == AUR_OK; ++i)
        result = render(run, renderer, target_error[i / seeds], i, &rendered[i], error);
    /* The reference is the mean over all runs; all runs have different seeds. */
    float reference[VALUES];
    double weight = 0.0;
    for (size_t i = 0; i < 2 * seeds && result == AUR_OK; ++i)
        weight += rendered[i].samples;
    for (size_t k = 0; k < VALUES && result == AUR_OK; ++k) {
        double sum = 0.0;
        for (size_t i = 0; i < 2 * seeds; ++i)
            sum += rendered[i].samples / weight * (double)rendered[i].values[k];
        reference[k] = (float)sum;
    }
    for (size_t kind = 0; kind < 2 && result == AUR_OK; ++kind) {
        lab_tally t[2] = {{0}, {0}};
        for (size_t i = 0; i < seeds; ++i)
            count_image(&rendered[kind * seeds + i], reference, t);
        lab_tally_report(run, "image's error", target_error[kind], &t[0]);
        lab_tally_report(run, "image's error below the end", target_error[kind], &t[1]);
        lab_tally_add(pooled, &t[0]);
    }
    free(rendered);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
    return result;
}

/* The energy of scrambled nets: eight randomisations give one interval, as in `aureole measure --seeds 8`.
 * The reference is the mean over all of them. */
static aur_result study_measure(lab_run *run, lab_tally *pooled, aur_error *error) {
    enum { RUNS = 8, POINTS = 32 };
    const size_t seeds = lab_run_options(run)->quick ? 200 : 1000;
    double *const values = malloc(seeds * RUNS * sizeof *values);
    aur_result result = values != NULL ? AUR_OK : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    double reference = 0.0;
    for (size_t i = 0; i < seeds * RUNS && result == AUR_OK; ++i) {
        double points[2 * POINTS];
        aur_pointset_options options = {.size = sizeof options};
        aur_pointset_options_init(POINTS, &options, NULL);
        options.scramble = AUR_SCRAMBLE_OWEN;
        options.seed = i;
        aur_pointset *set = NULL;
        result = aur_pointset_create("sobol", &options, &set, error);
        if (result == AUR_OK)
            result = aur_pointset_points(set, 0, POINTS, 2 * POINTS, points, error);
        aur_pointset_destroy(set);
        const aur_points_view view = aur_points_view_of(AUR_DOMAIN_SQUARE, POINTS, 2, points);
        if (result == AUR_OK)
            result = aur_measure("l2-star", &view, NULL, &values[i], error);
        if (result == AUR_OK)
            reference += values[i] / (double)(seeds * RUNS);
    }
    lab_tally t = {0};
    for (size_t i = 0; i < seeds && result == AUR_OK; ++i) {
        double mean, half;
        lab_mean_interval(RUNS, values + RUNS * i, &mean, &half);
        lab_tally_count(&t, mean, half, reference, POINTS);
    }
    if (result == AUR_OK) {
        lab_tally_report(run, "discrepancy of scrambled nets", 0.0, &t);
        lab_tally_add(pooled, &t);
    }
    free(values);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    lab_tally pooled = {0};
    aur_result result = study_images(run, &pooled, error);
    if (result == AUR_OK)
        result = study_measure(run, &pooled, error);
    if (result == AUR_OK)
        lab_tally_report(run, "pooled", 0.0, &pooled);
    return result;
}

const lab_experiment lab_image_coverage = {
    .name = "image-coverage",
    .reproduces = "docs/lighting-accuracy.md",
    .summary = "how often intervals of images' errors and of measures of randomised sets hold",
    .columns = lab_tally_of_samples,
    .takes_no_set = "it judges intervals of points that the program chooses",
    .seconds = 51,
    .quick_seconds = 2,
    .run = run,
    .takes_no_scene = "its answers are known for given scenes only",
};

/* Four plates under seven lights by spherical Fibonacci and Larcher-Pillichshammer points: images, the ratio
 * of RMSEs and of the largest errors (Marques 2013, fig. 1).
 *
 * The paper does not state the number of directions, so three are tried. Mean square errors are against two
 * independent references; intervals are over independent randomisations. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gathering.h"

enum { COUNTS = 3, MOST_SEEDS = 24, OTHERS = 2, QUANTITIES = 2, SHOWN = 256, WIDTH = 64, HEIGHT = 48 };

static const size_t counts[COUNTS] = {64, 128, 256};

/* Percent of RMSE above spherical Fibonacci's; the largest squared errors of a pixel. */
static const double published[QUANTITIES] = {1.0755, 0.71 / 0.39};
static const char *const quantities[QUANTITIES] = {"rmse", "largest quadratic error"};

typedef struct study {
    lab_run *run;
    lab_stage stage;
    size_t seeds, reference_directions;
    marques_gathering form;
    aur_image *references[2]; /* NULL: not rendered yet */
} study;

/* The maximum over pixels of (x - a)(x - b), averaged over channels. */
static double largest_product(const aur_image *x, const aur_image *a, const aur_image *b) {
    const size_t channels = aur_image_channel_count(x), pixels = aur_image_width(x) * aur_image_height(x);
    const float *const of_x = aur_image_data(x), *const of_a = aur_image_data(a);
    const float *const of_b = aur_image_data(b);
    double largest = 0.0;
    for (size_t i = 0; i < pixels; ++i) {
        double sum = 0.0;
        for (size_t k = i * channels; k < (i + 1) * channels; ++k)
            sum += ((double)of_x[k] - (double)of_a[k]) * ((double)of_x[k] - (double)of_b[k]);
        largest = fmax(largest, sum / (double)channels);
    }
    return largest;
}

static aur_result need_references(study *s, aur_error *error) {
    if (s->references[0] != NULL)
        return AUR_OK;
    const aur_result result = marques_references(s->run, s->stage.renderer, &s->form, s->reference_directions,
                                                 s->references, error);
    const lab_image_position position = {"plates", "reference", true, 1.0};
    return result != AUR_OK ? result : lab_image(s->run, &position, s->references[0], error);
}

/* Both quantities, one value per randomisation; writes the image of the first. */
static aur_result measure(study *s, const char *set, size_t directions,
                          double values[QUANTITIES * MOST_SEEDS], aur_error *error) {
    char key[120];
    snprintf(key, sizeof key, "%.80s %zu", set, directions);
    if (lab_recall(s->run, key, QUANTITIES * s->seeds, values))
        return AUR_OK;
    const marques_pattern pattern = {.set = set, .map = AUR_MAP_LAMBERT};
    aur_result result = need_references(s, error);
    for (size_t k = 0; k < s->seeds && result == AUR_OK; ++k) {
        marques_gathering what = s->form;
        aur_image *image = NULL;
        what.pattern = &pattern;
        what.diffuse = what.glossy = directions;
        what.seed = 1 + k;
        result = marques_gather(s->run, s->stage.renderer, &what, &image, error);
        if (result == AUR_OK) {
            values[k] = lab_mean_product(image, s->references[0], s->references[1]);
            values[s->seeds + k] = largest_product(image, s->references[0], s->references[1]);
        }
        const lab_image_position position = {"plates", set, .exposure = 1.0};
        if (result == AUR_OK && k == 0 && directions == SHOWN)
            result = lab_image(s->run, &position, image, error);
        aur_image_destroy(image);
    }
    return result != AUR_OK ? result : lab_save(s->run, key, QUANTITIES * s->seeds, values, error);
}

static aur_result compare(study *s, const char *set, bool is_published, size_t directions, const double *base,
                          aur_error *error) {
    double values[QUANTITIES * MOST_SEEDS];
    const aur_result result = measure(s, set, directions, values, error);
    if (result != AUR_OK)
        return result;
    for (size_t q = 0; q < QUANTITIES; ++q) {
        const double *const of_base = &base[q * s->seeds], *const of_set = &values[q * s->seeds];
        lab_interval r = lab_root_ratio(s->seeds, of_set, s->seeds, of_base);
        const bool root = q == 0;
        const double base_value = lab_root_mean(s->seeds, of_base).value;
        const double set_value = lab_root_mean(s->seeds, of_set).value;
        if (!root)
            r = (lab_interval){r.value * r.value, r.low * r.low, r.high * r.high};
        lab_row(s->run, (const char *const[]){set, quantities[q], NULL}, 7,
                (const double[]){(double)directions, root ? base_value : base_value * base_value,
                                 root ? set_value : set_value * set_value, r.value, r.low, r.high,
                                 is_published && !lab_run_options(s->run)->quick ? published[q] : NAN});
    }
    return AUR_OK;
}

static aur_result study_counts(study *s, aur_error *error) {
    const char *const others[OTHERS] = {"larcher-pillichshammer", lab_run_options(s->run)->set};
    aur_result result = AUR_OK;
    for (size_t n = 0; n < COUNTS && result == AUR_OK; ++n) {
        double base[QUANTITIES * MOST_SEEDS];
        result = measure(s, "spherical-fibonacci", counts[n], base, error);
        for (size_t i = 0; i < OTHERS && others[i] != NULL && result == AUR_OK; ++i)
            result =
                lab_forgive(s->run, others[i], compare(s, others[i], i == 0, counts[n], base, error), error);
    }
    for (size_t i = 0; i < 2; ++i)
        aur_image_destroy(s->references[i]);
    return result;
}

static const char *const columns[] = {"pattern", "quantity", "directions", "spherical_fibonacci", "its_own",
                                      "ratio",   "low",      "high",       "published",           NULL};

static aur_result run(lab_run *run, aur_error *error) {
    const bool quick = lab_run_options(run)->quick;
    study s = {.run = run,
               .seeds = quick ? 3 : MOST_SEEDS,
               .reference_directions = quick ? 1024 : 2048,
               .form = {.light = "direct=gather,incident=emitters",
                        .photons = 1000,
                        .width = quick ? WIDTH / 4 : WIDTH,
                        .height = quick ? HEIGHT / 4 : HEIGHT}};
    /* The quick form needs no generated mesh. */
    aur_result result =
        lab_stage_open(run, quick ? "cornell-box/glossy.xml" : "plates/plates.xml", 0, NULL, &s.stage, error);
    if (s.stage.renderer != NULL && result == AUR_OK)
        result = study_counts(&s, error);
    if (result == AUR_OK && quick)
        lab_note(run, "the quick form looks at the glossy Cornell box, of which nothing is published");
    lab_stage_close(&s.stage);
    return result;
}

static const report_plot plots[] = {
    {.name = "ratio",
     .title = "Over spherical Fibonacci points, against directions per pixel",
     .x = "directions",
     .y = "ratio",
     .low = "low",
     .high = "high",
     .series = "pattern",
     .panel = "quantity",
     .log_x = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2013_fig1 = {
    .name = "marques-2013-fig1",
    .reproduces = "Marques 2013, fig. 1",
    .summary = "four plates by spherical Fibonacci and Larcher-Pillichshammer points: RMSE and largest error",
    .columns = columns,
    .measured = "ratio",
    .low = "low",
    .high = "high",
    .published = "published",
    .factor = LAB_RATIO_FACTOR,
    .plots = plots,
    .seconds = 25,
    .quick_seconds = 0.2,
    .run = run,
    .parameters = lab_scene_parameters,
};

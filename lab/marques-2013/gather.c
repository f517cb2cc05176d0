/* Spherical Fibonacci against scrambled Sobol in final gathering of the glossy Cornell box (Marques 2013,
 * section 6).
 *
 * The quality of a pattern is the RMSE of its images against the same estimator with very many directions, on
 * the same photon map and the same primary hits (pixel centres), separately for the diffuse and the glossy
 * component of the indirect light. Intervals are over independent randomisations of the patterns. */
#include <math.h>
#include <stdio.h>

#include "program/lab/lab.h"

enum { SET_CAPACITY = 3, MOST_SCRAMBLES = 16 };

typedef struct gather_study {
    lab_run *run;
    lab_stage stage;
    size_t side; /* pixels per side */
    size_t photons;
    size_t reference_directions;
    size_t scrambles; /* independent randomisations */
    size_t count_count;
    size_t counts[4];    /* directions per pixel */
    size_t path_samples; /* per pixel, of the path-traced image against which the bias is measured */
    size_t set_count;
    const char *sets[SET_CAPACITY];
    aur_image *reference; /* of the component under study; NULL: not rendered yet */
} gather_study;

static const char *const columns[] = {"component", "pattern", "directions", "rmse",       "rmse_low",
                                      "rmse_high", "ratio",   "ratio_low",  "ratio_high", NULL};

static aur_result render(const gather_study *study, const char *integrator, size_t samples, uint64_t seed,
                         aur_image **image, aur_error *error) {
    const lab_rendering how = {.renderer = study->stage.renderer,
                               .integrator = integrator,
                               .samples = samples,
                               .seed = seed,
                               .width = study->side,
                               .height = study->side};
    return lab_render(study->run, &how, image, error);
}

/* One component of the indirect light at the pixel centres. Every shading point has an independent
 * randomisation. */
static aur_result render_component(const gather_study *study, const char *component, const char *set,
                                   size_t directions, size_t scramble, aur_image **image, aur_error *error) {
    char integrator[320];
    snprintf(
        integrator, sizeof integrator,
        "finalgather-lab:component=%s,direct=none,pixel=centre,edges=0,short_rays=0,density=same,rotations="
        "0,photons=%zu,"
        "photons_per_texel=64,pattern=%s,"
        "diffuse_samples=%zu,glossy_samples=%zu,pattern_seed=%zu",
        component, study->photons, set, directions, directions, scramble);
    return render(study, integrator, 1, 0, image, error);
}

/* The reference of a component, rendered on first use. */
static aur_result need_reference(gather_study *study, const char *component, aur_error *error) {
    if (study->reference != NULL)
        return AUR_OK;
    const aur_result result = render_component(study, component, "spherical-fibonacci",
                                               study->reference_directions, 0, &study->reference, error);
    if (result != AUR_OK)
        return result;
    const lab_image_position position = {
        .view = component, .name = "reference", .reference = true, .exposure = 1.0};
    return lab_image(study->run, &position, study->reference, error);
}

/* Mean square errors of one pattern, one value per scramble; writes the image of the first. */
static aur_result measure(gather_study *study, const char *component, const char *set, size_t directions,
                          double *mse, aur_error *error) {
    char key[160];
    snprintf(key, sizeof key, "%s %.80s %zu", component, set, directions);
    if (lab_recall(study->run, key, study->scrambles, mse))
        return AUR_OK;
    aur_result result = need_reference(study, component, error);
    for (size_t k = 0; k < study->scrambles && result == AUR_OK; ++k) {
        aur_image *image = NULL;
        double value[4];
        result = render_component(study, component, set, directions, 1 + k, &image, error);
        if (result == AUR_OK)
            result = aur_image_compare(study->reference, image, AUR_IMAGE_MSE, value, error);
        if (result == AUR_OK)
            mse[k] = value[3];
        if (result == AUR_OK && k == 0 && directions == 64) {
            const lab_image_position position = {.view = component, .name = set, .exposure = 1.0};
            result = lab_image(study->run, &position, image, error);
        }
        aur_image_destroy(image);
    }
    return result != AUR_OK ? result : lab_save(study->run, key, study->scrambles, mse, error);
}

/* The row of one pattern; `base` is the first pattern's mean square errors with the same number of
 * directions. */
static void add_row(const gather_study *study, const char *component, const char *set, size_t directions,
                    const double *mse, const double *base) {
    const lab_interval rmse = lab_root_mean(study->scrambles, mse);
    const lab_interval ratio = lab_root_ratio(study->scrambles, mse, study->scrambles, base);
    lab_row(study->run, (const char *const[]){component, set, NULL}, 7,
            (const double[]){(double)directions, rmse.value, rmse.low, rmse.high, ratio.value, ratio.low,
                             ratio.high});
}

/* Whether the intervals of two patterns are disjoint, the first below. */
static bool apart(size_t count, const double *lower, const double *upper) {
    double low_mean, low_half, high_mean, high_half;
    lab_mean_interval(count, lower, &low_mean, &low_half);
    lab_mean_interval(count, upper, &high_mean, &high_half);
    return low_mean + low_half < high_mean - high_half;
}

static aur_result study_component(gather_study *study, const char *component, aur_error *error) {
    aur_result result = AUR_OK;
    size_t won = 0;
    for (size_t n = 0; n < study->count_count && result == AUR_OK; ++n) {
        double mse[SET_CAPACITY][MOST_SCRAMBLES];
        for (size_t s = 0; s < study->set_count && result == AUR_OK; ++s) {
            const aur_result measured =
                measure(study, component, study->sets[s], study->counts[n], mse[s], error);
            if (measured == AUR_OK)
                add_row(study, component, study->sets[s], study->counts[n], mse[s], mse[0]);
            result = lab_forgive(study->run, study->sets[s], measured, error);
        }
        if (result == AUR_OK)
            won += apart(study->scrambles, mse[0], mse[1]);
    }
    aur_image_destroy(study->reference);
    study->reference = NULL;
    if (result == AUR_OK)
        lab_note(study->run,
                 "%s: spherical Fibonacci below Sobol with the intervals apart at %zu of %zu counts",
                 component, won, study->count_count);
    return result;
}

/* Complete light paths against path tracing: the bias of the photon map, apart from the noise of patterns. */
static aur_result measure_bias(const gather_study *study, aur_error *error) {
    enum { GATHERED, TRACED, RMSE, VALUES };
    double values[VALUES], mean[4];
    if (!lab_recall(study->run, "bias", VALUES, values)) {
        char integrator[96];
        snprintf(integrator, sizeof integrator, "finalgather:photons=%zu", study->photons);
        aur_image *images[2] = {NULL}, *small[2] = {NULL};
        static const lab_image_position positions[2] = {{"whole light", "finalgather", .exposure = 0.5},
                                                        {"whole light", "path", true, 0.5}};
        aur_result result = render(study, integrator, study->path_samples / 4, 1, &images[0], error);
        if (result == AUR_OK)
            result = render(study, "path", study->path_samples, 2, &images[1], error);
        for (size_t i = 0; i < 2 && result == AUR_OK; ++i) {
            result = lab_image(study->run, &positions[i], images[i], error);
            if (result == AUR_OK)
                result = aur_image_mean(images[i], mean, error);
            values[GATHERED + i] = mean[3];
            if (result == AUR_OK)
                result = aur_image_downsample(images[i], 8, &small[i], error);
        }
        if (result == AUR_OK)
            result = aur_image_compare(small[1], small[0], AUR_IMAGE_RMSE, mean, error);
        values[RMSE] = mean[3];
        for (size_t i = 0; i < 2; ++i) {
            aur_image_destroy(images[i]);
            aur_image_destroy(small[i]);
        }
        if (result == AUR_OK)
            result = lab_save(study->run, "bias", VALUES, values, error);
        if (result != AUR_OK)
            return result;
    }
    lab_note(study->run,
             "bias of finalgather against path (%zu samples per pixel): mean %+.2f %%, RMSE of 8x8 means "
             "%.2f %% of the mean",
             study->path_samples, 100.0 * (values[GATHERED] / values[TRACED] - 1.0),
             100.0 * values[RMSE] / values[TRACED]);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    gather_study study = {.run = run,
                          .side = options->quick ? 24 : 64,
                          .photons = options->quick ? 20000 : 500000,
                          .reference_directions = options->quick ? 4096 : 16384,
                          .scrambles = options->quick ? 4 : MOST_SCRAMBLES,
                          .count_count = options->quick ? 1 : 4,
                          .counts = {64, 16, 256, 512},
                          .path_samples = options->quick ? 32 : 1024,
                          .set_count = options->set != NULL ? 3 : 2,
                          .sets = {"spherical-fibonacci", "sobol", options->set}};
    aur_result result = lab_stage_open(run, "cornell-box/glossy.xml", 0, NULL, &study.stage, error);
    if (result == AUR_OK && study.stage.renderer != NULL)
        result = study_component(&study, "diffuse", error);
    if (result == AUR_OK && study.stage.renderer != NULL)
        result = study_component(&study, "glossy", error);
    if (result == AUR_OK && study.stage.renderer != NULL)
        result = measure_bias(&study, error);
    lab_stage_close(&study.stage);
    return result;
}

static const report_plot plots[] = {
    {.name = "rmse",
     .title = "RMSE of the indirect light against directions per pixel",
     .x = "directions",
     .y = "rmse",
     .low = "rmse_low",
     .high = "rmse_high",
     .series = "pattern",
     .panel = "component",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2013_gather = {
    .name = "marques-2013-gather",
    .reproduces = "Marques 2013, section 6.2, and the photon map's bias",
    .summary = "spherical Fibonacci against scrambled Sobol in the glossy Cornell box; gathering against "
               "path tracing",
    .columns = columns,
    .plots = plots,
    .seconds = 70,
    .quick_seconds = 1,
    .run = run,
    .parameters = lab_scene_parameters,
};

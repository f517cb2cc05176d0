/* Ambient occlusion by five sets of 16 and of 64 directions (Schretter 2012, fig. 5).
 *
 * Every pixel has one ray through its centre and an independently randomised set: sets of the square by
 * Cranley-Patterson rotation (a shift modulo 1), spherical Fibonacci by a rotation about the normal. A second
 * form randomises the set once per image: then errors of neighbours are correlated, which is the paper's
 * banding. Banding is measured by the RMSE of means over 4 x 4 pixels, times 4, relative to the RMSE of
 * pixels: 1 if errors are independent, up to 4. */
#include <math.h>
#include <stdio.h>

#include "program/lab/lab.h"

enum { SET_CAPACITY = 6, MOST_REPEATS = 16, BLOCK = 4 };

typedef struct occlusion_set {
    const char *name;
    const char *scramble;
} occlusion_set;

typedef struct occlusion_form {
    const occlusion_set *set;
    size_t samples;
    bool each_pixel; /* randomised per pixel, else once per image */
} occlusion_form;

typedef struct occlusion_study {
    lab_run *run;
    aur_renderer *renderer;
    size_t width, height;
    size_t image_width, image_height; /* of the written images; 0: none */
    double max_distance;
    size_t reference_samples, repeats;
    size_t set_count;
    occlusion_set sets[SET_CAPACITY];
    occlusion_form reference_form;
    aur_image *reference; /* NULL: not rendered yet */
} occlusion_study;

static const char *const columns[] = {"pattern",   "samples",     "randomised", "rmse", "rmse_low",
                                      "rmse_high", "over_random", "banding",    NULL};

static aur_result render(const occlusion_study *study, const occlusion_form *form, size_t width,
                         size_t height, size_t repeat, aur_image **image, aur_error *error) {
    const lab_options *const lab = lab_run_options(study->run);
    char integrator[256];
    snprintf(
        integrator, sizeof integrator,
        "ao:pixel=centre,samples=%zu,pattern=%s,scramble=%s,rotations=%d,pattern_seed=%zu,max_distance=%g",
        form->samples, form->set->name, form->set->scramble, form->each_pixel ? 0 : 1, repeat,
        study->max_distance);
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = integrator,
                                        .samples_per_pixel = 1,
                                        .width = width,
                                        .height = height,
                                        .threads = lab->threads,
                                        .progress = lab->progress,
                                        .warnings = lab->warnings};
    return aur_renderer_render(study->renderer, &options, image, NULL, error);
}

/* Mean square errors of pixels and of means over blocks of them. */
static aur_result compare(const aur_image *reference, const aur_image *image, double *pixels, double *blocks,
                          aur_error *error) {
    aur_image *small_reference = NULL, *small = NULL;
    double value[4];
    aur_result result = aur_image_compare(reference, image, AUR_IMAGE_MSE, value, error);
    *pixels = value[3];
    if (result == AUR_OK)
        result = aur_image_downsample(reference, BLOCK, &small_reference, error);
    if (result == AUR_OK)
        result = aur_image_downsample(image, BLOCK, &small, error);
    if (result == AUR_OK)
        result = aur_image_compare(small_reference, small, AUR_IMAGE_MSE, value, error);
    *blocks = value[3];
    aur_image_destroy(small_reference);
    aur_image_destroy(small);
    return result;
}

/* The view of images with the same number of samples, and the reference. */
static void name_view(const occlusion_form *form, char view[64]) {
    snprintf(view, 64, "%zu samples, randomised for each %s", form->samples,
             form->each_pixel ? "pixel" : "image");
}

static aur_result draw(const occlusion_study *study, const occlusion_form *form, aur_error *error) {
    if (study->image_width == 0)
        return AUR_OK;
    char view[64];
    aur_image *image = NULL;
    name_view(form, view);
    aur_result result = render(study, form, study->image_width, study->image_height, 1, &image, error);
    const lab_image_position position = {.view = view, .name = form->set->name};
    if (result == AUR_OK)
        result = lab_image(study->run, &position, image, error);
    aur_image_destroy(image);
    return result;
}

/* Mean square errors of pixels and of blocks, one per repeat; writes an image. */
static aur_result measure(occlusion_study *study, const occlusion_form *form, double *pixels, double *blocks,
                          aur_error *error) {
    double values[2 * MOST_REPEATS];
    char key[160];
    snprintf(key, sizeof key, "%.80s %zu %d", form->set->name, form->samples, form->each_pixel);
    aur_result result = AUR_OK;
    if (!lab_recall(study->run, key, 2 * study->repeats, values)) {
        if (study->reference == NULL)
            result = render(study, &study->reference_form, study->width, study->height, 0, &study->reference,
                            error);
        for (size_t k = 0; k < study->repeats && result == AUR_OK; ++k) {
            aur_image *image = NULL;
            result = render(study, form, study->width, study->height, 1 + k, &image, error);
            if (result == AUR_OK)
                result = compare(study->reference, image, &values[2 * k], &values[2 * k + 1], error);
            aur_image_destroy(image);
        }
        if (result == AUR_OK)
            result = draw(study, form, error);
        if (result == AUR_OK)
            result = lab_save(study->run, key, 2 * study->repeats, values, error);
    }
    for (size_t k = 0; k < study->repeats && result == AUR_OK; ++k) {
        pixels[k] = values[2 * k];
        blocks[k] = values[2 * k + 1];
    }
    return result;
}

/* The row of means over the repeats; *mse is their mean, `base` that of the first set. */
static aur_result add_row(occlusion_study *study, const occlusion_form *form, const double *base, double *mse,
                          aur_error *error) {
    double pixels[MOST_REPEATS], blocks[MOST_REPEATS], half, block_mean, unused;
    const aur_result result = measure(study, form, pixels, blocks, error);
    if (result != AUR_OK)
        return result;
    lab_mean_interval(study->repeats, pixels, mse, &half);
    lab_mean_interval(study->repeats, blocks, &block_mean, &unused);
    lab_run *const run = study->run;
    lab_text(run, form->set->name);
    lab_number(run, (double)form->samples);
    lab_text(run, form->each_pixel ? "pixel" : "image");
    lab_number(run, sqrt(*mse));
    lab_number(run, sqrt(fmax(0.0, *mse - half)));
    lab_number(run, sqrt(*mse + half));
    lab_number(run, base != NULL ? sqrt(*mse / *base) : 1.0);
    lab_number(run, BLOCK * sqrt(block_mean / *mse));
    return AUR_OK;
}

/* The reference once per view, at the size of the images. */
static aur_result draw_references(const occlusion_study *study, const size_t counts[2], aur_error *error) {
    double drawn;
    if (study->image_width == 0 || lab_recall(study->run, "references", 1, &drawn))
        return AUR_OK;
    const occlusion_form fine = {study->reference_form.set, 1024, true};
    aur_image *rendered = NULL;
    aur_result result = render(study, &fine, study->image_width, study->image_height, 0, &rendered, error);
    for (size_t i = 0; i < 4 && result == AUR_OK; ++i) {
        char view[64];
        name_view(&(occlusion_form){.samples = counts[i / 2], .each_pixel = i % 2 == 0}, view);
        const lab_image_position position = {.view = view, .name = "reference", .reference = true};
        result = lab_image(study->run, &position, rendered, error);
    }
    aur_image_destroy(rendered);
    return result != AUR_OK ? result : lab_save(study->run, "references", 1, (const double[]){1.0}, error);
}

static aur_result study_all(occlusion_study *study, aur_error *error) {
    static const occlusion_set fibonacci = {"spherical-fibonacci", "rotate"};
    static const size_t counts[] = {64, 16};
    study->reference_form = (occlusion_form){&fibonacci, study->reference_samples, true};
    aur_result result = draw_references(study, counts, error);
    for (int each = 1; each >= 0; --each)
        for (size_t n = 0; n < 2; ++n) {
            double base = 0.0, mse = INFINITY, least = INFINITY;
            const char *winner = "";
            for (size_t s = 0; s < study->set_count && result == AUR_OK; ++s) {
                const occlusion_form form = {&study->sets[s], counts[n], each == 1};
                result = lab_forgive(study->run, form.set->name,
                                     add_row(study, &form, s == 0 ? NULL : &base, &mse, error), error);
                if (s == 0)
                    base = mse;
                if (mse < least) {
                    least = mse;
                    winner = form.set->name;
                }
            }
            if (result == AUR_OK)
                lab_note(study->run, "%zu samples, randomised for each %s: least RMSE by %s", counts[n],
                         each == 1 ? "pixel" : "image", winner);
        }
    aur_image_destroy(study->reference);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    occlusion_study study = {.run = run,
                             .width = options->quick ? 32 : 128,
                             .height = options->quick ? 32 : 96,
                             .image_width = options->quick ? 64 : 480,
                             .image_height = options->quick ? 64 : 360,
                             .max_distance = options->quick ? 150.0 : INFINITY,
                             .reference_samples = options->quick ? 4096 : 16384,
                             .repeats = options->quick ? 4 : MOST_REPEATS,
                             .set_count = 5,
                             .sets = {{"random", "shift"},
                                      {"hammersley", "shift"},
                                      {"blue-noise", "shift"},
                                      {"golden-set", "shift"},
                                      {"spherical-fibonacci", "rotate"}}};
    if (options->set != NULL)
        study.sets[study.set_count++] = (occlusion_set){options->set, "rotate"};
    aur_scene *scene = NULL;
    /* The quick form needs no generated mesh. */
    aur_result result = lab_load_scene(
        run, options->quick ? "cornell-box/glossy.xml" : "occlusion/occlusion.xml", 0, NULL, &scene, error);
    if (result == AUR_OK)
        result = aur_renderer_create(scene, &study.renderer, error);
    if (result == AUR_OK)
        result = study_all(&study, error);
    if (result == AUR_OK && options->quick)
        lab_note(run, "the quick form looks 150 mm far in the glossy Cornell box");
    aur_renderer_destroy(study.renderer);
    aur_scene_destroy(scene);
    return result;
}

static const report_plot plots[] = {
    {.name = "rmse",
     .title = "RMSE of ambient occlusion against directions per pixel",
     .x = "samples",
     .y = "rmse",
     .low = "rmse_low",
     .high = "rmse_high",
     .series = "pattern",
     .panel = "randomised",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_schretter_2012_fig5 = {
    .name = "schretter-2012-fig5",
    .reproduces = "Schretter 2012, fig. 5",
    .summary = "ambient occlusion by random, Hammersley, blue noise, golden and spherical Fibonacci sets",
    .columns = columns,
    .plots = plots,
    .seconds = 85,
    .quick_seconds = 0.7,
    .run = run,
    .takes_no_scene = "its scene is that of the figure",
};

/* Close-ups of the indirect light of three scenes by four sets under two maps, with error images, at the
 * paper's numbers of directions (Marques 2013, figs 5 to 7).
 *
 * The mean square errors are over independent randomisations; images show the first one. A close-up is a
 * window of an image of 256 pixels; a sheet has all patterns in a row, their errors below, in one scale. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "gathering.h"

enum { WINDOWS = 2, SIDE = 32, MOST_SEEDS = 3, ZOOM = 2, QUICK_SHRINK = 8 };

typedef struct closeups {
    size_t diffuse, glossy; /* directions */
    double stops;           /* exposure of the images; the paper's overview is 4 times as bright */
    struct window {
        const char *name;
        size_t x, y; /* its upper left corner */
    } windows[WINDOWS];
} closeups;

static const closeups of_scenes[MARQUES_SCENES] = {
    {256, 128, 2.0, {{"block", 96, 136}, {"hare", 148, 164}}},
    {128, 32, 1.0, {{"teapot", 150, 62}, {"cup", 120, 82}}},
    {512, 512, 2.0, {{"bonnet", 184, 78}, {"ground", 104, 118}}},
};

typedef struct study {
    lab_run *run;
    const marques_scene *scene;
    const closeups *of;
    const struct window *window;
    lab_stage stage;
    size_t seeds, reference_directions, pattern_count;
    marques_pattern patterns[MARQUES_PATTERNS];
    marques_gathering form;
    aur_image *references[2], *images[MARQUES_PATTERNS];
    size_t others, better; /* rows; rows in which spherical Fibonacci has the smaller mean error */
} study;

static aur_result put(study *s, const char *name, const aur_image *image, aur_error *error) {
    char view[80];
    snprintf(view, sizeof view, "%s, %s", s->scene->name, s->window->name);
    const lab_image_position position = {view, name, image == s->references[0], s->of->stops};
    return lab_image(s->run, &position, image, error);
}

/* The mean square errors of a pattern; the image of the first randomisation is stored for the sheet. */
static aur_result measure(study *s, size_t index, double *squares, aur_error *error) {
    const marques_pattern *const pattern = &s->patterns[index];
    aur_result result = AUR_OK;
    for (size_t k = 0; k < s->seeds && result == AUR_OK; ++k) {
        marques_gathering what = s->form;
        aur_image *image = NULL;
        what.pattern = pattern;
        what.seed = 1 + k;
        result = marques_gather(s->run, s->stage.renderer, &what, &image, error);
        if (result == AUR_OK)
            squares[k] = lab_mean_product(image, s->references[0], s->references[1]);
        if (k == 0)
            s->images[index] = image;
        else
            aur_image_destroy(image);
    }
    if (result != AUR_OK)
        return result;
    char name[128];
    snprintf(name, sizeof name, "%.80s%s%s", pattern->set, index > 0 ? " " : "",
             index > 0 ? pattern->label : "");
    return put(s, name, s->images[index], error);
}

/* --- the sheet */

/* The linear value that the sRGB curve displays as `shown`. */
static float light_of(float shown) {
    return shown <= 0.04045F ? shown / 12.92F : powf((shown + 0.055F) / 1.055F, 2.4F);
}

/* Copies an image into the sheet at (x, y), its pixels ZOOM times as large. */
static void paste(aur_image *sheet, const aur_image *image, size_t x, size_t y, float scale, bool shown) {
    float *const to = aur_image_data(sheet);
    const float *const from = aur_image_data(image);
    const size_t width = aur_image_width(image), channels = aur_image_channel_count(image);
    for (size_t j = 0; j < ZOOM * aur_image_height(image); ++j)
        for (size_t i = 0; i < ZOOM * width; ++i)
            for (size_t c = 0; c < 3; ++c) {
                const float value = from[(j / ZOOM * width + i / ZOOM) * channels + c];
                to[((y + j) * aur_image_width(sheet) + x + i) * 3 + c] =
                    shown ? light_of(value) : scale * value;
            }
}

static aur_result largest_difference(const study *s, double *largest, aur_error *error) {
    *largest = 0.0;
    for (size_t p = 0; p < s->pattern_count; ++p) {
        double value[4];
        if (s->images[p] == NULL)
            continue;
        const aur_result result =
            aur_image_compare(s->references[0], s->images[p], AUR_IMAGE_RMSE, value, error);
        if (result != AUR_OK)
            return result;
        *largest = fmax(*largest, value[3]);
    }
    return AUR_OK;
}

/* The reference and all patterns in a row, and their errors below; white is four times the largest RMSE. */
static aur_result draw_sheet(const study *s, aur_error *error) {
    const size_t step = ZOOM * aur_image_width(s->references[0]) + 2;
    const float scale = (float)exp2(s->of->stops);
    aur_image *sheet = NULL;
    double largest = 0.0;
    aur_result result = largest_difference(s, &largest, error);
    if (result == AUR_OK)
        result = aur_image_create((s->pattern_count + 1) * step, 2 * step, 3, &sheet, error);
    if (result == AUR_OK)
        paste(sheet, s->references[0], 0, 0, scale, false);
    for (size_t p = 0; p < s->pattern_count && result == AUR_OK; ++p) {
        aur_image *errors = NULL;
        if (s->images[p] == NULL)
            continue;
        result = aur_image_difference(s->references[0], s->images[p], 4.0 * largest, &errors, error);
        if (result == AUR_OK) {
            paste(sheet, s->images[p], (p + 1) * step, 0, scale, false);
            paste(sheet, errors, (p + 1) * step, step, 1.0F, true);
        }
        aur_image_destroy(errors);
    }
    char name[80];
    snprintf(name, sizeof name, "sheet, %s, %s", s->scene->name, s->window->name);
    const lab_image_position position = {.name = name};
    if (result == AUR_OK)
        result = lab_image(s->run, &position, sheet, error);
    aur_image_destroy(sheet);
    return result;
}

/* --- the table */

static void add_row(study *s, const marques_pattern *pattern, const double *squares, const double *base) {
    const lab_interval rmse = lab_root_mean(s->seeds, squares);
    const lab_interval ratio = lab_root_ratio(s->seeds, squares, s->seeds, base);
    char directions[48];
    snprintf(directions, sizeof directions, "%zu+%zu", s->form.glossy, s->form.diffuse);
    lab_row(s->run,
            (const char *const[]){s->scene->name, s->window->name, directions, pattern->set, pattern->label,
                                  NULL},
            6, (const double[]){rmse.value, rmse.low, rmse.high, ratio.value, ratio.low, ratio.high});
    s->others += squares != base;
    s->better += squares != base && ratio.value > 1.0;
}

static aur_result study_window(study *s, aur_error *error) {
    double squares[MARQUES_PATTERNS][MOST_SEEDS];
    char key[80];
    snprintf(key, sizeof key, "%s %s", s->scene->name, s->window->name);
    const size_t count = s->pattern_count * s->seeds;
    double values[MARQUES_PATTERNS * MOST_SEEDS];
    aur_result result = AUR_OK;
    if (!lab_recall(s->run, key, count, values)) {
        result = marques_references(s->run, s->stage.renderer, &s->form, s->reference_directions,
                                    s->references, error);
        if (result == AUR_OK)
            result = put(s, "reference", s->references[0], error);
        for (size_t p = 0; p < s->pattern_count && result == AUR_OK; ++p) {
            result = lab_forgive(s->run, s->patterns[p].set, measure(s, p, squares[p], error), error);
            for (size_t k = 0; k < s->seeds; ++k)
                values[p * s->seeds + k] = s->images[p] != NULL ? squares[p][k] : NAN;
        }
        if (result == AUR_OK)
            result = draw_sheet(s, error);
        if (result == AUR_OK)
            result = lab_save(s->run, key, count, values, error);
    }
    for (size_t p = 0; p < s->pattern_count && result == AUR_OK; ++p)
        if (!isnan(values[p * s->seeds]))
            add_row(s, &s->patterns[p], &values[p * s->seeds], values);
    for (size_t i = 0; i < MARQUES_PATTERNS; ++i) {
        aur_image_destroy(s->images[i]);
        s->images[i] = NULL;
    }
    for (size_t i = 0; i < 2; ++i) {
        aur_image_destroy(s->references[i]);
        s->references[i] = NULL;
    }
    return result;
}

/* The whole image, with few directions: shows where the windows are. */
static aur_result draw_whole(const study *s, aur_error *error) {
    double drawn;
    char key[80];
    snprintf(key, sizeof key, "whole %s", s->scene->name);
    if (lab_recall(s->run, key, 1, &drawn))
        return AUR_OK;
    marques_gathering what = s->form;
    aur_image *image = NULL;
    memset(what.crop, 0, sizeof what.crop);
    what.pattern = &s->patterns[0];
    what.diffuse = what.glossy = 32;
    const lab_image_position position = {.name = s->scene->name, .exposure = s->of->stops};
    aur_result result = marques_gather(s->run, s->stage.renderer, &what, &image, error);
    if (result == AUR_OK)
        result = lab_image(s->run, &position, image, error);
    aur_image_destroy(image);
    return result != AUR_OK ? result : lab_save(s->run, key, 1, (const double[]){1.0}, error);
}

static aur_result study_scene(study *s, size_t shrink, aur_error *error) {
    const size_t before = s->others, good = s->better;
    const size_t side = SIDE / shrink;
    s->form.diffuse = s->of->diffuse / shrink;
    s->form.glossy = s->of->glossy / shrink;
    s->form.width = s->scene->width / shrink;
    s->form.height = s->scene->height / shrink;
    aur_result result = draw_whole(s, error);
    for (size_t w = 0; w < WINDOWS && result == AUR_OK; ++w) {
        s->window = &s->of->windows[w];
        const size_t x = s->window->x / shrink, y = s->window->y / shrink;
        memcpy(s->form.crop, (const size_t[4]){x, x + side, y, y + side}, sizeof s->form.crop);
        result = study_window(s, error);
    }
    if (result == AUR_OK)
        lab_claim(s->run, s->better - good == s->others - before,
                  "%s: spherical Fibonacci has the least error: less than in %zu of %zu", s->scene->name,
                  s->better - good, s->others - before);
    return result;
}

static const char *const columns[] = {"scene", "window", "directions", "pattern",   "map",        "rmse",
                                      "low",   "high",   "ratio",      "ratio_low", "ratio_high", NULL};

static aur_result run(lab_run *run, aur_error *error) {
    const bool quick = lab_run_options(run)->quick;
    study s = {.run = run,
               .seeds = quick ? 2 : MOST_SEEDS,
               .reference_directions = quick ? 1024 : 2048,
               .form = {.light = "direct=none", .photons = quick ? 20000 : 300000}};
    s.pattern_count = marques_patterns(run, s.patterns);
    aur_result result = AUR_OK;
    for (size_t i = 0; i < MARQUES_SCENES && result == AUR_OK; ++i) {
        s.scene = &marques_scenes[i];
        s.of = &of_scenes[i];
        const char *const file = quick ? s.scene->quick_file : s.scene->file;
        if (file == NULL || !lab_row_requested(run, s.scene->name))
            continue;
        result = lab_stage_open(run, file, 0, NULL, &s.stage, error);
        if (s.stage.renderer != NULL && result == AUR_OK)
            result = study_scene(&s, quick ? QUICK_SHRINK / 2 : 1, error);
        lab_stage_close(&s.stage);
    }
    if (result == AUR_OK)
        lab_note(run, "sheets: the reference and the patterns in the table's order, errors below; directions "
                      "are glossy+diffuse");
    return result;
}

const lab_experiment lab_marques_2013_closeups = {
    .name = "marques-2013-closeups",
    .reproduces = "Marques 2013, figs 5-7",
    .summary = "close-ups and error images of four sets under two maps at the paper's directions",
    .rows = "scene",
    .columns = columns,
    .seconds = 80,
    .quick_seconds = 1,
    .run = run,
    .takes_no_scene = "its close-ups are of the paper's scenes",
};

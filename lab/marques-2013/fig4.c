/* RMSE of the glossy and the diffuse indirect light against the number of directions, with slopes: four sets
 * under two maps, three scenes (Marques 2013, fig. 4).
 *
 * Intervals are over independent randomisations; those of slopes are from the scatter about the line. With
 * four randomisations a slope has an uncertainty of some hundredths, while the paper's claims distinguish
 * -3/4 from -1/2. The legend of the figure is in an image, so only statements in the text can be checked. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gathering.h"

enum { SIZES = 5, QUICK_SIZES = 3, SMALLEST = 16, MOST_SEEDS = 4, COMPONENTS = 2 };

static const char *const components[COMPONENTS] = {"glossy", "diffuse"};
static const double near = 0.1; /* interpretation of "close to" a slope */

typedef struct line {
    double directions[SIZES];
    double squares[SIZES][MOST_SEEDS]; /* mean square errors */
    lab_interval slope;
} line;

typedef struct study {
    lab_run *run;
    report_table *slopes;
    const marques_scene *scene;
    const char *component;
    lab_stage stage;
    size_t size_count, smallest, seeds, reference_directions;
    marques_gathering form;
    aur_image *references[2]; /* NULL: not rendered yet */
    line base;                /* of spherical Fibonacci */
    size_t others, beaten;    /* lines times counts; those in which a competing set is better beyond its
                               * interval */
    size_t lines, steeper;    /* lines; those with a steeper slope than spherical Fibonacci's beyond intervals
                               */
} study;

static aur_result measure(study *s, const marques_pattern *pattern, size_t directions, double *squares,
                          aur_error *error) {
    char key[240];
    snprintf(key, sizeof key, "%s %s %.80s %s %zu", s->scene->name, s->component, pattern->set,
             pattern->label, directions);
    if (lab_recall(s->run, key, s->seeds, squares))
        return AUR_OK;
    aur_result result = AUR_OK;
    if (s->references[0] == NULL)
        result = marques_references(s->run, s->stage.renderer, &s->form, s->reference_directions,
                                    s->references, error);
    for (size_t k = 0; k < s->seeds && result == AUR_OK; ++k) {
        marques_gathering what = s->form;
        aur_image *image = NULL;
        what.pattern = pattern;
        what.diffuse = what.glossy = directions;
        what.seed = 1 + k;
        result = marques_gather(s->run, s->stage.renderer, &what, &image, error);
        if (result == AUR_OK)
            squares[k] = lab_mean_product(image, s->references[0], s->references[1]);
        aur_image_destroy(image);
    }
    return result != AUR_OK ? result : lab_save(s->run, key, s->seeds, squares, error);
}

static void compare(study *s, const line *other) {
    for (size_t n = 0; n < s->size_count; ++n) {
        ++s->others;
        s->beaten += lab_root_ratio(s->seeds, other->squares[n], s->seeds, s->base.squares[n]).high < 1.0;
    }
    ++s->lines;
    s->steeper += other->slope.high < s->base.slope.low;
}

static aur_result add_line(study *s, const marques_pattern *pattern, aur_error *error) {
    line l;
    double means[SIZES];
    const bool is_base = strcmp(pattern->set, "spherical-fibonacci") == 0;
    for (size_t n = 0; n < s->size_count; ++n) {
        const size_t directions = s->smallest << n;
        const aur_result result = measure(s, pattern, directions, l.squares[n], error);
        if (result != AUR_OK)
            return result;
        if (is_base)
            memcpy(s->base.squares[n], l.squares[n], sizeof l.squares[n]);
        const lab_interval rmse = lab_root_mean(s->seeds, l.squares[n]);
        const lab_interval ratio = lab_root_ratio(s->seeds, is_base ? s->base.squares[n] : l.squares[n],
                                                  s->seeds, s->base.squares[n]);
        l.directions[n] = (double)directions;
        means[n] = rmse.value;
        lab_row(s->run,
                (const char *const[]){s->scene->name, s->component, pattern->set, pattern->label, NULL}, 7,
                (const double[]){l.directions[n], rmse.value, rmse.low, rmse.high, ratio.value, ratio.low,
                                 ratio.high});
    }
    l.slope = lab_slope(s->size_count, l.directions, means);
    lab_table_row(s->slopes,
                  (const char *const[]){s->scene->name, s->component, pattern->set, pattern->label, NULL}, 3,
                  (const double[]){l.slope.value, l.slope.low, l.slope.high});
    if (is_base)
        s->base = l;
    else
        compare(s, &l);
    return AUR_OK;
}

/* The paper's statements on slopes of single panels of the figure. */
static void judge_slope(const study *s) {
    const bool box = strcmp(s->scene->name, "cornell-box") == 0, glossy = s->component == components[0];
    const bool cars = strcmp(s->scene->name, "cars") == 0, room = strcmp(s->scene->name, "room") == 0;
    const lab_interval slope = s->base.slope;
    const double expected = box || (room && glossy) ? -0.75 : cars && glossy ? -0.5 : NAN;
    if (!isnan(expected))
        lab_claim(s->run, fabs(slope.value - expected) <= near,
                  "%s, %s: the slope of spherical Fibonacci is close to %g: %.3f [%.3f, %.3f], %g allowed",
                  s->scene->name, s->component, expected, slope.value, slope.low, slope.high, near);
}

static aur_result study_component(study *s, aur_error *error) {
    marques_pattern patterns[MARQUES_PATTERNS];
    const size_t count = marques_patterns(s->run, patterns);
    char light[64];
    snprintf(light, sizeof light, "direct=none,component=%s", s->component);
    s->form.light = light;
    aur_result result = AUR_OK;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        result = lab_forgive(s->run, patterns[i].set, add_line(s, &patterns[i], error), error);
    if (result == AUR_OK)
        judge_slope(s);
    for (size_t i = 0; i < 2; ++i) {
        aur_image_destroy(s->references[i]);
        s->references[i] = NULL;
    }
    return result;
}

/* One of two equal patterns is below the other's interval with probability 1/40: the expected number among
 * `count`, plus two standard deviations. */
static size_t by_probability(size_t count) {
    const double mean = (double)count / 40.0;
    return (size_t)(mean + 2.0 * sqrt(mean));
}

static const char *const columns[] = {"scene",    "component", "pattern", "map",       "directions", "rmse",
                                      "rmse_low", "rmse_high", "ratio",   "ratio_low", "ratio_high", NULL};

static aur_result run(lab_run *run, aur_error *error) {
    static const char *const of_slopes[] = {"scene", "component", "pattern", "map",
                                            "slope", "low",       "high",    NULL};
    const bool quick = lab_run_options(run)->quick;
    study s = {.run = run,
               .slopes = lab_table(run, "slopes", of_slopes),
               .size_count = quick ? QUICK_SIZES : SIZES,
               .smallest = SMALLEST,
               .seeds = quick ? 2 : MOST_SEEDS,
               .reference_directions = quick ? 1024 : 2048};
    aur_result result = AUR_OK;
    for (size_t i = 0; i < MARQUES_SCENES && result == AUR_OK; ++i) {
        const marques_scene *const scene = s.scene = &marques_scenes[i];
        const char *const file = quick ? scene->quick_file : scene->file;
        const size_t shrink = quick ? 16 : 8;
        s.form = (marques_gathering){.photons = quick ? 20000 : 300000,
                                     .width = scene->width / shrink,
                                     .height = scene->height / shrink};
        if (file == NULL)
            continue;
        result = lab_stage_open(run, file, 0, NULL, &s.stage, error);
        for (size_t c = 0; c < COMPONENTS && s.stage.renderer != NULL && result == AUR_OK; ++c) {
            s.component = components[c];
            result = study_component(&s, error);
        }
        lab_stage_close(&s.stage);
    }
    if (result != AUR_OK)
        return result;
    lab_claim(
        run, s.beaten <= by_probability(s.others),
        "spherical Fibonacci is never outperformed: another set is better beyond its interval in %zu of "
        "%zu, up to %zu expected by chance",
        s.beaten, s.others, by_probability(s.others));
    lab_claim(run, s.steeper <= by_probability(s.lines),
              "its slope is as good as or better than the others': %zu of %zu fall faster beyond the "
              "intervals, up to %zu expected by chance",
              s.steeper, s.lines, by_probability(s.lines));
    return AUR_OK;
}

static const report_plot plots[] = {
    {.name = "rmse",
     .title = "RMSE of the indirect light against directions per pixel",
     .x = "directions",
     .y = "rmse",
     .low = "rmse_low",
     .high = "rmse_high",
     .series = "pattern,map",
     .panel = "scene,component",
     .log_x = true,
     .log_y = true},
    {.name = "ratio",
     .title = "RMSE over that of spherical Fibonacci points",
     .x = "directions",
     .y = "ratio",
     .low = "ratio_low",
     .high = "ratio_high",
     .series = "pattern,map",
     .panel = "scene,component",
     .log_x = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2013_fig4 = {
    .name = "marques-2013-fig4",
    .reproduces = "Marques 2013, fig. 4",
    .summary = "RMSE of gathered light against directions with slopes, three scenes, two components",
    .columns = columns,
    .plots = plots,
    .seconds = 27,
    .quick_seconds = 0.4,
    .run = run,
    .takes_no_scene = "it compares the paper's scenes",
};

/* The glossy Cornell box by adaptively extended patterns, 40, 160, 640 directions for the diffuse lobe and
 * 20, 80, 320 for the glossy one (Marques 2019, fig. 12).
 *
 * The paper states neither its threshold nor an error. So each criterion's threshold is adjusted until a
 * gather takes the paper's mean number of directions; the fractions of pixels per level are then compared
 * with the published ones. Nor does the text define the criterion, "color entropy" above a threshold. So
 * three interpretations are compared, and variance: entropy of each channel, the same weighted by brightness,
 * and that of a histogram (gathering/levels.h). The benefit of a criterion is measured by the directions that
 * patterns of constant size need for the same error. The saving relative to the last level everywhere, the
 * paper's comparison, is given with the ratio of errors. */
#include "adaptive.h"

#include <math.h>
#include <stdio.h>

static const char *const columns[] = {"lobe", "criterion", "what",      "measured",
                                      "low",  "high",      "published", NULL};

const adaptive_lobe adaptive_lobes[2] = {
    {"diffuse", 40, {128580.0, 326726.0, 63094.0}},
    {"glossy", 20, {130863.0, 206817.0, 180720.0}},
};

/* Mean number of directions per gather, as published. */
static double published_mean(const adaptive_lobe *lobe) {
    double directions = 0.0, point_count = 0.0, size = (double)lobe->first;
    for (size_t l = 0; l < 3; ++l, size *= 4.0) {
        directions += size * lobe->published[l];
        point_count += lobe->published[l];
    }
    return directions / point_count;
}

/* The threshold at which a gather takes `target` directions on average; the number decreases with the
 * threshold. */
static aur_result find_threshold(adaptive_study *study, adaptive_way *way, double target, aur_error *error) {
    const size_t halvings = study->quick ? 6 : 11;
    char key[120];
    double low = log(1e-5), high = log(3.0);
    snprintf(key, sizeof key, "threshold %s %s", study->lobe->name, way->criterion);
    if (lab_recall(study->run, key, 1, &way->threshold))
        return AUR_OK;
    for (size_t i = 0; i < halvings; ++i) {
        adaptive_counts counts;
        aur_image *image;
        way->threshold = exp(0.5 * (low + high));
        const aur_result result = adaptive_render(study, way, 500, false, &image, error);
        if (result != AUR_OK)
            return result;
        adaptive_count(study, way, image, &counts);
        aur_image_destroy(image);
        *(counts.mean > target ? &low : &high) = log(way->threshold);
    }
    way->threshold = exp(0.5 * (low + high));
    return lab_save(study->run, key, 1, &way->threshold, error);
}

static void add_row(const adaptive_study *study, const adaptive_way *way, const char *what,
                    const double *values, double published) {
    double mean, half;
    lab_mean_interval(study->seeds, values, &mean, &half);
    lab_row(study->run, (const char *const[]){study->lobe->name, way->criterion, what, NULL}, 4,
            (const double[]){mean, mean - half, mean + half, published});
}

/* The row of a method in the table of methods; *ratio is its number of directions relative to constant
 * patterns with the same error. */
static void add_way(const adaptive_study *study, const adaptive_way *way, report_table *table,
                    const adaptive_found *found, lab_interval *ratio) {
    double mean, half, directions, unused;
    lab_mean_interval(study->seeds, found->log_rays, &mean, &half);
    *ratio = (lab_interval){exp(mean), exp(mean - half), exp(mean + half)};
    lab_mean_interval(study->seeds, found->mean, &directions, &unused);
    const lab_interval rmse = lab_root_mean(study->seeds, found->mse);
    const double uniform = 16.0 * (double)study->lobe->first;
    lab_table_row(
        table, (const char *const[]){study->lobe->name, adaptive_pattern(way), way->criterion, NULL}, 12,
        (const double[]){(double)way->factor, (double)way->levels, way->threshold, directions, rmse.value,
                         rmse.low, rmse.high, ratio->value, ratio->low, ratio->high,
                         1.0 - directions / uniform, rmse.value / sqrt(study->fixed[ADAPTIVE_FIXED - 1])});
}

/* A criterion at the paper's mean number of directions. */
static aur_result study_published(adaptive_study *study, const char *criterion, report_table *table,
                                  aur_error *error) {
    static const char *const what[] = {"share of level 1", "share of level 2", "share of level 3"};
    const adaptive_lobe *const lobe = study->lobe;
    adaptive_way way = {.criterion = criterion, .factor = 4, .levels = 2};
    adaptive_found found;
    lab_interval ratio;
    aur_result result = find_threshold(study, &way, published_mean(lobe), error);
    if (result == AUR_OK)
        result = adaptive_measure(study, &way, &found, error);
    if (result != AUR_OK)
        return result;
    const double point_count = lobe->published[0] + lobe->published[1] + lobe->published[2];
    lab_note(study->run, "%s, %s: threshold %.4g is fitted to the published %.1f directions per gather",
             lobe->name, criterion, way.threshold, published_mean(lobe));
    add_row(study, &way, "directions per gather", found.mean, NAN);
    for (size_t l = 0; l < 3; ++l)
        add_row(study, &way, what[l], found.shares[l], lobe->published[l] / point_count);
    add_way(study, &way, table, &found, &ratio);
    lab_claim(study->run, ratio.high < 1.0,
              "fig. 12, %s, %s: saves directions at equal error (takes %.2f [%.2f, %.2f] times those of "
              "patterns of one "
              "size, threshold %.3g)",
              lobe->name, criterion, ratio.value, ratio.low, ratio.high, way.threshold);
    return adaptive_draw(study, &way, error);
}

/* Effect of a first level without any light: its colours do not differ, so no threshold is low enough. */
static aur_result study_darkness(adaptive_study *study, aur_error *error) {
    const adaptive_way way = {.criterion = "entropy", .factor = 4, .levels = 2, .threshold = 0.0};
    adaptive_counts counts;
    char key[64];
    snprintf(key, sizeof key, "darkness %s", study->lobe->name);
    if (!lab_recall(study->run, key, 1, &counts.shares[0])) {
        aur_image *image;
        aur_result result = adaptive_render(study, &way, 500, false, &image, error);
        if (result == AUR_OK) {
            adaptive_count(study, &way, image, &counts);
            aur_image_destroy(image);
            result = lab_save(study->run, key, 1, &counts.shares[0], error);
        }
        if (result != AUR_OK)
            return result;
    }
    lab_note(study->run,
             "%s, entropy with threshold 0: %.1f %% of the gathers end at level 1, where it saw no light",
             study->lobe->name, 100.0 * counts.shares[0]);
    return AUR_OK;
}

static aur_result study_lobe(adaptive_study *study, report_table *table, aur_error *error) {
    const char *const given_set = lab_run_options(study->run)->set;
    const adaptive_way others[] = {
        {"variance", 4, 2, 0.03, "sobol"}, {"variance", 4, 2, 0.03, given_set},
        {"entropy", 4, 2, 0.1, NULL},      {"entropy", 4, 2, 0.2, NULL},
        {"entropy", 4, 2, 0.3, NULL},      {"entropy", 2, 4, 0.3, NULL},
        {"variance", 4, 2, 0.02, NULL},    {"variance", 4, 2, 0.03, NULL},
        {"variance", 4, 2, 0.05, NULL},    {"variance", 2, 4, 0.02, NULL},
        {"variance", 2, 4, 0.02, "sobol"}, {"variance", 4, 2, 0.03, "faure:base=3"},
        {"entropy", 4, 2, 0.2, "sobol"},   {"entropy", 4, 2, 0.2, "faure:base=3"},
    };
    static const char *const criteria[] = {"entropy", "entropy-brightness", "entropy-histogram", "variance"};
    aur_result result = AUR_OK;
    for (size_t i = 0; i < sizeof criteria / sizeof criteria[0] && result == AUR_OK; ++i)
        result = study_published(study, criteria[i], table, error);
    for (size_t i = 0; i < (study->quick ? 2 : sizeof others / sizeof others[0]) && result == AUR_OK; ++i) {
        adaptive_found found;
        lab_interval ratio;
        if (i == 1 && given_set == NULL)
            continue;
        result = adaptive_measure(study, &others[i], &found, error);
        if (result == AUR_OK)
            add_way(study, &others[i], table, &found, &ratio);
        result = i == 1 ? lab_forgive(study->run, given_set, result, error) : result;
    }
    if (result == AUR_OK)
        result = study_darkness(study, error);
    adaptive_release(study);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    static const char *const of_ways[] = {"lobe",
                                          "set",
                                          "criterion",
                                          "factor",
                                          "levels",
                                          "threshold",
                                          "directions",
                                          "rmse",
                                          "rmse_low",
                                          "rmse_high",
                                          "over_fixed",
                                          "over_fixed_low",
                                          "over_fixed_high",
                                          "saved_of_last_level",
                                          "rmse_over_last_level",
                                          NULL};
    const bool quick = lab_run_options(run)->quick;
    adaptive_study study = {.run = run,
                            .quick = quick,
                            .side = quick ? 16 : 48,
                            .image_side = quick ? 0 : 128,
                            .photons = quick ? 20000 : 500000,
                            .references = quick ? 640 : 2560,
                            .seeds = quick ? 2 : 4};
    report_table *const table = lab_table(run, "ways", of_ways);
    aur_result result = lab_stage_open(run, quick ? "cornell-box/glossy.xml" : "cornell-box/figure.xml", 0,
                                       NULL, &study.stage, error);
    for (size_t i = 0; i < 2 && result == AUR_OK && study.stage.renderer != NULL; ++i) {
        study.lobe = &adaptive_lobes[i];
        result = study_lobe(&study, table, error);
    }
    adaptive_release(&study);
    lab_stage_close(&study.stage);
    return result;
}

static const report_plot plots[] = {
    {.name = "ways",
     .title = "RMSE against directions per gather",
     .table = "ways",
     .x = "directions",
     .y = "rmse",
     .low = "rmse_low",
     .high = "rmse_high",
     .series = "set,criterion,factor",
     .panel = "lobe",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2019_adaptive = {
    .name = "marques-2019-adaptive",
    .reproduces = "Marques 2019, fig. 12",
    .summary =
        "adaptive gathering in the Cornell box: gathers of each level, and whether it saves directions",
    .columns = columns,
    .measured = "measured",
    .low = "low",
    .high = "high",
    .published = "published",
    .factor = LAB_RATIO_FACTOR,
    .plots = plots,
    .seconds = 53,
    .quick_seconds = 1,
    .run = run,
    .parameters = lab_scene_parameters,
};

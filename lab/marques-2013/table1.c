/* Sobol, BNOT and Larcher-Pillichshammer points against spherical Fibonacci at 512 directions, over three
 * scenes, two components of the indirect light and two maps of the square (Marques 2013, table 1).
 *
 * The mean square error of an image x is the mean of (x - a)(x - b). a and b are two independent references
 * by the same estimator with very many directions of different sets, on the same photon map and primary hits.
 * So the references' errors cancel and favour no set. Intervals are over independent randomisations of the
 * patterns. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "program/lab/lab.h"

enum { DIRECTIONS = 512, MORE_DIRECTIONS = 768, SCENES = 3, OTHERS = 3, BATCH = 8, MOST_SCRAMBLES = 96 };

/* Relative half widths of mean square errors: base and other set together give +- 1 % for a ratio of RMSEs.
 */
static const double base_half = 0.010, other_half = 0.017, slope_half = 0.04;

typedef struct table_scene {
    const char *name;
    const char *file, *quick_file; /* the latter needs no generated meshes; NULL: omitted in the quick form */
    size_t width, height;
    double published[2][2][OTHERS][2]; /* glossy, diffuse; lambert, concentric; set: percent of RMSE above
                                        * spherical Fibonacci's, rays needed */
} table_scene;

static const table_scene scenes[SCENES] = {
    {"cornell-box",
     "cornell-box/figure.xml",
     "cornell-box/glossy.xml",
     64,
     64,
     {{{{19.2, 658}, {15.2, 610}, {3.4, 544}}, {{18.1, 667}, {7.8, 601}, {3.0, 541}}},
      {{{24.9, 762}, {25.9, 785}, {8.7, 603}}, {{24.2, 760}, {7.4, 605}, {10.9, 614}}}}},
    {"room",
     "room/room.xml",
     NULL,
     78,
     52,
     {{{{38.7, 799}, {20.9, 665}, {8.5, 557}}, {{30.0, 718}, {36.6, 763}, {24.6, 665}}},
      {{{14.6, 661}, {9.4, 601}, {4.1, 555}}, {{14.8, 662}, {4.8, 569}, {4.5, 558}}}}},
    {"cars",
     "parade/parade.xml",
     NULL,
     78,
     52,
     {{{{2.2, 528}, {2.5, 526}, {0.6, 514}}, {{2.1, 531}, {1.2, 520}, {1.1, 518}}},
      {{{14.7, 634}, {7.3, 569}, {3.5, 535}}, {{12.2, 607}, {6.4, 559}, {4.4, 544}}}}}};

static const char *const others[OTHERS] = {"sobol", "bnot", "larcher-pillichshammer"};
static const char *const components[2] = {"glossy", "diffuse"};
static const char *const maps[2] = {"lambert", "concentric"};
static const char *const columns[] = {
    "scene",          "component",       "map", "pattern", "rmse", "ratio", "ratio_low", "ratio_high", "rays",
    "published_rays", "published_ratio", NULL};

typedef struct table_study {
    lab_run *run;
    const table_scene *scene;
    lab_stage stage;
    bool quick;
    size_t directions, more_directions; /* numbers at which the RMSE is compared, and for its slope */
    size_t reference_directions, photons;
    const char *component;
    aur_image *references[2];
    size_t rows, above, not_below; /* rows; rows whose interval is above 1, and rows whose value is not */
} table_study;

static aur_result render(const table_study *study, const char *set, const char *map, size_t directions,
                         size_t scramble, aur_image **image, aur_error *error) {
    char integrator[320];
    snprintf(
        integrator, sizeof integrator,
        "finalgather-lab:component=%s,direct=none,pixel=centre,density=same,rotations=0,edges=0,short_rays="
        "0,photons=%zu,"
        "photons_per_texel=64,"
        "pattern=%s,map=%s,diffuse_samples=%zu,glossy_samples=%zu,pattern_seed=%zu",
        study->component, study->photons, set, map, directions, directions, scramble);
    const lab_rendering how = {.renderer = study->stage.renderer,
                               .integrator = integrator,
                               .width = study->quick ? 20 : study->scene->width,
                               .height = study->quick ? 20 : study->scene->height};
    return lab_render(study->run, &how, image, error);
}

typedef struct table_cell {
    double mean, relative_half; /* of the mean square error */
} table_cell;

static aur_result need_references(table_study *study, aur_error *error) {
    if (study->references[0] != NULL)
        return AUR_OK;
    const aur_result result = render(study, "spherical-fibonacci", "lambert", study->reference_directions,
                                     1000, &study->references[0], error);
    return result != AUR_OK ? result
                            : render(study, "sobol", "concentric", study->reference_directions, 2000,
                                     &study->references[1], error);
}

/* The mean square error over as many independent randomisations as a narrow interval requires. */
static aur_result measure(table_study *study, const char *set, const char *map, size_t directions,
                          double target_half, table_cell *cell, aur_error *error) {
    double mse[MOST_SCRAMBLES], half, values[2];
    char key[200];
    snprintf(key, sizeof key, "%s %s %.80s %s %zu", study->scene->name, study->component, set, map,
             directions);
    if (lab_recall(study->run, key, 2, values)) {
        *cell = (table_cell){values[0], values[1]};
        return AUR_OK;
    }
    const size_t batch = study->quick ? BATCH / 2 : BATCH;
    const size_t most = study->quick ? batch : MOST_SCRAMBLES;
    aur_result result = need_references(study, error);
    for (size_t k = 0; k < most && result == AUR_OK; ++k) {
        aur_image *image = NULL;
        result = render(study, set, map, directions, 1 + k, &image, error);
        if (result != AUR_OK)
            return result;
        mse[k] = lab_mean_product(image, study->references[0], study->references[1]);
        aur_image_destroy(image);
        if ((k + 1) % batch != 0)
            continue;
        lab_mean_interval(k + 1, mse, &cell->mean, &half);
        cell->relative_half = half / cell->mean;
        if (cell->relative_half <= target_half)
            break;
    }
    if (result != AUR_OK)
        return result;
    return lab_save(study->run, key, 2, (const double[2]){cell->mean, cell->relative_half}, error);
}

static double root(double value) {
    return sqrt(fmax(0.0, value));
}

/* Directions that the other set needs for the base's error, by its slope between two counts. */
static double rays_needed(const table_study *study, double at_directions, double at_more, double base) {
    const double slope =
        log(at_more / at_directions) / log((double)study->more_directions / (double)study->directions);
    return (double)study->directions * pow(base / at_directions, 1.0 / slope);
}

static const char *candidate_at(const table_study *study, size_t other) {
    return other < OTHERS ? others[other] : lab_run_options(study->run)->set;
}

/* BNOT takes too long to generate for the quick form. */
static bool included(const table_study *study, size_t component, size_t map, size_t other) {
    char name[160];
    snprintf(name, sizeof name, "%s/%s/%s/%.80s", study->scene->name, components[component], maps[map],
             candidate_at(study, other));
    return lab_row_requested(study->run, name) && !(study->quick && other == 1);
}

static bool any_included(const table_study *study, size_t component, size_t count) {
    for (size_t k = 0; k < 2 * count; ++k)
        if (included(study, component, k / count, k % count))
            return true;
    return false;
}

static aur_result add_other(table_study *study, size_t component, size_t map, size_t other, table_cell base,
                            aur_error *error) {
    const char *const set = candidate_at(study, other);
    table_cell cell, more;
    aur_result result = measure(study, set, maps[map], study->directions, other_half, &cell, error);
    if (result == AUR_OK)
        result = measure(study, set, maps[map], study->more_directions, slope_half, &more, error);
    if (result != AUR_OK)
        return result;
    const double half = hypot(cell.relative_half, base.relative_half), ratio = cell.mean / base.mean;
    const double *const published =
        other < OTHERS ? study->scene->published[component][map][other] : (const double[]){NAN, NAN};
    lab_row(study->run, (const char *const[]){study->scene->name, study->component, maps[map], set, NULL}, 7,
            (const double[]){root(cell.mean), root(ratio), root(ratio * (1.0 - half)),
                             root(ratio * (1.0 + half)), rays_needed(study, cell.mean, more.mean, base.mean),
                             published[1], 1.0 + 0.01 * published[0]});
    ++study->rows;
    study->above += ratio * (1.0 - half) > 1.0;
    study->not_below += ratio * (1.0 + half) >= 1.0;
    return AUR_OK;
}

static aur_result study_component(table_study *study, size_t component, aur_error *error) {
    const size_t count = lab_run_options(study->run)->set != NULL ? OTHERS + 1 : OTHERS;
    if (!any_included(study, component, count))
        return AUR_OK;
    study->component = components[component];
    table_cell base;
    aur_result result =
        measure(study, "spherical-fibonacci", "lambert", study->directions, base_half, &base, error);
    if (result == AUR_OK)
        for (size_t map = 0; map < 2 && result == AUR_OK; ++map)
            for (size_t other = 0; other < count && result == AUR_OK; ++other)
                if (included(study, component, map, other))
                    result = lab_forgive(study->run, candidate_at(study, other),
                                         add_other(study, component, map, other, base, error), error);
    for (size_t i = 0; i < 2; ++i) {
        aur_image_destroy(study->references[i]);
        study->references[i] = NULL;
    }
    return result;
}

static aur_result study_scene(table_study *study, aur_error *error) {
    const char *const file = study->quick ? study->scene->quick_file : study->scene->file;
    if (file == NULL)
        return AUR_OK;
    aur_result result = lab_stage_open(study->run, file, 0, NULL, &study->stage, error);
    for (size_t component = 0; component < 2 && study->stage.renderer != NULL && result == AUR_OK;
         ++component)
        result = study_component(study, component, error);
    lab_stage_close(&study->stage);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    table_study study = {.run = run,
                         .quick = options->quick,
                         .directions = options->quick ? 64 : DIRECTIONS,
                         .more_directions = options->quick ? 96 : MORE_DIRECTIONS,
                         .reference_directions = options->quick ? 2048 : 16384,
                         .photons = options->quick ? 20000 : 500000};
    aur_result result = AUR_OK;
    for (size_t i = 0; i < SCENES && result == AUR_OK; ++i) {
        study.scene = &scenes[i];
        result = study_scene(&study, error);
    }
    if (result == AUR_OK)
        lab_claim(run, study.rows == study.not_below,
                  "spherical Fibonacci is never outperformed: of %zu rows better beyond the interval in %zu, "
                  "worse beyond it in %zu",
                  study.rows, study.above, study.rows - study.not_below);
    return result;
}

static const report_plot plots[] = {
    {.name = "ratio",
     .title = "RMSE over that of spherical Fibonacci points",
     .x = "published_ratio",
     .y = "ratio",
     .low = "ratio_low",
     .high = "ratio_high",
     .series = "pattern",
     .panel = "component",
     .points = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2013_table1 = {
    .name = "marques-2013-table1",
    .reproduces = "Marques 2013, table 1",
    .summary = "RMSE and rays needed of four patterns at 512 directions, three scenes, two maps",
    .rows = "scene/component/map/pattern",
    .columns = columns,
    .measured = "ratio",
    .low = "ratio_low",
    .high = "ratio_high",
    .published = "published_ratio",
    .factor = LAB_RATIO_FACTOR,
    .plots = plots,
    .seconds = 1700,
    .quick_seconds = 1,
    .run = run,
    .takes_no_scene = "its rows are the paper's scenes",
};

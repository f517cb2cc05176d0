/* Weights in rendered images: the glossy Cornell box by final gathering with 40 + 20 directions per pixel, a
 * figure and a sphere under the sky with 50 + 25 and 64 + 32 (Marques 2018, table 1 and figs 1, 6 and 9).
 *
 * The quality of a weighting method is the RMSE of its images against the same estimator with very many
 * directions, on the same photon map and the same primary hits, over the pixels whose surface has both a
 * diffuse and a glossy lobe: elsewhere the methods hardly differ. Intervals are over independent scramblings
 * of the patterns.
 *
 * Nine values are published: six of table 1 and three of fig. 1. Fig. 1's light is a probe without a sun, so
 * its values are compared with the studio, not with sun and sky. Published percentages are compared as
 * ratios. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "images.h"

enum { MOST_SCRAMBLES = 16, MOST_SETS = 4 };

typedef enum way { OSWA, PUBLISHED, MIS, OSW, EQUAL, DENSE, WAYS } way;

static const struct {
    const char *name, *keys;
} ways[WAYS] = {
    {"OSWA", "weights=oswa,density=same"}, {"OSWA as published", "weights=oswa-solve,density=same"},
    {"MIS", "weights=mis,density=same"},   {"OSW", "weights=osw,density=same,clip=false"},
    {"equal", "weights=equal,clip=false"}, {"OSWA at optimal density", "weights=oswa,density=optimal"}};

/* published RMSE relative to that of OSWA; 0: none */
typedef struct published {
    const char *set;
    double ratio[WAYS];
} published;

static const published table1[] = {{"random", {[MIS] = 1.670, [OSW] = 1.470, [EQUAL] = 1.849}},
                                   {"sobol", {[MIS] = 1.154, [OSW] = 1.431, [EQUAL] = 1.579}},
                                   {NULL, {0}}};
static const published figure1[] = {{"sobol", {[MIS] = 1.075, [OSW] = 1.086, [EQUAL] = 1.186}}, {NULL, {0}}};
static const published nothing[] = {{NULL, {0}}};

typedef struct subject {
    const char *name, *file;
    const char *environment; /* NULL: the scene's own */
    const char *light;       /* light that gather rays see */
    size_t directions[2];
    const published *published;
} subject;

static const subject subjects[] = {
    {"Cornell box", "cornell-box/glossy.xml", NULL, "direct=none,photons_per_texel=256", {40, 20}, table1},
    {"figure", "statue/statue.xml", NULL, "direct=gather,incident=emitters", {50, 25}, nothing},
    {"sphere", "sphere/sphere.xml", NULL, "direct=gather,incident=emitters", {64, 32}, nothing},
    {"figure in the studio",
     "statue/statue.xml",
     LAB_STUDIO,
     "direct=gather,incident=emitters",
     {50, 25},
     figure1},
    {"sphere in the studio",
     "sphere/sphere.xml",
     LAB_STUDIO,
     "direct=gather,incident=emitters",
     {64, 32},
     nothing}};

typedef struct image_study {
    lab_run *run;
    const subject *subject;
    lab_gather gather;
    size_t scrambles;
    size_t set_count;
    const char *sets[MOST_SETS];
} image_study;

static const char *const columns[] = {"scene",    "set",       "directions",   "weights",   "rmse",
                                      "rmse_low", "rmse_high", "over_oswa",    "over_low",  "over_high",
                                      "set_low",  "set_high",  "picture_rmse", "published", NULL};

static double published_ratio(const subject *of, const char *set, way which) {
    for (const published *row = of->published; row->set != NULL; ++row)
        if (strcmp(row->set, set) == 0)
            return row->ratio[which];
    return 0.0;
}

/* The RMSE of one method relative to that of OSWA: the ratio of two means over the same scramblings, with the
 * interval of its linearised form. */
static void add_row(const image_study *study, const char *set, way which, const double *mse,
                    const double *base, double image_mse) {
    const lab_interval rmse = lab_root_mean(study->scrambles, mse);
    const lab_interval ratio = lab_root_ratio_paired(study->scrambles, mse, base);
    const lab_interval one = lab_gather_one_set(study->scrambles, mse, base);
    const double published_value = published_ratio(study->subject, set, which);
    char directions[32];
    snprintf(directions, sizeof directions, "%zu+%zu", study->subject->directions[0],
             study->subject->directions[1]);
    lab_row(study->run, (const char *const[]){study->subject->name, set, directions, ways[which].name, NULL},
            10,
            (const double[]){rmse.value, rmse.low, rmse.high, ratio.value, ratio.low, ratio.high, one.low,
                             one.high, sqrt(image_mse), published_value != 0.0 ? published_value : NAN});
}

/* One scrambling; writes the image of the first. */
static aur_result measure_one(image_study *study, const char *set, way w, size_t scramble, double *both,
                              double *all, aur_error *error) {
    aur_image *image = NULL;
    aur_result result = lab_gather_render(&study->gather, set, ways[w].keys, study->subject->directions,
                                          1 + scramble, &image, error);
    if (result == AUR_OK)
        lab_gather_judge(&study->gather, image, both, all);
    if (result == AUR_OK && scramble == 0) {
        char view[160];
        snprintf(view, sizeof view, "%s, %.80s", study->subject->name, set);
        const lab_image_position position = {.view = view, .name = ways[w].name, .exposure = 1.0};
        const lab_image_position reference_position = {view, "reference", true, 1.0};
        result = lab_image(study->run, &position, image, error);
        if (result == AUR_OK && w == OSWA)
            result = lab_image(study->run, &reference_position, study->gather.reference, error);
    }
    aur_image_destroy(image);
    return result;
}

/* Mean square errors over the pixels with both lobes, one per scrambling, and the average mean of the images.
 */
static aur_result measure(image_study *study, const char *set, way w, double *mse, double *image_mse,
                          aur_error *error) {
    double values[MOST_SCRAMBLES + 1] = {0.0};
    char key[200];
    snprintf(key, sizeof key, "%s, %.80s, %s", study->subject->name, set, ways[w].name);
    aur_result result = AUR_OK;
    double seconds = 0.0;
    if (!lab_recall(study->run, key, study->scrambles + 1, values)) {
        double *const image_squares = &values[study->scrambles];
        result = lab_gather_need_reference(&study->gather, error);
        for (size_t k = 0; k < study->scrambles && result == AUR_OK; ++k) {
            double all = 0.0;
            result = measure_one(study, set, w, k, &values[k], &all, error);
            *image_squares += all / (double)study->scrambles;
            seconds += study->gather.seconds / (double)study->scrambles;
        }
        char what[240];
        snprintf(what, sizeof what, "%s, an image", key);
        lab_time(study->run, what, seconds);
        if (result == AUR_OK)
            result = lab_save(study->run, key, study->scrambles + 1, values, error);
    }
    memcpy(mse, values, study->scrambles * sizeof *mse);
    *image_mse = values[study->scrambles];
    return result;
}

static aur_result study_set(image_study *study, const char *set, aur_error *error) {
    double mse[WAYS][MOST_SCRAMBLES], over[WAYS];
    for (size_t w = 0; w < WAYS; ++w) {
        double image_mse = 0.0;
        const aur_result result = measure(study, set, (way)w, mse[w], &image_mse, error);
        if (result != AUR_OK)
            return result;
        add_row(study, set, (way)w, mse[w], mse[OSWA], image_mse);
        over[w] = 100.0 * (lab_root_ratio_paired(study->scrambles, mse[w], mse[OSWA]).value - 1.0);
    }
    lab_note(study->run,
             "%s, %s: over OSWA: MIS %+.1f %%, OSW %+.1f %%, equal weights %+.1f %%; as published %+.1f %%, "
             "optimal density %+.1f %%",
             study->subject->name, set, over[MIS], over[OSW], over[EQUAL], over[PUBLISHED], over[DENSE]);
    return AUR_OK;
}

static aur_result study_subject(image_study *study, aur_error *error) {
    aur_result result =
        lab_gather_open(&study->gather, study->subject->file, study->subject->environment, error);
    const size_t sets = study->gather.stage.renderer != NULL ? study->set_count : 0;
    for (size_t s = 0; s < sets && result == AUR_OK; ++s)
        result = lab_forgive(study->run, study->sets[s], study_set(study, study->sets[s], error), error);
    lab_gather_close(&study->gather);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    image_study study = {.run = run,
                         .gather = {.run = run,
                                    .side = options->quick ? 24 : 64,
                                    .photons = options->quick ? 100000 : 2000000,
                                    .reference_directions = options->quick ? 1024 : 4096},
                         .scrambles = options->quick ? 3 : MOST_SCRAMBLES,
                         .set_count = options->quick ? 1 : 3,
                         .sets = {"random", "sobol", "spherical-fibonacci"}};
    if (options->set != NULL)
        study.sets[study.set_count++] = options->set;
    aur_result result = AUR_OK;
    const size_t count = options->quick ? 1 : sizeof subjects / sizeof subjects[0];
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        study.subject = &subjects[i];
        study.gather.light = subjects[i].light;
        result = study_subject(&study, error);
    }
    return result;
}

const lab_experiment lab_marques_2018_table1 = {
    .name = "marques-2018-table1",
    .reproduces = "Marques 2018, table 1, figs 1, 6, 9",
    .summary = "equal weights, MIS, OSW and OSWA in rendered images at the paper's counts",
    .columns = columns,
    .measured = "over_oswa",
    .low = "set_low",
    .high = "set_high",
    .published = "published",
    .factor = LAB_RATIO_FACTOR,
    .seconds = 320,
    .quick_seconds = 3,
    .run = run,
    .takes_no_scene = "its rows are the paper's scenes",
};

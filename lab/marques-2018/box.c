/* The Cornell box of Marques 2018, table 1, whose lobes the paper does not state: exponents 1, 3, 5, 8, 20
 * and 50 by glossy shares of .2, .5 and .8, for Sobol and random samples.
 *
 * Settings, fixed before the run: wall, tall block and teapot have the same grey lobes, kd = .8 (1 - share)
 * and ks = .8 share; light, directions (40 + 20) and weighting methods are those of marques-2018-table1. All
 * 18 boxes are rows, each compared with the same six published values. The paper uses one point set for all
 * shading points, so a published value, and the interval compared with it, are for one set. A matching box
 * fits two parameters to six values; it is not a prediction. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "images.h"

enum { EXPONENTS = 6, SHARES = 3, MOST_SCRAMBLES = 16, SETS = 3 };

typedef enum box_way { OSWA, MIS, OSW, EQUAL, WAYS } box_way;

static const struct {
    const char *name, *keys;
} ways[WAYS] = {{"OSWA", "weights=oswa,density=same"},
                {"MIS", "weights=mis,density=same"},
                {"OSW", "weights=osw,density=same,clip=false"},
                {"equal", "weights=equal,clip=false"}};

/* RMSE relative to that of OSWA; 0: not published. */
static const struct {
    const char *set;
    double ratio[WAYS];
} published[] = {{"random", {[MIS] = 1.670, [OSW] = 1.470, [EQUAL] = 1.849}},
                 {"sobol", {[MIS] = 1.154, [OSW] = 1.431, [EQUAL] = 1.579}}};

static const double exponents[EXPONENTS] = {1.0, 3.0, 5.0, 8.0, 20.0, 50.0};
static const double shares[SHARES] = {0.2, 0.5, 0.8};
static const size_t directions[2] = {40, 20};

static const char *const columns[] = {"exponent",  "share",     "set",       "weights",
                                      "over_oswa", "over_low",  "over_high", "set_low",
                                      "set_high",  "published", NULL};

typedef struct box {
    lab_run *run;
    lab_gather gather;
    double exponent, share;
    size_t scrambles;
    size_t fits, compared;
} box;

static aur_result open_box(box *of, aur_error *error) {
    static const char *const materials[] = {"wall", "block", "glaze"};
    char names[9][16], kd[48], ks[48], m[16];
    snprintf(kd, sizeof kd, "%.3f", 0.8 * (1.0 - of->share));
    snprintf(ks, sizeof ks, "%.3f", 0.8 * of->share);
    snprintf(m, sizeof m, "%g", of->exponent);
    aur_definition definitions[9];
    for (size_t i = 0; i < 3; ++i) {
        const char *const parts[] = {"kd", "ks", "m"}, *const values[] = {kd, ks, m};
        for (size_t p = 0; p < 3; ++p) {
            snprintf(names[3 * i + p], sizeof names[0], "%s_%s", materials[i], parts[p]);
            definitions[3 * i + p] = (aur_definition){names[3 * i + p], values[p]};
        }
    }
    return lab_gather_open_defined(&of->gather, "cornell-box/glossy.xml", 9, definitions, error);
}

/* Mean square errors, one per scrambling. */
static aur_result measure(box *of, const char *set, box_way way, double *mse, aur_error *error) {
    char key[160];
    snprintf(key, sizeof key, "m %g, share %g, %.80s, %s", of->exponent, of->share, set, ways[way].name);
    if (lab_recall(of->run, key, of->scrambles, mse))
        return AUR_OK;
    aur_result result = lab_gather_need_reference(&of->gather, error);
    for (size_t k = 0; k < of->scrambles && result == AUR_OK; ++k) {
        aur_image *image = NULL;
        double all = 0.0;
        result = lab_gather_render(&of->gather, set, ways[way].keys, directions, 1 + k, &image, error);
        if (result == AUR_OK)
            lab_gather_judge(&of->gather, image, &mse[k], &all);
        aur_image_destroy(image);
    }
    return result != AUR_OK ? result : lab_save(of->run, key, of->scrambles, mse, error);
}

static double published_ratio(const char *set, box_way way) {
    for (size_t i = 0; i < sizeof published / sizeof published[0]; ++i)
        if (strcmp(published[i].set, set) == 0 && published[i].ratio[way] != 0.0)
            return published[i].ratio[way];
    return NAN;
}

static aur_result study_set(box *of, const char *set, aur_error *error) {
    double base[MOST_SCRAMBLES], mse[MOST_SCRAMBLES];
    aur_result result = measure(of, set, OSWA, base, error);
    for (size_t w = 1; w < WAYS && result == AUR_OK; ++w) {
        result = measure(of, set, (box_way)w, mse, error);
        if (result != AUR_OK)
            break;
        const lab_interval ratio = lab_root_ratio_paired(of->scrambles, mse, base);
        const lab_interval one = lab_gather_one_set(of->scrambles, mse, base);
        const double paper = published_ratio(set, (box_way)w);
        if (!isnan(paper)) {
            ++of->compared;
            of->fits += (paper >= one.low && paper <= one.high) ||
                        fmax(paper / ratio.value, ratio.value / paper) <= LAB_RATIO_FACTOR;
        }
        char exponent[16], share[16];
        snprintf(exponent, sizeof exponent, "%g", of->exponent);
        snprintf(share, sizeof share, "%g", of->share);
        lab_row(of->run, (const char *const[]){exponent, share, set, ways[w].name, NULL}, 6,
                (const double[]){ratio.value, ratio.low, ratio.high, one.low, one.high, paper});
    }
    return result;
}

static aur_result study_box(box *of, aur_error *error) {
    const lab_options *const options = lab_run_options(of->run);
    const char *const sets[SETS] = {"sobol", "random", options->set};
    aur_result result = open_box(of, error);
    of->fits = of->compared = 0;
    for (size_t s = 0; s < SETS && of->gather.stage.renderer != NULL && result == AUR_OK; ++s)
        if (sets[s] != NULL)
            result = lab_forgive(of->run, sets[s], study_set(of, sets[s], error), error);
    lab_gather_close(&of->gather);
    if (result == AUR_OK)
        lab_note(of->run,
                 "exponent %g, share %g: %zu of %zu published values agree or are within a factor of %g",
                 of->exponent, of->share, of->fits, of->compared, LAB_RATIO_FACTOR);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    const bool quick = lab_run_options(run)->quick;
    box of = {.run = run,
              .gather = {.run = run,
                         .light = "direct=none,photons_per_texel=96",
                         .side = quick ? 16 : 32,
                         .photons = quick ? 20000 : 200000,
                         .reference_directions = 1024},
              .scrambles = quick ? 3 : MOST_SCRAMBLES};
    aur_result result = AUR_OK;
    size_t most = 0, all = 0;
    for (size_t m = 0; m < EXPONENTS && result == AUR_OK; ++m)
        for (size_t s = 0; s < SHARES && result == AUR_OK; ++s) {
            if (quick && (exponents[m] != 3.0 || s != 2))
                continue;
            of.exponent = exponents[m];
            of.share = shares[s];
            result = study_box(&of, error);
            most = of.fits > most ? of.fits : most;
            all += of.compared > 0 && of.fits == of.compared;
        }
    if (result == AUR_OK)
        lab_note(run, "%zu boxes have all six published values; the best has %zu", all, most);
    return result;
}

static const report_plot plots[] = {
    {.name = "over",
     .title = "RMSE over that of OSWA against the exponent of the glossy lobes",
     .x = "exponent",
     .y = "over_oswa",
     .low = "over_low",
     .high = "over_high",
     .series = "weights",
     .panel = "set,share",
     .log_x = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2018_box = {
    .name = "marques-2018-box",
    .reproduces = "Marques 2018, table 1, by exponents and shares of the glossy lobe",
    .summary = "weights in a Cornell box of 18 materials next to the published errors, for one set of points",
    .columns = columns,
    .measured = "over_oswa",
    .low = "set_low",
    .high = "set_high",
    .published = "published",
    .factor = LAB_RATIO_FACTOR,
    .plots = plots,
    .seconds = 130,
    .quick_seconds = 1,
    .run = run,
    .takes_no_scene = "it varies the materials of one box",
};

/* The RMSE of rendered images against the number of samples: eight methods with their slopes, and the samples
 * that equal weights and MIS need for the error of optimal ones (Marques 2018, fig. 7), and very many samples
 * (fig. 8).
 *
 * N counts the samples of both lobes, two thirds of them diffuse. As published, lobes are not clipped, and
 * light from below the surface counts as black. Slopes are fitted to each scrambling, and intervals are over
 * scramblings. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "images.h"

enum { MOST_SIZES = 6, MOST_METHODS = 12, MOST_SCRAMBLES = 8 };

typedef enum way { EQUAL, OSW, MIS, OSWA, WAYS } way;

static const struct {
    const char *name, *keys;
    double random_slope; /* published, of random samples */
} ways[WAYS] = {{"QMC", "weights=equal", -0.5},
                {"OSW", "weights=osw", -0.7},
                {"MIS", "weights=mis", -0.5},
                {"OSWA", "weights=oswa", -0.7}};

typedef struct figure {
    const char *file, *quick_file; /* the latter needs no generated meshes */
    size_t size_count, quick_size_count, sizes[MOST_SIZES];
    size_t way_count; /* the first of them */
    size_t set_count;
    const char *sets[2];
    size_t side, scrambles, reference_directions;
    const char *rotations;
} figure;

static const figure figure7 = {.file = "sphere/sphere.xml",
                               .quick_file = "cornell-box/glossy.xml",
                               .size_count = 6,
                               .quick_size_count = 3,
                               .sizes = {24, 48, 96, 192, 384, 768},
                               .way_count = WAYS,
                               .set_count = 2,
                               .sets = {"random", "sobol"},
                               .side = 32,
                               .scrambles = 6,
                               .reference_directions = 8192,
                               .rotations = "rotations=4"};
static const figure figure8 = {.file = "statue/statue.xml",
                               .quick_file = "cornell-box/glossy.xml",
                               .size_count = 6,
                               .quick_size_count = 3,
                               .sizes = {24, 96, 384, 1536, 6144, 9999},
                               .way_count = 2,
                               .set_count = 1,
                               .sets = {"random"},
                               .side = 16,
                               .scrambles = 4,
                               .reference_directions = 65536,
                               .rotations = "rotations=4"};

static const char *const columns[] = {"quantity", "measured", "low", "high", "published", NULL};

typedef struct curve {
    const char *set;
    way way;
    double mse[MOST_SIZES][MOST_SCRAMBLES];
} curve;

typedef struct curve_study {
    lab_run *run;
    const figure *figure;
    lab_gather gather;
    const char *scene;
    size_t size_count, scrambles;
    size_t curve_count;
    curve curves[MOST_METHODS];
    report_table *drawn;
} curve_study;

static aur_result measure(curve_study *s, curve *c, size_t n, aur_error *error) {
    const size_t total = s->figure->sizes[n], directions[2] = {total - total / 3, total / 3};
    char key[160], keys[120];
    aur_result result = AUR_OK;
    snprintf(key, sizeof key, "%.80s %s %zu", c->set, ways[c->way].name, total);
    snprintf(keys, sizeof keys, "%s,density=same,clip=false,%s", ways[c->way].keys, s->figure->rotations);
    if (lab_recall(s->run, key, s->scrambles, c->mse[n]))
        return AUR_OK;
    result = lab_gather_need_reference(&s->gather, error);
    for (size_t k = 0; k < s->scrambles && result == AUR_OK; ++k) {
        aur_image *image = NULL;
        double all = 0.0;
        result = lab_gather_render(&s->gather, c->set, keys, directions, 1 + k, &image, error);
        if (result == AUR_OK)
            lab_gather_judge(&s->gather, image, &c->mse[n][k], &all);
        if (result == AUR_OK && k == 0 && n + 1 == s->size_count) {
            char view[64], name[120];
            snprintf(view, sizeof view, "%s, N = %zu", s->scene, total);
            snprintf(name, sizeof name, "%.80s %s", c->set, ways[c->way].name);
            result = lab_image(s->run, &(lab_image_position){.view = view, .name = name}, image, error);
            if (result == AUR_OK)
                result = lab_image(s->run, &(lab_image_position){view, "reference", true, 0.0},
                                   s->gather.reference, error);
        }
        aur_image_destroy(image);
    }
    return result != AUR_OK ? result : lab_save(s->run, key, s->scrambles, c->mse[n], error);
}

static void draw(const curve_study *s, const curve *c, size_t n, const char *panel) {
    const lab_interval rmse = lab_root_mean(s->scrambles, c->mse[n]);
    char name[120];
    snprintf(name, sizeof name, "%.80s %s", c->set, ways[c->way].name);
    lab_table_row(s->drawn, (const char *const[]){panel, name, NULL}, 4,
                  (const double[]){(double)s->figure->sizes[n], rmse.value, rmse.low, rmse.high});
}

static double slope(const curve_study *s, const curve *c, size_t scramble) {
    double x[MOST_SIZES], y[MOST_SIZES];
    for (size_t n = 0; n < s->size_count; ++n) {
        x[n] = (double)s->figure->sizes[n];
        y[n] = sqrt(c->mse[n][scramble]);
    }
    return lab_slope(s->size_count, x, y).value;
}

/* A row of one value per scrambling; published 0: none. */
static void add_row(const curve_study *s, const char *quantity, const double *values, double published) {
    double mean, half;
    lab_mean_interval(s->scrambles, values, &mean, &half);
    lab_row(s->run, (const char *const[]){quantity, NULL}, 4,
            (const double[]){mean, mean - half, mean + half, published != 0.0 ? published : NAN});
}

static void add_slope(const curve_study *s, const curve *c) {
    double values[MOST_SCRAMBLES];
    char quantity[160];
    const bool random = strcmp(c->set, "random") == 0;
    for (size_t k = 0; k < s->scrambles; ++k)
        values[k] = slope(s, c, k);
    snprintf(quantity, sizeof quantity, "slope, %.80s %s", c->set, ways[c->way].name);
    add_row(s, quantity, values, random ? ways[c->way].random_slope : 0.0);
}

/* The number of samples that `plain` needs for the error of `optimal` at the largest size, along the slope of
 * `plain`. */
static void add_needed(const curve_study *s, const curve *plain, const curve *optimal, double published) {
    const size_t last = s->size_count - 1, most = s->figure->sizes[last];
    double values[MOST_SCRAMBLES];
    char quantity[200];
    for (size_t k = 0; k < s->scrambles; ++k) {
        const double ratio = sqrt(plain->mse[last][k] / optimal->mse[last][k]);
        values[k] = (double)most * pow(ratio, -1.0 / slope(s, plain, k));
    }
    snprintf(quantity, sizeof quantity, "samples of %s for the error of %s with %zu, %.80s",
             ways[plain->way].name, ways[optimal->way].name, most, plain->set);
    add_row(s, quantity, values, published);
}

/* Claims such as "RMSE using OSW is always smaller". */
static void claim_order(const curve_study *s, const curve *below, const curve *above) {
    const size_t last = s->size_count - 1;
    lab_interval first = {0}, ratio = {0};
    size_t lower = 0, apart = 0;
    for (size_t n = 0; n <= last; ++n) {
        ratio = lab_root_ratio_paired(s->scrambles, below->mse[n], above->mse[n]);
        lower += ratio.value < 1.0;
        apart += ratio.high < 1.0;
        first = n == 0 ? ratio : first;
    }
    lab_claim(s->run, lower > last,
              "%s: %s is below %s for every N: at %zu of %zu sizes, %zu times beyond chance; RMSE times %.3f "
              "(%.3f to "
              "%.3f) at N = %zu and %.3f (%.3f to %.3f) at %zu",
              below->set, ways[below->way].name, ways[above->way].name, lower, s->size_count, apart,
              first.value, first.low, first.high, s->figure->sizes[0], ratio.value, ratio.low, ratio.high,
              s->figure->sizes[last]);
}

static aur_result study_set(curve_study *s, const char *set, aur_error *error) {
    curve *const of = s->curves + s->curve_count;
    for (size_t w = 0; w < s->figure->way_count; ++w) {
        of[w] = (curve){.set = set, .way = (way)w};
        for (size_t n = 0; n < s->size_count; ++n) {
            const aur_result result = measure(s, &of[w], n, error);
            if (result != AUR_OK)
                return result;
        }
    }
    s->curve_count += s->figure->way_count;
    const bool sobol = strcmp(set, "sobol") == 0, whole = !lab_run_options(s->run)->quick;
    for (size_t w = 0; w < s->figure->way_count; ++w) {
        add_slope(s, &of[w]);
        for (size_t n = 0; n < s->size_count; ++n)
            draw(s, &of[w], n, w < MIS ? "a: separate sets" : "b: all samples");
        /* As in the figure, both parts of which show Sobol's OSW. */
        for (size_t n = 0; n < s->size_count && s->figure->way_count > MIS; ++n)
            if (sobol && w == OSW)
                draw(s, &of[w], n, "b: all samples");
    }
    claim_order(s, &of[OSW], &of[EQUAL]);
    add_needed(s, &of[EQUAL], &of[OSW], sobol && whole ? 824.0 : 0.0);
    if (s->figure->way_count > MIS) {
        claim_order(s, &of[OSWA], &of[MIS]);
        add_needed(s, &of[MIS], &of[OSWA], sobol && whole ? 811.0 : 0.0);
    }
    return AUR_OK;
}

static aur_result run_figure(lab_run *run, const figure *of, aur_error *error) {
    static const char *const drawn[] = {"panel", "method", "n", "rmse", "rmse_low", "rmse_high", NULL};
    const lab_options *const options = lab_run_options(run);
    const bool quick = options->quick;
    curve_study s = {.run = run,
                     .figure = of,
                     .scene = quick            ? "box"
                              : of == &figure7 ? "sphere"
                                               : "figure",
                     .gather = {.run = run,
                                .light = quick ? "direct=none" : "direct=gather,incident=emitters",
                                .side = quick ? 12 : of->side,
                                .photons = quick ? 20000 : 1000,
                                .reference_directions = quick ? 2048 : of->reference_directions},
                     .size_count = quick ? of->quick_size_count : of->size_count,
                     .scrambles = quick ? 2 : of->scrambles,
                     .drawn = lab_table(run, "rmse", drawn)};
    aur_result result =
        lab_gather_open(&s.gather, quick ? of->quick_file : of->file, quick ? NULL : LAB_STUDIO, error);
    const bool there = s.gather.stage.renderer != NULL;
    for (size_t i = 0; i <= of->set_count && there && result == AUR_OK; ++i) {
        const char *const set = i < of->set_count ? of->sets[i] : options->set;
        if (set != NULL)
            result = lab_forgive(run, set, study_set(&s, set, error), error);
    }
    lab_gather_close(&s.gather);
    return result;
}

static aur_result run7(lab_run *run, aur_error *error) {
    return run_figure(run, &figure7, error);
}

static aur_result run8(lab_run *run, aur_error *error) {
    return run_figure(run, &figure8, error);
}

static const report_plot plots[] = {
    {.name = "rmse",
     .title = "RMSE of images against the number of samples",
     .table = "rmse",
     .x = "n",
     .y = "rmse",
     .low = "rmse_low",
     .high = "rmse_high",
     .series = "method",
     .panel = "panel",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2018_fig7 = {
    .name = "marques-2018-fig7",
    .reproduces = "Marques 2018, fig. 7",
    .summary = "RMSE of images of a sphere against N, eight methods, their slopes, and samples saved",
    .columns = columns,
    .measured = "measured",
    .low = "low",
    .high = "high",
    .published = "published",
    .factor = LAB_RATIO_FACTOR,
    .plots = plots,
    .seconds = 25,
    .quick_seconds = 0.2,
    .run = run7,
    .parameters = lab_scene_parameters,
};

const lab_experiment lab_marques_2018_fig8 = {
    .name = "marques-2018-fig8",
    .reproduces = "Marques 2018, fig. 8",
    .summary = "convergence of optimal weights to ten thousand random samples per pixel",
    .columns = columns,
    .measured = "measured",
    .low = "low",
    .high = "high",
    .published = "published",
    .factor = LAB_RATIO_FACTOR,
    .plots = plots,
    .seconds = 17,
    .quick_seconds = 0.1,
    .run = run8,
    .parameters = lab_scene_parameters,
};

/* The extensions of section 4 of Keller 1994, each with a number and an image: one light per hit point by
 * permutations, samples shared by neighbouring pixels, fixed and adaptive oversampling.
 *
 * Settings are compared on the same solution by the RMSE of their images against two independent references
 * with very many samples, over seeds, and by rays. `saved_rays` is the ratio of rays that the feature's first
 * setting needs for the same error, if squared errors fall as 1/rays. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study.h"

enum { MOST_SEEDS = 4, MOST_SETTINGS = 5 };

static const char *const columns[] = {"feature",        "scene",     "setting",    "samples_a_pixel",
                                      "rays_per_pixel", "rmse",      "rmse_low",   "rmse_high",
                                      "saved_rays",     "saved_low", "saved_high", NULL};

typedef struct setting {
    const char *name, *keys;
    size_t samples;
} setting;

typedef struct feature {
    const char *name;
    size_t scene;          /* index of the paper's scene */
    const char *keys;      /* common to all its settings */
    const char *reference; /* for the references only */
    size_t reference_samples, quick_reference_samples;
    size_t finer; /* pixels per pixel of the other images, along each axis */
    setting settings[MOST_SETTINGS];
} feature;

static const feature features[] = {
    {"permuted lights",
     1,
     "component=direct",
     "light_sampling=all",
     32,
     8,
     1,
     {{"all lights", "light_sampling=all", 16}, {"permuted", "light_sampling=permuted", 16}}},
    {"sharing in a coarse image",
     2,
     "component=indirect",
     "share_neighbours=false,gather_samples=64",
     32,
     8,
     1,
     {{"separate samples", "gather_samples=8,share_neighbours=false", 4},
      {"shared", "gather_samples=8,share_neighbours=true", 4}}},
    {"neighbour sharing",
     2,
     "component=indirect",
     "share_neighbours=false,gather_samples=32",
     8,
     4,
     4,
     {{"separate samples", "gather_samples=8,share_neighbours=false", 4},
      {"shared", "gather_samples=8,share_neighbours=true", 4}}},
    {"oversampling",
     2,
     "component=direct,light_sampling=all",
     "oversampling=halton",
     128,
     16,
     1,
     {{"16 Halton points", "oversampling=halton", 16},
      {"64 Halton points", "oversampling=halton", 64},
      {"adaptive to .03", "oversampling=adaptive,threshold=0.03", 64},
      {"adaptive to .01", "oversampling=adaptive,threshold=0.01", 64}}},
    {"oversampling with permuted lights",
     2,
     "component=direct",
     "oversampling=halton,light_sampling=all",
     128,
     16,
     1,
     {{"16 Halton points", "oversampling=halton", 16},
      {"64 Halton points", "oversampling=halton", 64},
      {"adaptive to .01", "oversampling=adaptive,threshold=0.01", 64}}},
};

enum { FEATURES = sizeof features / sizeof features[0] };

typedef struct feature_study {
    lab_run *run;
    aur_renderer *renderer;
    const feature *feature;
    size_t width, seeds;
    aur_image *references[2];
} feature_study;

static aur_result render(const feature_study *s, const char *integrator, size_t samples, uint64_t seed,
                         double *rays, double *taken, aur_image **image, aur_error *error) {
    const lab_options *const lab = lab_run_options(s->run);
    aur_render_statistics statistics = {.size = sizeof statistics};
    const size_t height = 3 * s->width / 4;
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = integrator,
                                        .sampler = "sobol",
                                        .filter = "box",
                                        .samples_per_pixel = samples,
                                        .seed = seed,
                                        .width = s->width,
                                        .height = height,
                                        .threads = lab->threads,
                                        .progress = lab->progress,
                                        .warnings = lab->warnings};
    const aur_result result = aur_renderer_render(s->renderer, &options, image, &statistics, error);
    *rays = (double)statistics.rays / (double)(s->width * height);
    *taken = (double)statistics.samples / (double)(s->width * height);
    return result;
}

static aur_result render_setting(const feature_study *s, const char *keys, size_t samples, uint64_t seed,
                                 double *rays, double *taken, aur_image **image, aur_error *error) {
    char integrator[300];
    snprintf(integrator, sizeof integrator, "radiosity:sequence=halton,paths=%d,%s,%s",
             lab_run_options(s->run)->quick ? 2000 : 50000, s->feature->keys, keys);
    return render(s, integrator, samples, seed, rays, taken, image, error);
}

/* The references, and the solution of each seed: the first render of a seed traces and counts the particles,
 * which all settings share, so no setting may be charged for them. */
static aur_result need_references(feature_study *s, aur_error *error) {
    const bool quick = lab_run_options(s->run)->quick;
    const size_t samples = quick ? s->feature->quick_reference_samples : s->feature->reference_samples;
    double rays, taken;
    aur_result result = AUR_OK;
    if (s->references[0] != NULL)
        return AUR_OK;
    for (size_t k = 0; k < 2 && result == AUR_OK; ++k)
        result = render_setting(s, s->feature->reference, samples, 1000 + k, &rays, &taken, &s->references[k],
                                error);
    for (size_t k = 0; k < s->seeds && result == AUR_OK; ++k) {
        aur_image *image = NULL;
        result = render_setting(s, s->feature->settings[0].keys, 1, 1 + k, &rays, &taken, &image, error);
        aur_image_destroy(image);
    }
    return result;
}

/* Mean square errors, one per seed, then rays and samples per pixel. */
static aur_result measure(feature_study *s, const setting *of, double values[MOST_SEEDS + 2],
                          aur_error *error) {
    char key[120];
    snprintf(key, sizeof key, "%s, %s", s->feature->name, of->name);
    if (lab_recall(s->run, key, MOST_SEEDS + 2, values))
        return AUR_OK;
    aur_result result = need_references(s, error);
    for (size_t k = 0; k < s->seeds && result == AUR_OK; ++k) {
        aur_image *image = NULL;
        result = render_setting(s, of->keys, of->samples, 1 + k, &values[MOST_SEEDS], &values[MOST_SEEDS + 1],
                                &image, error);
        if (result == AUR_OK)
            values[k] = lab_mean_product(image, s->references[0], s->references[1]);
        if (result == AUR_OK && k == 0) {
            const lab_image_position position = {.view = s->feature->name, .name = of->name, .exposure = 1.0};
            const lab_image_position reference_position = {s->feature->name, "reference", true, 1.0};
            result = lab_image(s->run, &position, image, error);
            if (result == AUR_OK)
                result = lab_image(s->run, &reference_position, s->references[0], error);
        }
        aur_image_destroy(image);
    }
    return result != AUR_OK ? result : lab_save(s->run, key, MOST_SEEDS + 2, values, error);
}

static aur_result study_feature(feature_study *s, aur_error *error) {
    double first[MOST_SEEDS + 2] = {0};
    for (const setting *of = s->feature->settings;
         of < s->feature->settings + MOST_SETTINGS && of->name != NULL; ++of) {
        double values[MOST_SEEDS + 2] = {0};
        const aur_result result = measure(s, of, values, error);
        if (result != AUR_OK)
            return result;
        if (of == s->feature->settings)
            memcpy(first, values, sizeof first);
        const lab_interval rmse = lab_root_mean(s->seeds, values);
        const lab_interval less = lab_root_ratio_paired(s->seeds, first, values);
        const double rays = first[MOST_SEEDS] / values[MOST_SEEDS];
        lab_row(
            s->run,
            (const char *const[]){s->feature->name, keller_scene_at(s->feature->scene)->name, of->name, NULL},
            8,
            (const double[]){values[MOST_SEEDS + 1], values[MOST_SEEDS], rmse.value, rmse.low, rmse.high,
                             rays * less.value * less.value, rays * less.low * less.low,
                             rays * less.high * less.high});
    }
    return AUR_OK;
}

static void release(feature_study *s) {
    for (size_t k = 0; k < 2; ++k) {
        aur_image_destroy(s->references[k]);
        s->references[k] = NULL;
    }
}

static aur_result run(lab_run *run, aur_error *error) {
    const bool quick = lab_run_options(run)->quick;
    feature_study s = {.run = run, .width = quick ? 16 : 32, .seeds = quick ? 2 : MOST_SEEDS};
    aur_result result = AUR_OK;
    const size_t width = s.width;
    for (size_t f = 0; f < FEATURES && result == AUR_OK; ++f) {
        lab_stage stage;
        s.feature = &features[f];
        s.width = width * s.feature->finer;
        result = lab_stage_open(run, keller_scene_at(s.feature->scene)->realistic, 0, NULL, &stage, error);
        s.renderer = stage.renderer;
        if (result == AUR_OK)
            result = study_feature(&s, error);
        lab_stage_close(&stage);
        release(&s);
    }
    return result;
}

const lab_experiment lab_keller_1994_features = {
    .name = "keller-1994-features",
    .reproduces = "Keller 1994, section 4: lights, sharing, samples",
    .summary = "permuted lights, neighbour sharing, fixed and adaptive oversampling",
    .columns = columns,
    .takes_no_set = "it compares settings",
    .seconds = 9,
    .quick_seconds = 0.8,
    .run = run,
    .takes_no_scene = "its rows are Keller's scenes",
};

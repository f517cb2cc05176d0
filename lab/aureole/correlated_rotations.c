/* The benefit of correlated rotations of neighbouring pixels (future work in Marques 2013): errors of pixels,
 * and of means of pixels, if neighbours have different rotations, random ones, or all the same.
 *
 * The classic Cornell box, indirect light at pixel centres. Intervals are over seeds of the pattern. The
 * error of the reference, with 2048 directions, is a few hundredths of the measured one. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "program/lab/lab.h"

enum { PATTERNS = 3, COUNTS = 2, FORMS = 3, BLURS = 4, MOST_SEEDS = 12, TAPS = 13, CHANNELS = 3 };

static const char *const forms[FORMS] = {"random", "blue", "none"};

typedef struct blur {
    const char *name;
    size_t taps;  /* of the kernel in x and in y */
    double sigma; /* pixels; 0: equal weights */
} blur;

static const blur blurs[BLURS] = {
    {"pixels", 1, 0.0}, {"mean of 4 x 4", 4, 0.0}, {"Gaussian 1", 7, 1.0}, {"Gaussian 2", TAPS, 2.0}};

typedef struct study {
    lab_run *run;
    lab_stage stage;
    size_t side, seeds, reference_directions, photons;
    aur_image *reference; /* NULL: not rendered yet */
    double mean;          /* of the reference */
    double *room;         /* two images of one channel */
    size_t compared, less, same;
} study;

static void make_kernel(const blur *b, double kernel[TAPS]) {
    double sum = 0.0;
    for (size_t i = 0; i < b->taps; ++i) {
        const double x = (double)i - 0.5 * (double)(b->taps - 1);
        kernel[i] = b->sigma > 0.0 ? exp(-0.5 * x * x / (b->sigma * b->sigma)) : 1.0;
        sum += kernel[i];
    }
    for (size_t i = 0; i < b->taps; ++i)
        kernel[i] /= sum;
}

/* The mean square of one channel's blurred error, where the kernel lies within the image. */
static double blurred_square(const study *s, const aur_image *image, size_t channel, const blur *b) {
    const size_t side = s->side, inside = side - b->taps + 1, channels = aur_image_channel_count(image);
    const float *const x = aur_image_data(image), *const r = aur_image_data(s->reference);
    double kernel[TAPS], *const rows = s->room, sum = 0.0;
    make_kernel(b, kernel);
    for (size_t i = 0; i < side; ++i)
        for (size_t j = 0; j < inside; ++j) {
            double value = 0.0;
            for (size_t t = 0; t < b->taps; ++t) {
                const size_t at = (i * side + j + t) * channels + channel;
                value += kernel[t] * ((double)x[at] - (double)r[at]);
            }
            rows[i * inside + j] = value;
        }
    for (size_t i = 0; i < inside; ++i)
        for (size_t j = 0; j < inside; ++j) {
            double value = 0.0;
            for (size_t t = 0; t < b->taps; ++t)
                value += kernel[t] * rows[(i + t) * inside + j];
            sum += value * value;
        }
    return sum / (double)(inside * inside);
}

static aur_result render(const study *s, const char *set, size_t directions, const char *rotations,
                         size_t seed, aur_image **image, aur_error *error) {
    char integrator[320];
    snprintf(integrator, sizeof integrator,
             "finalgather-lab:direct=none,pixel=centre,edges=0,short_rays=0,density=same,photons=%zu,"
             "photons_per_texel=64,pattern=%.80s,diffuse_samples=%zu,glossy_samples=%zu,pattern_seed=%zu,%s",
             s->photons, set, directions, directions, seed, rotations);
    const lab_rendering how = {
        .renderer = s->stage.renderer, .integrator = integrator, .width = s->side, .height = s->side};
    return lab_render(s->run, &how, image, error);
}

static aur_result need_reference(study *s, aur_error *error) {
    double mean[4];
    if (s->reference != NULL)
        return AUR_OK;
    aur_result result =
        render(s, "spherical-fibonacci", s->reference_directions, "rotations=0", 1000, &s->reference, error);
    if (result == AUR_OK)
        result = aur_image_mean(s->reference, mean, error);
    s->mean = result == AUR_OK ? mean[3] : 0.0;
    return result;
}

/* Mean square errors after each blur relative to the reference's mean, one per seed; writes the first image.
 */
static aur_result measure(study *s, const char *set, size_t directions, const char *form,
                          double values[BLURS * MOST_SEEDS], aur_error *error) {
    char key[160], view[120], keys[48];
    snprintf(view, sizeof view, "%.80s, %zu directions", set, directions);
    snprintf(key, sizeof key, "%s, %s", view, form);
    snprintf(keys, sizeof keys, "decorrelation=%s", form);
    if (lab_recall(s->run, key, BLURS * s->seeds, values))
        return AUR_OK;
    aur_result result = need_reference(s, error);
    for (size_t k = 0; k < s->seeds && result == AUR_OK; ++k) {
        aur_image *image = NULL;
        result = render(s, set, directions, keys, 1 + k, &image, error);
        for (size_t b = 0; b < BLURS && result == AUR_OK; ++b) {
            values[b * s->seeds + k] = 0.0;
            for (size_t c = 0; c < CHANNELS; ++c)
                values[b * s->seeds + k] +=
                    blurred_square(s, image, c, &blurs[b]) / (CHANNELS * s->mean * s->mean);
        }
        const lab_image_position position = {view, form, .exposure = 1.5},
                                 reference_position = {view, "reference", true, 1.5};
        if (result == AUR_OK && k == 0)
            result = lab_image(s->run, &position, image, error);
        if (result == AUR_OK && k == 0 && form == forms[0])
            result = lab_image(s->run, &reference_position, s->reference, error);
        aur_image_destroy(image);
    }
    return result != AUR_OK ? result : lab_save(s->run, key, BLURS * s->seeds, values, error);
}

static aur_result study_pattern(study *s, const char *set, size_t directions, aur_error *error) {
    double values[FORMS][BLURS * MOST_SEEDS];
    for (size_t f = 0; f < FORMS; ++f) {
        const aur_result result = measure(s, set, directions, forms[f], values[f], error);
        if (result != AUR_OK)
            return result;
    }
    for (size_t b = 0; b < BLURS; ++b)
        for (size_t f = 0; f < FORMS; ++f) {
            const double *const errors = &values[f][b * s->seeds], *const base = &values[0][b * s->seeds];
            const lab_interval rmse = lab_root_mean(s->seeds, errors);
            const lab_interval ratio = lab_root_ratio(s->seeds, errors, s->seeds, base);
            lab_row(s->run, (const char *const[]){set, forms[f], blurs[b].name, NULL}, 7,
                    (const double[]){(double)directions, 100.0 * rmse.value, 100.0 * rmse.low,
                                     100.0 * rmse.high, ratio.value, ratio.low, ratio.high});
            if (f == 1) {
                s->compared += b > 0;
                s->less += b > 0 && ratio.value < 1.0;
                s->same += b == 0 && ratio.low <= 1.0 && ratio.high >= 1.0;
            }
        }
    return AUR_OK;
}

static aur_result study_all(study *s, aur_error *error) {
    const char *const sets[PATTERNS] = {"spherical-fibonacci", "sobol", lab_run_options(s->run)->set};
    static const size_t counts[COUNTS] = {16, 64};
    size_t cases = 0;
    aur_result result = AUR_OK;
    for (size_t i = 0; i < PATTERNS && sets[i] != NULL; ++i)
        for (size_t n = 0; n < COUNTS && result == AUR_OK; ++n) {
            ++cases;
            result = lab_forgive(s->run, sets[i], study_pattern(s, sets[i], counts[n], error), error);
        }
    aur_image_destroy(s->reference);
    if (result != AUR_OK)
        return result;
    lab_claim(s->run, s->less == s->compared,
              "correlated rotations (blue) leave less error than random ones after a blur: in %zu of %zu",
              s->less, s->compared);
    lab_claim(s->run, s->same == cases, "pixels alone have the same error: within the interval in %zu of %zu",
              s->same, cases);
    return AUR_OK;
}

static const char *const columns[] = {"pattern",      "rotations",  "blur", "directions",
                                      "rmse_percent", "low",        "high", "ratio",
                                      "ratio_low",    "ratio_high", NULL};

static aur_result run(lab_run *run, aur_error *error) {
    const bool quick = lab_run_options(run)->quick;
    study s = {.run = run,
               .side = quick ? 32 : 128,
               .seeds = quick ? 3 : MOST_SEEDS,
               .reference_directions = quick ? 1024 : 2048,
               .photons = quick ? 20000 : 200000};
    s.room = malloc(s.side * s.side * sizeof *s.room);
    if (s.room == NULL) {
        *error = (aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"};
        return AUR_ERROR_MEMORY;
    }
    aur_result result = lab_stage_open(run, "cornell-box/cornell-box.xml", 0, NULL, &s.stage, error);
    if (s.stage.renderer != NULL && result == AUR_OK)
        result = study_all(&s, error);
    lab_stage_close(&s.stage);
    free(s.room);
    return result;
}

static const report_plot plots[] = {
    {.name = "ratio",
     .title = "Error over that of random rotations, before and after a blur",
     .x = "directions",
     .y = "ratio",
     .low = "ratio_low",
     .high = "ratio_high",
     .series = "rotations,pattern",
     .panel = "blur",
     .log_x = true},
    {.name = NULL},
};

const lab_experiment lab_aureole_correlated_rotations = {
    .name = "aureole-correlated-rotations",
    .reproduces = "Marques 2013, future work",
    .summary = "what rotations that are correlated between pixels save, before and after a blur",
    .columns = columns,
    .plots = plots,
    .seconds = 9,
    .quick_seconds = 0.3,
    .run = run,
    .parameters = lab_scene_parameters,
};

/* Merged samples of all lobes of coated materials in images: a ball under random lights, seen at every angle,
 * with a diffuse and one or two glossy lobes, as in plastic, a clear coat over a rough base, or a blend of
 * Phong lobes. finalgather-lab merges one glossy lobe by a formula; this measures the benefit of merging
 * more.
 *
 * Settings, fixed before the run: lobe_weights.h; orthographic view, pixel centres up to 85 degrees. Each
 * pixel has an independent randomisation and weights solved at its angle; only the ball shadows itself.
 * Lights are those of samples.h on the whole sphere. Intervals are over images, each with a different light.
 */
#include <math.h>
#include <stdio.h>

#include "lobe_weights.h"

enum { SIDE = 24, QUICK_SIDE = 6, IMAGES = 12, QUICK_IMAGES = 2, SETS = 3 };

static const double MOST_DEGREES = 85.0, DEGREES = 180.0 / 3.14159265358979323846;

typedef struct coat {
    const char *name;
    lab_lobes lobes;
    bool quick;
} coat;

static const coat coats[] = {
    {"diffuse + GGX .1", {.count = 2, .lobes = {LAB_COSINE(1.0), LAB_GGX(0.1)}}, false},
    {"diffuse + GGX .4 + GGX .1", {.count = 3, .lobes = {LAB_COSINE(1.0), LAB_GGX(0.4), LAB_GGX(0.1)}}, true},
    {"diffuse + m 5 + m 50",
     {.count = 3, .lobes = {LAB_COSINE(1.0), LAB_COSINE(5.0), LAB_COSINE(50.0)}},
     false}};

static const char *const columns[] = {"lobes",      "set",      "light",     "method", "rmse",
                                      "over_plain", "over_low", "over_high", NULL};

typedef struct coats_study {
    lab_run *run;
    const coat *of;
    const char *set;
    size_t side, images;
    double squares[2][LAB_LOBE_METHODS][IMAGES]; /* per light and method: sums over pixels */
} coats_study;

/* The light in the local frame of a pixel's surface point: z along the normal, x towards the eye. */
static lab_light turn(lab_light light, double x, double y) {
    const double z = sqrt(fmax(0.0, 1.0 - x * x - y * y)), radius = sqrt(x * x + y * y);
    const double cosine = radius > 0.0 ? x / radius : 1.0, sine = radius > 0.0 ? y / radius : 0.0;
    const double frame[3][3] = {{-z * cosine, -z * sine, radius}, {sine, -cosine, 0.0}, {x, y, z}};
    for (size_t i = 0; i < LAB_LIGHT_PARTS; ++i) {
        double axis[3];
        for (size_t k = 0; k < 3; ++k)
            axis[k] = frame[k][0] * light.axis[i][0] + frame[k][1] * light.axis[i][1] +
                      frame[k][2] * light.axis[i][2];
        for (size_t k = 0; k < 3; ++k)
            light.axis[i][k] = axis[k];
    }
    return light;
}

/* Adds the squared errors of one pixel of all images. */
static aur_result add_pixel(coats_study *s, const lab_lobes *lobes, size_t pixel, double x, double y,
                            aur_error *error) {
    aur_result result = AUR_OK;
    for (size_t image = 0; image < s->images && result == AUR_OK; ++image) {
        double xyz[3 * LAB_MOST_SAMPLES], weights[LAB_LOBE_METHODS][LAB_MOST_SAMPLES];
        result = lab_lobes_draw(lobes, s->set, 0, image * SIDE * SIDE + pixel, xyz, error);
        for (size_t m = 0; m < LAB_LOBE_METHODS && result == AUR_OK; ++m)
            result = lab_lobes_weigh(lobes, (lab_lobe_method)m, xyz, weights[m], error);
        for (size_t hard = 0; hard < 2 && result == AUR_OK; ++hard) {
            const lab_light light = turn(lab_random_light(image, hard == 1), x, y);
            const double reference = lab_lobes_integrate(lobes, &light);
            double radiance[LAB_MOST_SAMPLES];
            for (size_t i = 0; i < lobes->all; ++i)
                radiance[i] = lab_radiance(&light, xyz + 3 * i);
            for (size_t m = 0; m < LAB_LOBE_METHODS; ++m) {
                double off = -reference;
                for (size_t i = 0; i < lobes->all; ++i)
                    off += weights[m][i] * radiance[i];
                s->squares[hard][m][image] += off * off;
            }
        }
    }
    return result;
}

/* Pixels seen at the same angle share densities and reference: a row of the image and its mirror image. */
static aur_result measure(coats_study *s, aur_error *error) {
    size_t pixels = 0;
    aur_result result = AUR_OK;
    for (size_t row = 0; row < s->side / 2; ++row)
        for (size_t column = 0; column <= row; ++column) {
            const double a = (2.0 * (double)row + 1.0) / (double)s->side,
                         b = (2.0 * (double)column + 1.0) / (double)s->side;
            lab_lobes lobes = s->of->lobes;
            lobes.view_degrees = asin(fmin(1.0, sqrt(a * a + b * b))) * DEGREES;
            if (lobes.view_degrees > MOST_DEGREES)
                continue;
            result = lab_lobes_open(&lobes, error);
            for (size_t k = 0; k < (row == column ? 4 : 8) && result == AUR_OK; ++k)
                result = add_pixel(s, &lobes, pixels++, (k & 1u ? -1.0 : 1.0) * (k & 4u ? b : a),
                                   (k & 2u ? -1.0 : 1.0) * (k & 4u ? a : b), error);
            lab_lobes_close(&lobes);
            if (result != AUR_OK)
                return result;
        }
    for (size_t i = 0; i < 2 * LAB_LOBE_METHODS * IMAGES; ++i)
        (&s->squares[0][0][0])[i] /= (double)pixels;
    return AUR_OK;
}

static aur_result study_set(coats_study *s, aur_error *error) {
    enum { CELLS = 2 * LAB_LOBE_METHODS * IMAGES };
    char key[200];
    snprintf(key, sizeof key, "%s, %.120s", s->of->name, s->set);
    if (!lab_recall(s->run, key, CELLS, &s->squares[0][0][0])) {
        aur_result result = measure(s, error);
        if (result == AUR_OK)
            result = lab_save(s->run, key, CELLS, &s->squares[0][0][0], error);
        if (result != AUR_OK)
            return result;
    }
    for (size_t hard = 0; hard < 2; ++hard)
        lab_lobes_rows(s->run, s->of->name, s->set, hard == 1, s->images, IMAGES, s->squares[hard][0]);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    const char *const sets[SETS] = {"spherical-fibonacci", options->quick ? NULL : "sobol", options->set};
    aur_result result = AUR_OK;
    for (size_t c = 0; c < sizeof coats / sizeof coats[0]; ++c)
        for (size_t i = 0; i < SETS && result == AUR_OK; ++i) {
            if (sets[i] == NULL || (options->quick && !coats[c].quick))
                continue;
            coats_study s = {.run = run,
                             .of = &coats[c],
                             .set = sets[i],
                             .side = options->quick ? QUICK_SIDE : SIDE,
                             .images = options->quick ? QUICK_IMAGES : IMAGES};
            result = lab_forgive(run, s.set, study_set(&s, error), error);
        }
    return result;
}

const lab_experiment lab_marques_2018_coats = {
    .name = "marques-2018-coats",
    .reproduces = "none: images of coated materials, whose two or three lobes are merged",
    .summary =
        "a ball of plastic, of a clear coat and of Phong lobes under random lights, four kinds of weights",
    .columns = columns,
    .takes_no_scene = "its light has known integrals",
    .seconds = 100,
    .quick_seconds = 0.5,
    .run = run,
};

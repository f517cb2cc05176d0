/* Parameters that Marques 2018 leaves to be learned from the samples: the smoothness s, and the placement of
 * further samples (section 7).
 *
 * Settings, fixed before the run: 64 samples of a lobe, m = 1 and 20, under random lights. s is the value
 * among nine, 1.1 to 1.9, that maximises the likelihood of the samples' values for a Gaussian field of the
 * kernel with unknown mean; it then gives the weights of all samples. Placed samples: 32 of the set, then 32
 * of 1024 candidates of the lobe, drawn with probability proportional to the spread of the four nearest
 * values (at least a tenth of the spread of all), all 64 weighted for s = 1.5. Both use the values that they
 * weight; optimal weights are valid for any points, so the bound is not biased. Intervals are over lights. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "samples.h"

enum {
    COUNT = 64,
    FIRST = COUNT / 2,
    CANDIDATES = 1024,
    NEAREST = 4,
    SMOOTH = 9,
    REFERENCE = 8192,
    LIGHTS = 200,
    SETS = 4
};

typedef enum way { FIXED, LEARNED, HINDSIGHT, PLACED, WAYS } way;

static const char *const way_names[WAYS] = {"s = 1.5", "s learned", "best s of each light",
                                            "half placed by spread"};

static const char *const columns[] = {"exponent",   "set",      "light",     "way",    "rmse",
                                      "over_fixed", "over_low", "over_high", "mean_s", NULL};

typedef struct learned_study {
    lab_run *run;
    double exponent;
    const char *set;
    aur_potential *potentials[SMOOTH];
    double reference[3 * REFERENCE], candidates[3 * CANDIDATES];
} learned_study;

static double smoothness(size_t index) {
    return 1.1 + 0.1 * (double)index;
}

static double chord(const double *a, const double *b) {
    return sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

/* Solves L L' x = b for both right-hand sides, with the Cholesky factor of the kernel matrix; *log_det is of
 * the matrix. */
static bool solve(double s, const double *xyz, double x[2][COUNT], double *log_det) {
    double l[COUNT][COUNT];
    *log_det = 0.0;
    for (size_t i = 0; i < COUNT; ++i)
        for (size_t j = 0; j <= i; ++j) {
            double sum =
                aur_kernel(s, chord(xyz + 3 * i, xyz + 3 * j)) + (i == j ? AUR_REGULARIZATION_DEFAULT : 0.0);
            for (size_t k = 0; k < j; ++k)
                sum -= l[i][k] * l[j][k];
            if (i == j && !(sum > 0.0))
                return false;
            l[i][j] = i == j ? sqrt(sum) : sum / l[j][j];
            *log_det += i == j ? log(sum) : 0.0;
        }
    for (size_t r = 0; r < 2; ++r) {
        for (size_t i = 0; i < COUNT; ++i) {
            for (size_t k = 0; k < i; ++k)
                x[r][i] -= l[i][k] * x[r][k];
            x[r][i] /= l[i][i];
        }
        for (size_t i = COUNT; i-- > 0;) {
            for (size_t k = i + 1; k < COUNT; ++k)
                x[r][i] -= l[k][i] * x[r][k];
            x[r][i] /= l[i][i];
        }
    }
    return true;
}

/* The log-likelihood of the values, up to a constant, at the best mean and variance. */
static double likelihood(double s, const double *xyz, const double *values) {
    double x[2][COUNT], log_det, ones = 0.0, sum = 0.0, square = 0.0;
    for (size_t i = 0; i < COUNT; ++i) {
        x[0][i] = 1.0;
        x[1][i] = values[i];
    }
    if (!solve(s, xyz, x, &log_det))
        return -INFINITY;
    for (size_t i = 0; i < COUNT; ++i) {
        ones += x[0][i];
        sum += x[1][i];
    }
    const double mean = sum / ones;
    for (size_t i = 0; i < COUNT; ++i)
        square += (values[i] - mean) * (x[1][i] - mean * x[0][i]);
    return -0.5 * (COUNT * log(fmax(square, 1e-300)) + log_det);
}

static aur_result estimate(const learned_study *of, size_t s, const double *xyz, const double *values,
                           double *found, aur_error *error) {
    const aur_potential *const potential = of->potentials[s];
    double weights[COUNT];
    const aur_result result =
        aur_weights_solve(COUNT, xyz, 1, &potential, NULL, COUNT, weights, NULL, NULL, error);
    *found = 0.0;
    for (size_t i = 0; i < COUNT && result == AUR_OK; ++i)
        *found += weights[i] * values[i];
    return result;
}

/* The variance of the values at the samples that are nearest to a direction. */
static double spread_near(const double *u, const double *xyz, const double *values) {
    double near[NEAREST], of[NEAREST], sum = 0.0, squares = 0.0;
    for (size_t k = 0; k < NEAREST; ++k)
        near[k] = INFINITY;
    for (size_t i = 0; i < FIRST; ++i) {
        size_t at = NEAREST;
        const double distance = chord(u, xyz + 3 * i);
        while (at > 0 && distance < near[at - 1])
            --at;
        for (size_t k = NEAREST - 1; k > at; --k) {
            near[k] = near[k - 1];
            of[k] = of[k - 1];
        }
        if (at < NEAREST) {
            near[at] = distance;
            of[at] = values[i];
        }
    }
    for (size_t k = 0; k < NEAREST; ++k) {
        sum += of[k] / NEAREST;
        squares += of[k] * of[k] / NEAREST;
    }
    return sqrt(fmax(0.0, squares - sum * sum));
}

/* Fills the second half of xyz: candidates in order, with probability proportional to the spread near them.
 */
static void place(const learned_study *of, double *xyz, const double *values) {
    double spreads[CANDIDATES], sum = 0.0, squares = 0.0, total = 0.0, passed = 0.0;
    for (size_t i = 0; i < FIRST; ++i) {
        sum += values[i] / FIRST;
        squares += values[i] * values[i] / FIRST;
    }
    const double least = 0.1 * sqrt(fmax(0.0, squares - sum * sum)) + 1e-12;
    for (size_t c = 0; c < CANDIDATES; ++c)
        total += spreads[c] = fmax(least, spread_near(of->candidates + 3 * c, xyz, values));
    size_t placed = FIRST;
    for (size_t c = 0; c < CANDIDATES && placed < COUNT; ++c) {
        passed += spreads[c] / total * FIRST;
        if (passed >= (double)(placed - FIRST) + 0.5)
            memcpy(xyz + 3 * placed++, of->candidates + 3 * c, 3 * sizeof *xyz);
    }
    for (; placed < COUNT; ++placed)
        memcpy(xyz + 3 * placed, of->candidates + 3 * (CANDIDATES - 1 - (COUNT - placed)), 3 * sizeof *xyz);
}

/* Squared errors of all methods under one light, and the learned s. */
static aur_result try_light(const learned_study *of, uint64_t seed, bool hard, double squares[WAYS],
                            double *learned, aur_error *error) {
    const lab_light light = lab_random_light(seed, hard);
    double xyz[3 * COUNT], values[COUNT], exact = 0.0, found[SMOOTH], best = -INFINITY;
    for (size_t i = 0; i < REFERENCE; ++i)
        exact += lab_radiance(&light, of->reference + 3 * i) / REFERENCE;
    aur_result result = lab_draw(&(lab_samples){of->set, COUNT, of->exponent, 0, seed}, xyz, NULL, error);
    for (size_t i = 0; i < COUNT; ++i)
        values[i] = lab_radiance(&light, xyz + 3 * i);
    squares[HINDSIGHT] = INFINITY;
    for (size_t s = 0; s < SMOOTH && result == AUR_OK; ++s) {
        result = estimate(of, s, xyz, values, &found[s], error);
        const double square = pow(found[s] - exact, 2), likely = likelihood(smoothness(s), xyz, values);
        squares[HINDSIGHT] = fmin(squares[HINDSIGHT], square);
        squares[FIXED] = s == 4 ? square : squares[FIXED];
        if (likely > best) {
            best = likely;
            squares[LEARNED] = square;
            *learned = smoothness(s);
        }
    }
    if (result == AUR_OK)
        result = lab_draw(&(lab_samples){of->set, FIRST, of->exponent, 0, seed}, xyz, NULL, error);
    if (result != AUR_OK)
        return result;
    for (size_t i = 0; i < FIRST; ++i)
        values[i] = lab_radiance(&light, xyz + 3 * i);
    place(of, xyz, values);
    for (size_t i = FIRST; i < COUNT; ++i)
        values[i] = lab_radiance(&light, xyz + 3 * i);
    result = estimate(of, 4, xyz, values, &found[0], error);
    squares[PLACED] = pow(found[0] - exact, 2);
    return result;
}

static aur_result study_set(learned_study *of, bool hard, size_t lights, aur_error *error) {
    enum { CELLS = WAYS * LIGHTS + 1 };
    double values[CELLS] = {0.0}, (*const squares)[LIGHTS] = (double(*)[LIGHTS])values;
    char key[200], exponent[16];
    snprintf(key, sizeof key, "m %g, %.120s, %d", of->exponent, of->set, hard);
    snprintf(exponent, sizeof exponent, "%g", of->exponent);
    aur_result result = AUR_OK;
    if (!lab_recall(of->run, key, CELLS, values)) {
        for (uint64_t seed = 0; seed < lights && result == AUR_OK; ++seed) {
            double one[WAYS] = {0.0}, learned = 0.0;
            result = try_light(of, seed, hard, one, &learned, error);
            for (size_t w = 0; w < WAYS; ++w)
                squares[w][seed] = one[w];
            values[CELLS - 1] += learned / (double)lights;
        }
        if (result == AUR_OK)
            result = lab_save(of->run, key, CELLS, values, error);
        if (result != AUR_OK)
            return result;
    }
    double over[WAYS];
    for (size_t w = 0; w < WAYS; ++w) {
        const lab_interval ratio = lab_root_ratio_paired(lights, squares[w], squares[FIXED]);
        over[w] = ratio.value;
        lab_row(of->run,
                (const char *const[]){exponent, of->set, hard ? "hard edges" : "smooth", way_names[w], NULL},
                5,
                (const double[]){lab_root_mean(lights, squares[w]).value, ratio.value, ratio.low, ratio.high,
                                 w == LEARNED ? values[CELLS - 1] : NAN});
    }
    lab_note(of->run, "m = %g, %s, %s: over s = 1.5: s learned (%.2f on average) %.2f, half placed %.2f",
             of->exponent, of->set, hard ? "hard edges" : "smooth", values[CELLS - 1], over[LEARNED],
             over[PLACED]);
    return AUR_OK;
}

static aur_result study_lobe(learned_study *of, aur_error *error) {
    const lab_options *const options = lab_run_options(of->run);
    const char *const sets[SETS] = {"spherical-fibonacci", "sobol", options->quick ? NULL : "random",
                                    options->set};
    aur_result result = AUR_OK;
    for (size_t s = 0; s < SMOOTH && result == AUR_OK; ++s)
        result = lab_lobe_potential(of->exponent, smoothness(s), &of->potentials[s], error);
    if (result == AUR_OK)
        result = lab_draw(&(lab_samples){"spherical-fibonacci", REFERENCE, of->exponent, 0, 0}, of->reference,
                          NULL, error);
    if (result == AUR_OK)
        result = lab_draw(&(lab_samples){"spherical-fibonacci", CANDIDATES, of->exponent, 0, 1},
                          of->candidates, NULL, error);
    for (size_t i = 0; i < 2 * SETS && result == AUR_OK; ++i) {
        of->set = sets[i / 2];
        if (of->set != NULL)
            result = lab_forgive(of->run, of->set,
                                 study_set(of, i % 2 == 1, options->quick ? 20 : LIGHTS, error), error);
    }
    for (size_t s = 0; s < SMOOTH; ++s) {
        aur_potential_destroy(of->potentials[s]);
        of->potentials[s] = NULL;
    }
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    static learned_study of;
    of = (learned_study){.run = run, .exponent = 20.0};
    aur_result result = study_lobe(&of, error);
    of.exponent = 1.0;
    return result != AUR_OK || lab_run_options(run)->quick ? result : study_lobe(&of, error);
}

const lab_experiment lab_marques_2018_learned = {
    .name = "marques-2018-learned",
    .reproduces = "Marques 2018, section 7: s and positions learned from samples",
    .summary =
        "the smoothness of each light by its likelihood, and samples placed by the spread of earlier ones",
    .columns = columns,
    .seconds = 3,
    .quick_seconds = 0.1,
    .run = run,
};

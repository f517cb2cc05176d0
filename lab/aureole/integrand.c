/* Compares sets on one function that a module or a program adds: the root mean square error of the mean
 * against the number of points, over independent randomisations. */
#include <aureole/sphere.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program/lab/lab.h"

enum { SMALLEST = 16, MOST_SIZES = 8, MOST_SEEDS = 256 };

static const char *const columns[] = {"set", "points", "rmse", "low", "high", "over_random", NULL};

/* --- functions with analytical means */

static aur_result quarter_disk(void *user, size_t count, size_t dimension, const double *points,
                               double *values, aur_error *error) {
    (void)user, (void)error;
    for (size_t i = 0; i < count; ++i, points += dimension)
        values[i] = points[0] * points[0] + points[1] * points[1] < 1.0 ? 1.0 : 0.0;
    return AUR_OK;
}

static aur_result exponential(void *user, size_t count, size_t dimension, const double *points,
                              double *values, aur_error *error) {
    (void)user, (void)error;
    for (size_t i = 0; i < count; ++i, points += dimension)
        values[i] = exp(points[0] + points[1]);
    return AUR_OK;
}

static aur_result clamped_cosine(void *user, size_t count, size_t dimension, const double *points,
                                 double *values, aur_error *error) {
    (void)user, (void)error;
    for (size_t i = 0; i < count; ++i, points += dimension)
        values[i] = fmax(0.0, 0.48 * points[0] + 0.6 * points[1] + 0.64 * points[2]);
    return AUR_OK;
}

static const lab_named_integrand *find(const char *name) {
    static const lab_named_integrand built_in[] = {
        {"quarter-disk", AUR_DOMAIN_SQUARE, 0, quarter_disk, NULL, 0.78539816339744830962},
        {"exponential", AUR_DOMAIN_SQUARE, 0, exponential, NULL, 2.9524924420125598},
        {"clamped-cosine", AUR_DOMAIN_SPHERE, 0, clamped_cosine, NULL, 0.25}};
    const lab_named_integrand *const added = lab_find_integrand(name);
    for (size_t i = 0; added == NULL && i < sizeof built_in / sizeof built_in[0]; ++i)
        if (strcmp(built_in[i].name, name) == 0)
            return &built_in[i];
    return added;
}

/* --- the estimate */

/* The randomisation of points that makes the estimate unbiased. */
static aur_scramble scrambling(aur_domain domain) {
    return domain == AUR_DOMAIN_SPHERE       ? AUR_SCRAMBLE_ROTATE3D
           : domain == AUR_DOMAIN_HEMISPHERE ? AUR_SCRAMBLE_ROTATE
                                             : AUR_SCRAMBLE_SHIFT;
}

static aur_result estimate(const lab_named_integrand *f, const char *set, size_t count, uint64_t seed,
                           double *mean, aur_error *error) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, f->domain, &options, NULL);
    options.scramble = scrambling(f->domain);
    options.seed = seed;
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    request.dimension = f->domain == AUR_DOMAIN_CUBE ? f->dimension : 0;
    aur_points *points;
    aur_result result = aur_points_generate(set, &request, &points, error);
    if (result != AUR_OK)
        return result;
    const aur_points_view *const view = aur_points_get_view(points);
    double *const values = malloc(count * sizeof *values);
    result = values == NULL ? aur_fail(error, AUR_ERROR_MEMORY, "out of memory")
                            : f->evaluate(f->user, count, view->dimension, view->coordinates, values, error);
    *mean = 0.0;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        *mean += values[i] * (view->weights != NULL ? view->weights[i] : 1.0 / (double)count);
    free(values);
    aur_points_destroy(points);
    return result;
}

typedef struct study {
    lab_run *run;
    const lab_named_integrand *f;
    size_t sizes, seeds;
    double reference;
    double random[MOST_SIZES]; /* mean square errors of random points */
} study;

static aur_result measure(const study *s, const char *set, size_t count, double *squares, aur_error *error) {
    char key[300];
    snprintf(key, sizeof key, "%s %.200s %zu", s->f->name, set, count);
    if (lab_recall(s->run, key, s->seeds, squares))
        return AUR_OK;
    for (size_t k = 0; k < s->seeds; ++k) {
        double mean;
        const aur_result result = estimate(s->f, set, count, 1 + k, &mean, error);
        if (result != AUR_OK)
            return result;
        squares[k] = (mean - s->reference) * (mean - s->reference);
    }
    return lab_save(s->run, key, s->seeds, squares, error);
}

static aur_result add_set(study *s, const char *set, aur_error *error) {
    double counts[MOST_SIZES], rms[MOST_SIZES], squares[MOST_SEEDS];
    size_t row_count = 0;
    for (size_t i = 0; i < s->sizes; ++i) {
        const size_t count = (size_t)SMALLEST << i;
        const aur_result result = measure(s, set, count, squares, error);
        if (result != AUR_OK && lab_forgive(s->run, set, result, error) != AUR_OK)
            return result;
        if (result != AUR_OK)
            continue;
        const lab_interval rmse = lab_root_mean(s->seeds, squares);
        if (strcmp(set, "random") == 0)
            s->random[i] = rmse.value;
        counts[row_count] = (double)count;
        rms[row_count++] = rmse.value;
        lab_row(s->run, (const char *const[]){set, NULL}, 5,
                (const double[]){(double)count, rmse.value, rmse.low, rmse.high,
                                 s->random[i] > 0.0 ? rmse.value / s->random[i] : NAN});
    }
    if (row_count < 3)
        return AUR_OK;
    const lab_interval slope = lab_slope(row_count, counts, rms);
    lab_note(s->run, "%s: error falls as N^%.3f (%.3f to %.3f)", set, slope.value, slope.low, slope.high);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    const char *const name = lab_parameter_text(run, "integrand");
    const double seeds = lab_parameter_number(run, "seeds");
    study s = {.run = run, .f = find(name), .sizes = options->quick ? 5 : MOST_SIZES};
    if (s.f == NULL)
        return aur_fail(
            error, AUR_ERROR_NAME,
            "unknown integrand '%s': expected quarter-disk, exponential, clamped-cosine or one of "
            "--module",
            name);
    if (!(seeds >= 2.0 && seeds <= MOST_SEEDS))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "seeds must be 2 to %d", MOST_SEEDS);
    s.seeds = options->quick && seeds > 16.0 ? 16 : (size_t)seeds;
    s.reference = s.f->mean;
    aur_result result = AUR_OK;
    if (isnan(s.reference)) {
        result = estimate(s.f, "sobol", options->quick ? 1 << 16 : 1 << 20, 12345, &s.reference, error);
        lab_note(run, "the mean %.9g is that of many Sobol' points", s.reference);
    }
    const bool sphere = s.f->domain == AUR_DOMAIN_SPHERE || s.f->domain == AUR_DOMAIN_HEMISPHERE;
    const char *const sets[] = {"random",    "jittered", "halton",
                                "sobol",     "r2",       sphere ? "spherical-fibonacci" : "hammersley",
                                options->set};
    for (size_t i = 0; i < sizeof sets / sizeof sets[0] && result == AUR_OK; ++i)
        if (sets[i] != NULL && (s.f->domain != AUR_DOMAIN_CUBE || strcmp(sets[i], "r2") != 0))
            result = add_set(&s, sets[i], error);
    return result;
}

static const lab_parameter parameters[] = {
    {"integrand", "quarter-disk",
     "quarter-disk, exponential (square), clamped-cosine (sphere), or one of --module"},
    {"seeds", "64", "independent randomisations, 2 to 256; at most 16 in the quick form"},
    {.name = NULL},
};

static const report_plot plots[] = {
    {.name = "rmse",
     .title = "Root mean square error against the number of points",
     .x = "points",
     .y = "rmse",
     .low = "low",
     .high = "high",
     .series = "set",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_aureole_integrand = {
    .name = "aureole-integrand",
    .reproduces = "none: any function, --integrand",
    .summary = "root mean square error of every set on one function, against the number of points",
    .columns = columns,
    .plots = plots,
    .seconds = 0.1,
    .quick_seconds = 0.1,
    .run = run,
    .parameters = parameters,
};

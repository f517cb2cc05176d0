/* Energy and smallest distance against the number of points, four sets under two maps, on the hemisphere and
 * on the sphere, with the slope of every curve (Marques 2013, fig. 3). */
#include <aureole/quality.h>
#include <math.h>
#include <string.h>

#include "patterns.h"

enum { SIZES = 7, QUICK_SIZES = 4, SMALLEST = 64, METRICS = 2, MOST_SEEDS = 16, DOMAINS = 2 };

static const char *const metrics[METRICS] = {"energy", "min-distance"};
static const aur_domain domains[DOMAINS] = {AUR_DOMAIN_HEMISPHERE, AUR_DOMAIN_SPHERE};
/* "Approximately" the paper's rate is taken to mean within `near`, a factor of 1.2 from 64 to 4096 points. */
static const double rate = -0.75, near = 0.05;

/* Means over seeds. */
typedef struct curve {
    double sizes[SIZES], values[METRICS][SIZES];
} curve;

typedef struct study {
    lab_run *run;
    report_table *slopes;
    aur_domain domain;
    size_t size_count, seeds;
    curve base; /* of spherical Fibonacci */
    size_t others, above, closer;
} study;

static aur_result measure(const study *s, const marques_pattern *pattern, size_t count, uint64_t seed,
                          double value[METRICS], aur_error *error) {
    aur_points *points;
    aur_measure_options how = {.size = sizeof how};
    aur_measure_options_init(&how, NULL);
    how.threads = lab_run_options(s->run)->threads;
    aur_result result = marques_points(pattern, s->domain, count, seed, &points, error);
    for (size_t m = 0; m < METRICS && result == AUR_OK; ++m)
        result = aur_measure(metrics[m], aur_points_get_view(points), &how, &value[m], error);
    aur_points_destroy(points);
    return result;
}

static aur_result add_size(study *s, const marques_pattern *pattern, size_t k, curve *c, aur_error *error) {
    const size_t count = (size_t)SMALLEST << k;
    double values[METRICS][MOST_SEEDS], mean[METRICS], half[METRICS];
    for (size_t seed = 0; seed < s->seeds; ++seed) {
        double value[METRICS];
        const aur_result result = measure(s, pattern, count, seed, value, error);
        if (result != AUR_OK)
            return result;
        for (size_t m = 0; m < METRICS; ++m)
            values[m][seed] = value[m];
    }
    c->sizes[k] = (double)count;
    for (size_t m = 0; m < METRICS; ++m) {
        lab_mean_interval(s->seeds, values[m], &mean[m], &half[m]);
        c->values[m][k] = mean[m];
    }
    lab_row(s->run, (const char *const[]){aur_domain_name(s->domain), pattern->set, pattern->label, NULL}, 8,
            (const double[]){(double)count, mean[0], mean[0] - half[0], mean[0] + half[0],
                             mean[0] * pow((double)count, -rate), mean[1], mean[1] - half[1],
                             mean[1] + half[1]});
    return AUR_OK;
}

static aur_result add_curve(study *s, const marques_pattern *pattern, aur_error *error) {
    curve c;
    for (size_t k = 0; k < s->size_count; ++k) {
        const aur_result result = add_size(s, pattern, k, &c, error);
        if (result != AUR_OK)
            return result;
    }
    const bool is_base = strcmp(pattern->set, "spherical-fibonacci") == 0;
    for (size_t k = 0; k < s->size_count && !is_base; ++k) {
        ++s->others;
        s->above += c.values[0][k] > s->base.values[0][k];
        s->closer += c.values[1][k] < s->base.values[1][k];
    }
    if (is_base)
        s->base = c;
    lab_interval slopes[METRICS];
    for (size_t m = 0; m < METRICS; ++m)
        slopes[m] = lab_slope(s->size_count, c.sizes, c.values[m]);
    lab_table_row(s->slopes,
                  (const char *const[]){aur_domain_name(s->domain), pattern->set, pattern->label, NULL}, 6,
                  (const double[]){slopes[0].value, slopes[0].low, slopes[0].high, slopes[1].value,
                                   slopes[1].low, slopes[1].high});
    const bool exception = strcmp(pattern->set, "bnot") == 0 && pattern->map == AUR_MAP_CONCENTRIC;
    const bool falls = fabs(slopes[0].value - rate) <= near;
    lab_claim(s->run, falls != exception, "%s, %s, %s: the energy %s as N^%g: slope %.3f [%.3f, %.3f]",
              aur_domain_name(s->domain), pattern->set, pattern->label, exception ? "does not fall" : "falls",
              rate, slopes[0].value, slopes[0].low, slopes[0].high);
    return AUR_OK;
}

static aur_result study_domain(study *s, aur_error *error) {
    marques_pattern patterns[MARQUES_PATTERNS];
    const size_t count = marques_patterns(s->run, patterns);
    s->others = s->above = s->closer = 0;
    aur_result result = AUR_OK;
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        result = lab_forgive(s->run, patterns[i].set, add_curve(s, &patterns[i], error), error);
    if (result != AUR_OK)
        return result;
    lab_claim(s->run, s->above == s->others,
              "%s: spherical Fibonacci points have the lowest energy: lower than in %zu of %zu",
              aur_domain_name(s->domain), s->above, s->others);
    lab_claim(s->run, s->closer == s->others,
              "%s: their smallest distance is the largest: larger than in %zu of %zu",
              aur_domain_name(s->domain), s->closer, s->others);
    return AUR_OK;
}

static const char *const columns[] = {"domain",       "set",        "map",         "n",
                                      "energy",       "energy_low", "energy_high", "energy_times",
                                      "min_distance", "min_low",    "min_high",    NULL};

static aur_result run(lab_run *run, aur_error *error) {
    static const char *const of_slopes[] = {"domain", "set",       "map",           "energy_slope",   "low",
                                            "high",   "min_slope", "min_slope_low", "min_slope_high", NULL};
    const bool quick = lab_run_options(run)->quick;
    study s = {.run = run,
               .slopes = lab_table(run, "slopes", of_slopes),
               .size_count = quick ? QUICK_SIZES : SIZES,
               .seeds = quick ? 4 : MOST_SEEDS};
    aur_result result = AUR_OK;
    for (size_t d = 0; d < DOMAINS && result == AUR_OK; ++d) {
        s.domain = domains[d];
        result = study_domain(&s, error);
    }
    return result;
}

static const report_plot plots[] = {
    {.name = "energy",
     .title = "Energy times N^(3/4) against the number of points",
     .x = "n",
     .y = "energy_times",
     .series = "set,map",
     .panel = "domain",
     .log_x = true},
    {.name = "min-distance",
     .title = "Smallest distance of two points against their number",
     .x = "n",
     .y = "min_distance",
     .low = "min_low",
     .high = "min_high",
     .series = "set,map",
     .panel = "domain",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2013_fig3 = {
    .name = "marques-2013-fig3",
    .reproduces = "Marques 2013, fig. 3",
    .summary = "energy and smallest distance of four sets under two maps against N, with slopes",
    .columns = columns,
    .plots = plots,
    .seconds = 2,
    .quick_seconds = 0.1,
    .run = run,
};

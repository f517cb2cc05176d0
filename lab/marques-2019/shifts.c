/* The cost of E-SFG's shifts: the sub-grid that doubles a grid, by the rule of eq. 56 or the best of the
 * three, and centring for the last size only or for each (Marques 2019, sections 5.1 and 5.3). */
#include <math.h>
#include <stdio.h>

#include "program/lab/lab.h"
#include "program/lab/points.h"

enum { FIRST_BASE = 8, LAST_BASE = 256, QUICK_BASE = 40, LEVELS = 3 };

static const char *const columns[] = {"step", "base", "points", "paper", "best", "per_level", NULL};
static const char *const of_choices[] = {
    "domain", "grids", "rule_is_best", "percent_mean", "percent_most", "most_at_base", NULL};

static aur_result discrepancy(lab_run *run, const char *keys, size_t base, size_t size, aur_domain domain,
                              double *scd, aur_error *error) {
    char set[128];
    snprintf(set, sizeof set, "esfg:base=%zu,%s", base, keys);
    const lab_points points = {.set = set, .domain = domain, .size = size};
    return lab_figure(&points, "scd", lab_run_options(run)->threads, scd, error);
}

/* Percent above spherical Fibonacci for all sizes of one grid; *most is the maximum for each choice, without
 * the last size, which all choices centre. */
static aur_result add_grid(lab_run *run, size_t base, size_t levels, double most[2][3], aur_error *error) {
    static const char *const choices[] = {"first-shift=paper", "first-shift=best",
                                          "first-shift=best,shift=per-level"};
    for (size_t step = 0; step <= 2 * levels; ++step) {
        const size_t size = base << step;
        const lab_points plain = {.set = "spherical-fibonacci", .domain = AUR_DOMAIN_SPHERE, .size = size};
        double least, percent[3];
        aur_result result = lab_figure(&plain, "scd", lab_run_options(run)->threads, &least, error);
        if (result != AUR_OK)
            return result;
        for (size_t c = 0; c < 3; ++c) {
            char keys[96];
            snprintf(keys, sizeof keys, "levels=%zu,%s", levels, choices[c]);
            result = discrepancy(run, keys, base, size, AUR_DOMAIN_SPHERE, &percent[c], error);
            if (result != AUR_OK)
                return result;
            percent[c] = 100.0 * (percent[c] / least - 1.0);
            if (step < 2 * levels)
                most[step % 2][c] = fmax(most[step % 2][c], percent[c]);
        }
        lab_row(run, (const char *const[]){step % 2 == 1 ? "x2" : "x4", NULL}, 5,
                (const double[]){(double)base, (double)size, percent[0], percent[1], percent[2]});
    }
    return AUR_OK;
}

/* All bases, doubled once: how often eq. 56 selects the best of the three sub-grids, and the cost otherwise.
 */
static aur_result survey(lab_run *run, report_table *table, aur_domain domain, aur_error *error) {
    const size_t last = lab_run_options(run)->quick ? QUICK_BASE : LAST_BASE;
    size_t best = 0, grids = 0, worst = 0;
    double mean = 0.0, most = 0.0;
    for (size_t base = FIRST_BASE; base <= last; ++base, ++grids) {
        double published, least;
        aur_result result = discrepancy(run, "levels=1,shift=final,first-shift=paper", base, 2 * base, domain,
                                        &published, error);
        if (result == AUR_OK)
            result = discrepancy(run, "levels=1,shift=final,first-shift=best", base, 2 * base, domain, &least,
                                 error);
        if (result != AUR_OK)
            return result;
        const double percent = 100.0 * (published / least - 1.0);
        best += published <= least;
        mean += percent;
        if (percent > most) {
            most = percent;
            worst = base;
        }
    }
    const char *const name = domain == AUR_DOMAIN_SPHERE ? "sphere" : "hemisphere";
    lab_table_row(table, (const char *const[]){name, NULL}, 5,
                  (const double[]){(double)grids, (double)best, mean / (double)grids, most, (double)worst});
    lab_claim(run, best == grids,
              "5.3, eq. 56 on the %s: the best first shift (of the three in %zu of %zu grids; it costs %.1f "
              "%% of SCD "
              "in the mean, at most %.0f %%, base %zu)",
              name, best, grids, mean / (double)grids, most, worst);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    static const size_t bases[] = {64, 8, 20, 33, 40, 89, 100};
    const bool quick = lab_run_options(run)->quick;
    report_table *const choices = lab_table(run, "first-shift", of_choices);
    double most[2][3] = {{0.0}};
    aur_result result = AUR_OK;
    for (size_t b = 0; b < (quick ? 2 : sizeof bases / sizeof bases[0]) && result == AUR_OK; ++b)
        result = add_grid(run, bases[b], quick ? 2 : LEVELS, most, error);
    if (result != AUR_OK)
        return result;
    lab_claim(run, most[0][0] < most[0][2] + 1.0,
              "5.1: the single final shift has no discernible impact on lower levels, 1 %% (quadrupled sizes "
              "are up to "
              "%.1f %% above spherical Fibonacci, centred by themselves %.1f %%)",
              most[0][0], most[0][2]);
    lab_claim(
        run, most[1][0] < most[0][0] + 5.0,
        "5.3: doubled sizes of these bases are in line with quadrupled ones within 5 %% (up to %.1f %% above "
        "spherical Fibonacci by the paper's first shift, %.1f %% by the best one; quadrupled %.1f %%)",
        most[1][0], most[1][1], most[0][0]);
    result = survey(run, choices, AUR_DOMAIN_SPHERE, error);
    return result != AUR_OK ? result : survey(run, choices, AUR_DOMAIN_HEMISPHERE, error);
}

static const report_plot plots[] = {
    {.name = "paper",
     .title = "Percent of SCD over spherical Fibonacci, first shift by eq. 56",
     .x = "points",
     .y = "paper",
     .series = "base",
     .panel = "step",
     .log_x = true},
    {.name = "per-level",
     .title = "Percent of SCD over spherical Fibonacci, each size centred by itself, best first shift",
     .x = "points",
     .y = "per_level",
     .series = "base",
     .panel = "step",
     .log_x = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2019_shifts = {
    .name = "marques-2019-shifts",
    .reproduces = "Marques 2019, sections 5.1 and 5.3",
    .summary = "percent of spherical cap discrepancy that the choices of E-SFG's shifts cost",
    .columns = columns,
    .plots = plots,
    .takes_no_set = "the table is of keys that other sets do not have",
    .seconds = 0.4,
    .quick_seconds = 0.1,
    .run = run,
};

/* Spherical cap discrepancy against the number of points (Marques 2019, fig. 9), and the paper's statements
 * on the figure. The rates in its legend are only in an image; the text states N^(-3/4). */
#include <math.h>
#include <string.h>

#include "program/lab/lab.h"
#include "program/lab/points.h"

enum { SIZES = 7, BASE = 64, FIRST_CANDIDATE = 3, SETS = 6 };

static const char *const sets[SETS] = {"spherical-fibonacci",
                                       "esfg:base=64,levels=3,first-shift=paper",
                                       "esfg:base=64,levels=3",
                                       "sobol",
                                       "faure",
                                       "faure:base=3"};

static const char *const columns[] = {"set", "step", "points", "scd", "percent_over_sf", "scd_n34", NULL};
static const char *const of_slopes[] = {"set", "slope", "slope_low", "slope_high", NULL};

/* From 64 points, doubled in the odd steps. */
static size_t size_at(size_t step) {
    return (size_t)BASE << step;
}

/* Over sizes that quadruple. */
static lab_interval slope_of(size_t count, const double scd[SIZES]) {
    double sizes[SIZES], values[SIZES];
    size_t used = 0;
    for (size_t k = 0; k < count; k += 2, ++used) {
        sizes[used] = (double)size_at(k);
        values[used] = scd[k];
    }
    return lab_slope(used, sizes, values);
}

static aur_result measure(lab_run *run, const char *set, size_t count, double scd[SIZES], aur_error *error) {
    for (size_t k = 0; k < count; ++k) {
        const lab_points points = {.set = set, .domain = AUR_DOMAIN_SPHERE, .size = size_at(k)};
        const aur_result result = lab_figure(&points, "scd", lab_run_options(run)->threads, &scd[k], error);
        if (result != AUR_OK)
            return result;
    }
    return AUR_OK;
}

static void add_rows(lab_run *run, report_table *slopes, const char *set, size_t count,
                     const double scd[SIZES], const double fibonacci[SIZES]) {
    for (size_t k = 0; k < count; ++k) {
        const double n = (double)size_at(k);
        lab_row(run, (const char *const[]){set, k % 2 == 1 ? "x2" : "x4", NULL}, 4,
                (const double[]){n, scd[k], 100.0 * (scd[k] / fibonacci[k] - 1.0), scd[k] * pow(n, 0.75)});
    }
    const lab_interval slope = slope_of(count, scd);
    lab_table_row(slopes, (const char *const[]){set, NULL}, 3,
                  (const double[]){slope.value, slope.low, slope.high});
}

/* The claims of sections 5.3 and 6.1 for the grid with the paper's first shift, and with the library's. */
static void judge(lab_run *run, size_t grid, size_t count, double scd[SETS][SIZES]) {
    const double *const of_grid = scd[grid], *const fibonacci = scd[0];
    double most = 0.0, doubled = 0.0, line = 0.0;
    size_t below = 0, compared = 0;
    bool steeper = true;
    for (size_t k = 0; k < count; ++k) {
        const double over = 100.0 * (of_grid[k] / fibonacci[k] - 1.0);
        if (k % 2 == 0)
            most = fmax(most, over);
        else {
            doubled = fmax(doubled, over);
            line = fmax(line, 100.0 * (of_grid[k] / sqrt(of_grid[k - 1] * of_grid[k + 1]) - 1.0));
        }
        for (size_t r = FIRST_CANDIDATE; r < SETS; ++r, ++compared)
            below += of_grid[k] < scd[r][k];
    }
    for (size_t r = FIRST_CANDIDATE; r < SETS; ++r)
        steeper = steeper && slope_of(count, of_grid).value < slope_of(count, scd[r]).value;
    const double slope = slope_of(count, of_grid).value;
    lab_note(run, "%s:", sets[grid]);
    lab_claim(run, most < 10.0,
              "6.1: quadrupled, the same as spherical Fibonacci within 10 %% (at most %.1f %% above)", most);
    lab_claim(run, below == compared,
              "6.1: below Sobol and Faure at every size, doubled ones too (%zu of %zu)", below, compared);
    lab_claim(run, steeper, "6.1: falls faster than Sobol and Faure");
    lab_claim(run, fabs(slope + 0.75) < 0.02, "6.1: falls about as N^(-3/4) (slope %.3f)", slope);
    lab_claim(run, line < 5.0,
              "5.3, 6.1: doubled sizes are in line with quadrupled ones within 5 %% (at most %.1f %% above "
              "the line "
              "through the sizes about them, %.1f %% above spherical Fibonacci)",
              line, doubled);
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    const size_t count = options->quick ? 5 : SIZES;
    report_table *const slopes = lab_table(run, "slopes", of_slopes);
    double scd[SETS][SIZES], added[SIZES];
    aur_result result = AUR_OK;
    for (size_t s = 0; s < SETS && result == AUR_OK; ++s) {
        result = measure(run, sets[s], count, scd[s], error);
        if (result == AUR_OK)
            add_rows(run, slopes, sets[s], count, scd[s], scd[0]);
    }
    for (size_t g = 1; g < FIRST_CANDIDATE && result == AUR_OK; ++g)
        judge(run, g, count, scd);
    if (result == AUR_OK)
        lab_note(run, "Faure's sequence in base 2 %s Sobol's in the plane",
                 memcmp(scd[3], scd[4], count * sizeof(double)) == 0 ? "has the discrepancies of"
                                                                     : "differs from");
    if (result != AUR_OK || options->set == NULL)
        return result;
    result = measure(run, options->set, count, added, error);
    if (result == AUR_OK)
        add_rows(run, slopes, options->set, count, added, scd[0]);
    return lab_forgive(run, options->set, result, error);
}

static const report_plot plots[] = {
    {.name = "scd",
     .title = "Spherical cap discrepancy times N^(3/4)",
     .x = "points",
     .y = "scd_n34",
     .series = "set",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2019_discrepancy = {
    .name = "marques-2019-discrepancy",
    .reproduces = "Marques 2019, fig. 9, sections 5.3 and 6.1",
    .summary = "spherical cap discrepancy of E-SFG, spherical Fibonacci, Sobol and Faure, with slopes",
    .columns = columns,
    .plots = plots,
    .seconds = 0.1,
    .quick_seconds = 0.1,
    .run = run,
};

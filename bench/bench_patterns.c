/* Whether the error of adaptive images has spatial patterns: the correlation of the errors of neighboring
 * pixels, measured against the reference. The reference's error is estimated by half the difference of its
 * two images, whose sums are subtracted. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "adaptive_scene.h"
#include "child.h"
#include "error_pattern.h"
#include "figures.h"

/* Sampling patterns repeat every four pixels in interleaved paths and gathering, or every eight with
 * complementary patterns (share=near). */
enum { BLOCK = 8, MOST_LAG = 8, PERIOD = 4, PERIODS = 2, SEEDS = 32, QUICK_SEEDS = 2, FIRST_SEED = 7001 };

/* Limit of the ratio to independent pixel noise. */
static const double most_clumps = 1.5;

/* Limit of a peak in standard errors, estimated from the spread over seeds. Four peaks of 18 rows: one false
 * alarm per hundred runs of the bench (1 - .01 / 72 of Student's distribution with SEEDS - 1 degrees of
 * freedom). The standard error from one seed assumes independent pixels and may be too small: in Keller's
 * office the spread of 64 seeds was 1.2 times that, with a peak of 1.7 where eight seeds had a peak of 4.8.
 */
static const double most_peak = 4.10;

typedef struct pattern_sum {
    size_t seeds, gathered;
    error_blocks blocks;
    double products[2][MOST_LAG + 1]; /* along rows and columns; lag 0: squares */
    double peaks[2][PERIODS][SEEDS];  /* in standard errors estimated from one seed */
    double clumps[SEEDS], between; /* clumps: per seed; between: sum over the differences of pairs of seeds */
} pattern_sum;

static double clumps_of(const error_blocks *squares) {
    return squares->of_each > 0.0 ? sqrt(fmax(squares->of_sums, 0.0) / squares->of_each) : 0.0;
}

/* Adds the sums of an image's error, minus those of the reference's error. */
static void add(const bench_adaptive_scene *adaptive_scene, const error_pattern *error,
                const error_pattern *reference, pattern_sum *sum) {
    const error_blocks image_blocks = error_pattern_blocks(error, BLOCK),
                       reference_blocks = error_pattern_blocks(reference, BLOCK);
    const error_blocks squares = {image_blocks.of_sums - reference_blocks.of_sums,
                                  image_blocks.of_each - reference_blocks.of_each};
    const double unit = adaptive_scene->mean * adaptive_scene->mean;
    sum->blocks.of_sums += squares.of_sums / unit;
    sum->blocks.of_each += squares.of_each / unit;
    sum->clumps[sum->seeds] = clumps_of(&squares);
    for (size_t down = 0; down < 2; ++down) {
        for (size_t lag = 0; lag <= MOST_LAG; ++lag)
            sum->products[down][lag] += (error_pattern_product(error, lag, down != 0) -
                                         error_pattern_product(reference, lag, down != 0)) /
                                        unit;
        for (size_t i = 0; i < PERIODS; ++i)
            sum->peaks[down][i][sum->seeds] = error_pattern_peak(error, PERIOD * (i + 1), down != 0);
    }
    ++sum->seeds;
}

/* Adds images of two seeds: the pattern of each, and of their difference, where a common error cancels. */
static aur_result add_pair(const bench_adaptive_scene *adaptive_scene, uint64_t seed, pattern_sum *sum,
                           aur_error *error) {
    double values[2][BENCH_ADAPTIVE_MOST_VALUES];
    error_pattern reference = {adaptive_scene->width, adaptive_scene->height,
                               (double *)adaptive_scene->reference_error};
    aur_result result = AUR_OK;
    for (size_t k = 0; k < 2 && result == AUR_OK; ++k) {
        aur_adaptive *adaptive = NULL;
        aur_image *image = NULL;
        result = bench_adaptive_scene_render(adaptive_scene, seed + k, &adaptive, &image, error);
        for (size_t i = 0; i < adaptive_scene->count && result == AUR_OK; ++i)
            values[k][i] = (double)aur_image_data(image)[i] - adaptive_scene->values[i];
        if (result == AUR_OK) {
            sum->gathered += strstr(aur_adaptive_integrator(adaptive), "finalgather") != NULL;
            add(adaptive_scene, &(error_pattern){adaptive_scene->width, adaptive_scene->height, values[k]},
                &reference, sum);
        }
        aur_image_destroy(image);
        aur_adaptive_destroy(adaptive);
    }
    for (size_t i = 0; i < adaptive_scene->count; ++i)
        values[0][i] -= values[1][i];
    sum->between += error_pattern_clumps(
        &(error_pattern){adaptive_scene->width, adaptive_scene->height, values[0]}, BLOCK);
    return result;
}

typedef struct average {
    double mean, standard_error;
} average;

static average average_of(size_t count, const double *seeds) {
    const double n = (double)count;
    double mean = 0.0, squares = 0.0;
    for (size_t i = 0; i < count; ++i)
        mean += seeds[i] / n;
    for (size_t i = 0; i < count; ++i)
        squares += (seeds[i] - mean) * (seeds[i] - mean);
    return (average){mean, sqrt(squares / (n * (n - 1.0)))};
}

static double print(const char *name, const bench_adaptive_scene *adaptive_scene, const pattern_sum *found) {
    const double n = (double)found->seeds;
    double most = -INFINITY;
    printf("  %-34.34s %6.3g %6.2f %6.2f %6.2f +- %.2f %7.2f\n", name, adaptive_scene->row.target_error,
           (double)found->gathered / n, sqrt(found->products[0][0] / n) / adaptive_scene->row.target_error,
           clumps_of(&found->blocks), average_of(found->seeds, found->clumps).standard_error,
           2.0 * found->between / n);
    for (size_t down = 0; down < 2; ++down) {
        printf("    %-7s", down != 0 ? "columns" : "rows");
        for (size_t lag = 1; lag <= MOST_LAG; ++lag)
            printf(" %5.2f", found->products[down][lag] / found->products[down][0]);
        printf("  peaks");
        for (size_t i = 0; i < PERIODS; ++i) {
            const average of_seeds = average_of(found->seeds, found->peaks[down][i]);
            const double peak = of_seeds.mean / of_seeds.standard_error;
            printf(" %.1f", peak);
            most = fmax(most, peak);
        }
        printf("\n");
    }
    fflush(stdout);
    return most;
}

static aur_result study(const bench_options *options, const bench_adaptive_row *row, const char *name,
                        const char *folder, bench_figures *figures, aur_error *error) {
    bench_adaptive_scene adaptive_scene;
    pattern_sum found = {.seeds = 0};
    aur_result result = bench_adaptive_scene_open(options, row, folder, &adaptive_scene, error);
    for (size_t i = 0; i < (options->quick ? QUICK_SEEDS : SEEDS) && result == AUR_OK; i += 2)
        result = add_pair(&adaptive_scene, FIRST_SEED + i, &found, error);
    bench_adaptive_scene_close(&adaptive_scene);
    if (result != AUR_OK)
        return result;
    const double peak = print(name, &adaptive_scene, &found);
    bench_figures_add(figures, BENCH_AT_MOST, most_clumps, clumps_of(&found.blocks), "",
                      "%s: 8 x 8 means / independent noise's", name);
    bench_figures_add(figures, BENCH_AT_MOST, most_peak, peak, "", "%s: most peak / its standard error",
                      name);
    return AUR_OK;
}

/* The bundled scenes with the target errors of small images; the images here are larger, for more blocks. */
static bool run(const bench_options *options) {
    char folder[4000];
    if (!bench_data_folder(folder, sizeof folder))
        return false;
    bench_figures figures = {0};
    printf("  %-34s %6s %6s %6s %14s %7s\n", "scene", "target", "gather", "error", "8 x 8 means", "between");
    for (size_t i = 0; i < bench_adaptive_row_count && !(options->quick && i > 0); ++i) {
        bench_adaptive_row row = bench_adaptive_rows[i];
        if (row.scene[0] == '.')
            continue;
        char name[64];
        snprintf(name, sizeof name, "%.50s%s", row.scene, row.scale > 1 ? ", fine" : "");
        if (!options->quick)
            row.scale = BENCH_ADAPTIVE_MOST_SCALE;
        aur_error error = {0};
        if ((options->only == NULL || strstr(name, options->only) != NULL) &&
            study(options, &row, name, folder, &figures, &error) != AUR_OK)
            printf("  %s: left out: %s\n", name, error.message);
    }
    if (figures.count == 0)
        return bench_fail("no scene was rendered");
    bench_figures_print(&figures);
    return true;
}

const bench bench_patterns = {"patterns",
                              "whether errors of neighboring pixels are correlated in adaptive images", run};

/* Whether images to an error have patterns in it: how far neighbouring pixels are wrong alike, beside the
 * truth. What the truth is wrong by itself is told by half the difference of its two images, whose sums are
 * taken from those of the errors. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "adaptive_scene.h"
#include "child.h"
#include "error_pattern.h"
#include "figures.h"

/* A pixel has the numbers of one four pixels on, in interleaved paths and gathering, or eight, where patterns
 * complete each other (share=near). */
enum { BLOCK = 8, MOST_LAG = 8, PERIOD = 4, PERIODS = 2, SEEDS = 32, QUICK_SEEDS = 2, FIRST_SEED = 7001 };

/* Half as much more than independent noise of the pixels. */
static const double most_clumps = 1.5;

/* Of a peak in standard errors, which the seeds' spread tells: of four of 15 scenes and three finer rows one
 * is above by chance in one bench of a hundred (1 - .01 / 72 of Student's distribution of SEEDS - 1 degrees).
 * One seed's own standard error, for which its pixels are independent, may be too small: in Keller's office
 * 64 seeds differed by 1.2 of it, and had a peak of 1.7 where eight seeds had shown one of 4.8. */
static const double most_peak = 4.10;

typedef struct alike {
    size_t seeds, gathered;
    error_blocks blocks;
    double products[2][MOST_LAG + 1]; /* along rows and columns; of lag 0: squares */
    double peaks[2][PERIODS][SEEDS];  /* in standard errors that the seed tells itself */
    double clumps[SEEDS], between;    /* of one seed; of the differences of pairs of them, added up */
} alike;

static double clumps_of(const error_blocks *squares) {
    return squares->of_each > 0.0 ? sqrt(fmax(squares->of_sums, 0.0) / squares->of_each) : 0.0;
}

/* The sums of an image's error, less those of the truth's own. */
static void add(const bench_adaptive_scene *known, const error_pattern *error, const error_pattern *own,
                alike *sum) {
    const error_blocks seen = error_pattern_blocks(error, BLOCK),
                       known_off = error_pattern_blocks(own, BLOCK);
    const error_blocks squares = {seen.of_sums - known_off.of_sums, seen.of_each - known_off.of_each};
    const double unit = known->mean * known->mean;
    sum->blocks.of_sums += squares.of_sums / unit;
    sum->blocks.of_each += squares.of_each / unit;
    sum->clumps[sum->seeds] = clumps_of(&squares);
    for (size_t down = 0; down < 2; ++down) {
        for (size_t lag = 0; lag <= MOST_LAG; ++lag)
            sum->products[down][lag] +=
                (error_pattern_product(error, lag, down != 0) - error_pattern_product(own, lag, down != 0)) /
                unit;
        for (size_t i = 0; i < PERIODS; ++i)
            sum->peaks[down][i][sum->seeds] = error_pattern_peak(error, PERIOD * (i + 1), down != 0);
    }
    ++sum->seeds;
}

/* Images of two seeds: what each is wrong by, and what they are not wrong by alike. */
static aur_result add_pair(const bench_adaptive_scene *known, uint64_t seed, alike *sum, aur_error *error) {
    double values[2][BENCH_ADAPTIVE_MOST_VALUES];
    error_pattern own = {known->width, known->height, (double *)known->wrong};
    aur_result result = AUR_OK;
    for (size_t k = 0; k < 2 && result == AUR_OK; ++k) {
        aur_adaptive *adaptive = NULL;
        aur_image *image = NULL;
        result = bench_adaptive_scene_render(known, seed + k, &adaptive, &image, error);
        for (size_t i = 0; i < known->count && result == AUR_OK; ++i)
            values[k][i] = (double)aur_image_data(image)[i] - known->values[i];
        if (result == AUR_OK) {
            sum->gathered += strstr(aur_adaptive_integrator(adaptive), "finalgather") != NULL;
            add(known, &(error_pattern){known->width, known->height, values[k]}, &own, sum);
        }
        aur_image_destroy(image);
        aur_adaptive_destroy(adaptive);
    }
    for (size_t i = 0; i < known->count; ++i)
        values[0][i] -= values[1][i];
    sum->between += error_pattern_clumps(&(error_pattern){known->width, known->height, values[0]}, BLOCK);
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

static double print(const char *name, const bench_adaptive_scene *known, const alike *found) {
    const double n = (double)found->seeds;
    double most = -INFINITY;
    printf("  %-34.34s %5.3g %6.2f %6.2f %6.2f +- %.2f %7.2f\n", name, known->row.asked,
           (double)found->gathered / n, sqrt(found->products[0][0] / n) / known->row.asked,
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
    bench_adaptive_scene known;
    alike found = {.seeds = 0};
    aur_result result = bench_adaptive_scene_open(options, row, folder, &known, error);
    for (size_t i = 0; i < (options->quick ? QUICK_SEEDS : SEEDS) && result == AUR_OK; i += 2)
        result = add_pair(&known, FIRST_SEED + i, &found, error);
    bench_adaptive_scene_close(&known);
    if (result != AUR_OK)
        return result;
    const double peak = print(name, &known, &found);
    bench_figures_add(figures, BENCH_AT_MOST, most_clumps, clumps_of(&found.blocks), "",
                      "%s: 8 x 8 means / independent noise's", name);
    bench_figures_add(figures, BENCH_AT_MOST, most_peak, peak, "", "%s: most peak / its standard error",
                      name);
    return AUR_OK;
}

/* The bundled scenes, each with the error of the calibration's small images: these are larger, so that
 * blocks are many. */
static bool run(const bench_options *options) {
    char folder[4000];
    if (!bench_data_folder(folder, sizeof folder))
        return false;
    bench_figures figures = {0};
    printf("  %-34s %5s %6s %6s %14s %7s\n", "scene", "asked", "gather", "error", "8 x 8 means", "between");
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

const bench bench_patterns = {"patterns", "whether neighbours are wrong alike in images to an error", run};

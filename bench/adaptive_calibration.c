#include "adaptive_calibration.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "adaptive_scene.h"
#include "child.h"

/* Seeds are others than those by which the rules were found. */
enum { FIRST_SEED = 5001, RUNS = 120, QUICK_RUNS = 2 };

typedef struct tally {
    size_t runs, held, below, gathered;
    double error, least, samples, rays; /* sums; the least of error over asked */
    double truth;                       /* the truth's own error over the one asked */
} tally;

/* Where a picture is wrong. */
typedef struct found_error {
    double square, worst_square; /* the mean over the values; of it, what one pixel has */
    size_t worst;
} found_error;

static found_error compare(const bench_adaptive_scene *known, const float *values) {
    found_error found = {.square = -known->own_square};
    for (size_t i = 0; i < known->count; i += 3) {
        double square = 0.0;
        for (size_t c = i; c < i + 3; ++c) {
            const double off = (double)values[c] - known->values[c];
            square += off * off / (double)known->count;
        }
        found.square += square;
        if (square > found.worst_square) {
            found.worst_square = square;
            found.worst = i / 3;
        }
    }
    return found;
}

/* A run whose interval does not hold, or whose error is the least so far. */
static void print_outlier(uint64_t seed, const found_error *found, const bench_adaptive_scene *known,
                          const float *values, const aur_adaptive_report *report) {
    const size_t width = known->width, green = 3 * found->worst + 1;
    printf(
        "    seed %llu: error %.3g of [%.3g, %.3g], %.1f samples a pixel; pixel (%zu, %zu) has %.2f of its "
        "square, %.3g in place of %.3g\n",
        (unsigned long long)seed, sqrt(fmax(found->square, 0.0)) / known->mean, report->error_low,
        report->error_high, report->samples_per_pixel, found->worst % width, found->worst / width,
        found->worst_square / found->square, (double)values[green], known->values[green]);
}

static void count(const bench_adaptive_scene *known, const found_error *found,
                  const aur_adaptive_report *report, tally *sum) {
    const double error = sqrt(fmax(found->square, 0.0)) / known->mean, asked = known->row.asked;
    ++sum->runs;
    sum->held += error >= report->error_low && error <= report->error_high;
    sum->below += error <= report->error_high;
    sum->error += error / asked;
    sum->least = sum->runs == 1 ? error / asked : fmin(sum->least, error / asked);
    sum->samples += report->samples_per_pixel;
    sum->rays += (double)report->statistics.rays;
}

static aur_result run(const bench_adaptive_scene *known, uint64_t seed, tally *sum, aur_error *error) {
    aur_adaptive *adaptive = NULL;
    aur_image *image = NULL;
    aur_adaptive_report report = {.size = sizeof report};
    aur_result result = bench_adaptive_scene_render(known, seed, &adaptive, &image, error);
    if (result == AUR_OK)
        result = aur_adaptive_get_report(adaptive, &report, error);
    if (result == AUR_OK) {
        const found_error found = compare(known, aur_image_data(image));
        const tally before = *sum;
        count(known, &found, &report, sum);
        const bool least = before.runs == 0 || sum->least < before.least;
        if (known->options->only != NULL && (sum->held == before.held || least))
            print_outlier(seed, &found, known, aur_image_data(image), &report);
        sum->gathered += strstr(aur_adaptive_integrator(adaptive), "finalgather") != NULL;
    }
    aur_image_destroy(image);
    aur_adaptive_destroy(adaptive);
    return result;
}

/* Where a share p of n runs leaves the true share with 99 % (Wilson 1927). */
static void share_interval(double share, double n, double *low, double *high) {
    const double z = 2.5758, centre = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
    const double half = z / (1.0 + z * z / n) * sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
    *low = centre - half;
    *high = centre + half;
}

static void print(const char *name, double asked, const tally *t) {
    const double runs = (double)t->runs, share = (double)t->held / runs;
    double low, high;
    share_interval(share, runs, &low, &high);
    printf("  %-28.28s %5.3g %5zu %6.3f [%.3f, %.3f]%c %6.3f %6.3f %6.3f %6.3f %8.1f %9.3g %5.2f\n", name,
           asked, t->runs, share, low, high, low > 0.95 || high < 0.95 ? '!' : ' ', (double)t->below / runs,
           t->truth, t->error / runs, t->least, t->samples / runs, t->rays / runs,
           (double)t->gathered / runs);
    fflush(stdout);
}

static void add(tally *sum, const tally *part) {
    sum->least = sum->runs == 0 ? part->least : fmin(sum->least, part->least);
    sum->truth = fmax(sum->truth, part->truth);
    sum->runs += part->runs;
    sum->held += part->held;
    sum->below += part->below;
    sum->gathered += part->gathered;
    sum->error += part->error;
    sum->samples += part->samples;
    sum->rays += part->rays;
}

/* `asked` becomes the error that a quick bench asks for, too. */
static aur_result study(const bench_options *options, const bench_adaptive_row *row, const char *folder,
                        double *asked, tally *found, aur_error *error) {
    bench_adaptive_scene known;
    aur_result result = bench_adaptive_scene_open(options, row, folder, &known, error);
    *asked = known.row.asked;
    if (result == AUR_OK)
        found->truth = sqrt(known.own_square) / (known.mean * known.row.asked);
    const size_t runs = options->quick ? QUICK_RUNS : RUNS;
    for (size_t i = 0; i < runs && result == AUR_OK; ++i)
        result = run(&known, FIRST_SEED + i, found, error);
    bench_adaptive_scene_close(&known);
    return result;
}

bool bench_adaptive_calibration(const bench_options *options, bench_figures *figures) {
    char folder[4000];
    if (!bench_data_folder(folder, sizeof folder))
        return false;
    printf("  %-28s %5s %5s %6s %-16s %6s %6s %6s %6s %8s %9s %5s\n", "scene", "asked", "runs", "held",
           " 99 %", "below", "truth", "error", "least", "samples", "rays", "gather");
    tally pooled = {0};
    size_t excluded = 0;
    for (size_t i = 0; i < bench_adaptive_row_count; ++i) {
        const bench_adaptive_row *const row = &bench_adaptive_rows[i];
        char label[128];
        if (row->scale > 1)
            snprintf(label, sizeof label, "%zu x %s", row->scale, row->scene);
        else
            snprintf(label, sizeof label, "%s", row->scene);
        if (options->only != NULL && strstr(label, options->only) == NULL)
            continue;
        tally found = {0};
        aur_error error = {0};
        double asked;
        if (study(options, row, folder, &asked, &found, &error) != AUR_OK) {
            printf("  %s: left out: %s\n", row->scene, error.message);
            continue;
        }
        double low, high;
        share_interval((double)found.held / (double)found.runs, (double)found.runs, &low, &high);
        excluded += low > 0.95 || high < 0.95;
        print(label, asked, &found);
        add(&pooled, &found);
        if (options->quick)
            break;
    }
    if (pooled.runs == 0)
        return bench_fail("no scene was rendered");
    print("pooled", 0.0, &pooled);
    const double share = (double)pooled.held / (double)pooled.runs;
    bench_figures_add(figures, BENCH_AT_LEAST, 0.93, share, "", "runs whose interval holds, pooled");
    bench_figures_add(figures, BENCH_AT_MOST, 0.97, share, "", "runs whose interval holds, pooled");
    bench_figures_add(figures, BENCH_AT_MOST, 0.0, (double)excluded, "",
                      "scenes whose 99 %% interval of that share excludes .95");
    bench_figures_add(figures, BENCH_AT_LEAST, 0.5, pooled.least, "", "least true error over the one asked");
    return true;
}

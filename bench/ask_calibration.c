#include "ask_calibration.h"

#include <aureole/ask.h>
#include <aureole/image.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "child.h"
#include "experimental.h"

/* Pixels of a row of scale 1, values, and runs. Seeds are others than those by which the rules were found. */
enum {
    WIDTH = 32,
    HEIGHT = 24,
    MOST_SCALE = 4,
    MOST_VALUES = 3 * WIDTH * HEIGHT * MOST_SCALE * MOST_SCALE,
    TRUE_SEED = 1001,
    FIRST_SEED = 5001,
    RUNS = 120,
    QUICK_RUNS = 2
};

/* The truth is the mean of two pictures to this part of the error asked, by paths and other seeds: an error
 * so small gives the pixels that most of it comes from the samples they need. What the truth is wrong by is
 * told by the difference of the two, not by the intervals that are measured. Large pictures have many values
 * by which that is told, and truths that cost minutes. */
static const double TRUE_PART = 0.125, LARGE_TRUE_PART = 0.25;

typedef struct calibration_row {
    const char *scene; /* below the source tree's scenes; with .. beside the tree, where it may be missing */
    const char *truth; /* integrator; NULL: the scene's own */
    double asked;
    size_t scale; /* times as wide and high */
} calibration_row;

/* Errors that take some ten to some hundred samples a pixel, so that those of the truth are small beside
 * them. Keller's scenes name an integrator of their own, which is told another one. */
static const calibration_row rows[] = {
    {"cornell-box/cornell-box.xml", "path", 0.08, 1},
    {"cornell-box/figure.xml", "path", 0.16, 1},
    {"cornell-box/glossy.xml", "path", 0.14, 1},
    {"room/room.xml", "path", 0.25, 1},
    {"parade/parade.xml", "path", 0.50, 1},
    {"plates/plates.xml", "path", 0.35, 1},
    {"statue/statue.xml", "path", 0.16, 1},
    {"sphere/sphere.xml", "path", 0.15, 1},
    {"occlusion/occlusion.xml", NULL, 0.03, 1},
    {"haze/haze.xml", "volpath", 0.80, 1},
    {"keller/cube.xml", "path", 0.06, 1},
    {"keller/teapot-box.xml", "path", 0.08, 1},
    {"keller/living-room.xml", "path", 0.25, 1},
    {"keller/office.xml", "path", 0.35, 1},
    {"keller/corridor-analytic.xml", "path", 0.10, 1},
    {"../../shared/scenes/veach-mis/scene.xml", "path", 0.40, 1},
    {"../../shared/scenes/veach-bidir/scene.xml", "path", 0.80, 1},
    /* So many pixels pay for knowing the bias of a photon map. */
    {"cornell-box/cornell-box.xml", "path", 0.03, MOST_SCALE},
    {"cornell-box/glossy.xml", "path", 0.06, MOST_SCALE},
};

enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

typedef struct tally {
    size_t runs, held, below, gathered;
    double error, least, samples, rays; /* sums; the least of error over asked */
    double truth;                       /* the truth's own error over the one asked */
} tally;

typedef struct truth {
    size_t count;
    double values[MOST_VALUES];
    double mean, own_square; /* of the truth's own error */
} known_truth;

static size_t values_of(size_t scale) {
    return (size_t)3 * WIDTH * HEIGHT * scale * scale;
}

static bool read_truth(const char *path, size_t scale, float *values) {
    aur_image *image = NULL;
    if (access(path, R_OK) != 0 || aur_image_read(path, &image, NULL) != AUR_OK)
        return false;
    const bool fits = aur_image_width(image) == scale * WIDTH && aur_image_height(image) == scale * HEIGHT;
    if (fits)
        memcpy(values, aur_image_data(image), values_of(scale) * sizeof *values);
    aur_image_destroy(image);
    return fits;
}

static aur_render_options small(const bench_options *options, size_t scale) {
    aur_render_options own = aur_render_options_default();
    own.width = scale * WIDTH;
    own.height = scale * HEIGHT;
    own.filter = "box";
    own.threads = options->threads;
    return own;
}

/* A picture to an error; `integrator` NULL: whichever is found to be best. The caller destroys both. */
static aur_result render(const bench_options *options, aur_renderer *renderer, size_t scale,
                         const char *integrator, double asked, uint64_t seed, aur_ask **ask,
                         aur_image **image, aur_error *error) {
    aur_render_options own = small(options, scale);
    own.integrator = integrator;
    own.seed = seed;
    aur_ask_options wish = aur_ask_options_default();
    wish.error = asked;
    aur_result result = aur_ask_create(renderer, &own, &wish, ask, error);
    if (result == AUR_OK)
        result = aur_ask_run(*ask, error);
    return result == AUR_OK ? aur_ask_develop(*ask, false, image, error) : result;
}

static double asked_of(const bench_options *options, size_t row) {
    return options->quick ? fmin(4.0 * rows[row].asked, 1.0) : rows[row].asked;
}

/* Rendered once and kept beside the program. */
static aur_result make_truth(const bench_options *options, aur_renderer *renderer, size_t row, size_t half,
                             const char *path, float *values, aur_error *error) {
    const size_t scale = rows[row].scale;
    aur_ask *ask = NULL;
    aur_image *image = NULL;
    printf("  %s: a reference is rendered once\n", rows[row].scene);
    fflush(stdout);
    aur_result result = render(options, renderer, scale, rows[row].truth,
                               (scale > 1 ? LARGE_TRUE_PART : TRUE_PART) * asked_of(options, row),
                               TRUE_SEED + half, &ask, &image, error);
    if (result == AUR_OK) {
        memcpy(values, aur_image_data(image), values_of(scale) * sizeof *values);
        result = aur_image_write(path, image, NULL, error);
    }
    aur_image_destroy(image);
    aur_ask_destroy(ask);
    return result;
}

static aur_result open_truth(const bench_options *options, aur_renderer *renderer, size_t row,
                             const char *folder, known_truth *found, aur_error *error) {
    float values[2][MOST_VALUES];
    for (size_t half = 0; half < 2; ++half) {
        char name[128], path[4400];
        snprintf(name, sizeof name, "%s", rows[row].scene);
        for (char *slash = strchr(name, '/'); slash != NULL; slash = strchr(slash, '/'))
            *slash = '-';
        char times[24] = "";
        if (rows[row].scale > 1)
            snprintf(times, sizeof times, "-x%zu", rows[row].scale);
        snprintf(path, sizeof path, "%s/ask-truth%s-%s%s-%zu.pfm", folder, options->quick ? "-quick" : "",
                 name, times, half + 1);
        const aur_result result = read_truth(path, rows[row].scale, values[half])
                                      ? AUR_OK
                                      : make_truth(options, renderer, row, half, path, values[half], error);
        if (result != AUR_OK)
            return result;
    }
    *found = (known_truth){.count = values_of(rows[row].scale)};
    const double count = (double)found->count;
    for (size_t i = 0; i < found->count; ++i) {
        const double a = (double)values[0][i], b = (double)values[1][i];
        found->values[i] = 0.5 * (a + b);
        found->mean += found->values[i] / count;
        found->own_square += 0.25 * (a - b) * (a - b) / count;
    }
    return AUR_OK;
}

/* Where a picture is wrong. */
typedef struct found_error {
    double square, worst_square; /* the mean over the values; of it, what one pixel has */
    size_t worst;
} found_error;

static found_error compare(const known_truth *known, const float *values) {
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
static void print_outlier(size_t scale, uint64_t seed, const found_error *found, const known_truth *known,
                          const float *values, const aur_ask_report *report) {
    const size_t width = scale * WIDTH, green = 3 * found->worst + 1;
    printf(
        "    seed %llu: error %.3g of [%.3g, %.3g], %.1f samples a pixel; pixel (%zu, %zu) has %.2f of its "
        "square, %.3g in place of %.3g\n",
        (unsigned long long)seed, sqrt(fmax(found->square, 0.0)) / known->mean, report->error_low,
        report->error_high, report->samples_per_pixel, found->worst % width, found->worst / width,
        found->worst_square / found->square, (double)values[green], known->values[green]);
}

static void count(const known_truth *known, const found_error *found, double asked,
                  const aur_ask_report *report, tally *sum) {
    const double error = sqrt(fmax(found->square, 0.0)) / known->mean;
    ++sum->runs;
    sum->held += error >= report->error_low && error <= report->error_high;
    sum->below += error <= report->error_high;
    sum->error += error / asked;
    sum->least = sum->runs == 1 ? error / asked : fmin(sum->least, error / asked);
    sum->samples += report->samples_per_pixel;
    sum->rays += (double)report->statistics.rays;
}

static aur_result run(const bench_options *options, aur_renderer *renderer, size_t row, uint64_t seed,
                      const known_truth *known, tally *sum, aur_error *error) {
    aur_ask *ask = NULL;
    aur_image *image = NULL;
    aur_ask_report report = {.size = sizeof report};
    aur_result result =
        render(options, renderer, rows[row].scale, NULL, asked_of(options, row), seed, &ask, &image, error);
    if (result == AUR_OK)
        result = aur_ask_get_report(ask, &report, error);
    if (result == AUR_OK) {
        const found_error found = compare(known, aur_image_data(image));
        const tally before = *sum;
        const double asked = asked_of(options, row);
        count(known, &found, asked, &report, sum);
        const bool least = before.runs == 0 || sum->least < before.least;
        if (options->only != NULL && (sum->held == before.held || least))
            print_outlier(rows[row].scale, seed, &found, known, aur_image_data(image), &report);
        sum->gathered += strstr(aur_ask_integrator(ask), "finalgather") != NULL;
    }
    aur_image_destroy(image);
    aur_ask_destroy(ask);
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

static aur_result study(const bench_options *options, size_t row, const char *folder, tally *found,
                        aur_error *error) {
    char path[512];
    aur_scene *scene = NULL;
    aur_renderer *renderer = NULL;
    known_truth known = {.mean = 0.0};
    snprintf(path, sizeof path, AUR_SOURCE_DIR "/scenes/%s", rows[row].scene);
    static const aur_definition integrator = {"integrator", "path"};
    aur_scene_options load = aur_scene_options_default();
    load.definitions = &integrator;
    load.definition_count = strncmp(rows[row].scene, "keller/", 7) == 0 ? 1 : 0;
    aur_result result = aur_scene_load(path, &load, &scene, error);
    if (result == AUR_OK)
        result = aur_renderer_create(scene, &renderer, error);
    if (result == AUR_OK)
        result = open_truth(options, renderer, row, folder, &known, error);
    if (result == AUR_OK)
        found->truth = sqrt(known.own_square) / (known.mean * asked_of(options, row));
    const size_t runs = options->quick ? QUICK_RUNS : RUNS;
    for (size_t i = 0; i < runs && result == AUR_OK; ++i)
        result = run(options, renderer, row, FIRST_SEED + i, &known, found, error);
    aur_renderer_destroy(renderer);
    aur_scene_destroy(scene);
    return result;
}

bool bench_ask_calibration(const bench_options *options, bench_figures *figures) {
    char folder[4000];
    if (!bench_data_folder(folder, sizeof folder))
        return false;
    printf("  %-28s %5s %5s %6s %-16s %6s %6s %6s %6s %8s %9s %5s\n", "scene", "asked", "runs", "held",
           " 99 %", "below", "truth", "error", "least", "samples", "rays", "gather");
    tally pooled = {0};
    size_t excluded = 0;
    for (size_t row = 0; row < ROW_COUNT; ++row) {
        char label[128];
        if (rows[row].scale > 1)
            snprintf(label, sizeof label, "%zu x %s", rows[row].scale, rows[row].scene);
        else
            snprintf(label, sizeof label, "%s", rows[row].scene);
        if (options->only != NULL && strstr(label, options->only) == NULL)
            continue;
        tally found = {0};
        aur_error error = {0};
        if (study(options, row, folder, &found, &error) != AUR_OK) {
            printf("  %s: left out: %s\n", rows[row].scene, error.message);
            continue;
        }
        double low, high;
        share_interval((double)found.held / (double)found.runs, (double)found.runs, &low, &high);
        excluded += low > 0.95 || high < 0.95;
        print(label, asked_of(options, row), &found);
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

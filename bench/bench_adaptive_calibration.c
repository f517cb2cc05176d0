/* Coverage of the confidence interval of a target error, by error measure. Tiny images of the bundled scenes
 * with the scenes' filters are rendered with many seeds each and compared with long renders. */
#include <aureole-render/adaptive.h>
#include <aureole-render/image.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bench.h"
#include "figures.h"

/* The seeds differ from those with which the stopping rule was tuned. */
enum {
    WIDTH = 16,
    HEIGHT = 16,
    FIRST_SEED = 22001,
    RUNS = 200,
    QUICK_RUNS = 2,
    REFERENCE_SEED = 1001,
    REFERENCE_SAMPLES = 4096,
    QUICK_REFERENCE_SAMPLES = 256
};

/* Target errors that take tens to hundreds of samples per pixel. */
typedef struct calibration_row {
    const char *scene, *integrator;
    double errors[AUR_ERROR_MEASURE_COUNT]; /* in the order of aur_error_measure */
} calibration_row;

static const calibration_row rows[] = {
    {"cornell-box/cornell-box.xml", "path", {0.06, 0.06, 0.03}},
    {"cornell-box/figure.xml", "path", {0.10, 0.12, 0.04}},
    {"cornell-box/glossy.xml", "path", {0.10, 0.10, 0.04}},
    {"room/room.xml", "path", {0.15, 0.20, 0.05}},
    {"parade/parade.xml", "path", {0.15, 0.40, 0.05}},
    {"plates/plates.xml", "path", {0.15, 0.30, 0.05}},
    {"statue/statue.xml", "path", {0.10, 0.15, 0.04}},
    {"sphere/sphere.xml", "path", {0.10, 0.12, 0.04}},
    {"haze/haze.xml", "volpath", {0.20, 0.60, 0.06}},
    {"keller/living-room.xml", "path", {0.15, 0.20, 0.05}},
};

enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

typedef struct subject {
    const bench_options *options;
    const calibration_row *row;
    aur_scene *scene;
    aur_renderer *renderer;
    aur_image *reference;
    double reference_square[AUR_ERROR_MEASURE_COUNT]; /* mean square error of the reference */
} subject;

typedef struct tally {
    size_t runs, contained, below;
    double error, reported, samples; /* sums: squares of measured and of reported errors over the target's */
} tally;

static aur_render_options options_of(const subject *self, uint64_t seed) {
    aur_render_options render = {.size = sizeof render};
    aur_render_options_init(&render, NULL);
    render.width = WIDTH;
    render.height = HEIGHT;
    render.threads = 1;
    render.integrator = self->row->integrator;
    render.seed = seed;
    return render;
}

/* The mean of two long renders. Half their difference estimates its error. */
static aur_result render_reference(subject *self, aur_error *error) {
    aur_image *halves[2] = {NULL, NULL};
    aur_result result = AUR_OK;
    for (size_t half = 0; half < 2 && result == AUR_OK; ++half) {
        aur_render_options render = options_of(self, REFERENCE_SEED + half);
        render.sampler = "sobol";
        render.samples_per_pixel = self->options->quick ? QUICK_REFERENCE_SAMPLES : REFERENCE_SAMPLES;
        result = aur_renderer_render(self->renderer, &render, &halves[half], NULL, error);
    }
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT && result == AUR_OK; ++m) {
        double change;
        result = aur_image_error(halves[0], halves[1], (aur_error_measure)m, &change, error);
        self->reference_square[m] = 0.25 * change * change;
    }
    if (result == AUR_OK) {
        float *const a = aur_image_data(halves[0]), *const b = aur_image_data(halves[1]);
        for (size_t i = 0; i < WIDTH * HEIGHT * aur_image_channel_count(halves[0]); ++i)
            a[i] = 0.5f * (a[i] + b[i]);
        self->reference = halves[0];
        halves[0] = NULL;
    }
    aur_image_destroy(halves[0]);
    aur_image_destroy(halves[1]);
    return result;
}

static aur_result open_subject(subject *self, aur_error *error) {
    char path[512];
    snprintf(path, sizeof path, AUR_SOURCE_DIR "/scenes/%s", self->row->scene);
    static const aur_definition integrator = {"integrator", "path"}; /* Keller's scenes name another one */
    aur_scene_options load = {.size = sizeof load};
    aur_scene_options_init(&load, NULL);
    load.definitions = &integrator;
    load.definition_count = strncmp(self->row->scene, "keller/", 7) == 0 ? 1 : 0;
    aur_result result = aur_scene_load(path, &load, &self->scene, error);
    if (result == AUR_OK)
        result = aur_renderer_create(self->scene, &self->renderer, error);
    return result == AUR_OK ? render_reference(self, error) : result;
}

static void close_subject(subject *self) {
    aur_image_destroy(self->reference);
    aur_renderer_destroy(self->renderer);
    aur_scene_destroy(self->scene);
}

static aur_result run_once(const subject *self, aur_error_measure measure, uint64_t seed, tally *sum,
                           aur_error *error) {
    const aur_render_options render = options_of(self, seed);
    aur_adaptive_options target = {.size = sizeof target};
    aur_adaptive_options_init(&target, NULL);
    target.error = self->row->errors[measure];
    target.measure = measure;
    aur_adaptive *adaptive = NULL;
    aur_image *image = NULL;
    aur_adaptive_report report = {.size = sizeof report};
    double value = 0.0;
    aur_result result = aur_adaptive_create(self->renderer, &render, &target, &adaptive, error);
    if (result == AUR_OK)
        result = aur_adaptive_run(adaptive, error);
    if (result == AUR_OK)
        result = aur_adaptive_get_report(adaptive, &report, error);
    if (result == AUR_OK)
        result = aur_adaptive_develop(adaptive, false, &image, error);
    if (result == AUR_OK)
        result = aur_image_error(self->reference, image, measure, &value, error);
    aur_image_destroy(image);
    aur_adaptive_destroy(adaptive);
    if (result != AUR_OK)
        return result;
    const double square = fmax(value * value - self->reference_square[measure], 0.0),
                 requested = target.error;
    ++sum->runs;
    sum->contained += sqrt(square) >= report.error_low && sqrt(square) <= report.error_high;
    sum->below += sqrt(square) <= report.error_high;
    sum->error += square / (requested * requested);
    sum->reported += report.error * report.error / (requested * requested);
    sum->samples += report.samples_per_pixel;
    return AUR_OK;
}

/* The 99 % confidence interval of a proportion (Wilson 1927). */
static void share_interval(double share, double n, double *low, double *high) {
    const double z = 2.5758, centre = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
    const double half = z / (1.0 + z * z / n) * sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n));
    *low = centre - half;
    *high = centre + half;
}

static bool excludes(const tally *found) {
    double low, high;
    share_interval((double)found->contained / (double)found->runs, (double)found->runs, &low, &high);
    return low > 0.95 || high < 0.95;
}

static void print(const char *name, size_t measure, double target, double reference, const tally *found) {
    const double runs = (double)found->runs, share = (double)found->contained / runs;
    double low, high;
    share_interval(share, runs, &low, &high);
    printf("  %-26.26s %-8s %6.3f %5zu %6.3f [%.3f, %.3f]%c %6.3f %6.3f %6.3f %8.3f %8.1f\n", name,
           aur_error_measure_name((aur_error_measure)measure), target, found->runs, share, low, high,
           excludes(found) ? '!' : ' ', (double)found->below / runs, reference, sqrt(found->error / runs),
           sqrt(found->error / found->reported), found->samples / runs);
    fflush(stdout);
}

static void add(tally *sum, const tally *part) {
    sum->runs += part->runs;
    sum->contained += part->contained;
    sum->below += part->below;
    sum->error += part->error;
    sum->reported += part->reported;
    sum->samples += part->samples;
}

/* Returns the number of measures whose 99 % interval excludes 95 %. */
static size_t study(const bench_options *options, const calibration_row *row, tally *pooled) {
    subject self = {.options = options, .row = row};
    aur_error error = {0};
    aur_result result = open_subject(&self, &error);
    size_t excluded = 0;
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT && result == AUR_OK; ++m) {
        tally found = {.runs = 0};
        for (size_t i = 0; i < (options->quick ? QUICK_RUNS : RUNS) && result == AUR_OK; ++i)
            result = run_once(&self, (aur_error_measure)m, FIRST_SEED + i, &found, &error);
        if (result == AUR_OK) {
            print(row->scene, m, row->errors[m], sqrt(self.reference_square[m]) / row->errors[m], &found);
            add(&pooled[m], &found);
            excluded += excludes(&found);
        }
    }
    if (result != AUR_OK)
        printf("  %s: left out: %s\n", row->scene, error.message);
    close_subject(&self);
    return excluded;
}

static bool run(const bench_options *options) {
    printf("  %-26s %-8s %6s %5s %6s %-16s %6s %6s %6s %8s %8s\n", "scene", "measure", "target", "runs",
           "held", " 99 %", "below", "ref.", "error", "/reported", "samples");
    tally pooled[AUR_ERROR_MEASURE_COUNT] = {{.runs = 0}};
    size_t excluded = 0;
    for (size_t i = 0; i < (options->quick ? 1 : ROW_COUNT); ++i)
        if (options->only == NULL || strstr(rows[i].scene, options->only) != NULL)
            excluded += study(options, &rows[i], pooled);
    if (pooled[0].runs == 0)
        return bench_fail("no scene was rendered");
    bench_figures figures = {0};
    for (size_t m = 0; m < AUR_ERROR_MEASURE_COUNT; ++m) {
        const double share = (double)pooled[m].contained / (double)pooled[m].runs;
        const char *const name = aur_error_measure_name((aur_error_measure)m);
        print("pooled", m, 0.0, 0.0, &pooled[m]);
        bench_figures_add(&figures, BENCH_AT_LEAST, 0.93, share, "", "%s: runs whose interval holds", name);
        bench_figures_add(&figures, BENCH_AT_MOST, 0.97, share, "", "%s: runs whose interval holds", name);
    }
    bench_figures_add(&figures, BENCH_AT_MOST, 0.0, (double)excluded, "",
                      "rows whose 99 %% interval of that share excludes .95");
    bench_figures_print(&figures);
    return true;
}

const bench bench_adaptive_calibration_alone = {
    "adaptive-calibration", "how often the interval of a target error contains the true error", run};

#include "adaptive_scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { REFERENCE_SEED = 1001 };

/* Target error of the two reference images, relative to the row's target. Path tracing with other seeds
 * renders them; their mean is the reference. Its error is estimated from their difference, not from the
 * confidence intervals under test. Large images have more values for that estimate, and their references take
 * minutes. */
static const double REFERENCE_PART = 0.125, LARGE_REFERENCE_PART = 0.25;

/* Target errors that take tens to hundreds of samples per pixel, so that the error of the reference is small
 * in comparison. Keller's scenes name an integrator; their references use another one. */
const bench_adaptive_row bench_adaptive_rows[] = {
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
    /* Images large enough that the bias estimate of a photon map pays off. */
    {"cornell-box/cornell-box.xml", "path", 0.03, BENCH_ADAPTIVE_MOST_SCALE},
    {"cornell-box/glossy.xml", "path", 0.06, BENCH_ADAPTIVE_MOST_SCALE},
    /* The same for the choice of path tracing's candidates. */
    {"sphere/sphere.xml", "path", 0.06, BENCH_ADAPTIVE_MOST_SCALE},
};

const size_t bench_adaptive_row_count = sizeof bench_adaptive_rows / sizeof bench_adaptive_rows[0];

static bool read_reference(const bench_adaptive_scene *self, const char *path, float *values) {
    aur_image *image = NULL;
    if (access(path, R_OK) != 0 || aur_image_read(path, &image, NULL) != AUR_OK)
        return false;
    const bool fits = aur_image_width(image) == self->width && aur_image_height(image) == self->height;
    if (fits)
        memcpy(values, aur_image_data(image), self->count * sizeof *values);
    aur_image_destroy(image);
    return fits;
}

/* `integrator` NULL: chosen automatically. */
static aur_result render(const bench_adaptive_scene *self, const char *integrator, double target_error,
                         uint64_t seed, aur_adaptive **adaptive, aur_image **image, aur_error *error) {
    aur_render_options render_options = {.size = sizeof render_options};
    aur_render_options_init(&render_options, NULL);
    render_options.width = self->width;
    render_options.height = self->height;
    render_options.filter = "box";
    render_options.threads = self->options->threads;
    render_options.integrator = integrator;
    render_options.seed = seed;
    aur_adaptive_options target = {.size = sizeof target};
    aur_adaptive_options_init(&target, NULL);
    target.error = target_error;
    target.measure = AUR_ERROR_MEASURE_MEAN;
    aur_result result = aur_adaptive_create(self->renderer, &render_options, &target, adaptive, error);
    if (result == AUR_OK)
        result = aur_adaptive_run(*adaptive, error);
    return result == AUR_OK ? aur_adaptive_develop(*adaptive, false, image, error) : result;
}

aur_result bench_adaptive_scene_render(const bench_adaptive_scene *self, uint64_t seed,
                                       aur_adaptive **adaptive, aur_image **image, aur_error *error) {
    return render(self, NULL, self->row.target_error, seed, adaptive, image, error);
}

/* Rendered once and stored in `path`. */
static aur_result render_reference(const bench_adaptive_scene *self, size_t half, const char *path,
                                   float *values, aur_error *error) {
    aur_adaptive *adaptive = NULL;
    aur_image *image = NULL;
    printf("  %s: a reference is rendered once\n", self->row.scene);
    fflush(stdout);
    aur_result result =
        render(self, self->row.reference_integrator,
               (self->row.scale > 1 ? LARGE_REFERENCE_PART : REFERENCE_PART) * self->row.target_error,
               REFERENCE_SEED + half, &adaptive, &image, error);
    if (result == AUR_OK) {
        memcpy(values, aur_image_data(image), self->count * sizeof *values);
        result = aur_image_write(path, image, NULL, error);
    }
    aur_image_destroy(image);
    aur_adaptive_destroy(adaptive);
    return result;
}

static aur_result open_references(bench_adaptive_scene *self, const char *folder, aur_error *error) {
    float values[2][BENCH_ADAPTIVE_MOST_VALUES];
    for (size_t half = 0; half < 2; ++half) {
        char name[128], path[4400];
        snprintf(name, sizeof name, "%s", self->row.scene);
        for (char *slash = strchr(name, '/'); slash != NULL; slash = strchr(slash, '/'))
            *slash = '-';
        char times[24] = "";
        if (self->row.scale > 1)
            snprintf(times, sizeof times, "-x%zu", self->row.scale);
        snprintf(path, sizeof path, "%s/ask-truth%s-%s%s-%zu.pfm", folder,
                 self->options->quick ? "-quick" : "", name, times, half + 1);
        const aur_result result = read_reference(self, path, values[half])
                                      ? AUR_OK
                                      : render_reference(self, half, path, values[half], error);
        if (result != AUR_OK)
            return result;
    }
    const double count = (double)self->count;
    for (size_t i = 0; i < self->count; ++i) {
        const double a = (double)values[0][i], b = (double)values[1][i];
        self->values[i] = 0.5 * (a + b);
        self->reference_error[i] = 0.5 * (a - b);
        self->mean += self->values[i] / count;
        self->reference_square += self->reference_error[i] * self->reference_error[i] / count;
    }
    return AUR_OK;
}

aur_result bench_adaptive_scene_open(const bench_options *options, const bench_adaptive_row *row,
                                     const char *folder, bench_adaptive_scene *self, aur_error *error) {
    *self = (bench_adaptive_scene){.options = options,
                                   .row = *row,
                                   .width = row->scale * BENCH_ADAPTIVE_WIDTH,
                                   .height = row->scale * BENCH_ADAPTIVE_HEIGHT};
    self->count = 3 * self->width * self->height;
    if (options->quick)
        self->row.target_error = fmin(4.0 * row->target_error, 1.0);
    char path[512];
    snprintf(path, sizeof path, AUR_SOURCE_DIR "/scenes/%s", row->scene);
    static const aur_definition integrator = {"integrator", "path"};
    aur_scene_options load = {.size = sizeof load};
    aur_scene_options_init(&load, NULL);
    load.definitions = &integrator;
    load.definition_count = strncmp(row->scene, "keller/", 7) == 0 ? 1 : 0;
    aur_result result = aur_scene_load(path, &load, &self->scene, error);
    if (result == AUR_OK)
        result = aur_renderer_create(self->scene, &self->renderer, error);
    return result == AUR_OK ? open_references(self, folder, error) : result;
}

void bench_adaptive_scene_close(bench_adaptive_scene *self) {
    aur_renderer_destroy(self->renderer);
    aur_scene_destroy(self->scene);
    self->renderer = NULL;
    self->scene = NULL;
}

#include "adaptive_scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

enum { TRUE_SEED = 1001 };

/* The truth is the mean of two images to this part of the error asked, by paths and other seeds: an error
 * so small gives the pixels that most of it comes from the samples they need. What the truth is wrong by is
 * told by the difference of the two, not by the intervals that are measured. Large images have many values
 * by which that is told, and truths that cost minutes. */
static const double TRUE_PART = 0.125, LARGE_TRUE_PART = 0.25;

/* Errors that take some ten to some hundred samples per pixel, so that those of the truth are small beside
 * them. Keller's scenes name an integrator of their own, which is told another one. */
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
    /* So many pixels pay for knowing the bias of a photon map. */
    {"cornell-box/cornell-box.xml", "path", 0.03, BENCH_ADAPTIVE_MOST_SCALE},
    {"cornell-box/glossy.xml", "path", 0.06, BENCH_ADAPTIVE_MOST_SCALE},
    /* And for choosing path tracing's candidates. */
    {"sphere/sphere.xml", "path", 0.06, BENCH_ADAPTIVE_MOST_SCALE},
};

const size_t bench_adaptive_row_count = sizeof bench_adaptive_rows / sizeof bench_adaptive_rows[0];

static bool read_truth(const bench_adaptive_scene *self, const char *path, float *values) {
    aur_image *image = NULL;
    if (access(path, R_OK) != 0 || aur_image_read(path, &image, NULL) != AUR_OK)
        return false;
    const bool fits = aur_image_width(image) == self->width && aur_image_height(image) == self->height;
    if (fits)
        memcpy(values, aur_image_data(image), self->count * sizeof *values);
    aur_image_destroy(image);
    return fits;
}

/* `integrator` NULL: whichever is found to be best. */
static aur_result render(const bench_adaptive_scene *self, const char *integrator, double asked,
                         uint64_t seed, aur_adaptive **adaptive, aur_image **image, aur_error *error) {
    aur_render_options own = {.size = sizeof own};
    aur_render_options_init(&own, NULL);
    own.width = self->width;
    own.height = self->height;
    own.filter = "box";
    own.threads = self->options->threads;
    own.integrator = integrator;
    own.seed = seed;
    aur_adaptive_options target = {.size = sizeof target};
    aur_adaptive_options_init(&target, NULL);
    target.error = asked;
    target.measure = AUR_ERROR_MEASURE_MEAN;
    aur_result result = aur_adaptive_create(self->renderer, &own, &target, adaptive, error);
    if (result == AUR_OK)
        result = aur_adaptive_run(*adaptive, error);
    return result == AUR_OK ? aur_adaptive_develop(*adaptive, false, image, error) : result;
}

aur_result bench_adaptive_scene_render(const bench_adaptive_scene *self, uint64_t seed,
                                       aur_adaptive **adaptive, aur_image **image, aur_error *error) {
    return render(self, NULL, self->row.asked, seed, adaptive, image, error);
}

/* Rendered once and kept beside the program. */
static aur_result make_truth(const bench_adaptive_scene *self, size_t half, const char *path, float *values,
                             aur_error *error) {
    aur_adaptive *adaptive = NULL;
    aur_image *image = NULL;
    printf("  %s: a reference is rendered once\n", self->row.scene);
    fflush(stdout);
    aur_result result =
        render(self, self->row.truth, (self->row.scale > 1 ? LARGE_TRUE_PART : TRUE_PART) * self->row.asked,
               TRUE_SEED + half, &adaptive, &image, error);
    if (result == AUR_OK) {
        memcpy(values, aur_image_data(image), self->count * sizeof *values);
        result = aur_image_write(path, image, NULL, error);
    }
    aur_image_destroy(image);
    aur_adaptive_destroy(adaptive);
    return result;
}

static aur_result open_truth(bench_adaptive_scene *self, const char *folder, aur_error *error) {
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
        const aur_result result =
            read_truth(self, path, values[half]) ? AUR_OK : make_truth(self, half, path, values[half], error);
        if (result != AUR_OK)
            return result;
    }
    const double count = (double)self->count;
    for (size_t i = 0; i < self->count; ++i) {
        const double a = (double)values[0][i], b = (double)values[1][i];
        self->values[i] = 0.5 * (a + b);
        self->wrong[i] = 0.5 * (a - b);
        self->mean += self->values[i] / count;
        self->own_square += self->wrong[i] * self->wrong[i] / count;
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
        self->row.asked = fmin(4.0 * row->asked, 1.0);
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
    return result == AUR_OK ? open_truth(self, folder, error) : result;
}

void bench_adaptive_scene_close(bench_adaptive_scene *self) {
    aur_renderer_destroy(self->renderer);
    aur_scene_destroy(self->scene);
    self->renderer = NULL;
    self->scene = NULL;
}

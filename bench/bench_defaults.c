/* Defaults that make a render faster or less noisy, against the plain form that they replace. Photon maps and
 * surveys of light sources are built once; everything else of the image is timed. The bench `gather-weights`
 * covers tables of weights. A ratio below 1 means that the default should change. For defaults that reduce
 * the error, the squared errors are compared too and the product counts.
 * tests/render/transport/test_defaults.c counts rays for the faster ones. */
#include <aureole-render/render.h>
#include <stdio.h>
#include <string.h>

#include "bench.h"
#include "error_pattern.h"
#include "program/lab/gather.h"

enum { SIDE = 96, QUICK_SIDE = 16, SAMPLES = 16, ERROR_PAIRS = 4 };

typedef struct default_row {
    const char *name, *scene, *usual, *plain; /* may start with .. and be missing */
    bool errs_less;
} default_row;

#define GATHER "finalgather-lab:photons=50000,diffuse_samples=64,glossy_samples=32"
static const default_row rows[] = {
    {"path in packets, cornell-box", "cornell-box/cornell-box.xml", "path", "path:packets=false", false},
    {"path in packets, glossy", "cornell-box/glossy.xml", "path", "path:packets=false", false},
    {"path in packets, living room", "keller/living-room.xml", "path", "path:packets=false", false},
    {"gather in packets, cornell-box", "cornell-box/cornell-box.xml", GATHER, GATHER ",packets=false", false},
    {"gather in packets, glossy", "cornell-box/glossy.xml", GATHER, GATHER ",packets=false", false},
    {"gather in packets, living room", "keller/living-room.xml", GATHER, GATHER ",packets=false", false},
    {"gather by 16 rotations, glossy", "cornell-box/glossy.xml", GATHER, GATHER ",rotations=0", false},
    {"ao by 16 rotations, glossy", "cornell-box/glossy.xml", "ao:samples=64", "ao:samples=64,rotations=0",
     false},
    {"radiosity, a light a point, living room", "keller/living-room.xml", "radiosity:paths=2000",
     "radiosity:paths=2000,light_sampling=all", false},
    {"rays for lamps, plates", "plates/plates.xml", "path", "path:lamp_rays=0", true},
    {"rays for lamps, parade", "parade/parade.xml", "path", "path:lamp_rays=0", true},
    {"rays for lamps, Veach's plates", "../../shared/scenes/veach-mis/scene.xml", "path", "path:lamp_rays=0",
     true},
};
#undef GATHER

typedef struct default_render {
    aur_renderer *renderer;
    aur_render_options options;
    bool failed;
    aur_error error;
} default_render;

static void render(void *data) {
    default_render *const self = data;
    aur_image *image = NULL;
    if (aur_renderer_render(self->renderer, &self->options, &image, NULL, &self->error) != AUR_OK)
        self->failed = true;
    aur_image_destroy(image);
}

/* Half the mean square difference of two images with different seeds: the mean square error of one where the
 * default is unbiased. */
static double squared_error(const default_render *work, uint64_t seed) {
    aur_image *images[2] = {NULL, NULL};
    aur_render_options options = work->options;
    double squares = 0.0;
    bool good = true;
    for (size_t i = 0; i < 2 && good; ++i) {
        options.seed = seed + i;
        good = aur_renderer_render(work->renderer, &options, &images[i], NULL, NULL) == AUR_OK;
    }
    error_pattern pattern = {.width = options.width, .height = options.height};
    if (good && error_pattern_open(options.width, options.height, aur_image_channel_count(images[0]),
                                   aur_image_data(images[0]), aur_image_data(images[1]), &pattern))
        squares = 0.5 * error_pattern_product(&pattern, 0, false);
    error_pattern_close(&pattern);
    aur_image_destroy(images[0]);
    aur_image_destroy(images[1]);
    return squares;
}

/* Prints the ratio for each pair of seeds, because rare bright samples make single pairs unreliable. */
static bool compare_errors(const bench_options *options, const default_render *usual,
                           const default_render *plain, double speed) {
    double sums[2] = {0.0, 0.0};
    printf("    squared error / the plain form's:");
    for (size_t i = 0; i < (options->quick ? 1 : ERROR_PAIRS); ++i) {
        const double usual_square = squared_error(usual, 2 * i + 1),
                     plain_square = squared_error(plain, 2 * i + 1);
        if (!(plain_square > 0.0))
            return bench_fail("images of two seeds are identical, or out of memory");
        printf(" %.3g", usual_square / plain_square);
        sums[0] += usual_square;
        sums[1] += plain_square;
    }
    printf("; of all %.3g, times CPU time %.3g\n", sums[0] / sums[1], sums[0] / sums[1] / speed);
    return true;
}

static bool compare(const bench_options *options, const default_row *row, aur_renderer *renderer) {
    const size_t side = options->quick ? QUICK_SIDE : SIDE;
    default_render usual = {.renderer = renderer,
                            .options = {.size = sizeof(aur_render_options),
                                        .gather = &lab_finalgather,
                                        .integrator = row->usual,
                                        .threads = 1,
                                        .width = side,
                                        .height = side,
                                        .samples_per_pixel = options->quick ? 1 : SAMPLES}};
    default_render plain = usual;
    plain.options.integrator = row->plain;
    const double pixels = (double)(side * side);
    const bench_work subject = {render, &usual, pixels}, limit = {render, &plain, pixels};
    const bench_pair pair = bench_compare(options, &subject, &limit);
    if (usual.failed || plain.failed)
        return bench_fail("%s", usual.failed ? usual.error.message : plain.error.message);
    bench_print_pair(row->name, "the plain form", "kpixel", 1e3, &pair);
    return !row->errs_less || compare_errors(options, &usual, &plain, pair.ratio);
}

static bool run(const bench_options *options) {
    bench_options few = *options;
    few.pairs = few.pairs < 5 ? few.pairs : 5; /* an image takes about a second */
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        if (options->only != NULL && strstr(rows[i].name, options->only) == NULL)
            continue;
        char path[512];
        aur_error error;
        aur_scene *scene = NULL;
        aur_renderer *renderer = NULL;
        snprintf(path, sizeof path, AUR_SOURCE_DIR "/scenes/%s", rows[i].scene);
        const aur_result loaded = aur_scene_load(path, NULL, &scene, &error);
        if (loaded == AUR_ERROR_OPEN && rows[i].errs_less) { /* its meshes are generated by a script */
            printf("  %s: left out: %s\n", rows[i].name, error.message);
            continue;
        }
        bool good = loaded == AUR_OK && aur_renderer_create(scene, &renderer, &error) == AUR_OK;
        good = good ? compare(&few, &rows[i], renderer) : bench_fail("%s", error.message);
        aur_renderer_destroy(renderer);
        aur_scene_destroy(scene);
        if (!good)
            return false;
    }
    return true;
}

const bench bench_defaults = {"defaults",
                              "what is on by default for speed or less error against the plain forms", run};

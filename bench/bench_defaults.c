/* What is on by default because it is faster, against the plain form that it replaces: whole pictures, but
 * for their photon maps, which are made once. What tables of weights save is in the bench `gather-weights`. A
 * ratio below 1 is a default that should not be one. tests/transport/test_defaults.c counts the rays of the
 * same rows. */
#include <aureole/render.h>
#include <stdio.h>

#include "bench.h"
#include "experimental.h"

enum { SIDE = 96, QUICK_SIDE = 16, SAMPLES = 16 };

typedef struct default_row {
    const char *name, *scene, *usual, *plain;
} default_row;

#define GATHER "finalgather:photons=50000,diffuse_samples=64,glossy_samples=32"
static const default_row rows[] = {
    {"path in packets, cornell-box", "cornell-box/cornell-box.xml", "path", "path:packets=false"},
    {"path in packets, glossy", "cornell-box/glossy.xml", "path", "path:packets=false"},
    {"path in packets, living room", "keller/living-room.xml", "path", "path:packets=false"},
    {"gather in packets, cornell-box", "cornell-box/cornell-box.xml", GATHER, GATHER ",packets=false"},
    {"gather in packets, glossy", "cornell-box/glossy.xml", GATHER, GATHER ",packets=false"},
    {"gather in packets, living room", "keller/living-room.xml", GATHER, GATHER ",packets=false"},
    {"gather by 16 rotations, glossy", "cornell-box/glossy.xml", GATHER, GATHER ",rotations=0"},
    {"ao by 16 rotations, glossy", "cornell-box/glossy.xml", "ao:samples=64", "ao:samples=64,rotations=0"},
    {"radiosity, a light a point, living room", "keller/living-room.xml", "radiosity:paths=2000",
     "radiosity:paths=2000,light_sampling=all"},
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

static bool compare(const bench_options *options, const default_row *row, aur_renderer *renderer) {
    const size_t side = options->quick ? QUICK_SIDE : SIDE;
    default_render usual = {.renderer = renderer,
                            .options = {.size = sizeof(aur_render_options),
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
    return true;
}

static bool run(const bench_options *options) {
    bench_options few = *options;
    few.pairs = few.pairs < 5 ? few.pairs : 5; /* a picture takes most of a second */
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char path[512];
        aur_error error;
        aur_scene *scene = NULL;
        aur_renderer *renderer = NULL;
        snprintf(path, sizeof path, AUR_SOURCE_DIR "/scenes/%s", rows[i].scene);
        bool good = aur_scene_load(path, NULL, &scene, &error) == AUR_OK &&
                    aur_renderer_create(scene, &renderer, &error) == AUR_OK;
        good = good ? compare(&few, &rows[i], renderer) : bench_fail("%s", error.message);
        aur_renderer_destroy(renderer);
        aur_scene_destroy(scene);
        if (!good)
            return false;
    }
    return true;
}

const bench bench_defaults = {"defaults", "what is on by default for speed against the plain forms", run};

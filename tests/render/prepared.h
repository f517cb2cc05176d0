/* Scenes with their renderers, and options of small images. */
#pragma once

#include <aureole-render/adaptive.h>

#include "check.h"

#define CORNELL_BOX AUR_SOURCE_DIR "/scenes/cornell-box/cornell-box.xml"

typedef struct prepared {
    aur_scene *scene;
    aur_renderer *renderer;
} prepared;

/* Takes over the scene. */
static inline prepared prepare(aur_scene *scene) {
    prepared p = {.scene = scene};
    assert_int_equal(aur_renderer_create(scene, &p.renderer, NULL), AUR_OK);
    return p;
}

static inline prepared prepare_file(const char *path) {
    aur_scene *scene = NULL;
    assert_int_equal(aur_scene_load(path, NULL, &scene, NULL), AUR_OK);
    return prepare(scene);
}

static inline void release(prepared p) {
    aur_renderer_destroy(p.renderer);
    aur_scene_destroy(p.scene);
}

/* By Sobol' points, without files of earlier renders. */
static inline aur_render_options image_of_size(size_t width, size_t height) {
    aur_render_options options = {.size = sizeof options};
    assert_int_equal(aur_render_options_init(&options, NULL), AUR_OK);
    options.width = width;
    options.height = height;
    options.sampler = "sobol";
    options.use_cache = 0;
    return options;
}

static inline aur_adaptive_options target_of(double error, aur_error_measure measure) {
    aur_adaptive_options target = {.size = sizeof target};
    assert_int_equal(aur_adaptive_options_init(&target, NULL), AUR_OK);
    target.error = error;
    target.measure = measure;
    return target;
}

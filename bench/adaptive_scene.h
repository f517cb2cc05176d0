/* Scenes in small images to an error: the bundled ones and Veach's, each with its truth, which is the mean
 * of two long path-traced images with seeds of their own, rendered once and kept beside the program. */
#pragma once

#include <aureole-render/adaptive.h>
#include <aureole-render/image.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "bench.h"

/* Pixels of a row of scale 1, and values. */
enum {
    BENCH_ADAPTIVE_WIDTH = 32,
    BENCH_ADAPTIVE_HEIGHT = 24,
    BENCH_ADAPTIVE_MOST_SCALE = 4,
    BENCH_ADAPTIVE_MOST_VALUES = 3 * BENCH_ADAPTIVE_WIDTH * BENCH_ADAPTIVE_HEIGHT *
                                 BENCH_ADAPTIVE_MOST_SCALE * BENCH_ADAPTIVE_MOST_SCALE
};

typedef struct bench_adaptive_row {
    const char *scene; /* below the source tree's scenes; with .. beside the tree, where it may be missing */
    const char *truth; /* integrator; NULL: the scene's own */
    double asked;
    size_t scale; /* times as wide and high */
} bench_adaptive_row;

extern const bench_adaptive_row bench_adaptive_rows[];
extern const size_t bench_adaptive_row_count;

typedef struct bench_adaptive_scene {
    const bench_options *options;
    bench_adaptive_row row; /* a quick bench asks for less */
    aur_scene *scene;
    aur_renderer *renderer;
    size_t width, height, count;               /* of values: three a pixel */
    double values[BENCH_ADAPTIVE_MOST_VALUES]; /* of the truth */
    double wrong[BENCH_ADAPTIVE_MOST_VALUES];  /* half the difference of its two images: errors as it has
                                                  itself */
    double mean, own_square;                   /* of the truth; of its own error */
} bench_adaptive_scene;

/* The truth's files are in `folder`. */
aur_result bench_adaptive_scene_open(const bench_options *options, const bench_adaptive_row *row,
                                     const char *folder, bench_adaptive_scene *self, aur_error *error);
void bench_adaptive_scene_close(bench_adaptive_scene *self);

/* An image to the row's error. The caller destroys both, also after a failure. */
aur_result bench_adaptive_scene_render(const bench_adaptive_scene *self, uint64_t seed,
                                       aur_adaptive **adaptive, aur_image **image, aur_error *error);

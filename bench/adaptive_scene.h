/* Small images of the bundled scenes and Veach's, rendered to a target error. The reference of each is the
 * mean of two long path-traced images with independent seeds, rendered once and stored next to the program.
 */
#pragma once

#include <aureole-render/adaptive.h>
#include <aureole-render/image.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "bench.h"

/* Size of an image of scale 1, and the largest number of values. */
enum {
    BENCH_ADAPTIVE_WIDTH = 32,
    BENCH_ADAPTIVE_HEIGHT = 24,
    BENCH_ADAPTIVE_MOST_SCALE = 4,
    BENCH_ADAPTIVE_MOST_VALUES = 3 * BENCH_ADAPTIVE_WIDTH * BENCH_ADAPTIVE_HEIGHT *
                                 BENCH_ADAPTIVE_MOST_SCALE * BENCH_ADAPTIVE_MOST_SCALE
};

typedef struct bench_adaptive_row {
    const char *scene; /* relative to scenes/ of the source tree; may start with .. and be missing */
    const char *reference_integrator; /* integrator of the reference; NULL: the scene's */
    double target_error;
    size_t scale; /* factor on width and height */
} bench_adaptive_row;

extern const bench_adaptive_row bench_adaptive_rows[];
extern const size_t bench_adaptive_row_count;

typedef struct bench_adaptive_scene {
    const bench_options *options;
    bench_adaptive_row row; /* with a larger target error in a quick bench */
    aur_scene *scene;
    aur_renderer *renderer;
    size_t width, height, count;                        /* count: values, three per pixel */
    double values[BENCH_ADAPTIVE_MOST_VALUES];          /* of the reference */
    double reference_error[BENCH_ADAPTIVE_MOST_VALUES]; /* half the difference of the two reference images: an
                                                           estimate of the reference's error */
    double mean, reference_square;                      /* of the reference; mean square of its error */
} bench_adaptive_scene;

/* The files of the reference are in `folder`. */
aur_result bench_adaptive_scene_open(const bench_options *options, const bench_adaptive_row *row,
                                     const char *folder, bench_adaptive_scene *self, aur_error *error);
void bench_adaptive_scene_close(bench_adaptive_scene *self);

/* Renders an image to the row's target error. The caller destroys both, also after a failure. */
aur_result bench_adaptive_scene_render(const bench_adaptive_scene *self, uint64_t seed,
                                       aur_adaptive **adaptive, aur_image **image, aur_error *error);

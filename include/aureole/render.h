/* Rendering a scene into a picture. The picture is a function of the scene, the options and the seed: the
 * number of threads changes no bit of it. */
#ifndef AUREOLE_RENDER_H
#define AUREOLE_RENDER_H

#include <aureole/image.h>
#include <aureole/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One row of the table of integrators. */
typedef struct aur_integrator_description {
    const char *name;
    const char *keys;    /* "key=default, key=default, ..." */
    const char *summary; /* one line */
    const char *source;  /* author year */
} aur_integrator_description;

AUR_API size_t aur_integrator_count(void);
AUR_API const aur_integrator_description *aur_integrator_at(size_t index); /* NULL beyond the table */

enum { AUR_RENDER_LEVELS = 8 };

typedef struct aur_render_statistics {
    uint64_t rays;                      /* traced, of all kinds */
    uint64_t samples;                   /* camera samples */
    uint64_t invalid_samples;           /* NaN, infinite or negative ones, left out of the picture */
    uint64_t levels[AUR_RENDER_LEVELS]; /* adaptive gathering: places that ended at each level */
    double prepare_seconds;             /* wall clock: photon map and the like */
    double render_seconds;
    double cpu_seconds; /* of the process, for both; without what happens between waves */
} aur_render_statistics;

/* Called when every pixel has 1, 2, 4, ... samples, and at the end: the picture so far and what it has cost.
 * Anything but AUR_OK ends the render with that result. */
typedef struct aur_waves {
    aur_result (*finished)(void *context, const aur_image *image, const aur_render_statistics *statistics,
                           aur_error *error); /* NULL: no waves */
    void *context;
} aur_waves;

typedef struct aur_render_options {
    const char *integrator;   /* NAME[:key=value,...] instead of the scene's; NULL keeps it */
    const char *sampler;      /* SET instead of the scene's; NULL keeps it */
    const char *filter;       /* "box", "tent", "gaussian" instead of the scene's; NULL keeps it */
    size_t samples_per_pixel; /* 0 keeps the scene's */
    uint64_t seed;
    size_t threads;       /* 0: all */
    size_t width, height; /* 0 keeps the scene's */
    size_t crop_x0, crop_x1, crop_y0,
        crop_y1; /* pixels x0 <= x < x1, y0 <= y < y1; all zero: what the scene's film says */
    aur_waves waves;
    aur_progress progress;
    aur_warnings warnings;
} aur_render_options;

/* Renders pictures of one scene and keeps between them what they share (a photon map, for one). The scene
 * must outlive it. Not for two threads at once. */
typedef struct aur_renderer aur_renderer;

AUR_API aur_result aur_renderer_create(const aur_scene *scene, aur_renderer **renderer, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_API void aur_renderer_destroy(aur_renderer *renderer); /* NULL is allowed */

/* A new picture of channels R, G, B; `options` may be NULL, `statistics` too. */
AUR_API aur_result aur_renderer_render(aur_renderer *renderer, const aur_render_options *options,
                                       aur_image **image, aur_render_statistics *statistics, aur_error *error)
    AUR_NONNULL(1, 3);

#ifdef __cplusplus
}
#endif

#endif

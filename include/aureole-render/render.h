/* Rendering a scene into an image, in one call or in steps. The image is a function of the scene, the
 * options, the seed and the steps; it does not depend on the number of threads.
 *
 * Experimental: all of this header may change in any version. */
#ifndef AUREOLE_RENDER_H
#define AUREOLE_RENDER_H

#include <aureole-render/film.h>
#include <aureole-render/gather.h>
#include <aureole-render/image.h>
#include <aureole-render/scene.h>
#include <aureole/tables.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The tables of integrators, materials, shapes and so on; NULL beyond the last. Sets and measures are in
 * aur_table_at. */
AUR_EXPERIMENTAL const aur_table *aur_render_table_at(size_t index);

enum { AUR_RENDER_LEVELS = 8 };

/* `size` is set by the caller to its size. */
typedef struct aur_render_statistics {
    size_t size;
    uint64_t rays;            /* of all kinds, including photons and probe rays for light sources */
    uint64_t samples;         /* camera samples */
    uint64_t invalid_samples; /* NaN, infinite or negative; excluded from the image */
    uint64_t
        cut_paths; /* cut after many mirrors or null collisions in sequence: their further light is missing */
    /* Systems of finalgather-lab, weights=oswa-solve, without a solution. Their samples are invalid. */
    uint64_t unsolved_weights;
    uint64_t levels[AUR_RENDER_LEVELS]; /* adaptive gathering: shading points that ended at each level */
    double prepare_seconds;             /* wall clock: photon map and the like */
    double render_seconds;              /* wall clock, in steps */
    double cpu_seconds;                 /* of the process, for both */
} aur_render_statistics;

/* If all is zero but `size`, as set by aur_render_options_init, the scene's settings apply. */
typedef struct aur_render_options {
    size_t size;              /* of the caller's struct, so that it can grow */
    const char *integrator;   /* NAME[:key=value,...] instead of the scene's; NULL: the scene's */
    const char *sampler;      /* SET instead of the scene's; NULL: the scene's */
    const char *filter;       /* the name of a filter instead of the scene's; NULL: the scene's */
    size_t samples_per_pixel; /* 0: the scene's */
    uint64_t seed;
    size_t threads;       /* 0: all */
    size_t width, height; /* 0: the scene's, or by its aspect ratio if the other one is given */
    /* Pixels x0 <= x < x1, y0 <= y < y1; all zero: the crop of the scene's film. */
    size_t crop_x0, crop_x1, crop_y0, crop_y1;
    aur_progress progress;
    aur_warnings warnings;
    /* For aur_render_save: the scene's files are hashed when the render is created. */
    bool resumable;
    /* Renders the shard-th of shard_count parts of the image, counted from 1: every shard_count-th tile of 16
     * x 16 pixels. Both 0: the whole image. Other tiles remain black until they are merged. */
    size_t shard, shard_count;
    /* Photon maps and tables of weights are read from the user's cache folder, and written there for later
     * runs: in AUREOLE_CACHE, aureole in XDG_CACHE_HOME, or .cache/aureole in HOME. Results do not depend on
     * it. */
    bool use_cache;
    /* One more integrator that `integrator` or the scene may name (gather.h); NULL: none. */
    const aur_gather_integrator *gather;
    /* The key `clamp` of `path` and `volpath`, for whichever of them is used; 0: no limit. */
    double clamp;
} aur_render_options;

AUR_EXPERIMENTAL aur_result aur_render_options_init(aur_render_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Renders images of one scene and caches what they share (for example a photon map). The scene must outlive
 * it. Not thread-safe. */
typedef struct aur_renderer aur_renderer;

/* Errors: FORMAT for a scene without a camera, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_renderer_create(const aur_scene *scene, aur_renderer **renderer,
                                                aur_error *error) AUR_NONNULL(1, 2);
AUR_EXPERIMENTAL void aur_renderer_destroy(aur_renderer *renderer); /* NULL is allowed */

/* Whether the scene's integrator is one of the library or `gather` (NULL: none), and its keys can be read:
 * the first check of a render whose options name no integrator. Errors: as those of aur_render_create, with
 * their position in the scene file. */
AUR_EXPERIMENTAL aur_result aur_render_check_scene(const aur_scene *scene,
                                                   const aur_gather_integrator *gather, aur_error *error)
    AUR_NONNULL(1);

/* Renders a new image of channels R, G, B and those that the integrator adds, all samples in one step.
 * `options` and `statistics` may be NULL. If the progress callback stops the render, the result is CANCELLED
 * and *image is the image so far; with every other error it is NULL. Errors: NAME (no such integrator,
 * sampler, filter or key), ARGUMENT (a value or a crop out of range), UNSUPPORTED (keys that exclude each
 * other or the scene), CANCELLED, MEMORY, and those of files that an integrator reads. */
AUR_EXPERIMENTAL aur_result aur_renderer_render(aur_renderer *renderer, const aur_render_options *options,
                                                aur_image **image, aur_render_statistics *statistics,
                                                aur_error *error) AUR_NONNULL(1, 3);

/* --- a render in steps: for viewers, checkpoints and stopping criteria */

typedef struct aur_render aur_render;

/* Does all preparation before the first sample. The renderer and the data of the options' callbacks must
 * outlive the render; strings are copied. Errors as for aur_renderer_render. */
AUR_EXPERIMENTAL aur_result aur_render_create(aur_renderer *renderer, const aur_render_options *options,
                                              aur_render **render, aur_error *error) AUR_NONNULL(1, 3);
AUR_EXPERIMENTAL void aur_render_destroy(aur_render *render); /* NULL is allowed */

/* Adds `count` samples to every pixel; 0 or too many: all that remain of the options' samples_per_pixel. If a
 * cancelled step left some tiles ahead, the others catch up first. Integrators that depend on a pixel's
 * samples of one step (finalgather's edges) give different images of the same expectation for different
 * steps. Errors: CANCELLED by aur_render_cancel or the progress callback, which are also checked within long
 * tiles; MEMORY and others, after which the render can only be destroyed. After CANCELLED, finished tiles
 * keep their samples. Other tiles keep those that their integrator adds one by one (all but finalgather and
 * radiosity). The next step continues there. */
AUR_EXPERIMENTAL aur_result aur_render_step(aur_render *render, size_t count, aur_error *error)
    AUR_NONNULL(1);
/* Stops the step that another thread is in. May be called from any thread and from a signal handler. */
AUR_EXPERIMENTAL void aur_render_cancel(aur_render *render) AUR_NONNULL(1);

/* Samples per pixel so far, and the final number. */
AUR_EXPERIMENTAL size_t aur_render_samples(const aur_render *render) AUR_NONNULL(1);
AUR_EXPERIMENTAL size_t aur_render_samples_target(const aur_render *render) AUR_NONNULL(1);

/* Whether the image is bit-identical for any division into steps: true for every integrator but finalgather
 * and radiosity. */
AUR_EXPERIMENTAL bool aur_render_steps_agree(const aur_render *render) AUR_NONNULL(1);

/* The film so far, owned by the render: aur_film_develop computes the image, aur_film_error its error, also
 * while another thread is in a step. */
AUR_EXPERIMENTAL const aur_film *aur_render_film(const aur_render *render) AUR_NONNULL(1);

/* Saves a resumable render in a file, which is replaced atomically: its film, its cost, and its identity
 * (version, options, and the contents of the scene and all files that it names). May be called while another
 * thread is in a step, and so from the progress callback. The file then has the finished tiles, and of others
 * the samples that integrators add one by one. Errors: ARGUMENT (not resumable), WRITE, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_render_save(const aur_render *render, const char *path, aur_error *error)
    AUR_NONNULL(1, 2);
/* Continues from such a file, before the first step: the final image is bit-identical to that of an
 * uninterrupted render. Errors: OPEN, FORMAT (no such file, or a damaged one), ARGUMENT (of another scene,
 * other options or another version: the message names the first difference), MEMORY. */
AUR_EXPERIMENTAL aur_result aur_render_resume(aur_render *render, const char *path, aur_error *error)
    AUR_NONNULL(1, 2);
/* Whether a render may be saved in `path`: there is no file, an empty one, or one of aur_render_save. Errors:
 * ARGUMENT. */
AUR_EXPERIMENTAL aur_result aur_render_check_checkpoint(const char *path, aur_error *error) AUR_NONNULL(1);
/* Merges the finished parts of one image: files of aur_render_save by renders with shard = 1 .. shard_count,
 * each once, in any order. The film is bit-identical to that of one render. Errors: as above; ARGUMENT also
 * for a part that is missing, given twice or not finished. */
AUR_EXPERIMENTAL aur_result aur_render_merge_parts(size_t count, const char *const *paths, aur_film **film,
                                                   aur_error *error) AUR_NONNULL(2, 3);

/* The cost of preparation and of the steps so far. May be called while another thread is in a step. Errors:
 * ARGUMENT if `size` is not set. */
AUR_EXPERIMENTAL aur_result aur_render_get_statistics(const aur_render *render,
                                                      aur_render_statistics *statistics, aur_error *error)
    AUR_NONNULL(1, 2);

#ifdef __cplusplus
}
#endif

#endif

/* Rendering a scene into an image, in one call or in steps. The image is a function of the scene, the
 * options, the seed and the steps: the number of threads changes no bit of it.
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

/* What an image is made with: the tables of integrators, materials, shapes and so on; NULL beyond the last.
 * Those of sets and measures are aur_table_at's. */
AUR_EXPERIMENTAL const aur_table *aur_render_table_at(size_t index);

enum { AUR_RENDER_LEVELS = 8 };

/* `size` is set by the caller to the size of his struct. */
typedef struct aur_render_statistics {
    size_t size;
    uint64_t rays;            /* traced, of all kinds: also photons, and those that find light sources */
    uint64_t samples;         /* camera samples */
    uint64_t invalid_samples; /* NaN, infinite or negative ones, left out of the image */
    uint64_t cut_paths; /* cut after many mirrors or null collisions in a row: the light that they would bring
                           is missing */
    /* Systems of finalgather-lab, weights=oswa-solve, without a solution. Their samples are invalid. */
    uint64_t unsolved_weights;
    uint64_t levels[AUR_RENDER_LEVELS]; /* adaptive gathering: places that ended at each level */
    double prepare_seconds;             /* wall clock: photon map and the like */
    double render_seconds;              /* wall clock, in steps */
    double cpu_seconds;                 /* of the process, for both */
} aur_render_statistics;

/* All zero but `size`, as aur_render_options_init fills it, renders what the scene says. */
typedef struct aur_render_options {
    size_t size;              /* of the caller's struct, so that it can grow */
    const char *integrator;   /* NAME[:key=value,...] instead of the scene's; NULL keeps it */
    const char *sampler;      /* SET instead of the scene's; NULL keeps it */
    const char *filter;       /* the name of a filter instead of the scene's; NULL keeps it */
    size_t samples_per_pixel; /* 0 keeps the scene's */
    uint64_t seed;
    size_t threads;       /* 0: all */
    size_t width, height; /* 0 keeps the scene's, or its shape where the other one is given */
    /* Pixels x0 <= x < x1, y0 <= y < y1; all zero: what the scene's film says. */
    size_t crop_x0, crop_x1, crop_y0, crop_y1;
    aur_progress progress;
    aur_warnings warnings;
    /* For aur_render_save: the scene's files are hashed when the render is made. */
    bool resumable;
    /* Of shard_count parts of the image, the shard-th, from 1 on: every shard_count-th tile of 16 x 16
     * pixels. Both 0: all of it. The others stay black until they are merged. */
    size_t shard, shard_count;
    /* Photon maps and tables of weights are taken from the user's cache folder, and left there for later
     * runs: in AUREOLE_CACHE, aureole in XDG_CACHE_HOME, or .cache/aureole in HOME. No bit depends on it. */
    bool use_cache;
    /* One more integrator, which `integrator` or the scene may name (gather.h); NULL: none. */
    const aur_gather_integrator *gather;
    /* The key `clamp` of `path` and `volpath`, for whichever integrator is used; 0: no limit. */
    double clamp;
} aur_render_options;

AUR_EXPERIMENTAL aur_result aur_render_options_init(aur_render_options *options, aur_error *error)
    AUR_NONNULL(1);

/* Renders images of one scene and keeps between them what they share (a photon map, for one). The scene
 * must outlive it. Not for two threads at once. */
typedef struct aur_renderer aur_renderer;

/* Errors: FORMAT for a scene without a camera, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_renderer_create(const aur_scene *scene, aur_renderer **renderer,
                                                aur_error *error) AUR_NONNULL(1, 2);
AUR_EXPERIMENTAL void aur_renderer_destroy(aur_renderer *renderer); /* NULL is allowed */

/* Whether the scene's own integrator is one of the library or `gather` (NULL: none), and its keys can be
 * read: what a render asks first whose options name no other. Errors: as those of aur_render_create, with
 * their place in the scene file. */
AUR_EXPERIMENTAL aur_result aur_render_check_scene(const aur_scene *scene,
                                                   const aur_gather_integrator *gather, aur_error *error)
    AUR_NONNULL(1);

/* A new image of channels R, G, B and those that the integrator adds, all samples in one step. `options`
 * may be NULL, `statistics` too. When the progress callback stops the work, the result is CANCELLED and
 * *image is the image so far; with every other error it is NULL. Errors: NAME (no such integrator, sampler,
 * filter or key), ARGUMENT (a value or a crop out of range), UNSUPPORTED (keys or a scene that do not go
 * together), CANCELLED, MEMORY, and those of files that an integrator reads. */
AUR_EXPERIMENTAL aur_result aur_renderer_render(aur_renderer *renderer, const aur_render_options *options,
                                                aur_image **image, aur_render_statistics *statistics,
                                                aur_error *error) AUR_NONNULL(1, 3);

/* --- a render in steps: for a viewer, a checkpoint, or whoever decides on the way when it is enough */

typedef struct aur_render aur_render;

/* Prepares all that comes before the first sample. The renderer must outlive the render, and so must what the
 * options' callbacks use; texts are copied. Errors as for aur_renderer_render. */
AUR_EXPERIMENTAL aur_result aur_render_create(aur_renderer *renderer, const aur_render_options *options,
                                              aur_render **render, aur_error *error) AUR_NONNULL(1, 3);
AUR_EXPERIMENTAL void aur_render_destroy(aur_render *render); /* NULL is allowed */

/* Gives every pixel `count` more samples; 0 or too many: all that remain of the options' samples_per_pixel.
 * Where a tile is ahead of the others because an earlier step was cancelled, the others catch up first.
 * Integrators that decide by a pixel's samples of one step (finalgather's edges) give other images of the
 * same light for other steps. Errors: CANCELLED by aur_render_cancel or the progress callback, both of
 * which are also asked within long tiles: tiles that were finished keep their samples, others those that
 * their integrator adds one after the other (all but finalgather and radiosity), and the next step goes on
 * where this one was stopped; MEMORY and others, after which the render can only be destroyed. */
AUR_EXPERIMENTAL aur_result aur_render_step(aur_render *render, size_t count, aur_error *error)
    AUR_NONNULL(1);
/* Stops the step that another thread is in. May be called from any thread and from a signal handler. */
AUR_EXPERIMENTAL void aur_render_cancel(aur_render *render) AUR_NONNULL(1);

/* Samples that every pixel has, and that it will have. */
AUR_EXPERIMENTAL size_t aur_render_samples(const aur_render *render) AUR_NONNULL(1);
AUR_EXPERIMENTAL size_t aur_render_samples_wanted(const aur_render *render) AUR_NONNULL(1);

/* Whether the image has the same bits in whatever steps it is made: so it is with every integrator but
 * finalgather and radiosity. */
AUR_EXPERIMENTAL bool aur_render_steps_agree(const aur_render *render) AUR_NONNULL(1);

/* The film so far, owned by the render: aur_film_develop makes the image, aur_film_error tells its error,
 * also while another thread is in a step. */
AUR_EXPERIMENTAL const aur_film *aur_render_film(const aur_render *render) AUR_NONNULL(1);

/* Keeps a resumable render in a file, which is replaced whole or not at all: its film, what it has cost, and
 * what it is of - version, scene and all files that it names by their content, options. May be called while
 * another thread is in a step, and so from the progress callback: then it has the tiles that are finished,
 * and of others the samples that integrators add one after the other. Errors: ARGUMENT (not resumable),
 * WRITE, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_render_save(const aur_render *render, const char *path, aur_error *error)
    AUR_NONNULL(1, 2);
/* Goes on from such a file, before the first step: the image in the end has the bits of a render that was
 * never stopped. Errors: OPEN, FORMAT (no such file, or a damaged one), ARGUMENT (of another scene, other
 * options or another version: the message names the first difference), MEMORY. */
AUR_EXPERIMENTAL aur_result aur_render_resume(aur_render *render, const char *path, aur_error *error)
    AUR_NONNULL(1, 2);
/* Whether a render may be kept in `path`: there is no file, an empty one, or one of aur_render_save. Errors:
 * ARGUMENT.
 */
AUR_EXPERIMENTAL aur_result aur_render_check_checkpoint(const char *path, aur_error *error) AUR_NONNULL(1);
/* Puts the finished parts of one image together, files of aur_render_save by renders with shard = 1 ..
 * shard_count, each once, in any order: the film has the bits of one render of all. Errors: as above;
 * ARGUMENT also for a part that is missing, given twice or not finished. */
AUR_EXPERIMENTAL aur_result aur_render_merge_parts(size_t count, const char *const *paths, aur_film **film,
                                                   aur_error *error) AUR_NONNULL(2, 3);

/* What preparing and the steps so far have cost. May be called while another thread is in a step. Errors:
 * ARGUMENT when `size` is not set. */
AUR_EXPERIMENTAL aur_result aur_render_get_statistics(const aur_render *render,
                                                      aur_render_statistics *statistics, aur_error *error)
    AUR_NONNULL(1, 2);

#ifdef __cplusplus
}
#endif

#endif

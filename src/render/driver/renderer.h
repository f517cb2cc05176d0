/* What rooms above, and other files of this one, know of a renderer and of its renders. */
#pragma once

#include <aureole-render/render.h>
#include <time.h>

#include "render/film/film.h"
#include "render/scene/scene.h"

const aur_scene *aur_renderer_scene(const aur_renderer *renderer);
struct aur_cache *aur_renderer_cache(const aur_renderer *renderer);

/* What a render with these options is of, a line "KEY VALUE" each (render/film/film.h). The text is
 * allocated with malloc. Errors: OPEN when a file of the scene is gone, MEMORY. */
aur_result aur_render_identify(const aur_scene *scene, const aur_render_options *options, char **identity,
                               aur_error *error);
/* NULL for a render that is not resumable. */
const char *aur_render_identity(const aur_render *render);

/* What renders, as its keys have made it. */
const struct aur_integrator *aur_render_integrator(const aur_render *render);

/* What the render has taken, but for what its film counts, as words of a file, and added to its own. */
enum { AUR_SPENT_WORDS = 4 };
void aur_render_put_spent(const aur_render *render, uint64_t words[AUR_SPENT_WORDS]);
void aur_render_take_spent(aur_render *render, const uint64_t words[AUR_SPENT_WORDS]);

/* Whether a checkpoint is of one render (parts.c). Errors: ARGUMENT. */
aur_result aur_render_check_kind(const char *path, const aur_checkpoint *checkpoint, aur_error *error);

/* What a render is to do. */

/* Puts the scene's own values into the options in the places that were left open, and finds the filter.
 * Errors: NAME for a filter, ARGUMENT for a crop. */
aur_result aur_render_options_complete(const aur_scene *scene, aur_render_options *options,
                                       const aur_filter **filter, aur_error *error);

/* A stretch of work by two clocks. */

typedef struct aur_stopwatch {
    double wall, cpu;
} aur_stopwatch;

static inline double aur_clock_seconds(clockid_t clock) {
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static inline aur_stopwatch aur_stopwatch_start(void) {
    return (aur_stopwatch){aur_clock_seconds(CLOCK_MONOTONIC), aur_clock_seconds(CLOCK_PROCESS_CPUTIME_ID)};
}

/* Adds the seconds since the start. */
static inline void aur_stopwatch_add(const aur_stopwatch *start, double *wall, double *cpu) {
    *wall += aur_clock_seconds(CLOCK_MONOTONIC) - start->wall;
    *cpu += aur_clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - start->cpu;
}

/* aur_render_step pixel by pixel: pixel i of the film, row by row, gets the samples that it lacks up to
 * targets[i], so that samples can go where they are needed. Where pixels share what they find (`radiosity`,
 * finalgather's `share=true`), all of a tile of 16 x 16 pixels get as many as the one that is to have most.
 * Errors as above; ARGUMENT when the film has not `pixel_count` pixels, or a target is beyond
 * samples_per_pixel. */
aur_result aur_render_step_pixels(aur_render *render, size_t pixel_count, const uint32_t *targets,
                                  aur_error *error);
/* Takes over the samples of a film of the same scene, options and seed, such as one saved earlier: the render
 * goes on where that one ended. Errors as for aur_film_merge. */
aur_result aur_render_merge(aur_render *render, const aur_film *film, aur_error *error);

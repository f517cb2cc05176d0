/* Internals of a renderer and of its renders, for layers above and other files of this one. */
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

/* The integrator, as configured by its keys. */
const struct aur_integrator *aur_render_integrator(const aur_render *render);

/* The cost of the render besides the film's counters: written as words of a file, and added from them. */
enum { AUR_SPENT_WORDS = 4 };
void aur_render_put_spent(const aur_render *render, uint64_t words[AUR_SPENT_WORDS]);
void aur_render_take_spent(aur_render *render, const uint64_t words[AUR_SPENT_WORDS]);

/* Whether a checkpoint is of a single render (parts.c). Errors: ARGUMENT. */
aur_result aur_render_check_kind(const char *path, const aur_checkpoint *checkpoint, aur_error *error);

/* What a render is to do. */

/* Fills unset options from the scene, and finds the filter. Errors: NAME for a filter, ARGUMENT for a crop.
 */
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

/* Adds the seconds since the start. In a job of several processes, which all call it: rank 0's wall clock,
 * and the processors' sum. */
void aur_stopwatch_add(const aur_stopwatch *start, double *wall, double *cpu);

/* aur_render_step with a target per pixel: pixel i of the film, row by row, gets its missing samples up to
 * targets[i]. Where pixels share results (`radiosity`, finalgather's `share=true`), all of a tile of 16 x 16
 * pixels get the largest target of any of them. Errors as above; ARGUMENT if the film does not have
 * `pixel_count` pixels, or a target exceeds samples_per_pixel. */
aur_result aur_render_step_pixels(aur_render *render, size_t pixel_count, const uint32_t *targets,
                                  aur_error *error);
/* Takes over the samples of a film of the same scene, options and seed, such as one saved earlier: the render
 * continues from there. Errors as for aur_film_merge. */
aur_result aur_render_merge(aur_render *render, const aur_film *film, aur_error *error);

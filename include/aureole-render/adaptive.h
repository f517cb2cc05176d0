/* Rendering to a target error or within a budget of time or rays. Several independent replicas of the scene,
 * with different random numbers, are rendered side by side; their mean is the image, and their spread gives
 * its error. Pixels with more variance receive more samples. The image is a function of scene, options and
 * seed, on any number of threads. */
#ifndef AUREOLE_ADAPTIVE_H
#define AUREOLE_ADAPTIVE_H

#include <aureole-render/render.h>

#ifdef __cplusplus
extern "C" {
#endif

/* `size` is set by the caller. Rendering stops after the first round of samples that reaches one of the
 * targets that are not zero; without any, after the round that brings the error below 1 %. */
typedef struct aur_adaptive_options {
    size_t size;
    /* Target of the error by `measure`: rendering stops when the upper confidence bound is below this. In
     * (0, 1]. */
    double error;
    double seconds; /* wall clock, including preparation: the only target that makes the image depend on the
                       machine */
    uint64_t rays;
    uint64_t rounds;
    /* Systematic error to allow for the named integrator, relative as `error` and below it if that is not
     * zero. The target of the noise is reduced by it, and the reported error includes it. 0 if the integrator
     * is chosen automatically: then its bias is measured. */
    double bias;
    double confidence; /* of the interval, in [.5, .9999]; 0: .95 */
    /* Independent renderings, 3 to 16; 0: 4. Without a target error also 1: no error is estimated, and all
     * pixels get the same number of samples, which are stratified together. */
    size_t replicas;
    aur_error_measure measure; /* of `error` and `bias`; samples go where this error falls most for them */
    /* Not 0: candidates whose neighbouring pixels share gather directions are not tried, because denoisers
     * keep noise that pixels share. */
    int independent_pixels;
} aur_adaptive_options;

AUR_EXPERIMENTAL aur_result aur_adaptive_options_init(aur_adaptive_options *options, aur_error *error)
    AUR_NONNULL(1);

typedef struct aur_adaptive aur_adaptive;

/* `render` as for aur_render_create, but without `samples_per_pixel`. `sampler` NULL means Owen-scrambled
 * Sobol points. `integrator` NULL means the scene's if it renders another quantity or in a specific way
 * (`ao`, `direct`, `radiosity`, `depth`, `aov`). Otherwise it means `path` or `finalgather` with the scene's
 * max_depth, whichever is measured to need less work for the target. Both options may be NULL. The renderer
 * must outlive it. Errors: those of aur_render_create, ARGUMENT for a target out of range. */
AUR_EXPERIMENTAL aur_result aur_adaptive_create(aur_renderer *renderer, const aur_render_options *render,
                                                const aur_adaptive_options *options, aur_adaptive **adaptive,
                                                aur_error *error) AUR_NONNULL(1, 4);
AUR_EXPERIMENTAL void aur_adaptive_destroy(aur_adaptive *adaptive); /* NULL is allowed */

/* Renders rounds until the target is met. Errors: CANCELLED by aur_adaptive_cancel or the progress callback;
 * MEMORY and others, after which it can only be destroyed. After CANCELLED the image has the samples of
 * finished tiles, the report is that of the last complete round, and another call continues to the same image
 * as without interruption. */
AUR_EXPERIMENTAL aur_result aur_adaptive_run(aur_adaptive *adaptive, aur_error *error) AUR_NONNULL(1);
/* Stops aur_adaptive_run in another thread; may be called from a signal handler. */
AUR_EXPERIMENTAL void aur_adaptive_cancel(aur_adaptive *adaptive) AUR_NONNULL(1);

/* As aur_render_save and aur_render_resume, if the render options have `resumable`: the rounds continue as
 * without interruption. */
AUR_EXPERIMENTAL aur_result aur_adaptive_save(aur_adaptive *adaptive, const char *path, aur_error *error)
    AUR_NONNULL(1, 2);
AUR_EXPERIMENTAL aur_result aur_adaptive_resume(aur_adaptive *adaptive, const char *path, aur_error *error)
    AUR_NONNULL(1, 2);

/* An error, and the interval that contains it with the confidence of the options. */
typedef struct aur_error_figures {
    double error, low, high;
} aur_error_figures;

/* `size` is set by the caller to the size of his struct. */
typedef struct aur_adaptive_report {
    size_t size;
    /* By the measure of the options: of this image, not of images with other seeds. Infinite before the first
     * round, of a single replica, and for an image that is black. */
    double error, error_low, error_high;
    double mean; /* over all pixels and channels R, G, B */
    /* Independent values that the error consists of: about one per pixel and channel for noise, few if all
     * pixels share an error, such as that of one photon map. */
    double degrees;
    uint64_t rounds;
    double samples_per_pixel; /* mean over the image, of all replicas and finished rounds: the error's */
    size_t replicas;
    /* Of all replicas together, and of what was tried; the time for statistics and plans is in the render
     * seconds. Its size is set here. */
    aur_render_statistics statistics;
    /* Rays of rejected candidates and of their preparation, counted even if its result came from the renderer
     * or the file cache. */
    uint64_t candidate_rays;
    double bias_high; /* of the error: an upper bound of the systematic error; 0 for an unbiased integrator */
    /* The error by every measure; each includes the bias only as far as `error` does. Those by other measures
     * than the target's are computed once a round, when a report is asked for. */
    aur_error_figures errors[AUR_ERROR_MEASURE_COUNT];
    double bias_room;  /* the part of the target error reserved for bias: it gives the same image with a named
                          integrator */
    size_t race_count; /* candidates of the race; 0: there was none */
} aur_adaptive_report;

/* After aur_adaptive_resume the report is that of the saved image. Errors: ARGUMENT when `size` is not set.
 */
AUR_EXPERIMENTAL aur_result aur_adaptive_get_report(aur_adaptive *adaptive, aur_adaptive_report *report,
                                                    aur_error *error) AUR_NONNULL(1, 2);

/* A candidate of the race for the integrator. Work is counted in rays, and a photon as two and a half: no
 * clock decides. `size` is set by the caller. The texts are owned by `adaptive`. */
typedef struct aur_adaptive_candidate {
    size_t size;
    const char *name, *reason; /* why it was taken or not */
    bool taken;
    size_t pixels; /* of the image that it rendered */
    double rays;   /* that this took */
    double need;   /* the work that it is expected to need to the target error; 0: not measured */
} aur_adaptive_candidate;

/* Errors: ARGUMENT for an index of race_count and above, or when `size` is not set. */
AUR_EXPERIMENTAL aur_result aur_adaptive_get_candidate(const aur_adaptive *adaptive, size_t index,
                                                       aur_adaptive_candidate *candidate, aur_error *error)
    AUR_NONNULL(1, 3);

/* The integrator with its keys, as aur_render_options take it. `adaptive` owns the text. */
AUR_EXPERIMENTAL const char *aur_adaptive_integrator(const aur_adaptive *adaptive) AUR_NONNULL(1);

/* The image, a new one with channels R, G, B. With `errors` also error.R, error.G, error.B, unless there is
 * a single replica: the standard error of each value, estimated from the replicas, in the image's units. With
 * aur_render_options' `clamp` also clamped.R, .G, .B. Other channels that an integrator adds are left out,
 * which aur_adaptive_create warns of. This function and aur_adaptive_get_report may also be called from the
 * progress callback. Errors: UNSUPPORTED while there is no image yet, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_adaptive_develop(const aur_adaptive *adaptive, bool errors, aur_image **image,
                                                 aur_error *error) AUR_NONNULL(1, 3);

/* The mean of the replicas with even (half 0) or odd numbers (half 1): channels and errors as
 * aur_adaptive_develop. The halves are independent of each other. Errors: ARGUMENT for another half,
 * UNSUPPORTED while there is no image yet, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_adaptive_develop_half(const aur_adaptive *adaptive, size_t half,
                                                      aur_image **image, aur_error *error) AUR_NONNULL(1, 3);
/* The error of a denoiser, by the measure of the options: `made[h]` is the denoised image of half h; its
 * first channels are R, G and B. Each is compared with the other half, whose independent noise averages out,
 * so the estimate needs no reference. The interval includes the noise of the estimate, over blocks of 8 x 8
 * pixels. A denoised image of all replicas has about half of the halves' variance. Errors: ARGUMENT for
 * images of another size, MEMORY. */
AUR_EXPERIMENTAL aur_result aur_adaptive_compare_halves(const aur_adaptive *adaptive,
                                                        const aur_image *const processed[2],
                                                        aur_error_figures *figures, aur_error *error)
    AUR_NONNULL(1, 2, 3);

#ifdef __cplusplus
}
#endif

#endif

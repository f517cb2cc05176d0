/* What a choice of the integrator by trial compares, and the search for a photon map among it. */
#pragma once

#include "render/adaptive/candidate.h"
#include "render/adaptive/choose.h"

/* How many candidates for points on lights path tracing is to have at each surface (path:candidates). */

/* "path[:key=value...]" with so many candidates. A new text, or NULL where memory is short. */
char *aur_adaptive_path(const char *path, size_t candidates);

/* What candidates were found to be best, and what they take of one candidate's time to an error. */
typedef struct aur_candidates {
    size_t count;
    double cost;
} aur_candidates;

/* How many choices there are, and the samples of each replica that one is looked at by. */
enum { AUR_CANDIDATE_CHOICES = 3, AUR_CANDIDATE_SAMPLES = 2 };

/* Looks at the choices in few pixels (`coarse`), by as many samples each. `spent`: all rays of these. Errors:
 * CANCELLED, MEMORY, and those of rendering. */
aur_result aur_adaptive_candidates(aur_renderer *renderer, const aur_render_options *coarse,
                                   const aur_choice *choice, aur_candidates *found, aur_spent *spent,
                                   aur_error *error);

/* Of the error asked, the bias that may be left; the noise makes the rest of the square. */
#define AUR_BIAS_PART 0.6

/* What is compared, in few pixels but for the last; and what final gathering's photon map is wrong by. The
 * trial of path tracing is the picture's own where that is small. */
typedef struct aur_comparison {
    aur_renderer *renderer;
    const aur_render_options *options; /* of the picture */
    double wanted;                     /* the error asked, or the one when rays or time will be spent */
    double path_error;                 /* the same by path tracing */
    aur_candidate path, pilots[AUR_PILOT_KINDS], difference, gather;
    double pixels;             /* of the picture, over those of the few */
    aur_gather_pilots told;    /* by the pilots */
    aur_gather_model model;    /* that they lead to */
    aur_candidates candidates; /* of path tracing */
} aur_comparison;

/* What is asked of few pixels, each in place of `part` x `part`, or of fewer where that would leave a small
 * picture. The bias of single points is that of pixels at least, and known from as many rays the better the
 * fewer points they are of: what is uncertain of its square is as the root of their number. */
enum { AUR_COARSE_PIXELS = 4, AUR_COARSE_POINTS = 8 };
aur_render_options aur_comparison_coarse(const aur_comparison *comparison, const aur_candidate *whole,
                                         size_t part);

/* By `integrator`, a text that becomes the trial's, or NULL where memory was short. Errors: as of
 * aur_candidate_create. */
aur_result aur_comparison_create(const aur_comparison *comparison, const aur_choice *choice,
                                 const aur_render_options *options, char *integrator,
                                 aur_candidate *candidate, aur_error *error);

/* Plans and renders one round exactly as the final render would. False at the sample cap. */
aur_result aur_comparison_round(const aur_choice *choice, const aur_goal *goal, aur_candidate *candidate,
                                bool *more, aur_error *error);

/* Pilots of final gathering, the first one and whichever costs little beside the picture, as those before
 * tell; and the law that they lead to. Where no error is asked, the one is wanted to which final gathering
 * takes most of `worth` rays. `path` is path tracing of the same pixels, and lends its scratch. */
aur_result aur_comparison_render_pilots(aur_comparison *comparison, const aur_render_options *coarse,
                                        const aur_choice *choice, double worth, aur_candidate *path,
                                        aur_error *error);

/* Rays of the whole picture to the error wanted by final gathering whose bias has this square. */
double aur_comparison_gather_rays(const aur_comparison *comparison, const aur_choice *choice,
                                  double square_bias);
/* The same where its bias is all that may be left. */
double aur_comparison_planned_rays(const aur_comparison *comparison, const aur_choice *choice);

/* A map of a small enough bias, if there is one: choice->gather.photons and ->bias. Where that of the photons
 * which a picture of so many rays pays for is near it, one is tried that path tracing's rays, `worth` of
 * which final gathering may take, would pay for. */
aur_result aur_comparison_find_map(aur_comparison *comparison, aur_choice *choice, double rays, double worth,
                                   aur_error *error);

/* Pixels that have an error of their own beside all others. */

/* What they make of a trial: rounds give such pixels more samples, so that the directions of a pattern are
 * for the others. */
typedef struct aur_outliers {
    double rest;  /* of the trial's squared error, what the others have; 1 where no pixels stand out */
    double price; /* rays that the trial needs to bring them to the error of the others, over its own */
} aur_outliers;

/* The hundredth of all pixels in which samples of path tracing vary most, where they have most of the error
 * of a trial by another integrator: a lamp that is smaller than a pixel, or its image in a mirror. What an
 * integrator finds seldom lies anywhere, and hardly in the same pixels as what the other one does. Both
 * trials are of the same pixels and have had a round; `path` lends its scratch. */
aur_outliers aur_outliers_find(aur_candidate *path, const aur_candidate *candidate);

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/candidates.h"
#include "ask/rounds.h"
#include "core/error.h"
#include "film/film.h"
#include "render/renderer.h"

/* Of the error asked, the bias that may be left; the noise makes the rest of the square. */
static const double BIAS_PART = 0.6;
/* Final gathering is worth it at this part of path tracing's rays, all that it takes to know together: what
 * its rays cost differs by scene (in two boxes as much and half as much again as those of paths, in the room
 * nearly three times as much, where it was twice as slow as path tracing with .6), and a guess from few
 * pixels may be wrong. It is chosen: it costs time, never truth. */
static const double WORTH = 0.45;
/* Of path tracing's rays, what the pilot's map may cost: final gathering is not looked at in small pictures.
 */
static const double PILOT_PART = 0.01;
/* Of path tracing's rays, what it may cost to choose its candidates. */
static const double CANDIDATES_PART = 0.08;
/* Of final gathering's rays, what each further pilot may cost, which takes about twice the first one's. */
static const double FURTHER_PILOT_PART = 0.1;
/* More than so many times the rays of a first pattern are not spent on shared ones. What is shared comes to
 * whole tiles, so that a few pixels that have the error, as of a lamp's edge, would cost all about them. */
static const double MOST_GROWTH_SHARED = 2.0;
/* Where a map is wrong by too much, one of so many times the photons is tried, unless its squared bias, which
 * falls hardly faster than photons grow, would have to fall by more than this. In the room to 2 % 1.11 % of
 * the mean were known for the bias of 4 million photons after 150 million rays, where 1.2 % may be left; of 8
 * million 13 million rays told that it is under 1.05 %. */
enum { MAP_GROWTH = 4 };
static const double MOST_MENDED = 3.0;
/* Of the rays that may be spent for the bias, those before which little is said of it. */
static const double LEAST_PART = 1.0 / 32;
/* A ray that goes on as a path takes so much more time than one of final gathering. */
static const double DIFFERENCE_PRICE = 1.7;

/* The rays that a trial is thought to take in all until its noise is `error`. */
static double rays_to(const aur_trial *trial, double error) {
    return aur_trial_rays(trial) * aur_trial_growth(trial, error);
}

/* As many samples in every pixel. Samples that go where the first ones differ make a picture whose mean is
 * not quite that of its integrator, which would pass for a difference between integrators. */
static aur_result render_evenly(const aur_choice *choice, aur_trial *trial, uint32_t samples,
                                aur_error *error) {
    aur_trial_plan_evenly(trial, samples);
    return aur_trial_render(trial, choice->confidence, choice->cancelled, error);
}

/* The next round, as whoever goes on with the trial would plan it. False where no pixel can have more. */
static aur_result render_round(const aur_choice *choice, const aur_goal *goal, aur_trial *trial, bool *more,
                               aur_error *error) {
    aur_trial_look_ahead(trial, goal);
    *more = aur_trial_plan(trial, trial->rounds > 0 ? aur_trial_factor(trial, goal) : 1.0);
    return *more ? aur_trial_render(trial, choice->confidence, choice->cancelled, error) : AUR_OK;
}

/* What is compared, in few pixels but for the last; and what final gathering's photon map is wrong by. The
 * trial of path tracing is the picture's own where that is small. */
typedef struct aur_rivals {
    aur_trial path, pilot, lit_pilot, bright_pilot, difference, gather;
    double pixels;              /* of the picture, over those of the few */
    aur_gather_pattern pattern; /* as the pilots tell */
    aur_candidates candidates;  /* of path tracing */
} aur_rivals;

/* The part of the rays or of the time that path tracing of the whole picture would have spent. */
static double part_spent(const aur_choice *choice, const aur_trial *path, double pixels) {
    aur_render_statistics spent;
    aur_trial_spent(path, &spent);
    const double rays = choice->goal.rays > 0 ? (double)spent.rays / (double)choice->goal.rays : 0.0;
    const double seconds =
        choice->seconds > 0.0 ? (spent.prepare_seconds + spent.render_seconds) / choice->seconds : 0.0;
    return pixels * fmax(rays, seconds);
}

/* Path tracing until it has come so far that its error at the end can be told, which is that asked, or the
 * one when rays or time will be spent. */
static aur_result render_path(const aur_choice *choice, aur_trial *path, double pixels, double *wanted,
                              aur_error *error) {
    aur_goal goal = choice->goal;
    goal.rays = (uint64_t)ceil((double)goal.rays / pixels);
    aur_result result = AUR_OK;
    double left = 0.0;
    for (bool more = true; result == AUR_OK && more;) {
        const double spent = part_spent(choice, path, pixels);
        left = fmax(goal.error, path->bound * sqrt(spent));
        if (path->rounds > 1 && path->bound <= AUR_PILOT_ERROR * left)
            break;
        result = render_round(choice, &goal, path, &more, error);
        more = more && !aur_trial_is_black(path);
    }
    *wanted = left;
    return result;
}

static double noise_beside(double wanted, double square_bias) {
    return sqrt(fmax(wanted * wanted - square_bias, 0.0));
}

/* Rays of a whole picture to an error by final gathering of such a bias. */
static double gather_rays(const aur_choice *choice, const aur_rivals *rivals, double wanted,
                          double square_bias) {
    return (double)choice->trial.replicas.pixel_count *
           aur_gather_rays(&rivals->pattern, aur_gather_noise_planned(wanted, square_bias));
}

/* What is uncertain of a squared bias: it falls as samples grow. */
static double uncertain(const aur_bias *bias) {
    return bias->high - fmax(bias->estimate, 0.0);
}

/* Whether twice the rays for the bias cost less than the noise takes that its bound leaves no room for. */
static bool pays(const aur_choice *choice, const aur_rivals *rivals, double wanted) {
    const aur_bias *const bias = &choice->bias;
    return gather_rays(choice, rivals, wanted, bias->high) -
               gather_rays(choice, rivals, wanted, bias->high - 0.5 * uncertain(bias)) >
           DIFFERENCE_PRICE * aur_trial_rays(&rivals->difference);
}

/* How many times as many rays show that a squared bias is no more than `most`, if its estimate is too large
 * by chance: a little beyond that, and a step that is worth a look. Infinite where the estimate is too much
 * by more than chance. Who goes on loses little before a part of all rays is spent, and who gives up takes
 * paths: until then the estimate may be wrong by more, as the first few samples are where few of them have
 * most of the square (one sample of the room told at least .055 where .016 is true). */
static double growth_needed(const aur_bias *bias, double most, double part_spent) {
    const double chance = part_spent < LEAST_PART ? 2.0 : 0.5;
    const double room = most - fmax(bias->estimate - chance * uncertain(bias), 0.0);
    return room > 0.0 ? fmax(1.2 * uncertain(bias) / room, 1.25) : INFINITY;
}

/* Whether another map will do sooner than knowing this one better: its bias is near what may be left, which
 * is shown by rays without end. */
static bool wants_larger_map(const aur_bias *bias, double most, double part_spent) {
    return bias->high > most && bias->estimate > 0.5 * most && part_spent > LEAST_PART;
}

/* The bias of final gathering, from pictures of what paths find over what the map says at the ends of the
 * same gather rays. What they have in common, above all direct light and short rays, is not traced. They go
 * on until the bias is under what may be left and knowing it better does not pay, or it is seen that it will
 * hardly come there, or not before so many rays are spent. */
static aur_result find_bias(aur_choice *choice, aur_rivals *rivals, double wanted, double most_rays,
                            bool may_be_larger, aur_error *error) {
    const double most = BIAS_PART * BIAS_PART * wanted * wanted;
    aur_bias *const bias = &choice->bias;
    for (uint32_t samples = 1;;) {
        const aur_result result = render_evenly(choice, &rivals->difference, samples, error);
        if (result != AUR_OK)
            return result;
        *bias = aur_replicas_bias(&rivals->difference.replicas, NULL, rivals->pilot.measure.mean,
                                  choice->confidence);
        const double rays = aur_trial_rays(&rivals->difference);
        const double growth = growth_needed(bias, most, rays / most_rays);
        if (bias->high <= most ? !pays(choice, rivals, wanted) : growth * rays > most_rays)
            return AUR_OK;
        if (may_be_larger && wants_larger_map(bias, most, rays / most_rays))
            return AUR_OK;
        samples = (uint32_t)ceil(samples * (bias->high <= most ? 2.0 : fmin(growth, 4.0)));
    }
}

/* What is asked of few pixels, each in place of `part` x `part`, or of fewer where that would leave a small
 * picture. The bias of single points is that of pixels at least, and known from as many rays the better the
 * fewer points they are of: what is uncertain of its square is as the root of their number. */
enum { COARSE_PIXELS = 4, COARSE_POINTS = 8 };

static aur_render_options coarse_options(const aur_trial *trial, const aur_render_options *options,
                                         size_t part) {
    enum { LEAST_SIDE = 32 };
    const aur_film_layout *const film = &aur_render_film(trial->replicas.renders[0])->layout;
    const size_t width = film->x1 - film->x0, height = film->y1 - film->y0;
    while (part > 1 && (width < LEAST_SIDE * part || height < LEAST_SIDE * part))
        part /= 2;
    aur_render_options own = *options;
    own.width = (film->width + part - 1) / part;
    own.height = (film->height + part - 1) / part;
    own.crop_x0 = film->x0 / part;
    own.crop_y0 = film->y0 / part;
    own.crop_x1 = (film->x1 + part - 1) / part;
    own.crop_y1 = (film->y1 + part - 1) / part;
    return own;
}

static aur_result create_trial(aur_renderer *renderer, const aur_render_options *options,
                               const aur_choice *choice, char *integrator, aur_trial *trial,
                               aur_error *error) {
    trial->integrator = integrator;
    return integrator != NULL ? aur_trial_create(renderer, options, choice->replica_count, trial, error)
                              : aur_fail_memory(error);
}

static aur_pilot_outcome outcome_of(const aur_trial *pilot) {
    return (aur_pilot_outcome){pilot->interval.estimate,
                               aur_trial_rays(pilot) / (double)pilot->replicas.pixel_count};
}

static aur_result render_pilot(aur_renderer *renderer, const aur_render_options *coarse,
                               const aur_choice *choice, size_t lights, size_t bright, aur_trial *pilot,
                               aur_error *error) {
    char *const text = aur_ask_gather_pilot(choice->trial.integrator, choice->gather.seed, lights, bright);
    const aur_result result = create_trial(renderer, coarse, choice, text, pilot, error);
    bool goes_on;
    return result == AUR_OK ? render_round(choice, &choice->goal, pilot, &goes_on, error) : result;
}

/* What another pilot may cost. */
static double further_rays(const aur_choice *choice, const aur_rivals *rivals, double wanted) {
    return FURTHER_PILOT_PART * gather_rays(choice, rivals, wanted, pow(BIAS_PART * wanted, 2.0));
}

/* Pilots of final gathering, with few points on lights and, where that costs little beside the picture, with
 * more, and then with points on bright texels. */
static aur_result render_pilots(aur_renderer *renderer, const aur_render_options *coarse,
                                const aur_choice *choice, double wanted, aur_rivals *rivals,
                                aur_error *error) {
    aur_result result = render_pilot(renderer, coarse, choice, AUR_PILOT_LIGHTS, 0, &rivals->pilot, error);
    if (result != AUR_OK || aur_trial_is_black(&rivals->pilot))
        return result;
    const aur_pilot_outcome few = outcome_of(&rivals->pilot);
    rivals->pattern = aur_gather_pattern_of(few, few);
    if (2.0 * aur_trial_rays(&rivals->pilot) > further_rays(choice, rivals, wanted))
        return AUR_OK;
    result = render_pilot(renderer, coarse, choice, AUR_PILOT_LIGHTS_MORE, 0, &rivals->lit_pilot, error);
    if (result != AUR_OK || aur_trial_is_black(&rivals->lit_pilot))
        return result;
    const aur_pilot_outcome more = outcome_of(&rivals->lit_pilot);
    rivals->pattern = aur_gather_pattern_of(few, more);
    if (aur_trial_rays(&rivals->lit_pilot) > further_rays(choice, rivals, wanted))
        return AUR_OK;
    result = render_pilot(renderer, coarse, choice, AUR_PILOT_LIGHTS_MORE, AUR_PILOT_BRIGHT,
                          &rivals->bright_pilot, error);
    if (result == AUR_OK && !aur_trial_is_black(&rivals->bright_pilot))
        rivals->pattern = aur_gather_pattern_best(few, more, outcome_of(&rivals->bright_pilot));
    return result;
}

/* A map of a small enough bias, if there is one. Where that of the photons which a picture of so many rays
 * pays for is near it, one is tried that path tracing's rays would pay for. */
static aur_result choose_map(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                             double wanted, double rays, double worth, aur_rivals *rivals, aur_error *error) {
    const aur_render_options points = coarse_options(&choice->trial, options, COARSE_POINTS);
    const double most = BIAS_PART * BIAS_PART * wanted * wanted;
    const size_t most_photons = aur_gather_photons(worth - rays);
    double spent = 0.0; /* on smaller maps */
    size_t *const photons = &choice->gather.photons;
    for (*photons = aur_gather_photons(rays);;) {
        aur_trial *const difference = &rivals->difference;
        const bool may_be_larger = *photons < most_photons;
        char *const text = aur_ask_gather_difference(choice->trial.integrator, *photons, choice->gather.seed);
        aur_result result = create_trial(renderer, &points, choice, text, difference, error);
        if (result == AUR_OK)
            result = find_bias(choice, rivals, wanted, worth - rays - spent, may_be_larger, error);
        if (result != AUR_OK || choice->bias.high <= most || !may_be_larger ||
            choice->bias.estimate > MOST_MENDED * most)
            return result;
        spent += aur_trial_rays(difference);
        aur_trial_add_spent(difference, &choice->others);
        aur_trial_release(difference);
        *photons = *photons * MAP_GROWTH < most_photons ? *photons * MAP_GROWTH : most_photons;
    }
}

/* The pilots are rendered; at `worth` rays final gathering is worth it. */
static aur_result compare(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                          double wanted, double worth, aur_rivals *rivals, bool *better, aur_error *error) {
    const char *const path = choice->trial.integrator;
    const double rays = gather_rays(choice, rivals, wanted, pow(BIAS_PART * wanted, 2.0));
    if (rays > worth)
        return AUR_OK;
    choice->rays = rays;
    aur_result result = choose_map(renderer, options, choice, wanted, rays, worth, rivals, error);
    if (result != AUR_OK || !(sqrt(choice->bias.high) <= BIAS_PART * wanted))
        return result;
    choice->gather = aur_gather_size_of(&rivals->pattern, aur_gather_noise_planned(wanted, choice->bias.high),
                                        choice->gather.photons, choice->gather.seed);
    aur_trial *const gather = &rivals->gather;
    bool goes_on;
    result = create_trial(renderer, options, choice, aur_ask_gather(path, choice->gather), gather, error);
    if (result == AUR_OK)
        result = render_round(choice, &choice->goal, gather, &goes_on, error);
    if (result != AUR_OK || aur_trial_is_black(gather))
        return result;
    const aur_bias sharing =
        aur_replicas_sharing_bias(&gather->replicas, gather->measure.mean, choice->confidence);
    choice->bias = aur_bias_of_both(choice->bias, sharing);
    const double noise = noise_beside(wanted, choice->bias.high);
    if (!(noise > 0.0) || (aur_gather_is_shared(choice->gather.directions) &&
                           aur_trial_growth(gather, noise) > MOST_GROWTH_SHARED))
        return AUR_OK;
    *better = rays_to(gather, noise) - aur_trial_rays(gather) <= worth;
    return result;
}

static double rays_of(const aur_trial *trial) {
    const bool made = trial->replicas.pixel_count > 0;
    return made ? aur_trial_rays(trial) : 0.0;
}

double aur_choice_part_done(const aur_choice *choice) {
    const aur_rivals *const rivals = choice->rivals;
    if (rivals == NULL || !(choice->rays > 0.0))
        return 0.0;
    const double gathered = rays_of(&rivals->gather);
    const double others = (double)choice->others.rays + rays_of(&choice->trial) + rays_of(&rivals->path) +
                          rays_of(&rivals->pilot) + rays_of(&rivals->lit_pilot) +
                          rays_of(&rivals->bright_pilot) + rays_of(&rivals->difference);
    return (others + gathered) / (others + fmax(choice->rays, gathered));
}

/* Final gathering beside path tracing, whose trial says what that takes. */
static aur_result compare_with(aur_renderer *renderer, const aur_render_options *options,
                               const aur_render_options *coarse, aur_choice *choice, const aur_trial *path,
                               double wanted, aur_rivals *rivals, bool *better, aur_error *error) {
    const double rays = rivals->candidates.cost * rivals->pixels * rays_to(path, wanted);
    if (aur_photon_rays(AUR_PILOT_PHOTONS) > PILOT_PART * rays)
        return AUR_OK;
    choice->rays = WORTH * rays;
    aur_error refused;
    const aur_result result = render_pilots(renderer, coarse, choice, wanted, rivals, &refused);
    if (result == AUR_OK && aur_trial_is_black(&rivals->pilot))
        return AUR_OK;
    if (result == AUR_OK)
        return compare(renderer, options, choice, wanted, WORTH * (rays - rays_of(&choice->trial)), rivals,
                       better, error);
    if (result != AUR_ERROR_MEMORY && result != AUR_ERROR_CANCELLED)
        return AUR_OK; /* final gathering says that the scene is not for it */
    if (error != NULL)
        *error = refused;
    return result;
}

/* Where there is a choice of points on lights, and where it costs little beside the picture. */
static aur_result choose_candidates(aur_renderer *renderer, const aur_render_options *coarse,
                                    aur_choice *choice, const aur_trial *path, double wanted,
                                    aur_rivals *rivals, aur_error *error) {
    const aur_scene *const scene = aur_renderer_scene(renderer);
    if (!aur_light_chooses(scene) && !aur_scene_has_environment(scene))
        return AUR_OK;
    const double sample = (double)choice->replica_count * aur_trial_rays(path) / path->samples;
    if (AUR_CANDIDATE_CHOICES * AUR_CANDIDATE_SAMPLES * sample >
        CANDIDATES_PART * rivals->pixels * rays_to(path, wanted))
        return AUR_OK;
    return aur_ask_candidates(renderer, coarse, choice, &rivals->candidates, &choice->others, error);
}

/* Path tracing with its candidates in place of that of the choice, which has not begun. Who looks at that
 * meanwhile finds it whole. */
static aur_result take_candidates(aur_renderer *renderer, const aur_render_options *options,
                                  aur_choice *choice, size_t candidates, aur_error *error) {
    aur_trial left = {0};
    const aur_result result = create_trial(renderer, options, choice,
                                           aur_ask_path(choice->trial.integrator, candidates), &left, error);
    if (result == AUR_OK) {
        const aur_trial taken = left;
        left = choice->trial;
        choice->trial = taken;
        choice->candidates = candidates;
    }
    aur_trial_release(&left);
    return result;
}

aur_result aur_ask_try(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                       aur_error *error) {
    const aur_render_options coarse = coarse_options(&choice->trial, options, COARSE_PIXELS);
    aur_rivals rivals = {.pixels = 1.0, .candidates = {1, 1.0}};
    aur_trial *const whole = &choice->trial;
    aur_trial *path = whole;
    bool better = false;
    double wanted = 0.0;
    aur_result result = AUR_OK;
    choice->rivals = &rivals;
    if (coarse.width < aur_render_film(whole->replicas.renders[0])->layout.width) {
        path = &rivals.path;
        result = create_trial(renderer, &coarse, choice, strdup(whole->integrator), path, error);
        rivals.pixels = (double)whole->replicas.pixel_count / (double)path->replicas.pixel_count;
    }
    if (result == AUR_OK)
        result = render_path(choice, path, rivals.pixels, &wanted, error);
    choice->gather = (aur_gather_size){.seed = aur_ask_photon_seed(options->seed)};
    const bool goes_on = result == AUR_OK && path->bound > wanted && !aur_trial_is_black(path);
    if (goes_on && path != whole)
        result = choose_candidates(renderer, &coarse, choice, path, wanted, &rivals, error);
    if (goes_on && result == AUR_OK)
        result = compare_with(renderer, options, &coarse, choice, path, wanted, &rivals, &better, error);
    if (result == AUR_ERROR_MEMORY && choice->gather.photons > 0)
        result = aur_fail(error, result,
                          "out of memory: final gathering was tried with %zu photons; who names the "
                          "integrator '%s' needs none",
                          choice->gather.photons, whole->integrator);
    choice->rivals = NULL;
    if (better) {
        const aur_trial left = *whole;
        *whole = rivals.gather;
        rivals.gather = left;
    } else {
        choice->gather = (aur_gather_size){0};
        choice->bias = (aur_bias){0};
        if (result == AUR_OK && rivals.candidates.count > 1)
            result = take_candidates(renderer, options, choice, rivals.candidates.count, error);
    }
    aur_trial *const left[] = {&rivals.path,         &rivals.pilot,      &rivals.lit_pilot,
                               &rivals.bright_pilot, &rivals.difference, &rivals.gather};
    for (size_t i = 0; i < sizeof left / sizeof left[0]; ++i) {
        aur_trial_add_spent(left[i], &choice->others);
        aur_trial_release(left[i]);
    }
    return result;
}

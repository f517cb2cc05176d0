#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ask/choose.h"
#include "ask/rounds.h"
#include "core/error.h"
#include "film/film.h"
#include "render/renderer.h"

/* Of the error asked, the bias that may be left; the noise makes the rest of the square. */
static const double BIAS_PART = 0.6;
/* Final gathering is worth it at this part of path tracing's rays: what its rays cost differs by scene (in
 * two boxes as much as those of paths), and a guess from few pixels may be wrong. Parts of path tracing's
 * rays that may be spent on photon maps and on finding their bias: so one who goes on with path tracing has
 * lost little. All three are chosen: they cost time, never truth. */
static const double WORTH = 0.7, MAP_PART = 0.025, BIAS_SEARCH_PART = 0.2;
/* Tracing and sorting a photon takes the time of so many rays of path tracing: 2.4 in the Cornell box by
 * `render --stats`. Other scenes were not measured: a wrong ratio costs time, never truth. */
static const double RAYS_A_PHOTON = 2.5;
enum { MOST_PHOTONS = 2000000, LEAST_PHOTONS = 15000 };
/* Samples of a pixel that share a pattern's directions out. The bias is looked for with few of these, for
 * each goes on as a path. */
enum { PATTERN_SAMPLES = 4, PILOT_DIRECTIONS = 16, MOST_DIRECTIONS = 1024, DIFFERENCE_DIRECTIONS = 8 };
/* The pilot's noise hardly hangs on its map. */
enum { PILOT_PHOTONS = LEAST_PHOTONS };

/* The rays that a trial is thought to take in all until its noise is `error`. */
static double rays_to(const aur_trial *trial, double error) {
    const double part = error / trial->interval.high;
    return aur_trial_rays(trial) *
           aur_growth_to(trial->value_count, trial->variances, fmin(part * part, 1.0), trial->targets);
}

/* As many samples in every pixel. Samples that go where the first ones differ make a picture whose mean is
 * not quite that of its integrator, which would pass for a difference between integrators. */
static aur_result render_evenly(const aur_choice *choice, aur_trial *trial, uint32_t samples,
                                aur_error *error) {
    aur_trial_plan_evenly(trial, samples);
    return aur_trial_render(trial, choice->confidence, choice->cancelled, error);
}

/* The next round, as whoever goes on with the trial would plan it. False where no pixel can have more. */
static aur_result render_round(const aur_choice *choice, aur_trial *trial, bool *more, aur_error *error) {
    aur_trial_look_ahead(trial, &choice->goal);
    *more = aur_trial_plan(trial, trial->rounds > 0 ? aur_trial_factor(trial, &choice->goal) : 1.0);
    return *more ? aur_trial_render(trial, choice->confidence, choice->cancelled, error) : AUR_OK;
}

/* The part of the rays or of the time that is spent. */
static double part_spent(const aur_choice *choice, const aur_trial *trial) {
    aur_render_statistics spent;
    aur_trial_spent(trial, &spent);
    const double rays = choice->goal.rays > 0 ? (double)spent.rays / (double)choice->goal.rays : 0.0;
    const double seconds =
        choice->seconds > 0.0 ? (spent.prepare_seconds + spent.render_seconds) / choice->seconds : 0.0;
    return fmax(rays, seconds);
}

/* Path tracing until it has come so far that its error at the end can be told, which is that asked, or the
 * one when rays or time will be spent. */
static aur_result render_path(aur_choice *choice, double *wanted, aur_error *error) {
    aur_trial *const path = &choice->trial;
    aur_result result = AUR_OK;
    double left = 0.0;
    for (bool more = true; result == AUR_OK && more;) {
        const double spent = part_spent(choice, path);
        left = fmax(choice->goal.error, path->bound * sqrt(spent));
        if (path->rounds > 1 && path->bound <= AUR_PILOT_ERROR * left)
            break;
        result = render_round(choice, path, &more, error);
        more = more && !aur_trial_is_black(path);
    }
    *wanted = left;
    return result;
}

/* Photons of a map of each replica that cost little beside path tracing to the error wanted; 0: it is not
 * worth it. */
static size_t photons_for(const aur_choice *choice, double path_rays) {
    const double affordable = MAP_PART * path_rays / (RAYS_A_PHOTON * (double)choice->replica_count);
    size_t photons = MOST_PHOTONS;
    while ((double)photons > affordable && photons >= LEAST_PHOTONS)
        photons /= 2;
    return photons >= LEAST_PHOTONS ? photons : 0;
}

/* Final gathering in place of path tracing, with its keys and more (",key=value"). NULL: memory is short. */
static char *gather_instead(const char *path, aur_gather_size size, const char *more) {
    enum { CAPACITY = 256 }; /* five numbers and the keys' names */
    const char *const keys = strchr(path, ':');
    const size_t lights = size.directions > 16 ? size.directions / 16 : 1;
    const size_t capacity = CAPACITY + strlen(more) + (keys != NULL ? strlen(keys) : 0);
    char *const text = malloc(capacity);
    if (text != NULL)
        snprintf(text, capacity,
                 "finalgather:split=%d,diffuse_samples=%zu,glossy_samples=%zu,light_samples=%zu,"
                 "short_rays=4,photons=%zu%s%s%s",
                 PATTERN_SAMPLES, size.directions, size.directions, lights, size.photons, more,
                 keys != NULL ? "," : "", keys != NULL ? keys + 1 : "");
    return text;
}

char *aur_ask_gather(const char *path, aur_gather_size size) {
    char edges[40]; /* a number and the key's name */
    snprintf(edges, sizeof edges, ",edges=%zu", 4 * size.directions);
    return gather_instead(path, size, edges);
}

/* What is compared with path tracing, what it would be in few pixels, and what its photon map is wrong by. */
typedef struct aur_rivals {
    aur_trial gather, pilot, difference;
} aur_rivals;

/* Samples a pixel at which the bound of a bias can come to `most` at the soonest, when it is known from
 * `samples`: what is uncertain of its square falls as they grow, and a first estimate is large by chance. */
static double samples_to_know(const aur_bias *bias, double most, double samples) {
    return samples * (bias->high - fmax(bias->estimate, 0.0)) / (most * most);
}

/* The bias of final gathering, from pictures of what paths find over what the map says at the ends of the
 * same gather rays. What they have in common, above all direct light and short rays, is not traced. They go
 * on until the bias is under what may be left, or it is seen that it will not be before so many rays are
 * spent. */
static aur_result find_bias(const aur_choice *choice, aur_rivals *rivals, double mean, double most,
                            double most_rays, aur_bias *bias, aur_error *error) {
    for (uint32_t samples = 1;;) {
        const aur_result result = render_evenly(choice, &rivals->difference, samples, error);
        if (result != AUR_OK)
            return result;
        *bias = aur_replicas_bias(&rivals->difference.replicas, NULL, mean, choice->confidence);
        const double rays = aur_trial_rays(&rivals->difference);
        const double needed = samples_to_know(bias, most, samples), growth = fmax(needed / samples, 1.0);
        if (sqrt(bias->high) <= most || sqrt(bias->low) > most || growth * rays > most_rays)
            return AUR_OK;
        /* A little beyond what is the least that can do, and by steps that are worth a look. */
        samples = (uint32_t)ceil(fmin(fmax(1.2 * needed, 1.25 * samples), 4.0 * samples));
    }
}

/* What is asked of few pixels, each in place of COARSE x COARSE, or of fewer where that would leave a small
 * picture. The bias of single points is that of pixels at least, and known from as many rays the better the
 * fewer points they are of: what is uncertain of its square is as the root of their number. */
static aur_render_options coarse_options(const aur_trial *trial, const aur_render_options *options) {
    enum { COARSE = 4, LEAST_SIDE = 32 };
    const aur_film_layout *const film = &aur_render_film(trial->replicas.renders[0])->layout;
    const size_t width = film->x1 - film->x0, height = film->y1 - film->y0;
    size_t part = COARSE;
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

/* Directions of a pattern by which the replicas are thought to come to the error wanted without another one,
 * if so many times the rays of the pilot's patterns would do: the square of a pattern's error falls nearly as
 * directions^-1.6 in the Cornell box (16 to 64), and that of several ones as the rays. Where that is wrong,
 * rounds go on with more patterns, or the first one has more directions than it needs: it costs time, never
 * truth. */
static size_t directions_for(double growth) {
    const double directions = PILOT_DIRECTIONS * pow(growth, 1.0 / 1.6);
    return (size_t)fmin(PATTERN_SAMPLES * ceil(directions / PATTERN_SAMPLES), MOST_DIRECTIONS);
}

/* Whether final gathering is thought to be worth it, from a pilot of few pixels, and how many directions it
 * takes. */
static aur_result try_pilot(aur_choice *choice, aur_trial *pilot, double path_rays, double noise, bool *worth,
                            aur_error *error) {
    bool more;
    const aur_result result = render_round(choice, pilot, &more, error);
    if (result != AUR_OK || aur_trial_is_black(pilot))
        return result;
    const double pixels = (double)choice->trial.replicas.pixel_count / (double)pilot->replicas.pixel_count;
    const double rays = rays_to(pilot, noise);
    choice->gather.directions = directions_for(rays / aur_trial_rays(pilot));
    *worth = pixels * rays <= WORTH * path_rays;
    return AUR_OK;
}

/* `coarse` are the options of the pilot, which is made and not rendered yet. */
static aur_result compare(aur_renderer *renderer, const aur_render_options *options,
                          const aur_render_options *coarse, aur_choice *choice, double wanted,
                          aur_rivals *rivals, bool *better, aur_error *error) {
    const aur_trial *const path = &choice->trial;
    const double most_bias = BIAS_PART * wanted, path_rays = rays_to(path, wanted);
    bool more, worth = false;
    aur_result result = try_pilot(choice, &rivals->pilot, path_rays,
                                  sqrt(wanted * wanted - most_bias * most_bias), &worth, error);
    if (result != AUR_OK || !worth)
        return result;
    const aur_gather_size few = {choice->gather.photons, DIFFERENCE_DIRECTIONS};
    result = create_trial(
        renderer, coarse, choice,
        gather_instead(path->integrator, few, ",pixel=centre,debias=true,continued=1,incident=correction"),
        &rivals->difference, error);
    if (result == AUR_OK)
        result = find_bias(choice, rivals, path->measure.mean, most_bias, BIAS_SEARCH_PART * path_rays,
                           &choice->bias, error);
    if (result != AUR_OK || !(sqrt(choice->bias.high) <= most_bias))
        return result;
    aur_trial *const gather = &rivals->gather;
    result = create_trial(renderer, options, choice, aur_ask_gather(path->integrator, choice->gather), gather,
                          error);
    if (result == AUR_OK)
        result = render_round(choice, gather, &more, error);
    const double noise = sqrt(wanted * wanted - choice->bias.high);
    *better = result == AUR_OK && !aur_trial_is_black(gather) &&
              rays_to(gather, noise) - aur_trial_rays(gather) <= WORTH * (path_rays - aur_trial_rays(path));
    return result;
}

static double rays_of(const aur_trial *trial) {
    const bool made = trial->replicas.pixel_count > 0;
    return made ? aur_trial_rays(trial) : 0.0;
}

double aur_choice_rival_rays(const aur_choice *choice) {
    const aur_rivals *const rivals = choice->rivals;
    return rivals == NULL ? 0.0
                          : rays_of(&rivals->gather) + rays_of(&rivals->pilot) + rays_of(&rivals->difference);
}

double aur_choice_part_left(const aur_choice *choice) {
    return choice->rivals != NULL ? WORTH : 1.0;
}

static void add_spent(const aur_trial *trial, aur_render_statistics *sum) {
    aur_render_statistics one;
    if (trial->replicas.count == 0)
        return;
    aur_trial_spent(trial, &one);
    sum->rays += one.rays;
    sum->prepare_seconds += one.prepare_seconds;
    sum->render_seconds += one.render_seconds;
    sum->cpu_seconds += one.cpu_seconds;
}

aur_result aur_ask_try(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                       aur_error *error) {
    aur_trial *const path = &choice->trial;
    double wanted;
    aur_result result = render_path(choice, &wanted, error);
    if (result != AUR_OK || path->bound <= wanted || aur_trial_is_black(path))
        return result;
    choice->gather = (aur_gather_size){.photons = photons_for(choice, rays_to(path, wanted))};
    if (choice->gather.photons == 0)
        return AUR_OK;
    aur_trial_look_ahead(path, &choice->goal);
    aur_rivals rivals = {0};
    choice->rivals = &rivals;
    aur_error refused;
    bool better = false;
    const aur_render_options coarse = coarse_options(path, options);
    result =
        create_trial(renderer, &coarse, choice,
                     aur_ask_gather(path->integrator, (aur_gather_size){PILOT_PHOTONS, PILOT_DIRECTIONS}),
                     &rivals.pilot, &refused);
    if (result == AUR_OK)
        result = compare(renderer, options, &coarse, choice, wanted, &rivals, &better, error);
    else if (result != AUR_ERROR_MEMORY && result != AUR_ERROR_CANCELLED)
        result = AUR_OK; /* final gathering says that the scene is not for it */
    else if (error != NULL)
        *error = refused;
    choice->rivals = NULL;
    if (better) {
        const aur_trial left = *path;
        *path = rivals.gather;
        rivals.gather = left;
    } else {
        choice->gather = (aur_gather_size){0};
        choice->bias = (aur_bias){0};
    }
    add_spent(&rivals.gather, &choice->others);
    add_spent(&rivals.pilot, &choice->others);
    add_spent(&rivals.difference, &choice->others);
    aur_trial_release(&rivals.gather);
    aur_trial_release(&rivals.pilot);
    aur_trial_release(&rivals.difference);
    return result;
}

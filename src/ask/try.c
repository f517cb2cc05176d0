#include <inttypes.h>
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
/* Final gathering is worth it at this part of path tracing's rays, all that it takes to know together: what
 * its rays cost differs by scene (in two boxes as much and half as much again as those of paths, in the room
 * nearly three times as much), and a guess from few pixels may be wrong. The part of final
 * gathering's rays that is spent on its photon map. Both are chosen: they cost time, never truth. */
static const double WORTH = 0.6, MAP_PART = 0.05;
/* Of path tracing's rays, what the pilot's map may cost: final gathering is not looked at in small pictures.
 */
static const double PILOT_PART = 0.01;
/* Tracing and sorting a photon takes the time of so many rays of path tracing: 2.4 in the Cornell box by
 * `render --stats`. Other scenes were not measured: a wrong ratio costs time, never truth. */
static const double RAYS_A_PHOTON = 2.5;
enum { MOST_PHOTONS = 2000000, LEAST_PHOTONS = 15000 };
/* Samples of a pixel that share a pattern's directions out. The bias is looked for with few of these, for
 * each goes on as a path. */
enum {
    PATTERN_SAMPLES = 4,
    LEAST_DIRECTIONS = 8,
    PILOT_DIRECTIONS = 16,
    MOST_DIRECTIONS = 1024,
    DIFFERENCE_DIRECTIONS = 8
};
/* The pilot's noise hardly hangs on its map. */
enum { PILOT_PHOTONS = LEAST_PHOTONS };

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

/* Photons of a map that costs little beside the picture. All replicas share it: one map has finer texels than
 * four of a quarter, and what is wrong in it is bias, which is looked for. */
static size_t photons_for(double rays) {
    const double affordable = MAP_PART * rays / RAYS_A_PHOTON;
    size_t photons = MOST_PHOTONS;
    while ((double)photons > affordable && photons / 2 >= LEAST_PHOTONS)
        photons /= 2;
    return photons;
}

/* Final gathering in place of path tracing, with its keys and more (",key=value"). NULL: memory is short. */
static char *gather_instead(const char *path, aur_gather_size size, const char *more) {
    enum { CAPACITY = 256 }; /* six numbers and the keys' names */
    const char *const keys = strchr(path, ':');
    const size_t lights = size.directions > 16 ? size.directions / 16 : 1;
    const size_t capacity = CAPACITY + strlen(more) + (keys != NULL ? strlen(keys) : 0);
    char *const text = malloc(capacity);
    if (text != NULL)
        snprintf(text, capacity,
                 "finalgather:split=%d,diffuse_samples=%zu,glossy_samples=%zu,light_samples=%zu,"
                 "short_rays=4,photons=%zu,photon_seed=%" PRIu64 "%s%s%s",
                 PATTERN_SAMPLES, size.directions, size.directions, lights, size.photons, size.seed, more,
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

/* Directions of a pattern by which the replicas are thought to come to the noise without another one, from
 * the lower end of the pilot's error, whose coarse pixels see more edges. The square of a pattern's error
 * falls nearly as directions^-1.4 in the public Cornell box (12 to 80). Where that is wrong, rounds go on
 * with more patterns, or the first one has more directions than it needs: it costs time, never truth. */
static double directions_to(const aur_trial *pilot, double noise) {
    const double part = pilot->interval.low / noise;
    return fmin(fmax(PILOT_DIRECTIONS * pow(part * part, 1.0 / 1.4), LEAST_DIRECTIONS), MOST_DIRECTIONS);
}

static double noise_beside(double wanted, double square_bias) {
    return sqrt(fmax(wanted * wanted - square_bias, 0.0));
}

/* Rays of a whole picture to an error by final gathering of such a bias. The pilot's coarse pixels see more
 * edges. By this law, found in two boxes and the room, 24 to 80 directions take what they do to a fifth. */
static double gather_rays(const aur_choice *choice, const aur_trial *pilot, double wanted,
                          double square_bias) {
    const double pixels = (double)choice->trial.replicas.pixel_count / (double)pilot->replicas.pixel_count;
    const double directions = directions_to(pilot, noise_beside(wanted, square_bias));
    return pixels * aur_trial_rays(pilot) * (0.1 + 0.65 * directions / PILOT_DIRECTIONS);
}

/* What is uncertain of a squared bias: it falls as samples grow. */
static double uncertain(const aur_bias *bias) {
    return bias->high - fmax(bias->estimate, 0.0);
}

/* Whether twice the rays for the bias cost less than the noise takes that its bound leaves no room for. */
static bool pays(const aur_choice *choice, const aur_rivals *rivals, double wanted) {
    const aur_bias *const bias = &choice->bias;
    return gather_rays(choice, &rivals->pilot, wanted, bias->high) -
               gather_rays(choice, &rivals->pilot, wanted, bias->high - 0.5 * uncertain(bias)) >
           aur_trial_rays(&rivals->difference);
}

/* The bias of final gathering, from pictures of what paths find over what the map says at the ends of the
 * same gather rays. What they have in common, above all direct light and short rays, is not traced. They go
 * on until the bias is under what may be left and knowing it better does not pay, or it is seen that it will
 * hardly come there (by half of what is uncertain), or not before so many rays are spent. */
static aur_result find_bias(aur_choice *choice, aur_rivals *rivals, double wanted, double most_rays,
                            aur_error *error) {
    const double most = BIAS_PART * BIAS_PART * wanted * wanted;
    aur_bias *const bias = &choice->bias;
    for (uint32_t samples = 1;;) {
        const aur_result result = render_evenly(choice, &rivals->difference, samples, error);
        if (result != AUR_OK)
            return result;
        *bias = aur_replicas_bias(&rivals->difference.replicas, NULL, choice->trial.measure.mean,
                                  choice->confidence);
        /* The least growth that can do, as a first estimate is large by chance. */
        const double rays = aur_trial_rays(&rivals->difference), growth = uncertain(bias) / most;
        if (bias->high <= most ? !pays(choice, rivals, wanted)
                               : bias->estimate - 0.5 * uncertain(bias) > most || growth * rays > most_rays)
            return AUR_OK;
        /* A little beyond that, and by steps that are worth a look. */
        samples = (uint32_t)ceil(samples * (bias->high <= most ? 2.0 : fmin(fmax(1.2 * growth, 1.25), 4.0)));
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

/* `coarse` are the options of the pilot, which is made and not rendered yet. */
static aur_result compare(aur_renderer *renderer, const aur_render_options *options,
                          const aur_render_options *coarse, aur_choice *choice, double wanted,
                          aur_rivals *rivals, bool *better, aur_error *error) {
    const aur_trial *const path = &choice->trial;
    const double worth = WORTH * (rays_to(path, wanted) - aur_trial_rays(path));
    bool more;
    aur_result result = render_round(choice, &rivals->pilot, &more, error);
    if (result != AUR_OK || aur_trial_is_black(&rivals->pilot))
        return result;
    const double rays = gather_rays(choice, &rivals->pilot, wanted, pow(BIAS_PART * wanted, 2.0));
    if (rays > worth)
        return AUR_OK;
    choice->gather.photons = photons_for(rays);
    aur_gather_size few = choice->gather;
    few.directions = DIFFERENCE_DIRECTIONS;
    result = create_trial(
        renderer, coarse, choice,
        gather_instead(path->integrator, few, ",pixel=centre,debias=true,continued=1,incident=correction"),
        &rivals->difference, error);
    if (result == AUR_OK)
        result = find_bias(choice, rivals, wanted, worth - rays, error);
    if (result != AUR_OK || !(sqrt(choice->bias.high) <= BIAS_PART * wanted))
        return result;
    const double noise = noise_beside(wanted, choice->bias.high);
    choice->gather.directions =
        PATTERN_SAMPLES * (size_t)ceil(directions_to(&rivals->pilot, noise) / PATTERN_SAMPLES);
    aur_trial *const gather = &rivals->gather;
    result = create_trial(renderer, options, choice, aur_ask_gather(path->integrator, choice->gather), gather,
                          error);
    if (result == AUR_OK)
        result = render_round(choice, gather, &more, error);
    *better = result == AUR_OK && !aur_trial_is_black(gather) &&
              rays_to(gather, noise) - aur_trial_rays(gather) <= worth;
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
    choice->gather = (aur_gather_size){.seed = aur_ask_photon_seed(options->seed)};
    if (LEAST_PHOTONS * RAYS_A_PHOTON > PILOT_PART * rays_to(path, wanted))
        return AUR_OK;
    aur_trial_look_ahead(path, &choice->goal);
    aur_rivals rivals = {0};
    choice->rivals = &rivals;
    aur_error refused;
    bool better = false;
    const aur_render_options coarse = coarse_options(path, options);
    const aur_gather_size pilot = {PILOT_PHOTONS, choice->gather.seed, PILOT_DIRECTIONS};
    result = create_trial(renderer, &coarse, choice, aur_ask_gather(path->integrator, pilot), &rivals.pilot,
                          &refused);
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

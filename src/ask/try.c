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
 * nearly three times as much, where it was twice as slow as path tracing with .6), and a guess from few
 * pixels may be wrong. The part of final gathering's rays that is spent on its photon map. Both are chosen:
 * they cost time, never truth. */
static const double WORTH = 0.45, MAP_PART = 0.15;
/* Of path tracing's rays, what the pilot's map may cost: final gathering is not looked at in small pictures.
 */
static const double PILOT_PART = 0.01;
/* Tracing and sorting a photon takes the time of so many rays of path tracing: 2.4 in the Cornell box by
 * `render --stats`. Other scenes were not measured: a wrong ratio costs time, never truth. */
static const double RAYS_A_PHOTON = 2.5;
/* What sharing adds is thought to be known, from the first pattern, to be under this part of its noise: .16
 * to .26 in the public Cornell box. A first pattern that does not do costs another one: noise is planned to
 * be a little less. */
static const double SHARING = 0.2, PLAN_MARGIN = 0.92;
/* More than so many times the rays of a first pattern are not spent on shared ones. What is shared comes to
 * whole tiles, so that a few pixels that have the error, as of a lamp's edge, would cost all about them. */
static const double MOST_GROWTH_SHARED = 2.0;
/* A ray that goes on as a path takes so much more time than one of final gathering. */
static const double DIFFERENCE_PRICE = 1.7;
enum { MOST_PHOTONS = 2000000, LEAST_PHOTONS = 15000 };
/* A pattern of few directions is a single sample's, so that each replica can be a coarse picture, and shared
 * with the neighbouring pixels. One of many is shared out among so many samples of a pixel, and not shared
 * with others: what is wrong in the map is alike in neighbours, and sharing would leave little but that. On
 * the public Cornell box to 1.7 % means over 8 x 8 pixels had 1.6 to 1.9 times what independent errors leave,
 * and it took as long. The bias is looked for with few directions, for each goes on as a path. */
enum {
    PATTERN_SAMPLES = 4,
    SINGLE_DIRECTIONS = 16,
    LEAST_DIRECTIONS = 2,
    PILOT_DIRECTIONS = 4,
    MOST_DIRECTIONS = 1024,
    DIFFERENCE_DIRECTIONS = 8
};
/* The pilot's noise hardly hangs on its map, whose texels are so wide that most of its rays would be short.
 */
enum { PILOT_PHOTONS = LEAST_PHOTONS };
/* Of the picture and of what is looked for in its bias alike. With 4 in place of 2 the public Cornell box
 * took a fourth more time to 4 %, for a bias that is no smaller than that of half as many photons. */
enum { SHORT_RAYS = 2 };

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
    aur_trial path, pilot, difference, gather;
    double pixels; /* of the picture, over those of the few */
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
static char *gather_instead(const char *path, size_t samples, aur_gather_size size, const char *more) {
    enum { CAPACITY = 256 }; /* six numbers and the keys' names */
    const char *const keys = strchr(path, ':');
    const size_t lights = size.directions / (4 * samples);
    const size_t capacity = CAPACITY + strlen(more) + (keys != NULL ? strlen(keys) : 0);
    char *const text = malloc(capacity);
    if (text != NULL)
        snprintf(text, capacity,
                 "finalgather:split=%zu,diffuse_samples=%zu,glossy_samples=%zu,light_samples=%zu,"
                 "photons=%zu,photon_seed=%" PRIu64 "%s%s%s",
                 samples, size.directions, size.directions, lights + (lights == 0), size.photons, size.seed,
                 more, keys != NULL ? "," : "", keys != NULL ? keys + 1 : "");
    return text;
}

static bool is_single(size_t directions) {
    return directions <= SINGLE_DIRECTIONS;
}

/* Found by trial in the public Cornell box: with half of them edges have most of the error, with twice as
 * many the rays. Where nothing is shared half of them do. */
static size_t edges_of(size_t directions) {
    return (is_single(directions) ? 8 : 4) * directions;
}

char *aur_ask_gather(const char *path, aur_gather_size size) {
    const bool single = is_single(size.directions);
    char more[64]; /* two numbers and the keys */
    snprintf(more, sizeof more, ",edges=%zu,short_rays=%d%s", edges_of(size.directions), SHORT_RAYS,
             single ? ",share=near" : "");
    return gather_instead(path, single ? 1 : PATTERN_SAMPLES, size, more);
}

/* The directions of a pattern in place of those that would do where neighbours share theirs. A pattern that
 * is not shared takes more: in the public Cornell box to 1.7 % 80 in place of 45. */
static size_t pattern_size(double directions) {
    const double more = 1.8;
    if (directions <= SINGLE_DIRECTIONS)
        return (size_t)ceil(directions);
    return PATTERN_SAMPLES * (size_t)ceil(more * directions / PATTERN_SAMPLES);
}

/* Directions of a pattern by which the replicas are thought to come to the noise without another one. The
 * square of a pattern's error falls nearly as directions^-1.5 from the pilot's in the public Cornell box (5
 * to 48, shared): coarse pixels see more edges, so that the pilot's own is large for it. Where that is wrong,
 * rounds go on with more patterns, or the first one has more directions than it needs: it costs time, never
 * truth. */
static double directions_to(const aur_trial *pilot, double noise) {
    const double part = pilot->interval.estimate / noise;
    return fmin(fmax(PILOT_DIRECTIONS * pow(part * part, 1.0 / 1.5), LEAST_DIRECTIONS), MOST_DIRECTIONS);
}

static double noise_beside(double wanted, double square_bias) {
    return sqrt(fmax(wanted * wanted - square_bias, 0.0));
}

/* The noise n to plan for, with n^2 + (b + SHARING n)^2 the square of what is wanted, and b the map's bias.
 */
static double noise_planned(double wanted, double square_bias) {
    const double b = SHARING * sqrt(square_bias), square = 1.0 + SHARING * SHARING;
    const double rest = fmax(wanted * wanted - square_bias, 0.0);
    return PLAN_MARGIN * (sqrt(b * b + square * rest) - b) / square;
}

/* Rays of a whole picture to an error by final gathering of such a bias. The pilot's coarse pixels see more
 * edges. By this law 5 to 45 directions that are shared take what they do to a twentieth in the public
 * Cornell box. */
static double gather_rays(const aur_choice *choice, const aur_trial *pilot, double wanted,
                          double square_bias) {
    const double pixels = (double)choice->trial.replicas.pixel_count / (double)pilot->replicas.pixel_count;
    const double directions = directions_to(pilot, noise_planned(wanted, square_bias));
    return pixels * aur_trial_rays(pilot) * (0.15 + 0.66 * directions / PILOT_DIRECTIONS);
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
           DIFFERENCE_PRICE * aur_trial_rays(&rivals->difference);
}

/* How many times as many rays show that a squared bias is no more than `most`, if its estimate is too large
 * by chance: a little beyond that, and a step that is worth a look. Infinite where the estimate is too much
 * by more than chance. Who goes on loses little before a part of all rays is spent, and who gives up takes
 * paths: until then the estimate may be wrong by more. */
static double growth_needed(const aur_bias *bias, double most, double part_spent) {
    const double least_part = 1.0 / 32, chance = part_spent < least_part ? 1.0 : 0.5;
    const double room = most - fmax(bias->estimate - chance * uncertain(bias), 0.0);
    return room > 0.0 ? fmax(1.2 * uncertain(bias) / room, 1.25) : INFINITY;
}

/* The bias of final gathering, from pictures of what paths find over what the map says at the ends of the
 * same gather rays. What they have in common, above all direct light and short rays, is not traced. They go
 * on until the bias is under what may be left and knowing it better does not pay, or it is seen that it will
 * hardly come there, or not before so many rays are spent. */
static aur_result find_bias(aur_choice *choice, aur_rivals *rivals, double wanted, double most_rays,
                            aur_error *error) {
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

/* The pilot is made and not rendered yet; at `worth` rays final gathering is worth it. */
static aur_result compare(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                          double wanted, double worth, aur_rivals *rivals, bool *better, aur_error *error) {
    const char *const path = choice->trial.integrator;
    bool goes_on;
    aur_result result = render_round(choice, &choice->goal, &rivals->pilot, &goes_on, error);
    if (result != AUR_OK || aur_trial_is_black(&rivals->pilot))
        return result;
    const double rays = gather_rays(choice, &rivals->pilot, wanted, pow(BIAS_PART * wanted, 2.0));
    if (rays > worth)
        return AUR_OK;
    choice->rays = rays;
    choice->gather.photons = photons_for(rays);
    aur_gather_size few = choice->gather;
    few.directions = DIFFERENCE_DIRECTIONS;
    char more[96]; /* a number and the keys */
    snprintf(more, sizeof more, ",short_rays=%d,pixel=centre,debias=true,continued=1,incident=correction",
             SHORT_RAYS);
    const aur_render_options points = coarse_options(&choice->trial, options, COARSE_POINTS);
    result = create_trial(renderer, &points, choice, gather_instead(path, PATTERN_SAMPLES, few, more),
                          &rivals->difference, error);
    if (result == AUR_OK)
        result = find_bias(choice, rivals, wanted, worth - rays, error);
    if (result != AUR_OK || !(sqrt(choice->bias.high) <= BIAS_PART * wanted))
        return result;
    choice->gather.directions =
        pattern_size(directions_to(&rivals->pilot, noise_planned(wanted, choice->bias.high)));
    aur_trial *const gather = &rivals->gather;
    result = create_trial(renderer, options, choice, aur_ask_gather(path, choice->gather), gather, error);
    if (result == AUR_OK)
        result = render_round(choice, &choice->goal, gather, &goes_on, error);
    if (result != AUR_OK || aur_trial_is_black(gather))
        return result;
    const aur_bias sharing =
        aur_replicas_sharing_bias(&gather->replicas, gather->measure.mean, choice->confidence);
    choice->bias = aur_bias_of_both(choice->bias, sharing);
    const double noise = noise_beside(wanted, choice->bias.high);
    if (!(noise > 0.0) ||
        (is_single(choice->gather.directions) && aur_trial_growth(gather, noise) > MOST_GROWTH_SHARED))
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
    const double others = rays_of(&choice->trial) + rays_of(&rivals->path) + rays_of(&rivals->pilot) +
                          rays_of(&rivals->difference);
    return (others + gathered) / (others + fmax(choice->rays, gathered));
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

/* Final gathering beside path tracing, whose trial says what that takes. */
static aur_result compare_with(aur_renderer *renderer, const aur_render_options *options,
                               const aur_render_options *coarse, aur_choice *choice, const aur_trial *path,
                               double wanted, aur_rivals *rivals, bool *better, aur_error *error) {
    const double rays = rivals->pixels * rays_to(path, wanted);
    if (LEAST_PHOTONS * RAYS_A_PHOTON > PILOT_PART * rays)
        return AUR_OK;
    choice->rays = WORTH * rays;
    aur_error refused;
    const aur_gather_size pilot = {PILOT_PHOTONS, choice->gather.seed, PILOT_DIRECTIONS};
    char edges[64]; /* a number and the key's name */
    snprintf(edges, sizeof edges, ",short_rays=0,edges=%zu,share=near", 2 * edges_of(PILOT_DIRECTIONS));
    const aur_result result =
        create_trial(renderer, coarse, choice, gather_instead(choice->trial.integrator, 1, pilot, edges),
                     &rivals->pilot, &refused);
    if (result == AUR_OK)
        return compare(renderer, options, choice, wanted, WORTH * (rays - rays_of(&choice->trial)), rivals,
                       better, error);
    if (result != AUR_ERROR_MEMORY && result != AUR_ERROR_CANCELLED)
        return AUR_OK; /* final gathering says that the scene is not for it */
    if (error != NULL)
        *error = refused;
    return result;
}

aur_result aur_ask_try(aur_renderer *renderer, const aur_render_options *options, aur_choice *choice,
                       aur_error *error) {
    const aur_render_options coarse = coarse_options(&choice->trial, options, COARSE_PIXELS);
    aur_rivals rivals = {.pixels = 1.0};
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
    if (result == AUR_OK && path->bound > wanted && !aur_trial_is_black(path))
        result = compare_with(renderer, options, &coarse, choice, path, wanted, &rivals, &better, error);
    choice->rivals = NULL;
    if (better) {
        const aur_trial left = *whole;
        *whole = rivals.gather;
        rivals.gather = left;
    } else {
        choice->gather = (aur_gather_size){0};
        choice->bias = (aur_bias){0};
    }
    aur_trial *const left[] = {&rivals.path, &rivals.pilot, &rivals.difference, &rivals.gather};
    for (size_t i = 0; i < sizeof left / sizeof left[0]; ++i) {
        add_spent(left[i], &choice->others);
        aur_trial_release(left[i]);
    }
    return result;
}

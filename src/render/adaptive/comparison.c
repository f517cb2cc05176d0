#include "render/adaptive/comparison.h"

#include <math.h>

#include "points/base/error.h"
#include "render/driver/renderer.h"
#include "render/film/film.h"

/* Where a map is wrong by too much, one of so many times the photons is tried, unless its squared bias, which
 * falls hardly faster than photons grow, would have to fall by more than this. In the room to 2 % 1.11 % of
 * the mean were known for the bias of 4 million photons after 150 million rays, where 1.2 % may be left; of 8
 * million 13 million rays told that it is under 1.05 %. */
enum { MAP_GROWTH = 4 };
static const double MOST_MENDED = 3.0;
/* Of the rays that may be spent for the bias, those before which little is said of it. */
static const double LEAST_PART = 1.0 / 32;
/* Where no error is asked, the bias is looked for while rays are left for so many times as many: whatever is
 * known of it counts. */
static const double LEAST_GROWTH = 1.25;
/* A ray that goes on as a path takes so much more time than one of final gathering. */
static const double DIFFERENCE_PRICE = 1.7;

aur_render_options aur_comparison_coarse(const aur_comparison *comparison, const aur_candidate *whole,
                                         size_t part) {
    enum { LEAST_SIDE = 32 };
    const aur_film_layout *const film = &aur_render_film(whole->replicas.renders[0])->layout;
    const size_t width = film->x1 - film->x0, height = film->y1 - film->y0;
    while (part > 1 && (width < LEAST_SIDE * part || height < LEAST_SIDE * part))
        part /= 2;
    aur_render_options own = *comparison->options;
    own.width = (film->width + part - 1) / part;
    own.height = (film->height + part - 1) / part;
    own.crop_x0 = film->x0 / part;
    own.crop_y0 = film->y0 / part;
    own.crop_x1 = (film->x1 + part - 1) / part;
    own.crop_y1 = (film->y1 + part - 1) / part;
    return own;
}

aur_result aur_comparison_create(const aur_comparison *comparison, const aur_choice *choice,
                                 const aur_render_options *options, char *integrator,
                                 aur_candidate *candidate, aur_error *error) {
    candidate->integrator = integrator;
    if (integrator == NULL)
        return aur_fail_memory(error);
    return aur_candidate_create(comparison->renderer, options, choice->replica_count, choice->measure,
                                candidate, error);
}

double aur_comparison_gather_rays(const aur_comparison *comparison, const aur_choice *choice,
                                  double square_bias) {
    const double rays = aur_gather_rays(&comparison->model, comparison->wanted, square_bias);
    return (double)choice->candidate.replicas.pixel_count * rays;
}

double aur_comparison_planned_rays(const aur_comparison *comparison, const aur_choice *choice) {
    return aur_comparison_gather_rays(comparison, choice, pow(AUR_BIAS_PART * comparison->wanted, 2.0));
}

aur_result aur_comparison_round(const aur_choice *choice, const aur_goal *goal, aur_candidate *candidate,
                                bool *more, aur_error *error) {
    aur_candidate_look_ahead(candidate, goal);
    *more =
        aur_candidate_plan(candidate, candidate->rounds > 0 ? aur_candidate_factor(candidate, goal) : 1.0);
    return *more ? aur_candidate_render(candidate, choice->confidence, choice->cancelled, error) : AUR_OK;
}

/* As many samples in every pixel. Samples that go where the first ones differ make a picture whose mean is
 * not quite that of its integrator, which would pass for a difference between integrators. */
static aur_result render_evenly(const aur_choice *choice, aur_candidate *candidate, uint32_t samples,
                                aur_error *error) {
    aur_candidate_plan_evenly(candidate, samples);
    return aur_candidate_render(candidate, choice->confidence, choice->cancelled, error);
}

/* The square of the bias that may be left. */
static double most_bias(const aur_comparison *comparison) {
    return pow(AUR_BIAS_PART * comparison->wanted, 2.0);
}

/* What is uncertain of a squared bias: it falls as samples grow. */
static double uncertain(const aur_bias *bias) {
    return bias->high - fmax(bias->estimate, 0.0);
}

/* Whether twice the rays for the bias cost less than the noise takes that its bound leaves no room for. */
static bool pays(const aur_choice *choice, const aur_comparison *comparison) {
    const aur_bias *const bias = &choice->bias;
    return aur_comparison_gather_rays(comparison, choice, bias->high) -
               aur_comparison_gather_rays(comparison, choice, bias->high - 0.5 * uncertain(bias)) >
           DIFFERENCE_PRICE * aur_candidate_rays(&comparison->difference);
}

/* How many times as many rays show that a squared bias is no more than `most`, if its estimate is too large
 * by chance: a little beyond that, and a step that is worth a look. Infinite where the estimate is too much
 * by more than chance. Continuing is cheap early, and giving up commits to path tracing: until then the
 * estimate may be wrong by more, as the first few samples are where few of them have most of the square (one
 * sample of the room told at least .055 where .016 is true). */
static double growth_needed(const aur_bias *bias, double most, double part_spent) {
    const double probability = part_spent < LEAST_PART ? 2.0 : 0.5;
    const double room = most - fmax(bias->estimate - probability * uncertain(bias), 0.0);
    return room > 0.0 ? fmax(1.2 * uncertain(bias) / room, LEAST_GROWTH) : INFINITY;
}

/* Whether another map will do sooner than knowing this one better: its bias is near what may be left, which
 * is shown by rays without end. */
static bool wants_larger_map(const aur_bias *bias, double most, double part_spent) {
    return bias->high > most && bias->estimate > 0.5 * most && part_spent > LEAST_PART;
}

/* The bias of final gathering, from pictures of what paths find over what the map says at the ends of the
 * same gather rays. What they have in common, above all direct light and short rays, is not traced. They go
 * on until the bias is under what may be left and knowing it better does not pay, or it is seen that it will
 * hardly come there, or not before so many rays are spent. Where no error is asked, these are spent. */
static aur_result find_bias(aur_choice *choice, aur_comparison *comparison, double most_rays,
                            bool may_be_larger, aur_error *error) {
    const double most = most_bias(comparison);
    aur_bias *const bias = &choice->bias;
    for (uint32_t samples = 1;;) {
        const aur_result result = render_evenly(choice, &comparison->difference, samples, error);
        if (result != AUR_OK)
            return result;
        *bias = aur_replicas_bias(&comparison->difference.replicas, NULL,
                                  comparison->pilots[AUR_PILOT_FEW].measure.mean, choice->confidence);
        const double rays = aur_candidate_rays(&comparison->difference);
        const double needed = growth_needed(bias, most, rays / most_rays);
        const double growth = choice->goal.error > 0.0 ? needed : fmin(needed, most_rays / rays);
        if (bias->high <= most ? !pays(choice, comparison)
                               : growth * rays > most_rays || growth < LEAST_GROWTH)
            return AUR_OK;
        if (may_be_larger && wants_larger_map(bias, most, rays / most_rays))
            return AUR_OK;
        samples = (uint32_t)ceil(samples * (bias->high <= most ? 2.0 : fmin(growth, 4.0)));
    }
}

aur_result aur_comparison_find_map(aur_comparison *comparison, aur_choice *choice, double rays, double worth,
                                   aur_error *error) {
    const aur_render_options points =
        aur_comparison_coarse(comparison, &choice->candidate, AUR_COARSE_POINTS);
    const double most = most_bias(comparison);
    const size_t most_photons = aur_gather_photons(worth - rays);
    double spent = 0.0; /* on smaller maps */
    size_t *const photons = &choice->gather.photons;
    for (*photons = aur_gather_photons(rays);;) {
        aur_candidate *const difference = &comparison->difference;
        const bool may_be_larger = *photons < most_photons;
        const double most_rays = worth - rays - spent;
        char *const text =
            aur_adaptive_gather_difference(choice->candidate.integrator, *photons, choice->gather.seed);
        aur_result result = aur_comparison_create(comparison, choice, &points, text, difference, error);
        if (result == AUR_OK)
            result = find_bias(choice, comparison, most_rays, may_be_larger, error);
        if (result != AUR_OK || !may_be_larger || choice->bias.estimate > MOST_MENDED * most)
            return result;
        /* What is badly known of this map would be so of a larger one. */
        const double traced = aur_candidate_rays(difference);
        if (!wants_larger_map(&choice->bias, most, traced / most_rays))
            return AUR_OK;
        spent += traced;
        aur_candidate_add_spent(difference, &choice->others);
        aur_candidate_release(difference);
        *photons = *photons * MAP_GROWTH < most_photons ? *photons * MAP_GROWTH : most_photons;
    }
}

#include <math.h>

#include "render/adaptive/comparison.h"
#include "render/film/film.h"

/* Of final gathering's rays, what each further pilot may cost. It is chosen: it costs time, never truth. */
static const double FURTHER_PILOT_PART = 0.07;
/* By more points on lights the square of the error falls by so much, or still more bring nothing. */
static const double LEAST_GAIN = 2.0;

/* Without rays at edges, of which coarse pixels have more, and which cost little. */
static aur_pilot_outcome outcome_of(aur_candidate *path, const aur_candidate *pilot, bool *alone) {
    const aur_outliers outliers = aur_outliers_find(path, pilot);
    *alone = *alone || outliers.rest < 1.0;
    double rays = 0.0;
    for (size_t r = 0; r < pilot->replicas.count; ++r) {
        const aur_counters counted = aur_film_counted(aur_render_film(pilot->replicas.renders[r]));
        rays += (double)(counted.rays - counted.edge_rays);
    }
    return (aur_pilot_outcome){pilot->interval.estimate * sqrt(outliers.rest),
                               rays * outliers.price / (double)pilot->replicas.pixel_count};
}

static aur_result render_pilot(const aur_comparison *comparison, const aur_render_options *coarse,
                               const aur_choice *choice, aur_pilot_kind kind, aur_candidate *pilot,
                               aur_error *error) {
    char *const text = aur_adaptive_gather_pilot(choice->candidate.integrator, choice->gather.seed, kind);
    const aur_result result = aur_comparison_create(comparison, choice, coarse, text, pilot, error);
    bool goes_on;
    return result == AUR_OK ? aur_comparison_round(choice, &choice->goal, pilot, &goes_on, error) : result;
}

/* Which pilots there may be, and about how many times the rays of the last one each takes. */
typedef struct pilot_plan {
    aur_pilot_kind kind; /* lights 0: as many as the last one that differs by them */
    double rays;
} pilot_plan;

static const pilot_plan plans[AUR_PILOT_KINDS] = {
    [AUR_PILOT_FEW] = {{.lights = AUR_PILOT_LIGHTS}, 0.0},
    [AUR_PILOT_MORE] = {{.lights = AUR_PILOT_LIGHTS_MORE}, 2.0},
    [AUR_PILOT_MOST] = {{.lights = AUR_PILOT_LIGHTS_MOST}, 2.5},
    [AUR_PILOT_CENTRE] = {{.centre = true}, 1.0},
    [AUR_PILOT_DRAWN] = {{.bright = AUR_PILOT_BRIGHT}, 1.0},
};

/* Whether another pilot costs little beside the picture, and may tell something new. */
static bool wants(const aur_comparison *comparison, const aur_choice *choice, size_t pilot) {
    const aur_pilot_outcome *const of = comparison->told.of;
    const size_t last = aur_gather_last_pilot(&comparison->told);
    if (pilot > AUR_PILOT_MORE && last == AUR_PILOT_FEW)
        return false;
    if (pilot == AUR_PILOT_MOST &&
        pow(of[AUR_PILOT_FEW].error, 2.0) < LEAST_GAIN * pow(of[AUR_PILOT_MORE].error, 2.0))
        return false;
    return plans[pilot].rays * aur_candidate_rays(&comparison->pilots[last]) <=
           FURTHER_PILOT_PART * aur_comparison_planned_rays(comparison, choice);
}

/* The least error, at most that of path tracing, to which final gathering takes a part of `worth` rays: the
 * rest is for its map and the map's bias. */
static double error_for(aur_comparison *comparison, const aur_choice *choice, double worth) {
    const double part = 0.6, step = 0.95, least = 0.01;
    comparison->wanted = comparison->path_error;
    while (comparison->wanted > least * comparison->path_error &&
           aur_comparison_planned_rays(comparison, choice) <= part * worth)
        comparison->wanted *= step;
    return fmin(comparison->wanted / step, comparison->path_error);
}

aur_result aur_comparison_render_pilots(aur_comparison *comparison, const aur_render_options *coarse,
                                        const aur_choice *choice, double worth, aur_candidate *path,
                                        aur_error *error) {
    comparison->told = (aur_gather_pilots){.side = sqrt(comparison->pixels)};
    for (size_t i = 0; i < AUR_PILOT_KINDS; ++i) {
        if (i > 0 && !wants(comparison, choice, i))
            continue;
        aur_pilot_kind kind = plans[i].kind;
        if (kind.lights == 0)
            kind.lights = plans[aur_gather_last_pilot(&comparison->told)].kind.lights;
        aur_candidate *const pilot = &comparison->pilots[i];
        const aur_result result = render_pilot(comparison, coarse, choice, kind, pilot, error);
        const bool black = result == AUR_OK && aur_candidate_is_black(pilot);
        if (result != AUR_OK || (black && i == 0))
            return result;
        if (black)
            continue;
        comparison->told.of[i] = outcome_of(path, pilot, &comparison->told.alone);
        comparison->model = aur_gather_model_of(&comparison->told);
        if (!(choice->goal.error > 0.0))
            comparison->wanted = error_for(comparison, choice, worth);
    }
    return AUR_OK;
}

#include "render/adaptive/comparison.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"

/* One more candidate takes so much of a sample's time: .11 to .25 by trial on six scenes. */
static const double CANDIDATE_PRICE = 0.2;
/* By less than this part nothing is gained for sure: few samples are looked at. */
static const double LEAST_GAIN = 0.1;

static const size_t counts[AUR_CANDIDATE_CHOICES] = {1, 2, 4};

char *aur_adaptive_path(const char *path, size_t candidates) {
    enum { CAPACITY = 48 }; /* a number and the key's name */
    const size_t capacity = strlen(path) + CAPACITY;
    char *const text = malloc(capacity);
    if (text != NULL)
        snprintf(text, capacity, candidates > 1 ? "%s%scandidates=%zu" : "%s", path,
                 strchr(path, ':') != NULL ? "," : ":", candidates);
    return text;
}

/* Samples that go where they are needed leave an error whose square is as the square of this sum. */
static double sum_of_deviations(const aur_candidate *candidate) {
    double sum = 0.0;
    for (size_t i = 0; i < candidate->value_count; ++i)
        sum += sqrt(candidate->variances[i]);
    return sum;
}

static aur_result look_at(aur_renderer *renderer, const aur_render_options *coarse, const aur_choice *choice,
                          size_t candidates, double *deviations, aur_spent *spent, aur_error *error) {
    aur_candidate candidate = {.integrator = aur_adaptive_path(choice->candidate.integrator, candidates)};
    aur_result result = candidate.integrator != NULL
                            ? aur_candidate_create(renderer, coarse, choice->replica_count, choice->measure,
                                                   &candidate, error)
                            : aur_fail_memory(error);
    if (result == AUR_OK) {
        aur_candidate_plan_evenly(&candidate, AUR_CANDIDATE_SAMPLES);
        result = aur_candidate_render(&candidate, choice->confidence, choice->cancelled, error);
    }
    if (result == AUR_OK)
        *deviations = sum_of_deviations(&candidate);
    aur_candidate_add_spent(&candidate, spent);
    aur_candidate_release(&candidate);
    return result;
}

aur_result aur_adaptive_candidates(aur_renderer *renderer, const aur_render_options *coarse,
                                   const aur_choice *choice, aur_candidates *found, aur_spent *spent,
                                   aur_error *error) {
    double one = 0.0;
    *found = (aur_candidates){1, 1.0};
    for (size_t i = 0; i < AUR_CANDIDATE_CHOICES; ++i) {
        double deviations;
        const aur_result result = look_at(renderer, coarse, choice, counts[i], &deviations, spent, error);
        if (result != AUR_OK)
            return result;
        if (i == 0)
            one = deviations;
        const double part = one > 0.0 ? deviations / one : 1.0;
        const double cost = part * part * (1.0 + CANDIDATE_PRICE * (double)(counts[i] - 1));
        if (cost < (found->count == 1 ? 1.0 - LEAST_GAIN : found->cost))
            *found = (aur_candidates){counts[i], cost};
    }
    return AUR_OK;
}

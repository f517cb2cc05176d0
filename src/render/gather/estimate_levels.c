/* Gathering by as many directions as the light asks for: a level of an extensible grid at a time, while the
 * samples differ too much. */
#include "render/gather/estimators.h"

/* Samples of one lane and channel so far. */
typedef struct spread {
    double sum, squares;
    double information; /* sum of c log c */
} spread;

static void add_value(spread *s, double value) {
    s->sum += value;
    s->squares += value * value;
    s->information += value > 0.0 ? value * log(value) : 0.0;
}

/* 1 - H / log n of the samples' shares p = c / sum c, H = -sum p log p: 0 for constant light, 1 where one
 * sample has it all. Rigau, Feixas, Sbert 2003, as 1 less their figure so that it grows with variation. */
static double entropy_contrast(const spread *s, double count) {
    if (!(s->sum > 0.0) || count < 2.0)
        return 0.0;
    const double entropy = log(s->sum) - s->information / s->sum;
    return 1.0 - entropy / log(count);
}

/* The expected error over the mean: the samples' spread times the level's worst-case error over that of one
 * random direction. */
static double relative_error(const spread *s, double count, double level_error) {
    if (!(s->sum > 0.0) || count < 2.0)
        return 0.0;
    const double mean = s->sum / count;
    const double variance = fmax(s->squares / count - mean * mean, 0.0);
    return sqrt(variance) / mean * level_error;
}

/* Over the channels, weighted by their means. */
static double contrast_of(aur_gather_criterion criterion, const aur_gather_levels *levels, size_t level,
                          const spread spreads[3], double count) {
    double weighted = 0.0, total = 0.0;
    for (size_t c = 0; c < 3; ++c) {
        const double contrast = criterion == AUR_CRITERION_ENTROPY
                                    ? entropy_contrast(&spreads[c], count)
                                    : relative_error(&spreads[c], count, (double)levels->errors[level]);
        weighted += spreads[c].sum * contrast;
        total += spreads[c].sum;
    }
    return total > 0.0 ? weighted / total : 0.0;
}

typedef struct adaptive_state {
    spread spreads[AUR_PACKET_SIZE][3];
    uint32_t samples[AUR_PACKET_SIZE]; /* that were above the surface */
    float *values; /* of direction i, channel c, lane k: values[(3 * i + c) * AUR_PACKET_SIZE + k] */
} adaptive_state;

/* Traces the directions of one level. */
static void add_level(const aur_gather_places *places, const aur_gather_sweep *sweep, size_t level,
                      adaptive_state *state, aur_gather_sums *sums) {
    const aur_gather_levels *const levels = &sweep->rule->levels;
    const float *const weights = sweep->rule->rule.weights;
    for (size_t i = level > 0 ? levels->ends[level - 1] : 0; i < levels->ends[level]; ++i) {
        float factor[AUR_PACKET_SIZE];
        const uint32_t aimed = aur_gather_sweep_trace(places, sweep, i, false, sums, factor);
        for (size_t c = 0; c < 3; ++c)
            for (size_t k = 0; k < AUR_PACKET_SIZE; ++k)
                state->values[(3 * i + c) * AUR_PACKET_SIZE + k] =
                    aur_has_lane(aimed, k) ? factor[k] * sums->rays.radiance[c][k] : 0.0f;
        for (uint32_t rest = aimed; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            ++state->samples[lane];
            for (size_t c = 0; c < 3; ++c)
                add_value(&state->spreads[lane][c],
                          (double)(state->values[(3 * i + c) * AUR_PACKET_SIZE + lane] * weights[i]));
        }
    }
}

/* A lane's integral with the weights of its last level. */
static void finish_lane(const aur_gather_places *places, const aur_gather_sweep *sweep, size_t level,
                        const float *values, size_t lane, aur_gather_sums *sums) {
    const aur_gather_levels *const levels = &sweep->rule->levels;
    float sum[3] = {0};
    for (size_t i = 0; i < levels->ends[level]; ++i)
        for (size_t c = 0; c < 3; ++c)
            sum[c] += levels->weights[level][i] * values[(3 * i + c) * AUR_PACKET_SIZE + lane];
    aur_gather_add(sums, places, lane,
                   aur_vector_multiply((aur_vector){sum[0], sum[1], sum[2]},
                                       places->at[lane].lobes[sweep->lobe].coefficient));
    sums->directions[lane] += (uint32_t)levels->ends[level];
    ++sums->counters->levels[level];
}

void aur_gather_by_levels(const aur_gather_places *places, const aur_gather_lobe_rule *rule, size_t lobe,
                          uint32_t lanes, aur_gather_sums *sums) {
    const aur_gather_options *const policy = &places->plan->policy;
    aur_gather_sweep sweep;
    aur_gather_sweep_start(places, rule, lobe, lanes, &sweep, &sums->rays);
    adaptive_state state = {.values = sums->numbers};
    for (size_t level = 0; sweep.lanes != 0; ++level) {
        add_level(places, &sweep, level, &state, sums);
        for (uint32_t rest = sweep.lanes; rest != 0; rest &= rest - 1) {
            const size_t lane = aur_first_lane(rest);
            if (level + 1 < rule->levels.count &&
                contrast_of(policy->criterion, &rule->levels, level, state.spreads[lane],
                            (double)state.samples[lane]) > (double)policy->threshold)
                continue;
            finish_lane(places, &sweep, level, state.values, lane, sums);
            sweep.lanes &= ~(1u << lane);
        }
    }
}

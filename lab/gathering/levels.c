#include "levels.h"

#include <aureole/sphere.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ggx.h"
#include "weighted.h"

enum { LANES = AUR_GATHER_LANES };

/* --- options */

/* Fills in the defaults. */
static lab_gather_settings completed(const aur_gather_settings *given) {
    lab_gather_settings o = *lab_settings(given);
    o.criterion = o.criterion == LAB_CRITERION_DEFAULT ? LAB_CRITERION_VARIANCE : o.criterion;
    if (o.threshold < 0.0f) /* by measurement: see docs/papers/gathering.md */
        o.threshold = o.criterion == LAB_CRITERION_ENTROPY             ? 0.3f
                      : o.criterion == LAB_CRITERION_ENTROPY_HISTOGRAM ? 1.0f
                                                                       : 0.03f;
    o.levels = o.levels == 0 ? 2 : o.levels;
    o.level_factor = o.level_factor == 0 ? 4 : o.level_factor;
    return o;
}

/* An unused parameter is an error: usually 'levels' after a comma in the pattern. */
void lab_levels_warn_unused(const lab_gather_settings *o, aur_warnings warnings) {
    const struct {
        const char *name;
        bool given;
    } keys[] = {{"levels", o->levels != 0},
                {"level_factor", o->level_factor != 0},
                {"criterion", o->criterion != LAB_CRITERION_DEFAULT},
                {"threshold", o->threshold >= 0.0f}};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0] && warnings.function != NULL; ++i) {
        char text[256];
        snprintf(
            text, sizeof text,
            "finalgather-lab: '%s' belongs to adaptive=true and does nothing here; keys of a pattern stand "
            "in parentheses: pattern=(SET:%s=...)",
            keys[i].name, keys[i].name);
        if (keys[i].given)
            warnings.function(warnings.user, text);
    }
}

aur_result lab_levels_check(const lab_gather_settings *o, aur_error *error) {
    const struct {
        bool excluded;
        aur_result result;
        const char *message;
    } exclusions[] = {
        {o->gather.share != AUR_SHARE_NONE, AUR_ERROR_UNSUPPORTED, "share does not go with adaptive=true"},
        {o->gather.debias != AUR_DEBIAS_NONE, AUR_ERROR_UNSUPPORTED,
         "debias corrects the bias of the photon map, not that of adaptive=true: leave one of them out"},
        {lab_merges(o), AUR_ERROR_UNSUPPORTED,
         "adaptive gathering grows each lobe's pattern by itself: weights of merged samples (oswa, mis) do "
         "not "
         "go with it; take osw, ratio or equal"},
        {o->level_factor == 3, AUR_ERROR_ARGUMENT, "'level_factor' is 2 or 4, not 3"},
    };
    for (size_t i = 0; i < sizeof exclusions / sizeof exclusions[0]; ++i)
        if (exclusions[i].excluded)
            return aur_fail(error, exclusions[i].result, "finalgather-lab: %s", exclusions[i].message);
    return AUR_OK;
}

static aur_result choose(const aur_gather_settings *given, size_t base, size_t capacity, char *set,
                         size_t *count, aur_error *error) {
    /* Beyond it the system for optimal weights takes longer than an image. */
    enum { MOST_DIRECTIONS = 1 << 24, MOST_OPTIMAL = 4096 };
    const lab_gather_settings o = completed(given);
    *count = base;
    for (size_t l = 0; l < o.levels; ++l) {
        *count *= o.level_factor;
        if (*count > MOST_DIRECTIONS)
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "finalgather-lab: %zu directions extended %zu times by %zu are more than %d; use "
                            "fewer levels",
                            base, o.levels, o.level_factor, MOST_DIRECTIONS);
    }
    if (o.weights == LAB_WEIGHTS_OSW && *count > MOST_OPTIMAL)
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "finalgather-lab: optimal weights of levels of up to %zu directions would take too long "
            "(at most %d); use fewer levels or weights=ratio",
            *count, MOST_OPTIMAL);
    const aur_set_description *const description = aur_set_find(given->pattern);
    if (strcmp(given->pattern, "spherical-fibonacci") != 0) { /* which stands for the grid */
        if (description == NULL || !description->extensible)
            return aur_fail(
                error, AUR_ERROR_UNSUPPORTED,
                "finalgather-lab: adaptive gathering extends its pattern, and '%s' is not extensible",
                given->pattern);
        snprintf(set, capacity, "%s", given->pattern);
        return AUR_OK;
    }
    const size_t quadruplings = o.level_factor == 4 ? o.levels : (o.levels + 1) / 2;
    snprintf(set, capacity, "esfg:base=%zu,levels=%zu,progression=%zu", base, quadruplings, o.level_factor);
    return AUR_OK;
}

/* --- levels of a pattern */

typedef struct gather_levels {
    lab_criterion criterion;
    float threshold;
    const float *pattern_weights;    /* p/q */
    size_t count;                    /* levels */
    size_t ends[LAB_LEVEL_CAPACITY]; /* directions of level l and those before it */
    /* weights[l] + i: weight of direction i if level l is the last one; the sum of weight * f estimates the
     * integral. */
    float *weights[LAB_LEVEL_CAPACITY];
    /* The worst-case error of each level relative to that of one random direction: the factor from the spread
     * of the samples to an estimate of the error. */
    float errors[LAB_LEVEL_CAPACITY];
} gather_levels;

/* Inputs of the weights of all levels. */
typedef struct level_maker {
    const lab_gather_settings *options;
    const aur_gather_directions *pattern;
    aur_potential *potential;
    double *xyz, *numbers; /* of all directions; two numbers each */
} level_maker;

/* The weights and the error of a level that ends after `count` directions. */
static aur_result make_level(const level_maker *maker, size_t count, float **weights, float *worst,
                             aur_error *error) {
    const double smoothness = maker->options->gather.smoothness, mass = aur_potential_mass(maker->potential);
    const bool optimal = maker->options->weights == LAB_WEIGHTS_OSW;
    double *const numbers = maker->numbers, *const normalised = numbers + count;
    *weights = malloc(count * sizeof **weights);
    if (*weights == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "finalgather-lab: out of memory for %zu weights", count);
    aur_result result = optimal ? lab_optimal_weights(count, maker->xyz, maker->potential,
                                                      maker->options->regularization, numbers, error)
                                : AUR_OK;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        if (!optimal) /* p/q, a mean */
            numbers[i] = (double)maker->pattern->weights[i] / (double)count;
        normalised[i] = numbers[i] / mass;
        (*weights)[i] = (float)numbers[i];
    }
    double found = 0.0;
    const aur_worst_case_options alone = {.size = sizeof alone, .threads = 1};
    if (result == AUR_OK)
        result = aur_worst_case_error(count, maker->xyz, normalised, maker->potential, &alone, &found, error);
    /* K of a direction with itself, less the self-energy: the squared error of one random direction. */
    const double diagonal = pow(2.0, 2.0 * smoothness - 1.0) / smoothness;
    *worst = (float)(found / sqrt(diagonal - aur_potential_self_energy(maker->potential)));
    return result;
}

static aur_result prepare(const aur_gather_settings *given, const aur_gather_common *common, size_t base,
                          const aur_gather_directions *pattern, void *diffuse, void **state,
                          aur_error *error) {
    (void)common, (void)diffuse;
    const lab_gather_settings o = completed(given);
    const aur_density density = {.size = sizeof density, .exponent = pattern->exponent};
    gather_levels *const levels = calloc(1, sizeof *levels);
    level_maker maker = {
        .options = &o, .pattern = pattern, .xyz = malloc(5 * pattern->count * sizeof *maker.xyz)};
    *state = levels;
    aur_result result = AUR_OK;
    if (levels == NULL || maker.xyz == NULL)
        result = aur_fail(error, AUR_ERROR_MEMORY, "finalgather-lab: out of memory for levels");
    if (result == AUR_OK)
        result = aur_potential_create(&density, given->smoothness, &maker.potential, error);
    if (result == AUR_OK) {
        *levels = (gather_levels){.criterion = o.criterion,
                                  .threshold = o.threshold,
                                  .pattern_weights = pattern->weights,
                                  .count = o.levels + 1};
        maker.numbers = maker.xyz + 3 * pattern->count;
        lab_widen(pattern, 0, maker.xyz);
    }
    size_t end = base;
    for (size_t l = 0; result == AUR_OK && l < levels->count; ++l, end *= o.level_factor) {
        levels->ends[l] = end;
        result = make_level(&maker, end, &levels->weights[l], &levels->errors[l], error);
    }
    aur_potential_destroy(maker.potential);
    free(maker.xyz);
    return result;
}

static void release(void *state) {
    gather_levels *const levels = state;
    for (size_t l = 0; levels != NULL && l < LAB_LEVEL_CAPACITY; ++l)
        free(levels->weights[l]);
    free(levels);
}

/* --- at shading points */

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

/* 1 - H / log n of the samples' shares p = c / sum c, H = -sum p log p: 0 for constant light, 1 if one sample
 * has all of it. This is 1 minus the measure of Rigau, Feixas, Sbert 2003, so that it increases with
 * variation. */
static double entropy_contrast(const spread *s, double count) {
    if (!(s->sum > 0.0) || count < 2.0)
        return 0.0;
    const double entropy = log(s->sum) - s->information / s->sum;
    return 1.0 - entropy / log(count);
}

/* The expected relative error: the samples' spread times the level's worst-case error relative to that of one
 * random direction. */
static double relative_error(const spread *s, double count, double level_error) {
    if (!(s->sum > 0.0) || count < 2.0)
        return 0.0;
    const double mean = s->sum / count;
    const double variance = fmax(s->squares / count - mean * mean, 0.0);
    return sqrt(variance) / mean * level_error;
}

enum { BINS = 16 };

/* The index among BINS equal steps of displayed brightness: 1 is white, gamma 2.2. */
static size_t bin_of(double red, double green, double blue) {
    const double luminance = fmin(1.0, fmax(0.0, 0.2126 * red + 0.7152 * green + 0.0722 * blue));
    return (size_t)fmin(BINS - 1.0, BINS * pow(luminance, 1.0 / 2.2));
}

/* Shannon entropy in nats: 0 if all samples are equally bright. */
static double histogram_entropy(const uint32_t bins[BINS], double count) {
    double entropy = 0.0;
    for (size_t b = 0; b < BINS; ++b)
        if (bins[b] > 0)
            entropy -= (double)bins[b] / count * log((double)bins[b] / count);
    return entropy;
}

/* Weighted mean over the channels: by their shares of the colour or, for entropy-brightness, by their
 * absolute means, so that dark points have little contrast. */
static double contrast_of(const gather_levels *levels, size_t level, const spread spreads[3],
                          const uint32_t bins[BINS], double count) {
    static const double sensitivity[3] = {0.4, 0.3, 0.6}; /* Rigau 2003 */
    if (levels->criterion == LAB_CRITERION_ENTROPY_HISTOGRAM)
        return histogram_entropy(bins, count);
    double weighted = 0.0, total = 0.0, bright = 0.0;
    for (size_t c = 0; c < 3; ++c) {
        const double contrast = levels->criterion == LAB_CRITERION_VARIANCE
                                    ? relative_error(&spreads[c], count, (double)levels->errors[level])
                                    : entropy_contrast(&spreads[c], count);
        weighted += spreads[c].sum * contrast;
        bright += sensitivity[c] * spreads[c].sum * contrast;
        total += spreads[c].sum;
    }
    if (levels->criterion == LAB_CRITERION_ENTROPY_BRIGHTNESS)
        return bright / fmax(1.0, count);
    return total > 0.0 ? weighted / total : 0.0;
}

typedef struct adaptive_state {
    spread spreads[LANES][3];
    uint32_t samples[LANES]; /* samples above the surface */
    uint32_t bins[LANES][BINS];
    float *values; /* of direction i, channel c, lane k: values[(3 * i + c) * LANES + k] */
} adaptive_state;

/* Traces the directions of one level. */
static void add_level(const gather_levels *levels, size_t level, uint32_t lanes, aur_gather_sweep *sweep,
                      adaptive_state *state) {
    for (size_t i = level > 0 ? levels->ends[level - 1] : 0; i < levels->ends[level]; ++i) {
        float(*const values)[LANES] = (float(*)[LANES])(state->values + 3 * i * LANES);
        const uint32_t aimed = aur_gather_trace(sweep, lanes, i, values);
        for (size_t lane = 0; lane < LANES; ++lane) {
            if ((aimed >> lane & 1u) == 0)
                continue;
            ++state->samples[lane];
            if (levels->criterion == LAB_CRITERION_ENTROPY_HISTOGRAM)
                ++state->bins[lane][bin_of((double)values[0][lane], (double)values[1][lane],
                                           (double)values[2][lane])];
            for (size_t c = 0; c < 3; ++c)
                add_value(&state->spreads[lane][c], (double)(values[c][lane] * levels->pattern_weights[i]));
        }
    }
}

/* A lane's integral with the weights of its last level. */
static void finish_lane(const gather_levels *levels, size_t level, const float *values, size_t lane,
                        aur_gather_sweep *sweep) {
    float sum[3] = {0};
    for (size_t i = 0; i < levels->ends[level]; ++i)
        for (size_t c = 0; c < 3; ++c)
            sum[c] += levels->weights[level][i] * values[(3 * i + c) * LANES + lane];
    aur_gather_finish(sweep, lane, sum, levels->ends[level], level);
}

static void gather(const void *prepared, uint32_t lanes, aur_gather_sweep *sweep, float *memory) {
    const gather_levels *const levels = prepared;
    adaptive_state state = {.values = memory};
    for (size_t level = 0; lanes != 0; ++level) {
        add_level(levels, level, lanes, sweep, &state);
        for (size_t lane = 0; lane < LANES; ++lane) {
            if ((lanes >> lane & 1u) == 0)
                continue;
            if (level + 1 < levels->count &&
                contrast_of(levels, level, state.spreads[lane], state.bins[lane],
                            (double)state.samples[lane]) > (double)levels->threshold)
                continue;
            finish_lane(levels, level, state.values, lane, sweep);
            lanes &= ~(1u << lane);
        }
    }
}

const aur_gather_method lab_gather_by_levels = {.choose = choose,
                                                .prepare = prepare,
                                                .release = release,
                                                .gather = gather,
                                                .prepare_ggx = lab_ggx_prepare,
                                                .release_ggx = lab_ggx_release,
                                                .gather_ggx = lab_ggx_gather};

#include "transport/gather/rule_merged.h"

#include <stdlib.h>

#include "core/error.h"
#include "quadrature/weight_rows.h"

/* --- making one
 * ------------------------------------------------------------------------------------------------------- */

/* Linear interpolation loses less than 0.2 % of the gain with so many angles: 32 for m = 20, 64 for 200. */
static size_t angle_count(double exponent) {
    size_t count = 32;
    while (count < 256 && (double)(count * count) < 20.0 * exponent)
        count *= 2;
    return count;
}

static aur_oswa_options oswa_options(const aur_pair_options *options) {
    return (aur_oswa_options){.set = options->set,
                              .count = options->count[0],
                              .mirror_count = options->count[1],
                              .lobe = {.exponent = 1.0},
                              .mirror_lobe = {.exponent = options->exponent},
                              .optimal_density = options->optimal_density,
                              .clipped = options->clipped && options->method == AUR_PAIR_OSWA,
                              .map = options->map,
                              .scramble = options->scramble,
                              .seed = options->seed,
                              .smoothness = options->smoothness,
                              /* The paper has no constraint of the sum. */
                              .weights = {options->regularization, options->method == AUR_PAIR_OSWA}};
}

/* Where sample `index` of a pattern stands in the order of shares. */
static size_t place_of(const aur_gather_pair *pair, size_t pattern, size_t index) {
    return index % pair->shares * pair->share_count[pattern] + index / pair->shares;
}

static aur_result allocate(aur_gather_pair *pair, aur_error *error) {
    const size_t samples = pair->rotations * (pair->count[0] + pair->count[1]);
    float *next = malloc(3 * samples * sizeof *next);
    pair->storage = next;
    if (next == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu rotations of %zu + %zu directions",
                        pair->rotations, pair->count[0], pair->count[1]);
    for (size_t pattern = 0; pattern < 2; ++pattern)
        for (size_t k = 0; k < 3; ++k, next += pair->rotations * pair->count[pattern])
            pair->direction[pattern][k] = next;
    return AUR_OK;
}

/* The patterns in all their turns; at the angle 0 both stand about +z. */
static aur_result fill_directions(aur_gather_pair *pair, const aur_oswa_options *options, aur_error *error) {
    const size_t size = pair->count[0] + pair->count[1];
    double *const xyz = malloc(3 * size * sizeof *xyz);
    if (xyz == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    aur_result result = AUR_OK;
    if (pair->table == NULL)
        result = aur_oswa_create(options, &pair->oswa, error);
    for (size_t rotation = 0; rotation < pair->rotations && result == AUR_OK; ++rotation) {
        double turns[2];
        aur_oswa_turns(pair->seed, rotation, turns);
        result = pair->table != NULL
                     ? aur_weight_table_points(pair->table, 0.0, rotation, false, 3 * size, xyz, error)
                     : aur_oswa_points(pair->oswa, 0.0, turns, false, 3 * size, xyz, error);
        const double *u = xyz;
        for (size_t pattern = 0; pattern < 2 && result == AUR_OK; ++pattern)
            for (size_t i = 0; i < pair->count[pattern]; ++i, u += 3)
                for (size_t k = 0; k < 3; ++k)
                    pair->direction[pattern][k][rotation * pair->count[pattern] +
                                                place_of(pair, pattern, i)] = (float)u[k];
    }
    free(xyz);
    return result;
}

static void fill_densities(aur_gather_pair *pair) {
    for (size_t pattern = 0; pattern < 2; ++pattern) {
        const double exponent = pair->drawn_exponent[pattern];
        const double scale = (double)pair->share_count[pattern] * (exponent + 1.0) / (2.0 * AUR_PI);
        for (size_t i = 0; i <= AUR_PAIR_DENSITY_STEPS; ++i)
            pair->density[pattern][i] = (float)(scale * pow((double)i / AUR_PAIR_DENSITY_STEPS, exponent));
    }
}

/* The table's rows in the order of shares, for integrals of the lobes as they are written: of mass pi for the
 * diffuse lobe; that of the glossy one depends on the angle and is left for the look-up. */
static aur_result compile(aur_gather_pair *pair, aur_error *error) {
    const size_t size = pair->count[0] + pair->count[1];
    const size_t row_count = aur_weight_table_row_count(pair->table);
    pair->rows = malloc(row_count * 2 * size * sizeof *pair->rows);
    if (pair->rows == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for the weights of %zu directions", size);
    const size_t share = aur_gather_pair_share(pair);
    for (size_t row = 0; row < row_count; ++row) {
        for (size_t lobe = 0; lobe < 2; ++lobe) {
            const float *const from = aur_weight_table_row(pair->table, row) + lobe * size;
            const float scale = (float)pair->shares * (lobe == 0 ? AUR_PI_F : 1.0f);
            for (size_t i = 0; i < size; ++i) {
                const size_t pattern = i < pair->count[0] ? 0 : 1;
                const size_t index = i - pattern * pair->count[0];
                float *const block = pair->rows + row * 2 * size + index % pair->shares * 2 * share;
                block[lobe * share + pattern * pair->share_count[0] + index / pair->shares] = scale * from[i];
            }
        }
    }
    return AUR_OK;
}

static aur_result prepare(aur_gather_pair *pair, const aur_pair_options *options, aur_error *error) {
    aur_oswa_options wanted = oswa_options(options);
    aur_result result = AUR_OK;
    if (options->method == AUR_PAIR_OSWA)
        result = aur_weight_table_build(&wanted, angle_count(options->exponent), options->rotations,
                                        options->threads, &options->progress, &pair->table, error);
    if (options->method == AUR_PAIR_SOLVE)
        wanted.published_z = (aur_z_grid){64, 32, fmax(1.0, options->exponent)};
    if (result == AUR_OK)
        result = fill_directions(pair, &wanted, error);
    if (result == AUR_OK && pair->table != NULL)
        result = compile(pair, error);
    return result;
}

static aur_result create(aur_gather_pair *pair, const aur_pair_options *options, aur_error *error) {
    const double power = options->optimal_density ? 2.0 / (options->smoothness + 1.0) : 1.0;
    pair->method = options->method;
    pair->shares = options->shares;
    pair->rotations = options->rotations;
    pair->exponent = options->exponent;
    pair->mass = 2.0 * AUR_PI / (options->exponent + 1.0);
    pair->seed = options->seed;
    for (size_t pattern = 0; pattern < 2; ++pattern) {
        pair->count[pattern] = options->count[pattern];
        pair->share_count[pattern] = options->count[pattern] / options->shares;
        pair->drawn_exponent[pattern] = power * (pattern == 0 ? 1.0 : options->exponent);
    }
    fill_densities(pair);
    const aur_result result = allocate(pair, error);
    return result == AUR_OK ? prepare(pair, options, error) : result;
}

aur_result aur_gather_pair_create(const aur_pair_options *options, aur_gather_pair **pair, aur_error *error) {
    *pair = NULL;
    if (options->rotations == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "weights of merged samples need prepared rotations: at least 1, not 0");
    if (options->shares == 0 || options->count[0] % options->shares != 0 ||
        options->count[1] % options->shares != 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "%zu + %zu directions are not shared evenly by %zu samples", options->count[0],
                        options->count[1], options->shares);
    aur_gather_pair *const created = calloc(1, sizeof *created);
    if (created == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    const aur_result result = create(created, options, error);
    if (result != AUR_OK) {
        aur_gather_pair_destroy(created);
        return result;
    }
    *pair = created;
    return AUR_OK;
}

void aur_gather_pair_destroy(aur_gather_pair *pair) {
    if (pair == NULL)
        return;
    aur_weight_table_destroy(pair->table);
    aur_oswa_destroy(pair->oswa);
    free(pair->rows);
    free(pair->storage);
    free(pair);
}

/* --- at a shading point
 * ----------------------------------------------------------------------------------------------- */

static void look_up(const aur_gather_pair *pair, size_t rotation, size_t share, float radians,
                    float *weights) {
    float part;
    const size_t row = aur_weight_table_locate(pair->table, rotation, radians, &part);
    const size_t samples = aur_gather_pair_share(pair);
    const size_t row_size = 2 * samples * pair->shares;
    const float *restrict below = pair->rows + row * row_size + share * 2 * samples;
    const float *restrict above = below + row_size;
    float *restrict target = weights;
    for (size_t i = 0; i < samples; ++i)
        target[i] = below[i] + part * (above[i] - below[i]);
    const float mass = (float)aur_weight_table_mass(pair->table, (double)radians);
    for (size_t i = samples; i < 2 * samples; ++i)
        target[i] = mass * (below[i] + part * (above[i] - below[i]));
}

/* cos^exponent / (n q + n' q') for each lobe and sample; below the surface there is no light. */
static void balance(const aur_gather_pair *pair, size_t rotation, size_t share, float cosine,
                    float *weights) {
    const size_t samples = aur_gather_pair_share(pair);
    const float sine = sqrtf(fmaxf(0.0f, 1.0f - cosine * cosine));
    float scale[2], drawn[2];
    for (size_t pattern = 0; pattern < 2; ++pattern) {
        drawn[pattern] = (float)pair->drawn_exponent[pattern];
        scale[pattern] = (float)pair->share_count[pattern] * (drawn[pattern] + 1.0f) / (2.0f * AUR_PI_F);
    }
    size_t at = 0;
    for (size_t pattern = 0; pattern < 2; ++pattern) {
        const size_t first = rotation * pair->count[pattern] + share * pair->share_count[pattern];
        for (size_t i = 0; i < pair->share_count[pattern]; ++i, ++at) {
            const float x = pair->direction[pattern][0][first + i],
                        z = pair->direction[pattern][2][first + i];
            const float other = pattern == 0 ? cosine * z - sine * x : cosine * z + sine * x;
            const float normal = pattern == 0 ? z : other, mirror = pattern == 0 ? other : z;
            const float on_normal = normal > 0.0f ? scale[0] * powf(normal, drawn[0]) : 0.0f;
            const float on_mirror = mirror > 0.0f ? scale[1] * powf(mirror, drawn[1]) : 0.0f;
            const float all = on_normal + on_mirror;
            weights[at] = normal > 0.0f ? normal / all : 0.0f;
            weights[samples + at] =
                normal > 0.0f && mirror > 0.0f ? powf(mirror, (float)pair->exponent) / all : 0.0f;
        }
    }
}

static void solve(const aur_gather_pair *pair, size_t rotation, size_t share, float radians, float *weights) {
    const size_t size = pair->count[0] + pair->count[1], samples = aur_gather_pair_share(pair);
    double turns[2], mass = 0.0;
    aur_oswa_turns(pair->seed, rotation, turns);
    double *const found = malloc(2 * size * sizeof *found);
    const bool solved = found != NULL && aur_oswa_solve(pair->oswa, (double)radians, turns, 2 * size, found,
                                                        &mass, NULL) == AUR_OK;
    for (size_t lobe = 0, at = 0; lobe < 2; ++lobe) {
        const double scale = (double)pair->shares * (lobe == 0 ? AUR_PI : mass);
        for (size_t i = 0; i < samples; ++i, ++at) {
            const size_t pattern = i < pair->share_count[0] ? 0 : 1;
            const size_t index = (i - pattern * pair->share_count[0]) * pair->shares + share;
            weights[at] =
                solved ? (float)(scale * found[lobe * size + pattern * pair->count[0] + index]) : NAN;
        }
    }
    free(found);
}

void aur_gather_pair_weights(const aur_gather_pair *pair, size_t rotation, size_t share, float cosine,
                             float *weights) {
    const float inside = cosine > 0.0f ? (cosine < 1.0f ? cosine : 1.0f) : 0.0f;
    switch (pair->method) {
    case AUR_PAIR_OSWA:
        look_up(pair, rotation, share, acosf(inside), weights);
        break;
    case AUR_PAIR_MIS:
        balance(pair, rotation, share, inside, weights);
        break;
    case AUR_PAIR_SOLVE:
        solve(pair, rotation, share, acosf(inside), weights);
        break;
    }
}

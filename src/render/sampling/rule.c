#include "render/sampling/rule.h"

#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "points/pointset/net_2d.h"
#include "points/sphere/map.h"
#include "points/sphere/native.h"

static bool works_on_square(aur_scramble scramble) {
    return scramble == AUR_SCRAMBLE_DIGIT || scramble == AUR_SCRAMBLE_OWEN || scramble == AUR_SCRAMBLE_SHIFT;
}

aur_result aur_gather_rule_options_name(aur_gather_rule_options *options, const char *integrator,
                                        const char *map, const char *scramble, aur_error *error) {
    const aur_set_description *const row = aur_set_find(options->set);
    options->scramble = row != NULL && row->binary_net ? AUR_SCRAMBLE_DIGIT : AUR_SCRAMBLE_ROTATE;
    aur_result result = aur_map_from_name(map, &options->map, error);
    if (result == AUR_OK && scramble != NULL)
        result = aur_scramble_from_name(scramble, &options->scramble, error);
    if (result == AUR_OK && options->scramble == AUR_SCRAMBLE_NESTED)
        result = aur_fail(error, AUR_ERROR_UNSUPPORTED, "%s: patterns take 'owen', not 'nested'", integrator);
    if (result == AUR_OK && options->scramble == AUR_SCRAMBLE_ROTATE3D)
        result =
            aur_fail(error, AUR_ERROR_UNSUPPORTED,
                     "%s: 'rotate3d' would turn the pattern out of its hemisphere; use 'rotate'", integrator);
    return result;
}

/* z -> z^{1/(M+1)} takes the uniform hemisphere to the density ~ cos^M about the axis; the azimuth stays. */
static aur_vector warp(double x, double y, double z, double exponent) {
    const double warped = pow(z, 1.0 / (exponent + 1.0));
    const double radius = sqrt(x * x + y * y);
    const double scale = radius > 0.0 ? sqrt(fmax(0.0, 1.0 - warped * warped)) / radius : 0.0;
    return (aur_vector){(float)(x * scale), (float)(y * scale), (float)warped};
}

/* Computes the directions, and the weights of a set that has them. */
static aur_result find_directions(const aur_gather_rule_options *options, double *xyz, double *weights,
                                  aur_error *error) {
    const size_t count = options->count;
    const aur_directions_options set_options = {.size = sizeof set_options,
                                                .count = count,
                                                .domain = AUR_DOMAIN_HEMISPHERE,
                                                .map = options->map,
                                                .seed = options->set_seed,
                                                .warnings = options->warnings};
    aur_directions *directions = NULL;
    aur_result result = aur_directions_create(options->set, &set_options, &directions, error);
    if (result == AUR_OK && !options->weighted && aur_directions_weighted(directions))
        result =
            aur_fail(error, AUR_ERROR_UNSUPPORTED,
                     "the directions of '%s' by the map '%s' have weights, which are used by finalgather "
                     "with weights=ratio only: the column w, or the map polar, must be left out here",
                     options->set, aur_map_name(options->map));
    if (result == AUR_OK)
        result = aur_directions_points(directions, 0, count, 3 * count, xyz, weights, error);
    aur_directions_destroy(directions);
    return result;
}

/* Points of the square, two coordinates each. */
static aur_result find_square(const aur_gather_rule_options *options, double *points, aur_error *error) {
    const size_t count = options->count;
    const aur_pointset_options set_options = {.size = sizeof set_options,
                                              .count = count,
                                              .dimension = 2,
                                              .seed = options->set_seed,
                                              .warnings = options->warnings};
    if (options->map == AUR_MAP_POLAR)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "the map 'polar' has weights, which patterns scrambled on the square do not use: "
                        "expected scramble=rotate or another map");
    aur_pointset *square = NULL;
    aur_result result = aur_pointset_create(options->set, &set_options, &square, error);
    if (result == AUR_OK)
        result = aur_pointset_points(square, 0, count, 2 * count, points, error);
    aur_pointset_destroy(square);
    return result;
}

static void set_direction(aur_gather_rule *rule, size_t index, aur_vector direction) {
    rule->x[index] = direction.x;
    rule->y[index] = direction.y;
    rule->z[index] = direction.z;
}

/* The words of the square's points, or the directions. */
static aur_result fill(const aur_gather_rule_options *options, aur_gather_rule *rule, aur_error *error) {
    const bool on_square = rule->square != NULL;
    double *const points = malloc(4 * rule->count * sizeof *points), *const weights =
                                                                         points + 3 * rule->count;
    if (points == NULL)
        return aur_fail_memory(error);
    const aur_result result =
        on_square ? find_square(options, points, error) : find_directions(options, points, weights, error);
    for (size_t i = 0; i < rule->count && result == AUR_OK; ++i) {
        const double *const at = points + (on_square ? 2 : 3) * i;
        if (on_square)
            for (size_t k = 0; k < 2; ++k)
                rule->square[i][k] = (uint32_t)(at[k] * 0x1p32);
        else
            set_direction(rule, i, warp((float)at[0], (float)at[1], (float)at[2], rule->drawn_exponent));
        if (!on_square)
            rule->weights[i] = (float)(weights[i] * (double)rule->count);
    }
    free(points);
    return result;
}

static aur_gather_rotation rotation_from_hash(uint64_t hash) {
    const float angle = 2.0f * AUR_PI_F * aur_unit_float((uint32_t)(hash >> 32));
    const uint64_t words = aur_mix64(hash);
    return (aur_gather_rotation){.cosine = cosf(angle),
                                 .sine = sinf(angle),
                                 .word_u = (uint32_t)words,
                                 .word_v = (uint32_t)(words >> 32)};
}

static aur_vector scrambled_direction(const aur_gather_rule *rule, const aur_gather_rotation *rotation,
                                      size_t index) {
    uint32_t u = rule->square[index][0], v = rule->square[index][1];
    switch (rule->scramble) {
    case AUR_SCRAMBLE_DIGIT:
        u ^= rotation->word_u;
        v ^= rotation->word_v;
        break;
    case AUR_SCRAMBLE_OWEN:
        u = aur_owen_scramble(u, rotation->word_u);
        v = aur_owen_scramble(v, rotation->word_v);
        break;
    default:
        u += rotation->word_u;
        v += rotation->word_v;
        break;
    }
    /* The centre of the word's cell: z is not 0, and the pole's azimuth is defined. */
    const double point[2] = {((double)u + 0.5) * 0x1p-32, ((double)v + 0.5) * 0x1p-32};
    double xyz[3];
    aur_point_to_cap(rule->map, AUR_CAP_HEMISPHERE, point, xyz);
    return warp(xyz[0], xyz[1], xyz[2], rule->drawn_exponent);
}

/* The pattern, which the first copy is, shifted in all ways. */
static void prepare_nested(aur_gather_rule *rule) {
    const double exponent = rule->drawn_exponent;
    for (size_t k = AUR_NESTED_COUNT; k-- > 0;) {
        for (size_t i = 0; i < rule->count; ++i) {
            double point[2] = {atan2((double)rule->y[i], (double)rule->x[i]) / (2.0 * AUR_PI),
                               pow((double)rule->z[i], exponent + 1.0)};
            aur_nested_shift(rule->count, k, point);
            const double azimuth = 2.0 * AUR_PI * point[0];
            const double radius = sqrt(1.0 - point[1] * point[1]);
            set_direction(rule, k * rule->count + i,
                          warp(radius * cos(azimuth), radius * sin(azimuth), point[1], exponent));
        }
        rule->rotations[k] = (aur_gather_rotation){.cosine = 1.0f, .first = k * rule->count};
    }
}

/* Rotations are equally spaced on the circle; scramblings are converted to directions in advance. */
static void prepare_rotations(uint64_t seed, aur_gather_rule *rule) {
    for (size_t k = 0; k < rule->rotation_count; ++k) {
        aur_gather_rotation *const rotation = &rule->rotations[k];
        *rotation = rotation_from_hash(aur_hash3(seed, 0x7475726e, k));
        const double angle = 2.0 * AUR_PI * (double)k / (double)rule->rotation_count;
        rotation->cosine = (float)cos(angle);
        rotation->sine = (float)sin(angle);
        if (rule->square == NULL)
            continue;
        for (size_t i = 0; i < rule->count; ++i)
            set_direction(rule, k * rule->count + i, scrambled_direction(rule, rotation, i));
        *rotation = (aur_gather_rotation){.cosine = 1.0f, .first = k * rule->count};
    }
    if (rule->copies == 0)
        return;
    free(rule->square);
    rule->square = NULL;
}

/* Density of the directions: (M'+1)/(2 pi) cos^M'; the analytic factor of the integrand: cos^M. */
float aur_gather_rule_density(const aur_gather_rule *rule, float cosine) {
    const float scale = (float)((rule->drawn_exponent + 1.0) / (2.0 * AUR_PI));
    return cosine > 0.0f ? scale * powf(cosine, (float)rule->drawn_exponent) : 0.0f;
}

static float weight_at(const aur_gather_rule *rule, float z) {
    const double scale = 2.0 * AUR_PI / (rule->drawn_exponent + 1.0);
    const double excess = rule->exponent - rule->drawn_exponent;
    return (float)(excess == 0.0 ? scale : scale * pow((double)z, excess));
}

static aur_result allocate(aur_gather_rule *rule, aur_error *error) {
    const size_t count = rule->copies * rule->count;
    rule->rotations = malloc((rule->rotation_count + 1) * sizeof *rule->rotations);
    if (works_on_square(rule->scramble))
        rule->square = malloc(rule->count * sizeof *rule->square);
    if (count > 0)
        rule->x = malloc(5 * count * sizeof *rule->x);
    if (rule->rotations == NULL || (works_on_square(rule->scramble) && rule->square == NULL) ||
        (count > 0 && rule->x == NULL))
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory for %zu rotations of %zu directions",
                        rule->rotation_count, rule->count);
    if (count == 0)
        return AUR_OK;
    rule->y = rule->x + count;
    rule->z = rule->y + count;
    rule->weights = rule->z + count;
    rule->densities = rule->weights + count;
    return AUR_OK;
}

aur_result aur_gather_rule_create(const aur_gather_rule_options *options, double exponent,
                                  aur_gather_rule *rule, aur_error *error) {
    const double power = options->optimal_density ? 2.0 / (options->smoothness + 1.0) : 1.0;
    *rule = (aur_gather_rule){.count = options->count,
                              .copies = options->nested                      ? AUR_NESTED_COUNT
                                        : works_on_square(options->scramble) ? options->rotations
                                                                             : 1,
                              .exponent = exponent,
                              .drawn_exponent = exponent * power,
                              .map = options->map,
                              .scramble = options->scramble,
                              .nested = options->nested,
                              .rotation_count = options->nested                          ? AUR_NESTED_COUNT
                                                : options->scramble != AUR_SCRAMBLE_NONE ? options->rotations
                                                                                         : 0};
    aur_result result = allocate(rule, error);
    if (result == AUR_OK)
        result = fill(options, rule, error);
    if (result != AUR_OK) {
        aur_gather_rule_release(rule);
        return result;
    }
    const bool on_square = rule->square != NULL; /* which prepared scramblings do away with */
    if (rule->nested)
        prepare_nested(rule);
    else
        prepare_rotations(options->seed, rule);
    for (size_t i = 0; i < rule->copies * rule->count; ++i) {
        const float factor = on_square || rule->nested ? 1.0f : rule->weights[i];
        rule->weights[i] = factor * weight_at(rule, rule->z[i]);
        rule->densities[i] = aur_gather_rule_density(rule, rule->z[i]);
    }
    return AUR_OK;
}

void aur_gather_rule_release(aur_gather_rule *rule) {
    free(rule->x);
    free(rule->square);
    free(rule->rotations);
    *rule = (aur_gather_rule){0};
}

aur_gather_rotation aur_gather_rule_rotation(const aur_gather_rule *rule, uint64_t hash) {
    if (rule->scramble == AUR_SCRAMBLE_NONE)
        return (aur_gather_rotation){.cosine = 1.0f};
    if (rule->rotation_count > 0)
        return rule->rotations[hash % rule->rotation_count];
    return rotation_from_hash(hash);
}

aur_gather_rotation aur_gather_rotation_by(aur_gather_rotation rotation, float cosine, float sine) {
    aur_gather_rotation sum = rotation;
    sum.cosine = rotation.cosine * cosine - rotation.sine * sine;
    sum.sine = rotation.sine * cosine + rotation.cosine * sine;
    return sum;
}

float aur_gather_rule_direction(const aur_gather_rule *rule, const aur_gather_rotation *rotation,
                                size_t index, aur_vector *direction) {
    if (rule->square != NULL) {
        *direction = scrambled_direction(rule, rotation, index);
        return weight_at(rule, direction->z);
    }
    return aur_gather_rule_stored(rule, rotation, index, direction);
}

void aur_gather_rule_square(const aur_gather_rule *rule, const aur_gather_rotation *rotation, size_t index,
                            float point[2]) {
    aur_vector direction;
    aur_gather_rule_direction(rule, rotation, index, &direction);
    const float circles = atan2f(direction.y, direction.x) * (0.5f / AUR_PI_F);
    point[0] = fminf(circles < 0.0f ? circles + 1.0f : circles, 0x1.fffffep-1f);
    /* Rotated directions keep their heights; in the square a shift is equivalent to a rotation. */
    const float shift = rule->square == NULL ? aur_unit_float(rotation->word_v) : 0.0f;
    const float height = fmaxf(1.0f - direction.z, 0.0f) + shift;
    point[1] = fminf(height < 1.0f ? height : height - 1.0f, 0x1.fffffep-1f);
}

size_t aur_gather_part_stride(size_t parts) {
    for (size_t stride = (size_t)(0.6180339887 * (double)parts);; ++stride) {
        size_t a = parts, b = stride;
        while (b != 0) {
            const size_t rest = a % b;
            a = b;
            b = rest;
        }
        if (a == 1)
            return stride;
    }
}

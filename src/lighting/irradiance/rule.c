#include "lighting/irradiance/sensor_trace.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/sphere/native.h"

static aur_result fill(const char *set, const aur_directions_options *options, double *xyz,
                       aur_sensor_rule *rule, aur_error *error) {
    aur_directions *directions = NULL;
    aur_result result = aur_directions_create(set, options, &directions, error);
    if (result == AUR_OK && aur_directions_weighted(directions))
        result = aur_fail(error, AUR_ERROR_UNSUPPORTED,
                          "the directions of '%s' have weights, which sensors do not use: a file must be "
                          "without the column w",
                          set);
    if (result == AUR_OK)
        result = aur_directions_points(directions, 0, rule->count, 3 * rule->count, xyz, NULL, error);
    aur_directions_destroy(directions);
    for (size_t i = 0; i < rule->count && result == AUR_OK; ++i) {
        const double *const at = xyz + 3 * i;
        const double radius = hypot(at[0], at[1]);
        /* For uniform directions in the hemisphere, the heights are uniform. */
        rule->heights[i] = fminf((float)(1.0 - at[2]), 0x1.fffffep-1f);
        rule->cosines[i] = radius > 0.0 ? (float)(at[0] / radius) : 1.0f;
        rule->sines[i] = radius > 0.0 ? (float)(at[1] / radius) : 0.0f;
    }
    return result;
}

aur_result aur_sensor_rule_create(const char *set, size_t count, uint64_t seed, const aur_warnings *warnings,
                                  aur_sensor_rule *rule, aur_error *error) {
    *rule = (aur_sensor_rule){.count = count};
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, AUR_DOMAIN_HEMISPHERE, &options, NULL);
    options.seed = seed;
    options.warnings = *warnings;
    double *const xyz = malloc(3 * count * sizeof *xyz);
    rule->heights = malloc(3 * count * sizeof *rule->heights);
    aur_result result = AUR_OK;
    if (xyz == NULL || rule->heights == NULL) {
        result = aur_fail_memory(error);
    } else {
        rule->cosines = rule->heights + count;
        rule->sines = rule->cosines + count;
        result = fill(set, &options, xyz, rule, error);
    }
    free(xyz);
    if (result != AUR_OK)
        aur_sensor_rule_release(rule);
    return result;
}

void aur_sensor_rule_release(aur_sensor_rule *rule) {
    free(rule->heights);
    *rule = (aur_sensor_rule){0};
}

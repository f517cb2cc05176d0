/* The directions of sensors, as points of a torus: the azimuth, and the squared sine of the polar angle, in
 * which the cosine distribution is uniform. Shifted there at random (Cranley and Patterson 1976) each point
 * is uniform, so that means have no bias, and spherical Fibonacci points keep their distances. */
#pragma once

#include <aureole/sphere.h>

typedef struct aur_sensor_rule {
    size_t count;
    float *heights;         /* squared sines, in [0,1) */
    float *cosines, *sines; /* of the azimuth */
} aur_sensor_rule;

/* `count` directions of `set`. Errors: as aur_directions_create. */
aur_result aur_sensor_rule_create(const char *set, size_t count, uint64_t seed, const aur_warnings *warnings,
                                  aur_sensor_rule *rule, aur_error *error);
void aur_sensor_rule_release(aur_sensor_rule *rule);

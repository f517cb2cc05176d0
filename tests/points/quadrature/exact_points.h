/* Directions of a set by name, for tests of exact weights. */
#pragma once

#include <aureole/sphere.h>
#include <stdlib.h>

#include "check.h"

static double *points_of(const char *set, size_t count, aur_domain domain, double exponent, double cap) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(count, domain, &options, NULL);
    options.lobe.exponent = exponent;
    options.cap_degrees = cap;
    aur_directions *directions;
    aur_error error;
    double *const xyz = malloc(3 * count * sizeof *xyz);
    assert_non_null(xyz);
    assert_int_equal(aur_directions_create(set, &options, &directions, &error), AUR_OK);
    assert_int_equal(aur_directions_points(directions, 0, count, 3 * count, xyz, NULL, &error), AUR_OK);
    aur_directions_destroy(directions);
    return xyz;
}

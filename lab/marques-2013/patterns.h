/* The patterns that Marques 2013 compares: spherical Fibonacci points, and three sets of the square under two
 * maps. */
#ifndef LAB_MARQUES_2013_PATTERNS_H
#define LAB_MARQUES_2013_PATTERNS_H

#include <aureole/sphere.h>

#include "program/lab/lab.h"

enum { MARQUES_PATTERNS = 9 };

typedef struct marques_pattern {
    const char *set;
    const char *label; /* of the map, as in the figures: "lambert", "concentric", "-" if none */
    aur_map map;
    aur_scramble scramble; /* as in the paper: digit scrambling for nets, a rotation for the others */
} marques_pattern;

/* Spherical Fibonacci, then the other sets under both maps, and the set of --set. Returns the number of
 * patterns. */
size_t marques_patterns(const lab_run *run, marques_pattern patterns[MARQUES_PATTERNS]);

/* The points of a pattern on a domain (the square: before it is mapped). Free with aur_points_destroy. */
aur_result marques_points(const marques_pattern *pattern, aur_domain domain, size_t count, uint64_t seed,
                          aur_points **points, aur_error *error);

#endif

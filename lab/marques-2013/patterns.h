/* The patterns that Marques 2013 compares: spherical Fibonacci points, and three sets of the square by two
 * maps. */
#ifndef LAB_MARQUES_2013_PATTERNS_H
#define LAB_MARQUES_2013_PATTERNS_H

#include <aureole/sphere.h>

#include "program/lab/lab.h"

enum { MARQUES_PATTERNS = 9 };

typedef struct marques_pattern {
    const char *set;
    const char *label; /* of the map, as in the figures: "lambert", "concentric", "-" where there is none */
    aur_map map;
    aur_scramble scramble; /* as in the paper: of digits for nets, a turn for the others */
} marques_pattern;

/* Spherical Fibonacci, then the rivals by either map, and the set of --set. Returns how many there are. */
size_t marques_patterns(const lab_run *run, marques_pattern patterns[MARQUES_PATTERNS]);

/* The points of a pattern on a domain (the square: before it is mapped). Free with aur_points_destroy. */
aur_result marques_points(const marques_pattern *pattern, aur_domain domain, size_t count, uint64_t seed,
                          aur_points **points, aur_error *error);

#endif

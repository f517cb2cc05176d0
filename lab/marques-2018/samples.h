/* Shared by the experiments on weights: samples, densities and lights. */
#ifndef LAB_MARQUES_2018_SAMPLES_H
#define LAB_MARQUES_2018_SAMPLES_H

#include <aureole/quadrature.h>

#include "program/lab/lab.h"

typedef struct lab_samples {
    const char *set;
    size_t count;
    double exponent; /* of the cos^m lobe that they are distributed by */
    bool optimal_density;
    uint64_t seed; /* of random sets and of the scrambling */
} lab_samples;

/* Digit scrambling for sets of the square that support it, else a shift (lattices, files of the square), a
 * rotation for directions, none for random points. */
aur_scramble lab_scrambling(const char *set);

/* Directions into xyz[3 * count] and weights[count] (or NULL). */
aur_result lab_draw(const lab_samples *requested, double *xyz, double *weights, aur_error *error);

/* The potential of a cos^m lobe about +z. */
aur_result lab_lobe_potential(double exponent, double smoothness, aur_potential **potential,
                              aur_error *error);

enum { LAB_LIGHT_PARTS = 6 };

/* A sum of six spherical Gaussians of sharpness 2 to 60, in any directions, plus 0.3; or six disks of the
 * same widths with hard edges. */
typedef struct lab_light {
    double axis[LAB_LIGHT_PARTS][3], sharpness[LAB_LIGHT_PARTS], height[LAB_LIGHT_PARTS];
    bool hard;
} lab_light;

lab_light lab_random_light(uint64_t seed, bool hard);
/* Sets light from below the surface to 0. */
double lab_radiance(const lab_light *light, const double direction[3]);

#endif

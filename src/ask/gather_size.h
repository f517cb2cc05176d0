/* How large final gathering is to be that comes to an error in one pattern, as pilots of few pixels tell. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What final gathering is told: photons of the map that all replicas share, the seed of these, directions of
 * a pattern for diffuse light, and the pattern's points on lights and on bright texels. */
typedef struct aur_gather_size {
    size_t photons;
    uint64_t seed;
    size_t directions, lights, bright;
} aur_gather_size;

/* Directions and points on lights of the pilots' patterns, of which the second one has more, and the third
 * one as many and points on bright texels. The map's photons: its noise hardly hangs on them, and texels are
 * so wide that most of its rays would be short. */
enum {
    AUR_PILOT_DIRECTIONS = 4,
    AUR_PILOT_LIGHTS = 1,
    AUR_PILOT_LIGHTS_MORE = 8,
    AUR_PILOT_BRIGHT = 1,
    AUR_PILOT_PHOTONS = 15000
};

/* What a pilot has come to: its error over the mean, and rays a pixel. */
typedef struct aur_pilot_outcome {
    double error, rays;
} aur_pilot_outcome;

/* A pattern of AUR_PILOT_DIRECTIONS with so many points on lights, and on bright texels, as are best. */
typedef struct aur_gather_pattern {
    double lights, bright, error;
    double fixed, growing; /* rays a pixel, the lights' at their price: whatever its size, and as it */
} aur_gather_pattern;

/* From pilots with AUR_PILOT_LIGHTS and AUR_PILOT_LIGHTS_MORE points on lights. */
aur_gather_pattern aur_gather_pattern_of(aur_pilot_outcome few, aur_pilot_outcome more);
/* The same where a third pilot says whether points on bright texels pay. */
aur_gather_pattern aur_gather_pattern_best(aur_pilot_outcome few, aur_pilot_outcome more,
                                           aur_pilot_outcome bright);

/* Rays of a pixel, all replicas together, and the size of the pattern, by which noise and a bias whose square
 * is told come to the error wanted. */
double aur_gather_rays(const aur_gather_pattern *pattern, double wanted, double square_bias);
aur_gather_size aur_gather_size_of(const aur_gather_pattern *pattern, double wanted, double square_bias,
                                   size_t photons, uint64_t seed);
/* Photons of a map that costs little beside a picture of so many rays, or that is small: what is wrong in a
 * smaller one is seen in small pictures, as it is alike in neighbours. */
enum { AUR_LEAST_PHOTONS = 125000 };
size_t aur_gather_photons(double rays);
/* The rays that so many photons are worth. */
double aur_photon_rays(double photons);

/* Whether a pattern is one sample's, and shared with the neighbouring pixels. */
bool aur_gather_is_shared(size_t directions);

/* Final gathering in place of "path[:key=value...]", with these keys. A new text, or NULL where memory is
 * short: */
/* for a picture, */
char *aur_ask_gather(const char *path, aur_gather_size size);
/* for a pilot, */
char *aur_ask_gather_pilot(const char *path, uint64_t seed, size_t lights, size_t bright);
/* and for what its map is wrong by. */
char *aur_ask_gather_difference(const char *path, size_t photons, uint64_t seed);

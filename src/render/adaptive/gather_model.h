/* What final gathering's error and rays follow, as pilots of few pixels and small patterns tell. */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Directions and points of the pilots' patterns: one has few points on lights, and others have more. The
 * map's photons: its noise hardly hangs on them, and texels are so wide that most of its rays would be short.
 */
enum {
    AUR_PILOT_DIRECTIONS = 4,
    AUR_PILOT_LIGHTS = 1,
    AUR_PILOT_LIGHTS_MORE = 8,
    AUR_PILOT_LIGHTS_MOST = 32,
    AUR_PILOT_BRIGHT = 1,
    AUR_PILOT_PHOTONS = 15000
};

/* What a pilot has come to: its error over the mean, and rays a pixel. 0 where there was none. */
typedef struct aur_pilot_outcome {
    double error, rays;
} aur_pilot_outcome;

/* The pilots in the order in which they are rendered: by the points on lights that they have, of which there
 * are AUR_PILOT_LIGHTS, _MORE and _MOST; and with as many as the last of these, one whose camera rays go
 * through the centres of pixels, and one with points on bright texels. The first one is always there. */
enum { AUR_PILOT_FEW, AUR_PILOT_MORE, AUR_PILOT_MOST, AUR_PILOT_CENTRE, AUR_PILOT_DRAWN, AUR_PILOT_KINDS };
typedef struct aur_gather_pilots {
    aur_pilot_outcome of[AUR_PILOT_KINDS];
    double side; /* of the pilots' pixels over that of the picture's */
    bool alone;  /* few pixels need more samples than all others, and whole tiles are not to get them */
} aur_gather_pilots;

/* Of the pilots that differ by their points on lights, the last one that is there. */
size_t aur_gather_last_pilot(const aur_gather_pilots *pilots);

/* Squares of the error that one pattern of each replica leaves, and its rays a pixel, all replicas together.
 */
typedef struct aur_gather_model {
    double gather; /* of AUR_PILOT_DIRECTIONS: falls as directions^-power */
    double power;
    double lights[3]; /* of the three numbers of points on lights */
    double camera;    /* of where a camera ray is in its pixel: falls with the number of these alone */
    double bright;    /* points on bright texels a direction */
    double fixed, direction, light; /* rays whatever the pattern, of a direction, and what a point costs */
    bool alone;                     /* no pattern is shared */
} aur_gather_model;

aur_gather_model aur_gather_model_of(const aur_gather_pilots *pilots);

/* Of so many points on lights. */
double aur_gather_model_lights(const aur_gather_model *model, double lights);

/* The pattern that comes to the square `noise` at least rays, of `samples` camera rays a replica and with
 * `factor` times the directions. What camera rays leave counts up to the part `most_camera` of the noise:
 * more of it takes more samples, whatever the pattern. */
typedef struct aur_gather_target {
    double noise, samples, factor, most_camera;
} aur_gather_target;
typedef struct aur_gather_pattern {
    double directions, lights, rays;
} aur_gather_pattern;
aur_gather_pattern aur_gather_model_pattern(const aur_gather_model *model, const aur_gather_target *target);

/* A sky above the horizon and one radiance below it: directions drawn in proportion to how bright they are.
 * Directions are by east, north and up, of unit length. */
#pragma once

#include <stdbool.h>

#include "render/scene/patches.h"

enum { AUR_DOME_COLUMNS = 96 };

typedef struct aur_sky_dome {
    aur_patches patches;
    float (*corners)[AUR_DOME_COLUMNS]; /* the luminance at the corners of patches */
    float below;                        /* the ground's */
    bool round;                         /* each row of patches is equally bright */
} aur_sky_dome;

typedef float aur_dome_luminance(const void *sky, const double direction[3]);

/* Errors: MEMORY; it is to be released then too. */
aur_result aur_sky_dome_create(aur_sky_dome *dome, aur_dome_luminance *luminance, const void *sky,
                               float below, aur_error *error);
void aur_sky_dome_release(aur_sky_dome *dome);

/* The density, a steradian, with which a direction is drawn from u and v in [0,1). */
float aur_sky_dome_pdf(const aur_sky_dome *dome, const double direction[3]);
void aur_sky_dome_draw(const aur_sky_dome *dome, float u, float v, double direction[3]);

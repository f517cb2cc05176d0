/* A sky above the horizon and constant radiance below it: samples directions in proportion to luminance.
 * Directions are unit vectors (east, north, up). */
#pragma once

#include <stdbool.h>

#include "render/scene/patches.h"

enum { AUR_DOME_COLUMNS = 96 };

typedef struct aur_sky_dome {
    aur_patches patches;
    float (*corners)[AUR_DOME_COLUMNS]; /* luminance at the corners of patches */
    float below;                        /* luminance of the ground */
    bool round;                         /* all rows of patches have equal brightness */
} aur_sky_dome;

typedef float aur_dome_luminance(const void *sky, const double direction[3]);

/* Errors: MEMORY; it must be released then too. */
aur_result aur_sky_dome_create(aur_sky_dome *dome, aur_dome_luminance *luminance, const void *sky,
                               float below, aur_error *error);
void aur_sky_dome_release(aur_sky_dome *dome);

/* The pdf by solid angle of a direction sampled from u and v in [0,1). */
float aur_sky_dome_pdf(const aur_sky_dome *dome, const double direction[3]);
void aur_sky_dome_draw(const aur_sky_dome *dome, float u, float v, double direction[3]);

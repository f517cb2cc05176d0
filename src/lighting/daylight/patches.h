/* Patches of the sky: the 145 of Tregenza (1987), Lighting Research and Technology 19(1), 13-14, each cut
 * into M x M by Reinhart (2001), with one round patch about the zenith. Patch 0 is the ground; the others go
 * from the horizon up, in each row clockwise from the one whose middle is in the north. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "render/scene/lights/sky_model.h"

enum { AUR_SKY_SUBDIVISION_MAX = 6, AUR_SKY_ROWS_MAX = 7 * AUR_SKY_SUBDIVISION_MAX + 1 };

typedef struct aur_sky_patches {
    size_t subdivision, row_count, count;
    double step;                        /* radians of height of a row, but for the patch at the zenith */
    size_t first[AUR_SKY_ROWS_MAX + 1]; /* patch of each row */
    size_t up, around;                  /* pieces of a patch, from the horizon to the zenith and along it */
    size_t around_zenith;               /* along it of the one at the zenith */
    double (*middles)[3]; /* of all pieces, unit: row by row, piece of a height by piece, all around */
} aur_sky_patches;

/* `subdivision` is M, 1 to AUR_SKY_SUBDIVISION_MAX. */
aur_result aur_sky_patches_create(size_t subdivision, aur_sky_patches *patches, aur_error *error);
void aur_sky_patches_release(aur_sky_patches *patches);

/* The patch of a direction, by east, north and up, of unit length. */
size_t aur_sky_patches_find(const aur_sky_patches *patches, const double direction[3]);

/* Its solid angle; and the integral of the cosine with the zenith over it, 0 for the ground. */
double aur_sky_patch_angle(const aur_sky_patches *patches, size_t patch);
double aur_sky_patch_cosine(const aur_sky_patches *patches, size_t patch);

/* radiance[count]: the mean of the model over each patch, times what makes `diffuse` the sky's irradiance on
 * the horizontal plane; 0 for the ground. False where the model has no light anywhere. */
bool aur_sky_patches_fill(const aur_sky_patches *patches, const aur_sky_model *sky, double diffuse,
                          double *radiance);

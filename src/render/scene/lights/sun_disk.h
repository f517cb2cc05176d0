/* A disk of the sky: directions within an angle of its centre. */
#pragma once

#include <stdbool.h>

#include "points/base/vector.h"

typedef struct aur_sun_disk {
    double center[3];     /* unit, in the world */
    aur_vector across[2]; /* orthonormal to it */
    double rise;          /* 1 - cosine of its half angle */
    double reach;         /* the squared distance between its centre and its edge on the unit sphere */
} aur_sun_disk;

/* `half_angle` in degrees, above 0 and at most 180. */
aur_sun_disk aur_sun_disk_make(const double center[3], double half_angle);
bool aur_sun_disk_contains(const aur_sun_disk *disk, aur_vector direction);
/* Steradians. */
double aur_sun_disk_solid_angle(const aur_sun_disk *disk);
/* A direction in the disk, uniform by solid angle; u and v in [0,1). */
aur_vector aur_sun_disk_draw(const aur_sun_disk *disk, float u, float v);

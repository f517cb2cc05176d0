#include "render/scene/lights/sun_disk.h"

#include <math.h>

#include "points/base/vector3d.h"

aur_sun_disk aur_sun_disk_make(const double center[3], double half_angle) {
    const double half = sin(0.5 * half_angle * AUR_PI / 180.0);
    /* Slightly more than the edge, so that sampled directions are inside in spite of rounding. */
    aur_sun_disk disk = {.center = {center[0], center[1], center[2]},
                         .rise = 2.0 * half * half,
                         .reach = 4.0 * half * half + 5e-7 * half};
    double x[3], y[3];
    aur_frame3(disk.center, x, y);
    disk.across[0] = (aur_vector){(float)x[0], (float)x[1], (float)x[2]};
    disk.across[1] = (aur_vector){(float)y[0], (float)y[1], (float)y[2]};
    return disk;
}

bool aur_sun_disk_contains(const aur_sun_disk *disk, aur_vector direction) {
    const double way[3] = {(double)direction.x - disk->center[0], (double)direction.y - disk->center[1],
                           (double)direction.z - disk->center[2]};
    return aur_dot3(way, way) <= disk->reach;
}

double aur_sun_disk_solid_angle(const aur_sun_disk *disk) {
    return 2.0 * AUR_PI * disk->rise;
}

/* 1 - cosine is u times its value at the edge. */
aur_vector aur_sun_disk_draw(const aur_sun_disk *disk, float u, float v) {
    const double low = (double)u * disk->rise;
    const float radius = (float)sqrt(fmax(low * (2.0 - low), 0.0)), azimuth = 2.0f * AUR_PI_F * v;
    const aur_vector middle = {(float)((1.0 - low) * disk->center[0]), (float)((1.0 - low) * disk->center[1]),
                               (float)((1.0 - low) * disk->center[2])};
    return aur_vector_add_scaled(aur_vector_add_scaled(middle, radius * cosf(azimuth), disk->across[0]),
                                 radius * sinf(azimuth), disk->across[1]);
}

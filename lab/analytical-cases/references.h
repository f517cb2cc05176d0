/* Reference irradiances, each by two derivations that share no formula. A receiver is a point with a unit
 * normal; radiances are 1 unless stated otherwise. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

static const double LAB_PI = 3.14159265358979323846;

typedef struct lab_receiver {
    double position[3], normal[3];
} lab_receiver;

/* A parallelogram: corner + s a + t b, 0 <= s, t <= 1. Completely in front of the receiver. */
typedef struct lab_patch {
    double corner[3], a[3], b[3];
} lab_patch;

/* The double integral of f by the double exponential rule (Takahasi and Mori 1974). */
typedef double lab_function(const void *data, double x, double y);
double lab_integrate(lab_function *function, const void *data, const double x[2], const double y[2]);

/* Irradiance by a patch: by its edges (Lambert 1760), and by the integral over its area. `radiance` is a
 * function of the unit direction from the receiver to the patch; NULL: 1. */
double lab_patch_closed(const lab_receiver *receiver, const lab_patch *patch);
typedef double lab_radiance(const void *data, const double direction[3]);
double lab_patch_smooth(const lab_receiver *receiver, const lab_patch *patch, lab_radiance *radiance,
                        const void *data);

/* A disk parallel to the receiver's plane at a height above it and a lateral distance: closed form (Howell's
 * catalogue, B-13), and integral over the area. */
double lab_disk_closed(double radius, double height, double aside);
double lab_disk_smooth(double radius, double height, double aside);
/* A horizontal disk below a receiver with a horizontal normal, at a height above the disk's centre. */
double lab_disk_sideways_closed(double radius, double height);
double lab_disk_sideways_smooth(double radius, double height);

/* The irradiance of a horizontal receiver through a vertical opening at a distance, from a sky of radiance (1
 * + 2 sin of the elevation)/3. The opening spans heights h[0] to h[1] above the receiver, and w[0] to w[1]
 * sideways. */
double lab_opening_overcast(double distance, const double w[2], const double h[2]);
/* The same for any radiance, by integration over azimuth and elevation. */
double lab_opening_by_angles(double distance, const double w[2], const double h[2], lab_radiance *radiance,
                             const void *data);

/* The transmittance of a thin pane, from its refractive index, its internal transmittance at normal
 * incidence, and the cosine of the incident angle: closed form, and series over internal reflections. */
double lab_pane_closed(double index, double transmissivity, double cosine);
double lab_pane_series(double index, double transmissivity, double cosine);

/* A CIE general sky (ISO 15469) by its formula, not normalised, with the sun in the plane of +x and +z. */
typedef struct lab_sky {
    double a, b, c, d, e, sun[3];
} lab_sky;

lab_sky lab_sky_of(size_t type, double elevation_degrees);
/* Irradiance of a receiver that faces up (+z) or horizontally: by angles about the zenith, and about a
 * horizontal axis. */
double lab_sky_about_zenith(const lab_sky *sky, const double normal[3]);
double lab_sky_about_horizontal(const lab_sky *sky, const double normal[3]);

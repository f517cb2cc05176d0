/* Irradiances from physics, each in two ways that share no formula. A receiver is a point with a normal of
 * unit length; radiances are 1 unless said. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

static const double LAB_PI = 3.14159265358979323846;

typedef struct lab_receiver {
    double position[3], normal[3];
} lab_receiver;

/* A parallelogram: corner + s a + t b, 0 <= s, t <= 1. Wholly in front of the receiver. */
typedef struct lab_patch {
    double corner[3], a[3], b[3];
} lab_patch;

/* The double integral of f by the double exponential rule (Takahasi and Mori 1974). */
typedef double lab_function(const void *data, double x, double y);
double lab_integrate(lab_function *function, const void *data, const double x[2], const double y[2]);

/* Light of a patch: along its edges (Lambert 1760), and by the integral over its area. `radiance` of the
 * unit direction from the receiver to the patch; NULL: 1. */
double lab_patch_closed(const lab_receiver *receiver, const lab_patch *patch);
typedef double lab_radiance(const void *data, const double direction[3]);
double lab_patch_smooth(const lab_receiver *receiver, const lab_patch *patch, lab_radiance *radiance,
                        const void *data);

/* A disk of a radius at a height above the receiver's plane, facing it, at a distance aside: closed (Howell's
 * catalogue, B-13), and by area. */
double lab_disk_closed(double radius, double height, double aside);
double lab_disk_smooth(double radius, double height, double aside);
/* A disk in a horizontal plane below a receiver that looks sideways, at a height above its centre. */
double lab_disk_sideways_closed(double radius, double height);
double lab_disk_sideways_smooth(double radius, double height);

/* What a horizontal receiver at a distance from a vertical opening gets through it of a sky of radiance
 * (1 + 2 sin of the elevation)/3: the opening reaches over heights h[0] to h[1] above the receiver, and
 * sideways from w[0] to w[1]. */
double lab_opening_overcast(double distance, const double w[2], const double h[2]);
/* The same by azimuth and elevation, of any radiance. */
double lab_opening_by_angles(double distance, const double w[2], const double h[2], lab_radiance *radiance,
                             const void *data);

/* What a thin pane lets through, of an index and the transmissivity straight through its inside, at the
 * cosine of the angle to its normal: the closed form, and the series of ways to and fro. */
double lab_pane_closed(double index, double transmissivity, double cosine);
double lab_pane_series(double index, double transmissivity, double cosine);

/* A CIE general sky (ISO 15469), relative to nothing: its formula, for the sun in the plane of +x and +z. */
typedef struct lab_sky {
    double a, b, c, d, e, sun[3];
} lab_sky;

lab_sky lab_sky_of(size_t type, double elevation_degrees);
/* Irradiance of a receiver that looks up (+z) or along a horizontal direction: by angles about the zenith,
 * and about a horizontal axis. */
double lab_sky_about_zenith(const lab_sky *sky, const double normal[3]);
double lab_sky_about_horizontal(const lab_sky *sky, const double normal[3]);

/* Photometric data: luminous intensity by direction, from IESNA LM-63 (1986 to 2019) and EULUMDAT files. */
#pragma once

#include <stdbool.h>

#include "points/base/error.h"

typedef enum aur_photometric_type {
    AUR_PHOTOMETRIC_C = 1,
    AUR_PHOTOMETRIC_B,
    AUR_PHOTOMETRIC_A
} aur_photometric_type;

/* A table over two angles in degrees, interpolated linearly. Type C: `plane` is C about the luminaire's axis,
 * 0 to 360; `angle` is gamma, 0 at nadir. Types B and A: horizontal and vertical, -90 to 90 each. */
typedef struct aur_photometry {
    aur_photometric_type type;
    bool ies; /* LM-63; false: EULUMDAT */
    size_t plane_count, angle_count;
    double *planes, *angles; /* ascending; one allocation for both arrays and the table */
    float *candela;          /* [plane_count][angle_count], with all factors of the file applied */
    double
        lumens; /* luminous flux of the lamps, as stated in the file; 0: unspecified (absolute photometry) */
    double width, length, height; /* size of the luminous opening in metres, along y, x and z; 0: a point */
    bool round;                   /* ellipse instead of rectangle */
} aur_photometry;

/* Reads either format, identified by content. Errors: OPEN, MEMORY, FORMAT with the line. */
aur_result aur_photometry_read(const char *path, aur_photometry *photometry, aur_error *error);
/* The same from memory; `path` is for messages. */
aur_result aur_photometry_parse(const char *path, size_t size, const char *data, aur_photometry *photometry,
                                aur_error *error);
void aur_photometry_release(aur_photometry *photometry);
/* Candela in a direction of the luminaire's frame, of any length but 0: -z is nadir (gamma 0), +x is C 0, +y
 * is C 90. */
double aur_photometry_intensity(const aur_photometry *photometry, const double direction[3]);
/* The luminous flux, integrated over all directions: exact for type C, else by 256 x 256 midpoints. */
double aur_photometry_flux(const aur_photometry *photometry);

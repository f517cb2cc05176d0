/* Measured lamps: luminous intensities by direction, from IESNA LM-63 (1986 to 2019) and EULUMDAT files. */
#pragma once

#include <stdbool.h>

#include "points/base/error.h"

typedef enum aur_photometric_type {
    AUR_PHOTOMETRIC_C = 1,
    AUR_PHOTOMETRIC_B,
    AUR_PHOTOMETRIC_A
} aur_photometric_type;

/* A table by two angles in degrees, linear between. Type C: `plane` is C about the lamp's axis, from 0 to
 * 360, and `angle` gamma from straight down. Types B and A: -90 to 90 each, horizontal and vertical. */
typedef struct aur_photometry {
    aur_photometric_type type;
    size_t plane_count, angle_count;
    double *planes, *angles;      /* one allocation with the table; ascending */
    float *candela;               /* [plane_count][angle_count], all factors of the file multiplied in */
    double lumens;                /* of the lamps, as the file states; 0: unknown (absolute photometry) */
    double width, length, height; /* of the luminous opening in metres, along y, x and z; 0: a point */
    bool round;                   /* an ellipse, not a rectangle */
} aur_photometry;

/* Reads either kind, told by its content. Errors: OPEN, MEMORY, FORMAT with the line. */
aur_result aur_photometry_read(const char *path, aur_photometry *lamp, aur_error *error);
/* The same from memory; `path` is for messages. */
aur_result aur_photometry_parse(const char *path, size_t size, const char *data, aur_photometry *lamp,
                                aur_error *error);
void aur_photometry_release(aur_photometry *lamp);
/* Candela in a direction of the lamp's frame, of any length but 0: -z is down (gamma 0), +x is C 0, +y C 90.
 */
double aur_photometry_intensity(const aur_photometry *lamp, const double direction[3]);
/* The integral over all directions: exact for type C, else by 256 x 256 midpoints. */
double aur_photometry_flux(const aur_photometry *lamp);

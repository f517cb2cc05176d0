/* Spectra become linear sRGB colours while a scene is read, by the rules of Mitsuba 3's RGB mode, so that
 * both programs see the same colours (Mitsuba 3.9, src/core/spectrum.cpp):
 *
 * - what reflects or refracts is seen under D65, and a spectrum of ones is .99889 in all channels within 1e-4
 *   (Mitsuba's constant for D65 is .11 % larger than the ratio of the integrals);
 * - what emits is integrated as it is, so a spectrum of ones is the illuminant E, (1.205, .948, .909), of
 *   luminance 1;
 * - negative channels become 0, and reflectances above 1 become 1. */
#pragma once

#include "points/base/keys.h"

typedef enum aur_spectrum_use {
    AUR_SPECTRUM_REFLECTS, /* between 0 and 1 */
    AUR_SPECTRUM_REFRACTS, /* a refractive index or extinction: at least 0 */
    AUR_SPECTRUM_EMITS,
} aur_spectrum_use;

/* The colour, before clamping, of a spectrum that is linear between `count` >= 2 samples at increasing
 * wavelengths in nanometres, and 0 outside. Errors: FORMAT, with the position, for invalid samples. */
aur_result aur_spectrum_to_rgb(size_t count, const double *wavelengths, const double *values,
                               aur_location location, aur_spectrum_use use, double rgb[3], aur_error *error);

/* The colour of an emitter with a constant spectrum. */
void aur_spectrum_equal_energy(double value, double rgb[3]);

/* Clamps a colour to the range of its use; returns whether that changed it. */
bool aur_spectrum_clamp(aur_spectrum_use use, double rgb[3]);

/* The same from "400:0.1, 500:0.3, ..." */
aur_result aur_spectrum_parse(const char *text, aur_location location, aur_spectrum_use use, double rgb[3],
                              aur_error *error);
/* From a file with one wavelength and value per line; # begins a comment. */
aur_result aur_spectrum_read(const char *path, aur_location location, aur_spectrum_use use, double rgb[3],
                             aur_error *error);

/* Spectra with a type, such as <spectrum type="blackbody">. */
extern const aur_table aur_spectrum_table;
/* The colour of the spectrum that parameters->plugin names. */
aur_result aur_spectrum_create(aur_parameters *parameters, aur_spectrum_use use, double rgb[3],
                               aur_error *error);

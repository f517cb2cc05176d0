/* Between radiance and what a screen is sent. */
#pragma once

#include <aureole-render/image.h>

#include "points/base/internal.h"

/* The sRGB transfer function (IEC 61966-2-1) and its inverse; arguments and values in [0,1], arguments beyond
 * it are clamped, NaN is 0. */
AUR_INTERNAL double aur_srgb_encode(double linear);
double aur_srgb_decode(double encoded);

/* Radiance to [0,1] in linear light by a curve. */
double aur_tone_apply(aur_tone tone, double radiance);

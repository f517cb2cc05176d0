/* Sampling of directions, shared by materials and lights. Local frame, z up. */
#pragma once

#include "points/base/vector.h"

/* Cosine and sine of pi/4 t for t in [-1,1], by series: to 2 units in the last place, and bit-identical
 * everywhere. */
static inline void aur_eighth_turn(float t, float *cosine, float *sine) {
    const float x = AUR_PI_F / 4.0f * t, r = x * x;
    *sine = x + x * r * (((2.7557319e-6f * r - 1.9841270e-4f) * r + 8.3333333e-3f) * r - 0.16666667f);
    *cosine = 1.0f + r * (((2.4801587e-5f * r - 1.3888889e-3f) * r + 4.1666667e-2f) * r - 0.5f);
}

/* The unit disk by Shirley and Chiu's concentric map (1997), which is continuous and preserves
 * stratification. */
static inline void aur_sample_disk(float u, float v, float *x, float *y) {
    const float a = 2.0f * u - 1.0f;
    const float b = 2.0f * v - 1.0f;
    if (a == 0.0f && b == 0.0f) {
        *x = *y = 0.0f;
        return;
    }
    const int wide = fabsf(a) > fabsf(b);
    const float radius = wide ? a : b;
    float cosine, sine;
    aur_eighth_turn(wide ? b / a : a / b, &cosine, &sine);
    *x = radius * (wide ? cosine : sine);
    *y = radius * (wide ? sine : cosine);
}

/* Density cos / pi on the upper hemisphere. */
static inline aur_vector aur_sample_cosine(float u, float v) {
    float x, y;
    aur_sample_disk(u, v, &x, &y);
    return (aur_vector){x, y, sqrtf(aur_larger(1.0f - x * x - y * y, 0.0f))};
}

/* The direction with cosine z and azimuth 2 pi v. */
static inline aur_vector aur_direction_at(float z, float v) {
    const float radius = sqrtf(aur_larger(1.0f - z * z, 0.0f));
    const float angle = 2.0f * AUR_PI_F * v;
    return (aur_vector){radius * cosf(angle), radius * sinf(angle), z};
}

/* Density 1 / (4 pi). */
static inline aur_vector aur_sample_sphere(float u, float v) {
    return aur_direction_at(1.0f - 2.0f * u, v);
}

/* Density aur_cosine_power_pdf about +z. */
static inline aur_vector aur_sample_cosine_power(float u, float v, float exponent) {
    return aur_direction_at(powf(1.0f - u, 1.0f / (exponent + 1.0f)), v);
}

/* (m + 1) / (2 pi) cos^m; 0 behind. */
static inline float aur_cosine_power_pdf(float cosine, float exponent) {
    return cosine > 0.0f ? (exponent + 1.0f) / (2.0f * AUR_PI_F) * powf(cosine, exponent) : 0.0f;
}

/* A direction mirrored about the normal +z. */
static inline aur_vector aur_mirror(aur_vector direction) {
    return (aur_vector){-direction.x, -direction.y, direction.z};
}

static inline float aur_luminance(aur_vector color) {
    return 0.212671f * color.x + 0.715160f * color.y + 0.072169f * color.z;
}

/* The inverse error function, for sampling Gaussians. */

/* x with erf(x) = y for -1 < y < 1, to a few parts in 10^7 (Giles 2012, "Approximating the erfinv function",
 * single precision). */
float aur_inverse_erf(float y);

/* Inverse trigonometric functions without branches or calls, so that loops over them vectorise; results are
 * bit-identical on all machines. */
#pragma once

#include <stdbool.h>

#include "points/base/vector.h"

/* arccos of a cosine in [-1, 1] (Abramowitz and Stegun 4.4.46; error below 1e-7 plus rounding). */
static inline float aur_arc(float cosine) {
    const float x = fabsf(cosine);
    float p = -0.0012624911f;
    p = p * x + 0.0066700901f;
    p = p * x - 0.0170881256f;
    p = p * x + 0.0308918810f;
    p = p * x - 0.0501743046f;
    p = p * x + 0.0889789874f;
    p = p * x - 0.2145988016f;
    p = p * x + 1.5707963050f;
    const float angle = p * sqrtf(fabsf(1.0f - x));
    return 0.5f * AUR_PI_F - copysignf(0.5f * AUR_PI_F - angle, cosine);
}

/* The angle of (x, y) from the x axis in turns, -1/2 to 1/2; 0 for (0, 0) (Abramowitz and Stegun 4.4.49
 * divided by 2 pi; error below 1e-8 plus rounding). */
static inline float aur_turn(float x, float y) {
    const float a = fabsf(x), b = fabsf(y);
    const bool flat = a >= b;
    const float larger = flat ? a : b, smaller = flat ? b : a;
    const float z = smaller / (larger > 0.0f ? larger : 1.0f), square = z * z;
    float p = 0.0028662257f;
    p = p * square - 0.0161657367f;
    p = p * square + 0.0429096138f;
    p = p * square - 0.0752896400f;
    p = p * square + 0.1065626393f;
    p = p * square - 0.1420889944f;
    p = p * square + 0.1999355085f;
    p = p * square - 0.3333314528f;
    const float eighth = (z + z * square * p) * (0.5f / AUR_PI_F);
    const float quarter = flat ? eighth : 0.25f - eighth;
    return copysignf(x < 0.0f ? 0.5f - quarter : quarter, y);
}

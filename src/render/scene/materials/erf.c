#include "render/scene/materials/erf.h"

#include <math.h>
#include <stddef.h>

enum { TERMS = 9 };

static float polynomial(const float *coefficients, float x) {
    float sum = coefficients[0];
    for (size_t i = 1; i < TERMS; ++i)
        sum = coefficients[i] + sum * x;
    return sum;
}

float aur_inverse_erf(float y) {
    static const float centre[TERMS] = {2.81022636e-08f,  3.43273939e-07f, -3.5233877e-06f,
                                        -4.39150654e-06f, 0.00021858087f,  -0.00125372503f,
                                        -0.00417768164f,  0.246640727f,    1.50140941f};
    static const float tail[TERMS] = {-0.000200214257f, 0.000100950558f, 0.00134934322f,
                                      -0.00367342844f,  0.00573950773f,  -0.0076224613f,
                                      0.00943887047f,   1.00167406f,     2.83297682f};
    const float w = -logf((1.0f - y) * (1.0f + y));
    return y * (w < 5.0f ? polynomial(centre, w - 2.5f) : polynomial(tail, sqrtf(w) - 3.0f));
}

#include "integrands.h"

#include <aureole/sphere.h>
#include <math.h>

static const double pi = 3.14159265358979323846;
static const double wide = 4.0, narrow = 400.0;

static double rim(void) {
    return cos(40.0 / 180.0 * pi);
}

const char *lab_class_name(lab_class kind) {
    static const char *const names[LAB_CLASSES] = {"smooth", "clipped", "discontinuous", "spiky"};
    return names[kind];
}

lab_integrand lab_integrand_make(lab_class kind, uint64_t seed) {
    lab_integrand integrand = {kind, {0.0, 0.0, 1.0}};
    aur_rotation rotation;
    aur_rotation_uniform(seed * LAB_CLASSES + kind, &rotation);
    aur_rotation_apply(&rotation, 1, integrand.axis);
    return integrand;
}

double lab_integrand_value(const lab_integrand *integrand, const double direction[3]) {
    const double *const a = integrand->axis;
    const double cosine = a[0] * direction[0] + a[1] * direction[1] + a[2] * direction[2];
    switch (integrand->kind) {
    case LAB_SMOOTH:
        return exp(wide * (cosine - 1.0));
    case LAB_CLIPPED:
        return fmax(0.0, cosine);
    case LAB_DISCONTINUOUS:
        return cosine >= rim() ? 1.0 : 0.0;
    default:
        return exp(narrow * (cosine - 1.0));
    }
}

double lab_integrand_integral(const lab_integrand *integrand) {
    switch (integrand->kind) {
    case LAB_SMOOTH:
        return 2.0 * pi * (1.0 - exp(-2.0 * wide)) / wide;
    case LAB_CLIPPED:
        return pi;
    case LAB_DISCONTINUOUS:
        return 2.0 * pi * (1.0 - rim());
    default:
        return 2.0 * pi * (1.0 - exp(-2.0 * narrow)) / narrow;
    }
}

#include "core/simd.h"
#include "scene/lights/spherical_rectangle_body.h"

bool aur_spherical_rectangle_create(const aur_rectangle *rectangle, aur_vector reference, float least,
                                    aur_spherical_rectangle *seen) {
    const aur_vector normal = aur_vector_cross(rectangle->x, rectangle->y);
    if (!(rectangle_placed(rectangle, normal, reference.x, reference.y, reference.z, least).excess > 0.0f))
        return false;
    *seen = rectangle_seen(rectangle, normal, reference.x, reference.y, reference.z, least);
    return seen->solid_angle > 0.0f;
}

void aur_spherical_rectangle_sample(const aur_spherical_rectangle *seen, float u, float v, float *s,
                                    float *t) {
    rectangle_point(seen, u, v, s, t);
}

static const aur_rectangle_kernels aur_rectangle_kernels_portable = AUR_RECTANGLE_KERNELS;

const aur_rectangle_kernels *aur_rectangle_kernels_here(void) {
    return &AUR_KERNEL_HERE(aur_rectangle_kernels);
}

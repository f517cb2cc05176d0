#include "points/base/simd.h"
#include "render/scene/lights/spherical_rectangle_body.h"

bool aur_spherical_rectangle_create(const aur_rectangle *rectangle, aur_vector reference,
                                    aur_spherical_rectangle *seen) {
    const aur_vector normal = aur_vector_cross(rectangle->x, rectangle->y);
    if (!(rectangle_placed(rectangle, normal, reference.x, reference.y, reference.z).excess > 0.0f))
        return false;
    *seen = rectangle_seen(rectangle, normal, reference.x, reference.y, reference.z);
    return seen->solid_angle > 0.0f;
}

void aur_spherical_rectangle_sample(const aur_spherical_rectangle *seen, float u, float v, float *s,
                                    float *t) {
    rectangle_point(seen, u, v, s, t);
}

aur_seen_rectangle aur_rectangle_see(const aur_rectangle *rectangle, const aur_light_reference *reference) {
    const aur_vector across = aur_vector_cross(rectangle->x, rectangle->y), p = reference->position;
    aur_seen_rectangle seen = {.by_area = !aur_spherical_rectangle_create(rectangle, p, &seen.sphere)};
    const rectangle_place at = rectangle_placed(rectangle, across, p.x, p.y, p.z);
    seen.weights = rectangle_weights(rectangle, &at, across, reference->normal, seen.by_area);
    return seen;
}

float aur_seen_rectangle_draw(const aur_seen_rectangle *seen, float u, float v, float *s, float *t) {
    *s = u;
    *t = v;
    aur_bilinear_draw(&seen->weights, s, t);
    const float density = aur_bilinear_density(&seen->weights, *s, *t);
    if (seen->by_area)
        return density;
    rectangle_point(&seen->sphere, *s, *t, s, t);
    return density / seen->sphere.solid_angle;
}

float aur_seen_rectangle_density(const aur_seen_rectangle *seen, float s, float t) {
    if (seen->by_area)
        return aur_bilinear_density(&seen->weights, s, t);
    const aur_spherical_rectangle *const sphere = &seen->sphere;
    return aur_bilinear_density(&seen->weights, rectangle_strip(sphere, s), rectangle_rank(sphere, s, t)) /
           sphere->solid_angle;
}

static const aur_rectangle_kernels aur_rectangle_kernels_portable = AUR_RECTANGLE_KERNELS;

const aur_rectangle_kernels *aur_rectangle_kernels_here(void) {
    return &AUR_KERNEL_HERE(aur_rectangle_kernels);
}

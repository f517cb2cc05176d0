#include "transport/radiosity/picture_direct.h"

#include "core/vector3d.h"

/* The unit vector along the part of `b` that is perpendicular to the unit vector `a`. */
static bool perpendicular(const double b[3], const double a[3], double result[3]) {
    const double along = aur_dot3(a, b);
    for (size_t k = 0; k < 3; ++k)
        result[k] = b[k] - along * a[k];
    return aur_normalize3(result) > 0.0;
}

/* The unit vector a cos + b sin, of orthogonal unit vectors a and b. */
static void turn(double cosine, const double a[3], const double b[3], double result[3]) {
    const double c = fmax(-1.0, fmin(1.0, cosine)), s = sqrt(1.0 - c * c);
    for (size_t k = 0; k < 3; ++k)
        result[k] = c * a[k] + s * b[k];
    aur_normalize3(result);
}

/* Below this solid angle a triangle is taken for flat, and directions lead to points spread evenly over it.
 */
static const double FLAT = 1e-7;

static void flat_direction(const double corner[9], const double from[3], double u, double v,
                           double direction[3]) {
    const double root = sqrt(u), a = root * (1.0 - v), b = root * v;
    for (size_t k = 0; k < 3; ++k)
        direction[k] = (1.0 - a - b) * corner[k] + a * corner[3 + k] + b * corner[6 + k] - from[k];
    aur_normalize3(direction);
}

double aur_spherical_triangle(const double corner[9], const double from[3], double u, double v,
                              double direction[3]) {
    double a[3][3];
    for (size_t i = 0; i < 3; ++i) {
        for (size_t k = 0; k < 3; ++k)
            a[i][k] = corner[3 * i + k] - from[k];
        if (!(aur_normalize3(a[i]) > 0.0))
            return 0.0;
    }
    double bc[3];
    aur_cross3(a[1], a[2], bc);
    /* This form (Van Oosterom and Strackee 1983) does not lose digits as the sum of the angles does. */
    const double triple = fabs(aur_dot3(a[0], bc));
    const double solid_angle =
        2.0 * atan2(triple, 1.0 + aur_dot3(a[0], a[1]) + aur_dot3(a[1], a[2]) + aur_dot3(a[2], a[0]));
    if (!(solid_angle > 0.0))
        return 0.0;
    if (solid_angle < FLAT) {
        flat_direction(corner, from, u, v, direction);
        return solid_angle;
    }
    double to_b[3], to_c[3];
    if (!perpendicular(a[1], a[0], to_b) || !perpendicular(a[2], a[0], to_c))
        return 0.0;
    double sides[3];
    aur_cross3(to_b, to_c, sides);
    const double cos_alpha = aur_dot3(to_b, to_c), sin_alpha = sqrt(aur_dot3(sides, sides)),
                 cos_c = aur_dot3(a[0], a[1]);
    /* Arvo 1995: a triangle of the area u solid_angle with the same corner and side, then a point of its far
     * side's arc. */
    const double alpha = atan2(sin_alpha, cos_alpha);
    const double s = sin(u * solid_angle - alpha), t = cos(u * solid_angle - alpha);
    const double p = t - cos_alpha, q = s + sin_alpha * cos_c;
    const double below = (q * s + p * t) * sin_alpha;
    const double cos_b = fabs(below) > 1e-300 ? ((q * t - p * s) * cos_alpha - q) / below : 1.0;
    double end[3], across[3];
    turn(cos_b, a[0], to_c, end);
    if (!perpendicular(end, a[1], across)) {
        for (size_t k = 0; k < 3; ++k)
            direction[k] = a[1][k];
        return solid_angle;
    }
    turn(1.0 - v * (1.0 - aur_dot3(end, a[1])), a[1], across, direction);
    return solid_angle;
}

static void to_doubles(aur_vector v, double d[3]) {
    d[0] = v.x;
    d[1] = v.y;
    d[2] = v.z;
}

aur_vector aur_radiosity_direct(const aur_radiosity_scene *scene, const aur_radiosity_place *place,
                                uint32_t triangle, float u, float v, uint64_t *rays) {
    const aur_vector black = {0};
    const aur_radiosity_triangle *const light = &scene->triangles[triangle];
    if (!(aur_vector_dot(light->frame.z, aur_vector_subtract(place->position, light->corner)) > 0.0f))
        return black;
    double corner[9], from[3], direction[3];
    to_doubles(light->corner, corner);
    to_doubles(aur_vector_add(light->corner, light->edge[0]), &corner[3]);
    to_doubles(aur_vector_add(light->corner, light->edge[1]), &corner[6]);
    to_doubles(place->position, from);
    const double solid_angle = aur_spherical_triangle(corner, from, (double)u, (double)v, direction);
    if (solid_angle == 0.0)
        return black;
    const aur_vector towards = {(float)direction[0], (float)direction[1], (float)direction[2]};
    const float cosine = aur_vector_dot(towards, place->normal);
    if (!(cosine > 0.0f))
        return black;
    const aur_ray ray = aur_radiosity_leave(scene, place, towards);
    aur_hit hit;
    ++*rays;
    if (!aur_scene_intersect(scene->scene, &ray, &hit) || aur_radiosity_triangle_at(scene, &hit) != triangle)
        return black;
    const float factor = (float)solid_angle * cosine / AUR_PI_F;
    return aur_vector_scale(
        aur_vector_multiply(place->albedo, aur_radiosity_emitted(scene, triangle, hit.u, hit.v)), factor);
}

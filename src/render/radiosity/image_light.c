/* Light at a shading point of an image: direct light by solid angle, and gathered light. */
#include <stdlib.h>

#include "points/base/random.h"
#include "points/base/vector3d.h"
#include "render/radiosity/image.h"
#include "render/trace/packet.h"

/* --- solid angles */

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

/* --- direct light */

/* A ray from the shading point. */
static aur_ray leave(const aur_radiosity_scene *scene, const aur_radiosity_surface_point *surface_point,
                     aur_vector direction) {
    return (aur_ray){aur_vector_add_scaled(surface_point->position,
                                           scene->triangles[surface_point->triangle].offset,
                                           surface_point->normal),
                     0.0f, direction, INFINITY};
}

aur_vector aur_radiosity_direct(const aur_radiosity_scene *scene,
                                const aur_radiosity_surface_point *surface_point, uint32_t triangle, float u,
                                float v) {
    const aur_vector black = {0};
    const aur_radiosity_triangle *const light = &scene->triangles[triangle];
    if (!(aur_vector_dot(light->frame.z, aur_vector_subtract(surface_point->position, light->corner)) > 0.0f))
        return black;
    double corner[9], from[3], direction[3];
    aur_vector_to_doubles(light->corner, corner);
    aur_vector_to_doubles(aur_vector_add(light->corner, light->edge[0]), &corner[3]);
    aur_vector_to_doubles(aur_vector_add(light->corner, light->edge[1]), &corner[6]);
    aur_vector_to_doubles(surface_point->position, from);
    const double solid_angle = aur_spherical_triangle(corner, from, (double)u, (double)v, direction);
    if (solid_angle == 0.0)
        return black;
    const aur_vector towards = {(float)direction[0], (float)direction[1], (float)direction[2]};
    const float cosine = aur_vector_dot(towards, surface_point->normal);
    if (!(cosine > 0.0f))
        return black;
    const aur_ray ray = leave(scene, surface_point, towards);
    aur_hit hit;
    if (!aur_scene_intersect(scene->scene, &ray, &hit) || aur_radiosity_triangle_at(scene, &hit) != triangle)
        return black;
    const float factor = (float)solid_angle * cosine / AUR_PI_F;
    return aur_vector_scale(
        aur_vector_multiply(surface_point->albedo, aur_radiosity_emitted(scene, triangle, hit.u, hit.v)),
        factor);
}

/* --- gathered light */

static aur_result make_pattern(const aur_rule_options *rule, aur_radiosity_image *image, aur_error *error) {
    const size_t count = (size_t)rule->points->count;
    double *const numbers = malloc(4 * count * sizeof *numbers);
    image->x = malloc(4 * count * sizeof *image->x);
    aur_result result = AUR_OK;
    if (numbers == NULL || image->x == NULL)
        result = aur_fail(error, AUR_ERROR_MEMORY, "radiosity: out of memory for %zu directions", count);
    if (result == AUR_OK)
        result = aur_rule_make(rule, 3 * count, numbers, numbers + 3 * count, error);
    image->direction_count = count;
    image->y = image->x + count;
    image->z = image->y + count;
    image->weights = image->z + count;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        image->x[i] = (float)numbers[3 * i];
        image->y[i] = (float)numbers[3 * i + 1];
        /* A ray along the surface would hit the surface itself. */
        image->z[i] = fmaxf((float)numbers[3 * i + 2], 1e-6f);
        image->weights[i] = (float)numbers[3 * count + i];
    }
    free(numbers);
    return result;
}

aur_result aur_radiosity_image_prepare(const aur_rule_options *rule, aur_radiosity_image *image,
                                       aur_error *error) {
    const aur_radiosity_scene *const scene = &image->solution->scene;
    image->exitance = malloc(scene->patch_count * sizeof *image->exitance);
    if (image->exitance == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < scene->patch_count; ++i)
        image->exitance[i] = aur_radiosity_exitance(image->solution, i);
    return make_pattern(rule, image, error);
}

void aur_radiosity_image_release(aur_radiosity_image *image) {
    free(image->exitance);
    free(image->x);
}

bool aur_radiosity_see(const aur_radiosity_scene *scene, uint64_t hash, aur_ray ray, aur_hit hit,
                       aur_radiosity_surface_point *surface_point, aur_vector *throughput) {
    uint32_t index = aur_radiosity_triangle_at(scene, &hit);
    const bool mirrored = (scene->triangles[index].flags & AUR_RADIOSITY_MIRROR) != 0;
    *throughput = (aur_vector){1.0f, 1.0f, 1.0f};
    if (mirrored) {
        if (aur_radiosity_reflect(scene, false, hash, &ray, &hit, throughput) != AUR_RADIOSITY_HIT)
            return false;
        index = aur_radiosity_triangle_at(scene, &hit);
    }
    const aur_radiosity_triangle *const met = &scene->triangles[index];
    const bool front = aur_vector_dot(ray.direction, met->frame.z) < 0.0f;
    *surface_point =
        (aur_radiosity_surface_point){.position = aur_radiosity_point(met, hit.u, hit.v),
                                      .normal = aur_vector_scale(met->frame.z, front ? 1.0f : -1.0f),
                                      .triangle = index,
                                      .patch = front ? index : met->back,
                                      .mirrored = mirrored};
    if (surface_point->patch != AUR_NO_PATCH)
        surface_point->albedo = aur_radiosity_albedo(scene, index, front, &ray, &hit);
    if (front && (met->flags & AUR_RADIOSITY_GLOWS) != 0)
        surface_point->emission = aur_radiosity_emitted(scene, index, hit.u, hit.v);
    return true;
}

/* The solution's radiance at the end of a gather ray. */
static aur_vector radiance_at(const aur_radiosity_image *image, const aur_ray *ray, const aur_hit *hit,
                              uint64_t hash) {
    aur_radiosity_surface_point surface_point;
    aur_vector throughput;
    if (!aur_radiosity_see(&image->solution->scene, hash, *ray, *hit, &surface_point, &throughput) ||
        surface_point.patch == AUR_NO_PATCH)
        return (aur_vector){0};
    aur_vector radiance = aur_vector_multiply(surface_point.albedo, image->exitance[surface_point.patch]);
    /* Direct light is drawn from lights that are seen without mirrors, so what a mirror shows of a light is
     * added here. */
    if (surface_point.mirrored)
        radiance = aur_vector_add(radiance, surface_point.emission);
    return aur_vector_multiply(throughput, radiance);
}

aur_vector aur_radiosity_gather(const aur_radiosity_image *image,
                                const aur_radiosity_surface_point *surface_point, uint64_t hash) {
    const aur_radiosity_scene *const scene = &image->solution->scene;
    const float angle = 2.0f * AUR_PI_F * aur_unit_float((uint32_t)(hash >> 32));
    const float cosine = cosf(angle), sine = sinf(angle);
    const aur_frame frame = aur_frame_about(surface_point->normal);
    aur_packet packet;
    aur_packet_clear(&packet);
    aur_vector sum = {0};
    for (size_t first = 0; first < image->direction_count; first += AUR_PACKET_SIZE) {
        aur_ray rays[AUR_PACKET_SIZE];
        const size_t left = image->direction_count - first,
                     lanes = left < AUR_PACKET_SIZE ? left : AUR_PACKET_SIZE;
        for (size_t k = 0; k < lanes; ++k) {
            const float x = image->x[first + k], y = image->y[first + k];
            const aur_vector local = {cosine * x - sine * y, sine * x + cosine * y, image->z[first + k]};
            rays[k] = leave(scene, surface_point, aur_frame_to_world(&frame, local));
            aur_packet_set(&packet, k, &rays[k]);
        }
        for (size_t k = lanes; k < AUR_PACKET_SIZE; ++k)
            packet.valid[k] = 0;
        const uint32_t met = aur_scene_intersect16(scene->scene, AUR_EMBREE_INCOHERENT, &packet);
        for (size_t k = 0; k < lanes; ++k) {
            if ((met >> k & 1u) == 0)
                continue;
            const aur_hit hit = aur_packet_hit(scene->scene, &packet, k);
            const aur_vector radiance = radiance_at(image, &rays[k], &hit, aur_hash2(hash, first + k));
            sum = aur_vector_add_scaled(sum, image->weights[first + k], radiance);
        }
    }
    return sum;
}

/* Camera rays, single and in packets of sixteen. */
#include "render/scene/sensor.h"

#include <math.h>

#include "render/scene/materials/sampling.h"
#include "render/scene/scene_data.h"

float aur_sensor_half_width(const aur_sensor *sensor, float aspect) {
    switch (sensor->axis) {
    case AUR_FOV_X:
        break;
    case AUR_FOV_Y:
        return sensor->tangent * aspect;
    case AUR_FOV_DIAGONAL:
        return sensor->tangent * aspect / sqrtf(1.0f + aspect * aspect);
    case AUR_FOV_SMALLER:
        return aspect > 1.0f ? sensor->tangent * aspect : sensor->tangent;
    case AUR_FOV_LARGER:
        return aspect > 1.0f ? sensor->tangent : sensor->tangent * aspect;
    }
    return sensor->tangent;
}

static aur_vector to_world_direction(const float m[12], aur_vector v) {
    return (aur_vector){m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
                        m[8] * v.x + m[9] * v.y + m[10] * v.z};
}

/* The camera of a film point; in a batch, the part with its x and width. */
static const aur_sensor *choose_part(const aur_sensor *sensor, float *x, float *width) {
    if (sensor->part_count == 0)
        return sensor;
    *width /= (float)sensor->part_count;
    const float last = (float)(sensor->part_count - 1);
    const float part = aur_smaller(aur_larger(floorf(*x / *width), 0.0f), last);
    *x -= part * *width;
    return sensor->parts[(size_t)part];
}

void aur_camera_ray(const aur_scene *scene, size_t width, size_t height, float x, float y,
                    const float lens[2], aur_ray *ray) {
    float wide = (float)width;
    const aur_sensor *const sensor = choose_part(&scene->sensor, &x, &wide);
    const float aspect = wide / (float)height;
    aur_ray local = {.origin = {0.0f, 0.0f, 0.0f}};
    sensor->descriptor->ray(sensor, aspect, x / wide, y / (float)height, lens, &local);
    if (sensor->shape != NULL) { /* the shape is in world coordinates */
        *ray = local;
        return;
    }
    const aur_vector origin = to_world_direction(sensor->to_world, local.origin);
    ray->origin =
        aur_vector_add(origin, (aur_vector){sensor->to_world[3], sensor->to_world[7], sensor->to_world[11]});
    /* Clip depths are along local z, and scale with the camera. */
    const aur_vector direction = to_world_direction(sensor->to_world, local.direction);
    const float unit_depth = aur_vector_length(direction) / local.direction.z;
    ray->direction = aur_vector_normalize(direction);
    ray->nearest = sensor->near_clip * unit_depth;
    ray->farthest = sensor->far_clip * unit_depth;
}

static void pinhole_rays(const aur_sensor *given, float width, float height, const float *restrict x,
                         const float *restrict y, aur_camera_lanes *restrict rays) {
    const aur_sensor sensor = *given; /* rays must not alias these */
    const float aspect = width / height, half = aur_sensor_half_width(&sensor, aspect);
    for (size_t k = 0; k < AUR_CAMERA_LANES; ++k) {
        const aur_vector local = aur_sensor_direction(&sensor, half, aspect, x[k] / width, y[k] / height);
        const aur_vector direction = to_world_direction(sensor.to_world, local);
        const float length = aur_vector_length(direction), scale = 1.0f / length;
        rays->direction[0][k] = direction.x * scale;
        rays->direction[1][k] = direction.y * scale;
        rays->direction[2][k] = direction.z * scale;
        rays->nearest[k] = sensor.near_clip * length;
        rays->farthest[k] = sensor.far_clip * length;
    }
    for (size_t c = 0; c < 3; ++c)
        for (size_t k = 0; k < AUR_CAMERA_LANES; ++k)
            rays->origin[c][k] = sensor.to_world[4 * c + 3];
}

void aur_camera_rays(const aur_scene *scene, size_t width, size_t height, const float *x, const float *y,
                     const float *lens_u, const float *lens_v, aur_camera_lanes *rays) {
    if (scene->sensor.descriptor->is_pinhole) {
        pinhole_rays(&scene->sensor, (float)width, (float)height, x, y, rays);
        return;
    }
    for (size_t k = 0; k < AUR_CAMERA_LANES; ++k) {
        aur_ray ray;
        aur_camera_ray(scene, width, height, x[k], y[k], (const float[2]){lens_u[k], lens_v[k]}, &ray);
        rays->origin[0][k] = ray.origin.x;
        rays->origin[1][k] = ray.origin.y;
        rays->origin[2][k] = ray.origin.z;
        rays->direction[0][k] = ray.direction.x;
        rays->direction[1][k] = ray.direction.y;
        rays->direction[2][k] = ray.direction.z;
        rays->nearest[k] = ray.nearest;
        rays->farthest[k] = ray.farthest;
    }
}

static bool has_lens(const aur_sensor *sensor) {
    return sensor->aperture_radius > 0.0f || sensor->shape != NULL;
}

bool aur_camera_has_lens(const aur_scene *scene) {
    bool has = has_lens(&scene->sensor);
    for (size_t i = 0; i < scene->sensor.part_count; ++i)
        has = has || has_lens(scene->sensor.parts[i]);
    return has;
}

float aur_camera_factor(const aur_scene *scene) {
    const aur_sensor *const sensor = &scene->sensor;
    const aur_sensor_descriptor *const descriptor =
        sensor->part_count > 0 ? sensor->parts[0]->descriptor : sensor->descriptor;
    return descriptor != NULL && descriptor->factor != 0.0f ? descriptor->factor : 1.0f;
}

bool aur_camera_is_pinhole(const aur_scene *scene) {
    return scene->sensor.descriptor->is_pinhole;
}

aur_vector aur_camera_position(const aur_scene *scene) {
    const float *const m = scene->sensor.to_world;
    return (aur_vector){m[3], m[7], m[11]};
}

/* A direction as slopes in camera space, z = 1, and its depth, by Cramer's rule from the columns of to_world;
 * false behind the camera. */
static bool in_camera_space(const aur_sensor *sensor, aur_vector direction, aur_vector *slope, float *depth) {
    const float *const m = sensor->to_world;
    const aur_vector x = {m[0], m[4], m[8]}, y = {m[1], m[5], m[9]}, z = {m[2], m[6], m[10]};
    const float volume = aur_vector_dot(x, aur_vector_cross(y, z)), sign = volume < 0.0f ? -1.0f : 1.0f;
    const float along = sign * aur_vector_dot(direction, aur_vector_cross(x, y));
    if (!(along > 0.0f))
        return false;
    *slope = (aur_vector){sign * aur_vector_dot(direction, aur_vector_cross(y, z)) / along,
                          sign * aur_vector_dot(direction, aur_vector_cross(z, x)) / along, 1.0f};
    *depth = along / fabsf(volume);
    return true;
}

/* The film point of a ray with these slopes from the camera's centre; `slope`: the slopes of the ray itself.
 */
static aur_film_point film_point_of(const aur_sensor *sensor, size_t width, size_t height, aur_vector seen,
                                    aur_vector slope) {
    const float aspect = (float)width / (float)height, half = aur_sensor_half_width(sensor, aspect);
    const float pixel = 2.0f * half / (float)width, square = 1.0f + slope.x * slope.x + slope.y * slope.y;
    return (aur_film_point){
        .x = (float)width * (0.5f * (1.0f - seen.x / half) - sensor->offset_x),
        .y = (float)height * (0.5f * (1.0f - seen.y * aspect / half) - sensor->offset_y),
        .solid_angle = pixel * pixel / (square * sqrtf(square)),
    };
}

bool aur_camera_see(const aur_scene *scene, size_t width, size_t height, aur_vector direction,
                    aur_film_point *point) {
    aur_vector slope;
    float depth;
    if (!in_camera_space(&scene->sensor, direction, &slope, &depth))
        return false;
    *point = film_point_of(&scene->sensor, width, height, slope, slope);
    return true;
}

bool aur_camera_connects(const aur_scene *scene) {
    return scene->sensor.part_count == 0 && scene->sensor.tangent > 0.0f;
}

bool aur_camera_connect(const aur_scene *scene, size_t width, size_t height, const float lens[2],
                        aur_vector point, aur_camera_link *link) {
    const aur_sensor *const sensor = &scene->sensor;
    aur_vector on_lens = {0.0f, 0.0f, 0.0f};
    if (sensor->aperture_radius > 0.0f) {
        aur_sample_disk(lens[0], lens[1], &on_lens.x, &on_lens.y);
        on_lens = aur_vector_scale(on_lens, sensor->aperture_radius);
    }
    const aur_vector shift = to_world_direction(sensor->to_world, on_lens);
    link->origin = aur_vector_add(aur_camera_position(scene), shift);
    const aur_vector way = aur_vector_subtract(point, link->origin);
    link->distance = aur_vector_length(way);
    link->direction = aur_vector_scale(way, 1.0f / aur_larger(link->distance, 1e-30f));
    aur_vector slope; /* of the ray in camera space, z = 1 */
    float depth;
    if (!in_camera_space(sensor, way, &slope, &depth) || depth < sensor->near_clip ||
        depth > sensor->far_clip)
        return false;
    link->nearest = sensor->near_clip * link->distance / depth;
    aur_vector seen = slope; /* all rays of a film point meet in the plane of focus */
    if (sensor->aperture_radius > 0.0f)
        seen = aur_vector_add_scaled(slope, 1.0f / sensor->focus_distance, on_lens);
    link->film = film_point_of(sensor, width, height, seen, slope);
    return true;
}

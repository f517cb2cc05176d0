/* Statistics of what the camera's clip planes hide. */
#include "points/base/error.h"
#include "render/scene/scene_data.h"

static void probe(const aur_scene *scene, aur_ray ray, aur_clip_description *clips) {
    const float nearest = ray.nearest, farthest = ray.farthest;
    aur_hit hit;
    ray.farthest = INFINITY;
    const bool meets = aur_scene_intersect(scene, &ray, &hit);
    ++clips->rays;
    if (meets && hit.distance < farthest)
        ++clips->seen;
    else if (meets)
        ++clips->too_far;
    ray.nearest = 0.0f;
    ray.farthest = nearest;
    clips->too_near += !meets && nearest > 0.0f && aur_scene_occluded(scene, &ray);
}

aur_result aur_scene_get_clips(const aur_scene *scene, aur_clip_description *description, aur_error *error) {
    enum { SIDE = 32 };
    aur_clip_description clips = {.size = sizeof clips};
    const aur_result result = aur_scene_check_camera(scene, error);
    if (result != AUR_OK)
        return result;
    const aur_sensor *const sensor = scene->sensor.part_count > 0 ? scene->sensor.parts[0] : &scene->sensor;
    clips.near_clip = (double)sensor->near_clip;
    clips.far_clip = (double)sensor->far_clip;
    const size_t width = scene->film.width, height = scene->film.height;
    for (size_t i = 0; i < SIDE * SIDE; ++i) {
        const float x = ((float)(i % SIDE) + 0.5f) / SIDE, y = ((float)(i / SIDE) + 0.5f) / SIDE;
        static const float middle[2] = {0.5f, 0.5f};
        aur_ray ray;
        aur_camera_ray(scene, width, height, x * (float)width, y * (float)height, middle, &ray);
        probe(scene, ray, &clips);
    }
    return aur_description_write(&clips, sizeof clips, description, "aur_clip_description", error);
}

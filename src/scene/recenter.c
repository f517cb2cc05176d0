/* From the coordinates of files, which are doubles, to those of rays, which are floats and count from an
 * origin near the scene. */
#include "scene/origin.h"

static aur_result choose(const aur_scene *scene, const aur_shape_group *group, double origin[3],
                         aur_error *error) {
    aur_patch_boxes boxes;
    aur_result result = aur_patch_boxes_create(scene, group, &boxes);
    if (result == AUR_OK)
        result = aur_origin_choose(&boxes, origin);
    aur_patch_boxes_release(&boxes);
    return result == AUR_OK ? result : aur_fail_memory(error);
}

/* Groups have origins of their own, so that copies of what is modelled far away are as exact as others. */
static aur_result recenter_group(aur_scene *scene, aur_shape_group *group, aur_error *error) {
    aur_result result = choose(scene, group, group->origin, error);
    for (size_t i = 0; i < group->count && result == AUR_OK; ++i)
        result =
            aur_shape_recenter(scene->shapes[group->shapes[i]], group->origin, scene->keeps_points, error);
    return result;
}

static void recenter_instance(aur_instance *instance, const double origin[3]) {
    double moved[3];
    aur_transform_point(&instance->to_world, instance->group->origin, moved);
    for (size_t i = 0; i < 3; ++i)
        instance->to_world.m[4 * i + 3] = moved[i] - origin[i];
    aur_transform_inverse(&instance->to_world, &instance->to_local);
}

aur_result aur_scene_recenter(aur_scene *scene, aur_error *error) {
    aur_result result = choose(scene, NULL, scene->origin, error);
    for (size_t i = 0; i < scene->group_count && result == AUR_OK; ++i)
        result = recenter_group(scene, scene->groups[i], error);
    for (size_t i = 0; i < scene->shape_count && result == AUR_OK; ++i)
        if (!scene->shapes[i]->grouped)
            result = aur_shape_recenter(scene->shapes[i], scene->origin, scene->keeps_points, error);
    for (size_t i = 0; i < scene->instance_count && result == AUR_OK; ++i)
        recenter_instance(scene->instances[i], scene->origin);
    for (size_t i = 0; i < scene->volume_count && result == AUR_OK; ++i)
        aur_volume_recenter(scene->volumes[i], scene->origin);
    aur_sensor_recenter(&scene->sensor, scene->origin);
    for (size_t i = 0; i < scene->part_count; ++i)
        aur_sensor_recenter(scene->parts[i], scene->origin);
    return result;
}

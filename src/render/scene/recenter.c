/* Conversion from file coordinates, which are doubles, to render coordinates, which are floats relative to an
 * origin near the scene. */
#include "render/scene/origin.h"

/* Relative rounding, by the size of a shape or of its triangles, above which the shape is inaccurate. */
static const double COARSE = 1e-3, COARSE_SHARE = 0.01;

/* The number of boxes from `first` on that belong to one shape, and whether much of it is too small for its
 * distance from the origin; *worst is then one of these boxes. */
static size_t judge_shape(const aur_patch_boxes *boxes, size_t first, const double origin[3],
                          const aur_patch_box **worst) {
    double all = 0.0, coarse = 0.0;
    size_t count = 0;
    *worst = NULL;
    for (; first + count < boxes->count; ++count) {
        const aur_patch_box *const box = &boxes->boxes[first + count];
        if (box->shape != boxes->boxes[first].shape)
            break;
        const double area = box->weight * box->size * box->size;
        const bool bad = aur_patch_rounding(box, origin) > COARSE;
        all += area;
        coarse += bad ? area : 0.0;
        if (bad && (*worst == NULL || box->size > (*worst)->size))
            *worst = box;
    }
    if (!(coarse > COARSE_SHARE * all))
        *worst = NULL;
    return count;
}

/* Warns of shapes that are inaccurate with any origin. */
static void warn_of_rounding(const aur_scene *scene, const aur_patch_boxes *boxes,
                             const aur_warnings *warnings) {
    const aur_patch_box *first = NULL, *worst;
    size_t shapes = 0, bad = 0;
    for (size_t i = 0; i < boxes->count; ++shapes) {
        i += judge_shape(boxes, i, scene->origin, &worst);
        bad += worst != NULL;
        first = first == NULL ? worst : first;
    }
    if (first != NULL)
        aur_warn_at(warnings, scene->shapes[first->shape]->location,
                    "%zu of %zu shapes are too small to be exact in so large a scene: surfaces of the first, "
                    "%.2g wide, are rounded by %.2g",
                    bad, shapes, first->size, first->size * aur_patch_rounding(first, scene->origin));
}

static aur_result choose(const aur_scene *scene, const aur_shape_group *group, const aur_warnings *warnings,
                         double origin[3], aur_error *error) {
    aur_patch_boxes boxes;
    aur_result result = aur_patch_boxes_create(scene, group, &boxes);
    if (result == AUR_OK)
        result = aur_origin_choose(&boxes, origin);
    if (result == AUR_OK && group == NULL)
        warn_of_rounding(scene, &boxes, warnings);
    aur_patch_boxes_release(&boxes);
    return result == AUR_OK ? result : aur_fail_memory(error);
}

/* Groups have separate origins, so that instances of distant geometry are as accurate as others. */
static aur_result recenter_group(aur_scene *scene, aur_shape_group *group, aur_error *error) {
    aur_result result = choose(scene, group, NULL, group->origin, error);
    for (size_t i = 0; i < group->count && result == AUR_OK; ++i)
        result =
            aur_shape_recenter(scene->shapes[group->shapes[i]], group->origin, scene->stores_points, error);
    return result;
}

static void recenter_instance(aur_instance *instance, const double origin[3]) {
    double moved[3];
    aur_transform_point(&instance->to_world, instance->group->origin, moved);
    for (size_t i = 0; i < 3; ++i)
        instance->to_world.m[4 * i + 3] = moved[i] - origin[i];
    aur_transform_inverse(&instance->to_world, &instance->to_local);
}

aur_result aur_scene_recenter(aur_scene *scene, const aur_warnings *warnings, aur_error *error) {
    aur_result result = choose(scene, NULL, warnings, scene->origin, error);
    for (size_t i = 0; i < scene->group_count && result == AUR_OK; ++i)
        result = recenter_group(scene, scene->groups[i], error);
    for (size_t i = 0; i < scene->shape_count && result == AUR_OK; ++i)
        if (!scene->shapes[i]->grouped)
            result = aur_shape_recenter(scene->shapes[i], scene->origin, scene->stores_points, error);
    for (size_t i = 0; i < scene->instance_count && result == AUR_OK; ++i)
        recenter_instance(scene->instances[i], scene->origin);
    for (size_t i = 0; i < scene->volume_count && result == AUR_OK; ++i)
        aur_volume_recenter(scene->volumes[i], scene->origin);
    if (result == AUR_OK)
        result = aur_sensor_recenter(&scene->sensor, scene->origin, error);
    for (size_t i = 0; i < scene->part_count && result == AUR_OK; ++i)
        result = aur_sensor_recenter(scene->parts[i], scene->origin, error);
    return result;
}

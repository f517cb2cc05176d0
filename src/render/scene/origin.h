/* The point from which the coordinates of a scene count, so that as floats they are exact wherever it stands.
 */
#pragma once

#include "render/scene/scene_data.h"

/* A surface, or a sample of many alike: a triangle, a segment of a curve or another curved shape. */
typedef struct aur_patch_box {
    double lower[3], upper[3]; /* world coordinates, or those of a group */
    double size;               /* its longest side */
    double weight;             /* how many surfaces it stands for */
    uint32_t shape;
} aur_patch_box;

typedef struct aur_patch_boxes {
    size_t count, capacity;
    aur_patch_box *boxes;
} aur_patch_boxes;

/* Of the shapes of a group, before they are recentred, or of all that is no group and of instances, where
 * `group` is NULL: all boxes of scenes with a few thousand, else as many that are spread over all. What has
 * no size, and what is beyond AUR_REACH, is left out. Errors: MEMORY. */
aur_result aur_patch_boxes_create(const aur_scene *scene, const aur_shape_group *group,
                                  aur_patch_boxes *boxes);
void aur_patch_boxes_release(aur_patch_boxes *boxes);

/* By how much of the size of a surface its coordinates are rounded when they count from `origin`. */
double aur_patch_rounding(const aur_patch_box *box, const double origin[3]);

/* A point from which as little area as can be is rounded by much of its size: 0 if that is as good as others,
 * else one with few digits, which leaves coordinates with few digits as they are. A surface that is small and
 * alone does not matter, wherever it is. Errors: MEMORY. */
aur_result aur_origin_choose(const aur_patch_boxes *boxes, double origin[3]);

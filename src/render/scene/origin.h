/* The origin of a scene's coordinates, chosen so that floats are accurate for scenes far from the world's
 * origin. */
#pragma once

#include "render/scene/scene_data.h"

/* A surface, or a sample that stands for several similar ones: a triangle, a segment of a curve or another
 * curved shape. */
typedef struct aur_patch_box {
    double lower[3], upper[3]; /* longest side */
    double size;               /* its longest side */
    double weight;             /* number of surfaces represented */
    uint32_t shape;
} aur_patch_box;

typedef struct aur_patch_boxes {
    size_t count, capacity;
    aur_patch_box *boxes;
} aur_patch_boxes;

/* Boxes of the shapes of a group before they are recentred, or, if `group` is NULL, of instances and shapes
 * outside of groups. All boxes for up to a few thousand, else an evenly distributed sample. Degenerate boxes
 * and those beyond AUR_REACH are excluded. Errors: MEMORY. */
aur_result aur_patch_boxes_create(const aur_scene *scene, const aur_shape_group *group,
                                  aur_patch_boxes *boxes);
void aur_patch_boxes_release(aur_patch_boxes *boxes);

/* Rounding of a surface's coordinates relative to `origin`, as a fraction of its size. */
double aur_patch_rounding(const aur_patch_box *box, const double origin[3]);

/* An origin that minimises the area with large relative rounding. It is 0 if that is as good, else a point
 * with few digits, which preserves coordinates with few digits. A single small surface has no influence.
 * Errors: MEMORY. */
aur_result aur_origin_choose(const aur_patch_boxes *boxes, double origin[3]);

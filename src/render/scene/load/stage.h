/* Scene surroundings from options, applied after the scene is complete: a camera that frames it, an
 * environment, a ground, a background (aur_scene_stage). */
#pragma once

#include "render/scene/load/loader.h"

/* Axes for the surroundings: to the right of the camera, up, and towards the camera along the ground. */
typedef struct aur_stage_axes {
    double right[3], up[3], toward[3];
} aur_stage_axes;

/* --- the camera (framing.c) */

typedef struct aur_stage_box {
    double sides[2][3]; /* lower, upper */
} aur_stage_box;

/* Visitor of surface corners: `visit` is called for each corner. `matters` is false for a box, given by its
 * minimum and maximum, if no corner within could change the result so far. */
typedef struct aur_stage_visitor {
    void (*visit)(void *user, const double point[3]);
    bool (*matters)(const void *user, const aur_stage_box *box);
    void *user;
} aur_stage_visitor;

/* Visits all corners of surfaces in the world that matter (corners.c), possibly more than once; for curved
 * shapes, the corners of their bounds. */
void aur_stage_visit_points(const aur_scene *scene, const aur_stage_visitor *visitor);

/* Extends a box to contain a point. */
void aur_stage_widen(aur_stage_box *box, const double point[3]);

/* The bounds of the scene; false if it is empty. */
bool aur_stage_bounds(const aur_scene *scene, double lower[3], double upper[3]);

/* Places the scene's sensor as specified by aur_scene_stage.camera. *turn: the camera's azimuth, in radians
 * from the front to the right; *rise: the elevation. `aspect`: of the image. Errors: ARGUMENT for a text that
 * is not a camera, or not applicable to the sensor. */
aur_result aur_stage_set_camera(aur_scene *scene, const char *text, double aspect, bool z_up,
                                aur_error *error);
/* The axes from the sensor's position. */
aur_stage_axes aur_stage_axes_of(const aur_scene *scene, bool z_up);

/* --- images of the studio (studio.c), as PFM files; NULL if out of memory */

/* The radiance of a white floor, albedo AUR_STUDIO_FLOOR, under the light boxes, and that of the background.
 */
#define AUR_STUDIO_WHITE 0.62
#define AUR_STUDIO_FLOOR 0.6

/* Radiance by longitude and latitude, with the camera at the centre. */
char *aur_studio_lights(size_t *size);
/* The opacity of the floor: 1 around the middle, 0 at the edge. */
char *aur_studio_fade(size_t *size);

/* --- the stage (stage.c) */

/* Adds a sensor to a <scene> that has none, if a view of the options can place it. */
void aur_stage_add_sensor(aur_nodes *nodes, const aur_scene_stage *stage);
/* Whether a child of <scene> is skipped because the stage replaces it. */
bool aur_stage_replaces(const aur_scene_stage *stage, const aur_xml_node *node);
/* Builds the stage after all children of <scene>; adds further children. Errors: those of aur_scene_load. */
aur_result aur_stage_set(aur_loader *self, const aur_scene_options *options);

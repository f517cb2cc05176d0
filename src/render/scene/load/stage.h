/* How options see and light a scene, when all of it is there: a camera that shows all of it, an environment,
 * a ground, a background (aur_scene_stage). */
#pragma once

#include "render/scene/load/loader.h"

/* Axes of what is set around a scene: to the right of the camera, up, and towards the camera along the
 * ground. */
typedef struct aur_stage_axes {
    double right[3], up[3], toward[3];
} aur_stage_axes;

/* --- the camera (framing.c) */

typedef struct aur_stage_box {
    double sides[2][3]; /* lower, upper */
} aur_stage_box;

/* What corners of surfaces are for: `visit` sees one after the other; `matters` is false for a box, its lower
 * and its upper sides, where no corner within it changes what those before came to. */
typedef struct aur_stage_visitor {
    void (*visit)(void *user, const double point[3]);
    bool (*matters)(const void *user, const aur_stage_box *box);
    void *user;
} aur_stage_visitor;

/* All corners of surfaces in the world that matter (corners.c), each once or more often; curved shapes have
 * those of their bounds. */
void aur_stage_visit_points(const aur_scene *scene, const aur_stage_visitor *visitor);

/* Widens a box to hold a point. */
void aur_stage_widen(aur_stage_box *box, const double point[3]);

/* The bounds of the scene; false when nothing is there. */
bool aur_stage_bounds(const aur_scene *scene, double lower[3], double upper[3]);

/* Places the scene's sensor by the text of aur_scene_stage.camera. *turn: the camera's azimuth, radians from
 * the front to the right; *rise: the elevation. `aspect`: of the image. Errors: ARGUMENT for a text that is
 * no camera, or one that the sensor cannot be. */
aur_result aur_stage_place_camera(aur_scene *scene, const char *text, double aspect, bool z_up,
                                  aur_error *error);
/* The axes by where the sensor stands. */
aur_stage_axes aur_stage_axes_of(const aur_scene *scene, bool z_up);

/* --- images of the studio (studio.c), as PFM files; NULL where memory is out */

/* The radiance of a white floor, albedo AUR_STUDIO_FLOOR, under the light boxes, and that of the background.
 */
#define AUR_STUDIO_WHITE 0.62
#define AUR_STUDIO_FLOOR 0.6

/* Radiance by longitude and latitude, with the camera in the middle. */
char *aur_studio_lights(size_t *size);
/* The opacity of the floor: 1 around the middle, 0 at the edge. */
char *aur_studio_fade(size_t *size);

/* --- the stage (stage.c) */

/* Whether a child of <scene> is left out because the stage has something in its place. */
bool aur_stage_replaces(const aur_scene_stage *stage, const aur_xml_node *node);
/* Sets the stage when all children of <scene> are built; adds more of them. Errors: those of
 * aur_scene_load. */
aur_result aur_stage_set(aur_loader *self, const aur_scene_options *options);

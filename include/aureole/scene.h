/* Scenes: Mitsuba 3 XML, loaded into shapes, materials, lights and a camera. */
#ifndef AUREOLE_SCENE_H
#define AUREOLE_SCENE_H

#include <aureole/core.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Immutable once loaded; any number of threads may render it. */
typedef struct aur_scene aur_scene;

/* One `-D name=value`. */
typedef struct aur_definition {
    const char *name;
    const char *value;
} aur_definition;

typedef struct aur_scene_options {
    size_t definition_count;
    const aur_definition *definitions; /* they beat the scene's <default>s; an unused one is an error */
    aur_warnings warnings;             /* legacy parameters and the like */
} aur_scene_options;

/* Errors carry file, line and column. `options` may be NULL. */
AUR_API aur_result aur_scene_load(const char *path, const aur_scene_options *options, aur_scene **scene,
                                  aur_error *error) AUR_NONNULL(1, 3);
AUR_API void aur_scene_destroy(aur_scene *scene); /* NULL is allowed */

/* What is in a scene, for people and for `aureole info`. */
typedef struct aur_scene_description {
    size_t shapes, triangles, emitters, materials;
    size_t width, height, samples_per_pixel;
    float lower[3], upper[3]; /* bounding box, scene units */
    const char *integrator;   /* owned by the scene */
    const char *sampler;      /* SET syntax, owned by the scene */
    const char *filter;       /* "box", "tent", "gaussian" */
} aur_scene_description;

AUR_API void aur_scene_describe(const aur_scene *scene, aur_scene_description *description) AUR_NONNULL(1, 2);

#ifdef __cplusplus
}
#endif

#endif

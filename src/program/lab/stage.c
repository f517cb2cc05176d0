/* Functions for experiments: scenes and rendering. Separate from images, so that an experiment that only
 * writes images does not need the renderer. */
#include <aureole/ranks.h>
#include <unistd.h>

#include "program/lab/gather.h"
#include "program/lab/run.h"

#ifndef AUR_SCENES_FOLDER
#define AUR_SCENES_FOLDER "scenes"
#endif

const lab_parameter lab_scene_parameters[] = {
    {"scene", NULL, "file of a scene in place of that of the paper"},
    {.name = NULL},
};

/* The path of a bundled scene. */
static void scene_path(const lab_run *run, const char *path, char full[AUR_ERROR_FILE_CAPACITY]) {
    const char *folder = run->options.scenes;
    if (folder == NULL) {
        bool here = access("scenes", R_OK) == 0;
        aur_ranks_agree(sizeof here, &here);
        folder = here ? "scenes" : AUR_SCENES_FOLDER;
    }
    snprintf(full, AUR_ERROR_FILE_CAPACITY, "%s/%s", folder, path);
}

aur_result lab_load_scene(const lab_run *run, const char *path, size_t definition_count,
                          const aur_definition *definitions, aur_scene **scene, aur_error *error) {
    char full[AUR_ERROR_FILE_CAPACITY];
    scene_path(run, path, full);
    const aur_scene_options options = {.size = sizeof options,
                                       .definition_count = definition_count,
                                       .definitions = definitions,
                                       .warnings = run->options.warnings};
    return aur_scene_load(full, &options, scene, error);
}

aur_result lab_stage_open(lab_run *run, const char *path, size_t definition_count,
                          const aur_definition *definitions, lab_stage *stage, aur_error *error) {
    const char *const given = lab_parameter_text(run, "scene");
    *stage = (lab_stage){0};
    if (given != NULL) {
        const aur_scene_options options = {.size = sizeof options, .warnings = run->options.warnings};
        const aur_result loaded = aur_scene_load(given, &options, &stage->scene, error);
        lab_note(run, "scene %s in place of %s: published values are not compared", given, path);
        return loaded != AUR_OK ? loaded : aur_renderer_create(stage->scene, &stage->renderer, error);
    }
    const aur_result result = lab_load_scene(run, path, definition_count, definitions, &stage->scene, error);
    char full[AUR_ERROR_FILE_CAPACITY];
    scene_path(run, path, full);
    if (result == AUR_ERROR_OPEN && access(full, R_OK) == 0) {
        lab_note(run, "%s left out, scripts/scenes.sh makes its meshes: %s", path, error->message);
        return AUR_OK;
    }
    return result != AUR_OK ? result : aur_renderer_create(stage->scene, &stage->renderer, error);
}

void lab_stage_close(lab_stage *stage) {
    aur_renderer_destroy(stage->renderer);
    aur_scene_destroy(stage->scene);
    *stage = (lab_stage){0};
}

aur_result lab_render(const lab_run *run, const lab_rendering *how, aur_image **image, aur_error *error) {
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = how->integrator,
                                        .sampler = "sobol",
                                        .filter = "box",
                                        .samples_per_pixel = how->samples != 0 ? how->samples : 1,
                                        .seed = how->seed,
                                        .width = how->width,
                                        .height = how->height,
                                        .crop_x0 = how->crop[0],
                                        .crop_x1 = how->crop[1],
                                        .crop_y0 = how->crop[2],
                                        .crop_y1 = how->crop[3],
                                        .threads = run->options.threads,
                                        .progress = run->options.progress,
                                        .warnings = run->options.warnings,
                                        .gather = &lab_finalgather};
    return aur_renderer_render(how->renderer, &options, image, NULL, error);
}

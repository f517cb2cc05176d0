/* What an experiment calls: scenes and pictures. */
#include <aureole/ranks.h>
#include <string.h>
#include <unistd.h>

#include "program/lab/gather.h"
#include "program/lab/run.h"

#ifndef AUR_SCENES_FOLDER
#define AUR_SCENES_FOLDER "scenes"
#endif

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
    *stage = (lab_stage){0};
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

double lab_mean_product(const aur_image *x, const aur_image *a, const aur_image *b) {
    const size_t count = aur_image_width(x) * aur_image_height(x) * aur_image_channel_count(x);
    const float *const of_x = aur_image_data(x), *const of_a = aur_image_data(a);
    const float *const of_b = aur_image_data(b);
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i)
        sum += ((double)of_x[i] - (double)of_a[i]) * ((double)of_x[i] - (double)of_b[i]);
    return sum / (double)count;
}

/* The row of a picture; one that was made before an interruption has it already. */
static void list_picture(lab_run *run, const lab_image_position *place, const char *path) {
    const char *const file = strrchr(path, '/') + 1;
    for (size_t i = 0; i < report_rows(run->pictures); ++i)
        if (strcmp(report_cell(run->pictures, i, 2), file) == 0)
            return;
    report_text(run->pictures, place->view);
    report_text(run->pictures, place->name);
    report_text(run->pictures, file);
    report_text(run->pictures, place->reference ? "reference" : "");
    report_number(run->pictures, place->exposure, 4);
}

aur_result lab_picture(lab_run *run, const lab_image_position *place, const aur_image *image,
                       aur_error *error) {
    static const char *const extensions[] = {"exr", "png"};
    char path[AUR_ERROR_FILE_CAPACITY], name[256];
    snprintf(name, sizeof name, "%s%s%s", place->view != NULL ? place->view : "",
             place->view != NULL ? "-" : "", place->name);
    const aur_image_write_options options = {
        .size = sizeof options, .exposure = (float)place->exposure, .half = true};
    for (size_t i = 2; i-- > 0;) {
        lab_run_path(run, name, extensions[i], path, sizeof path);
        const aur_result result = aur_image_write(path, image, &options, error);
        if (result != AUR_OK)
            return result;
    }
    list_picture(run, place, path);
    return lab_run_save(run, run->pictures, "pictures", NULL, false, error);
}

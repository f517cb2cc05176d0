/* The three images of Keller 1994 (figure 1): living room, office and teapot rendered as in the paper, by
 * adaptive termination, Halton points per pixel and permuted lights, compared with path tracing of the same
 * scenes, which uses no radiosity and no triangle mesh. The paper publishes only their numbers of triangles.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study.h"

enum { SEEDS = 2 };

static const char *const columns[] = {"scene",        "triangles", "published",        "paths",
                                      "mean",         "path_mean", "mean_off_percent", "path_noise_percent",
                                      "rmse_percent", NULL};

/* In the order of the scenes. */
static const double triangles[KELLER_SCENES] = {12, 3604, 276, 1572};

/* The solution for the image: as many paths as epsilon requires. */
static aur_result solve(const lab_run *run, const aur_scene *scene, double epsilon,
                        aur_radiosity_description *found, aur_error *error) {
    aur_radiosity *radiosity = NULL;
    aur_radiosity_termination rule = {.size = sizeof rule};
    aur_radiosity_termination_init(epsilon, &rule, NULL);
    aur_result result =
        keller_start(run, scene, "halton", 0, 6, AUR_RADIOSITY_UNIFORM_ANGLE, &radiosity, error);
    if (result == AUR_OK)
        result = aur_radiosity_terminate(radiosity, &rule, NULL, error);
    if (result == AUR_OK)
        result = aur_radiosity_get_description(radiosity, found, error);
    aur_radiosity_destroy(radiosity);
    return result;
}

static aur_result render_image(lab_run *run, const lab_stage *stage, const char *integrator, size_t width,
                               size_t samples, uint64_t seed, aur_image **image, double *mean,
                               aur_error *error) {
    const lab_rendering how = {.renderer = stage->renderer,
                               .integrator = integrator,
                               .width = width,
                               .height = 3 * width / 4,
                               .samples = samples,
                               .seed = seed};
    double channels[4] = {0};
    aur_result result = lab_render(run, &how, image, error);
    if (result == AUR_OK)
        result = aur_image_mean(*image, channels, error);
    *mean = channels[3];
    return result;
}

static aur_result render_scene(lab_run *run, size_t index, const lab_stage *stage, aur_error *error) {
    enum { TRIANGLES, PATHS, RADIOSITY, TRACED, NOISE, RMSE, VALUES };
    const bool quick = lab_run_options(run)->quick;
    const size_t width = quick ? 32 : 160;
    const double epsilon = quick ? 3e-3 : 1e-4;
    const char *const name = keller_scene_at(index)->name;
    double values[VALUES] = {0}, means[SEEDS], other[4] = {0};
    char integrator[160];
    if (!lab_recall(run, name, VALUES, values)) {
        aur_radiosity_description found = {.size = sizeof found};
        aur_image *images[1 + SEEDS] = {NULL};
        snprintf(integrator, sizeof integrator,
                 "radiosity:sequence=halton,walk=paper,epsilon=%g,gather_samples=%d,"
                 "share_neighbours=true",
                 epsilon, quick ? 8 : 32);
        aur_result result = solve(run, stage->scene, epsilon, &found, error);
        if (result == AUR_OK)
            result = render_image(run, stage, integrator, width, quick ? 4 : 16, 0, &images[0],
                                  &values[RADIOSITY], error);
        for (size_t k = 0; k < SEEDS && result == AUR_OK; ++k)
            result = render_image(run, stage, "path", width, quick ? 8 : 32, 1 + k, &images[1 + k], &means[k],
                                  error);
        if (result == AUR_OK) {
            lab_image_position position = {.view = name, .name = "radiosity", .exposure = 0.5};
            result = lab_image(run, &position, images[0], error);
            position.name = "path";
            position.reference = true;
            if (result == AUR_OK)
                result = lab_image(run, &position, images[1], error);
        }
        if (result == AUR_OK)
            result = aur_image_mean(images[1], other, error);
        values[TRIANGLES] = (double)found.triangles;
        values[PATHS] = (double)found.paths;
        if (result == AUR_OK) {
            values[TRACED] = 0.5 * (means[0] + means[1]);
            values[NOISE] = 0.5 * fabs(means[0] - means[1]);
            values[RMSE] = sqrt(fmax(0.0, lab_mean_product(images[0], images[1], images[2])));
        }
        for (size_t k = 0; k <= SEEDS; ++k)
            aur_image_destroy(images[k]);
        if (result == AUR_OK)
            result = lab_save(run, name, VALUES, values, error);
        if (result != AUR_OK)
            return result;
    }
    const double percent = 100.0 / values[TRACED];
    lab_row(run, (const char *const[]){name, NULL}, 8,
            (const double[]){values[TRIANGLES], triangles[index], values[PATHS], values[RADIOSITY],
                             values[TRACED], percent * (values[RADIOSITY] - values[TRACED]),
                             percent * values[NOISE], percent * values[RMSE]});
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    aur_result result = AUR_OK;
    for (size_t s = 1; s < KELLER_SCENES && result == AUR_OK; ++s) {
        lab_stage stage;
        result = lab_stage_open(run, keller_scene_at(s)->realistic, 0, NULL, &stage, error);
        if (result == AUR_OK && stage.renderer != NULL)
            result = render_scene(run, s, &stage, error);
        lab_stage_close(&stage);
    }
    lab_note(run, "rmse_percent: of the image's pixels, from two independent path-traced images, whose "
                  "noise drops out");
    return result;
}

const lab_experiment lab_keller_1994_figure1 = {
    .name = "keller-1994-figure1",
    .reproduces = "Keller 1994, figure 1",
    .summary = "the living room, the office and the teapot, compared with path tracing",
    .columns = columns,
    .measured = "triangles",
    .published = "published",
    .factor = 1.5,
    .takes_no_set = "it renders images",
    .seconds = 16,
    .quick_seconds = 0.2,
    .run = run,
    .takes_no_scene = "its images are of Keller's scenes",
};

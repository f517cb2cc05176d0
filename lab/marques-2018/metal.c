/* Optimal weights of GGX lobes in images: balls and a floor of rough metal in a room, from normal to grazing
 * views, gathered with 32 directions per pixel by visible normals with weights p/q and with optimal weights
 * from tables. Measured by the RMSE over the pixels of metal against the same estimator with very many
 * directions, on the same photon map and the same primary hits; and by the image mean against path tracing,
 * with the photon map's bias removed. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "program/lab/gather.h"
#include "program/lab/lab.h"

enum { MOST_SEEDS = 32, WIDTH = 48, HEIGHT = 32 };

#define BALL(x_, z_, metal_)                                                                                 \
    "<shape type='sphere'><point name='center' x='" x_ "' y='-0.78' z='" z_                                  \
    "'/><float name='radius' value='0.2'/><ref id='" metal_ "'/></shape>"
#define METAL(name_, alpha_)                                                                                 \
    "<bsdf type='roughconductor' id='" name_ "'><string name='material' value='Al'/>"                        \
    "<string name='distribution' value='ggx'/><float name='alpha' value='" alpha_ "'/></bsdf>"
#define DIFFUSE(name_, color_)                                                                               \
    "<bsdf type='twosided' id='" name_ "'><bsdf type='diffuse'><rgb name='reflectance' value='" color_       \
    "'/></bsdf></bsdf>"
#define WALL(turn_, move_, of_)                                                                              \
    "<shape type='rectangle'><transform name='to_world'><rotate " turn_ "/><translate " move_                \
    "/></transform><ref id='" of_ "'/></shape>"

static const char room[] =
    "<scene version='3.0.0'><sensor type='perspective'><float name='fov' value='55'/>"
    "<transform name='to_world'><lookat origin='0, -0.55, -0.95' target='0, -0.6, 1' up='0, 1, 0'/>"
    "</transform></sensor>" DIFFUSE("white", "0.7, 0.7, 0.7") DIFFUSE("red", "0.6, 0.1, 0.1")
        DIFFUSE("green", "0.1, 0.5, 0.1") METAL("smooth", "0.1") METAL("medium", "0.2") METAL("rough", "0.5")
            WALL("x='1' angle='-90'", "y='-1'", "medium") WALL("x='1' angle='90'", "y='1'", "white")
                WALL("y='1' angle='180'", "z='1'", "white") WALL("y='1' angle='0'", "z='-1'", "white")
                    WALL("y='1' angle='90'", "x='-1'", "red")
                        WALL("y='1' angle='-90'", "x='1'",
                             "green") "<shape type='rectangle'><transform name='to_world'><scale "
                                      "value='0.4'/><rotate x='1' angle='90'/>"
                                      "<translate y='0.98'/></transform><emitter type='area'><rgb "
                                      "name='radiance' value='9, 9, 9'/></emitter>"
                                      "</shape>" BALL("-0.5", "0.3", "smooth") BALL("0", "0.2", "medium")
                                          BALL("0.5", "0.3", "rough") "</scene>";

static const struct {
    const char *name, *keys;
} lights[] = {{"indirect", "direct=none"}, {"all, by gather rays", "direct=gather"}};

typedef enum way { RATIO, OPTIMAL, WAYS } way;

static const char *const weights[WAYS] = {"ratio", "osw"};

static const char *const columns[] = {"light",    "set",       "weights",  "rmse", "over_ratio",
                                      "over_low", "over_high", "mean_off", NULL};

typedef struct metal_study {
    lab_run *run;
    aur_renderer *renderer;
    aur_image *reference;
    size_t seeds;
} metal_study;

static aur_result render(const metal_study *study, const char *integrator, size_t samples, uint64_t seed,
                         aur_image **image, aur_error *error) {
    const lab_options *const lab = lab_run_options(study->run);
    const aur_render_options options = {.size = sizeof options,
                                        .integrator = integrator,
                                        .sampler = "sobol",
                                        .filter = "box",
                                        .samples_per_pixel = samples,
                                        .seed = seed,
                                        .width = WIDTH,
                                        .height = HEIGHT,
                                        .threads = lab->threads,
                                        .progress = lab->progress,
                                        .warnings = lab->warnings,
                                        .gather = &lab_finalgather};
    return aur_renderer_render(study->renderer, &options, image, NULL, error);
}

static aur_result gather(const metal_study *study, const char *light, const char *set, const char *how,
                         size_t directions, size_t seed, aur_image **image, aur_error *error) {
    char integrator[300];
    snprintf(integrator, sizeof integrator,
             "finalgather-lab:component=glossy,%s,pixel=centre,edges=0,decorrelation=random,photons=200000,"
             "photons_per_texel=64,short_rays=0,pattern=%s,weights=%s,rotations=4,glossy_samples=%zu,pattern_"
             "seed=%zu",
             light, set, how, directions, seed);
    return render(study, integrator, 1, 0, image, error);
}

/* The mean square error over the pixels where the reference is nonzero, and the error of the mean. */
static double judge(const metal_study *study, const aur_image *image, double *off) {
    const float *const a = aur_image_data(image), *const b = aur_image_data(study->reference);
    double squares = 0.0, sum = 0.0, all = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < (size_t)3 * WIDTH * HEIGHT; ++i) {
        if (b[i] == 0.0f)
            continue;
        squares += pow((double)a[i] - (double)b[i], 2);
        sum += (double)a[i];
        all += (double)b[i];
        ++count;
    }
    *off += (sum / all - 1.0) / (double)study->seeds;
    return squares / (double)count;
}

static aur_result compare(metal_study *study, size_t light, const char *set, aur_error *error) {
    double mse[WAYS][MOST_SEEDS], off[WAYS] = {0};
    for (size_t seed = 0; seed < study->seeds; ++seed)
        for (size_t w = 0; w < WAYS; ++w) {
            aur_image *image = NULL;
            const aur_result result =
                gather(study, lights[light].keys, set, weights[w], 32, 1 + seed, &image, error);
            if (result != AUR_OK)
                return result;
            mse[w][seed] = judge(study, image, &off[w]);
            aur_image_destroy(image);
        }
    double base, mean, half, linear[MOST_SEEDS], unused;
    lab_mean_interval(study->seeds, mse[RATIO], &base, &half);
    for (size_t w = 0; w < WAYS; ++w) {
        lab_mean_interval(study->seeds, mse[w], &mean, &half);
        const double ratio = mean / base; /* of two means over the same seeds, by its linearised form */
        for (size_t k = 0; k < study->seeds; ++k)
            linear[k] = (mse[w][k] - ratio * mse[RATIO][k]) / base;
        lab_mean_interval(study->seeds, linear, &unused, &half);
        lab_text(study->run, lights[light].name);
        lab_text(study->run, set);
        lab_text(study->run, weights[w]);
        lab_number(study->run, sqrt(mean));
        lab_number(study->run, 100.0 * (sqrt(ratio) - 1.0));
        lab_number(study->run, 100.0 * (sqrt(fmax(0.0, ratio - half)) - 1.0));
        lab_number(study->run, 100.0 * (sqrt(ratio + half) - 1.0));
        lab_number(study->run, 100.0 * off[w]);
    }
    return AUR_OK;
}

static double mean_of(const aur_image *image) {
    double sum = 0.0;
    for (size_t i = 0; i < (size_t)3 * WIDTH * HEIGHT; ++i)
        sum += (double)aur_image_data(image)[i] / (3.0 * WIDTH * HEIGHT);
    return sum;
}

/* The image mean against path tracing, with the same number of seeds. */
static aur_result against_path(const metal_study *study, aur_error *error) {
    static const char *const integrators[] = {
        "path", "finalgather-lab:weights=osw,debias=true,rotations=4,glossy_samples=16,diffuse_samples=16,"
                "photons=100000"};
    double means[2][MOST_SEEDS], mean[2], half[2];
    for (size_t k = 0; k < 2; ++k) {
        for (size_t seed = 0; seed < study->seeds; ++seed) {
            aur_image *image = NULL;
            const aur_result result = render(study, integrators[k], 16, 1 + seed, &image, error);
            if (result != AUR_OK)
                return result;
            means[k][seed] = mean_of(image);
            aur_image_destroy(image);
        }
        lab_mean_interval(study->seeds, means[k], &mean[k], &half[k]);
    }
    lab_note(study->run,
             "means over %zu seeds: path %.6f +- %.6f, optimal weights without the photon map's bias %.6f +- "
             "%.6f (95 %%), %.2f of both intervals together apart",
             study->seeds, mean[0], half[0], mean[1], half[1],
             fabs(mean[1] - mean[0]) / hypot(half[0], half[1]));
    return AUR_OK;
}

static aur_result study_room(metal_study *study, aur_error *error) {
    static const char *const sets[] = {"spherical-fibonacci", "sobol"};
    const bool quick = lab_run_options(study->run)->quick;
    aur_result result = AUR_OK;
    for (size_t light = 0; light < (quick ? 1 : 2) && result == AUR_OK; ++light) {
        result = gather(study, lights[light].keys, sets[0], "ratio", quick ? 256 : 8192, 0, &study->reference,
                        error);
        for (size_t s = 0; s < (quick ? 1 : 2) && result == AUR_OK; ++s)
            result = compare(study, light, sets[s], error);
        aur_image_destroy(study->reference);
        study->reference = NULL;
    }
    return result == AUR_OK && !quick ? against_path(study, error) : result;
}

static aur_result run(lab_run *run, aur_error *error) {
    aur_scene *scene = NULL;
    metal_study study = {.run = run, .seeds = lab_run_options(run)->quick ? 2 : MOST_SEEDS};
    aur_result result = aur_scene_load_memory("room.xml", sizeof room - 1, room, NULL, &scene, error);
    if (result == AUR_OK)
        result = aur_renderer_create(scene, &study.renderer, error);
    if (result == AUR_OK)
        result = study_room(&study, error);
    aur_renderer_destroy(study.renderer);
    aur_scene_destroy(scene);
    return result;
}

const lab_experiment lab_marques_2018_metal = {
    .name = "marques-2018-metal",
    .reproduces = "Marques 2018, for GGX lobes, in images",
    .summary = "rough metals gathered with weights p/q and with optimal ones from tables, and against path",
    .columns = columns,
    .takes_no_set = "it compares weights, not sets",
    .seconds = 69,
    .quick_seconds = 0.9,
    .run = run,
    .takes_no_scene = "its room has metals of three roughnesses",
};

/* Compares sets as the directions of an integrator in one scene, which `--scene` names. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "program/lab/lab.h"

enum { SMALLEST = 8, MOST_SIZES = 5, MOST_REPEATS = 16 };

static const char *const columns[] = {"set", "directions", "rmse", "low", "high", "over_random", NULL};

typedef struct study {
    lab_run *run;
    lab_stage stage;
    size_t width, sizes, repeats;
    aur_image *references[2];
    double random[MOST_SIZES];
} study;

/* The integrator with SET and N replaced by the set and the number of directions. */
static void name_integrator(const study *s, const char *set, size_t count, char text[1024]) {
    const char *from = lab_parameter_text(s->run, "integrator");
    size_t at = 0;
    while (*from != '\0' && at + 1 < 1024) {
        if (strncmp(from, "=SET", 4) == 0) {
            at += (size_t)snprintf(text + at, 1024 - at, "=%s", set);
            from += 4;
        } else if (strncmp(from, "=N", 2) == 0 && (from[2] == ',' || from[2] == '\0')) {
            at += (size_t)snprintf(text + at, 1024 - at, "=%zu", count);
            from += 2;
        } else {
            text[at++] = *from++;
        }
    }
    text[at < 1024 ? at : 1023] = '\0';
}

static aur_result render(const study *s, const char *set, size_t count, uint64_t seed, aur_image **image,
                         aur_error *error) {
    char integrator[1024];
    name_integrator(s, set, count, integrator);
    const lab_rendering how = {.renderer = s->stage.renderer,
                               .integrator = integrator,
                               .width = s->width,
                               .height = s->width,
                               .samples = 1,
                               .seed = seed};
    return lab_render(s->run, &how, image, error);
}

/* Two images of many directions with independent errors, which cancel in lab_mean_product. */
static aur_result find_references(study *s, aur_error *error) {
    aur_result result = AUR_OK;
    for (size_t k = 0; k < 2 && result == AUR_OK; ++k)
        result = render(s, "spherical-fibonacci", 4096, 1000 + k, &s->references[k], error);
    const lab_image_position position = {.view = "view", .name = "reference", .reference = true};
    return result == AUR_OK ? lab_image(s->run, &position, s->references[0], error) : result;
}

static aur_result measure(study *s, const char *set, size_t count, double *squares, aur_error *error) {
    char key[300], name[128];
    snprintf(key, sizeof key, "%.200s %zu", set, count);
    if (lab_recall(s->run, key, s->repeats, squares))
        return AUR_OK;
    aur_result result = s->references[0] == NULL ? find_references(s, error) : AUR_OK;
    for (size_t k = 0; k < s->repeats && result == AUR_OK; ++k) {
        aur_image *image = NULL;
        result = render(s, set, count, 1 + k, &image, error);
        if (result == AUR_OK)
            squares[k] = lab_mean_product(image, s->references[0], s->references[1]);
        snprintf(name, sizeof name, "%.80s, %zu", set, count);
        if (result == AUR_OK && k == 0)
            result =
                lab_image(s->run, &(const lab_image_position){.view = "view", .name = name}, image, error);
        aur_image_destroy(image);
    }
    return result == AUR_OK ? lab_save(s->run, key, s->repeats, squares, error) : result;
}

static aur_result add_set(study *s, const char *set, aur_error *error) {
    double counts[MOST_SIZES], rms[MOST_SIZES], squares[MOST_REPEATS];
    size_t row_count = 0;
    for (size_t i = 0; i < s->sizes; ++i) {
        const size_t count = (size_t)SMALLEST << i;
        const aur_result result = measure(s, set, count, squares, error);
        if (result != AUR_OK && lab_forgive(s->run, set, result, error) != AUR_OK)
            return result;
        if (result != AUR_OK)
            continue;
        const lab_interval rmse = lab_root_mean(s->repeats, squares);
        if (strcmp(set, "random") == 0)
            s->random[i] = rmse.value;
        counts[row_count] = (double)count;
        rms[row_count++] = rmse.value;
        lab_row(s->run, (const char *const[]){set, NULL}, 5,
                (const double[]){(double)count, rmse.value, rmse.low, rmse.high,
                                 s->random[i] > 0.0 ? rmse.value / s->random[i] : NAN});
    }
    if (row_count >= 3)
        lab_note(s->run, "%s: error falls as N^%.3f", set, lab_slope(row_count, counts, rms).value);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    const double width = lab_parameter_number(run, "width");
    study s = {.run = run,
               .sizes = options->quick ? 3 : MOST_SIZES,
               .repeats = options->quick ? 4 : MOST_REPEATS,
               .width = options->quick ? 32 : (size_t)width};
    if (!(width >= 1.0 && width <= 4096.0))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "width must be 1 to 4096");
    aur_result result = lab_stage_open(run, "cornell-box/glossy.xml", 0, NULL, &s.stage, error);
    const char *const sets[] = {"random", "sobol", "halton", "r2", "spherical-fibonacci", options->set};
    for (size_t i = 0; i < sizeof sets / sizeof sets[0] && result == AUR_OK; ++i)
        if (sets[i] != NULL)
            result = add_set(&s, sets[i], error);
    aur_image_destroy(s.references[0]);
    aur_image_destroy(s.references[1]);
    lab_stage_close(&s.stage);
    return result;
}

static const lab_parameter parameters[] = {
    {"scene", NULL, "file of the scene; the glossy Cornell box by default"},
    {"integrator", "ao:pixel=centre,pattern=SET,samples=N,max_distance=150",
     "integrator whose SET and N are replaced by the set and the number of directions"},
    {"width", "64", "pixels in width and height; 32 in the quick form"},
    {.name = NULL},
};

static const report_plot plots[] = {
    {.name = "rmse",
     .title = "Root mean square error of the image against directions per pixel",
     .x = "directions",
     .y = "rmse",
     .low = "low",
     .high = "high",
     .series = "set",
     .log_x = true,
     .log_y = true},
    {.name = NULL},
};

const lab_experiment lab_aureole_scene = {
    .name = "aureole-scene",
    .reproduces = "none: any scene, --scene",
    .summary = "root mean square error of images by every set of directions in one scene",
    .columns = columns,
    .plots = plots,
    .seconds = 4,
    .quick_seconds = 0.3,
    .run = run,
    .parameters = parameters,
};

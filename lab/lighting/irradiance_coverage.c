/* Coverage of the intervals of aur_irradiance_estimate and of aur_estimate, with fixed sizes and with a
 * target error. */
#include <aureole-lighting/irradiance.h>
#include <aureole/estimate.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "coverage.h"

static const double PI = 3.14159265358979323846;

enum { SENSORS = 3 };

typedef struct coverage_case {
    const char *name, *scene;
    double positions[SENSORS][3], normals[SENSORS][3];
    double target_error;
    /* The reference at a sensor; NULL: the mean over all runs of fixed size. */
    double (*reference)(const double position[3]);
} coverage_case;

/* A closed room whose walls emit 1 and reflect half. */
static double furnace(const double position[3]) {
    (void)position;
    return 2.0 * PI;
}

/* An emitter of 2 x 2 in the plane z = 2. A screen in z = 1 blocks one side of the line from the sensor
 * through x = 0. The visible part is a rectangle, computed from four with a corner above the sensor (Lambert
 * 1760). */
static double corner(double a, double b) {
    const double h = 2.0, p = sqrt(a * a + h * h), q = sqrt(b * b + h * h);
    return 0.5 * (a / p * atan(b / p) + b / q * atan(a / q));
}

static double screened(const double position[3]) {
    const double x0 = fmax(-1.0, -position[0]) - position[0], x1 = 1.0 - position[0];
    const double y0 = -1.0 - position[1], y1 = 1.0 - position[1];
    return corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
}

/* A sky of radiance 1 above a practically infinite black wall of height 1 in the plane x = 0. */
static double next_to_wall(const double position[3]) {
    return 0.5 * PI * (1.0 + position[0] / hypot(position[0], 1.0));
}

static const coverage_case cases[] = {
    {"furnace",
     "<scene version='3.0.0'><shape type='cube'><boolean name='flip_normals' value='true'/>"
     "<bsdf type='diffuse'><rgb name='reflectance' value='0.5'/></bsdf><emitter "
     "type='area'/></shape></scene>",
     {{0, 0, 0}, {0.9, 0.3, 0.2}, {0.1, 0.2, -0.9}},
     {{0, 0, 1}, {1, 1, 0}, {0, 0, 1}},
     0.01,
     furnace},
    {"screen",
     "<scene version='3.0.0'><shape type='rectangle'><transform name='to_world'><rotate x='1' angle='180'/>"
     "<translate z='2'/></transform><emitter type='area'/></shape><shape type='rectangle'>"
     "<transform name='to_world'><translate x='-1'/><scale x='9' y='9'/><translate z='1'/></transform>"
     "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf></shape></scene>",
     {{0, 0, 0}, {-0.3, 0.1, 0}, {0.4, 0.2, 0}},
     {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
     0.001,
     screened},
    {"wall",
     "<scene version='3.0.0'><emitter type='constant'/><shape type='rectangle'><transform name='to_world'>"
     "<rotate y='1' angle='90'/><scale y='2000' z='1'/></transform>"
     "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf></shape></scene>",
     {{0.2, 0, 0}, {1, 0, 0}, {3, 0, 0}},
     {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
     0.005,
     next_to_wall},
    {"cornell-box",
     NULL,
     {{278, 10, 280}, {100, 400, 200}, {278, 540, 280}},
     {{0, 1, 0}, {0, 0, 1}, {0, -1, 0}},
     0.02,
     NULL},
};

static aur_result estimate(lab_run *run, const aur_scene *scene, const coverage_case *given,
                           double target_error, size_t seed, aur_irradiance *results, aur_error *error) {
    const aur_sensors_view sensors = {.size = sizeof sensors,
                                      .count = SENSORS,
                                      .positions = given->positions[0],
                                      .normals = given->normals[0]};
    aur_irradiance_options options = {.size = sizeof options};
    aur_irradiance_options_init(&options, NULL);
    options.seed = seed;
    options.error = target_error;
    options.threads = lab_run_options(run)->threads;
    return aur_irradiance_estimate(scene, &sensors, &options, sizeof *results, results, error);
}

/* Every seed with a fixed number of directions, and to the target error. */
static aur_result study(lab_run *run, const aur_scene *scene, const coverage_case *given, lab_tally pooled[2],
                        aur_error *error) {
    const size_t seeds = lab_run_options(run)->quick ? 60 : 1000;
    aur_irradiance(*const results)[SENSORS] = malloc(2 * seeds * sizeof *results);
    if (results == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    aur_result result = AUR_OK;
    for (size_t i = 0; i < 2 * seeds && result == AUR_OK; ++i)
        result =
            estimate(run, scene, given, i < seeds ? 0.0 : given->target_error, i % seeds, results[i], error);
    double reference[SENSORS] = {0};
    for (size_t s = 0; s < SENSORS && result == AUR_OK; ++s) {
        if (given->reference != NULL)
            reference[s] = given->reference(given->positions[s]);
        for (size_t i = 0; i < seeds && given->reference == NULL; ++i)
            reference[s] += results[i][s].value[AUR_IRRADIANCE_TOTAL][3] / (double)seeds;
    }
    for (size_t kind = 0; kind < 2 && result == AUR_OK; ++kind) {
        lab_tally t = {0};
        for (size_t i = 0; i < seeds * SENSORS; ++i) {
            const aur_irradiance *const r = &results[kind * seeds + i / SENSORS][i % SENSORS];
            lab_tally_count(&t, r->value[AUR_IRRADIANCE_TOTAL][3], r->half_width[3], reference[i % SENSORS],
                            (double)r->directions);
        }
        lab_tally_report(run, given->name, kind == 0 ? 0.0 : given->target_error, &t);
        lab_tally_add(&pooled[kind], &t);
    }
    free(results);
    return result;
}

/* A user's functional: the mean of a function with a kink, and the mean of its square. */
static aur_result moments(void *user, const aur_estimate_points *points, double *values, aur_error *error) {
    (void)user;
    (void)error;
    values[0] = values[1] = 0.0;
    for (size_t i = 0; i < points->count; ++i) {
        const double *const u = points->points + points->dimension * i;
        const double f = fabs(u[0] - u[1]) + (u[2] < 0.3 * u[0] ? 1.0 : 0.0);
        values[0] += points->weights[i] * f;
        values[1] += points->weights[i] * f * f;
    }
    return AUR_OK;
}

static aur_result study_functional(lab_run *run, lab_tally pooled[2], aur_error *error) {
    const double reference = 1.0 / 3.0 + 0.15; /* E|u - v| = 1/3, E .3 u = .15 */
    const size_t seeds = lab_run_options(run)->quick ? 500 : 3000;
    for (size_t kind = 0; kind < 2; ++kind) {
        lab_tally t = {0};
        for (size_t seed = 0; seed < seeds; ++seed) {
            aur_estimate_options options = {.size = sizeof options};
            aur_estimate_options_init(3, 2, &options, NULL);
            aur_estimated found[2];
            aur_estimate_report how = {.size = sizeof how};
            options.seed = seed;
            options.relative = kind == 0 ? 0.0 : 0.005;
            options.evaluations = kind == 0 ? 1024 : UINT64_C(1) << 20;
            const aur_result result = aur_estimate(moments, NULL, &options, found, &how, error);
            if (result != AUR_OK)
                return result;
            lab_tally_count(&t, found[0].value, found[0].half_width, reference, (double)how.evaluations);
        }
        lab_tally_report(run, "functional", kind == 0 ? 0.0 : 0.005, &t);
        lab_tally_add(&pooled[kind], &t);
    }
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    lab_tally pooled[2] = {{0}, {0}};
    aur_result result = AUR_OK;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0] && result == AUR_OK; ++i) {
        aur_scene *scene = NULL;
        result = cases[i].scene != NULL
                     ? aur_scene_load_memory(cases[i].name, strlen(cases[i].scene), cases[i].scene, NULL,
                                             &scene, error)
                     : lab_load_scene(run, "cornell-box/cornell-box.xml", 0, NULL, &scene, error);
        if (result == AUR_OK)
            result = study(run, scene, &cases[i], pooled, error);
        aur_scene_destroy(scene);
    }
    if (result == AUR_OK)
        result = study_functional(run, pooled, error);
    if (result != AUR_OK)
        return result;
    lab_tally_report(run, "pooled", 0.0, &pooled[0]);
    lab_tally_report(run, "pooled to errors", 1.0, &pooled[1]);
    return AUR_OK;
}

const lab_experiment lab_irradiance_coverage = {
    .name = "irradiance-coverage",
    .reproduces = "docs/lighting-accuracy.md",
    .summary = "how often intervals of irradiance and of aur_estimate hold, also of runs to a target error",
    .columns = lab_tally_of_directions,
    .takes_no_set = "it judges aureole irradiance, which chooses its points",
    .seconds = 250,
    .quick_seconds = 13,
    .run = run,
    .takes_no_scene = "its answers are known for given scenes only",
};

/* Analytical lighting test cases in the style of CIE 171:2006: `aureole irradiance` compared with references
 * by two derivations. */
#include <aureole-lighting/irradiance.h>
#include <aureole/statistics.h>
#include <aureole/text.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "cases.h"
#include "program/lab/lab.h"

static const char *const columns[] = {"case",        "derivations",     "points",  "references_differ",
                                      "worst_error", "standard_errors", "outside", "verdict",
                                      NULL};

/* Tolerance: numbers are relative to the case's largest value. In addition to the intervals 1e-6 is allowed,
 * because rays are traced in single precision: a value is a product of about ten numbers, each rounded by up
 * to 6e-8, equally in all randomisations. */
static const double REFERENCES = 1e-9, STANDARD_ERRORS = 5.0;
static const double WORST[2] = {2e-3, 3e-2}, ALLOWED = 1e-6;
/* Student's t for 99 % and 16 randomisations. */
static const double STUDENT = 2.9467;
enum { DIRECTIONS = 1 << 16, DIRECTIONS_QUICK = 1 << 12 };

typedef struct study {
    double largest, differ, worst, standard, seconds;
    size_t points, outside;
} study;

static double cpu_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static aur_result estimate(const lab_run *run, const lab_case *test_case, aur_irradiance *results,
                           study *found, aur_error *error) {
    const lab_options *const lab = lab_run_options(run);
    double positions[3 * LAB_CASE_POINTS], normals[3 * LAB_CASE_POINTS];
    char text[LAB_CASE_SCENE + 64];
    for (size_t i = 0; i < 3 * test_case->count; ++i) {
        positions[i] = test_case->receivers[i / 3].position[i % 3];
        normals[i] = test_case->receivers[i / 3].normal[i % 3];
    }
    const int size = snprintf(text, sizeof text, "<scene version='3.0.0'>%s</scene>", test_case->scene);
    aur_scene *scene = NULL;
    const double begin = cpu_seconds();
    aur_result result = aur_scene_load_memory("case.xml", (size_t)size, text, NULL, &scene, error);
    const aur_sensors_view sensors = {
        .size = sizeof sensors, .count = test_case->count, .positions = positions, .normals = normals};
    aur_irradiance_options options = {.size = sizeof options};
    aur_irradiance_options_init(&options, NULL);
    options.directions = test_case->more * (lab->quick ? DIRECTIONS_QUICK : DIRECTIONS);
    options.threads = lab->threads;
    if (result == AUR_OK)
        result = aur_irradiance_estimate(scene, &sensors, &options, sizeof *results, results, error);
    aur_scene_destroy(scene);
    found->seconds = cpu_seconds() - begin;
    return result;
}

static void compare(const lab_case *test_case, const aur_irradiance *results, double allowed, study *found) {
    for (size_t i = 0; i < test_case->count; ++i)
        found->largest = fmax(found->largest, fabs(test_case->closed[i]));
    found->points = test_case->count;
    for (size_t i = 0; i < test_case->count; ++i) {
        const double off = fabs(results[i].value[AUR_IRRADIANCE_TOTAL][0] - test_case->closed[i]);
        const double beyond = fmax(off - allowed * found->largest, 0.0);
        const double error = results[i].error[AUR_IRRADIANCE_TOTAL][0];
        found->differ =
            fmax(found->differ, fabs(test_case->closed[i] - test_case->smooth[i]) / found->largest);
        found->worst = fmax(found->worst, off / found->largest);
        found->standard = fmax(found->standard, beyond > 0.0 ? beyond / error : 0.0);
        found->outside += beyond > STUDENT * error;
    }
}

/* Writes the scene as NAME.xml, and its points with both references and the result as NAME.csv, for other
 * programs (bench/peers/cases.py). */
static aur_result write_case(const lab_run *run, const char *name, const lab_case *test_case,
                             const aur_irradiance *results, aur_error *error) {
    char path[4096], text[LAB_CASE_SCENE + 256 * LAB_CASE_POINTS];
    const char *const folder = lab_run_options(run)->folder;
    aur_format(path, sizeof path, "%s/analytical-cases-%s.xml", folder, name);
    size_t used =
        (size_t)aur_format(text, sizeof text, "<scene version='3.0.0'>%s</scene>\n", test_case->scene);
    aur_result result = aur_file_write(path, used, text, error);
    aur_format(path, sizeof path, "%s/analytical-cases-%s.csv", folder, name);
    used = (size_t)aur_format(text, sizeof text, "x,y,z,nx,ny,nz,closed,smooth,value,error\n");
    for (size_t i = 0; i < test_case->count; ++i) {
        const double *const at = test_case->receivers[i].position, *const up = test_case->receivers[i].normal;
        const double numbers[10] = {at[0],
                                    at[1],
                                    at[2],
                                    up[0],
                                    up[1],
                                    up[2],
                                    test_case->closed[i],
                                    test_case->smooth[i],
                                    results[i].value[AUR_IRRADIANCE_TOTAL][0],
                                    results[i].error[AUR_IRRADIANCE_TOTAL][0]};
        for (size_t k = 0; k < 10; ++k)
            used += (size_t)aur_format(text + used, sizeof text - used, "%.12g%c", numbers[k],
                                       k < 9 ? ',' : '\n');
    }
    return result != AUR_OK ? result : aur_file_write(path, used, text, error);
}

/* The number of points outside their 99 % intervals that is exceeded with probability one in a thousand
 * (binomial tail). */
static size_t allowed_outside(size_t points) {
    double term = pow(0.99, (double)points), sum = term;
    size_t count = 0;
    while (sum < 0.999 && count < points) {
        ++count;
        term *= 0.01 / 0.99 * (double)(points - count + 1) / (double)count;
        sum += term;
    }
    return count;
}

static aur_result run(lab_run *run, aur_error *error) {
    const bool quick = lab_run_options(run)->quick;
    const double worst = WORST[quick];
    lab_case *const test_case = malloc(sizeof *test_case);
    aur_irradiance results[LAB_CASE_POINTS];
    aur_result result = AUR_OK;
    size_t points = 0, outside = 0, failed = 0, cases = 0;
    for (const lab_case_row *row; test_case != NULL && result == AUR_OK && (row = lab_case_at(cases)) != NULL;
         ++cases) {
        study found = {0};
        test_case->count = test_case->scene_size = 0;
        test_case->more = 1;
        row->build(test_case, row->parameter);
        result = estimate(run, test_case, results, &found, error);
        if (result != AUR_OK)
            break;
        compare(test_case, results, ALLOWED, &found);
        result = write_case(run, row->name, test_case, results, error);
        if (result != AUR_OK)
            break;
        const bool good =
            found.differ <= REFERENCES && found.worst <= worst && found.standard <= STANDARD_ERRORS;
        failed += !good;
        points += found.points;
        outside += found.outside;
        lab_text(run, row->name);
        lab_text(run, row->derivations);
        lab_number(run, (double)found.points);
        lab_number(run, found.differ);
        lab_number(run, found.worst);
        lab_number(run, found.standard);
        lab_number(run, (double)found.outside);
        lab_time(run, row->name, found.seconds);
        lab_text(run, good ? "holds" : "fails");
    }
    free(test_case);
    if (test_case == NULL || result != AUR_OK)
        return test_case == NULL ? AUR_ERROR_MEMORY : result;
    const bool probability = outside <= allowed_outside(points);
    lab_note(run,
             "%zu of %zu cases hold: references within %g of the largest value, every point within %g, none "
             "beyond %g standard errors",
             cases - failed, cases, REFERENCES, worst, STANDARD_ERRORS);
    lab_note(run,
             "%zu of %zu points are outside of their intervals of 99 %%; at most %zu expected by chance "
             "(probability .999)",
             outside, points, allowed_outside(points));
    lab_note(run, "verdict: %s", failed == 0 && probability ? "all holds" : "something fails");
    return AUR_OK;
}

const lab_experiment lab_analytical_cases = {
    .name = "analytical-cases",
    .reproduces = "docs/lighting-accuracy.md",
    .summary = "lighting cases with closed forms: sources, openings, glass, obstructions, reflections, skies",
    .columns = columns,
    .takes_no_set = "it judges aureole irradiance, which chooses its points",
    .seconds = 9,
    .quick_seconds = 1,
    .run = run,
    .takes_no_scene = "its answers are known for given scenes only",
};

/* Coverage of the intervals of view factors, sky factors and radiosities. */
#include <aureole-lighting/view_factors.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "coverage.h"

static const double CORNERS[8][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
/* Counter-clockwise seen from outside. */
static const size_t FACES[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                   {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

static void write_box(FILE *file, const double low[3], const double high[3], bool inside, size_t first) {
    for (size_t i = 0; i < 8; ++i)
        fprintf(file, "v %.17g %.17g %.17g\n", low[0] + CORNERS[i][0] * (high[0] - low[0]),
                low[1] + CORNERS[i][1] * (high[1] - low[1]), low[2] + CORNERS[i][2] * (high[2] - low[2]));
    for (size_t f = 0; f < 6; ++f) {
        fprintf(file, "g side-%zu-%zu\nf", first, f);
        for (size_t k = 0; k < 4; ++k)
            fprintf(file, " %zu", first + 1 + FACES[f][inside ? 3 - k : k]);
        fputc('\n', file);
    }
}

/* A closed room of 3 x 4 x 2.5; a court: a floor of 4 x 4 with a block on it, under the sky; or four towers
 * of different heights. */
typedef enum coverage_mesh { ROOM, COURT, TOWERS } coverage_mesh;

static void write_towers(FILE *file) {
    static const double heights[4] = {0.5, 2.5, 1.75, 1.0};
    for (size_t i = 0; i < 4; ++i) {
        const double x = 2.0 * (double)(i % 2) + 0.5, y = 2.0 * (double)(i / 2) + 0.5;
        const double low[3] = {x, y, 0.0}, high[3] = {x + 1.0, y + 1.0, heights[i]};
        write_box(file, low, high, false, 8 * i);
    }
    fputs("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\ng floor\nf 33 34 35 36\n", file);
}

static aur_result load(const lab_run *run, coverage_mesh mesh, bool group, aur_facets **facets,
                       aur_error *error) {
    char path[4096];
    snprintf(path, sizeof path, "%s/factors-coverage.obj", lab_run_options(run)->folder);
    char *text = NULL;
    size_t size = 0;
    FILE *const file = open_memstream(&text, &size);
    if (file == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    if (mesh == TOWERS) {
        write_towers(file);
    } else if (mesh == COURT) {
        write_box(file, (const double[3]){1, 1.5, 0.25}, (const double[3]){2, 2.5, 1.75}, false, 0);
        fputs("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\ng floor\nf 9 10 11 12\n", file);
    } else {
        write_box(file, (const double[3]){0, 0, 0}, (const double[3]){3, 4, 2.5}, true, 0);
    }
    aur_result result = fclose(file) == 0 ? aur_file_write(path, size, text, error)
                                          : aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    free(text);
    aur_facets_options options = {.size = sizeof options};
    aur_facets_options_init(&options, NULL);
    options.group = group;
    if (result == AUR_OK)
        result = aur_facets_load(path, &options, facets, error);
    remove(path);
    return result;
}

/* The numbers of one run, each with its half width: the factors above the diagonal, row by row, or sky
 * factors, or radiosities. */
typedef enum coverage_kind { FACTORS, SKY, RADIOSITIES, BY_MATRIX } coverage_kind;

typedef struct coverage_case {
    const char *name;
    coverage_mesh mesh;
    bool group, half_planes;
    coverage_kind kind;
    size_t rays;
} coverage_case;

static const coverage_case cases[] = {
    {"room facets", ROOM, false, false, FACTORS, 256},
    {"room walls", ROOM, true, false, FACTORS, 256},
    {"court facets", COURT, false, false, FACTORS, 256},
    {"court sky", COURT, false, false, SKY, 256},
    {"radiosities", COURT, false, false, RADIOSITIES, 256},
    {"radiosities by matrix", COURT, false, true, BY_MATRIX, 256},
    {"towers sky by half planes", TOWERS, false, true, SKY, 256},
    {"walls' sky by half planes", TOWERS, true, true, SKY, 256},
};

enum { MOST_NUMBERS = 256 };

static aur_result of_matrix(const aur_facets *facets, const aur_view_factors_options *options,
                            coverage_kind kind, double *values, double *half, size_t *count,
                            aur_error *error) {
    aur_view_factors *factors = NULL;
    aur_view_factors_matrix m = {.size = sizeof m};
    aur_view_factors_description d = {.size = sizeof d};
    aur_result result = aur_view_factors_create(facets, options, &factors, error);
    if (result == AUR_OK)
        result = aur_view_factors_get_matrix(factors, &m, error);
    if (result == AUR_OK)
        result = aur_view_factors_get_description(factors, &d, error);
    /* Pairs that no ray found use the bound `unseen` of the statistics. */
    for (size_t i = 0; i < m.rows * m.rows && kind == FACTORS && result == AUR_OK; ++i)
        half[i] = i % m.rows > i / m.rows ? d.unseen : 0.0;
    for (size_t i = 0; i < m.rows && kind == SKY && result == AUR_OK; ++i) {
        values[i] = m.sky[i];
        half[i] = m.sky_half_widths[i];
    }
    for (size_t i = 0; i < m.rows && kind == FACTORS && result == AUR_OK; ++i)
        for (uint64_t e = m.starts[i]; e < m.starts[i + 1]; ++e)
            if (m.columns[e] > i) {
                values[i * m.rows + m.columns[e]] = m.values[e];
                half[i * m.rows + m.columns[e]] = m.half_widths[e];
            }
    *count = kind == SKY ? m.rows : m.rows * m.rows;
    aur_view_factors_destroy(factors);
    return result;
}

static aur_result measure(const lab_run *run, const aur_facets *facets, const coverage_case *given,
                          size_t seed, double *values, double *half, size_t *count, aur_error *error) {
    aur_view_factors_options options = {.size = sizeof options};
    aur_view_factors_options_init(&options, NULL);
    options.rays = given->rays;
    options.half_planes = given->rays / 2;
    options.seed = seed;
    options.rays_only = !given->half_planes;
    options.threads = lab_run_options(run)->threads;
    memset(values, 0, MOST_NUMBERS * sizeof *values);
    memset(half, 0, MOST_NUMBERS * sizeof *half);
    if (given->kind == FACTORS || given->kind == SKY)
        return of_matrix(facets, &options, given->kind, values, half, count, error);
    const aur_facets_light light = {
        .size = sizeof light, .reflectance = 0.6, .sky = 1.0, .emission = 0.5, .sun = {1.0, 0.5, 2.0}};
    *count = aur_facets_rows(facets);
    aur_view_factors *factors = NULL;
    aur_result result = AUR_OK;
    if (given->kind == BY_MATRIX)
        result = aur_view_factors_create(facets, &options, &factors, error);
    if (result == AUR_OK)
        result = aur_view_factors_radiosity(facets, factors, &options, &light, values, half, NULL, error);
    aur_view_factors_destroy(factors);
    return result;
}

/* The reference is the mean over all runs, whose error is a thirtieth of one run's, and an eighth in the
 * quick form. Numbers that are always 0 are ignored. */
static aur_result study(lab_run *run, const coverage_case *given, lab_tally *pooled, aur_error *error) {
    const size_t seeds = lab_run_options(run)->quick ? 100 : 1000;
    aur_facets *facets = NULL;
    double(*const numbers)[2][MOST_NUMBERS] = malloc(seeds * sizeof *numbers);
    aur_result result = numbers == NULL ? aur_fail(error, AUR_ERROR_MEMORY, "out of memory")
                                        : load(run, given->mesh, given->group, &facets, error);
    size_t count = 0;
    for (size_t seed = 0; seed < seeds && result == AUR_OK; ++seed)
        result = measure(run, facets, given, seed, numbers[seed][0], numbers[seed][1], &count, error);
    lab_tally t = {0};
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        double reference = 0.0, widths = 0.0;
        for (size_t seed = 0; seed < seeds; ++seed) {
            reference += numbers[seed][0][i] / (double)seeds;
            widths += numbers[seed][1][i];
        }
        for (size_t seed = 0; seed < seeds && reference > 0.0 && widths > 0.0; ++seed)
            lab_tally_count(&t, numbers[seed][0][i], numbers[seed][1][i], reference, (double)given->rays);
    }
    if (result == AUR_OK) {
        lab_tally_report(run, given->name, 0.0, &t);
        lab_tally_add(pooled, &t);
    }
    aur_facets_destroy(facets);
    free(numbers);
    return result;
}

static aur_result run(lab_run *run, aur_error *error) {
    lab_tally pooled = {0};
    aur_result result = AUR_OK;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0] && result == AUR_OK; ++i)
        result = study(run, &cases[i], &pooled, error);
    if (result == AUR_OK)
        lab_tally_report(run, "pooled", 0.0, &pooled);
    return result;
}

const lab_experiment lab_factors_coverage = {
    .name = "factors-coverage",
    .reproduces = "docs/lighting-accuracy.md",
    .summary = "how often intervals of view factors, sky factors and radiosities hold",
    .columns = lab_tally_of_rays,
    .takes_no_set = "it judges intervals of points that the program chooses",
    .seconds = 6,
    .quick_seconds = 0.7,
    .run = run,
    .takes_no_scene = "its answers are known for given scenes only",
};

/* The paper's point sets: 16 points of the lattice and the golden set (Schretter 2012, fig. 2), 100 points of
 * four sets as Cartesian and polar coordinates (fig. 3), and the star discrepancy of sets of 10 to 1000
 * points, which the paper does not give. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "program/lab/lab.h"
#include "program/lab/points.h"
#include "schretter.h"

enum { SIDE = 360, SIZES = 9, SETS = 8 };

static const size_t sizes[SIZES] = {10, 16, 34, 64, 100, 233, 256, 512, 1000};
static const char *const sets[SETS] = {"golden-set", "hammersley", "fibonacci-lattice",         "halton",
                                       "blue-noise", "random",     "golden-set:form=two-seeds", NULL};

static const char *const columns[] = {"set", "points", "star", "star_n", "min_distance_root_n", NULL};

static aur_result add_row(lab_run *run, const char *set, size_t size, double *star, aur_error *error) {
    const lab_points points = {.set = set, .domain = AUR_DOMAIN_SQUARE, .size = size};
    const size_t threads = lab_run_options(run)->threads;
    double distance;
    aur_result result = lab_figure(&points, "star", threads, star, error);
    if (result == AUR_OK)
        result = lab_figure(&points, "min-distance", threads, &distance, error);
    if (result != AUR_OK)
        return result;
    const double n = (double)size;
    lab_row(run, (const char *const[]){set, NULL}, 4,
            (const double[]){n, *star, n * *star, distance * sqrt(n)});
    return AUR_OK;
}

/* The points of one panel, as rows and as an image. */
static aur_result show(lab_run *run, report_table *table, const char *figure, const char *set, size_t size,
                       bool polar, aur_error *error) {
    const lab_points request = {.set = set,
                                .domain = polar ? AUR_DOMAIN_DISK : AUR_DOMAIN_SQUARE,
                                .size = size,
                                .map = polar ? AUR_MAP_POLAR : AUR_MAP_LAMBERT};
    aur_points *generated;
    aur_image *image;
    aur_result result = lab_points_make(&request, &generated, error);
    if (result != AUR_OK)
        return result;
    result = lab_canvas(SIDE, SIDE, &image, error);
    const aur_points_view *const points = aur_points_get_view(generated);
    const char *const coordinates = polar ? "polar" : "Cartesian";
    for (size_t i = 0; i < points->count && result == AUR_OK; ++i) {
        const double *const x = points->coordinates + points->stride * i;
        const double across = polar ? 0.5 + 0.5 * x[0] : x[0], up = polar ? 0.5 + 0.5 * x[1] : x[1];
        lab_dot(image, across * SIDE, (1.0 - up) * SIDE, size < 50 ? 7.0 : 4.5, lab_colour(0));
        lab_table_row(table, (const char *const[]){figure, set, coordinates, NULL}, 2, x);
    }
    char view[64];
    snprintf(view, sizeof view, "fig. %s, %s", figure, coordinates);
    if (result == AUR_OK)
        result = lab_image(run, &(lab_image_position){.view = view, .name = set}, image, error);
    aur_image_destroy(image);
    aur_points_destroy(generated);
    return result;
}

static aur_result show_all(lab_run *run, aur_error *error) {
    static const char *const of_points[] = {"figure", "set", "coordinates", "x", "y", NULL};
    static const char *const third[] = {"random", "hammersley", "blue-noise", "golden-set"};
    report_table *const table = lab_table(run, "points", of_points);
    aur_result result = show(run, table, "2", "fibonacci-lattice", 16, false, error);
    if (result == AUR_OK)
        result = show(run, table, "2", "golden-set", 16, false, error);
    for (size_t i = 0; i < 8 && result == AUR_OK; ++i)
        result = show(run, table, "3", third[i / 2], 100, i % 2 == 1, error);
    return result;
}

/* Fig. 2: both projections of the golden set are the golden sequence. */
static aur_result check_projections(lab_run *run, aur_error *error) {
    enum { COUNT = 16 };
    double points[2 * COUNT], numbers[COUNT];
    aur_result result =
        aur_golden_set_points(0.0, COUNT, &(aur_output){.capacity = 2 * COUNT, .doubles = points}, error);
    if (result == AUR_OK)
        result = schretter_numbers("golden", 0, COUNT, numbers, error);
    if (result != AUR_OK)
        return result;
    size_t same = 0, found = 0;
    for (size_t i = 0; i < COUNT; ++i) {
        same += points[2 * i] == numbers[i];
        for (size_t k = 0; k < COUNT; ++k)
            found += points[2 * i + 1] == numbers[k];
    }
    lab_claim(
        run, same == COUNT && found == COUNT,
        "fig. 2: both projections of the golden set are the golden sequence (%zu and %zu of %d numbers)",
        same, found, COUNT);
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    const lab_options *const options = lab_run_options(run);
    const size_t count = options->quick ? 5 : SIZES;
    double star[SETS][SIZES];
    aur_result result = show_all(run, error);
    for (size_t s = 0; s < SETS && result == AUR_OK; ++s) {
        const char *const set = s + 1 < SETS ? sets[s] : options->set;
        if (set == NULL)
            continue;
        for (size_t k = 0; k < count && result == AUR_OK; ++k)
            result = add_row(run, set, sizes[k], &star[s][k], error);
        result = lab_forgive(run, set, result, error);
    }
    if (result != AUR_OK)
        return result;
    for (size_t s = 1; s <= 5; ++s) {
        size_t below = 0;
        for (size_t k = 0; k < count; ++k)
            below += star[0][k] < star[s][k];
        lab_note(run, "the golden set's star discrepancy is below that of %s at %zu of %zu sizes", sets[s],
                 below, count);
    }
    return check_projections(run, error);
}

static const report_plot plots[] = {
    {.name = "star",
     .title = "Star discrepancy times the number of points",
     .x = "points",
     .y = "star_n",
     .series = "set",
     .log_x = true,
     .log_y = true},
    {.name = "points",
     .title = "Figs 2 and 3: points of the square, and as polar coordinates on the disk",
     .table = "points",
     .x = "x",
     .y = "y",
     .panel = "figure,set,coordinates",
     .points = true},
    {.name = NULL},
};

const lab_experiment lab_schretter_2012_sets = {
    .name = "schretter-2012-sets",
    .reproduces = "Schretter 2012, figs 2 and 3, and star discrepancies",
    .summary = "the paper's sets as Cartesian and polar coordinates, and their star discrepancy",
    .columns = columns,
    .plots = plots,
    .seconds = 0.1,
    .quick_seconds = 0.1,
    .run = run,
};

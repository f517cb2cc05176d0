/* Calls each function of pointset.h, sphere.h and quality.h, most of them also with bad input, and those of
 * quadrature.h that its own tests do not call. */
#include <aureole/estimate.h>
#include <aureole/exact.h>
#include <aureole/integrate.h>
#include <aureole/nearest.h>
#include <aureole/quadrature.h>
#include <aureole/quality.h>
#include <aureole/rotations.h>
#include <aureole/sphere.h>

#include "calls.h"

enum { COUNT = 16 };

static double buffer[3 * COUNT];
static const aur_output output = {.capacity = 3 * COUNT, .doubles = buffer};
static const aur_output small = {.capacity = 1, .doubles = buffer};
static aur_error error;

static void names(void) {
    aur_domain domain;
    aur_scramble scramble;
    aur_points_format format;
    aur_map map;
    accept(aur_domain_from_name("disk", &domain, &error), &error);
    accept(aur_scramble_from_name("owen", &scramble, &error), &error);
    accept(aur_points_format_from_name("npy", &format, &error), &error);
    accept(aur_map_from_name("polar", &map, &error), &error);
    require(strcmp(aur_domain_name(domain), "disk") == 0 &&
                strcmp(aur_scramble_name(scramble), "owen") == 0 &&
                strcmp(aur_points_format_name(format), "npy") == 0 && strcmp(aur_map_name(map), "polar") == 0,
            "names and values");
    require(aur_domain_name((aur_domain)9) == NULL && aur_scramble_name((aur_scramble)9) == NULL &&
                aur_points_format_name((aur_points_format)9) == NULL && aur_map_name((aur_map)9) == NULL,
            "a value without a name has one");
    refuse(aur_domain_from_name("ball", &domain, &error), AUR_ERROR_NAME, &error);
    refuse(aur_scramble_from_name("eggs", &scramble, &error), AUR_ERROR_NAME, &error);
    refuse(aur_points_format_from_name("doc", &format, &error), AUR_ERROR_NAME, &error);
    refuse(aur_map_from_name("mercator", &map, &error), AUR_ERROR_NAME, &error);
    const aur_set_description *const set = aur_set_find("sobol");
    char text[64];
    require(set != NULL && aur_set_find("nothing") == NULL && aur_set_at(aur_set_count()) == NULL,
            "the table of sets");
    require(aur_set_sizes(set, sizeof text, text) == strlen(text), "aur_set_sizes");
}

static void prepared_sets(void) {
    const aur_set_callback callback = {.size = sizeof callback, .name = "none"};
    accept(aur_set_register(&callback, &error), &error);
    aur_pointset_options options = {.size = sizeof options};
    aur_pointset_options_init(COUNT, &options, NULL);
    aur_pointset *set = NULL;
    refuse(aur_pointset_create("nothing", &options, &set, &error), AUR_ERROR_NAME, &error);
    accept(aur_pointset_create("sobol", &options, &set, &error), &error);
    refuse(aur_pointset_randomize(set, 1, 0, COUNT, &output, &error), AUR_ERROR_UNSUPPORTED, &error);
    aur_pointset_destroy(set);
    options.scramble = AUR_SCRAMBLE_OWEN;
    accept(aur_pointset_create("sobol", &options, &set, &error), &error);
    require(aur_pointset_dimension(set) == 2 && aur_pointset_size(set) == COUNT, "the size of a set");
    accept(aur_pointset_points(set, 0, COUNT, 3 * COUNT, buffer, &error), &error);
    require(aur_pointset_coordinate(set, 3, 1) == buffer[7] && isnan(aur_pointset_coordinate(set, COUNT, 0)),
            "aur_pointset_coordinate");
    accept(aur_pointset_coordinates(set, 1, 1, 0, COUNT, &output, &error), &error);
    accept(aur_pointset_randomize(set, 1, 0, COUNT, &output, &error), &error);
    refuse(aur_pointset_points(set, 0, COUNT, COUNT, buffer, &error), AUR_ERROR_CAPACITY, &error);
    refuse(aur_pointset_coordinates(set, 0, 2, 1, COUNT, &output, &error), AUR_ERROR_ARGUMENT, &error);
    refuse(aur_pointset_coordinates(set, 1, 2, 0, COUNT, &output, &error), AUR_ERROR_ARGUMENT, &error);
    aur_pointset_destroy(set);
    aur_pointset_destroy(NULL);
    accept(aur_golden_set_points(0.5, COUNT, &output, &error), &error);
    refuse(aur_golden_set_points(0.5, 0, &output, &error), AUR_ERROR_ARGUMENT, &error);
}

static void neighbours(void) {
    const double axes[] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0}, query[] = {-2.0, 0.1, 0.0},
                 nowhere[] = {0.0, 0.0, 0.0};
    aur_points_view points = aur_points_view_of(AUR_DOMAIN_AXES, 2, 3, axes);
    aur_nearest_options options = {.size = sizeof options};
    aur_nearest_options_init(&options, NULL);
    aur_nearest *nearest = NULL;
    size_t indices[2];
    options.neighbours = 2;
    accept(aur_nearest_create(&points, &nearest, &error), &error);
    accept(aur_nearest_find(nearest, &options, 1, query, indices, buffer, &error), &error);
    require(indices[0] == 0 && indices[1] == 1 && fabs(buffer[0] - atan(0.05)) < 1e-15, "the nearest axis");
    refuse(aur_nearest_find(nearest, NULL, 1, nowhere, indices, NULL, &error), AUR_ERROR_ARGUMENT, &error);
    options.neighbours = 3;
    refuse(aur_nearest_find(nearest, &options, 1, query, indices, NULL, &error), AUR_ERROR_ARGUMENT, &error);
    aur_nearest_destroy(nearest);
    aur_nearest_destroy(NULL);
    points.count = 0;
    refuse(aur_nearest_create(&points, &nearest, &error), AUR_ERROR_ARGUMENT, &error);
}

static void rotations(void) {
    aur_rotations_options options = {.size = sizeof options};
    aur_rotations_options_init(4, &options, NULL);
    aur_rotations *set = NULL;
    aur_rotation rotation;
    aur_symmetry symmetry;
    double group[4 * AUR_SYMMETRY_ORDER_MAX];
    accept(aur_rotations_create("super-fibonacci", &options, &set, &error), &error);
    require(aur_rotations_size(set) == 4, "aur_rotations_size");
    accept(aur_rotations_points(set, 0, 4, 3 * COUNT, buffer, &error), &error);
    refuse(aur_rotations_points(set, 1, 4, 3 * COUNT, buffer, &error), AUR_ERROR_ARGUMENT, &error);
    refuse(aur_rotations_points(set, 0, 4, 15, buffer, &error), AUR_ERROR_CAPACITY, &error);
    aur_rotations_destroy(set);
    aur_rotations_destroy(NULL);
    refuse(aur_rotations_create("nothing", &options, &set, &error), AUR_ERROR_NAME, &error);
    aur_rotation_from_quaternion(buffer, &rotation);
    aur_rotation_to_quaternion(&rotation, buffer + 4);
    accept(aur_symmetry_from_name("432", &symmetry, &error), &error);
    require(strcmp(aur_symmetry_name(symmetry), "432") == 0 && aur_symmetry_group(symmetry, group) == 24,
            "the rotations of a cube");
    accept(aur_symmetry_reduce(symmetry, 2, buffer, &error), &error);
    require(aur_symmetry_select(symmetry, 2, buffer) == 2, "aur_symmetry_select");
}

static void maps_and_lobes(void) {
    uint64_t pixel;
    aur_error wrong;
    accept(aur_healpix_pixels(4, true, 1, (const double[]){0.0, 0.0, 1.0}, 1, &pixel, &wrong), &wrong);
    require(pixel < 192, "aur_healpix_pixels");
    const double square[2] = {0.25, 0.5};
    double disk[2], direction[3], back[2];
    aur_map_to_disk(AUR_MAP_CONCENTRIC, 1, square, disk, NULL);
    aur_map_from_disk(AUR_MAP_CONCENTRIC, 1, disk, back, NULL);
    require(fabs(back[0] - 0.25) < 1e-14, "the disk and back");
    aur_map_to_cap(AUR_MAP_LAMBERT, AUR_CAP_HEMISPHERE, 1, square, direction, NULL);
    aur_map_from_cap(AUR_MAP_LAMBERT, AUR_CAP_HEMISPHERE, 1, direction, back, NULL);
    require(fabs(back[0] - 0.25) < 1e-14, "the hemisphere and back");
    aur_map_to_cap(AUR_MAP_LAMBERT, AUR_CAP_SPHERE, 1, square, direction, NULL);
    aur_map_from_cap(AUR_MAP_LAMBERT, AUR_CAP_SPHERE, 1, direction, back, NULL);
    require(fabs(back[0] - 0.25) < 1e-14, "the sphere and back");
    aur_map_to_cap(AUR_MAP_LAMBERT, 0.5, 1, square, direction, NULL);
    aur_map_from_cap(AUR_MAP_LAMBERT, 0.5, 1, direction, back, NULL);
    require(fabs(back[0] - 0.25) < 1e-14, "a cap and back");
    refuse(aur_map_to_cap(AUR_MAP_LAMBERT, 2.5, 1, square, direction, &error), AUR_ERROR_ARGUMENT, &error);
    refuse(aur_map_from_disk((aur_map)9, 1, disk, back, &error), AUR_ERROR_ARGUMENT, &error);
    require(aur_map_weight(AUR_MAP_POLAR, square) == 0.5, "aur_map_weight");
    aur_lobe lobe, density;
    refuse(aur_lobe_parse("round", &lobe, &error), AUR_ERROR_NAME, &error);
    accept(aur_lobe_parse("phong:3", &lobe, &error), &error);
    double bent[3], again[3];
    aur_lobe_warp(&lobe, 1, direction, bent);
    aur_lobe_unwarp(&lobe, 1, bent, again);
    require(fabs(again[2] - direction[2]) < 1e-14 && aur_lobe_pdf(&lobe, bent) > 0.0, "a lobe and back");
    accept(aur_lobe_optimal(&lobe, 1.5, &density, &error), &error);
    refuse(aur_lobe_optimal(&lobe, 6.0, &density, &error), AUR_ERROR_ARGUMENT, &error);
    aur_density_image *image = NULL;
    const float pixels[] = {0.0f, 1.0f}, black[] = {0.0f};
    refuse(aur_density_image_create(1, 1, black, &image, &error), AUR_ERROR_ARGUMENT, &error);
    accept(aur_density_image_create(2, 1, pixels, &image, &error), &error);
    aur_density_image_warp(image, square, back);
    require(aur_density_image_pdf(image, back) == 2.0, "aur_density_image_pdf");
    aur_density_image_unwarp(image, back, back);
    require(fabs(back[0] - 0.25) < 1e-14, "a density and back");
    aur_density_image_destroy(image);
}

static void directions(void) {
    aur_rotation axial, uniform;
    aur_rotation_axial(1, &axial);
    aur_rotation_uniform(1, &uniform);
    double north[3] = {0.0, 0.0, 1.0};
    aur_rotation_apply(&axial, 1, north);
    require(north[2] == 1.0, "an axial rotation moves the pole");
    aur_rotation_apply(&uniform, 1, north);
    const aur_fibonacci_set fibonacci = {COUNT, AUR_DOMAIN_SPHERE};
    uint64_t indices[2];
    accept(aur_fibonacci_nearest(&fibonacci, 1, north, 2, indices, &error), &error);
    const uint64_t nearest = indices[0];
    accept(aur_fibonacci_neighbours(&fibonacci, north, 2, 2, indices, &error), &error);
    require(indices[0] == nearest, "the first neighbour is not the nearest point");
    refuse(aur_fibonacci_nearest(&fibonacci, 1, north, 0, indices, &error), AUR_ERROR_CAPACITY, &error);
    refuse(aur_fibonacci_neighbours(&fibonacci, buffer + 3 * COUNT - 3, COUNT + 1, 2, indices, &error),
           AUR_ERROR_ARGUMENT, &error);
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(COUNT, AUR_DOMAIN_SPHERE, &options, NULL);
    aur_directions *set = NULL;
    refuse(aur_directions_create("nothing", &options, &set, &error), AUR_ERROR_NAME, &error);
    accept(aur_directions_create("spherical-fibonacci", &options, &set, &error), &error);
    require(aur_directions_size(set) == COUNT, "aur_directions_size");
    accept(aur_directions_points(set, 0, COUNT, 3 * COUNT, buffer, NULL, &error), &error);
    accept(aur_directions_generate(set, 0, COUNT, &output, NULL, &error), &error);
    refuse(aur_directions_points(set, 1, COUNT, 3 * COUNT, buffer, NULL, &error), AUR_ERROR_ARGUMENT, &error);
    refuse(aur_directions_generate(set, 0, COUNT, &small, NULL, &error), AUR_ERROR_CAPACITY, &error);
    aur_directions_destroy(set);
}

/* Generated, written, read back and measured. */
static void points_and_measures(void) {
    aur_directions_options options = {.size = sizeof options};
    aur_directions_options_init(COUNT, AUR_DOMAIN_SPHERE, &options, NULL);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&options, &request, NULL);
    const aur_domain square = AUR_DOMAIN_SQUARE, sphere = AUR_DOMAIN_SPHERE;
    aur_points *points = NULL;
    refuse(aur_points_generate("nothing", &request, &points, &error), AUR_ERROR_NAME, &error);
    accept(aur_points_generate("spherical-fibonacci", &request, &points, &error), &error);
    accept(aur_points_write("calls.csv", AUR_POINTS_CSV, aur_points_get_view(points), NULL, &error), &error);
    aur_points_write_options writing = {.size = sizeof writing};
    aur_points_write_options_init(&writing, NULL);
    writing.digits = 18;
    refuse(aur_points_write("calls.txt", AUR_POINTS_CSV, aur_points_get_view(points), &writing, &error),
           AUR_ERROR_ARGUMENT, &error);
    aur_points_destroy(points);
    refuse(aur_points_read("no such folder/calls.csv", NULL, &points, &error), AUR_ERROR_OPEN, &error);
    refuse(aur_points_read("calls.csv", &square, &points, &error), AUR_ERROR_UNSUPPORTED, &error);
    refuse(aur_points_read_memory("text", 6, "u,v\n2,", NULL, &points, &error), AUR_ERROR_FORMAT, &error);
    accept(aur_points_read_memory("text", 10, "x,y\n.5,.25", &square, &points, &error), &error);
    require(aur_points_get_view(points)->coordinates[1] == .25, "aur_points_read_memory");
    aur_points_destroy(points);
    accept(aur_points_read("calls.csv", NULL, &points, &error), &error);
    aur_points_destroy(points);
    accept(aur_points_read("calls.csv", &sphere, &points, &error), &error);
    remove("calls.csv");
    const aur_points_view *const view = aur_points_get_view(points);
    const aur_measure_description *description = NULL;
    accept(aur_measure_find("energy", &description, &error), &error);
    refuse(aur_measure_find("enargy", &description, &error), AUR_ERROR_NAME, &error);
    require(aur_measure_at(aur_measure_count()) == NULL, "aur_measure_at");
    double value = 0.0;
    accept(aur_measure("energy", view, NULL, &value, &error), &error);
    refuse(aur_measure("star", view, NULL, &value, &error), AUR_ERROR_UNSUPPORTED, &error);
    double bound = 1.0;
    accept(aur_measure_bounded("energy", view, NULL, &value, &bound, &error), &error);
    require(bound == 0.0, "aur_measure_bounded");
    aur_series *series = NULL;
    refuse(aur_measure_series("energy", view, NULL, &series, &error), AUR_ERROR_UNSUPPORTED, &error);
    accept(aur_measure_series("voronoi", view, NULL, &series, &error), &error);
    const size_t columns = aur_series_column_count(series);
    require(aur_series_row_count(series) == COUNT && aur_series_column(series, columns) == NULL &&
                strcmp(aur_series_column(series, 0), "point") == 0 &&
                aur_series_values(series)[columns] == 2.0,
            "a table of cells");
    aur_series_destroy(series);
    aur_points_destroy(points);
}

static void weights(void) {
    const aur_lobe lobe = {.exponent = 3.0};
    aur_density density = {.size = sizeof density};
    accept(aur_density_from_lobe(&lobe, AUR_DOMAIN_HEMISPHERE, &density, &error), &error);
    refuse(aur_density_from_lobe(&lobe, AUR_DOMAIN_SQUARE, &density, &error), AUR_ERROR_UNSUPPORTED, &error);
    aur_potential *potential = NULL;
    accept(aur_potential_create(&density, 1.25, &potential, &error), &error);
    require(aur_potential_smoothness(potential) == 1.25, "aur_potential_smoothness");
    aur_potential_destroy(potential);
    const double north[3] = {0.0, 0.0, 1.0}, weight = 1.0;
    accept(aur_weights_write("calls.csv", AUR_DOMAIN_SPHERE, 1, north, 1, &weight, &error), &error);
    remove("calls.csv");
    const aur_points_view view = aur_points_view_of(AUR_DOMAIN_SPHERE, 1, 3, north);
    accept(aur_weights_write_points("calls.csv", &view, 1, &weight, &error), &error);
    refuse(aur_weights_write("no such folder/calls.csv", AUR_DOMAIN_SPHERE, 1, north, 1, &weight, &error),
           AUR_ERROR_WRITE, &error);
}

static aur_result mean(void *user, const aur_estimate_points *points, double *values, aur_error *reason) {
    (void)user;
    (void)reason;
    values[0] = 0.0;
    for (size_t i = 0; i < points->count; ++i)
        values[0] += points->weights[i] * points->points[points->dimension * i];
    return AUR_OK;
}

static void estimates(void) {
    aur_estimate_options options = {.size = sizeof options};
    aur_estimate_options_init(2, 1, &options, NULL);
    aur_estimated found;
    aur_estimate_report report = {.size = sizeof report};
    accept(aur_estimate(mean, NULL, &options, &found, &report, &error), &error);
    require(report.reached && found.value > 0.49 && found.value < 0.51, "aur_estimate");
    options.confidence = 1.0;
    refuse(aur_estimate(mean, NULL, &options, &found, NULL, &error), AUR_ERROR_ARGUMENT, &error);
}

/* Functions that fill options set the defaults, and preserve the caller's size; an unset size is rejected. */
static void defaults(void) {
    aur_estimate_options estimate = {.size = sizeof estimate};
    aur_exact_options exact = {.size = sizeof exact};
    aur_integrate_options integrate = {.size = sizeof integrate};
    aur_weights_options solve = {.size = sizeof solve};
    aur_weight_table_grid grid = {.size = sizeof grid};
    aur_points_origin origin = {.size = sizeof origin};
    aur_worst_case_options worst = {.size = sizeof worst};
    accept(aur_estimate_options_init(3, 2, &estimate, &error), &error);
    accept(aur_exact_options_init(AUR_DOMAIN_SPHERE, &exact, &error), &error);
    accept(aur_integrate_options_init(AUR_DOMAIN_SPHERE, &integrate, &error), &error);
    accept(aur_weights_options_init(&solve, &error), &error);
    accept(aur_weight_table_grid_init(&grid, &error), &error);
    accept(aur_points_origin_init(&origin, &error), &error);
    accept(aur_worst_case_options_init(&worst, &error), &error);
    require(estimate.size == sizeof estimate && estimate.dimension == 3 && estimate.values == 2 &&
                estimate.replicates == 16 && estimate.confidence == 0.95,
            "aur_estimate_options_init");
    require(exact.domain == AUR_DOMAIN_SPHERE && integrate.replicates == 16 &&
                aur_integrate_coordinates(&integrate) == 3 && solve.sum_constraint && grid.angle_count == 64,
            "what functions fill");
    exact.size = 0;
    refuse(aur_exact_options_init(AUR_DOMAIN_SPHERE, &exact, &error), AUR_ERROR_ARGUMENT, &error);
}

int main(void) {
    defaults();
    weights();
    estimates();
    names();
    prepared_sets();
    maps_and_lobes();
    neighbours();
    rotations();
    directions();
    points_and_measures();
    return 0;
}

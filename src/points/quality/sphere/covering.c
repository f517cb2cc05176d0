/* Measures of the Voronoi cells: the covering radius, and the variation of areas. */
#include <math.h>

#include "points/base/vector.h"
#include "points/quality/measure.h"
#include "points/quality/rotations/rotations.h"
#include "points/quality/sphere/voronoi.h"

/* Radians. */
static aur_result covering(const aur_measure_request *request, double *value, aur_error *error) {
    if (request->points->domain == AUR_DOMAIN_ROTATIONS)
        return aur_rotation_covering(request, value, error);
    aur_voronoi_cell *cells;
    const aur_result result = aur_voronoi_cells(request, &cells, error);
    if (result != AUR_OK)
        return result;
    *value = 0.0;
    for (size_t i = 0; i < request->points->count; ++i)
        *value = fmax(*value, cells[i].radius);
    return AUR_OK;
}

static aur_result mesh_ratio(const aur_measure_request *request, double *value, aur_error *error) {
    double chord = 0.0;
    aur_result result = aur_smallest_distance(request, &chord, error);
    if (result == AUR_OK)
        result = covering(request, value, error);
    if (result != AUR_OK)
        return result;
    const double turn = request->points->domain == AUR_DOMAIN_ROTATIONS ? 2.0 : 1.0;
    *value /= turn * asin(fmin(0.5 * chord, 1.0));
    if (chord == 0.0)
        aur_warn_at(&request->options.warnings, (aur_location){0},
                    "points coincide: the mesh ratio is infinite");
    return AUR_OK;
}

/* Areas are in units of the mean area. */
static double mean_area(const aur_measure_request *request) {
    const double cap = request->options.cap_degrees;
    const double height = cap > 0.0                                          ? aur_rim_at(cap).height
                          : request->points->domain == AUR_DOMAIN_HEMISPHERE ? 1.0
                                                                             : 2.0;
    return 2.0 * height * AUR_PI / (double)request->points->count;
}

enum { LEAST, GREATEST, DEVIATION, FIGURES };

static aur_result area_figure(const aur_measure_request *request, double *value, aur_error *error) {
    aur_voronoi_cell *cells;
    const aur_result result = aur_voronoi_cells(request, &cells, error);
    if (result != AUR_OK)
        return result;
    const double mean = mean_area(request);
    double squares = 0.0, figures[FIGURES] = {[LEAST] = INFINITY};
    for (size_t i = 0; i < request->points->count; ++i) {
        const double area = cells[i].area / mean;
        figures[LEAST] = fmin(figures[LEAST], area);
        figures[GREATEST] = fmax(figures[GREATEST], area);
        squares += (area - 1.0) * (area - 1.0);
    }
    figures[DEVIATION] = sqrt(squares / (double)request->points->count);
    *value = figures[request->variant];
    return AUR_OK;
}

/* The given points: of an axis the first end. */
static size_t given_count(const aur_points_view *points) {
    return points->domain == AUR_DOMAIN_AXES ? points->count / 2 : points->count;
}

static aur_result voronoi(const aur_measure_request *request, aur_series *series, aur_error *error) {
    static const char *const columns[] = {"point", "area", "radius", "sides"};
    aur_voronoi_cell *cells;
    aur_result result = aur_voronoi_cells(request, &cells, error);
    if (result != AUR_OK)
        return result;
    result = aur_series_create(series, given_count(request->points), 4, columns, error);
    for (size_t i = 0; i < series->row_count && result == AUR_OK; ++i) {
        double *const row = series->values + 4 * i;
        row[0] = (double)(i + 1);
        row[1] = cells[i].area / mean_area(request);
        row[2] = cells[i].radius;
        row[3] = (double)cells[i].sides;
    }
    return result;
}

static aur_result voronoi_cells(const aur_measure_request *request, aur_series *series, aur_error *error) {
    static const char *const columns[AUR_CORNER_COLUMNS] = {"point", "x", "y", "z"};
    const size_t count = given_count(request->points);
    aur_voronoi_cell *cells;
    aur_result result = aur_voronoi_cells(request, &cells, error);
    size_t sides = 0;
    for (size_t i = 0; i < count && result == AUR_OK; ++i) {
        sides += cells[i].sides;
        if (cells[i].sides < 3)
            result =
                aur_fail(error, AUR_ERROR_UNSUPPORTED,
                         "the cell of point %zu is not a polygon: it has %zu sides", i + 1, cells[i].sides);
    }
    if (result != AUR_OK)
        return result;
    result = aur_series_create(series, sides, AUR_CORNER_COLUMNS, columns, error);
    return result == AUR_OK ? aur_voronoi_corners(request, count, cells, series->values, error) : result;
}

const aur_measure_row aur_measure_covering = {
    {.row =
         {.name = "covering",
          .summary =
              "covering radius (mesh norm): the largest angle from a direction to its nearest point, radians",
          .source = "Brauchart and Grabner 2015"},
     .domains = "sphere, hemisphere, axes, rotations, caps"},
    .compute = covering};

const aur_measure_row aur_measure_mesh_ratio = {
    {.row = {.name = "mesh-ratio",
             .summary = "covering radius over half the smallest angle between points: at least 1",
             .source = "Brauchart and Grabner 2015"},
     .domains = "sphere, hemisphere, axes, rotations, caps"},
    .minimum_count = 2,
    .compute = mesh_ratio};

const aur_measure_row aur_measure_voronoi_min = {
    {.row = {.name = "voronoi-min",
             .summary = "area of the smallest Voronoi cell, in mean areas",
             .source = "Augenbaum and Peskin 1985"},
     .domains = "sphere, hemisphere, axes, caps"},
    .variant = LEAST,
    .compute = area_figure};

const aur_measure_row aur_measure_voronoi_max = {
    {.row = {.name = "voronoi-max",
             .summary = "area of the largest Voronoi cell, in mean areas",
             .source = "Augenbaum and Peskin 1985"},
     .domains = "sphere, hemisphere, axes, caps"},
    .variant = GREATEST,
    .compute = area_figure};

const aur_measure_row aur_measure_voronoi_deviation = {
    {.row = {.name = "voronoi-deviation",
             .summary = "standard deviation of the areas of Voronoi cells, in mean areas",
             .source = "Augenbaum and Peskin 1985"},
     .domains = "sphere, hemisphere, axes, caps"},
    .variant = DEVIATION,
    .compute = area_figure};

const aur_measure_row aur_measure_voronoi = {
    {.row = {.name = "voronoi",
             .summary = "table of the Voronoi cells: area in mean areas, radius in radians, sides",
             .source = "Augenbaum and Peskin 1985"},
     .domains = "sphere, hemisphere, axes, caps",
     .series = true},
    .tabulate = voronoi};

const aur_measure_row aur_measure_voronoi_cells = {
    {.row = {.name = "voronoi-cells",
             .summary =
                 "table of the corners of the Voronoi cells, counter-clockwise from outside: the point's "
                 "number, x, y, z",
             .source = "Augenbaum and Peskin 1985"},
     .domains = "sphere, hemisphere, axes",
     .series = true},
    .tabulate = voronoi_cells};

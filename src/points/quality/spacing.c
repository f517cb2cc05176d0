/* The smallest distance between two points. */
#include "points/quality/measure.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"

typedef struct along_axis {
    double coordinate;
    const double *point;
} along_axis;

static int by_coordinate(const void *a, const void *b) {
    const along_axis *const p = a;
    const along_axis *const q = b;
    return (p->coordinate > q->coordinate) - (p->coordinate < q->coordinate);
}

static double square_distance(const double *p, const double *q, size_t dimension) {
    double square = 0.0;
    for (size_t d = 0; d < dimension; ++d)
        square += (p[d] - q[d]) * (p[d] - q[d]);
    return square;
}

/* Sweep along the last axis: a pair farther apart in it than the best distance so far cannot be nearer. */
aur_result aur_smallest_distance(const aur_measure_request *request, double *distance, aur_error *error) {
    const aur_points_view *const points = request->points;
    const size_t count = points->count;
    const size_t dimension = points->dimension;
    along_axis *const sorted = aur_arena_allocate(request->arena, count * sizeof *sorted);
    if (sorted == NULL)
        return aur_fail_memory(error);
    for (size_t i = 0; i < count; ++i) {
        const double *const point = aur_point_at(points, i);
        sorted[i] = (along_axis){point[dimension - 1], point};
    }
    qsort(sorted, count, sizeof *sorted, by_coordinate);
    double best = INFINITY;
    for (size_t i = 0; i < count; ++i) {
        for (size_t j = i + 1; j < count; ++j) {
            const double apart = sorted[j].coordinate - sorted[i].coordinate;
            if (apart * apart > best)
                break;
            best = fmin(best, square_distance(sorted[i].point, sorted[j].point, dimension));
        }
    }
    *distance = sqrt(best);
    return AUR_OK;
}

/* Radians. The angle between quaternions is half that of the rotations. */
static aur_result smallest_angle(const aur_measure_request *request, double *angle, aur_error *error) {
    double chord = 0.0;
    const aur_result result = aur_smallest_distance(request, &chord, error);
    const double turn = request->points->domain == AUR_DOMAIN_ROTATIONS ? 2.0 : 1.0;
    *angle = turn * 2.0 * asin(fmin(0.5 * chord, 1.0));
    return result;
}

const aur_measure_row aur_measure_min_distance = {
    {.row = {.name = "min-distance",
             .summary = "the smallest distance between two points (on the sphere the chord)",
             .source = "Marques 2013 sec. 3.2"},
     .domains = "sphere, hemisphere, square, cube, disk, axes, caps"},
    .minimum_count = 2,
    .compute = aur_smallest_distance};

const aur_measure_row aur_measure_min_angle = {
    {.row = {.name = "min-angle",
             .summary = "the smallest angle between two directions, axes or rotations, radians",
             .source = "Jones, Horsfield and Simmons 1999"},
     .domains = "sphere, hemisphere, axes, rotations, caps"},
    .minimum_count = 2,
    .compute = smallest_angle};

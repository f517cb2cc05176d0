/* Sums over pairs of rotations, and the energy that measures the error of their means as integrals. */
#include <math.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/quality/rotations/rotations.h"

enum { ROWS_PER_ITEM = 32 };

typedef struct pair_rows {
    const aur_points_view *points;
    size_t count; /* of rotations */
    double (*pair)(double, double);
    double parameter;
    double *sums; /* one per item */
} pair_rows;

static double near_square(const double *a, const double *b) {
    double near = 0.0, far = 0.0;
    for (size_t d = 0; d < 4; ++d) {
        near += (a[d] - b[d]) * (a[d] - b[d]);
        far += (a[d] + b[d]) * (a[d] + b[d]);
    }
    return fmin(near, far);
}

static aur_result sum_rows(void *context, size_t item) {
    const pair_rows *const work = context;
    double sum = 0.0, lost = 0.0; /* Kahan 1965 */
    bool infinite = false;
    for (size_t i = item * ROWS_PER_ITEM; i < (item + 1) * ROWS_PER_ITEM && i < work->count; ++i)
        for (size_t j = 0; j < i; ++j) {
            const double value =
                aur_weight_at(work->points, i) * aur_weight_at(work->points, j) *
                work->pair(near_square(aur_point_at(work->points, i), aur_point_at(work->points, j)),
                           work->parameter);
            infinite |= isinf(value);
            const double corrected = value - lost;
            const double next = sum + corrected;
            lost = (next - sum) - corrected;
            sum = next;
        }
    work->sums[item] = infinite ? INFINITY : sum;
    return AUR_OK;
}

/* Of the given quaternions, without their opposites. */
static double mass_of(const aur_points_view *points) {
    double mass = 0.0;
    for (size_t i = 0; i < points->count / 2; ++i)
        mass += aur_weight_at(points, i);
    return mass;
}

aur_result aur_rotation_pair_sum(const aur_measure_request *request, double (*pair)(double, double),
                                 double parameter, double *sum, aur_error *error) {
    const size_t count = request->points->count / 2;
    const size_t items = (count + ROWS_PER_ITEM - 1) / ROWS_PER_ITEM;
    pair_rows work = {request->points, count, pair, parameter,
                      aur_arena_allocate(request->arena, items * sizeof *work.sums)};
    if (work.sums == NULL)
        return aur_fail_memory(error);
    const aur_result result = aur_measure_rows(
        &request->options, "summing pairs", items, sum_rows, &work,
        (aur_parallel_slice){work.sums, sizeof *work.sums, items * sizeof *work.sums}, error);
    const double mass = mass_of(request->points);
    *sum = 0.0;
    for (size_t i = 0; i < items && result == AUR_OK; ++i)
        *sum += work.sums[i];
    *sum /= mass * mass;
    return result;
}

/* The distances to a quaternion and to its opposite. */
static double both_distances(double square, double parameter) {
    (void)parameter;
    return sqrt(square) + sqrt(4.0 - square);
}

/* The mean over ordered pairs of quaternions: each pair of rotations has four, and a rotation and its
 * opposite have the distance 2. */
aur_result aur_rotation_energy(const aur_measure_request *request, double *square, aur_error *error) {
    double sum = 0.0;
    const aur_result result = aur_rotation_pair_sum(request, both_distances, 0.0, &sum, error);
    const double mass = mass_of(request->points);
    double self_sum = 0.0;
    for (size_t i = 0; i < request->points->count / 2; ++i) {
        const double weight = aur_weight_at(request->points, i) / mass;
        self_sum += weight * weight;
    }
    *square = fmax(64.0 / (15.0 * AUR_PI) - sum - self_sum, 0.0);
    return result;
}

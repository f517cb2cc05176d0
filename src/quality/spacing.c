/* How near the nearest two points are. */
#include <math.h>
#include <stdlib.h>

#include "core/error.h"
#include "quality/measure.h"

static int by_last_axis(const void *a, const void *b) {
    const double *const p = a;
    const double *const q = b;
    return (p[2] > q[2]) - (p[2] < q[2]);
}

/* Sweep along z: a pair farther apart in z than the best distance so far cannot be nearer. */
static aur_result min_distance(const aur_measure_request *request, double *value, aur_error *error) {
    const size_t count = request->points->count;
    double *const sorted = malloc(count * 3 * sizeof *sorted);
    if (sorted == NULL)
        return aur_fail(error, AUR_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < 3 * count; ++i)
        sorted[i] = request->points->coordinates[i];
    qsort(sorted, count, 3 * sizeof *sorted, by_last_axis);
    double best = 5.0;
    for (size_t i = 0; i < count; ++i) {
        const double *const p = sorted + 3 * i;
        for (size_t j = i + 1; j < count; ++j) {
            const double *const q = sorted + 3 * j;
            const double dz = q[2] - p[2];
            if (dz * dz > best)
                break;
            const double dx = q[0] - p[0];
            const double dy = q[1] - p[1];
            const double square = dx * dx + dy * dy + dz * dz;
            best = square < best ? square : best;
        }
    }
    free(sorted);
    *value = sqrt(best);
    return AUR_OK;
}

const aur_measure_row aur_measure_min_distance = {{"min-distance", "",
                                                   "the smallest distance between two points (the chord)",
                                                   "sphere, hemisphere", "Marques 2013 sec. 3.2", 0, 0},
                                                  2,
                                                  0,
                                                  min_distance};

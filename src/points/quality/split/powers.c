#include "points/quality/split/powers.h"

#include <stdlib.h>

#include "points/quadrature/exact/fast.h"

aur_result aur_powers_find(const aur_points_view *points, size_t degree, size_t threads, double *powers,
                           aur_error *error) {
    const size_t count = points->count, size = aur_coefficient_count(degree);
    double *const storage = malloc((5 * count + size) * sizeof *storage);
    aur_basis basis;
    aur_fast_transform *fast = NULL;
    aur_result result =
        storage != NULL ? aur_basis_create(degree, -1.0, 0.0, &basis, error) : aur_fail_memory(error);
    if (result != AUR_OK) {
        free(storage);
        return result;
    }
    const aur_polar_points polar = aur_polar_points_make(count, points->coordinates, storage);
    double *const weights = storage + 4 * count, *const sums = weights + count;
    for (size_t i = 0; i < count; ++i)
        weights[i] = aur_weight_at(points, i);
    result = aur_fast_transform_create(&basis, &polar, threads, (aur_progress){0}, &fast, error);
    if (result == AUR_OK)
        result = aur_fast_transform_analyse(fast, weights, sums, error);
    for (size_t l = 1; l <= degree && result == AUR_OK; ++l) {
        double square = 0.0;
        for (size_t m = 0; m <= l; ++m) {
            const double *const pair = sums + 2 * (aur_basis_at(degree, m) + l - m);
            square += pair[0] * pair[0] + pair[1] * pair[1];
        }
        powers[l] = square / (2.0 * (double)l + 1.0);
    }
    aur_fast_transform_destroy(fast);
    aur_basis_release(&basis);
    free(storage);
    return result;
}

#include "points/quadrature/exact/transform.h"

#include <math.h>
#include <string.h>

#include "points/base/parallel.h"

aur_polar_points aur_polar_points_make(size_t count, const double *xyz, double *storage) {
    const aur_polar_points points = {count, storage, storage + count, storage + 2 * count,
                                     storage + 3 * count};
    for (size_t i = 0; i < count; ++i) {
        const double x = xyz[3 * i], y = xyz[3 * i + 1], z = xyz[3 * i + 2];
        const double across = hypot(x, y), length = hypot(across, z);
        points.z[i] = z / length;
        points.sine[i] = across / length;
        points.cosine[i] = across > 0.0 ? x / across : 1.0;
        points.azimuth_sine[i] = across > 0.0 ? y / across : 0.0;
    }
    return points;
}

/* One of the two directions, band by band. */
typedef struct band_work {
    const aur_transform *transform;
    const double *from;
    double *values; /* of points; NULL: compute sums */
} band_work;

/* A multiple of CHUNK in transform_kernel.c. */
enum { PIECE = 1024 };

static aur_result do_band(void *context, size_t band) {
    const band_work *const work = context;
    const aur_transform *const t = work->transform;
    const size_t first = t->points->count * band / AUR_TRANSFORM_BANDS;
    const size_t last = t->points->count * (band + 1) / AUR_TRANSFORM_BANDS;
    const size_t size = aur_coefficient_count(t->basis->degree);
    double *const sums = work->values == NULL ? t->sums + band * aur_transform_room(t->basis->degree) : NULL;
    if (sums != NULL)
        memset(sums, 0, size * sizeof *sums);
    /* Parts of whole chunks of the kernels, which do not affect results. */
    for (size_t at = first; at < last; at += PIECE) {
        const size_t end = last - at < PIECE ? last : at + PIECE;
        if (aur_parallel_stops())
            return AUR_ERROR_CANCELLED;
        if (sums != NULL)
            AUR_KERNEL_HERE(aur_transform_kernel).analyse(t->basis, t->points, at, end, work->from, sums);
        else
            AUR_KERNEL_HERE(aur_transform_kernel)
                .synthesise(t->basis, t->points, at, end, work->from, work->values);
    }
    return AUR_OK;
}

static aur_result do_bands(band_work work, aur_error *error) {
    const aur_parallel_options options = {
        .threads = work.transform->threads, .what = "transforming", .progress = work.transform->progress};
    return aur_parallel_for(&options, AUR_TRANSFORM_BANDS, do_band, &work, error);
}

aur_result aur_transform_analyse(const aur_transform *transform, const double *weights, double *coefficients,
                                 aur_error *error) {
    const aur_result result = do_bands((band_work){transform, weights, NULL}, error);
    const size_t size = aur_coefficient_count(transform->basis->degree);
    const size_t room = aur_transform_room(transform->basis->degree);
    memcpy(coefficients, transform->sums, size * sizeof *coefficients);
    for (size_t band = 1; band < AUR_TRANSFORM_BANDS; ++band)
        for (size_t j = 0; j < size; ++j)
            coefficients[j] += transform->sums[band * room + j];
    return result;
}

aur_result aur_transform_synthesise(const aur_transform *transform, const double *coefficients,
                                    double *values, aur_error *error) {
    return do_bands((band_work){transform, coefficients, values}, error);
}

#include "points/quality/split/split.h"

#include <math.h>
#include <stdlib.h>

#include "points/base/simd.h"
#include "points/base/vector.h"

enum { BANDS_WITHIN = 3, POINTS_PER_ITEM = 512 };

/* The position of a point, for sorting. */
typedef struct position {
    double phi, theta;
    size_t band, index;
} position;

static int in_order(const void *a, const void *b) {
    const position *const p = a, *const q = b;
    if (p->band != q->band)
        return p->band < q->band ? -1 : 1;
    if (p->phi != q->phi)
        return p->phi < q->phi ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

static size_t band_of(const aur_near_points *near, double theta) {
    const double band = fmax(theta, 0.0) / near->width;
    return band < (double)near->band_count ? (size_t)band : near->band_count - 1;
}

static void fill(const aur_points_view *points, const position *positions, aur_near_points *near) {
    for (size_t k = 0; k < points->count; ++k) {
        const double *const x = points->coordinates + 3 * positions[k].index;
        near->theta[k] = positions[k].theta;
        near->phi[k] = positions[k].phi;
        near->x[k] = x[0];
        near->y[k] = x[1];
        near->z[k] = x[2];
        near->w[k] = aur_weight_at(points, positions[k].index);
        ++near->first[positions[k].band + 1];
    }
    for (size_t b = 0; b < near->band_count; ++b)
        near->first[b + 1] += near->first[b];
}

aur_result aur_near_points_create(const aur_points_view *points, double reach, aur_arena *arena,
                                  aur_near_points *near, aur_error *error) {
    const size_t count = points->count, padded = count + 8;
    const double angle = reach < 2.0 ? 2.0 * asin(0.5 * reach) : AUR_PI;
    *near = (aur_near_points){.count = count, .band_count = (size_t)ceil(BANDS_WITHIN * AUR_PI / angle)};
    near->width = AUR_PI / (double)near->band_count;
    near->first = aur_arena_allocate(arena, (near->band_count + 1) * sizeof *near->first);
    near->theta = aur_arena_allocate(arena, 6 * padded * sizeof *near->theta);
    position *const positions = malloc(count * sizeof *positions);
    if (near->first == NULL || near->theta == NULL || positions == NULL) {
        free(positions);
        return aur_fail_memory(error);
    }
    near->phi = near->theta + padded;
    near->x = near->phi + padded;
    near->y = near->x + padded;
    near->z = near->y + padded;
    near->w = near->z + padded;
    for (size_t i = 0; i < count; ++i) {
        const double *const x = points->coordinates + 3 * i;
        const double theta = atan2(hypot(x[0], x[1]), x[2]);
        positions[i] = (position){atan2(x[1], x[0]), theta, band_of(near, theta), i};
    }
    qsort(positions, count, sizeof *positions, in_order);
    fill(points, positions, near);
    free(positions);
    return AUR_OK;
}

/* The first point of a band whose azimuth is at least `phi`. */
static size_t lower_bound(const aur_near_points *near, size_t band, double phi) {
    size_t low = near->first[band], high = near->first[band + 1];
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (near->phi[middle] < phi)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* The largest difference of azimuths within the reach of a chord, between a polar angle and those of a band:
 * (d/2)^2 = sin^2(difference / 2) + sin theta sin theta' sin^2(result / 2). */
static double half_width(const aur_near_points *near, double theta, size_t band, double reach) {
    static const double slack = 1e-9; /* azimuths and edges are rounded */
    const double low = (double)band * near->width, high = low + near->width;
    const double apart = fmax(fmax(low - theta, theta - high) - slack, 0.0);
    const double chord = 0.25 * reach * reach - sin(0.5 * apart) * sin(0.5 * apart);
    const double sines = sin(theta) * fmin(sin(low), sin(high));
    if (chord <= 0.0)
        return -1.0;
    return sines > 0.0 && chord < sines ? 2.0 * asin(sqrt(chord / sines)) + slack : 4.0;
}

typedef struct near_work {
    const aur_near_points *near;
    const aur_split_kernel *kernel;
    aur_twofold *sums;
} near_work;

static double row_of(const near_work *work, size_t i, size_t first, size_t last) {
    return first < last ? AUR_KERNEL_HERE(aur_near).row(work->near, work->kernel, i, first, last) : 0.0;
}

/* With the points of another band. */
static double across(const near_work *work, size_t i, size_t band) {
    const aur_near_points *const near = work->near;
    const double width = half_width(near, near->theta[i], band, work->kernel->reach);
    const size_t first = near->first[band], last = near->first[band + 1];
    if (width < 0.0)
        return 0.0;
    if (width >= AUR_PI)
        return row_of(work, i, first, last);
    const double from = near->phi[i] - width, to = near->phi[i] + width;
    double sum = row_of(work, i, lower_bound(near, band, from), lower_bound(near, band, to));
    if (from < -AUR_PI)
        sum += row_of(work, i, lower_bound(near, band, from + 2.0 * AUR_PI), last);
    if (to > AUR_PI)
        sum += row_of(work, i, first, lower_bound(near, band, to - 2.0 * AUR_PI));
    return sum;
}

/* Pairs with the points of the same band that follow eastward. One width serves the whole band, so that each
 * pair is found once. */
static double along(const near_work *work, size_t i, size_t band) {
    const aur_near_points *const near = work->near;
    const double low = (double)band * near->width;
    const double width = half_width(near, sin(low) < sin(low + near->width) ? low : low + near->width, band,
                                    work->kernel->reach);
    if (width >= AUR_PI)
        return row_of(work, i, i + 1, near->first[band + 1]);
    const double to = near->phi[i] + width;
    double sum = row_of(work, i, i + 1, lower_bound(near, band, to));
    if (to > AUR_PI)
        sum += row_of(work, i, near->first[band], lower_bound(near, band, to - 2.0 * AUR_PI));
    return sum;
}

static aur_result sum_points(void *context, size_t item) {
    const near_work *const work = context;
    const aur_near_points *const near = work->near;
    aur_twofold total = {0.0, 0.0};
    for (size_t i = item * POINTS_PER_ITEM; i < near->count && i < (item + 1) * POINTS_PER_ITEM; ++i) {
        const size_t band = band_of(near, near->theta[i]);
        double sum = along(work, i, band);
        for (size_t k = 1; k <= BANDS_WITHIN + 1 && k <= band; ++k)
            sum += across(work, i, band - k);
        if (near->w[i] == 0.0)
            continue;
        if (isinf(sum)) {
            total = (aur_twofold){INFINITY, 0.0};
            break;
        }
        total = aur_twofold_add(total, aur_two_product(near->w[i], sum));
    }
    work->sums[item] = total;
    return AUR_OK;
}

aur_result aur_near_sum(const aur_near_points *near, const aur_split_kernel *kernel,
                        const aur_measure_request *request, double *sum, aur_error *error) {
    const size_t items = (near->count + POINTS_PER_ITEM - 1) / POINTS_PER_ITEM;
    near_work work = {near, kernel, aur_arena_allocate(request->arena, items * sizeof *work.sums)};
    if (work.sums == NULL)
        return aur_fail_memory(error);
    const aur_result result = aur_measure_items(
        &request->options, "summing near pairs", items, sum_points, &work,
        (aur_parallel_slice){work.sums, sizeof *work.sums, items * sizeof *work.sums}, error);
    aur_twofold total = {0.0, 0.0};
    bool infinite = false;
    for (size_t i = 0; i < items && result == AUR_OK; ++i) {
        infinite |= isinf(work.sums[i].high);
        if (!infinite)
            total = aur_twofold_add(total, work.sums[i]);
    }
    *sum = infinite ? INFINITY : total.high + total.low;
    return result;
}

/* A lower bound of the cap discrepancy: all caps about many centres. */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/quality/sphere/voronoi.h"

static int highest_first(const void *a, const void *b) {
    const aur_height *const p = a;
    const aur_height *const q = b;
    return (p->height < q->height) - (p->height > q->height);
}

/* Points whose heights differ only by rounding are on one boundary, which is at the lowest of them, so that
 * every value is that of a cap. */
double aur_cap_best_about(const aur_axes *axes, const double centre[3], aur_height *room) {
    for (size_t i = 0; i < axes->count; ++i) {
        const double height = axes->x[i] * centre[0] + axes->y[i] * centre[1] + axes->z[i] * centre[2];
        room[i] = (aur_height){height, axes->weights[i]};
    }
    qsort(room, axes->count, sizeof *room, highest_first);
    double best = 0.0, mass = 0.0;
    for (size_t i = 0; i < axes->count; ++i) {
        mass += room[i].mass;
        best = fmax(best, mass - 0.5 * (1.0 - fmax(room[i].height, -1.0)));
    }
    return best;
}

typedef struct centres {
    const aur_axes *axes;
    size_t centre_count;
    double *best; /* one per item */
} centres;

enum { CENTRES_PER_ITEM = 16 };

/* Spherical Fibonacci centres (Marques 2013 eq. 4); a cap about c and its complement about -c are both
 * evaluated. */
static aur_result try_centres(void *context, size_t index) {
    const centres *const work = context;
    aur_height *const room = malloc(work->axes->count * sizeof *room);
    if (room == NULL)
        return AUR_ERROR_MEMORY;
    double best = 0.0;
    for (size_t c = index * CENTRES_PER_ITEM; c < (index + 1) * CENTRES_PER_ITEM && c < work->centre_count;
         ++c) {
        const double z = 1.0 - (2.0 * (double)c + 1.0) / (double)work->centre_count;
        const double turn = (double)((uint64_t)c * UINT64_C(0x9E3779B97F4A7C15)) * 0x1p-64;
        const double r = sqrt((1.0 - z) * (1.0 + z));
        const double centre[3] = {r * cos(2.0 * AUR_PI * turn), r * sin(2.0 * AUR_PI * turn), z};
        const double opposite[3] = {-centre[0], -centre[1], -centre[2]};
        best = fmax(best, aur_cap_best_about(work->axes, centre, room));
        best = fmax(best, aur_cap_best_about(work->axes, opposite, room));
    }
    free(room);
    work->best[index] = best;
    return AUR_OK;
}

static aur_result cap_bound(const aur_measure_request *request, double *value, aur_error *error) {
    double target;
    aur_result result = aur_measure_number(request, 1.0, 1e9, 4096.0, &target, error);
    if (result != AUR_OK)
        return result;
    const size_t count = (size_t)target;
    const size_t items = (count + CENTRES_PER_ITEM - 1) / CENTRES_PER_ITEM;
    aur_axes axes;
    centres work = {&axes, count, aur_arena_allocate(request->arena, items * sizeof *work.best)};
    result = work.best != NULL ? aur_axes_create(request->points, &axes, error) : aur_fail_memory(error);
    if (result != AUR_OK)
        return result;
    result = aur_measure_items(&request->options, "trying caps", items, try_centres, &work,
                               (aur_parallel_slice){work.best, sizeof *work.best, items * sizeof *work.best},
                               error);
    *value = 0.0;
    for (size_t i = 0; i < items && result == AUR_OK; ++i)
        *value = fmax(*value, work.best[i]);
    aur_axes_release(&axes);
    return result;
}

const aur_measure_row aur_measure_cap_bound = {
    {.row = {.name = "cap-bound",
             .summary = "lower bound of 'cap' from all caps about CENTRES (4096) spherical Fibonacci "
                        "centres, for large N",
             .source = "Marques 2013 sec. 2.1"},
     .parameter = "[:CENTRES]",
     .domains = "sphere, axes",
     .bound = true},
    .masses = 1,
    .compute = cap_bound};

/* The quality parameter t of a net: the smallest t for which every elementary interval of volume b^(t-m)
 * holds b^t of the b^m points (Niederreiter 1987). */
#include <math.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/quality/measure.h"

/* Coordinates in base b are rounded to doubles: a point so little below an edge belongs above it. */
static const double edge_tolerance = 1e-6;

/* The limit of the number of shapes of elementary intervals times points. */
static const double work_limit = 1e12;

typedef struct net {
    const aur_points_view *points;
    uint64_t base;
    size_t digits;       /* m */
    uint64_t *cells;     /* count * dimension: coordinates in units of b^-m */
    uint64_t *powers;    /* b^0 .. b^m */
    uint32_t *occupancy; /* b^m */
    size_t *shape;       /* digits of each coordinate */
} net;

/* Whether all intervals of the shape contain equally many points. */
static int is_even(const net *n, size_t strength) {
    const size_t dimension = n->points->dimension;
    const uint64_t intervals = n->powers[strength];
    memset(n->occupancy, 0, intervals * sizeof *n->occupancy);
    const uint64_t share = n->powers[n->digits - strength];
    for (size_t i = 0; i < n->points->count; ++i) {
        uint64_t interval = 0;
        for (size_t d = 0; d < dimension; ++d)
            interval = interval * n->powers[n->shape[d]] +
                       n->cells[i * dimension + d] / n->powers[n->digits - n->shape[d]];
        if (++n->occupancy[interval] > share)
            return 0;
    }
    return 1;
}

/* The next way of giving `strength` digits to the coordinates, in lexical order; 0 after the last. */
static int next_shape(size_t *shape, size_t dimension) {
    size_t last = dimension - 1;
    const size_t tail = shape[last];
    size_t d = last;
    while (d > 0 && shape[d - 1] == 0)
        --d;
    if (d == 0)
        return 0;
    shape[last] = 0;
    --shape[d - 1];
    shape[d] = tail + 1;
    return 1;
}

static int all_shapes_even(const net *n, size_t strength) {
    const size_t dimension = n->points->dimension;
    memset(n->shape, 0, dimension * sizeof *n->shape);
    n->shape[0] = strength;
    do {
        if (!is_even(n, strength))
            return 0;
    } while (next_shape(n->shape, dimension));
    return 1;
}

static aur_result find_digits(net *n, aur_error *error) {
    uint64_t size = 1;
    while (size < n->points->count) {
        size *= n->base;
        ++n->digits;
    }
    if (size == n->points->count)
        return AUR_OK;
    return aur_fail(error, AUR_ERROR_ARGUMENT, "a net in base %llu has a power of it as its size, not %zu",
                    (unsigned long long)n->base, n->points->count);
}

static void fill_cells(net *n) {
    n->powers[0] = 1;
    for (size_t i = 1; i <= n->digits; ++i)
        n->powers[i] = n->powers[i - 1] * n->base;
    const double size = (double)n->points->count;
    const double slack = n->base == 2 ? 0.0 : edge_tolerance;
    const size_t dimension = n->points->dimension;
    for (size_t i = 0; i < n->points->count; ++i) {
        for (size_t d = 0; d < dimension; ++d) {
            const uint64_t cell = (uint64_t)(aur_point_at(n->points, i)[d] * size + slack);
            n->cells[i * dimension + d] = cell < n->points->count ? cell : n->points->count - 1;
        }
    }
}

static aur_result strength_of(net *n, const aur_measure_options *options, double *t, aur_error *error) {
    size_t strength = 0;
    for (double shapes = 1.0; strength < n->digits; ++strength) {
        const double dimension = (double)n->points->dimension;
        shapes *= (dimension + (double)strength) / ((double)strength + 1.0);
        if (shapes * (double)n->points->count > work_limit)
            return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                            "net: %g shapes of elementary intervals are too many to try (t is at most %zu)",
                            shapes, n->digits - strength);
        if (aur_progress_stops(&options->progress, "counting in intervals", strength, n->digits))
            return aur_fail(error, AUR_ERROR_CANCELLED, "net: cancelled");
        if (!all_shapes_even(n, strength + 1))
            break;
    }
    *t = (double)(n->digits - strength);
    return AUR_OK;
}

static aur_result net_parameter(const aur_measure_request *request, double *value, aur_error *error) {
    double base;
    aur_result result = aur_measure_number(request, 2.0, 1e6, 2.0, &base, error);
    if (result == AUR_OK && base != floor(base))
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "net: the base must be a whole number, not %s",
                          request->parameter);
    net n = {.points = request->points, .base = (uint64_t)base};
    if (result == AUR_OK)
        result = find_digits(&n, error);
    if (result != AUR_OK)
        return result;
    const size_t count = n.points->count, dimension = n.points->dimension;
    aur_arena *const arena = request->arena;
    n.cells = aur_arena_allocate(arena, count * dimension * sizeof *n.cells);
    n.powers = aur_arena_allocate(arena, (n.digits + 1) * sizeof *n.powers);
    n.occupancy = aur_arena_allocate(arena, count * sizeof *n.occupancy);
    n.shape = aur_arena_allocate(arena, dimension * sizeof *n.shape);
    if (n.cells == NULL || n.powers == NULL || n.occupancy == NULL || n.shape == NULL)
        return aur_fail_memory(error);
    fill_cells(&n);
    return strength_of(&n, &request->options, value, error);
}

const aur_measure_row aur_measure_net = {
    {.row = {.name = "net",
             .summary = "t of the points as a (t,m,s)-net in base B (2): 0 is best, m is not a net",
             .source = "Niederreiter 1987"},
     .parameter = "[:B]",
     .domains = "square, cube"},
    .compute = net_parameter};

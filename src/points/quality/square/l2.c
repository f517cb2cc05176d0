/* L2 discrepancies on the cube in any dimension: constant - 2 mean p(x_i) + mean k(x_i, x_j), where p and k
 * are products over dimensions. */
#include <math.h>

#include "points/base/error.h"
#include "points/quality/measure.h"
#include "points/quality/pairs/twofold.h"

typedef struct product_kernel {
    double (*constant)(double dimension);
    double (*point)(double x);
    double (*pair)(double x, double y);
} product_kernel;

typedef struct double_sum {
    const product_kernel *kernel;
    const aur_points_view *points;
    aur_twofold *rows; /* 2 * tile_count: sums of pairs and of points */
} double_sum;

enum { ROWS_PER_ITEM = 64 };

/* Rows of the lower triangle: pairs below the diagonal count twice. */
static aur_result sum_rows(void *context, size_t index) {
    const double_sum *const work = context;
    const aur_points_view *const points = work->points;
    const size_t dimension = points->dimension;
    const size_t first = index * ROWS_PER_ITEM;
    const size_t last = first + ROWS_PER_ITEM < points->count ? first + ROWS_PER_ITEM : points->count;
    aur_twofold pairs = {0.0, 0.0}, singles = {0.0, 0.0};
    for (size_t i = first; i < last; ++i) {
        const double *const x = aur_point_at(points, i);
        const double weight = aur_weight_at(points, i);
        double single = weight;
        for (size_t d = 0; d < dimension; ++d)
            single *= work->kernel->point(x[d]);
        singles = aur_twofold_add(singles, (aur_twofold){single, 0.0});
        for (size_t j = 0; j <= i; ++j) {
            const double *const y = aur_point_at(points, j);
            double pair = weight * aur_weight_at(points, j) * (j < i ? 2.0 : 1.0);
            for (size_t d = 0; d < dimension; ++d)
                pair *= work->kernel->pair(x[d], y[d]);
            pairs = aur_twofold_add(pairs, (aur_twofold){pair, 0.0});
        }
    }
    work->rows[2 * index] = pairs;
    work->rows[2 * index + 1] = singles;
    return AUR_OK;
}

static aur_result discrepancy(const product_kernel *kernel, const aur_measure_request *request, double *value,
                              aur_error *error) {
    const aur_points_view *const points = request->points;
    const size_t items = (points->count + ROWS_PER_ITEM - 1) / ROWS_PER_ITEM;
    double_sum work = {kernel, points, aur_arena_allocate(request->arena, 2 * items * sizeof *work.rows)};
    if (work.rows == NULL)
        return aur_fail_memory(error);
    const aur_result result = aur_measure_rows(
        &request->options, "summing pairs", items, sum_rows, &work,
        (aur_parallel_slice){work.rows, 2 * sizeof *work.rows, 2 * items * sizeof *work.rows}, error);
    if (result != AUR_OK)
        return result;
    aur_twofold pairs = {0.0, 0.0}, singles = {0.0, 0.0}, mass = {0.0, 0.0};
    for (size_t i = 0; i < items; ++i) {
        pairs = aur_twofold_add(pairs, work.rows[2 * i]);
        singles = aur_twofold_add(singles, work.rows[2 * i + 1]);
    }
    for (size_t i = 0; i < points->count; ++i)
        mass = aur_twofold_add(mass, (aur_twofold){aur_weight_at(points, i), 0.0});
    const aur_twofold constant =
        aur_twofold_scale(aur_twofold_multiply(mass, mass), kernel->constant((double)points->dimension));
    const aur_twofold cross = aur_twofold_scale(aur_twofold_multiply(mass, singles), -2.0);
    const aur_twofold square = aur_twofold_add(aur_twofold_add(constant, pairs), cross);
    *value = sqrt(fmax(square.high, 0.0)) / mass.high;
    return AUR_OK;
}

static double star_constant(double dimension) {
    return pow(3.0, -dimension);
}

static double star_point(double x) {
    return 0.5 * (1.0 - x * x);
}

static double star_pair(double x, double y) {
    return 1.0 - fmax(x, y);
}

static double centered_constant(double dimension) {
    return pow(13.0 / 12.0, dimension);
}

static double centered_point(double x) {
    const double a = fabs(x - 0.5);
    return 1.0 + 0.5 * a - 0.5 * a * a;
}

static double centered_pair(double x, double y) {
    return 1.0 + 0.5 * (fabs(x - 0.5) + fabs(y - 0.5) - fabs(x - y));
}

static double wraparound_constant(double dimension) {
    return -pow(4.0 / 3.0, dimension);
}

static double wraparound_point(double x) {
    (void)x;
    return 0.0;
}

static double wraparound_pair(double x, double y) {
    const double a = fabs(x - y);
    return 1.5 - a * (1.0 - a);
}

enum { STAR, CENTERED, WRAPAROUND };

static aur_result product_discrepancy(const aur_measure_request *request, double *value, aur_error *error) {
    static const product_kernel kernels[] = {
        [STAR] = {star_constant, star_point, star_pair},
        [CENTERED] = {centered_constant, centered_point, centered_pair},
        [WRAPAROUND] = {wraparound_constant, wraparound_point, wraparound_pair}};
    return discrepancy(&kernels[request->variant], request, value, error);
}

const aur_measure_row aur_measure_l2_star = {
    {.row = {.name = "l2-star",
             .summary = "L2 star discrepancy, the root mean square over boxes at the origin",
             .source = "Warnock 1972"},
     .domains = "square, cube"},
    .variant = STAR,
    .compute = product_discrepancy};

const aur_measure_row aur_measure_centered = {
    {.row = {.name = "centered", .summary = "centred L2 discrepancy (its root)", .source = "Hickernell 1998"},
     .domains = "square, cube"},
    .variant = CENTERED,
    .compute = product_discrepancy};

const aur_measure_row aur_measure_wraparound = {{.row = {.name = "wraparound",
                                                         .summary = "wrap-around L2 discrepancy (its root)",
                                                         .source = "Hickernell 1998"},
                                                 .domains = "square, cube"},
                                                .variant = WRAPAROUND,
                                                .compute = product_discrepancy};

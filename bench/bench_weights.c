/* Optimal weights against the linear algebra that they require. */
#include <aureole/quadrature.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "points/base/random.h"
#include "points/quadrature/kernel.h"

/* Samples, their densities precomputed as in a renderer, and space for the results. */
typedef struct solve_context {
    size_t count;
    double *xyz, *columns, *weights;
    double *system; /* K in the layout of dposv, then the right-hand sides of the weights */
    double *work;
    lapack_int right_count;
    size_t potential_count;
    aur_potential *potentials[2];
    aur_kernel_rule rule;
} solve_context;

static void close_solve(solve_context *context) {
    free(context->xyz);
    free(context->system);
    aur_potential_destroy(context->potentials[0]);
    aur_potential_destroy(context->potentials[1]);
}

static bool make_points(size_t count, double exponent, double *xyz) {
    const aur_directions_options options = {.size = sizeof options,
                                            .count = count,
                                            .domain = AUR_DOMAIN_HEMISPHERE,
                                            .lobe = {.exponent = exponent}};
    aur_directions *directions;
    if (aur_directions_create("spherical-fibonacci", &options, &directions, NULL) != AUR_OK)
        return false;
    const aur_result result = aur_directions_points(directions, 0, count, 3 * count, xyz, NULL, NULL);
    aur_directions_destroy(directions);
    return result == AUR_OK;
}

/* Exponents are evaluated one after the other; all samples are drawn for the first one. */
static bool open_solve(size_t count, size_t potential_count, const double *exponents,
                       solve_context *context) {
    const size_t right = potential_count + 1; /* one more for the sum constraint */
    const size_t doubles = count * (count + right);
    *context = (solve_context){.count = count,
                               .right_count = (lapack_int)right,
                               .potential_count = potential_count,
                               .rule = aur_kernel_rule_make(1.5)};
    context->xyz = malloc((6 + potential_count) * count * sizeof *context->xyz);
    context->system = malloc(2 * doubles * sizeof *context->system);
    if (context->xyz == NULL || context->system == NULL || !make_points(count, exponents[0], context->xyz))
        return bench_fail("weights: cannot make %zu samples", count);
    context->columns = context->xyz + 3 * count;
    context->weights = context->columns + 3 * count;
    context->work = context->system + doubles;
    for (size_t k = 0; k < potential_count; ++k) {
        const aur_density density = {.size = sizeof(aur_density), .exponent = exponents[k]};
        if (aur_potential_create(&density, 1.5, &context->potentials[k], NULL) != AUR_OK)
            return bench_fail("weights: no potential");
        aur_potential_evaluate(context->potentials[k], count, context->xyz,
                               context->system + count * (count + k));
    }
    const aur_columns columns = aur_columns_split(count, context->xyz, context->columns);
    for (size_t i = 0; i < count; ++i) {
        aur_kernel_row(&context->rule, context->xyz + 3 * i, count, columns, context->system + i * count);
        context->system[i * count + i] += AUR_REGULARIZATION_DEFAULT;
        context->system[count * (count + potential_count) + i] = 1.0;
    }
    return true;
}

static void run_solve(void *data) {
    solve_context *const context = data;
    const aur_potential *const potentials[] = {context->potentials[0], context->potentials[1]};
    aur_weights_solve(context->count, context->xyz, context->potential_count, potentials, NULL,
                      context->potential_count * context->count, context->weights, NULL, NULL, NULL);
    bench_keep(context->weights[0]);
}

static void run_dposv(void *data) {
    solve_context *const context = data;
    const size_t n = context->count;
    memcpy(context->work, context->system, n * (n + (size_t)context->right_count) * sizeof *context->work);
    LAPACKE_dposv_work(LAPACK_COL_MAJOR, 'U', (lapack_int)n, context->right_count, context->work,
                       (lapack_int)n, context->work + n * n, (lapack_int)n);
    bench_keep(context->work[n * n]);
}

/* The lower triangle of K. */
static void run_assembly(void *data) {
    solve_context *const context = data;
    const size_t n = context->count;
    const aur_columns columns = aur_columns_split(n, context->xyz, context->columns);
    for (size_t i = 0; i < n; ++i)
        aur_kernel_row(&context->rule, context->xyz + 3 * i, i, columns, context->work + i * n);
    bench_keep(context->work[n]);
}

static bool bench_solves(const bench_options *options) {
    /* Diffuse and glossy alone: a table covers both long and short series of the potential. */
    static const double exponents[] = {1.0, 20.0};
    static const char *const names[] = {"solve, N 128, m 1", "solve, N 128, m 20"};
    for (size_t i = 0; i < 2; ++i) {
        solve_context context;
        const bool opened = open_solve(128, 1, exponents + i, &context);
        if (opened) {
            run_solve(&context); /* restricts OpenBLAS to one thread */
            const bench_work limit = {run_dposv, &context, 1.0};
            const bench_work subject = {run_solve, &context, 1.0};
            const bench_pair pair = bench_compare(options, &subject, &limit);
            bench_print_pair(names[i], "dposv", "ksolve", 1e3, &pair);
            if (i == 0) {
                const bench_work assembly = {run_assembly, &context, 1.0};
                const bench_pair share = bench_compare(options, &assembly, &limit);
                bench_print_pair("assembly of K, N 128", "dposv", "ksolve", 1e3, &share);
            }
        }
        close_solve(&context);
        if (!opened)
            return false;
    }
    return true;
}

enum { ANGLES = 64, ROTATIONS = 16, DIFFUSE = 64, GLOSSY = 32, SAMPLES = DIFFUSE + GLOSSY };

static const aur_oswa_options pair_options = {.size = sizeof(aur_oswa_options),
                                              .count = DIFFUSE,
                                              .mirror_count = GLOSSY,
                                              .lobe = {.exponent = 1.0},
                                              .mirror_lobe = {.exponent = 20.0}};

static void run_table(void *data) {
    const size_t *const size = data; /* angles and rotations */
    aur_weight_table *table;
    if (aur_weight_table_build(&pair_options,
                               &(aur_weight_table_grid){sizeof(aur_weight_table_grid), size[0], 1, size[1]},
                               1, NULL, &table, NULL) == AUR_OK)
        bench_keep(aur_weight_table_mass(table, 0.5, 0.0));
    aur_weight_table_destroy(table);
}

static bool bench_table(const bench_options *options) {
    static const double exponents[] = {1.0, 20.0};
    size_t size[] = {options->quick ? 4 : ANGLES, options->quick ? 2 : ROTATIONS};
    solve_context context;
    const bool opened = open_solve(SAMPLES, 2, exponents, &context);
    if (opened) {
        const bench_work limit = {run_dposv, &context, 1.0};
        const bench_work subject = {run_table, size, (double)(size[0] * size[1])};
        const bench_pair pair = bench_compare(options, &subject, &limit);
        bench_print_pair("table, 64 angles, 16 rotations, 64+32", "dposv", "ksolve", 1e3, &pair);
    }
    close_solve(&context);
    return opened;
}

typedef struct look_up_context {
    aur_weight_table *table;
    size_t row_count;
    float *rows; /* the size and stride of the table */
    float weights[SAMPLES];
} look_up_context;

enum { LOOK_UPS = 4096 };

/* Angle and rotation of each look-up come from a hash, as for neighboring pixels. */
static void run_look_up(void *data) {
    look_up_context *const context = data;
    for (uint64_t i = 0; i < LOOK_UPS; ++i) {
        const uint64_t hash = aur_mix64(i);
        const float radians = 1.57f * aur_unit_float((uint32_t)hash);
        aur_weight_table_look_up(context->table, hash >> 63, (hash >> 32) % ROTATIONS, (double)radians, 0.0,
                                 SAMPLES, context->weights, NULL);
        bench_keep((double)context->weights[0]);
    }
}

static void run_copy(void *data) {
    look_up_context *const context = data;
    const size_t rows = context->row_count / ROTATIONS;
    for (uint64_t i = 0; i < LOOK_UPS; ++i) {
        const uint64_t hash = aur_mix64(i);
        const float radians = 1.57f * aur_unit_float((uint32_t)hash);
        const size_t row = (hash >> 32) % ROTATIONS * rows + (size_t)(radians * (float)(rows - 1) / 1.5708f);
        memcpy(context->weights, context->rows + (2 * row + (hash >> 63)) * SAMPLES, sizeof context->weights);
        bench_keep((double)context->weights[0]);
    }
}

static bool bench_look_up(const bench_options *options) {
    for (int clipped = 0; clipped < 2; ++clipped) {
        aur_oswa_options pair_of = pair_options;
        pair_of.clipped = clipped;
        look_up_context context = {0};
        if (aur_weight_table_build(
                &pair_of, &(aur_weight_table_grid){sizeof(aur_weight_table_grid), ANGLES, 1, ROTATIONS}, 1,
                NULL, &context.table, NULL) != AUR_OK)
            return bench_fail("weights: no table");
        context.row_count = aur_weight_table_rows(context.table);
        const size_t floats = 2 * context.row_count * SAMPLES;
        context.rows = malloc(floats * sizeof *context.rows);
        if (context.rows == NULL)
            return bench_fail("weights: no memory for %zu rows", context.row_count);
        for (size_t i = 0; i < floats; ++i) /* untouched pages would all map to one page in the cache */
            context.rows[i] = 1.0f;
        const bench_work limit = {run_copy, &context, LOOK_UPS};
        const bench_work subject = {run_look_up, &context, LOOK_UPS};
        const bench_pair pair = bench_compare(options, &subject, &limit);
        bench_print_pair(clipped ? "look-up of 96 weights, clipped" : "look-up of 96 weights",
                         "copy of 96 floats", "Mlookup", 1e6, &pair);
        aur_weight_table_destroy(context.table);
        free(context.rows);
    }
    return true;
}

static bool run(const bench_options *options) {
    return bench_solves(options) && bench_table(options) && bench_look_up(options);
}

const bench bench_weights = {"weights", "optimal weights against bare LAPACK solves and copies", run};

/* Functions of different smoothness along a parallel of the sphere (Marques 2018, fig. 2), and the worst-case
 * error as a bound of the errors of their integrals (eq. 7).
 *
 * f = sum of c_j K(., v_j) belongs to the space of smoothness s with the kernel K, with norm sqrt(c'Kc); its
 * integral against a lobe is the sum of c_j z(v_j), without quadrature. The paper does not state its
 * functions; these have a third of their centres on the parallel. */
#include <math.h>

#include "samples.h"

enum { CENTRES = 24, SMOOTHNESSES = 3, SIZES = 4, MOST = 512, STEPS = 144 };

static const double smoothnesses[SMOOTHNESSES] = {1.1, 1.5, 1.9};
static const double parallel = 1.4; /* theta in the figure */

static const char *const columns[] = {"s", "samples", "error", "bound", "optimal_error", "bound_of_optimal",
                                      NULL};

typedef struct kernel_sum {
    double s, centres[3 * CENTRES], factors[CENTRES];
} kernel_sum;

static double chord(const double a[3], const double b[3]) {
    return fmin(2.0, hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]));
}

static double value_of(const kernel_sum *f, const double at[3]) {
    double sum = 0.0;
    for (size_t j = 0; j < CENTRES; ++j)
        sum += f->factors[j] * aur_kernel(f->s, chord(at, f->centres + 3 * j));
    return sum;
}

/* With norm 1; as the factors sum to 0, the kernel's constant cancels. */
static aur_result make(double s, kernel_sum *f, aur_error *error) {
    double square = 0.0, mean = 0.0;
    f->s = s;
    const aur_result result =
        lab_draw(&(lab_samples){"random", CENTRES, 0.0, false, 5}, f->centres, NULL, error);
    for (size_t j = 0; j < CENTRES; ++j) {
        double *const v = f->centres + 3 * j;
        f->factors[j] = sin(1.0 + 17.0 * (double)(j * j));
        mean += f->factors[j] / CENTRES;
        if (j % 3 != 0)
            continue;
        const double across = hypot(v[0], v[1]);
        v[0] *= sin(parallel) / across;
        v[1] *= sin(parallel) / across;
        v[2] = cos(parallel);
    }
    for (size_t j = 0; j < CENTRES; ++j)
        f->factors[j] -= mean;
    for (size_t j = 0; j < CENTRES; ++j)
        square += f->factors[j] * value_of(f, f->centres + 3 * j);
    for (size_t j = 0; j < CENTRES; ++j)
        f->factors[j] /= sqrt(square);
    return result;
}

static void draw(const kernel_sum *f, report_table *table) {
    for (size_t i = 0; i <= STEPS; ++i) {
        const double phi = 2.0 * 3.14159265358979323846 * (double)i / STEPS;
        const double at[3] = {sin(parallel) * cos(phi), sin(parallel) * sin(phi), cos(parallel)};
        lab_table_row(table, (const char *const[]){NULL}, 3, (const double[]){f->s, phi, value_of(f, at)});
    }
}

/* Errors of Fibonacci points with equal and with optimal weights, and their bounds. */
static aur_result integrate(lab_run *run, const kernel_sum *f, const aur_potential *potential, size_t count,
                            size_t *store, aur_error *error) {
    double xyz[3 * MOST], weights[MOST], z[CENTRES], errors[2] = {0};
    aur_weights_report report;
    aur_result result =
        lab_draw(&(lab_samples){"spherical-fibonacci", count, 1.0, false, 0}, xyz, NULL, error);
    if (result == AUR_OK)
        result = aur_weights_solve(count, xyz, 1, &potential, NULL, MOST, weights, &report, NULL, error);
    if (result != AUR_OK)
        return result;
    aur_potential_evaluate(potential, CENTRES, f->centres, z);
    for (size_t j = 0; j < CENTRES; ++j) {
        errors[0] -= f->factors[j] * z[j];
        errors[1] -= f->factors[j] * z[j];
    }
    for (size_t i = 0; i < count; ++i) {
        const double value = value_of(f, xyz + 3 * i);
        errors[0] += value / (double)count;
        errors[1] += weights[i] * value;
    }
    lab_row(run, (const char *const[]){NULL}, 6,
            (const double[]){f->s, (double)count, fabs(errors[0]), report.equal_error, fabs(errors[1]),
                             report.optimal_error});
    *store += fabs(errors[0]) <= report.equal_error && fabs(errors[1]) <= report.optimal_error;
    return AUR_OK;
}

static aur_result run(lab_run *run, aur_error *error) {
    static const size_t sizes[SIZES] = {8, 32, 128, 512};
    static const char *const drawn[] = {"s", "phi", "f", NULL};
    report_table *const table = lab_table(run, "functions", drawn);
    size_t store = 0;
    aur_result result = AUR_OK;
    for (size_t k = 0; k < SMOOTHNESSES && result == AUR_OK; ++k) {
        kernel_sum f;
        aur_potential *potential = NULL;
        result = make(smoothnesses[k], &f, error);
        if (result == AUR_OK)
            result = lab_lobe_potential(1.0, smoothnesses[k], &potential, error);
        if (result == AUR_OK)
            draw(&f, table);
        for (size_t n = 0; n < SIZES && result == AUR_OK; ++n)
            result = integrate(run, &f, potential, sizes[n], &store, error);
        aur_potential_destroy(potential);
    }
    lab_claim(run, store == SMOOTHNESSES * SIZES,
              "eq. 7: the errors with equal and with optimal weights are below their worst-case errors, in "
              "%zu of %d cases",
              store, SMOOTHNESSES * SIZES);
    return result;
}

static const report_plot plots[] = {
    {.name = "functions",
     .title = "Functions of norm 1 in spaces of smoothness s, along the parallel at theta = 1.4",
     .table = "functions",
     .x = "phi",
     .y = "f",
     .panel = "s"},
    {.name = NULL},
};

const lab_experiment lab_marques_2018_functions = {
    .name = "marques-2018-functions",
    .reproduces = "Marques 2018, fig. 2, eq. 7",
    .summary = "functions of different smoothness, and the bound on their quadrature errors",
    .columns = columns,
    .plots = plots,
    .takes_no_set = "it compares functions, not sets",
    .seconds = 0.1,
    .quick_seconds = 0.1,
    .run = run,
};

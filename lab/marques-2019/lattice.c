/* Every statement of Marques 2019, sections 3 to 5, on the lattice of spherical Fibonacci grids, in numbers:
 * the range of its values over many sizes, and the cases outside the stated range (figs 2 to 7, eqs 5 to 56).
 *
 * Bounds of identities follow from rounding: a power Phi^k, k <= 70, has an error of 70 units in the last
 * place. */
#include "lattice.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

enum { LARGEST = 100000, QUICK_LARGEST = 20000 };

static const double rounding = 100.0 * DBL_EPSILON;

static double relative(double value, double other, double scale) {
    return fabs(value - other) / fabs(scale);
}

/* Eqs 6 to 12 and 53; eq. 15 at one size, which only scales it. */
static void check_identities(lab_run *run) {
    const double golden = lattice_golden;
    lattice_check ratio = lattice_begin("eqs 7, 8", "Phi - 1/Phi = 1, Phi + 1/Phi = sqrt 5", 0.0, rounding);
    lattice_count(&ratio, 7.0, fabs(golden - 1.0 / golden - 1.0));
    lattice_count(&ratio, 8.0, fabs(golden + 1.0 / golden - sqrt(5.0)));
    lattice_end(run, &ratio);

    lattice_check binet = lattice_begin("eqs 9, 10", "F_k by powers of Phi, and F_k / Phi", 0.0, rounding);
    lattice_check recurrence = lattice_begin("eq. 6", "b_{k+1} = b_k + b_{k-1}", 0.0, rounding);
    lattice_check cell = lattice_begin(
        "eq. 15", "the unit cell of b_k, b_{k+1} has the area 1/N, its sign (-1)^k", 0.0, rounding);
    lattice_check sum =
        lattice_begin("eq. 53", "b_k = F_k b_1 + F_{k-1} b_0, up to its own rounding", 0.0, rounding);
    for (size_t k = 1; k <= LATTICE_MOST_INDEX; ++k) {
        const double f = lattice_fibonacci(k), before = lattice_fibonacci(k - 1), which = (double)k;
        const double sign = k % 2 == 0 ? 1.0 : -1.0, power = pow(golden, which);
        lattice_count(&binet, which, relative((power - sign / power) / sqrt(5.0), f, f));
        lattice_count(&binet, which, relative(f / golden, before - sign / power, f));
        double b[4][2];
        lattice_vector(k - 1, 1.0, b[0]);
        lattice_vector(k, 1.0, b[1]);
        lattice_vector(k + 1, 1.0, b[2]);
        lattice_vector(1, 1.0, b[3]);
        for (size_t c = 0; c < 2; ++c)
            lattice_count(&recurrence, which,
                          relative(b[2][c], b[1][c] + b[0][c], b[0][c] != 0.0 ? b[0][c] : 1.0));
        lattice_count(&cell, which, fabs(sign * (b[1][0] * b[2][1] - b[2][0] * b[1][1]) - 1.0));
        /* b_0 is (0, -1), and the sum loses as many digits as F_k has. */
        lattice_count(&sum, which, relative(b[1][1], f * b[3][1] - before, f));
    }
    lattice_end(run, &binet);
    lattice_end(run, &recurrence);
    lattice_end(run, &cell);
    lattice_end(run, &sum);

    lattice_check product = lattice_begin("eq. 11", "F_4m = F_2m (F_{2m+1} + F_{2m-1}), exactly", 0.0, 0.0);
    lattice_check even = lattice_begin("eq. 12", "Phi^2m + Phi^-2m = F_{2m+1} + F_{2m-1}", 0.0, rounding);
    for (size_t m = 1; m <= 19; ++m) {
        const double both = lattice_fibonacci(2 * m + 1) + lattice_fibonacci(2 * m - 1), which = (double)m;
        lattice_count(&product, which, lattice_fibonacci(4 * m) - lattice_fibonacci(2 * m) * both);
        lattice_count(&even, which,
                      relative(pow(golden, 2.0 * which) + pow(golden, -2.0 * which), both, both));
    }
    lattice_end(run, &product);
    lattice_end(run, &even);
}

/* Among b_{k-1}, b_k, b_{k+1} with b_k the shortest: the ratio of the longest to it. */
static double elongation(double n, double sx) {
    const size_t k = lattice_shortest(n, sx);
    return sqrt(fmax(lattice_length2(k - 1, n, sx), lattice_length2(k + 1, n, sx)) /
                lattice_length2(k, n, sx));
}

/* Eqs 22 to 40 and 56 for every size. */
static void check_sizes(lab_run *run, size_t largest) {
    const double limit = 2.0 / sqrt(5.0);
    lattice_check index = lattice_begin("eq. 23", "k_opt, rounded, is the shortest basis vector", 0.0, 0.0);
    lattice_check distance = lattice_begin("eq. 24", "2/sqrt 5 < N d_min^2 < 1", limit, 1.0);
    lattice_check exact =
        lattice_begin("eq. 24 corrected", "2/sqrt 5 - 2/(5N) <= N d_min^2, as N d_min^2 + 2/(5N)",
                      limit - rounding, INFINITY);
    lattice_check shape =
        lattice_begin("eq. 40", "the elongation is between sqrt(3/2) and sqrt 2", sqrt(1.5), sqrt(2.0));
    lattice_check late = lattice_begin("eq. 40 corrected", "the same within 1/N", 0.0, 1.0);
    lattice_check period = lattice_begin(
        "fig. 5", "no grid is periodic in x: N times the distance of N/Phi from integers", 0.3, INFINITY);
    char wrong[160] = "";
    exact.ours = late.ours = true;
    size_t used = 0;
    for (size_t i = 2; i <= largest; ++i) {
        const double n = (double)i;
        const size_t shortest = lattice_shortest(n, 1.0);
        const double formula = nearbyint(log(5.0 * n * n + 1.0) / (4.0 * log(lattice_golden)));
        lattice_count(&index, n, formula - (double)shortest);
        if (formula != (double)shortest && used < sizeof wrong)
            used += (size_t)snprintf(wrong + used, sizeof wrong - used, " %zu", i);
        const double square = n * lattice_length2(shortest, n, 1.0), r = elongation(n, 1.0);
        lattice_count(&distance, n, square);
        lattice_count(&exact, n, square + 0.4 / n);
        lattice_count(&shape, n, r);
        lattice_count(&late, n, n * fmax(0.0, fmax(sqrt(1.5) - r, r - sqrt(2.0))));
        lattice_count(&period, n, n * fabs(n / lattice_golden - nearbyint(n / lattice_golden)));
    }
    lattice_end(run, &index);
    lab_note(run, "eq. 23 is not the shortest at N =%s", wrong);
    lattice_end(run, &distance);
    lattice_end(run, &exact);
    lattice_end(run, &shape);
    lattice_end(run, &late);
    lattice_end(run, &period);
}

/* Eqs 41 to 49: 400 stretch factors between 1/100 and 100 of a large grid, whose Fibonacci numbers are powers
 * of Phi to 1e-3; and eq. 56, by which parity b_g/2 is b_{g mod 3}/2 up to a lattice vector. */
static void check_stretches(lab_run *run) {
    lattice_check stretched =
        lattice_begin("eq. 49", "the elongation of a stretched grid has the same bounds, to .002",
                      sqrt(1.5) - 0.002, sqrt(2.0) + 0.002);
    for (size_t i = 0; i < 400; ++i) {
        const double stretch = pow(10.0, -2.0 + 4.0 * ((double)i + 0.5) / 400.0);
        lattice_count(&stretched, stretch, elongation(LARGEST, stretch));
    }
    lattice_end(run, &stretched);
    lattice_check parity = lattice_begin(
        "eq. 56", "a shift by b_g/2 is one by b_s/2, s = g mod 3: both coordinates even", 0.0, 0.0);
    for (size_t g = 1; g <= LATTICE_MOST_INDEX; ++g) {
        const size_t s = g % 3;
        const double before = s > 0 ? lattice_fibonacci(s - 1) : 1.0;
        lattice_count(&parity, (double)g, fmod(lattice_fibonacci(g) + lattice_fibonacci(s), 2.0));
        lattice_count(&parity, (double)g, fmod(lattice_fibonacci(g - 1) + before, 2.0));
    }
    lattice_end(run, &parity);
}

static aur_result run(lab_run *run, aur_error *error) {
    check_identities(run);
    check_sizes(run, lab_run_options(run)->quick ? QUICK_LARGEST : LARGEST);
    check_stretches(run);
    return lattice_check_points(run, error);
}

static const char *const columns[] = {"item",     "statement", "cases",      "least",           "most",
                                      "at_least", "at_most",   "exceptions", "first_exception", NULL};

static const report_plot plots[] = {
    {.name = "vectors",
     .title = "Fig. 3: basis vectors of 20 points",
     .table = "vectors",
     .x = "x",
     .y = "y",
     .series = "what",
     .points = true},
    {.name = "plane",
     .title = "Figs 2, 5 and 6: the plane of a grid, the grid moved, and the extended grid",
     .table = "plane",
     .x = "x",
     .y = "y",
     .series = "what",
     .panel = "figure",
     .points = true},
    {.name = NULL},
};

const lab_experiment lab_marques_2019_lattice = {
    .name = "marques-2019-lattice",
    .reproduces = "Marques 2019, figs 2 to 7, sections 3 to 5",
    .summary = "statements on the lattice of spherical Fibonacci grids, each over many cases",
    .columns = columns,
    .plots = plots,
    .takes_no_set = "the statements are on Fibonacci grids alone",
    .seconds = 0.7,
    .quick_seconds = 0.2,
    .run = run,
};

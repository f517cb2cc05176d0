/* Rotations lifted from points of the sphere and from lattices of the cube, at sizes that double and preserve
 * their points, compared with a super-Fibonacci spiral of each size.
 *
 * A direction with azimuth phi and a rotation psi about it form a rotation with the azimuths a = (psi +
 * phi)/2 and b = (psi - phi)/2 in Hopf coordinates, u = (1 + z)/2. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/lab/lab.h"
#include "program/lab/points.h"

enum { BASE = 128, LAST = 8192, QUICK = 256, SEARCHED = 256 };

static const double pi = 3.14159265358979323846;

/* The rotation about the direction of point i of a doubling grid, as a fraction of a turn. */
typedef double (*turn_of)(size_t i);

static double fraction(double x) {
    return x - floor(x);
}

static double van_der_corput(size_t i) {
    double value = 0.0;
    for (double digit = 0.5; i > 0; i >>= 1, digit *= 0.5)
        value += digit * (double)(i & 1);
    return value;
}

static double root_of_two(size_t i) {
    return fraction((double)i * sqrt(2.0));
}

/* Root of x^3 = x + 1: its powers generalise the golden ratio to the plane. */
static double plastic(size_t i) {
    return fraction((double)i / 1.3247179572447460260);
}

/* The base grid uses root_of_two; each copy is rotated by a fraction with as many binary digits as there were
 * doublings. */
static double by_copy(size_t i) {
    return fraction(root_of_two(i % BASE) + van_der_corput(i / BASE));
}

typedef struct lift {
    const char *name;
    const char *set; /* directions, or rotations without a turn; NULL: a lattice, to be searched */
    turn_of turn;    /* NULL: none */
    size_t base;     /* the first size */
} lift;

static const lift lifts[] = {
    {"super-fibonacci-grid", "super-fibonacci-grid:base=128,levels=2", NULL, BASE},
    {"esfg-rotations, 20 times 6", "esfg-rotations:levels=2", NULL, 120},
    {"esfg-rotations, 16 times 8", "esfg-rotations:base=16,turns=8,levels=2", NULL, BASE},
    {"E-SFG, turns i sqrt 2", "esfg:base=128,levels=3", root_of_two, BASE},
    {"E-SFG, turns i / plastic number", "esfg:base=128,levels=3", plastic, BASE},
    {"E-SFG, van der Corput turns", "esfg:base=128,levels=3", van_der_corput, BASE},
    {"E-SFG, turned by copy", "esfg:base=128,levels=3", by_copy, BASE},
    {"Korobov lattice", NULL, NULL, BASE},
    {"sobol", "sobol", NULL, BASE},
};

/* Hopf coordinates to w,x,y,z; a and b are fractions of a turn. */
static void put(double u, double a, double b, double wxyz[4]) {
    wxyz[0] = sqrt(u) * sin(2.0 * pi * a);
    wxyz[1] = sqrt(u) * cos(2.0 * pi * a);
    wxyz[2] = sqrt(1.0 - u) * sin(2.0 * pi * b);
    wxyz[3] = sqrt(1.0 - u) * cos(2.0 * pi * b);
}

static aur_result figure(const char *metric, size_t count, const double *wxyz, size_t threads, double *value,
                         aur_error *error) {
    const aur_points_view view = aur_points_view_of(AUR_DOMAIN_ROTATIONS, count, 4, wxyz);
    aur_measure_options how = {.size = sizeof how};
    aur_measure_options_init(&how, NULL);
    how.threads = threads;
    return aur_measure(metric, &view, &how, value, error);
}

static void turn_directions(turn_of turn, const aur_points_view *points, double *wxyz) {
    for (size_t i = 0; i < points->count; ++i) {
        const double *const x = points->coordinates + points->stride * i;
        const double psi = turn(i), phi = atan2(x[1], x[0]) / (2.0 * pi);
        put(0.5 * (1.0 + x[2]), 0.5 * (psi + phi), 0.5 * (psi - phi), wxyz + 4 * i);
    }
}

/* Points j (1, g, g^2)/n, with heights centred for LAST points. */
static void fill_lattice(size_t n, size_t g, double *wxyz) {
    for (size_t j = 0; j < n; ++j)
        put((double)j / (double)n + 0.5 / LAST, (double)(j * g % n) / (double)n,
            (double)(g * g % n * j % n) / (double)n, wxyz + 4 * j);
}

/* The generator with the smallest energy: among all odd ones at SEARCHED points, then with or without one
 * more binary digit per doubling, so that lattices contain the previous ones. */
static aur_result find_generator(size_t count, size_t threads, double *wxyz, size_t *generator,
                                 aur_error *error) {
    double least = INFINITY;
    for (size_t n = SEARCHED; n <= (count > SEARCHED ? count : SEARCHED); n *= 2) {
        const size_t store = *generator;
        least = INFINITY;
        for (size_t g = n == SEARCHED ? 1 : store; g < n; g += n == SEARCHED ? 2 : n / 2) {
            double energy;
            fill_lattice(n, g, wxyz);
            const aur_result result = figure("energy", n, wxyz, threads, &energy, error);
            if (result != AUR_OK)
                return result;
            if (energy < least)
                *generator = g;
            least = fmin(least, energy);
        }
    }
    return AUR_OK;
}

static aur_result make(const lift *from, size_t count, size_t threads, double *wxyz, aur_error *error) {
    if (from->set == NULL) {
        size_t generator = 1;
        const aur_result result = find_generator(count, threads, wxyz, &generator, error);
        fill_lattice(count, generator, wxyz);
        return result;
    }
    const aur_domain domain = from->turn != NULL ? AUR_DOMAIN_SPHERE : AUR_DOMAIN_ROTATIONS;
    aur_directions_options set = {.size = sizeof set};
    aur_directions_options_init(count, domain, &set, NULL);
    aur_points_request request = {.size = sizeof request};
    aur_points_request_init(&set, &request, NULL);
    aur_points *points;
    const aur_result result = aur_points_generate(from->set, &request, &points, error);
    if (result != AUR_OK)
        return result;
    const aur_points_view *const view = aur_points_get_view(points);
    if (from->turn != NULL)
        turn_directions(from->turn, view, wxyz);
    else
        memcpy(wxyz, view->coordinates, 4 * count * sizeof *wxyz);
    aur_points_destroy(points);
    return AUR_OK;
}

static aur_result row(lab_run *run, const lift *from, size_t count, double *wxyz, aur_error *error) {
    static const char *const metrics[] = {"energy", "min-angle", "covering"};
    const size_t threads = lab_run_options(run)->threads;
    const lab_points spiral = {.set = "super-fibonacci", .domain = AUR_DOMAIN_ROTATIONS, .size = count};
    aur_result result = make(from, count, threads, wxyz, error);
    if (result == AUR_OK) {
        lab_text(run, from->name);
        lab_number(run, (double)count);
    }
    for (size_t m = 0; m < 3 && result == AUR_OK; ++m) {
        double value = 0.0, other = 1.0;
        result = figure(metrics[m], count, wxyz, threads, &value, error);
        if (result == AUR_OK)
            result = lab_figure(&spiral, metrics[m], threads, &other, error);
        if (result == AUR_OK)
            lab_number(run, value / other);
    }
    return result;
}

static const char *const columns[] = {"lift",           "rotations",     "energy_over",
                                      "min_angle_over", "covering_over", NULL};

static aur_result run(lab_run *run, aur_error *error) {
    const size_t last = lab_run_options(run)->quick ? QUICK : LAST;
    double *const wxyz = malloc(4 * LAST * sizeof *wxyz);
    if (wxyz == NULL) {
        *error = (aur_error){.result = AUR_ERROR_MEMORY, .message = "out of memory"};
        return AUR_ERROR_MEMORY;
    }
    aur_result result = AUR_OK;
    for (size_t k = 0; k < sizeof lifts / sizeof lifts[0]; ++k)
        for (size_t count = lifts[k].base; count <= last && result == AUR_OK; count *= 2)
            if (lab_row_requested(run, lifts[k].name))
                result = row(run, &lifts[k], count, wxyz, error);
    free(wxyz);
    return result;
}

const lab_experiment lab_domains_lifts = {
    .name = "domains-lifts",
    .reproduces = "docs/domains.md",
    .summary = "rotations lifted from directions and lattices that double, over a super-Fibonacci spiral of "
               "each size",
    .rows = "lift",
    .columns = columns,
    .takes_no_set = "what a lift does with directions is part of it",
    .seconds = 8,
    .quick_seconds = 0.1,
    .run = run,
};

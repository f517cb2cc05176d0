/* A set that has the opposite of each point is exact for odd polynomials anyway. The means of the even
 * harmonics of degrees 2 .. t-1 remain: t(t+1)/2 - 1 equations for two angles per point of one half, so that
 * t^2/2 points suffice (Womersley 2018). Solved by damped Gauss-Newton steps (Levenberg 1944, Marquardt 1963)
 * from a spherical Fibonacci set. */
#include "points/sphere/sets/design.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/random.h"
#include "points/base/simd.h"
#include "points/linear/solve.h"
#include "points/sphere/phase.h"

enum { STARTS = 4, STEPS = 150, POLISHING = 3, SUMS = 8 };

/* The norm of all means at rounding level, and the largest mean allowed in a design. */
static const double arrived = 1e-13, largest_mean = 1e-14;

typedef struct design {
    size_t degree, count, equations;
    double *points, *candidate; /* count unit vectors each */
    double *jacobian; /* equations rows: derivatives of a mean by moves of all points east, then north */
    double *system, *inverse, *work;        /* of aur_cholesky */
    double *means, *candidate_means, *step; /* equations, equations, 2 count */
    double *rows;                           /* count numbers each, of `rows_here` */
} design;

/* For all points: Legendre's functions of one order without their factor r^m, their slopes, and the
 * trigonometric parts r^(m-1) cos(m phi) and r^(m-1) sin(m phi), and r. */
enum { HERE, BEFORE, SLOPE, SLOPE_BEFORE, COSINE, SINE, RADIUS, ROWS };

size_t aur_design_half(size_t degree) {
    return (degree * degree + degree + 7) / 4 + degree / 8;
}

static double sum_of(size_t count, const double *values) {
    double sums[SUMS] = {0.0};
    for (size_t i = 0; i < count; ++i)
        sums[i % SUMS] += values[i];
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

static double dot(size_t count, const double *a, const double *b) {
    double sums[SUMS] = {0.0};
    for (size_t i = 0; i < count; ++i)
        sums[i % SUMS] += a[i] * b[i];
    return sum_of(SUMS, sums);
}

static double radius_of(const double *point) {
    return sqrt(point[0] * point[0] + point[1] * point[1]);
}

/* One harmonic of mean square 1, r `part` P: its mean, and the row of the Jacobian unless that is NULL.
 * `other` is the derivative of the part by the azimuth, divided by m. */
static double add_equation(design *d, size_t m, const double *points, const double *part, const double *other,
                           double sign, double *row) {
    const size_t n = d->count;
    const double *const here = d->rows + HERE * n, *const slope = d->rows + SLOPE * n;
    const double *const radius = d->rows + RADIUS * n;
    double *const values = d->step;
    for (size_t i = 0; i < n; ++i)
        values[i] = here[i] * part[i] * radius[i];
    const double mean = sum_of(n, values) / (double)n;
    if (row == NULL)
        return mean;
    const double order = (double)m, share = 1.0 / (double)n;
    for (size_t i = 0; i < n; ++i) {
        const double *const p = points + 3 * i;
        const double square = p[0] * p[0] + p[1] * p[1];
        row[i] = share * sign * order * here[i] * other[i];
        row[n + i] = share * part[i] * (square * slope[i] - order * p[2] * here[i]);
    }
    return mean;
}

/* From degree l to l + 1, by the recurrence of normalised functions. */
static void raise_degree(design *d, size_t l, size_t m, const double *points) {
    const size_t n = d->count;
    const double a = sqrt((double)((2 * l + 1) * (2 * l + 3)) / (double)((l + 1 - m) * (l + 1 + m)));
    const double b = l == m ? 0.0
                            : sqrt((double)((2 * l + 3) * (l - m) * (l + m)) /
                                   (double)((2 * l - 1) * (l + 1 - m) * (l + 1 + m)));
    double *const here = d->rows + HERE * n, *const before = d->rows + BEFORE * n;
    double *const slope = d->rows + SLOPE * n, *const slope_before = d->rows + SLOPE_BEFORE * n;
    for (size_t i = 0; i < n; ++i) {
        const double z = points[3 * i + 2];
        const double next = a * z * here[i] - b * before[i];
        const double next_slope = a * (here[i] + z * slope[i]) - b * slope_before[i];
        before[i] = here[i];
        slope_before[i] = slope[i];
        here[i] = next;
        slope[i] = next_slope;
    }
}

/* The trigonometric parts of order m from those of m - 1. */
static void raise_order(design *d, size_t m, const double *points) {
    const size_t n = d->count;
    double *const cosine = d->rows + COSINE * n, *const sine = d->rows + SINE * n;
    for (size_t i = 0; i < n; ++i) {
        const double *const p = points + 3 * i;
        const double radius = m == 1 ? radius_of(p) : 1.0; /* of order 0 the first is 1/r */
        const double x = p[0] / radius, y = p[1] / radius;
        const double c = m == 1 ? 1.0 : cosine[i], s = m == 1 ? 0.0 : sine[i];
        cosine[i] = x * c - y * s;
        sine[i] = y * c + x * s;
    }
}

/* The means of all even harmonics, and, unless `jacobian` is NULL, their changes. Returns the norm. */
static double find_means(design *d, const double *points, double *means, double *jacobian) {
    const size_t n = d->count;
    double *const rows = d->rows, scale = 1.0;
    size_t k = 0;
    for (size_t i = 0; i < n; ++i) {
        rows[RADIUS * n + i] = radius_of(points + 3 * i);
        rows[COSINE * n + i] = 1.0 / rows[RADIUS * n + i];
        rows[SINE * n + i] = 0.0;
    }
    for (size_t m = 0; m < d->degree; ++m) {
        if (m > 0) {
            raise_order(d, m, points);
            scale *= sqrt((double)(2 * m + 1) / (double)(2 * m)) * (m == 1 ? sqrt(2.0) : 1.0);
        }
        for (size_t i = 0; i < n; ++i) {
            rows[HERE * n + i] = scale;
            rows[BEFORE * n + i] = rows[SLOPE * n + i] = rows[SLOPE_BEFORE * n + i] = 0.0;
        }
        const double *const cosine = rows + COSINE * n, *const sine = rows + SINE * n;
        for (size_t l = m; l < d->degree; raise_degree(d, l++, m, points)) {
            if (l % 2 != 0 || l == 0)
                continue;
            for (size_t part = 0; part < (m > 0 ? 2 : 1); ++part, ++k)
                means[k] =
                    add_equation(d, m, points, part == 0 ? cosine : sine, part == 0 ? sine : cosine,
                                 part == 0 ? -1.0 : 1.0, jacobian == NULL ? NULL : jacobian + k * 2 * n);
        }
    }
    return sqrt(dot(k, means, means));
}

/* The trial points: after the shortest step that solves the damped linear equations. */
static bool try_step(design *d, double damping) {
    const size_t n = d->count, size = d->equations;
    const aur_cholesky *const cholesky = &AUR_KERNEL_HERE(aur_cholesky);
    cholesky->gram(size, 2 * n, d->jacobian, d->system, d->work);
    double trace = 0.0;
    for (size_t k = 0; k < size; ++k)
        trace += d->system[k * size + k];
    for (size_t k = 0; k < size; ++k)
        d->system[k * size + k] += damping * trace / (double)size;
    if (!cholesky->factor(size, d->system, d->inverse, d->work))
        return false;
    memcpy(d->candidate_means, d->means, size * sizeof *d->means);
    cholesky->solve(size, d->system, d->inverse, 1, d->candidate_means);
    memset(d->step, 0, 2 * n * sizeof *d->step);
    for (size_t k = 0; k < size; ++k)
        for (size_t i = 0; i < 2 * n; ++i)
            d->step[i] -= d->candidate_means[k] * d->jacobian[k * 2 * n + i];
    for (size_t i = 0; i < n; ++i) {
        const double *const p = d->points + 3 * i;
        const double radius = radius_of(p);
        const double east = d->step[i], north = d->step[n + i];
        double *const to = d->candidate + 3 * i;
        to[0] = p[0] - east * p[1] / radius - north * p[2] * p[0] / radius;
        to[1] = p[1] + east * p[0] / radius - north * p[2] * p[1] / radius;
        to[2] = p[2] + north * radius;
        const double length = sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
        for (size_t c = 0; c < 3; ++c)
            to[c] /= length;
    }
    return true;
}

/* Half a spherical Fibonacci set; later starts are disturbed more and more. */
static void start_points(design *d, size_t start) {
    const double spread = (double)start / STARTS;
    for (size_t i = 0; i < d->count; ++i) {
        double moved[2];
        for (size_t c = 0; c < 2; ++c)
            moved[c] = spread * (aur_unit_double(aur_hash4(d->degree, start, i, c)) - 0.5);
        const double z = 1.0 - ((double)i + 0.5 + 0.9 * moved[0]) / (double)d->count;
        const double radius = sqrt((1.0 - z) * (1.0 + z));
        double sine, cosine;
        aur_phase_sincos(i * AUR_GOLDEN_PHASE + aur_phase_from_turns(moved[1] / sqrt((double)d->count)),
                         &sine, &cosine);
        memcpy(d->points + 3 * i, (double[]){radius * cosine, radius * sine, z}, 3 * sizeof *d->points);
    }
}

/* Iterates until only rounding remains; false if it does not converge. */
static bool descend(design *d) {
    double damping = 2e-3, norm = find_means(d, d->points, d->means, d->jacobian);
    int polished = 0;
    for (int step = 0; step < STEPS && damping < 1e8 && polished < POLISHING; ++step) {
        const bool near = norm < arrived;
        const bool moved = try_step(d, fmax(damping * fmin(1.0, norm), 1e-14));
        const double found = moved ? find_means(d, d->candidate, d->candidate_means, NULL) : INFINITY;
        polished += near;
        if (found < norm) {
            memcpy(d->points, d->candidate, 3 * d->count * sizeof *d->points);
            norm = find_means(d, d->points, d->means, d->jacobian);
            damping /= 5.0;
        } else {
            damping *= 4.0;
            polished += near ? POLISHING : 0;
        }
    }
    double largest = 0.0;
    for (size_t k = 0; k < d->equations; ++k)
        largest = fmax(largest, fabs(d->means[k]));
    return largest <= largest_mean;
}

aur_result aur_design_solve(size_t degree, double *half, aur_error *error) {
    const size_t n = aur_design_half(degree), size = degree * (degree + 1) / 2 - 1;
    design d = {.degree = degree, .count = n, .equations = size};
    const size_t lengths[] = {3 * n, 3 * n, 2 * n * size, size * size, size, aur_cholesky_work(size),
                              size,  size,  2 * n,        ROWS * n};
    double **const arrays[] = {&d.points, &d.candidate, &d.jacobian,        &d.system, &d.inverse,
                               &d.work,   &d.means,     &d.candidate_means, &d.step,   &d.rows};
    size_t total = 0;
    for (size_t a = 0; a < sizeof lengths / sizeof *lengths; ++a)
        total += lengths[a];
    double *const room = malloc(total * sizeof *room);
    if (room == NULL)
        return aur_fail_memory(error);
    total = 0;
    for (size_t a = 0; a < sizeof lengths / sizeof *lengths; total += lengths[a++])
        *arrays[a] = room + total;
    bool found = false;
    for (size_t start = 0; start < STARTS && !found; ++start) {
        start_points(&d, start);
        found = descend(&d);
    }
    memcpy(half, d.points, 3 * n * sizeof *half);
    free(room);
    return found ? AUR_OK
                 : aur_fail(error, AUR_ERROR_INTERNAL, "no spherical design of degree %zu was found", degree);
}

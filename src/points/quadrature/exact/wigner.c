/* Real Wigner functions: the matrices that turn real spherical harmonics (Ivanic and Ruedenberg 1996, with
 * the correction of 1998), and their parts that are invariant under crystal and sample symmetries. */
#include <aureole/rotations.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/quadrature/exact/space.h"
#include "points/sphere/map.h"

/* The matrix of a degree; orders go from -degree to degree. */
typedef struct turned {
    long degree;
    const double *values;
} turned;

static double at(const turned *m, long row, long column) {
    const long width = 2 * m->degree + 1;
    return m->values[(row + m->degree) * width + column + m->degree];
}

/* P of table 1 of the paper. */
static double product(const turned *first, const turned *before, long i, long row, long column) {
    const long l = before->degree + 1;
    if (column == l)
        return at(first, i, 1) * at(before, row, l - 1) - at(first, i, -1) * at(before, row, 1 - l);
    if (column == -l)
        return at(first, i, 1) * at(before, row, 1 - l) + at(first, i, -1) * at(before, row, l - 1);
    return at(first, i, 0) * at(before, row, column);
}

static double v_part(const turned *first, const turned *before, long m, long n) {
    if (m == 0)
        return product(first, before, 1, 1, n) + product(first, before, -1, -1, n);
    if (m > 0)
        return product(first, before, 1, m - 1, n) * (m == 1 ? sqrt(2.0) : 1.0) -
               (m == 1 ? 0.0 : product(first, before, -1, 1 - m, n));
    return (m == -1 ? 0.0 : product(first, before, 1, m + 1, n)) +
           product(first, before, -1, -m - 1, n) * (m == -1 ? sqrt(2.0) : 1.0);
}

static double w_part(const turned *first, const turned *before, long m, long n) {
    if (m > 0)
        return product(first, before, 1, m + 1, n) + product(first, before, -1, -m - 1, n);
    return product(first, before, 1, m - 1, n) - product(first, before, -1, 1 - m, n);
}

/* The matrix of degree l >= 2 from those of degrees 1 and l - 1. */
static void next_matrix(const turned *first, const turned *before, double *values) {
    const long l = before->degree + 1;
    for (long m = -l; m <= l; ++m)
        for (long n = -l; n <= l; ++n) {
            const long a = labs(m);
            const double below = labs(n) < l ? (double)((l + n) * (l - n)) : (double)(2 * l * (2 * l - 1));
            const double u = sqrt((double)((l + m) * (l - m)) / below);
            const double v = 0.5 * sqrt((m == 0 ? 2.0 : 1.0) * (double)((l + a - 1) * (l + a)) / below) *
                             (m == 0 ? -1.0 : 1.0);
            const double w = m == 0 ? 0.0 : -0.5 * sqrt((double)((l - a - 1) * (l - a)) / below);
            double sum = v * v_part(first, before, m, n);
            if (u != 0.0)
                sum += u * product(first, before, 0, m, n);
            if (w != 0.0)
                sum += w * w_part(first, before, m, n);
            values[(m + l) * (2 * l + 1) + n + l] = sum;
        }
}

/* The matrix of degree `degree`: `values` has that of the previous degree, whose `room` may be overwritten.
 */
static void step(const double quaternion[4], long degree, const double *before, double *values) {
    static const size_t axis[] = {1, 2, 0}; /* the orders -1, 0, 1 are y, z, x */
    aur_rotation rotation;
    double one[9];
    aur_rotation_from_quaternion(quaternion, &rotation);
    for (size_t i = 0; i < 9; ++i)
        one[i] = rotation.m[3 * axis[i / 3] + axis[i % 3]];
    if (degree == 0)
        values[0] = 1.0;
    else if (degree == 1)
        memcpy(values, one, sizeof one);
    else
        next_matrix(&(turned){1, one}, &(turned){degree - 1, before}, values);
}

/* The number of functions of a degree that are invariant under a group: the mean of its characters. */
static size_t invariants(aur_symmetry symmetry, size_t degree) {
    double group[4 * AUR_SYMMETRY_ORDER_MAX], sum = 0.0;
    const size_t order = aur_symmetry_group(symmetry, group);
    for (size_t k = 0; k < order; ++k) {
        const double *const q = group + 4 * k;
        const double half = atan2(sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), q[0]);
        sum += sin(half) < 1e-9 ? 2.0 * (double)degree + 1.0
                                : sin((2.0 * (double)degree + 1.0) * half) / sin(half);
    }
    return (size_t)(sum / (double)order + 0.5);
}

size_t aur_wigner_size(aur_symmetry crystal, aur_symmetry sample, size_t degree) {
    return invariants(crystal, degree) * invariants(sample, degree);
}

/* Orthonormal rows that span the invariant subspace: columns of the mean matrix, the longest first. */
static void span(const double *mean, size_t width, size_t count, double *basis, double *room) {
    memcpy(room, mean, width * width * sizeof *room);
    for (size_t k = 0; k < count; ++k) {
        size_t best = 0;
        double longest = -1.0;
        for (size_t c = 0; c < width; ++c) {
            double square = 0.0;
            for (size_t r = 0; r < width; ++r)
                square += room[r * width + c] * room[r * width + c];
            best = square > longest ? c : best;
            longest = fmax(longest, square);
        }
        double *const row = basis + k * width;
        for (size_t r = 0; r < width; ++r)
            row[r] = room[r * width + best] / sqrt(longest);
        for (size_t c = 0; c < width; ++c) {
            double part = 0.0;
            for (size_t r = 0; r < width; ++r)
                part += row[r] * room[r * width + c];
            for (size_t r = 0; r < width; ++r)
                room[r * width + c] -= part * row[r];
        }
    }
}

/* For one degree: the invariant parts of both sides, and memory for matrices. */
typedef struct degree_work {
    size_t width, sides[2]; /* of the sample, on the left, and of the crystal */
    double *basis[2], *mean, *room[2];
} degree_work;

static void find_side(aur_symmetry symmetry, size_t degree, degree_work *w, size_t side) {
    double group[4 * AUR_SYMMETRY_ORDER_MAX];
    const size_t order = aur_symmetry_group(symmetry, group), size = w->width * w->width;
    memset(w->mean, 0, size * sizeof *w->mean);
    for (size_t k = 0; k < order; ++k) {
        for (size_t l = 0; l <= degree; ++l)
            step(group + 4 * k, (long)l, w->room[(l + 1) % 2], w->room[l % 2]);
        for (size_t i = 0; i < size; ++i)
            w->mean[i] += w->room[degree % 2][i] / (double)order;
    }
    w->sides[side] = invariants(symmetry, degree);
    span(w->mean, w->width, w->sides[side], w->basis[side], w->room[0]);
}

/* Writes the functions of one degree at one rotation, whose matrix is `matrix`, `stride` apart. */
static void project(const degree_work *w, const double *matrix, size_t stride, double *values) {
    const double scale = sqrt((double)w->width);
    for (size_t a = 0; a < w->sides[0]; ++a)
        for (size_t b = 0; b < w->sides[1]; ++b) {
            double sum = 0.0;
            for (size_t r = 0; r < w->width; ++r) {
                const double left = w->basis[0][a * w->width + r];
                double part = 0.0;
                for (size_t c = 0; left != 0.0 && c < w->width; ++c)
                    part += matrix[r * w->width + c] * w->basis[1][b * w->width + c];
                sum += left * part;
            }
            values[(a * w->sides[1] + b) * stride] = scale * sum;
        }
}

/* Without symmetries the matrix itself. */
static void copy(const degree_work *w, const double *matrix, size_t stride, double *values) {
    const double scale = sqrt((double)w->width);
    for (size_t k = 0; k < w->width * w->width; ++k)
        values[k * stride] = scale * matrix[k];
}

aur_result aur_wigner_rows(aur_symmetry crystal, aur_symmetry sample, size_t degree, size_t count,
                           const double *wxyz, double *rows, aur_error *error) {
    const size_t most = (2 * degree + 1) * (2 * degree + 1);
    const bool plain = crystal == AUR_SYMMETRY_1 && sample == AUR_SYMMETRY_1;
    double *const storage = malloc((5 * most + 2 * most * count) * sizeof *storage);
    if (storage == NULL)
        return aur_fail_memory(error);
    degree_work w = {.basis = {storage, storage + most},
                     .mean = storage + 2 * most,
                     .room = {storage + 3 * most, storage + 4 * most}};
    double *const matrices = storage + 5 * most; /* of each rotation: of a degree and of the one before */
    for (size_t l = 0; l <= degree; ++l) {
        w.width = 2 * l + 1;
        if (!plain) {
            find_side(sample, l, &w, 0);
            find_side(crystal, l, &w, 1);
        }
        for (size_t i = 0; i < count; ++i) {
            double *const here = matrices + (2 * i + l % 2) * most;
            step(wxyz + 4 * i, (long)l, matrices + (2 * i + (l + 1) % 2) * most, here);
            if (plain)
                copy(&w, here, count, rows + i);
            else
                project(&w, here, count, rows + i);
        }
        rows += aur_wigner_size(crystal, sample, l) * count;
    }
    free(storage);
    return AUR_OK;
}

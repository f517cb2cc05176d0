/* Points of maximal determinant (Fekete points; Sloan and Womersley 2004): (L+1)^2 of them, at which
 * polynomials of degree L are interpolated best. The determinant is that of the matrix of the reproducing
 * kernel, sum over l of (2l+1)/(4 pi) P_l(x_i . x_j); L-BFGS maximises its logarithm from equilibria of
 * repelling charges, plain and perturbed. Their weights are exact to degree L. O(N^3) per step. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/file.h"
#include "points/base/random.h"
#include "points/sphere/native.h"
#include "points/sphere/phase.h"
#include "points/sphere/repulsion/descent.h"
#include "points/sphere/repulsion/repulsion.h"

enum { VERSION = 1, DEGREE_MAX = 25 };

typedef struct determinant {
    size_t count, stride, degree;
    const double *coordinates;
    double *gram, *inverse; /* count^2; the factor is in the lower half of gram */
} determinant;

/* The kernel and its derivative at a cosine, over 1/(4 pi). */
static double kernel(size_t degree, double t, double *slope) {
    double before = 1.0, here = t, sum = 1.0, before_slope = 0.0, here_slope = 1.0, slopes = 0.0;
    for (size_t l = 1; l <= degree; ++l) {
        const double k = (double)l;
        sum += (2.0 * k + 1.0) * here;
        slopes += (2.0 * k + 1.0) * here_slope;
        const double next = ((2.0 * k + 1.0) * t * here - k * before) / (k + 1.0);
        const double next_slope = before_slope + (2.0 * k + 1.0) * here;
        before = here;
        here = next;
        before_slope = here_slope;
        here_slope = next_slope;
    }
    *slope = slopes;
    return sum;
}

static double cosine(const determinant *d, size_t i, size_t j) {
    const double *const x = d->coordinates;
    const size_t s = d->stride;
    return x[i] * x[j] + x[s + i] * x[s + j] + x[2 * s + i] * x[2 * s + j];
}

/* By a series: bit-identical on every machine. */
static double logarithm(double x) {
    int exponent;
    const double mantissa = frexp(x, &exponent), s = (mantissa - 0.75) / (mantissa + 0.75), square = s * s;
    double sum = 0.0;
    for (int k = 25; k >= 1; k -= 2)
        sum = sum * square + 2.0 / k;
    return exponent * 0.69314718055994530942 - 0.28768207245178092744 + s * sum; /* ln 2, ln 4/3 */
}

static double dot(size_t count, const double *a, const double *b) {
    double sums[8] = {0.0};
    for (size_t i = 0; i + 8 <= count; i += 8)
        for (size_t k = 0; k < 8; ++k)
            sums[k] += a[i + k] * b[i + k];
    for (size_t i = count / 8 * 8; i < count; ++i)
        sums[0] += a[i] * b[i];
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

/* Cholesky's factor in the lower half; the logarithm of the determinant, or -INFINITY. */
static double factor(size_t n, double *a) {
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j <= i; ++j) {
            const double value = a[i * n + j] - dot(j, a + i * n, a + j * n);
            if (j < i) {
                a[i * n + j] = value / a[j * n + j];
            } else {
                if (!(value > 0.0))
                    return -INFINITY;
                a[i * n + i] = sqrt(value);
                sum += logarithm(value);
            }
        }
    return sum;
}

/* The inverse of the matrix: column by column of the factor's inverse, then its product with itself. */
static void invert(size_t n, const double *a, double *inverse) {
    memset(inverse, 0, n * n * sizeof *inverse);
    for (size_t c = 0; c < n; ++c) { /* row c: column c of the factor's inverse */
        double *const column = inverse + c * n;
        for (size_t i = c; i < n; ++i) {
            const double value = (i == c ? 1.0 : 0.0) - dot(i - c, a + i * n + c, column + c);
            column[i] = value / a[i * n + i];
        }
    }
    for (size_t i = 0; i < n; ++i) /* rows after i are still columns of the factor's inverse */
        for (size_t j = i; j < n; ++j)
            inverse[i * n + j] = dot(n - j, inverse + i * n + j, inverse + j * n + j);
}

/* Minus the logarithm of the determinant of 4 pi times the matrix, divided by the number of points. */
static double evaluate(void *context, double *gradient) {
    determinant *const d = context;
    const size_t n = d->count, s = d->stride;
    double slope;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j <= i; ++j)
            d->gram[i * n + j] = kernel(d->degree, i == j ? 1.0 : cosine(d, i, j), &slope);
    const double value = -factor(n, d->gram) / (double)n;
    if (!(value < INFINITY))
        return INFINITY;
    invert(n, d->gram, d->inverse);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = i + 1; j < n; ++j) {
            kernel(d->degree, cosine(d, i, j), &slope);
            const double push = -2.0 * d->inverse[i * n + j] * slope / (double)n;
            for (size_t c = 0; c < 3; ++c) {
                gradient[c * s + i] += push * d->coordinates[c * s + j];
                gradient[c * s + j] += push * d->coordinates[c * s + i];
            }
        }
    return value;
}

/* Equilibria of repelling charges from Fibonacci points, plain or perturbed. */
static aur_result start_points(size_t start, aur_charges *q, aur_error *error) {
    for (size_t i = 0; i < q->count; ++i) {
        const double share =
            start == 0 ? ((double)i + 0.5) / (double)q->count : aur_unit_double(aur_hash3(start, i, 0));
        const double turn =
            start == 0 ? (double)i * 0.6180339887498949 : aur_unit_double(aur_hash3(start, i, 1));
        const double z = 1.0 - 2.0 * share, radius = sqrt((1.0 - z) * (1.0 + z));
        double sine, cosine_of;
        aur_phase_sincos(aur_phase_from_turns(turn - floor(turn)), &sine, &cosine_of);
        q->x[i] = radius * cosine_of;
        q->y[i] = radius * sine;
        q->z[i] = z;
    }
    double energy;
    return aur_repel(&(aur_shells){1, &q->count}, q, &energy, error);
}

/* Points, followed by weights. */
static aur_result climb(size_t degree, double *xyz, aur_error *error) {
    const size_t count = (degree + 1) * (degree + 1), stride = (count + 7) / 8 * 8 + 8;
    double *const room = calloc(6 * stride + 2 * count * count, sizeof *room);
    if (room == NULL)
        return aur_fail_memory(error);
    aur_charges q = {.count = count, .x = room, .y = room + stride, .z = room + 2 * stride};
    determinant d = {.count = count,
                     .stride = stride,
                     .degree = degree,
                     .coordinates = room,
                     .gram = room + 6 * stride,
                     .inverse = room + 6 * stride + count * count};
    const aur_sphere_energy of = {evaluate, &d};
    const size_t starts = degree < 8 ? 8 : degree < 13 ? 3 : 1;
    double best = INFINITY;
    aur_result result = AUR_OK;
    for (size_t start = 0; start < starts && result == AUR_OK; ++start) {
        double value = INFINITY;
        result = start_points(start, &q, error);
        if (result == AUR_OK)
            result = aur_sphere_descend(&of, count, stride, room, &value, error);
        if (value < best)
            memcpy(room + 3 * stride, room, 3 * stride * sizeof *room);
        best = fmin(best, value);
    }
    memcpy(room, room + 3 * stride, 3 * stride * sizeof *room);
    evaluate(&d, room + 3 * stride);
    for (size_t i = 0; i < count; ++i) { /* the matrix times the weights is 1 at each point */
        for (size_t c = 0; c < 3; ++c)
            xyz[3 * i + c] = room[c * stride + i];
        xyz[3 * count + i] = 0.0;
        for (size_t j = 0; j < count; ++j)
            xyz[3 * count + i] += d.inverse[(i < j ? i : j) * count + (i < j ? j : i)];
    }
    free(room);
    return result;
}

static uint64_t size_at(size_t index) {
    return index < DEGREE_MAX ? (index + 2) * (index + 2) : 0;
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    (void)parameters;
    if (request->height != 2.0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "set '%s' fills the whole sphere, not a cap",
                        row->name);
    const size_t bytes = (1 + 4 * (size_t)request->count) * sizeof(double);
    const size_t degree = (size_t)(sqrt((double)request->count) + 0.5) - 1;
    const size_t below = (size_t)sqrt((double)request->count);
    if (degree < 1 || below * below != request->count)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set '%s' has %zu or %zu points, not %llu", row->name,
                        below > 1 ? below * below : 4, below > 1 ? (below + 1) * (below + 1) : 9,
                        (unsigned long long)request->count);
    char key[64];
    size_t size;
    snprintf(key, sizeof key, "%s %d %zu", row->name, VERSION, degree);
    *data = aur_cache_file_read(row->name, key, &size);
    if (*data != NULL && size == bytes)
        return AUR_OK;
    free(*data);
    *data = malloc(bytes);
    if (*data == NULL)
        return aur_fail_memory(error);
    *(double *)*data = (double)request->count;
    const aur_result result = climb(degree, (double *)*data + 1, error);
    if (result == AUR_OK) {
        aur_cache_file_write(row->name, key, bytes, *data);
        return AUR_OK;
    }
    free(*data);
    *data = NULL;
    return result;
}

/* The number of points, the points and their weights follow each other. */
static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    memcpy(xyz, (const double *)data + 1 + 3 * first, 3 * count * sizeof *xyz);
}

static void weigh(const void *data, uint64_t first, size_t count, double *weights) {
    const double *const all = data;
    memcpy(weights, all + 1 + 3 * (size_t)all[0] + first, count * sizeof *weights);
}

const aur_native_set aur_native_max_determinant = {
    .description =
        {.row = {.name = "max-determinant",
                 .summary =
                     "(L+1)^2 points that interpolate polynomials of degree L best, with their weights",
                 .source = "Sloan, Womersley 2004"},
         .domains = AUR_ON_SPHERE,
         .dimensions = {3, 3},
         .size_at = size_at,
         .maximum_size = (DEGREE_MAX + 1) * (DEGREE_MAX + 1)},
    .prepare = prepare,
    .fill = fill,
    .weigh = weigh,
};

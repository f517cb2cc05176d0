#include "points/quadrature/exact/space.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/array.h"
#include "points/base/error.h"
#include "points/base/parallel.h"
#include "points/quadrature/exact/transform.h"

/* The tolerance of coordinates outside a domain: rounding. */
static const double rim = 1e-9;

bool aur_exact_space_has(aur_domain domain) {
    return domain == AUR_DOMAIN_SQUARE || domain == AUR_DOMAIN_CUBE || domain == AUR_DOMAIN_DISK ||
           domain == AUR_DOMAIN_ROTATIONS;
}

static aur_result check_point(const aur_exact_space *s, size_t index, double *x, aur_error *error) {
    double square = 0.0;
    bool good = true;
    for (size_t d = 0; d < s->dimension; ++d) {
        square += x[d] * x[d];
        good = good && (s->domain == AUR_DOMAIN_DISK || s->domain == AUR_DOMAIN_ROTATIONS ||
                        (x[d] >= -rim && x[d] <= 1.0 + rim));
    }
    if (!good || !isfinite(square))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "point %zu has a coordinate outside of [0,1]", index + 1);
    if (s->domain == AUR_DOMAIN_DISK && square > 1.0 + 2.0 * rim)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "point %zu, (%g, %g), lies outside the disk", index + 1,
                        x[0], x[1]);
    if (s->domain != AUR_DOMAIN_ROTATIONS)
        return AUR_OK;
    if (!(fabs(square - 1.0) <= 2e-6))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "rotation %zu, (%g, %g, %g, %g), is not a unit quaternion",
                        index + 1, x[0], x[1], x[2], x[3]);
    size_t leading = 0;
    while (leading < 3 && x[leading] == 0.0)
        ++leading;
    const double scale = copysign(1.0 / sqrt(square), x[leading]);
    for (size_t d = 0; d < 4; ++d)
        x[d] = x[d] * scale + 0.0; /* no -0, which would be a distinct point */
    return AUR_OK;
}

static aur_result check_options(const aur_exact_options *o, aur_exact_space *s, aur_error *error) {
    if (o->cap_degrees != 0.0 || o->lobe.kind != AUR_LOBE_COSINE_POWER || o->lobe.exponent != 0.0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "caps and lobes are for directions, not for the domain '%s'",
                        aur_domain_name(o->domain));
    if (s->dimension < 1 || s->dimension > AUR_EXACT_DIMENSION_MAX)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "the dimension of the cube must be between 1 and %d, not %zu",
                        AUR_EXACT_DIMENSION_MAX, s->dimension);
    if (aur_symmetry_name(o->crystal) == NULL || aur_symmetry_name(o->sample) == NULL)
        return aur_fail(error, AUR_ERROR_ARGUMENT, "unknown symmetry %d",
                        (int)(aur_symmetry_name(o->crystal) == NULL ? o->crystal : o->sample));
    return AUR_OK;
}

aur_result aur_exact_space_open(size_t count, const double *points, const aur_exact_options *options,
                                aur_exact_space *space, aur_error *error) {
    const bool cube = options->domain == AUR_DOMAIN_CUBE, turns = options->domain == AUR_DOMAIN_ROTATIONS;
    *space = (aur_exact_space){.domain = options->domain,
                               .dimension = cube    ? options->dimension
                                            : turns ? 4
                                                    : 2,
                               .crystal = options->crystal,
                               .sample = options->sample,
                               .threads = options->threads,
                               .count = count};
    aur_result result = check_options(options, space, error);
    size_t size;
    if (result == AUR_OK && count == 0)
        result = aur_fail(error, AUR_ERROR_ARGUMENT, "weights need at least one point");
    if (result != AUR_OK)
        return result;
    if (aur_size_product(count, space->dimension * sizeof *points, &size))
        space->points = malloc(size);
    if (space->points == NULL)
        return aur_fail_memory(error);
    memcpy(space->points, points, size);
    for (size_t i = 0; i < count && result == AUR_OK; ++i)
        result = check_point(space, i, space->points + i * space->dimension, error);
    if (result != AUR_OK)
        aur_exact_space_release(space);
    return result;
}

void aur_exact_space_release(aur_exact_space *space) {
    free(space->points);
    free(space->rows);
    space->points = space->rows = NULL;
}

/* Polynomials of `dimension` variables to a degree: the binomial of degree + dimension over dimension. */
static size_t polynomials(size_t dimension, size_t degree) {
    double size = 1.0;
    for (size_t k = 1; k <= dimension && size < 1e15; ++k)
        size = floor(size * (double)(degree + k) / (double)k + 0.5);
    return size < 1e15 ? (size_t)size : SIZE_MAX;
}

size_t aur_exact_space_size(const aur_exact_space *space, size_t degree) {
    if (space->domain != AUR_DOMAIN_ROTATIONS)
        return polynomials(space->dimension, degree);
    size_t size = 0;
    for (size_t l = 0; l <= degree; ++l)
        size += aur_wigner_size(space->crystal, space->sample, l);
    return size;
}

/* Legendre polynomials of mean square 1 on [0,1]. */
static void fill_legendre(const aur_exact_space *s, size_t dimension, size_t power, const double *here,
                          const double *before, double *row) {
    const double k = (double)power, scale = sqrt((2.0 * k + 1.0) / (2.0 * k - 1.0)) * (2.0 * k - 1.0) / k;
    const double part = power > 1 ? sqrt((2.0 * k + 1.0) / (2.0 * k - 3.0)) * (k - 1.0) / k : 0.0;
    for (size_t i = 0; i < s->count; ++i) {
        const double x = 2.0 * s->points[i * s->dimension + dimension] - 1.0;
        row[i] = scale * x * here[i] - part * before[i];
    }
}

/* A product of powers: the product without its last factor, and the dimension of that factor. */
typedef struct factors {
    size_t parent, last;
} factors;

/* Products in the order of their total degrees: those of a degree are all products of lower degree times a
 * power of a later dimension. */
static void fill_products(const aur_exact_space *s, size_t degree, factors *of, size_t *single,
                          double *rows) {
    const size_t d = s->dimension, n = s->count;
    size_t at = 1;
    of[0] = (factors){0, 0};
    for (size_t i = 0; i < n; ++i)
        rows[i] = 1.0;
    for (size_t l = 1; l <= degree; ++l) {
        for (size_t k = 0; k < d; ++k) { /* powers of one dimension are first in each degree */
            single[k * (degree + 1) + l] = at;
            const size_t here = l > 1 ? single[k * (degree + 1) + l - 1] : 0;
            const size_t before = l > 2 ? single[k * (degree + 1) + l - 2] : 0;
            fill_legendre(s, k, l, rows + here * n, rows + before * n, rows + at * n);
            of[at++] = (factors){0, k};
        }
        for (size_t below = 1; below < l; ++below)
            for (size_t parent = polynomials(d, below - 1); parent < polynomials(d, below); ++parent)
                for (size_t k = of[parent].last + 1; k < d; ++k) {
                    const double *const a = rows + parent * n, *const b =
                                                                   rows +
                                                                   single[k * (degree + 1) + l - below] * n;
                    for (size_t i = 0; i < n; ++i)
                        rows[at * n + i] = a[i] * b[i];
                    of[at++] = (factors){parent, k};
                }
    }
}

static aur_result fill_cube(const aur_exact_space *s, size_t degree, size_t size, double *rows,
                            aur_error *error) {
    factors *const of = malloc(size * sizeof *of);
    size_t *const single = malloc(s->dimension * (degree + 1) * sizeof *single);
    const bool room = of != NULL && single != NULL;
    if (room)
        fill_products(s, degree, of, single, rows);
    free(of);
    free(single);
    return room ? AUR_OK : aur_fail_memory(error);
}

/* Zernike's polynomials at one point: of degree n the radial parts of the orders n, n - 2, .. times the
 * cosine and the sine (Shakibaei and Paramesran 2013 for the radial ones). `radial` has three degrees. */
static void fill_zernike(size_t degree, const double x[2], double *radial, size_t stride, double *values) {
    const double r = hypot(x[0], x[1]), c = r > 0.0 ? x[0] / r : 1.0, s = r > 0.0 ? x[1] / r : 0.0;
    const size_t width = degree + 2;
    memset(radial, 0, 3 * width * sizeof *radial);
    size_t at = 0;
    for (size_t n = 0; n <= degree; ++n) {
        double *const here = radial + n % 3 * width;
        const double *const before = radial + (n + 2) % 3 * width, *const earlier =
                                                                       radial + (n + 1) % 3 * width;
        double cosine = 1.0, sine = 0.0; /* of the order times the azimuth */
        for (size_t m = 0; m <= n; ++m) {
            if (m > 0) {
                const double next = cosine * c - sine * s;
                sine = cosine * s + sine * c;
                cosine = next;
            }
            here[m] = 0.0;
            if ((n - m) % 2 != 0)
                continue;
            if (n == 0)
                here[m] = 1.0;
            else
                here[m] = r * (before[m > 0 ? m - 1 : 1] + before[m + 1]) - (m + 2 <= n ? earlier[m] : 0.0);
            const double scale = sqrt((m > 0 ? 2.0 : 1.0) * (double)(n + 1)) * here[m];
            values[at++ * stride] = scale * cosine;
            if (m > 0)
                values[at++ * stride] = scale * sine;
        }
    }
}

static aur_result fill_disk(const aur_exact_space *s, size_t degree, double *rows, aur_error *error) {
    double *const radial = malloc(3 * (degree + 2) * sizeof *radial);
    for (size_t i = 0; i < s->count && radial != NULL; ++i)
        fill_zernike(degree, s->points + 2 * i, radial, s->count, rows + i);
    free(radial);
    return radial != NULL ? AUR_OK : aur_fail_memory(error);
}

aur_result aur_exact_space_fill(aur_exact_space *space, size_t degree, aur_error *error) {
    if (space->rows != NULL && space->filled >= degree)
        return AUR_OK;
    const size_t size = aur_exact_space_size(space, degree);
    size_t entries;
    if (!aur_size_product(size, space->count, &entries) || entries > AUR_EXACT_ENTRIES_MAX)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "degree %zu has %.4g functions, and functions times points must be at most %d",
                        degree, (double)size, AUR_EXACT_ENTRIES_MAX);
    free(space->rows);
    space->rows = malloc(entries * sizeof *space->rows);
    if (space->rows == NULL)
        return aur_fail_memory(error);
    space->filled = degree;
    if (space->domain == AUR_DOMAIN_ROTATIONS)
        return aur_wigner_rows(space->crystal, space->sample, degree, space->count, space->points,
                               space->rows, error);
    return space->domain == AUR_DOMAIN_DISK ? fill_disk(space, degree, space->rows, error)
                                            : fill_cube(space, degree, size, space->rows, error);
}

/* One of the two sums, in parts of rows or of points that do not depend on the threads. */
typedef struct sum_work {
    const aur_exact_space *space;
    size_t size;
    const double *from;
    double *to;
} sum_work;

enum { ROWS = 16, POINTS = 256 };

static aur_result analyse_piece(void *context, size_t piece) {
    const sum_work *const w = context;
    const size_t n = w->space->count, first = piece * ROWS;
    AUR_KERNEL_HERE(aur_transform_kernel)
        .dots(n, w->from, w->size - first < ROWS ? w->size - first : ROWS, n, w->space->rows + first * n, 1,
              w->to + first);
    return AUR_OK;
}

static aur_result synthesise_piece(void *context, size_t piece) {
    const sum_work *const w = context;
    const size_t n = w->space->count, first = piece * POINTS;
    const size_t last = n - first < POINTS ? n : first + POINTS;
    memset(w->to + first, 0, (last - first) * sizeof *w->to);
    for (size_t j = 0; j < w->size; ++j)
        for (size_t i = first; i < last; ++i)
            w->to[i] += w->from[j] * w->space->rows[j * n + i];
    return AUR_OK;
}

aur_result aur_exact_space_analyse(const aur_exact_space *space, size_t size, const double *weights,
                                   double *coefficients, aur_error *error) {
    const aur_parallel_options options = {.threads = space->threads, .what = "transforming"};
    sum_work work = {space, size, weights, coefficients};
    return aur_parallel_for(&options, (size + ROWS - 1) / ROWS, analyse_piece, &work, error);
}

aur_result aur_exact_space_synthesise(const aur_exact_space *space, size_t size, const double *coefficients,
                                      double *values, aur_error *error) {
    const aur_parallel_options options = {.threads = space->threads, .what = "transforming"};
    sum_work work = {space, size, coefficients, values};
    return aur_parallel_for(&options, (space->count + POINTS - 1) / POINTS, synthesise_piece, &work, error);
}

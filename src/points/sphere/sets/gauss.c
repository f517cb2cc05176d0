/* Product rules: rings at the heights of a rule of Gauss and Legendre, or of Gauss and Lobatto with a point
 * at each pole, times equal azimuths (Atkinson 1982). With 2n azimuths per ring they are exact for
 * polynomials of degree 2n - 1. Pruned rules have fewer azimuths on rings near the poles, where functions of
 * high order vanish (Courtier and Naughton 1994, Reinecke and Seljebotn 2013). */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/gauss.h"
#include "points/base/vector.h"
#include "points/sphere/native.h"

enum { LARGEST = 1024 };

/* Functions have mean square 1, and the weights of the rings add up to 1. */
static const double negligible = 1e-17;

typedef struct ring {
    double z, radius, weight; /* of all its points */
    size_t azimuths, first;
} ring;

typedef struct product {
    size_t count, rings;
    ring of[];
} product;

typedef struct gauss_keys {
    enum { LEGENDRE, LOBATTO } rings;
    bool pruned;
} gauss_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_CHOICE(
        gauss_keys, "rings", rings, "legendre",
        "legendre: 2 n^2 points; lobatto: two of the n + 1 rings are poles, 2 n (n - 1) + 2 points",
        "legendre", "lobatto")},
    {AUR_KEY_OF_BOOLEAN(
        gauss_keys, "pruned", pruned, "false",
        "fewer azimuths near the poles, exact to rounding as before: a sixth fewer points at degree 109")},
};

/* P_n and its first derivative, inside (-1, 1). */
static void legendre(size_t n, double x, double *value, double *slope) {
    double before = 1.0, here = x;
    for (size_t l = 1; l < n; ++l) {
        const double next = ((2.0 * (double)l + 1.0) * x * here - (double)l * before) / ((double)l + 1.0);
        before = here;
        here = next;
    }
    *value = here;
    *slope = (double)n * (before - x * here) / ((1.0 - x) * (1.0 + x));
}

/* n + 1 nodes: the ends and the zeros of P_n', by Newton's method. */
static void gauss_lobatto(size_t n, double *nodes, double *weights) {
    const double all = (double)n * ((double)n + 1.0);
    nodes[0] = -1.0;
    nodes[n] = 1.0;
    weights[0] = weights[n] = 2.0 / all;
    for (size_t i = 1; 2 * i <= n; ++i) {
        double x = 2 * i == n ? 0.0 : -cos(AUR_PI * (double)i / (double)n), value, slope;
        for (int step = 0; step < 8 && 2 * i != n; ++step) {
            legendre(n, x, &value, &slope);
            x -= slope * (1.0 - x) * (1.0 + x) / (2.0 * x * slope - all * value);
        }
        legendre(n, x, &value, &slope);
        nodes[i] = x;
        nodes[n - i] = -x;
        weights[i] = weights[n - i] = 2.0 / (all * value * value);
    }
}

/* Whether a function of order m and degree l <= degree is not negligible at a height; `start` is that of l =
 * m. */
static bool counts(size_t m, size_t degree, double z, double start, double least) {
    double before = 0.0, here = start;
    for (size_t l = m; l <= degree; ++l) {
        if (fabs(here) > least)
            return true;
        const double a = sqrt((double)((2 * l + 1) * (2 * l + 3)) / (double)((l + 1 - m) * (l + 1 + m)));
        const double b = l == m ? 0.0
                                : sqrt((double)((2 * l + 3) * (l - m) * (l + m)) /
                                       (double)((2 * l - 1) * (l + 1 - m) * (l + 1 + m)));
        const double next = a * z * here - b * before;
        before = here;
        here = next;
    }
    return false;
}

/* An even number of azimuths above every relevant order: K azimuths alias order K to order 0. */
static size_t azimuths_of(size_t degree, const ring *r) {
    double starts[2 * LARGEST], start = sqrt(2.0);
    for (size_t m = 1; m <= degree; ++m)
        starts[m] = start *= sqrt((double)(2 * m + 1) / (double)(2 * m)) * r->radius;
    size_t m = degree;
    while (m > 0 && !counts(m, degree, r->z, starts[m], negligible / r->weight))
        --m;
    return (m + 2) / 2 * 2;
}

/* The rule of 2n azimuths; NULL: out of memory. */
static product *create(size_t n, const gauss_keys *p) {
    const bool lobatto = p->rings == LOBATTO;
    const size_t rings = lobatto ? n + 1 : n;
    product *const created = malloc(sizeof *created + rings * sizeof created->of[0]);
    double nodes[LARGEST + 1], weights[LARGEST + 1];
    if (created == NULL)
        return NULL;
    (lobatto ? gauss_lobatto : aur_gauss_legendre)(n, nodes, weights);
    *created = (product){.rings = rings};
    for (size_t i = 0; i < rings; ++i) {
        const double z = nodes[rings - 1 - i];
        ring *const r = created->of + i;
        *r = (ring){.z = z,
                    .radius = sqrt((1.0 - z) * (1.0 + z)),
                    .weight = 0.5 * weights[rings - 1 - i],
                    .first = created->count};
        r->azimuths = r->radius == 0.0 ? 1 : p->pruned ? azimuths_of(2 * n - 1, r) : 2 * n;
        created->count += r->azimuths;
    }
    return created;
}

static size_t plain_size(size_t n, const gauss_keys *p) {
    return p->rings == LOBATTO ? 2 * n * (n - 1) + 2 : 2 * n * n;
}

static aur_result refuse(uint64_t count, size_t below, size_t above, aur_error *error) {
    if (below == 0 || above == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set 'gauss' has no rule of %llu points: the nearest has %zu",
                        (unsigned long long)count, below + above);
    return aur_fail(error, AUR_ERROR_ARGUMENT, "set 'gauss' has %zu or %zu points, not %llu", below, above,
                    (unsigned long long)count);
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    gauss_keys p;
    const aur_result result = aur_row_read(row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    if (request->height != 2.0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "set 'gauss' fills the whole sphere, not a cap");
    size_t below = 0, n = 1; /* pruned rules have at most as many points as plain ones */
    while (n < LARGEST && plain_size(n, &p) < request->count)
        ++n;
    for (; n <= LARGEST; ++n) {
        product *const created = create(n, &p);
        if (created == NULL)
            return aur_fail_memory(error);
        *data = created;
        if (created->count == request->count)
            return AUR_OK;
        const size_t found = created->count;
        free(created);
        *data = NULL;
        if (found > request->count) {
            if (below == 0 && n > 1) {
                product *const smaller = create(n - 1, &p);
                below = smaller != NULL ? smaller->count : 0;
                free(smaller);
            }
            return refuse(request->count, below, found, error);
        }
        below = found;
    }
    return refuse(request->count, below, 0, error);
}

/* The ring of a point, by bisection. */
static const ring *ring_of(const product *set, size_t point) {
    size_t low = 0, high = set->rings;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        *(set->of[middle].first <= point ? &low : &high) = middle;
    }
    return set->of + low;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    for (size_t i = 0; i < count; ++i) {
        const size_t point = (size_t)first + i;
        const ring *const r = ring_of(data, point);
        const double azimuth = 2.0 * AUR_PI * ((double)(point - r->first) + 0.5) / (double)r->azimuths;
        xyz[3 * i] = r->radius * cos(azimuth);
        xyz[3 * i + 1] = r->radius * sin(azimuth);
        xyz[3 * i + 2] = r->z;
    }
}

static void weigh(const void *data, uint64_t first, size_t count, double *weights) {
    for (size_t i = 0; i < count; ++i) {
        const ring *const r = ring_of(data, (size_t)first + i);
        weights[i] = r->weight / (double)r->azimuths;
    }
}

static uint64_t size_at(size_t index) {
    return index < LARGEST ? 2 * (index + 1) * (index + 1) : 0;
}

const aur_native_set aur_native_gauss = {
    .description =
        {.row = {.name = "gauss",
                 .summary = "Gauss heights times equal azimuths with their weights: exact for polynomials of "
                            "degree 2 n - 1 with 2 n^2 points",
                 .source = "Atkinson 1982; Courtier, Naughton 1994",
                 AUR_ROW_KEYS(keys)},
         .domains = AUR_ON_SPHERE,
         .dimensions = {3, 3},
         .size_at = size_at,
         .maximum_size = 2 * LARGEST * LARGEST},
    .prepare = prepare,
    .fill = fill,
    .weigh = weigh,
};

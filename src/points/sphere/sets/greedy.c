/* Greedy points of the sphere (Leja 1957 in the plane; Gotz 2001 and Lopez Garcia, Saff 2010 on the sphere):
 * each maximises the sum of distances to all previous points, among the points of a fixed spherical Fibonacci
 * set, so that every prefix is good. The distance energy is a function of the sum of distances. For axes both
 * ends count. Memory for the candidates; time 65536 n. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/sphere/native.h"
#include "points/sphere/phase.h"

enum { CANDIDATES = 1 << 16, LARGEST = 1 << 14 };

typedef struct candidates {
    double x[CANDIDATES], y[CANDIDATES], z[CANDIDATES];
    double sums[CANDIDATES]; /* of distances to the points chosen */
} candidates;

static void place(bool axes, candidates *c) {
    const double depth = axes ? 1.0 : 2.0;
    for (size_t i = 0; i < CANDIDATES; ++i) {
        const double z = 1.0 - depth * ((double)i + 0.5) / CANDIDATES;
        const double radius = sqrt((1.0 - z) * (1.0 + z));
        double sine, cosine;
        aur_phase_sincos(i * AUR_GOLDEN_PHASE, &sine, &cosine);
        c->x[i] = radius * cosine;
        c->y[i] = radius * sine;
        c->z[i] = z;
        c->sums[i] = 0.0;
    }
}

static double root(double square) {
    return sqrt(square > 0.0 ? square : 0.0); /* rounding may make it negative */
}

static void add_distances(bool axes, size_t chosen, candidates *c) {
    const double x = c->x[chosen], y = c->y[chosen], z = c->z[chosen];
    for (size_t i = 0; i < CANDIDATES; ++i) {
        const double twice = 2.0 * (x * c->x[i] + y * c->y[i] + z * c->z[i]);
        c->sums[i] += axes ? root(2.0 - twice) + root(2.0 + twice) : root(2.0 - twice);
    }
}

static size_t farthest(const candidates *c) {
    size_t best = 0;
    for (size_t i = 1; i < CANDIDATES; ++i)
        best = c->sums[i] > c->sums[best] ? i : best;
    return best;
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    (void)parameters;
    const bool axes = request->domain == AUR_DOMAIN_AXES;
    if (request->height != (axes ? 1.0 : 2.0))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "set '%s' fills the whole sphere, not a cap",
                        row->name);
    candidates *const c = malloc(sizeof *c);
    double *const xyz = malloc(3 * request->count * sizeof *xyz);
    if (c == NULL || xyz == NULL) {
        free(c);
        free(xyz);
        return aur_fail_memory(error);
    }
    place(axes, c);
    size_t chosen = CANDIDATES / 2;
    for (size_t i = 0; i < request->count; ++i) {
        xyz[3 * i] = c->x[chosen];
        xyz[3 * i + 1] = c->y[chosen];
        xyz[3 * i + 2] = c->z[chosen];
        add_distances(axes, chosen, c);
        chosen = farthest(c);
    }
    free(c);
    *data = xyz;
    return AUR_OK;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    memcpy(xyz, (const double *)data + 3 * first, 3 * count * sizeof *xyz);
}

const aur_native_set aur_native_greedy = {
    .description =
        {.row = {.name = "greedy",
                 .summary =
                     "each point maximises the sum of distances to the previous points: good at every size",
                 .source = "Leja 1957; Lopez Garcia, Saff 2010"},
         .domains = AUR_ON_SPHERE | AUR_ON_AXES,
         .dimensions = {3, 3},
         .maximum_size = LARGEST,
         .extensible = true},
    .prepare = prepare,
    .fill = fill,
};

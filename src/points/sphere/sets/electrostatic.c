/* Equilibria of repelling charges (Thomson 1904; for axes, where each charge has a twin at its opposite,
 * Jones, Horsfield and Simmons 1999), in several shells at once (Caruyer, Lenglet, Sapiro and Deriche 2013).
 *
 * Computed by L-BFGS from lattices on an icosahedron where there are some of the size (Altschuler et al.
 * 1997), from a spherical Fibonacci set, from random points, and from the best equilibrium so far
 * with some charges moved; the equilibrium of least energy is used. A step costs N^2. In the incremental
 * order each next point is where the energy of the previous ones is minimal (as in MRtrix's dirorder), so
 * that the first n are uniform for every n: a scan may be stopped at any time. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "points/base/text.h"
#include "points/sphere/native.h"
#include "points/sphere/phase.h"
#include "points/sphere/repulsion/repulsion.h"
#include "points/sphere/sets/capsid.h"

enum { SHELLS_CAPACITY = 64, LARGEST = 1 << 14 };

typedef struct electrostatic_keys {
    const char *shells;
    int64_t starts; /* 0: by the number of points */
    int64_t seed;
    enum { ORDER_INCREMENTAL, ORDER_NONE } order;
} electrostatic_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_TEXT(
        electrostatic_keys, "shells", shells, NULL,
        "points of each shell, such as 30/30/60: uniform together and separately, one shell after another")},
    {AUR_KEY_OF_INTEGER(electrostatic_keys, "starts", starts, 1, 65536, "by the size",
                        "number of starts; the lowest energy is taken"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(electrostatic_keys, "seed", seed, 0, INFINITY, "0", "of the random starts")},
    {AUR_KEY_OF_CHOICE(electrostatic_keys, "order", order, "incremental",
                       "incremental: each prefix (of a shell) is even", "incremental", "none")},
};

/* The numbers of a text a/b/c; 0 if it is invalid or does not add up to `count`. */
static size_t parse_shells(const char *text, size_t count, size_t sizes[SHELLS_CAPACITY]) {
    size_t shells = 0;
    uint64_t total = 0;
    for (;; ++text) {
        uint64_t value;
        const char *const end = shells < SHELLS_CAPACITY ? aur_read_integer(text, count, &value) : NULL;
        if (end == NULL || value == 0)
            return 0;
        sizes[shells++] = (size_t)value;
        total += value;
        text = end;
        if (*text == '\0')
            return total == count ? shells : 0;
        if (*text != '/')
            return 0;
    }
}

/* The first start is a spherical Fibonacci set, with shells dealt out evenly by a golden step; the others are
 * random. */
static void start_charges(uint64_t seed, size_t start, size_t shells, aur_charges *q) {
    const double depth = q->axes ? 1.0 : 2.0;
    for (size_t i = 0; i < q->count; ++i) {
        double share = ((double)i + 0.5) / (double)q->count;
        uint64_t phase = i * AUR_GOLDEN_PHASE;
        if (start > 0 || shells > 1) {
            share = aur_unit_double(aur_hash4(seed, start, i, 0));
            phase = aur_hash4(seed, start, i, 1);
        }
        const double z = 1.0 - depth * share;
        const double radius = sqrt((1.0 - z) * (1.0 + z));
        double sine, cosine;
        aur_phase_sincos(phase, &sine, &cosine);
        q->x[i] = radius * cosine;
        q->y[i] = radius * sine;
        q->z[i] = z;
    }
}

/* The best equilibrium so far with the charges around a random point moved by about their distance:
 * equilibria of low energy are close to each other (basin hopping, Wales and Doye 1997). */
static void disturb(uint64_t seed, size_t start, aur_charges *q) {
    const double spacing = sqrt((q->axes ? 6.28 : 12.57) / (double)q->count);
    double *const of[3] = {q->x, q->y, q->z}, centre[3];
    const size_t at = (size_t)(aur_hash4(seed, start, 0, 2) % q->count);
    const double reach = spacing * (1.0 + 2.0 * aur_unit_double(aur_hash4(seed, start, 0, 3)));
    for (size_t c = 0; c < 3; ++c)
        centre[c] = of[c][at];
    for (size_t i = 0; i < q->count; ++i) {
        double near = 0.0, norm = 0.0, moved[3];
        for (size_t c = 0; c < 3; ++c)
            near += (of[c][i] - centre[c]) * (of[c][i] - centre[c]);
        for (size_t c = 0; c < 3; ++c) {
            const double random = 2.0 * aur_unit_double(aur_hash4(seed, start, i, 4 + c)) - 1.0;
            moved[c] = of[c][i] + (near < reach * reach ? spacing * random : 0.0);
            norm += moved[c] * moved[c];
        }
        for (size_t c = 0; c < 3; ++c)
            of[c][i] = moved[c] / sqrt(norm);
    }
}

/* The best equilibrium of all starts into `best`. */
static aur_result find_rest(const electrostatic_keys *p, size_t starts, const aur_shells *shells,
                            aur_charges *q, size_t size, double *best, aur_error *error) {
    double least = INFINITY;
    size_t lattice = 0;
    for (size_t start = 0; start < starts;) {
        if (!q->axes && shells->count == 1 && aur_capsid(q->count, lattice, q->x, q->y, q->z)) {
            ++lattice;
        } else if (4 * start < starts + 3 || shells->count > 1) {
            start_charges((uint64_t)p->seed, start++, shells->count, q);
        } else {
            memcpy(q->x, best, size * sizeof *best);
            disturb((uint64_t)p->seed, start++, q);
        }
        double energy;
        const aur_result result = aur_repel(shells, q, &energy, error);
        if (result != AUR_OK)
            return result;
        if (energy < least)
            memcpy(best, q->x, size * sizeof *best);
        least = fmin(least, energy);
    }
    memcpy(q->x, best, size * sizeof *best);
    return AUR_OK;
}

/* By the size: 420 starts find the least known energy of 200 charges, and take about as long as 17 starts
 * with a thousand. */
static size_t choose_starts(const electrostatic_keys *p, size_t count) {
    if (p->starts != 0)
        return (size_t)p->starts;
    const size_t starts = 1 + ((size_t)1 << 24) / (count * count), most = 20 + 2 * count;
    return starts < most ? starts : most;
}

static aur_result place_charges(const electrostatic_keys *p, const aur_shells *shells, aur_charges *q,
                                double *xyz, aur_error *error) {
    const size_t stride = (q->count + 7) / 8 * 8 + 8, size = 3 * stride;
    double *const room = calloc(2 * size, sizeof *room);
    if (room == NULL)
        return aur_fail_memory(error);
    q->x = room;
    q->y = room + stride;
    q->z = room + 2 * stride;
    aur_result result = find_rest(p, choose_starts(p, q->count), shells, q, size, room + size, error);
    size_t first = 0;
    for (size_t s = 0; s < shells->count && result == AUR_OK && p->order == ORDER_INCREMENTAL; ++s) {
        result = aur_order_charges(q, first, shells->sizes[s], error);
        first += shells->sizes[s];
    }
    for (size_t i = 0; i < q->count; ++i) {
        const double sign = q->axes && q->z[i] < 0.0 ? -1.0 : 1.0;
        xyz[3 * i] = sign * q->x[i];
        xyz[3 * i + 1] = sign * q->y[i];
        xyz[3 * i + 2] = sign * q->z[i];
    }
    free(room);
    return result;
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    electrostatic_keys p = {0};
    aur_result result = aur_row_read(row, parameters, &p, error);
    if (result != AUR_OK)
        return result;
    aur_charges charges = {.count = (size_t)request->count, .axes = request->domain == AUR_DOMAIN_AXES};
    if (request->height != (charges.axes ? 1.0 : 2.0))
        return aur_fail(error, AUR_ERROR_UNSUPPORTED,
                        "set 'electrostatic' fills no cap: charges repel each "
                        "other all over the sphere");
    size_t sizes[SHELLS_CAPACITY] = {charges.count};
    aur_shells shells = {1, sizes};
    if (p.shells != NULL)
        shells.count = parse_shells(p.shells, charges.count, sizes);
    if (shells.count == 0)
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set 'electrostatic': shells must be up to %d whole numbers with / between them that "
                        "add up to the %zu points, not '%s'",
                        SHELLS_CAPACITY, charges.count, p.shells);
    double *const xyz = malloc(3 * charges.count * sizeof *xyz);
    if (xyz == NULL)
        return aur_fail_memory(error);
    result = place_charges(&p, &shells, &charges, xyz, error);
    if (result == AUR_OK)
        *data = xyz;
    else
        free(xyz);
    return result;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    memcpy(xyz, (const double *)data + 3 * first, 3 * count * sizeof *xyz);
}

const aur_native_set aur_native_electrostatic = {
    .description =
        {.row = {.name = "electrostatic",
                 .summary =
                     "points of least Coulomb energy, ordered so that prefixes are uniform; several shells",
                 .source = "Thomson 1904; Jones 1999; Caruyer 2013",
                 AUR_ROW_KEYS(keys)},
         .domains = AUR_ON_SPHERE | AUR_ON_AXES,
         .dimensions = {3, 3},
         .maximum_size = LARGEST},
    .prepare = prepare,
    .fill = fill,
};

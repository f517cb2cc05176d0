/* The centres of a partition of the sphere into regions of equal area and small diameter (Leopardi 2006): a
 * cap at each pole and collars between them, which are divided by azimuth. Any number of points. */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/vector.h"
#include "points/sphere/native.h"

/* The regions first, first + 1, .. of one collar. */
typedef struct collar {
    uint64_t first, count;
    double theta, phase; /* of the centres; of the first centre, in turns */
} collar;

typedef struct partition {
    uint64_t count;
    size_t collars; /* the caps among them */
    collar of[];
} partition;

/* The polar angle of the cap with the area of `regions` of `all`. */
static double cap_angle(double regions, double all) {
    return 2.0 * asin(sqrt(fmin(regions / all, 1.0)));
}

static uint64_t common_divisor(uint64_t a, uint64_t b) {
    while (b != 0) {
        const uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/* Regions of the collars: ideal numbers, rounded with the error carried to the next collar. */
static void divide(partition *filled, double fitting) {
    const double all = (double)filled->count, cap = cap_angle(1.0, all);
    const size_t inner = filled->collars - 2;
    double lost = 0.0;
    uint64_t so_far = 1;
    filled->of[0] = (collar){.count = 1, .theta = 0.0};
    for (size_t k = 0; k < inner; ++k) {
        const double top = sin(0.5 * (cap + (double)k * fitting)),
                     bottom = sin(0.5 * (cap + (double)(k + 1) * fitting));
        const double ideal = all * (bottom * bottom - top * top);
        const double rounded = floor(ideal + lost + 0.5);
        lost += ideal - rounded;
        collar *const c = filled->of + k + 1, *const before = c - 1;
        *c = (collar){.first = so_far, .count = (uint64_t)rounded};
        const double above = cap_angle((double)so_far, all);
        so_far += c->count;
        c->theta = 0.5 * (above + cap_angle((double)so_far, all));
        /* The phase that maximises the distance of neighbours in two collars. */
        if (c->count > 0 && before->count > 1) {
            const double here = (double)c->count, there = (double)before->count;
            const double common = (double)common_divisor(c->count, before->count);
            c->phase = fmod(before->phase + 0.5 * (1.0 / here - 1.0 / there + common / (here * there)), 1.0);
        }
    }
    filled->of[inner + 1] = (collar){.first = filled->count - 1, .count = 1, .theta = AUR_PI};
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    (void)parameters;
    if (request->height != 2.0)
        return aur_fail(error, AUR_ERROR_UNSUPPORTED, "set '%s' fills the whole sphere, not a cap",
                        row->name);
    const double all = (double)request->count, across = AUR_PI - 2.0 * cap_angle(1.0, all);
    const double ideal = sqrt(4.0 * AUR_PI / all);
    const size_t inner = request->count > 2 ? (size_t)fmax(1.0, floor(across / ideal + 0.5)) : 0;
    partition *const created = malloc(sizeof *created + (inner + 2) * sizeof created->of[0]);
    if (created == NULL)
        return aur_fail_memory(error);
    *created = (partition){.count = request->count, .collars = request->count > 1 ? inner + 2 : 1};
    if (request->count > 1)
        divide(created, inner > 0 ? across / (double)inner : 0.0);
    else
        created->of[0] = (collar){.count = 1};
    *data = created;
    return AUR_OK;
}

static const collar *collar_of(const partition *set, uint64_t point) {
    size_t low = 0, high = set->collars;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        *(set->of[middle].first <= point ? &low : &high) = middle;
    }
    return set->of + low;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    for (size_t i = 0; i < count; ++i) {
        const collar *const c = collar_of(data, first + i);
        const double turn = ((double)(first + i - c->first) + 0.5) / (double)c->count + c->phase;
        const double radius = c->theta == 0.0 || c->theta == AUR_PI ? 0.0 : sin(c->theta);
        xyz[3 * i] = radius * cos(2.0 * AUR_PI * turn);
        xyz[3 * i + 1] = radius * sin(2.0 * AUR_PI * turn);
        xyz[3 * i + 2] = cos(c->theta);
    }
}

const aur_native_set aur_native_eqsp = {
    .description = {.row = {.name = "eqsp",
                            .summary = "centres of regions of equal area and small diameter",
                            .source = "Leopardi 2006"},
                    .domains = AUR_ON_SPHERE,
                    .dimensions = {3, 3},
                    .maximum_size = UINT64_C(1) << 40},
    .prepare = prepare,
    .fill = fill,
};

/* Sliced optimal transport (Paulin, Bonneel, Coeurjolly, Iehl, Webanck, Desbrun, Ostromoukhov 2020) on the
 * square: in each step points move along some directions to the quantiles of the projected uniform density.
 * Small star discrepancy and uniform distances; not periodic. A table: n up to 2^16. */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/random.h"
#include "points/base/vector.h"
#include "points/pointset/relax/relaxation.h"

enum { VERSION = 1, STEPS = 128, DIRECTIONS = 64, LARGEST = 1 << 16 };

/* Of pi / DIRECTIONS. */
static const double turn_cosine = 0.9987954562051724, turn_sine = 0.049067674327418015;

typedef struct projection {
    double at;
    uint32_t index;
} projection;

static int compare(const void *a, const void *b) {
    const projection *const p = a, *const q = b;
    if (p->at != q->at)
        return p->at < q->at ? -1 : 1;
    return (p->index > q->index) - (p->index < q->index);
}

/* The quantile `q` of the projection of the square [0,1]^2 to (a, b), both >= 0: the density of the sum of
 * two uniform variables on [0,a] and [0,b] is a trapezoid. */
static double quantile(double a, double b, double q) {
    const double small = fmin(a, b), large = fmax(a, b), edge = 0.5 * small / large;
    if (q < edge)
        return sqrt(2.0 * a * b * q);
    if (q > 1.0 - edge)
        return a + b - sqrt(2.0 * a * b * (1.0 - q));
    return large * q + 0.5 * small;
}

/* Adds the moves along the direction (c, s). */
static void add_direction(double c, double s, size_t count, const aur_point2 *sites, projection *sorted,
                          aur_point2 *moves) {
    const double lowest = fmin(c, 0.0) + fmin(s, 0.0);
    for (size_t i = 0; i < count; ++i)
        sorted[i] = (projection){c * sites[i].x + s * sites[i].y, (uint32_t)i};
    qsort(sorted, count, sizeof *sorted, compare);
    for (size_t i = 0; i < count; ++i) {
        const double target = lowest + quantile(fabs(c), fabs(s), ((double)i + 0.5) / (double)count);
        moves[sorted[i].index].x += c * (target - sorted[i].at);
        moves[sorted[i].index].y += s * (target - sorted[i].at);
    }
}

static aur_result relax(uint64_t seed, size_t count, aur_point2 *sites, aur_error *error) {
    projection *const sorted = malloc(count * sizeof *sorted);
    aur_point2 *const moves = malloc(count * sizeof *moves);
    if (sorted == NULL || moves == NULL) {
        free(sorted);
        free(moves);
        return aur_fail_memory(error);
    }
    for (size_t i = 0; i < count; ++i)
        sites[i] =
            (aur_point2){aur_unit_double(aur_hash3(seed, i, 0)), aur_unit_double(aur_hash3(seed, i, 1))};
    for (size_t step = 0; step < STEPS; ++step) {
        for (size_t i = 0; i < count; ++i)
            moves[i] = (aur_point2){0.0, 0.0};
        /* Sine and cosine by a series, which is bit-identical on every machine, and by a fixed rotation. */
        const double angle = AUR_PI / DIRECTIONS * aur_unit_double(aur_hash3(seed, step, 2)),
                     a = angle * angle;
        double s = angle * (1.0 - a / 6.0 * (1.0 - a / 20.0 * (1.0 - a / 42.0 * (1.0 - a / 72.0))));
        double c = 1.0 - a / 2.0 * (1.0 - a / 12.0 * (1.0 - a / 30.0 * (1.0 - a / 56.0)));
        for (size_t k = 0; k < DIRECTIONS; ++k) {
            add_direction(c, s, count, sites, sorted, moves);
            const double next = c * turn_cosine - s * turn_sine;
            s = c * turn_sine + s * turn_cosine;
            c = next;
        }
        /* The mean over directions of the components along each is half of a move. */
        for (size_t i = 0; i < count; ++i) {
            sites[i].x = fmin(fmax(sites[i].x + 2.0 / DIRECTIONS * moves[i].x, 0.0), AUR_BELOW_ONE);
            sites[i].y = fmin(fmax(sites[i].y + 2.0 / DIRECTIONS * moves[i].y, 0.0), AUR_BELOW_ONE);
        }
    }
    free(sorted);
    free(moves);
    return AUR_OK;
}

const aur_square_set aur_set_sliced = {
    .description = {.row = {.name = "sliced",
                            .summary = "sliced optimal transport: uniform projections on all directions",
                            .source = "Paulin 2020"},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = LARGEST},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .kind_data = &(const aur_relaxation){VERSION, relax},
    .prepare = aur_prepare_relaxed,
    .fill = aur_fill_table,
};

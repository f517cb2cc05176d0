/* Extensible spherical Fibonacci grids, E-SFG (Marques, Bouville, Bouatouch, Blat 2019, algorithm 1).
 *
 * A planar Fibonacci grid of `base` points x = j/N, y = j/Phi is copied with shifts by half its basis vectors
 * b_0 = (0,-1), b_1 = (1/N, 1/Phi), b_2 = (1/N, -1/Phi^2), which gives four times the points, and so on with
 * a quarter, an eighth, ...; z = 1 - h (x + d) on a cap of height h. So point i is point i mod N of the base
 * grid, shifted by one vector for each digit of i/N in base 4: random access, up to 2^48 points. Only sizes
 * with complete sub-grids, N 4^l times 1, 2, 3 or 4, are as uniform as spherical Fibonacci sets; others give
 * a warning.
 *
 * The shift d along x centres the points. `final`: d = 1/(2^{L+1} N) suits all N 4^L points, and smaller
 * sizes are prefixes that lose 5 to 8 %. `per-level`: each size has a separate shift, within 1 % of spherical
 * Fibonacci, and old points move. Progression 2 adds first the sub-grid that doubles a grid best. */
#include "points/sphere/sets/reference.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/simd_lanes.h"
#include "points/base/vector.h"
#include "points/sphere/native.h"
#include "points/sphere/phase.h"
#include "points/sphere/sets/fibonacci.h"

static const double aur_inverse_phi = 0.61803398874989484820;

enum { LEVEL_LIMIT = 24, JUDGED_LIMIT = 2048, LEGENDRE_TERMS = 200 };

/* Squared length of b_k. */
static double aur_squared_length(size_t k, uint64_t base, double stretch) {
    double previous = 1.0; /* F_{-1}, F_0 */
    double fibonacci = 0.0;
    for (size_t i = 0; i < k; ++i) {
        const double next = fibonacci + previous;
        previous = fibonacci;
        fibonacci = next;
    }
    const double x = fibonacci / (double)base;
    const double y = stretch * pow(aur_inverse_phi, (double)k);
    return x * x + y * y;
}

size_t aur_grid_shortest_vector(uint64_t base, double stretch) {
    size_t k = 0;
    while (aur_squared_length(k + 1, base, stretch) < aur_squared_length(k, base, stretch))
        ++k;
    return k;
}

size_t aur_grid_first_shift(uint64_t base, double stretch) {
    const size_t k = aur_grid_shortest_vector(base, stretch);
    if (k == 0)
        return 1;
    const double below = aur_squared_length(k - 1, base, stretch);
    const double above = aur_squared_length(k + 1, base, stretch);
    return (below > above ? k - 1 : k + 1) % 3;
}

typedef aur_grid_shift shift;

aur_grid_shift aur_grid_shift_of(size_t s, size_t level) {
    const uint64_t turn = UINT64_C(1) << (64 - level);
    const uint64_t golden = AUR_GOLDEN_PHASE >> level;
    const aur_grid_shift half = {s == 0 ? 0.0 : ldexp(1.0, -(int)level),
                                 s == 0 ? 0 - turn : golden - (s == 1 ? 0 : turn)};
    return half;
}

/* The mean distance of a point at height z to the points of the upper hemisphere: the Legendre series of |x -
 * y| against that of the hemisphere's indicator. */
static double distance_to_hemisphere(double z) {
    double before = 1.0; /* P_{l-1}(z), P_l(z) and the same at 0 */
    double now = z;
    double zero_before = 1.0;
    double zero = 0.0;
    double sum = 4.0 / 3.0;
    for (size_t l = 1; l < LEGENDRE_TERMS; ++l) {
        const double n = (double)l;
        sum -= 4.0 / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * zero_before / (n + 1.0) * now;
        const double next = ((2.0 * n + 1.0) * z * now - n * before) / (n + 1.0);
        const double zero_next = -n * zero_before / (n + 1.0);
        before = now;
        now = next;
        zero_before = zero;
        zero = zero_next;
    }
    return sum;
}

/* The objective: minus the mean distance of all pairs, plus twice the mean distance to the domain, which is
 * 4/3 everywhere on the sphere. Caps other than the hemisphere use the objective of the sphere. */
static double judge(size_t count, const double *xyz, double height) {
    double pairs = 0.0;
    double domain = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const double *const a = xyz + 3 * i;
        for (size_t k = 0; k < i; ++k) {
            const double *const b = xyz + 3 * k;
            const double x = a[0] - b[0];
            const double y = a[1] - b[1];
            const double z = a[2] - b[2];
            pairs += sqrt(x * x + y * y + z * z);
        }
        domain += height == 1.0 ? distance_to_hemisphere(a[2]) : 4.0 / 3.0;
    }
    const double n = (double)count;
    return 2.0 * domain / n - 2.0 * pairs / (n * n);
}

/* The base grid of `count` points and its copy by b_s/2, into xyz[6 * count]. */
static void doubled_grid(uint64_t count, size_t s, double height, double centre, double *xyz) {
    const shift half = aur_grid_shift_of(s, 1);
    const double step = height / (double)count;
    const aur_fibonacci base = {step, centre, 0};
    const aur_fibonacci copy = {step, centre + half.index, half.phase};
    aur_fibonacci_kernel *const kernel = AUR_KERNEL_HERE(aur_fibonacci_points);
    kernel(&base, 0, (size_t)count, false, xyz);
    kernel(&copy, 0, (size_t)count, false, xyz + 3 * count);
}

size_t aur_grid_best_shift(uint64_t base, double height, double centre) {
    double *const xyz = base <= JUDGED_LIMIT ? malloc(6 * (size_t)base * sizeof *xyz) : NULL;
    if (xyz == NULL)
        return aur_grid_first_shift(base, 2.0 * AUR_PI * (1.0 - height / 3.0));
    size_t best = 0;
    double lowest = INFINITY;
    for (size_t s = 0; s < 3; ++s) {
        const double middle = 0.5 - 0.5 * aur_grid_shift_of(s, 1).index;
        doubled_grid(base, s, height, centre >= 0.0 ? centre : middle, xyz);
        const double energy = judge(2 * (size_t)base, xyz, height);
        if (energy < lowest) {
            lowest = energy;
            best = s;
        }
    }
    free(xyz);
    return best;
}

typedef struct grid {
    uint64_t base;
    size_t levels;
    shift shifts[LEVEL_LIMIT + 1][4]; /* of a level and its digit */
    double step;
    double centre; /* N d */
    aur_fibonacci_kernel *kernel;
} grid;

/* The mean shift of the index over blocks 0 .. blocks-1. */
static double mean_index_shift(const grid *g, uint64_t blocks) {
    double sum = 0.0;
    double above = 0.0; /* of the digits already passed */
    uint64_t left = blocks;
    for (size_t level = g->levels; level > 0; --level) {
        const uint64_t block = UINT64_C(1) << (2 * (level - 1));
        /* a complete block of all lower levels has half of its points shifted at each of them */
        const double inside = 0.5 * (1.0 - ldexp(1.0, -(int)(level - 1)));
        const uint64_t digit = left / block;
        for (uint64_t d = 0; d < digit; ++d)
            sum += (double)block * (above + inside + g->shifts[level][d].index);
        if (digit < 4)
            above += g->shifts[level][digit].index;
        left -= digit * block;
    }
    return (sum + (double)left * above) / (double)blocks;
}

/* Base and levels from the keys and the requested size. */
static aur_result choose_size(uint64_t count, int64_t base, int64_t levels, grid *g, aur_error *error) {
    if (base == 0 && levels < 0) {
        /* The most levels that leave an integral base of at least 16 points. */
        for (g->base = count; g->base % 4 == 0 && g->base / 4 >= 16; g->base /= 4)
            ++g->levels;
        return AUR_OK;
    }
    if (base == 0) {
        g->levels = (size_t)levels;
        g->base = count >> (2 * g->levels);
        if (g->base == 0 || g->base << (2 * g->levels) != count)
            return aur_fail(error, AUR_ERROR_ARGUMENT,
                            "set 'esfg': %llu points are not a multiple of 4^%zu: give the base",
                            (unsigned long long)count, g->levels);
        return AUR_OK;
    }
    g->base = (uint64_t)base;
    for (g->levels = levels < 0 ? 0 : (size_t)levels; levels < 0 && g->base << (2 * g->levels) < count;)
        ++g->levels;
    if (g->base > AUR_INDEX_LIMIT >> (2 * g->levels))
        return aur_fail(error, AUR_ERROR_ARGUMENT, "set 'esfg': base*4^levels must be at most 2^48");
    if (count > g->base << (2 * g->levels))
        return aur_fail(error, AUR_ERROR_ARGUMENT,
                        "set 'esfg': base %llu and %zu levels make %llu points, not %llu",
                        (unsigned long long)g->base, g->levels,
                        (unsigned long long)(g->base << (2 * g->levels)), (unsigned long long)count);
    return AUR_OK;
}

/* Whether all sub-grids of the size are complete: N 4^l times 1, 2, 3 or 4. */
static bool is_complete(uint64_t count, uint64_t base) {
    if (count % base != 0)
        return false;
    uint64_t blocks = count / base;
    while (blocks % 4 == 0)
        blocks /= 4;
    return blocks < 4;
}

typedef struct grid_keys {
    int64_t base, levels; /* 0 and -1: not given */
    enum { FIRST_SHIFT_PAPER, FIRST_SHIFT_BEST } first_shift;
    enum { SHIFT_FINAL, SHIFT_PER_LEVEL } shift;
    enum { PROGRESSION_2, PROGRESSION_4 } progression;
} grid_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(grid_keys, "base", base, 1, AUR_INDEX_LIMIT, "auto", "N: points of the first grid"),
     .computed = true},
    {AUR_KEY_OF_INTEGER(grid_keys, "levels", levels, 0, LEVEL_LIMIT, "auto",
                        "times that the grid may be quadrupled: base*4^levels points at most"),
     .computed = true},
    {AUR_KEY_OF_CHOICE(grid_keys, "first-shift", first_shift, "best",
                       "how the sub-grid that doubles a grid is chosen: by eq. 56, or by trying all three",
                       "paper", "best")},
    {AUR_KEY_OF_CHOICE(
        grid_keys, "shift", shift, "final",
        "the points are centred for base*4^levels of them, or for each size: old points then move", "final",
        "per-level")},
    {AUR_KEY_OF_CHOICE(grid_keys, "progression", progression, "2",
                       "2: the sub-grid that doubles the grid best comes first; 4: sub-grids in their order",
                       "2", "4")},
};

static void choose_order(grid *g, const grid_keys *p, double height) {
    size_t first = 0;
    if (p->progression == PROGRESSION_2 && g->levels > 0)
        first = p->first_shift == FIRST_SHIFT_BEST
                    ? aur_grid_best_shift(g->base, height, p->shift == SHIFT_FINAL ? g->centre : -1.0)
                    : aur_grid_first_shift(g->base, 1.0);
    for (size_t level = 1; level <= g->levels; ++level)
        for (size_t i = 0; i < 3; ++i)
            g->shifts[level][i + 1] = aur_grid_shift_of((first + i) % 3, level);
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    grid_keys p = {.levels = -1};
    aur_result result = aur_row_read(row, parameters, &p, error);
    grid g = {.kernel = AUR_KERNEL_HERE(aur_fibonacci_points)};
    if (result == AUR_OK)
        result = choose_size(request->count, p.base, p.levels, &g, error);
    if (result != AUR_OK)
        return result;
    g.step = request->height / (double)g.base;
    g.centre = ldexp(0.5, -(int)g.levels);
    choose_order(&g, &p, request->height);
    if (p.shift == SHIFT_PER_LEVEL)
        g.centre = 0.5 - mean_index_shift(&g, (request->count + g.base - 1) / g.base);
    if (!is_complete(request->count, g.base))
        aur_warn_at(
            request->warnings, (aur_location){0},
            "set 'esfg': %llu points leave a sub-grid incomplete: sizes of base %llu are even at 1, 2, 3, 4, "
            "8, 12, 16, ... times the base",
            (unsigned long long)request->count, (unsigned long long)g.base);
    grid *const stored = malloc(sizeof *stored);
    if (stored == NULL)
        return aur_fail_memory(error);
    *stored = g;
    *data = stored;
    return AUR_OK;
}

static void fill(const void *data, uint64_t first, size_t count, double *xyz) {
    const grid *const g = data;
    const bool stream = aur_fibonacci_streams(count);
    while (count > 0) {
        const uint64_t block = first / g->base;
        const uint64_t j = first % g->base;
        const size_t part = count < g->base - j ? count : (size_t)(g->base - j);
        aur_fibonacci base = {.step = g->step, .offset = g->centre};
        for (size_t level = 1; level <= g->levels; ++level) {
            const shift moved = g->shifts[level][block >> (2 * (level - 1)) & 3];
            base.offset += moved.index;
            base.phase += moved.phase;
        }
        g->kernel(&base, j, part, stream, xyz);
        first += part;
        count -= part;
        xyz += 3 * part;
    }
    if (stream)
        aur_lanes_end_stream();
}

const aur_native_set aur_native_grid = {
    .description = {.row = {.name = "esfg",
                            .summary =
                                "spherical Fibonacci grids that double or quadruple and keep their points",
                            .source = "Marques 2019",
                            AUR_ROW_KEYS(keys)},
                    .domains = AUR_ON_SPHERE | AUR_ON_HEMISPHERE | AUR_ON_DISK | AUR_ON_AXES,
                    .dimensions = {3, 3},
                    .maximum_size = UINT64_C(1) << 48,
                    .best_sizes = AUR_SIZES_GRIDS,
                    .extensible = true},
    .prepare = prepare,
    .fill = fill,
};

/* Extensible super-Fibonacci rotations: the analogue of E-SFG (Marques 2019) for rotations.
 *
 * In Hopf coordinates (u, a, b) the points j/N, j/sqrt 2, j/psi of Alexa 2022 are a lattice with the basis
 * (1/N, 1/sqrt 2, 1/psi), (0, 1, 0) and (0, 1/2, 1/2); the last one is not (0, 0, 1), since half a turn of
 * both azimuths takes a quaternion to its opposite, which is the same rotation. A lattice of half the basis
 * vectors has eight times the points and the same shape, and so the same uniformity as the base grid; and so
 * on. Between them one vector after another is halved, (0, 1/4, 1/4) first, (0, 1/2, 0) next, which doubles
 * the points each time. So point i is point i mod N of the base grid, shifted by one vector for each binary
 * digit of i/N.
 *
 * The heights are centred for base*8^levels points: smaller sizes are prefixes. Points of a circle are close
 * where its radius is small, as at the poles of E-SFG: smallest angle and covering are worse than for
 * super-fibonacci, the energy is not. */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/simd.h"
#include "points/sphere/native.h"
#include "points/sphere/rotations/hopf.h"

enum { LEVEL_LIMIT = 15 };

typedef struct grid {
    aur_hopf_line base;
    uint64_t size;
    size_t levels;
} grid;

typedef struct grid_keys {
    uint64_t base;
    int64_t levels; /* -1: not given */
} grid_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(grid_keys, "base", base, 1, AUR_INDEX_LIMIT, "100", "points of the first grid")},
    {AUR_KEY_OF_INTEGER(
         grid_keys, "levels", levels, 0, LEVEL_LIMIT, "auto",
         "times that all three vectors may be halved: base*8^levels points at most; sizes share "
         "points where both have the same levels"),
     .computed = true},
};

static bool is_complete(uint64_t count, uint64_t base) {
    const uint64_t blocks = count / base;
    return count % base == 0 && (blocks & (blocks - 1)) == 0;
}

static aur_result choose_levels(const grid_keys *p, uint64_t count, grid *g, aur_error *error) {
    size_t levels = p->levels < 0 ? 0 : (size_t)p->levels;
    while (p->levels < 0 && levels < LEVEL_LIMIT && p->base << (3 * levels) < count)
        ++levels;
    if (p->base > AUR_INDEX_LIMIT >> (3 * levels) || count > p->base << (3 * levels))
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "set 'super-fibonacci-grid': base*8^levels must be at most 2^48 and at least the %llu "
            "points; base %llu and %zu levels are not",
            (unsigned long long)count, (unsigned long long)p->base, levels);
    g->size = p->base;
    g->levels = levels;
    return AUR_OK;
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    grid_keys p = {.levels = -1};
    grid g = {.base = {.turns = AUR_SUPER_FIBONACCI_TURNS}};
    aur_result result = aur_row_read(row, parameters, &p, error);
    if (result == AUR_OK)
        result = choose_levels(&p, request->count, &g, error);
    if (result != AUR_OK)
        return result;
    g.base.step = 1.0 / (double)g.size;
    g.base.offset = ldexp(0.5, -(int)g.levels);
    if (!is_complete(request->count, g.size))
        aur_warn_at(request->warnings, (aur_location){0},
                    "set 'super-fibonacci-grid': %llu points leave a grid incomplete: sizes of base %llu are "
                    "even at 1, 2, 4, 8, ... times the base",
                    (unsigned long long)request->count, (unsigned long long)g.size);
    grid *const stored = malloc(sizeof *stored);
    if (stored == NULL)
        return aur_fail_memory(error);
    *stored = g;
    *data = stored;
    return AUR_OK;
}

/* The base grid, shifted according to the digits of one level. */
static void shift(aur_hopf_line *line, size_t level, unsigned digits) {
    if ((digits & 1) != 0) {
        line->phases[0] += UINT64_C(1) << 62 >> level;
        line->phases[1] += UINT64_C(1) << 62 >> level;
    }
    if ((digits & 2) != 0)
        line->phases[0] += UINT64_C(1) << 63 >> level;
    if ((digits & 4) == 0)
        return;
    line->offset += ldexp(0.5, -(int)level);
    for (size_t k = 0; k < 2; ++k)
        line->phases[k] += line->turns[k] >> (level + 1);
}

static void fill(const void *data, uint64_t first, size_t count, double *wxyz) {
    const grid *const g = data;
    while (count > 0) {
        const uint64_t block = first / g->size, j = first % g->size;
        const size_t part = count < g->size - j ? count : (size_t)(g->size - j);
        aur_hopf_line line = g->base;
        for (size_t level = 0; level < g->levels; ++level)
            shift(&line, level, block >> (3 * level) & 7);
        AUR_KERNEL_HERE(aur_hopf).line(&line, j, part, wxyz);
        first += part;
        count -= part;
        wxyz += 4 * part;
    }
}

const aur_native_set aur_native_super_fibonacci_grid = {
    .description = {.row = {.name = "super-fibonacci-grid",
                            .summary = "super-Fibonacci rotations that double and keep their points",
                            .source = "Alexa 2022, refined as Marques 2019",
                            AUR_ROW_KEYS(keys)},
                    .domains = AUR_ON_ROTATIONS,
                    .dimensions = {4, 4},
                    .maximum_size = AUR_INDEX_LIMIT,
                    .extensible = true},
    .prepare = prepare,
    .fill = fill,
};

/* Extensible spherical Fibonacci grids (Marques 2019) lifted to rotations: each direction of a grid is
 * rotated to +x and turned about it by `turns` equal steps; when the number of directions has grown four
 * times, the steps are halved, so that a grid of eight times the size has the same shape.
 *
 * In Hopf coordinates (hopf.h) a direction of height 1 - 2u and azimuth phi with the turn psi is u, a = (psi
 * + phi)/2, b = (psi - phi)/2, so that one turn's rotations of one sub-grid are a line. The turns of
 * direction i begin at i/sqrt 2; any irrational step works as well. Each size of base * turns * 2^m rotations
 * is a prefix of the next; `aureole lab run domains-lifts` compares lifts. */
#include <math.h>
#include <stdlib.h>

#include "points/base/error.h"
#include "points/base/simd.h"
#include "points/sphere/native.h"
#include "points/sphere/phase.h"
#include "points/sphere/rotations/hopf.h"
#include "points/sphere/sets/reference.h"

enum { LEVEL_LIMIT = 15, TURN_LIMIT = 1 << 16 };

/* 1/sqrt 2 of a turn. */
#define FIRST_TURN UINT64_C(0xb504f333f9de6484)

typedef struct grid {
    aur_hopf_line base; /* the first sub-grid with its first turn */
    uint64_t directions, turns;
    size_t levels, first_shift;
} grid;

typedef struct grid_keys {
    uint64_t base, turns;
    int64_t levels; /* -1: not given */
} grid_keys;

static const aur_key keys[] = {
    {AUR_KEY_OF_INTEGER(grid_keys, "base", base, 1, AUR_INDEX_LIMIT, "20", "directions of the first grid")},
    {AUR_KEY_OF_INTEGER(grid_keys, "turns", turns, 1, TURN_LIMIT, "6",
                        "rotations to each direction of the first grid")},
    {AUR_KEY_OF_INTEGER(
         grid_keys, "levels", levels, 0, LEVEL_LIMIT, "auto",
         "times that the grid may grow eightfold: base*turns*8^levels points at most; sizes share "
         "points where both have the same levels"),
     .computed = true},
};

static bool is_complete(uint64_t count, uint64_t first) {
    const uint64_t blocks = count / first;
    return count % first == 0 && (blocks & (blocks - 1)) == 0;
}

static aur_result choose_levels(const grid_keys *p, uint64_t count, size_t *levels, aur_error *error) {
    const uint64_t first = p->base <= AUR_INDEX_LIMIT / p->turns ? p->base * p->turns : AUR_INDEX_LIMIT + 1;
    *levels = p->levels < 0 ? 0 : (size_t)p->levels;
    while (p->levels < 0 && *levels < LEVEL_LIMIT && first << (3 * *levels) < count)
        ++*levels;
    if (first > AUR_INDEX_LIMIT >> (3 * *levels) || count > first << (3 * *levels))
        return aur_fail(
            error, AUR_ERROR_ARGUMENT,
            "set 'esfg-rotations': base*turns*8^levels must be at most 2^48 and at least the %llu "
            "points; base %llu, %llu turns and %zu levels are not",
            (unsigned long long)count, (unsigned long long)p->base, (unsigned long long)p->turns, *levels);
    return AUR_OK;
}

static aur_result prepare(const aur_row *row, aur_parameters *parameters, const aur_native_request *request,
                          void **data, aur_error *error) {
    grid_keys p = {.levels = -1};
    grid g = {0};
    aur_result result = aur_row_read(row, parameters, &p, error);
    if (result == AUR_OK)
        result = choose_levels(&p, request->count, &g.levels, error);
    if (result != AUR_OK)
        return result;
    g.directions = p.base;
    g.turns = p.turns;
    g.base = (aur_hopf_line){
        .step = 1.0 / (double)p.base,
        .offset = ldexp(0.5, -(int)g.levels),
        .turns = {FIRST_TURN / 2 + AUR_GOLDEN_PHASE / 2, FIRST_TURN / 2 - AUR_GOLDEN_PHASE / 2}};
    g.first_shift = g.levels > 0 ? aur_grid_best_shift(p.base, 2.0, g.base.offset) : 0;
    if (!is_complete(request->count, p.base * p.turns))
        aur_warn_at(
            request->warnings, (aur_location){0},
            "set 'esfg-rotations': %llu points leave a grid incomplete: sizes of base %llu and %llu turns "
            "are even at 1, 2, 4, 8, ... times %llu",
            (unsigned long long)request->count, (unsigned long long)p.base, (unsigned long long)p.turns,
            (unsigned long long)(p.base * p.turns));
    grid *const stored = malloc(sizeof *stored);
    if (stored == NULL)
        return aur_fail_memory(error);
    *stored = g;
    *data = stored;
    return AUR_OK;
}

/* The line of sub-grid `block` with turn number `turn`. Each level has two binary digits for the grid of
 * directions and one for the halved steps. */
static aur_hopf_line line_of(const grid *g, uint64_t block, uint64_t turn) {
    aur_hopf_line line = g->base;
    uint64_t copy = 0, azimuth = 0; /* phases of half of psi and of half of phi */
    uint64_t half_turn = (uint64_t)(0x1p63 / (double)g->turns * (double)turn);
    for (size_t level = 0; level < g->levels; ++level) {
        const unsigned digits = block >> (3 * level) & 7, moved = digits & 3;
        copy += (uint64_t)moved << (2 * level);
        if (moved != 0) {
            const aur_grid_shift shift = aur_grid_shift_of((g->first_shift + moved - 1) % 3, level + 2);
            line.offset += 2.0 * shift.index;
            azimuth += shift.phase;
        }
        if ((digits & 4) != 0)
            half_turn += (uint64_t)(0x1p62 / (double)g->turns) >> level;
    }
    half_turn += copy * g->directions * (FIRST_TURN / 2);
    line.phases[0] = half_turn + azimuth;
    line.phases[1] = half_turn - azimuth;
    return line;
}

static void fill(const void *data, uint64_t first, size_t count, double *wxyz) {
    const grid *const g = data;
    while (count > 0) {
        const uint64_t line_number = first / g->directions, j = first % g->directions;
        const size_t part = count < g->directions - j ? count : (size_t)(g->directions - j);
        const aur_hopf_line line = line_of(g, line_number / g->turns, line_number % g->turns);
        AUR_KERNEL_HERE(aur_hopf).line(&line, j, part, wxyz);
        first += part;
        count -= part;
        wxyz += 4 * part;
    }
}

const aur_native_set aur_native_esfg_rotations = {
    .description =
        {.row = {.name = "esfg-rotations",
                 .summary =
                     "directions of E-SFG with equally spaced turns about each; doubles and keeps its points",
                 .source = "Marques 2019, lifted",
                 AUR_ROW_KEYS(keys)},
         .domains = AUR_ON_ROTATIONS,
         .dimensions = {4, 4},
         .maximum_size = AUR_INDEX_LIMIT,
         .extensible = true},
    .prepare = prepare,
    .fill = fill,
};

/* Progressive multi-jittered (0,2) sequences (Christensen, Kensler, Kilpatrick 2018): random points; for
 * every m each elementary interval of area 2^-m contains one of the first 2^m points. Each pass doubles the
 * points: the new point of a cell goes into the quarter opposite to the old one (from 4^k to 2 4^k), then
 * into the two remaining quarters. Free intervals are found digit by digit (Pharr 2019), not by rejection. A
 * table of 2^16 points at most, the same whatever the size. Error N^-3/2 for smooth functions, N^-3/4 across
 * an edge. */
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/pointset/set.h"

enum { LARGEST_LOG = 16, ATTEMPTS = 64 };

/* A pass gives 2^digits points. One flag per elementary interval; shape b has 2^b rows. */
typedef struct pass {
    unsigned digits;
    uint64_t seed, draws;
    uint32_t *x, *y; /* the first LARGEST_LOG binary digits of each point */
    bool *taken;     /* (digits + 1) << digits */
} pass;

static uint64_t draw(pass *p) {
    return aur_hash2(p->seed, p->draws++);
}

static bool *flag(const pass *p, unsigned b, uint32_t x, uint32_t y) {
    const unsigned a = p->digits - b;
    const size_t column = x >> (LARGEST_LOG - a), row = y >> (LARGEST_LOG - b);
    return p->taken + ((size_t)b << p->digits) + (column << b) + row;
}

/* Adds digits to y, from digit b on, so that no shape of b rows and more is taken. */
static bool extend(pass *p, uint32_t x, uint32_t *y, unsigned b) {
    if (b > p->digits)
        return true;
    const uint32_t digit = (uint32_t)(draw(p) & 1u);
    for (uint32_t k = 0; k < 2; ++k) {
        uint32_t next = *y | (digit ^ k) << (LARGEST_LOG - b);
        if (!*flag(p, b, x, next) && extend(p, x, &next, b + 1)) {
            *y = next;
            return true;
        }
    }
    return false;
}

/* A point in the cell of `cell` digits each whose corner is x, y. */
static bool place(pass *p, unsigned cell, uint32_t corner_x, uint32_t corner_y, size_t index) {
    const unsigned rest = p->digits - cell;
    const uint32_t columns = UINT32_C(1) << rest, start = (uint32_t)draw(p);
    for (uint32_t k = 0; k < columns; ++k) {
        const uint32_t column = (start + k * (2 * (start >> 16) + 1)) & (columns - 1);
        const uint32_t x = corner_x | column << (LARGEST_LOG - p->digits);
        uint32_t y = corner_y;
        bool free_so_far = true;
        for (unsigned b = 0; b <= cell && free_so_far; ++b)
            free_so_far = !*flag(p, b, x, y);
        if (!free_so_far || !extend(p, x, &y, cell + 1))
            continue;
        p->x[index] = x;
        p->y[index] = y;
        for (unsigned b = 0; b <= p->digits; ++b)
            *flag(p, b, x, y) = true;
        return true;
    }
    return false;
}

/* Random digits below those determined by this pass. */
static void settle(pass *p, size_t first, size_t last) {
    const uint32_t low = (UINT32_C(1) << (LARGEST_LOG - p->digits)) - 1;
    for (size_t i = first; i < last; ++i) {
        p->x[i] |= (uint32_t)draw(p) & low;
        p->y[i] |= (uint32_t)draw(p) & low;
    }
}

/* Doubles the points to 2^digits. False: earlier choices left no free interval, and must be repeated. */
static bool double_points(pass *p) {
    const size_t half = (size_t)1 << (p->digits - 1);
    const bool diagonal = p->digits % 2 != 0; /* half is a power of 4 */
    const size_t cells = diagonal ? half : half / 2;
    const unsigned side = (p->digits - 1) / 2, cell = side + 1;
    memset(p->taken, 0, (size_t)(p->digits + 1) << p->digits);
    for (size_t i = 0; i < half; ++i)
        for (unsigned b = 0; b <= p->digits; ++b)
            *flag(p, b, p->x[i], p->y[i]) = true;
    const uint32_t corner = ~((UINT32_C(1) << (LARGEST_LOG - cell)) - 1), bit = UINT32_C(1)
                                                                                << (LARGEST_LOG - cell);
    for (size_t i = 0; i < cells; ++i) {
        const uint32_t x = p->x[i] & corner, y = p->y[i] & corner;
        if (diagonal) {
            if (!place(p, cell, x ^ bit, y ^ bit, half + i))
                return false;
            continue;
        }
        /* The two remaining quarters in random order; if that leaves no room, in the other order. */
        const bool swap = (draw(p) & 1u) != 0;
        if (!place(p, cell, x ^ (swap ? bit : 0), y ^ (swap ? 0 : bit), half + i) ||
            !place(p, cell, x ^ (swap ? 0 : bit), y ^ (swap ? bit : 0), half + cells + i))
            return false;
    }
    settle(p, half, 2 * half);
    return true;
}

static bool make_points(uint64_t seed, unsigned digits, pass *p) {
    p->x[0] = (uint32_t)aur_hash3(seed, 0, 0) & 0xffff;
    p->y[0] = (uint32_t)aur_hash3(seed, 0, 1) & 0xffff;
    for (p->digits = 1; p->digits <= digits; ++p->digits) {
        bool doubled = false;
        for (unsigned attempt = 0; attempt < ATTEMPTS && !doubled; ++attempt) {
            p->seed = aur_hash4(seed, p->digits, attempt, 2);
            p->draws = 0;
            doubled = double_points(p);
        }
        if (!doubled)
            return false;
    }
    return true;
}

static aur_result prepare(aur_pointset *set, aur_parameters *keys, aur_error *error) {
    (void)keys;
    unsigned digits = 0;
    while (UINT64_C(1) << digits < set->size)
        ++digits;
    const size_t count = (size_t)1 << digits;
    uint32_t *const words = malloc(2 * count * sizeof *words);
    bool *const taken = malloc((digits + 1) * count * sizeof *taken);
    double *const table = malloc(2 * set->size * sizeof *table);
    aur_result result = words != NULL && taken != NULL && table != NULL ? AUR_OK : aur_fail_memory(error);
    pass p = {.x = words, .y = words + count, .taken = taken};
    if (result == AUR_OK && !make_points(set->seed, digits, &p))
        result = aur_fail(error, AUR_ERROR_INTERNAL, "set 'pmj02': no room for a point; take another seed");
    for (size_t i = 0; i < set->size && result == AUR_OK; ++i) {
        const uint64_t low[] = {aur_hash4(set->seed, i, 0, 3), aur_hash4(set->seed, i, 1, 3)};
        table[2 * i] = aur_word_to_double((uint64_t)p.x[i] << (64 - LARGEST_LOG) | low[0] >> LARGEST_LOG);
        table[2 * i + 1] = aur_word_to_double((uint64_t)p.y[i] << (64 - LARGEST_LOG) | low[1] >> LARGEST_LOG);
    }
    free(words);
    free(taken);
    if (result == AUR_OK)
        set->data = table;
    else
        free(table);
    return result;
}

const aur_square_set aur_set_pmj02 = {
    .description = {.row = {.name = "pmj02",
                            .summary =
                                "progressive multi-jittered (0,2) sequence: random, each power of 2 a net",
                            .source = "Christensen, Kensler, Kilpatrick 2018"},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = 1 << LARGEST_LOG,
                    .best_sizes = AUR_SIZES_POWERS,
                    .size_base = 2,
                    .extensible = true},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .prepare = prepare,
    .fill = aur_fill_table,
};

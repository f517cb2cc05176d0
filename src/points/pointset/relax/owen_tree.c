/* Owen scrambling of Sobol's first two coordinates with optimised instead of random flips, which increase the
 * distances of points (after Perrier, Coeurjolly, Xie, Pharr, Hanrahan, Ostromoukhov 2018, who choose them
 * for tiles that repeat; here for the whole set): the first 2^m points are still a (0,m,2)-net for every m.
 * From random flips, each node of both trees is flipped if that lowers the sum over pairs of (1 - distance^2
 * / radius^2)^3, on the torus. A table: n up to 2^11, O(n^2 log n) per pass. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "points/base/error.h"
#include "points/pointset/digits/digital.h"
#include "points/pointset/relax/relaxation.h"

enum { VERSION = 2, LARGEST = 1 << 11, PASSES = 4, EXTRA_LEVELS = 3 };

typedef struct tree_search {
    size_t count;
    unsigned levels;
    double radius_square;
    uint64_t *word[2]; /* of each point's coordinates */
    double *at[2];     /* the same as numbers */
    bool *moved;       /* of the points below a node */
    uint32_t *order;
} tree_search;

/* The energy of a range of points with all others and among each other. */
static double energy(const tree_search *s, size_t count, const uint32_t *points) {
    const double scale = 1.0 / s->radius_square;
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k) {
        const size_t i = points[k];
        const double x = s->at[0][i], y = s->at[1][i];
        for (size_t j = 0; j < s->count; ++j) {
            const double dx = fabs(s->at[0][j] - x), dy = fabs(s->at[1][j] - y);
            const double a = fmin(dx, 1.0 - dx), b = fmin(dy, 1.0 - dy);
            const double rest = fmax(0.0, 1.0 - (a * a + b * b) * scale);
            sum += (s->moved[j] ? 0.5 : 1.0) * rest * rest * rest;
        }
    }
    return sum;
}

/* Swaps the halves of a node. */
static void flip(const tree_search *s, size_t d, unsigned level, size_t count, const uint32_t *points) {
    for (size_t k = 0; k < count; ++k) {
        s->word[d][points[k]] ^= UINT64_C(1) << (63 - level);
        s->at[d][points[k]] = aur_word_to_double(s->word[d][points[k]]);
    }
}

static int by_word(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Points sorted by a coordinate: those below a node are contiguous. */
static bool sort_points(const tree_search *s, size_t d) {
    uint64_t(*const pairs)[2] = malloc(s->count * sizeof *pairs);
    for (size_t i = 0; i < s->count && pairs != NULL; ++i) {
        pairs[i][0] = s->word[d][i];
        pairs[i][1] = i;
    }
    if (pairs != NULL)
        qsort(pairs, s->count, sizeof *pairs, by_word);
    for (size_t i = 0; i < s->count && pairs != NULL; ++i)
        s->order[i] = (uint32_t)pairs[i][1];
    free(pairs);
    return pairs != NULL;
}

static bool improve_level(const tree_search *s, size_t d, unsigned level) {
    if (!sort_points(s, d))
        return false;
    const unsigned shift = 64 - level;
    for (size_t first = 0, last; first < s->count; first = last) {
        const uint64_t node = level > 0 ? s->word[d][s->order[first]] >> shift : 0;
        for (last = first + 1;
             last < s->count && (level == 0 || s->word[d][s->order[last]] >> shift == node);)
            ++last;
        const uint32_t *const points = s->order + first;
        for (size_t k = first; k < last; ++k)
            s->moved[s->order[k]] = true;
        const double before = energy(s, last - first, points);
        flip(s, d, level, last - first, points);
        if (!(energy(s, last - first, points) < before * (1.0 - 1e-12)))
            flip(s, d, level, last - first, points);
        for (size_t k = first; k < last; ++k)
            s->moved[s->order[k]] = false;
    }
    return true;
}

static aur_result relax(uint64_t seed, size_t count, aur_point2 *sites, aur_error *error) {
    tree_search s = {.count = count, .radius_square = 0.7 / (double)count};
    char *const room = calloc(count, 4 * sizeof(double) + sizeof(uint32_t) + sizeof(bool));
    if (room == NULL)
        return aur_fail_memory(error);
    for (size_t d = 0; d < 2; ++d) {
        s.word[d] = (uint64_t *)(void *)room + d * count;
        s.at[d] = (double *)(void *)room + (2 + d) * count;
        uint64_t columns[AUR_DIGITAL_COLUMNS];
        aur_sobol_matrix(d, columns);
        for (size_t i = 0; i < count; ++i) {
            s.word[d][i] = aur_owen_word(aur_digital_word(columns, i), aur_scramble_key(seed, d));
            s.at[d][i] = aur_word_to_double(s.word[d][i]);
        }
    }
    s.order = (uint32_t *)(void *)(room + 4 * count * sizeof(double));
    s.moved = (bool *)(s.order + count);
    while ((size_t)1 << s.levels < count)
        ++s.levels;
    bool good = true;
    for (unsigned pass = 0; pass < PASSES; ++pass)
        for (unsigned level = 0; level < s.levels + EXTRA_LEVELS; ++level)
            for (size_t d = 0; d < 2; ++d)
                good = good && improve_level(&s, d, level);
    for (size_t i = 0; i < count; ++i)
        sites[i] = (aur_point2){s.at[0][i], s.at[1][i]};
    free(room);
    return good ? AUR_OK : aur_fail_memory(error);
}

const aur_square_set aur_set_owen_tree = {
    .description = {.row = {.name = "owen-tree",
                            .summary = "Sobol' points by Owen's scrambling with flips chosen for distances",
                            .source = "after Perrier 2018"},
                    .domains = AUR_ON_SQUARE,
                    .dimensions = {2, 2},
                    .maximum_size = LARGEST,
                    .best_sizes = AUR_SIZES_POWERS,
                    .size_base = 2},
    .scramblings = AUR_SCRAMBLES_SHIFT,
    .kind_data = &(const aur_relaxation){VERSION, relax},
    .prepare = aur_prepare_relaxed,
    .fill = aur_fill_table,
};

/* Overlaps of many triangles equal those of all pairs by brute force. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "points/base/random.h"
#include "render/scene/overlaps.h"

enum { MOST = 400, KINDS = 11 };

typedef struct mesh {
    size_t count, picked[2];
    double corners[MOST][3][3];
} mesh;

static void corners_of(const void *context, size_t first, size_t count, double (*corners)[3][3]) {
    memcpy(corners, ((const mesh *)context)->corners[first], count * sizeof *corners);
}

static void picked_of(const void *context, size_t first, size_t count, double (*corners)[3][3]) {
    for (size_t i = 0; i < count; ++i)
        corners_of(context, ((const mesh *)context)->picked[first + i], 1, &corners[i]);
}

static double unit(uint64_t a, uint64_t b) {
    return aur_unit_double(aur_hash2(a, b));
}

/* A square of 2 * side * side triangles over a frame, which waves by `height`. */
static void add_square(mesh *m, size_t side, const double start[3], const double across[3],
                       const double along[3], double height) {
    for (size_t i = 0; i < 2 * side * side && m->count < MOST; ++i) {
        static const int steps[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
        for (size_t c = 0; c < 3; ++c) {
            const double u = (double)((i / 2) % side + (size_t)steps[i % 2][c][0]) / (double)side,
                         v = (double)((i / 2) / side + (size_t)steps[i % 2][c][1]) / (double)side;
            for (size_t d = 0; d < 3; ++d)
                m->corners[m->count][c][d] = (double)(float)(start[d] + u * across[d] + v * along[d]);
            m->corners[m->count][c][2] += (double)(float)(height * sin(9.0 * u) * sin(7.0 * v));
        }
        ++m->count;
    }
}

/* All triangles again, turned over, with corners that are slightly off. */
static void add_back(mesh *m, uint64_t seed) {
    const size_t count = m->count;
    for (size_t i = 0; i < count && m->count < MOST; ++i, ++m->count)
        for (size_t c = 0; c < 3; ++c)
            for (size_t d = 0; d < 3; ++d)
                m->corners[m->count][c][d] =
                    m->corners[i][2 - c][d] + 1e-7 * (unit(seed, 100 + 9 * i + 3 * c + d) - 0.5);
}

/* Each in a separate plane; all planes share one direction, or nearly so. */
static void add_fan(mesh *m, const double direction[3], uint64_t seed) {
    for (size_t i = 0; i < 100; ++i, ++m->count)
        for (size_t c = 0; c < 3; ++c)
            for (size_t d = 0; d < 3; ++d)
                m->corners[m->count][c][d] =
                    c == 1 ? m->corners[m->count][0][d] + 0.2 * direction[d] +
                                 1e-8 * (unit(seed, 3000 + 3 * i + d) - 0.5)
                           : (c == 0 ? 1.0 : 0.2) * unit(seed, 9000 + 9 * i + 3 * c + d) +
                                 (c == 0 ? 0.0 : m->corners[m->count][0][d]);
}

/* Positions and frames by a hash; the k-th kind of mesh. */
static void make(mesh *m, int kind, uint64_t seed) {
    m->count = 0;
    double start[3], across[3], along[3];
    for (size_t d = 0; d < 3; ++d) {
        start[d] = unit(seed, d);
        across[d] = unit(seed, 3 + d) - 0.5;
        along[d] = unit(seed, 6 + d) - 0.5;
    }
    if (kind >= 6) {
        static const double directions[4][3] = {
            {0.531, 0.617, 0.581}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
        if (kind == 6)
            add_square(m, 8, start, across, along, 0.05);
        else
            add_fan(m, directions[kind - 7], seed);
        add_back(m, seed);
        return;
    }
    const double ax[3] = {1, 0, 0}, ay[3] = {0, 1, 0};
    add_square(m, kind == 1 ? 2 : 8, start, kind == 3 ? ax : across, kind == 3 ? ay : along,
               kind == 2 ? 0.05 : 0.0);
    /* The same again, all of it; or a smaller part, finer, by its plane or turned over; or crossing it. */
    for (size_t d = 0; d < 3; ++d) {
        start[d] += kind == 2 ? 0.0 : 0.21 * across[d] + 0.13 * along[d];
        across[d] *= kind == 2 ? 1.0 : kind == 4 ? 0.004 : 0.37;
        along[d] *= kind == 2 ? 1.0 : kind == 4 ? -0.004 : -0.41;
    }
    start[2] += kind == 5 ? 2e-7 : 0.0;
    add_square(m, 8, start, across, along, kind == 2 ? 0.05 : 0.0);
    /* Stray triangles, narrow and wide, some with corners of the squares and some in planes of theirs. */
    for (size_t i = 0; i < 60 && m->count < MOST; ++i) {
        const uint64_t hash = aur_hash3(seed, 77, i);
        const double size = pow(10.0, -4.0 * unit(hash, 0)), narrow = pow(10.0, -5.0 * unit(hash, 1));
        const size_t from = (size_t)(unit(hash, 2) * 120.0) % m->count;
        double(*const added)[3] = m->corners[m->count++];
        const double(*const other)[3] = (const double(*)[3])m->corners[from];
        for (size_t d = 0; d < 3; ++d) {
            const double u = other[1][d] - other[0][d], v = other[2][d] - other[0][d];
            const bool inside = i % 3 > 0;
            added[0][d] = inside ? other[0][d] + 0.25 * u + 0.5 * v : unit(hash, 10 + d);
            added[1][d] = added[0][d] + size * (inside ? u - 0.3 * v : unit(hash, 13 + d) - 0.5);
            added[2][d] = added[0][d] + size * (inside ? 0.7 * u : unit(hash, 13 + d) - 0.5) +
                          size * narrow * (inside ? v : unit(hash, 16 + d) - 0.5);
        }
    }
}

/* By a power of two. */
static void scale(mesh *m, int exponent) {
    for (size_t i = 0; i < 9 * m->count; ++i)
        m->corners[i / 9][i / 3 % 3][i % 3] = ldexp(m->corners[i / 9][i / 3 % 3][i % 3], exponent);
}

static void overlaps_are_those_of_all_pairs(void **state) {
    (void)state;
    size_t found = 0;
    for (int kind = 0; kind < KINDS; ++kind)
        for (uint64_t seed = 0; seed < 5; ++seed) {
            static mesh m;
            make(&m, kind, aur_hash2((uint64_t)kind, seed));
            scale(&m, seed < 3 ? 0 : seed == 3 ? 40 : -40);
            const aur_triangle_source all = {m.count, &m, corners_of, false}, two = {2, &m, picked_of, false};
            aur_overlaps overlaps;
            assert_int_equal(aur_overlaps_find(&all, 2, &overlaps, NULL), AUR_OK);
            size_t next = 0, wrong = 0;
            for (size_t k = 1; k < m.count; ++k)
                for (size_t i = 0; i < k; ++i) {
                    m.picked[0] = i;
                    m.picked[1] = k;
                    aur_overlaps pair;
                    assert_int_equal(aur_overlaps_find(&two, 1, &pair, NULL), AUR_OK);
                    const aur_overlap *const here = &overlaps.items[next];
                    const bool listed = next < overlaps.count && here->first == i && here->second == k;
                    wrong +=
                        (pair.count == 1) != listed || (listed && here->opposite != pair.items[0].opposite);
                    next += listed;
                    aur_overlaps_release(&pair);
                }
            if (wrong > 0 || next != overlaps.count)
                printf("kind %d, seed %d: %zu pairs of %zu triangles are wrong, %zu of %zu listed\n", kind,
                       (int)seed, wrong, m.count, next, overlaps.count);
            assert_true(wrong == 0 && next == overlaps.count);
            found += overlaps.count;
            aur_overlaps_release(&overlaps);
        }
    assert_true(found > 1000);
}

int main(void) {
    static const struct CMUnitTest tests[] = {cmocka_unit_test(overlaps_are_those_of_all_pairs)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

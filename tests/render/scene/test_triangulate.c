/* Random outlines of many forms: their triangles have the area of the shoelace formula and cover the points
 * of winding number 1 once, for any first corner and either orientation. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "points/base/random.h"
#include "points/base/vector3d.h"
#include "render/scene/importers/meshes/triangulate.h"

enum { MOST = 4096 };
#define TURN 6.283185307179586

typedef struct outline {
    size_t count;
    double points[MOST][3];
} outline;

static uint64_t drawn;

static double draw(void) {
    return (double)(aur_hash3(46, 7, drawn++) >> 11) * 0x1p-53;
}

static void put(outline *o, double x, double y) {
    o->points[o->count][0] = x;
    o->points[o->count][1] = y;
    o->points[o->count++][2] = 0.0;
}

static void make_star(outline *o, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        const double angle = TURN * (double)i / (double)count, radius = 0.2 + draw();
        put(o, radius * cos(angle), radius * sin(angle));
    }
}

/* A band that winds inwards and comes back on its other side. */
static void make_spiral(outline *o, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        const size_t k = i < count / 2 ? i : count - 1 - i;
        const double angle = 0.3 * (double)k, radius = (i < count / 2 ? 1.05 : 1.0) * exp(-0.04 * angle);
        put(o, radius * cos(angle), radius * sin(angle));
    }
}

static void make_comb(outline *o, size_t count) {
    put(o, 0.0, -1.0);
    put(o, (double)count, -1.0);
    for (size_t i = count; i > 0; --i)
        put(o, (double)i - 0.5 * draw(), i % 2 == 0 ? 0.0 : 1.0 + draw());
    put(o, 0.0, 0.0);
}

/* Corners on a grid, so that many lie on lines: steps up and down. */
static void make_steps(outline *o, size_t count) {
    put(o, 0.0, 0.0);
    for (size_t i = 0; i < count; ++i)
        put(o, (double)i, 1.0 + (double)(aur_hash3(1, count, i) % 3));
    put(o, (double)(count - 1), 0.0);
    for (size_t i = count - 1; i > 1; --i)
        put(o, (double)(i - 1), 0.0);
    for (size_t i = 0; i < o->count / 2; ++i) {
        double swap[3];
        memcpy(swap, o->points[i], sizeof swap);
        memcpy(o->points[i], o->points[o->count - 1 - i], sizeof swap);
        memcpy(o->points[o->count - 1 - i], swap, sizeof swap);
    }
}

/* A square with holes; each is reached by a seam from the lower side and may touch the next one or the
 * border. */
static void make_holes(outline *o, size_t count) {
    put(o, 0.0, 0.0);
    for (size_t i = 0; i < count; ++i) {
        const double x = 2.0 * (double)i + 1.0, wide = i % 3 == 0 ? 1.0 : 0.6, high = i % 2 == 0 ? 3.0 : 2.0;
        put(o, x, 0.0);
        put(o, x, 1.0);
        put(o, x - wide, 2.0);
        put(o, x, high);
        put(o, x + wide, 2.0);
        put(o, x, 1.0);
        put(o, x, 0.0);
    }
    put(o, 2.0 * (double)count, 0.0);
    put(o, 2.0 * (double)count, 3.0);
    put(o, 0.0, 3.0);
}

/* A hole that shares a corner with the border, reached by a seam from elsewhere; repeated and collinear
 * corners. */
static void make_touching(outline *o, size_t count) {
    (void)count;
    static const double p[][2] = {{0, 0}, {0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 4}, {0, 4}, {0, 3},
                                  {1, 2}, {0, 0}, {2, 1}, {1, 2}, {0, 3}, {0, 2}, {0, 1}};
    for (size_t i = 0; i < sizeof p / sizeof p[0]; ++i)
        put(o, p[i][0], p[i][1]);
}

/* A seam that ends nowhere, and one that continues from hole to hole. */
static void make_chain(outline *o, size_t count) {
    put(o, 0.0, 0.0);
    put(o, 3.0 * (double)count + 1.0, 0.0);
    put(o, 3.0 * (double)count + 1.0, 4.0);
    put(o, 2.0, 4.0);
    put(o, 1.5, 3.5);
    put(o, 2.0, 4.0);
    put(o, 0.0, 4.0);
    put(o, 0.0, 1.0);
    for (size_t i = 0; i < count; ++i) {
        put(o, 3.0 * (double)i + 1.0, 1.0);
        put(o, 3.0 * (double)i + 2.0, 3.0);
        put(o, 3.0 * (double)i + 3.0, 1.0);
    }
    for (size_t i = count; i > 0; --i) {
        put(o, 3.0 * (double)i - 2.0, 1.0);
        if (i > 1)
            put(o, 3.0 * (double)(i - 1), 1.0);
    }
    put(o, 0.0, 1.0);
}

static double shoelace(const outline *o) {
    double sum = 0.0;
    for (size_t i = 0; i < o->count; ++i) {
        const double *const a = o->points[i], *const b = o->points[(i + 1) % o->count];
        sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    return sum;
}

static int winding(const outline *o, const double p[2]) {
    int turns = 0;
    for (size_t i = 0; i < o->count; ++i) {
        const double *const a = o->points[i], *const b = o->points[(i + 1) % o->count];
        if ((a[1] <= p[1]) == (b[1] <= p[1]))
            continue;
        const double side = aur_orientation(a, b, p);
        turns += a[1] <= p[1] ? side > 0.0 : -(side < 0.0);
    }
    return turns;
}

static void check_cover(const outline *o, const aur_face_cut *cut) {
    double area = 0.0, low[2] = {1e30, 1e30}, high[2] = {-1e30, -1e30};
    for (size_t i = 0; i < cut->triangle_count; ++i) {
        const uint32_t *const t = &cut->indices[3 * i];
        const double turn = aur_orientation(o->points[t[0]], o->points[t[1]], o->points[t[2]]);
        assert_true(turn > 0.0);
        area += 0.5 * turn;
    }
    assert_relative(area, shoelace(o), 1e-12);
    assert_relative(cut->area, area, 1e-12);
    for (size_t i = 0; i < o->count; ++i)
        for (int d = 0; d < 2; ++d) {
            low[d] = fmin(low[d], o->points[i][d]);
            high[d] = fmax(high[d], o->points[i][d]);
        }
    for (size_t n = 0; n < 200; ++n) {
        const double p[2] = {low[0] + draw() * (high[0] - low[0]), low[1] + draw() * (high[1] - low[1])};
        int times = 0;
        for (size_t i = 0; i < cut->triangle_count; ++i) {
            const uint32_t *const t = &cut->indices[3 * i];
            bool inside = true;
            for (size_t k = 0; k < 3; ++k)
                inside = inside && aur_orientation(o->points[t[k]], o->points[t[(k + 1) % 3]], p) > 0.0;
            times += inside;
        }
        assert_int_equal(times, winding(o, p));
    }
}

/* The triangles' corners by position, which rotations of the same outline must have too. */
static void list_corners(const double (*points)[3], const aur_face_cut *cut, bool turned,
                         double (*corners)[3]) {
    for (size_t i = 0; i < 3 * cut->triangle_count; ++i) {
        const size_t k = turned && i % 3 != 0 ? 3 * (i / 3) + 3 - i % 3 : i;
        memcpy(corners[i], points[cut->indices[k]], sizeof corners[i]);
    }
}

static double (*first_outline)[3], (*listed)[3];

/* Moved into space by three columns, from each first corner and both ways round. */
static void check_readings(const outline *o, const double to_space[3][3], aur_triangulator *work) {
    static outline moved;
    size_t triangles = 0;
    const size_t step = o->count > 64 ? o->count / 7 : 1;
    for (size_t shift = 0; shift < 2 * o->count; shift += step) {
        const bool turned = shift >= o->count;
        for (size_t i = 0; i < o->count; ++i) {
            const double *const p = o->points[(turned ? 2 * o->count - i + shift : i + shift) % o->count];
            for (int d = 0; d < 3; ++d)
                moved.points[i][d] = to_space[d][0] * p[0] + to_space[d][1] * p[1] + to_space[d][2];
        }
        aur_face_cut cut;
        assert_true(aur_triangulate(work, o->count, (const double(*)[3])moved.points, &cut));
        assert_int_equal(cut.flaw, AUR_FACE_GOOD);
        assert_relative(cut.area, shoelace(o), 1e-10);
        list_corners((const double(*)[3])moved.points, &cut, turned, shift == 0 ? first_outline : listed);
        triangles = shift == 0 ? cut.triangle_count : triangles;
        assert_int_equal(cut.triangle_count, triangles);
        if (shift > 0)
            assert_memory_equal(listed, first_outline, 3 * triangles * sizeof *listed);
    }
}

static void outlines_are_covered_once(void **state) {
    (void)state;
    static const struct {
        void (*make)(outline *, size_t);
        size_t sizes[4];
    } forms[] = {{make_star, {4, 9, 40, 1000}},  {make_spiral, {8, 30, 200, 1000}},
                 {make_comb, {3, 10, 50, 1000}}, {make_steps, {3, 8, 30, 500}},
                 {make_holes, {1, 2, 7, 100}},   {make_touching, {1, 1, 1, 1}},
                 {make_chain, {1, 2, 5, 100}}};
    static const double flat[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 0}},
                        upright[3][3] = {{0, 0, 5}, {1, 0, 0}, {0, 1, 0}},
                        oblique[3][3] = {{.6, -.64, 1}, {.8, .48, -2}, {0, .6, 3}};
    static outline o;
    aur_triangulator work = {0};
    first_outline = malloc(3 * MOST * sizeof *listed);
    listed = malloc(3 * MOST * sizeof *listed);
    for (size_t f = 0; f < sizeof forms / sizeof forms[0]; ++f)
        for (size_t s = 0; s < 4; ++s)
            for (size_t repeat = 0; repeat < (s < 2 ? 20u : 1u); ++repeat) {
                o.count = 0;
                forms[f].make(&o, forms[f].sizes[s]);
                aur_face_cut cut;
                assert_true(aur_triangulate(&work, o.count, (const double(*)[3])o.points, &cut));
                assert_int_equal(cut.flaw, AUR_FACE_GOOD);
                check_cover(&o, &cut);
                check_readings(&o, flat, &work);
                check_readings(&o, upright, &work);
                check_readings(&o, oblique, &work);
            }
    free(first_outline);
    free(listed);
    aur_triangulator_release(&work);
}

static aur_face_flaw flaw_of(size_t count, const double (*corners)[3]) {
    aur_triangulator work = {0};
    aur_face_cut cut;
    assert_true(aur_triangulate(&work, count, corners, &cut));
    assert_int_equal(cut.triangle_count == 0, cut.flaw == AUR_FACE_EMPTY || cut.flaw == AUR_FACE_CROSSED);
    aur_triangulator_release(&work);
    return cut.flaw;
}

static void flaws_are_distinguished(void **state) {
    (void)state;
    static const double line[4][3] = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}},
                        point[3][3] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}},
                        bow[4][3] = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 3, 0}},
                        even_bow[4][3] = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},
                        bent[4][3] = {{0, 0, 0}, {4, 0, 0}, {4, 4, .025}, {0, 4, 0}},
                        back[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    assert_int_equal(flaw_of(4, line), AUR_FACE_EMPTY);
    assert_int_equal(flaw_of(3, point), AUR_FACE_EMPTY);
    assert_int_equal(flaw_of(4, back), AUR_FACE_EMPTY);
    assert_int_equal(flaw_of(4, even_bow), AUR_FACE_EMPTY);
    assert_int_equal(flaw_of(4, bow), AUR_FACE_CROSSED);
    assert_int_equal(flaw_of(4, bent), AUR_FACE_BENT);
    double star[5][3];
    for (size_t i = 0; i < 5; ++i) {
        star[i][0] = cos(TURN * 0.4 * (double)i);
        star[i][1] = sin(TURN * 0.4 * (double)i);
        star[i][2] = 1.0;
    }
    assert_int_equal(flaw_of(5, (const double(*)[3])star), AUR_FACE_CROSSED);
}

int main(void) {
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(outlines_are_covered_once),
        cmocka_unit_test(flaws_are_distinguished),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
